//! A thread that is cut with another lead than the pitch of the thread that a comment names.

use std::collections::BTreeSet;

use gcheck_controls::{Effect, LetterSet, Unpointed};
use gcheck_engine::{At, Fact, Units};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cutting::is_thread;
use crate::facts::threads::{named_thread, trimmed};
use crate::facts::units;
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The lead of a thread (`F` of `G32`, `G92` and `G76` on lathes, `K` of `G33` and `G33.1`) is not the pitch of the thread
    /// that a comment names: the comment of the block, of its operation or its tool, or the title of the program.
    ///
    /// The comment has to give the pitch (`M20X1.5`, `1/2-13`); of a tap its size is enough (`M6 TAP`), which stands for the coarse
    /// pitch unless the comment gives another number. One nearer to the cut that names a thread in another form (`G3/4`) counts
    /// before the others, and nothing is reported. The title counts where the program cuts all its threads with one lead.
    /// Threads of several starts are not looked at: those whose comment says so (`2 START`, `DOUBLE LEAD`, `TWIN`), and those with
    /// an angle for the start (`Q`) and a lead of some pitches.
    ///
    /// ## Why it matters
    /// The thread has another pitch than the nut: the part is scrap. With a lead far too long, the axis cannot follow the
    /// spindle, or the insert breaks.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0404
    /// G97 S800 M3
    /// G0 X24. Z5.
    /// G92 X19.4 Z-20. F2.5 (M20X1.5)
    /// X19.
    /// M30
    /// ```
    /// ```nc,reported,linuxcnc
    /// G21 G90 G54
    /// T1 M6 (M8X1.25 TAP)
    /// S300 M3
    /// G0 X0 Y0 Z5
    /// G33.1 Z-10 K1
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0404
    /// G97 S800 M3
    /// G0 X24. Z5.
    /// G92 X19.4 Z-20. F1.5 (M20X1.5)
    /// X19.
    /// M30
    /// ```
    rule "thread-lead-off-pitch" in "cycles" {
        summary: "thread cut with another lead than its pitch",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::FOLLOWED),
            make: || Box::new(ThreadLeadOffPitch::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ThreadLeadOffPitch {
    /// The tools whose threads were reported, by the blocks that put them in.
    told: BTreeSet<Option<At>>,
    /// Threads that only the title names.
    by_title: Vec<ByTitle>,
    /// The leads of the program's threads, as bits.
    leads: BTreeSet<u64>,
}

remembers!(ThreadLeadOffPitch: told, by_title);

#[derive(Clone, PartialEq)]
struct ByTitle {
    finding: Finding,
}

remembers!(ByTitle: finding);

/// For pitches that were rounded.
const SLACK: f64 = 0.006;

impl PathRule for ThreadLeadOffPitch {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_thread)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(is_thread) || cx.depth() > 1 || cx.is_malformed() {
            return;
        }
        let changed = cx.definitions().set_by(Fact::Tool);
        let Some((letter, lead)) = lead(cx) else { return };
        self.leads.insert(lead.to_bits());
        if self.told.contains(&changed) {
            return;
        }
        let Some(units) = cx.state().units(cx.model) else { return };
        let Some((thread, is_title)) = named_thread(cx, changed) else { return };
        let fits = |units: Units| {
            let right = thread.pitch / units.in_mm();
            (lead - right).abs() <= right * SLACK
        };
        // A program that does not state its units has the lead in those that fit the pitch.
        let is_stated = units::are_stated(cx);
        let has_starts = cx.word('Q').is_some() && {
            let starts = lead * units.in_mm() / thread.pitch;
            starts.round() >= 2.0 && (starts - starts.round()).abs() <= starts * SLACK
        };
        if has_starts || fits(units) || !is_stated && (fits(Units::Inch) || fits(Units::Mm)) {
            return;
        }
        self.told.insert(changed);
        let message = format!(
            "the thread is cut with a lead of {}, and its pitch is {}",
            cx.shown(Mm(lead * units.in_mm())),
            cx.shown(Mm(thread.pitch))
        );
        let right = trimmed(thread.pitch / units.in_mm());
        let mut finding = cx
            .finding(&META, cx.letter_range(letter), message)
            .label(format!("`{letter}{right}` for this pitch"))
            .help("give the pitch of the thread, or correct the comment");
        if let Some(range) = cx.range_of(thread.at) {
            finding = finding.also(range, format!("names the thread: {}", thread.name));
        }
        if is_title {
            self.by_title.push(ByTitle { finding });
        } else {
            report.add(finding);
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        let by_title = std::mem::take(&mut self.by_title);
        // With several leads the title's thread is one of them, and nothing tells which.
        if self.leads.len() == 1 {
            for thread in by_title {
                report.add(thread.finding);
            }
        }
    }
}

