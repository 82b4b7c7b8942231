//! A feed that looks meant for another feed mode.

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_engine::{Abstract, At, Axis, Domain, Event, Fact, FeedMode, Position, Role, Spindle, TravelKind};
use gcheck_geometry::Mm;
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::cycles::drills_by_cycle;
use crate::facts::feed::goes_by_feed;
use crate::facts::tool_words::ToolWords;
use crate::facts::turned::{Turned, end};
use crate::facts::units;
use crate::{MakeShared, PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A cut at more than 10 mm (0.4 inch) per turn of the spindle, on a lathe at more than 1.4 mm (0.055 inch), or at less than
    /// 1 mm (0.04 inch) per minute. On a mill, a feed per minute counts with the speed of the spindle, for cuts below the zero of
    /// the part with a tool that the program has changed to and whose length is in effect. On a lathe, moves in the air do not count: outward, before the face, down to it, and outside of
    /// what was turned; nor do knurls and rollers, bar pullers and live centres, nor taps and dies that are fed by their pitch.
    ///
    /// Where the program does not state its units, a feed is reported that is odd in both.
    ///
    /// ## Why it matters
    /// No tool cuts like this: the number is meant for the other feed mode. 300 mm per minute read as 300 mm per turn
    /// breaks the tool, and 0.2 mm per turn read as 0.2 mm per minute rubs for hours.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G54 S2000 M3
    /// G95 G1 X10. F300.
    /// M30
    /// ```
    /// ```nc,reported,haas-lathe
    /// G20 G98 T101
    /// G97 S900 M3
    /// G1 X1. F0.012
    /// M30
    /// ```
    /// A lathe feeds per turn unless the program says otherwise.
    /// ```nc,reported,fanuc-lathe
    /// G21 T0101
    /// G96 S180 M3
    /// G0 X38. Z1.
    /// G1 Z-30. F12.
    /// X42. F.2
    /// M30
    /// ```
    /// At 4500 turns a minute this is 22 mm (0.9 inch) per turn.
    /// ```nc,reported,haas-mill
    /// G20 G90 G94 G54 T6 M6
    /// G0 X1. Y0. S4500 M3
    /// G43 H6 Z.1
    /// G1 Z-.1 F8.
    /// X2. F4000.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G54 S2000 M3
    /// G95 G1 X10. F0.3
    /// G94 X20. F300.
    /// M30
    /// ```
    /// A thread is cut at its lead.
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T101
    /// G97 S50 M3
    /// G32 Z-50. F12.
    /// M30
    /// ```
    rule "feed-implausible" in "motion" {
        summary: "feed that looks meant for another feed mode",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CUTS.union(Watch::MOVES),
            make: || Box::new(FeedImplausible::default()),
        },
    }
}

/// Millimetres per turn: more than any milling cutter allows.
const MOST_A_TURN: f64 = 10.0;
/// Millimetres per turn: more than any turning tool allows.
const MOST_A_TURN_OF_THE_PART: f64 = 1.4;
/// Millimetres per turn: above this the number is meant for the other mode, below it a point or a zero is wrong.
const OTHER_MODE: f64 = 3.0;
/// Millimetres per turn: no thread that a tap or a die cuts is coarser.
const COARSEST: f64 = 6.5;
/// Turns per minute: below this, `S` only switches the spindle on (`S1`), as on a router.
const LEAST_SPEED: f64 = 10.0;
/// Millimetres per minute: less than any useful feed.
const LEAST_A_MINUTE: f64 = 1.0;

#[derive(Default, Clone, PartialEq)]
struct FeedImplausible {
    /// The block whose feed was reported.
    told: Option<At>,
    /// The tool change whose tool was reported with a feed too fast for its speed.
    told_at_speed: Option<At>,
}

remembers!(FeedImplausible: told, told_at_speed);

