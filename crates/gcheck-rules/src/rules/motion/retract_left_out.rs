//! A retract that the program makes everywhere else.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{Axis, Event, Travel, TravelKind};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range};
use crate::{Finding, FollowedCx, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// Before the other tool changes, or before the other turns of a rotary axis, the program takes Z home (`G28`, `G30`, `G53`). Here
    /// it does not, and the tool has cut since.
    ///
    /// A tool 50 mm or more above all other levels counts as out of the way.
    ///
    /// Only mills are looked at, and only programs in which at least two others go home. Tool changes do not count on controls
    /// whose tool change goes home by itself.
    ///
    /// ## Why it matters
    /// A part, a trunnion or a fixture that turns needs more room than the clearance over the part, and a tool arm needs Z at its
    /// place. A block that is missing in one place alone has mostly been lost in an edit.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G21 G90 G54 G0 X0. Y0. B0. S3000 M3
    /// G43 H1 Z50.
    /// G1 Z-2. F200.
    /// G53 G0 Z0.
    /// G0 B90.
    /// Z50.
    /// G1 Z-2. F200.
    /// G53 G0 Z0.
    /// G0 B180.
    /// Z50.
    /// G1 Z-2. F200.
    /// G0 Z50.
    /// B270.
    /// G1 Z-2. F200.
    /// G53 G0 Z0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G21 G90 G54 G0 X0. Y0. B0. S3000 M3
    /// G43 H1 Z50.
    /// G1 Z-2. F200.
    /// G0 Z50.
    /// B90.
    /// G1 Z-2. F200.
    /// G0 Z50.
    /// B180.
    /// G1 Z-2. F200.
    /// G53 G0 Z0.
    /// M30
    /// ```
    rule "retract-left-out" in "motion" {
        summary: "retract is missing that the program makes everywhere else",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::MOVES).union(Watch::FOLLOWED),
            make: || Box::new(RetractLeftOut::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RetractLeftOut {
    /// The last move of Z took it home.
    is_home: bool,
    /// Where Z is, and the highest place where it was before that, apart from home: millimetres.
    level: Option<f64>,
    highest: Option<f64>,
    /// What the axes A, B and C were turned to last, as programmed: degrees.
    angles: [Option<f64>; 3],
    /// The tool has cut since the last tool change, and since the last turn of a rotary axis.
    has_cut: [bool; 2],
    /// What came before tool changes, and before turns.
    habits: [Habit; 2],
}

remembers!(RetractLeftOut: habits);

/// What a program does before one kind of event.
#[derive(Debug, Default, Clone, PartialEq)]
struct Habit {
    /// Blocks before which Z went home.
    home: Vec<Range<u32>>,
    /// The block before which it did not; `None` while all did.
    odd: Option<(Range<u32>, Finding)>,
    /// There are several of those.
    is_mixed: bool,
}

remembers!(Habit: home, odd);

/// So many others make a habit.
const HABIT: usize = 2;
/// More are not counted.
const MOST: usize = 64;
/// A rotary axis that turns by less follows a contour, or corrects a part: degrees.
const TURN: f64 = 20.0;

/// So far above the other levels of the program a tool arm or a part that turns may have room: millimetres.
const ROOM: f64 = 50.0;

const ROTARY: [Axis; 3] = [Axis::A, Axis::B, Axis::C];

const TOOL_CHANGE: usize = 0;
const ROTATION: usize = 1;

impl PathRule for RetractLeftOut {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().machine() == gcheck_controls::Machine::Mill
            && program.may(Effect::goes_to_machine_place)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if boundary(cx) != Some(Boundary::ToolChange) {
            return;
        }
        // A change that goes to the machine's zero by itself needs no retract.
        if cx.model.semantics().tools.change_at_zero.is_none() {
            let range = boundary_range(cx, Boundary::ToolChange);
            self.note(cx, TOOL_CHANGE, range, "the tool is changed without the retract that the others have");
        }
        self.has_cut = [false; 2];
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        let Event::Travel(travel) = event else {
            self.has_cut = [true; 2];
            return;
        };
        if travel.kind != TravelKind::Rapid {
            self.has_cut = [true; 2];
        }
        if moves(travel, Axis::Z) {
            self.is_home = cx.has_effect(Effect::goes_to_machine_place);
            if let Some(level) = self.level.take() {
                self.highest = Some(self.highest.map_or(level, |highest| highest.max(level)));
            }
            self.level = travel.to.get(Axis::Z).filter(|_| !self.is_home);
        } else if travel.kind == TravelKind::Rapid && !travel.expanded && self.turns(cx, travel) {
            self.note(
                cx,
                ROTATION,
                cx.range(),
                "the part turns without the retract that the other turns have",
            );
            self.has_cut = [self.has_cut.first() == Some(&true), false];
        }
        for (axis, angle) in ROTARY.into_iter().zip(&mut self.angles) {
            if cx.origin().letters.contains(axis.letter()) {
                *angle = travel.programmed.get(axis);
            }
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        for Habit { home, odd, is_mixed } in std::mem::take(&mut self.habits) {
            if let Some((range, finding)) = odd
                && home.len() >= HABIT
                && !is_mixed
                && !home.contains(&range)
            {
                let last = home.last().cloned().unwrap_or_default();
                let others = home.len();
                report.add(
                    finding
                        .also(last, format!("here, and in {} more places, Z goes home before", others - 1)),
                );
            }
        }
    }
}

impl RetractLeftOut {
    /// Does a rotary axis that the block names turn by much, as far as is known? A work offset that is not known hides the angle
    /// from which it turns; then the angle that was programmed last counts.
    fn turns(&self, cx: &PathCx<'_>, travel: &Travel) -> bool {
        ROTARY.into_iter().zip(self.angles).any(|(axis, last)| {
            let (from, to) = (travel.from.raw(axis), travel.to.raw(axis));
            let turn = if from.is_nan() {
                last.zip(travel.programmed.get(axis)).map(|(last, now)| last - now)
            } else {
                Some(from - to)
            };
            cx.origin().letters.contains(axis.letter()) && turn.is_none_or(|turn| turn.abs() > TURN)
        })
    }

    fn note(&mut self, cx: &PathCx<'_>, kind: usize, range: Range<u32>, message: &str) {
        let (Some(habit), Some(true)) = (self.habits.get_mut(kind), self.has_cut.get(kind)) else { return };
        // Programs of other files are not shown, and what a loop repeats is one place.
        if cx.origin().at.file != 0 || cx.is_after_unknown_program() {
            return;
        }
        if self.is_home || goes_home_first(cx) {
            if !habit.home.contains(&range) && habit.home.len() < MOST {
                habit.home.push(range);
            }
            return;
        }
        // Far above every other level of the program the room may be enough.
        if self.level.zip(self.highest).is_none_or(|(level, highest)| level > highest + ROOM) {
            return;
        }
        match &habit.odd {
            Some((known, _)) => habit.is_mixed |= *known != range,
            None => {
                let finding = cx
                    .finding(&META, range.clone(), message)
                    .label("the tool has cut, and Z has not gone home since")
                    .help("take Z home before this block, or say in a suppression why the room is enough");
                habit.odd = Some((range, finding));
            }
        }
    }
}

/// Does the block itself take Z home, before it changes the tool?
fn goes_home_first(cx: &PathCx<'_>) -> bool {
    cx.has_effect(Effect::goes_to_machine_place) && cx.origin().letters.contains(Axis::Z.letter())
}

fn moves(travel: &Travel, axis: Axis) -> bool {
    let (from, to) = (travel.from.raw(axis), travel.to.raw(axis));
    to.is_nan() != from.is_nan() || (from - to).abs() > 0.001
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_tool_change_where_the_others_go_home() {
        let section = |tool: u8, home: &str| {
            format!("T{tool} M6\nG90 G54 G0 X0. Y0. S900 M3\nG43 H{tool} Z50.\nG1 Z-2. F200.\n{home}")
        };
        let program = |second: &str| {
            let home = "G91 G28 Z0.\n";
            let sections = [section(1, home), section(2, second), section(3, home), section(4, home)];
            format!("G21\n{}M30\n", sections.concat())
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G0 Z50.\n"),
            &expect![[r#"
            12 | T3 M6
               |    ^^ warning[retract-left-out] the tool is changed without the retract that the others have
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("G53 G0 Z0.\n"), &expect![[""]]);
        // A little higher than the clearance of the others.
        let low = program("G0 Z50.\n").replace("Z50.\nG1", "Z5.\nG1");
        check_rule(
            &RULE,
            "fanuc-mill",
            &low,
            &expect![[r#"
            12 | T3 M6
               |    ^^ warning[retract-left-out] the tool is changed without the retract that the others have
        "#]],
        );
        let in_one_block = program("G91 G28 Z0. M6 T3\n").replace("T3 M6\n", "");
        check_rule(&RULE, "fanuc-mill", &in_one_block, &expect![[""]]);
        // The tool change of this control goes home by itself.
        check_rule(&RULE, "haas-mill", &program("G0 Z50.\n"), &expect![[""]]);
    }

    #[test]
    fn a_level_above_all_others_may_be_enough() {
        let side = |angle: u16, home: &str| format!("{home}G0 B{angle}.\nZ50.\nG1 Z-2. F200.\n");
        let program = |third: &str| {
            let home = "G53 G0 Z0.\n";
            let sides = [side(90, home), side(180, home), side(270, third)];
            format!(
                "T1 M6\nG21 G90 G54 G0 X0. Y0. B0. S900 M3\nG43 H1 Z50.\nG1 Z-2. F200.\n{}M30\n",
                sides.concat()
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program("G0 Z50.\n"),
            &expect![[r#"
            14 | G0 B270.
               | ^^^^^^^^ warning[retract-left-out] the part turns without the retract that the other turns have
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program("G0 Z200.\n"), &expect![[""]]);
        // The angle is stated again, and the part does not turn.
        let again = program("G0 Z50.\n").replace("G0 B270.", "G55 G0 B180. X0. Y0.");
        check_rule(&RULE, "haas-mill", &again, &expect![[""]]);
    }

    #[test]
    fn one_other_place_is_no_habit() {
        let program = "T1 M6\nG21 G90 G54 G0 X0. Y0. B0. S900 M3\nG43 H1 Z50.\nG1 Z-2. F200.\nG53 G0 Z0.\nG0 B90.\nZ50.\nG1 Z-2. F200.\nG0 Z50.\nB180.\nM30\n";
        check_rule(&RULE, "haas-mill", program, &expect![[""]]);
    }
}
