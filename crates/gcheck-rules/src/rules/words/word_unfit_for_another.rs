//! A word that does not go with the value of another word of its block.

use gcheck_controls::{Beside, Code, Letter, WordEntry};
use gcheck_program::{Value, Word};

use crate::declare::declare_rule;
use crate::facts::beside::{Unfit, given, number, unfit};
use crate::facts::callers::CallerValues;
use crate::facts::computed_words::bounds_of;
use crate::{Finding, PathCx, PathRule, Report, Run, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// The value of one word decides what another word of the block may be, and it is something else: an offset number that
    /// this form of the code does not have, a word that belongs to another form, a wait without a longest time.
    ///
    /// Values may be written or computed.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block. A word of another form shows that the programmer meant that form.
    ///
    /// ## Reported
    /// There are nine work coordinate systems.
    /// ```nc,reported,linuxcnc
    /// G10 L2 P10 X1
    /// M2
    /// ```
    /// A rotation belongs to `L2`.
    /// ```nc,reported,linuxcnc
    /// #1=20
    /// G10 L#1 P1 X1 R30
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G10 L2 P9 X1 R30
    /// G10 L1 P10 Z1
    /// M66 P0 L3 Q4
    /// M2
    /// ```
    rule "word-unfit-for-another" in "words" {
        summary: "word that does not go with the value of another word",
        severity: Error,
        tier: Path,
        control_specific: true,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ALL_BLOCKS, make: || Box::new(WordUnfitForAnother::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct WordUnfitForAnother {
    callers: CallerValues,
}

remembers!(WordUnfitForAnother);

impl PathRule for WordUnfitForAnother {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.callers.see(cx);
        if cx.is_malformed() {
            return;
        }
        let is_told = |cx: &PathCx<'_>, letter| !is_computed(cx, letter) || !self.callers.may_decide(cx);
        for ix in cx.codes().iter() {
            let Some(code) = cx.control().code_at(*ix).filter(|code| !code.entry().any_words) else {
                continue;
            };
            let depends = |entry: &&WordEntry| !entry.beside.is_empty() || !entry.required_with.is_empty();
            for entry in code.entry().words.iter().filter(depends) {
                let Some(letter) = Letter::parse(&entry.letter) else { continue };
                if let Some((other, finding)) = judged(cx, code, entry, letter)
                    && is_told(cx, letter)
                    && is_told(cx, other)
                {
                    report.add(finding);
                }
            }
        }
    }
}

/// What is wrong with the word of an entry, and the word that decides it.
fn judged(cx: &PathCx<'_>, code: Code<'_>, entry: &WordEntry, letter: Letter) -> Option<(Letter, Finding)> {
    let word = cx.origin().letters.contains(letter);
    if let Some(Unfit { beside, item, other, outside }) = unfit(cx, entry, letter) {
        let finding = match outside {
            None => refused(cx, code, entry, letter, item),
            Some((value, side)) => out_of_range(cx, code, entry, (letter, value), beside, (item, side)),
        };
        return Some((other, finding));
    }
    // Where both are written, a rule that reads the block alone reports it.
    let (item, other) = entry.required_with.iter().find_map(|item| Some((item, given(cx, item)?)))?;
    (!word && is_computed(cx, other)).then(|| (other, missing(cx, code, entry, item)))
}

fn is_computed(cx: &PathCx<'_>, letter: Letter) -> bool {
    cx.has_word(|word| word.letter == letter && matches!(word.value, Value::Expr(_)))
}

fn range(cx: &PathCx<'_>, letter: Letter) -> std::ops::Range<u32> {
    cx.word_range(|word: &Word| word.letter == letter)
}

/// The word as written, or with its computed value.
fn shown(cx: &PathCx<'_>, letter: Letter) -> String {
    let computed = number(cx, letter).filter(|_| is_computed(cx, letter));
    let file = cx.program.file(cx.origin().at.file);
    match (computed, file) {
        (Some(value), _) => format!("{letter}{value}"),
        (None, Some(file)) if cx.origin().at.file == 0 => file.loaded.slice(range(cx, letter)).to_owned(),
        (None, _) => letter.to_string(),
    }
}

fn refused(cx: &PathCx<'_>, code: Code<'_>, entry: &WordEntry, letter: Letter, item: &str) -> Finding {
    let of = &code.entry().code;
    let text = shown(cx, letter);
    let finding = cx
        .finding(&META, range(cx, letter), format!("`{text}` does not go with `{item}` of `{of}`"))
        .label(entry.is.as_str())
        .note(format!(
            "`{of}` ({}) does not take `{letter}` beside `{item}`  [{}]",
            code.entry().title,
            code.entry().source
        ))
        .help(format!("remove `{letter}`, or correct `{item}`"));
    limited(cx, finding, code, entry)
}

fn out_of_range(
    cx: &PathCx<'_>,
    code: Code<'_>,
    entry: &WordEntry,
    (letter, value): (Letter, f64),
    beside: &Beside,
    (item, side): (&str, &str),
) -> Finding {
    let of = &code.entry().code;
    let takes = bounds_of(beside.min, beside.above, beside.max).unwrap_or_default();
    let finding = cx
        .finding(
            &META,
            range(cx, letter),
            format!("value too {side} beside `{item}` of `{of}`: `{letter}{value}`"),
        )
        .label(entry.is.as_str())
        .note(format!("beside `{item}`, `{letter}` of `{of}` takes {takes}  [{}]", code.entry().source))
        .help(format!("correct `{letter}`, or `{item}`"));
    limited(cx, finding, code, entry)
}

fn missing(cx: &PathCx<'_>, code: Code<'_>, entry: &WordEntry, item: &str) -> Finding {
    let (of, letter) = (&code.entry().code, &entry.letter);
    let is_code =
        |word: &Word| cx.control().code_at(word.code).is_some_and(|own| own.number() == code.number());
    let finding = cx
        .finding(&META, cx.word_range(is_code), format!("`{of}` without `{letter}` beside `{item}`"))
        .label(format!("needs `{letter}`: {}", entry.is))
        .note(format!(
            "`{of}` ({}) needs `{letter}` beside `{item}`  [{}]",
            code.entry().title,
            code.entry().source
        ))
        .help(format!("add `{letter}` to the block"));
    limited(cx, finding, code, entry)
}

fn limited(cx: &PathCx<'_>, finding: Finding, code: Code<'_>, entry: &WordEntry) -> Finding {
    let confidence = entry.range_confidence.or(entry.confidence).unwrap_or(code.entry().confidence);
    let finding = finding.at_most(limit(confidence));
    finding.at_most(cx.environment.most_for_this_control())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn offsets_and_the_words_of_their_form() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G10 L2 P10 X1\nG10 L1 P0 Z1\nG10 L20 P1 X1 R30\nG10 L2 P1 X1 I3\nG10 L1 P1 Z1 Q12\nG10 L2 P0 X1 R30\n\
             G10 L1 P1 R3 I3 J3 Q9\nM2\n",
            &expect![[r#"
                1 | G10 L2 P10 X1
                  |        ^^^ error[word-unfit-for-another] value too large beside `L2` of `G10`: `P10`
                2 | G10 L1 P0 Z1
                  |        ^^ error[word-unfit-for-another] value too small beside `L1` of `G10`: `P0`
                3 | G10 L20 P1 X1 R30
                  |               ^^^ error[word-unfit-for-another] `R30` does not go with `L20` of `G10`
                4 | G10 L2 P1 X1 I3
                  |              ^^ error[word-unfit-for-another] `I3` does not go with `L2` of `G10`
                5 | G10 L1 P1 Z1 Q12
                  |              ^^^ error[word-unfit-for-another] value too large beside `L1` of `G10`: `Q12`
            "#]],
        );
    }

    #[test]
    fn waits_for_an_input() {
        check_rule(
            &RULE,
            "linuxcnc",
            "M66 P1 L3 Q0\nM66 E1 L3 Q1\nM66 E1 L0\nM66 P1 L0 Q0\nM66 P1 Q0\nM2\n",
            &expect![[r#"
                1 | M66 P1 L3 Q0
                  |           ^^ error[word-unfit-for-another] value too small beside `L3` of `M66`: `Q0`
                2 | M66 E1 L3 Q1
                  |     ^^ error[word-unfit-for-another] `E1` does not go with `L3` of `M66`
            "#]],
        );
    }

    #[test]
    fn computed_values_count() {
        check_rule(
            &RULE,
            "linuxcnc",
            "#1=2\n#2=10\nG10 L#1 P#2 X1\n#3=3\nM66 P1 L#3\nG10 L#1 P[#2-1] X1\nM2\n",
            &expect![[r#"
                3 | G10 L#1 P#2 X1
                  |         ^^^ error[word-unfit-for-another] value too large beside `L2` of `G10`: `P10`
                5 | M66 P1 L#3
                  | ^^^ error[word-unfit-for-another] `M66` without `Q` beside `L3`
            "#]],
        );
    }

    #[test]
    fn a_value_that_a_caller_gives_is_left_alone() {
        check_rule(&RULE, "linuxcnc", "o1 sub\nG10 L2 P#1 X1\no1 endsub\nM2\n", &expect![[""]]);
    }

    #[test]
    fn what_is_said() {
        let found = findings(&only(&RULE), "linuxcnc", "G10 L20 P1 X1 R30\nM2\n", &World::default());
        expect![[r#"
            `R30` does not go with `L20` of `G10`
              here: tool radius (L1, L10, L11), or rotation about Z in degrees (L2)
              note: `G10` (write offsets) does not take `R` beside `L20`  [LCNC-G; RS274-2.9]
              help: remove `R`, or correct `L20`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
