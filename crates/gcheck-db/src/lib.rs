//! The incremental database: what is kept between two edits of a program.
//!
//! Knows: salsa, documents, what an edit makes stale. Must not know: LSP, terminals, files on disk.
