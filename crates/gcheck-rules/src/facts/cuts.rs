//! What a program has cut so far on a mill, as straight cuts in the plane with their depths.
//!
//! Knows: the cuts of every path up to a move, as long as all of them are known. Must not know: any rule, stock, fixtures.

use std::cell::Cell;

use gcheck_controls::Effect;
use gcheck_engine::{At, Axis, Event, Fact, Position, TravelKind};

use crate::facts::compensation::is_compensated;
use crate::facts::cycles::is_round_pocket;
use crate::facts::edge::diameter_or_size;
use crate::facts::shared_list::SharedList;
use crate::{PathCx, SharedMemory, remembers};

/// Levels that differ by less are one: millimetres.
pub(crate) const LEVEL: f64 = 1e-4;
/// Depths above this are the surface of the part: millimetres.
pub(crate) const SURFACE: f64 = -0.01;

/// How far beside its path a cutter clears.
#[derive(Clone, PartialEq)]
pub(crate) struct Clear {
    /// Millimetres.
    pub(crate) radius: f64,
    /// What that rests on.
    pub(crate) assumption: Option<String>,
}

impl Clear {
    /// Of the tool in the spindle; an inch across if its size is unknown.
    pub(crate) fn of(cx: &PathCx<'_>) -> Self {
        match diameter_or_size(cx) {
            Some((_, diameter, assumption)) => Self { radius: diameter.0 / 2.0, assumption },
            None => Self::unknown(),
        }
    }

    /// Of the tool in the spindle, with what cuts of tools of unknown size rest on.
    pub(crate) fn among(cx: &PathCx<'_>, cuts: &Cuts) -> Self {
        let own = Self::of(cx);
        let of_others = || cuts.has_unknown.then(Self::unknown)?.assumption;
        Self { assumption: own.assumption.or_else(of_others), ..own }
    }

    fn unknown() -> Self {
        Self { radius: WIDE, assumption: Some("no cutter is wider than 25.4 mm (1 in)".to_owned()) }
    }
}

/// How far beside its path a cutter of unknown size may clear: millimetres.
pub(crate) const WIDE: f64 = 12.7;

/// The radius of the tool in the spindle, as the tables have it or else its comment: millimetres.
pub(crate) fn cutter_radius(cx: &PathCx<'_>) -> Option<f64> {
    diameter_or_size(cx).map(|(_, diameter, _)| diameter.0 / 2.0)
}

/// What was cut so far, as far as it is known throughout.
#[derive(Default, Clone, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts of the cuts")]
pub(crate) struct Cuts {
    list: SharedList<Cut>,
    /// Work offset and shift that the coordinates count from.
    frame: Option<Frame>,
    /// Where the last move ended.
    last: Option<[f64; 3]>,
    /// Where it ended as it is programmed.
    programmed: Option<[f64; 3]>,
    /// It ended beside that, by a distance that is unknown.
    is_beside: bool,
    /// One of the cuts ran beside its path, by a distance that is unknown.
    has_beside: bool,
    /// The tool that has cut last, with its radius; zero for one of unknown size.
    tool: Option<(Option<At>, f64)>,
    /// One of the tools that have cut is of unknown size.
    has_unknown: bool,
    /// Something unknown was moved, so that no later question has an answer.
    blind: bool,
    /// The frame of the move that is shown, if everything is known up to it. Many rules ask; `None` before the first one does.
    #[expect(clippy::option_option, reason = "not yet asked, or asked and not known")]
    known: Cell<Option<Option<Frame>>>,
}

/// The work offset, and the shift as bits.
type Frame = (u16, [u64; 3]);

fn frame(cx: &PathCx<'_>) -> Option<Frame> {
    let shift = cx.state().shift();
    cx.state().work().map(|work| (work, [Axis::X, Axis::Y, Axis::Z].map(|axis| shift.raw(axis).to_bits())))
}

/// A straight cut.
#[derive(Clone, PartialEq)]
pub(crate) struct Cut {
    from: [f64; 2],
    to: [f64; 2],
    /// The lower end.
    z: f64,
    /// How far beside it the tool may have cut: a path beside the programmed one, by a size that is not known.
    beside: f64,
    /// The radius of the tool that has cut. Of one of unknown size it is zero in a hole, and as wide as any where it goes sideways.
    radius: f64,
}

