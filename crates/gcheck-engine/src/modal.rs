//! Modes: the code in effect of each modal group, or the few that may be.
//!
//! Knows: small sets of codes. Must not know: what the codes do.

use gcheck_controls::CodeIx;

/// The codes of one group that may be in effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ModeSet {
    codes: [CodeIx; Self::MOST],
    len: u8,
}

impl ModeSet {
    /// More alternatives than this are "any".
    const MOST: usize = 4;
    const ANY_LEN: u8 = u8::MAX;

    /// Any code of the group, or none.
    pub const ANY: Self = Self { codes: [CodeIx::NONE; Self::MOST], len: Self::ANY_LEN };

    /// One code; [`CodeIx::NONE`] says that no code of the group is in effect.
    pub const fn one(code: CodeIx) -> Self {
        Self { codes: [code, CodeIx::NONE, CodeIx::NONE, CodeIx::NONE], len: 1 }
    }

    /// The code, if there is only one alternative. `Some(CodeIx::NONE)` says that none is in effect.
    pub const fn only(&self) -> Option<CodeIx> {
        match self.len {
            1 => Some(self.codes[0]),
            _ => None,
        }
    }

    /// May the code be in effect?
    pub fn may_be(&self, code: CodeIx) -> bool {
        self.len == Self::ANY_LEN || self.alternatives().contains(&code)
    }

    /// The alternatives; empty when it may be any.
    pub fn alternatives(&self) -> &[CodeIx] {
        if self.len == Self::ANY_LEN {
            &[]
        } else {
            self.codes.get(..usize::from(self.len)).unwrap_or_default()
        }
    }

    /// Either.
    #[must_use]
    pub fn join(&self, other: &Self) -> Self {
        if self == other {
            return *self;
        }
        if self.len == Self::ANY_LEN || other.len == Self::ANY_LEN {
            return Self::ANY;
        }
        let mut all: Vec<CodeIx> = self.alternatives().iter().chain(other.alternatives()).copied().collect();
        all.sort_unstable();
        all.dedup();
        if all.len() > Self::MOST {
            return Self::ANY;
        }
        let mut joined = Self { codes: [CodeIx::NONE; Self::MOST], len: all.len() as u8 };
        for (slot, code) in joined.codes.iter_mut().zip(all) {
            *slot = code;
        }
        joined
    }

    /// Is every alternative of `inner` one of this?
    pub fn contains(&self, inner: &Self) -> bool {
        self.len == Self::ANY_LEN
            || inner.len != Self::ANY_LEN && inner.alternatives().iter().all(|code| self.may_be(*code))
    }
}
