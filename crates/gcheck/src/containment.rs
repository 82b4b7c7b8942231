//! A panic in the work on one file is that file's problem, and no other's.
//!
//! Knows: panics. Must not know: the work.

use std::panic::{self, AssertUnwindSafe};
use std::path::Path;

use crate::Problem;

/// Whatever happens in the work, the program ends in words.
pub(crate) fn guarded<T>(file: &Path, work: impl FnOnce() -> Result<T, Problem>) -> Result<T, Problem> {
    panic::catch_unwind(AssertUnwindSafe(work))
        .unwrap_or_else(|payload| Err(Problem::own_mistake(payload.as_ref()).in_file(file)))
}
