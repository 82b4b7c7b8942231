//! Two runs held against each other: do they move the machine the same way?
//!
//! Knows: when two paths are one however they are cut into blocks, which settings count for which move. Must not know: how acts
//! come about, how differences are worded.
//!
//! Both runs are read with a cursor that may be inside a move. Of two moves the shorter one decides how far both go on, so
//! that a line in two pieces, or a circle in four quarters, is the line or the circle.
//!
//! Where two paths part, a second pass pairs the sections of the runs ([`Sections`]) and compares each with its partner.

mod alignment;
mod corner;
mod cursor;
mod curve;
mod difference;
mod digest;
mod outline;
mod print;
mod same;
mod sections;
mod stands;

use gcheck_engine::{Axis, Position};

use crate::trail::{Act, Doing, Driven, Feed, Move, Setting, Stand};
use corner::{Leaving, Off};
use cursor::{Cursor, Piece, Placed};
use curve::Curve;
use digest::Digest;

pub use difference::{
    Again, Aspect, By, Change, Corner, Difference, Differences, Parting, Place, Rest, SectionAt,
    SectionChange, Title, Value,
};
pub use outline::{Marks, Outline};
pub use sections::Sections;
use sections::{Source, Within, stretches};

use same::{corners_differ, known_differ, rate_differs, table_differs};

/// Compares two runs. Paths are the same while they stay within `tolerance` millimetres (degrees on rotary axes) of each other
/// on every axis. Coordinates that are unknown in one of them are not compared.
///
/// Where they part, both are left there, or read to their ends for a digest of all that they do differently.
pub fn compare(
    a: impl IntoIterator<Item = Act>,
    b: impl IntoIterator<Item = Act>,
    tolerance: f64,
    rest: Rest,
) -> Differences {
    let mut found = if rest == Rest::Leave { Differences::default() } else { Differences::with_digest() };
    let of_whole = |act| (0, act);
    let (a, b) = (a.into_iter().map(of_whole), b.into_iter().map(of_whole));
    let mut comparison = Comparison::new(a, b, tolerance, None, &mut found);
    comparison.run();
    if rest == Rest::Read {
        comparison.pass_over_all();
    }
    found
}

impl Sections {
    /// Compares the sections of one pass; both programs run from their begin.
    pub fn compare(
        &self,
        pass: usize,
        a: impl IntoIterator<Item = Act>,
        b: impl IntoIterator<Item = Act>,
        found: &mut Differences,
    ) {
        let [of_a, of_b] = &self.outlines;
        let mut a = Source::new(a.into_iter(), of_a.splitter());
        let mut b = Source::new(b.into_iter(), of_b.splitter());
        let Some(pairs) = self.passes.get(pass) else { return };
        if pass > 0 {
            found.begin_afresh();
        }
        let mut over = [found.another_digest(), found.another_digest()];
        for stretch in stretches(pairs) {
            let [over_a, over_b] = &mut over;
            let is_alone = |index, side| pass == 0 && self.is_alone(index, side);
            let placed_a = a.stretch(stretch.a, stretch.count, |section, act| {
                if is_alone(section, 0) {
                    over_a.add(&(&act.setting, &act.doing));
                }
            });
            let placed_b = b.stretch(stretch.b, stretch.count, |section, act| {
                if is_alone(section, 1) {
                    over_b.add(&(&act.setting, &act.doing));
                }
            });
            let within = Within { of: self, pass, stretch };
            Comparison::new(placed_a, placed_b, self.tolerance, Some(within), found).run();
        }
        let [mut over_a, mut over_b] = over;
        if pass == 0 {
            let rest = |source: &mut dyn Iterator<Item = (usize, Act)>, side, over: &mut Digest| {
                for (section, act) in source {
                    if self.is_alone(section, side) {
                        over.add(&(&act.setting, &act.doing));
                    }
                }
            };
            rest(&mut a, 0, &mut over_a);
            rest(&mut b, 1, &mut over_b);
            found.pass_over(&over_a);
            found.pass_over(&over_b);
        }
    }
}

/// Two runs, or sections of them, side by side.
struct Comparison<'f, A: Iterator<Item = Placed>, B: Iterator<Item = Placed>> {
    a: Cursor<A>,
    b: Cursor<B>,
    tolerance: f64,
    /// Which sections these are; `None` where the runs are compared as a whole.
    within: Option<Within<'f>>,
    /// The cutting move of the first run that ended last, where the next one begins a corner.
    leaving: Option<Leaving>,
    /// What the sections at hand still have from those before them, where these are not the same in both runs.
    inherited: Option<Inherited>,
    found: &'f mut Differences,
}

