//! Canned cycles and other operations of several moves: which one a block makes, which words it has, where one left on does harm.
//!
//! Knows: effects of cycles, how long their words last. Must not know: any rule, the moves of a cycle.

use std::collections::BTreeMap;
use std::ops::Range;

use gcheck_controls::{Code, CodeIx, Effect, Letter, LetterSet};
use gcheck_engine::{At, Event, Role};

use crate::facts::boundary::{Boundary, boundary, boundary_range};
use crate::{PathCx, remembers};

/// Bytes of the code that names the cycle; the block when none does.
pub(crate) fn cycle_range(cx: &PathCx<'_>) -> Range<u32> {
    cx.effect_range(|effect| is_cycle(effect) || is_operation(effect))
}

/// Does the code mill a round pocket in its block?
pub(crate) fn is_round_pocket(effect: Effect) -> bool {
    matches!(effect, Effect::CircularPocketClockwise | Effect::CircularPocketCounterClockwise)
}

/// Does the code cut a pocket?
pub(crate) fn is_pocket(effect: Effect) -> bool {
    is_round_pocket(effect) || effect == Effect::GeneralPocket
}

/// Is it a canned cycle that stays on?
pub(crate) fn is_cycle(effect: Effect) -> bool {
    Role::of(effect) == Some(Role::Cycle) && effect != Effect::CycleCancel
}

/// Does the cycle drill into the full?
pub(crate) fn is_drilling(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::CycleDrill | Effect::CycleDrillDwell | Effect::CyclePeck | Effect::CycleChipBreak
    )
}

/// Is it a cycle that taps?
pub(crate) fn is_tapping(effect: Effect) -> bool {
    effect.is_tapping_cycle()
}

/// Is a cycle in effect that drills into the full?
pub(crate) fn drills_by_cycle(cx: &PathCx<'_>) -> bool {
    let cycle = cx.state().active_cycle(cx.model).filter(|code| code.is_some());
    cycle.is_some_and(|code| is_drilling(cx.model.effect(code)))
}

/// The operation of several moves that the block makes: one of its own, or the canned cycle in effect.
pub(crate) fn cycle_code<'a>(cx: &PathCx<'a>) -> Option<Code<'a>> {
    let control = cx.control();
    let own = cx.codes().iter().copied().find(|ix| is_operation(cx.model.effect(*ix)));
    let active = || cx.state().active_cycle(cx.model).filter(|ix| ix.is_some());
    control.code_at(own.or_else(active)?)
}

/// The code of the operation that the block makes, as programs write it.
pub(crate) fn cycle_name(cx: &PathCx<'_>) -> String {
    cycle_code(cx).map_or_else(String::new, |code| code.number().to_string())
}

/// Is the operation one of the block itself, not a canned cycle that stays on?
pub(crate) fn is_own_operation(cx: &PathCx<'_>) -> bool {
    cycle_code(cx).is_some_and(|code| is_operation(code.effect()))
}

/// Does it make several moves from the words of one block?
pub(crate) fn is_operation(effect: Effect) -> bool {
    use Effect as E;
    matches!(
        effect,
        E::CircularPocketClockwise
            | E::CircularPocketCounterClockwise
            | E::GeneralPocket
            | E::BoltCircle
            | E::BoltArc
            | E::BoltLine
            | E::TurningPass
            | E::ThreadingPass
            | E::FacingPass
            | E::ThreadCycle
            | E::FinishProfile
            | E::RoughAlongZ
            | E::RoughAlongX
            | E::RepeatPattern
            | E::GrooveFace
            | E::GrooveDiameter
    )
}

/// Words of canned cycles, series by series.
#[derive(Default, Clone, PartialEq)]
pub(crate) struct Series {
    /// Words given since the cycle began, with the block that gave them last.
    pub(crate) given: BTreeMap<Letter, At>,
    /// Words of earlier series.
    lost: BTreeMap<Letter, LostWord>,
}

remembers!(Series: given, lost);

/// A word that ended with its series.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct LostWord {
    /// The block that gave it.
    pub(crate) given: At,
    /// The block that ended its series.
    pub(crate) ended: At,
}

