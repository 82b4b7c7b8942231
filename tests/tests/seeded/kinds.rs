//! The kinds of mistakes, by what they are made in.
//!
//! Knows: the chapters. Must not know: what is found.

mod arcs;
mod compensation;
mod cycles;
mod flow;
mod macros;
mod modes;
mod motion;
mod special;
mod tools;
mod turning;
mod writing;

use crate::kind::Kind;

/// Chapters of the page, with their kinds.
pub(crate) const CHAPTERS: &[(&str, &[Kind])] = &[
    ("Writing", writing::KINDS),
    ("Tools and offsets", tools::KINDS),
    ("Modes", modes::KINDS),
    ("Moves, feed and spindle", motion::KINDS),
    ("Arcs", arcs::KINDS),
    ("Canned cycles", cycles::KINDS),
    ("Cutter compensation", compensation::KINDS),
    ("Programs, jumps and calls", flow::KINDS),
    ("Variables and expressions", macros::KINDS),
    ("Turning and bar work", turning::KINDS),
    ("Probing, tilting heads, cylinders", special::KINDS),
];

/// Every kind.
pub(crate) fn all() -> impl Iterator<Item = &'static Kind> {
    CHAPTERS.iter().flat_map(|(_, kinds)| *kinds)
}