/// What two runs do next.
enum Pieces {
    /// No move that counts is left.
    Over,
    /// The same, as far as it was compared.
    Alike,
    /// Something else each.
    Part(Box<Parting>),
}

/// What two sections have from those before them and have not set themselves. It is compared from their first cut on.
#[derive(Default)]
struct Inherited {
    /// By axis: one of the runs has moved it.
    moved: [bool; Axis::ALL.len()],
    /// The tool length offsets of both.
    lengths: Option<[Option<u32>; 2]>,
}

impl<'f, A: Iterator<Item = Placed>, B: Iterator<Item = Placed>> Comparison<'f, A, B> {
    fn new(a: A, b: B, tolerance: f64, within: Option<Within<'f>>, found: &'f mut Differences) -> Self {
        let is_afresh = within.as_ref().is_some_and(|within| !within.is_from_start());
        Self {
            a: Cursor::new(a, is_afresh),
            b: Cursor::new(b, is_afresh),
            tolerance,
            within,
            leaving: None,
            inherited: is_afresh.then(Inherited::default),
            found,
        }
    }

    fn run(&mut self) {
        loop {
            // A move that is not done on one side, while the other one is: what is there is one-sided.
            let mut before_a = self.a.advance(self.found);
            let mut before_b = self.b.advance(self.found);
            self.leave_out_ends([&mut before_a, &mut before_b]);
            // One of them may be in its next section because the other one goes on where it does not. If the paths part
            // here, what is of that section is compared from its begin on.
            let section = self.a.section.max(self.b.section);
            let before = (self.a.section != self.b.section).then(|| {
                let mut found = self.found.clone();
                let is_early = |placed: &&Placed| placed.0 < section;
                let [early_a, early_b] =
                    [&before_a, &before_b].map(|stands| acts(stands.iter().filter(is_early)));
                stands::compare(&mut found, &early_a, &early_b, false);
                found
            });
            if !before_a.is_empty() || !before_b.is_empty() {
                let both_go_on = self.a.stands_next() && self.b.stands_next();
                let left = stands::compare(self.found, &acts(&before_a), &acts(&before_b), both_go_on);
                self.a.put_back(&mut before_a, left[0]);
                self.b.put_back(&mut before_b, left[1]);
                if self.a.stands_next() || self.b.stands_next() {
                    continue;
                }
            }
            let parting = match self.next_pieces() {
                Pieces::Over => return,
                Pieces::Alike => continue,
                Pieces::Part(parting) => *parting,
            };
            if self.within.is_none() {
                self.found.part(parting);
                return;
            }
            if let Some(before) = before {
                *self.found = before;
                let late = |stands: Vec<Placed>| stands.into_iter().filter(|(of, _)| *of >= section);
                self.a.back.extend(late(before_a));
                self.b.back.extend(late(before_b));
            }
            self.part_in_sections(parting);
        }
    }

    /// Leaves out of what the runs do between two moves what belongs to their ends.
    fn leave_out_ends(&mut self, both: [&mut Vec<Placed>; 2]) {
        let are_over = [self.a.is_over(), self.b.is_over()];
        let is_one_over = are_over[0] != are_over[1];
        // What the programs do between two tools, and at their end, are two things: what is left to compare is how
        // the last cut ends.
        let ends_a_section =
            are_over != [false; 2] && self.within.as_ref().is_some_and(Within::ends_one_program);
        let ends_a_cut = self.leaving.is_some();
        for stands in both {
            if is_one_over {
                // That one ends while the other goes on is told as such.
                stands.retain(|(_, act)| act.doing != Doing::Stand(Stand::End));
            }
            if ends_a_section {
                stands.retain(|(_, act)| ends_a_cut && act.waits());
            }
        }
    }

    /// Compares the moves that come next.
    fn next_pieces(&mut self) -> Pieces {
        match (&self.a.piece, &self.b.piece) {
            (None, None) => Pieces::Over,
            (Some(_), Some(_)) => {
                self.pieces().map_or(Pieces::Alike, |parting| Pieces::Part(Box::new(parting)))
            }
            (Some(piece), None) => {
                let parting = Parting {
                    a: Some(piece.place()),
                    b: self.b.last.take(),
                    at: self.b.at,
                    to: [Some(piece.curve.end()), None],
                    apart: f64::NAN,
                    within: None,
                    again: None,
                };
                if self.a_closes() { Pieces::Over } else { Pieces::Part(Box::new(parting)) }
            }
            (None, Some(piece)) => {
                let parting = Parting {
                    a: self.a.last.take(),
                    b: Some(piece.place()),
                    at: self.a.at,
                    to: [None, Some(piece.curve.end())],
                    apart: f64::NAN,
                    within: None,
                    again: None,
                };
                if self.b_closes() { Pieces::Over } else { Pieces::Part(Box::new(parting)) }
            }
        }
    }

