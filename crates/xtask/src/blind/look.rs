//! The first look: gcheck runs once on a draw or a set of mistakes, and what it reports is written down to be judged.
//!
//! Knows: the JSON of `gcheck check`, where the programs' text is (`GCHECK_BLIND` for draws). Must not know: verdicts.

#![cfg(feature = "product")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::{env, fs};

use anyhow::{Context as _, bail, ensure};
use gcheck_testkit::blind::{self, Draw, Judged, MistakeSet, NewFinding};
use serde_json::Value;

use super::seal;
use crate::{binary, workspace};

/// Looks at `draw-N` or `mistakes-N`. A second look is refused: the first is what counts.
pub(super) fn look(name: &str) -> anyhow::Result<()> {
    let folder = blind::folder();
    let (kind, number) = name.split_once('-').context("the name is `draw-N` or `mistakes-N`")?;
    let number: u32 = number.parse().context("the name is `draw-N` or `mistakes-N`")?;
    let (input, output) = match kind {
        "draw" => (Draw::programs_name(number), Draw::findings_name(number)),
        "mistakes" => (MistakeSet::mistakes_name(number), MistakeSet::found_name(number)),
        _ => bail!("the name is `draw-N` or `mistakes-N`"),
    };
    ensure!(seal::is_sealed(&input), "{input} is not sealed: `cargo xtask blind seal {input}` comes first");
    let path = folder.join(&output);
    ensure!(!path.exists(), "{output} is there: a first look happens once");
    let gcheck = binary::build(false)?;
    let text = if kind == "draw" {
        Draw::findings_text(&draw(&gcheck, &Draw::read(&folder, number)?)?)
    } else {
        MistakeSet::found_text(&mistakes(&gcheck, &MistakeSet::read(&folder, number)?)?)
    };
    fs::write(&path, text)?;
    println!("wrote  tests/blind/{output}; judge each row, then seal it");
    Ok(())
}

/// Every error and warning about the programs of a draw, each checked by itself as a newcomer would.
fn draw(gcheck: &Path, draw: &Draw) -> anyhow::Result<Vec<Judged>> {
    let texts =
        env::var_os("GCHECK_BLIND").context("GCHECK_BLIND does not name the folder of the drawn programs")?;
    let texts = PathBuf::from(texts).join(format!("draw-{}", draw.number));
    let mut all = Vec::new();
    for program in &draw.programs {
        let folder = texts.join(program.short());
        let path = folder.join(program.file_name());
        let bytes = fs::read(&path).with_context(|| path.display().to_string())?;
        ensure!(
            seal::digest(&bytes) == program.sha256,
            "{} is not the program that was drawn",
            path.display()
        );
        let report = report(gcheck, &folder, &["--isolated"], program.file_name())?;
        let control = report.pointer("/files/0/control/name").and_then(Value::as_str).unwrap_or("?");
        all.extend(findings(&report).filter(|one| matches!(one.severity, "error" | "warning")).map(|one| {
            Judged {
                program: program.short().to_owned(),
                line: one.line,
                severity: one.severity.to_owned(),
                certainty: one.certainty.to_owned(),
                rule: one.rule.to_owned(),
                control: control.to_owned(),
                verdict: None,
                reason: String::new(),
                message: one.message(),
            }
        }));
    }
    Ok(all)
}

/// Every finding that an edit brings, in a copy of the folder of its program.
fn mistakes(gcheck: &Path, set: &MistakeSet) -> anyhow::Result<Vec<NewFinding>> {
    let scratch = workspace::root().join("target/blind");
    let mut all = Vec::new();
    for mistake in &set.mistakes {
        let program = workspace::root().join(&mistake.program);
        let (Some(from), Some(name)) = (program.parent(), program.file_name().and_then(|name| name.to_str()))
        else {
            bail!("{}: {} is not a file in a folder", mistake.id, mistake.program);
        };
        if scratch.exists() {
            fs::remove_dir_all(&scratch)?;
        }
        fs::create_dir_all(&scratch)?;
        for entry in fs::read_dir(from)?.flatten().filter(|entry| entry.path().is_file()) {
            fs::copy(entry.path(), scratch.join(entry.file_name()))?;
        }
        let before = report(gcheck, &scratch, &[], name)?;
        let known: BTreeSet<&str> = findings(&before).map(|one| one.fingerprint).collect();
        let text = fs::read_to_string(&program).with_context(|| mistake.program.clone())?;
        let changed = mistake
            .apply(&text)
            .with_context(|| format!("{}: the edit is outside of the program", mistake.id))?;
        fs::write(scratch.join(name), changed)?;
        let after = report(gcheck, &scratch, &[], name)?;
        all.extend(findings(&after).filter(|one| !known.contains(one.fingerprint)).map(|one| NewFinding {
            mistake: mistake.id.clone(),
            line: one.line,
            severity: one.severity.to_owned(),
            certainty: one.certainty.to_owned(),
            rule: one.rule.to_owned(),
            names_it: None,
            reason: String::new(),
            message: one.message(),
        }));
    }
    Ok(all)
}

fn report(gcheck: &Path, folder: &Path, options: &[&str], name: &str) -> anyhow::Result<Value> {
    let output = binary::check(gcheck, folder, options, &[name])?;
    serde_json::from_slice(&output.stdout).context("the output is no JSON")
}

/// A finding of a report, as a reader needs it.
struct Reported<'a> {
    line: u32,
    severity: &'a str,
    certainty: &'a str,
    rule: &'a str,
    title: &'a str,
    label: &'a str,
    help: &'a str,
    fingerprint: &'a str,
}

impl Reported<'_> {
    fn message(&self) -> String {
        let parts = [self.title, self.label, self.help];
        parts.iter().filter(|part| !part.is_empty()).copied().collect::<Vec<_>>().join(" | ")
    }
}

fn findings(report: &Value) -> impl Iterator<Item = Reported<'_>> {
    report.get("findings").and_then(Value::as_array).into_iter().flatten().map(|finding| {
        let field = |name: &str| finding.get(name).and_then(Value::as_str).unwrap_or_default();
        let line = finding.pointer("/range/start/line").and_then(Value::as_u64).unwrap_or(0);
        Reported {
            line: u32::try_from(line).unwrap_or(u32::MAX),
            severity: field("severity"),
            certainty: field("certainty"),
            rule: field("rule"),
            title: field("message"),
            label: field("label"),
            help: field("help"),
            fingerprint: field("fingerprint"),
        }
    })
}
