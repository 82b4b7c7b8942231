//! Polar coordinates that the program leaves on.

use gcheck_controls::Effect;
use gcheck_engine::Role;

use crate::declare::declare_rule;
use crate::facts::mode_left_on::{Mode, ModeLeftOn};
use crate::{Run, Watch};

declare_rule! {
    /// Polar coordinates (`G16`) are still on when the program ends, or the next tool cuts with them and the program
    /// never switches them off.
    ///
    /// ## Why it matters
    /// The control reads `X` as a radius and `Y` as an angle: the next program or the next tool moves to the wrong
    /// points.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G17 G16
    /// G1 X50. Y30. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G17 G16
    /// G1 X50. Y30. F100.
    /// G15
    /// M30
    /// ```
    rule "polar-coordinates-left-on" in "offsets" {
        summary: "polar coordinates left on",
        severity: Warning,
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
    role: Role::Polar,
    on: Effect::PolarOn,
    off: Effect::PolarOff,
    of_tool: "the polar coordinates",
    at_end: "programming in polar coordinates",
    switched: "polar coordinates",
    is_usual_from_head: false,
};

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_end_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G17 G16\nG1 X50. Y30. F100.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ warning[polar-coordinates-left-on] programming in polar coordinates is still on at the end of the program (`G16`)
        "#]],
        );
    }

    #[test]
    fn the_first_cut_of_the_next_tool_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG17 G16\nG81 X50. Y30. Z-5. R2. F100.\nG80\nT2 M6\nG1 X10. Y5. F100.\nM30\n",
            &expect![[r#"
                6 | G1 X10. Y5. F100.
                  | ^^^^^^^^^^^^^^^^^ warning[polar-coordinates-left-on] the tool cuts with the polar coordinates of the tool before (`G16`)
            "#]],
        );
    }

    #[test]
    fn a_circle_of_holes_that_ends_is_quiet() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG17 G16\nG81 X50. Y30. Z-5. R2. F100.\nY60.\nG15 G80\nT2 M6\nG1 X10. Y5. F100.\nM30\n",
            &expect![[""]],
        );
    }
}
