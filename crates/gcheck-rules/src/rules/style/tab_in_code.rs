//! A tab in code.

use gcheck_controls::Semicolon;

use crate::declare::declare_rule;
use crate::facts::notation::MAX_PLACES;
use crate::{Edit, FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// The code contains a tab. Reported once per file.
    ///
    /// ## Why it matters
    /// Many controls do not have this character: they drop it, show something else, or refuse the program when it is
    /// loaded.
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
        summary: "tab in code",
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
    let semicolon_comments = cx.control().syntax().semicolon == Semicolon::Comment;
    let mut edits = Vec::new();
    // Text in brackets may be printed.
    let (mut in_comment, mut to_line_end, mut depth) = (false, false, 0_u32);
    let bytes = cx.runs().flat_map(|(base, piece)| (base..).zip(piece.bytes()));
    for (at, byte) in bytes {
        match byte {
            b'\n' | b'\r' => (in_comment, to_line_end, depth) = (false, false, 0),
            b'(' if !to_line_end => in_comment = true,
            b')' if !to_line_end => in_comment = false,
            _ if in_comment || to_line_end => {}
            b';' if semicolon_comments => to_line_end = true,
            b'[' => depth += 1,
            b']' => depth = depth.saturating_sub(1),
            b'\t' if depth == 0 && edits.len() < MAX_PLACES => {
                edits.push(Edit { range: at..at + 1, text: " ".to_owned() });
            }
            _ => {}
        }
    }
    let Some(first) = edits.first() else { return };
    let count = edits.len();
    report.add(
        Finding::new(&META, first.range.clone(), "tab in code")
            .label(if count == 1 {
                "this is not a blank".to_owned()
            } else {
                format!("the first of {count}")
            })
            .help("write a blank")
            .fix(Fix { title: "replace tabs by blanks".to_owned(), safe: true, edits }),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn comments_keep_theirs() {
        assert_eq!(
            fixes_of(&RULE, "linuxcnc", "G0\tX1 ; a\tb\n(c\td)\tG1 X2\n"),
            "G0 X1 ; a\tb\n(c\td) G1 X2\n"
        );
        check_rule(&RULE, "linuxcnc", "(a\tb)\n;\t(c\n", &expect![[""]]);
    }
}
