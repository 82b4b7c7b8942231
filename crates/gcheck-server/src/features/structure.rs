//! The document as a whole: symbols, folds, colours, hints beside the text, lenses above it.
//!
//! Knows: their forms in the protocol. Must not know: how they are found.

use std::sync::Arc;

use gcheck_db::Snapshot;
use gcheck_ide::{Caller, FoldKind, InlayKind, RunStatistics, Symbol};

use super::{LARGE, given_up, markdown, within};
use crate::documents::{Figures, StatisticsRun};
use crate::mailbox::{Kind, Reply};
use crate::owner::Owner;
use crate::position::Places;
use crate::proto::{
    CodeLens, CodeLensParams, CodeLensRefresh, Command, DocumentSymbol, DocumentSymbolParams,
    DocumentSymbolResponse, Error, FoldingRange, FoldingRangeKind, FoldingRangeParams, InlayHint,
    InlayHintKind, InlayHintLabel, InlayHintParams, InlayHintTooltip, Location, Range, Result, SemanticToken,
    SemanticTokens, SemanticTokensParams, SemanticTokensRangeParams, SemanticTokensRangeResult,
    SemanticTokensResult, SymbolInformation, SymbolKind, Uri,
};

/// A document of more bytes is coloured by what is in view, not as a whole: the answer would be larger than the text.
const MOST_COLOURED: u32 = 5 << 20;

impl Owner {
    pub(crate) fn document_symbols(
        &mut self,
        params: &DocumentSymbolParams,
        reply: Reply<Option<DocumentSymbolResponse>>,
    ) {
        let uri = params.text_document.uri.clone();
        if self.is_configuration(&uri) {
            return reply.send(Ok(None));
        }
        self.choose_settings(&uri);
        let snapshot = match self.snapshot(&uri) {
            Ok(snapshot) => snapshot,
            Err(error) => return reply.send(Err(error)),
        };
        let (encoding, is_tree) = (self.abilities.encoding, self.abilities.symbol_tree);
        let address = uri.clone();
        self.answer_elsewhere(&uri, snapshot.len() > LARGE, reply, move |_| {
            let found = gcheck_ide::document_symbols(&snapshot);
            let mut places = Places::new(&snapshot, encoding);
            if is_tree {
                let tree = found.into_iter().map(|symbol| tree_symbol(symbol, &mut places)).collect();
                return Ok(Some(DocumentSymbolResponse::Nested(tree)));
            }
            let mut flat = Vec::new();
            flatten(found, None, &address, &mut places, &mut flat);
            Ok(Some(DocumentSymbolResponse::Flat(flat)))
        });
    }

    pub(crate) fn folding_ranges(
        &mut self,
        params: &FoldingRangeParams,
        reply: Reply<Option<Vec<FoldingRange>>>,
    ) {
        let uri = params.text_document.uri.clone();
        if self.is_configuration(&uri) {
            return reply.send(Ok(None));
        }
        self.choose_settings(&uri);
        let snapshot = match self.snapshot(&uri) {
            Ok(snapshot) => snapshot,
            Err(error) => return reply.send(Err(error)),
        };
        let (encoding, lines_only) = (self.abilities.encoding, self.abilities.folds_lines_only);
        self.answer_elsewhere(&uri, snapshot.len() > LARGE, reply, move |_| {
            let mut places = Places::new(&snapshot, encoding);
            let folds = gcheck_ide::folding_ranges(&snapshot).into_iter().map(|fold| {
                let Range { start, end } = places.range(&fold.range);
                FoldingRange {
                    start_line: start.line,
                    start_character: (!lines_only).then_some(start.character),
                    end_line: end.line,
                    end_character: (!lines_only).then_some(end.character),
                    kind: Some(match fold.kind {
                        FoldKind::Comment => FoldingRangeKind::Comment,
                        FoldKind::Region => FoldingRangeKind::Region,
                    }),
                    collapsed_text: None,
                }
            });
            Ok(Some(folds.collect()))
        });
    }

