//! A threading tool that goes back along its thread.

use gcheck_engine::{At, Axis, Event, Fact, Position, Role, TravelKind};

use crate::declare::declare_rule;
use crate::facts::tool_words::ToolWords;
use crate::facts::turning::is_turned;
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A lathe has cut a thread in one pass (`G32`, `G33`), and the tool goes back along Z at rapid before it has left the thread
    /// in X.
    ///
    /// ## Why it matters
    /// The tip is dragged back through the turns that it has just cut, and no longer in step with the spindle. Thread and insert are
    /// lost. Mostly the block that draws the tool out in X is missing.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0101
    /// G97 S500 M3
    /// G0 X29. Z5.
    /// G32 Z-20. F1.5
    /// G0 Z5.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0101
    /// G97 S500 M3
    /// G0 X29. Z5.
    /// G32 Z-20. F1.5
    /// G0 X40.
    /// Z5.
    /// M30
    /// ```
    rule "thread-left-along" in "motion" {
        summary: "tool goes back along the thread that it has just cut",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(ThreadLeftAlong::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ThreadLeftAlong {
    last: Option<Pass>,
}

remembers!(ThreadLeftAlong: last);

/// A pass of a thread with no move after it: X and Z of its start and its end, millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pass {
    from: [f64; 2],
    to: [f64; 2],
    at: At,
}

remembers!(Pass: at);

/// A way across that leaves no thread: millimetres.
const ACROSS: f64 = 0.1;
/// Threads are less tapered: across by along.
const STEEP: f64 = 0.15;
/// A way along that leaves a turn: millimetres.
const ALONG: f64 = 1.0;

impl PathRule for ThreadLeftAlong {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let last = self.last.take();
        let Event::Travel(travel) = event else { return };
        let (from, to) = (spot(&travel.from), spot(&travel.to));
        if travel.kind == TravelKind::Thread && !travel.expanded {
            self.last = Some(Pass { from, to, at: cx.origin().at });
            return;
        }
        let Some(pass) = last.filter(|_| travel.kind == TravelKind::Rapid && cx.is_on_every_path()) else {
            return;
        };
        // A die that opens by itself goes back as it came.
        if travel.expanded || !goes_back(&pass, to) || ToolWords::of(cx).follows_its_pitch() {
            return;
        }
        let mut finding = cx
            .finding(&META, cx.range(), "the tool goes back along the thread that it has just cut")
            .label("no move in X has drawn it out");
        if let Some(range) = cx.range_of(pass.at) {
            finding = finding.also(range, "the thread");
        }
        let finding = finding.help("draw the tool out in X first, in a block of its own (`G0 X…`)");
        report.add(cx.resting_on(finding, Fact::Mode(Role::Motion), "rapid motion"));
    }
}

/// Does a way from the end of the pass lead back over it, no further across than the thread itself leads there?
fn goes_back(pass: &Pass, to: [f64; 2]) -> bool {
    let (x, z) = (pass.to[0] - pass.from[0], pass.to[1] - pass.from[1]);
    let back = to[1] - pass.to[1];
    let is_back = z.abs() > ALONG && back * z < 0.0 && back.abs() > ALONG;
    // Of a tapered thread the way back along it is slanted. A steep pass is the pull-out at the end of a thread.
    let across = to[0] - pass.to[0];
    let is_thread = x.abs() <= z.abs() * STEEP;
    is_back && is_thread && (across.abs() < ACROSS || (across - x * back / z).abs() < ACROSS)
}

fn spot(at: &Position) -> [f64; 2] {
    [at.raw(Axis::X), at.raw(Axis::Z)]
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(out: &str) -> String {
        format!("G21 G99 T0101\nG97 S500 M3\nG0 X29. Z5.\nG32 Z-20. F1.5\n{out}G0 X60.\nM30\n")
    }

    #[test]
    fn back_at_the_depth_of_the_thread() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("G0 Z5.\n"),
            &expect![[r#"
            5 | G0 Z5.
              | ^^^^^^ warning[thread-left-along] the tool goes back along the thread that it has just cut
        "#]],
        );
        for out in [
            "G0 X40.\nZ5.\n",
            "G0 X40. Z5.\n",
            "G0 Z-25.\n",
            "G32 X40. F1.5\nG0 Z5.\n",
            "G32 X40. Z-22. F1.5\nG0 Z5.\n",
            "",
        ] {
            check_rule(&RULE, "fanuc-lathe", &program(out), &expect![[""]]);
        }
    }

    #[test]
    fn a_tapered_thread() {
        let tapered = |out: &str| program(out).replace("G32 Z-20.", "G32 X31. Z-20.");
        check_rule(
            &RULE,
            "fanuc-lathe",
            &tapered("G0 Z5.\n"),
            &expect![[r#"
            5 | G0 Z5.
              | ^^^^^^ warning[thread-left-along] the tool goes back along the thread that it has just cut
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            &tapered("G0 X29. Z5.\n"),
            &expect![[r#"
            5 | G0 X29. Z5.
              | ^^^^^^^^^^^ warning[thread-left-along] the tool goes back along the thread that it has just cut
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &tapered("G0 X35.\nZ5.\n"), &expect![[""]]);
    }

    #[test]
    fn with_a_spindle_in_step_on_linuxcnc() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G7 G18 G21 G90 G95 G97\nT1 M6 G43\nS300 M3\nG0 X29 Z5\nG33 Z-20 K1.5\nG0 Z5\nM2\n",
            &expect![[r#"
                6 | G0 Z5
                  | ^^^^^ warning[thread-left-along] the tool goes back along the thread that it has just cut
            "#]],
        );
    }
}
