//! The last line has no end.

use crate::mending::line_end;
use crate::meta::declare_rule;
use crate::{FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// The last line of the file has no line end.
    ///
    /// ## Why it matters
    /// A control that loads over a line takes a block when its end comes: the last one, `M30` or `%`, is not read.
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
        summary: "last line without an end",
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
    let end = cx.text.len();
    let (base, text) = cx.text.around(end);
    let start = text.rfind(['\n', '\r']).map_or(0, |at| at + 1);
    let last = text.get(start..).unwrap_or_default();
    if last.trim_matches([' ', '\t', '\0', '\u{FEFF}', '\u{1A}']).is_empty() {
        return;
    }
    report.add(
        Finding::new(&META, base + start as u32..end, "last line has no end")
            .label("the end of the block is missing")
            .help("end the line")
            .fix(Fix::safe("end the line", end..end, line_end(text))),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, mended};

    #[test]
    fn the_fix_ends_it_as_other_lines_end() {
        assert_eq!(mended(&RULE, "haas-mill", "G0 X1.\r\nM30"), "G0 X1.\r\nM30\r\n");
        assert_eq!(mended(&RULE, "haas-mill", "M30"), "M30\n");
        check_rule(&RULE, "haas-mill", "M30\n  ", &expect![[""]]);
    }
}
