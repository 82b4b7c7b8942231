//! Many pairs of programs, compared at once: what each comes to, and the figures of all.
//!
//! Knows: the outcomes of pairs, exit codes, which format is written by whom. Must not know: how programs are paired or run.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Arc;
use std::thread;

use gcheck_report::{FileReport, Report, one_line};
use gcheck_syntax::SourceText;
use gcheck_toolpath::{Aspect, Change, Rest};
use rayon::prelude::*;
use serde_json::{Value as Json, json};

use super::accepted::{self, Accepted, Answer};
use super::outcome::{Alone, DIFFERENT, Outcome, Outcomes, Verdict};
use super::pairs::{self, By, Pair, Pairs};
use super::runs::{self, Compared};
use super::{findings, page, words};
use crate::args::{DiffFormat, DiffOptions, Global};
use crate::commands::plot;
use crate::config::Configs;
use crate::console::{FAILED, finish, say};
use crate::containment::guarded;
use crate::execution::Prepared;
use crate::programs::ProgramFolders;
use crate::progress::Progress;
use crate::{Problem, output, paths, threads};

/// Version of the JSON's shape.
const VERSION: u32 = 1;
/// The paths part.
pub(super) const PATH: &str = "path";
/// A program of one folder that the other one does not have.
pub(super) const ALONE: [&str; 2] = ["removed", "added"];
/// Pictures in a page: more make it too heavy to open.
const MOST_PICTURES: usize = 100;
/// Points of each path in a picture.
const POINTS: usize = 20_000;

/// Compares the programs of two folders, or two programs as if each were the only one of its folder.
pub(super) fn run(global: &Global, options: &DiffOptions) -> Result<u8, Problem> {
    let reads_it = [&options.a, &options.b].into_iter().any(|path| paths::is_standard_input(path));
    if options.output_format == DiffFormat::Html && reads_it {
        return Err(Problem::new("a page draws both programs, and standard input can be read once")
            .help("write the program into a file first"));
    }
    let accepted = match &options.accepted {
        Some(file) => Accepted::read(file, &kinds())?,
        None => Accepted::default(),
    };
    let Pairs { found: pairs, alone, problems } = if options.a.is_dir() {
        let mut configs = Configs::new(&global.config, global.isolated)?;
        pairs::of_folders([&options.a, &options.b], &mut configs)
    } else {
        let pair = Pair {
            name: paths::shown(&options.b),
            files: [options.a.clone(), options.b.clone()],
            by: By::Command,
        };
        Pairs { found: vec![pair], ..Pairs::default() }
    };
    if pairs.is_empty() && alone.iter().all(Vec::is_empty) && problems.is_empty() {
        return Err(Problem::new(format!(
            "no programs in {} and {}",
            paths::shown(&options.a),
            paths::shown(&options.b)
        )));
    }
    let paired = pairs.iter().flat_map(|pair| &pair.files);
    let read = paired.chain(alone.iter().flatten().map(|(_, file)| file)).chain(&options.accepted);
    output::refuse_to_replace(options.output_file.as_deref(), read.map(PathBuf::as_path))?;
    let today = accepted::today();
    let outcomes = compare_all(global, options, pairs, |name, differences, digest| {
        accepted.of(name, differences, digest, today)
    })?;
    let alone = alone
        .into_iter()
        .enumerate()
        .flat_map(|(side, files)| files.into_iter().map(move |(name, file)| (side, name, file)));
    let alone = alone
        .map(|(side, name, file)| {
            let kind = ALONE.get(side).copied().unwrap_or_default();
            Alone { answer: accepted.of(&name, &[kind], "", today), name, side, file }
        })
        .collect();
    let all = Outcomes {
        titles: [&options.a, &options.b].map(|path| paths::shown(path)),
        tolerance: options.tolerance,
        is_strict: options.strict,
        pairs: outcomes,
        alone,
    };
    let text = match options.output_format {
        DiffFormat::Text => all.text(),
        DiffFormat::Json => crate::commands::json(&all.json())?,
        DiffFormat::Junit => findings::junit(&all)?,
        DiffFormat::Github => findings::github(&all)?,
        DiffFormat::Html => page::html(&all),
    };
    if !global.quiet && options.output_format == DiffFormat::Text {
        say(&all.control_lines().join("\n"));
    }
    output::to(options.output_file.as_deref(), &text)?;
    if !global.quiet {
        let answers = all.pairs.iter().map(|outcome| &outcome.answer);
        let used: Vec<usize> =
            answers.chain(all.alone.iter().map(|alone| &alone.answer)).flat_map(|a| a.used.clone()).collect();
        for words in accepted.unused(&used) {
            say(&words);
        }
        if !matches!(options.output_format, DiffFormat::Text) {
            say(&all.summary());
        }
    }
    Ok(finish(&problems, all.code()))
}

