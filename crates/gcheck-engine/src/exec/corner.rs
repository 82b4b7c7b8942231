//! Corners that a word of the block shapes: a chamfer (`,C`) or a rounding (`,R`) between two straight cuts, and the line that
//! an angle gives (`,A`).
//!
//! Knows: which words shape a corner, where the second cut goes, where the piece between the two begins and ends. Must not know:
//! how a profile cycle uses the pieces, how the path beside them is found.
//!
//! The corner itself stays the programmed point, from which increments of the next block count. The axes wait where the piece
//! ends, which is a point of the next cut (Haas mill operator's manual of 2017, pages 250 and 251).

use std::rc::Rc;

use gcheck_controls::{CodeIx, Effect, LetterSet};
use gcheck_geometry::{Arc, ArcDirection, Mm, Plane};
use gcheck_program::BlockFlags;

use super::arc::{arc_fault, plane_axes};
use super::effects::compensation::above;
use crate::cycles::ProfileSegment;
use crate::eval::value::Domain;
use crate::event::{Event, TravelKind};
use crate::exec::context::{Executor, Step};
use crate::fault::{CornerFault, Fault};
use crate::lattice::Perhaps;
use crate::model::Role;
use crate::observer::Observer;
use crate::origin::{At, Origin};
use crate::position::Position;
use crate::state::{Course, State};

/// Blocks that may be between the two cuts of a corner: pauses, comments, coolant.
const MOST_BETWEEN: u32 = 16;

/// What happens at the corner after a straight piece.
#[derive(Debug, Clone, Copy)]
pub(super) enum Corner {
    /// A fillet of this radius, millimetres.
    Round(f64),
    /// A chamfer that begins and ends this far from the corner, millimetres.
    Chamfer(f64),
}

/// A corner that is cut: where it begins, its piece, where it ends.
pub(super) type CutCorner = ((f64, f64), ProfileSegment, (f64, f64));

/// How a corner fits between two straight pieces.
#[derive(Debug, Clone, Copy)]
pub(super) enum Fit {
    /// It is cut.
    Cut(CutCorner),
    /// The two pieces go on in one direction: nothing is to be cut.
    Straight,
    /// It takes more of a piece than there is; `available` is the shorter of the two, millimetres.
    TooLong {
        /// Millimetres from the corner to where its piece begins; infinite where the second cut goes straight back.
        needed: f64,
        /// Millimetres.
        available: f64,
    },
    /// Something about it is not known.
    Unknown,
}

