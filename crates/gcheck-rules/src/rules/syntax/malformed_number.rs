//! A malformed number.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Report, Run};

declare_rule! {
    /// A number has a second decimal point, another number follows a value directly, or the label of an O-word has
    /// decimals.
    ///
    /// ## Why it matters
    /// The control refuses the block. It cannot know which of the two points is right.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G1 X1.2.5 F10.
    /// ```
    /// ```nc,reported,linuxcnc
    /// G1 X[#1 + 1]5 F10
    /// ```
    /// ```nc,reported,haas-mill
    /// G1 X1..5 F10.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G1 X1.25 F10.
    /// ```
    rule "malformed-number" in "syntax" {
        summary: "malformed number",
        severity: Error,
        tier: Token,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::MalformedNumber, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let extra = cx.slice(error.range.clone());
    if extra.starts_with(['O', 'o']) {
        return Finding::new(
            &META,
            cx.in_file(error.range.clone()),
            format!("label `{}` is not a whole number", extra.trim_end()),
        )
        .label("a label is a whole number, or a name in `< >`")
        .help("write the label without decimals");
    }
    let before = cx.slice(cx.block().range.start..error.range.start);
    let digits = before.trim_end_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+')).len();
    let number = before.get(digits..).unwrap_or_default();
    if number.contains('.') {
        let start = error.range.start - number.len() as u32;
        return Finding::new(
            &META,
            cx.in_file(start..error.range.end),
            format!("number `{number}{extra}` has two decimal points"),
        )
        .label("only one of them can be right")
        .help("remove one of the points")
        .fix_if(with_one_point(cx, error, number, extra));
    }
    Finding::new(
        &META,
        cx.in_file(error.range.clone()),
        format!("number `{extra}` directly follows another value"),
    )
    .label("belongs to no address")
    .help("add the letter before the number, or remove the number")
}

/// Two points side by side, or one more at the end: without either one the number is the same.
fn with_one_point(cx: &BlockCx<'_>, error: &SyntaxError, number: &str, extra: &str) -> Option<Fix> {
    let is_doubled = number.ends_with('.') && extra.starts_with('.') || extra == ".";
    let rest = extra.strip_prefix('.').filter(|rest| is_doubled && !rest.contains('.'))?;
    let title = format!("write `{number}{rest}`");
    Some(Fix::risky(title, cx.in_file(error.range.start..error.range.start + 1), ""))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_whole_number_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G1 X1.2.5 F10.\n",
            &expect![[r#"
            1 | G1 X1.2.5 F10.
              |     ^^^^^ error[malformed-number] number `1.2.5` has two decimal points
        "#]],
        );
    }

    #[test]
    fn behind_an_expression_only_the_rest_is() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G1 X[#1+1.]5 F10.\n",
            &expect![[r#"
                1 | G1 X[#1+1.]5 F10.
                  |            ^ error[malformed-number] number `5` directly follows another value
            "#]],
        );
    }
}
