//! One tool that does the work of two kinds of tools.

use gcheck_controls::{Effect, Machine};
use gcheck_engine::{Abstract, At, Axis, Domain, Event, Position, Spindle, Stop, Travel, TravelKind};

use crate::declare::declare_rule;
use crate::facts::cycles::{is_drilling, is_tapping};
use crate::facts::edge::cuts_across;
use crate::facts::offset_schemes::whole;
use crate::facts::parting::Parting;
use crate::facts::turned::spot;
use crate::facts::turning::turns_the_part;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool does work that is seldom one tool's: it taps and also drills or mills, it cuts a thread on a lathe and also drills
    /// or parts off, or it drills along the centre of a lathe after it has turned or parted off.
    ///
    /// ## Why it matters
    /// The number of the tool is wrong in one of the places, or a tool change is missing: an insert for turning is pushed
    /// into the face like a drill, or a tap like an end mill, and breaks.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G18 G99 T0101
    /// G97 S800 M3
    /// G0 X30. Z2.
    /// G1 Z-40. F.2
    /// G0 X100. Z100.
    /// G0 X0. Z2.
    /// G1 Z-25. F.1
    /// G0 Z100.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 T1 M6
    /// S400 M3
    /// G43 H1 G0 X10. Y10. Z5.
    /// G84 Z-12. R5. F400.
    /// G80
    /// G0 X30. Y0.
    /// G1 Z-3. F100.
    /// X60.
    /// G0 Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// A drill may bore what it has drilled.
    /// ```nc,quiet,fanuc-lathe
    /// G21 G18 G99 T0101
    /// G97 S800 M3
    /// G0 X0. Z2.
    /// G1 Z-25. F.1
    /// G0 Z2.
    /// X16.
    /// G1 Z-20. F.1
    /// G0 Z100.
    /// M30
    /// ```
    rule "tool-does-unlike-work" in "tool" {
        summary: "one tool does the work of two kinds of tools",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(ToolDoesUnlikeWork::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ToolDoesUnlikeWork {
    /// The first work of each kind that each tool does.
    works: Vec<Work>,
    /// Tools that were reported.
    told: Vec<Tool>,
    /// X as a radius, and Z, where the last move ends as it is programmed: beside a nose of unknown size nothing else is known.
    here: Option<[f64; 2]>,
}

remembers!(ToolDoesUnlikeWork: works);

#[derive(Debug, Clone, Copy, PartialEq)]
struct Work {
    tool: Tool,
    kind: Kind,
    at: At,
}

remembers!(Work: at);

/// A tool by its number; on a turret by its offset, too, because a holder may have two.
type Tool = [u32; 2];

/// What a move does to the part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Taps.
    Tap,
    /// Cuts a thread with a point.
    Thread,
    /// Drills: on a mill by a cycle, on a lathe along the centre.
    Drill,
    /// Turns along the part.
    Turn,
    /// Parts off.
    PartOff,
    /// Cuts across the tool, on a mill.
    Mill,
}

/// Shorter cuts may be chamfers or the way to a cut: millimetres.
const SHORT: f64 = 3.0;
/// Nearer to the centre is at the centre: millimetres.
const CENTRE: f64 = 0.05;

impl PathRule for ToolDoesUnlikeWork {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let is_lathe = program.environment.control().machine() == Machine::Lathe;
        is_lathe || program.may(taps)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        match event {
            Event::RigidTap { .. } => self.does(cx, Kind::Tap, report),
            // Somebody may change the tool by hand.
            Event::Stop(Stop::Program | Stop::Message(_)) => self.works.clear(),
            _ => {}
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let from = match event {
            Event::Travel(travel) => std::mem::replace(&mut self.here, known(&travel.programmed)),
            Event::Arc(arc) => std::mem::replace(&mut self.here, known(&arc.programmed)),
            _ => self.here.take(),
        };
        let from = from.unwrap_or([f64::NAN; 2]);
        let kind = if cx.is_mill() { on_a_mill(cx, event) } else { on_a_lathe(cx, event, from) };
        if let Some(kind) = kind {
            self.does(cx, kind, report);
        }
    }
}

impl ToolDoesUnlikeWork {
    fn does(&mut self, cx: &PathCx<'_>, kind: Kind, report: &mut Report<'_>) {
        let Some(number) = Abstract::known(cx.state().tool()).and_then(whole) else { return };
        let by_t = cx.model.semantics().tools.offset_in_t;
        let offset = Abstract::known(cx.state().h()).and_then(whole).filter(|_| by_t);
        let tool = [number, offset.unwrap_or(0)];
        let is_known = |work: &Work| work.tool == tool && work.kind == kind;
        if number == 0 || self.works.iter().any(is_known) || self.told.contains(&tool) {
            return;
        }
        // Of several paths, another one may have changed the tool.
        if !cx.is_certain() {
            return;
        }
        let at = cx.origin().at;
        let before = self.works.iter().find(|work| work.tool == tool && are_unlike(work.kind, kind));
        if let Some(before) = before {
            let mut finding = cx
                .finding(
                    &META,
                    cx.range(),
                    format!("tool {number} {}, but {} before", verb(kind, false), verb(before.kind, true)),
                )
                .label("seldom the work of one tool");
            if let Some(range) = cx.range_of(before.at) {
                finding = finding.also(range, format!("tool {number} {} here", verb(before.kind, true)));
            }
            report.add(
                finding.help("check the tool's number, and whether a tool change is missing between them"),
            );
            self.told.push(tool);
        }
        self.works.push(Work { tool, kind, at });
    }
}

/// Is the later work none of a tool that has done the earlier?
fn are_unlike(before: Kind, now: Kind) -> bool {
    let is_either = |kind: Kind| before == kind || now == kind;
    // A point that cuts threads may also turn a relief.
    let is_turned = is_either(Kind::Turn);
    before != now && (is_either(Kind::Tap) || is_either(Kind::Thread) && !is_turned)
        || now == Kind::Drill && matches!(before, Kind::Turn | Kind::PartOff)
}

const fn verb(kind: Kind, is_past: bool) -> &'static str {
    match (kind, is_past) {
        (Kind::Tap, false) => "taps",
        (Kind::Tap, true) => "tapped",
        (Kind::Thread, false) => "cuts a thread",
        (Kind::Thread, true) => "cut a thread",
        (Kind::Drill, false) => "drills",
        (Kind::Drill, true) => "drilled",
        (Kind::Turn, false) => "turns",
        (Kind::Turn, true) => "turned",
        (Kind::PartOff, false) => "parts off",
        (Kind::PartOff, true) => "parted off",
        (Kind::Mill, false) => "mills",
        (Kind::Mill, true) => "milled",
    }
}

