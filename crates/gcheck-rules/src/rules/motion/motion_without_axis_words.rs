//! A move without the axis words it needs.

use gcheck_engine::{Fault, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A block moves in the active mode, and has none of the axis words that the move needs: an arc by radius without
    /// an axis of its plane, a cycle without a point. The control refuses it.
    ///
    /// `word-choice-missing` judges codes whose page asks for one of several words.
    ///
    /// ## Why it matters
    /// The control stops with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 R5 F100
    /// Z-1 R5
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 R5 F100
    /// X20 R5
    /// M2
    /// ```
    rule "motion-without-axis-words" in "motion" {
        summary: "move without the axis words it needs",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(MotionWithoutAxisWords) },
    }
}

struct MotionWithoutAxisWords;

impl PathRule for MotionWithoutAxisWords {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::NoAxisWords || is_told(cx) {
            return;
        }
        let cycle = cx.state().active_cycle(cx.model).filter(|ix| ix.is_some());
        let motion = || cx.state().mode(Role::Motion).only().filter(|ix| ix.is_some());
        let Some(mode) = cycle.or_else(motion) else { return };
        let code = format!(" (`{}`)", cx.name_of(mode));
        report.add(
            cx.finding(&META, cx.range(), format!("move without the axis words it needs{code}"))
                .label("has words of the move, but no point")
                .help("give the end point, or cancel the mode before this block"),
        );
    }
}

/// Does a code of the block ask for one of several words, and none is there? Then that has been reported.
fn is_told(cx: &PathCx<'_>) -> bool {
    let letters = cx.origin().letters;
    let codes = cx.codes();
    let codes = codes.iter().filter_map(|ix| cx.control().code_at(*ix));
    // That an arc has no centre is reported of one that has axis words.
    codes.filter(|code| code.motion() != gcheck_controls::Motion::Arc).any(|code| {
        let mut lists = code.entry().one_of.iter();
        lists.any(|list| {
            let mut choice = list.iter().filter_map(|letter| gcheck_controls::Letter::parse(letter));
            !choice.any(|letter| letters.contains(letter))
        })
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_block_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G17 G21 G90 G0 X0 Y0 Z10\nG2 X10 R5 F100\nZ-1 R5\nG1 Z0\nM2\n",
            &expect![[r#"
                3 | Z-1 R5
                  | ^^^^^^ error[motion-without-axis-words] move without the axis words it needs (`G2`)
            "#]],
        );
    }

    #[test]
    fn other_controls_keep_the_word() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G0 X0. Y0. Z1.\nG81 X1. Z-.5 R.1 F10.\nR.2\nG80\nM30\n",
            &expect![[""]],
        );
    }
}
