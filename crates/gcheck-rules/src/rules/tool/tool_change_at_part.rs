//! A tool change where the last cut ended.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{Axis, Event, Travel, TravelKind};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range};
use crate::facts::cycles::cycle_code;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The turret turns, or the tool is changed, where the last cut or the last cycle ended, without a rapid move, a return to a
    /// reference position or a feed move far out of the part between them. The rule is for controls that change the tool in
    /// place.
    ///
    /// ## Why it matters
    /// The tool is still beside the part. The turret swings its longer tools into the part or into the chuck. The same holds
    /// for a turret that turns under the zero of the part, deeper than any cut of the tool before.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// T0101
    /// G97 S500 M3
    /// G0 X50. Z2.
    /// G1 Z-20. F0.2
    /// X54.
    /// T0202
    /// G0 X100. Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// T0101
    /// G97 S500 M3
    /// G0 X50. Z2.
    /// G1 Z-20. F0.2
    /// X54.
    /// G0 X150. Z100.
    /// T0202
    /// G0 X100. Z50.
    /// M30
    /// ```
    rule "tool-change-at-part" in "tool" {
        summary: "tool change in place, with no retract after the last cut",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::MOVES),
            make: || Box::new(ToolChangeAtPart { cut: None, lowest: f64::INFINITY }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct ToolChangeAtPart {
    /// The last move, if it cuts or belongs to a cycle.
    cut: Option<Range<u32>>,
    /// The lowest Z of a cut since the last tool change: millimetres.
    lowest: f64,
}

remembers!(ToolChangeAtPart: cut);

impl PathRule for ToolChangeAtPart {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().semantics().tools.change_in_place
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if boundary(cx) != Some(Boundary::ToolChange) || cx.is_after_unknown_program() {
            return;
        }
        let (cut, lowest) = (self.cut.take(), std::mem::replace(&mut self.lowest, f64::INFINITY));
        let turret = cx.model.semantics().tools.change_by_t;
        if !cx.is_on_every_path() {
            return;
        }
        let Some(cut) = cut else {
            if turret {
                tell_deep(cx, lowest, report);
            }
            return;
        };
        let (message, label) = if turret {
            ("the turret turns where the last cut ended", "the turret turns in place, beside the part")
        } else {
            ("the tool is changed where the last cut ended", "the axes stay in place, beside the part")
        };
        let finding = cx
            .finding(&META, boundary_range(cx, Boundary::ToolChange), message)
            .label(label)
            .also(cut, "the last move before it: a cut, with no retract after it")
            .help("retract to a place where the turret has room, in a block before the tool change");
        report.add(if turret { finding } else { finding.assuming(STAYS) });
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        let is_at_part = match event {
            Event::Travel(travel) => ends_at_part(cx, travel) && !self.retracts(cx, travel),
            Event::Arc(arc) => is_low(cx, arc.to.raw(Axis::Z)),
            _ => false,
        };
        self.cut = is_at_part.then(|| cx.range());
        let z = match event {
            Event::Travel(travel) if travel.kind == TravelKind::Feed => {
                travel.from.raw(Axis::Z).min(travel.to.raw(Axis::Z))
            }
            Event::Arc(arc) => arc.to.raw(Axis::Z),
            _ => f64::NAN,
        };
        self.lowest = self.lowest.min(z);
    }
}

impl ToolChangeAtPart {
    /// Does a feed move take the tool of a lathe out of the part: to a place of the machine, away from the chuck, or on outward
    /// from there?
    fn retracts(&self, cx: &PathCx<'_>, travel: &Travel) -> bool {
        if travel.kind != TravelKind::Feed || travel.expanded || cx.state().plane(cx.model) != Some(Plane::Zx)
        {
            return false;
        }
        let way = |axis: Axis| travel.to.raw(axis) - travel.from.raw(axis);
        let (across, along) = (way(Axis::X), way(Axis::Z));
        let is_outward = across > -SLACK && along > -SLACK;
        cx.has_effect(Effect::goes_to_machine_place)
            || is_outward && (along > FAR || self.cut.is_none() && self.lowest.is_finite())
    }
}

