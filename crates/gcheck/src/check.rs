//! `gcheck check`: from paths to a report and an exit code.
//!
//! Knows: the order of the work, what runs in parallel, what ends in which exit code. Must not know: rules or formats.

mod job;
mod known;
mod mending;
mod progress;
mod settings_page;

use std::collections::BTreeSet;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use gcheck_report::{FileReport, Format, Report, Summary};
use gcheck_rules::Selection;
use rayon::prelude::*;

use crate::args::{CheckOptions, FailOn, Global, OutputFile};
use crate::config::{Configs, RuleWishes, unknown_rule, validate_control};
use crate::discovery::{self, Found};
use crate::{Problem, output, paths, reading};
use job::{Bench, Checked, Target};
use known::KnownFindings;
use progress::Progress;

/// Standard input among the paths.
const STANDARD_INPUT: &str = "-";

/// Runs the command; the exit code is its result.
pub(crate) fn run(global: &Global, options: &CheckOptions) -> Result<u8, Problem> {
    if let Some(name) = &global.control {
        validate_control(name).map_err(Problem::new)?;
    }
    let wishes = RuleWishes {
        select: options.select.clone(),
        ignore: options.ignore.clone(),
        extend_select: options.extend_select.clone(),
    };
    for selector in wishes.select.iter().chain(&wishes.ignore).chain(&wishes.extend_select) {
        Selection::none().enable(selector).map_err(|unknown| Problem::new(unknown_rule(&unknown)))?;
    }
    if options.fix && options.paths.iter().any(|path| path.as_os_str() == STANDARD_INPUT) {
        return Err(Problem::new("standard input cannot be mended").help("`--diff` shows what would change"));
    }
    let outputs = Outputs::new(options)?;
    let mut known = match &options.baseline {
        Some(path) => Some(KnownFindings::read(path, options.update_baseline)?),
        None => None,
    };
    let mut configs = Configs::new(&global.config, global.isolated)?;
    let (targets, mut problems) = targets(options, &mut configs);
    if options.show_files {
        let names: String = targets.iter().map(|target| format!("{}\n", target.shown)).collect();
        output::print(&names)?;
        return Ok(finish(&problems, 0));
    }
    let bench = Bench::new(global, options, wishes);
    if options.show_settings {
        output::print(&settings_page::page(&bench, &targets, &mut problems))?;
        return Ok(finish(&problems, 0));
    }
    let checked = check_all(&bench, &targets, global, options)?;
    if options.diff {
        return show_differences(global, checked, problems);
    }
    let mut reports = write_mended(&targets, checked, &mut problems);
    if let Some(known) = &mut known {
        let mut remark = None;
        if options.update_baseline {
            remark = Some(known.update(&mut reports)?);
        }
        let stale = known.apply(&mut reports);
        // A run of some rules says nothing about the entries of others.
        let all_rules = options.select.is_empty() && options.ignore.is_empty();
        if let Some(remark) = remark.or(stale.filter(|_| all_rules)).filter(|_| !global.quiet) {
            say(&remark);
        }
    }
    let report = Report::new(reports).with_rules(gcheck_rules::all().iter().map(|rule| rule.meta));
    write(global, options, &outputs, &report, &problems)?;
    let summary = report.summary();
    Ok(finish(&problems, u8::from(fails(&summary, options))))
}

/// Says the problems, each once, and gives the exit code.
pub(crate) fn finish(problems: &[Problem], code: u8) -> u8 {
    let mut problems: Vec<&Problem> = problems.iter().collect();
    problems.sort();
    problems.dedup();
    for problem in &problems {
        crate::report(problem);
    }
    if problems.is_empty() { code } else { crate::FAILED }
}

/// What is to be checked, each file with its configuration.
fn targets(options: &CheckOptions, configs: &mut Configs) -> (Vec<Target>, Vec<Problem>) {
    let is_standard_input = |path: &PathBuf| path.as_os_str() == STANDARD_INPUT;
    let given: Vec<PathBuf> = options.paths.iter().filter(|path| !is_standard_input(path)).cloned().collect();
    let Found { files, mut problems } = discovery::find(&given, configs);
    let mut targets = Vec::with_capacity(files.len() + 1);
    let mut add = |path: PathBuf, is_standard_input| match configs.of_file(&path) {
        Ok(config) => targets.push(Target { shown: paths::shown(&path), path, is_standard_input, config }),
        Err(problem) => problems.push(problem),
    };
    if options.paths.iter().any(is_standard_input) {
        add(options.stdin_filename.clone().unwrap_or_else(|| PathBuf::from("stdin")), true);
    }
    for file in files {
        add(file, false);
    }
    (targets, problems)
}

