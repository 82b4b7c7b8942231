//! The first position under the dynamic work offset, with X, Y and Z in one block.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The first position after the dynamic work offset is switched on (`G254`) has X or Y and Z in one block.
    ///
    /// ## Why it matters
    /// The tool comes down while it still goes sideways to a place that the offset has moved, and may meet the part or
    /// the fixture on its way.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0. B90. C0.
    /// G43 H1 Z5.
    /// G254
    /// X1. Y0. Z2.
    /// G255
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y0. B90. C0.
    /// G43 H1 Z5.
    /// G254
    /// X1. Y0.
    /// Z2.
    /// G255
    /// M30
    /// ```
    rule "dynamic-offset-approach-in-one-block" in "five_axis" {
        summary: "approach under the dynamic work offset in one block",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(DynamicOffsetApproach { seen: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct DynamicOffsetApproach {
    /// The block that switched the offset on, when its first move was seen.
    seen: Option<At>,
}

remembers!(DynamicOffsetApproach: seen);

impl PathRule for DynamicOffsetApproach {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::DynamicOffsetOn)
    }

    fn moved(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let role = Role::DynamicOffset;
        let set_by = cx.definitions().set_by(Fact::Mode(role));
        let is_on = cx.state().effect(role, cx.model) == Some(Effect::DynamicOffsetOn);
        if !is_on || set_by.is_none() || self.seen == set_by {
            return;
        }
        self.seen = set_by;
        let letters = cx.origin().letters;
        let is_down_and_sideways =
            letters.intersects(LetterSet::of("Z")) && letters.intersects(LetterSet::of("XY"));
        let Some(code) =
            cx.state().mode(role).only().and_then(|ix| cx.code_of(ix)).filter(|_| is_down_and_sideways)
        else {
            return;
        };
        let name = code.number();
        let finding = cx
            .finding(&META, cx.range(), format!("down and sideways in one block after `{name}`"))
            .label("the first position under the dynamic work offset")
            .note(format!(
                "after `{name}` ({}) X and Y go into one block and Z into the next  [{}]",
                code.entry().title,
                code.entry().source
            ))
            .help("go to X and Y first, then down in a block of its own");
        report.add(cx.resting_on(finding, Fact::Mode(role), &format!("`{name}`")));
    }
}
