//! A rule that panics takes only its own findings with it.
//!
//! Knows: which rule was called when this thread panicked. Must not know: how rules are called, any rule.
//!
//! Rules see a program together, in one pass; one that panics leaves that pass unfinished. So the pass begins again without it.
//! As long as no rule panics this costs a write or two for each call.

use std::borrow::Cow;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::thread;

use gcheck_diagnostics::RuleMeta;

use crate::Selection;

thread_local! {
    /// The rule that panicked.
    static PANICKED: Cell<Option<&'static RuleMeta>> = const { Cell::new(None) };
}

/// Calls a rule.
pub(crate) fn call<T>(rule: &'static RuleMeta, call: impl FnOnce() -> T) -> T {
    let _blame = Calls::new(|| Some(rule));
    call()
}

/// Calls of many rules one after another. Only a panic makes it known which one was called last.
pub(crate) struct Calls<F: Fn() -> Option<&'static RuleMeta>> {
    called: F,
}

impl<F: Fn() -> Option<&'static RuleMeta>> Calls<F> {
    /// `called` is asked for the rule that was called last, when one of them panics.
    pub(crate) fn new(called: F) -> Self {
        Self { called }
    }
}

impl<F: Fn() -> Option<&'static RuleMeta>> Drop for Calls<F> {
    fn drop(&mut self) {
        if thread::panicking()
            && let Some(called) = (self.called)()
        {
            PANICKED.set(Some(called));
        }
    }
}

/// Does some work with a selection of rules; when a rule panics in it, again without that rule. Gives the rules that panicked.
///
/// A panic outside of a rule goes on: it says nothing about any rule.
pub(crate) fn without_rules_that_panic<T>(
    selection: &Selection,
    mut work: impl FnMut(&Selection) -> T,
) -> (T, Vec<&'static RuleMeta>) {
    let mut selection = Cow::Borrowed(selection);
    let mut failed: Vec<&'static RuleMeta> = Vec::new();
    loop {
        PANICKED.set(None);
        // Work that is begun again makes all that it uses again.
        match catch_unwind(AssertUnwindSafe(|| work(&selection))) {
            Ok(done) => return (done, failed),
            Err(panic) => match PANICKED.take() {
                Some(rule) if selection.contains(rule.id) => {
                    failed.push(rule);
                    selection.to_mut().leave_out(rule.id);
                }
                _ => resume_unwind(panic),
            },
        }
    }
}
