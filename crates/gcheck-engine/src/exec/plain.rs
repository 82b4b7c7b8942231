//! Blocks that only move, one after the other: nearly all of a large program.
//!
//! Knows: when a block of axis words and nothing else is a straight move without any more to it, and makes it. Must not know:
//! what such a block means when there is more to it; then it does nothing, and the step does. What it does is what the step
//! would do.

use gcheck_controls::{CodeIx, Effect, LetterSet};
use gcheck_program::{Block, Value, Word};

use crate::eval::value::{Domain, Truth};
use crate::event::{Event, FeedMode, Travel, TravelKind, Units};
use crate::exec::context::{Cursor, Executor};
use crate::model::Role;
use crate::observer::Observer;
use crate::origin::{At, Origin};
use crate::position::Axis;
use crate::state::State;

/// What blocks that only move need of the state, and none of them changes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlainMoves {
    kind: TravelKind,
    /// Millimetres in a unit of the program.
    unit: f64,
    incremental: bool,
    diameter: bool,
    /// Axes that a block may name.
    letters: LetterSet,
}

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// Does the block at `at` only move, in this state?
    pub(crate) fn plain_moves(&self, at: At, state: &State<D>) -> Option<PlainMoves> {
        let (_, block, _) = plain_block(self.cursor.as_ref(), at)?;
        if !block.letters.without(self.model.axis_letters).is_empty() {
            return None;
        }
        let kind = match self.model.effect(state.mode(Role::Motion).only()?) {
            Effect::Rapid => TravelKind::Rapid,
            Effect::Linear => TravelKind::Feed,
            _ => return None,
        };
        let goes_straight = state.active_cycle(self.model) == Some(CodeIx::NONE)
            && Self::goes_direct(state)
            && state.calls.modal.is_off()
            && state.data_entry == Truth::False
            && state.wrapped().is_no()
            && !state.tool_shift.is_on()
            && MAPPINGS.iter().all(|role| self.is_unmapped(*role, state));
        let feeds = kind == TravelKind::Rapid
            || state.feed_mode(self.model).is_some_and(|mode| mode != FeedMode::InverseTime)
                && self.check_feed(state).is_ok();
        if !goes_straight || !feeds {
            return None;
        }
        let goes_as_written = |axis: &Axis| {
            self.machine.axes.as_ref().is_none_or(|axes| axes.contains(axis))
                && !self.machine.shorter_way.contains(axis)
        };
        Some(PlainMoves {
            kind,
            unit: state.units(self.model).map(Units::in_mm)?,
            incremental: state.is_incremental(self.model)?,
            diameter: state.words_are_diameters(self.model)?,
            letters: self
                .model
                .axes
                .iter()
                .filter(|axis| goes_as_written(axis))
                .map(|axis| axis.letter())
                .collect::<LetterSet>()
                .without(self.watched_letters()),
        })
    }

    /// Is a mode that may bend or turn the way of the axes known to be off?
    fn is_unmapped(&self, role: Role, state: &State<D>) -> bool {
        state.mode(role).only().is_some_and(|code| {
            !matches!(
                self.model.effect(code),
                Effect::PolarOn
                    | Effect::CylinderMapping
                    | Effect::PolarInterpolationOn
                    | Effect::DynamicOffsetOn
                    | Effect::TiltedPlaneOn
                    | Effect::LengthFiveAxis
                    | Effect::ToolCentrePoint
            )
        })
    }

    /// Executes the block at `at`, if it is one of those. `false`: nothing was done.
    pub(crate) fn plain_move(&mut self, moves: &PlainMoves, at: At, state: &mut State<D>) -> bool {
        let Some((cursor, block, words)) = plain_block(self.cursor.as_ref(), at) else { return false };
        if !block.letters.without(moves.letters).is_empty() {
            return false;
        }
        let mut target = *state.position();
        for word in words {
            let (Some((axis, _)), Value::Number(number)) = (self.model.axis_of(word.letter), word.value)
            else {
                return false;
            };
            if !number.is_finite() {
                return false;
            }
            // Zero has no sign.
            let mut value = number + 0.0;
            if !axis.is_rotary() {
                value *= moves.unit;
            }
            if axis == Axis::X && moves.diameter {
                value /= 2.0;
            }
            if moves.incremental && target.raw(axis).is_nan() {
                return false;
            }
            target.set(axis, if moves.incremental { target.raw(axis) + value } else { value });
        }
        let base = cursor.place.base;
        self.origin = Origin {
            at,
            start: base + block.range.start,
            end: base + block.range.end,
            flags: block.flags,
            letters: block.letters,
            n: None,
        };
        self.observer.before(self.origin, state);
        let event = Event::Travel(Travel {
            kind: moves.kind,
            from: *state.actual(),
            programmed: target,
            to: target,
            expanded: false,
        });
        state.points.actual = target;
        self.observer.event(self.origin, state, &event);
        state.points.position = target;
        self.observer.after(self.origin, state);
        true
    }
}

/// Modes under which the axes may go another way than the words say.
const MAPPINGS: [Role; 6] = [
    Role::Polar,
    Role::Cylinder,
    Role::PolarInterpolation,
    Role::DynamicOffset,
    Role::TiltedPlane,
    Role::Length,
];

/// The block at `at`, if it is in the chunk that execution is in and there is nothing about it but words with numbers.
fn plain_block<'c, 'p>(
    cursor: Option<&'c Cursor<'p>>,
    at: At,
) -> Option<(&'c Cursor<'p>, &'c Block, &'c [Word])> {
    let cursor = cursor.filter(|cursor| cursor.file_index == at.file)?;
    let table = &*cursor.place.table;
    let ix = table.ix(at.block.checked_sub(cursor.first)?)?;
    let block = table.block(ix);
    let is_plain = block.flags.is_empty()
        && !block.letters.is_empty()
        && at.block < cursor.file.loaded.flow_graph().blocks();
    is_plain.then(|| (cursor, block, table.words(block)))
}
