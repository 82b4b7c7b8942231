//! What the blocks of a program may do, whatever path is taken.
//!
//! Knows: the codes of the main file. Must not know: any rule, paths.

use gcheck_controls::{Code, Effect};
use gcheck_program::Survey;

use crate::Environment;

/// What the blocks of a program may do, whatever path is taken.
pub struct Uses<'a> {
    /// Control, machine, other programs.
    pub environment: Environment<'a>,
    /// What the main file holds, without regard to paths.
    pub survey: &'a Survey,
    effects: Vec<Effect>,
    /// Blocks of other files, and blocks whose codes are computed, may do anything.
    is_open: bool,
}

impl<'a> Uses<'a> {
    pub(crate) fn new(environment: Environment<'a>, survey: &'a Survey) -> Self {
        let control = environment.control();
        let codes = survey.codes.iter().map(|(number, _)| control.code_at(control.code_ix(*number)));
        let is_opaque = codes.clone().any(|code| code.is_none_or(Code::is_user));
        Self {
            environment,
            survey,
            effects: codes.flatten().map(Code::effect).collect(),
            is_open: is_opaque || survey.has_computed_codes || !survey.calls.is_empty(),
        }
    }

    /// May a block have a code with an effect that `is` accepts?
    pub fn may(&self, is: impl Fn(Effect) -> bool) -> bool {
        self.is_open || self.effects.iter().any(|effect| is(*effect))
    }
}
