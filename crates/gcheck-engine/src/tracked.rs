//! What an execution reads of a state and what it changes, so that a call need not be executed again from a state that looks the
//! same to it.
//!
//! Knows: marks of single values and of numbered ones, how the notes of a call become part of its caller's. Must not know: what
//! values mean, when a call begins.
//!
//! Notes are made by the reads and writes themselves ([`Tracked`] through `Deref`, variables by number). Copying, joining and
//! comparing states makes none. A value that was written as a whole before it is read is no input; one of which a part was
//! written is, as its rest stays.

use std::cell::{Cell, RefCell};
use std::fmt;
use std::ops::{Deref, DerefMut};

use crate::lattice::Lattice;

/// What happened to one value since its call began.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Marks(u8);

impl Marks {
    /// Nothing.
    pub(crate) const NONE: Self = Self(0);
    /// It is an input.
    pub(crate) const INPUT: Self = Self(Self::READ);
    /// The value that it had when the call began was read, or is part of what it has now.
    const READ: u8 = 1;
    /// It was replaced as a whole: what is read from there on is the call's own.
    const OWN: u8 = 2;
    /// It was written.
    const CHANGED: u8 = 4;

    /// Is the value an input?
    pub(crate) const fn is_read(self) -> bool {
        self.0 & Self::READ != 0
    }

    /// Was it written?
    pub(crate) const fn is_changed(self) -> bool {
        self.0 & Self::CHANGED != 0
    }

    const fn has(self, bits: u8) -> bool {
        self.0 & bits != 0
    }

    #[must_use]
    const fn reading(self) -> Self {
        if self.has(Self::OWN) { self } else { Self(self.0 | Self::READ) }
    }

    #[must_use]
    const fn writing_part(self) -> Self {
        Self(self.reading().0 | Self::CHANGED)
    }

    #[must_use]
    const fn replacing(self) -> Self {
        Self(self.0 | Self::OWN | Self::CHANGED)
    }

    #[must_use]
    const fn or_own(self, own: bool) -> Self {
        if own { self.replacing() } else { self }
    }

    /// First this, then the other.
    #[must_use]
    pub(crate) const fn then(self, later: Self) -> Self {
        let read = if self.has(Self::OWN) { 0 } else { later.0 & Self::READ };
        Self(self.0 | read | later.0 & (Self::OWN | Self::CHANGED))
    }

    /// Where two paths meet: a value that only one of them replaced is on the other what it was.
    #[must_use]
    pub(crate) const fn meeting(self, other: Self) -> Self {
        let own = self.0 & other.0 & Self::OWN;
        let one_sided = (self.0 ^ other.0) & Self::OWN != 0;
        let read = (self.0 | other.0) & Self::READ | if one_sided { Self::READ } else { 0 };
        Self(own | read | (self.0 | other.0) & Self::CHANGED)
    }

    /// The other was read on the way, too: a copy that an execution looked at and threw away.
    #[must_use]
    const fn also_read(self, other: Self) -> Self {
        Self(self.0 | other.0 & Self::READ)
    }

    /// How notes of one value become one.
    #[must_use]
    pub(crate) const fn combined(self, other: Self, how: Combine) -> Self {
        match how {
            Combine::AfterThese => other.then(self),
            Combine::WithReadsOfThese => self.also_read(other),
        }
    }

    /// Two ways through one call, each with an exit of its own: an input of either is one of the call.
    #[must_use]
    const fn beside(self, other: Self) -> Self {
        Self((self.0 | other.0) & (Self::READ | Self::CHANGED) | self.0 & other.0 & Self::OWN)
    }
}

/// How the notes that values have go together with others that are given.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Combine {
    /// What values have noted came after these.
    AfterThese,
    /// What was read there was read here, too.
    WithReadsOfThese,
}

/// A value that notes when it is read and written.
#[derive(Clone, Default)]
pub(crate) struct Tracked<T> {
    value: T,
    marks: Cell<Marks>,
}

impl<T> Tracked<T> {
    /// A value of which nothing was noted.
    pub(crate) const fn new(value: T) -> Self {
        Self { value, marks: Cell::new(Marks::NONE) }
    }

    /// Replaces the value: what it was does not matter any more.
    #[inline]
    pub(crate) fn put(&mut self, value: T) {
        self.marks.set(self.marks.get().replacing());
        self.value = value;
    }

    /// The value, without a note.
    pub(crate) const fn look(&self) -> &T {
        &self.value
    }

