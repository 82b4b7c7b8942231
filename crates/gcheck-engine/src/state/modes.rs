//! The codes in effect, by what they switch.
//!
//! Knows: one set of codes for each role. Must not know: what the codes do.

use gcheck_controls::CodeIx;

use super::mode_set::ModeSet;
use crate::model::Role;
use crate::tracked::{Tracked, part};

part! {
    /// What is in effect for each role.
    #[derive(Debug, Clone)]
    pub(crate) struct Modes {
        by_role: [Tracked<ModeSet>; Role::COUNT],
    }
}

impl Modes {
    pub(crate) fn new(modes: &[ModeSet; Role::COUNT]) -> Self {
        Self { by_role: modes.map(Tracked::new) }
    }

    /// The codes that may be in effect.
    #[inline]
    #[expect(clippy::indexing_slicing, reason = "a role's index is below COUNT")]
    pub(crate) fn of(&self, role: Role) -> &ModeSet {
        &self.by_role[role.index()]
    }

    /// These codes are in effect.
    #[expect(clippy::indexing_slicing, reason = "a role's index is below COUNT")]
    pub(crate) fn put(&mut self, role: Role, mode: ModeSet) {
        self.by_role[role.index()].put(mode);
    }

    /// The code is in effect.
    pub(crate) fn set(&mut self, role: Role, code: CodeIx) {
        self.put(role, ModeSet::one(code));
    }

    /// What is in effect may also be one of these.
    pub(crate) fn add(&mut self, role: Role, other: &ModeSet) {
        let joined = self.of(role).join(other);
        self.put(role, joined);
    }

    /// A program was executed that is not here. That it changes units or the control's own frames is rare enough to be a mistake
    /// of its own.
    pub(crate) fn forget(&mut self) {
        for role in Role::ALL {
            let stays = matches!(
                role,
                Role::Units
                    | Role::Diameter
                    | Role::TiltedPlane
                    | Role::PolarInterpolation
                    | Role::DynamicOffset
            );
            if !stays {
                self.put(role, ModeSet::ANY);
            }
        }
    }

    /// What is in effect for all roles, in the order of their indexes.
    pub(crate) fn all(&self) -> [ModeSet; Role::COUNT] {
        std::array::from_fn(|index| {
            // As many roles as sets.
            self.by_role.get(index).map_or(ModeSet::ANY, |mode| **mode)
        })
    }
}
