//! From one place to others: definitions, references, renaming, calls, links, symbols of the workspace.
//!
//! Knows: their forms in the protocol. Must not know: what names what.

use std::collections::HashMap;
use std::ops::Range;

use gcheck_ide::{CallItem, FileEdits};

use super::structure::symbol_kind;
use super::{refused, text_edits};
use crate::mailbox::Reply;
use crate::owner::{Addressed, Owner};
use crate::position::{Encoding, Places};
use crate::proto::{
    self, CallHierarchyIncomingCall, CallHierarchyIncomingCallsParams, CallHierarchyItem,
    CallHierarchyOutgoingCall, CallHierarchyOutgoingCallsParams, CallHierarchyPrepareParams, DocumentChanges,
    DocumentLink, DocumentLinkParams, GotoDefinitionParams, GotoDefinitionResponse, Location, LocationLink,
    OneOf, OptionalVersionedTextDocumentIdentifier, PrepareRenameResponse, ReferenceParams, RenameParams,
    Result, SymbolInformation, TextDocumentEdit, TextDocumentPositionParams, Uri, WorkspaceEdit,
    WorkspaceSymbolParams, WorkspaceSymbolResponse,
};

impl Owner {
    pub(crate) fn definition(
        &mut self,
        params: &GotoDefinitionParams,
    ) -> Result<Option<GotoDefinitionResponse>> {
        let at = &params.text_document_position_params;
        let uri = &at.text_document.uri;
        let Some((id, offset)) = self.place(at)? else { return Ok(None) };
        let files = self.workspace_of(uri)?;
        let found = gcheck_ide::definition(&files.workspace, id, offset);
        // A code of the shop that calls a program leads to both.
        let entries = self.configured(uri, offset)?;
        let encoding = self.abilities.encoding;
        if !self.abilities.location_links {
            let places = found.iter().filter_map(|target| files.location(&target.name, encoding));
            let places = places.chain(entries.into_iter().map(|entry| entry.location));
            return Ok(Some(GotoDefinitionResponse::Array(places.collect())));
        }
        let snapshot = self.snapshot(uri)?;
        let mut own = self.places(&snapshot);
        let links = found.iter().filter_map(|target| {
            let mut places = Places::new(files.snapshot(target.name.file)?, encoding);
            Some(LocationLink {
                origin_selection_range: Some(own.range(&target.from)),
                target_uri: files.uri(target.name.file)?.clone(),
                target_range: places.range(&target.full),
                target_selection_range: places.range(&target.name.range),
            })
        });
        let mut links: Vec<LocationLink> = links.collect();
        links.extend(entries.into_iter().map(|entry| LocationLink {
            origin_selection_range: Some(own.range(&entry.from)),
            target_uri: entry.location.uri,
            target_range: entry.location.range,
            target_selection_range: entry.location.range,
        }));
        Ok(Some(GotoDefinitionResponse::Link(links)))
    }

