//! A threading cycle whose height does not belong to the thread that a comment names.

use gcheck_engine::{At, Fact};
use gcheck_geometry::Mm;
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::thread_cycles::{is_cycle, length, words, written};
use crate::facts::threads::{Thread, named_thread, trimmed};
use crate::{Finding, FollowedCx, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A comment names a thread, the cycle cuts its pitch, and the height that the cycle is given belongs to another pitch.
    ///
    /// The height of a metric thread or of an inch thread is 0.613 of its pitch outside, and 0.541 in a bore. Less than 0.45 and more than 0.9
    /// is reported. A lead of several pitches belongs to a thread of several starts, which is not judged.
    ///
    /// ## Why it matters
    /// With too small a height no nut goes on the thread, and with too large a one the insert cuts the thread away and the first passes are
    /// too deep. Often the height was given on the diameter, or the other way round.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99
    /// (THREAD M30X1.5)
    /// T0404
    /// G97 S600 M3
    /// G0 X34. Z6.
    /// G76 P010060 Q80 R0.04
    /// G76 X29.08 Z-20. P460 Q200 F1.5
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99
    /// (THREAD M30X1.5)
    /// T0404
    /// G97 S600 M3
    /// G0 X34. Z6.
    /// G76 P010060 Q80 R0.04
    /// G76 X28.16 Z-20. P920 Q200 F1.5
    /// M30
    /// ```
    rule "thread-height-off-pitch" in "cycles" {
        summary: "height of a threading cycle that is not that of the named thread",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::FOLLOWED),
            make: || Box::new(ThreadHeightOffPitch::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ThreadHeightOffPitch {
    /// What is reported unless a later cycle of the same thread has the right height: then this one roughs.
    found: Vec<Found>,
}

remembers!(ThreadHeightOffPitch: found);

/// A cycle of another height.
#[derive(Clone, PartialEq)]
struct Found {
    /// The block that put its tool in.
    tool: Option<At>,
    /// The block that names the thread.
    named: At,
    finding: Finding,
}

remembers!(Found: tool, named, finding);

/// Heights of threads of 60°, as parts of their pitch: 0.541 and 0.613, and what shops make of them.
const HEIGHTS: std::ops::RangeInclusive<f64> = 0.45..=0.9;
/// For pitches that were rounded, as a part of them.
const ROUNDED: f64 = 0.006;
/// Findings that are kept.
const MOST: usize = 64;

impl PathRule for ThreadHeightOffPitch {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_cycle)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if !cx.has_effect(is_cycle) || cx.is_malformed() || cx.depth() > 1 || self.found.len() >= MOST {
            return;
        }
        let Some(words) = words(cx).filter(|words| !words.height.is_computed()) else { return };
        let lengths = length(cx, &words.height).zip(words.lead.as_ref().and_then(|lead| length(cx, lead)));
        let Some((height, lead)) = lengths else { return };
        let tool = cx.definitions().set_by(Fact::Tool);
        // A thread that only the title names may be another one of the part.
        let Some((thread, false)) = named_thread(cx, tool) else { return };
        if (lead - thread.pitch).abs() > thread.pitch * ROUNDED {
            return;
        }
        if HEIGHTS.contains(&(height / thread.pitch)) {
            self.found.retain(|found| found.tool != tool || found.named != thread.at);
        } else {
            let finding = finding(cx, &words.height, height, &thread);
            self.found.extend(finding.map(|finding| Found { tool, named: thread.at, finding }));
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        for found in std::mem::take(&mut self.found) {
            report.add(found.finding);
        }
    }
}

fn finding(cx: &PathCx<'_>, word: &Word, height: f64, thread: &Thread) -> Option<Finding> {
    let right = |part: f64| written(cx, word, thread.pitch * part);
    let letter = word.letter;
    let message =
        format!("the thread is {} high, for a pitch of {}", cx.shown(Mm(height)), cx.shown(Mm(thread.pitch)));
    let finding = cx
        .finding(&META, cx.word_range(|word| word.letter == letter), message)
        .label(format!("{} of the pitch", trimmed((height / thread.pitch * 100.0).round() / 100.0)))
        .note("the height goes from the crest to the root, on the radius")
        .help(format!("check `{letter}`: {} outside, {} in a bore", right(0.613)?, right(0.541)?));
    Some(match cx.range_of(thread.at) {
        Some(range) => finding.also(range, format!("names the thread: {}", thread.name)),
        None => finding,
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn spool(height: &str) -> String {
        format!(
            "; T2 thread M26 x 1.5\nG21 G7 G90 G95 G97 S600 M3\nT2 M6\nG43\nG0 X28 Z4\nG76 P1.5 Z-16 I-2 J0.3 R1.5 K{height} Q29.5 H2\nM2\n"
        )
    }

    #[test]
    fn a_height_of_a_diameter_is_given_as_one() {
        check_rule(&RULE, "linuxcnc", &spool("1.84"), &expect![[""]]);
        check_rule(
            &RULE,
            "linuxcnc",
            &spool("0.92"),
            &expect![[r#"
                6 | G76 P1.5 Z-16 I-2 J0.3 R1.5 K0.92 Q29.5 H2
                  |                             ^^^^^ warning[thread-height-off-pitch] the thread is 0.46 mm high, for a pitch of 1.5 mm
            "#]],
        );
    }

    #[test]
    fn turns_to_the_inch_name_a_pitch() {
        let program = |height: &str| {
            format!(
                "(T4 THREAD 12 TPI)\nG20 G99 T404\nG97 S800 M3\nG0 X1.7 Z0.3\nG76 X1.3978 Z-0.9 K{height} D0.0122 F0.083333\nM30\n"
            )
        };
        check_rule(&RULE, "haas-lathe", &program("0.0511"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-lathe",
            &program("0.0911"),
            &expect![[r#"
            5 | G76 X1.3978 Z-0.9 K0.0911 D0.0122 F0.083333
              |                   ^^^^^^^ warning[thread-height-off-pitch] the thread is 0.0911 in high, for a pitch of 0.0833 in
        "#]],
        );
    }

    #[test]
    fn several_starts_are_not_judged() {
        let program = "G21 G99\n(THREAD M30X1.5)\nT0404\nG97 S600 M3\nG0 X34. Z6.\nG76 P010060 Q80 R0.04\nG76 X28.16 Z-20. P460 Q200 F3.\nM30\n";
        check_rule(&RULE, "fanuc-lathe", program, &expect![[""]]);
    }

    #[test]
    fn roughed_and_finished_by_two_cycles() {
        let program = |rest: &str| {
            format!(
                "G21 G18 G99\nT0404 (THREAD M30X1.5)\nG97 S900 M3\nG0 X34. Z5.\nG76 P020060 Q100 R.05\nG76 X28.8 Z-25. P600 Q300 F1.5\n{rest}M30\n"
            )
        };
        let finish = "G76 P020060 Q100 R.05\nG76 X28.16 Z-25. P920 Q300 F1.5\n";
        check_rule(&RULE, "fanuc-lathe", &program(finish), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program(""),
            &expect![[r#"
                6 | G76 X28.8 Z-25. P600 Q300 F1.5
                  |                 ^^^^ warning[thread-height-off-pitch] the thread is 0.6 mm high, for a pitch of 1.5 mm
            "#]],
        );
    }
}
