//! A tabulator in code.

use gcheck_controls::Semicolon;

use crate::meta::declare_rule;
use crate::writing::MOST_PLACES;
use crate::{Edit, FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// A tabulator stands in the code. Told once for the file.
    ///
    /// ## Why it matters
    /// Many controls have no such character: it is dropped, shown as something else, or refused when the program is loaded.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G0	X1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X1. (A	B)
    /// M30
    /// ```
    rule "tab-in-code" in "style" {
        summary: "tabulator in code",
        severity: Hint,
        tier: Program,
        recommended: false,
        sets: [HouseStyle],
        mends: Safely,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let semicolon_comments = cx.control().syntax().semicolon == Semicolon::Comment;
    let mut edits = Vec::new();
    // What stands in brackets may be text that is printed.
    let (mut in_comment, mut to_line_end, mut depth) = (false, false, 0_u32);
    let bytes = cx.pieces().flat_map(|(base, piece)| (base..).zip(piece.bytes()));
    for (at, byte) in bytes {
        match byte {
            b'\n' | b'\r' => (in_comment, to_line_end, depth) = (false, false, 0),
            b'(' if !to_line_end => in_comment = true,
            b')' if !to_line_end => in_comment = false,
            _ if in_comment || to_line_end => {}
            b';' if semicolon_comments => to_line_end = true,
            b'[' => depth += 1,
            b']' => depth = depth.saturating_sub(1),
            b'\t' if depth == 0 && edits.len() < MOST_PLACES => {
                edits.push(Edit { range: at..at + 1, text: " ".to_owned() });
            }
            _ => {}
        }
    }
    let Some(first) = edits.first() else { return };
    let count = edits.len();
    report.add(
        Finding::new(&META, first.range.clone(), "tabulator in code")
            .label(if count == 1 { "this is no blank".to_owned() } else { format!("the first of {count}") })
            .help("write a blank")
            .fix(Fix { title: "write blanks for tabulators".to_owned(), safe: true, edits }),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, mended};

    #[test]
    fn comments_keep_theirs() {
        assert_eq!(
            mended(&RULE, "linuxcnc", "G0\tX1 ; a\tb\n(c\td)\tG1 X2\n"),
            "G0 X1 ; a\tb\n(c\td) G1 X2\n"
        );
        check_rule(&RULE, "linuxcnc", "(a\tb)\n;\t(c\n", &expect![[""]]);
    }
}
