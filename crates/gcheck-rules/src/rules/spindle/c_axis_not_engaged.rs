//! Moves of the C axis of a lathe while its spindle is not an axis.

use gcheck_controls::{Effect, LetterSet, Machine};
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::workholding::{Moved, code_that};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A lathe turns its spindle as an axis only after a code that engages it (`M154`), and the program moves C or
    /// interpolates X and C (`G112`) without that code. Controls whose data name no such code are not judged: there it is the
    /// machine builder's.
    ///
    /// ## Why it matters
    /// The spindle is not an axis: the control stops with an alarm, or the part does not turn to its angle and the hole is in
    /// the wrong place.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G98 T303
    /// M133 P1500
    /// G0 X1. Z0.1
    /// G0 C90.
    /// G1 Z-0.5 F6.
    /// M30
    /// ```
    /// ```nc,reported,haas-lathe
    /// G20 G98 T303
    /// M133 P1500
    /// G0 X2. Z0.1
    /// G17 G112
    /// G1 X0.5 Y0.5 F6.
    /// G113
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G98 T303
    /// M154
    /// M133 P1500
    /// G0 X1. Z0.1
    /// G0 C90.
    /// G1 Z-0.5 F6.
    /// M155
    /// M30
    /// ```
    rule "c-axis-not-engaged" in "spindle" {
        summary: "move of the C axis of a lathe without the code that engages it",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::BLOCKS),
            make: || Box::new(CAxisNotEngaged::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CAxisNotEngaged {
    is_engaged: bool,
    is_told: bool,
}

remembers!(CAxisNotEngaged);

/// The modal group of the codes that engage the axis and release it.
const GROUP: &str = "c-axis";

impl PathRule for CAxisNotEngaged {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let control = program.environment.control();
        control.machine() == Machine::Lathe && control.codes().any(|code| code.entry().group == GROUP)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        for code in cx.codes().iter().filter_map(|ix| cx.code_of(*ix)) {
            if code.entry().group == GROUP {
                self.is_engaged = !code.entry().cancelled_by.is_empty();
            } else if code.is_user() {
                // It may engage the axis.
                self.is_engaged = true;
            }
        }
        let is_polar = |effect| effect == Effect::PolarInterpolationOn;
        if cx.has_effect(is_polar) {
            let range = cx.effect_range(is_polar);
            self.tell(cx, range, "X and C are interpolated, and the C axis is not engaged", report);
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if self.is_engaged || self.is_told || !cx.origin().letters.intersects(LetterSet::of("C")) {
            return;
        }
        // A corner and an argument are not moves of their own.
        let is_move = match event {
            Event::Travel(travel) => !travel.expanded,
            Event::Arc(_) => true,
            _ => false,
        };
        if is_move {
            self.tell(cx, cx.letter_range('C'), "the C axis moves and is not engaged", report);
        }
    }
}

impl CAxisNotEngaged {
    fn tell(&mut self, cx: &PathCx<'_>, range: std::ops::Range<u32>, what: &str, report: &mut Report<'_>) {
        let is_known = cx.is_certain();
        if self.is_engaged || !is_known || std::mem::replace(&mut self.is_told, true) {
            return;
        }
        let Some(code) = code_that(cx.control(), GROUP, Moved::Out) else { return };
        let (name, entry) = (code.number(), code.entry());
        report.add(
            cx.finding(&META, range, format!("{what} (no `{name}`)"))
                .label("the spindle is not an axis here")
                .note(format!("`{name}`: {}  [{}]", entry.summary, entry.source))
                .assuming("the C axis is not engaged when the program starts")
                .help(format!("stop the spindle and engage the C axis with `{name}` before this")),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn released_it_has_to_be_engaged_again() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G20 G98 T303\nM154\nG0 C90.\nM155\nG97 S900 M3\nG1 X1. F9.\nM5\nG0 C0.\nM30\n",
            &expect![[r#"
                8 | G0 C0.
                  |    ^^^ warning[c-axis-not-engaged] the C axis moves and is not engaged (no `M154`)
            "#]],
        );
    }

    #[test]
    fn a_control_without_such_a_code_is_not_judged() {
        check_rule(&RULE, "fanuc-lathe", "G21 G98 T0303\nG0 C90.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_corner_is_not_a_turn() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G20 G99 T303\nG97 S900 M3\nG1 X1. ,C.05 F.01\nZ-1.\nM30\n",
            &expect![[""]],
        );
    }
}
