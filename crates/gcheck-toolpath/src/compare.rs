//! Two runs held against each other: do they move the machine the same way?
//!
//! Knows: when two paths are one however they are cut into blocks, which settings count for which move. Must not know: how acts
//! come about, how differences are worded.
//!
//! Both runs are read with a cursor that may be inside a move. Of two moves the shorter one decides how far both go on, so
//! that a line in two pieces, or a circle in four quarters, is the line or the circle.

mod corner;
mod curve;
mod difference;
mod digest;
mod same;
mod stands;

use std::iter::Peekable;
use std::sync::Arc as Shared;

use gcheck_engine::{Axis, Position};

use crate::trail::{Act, Doing, Driven, Feed, Move, Setting, Stand};
use corner::{Leaving, Off};
use curve::Curve;
use digest::Digest;

pub use difference::{Again, Aspect, Corner, Difference, Differences, Parting, Place, Value};
use same::{corners_differ, known_differ, rate_differs, table_differs};

/// Acts that are given together and are matched with each other at most.
const MAX_STANDS: usize = 64;

/// Compares two runs. Paths are the same while they stay within `tolerance` millimetres (degrees on rotary axes) of each other
/// on every axis. Coordinates that are unknown in one of them are not compared.
///
/// Where they part for good, both are left there, or read to their ends for a digest of all that they do differently.
pub fn compare(
    a: impl IntoIterator<Item = Act>,
    b: impl IntoIterator<Item = Act>,
    tolerance: f64,
    rest: Rest,
) -> Differences {
    let mut comparison = Comparison {
        a: Cursor::new(a.into_iter()),
        b: Cursor::new(b.into_iter()),
        tolerance,
        leaving: None,
        found: if rest == Rest::Read { Differences::with_digest() } else { Differences::default() },
    };
    comparison.run();
    if rest == Rest::Read {
        let mut over = comparison.found.another_digest();
        comparison.a.pass_over(&mut over, |_| false);
        comparison.b.pass_over(&mut over, |_| false);
        comparison.found.pass_over(&over);
    }
    comparison.found
}

/// What becomes of two runs after the place where their paths part for good.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rest {
    /// They are left there.
    Leave,
    /// They are read to their ends, and the differences have a digest.
    Read,
}

struct Comparison<A: Iterator<Item = Act>, B: Iterator<Item = Act>> {
    a: Cursor<A>,
    b: Cursor<B>,
    tolerance: f64,
    /// The cutting move of the first run that ended last, where the next one begins a corner.
    leaving: Option<Leaving>,
    found: Differences,
}

/// A place in a run.
struct Cursor<I: Iterator<Item = Act>> {
    acts: Peekable<I>,
    /// The move at hand, as far as it is not done.
    piece: Option<Piece>,
    /// Where the axes are.
    at: Position,
    /// An axis has moved. Before that, a move that goes nowhere may be the other side's way from an unknown place.
    started: bool,
    /// The next move is the first one that is compared after a place where the paths parted.
    is_afresh: bool,
    /// The tool change that was passed since the last move that was done.
    passed: Option<(u32, Place)>,
    /// The last move that was done.
    last: Option<Place>,
}

/// A move, of which a part may be done.
struct Piece {
    act: Act,
    driven: Driven,
    curve: Curve,
    /// From 0 to 1.
    done: f64,
}

impl<I: Iterator<Item = Act>> Cursor<I> {
    fn new(acts: I) -> Self {
        Self {
            acts: acts.peekable(),
            piece: None,
            at: Position::UNKNOWN,
            started: false,
            is_afresh: false,
            passed: None,
            last: None,
        }
    }

    /// Collects what happens before the next move, and takes up that move.
    fn advance(&mut self, found: &mut Differences) -> Vec<Act> {
        let mut stands = Vec::new();
        while self.piece.is_none() && stands.len() < MAX_STANDS {
            let Some(act) = self.acts.next() else { break };
            match &act.doing {
                Doing::Stand(stand) => {
                    if let Stand::ToolChange(tool) = stand {
                        self.passed = tool.map(|tool| (tool, act.place()));
                    }
                    stands.push(act);
                }
                Doing::Move(made) => {
                    let curve = if std::mem::take(&mut self.is_afresh) {
                        from_anywhere(made)
                    } else {
                        Curve::new(made)
                    };
                    let driven = made.driven;
                    found.unknown |= driven != Driven::Rapid && curve.is_unknown();
                    if curve.is_nothing() && self.started {
                        self.at = made.to;
                        continue;
                    }
                    self.started |= !curve.is_nothing() && !curve.is_open();
                    self.piece = Some(Piece { act, driven, curve, done: 0.0 });
                }
            }
        }
        stands
    }

    /// Ends the move at hand.
    fn finish(&mut self) {
        if let Some(piece) = self.piece.take() {
            self.at = piece.curve.end();
            self.last = Some(piece.place());
            self.passed = None;
        }
    }

    /// Passes over what is left of the move at hand, and the acts up to the first that is the end, which it gives.
    fn pass_over(&mut self, over: &mut Digest, is_end: impl Fn(&Act) -> bool) -> Option<Act> {
        if let Some(piece) = self.piece.take() {
            over.add(&(piece.done, &piece.act.setting, &piece.act.doing));
        }
        self.acts.find(|act| {
            over.add(&(&act.setting, &act.doing));
            is_end(act)
        })
    }

