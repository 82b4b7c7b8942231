//! 5-axis tool length compensation with incremental words.

use gcheck_engine::Role;

use crate::declare::declare_rule;
use crate::facts::five_axis::{increments_finding, length_and_increments};
use crate::facts::modes::{ActiveMode, resting_on_mode};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// 5-axis length compensation (`G143`) is switched on under incremental words (`G91`), or `G91` is switched on
    /// while it is active.
    ///
    /// ## Why it matters
    /// The control computes the positions of the axes from the absolute point and the tilt of the tool. It cannot do so
    /// from increments, and does not accept `G91`.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G91 G0 Z1.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G91
    /// G143 H1 X0. Y0. Z1. A0. B0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G49
    /// G91 G28 Z0.
    /// M30
    /// ```
    rule "five-axis-length-in-incremental" in "five_axis" {
        summary: "5-axis length compensation with incremental words",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(FiveAxisLengthInIncremental) },
    }
}

struct FiveAxisLengthInIncremental;

impl PathRule for FiveAxisLengthInIncremental {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some([ActiveMode::Certain(length), ActiveMode::Certain(increments)]) = length_and_increments(cx)
        else {
            return;
        };
        let control = cx.control();
        let (Some(length), Some(increments)) = (control.code_at(length), control.code_at(increments)) else {
            return;
        };
        let message = format!("incremental words under 5-axis length compensation (`{}`)", length.number());
        let finding = increments_finding(cx, &META, message, length, increments);
        let finding = resting_on_mode(cx, finding, Role::Length);
        report.add(resting_on_mode(cx, finding, Role::Distance));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn both_in_one_block() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G143 H1 X1. Y1. Z1. A5. B5.\nM30\n",
            &expect![[r#"
                1 | G91 G143 H1 X1. Y1. Z1. A5. B5.
                  | ^^^ error[five-axis-length-in-incremental] incremental words under 5-axis length compensation (`G143`)
            "#]],
        );
    }

    #[test]
    fn ended_in_the_same_block_it_is_over() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X1. Y1. Z1. A5. B5.\nG91 G49 G0 Z1.\nG90 G143 H1 Z2.\nG91 H0 Z1.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn in_a_subprogram_the_call_is_shown() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X1. Y1. Z1. A5. B5.\nM97 P10\nG49\nM30\nN10 G91 G1 X1. F10.\nG90\nM99\n",
            &expect![[r#"
                5 | N10 G91 G1 X1. F10.
                  |     ^^^ error[five-axis-length-in-incremental] incremental words under 5-axis length compensation (`G143`)
            "#]],
        );
    }

    #[test]
    fn on_some_path_only_is_left_to_the_sibling() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90\nIF [#500 EQ 1] GOTO 10\nG91\nN10 G143 H1 X1. Y1. Z1. A5. B5.\nM30\n",
            &expect![[""]],
        );
    }
}
