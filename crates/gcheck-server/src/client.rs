//! The client: what it can do, and what its user has set.
//!
//! Knows: capabilities, the names of settings. Must not know: what either is used for.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use gcheck_ide::{InlayOptions, ShownRepeats};
use serde::Deserialize;
use serde_json::Value;

use crate::position::Encoding;
use crate::proto::{ClientCapabilities, InitializeParams, MarkupKind};

/// What the client can do.
#[derive(Debug, Clone, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a capability of its own")]
pub(crate) struct Abilities {
    pub(crate) encoding: Encoding,
    /// It asks for diagnostics, so they are not pushed.
    pub(crate) pulls: bool,
    pub(crate) refreshes_diagnostics: bool,
    pub(crate) refreshes_lenses: bool,
    pub(crate) refreshes_hints: bool,
    pub(crate) refreshes_tokens: bool,
    pub(crate) has_progress: bool,
    pub(crate) has_configuration: bool,
    pub(crate) registers_watchers: bool,
    pub(crate) registers_configuration: bool,
    pub(crate) related_information: bool,
    pub(crate) diagnostic_tags: bool,
    pub(crate) code_description: bool,
    pub(crate) symbol_tree: bool,
    pub(crate) location_links: bool,
    pub(crate) snippets: bool,
    /// Rows of a completion list have a text beside their labels.
    pub(crate) label_details: bool,
    /// What all rows of a completion list have in common may be said once: the range that they replace, our data.
    pub(crate) common_range: bool,
    pub(crate) common_data: bool,
    pub(crate) markdown_hover: bool,
    pub(crate) action_literals: bool,
    /// An action's edit may come when the action is chosen.
    pub(crate) resolves_actions: bool,
    pub(crate) versioned_edits: bool,
    pub(crate) shows_documents: bool,
    pub(crate) folds_lines_only: bool,
    /// Its command that shows all about a code: `experimental.gcheck.explainCommand`.
    pub(crate) explain_command: Option<String>,
    /// Its command that asks for the figures of a change: `experimental.gcheck.changeCommand`.
    pub(crate) change_command: Option<String>,
}

impl Abilities {
    pub(crate) fn read(params: &InitializeParams) -> Self {
        let ClientCapabilities { workspace, text_document, window, general, experimental, .. } =
            &params.capabilities;
        let own = experimental.as_ref().and_then(|experimental| experimental.get("gcheck"));
        let workspace = workspace.clone().unwrap_or_default();
        let text = text_document.clone().unwrap_or_default();
        let window = window.clone().unwrap_or_default();
        let encodings = general.as_ref().and_then(|general| general.position_encodings.as_deref());
        let published = text.publish_diagnostics.unwrap_or_default();
        let is = |flag: Option<bool>| flag.unwrap_or(false);
        let completion = text.completion.unwrap_or_default();
        let item = completion.completion_item.unwrap_or_default();
        let common = completion.completion_list.and_then(|list| list.item_defaults).unwrap_or_default();
        let is_common = |name: &str| common.iter().any(|known| known == name);
        let named = |name: &str| own.and_then(|own| own.get(name)?.as_str()).map(str::to_owned);
        let hover = text.hover.and_then(|hover| hover.content_format);
        Self {
            encoding: Encoding::choose(encodings),
            pulls: text.diagnostic.is_some(),
            refreshes_diagnostics: is(workspace.diagnostics.and_then(|d| d.refresh_support)),
            refreshes_lenses: is(workspace.code_lens.and_then(|lens| lens.refresh_support)),
            refreshes_hints: is(workspace.inlay_hint.and_then(|hint| hint.refresh_support)),
            refreshes_tokens: is(workspace.semantic_tokens.and_then(|tokens| tokens.refresh_support)),
            has_progress: is(window.work_done_progress),
            has_configuration: is(workspace.configuration),
            registers_watchers: is(workspace.did_change_watched_files.and_then(|w| w.dynamic_registration)),
            registers_configuration: is(workspace
                .did_change_configuration
                .and_then(|c| c.dynamic_registration)),
            related_information: is(published.related_information),
            diagnostic_tags: published.tag_support.is_some(),
            code_description: is(published.code_description_support),
            symbol_tree: is(text.document_symbol.and_then(|s| s.hierarchical_document_symbol_support)),
            location_links: is(text.definition.and_then(|definition| definition.link_support)),
            snippets: is(item.snippet_support),
            label_details: is(item.label_details_support),
            common_range: is_common("editRange"),
            common_data: is_common("data"),
            markdown_hover: hover.is_none_or(|formats| formats.contains(&MarkupKind::Markdown)),
            action_literals: text
                .code_action
                .as_ref()
                .is_some_and(|a| a.code_action_literal_support.is_some()),
            resolves_actions: text.code_action.is_some_and(|a| {
                let resolves = |support: &crate::proto::CodeActionCapabilityResolveSupport| {
                    support.properties.iter().any(|property| property == "edit")
                };
                is(a.data_support) && a.resolve_support.as_ref().is_some_and(resolves)
            }),
            versioned_edits: is(workspace.workspace_edit.and_then(|edit| edit.document_changes)),
            shows_documents: window.show_document.is_some_and(|show| show.support),
            explain_command: named("explainCommand"),
            change_command: named("changeCommand"),
            folds_lines_only: is(text.folding_range.and_then(|folding| folding.line_folding_only)),
        }
    }
}

