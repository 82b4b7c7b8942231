//! Modes restored that were never saved.

use gcheck_engine::Fault;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// `M72` restores modes in a program or subroutine that has not saved any with `M70` or `M73`.
    ///
    /// ## Why it matters
    /// The control stops at the block. Saved modes belong to the subroutine that saved them: it cannot restore those of
    /// its caller.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G90
    /// M72
    /// M2
    /// ```
    /// ```nc,reported,linuxcnc
    /// o1 sub
    /// M72
    /// o1 endsub
    /// M70
    /// o1 call
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// M70
    /// G91
    /// M72
    /// M2
    /// ```
    rule "saved-modes-missing" in "modal" {
        summary: "modes restored that were never saved",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(SavedModesMissing) },
    }
}

struct SavedModesMissing;

impl PathRule for SavedModesMissing {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::NoSavedModes {
            return;
        }
        let range = cx.effect_range(|effect| effect == gcheck_controls::Effect::RestoreModes);
        let finding = cx
            .finding(&META, range, "modes are restored (`M72`) that were never saved")
            .label("nothing is saved here")
            .help("save the modes with `M70` in this program or subroutine first");
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_code_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G90 M72\nM2\n",
            &expect![[r#"
            1 | G90 M72
              |     ^^^ error[saved-modes-missing] modes are restored (`M72`) that were never saved
        "#]],
        );
    }

    #[test]
    fn what_was_forgotten_is_not_there() {
        check_rule(
            &RULE,
            "linuxcnc",
            "M70\nM71\nM72\nM2\n",
            &expect![[r#"
            3 | M72
              | ^^^ error[saved-modes-missing] modes are restored (`M72`) that were never saved
        "#]],
        );
    }
}
