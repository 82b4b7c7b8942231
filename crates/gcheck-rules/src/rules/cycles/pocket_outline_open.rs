//! A pocket whose outline is not closed.

use gcheck_engine::{CycleFault, Fault, Units};

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_code;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch, limit};

declare_rule! {
    /// The outline of a pocket does not end at the point that its first move leads to, or has no move after that one.
    ///
    /// ## Why it matters
    /// The control cannot tell inside from outside, and stops with an alarm before it cuts.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G43 H1 Z.1
    /// G150 P100 G41 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
    /// G40 X0. Y0.
    /// M30
    /// O100
    /// G1 Y1.
    /// X1.
    /// Y-1.
    /// X-1.
    /// Y1.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G43 H1 Z.1
    /// G150 P100 G41 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
    /// G40 X0. Y0.
    /// M30
    /// O100
    /// G1 Y1.
    /// X1.
    /// Y-1.
    /// X-1.
    /// Y1.
    /// X0.
    /// M99
    /// ```
    rule "pocket-outline-open" in "cycles" {
        summary: "pocket whose outline is not closed",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(PocketOutlineOpen) },
    }
}

/// A control may close a gap up to this size, millimetres: no manual gives the value.
const MAY_CLOSE: f64 = 0.0254;

struct PocketOutlineOpen;

impl PathRule for PocketOutlineOpen {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let gap = match *fault {
            Fault::Cycle(CycleFault::OutlineOpen(gap)) => Some(gap),
            Fault::Cycle(CycleFault::OutlineEmpty) => None,
            _ => return,
        };
        let Some(code) = cycle_code(cx) else { return };
        let (name, entry) = (code.number(), code.entry());
        let finding = match gap {
            Some(gap) => cx
                .finding(
                    &META,
                    cx.letter_range('P'),
                    format!("the pocket's outline is not closed (`{name}`)"),
                )
                .label(format!("it ends {} from where its first move leads", length(cx, gap)))
                .help("end the outline at the point that its first move reaches"),
            None => cx
                .finding(&META, cx.letter_range('P'), format!("the pocket has no outline (`{name}`)"))
                .label("there is no move after the one that leads to the outline")
                .help("write the outline after the move that leads to it"),
        };
        let may_be_closed = gap.is_some_and(|gap| gap <= MAY_CLOSE);
        report.add(
            finding
                .note(format!(
                    "the first move leads from the start hole to the outline; the last one must come back to that point  \
                     [{}]",
                    entry.source
                ))
                .at_most(if may_be_closed { Severity::Warning } else { limit(entry.confidence) }),
        );
    }
}

/// A length in the program's units.
fn length(cx: &PathCx<'_>, mm: f64) -> String {
    match cx.state().units(cx.model) {
        Some(Units::Inch) => format!("{:.4} inch", mm / 25.4),
        _ => format!("{mm:.3} mm"),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    const HEAD: &str =
        "G20 G90 G54 G0 X0. Y0.\nZ.1\nG150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.\nM30\nO100\nG1 Y1.\n";

    #[test]
    fn a_hair_is_a_warning_and_less_is_closed() {
        check_rule(
            &RULE,
            "haas-mill",
            &format!("{HEAD}X1.\nY-1.\nX-1.\nY1.0005\nX0.\nM99\n"),
            &expect![[r#"
            3 | G150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
              |      ^^^^ warning[pocket-outline-open] the pocket's outline is not closed (`G150`)
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &format!("{HEAD}X1.\nY-1.\nX-1.\nY1.0002\nX0.\nM99\n"),
            &expect![[""]],
        );
    }

    #[test]
    fn one_move_is_no_outline() {
        check_rule(
            &RULE,
            "haas-mill",
            &format!("{HEAD}M99\n"),
            &expect![[r#"
            3 | G150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
              |      ^^^^ error[pocket-outline-open] the pocket has no outline (`G150`)
        "#]],
        );
    }

    #[test]
    fn an_outline_that_depends_on_the_unknown_is_not_judged() {
        check_rule(&RULE, "haas-mill", &format!("{HEAD}X#100\nY-1.\nX-1.\nY1.\nM99\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            "G150 P100 X#1 Y0. Z-.5 Q.25 R.1 I.2 F20.\nM30\nO100\nG1 Y1.\nX1.\nM99\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_it_says() {
        let program = format!("{HEAD}X1.\nY-1.\nX-1.\nM99\n");
        let found = findings(&only(&RULE), "haas-mill", &program, &World::default());
        expect![[r#"
            the pocket's outline is not closed (`G150`)
              here: it ends 2.2361 inch from where its first move leads
              note: the first move leads from the start hole to the outline; the last one must come back to that point  [Haas 96-8000 rev AC May 2010 p.184; Haas 96-8000 June 1999 (easymanua.ls page 208); HM17 p.314-316]
              help: end the outline at the point that its first move reaches
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
