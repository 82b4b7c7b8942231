//! Manuals as specifications: what a page of a manual demands or describes, in our words, with the programs that prove what
//! gcheck makes of it.
//!
//! Knows: the founding systems (`seeds`), the statements of whole manuals (`statements`), kinds of proof. Must not know: how
//! anything is checked or computed; the product runs as its users run it.

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a test that meets the unexpected is to fail"
)]

mod examples;
mod interpreter;
mod product;
mod proof;
mod second_reader;
mod seeds;
mod statements;