/// Names of all differences that there may be.
fn kinds() -> Vec<&'static str> {
    let aspects = Aspect::ALL.into_iter().map(Aspect::name);
    [PATH].into_iter().chain(Change::NAMES).chain(aspects).chain(ALONE).collect()
}

fn compare_all(
    global: &Global,
    options: &DiffOptions,
    pairs: Vec<Pair>,
    answer: impl Fn(&str, &[&str], &str) -> Answer + Sync,
) -> Result<Vec<Outcome>, Problem> {
    let folders = Arc::new(ProgramFolders::default());
    let progress = Progress::new(pairs.len(), global.quiet);
    let pool = threads::pool(thread::available_parallelism().map_or(1, Into::into))?;
    let is_page = options.output_format == DiffFormat::Html;
    let with_text = matches!(options.output_format, DiffFormat::Junit | DiffFormat::Github);
    let mut outcomes: Vec<Outcome> = pool.install(|| {
        let compared = pairs.into_par_iter().map(|pair| {
            progress.counting(|| {
                let [a, b] = &pair.files;
                match guarded(b, || runs::both(global, options, [a, b], &folders, Rest::Read)) {
                    Ok(compared) => Outcome::new(pair, &compared, with_text, &answer),
                    Err(problem) => Outcome::without(pair, problem),
                }
            })
        });
        compared.collect()
    });
    if is_page {
        let different = outcomes.iter_mut().filter(|outcome| outcome.verdict == Verdict::Different);
        let drawn: Vec<&mut Outcome> = different.take(MOST_PICTURES).collect();
        pool.install(|| {
            drawn.into_par_iter().for_each(|outcome| {
                let [a, b] = &outcome.pair.files;
                // A program that cannot be drawn has its words.
                let draw = || {
                    let [a, b] = runs::prepared(global, options, [a, b], &folders)?;
                    plot::overlaid(&a, &b, POINTS)
                };
                outcome.picture = guarded(b, draw).ok();
            });
        });
    }
    progress.end();
    Ok(outcomes)
}

impl Outcome {
    fn new(
        pair: Pair,
        compared: &Compared,
        with_text: bool,
        answer: impl Fn(&str, &[&str], &str) -> Answer,
    ) -> Self {
        let differences = &compared.differences;
        let mut names: Vec<&str> = Vec::new();
        if differences.parting.is_some() {
            names.push(PATH);
        }
        let sections = || differences.sections().iter().map(|of| of.change.name());
        names.extend(Change::NAMES.into_iter().filter(|name| sections().any(|of| of == *name)));
        names.extend(Aspect::ALL.into_iter().filter(|a| differences.count(*a) > 0).map(Aspect::name));
        let sides = compared.sides();
        let detail = sides.json(differences);
        let digest = format!("{:016x}", differences.digest()).split_off(16 - accepted::DIGEST);
        let answer = answer(&pair.name, &names, &digest);
        let fault = compared.faults.iter().flatten().next();
        let verdict = match fault {
            Some(fault) => Verdict::None(fault.problem.clone()),
            None if names.is_empty() && compared.is_all_known() => Verdict::Same,
            None if names.is_empty() => Verdict::AsFarAsKnown,
            None if answer.open.is_empty() => Verdict::Accepted,
            None => Verdict::Different,
        };
        let is_told = !matches!(verdict, Verdict::Same | Verdict::AsFarAsKnown);
        let text = if is_told { sides.text(differences) } else { String::new() };
        let rest = differences.parting.as_ref().map(|_| words::rest(differences).to_owned());
        let of = |prepared: &Prepared| (prepared.shown.clone(), prepared.chosen.choice.clone());
        Self {
            limits: rest.into_iter().chain(sides.limits(differences)).collect(),
            controls: compared.prepared.each_ref().map(of).to_vec(),
            first: (verdict != Verdict::Same).then(|| findings::first(compared, with_text)),
            differences: names.into_iter().map(str::to_owned).collect(),
            pair,
            verdict,
            answer,
            digest,
            text,
            detail,
            picture: None,
        }
    }

    fn without(pair: Pair, problem: Problem) -> Self {
        Self {
            pair,
            verdict: Verdict::None(problem),
            differences: Vec::new(),
            answer: Answer::default(),
            digest: String::new(),
            limits: Vec::new(),
            controls: Vec::new(),
            text: String::new(),
            detail: Json::Null,
            first: None,
            picture: None,
        }
    }
}

