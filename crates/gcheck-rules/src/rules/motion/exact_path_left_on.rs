//! Exact path that one tool's work leaves on.

use gcheck_controls::Effect;
use gcheck_engine::Role;

use crate::declare::declare_rule;
use crate::facts::mode_left_on::{Mode, ModeLeftOn};
use crate::{Run, Watch};

declare_rule! {
    /// Exact path (`G61`) that the work of one tool switches on is still on when the next tool cuts, or when the program ends, and
    /// the program never goes back to blending (`G64`).
    ///
    /// A mode from the head of the program is meant for all its work, and one after the last cut for what runs next.
    ///
    /// ## Why it matters
    /// The axes slow down at every corner, most of all between short segments. What was meant for one contour makes the rest
    /// of the program, and the next one, take longer.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G94 G64 P0.05
    /// T1 M6
    /// S1000 M3
    /// G0 X0 Y0
    /// G1 X10 F100
    /// G61
    /// Y10
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G94 G61
    /// T1 M6
    /// S1000 M3
    /// G0 X0 Y0
    /// G1 X10 F100
    /// Y10
    /// M2
    /// ```
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G94 G64 P0.05
    /// T1 M6
    /// S1000 M3
    /// G0 X0 Y0
    /// G1 X10 F100
    /// G61
    /// Y10
    /// G64 P0.05
    /// M2
    /// ```
    rule "exact-path-left-on" in "motion" {
        summary: "exact path left on",
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
    on: Effect::ExactPath,
    off: Effect::PathBlending,
    of_tool: "the exact path",
    at_end: "exact path",
    switched: "exact path",
    is_usual_from_head: true,
};

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

    #[test]
    fn the_next_tool_cuts_with_it() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G94\nT1 M6\nG0 X0\nG1 X10 F100\nG61\nY10\nT2 M6\nG1 X20\nX30\nM2\n",
            &expect![[r#"
                8 | G1 X20
                  | ^^^^^^ info[exact-path-left-on] the tool cuts with the exact path of the tool before (`G61`)
            "#]],
        );
    }

    #[test]
    fn the_way_back_has_the_words_with_which_the_program_blends() {
        let fix = |blending: &str| {
            let text = format!("{blending}\nG0 X0\nG1 X10 F100\nG61\nY10\nM2\n");
            let found = findings(&only(&RULE), "linuxcnc", &text, &World::default());
            let [finding] = found.as_slice() else { panic!("{found:?}") };
            (finding.help.clone(), finding.fixes[0].edits[0].text.clone())
        };
        let help =
            |cancel: &str| Some(format!("switch exact path off with `{cancel}` before the program ends"));
        assert_eq!(fix("G21 G90 G94 G64 P0.05"), (help("G64 P0.05"), "G64 P0.05\n".to_owned()));
        assert_eq!(fix("G64 P1\nG21 G64 Q0.02 p.5"), (help("G64 Q0.02 p.5"), "G64 Q0.02 p.5\n".to_owned()));
        assert_eq!(fix("G21 G90 G64"), (help("G64"), "G64\n".to_owned()));
        // In other units, and of another call, the number says something else.
        for blending in
            ["G21 G90 G64 P0.05\nG20", "G21 G90\no100 sub\nG64 P#1\no100 endsub\no100 call [0.05]"]
        {
            assert_eq!(fix(blending), (help("G64"), "G64\n".to_owned()), "{blending}");
        }
    }

    #[test]
    fn what_comes_after_the_last_cut_is_for_the_next_program() {
        check_rule(&RULE, "linuxcnc", "G21 G90 G64\nG0 X0\nG1 X10 F100\nG61\nG0 X0\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_control_that_knows_nothing_else_is_left_alone() {
        check_rule(&RULE, "grbl", "G21 G90 G0 X0\nG1 X10 F100\nG61\nX20\nM2\n", &expect![[""]]);
    }
}