remembers!(LostWord: given, ended);

/// Words that last as long as the cycle.
const LASTING: LetterSet = LetterSet::of("XYZRQPIJKE");

impl Series {
    /// A block is about to be executed. Gives the cycle that it begins.
    pub(crate) fn block(&mut self, cx: &PathCx<'_>) -> Option<CodeIx> {
        let named = cx.codes().iter().copied().find(|ix| is_cycle(cx.model.effect(*ix)));
        let active = cx.state().active_cycle(cx.model);
        // Where cycles are motion modes, another one takes no words over.
        let replaces =
            |code: CodeIx| active.is_some_and(|active| active != code) && cx.model.cycles_are_motion;
        let begins = named.filter(|code| active == Some(CodeIx::NONE) || replaces(*code));
        if begins.is_some() {
            self.end(cx.origin().at);
        }
        if named.is_some() || active.is_some_and(CodeIx::is_some) {
            let at = cx.origin().at;
            self.given.extend(cx.origin().letters.and(LASTING).iter().map(|letter| (letter, at)));
        }
        begins
    }

    /// Something happened that may end the series.
    pub(crate) fn changed(&mut self, cx: &PathCx<'_>, event: &Event) {
        let Event::Modal(code) = event else { return };
        let ends = match cx.model.role(*code) {
            Some(Role::Motion) => cx.model.semantics().cycles.motion_ends_cycle,
            Some(Role::Cycle) => cx.model.effect(*code) == Effect::CycleCancel,
            _ => false,
        };
        if ends {
            self.end(cx.origin().at);
        }
    }

    fn end(&mut self, ended: At) {
        for (letter, given) in std::mem::take(&mut self.given) {
            self.lost.insert(letter, LostWord { given, ended });
        }
    }

    /// A word that was given in a series that has ended.
    pub(crate) fn lost(&self, letter: Letter) -> Option<&LostWord> {
        self.lost.get(&letter)
    }
}

/// A place where a cycle that was left on does harm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CycleBoundary {
    /// The tool is changed.
    ToolChange,
    /// The axes return to the reference position.
    Return,
    /// The program ends.
    ProgramEnd,
}

impl CycleBoundary {
    /// As findings name it.
    pub(crate) const fn words(self) -> &'static str {
        match self {
            Self::ToolChange => Boundary::ToolChange.words(),
            Self::Return => "at the reference return",
            Self::ProgramEnd => Boundary::ProgramEnd.words(),
        }
    }

    /// The word that does it.
    pub(crate) fn range(self, cx: &PathCx<'_>) -> Range<u32> {
        match self {
            Self::ToolChange => boundary_range(cx, Boundary::ToolChange),
            Self::Return => cx.effect_range(|effect| matches!(effect, Effect::ReturnReference(_))),
            Self::ProgramEnd => boundary_range(cx, Boundary::ProgramEnd),
        }
    }
}

/// Does a cycle that was left on do harm at this block, which does not end it itself?
pub(crate) fn cycle_boundary(cx: &PathCx<'_>) -> Option<CycleBoundary> {
    let moves =
        |effect| Role::of(effect) == Some(Role::Motion) && cx.model.semantics().cycles.motion_ends_cycle;
    if cx.has_effect(moves) {
        return None;
    }
    match boundary(cx) {
        Some(Boundary::ToolChange) => Some(CycleBoundary::ToolChange),
        Some(Boundary::ProgramEnd) => (!cycle_ends_with_program(cx)).then_some(CycleBoundary::ProgramEnd),
        None => cx
            .has_effect(|effect| matches!(effect, Effect::ReturnReference(_)))
            .then_some(CycleBoundary::Return),
    }
}

/// Does the end of the program end cycles, by a code of theirs or of motion?
pub(crate) fn cycle_ends_with_program(cx: &PathCx<'_>) -> bool {
    cx.end_resets(Role::Cycle) || cx.model.semantics().cycles.motion_ends_cycle && cx.end_resets(Role::Motion)
}
