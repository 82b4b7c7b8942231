//! `gcheck lsp`: the language server's surroundings, which are those of `gcheck check`.
//!
//! Knows: configuration, files, folders. Must not know: the protocol.

use std::collections::HashMap;
use std::fs::Metadata;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::UNIX_EPOCH;
use std::{fs, io};

use gcheck_controls::Control;
use gcheck_db::Settings;
use gcheck_lint::{Execution, RuleTable};
use gcheck_report::ControlChoice;
use gcheck_server::{
    Choice, ConfigurationHover, ConfigurationOffer, ConfigurationProblem, Configured, ConfiguredPlace, Host,
    InForce, ProgramFile, ProgramQuery, ProgramText, serve,
};
use gcheck_syntax::SourceText;

use crate::args::{FUEL, Global};
use crate::config::{Config, Configs, FILE_NAMES, RuleWishes, unknown_rule, validate_control};
use crate::config_help;
use crate::control_choice::choose;
use crate::discovery::{self, EXTENSIONS, is_program_name};
use crate::execution::{line_of_tool, text_of_tool_table};
use crate::in_force::{self, Controls};
use crate::neighbours::Neighbours;
use crate::programs::{ProgramFolders, Reachable};
use crate::{Problem, paths, reading};

/// Files of one folder that are told of.
const MOST_FILES: usize = 5_000;

/// A larger file is not a configuration.
const MOST_CONFIGURATION: u64 = 1 << 20;

/// Mistakes of one configuration that are shown.
const MOST_PROBLEMS: usize = 20;

/// Runs the server until the client ends it, or is gone.
pub(crate) fn run(global: &Global) -> Result<u8, Problem> {
    if let Some(name) = &global.control {
        validate_control(name).map_err(Problem::new)?;
    }
    // A mistake in the command line is reported where it was typed.
    Configs::new(&global.config, global.isolated)?;
    let host = Surroundings {
        control: global.control.clone(),
        config: global.config.clone(),
        isolated: global.isolated,
        configs: Mutex::default(),
        folders: Mutex::default(),
        neighbours: Mutex::default(),
        controls: Controls::default(),
    };
    serve(Arc::new(host), io::stdin(), io::stdout())
        .map(gcheck_server::Ending::code)
        .map_err(|error| Problem::new(format!("cannot start threads: {error}")))
}

/// What the server is told of files and configuration. Everything read from disk is kept until it is to be forgotten.
struct Surroundings {
    /// From the command line.
    control: Option<String>,
    config: Vec<String>,
    isolated: bool,
    /// By the configuration that the editor's user has chosen.
    configs: Mutex<HashMap<Option<PathBuf>, Result<Configs, Problem>>>,
    folders: Mutex<Arc<ProgramFolders>>,
    neighbours: Mutex<Arc<Neighbours>>,
    controls: Controls,
}

impl Surroundings {
    /// The configuration of a program.
    fn config(&self, program: &ProgramQuery<'_>) -> Result<Arc<Config>, Problem> {
        let chosen = program.configuration.map(Path::to_owned);
        self.with_configs(chosen, |configs| configs.of_file(program.path))
    }

    fn with_configs<T>(
        &self,
        chosen: Option<PathBuf>,
        work: impl FnOnce(&mut Configs) -> Result<T, Problem>,
    ) -> Result<T, Problem> {
        let mut all = self.configs.lock().unwrap_or_else(PoisonError::into_inner);
        let configs = all.entry(chosen).or_insert_with_key(|chosen| match chosen {
            // The editor's choice has priority over the command line's.
            Some(path) => Configs::new(&[path.to_string_lossy().into_owned()], false),
            None => Configs::new(&self.config, self.isolated),
        });
        configs.as_mut().map_err(|problem| problem.clone()).and_then(work)
    }

    /// The files of a program's configuration, those that win first; of one that cannot be read the nearest file alone.
    fn configuration_files(&self, program: &ProgramQuery<'_>) -> Vec<PathBuf> {
        match self.config(program) {
            Ok(config) => config.layers().iter().rev().filter_map(|layer| layer.path.clone()).collect(),
            Err(_) => {
                let chosen = program.configuration.map(Path::to_owned);
                let folders = program.path.ancestors().skip(1);
                let mut files = folders.flat_map(|folder| FILE_NAMES.map(|name| folder.join(name)));
                chosen.or_else(|| files.find(|file| file.is_file())).into_iter().collect()
            }
        }
    }

