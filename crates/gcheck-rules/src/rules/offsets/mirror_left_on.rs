//! A mirror that the program leaves on.

use gcheck_controls::Effect;
use gcheck_engine::Role;

use crate::declare::declare_rule;
use crate::facts::mode_left_on::{Mode, ModeLeftOn};
use crate::{Run, Watch};

declare_rule! {
    /// A mirror image is still on when the program ends, or the next tool cuts with it and the program never switches
    /// it off.
    ///
    /// ## Why it matters
    /// The next program, the next part or the next tool cuts a mirror image, and conventional milling becomes climb
    /// milling.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G51.1 X0.
    /// G1 X10. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G51.1 X0.
    /// G1 X10. F100.
    /// G50.1 X0.
    /// M30
    /// ```
    rule "mirror-left-on" in "offsets" {
        summary: "mirror image left on",
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
    role: Role::Mirror,
    on: Effect::MirrorOn,
    off: Effect::MirrorOff,
    of_tool: "the mirror image",
    at_end: "the mirror image",
    switched: "the mirror",
    is_usual_from_head: false,
};

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

    #[test]
    fn the_end_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G51.1 X0.\nG1 X10. F100.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ warning[mirror-left-on] the mirror image is still on at the end of the program (`G51.1`)
        "#]],
        );
    }

    #[test]
    fn a_mirror_of_another_control() {
        check_rule(
            &RULE,
            "haas-mill",
            "G101 X0.\nG1 X1. F10.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ warning[mirror-left-on] the mirror image is still on at the end of the program (`G101`)
        "#]],
        );
    }

    #[test]
    fn one_axis_is_switched_off_and_the_other_stays() {
        let program = |off: &str| format!("G51.1 X0.\nG51.1 Y0.\nG1 X10. F100.\n{off}\nG1 X0.\nM30\n");
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G50.1 X0."),
            &expect![[r#"
            6 | M30
              | ^^^ warning[mirror-left-on] the mirror image is still on at the end of the program (`G51.1`)
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("G50.1 X0. Y0."), &expect![[""]]);
        let found = findings(&only(&RULE), "fanuc-mill", &program("G50.1 X0."), &World::default());
        assert_eq!(found[0].labels[0].range.start, 10, "switched on in the second block: {found:#?}");
    }

    /// What switched another axis off does not switch this one off.
    #[test]
    fn the_help_names_no_axis_of_an_earlier_block() {
        let text = "G21 G90 G54 G17\nT1 M6\nG0 X0. Y0. S1000 M3\nG51.1 X0.\nG1 Z-1. F100.\nX10.\nG50.1 X0.\nG51.1 Y0.\nY10.\nM30\n";
        let found = findings(&only(&RULE), "fanuc-mill", text, &World::default());
        let help = found.first().and_then(|finding| finding.help.clone()).unwrap_or_default();
        assert!(help.contains("`G50.1`") && !help.contains("X0"), "{found:#?}");
    }
}
