//! A threading cycle that starts lower than its words put the crest of the thread.

use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::thread_cycles::{is_cycle, radii, straight_words};
use crate::facts::turning::shown_radius;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// The height of a thread and the diameter of its root give a crest that the start of the cycle does not clear: outside,
    /// the root and twice the height are larger than the start in X; in a bore, the root less twice the height is smaller.
    ///
    /// Tapered threads are not judged.
    ///
    /// ## Why it matters
    /// After each pass the tool returns at the X of the start. If the height is right, it is dragged through the thread; if it
    /// is wrong, by a digit or a point, the passes are.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0404
    /// G97 S600 M3
    /// G0 X22. Z6.
    /// G76 P010060 Q80 R0.04
    /// G76 X18.16 Z-20. P9200 Q250 F1.5
    /// M30
    /// ```
    /// ```nc,reported,haas-lathe
    /// G20 G99 T404
    /// G97 S600 M3
    /// G0 X0.9 Z0.3
    /// G76 X0.8466 Z-1.2 K0.0767 D0.015 F0.125 A60
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0404
    /// G97 S600 M3
    /// G0 X22. Z6.
    /// G76 P010060 Q80 R0.04
    /// G76 X18.16 Z-20. P920 Q250 F1.5
    /// M30
    /// ```
    rule "thread-start-below-crest" in "cycles" {
        summary: "threading cycle that starts lower than the crest of its thread",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(ThreadStartBelowCrest) },
    }
}

struct ThreadStartBelowCrest;

/// Heights are given as rounded numbers of a table: this part of one more is the same.
const ROUNDED: f64 = 0.1;
/// Radii that differ by less are one: millimetres.
const SLACK: f64 = 0.02;

impl PathRule for ThreadStartBelowCrest {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_cycle)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(words) = straight_words(cx).filter(|_| !cx.is_called_only()) else { return };
        let Some([start, root, height]) = radii(cx, &words.height) else { return };
        let crest = if start > root { root + height } else { root - height };
        let lacks = (crest - start) * (crest - root).signum();
        if height <= SLACK || (start - root).abs() < SLACK || lacks < height * ROUNDED + SLACK {
            return;
        }
        let is_outside = start > root;
        let shown = |radius: f64| shown_radius(cx, radius);
        let letter = words.height.letter;
        let height_range = cx.word_range(|word| word.letter == letter);
        let (place, sign, side) =
            if is_outside { ("inside", "+", "above") } else { ("outside", "-", "below") };
        let finding = |message: String| {
            cx.finding(&META, cx.effect_range(is_cycle), message)
                .also(height_range.clone(), format!("a thread {} high", cx.shown(Mm(height))))
        };
        // A start so near to the root is in the thread, whichever side of it is meant.
        if !is_outside && root - start < height {
            let outer = shown(root + height);
            report.add(
                finding("the thread starts inside of its root, by its words".to_owned())
                    .label(format!("starts at X {}, and the root is at X {}", shown(start), shown(root)))
                    .note("after each pass the tool returns at the X of the start")
                    .help(format!(
                        "start above X {outer} for a thread outside, below X {} for one in a bore",
                        shown(crest)
                    )),
            );
            return;
        }
        report.add(
            finding(format!("the thread starts {place} its crest, by its words"))
                .label(format!("starts at X {}, and the crest is at X {}", shown(start), shown(crest)))
                .note(format!(
                    "root X {} {sign} twice the height is X {}; after each pass the tool returns at the X of the start",
                    shown(root),
                    shown(crest)
                ))
                .help(format!("check `{letter}` and X of the thread, or start {side} X {}", shown(crest))),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    fn thread(start: &str, cycle: &str) -> String {
        format!("G21 G18 G99 T0404\nG97 S500 M3\nG0 X{start} Z6.\nG76 P020060 Q100 R0.05\n{cycle}\nM30\n")
    }

    #[test]
    fn outside_the_start_is_above_the_crest() {
        check_rule(&RULE, "fanuc-lathe", &thread("30.", "G76 X28.16 Z-27. P920 Q300 F1.5"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &thread("29.", "G76 X28.16 Z-27. P920 Q300 F1.5"),
            &expect![[r#"
            5 | G76 X28.16 Z-27. P920 Q300 F1.5
              | ^^^ warning[thread-start-below-crest] the thread starts inside its crest, by its words
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            &thread("29.", "G76 X28.16 Z-27. R-1. P920 Q300 F1.5"),
            &expect![[""]],
        );
    }

    #[test]
    fn in_a_bore_it_is_the_other_way_round() {
        check_rule(&RULE, "fanuc-lathe", &thread("26.", "G76 X30. Z-27. P920 Q300 F1.5"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &thread("29.", "G76 X30. Z-27. P920 Q300 F1.5"),
            &expect![[r#"
                5 | G76 X30. Z-27. P920 Q300 F1.5
                  | ^^^ warning[thread-start-below-crest] the thread starts inside of its root, by its words
            "#]],
        );
    }

    #[test]
    fn what_it_says() {
        let program = thread("22.", "G76 X18.16 Z-20. P9200 Q250 F1.5");
        let found = findings(&only(&RULE), "fanuc-lathe", &program, &World::default());
        expect![[r#"
            the thread starts inside its crest, by its words
              here: starts at X 22 mm, and the crest is at X 36.56 mm
              there: a thread 9.2 mm high
              note: root X 18.16 mm + twice the height is X 36.56 mm; after each pass the tool returns at the X of the start
              help: check `P` and X of the thread, or start above X 36.56 mm
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