    /// Another value with the same marks.
    pub(crate) fn map<U>(&self, change: impl FnOnce(&T) -> U) -> Tracked<U> {
        Tracked { value: change(&self.value), marks: self.marks.clone() }
    }

    /// Takes the value out.
    pub(crate) fn take(&mut self) -> T
    where
        T: Default,
    {
        self.marks.set(self.marks.get().writing_part());
        std::mem::take(&mut self.value)
    }
}

impl<T: fmt::Debug> fmt::Debug for Tracked<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value.fmt(f)
    }
}

impl<T> Deref for Tracked<T> {
    type Target = T;

    #[inline]
    fn deref(&self) -> &T {
        let marks = self.marks.get();
        if !marks.has(Marks::READ | Marks::OWN) {
            self.marks.set(marks.reading());
        }
        &self.value
    }
}

impl<T> DerefMut for Tracked<T> {
    #[inline]
    fn deref_mut(&mut self) -> &mut T {
        self.marks.set(self.marks.get().writing_part());
        &mut self.value
    }
}

impl<T: Lattice> Lattice for Tracked<T> {
    fn join(&self, other: &Self) -> Self {
        Self {
            value: self.value.join(&other.value),
            marks: Cell::new(self.marks.get().meeting(other.marks.get())),
        }
    }

    fn widen(&self, newer: &Self) -> Self {
        Self {
            value: self.value.widen(&newer.value),
            marks: Cell::new(self.marks.get().meeting(newer.marks.get())),
        }
    }

    fn covers(&self, inner: &Self) -> bool {
        self.value.covers(&inner.value)
    }

    fn same(&self, other: &Self) -> bool {
        self.value.same(&other.value)
    }
}

/// Marks of numbered things, of which few are touched: of 64 in a row at a time. Made only while a call is noted.
#[derive(Debug, Clone, Default)]
pub(crate) struct NumberMarks {
    /// Somebody wants them.
    noting: Cell<bool>,
    rows: RefCell<Vec<Row>>,
    /// Every number was replaced.
    all_own: Cell<bool>,
}

/// Marks of a few slots in a row, kept beside the values, which states may then share. From the 64th on they count as one that
/// is always an input.
#[derive(Debug, Clone, Default)]
pub(crate) struct SlotMarks(Cell<Row>);

/// Marks of 64 numbers in a row, a bit each.
#[derive(Debug, Clone, Copy, Default)]
struct Row {
    index: u32,
    read: u64,
    own: u64,
    changed: u64,
}

impl Row {
    const fn empty(index: u32) -> Self {
        Self { index, read: 0, own: 0, changed: 0 }
    }

    const fn marks(&self, bit: u64) -> Marks {
        let read = if self.read & bit != 0 { Marks::READ } else { 0 };
        let own = if self.own & bit != 0 { Marks::OWN } else { 0 };
        let changed = if self.changed & bit != 0 { Marks::CHANGED } else { 0 };
        Marks(read | own | changed)
    }

    /// Each number's marks and the other's, made into one.
    fn with(&self, other: &Self, make: impl Fn(Marks, Marks) -> Marks) -> Self {
        let mut row = Self::empty(self.index);
        let mut rest = self.read | self.own | self.changed | other.read | other.own | other.changed;
        while rest != 0 {
            let bit = rest & rest.wrapping_neg();
            rest ^= bit;
            let marks = make(self.marks(bit), other.marks(bit));
            row.read |= if marks.has(Marks::READ) { bit } else { 0 };
            row.own |= if marks.has(Marks::OWN) { bit } else { 0 };
            row.changed |= if marks.has(Marks::CHANGED) { bit } else { 0 };
        }
        row
    }
}

impl NumberMarks {
    fn note(&self, number: u32, note: impl FnOnce(&mut Row, u64)) {
        if !self.noting.get() {
            return;
        }
        let (index, bit) = (number / 64, 1 << (number % 64));
        let mut rows = self.rows.borrow_mut();
        let at = rows.partition_point(|row| row.index < index);
        if rows.get(at).is_none_or(|row| row.index != index) {
            rows.insert(at, Row::empty(index));
        }
        if let Some(row) = rows.get_mut(at) {
            note(row, bit);
        }
    }

    /// The number's value was looked at.
    #[inline]
    pub(crate) fn read(&self, number: u32) {
        if !self.all_own.get() {
            self.note(number, |row, bit| row.read |= bit & !row.own);
        }
    }

    /// The number's value was replaced.
    pub(crate) fn replaced(&self, number: u32) {
        self.note(number, |row, bit| {
            row.own |= bit;
            row.changed |= bit;
        });
    }

