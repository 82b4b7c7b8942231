//! A bar feed without its lengths.

use gcheck_controls::{Letter, LetterSet};
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::bar_feed::{Given, Length, bar_feed_range, bar_feeder, given, lengths};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A bar feed (`G105`) takes a length from the control's page: the block, the program and the configuration do not
    /// give it.
    ///
    /// A bare `G105` is the usual form, so the finding is an *info*. If the machine file describes the bar
    /// (`bar_length`) without these lengths, it is a *warning*.
    ///
    /// ## Why it matters
    /// The bar is pushed by what the last job left on the page. A part that is too short is scrap; a push that is too
    /// long hits the turret.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// M5
    /// G105
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// #3100=1.75 (PART)
    /// #3102=0.5 (CLAMPING)
    /// M5
    /// G105 I2.
    /// M99
    /// ```
    rule "bar-length-missing" in "bar_feeder" {
        summary: "bar feed that takes its lengths from the control's page",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(BarLengthMissing { overridden: LetterSet::EMPTY }) },
    }
}

#[derive(Clone, PartialEq)]
struct BarLengthMissing {
    /// Words of earlier feeds: another rule reports that they do not last.
    overridden: LetterSet,
}

remembers!(BarLengthMissing);

impl PathRule for BarLengthMissing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(rules) = bar_feeder(cx) else { return };
        if lengths(event).is_none() {
            return;
        }
        let mut missing = Vec::new();
        for length in Length::ALL {
            let letter = Letter::of(length.letter());
            match given(cx, length, rules) {
                Given::Word => {
                    self.overridden.insert(letter);
                }
                Given::Nowhere if !self.overridden.contains(letter) => missing.push(length),
                Given::Nowhere | Given::Variable => {}
            }
        }
        let Some(first) = missing.first() else { return };
        let variables: Vec<String> =
            missing.iter().map(|one| format!("`#{}`", one.variable(rules))).collect();
        let variables = listed(&variables);
        let title = match missing.as_slice() {
            [one] => format!("{} of the bar feed is not given ({variables})", one.words()),
            _ => "lengths of the bar feed are not given".to_owned(),
        };
        let is_described = cx.environment.machine.engine.bar.new_bar.is_some();
        let pin = format!("\"#{}\" = …", first.variable(rules));
        let words: Vec<String> =
            missing.iter().map(|one| format!("`{}` ({})", one.letter(), one.words())).collect();
        // The page of the control gives the first push where the block leaves it out.
        let is_usual = missing.iter().all(|one| *one == Length::Initial);
        let finding = cx
            .finding(&META, bar_feed_range(cx), title)
            .label(format!(
                "takes {variables} as the control has {}",
                if missing.len() == 1 { "it" } else { "them" }
            ))
            .assuming(format!(
                "{variables} {} set on the control's page",
                if missing.len() == 1 { "is" } else { "are" }
            ))
            .help(format!(
                "give {} in the block, or configure the values of the page: {pin} under `[variables]`",
                listed(&words)
            ));
        report.add(if is_described && !is_usual { finding } else { finding.at_most(Severity::Info) });
    }
}

/// `a`, `a and b`, `a, b and c`.
fn listed(items: &[String]) -> String {
    match items {
        [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        items => items.concat(),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_geometry::Mm;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn a_bare_feed_is_the_usual_form() {
        check_rule(
            &RULE,
            "haas-lathe",
            "M5\nG105\nM99\n",
            &expect![[r#"
            2 | G105
              | ^^^^ info[bar-length-missing] lengths of the bar feed are not given
        "#]],
        );
    }

    #[test]
    fn with_a_machine_that_has_a_bar_it_is_a_warning() {
        check_rule_in(
            &RULE,
            "haas-lathe",
            "M5\nG105 J1.75\nM99\n",
            &World::of_examples(&META),
            &expect![[r#"
                2 | G105 J1.75
                  | ^^^^ warning[bar-length-missing] lengths of the bar feed are not given
            "#]],
        );
    }

    #[test]
    fn told_variables_are_given() {
        let mut world = World::default();
        world.machine.engine.bar.new_bar = Some(Mm(1000.0));
        world.machine.engine.variables = [(3100, 1.75), (3101, 2.0)].into();
        check_rule_in(
            &RULE,
            "haas-lathe",
            "M5\nG105\nM99\n",
            &world,
            &expect![[r#"
            2 | G105
              | ^^^^ warning[bar-length-missing] clamping length of the bar feed is not given (`#3102`)
        "#]],
        );
    }

    /// Given, with an unknown value.
    #[test]
    fn a_value_that_is_not_known_is_given() {
        check_rule(&RULE, "haas-lathe", "#3100=#500\n#3101=#501\nM5\nG105 K#502\nM99\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-lathe",
            "IF [#500 EQ 1] THEN #3100=2.\nM5\nG105 I2. K1.\nM99\n",
            &expect![[""]],
        );
    }

    /// In a program that is not here anything may be set.
    #[test]
    fn behind_a_program_that_is_not_here_nothing_is_said() {
        check_rule(&RULE, "haas-lathe", "M98 P9000\nM5\nG105\nM99\n", &expect![[""]]);
    }

    #[test]
    fn in_a_subprogram_and_behind_a_block_delete() {
        check_rule(
            &RULE,
            "haas-lathe",
            "M97 P10\nM30\nN10 M5\n/G105 I2. K1.\nM99\n",
            &expect![[r#"
                4 | /G105 I2. K1.
                  |  ^^^^ info[bar-length-missing] part length of the bar feed is not given (`#3100`)
            "#]],
        );
    }
}
