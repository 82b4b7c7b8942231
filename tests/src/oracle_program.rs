//! `gcheck` itself, built with the tests that run it: the binary of another package is not theirs to find.
//!
//! Knows: nothing. Must not know: that it is under test.

use std::process::ExitCode;

fn main() -> ExitCode {
    gcheck::main()
}
