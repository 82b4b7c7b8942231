//! What is made of moves: the canonical form, move lists as JSON lines, CSV and text, times, statistics,
//! comparison, plots.
//!
//! Knows: the engine's events and what other programs and machinists want to read of them. Must not know: syntax,
//! controls, how events are computed, terminals and files (writers are handed in).
//!
//! Everything here takes [`Step`]s, one per event of a run, in order.

mod bar;
mod canonical;
mod compare;
mod corner_mode;
mod csv;
mod estimate;
mod jsonl;
mod motion;
mod number;
mod placing;
mod plan;
pub mod plot;
mod record;
mod sink;
mod slowest;
mod statistics;
mod step;
mod summary;
mod text;
mod time;
mod trail;
mod values;

pub use bar::BarFigures;
pub use canonical::{Canonical, Ending, Start};
pub use compare::{
    Again, Aspect, By, Change, Corner, Difference, Differences, Marks, Outline, Parting, Place, Rest,
    SectionAt, SectionChange, Sections, Title, Value, compare,
};
pub use corner_mode::{Contour, CornerMode};
pub use csv::{Csv, csv_cell};
pub use estimate::Stretch;
pub use jsonl::JsonLines;
pub use placing::WorkCoordinates;
pub use plan::Plan;
pub use record::Kind;
pub use slowest::{MAX_PLACES, Place as SlowPlace};
pub use statistics::{Assumption, Feeds, MAX_SECTIONS, OffsetUse, Section, Statistics, Times, Unaccounted};
pub use step::{Beside, Spot, Step, View, tip_of_posted};
pub use summary::{Names, clock, counts_in_hours};
pub use text::Text;
pub use time::{Clock, DEFAULT_RAPID, DEFAULT_ROTARY_RAPID, DEFAULT_TOOL_CHANGE, Timing, Untimed};
pub use trail::{Act, Doing, Driven, Feed, Move, Setting, Stand, Trail};
pub use values::{MAX_DISTINCT, Values};
