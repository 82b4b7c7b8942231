//! One code written twice in a block.

use gcheck_controls::{Code, Handling};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Reads, Report, Run, Severity, limit};

declare_rule! {
    /// The same code is written twice in one block.
    ///
    /// ## Why it matters
    /// Some controls refuse it like two codes of one modal group. On others it has no effect, but it hides a mistake:
    /// often one of the two should be another code.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G90 G0 G90 X1.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G90 G0 X1.
    /// G90 G1 X2. F100.
    /// ```
    rule "code-given-twice" in "modal" {
        summary: "code written twice in a block",
        severity: Error,
        tier: Block,
        fixable: Safely,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (ix, (second, code)) in cx.codes().enumerate() {
        let Some((first, _)) = cx.codes().take(ix).find(|(_, other)| other.number() == code.number()) else {
            continue;
        };
        // If words are written twice as well, two blocks are in one line; another rule reports that.
        let quiet = BlockFlags::ERROR.union(BlockFlags::REPEATED);
        if !cx.block().flags.intersects(quiet) && !code.is_user() && !cx.words_may_be_arguments() {
            report.add(finding(cx, code, first, second));
        }
    }
}

fn finding(cx: &BlockCx<'_>, code: Code<'_>, first: &Word, second: &Word) -> Finding {
    let rules = cx.control().block_rules();
    let text = cx.text(second);
    let finding = Finding::new(&META, cx.range(second), format!("`{text}` twice in one block"))
        .label(format!("{}, again", code.entry().title))
        .also(cx.range(first), "is already here")
        .help(format!("remove one `{text}`, or write the code that was meant"));
    let finding = if rules.code_twice == Handling::Refused && code.group().exclusive {
        finding
            .note(format!("this control refuses a block with one code twice  [{}]", rules.source))
            .at_most(limit(rules.confidence))
    } else {
        finding.at_most(Severity::Hint)
    };
    // A mode that is already set does not change. Stops have a group of their own and are not modes: two may be meant as two.
    let is_stop = code.effect().stops_program();
    if code.group().modal && code.group().exclusive && !is_stop {
        finding.fix(Fix::safe(format!("remove the second `{text}`"), cx.with_blanks(second), ""))
    } else {
        finding
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only, words};

    #[test]
    fn where_it_is_refused_it_is_an_error() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G90 G0 G90 X#1\nM8 M8\n",
            &expect![[r#"
                1 | G90 G0 G90 X#1
                  |        ^^^ error[code-given-twice] `G90` twice in one block
                2 | M8 M8
                  |    ^^ error[code-given-twice] `M8` twice in one block
            "#]],
        );
    }

    #[test]
    fn elsewhere_it_is_a_hint() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G0 G90 X1.\nG90 G54 G0 X1.\n",
            &expect![[r#"
                1 | G90 G0 G90 X1.
                  |        ^^^ hint[code-given-twice] `G90` twice in one block
            "#]],
        );
    }

    #[test]
    fn the_fix_takes_the_second_away() {
        let program = "G90 G0 G90 X1.\n";
        let found = findings(&only(&RULE), "fanuc-mill", program, &World::default());
        expect![[r#"
            G90 G0 X1.
        "#]]
        .assert_eq(&fixed(program, &found[0]));
        assert!(words(&found[0]).contains("help: remove one `G90`"));
        // The machine may stop twice.
        let found = findings(&only(&RULE), "linuxcnc", "M0M0\n", &World::default());
        assert!(found[0].fixes.is_empty(), "{}", words(&found[0]));
    }
}
