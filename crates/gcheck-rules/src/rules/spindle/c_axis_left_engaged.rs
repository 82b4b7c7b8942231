//! Turning while the C axis is engaged.

use gcheck_controls::{Effect, LetterSet, Machine};
use gcheck_engine::{At, Axis, Event, TravelKind, Truth};

use crate::declare::declare_rule;
use crate::facts::cutting::starts_spindle;
use crate::facts::second_spindle::swaps;
use crate::facts::tool_words::ToolWords;
use crate::facts::workholding::{Moved, code_that};
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The program starts the spindle for turning, and the C axis is still engaged: `M154` without `M155`. Controls whose data name
    /// no such codes are not judged. On many machines the start of the spindle releases the axis by itself, so this is an information.
    ///
    /// It is a warning where the program then works with the C axis and a live tool that nothing has started: it turns C to another angle,
    /// or feeds a tool that its comment calls a drill along Z beside the centre. Then the code for the live tool (`M133`) was meant.
    ///
    /// ## Why it matters
    /// The spindle is an axis: it keeps its angle or stops with an alarm. What a machine does depends on its make and
    /// its version.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G98 T808
    /// M154
    /// M133 P2000
    /// G0 X2. Z.2 C0.
    /// G1 Z-.5 F8.
    /// M135
    /// T101
    /// G99 G97 S500 M3
    /// G1 Z-1. F.01
    /// M30
    /// ```
    /// The live tool was meant.
    /// ```nc,reported,haas-lathe
    /// G20 G98 T808
    /// M154
    /// G97 S1500 M3
    /// G0 X2. Z.2 C0.
    /// G1 Z-.5 F8.
    /// G0 Z.2
    /// M155
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G98 T808
    /// M154
    /// M133 P2000
    /// G0 X2. Z.2 C0.
    /// G1 Z-.5 F8.
    /// M135
    /// M155
    /// T101
    /// G99 G97 S500 M3
    /// G1 Z-1. F.01
    /// M30
    /// ```
    rule "c-axis-left-engaged" in "spindle" {
        summary: "spindle started for turning with the C axis engaged",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::MOVES).union(Watch::CHANGES).union(Watch::FOLLOWED),
            make: || Box::new(CAxisLeftEngaged::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CAxisLeftEngaged {
    /// The block that engaged the axis.
    engaged: Option<At>,
    /// The spindle was started, and the next moves show what for.
    started: Option<Started>,
}

remembers!(CAxisLeftEngaged: engaged, started);

/// A start of the spindle with the C axis engaged.
#[derive(Clone, PartialEq)]
struct Started {
    /// For turning, for all that is known.
    finding: Finding,
    /// For a live tool, if the next moves show that.
    of_live_tool: Finding,
}

remembers!(Started: finding, of_live_tool);

/// Nearer to the centre is on it, and a shorter way is none: millimetres.
const NEAR: f64 = 1.0;

/// The modal group of the codes that engage the axis and release it.
const GROUP: &str = "c-axis";

impl PathRule for CAxisLeftEngaged {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let control = program.environment.control();
        control.machine() == Machine::Lathe && control.codes().any(|code| code.entry().group == GROUP)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if matches!(event, Event::ToolChange(_)) {
            self.tell(report);
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        self.tell(report);
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if self.started.is_some()
            && cx.state().live_tool() == Truth::False
            && cx.is_certain()
            && is_of_live_tool(cx, event)
            && let Some(started) = self.started.take()
        {
            report.add(started.of_live_tool);
        }
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_known = cx.is_certain();
        let mut is_released = !is_known;
        let mut is_switched = false;
        for code in cx.codes().iter().filter_map(|ix| cx.code_of(*ix)) {
            let is_own = code.entry().group == GROUP;
            is_switched |= is_own;
            if is_own && !code.entry().cancelled_by.is_empty() {
                self.engaged = Some(cx.origin().at);
            }
            // What the machine builder made of a code may release it. Another spindle has an axis of its own.
            is_released |= is_own && code.entry().cancelled_by.is_empty() || code.is_user();
        }
        if is_released || swaps(cx) {
            self.engaged = None;
        }
        let ends = |effect| matches!(effect, Effect::LiveToolOn | Effect::SpindleStop);
        if is_released || is_switched || swaps(cx) || cx.has_effect(ends) {
            self.tell(report);
        }
        let starts = |effect| starts_spindle(effect) && effect != Effect::LiveToolOn;
        if !cx.has_effect(starts) || cx.origin().letters.intersects(LetterSet::of("C")) {
            return;
        }
        let Some(engaged) = self.engaged.take() else { return };
        let code = |moved| code_that(cx.control(), GROUP, moved);
        let (Some(on), Some(off)) = (code(Moved::Out), code(Moved::Back)) else { return };
        let (name, end) = (on.number(), off.number());
        let range = cx.effect_range(starts);
        let engaged = cx.find_code(engaged, |code| code.entry().group == GROUP).map(|(_, range)| range);
        let with_place = |finding: Finding| match engaged.clone() {
            Some(range) => finding.also(range, "engaged here"),
            None => finding,
        };
        let message = format!("the spindle starts with the C axis engaged (`{name}`)");
        let finding = cx
            .finding(&META, range.clone(), message)
            .label(format!("no `{end}` before this"))
            .note(format!("`{end}`: {}  [{}]", off.entry().summary, off.entry().source))
            .assuming("the start of the spindle does not release the axis by itself")
            .help(format!("release the C axis with `{end}` before this block"))
            .at_most(Severity::Info);
        let finding = with_place(finding);
        self.tell(report);
        let Some(live) = cx.name_of_effect(Effect::LiveToolOn) else {
            report.add(finding);
            return;
        };
        let message =
            format!("the main spindle is started, and `{name}` has made it the C axis for a live tool");
        let of_live_tool = cx
            .finding(&META, range, message)
            .label("turns the part or does nothing; the live tool does not turn")
            .help(format!("start the live tool with `{live}` and its speed in place of this"));
        self.started = Some(Started { finding, of_live_tool: with_place(of_live_tool) });
    }
}

impl CAxisLeftEngaged {
    /// Tells a start that showed nothing of a live tool.
    fn tell(&mut self, report: &mut Report<'_>) {
        if let Some(started) = self.started.take() {
            report.add(started.finding);
        }
    }
}

/// Does the move turn the C axis, or drill beside the centre?
fn is_of_live_tool(cx: &PathCx<'_>, event: &Event) -> bool {
    let Event::Travel(travel) = event else { return false };
    let goes = |axis: Axis| (travel.to.raw(axis) - travel.from.raw(axis)).abs();
    // In a feed move with X or Z the letter may be a chamfer.
    let turns = travel.kind == TravelKind::Rapid && cx.origin().letters.intersects(LetterSet::of("C"));
    let is_down = travel.kind == TravelKind::Feed && travel.to.raw(Axis::Z) < travel.from.raw(Axis::Z) - NEAR;
    let is_beside = goes(Axis::X) < NEAR && travel.to.raw(Axis::X).abs() > NEAR;
    let words = ToolWords::of(cx);
    turns || is_down && is_beside && (words.is_powered() || words.only_drills())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn once_for_each_time_that_it_is_engaged() {
        let program = |between: &str| {
            format!(
                "G20 G98 T808\nM154\nM133 P2000\nG0 X2. Z.2 C0.\nM135\n{between}T101\nG99 G97 S500 M3\nG1 Z-1. F.01\nM5\nM3\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-lathe",
            &program(""),
            &expect![[r#"
                7 | G99 G97 S500 M3
                  |              ^^ info[c-axis-left-engaged] the spindle starts with the C axis engaged (`M154`)
            "#]],
        );
        for between in ["M155\n", "M98 P77\n", "G14\n"] {
            check_rule(&RULE, "haas-lathe", &program(between), &expect![[""]]);
        }
    }

    #[test]
    fn started_in_place_of_the_live_tool() {
        let program = |comment: &str, start: &str, work: &str| {
            format!(
                "G20 G98 T808 ({comment})\nM5\nM154\nG0 C0.\n{start}\nG0 X2. Z.2\n{work}\nG0 Z.2\nM155\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-lathe",
            &program("", "G97 S1500 M3", "G83 Z-.5 R.1 Q.2 F8.\nC120.\nG80"),
            &expect![[r#"
                5 | G97 S1500 M3
                  |           ^^ warning[c-axis-left-engaged] the main spindle is started, and `M154` has made it the C axis for a live tool
            "#]],
        );
        for comment in ["LIVE DRILL 1/4", "DRILL 1/4", "DRILL 6 POWERED"] {
            check_rule(
                &RULE,
                "haas-lathe",
                &program(comment, "G97 S1500 M3", "G1 Z-.5 F8."),
                &expect![[r#"
                    5 | G97 S1500 M3
                      |           ^^ warning[c-axis-left-engaged] the main spindle is started, and `M154` has made it the C axis for a live tool
                "#]],
            );
        }
        // The axis is engaged again after the turning.
        check_rule(
            &RULE,
            "haas-lathe",
            &program("", "G97 S1500 M3\nG1 X1.9 F9.\nM154\nP1500 M133", "G83 Z-.5 R.1 Q.2 F8.\nC120.\nG80"),
            &expect![[r#"
                5 | G97 S1500 M3
                  |           ^^ info[c-axis-left-engaged] the spindle starts with the C axis engaged (`M154`)
            "#]],
        );
        // For turning, for all that is known.
        check_rule(
            &RULE,
            "haas-lathe",
            &program("OD TURN", "G97 S1500 M3", "G1 Z-.5 F8."),
            &expect![[r#"
                5 | G97 S1500 M3
                  |           ^^ info[c-axis-left-engaged] the spindle starts with the C axis engaged (`M154`)
            "#]],
        );
        for (start, work) in [
            ("P1500 M133", "G83 Z-.5 R.1 Q.2 F8.\nC120.\nG80"),
            ("M155\nG97 S1500 M3", "G1 Z-.5 F8."),
            ("M155\nM154\nP1500 M133", "C120."),
        ] {
            check_rule(&RULE, "haas-lathe", &program("LIVE DRILL", start, work), &expect![[""]]);
        }
    }
}
