//! The last line has no line end.

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// The last line of the file has no line end.
    ///
    /// ## Why it matters
    /// A control that loads over a serial line takes a block at its line end: it does not read the last block, `M30` or
    /// `%`.
    ///
    /// ## Reported
    /// `␃` stands for the end of the file.
    /// ```nc,reported,haas-mill
    /// G0 X1.
    /// M30␃
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X1.
    /// M30
    /// ```
    rule "last-line-without-end" in "style" {
        summary: "last line without a line end",
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
    let end = cx.text.len();
    let (base, text) = cx.text.around(end);
    let start = text.rfind(['\n', '\r']).map_or(0, |at| at + 1);
    let last = text.get(start..).unwrap_or_default();
    if last.trim_matches([' ', '\t', '\0', '\u{FEFF}', '\u{1A}']).is_empty() {
        return;
    }
    let start = base + start as u32;
    report.add(
        Finding::new(&META, start..end, "last line has no line end")
            .label("the end of the block is missing")
            .help("end the line")
            .fix(Fix::safe("end the line", end..end, line_end_before(cx, start))),
    );
}

/// How the line before a byte ends; a line feed where there is none.
fn line_end_before(cx: &FileCx<'_>, start: u32) -> &'static str {
    let (base, text) = cx.text.around(start.saturating_sub(1));
    let before = text.get(..(start - base) as usize).unwrap_or_default();
    if before.ends_with("\r\n") {
        "\r\n"
    } else if before.ends_with('\r') {
        "\r"
    } else {
        "\n"
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn the_fix_ends_it_as_other_lines_end() {
        assert_eq!(fixes_of(&RULE, "haas-mill", "G0 X1.\r\nM30"), "G0 X1.\r\nM30\r\n");
        assert_eq!(fixes_of(&RULE, "haas-mill", "M30"), "M30\n");
        check_rule(&RULE, "haas-mill", "M30\n  ", &expect![[""]]);
    }
}
