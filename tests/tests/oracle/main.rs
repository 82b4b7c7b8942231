//! The oracle suite: what we execute is what the installed LinuxCNC interpreter (`rs274`) executes.
//!
//! Knows: both command lines and the form they share. Must not know: how either of them executes anything.
//!
//! Both print the canonical machining functions of a program, one a line; [`canonical`](gcheck_tests::canonical) says when two outputs are equal:
//! names, order and the `N` column exactly, numbers to 1e-4, comments and messages left out, and both end or both refuse.
//! The installed interpreter decides, but for what is listed as deliberate:
//!
//! * [`own`]: our own programs under `fixtures/oracle`, one feature each, by area; `refused` holds programs with one mistake,
//!   which both must refuse; `found` holds what the generator once found, whatever the verdict. A new file is a new case.
//! * [`deliberate`]: programs on which we differ on purpose, each with the reason and with what we print.
//! * [`generated`]: random programs from fixed seeds (300 a run, `GCHECK_ORACLE_LONG=N` for N), one in eight with a mistake
//!   made on purpose. A difference is minimised, printed with both outputs, and with `GCHECK_ORACLE_KEEP=1` written to
//!   `fixtures/oracle/found`.
//! * [`edits`]: our own programs after `gcheck edit`, beside what they did before.
//! * [`corpus`]: the LinuxCNC regression cases of the real-program corpus (`GCHECK_CORPUS`), with a committed list of what
//!   agrees, differs or is out of scope (`tests/oracle-corpus.tsv`); `UPDATE_EXPECT=1` rewrites it.
//!
//! Other switches: `GCHECK_ORACLE_ONLY=text` runs the own programs and corpus cases whose name contains the text, and the
//! seed of that number; `GCHECK_ORACLE_PROGRAM=path` runs another build of `gcheck` in place of this one;
//! `GCHECK_ORACLE_REPORT=file` writes every difference at full length; `GCHECK_ORACLE_WHOLE=1` does not minimise.
//! Tests that need `rs274` or the corpus skip without it, saying so, unless `CI` (for `rs274`) or `GCHECK_REQUIRE_TOOLS`
//! (for both) demands it.
//!
//! `rs274` keeps its tool table in a file of the home folder that all its processes share, and rewrites its parameter
//! file: each run has a folder of its own, see [`reference`](gcheck_tests::reference).

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

mod corpus;
mod deliberate;
mod edits;
mod generated;
mod generator;
mod minimise;
mod own;
mod product;
mod random;
mod report;

use gcheck_tests::{canonical, reference, setup};