impl PathRule for FeedImplausible {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if cx.is_mill() {
            self.judge(cx, event, report);
            self.judge_at_speed(cx, event, report);
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if cx.is_mill() {
            cx.enough();
        } else if !is_in_air(cx, event) {
            self.judge(cx, event, report);
        }
    }
}

impl FeedImplausible {
    fn judge(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        let Some(feed) = Abstract::known(state.feed()).filter(|feed| *feed > 0.0) else { return };
        let most = if cx.is_mill() { MOST_A_TURN } else { MOST_A_TURN_OF_THE_PART };
        let [least, greatest] = units::range(cx, feed);
        let is_fast = least > most;
        let (reads, other) = match state.feed_mode(cx.model) {
            Some(FeedMode::PerRevolution) if is_fast => ("per turn of the spindle", "per minute"),
            Some(FeedMode::PerMinute) if greatest < LEAST_A_MINUTE => {
                ("per minute", "per turn of the spindle")
            }
            _ => return,
        };
        // A mode that the program does not set may differ on the machine; lathes usually start in feed per turn.
        let is_stated = cx.definitions().set_by(Fact::Mode(Role::FeedMode)).is_some();
        let may_be_lathe = cx.environment.control_is_unknown();
        if !is_stated && (cx.is_mill() == is_fast || cx.is_mill() && may_be_lathe)
            || taps(cx)
            || is_fast && is_fed_fast(cx, least)
        {
            return;
        }
        let Some(given) = cx.definitions().set_by(Fact::Feed) else { return };
        // Other rules report a feed that was given under the other mode, and a missing decimal point.
        let (now, then) = (state.mode(Role::FeedMode).only(), state.feed_given_under().only());
        let lost = |word: &Word| is_feed(word) && !word.shape.point && word.number().is_some();
        let counts_steps = !is_stated || feed < LEAST_A_MINUTE;
        if now != then || !goes_by_feed(event) || counts_steps && cx.find_word(given, lost).is_some() {
            return;
        }
        if self.told.replace(given) == Some(given) {
            return;
        }
        let range = cx.find_word(given, is_feed).unwrap_or_else(|| cx.range());
        let (label, help) = if is_fast && least <= OTHER_MODE {
            (
                "more than a turning tool takes".to_owned(),
                "check the decimal point and the zeros of the number",
            )
        } else {
            (format!("looks meant for {other}"), "check the feed mode and the number")
        };
        let finding = cx
            .finding(&META, range, format!("feed of {} {reads} (`F`)", cx.shown(Mm(feed))))
            .label(label)
            .help(help);
        let name = cx.code_name(Role::FeedMode).unwrap_or_default();
        let finding = cx.resting_on(finding, Fact::Mode(Role::FeedMode), &format!("`{name}`"));
        report.add(if is_stated {
            finding
        } else {
            finding.assuming(format!("the control starts in feed {reads}"))
        });
    }

    /// A feed per minute that is too fast for the speed of the spindle.
    fn judge_at_speed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        let turns = state.spindle().is_some_and(Spindle::turns);
        let (Some(feed), Some(speed)) = (Abstract::known(state.feed()), Abstract::known(state.speed()))
        else {
            return;
        };
        if !turns
            || speed < LEAST_SPEED
            || state.feed_mode(cx.model) != Some(FeedMode::PerMinute)
            || matches!(state.effect(Role::SpindleMode, cx.model), Some(Effect::SurfaceSpeed))
            || !is_tool_of_a_mill(cx)
            || !cuts_below_zero(cx, event)
        {
            return;
        }
        let [least, _] = units::range(cx, feed);
        let a_turn = least / speed;
        let tool = ToolWords::of(cx);
        if a_turn.is_nan()
            || a_turn <= MOST_A_TURN
            || taps(cx)
            || tool.rolls()
            || tool.needs_no_spindle()
            || tool.follows_its_pitch()
        {
            return;
        }
        let Some(given) = cx.definitions().set_by(Fact::Feed) else { return };
        // One number for the speed makes every feed of the tool implausible.
        let changed = cx.definitions().set_by(Fact::Tool);
        if self.told == Some(given) || changed.is_none() || self.told_at_speed == changed {
            return;
        }
        self.told_at_speed = changed;
        let range = cx.find_word(given, is_feed).unwrap_or_else(|| cx.range());
        let finding = cx
            .finding(
                &META,
                range,
                format!("feed of {} per turn of the spindle (`F`, `S{speed:.0}`)", cx.shown(Mm(a_turn))),
            )
            .label(format!("{} per minute at {speed:.0} turns per minute", cx.shown(Mm(feed))))
            .help("check the feed and the speed: a zero or a decimal point is wrong in one of them");
        report.add(cx.resting_on(finding, Fact::Speed, &format!("`S{speed:.0}`")));
    }
}

