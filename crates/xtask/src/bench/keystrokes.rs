//! From an edit to its findings, in process: what an editor waits for, the protocol left out.
//!
//! Knows: the database. Must not know: what it keeps.

use std::ops::Range;
use std::time::Instant;

use gcheck_db::{Database, DocumentId, Settings};
use gcheck_testkit::inputs;

use super::in_process::CONTROL;
use super::row::{Limit, Row};

const EDITS: usize = 200;

/// Lines of the program, and milliseconds that 95 of 100 edits may take.
const SIZES: [(usize, &str, f64); 3] =
    [(1_000, "1,000", 2.0), (200_000, "200,000", 10.0), (1_000_000, "1,000,000", 20.0)];

/// Measures.
pub(super) fn rows() -> anyhow::Result<Vec<Row>> {
    let mut rows = Vec::new();
    for (lines, shown, limit) in SIZES {
        let mut bench = Bench::open(inputs::surfacing(lines))?;
        let row = |name: &str, measured, limit, unit| Row {
            name: format!("{name}, {shown} lines"),
            measured: Some(measured),
            limit: Limit::AtMost(limit),
            unit,
        };
        if lines == 1_000_000 {
            rows.push(row("open to findings", bench.opened, 2_000.0, "ms"));
        }
        rows.push(row("keystroke to findings, p95", bench.plain_edits(), limit, "ms"));
        rows.push(row("jump typed to findings", bench.jump(), 1_000.0, "ms"));
    }
    Ok(rows)
}

/// A document under edit.
struct Bench {
    database: Database,
    id: DocumentId,
    text: String,
    /// Milliseconds from the text to its findings.
    opened: f64,
}

impl Bench {
    fn open(text: String) -> anyhow::Result<Self> {
        let control = gcheck_controls::load(CONTROL)?;
        let mut database = Database::new();
        let start = Instant::now();
        let id = database.open(&text, Settings::new(control, gcheck_rules::RULES));
        let _ = database.analysis(id, &|| false);
        let opened = start.elapsed().as_secs_f64() * 1e3;
        Ok(Self { database, id, text, opened })
    }

    /// Milliseconds from an edit to its findings.
    fn edit(&mut self, range: Range<usize>, insert: &str) -> f64 {
        let start = Instant::now();
        let _ = self.database.edit(self.id, range.start as u32..range.end as u32, insert);
        let _ = self.database.analysis(self.id, &|| false);
        let took = start.elapsed().as_secs_f64() * 1e3;
        self.text.replace_range(range, insert);
        took
    }

    /// The line that holds a byte, its end included.
    fn line_at(&self, at: usize) -> Range<usize> {
        let (before, behind) = self.text.split_at(at);
        let start = before.rfind('\n').map_or(0, |end| end + 1);
        start..at + behind.find('\n').map_or(behind.len(), |end| end + 1)
    }

    /// The 95th of 100: a modal word, a digit, a line put in, a line taken out, all over the program.
    fn plain_edits(&mut self) -> f64 {
        let mut took: Vec<f64> = (0..EDITS)
            .map(|round| {
                // Somewhere between the head and the tail, and never the same place twice.
                let at = self.text.len() / 20 + self.text.len() / 100 * 9 / EDITS * 10 * (round * 77 % EDITS);
                let line = self.line_at(at);
                let digit = |text: &str| text.find(|c: char| c.is_ascii_digit());
                match round % 4 {
                    0 => self.edit(line.start..line.start, "G01 "),
                    1 => {
                        let found = self.text.get(line.clone()).and_then(digit).unwrap_or(0);
                        self.edit(line.start + found..line.start + found + 1, "7")
                    }
                    2 => self.edit(line.start..line.start, "X1.5 Y2.5\n"),
                    _ => self.edit(line, ""),
                }
            })
            .collect();
        took.sort_by(f64::total_cmp);
        took.get(EDITS * 95 / 100).copied().unwrap_or(f64::NAN)
    }

    /// A jump and its label in the middle.
    fn jump(&mut self) -> f64 {
        let line = self.line_at(self.text.len() / 2);
        self.edit(line.start..line.start, "IF [#500 EQ 1.] GOTO 7\nN7 ")
    }
}
