//! One handler for each message of the protocol; all they do is post it.
//!
//! Knows: which messages there are, what the server offers. Must not know: answers.
//!
//! A handler posts before it awaits anything, so the owner gets messages in the order in which they came.

use std::sync::Arc;
use std::time::Instant;

use serde_json::Value;

use crate::client::Abilities;
use crate::features::{
    COMMANDS, CompletionList, ControlEntry, ExplainParams, OwnParams, action_kinds, controls,
};
use crate::mailbox::{Kind, Mailbox};
use crate::owner::Owner;
use crate::parent::Parent;
#[cfg_attr(
    not(test),
    expect(clippy::wildcard_imports, reason = "nearly every type of the protocol is named here")
)]
use crate::proto::*;

/// The handlers.
#[derive(Debug)]
pub(crate) struct Handlers {
    mailbox: Mailbox<Owner>,
    parent: Arc<Parent>,
}

/// Under which name `textDocument/completion` has its handler: the library's form of the answer has no `itemDefaults`, without
/// which a list is several times as long.
const COMPLETION: &str = "gcheck/completion";

/// The message as the service has a handler for it.
pub(crate) fn as_handled(message: Message) -> Message {
    let (method, keeps_params) = match message.method() {
        "textDocument/completion" => (COMPLETION, true),
        // Some clients always send parameters, an empty object where there are none.
        CONTROLS => (CONTROLS, false),
        _ => return message,
    };
    let (_, id, params) = message.into_parts();
    let mut handled = Message::build(method);
    if let Some(params) = params.filter(|_| keeps_params) {
        handled = handled.params(params);
    }
    match id {
        Some(id) => handled.id(id).finish(),
        None => handled.finish(),
    }
}

/// The one request without parameters.
const CONTROLS: &str = "gcheck/controls";

/// What the server tells of itself.
const NAME: &str = "gcheck";
const VERSION: &str = env!("CARGO_PKG_VERSION");

impl Handlers {
    /// The service with every method.
    pub(crate) fn service(mailbox: Mailbox<Owner>, parent: Arc<Parent>) -> (LspService<Self>, impl Sized) {
        LspService::build(|_| Self { mailbox, parent })
            .custom_method("gcheck/toolpath", Self::toolpath)
            .custom_method("gcheck/stateAt", Self::state_at)
            .custom_method("gcheck/syntaxTree", Self::syntax_tree)
            .custom_method(CONTROLS, Self::controls)
            .custom_method("gcheck/explain", Self::explain)
            .custom_method(COMPLETION, Self::completion_list)
            .finish()
    }

    async fn completion_list(&self, params: CompletionParams) -> Result<CompletionList> {
        self.soon("textDocument/completion", move |owner, stop| owner.completion(&params, stop)).await
    }

    async fn toolpath(&self, params: OwnParams) -> Result<Value> {
        self.mailbox.ask("gcheck/toolpath", move |owner, reply| owner.toolpath(&params, reply)).await
    }

    async fn state_at(&self, params: OwnParams) -> Result<Value> {
        self.patient("gcheck/stateAt", move |owner, stop| owner.state_at(&params, stop)).await
    }

    async fn syntax_tree(&self, params: OwnParams) -> Result<String> {
        self.quick("gcheck/syntaxTree", move |owner, _| owner.syntax_tree(&params)).await
    }

    async fn explain(&self, params: ExplainParams) -> Result<Option<String>> {
        self.quick("gcheck/explain", move |owner, _| owner.explain(&params)).await
    }

    #[expect(clippy::unused_async, reason = "the form of a handler")]
    async fn controls(&self) -> Result<Vec<ControlEntry>> {
        Ok(controls())
    }

    /// Posts a question that the owner answers itself.
    async fn quick<T: Send + 'static>(
        &self,
        name: &'static str,
        work: impl FnOnce(&mut crate::owner::Owner, &dyn Fn() -> bool) -> Result<T> + Send + 'static,
    ) -> Result<T> {
        self.mailbox.ask(name, move |owner, reply| owner.answer(reply, work)).await
    }

    /// As [`Self::quick`], for what has an answer without the state.
    async fn soon<T: Send + 'static>(
        &self,
        name: &'static str,
        work: impl FnOnce(&mut crate::owner::Owner, &dyn Fn() -> bool) -> Result<T> + Send + 'static,
    ) -> Result<T> {
        self.mailbox.ask_as(name, Kind::Urgent, move |owner, reply| owner.answer_soon(reply, work)).await
    }

    /// As [`Self::quick`], for what may need an analysis, which lets what a person waits for go first.
    async fn patient<T: Send + 'static>(
        &self,
        name: &'static str,
        work: impl FnMut(&mut crate::owner::Owner, &dyn Fn() -> bool) -> Result<T> + Send + 'static,
    ) -> Result<T> {
        let asked = Instant::now();
        self.mailbox.ask(name, move |owner, reply| owner.answer_patiently(name, asked, reply, work)).await
    }

    fn change(&self, name: &'static str, work: impl FnOnce(&mut crate::owner::Owner) + Send + 'static) {
        self.mailbox.post(name, Kind::Change, work);
    }
}

