//! A move that goes on into what the probe has touched.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{Axis, Event, Position, Touch, Travel, TravelKind, Way, Ways};

use crate::declare::declare_rule;
use crate::facts::probing::{driven, is_touch};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The first move after a probing move goes on in the same direction: an increment with the same sign, or a position
    /// beyond the end point of the probing move.
    ///
    /// ## Why it matters
    /// The probe rests on the surface that it has touched. A move further in that direction bends or breaks the stylus:
    /// the input that stopped the probing move does not stop this one. Often a sign is missing, or one too many.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G91 G31 X1. F10. M75
    /// G1 X0.2 F30.
    /// G90 G0 X0.
    /// M30
    /// ```
    /// ```nc,reported,linuxcnc
    /// G21 G90 G54 G0 X20 Y20
    /// Z10
    /// G38.2 Z-5 F60
    /// G0 Z-10
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G91 G31 X1. F10. M75
    /// G1 X-0.2 F30.
    /// G90 G0 X0.
    /// M30
    /// ```
    rule "goes-on-after-touch" in "probing" {
        summary: "move that goes on in the direction of a touch",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(GoesOnAfterTouch { touched: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct GoesOnAfterTouch {
    /// The move before this one, if it was a probing move.
    touched: Option<Touched>,
}

remembers!(GoesOnAfterTouch: touched);

/// A probing move.
#[derive(Clone, PartialEq)]
struct Touched {
    ways: Ways,
    /// Where it ends without a touch.
    end: Position,
    /// Its coordinates count from another zero now.
    is_elsewhere: bool,
    bytes: Range<u32>,
}

remembers!(Touched: bytes);

/// Positions that differ by less are one: millimetres.
const SLACK: f64 = 0.005;

impl PathRule for GoesOnAfterTouch {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let touches = |effect| is_touch(effect) || effect.probes_toward();
        program.environment.control().machine() == gcheck_controls::Machine::Mill && program.may(touches)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let touched = self.touched.take();
        let Event::Travel(travel) = event else { return };
        if touched.is_none() && !matches!(travel.kind, TravelKind::Probe { .. }) {
            return;
        }
        // Of several paths, this move may follow another one.
        if !cx.is_on_every_path() || cx.is_called_only() {
            return;
        }
        match travel.kind {
            TravelKind::Probe { toward: true, .. } => {
                if let Touch::Made(ways) = cx.state().touched() {
                    let (end, bytes) = (travel.to, cx.range());
                    self.touched = Some(Touched { ways, end, is_elsewhere: false, bytes });
                }
            }
            TravelKind::Rapid | TravelKind::Feed | TravelKind::Probe { toward: false, .. }
                if !travel.expanded && !is_in_machine_coordinates(cx) =>
            {
                if let Some(touched) = touched {
                    tell(cx, &touched, travel, report);
                }
            }
            _ => {}
        }
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        let moves_zero = matches!(
            event,
            Event::WorkOffset { .. }
                | Event::Shift(_)
                | Event::LengthOffset(_)
                | Event::Rotation(_)
                | Event::ToolTableEntry(_)
        );
        if let Some(touched) = self.touched.as_mut().filter(|_| moves_zero) {
            touched.is_elsewhere = true;
        }
    }
}

fn is_in_machine_coordinates(cx: &PathCx<'_>) -> bool {
    cx.has_effect(|effect| effect == Effect::MachineCoordinates)
}

fn tell(cx: &PathCx<'_>, touched: &Touched, travel: &Travel, report: &mut Report<'_>) {
    let Some((axis, _)) = driven(touched.ways).find(|(axis, way)| goes_on(cx, touched, travel, *axis, *way))
    else {
        return;
    };
    let letter = axis.name();
    report.add(
        cx.finding(&META, cx.letter_range(letter), "the move goes on in the direction of the touch")
            .label(format!("drives the probe further along {letter}, into what it touches"))
            .also(touched.bytes.clone(), "the probe touches here and stops")
            .help(format!("move away from the surface first: check the sign of `{letter}`")),
    );
}

/// Does the move take the axis further the way that the probe went?
fn goes_on(cx: &PathCx<'_>, touched: &Touched, travel: &Travel, axis: Axis, way: Way) -> bool {
    let onward = match way {
        Way::Up => 1.0,
        Way::Down => -1.0,
        Way::Still | Way::Unknown => return false,
    };
    let Some(number) = cx.known_number(axis.name()) else { return false };
    match cx.state().is_incremental(cx.model) {
        Some(true) => number * onward > 0.0,
        Some(false) if !touched.is_elsewhere => {
            let (Some(to), Some(end)) = (travel.to.get(axis), touched.end.get(axis)) else { return false };
            (to - end) * onward > SLACK
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(after: &str) -> String {
        format!("G21 G17 G90 G54 G0 X20 Y20\nZ10\nG38.2 Z-5 F60\n{after}\nM2\n")
    }

    #[test]
    fn a_move_off_the_touch_that_goes_on() {
        let program =
            |z: &str| format!("G21 G90 G94 G54 G17\nG0 Z10\nG38.2 Z-20 F100\nG38.4 Z{z} F20\nG0 Z30\nM2\n");
        check_rule(
            &RULE,
            "grbl",
            &program("-25"),
            &expect![[r#"
            4 | G38.4 Z-25 F20
              |       ^^^^ warning[goes-on-after-touch] the move goes on in the direction of the touch
        "#]],
        );
        check_rule(&RULE, "grbl", &program("10"), &expect![[""]]);
    }

    #[test]
    fn a_position_beyond_the_end() {
        check_rule(
            &RULE,
            "linuxcnc",
            &program("G0 Z-10"),
            &expect![[r#"
            4 | G0 Z-10
              |    ^^^^ warning[goes-on-after-touch] the move goes on in the direction of the touch
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            &program("G1 Z-5.5 F100"),
            &expect![[r#"
            4 | G1 Z-5.5 F100
              |    ^^^^^ warning[goes-on-after-touch] the move goes on in the direction of the touch
        "#]],
        );
    }

    #[test]
    fn an_increment_with_the_same_sign() {
        check_rule(
            &RULE,
            "linuxcnc",
            &program("G91 G0 Z-1"),
            &expect![[r#"
            4 | G91 G0 Z-1
              |        ^^^ warning[goes-on-after-touch] the move goes on in the direction of the touch
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            &program("G92 Z0\nG91 G0 Z-1"),
            &expect![[r#"
            5 | G91 G0 Z-1
              |        ^^^ warning[goes-on-after-touch] the move goes on in the direction of the touch
        "#]],
        );
    }

    #[test]
    fn away_from_the_surface_it_is_fine() {
        for after in ["G0 Z10", "G91 G0 Z1", "G0 X50", "G0 Z-3", "G38.2 Z-8"] {
            check_rule(&RULE, "linuxcnc", &program(after), &expect![[""]]);
        }
    }

    #[test]
    fn a_position_that_counts_from_another_zero() {
        for after in ["G10 L20 P1 Z0\nG0 Z-10", "G92 Z0\nG0 Z-10", "G55\nG0 Z-10", "G53 G0 Z-20"] {
            check_rule(&RULE, "linuxcnc", &program(after), &expect![[""]]);
        }
    }

    #[test]
    fn probing_away_leaves_the_surface_free() {
        let program = "G21 G17 G90 G54 G0 X20 Y20\nZ-4\nG38.4 Z5 F60\nG0 Z10\nM2\n";
        check_rule(&RULE, "linuxcnc", program, &expect![[""]]);
    }
}
