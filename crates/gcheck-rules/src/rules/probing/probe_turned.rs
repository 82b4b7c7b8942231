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

/// Is the comment the name of a probe, and nothing else? Of a cutter it may say what to do with the probe: `PROBE TOOL`,
/// `MEASURE AFTER PROBE`.
fn is_probe(comment: &ToolComment) -> bool {
    const PROBES: [&str; 4] = ["PROBE", "TOUCHPROBE", "TASTER", "MESSTASTER"];
    // What belongs to the name: its kind, its stylus, what posts list of every tool.
    const BESIDE: [&str; 14] = [
        "TOUCH", "SPINDLE", "RENISHAW", "WIPS", "3D", "WORK", "BALL", "RUBY", "STYLUS", "TIP", "MM", "D",
        "CR", "ZMIN",
    ];
    let begins = |names: &[&str], word: &str| names.iter().any(|name| word.starts_with(name));
    let is_type =
        |word: &str| begins(&["OMP", "RMP", "OMI", "MP"], word) && word.bytes().any(|b| b.is_ascii_digit());
    let is_size = |word: &str| {
        word.trim_start_matches(['T', 'D', 'R']).trim_end_matches("MM").bytes().all(|b| b.is_ascii_digit())
    };
    let words = || comment.words.iter().map(String::as_str);
    // `PROBE WORK` says what to do.
    let is_order = words().zip(words().skip(1)).any(|(one, next)| PROBES.contains(&one) && next == "WORK");
    words().any(|word| PROBES.contains(&word) || is_type(word))
        && !is_order
        && words()
            .all(|word| PROBES.contains(&word) || BESIDE.contains(&word) || is_type(word) || is_size(word))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

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
    fn names_of_probes() {
        for comment in [
            "RENISHAW OMP40",
            "OMP40",
            "WIPS PROBE",
            "6MM PROBE",
            "PROBE 6MM BALL",
            "TOUCH PROBE D6",
            "D=6. CR=3. - ZMIN=-5. - PROBE",
            "WORK PROBE T20",
        ] {
            let program = format!("T20 M6 ({comment})\nG54 G0 X0. Y0.\nG43 H20 Z2.\nS3500 M3\nM30\n");
            assert_eq!(
                findings(&only(&RULE), "haas-mill", &program, &World::default()).len(),
                1,
                "{comment}"
            );
        }
    }

    #[test]
    fn a_cutter_whose_comment_speaks_of_the_probe() {
        for comment in [
            "SPOTDRILL - THEN PROBE",
            "BORING BAR - PROBE SIZE",
            "PROBE TOOL LENGTH",
            "PROBE TOOL",
            "PROBE TOOL 1",
            "PROBE WORK",
        ] {
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
