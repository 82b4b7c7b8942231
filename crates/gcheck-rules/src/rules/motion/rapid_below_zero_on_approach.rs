//! The first move of a tool down to the part, at rapid to below its surface.

use std::ops::Range;

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Axis, Event, Fact, Role, Travel, TravelKind};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::facts::cuts::{Cuts, LEVEL, SURFACE, cutter_radius, point};
use crate::{Finding, MakeShared, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The first move of a tool along Z is a rapid move to below the zero of the part, and what follows shows that there
    /// is material: a drilling cycle whose retract level `R` is above the tool, or a feed straight on down where an
    /// earlier cut was less deep.
    ///
    /// So does a tool that goes down before it goes to its place: it is taken there sideways, at that depth.
    ///
    /// A tool that goes down beside the part to cut a contour is not reported.
    ///
    /// ## Why it matters
    /// The tool hits the part at rapid. Mostly the clearance in the block with `G43` has a minus sign too many.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T2 M6
    /// G20 G90 G54 G0 X0.75 Y0.75
    /// S1800 M3
    /// G43 H2 Z-1.
    /// G99 G83 Z-1.25 R0.1 Q0.2 F9.
    /// G80
    /// G0 G53 Z0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T2 M6
    /// G20 G90 G54 G0 X0.75 Y0.75
    /// S1800 M3
    /// G43 H2 Z1.
    /// G99 G83 Z-1.25 R0.1 Q0.2 F9.
    /// G80
    /// G0 G53 Z0.
    /// M30
    /// ```
    rule "rapid-below-zero-on-approach" in "motion" {
        summary: "first move of a tool goes at rapid to below the part's surface",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES,
            make: || Box::new(RapidBelowZeroOnApproach::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidBelowZeroOnApproach {
    /// The tool in the spindle has moved along Z.
    has_moved: bool,
    /// A block has taken it somewhere in X or Y.
    has_place: bool,
    /// The block that put it in.
    tool: Option<At>,
    /// The move before this one, if it is the first of its tool along Z and goes below the part's zero.
    approach: Option<Approach>,
}

remembers!(RapidBelowZeroOnApproach: tool, approach);

/// A rapid move to below the part's zero.
#[derive(Clone, PartialEq)]
struct Approach {
    bytes: Range<u32>,
    to: [f64; 3],
    /// Where it is in X and Y is not known: nothing has taken the tool to its place.
    is_elsewhere: bool,
    /// Is it known that the part was cut there, and not so deep?
    is_solid: bool,
}

remembers!(Approach: bytes);

impl PathRule for RapidBelowZeroOnApproach {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Cuts::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().machine() == gcheck_controls::Machine::Mill
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let approach = self.approach.take();
        let Event::Travel(travel) = event else { return };
        let tool = cx.definitions().set_by(Fact::Tool);
        // Most moves come after the first one of their tool.
        if approach.is_none() && self.has_moved && self.tool == tool {
            cx.rest();
            return;
        }
        // Of several paths, this move may follow another one.
        if !cx.is_on_every_path() || cx.is_called_only() || cx.state().plane(cx.model) != Some(Plane::Xy) {
            return;
        }
        if let Some(approach) = approach {
            tell(cx, &approach, travel, report);
        }
        self.has_moved &= self.tool == tool;
        self.has_place &= self.tool == tool;
        self.tool = tool;
        self.has_place |= cx.origin().letters.intersects(LetterSet::of("XY"));
        if self.has_moved || !goes_along_z(cx, travel) {
            return;
        }
        self.has_moved = true;
        self.approach = look(cx, event, travel, self.has_place);
    }
}

/// Does the move take the tool along Z, as far as is known?
fn goes_along_z(cx: &PathCx<'_>, travel: &Travel) -> bool {
    let names_z = cx.origin().letters.contains(Axis::Z.letter());
    names_z && travel.from.get(Axis::Z) != travel.to.get(Axis::Z)
}

fn look(cx: &PathCx<'_>, event: &Event, travel: &Travel, has_place: bool) -> Option<Approach> {
    let place = point(&travel.to);
    let to = place.or_else(|| Some([0.0, 0.0, travel.to.get(Axis::Z).filter(|_| !has_place)?]))?;
    let [x, y, z] = to;
    let is_rapid = travel.kind == TravelKind::Rapid && !travel.expanded;
    // A length that is off makes Z a matter of the machine.
    let has_length =
        cx.state().effect(Role::Length, cx.model).is_some_and(|effect| effect != Effect::LengthOff);
    if !is_rapid || cx.has_effect(Effect::goes_to_machine_place) || !has_length || z >= SURFACE {
        return None;
    }
    let cuts = cx.shared::<Cuts>().filter(|cuts| cuts.knows(cx, event));
    let radius = cutter_radius(cx).unwrap_or(12.7);
    let is_solid = place.is_some()
        && cuts.is_some_and(|cuts| {
            // The zero need not be the surface: only an earlier cut that is less deep shows where the part begins.
            let reaches = |z: f64| cuts.reach(cuts.len(), [x, y], z, radius);
            reaches(-SURFACE) && !reaches(z)
        });
    Some(Approach { bytes: cx.range(), to, is_elsewhere: place.is_none(), is_solid })
}

fn tell(cx: &PathCx<'_>, approach: &Approach, travel: &Travel, report: &mut Report<'_>) {
    let [x, y, z] = approach.to;
    let cycle = cx.state().active_cycle(cx.model).is_some_and(|code| code.is_some() && travel.expanded);
    if cycle && cx.state().cycle().r > z + LEVEL {
        let r = cx.shown(Mm(cx.state().cycle().r - z));
        let finding = finding(cx, approach).also(cx.range(), format!("the retract level `R` is {r} higher"));
        report.add(finding.help("end the rapid move above the retract level: check the sign of Z"));
        return;
    }
    let Some([x1, y1, z1]) = point(&travel.to) else { return };
    if approach.is_elsewhere {
        if travel.kind == TravelKind::Rapid && !travel.expanded && z1 < SURFACE {
            let finding = finding(cx, approach).also(cx.range(), "goes to its place at that depth, at rapid");
            report.add(finding.help("move in X and Y first, then down; check the sign of Z"));
        }
        return;
    }
    let feeds_on = travel.kind == TravelKind::Feed && !travel.expanded && z1 < z - LEVEL;
    if feeds_on && (x1 - x).hypot(y1 - y) < LEVEL && approach.is_solid {
        let finding = finding(cx, approach).also(cx.range(), "the tool feeds on down from there");
        report.add(
            finding
                .assuming("the part is solid where the program has not cut")
                .help("end the rapid move above the part, and feed from there"),
        );
    }
}

fn finding(cx: &PathCx<'_>, approach: &Approach) -> Finding {
    let depth = cx.shown(Mm(-approach.to[2]));
    cx.finding(&META, approach.bytes.clone(), "the first move of the tool is a rapid move into the part")
        .label(format!("{depth} below the zero of the part"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(z: &str, after: &str) -> String {
        format!("T2 M6\nG21 G90 G54 G0 X10. Y10.\nS900 M3\nG43 H2 Z{z}\n{after}\nG80 G0 Z50.\nM30\n")
    }

    #[test]
    fn a_drill_below_its_retract_level() {
        check_rule(
            &RULE,
            "haas-mill",
            &program("-25.", "G81 Z-30. R2. F90."),
            &expect![[r#"
            4 | G43 H2 Z-25.
              | ^^^^^^^^^^^^ warning[rapid-below-zero-on-approach] the first move of the tool is a rapid move into the part
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program("25.", "G81 Z-30. R2. F90."), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("-25.", "G81 Z-40. R-28. F90."), &expect![[""]]);
    }

    #[test]
    fn a_tool_that_feeds_on_down() {
        let faced = |at: &str| {
            let face = format!("G21 G90 G54 G0 X-20. Y{at}.\nG43 H1 Z5.\nG1 Z0. F90.\nX50.\nG0 Z50.\n");
            format!("T1 M6\n{face}{}", program("-2.", "G1 Z-10. F90."))
        };
        check_rule(
            &RULE,
            "haas-mill",
            &faced("10"),
            &expect![[r#"
            10 | G43 H2 Z-2.
               | ^^^^^^^^^^^ warning[rapid-below-zero-on-approach] the first move of the tool is a rapid move into the part
        "#]],
        );
        // The zero need not be the surface of the part.
        check_rule(&RULE, "haas-mill", &faced("70"), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("-2.", "G1 Z-10. F90."), &expect![[""]]);
    }

    #[test]
    fn down_before_it_goes_to_its_place() {
        let program = |z: &str, to: &str| {
            format!("G20 G90 G54\nT2 M6\nS900 M3\nG43 H2 Z{z}\n{to}\nG1 X3. F20.\nG0 Z2.\nM30\n")
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program("-.06", "G0 X-.2 Y-.2"),
            &expect![[r#"
            4 | G43 H2 Z-.06
              | ^^^^^^^^^^^^ warning[rapid-below-zero-on-approach] the first move of the tool is a rapid move into the part
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program("2.", "G0 X-.2 Y-.2"), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("-.06", "G0 Z2. X-.2 Y-.2"), &expect![[""]]);
        // Where the variables have taken it is not known.
        let taken = program("-.06", "G0 X-.2 Y-.2").replace("S900 M3", "G0 X#500 Y#501 S900 M3");
        check_rule(&RULE, "haas-mill", &taken, &expect![[""]]);
    }

    #[test]
    fn beside_the_part_it_is_fine() {
        check_rule(&RULE, "fanuc-mill", &program("-2.", "G1 X50. F90."), &expect![[""]]);
    }

    #[test]
    fn a_later_move_down_is_not_the_first() {
        check_rule(&RULE, "haas-mill", &program("5.", "G0 Z-2.\nG81 Z-30. R2. F90."), &expect![[""]]);
    }
}
