//! The parts of a block, and the order in which a control executes them.
//!
//! Knows: phases of codes and words, and when a block moves. Must not know: what a part does.

use gcheck_controls::{Code, CodeIx, Effect, Letter, LetterSet};

use crate::model::{Model, Rank, Role};

/// A part of a block that acts at its place in the order.
#[derive(Debug, Clone, Copy)]
pub(super) enum Action {
    Code(CodeIx),
    Feed,
    Speed,
    Tool,
    Motion,
}

/// Codes of a block, and `F`, `S`, `T` and the motion.
const MOST_ACTIONS: usize = 28;

/// What a block consists of, as it is found.
#[expect(clippy::struct_excessive_bools, reason = "independent facts of a block")]
pub(super) struct Parts {
    actions: [(Rank, Action); MOST_ACTIONS],
    count: usize,
    /// The block has words or a code that move the axes.
    moves: bool,
    /// Some codes share their axis words with a motion beside them.
    names_motion: bool,
    /// A code takes the axis words.
    taken: bool,
    /// A macro gets the words as arguments.
    macro_call: bool,
}

impl Parts {
    /// Of a block whose words move the axes, or do not; `taken` when an unknown code may be what reads them.
    pub(super) const fn new(moves: bool, taken: bool) -> Self {
        let actions = [(Rank(u8::MAX), Action::Motion); MOST_ACTIONS];
        Self { actions, count: 0, moves, names_motion: false, taken, macro_call: false }
    }

    fn add(&mut self, rank: Rank, action: Action) {
        if let Some(slot) = self.actions.get_mut(self.count) {
            *slot = (rank, action);
            self.count += 1;
        }
    }

    /// A code of a block with these addresses.
    pub(super) fn add_code(&mut self, ix: CodeIx, present: LetterSet, model: &Model<'_>) {
        let Some(code) = model.code(ix) else { return };
        match code.effect {
            Effect::MachineCoordinates => {
                self.moves |= present.intersects(model.axis_letters);
                return;
            }
            Effect::MacroCall | Effect::MacroModal => self.macro_call = true,
            Effect::None if model.control().code_at(ix).is_some_and(Code::is_user) => self.taken = true,
            _ => {}
        }
        self.taken |= code.takes_axes || code.effect.owns_axes();
        let is_motion = matches!(code.role, Some(Role::Motion | Role::Cycle));
        let moves = is_motion && code.effect != Effect::CycleCancel;
        self.moves |= moves;
        self.names_motion |= moves;
        self.add(if is_motion { model.motion_rank } else { code.rank }, Action::Code(ix));
    }

    /// `F`, `S` and `T`, and the motion, after all codes; `shares` when a motion code gets axis words that another takes.
    pub(super) fn add_words(&mut self, present: LetterSet, shares: bool, model: &Model<'_>) {
        if self.macro_call {
            return;
        }
        for (letter, rank, action) in [
            (Letter::of('F'), model.feed_rank, Action::Feed),
            (Letter::of('S'), model.speed_rank, Action::Speed),
            (Letter::of('T'), model.tool_rank, Action::Tool),
        ] {
            if present.contains(letter) {
                self.add(rank, action);
            }
        }
        if self.moves && (!self.taken || self.names_motion && shares) {
            self.add(model.motion_rank, Action::Motion);
        }
    }

    /// The parts in the control's order.
    pub(super) fn in_order(&mut self, model: &Model<'_>) -> impl Iterator<Item = Action> {
        let actions = self.actions.get_mut(..self.count).unwrap_or_default();
        // Stable: codes of one phase act in text order, and a motion code before the motion.
        // The end of a cycle goes before the motion that takes its place.
        let cancels = |action: &Action| matches!(action, Action::Code(ix) if *ix == model.cycle_cancel);
        actions.sort_by_key(|(rank, action)| (*rank, !cancels(action)));
        actions.iter().map(|(_, action)| *action)
    }
}
