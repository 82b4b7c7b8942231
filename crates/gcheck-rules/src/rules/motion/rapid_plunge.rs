//! A rapid move down into the part.

use std::ops::Range;

use gcheck_engine::{At, Axis, Event, Fact, Position, Role, Travel, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::compensation::is_on;
use crate::facts::cuts::{Clear, Cuts, distance, may_hide_cuts, point};
use crate::{Finding, FollowedCx, MakeShared, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A rapid move takes the tool from above the zero of the part to below it, at a place where no earlier move has
    /// cut so deep, and the next move feeds straight on down.
    ///
    /// A tool that goes down beside the part to cut a contour feeds sideways next. That is reported only
    ///
    /// * if an earlier cut, less deep, passes over the place,
    /// * if the same tool was fed straight down at this place, to less depth; the tool may still be in that cut (*info* if it
    ///   cut around something from there: the place may be beside the part),
    /// * if the same tool was fed down to this depth before, cuts a closed outline from there with nothing in it, and this is
    ///   the program's one rapid move of its kind, or
    /// * as *info*, if it is the program's one rapid move of its kind and the tool is fed down three or more times.
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
    /// The tool has faced the part there.
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X-1. Y0.
    /// G43 H1 Z1.
    /// G1 Z0. F20.
    /// X3.
    /// G0 Z.1
    /// X1.
    /// Z-.5
    /// G1 Y2. F5.
    /// G0 Z1.
    /// M30
    /// ```
    /// The second level begins at rapid, from the floor of the first.
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X1. Y1.
    /// G43 H1 Z.1
    /// G1 Z-.2 F10.
    /// X3. F30.
    /// X1.
    /// G0 Z-.4
    /// G1 X3.
    /// G0 Z1.
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
            watch: Watch::MOVES.union(Watch::FOLLOWED),
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
    /// Levels that tools were fed down to, straight from above the part, each with the block that put the tool in.
    levels: Vec<(Option<At>, f64)>,
    /// Where tools were fed straight down, to which level, each with the block that put the tool in.
    places: Vec<(Option<At>, Place)>,
    /// Rapid moves down from where the tool cut on sideways.
    odd: Option<Odd>,
    /// What is cut from the last of them on.
    outline: Option<Outline>,
    /// The largest radius around which the drawing was wrapped, millimetres.
    widest: f64,
}

remembers!(RapidPlunge: plunge, levels, places, odd, outline);

/// Rapid moves down after which the tool cuts on sideways.
#[derive(Clone, PartialEq)]
struct Odd {
    /// Of the first.
    finding: Finding,
    /// How many, up to two.
    count: u32,
    /// The first leads to a closed outline, at a depth to which the same tool was fed down before.
    is_closed: bool,
}

remembers!(Odd: finding);

/// A cut at one level.
#[derive(Clone, PartialEq)]
struct Outline {
    start: [f64; 2],
    z: f64,
    low: [f64; 2],
    high: [f64; 2],
    /// How many cuts came before.
    before: usize,
    /// Ends where it began.
    is_closed: bool,
}

remembers!(Outline);

/// A rapid move down.
#[derive(Clone, PartialEq)]
struct Plunge {
    bytes: Range<u32>,
    to: [f64; 3],
    clear: Clear,
    /// What shows that the place is solid.
    solid: Option<Solid>,
}

remembers!(Plunge: bytes);

/// Where a tool was fed straight down, and what it cut from there: millimetres.
#[derive(Clone, Copy, PartialEq)]
struct Place {
    at: [f64; 3],
    low: [f64; 2],
    high: [f64; 2],
    /// An arc among the cuts.
    turns: bool,
}

remembers!(Place);

impl Place {
    fn new(at: [f64; 3]) -> Self {
        let [x, y, _] = at;
        Self { at, low: [x, y], high: [x, y], turns: false }
    }

    fn add(&mut self, to: &Position, is_arc: bool) {
        let (x, y) = (to.raw(Axis::X), to.raw(Axis::Y));
        self.low = [self.low[0].min(x), self.low[1].min(y)];
        self.high = [self.high[0].max(x), self.high[1].max(y)];
        self.turns |= is_arc;
    }

    /// Did the cuts go around something? Then the place may be in a pocket, or beside the part.
    fn is_around(&self) -> bool {
        self.turns || (self.high[0] - self.low[0]).min(self.high[1] - self.low[1]) > WIDE
    }
}

/// What shows that a place is solid.
#[derive(Clone, Copy, PartialEq)]
enum Solid {
    /// An earlier cut passes over the place.
    PassedOver,
    /// The tool was fed straight down there.
    FedDown(Place),
}

/// Millimetres: heights that differ by less are one, and the surface is this thick.
const LEVEL: f64 = 0.01;
/// After so many moves down at feed, one rapid move down is suspicious.
const MANY: u8 = 3;
/// Levels that are kept.
const MOST_LEVELS: usize = 32;
/// Places that are kept: those of the last moves down.
const MOST_PLACES: usize = 64;
/// Places that are nearer are one, and levels that differ by less: millimetres.
const NEAR: f64 = 0.1;
/// A slot that is narrower than this is a straight one: millimetres.
const WIDE: f64 = 1.0;

impl PathRule for RapidPlunge {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Cuts::shared)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let plunge = self.plunge.take_if(|_| true);
        let Some(cuts) = cx.shared::<Cuts>().filter(|cuts| cuts.knows(cx, event)) else {
            if cx.shared::<Cuts>().is_none_or(Cuts::is_blind) {
                cx.enough();
            }
            return;
        };
        if let Event::Travel(travel) = event
            && travel.expanded
            && plunge.is_none()
            && self.outline.is_none()
            && cx.state().cylinder().is_none()
        {
            // Strokes of cycles show nothing of how the program goes down.
            cx.rest();
            return;
        }
        self.follow(cx, cuts, event);
        self.keep_place(cx, event);
        if let Event::Travel(travel) = event {
            if is_fed_down(travel) {
                self.fed = (self.fed + 1).min(MANY);
                self.keep_level(cx, travel);
            }
            match plunge {
                Some(plunge) if feeds_on_down(travel, plunge.to) => report.add(tell(
                    cx,
                    &plunge,
                    "rapid move down into the part",
                    "the tool feeds on down from there",
                )),
                Some(plunge) if travel.kind == TravelKind::Feed => {
                    self.note(cx, cuts, &plunge, &travel.to, report);
                }
                _ => {}
            }
            let surface = self.surface(cx);
            self.plunge = self.look(cx, cuts, travel, surface);
        } else if let (Some(plunge), Event::Arc(arc)) = (plunge, event) {
            self.note(cx, cuts, &plunge, &arc.to, report);
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        let Some(odd) = self.odd.take().filter(|odd| odd.count == 1) else { return };
        if odd.is_closed {
            report.add(odd.finding.note("the tool is fed down to this depth before, and at rapid only here"));
        } else if self.fed >= MANY {
            let finding = odd.finding.note("everywhere else the program feeds the tool down");
            report.add(finding.at_most(Severity::Info));
        }
    }
}

