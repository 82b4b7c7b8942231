//! A tap that is not fed by its pitch each turn.

use gcheck_controls::Letter;
use gcheck_engine::{Abstract, At, Domain, Fact, FeedMode, Role, Units};

use crate::declare::declare_rule;
use crate::facts::boundary::is_before;
use crate::facts::cycles::is_tapping;
use crate::facts::threads::{
    Thread, Wanted, rounding, thread_in_block, thread_in_list, thread_of_tool, trimmed,
};
use crate::facts::units;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The feed per turn of a tapping cycle is not the pitch of the thread that a comment names: the comment of the cycle's
    /// own block, the one at the tool change, or the entry of the tool in a list at the head of the program.
    ///
    /// A little less than the pitch is accepted, for tension-compression holders. More is accepted only within the
    /// rounding of the feed.
    ///
    /// ## Why it matters
    /// A tap pulls itself in by its pitch. With another feed it tears the thread out, pulls out of its holder or
    /// breaks. The feed per minute is the speed times the pitch; the feed per turn is the pitch.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T5 M6 (M6X1 TAP)
    /// G21 G90 G54 G0 X0. Y0.
    /// S500 M3
    /// G43 H5 Z10.
    /// G84 Z-12. R5. F600.
    /// G80
    /// M30
    /// ```
    /// The tap runs at the speed of the drill before it.
    /// ```nc,reported,haas-mill
    /// T4 M6 (5.1 DRILL)
    /// G20 G90 G54 G0 X0. Y0. S3000 M3
    /// G43 H4 Z1.
    /// G83 Z-.8 R.1 Q.2 F15.
    /// G80
    /// T5 M6 (1/4-20 TAP)
    /// G0 X0. Y0. M3
    /// G43 H5 Z1.
    /// G84 Z-.5 R.2 F30.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// A tension-compression holder is fed a little short.
    /// ```nc,quiet,haas-mill
    /// T5 M6 (M6X1 TAP)
    /// G21 G90 G54 G0 X0. Y0.
    /// S500 M3
    /// G43 H5 Z10.
    /// G84 Z-12. R5. F490.
    /// G80
    /// M30
    /// ```
    rule "tapping-feed-off-pitch" in "cycles" {
        summary: "tap fed by another distance per turn than its pitch",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(TappingFeedOffPitch { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct TappingFeedOffPitch {
    /// The tool change whose tool was reported.
    told: Option<At>,
}

remembers!(TappingFeedOffPitch: told);

/// A tension-compression holder is fed short by a few per cent.
const SHORT: f64 = 0.93;
/// For pitches that were rounded before the feed was computed from them.
const LONG: f64 = 1.006;

impl PathRule for TappingFeedOffPitch {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_tapping)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(is_tapping) || cx.depth() > 1 {
            return;
        }
        let Some(changed) = cx.definitions().set_by(Fact::Tool) else { return };
        let state = cx.state();
        let given = |letter: char, before: Option<f64>| {
            if cx.origin().letters.contains(Letter::of(letter)) { cx.known_number(letter) } else { before }
        };
        let feed = given('F', Abstract::known(state.feed_word()));
        let speed = given('S', Abstract::known(state.speed()));
        let (Some(feed), Some(speed), Some(units)) = (feed, speed, state.units(cx.model)) else { return };
        // A mode in the block itself, and a feed from before a change of modes, are not what the state holds.
        let is_switched = cx.code_of_role(Role::FeedMode).is_some() || cx.code_of_role(Role::Units).is_some();
        let is_older = |fact| cx.definitions().set_by(fact).is_some_and(|at| is_before(at, changed));
        let by_turns = state.feed_mode(cx.model) == Some(FeedMode::PerRevolution);
        let is_carried = !by_turns && is_older(Fact::Speed) && !cx.origin().letters.contains(Letter::of('S'));
        if self.told == Some(changed) || is_switched || feed <= 0.0 || speed <= 0.0 {
            return;
        }
        let a_turn = match state.feed_mode(cx.model) {
            Some(FeedMode::PerMinute) => feed / speed,
            Some(FeedMode::PerRevolution) => feed,
            _ => return,
        } * units.in_mm();
        let Some(thread) = thread_of_tap(cx, changed) else { return };
        let pitch = gcheck_geometry::Mm(thread.pitch);
        let right = if by_turns { thread.pitch } else { thread.pitch * speed } / units.in_mm();
        let is_rounded = (feed - right).abs() <= rounding(feed);
        if is_rounded || (SHORT..=LONG).contains(&(a_turn / thread.pitch)) {
            return;
        }
        // A program without units has its feed in those that fit the pitch.
        let are_written = units::are_stated(cx);
        let in_others = a_turn / units.in_mm() * other(units).in_mm() / thread.pitch;
        if !are_written && (SHORT..=LONG).contains(&in_others) {
            return;
        }
        self.told = Some(changed);
        let right = trimmed(right);
        let message = format!(
            "the tap is fed {} per turn, and the pitch is {}",
            cx.shown(gcheck_geometry::Mm(a_turn)),
            cx.shown(pitch)
        );
        let mut finding = if is_carried {
            let speed = format!("the tap turns at the speed of the tool before (`S{}`)", trimmed(speed));
            cx.finding(&META, cx.effect_range(is_tapping), speed)
        } else {
            cx.finding(&META, cx.letter_range('F'), message.clone())
        };
        if is_carried {
            let turns = (feed * units.in_mm() / thread.pitch).round();
            finding = finding
                .label(format!("no `S` since the tool change; the feed belongs to `S{turns}`"))
                .note(message)
                .help("give the speed of the tap (`S`) after the tool change");
            if let Some(given) =
                cx.definitions().set_by(Fact::Speed).and_then(|at| cx.find_word(at, is_speed))
            {
                finding = finding.also(given, "the last speed, from before the tool change");
            }
        } else {
            finding = finding
                .label(format!(
                    "`F{right}` for this pitch{}",
                    if by_turns { String::new() } else { format!(" at `S{}`", trimmed(speed)) }
                ))
                .help("give the feed that belongs to speed and pitch, or correct the comment");
        }
        if let Some(range) = cx.range_of(thread.at) {
            finding = finding.also(range, format!("names the thread: {}", thread.name));
        }
        report.add(finding);
    }
}

/// The thread that the block, the tool or the list of tools names.
fn thread_of_tap(cx: &PathCx<'_>, changed: At) -> Option<Thread> {
    thread_in_block(cx, cx.origin().at, Wanted::Written)
        .or_else(|| thread_of_tool(cx, changed, Wanted::Tap))
        // A pitch that is written needs no word that it is a tap.
        .or_else(|| thread_of_tool(cx, changed, Wanted::Written))
        .or_else(|| thread_in_list(cx, Wanted::Tap))
}

fn is_speed(word: &gcheck_program::Word) -> bool {
    word.letter == Letter::of('S')
}

/// Inches for millimetres, and millimetres for inches.
fn other(units: Units) -> Units {
    match units {
        Units::Inch => Units::Mm,
        Units::Mm => Units::Inch,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn feed_a_turn_is_the_pitch() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "(1/4-20 TAP)\nT5 M6\nG20 G90 G54 G0 X0. Y0.\nG95 S500 M3\nG84 Z-1. R.1 F.05\nG80\nM30\n",
            &expect![[""]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            "(1/4-20 TAP)\nT5 M6\nG20 G90 G54 G0 X0. Y0.\nG94 S500 M3\nG84 Z-1. R.1 F.05\nG80\nM30\n",
            &expect![[r#"
                5 | G84 Z-1. R.1 F.05
                  |              ^^^^ warning[tapping-feed-off-pitch] the tap is fed 0.0001 in per turn, and the pitch is 0.05 in
            "#]],
        );
    }

    #[test]
    fn without_units_the_feed_is_in_those_that_fit_the_pitch() {
        let program = |units: &str, feed: &str| {
            format!(
                "(M3X0.5 FORM TAP)\nM6 T15\nG90 G54 {units}G0 X0. Y0.\nG95 S300 M3\nG84 Z-1. R.1 {feed}\nG80\nM30\n"
            )
        };
        check_rule(&RULE, "fanuc-mill", &program("", "F0.019685"), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("", "F0.5"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("", "F0.03"),
            &expect![[r#"
                5 | G84 Z-1. R.1 F0.03
                  |              ^^^^^ warning[tapping-feed-off-pitch] the tap is fed 0.03 mm per turn, and the pitch is 0.5 mm
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G21 ", "F0.019685"),
            &expect![[r#"
                5 | G84 Z-1. R.1 F0.019685
                  |              ^^^^^^^^^ warning[tapping-feed-off-pitch] the tap is fed 0.02 mm per turn, and the pitch is 0.5 mm
            "#]],
        );
    }

    #[test]
    fn the_list_at_the_head_names_the_thread() {
        let program = |feed: &str| {
            format!(
                "O1\n(T3 5 MM DRILL)\n(T4 M6 TAP)\nT4 M6\nG21 G90 G54 G0 X0. Y0.\nS300 M3\nG84 Z-9. R3. F{feed}\nG80\nM30\n"
            )
        };
        check_rule(&RULE, "haas-mill", &program("300."), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &program("307."),
            &expect![[r#"
            7 | G84 Z-9. R3. F307.
              |              ^^^^^ warning[tapping-feed-off-pitch] the tap is fed 1.023 mm per turn, and the pitch is 1 mm
        "#]],
        );
        let list = "; T1 drill, T2 M6 tap, T3 M8 tap\nT2 M6\nG21 G90 G54 G0 X0 Y0\nS300 M3\nG84 Z-9 R3 F400\nG80\nM2\n";
        check_rule(
            &RULE,
            "linuxcnc",
            list,
            &expect![[r#"
            5 | G84 Z-9 R3 F400
              |            ^^^^ warning[tapping-feed-off-pitch] the tap is fed 1.333 mm per turn, and the pitch is 1 mm
        "#]],
        );
    }

    #[test]
    fn a_feed_that_was_rounded_belongs_to_the_pitch() {
        let program = |feed: &str| {
            format!("T4 M6 (5/16-18 TAP)\nG20 G90 G54 G0 X0. Y0.\nS480 M3\nG84 Z-.9 R.2 F{feed}\nG80\nM30\n")
        };
        for feed in ["26.667", "26.67", "26.7", "27."] {
            check_rule(&RULE, "haas-mill", &program(feed), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "haas-mill",
            &program("27.5"),
            &expect![[r#"
                4 | G84 Z-.9 R.2 F27.5
                  |              ^^^^^ warning[tapping-feed-off-pitch] the tap is fed 0.0573 in per turn, and the pitch is 0.0556 in
            "#]],
        );
    }

    #[test]
    fn the_speed_of_the_tool_before_stays() {
        let program = |speed: &str, feed: &str| {
            format!(
                "G21 G90 G54 S3000 M3\nT5 M6 (M6 TAP)\nG0 X0. Y0.\n{speed}G84 Z-12. R5. F{feed}\nG80\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program("", "500."),
            &expect![[r#"
                4 | G84 Z-12. R5. F500.
                  | ^^^ warning[tapping-feed-off-pitch] the tap turns at the speed of the tool before (`S3000`)
            "#]],
        );
        check_rule(&RULE, "haas-mill", &program("S500\n", "500."), &expect![[""]]);
        // Both are from before; a speed that a variable gives.
        check_rule(&RULE, "haas-mill", &program("", "3000."), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("S#500\n", "500."), &expect![[""]]);
        // Feed per turn needs no speed.
        check_rule(&RULE, "fanuc-mill", &program("G95\n", "1."), &expect![[""]]);
        let found = findings(&only(&RULE), "haas-mill", &program("", "500."), &World::default());
        expect![[r#"
            the tap turns at the speed of the tool before (`S3000`)
              here: no `S` since the tool change; the feed belongs to `S500`
              there: the last speed, from before the tool change
              there: names the thread: M6
              note: the tap is fed 0.167 mm per turn, and the pitch is 1 mm
              help: give the speed of the tap (`S`) after the tool change
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn the_cycles_own_comment_names_the_thread() {
        let program = |feed: &str, comment: &str| {
            format!(
                "T5 M6 (TAP)\nG20 G90 G54 G0 X0. Y0.\nG94 S600 M3\nG84 Z-1. R.1 F{feed} {comment}\nG80\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program("1.5", "(1/4-20)"),
            &expect![[r#"
            4 | G84 Z-1. R.1 F1.5 (1/4-20)
              |              ^^^^ warning[tapping-feed-off-pitch] the tap is fed 0.0025 in per turn, and the pitch is 0.05 in
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program("30.", "(1/4-20)"), &expect![[""]]);
        // A depth, and a hole that is tapped elsewhere.
        check_rule(&RULE, "haas-mill", &program("1.5", "(TAP 3/4 DEEP)"), &expect![[""]]);
    }
}
