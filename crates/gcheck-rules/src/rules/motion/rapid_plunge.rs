//! A rapid move down into the part.

use std::ops::Range;

use gcheck_engine::{Event, Position, Travel, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cuts::{Clear, Cuts, point};
use crate::{Finding, FinishCx, MakeShared, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A rapid move takes the tool from above the zero of the part to below it, at a place where no earlier move has
    /// cut so deep, and the next move feeds straight on down.
    ///
    /// A tool that goes down beside the part to cut a contour feeds sideways next. That is reported, as *info*, only if
    /// it is the program's one rapid move of this kind and the tool is fed down three or more times.
    ///
    /// ## Why it matters
    /// If the tool drills on from there, there is material: it hits the part at rapid. Often a minus sign is wrong, or
    /// a `G0` of an earlier block is still the motion mode.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X10. Y10.
    /// G43 H1 Z5.
    /// Z-2.
    /// G1 Z-20. F100.
    /// G0 Z5.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X10. Y10.
    /// G43 H1 Z5.
    /// Z2.
    /// G1 Z-10. F100.
    /// G0 Z5.
    /// G0 Z-9.
    /// G1 Z-20.
    /// G0 Z5.
    /// M30
    /// ```
    rule "rapid-plunge" in "motion" {
        summary: "rapid move down into the part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::FINISH),
            make: || Box::new(RapidPlunge::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidPlunge {
    /// The move before this one, if it went down.
    plunge: Option<Plunge>,
    /// How often the tool was fed straight down from above the part, up to [`MANY`].
    fed: u8,
    /// Rapid moves down from where the tool cut on sideways: the first, and how many.
    odd: Option<(Finding, u32)>,
    /// The largest radius around which the drawing was wrapped, millimetres.
    widest: f64,
}

remembers!(RapidPlunge: plunge, odd);

/// A rapid move down.
#[derive(Clone, PartialEq)]
struct Plunge {
    bytes: Range<u32>,
    to: [f64; 3],
    clear: Clear,
}

remembers!(Plunge: bytes);

/// Millimetres: heights that differ by less are one, and the surface is this thick.
const LEVEL: f64 = 0.01;
/// After so many moves down at feed, one rapid move down is suspicious.
const MANY: u8 = 3;

impl PathRule for RapidPlunge {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Cuts::shared)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let plunge = self.plunge.take();
        let Some(cuts) = cx.shared::<Cuts>().filter(|cuts| cuts.knows(cx, event)) else {
            if cx.shared::<Cuts>().is_none_or(Cuts::is_blind) {
                cx.enough();
            }
            return;
        };
        if let Event::Travel(travel) = event {
            if is_fed_down(travel) {
                self.fed = (self.fed + 1).min(MANY);
            }
            match plunge {
                Some(plunge) if feeds_on_down(travel, plunge.to) => report.add(tell(
                    cx,
                    &plunge,
                    "rapid move down into the part",
                    "the tool feeds on down from there",
                )),
                Some(plunge) if travel.kind == TravelKind::Feed => self.note(cx, &plunge, &travel.to),
                _ => {}
            }
            let surface = self.surface(cx);
            self.plunge = look(cx, cuts, travel, surface);
        } else if let (Some(plunge), Event::Arc(arc)) = (plunge, event) {
            self.note(cx, &plunge, &arc.to);
        }
    }

    fn finish(&mut self, _: &FinishCx<'_>, report: &mut Report<'_>) {
        if let Some((finding, 1)) = self.odd.take().filter(|_| self.fed >= MANY) {
            report
                .add(finding.note("everywhere else the program feeds the tool down").at_most(Severity::Info));
        }
    }
}

impl RapidPlunge {
    /// Where the part begins, in Z: at its zero, or where a step of a shaft lies below the widest one.
    fn surface(&mut self, cx: &PathCx<'_>) -> f64 {
        let Some(cylinder) = cx.state().wrapped().cylinder() else { return 0.0 };
        let radius = cylinder.diameter / 2.0;
        if radius.is_finite() {
            self.widest = self.widest.max(radius);
            radius - self.widest
        } else {
            f64::NEG_INFINITY
        }
    }

    /// Keeps a rapid move down after which the tool cuts on sideways.
    fn note(&mut self, cx: &PathCx<'_>, plunge: &Plunge, to: &Position) {
        let cuts_on = point(to).is_some_and(|[.., z]| (z - plunge.to[2]).abs() < LEVEL);
        match &mut self.odd {
            _ if !cuts_on => {}
            // A loop repeats it.
            Some((finding, _)) if finding.range == plunge.bytes => {}
            Some((_, count)) => *count = 2,
            None => {
                let finding =
                    tell(cx, plunge, "the one rapid move down to a cut", "the tool cuts on from there");
                self.odd = Some((finding, 1));
            }
        }
    }
}

/// A rapid move from above the part to a depth that nothing has reached at that place.
fn look(cx: &PathCx<'_>, cuts: &Cuts, travel: &Travel, surface: f64) -> Option<Plunge> {
    if travel.kind != TravelKind::Rapid || travel.expanded {
        return None;
    }
    let to = point(&travel.to)?;
    let above = travel.from.get(gcheck_engine::Axis::Z)? >= 0.0;
    let [x, y, z] = to;
    if !above || z >= surface - LEVEL {
        return None;
    }
    let clear = Clear::of(cx);
    if cuts.reach(cuts.len(), [x, y], z, clear.radius) {
        return None;
    }
    Some(Plunge { bytes: cx.range(), to, clear })
}

fn feeds_on_down(travel: &Travel, [x, y, z]: [f64; 3]) -> bool {
    let Some([x1, y1, z1]) = point(&travel.to) else { return false };
    travel.kind == TravelKind::Feed && (x1 - x).hypot(y1 - y) < LEVEL && z1 < z - LEVEL
}

/// Straight down at feed, from above the part to below its zero?
fn is_fed_down(travel: &Travel) -> bool {
    let (Some([x0, y0, z0]), Some([x1, y1, z1])) = (point(&travel.from), point(&travel.to)) else {
        return false;
    };
    let is_plain = travel.kind == TravelKind::Feed && !travel.expanded;
    is_plain && (x1 - x0).hypot(y1 - y0) < LEVEL && z0 >= 0.0 && z1 < -LEVEL
}

fn tell(cx: &PathCx<'_>, plunge: &Plunge, message: &str, next: &str) -> Finding {
    let depth = cx.shown(Mm(-plunge.to[2]));
    let finding = cx
        .finding(&META, plunge.bytes.clone(), message)
        .label(format!("{depth} below the zero of the part, where no earlier cut is so deep"))
        .also(cx.range(), next)
        .assuming("the part is solid where the program has not cut")
        .help("end the rapid move above the part, and feed from there");
    match &plunge.clear.assumption {
        Some(assumption) => finding.assuming(assumption.clone()),
        None => finding,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_rapid_move_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G54 G0 X10. Y10. Z5.\nG0 Z-2.\nG1 Z-20. F100.\nG0 Z5.\nX50. Z-3.\nG1 Z-4.\nG0 Z5.\nM30\n",
            &expect![[r#"
                2 | G0 Z-2.
                  | ^^^^^^^ warning[rapid-plunge] rapid move down into the part
                5 | X50. Z-3.
                  | ^^^^^^^^^ warning[rapid-plunge] rapid move down into the part
            "#]],
        );
    }

    #[test]
    fn a_narrower_step_of_a_shaft_lies_deeper() {
        let shaft = |radius: &str, z: &str| {
            format!(
                "G20 G90 G54 G0 X0. Y0. Z1.\nG107 Y0. A0. R1.5\nG0 Z.1\nG1 Z-.05 F10.\nY4.\nG0 Z1.\nY0.\nG107\nG107 Y0. A0. R{radius}\nG0 X3.\nZ{z}\nG1 Z-.4\nG0 Z1.\nG107\nM30\n"
            )
        };
        check_rule(&RULE, "haas-mill", &shaft("1.25", "-.15"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &shaft("1.25", "-.3"),
            &expect![[r#"
                11 | Z-.3
                   | ^^^^ warning[rapid-plunge] rapid move down into the part
            "#]],
        );
    }

    #[test]
    fn going_down_beside_the_part_is_fine() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G54 G0 X-10. Y0. Z5.\nG0 Z-2.\nG1 X50. F100.\nG0 Z5.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn the_one_that_is_not_fed_is_odd() {
        let program = |first: &str| {
            let plunge = |x: u8, by: &str| format!("G0 X{x}. Y0.\n{by} Z-2.\nG1 Y30.\nG0 Z5.\n");
            let rest = [plunge(40, "G0"), plunge(60, "G1"), plunge(80, "G1")].concat();
            format!("G21 G90 G54 G0 X0. Y0. Z5. F90.\n{}{rest}M30\n", plunge(20, first))
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G1"),
            &expect![[r#"
            7 | G0 Z-2.
              | ^^^^^^^ info[rapid-plunge] the one rapid move down to a cut
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("G0"), &expect![[""]]);
    }

    #[test]
    fn a_hole_that_a_cycle_has_drilled_is_open() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G54 G0 X10. Y10. Z5.\nG81 Z-8. R2. F100.\nG80\nG0 Z-7.\nG1 Z-20.\nG0 Z5.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn words_state_the_assumption() {
        let program = "G20 G90 G54 G0 X1. Y1. Z1.\nG0 Z-.1\nG1 Z-1. F10.\nG0 Z1.\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            rapid move down into the part
              here: 0.1 in below the zero of the part, where no earlier cut is so deep
              there: the tool feeds on down from there
              assuming: the part is solid where the program has not cut
              assuming: no cutter is wider than 25.4 mm (1 in)
              help: end the rapid move above the part, and feed from there
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
