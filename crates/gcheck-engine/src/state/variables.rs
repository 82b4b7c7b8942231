//! Variables: locals of a call, common numbers, named parameters.
//!
//! Knows: who sees which variable, and whether it was ever written. Must not know: system variables (the step computes them from
//! the state).

use std::hash::Hash;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use crate::eval::value::{Domain, Truth};
use crate::lattice::{Lattice, May, merged};

/// A named parameter, as a small number given by the loaded program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NameId(pub(crate) u32);

/// A variable.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Variable<V> {
    pub(crate) value: V,
    /// It was written.
    pub(crate) written: Truth,
}

impl<V> Variable<V> {
    fn written(value: V) -> Self {
        Self { value, written: Truth::True }
    }
}

/// Named parameters; those that are not there were never written, which is not the same as any value.
#[derive(Debug, Clone)]
pub(crate) struct Named<D: Domain> {
    values: Rc<FxHashMap<NameId, Variable<D::Value>>>,
    /// Any other may have been written.
    unsure: May,
}

/// Local variables of one call.
#[derive(Debug, Clone)]
pub(crate) struct Locals<D: Domain> {
    numbered: Rc<Vec<D::Value>>,
    named: Named<D>,
}

/// Common and global variables.
///
/// Numbers that were never written hold `unwritten`.
#[derive(Debug, Clone)]
pub struct Variables<D: Domain> {
    common: Rc<FxHashMap<u32, Variable<D::Value>>>,
    named: Named<D>,
    unwritten: D::Value,
    /// A variable of unknown number was written: every one may have been.
    unsure: May,
}

impl<D: Domain> Named<D> {
    fn new() -> Self {
        Self { values: Rc::default(), unsure: May(false) }
    }

    fn get(&self, name: NameId) -> Option<Variable<D::Value>> {
        let unsure = || Variable { value: D::unknown(), written: Truth::Unknown };
        self.values.get(&name).cloned().or_else(|| self.unsure.0.then(unsure))
    }

    fn set(&mut self, name: NameId, value: D::Value) {
        Rc::make_mut(&mut self.values).insert(name, Variable::written(value));
    }

    /// Any may have been written.
    fn forget(&mut self) {
        self.unsure = May(true);
        self.values = Rc::default();
    }

    /// A parameter that only one of two paths has written holds what it holds there, if it is there.
    fn either(&self, other: &Self, widen: bool) -> Self {
        let Self { values, unsure } = self;
        let join = |name: &NameId| {
            let (value, written) = match (self.get(*name), other.get(*name)) {
                (Some(a), Some(b)) => {
                    let value = if widen { a.value.widen(&b.value) } else { a.value.join(&b.value) };
                    (value, a.written.join(&b.written))
                }
                (Some(one), None) | (None, Some(one)) => (one.value, Truth::Unknown),
                (None, None) => (D::unknown(), Truth::Unknown),
            };
            (*name, Variable { value, written })
        };
        let both = if Rc::ptr_eq(values, &other.values) && *unsure == other.unsure {
            Rc::clone(values)
        } else {
            Rc::new(keys(values, &other.values).map(join).collect())
        };
        Self {
            values: merged!(Named.values, self.values, both),
            unsure: merged!(Named.unsure, *unsure, unsure.join(&other.unsure)),
        }
    }

    fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> Named<E> {
        let Self { values, unsure } = self;
        Named { values: Rc::new(map_values(values, change)), unsure: *unsure }
    }
}

impl<D: Domain> Lattice for Named<D> {
    fn join(&self, other: &Self) -> Self {
        self.either(other, false)
    }

    fn widen(&self, newer: &Self) -> Self {
        self.either(newer, true)
    }

    fn covers(&self, inner: &Self) -> bool {
        let covers = |name: &NameId| match (self.get(*name), inner.get(*name)) {
            (Some(outer), Some(inner)) => {
                outer.written.covers(&inner.written) && outer.value.covers(&inner.value)
            }
            (Some(outer), None) => outer.written == Truth::Unknown,
            (None, inner) => inner.is_none(),
        };
        self.unsure.covers(&inner.unsure) && keys(&self.values, &inner.values).all(covers)
    }

    fn same(&self, other: &Self) -> bool {
        self.unsure.same(&other.unsure)
            && (Rc::ptr_eq(&self.values, &other.values) || same_maps(&self.values, &other.values))
    }
}

impl<D: Domain> Locals<D> {
    /// How many there are: a copy shares those that have numbers.
    pub(crate) fn values_held(&self) -> usize {
        self.numbered.len() / 8 + self.named.values.len()
    }

