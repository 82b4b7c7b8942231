//! `cargo xtask fuzz`: builds the fuzzer, runs it on each target in turn, and keeps seeds small.
//!
//! Knows: flags of the compiler for coverage, options and words of libFuzzer, the form of seeds. Must not know: any target.
//!
//! The fuzzer (`fuzz/`) is built by the toolchain of the repository: coverage is a pass of LLVM that a stable compiler can be
//! asked for, and memory errors need no sanitizer where no code is unsafe.

mod seeds;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::{Duration, Instant};
use std::{env, fs};

use anyhow::{Context as _, bail, ensure};

use crate::workspace;

/// Names the target to the fuzzer.
const TARGET: &str = "GCHECK_FUZZ_TARGET";

/// What makes the compiler count edges, and compare what programs compare.
const COVERAGE: [&str; 6] = [
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=4",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
    "-Cllvm-args=-sanitizer-coverage-trace-compares",
    "--cfg fuzzing",
];

/// Bytes of an input: longer ones say no more, and take longer.
const MOST_BYTES: usize = 1_024;
/// An input that takes so many seconds is a failure.
const MOST_SECONDS: u32 = 25;
/// Memory of the fuzzer with all that it keeps, in megabytes; more is a failure.
const MOST_MEGABYTES: u32 = 2_048;

/// What is asked for.
struct Wishes {
    minutes: f64,
    keeps: bool,
    targets: Vec<String>,
}

/// Runs `fuzz [--minutes N] [--keep] [TARGET…]`; fails when a target fails.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let wishes = wishes(arguments)?;
    let fuzzer = build()?;
    let targets = u32::try_from(wishes.targets.len()).unwrap_or(1);
    let each = Duration::from_secs_f64(wishes.minutes * 60.0) / targets;
    println!("| target | executions | minutes | edges | features | inputs kept | |");
    println!("|---|---|---|---|---|---|---|");
    let mut failed = false;
    for target in &wishes.targets {
        let ran = fuzz(&fuzzer, target, each)?;
        println!("{}", ran.row(target));
        failed |= ran.failed;
        if wishes.keeps && !ran.failed {
            keep(&fuzzer, target)?;
        }
    }
    Ok(if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

fn wishes(arguments: &[String]) -> anyhow::Result<Wishes> {
    let mut wishes = Wishes { minutes: 13.0, keeps: false, targets: Vec::new() };
    let known = seeds::targets()?;
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.as_str() {
            "--minutes" => {
                let minutes = rest.next().and_then(|number| number.parse().ok());
                wishes.minutes = minutes.context("`--minutes` takes a number")?;
            }
            "--keep" => wishes.keeps = true,
            name if known.iter().any(|target| target == name) => wishes.targets.push(name.to_owned()),
            other => bail!("`{other}` is not a target; known are {}", known.join(", ")),
        }
    }
    if wishes.targets.is_empty() {
        wishes.targets = known;
    }
    Ok(wishes)
}

/// The folder of the fuzzer.
fn folder() -> PathBuf {
    workspace::root().join("fuzz")
}

/// Builds the fuzzer; gives where it is.
fn build() -> anyhow::Result<PathBuf> {
    let host = workspace::host()?;
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    // With a target of its own, build scripts and macros are built without these flags.
    let status = Command::new(cargo)
        .current_dir(workspace::root())
        .args([
            "build",
            "--release",
            "--locked",
            "--manifest-path",
            "fuzz/Cargo.toml",
            "--target-dir",
            "fuzz/target",
        ])
        .args(["--target", &host])
        .env("RUSTFLAGS", COVERAGE.join(" "))
        .status()
        .context("cargo does not start")?;
    ensure!(status.success(), "the fuzzer does not build");
    Ok(folder().join("target").join(host).join("release/gcheck-fuzzer"))
}

/// What a run of the fuzzer did, in its own words.
#[derive(Debug, Default, PartialEq)]
struct Ran {
    executions: u64,
    seconds: f64,
    edges: u64,
    features: u64,
    inputs: u64,
    failed: bool,
}

impl Ran {
    fn row(&self, target: &str) -> String {
        format!(
            "| {target} | {} | {:.1} | {} | {} | {} | {} |",
            self.executions,
            self.seconds / 60.0,
            self.edges,
            self.features,
            self.inputs,
            if self.failed { "**failed**" } else { "" }
        )
    }
}

fn fuzz(fuzzer: &Path, target: &str, time: Duration) -> anyhow::Result<Ran> {
    let corpus = folder().join("corpus").join(target);
    let artifacts = folder().join("artifacts").join(target);
    fs::create_dir_all(&artifacts)?;
    seeds::unpack(target, &corpus)?;
    let started = Instant::now();
    let output = command(fuzzer, target)
        .arg(&corpus)
        .arg(format!("-max_total_time={}", time.as_secs().max(1)))
        .arg(format!("-artifact_prefix={}/", artifacts.display()))
        .args(["-print_final_stats=1", "-reload=0", "-close_fd_mask=1"])
        .output()
        .context("the fuzzer does not start")?;
    let said = String::from_utf8_lossy(&output.stderr);
    let mut ran = read(&said);
    ran.seconds = started.elapsed().as_secs_f64();
    ran.failed = !output.status.success();
    if ran.failed {
        let from = said.find("panicked at").or_else(|| said.find("ERROR: libFuzzer")).unwrap_or(0);
        eprintln!("{target}:\n{}", said.get(from..).unwrap_or_default());
    }
    Ok(ran)
}

