//! Several blank lines in a row.

use crate::declare::declare_rule;
use crate::facts::notation::MAX_PLACES;
use crate::{Edit, FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// Two or more blank lines follow each other. Reported once per file.
    ///
    /// ## Why it matters
    /// One blank line separates the sections of a program. More of them push code off the small screen of a control.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G0 X1.
    ///
    ///
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X1.
    ///
    /// M30
    /// ```
    rule "blank-lines-in-a-row" in "style" {
        summary: "several blank lines in a row",
        severity: Hint,
        tier: Program,
        recommended: false,
        sets: [HouseStyle],
        fixable: Safely,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let mut edits = Vec::new();
    let mut blanks = 0_usize;
    for (start, line) in cx.lines() {
        blanks = if line.trim().is_empty() { blanks + 1 } else { 0 };
        if blanks > 1 && edits.len() < MAX_PLACES {
            edits.push(Edit { range: start..start + line.len() as u32, text: String::new() });
        }
    }
    let Some(first) = edits.first() else { return };
    report.add(
        Finding::new(&META, first.range.clone(), "several blank lines in a row")
            .label("one more blank line")
            .help("leave one blank line between two sections")
            .fix(Fix { title: "leave one blank line".to_owned(), safe: true, edits }),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn one_stays() {
        assert_eq!(fixes_of(&RULE, "haas-mill", "G0 X1.\r\n\r\n \r\n\r\nM30\r\n"), "G0 X1.\r\n\r\nM30\r\n");
        check_rule(&RULE, "haas-mill", "\nG0 X1.\n\nM30\n", &expect![[""]]);
    }
}
