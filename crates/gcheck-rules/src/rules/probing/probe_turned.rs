//! A spindle that is started with a touch probe in it.

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, Domain};

use crate::declare::declare_rule;
use crate::facts::tool_comment::{ToolComment, comment_at_work};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// The spindle is started (`M3`, `M4`), and the tool in it is a touch probe by its comment.
    ///
    /// Up to 1,000 turns a minute nothing is reported: some probes are switched on by turning.
    ///
    /// ## Why it matters
    /// The stylus bends out and breaks, and the probe flies from its taper or is lost with its transmitter. Mostly the tool change to
    /// the cutter is missing.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T20 M6 (SPINDLE PROBE)
    /// G54 G0 X0. Y0.
    /// G43 H20 Z2.
    /// S3500 M3
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T20 M6 (SPINDLE PROBE)
    /// G54 G0 X0. Y0.
    /// G43 H20 Z2.
    /// T1 M6 (2. FACE MILL)
    /// S3500 M3
    /// M30
    /// ```
    rule "probe-turned" in "probing" {
        summary: "spindle started with a touch probe in it",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(ProbeTurned) },
    }
}

struct ProbeTurned;

/// Turns a minute that a probe may be switched on with.
const SLOW: f64 = 1000.0;

impl PathRule for ProbeTurned {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::starts_spindle)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(Effect::starts_spindle) || !cx.is_certain() {
            return;
        }
        let speed = cx.known_number('S').or_else(|| Abstract::known(cx.state().speed()));
        let Some(speed) = speed.filter(|speed| *speed > SLOW) else { return };
        // A change in the block itself puts another tool in.
        if cx.has_effect(|effect| effect == Effect::ToolChange) {
            return;
        }
        let Some(comment) = comment_at_work(cx).filter(|comment| is_probe(comment)) else { return };
        let message =
            format!("the spindle is started with a touch probe in it, at {speed:.0} turns a minute");
        let mut finding = cx.finding(&META, cx.effect_range(Effect::starts_spindle), message);
        if let Some(range) = cx.range_of(comment.at) {
            finding = finding.also(range, "names the tool");
        }
        report.add(
            finding
                .label("the tool in the spindle is a probe")
                .help("change to the cutter first, or leave the spindle off"),
        );
    }
}

/// Is the comment the name of a probe, and nothing else? Of a cutter it may say what to do with the probe.
fn is_probe(comment: &ToolComment) -> bool {
    const NAMES: [&str; 8] = ["PROBE", "TOUCHPROBE", "TOUCH", "SPINDLE", "RENISHAW", "TOOL", "3D", "WORK"];
    let is_type = |word: &str| ["OMP", "RMP", "OMI", "MP"].iter().any(|name| word.starts_with(name));
    let is_number = |word: &str| word.trim_start_matches('T').bytes().all(|byte| byte.is_ascii_digit());
    let is_name = |word: &String| NAMES.contains(&word.as_str()) || is_type(word) || is_number(word);
    comment.has(&["PROBE", "TOUCHPROBE"]) && comment.words.iter().all(is_name)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn slowly_it_may_be_switched_on() {
        let program = |speed: &str| format!("T20 M6 (PROBE)\nG54 G0 X0. Y0.\nG43 H20 Z2.\n{speed} M3\nM30\n");
        check_rule(
            &RULE,
            "haas-mill",
            &program("S3500"),
            &expect![[r#"
            4 | S3500 M3
              |       ^^ warning[probe-turned] the spindle is started with a touch probe in it, at 3500 turns a minute
        "#]],
        );
        for speed in ["S500", "S1000", "S#100"] {
            check_rule(&RULE, "haas-mill", &program(speed), &expect![[""]]);
        }
    }

    #[test]
    fn a_cutter_whose_comment_speaks_of_the_probe() {
        for comment in ["SPOTDRILL - THEN PROBE", "BORING BAR - PROBE SIZE", "PROBE TOOL LENGTH"] {
            let program = format!("T1 M6 ({comment})\nG54 G0 X0. Y0.\nG43 H1 Z2.\nS3500 M3\nM30\n");
            check_rule(&RULE, "haas-mill", &program, &expect![[""]]);
        }
    }

    #[test]
    fn the_next_tool_is_in_the_spindle() {
        check_rule(
            &RULE,
            "haas-mill",
            "T20 M6 (PROBE)\nG43 H20 Z2.\nT1 M6\n(MILL AFTER PROBE)\nS3500 M3\nM30\n",
            &expect![[""]],
        );
    }
}