    pub(crate) fn semantic_tokens_full(
        &mut self,
        params: &SemanticTokensParams,
        reply: Reply<Option<SemanticTokensResult>>,
    ) {
        let uri = &params.text_document.uri;
        if self.is_configuration(uri) {
            return reply.send(Ok(None));
        }
        match self.snapshot(uri) {
            Ok(snapshot) if snapshot.len() > MOST_COLOURED => reply.send(Ok(None)),
            _ => self.tokens(uri, None, reply, |tokens| Some(SemanticTokensResult::Tokens(tokens))),
        }
    }

    pub(crate) fn semantic_tokens_range(
        &mut self,
        params: &SemanticTokensRangeParams,
        reply: Reply<Option<SemanticTokensRangeResult>>,
    ) {
        if self.is_configuration(&params.text_document.uri) {
            return reply.send(Ok(None));
        }
        let whole = Some(params.range);
        self.tokens(&params.text_document.uri, whole, reply, |tokens| {
            Some(SemanticTokensRangeResult::Tokens(tokens))
        });
    }

    fn tokens<T: Send + 'static>(
        &mut self,
        uri: &Uri,
        range: Option<Range>,
        reply: Reply<T>,
        form: impl FnOnce(SemanticTokens) -> T + Send + 'static,
    ) {
        self.choose_settings(uri);
        // What is in view is wanted at once; a whole file is read elsewhere.
        if range.is_some() {
            self.look_ahead(uri, &|| reply.is_cancelled());
        }
        let snapshot = if range.is_some() { self.indexed(uri) } else { self.snapshot(uri) };
        let snapshot = match snapshot {
            Ok(snapshot) => snapshot,
            Err(error) => return reply.send(Err(error)),
        };
        let encoding = self.abilities.encoding;
        let bytes = range.map(|range| self.places(&snapshot).bytes(range));
        let size = bytes.as_ref().map_or(snapshot.len(), |bytes| bytes.end - bytes.start);
        let analysis = self.known_analysis(uri);
        let end = bytes.as_ref().map_or(snapshot.len(), |bytes| bytes.end);
        let unreachable =
            analysis.map(|analysis| gcheck_ide::unreachable_ranges(&analysis)).unwrap_or_default();
        self.answer_elsewhere(uri, size > LARGE, reply, move |_| {
            let tokens = gcheck_ide::semantic_tokens(&snapshot, bytes, &unreachable);
            let mut places = Places::new(&snapshot, encoding);
            let mut last = crate::proto::Position::default();
            let mut data = Vec::with_capacity(tokens.len());
            for token in tokens.into_iter().take_while(|token| token.range.start < end) {
                let Range { start, end } = places.range(&token.range);
                // No token goes over the end of a line, as the protocol wants it.
                if start.line != end.line {
                    continue;
                }
                let delta_line = start.line - last.line;
                let before = if delta_line == 0 { last.character } else { 0 };
                data.push(SemanticToken {
                    delta_line,
                    delta_start: start.character - before,
                    length: end.character - start.character,
                    token_type: token.kind,
                    token_modifiers_bitset: token.modifiers,
                });
                last = start;
            }
            Ok(form(SemanticTokens { result_id: None, data }))
        });
    }

    pub(crate) fn inlay_hints(
        &mut self,
        params: &InlayHintParams,
        stop: &dyn Fn() -> bool,
    ) -> Result<Option<Vec<InlayHint>>> {
        let uri = &params.text_document.uri;
        if self.is_configuration(uri) {
            return Ok(None);
        }
        self.choose_settings(uri);
        self.look_ahead(uri, stop);
        let snapshot = self.snapshot(uri)?;
        let range = self.places(&snapshot).bytes(params.range);
        let document = self.document(uri)?;
        let (id, options) = (document.id, self.client_settings(document).hints);
        let range = within(&range, snapshot.len());
        let found = gcheck_ide::inlay_hints(&mut self.database, id, range, options, stop);
        let mut places = self.places(&snapshot);
        let hints = found.map_err(given_up)?.into_iter().map(|hint| InlayHint {
            position: places.position(hint.offset),
            label: InlayHintLabel::String(hint.label),
            kind: match hint.kind {
                InlayKind::Value | InlayKind::Position => Some(InlayHintKind::TYPE),
                InlayKind::Feed | InlayKind::Speed | InlayKind::Tool => Some(InlayHintKind::PARAMETER),
            },
            text_edits: None,
            tooltip: Some(hint.tooltip)
                .filter(|tooltip| !tooltip.is_empty())
                .map(|tooltip| InlayHintTooltip::MarkupContent(markdown(tooltip))),
            padding_left: Some(true),
            padding_right: Some(false),
            data: None,
        });
        Ok(Some(hints.collect()))
    }

    /// Lenses come from a run of the whole program: the ones of the last run are shown until the next is over.
    pub(crate) fn code_lenses(&mut self, params: &CodeLensParams, reply: Reply<Option<Vec<CodeLens>>>) {
        let uri = &params.text_document.uri;
        if self.is_configuration(uri) {
            return reply.send(Ok(None));
        }
        self.choose_settings(uri);
        let snapshot = match self.snapshot(uri) {
            Ok(snapshot) => snapshot,
            Err(error) => return reply.send(Err(error)),
        };
        let Ok(document) = self.document(uri) else { return reply.send(Ok(None)) };
        if !self.client_settings(document).lenses || document.in_force.settings.is_none() {
            return reply.send(Ok(None));
        }
        let encoding = self.abilities.encoding;
        let now = document.clock.now();
        let caller = self.caller(uri);
        let known = self.documents.get(uri).and_then(|document| document.figures.as_ref());
        if let Some(figures) = known {
            let is_old = figures.at != now || figures.caller != caller;
            reply.send(Ok(Some(lenses(&snapshot, &figures.statistics, encoding))));
            // Who cannot be told of newer ones is shown them with the next request.
            if is_old {
                self.run_for_figures(uri, snapshot, caller, None);
            }
            return;
        }
        self.run_for_figures(uri, snapshot, caller, Some(reply));
    }

    fn run_for_figures(
        &mut self,
        uri: &Uri,
        snapshot: Snapshot,
        caller: Option<Caller>,
        reply: Option<Reply<Option<Vec<CodeLens>>>>,
    ) {
        let Some(document) = self.documents.get_mut(uri) else { return };
        if document.run != StatisticsRun::Idle && reply.is_none() {
            document.run = StatisticsRun::AskedAgain;
            return;
        }
        document.run = StatisticsRun::UnderWay;
        let clock = document.clock.clone();
        let (uri, now) = (uri.clone(), clock.now());
        let (mailbox, encoding) = (self.mailbox.clone(), self.abilities.encoding);
        let fuel = snapshot.settings().execution.fuel;
        self.workers.start_work(move || {
            // An edit outdates the run: the program may have been endless, and is no longer.
            let stop = || clock.now() != now || reply.as_ref().is_some_and(Reply::is_cancelled);
            let Ok(figures) = gcheck_ide::run_statistics(&snapshot, caller.as_ref(), fuel, &stop) else {
                if let Some(reply) = reply {
                    reply.send(Err(Error::content_modified()));
                }
                mailbox.post("figures", Kind::Result, move |owner| owner.run_has_ended(&uri));
                return;
            };
            let figures = Arc::new(figures);
            let is_shown = reply.is_some();
            let kept = Figures { at: now, caller, statistics: Arc::clone(&figures) };
            // They are kept before the client hears of them: what it asks next finds them.
            mailbox.post("figures", Kind::Result, move |owner| owner.put_figures(&uri, kept, is_shown));
            if let Some(reply) = reply {
                reply.send(Ok(Some(lenses(&snapshot, &figures, encoding))));
            }
        });
    }

    fn put_figures(&mut self, uri: &Uri, figures: Figures, is_shown: bool) {
        let Some(document) = self.documents.get_mut(uri) else { return };
        let is_news = document.figures.as_ref().is_none_or(|known| known.statistics != figures.statistics);
        document.figures = Some(figures);
        if is_news && !is_shown && self.abilities.refreshes_lenses {
            self.outbox.ask::<CodeLensRefresh>((), |_| ());
        }
        self.run_has_ended(uri);
    }

    /// A client that asked while an outdated run was under way got old figures, and does not ask again by itself.
    fn run_has_ended(&mut self, uri: &Uri) {
        let Some(document) = self.documents.get_mut(uri) else { return };
        let ended = std::mem::replace(&mut document.run, StatisticsRun::Idle);
        let is_old = document.figures.as_ref().is_none_or(|known| known.at != document.clock.now());
        if ended == StatisticsRun::AskedAgain
            && is_old
            && let Ok(snapshot) = self.snapshot(uri)
        {
            let caller = self.caller(uri);
            self.run_for_figures(uri, snapshot, caller, None);
        }
    }
}