    /// All of `count` locals hold `value`.
    pub(crate) fn new(count: u32, value: &D::Value) -> Self {
        let numbered = Rc::new(vec![value.clone(); count as usize + 1]);
        Self { numbered, named: Named::new() }
    }

    pub(crate) fn get(&self, number: u32) -> Option<&D::Value> {
        self.numbered.get(number as usize)
    }

    pub(crate) fn set(&mut self, number: u32, value: D::Value) {
        if let Some(slot) = Rc::make_mut(&mut self.numbered).get_mut(number as usize) {
            *slot = value;
        }
    }

    pub(crate) fn named(&self, name: NameId) -> Option<Variable<D::Value>> {
        self.named.get(name)
    }

    pub(crate) fn set_named(&mut self, name: NameId, value: D::Value) {
        self.named.set(name, value);
    }

    /// Every local may hold anything.
    pub(crate) fn forget(&mut self) {
        for number in 0..self.numbered.len() as u32 {
            self.set(number, D::unknown());
        }
    }

    /// The same in another domain.
    pub(crate) fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> Locals<E> {
        let Self { numbered, named } = self;
        Locals { numbered: Rc::new(numbered.iter().map(change).collect()), named: named.map(change) }
    }

    /// On one control all calls have as many.
    fn either(&self, other: &Self, widen: bool) -> Self {
        let merge = |(a, b): (&D::Value, &D::Value)| if widen { a.widen(b) } else { a.join(b) };
        let Self { numbered, named } = self;
        let both = if Rc::ptr_eq(numbered, &other.numbered) {
            Rc::clone(numbered)
        } else {
            Rc::new(numbered.iter().zip(&*other.numbered).map(merge).collect())
        };
        let names = if widen { named.widen(&other.named) } else { named.join(&other.named) };
        Self {
            numbered: merged!(Locals.numbered, *numbered, both),
            named: merged!(Locals.named, *named, names),
        }
    }

    fn all_values(&self, other: &Self, holds: impl Fn(&D::Value, &D::Value) -> bool) -> bool {
        Rc::ptr_eq(&self.numbered, &other.numbered)
            || self.numbered.iter().zip(&*other.numbered).all(|(a, b)| holds(a, b))
    }
}

impl<D: Domain> Lattice for Locals<D> {
    fn join(&self, other: &Self) -> Self {
        self.either(other, false)
    }

    fn widen(&self, newer: &Self) -> Self {
        self.either(newer, true)
    }

    fn covers(&self, inner: &Self) -> bool {
        let Self { numbered: _, named } = self;
        self.all_values(inner, D::Value::covers) && named.covers(&inner.named)
    }

    fn same(&self, other: &Self) -> bool {
        let Self { numbered: _, named } = self;
        self.all_values(other, D::Value::same) && named.same(&other.named)
    }
}

impl<D: Domain> PartialEq for Locals<D> {
    fn eq(&self, other: &Self) -> bool {
        self.same(other)
    }
}

impl<D: Domain> Variables<D> {
    /// How many were written.
    pub(crate) fn values_held(&self) -> usize {
        self.common.len() + self.named.values.len()
    }

    /// Variables of which only `known` are known; the others hold `unwritten`.
    pub(crate) fn new(unwritten: D::Value, known: impl Iterator<Item = (u32, f64)>) -> Self {
        let common = known.map(|(number, value)| (number, Variable::written(D::number(value)))).collect();
        Self { common: Rc::new(common), named: Named::new(), unwritten, unsure: May(false) }
    }

    /// The variable holds this though nobody wrote it for that: a guess, or what a condition leaves of it.
    pub(crate) fn narrow(&mut self, number: u32, value: D::Value) {
        let written = self.written(number);
        Rc::make_mut(&mut self.common).insert(number, Variable { value, written });
    }

    /// Is more known of a variable that nobody wrote than of others?
    pub(crate) fn is_narrowed(&self, number: u32) -> bool {
        self.common.contains_key(&number)
    }

    /// A common variable.
    pub fn get(&self, number: u32) -> D::Value {
        self.value_of(number).clone()
    }

    /// Was the variable written, or told, or may it have been?
    pub fn is_written(&self, number: u32) -> bool {
        self.written(number) != Truth::False
    }

    /// Was the variable ever written, or told?
    pub(crate) fn written(&self, number: u32) -> Truth {
        let rest = if self.unsure.0 { Truth::Unknown } else { Truth::False };
        self.common.get(&number).map_or(rest, |variable| variable.written)
    }

