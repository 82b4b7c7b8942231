//! Brackets nested deeper than the control evaluates.

use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// Brackets of an expression are nested deeper than the control accepts.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// #1=[1.+[2.+[3.+[4.+[5.+[#2]]]]]]
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// #1=[1.+[2.+[3.+[4.+[#2]]]]]
    /// ```
    /// A control without a known limit is not judged.
    /// ```nc,quiet,linuxcnc
    /// #1=[1+[2+[3+[4+[5+[#2]]]]]]
    /// ```
    rule "bracket-nesting-limit" in "syntax" {
        summary: "brackets nested deeper than the control accepts",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT.union(BlockFlags::EXPRESSION), check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some(limit) = cx.control().limits().bracket_depth else { return };
    // As far as is known, the bracket of a condition belongs to the statement.
    let statement = cx.statements().any(|s| !matches!(s.kind, gcheck_program::StatementKind::Assign { .. }));
    if cx.block().flags.contains(BlockFlags::ERROR) {
        return;
    }
    if let Some(at) = first_too_deep(cx.block_text(), usize::from(limit) + usize::from(statement)) {
        report.add(finding(cx, at as u32, limit));
    }
}

/// Place of the first bracket inside `limit` others; comments do not count.
fn first_too_deep(text: &str, limit: usize) -> Option<usize> {
    let mut depth = 0_usize;
    let mut in_comment = false;
    text.bytes().position(|byte| {
        match byte {
            b'(' => in_comment = true,
            b')' => in_comment = false,
            b'[' if !in_comment => depth += 1,
            b']' if !in_comment => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth > limit
    })
}

fn finding(cx: &BlockCx<'_>, at: u32, limit: u8) -> Finding {
    let start = cx.block().range.start + at;
    let source =
        cx.control().limits().bracket_depth_source.as_deref().map(|s| format!("  [{s}]")).unwrap_or_default();
    Finding::new(
        &META,
        cx.in_file(start..start + 1),
        format!("brackets are nested deeper than {limit} levels"),
    )
    .label("one level too many")
    .note(format!("this control accepts {limit} levels of brackets, including those of functions{source}"))
    .help("compute it in steps: assign an intermediate result to a variable")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_first_bracket_too_many_is_marked() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "#1=[[[[[2.]]]]] ([[[[[[)\n#1=[[[[[[2.]]]]]]\nX[[[[[[2.]]]]]]\nIF [[[[[[#1]]]]] GT 1.] GOTO 1\n",
            &expect![[r#"
                2 | #1=[[[[[[2.]]]]]]
                  |         ^ error[bracket-nesting-limit] brackets are nested deeper than 5 levels
                3 | X[[[[[[2.]]]]]]
                  |       ^ error[bracket-nesting-limit] brackets are nested deeper than 5 levels
            "#]],
        );
    }

    #[test]
    fn no_known_limit_no_finding() {
        check_rule(&RULE, "linuxcnc", "#1=[[[[[[2]]]]]]\n", &expect![[""]]);
    }

    #[test]
    fn words_state_the_limit() {
        let found = findings(&only(&RULE), "fanuc-mill", "#1=SIN[[[[[[2.]]]]]]\n", &World::default());
        expect![[r#"
            brackets are nested deeper than 5 levels
              here: one level too many
              note: this control accepts 5 levels of brackets, including those of functions  [16-18C-T p.307]
              help: compute it in steps: assign an intermediate result to a variable
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
