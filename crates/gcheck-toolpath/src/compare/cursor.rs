//! A run that is read move by move, and may stop inside a move.
//!
//! Knows: acts, and how far the move at hand is done. Must not know: the other run, what differs.

use std::collections::VecDeque;
use std::iter::Peekable;
use std::sync::Arc as Shared;

use gcheck_engine::{Axis, Position};

use super::curve::Curve;
use super::difference::{Differences, Place};
use super::digest::Digest;
use crate::trail::{Act, Doing, Driven, Move};

/// Acts that are given together and are matched with each other at most.
const MAX_STANDS: usize = 64;

/// An act, and in which of the sections that are compared it is, from 0.
pub(super) type Placed = (u32, Act);

/// A place in a run.
pub(super) struct Cursor<I: Iterator<Item = Placed>> {
    pub(super) acts: Peekable<I>,
    /// What is read again before the next act.
    pub(super) back: VecDeque<Placed>,
    /// The section of what was read last.
    pub(super) section: u32,
    /// The section in which a move was done last.
    pub(super) done_in: Option<u32>,
    /// The move at hand, as far as it is not done.
    pub(super) piece: Option<Piece>,
    /// Where the axes are.
    pub(super) at: Position,
    /// An axis has moved. Before that, a move that goes nowhere may be the other side's way from an unknown place.
    pub(super) started: bool,
    /// Axes that a move at feed has brought to an unknown place, and nothing since to a known one.
    lost: [bool; Axis::ALL.len()],
    /// The next move is the first one that is compared after what was not compared.
    pub(super) is_afresh: bool,
    /// The last move that was done.
    pub(super) last: Option<Place>,
}

/// A move, of which a part may be done.
pub(super) struct Piece {
    pub(super) act: Act,
    pub(super) driven: Driven,
    pub(super) curve: Curve,
    /// From 0 to 1.
    pub(super) done: f64,
}

impl<I: Iterator<Item = Placed>> Cursor<I> {
    pub(super) fn new(acts: I, is_afresh: bool) -> Self {
        Self {
            acts: acts.peekable(),
            back: VecDeque::new(),
            section: 0,
            done_in: None,
            piece: None,
            at: Position::UNKNOWN,
            started: false,
            lost: [false; Axis::ALL.len()],
            is_afresh,
            last: None,
        }
    }

    pub(super) fn next(&mut self) -> Option<Placed> {
        let placed = self.back.pop_front().or_else(|| self.acts.next())?;
        self.section = placed.0;
        Some(placed)
    }

    pub(super) fn peek(&mut self) -> Option<&Placed> {
        match self.back.front() {
            Some(placed) => Some(placed),
            None => self.acts.peek(),
        }
    }

    /// Collects what happens before the next move, and takes up that move.
    pub(super) fn advance(&mut self, found: &mut Differences) -> Vec<Placed> {
        let mut stands = Vec::new();
        while self.piece.is_none() && stands.len() < MAX_STANDS {
            let Some((section, act)) = self.next() else { break };
            match &act.doing {
                Doing::Stand(_) => stands.push((section, act)),
                Doing::Move(made) => {
                    let curve = if std::mem::take(&mut self.is_afresh) {
                        from_anywhere(made)
                    } else {
                        Curve::new(made)
                    };
                    let driven = made.driven;
                    found.unknown |= driven != Driven::Rapid && curve.is_unknown();
                    let is_lost = self.loses(made);
                    if curve.is_nothing() && self.started && !is_lost {
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

    /// Where an axis was cut to an unknown place, it may move although nothing shows it. Way to a reference position or to a
    /// tool change does not count: what is unknown there belongs to the machine.
    fn loses(&mut self, made: &Move) -> bool {
        let cuts = made.driven != Driven::Rapid;
        for (axis, lost) in Axis::ALL.into_iter().zip(&mut self.lost) {
            let (from, to) = (made.from.raw(axis), made.to.raw(axis));
            *lost = to.is_nan() && (*lost || cuts && !from.is_nan());
        }
        self.lost.contains(&true)
    }

    /// Leaves the last ones of what was read to be read again.
    pub(super) fn put_back(&mut self, read: &mut Vec<Placed>, count: usize) {
        let first = read.len().saturating_sub(count);
        for placed in read.drain(first..).rev() {
            self.back.push_front(placed);
        }
    }

    /// Ends the move at hand.
    pub(super) fn finish(&mut self) {
        if let Some(piece) = self.piece.take() {
            self.at = piece.curve.end();
            self.last = Some(piece.place());
            self.done_in = Some(self.section);
        }
    }

    /// Passes over everything before a section, and begins there afresh.
    pub(super) fn begin(&mut self, section: u32, over: &mut Digest) {
        (self.at, self.started, self.is_afresh) = (Position::UNKNOWN, false, true);
        if self.section >= section {
            // It is there, and has not moved.
            if let Some(piece) = self.piece.take() {
                self.back.push_back((self.section, piece.act));
            }
            return;
        }
        if let Some(piece) = self.piece.take() {
            over.add(&(piece.done, &piece.act.setting, &piece.act.doing));
        }
        while self.peek().is_some_and(|(of, _)| *of < section) {
            if let Some((_, act)) = self.next() {
                over.add(&(&act.setting, &act.doing));
            }
        }
        self.section = section;
    }

    /// Was a part of the section done?
    pub(super) fn has_moved(&self) -> bool {
        self.done_in == Some(self.section) || self.piece.as_ref().is_some_and(|piece| piece.done > 0.0)
    }

    /// Is there no further move?
    pub(super) fn is_over(&mut self) -> bool {
        self.piece.is_none() && self.peek().is_none()
    }

    /// Is the next act one without motion?
    pub(super) fn stands_next(&mut self) -> bool {
        self.piece.is_none() && self.peek().is_some_and(|(_, act)| matches!(act.doing, Doing::Stand(_)))
    }
}

/// The move, from wherever the run comes: where the paths had parted, both may come from different places.
fn from_anywhere(made: &Move) -> Curve {
    Curve::new(&Move { from: Position::UNKNOWN, ..made.clone() })
}

impl Act {
    pub(crate) fn place(&self) -> Place {
        Place { file: Shared::clone(&self.file), line: self.line }
    }
}

impl Piece {
    pub(super) fn place(&self) -> Place {
        self.act.place()
    }

    pub(super) fn left(&self) -> f64 {
        self.curve.length() * (1.0 - self.done)
    }
}
