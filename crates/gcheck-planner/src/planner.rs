//! The planner: items in, the time of each out.
//!
//! Knows: the order in which things happen, what they take, what the machine waits for. Must not know: programs, how
//! times are shown.
//!
//! Moves become stretches of path ([`Segment`]); where two meet, a corner is passed, rounded or stopped at
//! ([`meet`]); stretches wait in a window as wide as the control looks ahead ([`Window`]), and each is run as quickly as
//! its ends allow ([`Profile`]). Memory is bounded by the window.

use gcheck_geometry::Seconds;

use crate::changer::Magazine;
use crate::corner::{Meet, OVERLAPPED, Overlap, is_alone, meet};
use crate::feeding::Feeding;
use crate::item::{Drive, Item, Meeting, Move};
use crate::jerk::Easing;
use crate::machine::{Corners, Machine, Rapids, SpindleWait, Taps};
use crate::merge::Merge;
use crate::profile::{Profile, highest_entry};
use crate::segment::{Cap, Segment};
use crate::share::Shares;
use crate::spindle::Spindle;
use crate::window::{Piece, Window};

/// What an item, or a part of it, took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span<T> {
    /// What came with the item.
    pub tag: T,
    /// How many moves it is: none for the arc at a corner, several for merged moves.
    pub blocks: u32,
    /// When it begins, from the start of the run.
    pub begin: Seconds,
    /// Where its time goes.
    pub shares: Shares,
    /// How it was run; nothing for an item that moves no axis.
    pub profile: Profile,
    /// What it would have taken at the speed that was asked for, or at the rapid rates.
    pub asked: Seconds,
    /// What cost most of the time beyond that.
    pub cause: Cause,
}

/// What keeps a move from running at the speed that was asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Cause {
    /// Nothing to speak of.
    None,
    /// Blocks come faster than the control prepares them.
    Starved,
    /// An axis is not as fast.
    Axis,
    /// The turn of an arc is too tight.
    Turn,
    /// The axes stop at its ends.
    Stop,
    /// The corners at its ends are passed slowly, or it is too short to reach its speed.
    Corner,
    /// The spindle is waited for.
    Spindle,
}

/// What goes along with a stretch in the window.
#[derive(Debug, Clone, Copy)]
struct Load<T> {
    tag: T,
    is_rapid: bool,
    blocks: u32,
    asked: f64,
    axes: f64,
    why: Cap,
    jerk: f64,
    /// The next stretch begins before the end of this one.
    overlap: Option<Overlap>,
    /// By so many seconds, once the next stretch is known.
    ahead: f64,
    /// It ends in a stop that its neighbours do not make necessary.
    stops: bool,
    /// What the control takes before it goes on.
    waits: f64,
    /// What the axes take to follow once the path has ended.
    settle: f64,
    /// It takes this long, whatever its profile would be.
    fixed: Option<f64>,
    /// The spindle drives it: what it takes longer is the spindle's.
    taps: bool,
}

/// Plans a run. Takes items in order; [`Planner::finish`] ends it.
#[derive(Debug, Clone)]
pub struct Planner<T> {
    machine: Machine,
    meeting: Meeting,
    merge: Merge<T>,
    /// The last stretch: what comes next decides about its end. With how it meets its neighbours.
    open: Option<(Segment<T>, Meeting)>,
    window: Window<Load<T>>,
    /// Speed at which the last piece was left.
    speed: f64,
    /// By how many seconds the next piece begins before the last one comes to rest.
    resting: f64,
    /// Time of following that is still to come when the path ends.
    settle: f64,
    /// The last stretch is a thread.
    threading: bool,
    /// The last stretch is the stroke of a tap.
    tapping: bool,
    /// What the control takes for the stop that is being made.
    halting: f64,
    easing: Easing,
    feeding: Feeding,
    spindle: Spindle,
    magazine: Magazine,
    clock: f64,
}

