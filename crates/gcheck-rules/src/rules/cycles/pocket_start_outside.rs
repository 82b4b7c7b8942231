//! A pocket that begins outside its outline.

use gcheck_engine::{CycleFault, Fault};

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_code;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// The start hole of a pocket lies outside the outline.
    ///
    /// ## Why it matters
    /// The control stops with an alarm before it cuts. Often the outline was drawn from another zero, or the hole was
    /// drilled elsewhere.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X3. Y0.
    /// G43 H1 Z.1
    /// G150 P100 G41 D1 X3. Y0. Z-.5 Q.25 R.1 I.2 F20.
    /// G40 X3. Y0.
    /// M30
    /// O100
    /// G1 X0. Y1.
    /// X1.
    /// Y-1.
    /// X-1.
    /// Y1.
    /// X0.
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
    /// G1 X0. Y1.
    /// X1.
    /// Y-1.
    /// X-1.
    /// Y1.
    /// X0.
    /// M99
    /// ```
    rule "pocket-start-outside" in "cycles" {
        summary: "pocket whose start hole lies outside its outline",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(PocketStartOutside) },
    }
}

struct PocketStartOutside;

impl PathRule for PocketStartOutside {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::Cycle(CycleFault::StartOutside) {
            return;
        }
        let Some(code) = cycle_code(cx) else { return };
        let (name, entry) = (code.number(), code.entry());
        report.add(
            cx.finding(
                &META,
                cx.letter_range('X'),
                format!("the pocket's start hole lies outside its outline (`{name}`)"),
            )
            .label("the outline that `P` names does not go around this point")
            .note(format!("`{name}` ({}) begins inside its outline  [{}]", entry.title, entry.source))
            .help("give the start hole with `X` and `Y`, and compare the zero of the outline with that of the program")
            .at_most(limit(entry.confidence)),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    const OUTLINE: &str = "M30\nO100\nG1 X0. Y1.\nG3 Y-1. J-1.\nY1. J1.\nM99\n";

    #[test]
    fn round_outlines_count_too() {
        let at = |x: &str| {
            format!("G20 G90 G54 G0 X0. Y0.\nZ.1\nG150 P100 X{x} Y0. Z-.5 Q.25 R.1 I.2 F20.\n{OUTLINE}")
        };
        check_rule(&RULE, "haas-mill", &at(".99"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &at("1.01"),
            &expect![[r#"
            3 | G150 P100 X1.01 Y0. Z-.5 Q.25 R.1 I.2 F20.
              |           ^^^^^ error[pocket-start-outside] the pocket's start hole lies outside its outline (`G150`)
        "#]],
        );
        check_rule(&RULE, "haas-mill", &at("#100"), &expect![[""]]);
    }

    #[test]
    fn an_outline_of_increments_begins_at_the_hole() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X5. Y5.\nZ.1\nG150 P100 X5. Y5. Z-.5 Q.25 R.1 I.2 F20.\nM30\nO100\nG91 G1 Y1.\nX1.\nY-2.\nX-2.\nY2.\nX1.\nG90\nM99\n",
            &expect![[""]],
        );
    }
}
