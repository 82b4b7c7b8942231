//! What is in force: what the user has set in the editor, and what the host makes of it for each document.
//!
//! Knows: when settings have to be chosen again. Must not know: where they come from.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use gcheck_db::Settings;
use gcheck_ide::ShownRepeats;
use serde::Serialize;
use serde_json::Value;

use super::synchronizing::path_of;
use super::{HostHandle, Owner, fallback_settings};
use crate::client::{Abilities, ClientSettings};
use crate::documents::{Callees, OpenTexts, Stale};
use crate::mailbox::Kind;
use crate::proto::{
    CodeLensRefresh, ConfigurationItem, ConfigurationParams, DidChangeWatchedFilesParams,
    DidChangeWatchedFilesRegistrationOptions, DidChangeWorkspaceFoldersParams, FileSystemWatcher,
    GlobPattern, InitializeParams, InlayHintRefreshRequest, MessageType, RegisterCapability, Registration,
    RegistrationParams, SemanticTokensRefresh, Uri, WorkspaceConfiguration, WorkspaceDiagnosticRefresh,
};
use crate::{InForce, OpenPrograms, ProgramQuery};

impl Owner {
    /// Takes what the client says of itself when it begins.
    pub(crate) fn initialize(&mut self, params: &InitializeParams) {
        self.abilities = crate::client::Abilities::read(params);
        let folders = params.workspace_folders.iter().flatten().filter_map(|folder| path_of(&folder.uri));
        self.folders = folders.collect();
        if self.folders.is_empty() {
            #[expect(deprecated, reason = "what clients said before they knew several folders")]
            let root = params.root_uri.as_ref().and_then(path_of);
            self.folders.extend(root);
        }
        if let Some(options) = &params.initialization_options {
            self.put_client_settings(vec![(None, options.clone())]);
        }
    }

    /// The client is ready to be asked.
    pub(crate) fn initialized(&mut self) {
        self.is_ready = true;
        let mut registrations = Vec::new();
        if self.abilities.registers_watchers {
            let watchers = self.host.0.watched().into_iter();
            let watchers = watchers
                .map(|glob| FileSystemWatcher { glob_pattern: GlobPattern::String(glob), kind: None })
                .collect();
            let options = DidChangeWatchedFilesRegistrationOptions { watchers };
            registrations.push(Registration {
                id: "gcheck-files".to_owned(),
                method: "workspace/didChangeWatchedFiles".to_owned(),
                register_options: serde_json::to_value(options).ok(),
            });
        }
        if self.abilities.registers_configuration {
            registrations.push(Registration {
                id: "gcheck-settings".to_owned(),
                method: "workspace/didChangeConfiguration".to_owned(),
                register_options: Some(serde_json::json!({ "section": "gcheck" })),
            });
        }
        if !registrations.is_empty() {
            let outbox = Arc::clone(&self.outbox);
            self.outbox.ask::<RegisterCapability>(RegistrationParams { registrations }, move |answer| {
                if let Err(error) = answer {
                    let message = format!("the client does not tell of changes of files: {error}");
                    outbox.log(MessageType::WARNING, message);
                }
            });
        }
        self.ask_for_settings();
    }

    /// Asks the client for what the user has set, for each folder and for all.
    fn ask_for_settings(&mut self) {
        if !self.abilities.has_configuration {
            return;
        }
        let item = |scope_uri| ConfigurationItem { scope_uri, section: Some("gcheck".to_owned()) };
        let folders: Vec<PathBuf> = self.folders.clone();
        let scopes = folders.iter().map(Uri::from_file_path);
        let items = std::iter::once(None).chain(scopes).map(item).collect();
        let mailbox = self.mailbox.clone();
        self.outbox.ask::<WorkspaceConfiguration>(ConfigurationParams { items }, move |answer| {
            let Ok(values) = answer else { return };
            mailbox.post("settings", Kind::Question, move |owner| {
                let scopes = std::iter::once(None).chain(folders.into_iter().map(Some));
                owner.put_client_settings(scopes.zip(values).collect());
            });
        });
    }