impl Outcomes {
    fn code(&self) -> u8 {
        let differs = |verdict: &Verdict| {
            *verdict == Verdict::Different || self.is_strict && *verdict == Verdict::AsFarAsKnown
        };
        if self.count(|verdict| matches!(verdict, Verdict::None(_))) > 0 {
            FAILED
        } else if self.count(differs) > 0 || self.alone.iter().any(Alone::is_open) {
            DIFFERENT
        } else {
            0
        }
    }

    /// Which control reads each program, a line for all that share one.
    fn control_lines(&self) -> Vec<String> {
        let controls = self.pairs.iter().flat_map(|outcome| &outcome.controls);
        let files = controls.map(|(path, control)| {
            FileReport::new(path.clone(), SourceText::from(""), control.clone(), Vec::new())
        });
        gcheck_report::control_lines(&Report::new(files.collect()))
    }

    fn text(&self) -> String {
        let mut out = String::new();
        for outcome in self.pairs.iter().filter(|outcome| outcome.verdict != Verdict::Same) {
            let digest = outcome.name_of_differences().map(|digest| format!("  [digest {digest}]"));
            let digest = digest.unwrap_or_default();
            let told = format!("{}  {}", outcome.pair.name, outcome.words());
            let with = outcome.pair.partner().map(|with| format!("  (with {with})")).unwrap_or_default();
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{}{digest}{}", one_line(&told), one_line(&with));
            if outcome.verdict != Verdict::Accepted {
                for line in outcome.text.lines() {
                    let _ = writeln!(out, "    {line}");
                }
            }
        }
        for alone in &self.alone {
            let title = self.titles.get(alone.side).map_or("", String::as_str);
            let accepted = if alone.is_open() {
                String::new()
            } else {
                format!("  accepted ({})", alone.answer.reasons.join("; "))
            };
            let told = format!("{}  only in {title}{accepted}", alone.name);
            let _ = writeln!(out, "{}", one_line(&told));
        }
        out.push_str(&self.summary());
        out.push('\n');
        out.push_str(&self.other_pairs());
        gcheck_report::harmless(&out).into_owned()
    }

    /// How many pairs are not programs at the same path, and by what they were found.
    fn other_pairs(&self) -> String {
        let count = |by: By| self.pairs.iter().filter(|outcome| outcome.pair.by == by).count();
        let counts = [By::Content, By::Number, By::Name].map(|by| (count(by), by.words()));
        let counts: Vec<String> =
            counts.iter().filter(|(n, _)| *n > 0).map(|(n, words)| format!("{n} by {words}")).collect();
        match counts.as_slice() {
            [] => String::new(),
            counts => format!("pairs at different paths: {}\n", counts.join(", ")),
        }
    }

    fn json(&self) -> Json {
        let pairs: Vec<Json> = self
            .pairs
            .iter()
            .map(|outcome| {
                let problem = match &outcome.verdict {
                    Verdict::None(problem) => Some(problem.message()),
                    _ => None,
                };
                json!({
                    "name": outcome.pair.name,
                    "a": paths::shown(&outcome.pair.files[0]), "b": paths::shown(&outcome.pair.files[1]),
                    "paired_by": outcome.pair.by.name(),
                    "verdict": outcome.verdict.name(),
                    "differences": outcome.differences,
                    "open": outcome.answer.open,
                    "reasons": outcome.answer.reasons,
                    "limits": outcome.limits,
                    "digest": Some(&outcome.digest).filter(|digest| !digest.is_empty()),
                    "problem": problem,
                    "detail": outcome.detail,
                })
            })
            .collect();
        let alone = |side: usize| {
            let files = self.alone.iter().filter(|alone| alone.side == side);
            files.map(|alone| json!({ "name": alone.name, "accepted": !alone.is_open() })).collect::<Vec<_>>()
        };
        json!({
            "version": VERSION,
            "a": self.titles[0], "b": self.titles[1],
            "tolerance": self.tolerance,
            "unit": "mm",
            "same": self.count(|verdict| *verdict == Verdict::Same),
            "same_as_far_as_known": self.count(|verdict| *verdict == Verdict::AsFarAsKnown),
            "different": self.count(|verdict| *verdict == Verdict::Different),
            "accepted": self.count(|verdict| *verdict == Verdict::Accepted),
            "without_verdict": self.count(|verdict| matches!(verdict, Verdict::None(_))),
            "pairs": pairs,
            "only_in_a": alone(0), "only_in_b": alone(1),
        })
    }
}
