//! A rapid move at cutting depth where nothing is cut yet.

use std::ops::Range;

use gcheck_engine::{ArcMove, Axis, Event, Travel, TravelKind};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::facts::cuts::{Clear, Cuts, LEVEL, SURFACE, distance, point};
use crate::{MakeShared, PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A rapid move in X and Y runs below the zero of the part, through a place that no earlier move has cut so deep,
    /// and that a later move cuts at the same depth.
    ///
    /// The later cut shows that there is material at the time of the rapid move. Without a later cut there is no
    /// finding: the tool may be beside the part.
    ///
    /// ## Why it matters
    /// The tool is dragged through the part at rapid and breaks. A retract is missing, or `G0` was written instead of
    /// `G1`.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0 Y0
    /// G43 H1 Z5.
    /// G1 Z-2. F100.
    /// X10.
    /// G0 X80. Y60.
    /// G1 X40. Y60.
    /// Y-10.
    /// G0 Z5.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X0 Y0
    /// G43 H1 Z5.
    /// G1 Z-2. F100.
    /// X10.
    /// G0 Z5.
    /// G0 X80. Y60.
    /// G1 Z-2.
    /// G1 X40. Y60.
    /// Y-10.
    /// G0 Z5.
    /// M30
    /// ```
    rule "rapid-in-material" in "motion" {
        summary: "rapid move at cutting depth where nothing is cut yet",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(RapidInMaterial::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidInMaterial {
    waiting: Vec<Rapid>,
    /// The highest level of a rapid move so far: a program that never lifts the tool has no clearance to compare with.
    highest: Option<f64>,
}

remembers!(RapidInMaterial: waiting);

/// A rapid move at depth.
#[derive(Clone, PartialEq)]
struct Rapid {
    from: [f64; 2],
    to: [f64; 2],
    z: f64,
    /// How many cuts came before.
    before: usize,
    bytes: Range<u32>,
    clear: Clear,
}

remembers!(Rapid: bytes);

/// Rapid moves that wait for a cut across them; a program with more of them clears its way in another manner.
const MOST_WAITING: usize = 32;
/// Shorter ways say nothing: millimetres.
const SHORT: f64 = 1.0;
/// Chords that an arc is looked at as: with 24, a circle of 100 mm is off by less than 0.5 mm.
const CHORDS: u8 = 24;
/// A level counts as depth if it is lower than the highest rapid move by more than this: millimetres.
const LIFT: f64 = 0.5;

impl PathRule for RapidInMaterial {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Cuts::shared)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(cuts) = cx.shared::<Cuts>() else { return };
        // Nearly all moves are cuts after which nothing waits.
        let is_rapid = matches!(event, Event::Travel(travel) if travel.kind == TravelKind::Rapid);
        if !is_rapid && self.waiting.is_empty() && !cuts.is_blind() {
            cx.rest();
            return;
        }
        if !cuts.knows(cx, event) {
            self.waiting.clear();
            if cuts.is_blind() {
                cx.enough();
            }
            return;
        }
        match event {
            Event::Travel(travel) if travel.kind == TravelKind::Rapid => self.rapid(cx, cuts, travel),
            Event::Travel(travel) if travel.kind == TravelKind::Feed && !self.waiting.is_empty() => {
                if let (Some(from), Some(to)) = (point(&travel.from), point(&travel.to)) {
                    let ends = [[from[0], from[1]], [to[0], to[1]]];
                    self.tell(cx, cuts, [from, to], ends, report);
                }
            }
            Event::Arc(arc) if !self.waiting.is_empty() => self.tell_arc(cx, cuts, arc, report),
            _ => {}
        }
    }
}

impl RapidInMaterial {
    fn rapid(&mut self, cx: &PathCx<'_>, cuts: &Cuts, travel: &Travel) {
        let is_below = |z: f64| self.highest.is_some_and(|highest| z < highest - LIFT) && z < SURFACE;
        let at_depth = travel.from.get(Axis::Z).is_some_and(is_below);
        if let Some(z) = travel.to.get(Axis::Z) {
            self.highest = Some(self.highest.map_or(z, |highest| highest.max(z)));
        }
        if !at_depth || travel.expanded {
            return;
        }
        let (Some(from), Some(to)) = (point(&travel.from), point(&travel.to)) else { return };
        let (low, high) = (from[2].min(to[2]), from[2].max(to[2]));
        let ([x0, y0, _], [x1, y1, _]) = (from, to);
        let is_level = high - low < LEVEL && (x1 - x0).hypot(y1 - y0) >= SHORT;
        if is_level && self.waiting.len() < MOST_WAITING {
            self.waiting.push(Rapid {
                from: [x0, y0],
                to: [x1, y1],
                z: high,
                before: cuts.len(),
                bytes: cx.range(),
                clear: Clear::among(cx, cuts),
            });
        }
    }

    /// The same as [`Self::tell`] for an arc in the XY plane, as chords.
    fn tell_arc(&mut self, cx: &PathCx<'_>, cuts: &Cuts, arc: &ArcMove, report: &mut Report<'_>) {
        let (Some([x0, y0, z0]), Some([x1, y1, z1])) = (point(&arc.from), point(&arc.to)) else { return };
        let [centre_x, centre_y] = [arc.centre.0.0, arc.centre.1.0];
        let is_flat = arc.plane == Plane::Xy && (z0 - z1).abs() <= LEVEL;
        if !is_flat || ![centre_x, centre_y, arc.sweep].into_iter().all(f64::is_finite) {
            return;
        }
        // More than a turn cuts the same circle again.
        let sweep = arc.sweep.clamp(-std::f64::consts::TAU, std::f64::consts::TAU);
        let (radius, start) = ((x0 - centre_x).hypot(y0 - centre_y), (y0 - centre_y).atan2(x0 - centre_x));
        // A whole circle is cut where the tool went in: it has no end in the air.
        let is_closed = distance([x0, y0], [x1, y1]) < radius / 100.0;
        let ends = if is_closed { [[f64::INFINITY; 2]; 2] } else { [[x0, y0], [x1, y1]] };
        let mut from = [x0, y0, z0];
        for chord in 1..=CHORDS {
            let angle = start + sweep * f64::from(chord) / f64::from(CHORDS);
            let end = [centre_x + radius * angle.cos(), centre_y + radius * angle.sin()];
            let to = if chord == CHORDS { [x1, y1, z1] } else { [end[0], end[1], z0] };
            self.tell(cx, cuts, [from, to], ends, report);
            from = to;
        }
    }

    /// Does this cut, or this chord of one with these ends, cross a rapid move that waits, where nothing was cut before it?
    fn tell(
        &mut self,
        cx: &PathCx<'_>,
        cuts: &Cuts,
        [[x0, y0, z0], [x1, y1, z1]]: [[f64; 3]; 2],
        ends: [[f64; 2]; 2],
        report: &mut Report<'_>,
    ) {
        if (z0 - z1).abs() > LEVEL {
            return;
        }
        self.waiting.retain(|rapid| {
            if (rapid.z - z0).abs() > LEVEL {
                return true;
            }
            let Some(at) = crossing((rapid.from, rapid.to), ([x0, y0], [x1, y1])) else { return true };
            // Near its ends the cut may be beside the part: it begins or ends with the tool in the air.
            let is_inner = ends.into_iter().all(|end| distance(at, end) >= rapid.clear.radius);
            let inside = is_inner && distance(at, rapid.from) >= SHORT && distance(at, rapid.to) >= SHORT;
            if !inside || cuts.reach(rapid.before, at, rapid.z, rapid.clear.radius) {
                return true;
            }
            let depth = cx.shown(Mm(-rapid.z));
            let mut finding = cx
                .finding(&META, rapid.bytes.clone(), "rapid move at cutting depth where nothing is cut yet")
                .label(format!(
                    "{depth} below the zero of the part, deeper than anything that was cut there before"
                ))
                .also(cx.range(), "a later cut at this depth crosses the way, so there is material")
                .help("retract the tool before the move, or make the move at feed (`G1`)");
            if let Some(assumption) = &rapid.clear.assumption {
                finding = finding.assuming(assumption.clone());
            }
            report.add(finding);
            false
        });
    }
}

/// Where two straight ways cross, ends included; `None` for parallel ones.
fn crossing(a: ([f64; 2], [f64; 2]), b: ([f64; 2], [f64; 2])) -> Option<[f64; 2]> {
    let (a0, a1) = a;
    let (b0, b1) = b;
    let (ax, ay) = (a1[0] - a0[0], a1[1] - a0[1]);
    let (bx, by) = (b1[0] - b0[0], b1[1] - b0[1]);
    let cross = ax * by - ay * bx;
    if cross.abs() <= 1e-9 * ax.hypot(ay) * bx.hypot(by) {
        return None;
    }
    let (wx, wy) = (b0[0] - a0[0], b0[1] - a0[1]);
    let along_a = (wx * by - wy * bx) / cross;
    let along_b = (wx * ay - wy * ax) / cross;
    let within = 0.0..=1.0;
    (within.contains(&along_a) && within.contains(&along_b))
        .then(|| [a0[0] + along_a * ax, a0[1] + along_a * ay])
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_engine::{Position, Tool};
    use gcheck_geometry::Mm;

    use super::RULE;
    use crate::MachineFacts;
    use crate::testing::{World, check_rule, check_rule_in};

    /// A slot, a rapid move at depth, and a cut across the way of that move.
    const SLOT: &str = "G21 G90 G54 G0 X0 Y0\nG43 H1 Z5.\nG1 Z-2. F100.\nX10.\nG0 X80.\nY40.\nG1 X45.\nG1 Y-40.\nG0 Z5.\nM30\n";

    #[test]
    fn the_rapid_move_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            SLOT,
            &expect![[r#"
            5 | G0 X80.
              | ^^^^^^^ warning[rapid-in-material] rapid move at cutting depth where nothing is cut yet
        "#]],
        );
    }

    #[test]
    fn an_arc_that_cuts_there_later_counts_too() {
        let bores = |lift: &str| {
            format!(
                "G20 G90 G54 G0 X.2 Y0.\nG43 H1 Z1.\nG1 Z-.5 F20.\nG3 I-.2\nG1 X0.\n{lift}G0 X3.2\nZ.1\nG1 Z-.5\nG3 I-.2\nG1 X3.\nG0 Z1.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &bores(""),
            &expect![[r#"
            6 | G0 X3.2
              | ^^^^^^^ warning[rapid-in-material] rapid move at cutting depth where nothing is cut yet
        "#]],
        );
        check_rule(&RULE, "haas-mill", &bores("G0 Z.1\n"), &expect![[""]]);
    }

    #[test]
    fn a_cut_that_begins_there_begins_in_the_air() {
        // The tool comes back along the side of the part, and enters beside it.
        let program = SLOT.replace("X45.\nG1 Y-40.", "X45.\nY4.\nG1 Y-40.");
        check_rule(&RULE, "haas-mill", &program.replace("Y4.\n", "Y-4.\n"), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &SLOT.replace("G1 Y-40.", "G1 Y-2."), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &program.replace("Y4.\n", ""),
            &expect![[r#"
            5 | G0 X80.
              | ^^^^^^^ warning[rapid-in-material] rapid move at cutting depth where nothing is cut yet
        "#]],
        );
    }

    #[test]
    fn lifted_above_the_part_it_is_fine() {
        check_rule(&RULE, "haas-mill", &SLOT.replace("G0 X80.", "G0 Z1.\nG0 X80.\nG0 Z-2."), &expect![[""]]);
    }

    #[test]
    fn beside_the_part_it_is_fine() {
        check_rule(&RULE, "haas-mill", &SLOT.replace("G1 Y-40.\n", ""), &expect![[""]]);
    }

    #[test]
    fn where_it_was_cut_before_it_is_fine() {
        let program = SLOT.replace("X10.\nG0 X80.", "X80.\nX10.\nG0 X80.");
        check_rule(&RULE, "haas-mill", &program, &expect![[""]]);
    }

    #[test]
    fn a_wide_cutter_has_cleared_its_way() {
        let program = SLOT.replace("G21", "T1 M6\nG21").replace("X10.", "X60.\nY-20.\nX0.\nY20.");
        let with = |diameter: f64| {
            let mut machine = MachineFacts::default();
            let tool = Tool {
                pocket: 1,
                offset: Position::ZERO,
                diameter: Mm(diameter),
                corner_radius: Mm::UNKNOWN,
                angles: [0.0; 2],
                orientation: 0,
            };
            machine.engine.tools.insert(1, tool);
            World { machine, ..World::default() }
        };
        check_rule_in(
            &RULE,
            "haas-mill",
            &program,
            &with(6.0),
            &expect![[r#"
            9 | G0 X80.
              | ^^^^^^^ warning[rapid-in-material] rapid move at cutting depth where nothing is cut yet
        "#]],
        );
        check_rule_in(&RULE, "haas-mill", &program, &with(50.0), &expect![[""]]);
    }

    #[test]
    fn what_lies_in_doubt_is_not_judged() {
        check_rule(&RULE, "haas-mill", &SLOT.replace("X10.", "X#100"), &expect![[""]]);
    }
}
