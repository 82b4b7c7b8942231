//! What several rules of the path tier remember together, kept and moved on once for all of them.
//!
//! Knows: how a rule names such a memory, and how one is found by its type. Must not know: any rule, what is remembered.

use std::any::TypeId;

use gcheck_engine::Event;

use crate::{Memory, PathCx};

/// What several rules of the path tier remember together.
///
/// The memory sees every event once, after the rules: during a move, a rule asks for what was before that move.
pub trait SharedMemory: Memory {
    /// The axes moved, and every rule has seen it.
    fn moved(&mut self, cx: &PathCx<'_>, event: &Event);

    /// A block with a code, a statement or `F S T H D` of the main file begins, and every rule has seen it.
    fn block(&mut self, cx: &PathCx<'_>) {
        let _ = cx;
    }

    /// The axes moved in a block of another file, which no rule sees.
    fn moved_elsewhere(&mut self, event: &Event) {
        let _ = event;
    }

    /// An event that is not a move, of any file, and every rule has seen what it may see of it.
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event) {
        let _ = (cx, event);
    }
}

/// Makes an empty one.
pub type MakeShared = fn() -> Box<dyn SharedMemory>;

/// The shared memories of an analysis: one of each type.
#[derive(Default)]
pub(crate) struct SharedMemories(Vec<Shared>);

/// One of them.
struct Shared {
    /// Its type, so that looking for another one asks nothing of it.
    type_id: TypeId,
    make: MakeShared,
    memory: Box<dyn SharedMemory>,
}

impl SharedMemories {
    /// Takes one in, unless there is one of its type.
    pub(crate) fn add(&mut self, make: MakeShared) {
        let memory = make();
        let type_id = (*memory).as_any().type_id();
        if self.0.iter().all(|own| own.type_id != type_id) {
            self.0.push(Shared { type_id, make, memory });
        }
    }

    /// Is there none?
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All of them forget.
    pub(crate) fn restart(&mut self) {
        for shared in &mut self.0 {
            shared.memory = (shared.make)();
        }
    }

    /// The one of a type.
    pub(crate) fn get<T: SharedMemory + 'static>(&self) -> Option<&T> {
        let shared = self.0.iter().find(|shared| shared.type_id == TypeId::of::<T>())?;
        (*shared.memory).as_any().downcast_ref()
    }

    /// All of them, always in the same order.
    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut (dyn SharedMemory + 'static)> {
        self.0.iter_mut().map(|shared| &mut *shared.memory)
    }
}
