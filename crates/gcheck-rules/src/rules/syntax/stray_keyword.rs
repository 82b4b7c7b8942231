//! A keyword in the wrong place.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A word of the macro language is in a place where it has no meaning.
    ///
    /// ## Why it matters
    /// The control refuses the block. Usually it is `ELSE` or `ENDIF`: many controls do not have these statements.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// IF [#1 GT 5.] THEN #1= 5.
    /// ELSE
    /// ```
    /// ```nc,reported,fanuc-mill
    /// G0 X1. THEN
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// o100 if [#1 GT 5]
    /// o100 else
    /// o100 endif
    /// ```
    /// Letters that are part of a longer text are not called a keyword: `ORECTANGLE` is a name where the control reads a number.
    rule "stray-keyword" in "syntax" {
        summary: "keyword in the wrong place",
        severity: Error,
        tier: Token,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::StrayKeyword, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let keyword = cx.slice(error.range.clone());
    let text = letters_around(cx, error);
    if text.len() > keyword.len() {
        return part_of_text(cx, error, text);
    }
    let finding =
        Finding::new(&META, cx.in_file(error.range.clone()), format!("keyword `{keyword}` cannot be here"));
    let branch = ["ELSE", "ELSEIF", "ENDIF"].iter().any(|k| k.eq_ignore_ascii_case(keyword));
    match (branch, cx.control().syntax().o_words) {
        (true, false) => finding
            .label("this control does not have this statement")
            .note("`IF` controls only its own block")
            .help("jump over the blocks with `IF [...] GOTO`"),
        (true, true) => finding
            .label("no O number before it")
            .help(format!("write the O number of its `IF` before `{keyword}`")),
        (false, _) => finding
            .label("belongs to no statement or expression")
            .help("complete the statement, or remove the keyword"),
    }
}

/// The letters in one piece that the keyword is in.
fn letters_around<'t>(cx: &BlockCx<'t>, error: &SyntaxError) -> &'t str {
    let block = cx.block_text();
    let inside = |at: u32| at.saturating_sub(cx.block().range.start) as usize;
    let (start, end) = (inside(error.range.start), inside(error.range.end));
    let (Some(before), Some(after)) = (block.get(..start), block.get(end..)) else { return "" };
    let is_letter = |c: char| c.is_ascii_alphabetic();
    let from = before.trim_end_matches(is_letter).len();
    let to = block.len() - after.trim_start_matches(is_letter).len();
    block.get(from..to).unwrap_or_default()
}

/// A longer text, in which the control reads a keyword.
fn part_of_text(cx: &BlockCx<'_>, error: &SyntaxError, text: &str) -> Finding {
    let keyword = cx.slice(error.range.clone());
    let is_name = text.starts_with(['O', 'o']) && cx.block_text().trim_start().starts_with(text);
    let finding = Finding::new(&META, cx.in_file(error.range.clone()), format!("text `{text}` is not code"))
        .label(format!("the control reads `{keyword}` as a keyword here"));
    if is_name {
        let name = text.get(1..).unwrap_or_default();
        return finding
            .note("after `O` the control reads the number of a program")
            .help(format!("number the program, and put its name in a comment: `O1234 ({name})`"));
    }
    finding.help("put remarks in parentheses, or correct the text")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_branch_of_another_language() {
        check_rule(
            &RULE,
            "haas-mill",
            "ELSE\n",
            &expect![[r#"
                1 | ELSE
                  | ^^^^ error[stray-keyword] keyword `ELSE` cannot be here
            "#]],
        );
    }

    #[test]
    fn letters_of_a_longer_text_are_no_keyword() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G0\nORECTANGLE (SQUARE)\nG0 X1. OR\n",
            &expect![[r#"
                2 | ORECTANGLE (SQUARE)
                  | ^^ error[stray-keyword] text `ORECTANGLE` is not code
                3 | G0 X1. OR
                  |        ^^ error[stray-keyword] keyword `OR` cannot be here
            "#]],
        );
        let found = findings(&only(&RULE), "fanuc-mill", "ORECTANGLE\n", &World::default());
        expect![[r#"
            text `ORECTANGLE` is not code
              here: the control reads `OR` as a keyword here
              note: after `O` the control reads the number of a program
              help: number the program, and put its name in a comment: `O1234 (RECTANGLE)`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn without_its_o_number() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 if [#1 GT 5]\nendif\n",
            &expect![[r#"
                2 | endif
                  | ^^^^^ error[stray-keyword] keyword `endif` cannot be here
            "#]],
        );
    }

    #[test]
    fn words_depend_on_the_control() {
        let program = "endif\n";
        let found = findings(&only(&RULE), "linuxcnc", program, &World::default());
        expect![[r#"
            keyword `endif` cannot be here
              here: no O number before it
              help: write the O number of its `IF` before `endif`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
