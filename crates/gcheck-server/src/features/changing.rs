//! Changes of the text that the user asks for: actions at a place, formatting.
//!
//! Knows: their forms in the protocol. Must not know: what is changed how.

use gcheck_db::Snapshot;
use gcheck_ide::{ActionKind, FileEdits, PathChange, Style};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::commands::OPEN_PAGE;
use super::navigating::workspace_edit;
use super::{given_up, refused, text_edits};
use crate::mailbox::Reply;
use crate::owner::{Addressed, Owner};
use crate::position::Places;
use crate::proto::{
    ApplyWorkspaceEdit, ApplyWorkspaceEditParams, ApplyWorkspaceEditResponse, CodeAction, CodeActionKind,
    CodeActionOrCommand, CodeActionParams, CodeActionResponse, Command, Diagnostic, DocumentFormattingParams,
    DocumentOnTypeFormattingParams, DocumentRangeFormattingParams, Error, NumberOrString, Result, TextEdit,
    Uri,
};

/// Fixes what has a fix that changes no move; editors may run it whenever a file is saved.
const FIX_ALL: &str = "source.fixAll.gcheck";

/// The kinds of actions, for clients that ask for one kind.
pub(crate) fn action_kinds() -> Vec<CodeActionKind> {
    vec![
        CodeActionKind::QUICKFIX,
        CodeActionKind::REFACTOR_REWRITE,
        CodeActionKind::SOURCE,
        CodeActionKind::from(FIX_ALL),
    ]
}

/// Blocks that each run of a proof may execute.
const PROOF_FUEL: u64 = 2_000_000;

/// What `gcheck.changePath` is given.
#[derive(Debug, Deserialize)]
pub(crate) struct ChangePath {
    uri: Uri,
    /// What is selected; the whole program without it.
    range: Option<crate::proto::Range>,
    /// `translate`, `renumber`, or the name of a change that needs no figures.
    change: String,
    x: Option<String>,
    y: Option<String>,
    z: Option<String>,
    start: Option<u32>,
    step: Option<u32>,
}

impl ChangePath {
    fn asked(&self) -> std::result::Result<PathChange, String> {
        match self.change.as_str() {
            "translate" => PathChange::shift([&self.x, &self.y, &self.z].map(Option::as_deref)),
            "renumber" => PathChange::renumber(self.start.unwrap_or(10), self.step.unwrap_or(10)),
            name => PathChange::named(name).ok_or_else(|| format!("there is no change `{name}`")),
        }
    }
}

/// What a change came to.
#[derive(Debug, Serialize)]
pub(crate) struct Changed {
    /// What is proved, a sentence without a capital and a full stop.
    claim: String,
    /// The program is changed, and not as it was before.
    changes: bool,
}

/// A change that is proved when it is chosen.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Asked {
    uri: Uri,
    version: i32,
    name: String,
    range: Option<[u32; 2]>,
}

/// No change has this name.
fn unknown_change() -> Error {
    Error::invalid_params("the name of the change is not known")
}