impl LanguageServer for Handlers {
    async fn initialize(&self, params: InitializeParams) -> Result<InitializeResult> {
        self.parent.watch(params.process_id);
        let capabilities = capabilities(&Abilities::read(&params));
        self.change("initialize", move |owner| owner.initialize(&params));
        Ok(InitializeResult {
            capabilities,
            server_info: Some(ServerInfo { name: NAME.to_owned(), version: Some(VERSION.to_owned()) }),
            offset_encoding: None,
        })
    }

    async fn initialized(&self, _: InitializedParams) {
        self.change("initialized", crate::owner::Owner::initialized);
    }

    async fn shutdown(&self) -> Result<()> {
        // What was posted before is done first.
        self.quick("shutdown", |_, _| Ok(())).await
    }

    async fn did_open(&self, params: DidOpenTextDocumentParams) {
        self.change("textDocument/didOpen", move |owner| owner.did_open(params));
    }

    async fn did_change(&self, params: DidChangeTextDocumentParams) {
        self.change("textDocument/didChange", move |owner| owner.did_change(params));
    }

    async fn did_save(&self, params: DidSaveTextDocumentParams) {
        self.change("textDocument/didSave", move |owner| owner.did_save(&params));
    }

    async fn did_close(&self, params: DidCloseTextDocumentParams) {
        self.change("textDocument/didClose", move |owner| owner.did_close(params));
    }

    async fn did_change_configuration(&self, params: DidChangeConfigurationParams) {
        self.change("workspace/didChangeConfiguration", move |owner| {
            owner.did_change_configuration(&params.settings);
        });
    }

    async fn did_change_watched_files(&self, params: DidChangeWatchedFilesParams) {
        self.change("workspace/didChangeWatchedFiles", move |owner| owner.did_change_watched_files(&params));
    }

    async fn did_change_workspace_folders(&self, params: DidChangeWorkspaceFoldersParams) {
        self.change("workspace/didChangeWorkspaceFolders", move |owner| {
            owner.did_change_workspace_folders(&params);
        });
    }

    async fn diagnostic(&self, params: DocumentDiagnosticParams) -> Result<DocumentDiagnosticReportResult> {
        self.patient("textDocument/diagnostic", move |owner, stop| owner.pull(&params, stop)).await
    }

    async fn workspace_diagnostic(
        &self,
        params: WorkspaceDiagnosticParams,
    ) -> Result<WorkspaceDiagnosticReportResult> {
        let work = move |owner: &mut crate::owner::Owner, reply| owner.pull_workspace(params, reply);
        self.mailbox.ask("workspace/diagnostic", work).await
    }

    async fn hover(&self, params: HoverParams) -> Result<Option<Hover>> {
        self.soon("textDocument/hover", move |owner, stop| owner.hover(&params, stop)).await
    }

    async fn completion_resolve(&self, item: CompletionItem) -> Result<CompletionItem> {
        self.quick("completionItem/resolve", move |owner, _| Ok(owner.resolve_completion(item))).await
    }

    async fn signature_help(&self, params: SignatureHelpParams) -> Result<Option<SignatureHelp>> {
        self.soon("textDocument/signatureHelp", move |owner, stop| owner.signature_help(&params, stop)).await
    }

    async fn document_highlight(
        &self,
        params: DocumentHighlightParams,
    ) -> Result<Option<Vec<DocumentHighlight>>> {
        self.quick("textDocument/documentHighlight", move |owner, _| owner.highlights(&params)).await
    }

    async fn selection_range(&self, params: SelectionRangeParams) -> Result<Option<Vec<SelectionRange>>> {
        self.quick("textDocument/selectionRange", move |owner, _| owner.selection_ranges(&params)).await
    }

    async fn goto_definition(&self, params: GotoDefinitionParams) -> Result<Option<GotoDefinitionResponse>> {
        self.quick("textDocument/definition", move |owner, _| owner.definition(&params)).await
    }

    async fn references(&self, params: ReferenceParams) -> Result<Option<Vec<Location>>> {
        self.mailbox
            .ask("textDocument/references", move |owner, reply| owner.references(&params, reply))
            .await
    }

    async fn prepare_rename(
        &self,
        params: TextDocumentPositionParams,
    ) -> Result<Option<PrepareRenameResponse>> {
        self.quick("textDocument/prepareRename", move |owner, _| owner.prepare_rename(&params)).await
    }