fn is_feed(word: &Word) -> bool {
    word.letter == Letter::of('F')
}

/// Does the move cut below the zero of the part: across, or in a cycle that drills? A tool goes down into a hole as fast as it likes.
fn cuts_below_zero(cx: &PathCx<'_>, event: &Event) -> bool {
    let is_below =
        |from: &Position, to: &Position| from.raw(Axis::Z) < 0.0 && to.raw(Axis::Z) <= from.raw(Axis::Z);
    match event {
        Event::Travel(travel) if travel.expanded => drills_by_cycle(cx) && travel.to.raw(Axis::Z) < 0.0,
        Event::Travel(travel) => {
            let is_across = cx.origin().letters.intersects(LetterSet::of("XY"));
            is_across && is_below(&travel.from, &travel.programmed)
        }
        Event::Arc(arc) => is_below(&arc.from, &arc.programmed),
        _ => false,
    }
}

/// Is the length of a tool in effect that the program has changed to? A laser or a torch has none, and its `S` is a power.
fn is_tool_of_a_mill(cx: &PathCx<'_>) -> bool {
    let has_length = matches!(
        cx.state().effect(Role::Length, cx.model),
        Some(Effect::LengthPlus | Effect::LengthMinus | Effect::LengthFiveAxis)
    );
    has_length && cx.definitions().set_by(Fact::Tool).is_some()
}

/// Is the tool one that is fed like this: a knurl, a bar puller, a tap in a floating holder?
fn is_fed_fast(cx: &PathCx<'_>, feed: f64) -> bool {
    let words = ToolWords::of(cx);
    words.rolls() || words.needs_no_spindle() || words.follows_its_pitch() && feed < COARSEST
}

/// Does the tool of a lathe move in the air, as far as the program shows it?
fn is_in_air(cx: &PathCx<'_>, event: &Event) -> bool {
    let Event::Travel(travel) = event else { return false };
    let Some(turned) = cx.shared::<Turned>() else { return false };
    // A place that is not known compares as nowhere.
    let from = turned.here().unwrap_or([f64::NAN; 2]);
    let to = end(cx, travel);
    // Outward, a tool for bores cuts.
    let may_cut = to[0] > from[0] && to[1] < 0.0 && ToolWords::of(cx).may_bore();
    travel.kind != TravelKind::Feed || !travel.expanded && turned.is_in_air(from, to) && !may_cut
}

