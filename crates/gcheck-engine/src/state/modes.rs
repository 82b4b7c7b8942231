//! The codes in effect, by what they switch.
//!
//! Knows: one set of codes for each role. Must not know: what the codes do.

use gcheck_controls::CodeIx;

use super::mode_set::ModeSet;
use crate::lattice::{Lattice, lattice};
use crate::model::Role;

lattice! {
    /// What is in effect for each role.
    #[derive(Debug, Clone)]
    pub(crate) struct Modes {
        by_role: [ModeSet; Role::COUNT],
    }
}

impl Modes {
    pub(crate) fn new(modes: &[ModeSet; Role::COUNT]) -> Self {
        Self { by_role: *modes }
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
        self.by_role[role.index()] = mode;
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

    /// A program was executed that is not here. Units and the control's own frames are left as they are: a program
    /// that changes them for its caller is rare, and wrong.
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
            let left = if stays { self.of(role).kept() } else { ModeSet::ANY };
            self.put(role, left);
        }
    }

    /// Takes back what [`Self::forget`] took away. The code of motion may be another after any program, and one that is not
    /// here may be called to choose offsets, or to move along a cylinder.
    pub(super) fn keep_what_was_set(&mut self, before: &Self, start: &Self) {
        for role in Role::ALL {
            let mode = before.of(role);
            let is_kept = match role {
                Role::Motion | Role::Polar | Role::Cylinder => false,
                Role::Length | Role::WorkOffset => !mode.same(start.of(role)),
                _ => true,
            };
            if is_kept {
                self.put(role, *mode);
            }
        }
    }

    /// What is in effect for all roles, in the order of their indexes.
    pub(crate) fn all(&self) -> [ModeSet; Role::COUNT] {
        self.by_role
    }
}
