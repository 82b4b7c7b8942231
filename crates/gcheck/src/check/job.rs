//! Checking one file.
//!
//! Knows: how configuration, control and rules come together for a file. Must not know: other files, output.

use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::sync::Arc;

use gcheck_diagnostics::FixKinds;
use gcheck_engine::Model;
use gcheck_lint::{Environment, Execution, Fixed, Job, Selection, check, describe_all, fix_all};
use gcheck_program::Dialect;
use gcheck_report::FileReport;
use gcheck_syntax::SourceText;

use super::cache::{Cache, Entry, Key, Questions, Run, Verdict, answers_hold};
use crate::args::{Assignment, CheckOptions, Global, Switch};
use crate::config::{Config, FileSettings, RuleWishes, unknown_rule};
use crate::control_choice::{Chosen, choose};
use crate::in_force::Controls;
use crate::neighbours::Neighbours;
use crate::programs::{ProgramFolders, Reachable};
use crate::{Problem, in_force, reading};

/// A file that is to be checked.
#[derive(Debug)]
pub(super) struct Target {
    pub(super) path: PathBuf,
    /// As messages call it.
    pub(super) shown: String,
    pub(super) is_standard_input: bool,
    pub(super) config: Arc<Config>,
}

/// Reads a target.
fn read(target: &Target) -> Result<SourceText, Problem> {
    if target.is_standard_input { reading::standard_input(&target.path) } else { reading::file(&target.path) }
}

/// What all files of a run share.
pub(super) struct Bench<'o> {
    pub(super) control: Option<&'o str>,
    pub(super) wishes: RuleWishes,
    suppressions: bool,
    execution: Execution,
    fixes: Option<FixKinds>,
    set: &'o [Assignment],
    folders: Arc<ProgramFolders>,
    neighbours: Neighbours,
    pub(super) controls: Controls,
    /// Results of earlier runs, and what this run is called in them.
    cache: Option<(Cache, Run)>,
}

impl<'o> Bench<'o> {
    pub(super) fn new(
        global: &'o Global,
        options: &'o CheckOptions,
        wishes: RuleWishes,
        cache: Option<Cache>,
    ) -> Self {
        let control = global.control.as_deref();
        let suppressions = !options.no_suppressions;
        let execution =
            Execution { fuel: options.fuel, block_skip: options.block_skip.map(|skip| skip == Switch::On) };
        let run = Run::new(control, &wishes, suppressions, execution, &options.set);
        Self {
            control,
            wishes,
            suppressions,
            execution,
            fixes: (options.fix || options.diff).then_some(if options.unsafe_fixes {
                FixKinds::All
            } else {
                FixKinds::Safe
            }),
            set: &options.set,
            folders: Arc::default(),
            neighbours: Neighbours::default(),
            controls: Controls::default(),
            cache: cache.map(|cache| (cache, run)),
        }
    }

    /// To be called when all files are checked.
    pub(super) fn end(&self) {
        if let Some((cache, _)) = &self.cache {
            cache.tidy();
        }
    }
}

/// What is in force for a file, and the file.
pub(super) struct Prepared {
    pub(super) source: SourceText,
    pub(super) settings: FileSettings,
    pub(super) chosen: Chosen,
    pub(super) selection: Selection,
}

/// Reads a file and finds out what is in force for it.
pub(super) fn prepare(bench: &Bench<'_>, target: &Target) -> Result<Prepared, Problem> {
    decide(bench, target, read(target)?, target.config.settings(&target.path))
}

fn decide(
    bench: &Bench<'_>,
    target: &Target,
    source: SourceText,
    settings: FileSettings,
) -> Result<Prepared, Problem> {
    let chosen = chosen(bench, target, &source, &settings)?;
    let mut selection =
        settings.selection(&bench.wishes).map_err(|unknown| Problem::new(unknown_rule(&unknown)))?;
    chosen.narrow(&mut selection);
    let control = bench.controls.get(&chosen.choice.name, &settings.codes)?;
    target.config.hold_to(&target.path, &control)?;
    Ok(Prepared { source, settings, chosen, selection })
}

fn chosen(
    bench: &Bench<'_>,
    target: &Target,
    source: &SourceText,
    settings: &FileSettings,
) -> Result<Chosen, Problem> {
    let from = settings.control.as_deref().map(|name| (name, settings.control_from.as_deref()));
    choose(&target.path, source, bench.control, from, &bench.neighbours)
}

/// A file that was checked.
pub(super) struct Checked {
    pub(super) report: FileReport,
    /// The program before and after its fixes, if there were any.
    pub(super) change: Option<Change>,
}

