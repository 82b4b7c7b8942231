//! A parenthesis inside a comment.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Edit, Finding, Fix, Report, Run, Severity};

declare_rule! {
    /// A comment contains another `(`.
    ///
    /// ## Why it matters
    /// Comments do not nest: the first `)` ends the comment, and what follows on the line is read as code. Some controls refuse the
    /// block whatever follows.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// (T2 DRILL (LONG) 8.5 MM)
    /// ```
    /// Even with nothing after it, if the control refuses it.
    /// ```nc,reported,linuxcnc
    /// (T2 DRILL (LONG)
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// (T2 DRILL [LONG] 8.5 MM)
    /// ```
    rule "nested-comment" in "syntax" {
        summary: "parenthesis inside a comment",
        severity: Error,
        tier: Token,
        fixable: Safely,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::NestedComment, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let range = cx.in_file(error.range.clone());
    let comment = cx.slice(error.range.clone());
    let inner = comment.get(1..).and_then(|rest| rest.find('(')).map_or(0, |at| at as u32 + 1);
    let first_close = comment.find(')').map_or(comment.len(), |at| at + 1);
    let tail = comment.get(first_close..).unwrap_or_default().trim();
    let refused = cx.control().syntax().nested_comment_refused;
    let code = !tail.trim_matches([')', ' ']).is_empty();
    let finding = Finding::new(
        &META,
        range.start + inner..range.start + first_close as u32,
        "parenthesis inside a comment",
    )
    .label("comments do not nest")
    .help("write the inner parentheses as `[ ]`, or remove them")
    .fix(brackets(comment, range.start, tail.is_empty()))
    .at_most(if refused || code { Severity::Error } else { Severity::Info });
    let finding = if refused {
        finding.note("the control refuses a block with `(` inside a comment")
    } else {
        finding.note("the comment ends at its first `)`")
    };
    if code {
        let start = range.start + first_close as u32;
        return finding.also(start..range.end, "read as code");
    }
    finding
}

/// Inner parentheses become brackets; then the comment ends at its last parenthesis.
fn brackets(comment: &str, start: u32, same_end: bool) -> Fix {
    let last = comment.rfind(')');
    let inner = comment.char_indices().skip(1).filter_map(|(at, c)| match c {
        '(' => Some((at, "[")),
        ')' if Some(at) != last => Some((at, "]")),
        _ => None,
    });
    let edits = inner
        .map(|(at, text)| Edit { range: start + at as u32..start + at as u32 + 1, text: text.to_owned() });
    // If the comment ended early, text that was code becomes a comment.
    Fix { title: "write the inner parentheses as `[ ]`".to_owned(), safe: same_end, edits: edits.collect() }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only, words};

    #[test]
    fn what_follows_the_first_parenthesis_is_code() {
        check_rule(
            &RULE,
            "haas-mill",
            "(T2 (LONG) 8.5 MM) G0 X1.\n(A (B)\n",
            &expect![[r#"
            1 | (T2 (LONG) 8.5 MM) G0 X1.
              |     ^^^^^^ error[nested-comment] parenthesis inside a comment
            2 | (A (B)
              |    ^^^ info[nested-comment] parenthesis inside a comment
        "#]],
        );
    }

    #[test]
    fn refused_whatever_follows() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 X1 (A (B)\n",
            &expect![[r#"
            1 | G0 X1 (A (B)
              |          ^^^ error[nested-comment] parenthesis inside a comment
        "#]],
        );
    }

    #[test]
    fn words_tell_where_the_comment_ends() {
        let program = "(A (B) C)\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            parenthesis inside a comment
              here: comments do not nest
              there: read as code
              note: the comment ends at its first `)`
              help: write the inner parentheses as `[ ]`, or remove them
              fix (unsafe): write the inner parentheses as `[ ]`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn the_inner_parentheses_become_brackets() {
        let program = "(A (B) C)\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            (A [B] C)
        "#]]
        .assert_eq(&found.iter().map(|f| fixed(program, f)).collect::<String>());
    }
}
