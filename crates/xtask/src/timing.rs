//! `cargo xtask timing`: how long the motion planner of LinuxCNC takes for programs, in `fixtures/timing/measured.tsv`.
//!
//! Knows: the command that runs programs in that planner, the table of seconds. Must not know: what gcheck says of the same
//! programs; the test `timing` of `gcheck-toolpath` compares the two and writes `docs/dev/timing.md`.
//!
//! The planner runs in real time: all programs at all accelerations take two hours. A machine that is busy delays it, so the
//! table keeps the least of several measurements; `--again` drops what it had, `--missing` measures only what the table lacks.
//! Where the control stops between moves (`G92` and its kin), one run in several is a tenth of a second quicker: a value
//! that is below its neighbours is measured `--again`. `speeds` samples the speed along the path of some programs, into `fixtures/timing/speeds`.
//!
//! `planner.py` runs the planner of Debian's package `linuxcnc-uspace`; `GCHECK_TIMING` may name another command of that form.

use std::collections::BTreeMap;
use std::env;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Output};

use anyhow::{Context as _, bail, ensure};
use gcheck_testkit::corpus;
use serde_json::Value;

use crate::{headless, workspace};

const PLANNER: &str = include_str!("timing/planner.py");
const FOLDER: &str = "fixtures/timing";
const TABLE: &str = "fixtures/timing/measured.tsv";
const HEAD: &str = "program\tacceleration\tseconds\n";
/// Of all axes, mm/s².
const ACCELERATIONS: [u32; 4] = [250, 500, 1_000, 4_000];
/// Programs that one start of the planner runs.
const AT_ONCE: usize = 14;
/// A program may take this long, in seconds.
const LIMIT: &str = "200";
/// Programs whose speed is sampled: corners, short segments, helices, moves that overlap, a cycle, lengths that vary.
const SAMPLED: [&str; 6] =
    ["corner-090", "drill-peck", "drop-in-blend", "helix-corners", "mixed-lengths-naive", "surface-0.5"];
/// They are sampled at this acceleration, for so many cycles from the first motion.
const SAMPLED_AT: u32 = 1_000;
const SAMPLED_CYCLES: usize = 4_000;
/// A sample is the mean speed of so many cycles.
const CYCLES_A_SAMPLE: u8 = 4;
/// Seconds of a cycle of the planner.
const CYCLE: f64 = 0.001;

/// Seconds by program and acceleration.
type Measured = BTreeMap<(String, u32), f64>;

/// Measures, and writes the table after each start of the planner.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let has = |option: &str| arguments.iter().any(|argument| argument == option);
    let named: Vec<&str> = arguments
        .iter()
        .map(String::as_str)
        .filter(|argument| !["--again", "--missing"].contains(argument))
        .collect();
    if let Some(option) = named.iter().find(|argument| argument.starts_with('-')) {
        bail!(
            "timing has no option `{option}`: cargo xtask timing [--again|--missing] [PROGRAM…], cargo xtask timing speeds"
        );
    }
    let planner = Planner::new()?;
    if named == ["speeds"] {
        return sample(&planner);
    }
    let table = workspace::root().join(TABLE);
    let mut measured = read(&fs::read_to_string(&table).unwrap_or_else(|_| HEAD.to_owned()))?;
    let programs = programs(&named, &measured, planner.folder.path())?;
    for acceleration in ACCELERATIONS {
        let lacks = |name: &str| !measured.contains_key(&(name.to_owned(), acceleration));
        let programs: Vec<&(String, PathBuf)> =
            programs.iter().filter(|(name, _)| !has("--missing") || lacks(name)).collect();
        for some in programs.chunks(AT_ONCE) {
            let paths: Vec<&Path> = some.iter().map(|(_, path)| path.as_path()).collect();
            let output = planner.run(acceleration, None, &paths)?;
            let lines = String::from_utf8(output.stdout).context("the output is not text")?;
            for line in lines.lines() {
                let (path, seconds) = outcome(line)?;
                let (name, _) =
                    some.iter().find(|(_, known)| *known == path).context("an unknown program")?;
                let least = measured.entry((name.clone(), acceleration)).or_insert(f64::INFINITY);
                *least = if has("--again") { seconds } else { least.min(seconds) };
                println!("{acceleration:>5}  {seconds:>8.3} s  {name}");
            }
            fs::write(&table, write(&measured))?;
            ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        }
    }
    println!(
        "wrote  {TABLE}\nnow write docs/dev/timing.md: UPDATE_EXPECT=1 cargo test -p gcheck-toolpath --test timing"
    );
    Ok(ExitCode::SUCCESS)
}

/// Writes the tables of speeds.
fn sample(planner: &Planner) -> anyhow::Result<ExitCode> {
    let samples = planner.folder.path().join("samples");
    fs::create_dir_all(&samples)?;
    let paths: Vec<PathBuf> =
        SAMPLED.iter().map(|name| workspace::root().join(FOLDER).join(format!("{name}.ngc"))).collect();
    let paths: Vec<&Path> = paths.iter().map(PathBuf::as_path).collect();
    let output = planner.run(SAMPLED_AT, Some(&samples), &paths)?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let folder = workspace::root().join(FOLDER).join("speeds");
    fs::create_dir_all(&folder)?;
    for name in SAMPLED {
        let all = fs::read_to_string(samples.join(format!("{name}.tsv")))
            .with_context(|| format!("the planner wrote no speeds of {name}"))?;
        fs::write(folder.join(format!("{name}.tsv")), speeds(&all)?)?;
        println!("wrote  {FOLDER}/speeds/{name}.tsv");
    }
    Ok(ExitCode::SUCCESS)
}

