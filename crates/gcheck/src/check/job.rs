//! Checking one file.
//!
//! Knows: how configuration, control and rules come together for a file. Must not know: other files, output.

use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::sync::Arc;

use gcheck_engine::Model;
use gcheck_program::Dialect;
use gcheck_report::{ControlChoice, ControlSource, FileReport};
use gcheck_rules::{Execution, FixKinds, Job, Mended, Scene, Selection, check, describe_all, mend};
use gcheck_syntax::SourceText;

use super::read;
use crate::args::{Assignment, CheckOptions, Global, Switch};
use crate::config::{Config, FileSettings, RuleWishes, unknown_rule};
use crate::control_choice::choose;
use crate::in_force::Controls;
use crate::programs::{ProgramFolders, Reachable};
use crate::{Problem, in_force};

/// A file that is to be checked.
#[derive(Debug)]
pub(super) struct Target {
    pub(super) path: PathBuf,
    /// As messages call it.
    pub(super) shown: String,
    pub(super) is_standard_input: bool,
    pub(super) config: Arc<Config>,
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
    controls: Controls,
}

impl<'o> Bench<'o> {
    pub(super) fn new(global: &'o Global, options: &'o CheckOptions, wishes: RuleWishes) -> Self {
        Self {
            control: global.control.as_deref(),
            wishes,
            suppressions: !options.no_suppressions,
            execution: Execution {
                fuel: options.fuel,
                block_skip: options.block_skip.map(|skip| skip == Switch::On),
            },
            fixes: (options.fix || options.diff).then_some(if options.unsafe_fixes {
                FixKinds::All
            } else {
                FixKinds::Safe
            }),
            set: &options.set,
            folders: Arc::default(),
            controls: Controls::default(),
        }
    }
}

/// What is in force for a file, and the file.
pub(super) struct Prepared {
    pub(super) source: SourceText,
    pub(super) settings: FileSettings,
    pub(super) choice: ControlChoice,
    pub(super) selection: Selection,
}

/// Reads a file and finds out what is in force for it.
pub(super) fn prepare(bench: &Bench<'_>, target: &Target) -> Result<Prepared, Problem> {
    let source = read(target)?;
    let settings = target.config.settings(&target.path);
    let from = settings.control.as_deref().map(|name| (name, settings.control_from.as_deref()));
    let choice = choose(&target.path, &source, bench.control, from)?;
    let selection =
        settings.selection(&bench.wishes).map_err(|unknown| Problem::new(unknown_rule(&unknown)))?;
    Ok(Prepared { source, settings, choice, selection })
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
    let Prepared { source, settings, choice, selection } = prepare(bench, target)?;
    let control = bench.controls.get(&choice.name, &settings.codes)?;
    let dialect = Dialect::new(&control);
    let programs = Reachable::new(Arc::clone(&bench.folders), &target.path, &settings.search);
    let model = Model::new(&control);
    let machine = in_force::machine(&settings, &control, bench.set)?;
    let scene = Scene {
        dialect: &dialect,
        machine: &machine,
        programs: &programs,
        control_is_guessed: matches!(choice.source, ControlSource::Detected | ControlSource::Default),
    };
    let run = |source: &SourceText| {
        check(&Job {
            source,
            scene,
            selection: &selection,
            suppressions: bench.suppressions,
            execution: bench.execution,
        })
    };
    let (Mended { source, outcome, count: fixed }, change) = match bench.fixes {
        None => {
            let outcome = run(&source);
            (Mended { source, outcome, count: 0 }, None)
        }
        Some(kinds) => {
            let before = source.to_bytes();
            let mended = mend(source, kinds, run);
            let after = mended.source.to_bytes();
            let change = (after != before).then_some(Change { before, after });
            (mended, change)
        }
    };
    // A program without findings is never shown: let go of its text before the last file is read.
    let text = if outcome.findings.is_empty() { SourceText::from("") } else { source };
    let report = FileReport {
        path: target.shown.clone(),
        text: Arc::new(text),
        control: choice,
        findings: outcome.findings,
        omitted: outcome.omitted,
        lines: outcome.lines,
        suppressed: outcome.suppressed,
        baseline: 0,
        fixed,
        out_of_fuel: outcome.out_of_fuel,
        assumptions: describe_all(&outcome.ledger, &model),
    };
    Ok(Checked { report, change })
}
