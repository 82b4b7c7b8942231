//! One round of `gcheck check`: from paths to a report and an exit code.
//!
//! Knows: the order of the work, what runs in parallel, what ends in which exit code. Must not know: rules or formats.

use std::collections::BTreeSet;
use std::env;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use gcheck_diagnostics::{RuleMeta, Severity};
use gcheck_lint::Selection;
use gcheck_report::{FileReport, Format, PathBase, Report, StaleEntry, Summary};
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;
use rayon::prelude::*;

use crate::args::{CheckOptions, FailOn, Global, OutputFile};
use crate::config::{Config, Configs, RuleWishes, unknown_rule, validate_control};
use crate::console::{finish, say};
use crate::discovery::{self, Found};
use crate::progress::Progress;
use crate::{Problem, output, path_base, paths, threads};

use super::cache::Cache;
use super::fixed;
use super::job::{self, Bench, Change, Checked, Target};
use super::known::KnownFindings;
use super::next_steps;
use super::settings_page;

/// Files that are checked together; what was found in them is put away before the next ones are read.
const WAVE: usize = 256;
/// Findings of a run that are kept; the rest are counted by file and rule. So many take about 100 MB.
const MAX_KEPT: usize = 100_000;

/// The command line, looked through for mistakes.
pub(super) struct Check<'o> {
    pub(super) global: &'o Global,
    pub(super) options: &'o CheckOptions,
    wishes: RuleWishes,
    outputs: Outputs<'o>,
    /// The folder of `--path-base`.
    path_base: Option<PathBase>,
}

/// What a round read: when any of it changes, the next round may find something else.
#[derive(Debug, Default)]
pub(super) struct Looked {
    /// Programs.
    pub(super) programs: Vec<PathBuf>,
    /// Their configurations.
    pub(super) configs: Vec<Arc<Config>>,
}

impl<'o> Check<'o> {
    /// # Errors
    /// When the options contradict each other or name what does not exist.
    pub(super) fn new(global: &'o Global, options: &'o CheckOptions) -> Result<Self, Problem> {
        if let Some(name) = &global.control {
            validate_control(name).map_err(Problem::new)?;
        }
        let wishes = RuleWishes {
            select: options.select.clone(),
            ignore: options.ignore.clone(),
            extend_select: options.extend_select.clone(),
        };
        for selector in wishes.select.iter().chain(&wishes.ignore).chain(&wishes.extend_select) {
            Selection::none(RULES)
                .enable(selector)
                .map_err(|unknown| Problem::new(unknown_rule(&unknown)))?;
        }
        if options.paths.iter().any(|path| paths::is_standard_input(path)) {
            if options.fix {
                return Err(
                    Problem::new("standard input cannot be fixed").help("`--diff` shows what would change")
                );
            }
            if options.watch {
                return Err(Problem::new("standard input cannot be watched").help("name files or folders"));
            }
        }
        let path_base = options.path_base.as_deref().map(path_base::of_option).transpose()?;
        Ok(Self { global, options, wishes, outputs: Outputs::new(options)?, path_base })
    }