    /// The paths part; they are compared again from a section on that both have.
    fn part_in_sections(&mut self, parting: Parting) {
        let mut over = self.found.another_digest();
        let (told, next) = self.next_section();
        self.a.begin(next, &mut over);
        self.b.begin(next, &mut over);
        (self.leaving, self.inherited) = (None, Some(Inherited::default()));
        self.found.pass_over(&over);
        let at = self.within.as_ref().and_then(|within| within.at(told));
        let (within, again) = at.map(|(sections, again)| (Box::new(sections), again)).unzip();
        self.found.part(Parting { within, again: again.flatten(), ..parting });
    }

    /// Where the paths part: in which section that is, and from which one on they are compared again.
    fn next_section(&self) -> (u32, u32) {
        let (a, b) = (self.a.section, self.b.section);
        let further = a.max(b);
        let has_moved = (a == further && self.a.has_moved()) || (b == further && self.b.has_moved());
        (a.min(b), if a == b || has_moved { further + 1 } else { further })
    }

    /// Reads both to their ends for the digest.
    fn pass_over_all(&mut self) {
        let mut over = self.found.another_digest();
        self.a.begin(u32::MAX, &mut over);
        self.b.begin(u32::MAX, &mut over);
        self.found.pass_over(&over);
    }

    /// Are the moves that only the first run has those with which its program closes?
    fn a_closes(&mut self) -> bool {
        let Some(within) = self.within.as_ref().filter(|within| within.ends_a_alone()) else { return false };
        within.closes(&mut self.a, 1, self.tolerance)
    }

    /// The same of the second run.
    fn b_closes(&mut self) -> bool {
        let Some(within) = self.within.as_ref().filter(|within| within.ends_b_alone()) else { return false };
        within.closes(&mut self.b, 0, self.tolerance)
    }

    /// Leaves out of a rapid move, up to the first cut of a section, the axes that no run has moved in it. Do the tool length
    /// offsets count?
    fn approach(&mut self) -> bool {
        let Some(inherited) = &mut self.inherited else { return true };
        let (Some(a), Some(b)) = (self.a.piece.as_mut(), self.b.piece.as_mut()) else { return true };
        let (Doing::Move(made_a), Doing::Move(made_b)) = (&a.act.doing, &b.act.doing) else { return true };
        if a.driven != Driven::Rapid || b.driven != Driven::Rapid {
            self.inherited = None;
            return true;
        }
        let lengths = [a.act.setting.length, b.act.setting.length];
        let is_inherited = *inherited.lengths.get_or_insert(lengths) == lengths;
        let lengths_count = !is_inherited || moves(made_a, Axis::Z) || moves(made_b, Axis::Z);
        if a.done > 0.0 || b.done > 0.0 {
            return lengths_count;
        }
        let (mut of_a, mut of_b) = (made_a.clone(), made_b.clone());
        for (axis, moved) in Axis::ALL.into_iter().zip(&mut inherited.moved) {
            if *moved {
                continue;
            }
            *moved = moves(made_a, axis) || moves(made_b, axis);
            for made in [&mut of_a, &mut of_b] {
                made.from.set(axis, f64::NAN);
                if !*moved {
                    made.to.set(axis, f64::NAN);
                }
            }
        }
        (a.curve, b.curve) = (Curve::new(&of_a), Curve::new(&of_b));
        lengths_count
    }

    /// Passes over two moves of which one only goes along axes whose values are not known, and the other one along these.
    fn goes_unseen(&mut self, lengths_count: bool) -> bool {
        let (Some(a), Some(b)) = (self.a.piece.as_mut(), self.b.piece.as_mut()) else { return false };
        let may_be_one = (a.curve.is_nothing() && a.curve.may_go_as(&b.curve, self.tolerance))
            || (b.curve.is_nothing() && b.curve.may_go_as(&a.curve, self.tolerance));
        if !may_be_one || a.done > 0.0 || b.done > 0.0 {
            return false;
        }
        self.found.moves += 1;
        self.found.unknown = true;
        settings(self.found, a, b, self.tolerance, lengths_count);
        self.leaving = None;
        self.a.finish();
        self.b.finish();
        true
    }