impl<T: Copy> Planner<T> {
    /// At the start of a run.
    pub fn new(machine: Machine) -> Self {
        Self {
            meeting: Meeting::Exact,
            merge: Merge::default(),
            open: None,
            window: Window::new(machine.control.look_ahead),
            speed: 0.0,
            resting: 0.0,
            settle: 0.0,
            threading: false,
            tapping: false,
            halting: 0.0,
            easing: Easing::default(),
            feeding: Feeding::new(machine.control.block_time.0, machine.control.look_ahead),
            spindle: Spindle::new(machine.spindle, machine.control.spindle_wait),
            magazine: Magazine::new(machine.changer),
            clock: 0.0,
            machine,
        }
    }

    /// The machine that it plans for.
    pub const fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The time up to what was handed out last.
    pub const fn now(&self) -> Seconds {
        Seconds(self.clock)
    }

    /// Takes an item. `each` gets the time of what is certain, which may be that of earlier items.
    pub fn push(&mut self, item: Item<T>, each: &mut impl FnMut(&Span<T>)) {
        match item {
            Item::Move(item) => self.move_on(&item, each),
            Item::Meeting(meeting) => {
                self.unmerge(each);
                self.meeting = meeting;
            }
            Item::Halt => self.halt(each),
            Item::Corners(corners) => {
                self.halt(each);
                self.machine.control.corners = corners;
            }
            Item::Pause { seconds, auxiliary, tag } => {
                self.halt(each);
                let time = Seconds(seconds.0.max(0.0));
                let shares = if auxiliary {
                    Shares { auxiliary: time, ..Shares::default() }
                } else {
                    Shares { dwell: time, ..Shares::default() }
                };
                self.stand(tag, shares, Cause::None, each);
            }
            Item::Spindle { speed, tag } => {
                self.halt(each);
                self.spindle.command(speed, self.clock);
                if self.machine.control.spindle_wait == SpindleWait::AtOnce {
                    self.wait_for_spindle(tag, each);
                }
            }
            Item::Orient { tag } => {
                self.halt(each);
                let spindle = self.spindle.orient(self.clock);
                self.stand(tag, Shares { spindle, ..Shares::default() }, Cause::Spindle, each);
            }
            Item::Call { pocket } => self.magazine.call(pocket, self.clock),
            Item::Change { pocket, tag } => {
                self.halt(each);
                let spindle = self.spindle.stop(self.clock);
                self.stand(tag, Shares { spindle, ..Shares::default() }, Cause::Spindle, each);
                let tool_change = self.magazine.change(pocket, self.clock);
                self.stand(tag, Shares { tool_change, ..Shares::default() }, Cause::None, each);
            }
        }
    }

    /// Ends the run: whatever is still to come is handed out.
    pub fn finish(&mut self, each: &mut impl FnMut(&Span<T>)) {
        self.halt(each);
    }

    fn move_on(&mut self, item: &Move<T>, each: &mut impl FnMut(&Span<T>)) {
        let merge = match self.meeting {
            Meeting::Rounded { merge, .. } => merge.0,
            Meeting::Stop | Meeting::Exact => 0.0,
        };
        if merge > 0.0 && Merge::takes(item) {
            self.merge_on(item, 1, merge, each);
        } else if let Some([first, second]) = Merge::halves(item, merge) {
            self.merge_on(&first, 1, merge, each);
            self.merge_on(&second, 0, merge, each);
        } else {
            self.unmerge(each);
            self.segment(item, 1, each);
        }
    }

    fn merge_on(&mut self, item: &Move<T>, blocks: u32, tolerance: f64, each: &mut impl FnMut(&Span<T>)) {
        if let Some((done, blocks)) = self.merge.add(item, blocks, tolerance) {
            self.segment(&done, blocks, each);
        }
    }

    fn unmerge(&mut self, each: &mut impl FnMut(&Span<T>)) {
        if let Some((done, blocks)) = self.merge.take() {
            self.segment(&done, blocks, each);
        }
    }
}

