//! A rapid move through what is cut only later.

use std::ops::Range;

use gcheck_engine::{Abstract, Axis, Domain, Event, Position, Travel, TravelKind};
use gcheck_geometry::Mm;

use crate::memory::{Remembers, SharedList, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A rapid move in X and Y runs below the zero of the part, through a place that no move has cut so deep before, and that
    /// a later move cuts at the same depth.
    ///
    /// That the place is cut later shows that there is material at the time of the rapid move. Where no later cut shows it,
    /// nothing is said: the tool may be beside the part.
    ///
    /// ## Why it matters
    /// The tool is dragged through the part at rapid and breaks. A retract is missing, or a `G0` stands where `G1` was meant.
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
        summary: "rapid move through what is cut only later",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(RapidInMaterial::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidInMaterial {
    cuts: Cuts,
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

/// Rapid moves that wait for a cut across them; a program with more of them clears its way in some manner of its own.
const MOST_WAITING: usize = 32;
/// Shorter ways say nothing: millimetres.
const SHORT: f64 = 1.0;
/// Levels that differ by less are one: millimetres.
pub(super) const LEVEL: f64 = 1e-4;
/// Depths above this are the surface of the part: millimetres.
pub(super) const SURFACE: f64 = -0.01;
/// How much less high than the highest rapid move a level is to be at depth: millimetres.
const LIFT: f64 = 0.5;

impl PathRule for RapidInMaterial {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if !self.cuts.follows(cx, event) {
            self.waiting.clear();
            return;
        }
        if let Event::Travel(travel) = event {
            if travel.kind == TravelKind::Rapid {
                self.rapid(cx, travel);
            } else if !self.waiting.is_empty() {
                self.tell(cx, travel, report);
            }
        }
        self.cuts.add(event);
    }
}

impl RapidInMaterial {
    fn rapid(&mut self, cx: &PathCx<'_>, travel: &Travel) {
        let is_below = |z: f64| self.highest.is_some_and(|highest| z < highest - LIFT) && z < SURFACE;
        let at_depth = travel.from.get(Axis::Z).is_some_and(is_below);
        if let Some(z) = travel.to.get(Axis::Z) {
            self.highest = Some(self.highest.map_or(z, |highest| highest.max(z)));
        }
        let (Some(from), Some(to)) = (point(&travel.from), point(&travel.to)) else { return };
        let (low, high) = (from[2].min(to[2]), from[2].max(to[2]));
        let ([x0, y0, _], [x1, y1, _]) = (from, to);
        let is_level = high - low < LEVEL && (x1 - x0).hypot(y1 - y0) >= SHORT;
        if at_depth && is_level && !travel.expanded && self.waiting.len() < MOST_WAITING {
            self.waiting.push(Rapid {
                from: [x0, y0],
                to: [x1, y1],
                z: high,
                before: self.cuts.list.len(),
                bytes: cx.range(),
                clear: Clear::of(cx),
            });
        }
    }

    /// Does this cut cross a rapid move that waits, where nothing was cut before it?
    fn tell(&mut self, cx: &PathCx<'_>, travel: &Travel, report: &mut Report<'_>) {
        let (Some(from), Some(to)) = (point(&travel.from), point(&travel.to)) else { return };
        let ([x0, y0, z0], [x1, y1, z1]) = (from, to);
        if travel.kind != TravelKind::Feed || (z0 - z1).abs() > LEVEL {
            return;
        }
        let cuts = &self.cuts;
        self.waiting.retain(|rapid| {
            if (rapid.z - z0).abs() > LEVEL {
                return true;
            }
            let Some(at) = crossing((rapid.from, rapid.to), ([x0, y0], [x1, y1])) else { return true };
            let inside = distance(at, rapid.from) >= SHORT && distance(at, rapid.to) >= SHORT;
            if !inside || cuts.reach(rapid.before, at, rapid.z, rapid.clear.radius) {
                return true;
            }
            let depth = cx.shown(Mm(-rapid.z));
            let mut finding = cx
                .finding(&META, rapid.bytes.clone(), "rapid move through what is cut only later")
                .label(format!("{depth} below the zero of the part, where nothing was cut so deep before"))
                .also(cx.range(), "this cuts there at the same depth")
                .help("lift the tool before the move, or make the move at feed (`G1`)");
            if let Some(assumption) = &rapid.clear.assumption {
                finding = finding.assuming(assumption.clone());
            }
            report.add(finding);
            false
        });
    }
}

/// How far beside its path a cutter clears.
#[derive(Clone, PartialEq)]
pub(crate) struct Clear {
    /// Millimetres.
    pub(crate) radius: f64,
    /// What that rests on.
    pub(crate) assumption: Option<String>,
}

impl Clear {
    /// Of the tool in the spindle; an inch across when nobody knows.
    pub(crate) fn of(cx: &PathCx<'_>) -> Self {
        match cutter_radius(cx) {
            Some(radius) => Self { radius, assumption: None },
            None => {
                Self { radius: 12.7, assumption: Some("no cutter is wider than 25.4 mm (1 in)".to_owned()) }
            }
        }
    }
}

/// The radius of the tool in the spindle, as the machine file has it: millimetres.
pub(crate) fn cutter_radius(cx: &PathCx<'_>) -> Option<f64> {
    let number = Abstract::known(cx.state().tool()).filter(|n| (1.0..1e6).contains(n))?;
    #[expect(clippy::cast_sign_loss, reason = "range checked above")]
    let tool = cx.state().tables().tool(number as u32)?;
    Some(tool.diameter.0 / 2.0).filter(|radius| *radius > 0.0)
}

/// What was cut so far, as far as it is known throughout.
#[derive(Default, Clone, PartialEq)]
pub(crate) struct Cuts {
    list: SharedList<Cut>,
    /// Work offset and shift that the coordinates count from.
    frame: Option<(u16, [u64; 3])>,
    /// Where the last move ended.
    last: Option<[f64; 3]>,
    /// Something was moved that is not known, so that nothing can be said any more.
    blind: bool,
}

/// A straight cut.
#[derive(Clone, PartialEq)]
struct Cut {
    from: [f64; 2],
    to: [f64; 2],
    /// The lower end.
    z: f64,
}

/// Cuts that are kept. Programs with more of them come from a system that plans its rapid moves.
const MOST_CUTS: usize = 20_000;

impl Cuts {
    /// Is everything known that was cut up to this move? Asked before [`Cuts::add`].
    pub(crate) fn follows(&mut self, cx: &PathCx<'_>, event: &Event) -> bool {
        if self.blind {
            cx.enough();
            return false;
        }
        let from = match event {
            Event::Travel(travel) => &travel.from,
            Event::Arc(arc) => &arc.from,
            _ => &Position::UNKNOWN,
        };
        let shift = cx.state().shift();
        let frame =
            cx.state().work().map(|work| (work, [Axis::X, Axis::Y, Axis::Z].map(|a| shift.raw(a).to_bits())));
        let new_frame = self.frame.is_some() && self.frame != frame;
        let jumped = !new_frame
            // Z may count anew when a tool offset comes into effect.
            && matches!((self.last, point(from)), (Some(last), Some(from)) if is_apart(last, from));
        if frame.is_none()
            || new_frame && !self.list.is_empty()
            || jumped
            || !cx.is_mill()
            || !cx.is_on_every_path()
        {
            // Cuts of another frame, in another file, or on another path: where they were is not known here.
            self.give_up();
            return false;
        }
        self.frame = frame;
        true
    }

    /// From here on nothing is said: what was known is of no use, and would tell one edit of the program from another.
    fn give_up(&mut self) {
        *self = Self { blind: true, ..Self::default() };
    }

    /// Keeps what a move cuts.
    pub(crate) fn add(&mut self, event: &Event) {
        let (from, to, cuts) = match event {
            Event::Travel(travel) => (&travel.from, &travel.to, travel.kind != TravelKind::Rapid),
            Event::Arc(arc) => (&arc.from, &arc.to, true),
            _ => (&Position::UNKNOWN, &Position::UNKNOWN, true),
        };
        self.last = point(to);
        if !cuts {
            return;
        }
        let depth = |position: &Position| position.get(Axis::Z);
        let z = match (depth(from), depth(to)) {
            (Some(a), Some(b)) => Some(a.min(b)),
            // Down from where nobody knows.
            (None, b) => b,
            (Some(_), None) => None,
        };
        let flat = |position: &Position| Some([position.get(Axis::X)?, position.get(Axis::Y)?]);
        let (Some(a), Some(b), Some(z)) = (flat(from), flat(to), z) else {
            self.give_up();
            return;
        };
        match event {
            Event::Arc(arc) => {
                if arc.plane != gcheck_geometry::Plane::Xy || !arc.sweep.is_finite() {
                    self.blind = arc.plane == gcheck_geometry::Plane::Xy;
                    self.list.push(Cut { from: a, to: b, z });
                } else {
                    self.add_arc([arc.centre.0.0, arc.centre.1.0], a, arc.sweep, z);
                }
            }
            _ => self.list.push(Cut { from: a, to: b, z }),
        }
        if self.list.len() > MOST_CUTS {
            self.give_up();
        }
    }

    fn add_arc(&mut self, centre: [f64; 2], start: [f64; 2], sweep: f64, z: f64) {
        const PIECES: u32 = 12;
        let radius = distance(centre, start);
        let angle = (start[1] - centre[1]).atan2(start[0] - centre[0]);
        let at = |piece: u32| {
            let (sin, cos) = (angle + sweep * f64::from(piece) / f64::from(PIECES)).sin_cos();
            [centre[0] + radius * cos, centre[1] + radius * sin]
        };
        for piece in 0..PIECES {
            self.list.push(Cut { from: at(piece), to: at(piece + 1), z });
        }
    }

    /// Did one of the first `count` cuts reach within `radius` of a point, at this depth or lower?
    pub(crate) fn reach(&self, count: usize, at: [f64; 2], z: f64, radius: f64) -> bool {
        let mut cuts = self.list.iter().take(count);
        cuts.any(|cut| cut.z <= z + LEVEL && distance_to_line(at, cut.from, cut.to) <= radius)
    }

    /// Has it given up to know what was cut?
    pub(crate) fn is_blind(&self) -> bool {
        self.blind
    }

    /// How many cuts are kept.
    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }
}

/// X, Y and Z, if all are known.
pub(crate) fn point(position: &Position) -> Option<[f64; 3]> {
    Some([position.get(Axis::X)?, position.get(Axis::Y)?, position.get(Axis::Z)?])
}

/// Are two points not one in X and Y?
fn is_apart(a: [f64; 3], b: [f64; 3]) -> bool {
    let (x, y) = (a[0] - b[0], a[1] - b[1]);
    // Asked at every move, so without a root.
    x * x + y * y > 1e-12
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn distance_to_line(at: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let square = dx * dx + dy * dy;
    if square <= 0.0 {
        return distance(at, from);
    }
    let along = (((at[0] - from[0]) * dx + (at[1] - from[1]) * dy) / square).clamp(0.0, 1.0);
    distance(at, [from[0] + along * dx, from[1] + along * dy])
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
              | ^^^^^^^ warning[rapid-in-material] rapid move through what is cut only later
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
              | ^^^^^^^ warning[rapid-in-material] rapid move through what is cut only later
        "#]],
        );
        check_rule_in(&RULE, "haas-mill", &program, &with(50.0), &expect![[""]]);
    }

    #[test]
    fn what_lies_in_doubt_is_not_judged() {
        check_rule(&RULE, "haas-mill", &SLOT.replace("X10.", "X#100"), &expect![[""]]);
    }
}
