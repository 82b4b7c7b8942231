//! A feed for each turn that no milling cutter of this diameter bears.

use gcheck_engine::{At, Event, Fact};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cycles::{drills_by_cycle, is_cycle};
use crate::facts::edge;
use crate::facts::tool_comment::comment_at_work;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A milling cutter goes sideways by more than 13 % of its diameter at each turn of the spindle, or a drill goes down by more
    /// than 8 %.
    ///
    /// ## Why it matters
    /// End mills of two to four teeth bear 1 to 5 % of their diameter for each turn, drills 1 to 4 %. At twice of that they break. A
    /// zero is missing in the speed, or one too many is in the feed. Tools are known from the tool table or `[tools]`, drills from their
    /// comments too; a tool
    /// whose comment calls it a high-feed cutter is not judged.
    ///
    /// ## Reported
    /// Tool 1 has a diameter of 10 mm:
    /// ```nc,reported,fanuc-mill
    /// G21 G17 G90 G94 G54
    /// T1 M6
    /// G0 X0. Y0. Z-5. S3500 M3
    /// G1 X80. F6000.
    /// M30
    /// ```
    /// ```nc,reported,generic-mill
    /// G21 G17 G90 G94 G54
    /// T1 M6
    /// G0 X0. Y0. Z5. S900 M3
    /// G98 G81 Z-25. R3. F1200.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G17 G90 G94 G54
    /// T1 M6
    /// G0 X0. Y0. Z-5. S3500 M3
    /// G1 X80. F600.
    /// M30
    /// ```
    /// ## How to fix it
    /// * Look for a zero too many in `F`, or too few in `S`.
    /// * If the cutter is made for it, call it a high-feed cutter in its comment, or suppress the finding with that
    ///   reason.
    rule "feed-too-large-for-tool" in "machine" {
        summary: "more feed for each turn than the diameter of the cutter bears",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(FeedTooLargeForTool::default()) },
    }
}

/// Of the diameter, for each turn: twice of what soft wood allows two teeth.
const MOST: f64 = 0.13;
/// The same of a drill: twice of what carbide allows.
const MOST_OF_DRILL: f64 = 0.08;
/// Smaller tools are for other materials, or for nothing that this holds for: millimetres.
const SMALLEST: f64 = 3.0;

#[derive(Default, Clone, PartialEq)]
struct FeedTooLargeForTool {
    /// The block that gave feed or speed, whichever is later, where it was reported.
    told: Option<At>,
}

remembers!(FeedTooLargeForTool: told);

impl PathRule for FeedTooLargeForTool {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let drills = matches!(event, Event::Travel(travel) if travel.expanded) && drills_by_cycle(cx);
        if !cx.is_mill()
            || cx.is_called_only()
            || !drills && (!edge::cuts_across(event) || cx.has_effect(is_cycle))
        {
            return;
        }
        let Some((per_turn, turns)) = edge::feed_per_turn(cx) else { return };
        // The comment of a mill may give its shank or its insert as well.
        let size = if drills {
            edge::diameter_or_size(cx)
        } else {
            edge::diameter(cx).map(|(tool, diameter)| (tool, diameter, None))
        };
        let Some((tool, Mm(diameter), taken)) = size else { return };
        let most = if drills { MOST_OF_DRILL } else { MOST };
        if diameter < SMALLEST || per_turn <= diameter * most {
            return;
        }
        let set_by = edge::feed_or_speed_set_by(cx);
        if set_by.is_none() || self.told == set_by {
            return;
        }
        if comment_at_work(cx)
            .is_some_and(|comment| comment.has(&["HIGH", "HIGHFEED", "HFM", "HPC", "HSM", "TAP", "PROBE"]))
        {
            return;
        }
        self.told = set_by;
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!(
                    "the {} is fed {} for each turn (T{tool})",
                    if drills { "drill" } else { "cutter" },
                    edge::fine(cx, per_turn)
                ),
            )
            .label(format!("{:.0} % of its diameter, at {turns:.0} rpm", per_turn / diameter * 100.0))
            .note(format!("the diameter of T{tool} is {}", cx.shown(Mm(diameter))))
            .help("check `F` and `S` for a zero too many or too few");
        let finding = match taken {
            Some(taken) => finding.assuming(taken),
            None => finding,
        };
        let finding = cx.resting_on(finding, Fact::Feed, "the feed");
        report.add(cx.resting_on(finding, Fact::Speed, "the speed"));
    }
}
