//! A helix that goes down by more than the tool is wide at each turn.

use gcheck_engine::{At, Axis, Event, Fact};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::facts::edge;
use crate::facts::tool_comment::comment_at_work;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A helix goes down, and at each turn by more than the diameter of the milling cutter.
    ///
    /// ## Why it matters
    /// The cutter is to take its whole diameter and more in depth, in the full: it breaks. Mostly a zero too many is in Z, or
    /// turns are missing. Thread mills go by the pitch of the thread, which is far smaller. Tools are known from the tool table,
    /// `[tools]` or their comments.
    ///
    /// ## Reported
    /// Tool 1 has a diameter of 10 mm:
    /// ```nc,reported,fanuc-mill
    /// G21 G17 G90 G94 G54
    /// T1 M6
    /// G0 X0. Y0. Z2. S3500 M3
    /// G1 Z0. F200.
    /// G3 I15. Z-12. F400.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G17 G90 G94 G54
    /// T1 M6
    /// G0 X0. Y0. Z2. S3500 M3
    /// G1 Z0. F200.
    /// G3 I15. Z-2. F400.
    /// M30
    /// ```
    /// ## How to fix it
    /// * Look for a zero too many in `Z`.
    /// * Or give the helix more turns, each by less than the cutter may go down.
    /// * If the diameter of the tool is wrong, correct it under `[tools]`.
    rule "helix-steeper-than-tool" in "machine" {
        summary: "helix that is steeper than its tool is wide",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ARCS, make: || Box::new(HelixSteeperThanTool::default()) },
    }
}

/// A part of a turn is a ramp, not a helix.
const LEAST_TURNS: f64 = 0.9;

#[derive(Default, Clone, PartialEq)]
struct HelixSteeperThanTool {
    told: Option<At>,
}

remembers!(HelixSteeperThanTool: told);

impl PathRule for HelixSteeperThanTool {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Arc(arc) = event else { return };
        if !cx.is_mill() || arc.expanded || arc.plane != Plane::Xy || self.told == Some(cx.origin().at) {
            return;
        }
        let turns = arc.sweep.abs() / std::f64::consts::TAU;
        let (Some(from), Some(to)) = (arc.from.get(Axis::Z), arc.to.get(Axis::Z)) else { return };
        let pitch = (from - to) / turns;
        // False for a number that is not known. Most arcs are level, and ask for no tool.
        if !(turns >= LEAST_TURNS && pitch > 0.0) {
            return;
        }
        let Some((tool, Mm(diameter), taken)) =
            edge::diameter_or_size(cx).filter(|(_, diameter, _)| pitch > diameter.0)
        else {
            return;
        };
        if comment_at_work(cx).is_some_and(|comment| comment.has(&["THREAD", "THREADMILL", "PROBE", "TAP"])) {
            return;
        }
        self.told = Some(cx.origin().at);
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!("the helix goes down {} at each turn (T{tool})", cx.shown(Mm(pitch))),
            )
            .label(format!("more than the diameter of the tool, {}", cx.shown(Mm(diameter))))
            .help("check Z for a zero too many, or give more turns");
        let finding = match taken {
            Some(taken) => finding.assuming(taken),
            None => finding,
        };
        report.add(cx.resting_on(finding, Fact::Tool, "the tool"));
    }
}