    /// Checks everything once.
    pub(super) fn round(&self, looked: &mut Looked) -> Result<u8, Problem> {
        let Self { global, options, .. } = self;
        let known = match &options.baseline {
            Some(path) => Some(KnownFindings::read(path, options.update_baseline)?),
            None => None,
        };
        let mut configs = Configs::new(&global.config, global.isolated)?;
        let (targets, mut problems, passed_over) = targets(options, &mut configs);
        looked.programs = targets.iter().map(|target| paths::absolute(&target.path)).collect();
        looked.configs = configs.read();
        if options.show_files {
            let names: String = targets.iter().map(|target| format!("{}\n", target.shown)).collect();
            output::print(&names)?;
            return Ok(finish(&problems, 0));
        }
        self.outputs.refuse_inputs(&looked.programs, &looked.configs, options.baseline.as_deref())?;
        let is_cached = !(options.no_cache || options.show_settings);
        let cache = if is_cached { Cache::open(cache_dir(options).as_deref())? } else { None };
        let bench = Bench::new(global, options, self.wishes.clone(), cache);
        if options.show_settings {
            output::print(&settings_page::page(&bench, &targets, &mut problems))?;
            return Ok(finish(&problems, 0));
        }
        let mut harvest = Harvest::default();
        check_all(&bench, &targets, self, known.as_ref(), &mut harvest)?;
        bench.end();
        let Harvest { reports, stale, problems: of_files, differences, .. } = harvest;
        problems.extend(of_files);
        if options.diff {
            return Ok(differences.finish(global, &problems));
        }
        if let Some(known) = known {
            let remark = known.finish(&reports, stale)?;
            // A run of some rules says nothing about the entries of others.
            let all_rules = options.select.is_empty() && options.ignore.is_empty();
            if let Some(remark) = remark.filter(|_| (all_rules || options.update_baseline) && !global.quiet) {
                say(&remark);
            }
        }
        let report = Report::new(reports)
            .with_skipped(problems.iter().map(Problem::as_skipped).collect())
            .with_rules(RULES.iter().map(|rule| rule.meta));
        let fails_from = fails_from(&report.summary(), options);
        let base = match &self.path_base {
            Some(base) => base.clone(),
            None => path_base::of_files(report.paths().chain(report.skipped_paths()).map(Path::new)),
        };
        let report = report.with_path_base(base).failing(fails_from, options.fail_on_incomplete);
        let report = if options.show_all { report } else { report.folded() };
        write(global, options, &self.outputs, &report, &problems)?;
        if !global.quiet {
            say(&passed_over);
        }
        let is_incomplete = options.fail_on_incomplete && report.is_incomplete();
        Ok(finish(&problems, u8::from(is_incomplete || fails(&report.summary(), options))))
    }
}

/// The folder for results, if somebody names one. A variable that is empty names none: CI servers leave them so.
fn cache_dir(options: &CheckOptions) -> Option<PathBuf> {
    let named = || env::var_os("GCHECK_CACHE").filter(|name| !name.is_empty()).map(PathBuf::from);
    options.cache_dir.clone().or_else(named)
}

/// What came out of the files so far, in their order.
#[derive(Default)]
struct Harvest {
    reports: Vec<FileReport>,
    /// Findings in the reports.
    kept: usize,
    /// Entries of the baseline that found nothing.
    stale: Vec<StaleEntry>,
    problems: Vec<Problem>,
    differences: Differences,
}

/// What is to be checked, each file with its configuration; and what to say of files that are not.
fn targets(options: &CheckOptions, configs: &mut Configs) -> (Vec<Target>, Vec<Problem>, String) {
    let (standard_input, given): (Vec<PathBuf>, Vec<PathBuf>) =
        options.paths.iter().cloned().partition(|path| paths::is_standard_input(path));
    let found = discovery::find(&given, configs);
    let passed_over = found.remark();
    let Found { files, mut problems, .. } = found;
    let mut targets = Vec::with_capacity(files.len() + 1);
    let mut add = |path: PathBuf, is_standard_input| match configs.of_file(&path) {
        Ok(config) => targets.push(Target { shown: paths::shown(&path), path, is_standard_input, config }),
        Err(problem) => problems.push(problem),
    };
    if !standard_input.is_empty() {
        add(options.stdin_filename.clone().unwrap_or_else(|| PathBuf::from("stdin")), true);
    }
    for file in files {
        add(file, false);
    }
    (targets, problems, passed_over)
}

/// Checks the files, several at a time; what comes out is in the order of the files.
fn check_all(
    bench: &Bench<'_>,
    targets: &[Target],
    command: &Check<'_>,
    known: Option<&KnownFindings>,
    harvest: &mut Harvest,
) -> Result<(), Problem> {
    let progress = Progress::new(targets.len(), command.global.quiet);
    let pool = match command.options.jobs {
        Some(jobs) if targets.len() > 1 => Some(threads::pool(jobs)?),
        _ => None,
    };
    for wave in targets.chunks(WAVE) {
        // No file of the wave can have more room than there is before the first; so what is kept does not depend on which
        // of them is done first.
        let room = MAX_KEPT.saturating_sub(harvest.kept);
        let check = |target| {
            progress.counting(|| {
                job::guarded(bench, target).map(|mut checked| {
                    let stale = known.map(|known| known.apply(&mut checked.report)).unwrap_or_default();
                    keep(&mut checked.report, room);
                    (checked, stale)
                })
            })
        };
        let work = || -> Vec<_> { wave.par_iter().map(check).collect() };
        let results: Vec<_> = match &pool {
            // Threads cost more than one file takes.
            _ if targets.len() == 1 => wave.iter().map(check).collect(),
            None => {
                threads::prepare();
                work()
            }
            Some(pool) => pool.install(work),
        };
        for (target, result) in wave.iter().zip(results) {
            match result {
                Ok((checked, stale)) => {
                    harvest.stale.extend(stale);
                    harvest.add(target, checked, command.options)?;
                }
                Err(problem) => harvest.problems.push(problem),
            }
        }
    }
    progress.end();
    Ok(())
}

