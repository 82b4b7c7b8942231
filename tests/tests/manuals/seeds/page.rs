//! The page `docs/seeds.md`.
//!
//! Knows: how sentences and proofs are told to a reader. Must not know: whether they hold.

use std::fmt::Write as _;

use crate::proof::in_words;
use crate::seeds::sentence::System;

const HEAD: &str = "\
<!-- Written by `UPDATE_EXPECT=1 cargo test -p gcheck-tests --test manuals`; edit the modules of `tests/tests/manuals/seeds/`. -->
# The founding systems, sentence by sentence

gcheck began with five pages of control manuals.
Each sentence of theirs that binds a program or says what the machine does is numbered here, in our words, with what proves that gcheck keeps to it.
The programs of every proof are in the module that its section names, under the sentence's number, and run with the tests.

A *rule* is proved by two programs: one that it reports, one that it does not.
*Motion*, *figures*, *assumption* and *explanation* are what `gcheck run`, `gcheck stats`, the end of `gcheck check`, and `gcheck explain` (and hover) print.
";

/// The whole page.
pub(crate) fn write(systems: &[&System]) -> String {
    let mut page = HEAD.to_owned();
    for system in systems {
        let _ = write!(page, "\n## {}\n\n", system.title);
        let _ = writeln!(page, "Source: {}.", system.source);
        let _ = write!(page, "Programs: `tests/tests/manuals/seeds/{}.rs`.\n\n", system.module);
        page.push_str("| no. | what the manual demands or describes | proved by |\n|---|---|---|\n");
        for (index, sentence) in system.sentences.iter().enumerate() {
            let proofs: Vec<String> = sentence.proofs.iter().map(|proof| in_words(proof, "rules")).collect();
            let _ = writeln!(
                page,
                "| {}-{} | {} | {} |",
                system.key,
                index + 1,
                sentence.says.replace('|', "\\|"),
                proofs.join("; ")
            );
        }
    }
    page
}
