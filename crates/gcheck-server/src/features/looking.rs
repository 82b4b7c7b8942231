//! What is at the cursor: hover, completion, signatures, other places of the same, ranges around.
//!
//! Knows: their forms in the protocol. Must not know: how they are worked out.

use gcheck_ide::{Completion, CompletionKind, ReferenceKind};

use super::{given_up, markdown, text_edit};
use crate::owner::Owner;
use crate::proto::{
    CompletionItem, CompletionItemKind, CompletionList, CompletionParams, CompletionResponse,
    CompletionTextEdit, DocumentHighlight, DocumentHighlightKind, DocumentHighlightParams, Documentation,
    Hover, HoverContents, HoverParams, InsertTextFormat, MarkupContent, MarkupKind, ParameterInformation,
    ParameterLabel, Result, SelectionRange, SelectionRangeParams, SignatureHelp, SignatureHelpParams,
    SignatureInformation,
};

impl Owner {
    pub(crate) fn hover(&mut self, params: &HoverParams, stop: &dyn Fn() -> bool) -> Result<Option<Hover>> {
        let at = &params.text_document_position_params;
        let (id, offset) = self.place(at)?;
        let analysis = self.known_analysis(&at.text_document.uri);
        let hover = gcheck_ide::hover(&mut self.database, id, offset, analysis.as_deref(), stop);
        let Some(hover) = hover.map_err(given_up)? else { return Ok(None) };
        let snapshot = self.snapshot(&at.text_document.uri)?;
        let range = self.places(&snapshot).range(&hover.range);
        let kind = if self.abilities.markdown_hover { MarkupKind::Markdown } else { MarkupKind::PlainText };
        let contents = HoverContents::Markup(MarkupContent { kind, value: hover.markdown });
        Ok(Some(Hover { contents, range: Some(range) }))
    }

    pub(crate) fn completion(
        &mut self,
        params: &CompletionParams,
        stop: &dyn Fn() -> bool,
    ) -> Result<Option<CompletionResponse>> {
        let at = &params.text_document_position;
        let (id, offset) = self.place(at)?;
        let uri = &at.text_document.uri;
        let files = self.workspace_of(uri)?;
        let found = gcheck_ide::completion(&mut self.database, &files.workspace, id, offset, stop);
        let snapshot = self.snapshot(uri)?;
        let mut places = self.places(&snapshot);
        let snippets = self.abilities.snippets;
        let found = found.map_err(given_up)?;
        let items = found.into_iter().filter(|item| snippets || !item.is_snippet);
        let items = items.map(|item| completion_item(item, &mut places)).collect();
        // What fits depends on the block, so each letter asks again.
        Ok(Some(CompletionResponse::List(CompletionList { is_incomplete: true, items })))
    }

    pub(crate) fn signature_help(&mut self, params: &SignatureHelpParams) -> Result<Option<SignatureHelp>> {
        let at = &params.text_document_position_params;
        let (id, offset) = self.place(at)?;
        let files = self.workspace_of(&at.text_document.uri)?;
        let found = gcheck_ide::signature_help(&files.workspace, id, offset);
        let active = found.first().and_then(|signature| signature.active);
        let signatures: Vec<SignatureInformation> = found
            .into_iter()
            .map(|signature| SignatureInformation {
                label: signature.label,
                documentation: Some(Documentation::MarkupContent(markdown(signature.documentation))),
                active_parameter: signature.active,
                parameters: Some(
                    signature
                        .parameters
                        .into_iter()
                        .map(|parameter| ParameterInformation {
                            // Labels are ASCII, so bytes are units of every encoding.
                            label: ParameterLabel::LabelOffsets([parameter.label.start, parameter.label.end]),
                            documentation: Some(Documentation::MarkupContent(markdown(
                                parameter.documentation,
                            ))),
                        })
                        .collect(),
                ),
            })
            .collect();
        if signatures.is_empty() {
            return Ok(None);
        }
        Ok(Some(SignatureHelp { signatures, active_signature: Some(0), active_parameter: active }))
    }

    pub(crate) fn highlights(
        &mut self,
        params: &DocumentHighlightParams,
    ) -> Result<Option<Vec<DocumentHighlight>>> {
        let at = &params.text_document_position_params;
        let (_, offset) = self.place(at)?;
        let snapshot = self.outlined(&at.text_document.uri)?;
        let mut places = self.places(&snapshot);
        let found =
            gcheck_ide::highlights(&snapshot, offset).into_iter().map(|highlight| DocumentHighlight {
                range: places.range(&highlight.range),
                kind: Some(match highlight.kind {
                    ReferenceKind::Write => DocumentHighlightKind::WRITE,
                    ReferenceKind::Read => DocumentHighlightKind::READ,
                }),
            });
        Ok(Some(found.collect()))
    }

    pub(crate) fn selection_ranges(
        &mut self,
        params: &SelectionRangeParams,
    ) -> Result<Option<Vec<SelectionRange>>> {
        let snapshot = self.outlined(&params.text_document.uri)?;
        let mut places = self.places(&snapshot);
        let ranges = params.positions.iter().map(|position| {
            let offset = places.offset(*position);
            let around = gcheck_ide::selection_ranges(&snapshot, offset);
            let mut parent = None;
            for range in around.iter().rev() {
                parent = Some(Box::new(SelectionRange { range: places.range(range), parent }));
            }
            // Each position has an answer, if only itself.
            parent.map_or_else(
                || SelectionRange { range: places.range(&(offset..offset)), parent: None },
                |range| *range,
            )
        });
        Ok(Some(ranges.collect()))
    }
}

fn completion_item(item: Completion, places: &mut crate::position::Places<'_>) -> CompletionItem {
    let kind = match item.kind {
        CompletionKind::Code => CompletionItemKind::OPERATOR,
        CompletionKind::Word => CompletionItemKind::PROPERTY,
        CompletionKind::Variable => CompletionItemKind::VARIABLE,
        CompletionKind::Function => CompletionItemKind::FUNCTION,
        CompletionKind::Keyword => CompletionItemKind::KEYWORD,
        CompletionKind::Label => CompletionItemKind::REFERENCE,
        CompletionKind::Program => CompletionItemKind::MODULE,
        CompletionKind::Snippet => CompletionItemKind::SNIPPET,
        CompletionKind::Rule => CompletionItemKind::ENUM_MEMBER,
        CompletionKind::Control => CompletionItemKind::CONSTANT,
    };
    let format = if item.is_snippet { InsertTextFormat::SNIPPET } else { InsertTextFormat::PLAIN_TEXT };
    CompletionItem {
        label: item.label,
        kind: Some(kind),
        detail: Some(item.detail).filter(|detail| !detail.is_empty()),
        documentation: item.documentation.map(|text| Documentation::MarkupContent(markdown(text))),
        sort_text: Some(item.sort),
        filter_text: Some(item.filter),
        insert_text_format: Some(format),
        text_edit: Some(CompletionTextEdit::Edit(text_edit(item.edit, places))),
        ..CompletionItem::default()
    }
}
