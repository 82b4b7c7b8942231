//! How many mistakes of each kind were made and found.
//!
//! Knows: counting, and a table as a file. Must not know: how it is told to readers.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::cases::Case;
use crate::kinds;

/// By kind: how many were made, how many of them found.
#[derive(Default)]
pub(crate) struct Table {
    rows: BTreeMap<String, (usize, usize)>,
}

impl Table {
    pub(crate) fn count(cases: &[Case], found: &[bool]) -> Self {
        let mut table = Self::default();
        for (case, found) in cases.iter().zip(found) {
            let row = table.rows.entry(case.kind.id.to_owned()).or_default();
            row.0 += 1;
            row.1 += usize::from(*found);
        }
        table
    }

    pub(crate) fn of(&self, kind: &str) -> Option<(usize, usize)> {
        self.rows.get(kind).copied()
    }

    /// Mistakes made and found in all.
    pub(crate) fn total(&self) -> (usize, usize) {
        self.rows.values().fold((0, 0), |sum, row| (sum.0 + row.0, sum.1 + row.1))
    }

    /// As a file, in the order of the kinds.
    pub(crate) fn write(&self) -> String {
        let mut text = String::from("kind\tmade\tfound\n");
        for kind in kinds::all() {
            if let Some((made, found)) = self.of(kind.id) {
                let _ = writeln!(text, "{}\t{made}\t{found}", kind.id);
            }
        }
        text
    }

    pub(crate) fn read(text: &str) -> Self {
        let mut table = Self::default();
        for line in text.lines().skip(1) {
            let [kind, made, found] = line.split('\t').collect::<Vec<_>>()[..] else {
                panic!("not a row of the table: {line}")
            };
            table.rows.insert(kind.to_owned(), (made.parse().unwrap(), found.parse().unwrap()));
        }
        table
    }
}