impl Cut {
    /// Is it as deep as a level, or deeper?
    pub(crate) fn is_below(&self, z: f64) -> bool {
        self.z <= z + LEVEL
    }

    /// Did its tool, or one of this radius, come to a place?
    pub(crate) fn reaches(&self, at: [f64; 2], radius: f64) -> bool {
        distance_to_line(at, self.from, self.to) <= radius.max(self.radius) + self.beside
    }
}

/// Cuts that differ in depth by more are two, and points that are nearer to a cut are on it: millimetres.
const SHALLOWER: f64 = 0.1;
/// So far from its ends a cut is in the part: millimetres. A face mill starts and ends beside the part by less.
const INNER: f64 = 50.0;
/// No cutter runs farther beside its programmed path: millimetres.
const MOST_BESIDE: f64 = 25.4;
/// Cuts that are kept. Programs with more of them come from a system that plans its rapid moves.
const MAX_CUTS: usize = 20_000;

remembers!(Cuts: tool);

impl SharedMemory for Cuts {
    fn moved(&mut self, cx: &PathCx<'_>, event: &Event) {
        if self.blind {
            return;
        }
        let known = self.known_frame(cx, event);
        self.known.set(None);
        match known {
            Some(frame) => {
                self.frame = Some(frame);
                self.add(cx, event);
                if self.list.len() > MAX_CUTS {
                    self.give_up();
                }
            }
            None => self.give_up(),
        }
    }
}

impl Cuts {
    /// For [`PathRule::shares`](crate::PathRule::shares).
    pub(crate) fn shared() -> Box<dyn SharedMemory> {
        Box::new(Self::default())
    }

    /// Is everything known that was cut up to this move?
    pub(crate) fn knows(&self, cx: &PathCx<'_>, event: &Event) -> bool {
        !self.blind && self.known_frame(cx, event).is_some()
    }

    /// The frame of this move, if everything is known that was cut up to it.
    fn known_frame(&self, cx: &PathCx<'_>, event: &Event) -> Option<Frame> {
        if let Some(known) = self.known.get() {
            return known;
        }
        let frame = frame(cx).filter(|frame| self.knows_up_to(cx, event, *frame));
        self.known.set(Some(frame));
        frame
    }

    fn knows_up_to(&self, cx: &PathCx<'_>, event: &Event, frame: Frame) -> bool {
        if !cx.is_mill() || !cx.is_on_every_path() {
            return false;
        }
        let from = match event {
            Event::Travel(travel) => &travel.from,
            Event::Arc(arc) => &arc.from,
            _ => &Position::UNKNOWN,
        };
        // Cuts of another frame, in another file, or on another path: where they were is not known here.
        match self.frame {
            Some(own) if own != frame => self.list.is_empty(),
            // Z may jump when a tool offset comes into effect.
            _ => !matches!((self.last, point(from)), (Some(last), Some(from)) if is_apart(last, from)),
        }
    }

    /// Forgets everything for good: the old cuts are useless, and would make memories of equal edits differ.
    fn give_up(&mut self) {
        *self = Self { blind: true, ..Self::default() };
    }