/// The lead that the block gives, with its address; `None` for a first block of two, which only prepares.
fn lead(cx: &PathCx<'_>) -> Option<(char, f64)> {
    if !cx.origin().letters.intersects(LetterSet::of("XYZUW")) {
        return None;
    }
    let ix = cx.codes().iter().copied().find(|ix| is_thread(cx.model.effect(*ix)))?;
    let code = cx.code_of(ix)?;
    let reads = |letter: &str| code.entry().words.iter().any(|word| word.letter == letter);
    let letter = match cx.model.effect(ix) {
        // The form with a height of the crest (`J`) has the lead in `P`.
        Effect::ThreadCycle if reads("J") => 'P',
        Effect::Thread | Effect::RigidTap if reads("K") => 'K',
        _ => 'F',
    };
    let word = cx.word(letter)?;
    let is_clear =
        word.shape.point || word.is_computed() || cx.control().numbers().unpointed == Unpointed::AsWritten;
    let lead = cx.known_number(letter).filter(|lead| is_clear && *lead > 0.0)?;
    Some((letter, lead))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn cycle(tool: &str, above: &str, words: &str) -> String {
        format!("O1\nG20 G99\n{tool}\nG97 S500 M3\nG54 G0 X.7 Z.3\n{above}G76 X.4056 Z-.9 {words}\nM30\n")
    }

    #[test]
    fn the_size_of_a_tap_stands_for_its_coarse_pitch() {
        let program = |lead: &str| {
            format!("G21 G90 G94\nT3 M6 (M6 TAP)\nG0 X0 Y0\nG43 H3 Z5\nS300 M3\nG33.1 Z-12 K{lead}\nM2\n")
        };
        check_rule(
            &RULE,
            "linuxcnc",
            &program("1.25"),
            &expect![[r#"
            6 | G33.1 Z-12 K1.25
              |            ^^^^^ warning[thread-lead-off-pitch] the thread is cut with a lead of 1.25 mm, and its pitch is 1 mm
        "#]],
        );
        check_rule(&RULE, "linuxcnc", &program("1"), &expect![[""]]);
    }

    #[test]
    fn the_comment_of_the_tool_or_of_the_operation() {
        let words = "K.0472 D.012 F.0625 A58.";
        check_rule(
            &RULE,
            "haas-lathe",
            &cycle("T505 (1/2-13 THREAD)", "", words),
            &expect![[r#"
            6 | G76 X.4056 Z-.9 K.0472 D.012 F.0625 A58.
              |                              ^^^^^^ warning[thread-lead-off-pitch] the thread is cut with a lead of 0.0625 in, and its pitch is 0.0769 in
        "#]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            &cycle("T505", "(CUT 1/2-13 UNC)\n", words),
            &expect![[r#"
            7 | G76 X.4056 Z-.9 K.0472 D.012 F.0625 A58.
              |                              ^^^^^^ warning[thread-lead-off-pitch] the thread is cut with a lead of 0.0625 in, and its pitch is 0.0769 in
        "#]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            &cycle("T505 (1/2-13 THREAD)", "", &words.replace(".0625", ".0769")),
            &expect![[""]],
        );
        check_rule(&RULE, "haas-lathe", &cycle("T505 (1/2-13 2 START)", "", words), &expect![[""]]);
        check_rule(&RULE, "haas-lathe", &cycle("T505 (1/2-13 BOLT, M12X1.75)", "", words), &expect![[""]]);
    }

    #[test]
    fn the_title_and_the_second_block_of_two() {
        let program = |lead: &str| {
            format!(
                "O2011 (M24X2 THREAD)\nG21\nT0404\nG97 S600 M3\nG0 X28. Z6.\nG76 P020060 Q50 R0.02\nG76 X21.546 Z-30. P1227 Q300 F{lead}\nM30\n"
            )
        };
        check_rule(&RULE, "fanuc-lathe", &program("12."), &expect![""]);
        check_rule(&RULE, "fanuc-lathe", &program("2."), &expect![[""]]);
    }

    #[test]
    fn a_title_where_the_program_cuts_two_threads() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "O100 (SPINDLE NUT M20X1.5)\nG21 G99\nT0303 (THREAD TOOL OD)\nG97 S500 M3\nG0 X34. Z5.\nG92 X29. Z-20. F2.\nG0 X100. Z100.\nT0505 (THREAD TOOL ID)\nG97 S500 M3\nG0 X16. Z5.\nG92 X20. Z-20. F1.5\nG0 Z50.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_thread_that_is_not_read_counts_before_the_title() {
        let program = |title: &str, tool: &str| {
            format!(
                "O3006 ({title})\nG21 G40 G99\nT0909 ({tool})\nG97 S600 M3\nG0 X30. Z6.\nG92 X26. Z-15. F1.814\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("ADAPTER M20X1.5", "EXT THREAD"),
            &expect![[r#"
            6 | G92 X26. Z-15. F1.814
              |                ^^^^^^ warning[thread-lead-off-pitch] the thread is cut with a lead of 1.814 mm, and its pitch is 1.5 mm
        "#]],
        );
        for (title, tool) in [
            ("ADAPTER M20X1.5", "EXT THREAD G3/4"),
            ("ADAPTER M20X1.5 - G3/4", "EXT THREAD"),
            ("1/2-14 NPT AND 3/4-16 UNF SWIVEL", "EXT THREAD"),
            ("M20X1.5", "THREAD 3/4 BSP"),
        ] {
            check_rule(&RULE, "fanuc-lathe", &program(title, tool), &expect![[""]]);
        }
    }

    #[test]
    fn a_tap_in_the_spindle_and_a_single_pass() {
        let tap =
            |lead: &str| format!("G21 G90 G54\nT1 M6\nS300 M3\nG0 X0 Y0 Z5\nG33.1 Z-10 K{lead} (M6x1)\nM2\n");
        check_rule(
            &RULE,
            "linuxcnc",
            &tap("1.25"),
            &expect![[r#"
            5 | G33.1 Z-10 K1.25 (M6x1)
              |            ^^^^^ warning[thread-lead-off-pitch] the thread is cut with a lead of 1.25 mm, and its pitch is 1 mm
        "#]],
        );
        check_rule(&RULE, "linuxcnc", &tap("1"), &expect![[""]]);
        let pass = |lead: &str| {
            format!("G21 G99 T0303\nG97 S300 M3\n(M30X1.5)\nG0 X29. Z3.\nG32 Z-20. F{lead}\nG0 X40.\nM30\n")
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &pass("3."),
            &expect![[r#"
            5 | G32 Z-20. F3.
              |           ^^^ warning[thread-lead-off-pitch] the thread is cut with a lead of 3 mm, and its pitch is 1.5 mm
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &pass("1.5"), &expect![[""]]);
    }

    #[test]
    fn threads_of_several_starts_have_a_lead_of_some_pitches() {
        let program = |words: &str| {
            format!("G21 G99 T0303\nG97 S300 M3\n(M30X1.5)\nG0 X29. Z3.\nG32 Z-20. {words}\nG0 X40.\nM30\n")
        };
        check_rule(&RULE, "fanuc-lathe", &program("F3. Q180000"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("F2. Q180000"),
            &expect![[r#"
            5 | G32 Z-20. F2. Q180000
              |           ^^^ warning[thread-lead-off-pitch] the thread is cut with a lead of 2 mm, and its pitch is 1.5 mm
        "#]],
        );
    }

    #[test]
    fn a_lead_in_the_units_that_fit_where_none_are_stated() {
        let program = "T0404 (1/2-13 THREAD)\nG97 S500 M3\nG0 X.7 Z.3\nG92 X.45 Z-.9 F.0769\nM30\n";
        check_rule(&RULE, "fanuc-lathe", program, &expect![[""]]);
    }
}