/// How a stretch ends.
#[derive(Debug, Clone, Copy)]
enum Ending {
    /// The axes come to rest.
    Stop,
    /// They come to rest where the control was ready to go on.
    Halt,
    /// It is left at no more than this speed.
    Pass(f64),
    /// The axes come to rest while the next stretch begins.
    Overlap(Overlap),
}

impl<T: Copy> Planner<T> {
    fn segment(&mut self, item: &Move<T>, blocks: u32, each: &mut impl FnMut(&Span<T>)) {
        let Some(mut segment) = Segment::of(item, &self.machine) else { return };
        segment.blocks = blocks;
        let threads = matches!(item.drive, Drive::Thread(_));
        let alone = is_alone(item.drive, &self.machine);
        if alone {
            self.rest(each);
        } else if threads != self.threading {
            // The control knows that a thread meets nothing.
            self.end(each);
        }
        if item.drive != Drive::Rapid && self.spindle.is_awaited() {
            self.rest(each);
            self.wait_for_spindle(item.tag, each);
        }
        let marked = match item.drive {
            Drive::Thread(speed) if !self.threading => Some(speed),
            Drive::Tap(speed) if !self.tapping && self.machine.control.taps == Taps::RunOut => Some(speed),
            _ => None,
        };
        if let Some(speed) = marked {
            // It begins at the spindle's mark, half a turn away on the average.
            let spindle = Seconds(if speed.0 > 0.0 { 30.0 / speed.0 } else { 0.0 });
            self.stand(item.tag, Shares { spindle, ..Shares::default() }, Cause::Spindle, each);
        }
        self.threading = threads;
        self.tapping = matches!(item.drive, Drive::Tap(_));
        if let Some((mut first, meeting)) = self.open.take() {
            let met = meet(&self.machine, (meeting, self.meeting), &mut first, &mut segment);
            first.settle(&self.machine.control.corners);
            match met {
                Meet::Rest => self.lay(&first, Ending::Stop, each),
                Meet::Pass(speed) => self.lay(&first, Ending::Pass(speed), each),
                Meet::Overlap(overlap) => self.lay(&first, Ending::Overlap(overlap.after(&first)), each),
                Meet::Round(mut arc) => {
                    let ending = Ending::Pass(arc.cap);
                    if self.is_used_up(&first, &arc) {
                        arc.length += first.length;
                        arc.blocks += first.blocks;
                    } else {
                        self.lay(&first, ending, each);
                    }
                    self.lay(&arc, ending, each);
                }
            }
        }
        if alone {
            let fixed = self.fixed(item, &segment);
            self.lay_fixed(&segment, Ending::Stop, fixed, each);
            self.run_all(each);
        } else {
            self.open = Some((segment, self.meeting));
        }
    }

    /// Is so little left of a move between two rounded corners that the second one takes it along?
    fn is_used_up(&self, first: &Segment<T>, arc: &Segment<T>) -> bool {
        let Corners::Rounded(rounding) = &self.machine.control.corners else { return false };
        first.length < first.whole && first.length < arc.cap * rounding.cycle.0 * rounding.least_cycles
    }

    /// The duration of a move that is not run by speed along its path.
    fn fixed(&self, item: &Move<T>, segment: &Segment<T>) -> Option<f64> {
        let limits = &self.machine.limits;
        match item.drive {
            Drive::Tap(speed) => {
                let taps = self.machine.control.taps;
                let pace = (segment.length, segment.asked.min(segment.axes), segment.acceleration);
                Some(self.spindle.stroke(taps, speed, pace))
            }
            Drive::Rapid if self.machine.control.rapids == Rapids::ByAxis => {
                let way = item.to - item.from;
                let times = (0..way.len()).filter_map(|axis| {
                    let way = way.get(axis)?.abs();
                    let speed = limits.speed().get(axis)? * self.machine.rapid_part;
                    let acceleration = *limits.acceleration().get(axis)?;
                    let jerk = limits.jerk().and_then(|jerk| jerk.get(axis).copied());
                    let alone = Profile::quickest(way, 0.0, 0.0, speed, acceleration);
                    Some(alone.seconds + Easing::alone(&alone, jerk.unwrap_or(f64::INFINITY)))
                });
                Some(times.fold(0.0, f64::max))
            }
            _ => None,
        }
    }

