//! Blanks at the end of lines.

use crate::declare::declare_rule;
use crate::facts::notation::MAX_PLACES;
use crate::{Edit, FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// Lines end with blanks. Reported once per file.
    ///
    /// ## Why it matters
    /// They are invisible, they use memory of the control, and they make two versions of a program differ where nothing
    /// changed.
    ///
    /// ## Reported
    /// `␠` stands for a blank.
    /// ```nc,reported,haas-mill
    /// G0 X1.␠␠
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X1.
    /// M30
    /// ```
    rule "trailing-blanks" in "style" {
        summary: "blanks at the end of lines",
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
    for (start, line) in cx.lines() {
        let line = line.trim_end_matches(['\n', '\r']);
        let kept = line.trim_end_matches([' ', '\t']).len();
        // Another rule judges blank lines.
        if kept > 0 && kept < line.len() && edits.len() < MAX_PLACES {
            let range = start + kept as u32..start + line.len() as u32;
            edits.push(Edit { range, text: String::new() });
        }
    }
    let Some(first) = edits.first() else { return };
    let message = match edits.len() {
        1 => "line ends with blanks".to_owned(),
        count => format!("{count} lines end with blanks"),
    };
    report.add(
        Finding::new(&META, first.range.clone(), message)
            .label("nothing follows")
            .help("remove the blanks")
            .fix(Fix { title: "remove the blanks".to_owned(), safe: true, edits }),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn line_ends_and_blank_lines_stay() {
        assert_eq!(fixes_of(&RULE, "haas-mill", "G0 X1. \t\r\n  \r\nM30 \n"), "G0 X1.\r\n  \r\nM30\n");
        check_rule(&RULE, "haas-mill", "G0 X1.\n   \n", &expect![[""]]);
    }
}
