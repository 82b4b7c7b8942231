//! A statement of a manual, with what holds it.
//!
//! Knows: statements in our words, their place in the manual, proofs. Must not know: how a proof is made.

use rayon::prelude::*;

use crate::proof::{Proof, holds, is_without_judge};

/// A chapter, or a part of one.
pub(crate) struct Chapter {
    /// `G-codes: canned cycles`.
    pub(crate) title: &'static str,
    /// Before the number of a statement: `CYC`. Unique in its manual.
    pub(crate) key: &'static str,
    /// The file with the programs, below `tests/tests/manuals/statements/`: `haas_mill/canned_cycles.rs`.
    pub(crate) file: &'static str,
    pub(crate) statements: &'static [Statement],
}

/// One thing that the manual says a control does, requires, refuses or ignores, in our words.
pub(crate) struct Statement {
    /// Page or anchor: `p. 234`, `#gcode:g81`.
    pub(crate) at: &'static str,
    pub(crate) says: &'static str,
    pub(crate) held: Held,
}

/// How gcheck holds a statement.
pub(crate) enum Held {
    /// By a data entry, an effect or a rule, which is named; the proofs pass.
    By { what: &'static str, proofs: &'static [Proof] },
    /// Not modelled, for a reason that the page states.
    NotModelled(&'static str),
    /// Wrong or missing so far: each proof is what should hold and does not. A gap that closes turns its test red, so
    /// that it becomes [`Held::By`].
    Gap { wants: &'static str, proofs: &'static [Proof] },
}

/// Proves every statement of a chapter, and shows all that fail. The gaps that are open are shown as well, by
/// `cargo test … -- --nocapture`: they are the work that is left.
#[expect(
    clippy::print_stdout,
    reason = "seen when asked for: what a test captures is shown by `--nocapture` only"
)]
pub(crate) fn prove(chapter: &Chapter) {
    let tried: Vec<(Vec<String>, Option<String>)> = chapter
        .statements
        .par_iter()
        .enumerate()
        .map(|(index, statement)| {
            let number = format!("{}-{} ({}): {}", chapter.key, index + 1, statement.at, statement.says);
            let (failures, open) = attempt(statement);
            let failures = failures.into_iter().map(|why| format!("{number}\n{why}\n")).collect();
            (failures, open.map(|why| format!("{number}\n{why}")))
        })
        .collect();
    for open in tried.iter().filter_map(|(_, open)| open.as_ref()) {
        println!("{open}\n");
    }
    let failures: Vec<String> = tried.into_iter().flat_map(|(failures, _)| failures).collect();
    assert!(failures.is_empty(), "{} proofs fail\n\n{}", failures.len(), failures.join("\n"));
}

/// What fails, and what is open as it is expected to be.
fn attempt(statement: &Statement) -> (Vec<String>, Option<String>) {
    let failing =
        |proofs: &[Proof]| -> Vec<String> { proofs.iter().filter_map(|proof| holds(proof).err()).collect() };
    match &statement.held {
        Held::NotModelled("") => (vec!["no reason is given".to_owned()], None),
        Held::NotModelled(_) => (Vec::new(), None),
        Held::By { proofs: [], .. } | Held::Gap { proofs: [], .. } => {
            (vec!["nothing proves it".to_owned()], None)
        }
        Held::By { proofs, .. } => (failing(proofs), None),
        // A gap whose judge is missing cannot be seen to close.
        Held::Gap { proofs, .. } if proofs.iter().any(is_without_judge) => (Vec::new(), None),
        Held::Gap { wants, proofs } => match failing(proofs) {
            open if open.is_empty() => (vec!["the gap is closed: say what holds it".to_owned()], None),
            open => (Vec::new(), Some(format!("wanted: {wants}\n{}", open.join("\n")))),
        },
    }
}
