//! A threading cycle that starts inside the part as it is turned, or that lies in front of all that is turned.

use gcheck_engine::Event;
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::thread_cycles::{FirstPass, is_cycle};
use crate::facts::turned::{SLACK, Turned, UNDER, spot};
use crate::facts::turning::{is_turned, shown_radius};
use crate::{MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// The Z of a threading cycle does not fit the part that the program has turned:
    ///
    /// * an outside thread starts at a Z where the part is as large as the crest, with no groove near it,
    /// * an outside thread starts in front of the part, and goes away from the chuck.
    ///
    /// Threads of one pass at a time (`G92`) and cycles that name the crest (`J` of LinuxCNC's `G76`) are not judged.
    ///
    /// ## Why it matters
    /// A cycle goes to the depth of each pass at rapid, at the Z where it starts. If the part is there, the insert breaks. A thread in front of the part
    /// is not cut at all, or the tool moves away from a part that it was to cut. Mostly the sign of `Z` is wrong.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0101
    /// G97 S900 M3
    /// G0 X34. Z2.
    /// X29.8
    /// G1 Z-40. F0.2
    /// X36.
    /// G0 Z5.
    /// T0404
    /// G0 X34. Z-5.
    /// G76 P020060 Q100 R0.05
    /// G76 X28.16 Z-25. P920 Q300 F1.5
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0101
    /// G97 S900 M3
    /// G0 X34. Z2.
    /// X29.8
    /// G1 Z-40. F0.2
    /// X36.
    /// G0 Z5.
    /// T0404
    /// G0 X34. Z5.
    /// G76 P020060 Q100 R0.05
    /// G76 X28.16 Z-25. P920 Q300 F1.5
    /// M30
    /// ```
    rule "thread-beside-part" in "cycles" {
        summary: "threading cycle that starts in the part or lies in front of it",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::MOVES),
            make: || Box::new(ThreadBesidePart::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ThreadBesidePart {
    pass: FirstPass,
}

remembers!(ThreadBesidePart);

/// A part that is larger than the root by this part of the height is in the way of the first pass.
const IN_THE_WAY: f64 = 0.5;

impl PathRule for ThreadBesidePart {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program) && program.may(is_cycle)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        self.pass.block(cx);
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(([start, root, height], travel)) = self.pass.moved(event) else { return };
        let Some(turned) = Turned::of(cx).filter(|turned| turned.knows(cx)) else { return };
        let [begins, ends] = [&travel.from, &travel.programmed].map(|at| spot(at)[1]);
        // A thread toward the chuck may be cut on a ground bar, or in front of a zero at a shoulder; one in a bore, where nothing was turned.
        let leaves_part = start > root && begins > -SLACK && ends > begins + SLACK;
        let is_in_front = |front: f64| leaves_part && begins > front - SLACK;
        if let Some(front) = turned.front().filter(|front| is_in_front(*front)) {
            report.add(
                cx.finding(&META, cx.letter_range('Z'), "the thread lies in front of the part")
                    .label(format!("from Z {} to Z {}", cx.shown(Mm(begins)), cx.shown(Mm(ends))))
                    .note(format!("nothing is turned in front of Z {}", cx.shown(Mm(front))))
                    .help("check the sign of `Z`"),
            );
            return;
        }
        let is_in_part = |radius: f64| radius > root + height * IN_THE_WAY;
        let surface = turned.finished_along(begins).filter(|(radius, _)| start > root && is_in_part(*radius));
        let wall = UNDER.min(height / 2.0);
        let is_solid = || begins < -UNDER && !turned.is_open_across(begins, root, wall);
        let Some((radius, cut)) = surface.filter(|_| is_solid()) else { return };
        let shown = |radius: f64| shown_radius(cx, radius);
        let finding = cx
            .finding(&META, cx.effect_range(is_cycle), "the thread starts inside the part")
            .label(format!("starts at Z {}, where the part is turned to X {}", cx.shown(Mm(begins)), shown(radius)))
            .note("the cycle goes to the depth of each pass at rapid, at the Z where it starts")
            .help("start the cycle in front of the part, or in a groove: check the sign of `Z` in the move before it")
            .also(cut.bytes.clone(), format!("turned to X {} here", shown(radius)));
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn shaft(groove: &str, start: &str, end: &str) -> String {
        format!(
            "G21 G18 G99 T0101\nG97 S900 M3\nG0 X34. Z2.\nX29.8\nG1 Z-40. F0.2\nX36.\nG0 Z5.\n{groove}T0404\nG0 X34. Z{start}\nG76 P020060 Q100 R0.05\nG76 X28.16 Z{end} P920 Q300 F1.5\nM30\n"
        )
    }

    #[test]
    fn the_start_is_in_the_part() {
        check_rule(&RULE, "fanuc-lathe", &shaft("", "5.", "-25."), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &shaft("", "-5.", "-25."),
            &expect![[r#"
            11 | G76 X28.16 Z-25. P920 Q300 F1.5
               | ^^^ warning[thread-beside-part] the thread starts inside the part
        "#]],
        );
    }

    #[test]
    fn a_left_hand_thread_may_start_in_a_groove() {
        let groove = "T0303\nG0 X34. Z-30.\nG1 X26. F.08\nG0 X34.\n";
        check_rule(&RULE, "fanuc-lathe", &shaft(groove, "-30.", "5."), &expect![[""]]);
    }

    #[test]
    fn the_thread_is_in_front() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &shaft("", "5.", "25."),
            &expect![[r#"
            11 | G76 X28.16 Z25. P920 Q300 F1.5
               |            ^^^^ warning[thread-beside-part] the thread lies in front of the part
        "#]],
        );
    }

    fn threaded(turning: &str, start: &str, thread: &str) -> String {
        format!(
            "G21 G18 G99 T0101\nG97 S900 M3\n{turning}G0 X60. Z50.\nT0404\nG97 S900 M3\nG0 {start}\nG76 P020060 Q100 R.05\n{thread}M30\n"
        )
    }

    #[test]
    fn ground_bars_and_fine_threads() {
        let shank = "G0 X34. Z-20.\nG1 X26. F.1\nZ-40.\nX34.\n";
        let ground = threaded(shank, "X34. Z6.", "G76 X28.16 Z-18. P920 Q300 F1.5\n");
        check_rule(&RULE, "fanuc-lathe", &ground, &expect![[""]]);
        let groove =
            "G0 X24. Z2.\nX19.9\nG1 Z-30. F.1\nX24.\nG0 X60. Z50.\nG0 X20.5 Z-30.\nG1 X18.6 F.05\nX20.5\n";
        let fine = threaded(groove, "X22. Z-28.5", "G76 X18.77 Z3. P613 Q200 F1.\n");
        check_rule(&RULE, "fanuc-lathe", &fine, &expect![[""]]);
    }
}
