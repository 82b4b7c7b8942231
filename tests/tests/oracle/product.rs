//! The build that is under test.
//!
//! Knows: where it is. Must not know: how it is called, what its output is compared with.

use std::path::Path;

use gcheck_tests::canonical::Outcome;

use crate::setup::Setup;

/// Runs a program in its folder.
pub(crate) fn execute(program: &Path, setup: &Setup) -> Outcome {
    gcheck_tests::product::execute(env!("CARGO_BIN_EXE_gcheck-under-test"), program, setup)
}