    /// Goes on along both moves by the shorter one of them; tells when they part.
    fn pieces(&mut self) -> Option<Parting> {
        let lengths_count = self.approach();
        if self.goes_unseen(lengths_count) {
            return None;
        }
        let (Some(a), Some(b)) = (self.a.piece.as_mut(), self.b.piece.as_mut()) else { return None };
        // A move that goes nowhere is passed over, unless it is the other side's way there from an unknown place.
        let (a_is_nothing, b_is_nothing) = (a.curve.is_nothing(), b.curve.is_nothing());
        if (a_is_nothing && !b.curve.is_open()) || (b_is_nothing && !a.curve.is_open()) {
            if a_is_nothing {
                self.a.finish();
            }
            if b_is_nothing {
                self.b.finish();
            }
            return None;
        }
        self.found.moves += 1;
        let begins = a.done <= 0.0;
        let parting = |a: &Piece, b: &Piece, at: Position, apart: f64| Parting {
            a: Some(a.place()),
            b: Some(b.place()),
            at,
            to: [Some(a.curve.end()), Some(b.curve.end())],
            apart,
            within: None,
            again: None,
        };
        let parted = if a.curve.is_open() || b.curve.is_open() {
            // From an unknown place only the end is known, and everything before it may be a part of the way there.
            let ends = [a.curve.end(), b.curve.end()];
            let [known, other] = ends.map(|end| Axis::ALL.map(|axis| !end.raw(axis).is_nan()));
            if known != other {
                self.found.half_known.get_or_insert_with(|| [a.place(), b.place()]);
            }
            let apart = curve::apart(&ends[0], &ends[1]);
            (a.done, b.done) = (1.0, 1.0);
            let parts = apart > self.tolerance || !Curve::go_for_the_same(&a.curve, &b.curve);
            parts.then(|| parting(a, b, self.a.at, apart))
        } else {
            let (at_a, at_b) = (a.curve.at(a.done), b.curve.at(b.done));
            let apart = curve::apart(&at_a, &at_b);
            if apart > self.tolerance {
                Some(parting(a, b, at_a, apart))
            } else if a.left() <= b.left() {
                follow(a, b, self.tolerance).err().map(|apart| parting(a, b, at_a, apart))
            } else {
                follow(b, a, self.tolerance).err().map(|apart| parting(a, b, at_a, apart))
            }
        };
        if parted.is_some() {
            return parted;
        }
        settings(self.found, a, b, self.tolerance, lengths_count);
        let is_cut = |piece: &Piece| piece.driven == Driven::Feed && !piece.curve.is_open();
        if begins && let Some(leaving) = self.leaving.take().filter(|_| is_cut(a) && is_cut(b)) {
            let modes = a.act.setting.corners.zip(b.act.setting.corners);
            if let Some(off) = modes.and_then(|(a_mode, b_mode)| leaving.off(&a.curve, [a_mode, b_mode])) {
                let off = match off {
                    Off::Within(off) => Some(off),
                    Off::Untold => None,
                };
                self.found.add_corner(a.place(), a.curve.at(0.0), off);
            }
        }
        let (a_is_done, b_is_done) = (a.done >= 1.0, b.done >= 1.0);
        if a_is_done {
            self.leaving = is_cut(a).then(|| Leaving::new(&a.curve));
        }
        if a_is_done {
            self.a.finish();
        }
        if b_is_done {
            self.b.finish();
        }
        None
    }
}

/// The acts alone.
fn acts<'p>(placed: impl IntoIterator<Item = &'p Placed>) -> Vec<&'p Act> {
    placed.into_iter().map(|(_, act)| act).collect()
}

/// Goes to the end of the shorter move, and along the longer one as far as that is; the error is how far they are apart.
fn follow(short: &mut Piece, long: &mut Piece, tolerance: f64) -> Result<(), f64> {
    let count = short.curve.checks(&long.curve);
    let mut reached = long.done;
    for check in 1..=count {
        let part = short.done + (1.0 - short.done) * f64::from(check) / f64::from(count);
        let point = short.curve.at(part);
        reached = long.curve.nearest(&point, reached);
        let apart = curve::apart(&long.curve.at(reached), &point);
        if apart > tolerance {
            return Err(apart);
        }
    }
    short.done = 1.0;
    long.done = reached;
    // What is left of the longer one is less than anybody looks at.
    if long.left() <= tolerance {
        long.done = 1.0;
    }
    Ok(())
}

