//! A jump after `THEN`.

use gcheck_program::{BlockFlags, StatementKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Edit, Finding, Fix, Report, Run, Severity};

declare_rule! {
    /// A conditional jump has a `THEN`, and the manual of the control does not allow it there.
    ///
    /// ## Why it matters
    /// `THEN` belongs before an assignment or another statement; a jump is written right after the condition. A control that
    /// does not take both stops at the block, or goes on without the jump.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// IF [#500 EQ 3] THEN GOTO 40
    /// G0 X1.
    /// N40 M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// IF [#500 EQ 3] GOTO 40
    /// IF [#500 EQ 4] THEN #501=5
    /// N40 M30
    /// ```
    rule "then-before-jump" in "macros" {
        summary: "`THEN` before a jump",
        severity: Warning,
        tier: Block,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some(source) = &cx.control().syntax().jump_after_then_refused else { return };
    let mut after = None;
    for statement in cx.statements() {
        match (&statement.kind, after) {
            (StatementKind::If { .. }, _) => after = Some(statement.range.start),
            (StatementKind::Goto { .. }, Some(start)) => {
                let Some(then) = then_between(cx, start, statement.range.start) else { continue };
                let with_blank = then.start..cx.in_file(statement.range.clone()).start;
                let finding = Finding::new(&META, then, "`THEN` before a jump (`GOTO`)")
                    .label("a jump is written right after the condition")
                    .note(format!("the manual does not allow `THEN` with `GOTO`  [{source}]"))
                    .help("leave `THEN` out: `IF […] GOTO …`")
                    .fix(Fix {
                        title: "remove `THEN`".to_owned(),
                        safe: false,
                        edits: vec![Edit { range: with_blank, text: String::new() }],
                    })
                    .at_most(Severity::Warning);
                report.add(finding);
            }
            _ => {}
        }
    }
}

/// The bytes of a `THEN` between two places of the chunk, as bytes of the file.
fn then_between(cx: &BlockCx<'_>, from: u32, to: u32) -> Option<std::ops::Range<u32>> {
    let text = cx.slice(from..to).to_ascii_uppercase();
    // A comment may hold the word too; the keyword is the last thing before the jump.
    let head = text.trim_end().strip_suffix("THEN")?.len() as u32;
    Some(cx.in_file(from + head..from + head + 4))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn the_keyword_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "#1=3\nIF[#1EQ3]THEN GOTO40\nIF [#1 EQ 4] THEN #2=5\nN40 M30\n",
            &expect![[r#"
                2 | IF[#1EQ3]THEN GOTO40
                  |          ^^^^ warning[then-before-jump] `THEN` before a jump (`GOTO`)
            "#]],
        );
        check_rule(&RULE, "fanuc-mill", "IF [#1 EQ 3] THEN GOTO 40\nN40 M30\n", &expect![[""]]);
    }

    #[test]
    fn the_fix_leaves_the_jump() {
        let program = "#1=3\nIF [#1 EQ 3] THEN GOTO 40\nN40 M30\n";
        assert_eq!(fixes_of(&RULE, "haas-mill", program), "#1=3\nIF [#1 EQ 3] GOTO 40\nN40 M30\n");
    }
}
