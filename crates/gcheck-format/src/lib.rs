//! Formatting and renumbering, as edits of the text.
//!
//! Knows: how a program is written. Must not know: motion, files, terminals.