/// Is it a code that taps, in a cycle or where the tool is?
fn taps(effect: Effect) -> bool {
    is_tapping(effect) || matches!(effect, Effect::TapHere | Effect::LeftTapHere | Effect::RigidTap)
}

fn on_a_mill(cx: &PathCx<'_>, event: &Event) -> Option<Kind> {
    if let Some(kind) = by_cycle(cx, event) {
        return Some(kind);
    }
    let is_below = |travel: &Travel| travel.from.raw(Axis::Z) < 0.0 && travel.to.raw(Axis::Z) < 0.0;
    let cuts = match event {
        Event::Travel(travel) => is_below(travel),
        _ => true,
    };
    (cuts && cuts_across(event)).then_some(Kind::Mill)
}

/// The work of a stroke of a canned cycle.
fn by_cycle(cx: &PathCx<'_>, event: &Event) -> Option<Kind> {
    let Event::Travel(travel) = event else { return None };
    if travel.kind != TravelKind::Feed || !travel.expanded {
        return None;
    }
    let cycle = cx.state().active_cycle(cx.model).filter(|code| code.is_some())?;
    match cx.model.effect(cycle) {
        effect if taps(effect) => Some(Kind::Tap),
        effect if is_drilling(effect) && cx.is_mill() => Some(Kind::Drill),
        _ => None,
    }
}