impl RapidPlunge {
    /// Where the part begins, in Z: at its zero, or where a step of a shaft lies below the widest one.
    fn surface(&mut self, cx: &PathCx<'_>) -> f64 {
        let Some(cylinder) = cx.state().cylinder() else { return 0.0 };
        let radius = cylinder.diameter / 2.0;
        if radius.is_finite() {
            self.widest = self.widest.max(radius);
            radius - self.widest
        } else {
            f64::NEG_INFINITY
        }
    }

    /// Keeps a rapid move down after which the tool cuts on sideways.
    fn note(
        &mut self,
        cx: &PathCx<'_>,
        cuts: &Cuts,
        plunge: &Plunge,
        to: &Position,
        report: &mut Report<'_>,
    ) {
        let Some([x1, y1, z1]) = point(to) else { return };
        let [x, y, z] = plunge.to;
        if (z1 - z).abs() >= LEVEL {
            return;
        }
        if let Some(solid) = plunge.solid {
            let finding = tell(cx, plunge, "rapid move down into the part", "the tool cuts on from there");
            report.add(match solid {
                Solid::PassedOver => finding.note("an earlier cut passes over this place, and is less deep"),
                Solid::FedDown(place) => {
                    let depth = cx.shown(Mm(-place.at[2]));
                    let most = if place.is_around() { Severity::Info } else { Severity::Warning };
                    let note =
                        format!("the same tool was fed down at this place before, and only to {depth}");
                    finding.note(note).at_most(most)
                }
            });
            return;
        }
        match &mut self.odd {
            // A loop repeats it.
            Some(odd) if odd.finding.range == plunge.bytes => {}
            Some(odd) => odd.count = 2,
            None => {
                let finding =
                    tell(cx, plunge, "the one rapid move down to a cut", "the tool cuts on from there");
                self.odd = Some(Odd { finding, count: 1, is_closed: false });
                let tool = cx.definitions().set_by(Fact::Tool);
                let is_level = |(own, level): &(Option<At>, f64)| *own == tool && (level - z).abs() < LEVEL;
                if self.levels.iter().any(is_level) {
                    let (low, high) = ([x.min(x1), y.min(y1)], [x.max(x1), y.max(y1)]);
                    let before = cuts.len();
                    self.outline = Some(Outline { start: [x, y], z, low, high, before, is_closed: false });
                }
            }
        }
    }

