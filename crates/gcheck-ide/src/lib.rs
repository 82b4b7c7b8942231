//! Editor features as plain data in byte offsets, one file a feature.
//!
//! Knows: what an editor shows. Must not know: LSP types, salsa, files on disk.
//!
//! Places are bytes of a file (`u32`), so that line counting and position encodings are the protocol's business alone.
//!
//! * What needs the text only takes a [`Snapshot`](gcheck_db::Snapshot), and may run on another thread.
//! * What needs the state at a place takes the [`Database`](gcheck_db::Database), a document, and `stop`, which is asked now
//!   and then and ends the work with [`Cancelled`](gcheck_db::Cancelled) when it says yes.
//! * What looks beyond its file takes a [`Workspace`]; its results say which file they lie in.
//!
//! No feature fails: an offset beyond the text, inside a character or in a broken program has no answer, or a poorer one.

mod arguments;
mod assumed;
mod call_hierarchy;
mod caller;
mod code_actions;
mod code_lens;
mod completion;
mod configured;
mod definition;
mod describe;
mod diagnostics;
mod document_links;
mod document_symbols;
mod explain;
#[cfg(test)]
mod fixture;
mod folding;
mod foreign;
mod formatting;
mod highlight;
mod hover;
mod inlay_hints;
mod keywords;
mod lexemes;
mod number_text;
mod references;
mod remarks;
mod rename;
mod running;
mod sections;
mod selection;
mod semantic_tokens;
mod signature_help;
mod state_at;
mod state_reader;
mod symbols;
mod syntax_tree;
mod tool_words;
mod toolpath;
mod typing;
mod workspace;
mod workspace_symbols;

pub use call_hierarchy::{CallItem, Incoming, Outgoing, call_items, incoming_calls, outgoing_calls};
pub use caller::{Caller, caller};
pub use code_actions::{
    ActionKind, CodeAction, Offer, PROVED, PathChange, Proved, ProvedChange, WITH_FIGURES, code_actions,
    proved, proved_change_at, proved_changes, whole_lines,
};
pub use code_lens::{CodeLens, LENSES, RunStatistics, SectionStatistics, code_lenses, run_statistics};
pub use completion::{
    Completion, CompletionKind, TRIGGERS as COMPLETION_TRIGGERS, completion, completion_details,
};
pub use configured::{Configured, configured_at};
pub use definition::{Target, definition};
pub use diagnostics::{
    Diagnostic, Diagnostics, MAX_DIAGNOSTICS, Omitted, Related, Repeats, ShownRepeats, diagnostics,
    unreachable_ranges,
};
pub use document_links::{DocumentLink, document_links};
pub use document_symbols::{Symbol, SymbolKind, document_symbols};
pub use explain::explain;
pub use folding::{Fold, FoldKind, folding_ranges};
pub use formatting::{FORMAT_TRIGGERS, format, format_in, format_on_type, format_on_type_in};
pub use gcheck_diagnostics::Edit;
pub use gcheck_format::Style;
pub use highlight::{Highlight, highlights};
pub use hover::{Hover, hover};
pub use inlay_hints::{InlayHint, InlayKind, InlayOptions, inlay_hints};
pub use references::{Reference, references};
pub use rename::{RenameRefused, RenameTarget, prepare_rename, rename};
pub use selection::selection_ranges;
pub use semantic_tokens::{SemanticToken, TOKEN_MODIFIERS, TOKEN_TYPES, semantic_tokens};
pub use signature_help::{Parameter, Signature, TRIGGERS as SIGNATURE_TRIGGERS, signature_help};
pub use state_at::{AxisPlaces, CallView, ModeView, StateSide, StateView, ToolView, VariableView, state_at};
pub use symbols::ReferenceKind;
pub use syntax_tree::syntax_tree;
pub use toolpath::{MAX_SEGMENTS, PassedAlarm, Toolpath, toolpath};
pub use workspace::{FileEdits, Place, Workspace, WorkspaceFile};
pub use workspace_symbols::{MAX_SYMBOLS, WorkspaceSymbol, workspace_symbols};
