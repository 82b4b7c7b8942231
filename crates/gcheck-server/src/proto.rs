//! The types of the protocol, in one place: another library for them is a change of this file.
//!
//! Knows: what `tower-lsp` calls things. Must not know: what is done with them.

pub(crate) use tower_lsp::jsonrpc::{Error, ErrorCode, Id, Request as Message, Response, Result};
pub(crate) use tower_lsp::ls_types::notification::{
    LogMessage, Notification, Progress, PublishDiagnostics, ShowMessage,
};
pub(crate) use tower_lsp::ls_types::request::{
    ApplyWorkspaceEdit, CodeLensRefresh, InlayHintRefreshRequest, RegisterCapability, Request,
    SemanticTokensRefresh, ShowDocument, WorkDoneProgressCreate, WorkspaceConfiguration,
    WorkspaceDiagnosticRefresh,
};
pub(crate) use tower_lsp::ls_types::*;
pub(crate) use tower_lsp::{LanguageServer, LspService};

/// The request was refused for a reason that its message gives to people.
pub(crate) const REQUEST_FAILED: i64 = -32803;
/// The server gave the request up, and it may be sent again.
pub(crate) const SERVER_CANCELLED: i64 = -32802;
