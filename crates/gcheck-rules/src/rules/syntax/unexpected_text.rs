//! Text that is not code.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, Severity};
use gcheck_lint::is_foreign_character;

declare_rule! {
    /// A block has characters that are not a word, statement or comment.
    ///
    /// ## Why it matters
    /// The control refuses the block. Usually the parentheses of a comment are missing, or the program was written for
    /// another machine.
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
        summary: "text that is not code",
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
        format!("text `{text}` is not code")
    } else {
        "text that is not code".to_owned()
    };
    let finding = Finding::new(&META, cx.in_file(start..start + text.len() as u32), message)
        .label("neither word nor comment");
    let before = cx.slice(cx.block().range.start..start).trim_end();
    if before.ends_with(')') {
        return finding
            .note("the text in parentheses before it is a comment")
            .help("write code outside parentheses");
    }
    if text.starts_with('<') && text.ends_with('>') {
        // Newer controls keep programs by name and accept `<BRACKET>` instead of `O1234`; no manual page that we know
        // confirms it.
        return finding
            .note("some newer controls read a name in angle brackets as the name of a program  [general knowledge]")
            .help("name the program by its `O` number, unless the control keeps programs by name")
            .at_most(Severity::Info);
    }
    if let Some(operator) = comparison(text) {
        return finding
            .note("a control reads comparisons as words")
            .help(format!("write `{operator}` in place of the sign"));
    }
    if prose && !text.contains(['(', ')']) {
        return finding.help("put remarks in parentheses");
    }
    finding.help("remove it")
}

/// The operator that a sign at the start of a text is meant for.
fn comparison(text: &str) -> Option<&'static str> {
    const SIGNS: [(&str, &str); 8] = [
        ("==", "EQ"),
        ("!=", "NE"),
        ("<>", "NE"),
        (">=", "GE"),
        ("<=", "LE"),
        (">", "GT"),
        ("<", "LT"),
        ("=", "EQ"),
    ];
    SIGNS.iter().find(|(sign, _)| text.starts_with(sign)).map(|(_, operator)| *operator)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_remark_without_parentheses_is_one_finding() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X1. move to start\nOFFSET\n",
            &expect![[r#"
                1 | G0 X1. move to start
                  |        ^^^^^^^^^^^^^ error[unexpected-text] text `move to start` is not code
                2 | OFFSET
                  | ^^^^^^ error[unexpected-text] text `OFFSET` is not code
            "#]],
        );
    }

    #[test]
    fn a_sign_for_a_comparison_is_named() {
        let found = findings(&only(&RULE), "fanuc-mill", "IF [#1 >= #4] GOTO 5\nN5 M30\n", &World::default());
        expect![[r#"
            text `>= #4` is not code
              here: neither word nor comment
              note: a control reads comparisons as words
              help: write `GE` in place of the sign
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn nothing_comes_to_text_behind_the_end() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 X1\nM2 tail\nCHANGE JAWS\n",
            &expect![[r#"
                2 | M2 tail
                  |    ^^^^ error[unexpected-text] text `tail` is not code
                3 | CHANGE JAWS
                  | ^^^^^^^^^^^ info[unexpected-text] text `CHANGE JAWS` is not code
            "#]],
        );
        // A label, a subprogram or a condition may lead past an end.
        check_rule(
            &RULE,
            "fanuc-mill",
            "IF[#1EQ0]GOTO9\nM30\nN9 G0 X1.\nOFFSET OF JAWS\nM30\n",
            &expect![[r#"
                4 | OFFSET OF JAWS
                  | ^^^^^^^^^^^^^^ error[unexpected-text] text `OFFSET OF JAWS` is not code
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
                  |        ^^ error[unexpected-text] text `&&` is not code
                2 | START=1
                  | ^^^^^^^ error[unexpected-text] text `START=1` is not code
            "#]],
        );
    }

    #[test]
    fn signs_of_the_serial_line_are_passed_over() {
        check_rule(&RULE, "fanuc-mill", "\u{12}%\nG0 X1.\n%\n\u{14}\0\0\0\n", &expect![[""]]);
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
                  | ^^^^^^^^^ info[unexpected-text] text `<BRACKET>` is not code
                2 | M98 <SIDE-2>
                  |     ^^^^^^^^ info[unexpected-text] text `<SIDE-2>` is not code
            "#]],
        );
    }
}