    async fn rename(&self, params: RenameParams) -> Result<Option<WorkspaceEdit>> {
        self.quick("textDocument/rename", move |owner, _| owner.rename(&params)).await
    }

    async fn document_link(&self, params: DocumentLinkParams) -> Result<Option<Vec<DocumentLink>>> {
        self.quick("textDocument/documentLink", move |owner, _| owner.links(&params)).await
    }

    async fn prepare_call_hierarchy(
        &self,
        params: CallHierarchyPrepareParams,
    ) -> Result<Option<Vec<CallHierarchyItem>>> {
        let work = move |owner: &mut crate::owner::Owner, _: &dyn Fn() -> bool| {
            owner.prepare_call_hierarchy(&params)
        };
        self.quick("textDocument/prepareCallHierarchy", work).await
    }

    async fn incoming_calls(
        &self,
        params: CallHierarchyIncomingCallsParams,
    ) -> Result<Option<Vec<CallHierarchyIncomingCall>>> {
        self.quick("callHierarchy/incomingCalls", move |owner, _| owner.incoming_calls(&params)).await
    }

    async fn outgoing_calls(
        &self,
        params: CallHierarchyOutgoingCallsParams,
    ) -> Result<Option<Vec<CallHierarchyOutgoingCall>>> {
        self.quick("callHierarchy/outgoingCalls", move |owner, _| owner.outgoing_calls(&params)).await
    }

    async fn symbol(&self, params: WorkspaceSymbolParams) -> Result<Option<WorkspaceSymbolResponse>> {
        self.mailbox.ask("workspace/symbol", move |owner, reply| owner.workspace_symbols(params, reply)).await
    }

    async fn document_symbol(&self, params: DocumentSymbolParams) -> Result<Option<DocumentSymbolResponse>> {
        let work = move |owner: &mut crate::owner::Owner, reply| owner.document_symbols(&params, reply);
        self.mailbox.ask("textDocument/documentSymbol", work).await
    }

    async fn folding_range(&self, params: FoldingRangeParams) -> Result<Option<Vec<FoldingRange>>> {
        let work = move |owner: &mut crate::owner::Owner, reply| owner.folding_ranges(&params, reply);
        self.mailbox.ask("textDocument/foldingRange", work).await
    }

    async fn semantic_tokens_full(
        &self,
        params: SemanticTokensParams,
    ) -> Result<Option<SemanticTokensResult>> {
        let work = move |owner: &mut crate::owner::Owner, reply| owner.semantic_tokens_full(&params, reply);
        self.mailbox.ask("textDocument/semanticTokens/full", work).await
    }

    async fn semantic_tokens_range(
        &self,
        params: SemanticTokensRangeParams,
    ) -> Result<Option<SemanticTokensRangeResult>> {
        let work = move |owner: &mut crate::owner::Owner, reply| owner.semantic_tokens_range(&params, reply);
        self.mailbox.ask("textDocument/semanticTokens/range", work).await
    }

    async fn inlay_hint(&self, params: InlayHintParams) -> Result<Option<Vec<InlayHint>>> {
        self.patient("textDocument/inlayHint", move |owner, stop| owner.inlay_hints(&params, stop)).await
    }

    async fn code_lens(&self, params: CodeLensParams) -> Result<Option<Vec<CodeLens>>> {
        self.mailbox.ask("textDocument/codeLens", move |owner, reply| owner.code_lenses(&params, reply)).await
    }

    async fn code_action(&self, params: CodeActionParams) -> Result<Option<CodeActionResponse>> {
        self.patient("textDocument/codeAction", move |owner, stop| owner.code_actions(&params, stop)).await
    }

    async fn code_action_resolve(&self, action: CodeAction) -> Result<CodeAction> {
        let work = move |owner: &mut crate::owner::Owner, reply| owner.resolve_action(action, reply);
        self.mailbox.ask("codeAction/resolve", work).await
    }

    async fn formatting(&self, params: DocumentFormattingParams) -> Result<Option<Vec<TextEdit>>> {
        self.quick("textDocument/formatting", move |owner, _| owner.formatting(&params)).await
    }

    async fn range_formatting(&self, params: DocumentRangeFormattingParams) -> Result<Option<Vec<TextEdit>>> {
        self.quick("textDocument/rangeFormatting", move |owner, _| owner.range_formatting(&params)).await
    }

    async fn on_type_formatting(
        &self,
        params: DocumentOnTypeFormattingParams,
    ) -> Result<Option<Vec<TextEdit>>> {
        self.quick("textDocument/onTypeFormatting", move |owner, _| owner.on_type_formatting(&params)).await
    }

