//! Changes of part programs that prove what they do: feeds scaled, a path shifted, a cycle written out.
//!
//! Knows: which words of a block are places, heights, feeds; how a change rewrites them in the writer's style; what the
//! acts of a run must be after it. Must not know: files, terminals, editors, words for faults of the engine.
//!
//! A change is planned from a run of the program ([`Witness`]), so that every word is rewritten as it was read. It counts only
//! with its proof: the acts of a run before, changed as the change claims ([`expected`]), are compared with those of a run
//! after it by [`gcheck_toolpath::compare`].

mod change;
mod course;
mod distance;
mod expand;
mod expecting;
mod facts;
mod fold;
mod holding;
mod holes;
mod meaning;
mod modal;
mod number;
mod order;
mod places;
mod plan;
mod rates;
mod refusal;
mod rigid;
mod run;
mod safe_start;
mod scope;
mod section_lines;
mod sheet;
mod tool_sections;
mod units;
mod unknown;
mod unroll;
mod witness;

pub use change::{Amount, Change, Destination};
pub use expand::is_moves_and_dwells;
pub use expecting::{Expected, expected, plainly};
pub use holding::{Holder, hold, is_as_claimed};
pub use plan::{Plan, gaps, plan};
pub use refusal::Refusal;
pub use scope::Scope;
pub use unknown::{ASSUMED_RADIUS, assume_cutters, assume_places};
pub use witness::{Witness, witness};
