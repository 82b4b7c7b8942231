//! Modes that shift the axes by the tool: a length along a tilting tool, a cutter's size along a vector.
//!
//! Knows: which of them a block is executed under, what people call them. Must not know: any rule.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Fact, Role};
use gcheck_program::{BlockFlags, Word};

use crate::boundary::LeftOn;
use crate::{Finding, PathCx};

/// Is the length of the tool added along the tool?
pub(crate) fn is_along_tool(effect: Effect) -> bool {
    effect == Effect::LengthFiveAxis
}

/// Is the path shifted along the vector of each block?
pub(crate) fn is_along_vectors(effect: Effect) -> bool {
    effect == Effect::CompensationVector
}

impl PathCx<'_> {
    /// The code that holds while the block under way moves: its own, or the one in effect.
    pub(crate) fn in_effect(&self, role: Role, is_on: impl Fn(Effect) -> bool) -> Option<LeftOn> {
        if let Some(code) = self.code_of_role(role) {
            return is_on(self.model.effect(code)).then_some(LeftOn::Surely(code));
        }
        if role == Role::Length && self.has_word(|word| is_word(word, 'H') && word.number() == Some(0.0)) {
            return None;
        }
        self.on_before(role, is_on)
    }

    /// Adds where a mode was switched on, unless the block itself did.
    pub(crate) fn resting_on_mode(&self, finding: Finding, role: Role) -> Finding {
        if self.code_of_role(role).is_some() {
            return finding;
        }
        match self.code_name(role) {
            Some(name) => self.resting_on(finding, Fact::Mode(role), &format!("`{name}`")),
            None => finding,
        }
    }

    /// Has the block a mistake in form, so that words of it may be lost? Other rules speak of it.
    pub(crate) fn is_malformed(&self) -> bool {
        self.origin().flags.contains(BlockFlags::ERROR)
    }

    /// Has the block a word that `is` says yes to?
    pub(crate) fn has_word(&self, is: impl Fn(&Word) -> bool) -> bool {
        self.find_word(self.origin().at, is).is_some()
    }

    /// The first word of the block with an address.
    pub(crate) fn word(&self, letter: char) -> Option<Word> {
        let place = self.place()?;
        place.table.words(place.block()).iter().find(|word| is_word(word, letter)).copied()
    }
}