    /// The axes come to rest, and everything up to here is certain.
    fn halt(&mut self, each: &mut impl FnMut(&Span<T>)) {
        self.unmerge(each);
        self.halting = self.machine.control.halt_time.0;
        self.rest(each);
        self.halting = 0.0;
        self.threading = false;
        self.tapping = false;
    }

    fn rest(&mut self, each: &mut impl FnMut(&Span<T>)) {
        let goes_on =
            matches!(&self.machine.control.corners, Corners::Rounded(rounding) if rounding.overlaps);
        if let Some((last, Meeting::Rounded { .. })) = &mut self.open
            && goes_on
        {
            // The control was ready to let the next move overlap.
            last.keep(OVERLAPPED);
        }
        self.end_in(if goes_on { Ending::Halt } else { Ending::Stop }, each);
    }

    /// The axes come to rest where the control knows ahead that they will.
    fn end(&mut self, each: &mut impl FnMut(&Span<T>)) {
        self.end_in(Ending::Stop, each);
    }

    fn end_in(&mut self, ending: Ending, each: &mut impl FnMut(&Span<T>)) {
        if let Some((last, _)) = self.open.take() {
            self.lay(&last, ending, each);
        }
        self.run_all(each);
    }

    fn lay(&mut self, segment: &Segment<T>, ending: Ending, each: &mut impl FnMut(&Span<T>)) {
        self.lay_fixed(segment, ending, None, each);
    }

    /// Puts a stretch into the window; what has enough ahead of it is run.
    fn lay_fixed(
        &mut self,
        segment: &Segment<T>,
        ending: Ending,
        fixed: Option<f64>,
        each: &mut impl FnMut(&Span<T>),
    ) {
        // The next move begins with the next cycle.
        let waits = match (&self.machine.control.corners, ending) {
            (Corners::Rounded(rounding), Ending::Stop | Ending::Halt) => {
                rounding.cycle.0 / 2.0 + self.halting
            }
            (_, Ending::Stop | Ending::Halt) => self.halting,
            _ => 0.0,
        };
        let filtered = self.machine.control.corners == Corners::Filtered;
        let acceleration = if filtered { f64::INFINITY } else { segment.pull() };
        let (leave, overlap) = match ending {
            Ending::Stop | Ending::Halt => (0.0, None),
            Ending::Pass(speed) => (speed, None),
            Ending::Overlap(overlap) => (0.0, Some(overlap)),
        };
        if let Some(before) = self.window.last_mut()
            && let Some(overlap) = before.overlap.take()
        {
            before.ahead = overlap.seconds(segment, matches!(ending, Ending::Halt));
        }
        // What corners left of a stretch may be too short for its speed.
        let shortest = self.machine.control.shortest.0;
        let cap = if shortest > 0.0 { segment.cap.min(segment.length / shortest) } else { segment.cap };
        self.window.push(Piece {
            length: segment.length,
            cap,
            // A move whose end is not known may have to stop half way.
            enter: if matches!(ending, Ending::Halt) {
                (segment.pull() * segment.length).sqrt()
            } else {
                f64::INFINITY
            },
            acceleration,
            leave,
            exit: 0.0,
            data: Load {
                tag: segment.tag,
                is_rapid: segment.drive == Drive::Rapid,
                blocks: segment.blocks,
                asked: segment.asked,
                axes: segment.axes,
                why: segment.why,
                jerk: segment.jerk,
                overlap,
                ahead: 0.0,
                stops: matches!(ending, Ending::Stop | Ending::Halt),
                waits,
                settle: if filtered && fixed.is_none() { segment.cap / segment.acceleration } else { 0.0 },
                fixed,
                taps: matches!(segment.drive, Drive::Tap(_)),
            },
        });
        while let Some(piece) = self.window.pop_known() {
            self.run(&piece, each);
        }
    }

