//! Beside the LinuxCNC interpreter alone, `rs274`, on the same programs in the same run: how many times its CPU seconds.
//!
//! Knows: how both are called, programs that both read. Must not know: what either does with them.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::ensure;
use gcheck_testkit::inputs;

use super::row::{Limit, Row};
use crate::measure::{Usage, measure};

const RUNS: usize = 3;
const CONTROL: &str = "linuxcnc";

/// A loop of 100,000 turns with a computed move in each.
const LOOP: &str = "G21 G90 G17 G94 G54\nG0 X0 Y0 Z5\nF500\n#1=0\no100 while [#1 lt 100000]\nG1 X[#1*0.001] Y[sin[#1]]\n\
                    #1=[#1+1]\no100 endwhile\nM2\n";

/// Measures. Nothing, and a line that says so, where `rs274` is not installed.
pub(super) fn rows(gcheck: &Path, folder: &Path) -> anyhow::Result<Vec<Row>> {
    let Some(peer) = find() else {
        eprintln!("rs274 is not installed (Debian: linuxcnc-uspace): nothing is compared with it");
        return Ok(Vec::new());
    };
    let mut rows = Vec::new();
    for (file, program, measured) in [
        (
            "peer-surfacing.ngc",
            readable(&inputs::surfacing(1_000_000)),
            &[("check against rs274, surfacing of 1,000,000 lines", CHECK, 15.0)][..],
        ),
        (
            "peer-drilling.ngc",
            readable(&inputs::drilling(100_000)),
            &[("check against rs274, 100,000 drilled holes", CHECK, 15.0)][..],
        ),
        (
            "peer-loop.ngc",
            LOOP.to_owned(),
            &[
                // The interpreter makes every turn; `check` makes the first ones and takes the others together.
                ("check against rs274, a loop of 100,000 turns, widened after TURNS", CHECK, 40.0),
                ("run against rs274, the same loop, every turn by both", RUN, 8.0),
            ][..],
        ),
    ] {
        let path = folder.join(file);
        fs::write(&path, program)?;
        let its = its_seconds(&peer, &path, folder)?;
        for (name, command, least) in measured {
            rows.push(Row {
                name: name.replace("TURNS", &gcheck_engine::MOST_EXACT_TURNS.to_string()),
                measured: Some(its / own_seconds(gcheck, command, &path)?),
                limit: Limit::AtLeast(*least),
                unit: "times",
            });
        }
    }
    Ok(rows)
}

/// A verdict on all paths.
const CHECK: &[&str] = &["check", "--no-cache", "--output-format", "json"];
/// Every move as the interpreter prints it.
const RUN: &[&str] = &["run", "--output-format", "canonical"];

/// The installed interpreter.
fn find() -> Option<PathBuf> {
    let folders = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&folders).map(|folder| folder.join("rs274")).find(|file| file.is_file())
}

/// A program as the interpreter reads it: to it `O1000` alone is not a program number but a word without its keyword.
fn readable(program: &str) -> String {
    program.replacen("O1000 ", "", 1)
}

fn own_seconds(gcheck: &Path, command: &[&str], path: &Path) -> anyhow::Result<f64> {
    let text = path.to_string_lossy();
    let arguments = [command, &["--isolated", "--control", CONTROL, &text]].concat();
    least(&(0..RUNS).map(|_| measure(gcheck, &arguments)).collect::<anyhow::Result<Vec<_>>>()?, &[0, 1])
}

fn its_seconds(peer: &Path, path: &Path, folder: &Path) -> anyhow::Result<f64> {
    let (table, parameters) = (folder.join("peer.tbl"), folder.join("peer.var"));
    let tools: String = (1..=20).map(|tool| format!("T{tool} P{tool} Z1.5 D0.25\n")).collect();
    fs::write(&table, tools)?;
    // It writes this file again when it ends.
    fs::write(&parameters, "")?;
    let [table, parameters, text] = [&*table, &*parameters, path].map(Path::to_string_lossy);
    let arguments = ["-t", &*table, "-v", &*parameters, "-g", &*text];
    least(&(0..RUNS).map(|_| measure(peer, &arguments)).collect::<anyhow::Result<Vec<_>>>()?, &[0])
}

/// CPU seconds of the run that was disturbed least. A command that fails fast must not look like a fast one.
fn least(usages: &[Usage], good: &[i32]) -> anyhow::Result<f64> {
    ensure!(usages.iter().all(|usage| good.contains(&usage.code)), "a command fails: {usages:?}");
    Ok(usages.iter().map(|usage| usage.cpu).fold(f64::INFINITY, f64::min))
}
