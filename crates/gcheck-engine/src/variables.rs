//! Variables: locals of a call, common numbers, named parameters.
//!
//! Knows: who sees which variable. Must not know: system variables (the step computes them from the state).

use std::rc::Rc;

use rustc_hash::FxHashMap;

use crate::value::Domain;

/// A named parameter, as a small number given by the loaded program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NameId(pub(crate) u32);

/// Local variables of one call.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Locals<D: Domain> {
    numbered: Vec<D::Value>,
    named: FxHashMap<NameId, D::Value>,
}

/// Common and global variables.
///
/// Numbers that were never written hold `unwritten`.
#[derive(Debug, Clone, PartialEq)]
pub struct Variables<D: Domain> {
    common: Rc<FxHashMap<u32, D::Value>>,
    named: Rc<FxHashMap<NameId, D::Value>>,
    unwritten: D::Value,
    /// A variable of unknown number was written: every one may have changed.
    unsure: bool,
}

impl<D: Domain> Locals<D> {
    /// All of `count` locals hold `value`.
    pub(crate) fn new(count: u32, value: &D::Value) -> Self {
        Self { numbered: vec![value.clone(); count as usize + 1], named: FxHashMap::default() }
    }

    pub(crate) fn get(&self, number: u32) -> Option<&D::Value> {
        self.numbered.get(number as usize)
    }

    pub(crate) fn set(&mut self, number: u32, value: D::Value) {
        if let Some(slot) = self.numbered.get_mut(number as usize) {
            *slot = value;
        }
    }

    pub(crate) fn named(&self, name: NameId) -> Option<&D::Value> {
        self.named.get(&name)
    }

    pub(crate) fn set_named(&mut self, name: NameId, value: D::Value) {
        self.named.insert(name, value);
    }

    /// Every local may hold anything.
    pub(crate) fn forget(&mut self) {
        for value in &mut self.numbered {
            *value = D::unknown();
        }
    }

    pub(crate) fn join(&self, other: &Self, widen: bool) -> Self {
        let merge = |a: &D::Value, b: &D::Value| if widen { D::widen(a, b) } else { D::join(a, b) };
        let numbered = self.numbered.iter().zip(&other.numbered).map(|(a, b)| merge(a, b)).collect();
        Self { numbered, named: join_maps(&self.named, &other.named, &D::unknown(), merge) }
    }
}

impl<D: Domain> Variables<D> {
    /// Variables of which only `known` are known; the others hold `unwritten`.
    pub(crate) fn new(unwritten: D::Value, known: impl Iterator<Item = (u32, f64)>) -> Self {
        let common = known.map(|(number, value)| (number, D::number(value))).collect();
        Self { common: Rc::new(common), named: Rc::default(), unwritten, unsure: false }
    }

    /// A common variable.
    pub fn get(&self, number: u32) -> D::Value {
        match self.common.get(&number) {
            Some(value) => value.clone(),
            None if self.unsure => D::unknown(),
            None => self.unwritten.clone(),
        }
    }

    /// Was the variable ever written, or told?
    pub fn is_written(&self, number: u32) -> bool {
        self.unsure || self.common.contains_key(&number)
    }

    pub(crate) fn set(&mut self, number: u32, value: D::Value) {
        Rc::make_mut(&mut self.common).insert(number, value);
    }

    pub(crate) fn named(&self, name: NameId) -> Option<&D::Value> {
        self.named.get(&name)
    }

    pub(crate) fn set_named(&mut self, name: NameId, value: D::Value) {
        Rc::make_mut(&mut self.named).insert(name, value);
    }

    /// A variable of unknown number was written.
    pub(crate) fn forget(&mut self) {
        self.unsure = true;
        Rc::make_mut(&mut self.common).clear();
    }

    pub(crate) fn join(&self, other: &Self, widen: bool) -> Self {
        let merge = |a: &D::Value, b: &D::Value| if widen { D::widen(a, b) } else { D::join(a, b) };
        let unsure = self.unsure || other.unsure;
        let common = if Rc::ptr_eq(&self.common, &other.common) {
            Rc::clone(&self.common)
        } else {
            let rest = if unsure { D::unknown() } else { self.unwritten.clone() };
            Rc::new(join_maps(&self.common, &other.common, &rest, merge))
        };
        let named = if Rc::ptr_eq(&self.named, &other.named) {
            Rc::clone(&self.named)
        } else {
            Rc::new(join_maps(&self.named, &other.named, &D::unknown(), merge))
        };
        Self { common, named, unwritten: self.unwritten.clone(), unsure }
    }

    /// Is every value of `inner` one that this allows?
    pub fn contains(&self, inner: &Self) -> bool {
        let numbers = self.common.keys().chain(inner.common.keys());
        numbers.copied().all(|number| D::contains(&self.get(number), &inner.get(number)))
    }
}

/// Joins two maps whose missing entries hold `rest`.
fn join_maps<K: Copy + Eq + std::hash::Hash, V: Clone>(
    left: &FxHashMap<K, V>,
    right: &FxHashMap<K, V>,
    rest: &V,
    merge: impl Fn(&V, &V) -> V,
) -> FxHashMap<K, V> {
    let keys = left.keys().chain(right.keys().filter(|key| !left.contains_key(key)));
    keys.map(|key| (*key, merge(left.get(key).unwrap_or(rest), right.get(key).unwrap_or(rest)))).collect()
}
