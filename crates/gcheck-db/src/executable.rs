//! A document as a program that can be executed, for what is made of its moves.
//!
//! Knows: how the document and the programs that it calls come together. Must not know: what is made of them.

use gcheck_engine::{Model, Program};
use gcheck_program::{Dialect, Loaded};

use crate::Snapshot;
use crate::snapshot::Others;

impl Snapshot {
    /// Hands on the document with the programs that it may call, and its control, ready to be executed.
    pub fn with_program<R>(&self, with: impl FnOnce(&Program<'_>, &Model<'_>) -> R) -> R {
        let settings = self.settings();
        let dialect = Dialect::new(&settings.control);
        let model = Model::new(&settings.control);
        let library = Others(settings);
        let loaded = Loaded::new(self.text(), &dialect, |_, _, _| ());
        with(&Program::new(loaded, &dialect, &library), &model)
    }
}
