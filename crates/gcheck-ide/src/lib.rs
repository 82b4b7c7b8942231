//! Editor features as plain data in byte offsets, one file a feature.
//!
//! Knows: what an editor shows. Must not know: LSP types, salsa, files on disk.
