//! A sequence number above the highest that the control reads.

use gcheck_controls::Letter;
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, Severity};

declare_rule! {
    /// A sequence number is higher than the control reads.
    ///
    /// ## Why it matters
    /// The control refuses the block, or no manual says what it makes of the number.
    ///
    /// ## Reported
    /// ```nc,reported,grbl
    /// N10000010 G0 X1
    /// ```
    /// ## Not reported
    /// ```nc,quiet,grbl
    /// N10000 G0 X1
    /// ```
    /// A control without a known limit is not judged.
    /// ```nc,quiet,linuxcnc
    /// N10000010 G0 X1
    /// ```
    rule "sequence-number-too-high" in "program" {
        summary: "sequence number above the highest that the control reads",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::LABEL, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some(most) = cx.control().limits().max_sequence_number else { return };
    for word in cx.words().iter().filter(|word| word.letter == Letter::of('N')) {
        if word.number().is_some_and(|number| number > f64::from(most)) && cx.words_are_plain() {
            report.add(finding(cx, word, most));
        }
    }
}

fn finding(cx: &BlockCx<'_>, word: &Word, most: u32) -> Finding {
    let source = cx.control().limits().source.as_deref().map(|s| format!("  [{s}]")).unwrap_or_default();
    // What a control without an alarm of its own does with a higher number is not written anywhere.
    let is_refused = cx.control().alarm(META.id).is_some();
    let finding =
        Finding::new(&META, cx.range(word), format!("sequence number too high: `{}`", cx.text(word))).label(
            if is_refused { "the control refuses it" } else { "above the highest that the manual gives" },
        );
    let finding = if is_refused { finding } else { finding.at_most(Severity::Warning) };
    finding
        .note(format!("{} reads sequence numbers up to {most}{source}", cx.control().title()))
        .help("number the blocks again in smaller steps, or leave the numbers out")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_highest_number_is_read() {
        check_rule(
            &RULE,
            "grbl",
            "N10000000 G0 X1\nN10000001 X2\n",
            &expect![[r#"
                2 | N10000001 X2
                  | ^^^^^^^^^ error[sequence-number-too-high] sequence number too high: `N10000001`
            "#]],
        );
    }

    #[test]
    fn where_no_alarm_is_known_it_is_a_warning() {
        check_rule(
            &RULE,
            "tsnc-yh-a1m",
            "O1\nN9999 G0 X1.\nN10000 X2.\nM30\n",
            &expect![[r#"
                3 | N10000 X2.
                  | ^^^^^^ warning[sequence-number-too-high] sequence number too high: `N10000`
            "#]],
        );
    }
}