    fn run_all(&mut self, each: &mut impl FnMut(&Span<T>)) {
        while let Some(piece) = self.window.pop() {
            self.run(&piece, each);
        }
    }

    /// Runs a stretch: its time is certain.
    fn run(&mut self, piece: &Piece<Load<T>>, each: &mut impl FnMut(&Span<T>)) {
        let load = &piece.data;
        let entry = self.speed;
        let exit = piece.exit.min(highest_entry(entry, piece.acceleration, piece.length));
        let even = self.machine.control.even_below.0;
        let is_even = !load.is_rapid
            && load.fixed.is_none()
            && exit > 0.0
            && 2.0 * piece.length < even * (entry + exit);
        let mut profile = if is_even {
            Profile::ramp(piece.length, entry, exit)
        } else {
            Profile::quickest(piece.length, entry, exit, piece.cap, piece.acceleration)
        };
        let mut seconds = match load.fixed {
            Some(fixed) => fixed,
            None => profile.seconds + self.easing.after(&profile, load.jerk),
        } + load.waits;
        self.speed = exit;
        // What the last stretch and this one share of their time.
        let overlap = self.resting.clamp(0.0, seconds);
        self.resting = load.ahead;
        self.clock -= overlap;
        seconds -= overlap;
        if load.settle > 0.0 {
            self.settle = self.settle.max(load.settle);
            if load.stops {
                seconds += std::mem::take(&mut self.settle);
            }
        }
        let begin = self.clock;
        let starved = self.feeding.after(load.blocks, begin, begin + overlap + seconds);
        self.clock += overlap + seconds + starved;

        let ideal = load.asked.min(load.axes);
        let run = (piece.length / ideal).min(seconds);
        let asked = piece.length / if load.asked.is_finite() { load.asked } else { load.axes };
        profile.seconds = seconds + overlap;
        let longer = Seconds(seconds - run);
        let (acceleration, spindle) =
            if load.taps { (Seconds::ZERO, longer) } else { (longer, Seconds::ZERO) };
        let shares = Shares {
            run: Seconds(run),
            acceleration,
            spindle,
            starved: Seconds(starved),
            ..Shares::default()
        };
        each(&Span {
            tag: load.tag,
            blocks: load.blocks,
            begin: Seconds(begin),
            shares,
            profile,
            asked: Seconds(asked),
            cause: cause(load, &shares, asked, piece.length / piece.cap, entry, exit),
        });
    }

    fn wait_for_spindle(&mut self, tag: T, each: &mut impl FnMut(&Span<T>)) {
        let spindle = self.spindle.wait(self.clock);
        self.stand(tag, Shares { spindle, ..Shares::default() }, Cause::Spindle, each);
    }

    /// The axes do not move.
    fn stand(&mut self, tag: T, shares: Shares, cause: Cause, each: &mut impl FnMut(&Span<T>)) {
        let seconds = shares.total();
        if seconds > Seconds::ZERO {
            let profile = Profile { seconds: seconds.0, ..Profile::default() };
            let begin = Seconds(self.clock);
            each(&Span { tag, blocks: 0, begin, shares, profile, asked: Seconds::ZERO, cause });
            self.clock += seconds.0;
        }
        self.feeding.stop(self.clock);
    }
}

/// What cost most.
fn cause<T>(load: &Load<T>, shares: &Shares, asked: f64, capped: f64, entry: f64, exit: f64) -> Cause {
    let axis = shares.run.0 - asked;
    let turn = if load.why == Cap::Turn { capped - shares.run.0 } else { 0.0 };
    let change = shares.acceleration.0 - turn;
    let most = [
        (shares.starved.0, Cause::Starved),
        (axis, Cause::Axis),
        (turn, Cause::Turn),
        (shares.spindle.0, Cause::Spindle),
        (change, if load.stops && exit <= 0.0 && entry <= 0.0 { Cause::Stop } else { Cause::Corner }),
    ];
    let none = (1e-9, Cause::None);
    most.into_iter().fold(none, |best, next| if next.0 > best.0 { next } else { best }).1
}
