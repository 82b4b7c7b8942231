//! The page `docs/recall.md`.
//!
//! Knows: how kinds and counts are told to a reader. Must not know: how anything was found.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::kind::Place;
use crate::kinds;
use crate::table::{Row, Table};

/// Other checkers on the same cases, as `cargo xtask competitors` wrote it down.
pub(crate) struct Others {
    /// Lines about the whole: what was run, when, and remarks.
    about: Vec<String>,
    /// In the order of the columns.
    tools: Vec<String>,
    /// By tool and kind: how many were given, how many of them said something.
    rows: BTreeMap<(String, String), (usize, usize)>,
}

impl Others {
    pub(crate) fn read(text: &str) -> Self {
        let mut others = Self { about: Vec::new(), tools: Vec::new(), rows: BTreeMap::new() };
        for line in text.lines() {
            match line.split('\t').collect::<Vec<_>>()[..] {
                ["about", words] => others.about.push(words.to_owned()),
                ["tool", name, words] => {
                    others.tools.push(name.to_owned());
                    others.about.push(format!("*{name}*: {words}"));
                }
                ["count", tool, kind, given, found] => {
                    let count = (given.parse().unwrap(), found.parse().unwrap());
                    others.rows.insert((tool.to_owned(), kind.to_owned()), count);
                }
                _ => panic!("not a row of the table: {line}"),
            }
        }
        others
    }

    fn total(&self, tool: &str) -> (usize, usize) {
        let rows = self.rows.iter().filter(|((name, _), _)| name == tool);
        rows.fold((0, 0), |sum, (_, row)| (sum.0 + row.0, sum.1 + row.1))
    }
}

const HEAD: &str = "\
<!-- Written by `UPDATE_EXPECT=1 cargo test -p gcheck-tests --test seeded`; edit the modules of `tests/tests/seeded/`. -->
# Mistakes that are found

Mistakes that machinists fear were put, one at a time, into programs without a mistake, and gcheck was asked whether it sees them.
The kinds come from manuals, alarm lists and reports of crashes, not from the list of rules: a kind that is not found stays in the table.

A mistake counts as found when a rule that names it reports on a line not more than two from the edit; under *where it strikes*, anywhere in the program.
Two numbers say how many are found by the rules that are on by default, and by those of the set `strict`, which adds what careful programs state; one number, where both are equal.

*Ours* are the programs of `fixtures/clean`, one place of each program for each kind that fits it; they have a machine file.
*Corpus* are programs of the real-program corpus about which gcheck has nothing to say, four for each kind, without a machine file; kinds that only show against a machine's limits and tools are left out there.
Places are drawn by hashing names, so that every run makes the same mistakes.
Rules were fixed after the first results: the shares hold for these mistakes, and promise less for others.
";

/// The whole page.
pub(crate) fn write(ours: &Table, corpus: &Table, others: &Others) -> String {
    let mut page = HEAD.to_owned();
    let share = |made: usize, found: usize| {
        let tenths = (found * 1_000 + made / 2).checked_div(made).unwrap_or_default();
        format!("{found} of {made} ({}.{} %)", tenths / 10, tenths % 10)
    };
    let _ = writeln!(
        page,
        "\n| {} kinds of mistakes | found by default | found by the strict rules |",
        kinds::all().count()
    );
    page.push_str("|---|---|---|\n");
    for (name, Row { made, found, strictly }) in [("ours", ours.total()), ("corpus", corpus.total())] {
        let _ = writeln!(page, "| {name} | {} | {} |", share(made, found), share(made, strictly));
    }
    page.push_str("\n## Other checkers\n\n");
    for line in &others.about {
        let _ = writeln!(page, "* {line}");
    }
    page.push_str("\n| checker | mistakes in our programs that it says something about |\n|---|---|\n");
    let Row { made, found, .. } = ours.total();
    let _ = writeln!(page, "| gcheck, by default | {} |", share(made, found));
    for tool in &others.tools {
        let (given, found) = others.total(tool);
        let _ = writeln!(page, "| {tool} | {} |", share(given, found));
    }
    for (title, kinds) in kinds::CHAPTERS {
        let _ = write!(page, "\n## {title}\n\n| mistake | result | found by | ours | corpus |");
        let columns: String = others.tools.iter().map(|tool| format!(" {tool} |")).collect();
        let _ = writeln!(page, "{columns}");
        let _ = writeln!(page, "|---|---|---|---|---|{}", "---|".repeat(others.tools.len()));
        for kind in *kinds {
            let mut rules: Vec<String> =
                kind.found_by.iter().map(|rule| format!("[{rule}](rules/{rule}.md)")).collect();
            if kind.place == Place::Anywhere && !rules.is_empty() {
                rules.push("where it strikes".to_owned());
            }
            let rules = if rules.is_empty() { "no rule".to_owned() } else { rules.join(", ") };
            let cell = |row: Option<Row>| match row {
                Some(Row { made, found, strictly }) if found == strictly => format!("{found}/{made}"),
                Some(Row { made, found, strictly }) => format!("{found}, {strictly}/{made}"),
                None => String::new(),
            };
            let other = |count: Option<(usize, usize)>| {
                count.map(|(given, found)| format!("{found}/{given}")).unwrap_or_default()
            };
            let _ = write!(
                page,
                "| {} | {} | {rules} | {} | {} |",
                kind.says,
                kind.fear.name(),
                cell(ours.of(kind.id)),
                cell(corpus.of(kind.id))
            );
            for tool in &others.tools {
                let count = others.rows.get(&(tool.clone(), kind.id.to_owned())).copied();
                let _ = write!(page, " {} |", other(count));
            }
            page.push('\n');
        }
    }
    page
}
