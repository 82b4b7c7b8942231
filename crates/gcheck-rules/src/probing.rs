//! Probing and measuring codes: which block has one, and in which modes it runs.
//!
//! Knows: effects of codes that touch with a probe, modes as a block has them while it moves. Must not know: any rule.

use gcheck_controls::{Code, CodeIx, Effect};
use gcheck_engine::{At, Axis, Role, Way, Ways};

use crate::PathCx;

/// The mode of a role while a block moves.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum ModeInBlock {
    /// The block itself says it.
    Written(CodeIx),
    /// It was in effect before.
    Before(CodeIx),
    /// It may be any of these; empty when nothing is known.
    Several(Vec<CodeIx>),
}

impl PathCx<'_> {
    /// The code of the block that touches or measures, but for the probing modes of motion.
    pub(crate) fn probing_code(&self) -> Option<CodeIx> {
        if !self.has_effect(is_touch) {
            return None;
        }
        self.codes().iter().copied().find(|code| is_touch(self.model.effect(*code)))
    }

    /// Does the block name an axis?
    pub(crate) fn names_axes(&self) -> bool {
        let control = self.scene.control();
        self.origin().letters.iter().any(|letter| control.letter(letter).is_some_and(|entry| entry.axis))
    }

    /// A code of the control.
    pub(crate) fn code_of(&self, code: CodeIx) -> Option<Code<'_>> {
        self.scene.control().code_at(code)
    }

    /// The mode of a role while the block moves: modes act before the move, wherever they stand in the block.
    pub(crate) fn mode_in_block(&self, role: Role) -> ModeInBlock {
        if let Some(code) = self.code_of_role(role) {
            return ModeInBlock::Written(code);
        }
        let mode = self.state().mode(role);
        match mode.only() {
            Some(code) => ModeInBlock::Before(code),
            None => ModeInBlock::Several(mode.alternatives().to_vec()),
        }
    }
}

/// Blocks around a touch that go to it and away from it.
const NEAR: u32 = 12;

impl PathCx<'_> {
    /// Does a block near this one have a code that `is` says yes to, with no tool change and no start of the spindle between
    /// them? Feed moves around a touch go to it and away from it, and cut nothing.
    pub(crate) fn is_near(&self, is: impl Fn(Effect) -> bool) -> bool {
        let here = self.origin().at;
        let is_there = |block: u32| {
            let place = self.place_of(At { block, ..here })?;
            let codes = place.table.words(place.block()).iter().map(|word| self.model.effect(word.code));
            let mut parts = false;
            for effect in codes {
                if is(effect) {
                    return Some(true);
                }
                parts |= parts_sections(effect);
            }
            parts.then_some(false)
        };
        let first = here.block.saturating_sub(NEAR);
        let before = (first..=here.block).rev().find_map(is_there);
        let behind = (here.block + 1..=here.block.saturating_add(NEAR)).find_map(is_there);
        before == Some(true) || behind == Some(true)
    }
}

/// What comes behind is another piece of work.
fn parts_sections(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::ToolChange
            | Effect::SpindleClockwise
            | Effect::SpindleCounterClockwise
            | Effect::SpindleClockwiseWithCoolant
            | Effect::SpindleCounterClockwiseWithCoolant
    )
}

/// Does a code with this effect move until the probe answers?
pub(crate) fn is_touch(effect: Effect) -> bool {
    effect == Effect::Skip || is_measurement(effect)
}

/// Does it write what was touched into a table?
pub(crate) fn is_measurement(effect: Effect) -> bool {
    is_second_touch(effect) || matches!(effect, Effect::ProbeOffset | Effect::ProbeLength)
}

/// Does it measure between a touch kept before and its own?
pub(crate) fn is_second_touch(effect: Effect) -> bool {
    matches!(effect, Effect::ProbeDiameter | Effect::ProbeCentre)
}

/// Axes that a probing move drives, or may drive, with the way along each.
pub(crate) fn driven(ways: Ways) -> impl Iterator<Item = (Axis, Way)> {
    Axis::ALL.into_iter().map(move |axis| (axis, ways.of(axis))).filter(|(_, way)| *way != Way::Still)
}
