//! A canned cycle that relies on words of an earlier cycle that has ended.

use gcheck_controls::{Code, Letter, LetterSet};
use gcheck_engine::{CycleFault, Event, Fault};

use crate::declare::declare_rule;
use crate::facts::cycles::{Series, cycle_code, cycle_range, is_cycle};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// A canned cycle begins again without a word that it needs, and only an earlier cycle had the word: the end of
    /// that cycle (`G80`, `G0`, `G1`) cleared it.
    ///
    /// ## Why it matters
    /// `R`, `Z` and `Q` last from hole to hole only while the cycle is active. The control stops with an alarm, or
    /// drills in one stroke a hole that should be pecked.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G0 X0 Y0 Z10.
    /// G99 G83 X0 Y0 Z-20. R2. Q3. F100.
    /// G80
    /// G99 G83 X50. Z-20. R2.
    /// G80
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G21 G90 G0 X0 Y0 Z10.
    /// G81 X0 Y0 Z-20. R2. F100.
    /// G80
    /// G81 X50.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G0 X0 Y0 Z10.
    /// G99 G83 X0 Y0 Z-20. R2. Q3. F100.
    /// X50.
    /// G98 X80. Z-10.
    /// G80
    /// M30
    /// ```
    rule "cycle-words-lost" in "cycles" {
        summary: "canned cycle that relies on words of an earlier one",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::MODES).union(Watch::FAULTS),
            make: || Box::new(CycleWordsLost::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleWordsLost {
    series: Series,
}

remembers!(CycleWordsLost: series);

impl PathRule for CycleWordsLost {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_cycle)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let begins = self.series.block(cx);
        let Some(code) = begins.and_then(|ix| cx.control().code_at(ix)) else { return };
        // If missing pecks are not a fault, the cycle makes one stroke to the bottom.
        let pecks = code.effect().pecks();
        let q = Letter::of('Q');
        let given = cx.origin().letters;
        if pecks && !cx.model.semantics().cycles.rise_to_r && !given.intersects(LetterSet::of("QIJK")) {
            self.tell(cx, code, q, report);
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.series.changed(cx, event);
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::Cycle(CycleFault::Missing(letter)) = *fault else { return };
        if let Some(code) = cycle_code(cx).filter(|code| is_cycle(code.effect())) {
            self.tell(cx, code, letter, report);
        }
    }
}

impl CycleWordsLost {
    fn tell(&self, cx: &PathCx<'_>, code: Code<'_>, letter: Letter, report: &mut Report<'_>) {
        if !cx.is_on_every_path() || self.series.given.contains_key(&letter) {
            return;
        }
        let Some(lost) = self.series.lost(letter) else { return };
        let name = code.number();
        let mut finding = cx
            .finding(
                &META,
                cycle_range(cx),
                format!("canned cycle without `{letter}`, which ended with an earlier one"),
            )
            .label(format!("`{name}` begins again without `{letter}`"))
            .help(format!("give `{letter}` again in the first block of the cycle"))
            .at_most(limit(cx.model.semantics().confidence));
        if let Some(range) = cx.range_of(lost.given) {
            finding = finding.also(range, format!("`{letter}` was given here"));
        }
        if let Some(range) = cx.range_of(lost.ended) {
            finding = finding.also(range, "and ended with its cycle here");
        }
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_code_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G0 X0 Y0 Z10.\nG83 Z-20. R2. Q3. F100.\nX10.\nG80\nX20.\nG83 Z-20. R2.\nG81 X5. Z-2.\nG0 X1.\nG82 X5.\nM30\n",
            &expect![[r#"
                6 | G83 Z-20. R2.
                  | ^^^ warning[cycle-words-lost] canned cycle without `Q`, which ended with an earlier one
                9 | G82 X5.
                  | ^^^ warning[cycle-words-lost] canned cycle without `Z`, which ended with an earlier one
            "#]],
        );
    }

    #[test]
    fn words_show_where_the_word_was_and_where_it_ended() {
        let program = "G21 G90 G0 X0 Y0 Z10.\nG83 Z-20. R2. Q3. F100.\nG80\nG83 Z-20. R2.\nG80\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            canned cycle without `Q`, which ended with an earlier one
              here: `G83` begins again without `Q`
              there: `Q` was given here
              there: and ended with its cycle here
              help: give `Q` again in the first block of the cycle
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn other_words_may_give_the_pecks() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G0 X0 Y0 Z10.\nG83 Z-20. R2. Q3. F100.\nG80\nG83 Z-20. R2. I5. J1. K1.\nG80\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_word_of_unknown_value_is_given() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G0 X0 Y0 Z10.\nG83 Z-20. R2. Q3. F100.\nG80\nG83 Z#101 R#102 Q#103\nX5.\nG80\nM30\n",
            &expect![[""]],
        );
    }
}
