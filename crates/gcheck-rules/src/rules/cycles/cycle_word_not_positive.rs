//! A word of a canned cycle that must be above zero.

use gcheck_controls::{CodeIx, Letter};
use gcheck_engine::{CycleFault, Fault};

use crate::declare::declare_rule;
use crate::facts::cycles::{cycle_name, cycle_range, is_own_operation};
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// A word of a canned cycle is zero or below, and the cycle needs a positive value: a number of repeats in a block
    /// of positions.
    ///
    /// `number-out-of-range` and `computed-value-out-of-range` report words beside the code of the cycle.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or pecks forever at one depth.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// #1 = 0
    /// G81 X10 Z-20 R2 F100
    /// X20 L#1
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// #1 = 3
    /// G81 X10 Z-20 R2 F100
    /// X20 L#1
    /// M2
    /// ```
    rule "cycle-word-not-positive" in "cycles" {
        summary: "word of a canned cycle that is not above zero",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(CycleWordNotPositive) },
    }
}

struct CycleWordNotPositive;

impl PathRule for CycleWordNotPositive {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let (letter, what) = match *fault {
            Fault::Cycle(CycleFault::NotPositive(letter)) => (letter, "must be above zero"),
            Fault::Cycle(CycleFault::ZeroRepeats) => {
                (Letter::of(cx.model.semantics().cycles.repeat), "a cycle cannot be repeated zero times")
            }
            _ => return,
        };
        let Some(place) = cx.place() else { return };
        let word = place.table.words(place.block()).iter().find(|word| word.letter == letter);
        let is_judged = |code: gcheck_controls::Code<'_>| {
            let words = &code.entry().words;
            let entry = words.iter().find(|word| Letter::parse(&word.letter) == Some(letter));
            entry.is_some_and(|entry| entry.above.is_some() || entry.min.is_some())
        };
        let codes = cx.codes();
        let mut codes = codes.iter().filter_map(|ix| cx.control().code_at(*ix));
        // The range of the word says so, of a number as of a computed value.
        if word.is_some() && codes.any(is_judged) {
            return;
        }
        let range =
            if word.is_some() { cx.word_range(|word| word.letter == letter) } else { cycle_range(cx) };
        let name = cycle_name(cx);
        let of = if is_own_operation(cx) { "" } else { " of a canned cycle" };
        // In the form of two blocks the number has another address, in the block before.
        let is_own = word.is_some() || cx.codes().iter().any(|ix| reads(cx, *ix, letter));
        let message = if is_own || !is_own_operation(cx) {
            format!("`{letter}`{of} is not above zero (`{name}`)")
        } else {
            format!("a number of `{name}` from the block before it is not above zero")
        };
        report.add(
            cx.finding(&META, range, message)
                .label(what)
                .help("check where the value comes from")
                .at_most(limit(cx.model.semantics().confidence)),
        );
    }
}

fn reads(cx: &PathCx<'_>, code: CodeIx, letter: Letter) -> bool {
    cx.control().code_at(code).is_some_and(|code| code.reads().contains(letter))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G0 X0 Y0 Z10\nG83 X10 Z-20 R2 Q[1-1] F100\nG81 X10 Z-20 R2 L#1\nX5 L0\nM2\n",
            &expect![[r#"
                4 | X5 L0
                  |    ^^ error[cycle-word-not-positive] `L` of a canned cycle is not above zero (`G81`)
            "#]],
        );
    }

    #[test]
    fn written_numbers_are_judged_elsewhere() {
        check_rule(&RULE, "linuxcnc", "G21 G90 G0 X0 Y0 Z10\nG83 X10 Z-20 R2 Q0 F100\nM2\n", &expect![[""]]);
    }
}
