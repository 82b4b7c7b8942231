//! Programs under way: the main program, the calls, and the macro that runs after every move.
//!
//! Knows: what a call keeps, who sees which local variables, which modal calls may be on. Must not know: how programs are
//! entered and left, where a call goes on.

use std::rc::Rc;

use super::bar::BarCommand;
use super::saved::SavedModes;
use super::variables::Locals;
use crate::eval::value::{Domain, Truth};
use crate::lattice::{Flat, Lattice, May, Perhaps, discrete, lattice, merged};
use crate::origin::At;

/// How a program was entered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FrameKind {
    /// The main program.
    Main,
    /// `M98`.
    Subprogram,
    /// `M97`.
    Local,
    /// `G65`, an alias, a modal macro call.
    Macro,
    /// `O… CALL`.
    OWord,
}

/// A program being executed: the main program, or a call.
#[derive(Debug, Clone)]
pub struct Frame<D: Domain> {
    /// How it was entered.
    pub kind: FrameKind,
    /// Its first block.
    pub entry: At,
    /// The block that called; the caller goes on after it.
    pub caller: At,
    pub(crate) kept: Kept,
    /// Local variables of its own; without them it sees those of the program that called it.
    pub(crate) locals: Perhaps<Locals<D>>,
}

lattice! {
    /// What a program under way keeps beside its variables.
    #[derive(Debug, Clone)]
    pub(crate) struct Kept {
        /// Further turns to come, when a call repeats.
        pub(crate) repeats: Flat<u32>,
        /// `REPEAT` loops under way.
        pub(crate) counters: Counters,
        /// Modes to restore on return (`M73`), or saved (`M70`).
        pub(crate) saved: Perhaps<Rc<SavedModes>>,
        pub(crate) restore_on_return: Truth,
        /// The branch of an O-word `IF` that is to be decided next, when the one before it failed.
        pub(crate) wanted_branch: Perhaps<At>,
        /// The bar feed that called a cutoff program, and feeds when it comes back.
        pub(crate) bar_feed: Perhaps<Rc<BarCommand>>,
    }
}

discrete!(At);

impl Kept {
    /// What a program keeps when it is entered.
    pub(crate) fn new(repeats: Option<u32>) -> Self {
        Self {
            repeats: repeats.into(),
            counters: Counters::default(),
            saved: Perhaps::No,
            restore_on_return: Truth::False,
            wanted_branch: Perhaps::No,
            bar_feed: Perhaps::No,
        }
    }
}

/// Counters of `REPEAT` loops under way by their block, in the order of blocks. A counter that nobody knows may be none: the
/// loop is over.
#[derive(Debug, Clone, Default)]
pub(crate) struct Counters(Vec<(At, Flat<u32>)>);

impl Counters {
    /// Turns to come; `None` when the loop is not under way.
    pub(crate) fn get(&self, block: At) -> Option<Flat<u32>> {
        let at = self.0.binary_search_by_key(&block, |(at, _)| *at).ok()?;
        self.0.get(at).map(|(_, turns)| *turns)
    }

    pub(crate) fn set(&mut self, block: At, turns: Flat<u32>) {
        match self.0.binary_search_by_key(&block, |(at, _)| *at) {
            Ok(at) => {
                if let Some((_, slot)) = self.0.get_mut(at) {
                    *slot = turns;
                }
            }
            Err(at) => self.0.insert(at, (block, turns)),
        }
    }

