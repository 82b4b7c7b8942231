//! A lathe that drills beside the centre of its turning part.

use gcheck_controls::{Effect, LetterSet, Machine};
use gcheck_engine::{At, Axis, Event, Fact, Spindle, Travel, TravelKind, Truth};
use gcheck_geometry::Mm;
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::cycles::{cycle_name, is_drilling};
use crate::facts::live_tool::Executed;
use crate::facts::second_spindle::works_on_second;
use crate::facts::tool_words::ToolWords;
use crate::facts::turned::{Turned, UNDER};
use crate::facts::turning::turns_the_part;
use crate::{Finding, MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A drilling or tapping cycle of a lathe goes along Z beside the centre, while the part turns and no live tool does. So does a feed
    /// move of a tool that its comment calls a drill, where no hole is yet.
    ///
    /// A cycle of a live tool beside the centre is reported too if the spindle was started and nothing has stopped it or made it the C axis;
    /// so is a feed move along Z of a live tool that its comment calls a drill.
    ///
    /// A tool that works with the C axis, or after an M code of the machine builder, may be a live one: it is not judged.
    ///
    /// ## Why it matters
    /// A drill that does not turn cuts on the centre of a turning part only. Beside it the part runs against the flank
    /// of the drill, and the drill breaks: often the X of a turning tool was copied.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// T0303
    /// G97 S900 M3
    /// G0 G54 X2.1 Z0.2
    /// G83 Z-1.9 R0.1 Q0.25 F0.008
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// T0303
    /// G97 S900 M3
    /// G0 G54 X0. Z0.2
    /// G83 Z-1.9 R0.1 Q0.25 F0.008
    /// G80
    /// M30
    /// ```
    rule "drilled-beside-the-centre" in "cycles" {
        summary: "drilling cycle beside the centre of a turning part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CUTS.union(Watch::ALL_BLOCKS).union(Watch::CHANGES).union(Watch::RAPIDS),
            make: || Box::new(DrilledBesideTheCentre::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct DrilledBesideTheCentre {
    executed: Executed,
    /// The tool change whose drill was reported: it goes down in several moves.
    told: Option<At>,
}

remembers!(DrilledBesideTheCentre: executed, told);

/// Millimetres: a correction of the centre is less.
const OFF_CENTRE: f64 = 1.0;

impl PathRule for DrilledBesideTheCentre {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        self.executed.block(cx);
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.executed.changed(cx, event);
    }

    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        self.executed.rapid(cx);
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().machine() == Machine::Lathe
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        if travel.kind != TravelKind::Feed {
            return;
        }
        if !travel.expanded {
            self.by_feed(cx, travel, report);
            return;
        }
        let cycle = cx.state().active_cycle(cx.model).filter(|code| code.is_some());
        if !cycle.is_some_and(|code| drills(cx.model.effect(code))) {
            return;
        }
        let turns = cx.state().spindle().is_some_and(Spindle::turns);
        let (from, to) = (&travel.from, &travel.to);
        let goes_along = (from.raw(Axis::X) - to.raw(Axis::X)).abs() < f64::EPSILON
            && (from.raw(Axis::Z) - to.raw(Axis::Z)).abs() > f64::EPSILON;
        // A place that is not known is NaN, and not beside anything.
        let is_beside = to.raw(Axis::X).abs() > OFF_CENTRE;
        if !turns || !goes_along || !is_beside {
            return;
        }
        match cx.state().live_tool() {
            Truth::False if !self.executed.may_be_live(cx) => {}
            Truth::True => {
                self.with_live_tool(
                    cx,
                    &format!(
                        "`{}` drills beside the centre while the spindle turns the part",
                        cycle_name(cx)
                    ),
                    report,
                );
                return;
            }
            _ => return,
        }
        let away = cx.shown(Mm(to.raw(Axis::X).abs()));
        report.add(with_x(
            cx,
            to.raw(Axis::X),
            cx.finding(
                &META,
                cx.range(),
                format!("`{}` drills beside the centre of the turning part", cycle_name(cx)),
            )
            .label(format!("{away} beside the centre"))
            .note("the spindle turns the part, and no live tool is on")
            .help("give `X0.` before the cycle, or start the live tool"),
        ));
    }
}

impl DrilledBesideTheCentre {
    /// A live tool drills beside the centre, and the spindle turns the part under it. True if that is reported.
    fn with_live_tool(&self, cx: &PathCx<'_>, message: &str, report: &mut Report<'_>) -> bool {
        let Some(started) = cx.definitions().set_by(Fact::Spindle).filter(|at| at.file == 0) else {
            return false;
        };
        // Without a code for it, the machine builder's codes make the spindle an axis.
        if !cx.control_has(|effect| effect == Effect::LiveToolOn)
            || !cx.is_certain()
            || works_on_second(cx)
            || self.executed.may_hold_part(cx, started)
        {
            return false;
        }
        let finding = cx
            .finding(&META, cx.range(), message)
            .label("the part turns past the live tool")
            .help("stop the spindle and engage the C axis before the live tool drills");
        report.add(cx.resting_on(finding, Fact::Spindle, "the spindle"));
        true
    }

    /// A drill that is fed along Z into the part.
    fn by_feed(&mut self, cx: &PathCx<'_>, travel: &Travel, report: &mut Report<'_>) {
        let (from, to) = (&travel.from, &travel.to);
        let radius = to.raw(Axis::X);
        let is_level = (from.raw(Axis::X) - radius).abs() < f64::EPSILON;
        let is_into = from.raw(Axis::Z) > -UNDER && to.raw(Axis::Z) < -UNDER;
        let is_beside = !radius.is_nan() && radius.abs() > OFF_CENTRE;
        let tool = cx.definitions().set_by(Fact::Tool);
        if tool.is_some() && self.told == tool {
            return;
        }
        if is_level && is_into && is_beside && cx.state().live_tool() == Truth::True {
            // Turning tools that are driven, as for thread whirling, go along the part too.
            let turns = cx.state().spindle().is_some_and(Spindle::turns);
            if turns && ToolWords::of(cx).drills() && !turns_c_next(cx) {
                let message = "the live drill is fed in beside the centre while the spindle turns the part";
                if self.with_live_tool(cx, message, report) {
                    self.told = tool;
                }
            }
            return;
        }
        if !is_level || !is_into || !is_beside || !turns_the_part(cx) {
            return;
        }
        let turns = cx.state().spindle().is_some_and(Spindle::turns);
        // A called program may engage the C axis.
        if !turns
            || !cx.file_index.calls.is_empty()
            || cx.is_called_only()
            || !cx.is_certain()
            || !ToolWords::of(cx).only_drills()
            || self.executed.may_be_live(cx)
            || turns_c_next(cx)
        {
            return;
        }
        // A drill may widen the hole that another one made.
        if works_on_second(cx)
            || cx
                .shared::<Turned>()
                .is_none_or(|turned| turned.depth_at_centre(None) < -UNDER || !turned.knows(cx))
        {
            return;
        }
        self.told = tool;
        let away = cx.shown(Mm(radius.abs()));
        report.add(with_x(
            cx,
            radius,
            cx.finding(&META, cx.range(), "the drill is fed into the turning part beside its centre")
                .label(format!("{away} beside the centre"))
                .note("the comment of the tool names a drill, and the spindle turns the part")
                .assuming("the part has no bore before the program starts")
                .help("bring the drill to the centre first (`X0.`)"),
        ));
    }
}

/// The finding with the word that has brought the tool to this radius, where it is in another block near this one.
fn with_x(cx: &PathCx<'_>, radius: f64, finding: Finding) -> Finding {
    let here = cx.origin().at;
    let state = cx.state();
    let half = if state.is_diameter(cx.model) == Some(true) { 2.0 } else { 1.0 };
    let Some(units) = state.units(cx.model) else { return finding };
    let gives = |word: &Word| {
        let is_there = |number: f64| (number * units.in_mm() / half - radius).abs() < 1e-6;
        word.letter.ascii() == b'X' && !word.letter.is_corner() && word.number().is_some_and(is_there)
    };
    let blocks = here.block.saturating_sub(NEAR)..=here.block;
    let found = blocks.rev().find_map(|block| Some((block, cx.find_word(At { block, ..here }, gives)?)));
    match found {
        Some((block, range)) if block != here.block => finding.also(range, "X comes from here"),
        _ => finding,
    }
}

/// Blocks in which the X of a cycle is looked for.
const NEAR: u32 = 12;

/// Does the C axis turn before the next tool comes? Then the tool drills at its angles, and another rule tells what is missing for that.
fn turns_c_next(cx: &PathCx<'_>) -> bool {
    let here = cx.origin().at;
    let shows = |block: u32| {
        let place = cx.place_of(At { block, ..here })?;
        let letters = place.block().letters;
        let has = |set| letters.intersects(set);
        let turns = has(LetterSet::of("CH")) && !has(LetterSet::of("XZUW"));
        (turns || has(LetterSet::of("T"))).then_some(turns)
    };
    (here.block..=here.block.saturating_add(SOON)).find_map(shows) == Some(true)
}

/// Blocks in which the next hole begins.
const SOON: u32 = 20;

fn drills(effect: Effect) -> bool {
    is_drilling(effect) || effect.is_tapping_cycle()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(start: &str, x: &str) -> String {
        format!("G21\nT0303\n{start}\nG0 G54 {x} Z5.\nG83 Z-30. R2. Q5. F0.1\nG80\nM30\n")
    }

    #[test]
    fn a_turning_part_is_drilled_at_its_centre() {
        check_rule(
            &RULE,
            "haas-lathe",
            &program("G97 S900 M3", "X40."),
            &expect![[r#"
                5 | G83 Z-30. R2. Q5. F0.1
                  | ^^^^^^^^^^^^^^^^^^^^^^ warning[drilled-beside-the-centre] `G83` drills beside the centre of the turning part
            "#]],
        );
        check_rule(&RULE, "haas-lathe", &program("G97 S900 M3", "X0."), &expect![[""]]);
        check_rule(&RULE, "haas-lathe", &program("G97 S900 M3", "X#500"), &expect![[""]]);
    }

    #[test]
    fn a_drill_that_is_fed() {
        let fed = |comment: &str, before: &str, x: &str| {
            format!(
                "G21 G99\n{before}T0303 ({comment})\nG97 S900 M3\nG0 {x} Z5.\nG1 Z-40. F0.1\nG0 Z5.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &fed("10 MM DRILL", "", "X10."),
            &expect![[r#"
                5 | G1 Z-40. F0.1
                  | ^^^^^^^^^^^^^ warning[drilled-beside-the-centre] the drill is fed into the turning part beside its centre
            "#]],
        );
        for (comment, before, x) in [
            ("10 MM DRILL", "", "X0."),
            ("10 MM DRILL", "", "X0.2"),
            ("U DRILL 25", "", "X27."),
            ("SPOT DRILL", "", "X27."),
            ("BORE AFTER DRILL", "", "X27."),
            ("CBORE 24 AT DRILL HOLE", "", "X24."),
            ("10 MM DRILL", "M98 P8000\n", "X40."),
            ("10 MM DRILL", "T0202\nG97 S900 M3\nG0 X0 Z5.\nG1 Z-50. F.1\nG0 Z5.\n", "X10."),
            ("10 MM DRILL", "M45\n", "C90. X10."),
            ("10 MM DRILL", "", "X10. Z5.\nG1 Z-9.\nG0 Z5.\nC90.\n"),
            ("DRILL 6 POWERED", "", "X10."),
            ("DRILL 6 DRIVEN", "", "X10."),
            ("LIVE DRILL 6", "", "X10."),
            ("POWER TOOL - DRILL 6", "", "X10."),
            ("DRILL 6 ANGETRIEBEN", "", "X10."),
        ] {
            check_rule(&RULE, "fanuc-lathe", &fed(comment, before, x), &expect![[""]]);
        }
    }

    #[test]
    fn a_live_tool_in_a_part_that_turns() {
        let live = |between: &str| {
            format!(
                "G20 G99 T101\nG97 S600 M3\nG54 G0 X2.7 Z0.1\nG1 X2. F.01\nZ-1.\nX2.7\nG0 X5.\nT808\n{between}G98 P2000 M133\nG0 X1.5 Z0.5\nG83 X1.5 Z-0.75 R0.1 Q0.2 F8.\nG80\nM135\nM5\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-lathe",
            &live(""),
            &expect![[r#"
                11 | G83 X1.5 Z-0.75 R0.1 Q0.2 F8.
                   | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[drilled-beside-the-centre] `G83` drills beside the centre while the spindle turns the part
            "#]],
        );
        for between in ["M5\n", "M5\nM154\nG0 C0.\n", "M19\n", "M154\n", "M0\n", "M50\n"] {
            check_rule(&RULE, "haas-lathe", &live(between), &expect![[""]]);
        }
        // On the centre both may turn.
        check_rule(&RULE, "haas-lathe", &live("").replace("X1.5 Z", "X0. Z"), &expect![[""]]);
    }

    #[test]
    fn a_live_drill_that_is_fed_into_a_part_that_turns() {
        let fed = |comment: &str, between: &str, x: &str| {
            format!(
                "G20 G99 T101\nG97 S600 M3\nG54 G0 X2.7 Z0.1\nG1 X2. F.01\nZ-1.\nX2.7\nG0 X5.\nT808 ({comment})\n{between}G98 P2000 M133\nG0 X{x} Z0.1\nG1 Z-0.75 F8.\nG0 Z.1\nM135\nM5\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-lathe",
            &fed("1/4 LIVE DRILL", "", "1.5"),
            &expect![[r#"
                11 | G1 Z-0.75 F8.
                   | ^^^^^^^^^^^^^ warning[drilled-beside-the-centre] the live drill is fed in beside the centre while the spindle turns the part
            "#]],
        );
        for (comment, between, x) in [
            ("1/4 LIVE DRILL", "M5\n", "1.5"),
            ("1/4 LIVE DRILL", "M5\nM154\nG0 C0.\n", "1.5"),
            ("1/4 LIVE DRILL", "M154\n", "1.5"),
            ("1/4 LIVE DRILL", "M19\n", "1.5"),
            ("1/4 LIVE DRILL", "M50\n", "1.5"),
            ("1/4 LIVE DRILL", "", "0."),
            ("THREAD WHIRLING HEAD", "", "1.5"),
            ("1/4 LIVE END MILL", "", "1.5"),
        ] {
            let text = fed(comment, between, x);
            check_rule(&RULE, "haas-lathe", &text, &expect![[""]]);
        }
    }

    #[test]
    fn a_called_program_may_engage_the_c_axis() {
        let called = |engages: &str| {
            format!(
                "O1\nG20 G99 T101\nG97 S600 M3\nG54 G0 X2.7 Z0.1\nG1 X2. F.01\nZ-1.\nX2.7\nG0 X5.\nT808\nM98 P100\nG0 X1.5 Z0.5\nG98 G83 X1.5 Z-0.75 R0.1 Q0.2 F8.\nG80\nM135\nM30\nO100\n{engages}M99\n"
            )
        };
        check_rule(
            &RULE,
            "haas-lathe",
            &called("P2000 M133\n"),
            &expect![[r#"
                12 | G98 G83 X1.5 Z-0.75 R0.1 Q0.2 F8.
                   | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[drilled-beside-the-centre] `G83` drills beside the centre while the spindle turns the part
            "#]],
        );
        for engages in
            ["M154\nP2000 M133\n", "M19\nP2000 M133\n", "G0 C0.\nP2000 M133\n", "C0.\nP2000 M133\n"]
        {
            check_rule(&RULE, "haas-lathe", &called(engages), &expect![[""]]);
        }
        // What starts the live tool is the machine builder's.
        for engages in ["M45\n", "G0 C90.\n", "M88 S2000\n"] {
            check_rule(&RULE, "fanuc-lathe", &called(engages).replace("M135\n", ""), &expect![[""]]);
        }
        // The cycle is in the called program, and the C axis in the main one after it in the text.
        let inside =
            "O100\nG83 X1.5 Z-.75 R.1 Q.2 F8.\nG80\nM99\nO1\nG20 T808\nG97 S900 M3\nM45\nM98 P100\nM30\n";
        check_rule(&RULE, "fanuc-lathe", inside, &expect![[""]]);
    }

    #[test]
    fn a_live_tool_drills_anywhere() {
        check_rule(&RULE, "haas-lathe", &program("M154\nG97 P900 M133", "X40."), &expect![[""]]);
        check_rule(&RULE, "haas-lathe", &program("M5", "X40."), &expect![[""]]);
        for start in ["M13 S1500", "G97 S1500 M3\nM45", "G97 S1500 M3\nG0 C0."] {
            check_rule(&RULE, "fanuc-lathe", &program(start, "X40."), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("M45\nT0404\nG97 S900 M3", "X40."),
            &expect![[r#"
            7 | G83 Z-30. R2. Q5. F0.1
              | ^^^^^^^^^^^^^^^^^^^^^^ warning[drilled-beside-the-centre] `G83` drills beside the centre of the turning part
        "#]],
        );
        // A live tool by its comment: the builder's spindle turns it with `M3`.
        let powered = program("G97 S900 M3", "X40.").replace("T0303", "T0303 (DRILL 6 POWERED)");
        check_rule(&RULE, "fanuc-lathe", &powered, &expect![[""]]);
        let indexed = program("G97 S900 M3", "X40.").replace("Z-30.", "Z-30. H30.");
        check_rule(&RULE, "fanuc-lathe", &indexed, &expect![[""]]);
    }
}
