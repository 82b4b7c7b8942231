//! Scaling that the program leaves on.

use gcheck_controls::Effect;
use gcheck_engine::Role;

use crate::declare::declare_rule;
use crate::facts::mode_left_on::{Mode, ModeLeftOn};
use crate::{Run, Watch};

declare_rule! {
    /// Scaling is still on when the program ends, or the next tool cuts with it and the program never switches it off.
    ///
    /// ## Why it matters
    /// The next program, the next part or the next tool is cut in another size.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G51 X0. Y0. P2000
    /// G1 X10. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G51 X0. Y0. P2000
    /// G1 X10. F100.
    /// G50
    /// M30
    /// ```
    rule "scaling-left-on" in "offsets" {
        summary: "scaling left on",
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
    role: Role::Scaling,
    on: Effect::ScalingOn,
    off: Effect::ScalingOff,
    of_tool: "the scaling",
    at_end: "scaling",
    switched: "scaling",
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
            "G51 X0. Y0. P2000\nG1 X10. F100.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ warning[scaling-left-on] scaling is still on at the end of the program (`G51`)
        "#]],
        );
    }

    #[test]
    fn the_first_cut_of_the_next_tool_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG51 X0. Y0. P2.\nG1 X1. F10.\nT2 M6\nG0 X2.\nG1 X1. F5.\nM30\n",
            &expect![[r#"
                6 | G1 X1. F5.
                  | ^^^^^^^^^^ warning[scaling-left-on] the tool cuts with the scaling of the tool before (`G51`)
            "#]],
        );
    }

    #[test]
    fn an_end_that_resets_it_is_silent() {
        check_rule(&RULE, "haas-mill", "G51 X0. Y0. P2.\nG1 X1. F10.\nM30\n", &expect![[""]]);
    }
}