    /// The user has set something; some clients say what, others are asked.
    pub(crate) fn did_change_configuration(&mut self, settings: &Value) {
        if self.abilities.has_configuration {
            self.ask_for_settings();
        } else {
            self.put_client_settings(vec![(None, settings.clone())]);
        }
    }

    fn put_client_settings(&mut self, values: Vec<(Option<PathBuf>, Value)>) {
        let mut all: Vec<(Option<PathBuf>, ClientSettings)> = Vec::new();
        for (folder, value) in values {
            let (settings, complaints) = ClientSettings::read(&value);
            // Each folder repeats what holds for all.
            if folder.is_none() {
                for complaint in complaints {
                    self.outbox.show(MessageType::WARNING, complaint);
                }
            }
            // A folder that says what all say needs no entry.
            let is_news = folder.is_none() || all.first().is_none_or(|(_, general)| *general != settings);
            if is_news {
                all.push((folder, settings));
            }
        }
        if all != self.client_settings {
            self.client_settings = all;
            self.everything_changed();
        }
    }

    pub(crate) fn did_change_watched_files(&mut self, _: &DidChangeWatchedFilesParams) {
        self.everything_changed();
    }

    pub(crate) fn did_change_workspace_folders(&mut self, params: &DidChangeWorkspaceFoldersParams) {
        let gone: Vec<PathBuf> = params.event.removed.iter().filter_map(|f| path_of(&f.uri)).collect();
        self.folders.retain(|folder| !gone.contains(folder));
        self.folders.extend(params.event.added.iter().filter_map(|folder| path_of(&folder.uri)));
        self.ask_for_settings();
        self.everything_changed();
    }

    /// Settings or files have changed in a way that nobody can say less of.
    pub(super) fn everything_changed(&mut self) {
        self.host.0.forget();
        self.disk.forget(&mut self.database);
        self.world += 1;
        let wanted: Vec<bool> =
            self.documents.values().map(|document| self.wants_findings(document)).collect();
        for (document, wants_findings) in self.documents.values_mut().zip(wanted) {
            document.changed(Stale::Settings);
            document.wants_findings = wants_findings;
        }
        if !self.is_ready {
            return;
        }
        let abilities = &self.abilities;
        if abilities.pulls && abilities.refreshes_diagnostics {
            self.outbox.ask::<WorkspaceDiagnosticRefresh>((), |_| ());
        }
        if abilities.refreshes_lenses {
            self.outbox.ask::<CodeLensRefresh>((), |_| ());
        }
        if abilities.refreshes_hints {
            self.outbox.ask::<InlayHintRefreshRequest>((), |_| ());
        }
        if abilities.refreshes_tokens {
            self.outbox.ask::<SemanticTokensRefresh>((), |_| ());
        }
    }

    /// Brings the settings of a document up to date; cheap when nothing has changed.
    pub(crate) fn choose_settings(&mut self, uri: &Uri) {
        let Some(document) = self.documents.get(uri) else { return };
        let stale = document.stale;
        if stale == Stale::No {
            return;
        }
        let id = document.id;
        if !document.is_program {
            self.look_into_configuration(uri);
        } else if stale == Stale::Callees {
            let settings = document.in_force.settings.clone().unwrap_or_else(fallback_settings);
            self.database.set_settings(id, settings);
        } else {
            let Some(snapshot) = self.database.snapshot(id) else { return };
            let client = self.client_settings(document);
            let open = self.open_programs();
            let query = ProgramQuery {
                path: &document.path,
                head: &head(&snapshot),
                control: client.control.as_deref(),
                configuration: client.config_path.as_deref(),
                open: &open,
            };
            let in_force = self.host.0.in_force(&query);
            self.put_in_force(uri, in_force, stale);
        }
        if let Some(document) = self.documents.get_mut(uri) {
            document.stale = Stale::No;
            document.callees = Callees::Kept;
        }
    }