/// When programs are analysed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub(crate) enum Moment {
    /// After each change.
    #[default]
    #[serde(rename = "onType")]
    OnType,
    /// When they are opened and saved.
    #[serde(rename = "onSave")]
    OnSave,
}

/// What the user has set, under `gcheck.` in most editors.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct ClientSettings {
    /// The control of all programs.
    pub(crate) control: Option<String>,
    /// The configuration of all programs.
    pub(crate) config_path: Option<PathBuf>,
    pub(crate) run: Moment,
    pub(crate) hints: InlayOptions,
    pub(crate) lenses: bool,
    /// Repeats of a rule are told as one.
    pub(crate) folds_repeats: bool,
    /// Messages are written to the log.
    pub(crate) trace: bool,
}

/// The settings in force where the user has set nothing.
static DEFAULTS: LazyLock<ClientSettings> = LazyLock::new(|| ClientSettings::read(&Value::Null).0);

impl ClientSettings {
    /// Of settings for folders and for all (`None`): those of the innermost folder that holds a file, else those for all.
    pub(crate) fn nearest<'s>(settings: &'s [(Option<PathBuf>, Self)], path: &Path) -> &'s Self {
        let fitting =
            settings.iter().filter(|(folder, _)| folder.as_ref().is_none_or(|f| path.starts_with(f)));
        let nearest =
            fitting.max_by_key(|(folder, _)| folder.as_ref().map_or(0, |f| f.as_os_str().len() + 1));
        nearest.map_or(&DEFAULTS, |(_, settings)| settings)
    }

    /// Reads the settings, from the object of `gcheck` or from one that has it. What is not understood is as if it were not
    /// said; the second part says so.
    pub(crate) fn read(value: &Value) -> (Self, Vec<String>) {
        let value = value.get("gcheck").unwrap_or(value);
        let mut complaints = Vec::new();
        let mut settings = Self { lenses: true, folds_repeats: true, ..Self::default() };
        let mut text = |name: &str| match value.get(name) {
            None | Some(Value::Null) => None,
            Some(Value::String(text)) => Some(text.trim().to_owned()).filter(|text| !text.is_empty()),
            Some(other) => {
                complaints.push(format!("the setting `gcheck.{name}` is not text: {other}"));
                None
            }
        };
        settings.control = text("control");
        settings.config_path = text("configPath").map(PathBuf::from);
        match text("run").as_deref() {
            None | Some("onType") => {}
            Some("onSave") => settings.run = Moment::OnSave,
            Some(other) => {
                complaints.push(format!("the setting `gcheck.run` is `onType` or `onSave`, not `{other}`"));
            }
        }
        if let Some(name) = &settings.control
            && !gcheck_controls::names().iter().any(|known| known == name)
        {
            complaints.push(format!("the setting `gcheck.control` names `{name}`, which is not a control"));
            settings.control = None;
        }
        settings.trace = value.pointer("/trace/server").and_then(Value::as_str).is_some_and(|t| t != "off");
        settings.lenses = switch(value, "codeLens", "enable")
            .or(value.get("codeLens").and_then(Value::as_bool))
            .unwrap_or(true);
        settings.folds_repeats = value.get("foldRepeats").and_then(Value::as_bool).unwrap_or(true);
        settings.hints = hints(value);
        (settings, complaints)
    }
}

impl ClientSettings {
    /// Are repeats of a rule shown one by one?
    pub(crate) fn shown_repeats(&self) -> ShownRepeats {
        if self.folds_repeats { ShownRepeats::Folded } else { ShownRepeats::All }
    }
}

fn switch(value: &Value, table: &str, name: &str) -> Option<bool> {
    value.get(table)?.get(name)?.as_bool()
}

/// `gcheck.inlayHints` as a whole, and each of its switches.
fn hints(value: &Value) -> InlayOptions {
    let all = value.get("inlayHints").and_then(Value::as_bool).or(switch(value, "inlayHints", "enable"));
    let is_on = |name: &str| all.unwrap_or(true) && switch(value, "inlayHints", name).unwrap_or(true);
    InlayOptions {
        feed: is_on("feed"),
        speed: is_on("speed"),
        values: is_on("values"),
        positions: is_on("positions"),
        tools: is_on("tools"),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{ClientSettings, Moment};

    #[test]
    fn settings_are_read_with_or_without_their_section() {
        let inner = json!({ "control": "linuxcnc", "run": "onSave", "inlayHints": { "feed": false } });
        let (settings, complaints) = ClientSettings::read(&inner);
        assert_eq!(complaints, [""; 0]);
        assert_eq!(ClientSettings::read(&json!({ "gcheck": inner })).0, settings);
        assert_eq!((settings.control.as_deref(), settings.run), (Some("linuxcnc"), Moment::OnSave));
        assert!(!settings.hints.feed && settings.hints.speed && settings.lenses && settings.folds_repeats);
        assert!(!ClientSettings::read(&json!({ "foldRepeats": false })).0.folds_repeats);
    }

    #[test]
    fn what_is_not_understood_is_said_and_left_out() {
        let strange = json!({ "control": 5, "run": "never", "codeLens": "yes" });
        let (settings, complaints) = ClientSettings::read(&strange);
        assert_eq!(complaints.len(), 2, "{complaints:?}");
        assert_eq!(settings, ClientSettings::read(&json!(null)).0);
        let (settings, complaints) = ClientSettings::read(&json!({ "control": "no-such" }));
        assert_eq!((settings.control, complaints.len()), (None, 1));
    }
}
