//! A word that a block needs, and that neither the block nor an earlier one gives.

use gcheck_controls::{Code, Effect, Letter, LetterSet, Need, WordKind};
use gcheck_engine::{Fault, FrameKind, Role};

use crate::declare::declare_rule;
use crate::facts::word_sets::{NEED_A_ROTARY_AXIS, choice};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch, limit};

declare_rule! {
    /// What the block does needs a word that neither the block nor an earlier one gives.
    ///
    /// `required-word-missing` reports a word that its code needs every time.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G90 G54.1
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G90 G54.1 P12
    /// M30
    /// ```
    rule "needed-word-missing" in "words" {
        summary: "word that the block needs is missing",
        severity: Error,
        tier: Path,
        control_specific: true,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(NeededWordMissing) },
    }
}

struct NeededWordMissing;

impl PathRule for NeededWordMissing {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::MissingWord(letter) = *fault else { return };
        // Which axes a curve needs goes by its plane, which versions of a control read in different ways.
        let is_axis = cx.control().letter(letter).is_some_and(|entry| entry.axis);
        if is_axis || cx.origin().letters.contains(letter) || cx.is_malformed() {
            return;
        }
        let is_main = cx.state().frames().iter().all(|frame| frame.kind == FrameKind::Main);
        if is_main && cx.file_index.is_called_from_elsewhere() {
            return;
        }
        let codes = cx.codes();
        let own = codes.iter().filter_map(|ix| cx.control().code_at(*ix));
        // A block without a code goes on with the motion in effect.
        let active = cx.state().mode(Role::Motion).only().filter(|_| codes.is_empty());
        let mut candidates = own.chain(active.and_then(|ix| cx.control().code_at(ix)));
        let Some(code) = candidates.find(|code| code.reads().contains(letter)) else { return };
        if is_told_by_text(code, letter, cx.origin().letters)
            || code.effect() == Effect::CylinderMapping
                && NEED_A_ROTARY_AXIS.iter().any(|own| cx.known_number(char::from(own.ascii())).is_some())
        {
            return;
        }
        let entry = code.entry();
        let word = entry.words.iter().find(|word| Letter::parse(&word.letter) == Some(letter));
        let Some(word) = word.filter(|word| !codes.is_empty() || word.need != Need::Optional) else { return };
        if word.kind == WordKind::Program && has_comment(cx) {
            return;
        }
        let names = choice(code.would_do_for(letter, cx.origin().letters));
        let range = cx.word_range(|own| {
            cx.control().code_at(own.code).is_some_and(|own| own.number() == code.number())
        });
        let confidence = word.confidence.unwrap_or(entry.confidence);
        let finding = cx
            .finding(&META, range, format!("`{}` without {names}", entry.code))
            .label(format!("needs {names}: {}", word.is))
            .note(format!("`{}` ({}) needs {names} here  [{}]", entry.code, entry.title, entry.source))
            .help(format!("add {names} to the block"))
            .at_most(limit(confidence));
        // Where the data do not say that the word is ever needed, the engine alone does.
        let is_stated = word.need != Need::Optional;
        let is_sure = is_stated && cx.environment.control_is_chosen() && cx.is_on_every_path();
        report.add(if is_sure { finding } else { finding.at_most(Severity::Warning) });
    }
}

/// Does the block have a comment? On some controls a path in parentheses names the program.
fn has_comment(cx: &PathCx<'_>) -> bool {
    let file = cx.program.file(cx.origin().at.file);
    let place = cx.place();
    file.zip(place).is_some_and(|(file, place)| file.loaded.slice(place.range()).contains('('))
}

/// Do rules that read the block alone report the word?
fn is_told_by_text(code: Code<'_>, letter: Letter, present: LetterSet) -> bool {
    let entry = code.entry();
    let is_own = |items: &Vec<String>| {
        let letters = items.iter().fold(LetterSet::EMPTY, |set, item| set.or(LetterSet::of_item(item)));
        letters.contains(letter) && !letters.intersects(present)
    };
    let is_required = |word: &gcheck_controls::WordEntry| {
        (word.need == Need::Required || word.unless_comment) && Letter::parse(&word.letter) == Some(letter)
    };
    entry.words.iter().any(is_required) || entry.one_of.iter().any(is_own)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_code_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 F100\nG0 X0 Y0\nG5 X2 Y2 J4 P0 Q-4\nG5 X2 Y2 I0 J4 P0 Q-4\nM2\n",
            &expect![[r#"
                3 | G5 X2 Y2 J4 P0 Q-4
                  | ^^ error[needed-word-missing] `G5` without `I`
            "#]],
        );
    }

    #[test]
    fn words_of_which_one_would_do_are_named_together() {
        // Written, it is reported from the block alone (`cylinder-without-rotary-axis`).
        check_rule(
            &RULE,
            "haas-lathe",
            "G107 Z0. Q2.\nG107 Z[#500+1.] Q[#501+1.]\nM30\n",
            &expect![[r#"
                2 | G107 Z[#500+1.] Q[#501+1.]
                  | ^^^^ error[needed-word-missing] `G107` without `A`, `B` or `C`
            "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 F100 G90.1\nG0 X0 Y0\nG2 X2 Y0 I1\nM2\n",
            &expect![[r#"
            3 | G2 X2 Y0 I1
              | ^^ error[needed-word-missing] `G2` without `J`
        "#]],
        );
    }

    #[test]
    fn a_word_that_its_code_needs_every_time_is_told_elsewhere() {
        check_rule(&RULE, "haas-mill", "G12 Q1. Z-1. D1 F10.\nM30\n", &expect![[""]]);
    }
}
