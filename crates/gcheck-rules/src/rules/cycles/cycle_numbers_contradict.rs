//! A cycle whose numbers contradict each other.

use gcheck_controls::Effect;
use gcheck_engine::{CycleFault, Fault};

use crate::declare::declare_rule;
use crate::facts::cycles::{cycle_code, is_round_pocket};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch, limit};

declare_rule! {
    /// The numbers of a cycle do not fit together: a pocket whose first circle is not smaller than the last one (`I` must be
    /// less than `K`), a thread less deep than its first cut.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the cycle, or cuts another shape than the one that is meant.
    ///
    /// ## Reported
    /// The full depth is less than the first cut.
    /// ```nc,reported,linuxcnc
    /// G18 G21 G90 G0 X20 Z5
    /// S200 M3
    /// G76 P1.5 Z-20 I-1 J0.5 K0.3 Q29
    /// M2
    /// ```
    /// The first circle of the pocket is larger than the last one.
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0 Y0 Z.1
    /// G13 D1 I.5 K.4 Q.1 Z-.2 F20.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G18 G21 G90 G0 X20 Z5
    /// S200 M3
    /// G76 P1.5 Z-20 I-1 J0.3 K0.9 Q29
    /// M2
    /// ```
    rule "cycle-numbers-contradict" in "cycles" {
        summary: "cycle whose numbers contradict each other",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::FAULTS.union(Watch::BLOCKS),
            make: || Box::new(CycleNumbersContradict),
        },
    }
}

struct CycleNumbersContradict;

impl PathRule for CycleNumbersContradict {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(is_round_pocket) || cx.is_malformed() {
            return;
        }
        let circles = cx.known_number('I').zip(cx.known_number('K'));
        if let Some((first, last)) = circles.filter(|(first, last)| last <= first) {
            let label =
                format!("the first circle (`I` {first}) is not smaller than the finished one (`K` {last})");
            contradicts(
                cx,
                "numbers of a cycle contradict each other",
                Some(label),
                Severity::Warning,
                report,
            );
        }
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let what = match *fault {
            Fault::Cycle(CycleFault::Geometry) => "numbers of a cycle contradict each other",
            Fault::Cycle(CycleFault::Plane) => "cycle in a plane that it does not work in",
            _ => return,
        };
        let first_cut = cx.known_number('J').zip(cx.known_number('K')).filter(|(first, all)| first > all);
        let label = first_cut.filter(|_| cx.has_effect(|effect| effect == Effect::ThreadCycle)).map(
            |(first, all)| format!("the first cut (`J` {first}) is deeper than the whole thread (`K` {all})"),
        );
        contradicts(cx, what, label, limit(cx.model.semantics().confidence), report);
    }
}

fn contradicts(cx: &PathCx<'_>, what: &str, label: Option<String>, most: Severity, report: &mut Report<'_>) {
    let Some(code) = cycle_code(cx) else { return };
    let (name, entry) = (code.number(), code.entry());
    let range = cx.word_range(|word| word.code.is_some() && cx.model.effect(word.code) == code.effect());
    report.add(
        cx.finding(&META, range, format!("{what} (`{name}`)"))
            .label(label.unwrap_or_else(|| entry.title.clone()))
            .note(format!("the manual gives the meaning of each word of `{name}`  [{}]", entry.source))
            .help("check the words of the cycle against each other")
            .at_most(most),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_code_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G18 G21 G90 G0 X20 Z5\nS200 M3\nG76 P1.5 Z-20 I-1 J0.5 K0.3 Q29\nG76 P1.5 Z-20 I-1 J#1 K0.3 Q29\nM2\n",
            &expect![[r#"
                3 | G76 P1.5 Z-20 I-1 J0.5 K0.3 Q29
                  | ^^^ error[cycle-numbers-contradict] numbers of a cycle contradict each other (`G76`)
            "#]],
        );
    }

    #[test]
    fn a_first_circle_that_is_too_large_needs_no_tool_to_show() {
        let pocket = |i: &str, k: &str| {
            format!("G20 G90 G54 G0 X0 Y0 Z.1\n#1=.5\nG12 I{i} K{k} Q.1 Z-.2 D1 F20.\nM30\n")
        };
        check_rule(
            &RULE,
            "haas-mill",
            &pocket("#1", ".4"),
            &expect![[r#"
            3 | G12 I#1 K.4 Q.1 Z-.2 D1 F20.
              | ^^^ warning[cycle-numbers-contradict] numbers of a cycle contradict each other (`G12`)
        "#]],
        );
        check_rule(&RULE, "haas-mill", &pocket(".4", "#1"), &expect![[""]]);
    }

    #[test]
    fn a_tool_of_unknown_size_may_fit() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0 Y0 Z.1\nG1 Z-.1 F10.\nG13 I.1 K.3 Q.1 D1 F20.\nM30\n",
            &expect![[""]],
        );
    }
}