impl Owner {
    pub(crate) fn code_actions(
        &mut self,
        params: &CodeActionParams,
        stop: &dyn Fn() -> bool,
    ) -> Result<Option<CodeActionResponse>> {
        if !self.abilities.action_literals {
            return Ok(None);
        }
        let uri = &params.text_document.uri;
        if self.is_configuration(uri) {
            return Ok(None);
        }
        self.choose_settings(uri);
        let snapshot = self.snapshot(uri)?;
        let mut places = self.places(&snapshot);
        let range = places.bytes(params.range);
        // Fixes are of findings, so the findings must be there.
        let analysis = self.analyse(uri, stop).map_err(given_up)?;
        let document = self.document(uri)?;
        let (id, version) = (document.id, document.version);
        let found =
            gcheck_ide::code_actions(&mut self.database, id, range.clone(), analysis.as_deref(), stop)
                .map_err(given_up)?;
        let files = Addressed::of(uri, id, version, document_name(self, uri), snapshot.clone());
        let mut out = Vec::new();
        for action in found {
            let kind = match action.kind {
                ActionKind::Fix | ActionKind::Suppress | ActionKind::Explain => CodeActionKind::QUICKFIX,
                ActionKind::FixAll => CodeActionKind::from(FIX_ALL),
                ActionKind::Rewrite => CodeActionKind::REFACTOR_REWRITE,
                ActionKind::Source => CodeActionKind::SOURCE,
            };
            if !is_wanted(&kind, params.context.only.as_deref()) {
                continue;
            }
            let answers = action.finding.as_ref().zip(action.rule).map(|(bytes, rule)| {
                let range = places.range(bytes);
                let is_it = |shown: &&Diagnostic| {
                    shown.range == range && shown.code == Some(NumberOrString::String(rule.to_owned()))
                };
                params.context.diagnostics.iter().filter(is_it).cloned().collect::<Vec<_>>()
            });
            let edit = (!action.edits.is_empty()).then(|| {
                let edits = vec![FileEdits { file: id, edits: action.edits }];
                workspace_edit(&files, edits, self.abilities.encoding, self.abilities.versioned_edits)
            });
            // A client that shows pages itself needs no address.
            let command = action.link.map(|link| match (&self.abilities.explain_command, action.rule) {
                (Some(command), Some(rule)) => (command.clone(), rule.to_owned()),
                _ => (OPEN_PAGE.to_owned(), link),
            });
            let command = command.map(|(command, argument)| Command {
                title: action.title.clone(),
                command,
                arguments: Some(vec![argument.into()]),
            });
            out.push(CodeActionOrCommand::CodeAction(CodeAction {
                title: action.title,
                kind: Some(kind),
                diagnostics: answers.filter(|list| !list.is_empty()),
                edit,
                command,
                is_preferred: action.is_preferred.then_some(true),
                disabled: None,
                data: None,
            }));
        }
        self.offer_proved(params, &snapshot, &range, &mut out);
        Ok(Some(out))
    }

    /// Changes that are proved when they are chosen: all that may fit where something is selected or refactorings are asked
    /// for, and else the one for the block at the cursor.
    fn offer_proved(
        &self,
        params: &CodeActionParams,
        snapshot: &Snapshot,
        range: &std::ops::Range<u32>,
        out: &mut CodeActionResponse,
    ) {
        let kind = CodeActionKind::REFACTOR_REWRITE;
        let only = params.context.only.as_deref();
        let is_asked = only.is_some_and(|only| is_wanted(&kind, Some(only)));
        if !self.abilities.resolves_actions || !(is_asked || only.is_none()) {
            return;
        }
        let mut changes: Vec<_> = gcheck_ide::proved_change_at(snapshot, range.start).into_iter().collect();
        if is_asked || !range.is_empty() {
            changes.extend(gcheck_ide::proved_changes(snapshot, range));
        }
        let uri = &params.text_document.uri;
        let Ok(document) = self.document(uri) else { return };
        for change in changes {
            let asked = Asked {
                uri: uri.clone(),
                version: document.version,
                name: change.name.to_owned(),
                range: change.range.map(|range| [range.start, range.end]),
            };
            out.push(CodeActionOrCommand::CodeAction(CodeAction {
                title: change.title,
                kind: Some(kind.clone()),
                data: serde_json::to_value(asked).ok(),
                ..CodeAction::default()
            }));
        }
        // The client asks for the figures, and then for the change.
        let Some(command) = self.abilities.change_command.as_ref().filter(|_| is_asked || !range.is_empty())
        else {
            return;
        };
        let selected = (!range.is_empty()).then_some(params.range);
        for (name, title) in gcheck_ide::WITH_FIGURES {
            // Blocks are numbered in the whole file.
            let selected = selected.filter(|_| name != "renumber");
            let part = if selected.is_some() { " in the selected lines" } else { "" };
            let title = format!("{title}{part} …, with proof");
            let argument = serde_json::json!({ "uri": uri, "range": selected, "change": name });
            let command =
                Command { title: title.clone(), command: command.clone(), arguments: Some(vec![argument]) };
            out.push(CodeActionOrCommand::CodeAction(CodeAction {
                title,
                kind: Some(kind.clone()),
                command: Some(command),
                ..CodeAction::default()
            }));
        }
    }

