//! One tape mark of two.

use std::ops::Range;

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Fix, Report, Run};
use gcheck_lint::line_end;

declare_rule! {
    /// The file has one `%` line instead of a pair.
    ///
    /// ## Why it matters
    /// A missing closing mark often means that the end of the file was cut off. Without an opening mark a control that
    /// loads over a serial line skips the program as text before the tape.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// %
    /// O0001
    /// M30
    /// ```
    /// ## Not reported
    /// A pair, or none at all.
    /// ```nc,quiet,haas-mill
    /// O00001
    /// M30
    /// ```
    /// ```nc,quiet,linuxcnc
    /// %
    /// G0 X1
    /// %
    /// ```
    rule "tape-mark-missing" in "program" {
        summary: "one of the two tape marks is missing",
        severity: Info,
        tier: Program,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let ([mark], Some(first)) = (cx.file_index.tape_marks.as_slice(), &cx.file_index.first_block) else {
        return;
    };
    // Where tape marks are refused, a second one does not help.
    let are_read = !cx.control().syntax().tape_marks_refused;
    if are_read && crate::facts::sections::is_tape_mark_line(cx, mark) {
        let opens = mark.start < first.start;
        report.add(finding(mark.clone(), opens).fix(pair(cx, opens)));
    }
}

fn finding(mark: Range<u32>, opens: bool) -> Finding {
    let (missing, place) = if opens { ("closing", "end") } else { ("opening", "beginning") };
    let label = if opens { "opens the tape" } else { "closes the tape" };
    Finding::new(&META, mark, format!("{missing} tape mark `%` is missing")).label(label).help(format!(
        "put a line with `%` at the {place} of the file; check that nothing else is missing there"
    ))
}

/// The other mark, on a line of its own.
fn pair(cx: &FileCx<'_>, opens: bool) -> Fix {
    let end = cx.text.len();
    let (_, text) = cx.text.around(if opens { end } else { 0 });
    if !opens {
        let head = if text.starts_with('\u{FEFF}') { '\u{FEFF}'.len_utf8() as u32 } else { 0 };
        return Fix::risky("put `%` at the beginning", head..head, format!("%{}", line_end(text)));
    }
    let line_end = line_end(text);
    let before = if text.ends_with(['\n', '\r']) { "" } else { line_end };
    Fix::risky("put `%` at the end", end..end, format!("{before}%{line_end}"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn either_mark_may_be_missing() {
        check_rule(
            &RULE,
            "haas-mill",
            "%\nO1\nM30\n",
            &expect![[r#"
            1 | %
              | ^ info[tape-mark-missing] closing tape mark `%` is missing
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nM30\n%\n",
            &expect![[r#"
            3 | %
              | ^ info[tape-mark-missing] opening tape mark `%` is missing
        "#]],
        );
    }

    #[test]
    fn the_help_names_the_end_that_lacks_it() {
        let found = findings(&only(&RULE), "fanuc-lathe", "%\nO1\nM30\n", &World::default());
        expect![[r#"
            closing tape mark `%` is missing
              here: opens the tape
              help: put a line with `%` at the end of the file; check that nothing else is missing there
              fix (unsafe): put `%` at the end
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