    async fn execute_command(&self, params: ExecuteCommandParams) -> Result<Option<LSPAny>> {
        let work = move |owner: &mut crate::owner::Owner, reply| owner.execute_command(params, reply);
        self.mailbox.ask("workspace/executeCommand", work).await
    }
}

/// What the server can do for a client.
fn capabilities(abilities: &Abilities) -> ServerCapabilities {
    let first_trigger = gcheck_ide::FORMAT_TRIGGERS.first().copied().unwrap_or("\n");
    ServerCapabilities {
        position_encoding: Some(abilities.encoding.kind()),
        text_document_sync: Some(TextDocumentSyncCapability::Options(TextDocumentSyncOptions {
            open_close: Some(true),
            change: Some(TextDocumentSyncKind::INCREMENTAL),
            save: Some(TextDocumentSyncSaveOptions::Supported(true)),
            ..TextDocumentSyncOptions::default()
        })),
        hover_provider: Some(HoverProviderCapability::Simple(true)),
        completion_provider: Some(CompletionOptions {
            trigger_characters: Some(texts(gcheck_ide::COMPLETION_TRIGGERS)),
            resolve_provider: Some(true),
            ..CompletionOptions::default()
        }),
        signature_help_provider: Some(SignatureHelpOptions {
            trigger_characters: Some(texts(gcheck_ide::SIGNATURE_TRIGGERS)),
            ..SignatureHelpOptions::default()
        }),
        definition_provider: Some(OneOf::Left(true)),
        references_provider: Some(OneOf::Left(true)),
        document_highlight_provider: Some(OneOf::Left(true)),
        document_symbol_provider: Some(OneOf::Left(true)),
        workspace_symbol_provider: Some(OneOf::Left(true)),
        code_action_provider: Some(CodeActionProviderCapability::Options(CodeActionOptions {
            code_action_kinds: Some(action_kinds()),
            resolve_provider: Some(true),
            ..CodeActionOptions::default()
        })),
        code_lens_provider: Some(CodeLensOptions { resolve_provider: Some(false) }),
        document_formatting_provider: Some(OneOf::Left(true)),
        document_range_formatting_provider: Some(OneOf::Left(true)),
        document_on_type_formatting_provider: Some(DocumentOnTypeFormattingOptions {
            first_trigger_character: first_trigger.to_owned(),
            more_trigger_character: Some(texts(gcheck_ide::FORMAT_TRIGGERS.get(1..).unwrap_or_default())),
        }),
        rename_provider: Some(OneOf::Right(RenameOptions {
            prepare_provider: Some(true),
            work_done_progress_options: WorkDoneProgressOptions::default(),
        })),
        document_link_provider: Some(DocumentLinkOptions {
            resolve_provider: Some(false),
            work_done_progress_options: WorkDoneProgressOptions::default(),
        }),
        folding_range_provider: Some(FoldingRangeProviderCapability::Simple(true)),
        selection_range_provider: Some(SelectionRangeProviderCapability::Simple(true)),
        call_hierarchy_provider: Some(CallHierarchyServerCapability::Simple(true)),
        semantic_tokens_provider: Some(semantic_tokens().into()),
        inlay_hint_provider: Some(OneOf::Left(true)),
        // A client that does not ask for diagnostics is sent them.
        diagnostic_provider: abilities.pulls.then(|| DiagnosticServerCapabilities::Options(diagnostics())),
        execute_command_provider: Some(ExecuteCommandOptions {
            commands: texts(&COMMANDS),
            ..ExecuteCommandOptions::default()
        }),
        workspace: Some(WorkspaceServerCapabilities {
            workspace_folders: Some(WorkspaceFoldersServerCapabilities {
                supported: Some(true),
                change_notifications: Some(OneOf::Left(true)),
            }),
            file_operations: None,
        }),
        ..ServerCapabilities::default()
    }
}

fn texts(list: &[&str]) -> Vec<String> {
    list.iter().map(ToString::to_string).collect()
}

fn semantic_tokens() -> SemanticTokensOptions {
    let legend = SemanticTokensLegend {
        token_types: gcheck_ide::TOKEN_TYPES.iter().map(|name| SemanticTokenType::new(name)).collect(),
        token_modifiers: gcheck_ide::TOKEN_MODIFIERS
            .iter()
            .map(|name| SemanticTokenModifier::new(name))
            .collect(),
    };
    SemanticTokensOptions {
        legend,
        range: Some(true),
        full: Some(SemanticTokensFullOptions::Bool(true)),
        ..SemanticTokensOptions::default()
    }
}

fn diagnostics() -> DiagnosticOptions {
    DiagnosticOptions {
        identifier: Some(NAME.to_owned()),
        inter_file_dependencies: true,
        workspace_diagnostics: true,
        work_done_progress_options: WorkDoneProgressOptions::default(),
    }
}
