//! What a lathe program has turned so far, and which of it is the outside of the part or a bore.
//!
//! Knows: the cuts of every path up to a move, as long as all of them are known, and how the tool came to each and left it.
//! A thread leaves the diameters as they were turned.
//! Must not know: any rule, stock, the shape of tools.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{At, Axis, Event, Fact, Position, Role, Spindle, Stop, Travel, TravelKind};

use crate::facts::live_tool::builders_since;
use crate::facts::parting::{Along, Parting};
use crate::facts::second_spindle::swaps;
use crate::facts::tool_words::ToolWords;
use crate::facts::turning::{is_roughing, turns, turns_the_part};
use crate::facts::workholding::{changes_part, changes_part_at};
use crate::{PathCx, SharedMemory, remembers};

/// X as a radius, and Z: millimetres.
pub(crate) type Spot = [f64; 2];

/// Radii and levels that differ by less are one: millimetres.
pub(crate) const SLACK: f64 = 0.05;
/// So far inside a surface, and under the zero of the part, a place is in the part: millimetres.
pub(crate) const UNDER: f64 = 1.0;

/// Cuts that are kept. Longer programs come from a system.
const MOST: usize = 2000;
/// A tool that comes in by more than this may come from its change, to a bore as well: millimetres, of the radius.
const STEP: f64 = 6.0;
/// Half the width of a tool that plunges, at most: millimetres.
const WIDTH: f64 = 6.0;
/// Blocks between two moves that are looked at.
const BETWEEN: u32 = 60;
/// A bore does not leave less of the part than this: millimetres.
const THIN: f64 = 3.0;
/// A facing cut goes past the centre by less: millimetres, of the radius.
const PAST_CENTRE: f64 = 2.0;

/// What was cut so far, as far as it is known throughout.
#[derive(Default, Clone, PartialEq)]
pub(crate) struct Turned {
    cuts: Vec<Cut>,
    chain: Option<Chain>,
    /// Where the tool is; NaN where that is not known.
    last: Option<Spot>,
    /// The block that moves, and the radius at which it began, where that is known.
    block: Option<(At, Option<f64>)>,
    tool: Option<At>,
    frame: Option<(u16, [u64; 2])>,
    blind: bool,
}

remembers!(Turned: cuts, block, tool);

/// A cut, with both ends.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cut {
    pub(crate) ends: [Spot; 2],
    pub(crate) bytes: Range<u32>,
    side: Side,
    tool: Option<At>,
}

remembers!(Cut: bytes, tool);

/// Which side of the part a cut along Z is on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Side {
    Unknown,
    Outside,
    Inside,
}

/// Cuts one after the other, without a rapid move between them.
#[derive(Clone, PartialEq)]
struct Chain {
    /// The radius before the rapid move that leads to them, and after it, if that is a move in X alone beside the part.
    approach: Option<[f64; 2]>,
    /// The first of its cuts.
    first: usize,
}

impl SharedMemory for Turned {
    fn moved(&mut self, cx: &PathCx<'_>, event: &Event) {
        if self.blind || !turns(cx) {
            return;
        }
        let is_known = cx.is_certain();
        if !is_known || self.cuts.len() >= MOST {
            *self = Self { blind: true, ..Self::default() };
            return;
        }
        let frame = frame(cx);
        if self.frame != frame {
            *self = Self { frame, ..Self::default() };
        }
        if self.is_before_other_part(cx) {
            self.forget();
        }
        let tool = cx.definitions().set_by(Fact::Tool);
        if self.tool != tool {
            (self.tool, self.chain, self.last) = (tool, None, None);
        }
        let is_turning = turns_the_part(cx);
        let (to, kind, is_expanded) = match event {
            Event::Travel(travel) => (end(cx, travel), travel.kind, travel.expanded),
            Event::Arc(arc) => (spot(&arc.programmed), TravelKind::Feed, arc.expanded),
            _ => {
                self.blind |= is_turning;
                (self.chain, self.last) = (None, None);
                return;
            }
        };
        if !is_turning {
            (self.chain, self.last) = (None, None);
            return;
        }
        let from = self.last.replace(to).unwrap_or([f64::NAN; 2]);
        let at = cx.origin().at;
        if self.block.is_none_or(|(block, _)| block != at) {
            self.block = Some((at, Some(from[0]).filter(|radius| !radius.is_nan())));
        }
        match kind {
            TravelKind::Rapid => self.rapid(from, to),
            TravelKind::Thread => {}
            // A bar stop or a puller: the bar moves with it, or to it.
            _ if is_pushed(cx) => self.forget(),
            _ => self.cut(cx, from, to, is_expanded),
        }
        if Parting::of(cx, event).is_some_and(|parting| self.along().is_turned(&parting)) {
            self.forget();
        }
    }

