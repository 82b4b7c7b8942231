//! libFuzzer around one target, which an environment variable names.
//!
//! Knows: the variable. Must not know: any target; those are in `gcheck-fuzz`.

#![no_main]

use std::env;
use std::sync::LazyLock;

use gcheck_fuzz::{TARGETS, Target, target};
use libfuzzer_sys::fuzz_target;

/// The target, by its name in `GCHECK_FUZZ_TARGET`.
static CHOSEN: LazyLock<Target> = LazyLock::new(|| {
    let name = env::var("GCHECK_FUZZ_TARGET").unwrap_or_default();
    target(&name).unwrap_or_else(|| {
        let known: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
        panic!("GCHECK_FUZZ_TARGET is `{name}`; known are {}", known.join(", "))
    })
});

fuzz_target!(|bytes: &[u8]| (CHOSEN.run)(bytes));
