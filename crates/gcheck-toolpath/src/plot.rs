//! Pictures of a toolpath: recorded from the steps of a run, drawn as SVG or as a page with a view in three dimensions.
//!
//! Knows: how moves become points that are drawn, and how many of them. Must not know: program text beyond what it is handed
//! for the page, rules, files.

mod data;
mod drawing;
mod drive;
mod note;
mod packed;
mod page;
mod palette;
mod surroundings;
mod svg;
mod thin;

use gcheck_engine::{Axis, CallLine, Event, FeedMode, Machine, Position};
use gcheck_geometry::{Arc, Bounds, Mm};

pub use data::Heading;
pub use drawing::{Drawing, Thinned, Tool};
pub use note::Note;
pub use page::{Finding, Page, Source};
pub use svg::escaped;

use crate::motion::{Cover, Motion, Way, cover};
use crate::placing::{Placing, WorkCoordinates};
use crate::step::{Beside, Step, View};
use crate::time::{Clock, Timing};
use drawing::{Alarm, Kind, Point};
use drive::{Drive, Drives, four_digits};
use note::{Assumed, LeftOut};
use surroundings::Surroundings;

/// Points kept of a run for the page, when the caller does not say otherwise. More are thinned.
pub const MAX_POINTS: usize = 500_000;
/// Tools and files that are told apart; all further ones count as the last.
const MAX_DISTINCT: usize = 255;
/// A move without a known feed is played at this many millimetres a minute.
const PLAYED_FEED: f64 = 1_000.0;
/// Chords stay this close to arcs, millimetres, and arcs of any size look round.
const FINEST: f64 = 0.02;

/// Records the path of a run. Its memory is bounded, however long the run is.
#[derive(Debug)]
pub struct Plot {
    view: View,
    lathe: bool,
    clock: Clock,
    placing: Placing,
    limit: usize,
    points: Vec<Point>,
    tools: Vec<Option<u32>>,
    files: Vec<String>,
    /// Index in `tools`, once something moved.
    tool: Option<usize>,
    tool_number: Option<u32>,
    /// The last file that was asked for.
    file: usize,
    seconds: f64,
    cut: Bounds,
    all: Bounds,
    moves: u64,
    untimed: bool,
    inch_moves: u64,
    turned: bool,
    pockets: u64,
    thinned: Option<Thinned>,
    /// Lines of blocks at which the control would stop.
    alarms: Vec<Alarm>,
    drives: Drives,
    /// Index of the one of the move under way.
    drive: u16,
    /// Lists of blocks that called, and the index of the one of the move under way with what it was made of.
    calls: Vec<Vec<(u8, u32)>>,
    call: u16,
    called: Vec<CallLine>,
    /// Rotary axes that turned: A, B, C.
    rotary: [bool; 3],
    /// File and line of each block that changes the tool, each once.
    changes: Vec<(u8, u32)>,
    /// The end of the last move as it is drawn.
    last: Option<Seen>,
    /// Moves that are drawn where the block aims, and not where the axes go: along a tilting tool, and beside a contour.
    posted: u64,
    on_contour: u64,
    left_out: LeftOut,
    /// What the run took for granted, and the moves rest on.
    assumed: Assumed,
    surroundings: Surroundings,
}

/// Blocks that change the tool; further ones begin no part of the path.
const MOST_CHANGES: usize = 1_000;
/// Lists of calls that are told apart; the moves of further ones are of no call.
const MOST_CALLS: usize = 4_096;
/// Alarms that are marked.
const MOST_ALARMS: usize = 1_000;
/// In the order in which points have them.
const ROTARY: [Axis; 3] = [Axis::A, Axis::B, Axis::C];

impl Plot {
    /// At the start of a run, with the work coordinates in effect there. At most `limit` points are kept ([`MAX_POINTS`]).
    pub fn new(view: View, timing: Timing, work: WorkCoordinates, limit: usize) -> Self {
        Self {
            view,
            lathe: false,
            clock: Clock::new(timing),
            placing: Placing::new(work),
            limit: limit.max(1_000),
            points: Vec::new(),
            tools: Vec::new(),
            files: Vec::new(),
            tool: None,
            tool_number: None,
            file: 0,
            seconds: 0.0,
            cut: Bounds::EMPTY,
            all: Bounds::EMPTY,
            moves: 0,
            untimed: false,
            inch_moves: 0,
            turned: false,
            pockets: 0,
            thinned: None,
            alarms: Vec::new(),
            drives: Drives::default(),
            drive: 0,
            calls: vec![Vec::new()],
            call: 0,
            called: Vec::new(),
            rotary: [false; 3],
            changes: Vec::new(),
            last: None,
            posted: 0,
            on_contour: 0,
            left_out: LeftOut::default(),
            assumed: Assumed::default(),
            surroundings: Surroundings::default(),
        }
    }

