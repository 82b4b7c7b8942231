//! A program that begins its next pass in another mode than the first.

use gcheck_controls::CodeIx;
use gcheck_engine::{Ending, Event, Fact, FrameKind, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A main program that `M99` starts again relies on a mode that it does not set, and ends in another mode.
    ///
    /// ## Why it matters
    /// The first part comes out right and the second one wrong: the next pass begins in `G91`, in another plane, with the
    /// other units.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// T101
    /// G97 S500 M3
    /// G0 X2. Z.1
    /// G98
    /// G1 Z-1. F10.
    /// M99
    /// ```
    /// ## Not reported
    /// The mode is set where the pass begins, or set back.
    /// ```nc,quiet,haas-mill
    /// G90
    /// T1 M6
    /// G0 X1.
    /// G91 G0 X1.
    /// M99
    /// ```
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G0 X1.
    /// G91 G0 X1.
    /// G90
    /// M99
    /// ```
    rule "restart-with-changed-mode" in "modal" {
        summary: "next pass begins in another mode than the first",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES).union(Watch::ENDS),
            make: || Box::new(RestartWithChangedMode::default()),
        },
    }
}

/// Modes that a pass may rely on without setting them.
const RELIED_ON: [Role; 4] = [Role::Distance, Role::Plane, Role::Units, Role::FeedMode];

#[derive(Default, Clone, PartialEq)]
struct RestartWithChangedMode {
    /// What was not set until the first move.
    relied_on: Vec<(Role, CodeIx)>,
    /// A program that changes tools or starts the spindle is not a subprogram.
    is_main: bool,
}

remembers!(RestartWithChangedMode);

impl PathRule for RestartWithChangedMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn moved(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        cx.enough();
        for role in RELIED_ON {
            if cx.definitions().set_by(Fact::Mode(role)).is_none()
                && let Some(code) = cx.state().mode(role).only()
                && code.is_some()
            {
                self.relied_on.push((role, code));
            }
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.is_main |= matches!(event, Event::ToolChange(_) | Event::Spindle(_))
            && cx.state().frames().iter().all(|frame| frame.kind == FrameKind::Main);
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ending != Ending::Restart || !self.is_main {
            return;
        }
        for (role, first) in &self.relied_on {
            let Some(last) = cx.state().mode(*role).only().filter(|last| last != first) else { continue };
            let control = cx.control();
            let (Some(first), Some(last)) = (control.code_at(*first), control.code_at(last)) else {
                continue;
            };
            let (was, is) = (&first.entry().code, &last.entry().code);
            let finding = cx
                .finding(
                    &META,
                    cx.range(),
                    format!("the next pass begins with `{is}`, the first with `{was}`"),
                )
                .label("starts the program again")
                .assuming(format!("`{was}` is in effect at the start"))
                .help(format!("set `{was}` at the top of the program, or before this block"));
            report.add(cx.resting_on(finding, Fact::Mode(*role), &format!("`{is}`")));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_return_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG0 X1.\nG91 X1.\nM99\n",
            &expect![[r#"
            4 | M99
              | ^^^ info[restart-with-changed-mode] the next pass begins with `G91`, the first with `G90`
        "#]],
        );
    }

    #[test]
    fn a_subprogram_leaves_its_modes_to_its_caller() {
        check_rule(&RULE, "haas-mill", "O100\nG0 X1.\nG91 X1.\nM99\n", &expect![[""]]);
    }
}
