//! What is at the cursor: hover, signatures, other places of the same, ranges around.
//!
//! Knows: their forms in the protocol. Must not know: how they are worked out.

use gcheck_ide::ReferenceKind;

use super::markdown;
use crate::late_hover::LateHover;
use crate::owner::Owner;
use crate::proto::{
    DocumentHighlight, DocumentHighlightKind, DocumentHighlightParams, Documentation, Hover, HoverContents,
    HoverParams, MarkupContent, MarkupKind, ParameterInformation, ParameterLabel, Result, SelectionRange,
    SelectionRangeParams, SignatureHelp, SignatureHelpParams, SignatureHelpTriggerKind, SignatureInformation,
    Uri,
};

/// What a hover says instead of the state.
const STATE_TO_COME: &str = "*The state here is still being worked out: point here again in a moment.*";
const STATE_GIVEN_UP: &str = "*The state here is not known: the analysis of this program takes too long.*";

impl Owner {
    pub(crate) fn hover(&mut self, params: &HoverParams, stop: &dyn Fn() -> bool) -> Result<Option<Hover>> {
        let uri = &params.text_document_position_params.text_document.uri;
        let Some((id, offset)) = self.place(&params.text_document_position_params)? else {
            return self.configuration_hover(&params.text_document_position_params);
        };
        let clock = self.document(uri)?.clock.now();
        if let Some(known) = self.late_hover.as_ref().and_then(|late| late.answer(id, clock, offset)) {
            return Ok(Some(known.clone()));
        }
        let Some(hover) = gcheck_ide::hover(&mut self.database, id, offset, stop) else { return Ok(None) };
        if hover.is_without_state {
            self.late_hover = Some(LateHover::new(id, uri.clone(), clock, hover.range.clone()));
        }
        self.shown_hover(uri, hover).map(Some)
    }

    /// Is there a hover whose state is still to be worked out?
    pub(crate) fn has_late_hover(&self) -> bool {
        // An analysis that was given up is not begun again for it.
        let is_of_now = |late: &LateHover| {
            self.document(&late.uri).is_ok_and(|known| {
                known.id == late.document && known.clock.now() == late.clock && !known.took_too_long()
            })
        };
        self.late_hover.as_ref().is_some_and(|late| late.is_open() && is_of_now(late))
    }

    /// Works out, while nobody asks for anything, what a hover was too early for, so that the next one at the place has it.
    pub(crate) fn finish_late_hover(&mut self, stop: &dyn Fn() -> bool) {
        let Some(late) = self.late_hover.take() else { return };
        let hover = gcheck_ide::hover(&mut self.database, late.document, late.bytes.start, stop);
        let whole = hover.filter(|hover| !hover.is_without_state);
        let answer = whole.and_then(|hover| self.shown_hover(&late.uri, hover).ok());
        self.late_hover = Some(late.tried(answer));
    }

    fn shown_hover(&mut self, uri: &Uri, mut hover: gcheck_ide::Hover) -> Result<Hover> {
        let snapshot = self.snapshot(uri)?;
        if hover.is_without_state {
            let is_given_up = self.document(uri)?.took_too_long();
            hover.markdown.push_str("\n\n---\n\n");
            hover.markdown.push_str(if is_given_up { STATE_GIVEN_UP } else { STATE_TO_COME });
        }
        if let Some(code) = &hover.code {
            let control = snapshot.control().name();
            hover.markdown.push_str("\n\n");
            hover.markdown.push_str(&more(code, control, self.abilities.explain_command.as_deref()));
        }
        let range = self.places(&snapshot).range(&hover.range);
        let kind = if self.abilities.markdown_hover { MarkupKind::Markdown } else { MarkupKind::PlainText };
        let contents = HoverContents::Markup(MarkupContent { kind, value: hover.markdown });
        Ok(Hover { contents, range: Some(range) })
    }

    pub(crate) fn signature_help(
        &mut self,
        params: &SignatureHelpParams,
        stop: &dyn Fn() -> bool,
    ) -> Result<Option<SignatureHelp>> {
        let at = &params.text_document_position_params;
        let Some((id, offset)) = self.place(at)? else { return Ok(None) };
        let files = self.workspace_of(&at.text_document.uri)?;
        // A client that says nothing of why it asks does so because its user does.
        let kind = params.context.as_ref().map(|context| &context.trigger_kind);
        let is_asked = kind.is_none_or(|kind| *kind == SignatureHelpTriggerKind::INVOKED);
        let found =
            gcheck_ide::signature_help(&mut self.database, &files.workspace, id, offset, is_asked, stop);
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
        let Some((_, offset)) = self.place(at)? else { return Ok(None) };
        let snapshot = self.indexed(&at.text_document.uri)?;
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
        let uri = &params.text_document.uri;
        if self.is_configuration(uri) {
            return Ok(None);
        }
        let snapshot = self.indexed(uri)?;
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

/// Where all about a code is told: a link to the client's command that shows it, else the command line's.
fn more(code: &str, control: &str, command: Option<&str>) -> String {
    match command {
        // Names of codes and controls are letters, digits, points and dashes; quotes and brackets are escaped for the address.
        Some(command) => format!("[All about {code}](command:{command}?%5B%22{code}%22,%22{control}%22%5D)"),
        None => format!("`gcheck explain {code} --control {control}` tells all about it"),
    }
}

#[cfg(test)]
mod tests {
    use super::more;

    #[test]
    fn a_client_with_a_command_is_given_a_link() {
        assert_eq!(
            more("G54.1", "haas-mill", Some("gcheck.explain")),
            "[All about G54.1](command:gcheck.explain?%5B%22G54.1%22,%22haas-mill%22%5D)"
        );
        assert_eq!(
            more("G83", "linuxcnc", None),
            "`gcheck explain G83 --control linuxcnc` tells all about it"
        );
    }
}