/// The fuzzer on one target, within its limits.
fn command(fuzzer: &Path, target: &str) -> Command {
    let mut command = Command::new(fuzzer);
    command
        .env(TARGET, target)
        .arg(format!("-max_len={MOST_BYTES}"))
        .arg(format!("-timeout={MOST_SECONDS}"))
        .arg(format!("-rss_limit_mb={MOST_MEGABYTES}"));
    command
}

/// Takes the last counts out of what libFuzzer says.
fn read(said: &str) -> Ran {
    let mut ran = Ran::default();
    for line in said.lines() {
        if let Some((_, count)) = line.split_once("stat::number_of_executed_units:") {
            ran.executions = count.trim().parse().unwrap_or(0);
        }
        if !line.starts_with('#') {
            continue;
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        let after = |name: &str| {
            let at = words.iter().position(|word| *word == name)?;
            words.get(at + 1)?.split('/').next()?.parse().ok()
        };
        let ended = words.first().and_then(|first| first.trim_start_matches('#').parse().ok());
        ran.executions = ran.executions.max(ended.unwrap_or(0));
        ran.edges = after("cov:").unwrap_or(ran.edges);
        ran.features = after("ft:").unwrap_or(ran.features);
        ran.inputs = after("corp:").unwrap_or(ran.inputs);
    }
    ran
}

/// Leaves of the inputs those that add coverage, and takes some of them as seeds.
fn keep(fuzzer: &Path, target: &str) -> anyhow::Result<()> {
    let corpus = folder().join("corpus").join(target);
    let least = folder().join("corpus").join(format!("{target}.least"));
    if least.exists() {
        fs::remove_dir_all(&least)?;
    }
    fs::create_dir_all(&least)?;
    let merged =
        command(fuzzer, target).args(["-merge=1", "-close_fd_mask=1"]).args([&least, &corpus]).output()?;
    ensure!(merged.status.success(), "the inputs of {target} cannot be minimised");
    fs::remove_dir_all(&corpus)?;
    fs::rename(&least, &corpus)?;
    seeds::pack(target, &corpus)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::fs;
    use std::path::PathBuf;

    use super::{Ran, folder, read};
    use crate::workspace;

    /// The lock file of the fuzzer is its own: one that does not fit what our crates use fails `cargo xtask fuzz`, which no test
    /// runs.
    #[test]
    fn the_lock_of_the_fuzzer_fits_what_our_crates_use() {
        let table = |path: PathBuf| fs::read_to_string(path).unwrap().parse::<toml::Table>().unwrap();
        let lock = table(folder().join("Cargo.lock"));
        let names = |table: &toml::Table, key: &str| -> Vec<String> {
            let listed = table.get(key).and_then(|listed| listed.as_array()).into_iter().flatten();
            // A dependency of which there are several versions has its version after its name.
            let name = |name: &str| name.split(' ').next().unwrap_or_default().to_owned();
            listed.filter_map(|listed| listed.as_str()).map(name).collect()
        };
        let packages = lock["package"].as_array().unwrap().iter().filter_map(|package| package.as_table());
        let ours = |package: &&toml::Table| {
            let name = package["name"].as_str().unwrap();
            name.starts_with("gcheck-") && name != "gcheck-fuzzer"
        };
        let workspace = table(workspace::root().join("Cargo.toml"));
        let versions = workspace["workspace"]["dependencies"].as_table().unwrap();
        let mut compared = 0;
        for package in packages.filter(ours) {
            let name = package["name"].as_str().unwrap();
            let locked = names(package, "dependencies");
            let manifest = table(workspace::root().join("crates").join(name).join("Cargo.toml"));
            // The workspace may call a package by another name.
            let package = |used: &str| {
                let called = versions.get(used).and_then(|told| told.get("package")?.as_str());
                called.unwrap_or(used).to_owned()
            };
            let is_optional = |told: &toml::Value| {
                told.get("optional").is_some_and(|optional| optional.as_bool() == Some(true))
            };
            let mut declared = BTreeSet::new();
            let targets = manifest.get("target").and_then(|targets| targets.as_table()).into_iter().flatten();
            let targets = targets.filter_map(|(_, target)| target.as_table());
            for table in targets.chain([&manifest]) {
                let listed = ["dependencies", "build-dependencies"].map(|key| table.get(key)?.as_table());
                for (used, told) in listed.into_iter().flatten().flatten() {
                    let used = package(used);
                    assert!(
                        is_optional(told) || locked.contains(&used),
                        "{name} uses {used}: `cargo metadata --manifest-path fuzz/Cargo.toml` locks it"
                    );
                    declared.insert(used);
                    compared += 1;
                }
            }
            for locked in locked {
                assert!(
                    declared.contains(&locked),
                    "{name} does not use {locked}: `cargo metadata --manifest-path fuzz/Cargo.toml` forgets it"
                );
            }
        }
        assert!(compared > 30, "{compared} dependencies were compared");
    }

    #[test]
    fn the_last_counts_are_what_a_run_did() {
        let said = "#2\tINITED cov: 10 ft: 11 corp: 1/1b exec/s: 0 rss: 30Mb\n\
            #4096\tpulse  cov: 1200 ft: 3400 corp: 56/7890b lim: 4 exec/s: 2048 rss: 60Mb\n\
            stat::number_of_executed_units: 5000\n";
        let expected = Ran { executions: 5_000, edges: 1_200, features: 3_400, inputs: 56, ..Ran::default() };
        assert_eq!(read(said), expected);
    }
}
