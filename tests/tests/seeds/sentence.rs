//! What a sentence of a manual is here, and what proves it.
//!
//! Knows: sentences in our words, programs, kinds of proof. Must not know: how the product is reached.

use rayon::prelude::*;

use crate::product;

/// A system of a control: one page of a manual.
pub(crate) struct System {
    /// The code that the page is about, and its title: `G143, 5-axis tool length compensation`.
    pub(crate) title: &'static str,
    /// Before the number of a sentence: `G143`.
    pub(crate) key: &'static str,
    /// Manuals and pages.
    pub(crate) source: &'static str,
    /// The module that holds the system, for who follows the page to the programs.
    pub(crate) module: &'static str,
    pub(crate) sentences: &'static [Sentence],
}

/// One normative sentence, in our words, with its proofs.
pub(crate) struct Sentence {
    pub(crate) says: &'static str,
    pub(crate) proofs: &'static [Proof],
}

/// A program and where it runs.
#[derive(Clone, Copy)]
pub(crate) struct Program {
    pub(crate) control: &'static str,
    pub(crate) text: &'static str,
    /// Keys of a configuration: `machine.bar_length=1000`.
    pub(crate) config: &'static [&'static str],
}

impl Program {
    /// With keys of a configuration.
    pub(crate) const fn with(self, config: &'static [&'static str]) -> Self {
        Self { config, ..self }
    }
}

/// A program for a control.
pub(crate) const fn on(control: &'static str, text: &'static str) -> Program {
    Program { control, text, config: &[] }
}

/// What proves a sentence.
pub(crate) enum Proof {
    /// A rule speaks of the first program and is silent about the second. It is named with its severity:
    /// `error[dwell-zero]`.
    Rule { finding: &'static str, violates: Program, conforms: Program },
    /// The program is legal: no finding of warning or error.
    Legal { program: Program },
    /// `gcheck run --output-format text` prints these lines, in this order, with others between them. Runs of blanks
    /// count as one.
    Run { program: Program, prints: &'static [&'static str] },
    /// `gcheck stats` prints these lines, likewise.
    Stats { program: Program, prints: &'static [&'static str] },
    /// `gcheck check` closes with this assumption.
    Assumes { program: Program, says: &'static str },
    /// `gcheck explain` (and so hover) says this of a code.
    Explains { control: &'static str, code: &'static str, says: &'static str },
}

/// Proves every sentence of a system, and shows all that fail.
pub(crate) fn prove(system: &System) {
    let failures: Vec<String> = system
        .sentences
        .par_iter()
        .enumerate()
        .flat_map_iter(|(index, sentence)| {
            let number = format!("{}-{}: {}", system.key, index + 1, sentence.says);
            assert!(!sentence.proofs.is_empty(), "{number}: nothing proves it");
            sentence
                .proofs
                .iter()
                .filter_map(move |proof| holds(proof).err().map(|why| format!("{number}\n{why}\n")))
        })
        .collect();
    assert!(failures.is_empty(), "{} proofs fail\n\n{}", failures.len(), failures.join("\n"));
}

fn holds(proof: &Proof) -> Result<(), String> {
    match proof {
        Proof::Rule { finding, violates, conforms } => {
            let rule = finding.split_once('[').map_or(*finding, |(_, rest)| rest.trim_end_matches(']'));
            let found = product::check(violates);
            if !found.contains(&(*finding).to_owned()) {
                return Err(format!("{finding} is not reported in\n{}\nbut {found:?}", violates.text));
            }
            let found = product::check(conforms);
            let same = |other: &String| other.ends_with(&format!("[{rule}]"));
            if found.iter().any(same) {
                return Err(format!("{rule} is reported in\n{}", conforms.text));
            }
            Ok(())
        }
        Proof::Legal { program } => {
            let found = product::check(program);
            let grave = |one: &String| one.starts_with("error") || one.starts_with("warning");
            if found.iter().any(grave) {
                return Err(format!("{found:?} in\n{}", program.text));
            }
            Ok(())
        }
        Proof::Run { program, prints } => in_order(&product::run(program), prints),
        Proof::Stats { program, prints } => in_order(&product::stats(program), prints),
        Proof::Assumes { program, says } => {
            let assumed = product::assumptions(program);
            if assumed.iter().any(|one| one.contains(says)) {
                return Ok(());
            }
            Err(format!("assumes {assumed:?}, not {says:?}, in\n{}", program.text))
        }
        Proof::Explains { control, code, says } => {
            let text = squeeze(&product::explain(control, code));
            if text.contains(&squeeze(says)) { Ok(()) } else { Err(format!("`{says}` is not in\n{text}")) }
        }
    }
}

/// Each wanted text stands in a line behind the line of the one before.
fn in_order(output: &str, wanted: &[&str]) -> Result<(), String> {
    let mut lines = output.lines().map(squeeze);
    for text in wanted {
        if !lines.any(|line| line.contains(&squeeze(text))) {
            return Err(format!("`{text}` is not printed, or not in its place:\n{output}"));
        }
    }
    Ok(())
}

fn squeeze(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
