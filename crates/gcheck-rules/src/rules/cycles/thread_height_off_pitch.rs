//! A threading cycle whose height does not belong to the thread that a comment names.

use gcheck_engine::{At, Event, Fact, TravelKind};
use gcheck_geometry::Mm;
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::thread_cycles::{is_cycle, length, words, written};
use crate::facts::thread_passes::{Pass, ThreadPasses, cuts_pass};
use crate::facts::threads::{Thread, named_thread, trimmed};
use crate::facts::turning::shown_radius;
use crate::{Finding, FollowedCx, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A comment names a thread, the cycle cuts its pitch, and the height that the cycle is given belongs to another pitch.
    ///
    /// The height of a metric thread or of an inch thread is 0.613 of its pitch outside, and 0.541 in a bore. Less than 0.45 and more than 0.9
    /// is reported. A lead of several pitches belongs to a thread of several starts, which is not judged.
    ///
    /// Passes that a program gives one by one (`G92`, `G32`) are reported where they go deeper than 0.9 of the pitch under the diameter that
    /// the comment names.
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
            watch: Watch::BLOCKS.union(Watch::MOVES).union(Watch::CHANGES).union(Watch::FOLLOWED),
            make: || Box::new(ThreadHeightOffPitch::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ThreadHeightOffPitch {
    /// What is reported unless a later cycle of the same thread has the right height: then this one roughs.
    found: Vec<Found>,
    passes: ThreadPasses,
    /// The tool whose passes were reported.
    told: Option<At>,
    /// The tool whose passes come now, and where those of its first thread end: whole micrometres.
    first: Option<At>,
    first_end: i64,
}

remembers!(ThreadHeightOffPitch: found, passes, told, first);

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
/// Radii that differ by less are one: millimetres.
const STRAIGHT: f64 = 0.001;
/// Passes that are deeper by so many pitches are of another thread.
const MUCH: f64 = 2.5;
/// Findings that are kept.
const MOST: usize = 64;

impl PathRule for ThreadHeightOffPitch {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_cycle) || program.may(cuts_pass)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.passes.see(event);
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if !matches!(event, Event::Travel(travel) if travel.kind == TravelKind::Thread)
            || cx.has_effect(is_cycle)
        {
            return;
        }
        if let Some((before, pass)) = self.passes.pass(cx, event) {
            self.pass(cx, &before, &pass, report);
        }
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

impl ThreadHeightOffPitch {
    /// A pass that is given by itself, after another one of the thread.
    fn pass(&mut self, cx: &PathCx<'_>, before: &Pass, pass: &Pass, report: &mut Report<'_>) {
        let [start, end] = pass.x;
        let is_straight = (start - end).abs() < STRAIGHT;
        let goes_in = end < before.x[1] - STRAIGHT && end > 0.0;
        let tool = cx.definitions().set_by(Fact::Tool);
        #[expect(clippy::cast_possible_truncation, reason = "a length of a machine in micrometres")]
        let along = (pass.z[1] * 1_000.0).round() as i64;
        if self.first != tool {
            (self.first, self.first_end) = (tool, along);
        }
        // The comment names one thread, and this may be another.
        if self.first_end != along {
            return;
        }
        if !is_straight || !goes_in || tool.is_none() || self.told == tool || cx.depth() > 1 {
            return;
        }
        let Some((thread, false)) = named_thread(cx, tool) else { return };
        let Some(crest) = thread.crest().map(|crest| crest / 2.0) else { return };
        let height = (crest - end) / thread.pitch;
        if (pass.lead - thread.pitch).abs() > thread.pitch * ROUNDED
            || !(*HEIGHTS.end()..MUCH).contains(&height)
        {
            return;
        }
        self.told = tool;
        let root = shown_radius(cx, crest - 0.613 * thread.pitch);
        let finding = cx
            .finding(
                &META,
                cx.letter_range('X'),
                format!("the pass goes deeper than {} is high", thread.name),
            )
            .label(format!(
                "{} under the diameter of the thread, {} of its pitch",
                cx.shown(Mm(crest - end)),
                trimmed((height * 100.0).round() / 100.0)
            ))
            .note("a thread of 60 degrees is 0.613 of its pitch high, on the radius")
            .help(format!("check the digits of `X`: the root of the thread is near X {root}"));
        report.add(match cx.range_of(thread.at) {
            Some(range) => finding.also(range, format!("names the thread: {}", thread.name)),
            None => finding,
        });
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
    fn passes_one_by_one() {
        let program = |comment: &str, last: &str| {
            format!(
                "G21 G99\nT0404 ({comment})\nG97 S700 M3\nG0 X24. Z5.\nG92 X19.2 Z-18. F1.5\nX18.7\nX18.4\n{last}\nG0 X50. Z50.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("M20X1.5", "X17.2\nX17.16"),
            &expect![[r#"
                8 | X17.2
                  | ^^^^^ warning[thread-height-off-pitch] the pass goes deeper than M20X1.5 is high
            "#]],
        );
        for (comment, last) in [
            ("M20X1.5", "X18.2\nX18.16"),
            ("M20X1.5", "X18.05"),
            ("THREAD", "X17.2"),
            // A thread in a bore, and one of two starts.
            ("M20X1.5", "X19.8"),
            ("M20X0.75", "X17.2"),
            // A smaller thread in front of it.
            ("M20X1.5", "X18.16\nG0 X20. Z5.\nG92 X17.4 Z-8. F1.5\nX16.8"),
        ] {
            check_rule(&RULE, "fanuc-lathe", &program(comment, last), &expect![[""]]);
        }
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
