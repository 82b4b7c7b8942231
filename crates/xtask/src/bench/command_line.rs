//! The whole command as its users run it: CPU seconds, peak memory, start.
//!
//! Knows: `gcheck check`'s arguments and the inputs. Must not know: what the command does.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::ensure;
use gcheck_testkit::inputs;
use serde_json::Value;

use super::in_process::CONTROL;
use super::row::{Limit, Row};
use super::{many_files, peer};
use crate::measure::{Usage, measure};
use crate::workspace;

const RUNS: usize = 3;
const STARTS: usize = 21;
const SMALL: &str = "O1000\nG21 G90 G94\nT1 M6\nG43 H1\nS800 M3\nG0 X0. Y0.\nG1 X10. F200.\nM30\n";

/// Builds the program as it is published; gives where it is, and the folder of the inputs.
pub(super) fn build() -> anyhow::Result<(PathBuf, PathBuf)> {
    let target = workspace::members()?.target_directory.into_std_path_buf();
    let build = Command::new("cargo")
        .current_dir(workspace::root())
        .args(["build", "--quiet", "--profile", "dist", "--package", "gcheck"])
        .status()?;
    ensure!(build.success(), "the release build fails");
    let gcheck = target.join("dist").join(format!("gcheck{}", std::env::consts::EXE_SUFFIX));
    let inputs = target.join("bench-inputs");
    fs::create_dir_all(&inputs)?;
    Ok((gcheck, inputs))
}

/// Measures.
pub(super) fn rows(gcheck: &Path, inputs: &Path) -> anyhow::Result<Vec<Row>> {
    let surfacing = Input::write(inputs, "surfacing.nc", &inputs::surfacing(1_000_000))?;
    let drilling = Input::write(inputs, "drilling.nc", &inputs::drilling(100_000))?;
    let macros = Input::write(inputs, "macros.nc", &inputs::macros(100_000))?;
    // Alone in its folder: the control of such a program depends on its neighbours, which are read, too.
    let alone = inputs.join("alone");
    fs::create_dir_all(&alone)?;
    let small = Input::write(&alone, "small.nc", SMALL)?;

    // A command that fails fast must not look like a fast one.
    ensure!(small.gets_a_verdict(gcheck)?, "`gcheck check` gives no JSON, so its budgets cannot be measured");

    let mut rows = Vec::new();
    for (name, input, limit) in [
        ("check, surfacing of 1,000,000 lines", &surfacing, 0.40),
        ("check, 100,000 drilled holes", &drilling, 0.08),
        // As the budget of 20 ms for the paths of 2,000 such lines, fifty times: every tenth line forks.
        ("check, 100,000 lines of macros", &macros, 1.00),
    ] {
        let usages = input.check(gcheck, RUNS)?;
        let measured = least(&usages, |usage| usage.cpu);
        rows.push(Row { name: name.to_owned(), measured, limit: Limit::AtMost(limit), unit: "s CPU" });
        // The fixed cost of a process says nothing about the file when the file is small.
        if input.bytes > 1e7 {
            let measured = least(&usages, |usage| usage.memory / input.bytes);
            rows.push(Row {
                name: "check, peak memory of the same".into(),
                measured,
                limit: Limit::AtMost(4.0),
                unit: "x file",
            });
        }
    }
    rows.push(Row {
        name: "plot, a page of 1,000,000 moves".into(),
        measured: surfacing.plot(gcheck, RUNS)?,
        limit: Limit::AtMost(5.0),
        unit: "s",
    });
    let mut starts: Vec<f64> = small.check(gcheck, STARTS)?.iter().map(|usage| usage.wall * 1e3).collect();
    starts.sort_by(f64::total_cmp);
    let measured = starts.get(starts.len() / 2).copied();
    rows.push(Row {
        name: "check, a small file (median)".into(),
        measured,
        limit: Limit::AtMost(15.0),
        unit: "ms",
    });
    rows.extend(many_files::rows(gcheck, inputs)?);
    rows.extend(peer::rows(gcheck, inputs)?);
    Ok(rows)
}

fn least(usages: &[Usage], value: impl Fn(&Usage) -> f64) -> Option<f64> {
    usages.iter().map(value).min_by(f64::total_cmp)
}

/// A program on disk.
struct Input {
    path: PathBuf,
    bytes: f64,
}

impl Input {
    fn write(folder: &Path, name: &str, text: &str) -> anyhow::Result<Self> {
        let path = folder.join(name);
        fs::write(&path, text)?;
        #[expect(clippy::cast_precision_loss, reason = "some megabytes")]
        Ok(Self { path, bytes: text.len() as f64 })
    }

    fn arguments(&self) -> [&str; 8] {
        let path = self.path.to_str().unwrap_or_default();
        ["check", "--isolated", "--no-cache", "--control", CONTROL, "--output-format", "json", path]
    }

    /// Does the command print a report?
    fn gets_a_verdict(&self, gcheck: &Path) -> anyhow::Result<bool> {
        let output = Command::new(gcheck).args(self.arguments()).output()?;
        Ok(serde_json::from_slice::<Value>(&output.stdout)
            .is_ok_and(|report| report.get("findings").is_some()))
    }

    /// Seconds that pass until the program is a page, the least of several times; nothing if it does not become one.
    fn plot(&self, gcheck: &Path, runs: usize) -> anyhow::Result<Option<f64>> {
        let page = self.path.with_extension("html");
        let (path, out) = (self.path.to_str().unwrap_or_default(), page.to_str().unwrap_or_default());
        let arguments = ["plot", "--isolated", "--control", CONTROL, path, "-o", out];
        let mut usages = Vec::new();
        for _ in 0..runs {
            let usage = measure(gcheck, &arguments)?;
            if usage.code != 0 {
                eprintln!("gcheck {} ends with {}", arguments.join(" "), usage.code);
                return Ok(None);
            }
            usages.push(usage);
        }
        fs::remove_file(&page)?;
        Ok(least(&usages, |usage| usage.wall))
    }

    /// Checks the program several times; nothing if the command does not get as far as a verdict.
    fn check(&self, gcheck: &Path, runs: usize) -> anyhow::Result<Vec<Usage>> {
        let mut usages = Vec::new();
        for _ in 0..runs {
            let usage = measure(gcheck, &self.arguments())?;
            if !matches!(usage.code, 0 | 1) {
                eprintln!("gcheck {} ends with {}", self.arguments().join(" "), usage.code);
                return Ok(Vec::new());
            }
            usages.push(usage);
        }
        Ok(usages)
    }
}