    /// Every number's value was replaced.
    pub(crate) fn all_replaced(&self) {
        self.all_own.set(self.noting.get());
    }

    /// Was every number's value replaced?
    pub(crate) fn are_all_replaced(&self) -> bool {
        self.all_own.get()
    }

    /// The numbers with their marks, ascending.
    pub(crate) fn each(&self) -> Vec<(u32, Marks)> {
        let rows = self.rows.borrow();
        let numbers = rows
            .iter()
            .flat_map(|row| (0..64_u32).map(move |bit| (row.index * 64 + bit, row.marks(1 << bit))));
        numbers.filter(|(_, marks)| *marks != Marks::NONE).collect()
    }

    fn with(&self, other: &Self, all_own: bool, make: impl Fn(Marks, Marks) -> Marks) -> Self {
        let (rows, others) = (self.rows.borrow(), other.rows.borrow());
        let mut all = Vec::with_capacity(rows.len().max(others.len()));
        let (mut left, mut right) = (rows.iter().peekable(), others.iter().peekable());
        while let Some(index) = [left.peek(), right.peek()].into_iter().flatten().map(|row| row.index).min() {
            let a = left.next_if(|row| row.index == index).copied().unwrap_or(Row::empty(index));
            let b = right.next_if(|row| row.index == index).copied().unwrap_or(Row::empty(index));
            all.push(a.with(&b, &make));
        }
        Self { noting: self.noting.clone(), rows: RefCell::new(all), all_own: Cell::new(all_own) }
    }

    /// First this, then the other.
    #[must_use]
    pub(crate) fn then(&self, later: &Self) -> Self {
        let all = self.all_own.get();
        self.with(later, all || later.all_own.get(), |a, b| a.or_own(all).then(b))
    }

    /// Where two paths meet. A number that may have been replaced on one of them by what nobody knows is unknown, whatever it
    /// was.
    #[must_use]
    pub(crate) fn meeting(&self, other: &Self) -> Self {
        let (here, there) = (self.all_own.get(), other.all_own.get());
        self.with(other, here || there, |a, b| a.or_own(here).meeting(b.or_own(there)))
    }

    /// Two ways through one call.
    #[must_use]
    fn beside(&self, other: &Self) -> Self {
        self.with(other, self.all_own.get() && other.all_own.get(), Marks::beside)
    }

    /// Puts these marks together with others.
    pub(crate) fn combine(&self, others: &Self, how: Combine) {
        let combined = match how {
            Combine::AfterThese if others.noting.get() => others.then(self),
            // Nobody wants to know.
            Combine::AfterThese => Self::default(),
            Combine::WithReadsOfThese => self.with(others, self.all_own.get(), Marks::also_read),
        };
        self.replace(combined);
    }

    /// What is noted there happened after what is noted here.
    pub(crate) fn append(&self, later: &Self) {
        if self.noting.get() {
            self.replace(self.then(later));
        }
    }

    /// These marks instead.
    fn replace(&self, marks: Self) {
        self.noting.set(marks.noting.get());
        self.rows.replace(marks.rows.into_inner());
        self.all_own.set(marks.all_own.get());
    }

    /// Begins to note, with nothing noted yet.
    pub(crate) fn begin(&self) {
        self.replace(Self { noting: Cell::new(true), ..Self::default() });
    }
}

impl SlotMarks {
    fn bit(slot: u32) -> u64 {
        1 << slot.min(u64::BITS - 1)
    }

    /// The slot's value was looked at.
    #[inline]
    pub(crate) fn read(&self, slot: u32) {
        let mut row = self.0.get();
        row.read |= Self::bit(slot) & !row.own;
        self.0.set(row);
    }

    /// The slot's value was replaced.
    #[inline]
    pub(crate) fn replaced(&self, slot: u32) {
        let mut row = self.0.get();
        let bit = Self::bit(slot);
        row.changed |= bit;
        if slot + 1 < u64::BITS {
            row.own |= bit;
        } else {
            row.read |= bit;
        }
        self.0.set(row);
    }

    /// Was the slot's value an input, was it replaced?
    pub(crate) fn of(notes: &NumberMarks, slot: u32) -> Marks {
        notes.rows.borrow().first().map_or(Marks::NONE, |row| row.marks(Self::bit(slot)))
    }

    /// The marks of all slots.
    pub(crate) fn all(&self) -> NumberMarks {
        NumberMarks { rows: RefCell::new(vec![self.0.get()]), ..NumberMarks::default() }
    }

