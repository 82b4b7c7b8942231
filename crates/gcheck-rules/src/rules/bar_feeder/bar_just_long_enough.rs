//! A bar that ends at exactly the length for which the manual has no answer.

use gcheck_engine::Event;
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::bar_feed::{Length, length_range, lengths};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// After some parts, exactly as much of the bar is left as one part and its clamping need (`J` and `K` of `G105`,
    /// with `bar_length` of the machine file).
    ///
    /// ## Why it matters
    /// A longer bar is pushed, a shorter one is changed. For a bar of exactly this length the manual says nothing: the
    /// last part of each bar may or may not be made.
    ///
    /// ## Reported
    /// With bars of 1000 mm, of which 100 mm are left after nine parts:
    /// ```nc,reported,haas-lathe
    /// G21
    /// M5
    /// G105 J90. K10. I90.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G21
    /// M5
    /// G105 J90. K12. I90.
    /// M99
    /// ```
    /// ## How to fix it
    /// * Make the clamping length (`K`) a little smaller or larger, so that the last part is either made or not.
    /// * If the bars are not exactly as long as `bar_length` says, correct `bar_length` in the machine file.
    rule "bar-just-long-enough" in "bar_feeder" {
        summary: "bar that ends at exactly a part and its clamping",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(BarJustLongEnough) },
    }
}

struct BarJustLongEnough;

impl PathRule for BarJustLongEnough {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(bar) = cx.environment.machine.engine.bar.new_bar else {
            cx.enough();
            return;
        };
        let Some(told) = lengths(event) else { return };
        if told.part <= Mm::ZERO || told.clamping < Mm::ZERO || told.initial <= Mm::ZERO {
            return;
        }
        // After the first push there must be a whole number of parts, and the clamping.
        let parts = (bar - told.initial - told.clamping).0 / told.part.0;
        let whole = parts.round();
        if !(whole >= 1.0 && (parts - whole).abs() * told.part.0 < 1e-6) {
            return;
        }
        let made = if whole < 1.5 { "1 part".to_owned() } else { format!("{whole} parts") };
        report.add(
            cx.finding(
                &META,
                length_range(cx, Length::Part),
                "bar comes out just long enough for its last part",
            )
            .label(format!(
                "{} are left after {made}: `J` and `K` exactly",
                cx.shown(told.part + told.clamping)
            ))
            .note("the manual says what happens with a longer bar and with a shorter one")
            .help("make the clamping length (`K`) a little smaller or larger"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule_in};

    #[test]
    fn in_inches_too() {
        // 10 inches are left after the first push and for the clamping.
        let mut world = World::of_examples(&META);
        world.machine.engine.bar.new_bar = Some(gcheck_geometry::Mm(12.0 * 25.4));
        check_rule_in(
            &RULE,
            "haas-lathe",
            "G20\nM5\nG105 J0.1 K1.9 I0.1\nM99\n",
            &world,
            &expect![[r#"
                3 | G105 J0.1 K1.9 I0.1
                  |      ^^^^ info[bar-just-long-enough] bar comes out just long enough for its last part
            "#]],
        );
        check_rule_in(&RULE, "haas-lathe", "G20\nM5\nG105 J0.1 K1.95 I0.1\nM99\n", &world, &expect![[""]]);
        check_rule_in(&RULE, "haas-lathe", "G20\nM5\nG105 J0.1 K#500 I0.1\nM99\n", &world, &expect![[""]]);
    }
}