    /// Makes a change of a program with its proof, and has the client write it; the error is the reason why it is not made.
    pub(crate) fn change_path(&mut self, asked: &ChangePath, reply: Reply<Option<Value>>) {
        let uri = asked.uri.clone();
        if self.is_configuration(&uri) {
            return reply.send(Err(refused("a configuration has no path".to_owned())));
        }
        let change = match asked.asked() {
            Ok(change) => change,
            Err(reason) => return reply.send(Err(refused(reason))),
        };
        self.choose_settings(&uri);
        let found = self.document(&uri).map(|document| (document.id, document.version));
        let (id, version, snapshot) = match (found, self.snapshot(&uri)) {
            (Ok((id, version)), Ok(snapshot)) => (id, version, snapshot),
            (Err(error), _) | (_, Err(error)) => return reply.send(Err(error)),
        };
        let range = asked.range.map(|range| lines_of(&self.places(&snapshot), &snapshot, range)).transpose();
        let range = match range {
            Ok(range) => range,
            Err(reason) => return reply.send(Err(refused(reason))),
        };
        let files = Addressed::of(&uri, id, version, document_name(self, &uri), snapshot.clone());
        let (encoding, versioned) = (self.abilities.encoding, self.abilities.versioned_edits);
        let outbox = std::sync::Arc::clone(&self.outbox);
        let work = move |stop: &dyn Fn() -> bool| {
            let proved = gcheck_ide::proved(&snapshot, &change, range, PROOF_FUEL, stop).map_err(given_up)?;
            let proved = proved.map_err(refused)?;
            let edit = (!proved.edits.is_empty()).then(|| {
                let edits = vec![FileEdits { file: id, edits: proved.edits }];
                workspace_edit(&files, edits, encoding, versioned)
            });
            Ok((proved.claim, edit))
        };
        self.finish_elsewhere(&uri, true, reply, work, move |(claim, edit), reply| {
            let changed = Changed { changes: edit.is_some(), claim };
            let answer = |changed: &Changed| serde_json::to_value(changed).ok();
            let Some(edit) = edit else { return reply.send(Ok(answer(&changed))) };
            let params = ApplyWorkspaceEditParams { label: Some(changed.claim.clone()), edit };
            // The claim holds of the text that the client writes, so the answer waits for it.
            outbox.ask::<ApplyWorkspaceEdit>(params, move |written| {
                reply.send(written.and_then(is_applied).map(|()| answer(&changed)));
            });
        });
    }

    /// Proves a change that was chosen, and answers with its edits; the error is the reason why it is not made.
    pub(crate) fn resolve_action(&mut self, action: CodeAction, reply: Reply<CodeAction>) {
        let asked = action.data.as_ref().and_then(|data| serde_json::from_value::<Asked>(data.clone()).ok());
        let Some(asked) = asked else { return reply.send(Ok(action)) };
        let uri = asked.uri.clone();
        self.choose_settings(&uri);
        let found = self.document(&uri).map(|document| (document.id, document.version));
        let (id, version, snapshot) = match (found, self.snapshot(&uri)) {
            (Ok((id, version)), Ok(snapshot)) => (id, version, snapshot),
            (Err(error), _) | (_, Err(error)) => return reply.send(Err(error)),
        };
        if version != asked.version {
            return reply.send(Err(crate::proto::Error::content_modified()));
        }
        let files = Addressed::of(&uri, id, version, document_name(self, &uri), snapshot.clone());
        let (encoding, versioned) = (self.abilities.encoding, self.abilities.versioned_edits);
        self.answer_elsewhere(&uri, true, reply, move |stop| {
            let range = asked.range.map(|[start, end]| start..end);
            let change = PathChange::named(&asked.name).ok_or_else(unknown_change)?;
            let proved = gcheck_ide::proved(&snapshot, &change, range, PROOF_FUEL, stop).map_err(given_up)?;
            let proved = proved.map_err(refused)?;
            if proved.edits.is_empty() {
                return Err(refused(proved.claim));
            }
            let edits = vec![FileEdits { file: id, edits: proved.edits }];
            let edit = workspace_edit(&files, edits, encoding, versioned);
            Ok(CodeAction {
                title: format!("{}: {}", action.title, proved.claim),
                edit: Some(edit),
                ..action
            })
        });
    }

