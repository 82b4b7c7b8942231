//! A feed, a speed or a cutter size that the position of the block delete switch decides.

use std::ops::Range;

use gcheck_controls::{Letter, LetterSet};
use gcheck_engine::{Event, Role};

use crate::declare::declare_rule;
use crate::facts::block_delete::is_optional;
use crate::facts::compensation::is_on;
use crate::facts::cutting::is_cut;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block with a block delete (`/`) gives a feed (`F`), a speed (`S`) or the number of a cutter's size (`D`) and moves
    /// nothing. A later block without the sign cuts with it.
    ///
    /// ## Why it matters
    /// With the switch in its other position the same cut has the number from before: another feed, another speed, or the
    /// size of another tool, which is a part out of tolerance.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// S2000 M3
    /// D1
    /// /D2
    /// G1 G41 X1. Y1. F10.
    /// X2.
    /// G40 X3.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// S2000 M3
    /// /D2
    /// G1 G41 D1 X1. Y1. F10.
    /// X2.
    /// G40 X3.
    /// M30
    /// ```
    rule "word-in-skipped-block" in "modal" {
        summary: "feed, speed or cutter size depends on the block delete switch",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::ALL_BLOCKS.union(Watch::CUTS),
            make: || Box::new(WordInSkippedBlock::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct WordInSkippedBlock {
    /// Words that blocks gave which the switch does not leave out. Without one, other rules report that it is missing.
    kept: LetterSet,
    /// Words that a block to be skipped gave last, with their places.
    given: Vec<Given>,
}

remembers!(WordInSkippedBlock: given);

/// A word of a block to be skipped.
#[derive(Clone, PartialEq)]
struct Given {
    letter: Letter,
    range: Range<u32>,
}

remembers!(Given: range);

/// The words that a cut takes from an earlier block.
const LASTING: LetterSet = LetterSet::of("FSD");

impl PathRule for WordInSkippedBlock {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.file_index.block_deletes != 0
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        let words = cx.origin().letters.and(LASTING);
        if words.is_empty() {
            return;
        }
        let is_optional = is_optional(cx);
        for letter in words.iter() {
            self.given.retain(|given| given.letter != letter);
            if !is_optional {
                self.kept.insert(letter);
            } else if self.kept.contains(letter) && cx.codes().is_empty() && !cx.names_axes() {
                // A block with codes or axes is one operation that the switch leaves out as a whole.
                let range = cx.letter_range(char::from(letter.ascii()));
                self.given.push(Given { letter, range });
            }
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if self.given.is_empty() || !is_cut(cx, event) {
            return;
        }
        let compensates = cx.state().effect(Role::Compensation, cx.model).is_none_or(is_on);
        let counts = |given: &Given| given.letter != Letter::of('D') || compensates;
        let (used, kept): (Vec<_>, Vec<_>) = std::mem::take(&mut self.given).into_iter().partition(counts);
        self.given = kept;
        for Given { letter, range } in used {
            let (what, severity) = match char::from(letter.ascii()) {
                'F' => ("feed", Severity::Info),
                'S' => ("spindle speed", Severity::Info),
                _ => ("size of the cutter", Severity::Warning),
            };
            report.add(
                cx.finding(
                    &META,
                    cx.range(),
                    format!("the {what} depends on the block delete switch (`{letter}`)"),
                )
                .also(range, "given in a block that the switch leaves out")
                .help(format!("give `{letter}` in a block without `/`"))
                .at_most(severity),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_cut_with_the_word_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0.\nS900\n/S200\nM3\nF10.\n/F80.\nG0 X1.\nG1 Z-.1\nX2.\nM30\n",
            &expect![[r#""#]],
        );
    }

    #[test]
    fn a_word_that_is_given_again_or_belongs_to_a_move_is_not_reported() {
        for before in ["/F80.\nF10.\n", "/G1 X1. F80.\n", "/M8\n", "/F80.\nG0 X1.\n/F90.\nF20.\n"] {
            let program = format!("G20 G90 G54 G0 X0. Y0.\nS900 M3\nG1 Z0. F10.\n{before}G1 X2.\nM30\n");
            check_rule(&RULE, "haas-mill", &program, &expect![[""]]);
        }
    }
}