    /// With what is told of a machine around the path: how wide its tools are, how far it goes.
    #[must_use]
    pub fn on_machine(self, machine: &Machine) -> Self {
        Self { surroundings: Surroundings::of(machine), ..self }
    }

    /// The control would stop at a block, and the run goes on: the place where the tool is gets a mark.
    pub fn alarm(&mut self, file: &str, line: u32) {
        if self.alarms.len() < MOST_ALARMS {
            self.find_file(file);
            let at = self.points.last().map(|point| point.at);
            self.alarms.push(Alarm { file: self.file as u8, line, at });
        }
    }

    /// From a block on the path rests on something that nobody knows.
    pub fn assumed(&mut self, file: &str, line: u32, words: &str) {
        self.assumed.add(file, line, words);
    }

    /// Drawn as the work of a lathe: ZX, with X up.
    #[must_use]
    pub const fn for_lathe(mut self) -> Self {
        self.lathe = true;
        self
    }

    /// Takes an event.
    pub fn add(&mut self, step: &Step<'_>) {
        match step.event {
            Event::ToolChange(tool) | Event::SetToolNumber(tool) => {
                self.tool_number = *tool;
                self.tool = None;
                self.note_change(step);
                self.stand(step);
            }
            Event::Cleared(clearing) => {
                self.stand(step);
                self.pocket(step, clearing);
            }
            Event::Travel(_) | Event::Arc(_) | Event::Curve(_) | Event::RigidTap { .. } => {
                if self.moves == 0 && self.tool_number.is_none() {
                    self.tool_number = step.tool;
                }
                self.moves += 1;
                self.find_call(step.calls);
                self.inch_moves += u64::from(step.units == gcheck_engine::Units::Inch);
                self.placing.begin_move();
                let tracker = self.clock.tracker;
                tracker.motions(step, |motion| self.motion(step, motion));
            }
            _ => self.stand(step),
        }
        self.placing.after(step.event);
        self.clock.after(step);
    }

    /// The picture of what was recorded.
    pub fn finish(mut self) -> Drawing {
        // An axis that nobody ever knew, as Y on most lathes, is not drawn; a point of which only a part is known cannot be.
        let drawn: Vec<usize> = (0..3).filter(|axis| self.all.range(*axis).is_some()).collect();
        self.keep_known(&drawn);
        for alarm in &mut self.alarms {
            alarm.at = alarm.at.and_then(|mut at| {
                flatten(&mut at, &drawn);
                at.iter().all(|value| value.is_finite()).then_some(at)
            });
        }
        // Paths of one point are not seen.
        let mut next = self.points.iter().skip(1).map(|point| point.kind == Kind::Start).collect::<Vec<_>>();
        next.push(true);
        let mut next = next.into_iter();
        self.points.retain(|point| !(next.next().unwrap_or(true) && point.kind == Kind::Start));
        if self.points.len() > self.limit {
            self.thin();
        }
        let surroundings = &self.surroundings;
        let tool = |(ix, number): (usize, &Option<u32>)| Tool {
            // What is told of a turning tool is its nose.
            diameter: number.filter(|_| !self.lathe).and_then(|number| surroundings.diameter(number)),
            ..Tool::new(ix, *number)
        };
        let travel = self.placing.first().filter(|work| !self.lathe && work.rotation.abs() <= 0.0);
        Drawing {
            view: self.view,
            lathe: self.lathe,
            units: if self.inch_moves * 2 > self.moves {
                gcheck_engine::Units::Inch
            } else {
                gcheck_engine::Units::Mm
            },
            points: self.points,
            tools: self.tools.iter().enumerate().map(tool).collect(),
            zeros: self.placing.zeros(),
            travel: travel.map(|work| surroundings.travel_in(work)).unwrap_or_default(),
            files: self.files,
            cut: extents(&self.cut),
            all: extents(&self.all),
            moves: self.moves,
            seconds: self.seconds,
            untimed: self.untimed,
            overlaid: self.placing.has_overlaid(),
            turned: self.turned,
            pockets: self.pockets,
            thinned: self.thinned,
            alarms: self.alarms,
            drives: self.drives.into_all(),
            calls: self.calls,
            rotary: self.rotary,
            changes: self.changes,
            posted: self.posted,
            on_contour: self.on_contour,
            left_out: self.left_out.into_missing(&drawn),
            assumed: self.assumed,
        }
    }