    /// Where two paths meet.
    #[must_use]
    pub(crate) fn meeting(&self, other: &Self) -> Self {
        Self(Cell::new(self.0.get().with(&other.0.get(), Marks::meeting)))
    }

    /// Puts these marks together with others.
    pub(crate) fn combine(&self, others: &NumberMarks, how: Combine) {
        if let Some(other) = others.rows.borrow().first() {
            self.0.set(self.0.get().with(other, |own, other| own.combined(other, how)));
        }
    }

    /// What is noted there happened after what is noted here.
    pub(crate) fn append(&self, later: &NumberMarks) {
        if let Some(later) = later.rows.borrow().first() {
            self.0.set(self.0.get().with(later, Marks::then));
        }
    }

    /// No marks.
    pub(crate) fn clear(&self) {
        self.0.set(Row::default());
    }
}

/// What was noted of all values of a state, in the state's own order.
#[derive(Debug, Clone, Default)]
pub(crate) struct Notes {
    pub(crate) marks: Vec<Marks>,
    pub(crate) numbers: Vec<NumberMarks>,
}

impl Notes {
    /// These notes and those of another way through the same call.
    #[must_use]
    #[cfg_attr(
        not(test),
        expect(dead_code, reason = "calls are taken from summaries by the flow of decision 17")
    )]
    pub(crate) fn beside(&self, other: &Self) -> Self {
        Self {
            marks: self.marks.iter().zip(&other.marks).map(|(a, b)| a.beside(*b)).collect(),
            numbers: self.numbers.iter().zip(&other.numbers).map(|(a, b)| a.beside(b)).collect(),
        }
    }

    /// Reads them in the order in which they were made.
    pub(crate) fn cursor(&self) -> Cursor<'_> {
        Cursor { marks: self.marks.iter(), numbers: self.numbers.iter() }
    }
}

/// Notes on their way back to the values that they are of.
#[derive(Debug, Clone)]
pub(crate) struct Cursor<'n> {
    marks: std::slice::Iter<'n, Marks>,
    numbers: std::slice::Iter<'n, NumberMarks>,
}

impl<'n> Cursor<'n> {
    /// The marks of the next value; none when the notes are of another state.
    pub(crate) fn marks(&mut self) -> Marks {
        self.marks.next().copied().unwrap_or_default()
    }

    /// The marks of the next numbered values.
    pub(crate) fn numbers(&mut self) -> Option<&'n NumberMarks> {
        self.numbers.next()
    }
}

/// A part of the state whose reads and writes are noted. Every method goes through its values in the same order.
pub(crate) trait Noted {
    /// Writes the notes down.
    fn note_down(&self, notes: &mut Notes);

    /// Forgets what was noted.
    fn forget_notes(&self);

