//! A number with more digits than the control accepts.

use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, FileCx, Finding, Report, Run, limit};

declare_rule! {
    /// A number has more digits than the control accepts, before and after the decimal point together.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or drops digits. Post-processors that write six decimals cause it.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G1 X123.4567891 F100.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G1 X123.4567 F100.
    /// ```
    /// A control without limit:
    /// ```nc,quiet,linuxcnc
    /// G1 X123.4567891 F100.
    /// ```
    rule "too-many-digits" in "words" {
        summary: "number has more digits than the control accepts",
        severity: Error,
        tier: Program,
        control_specific: true,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

/// Blocks that are reported one by one; of more, only the first is reported.
const FEW: usize = 5;

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let Some(max) = cx.control().numbers().max_digits else { return };
    let blocks = &cx.file_index.long_numbers;
    let mut is_told = false;
    for block in blocks {
        cx.reread(block.clone(), |block| {
            let mut words = block.words().iter().filter(|word| significant(block, word) > u32::from(max));
            if let Some(word) = words.next()
                && !block.block().flags.contains(BlockFlags::ERROR)
            {
                is_told = true;
                report.add(finding(block, word, max, blocks.len()));
            }
        });
        if is_told && blocks.len() > FEW {
            return;
        }
    }
}

/// Digits without leading zeros: padding is harmless.
fn significant(cx: &BlockCx<'_>, word: &Word) -> u32 {
    if word.number().is_none() {
        return 0;
    }
    let digits = cx.text(word).bytes().filter(u8::is_ascii_digit);
    digits.skip_while(|digit| *digit == b'0').count() as u32
}

fn finding(cx: &BlockCx<'_>, word: &Word, max: u8, blocks: usize) -> Finding {
    let numbers = cx.control().numbers();
    let digits = significant(cx, word);
    let text = cx.text(word);
    let many = if blocks > FEW { format!(", and more in {} blocks", blocks - 1) } else { String::new() };
    Finding::new(&META, cx.range(word), format!("number with {digits} digits: `{text}`{many}"))
        .label(format!("{digits} digits, {max} at most"))
        .note(format!(
            "this control accepts {max} digits, before and after the decimal point together  [{}]",
            numbers.source
        ))
        .help("round the number to the resolution of the machine")
        .at_most(limit(numbers.max_digits_confidence.unwrap_or(numbers.confidence)))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn one_finding_a_block() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G1 X123.4567891 Y123.4567891 F100.\nG1 X[123.4567891]\nO00000000012\n",
            &expect![[r#"
                1 | G1 X123.4567891 Y123.4567891 F100.
                  |    ^^^^^^^^^^^^ warning[too-many-digits] number with 10 digits: `X123.4567891`
            "#]],
        );
    }

    #[test]
    fn a_whole_file_of_them_gets_one_finding() {
        let found = findings(&only(&RULE), "fanuc-mill", &"G1 X123.4567891\n".repeat(9), &World::default());
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].message, "number with 10 digits: `X123.4567891`, and more in 8 blocks");
    }

    #[test]
    fn other_controls_take_all_digits() {
        check_rule(&RULE, "linuxcnc", "G1 X123.4567891 F100.\n", &expect![[""]]);
    }

    #[test]
    fn words_name_the_limit() {
        let found = findings(&only(&RULE), "fanuc-mill", "G1 X123.4567891 Y123.4567891\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("here: 10 digits, 8 at most"), "{text}");
    }
}