    /// Keeps the points that are known on all drawn axes; after a gap a new path starts.
    fn keep_known(&mut self, drawn: &[usize]) {
        let mut kept = 0;
        let mut is_gap = true;
        for at in 0..self.points.len() {
            let Some(mut point) = self.points.get(at).copied() else { break };
            let is_known = (0..3).all(|axis| {
                !drawn.contains(&axis) || point.at.get(axis).is_some_and(|value| value.is_finite())
            });
            if !is_known {
                is_gap = true;
                continue;
            }
            flatten(&mut point.at, drawn);
            if is_gap {
                point.kind = Kind::Start;
                is_gap = false;
            }
            if let Some(slot) = self.points.get_mut(kept) {
                *slot = point;
                kept += 1;
            }
        }
        self.points.truncate(kept);
    }

    /// The tool is another one from this block on.
    fn note_change(&mut self, step: &Step<'_>) {
        self.find_file(step.file);
        let place = (self.file as u8, step.line);
        if self.changes.len() < MOST_CHANGES && !self.changes.contains(&place) {
            self.changes.push(place);
        }
    }

    /// Time passes, nothing moves.
    fn stand(&mut self, step: &Step<'_>) {
        let seconds = self.clock.still(step).0;
        if seconds > 0.0 && seconds.is_finite() {
            self.seconds += seconds;
        }
    }

    fn motion(&mut self, step: &Step<'_>, motion: &Motion) {
        let seen = self.seen(step, motion);
        let from = match self.last {
            // Where the axes are was not drawn, so that the move begins where the drawing is.
            Some(last) if last.aims || seen.aims => last.to,
            _ => self.placing.placed(&motion.from),
        };
        let to = self.placing.placed(&seen.to);
        self.last = Some(Seen { to, ..seen });
        self.find_file(step.file);
        self.left_out.look([&from, &to], motion.way == Way::Rapid, (self.file, step.line));
        let is_still = |axis: Axis| motion.from.raw(axis).to_bits() == motion.to.raw(axis).to_bits();
        for (turns, axis) in self.rotary.iter_mut().zip(ROTARY) {
            *turns |= !is_still(axis);
        }
        self.turned |= self.rotary.contains(&true);
        let kind = match motion.way {
            Way::Rapid => Kind::Rapid,
            Way::Probe => Kind::Probe,
            Way::Thread | Way::Tap(_) => Kind::Spindle,
            Way::Feed if motion.arc.is_some() => Kind::Arc,
            Way::Feed => Kind::Feed,
        };
        let seconds = self.clock.motion(step, motion).map(|seconds| seconds.0);
        let known = seconds.ok().filter(|seconds| seconds.is_finite());
        self.find_drive(step, motion, known);
        let seconds = known.unwrap_or_else(|| {
            let length = distance(&from, &to);
            self.untimed |= length > 0.0;
            if length.is_finite() { length / PLAYED_FEED * 60.0 } else { 0.0 }
        });
        self.begin(step, &from);
        let start = self.seconds;
        let cuts = matches!(kind, Kind::Feed | Kind::Arc | Kind::Spindle);
        let arc = motion.arc.filter(|_| !seen.aims);
        let chords = arc.as_ref().filter(|arc| arc.is_known()).map(|arc| (arc, chord_count(arc)));
        if let Some((arc, count)) = chords {
            for (done, point) in arc.chords(count).take(count as usize - 1).enumerate() {
                let part = (f64::from(done as u32) + 1.0) / f64::from(count);
                let at = self.placing.placed(&motion.to.with_xyz(point));
                self.include(&at, cuts);
                self.push(step, &at, start + seconds * part, kind);
            }
            if self.placing.is_upright() {
                self.include_box(&arc.bounds(), &motion.to, cuts);
            }
        }
        self.seconds = start + seconds;
        self.include(&from, cuts);
        self.include(&to, cuts);
        self.push(step, &to, self.seconds, kind);
    }

