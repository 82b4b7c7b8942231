//! A canned cycle without a word that it needs.

use gcheck_controls::{Code, Effect, Letter, LetterSet, Need};
use gcheck_engine::{CycleFault, Event, Fault};

use crate::declare::declare_rule;
use crate::facts::cycles::{Series, cycle_code, is_cycle, is_operation};
use crate::facts::lasting::is_refused_without;
use crate::facts::usage::may_be_called;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// A canned cycle runs without a word that it needs, and no earlier block of the cycle gives it.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, the tool above the part.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// G81 X10 Y10 R2 F100
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// G81 X10 Y10 Z-5 R2 F100
    /// X20
    /// M2
    /// ```
    rule "cycle-word-missing" in "cycles" {
        summary: "canned cycle without a word that it needs",
        severity: Error,
        tier: Path,
        control_specific: true,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::MODES).union(Watch::FAULTS),
            make: || Box::new(CycleWordMissing::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleWordMissing {
    series: Series,
}

remembers!(CycleWordMissing: series);

impl PathRule for CycleWordMissing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| is_cycle(effect) || is_operation(effect))
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let begins = self.series.block(cx);
        let Some(code) = begins.and_then(|ix| cx.control().code_at(ix)) else { return };
        // If missing pecks are not a fault, the cycle makes one stroke to the bottom.
        let pecks = code.effect().pecks();
        let is_fault = cx.model.semantics().cycles.rise_to_r;
        if pecks && !is_fault && !cx.origin().letters.intersects(LetterSet::of("QIJK")) {
            self.tell(cx, code, Letter::of('Q'), Severity::Error, report);
        }
        let is_written = |effect: Effect| cx.codes().iter().any(|ix| cx.model.effect(*ix) == effect);
        let is_incremental = is_written(Effect::Incremental)
            || cx.state().is_incremental(cx.model) == Some(true) && !is_written(Effect::Absolute);
        // Where the control takes that, feeding begins at the level of the tool.
        let r = Letter::of('R');
        if is_cycle(code.effect()) && !is_incremental && !cx.origin().letters.contains(r) {
            self.tell(cx, code, r, Severity::Info, report);
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.series.changed(cx, event);
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::Cycle(CycleFault::Missing(letter)) = *fault else { return };
        if let Some(code) = cycle_code(cx) {
            self.tell(cx, code, letter, Severity::Error, report);
        }
    }
}

impl CycleWordMissing {
    fn tell(
        &self,
        cx: &PathCx<'_>,
        code: Code<'_>,
        letter: Letter,
        severity: Severity,
        report: &mut Report<'_>,
    ) {
        // Other rules report a word of an earlier cycle, and one that no block of the file has; some controls do
        // without it.
        let word = code.entry().words.iter().find(|word| Letter::parse(&word.letter) == Some(letter));
        let begins = cx.has_effect(|effect| effect == code.effect());
        let told_by_text =
            !may_be_called(cx.file_index)
                && cx.file_index.never_given.iter().any(|missing| {
                    missing.letter == letter && cx.model.effect(missing.code) == code.effect()
                });
        // A letter of an arc or a call elsewhere in the text does not belong to the cycle.
        let is_depth = cx.control().letter(letter).is_some_and(|entry| entry.axis);
        let needed = word.is_some_and(|word| match word.need {
            Need::Conditional => severity == Severity::Error,
            // The control has a value for it: worth knowing, and no more.
            Need::Modal if word.default.is_some() => severity == Severity::Info,
            Need::Modal => severity == Severity::Error && begins && !told_by_text,
            // The plane decides which axis has the depth.
            Need::Optional => is_depth,
            Need::Required => false,
        });
        let stands = cx.origin().letters.contains(letter);
        let was_given = is_cycle(code.effect())
            && (self.series.given.contains_key(&letter) || self.series.lost(letter).is_some());
        // Only the caller knows the words of a cycle that it began.
        if !needed || stands || was_given || !cx.is_on_every_path() || cx.is_called_only() {
            return;
        }
        // The word of an earlier program may count.
        let lasts = word.is_some_and(|word| word.need == Need::Modal)
            && !is_refused_without(cx.control(), code, letter);
        let (name, entry) = (code.number(), code.entry());
        let is = word.map_or("", |word| word.is.as_str());
        let confidence = word.and_then(|word| word.confidence).unwrap_or(entry.confidence);
        // A word whose variable is empty counts for nothing.
        let written = cx.find_word(cx.origin().at, |word| word.letter == letter);
        let help = match &written {
            Some(_) => format!("give the variable of `{letter}` a value before this block"),
            None => format!("give `{letter}` in the block that begins the cycle"),
        };
        let label = match (&written, is) {
            (Some(_), _) => format!("`{letter}` counts for nothing: its variable is empty"),
            (None, "") => format!("`{letter}` is missing"),
            (None, is) => format!("`{letter}` is missing: {is}"),
        };
        let range = written.unwrap_or_else(|| {
            cx.word_range(|word| word.code.is_some() && cx.model.effect(word.code) == code.effect())
        });
        report.add(
            cx.finding(&META, range, format!("canned cycle without `{letter}` (`{name}`)"))
                .label(label)
                .note(format!(
                    "`{name}` ({}) needs `{letter}` in its first block  [{}]",
                    entry.title, entry.source
                ))
                .help(help)
                .at_most(severity.min(limit(confidence)))
                .at_most(if lasts { Severity::Warning } else { Severity::Error }),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_word_whose_variable_is_empty() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 T1 M6\nG0 G54 X0. Y0. S900 M3\nG43 H1 Z5.\n#1=-5.\n#2=#0\nG81 Z#1 R#2 F100.\nG80\nM30\n",
            &expect![[r#"
                6 | G81 Z#1 R#2 F100.
                  |         ^^^ warning[cycle-word-missing] canned cycle without `R` (`G81`)
            "#]],
        );
    }

    #[test]
    fn the_radius_of_an_arc_is_no_plane_of_a_cycle() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 T1 M6\nG0 G54 X0. Y0. S900 M3\nG43 H1 Z1.\nG2 X1. R0.5 F9.\nG81 Z-0.5 F5.\nX3.\nG80\nM30\n",
            &expect![[r#"
                5 | G81 Z-0.5 F5.
                  | ^^^ info[cycle-word-missing] canned cycle without `R` (`G81`)
            "#]],
        );
    }

    #[test]
    fn pecks_that_no_cycle_was_given() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 T1 M6\nG0 G54 X0. Y0. S900 M3\nG43 H1 Z1.\nG12 I.5 K1. Q.25 D1 F9.\nG83 Z-0.5 R.1 F5.\nG80\nM30\n",
            &expect![[r#"
                5 | G83 Z-0.5 R.1 F5.
                  | ^^^ warning[cycle-word-missing] canned cycle without `Q` (`G83`)
            "#]],
        );
    }

    #[test]
    fn words_of_a_subprogram_in_the_file_are_none_of_the_cycles() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 sub\nG4 P1\no1 endsub\nG21 G90 G0 X0 Y0 Z10\nG82 X10 Z-5 R2 F100\nM2\n",
            &expect![[r#"
                5 | G82 X10 Z-5 R2 F100
                  | ^^^ error[cycle-word-missing] canned cycle without `P` (`G82`)
            "#]],
        );
    }

    #[test]
    fn the_code_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G0 X0 Y0 Z10\nG81 X10 R2 F100\nG80\nG82 X20 Z-5 R2\nM2\n",
            &expect![[r#"
                2 | G81 X10 R2 F100
                  | ^^^ error[cycle-word-missing] canned cycle without `Z` (`G81`)
            "#]],
        );
    }
}
