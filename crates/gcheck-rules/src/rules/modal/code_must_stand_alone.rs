//! A code that needs a block of its own.

use gcheck_controls::Code;
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// A code that must be alone in its block shares it with another code.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or takes the words of the other code as its own.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G101 X0. G90
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// N20 G101 X0.
    /// ```
    rule "code-must-stand-alone" in "modal" {
        summary: "code that needs a block of its own shares one",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (word, code) in cx.codes().filter(|(_, code)| code.entry().alone) {
        if let Some(other) =
            cx.code_words().find(|other| other.range() != word.range() && other.code != word.code)
            && !cx.block().flags.contains(BlockFlags::ERROR)
            && !cx.words_may_be_arguments()
        {
            report.add(finding(cx, (word, code), other));
        }
    }
}

fn finding(cx: &BlockCx<'_>, alone: (&Word, Code<'_>), other: &Word) -> Finding {
    let entry = alone.1.entry();
    Finding::new(
        &META,
        cx.range(alone.0),
        format!("`{}` shares its block with `{}`", cx.text(alone.0), cx.text(other)),
    )
    .label(format!("{}: needs a block of its own", entry.title))
    .also(cx.range(other), "another code")
    .note(format!("`{}` must be the only code of its block  [{}]", entry.code, entry.source))
    .help("put the other code in a block of its own")
    .at_most(limit(entry.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_lone_code_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G101 X#1\nN10 G101 Y0.\n",
            &expect![[r#"
                1 | G90 G101 X#1
                  |     ^^^^ error[code-must-stand-alone] `G101` shares its block with `G90`
            "#]],
        );
    }

    #[test]
    fn no_such_code_no_finding() {
        check_rule(&RULE, "linuxcnc", "G90 G0 X1.\n", &expect![[""]]);
    }

    #[test]
    fn words_name_the_code() {
        let found = findings(&only(&RULE), "haas-mill", "G90 G101 X0.\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("there: another code"), "{text}");
    }
}