/// X as a radius, and Z, if both are known.
fn known(position: &Position) -> Option<[f64; 2]> {
    Some(spot(position)).filter(|spot| spot.iter().all(|number| number.is_finite()))
}

fn on_a_lathe(cx: &PathCx<'_>, event: &Event, [x0, z0]: [f64; 2]) -> Option<Kind> {
    // With the spindle stopped a tool pushes the bar, or is its stop.
    if !turns_the_part(cx) || cx.state().spindle() == Some(Spindle::Stopped) {
        return None;
    }
    if let Some(kind) = by_cycle(cx, event) {
        return Some(kind);
    }
    let Event::Travel(travel) = event else { return None };
    let [x1, z1] = spot(&travel.programmed);
    match travel.kind {
        TravelKind::Thread => Some(Kind::Thread),
        TravelKind::Feed if Parting::of(cx, event).is_some() => Some(Kind::PartOff),
        // False for places that are not known.
        TravelKind::Feed if z0 - z1 > SHORT && z1 < -SHORT => {
            if x0.abs() < CENTRE && x1.abs() < CENTRE {
                Some(Kind::Drill)
            } else {
                (x0 > SHORT && x1 > SHORT).then_some(Kind::Turn)
            }
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn lathe(first: &str, between: &str, second: &str) -> String {
        format!(
            "G21 G18 G99 T0505\nG97 S800 M3\n{first}\nG0 X100. Z100.\n{between}\n{second}\nG0 X100.\nZ100.\nM30\n"
        )
    }

    const TURNS: &str = "G0 X30. Z2.\nG1 Z-40. F.2";
    const THREADS: &str = "G0 X34. Z5.\nG76 P020060 Q100 R0.05\nG76 X28.16 Z-27. P920 Q300 F1.5";
    const PARTS: &str = "G0 X32. Z-45.\nG1 X0. F.1";
    const DRILLS: &str = "G0 X0. Z2.\nG1 Z-25. F.1\nG0 Z5.";

    #[test]
    fn a_thread_is_cut_by_a_tool_of_its_own() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &lathe(THREADS, "", PARTS),
            &expect![[r#"
                9 | G1 X0. F.1
                  | ^^^^^^^^^^ warning[tool-does-unlike-work] tool 5 parts off, but cut a thread before
            "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &lathe(THREADS, "T0606", PARTS), &expect![[""]]);
    }

    #[test]
    fn what_has_turned_does_not_drill() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &lathe(TURNS, "", DRILLS),
            &expect![[r#"
                8 | G1 Z-25. F.1
                  | ^^^^^^^^^^^^ warning[tool-does-unlike-work] tool 5 drills, but turned before
            "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &lathe(DRILLS, "", TURNS), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &lathe(TURNS, "M5", DRILLS), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &lathe(TURNS, "", PARTS), &expect![[""]]);
    }

    #[test]
    fn two_tools_in_one_holder_and_a_change_by_hand() {
        let second = format!("T0515\n{DRILLS}");
        check_rule(&RULE, "fanuc-lathe", &lathe(TURNS, "", &second), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &lathe(TURNS, "M0", DRILLS), &expect![[""]]);
    }

    #[test]
    fn a_tap_does_nothing_else() {
        let mill = |cycle: &str| {
            format!(
                "G21 G90 G54 T3 M6\nS400 M3\nG43 H3 G0 X1. Y1. Z5.\n{cycle} Z-12. R5. F400.\nG80\nG81 X9. Z-9. R2. F90.\nG80\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &mill("G84"),
            &expect![[r#"
                6 | G81 X9. Z-9. R2. F90.
                  | ^^^^^^^^^^^^^^^^^^^^^ warning[tool-does-unlike-work] tool 3 drills, but tapped before
            "#]],
        );
        check_rule(&RULE, "haas-mill", &mill("G82 P0.5"), &expect![[""]]);
    }
}