    /// Puts notes together with others.
    fn combine(&self, others: &mut Cursor<'_>, how: Combine);

    /// Are all inputs the same?
    fn agrees(&self, other: &Self, notes: &mut Cursor<'_>) -> bool;

    /// Takes over the values that were changed, and the notes as what happened last.
    fn adopt(&mut self, changed: &Self, notes: &mut Cursor<'_>);
}

impl<T: Lattice + Clone> Noted for Tracked<T> {
    fn note_down(&self, notes: &mut Notes) {
        notes.marks.push(self.marks.get());
    }

    fn forget_notes(&self) {
        self.marks.set(Marks::NONE);
    }

    fn combine(&self, others: &mut Cursor<'_>, how: Combine) {
        self.marks.set(self.marks.get().combined(others.marks(), how));
    }

    fn agrees(&self, other: &Self, notes: &mut Cursor<'_>) -> bool {
        !notes.marks().is_read() || self.value.same(&other.value)
    }

    fn adopt(&mut self, changed: &Self, notes: &mut Cursor<'_>) {
        let marks = notes.marks();
        if marks.is_changed() {
            self.value.clone_from(&changed.value);
        }
        self.marks.set(self.marks.get().then(marks));
    }
}

impl<T: Noted, const N: usize> Noted for [T; N] {
    fn note_down(&self, notes: &mut Notes) {
        for part in self {
            part.note_down(notes);
        }
    }

    fn forget_notes(&self) {
        self.iter().for_each(Noted::forget_notes);
    }

    fn combine(&self, others: &mut Cursor<'_>, how: Combine) {
        for part in self {
            part.combine(others, how);
        }
    }

    fn agrees(&self, other: &Self, notes: &mut Cursor<'_>) -> bool {
        // All of them, so that the cursor goes past all.
        self.iter().zip(other).fold(true, |agrees, (part, with)| part.agrees(with, notes) && agrees)
    }

    fn adopt(&mut self, changed: &Self, notes: &mut Cursor<'_>) {
        self.iter_mut().zip(changed).for_each(|(part, changed)| part.adopt(changed, notes));
    }
}

/// As [`lattice!`](crate::lattice::lattice), for parts of the state: every field is noted, too.
macro_rules! part {
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident $(<$domain:ident: Domain>)? {
            $( $(#[$field_meta:meta])* $field_vis:vis $field:ident: $kind:ty, )*
        }
    ) => {
        $crate::lattice::lattice! {
            $(#[$meta])*
            $vis struct $name $(<$domain: Domain>)? {
                $( $(#[$field_meta])* $field_vis $field: $kind, )*
            }
        }

        impl $(<$domain: $crate::value::Domain>)? $crate::tracked::Noted for $name $(<$domain>)? {
            fn note_down(&self, notes: &mut $crate::tracked::Notes) {
                $( self.$field.note_down(notes); )*
            }

            fn forget_notes(&self) {
                $( self.$field.forget_notes(); )*
            }

            fn combine(&self, others: &mut $crate::tracked::Cursor<'_>, how: $crate::tracked::Combine) {
                $( self.$field.combine(others, how); )*
            }

            fn agrees(&self, other: &Self, notes: &mut $crate::tracked::Cursor<'_>) -> bool {
                let mut agrees = true;
                $( agrees &= self.$field.agrees(&other.$field, notes); )*
                agrees
            }

            fn adopt(&mut self, changed: &Self, notes: &mut $crate::tracked::Cursor<'_>) {
                $( self.$field.adopt(&changed.$field, notes); )*
            }
        }
    };
}
pub(crate) use part;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_an_input_unless_it_was_replaced_first() {
        let mut value = Tracked::new(1.0);
        assert!(!value.marks.get().is_read() && !value.marks.get().is_changed());
        value.put(2.0);
        assert!((*value).same(&2.0));
        assert!(!value.marks.get().is_read() && value.marks.get().is_changed());
        let mut value = Tracked::new([1.0, 2.0]);
        value[0] = 3.0;
        assert!(
            value.marks.get().is_read() && value.marks.get().is_changed(),
            "its other half is still the old one"
        );
    }

    #[test]
    fn copies_joins_and_comparisons_are_no_reads() {
        let (a, b) = (Tracked::new(1.0), Tracked::new(2.0));
        let joined = a.clone().join(&b);
        assert!(!a.same(&b) && joined.covers(&a) && a.value.same(&1.0));
        assert!([a, b, joined].iter().all(|value| value.marks.get() == Marks::NONE));
    }

    #[test]
    fn what_only_one_path_replaced_is_an_input_where_they_meet() {
        let kept = Tracked::new(1.0);
        let mut replaced = kept.clone();
        replaced.put(2.0);
        let met = kept.join(&replaced);
        assert!(met.marks.get().is_read() && met.marks.get().is_changed());
        let numbers = NumberMarks::default();
        numbers.begin();
        let others = numbers.clone();
        numbers.replaced(100);
        numbers.replaced(101);
        others.replaced(101);
        let met = numbers.meeting(&others).each();
        assert!(matches!(met.as_slice(), [(100, one), (101, both)] if one.is_read() && !both.is_read()));
    }

    #[test]
    fn an_input_of_one_way_through_a_call_is_one_of_the_call() {
        let numbers = NumberMarks::default();
        numbers.begin();
        let others = numbers.clone();
        numbers.read(100);
        others.replaced(100);
        let one = Notes { marks: vec![Marks::INPUT], numbers: vec![numbers] };
        let other = Notes { marks: vec![Marks::NONE.replacing()], numbers: vec![others] };
        let both = one.beside(&other);
        assert!(both.marks.iter().all(|marks| marks.is_read() && marks.is_changed()));
        let numbers = both.numbers.first().map(NumberMarks::each).unwrap_or_default();
        assert!(matches!(numbers.as_slice(), [(100, marks)] if marks.is_read()));
    }

    #[test]
    fn a_read_after_a_write_of_every_number_is_no_input() {
        let numbers = NumberMarks::default();
        numbers.begin();
        numbers.read(1);
        numbers.all_replaced();
        numbers.read(2);
        assert!(matches!(numbers.each().as_slice(), [(1, marks)] if marks.is_read()));
        let later = NumberMarks::default();
        later.begin();
        later.read(500);
        let both = numbers.then(&later);
        assert!(both.each().iter().all(|(number, marks)| *number == 1 || !marks.is_read()));
    }
}