/// Where the cut after a corner goes.
enum NextCut {
    /// Straight to this point.
    Straight(Position),
    /// There is none before the program or the cut ends.
    Missing,
    /// The next move is a rapid one.
    Rapid,
    /// It is an arc.
    Arc,
    /// It is not known.
    Unknown,
}

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// The corner that the words of the block ask for.
    pub(super) fn corner_of_block(&self, state: &State<D>) -> Option<Corner> {
        let words = &self.model.corners;
        let present = self.words.present();
        if !present.intersects(words.corners()) {
            return None;
        }
        let size = |letters: LetterSet| {
            let letter = present.and(letters).iter().next()?;
            self.length(letter, state).map(f64::abs)
        };
        let corner =
            size(words.round).map(Corner::Round).or_else(|| size(words.chamfer).map(Corner::Chamfer))?;
        let (Corner::Round(size) | Corner::Chamfer(size)) = corner;
        (size != 0.0).then_some(corner)
    }

    /// Does the block give its line by an angle?
    pub(super) fn has_angle(&self) -> bool {
        self.words.present().intersects(self.model.corners.angle)
    }

    /// One coordinate of the plane and the angle of the line from the plane's first axis give the other coordinate.
    pub(super) fn aim(&self, target: &mut Position, state: &State<D>) {
        let letter = self.words.present().and(self.model.corners.angle).iter().next();
        let Some(angle) = letter.and_then(|letter| self.words.number(letter)) else { return };
        let Some(plane) = state.plane(self.model) else { return };
        let ([first, second, _], _) = plane_axes(plane);
        let tangent = angle.to_radians().tan();
        match (self.names_axis(first), self.names_axis(second)) {
            (true, false) => {
                let way = target.raw(first) - state.position().raw(first);
                target.set(second, state.position().raw(second) + way * tangent);
            }
            (false, true) => {
                let way = target.raw(second) - state.position().raw(second);
                target.set(first, state.position().raw(first) + way / tangent);
            }
            _ => {}
        }
    }

    /// A straight cut whose end is shaped towards the next one.
    pub(super) fn cut_to_corner(&mut self, target: Position, corner: Corner, state: &mut State<D>) -> Step {
        let next = self.next_cut(&target, state);
        let from = self.end_of_last_piece(state);
        let fit = match (&next, state.plane(self.model)) {
            (NextCut::Straight(end), Some(plane)) if self.stays_in_plane(plane) => {
                let local = |position: &Position| {
                    let [first, second, _] = plane.to_local(position.xyz());
                    (first.0, second.0)
                };
                cut_corner(local(&from), local(&target), local(end), corner)
            }
            _ => Fit::Unknown,
        };
        let needs_lines = self.model.semantics().arcs.corner_needs_lines;
        let fault = match (next, fit) {
            (NextCut::Missing, _) => CornerFault::NoCutAfter,
            (NextCut::Arc, _) if needs_lines => CornerFault::NoCutAfter,
            (_, Fit::Straight) if needs_lines => CornerFault::NoTurn,
            (NextCut::Rapid, _) => CornerFault::RapidAfter,
            (_, Fit::TooLong { needed, available }) => CornerFault::TooLong { needed, available },
            (_, Fit::Cut(cut)) => return self.cut_with_corner(&from, target, &cut, state),
            (_, Fit::Straight) => return self.travel(TravelKind::Feed, target, false, state),
            (_, Fit::Unknown) => {
                self.travel(TravelKind::Feed, target, false, state)?;
                self.emit(state, Event::Unfollowed);
                return Ok(());
            }
        };
        let refused = self.held(Err(Fault::Corner(fault)))?;
        self.travel(TravelKind::Feed, target, false, state)?;
        refused
    }

    /// Where the cut before ends as it is programmed: a corner before this one ends on the line to it.
    fn end_of_last_piece(&self, state: &State<D>) -> Position {
        match &state.compensation.on {
            Perhaps::Yes(Course::Followed(path)) => {
                let programmed = above(state.actual(), path.compensator.programmed(), path.plane);
                self.programmed_of(&programmed, state)
            }
            _ if state.compensation.is_off() => self.programmed_of(state.actual(), state),
            // Beside a path that is not followed, the corner is what is known.
            _ => *state.position(),
        }
    }

    /// Does the block name axes of the plane alone?
    fn stays_in_plane(&self, plane: Plane) -> bool {
        let ([first, second, _], _) = plane_axes(plane);
        self.words
            .present()
            .and(self.model.axis_letters)
            .iter()
            .all(|letter| self.model.axis_of(letter).is_some_and(|(axis, _)| axis == first || axis == second))
    }

    fn cut_with_corner(
        &mut self,
        from: &Position,
        target: Position,
        cut: &CutCorner,
        state: &mut State<D>,
    ) -> Step {
        let (begin, piece, end) = *cut;
        let Some(plane) = state.plane(self.model) else { return Ok(()) };
        let [_, _, height] = plane.to_local(target.xyz());
        let at = |(first, second): (f64, f64)| target.with_xyz(plane.to_xyz([Mm(first), Mm(second), height]));
        let [first, second, _] = plane.to_local(from.xyz());
        // A corner may take all of the cut before it.
        if (begin.0 - first.0).hypot(begin.1 - second.0) > 1e-9 {
            self.travel(TravelKind::Feed, at(begin), false, state)?;
        }
        match piece {
            ProfileSegment::Line { .. } => self.travel(TravelKind::Feed, at(end), true, state)?,
            ProfileSegment::Arc { centre, ccw, .. } => {
                let direction = if ccw { ArcDirection::Ccw } else { ArcDirection::Cw };
                let tolerance = self.arc_tolerance(state);
                let (start, end) = (at(begin), at(end));
                let arc = Arc::by_centre(plane, start.xyz(), end.xyz(), centre, direction, 1, &tolerance)
                    .map_err(|error| Fault::Arc(arc_fault(&error)))?;
                self.along_arc(&arc, 1, &end, true, state)?;
            }
        }
        state.points.position = target;
        Ok(())
    }

    /// Looks at the blocks after this one for the cut that ends the corner. Nothing moves, and nobody is told: what those
    /// blocks read, assume or do wrong counts when they are executed.
    fn next_cut(&mut self, corner: &Position, state: &State<D>) -> NextCut {
        let (origin, words, cursor) = (self.origin, self.words.clone(), self.cursor.clone());
        let (refused, assumptions) = (self.refused.take(), self.assumptions.clone());
        let pending = std::mem::take(&mut self.pending);
        let mut ahead = state.clone();
        ahead.points.position = *corner;
        self.looks_ahead = true;
        let found = self.find_cut(origin.at, &mut ahead);
        self.looks_ahead = false;
        let is_refused = std::mem::replace(&mut self.refused, refused).is_some();
        self.assumptions = assumptions;
        self.pending = pending;
        self.origin = origin;
        self.words = words;
        // A chunk that was looked at is entered when its first block is executed.
        self.cursor = cursor;
        match found {
            Ok(cut) if !is_refused => cut,
            _ => NextCut::Unknown,
        }
    }

    fn find_cut(&mut self, from: At, ahead: &mut State<D>) -> Step<NextCut> {
        let mut at = from;
        for _ in 0..MOST_BETWEEN {
            at = at.next();
            let Some(place) = self.place(at) else { return Ok(NextCut::Missing) };
            let table = Rc::clone(&place.table);
            let block = table.block(place.ix);
            if block.flags.contains(BlockFlags::BLOCK_DELETE) && self.options.skips(block.delete) {
                continue;
            }
            if block.flags.contains(BlockFlags::TAPE_MARK) {
                return Ok(NextCut::Missing);
            }
            let unread = BlockFlags::ERROR | BlockFlags::STATEMENT | BlockFlags::UNKNOWN_CODE;
            if block.flags.intersects(unread) {
                return Ok(NextCut::Unknown);
            }
            let words = table.words(block);
            if words.is_empty() {
                continue;
            }
            self.origin = Origin {
                at,
                start: place.base + block.range.start,
                end: place.base + block.range.end,
                flags: block.flags,
                letters: block.letters,
                n: None,
            };
            self.read_words(&place, &table, words, ahead)?;
            if let Some(cut) = self.cut_of_words(ahead)? {
                return Ok(cut);
            }
        }
        Ok(NextCut::Unknown)
    }

    /// Where the words of a block cut to; `None` where they do not move.
    fn cut_of_words(&mut self, ahead: &mut State<D>) -> Step<Option<NextCut>> {
        let codes = self.words.codes().to_vec();
        // A code of the block may change what its other words mean.
        let mut is_unsure = false;
        for ix in codes {
            let Some(code) = self.model.code(ix).copied() else { continue };
            match (code.role, code.effect) {
                (Some(role @ (Role::Motion | Role::Distance)), _) => ahead.set_mode(role, ix),
                (_, Effect::Dwell) => return Ok(None),
                (_, Effect::ReturnReference(_)) => return Ok(Some(NextCut::Rapid)),
                (_, Effect::MachineCoordinates) => {
                    let is_rapid = ahead.effect(Role::Motion, self.model) == Some(Effect::Rapid)
                        || self.words.codes().iter().any(|ix| self.model.effect(*ix) == Effect::Rapid);
                    return Ok(Some(if is_rapid { NextCut::Rapid } else { NextCut::Unknown }));
                }
                (_, Effect::ProgramEnd | Effect::ProgramEndWithPallet) => return Ok(Some(NextCut::Missing)),
                (None, effect) if self.is_function(ix, effect) => {}
                _ => is_unsure = true,
            }
        }
        let Some(plane) = ahead.plane(self.model) else { return Ok(Some(NextCut::Unknown)) };
        let ([first, second, _], _) = plane_axes(plane);
        let present = self.words.present();
        let named = present.and(self.model.axis_letters);
        if named.is_empty() {
            let shapes = present.intersects(LetterSet::of("IJKR")) || self.has_angle();
            return Ok((shapes || is_unsure).then_some(NextCut::Unknown));
        }
        let effect = ahead.mode(Role::Motion).only().map(|mode| self.model.effect(mode));
        Ok(Some(match effect {
            Some(Effect::Rapid) => NextCut::Rapid,
            _ if is_unsure => NextCut::Unknown,
            Some(Effect::Linear) => {
                if !self.names_axis(first) && !self.names_axis(second) {
                    NextCut::Missing
                } else if self.stays_in_plane(plane) {
                    let mut end = self.target(ahead)?;
                    self.aim(&mut end, ahead);
                    NextCut::Straight(end)
                } else {
                    NextCut::Unknown
                }
            }
            Some(Effect::ArcClockwise | Effect::ArcCounterClockwise) => NextCut::Arc,
            _ => NextCut::Unknown,
        }))
    }

    /// Is a code one of the machine's switches, beside which the axes stay where they are?
    fn is_function(&self, ix: CodeIx, effect: Effect) -> bool {
        let code = self.model.control().code_at(ix);
        let moves = effect.owns_axes()
            || matches!(
                effect,
                Effect::CallProgram | Effect::CallLocal | Effect::Return | Effect::JumpUnlessInput
            );
        code.is_some_and(|code| code.number().letter() == b'M' && !code.is_user()) && !moves
    }
}

