//! A thread outside that is cut on a diameter to which the part was not turned.

use gcheck_engine::Event;
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::thread_cycles::{FirstPass, is_cycle};
use crate::facts::turned::{SLACK, Turned, spot};
use crate::facts::turning::{is_turned, shown_radius};
use crate::{MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// The root of an outside thread and twice its height give the diameter of its crest. The program has turned the part to another
    /// diameter there, by more than the thread's shape explains.
    ///
    /// Tapered threads, bores, threads of one pass at a time (`G92`) and cycles that name the crest (`J` of LinuxCNC's `G76`) are not judged. Where a
    /// finishing cut comes to the part from nowhere in particular, nothing is certain, and nothing is reported.
    ///
    /// ## Why it matters
    /// If the part is larger, the first pass cuts as deep as the difference, and the insert breaks. If it is smaller, the thread has no
    /// crests, and the nut does not hold. Mostly two digits of `X` are exchanged, in the cycle or in the contour.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0101
    /// G97 S900 M3
    /// G0 X34. Z2.
    /// X29.8
    /// G1 Z-30. F0.2
    /// X36.
    /// G0 Z5.
    /// T0404
    /// G0 X34. Z5.
    /// G76 P020060 Q100 R0.05
    /// G76 X26.18 Z-25. P920 Q300 F1.5
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0101
    /// G97 S900 M3
    /// G0 X34. Z2.
    /// X29.8
    /// G1 Z-30. F0.2
    /// X36.
    /// G0 Z5.
    /// T0404
    /// G0 X34. Z5.
    /// G76 P020060 Q100 R0.05
    /// G76 X28.16 Z-25. P920 Q300 F1.5
    /// M30
    /// ```
    rule "thread-off-turned-diameter" in "cycles" {
        summary: "thread that does not fit the diameter to which the part was turned",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::MOVES),
            make: || Box::new(ThreadOffTurnedDiameter::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ThreadOffTurnedDiameter {
    pass: FirstPass,
}

remembers!(ThreadOffTurnedDiameter);

/// The part of the height by which a crest is flattened or left larger, at most.
const FLAT: f64 = 0.4;

impl PathRule for ThreadOffTurnedDiameter {
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
        // In front of the face the thread runs in the air.
        let middle =
            if ends < 0.0 { f64::midpoint(begins.min(0.0), ends) } else { f64::midpoint(begins, ends) };
        let Some((outside, cut)) = turned.finished_along(middle) else { return };
        // A chamfer does not show the diameter.
        if start <= root || !cut.is_straight() {
            return;
        }
        let crest = root + height;
        let off = outside - crest;
        if off.abs() <= height * FLAT + SLACK || outside < root * 0.5 {
            return;
        }
        let shown = |radius: f64| shown_radius(cx, radius);
        let message = if off > 0.0 {
            "the thread is cut on a part that is larger than its crest"
        } else {
            "the thread is cut on a part that is smaller than its crest"
        };
        let comes_of_it = if off > 0.0 {
            format!("the first passes cut {} too deep", cx.shown(Mm(off)))
        } else {
            format!("the crests of the thread lack {}", cx.shown(Mm(-off)))
        };
        let finding = cx
            .finding(&META, cx.effect_range(is_cycle), message)
            .label(format!("root X {} + twice the height is X {}", shown(root), shown(crest)))
            .note(comes_of_it)
            .help(format!(
                "check `X` and the height of the thread, and the X {} of the contour",
                shown(outside)
            ))
            .also(cut.bytes.clone(), format!("the part is turned to X {} here", shown(outside)));
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn shaft(turned: &str, start: &str, thread: &str) -> String {
        format!(
            "G21 G18 G99 T0101\nG97 S900 M3\nG0 X{start} Z2.\nX{turned}\nG1 Z-30. F0.2\nX36.\nG0 Z5.\nT0404\nG0 X{start} Z5.\nG76 P020060 Q100 R0.05\nG76 {thread} Z-25. P920 Q300 F1.5\nM30\n"
        )
    }

    #[test]
    fn the_part_is_larger_or_smaller_than_the_crest() {
        check_rule(&RULE, "fanuc-lathe", &shaft("29.8", "34.", "X28.16"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &shaft("29.8", "34.", "X26.18"),
            &expect![[r#"
            11 | G76 X26.18 Z-25. P920 Q300 F1.5
               | ^^^ warning[thread-off-turned-diameter] the thread is cut on a part that is larger than its crest
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            &shaft("28.9", "34.", "X28.16"),
            &expect![[r#"
            11 | G76 X28.16 Z-25. P920 Q300 F1.5
               | ^^^ warning[thread-off-turned-diameter] the thread is cut on a part that is smaller than its crest
        "#]],
        );
    }

    #[test]
    fn what_was_not_turned_is_not_known() {
        let program = "G21 G18 G99 T0404\nG97 S900 M3\nG0 X34. Z5.\nG76 P020060 Q100 R0.05\nG76 X26.18 Z-25. P920 Q300 F1.5\nM30\n";
        check_rule(&RULE, "fanuc-lathe", program, &expect![[""]]);
    }

    #[test]
    fn a_taper_is_not_judged() {
        check_rule(&RULE, "fanuc-lathe", &shaft("29.8", "34.", "X26.18 R-1."), &expect![[""]]);
    }

    fn threaded(turning: &str, thread: &str) -> String {
        format!(
            "G21 G18 G99 T0101\nG97 S900 M3\n{turning}G0 X60. Z50.\nT0404\nG97 S900 M3\nG0 X34. Z5.\nG76 P020060 Q100 R.05\n{thread}M30\n"
        )
    }

    #[test]
    fn a_finishing_cut_that_comes_from_anywhere() {
        let roughed = "G0 X42. Z2.\nG90 X32. Z-30. F.25\nG0 X60. Z50.\n";
        let finished = format!("{roughed}G0 X24. Z2.\nG1 X29.8 Z-.9 F.1\nZ-30.\nX42.\n");
        let thread = "G76 X28.16 Z-25. P920 Q300 F1.5\n";
        check_rule(&RULE, "fanuc-lathe", &threaded(&finished, thread), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &threaded(roughed, thread),
            &expect![[r#"
                11 | G76 X28.16 Z-25. P920 Q300 F1.5
                   | ^^^ warning[thread-off-turned-diameter] the thread is cut on a part that is larger than its crest
            "#]],
        );
    }

    #[test]
    fn a_chamfer_in_front_of_the_face() {
        let turning = "G0 X34. Z2.\nX22.8\nG1 X29.8 Z-1.5 F.2\nZ-12.\nX36.\n";
        let thread = "G0 X34. Z10.\nG76 P020060 Q100 R.05\nG76 X28.16 Z-8. P920 Q300 F1.5\n";
        check_rule(&RULE, "fanuc-lathe", &threaded(turning, thread), &expect![[""]]);
    }
}