    pub(crate) fn set(&mut self, number: u32, value: D::Value) {
        Rc::make_mut(&mut self.common).insert(number, Variable::written(value));
    }

    pub(crate) fn named(&self, name: NameId) -> Option<Variable<D::Value>> {
        self.named.get(name)
    }

    pub(crate) fn set_named(&mut self, name: NameId, value: D::Value) {
        self.named.set(name, value);
    }

    /// A variable of unknown number was written.
    pub(crate) fn forget(&mut self) {
        self.unsure = May(true);
        self.unwritten = D::unknown();
        self.common = Rc::default();
    }

    /// Any variable may have been written, numbered or named.
    pub(crate) fn forget_all(&mut self) {
        self.forget();
        self.named.forget();
    }

    /// The same in another domain.
    pub(crate) fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> Variables<E> {
        let Self { common, named, unwritten, unsure } = self;
        Variables {
            common: Rc::new(map_values(common, change)),
            named: named.map(change),
            unwritten: change(unwritten),
            unsure: *unsure,
        }
    }

    fn value_of(&self, number: u32) -> &D::Value {
        self.common.get(&number).map_or(&self.unwritten, |variable| &variable.value)
    }

    fn either(&self, other: &Self, widen: bool) -> Self {
        let merge = |a: &D::Value, b: &D::Value| if widen { a.widen(b) } else { a.join(b) };
        let Self { common, named, unwritten, unsure } = self;
        let both = if Rc::ptr_eq(common, &other.common) {
            Rc::clone(common)
        } else {
            let joined = keys(common, &other.common).map(|number| {
                let value = merge(self.value_of(*number), other.value_of(*number));
                let written = self.written(*number).join(&other.written(*number));
                (*number, Variable { value, written })
            });
            Rc::new(joined.collect())
        };
        let names = if widen { named.widen(&other.named) } else { named.join(&other.named) };
        Self {
            common: merged!(Variables.common, *common, both),
            named: merged!(Variables.named, *named, names),
            unwritten: merged!(Variables.unwritten, *unwritten, merge(unwritten, &other.unwritten)),
            unsure: merged!(Variables.unsure, *unsure, unsure.join(&other.unsure)),
        }
    }
}

impl<D: Domain> Lattice for Variables<D> {
    fn join(&self, other: &Self) -> Self {
        self.either(other, false)
    }

    fn widen(&self, newer: &Self) -> Self {
        self.either(newer, true)
    }

    fn covers(&self, inner: &Self) -> bool {
        let Self { common, named, unwritten, unsure } = self;
        let covers = |number: &u32| {
            self.value_of(*number).covers(inner.value_of(*number))
                && self.written(*number).covers(&inner.written(*number))
        };
        unsure.covers(&inner.unsure)
            && unwritten.covers(&inner.unwritten)
            && (Rc::ptr_eq(common, &inner.common) || keys(common, &inner.common).all(covers))
            && named.covers(&inner.named)
    }

    fn same(&self, other: &Self) -> bool {
        let Self { common, named, unwritten, unsure } = self;
        unsure.same(&other.unsure)
            && unwritten.same(&other.unwritten)
            && (Rc::ptr_eq(common, &other.common) || same_maps(common, &other.common))
            && named.same(&other.named)
    }
}

impl<D: Domain> PartialEq for Variables<D> {
    fn eq(&self, other: &Self) -> bool {
        self.same(other)
    }
}

/// The keys of two maps, each once.
fn keys<'m, K: Copy + Eq + Hash, V>(
    left: &'m FxHashMap<K, V>,
    right: &'m FxHashMap<K, V>,
) -> impl Iterator<Item = &'m K> {
    left.keys().chain(right.keys().filter(|key| !left.contains_key(key)))
}

fn same_maps<K: Copy + Eq + Hash, V: Lattice>(
    left: &FxHashMap<K, Variable<V>>,
    right: &FxHashMap<K, Variable<V>>,
) -> bool {
    left.len() == right.len()
        && left
            .iter()
            .all(|(key, a)| right.get(key).is_some_and(|b| a.written == b.written && a.value.same(&b.value)))
}

fn map_values<K: Copy + Eq + Hash, V, W>(
    map: &FxHashMap<K, Variable<V>>,
    change: impl Fn(&V) -> W,
) -> FxHashMap<K, Variable<W>> {
    map.iter()
        .map(|(key, Variable { value, written })| {
            (*key, Variable { value: change(value), written: *written })
        })
        .collect()
}
