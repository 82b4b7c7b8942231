//! Calls that nest without end.

use gcheck_engine::{Fault, FrameKind};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// Calls nest deeper than the control allows; most often a program that calls itself, directly or through another.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the call.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// M98 P2
    /// M30
    /// O0002
    /// G91 G0 X1.
    /// M98 P2
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// M98 P2 L5
    /// M30
    /// O0002
    /// M98 P3
    /// M99
    /// O0003
    /// M99
    /// ```
    rule "calls-nested-too-deep" in "flow" {
        summary: "calls nested too deep",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(CallsNestedTooDeep) },
    }
}

struct CallsNestedTooDeep;

impl PathRule for CallsNestedTooDeep {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::TooDeep {
            return;
        }
        let frames = cx.state().frames();
        let calls_itself = frames.last().is_some_and(|last| {
            let entries =
                frames.iter().filter(|frame| frame.kind != FrameKind::Main && frame.entry == last.entry);
            entries.count() > 1
        });
        let message =
            if calls_itself { "program calls itself without end" } else { "calls are nested too deep" };
        let note = match cx.control().limits().call_depth {
            Some(depth) => format!("this control nests calls {depth} deep"),
            None => format!(
                "{} calls are open here, more than any control of this family allows",
                frames.len() - 1
            ),
        };
        let help = if calls_itself {
            "end the recursion: jump or loop instead of calling"
        } else {
            "call from higher up"
        };
        // All calls that led here are alike: their places would not help.
        let finding =
            crate::Finding::new(&META, cx.range(), message).label("one call too many").note(note).help(help);
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_call_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nM97 P10\nM30\nN10 G0 X1.\nM97 P10\nM99\n",
            &expect![[r#"
            5 | M97 P10
              | ^^^^^^^ error[calls-nested-too-deep] program calls itself without end
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 sub\no1 call\no1 endsub\no1 call\nM2\n",
            &expect![[r#"
            2 | o1 call
              | ^^^^^^^ error[calls-nested-too-deep] program calls itself without end
        "#]],
        );
    }

    #[test]
    fn two_programs_that_call_each_other() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nM98 P2\nM30\nO2\nM98 P3\nM99\nO3\nM98 P2\nM99\n",
            &expect![[r#"
            8 | M98 P2
              | ^^^^^^ error[calls-nested-too-deep] program calls itself without end
        "#]],
        );
    }

    #[test]
    fn a_recursion_that_a_variable_ends() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\n#100=3\nM98 P2\nM30\nO2\n#100=#100-1\nIF [#100 LE 0] GOTO 9\nM98 P2\nN9 M99\n",
            &expect![[""]],
        );
    }
}
