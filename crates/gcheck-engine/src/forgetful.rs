//! A field that is forgotten where two states become one: the mistake that law 4 must find.
//!
//! Knows: which field is forgotten on this thread, which were asked for. Must not know: what fields there are, what they mean.
//! Compiled with the feature `forgetful` alone, which nothing that is shipped has.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;

/// A field: its structure and its name.
pub type Field = (&'static str, &'static str);

thread_local! {
    static FORGOTTEN: Cell<Option<Field>> = const { Cell::new(None) };
    static ASKED: RefCell<BTreeSet<Field>> = const { RefCell::new(BTreeSet::new()) };
}

/// Does something while a field is forgotten.
pub fn forgetting<T>(field: Field, act: impl FnOnce() -> T) -> T {
    FORGOTTEN.set(Some(field));
    let result = act();
    FORGOTTEN.set(None);
    result
}

/// The fields that were joined or widened on this thread so far.
pub fn asked() -> BTreeSet<Field> {
    ASKED.with_borrow(Clone::clone)
}

/// Is the field forgotten?
pub(crate) fn forgets(owner: &'static str, field: &'static str) -> bool {
    ASKED.with_borrow_mut(|asked| asked.insert((owner, field)));
    FORGOTTEN.get() == Some((owner, field))
}
