//! What the blocks of a program may do, whatever path is taken.
//!
//! Knows: the codes of the main file. Must not know: any rule, paths.

use gcheck_controls::{Code, Effect, Ends};
use gcheck_program::{FileIndex, OKeyword};

use crate::Environment;

/// What the blocks of a program may do, whatever path is taken.
pub struct Uses<'a> {
    /// Control, machine, other programs.
    pub environment: Environment<'a>,
    /// What the main file holds, without regard to paths.
    pub file_index: &'a FileIndex,
    effects: Vec<Effect>,
    /// Blocks of other files, and blocks whose codes are computed, may do anything.
    is_open: bool,
}

impl<'a> Uses<'a> {
    pub(crate) fn new(environment: Environment<'a>, file_index: &'a FileIndex) -> Self {
        let control = environment.control();
        let codes = file_index.codes.iter().map(|(number, _)| control.code_at(control.code_ix(*number)));
        let is_opaque = codes.clone().any(|code| code.is_none_or(Code::is_user));
        Self {
            environment,
            file_index,
            effects: codes.flatten().map(Code::effect).collect(),
            is_open: is_opaque || file_index.has_computed_codes || !file_index.calls.is_empty(),
        }
    }

    /// The file holds what others call, and no main program: what its caller set is not known.
    pub(crate) fn is_called_only(&self) -> bool {
        let has_end = |ends: Ends| self.file_index.ends.iter().any(|end| end.ends == ends);
        let is_library = self.file_index.o_words.first().is_some_and(|o| o.keyword == OKeyword::Sub);
        // A bar job starts again by the code that returns elsewhere.
        let is_bar_job = self.effects.contains(&Effect::BarFeed);
        !is_bar_job && !has_end(Ends::Program) && (has_end(Ends::Subprogram) || is_library)
    }

    /// May a block have a code with an effect that `is` accepts?
    pub fn may(&self, is: impl Fn(Effect) -> bool) -> bool {
        self.is_open || self.effects.iter().any(|effect| is(*effect))
    }
}