    fn block(&mut self, cx: &PathCx<'_>) {
        if swaps(cx) || changes_part(cx) {
            self.forget();
        }
    }

    fn moved_elsewhere(&mut self, event: &Event) {
        (self.chain, self.last) = (None, None);
        // What was cut there is not known.
        if !matches!(event, Event::Travel(travel) if travel.kind == TravelKind::Rapid) {
            *self = Self { blind: true, ..Self::default() };
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event) {
        if self.is_other(cx, event) {
            self.forget();
        }
    }
}

/// Does the tool move at feed while the program has stopped the spindle? Then it cuts nothing.
fn is_pushed(cx: &PathCx<'_>) -> bool {
    let is_stopped = cx.state().spindle() == Some(Spindle::Stopped);
    is_stopped && cx.definitions().set_by(Fact::Spindle).is_some() && ToolWords::of(cx).may_move_bar()
}

/// After this, the part is another one, or elsewhere in the chuck; for rules that share [`Turned`].
pub(crate) fn is_other_part(cx: &PathCx<'_>, event: &Event) -> bool {
    match cx.shared::<Turned>() {
        Some(turned) => turned.is_other(cx, event),
        None => Turned::default().is_other(cx, event),
    }
}

impl Turned {
    /// Is everything known that was cut up to here, and does the part turn under a tool that does not?
    pub(crate) fn knows(&self, cx: &PathCx<'_>) -> bool {
        let is_one_frame = self.frame.is_some() && self.frame == frame(cx);
        !self.blind && is_one_frame && turns_the_part(cx) && !self.is_before_other_part(cx)
    }

    /// Does a block between the last move and this one bring another part?
    fn is_before_other_part(&self, cx: &PathCx<'_>) -> bool {
        let here = cx.origin().at;
        let Some(last) = self.block.map(|(at, _)| at).filter(|at| at.file == here.file) else { return false };
        let first = (last.block + 1).max(here.block.saturating_sub(BETWEEN));
        (first..here.block).any(|block| changes_part_at(cx, At { block, ..here }))
    }

    /// Where the tool is before the move that is shown.
    pub(crate) fn here(&self) -> Option<Spot> {
        self.last.filter(|spot| spot.iter().all(|coordinate| !coordinate.is_nan()))
    }

    /// For [`PathRule::shares`](crate::PathRule::shares).
    pub(crate) fn shared() -> Box<dyn SharedMemory> {
        Box::new(Self::default())
    }

