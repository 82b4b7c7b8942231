//! A spindle speed above the configured limit of the machine.

use gcheck_controls::{CodeIx, Effect};
use gcheck_engine::{Abstract, Domain, Event, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A spindle speed (`S`), or the limit of the speed under constant surface speed (`G50 S`, `G96 D`), is above the configured
    /// highest speed of the machine.
    ///
    /// ## Why it matters
    /// The control runs slower than the program says, so that the feed no longer fits, or stops with an alarm. A limit above
    /// that of the machine limits nothing: near the centre the chuck turns as fast as it can.
    ///
    /// ## Reported
    /// On a machine with 8000 turns a minute:
    /// ```nc,reported,haas-mill
    /// S12000 M3
    /// M30
    /// ```
    /// ```nc,reported,fanuc-lathe
    /// G50 S9000
    /// G96 S200 M3
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// S8000 M3
    /// M30
    /// ```
    /// Under constant surface speed `S` is not a spindle speed.
    /// ```nc,quiet,fanuc-lathe
    /// G50 S3000
    /// G96 S9000 M3
    /// M30
    /// ```
    /// ## How to fix it
    /// * Lower the speed, or the limit under constant surface speed, to what spindle, chuck and part may turn.
    /// * If the spindle turns faster, correct `max_rpm` under `[machine]`.
    rule "speed-above-machine-limit" in "machine" {
        summary: "spindle speed above the machine's limit",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::BLOCKS),
            make: || Box::new(SpeedAboveMachineLimit),
        },
    }
}

struct SpeedAboveMachineLimit;

impl PathRule for SpeedAboveMachineLimit {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.machine.engine.max_rpm.is_some()
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let (Some(highest), Some(letter)) = (cx.environment.machine.engine.max_rpm, limit_word(cx)) else {
            return;
        };
        let Some(limit) = cx.known_number(letter).map(f64::abs).filter(|limit| *limit > highest.0) else {
            return;
        };
        report.add(
            cx.finding(
                &META,
                cx.letter_range(letter),
                format!("speed limit of {limit:.0} rpm is above the machine's {:.0} rpm (`{letter}`)", highest.0),
            )
            .label("this limits nothing")
            .help("lower the limit to what chuck and part may turn, or correct the machine's in the configuration"),
        );
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let (Event::SpindleSpeed(_), Some(highest)) = (event, cx.environment.machine.engine.max_rpm) else {
            return;
        };
        let state = cx.state();
        let mode = state.mode(Role::SpindleMode);
        // `S` and the mode may be in one block, in either order.
        let is_surface = |effect| effect == Effect::SurfaceSpeed;
        let is_constant = mode.only().is_some_and(|code| !is_surface(cx.model.effect(code)));
        if !is_constant || cx.has_effect(is_surface) {
            return;
        }
        let Some((lowest, _)) = Abstract::bounds(state.speed()) else { return };
        if lowest <= highest.0 {
            return;
        }
        report.add(
            cx.finding(
                &META,
                cx.letter_range('S'),
                format!("speed of {lowest:.0} rpm is above the machine's {:.0} rpm (`S`)", highest.0),
            )
            .label("above the configured highest speed")
            .help("lower the speed, or correct the limit in the configuration"),
        );
    }
}

/// The word of the block that limits the speed under constant surface speed.
fn limit_word(cx: &PathCx<'_>) -> Option<char> {
    if cx.has_effect(|effect| effect == Effect::SpeedLimitOrSetPosition) {
        return Some('S');
    }
    let reads_d = |code: &CodeIx| {
        cx.model.effect(*code) == Effect::SurfaceSpeed
            && cx.code_of(*code).is_some_and(|code| code.entry().words.iter().any(|word| word.letter == "D"))
    };
    cx.codes().iter().any(reads_d).then_some('D')
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn the_word_is_marked() {
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G21 S5000 M3\nS8001\nS#1\nM2\n",
            &World::of_examples(&META),
            &expect![[r#"
                2 | S8001
                  | ^^^^^ warning[speed-above-machine-limit] speed of 8001 rpm is above the machine's 8000 rpm (`S`)
            "#]],
        );
    }

    #[test]
    fn surface_speed_given_in_one_block_is_no_turning_speed() {
        check_rule_in(
            &RULE,
            "fanuc-lathe",
            "S9000 G96 M3\nG97 S9000\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                2 | G97 S9000
                  |     ^^^^^ warning[speed-above-machine-limit] speed of 9000 rpm is above the machine's 8000 rpm (`S`)
            "#]],
        );
    }

    #[test]
    fn a_limit_in_the_block_of_the_mode() {
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G96 D9000 S300 M3\nG96 D7000 S300\nM2\n",
            &World::of_examples(&META),
            &expect![[r#"
                1 | G96 D9000 S300 M3
                  |     ^^^^^ warning[speed-above-machine-limit] speed limit of 9000 rpm is above the machine's 8000 rpm (`D`)
            "#]],
        );
        check_rule_in(
            &RULE,
            "fanuc-lathe",
            "G50 S7000\nG50 X0. Z0.\nG50 S#1\nG50 S8500\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                4 | G50 S8500
                  |     ^^^^^ warning[speed-above-machine-limit] speed limit of 8500 rpm is above the machine's 8000 rpm (`S`)
            "#]],
        );
    }

    #[test]
    fn nothing_configured_nothing_said() {
        check_rule(&RULE, "haas-mill", "S90000 M3\nM30\n", &expect![[""]]);
    }
}
