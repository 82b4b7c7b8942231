//! What a 5-axis mode refuses.

use std::collections::BTreeSet;

use gcheck_controls::CodeIx;
use gcheck_engine::At;

use crate::declare::declare_rule;
use crate::facts::five_axis::{Clash, clash_finding, clashes, switched_on_by, uses_five_axis_modes};
use crate::facts::modes::{ActiveMode, resting_on_mode};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Under 5-axis tool length compensation (`G143`) or 3D cutter compensation (`G141`) a block asks for what they exclude: an
    /// arc, a canned cycle, a pocket, a probing move, cutter compensation in a plane.
    ///
    /// ## Why it matters
    /// Both work with straight moves (`G0`, `G1`) only. The control stops with an alarm, with the tool at the part.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G2 X1. Y1. R1. F20.
    /// G49
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.
    /// G81 X1. Y1. Z-.5 R.1 F10.
    /// G80
    /// G40
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G31 Z-1. F10.
    /// G49
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G1 X1. Y1. Z0. A5. B5. F20.
    /// G49
    /// G2 X2. Y2. R1.
    /// G31 Z-1. F10.
    /// M30
    /// ```
    rule "refused-in-five-axis-mode" in "five_axis" {
        summary: "refused under 5-axis tool length or 3D cutter compensation",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::ALL_BLOCKS,
            make: || Box::new(RefusedInFiveAxisMode { told: BTreeSet::new() }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct RefusedInFiveAxisMode {
    /// Findings that were reported, by the block that switched the mode on.
    told: BTreeSet<(At, CodeIx)>,
}

remembers!(RefusedInFiveAxisMode: told);

impl PathRule for RefusedInFiveAxisMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !uses_five_axis_modes(cx) {
            cx.enough();
            return;
        }
        for clash in clashes(cx) {
            let Clash { mode: ActiveMode::Certain(mode), code, is_certain: true, .. } = clash else {
                continue;
            };
            if !self.told.insert((switched_on_by(cx, mode), code)) {
                continue;
            }
            let Some(finding) = clash_finding(cx, &META, &clash, "") else { continue };
            let finding = if clash.is_assumed { finding } else { resting_on_mode(cx, finding, clash.role) };
            report.add(finding);
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn everything_that_a_length_along_the_tool_excludes() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nG2 X1. Y1. R1. F20.\nG03 X2. Y2. R1.\nX3. Y3. R1.\nG81 Z-1. R.1\nX4.\nG80\n\
             G13 I1. D1\nG150 P100 X0. Y0. Z-1. R.1 Q.2 I.2 D1\nG0 G41 D1 X1.\nG40 X0.\nG0 X5. Y5. Z5.\nG2 X1. Y1. R1.\nG49\nG3 X2. R1.\nM30\n\
             O100\nM99\n",
            &expect![[r#"
                2 | G2 X1. Y1. R1. F20.
                  | ^^ error[refused-in-five-axis-mode] arc (`G2`) under `G143`
                3 | G03 X2. Y2. R1.
                  | ^^^ error[refused-in-five-axis-mode] arc (`G3`) under `G143`
                5 | G81 Z-1. R.1
                  | ^^^ error[refused-in-five-axis-mode] canned cycle (`G81`) under `G143`
                8 | G13 I1. D1
                  | ^^^ error[refused-in-five-axis-mode] pocket (`G13`) under `G143`
                9 | G150 P100 X0. Y0. Z-1. R.1 Q.2 I.2 D1
                  | ^^^^ error[refused-in-five-axis-mode] pocket (`G150`) under `G143`
                10 | G0 G41 D1 X1.
                   |    ^^^ error[refused-in-five-axis-mode] cutter compensation (`G41`) under `G143`
            "#]],
        );
    }

    #[test]
    fn probing_and_other_moves_of_the_control() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nG31 Z-1. F10.\nG35 D1 X1. F10.\nG37 Z0. F10. H1\nG47 P0 (A) X0. Y0. J0.1 Z-.1 R.1 F5.\nG184 X1. F.05 S500\nM30\n",
            &expect![[r#"
                2 | G31 Z-1. F10.
                  | ^^^ error[refused-in-five-axis-mode] probing (`G31`) under `G143`
                3 | G35 D1 X1. F10.
                  | ^^^ error[refused-in-five-axis-mode] probing (`G35`) under `G143`
                4 | G37 Z0. F10. H1
                  | ^^^ error[refused-in-five-axis-mode] probing (`G37`) under `G143`
                5 | G47 P0 (A) X0. Y0. J0.1 Z-.1 R.1 F5.
                  | ^^^ error[refused-in-five-axis-mode] engraving (`G47`) under `G143`
                6 | G184 X1. F.05 S500
                  | ^^^^ error[refused-in-five-axis-mode] tapping (`G184`) under `G143`
            "#]],
        );
    }

    #[test]
    fn switched_on_while_something_is_active() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G2 X1. Y1. R1. F20.\nG143 H1 X1. Y1. Z1. A0. B0.\nG49\nG81 X1. Z-1. R.1\nG143 H1 X1. Y1. Z1. A0. B0.\nG49\n\
             G80 G0 X1.\nG81 X1. Z-1. R.1\nG0 G143 H1 X1. Y1. Z1. A0. B0.\nG49\nM30\n",
            &expect![[r#"
                2 | G143 H1 X1. Y1. Z1. A0. B0.
                  | ^^^^ error[refused-in-five-axis-mode] arc (`G2`) under `G143`
                5 | G143 H1 X1. Y1. Z1. A0. B0.
                  | ^^^^ error[refused-in-five-axis-mode] arc (`G2`) under `G143`
                5 | G143 H1 X1. Y1. Z1. A0. B0.
                  | ^^^^ error[refused-in-five-axis-mode] canned cycle (`G81`) under `G143`
            "#]],
        );
    }

    #[test]
    fn along_vectors() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG2 X1. Y1. R1.\nG83 Z-1. R.1 Q.2\nG80\nG1 X2. I0. J0. K1.\nG42 D1 X3.\nG40 X0.\nM30\n",
            &expect![[r#"
                2 | G2 X1. Y1. R1.
                  | ^^ error[refused-in-five-axis-mode] arc (`G2`) under `G141`
                3 | G83 Z-1. R.1 Q.2
                  | ^^^ error[refused-in-five-axis-mode] canned cycle (`G83`) under `G141`
                6 | G42 D1 X3.
                  | ^^^ warning[refused-in-five-axis-mode] cutter compensation (`G42`) under `G141`
            "#]],
        );
    }

    #[test]
    fn both_together_are_a_warning() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nG49\nM30\n",
            &expect![[r#"
                2 | G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.
                  |    ^^^^ warning[refused-in-five-axis-mode] 3D cutter compensation (`G141`) under `G143`
            "#]],
        );
    }

    #[test]
    fn in_a_subprogram_and_behind_a_block_skip() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nM97 P10\n/G81 Z-1. R.1 F10.\nG80\nG49\nM30\nN10 G3 X1. R1. F10.\nM99\n",
            &expect![[r#"
                3 | /G81 Z-1. R.1 F10.
                  |  ^^^ error[refused-in-five-axis-mode] canned cycle (`G81`) under `G143`
                7 | N10 G3 X1. R1. F10.
                  |     ^^ error[refused-in-five-axis-mode] arc (`G3`) under `G143`
            "#]],
        );
    }

    #[test]
    fn what_it_says() {
        let program = "G90 G143 H1 X0. Y0. Z1. A0. B0.\nG2 X1. Y1. R1. F20.\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            arc (`G2`) under `G143`
              here: `G143` works with straight moves only
              there: `G143` set here
              note: under `G143` (5-axis tool length compensation) only `G0` and `G1` can be used  [Haas 96-8000 rev AC May 2010 p.184; Haas online manual, g143-5-axis-tool-length-compensation; gcodes.net, G143; HM17 p.313]
              help: end `G143` with `G49` before `G2`
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
