//! The run of a program as a machine makes it: events go to the planner, times come back by section and place.
//!
//! Knows: which section and line a time belongs to. Must not know: how motion is planned, how times are shown.

use gcheck_geometry::{MmPerMin, Seconds};
use gcheck_planner::{Item, Planner, Profile, Shares, Span};

use crate::motion::{Motion, Tracker};
use crate::plan::{Items, Plan};
use crate::slowest::{Place, Slowest};
use crate::step::Step;

/// Where a time belongs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tag {
    pub(crate) section: u32,
    pub(crate) file: u16,
    pub(crate) line: u32,
    pub(crate) kind: Kind,
}

/// What a time is spent on while axes run, or while they do not move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Rapid,
    Cut,
    Stand,
    /// A pocket that the control clears: the axes stop for the planner, and cut for the figures.
    Pocket,
}

/// A stretch of path, or a stand, as the machine runs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// When it begins, from the start of the run.
    pub begin: Seconds,
    profile: Profile,
}

impl Stretch {
    /// Do axes move?
    pub fn is_motion(&self) -> bool {
        self.profile.length > 0.0
    }

    /// When it ends. The next stretch may begin before that.
    pub fn end(&self) -> Seconds {
        self.begin + Seconds(self.profile.seconds)
    }

    /// Speed along the path at a time from the start of the run, within the stretch.
    pub fn speed_at(&self, now: Seconds) -> MmPerMin {
        MmPerMin(self.profile.speed_at((now - self.begin).0) * 60.0)
    }
}

/// Plans a run.
#[derive(Debug, Clone)]
pub(crate) struct Estimate {
    plan: Plan,
    planner: Planner<Tag>,
    items: Items,
    taken: Taken,
}

/// What is kept of the times that are handed out.
#[derive(Debug, Clone, Default)]
struct Taken {
    slowest: Slowest,
    /// Every stretch, where they are asked for: as long as the run.
    stretches: Option<Vec<Stretch>>,
}

impl Estimate {
    pub(crate) fn new(plan: Plan) -> Self {
        let items = Items::new(&plan);
        let mut planner = Planner::new(plan.machine);
        planner.push(items.meeting(), &mut |_| {});
        Self { plan, planner, items, taken: Taken::default() }
    }

    /// An event that moves no axis. `each` gets the shares of time that became certain.
    pub(crate) fn event(
        &mut self,
        step: &Step<'_>,
        surface: bool,
        tag: Tag,
        each: &mut impl FnMut(Tag, &Shares),
    ) {
        let Self { planner, items, taken, .. } = self;
        items.event(step, surface, tag, |item| planner.push(item, &mut |span| hand(taken, span, each)));
    }

    /// A movement; `None` where its time cannot be known, so that the axes stop there.
    pub(crate) fn motion(
        &mut self,
        step: &Step<'_>,
        tracker: &Tracker,
        motion: &Motion,
        asked: Option<Seconds>,
        tag: Tag,
        each: &mut impl FnMut(Tag, &Shares),
    ) {
        let Self { planner, items, taken, .. } = self;
        let mut push = |item: Item<Tag>| planner.push(item, &mut |span| hand(taken, span, each));
        match asked {
            Some(asked) => items.motion(step, tracker, motion, asked, tag, push),
            None => push(Item::Halt),
        }
    }

    /// The axes do not move for a time that the program gives.
    pub(crate) fn pause(&mut self, seconds: Seconds, tag: Tag, each: &mut impl FnMut(Tag, &Shares)) {
        let Self { planner, taken, .. } = self;
        planner.push(Item::Pause { seconds, auxiliary: false, tag }, &mut |span| hand(taken, span, each));
    }

    /// A tool change; `None` where the tool is in the spindle.
    pub(crate) fn change(&mut self, tool: Option<u32>, tag: Tag, each: &mut impl FnMut(Tag, &Shares)) {
        let Self { items, planner, taken, .. } = self;
        planner.push(items.change(tool, tag), &mut |span| hand(taken, span, each));
    }

    /// Nothing comes any more.
    pub(crate) fn finish(&mut self, each: &mut impl FnMut(Tag, &Shares)) {
        let Self { planner, taken, .. } = self;
        planner.finish(&mut |span| hand(taken, span, each));
        taken.slowest.finish();
    }

    pub(crate) const fn plan(&self) -> &Plan {
        &self.plan
    }

    pub(crate) fn places(&self) -> &[Place] {
        self.taken.slowest.places()
    }

    /// Keeps every stretch from here on.
    pub(crate) fn keep_stretches(&mut self) {
        self.taken.stretches = Some(Vec::new());
    }

    pub(crate) fn stretches(&self) -> &[Stretch] {
        self.taken.stretches.as_deref().unwrap_or_default()
    }
}

fn hand(kept: &mut Taken, span: &Span<Tag>, each: &mut impl FnMut(Tag, &Shares)) {
    each(span.tag, &span.shares);
    if let Some(stretches) = &mut kept.stretches {
        stretches.push(Stretch { begin: span.begin, profile: span.profile });
    }
    if matches!(span.tag.kind, Kind::Rapid | Kind::Cut) {
        let taken = span.shares.total();
        kept.slowest.add(Place {
            file: span.tag.file,
            lines: (span.tag.line, span.tag.line),
            cause: span.cause,
            lost: Seconds((taken - span.asked).0.max(0.0)),
            taken,
            moves: u64::from(span.blocks),
            way: span.profile.length,
        });
    }
}
