//! What a configuration says about one program.
//!
//! Knows: the order in which layers and overrides win. Must not know: the program's text.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use gcheck_controls::{Letter, LetterSet, UserCode};
use gcheck_diagnostics::Severity;
use gcheck_lint::{MachineFacts, Selection, UnknownRule};
use gcheck_rules::RULES;

use super::execution_facts::ExecutionFacts;
use super::layer::Facts;
use super::{Config, FormatTable, MachineTable, RulesTable};
use crate::paths;

/// The settings of one program.
#[derive(Debug, Clone, Default)]
pub struct FileSettings {
    /// The control, if the configuration chooses one.
    pub control: Option<String>,
    /// The file that chooses it; none for the command line.
    pub control_from: Option<PathBuf>,
    /// What is declared of the machine.
    pub machine: MachineFacts,
    /// What execution needs, layer by layer, the later ones over the earlier.
    pub execution: Vec<ExecutionFacts>,
    /// Codes of the shop.
    pub codes: Vec<UserCode>,
    /// Folders in which called programs are looked for, besides the file's own.
    pub search: Vec<PathBuf>,
    /// How the program is to be written.
    pub format: FormatTable,
    /// Rules tables, in the order in which they apply.
    rules: Vec<RulesTable>,
    /// Rules that are off for this file.
    ignored: Vec<String>,
}

/// Wishes of the command line.
#[derive(Debug, Clone, Default)]
pub struct RuleWishes {
    /// In place of what the configuration selects.
    pub select: Vec<String>,
    /// Off.
    pub ignore: Vec<String>,
    /// On as well.
    pub extend_select: Vec<String>,
}

impl Config {
    /// What it says about the program at `path`.
    pub fn settings(&self, path: &Path) -> FileSettings {
        let path = paths::absolute(path);
        let mut settings = FileSettings::default();
        for layer in self.layers() {
            for facts in layer.preset.iter().chain([&layer.base]) {
                settings.put(facts, layer.path.as_deref());
            }
        }
        // Overrides have priority over what holds for all files, in every layer.
        for layer in self.layers() {
            for (patterns, facts) in &layer.overrides {
                if patterns.iter().any(|p| p.fits_or_holds(&path)) {
                    settings.put(facts, layer.path.as_deref());
                }
            }
            for (pattern, selectors) in &layer.per_file_ignores {
                if pattern.fits_or_holds(&path) {
                    settings.ignored.extend(selectors.iter().cloned());
                }
            }
        }
        settings
    }
}

impl FileSettings {
    /// Everything it says, for telling settings apart. Tables on disk are left to [`Self::tables`]; folders and files are
    /// called as messages call them, so that the place of a checkout does not count.
    pub(crate) fn in_words(&self) -> String {
        // Named one by one: a field that is added must be thought of here.
        // How programs are formatted changes no finding.
        let Self { control, control_from, machine, execution, codes, search, rules, ignored, format: _ } =
            self;
        let control_from = control_from.as_deref().map(paths::shown_from_here);
        let search: Vec<String> = search.iter().map(|folder| paths::shown_from_here(folder)).collect();
        let mut words = format!("{:?}", (control, control_from, machine, codes, search, rules, ignored));
        for facts in execution {
            let ExecutionFacts { units, is_preset, machine, variables, offsets, tools, table: _ } = facts;
            // Writing to a string cannot fail.
            let _ = write!(words, "{:?}", (units, is_preset, machine, variables, offsets, tools));
        }
        words
    }

    /// Tool tables on disk that it names.
    pub(crate) fn tables(&self) -> impl Iterator<Item = &Path> {
        self.execution.iter().filter_map(|facts| facts.table.as_deref())
    }

    fn put(&mut self, facts: &Facts, from: Option<&Path>) {
        if let Some(control) = &facts.control {
            self.control = Some(control.clone());
            self.control_from = from.map(Path::to_owned);
        }
        let MachineTable { axes, .. } = &facts.machine;
        if let Some(axes) = axes {
            let letters =
                axes.value.iter().filter_map(|axis| Letter::parse(&axis.value.to_ascii_uppercase()));
            self.machine.axes = Some(letters.collect::<LetterSet>());
        }
        self.machine.settings.extend(facts.settings.iter().cloned());
        self.execution.push(facts.execution.clone());
        for code in &facts.codes {
            self.codes.retain(|c| c.number != code.number);
            self.codes.push(code.clone());
        }
        self.search.extend(facts.search.iter().cloned());
        self.rules.push(facts.rules.clone());
        self.format.put(&facts.format);
    }

    /// The rules that run on the file.
    ///
    /// # Errors
    /// [`UnknownRule`] when the command line names no rule; what a configuration names was checked when it was read.
    pub fn selection(&self, wishes: &RuleWishes) -> Result<Selection, UnknownRule> {
        let mut selection = Selection::recommended(RULES);
        for table in &self.rules {
            apply(&mut selection, table)?;
        }
        if !wishes.select.is_empty() {
            let severities = severities(&selection);
            selection = Selection::none(RULES);
            for selector in &wishes.select {
                selection.enable(selector)?;
            }
            for (id, severity) in severities {
                if selection.contains(id) {
                    selection.set_severity(id, severity)?;
                }
            }
        }
        for selector in &wishes.extend_select {
            selection.enable(selector)?;
        }
        for selector in self.ignored.iter().chain(&wishes.ignore) {
            selection.disable(selector)?;
        }
        Ok(selection)
    }
}

fn severities(selection: &Selection) -> BTreeMap<&'static str, Severity> {
    selection.rules().filter_map(|(rule, severity)| Some((rule.meta.id, severity?))).collect()
}

/// Puts one `[rules]` table over what selects before it. What names a single rule wins over what names a group.
fn apply(selection: &mut Selection, table: &RulesTable) -> Result<(), UnknownRule> {
    if let Some(select) = &table.select {
        let severities = severities(selection);
        *selection = Selection::none(RULES);
        for selector in select {
            selection.enable(&selector.value)?;
        }
        for (id, severity) in severities {
            if selection.contains(id) {
                selection.set_severity(id, severity)?;
            }
        }
    }
    for selector in &table.extend_select {
        selection.enable(&selector.value)?;
    }
    for selector in &table.ignore {
        selection.disable(&selector.value)?;
    }
    let is_rule = |name: &str| RULES.by_id(name).is_some();
    let (rules, groups): (Vec<_>, Vec<_>) =
        table.severities.iter().partition(|(name, _)| is_rule(&name.value));
    for (name, level) in groups.into_iter().chain(rules) {
        match level.severity() {
            Some(severity) => selection.set_severity(&name.value, severity)?,
            None => selection.disable(&name.value)?,
        }
    }
    Ok(())
}