    /// Passes over what is before the next tool change, and over that; the tool, and where it comes. `None` when no tool comes
    /// whose number is known.
    fn next_tool(&mut self, over: &mut Digest) -> Option<(u32, Place)> {
        if let Some(passed) = self.passed.take() {
            if let Some(piece) = &mut self.piece
                && let Doing::Move(made) = &piece.act.doing
            {
                (piece.curve, piece.done) = (from_anywhere(made), 0.0);
            }
            (self.at, self.started) = (Position::UNKNOWN, false);
            return Some(passed);
        }
        let change = self.pass_over(over, Act::changes_tool)?;
        (self.at, self.started, self.is_afresh) = (Position::UNKNOWN, false, true);
        let Doing::Stand(Stand::ToolChange(tool)) = change.doing else { return None };
        Some((tool?, change.place()))
    }

    /// Is there no further move?
    fn is_over(&mut self) -> bool {
        self.piece.is_none() && self.acts.peek().is_none()
    }

    /// Is the next act one without motion?
    fn stands_next(&mut self) -> bool {
        self.piece.is_none() && self.acts.peek().is_some_and(|act| matches!(act.doing, Doing::Stand(_)))
    }
}

/// Acts up to the first change of the tool.
fn before_change(stands: &[Act]) -> &[Act] {
    stands.split(Act::changes_tool).next().unwrap_or_default()
}

/// The move, from wherever the run comes: where the paths had parted, both may come from different places.
fn from_anywhere(made: &Move) -> Curve {
    Curve::new(&Move { from: Position::UNKNOWN, ..made.clone() })
}

impl Act {
    fn place(&self) -> Place {
        Place { file: Shared::clone(&self.file), line: self.line }
    }

    fn changes_tool(&self) -> bool {
        matches!(self.doing, Doing::Stand(Stand::ToolChange(_)))
    }
}

impl Piece {
    fn place(&self) -> Place {
        self.act.place()
    }

    fn left(&self) -> f64 {
        self.curve.length() * (1.0 - self.done)
    }
}

impl<A: Iterator<Item = Act>, B: Iterator<Item = Act>> Comparison<A, B> {
    fn run(&mut self) {
        loop {
            // A move that is not done on one side, while the other one is: what is there is one-sided.
            let mut before_a = self.a.advance(&mut self.found);
            let mut before_b = self.b.advance(&mut self.found);
            if self.a.is_over() != self.b.is_over() {
                // That one ends while the other goes on is told as such.
                for stands in [&mut before_a, &mut before_b] {
                    stands.retain(|act| act.doing != Doing::Stand(Stand::End));
                }
            }
            // One of them may have come to its next tool because the other one goes on where it does not: then what comes with
            // the tool is not compared here.
            let [early_a, early_b] = [&before_a, &before_b].map(|stands| before_change(stands));
            let is_one_sided = (early_a.len() < before_a.len()) != (early_b.len() < before_b.len());
            let before = is_one_sided.then(|| {
                let mut found = self.found.clone();
                stands::compare(&mut found, early_a, early_b);
                found
            });
            if !before_a.is_empty() || !before_b.is_empty() {
                self.stands(&before_a, &before_b);
                if self.a.stands_next() || self.b.stands_next() {
                    continue;
                }
            }
            match (&self.a.piece, &self.b.piece) {
                (None, None) => return,
                (Some(_), Some(_)) => {
                    if let Some(parting) = self.pieces() {
                        let mut over = self.found.another_digest();
                        let again = self.go_on(&mut over);
                        let is_over = again.is_none();
                        if let Some(before) = before.filter(|_| !is_over) {
                            self.found = before;
                        }
                        self.found.pass_over(&over);
                        self.found.part(Parting { again, ..parting });
                        if is_over {
                            return;
                        }
                    }
                }
                (Some(piece), None) => {
                    let parting = Parting {
                        a: Some(piece.place()),
                        b: self.b.last.take(),
                        at: self.b.at,
                        to: [Some(piece.curve.end()), None],
                        apart: f64::NAN,
                        again: None,
                    };
                    self.found.part(parting);
                    return;
                }
                (None, Some(piece)) => {
                    let parting = Parting {
                        a: self.a.last.take(),
                        b: Some(piece.place()),
                        at: self.a.at,
                        to: [None, Some(piece.curve.end())],
                        apart: f64::NAN,
                        again: None,
                    };
                    self.found.part(parting);
                    return;
                }
            }
        }
    }

    /// Passes over what is before the next tool change of both runs, if they change to the same tool there.
    fn go_on(&mut self, over: &mut Digest) -> Option<Again> {
        let (tool, a) = self.a.next_tool(over)?;
        let (other, b) = self.b.next_tool(over)?;
        self.leaving = None;
        (tool == other).then_some(Again { tool, a, b })
    }

    /// Goes on along both moves by the shorter one of them; tells when they part.
    fn pieces(&mut self) -> Option<Parting> {
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
        settings(&mut self.found, a, b, self.tolerance);
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

    fn stands(&mut self, a: &[Act], b: &[Act]) {
        stands::compare(&mut self.found, a, b);
    }
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

/// Compares what is in effect while both move.
fn settings(found: &mut Differences, a: &Piece, b: &Piece, tolerance: f64) {
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

fn spindle_differs(a: &Setting, b: &Setting) -> bool {
    use gcheck_engine::Spindle::Stopped;
    let stands = |setting: &Setting| setting.spindle == Some(Stopped);
    known_differ(a.spindle, b.spindle)
        || !stands(a) && !stands(b) && (a.surface != b.surface || rate_differs(a.speed, b.speed))
}
