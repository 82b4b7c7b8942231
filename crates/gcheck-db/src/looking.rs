//! Blocks looked at in the states that come to them: values of expressions and variables, what a block would do.
//!
//! Knows: which program a state belongs to. Must not know: what is shown.

use std::ops::Range;

use gcheck_engine::{Look, Model, Options, Program, flow};
use gcheck_program::{Dialect, Loaded};

use crate::snapshot::Others;
use crate::states::Keeper;
use crate::{Cancelled, Database, DocumentId, Snapshot, StateAt};

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

impl Database {
    /// Hands each state of [`Database::states`] to `with`, beside what can look into it: names of parameters are known to the
    /// program that was executed alone.
    ///
    /// # Errors
    /// As [`Database::analysis`].
    pub fn look(
        &mut self,
        id: DocumentId,
        blocks: Range<u32>,
        stop: &dyn Fn() -> bool,
        with: &mut dyn FnMut(&StateAt, &mut Look<'_, '_>),
    ) -> Result<(), Cancelled> {
        let snapshot = self.snapshot(id).ok_or(Cancelled)?;
        if stop() {
            return Err(Cancelled);
        }
        snapshot.with_program(|program, model| {
            let settings = snapshot.settings();
            let mut keeper = Keeper::new(blocks);
            let (machine, fuel) = (&settings.machine.engine, settings.execution.fuel);
            flow(program, model, machine, Options::NONE, fuel, &mut keeper);
            let mut look = Look::new(program, model, machine);
            for state in keeper.seen.values() {
                with(state, &mut look);
            }
        });
        Ok(())
    }
}