    /// Feed and speed of a move that takes so many seconds, if that is known.
    fn find_drive(&mut self, step: &Step<'_>, motion: &Motion, seconds: Option<f64>) {
        let rpm = self.clock.rpm(step, motion);
        let rpm = if self.clock.surface_speed().is_some() { four_digits(rpm) } else { rpm };
        let drive = match self.clock.feed_of(step, motion) {
            // The feed comes back with the next cut.
            None => Drive { rpm, ..self.drives.last() },
            Some((feed, mode)) => {
                let along = match (cover(motion).0, seconds) {
                    (Cover::Length(length), Some(seconds)) if seconds > 0.0 => length / seconds * 60.0,
                    _ => f64::NAN,
                };
                // A helix that is fed along its circle is faster by a trifle, which would be a feed of its own.
                let is_feed = mode == FeedMode::PerMinute && (along / feed - 1.0).abs() < 0.005;
                Drive { feed, mode, along: if is_feed { feed } else { four_digits(along) }, rpm }
            }
        };
        self.drive = self.drives.index(drive);
    }

    /// Where a move is drawn: at the tip of a tool that tilts, and where the block aims when nobody knows the path beside the
    /// contour.
    fn seen(&mut self, step: &Step<'_>, motion: &Motion) -> Seen {
        match step.beside {
            Some(Beside::AlongTool { tip: Some(tip) }) => {
                return Seen { to: motion.to.with_xyz(tip), aims: true };
            }
            Some(Beside::AlongTool { tip: None }) if step.aim.xyz().iter().any(|value| value.is_known()) => {
                self.posted += 1;
                return Seen { to: motion.to.with_xyz(step.aim.xyz()), aims: true };
            }
            _ => {}
        }
        let mut to = motion.to;
        let mut aims = false;
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            if to.get(axis).is_none()
                && let Some(aim) = step.aim.get(axis)
            {
                to.set(axis, aim);
                aims = true;
            }
        }
        self.on_contour += u64::from(aims);
        Seen { to, aims }
    }

    /// A pocket that the control clears by a path of its own is drawn as the box in which it moves.
    fn pocket(&mut self, step: &Step<'_>, clearing: &gcheck_engine::Clearing) {
        let ([x0, y0, z0], [x1, y1, _]) = (clearing.from, clearing.to);
        let corner = |x, y| self.placing.placed(&clearing.at.with_xyz([x, y, z0]));
        let corners = [corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1), corner(x0, y0)];
        if corners.iter().any(|corner| corner.xyz().iter().any(|value| !value.is_known())) {
            return;
        }
        self.pockets += 1;
        self.begin(step, &corners[0]);
        for corner in &corners[1..] {
            self.include(corner, true);
            self.push(step, corner, self.seconds, Kind::Feed);
        }
    }

    /// Begins a path where the last one did not end.
    fn begin(&mut self, step: &Step<'_>, from: &Position) {
        let from_at = single(from);
        let continues = self.points.last().is_some_and(|last| {
            last.at.iter().zip(from_at).all(|(a, b)| (a - b).abs() < 1e-3 || (a.is_nan() && b.is_nan()))
        });
        if !continues {
            self.push(step, from, self.seconds, Kind::Start);
        }
    }

    fn push(&mut self, step: &Step<'_>, at: &Position, seconds: f64, kind: Kind) {
        let tool = match self.tool {
            Some(tool) => tool,
            None => *self.tool.insert(index_of(&mut self.tools, &self.tool_number, |tool| *tool)),
        };
        self.find_file(step.file);
        self.points.push(Point {
            at: single(at),
            seconds: seconds as f32,
            line: step.line,
            kind,
            tool: tool as u8,
            file: self.file as u8,
            drive: self.drive,
            call: self.call,
            rotary: ROTARY.map(|axis| at.raw(axis) as f32),
        });
        if self.points.len() >= 4 * self.limit {
            self.thin();
        }
    }

    fn find_file(&mut self, file: &str) {
        if self.files.get(self.file).is_none_or(|known| known != file) {
            self.file = index_of(&mut self.files, file, str::to_owned);
        }
    }

    /// The blocks that lead to the moves of a step.
    fn find_call(&mut self, calls: &[CallLine]) {
        if self.called == calls {
            return;
        }
        self.called = calls.to_vec();
        let mut blocks = Vec::with_capacity(calls.len());
        for (file, line) in calls {
            self.find_file(file);
            blocks.push((self.file as u8, *line));
        }
        let known = self.calls.iter().position(|known| *known == blocks);
        let index = known.unwrap_or_else(|| {
            if self.calls.len() < MOST_CALLS {
                self.calls.push(blocks);
                self.calls.len() - 1
            } else {
                0
            }
        });
        self.call = index as u16;
    }

    fn thin(&mut self) {
        let before = self.thinned.unwrap_or_default();
        let tolerance = thin::to(&mut self.points, self.limit);
        self.thinned = Some(Thinned { tolerance: before.tolerance + tolerance });
    }

    fn include(&mut self, at: &Position, cuts: bool) {
        for (axis, value) in at.xyz().into_iter().enumerate().filter(|(_, value)| value.0.is_finite()) {
            self.all.include_on(axis, value.0);
            if cuts {
                self.cut.include_on(axis, value.0);
            }
        }
    }

    fn include_box(&mut self, bounds: &Bounds, like: &Position, cuts: bool) {
        let range = |axis| bounds.range(axis).unwrap_or((f64::NAN, f64::NAN));
        let ends = [range(0), range(1), range(2)];
        for corner in [ends.map(|(low, _)| Mm(low)), ends.map(|(_, high)| Mm(high))] {
            let corner = self.placing.placed(&like.with_xyz(corner));
            self.include(&corner, cuts);
        }
    }
}