/// Times and speeds of a table of positions by cycle, from the last cycle before the first motion on.
fn speeds(cycles: &str) -> anyhow::Result<String> {
    let mut places: Vec<Vec<f64>> = Vec::new();
    // It lost what was sampled before it was started.
    for line in cycles.strip_prefix("overrun\n").unwrap_or(cycles).lines() {
        let cells = line.split_whitespace().skip(1).map(str::parse).collect::<Result<Vec<f64>, _>>();
        let cells = cells.with_context(|| format!("`{line}` is not a position"))?;
        ensure!(cells.len() == 3, "`{line}` is not a position");
        places.push(cells);
    }
    let step = |from: &[f64], to: &[f64]| {
        from.iter().zip(to).map(|(from, to)| (to - from).powi(2)).sum::<f64>().sqrt()
    };
    let pairs = || places.iter().zip(places.iter().skip(1));
    let first = pairs().position(|(from, to)| step(from, to) > 0.0).context("nothing moves")?;
    let mut table = "seconds\tspeed\n0.000\t0.00\n".to_owned();
    let ways: Vec<f64> = pairs().skip(first).take(SAMPLED_CYCLES).map(|(from, to)| step(from, to)).collect();
    let sample = f64::from(CYCLES_A_SAMPLE) * CYCLE;
    for (index, some) in (0_u32..).zip(ways.chunks_exact(usize::from(CYCLES_A_SAMPLE))) {
        let time = (f64::from(index) + 0.5) * sample;
        writeln!(table, "{time:.3}\t{:.2}", some.iter().sum::<f64>() / sample)?;
    }
    Ok(table)
}

/// The command that runs programs in the planner, and a folder for what it reads and writes.
struct Planner {
    command: Vec<String>,
    folder: tempfile::TempDir,
}

impl Planner {
    fn new() -> anyhow::Result<Self> {
        let folder = tempfile::tempdir()?;
        let command = if let Ok(command) = env::var("GCHECK_TIMING") {
            command.split_whitespace().map(str::to_owned).collect()
        } else {
            let script = headless::write(folder.path(), "planner.py", PLANNER)?;
            vec!["python3".to_owned(), script.to_string_lossy().into_owned()]
        };
        Ok(Self { command, folder })
    }

    fn run(&self, acceleration: u32, samples: Option<&Path>, programs: &[&Path]) -> anyhow::Result<Output> {
        let (program, before) = self.command.split_first().context("GCHECK_TIMING is empty")?;
        let mut command = Command::new(program);
        command.args(before).args(["--accel", &acceleration.to_string(), "--limit", LIMIT]);
        if let Some(samples) = samples {
            command.arg("--sample").arg(samples);
        }
        command.args(programs).output().with_context(|| format!("`{program}` does not start"))
    }
}

/// The programs of these names; all of the folder, and those of the corpus in the table, without names.
fn programs(asked_for: &[&str], measured: &Measured, parts: &Path) -> anyhow::Result<Vec<(String, PathBuf)>> {
    let folder = env::var_os("GCHECK_CORPUS").map(PathBuf::from);
    let mut names: Vec<String> = asked_for.iter().map(|name| (*name).to_owned()).collect();
    if names.is_empty() {
        for entry in fs::read_dir(workspace::root().join(FOLDER))? {
            let path = entry?.path();
            if path.extension().is_some_and(|extension| extension == "ngc") {
                names.extend(path.file_stem().map(|stem| stem.to_string_lossy().into_owned()));
            }
        }
        if folder.is_some() {
            names.extend(
                measured.keys().map(|(name, _)| name.clone()).filter(|name| name.starts_with("corpus/")),
            );
        }
        names.sort();
        names.dedup();
    }
    let path = |(index, name): (usize, String)| {
        let path = match name.strip_prefix("corpus/") {
            Some(part) => {
                let folder =
                    folder.as_deref().context("GCHECK_CORPUS does not name the folder of the corpus")?;
                let path = parts.join(format!("part-{index}.ngc"));
                let text = corpus::part(folder, part).with_context(|| format!("{part} cannot be read"))?;
                fs::write(&path, text)?;
                path
            }
            None => workspace::root().join(FOLDER).join(format!("{name}.ngc")),
        };
        ensure!(path.is_file(), "no such program: {}", path.display());
        Ok((name, path))
    };
    names.into_iter().enumerate().map(path).collect()
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
    fn speeds_are_those_from_the_first_motion_on() {
        let cycles = "overrun\n7 0 0 0 \n8 0 0 0 \n9 0.03 0.04 0 \n10 0.03 0.04 0.05 \n11 0.03 0.04 0.1 \n12 0.03 0.04 0.15 \n";
        assert_eq!(speeds(cycles).unwrap(), "seconds\tspeed\n0.000\t0.00\n0.002\t50.00\n");
        assert_eq!(speeds("1 0 0 0\n2 0 0 0\n").unwrap_err().to_string(), "nothing moves");
        assert_eq!(speeds("1 0 0 0\noverrun\n").unwrap_err().to_string(), "`overrun` is not a position");
    }

    #[test]
    fn a_program_that_did_not_end_is_refused() {
        let line = r#"{"program": "/p.ngc", "seconds": 200.0, "ended": false, "error": null}"#;
        assert_eq!(outcome(line).unwrap_err().to_string(), "/p.ngc does not end: it takes too long");
        let line = r#"{"program": "/p.ngc", "seconds": 1.5, "ended": true, "error": null}"#;
        assert_eq!(outcome(line).unwrap(), (PathBuf::from("/p.ngc"), 1.5));
    }
}
