//! A long list that grows at its end and is copied often.
//!
//! Knows: how copies share what they have in common. Must not know: what is in the list.

use std::rc::Rc;

/// A long list that grows at its end and is copied often: copies share what they have in common.
#[derive(Debug, Clone)]
pub(crate) struct SharedList<T> {
    /// Full but for the last.
    parts: Vec<Rc<Vec<T>>>,
    len: usize,
}

/// Entries that are shared or copied together.
const PART: usize = 256;

impl<T> Default for SharedList<T> {
    fn default() -> Self {
        Self { parts: Vec::new(), len: 0 }
    }
}

impl<T: Clone> SharedList<T> {
    /// Adds an entry at the end.
    pub(crate) fn push(&mut self, entry: T) {
        if self.len.is_multiple_of(PART) {
            self.parts.push(Rc::new(Vec::with_capacity(PART)));
        }
        if let Some(last) = self.parts.last_mut() {
            Rc::make_mut(last).push(entry);
            self.len += 1;
        }
    }

    /// How many entries there are.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// True without entries.
    pub(crate) fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// From the first entry to the last.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &T> {
        self.parts.iter().flat_map(|part| part.iter())
    }
}

impl<T: PartialEq> PartialEq for SharedList<T> {
    fn eq(&self, other: &Self) -> bool {
        let same = |(own, other): (&Rc<Vec<T>>, &Rc<Vec<T>>)| Rc::ptr_eq(own, other) || own == other;
        // The ends are the likeliest to differ.
        self.len == other.len && self.parts.iter().zip(&other.parts).rev().all(same)
    }
}
