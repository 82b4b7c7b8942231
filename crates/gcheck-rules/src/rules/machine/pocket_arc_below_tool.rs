//! A pocket whose tool is larger than an arc of its outline.

use gcheck_engine::{CycleFault, Fault, Units};

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_code;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// The outline of a pocket has an inside arc with a radius smaller than that of the tool.
    ///
    /// ## Why it matters
    /// The centre of the tool keeps its radius from the wall. It cannot do that inside a smaller arc, so the control
    /// stops with an alarm. Where the outline gives a sharp corner, the tool leaves its own radius there and no alarm
    /// comes.
    ///
    /// ## Reported
    /// Tool 1 has a diameter of 10 mm:
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G150 P100 G41 D1 X0. Y0. Z-5. Q2. R2. I7. F200.
    /// G40 X0. Y0.
    /// M30
    /// O100
    /// G1 Y20.
    /// X-18.
    /// G3 X-20. Y18. R2.
    /// G1 Y-20.
    /// X20.
    /// Y20.
    /// X0.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G150 P100 G41 D1 X0. Y0. Z-5. Q2. R2. I7. F200.
    /// G40 X0. Y0.
    /// M30
    /// O100
    /// G1 Y20.
    /// X-14.
    /// G3 X-20. Y14. R6.
    /// G1 Y-20.
    /// X20.
    /// Y20.
    /// X0.
    /// M99
    /// ```
    rule "pocket-arc-below-tool" in "machine" {
        summary: "pocket with an inside arc smaller than its tool",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(PocketArcBelowTool) },
    }
}

struct PocketArcBelowTool;

impl PathRule for PocketArcBelowTool {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::Cycle(CycleFault::ArcBelowTool { arc, tool }) = *fault else { return };
        let Some(code) = cycle_code(cx) else { return };
        let (name, entry) = (code.number(), code.entry());
        let inch = cx.state().units(cx.model) == Some(Units::Inch);
        let shown = |mm: f64| if inch { format!("{:.4} in", mm / 25.4) } else { format!("{mm:.3} mm") };
        report.add(
            cx.finding(
                &META,
                cx.letter_range('D'),
                format!("the tool is larger than an inside arc of the pocket (`{name}`)"),
            )
            .label(format!("radius {}; the smallest inside arc has {}", shown(tool), shown(arc)))
            .note(format!(
                "under cutter compensation an inside arc below the tool's radius is an alarm  [HM17 p.141; {}]",
                entry.source
            ))
            .help("take a smaller tool, or a larger radius in the outline")
            .at_most(limit(entry.confidence)),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    /// A pocket whose upper left corner is rounded.
    fn pocket(side: &str, corner: &str) -> String {
        format!(
            "G21 G90 G54 G0 X0. Y0.\nG150 P100 {side} D1 X0. Y0. Z-5. Q2. R2. I7. F200.\nG40 X0. Y0.\nM30\nO100\nG1 Y20.\n{corner}G1 Y-20.\nX20.\nY20.\nX0.\nM99\n"
        )
    }

    #[test]
    fn an_arc_around_the_inside_counts_and_one_around_the_outside_does_not() {
        let world = || World::of_examples(&META);
        check_rule_in(
            &RULE,
            "haas-mill",
            &pocket("G41", "X-18.\nG3 X-20. Y18. R2.\n"),
            &world(),
            &expect![[r#"
                2 | G150 P100 G41 D1 X0. Y0. Z-5. Q2. R2. I7. F200.
                  |               ^^ error[pocket-arc-below-tool] the tool is larger than an inside arc of the pocket (`G150`)
            "#]],
        );
        check_rule_in(
            &RULE,
            "haas-mill",
            &pocket("G41", "X-18.\nG2 X-20. Y18. R2.\n"),
            &world(),
            &expect![[""]],
        );
        check_rule_in(&RULE, "haas-mill", &pocket("G41", "X-20.\n"), &world(), &expect![[""]]);
    }

    #[test]
    fn without_compensation_or_a_known_tool_nothing_is_known() {
        let corner = "X-18.\nG3 X-20. Y18. R2.\n";
        check_rule_in(&RULE, "haas-mill", &pocket("", corner), &World::of_examples(&META), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &pocket("G41", corner), &expect![[""]]);
    }
}
