//! A document as a program that can be executed, for what is made of its moves.
//!
//! Knows: how the document and the programs that it calls come together. Must not know: what is made of them.

use std::borrow::Cow;

use gcheck_engine::{Library, Model, Program, SourceFile};
use gcheck_program::{Dialect, Loaded};

use crate::{Settings, Snapshot};

impl Snapshot {
    /// Hands on the document with the programs that it may call, and its control, ready to be executed.
    pub fn with_program<R>(&self, with: impl FnOnce(&Program<'_>, &Model<'_>) -> R) -> R {
        self.with_program_of(self.text(), with)
    }

    /// As [`Snapshot::with_program`], with another text in the place of the document's.
    pub fn with_program_of<'t, R>(
        &self,
        text: impl Into<Cow<'t, str>>,
        with: impl FnOnce(&Program<'_>, &Model<'_>) -> R,
    ) -> R {
        let settings = self.settings();
        let dialect = Dialect::new(&settings.control);
        let model = Model::new(&settings.control);
        let library = Others(settings);
        let loaded = Loaded::new(text, &dialect, |_, _, _| ());
        with(&Program::new(loaded, &dialect, &library), &model)
    }
}

/// The engine's view of other programs.
struct Others<'s>(&'s Settings);

impl Library for Others<'_> {
    fn by_number(&self, number: u32) -> Option<SourceFile> {
        self.0.programs.source_of_number(number)
    }

    fn by_name(&self, name: &str) -> Option<SourceFile> {
        self.0.programs.source_of_name(name)
    }
}