/// A program before and after its fixes.
pub(super) struct Change {
    pub(super) before: Vec<u8>,
    pub(super) after: Vec<u8>,
}

/// Checks a file; a panic is contained, so that the other files are still checked.
pub(super) fn guarded(bench: &Bench<'_>, target: &Target) -> Result<Checked, Problem> {
    panic::catch_unwind(AssertUnwindSafe(|| check_file(bench, target)))
        .unwrap_or_else(|payload| Err(Problem::own_mistake(payload.as_ref()).in_file(&target.path)))
}

fn check_file(bench: &Bench<'_>, target: &Target) -> Result<Checked, Problem> {
    let source = read(target)?;
    let settings = target.config.settings(&target.path);
    // What is fixed is checked over and over, and what comes in by a pipe has no place.
    let cache = bench.cache.as_ref().filter(|_| bench.fixes.is_none() && !target.is_standard_input);
    let slot = cache.and_then(|(cache, run)| Some((cache, run.key(&target.shown, &source, &settings)?)));
    if let Some(verdict) =
        slot.and_then(|(cache, key)| known(bench, target, &source, &settings, (cache, key)))
    {
        return Ok(Checked { report: report(target, source, verdict, 0), change: None });
    }
    let Prepared { source, settings, chosen, selection } = decide(bench, target, source, settings)?;
    let control = bench.controls.get(&chosen.choice.name, &settings.codes)?;
    let dialect = Dialect::new(&control);
    let programs = Reachable::new(Arc::clone(&bench.folders), &target.path, &settings.search);
    let questions = Questions::new(&programs);
    let model = Model::new(&control);
    let machine = in_force::machine(&settings, &control, bench.set)?;
    let environment = Environment {
        dialect: &dialect,
        machine: &machine,
        programs: &questions,
        control_basis: chosen.basis(),
        unsupported: chosen.unsupported,
    };
    let run = |source: &SourceText| {
        check(&Job {
            source,
            environment,
            selection: &selection,
            suppressions: bench.suppressions,
            execution: bench.execution,
        })
    };
    let (Fixed { source, outcome, count: fixed }, change) = match bench.fixes {
        None => {
            let outcome = run(&source);
            (Fixed { source, outcome, count: 0 }, None)
        }
        Some(kinds) => {
            let before = source.to_bytes();
            let fixed = fix_all(source, kinds, run);
            let after = fixed.source.to_bytes();
            let change = (after != before).then_some(Change { before, after });
            (fixed, change)
        }
    };
    let verdict = Verdict {
        control: chosen.choice,
        findings: outcome.findings,
        omitted: outcome.omitted,
        failed_rules: outcome.failed.iter().map(|rule| rule.id).collect(),
        lines: outcome.lines,
        suppressed: outcome.suppressed,
        out_of_fuel: outcome.out_of_fuel,
        assumptions: describe_all(&outcome.assumptions, &model),
    };
    // What a rule failed to say is not known the next time either.
    if let Some((cache, key)) = slot.filter(|_| verdict.failed_rules.is_empty()) {
        cache.store(key, &Entry::new(questions.into_asked(), chosen.depends_on_neighbours, &verdict));
    }
    Ok(Checked { report: report(target, source, verdict, fixed), change })
}

/// The verdict of an earlier run, if it would be found again.
fn known(
    bench: &Bench<'_>,
    target: &Target,
    source: &SourceText,
    settings: &FileSettings,
    (cache, key): (&Cache, Key),
) -> Option<Verdict> {
    let entry = cache.load(key)?;
    let programs = Reachable::new(Arc::clone(&bench.folders), &target.path, &settings.search);
    let verdict = entry.verdict().filter(|_| answers_hold(&entry.asked, &programs))?;
    let choose = || chosen(bench, target, source, settings);
    let is_chosen_again =
        !entry.depends_on_neighbours || choose().is_ok_and(|chosen| chosen.choice == verdict.control);
    is_chosen_again.then_some(verdict)
}

fn report(target: &Target, source: SourceText, verdict: Verdict, fixed: usize) -> FileReport {
    // A program without findings is never shown: let go of its text before the last file is read.
    let text = if verdict.findings.is_empty() { SourceText::from("") } else { source };
    FileReport {
        path: target.shown.clone(),
        text: Arc::new(text),
        control: verdict.control,
        findings: verdict.findings,
        omitted: verdict.omitted,
        lines: verdict.lines,
        suppressed: verdict.suppressed,
        baseline: 0,
        fixed,
        out_of_fuel: verdict.out_of_fuel,
        failed_rules: verdict.failed_rules,
        assumptions: verdict.assumptions,
    }
}