    /// The memory of this in an analysis whose rules share it, unless nothing can be known any more: then the rule has seen
    /// enough.
    pub(crate) fn of<'a>(cx: &PathCx<'a>) -> Option<&'a Self> {
        let turned = cx.shared::<Self>().filter(|turned| !turned.blind);
        if turned.is_none() {
            cx.enough();
        }
        turned
    }

    /// The radius at which the block began whose move is shown.
    pub(crate) fn block_begins(&self, cx: &PathCx<'_>) -> Option<f64> {
        match self.block {
            Some((at, radius)) if at == cx.origin().at => radius,
            _ => self.here().map(|[radius, _]| radius),
        }
    }

    /// After this, is the part another one, or elsewhere in the chuck? Programs name the work offset in effect again for each tool.
    fn is_other(&self, cx: &PathCx<'_>, event: &Event) -> bool {
        match event {
            // While the program is stopped, the operator may turn the part round.
            Event::Chuck(_)
            | Event::BarFeed(_)
            | Event::BarPush(_)
            | Event::Stop(Stop::Program | Stop::Message(_)) => true,
            Event::WorkOffset { number, .. } => {
                let is_named = cx.has_effect(|effect| matches!(effect, Effect::WorkOffset(_)));
                let is_same = self.frame.is_some_and(|(own, _)| own == *number);
                let moved = self.block.map_or(0, |(at, _)| at.block);
                !(is_named && is_same) || builders_since(cx, moved)
            }
            _ => false,
        }
    }

    /// Another part, or the same one elsewhere in the chuck.
    fn forget(&mut self) {
        *self = Self { blind: self.blind, frame: self.frame, ..Self::default() };
    }

    fn rapid(&mut self, from: Spot, to: Spot) {
        // Along Z out of the part, farther from the centre than all that it cut, no tool leaves a bore.
        let clears = (from[0] - to[0]).abs() < SLACK && to[1] > SLACK;
        self.mark(Some(to[0] - from[0]).filter(|_| is_level(from, to)), clears);
        let is_beside = is_level(from, to) && to[1] > -SLACK;
        let is_along = (from[0] - to[0]).abs() < SLACK;
        let approach = if is_beside && !is_along {
            Some([from[0], to[0]])
        } else {
            // Along Z the tool stays at its radius.
            self.chain.take().and_then(|chain| chain.approach).filter(|_| is_along)
        };
        self.chain = Some(Chain { approach, first: self.cuts.len() });
    }

    fn cut(&mut self, cx: &PathCx<'_>, from: Spot, to: Spot, is_expanded: bool) {
        if from.iter().chain(&to).any(|coordinate| coordinate.is_nan()) {
            *self = Self { blind: true, ..Self::default() };
            return;
        }
        // A tool that is fed to its diameter before the face comes there as one that goes there at rapid.
        let is_empty = self.chain.as_ref().is_none_or(|chain| chain.first == self.cuts.len());
        let is_before_face = is_level(from, to) && to[1] > SLACK;
        // One that is fed up to the face cuts nothing that is left when the part is faced.
        let is_up_to_face = (from[0] - to[0]).abs() < SLACK && from[1] > SLACK && to[1] > -SLACK;
        if is_empty && !is_expanded && (is_before_face || is_up_to_face) {
            self.rapid(from, to);
            return;
        }
        let side = self.side_of(cx, [from, to], is_expanded);
        self.cuts.push(Cut { ends: [from, to], bytes: cx.range(), side, tool: self.tool });
        // Fed out to where it came from, the tool has cut the outside.
        let came_from = self.chain.as_ref().and_then(|chain| chain.approach).map(|[before, _]| before);
        if !is_expanded && came_from.is_some_and(|before| to[0] > before - SLACK) {
            self.mark(None, false);
        }
    }

    /// On which side of the part is a cut, before it is made?
    pub(crate) fn side_of(&self, cx: &PathCx<'_>, [from, to]: [Spot; 2], is_expanded: bool) -> Side {
        // A shoulder of a bore goes on where the bore ends.
        let goes_on = self.cuts.last().filter(|cut| cut.side == Side::Inside && is_one(cut.ends[1], from));
        match goes_on {
            _ if is_deep(from, to) => self.side(cx, from, to, is_expanded),
            Some(_) => Side::Inside,
            None => Side::Unknown,
        }
    }

    /// Does a cut plunge straight across into what was turned, from outside of it: into a groove that is not made yet?
    pub(crate) fn plunges(&self, from: Spot, to: Spot) -> bool {
        let Some((wall, _)) = self.outside_along(to[1]) else { return false };
        // Begun inside the wall it is the way out of a bore, or the end of a shoulder.
        let is_from_outside = from[0] > wall - SLACK;
        let is_into = to[0] > SLACK && to[0] < wall - UNDER;
        let is_across = is_level(from, to) && to[1] < -UNDER;
        is_across && is_from_outside && is_into && !self.is_opened_beside(to[1], to[0])
    }

    /// Does this cut part off what was turned?
    pub(crate) fn is_parted(&self, parting: &Parting) -> bool {
        self.along().is_parted(parting)
    }

    fn along(&self) -> Along {
        let mut along = Along::NOTHING;
        for cut in self.cuts.iter().filter(|cut| cut.is_surface()) {
            along.add(cut.ends[0][1], cut.ends[1][1]);
        }
        along
    }

    /// The radius to which the part was faced down to its centre, and where that face is: below it the part is solid, as far
    /// as no hole was made.
    fn face(&self) -> Option<&Cut> {
        self.cuts.iter().rev().find(|cut| cut.is_face_to_centre())
    }

    /// On which side is a cut along Z, as far as it shows before the tool leaves it?
    fn side(&self, cx: &PathCx<'_>, from: Spot, to: Spot, is_expanded: bool) -> Side {
        let radius = from[0].min(to[0]);
        if radius < UNDER {
            return Side::Unknown;
        }
        if is_expanded {
            // A cycle comes from the side where the stock is to be taken off.
            let is_cycle = cx.has_effect(is_roughing) || is_turning_pass(cx);
            let begins = self.block_begins(cx).unwrap_or(f64::NAN);
            return match begins - radius {
                _ if !is_cycle => Side::Unknown,
                way if way > SLACK => Side::Outside,
                way if way < -SLACK => Side::Inside,
                _ => Side::Unknown,
            };
        }
        let words = ToolWords::of(cx);
        if words.bores() {
            return Side::Inside;
        }
        let approach = self.chain.as_ref().and_then(|chain| chain.approach);
        let step = approach.filter(|[_, to]| (to - from[0]).abs() < SLACK).map(|[before, to]| before - to);
        let comes_in = step.is_some_and(|step| step > SLACK && step < STEP);
        let is_straight = (from[0] - to[0]).abs() < SLACK;
        // A part that was faced to its centre has no bore.
        let is_outer = comes_in || self.face().is_some();
        if is_outer && is_straight && !words.may_bore() && !self.has_hole(to[1]) {
            Side::Outside
        } else {
            Side::Unknown
        }
    }

    /// The sides of a chain of cuts, by how the tool leaves them; `out` is its way in X, if it leaves in X alone.
    fn mark(&mut self, out: Option<f64>, clears: bool) {
        let leaves = self.leaves(out);
        let is_clear = clears && leaves == Side::Outside && out.is_none();
        let Some(chain) = &self.chain else { return };
        let Some(cuts) = self.cuts.get_mut(chain.first..) else { return };
        let [before, begins] = chain.approach.unwrap_or([f64::NAN; 2]);
        let side = match leaves {
            Side::Outside if before > begins + SLACK || is_clear => Side::Outside,
            Side::Inside if before < begins - SLACK => Side::Inside,
            _ => return,
        };
        for cut in cuts.iter_mut().filter(|cut| cut.side == Side::Unknown) {
            // Of an outside, only what is along Z is a surface.
            if side == Side::Outside && !cut.is_surface() {
                continue;
            }
            cut.side = side;
        }
    }

    /// To which side a tool leaves what it cut since its last rapid move, by where the cuts end and by its way in X from there.
    pub(crate) fn leaves(&self, out: Option<f64>) -> Side {
        let cuts = self.chain.as_ref().and_then(|chain| self.cuts.get(chain.first..)).unwrap_or_default();
        let deep = cuts.iter().filter(|cut| is_deep(cut.ends[0], cut.ends[1]));
        let radii = deep.flat_map(|cut| cut.ends.map(|[radius, _]| radius));
        let (least, most) =
            radii.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), r| (least.min(r), most.max(r)));
        let end = cuts.last().map_or(f64::NAN, |cut| cut.ends[1][0]);
        let goes_in = out.is_some_and(|out| out < -SLACK);
        let leaves_out =
            end > most + SLACK && !goes_in || end > most - SLACK && out.is_some_and(|out| out > SLACK);
        let leaves_in = end < least - SLACK || end < least + SLACK && out.is_some_and(|out| out < -SLACK);
        match (leaves_out, leaves_in) {
            (true, false) => Side::Outside,
            (false, true) => Side::Inside,
            _ => Side::Unknown,
        }
    }

    /// May there be a hole as deep as this?
    fn has_hole(&self, z: f64) -> bool {
        self.cuts.iter().any(|cut| (cut.side == Side::Inside || cut.is_centre()) && cut.reaches(z))
    }

    /// The radius of the bore at this level, and the cut that made it.
    pub(crate) fn bore(&self, z: f64) -> Option<(f64, &Cut)> {
        let at = self.cuts.iter().filter(|cut| cut.side == Side::Inside && cut.spans(z));
        let walls = at.map(|cut| (cut.radius(), cut));
        walls.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The radius that the outside of the part has at this level after all cuts, as far as it was cut there, and the cut that
    /// left it.
    pub(crate) fn least_outside(&self, z: f64) -> Option<(f64, &Cut)> {
        self.outside(z).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The radius to which the outside of the part was turned along Z at this level, whatever went into it across, and the cut that
    /// left it.
    pub(crate) fn outside_along(&self, z: f64) -> Option<(f64, &Cut)> {
        let along = self.outside(z).filter(|(_, cut)| cut.side == Side::Outside && cut.is_surface());
        along.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The same, if it is certain that no later cut went along there: one whose side is not known may have been of the outside
    /// too.
    pub(crate) fn finished_along(&self, z: f64) -> Option<(f64, &Cut)> {
        let (radius, cut) = self.outside_along(z)?;
        let may_be_finish = |(own, cut): (f64, &Cut)| cut.side == Side::Unknown && own < radius - SLACK;
        (!self.outside(z).any(may_be_finish)).then_some((radius, cut))
    }

    /// The end away from the chuck of all that was cut along Z.
    pub(crate) fn front(&self) -> Option<f64> {
        let along = self.cuts.iter().filter(|cut| cut.front() - cut.back() > UNDER);
        along.map(Cut::front).max_by(f64::total_cmp)
    }

    /// Cuts from outside that came by this level, with the radius that each has there.
    fn outside(&self, z: f64) -> impl Iterator<Item = (f64, &Cut)> {
        let is_outside = |cut: &&Cut| cut.side != Side::Inside && !cut.is_centre();
        self.cuts.iter().filter(is_outside).filter_map(move |cut| Some((cut.radius_at(z)?, cut)))
    }

    /// Did another cut across go through this radius beside this level, so that a tool has room there?
    fn is_opened_beside(&self, z: f64, radius: f64) -> bool {
        self.cuts.iter().any(|cut| {
            let [[r0, z0], [r1, _]] = cut.ends;
            let away = (z0 - z).abs();
            is_level(cut.ends[0], cut.ends[1]) && r0.min(r1) < radius + SLACK && away > SLACK && away < WIDTH
        })
    }

    /// Was the part cut through this radius near this level, from at least `by` outside of it, so that a tool can go in or out there?
    pub(crate) fn is_open_across(&self, z: f64, radius: f64, by: f64) -> bool {
        self.cuts.iter().any(|cut| {
            let [[r0, z0], [r1, z1]] = cut.ends;
            let is_across = r0.min(r1) < radius + SLACK && r0.max(r1) > radius + by;
            is_across && z0.min(z1) - WIDTH < z && z < z0.max(z1) + WIDTH
        })
    }

    /// The outside of the part that a straight way goes through, with the cut that made it.
    pub(crate) fn outside_crossed(&self, from: Spot, to: Spot) -> Option<&Cut> {
        let [[r0, z0], [r1, z1]] = [from, to];
        if r1 >= r0 || z1 > -UNDER || self.is_cut_to(to) {
            return None;
        }
        self.cuts.iter().rev().find(|cut| {
            let radius = cut.radius();
            if cut.side != Side::Outside || r0 < radius - SLACK || r1 > radius - UNDER || !cut.spans(z1) {
                return false;
            }
            let through = z0 + (r0 - radius) / (r0 - r1) * (z1 - z0);
            let face = cut.front().min(0.0);
            if through <= face + SLACK {
                return true;
            }
            // Through the face, so near the outside that no bore leaves as little.
            let at_face = r0 + (z0 - face) / (z0 - z1) * (r1 - r0);
            radius - at_face < THIN && at_face > r1 + UNDER && !self.has_hole(z1)
        })
    }

    /// Is a way outward, off the wall of a bore, in front of the zero of the part or down to it, or outside of what was turned
    /// along Z at its ends? Along a face it is not, unless that was cut.
    pub(crate) fn is_in_air(&self, from: Spot, to: Spot) -> bool {
        let in_bore = self.bore(from[1]).is_some_and(|(wall, _)| from[0] < wall + SLACK);
        let is_outward = to[1] > from[1] + SLACK && to[0] > from[0] - SLACK;
        let is_cut = || self.least_outside(to[1]).is_some_and(|(radius, _)| radius < from[0] + SLACK);
        let is_up = is_level(from, to) && to[0] > from[0] + SLACK && (to[1] < -SLACK || is_cut());
        let is_off_bore = in_bore && is_level(from, to) && to[0] < from[0] - SLACK;
        let is_before_face = from[1] > SLACK && to[1] > -SLACK;
        let is_beside =
            |spot: Spot| self.outside_along(spot[1]).is_some_and(|(wall, _)| spot[0] > wall + SLACK);
        is_outward || is_up && !in_bore || is_off_bore || is_before_face || is_beside(from) && is_beside(to)
    }

    /// Was the part cut as near to the centre as this place, at the same level?
    pub(crate) fn is_cut_at(&self, [radius, z]: Spot) -> bool {
        self.least_outside(z).is_some_and(|(least, _)| least < radius + SLACK)
    }

    /// The face that a straight way goes through into solid material.
    pub(crate) fn face_crossed(&self, from: Spot, to: Spot) -> Option<&Cut> {
        let [[_, z0], [r1, z1]] = [from, to];
        let face = self.face()?;
        let [radius, level] = [face.radius(), face.ends[0][1]];
        // A facing tool may have gone past the centre.
        let is_into = z0 > level - SLACK && z1 < level - UNDER && r1 < radius - UNDER && r1 > -PAST_CENTRE;
        // Other faces open nothing below this one.
        let is_open = self.cuts.iter().any(|cut| !cut.is_face_to_centre() && cut.opens(to));
        (is_into && !is_open && !self.has_hole(z1)).then_some(face)
    }

    /// The face below which a pass of a cycle begins: across at rapid, toward the centre, where nothing was cut.
    pub(crate) fn face_passed(&self, from: Spot, to: Spot) -> Option<&Cut> {
        let face = self.face()?;
        let [radius, level] = [face.radius(), face.ends[0][1]];
        let is_behind = is_level(from, to) && to[1] < level - UNDER;
        let is_into = to[0] < from[0] - UNDER && to[0] < radius - UNDER && to[0] > UNDER;
        let is_cut = |cut: &Cut| cut.back() < level - SLACK && cut.opens(to);
        (is_behind && is_into && !self.has_hole(to[1]) && !self.cuts.iter().any(is_cut)).then_some(face)
    }

    /// The outside that a straight way inward enters where nothing was cut as deep: not at the end of what was turned, and not near a
    /// neck.
    pub(crate) fn outside_entered(&self, from: Spot, to: Spot) -> Option<&Cut> {
        let [radius, z] = to;
        let is_inward = is_level(from, to) && radius < from[0] - SLACK;
        let is_neck = |cut: &Cut| {
            let [[r0, z0], [r1, z1]] = cut.ends;
            let is_across = r0.min(r1) < radius + SLACK && r0.max(r1) > radius;
            is_across && !cut.is_face_to_centre() && z0.min(z1) - WIDTH < z && z < z0.max(z1) + WIDTH
        };
        if !is_inward
            || z > -UNDER
            || self.has_hole(z)
            || self.is_opened_to(to)
            || self.cuts.iter().any(is_neck)
        {
            return None;
        }
        let is_wall = |cut: &&Cut| {
            let is_beside = cut.spans(z - UNDER) && cut.spans(z + UNDER);
            let least = cut.ends[0][0].min(cut.ends[1][0]);
            cut.side == Side::Outside && is_beside && least > radius + SLACK && from[0] > least - SLACK
        };
        self.cuts.iter().rev().find(is_wall)
    }

    /// The outside that a way along Z runs into which goes on at rapid where the tool has cut at feed: the cut before it ended there, at
    /// the same radius.
    pub(crate) fn outside_ahead(&self, from: Spot, to: Spot) -> Option<&Cut> {
        let last = self.cuts.last()?;
        let [[_, z0], [r1, z1]] = [from, to];
        let goes_on = is_one(last.ends[1], from)
            && last.is_straight()
            && last.is_surface()
            && last.side != Side::Inside;
        let is_ahead = (from[0] - r1).abs() < SLACK && z1 < z0 - UNDER && r1 > UNDER;
        if !goes_on || !is_ahead || self.has_hole(z1) || self.is_opened_to(to) {
            return None;
        }
        let is_wall = |cut: &&Cut| {
            let is_below = cut.spans(z1) && cut.back() < z0 - UNDER;
            cut.side == Side::Outside && is_below && cut.radius() > r1 + UNDER
        };
        self.cuts.iter().rev().find(is_wall)
    }

    /// Was the part cut as near to the centre as this place, and at its level?
    fn is_opened_to(&self, [radius, z]: Spot) -> bool {
        self.outside(z - UNDER)
            .chain(self.outside(z + UNDER))
            .chain(self.outside(z))
            .any(|(least, _)| least < radius + SLACK)
            || self.is_open_across(z, radius, 0.0)
    }

    /// The shoulder that a way along Z runs into from the front: outside of what is turned before it, or so near the outside that
    /// no bore leaves as little.
    pub(crate) fn shoulder_crossed(&self, from: Spot, to: Spot) -> Option<&Cut> {
        let [[r0, z0], [r1, z1]] = [from, to];
        if (r0 - r1).abs() > SLACK
            || z1 > z0 - UNDER
            || z1 > -UNDER
            || self.is_cut_to(to)
            || self.has_hole(z1)
        {
            return None;
        }
        let is_beside = |cut: &Cut| {
            let lies_between = cut.front() < z0 + SLACK && cut.back() > z1 + UNDER;
            cut.side == Side::Outside && lies_between && cut.radius() < r1 - SLACK
        };
        let from_outside = self.cuts.iter().any(is_beside);
        let may_be_tube = self.is_faced_like_a_tube();
        self.cuts.iter().rev().find(|cut| {
            let radius = cut.radius();
            let front = cut.front().min(0.0);
            let is_thin = radius - r1 < THIN && !may_be_tube;
            let is_wall = radius > r1 + UNDER && (from_outside || is_thin);
            cut.side == Side::Outside && cut.spans(z1) && z0 > front - SLACK && is_wall
        })
    }

    /// Does the last cut along the face end before the centre?
    fn is_faced_like_a_tube(&self) -> bool {
        let is_face = |cut: &&Cut| {
            let [from, to] = cut.ends;
            is_level(from, to) && to[0] < from[0] - UNDER && to[1] > -UNDER
        };
        self.cuts.iter().rev().find(is_face).is_some_and(|cut| cut.ends[1][0] > UNDER)
    }

    /// The outside that a slanting way out of the part may meet: axes that leave together need not arrive together.
    pub(crate) fn outside_beside(&self, from: Spot, to: Spot) -> Option<&Cut> {
        let [[r0, z0], [r1, z1]] = [from, to];
        if z0 > -UNDER || z1 < SLACK || r1 > r0 - SLACK {
            return None;
        }
        let is_met = |cut: &&Cut| {
            let radius = cut.radius();
            let deepest = cut.back();
            let is_on_the_way = deepest < -UNDER && cut.front() > z0 + UNDER;
            cut.side == Side::Outside && is_on_the_way && r0 > radius - SLACK && r1 < radius - UNDER
        };
        self.cuts.iter().rev().find(is_met).filter(|_| !self.is_cut_to([r1, z0]))
    }

    /// Was the part cut as near to the centre as this place, and as deep, from outside?
    fn is_cut_to(&self, spot: Spot) -> bool {
        self.cuts.iter().any(|cut| cut.opens(spot))
    }

    /// How deep the tools before this one have gone along the centre; zero without any.
    pub(crate) fn depth_at_centre(&self, tool: Option<At>) -> f64 {
        let at = self.cuts.iter().filter(|cut| cut.tool != tool && cut.is_centre());
        at.map(Cut::back).fold(0.0, f64::min)
    }
}

impl Cut {
    /// Its larger radius.
    pub(crate) fn radius(&self) -> f64 {
        self.ends[0][0].max(self.ends[1][0])
    }

    /// Its end away from the chuck.
    fn front(&self) -> f64 {
        self.ends[0][1].max(self.ends[1][1])
    }

    /// At one radius.
    pub(crate) fn is_straight(&self) -> bool {
        (self.ends[0][0] - self.ends[1][0]).abs() < SLACK
    }

    /// Its end nearer to the chuck.
    fn back(&self) -> f64 {
        self.ends[0][1].min(self.ends[1][1])
    }

    /// Does it come as near to the centre as this place, and as deep, from outside?
    fn opens(&self, [radius, z]: Spot) -> bool {
        let least = self.ends[0][0].min(self.ends[1][0]);
        let is_hole = self.side == Side::Inside || self.is_centre();
        let depth = self.back();
        !is_hole && least <= radius + SLACK && depth <= z + WIDTH
    }

    /// Along the centre: a hole.
    fn is_centre(&self) -> bool {
        let [[r0, _], [r1, _]] = self.ends;
        r0.abs() < SLACK && r1.abs() < SLACK && is_deep(self.ends[0], self.ends[1])
    }

    /// Along X, from outside to the centre.
    fn is_face_to_centre(&self) -> bool {
        let [from, to] = self.ends;
        is_level(from, to) && to[0] < SLACK && from[0] > UNDER
    }

    /// Along Z, not at the centre.
    fn is_surface(&self) -> bool {
        let [from, to] = self.ends;
        is_deep(from, to) && from[0].min(to[0]) > UNDER
    }

    /// Its radius at this level; the least where it goes straight across. `None` beside it.
    fn radius_at(&self, z: f64) -> Option<f64> {
        let [[r0, z0], [r1, z1]] = self.ends;
        if is_level(self.ends[0], self.ends[1]) {
            return ((z0 - z).abs() < SLACK).then_some(r0.min(r1));
        }
        let is_there = (z0.min(z1) - SLACK..=z0.max(z1) + SLACK).contains(&z);
        is_there.then(|| r0 + (z - z0) / (z1 - z0) * (r1 - r0))
    }

    fn spans(&self, z: f64) -> bool {
        let [[_, z0], [_, z1]] = self.ends;
        is_deep(self.ends[0], self.ends[1]) && (z0.min(z1) - SLACK..=z0.max(z1) + SLACK).contains(&z)
    }

    fn reaches(&self, z: f64) -> bool {
        self.back() < z + UNDER
    }
}

/// X as a radius, and Z, of a position.
pub(crate) fn spot(position: &Position) -> Spot {
    [position.raw(Axis::X), position.raw(Axis::Z)]
}

/// Where a move ends, as it is programmed; a move to a place of the machine ends where the axes are then.
pub(crate) fn end(cx: &PathCx<'_>, travel: &Travel) -> Spot {
    spot(if cx.has_effect(Effect::goes_to_machine_place) { &travel.to } else { &travel.programmed })
}

/// A move in X alone.
pub(crate) fn is_level(from: Spot, to: Spot) -> bool {
    (from[1] - to[1]).abs() < SLACK
}

/// The same place.
pub(crate) fn is_one(a: Spot, b: Spot) -> bool {
    (a[0] - b[0]).abs() < SLACK && (a[1] - b[1]).abs() < SLACK
}

/// A cut along Z into the part.
fn is_deep(from: Spot, to: Spot) -> bool {
    from[1] - to[1] > UNDER && to[1] < -UNDER
}

fn is_turning_pass(cx: &PathCx<'_>) -> bool {
    cx.state().effect(Role::Motion, cx.model) == Some(Effect::TurningPass)
}

/// What the coordinates count from: the work offset, and the shift as bits.
fn frame(cx: &PathCx<'_>) -> Option<(u16, [u64; 2])> {
    let shift = cx.state().shift();
    cx.state().work().map(|work| (work, [Axis::X, Axis::Z].map(|axis| shift.raw(axis).to_bits())))
}