    /// Keeps what a move cuts.
    fn add(&mut self, cx: &PathCx<'_>, event: &Event) {
        let (from, to, cuts) = match event {
            Event::Travel(travel) => (&travel.from, &travel.to, travel.kind != TravelKind::Rapid),
            Event::Arc(arc) => (&arc.from, &arc.to, true),
            _ => (&Position::UNKNOWN, &Position::UNKNOWN, true),
        };
        self.last = point(to);
        let flat = |position: &Position| Some([position.get(Axis::X)?, position.get(Axis::Y)?]);
        let programmed = match event {
            Event::Travel(travel) => point(&travel.programmed),
            Event::Arc(arc) => point(&arc.programmed),
            _ => None,
        };
        let began = std::mem::replace(&mut self.programmed, programmed);
        let was_beside = std::mem::take(&mut self.is_beside);
        if !cuts {
            return;
        }
        let own = self.radius(cx);
        let depth = |position: &Position| position.get(Axis::Z);
        let z = match (depth(from), depth(to)) {
            (Some(a), Some(b)) => Some(a.min(b)),
            // Down from an unknown height.
            (None, b) => b,
            (Some(_), None) => None,
        };
        // A cutter of unknown size may clear as much beside its way as any.
        let goes_sideways = flat(from).zip(flat(to)).is_none_or(|(a, b)| distance(a, b) > LEVEL)
            || matches!(event, Event::Arc(_));
        let radius = if own <= 0.0 && goes_sideways { WIDE } else { own };
        let (Some(a), Some(b), Some(z)) = (flat(from), flat(to), z) else {
            match (began, programmed, bulge(cx, event)) {
                (Some([x0, y0, z0]), Some([x1, y1, z1]), Some(bulge)) if was_beside || is_compensated(cx) => {
                    (self.is_beside, self.has_beside) = (flat(to).is_none(), true);
                    let beside = MOST_BESIDE + bulge;
                    self.list.push(Cut { from: [x0, y0], to: [x1, y1], z: z0.min(z1), beside, radius });
                }
                _ => self.give_up(),
            }
            return;
        };
        match event {
            Event::Arc(arc) => {
                if arc.plane != gcheck_geometry::Plane::Xy || !arc.sweep.is_finite() {
                    self.blind = arc.plane == gcheck_geometry::Plane::Xy;
                    self.list.push(Cut { from: a, to: b, z, beside: 0.0, radius });
                } else {
                    self.add_arc([arc.centre.0.0, arc.centre.1.0], a, arc.sweep, [z, radius]);
                }
            }
            _ => self.list.push(Cut { from: a, to: b, z, beside: 0.0, radius }),
        }
    }

    /// The radius of the tool in the spindle; zero if it is unknown.
    fn radius(&mut self, cx: &PathCx<'_>) -> f64 {
        let tool = cx.definitions().set_by(Fact::Tool);
        let radius = match self.tool {
            Some((known, radius)) if known == tool => radius,
            _ => cutter_radius(cx).filter(|radius| radius.is_finite()).unwrap_or(0.0),
        };
        self.tool = Some((tool, radius));
        self.has_unknown |= radius <= 0.0;
        radius
    }

    fn add_arc(&mut self, centre: [f64; 2], start: [f64; 2], sweep: f64, [z, radius_of_tool]: [f64; 2]) {
        const PIECES: u32 = 12;
        let radius = distance(centre, start);
        let angle = (start[1] - centre[1]).atan2(start[0] - centre[0]);
        let at = |piece: u32| {
            let (sin, cos) = (angle + sweep * f64::from(piece) / f64::from(PIECES)).sin_cos();
            [centre[0] + radius * cos, centre[1] + radius * sin]
        };
        for piece in 0..PIECES {
            self.list.push(Cut {
                from: at(piece),
                to: at(piece + 1),
                z,
                beside: 0.0,
                radius: radius_of_tool,
            });
        }
    }

    /// The cuts that come near the way from one point to another, at this depth or lower.
    pub(crate) fn near_way(&self, from: [f64; 2], to: [f64; 2], z: f64, radius: f64) -> Vec<Cut> {
        let is_apart = |cut: &Cut, axis: usize| {
            let [low, high] = bounds([from, to], axis);
            let [cut_low, cut_high] = bounds([cut.from, cut.to], axis);
            let more = radius.max(cut.radius) + cut.beside;
            cut_low - more > high || cut_high + more < low
        };
        let is_near = |cut: &&Cut| cut.is_below(z) && !is_apart(cut, 0) && !is_apart(cut, 1);
        self.list.iter().filter(is_near).cloned().collect()
    }

    /// Did one of the first `count` cuts reach within `radius` of a point, or its own tool come there, at this depth or lower?
    pub(crate) fn reach(&self, count: usize, at: [f64; 2], z: f64, radius: f64) -> bool {
        let mut cuts = self.list.iter().take(count);
        cuts.any(|cut| cut.is_below(z) && cut.reaches(at, radius))
    }

