//! Cutter compensation with offset number zero.

use gcheck_controls::{CodeIx, Effect, Letter, Need, WordEntry};
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::compensation::{begins, is_on};
use crate::{Finding, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Cutter compensation is switched on (`G41`, `G42`) with offset number zero (`D0`).
    ///
    /// If the program never gives a `D`, `lasting-word-never-given` reports that.
    ///
    /// ## Why it matters
    /// Offset zero has no size: the tool's centre follows the contour, and the part is too small by the tool's
    /// diameter.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G41 D0 G1 X10. F100.
    /// G40 X0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G41 D1 G1 X10. F100.
    /// G40 X0.
    /// M30
    /// ```
    rule "compensation-offset-missing" in "compensation" {
        summary: "cutter compensation with offset number zero",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS),
            make: || Box::new(CompensationOffsetMissing { has_begun: false }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct CompensationOffsetMissing {
    /// Compensation was switched on, and no cut seen since.
    has_begun: bool,
}

remembers!(CompensationOffsetMissing);

impl PathRule for CompensationOffsetMissing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_on)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        self.has_begun |= begins(cx);
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let is_loaded = cx.model.semantics().tools.zero_is_loaded;
        if !std::mem::take(&mut self.has_begun) || is_loaded || Abstract::known(cx.state().d()) != Some(0.0) {
            return;
        }
        let Some(code) = cx.state().mode(Role::Compensation).only() else { return };
        let is_by_number =
            matches!(cx.model.effect(code), Effect::CompensationLeft | Effect::CompensationRight);
        let Some(at) = cx.definitions().set_by(Fact::Mode(Role::Compensation)) else { return };
        // Only a zero of a word: `T0100` of a turret cancels all offsets.
        let is_zero = |word: &gcheck_program::Word| {
            word.letter.ascii() == b'D' && (word.is_computed() || word.number() == Some(0.0))
        };
        if !is_by_number {
            return;
        }
        let name = cx.name_of(code);
        let Some(range) = cx.find_word(at, is_zero) else {
            if let Some(finding) = without_word(cx, code, at) {
                report.add(finding);
            }
            return;
        };
        report.add(
            cx.finding(&META, range, format!("cutter compensation with no offset (`{name} D0`)"))
                .label("offset zero has no size")
                .help(format!("give the tool's offset number with `{name}`, or remove the compensation")),
        );
    }
}

/// A lasting `D` that this way to the block does not give, although the text has one before it. Where it has none, the text
/// alone says so, and another rule reports it.
fn without_word(cx: &PathCx<'_>, code: CodeIx, at: At) -> Option<Finding> {
    let d = Letter::of('D');
    let range = cx.find_word(at, |word| word.code == code)?;
    let is_never_given =
        cx.file_index.never_given.iter().any(|given| given.letter == d && given.range.start == range.start);
    let lasts = |word: &WordEntry| word.need == Need::Modal && Letter::parse(&word.letter) == Some(d);
    let lasts = cx.code_of(code)?.entry().words.iter().any(lasts);
    if is_never_given || !lasts || cx.is_called_only() || cx.find_word(at, |word| word.letter == d).is_some()
    {
        return None;
    }
    let name = cx.name_of(code);
    Some(
        cx.finding(&META, range, format!("cutter compensation with no offset (`{name}` without `D`)"))
            .label("no `D` is in effect on the way here")
            .help(format!("give the tool's offset number with `{name}`")),
    )
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_zero_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G42 D0\nG1 X1. F5.\nG40 X0.\nM30\n",
            &expect![[r#"
            1 | G20 G42 D0
              |         ^^ warning[compensation-offset-missing] cutter compensation with no offset (`G42 D0`)
        "#]],
        );
    }

    #[test]
    fn a_number_from_a_variable_may_be_anything() {
        check_rule(&RULE, "haas-mill", "G20 G42 D#500\nG1 X1. F5.\nG40 X0.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_lasting_number_that_one_way_does_not_give() {
        let program = |given: &str| format!("G20\n{given}D1\nG1 G42 X1. F5.\nG40 X0.\nM30\n");
        check_rule(
            &RULE,
            "haas-mill",
            &program("/"),
            &expect![[r#"
            3 | G1 G42 X1. F5.
              |    ^^^ warning[compensation-offset-missing] cutter compensation with no offset (`G42` without `D`)
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program(""), &expect![[""]]);
        check_rule(&RULE, "haas-mill", "G20\nG1 G42 X1. F5.\nG40 X0.\nM30\n", &expect![[""]]);
    }
}
