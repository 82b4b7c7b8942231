//! Two thousand programs in one call, without and with the results of an earlier one.
//!
//! Knows: where real programs come from, and that gcheck keeps results. Must not know: how it keeps them.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use gcheck_testkit::corpus;

use super::row::{Limit, Row};
use crate::measure::{Usage, measure};
use crate::workspace;

const PROGRAMS: usize = 2_000;
const RUNS: usize = 3;

/// Measures.
pub(super) fn rows(gcheck: &Path, inputs: &Path) -> anyhow::Result<Vec<Row>> {
    let (whose, originals) = originals()?;
    let folder = inputs.join("many-files");
    let cache = inputs.join("many-files-cache");
    for stale in [&folder, &cache] {
        if stale.exists() {
            fs::remove_dir_all(stale)?;
        }
    }
    let mut programs = Vec::with_capacity(PROGRAMS);
    for (number, original) in originals.iter().cycle().take(PROGRAMS).enumerate() {
        // A folder for each round, so that no folder holds a program twice; called programs stay beside their callers.
        let round = folder.join((number / originals.len()).to_string());
        let copy = round.join(&original.place);
        fs::create_dir_all(copy.parent().unwrap_or(&round))?;
        fs::copy(&original.path, &copy)?;
        programs.push(copy.to_string_lossy().into_owned());
    }
    let cache = cache.to_string_lossy();
    let check = |kept: &[&str]| {
        let mut arguments = vec!["check", "--isolated", "--output-format", "concise"];
        arguments.extend(kept);
        // Each by name: ignore files of whoever holds the build folder do not count.
        arguments.push("--");
        arguments.extend(programs.iter().map(String::as_str));
        measure(gcheck, &arguments)
    };
    let fresh: Vec<Usage> = (0..RUNS).map(|_| check(&["--no-cache"])).collect::<anyhow::Result<_>>()?;
    let filled = check(&["--cache-dir", &cache])?;
    let known: Vec<Usage> =
        (0..RUNS).map(|_| check(&["--cache-dir", &cache])).collect::<anyhow::Result<_>>()?;
    ensure!(
        fresh.iter().chain(&known).all(|usage| matches!(usage.code, 0 | 1)),
        "a command fails: {fresh:?} {known:?}"
    );
    let row = |name: &str, usages: &[Usage], limit| Row {
        name: format!("check, {PROGRAMS} {whose}{name}"),
        measured: usages.iter().map(|usage| usage.cpu).min_by(f64::total_cmp),
        limit: Limit::AtMost(limit),
        unit: "s CPU",
    };
    Ok(vec![
        row("", &fresh, 3.0),
        row(", results kept", &[filled], 3.0),
        row(", results of an earlier run", &known, 0.3),
    ])
}

/// A program to copy.
struct Original {
    path: PathBuf,
    /// From the folder that it is copied from.
    place: PathBuf,
}

/// The programs of the corpus, or where there is none our own examples.
fn originals() -> anyhow::Result<(&'static str, Vec<Original>)> {
    if let (Some(folder), Some(programs)) = (corpus::folder(), corpus::programs()) {
        let originals = programs
            .into_iter()
            .map(|program| Original { path: folder.join(&program.name), place: PathBuf::from(program.name) });
        return Ok(("real programs", originals.collect()));
    }
    let tour = workspace::root().join("fixtures/tour");
    let mut originals = Vec::new();
    for entry in fs::read_dir(&tour)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "nc") {
            let place = PathBuf::from(path.file_name().context("a file has a name")?);
            originals.push(Original { path, place });
        }
    }
    Ok(("copies of examples", originals))
}
