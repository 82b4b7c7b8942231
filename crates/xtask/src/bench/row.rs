//! A line of the table: what was measured, and what is allowed.
//!
//! Knows: numbers with units. Must not know: where they come from.

use std::fmt::Write as _;

/// A measured value and its budget.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) name: String,
    /// `None` when the thing could not be measured.
    pub(super) measured: Option<f64>,
    pub(super) limit: Limit,
    pub(super) unit: &'static str,
}

/// What a value may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Limit {
    /// No more than this.
    AtMost(f64),
    /// No less than this.
    AtLeast(f64),
}

impl Row {
    /// Is the budget kept? Unknown when nothing was measured.
    pub(super) fn verdict(&self) -> Option<bool> {
        let measured = self.measured?;
        Some(match self.limit {
            Limit::AtMost(limit) => measured <= limit,
            Limit::AtLeast(limit) => measured >= limit,
        })
    }
}

/// Rows under each other, with aligned columns.
pub(super) fn table(rows: &[Row]) -> String {
    let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or(0);
    let mut text = format!("{:width$} | {:>14} | {:>16} | ok\n", "budget", "measured", "limit");
    for row in rows {
        let measured =
            row.measured.map_or_else(|| "not measured".to_owned(), |m| format!("{m:.3} {}", row.unit));
        let limit = match row.limit {
            Limit::AtMost(limit) => format!("<= {limit} {}", row.unit),
            Limit::AtLeast(limit) => format!(">= {limit} {}", row.unit),
        };
        let verdict = match row.verdict() {
            Some(true) => "yes",
            Some(false) => "NO",
            None => "-",
        };
        let _ = writeln!(text, "{:width$} | {measured:>14} | {limit:>16} | {verdict}", row.name);
    }
    text
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{Limit, Row, table};

    #[test]
    fn a_missed_budget_stands_out() {
        let row = |name: &str, measured, limit, unit| Row { name: name.to_owned(), measured, limit, unit };
        let rows = [
            row("check", Some(0.5), Limit::AtMost(0.4), "s"),
            row("tokens", Some(300.0), Limit::AtLeast(240.0), "MB/s"),
            row("start", None, Limit::AtMost(15.0), "ms"),
        ];
        expect![[r"
            budget |       measured |            limit | ok
            check  |        0.500 s |         <= 0.4 s | NO
            tokens |   300.000 MB/s |      >= 240 MB/s | yes
            start  |   not measured |         <= 15 ms | -
        "]]
        .assert_eq(&table(&rows));
    }
}