fn lenses(
    snapshot: &Snapshot,
    figures: &RunStatistics,
    encoding: crate::position::Encoding,
) -> Vec<CodeLens> {
    let mut places = Places::new(snapshot, encoding);
    let found = gcheck_ide::code_lenses(snapshot, figures).into_iter();
    found
        .map(|lens| CodeLens {
            range: places.range(&within(&lens.range, snapshot.len())),
            // A lens that does nothing when it is clicked has a command without a name.
            command: Some(Command { title: lens.title, command: String::new(), arguments: None }),
            data: None,
        })
        .collect()
}

pub(super) fn symbol_kind(kind: gcheck_ide::SymbolKind) -> SymbolKind {
    match kind {
        gcheck_ide::SymbolKind::Program => SymbolKind::MODULE,
        gcheck_ide::SymbolKind::Subroutine => SymbolKind::FUNCTION,
        gcheck_ide::SymbolKind::Tool => SymbolKind::CLASS,
        gcheck_ide::SymbolKind::Operation => SymbolKind::NAMESPACE,
        gcheck_ide::SymbolKind::Label => SymbolKind::KEY,
    }
}

/// A name that the protocol takes: not empty.
fn shown_name(name: String) -> String {
    if name.trim().is_empty() { "(unnamed)".to_owned() } else { name }
}

