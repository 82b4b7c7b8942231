//! A call with more arguments than the control passes on.

use gcheck_program::{BlockFlags, OKeyword, StatementKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A subroutine is called with more arguments than the control has parameters to pass them in.
    ///
    /// ## Why it matters
    /// The control stops with an error at the call.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// o1 sub
    /// G0 X#1
    /// o1 endsub
    /// o1 call [1][2][3][4][5][6][7][8][9][10][11][12][13][14][15][16][17][18][19][20][21][22][23][24][25][26][27][28][29][30][31]
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// o1 sub
    /// G0 X#1
    /// o1 endsub
    /// o1 call [1][2][3]
    /// M2
    /// ```
    rule "too-many-arguments" in "macros" {
        summary: "call with more arguments than the control passes on",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let [first, last] = cx.control().semantics().locals;
    let most = (last + 1).saturating_sub(first) as usize;
    for statement in cx.statements() {
        let StatementKind::OWord { label, keyword: OKeyword::Call, arguments } = &statement.kind else {
            continue;
        };
        let skipped = label.expressions();
        let mut given = StatementKind::arguments(arguments).skip(skipped);
        let count = arguments.len() - skipped.min(arguments.len());
        let Some(over) = given.nth(most) else { continue };
        let range = cx.in_file(cx.table().expr(over).range.clone());
        report.add(
            Finding::new(&META, range, format!("{count} arguments in a call"))
                .label(format!("one too many: {most} arguments at most"))
                .note(format!("arguments go into `#{first}` to `#{last}` of the subroutine"))
                .help("pass the rest in variables that the subroutine and its caller share"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_over_the_limit_is_marked() {
        let call = |count: usize| {
            let arguments: String = (1..=count).map(|n| format!("[{n}]")).collect();
            format!("o1 sub\no1 endsub\no1 call {arguments}\nM2\n")
        };
        check_rule(
            &RULE,
            "linuxcnc",
            &call(32),
            &expect![[r#"
            3 | o1 call [1][2][3][4][5][6][7][8][9][10][11][12][13][14][15][16][17][18][19][20][21][22][23][24][25][26][27][28][29][30][31][32]
              |                                                                                                                        ^^^^ error[too-many-arguments] 32 arguments in a call
        "#]],
        );
        check_rule(&RULE, "linuxcnc", &call(30), &expect![[""]]);
    }
}
