//! The page `docs/seeds.md`.
//!
//! Knows: how sentences and proofs are told to a reader. Must not know: whether they hold.

use std::fmt::Write as _;

use crate::proof::{Proof, in_words};
use crate::seeds::sentence::{KINDS, Sentence, System, Tests};

const HEAD: &str = "\
<!-- Written by `UPDATE_EXPECT=1 cargo test -p gcheck-tests --test manuals`; edit the modules of `tests/tests/manuals/seeds/`. -->
# The founding systems, sentence by sentence

gcheck began with five pages of control manuals.
Each sentence of theirs that binds a program or says what the machine does is numbered here, in our words, with what proves that gcheck keeps to it.
The programs of every proof are in the module that its section names, under the sentence's number, and run with the tests.

A word of a program goes wrong in six ways, and each has its column:

* *as numbers*: the words are plain numbers, each in its place;
* *computed*: a word has a variable or an expression in the place of its number;
* *lasting*: a word or a mode comes from an earlier block;
* *missing*: a block leaves a word out, or the program that it calls is not there;
* *extra*: a block has a word that the code does not have, or two that exclude each other;
* *out of range*: a value is too small, too large, of the wrong sign, or finer than the step.

A cell names the tests, or says in brackets why the sentence has none of the kind.

A *rule*, with its severity in brackets, is proved by two programs: one that it reports, one that it does not.
*Motion*, *figures*, *assumption* and *explanation* are what `gcheck run`, `gcheck stats`, the end of `gcheck check`, and `gcheck explain` print.
Hover shows the code's summary and words with the state around the block, and names `gcheck explain` for the rest.
*Same motion* is that of the same words as numbers.
**Open** is what the manual demands and gcheck does not do yet.
";

/// The whole page.
pub(crate) fn write(systems: &[&System]) -> String {
    let mut page = HEAD.to_owned();
    page.push_str(&summary(systems));
    for system in systems {
        let _ = write!(page, "\n## {}\n\n", system.title);
        let _ = writeln!(page, "Source: {}.", system.source);
        let _ = write!(page, "Programs: `tests/tests/manuals/seeds/{}.rs`.\n\n", system.module);
        let _ = writeln!(page, "| no. | what the manual demands or describes | {} |", KINDS.join(" | "));
        page.push_str("|---|---|---|---|---|---|---|---|\n");
        for (index, sentence) in system.sentences.iter().enumerate() {
            let cells = sentence.kinds().map(cell);
            let says = sentence.says.replace('|', "\\|");
            let _ = writeln!(page, "| {}-{} | {says} | {} |", system.key, index + 1, cells.join(" | "));
        }
    }
    page
}

/// How many tests each system has, by kind.
fn summary(systems: &[&System]) -> String {
    let mut table =
        format!("\n| system | {} | open |\n|---|---|---|---|---|---|---|---|\n", KINDS.join(" | "));
    for system in systems {
        let count =
            |kind: usize| system.sentences.iter().map(|one| proofs(one.kinds()[kind]).len()).sum::<usize>();
        let counts: Vec<String> = (0..KINDS.len()).map(|kind| count(kind).to_string()).collect();
        let all = system.sentences.iter().flat_map(Sentence::kinds).flat_map(proofs);
        let open = all.filter(|proof| matches!(proof, Proof::Open { .. })).count();
        let _ = writeln!(table, "| {} | {} | {open} |", system.title, counts.join(" | "));
    }
    table
}

/// The tests of a kind, each once with its number, or why there are none.
fn cell(tests: &Tests) -> String {
    if let Tests::No(why) = tests {
        return format!("({why})");
    }
    let mut told: Vec<(String, usize)> = Vec::new();
    for words in proofs(tests).iter().map(told_short) {
        match told.iter_mut().find(|(other, _)| *other == words) {
            Some((_, times)) => *times += 1,
            None => told.push((words, 1)),
        }
    }
    let cells =
        told.into_iter().map(|(words, times)| if times == 1 { words } else { format!("{words} ×{times}") });
    cells.collect::<Vec<_>>().join("; ")
}

/// A proof in the few words of a narrow column.
fn told_short(proof: &Proof) -> String {
    let words = match proof {
        Proof::Same { .. } => "same motion".to_owned(),
        _ => in_words(proof, "rules"),
    };
    words.strip_prefix("rule ").map(str::to_owned).unwrap_or(words)
}

fn proofs(tests: &Tests) -> &'static [Proof] {
    match tests {
        Tests::By(proofs) => proofs,
        Tests::No(_) => &[],
    }
}