    pub(crate) fn remove(&mut self, block: At) {
        self.0.retain(|(at, _)| *at != block);
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Lattice for Counters {
    fn join(&self, other: &Self) -> Self {
        let mut joined = Vec::with_capacity(self.0.len().max(other.0.len()));
        let (mut left, mut right) = (self.0.iter().peekable(), other.0.iter().peekable());
        while let Some(block) =
            [left.peek(), right.peek()].into_iter().flatten().map(|(block, _)| *block).min()
        {
            let own = left.next_if(|(at, _)| *at == block);
            let with = right.next_if(|(at, _)| *at == block);
            joined.push((block, own.zip(with).map_or(Flat::Unknown, |((_, a), (_, b))| a.join(b))));
        }
        Self(joined)
    }

    fn widen(&self, newer: &Self) -> Self {
        self.join(newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        self.0.iter().all(|(block, turns)| match inner.get(*block) {
            Some(inner) => turns.covers(&inner),
            None => *turns == Flat::Unknown,
        }) && inner.0.iter().all(|(block, _)| self.get(*block).is_some())
    }

    fn same(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<D: Domain> Frame<D> {
    /// A program that is entered.
    pub(crate) fn new(kind: FrameKind, entry: At, caller: At, repeats: Option<u32>) -> Self {
        Self { kind, entry, caller, kept: Kept::new(repeats), locals: Perhaps::No }
    }

    /// Further turns to come, when a call repeats; `None` unknown.
    pub fn repeats(&self) -> Option<u32> {
        self.kept.repeats.known()
    }

    /// Is it the cutoff program of a bar feed?
    pub fn is_cutoff(&self) -> bool {
        !self.kept.bar_feed.is_no()
    }

    /// Is the block the branch that a failed condition chose?
    pub(crate) fn wants(&self, at: At) -> bool {
        self.kept.wanted_branch.yes() == Some(&at)
    }

    fn place(&self) -> (FrameKind, At, At) {
        (self.kind, self.entry, self.caller)
    }

    /// Values of both. Of two programs entered otherwise it keeps the place of the lesser one.
    fn either(&self, other: &Self, widen: bool) -> Self {
        let (kind, entry, caller) = self.place().min(other.place());
        let Self { kind: _, entry: _, caller: _, kept, locals } = self;
        let kept =
            merged!(Frame.kept, *kept, if widen { kept.widen(&other.kept) } else { kept.join(&other.kept) });
        let locals = merged!(
            Frame.locals,
            *locals,
            if widen { locals.widen(&other.locals) } else { locals.join(&other.locals) }
        );
        Self { kind, entry, caller, kept, locals }
    }

    fn values_cover(&self, inner: &Self) -> bool {
        self.kept.covers(&inner.kept) && self.locals.covers(&inner.locals)
    }

    fn is_same(&self, other: &Self) -> bool {
        self.place() == other.place() && self.kept.same(&other.kept) && self.locals.same(&other.locals)
    }

    fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> Frame<E> {
        let Self { kind, entry, caller, kept, locals } = self;
        let locals = match locals {
            Perhaps::No => Perhaps::No,
            Perhaps::Yes(locals) => Perhaps::Yes(locals.map(change)),
            Perhaps::Unknown => Perhaps::Unknown,
        };
        Frame { kind: *kind, entry: *entry, caller: *caller, kept: kept.clone(), locals }
    }
}

impl<D: Domain> PartialEq for Frame<D> {
    fn eq(&self, other: &Self) -> bool {
        self.is_same(other)
    }
}

/// What `G66` calls.
#[derive(Debug, Clone)]
pub(crate) struct ModalCall<D: Domain> {
    pub(crate) target: At,
    pub(crate) arguments: Vec<(u32, D::Value)>,
    /// Turns of each call.
    pub(crate) repeats: Flat<u32>,
}

impl<D: Domain> ModalCall<D> {
    /// Is it the same program, called in the same way with the same words?
    fn is_alike(&self, other: &Self) -> bool {
        self.key().eq(other.key())
    }

    fn key(&self) -> impl Iterator<Item = (At, Option<u32>, u32)> + '_ {
        let turns = self.repeats.known();
        let call = (self.target, turns, 0);
        std::iter::once(call)
            .chain(self.arguments.iter().map(move |(number, _)| (self.target, turns, *number)))
    }

    fn either(&self, other: &Self, merge: impl Fn(&D::Value, &D::Value) -> D::Value) -> Self {
        let values = self.arguments.iter().zip(&other.arguments);
        Self {
            target: self.target,
            arguments: merged!(
                ModalCall.arguments,
                self.arguments,
                values.map(|((number, a), (_, b))| (*number, merge(a, b))).collect()
            ),
            repeats: self.repeats,
        }
    }

    fn all_values(&self, other: &Self, holds: impl Fn(&D::Value, &D::Value) -> bool) -> bool {
        self.arguments.iter().zip(&other.arguments).all(|((_, a), (_, b))| holds(a, b))
    }
}

/// The modal macro call (`G66`): off, on, or one of several of which nobody knows which.
#[derive(Debug, Clone)]
pub(crate) struct ModalCalls<D: Domain> {
    /// None may be on.
    off: May,
    /// These may be on, in the order of their keys.
    calls: Vec<Rc<ModalCall<D>>>,
    /// Any may be on: there were more than are kept. Then none is listed.
    other: May,
}

impl<D: Domain> ModalCalls<D> {
    /// So many calls are kept apart.
    const MOST: usize = 4;

    /// None is on.
    pub(crate) fn off() -> Self {
        Self { off: May(true), calls: Vec::new(), other: May(false) }
    }

    /// One is on.
    pub(crate) fn on(call: ModalCall<D>) -> Self {
        Self { off: May(false), calls: vec![Rc::new(call)], other: May(false) }
    }

    /// Any may be on, or none.
    pub(crate) fn unknown() -> Self {
        Self { off: May(true), calls: Vec::new(), other: May(true) }
    }

    /// Is none on, for certain?
    #[inline]
    pub(crate) fn is_off(&self) -> bool {
        self.calls.is_empty() && !self.other.0
    }

    /// May none be on?
    pub(crate) fn may_be_off(&self) -> bool {
        self.off.0
    }

    /// Those that may be on; `None` when it may be any.
    pub(crate) fn calls(&self) -> Option<&[Rc<ModalCall<D>>]> {
        (!self.other.0).then_some(self.calls.as_slice())
    }

    /// As it may be after something that nobody knows: what is on may be off, and what is off is left so.
    pub(crate) fn or_off(&self) -> Self {
        Self { off: May(true), ..self.clone() }
    }

    fn either(&self, other: &Self, merge: impl Fn(&D::Value, &D::Value) -> D::Value) -> Self {
        let mut all = self.calls.clone();
        for call in &other.calls {
            match all.iter_mut().find(|own| own.is_alike(call)) {
                Some(own) => {
                    if !Rc::ptr_eq(own, call) {
                        *own = Rc::new(own.either(call, &merge));
                    }
                }
                None => all.push(Rc::clone(call)),
            }
        }
        all.sort_by(|a, b| a.key().cmp(b.key()));
        let any = self.other.0 || other.other.0 || all.len() > Self::MOST;
        if any {
            all.clear();
        }
        Self {
            off: merged!(ModalCalls.off, self.off, self.off.join(&other.off)),
            calls: merged!(ModalCalls.calls, self.calls, all),
            other: merged!(ModalCalls.other, self.other, May(any)),
        }
    }

    fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> ModalCalls<E> {
        let call = |call: &Rc<ModalCall<D>>| {
            let ModalCall { target, arguments, repeats } = &**call;
            let arguments = arguments.iter().map(|(number, value)| (*number, change(value))).collect();
            Rc::new(ModalCall { target: *target, arguments, repeats: *repeats })
        };
        ModalCalls { off: self.off, calls: self.calls.iter().map(call).collect(), other: self.other }
    }
}

impl<D: Domain> Lattice for ModalCalls<D> {
    fn join(&self, other: &Self) -> Self {
        self.either(other, D::Value::join)
    }

    fn widen(&self, newer: &Self) -> Self {
        self.either(newer, D::Value::widen)
    }

    fn covers(&self, inner: &Self) -> bool {
        let is_covered = |call: &Rc<ModalCall<D>>| {
            self.calls.iter().any(|own| {
                own.is_alike(call) && (Rc::ptr_eq(own, call) || own.all_values(call, D::Value::covers))
            })
        };
        self.off.covers(&inner.off)
            && self.other.covers(&inner.other)
            && (self.other.0 || inner.calls.iter().all(is_covered))
    }

    fn same(&self, other: &Self) -> bool {
        let same = |(a, b): (&Rc<ModalCall<D>>, &Rc<ModalCall<D>>)| {
            Rc::ptr_eq(a, b) || a.is_alike(b) && a.all_values(b, D::Value::same)
        };
        self.off.same(&other.off)
            && self.other.same(&other.other)
            && self.calls.len() == other.calls.len()
            && self.calls.iter().zip(&other.calls).all(same)
    }
}

/// Programs under way, the main program first.
#[derive(Debug, Clone)]
pub(crate) struct Calls<D: Domain> {
    frames: Vec<Frame<D>>,
    /// The programs that called the last one may be others than those that are listed: then it alone is.
    elsewhere: May,
    /// The modal macro call.
    pub(crate) modal: ModalCalls<D>,
}

impl<D: Domain> Calls<D> {
    /// The main program.
    pub(crate) fn main(locals: Locals<D>) -> Self {
        let start = At { file: 0, block: 0 };
        let main =
            Frame { locals: Perhaps::Yes(locals), ..Frame::new(FrameKind::Main, start, start, Some(0)) };
        Self { frames: vec![main], elsewhere: May(false), modal: ModalCalls::off() }
    }

    /// The programs under way, the main program first; the last alone when nobody knows who called it.
    pub(crate) fn frames(&self) -> &[Frame<D>] {
        &self.frames
    }

    /// How many programs are under way.
    pub(crate) fn depth(&self) -> usize {
        self.frames.len()
    }

    /// Is a program under way that was entered so?
    pub(crate) fn has(&self, kind: FrameKind) -> bool {
        self.frames.iter().any(|frame| frame.kind == kind)
    }

    /// Is the main program under way alone?
    pub(crate) fn is_main(&self) -> bool {
        self.frames.len() <= 1 && !self.elsewhere.0
    }

    /// Is it known who called the program under way?
    pub(crate) fn is_known(&self) -> bool {
        !self.elsewhere.0
    }

    /// How many values are held: local variables, counters.
    pub(crate) fn values_held(&self) -> usize {
        let locals = |frame: &Frame<D>| frame.locals.yes().map_or(0, Locals::values_held);
        let frames = self.frames.iter().map(|frame| 8 + locals(frame) + frame.kept.counters.0.len());
        frames.sum()
    }

    /// The program under way.
    pub(crate) fn last(&self) -> Option<&Frame<D>> {
        self.frames.last()
    }

    /// What the program under way keeps.
    pub(crate) fn kept(&self) -> Option<&Kept> {
        self.frames.last().map(|frame| &frame.kept)
    }

    /// What the program under way keeps.
    pub(crate) fn kept_mut(&mut self) -> Option<&mut Kept> {
        self.frames.last_mut().map(|frame| &mut frame.kept)
    }

    /// A program is entered.
    pub(crate) fn push(&mut self, frame: Frame<D>) {
        self.frames.push(frame);
    }

    /// The program under way is left.
    pub(crate) fn pop(&mut self) -> Option<Frame<D>> {
        self.frames.pop()
    }

    /// The local variables that the program under way sees; `None` when nobody knows whose they are.
    pub(crate) fn locals(&self) -> Option<&Locals<D>> {
        match &self.frames.get(self.visible()?)?.locals {
            Perhaps::Yes(locals) => Some(locals),
            Perhaps::No | Perhaps::Unknown => None,
        }
    }

    /// The local variables that the program under way sees; `None` when nobody knows whose they are.
    pub(crate) fn locals_mut(&mut self) -> Option<&mut Locals<D>> {
        let visible = self.visible()?;
        match &mut self.frames.get_mut(visible)?.locals {
            Perhaps::Yes(locals) => Some(locals),
            Perhaps::No | Perhaps::Unknown => None,
        }
    }

    /// Local variables that are the program's own, where it has any.
    pub(crate) fn own_locals(&self) -> Option<&Locals<D>> {
        self.frames.last().and_then(|frame| frame.locals.yes())
    }

    /// Local variables that are the program's own, where it has any.
    pub(crate) fn own_locals_mut(&mut self) -> Option<&mut Locals<D>> {
        self.frames.last_mut().and_then(|frame| frame.locals.yes_mut())
    }

    /// Anything may be in the local variables that the program under way sees.
    pub(crate) fn forget_locals(&mut self) {
        match self.locals_mut() {
            Some(locals) => locals.forget(),
            None => {
                let all = self.frames.iter_mut().filter_map(|frame| frame.locals.yes_mut());
                all.for_each(Locals::forget);
            }
        }
    }

    /// The program whose local variables the last one sees.
    fn visible(&self) -> Option<usize> {
        self.frames.iter().rposition(|frame| !frame.locals.is_no())
    }

    /// The same in another domain.
    pub(crate) fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> Calls<E> {
        let Self { frames, elsewhere, modal } = self;
        Calls {
            frames: frames.iter().map(|frame| frame.map(change)).collect(),
            elsewhere: *elsewhere,
            modal: modal.map(change),
        }
    }

    /// Were the same programs entered in the same way?
    fn are_alike(&self, other: &Self) -> bool {
        !self.elsewhere.0
            && !other.elsewhere.0
            && self.frames.len() == other.frames.len()
            && self.frames.iter().zip(&other.frames).all(|(a, b)| a.place() == b.place())
    }

    fn either(&self, other: &Self, widen: bool) -> Self {
        let alike = self.are_alike(other);
        let all = if alike {
            self.frames.iter().zip(&other.frames).map(|(a, b)| a.either(b, widen)).collect()
        } else {
            let last = self.frames.last().zip(other.frames.last());
            last.map(|(a, b)| a.either(b, widen)).into_iter().collect()
        };
        let (modal, with) = (&self.modal, &other.modal);
        Self {
            frames: merged!(Calls.frames, self.frames, all),
            elsewhere: merged!(Calls.elsewhere, self.elsewhere, May(!alike)),
            modal: merged!(Calls.modal, *modal, if widen { modal.widen(with) } else { modal.join(with) }),
        }
    }
}

impl<D: Domain> Lattice for Calls<D> {
    fn join(&self, other: &Self) -> Self {
        self.either(other, false)
    }

    fn widen(&self, newer: &Self) -> Self {
        self.either(newer, true)
    }

    fn covers(&self, inner: &Self) -> bool {
        let frames = if self.elsewhere.0 {
            self.frames.last().zip(inner.frames.last()).is_none_or(|(a, b)| a.values_cover(b))
        } else {
            self.are_alike(inner) && self.frames.iter().zip(&inner.frames).all(|(a, b)| a.values_cover(b))
        };
        frames && self.modal.covers(&inner.modal)
    }

    fn same(&self, other: &Self) -> bool {
        self.elsewhere.same(&other.elsewhere)
            && self.frames.len() == other.frames.len()
            && self.frames.iter().zip(&other.frames).all(|(a, b)| a.is_same(b))
            && self.modal.same(&other.modal)
    }

    fn uncovered(&self, inner: &Self) -> String {
        if !self.modal.covers(&inner.modal) {
            return format!(".modal: {:?} / {:?}", self.modal, inner.modal);
        }
        let places = |frame: &Frame<D>| (frame.caller.file, frame.caller.block);
        if self.frames.len() != inner.frames.len() {
            let of = |calls: &Self| calls.frames.iter().map(places).collect::<Vec<_>>();
            return format!(": called from {:?} / {:?}", of(self), of(inner));
        }
        let mut pairs = self.frames.iter().zip(&inner.frames);
        let gap = pairs.find(|(a, b)| !self.elsewhere.0 && a.place() != b.place() || !a.values_cover(b));
        gap.map_or_else(String::new, |(a, b)| {
            format!(
                ".frame: {:?} / {:?}\n{}\n.locals: {:?} / {:?}",
                a.place(),
                b.place(),
                a.kept.uncovered(&b.kept),
                a.locals,
                b.locals
            )
        })
    }
}

impl<D: Domain> PartialEq for Calls<D> {
    fn eq(&self, other: &Self) -> bool {
        self.same(other)
    }
}