fn tree_symbol(symbol: Symbol, places: &mut Places<'_>) -> DocumentSymbol {
    let children: Vec<DocumentSymbol> =
        symbol.children.into_iter().map(|child| tree_symbol(child, places)).collect();
    #[expect(deprecated, reason = "the type has a field that the protocol gave up")]
    DocumentSymbol {
        name: shown_name(symbol.name),
        detail: Some(symbol.detail).filter(|detail| !detail.is_empty()),
        kind: symbol_kind(symbol.kind),
        tags: None,
        deprecated: None,
        range: places.range(&symbol.range),
        selection_range: places.range(&symbol.selection),
        children: (!children.is_empty()).then_some(children),
    }
}

fn flatten(
    symbols: Vec<Symbol>,
    container: Option<&str>,
    uri: &Uri,
    places: &mut Places<'_>,
    out: &mut Vec<SymbolInformation>,
) {
    for symbol in symbols {
        let name = shown_name(symbol.name);
        #[expect(deprecated, reason = "the type has a field that the protocol gave up")]
        out.push(SymbolInformation {
            name: name.clone(),
            kind: symbol_kind(symbol.kind),
            tags: None,
            deprecated: None,
            location: Location::new(uri.clone(), places.range(&symbol.range)),
            container_name: container.map(str::to_owned),
        });
        flatten(symbol.children, Some(&name), uri, places, out);
    }
}