    /// Keeps a level that the tool is fed down to.
    fn keep_level(&mut self, cx: &PathCx<'_>, travel: &Travel) {
        let level = (cx.definitions().set_by(Fact::Tool), travel.to.raw(Axis::Z));
        if self.levels.len() < MOST_LEVELS && !self.levels.contains(&level) {
            self.levels.push(level);
        }
    }

    /// Keeps where the tool is fed straight down, and what it cuts from there.
    fn keep_place(&mut self, cx: &PathCx<'_>, event: &Event) {
        let (to, is_arc) = match event {
            Event::Travel(travel) if travel.kind == TravelKind::Feed && !travel.expanded => {
                (&travel.to, false)
            }
            Event::Arc(arc) if !arc.expanded => (&arc.to, true),
            _ => return,
        };
        let down = match event {
            Event::Travel(travel) => straight_down(travel).filter(|[.., z]| *z < -LEVEL),
            _ => None,
        };
        if let Some(at) = down {
            if self.places.len() >= MOST_PLACES {
                self.places.remove(0);
            }
            self.places.push((cx.definitions().set_by(Fact::Tool), Place::new(at)));
        } else if let Some((_, place)) = self.places.last_mut() {
            place.add(to, is_arc);
        }
    }

    /// A rapid move to a depth that nothing has reached at that place: from above the part, or from a cut of this tool.
    fn look(&self, cx: &PathCx<'_>, cuts: &Cuts, travel: &Travel, surface: f64) -> Option<Plunge> {
        if travel.kind != TravelKind::Rapid || travel.expanded {
            return None;
        }
        let to = point(&travel.to)?;
        let above = travel.from.get(Axis::Z)? >= 0.0;
        let [x, y, z] = to;
        if z >= surface - LEVEL || !above && straight_down(travel).is_none() {
            return None;
        }
        let clear = Clear::among(cx, cuts);
        if may_hide_cuts(cx) || cuts.reach(cuts.len(), [x, y], z, clear.radius) {
            return None;
        }
        let solid = self.solid(cx, cuts, to);
        (above || solid.is_some()).then(|| Plunge { bytes: cx.range(), to, clear, solid })
    }

    /// What shows that there is material at a point.
    fn solid(&self, cx: &PathCx<'_>, cuts: &Cuts, [x, y, z]: [f64; 3]) -> Option<Solid> {
        if cuts.passes_over([x, y], z) {
            return Some(Solid::PassedOver);
        }
        let tool = cx.definitions().set_by(Fact::Tool);
        let is_here = |(own, place): &&(Option<At>, Place)| {
            let [x1, y1, z1] = place.at;
            *own == tool && distance([x1, y1], [x, y]) < NEAR && z1 > z + NEAR
        };
        self.places.iter().rfind(is_here).map(|(_, place)| Solid::FedDown(*place))
    }

    /// Follows the cut after the first rapid move down.
    fn follow(&mut self, cx: &PathCx<'_>, cuts: &Cuts, event: &Event) {
        let Some(mut outline) = self.outline.take_if(|_| true) else { return };
        let is_plain = cx.state().effect(Role::Compensation, cx.model).is_none_or(|effect| !is_on(effect));
        let to = match event {
            Event::Travel(travel) if travel.kind == TravelKind::Feed => point(&travel.to),
            Event::Arc(arc) => point(&arc.to),
            _ => None,
        };
        if let Some([x, y, _]) = to.filter(|[.., z]| is_plain && (z - outline.z).abs() < LEVEL) {
            outline.low = [outline.low[0].min(x), outline.low[1].min(y)];
            outline.high = [outline.high[0].max(x), outline.high[1].max(y)];
            outline.is_closed = distance([x, y], outline.start) < LEVEL;
            self.outline = Some(outline);
        } else if is_plain
            && outline.is_closed
            && !cuts.lies_within(outline.before, outline.low, outline.high)
            && let Some(odd) = &mut self.odd
        {
            odd.is_closed = true;
        }
    }
}

fn feeds_on_down(travel: &Travel, [x, y, z]: [f64; 3]) -> bool {
    let Some([x1, y1, z1]) = point(&travel.to) else { return false };
    travel.kind == TravelKind::Feed && (x1 - x).hypot(y1 - y) < LEVEL && z1 < z - LEVEL
}

/// Where a move straight down ends; `None` for another one.
fn straight_down(travel: &Travel) -> Option<[f64; 3]> {
    let ([x0, y0, z0], [x1, y1, z1]) = (point(&travel.from)?, point(&travel.to)?);
    (z1 < z0 - LEVEL && (x1 - x0).hypot(y1 - y0) < LEVEL).then_some([x1, y1, z1])
}