/// Does a move change an axis?
fn moves(made: &Move, axis: Axis) -> bool {
    let (from, to) = (made.from.raw(axis), made.to.raw(axis));
    // From an unknown place it may.
    from.is_nan() != to.is_nan() || (from - to).abs() > 1e-9
}

/// Compares what is in effect while both move; tool length offsets, if they count.
fn settings(found: &mut Differences, a: &Piece, b: &Piece, tolerance: f64, lengths_count: bool) {
    let places = || (Some(a.place()), Some(b.place()));
    let (of_a, of_b) = (&a.act.setting, &b.act.setting);
    let mut compare = |aspect: Aspect, differs: bool, values: [Value; 2]| {
        if differs {
            found.add(aspect, places(), values.map(Some));
        } else {
            found.same(aspect);
        }
    };
    compare(Aspect::Drive, a.driven != b.driven, [a.driven, b.driven].map(Value::Driven));
    compare(Aspect::Tool, known_differ(of_a.tool, of_b.tool), [of_a.tool, of_b.tool].map(Value::Tool));
    match (of_a.work, of_b.work) {
        (Some(work), Some(same)) if work == same => {
            let axes = of_a.zero.into_iter().zip(of_b.zero);
            let differs = axes.into_iter().any(|(a, b)| table_differs(a, b, tolerance));
            compare(Aspect::WorkOffset, differs, [of_a, of_b].map(|of| Value::of_zero(work, of)));
        }
        works => compare(
            Aspect::WorkOffset,
            known_differ(of_a.work, of_b.work),
            <[_; 2]>::from(works).map(Value::WorkOffset),
        ),
    }
    match (of_a.length, of_b.length) {
        _ if !lengths_count => {}
        (Some(length), Some(same)) if length == same && length != 0 => {
            let differs = table_differs(of_a.length_by, of_b.length_by, tolerance);
            compare(Aspect::Length, differs, [of_a, of_b].map(|of| Value::of_length(length, of)));
        }
        lengths => compare(
            Aspect::Length,
            known_differ(of_a.length, of_b.length),
            <[_; 2]>::from(lengths).map(Value::Length),
        ),
    }
    if a.driven == Driven::Rapid || b.driven == Driven::Rapid {
        return;
    }
    compare(
        Aspect::Cutter,
        known_differ(of_a.cutter, of_b.cutter),
        [of_a.cutter, of_b.cutter].map(Value::Cutter),
    );
    let feeds = [of_a.feed, of_b.feed];
    let feeds_differ = matches!(feeds, [Some(one), Some(other)] if feed_differs(one, other));
    compare(Aspect::Feed, feeds_differ, feeds.map(Value::Feed));
    compare(Aspect::Spindle, spindle_differs(of_a, of_b), [of_a, of_b].map(Value::of_spindle));
    let coolant_differs =
        of_a.coolant.into_iter().zip(of_b.coolant).any(|(a, b)| a.unwrap_or(false) != b.unwrap_or(false));
    compare(Aspect::Coolant, coolant_differs, [of_a.coolant, of_b.coolant].map(Value::Coolant));
    if let (Some(a), Some(b)) = (of_a.corners, of_b.corners) {
        compare(Aspect::Corners, corners_differ([a, b]), [a, b].map(Value::Corners));
    }
}

fn feed_differs(a: Feed, b: Feed) -> bool {
    match (a, b) {
        (Feed::PerMinute(a), Feed::PerMinute(b)) | (Feed::PerTurn(a), Feed::PerTurn(b)) => rate_differs(a, b),
        (Feed::PerMinute(a), Feed::PerTurn(b)) | (Feed::PerTurn(a), Feed::PerMinute(b)) => {
            !a.is_nan() && !b.is_nan()
        }
    }
}

/// Is the surface speed constant in one alone, or limited otherwise? Without a limit a part that is turned to its centre spins
/// as fast as the machine can.
fn surface_differs(a: Option<f64>, b: Option<f64>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => {
            a.is_infinite() != b.is_infinite() && !a.is_nan() && !b.is_nan() || rate_differs(a, b)
        }
        (a, b) => a.is_some() != b.is_some(),
    }
}

fn spindle_differs(a: &Setting, b: &Setting) -> bool {
    use gcheck_engine::Spindle::Stopped;
    let stands = |setting: &Setting| setting.spindle == Some(Stopped);
    known_differ(a.spindle, b.spindle)
        || !stands(a)
            && !stands(b)
            && (surface_differs(a.surface, b.surface) || rate_differs(a.speed, b.speed))
}