/// The turret turns closer to the chuck than any cut of its last tool went, and under the zero of the part.
fn tell_deep(cx: &PathCx<'_>, lowest: f64, report: &mut Report<'_>) {
    let Some(z) = cx.state().position().get(Axis::Z).filter(|z| *z < -SLACK && *z < lowest - SLACK) else {
        return;
    };
    if !lowest.is_finite() || cx.state().plane(cx.model) != Some(Plane::Zx) {
        return;
    }
    let range = boundary_range(cx, Boundary::ToolChange);
    report.add(
        cx.finding(&META, range, "the turret turns beside the part, deeper than any cut of the tool before")
            .label(format!("at Z {}, and the deepest cut is at Z {}", cx.shown(Mm(z)), cx.shown(Mm(lowest))))
            .help("check the sign of Z in the retract before it"),
    );
}

/// A way that a tool does not cut away from the chuck, but retracts: millimetres.
const FAR: f64 = 10.0;
/// Levels that differ by less are one: millimetres.
const SLACK: f64 = 1.0;

/// Does the move leave the tool at the part? Drilling cycles of mills end at a level above it.
fn ends_at_part(cx: &PathCx<'_>, travel: &Travel) -> bool {
    let turns = cx.state().plane(cx.model) == Some(Plane::Zx);
    match travel.kind {
        TravelKind::Probe { .. } => false,
        // A return to a reference position is made of several moves too.
        _ if travel.expanded => turns && cycle_code(cx).is_some(),
        TravelKind::Rapid => false,
        TravelKind::Feed | TravelKind::Thread => is_low(cx, travel.to.raw(Axis::Z)),
    }
}

/// A mill may have fed the tool up out of the part.
fn is_low(cx: &PathCx<'_>, z: f64) -> bool {
    cx.state().plane(cx.model) == Some(Plane::Zx) || z < 0.0
}

/// What the control does is a matter of its set-up.
const STAYS: &str = "the machine is not set up to go to a position for tool changes by itself";

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn turned(after: &str) -> String {
        format!(
            "G21 G18 G99 T0101\nG97 S500 M3\nG0 X50. Z2.\nG76 X28. Z-20. P920 Q300 F1.5\n{after}T0202\nG0 X60.\nM30\n"
        )
    }

    #[test]
    fn a_retract_toward_the_chuck() {
        let program = |z: &str| {
            format!(
                "G21 G99 T0101\nG97 S500 M3\nG0 X50. Z2.\nG1 Z-20. F0.2\nG0 X100. Z{z}\nT0202\nG0 X150. Z50.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("-100."),
            &expect![[r#"
            6 | T0202
              | ^^^^^ warning[tool-change-at-part] the turret turns beside the part, deeper than any cut of the tool before
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("100."), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &program("-10."), &expect![[""]]);
    }

    #[test]
    fn a_cycle_ends_at_the_part() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &turned("M1\n"),
            &expect![[r#"
            6 | T0202
              | ^^^^^ warning[tool-change-at-part] the turret turns where the last cut ended
        "#]],
        );
    }

    #[test]
    fn a_retract_is_enough() {
        check_rule(&RULE, "fanuc-lathe", &turned("G0 X150. Z100.\n"), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &turned("G28 U0. W0.\n"), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", "G21 G28 U0. W0.\nT0101\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_retract_at_feed_is_enough() {
        let program = |retract: &str| {
            format!(
                "G21 G99 T0101\nG97 S500 M3\nG0 X50. Z2.\nG1 Z-20. F0.2\n{retract}\nT0202\nG0 X150. Z50.\nM30\n"
            )
        };
        for retract in ["G1 X200. Z100. F5.", "G1 Z100. F5.\nX200.", "G1 G53 X0", "X54.\nG53 Z0"] {
            check_rule(&RULE, "haas-lathe", &program(retract), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "haas-lathe",
            &program("X54. Z-18."),
            &expect![[r#"
            6 | T0202
              | ^^^^^ warning[tool-change-at-part] the turret turns where the last cut ended
        "#]],
        );
    }

    #[test]
    fn a_mill_that_was_fed_up_is_clear() {
        let program =
            |z: &str| format!("G21 G17 G90 T1 M6\nG43 H1\nG0 X0 Y0 Z5\nG1 Z-2 F90\nZ{z}\nT2 M6\nM2\n");
        check_rule(&RULE, "linuxcnc", &program("5"), &expect![[""]]);
        check_rule(
            &RULE,
            "linuxcnc",
            &program("-1"),
            &expect![[r#"
            6 | T2 M6
              |    ^^ warning[tool-change-at-part] the tool is changed where the last cut ended
        "#]],
        );
    }
}
