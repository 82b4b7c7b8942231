//! A drilling cycle whose retract plane lies in the material.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, At, Axis, Domain, Event, Fact, Role, Travel, TravelKind};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::facts::boundary::is_before;
use crate::facts::cuts::{Clear, Cuts, LEVEL, SURFACE, WIDE, distance, may_hide_cuts, point};
use crate::facts::cycles::is_cycle;
use crate::facts::offset_schemes::whole;
use crate::{Finding, FollowedCx, MakeShared, PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A canned cycle takes the tool at rapid to a retract plane (`R`) below the zero of the part, where nothing was cut
    /// so deep, and the program shows that there is material:
    ///
    /// * an earlier cut at that place is less deep,
    /// * another tool begins above the zero at that place,
    /// * a tap begins in a hole that only one tool drilled: the tap is wider than its hole,
    /// * another cycle of the program has the same `R` with the other sign,
    /// * `R` counted from the level before the cycle is close above the zero, and no cycle begins above the zero, or one with
    ///   that very `R`, or
    /// * no cycle of the program begins above the zero, but its rapid moves end close above it.
    ///
    /// A cycle that goes from hole to hole at its `R` (`G99`) is reported too where both holes are in pockets that the program has milled
    /// from above, and the way between them leaves those: a warning where the top of the part there was milled, else *info*.
    ///
    /// Without such a sign it is *info*, and only if no cycle of the program begins above the zero: the hole may be in a recess
    /// that was there before, or on a lower step of the part.
    ///
    /// ## Why it matters
    /// The way to `R` is a rapid move. The drill hits the surface at rapid and breaks. Mostly there is a minus sign too many
    /// (`R-.1` for `R.1`).
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G20 G90 G54 G0 X0. Y0. S2000 M3
    /// G43 H1 Z1.
    /// G81 Z-.15 R.1 F12.
    /// X1.
    /// G80
    /// T2 M6
    /// G54 G0 X0. Y0. S2000 M3
    /// G43 H2 Z1.
    /// G83 Z-1. R-.1 Q.1 F12.
    /// X1.
    /// G80
    /// M30
    /// ```
    /// `R` was meant from the level before the cycle.
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G20 G90 G54 G0 X0. Y0. S2000 M3
    /// G43 H1 Z1.
    /// G99 G83 Z-1.2 R-.9 Q.2 F9.
    /// G80
    /// T2 M6
    /// G54 G0 X0. Y0. S400 M3
    /// G43 H2 Z1.
    /// G84 Z-.8 R.2 F20.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G20 G90 G54 G0 X0. Y0. S2000 M3
    /// G43 H1 Z1.
    /// G81 Z-.15 R.1 F12.
    /// X1.
    /// G80
    /// T2 M6
    /// G54 G0 X0. Y0. S2000 M3
    /// G43 H2 Z1.
    /// G83 Z-1. R.1 Q.1 F12.
    /// X1.
    /// G80
    /// M30
    /// ```
    /// The hole is drilled from the floor of a pocket.
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G20 G90 G54 G0 X0. Y0. S2000 M3
    /// G43 H1 Z.1
    /// G13 D1 I.5 Z-.25 F12.
    /// G0 Z1.
    /// G83 Z-1. R-.15 Q.1 F12.
    /// G80
    /// M30
    /// ```
    rule "cycle-r-in-material" in "cycles" {
        summary: "canned cycle whose R lies in the material",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::RAPIDS.union(Watch::FOLLOWED),
            make: || Box::new(CycleRInMaterial::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleRInMaterial {
    /// Strokes so far.
    strokes: Vec<Stroke>,
    /// Cycles whose `R` is suspicious.
    doubts: Vec<Doubt>,
    /// A rapid move down that belongs to no cycle ends close above the zero.
    shows_surface: bool,
    /// Where such moves ended.
    surfaces: Vec<[f64; 2]>,
    /// The cycle whose way between two holes was reported.
    between: Option<At>,
}

remembers!(CycleRInMaterial: doubts, between);

/// A stroke of a cycle, millimetres.
#[derive(Clone, Copy, PartialEq)]
struct Stroke {
    at: [f64; 2],
    r: f64,
    bottom: f64,
    /// The number of the tool; 0 if it is unknown.
    tool: u32,
}

/// A retract plane below the zero of the part.
#[derive(Clone, PartialEq)]
struct Doubt {
    /// The block that began the cycle.
    cycle: Option<At>,
    finding: Finding,
    stroke: Stroke,
    /// The level before the cycle.
    start: f64,
    /// A tap in a hole that only one tool has drilled.
    is_narrow: bool,
    /// A spot from a higher plane is at the same place; it hides whether the place is open.
    spot: Option<f64>,
    /// Is it certain that the place is solid at this level?
    is_solid: bool,
}

remembers!(Doubt: cycle, finding);

/// Programs with more strokes come from a system that computes its planes.
const MOST: usize = 2000;
/// Points that are nearer than this are one: millimetres.
const NEAR: f64 = 0.1;
/// A hole that goes no further below the plane than this is a spot, in which no drill is free: millimetres.
const SPOT: f64 = 4.0;
/// The most clearance above a surface: millimetres.
const CLEARANCE: f64 = 6.35;
/// A retract plane is closer above its surface: millimetres.
const CLOSE: f64 = 3.0;
/// A plane that is deeper is in a pocket: millimetres.
const DEEP: f64 = 0.5;
/// The way between two holes is looked at in pieces of this length, half as long as the widest cutter is: millimetres.
const PIECE: f64 = 6.0;
/// A tool comes down to a pocket no farther from the holes in it: millimetres.
const AROUND: f64 = 60.0;
/// The tip of a tap fits into its hole so far: millimetres.
const TIP: f64 = 1.0;

impl PathRule for CycleRInMaterial {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Cuts::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_cycle) && program.environment.control().machine() == gcheck_controls::Machine::Mill
    }

    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        if ends_at_surface(travel) {
            self.shows_surface = true;
            if let Some([x, y, _]) = point(&travel.to).filter(|_| self.surfaces.len() < MOST) {
                self.surfaces.push([x, y]);
            }
        }
        if let Some(finding) = self.way_between(cx, event, travel) {
            self.between = cx.definitions().set_by(Fact::Mode(Role::Cycle));
            report.add(finding);
        }
        if self.strokes.len() >= MOST {
            return;
        }
        let Some(stroke) = stroke(cx, travel) else { return };
        if stroke.r < SURFACE {
            self.doubt(cx, travel, &stroke);
        }
        // A cycle with pecks comes back to its plane again and again.
        if self.strokes.last() != Some(&stroke) {
            self.strokes.push(stroke);
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        for doubt in std::mem::take(&mut self.doubts) {
            let own = doubt.stroke;
            let has = |r: f64| self.strokes.iter().any(|stroke| (stroke.r - r).abs() < LEVEL);
            let mirrors = has(-own.r);
            let begins_above = self.strokes.iter().any(|stroke| {
                stroke.r > -SURFACE && stroke.tool != own.tool && distance(stroke.at, own.at) <= NEAR
            });
            let all_below = self.strokes.iter().all(|stroke| stroke.r < SURFACE);
            let counted = own.r + doubt.start;
            let counts_on = counted > LEVEL && (has(counted) || all_below && counted <= CLOSE);
            let is_spotted = doubt.spot.is_some_and(|r| (r + own.r).abs() < LEVEL);
            let is_open = doubt.spot.is_some();
            let why = if doubt.is_narrow {
                Some("only one tool has drilled here, and a tap is wider than its hole")
            } else if mirrors {
                Some("another cycle of the program has this `R` with the other sign")
            } else if counts_on && !is_open {
                Some("counted from the level before the cycle, the plane is close above the zero")
            } else if begins_above && !is_open {
                Some("another tool begins above the zero at this place")
            } else if all_below && self.shows_surface && !is_open {
                Some("rapid moves of the program end close above the zero")
            } else {
                None
            };
            let is_sure = doubt.is_solid || is_spotted || doubt.is_narrow || why.is_some() && !is_open;
            let finding = match why {
                Some(why) => doubt.finding.note(why),
                None => doubt.finding,
            };
            if is_sure {
                report.add(finding);
            } else if !is_open && all_below {
                report.add(finding.at_most(Severity::Info));
            }
        }
    }
}

impl CycleRInMaterial {
    /// The way of a cycle at its plane from one pocket to another, through what is between them.
    fn way_between(&self, cx: &PathCx<'_>, event: &Event, travel: &Travel) -> Option<Finding> {
        let ([x0, y0, z0], [x1, y1, z]) = (point(&travel.from)?, point(&travel.to)?);
        let is_level = (z0 - z).abs() <= LEVEL && z < -DEEP;
        // Most holes begin above the part.
        if !travel.expanded || !is_level || (z - cx.state().cycle().r).abs() > LEVEL {
            return None;
        }
        let length = distance([x0, y0], [x1, y1]);
        let cycle = cx.definitions().set_by(Fact::Mode(Role::Cycle));
        if length <= 2.0 * WIDE || self.between.is_some() && self.between == cycle {
            return None;
        }
        let is_known = cx.is_certain() && cx.state().plane(cx.model) == Some(Plane::Xy) && !may_hide_cuts(cx);
        let cuts = cx.shared::<Cuts>().filter(|cuts| is_known && cuts.knows(cx, event))?;
        let is_in_pocket = |at: [f64; 2]| {
            let is_from_above = self.surfaces.iter().any(|surface| distance(*surface, at) < AROUND);
            is_from_above && cuts.reach_sideways(at, z, WIDE)
        };
        if !is_in_pocket([x0, y0]) || !is_in_pocket([x1, y1]) {
            return None;
        }
        #[expect(clippy::cast_sign_loss, reason = "a length below 100 m")]
        let pieces = (length / PIECE).clamp(2.0, 2_000.0) as u32;
        let on_the_way = (1..pieces).map(|piece| {
            let part = f64::from(piece) / f64::from(pieces);
            [x0 + (x1 - x0) * part, y0 + (y1 - y0) * part]
        });
        let near = cuts.near_way([x0, y0], [x1, y1], -SURFACE, WIDE);
        let is_cut = |at: [f64; 2], z: f64| near.iter().any(|cut| cut.is_below(z) && cut.reaches(at, WIDE));
        let closed: Vec<[f64; 2]> = on_the_way.filter(|at| !is_cut(*at, z)).take(MOST).collect();
        let first = closed.first()?;
        let is_milled = closed.iter().any(|at| is_cut(*at, -SURFACE));
        let return_level = cx.name_of_effect(Effect::ReturnToInitial)?;
        let place = first.map(|coordinate| cx.shown(Mm(coordinate))).join(", ");
        let finding = cx
            .finding(&META, cx.range(), "the cycle goes at rapid from hole to hole through the part")
            .label(format!(
                "{} below the zero of the part; at {place} nothing was cut as deep",
                cx.shown(Mm(-z))
            ))
            .also(word_of_plane(cx, cycle), "at this level")
            .assuming("the part is solid where the program has not cut")
            .assuming("no cutter is wider than 25.4 mm (1 in)")
            .help(format!("go back to the level before the cycle between these holes (`{return_level}`)"));
        Some(if is_milled { finding } else { finding.at_most(Severity::Info) })
    }

    fn doubt(&mut self, cx: &PathCx<'_>, travel: &Travel, stroke: &Stroke) {
        let cycle = cx.definitions().set_by(Fact::Mode(Role::Cycle));
        let start = travel.from.raw(Axis::Z);
        let comes_from_above = start >= 0.0;
        // Words of a cycle that began in increments count from elsewhere.
        let mode = cx.definitions().set_by(Fact::Mode(Role::Distance));
        let is_switched = mode.zip(cycle).is_some_and(|(mode, cycle)| is_before(cycle, mode));
        if cx.state().is_incremental(cx.model) != Some(false) || is_switched {
            return;
        }
        if may_hide_cuts(cx)
            || !comes_from_above
            || !cx.is_on_every_path()
            || self.doubts.iter().any(|doubt| doubt.cycle == cycle)
        {
            return;
        }
        let event = Event::Travel(*travel);
        let Some(cuts) = cx.shared::<Cuts>().filter(|cuts| cuts.knows(cx, &event)) else { return };
        let clear = Clear::among(cx, cuts);
        let reaches = |z: f64| cuts.reach(cuts.len(), stroke.at, z, clear.radius);
        let is_spot = |other: &&Stroke| {
            distance(other.at, stroke.at) <= NEAR
                && other.r > stroke.r + LEVEL
                && other.bottom > stroke.r - SPOT
        };
        let spot = self.strokes.iter().rev().find(is_spot).map(|spot| spot.r);
        let is_open = reaches(stroke.r);
        let is_narrow = is_open && self.is_narrow(cx, cuts, stroke, clear.radius);
        if is_open && spot.is_none() && !is_narrow {
            return;
        }
        let is_solid = !is_open && reaches(-SURFACE);
        let range = word_of_plane(cx, cycle);
        let mut finding = cx
            .finding(&META, range, "the cycle goes at rapid to below the surface of the part (`R`)")
            .label(format!(
                "{} below the zero of the part, where {}",
                cx.shown(Mm(-stroke.r)),
                if is_narrow { "the hole is only drilled" } else { "no earlier cut is so deep" }
            ))
            .assuming("the part is solid where the program has not cut")
            .help("give a retract plane above the surface: check the sign of `R`");
        if let Some(assumption) = clear.assumption.filter(|_| !is_open) {
            finding = finding.assuming(assumption);
        }
        let spot = spot.filter(|_| is_open);
        self.doubts.push(Doubt { cycle, finding, stroke: *stroke, start, is_narrow, spot, is_solid });
    }

    /// Is it a tap in a hole that one drill alone has made?
    fn is_narrow(&self, cx: &PathCx<'_>, cuts: &Cuts, stroke: &Stroke, radius: f64) -> bool {
        let code = cx.state().active_cycle(cx.model).filter(|code| code.is_some());
        let taps = code.is_some_and(|code| cx.model.effect(code).is_tapping_cycle());
        if !taps || stroke.tool == 0 || stroke.r > -TIP || cuts.reach_sideways(stroke.at, stroke.r, radius) {
            return false;
        }
        let is_hole = |other: &&Stroke| {
            distance(other.at, stroke.at) <= NEAR && other.tool != stroke.tool && other.bottom <= stroke.r
        };
        let mut holes = self.strokes.iter().filter(is_hole);
        let Some(first) = holes.next().filter(|hole| hole.r > -SURFACE) else { return false };
        // A second tool may have made the hole wider at its top.
        first.tool != 0 && holes.all(|hole| hole.tool == first.tool)
    }
}

/// Is it a rapid move down, of no cycle, to close above the zero of the part?
fn ends_at_surface(travel: &Travel) -> bool {
    let z = travel.to.raw(Axis::Z);
    !travel.expanded && z > LEVEL && z <= CLEARANCE && travel.from.get(Axis::Z).is_none_or(|from| from > z)
}

/// The stroke that begins with this rapid move of a cycle to its retract plane.
fn stroke(cx: &PathCx<'_>, travel: &Travel) -> Option<Stroke> {
    if !travel.expanded || travel.kind != TravelKind::Rapid || cx.state().plane(cx.model) != Some(Plane::Xy) {
        return None;
    }
    let code = cx.state().active_cycle(cx.model).filter(|code| code.is_some())?;
    let words = cx.state().cycle();
    let [x, y, z] = point(&travel.to)?;
    let is_down = cx.model.effect(code) != Effect::CycleBackBore && !cx.model.drills_across(code);
    let goes_to_plane = (z - words.r).abs() <= LEVEL && words.z < words.r - LEVEL;
    let tool = Abstract::known(cx.state().tool()).and_then(whole).unwrap_or(0);
    (is_down && goes_to_plane).then_some(Stroke { at: [x, y], r: words.r, bottom: words.z, tool })
}

/// The `R` of this block, or of the block that began the cycle.
fn word_of_plane(cx: &PathCx<'_>, cycle: Option<At>) -> Range<u32> {
    let is_r = |word: &gcheck_program::Word| word.letter.ascii() == b'R' && !word.letter.is_corner();
    let own = cx.find_word(cx.origin().at, is_r);
    own.or_else(|| cx.find_word(cycle?, is_r)).unwrap_or_else(|| cx.range())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(before: &str, cycle: &str) -> String {
        format!("T1 M6\nG21 G90 G54 G0 X0. Y0. S900 M3\nG43 H1 Z25.\n{before}{cycle}\nX40.\nG80\nM30\n")
    }

    const DRILLED: &str = "G83 X0. Y0. Z-25. R-2. Q3. F90.";

    #[test]
    fn the_same_plane_with_the_other_sign() {
        let other = "G81 X200. Y80. Z-9. R2. F90.\nG80\n";
        check_rule(
            &RULE,
            "haas-mill",
            &program(other, DRILLED),
            &expect![[r#"
            6 | G83 X0. Y0. Z-25. R-2. Q3. F90.
              |                   ^^^^ warning[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program(other, &DRILLED.replace("R-2", "R2")), &expect![[""]]);
        // A cycle that comes later counts as well.
        let later = program("", &format!("{DRILLED}\nG80\nG0 Z25.\nG81 X200. Y80. Z-9. R2. F90."));
        check_rule(
            &RULE,
            "linuxcnc",
            &later.replace("M30", "M2"),
            &expect![[r#"
            4 | G83 X0. Y0. Z-25. R-2. Q3. F90.
              |                   ^^^^ warning[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
    }

    /// A contour beside a path of which the distance is not known opens what is near it, and nothing else.
    #[test]
    fn a_contour_of_a_cutter_of_unknown_size() {
        let contour = |x: &str| {
            format!(
                "G0 X-20. Y-10.\nZ2.\nG1 Z-10. F90.\nG41 D1 X-10. Y-10.\nX0. Y0.\nY{x}\nG2 X10. Y100. I10. J0.\nG1 X20.\nG40 X20. Y120.\nG0 Z25.\nG81 X200. Y80. Z-9. R2. F90.\nG80\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program(&contour("90."), "G83 X100. Y20. Z-25. R-2. Q3. F90."),
            &expect![[r#"
                16 | G83 X100. Y20. Z-25. R-2. Q3. F90.
                   |                      ^^^^ warning[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program(&contour("90."), "G83 X30. Y20. Z-25. R-2. Q3. F90."),
            &expect![[""]],
        );
    }

    #[test]
    fn a_spot_does_not_open_the_hole() {
        let spot = |r: &str, z: &str| format!("G81 X0. Y0. Z{z} R{r} F90.\nX40.\nG80\n");
        check_rule(
            &RULE,
            "haas-mill",
            &program(&spot("2.", "-3.5"), DRILLED),
            &expect![[r#"
            7 | G83 X0. Y0. Z-25. R-2. Q3. F90.
              |                   ^^^^ warning[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
        // A pilot hole does.
        check_rule(&RULE, "haas-mill", &program(&spot("2.", "-9."), DRILLED), &expect![""]);
        // The spot was made on a floor that lies deeper.
        check_rule(
            &RULE,
            "haas-mill",
            &program(&spot("-1.5", "-3.5"), DRILLED),
            &expect![[r#"
            4 | G81 X0. Y0. Z-3.5 R-1.5 F90.
              |                   ^^^^^ info[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
    }

    #[test]
    fn a_faced_surface_is_solid() {
        let face = |z: &str| format!("G1 Z{z} F90.\nX60.\nX0.\nG0 Z25.\n");
        check_rule(
            &RULE,
            "haas-mill",
            &program(&face("0"), DRILLED),
            &expect![[r#"
            8 | G83 X0. Y0. Z-25. R-2. Q3. F90.
              |                   ^^^^ warning[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program(&face("-4."), DRILLED), &expect![[""]]);
    }

    #[test]
    fn alone_it_is_information() {
        check_rule(
            &RULE,
            "haas-mill",
            &program("", DRILLED),
            &expect![[r#"
            4 | G83 X0. Y0. Z-25. R-2. Q3. F90.
              |                   ^^^^ info[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
    }

    #[test]
    fn a_hole_on_a_lower_step() {
        let upper = "G81 X200. Y80. Z-9. R1. F90.\nG80\n";
        check_rule(&RULE, "haas-mill", &program(upper, DRILLED), &expect![[""]]);
    }

    #[test]
    fn another_tool_begins_above_the_zero_at_the_same_place() {
        let tap = |x: &str| format!("G80\nT2 M6\nG54 G0 X{x} Y0. S400 M3\nG43 H2 Z25.\nG84 Z-20. R5. F500.");
        check_rule(
            &RULE,
            "haas-mill",
            &program("", &format!("{DRILLED}\n{}", tap("0."))),
            &expect![[r#"
            4 | G83 X0. Y0. Z-25. R-2. Q3. F90.
              |                   ^^^^ warning[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
        // At another place: the first hole may be on a lower step.
        check_rule(&RULE, "haas-mill", &program("", &format!("{DRILLED}\n{}", tap("90."))), &expect![[""]]);
    }

    #[test]
    fn counted_from_the_level_before_the_cycle() {
        let other = "G81 X200. Y80. Z-9. R3. F90.\nG80\n";
        check_rule(
            &RULE,
            "haas-mill",
            &program(other, &DRILLED.replace("R-2.", "R-22.")),
            &expect![[r#"
            6 | G83 X0. Y0. Z-25. R-22. Q3. F90.
              |                   ^^^^^ warning[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program(other, &DRILLED.replace("R-2.", "R-21.")), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &program("", &DRILLED.replace("R-2.", "R-23.")),
            &expect![[r#"
            4 | G83 X0. Y0. Z-25. R-23. Q3. F90.
              |                   ^^^^^ warning[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
    }

    #[test]
    fn moves_that_end_close_above_the_zero_show_the_surface() {
        check_rule(
            &RULE,
            "haas-mill",
            &program("G0 Z2.\n", DRILLED),
            &expect![[r#"
            5 | G83 X0. Y0. Z-25. R-2. Q3. F90.
              |                   ^^^^ warning[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program("G0 Z9.\n", DRILLED),
            &expect![[r#"
            5 | G83 X0. Y0. Z-25. R-2. Q3. F90.
              |                   ^^^^ info[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
    }

    #[test]
    fn a_tap_is_wider_than_the_hole_for_it() {
        let tapped = |between: &str, r: &str| {
            format!(
                "T1 M6\nG21 G90 G54 G0 X0. Y0. S900 M3\nG43 H1 Z25.\nG83 Z-25. R2. Q3. F90.\nG80\n{between}T3 M6\nG54 G0 X0. Y0. S400 M3\nG43 H3 Z25.\nG84 Z-18. R{r} F400.\nG80\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &tapped("", "-5."),
            &expect![[r#"
            9 | G84 Z-18. R-5. F400.
              |           ^^^^ warning[cycle-r-in-material] the cycle goes at rapid to below the surface of the part (`R`)
        "#]],
        );
        check_rule(&RULE, "haas-mill", &tapped("", "5."), &expect![[""]]);
        // A counterbore before, drilled or milled.
        let bore = "T2 M6\nG54 G0 X0. Y0. S400 M3\nG43 H2 Z25.\n";
        check_rule(
            &RULE,
            "haas-mill",
            &tapped(&format!("{bore}G82 Z-7. R2. P.5 F50.\nG80\n"), "-5."),
            &expect![[""]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &tapped(&format!("{bore}G1 Z-7. F50.\nX1.\nG0 Z5.\n"), "-5."),
            &expect![[""]],
        );
    }

    #[test]
    fn a_zero_high_above_the_part_is_not_the_surface() {
        let high = program("", &DRILLED.replace("R-2.", "R-98.").replace("Z-25.", "Z-125."))
            .replace("H1 Z25.", "H1 Z-50.");
        check_rule(&RULE, "haas-mill", &high, &expect![[""]]);
    }

    /// Two pockets of 10 mm, 80 mm apart from middle to middle, milled with a cutter; then a hole in each.
    fn pockets(before: &str, between: &str, cycle: &str) -> String {
        let pocket = |x: u32| {
            format!("G0 X{x}. Y0.\nZ2.\nG1 Z-4. F90.\nX{}. F200.\nY8.\nX{x}.\nY0.\nG0 Z25.\n", x + 8)
        };
        format!(
            "T1 M6\nG21 G90 G54 G0 X0. Y0. S900 M3\nG43 H1 Z25.\n{before}{}{}{between}T2 M6\nG54 G0 X4. Y4. S900 M3\nG43 H2 Z25.\n{cycle}\nX84.\nG80\nM30\n",
            pocket(0),
            pocket(80)
        )
    }

    /// The drill is narrower than the cutter that has milled the pocket.
    #[test]
    fn a_pocket_of_a_wider_cutter() {
        let text = pockets("", "", "G98 G81 X4. Y4. Z-12. R-3. F90.").replace("T2 M6", "T2 M6 (3 MM DRILL)");
        check_rule(&RULE, "haas-mill", &text, &expect![[""]]);
    }

    #[test]
    fn from_pocket_to_pocket() {
        let face = "G0 X-20. Y4.\nZ2.\nG1 Z0. F90.\nX120. F300.\nG0 Z25.\n";
        check_rule(
            &RULE,
            "haas-mill",
            &pockets(face, "", "G99 G81 X4. Y4. Z-12. R-3. F90."),
            &expect![[r#"
                29 | X84.
                   | ^^^^ warning[cycle-r-in-material] the cycle goes at rapid from hole to hole through the part
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &pockets("", "", "G99 G81 X4. Y4. Z-12. R-3. F90."),
            &expect![[r#"
                24 | X84.
                   | ^^^^ info[cycle-r-in-material] the cycle goes at rapid from hole to hole through the part
            "#]],
        );
        let slot = "G0 X0. Y4.\nZ2.\nG1 Z-4. F90.\nX80. F200.\nG0 Z25.\n";
        for (between, cycle) in [
            ("", "G98 G81 X4. Y4. Z-12. R-3. F90."),
            ("", "G99 G81 X4. Y4. Z-12. R2. F90."),
            (slot, "G99 G81 X4. Y4. Z-12. R-3. F90."),
            ("", "G99 G81 X4. Y4. Z-12. R-3. F90.\nX8.\nG98 X4. Y4.\nG99"),
        ] {
            check_rule(&RULE, "haas-mill", &pockets(face, between, cycle), &expect![[""]]);
        }
        // On a floor that was there before, the tools do not come down to the zero.
        let low = pockets("", "", "G99 G81 X4. Y4. Z-12. R-3. F90.").replace("Z2.", "Z-2.");
        check_rule(&RULE, "haas-mill", &low, &expect![[""]]);
    }

    #[test]
    fn what_was_cut_before_is_not_known() {
        let other = "G81 X200. Y80. Z-9. R2. F90.\nG80\n";
        let program = program(&format!("{other}G1 X#500 Z-9. F90.\nG0 Z25.\n"), DRILLED);
        check_rule(&RULE, "haas-mill", &program, &expect![[""]]);
    }
}