    pub(crate) fn references(&mut self, params: &ReferenceParams, reply: Reply<Option<Vec<Location>>>) {
        let at = &params.text_document_position;
        let uri = &at.text_document.uri;
        let prepared = self.place(at).and_then(|place| {
            // Of a configuration nothing is looked for.
            let Some(place) = place else { return Ok(None) };
            Ok(Some((place, self.workspace_of(uri)?)))
        });
        let ((id, offset), files) = match prepared {
            Ok(Some(prepared)) => prepared,
            Ok(None) => return reply.send(Ok(None)),
            Err(error) => return reply.send(Err(error)),
        };
        let entries =
            if params.context.include_declaration { self.configured(uri, offset) } else { Ok(Vec::new()) };
        let entries = entries.unwrap_or_default();
        let (encoding, declarations) = (self.abilities.encoding, params.context.include_declaration);
        self.answer_elsewhere(uri, is_large(&files), reply, move |_| {
            let found = gcheck_ide::references(&files.workspace, id, offset, declarations);
            let mut out = Vec::with_capacity(found.len());
            let mut last: Option<(gcheck_db::DocumentId, Places<'_>)> = None;
            for reference in &found {
                let file = reference.place.file;
                if last.as_ref().is_none_or(|(id, _)| *id != file) {
                    last = files.snapshot(file).map(|snapshot| (file, Places::new(snapshot, encoding)));
                }
                if let (Some((_, places)), Some(uri)) = (&mut last, files.uri(file)) {
                    out.push(Location::new(uri.clone(), places.range(&reference.place.range)));
                }
            }
            out.extend(entries.into_iter().map(|entry| entry.location));
            Ok(Some(out))
        });
    }

    pub(crate) fn prepare_rename(
        &mut self,
        params: &TextDocumentPositionParams,
    ) -> Result<Option<PrepareRenameResponse>> {
        let uri = &params.text_document.uri;
        let Some((id, offset)) = self.place(params)? else { return Ok(None) };
        let files = self.workspace_of(uri)?;
        let target =
            gcheck_ide::prepare_rename(&files.workspace, id, offset).map_err(|why| refused(why.0))?;
        let snapshot = self.snapshot(uri)?;
        let range = self.places(&snapshot).range(&target.range);
        Ok(Some(PrepareRenameResponse::RangeWithPlaceholder { range, placeholder: target.name }))
    }

    pub(crate) fn rename(&mut self, params: &RenameParams) -> Result<Option<WorkspaceEdit>> {
        let at = &params.text_document_position;
        let Some((id, offset)) = self.place(at)? else { return Ok(None) };
        let files = self.workspace_of(&at.text_document.uri)?;
        let edits = gcheck_ide::rename(&files.workspace, id, offset, &params.new_name)
            .map_err(|why| refused(why.0))?;
        Ok(Some(workspace_edit(&files, edits, self.abilities.encoding, self.abilities.versioned_edits)))
    }

    pub(crate) fn links(&mut self, params: &DocumentLinkParams) -> Result<Option<Vec<DocumentLink>>> {
        let uri = &params.text_document.uri;
        if self.is_configuration(uri) {
            return Ok(None);
        }
        let files = self.workspace_of(uri)?;
        let id = self.document(uri)?.id;
        let snapshot = self.snapshot(uri)?;
        let mut places = self.places(&snapshot);
        let links = gcheck_ide::document_links(&files.workspace, id).into_iter().filter_map(|link| {
            let target = files.location(&link.target, self.abilities.encoding)?;
            // Editors take the fragment for the place to show.
            let place = format!("{}#L{}", target.uri.as_str(), target.range.start.line + 1);
            Some(DocumentLink {
                range: places.range(&link.range),
                target: std::str::FromStr::from_str(&place).ok(),
                tooltip: Some(link.tooltip),
                data: None,
            })
        });
        Ok(Some(links.collect()))
    }

    pub(crate) fn prepare_call_hierarchy(
        &mut self,
        params: &CallHierarchyPrepareParams,
    ) -> Result<Option<Vec<CallHierarchyItem>>> {
        let at = &params.text_document_position_params;
        let Some((id, offset)) = self.place(at)? else { return Ok(None) };
        let files = self.workspace_of(&at.text_document.uri)?;
        let items = gcheck_ide::call_items(&files.workspace, id, offset);
        let encoding = self.abilities.encoding;
        Ok(Some(items.into_iter().filter_map(|item| call_item(item, &files, encoding)).collect()))
    }

    pub(crate) fn incoming_calls(
        &mut self,
        params: &CallHierarchyIncomingCallsParams,
    ) -> Result<Option<Vec<CallHierarchyIncomingCall>>> {
        let Some((files, item)) = self.known_call_item(&params.item)? else { return Ok(None) };
        let encoding = self.abilities.encoding;
        let calls = gcheck_ide::incoming_calls(&files.workspace, &item).into_iter().filter_map(|incoming| {
            let from_ranges = ranges(&files, incoming.from.place.file, &incoming.calls, encoding)?;
            Some(CallHierarchyIncomingCall { from: call_item(incoming.from, &files, encoding)?, from_ranges })
        });
        Ok(Some(calls.collect()))
    }

    pub(crate) fn outgoing_calls(
        &mut self,
        params: &CallHierarchyOutgoingCallsParams,
    ) -> Result<Option<Vec<CallHierarchyOutgoingCall>>> {
        let Some((files, item)) = self.known_call_item(&params.item)? else { return Ok(None) };
        let encoding = self.abilities.encoding;
        let calls = gcheck_ide::outgoing_calls(&files.workspace, &item).into_iter().filter_map(|outgoing| {
            let from_ranges = ranges(&files, item.place.file, &outgoing.calls, encoding)?;
            Some(CallHierarchyOutgoingCall { to: call_item(outgoing.to, &files, encoding)?, from_ranges })
        });
        Ok(Some(calls.collect()))
    }

    /// The program that an item of the client stands for, among the files that it may have to do with.
    fn known_call_item(&mut self, item: &CallHierarchyItem) -> Result<Option<(Addressed, CallItem)>> {
        // A file that is not open is looked at together with an open one that can reach it.
        let (mut asked, others): (Vec<Uri>, Vec<Uri>) =
            self.documents.keys().cloned().partition(|uri| *uri == item.uri);
        asked.extend(others);
        for uri in asked {
            let files = self.workspace_of(&uri)?;
            let Some(id) = files.id(&item.uri) else { continue };
            let Some(snapshot) = files.snapshot(id) else { continue };
            let offset = self.places(snapshot).offset(item.selection_range.start);
            let items = gcheck_ide::call_items(&files.workspace, id, offset);
            if let Some(known) = items.into_iter().find(|known| known.name == item.name) {
                return Ok(Some((files, known)));
            }
        }
        Ok(None)
    }

    pub(crate) fn workspace_symbols(
        &mut self,
        params: WorkspaceSymbolParams,
        reply: Reply<Option<WorkspaceSymbolResponse>>,
    ) {
        let files = self.whole_workspace();
        let encoding = self.abilities.encoding;
        self.workers.start_work(move || {
            if reply.is_cancelled() {
                return;
            }
            let found = gcheck_ide::workspace_symbols(&files.workspace, &params.query);
            let symbols = found.into_iter().filter_map(|symbol| {
                #[expect(deprecated, reason = "the type has a field that the protocol gave up")]
                Some(SymbolInformation {
                    location: files.location(&symbol.place, encoding)?,
                    name: symbol.name,
                    kind: symbol_kind(symbol.kind),
                    tags: None,
                    deprecated: None,
                    container_name: Some(symbol.container),
                })
            });
            reply.send(Ok(Some(WorkspaceSymbolResponse::Flat(symbols.collect()))));
        });
    }
}

/// Together they are worth another thread.
fn is_large(files: &Addressed) -> bool {
    files.workspace.files.iter().map(|file| file.snapshot.len()).sum::<u32>() > super::LARGE
}

/// Edits of several files as the client takes them.
pub(super) fn workspace_edit(
    files: &Addressed,
    edits: Vec<FileEdits>,
    encoding: Encoding,
    is_versioned: bool,
) -> WorkspaceEdit {
    let mut versioned = Vec::new();
    let mut plain: HashMap<Uri, Vec<proto::TextEdit>> = HashMap::new();
    for FileEdits { file, edits } in edits {
        let (Some((uri, version)), Some(snapshot)) = (files.addresses.get(&file), files.snapshot(file))
        else {
            continue;
        };
        let edits = text_edits(edits, &mut Places::new(snapshot, encoding));
        if is_versioned {
            versioned.push(TextDocumentEdit {
                text_document: OptionalVersionedTextDocumentIdentifier {
                    uri: uri.clone(),
                    version: *version,
                },
                edits: edits.into_iter().map(OneOf::Left).collect(),
            });
        } else {
            plain.insert(uri.clone(), edits);
        }
    }
    WorkspaceEdit {
        changes: (!is_versioned).then_some(plain),
        document_changes: is_versioned.then_some(DocumentChanges::Edits(versioned)),
        change_annotations: None,
    }
}

fn call_item(item: CallItem, files: &Addressed, encoding: Encoding) -> Option<CallHierarchyItem> {
    let mut places = Places::new(files.snapshot(item.place.file)?, encoding);
    Some(CallHierarchyItem {
        uri: files.uri(item.place.file)?.clone(),
        range: places.range(&item.range),
        selection_range: places.range(&item.place.range),
        name: item.name,
        kind: symbol_kind(item.kind),
        tags: None,
        detail: Some(item.detail),
        data: None,
    })
}

fn ranges(
    files: &Addressed,
    file: gcheck_db::DocumentId,
    bytes: &[Range<u32>],
    encoding: Encoding,
) -> Option<Vec<proto::Range>> {
    let mut places = Places::new(files.snapshot(file)?, encoding);
    Some(bytes.iter().map(|range| places.range(range)).collect())
}