/// Checks the files, several at a time; the order of the results is that of the files.
fn check_all(
    bench: &Bench<'_>,
    targets: &[Target],
    global: &Global,
    options: &CheckOptions,
) -> Result<Vec<Result<Checked, Problem>>, Problem> {
    let progress = Progress::new(targets.len(), global.quiet);
    let work = || -> Vec<Result<Checked, Problem>> {
        targets.par_iter().map(|target| progress.counting(|| job::guarded(bench, target))).collect()
    };
    let results = match (options.jobs, targets.len()) {
        // Threads cost more than one file takes.
        (_, 0 | 1) => targets.iter().map(|target| job::guarded(bench, target)).collect(),
        (None, _) => work(),
        (Some(jobs), _) => rayon::ThreadPoolBuilder::new()
            .num_threads(jobs.max(1))
            .build()
            .map_err(|error| Problem::new(format!("cannot start {jobs} threads: {error}")))?
            .install(work),
    };
    progress.end();
    Ok(results)
}

/// Writes the programs that were mended. One that cannot be written is a problem, and no more is said of it: what was found
/// last was found in a text that is on no disk.
fn write_mended(
    targets: &[Target],
    checked: Vec<Result<Checked, Problem>>,
    problems: &mut Vec<Problem>,
) -> Vec<FileReport> {
    let mut reports = Vec::with_capacity(checked.len());
    for (target, checked) in targets.iter().zip(checked) {
        let written = checked.and_then(|Checked { report, change }| match change {
            Some(change) => mending::write(&target.path, &change).map(|()| report),
            None => Ok(report),
        });
        match written {
            Ok(report) => reports.push(report),
            Err(problem) => problems.push(problem),
        }
    }
    reports
}

/// Prints what `--fix` would change; the exit code says whether it would change anything.
fn show_differences(
    global: &Global,
    checked: Vec<Result<Checked, Problem>>,
    mut problems: Vec<Problem>,
) -> Result<u8, Problem> {
    let (mut findings, mut files, mut text) = (0, 0, String::new());
    for checked in checked {
        match checked {
            Ok(Checked { report, change: Some(change) }) => {
                findings += report.fixed;
                files += 1;
                text.push_str(&mending::difference(&report.path, &change));
            }
            Ok(_) => {}
            Err(problem) => problems.push(problem),
        }
    }
    output::print(&text)?;
    if !global.quiet {
        let words = |n: usize, one: &str, many: &str| format!("{n} {}", if n == 1 { one } else { many });
        say(&format!(
            "{} would be mended in {}",
            words(findings, "finding", "findings"),
            words(files, "file", "files")
        ));
    }
    Ok(finish(&problems, u8::from(files > 0)))
}

fn fails(summary: &Summary, options: &CheckOptions) -> bool {
    let at_or_above = match options.fail_on {
        FailOn::Error => summary.errors,
        FailOn::Warning => summary.errors + summary.warnings,
        FailOn::Info => summary.errors + summary.warnings + summary.infos,
        FailOn::Never => 0,
    };
    at_or_above > 0 || options.max_warnings.is_some_and(|most| summary.warnings > most)
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
            if !taken.insert(paths::absolute(path)) {
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
    match outputs.main {
        Some(path) => to_file(format, path)?,
        None => {
            let colour = output::colour(global.color);
            output::to_stdout(|out| gcheck_report::write(report, format, colour, out))?;
        }
    }
    let mut closing = String::new();
    if options.statistics {
        closing.push_str(&gcheck_report::statistics(report));
    }
    // Where programs could not be read, it is the problems that say why there are none.
    if !global.quiet && (report.summary().files > 0 || problems.is_empty()) {
        closing.push_str(&closing_line(report));
    }
    // Only the format for people has room for a closing line; a parser reads the others.
    if format == Format::Full && outputs.main.is_none() {
        output::print(&closing)?;
    } else if format.is_text() || options.statistics {
        say(&closing);
    }
    Ok(())
}

fn closing_line(report: &Report) -> String {
    let summary = report.summary();
    if summary.files == 0 {
        return "no programs found\n".to_owned();
    }
    format!("{}\n{}", gcheck_report::summary_line(&summary), gcheck_report::assumptions(&summary))
}

/// Says something beside the findings, on standard error.
fn say(text: &str) {
    let text = text.trim_end();
    if !text.is_empty() {
        // With standard error gone there is nobody left to tell.
        let _ = writeln!(std::io::stderr(), "{text}");
    }
}

/// Reads a target.
fn read(target: &Target) -> Result<gcheck_syntax::SourceText, Problem> {
    if target.is_standard_input { reading::standard_input(&target.path) } else { reading::file(&target.path) }
}
