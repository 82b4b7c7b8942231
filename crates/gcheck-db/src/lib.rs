//! The incremental database: what is kept between two edits of a program.
//!
//! Knows: salsa, documents as chunks, what an edit makes stale, where an analysis can be taken up again. Must not know: LSP,
//! terminals, files on disk.
//!
//! One thread owns the [`Database`], edits documents and asks for their [`Analysis`]. Readers on other threads hold a
//! [`Snapshot`], which stays as it was when it was taken.
//!
//! ```
//! use std::sync::Arc;
//! use gcheck_db::{Database, Settings};
//!
//! let control = gcheck_controls::load("haas-mill").unwrap();
//! let mut database = Database::new();
//! let id = database.open("%\nO1\nG90 G54 G0 X1.\nG1 X2.\nM30\n%\n", Settings::new(control, gcheck_rules::RULES));
//! let analysis = database.analysis(id, &|| false).unwrap();
//! assert!(analysis.findings.iter().any(|finding| finding.rule.id == "feed-missing"));
//! ```

mod chunk_tree;
mod chunks;
mod database;
mod executable;
mod settings;
mod snapshot;
mod states;

pub use chunk_tree::ChunkTree;
pub use database::{Analysis, Cancelled, Database, DocumentId};
pub use settings::{Settings, SharedPrograms};
pub use snapshot::{BlockPlace, ChunkText, Snapshot};
pub use states::StateAt;