fn is_word(word: &Word, letter: char) -> bool {
    word.letter == Letter::of(letter) && !word.letter.is_corner()
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use expect_test::expect;

    use crate::testing::{World, findings};
    use crate::{Selection, Severity};

    /// What is done to a word of a block, and the block afterwards.
    fn variants(block: &str, letter: char) -> Vec<(&'static str, String)> {
        let words: Vec<&str> = block.split(' ').collect();
        let changed = |with: &dyn Fn(&str) -> String| {
            let words = words
                .iter()
                .map(|word| if word.starts_with(letter) { with(word) } else { (*word).to_owned() });
            words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
        };
        vec![
            ("missing", changed(&|_| String::new())),
            ("doubled", changed(&|word| format!("{word} {word}"))),
            ("negative", changed(&|_| format!("{letter}-3."))),
            ("zero", changed(&|_| format!("{letter}0"))),
            ("huge", changed(&|_| format!("{letter}99999999."))),
            ("no number", changed(&|_| format!("{letter}abc"))),
            ("unknown", changed(&|_| format!("{letter}#500"))),
            ("computed", changed(&|_| format!("{letter}[#500*2.]"))),
        ]
    }

    /// Rules that speak of the program, with their severities, each once.
    fn said(program: &str) -> Vec<(String, Severity)> {
        let found = findings(&Selection::default(), "haas-mill", program, &World::default());
        let style =
            ["program-number-missing", "tape-mark-missing", "units-not-stated", "five-axis-feed-per-minute"];
        let mut said: Vec<_> = found
            .iter()
            .filter(|finding| !style.contains(&finding.rule.id))
            .map(|finding| (format!("{}[{}]", finding.severity, finding.rule.id), finding.severity))
            .collect();
        said.sort();
        said.dedup();
        said
    }

    /// Each word of a block made wrong in every way; what is not known never makes an error, and wherever the block stands the
    /// same rules of five axes speak.
    fn check(before: &str, block: &str, letters: &str, after: &str, expected: &expect_test::Expect) {
        let mut shown = String::new();
        for letter in letters.chars() {
            for (how, changed) in variants(block, letter) {
                let program = format!("{before}{changed}\n{after}M30\n");
                let plain = said(&program);
                let names: Vec<&str> = plain.iter().map(|(name, _)| name.as_str()).collect();
                let _ = writeln!(shown, "{letter} {how}: {}", names.join(" "));
                if matches!(how, "unknown" | "computed") {
                    assert!(
                        plain.iter().all(|(_, severity)| *severity < Severity::Error),
                        "{letter} {how}: {names:?}"
                    );
                }
                let elsewhere = [
                    format!("{before}/{changed}\n{after}M30\n"),
                    format!("{before}M97 P70\n{after}M30\nN70 {changed}\nM99\n"),
                    format!("{before}#10=0\nWHILE [#10 LT 2] DO1\n{changed}\n#10=#10+1\nEND1\n{after}M30\n"),
                ];
                for program in elsewhere {
                    let there = said(&program);
                    let of_five_axes = |said: &[(String, Severity)]| -> Vec<String> {
                        let is_ours =
                            |name: &&String| name.contains("five-axis") || name.contains("cutter-vector");
                        said.iter().map(|(name, _)| name).filter(is_ours).cloned().collect()
                    };
                    let ours = of_five_axes(&plain);
                    assert!(
                        ours.iter().all(|name| of_five_axes(&there).contains(name)),
                        "{ours:?} / {there:?}\n{program}"
                    );
                }
            }
        }
        expected.assert_eq(&shown);
    }

    #[test]
    fn bad_words_of_a_length_along_the_tool() {
        check(
            "T1 M6\nG20 G90 G54 G94 G0 X0. Y0. Z1. A0. B0.\n",
            "G143 H1 X1. Y1. Z1. A5. B5.",
            "HXA",
            "G49\n",
            &expect![[r#"
                H missing: error[five-axis-length-without-offset]
                H doubled: warning[word-given-twice]
                H negative: error[decimal-point-on-integer] warning[sign-not-accepted]
                H zero: error[five-axis-length-without-offset]
                H huge: error[decimal-point-on-integer]
                H no number: error[unexpected-text]
                H unknown: 
                H computed: 
                X missing: warning[five-axis-axis-left-out]
                X doubled: warning[word-given-twice]
                X negative: 
                X zero: 
                X huge: 
                X no number: error[unexpected-text]
                X unknown: 
                X computed: 
                A missing: 
                A doubled: warning[word-given-twice]
                A negative: 
                A zero: 
                A huge: 
                A no number: error[unexpected-text]
                A unknown: 
                A computed: 
            "#]],
        );
    }

    #[test]
    fn bad_words_of_a_shift_along_vectors() {
        check(
            "T1 M6\nG20 G90 G54 G94 S1000 M3\nG43 H1 Z1.\nG0 X0. Y0.\n",
            "G1 G141 D1 X1. Y1. Z1. I0. J0.6 K0.8 F20.",
            "DXIF",
            "G40\nG49\n",
            &expect![[r#"
                D missing: error[cutter-vector-without-size]
                D doubled: warning[word-given-twice]
                D negative: error[decimal-point-on-integer] warning[sign-not-accepted]
                D zero: warning[cutter-vector-without-size]
                D huge: error[decimal-point-on-integer]
                D no number: error[unexpected-text]
                D unknown: 
                D computed: 
                X missing: 
                X doubled: warning[word-given-twice]
                X negative: 
                X zero: 
                X huge: 
                X no number: error[unexpected-text]
                X unknown: 
                X computed: 
                I missing: warning[cutter-vector-incomplete]
                I doubled: warning[word-given-twice]
                I negative: error[cutter-vector-not-unit]
                I zero: 
                I huge: error[cutter-vector-not-unit]
                I no number: error[unexpected-text]
                I unknown: 
                I computed: 
                F missing: error[feed-missing]
                F doubled: warning[word-given-twice]
                F negative: error[sign-not-accepted]
                F zero: error[feed-zero]
                F huge: 
                F no number: error[unexpected-text]
                F unknown: 
                F computed: 
            "#]],
        );
    }
}
