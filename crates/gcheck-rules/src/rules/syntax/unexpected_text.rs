//! Text that is no code.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::meta::declare_rule;
use crate::mistakes::is_foreign_character;
use crate::{BlockCx, Finding, Report, Run, Severity};

declare_rule! {
    /// Characters stand in a block that make no word, statement or comment.
    ///
    /// ## Why it matters
    /// The control refuses the block. Usually a comment lost its parentheses, or the program was written for another machine.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G0 X1. move to start
    /// ```
    /// ```nc,reported,linuxcnc
    /// G0 X1 "start"
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X1. (move to start)
    /// ```
    rule "unexpected-text" in "syntax" {
        summary: "text that is no code",
        severity: Error,
        tier: Token,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::Unexpected, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    if !is_foreign_character(cx, error) {
        report.add(finding(cx, error));
    }
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let text = cx.slice(error.range.clone()).trim_end();
    let start = error.range.start;
    let prose = text.bytes().filter(u8::is_ascii_alphabetic).count() > 2;
    let message = if text.chars().count() <= 24 {
        format!("text `{text}` is no code")
    } else {
        "text that is no code".to_owned()
    };
    let finding = Finding::new(&META, cx.in_file(start..start + text.len() as u32), message)
        .label("neither word nor comment");
    let before = cx.slice(cx.block().range.start..start).trim_end();
    if before.ends_with(')') {
        return finding
            .note("what stands in parentheses before it is a comment")
            .help("write code outside parentheses");
    }
    if text.starts_with('<') && text.ends_with('>') {
        // Newer controls keep programs by name and take `<BRACKET>` for `O1234`; none that we know says so on a page.
        return finding
            .note("some newer controls read a name in angle brackets as the name of a program  [general knowledge]")
            .help("name the program by its `O` number, unless the control keeps programs by name")
            .at_most(Severity::Info);
    }
    if prose && !text.contains(['(', ')']) {
        return finding.help("put remarks in parentheses");
    }
    finding.help("remove it")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_remark_without_parentheses_is_one_finding() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X1. move to start\nOFFSET\n",
            &expect![[r#"
            1 | G0 X1. move to start
              |        ^^^^^^^^^^^^^ error[unexpected-text] text `move to start` is no code
            2 | OFFSET
              | ^^^^^^ error[unexpected-text] text `OFFSET` is no code
        "#]],
        );
    }

    #[test]
    fn nothing_comes_to_text_behind_the_end() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 X1\nM2 tail\nCHANGE JAWS\n",
            &expect![[r#"
            2 | M2 tail
              |    ^^^^ error[unexpected-text] text `tail` is no code
            3 | CHANGE JAWS
              | ^^^^^^^^^^^ warning[unexpected-text] text `CHANGE JAWS` is no code
        "#]],
        );
        // A label, a subprogram or a condition may lead past an end.
        check_rule(
            &RULE,
            "fanuc-mill",
            "IF[#1EQ0]GOTO9\nM30\nN9 G0 X1.\nOFFSET OF JAWS\nM30\n",
            &expect![[r#"
            4 | OFFSET OF JAWS
              | ^^^^^^^^^^^^^^ error[unexpected-text] text `OFFSET OF JAWS` is no code
        "#]],
        );
    }

    #[test]
    fn signs_of_other_languages() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G0 X1. &&\nSTART=1\n",
            &expect![[r#"
            1 | G0 X1. &&
              |        ^^ error[unexpected-text] text `&&` is no code
            2 | START=1
              | ^^^^^^^ error[unexpected-text] text `START=1` is no code
        "#]],
        );
    }

    #[test]
    fn signs_of_the_serial_line_are_passed_over() {
        check_rule(&RULE, "fanuc-mill", "\u{12}%\nG0 X1.\n%\n\u{14}\0\0\0\n", &expect![[""]]);
        check_rule(&super::super::non_ascii_text::RULE, "fanuc-mill", "G0 X1.\n\u{1a}", &expect![[""]]);
        check_rule(
            &super::super::non_ascii_text::RULE,
            "fanuc-mill",
            "G0 X1.\u{1a}\n",
            &expect![[r#"
            1 | G0 X1.
              |       ^ error[non-ascii-text] byte that is no character stands in code
        "#]],
        );
    }

    #[test]
    fn characters_outside_ascii_are_another_matter() {
        check_rule(&RULE, "linuxcnc", "G0 X1 \u{b5}\n", &expect![[""]]);
    }

    #[test]
    fn names_of_programs_are_only_mentioned() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "<BRACKET>\nM98 <SIDE-2>\nM30\n",
            &expect![[r#"
            1 | <BRACKET>
              | ^^^^^^^^^ info[unexpected-text] text `<BRACKET>` is no code
            2 | M98 <SIDE-2>
              |     ^^^^^^^^ info[unexpected-text] text `<SIDE-2>` is no code
        "#]],
        );
    }
}
