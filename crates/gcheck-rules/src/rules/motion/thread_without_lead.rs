//! A threading move without a lead.

use gcheck_controls::{Code, Effect, Letter, LetterSet, Need, WordEntry};
use gcheck_engine::{Fact, Fault, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// A move is synchronised with the spindle, and no word gives the distance per turn.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or cuts the thread at an earlier lead: the feed of the last cut.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G97 S500 M3
    /// G0 X20. Z5.
    /// G32 Z-20.
    /// M30
    /// ```
    /// ```nc,reported,haas-lathe
    /// G97 S500 M3
    /// G0 X1. Z0.2
    /// G1 Z-1. F0.008
    /// G0 Z0.2
    /// G76 X0.9 Z-0.8 K0.05 D0.01
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G97 S500 M3
    /// G0 X20. Z5.
    /// G32 Z-20. F1.5
    /// M30
    /// ```
    rule "thread-without-lead" in "motion" {
        summary: "threading move without a lead",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS.union(Watch::BLOCKS), make: || Box::new(ThreadWithoutLead) },
    }
}

struct ThreadWithoutLead;

impl PathRule for ThreadWithoutLead {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(code) = thread_from_feed(cx) else { return };
        // The feed of a cut; a word alone, or one with a rapid move, may be meant as the lead.
        let Some(given) = cx.definitions().set_by(Fact::Feed) else { return };
        let Some(place) = cx.place_of(given) else { return };
        let words = place.table.words(place.block());
        let is_cut = words.iter().any(|word| is_cut(cx.model.effect(word.code)));
        if !is_cut || given == cx.origin().at {
            return;
        }
        let name = code.number();
        let mut finding = cx
            .finding(
                &META,
                cx.word_range(|word| cx.control().code_at(word.code).map(Code::number) == Some(name)),
                format!("thread uses the feed of a cut as its lead (`{name}` without `F`)"),
            )
            .label("no lead is given here")
            .help("give the lead with `F`")
            .at_most(Severity::Warning);
        if let Some(range) = cx.find_word(given, |word| word.letter == Letter::of('F')) {
            finding = finding.also(range, "the feed in effect was given here");
        }
        report.add(finding);
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::MissingWord(letter) = *fault else { return };
        let mode = cx.state().mode(Role::Motion).only();
        let threads = matches!(mode.map(|ix| cx.model.effect(ix)), Some(Effect::Thread | Effect::RigidTap));
        if !threads || !matches!(letter.ascii(), b'F' | b'K') || asks_for_it(cx, letter) {
            return;
        }
        let Some(code) = cx.code_name(Role::Motion) else { return };
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!("threading move without a lead (`{code}` without `{letter}`)"),
            )
            .label(format!("`{letter}` is missing: the distance per turn"))
            .help(format!("give the lead with `{letter}`"));
        report.add(cx.resting_on(finding, Fact::Mode(Role::Motion), &format!("`{code}`")));
    }
}

/// The code of a block that begins a thread whose lead is `F`, if the block has no `F`.
fn thread_from_feed<'a>(cx: &PathCx<'a>) -> Option<Code<'a>> {
    let letters = cx.origin().letters;
    if letters.intersects(LetterSet::of("FE")) || !letters.intersects(LetterSet::of("XZUW")) {
        return None;
    }
    let codes = cx.codes();
    let ix = codes.iter().copied().find(|ix| cx.model.effect(*ix).cuts_thread())?;
    // The passes after the first one have its lead.
    let goes_on = cx.state().mode(Role::Motion).only().is_none_or(|mode| cx.model.effect(mode).cuts_thread());
    let code = cx.control().code_at(ix)?;
    let is_lead =
        |word: &WordEntry| word.letter == "F" && matches!(word.need, Need::Modal | Need::Conditional);
    (!goes_on && code.entry().words.iter().any(is_lead)).then_some(code)
}

/// Does the code feed at its `F`?
fn is_cut(effect: Effect) -> bool {
    use Effect as E;
    matches!(
        effect,
        E::Linear
            | E::ArcClockwise
            | E::ArcCounterClockwise
            | E::TurningPass
            | E::FacingPass
            | E::RoughAlongZ
            | E::RoughAlongX
            | E::RepeatPattern
            | E::GrooveFace
            | E::GrooveDiameter
            | E::CycleDrill
            | E::CycleDrillDwell
            | E::CyclePeck
            | E::CycleChipBreak
            | E::CycleBoreFeedOut
    )
}

/// Does a code of the block need the word each time? Then a missing word has been reported already.
fn asks_for_it(cx: &PathCx<'_>, letter: Letter) -> bool {
    cx.codes().iter().copied().filter_map(|ix| cx.control().code_at(ix)).any(|code| {
        let words = &code.entry().words;
        words.iter().any(|word| word.need == Need::Required && Letter::parse(&word.letter) == Some(letter))
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_block_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G18 G90 G0 X10 Z5\nS100 M3\nG33 Z-10 K1\nZ-20\nM2\n",
            &expect![[r#"
                4 | Z-20
                  | ^^^^ error[thread-without-lead] threading move without a lead (`G33` without `K`)
            "#]],
        );
    }

    #[test]
    fn the_feed_is_the_lead_on_lathes() {
        check_rule(&RULE, "haas-lathe", "G97 S500 M3\nF.05\nG0 X1. Z.1\nG32 Z-1.\nM30\n", &expect![""]);
    }

    #[test]
    fn the_feed_of_a_cut_is_no_lead() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G97 S500 M3\nG0 X30. Z5.\nG1 X26. F0.08\nG0 X34.\nG76 P020060 Q100 R0.05\nG76 X28.16 Z-27. P920 Q300\nM30\n",
            &expect![[r#"
                6 | G76 X28.16 Z-27. P920 Q300
                  | ^^^ warning[thread-without-lead] thread uses the feed of a cut as its lead (`G76` without `F`)
            "#]],
        );
    }

    #[test]
    fn later_passes_keep_the_lead_of_the_first() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G97 S500 M3\nG0 X1. Z.2\nG92 X.9 Z-1. F.05\nX.88\nG92 X.86\nG0 X1.\nG32 Z-1.\nM30\n",
            &expect![[""]],
        );
    }
}
