//! A minus sign on a word that does not accept one.

use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::facts::computed_words::sign_confidence;
use crate::{BlockCx, Finding, Fix, Reads, Report, Run, WordFacts, limit};

declare_rule! {
    /// A word has a minus sign that it does not accept.
    ///
    /// ## Why it matters
    /// Feeds, speeds, tools and offsets count from zero. The control stops with an alarm, or uses another value.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G1 X1. F-100.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G1 X-1. F100.
    /// ```
    /// An argument of a macro may have any value.
    /// ```nc,quiet,fanuc-mill
    /// G65 P9010 F-1. H-2.
    /// ```
    rule "sign-not-accepted" in "words" {
        summary: "minus sign on a word that does not accept one",
        severity: Error,
        tier: Block,
        control_specific: true,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::NEGATIVE, reads: Reads::Numbers, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if !cx.words_are_plain() {
        return;
    }
    for word in cx.words() {
        if let Some(facts) = cx.facts(word)
            // Another rule judges computed values.
            && !word.is_computed()
            && word.number().is_some_and(|value| value < 0.0)
            && !facts.negative
            && facts.min.is_none_or(|min| min >= 0.0)
        {
            report.add(finding(cx, word, &facts));
        }
    }
}

fn finding(cx: &BlockCx<'_>, word: &Word, facts: &WordFacts<'_>) -> Finding {
    Finding::new(&META, cx.range(word), format!("minus sign on `{}`", cx.text(word)))
        .label(facts.is)
        .note(format!("`{}` does not accept a minus sign  [{}]", word.letter, facts.source))
        .help("remove the sign, or correct the address")
        .fix_if(unsigned(cx, word))
        .at_most(limit(sign_confidence(cx.control(), word.letter, facts)))
}

/// The word without its sign: a written number, not an expression.
fn unsigned(cx: &BlockCx<'_>, word: &Word) -> Option<Fix> {
    let text = cx.text(word);
    let (letter, number) = text.split_once('-')?;
    let is_number = number.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    let written = format!("{letter}{number}");
    is_number.then(|| Fix::risky(format!("write `{text}` as `{written}`"), cx.range(word), written))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn feeds_and_tools_count_from_zero() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G1 X-1. F-100.\nT-1 M6\nG1 F-#1\n",
            &expect![[r#"
                1 | G1 X-1. F-100.
                  |         ^^^^^^ error[sign-not-accepted] minus sign on `F-100.`
                2 | T-1 M6
                  | ^^^ error[sign-not-accepted] minus sign on `T-1`
            "#]],
        );
    }

    #[test]
    fn nothing_below_zero_is_no_sign() {
        check_rule(&RULE, "linuxcnc", "G1 X-1. F100.\nM3 $-1 S100\n", &expect![[""]]);
    }

    #[test]
    fn words_name_the_address() {
        let found = findings(&only(&RULE), "linuxcnc", "G1 X1. F-100.\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("note: `F` does not accept a minus sign"), "{text}");
    }
}