/// The end of a move as it is drawn.
#[derive(Debug, Clone, Copy)]
struct Seen {
    to: Position,
    /// It is where the block aims, and not where the axes go.
    aims: bool,
}

/// How many chords an arc is drawn as.
fn chord_count(arc: &Arc) -> u32 {
    let radius = arc.radius().max(arc.end_radius()).0;
    let turns = (arc.sweep().abs() / std::f64::consts::TAU).ceil().clamp(1.0, 1_000.0);
    #[expect(clippy::cast_sign_loss, reason = "at least one turn, at most a thousand")]
    let most = turns as u32 * 360;
    arc.chord_count(Mm((radius / 1_000.0).clamp(1e-4, FINEST))).clamp(1, most)
}

/// The index of a thing in a list to which it is added, unless the list is full.
fn index_of<T, Q>(list: &mut Vec<T>, thing: &Q, make: impl FnOnce(&Q) -> T) -> usize
where
    T: std::borrow::Borrow<Q>,
    Q: PartialEq + ?Sized,
{
    let found = list.iter().position(|known| known.borrow() == thing);
    found.unwrap_or_else(|| {
        if list.len() < MAX_DISTINCT {
            list.push(make(thing));
        }
        list.len() - 1
    })
}

fn distance(from: &Position, to: &Position) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|axis| {
        let way =
            to.values().get(axis).copied().unwrap_or(0.0) - from.values().get(axis).copied().unwrap_or(0.0);
        if way.is_nan() { 0.0 } else { way }
    });
    x.hypot(y).hypot(z)
}

/// Coordinates in single precision: 0.00006 mm at a metre.
fn single(at: &Position) -> [f32; 3] {
    at.xyz().map(|value| value.0 as f32)
}

/// Puts a point onto the drawn axes.
fn flatten<T: Default>(at: &mut [T; 3], drawn: &[usize]) {
    for (axis, value) in at.iter_mut().enumerate() {
        if !drawn.contains(&axis) {
            *value = T::default();
        }
    }
}

/// Smallest and largest coordinates, without the noise of computing; zero on axes that are unknown.
fn extents(bounds: &Bounds) -> Option<[[f64; 3]; 2]> {
    if bounds.is_empty() {
        return None;
    }
    let [x, y, z] = [0, 1, 2].map(|axis| bounds.range(axis).unwrap_or((0.0, 0.0)));
    let rounded = |value: f64| (value * 1e6).round() / 1e6 + 0.0;
    Some([[x.0, y.0, z.0].map(rounded), [x.1, y.1, z.1].map(rounded)])
}
