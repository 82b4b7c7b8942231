//! The stretches that are known ahead of the tool.
//!
//! Knows: with which speed each may be left so that the axes can stop where knowledge ends. Must not know: corners,
//! programs, what a stretch is for.

use std::collections::VecDeque;

use crate::profile::highest_entry;

/// A stretch on its way to being run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece<D> {
    pub(crate) length: f64,
    /// Highest speed along it.
    pub(crate) cap: f64,
    /// Highest speed at its start, where that is less.
    pub(crate) enter: f64,
    pub(crate) acceleration: f64,
    /// Highest speed at its end.
    pub(crate) leave: f64,
    /// Speed at its end, as far as is known.
    pub(crate) exit: f64,
    /// What else is known of it.
    pub(crate) data: D,
}

/// Pieces in order; the last one ends in a stop until there is another.
#[derive(Debug, Clone)]
pub(crate) struct Window<D> {
    pieces: VecDeque<Piece<D>>,
    ahead: usize,
}

impl<D> Window<D> {
    /// One that sees this many pieces ahead of the one that is run.
    pub(crate) fn new(ahead: usize) -> Self {
        let ahead = ahead.max(1);
        Self { pieces: VecDeque::with_capacity(ahead.min(4096) + 2), ahead }
    }

    /// Puts a piece at the end. Its neighbour's end is then no stop any more.
    pub(crate) fn push(&mut self, piece: Piece<D>) {
        let (mut next_exit, mut next_cap) = (0.0_f64, piece.cap.min(piece.enter));
        let (mut acceleration, mut length) = (piece.acceleration, piece.length);
        self.pieces.push_back(Piece { exit: 0.0, ..piece });
        for piece in self.pieces.iter_mut().rev().skip(1) {
            let reachable = highest_entry(next_exit, acceleration, length);
            let exit = reachable.min(piece.leave).min(piece.cap).min(next_cap);
            // What lies further back knows of nothing new.
            if exit <= piece.exit {
                break;
            }
            piece.exit = exit;
            (next_exit, next_cap) = (exit, piece.cap.min(piece.enter));
            (acceleration, length) = (piece.acceleration, piece.length);
        }
    }

    /// What goes along with the last piece.
    pub(crate) fn last_mut(&mut self) -> Option<&mut D> {
        self.pieces.back_mut().map(|piece| &mut piece.data)
    }

    /// The first piece, once as much is known ahead of it as the control looks ahead.
    pub(crate) fn pop_known(&mut self) -> Option<Piece<D>> {
        if self.pieces.len() > self.ahead { self.pieces.pop_front() } else { None }
    }

    /// The first piece, with the stop at the end of the last one.
    pub(crate) fn pop(&mut self) -> Option<Piece<D>> {
        self.pieces.pop_front()
    }
}
