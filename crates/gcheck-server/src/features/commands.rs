//! Commands that the client has us execute.
//!
//! Knows: their names and arguments. Must not know: who offers them to the user.

use std::str::FromStr as _;

use gcheck_db::Snapshot;
use serde::Deserialize;
use serde_json::Value;

use super::navigating::workspace_edit;
use crate::mailbox::Reply;
use crate::owner::{Addressed, Owner};
use crate::proto::{
    ApplyWorkspaceEdit, ApplyWorkspaceEditParams, Error, ExecuteCommandParams, MessageType, Result,
    ShowDocument, ShowDocumentParams, Uri,
};

/// Writes into a program which control it is for.
const SET_CONTROL: &str = "gcheck.setControl";
/// Makes a change of a program with its proof.
const CHANGE_PATH: &str = "gcheck.changePath";
/// Opens a page of the documentation.
pub(super) const OPEN_PAGE: &str = "gcheck.openPage";

/// All of them.
pub(crate) const COMMANDS: [&str; 3] = [SET_CONTROL, OPEN_PAGE, CHANGE_PATH];

/// Lines in which a comment may name the control.
const HEAD_LINES: u32 = 50;

/// What `gcheck.setControl` is given.
#[derive(Debug, Deserialize)]
struct SetControl {
    uri: Uri,
    control: String,
}

impl Owner {
    pub(crate) fn execute_command(&mut self, params: ExecuteCommandParams, reply: Reply<Option<Value>>) {
        if params.command != CHANGE_PATH {
            return reply.send(self.execute(params));
        }
        let argument = params.arguments.into_iter().next().unwrap_or_default();
        match serde_json::from_value(argument) {
            Ok(asked) => self.change_path(&asked, reply),
            Err(error) => reply.send(Err(Error::invalid_params(error.to_string()))),
        }
    }

    /// A command that is done at once.
    fn execute(&mut self, params: ExecuteCommandParams) -> Result<Option<Value>> {
        let argument = params.arguments.into_iter().next().unwrap_or_default();
        let unreadable = |error: serde_json::Error| Error::invalid_params(error.to_string());
        match params.command.as_str() {
            SET_CONTROL => self.set_control(serde_json::from_value(argument).map_err(unreadable)?)?,
            OPEN_PAGE => self.open_page(&serde_json::from_value::<String>(argument).map_err(unreadable)?),
            unknown => return Err(Error::invalid_params(format!("there is no command `{unknown}`"))),
        }
        Ok(None)
    }

    /// Has the client write a comment that names the control; the user sees it, can undo it, and it goes with the program.
    fn set_control(&mut self, SetControl { uri, control }: SetControl) -> Result<()> {
        if !gcheck_controls::names().contains(&control.as_str()) {
            let known = gcheck_controls::names().join(", ");
            return Err(Error::invalid_params(format!(
                "no control is called `{control}`; there are {known}"
            )));
        }
        let snapshot = self.snapshot(&uri)?;
        let document = self.document(&uri)?;
        let files = Addressed::of(&uri, document.id, document.version, document.name(), snapshot.clone());
        let edits =
            vec![gcheck_ide::FileEdits { file: document.id, edits: vec![naming(&snapshot, &control)] }];
        let edit = workspace_edit(&files, edits, self.abilities.encoding, self.abilities.versioned_edits);
        let outbox = std::sync::Arc::clone(&self.outbox);
        let params = ApplyWorkspaceEditParams { label: Some(format!("Set the control to {control}")), edit };
        self.outbox.ask::<ApplyWorkspaceEdit>(params, move |answer| {
            if !answer.is_ok_and(|answer| answer.applied) {
                outbox.show(MessageType::WARNING, "the comment that names the control could not be written");
            }
        });
        Ok(())
    }

    fn open_page(&self, address: &str) {
        let uri = Uri::from_str(address).ok().filter(|uri| uri.scheme().as_str() == "https");
        match uri {
            Some(uri) if self.abilities.shows_documents => {
                let params =
                    ShowDocumentParams { uri, external: Some(true), take_focus: None, selection: None };
                self.outbox.ask::<ShowDocument>(params, |_| ());
            }
            _ => self.outbox.show(MessageType::INFO, address),
        }
    }
}

/// The edit that has a comment of the program name the control: in the place of one that does already, else after the
/// lines that must come first.
fn naming(snapshot: &Snapshot, control: &str) -> gcheck_ide::Edit {
    let mut at = 0;
    let mut is_head = true;
    for line in 0..snapshot.line_count().min(HEAD_LINES) {
        let range = snapshot.line_range(line);
        let text = snapshot.slice(range.clone());
        if let Some(place) = named_control(&text) {
            return gcheck_ide::Edit {
                range: range.start + place.start as u32..range.start + place.end as u32,
                text: control.to_owned(),
            };
        }
        is_head &= comes_first(&text) || text.trim().is_empty();
        if is_head && line + 1 < snapshot.line_count() {
            at = snapshot.line_range(line + 1).start;
        }
    }
    let end = if snapshot.slice(0..snapshot.len().min(4_096)).contains("\r\n") { "\r\n" } else { "\n" };
    gcheck_ide::Edit { range: at..at, text: format!("(gcheck: control={control}){end}") }
}

/// The bytes of the name in `gcheck: control=NAME`.
fn named_control(line: &str) -> Option<std::ops::Range<usize>> {
    let (_, directive) = line.split_once("gcheck:")?;
    let value = directive.trim_start().strip_prefix("control")?.trim_start().strip_prefix('=')?.trim_start();
    let end = value.find(|c: char| !(c.is_ascii_alphanumeric() || c == '-')).unwrap_or(value.len());
    let start = line.len() - value.len();
    Some(start..start + end)
}

/// A tape mark or a program number: nothing may be before them.
fn comes_first(line: &str) -> bool {
    let line = line.trim_start();
    let digits = line.strip_prefix(['O', 'o', ':']).unwrap_or_default();
    line.starts_with('%') || digits.starts_with(|c: char| c.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use gcheck_db::{Database, Settings};

    use super::naming;

    fn named(text: &str) -> String {
        let control = gcheck_controls::load(gcheck_controls::fallback()).unwrap();
        let mut database = Database::new();
        let id = database.open(text, Settings::new(control, gcheck_rules::RULES));
        let edit = naming(&database.snapshot(id).unwrap(), "acme-mill");
        let mut text = text.to_owned();
        text.replace_range(edit.range.start as usize..edit.range.end as usize, &edit.text);
        text
    }

    #[test]
    fn the_comment_stands_behind_tape_mark_and_program_number() {
        assert_eq!(named("%\nO1 (A)\nG0\n"), "%\nO1 (A)\n(gcheck: control=acme-mill)\nG0\n");
        assert_eq!(named("G0 X1.\r\nM30\r\n"), "(gcheck: control=acme-mill)\r\nG0 X1.\r\nM30\r\n");
        assert_eq!(named(""), "(gcheck: control=acme-mill)\n");
        assert_eq!(named("%\n\nO1\nM30\n%\n"), "%\n\nO1\n(gcheck: control=acme-mill)\nM30\n%\n");
        assert_eq!(named("O1"), "(gcheck: control=acme-mill)\nO1");
    }

    #[test]
    fn a_comment_that_names_one_is_changed() {
        assert_eq!(
            named("(GCHECK)\n(gcheck: control = x-1 )\n"),
            "(GCHECK)\n(gcheck: control = acme-mill )\n"
        );
        assert_eq!(named("; gcheck: control=\n"), "; gcheck: control=acme-mill\n");
    }
}
