//! `cargo xtask timing`: how long the motion planner of LinuxCNC takes for programs, in `fixtures/timing/measured.tsv`.
//!
//! Knows: the command that runs programs in that planner, the table of seconds. Must not know: what gcheck says of the same
//! programs; the test `timing` of `gcheck-toolpath` compares the two and writes `docs/dev/timing.md`.
//!
//! The planner runs in real time: all programs at all accelerations take more than an hour. A machine that is busy delays it
//! and never makes it faster, so the table keeps the least of several measurements; `--again` drops what it had.

use std::collections::BTreeMap;
use std::env;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use anyhow::{Context as _, bail, ensure};
use serde_json::Value;

use crate::workspace;

const FOLDER: &str = "fixtures/timing";
const TABLE: &str = "fixtures/timing/measured.tsv";
const HEAD: &str = "program\tacceleration\tseconds\n";
/// Of all axes, mm/s².
const ACCELERATIONS: [u32; 4] = [250, 500, 1_000, 4_000];
/// Programs that one start of the planner runs.
const AT_ONCE: usize = 14;
/// A program may take this long, in seconds.
const LIMIT: &str = "200";

/// Seconds by program and acceleration.
type Measured = BTreeMap<(String, u32), f64>;

/// Measures, and writes the table after each start of the planner.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let again = arguments.iter().any(|argument| argument == "--again");
    let named: Vec<&str> =
        arguments.iter().map(String::as_str).filter(|argument| *argument != "--again").collect();
    if let Some(option) = named.iter().find(|argument| argument.starts_with('-')) {
        bail!("timing has no option `{option}`: cargo xtask timing [--again] [PROGRAM…]");
    }
    let command =
        env::var("GCHECK_TIMING").context("GCHECK_TIMING does not name the command that runs the planner")?;
    let words: Vec<&str> = command.split_whitespace().collect();
    let (program, before) = words.split_first().context("GCHECK_TIMING is empty")?;
    let table = workspace::root().join(TABLE);
    let mut measured = read(&fs::read_to_string(&table).unwrap_or_else(|_| HEAD.to_owned()))?;
    let programs = programs(&named, &measured)?;
    for acceleration in ACCELERATIONS {
        for some in programs.chunks(AT_ONCE) {
            let output = Command::new(program)
                .args(before)
                .args(["--accel", &acceleration.to_string(), "--limit", LIMIT])
                .args(some.iter().map(|(_, path)| path))
                .output()
                .with_context(|| format!("`{program}` does not start: GCHECK_TIMING names the command"))?;
            let lines = String::from_utf8(output.stdout).context("the output is not text")?;
            for line in lines.lines() {
                let (path, seconds) = outcome(line)?;
                let (name, _) =
                    some.iter().find(|(_, known)| *known == path).context("an unknown program")?;
                let least = measured.entry((name.clone(), acceleration)).or_insert(f64::INFINITY);
                *least = if again { seconds } else { least.min(seconds) };
                println!("{acceleration:>5}  {seconds:>8.3} s  {name}");
            }
            ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            fs::write(&table, write(&measured))?;
        }
    }
    println!(
        "wrote  {TABLE}\nnow write docs/dev/timing.md: UPDATE_EXPECT=1 cargo test -p gcheck-toolpath --test timing"
    );
    Ok(ExitCode::SUCCESS)
}

/// The programs of these names; all of the folder, and those of the corpus in the table, without names.
fn programs(asked_for: &[&str], measured: &Measured) -> anyhow::Result<Vec<(String, PathBuf)>> {
    let corpus = env::var_os("GCHECK_CORPUS").map(PathBuf::from);
    let mut names: Vec<String> = asked_for.iter().map(|name| (*name).to_owned()).collect();
    if names.is_empty() {
        for entry in fs::read_dir(workspace::root().join(FOLDER))? {
            let path = entry?.path();
            if path.extension().is_some_and(|extension| extension == "ngc") {
                names.extend(path.file_stem().map(|stem| stem.to_string_lossy().into_owned()));
            }
        }
        if corpus.is_some() {
            names.extend(
                measured.keys().map(|(name, _)| name.clone()).filter(|name| name.starts_with("corpus/")),
            );
        }
        names.sort();
        names.dedup();
    }
    names.into_iter().map(|name| Ok((name.clone(), path(&name, corpus.as_deref())?))).collect()
}

fn path(name: &str, corpus: Option<&Path>) -> anyhow::Result<PathBuf> {
    let path = match name.strip_prefix("corpus/") {
        Some(rest) => corpus.context("GCHECK_CORPUS does not name the folder of the corpus")?.join(rest),
        None => workspace::root().join(FOLDER).join(format!("{name}.ngc")),
    };
    ensure!(path.is_file(), "there is no program {}", path.display());
    Ok(path)
}

/// Program and seconds of a line that the planner's command prints.
fn outcome(line: &str) -> anyhow::Result<(PathBuf, f64)> {
    let line: Value = serde_json::from_str(line).with_context(|| format!("`{line}` is not JSON"))?;
    let path = line.get("program").and_then(Value::as_str).context("a line without a program")?;
    let ended = line.get("ended").and_then(Value::as_bool).unwrap_or(false);
    let error = line.get("error").and_then(Value::as_str);
    ensure!(ended && error.is_none(), "{path} does not end: {}", error.unwrap_or("it takes too long"));
    let seconds = line.get("seconds").and_then(Value::as_f64).context("a line without seconds")?;
    Ok((path.into(), seconds))
}

fn read(table: &str) -> anyhow::Result<Measured> {
    let rows = table.strip_prefix(HEAD).with_context(|| format!("{TABLE} does not begin with its head"))?;
    let row = |line: &str| {
        let mut cells = line.split('\t');
        let (Some(name), Some(acceleration), Some(seconds)) = (cells.next(), cells.next(), cells.next())
        else {
            bail!("{TABLE}: `{line}` has too few cells")
        };
        Ok(((name.to_owned(), acceleration.parse()?), seconds.parse()?))
    };
    rows.lines().map(row).collect()
}

fn write(measured: &Measured) -> String {
    let mut table = HEAD.to_owned();
    for ((name, acceleration), seconds) in measured {
        let _ = writeln!(table, "{name}\t{acceleration}\t{seconds:.3}");
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_that_is_read_and_written_is_the_same() {
        let table = format!("{HEAD}circle\t250\t7.800\ncircle\t1000\t7.700\ncorpus/a.ngc\t250\t1.000\n");
        assert_eq!(write(&read(&table).unwrap()), table);
    }

    #[test]
    fn a_program_that_did_not_end_is_refused() {
        let line = r#"{"program": "/p.ngc", "seconds": 200.0, "ended": false, "error": null}"#;
        assert_eq!(outcome(line).unwrap_err().to_string(), "/p.ngc does not end: it takes too long");
        let line = r#"{"program": "/p.ngc", "seconds": 1.5, "ended": true, "error": null}"#;
        assert_eq!(outcome(line).unwrap(), (PathBuf::from("/p.ngc"), 1.5));
    }
}