/// How a corner fits between the straight piece that leads to it and the one that leaves it; `from` is where the tool is.
pub(super) fn cut_corner(from: (f64, f64), corner: (f64, f64), to: (f64, f64), shape: Corner) -> Fit {
    let (before, after) = ((corner.0 - from.0, corner.1 - from.1), (to.0 - corner.0, to.1 - corner.1));
    let (length, other) = (before.0.hypot(before.1), after.0.hypot(after.1));
    let (Corner::Chamfer(size) | Corner::Round(size)) = shape;
    let available = length.min(other);
    if available < 1e-9 {
        return Fit::TooLong { needed: size, available: 0.0 };
    }
    let (d, e) = ((before.0 / length, before.1 / length), (after.0 / other, after.1 / other));
    let cross = d.0 * e.1 - d.1 * e.0;
    let dot = d.0 * e.0 + d.1 * e.1;
    if !(cross.is_finite() && dot.is_finite() && size.is_finite()) {
        return Fit::Unknown;
    }
    if cross.abs() <= 1e-9 {
        return if dot > 0.0 { Fit::Straight } else { Fit::TooLong { needed: f64::INFINITY, available } };
    }
    let way = match shape {
        Corner::Chamfer(size) => size,
        Corner::Round(radius) => radius * (cross.atan2(dot).abs() / 2.0).tan(),
    };
    if way <= 0.0 || way > available + 1e-6 {
        return Fit::TooLong { needed: way, available };
    }
    let begin = (corner.0 - d.0 * way, corner.1 - d.1 * way);
    let end = (corner.0 + e.0 * way, corner.1 + e.1 * way);
    let to = (Mm(end.0), Mm(end.1));
    let piece = match shape {
        Corner::Chamfer(_) => ProfileSegment::Line { to, rapid: false },
        Corner::Round(radius) => {
            let leftward = radius * cross.signum();
            let centre = (Mm(begin.0 - d.1 * leftward), Mm(begin.1 + d.0 * leftward));
            ProfileSegment::Arc { to, centre, ccw: cross > 0.0 }
        }
    };
    Fit::Cut((begin, piece, end))
}
