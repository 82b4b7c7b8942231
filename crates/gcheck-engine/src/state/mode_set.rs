//! Modes: the code in effect of each modal group, or the few that may be.
//!
//! Knows: small sets of codes. Must not know: what the codes do.

use gcheck_controls::CodeIx;

use crate::lattice::Lattice;

/// The codes of one group that may be in effect.
///
/// Besides the codes that it names it may hold "whatever a program left that is not here", of which an execution takes for
/// granted that it switched on nothing that moves the axes otherwise than programmed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ModeSet {
    /// In ascending order, without repetition; the rest is [`CodeIx::NONE`].
    codes: [CodeIx; Self::MOST],
    len: u8,
    beside: Beside,
}

/// What a mode may be besides the codes that are named.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Beside {
    /// Nothing else.
    Nothing,
    /// Nothing else, if a program that is not here left it as it was.
    Kept,
    /// What a program left that is not here.
    Left,
    /// Any code.
    Any,
}

impl ModeSet {
    /// More alternatives than this are "any". No modal group whose codes bend or turn the way of the axes has more codes.
    const MOST: usize = 8;

    /// What a program left that is not here: any code of the group, or none.
    pub const ANY: Self = Self { codes: [CodeIx::NONE; Self::MOST], len: 0, beside: Beside::Left };

    /// Any code: nobody knows, or there are more alternatives than are kept.
    pub(crate) const UNKNOWN: Self = Self { beside: Beside::Any, ..Self::ANY };

    /// One code; [`CodeIx::NONE`] says that no code of the group is in effect.
    pub const fn one(code: CodeIx) -> Self {
        let mut codes = [CodeIx::NONE; Self::MOST];
        codes[0] = code;
        Self { codes, len: 1, beside: Beside::Nothing }
    }

    /// The code, if there is only one alternative. `Some(CodeIx::NONE)` says that none is in effect.
    pub const fn only(&self) -> Option<CodeIx> {
        match (self.len, self.beside) {
            (1, Beside::Nothing | Beside::Kept) => Some(self.codes[0]),
            _ => None,
        }
    }

    /// May the code be in effect?
    pub fn may_be(&self, code: CodeIx) -> bool {
        !self.is_named() || self.named().contains(&code)
    }

    /// The alternatives; empty when it may be any.
    pub fn alternatives(&self) -> &[CodeIx] {
        if self.is_named() { self.named() } else { &[] }
    }

    /// Was a program executed that is not here, of which an execution takes for granted that it left the mode as it was?
    pub fn is_taken_for_kept(&self) -> bool {
        self.beside == Beside::Kept
    }

    /// The same, after a program that is not here.
    pub(crate) fn kept(&self) -> Self {
        Self { beside: self.beside.max(Beside::Kept), ..*self }
    }

    /// Is it one of the codes that are named?
    fn is_named(&self) -> bool {
        self.beside <= Beside::Kept
    }

    /// May a code be in effect of which this holds? What a program left that is not here is taken to be none of them.
    pub(crate) fn may(&self, is: impl Fn(CodeIx) -> bool) -> bool {
        self.beside == Beside::Any || self.named().iter().any(|code| is(*code))
    }

    /// The codes that are named, whatever it may be besides.
    fn named(&self) -> &[CodeIx] {
        self.codes.get(..usize::from(self.len)).unwrap_or_default()
    }

    /// Either.
    #[must_use]
    pub fn join(&self, other: &Self) -> Self {
        Lattice::join(self, other)
    }

    /// Is every alternative of `inner` one of this?
    pub fn contains(&self, inner: &Self) -> bool {
        self.covers(inner)
    }
}

impl Lattice for ModeSet {
    fn join(&self, other: &Self) -> Self {
        if self == other {
            return *self;
        }
        let beside = self.beside.max(other.beside);
        if beside == Beside::Any {
            return Self::UNKNOWN;
        }
        let mut joined = Self { beside, ..*self };
        for code in other.named() {
            let Err(at) = joined.named().binary_search(code) else { continue };
            if usize::from(joined.len) == Self::MOST {
                return Self::UNKNOWN;
            }
            joined.len += 1;
            let mut moved = *code;
            for slot in joined.codes.iter_mut().take(usize::from(joined.len)).skip(at) {
                std::mem::swap(slot, &mut moved);
            }
        }
        joined
    }

    fn widen(&self, newer: &Self) -> Self {
        Lattice::join(self, newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        self.beside == Beside::Any
            || self.beside == Beside::Left && inner.beside != Beside::Any
            || inner.is_named()
                && inner.beside <= self.beside
                && inner.named().iter().all(|code| self.named().contains(code))
    }

    fn same(&self, other: &Self) -> bool {
        self == other
    }
}

#[cfg(test)]
mod tests {
    use gcheck_controls::{Effect, load, names};

    use super::*;
    use crate::model::{Model, Role};

    /// Modes that decide whether the axes go where the program says are asked for by name.
    #[test]
    fn the_codes_that_bend_the_way_of_the_axes_are_few_enough_to_be_named() {
        for control in names() {
            let control = load(control).unwrap();
            let model = Model::new(&control);
            for role in [
                Role::Compensation,
                Role::Length,
                Role::TiltedPlane,
                Role::DynamicOffset,
                Role::PolarInterpolation,
                Role::Cylinder,
                Role::Polar,
            ] {
                let codes = control.codes().filter(|code| Role::of(code.effect()) == Some(role)).count();
                // Besides its codes it may be none.
                assert!(codes < ModeSet::MOST, "{}: {role:?} has {codes} codes", control.name());
            }
            assert_eq!(model.role(model.code_with(Effect::Linear)), Some(Role::Motion));
        }
    }
}
