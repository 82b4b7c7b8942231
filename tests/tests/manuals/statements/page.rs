//! The pages `docs/dev/statements/*.md`.
//!
//! Knows: how statements and proofs are told to a reader. Must not know: whether they hold.

use std::fmt::Write as _;

use super::statement::{Chapter, Held, Statement};
use crate::proof::in_words;

/// A page about one manual.
pub(crate) struct Manual {
    /// `Haas mill`.
    pub(crate) title: &'static str,
    /// Manual, edition, and how places in it are named.
    pub(crate) source: &'static str,
    pub(crate) chapters: &'static [&'static Chapter],
}

/// The whole page.
pub(crate) fn write(manual: &Manual) -> String {
    let mut page = format!(
        "<!-- Written by `UPDATE_EXPECT=1 cargo test -p gcheck-tests --test manuals`; edit `tests/tests/manuals/statements/`. -->\n\
         # {}: the manual, statement by statement\n\n\
         Source: {}\n\n\
         Each statement is in our words.\n\
         *Held by* names the data entry, effect or rule, and the proof; the programs of every proof are in the file that its section names, under the statement's number, and run with the tests.\n\
         [Read again](read-again.md) says how many rows a second reader found wrong.\n\n",
        manual.title, manual.source
    );
    let all = || manual.chapters.iter().flat_map(|chapter| chapter.statements);
    let count = |is: fn(&Held) -> bool| all().filter(|statement| is(&statement.held)).count();
    let _ = writeln!(
        page,
        "| statements | held | not modelled | gaps |\n|---|---|---|---|\n| {} | {} | {} | {} |",
        all().count(),
        count(|held| matches!(held, Held::By { .. })),
        count(|held| matches!(held, Held::NotModelled(_))),
        count(|held| matches!(held, Held::Gap { .. })),
    );
    for chapter in manual.chapters {
        let _ = write!(
            page,
            "\n## {}\n\nPrograms: `tests/tests/manuals/statements/{}`.\n\n",
            chapter.title, chapter.file
        );
        page.push_str("| no. | place | what the manual says | held by |\n|---|---|---|---|\n");
        for (index, statement) in chapter.statements.iter().enumerate() {
            row(&mut page, chapter.key, index + 1, statement);
        }
    }
    page
}

fn row(page: &mut String, key: &str, number: usize, statement: &Statement) {
    let Statement { at, says, held } = statement;
    let held = match held {
        Held::By { what, proofs } => {
            let proofs: Vec<String> = proofs.iter().map(|proof| in_words(proof, "../../rules")).collect();
            format!("{what}: {}", proofs.join("; "))
        }
        Held::NotModelled(reason) => format!("not modelled: {reason}"),
        Held::Gap { wants, .. } => format!("**gap**: {wants}"),
    };
    let cell = |text: &str| text.replace('|', "\\|");
    let _ = writeln!(page, "| {key}-{number} | {} | {} | {} |", cell(at), cell(says), cell(&held));
}