    /// Finds what is wrong with a configuration as it is in the editor.
    fn look_into_configuration(&mut self, uri: &Uri) {
        let Ok(text) = self.snapshot(uri).map(|snapshot| snapshot.text()) else { return };
        let Some(document) = self.documents.get_mut(uri) else { return };
        let mut problems = self.host.0.configuration_problems(&document.path, &text).unwrap_or_default();
        // What is wrong in the files that it extends is told there.
        problems.retain(|problem| problem.path.as_ref().is_none_or(|path| *path == document.path));
        for problem in &mut problems {
            problem.path = Some(document.path.clone());
        }
        document.in_force.problems = problems;
        self.show_problems();
    }

    fn put_in_force(&mut self, uri: &Uri, in_force: InForce, stale: Stale) {
        let Some(document) = self.documents.get_mut(uri) else { return };
        let before = &document.in_force;
        let is_same = stale == Stale::Head
            && before.settings.is_some() == in_force.settings.is_some()
            && before.choice == in_force.choice
            && before.style == in_force.style
            && before.problems == in_force.problems;
        // The settings hold the programs that are called.
        if is_same && document.callees == Callees::Kept {
            return;
        }
        self.database.set_settings(document.id, in_force.settings.clone().unwrap_or_else(fallback_settings));
        document.in_force = in_force;
        document.clock.tick();
        let status = Status::of(document);
        if self.is_ready {
            self.outbox.notify_as("gcheck/status", status);
        }
        self.show_problems();
    }
}

/// What it takes to find out the settings of programs that are not open, on another thread.
#[derive(Debug)]
pub(crate) struct Unopened {
    pub(crate) host: HostHandle,
    pub(crate) abilities: Arc<Abilities>,
    pub(crate) world: u64,
    client_settings: Vec<(Option<PathBuf>, ClientSettings)>,
    open: Arc<OpenTexts>,
}

impl Owner {
    pub(crate) fn unopened(&self) -> Unopened {
        Unopened {
            host: self.host.clone(),
            abilities: Arc::new(self.abilities.clone()),
            world: self.world,
            client_settings: self.client_settings.clone(),
            open: Arc::clone(&self.open),
        }
    }
}

impl Unopened {
    /// Are repeats of a rule shown one by one in a program?
    pub(crate) fn shown_repeats(&self, path: &Path) -> ShownRepeats {
        ClientSettings::nearest(&self.client_settings, path).shown_repeats()
    }

    /// The settings of a program on disk.
    pub(crate) fn settings(&self, path: &Path, text: &str) -> Option<Settings> {
        let client = ClientSettings::nearest(&self.client_settings, path);
        let open: Arc<dyn OpenPrograms> = Arc::<OpenTexts>::clone(&self.open);
        let query = ProgramQuery {
            path,
            head: text,
            control: client.control.as_deref(),
            configuration: client.config_path.as_deref(),
            open: &open,
        };
        self.host.0.in_force(&query).settings
    }
}

/// What `gcheck/status` says of a document.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Status {
    uri: String,
    /// The control's name.
    control: String,
    /// What it is, in words.
    title: String,
    /// `option`, `comment`, `configuration`, `detected`, `guessed`, `neighbours` or `default`.
    source: String,
    /// What made it so.
    because: Option<String>,
    /// The configuration file.
    configuration: Option<String>,
    /// Why the program is not checked.
    problem: Option<String>,
}

impl Status {
    fn of(document: &crate::documents::Document) -> Self {
        let InForce { settings, choice, configuration, problems, .. } = &document.in_force;
        Self {
            uri: document.uri.as_str().to_owned(),
            control: choice.control.clone(),
            title: gcheck_controls::load(&choice.control)
                .map(|control| control.title().to_owned())
                .unwrap_or_default(),
            source: choice.source.clone(),
            because: choice.because.clone(),
            configuration: configuration.as_ref().map(|path| path.display().to_string()),
            problem: problems.first().filter(|_| settings.is_none()).map(|problem| problem.message.clone()),
        }
    }
}

/// As much of a text as the choice of its control looks at: whole lines.
pub(super) fn head(snapshot: &gcheck_db::Snapshot) -> String {
    let line = snapshot.line_at((gcheck_program::EVIDENCE_BYTES as u32).min(snapshot.len()));
    snapshot.slice(0..snapshot.line_range(line).end).into_owned()
}
