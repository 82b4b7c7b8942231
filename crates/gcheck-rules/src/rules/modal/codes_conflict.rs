//! Two codes that cannot share a block.

use gcheck_controls::{Code, CodeNumber};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// The control does not accept these two codes in one block, though their modal groups differ.
    ///
    /// ## Why it matters
    /// Both may use the same axis words, or one changes what the other uses. The control stops with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G0 G28 Z0
    /// ```
    /// ```nc,reported,haas-mill
    /// G41 G2 X1. Y1. R1. D1
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 G28 Z0.
    /// ```
    rule "codes-conflict" in "modal" {
        summary: "codes that cannot share a block",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (ix, (second, code)) in cx.codes().enumerate() {
        let clash = cx.codes().take(ix).find(|(_, earlier)| {
            let same_group = earlier.group_ix() == code.group_ix() && code.group().exclusive;
            !same_group && (excludes(*earlier, code) || excludes(code, *earlier))
        });
        if let Some((first, other)) = clash
            && !cx.words_may_be_arguments()
        {
            report.add(finding(cx, (first, other), (second, code)));
        }
    }
}

/// Does the data of `code` name `other`, by number or by group?
fn excludes(code: Code<'_>, other: Code<'_>) -> bool {
    code.entry().conflicts.iter().any(|item| match item.strip_prefix('@') {
        Some(group) => other.group().id == group,
        None => CodeNumber::parse(item) == Some(other.number()),
    })
}

fn finding(cx: &BlockCx<'_>, first: (&Word, Code<'_>), second: (&Word, Code<'_>)) -> Finding {
    let (a, b) = (cx.text(first.0), cx.text(second.0));
    let by = if excludes(first.1, second.1) { first.1 } else { second.1 };
    let is_later = by.number() == second.1.number();
    let by = by.entry();
    let finding = Finding::new(&META, cx.range(second.0), format!("`{a}` and `{b}` cannot share a block"))
        .label(second.1.entry().title.as_str())
        .also(cx.range(first.0), first.1.entry().title.as_str());
    if by.conflicts_when_later && !is_later {
        return finding
            .note(format!(
                "the control refuses the codes in the other order, and loses one of them in this one  [{}]",
                by.source
            ))
            .help("put the two codes in separate blocks")
            .at_most(crate::Severity::Warning)
            .at_most(limit(by.confidence));
    }
    finding
        .note(format!(
            "`{}` ({}) cannot be in a block with the other code  [{}]",
            by.code, by.title, by.source
        ))
        .help("put the two codes in separate blocks")
        .alarm(cx.alarm_of(META.id, &by.code))
        .at_most(limit(by.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_second_code_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 G28 Z#1\nG53 G0 X1.\nG53 G2 X1. R1.\nG80 G28 Z0\n",
            &expect![[r#"
                1 | G0 G28 Z#1
                  |    ^^^ error[codes-conflict] `G0` and `G28` cannot share a block
                3 | G53 G2 X1. R1.
                  |     ^^ error[codes-conflict] `G53` and `G2` cannot share a block
            "#]],
        );
    }

    #[test]
    fn another_control_takes_them() {
        check_rule(&RULE, "haas-mill", "G0 G28 Z0.\nG91 G28 G0 Z0.\n", &expect![[""]]);
    }

    #[test]
    fn words_name_both() {
        let found = findings(&only(&RULE), "haas-mill", "G41 G2 X1. R1. D1\n", &World::default());
        let text = words(&found[0]);
        assert!(text.starts_with("`G41` and `G2` cannot share a block\n"), "{text}");
    }
}
