//! A peck that is longer than the hole.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{At, Axis, Event, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_range;
use crate::facts::edge;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A drilling cycle in pecks (`G83`, `G73`) makes its hole in one go: its first peck reaches the bottom, and the hole is
    /// several diameters deep.
    ///
    /// ## Why it matters
    /// The drill does not clear its chips. They pack in the flutes, and the drill breaks. Mostly the point of `Q` is at the
    /// wrong place. Of a drill whose diameter is not known this is information.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G17 G90 G54 S3000 M3
    /// G0 X0. Y0. Z1.
    /// G98 G83 Z-1.1 R0.1 Q2. F12.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G17 G90 G54 S3000 M3
    /// G0 X0. Y0. Z1.
    /// G98 G83 Z-1.1 R0.1 Q0.2 F12.
    /// G80
    /// M30
    /// ```
    rule "peck-longer-than-hole" in "cycles" {
        summary: "drilling in pecks whose first peck reaches the bottom",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FEED_STROKES, make: || Box::new(PeckLongerThanHole::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct PeckLongerThanHole {
    /// The block whose first stroke was looked at.
    block: Option<At>,
}

remembers!(PeckLongerThanHole: block);

/// Diameters that a drill goes without clearing chips.
const FREE: f64 = 2.5;

impl PathRule for PeckLongerThanHole {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_peck)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        if travel.kind != TravelKind::Feed || !travel.expanded || !cx.has_effect(is_peck) {
            return;
        }
        // The last peck of a hole is what is left of it.
        if self.block.replace(cx.origin().at) == Some(cx.origin().at) {
            return;
        }
        // The words of this block: other rules report a cycle that uses those of an earlier one.
        let (Some(q), Some(unit)) = (cx.known_number('Q'), cx.state().units(cx.model)) else { return };
        let is_length = cx.word('Q').is_some_and(|word| word.shape.point)
            || cx.control().numbers().unpointed == gcheck_controls::Unpointed::AsWritten;
        let depth = travel.from.raw(Axis::Z) - travel.to.raw(Axis::Z);
        let peck = Mm(q * unit.in_mm());
        // The first stroke goes to the bottom, and the word says so.
        let is_longer = is_length && depth > 0.0 && peck.0 > depth * 1.01;
        if !is_longer || cx.origin().letters.contains(Letter::of('I')) {
            return;
        }
        let diameter = edge::diameter(cx);
        if diameter.is_some_and(|(_, diameter)| depth <= diameter.0 * FREE) {
            return;
        }
        let letter = Letter::of('Q');
        let finding = cx
            .finding(&META, cycle_range(cx), "the drill makes the whole hole in one peck")
            .label(format!("pecks of {} for a stroke of {}", cx.shown(peck), cx.shown(Mm(depth))))
            .also(cx.word_range(|word| word.letter == letter), "longer than the hole is deep")
            .help("check the decimal point of `Q`; a hole that needs no pecks is drilled with `G81`");
        report.add(if diameter.is_some() { finding } else { finding.at_most(Severity::Info) });
    }
}

fn is_peck(effect: Effect) -> bool {
    effect.pecks()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_last_peck_is_what_is_left() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G17 G90 G94 G54 S2000 M3\nG0 X0 Y0 Z10\nG98 G83 Z-12 R2 Q3 F120\nX5\nG80\nM2\n",
            &expect![[""]],
        );
    }
}