    pub(crate) fn formatting(&mut self, params: &DocumentFormattingParams) -> Result<Option<Vec<TextEdit>>> {
        let uri = &params.text_document.uri;
        self.format(uri, |snapshot, _, style| gcheck_ide::format_in(snapshot, style, None))
    }

    pub(crate) fn range_formatting(
        &mut self,
        params: &DocumentRangeFormattingParams,
    ) -> Result<Option<Vec<TextEdit>>> {
        self.format(&params.text_document.uri, |snapshot, places, style| {
            gcheck_ide::format_in(snapshot, style, Some(places.bytes(params.range)))
        })
    }

    pub(crate) fn on_type_formatting(
        &mut self,
        params: &DocumentOnTypeFormattingParams,
    ) -> Result<Option<Vec<TextEdit>>> {
        let at = &params.text_document_position;
        self.format(&at.text_document.uri, |snapshot, places, style| {
            gcheck_ide::format_on_type_in(snapshot, style, places.offset(at.position))
        })
    }

    fn format(
        &mut self,
        uri: &Uri,
        edits: impl FnOnce(&Snapshot, &Places<'_>, &Style) -> Vec<gcheck_ide::Edit>,
    ) -> Result<Option<Vec<TextEdit>>> {
        if self.is_configuration(uri) {
            return Ok(None);
        }
        self.choose_settings(uri);
        let snapshot = self.snapshot(uri)?;
        let mut places = self.places(&snapshot);
        let style = self.document(uri)?.in_force.style.clone();
        let style = style.unwrap_or_else(|| Style::of(snapshot.control()));
        let edits = edits(&snapshot, &places, &style);
        Ok(Some(text_edits(edits, &mut places)))
    }
}

/// The lines that a range touches: an empty one the line that it is in. The error says why it has none.
fn lines_of(
    places: &Places<'_>,
    snapshot: &Snapshot,
    range: crate::proto::Range,
) -> std::result::Result<std::ops::Range<u32>, String> {
    let (start, end) = (range.start, range.end);
    if (end.line, end.character) < (start.line, start.character) {
        return Err("the range ends before it begins".to_owned());
    }
    let lines = snapshot.line_count();
    // All lines end where one more would begin.
    let is_all = start.line < end.line && (end.line, end.character) == (lines, 0);
    if start.line >= lines || end.line >= lines && !is_all {
        return Err(format!("the range is not in the program, which has {lines} lines"));
    }
    Ok(gcheck_ide::whole_lines(snapshot, &places.bytes(range)))
}

/// Did the client write an edit? The error says why it did not.
fn is_applied(answer: ApplyWorkspaceEditResponse) -> Result<()> {
    if answer.applied {
        return Ok(());
    }
    let reason = answer.failure_reason.map(|reason| format!(": {reason}")).unwrap_or_default();
    Err(refused(format!("the editor did not write the change{reason}")))
}

fn document_name(owner: &Owner, uri: &Uri) -> std::sync::Arc<str> {
    owner.document(uri).map(crate::documents::Document::name).unwrap_or_default()
}

/// A client that asks for `source` wants `source.fixAll.gcheck` too.
fn is_wanted(kind: &CodeActionKind, only: Option<&[CodeActionKind]>) -> bool {
    only.is_none_or(|only| {
        only.iter().any(|wanted| {
            let rest = kind.as_str().strip_prefix(wanted.as_str());
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.') || wanted.as_str().is_empty())
        })
    })
}

#[cfg(test)]
mod tests {
    use super::{FIX_ALL, is_wanted};
    use crate::proto::CodeActionKind;

    #[test]
    fn kinds_are_asked_for_by_their_beginning() {
        let fix_all = CodeActionKind::from(FIX_ALL);
        assert!(is_wanted(&fix_all, None));
        assert!(is_wanted(&fix_all, Some(&[CodeActionKind::SOURCE])));
        assert!(is_wanted(&fix_all, Some(&[CodeActionKind::SOURCE_FIX_ALL])));
        assert!(!is_wanted(&fix_all, Some(&[CodeActionKind::QUICKFIX])));
        assert!(!is_wanted(&CodeActionKind::from("sources"), Some(&[CodeActionKind::SOURCE])));
    }
}