/// Straight down at feed, from above the part to below its zero?
fn is_fed_down(travel: &Travel) -> bool {
    let (Some([x0, y0, z0]), Some([x1, y1, z1])) = (point(&travel.from), point(&travel.to)) else {
        return false;
    };
    let is_plain = travel.kind == TravelKind::Feed && !travel.expanded;
    is_plain && z0 >= 0.0 && z1 < -LEVEL && (x1 - x0).hypot(y1 - y0) < LEVEL
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
    fn a_second_pocket_that_is_not_fed() {
        let program = |first: &str, by: &str, back: &str| {
            format!(
                "G20 G90 G54 G0 X0. Y0.\nG43 H2 Z.25\nZ.1\n{first}X1. F30.\nY.5\nX0.\nY0.\nG0 Z.1\nX2. Y1.\n{by} Z-.1\nG1 X3. F30.\nY1.5\nX2.\n{back}G0 Z.25\nM30\n"
            )
        };
        let fed = "G1 Z-.1 F10.\n";
        check_rule(
            &RULE,
            "haas-mill",
            &program(fed, "G0", "Y1.\n"),
            &expect![[r#"
            11 | G0 Z-.1
               | ^^^^^^^ warning[rapid-plunge] the one rapid move down to a cut
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program(fed, "G1", "Y1.\n"), &expect![[""]]);
        // A side of a part, and a depth that the tool was never fed down to.
        check_rule(&RULE, "haas-mill", &program(fed, "G0", ""), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("G1 Z-.05 F10.\n", "G0", "Y1.\n"), &expect![[""]]);
        // Around what was cut before.
        let around = program(fed, "G0", "Y1.\n")
            .replace("X2. Y1.", "X-1. Y-1.")
            .replace("X3. F", "X4. F")
            .replace("Y1.5\nX2.\nY1.", "Y2.\nX-1.\nY-1.");
        check_rule(&RULE, "haas-mill", &around, &expect![[""]]);
    }

    #[test]
    fn an_earlier_cut_passes_over_the_place() {
        let program = |x: &str| {
            format!(
                "G21 G90 G54 G0 X-20. Y0.\nG43 H1 Z5.\nG1 Z0 F90.\nX80.\nG0 Z5.\nX{x} Y0.\nZ-9.\nG1 Y50.\nG0 Z5.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("30."),
            &expect![[r#"
            7 | Z-9.
              | ^^^^ warning[rapid-plunge] rapid move down into the part
        "#]],
        );
        // Where the first pass began, too: the tool is beside the part.
        check_rule(&RULE, "fanuc-mill", &program("-20."), &expect![[""]]);
    }

    #[test]
    fn the_next_level_begins_at_rapid() {
        let program = |before: &str, down: &str| {
            format!(
                "G20 G90 G54 G0 X1. Y1.\nG43 H1 Z.1\n{before}G1 Z-.2 F10.\nX3. F30.\nX1.\n{down}\nG1 X3.\nG0 Z1.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program("", "G0 Z-.4"),
            &expect![[r#"
            6 | G0 Z-.4
              | ^^^^^^^ warning[rapid-plunge] rapid move down into the part
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program("", "G0 Z.1\nG0 Z-.4"),
            &expect![[r#"
            7 | G0 Z-.4
              | ^^^^^^^ warning[rapid-plunge] rapid move down into the part
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program("", "G1 Z-.4"), &expect![[""]]);
        // The place is open already, or the tool is beside the part.
        check_rule(&RULE, "haas-mill", &program("G1 Z-.4 F5.\nG0 Z.1\n", "G0 Z-.4"), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("", "G0 X4.\nZ-.4"), &expect![[""]]);
        // Around a part, or in a pocket.
        let around = program("", "Y3.\nX-1.\nY1.\nX1.\nG0 Z-.4");
        check_rule(
            &RULE,
            "haas-mill",
            &around,
            &expect![[r#"
            10 | G0 Z-.4
               | ^^^^^^^ info[rapid-plunge] rapid move down into the part
        "#]],
        );
        // Another tool.
        check_rule(
            &RULE,
            "haas-mill",
            &program("", "G0 Z1.\nT2 M6\nG0 X1. Y1.\nG43 H2 Z.1\nG0 Z-.4"),
            &expect![[""]],
        );
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
    fn a_pocket_that_the_control_clears_hides_its_cuts() {
        let program = |pocket: &str| {
            format!("G20 G90 G54 G0 X1. Y1. Z1.\n{pocket}G0 Z.1\nG0 Z-.1\nG1 Z-1. F10.\nG0 Z1.\nM30\n")
        };
        check_rule(&RULE, "haas-mill", &program("G13 Z-.5 I.3 K1. Q.2 D1 F20.\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &program(""),
            &expect![[r#"
            3 | G0 Z-.1
              | ^^^^^^^ warning[rapid-plunge] rapid move down into the part
        "#]],
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
