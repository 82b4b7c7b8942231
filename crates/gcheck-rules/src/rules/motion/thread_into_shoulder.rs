//! A thread that runs on into a larger diameter.

use gcheck_engine::{At, Event, Fact, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::turned::{SLACK, Spot, Turned, UNDER, spot};
use crate::facts::turning::{is_turned, shown_radius};
use crate::{MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A threading cycle cuts along a diameter that the program has turned, and goes on to where the part is larger.
    ///
    /// ## Why it matters
    /// The threading tool runs into the shoulder in step with the spindle, which cannot be stopped in time.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G18 G99 T0101
    /// G97 S800 M3
    /// G0 X50. Z2.
    /// X30.
    /// G1 Z-30. F.2
    /// X40.
    /// Z-60.
    /// G0 X60. Z50.
    /// T0202
    /// G0 X34. Z5.
    /// G92 X29. Z-37. F1.5
    /// G0 X60. Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G18 G99 T0101
    /// G97 S800 M3
    /// G0 X50. Z2.
    /// X30.
    /// G1 Z-30. F.2
    /// X40.
    /// Z-60.
    /// G0 X60. Z50.
    /// T0202
    /// G0 X34. Z5.
    /// G92 X29. Z-27. F1.5
    /// G0 X60. Z50.
    /// M30
    /// ```
    rule "thread-into-shoulder" in "motion" {
        summary: "threading cycle goes on into a larger diameter of the part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES,
            make: || Box::new(ThreadIntoShoulder::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ThreadIntoShoulder {
    /// Where the tool was put in that was reported last.
    told: Option<At>,
}

remembers!(ThreadIntoShoulder: told);

/// Places along a thread that are looked at.
const PLACES: u32 = 32;

impl PathRule for ThreadIntoShoulder {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(turned) = Turned::of(cx) else { return };
        let Event::Travel(travel) = event else { return };
        let tool = cx.definitions().set_by(Fact::Tool);
        let is_new = self.told.is_none() || self.told != tool;
        if travel.kind == TravelKind::Thread && travel.expanded && is_new && turned.knows(cx) {
            self.judge(cx, turned, [&travel.from, &travel.to].map(spot), report);
        }
    }
}

impl ThreadIntoShoulder {
    /// One pass.
    fn judge(&mut self, cx: &PathCx<'_>, turned: &Turned, [from, to]: [Spot; 2], report: &mut Report<'_>) {
        // From inside it is the thread of a bore.
        let pass = from[0].max(to[0]);
        let Some(begins) = turned.block_begins(cx).filter(|begins| *begins > pass + SLACK) else { return };
        let place = |step: u32| {
            let share = f64::from(step) / f64::from(PLACES);
            [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])]
        };
        // How much the part is larger than the pass.
        let above = |[radius, z]: Spot| Some(turned.least_outside(z)?.0 - radius);
        let heights = (0..=PLACES).filter_map(|step| above(place(step)));
        // What lies below the pass is a bore, a pilot, a groove.
        let mut heights: Vec<f64> = heights.filter(|height| *height > 0.0).collect();
        heights.sort_by(f64::total_cmp);
        // A chamfer before the thread is short beside it.
        let Some(crest) = heights.get(heights.len() / 2) else { return };
        // Where the cycle begins, the tool is outside of what it cuts.
        let is_shoulder = |spot: &Spot| {
            above(*spot).is_some_and(|height| height > crest + UNDER && spot[0] + height > begins)
        };
        let Some([radius, z]) = (0..=PLACES).map(place).find(is_shoulder) else { return };
        let Some((part, cut)) = turned.least_outside(z) else { return };
        self.told = cx.definitions().set_by(Fact::Tool).or(Some(cx.origin().at));
        let shown = |radius: f64| shown_radius(cx, radius);
        let finding = cx
            .finding(&META, cx.range(), "the thread goes on into a larger diameter of the part")
            .label(format!(
                "at Z {} the part is turned to X {}, and the thread is cut at X {}",
                cx.shown(Mm(z)),
                shown(part),
                shown(radius)
            ))
            .also(cut.bytes.clone(), "turned here")
            .help("end the thread before the shoulder: check `Z` of the cycle, and its sign");
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    /// A shaft with a shoulder at Z-30, and a groove before it where `groove` says so.
    fn shaft(groove: &str, cycle: &str) -> String {
        format!(
            "G21 G18 G99 T0101\nG97 S800 M3\nG0 X50. Z2.\nX26.\nG1 Z0. F.2\nX30. Z-2.\nZ-30.\nX40.\nZ-60.\nG0 X60. Z50.\n{groove}T0404\nG0 X34. Z5.\n{cycle}\nG0 X60. Z50.\nM30\n"
        )
    }

    #[test]
    fn one_thread_is_one_finding() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &shaft("", "G92 X29. Z-37. F1.5\nX28.6\nX28.3"),
            &expect![[r#"
                13 | G92 X29. Z-37. F1.5
                   | ^^^^^^^^^^^^^^^^^^^ warning[thread-into-shoulder] the thread goes on into a larger diameter of the part
            "#]],
        );
    }

    /// The tool is fed through air to the face.
    #[test]
    fn the_way_to_the_face_is_not_a_shoulder() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G18 G99\nT0101\nG97 S800 M3\nG0 X45. Z5.\nG1 Z0. F.2\nX-1.6\nG0 Z2.\nX30.\nG1 Z-30. F.2\nX45.\nG0 X100. Z50.\nT0303\nG97 S600 M3\nG0 X34. Z5.\nG76 P010060 Q50 R20\nG76 X27.5 Z-25. P1200 Q300 F2.\nG0 X100. Z50.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn below_the_pass_is_no_crest() {
        let bore = "T0202\nG0 X18. Z2.\nG1 Z-22.\nX17.\nG0 Z50.\n";
        check_rule(&RULE, "fanuc-lathe", &shaft(bore, "G92 X29. Z-27. F1.5"), &expect![[""]]);
        let dog = "G21 G18 G99 T0101\nG97 S800 M3\nG0 X10. Z2.\nG1 Z-20. F.2\nX20.\nZ-36.\nG0 X50. Z50.\nT0404\nG0 X24. Z3.\nG92 X19.2 Z-34. F2.\nG0 X60. Z50.\nM30\n";
        check_rule(&RULE, "fanuc-lathe", dog, &expect![[""]]);
    }

    #[test]
    fn a_thread_ends_before_its_shoulder_or_in_the_groove() {
        let groove = "T0303\nG0 X42. Z-30.\nG1 X26. F.1\nG0 X42.\nZ50.\n";
        for cycle in ["G92 X29. Z-27. F1.5\nX28.2", "G92 X29. Z-30. F1.5\nX28.2"] {
            check_rule(&RULE, "fanuc-lathe", &shaft("", cycle), &expect![[""]]);
            check_rule(&RULE, "fanuc-lathe", &shaft(groove, cycle), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "fanuc-lathe",
            &shaft(groove, "G76 P020060 Q100 R0.05\nG76 X28.16 Z-37. P920 Q300 F1.5"),
            &expect![[r#"
                19 | G76 X28.16 Z-37. P920 Q300 F1.5
                   | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[thread-into-shoulder] the thread goes on into a larger diameter of the part
            "#]],
        );
    }
}
