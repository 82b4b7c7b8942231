//! How many mistakes of each kind were made and found.
//!
//! Knows: counting, and a table as a file. Must not know: how it is told to readers.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::cases::Case;
use crate::kinds;

/// Mistakes of a kind.
#[derive(Clone, Copy, Default)]
pub(crate) struct Row {
    pub(crate) made: usize,
    /// Found by the rules that are on when nobody chooses.
    pub(crate) found: usize,
    /// Found by the strict rules.
    pub(crate) strictly: usize,
}

/// Rows by kind.
#[derive(Default)]
pub(crate) struct Table {
    rows: BTreeMap<String, Row>,
}

impl Table {
    /// Counts cases, each with whether it is found by default and strictly.
    pub(crate) fn count(cases: &[Case], found: &[bool], strictly: &[bool]) -> Self {
        let mut table = Self::default();
        for (case, (found, strictly)) in cases.iter().zip(found.iter().zip(strictly)) {
            let row = table.rows.entry(case.kind.id.to_owned()).or_default();
            row.made += 1;
            row.found += usize::from(*found);
            row.strictly += usize::from(*strictly);
        }
        table
    }

    pub(crate) fn of(&self, kind: &str) -> Option<Row> {
        self.rows.get(kind).copied()
    }

    /// Of all kinds together.
    pub(crate) fn total(&self) -> Row {
        self.rows.values().fold(Row::default(), |sum, row| Row {
            made: sum.made + row.made,
            found: sum.found + row.found,
            strictly: sum.strictly + row.strictly,
        })
    }

    /// As a file, in the order of the kinds.
    pub(crate) fn write(&self) -> String {
        let mut text = String::from("kind\tmade\tfound\tstrictly\n");
        for kind in kinds::all() {
            if let Some(Row { made, found, strictly }) = self.of(kind.id) {
                let _ = writeln!(text, "{}\t{made}\t{found}\t{strictly}", kind.id);
            }
        }
        text
    }

    pub(crate) fn read(text: &str) -> Self {
        let mut table = Self::default();
        for line in text.lines().skip(1) {
            let [kind, made, found, strictly] = line.split('\t').collect::<Vec<_>>()[..] else {
                panic!("not a row of the table: {line}")
            };
            let number = |text: &str| text.parse().unwrap();
            let row = Row { made: number(made), found: number(found), strictly: number(strictly) };
            table.rows.insert(kind.to_owned(), row);
        }
        table
    }
}