    /// The line of a tool in the table that a program's configuration names.
    fn line_of_table(
        &self,
        program: &ProgramQuery<'_>,
        tool: u32,
        open: &dyn Fn(&Path) -> Option<String>,
    ) -> Option<ConfiguredPlace> {
        let settings = self.config(program).ok()?.settings(program.path);
        let path = settings.execution.iter().rev().find_map(|layer| layer.table.clone())?;
        let text = open(&path).or_else(|| text_of_tool_table(&path))?;
        let key = line_of_tool(&path, &text, tool)?;
        Some(ConfiguredPlace { path, text: Arc::from(text), key })
    }

    fn folders(&self) -> Arc<ProgramFolders> {
        Arc::clone(&self.folders.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn neighbours(&self) -> Arc<Neighbours> {
        Arc::clone(&self.neighbours.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// What is in force, filled in as far as it gets.
    fn fill(&self, program: &ProgramQuery<'_>, in_force: &mut InForce) -> Result<(), Problem> {
        let config = self.config(program)?;
        in_force.configuration = config.path().map(Path::to_owned);
        let settings = config.settings(program.path);
        let programs = Reachable::new(self.folders(), program.path, &settings.search);
        let programs = programs.with_open(Arc::clone(program.open));
        in_force.folders = programs.folders().to_vec();
        let from = settings.control.as_deref().map(|name| (name, settings.control_from.as_deref()));
        let option = program.control.or(self.control.as_deref());
        let chosen = choose(program.path, &SourceText::from(program.head), option, from, &self.neighbours())?;
        let ControlChoice { name, source, because } = chosen.choice.clone();
        in_force.choice =
            Choice { control: name.clone(), source: format!("{source:?}").to_lowercase(), because };
        let control = self.controls.get(&name, &settings.codes)?;
        in_force.style = Some(settings.format.style(&control));
        config.hold_to(program.path, &control)?;
        let machine = in_force::machine(&settings, &control, &[])?;
        let mut selection = settings
            .selection(&RuleWishes::default())
            .map_err(|unknown| Problem::new(unknown_rule(&unknown)))?;
        chosen.narrow(&mut selection);
        in_force.settings = Some(Settings {
            control,
            control_basis: chosen.basis(),
            unsupported: chosen.unsupported,
            machine: Arc::new(machine),
            selection: Arc::new(selection),
            suppressions: true,
            execution: Execution { fuel: FUEL, block_skip: None },
            programs: Arc::new(programs),
        });
        Ok(())
    }
}

impl Host for Surroundings {
    fn in_force(&self, program: &ProgramQuery<'_>) -> InForce {
        let mut in_force = InForce {
            settings: None,
            choice: Choice::default(),
            style: None,
            folders: program.path.parent().map(Path::to_owned).into_iter().collect(),
            configuration: None,
            problems: Vec::new(),
        };
        if let Err(problem) = self.fill(program, &mut in_force) {
            in_force.problems.push(shown(&problem));
        }
        in_force
    }

    fn configuration_problems(&self, path: &Path, text: &str) -> Option<Vec<ConfigurationProblem>> {
        if !is_configuration(path) {
            return None;
        }
        // Each mistake is blanked with its line, so that the next one is found at its own place.
        let mut lines: Vec<String> = text.split_inclusive('\n').map(str::to_owned).collect();
        let mut problems = Vec::new();
        while problems.len() < MOST_PROBLEMS {
            let rest = lines.concat();
            let Err(problem) = crate::config::check_text(path, &rest) else { break };
            let found = shown(&problem);
            // One without a place of its own stays, whatever is blanked.
            if problems.iter().any(|known: &ConfigurationProblem| known.message == found.message) {
                break;
            }
            let Some(line) = lines.get_mut(found.line as usize) else { break };
            let is_table = line.trim_start().starts_with('[');
            problems.push(ConfigurationProblem { path: Some(path.to_owned()), ..found });
            let ends = if line.ends_with('\n') { "\n" } else { "" };
            if line.trim().is_empty() || is_table {
                break;
            }
            *line = format!("{}{ends}", " ".repeat(line.trim_end_matches(['\r', '\n']).len()));
            // The rest of a value over several lines is not a mistake of its own.
            if toml::from_str::<toml::Table>(&lines.concat()).is_err() {
                break;
            }
        }
        Some(problems)
    }

    fn configuration_hover(&self, path: &Path, text: &str, offset: usize) -> Option<ConfigurationHover> {
        if is_configuration(path) { config_help::hover(text, offset) } else { None }
    }

    fn configuration_completion(&self, path: &Path, text: &str, offset: usize) -> Vec<ConfigurationOffer> {
        if is_configuration(path) { config_help::completion(text, offset) } else { Vec::new() }
    }

    fn configured(
        &self,
        program: &ProgramQuery<'_>,
        control: &Control,
        named: Configured,
        open: &dyn Fn(&Path) -> Option<String>,
    ) -> Vec<ConfiguredPlace> {
        let mut found = Vec::new();
        for path in self.configuration_files(program) {
            let on_disk = || reading::regular(&path, MOST_CONFIGURATION).ok();
            let text = open(&path).or_else(|| String::from_utf8(on_disk()?).ok());
            let Some(text) = text.map(Arc::<str>::from) else { continue };
            let folder = path.parent().unwrap_or(&path);
            let keys = config_help::entries(&text, folder, program.path, control, named);
            found.extend(keys.into_iter().map(|key| ConfiguredPlace {
                path: path.clone(),
                text: Arc::clone(&text),
                key,
            }));
        }
        if let Configured::Tool(tool) = named {
            found.extend(self.line_of_table(program, tool, open));
        }
        found
    }

    fn programs_in(&self, folder: &Path) -> Vec<ProgramFile> {
        let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
        let programs = entries.flatten().map(|entry| entry.path()).filter(|path| is_program_name(path));
        let mut programs: Vec<PathBuf> = programs.collect();
        programs.sort();
        programs.into_iter().take(MOST_FILES).filter_map(program_file).collect()
    }

    fn programs_below(&self, folder: &Path) -> Vec<ProgramFile> {
        let given = [folder.to_owned()];
        let found = self.with_configs(None, |configs| Ok(discovery::find(&given, configs)));
        let files = found.map(|found| found.files).unwrap_or_default();
        files.into_iter().take(MOST_FILES).filter_map(program_file).collect()
    }

    fn read(&self, path: &Path) -> Option<ProgramText> {
        let file = reading::file(path).ok()?;
        Some(ProgramText { text: file.text().to_owned(), replaced: file.replaced().to_vec() })
    }

    fn rules(&self) -> RuleTable {
        gcheck_rules::RULES
    }

    fn forget(&self) {
        self.configs.lock().unwrap_or_else(PoisonError::into_inner).clear();
        *self.folders.lock().unwrap_or_else(PoisonError::into_inner) = Arc::default();
        *self.neighbours.lock().unwrap_or_else(PoisonError::into_inner) = Arc::default();
    }

    fn watched(&self) -> Vec<String> {
        vec![
            format!("**/{{{}}}", FILE_NAMES.join(",")),
            format!("**/*.{{{}}}", EXTENSIONS.map(in_any_case).join(",")),
            "**/[oO][0-9]*".to_owned(),
        ]
    }
}

/// A pattern for a name in small letters or capitals: programs come as `PART.NC` as well.
fn in_any_case(name: &str) -> String {
    let letter = |c: char| {
        if c.is_ascii_alphabetic() {
            format!("[{}{}]", c.to_ascii_lowercase(), c.to_ascii_uppercase())
        } else {
            c.to_string()
        }
    };
    name.chars().map(letter).collect()
}

/// A file on disk; `None` when it is none, or is gone.
fn program_file(path: PathBuf) -> Option<ProgramFile> {
    let data = fs::metadata(&path).ok().filter(Metadata::is_file)?;
    let changed = data.modified().ok().and_then(|time| time.duration_since(UNIX_EPOCH).ok());
    let stamp = changed.map_or(0, |time| time.as_nanos() as u64) ^ data.len().rotate_left(48);
    Some(ProgramFile { path, size: data.len(), stamp })
}

/// Is a file a configuration, by its name?
fn is_configuration(path: &Path) -> bool {
    path.file_name().and_then(|name| name.to_str()).is_some_and(|name| FILE_NAMES.contains(&name))
}

/// A problem as the server shows it.
fn shown(problem: &Problem) -> ConfigurationProblem {
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    let (name, line, column, length) = problem.place().unwrap_or(("", 1, 1, 0));
    ConfigurationProblem {
        path: (!name.is_empty()).then(|| paths::absolute(Path::new(name))),
        line: count(line - 1),
        column: count(column - 1),
        length: count(length),
        message: problem.advice(),
    }
}
