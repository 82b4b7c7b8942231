//! A rotation that the program leaves on.

use gcheck_controls::Effect;
use gcheck_engine::Role;

use crate::declare::declare_rule;
use crate::facts::mode_left_on::{Mode, ModeLeftOn};
use crate::{Run, Watch};

declare_rule! {
    /// The rotation of coordinates is still on when the program ends, or the next tool cuts with it and the program
    /// never switches it off.
    ///
    /// ## Why it matters
    /// The next program, the next part or the next tool is cut rotated.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G68 X0. Y0. R30.
    /// G1 X10. F100.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G68 X0. Y0. R30.
    /// G1 X1. F10.
    /// T2 M6
    /// G1 X1. F5.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G68 X0. Y0. R30.
    /// G1 X10. F100.
    /// G69
    /// M30
    /// ```
    /// Some controls switch it off themselves at the end of the program.
    /// ```nc,quiet,haas-mill
    /// G68 X0. Y0. R30.
    /// G1 X1. F10.
    /// M30
    /// ```
    /// A rotation from the head of the program is meant for all tools.
    /// ```nc,quiet,haas-mill
    /// G68 X0. Y0. R30.
    /// T1 M6
    /// G1 X1. F10.
    /// T2 M6
    /// G1 X1. F5.
    /// M30
    /// ```
    rule "rotation-left-on" in "offsets" {
        summary: "rotation left on",
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
    role: Role::Rotation,
    on: Effect::RotationOn,
    off: Effect::RotationOff,
    of_tool: "the rotation",
    at_end: "the rotation",
    switched: "the rotation",
    is_usual_from_head: false,
};

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_subprogram_leaves_it_on() {
        let program = |after: &str| {
            format!(
                "T1 M6\nM98 P100\n{after}G1 X10. F100.\nG1 Z5.\nM30\nO100\nG68 X0. Y0. R30.\nG1 X5. F100.\nM99\n"
            )
        };
        let found = findings(&only(&RULE), "fanuc-mill", &program(""), &World::default());
        expect![[r#"
            the rotation is still on at the end of the program (`G68`)
              here: what runs next begins with it
              there: `G68` set here
              there: the first cut with it after the subprogram
              assuming: the end of the program keeps it, as the control's book leaves to a parameter
              help: switch the rotation off with `G69` before the program ends
              fix (unsafe): put `G69` in a block before this one
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("T2 M6\n"),
            &expect![[r#"
            4 | G1 X10. F100.
              | ^^^^^^^^^^^^^ warning[rotation-left-on] the tool cuts with the rotation of the tool before (`G68`)
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("G69\n"), &expect![[""]]);
    }

    #[test]
    fn the_end_is_marked_and_the_code_named() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G68 X0. Y0. R30.\nG1 X10. F100.\nG0 Z50. M30\n",
            &expect![[r#"
            3 | G0 Z50. M30
              |         ^^^ warning[rotation-left-on] the rotation is still on at the end of the program (`G68`)
        "#]],
        );
    }

    #[test]
    fn off_on_some_path_is_not_on() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G68 X0. Y0. R30.\nIF [#1 EQ 1] GOTO 5\nG69\nN5 M30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn the_first_cut_of_the_next_tool_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG68 X0. Y0. R30.\nG1 X1. F10.\nT2 M6\nG0 X2.\nG1 X1. F5.\nT3 M6\nG1 X1. F5.\nM30\n",
            &expect![[r#"
                6 | G1 X1. F5.
                  | ^^^^^^^^^^ warning[rotation-left-on] the tool cuts with the rotation of the tool before (`G68`)
            "#]],
        );
    }

    #[test]
    fn a_rotation_that_ends_somewhere_may_be_meant_to_last_until_there() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG68 X0. Y0. R30.\nG1 X1. F10.\nT2 M6\nG1 X1. F5.\nG69\nM30\n",
            &expect![[""]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG68 X0. Y0. R30.\nG1 X1. F10.\nT2 M6\nG68 X0. Y0. R60.\nG1 X1. F5.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_it_says() {
        let found =
            findings(&only(&RULE), "fanuc-mill", "G68 X0. Y0. R30.\nG1 X10. F100.\nM30\n", &World::default());
        expect![[r#"
            the rotation is still on at the end of the program (`G68`)
              here: what runs next begins with it
              there: `G68` set here
              assuming: the end of the program keeps it, as the control's book leaves to a parameter
              help: switch the rotation off with `G69` before the program ends
              fix (unsafe): put `G69` in a block before this one
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
