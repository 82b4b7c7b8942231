//! A rapid move of a lathe under a surface that the program has turned.

use std::ops::Range;

use gcheck_controls::Machine;
use gcheck_engine::{At, Axis, Event, Position, Travel, TravelKind};
use gcheck_geometry::Plane;

use crate::declare::declare_rule;
use crate::facts::tool_words::ToolWords;
use crate::facts::turning::shown_radius;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A lathe moves along Z at rapid, nearer to the centre than a surface that the program has turned or faced, and then
    /// feeds outward through that surface, at once or after it was fed on along Z. No earlier cut was so near to the centre there.
    ///
    /// A boring bar that goes into a bore at rapid never feeds out through the outside of the part, so it is not reported; nor is a
    /// tool whose comment says that it bores.
    ///
    /// ## Why it matters
    /// The tool is driven into the face of the part at rapid. Mostly a diameter is wrong, or `G0` was written instead of
    /// `G1`.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 T0101
    /// G97 S800 M3
    /// G0 X42. Z2.
    /// G1 Z-40. F.2
    /// X44.
    /// G0 X30. Z2.
    /// G0 Z-40.
    /// G1 X42. F.2
    /// G0 X100. Z100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 T0101
    /// G97 S800 M3
    /// G0 X42. Z2.
    /// G1 Z-40. F.2
    /// X44.
    /// G0 X30. Z2.
    /// G1 Z-40.
    /// X42. F.2
    /// G0 X100. Z100.
    /// M30
    /// ```
    rule "rapid-under-turned-surface" in "motion" {
        summary: "rapid move of a lathe under a surface that it has turned",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES,
            make: || Box::new(RapidUnderTurnedSurface::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidUnderTurnedSurface {
    cuts: Vec<Cut>,
    /// The work offset that the cuts count from.
    work: Option<u16>,
    /// The move before this one, if it is a rapid move along Z.
    dive: Option<Dive>,
    /// The move that was reported.
    told: Option<At>,
    /// Something that is not known was cut.
    is_blind: bool,
}

remembers!(RapidUnderTurnedSurface: cuts, dive, told);

/// A cut: X as a radius, and Z, of both ends.
#[derive(Clone, PartialEq)]
struct Cut {
    ends: [[f64; 2]; 2],
    bytes: Range<u32>,
}

remembers!(Cut: bytes);

/// A rapid move along Z.
#[derive(Clone, PartialEq)]
struct Dive {
    at: At,
    radius: f64,
    from: f64,
    to: f64,
    bytes: Range<u32>,
    /// How many cuts came before it.
    before: usize,
}

remembers!(Dive: at, bytes);

/// Longer programs come from a system.
const MOST: usize = 2000;
/// Radii and levels that differ by less are one: millimetres.
const SLACK: f64 = 0.05;
/// So far under the zero of the part, and under the surface: millimetres.
const UNDER: f64 = 1.0;

impl PathRule for RapidUnderTurnedSurface {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().machine() == Machine::Lathe
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let dive = self.dive.take();
        let is_known = cx.is_certain();
        if !is_known || self.is_blind || self.cuts.len() >= MOST {
            *self = Self { is_blind: true, ..Self::default() };
            cx.enough();
            return;
        }
        if cx.state().plane(cx.model) != Some(Plane::Zx) {
            return;
        }
        if self.work != cx.state().work() {
            *self = Self { work: cx.state().work(), ..Self::default() };
        }
        match event {
            Event::Travel(travel) if travel.kind == TravelKind::Rapid => {
                self.dive = look(cx, travel, self.cuts.len());
            }
            Event::Travel(travel) => {
                if let Some(dive) = dive.filter(|_| travel.kind == TravelKind::Feed) {
                    self.judge(cx, &dive, travel, report);
                    self.dive = Some(dive).filter(|dive| goes_on(dive, travel));
                }
                self.cut(cx, &travel.from, &travel.to);
            }
            Event::Arc(arc) => self.cut(cx, &arc.from, &arc.to),
            _ => self.is_blind = true,
        }
    }
}

/// A rapid move along Z to below the zero of the part, with the tool on the near side of the centre.
fn look(cx: &PathCx<'_>, travel: &Travel, before: usize) -> Option<Dive> {
    let ([from_radius, from], [radius, to]) = (point(&travel.from), point(&travel.to));
    let is_along_z = (radius - from_radius).abs() < SLACK && from - to > UNDER;
    (is_along_z && !travel.expanded && radius > UNDER && to < -UNDER).then(|| Dive {
        at: cx.origin().at,
        radius,
        from,
        to,
        bytes: cx.range(),
        before,
    })
}

/// Is the tool fed on along Z, at the radius of the rapid move?
fn goes_on(dive: &Dive, travel: &Travel) -> bool {
    let [radius, z] = point(&travel.to);
    (radius - dive.radius).abs() < SLACK && z < dive.to && !travel.expanded
}

fn point(position: &Position) -> [f64; 2] {
    [position.raw(Axis::X), position.raw(Axis::Z)]
}

impl RapidUnderTurnedSurface {
    fn cut(&mut self, cx: &PathCx<'_>, from: &Position, to: &Position) {
        let ends = [point(from), point(to)];
        if ends.iter().flatten().any(|coordinate| coordinate.is_nan()) {
            self.is_blind = true;
        } else {
            self.cuts.push(Cut { ends, bytes: cx.range() });
        }
    }

    /// A feed after the rapid move.
    fn judge(&mut self, cx: &PathCx<'_>, dive: &Dive, travel: &Travel, report: &mut Report<'_>) {
        let [radius, z] = point(&travel.to);
        let [_, from] = point(&travel.from);
        let is_outward = (z - from).abs() < SLACK && z < dive.to + SLACK && radius > dive.radius + UNDER;
        if !is_outward
            || ToolWords::of(cx).may_bore()
            || self.told == Some(dive.at)
            || self.cuts.iter().take(dive.before).any(|cut| cut.opens(dive))
        {
            return;
        }
        let Some(surface) = self.cuts.iter().take(dive.before).rev().find(|cut| cut.is_above(dive, radius))
        else {
            return;
        };
        self.told = Some(dive.at);
        let shown = |radius: f64| shown_radius(cx, radius);
        report.add(
            cx.finding(
                &META,
                dive.bytes.clone(),
                "rapid move into the part, under a surface that was turned",
            )
            .label(format!("at X {}, where no earlier cut is so near to the centre", shown(dive.radius)))
            .also(surface.bytes.clone(), "the surface that the program turns")
            .also(cx.range(), format!("the tool feeds out through it, to X {}", shown(radius)))
            .assuming("the part has no bore there before the program starts")
            .help("check the diameter of the move before it, or make the move at feed (`G1`)"),
        );
    }
}

impl Cut {
    /// Was the part cut as near to the centre as the rapid move goes, somewhere on its way under the zero of the part?
    fn opens(&self, dive: &Dive) -> bool {
        let [[r0, z0], [r1, z1]] = self.ends;
        let reaches = r0.min(r1) <= dive.radius + SLACK;
        // A face that is cut to the centre opens nothing further on; a roughing cycle leaves its allowance.
        let is_face = (z0 - z1).abs() < SLACK && z0 > dive.to + UNDER;
        reaches && !is_face && z0.min(z1) <= dive.to + UNDER
    }

    /// Is it the outside of the part above the way of the rapid move, and does a feed out to this radius go through it?
    fn is_above(&self, dive: &Dive, radius: f64) -> bool {
        let [[r0, z0], [r1, z1]] = self.ends;
        let (low, high) = (r0.min(r1), r0.max(r1));
        let is_turned = low > dive.radius + UNDER
            && high <= radius + SLACK
            && z0.min(z1) <= dive.to + SLACK
            && z0.max(z1) >= dive.to - SLACK
            && (z0 - z1).abs() > UNDER;
        let is_shoulder = (z0 - z1).abs() < SLACK
            && z0 < dive.from - SLACK
            && z0 > dive.to + UNDER
            && low <= dive.radius
            && high > dive.radius + UNDER
            && high <= radius + SLACK;
        is_turned || is_shoulder
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(before: &str, after: &str) -> String {
        format!("G21 G40 T0101\nG97 S800 M3\nG0 X60. Z2.\n{before}{after}\nG0 X200. Z100.\nM30\n")
    }

    const TURNED: &str = "G0 X42.\nG1 Z-40. F.2\nX60.\nG0 Z2.\n";

    #[test]
    fn through_the_outside_from_within() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program(TURNED, "G0 X30.\nZ-30.\nG1 X50. F.2"),
            &expect![[r#"
            9 | Z-30.
              | ^^^^^ warning[rapid-under-turned-surface] rapid move into the part, under a surface that was turned
        "#]],
        );
        // First on along Z at feed.
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program(TURNED, "G0 X30.\nZ-10.\nG1 Z-20. F.2\nX50."),
            &expect![[r#"
            9 | Z-10.
              | ^^^^^ warning[rapid-under-turned-surface] rapid move into the part, under a surface that was turned
        "#]],
        );
        for way in ["G0 X30.\nZ1.\nG1 Z-20. F.2\nX50.", "G0 X30.\nZ-10.\nG1 Z-20. F.2\nX28."] {
            check_rule(&RULE, "fanuc-lathe", &program(TURNED, way), &expect![[""]]);
        }
        // Into a bore, which was there before.
        check_rule(&RULE, "fanuc-lathe", &program(TURNED, "G0 X30.\nZ-30.\nG1 X34. F.2"), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &program(TURNED, "G0 X30.\nZ-30.\nG1 Z-32. F.2"), &expect![[""]]);
    }

    #[test]
    fn behind_a_shoulder() {
        let shoulder = "G0 X20.\nG1 Z-10. F.2\nX60.\nG0 Z2.\n";
        check_rule(
            &RULE,
            "haas-lathe",
            &program(shoulder, "G0 X24.\nZ-30.\nG1 X60. F.2"),
            &expect![[r#"
            9 | Z-30.
              | ^^^^^ warning[rapid-under-turned-surface] rapid move into the part, under a surface that was turned
        "#]],
        );
        check_rule(&RULE, "haas-lathe", &program(shoulder, "G0 X24.\nZ-8.\nG1 X60. F.2"), &expect![[""]]);
    }

    #[test]
    fn where_an_earlier_cut_was_as_deep() {
        let neck = "G0 X28.\nG1 Z-40. F.2\nX60.\nG0 Z2.\n";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program(&format!("{TURNED}{neck}"), "G0 X30.\nZ-30.\nG1 X50. F.2"),
            &expect![[""]],
        );
        let drilled = "G0 X0.\nG1 Z-60. F.1\nG0 Z2.\n";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program(&format!("{TURNED}{drilled}"), "G0 X30.\nZ-30.\nG1 X50. F.2"),
            &expect![[""]],
        );
    }

    #[test]
    fn from_inside_a_cup() {
        let faced = "G0 X20.\nG72 W1. R.3\nG72 P5 Q6 U-.3 W.1 F.2\nN5 G0 Z-20.\nG1 X50. F.12\nZ-10.\nX60. Z-5.\nN6 Z1.\n";
        check_rule(&RULE, "fanuc-lathe", &program(faced, "G70 P5 Q6\nG0 Z50."), &expect![[""]]);
        let bored = "G0 X30.\nZ-30.\nG1 X50. F.2";
        let program = program(TURNED, bored);
        let bar = program.replace("G0 X30.", "T0404 (BORING BAR)\nG0 X30.");
        check_rule(&RULE, "fanuc-lathe", &bar, &expect![[""]]);
    }

    #[test]
    fn what_is_not_known_is_not_judged() {
        let program = program(&TURNED.replace("X42.", "X#500"), "G0 X30.\nZ-30.\nG1 X50. F.2");
        check_rule(&RULE, "fanuc-lathe", &program, &expect![[""]]);
    }

    #[test]
    fn a_roughing_cycle_turns_too() {
        let roughed =
            "G71 U2. R1.\nG71 P10 Q20 U.4 W.1 F.25\nN10 G0 X20.\nG1 Z-20. F.1\nN20 X60.\nG70 P10 Q20\n";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program(roughed, "G0 X24.\nZ-30.\nG1 X60. F.2"),
            &expect![[r#"
            11 | Z-30.
               | ^^^^^ warning[rapid-under-turned-surface] rapid move into the part, under a surface that was turned
        "#]],
        );
    }
}
