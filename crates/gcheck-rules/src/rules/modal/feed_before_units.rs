//! `F` in a block that changes the units, on a control that reads the feed first.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{Fact, FeedMode, Role, Units};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch, limit};

declare_rule! {
    /// A block changes between inches and millimetres and has an `F`, and the control reads the feed before the units.
    ///
    /// ## Why it matters
    /// The feed counts in the units that are on their way out: it is 25.4 times as fast or as slow as it seems.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G17 G20 G90 F10
    /// G1 X1
    /// G21 G1 X30 F300
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G17 G20 G90 F10
    /// G1 X1
    /// G21
    /// G1 X30 F300
    /// M2
    /// ```
    rule "feed-before-units" in "modal" {
        summary: "feed in the block that changes the units",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(FeedBeforeUnits) },
    }
}

struct FeedBeforeUnits;

impl PathRule for FeedBeforeUnits {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::Inch) && program.may(|effect| effect == Effect::Millimetre)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let semantics = cx.model.semantics();
        let phases = cx.control().phases();
        let place = |phase: &str| phases.iter().position(|own| own == phase);
        let is_first = matches!((place("feed"), place("units")), (Some(feed), Some(units)) if feed < units);
        if !semantics.strict || !is_first || !cx.origin().letters.intersects(LetterSet::of("F")) {
            return;
        }
        let state = cx.state();
        let old =
            state.units(cx.model).filter(|_| cx.definitions().set_by(Fact::Mode(Role::Units)).is_some());
        let new = cx.codes().iter().find_map(|ix| match cx.model.effect(*ix) {
            Effect::Inch => Some((Units::Inch, *ix)),
            Effect::Millimetre => Some((Units::Mm, *ix)),
            _ => None,
        });
        let (Some(old), Some((new, code))) = (old, new) else { return };
        let counts_lengths = state.feed_mode(cx.model).is_some_and(|mode| mode != FeedMode::InverseTime);
        if old == new || !counts_lengths {
            return;
        }
        let name = cx.name_of(code);
        let unit = if old == Units::Inch { "inches" } else { "millimetres" };
        let finding = cx
            .finding(
                &META,
                cx.letter_range('F'),
                format!("`F` counts in {unit}: `{name}` of its block acts after it"),
            )
            .label("25.4 times another feed than it seems")
            .note(format!("the control reads the feed of a block before its units  [{}]", semantics.source))
            .help(format!("put `{name}` into a block before this one, or give `F` in the next block"))
            .at_most(limit(semantics.confidence));
        report.add(cx.resting_on(finding, Fact::Mode(Role::Units), "the units"));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_units_at_the_start_are_the_machines() {
        check_rule(&RULE, "linuxcnc", "G20 G90 F10\nG1 X1\nG21\nG1 X1 F99\nM2\n", &expect![[""]]);
    }

    #[test]
    fn inverse_time_counts_no_length() {
        check_rule(&RULE, "linuxcnc", "G21 G90 G93\nG1 X1 F10\nG20 G1 X1 F10\nM2\n", &expect![[""]]);
    }

    #[test]
    fn units_that_stay() {
        check_rule(&RULE, "linuxcnc", "G21 G90\nG1 X1 F10\nG21 G1 X2 F10\nG20\nM2\n", &expect![[""]]);
    }
}
