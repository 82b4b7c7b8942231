//! A code that relies on a word that one of the ways to it does not give.

use std::ops::Range;

use gcheck_controls::{Code, Effect, Letter, LetterSet};

use crate::declare::declare_rule;
use crate::facts::lasting::{goes_by_way, relied_on};
use crate::{PathCx, PathRule, Remembers, Report, Run, Severity, Uses, Watch, remembers};

declare_rule! {
    /// A code needs a word that may be in an earlier block. An earlier block has the word, but on one way to the code that
    /// block does not run: it has a block delete, or a jump passes it.
    ///
    /// The same is so for a length that was cancelled: whether its number (`H`) counts after that is in no manual.
    ///
    /// `lasting-word-never-given` reports a word that no block gives; other rules report a feed, a speed, a tool and the
    /// size of cutter compensation.
    ///
    /// ## Why it matters
    /// On that way the control uses the number that the last program left: the length of another tool. The tool stops
    /// too high, or is driven into the part.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54
    /// T1 M6
    /// /H1
    /// G43 Z1.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G20 G90 G54
    /// T1 M6
    /// G43 H1 Z1.
    /// G53 G49 Z0.
    /// T2 M6
    /// G43 Z1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54
    /// T1 M6
    /// /G0 X0. Y0.
    /// G43 H1 Z1.
    /// M30
    /// ```
    rule "lasting-word-on-one-way" in "words" {
        summary: "code relies on a word that not every way to it gives",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ALL_BLOCKS, make: || Box::new(LastingWordOnOneWay::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct LastingWordOnOneWay {
    /// Words that blocks of this way gave.
    given: LetterSet,
    /// Words whose mode was cancelled since they were given.
    ended: LetterSet,
    /// Words that have been reported.
    told: LetterSet,
}

/// The word that a cancelled length leaves open.
const LENGTH: Letter = Letter::of('H');

remembers!(LastingWordOnOneWay);

impl PathRule for LastingWordOnOneWay {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let control = program.environment.control();
        let codes = program.file_index.codes.iter().filter_map(|(number, _)| control.code(*number));
        !program.file_index.is_called_from_elsewhere()
            && codes.into_iter().any(|code| !relied_on(program.environment.control(), code).is_empty())
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let before = self.given.or(self.told);
        let own = cx.origin().letters;
        for letter in own.iter().filter(|letter| cx.word(char::from(letter.ascii())).is_some()) {
            self.given.insert(letter);
            self.ended = self.ended.without([letter].into_iter().collect());
        }
        let is_zero = own.contains(LENGTH) && cx.known_number('H') == Some(0.0);
        // A block that cancels and gives a number gives it for later.
        let cancels = !own.contains(LENGTH) && cx.has_effect(|effect| effect == Effect::LengthOff);
        let is_cancelled = is_zero || cancels;
        if is_cancelled && self.given.contains(LENGTH) {
            self.ended.insert(LENGTH);
        }
        if cx.is_malformed() || cx.is_called_only() || cx.is_after_unknown_program() {
            return;
        }
        for ix in cx.codes().iter() {
            let Some(code) = cx.control().code_at(*ix) else { continue };
            let relied_on = relied_on(cx.control(), code).without(own);
            let range = || cx.word_range(|word| word.code == *ix);
            for letter in relied_on.and(self.ended).without(self.told).iter() {
                self.told.insert(letter);
                tell_ended(cx, code, letter, range(), report);
            }
            for letter in relied_on.without(before).iter() {
                let is_named = cx.file_index.never_given.iter().any(|missing| missing.letter == letter);
                if !is_named || goes_by_way(cx.file_index, cx.control(), code, letter) {
                    self.told.insert(letter);
                    tell(cx, code, letter, range(), report);
                }
            }
        }
    }
}

fn tell_ended(cx: &PathCx<'_>, code: Code<'_>, letter: Letter, range: Range<u32>, report: &mut Report<'_>) {
    let entry = code.entry();
    let finding = cx
        .finding(
            &META,
            range,
            format!("`{}` without `{letter}`, after the one before was cancelled", entry.code),
        )
        .label(format!("which `{letter}` counts here, the manual does not say"))
        .note(format!(
            "`{}` ({}) takes its number from `{letter}`  [{}]",
            entry.code, entry.title, entry.source
        ))
        .help(format!("add `{letter}` to the block"));
    report.add(cx.with_path(finding));
}

fn tell(cx: &PathCx<'_>, code: Code<'_>, letter: Letter, range: Range<u32>, report: &mut Report<'_>) {
    let entry = code.entry();
    let word = entry.words.iter().find(|word| Letter::parse(&word.letter) == Some(letter));
    // The data go on with details.
    let is = word.and_then(|word| word.is.split([',', ';']).next()).unwrap_or("the number");
    let finding = cx
        .finding(
            &META,
            range,
            format!("`{}` without `{letter}`, which no block on the way here gives", entry.code),
        )
        .label(format!("{is} is what the last program left"))
        .note(format!("`{}` ({}) uses the last `{letter}`  [{}]", entry.code, entry.title, entry.source))
        .help(format!("add `{letter}` to the block"))
        .at_most(Severity::Warning);
    report.add(cx.with_path(finding));
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_jump_over_the_word_is_found() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54\nT1 M6\nIF [#500 EQ 1] GOTO 10\nH1\nN10 G43 Z1.\nG43 Z2.\nM30\n",
            &expect![[r#"
                5 | N10 G43 Z1.
                  |     ^^^ info[lasting-word-on-one-way] `G43` without `H`, which no block on the way here gives, when `#500` is 1
            "#]],
        );
    }

    #[test]
    fn a_cancelled_length_leaves_its_number_open() {
        let program = |cancel: &str, again: &str| {
            format!("G20 G90 G54\nT1 M6\nG43 H1 Z1.\n{cancel}\nT2 M6\nG0 X0. Y0.\n{again} Z1.\nM30\n")
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program("G53 G49 Z0.", "G43"),
            &expect![[r#"
            7 | G43 Z1.
              | ^^^ warning[lasting-word-on-one-way] `G43` without `H`, after the one before was cancelled
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program("H00", "G43"),
            &expect![[r#"
            7 | G43 Z1.
              | ^^^ warning[lasting-word-on-one-way] `G43` without `H`, after the one before was cancelled
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program("G49", "G43 H2"), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("G49\nH2", "G43"), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("G0 Z2.", "G43"), &expect![[""]]);
        // A block of safe modes cancels a length that this program did not give.
        check_rule(&RULE, "haas-mill", "G20 G40 G49 G80 G90\nT1 M6\nG43 Z1.\nM30\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", &program("G49", "G43").replace("G43 H1", "G43"), &expect![[""]]);
    }

    #[test]
    fn words_of_every_way_and_of_none_are_not_reported() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54\nT1 M6\nIF [#500 EQ 1] GOTO 10\nH1\nGOTO 20\nN10 H2\nN20 G43 Z1.\nM30\n",
            &expect![[""]],
        );
        check_rule(&RULE, "haas-mill", "G20 G90 G54\nT1 M6\nG43 Z1.\nM30\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", "G20 G90 G54\nT1 M6\n/G43 H1\nG43 Z1.\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_program_that_is_called_first_may_give_the_word() {
        let program =
            |slash: &str| format!("G20 G90 G54\nT1 M6\n{slash}M98 P200\nG43 Z1.\nM30\nO200\nH1\nM99\n");
        check_rule(
            &RULE,
            "haas-mill",
            &program("/"),
            &expect![[r#"
            4 | G43 Z1.
              | ^^^ warning[lasting-word-on-one-way] `G43` without `H`, which no block on the way here gives
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program(""), &expect![[""]]);
    }

    #[test]
    fn a_block_that_other_programs_call_relies_on_them() {
        check_rule(&RULE, "haas-mill", "O1\nG20 G90 G54\n/H1\nG43 Z1.\nM99\n", &expect![[""]]);
    }
}
