//! Exact stop that the program leaves on.

use gcheck_controls::Effect;
use gcheck_engine::Role;

use crate::declare::declare_rule;
use crate::facts::mode_left_on::{Mode, ModeLeftOn};
use crate::{Run, Watch};

declare_rule! {
    /// Exact stop for all blocks (`G61`) is still on when the program ends, or the next tool cuts with it and the program never
    /// goes back to blending.
    ///
    /// A mode from the head of the program is meant for all tools.
    ///
    /// ## Why it matters
    /// The axes stop at the end of every move. A contour of short segments takes several times as long, and each stop leaves
    /// a mark.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0.
    /// G61
    /// G1 X10. F100.
    /// T2 M6
    /// G0 X0.
    /// G1 Y10. F100.
    /// M30
    /// ```
    /// ```nc,reported,linuxcnc
    /// G21 G90 G0 X0
    /// G61.1
    /// G1 X10 F100
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0.
    /// G61
    /// G1 X10. F100.
    /// G64
    /// T2 M6
    /// G0 X0.
    /// G1 Y10. F100.
    /// M30
    /// ```
    rule "exact-stop-left-on" in "motion" {
        summary: "exact stop left on",
        severity: Info,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS).union(Watch::ENDS),
            make: || Box::new(ModeLeftOn::new(&MODE)),
        },
    }
}

static MODE: Mode = Mode {
    rule: &META,
    role: Role::PathControl,
    on: Effect::ExactStop,
    off: Effect::PathBlending,
    of_tool: "the exact stop",
    at_end: "exact stop",
    switched: "exact stop",
    is_usual_from_head: false,
};

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_end_of_a_program_that_keeps_the_mode() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G0 X0\nG61.1\nG1 X10 F100\nM2\n",
            &expect![[r#"
            4 | M2
              | ^^ info[exact-stop-left-on] exact stop is still on at the end of the program (`G61.1`)
        "#]],
        );
    }

    #[test]
    fn a_mode_from_the_head_is_meant_for_all_tools() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G61\nT1 M6\nG0 X0.\nG1 X1. F10.\nT2 M6\nG1 X2. F10.\nM30\n",
            &expect![[""]],
        );
    }
}