impl Harvest {
    /// Takes what came out of a file: fixes it or shows how it would be, and keeps its report. One that cannot be
    /// written is a problem, and has no other findings: the last ones belong to a text that is on no disk.
    fn add(&mut self, target: &Target, checked: Checked, options: &CheckOptions) -> Result<(), Problem> {
        let Checked { mut report, change } = checked;
        if options.diff {
            return change.map_or(Ok(()), |change| self.differences.show(&report, &change));
        }
        if let Some(change) = change
            && let Err(problem) = discovery::refuse_to_leave(&target.path, &options.paths)
                .and_then(|()| fixed::write(&target.path, &change))
        {
            self.problems.push(problem);
            return Ok(());
        }
        keep(&mut report, MAX_KEPT.saturating_sub(self.kept));
        self.kept += report.findings.len();
        self.reports.push(report);
        Ok(())
    }
}

/// Keeps the first findings of a report; the others are counted, as those beyond the limit of a file are.
fn keep(report: &mut FileReport, most: usize) {
    if report.findings.len() <= most {
        return;
    }
    for finding in report.findings.drain(most..) {
        let same = |(rule, severity, _): &&mut (&RuleMeta, _, usize)| {
            rule.id == finding.rule.id && *severity == finding.severity
        };
        match report.omitted.iter_mut().find(same) {
            Some((.., count)) => *count += 1,
            None => report.omitted.push((finding.rule, finding.severity, 1)),
        }
    }
    if report.findings.is_empty() {
        report.text = Arc::new(SourceText::from(""));
    }
}

/// What `--fix` would change; the exit code says whether it would change anything.
#[derive(Default)]
struct Differences {
    findings: usize,
    files: usize,
}

impl Differences {
    fn show(&mut self, report: &FileReport, change: &Change) -> Result<(), Problem> {
        self.findings += report.fixed;
        self.files += 1;
        output::print(&fixed::difference(&report.path, change)).map(|_| ())
    }

    fn finish(&self, global: &Global, problems: &[Problem]) -> u8 {
        if !global.quiet {
            let words = |n: usize, one: &str, many: &str| format!("{n} {}", if n == 1 { one } else { many });
            say(&format!(
                "{} would be fixed in {}",
                words(self.findings, "finding", "findings"),
                words(self.files, "file", "files")
            ));
        }
        finish(problems, u8::from(self.files > 0))
    }
}

fn fails(summary: &Summary, options: &CheckOptions) -> bool {
    let at_or_above = match fails_from(summary, options) {
        None => 0,
        Some(Severity::Error) => summary.errors,
        Some(Severity::Warning) => summary.errors + summary.warnings,
        Some(Severity::Info | Severity::Hint) => summary.errors + summary.warnings + summary.infos,
    };
    at_or_above > 0
}

/// The severity from which on findings make the run fail; more warnings than allowed make every warning one that does.
fn fails_from(summary: &Summary, options: &CheckOptions) -> Option<Severity> {
    let from = match options.fail_on {
        FailOn::Error => Some(Severity::Error),
        FailOn::Warning => Some(Severity::Warning),
        FailOn::Info => Some(Severity::Info),
        FailOn::Never => None,
    };
    let is_over = options.max_warnings.is_some_and(|most| summary.warnings > most);
    if is_over { Some(from.map_or(Severity::Warning, |from| from.at_most(Severity::Warning))) } else { from }
}

/// Where findings go.
struct Outputs<'o> {
    /// The file that takes the place of standard output.
    main: Option<&'o Path>,
    /// Files with a format of their own.
    besides: Vec<(Format, &'o Path)>,
}

