//! The example programs of manuals, taken from the manual's own text when the tests run: checked, executed, and compared with
//! what the manual says of them.
//!
//! Knows: one file an author's part of a manual. Must not know: how anything is checked. No program of a manual is written
//! here: places, hashes, verdicts and numbers are.

mod example;
mod haas_a;
mod haas_b;
mod haas_manual;
mod linuxcnc;
