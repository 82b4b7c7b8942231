//! A dwell time in a word from which this control does not read it.

use gcheck_controls::{Code, Confidence, DwellWord, Letter};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::facts::dwell::{time_in_other_word, time_words};
use crate::facts::word_sets::choice;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// A dwell gives its time in a word from which other controls read it, `G4 X2.`, and this control does not.
    ///
    /// ## Why it matters
    /// The dwell has no time, and the word is an axis word: at best the control stops with an alarm, at worst it moves there.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G4 X2.
    /// ```
    /// ```nc,reported,haas-mill
    /// G4 U0.5
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G4 P2.
    /// ```
    /// ```nc,quiet,generic-mill
    /// G4 X2.
    /// G4 U0.5
    /// ```
    rule "dwell-time-in-other-word" in "words" {
        summary: "dwell time in a word from which this control does not read it",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Numbers, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (_, code) in cx.codes() {
        if let Some(word) = time_in_other_word(cx, code) {
            report.add(finding(cx, code, word));
        }
    }
}

fn finding(cx: &BlockCx<'_>, code: Code<'_>, word: &Word) -> Finding {
    let entry = code.entry();
    let times = time_words(cx);
    let of_times =
        |w: &&gcheck_controls::WordEntry| Letter::parse(&w.letter).is_some_and(|l| times.contains(l));
    let confidence = entry.words.iter().filter(of_times).filter_map(|w| w.confidence).min();
    let letter = word.letter;
    let own = choice(times);
    let units = cx.control().semantics().dwell.values().copied().map(unit).next().unwrap_or_default();
    Finding::new(
        &META,
        cx.range(word),
        format!("`{}` is not a dwell time on this control (`{}`)", cx.text(word), cx.written(code)),
    )
    .label("only other controls read a time here")
    .note(format!(
        "`{}` ({}) reads its time from {own}, {units}  [{}]",
        entry.code, entry.title, entry.source
    ))
    .help(format!("give the time in {own}; `{letter}` is an axis word"))
    .at_most(limit(entry.confidence.min(confidence.unwrap_or(Confidence::Manual))))
}

fn unit(word: DwellWord) -> &'static str {
    match word {
        DwellWord::Seconds => "in seconds",
        DwellWord::Milliseconds => "in milliseconds",
        DwellWord::SecondsOrMilliseconds => "in seconds with a decimal point, in milliseconds without",
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G4 X2.\nG04 U#1\nG4 P1. X2.\nG4\nG1 G4 X5. F100.\nG4 X1. Y2.\n",
            &expect![[r#"
                1 | G4 X2.
                  |    ^^^ error[dwell-time-in-other-word] `X2.` is not a dwell time on this control (`G4`)
                2 | G04 U#1
                  |     ^^^ error[dwell-time-in-other-word] `U#1` is not a dwell time on this control (`G04`)
            "#]],
        );
    }

    #[test]
    fn what_is_only_assumed_of_the_time_is_a_warning() {
        check_rule(
            &RULE,
            "haas-mill",
            "G4 X2.\nG4 X2\n",
            &expect![[r#"
            1 | G4 X2.
              |    ^^^ warning[dwell-time-in-other-word] `X2.` is not a dwell time on this control (`G4`)
            2 | G4 X2
              |    ^^ warning[dwell-time-in-other-word] `X2` is not a dwell time on this control (`G4`)
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", "G4 X2.\nG4 U2.\nG4 P2000\n", &expect![[""]]);
    }

    #[test]
    fn words_say_where_the_time_belongs() {
        let found = findings(&only(&RULE), "haas-lathe", "G4 U2.\n", &World::default());
        expect![[r#"
            `U2.` is not a dwell time on this control (`G4`)
              here: only other controls read a time here
              note: `G4` (dwell) reads its time from `P`, in seconds with a decimal point, in milliseconds without  [TABLE; HM17 p.258; AP25]
              help: give the time in `P`; `U` is an axis word
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
