//! Formatting and renumbering of part programs, as edits of their text.
//!
//! Knows: how a program is written, which words name blocks by their numbers. Must not know: values, motion, files,
//! terminals, where a style was configured.
//!
//! What a control reads stays what it is: blanks, the case of letters, zeros that count nothing and sequence numbers change,
//! and of sequence numbers everything that names them with them. Left byte for byte are comments, texts that a program
//! prints, names, line ends, blocks with mistakes in form, and what is outside the part of the file that the control
//! reads.
//!
//! ```
//! use gcheck_diagnostics::apply;
//! use gcheck_format::{Numbering, Style, format, renumber};
//! use gcheck_program::Dialect;
//!
//! let control = gcheck_controls::load("haas-mill").unwrap();
//! let dialect = Dialect::new(&control);
//! let text = "n5 g1x1.  y2.\nN7 GOTO 5\n";
//!
//! let edits = format(text, &dialect, &Style::of(&control), None);
//! assert_eq!(apply(text, &edits), "N5 G1 X1. Y2.\nN7 GOTO 5\n");
//!
//! let edits = renumber(text, &dialect, &Numbering { start: 10, step: 10 }).unwrap();
//! assert_eq!(apply(text, &edits), "n10 g1x1.  y2.\nN20 GOTO 10\n");
//! ```

mod labels;
mod layout;
mod line;
mod nesting;
mod ready;
mod renumber;
mod same;
mod style;

pub use layout::{format, formatted};
pub use renumber::{Numbering, Refusal, RenumberRefused, renumber};
pub use style::{Indentation, LeadingZeros, LetterCase, SequenceNumbers, Style, TrailingZeros, WordSpacing};
