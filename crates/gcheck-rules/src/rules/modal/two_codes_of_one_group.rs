//! Two codes of one modal group in a block.

use gcheck_controls::{Code, Handling};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, Severity, limit};

declare_rule! {
    /// Two codes of one modal group are in the same block.
    ///
    /// ## Why it matters
    /// Only one code of a group can be active. Some controls refuse the block, others silently use the last code, so
    /// the same program moves differently on the next machine.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G0 G1 X1. F100
    /// ```
    /// ## Not reported
    /// Codes of different groups share a block.
    /// ```nc,quiet,linuxcnc
    /// G90 G0 X1.
    /// ```
    /// Codes whose group depends on the set of codes that a lathe is set to:
    /// ```nc,quiet,fanuc-lathe
    /// G18 G20 G40 G80 G90 G99
    /// G90 G1 X10. F0.2
    /// ```
    rule "two-codes-of-one-group" in "modal" {
        summary: "two codes of one modal group in a block",
        severity: Error,
        tier: Block,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (ix, (second, code)) in cx.codes().enumerate() {
        let earlier = cx.codes().take(ix).find(|(_, other)| other.group_ix() == code.group_ix());
        // Another rule reports the same code twice, so the second one makes no second pair.
        let is_again = cx.codes().take(ix).any(|(_, other)| other.number() == code.number());
        if let Some((first, other)) = earlier
            && code.group().exclusive
            && !is_again
            && other.number() != code.number()
            && !cx.words_may_be_arguments()
            && !depends(cx, code)
            && !depends(cx, other)
        {
            report.add(finding(cx, (first, other), (second, code)).fix_if(cx.block_from(second)));
        }
    }
}

/// Another set of codes, which a setting chooses, may put the code into another group.
fn depends(cx: &BlockCx<'_>, code: Code<'_>) -> bool {
    cx.control().code_list().depends_on_setting(code.number())
}

fn finding(cx: &BlockCx<'_>, first: (&Word, Code<'_>), second: (&Word, Code<'_>)) -> Finding {
    let group = second.1.group();
    let number = group.number.as_ref().map(|n| format!(" (group {n})")).unwrap_or_default();
    let (a, b) = (cx.text(first.0), cx.text(second.0));
    let (does, severity) = match cx.control().block_rules().two_of_a_group {
        Handling::Refused => ("only one can be active".to_owned(), Severity::Error),
        Handling::LastWins | Handling::Ignored | Handling::Accepted => {
            (format!("`{b}`, the last one, counts"), Severity::Warning)
        }
    };
    let alarm = cx.alarm_of(META.id, &first.1.entry().code);
    // Two codes that raise different alarms raise that of the group.
    let alarm = alarm.filter(|alarm| cx.alarm_of(META.id, &second.1.entry().code).as_ref() == Some(alarm));
    Finding::new(&META, cx.range(second.0), format!("`{a}` and `{b}` belong to one modal group"))
        .alarm(alarm)
        .label(format!("{}, the same group", second.1.entry().title))
        .also(cx.range(first.0), first.1.entry().title.as_str())
        .note(format!("`{a}` and `{b}` both set {}{number}; {does}  [{}]", group.title, group.source))
        .help("keep one of the two, or put them in separate blocks")
        .at_most(limit(group.confidence))
        .at_most(severity)
        .at_most(if second.1.is_user() || first.1.is_user() { Severity::Info } else { Severity::Error })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

    #[test]
    fn the_second_code_gets_a_block_of_its_own() {
        let split = |text: &str| {
            let found = findings(&only(&RULE), "fanuc-mill", text, &World::default());
            let fix = found.first()?.fixes.first()?.clone();
            let range = fix.edits[0].range.start as usize..fix.edits[0].range.end as usize;
            let mut text = text.to_owned();
            text.replace_range(range, &fix.edits[0].text);
            Some(text)
        };
        assert_eq!(
            split("G0 X1. Y1. G1 Z-1. F5.\r\nM30\r\n").as_deref(),
            Some("G0 X1. Y1.\r\nG1 Z-1. F5.\r\nM30\r\n")
        );
        assert_eq!(split("G90G0G1X1.\n").as_deref(), Some("G90G0\nG1X1.\n"));
        assert_eq!(split("/G0 G1 X1.\n"), None);
    }

    #[test]
    fn the_second_code_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G90 G1 G0 X1. F100\n",
            &expect![[r#"
                1 | G90 G1 G0 X1. F100
                  |        ^^ error[two-codes-of-one-group] `G1` and `G0` belong to one modal group
            "#]],
        );
    }

    #[test]
    fn a_control_that_takes_the_last_gives_a_warning() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G0 G1 X1. F#1\nG80 G0 X1.\n",
            &expect![[r#"
                1 | G0 G1 X1. F#1
                  |    ^^ warning[two-codes-of-one-group] `G0` and `G1` belong to one modal group
            "#]],
        );
    }

    #[test]
    fn a_pair_is_one_finding_however_often_its_codes_are_written() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G0 G28 G91 G90 G90\n",
            &expect![[r#"
                1 | G0 G28 G91 G90 G90
                  |            ^^^ warning[two-codes-of-one-group] `G91` and `G90` belong to one modal group
            "#]],
        );
    }

    #[test]
    fn the_same_code_twice_is_another_matter() {
        check_rule(&RULE, "linuxcnc", "G90 G1 G90 X1. F100\n", &expect![[""]]);
    }
}