    /// The same of the cuts that go sideways: no holes.
    pub(crate) fn reach_sideways(&self, at: [f64; 2], z: f64, radius: f64) -> bool {
        let mut cuts = self.list.iter().filter(|cut| distance(cut.from, cut.to) > LEVEL || cut.beside > 0.0);
        cuts.any(|cut| cut.is_below(z) && cut.reaches(at, radius))
    }

    /// Does an earlier straight cut pass over a point, less deep than this level, and not near the ends of the cut? Near its
    /// ends the tool may be beside the part.
    pub(crate) fn passes_over(&self, at: [f64; 2], z: f64) -> bool {
        let is_shallower = |cut: &Cut| cut.z > z + SHALLOWER && cut.z <= -SURFACE && cut.beside <= 0.0;
        let is_inner = |cut: &Cut| distance(at, cut.from).min(distance(at, cut.to)) >= INNER;
        self.list.iter().any(|cut| {
            is_shallower(cut) && is_inner(cut) && distance_to_line(at, cut.from, cut.to) <= SHALLOWER
        })
    }

    /// Does one of the first `count` cuts lie within a rectangle?
    pub(crate) fn lies_within(&self, count: usize, low: [f64; 2], high: [f64; 2]) -> bool {
        let is_inside = |at: [f64; 2], more: f64| {
            at.iter().zip(low).zip(high).all(|((at, low), high)| *at > low - more && *at < high + more)
        };
        let is_cut = |cut: &Cut| is_inside(cut.from, cut.beside) && is_inside(cut.to, cut.beside);
        self.list.iter().take(count).any(is_cut)
    }

    /// Is it known of all cuts how they ran?
    pub(crate) fn are_all_on_their_path(&self) -> bool {
        !self.has_beside
    }

    /// Is it unknown for good what was cut?
    pub(crate) fn is_blind(&self) -> bool {
        self.blind
    }

    /// How many cuts are kept.
    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }
}

/// The lower and the higher one of two coordinates along an axis of the plane.
fn bounds(points: [[f64; 2]; 2], axis: usize) -> [f64; 2] {
    let [a, b] = points.map(|point| if axis == 0 { point[0] } else { point[1] });
    [a.min(b), a.max(b)]
}

/// How far an arc as it is written may bulge over the chord between its ends: its diameter. `None` where it is not written so.
fn bulge(cx: &PathCx<'_>, event: &Event) -> Option<f64> {
    if !matches!(event, Event::Arc(_)) {
        return Some(0.0);
    }
    let unit = cx.state().units(cx.model)?.in_mm();
    let number = |letter: char| cx.known_number(letter);
    let radius = match (number('R'), number('I'), number('J')) {
        (Some(radius), None, None) => radius.abs(),
        (None, None, None) => return None,
        (None, i, j) => i.unwrap_or(0.0).hypot(j.unwrap_or(0.0)),
        _ => return None,
    };
    Some(2.0 * radius * unit)
}

/// X, Y and Z, if all are known.
pub(crate) fn point(position: &Position) -> Option<[f64; 3]> {
    Some([position.get(Axis::X)?, position.get(Axis::Y)?, position.get(Axis::Z)?])
}

/// Are two points not one in X and Y?
fn is_apart(a: [f64; 3], b: [f64; 3]) -> bool {
    let (x, y) = (a[0] - b[0], a[1] - b[1]);
    // Asked at every move, so without a root.
    x * x + y * y > 1e-12
}

/// May the program cut what is not among its moves? Pockets have none where the size of the cutter is not known.
pub(crate) fn may_hide_cuts(cx: &PathCx<'_>) -> bool {
    cx.file_uses(|effect| is_round_pocket(effect) || effect == Effect::GeneralPocket)
}

/// Of two points, millimetres.
pub(crate) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn distance_to_line(at: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let square = dx * dx + dy * dy;
    if square <= 0.0 {
        return distance(at, from);
    }
    let along = (((at[0] - from[0]) * dx + (at[1] - from[1]) * dy) / square).clamp(0.0, 1.0);
    distance(at, [from[0] + along * dx, from[1] + along * dy])
}
