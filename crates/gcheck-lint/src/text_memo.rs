//! What rules work out from the text of the main file alone, kept because loops and holes come by many times.
//!
//! Knows: that a part of an edited program counts as read by every section of the analysis that asks for it. Must not know: any
//! rule, what is worked out.

use std::any::{Any, TypeId};
use std::cell::RefCell;

use gcheck_engine::At;
use gcheck_program::Loaded;
use rustc_hash::FxHashMap;

/// Values that are kept before they are worked out again.
const MOST: usize = 1024;

/// What was worked out, by type, block and number.
#[derive(Default)]
pub(crate) struct TextMemo {
    kept: RefCell<Kept>,
}

#[derive(Default)]
struct Kept {
    /// The section of the analysis that read the text.
    section: u32,
    values: FxHashMap<(TypeId, At, u32), Box<dyn Any>>,
}

impl TextMemo {
    /// The value of that type for a block and a number; worked out from the file where the section asks for the first time.
    pub(crate) fn get<T: Clone + 'static>(
        &self,
        file: &Loaded<'_>,
        (at, number): (At, u32),
        work_out: impl FnOnce() -> T,
    ) -> T {
        let key = (TypeId::of::<T>(), at, number);
        if let Some(value) = self.kept(file, &key) {
            return value;
        }
        let value = work_out();
        self.kept.borrow_mut().values.insert(key, Box::new(value.clone()));
        value
    }

    fn kept<T: Clone + 'static>(&self, file: &Loaded<'_>, key: &(TypeId, At, u32)) -> Option<T> {
        let mut kept = self.kept.borrow_mut();
        if kept.section != file.section() || kept.values.len() >= MOST {
            *kept = Kept { section: file.section(), values: FxHashMap::default() };
        }
        kept.values.get(key)?.downcast_ref::<T>().cloned()
    }
}