impl<'o> Outputs<'o> {
    /// Sorts the files of the command line.
    ///
    /// # Errors
    /// When two outputs would go to one file.
    fn new(options: &'o CheckOptions) -> Result<Self, Problem> {
        let mut outputs = Self { main: None, besides: Vec::new() };
        let mut taken = BTreeSet::new();
        for OutputFile { format, path } in &options.output_file {
            if !taken.insert(real(path)) {
                return Err(Problem::with_file(path, "two outputs cannot go to one file"));
            }
            match format {
                Some(format) => outputs.besides.push((*format, path)),
                None if outputs.main.is_none() => outputs.main = Some(path),
                None => {
                    return Err(Problem::with_file(path, "is a second file for the same output")
                        .help("give it a format of its own: `-o sarif=FILE`"));
                }
            }
        }
        Ok(outputs)
    }

    /// # Errors
    /// When an output would replace something that the run reads.
    fn refuse_inputs(
        &self,
        programs: &[PathBuf],
        configs: &[Arc<Config>],
        baseline: Option<&Path>,
    ) -> Result<(), Problem> {
        let outputs = self.main.into_iter().chain(self.besides.iter().map(|(_, path)| *path));
        // What is not there yet replaces nothing; what is not a file (a pipe, a terminal) is not replaced.
        for path in outputs.filter(|path| path.is_file()) {
            let output = real(path);
            let files = configs.iter().flat_map(|config| config.files()).chain(baseline);
            if programs.iter().map(PathBuf::as_path).chain(files).any(|read| real(read) == output) {
                return Err(Problem::with_file(path, "is read in this run, and findings would replace it")
                    .help("name another file for them"));
            }
        }
        Ok(())
    }
}

/// The file that a path leads to, links followed where they lead somewhere.
fn real(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| paths::absolute(path))
}

/// Findings to standard output or files; what is for people to read besides, where it does not disturb.
fn write(
    global: &Global,
    options: &CheckOptions,
    outputs: &Outputs<'_>,
    report: &Report,
    problems: &[Problem],
) -> Result<(), Problem> {
    let format = options.output_format;
    if format.is_text() && !global.quiet {
        say(&gcheck_report::control_lines(report).join("\n"));
    }
    let to_file = |format, path| {
        output::to_file(path, |out| gcheck_report::write(report, format, gcheck_report::Colour::Plain, out))
    };
    outputs.besides.iter().try_for_each(|(format, path)| to_file(*format, path))?;
    let counts = counts(options, report);
    let mut closing = String::new();
    match (counts, outputs.main) {
        // A program that reads a format gets it whole.
        (Some(counts), main) if format.is_for_people() => match main {
            Some(path) => output::to_file(path, |out| out.write_all(counts.as_bytes()))?,
            None => output::to_stdout(|out| out.write_all(counts.as_bytes()))?,
        },
        (counts, main) => {
            match main {
                Some(path) => to_file(format, path)?,
                None => {
                    let colour = output::colour(global.color);
                    output::to_stdout(|out| gcheck_report::write(report, format, colour, out))?;
                }
            }
            closing.push_str(&counts.unwrap_or_default());
        }
    }
    // Where programs could not be read, it is the problems that say why there are none.
    if !global.quiet && (report.summary().files > 0 || problems.is_empty()) {
        closing.push_str(&closing_line(report));
        if format.is_for_people() {
            closing.push_str(&next_steps::after(report, options));
        }
    }
    // Only the format for people has room for a closing line; a parser reads the others.
    if format == Format::Full && outputs.main.is_none() {
        output::print(&closing)?;
    } else if format.is_text() || options.statistics || options.summary {
        say(&closing);
    }
    Ok(())
}

/// The tables that were asked for, if any was.
fn counts(options: &CheckOptions, report: &Report) -> Option<String> {
    let by_rule = options.statistics.then(|| gcheck_report::statistics(report));
    let by_file = options.summary.then(|| gcheck_report::file_counts(report));
    let tables: Vec<String> = by_rule.into_iter().chain(by_file).collect();
    (!tables.is_empty()).then(|| tables.join(if tables.iter().any(String::is_empty) { "" } else { "\n" }))
}

fn closing_line(report: &Report) -> String {
    let summary = report.summary();
    if summary.files == 0 {
        return "no programs found\n".to_owned();
    }
    format!("{}\n{}", gcheck_report::summary_line(&summary), gcheck_report::assumptions(&summary))
}