/// A tap is fed by its pitch.
fn taps(cx: &PathCx<'_>) -> bool {
    let cycle = cx.state().active_cycle(cx.model).filter(|code| code.is_some());
    cycle.is_some_and(|code| cx.model.effect(code).is_tapping_cycle())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn each_feed_is_told_once() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G95 S900 M3\nG1 X1. F30.\nX2.\nG1 X3. F0.01\nM30\n",
            &expect![[r#"
                2 | G1 X1. F30.
                  |        ^^^^ warning[feed-implausible] feed of 30 in per turn of the spindle (`F`)
            "#]],
        );
    }

    #[test]
    fn a_feed_per_minute_counts_with_the_speed() {
        let program = |speed: &str, cut: &str| {
            format!(
                "G21 G17 G90 G94 G54\nT1 M6\nG0 X0. Y0. {speed} M3\nG43 H1 Z20.\n{cut}\nG80 G0 Z20.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("S15", "G81 Z-15. R5. F180."),
            &expect![[r#"
            5 | G81 Z-15. R5. F180.
              |               ^^^^^ warning[feed-implausible] feed of 12 mm per turn of the spindle (`F`, `S15`)
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("S1500", "G1 Z-2. F200.\nX40. F20000.\nX60. F25000."),
            &expect![[r#"
            6 | X40. F20000.
              |      ^^^^^^^ warning[feed-implausible] feed of 13.333 mm per turn of the spindle (`F`, `S1500`)
        "#]],
        );
        for (speed, cut) in [
            ("S1500", "G81 Z-15. R5. F180."),
            // Into a bore from its back, and above the part.
            ("S50", "G1 Z-40. F1000."),
            ("S50", "G1 X40. F1000."),
            ("S15", "G84 Z-15. R5. F180."),
            // On a router that is only switched on.
            ("S1", "G1 Z-2. F200.\nX40. F2000."),
            ("S#500", "G1 Z-2. F200.\nX40. F20000."),
        ] {
            check_rule(&RULE, "fanuc-mill", &program(speed, cut), &expect![[""]]);
        }
        // The program of a lathe, where nobody has chosen the control.
        let world = World { control_is_guessed: true, ..World::default() };
        let turning = "G21 G99 T01\nG97 S364 M3\nG0 X59. Z.5\nG1 Z-78.642 F0.127\nM30\n";
        check_rule_in(&RULE, "generic-mill", turning, &world, &expect![[""]]);
        // The power of a laser.
        check_rule(&RULE, "grbl", "G21 G90 G94 M3 S100\nG1 Z-1 F600\nX40 F4000\nM5\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_mill_feeds_by_the_minute() {
        for control in ["grbl", "linuxcnc"] {
            check_rule(
                &RULE,
                control,
                "G21 G90 S18000 M3\nG1 X20 F0.8\nM2\n",
                &expect![[r#"
                2 | G1 X20 F0.8
                  |        ^^^^ warning[feed-implausible] feed of 0.8 mm per minute (`F`)
            "#]],
            );
            check_rule(&RULE, control, "G21 G90 S18000 M3\nG1 X20 F80\nM2\n", &expect![[""]]);
        }
    }

    #[test]
    fn a_mode_that_the_program_does_not_set_may_be_the_other_one() {
        check_rule(&RULE, "fanuc-lathe", "O1\nG97 S900 M3\nG1 X10. F3000\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_lathe_feeds_by_the_turn() {
        let program = |mode: &str, feed: &str| {
            format!("G21 {mode}T0101\nG97 S800 M3\nG0 X42. Z1.\nG1 Z-30. F{feed}\nX44.\nM30\n")
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", "200."),
            &expect![[r#"
            4 | G1 Z-30. F200.
              |          ^^^^^ warning[feed-implausible] feed of 200 mm per turn of the spindle (`F`)
        "#]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            &program("G99 ", "4."),
            &expect![[r#"
            4 | G1 Z-30. F4.
              |          ^^^ warning[feed-implausible] feed of 4 mm per turn of the spindle (`F`)
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("", "1.2"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", "2."),
            &expect![[r#"
            4 | G1 Z-30. F2.
              |          ^^^ warning[feed-implausible] feed of 2 mm per turn of the spindle (`F`)
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("G98 ", "200."), &expect![[""]]);
    }

    #[test]
    fn a_lathe_moves_fast_in_the_air() {
        let program = |tool: &str, moves: &str| {
            format!(
                "G21 G99\nT0101\nG97 S800 M3\nG0 X44. Z2.\nX38.\nG1 Z-60. F.2\nG0 X44.\nZ50.\nT0303 {tool}\n{moves}\nG0 X100. Z50.\nM30\n"
            )
        };
        for moves in [
            "G0 X36. Z2.\nG1 Z-20. F.1\nX200. Z100. F5.",
            "G0 X60. Z5.\nG1 X36. Z1. F3.\nZ-20. F.1",
            "G0 X60. Z-20.\nG1 X40. F5.\nX30. F.1",
        ] {
            check_rule(&RULE, "fanuc-lathe", &program("", moves), &expect![[""]]);
        }
        for moves in [
            // Off the diameter, and out of a groove.
            "G0 X36. Z2.\nG1 Z-20. F.1\nX44. F2.",
            "G0 X42. Z-30.\nG1 X26. F.1\nX42. F2.",
            // Down to the face, and back over it.
            "G0 X44. Z5.\nG1 Z0 F2.\nX-1.6 F.2\nX44. F3.",
        ] {
            check_rule(&RULE, "fanuc-lathe", &program("", moves), &expect![[""]]);
        }
        for (tool, moves) in [
            ("(KNURL)", "G0 X37. Z2.\nG1 Z-20. F2."),
            ("(TAP M12X1.75 FLOATING HOLDER)", "G0 X0. Z8.\nG1 Z-20. F1.75\nM5\nM4\nZ8."),
            ("(1/2-13 DIE HEAD)", "G0 X0. Z8.\nG1 Z-20. F1.9538"),
            ("(BAR PULLER)", "G0 X20. Z5.\nG1 Z-20. F5."),
            ("(LIVE CENTER)", "G0 X0. Z5.\nG1 Z-2. F3."),
        ] {
            check_rule(&RULE, "fanuc-lathe", &program(tool, moves), &expect![[""]]);
        }
        // For a tap it is meant for the other mode.
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("(TAP M12X1.75)", "G0 X0. Z8.\nG1 Z-20. F175."),
            &expect![[r#"
                11 | G1 Z-20. F175.
                   |          ^^^^^ warning[feed-implausible] feed of 175 mm per turn of the spindle (`F`)
            "#]],
        );
        // Along the face.
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", "G0 X44. Z0.\nG1 X-1.6 F2."),
            &expect![[r#"
                11 | G1 X-1.6 F2.
                   |          ^^^ warning[feed-implausible] feed of 2 mm per turn of the spindle (`F`)
            "#]],
        );
        // Outward in a bore.
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("(ID RECESS)", "G0 X20. Z2.\nZ-5.\nG1 X26. F2."),
            &expect![[r#"
                12 | G1 X26. F2.
                   |         ^^^ warning[feed-implausible] feed of 2 mm per turn of the spindle (`F`)
            "#]],
        );
        // The feed of the approach stays on.
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", "G0 X60. Z5.\nG1 X36. Z1. F3.\nZ-20."),
            &expect![[r#"
                11 | G1 X36. Z1. F3.
                   |             ^^^ warning[feed-implausible] feed of 3 mm per turn of the spindle (`F`)
            "#]],
        );
    }

    #[test]
    fn units_that_the_program_does_not_state() {
        let program =
            |feed: &str| format!("G99 T0101\nG97 S800 M3\nG0 X42. Z1.\nG1 Z-30. F{feed}\nX44.\nM30\n");
        // Where they are inches, it is plausible as millimetres.
        check_rule(&RULE, "haas-lathe", &program(".15"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-lathe",
            &program("4."),
            &expect![[r#"
            4 | G1 Z-30. F4.
              |          ^^^ warning[feed-implausible] feed of 4 in per turn of the spindle (`F`)
        "#]],
        );
    }

    #[test]
    fn a_lost_point_is_told_as_that() {
        check_rule(&RULE, "haas-mill", "G20 G90 G94 S900 M3\nG1 X1. F10\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_feed_of_the_other_mode_is_told_as_that() {
        check_rule(&RULE, "generic-mill", "G21 G90 S900 M3\nG1 X1. F300.\nG95\nX2.\nM30\n", &expect![[""]]);
    }
}
