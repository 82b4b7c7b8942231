//! A code without any of the words of which it needs one.

use gcheck_controls::{Code, LetterSet, Motion};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::facts::word_sets::choice;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// A code needs at least one of several words, and the block has none of them.
    ///
    /// ## Why it matters
    /// The control cannot execute the code and stops with an alarm. For arcs, see `arc-without-centre`.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G38.2 F50.
    /// ```
    /// ```nc,reported,fanuc-mill
    /// M98 L2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G38.2 Z-10. F50.
    /// ```
    rule "word-choice-missing" in "words" {
        summary: "code without any of the words of which it needs one",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (word, code) in cx.codes() {
        for items in &code.entry().one_of {
            let letters = items.iter().fold(LetterSet::EMPTY, |set, item| set.or(LetterSet::of_item(item)));
            // Another rule reports arcs without a centre.
            if code.motion() == Motion::Arc && !letters.without(cx.control().axes()).is_empty() {
                continue;
            }
            if !cx.block().letters.intersects(letters) && cx.words_are_plain() {
                report.add(finding(cx, word, code, letters));
            }
        }
    }
}

fn finding(cx: &BlockCx<'_>, word: &Word, code: Code<'_>, letters: LetterSet) -> Finding {
    let (text, entry) = (cx.text(word), code.entry());
    let is_axes = letters
        .iter()
        .all(|letter| cx.control().letter(letter).is_some_and(|l| l.axis || !l.scaled && l.free));
    let missing = if is_axes { "an axis word".to_owned() } else { choice(letters) };
    Finding::new(&META, cx.range(word), format!("`{text}` without {missing}"))
        .label(format!("needs {}", choice(letters)))
        .note(format!(
            "`{}` ({}) needs one of these words in its block  [{}]",
            entry.code, entry.title, entry.source
        ))
        .help(format!("add {missing} to the block"))
        .alarm(cx.alarm_of(META.id, &entry.code))
        .at_most(limit(entry.choice_confidence.unwrap_or(entry.confidence)))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_probe_needs_a_direction() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G38.2 F50.\nG38.2 Z#1 F50.\nG92\n",
            &expect![[r#"
                1 | G38.2 F50.
                  | ^^^^^ error[word-choice-missing] `G38.2` without an axis word
                3 | G92
                  | ^^^ error[word-choice-missing] `G92` without an axis word
            "#]],
        );
    }

    #[test]
    fn a_call_needs_a_target() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "M98 L2\nM98 P1000\n",
            &expect![[r#"
                1 | M98 L2
                  | ^^^ error[word-choice-missing] `M98` without `P` or `Q`
            "#]],
        );
    }

    #[test]
    fn words_list_the_choice() {
        let found = findings(&only(&RULE), "fanuc-mill", "M98 L2\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("here: needs `P` or `Q`"), "{text}");
    }
}
