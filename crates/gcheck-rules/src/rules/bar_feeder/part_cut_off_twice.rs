//! A part that is cut off, and then cut off again by the bar feed.

use gcheck_engine::{Event, Frame};

use crate::declare::declare_rule;
use crate::facts::bar_feed::{bar_feeder, is_bar_feed, lengths};
use crate::facts::parting::Parting;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The program parts off, and the next bar feed calls a cutoff program that parts off again (`G105 P…`).
    ///
    /// ## Why it matters
    /// The second cut is made in the air, or takes a disc off the next part.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// O1
    /// G20
    /// G0 X2.1 Z-1.625
    /// G1 X-0.04 F0.004
    /// G0 X6.
    /// G105 J1.75 P2
    /// M99
    /// O2
    /// G0 X2.1 Z-1.625
    /// G1 X-0.04 F0.004
    /// G0 X6.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// O1
    /// G20
    /// G0 X2.1 Z0.1
    /// G1 Z-1.5 F0.01
    /// G0 X6.
    /// G105 J1.75 P2
    /// M99
    /// O2
    /// G0 X2.1 Z-1.625
    /// G1 X-0.04 F0.004
    /// G0 X6.
    /// M99
    /// ```
    rule "part-cut-off-twice" in "bar_feeder" {
        summary: "part cut off by the program and by the bar feed",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::MOVES),
            make: || Box::new(PartCutOffTwice { before: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct PartCutOffTwice {
    /// The last parting cut of the program itself since the bar was fed.
    before: Option<Parting>,
}

remembers!(PartCutOffTwice: before);

impl PathRule for PartCutOffTwice {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_bar_feed)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if bar_feeder(cx).is_none() {
            return;
        }
        let Some(parting) = Parting::of(cx, event) else { return };
        if !cx.state().frames().iter().any(Frame::is_cutoff) {
            self.before = Some(parting);
            return;
        }
        let Some(before) = self.before.take() else { return };
        let mut finding = cx
            .finding(&META, cx.range(), "part is cut off a second time")
            .label("cuts off again")
            .help("part off in the cutoff program or before the feed, not in both");
        if let Some(range) = cx.range_of(before.at) {
            finding = finding.also(range, "cut off here");
        }
        report.add(finding);
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if lengths(event).is_some() {
            self.before = None;
        }
    }
}
