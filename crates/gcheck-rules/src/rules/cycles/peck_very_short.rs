//! A hole that takes hundreds of pecks.

use gcheck_controls::{Effect, Unpointed};
use gcheck_engine::{At, Axis, Event, Travel, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_range;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A cycle that drills in pecks (`G83`, `G73`; `G74` of lathes) makes more than 500 of them in one hole, or a grooving cycle (`G75`, `G74`
    /// with a way in X) more than 500 plunges side by side. So does a grooving cycle whose pecks are shorter than 0.015 mm.
    ///
    /// ## Why it matters
    /// Each peck rubs more than it cuts, and the hole takes very long. Mostly the number has another unit: without a decimal point
    /// `Q` counts the smallest step on many controls, a thousandth of a millimetre.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0404
    /// G97 S1200 M3
    /// G0 X0. Z3.
    /// G74 R1.
    /// G74 Z-60. Q10 F.15
    /// G0 Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0404
    /// G97 S1200 M3
    /// G0 X0. Z3.
    /// G74 R1.
    /// G74 Z-60. Q10000 F.15
    /// G0 Z50.
    /// M30
    /// ```
    rule "peck-very-short" in "cycles" {
        summary: "hole that takes hundreds of pecks",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FEED_STROKES, make: || Box::new(PeckVeryShort::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct PeckVeryShort {
    /// The block that pecks, and how often so far in the hole; with the bottom that was reached.
    pecks: Option<(At, u32, f64)>,
    /// The block that cuts grooves, how many plunges so far, and where the last one is from side to side.
    plunges: Option<(At, u32, f64)>,
    /// The pecks of the plunge so far, and how deep the last one went.
    strokes: Option<(u32, f64)>,
    /// A hole was reported. One finding is enough for a program: mostly all holes have the same `Q`.
    is_told: bool,
}

remembers!(PeckVeryShort: pecks, plunges);

/// No drill pecks as often.
const MOST: u32 = 500;
/// A grooving tool rubs in pecks that are shorter: millimetres. As many one after the other are more than the rest of a groove.
const TINY: f64 = 0.015;
const MANY: u32 = 20;

impl PathRule for PeckVeryShort {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| pecks(effect) || effect == Effect::GrooveDiameter)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        if travel.kind != TravelKind::Feed || !travel.expanded || self.is_told {
            return;
        }
        if cx.has_effect(|effect| effect == Effect::GrooveDiameter) {
            self.groove(
                cx,
                travel,
                Along { deep: Axis::X, side: Axis::Z, peck: ['P', 'I'], step: ['Q', 'K'] },
                report,
            );
            return;
        }
        if cx.has_effect(|effect| effect == Effect::GrooveFace) {
            self.groove(
                cx,
                travel,
                Along { deep: Axis::Z, side: Axis::X, peck: ['Q', 'K'], step: ['P', 'I'] },
                report,
            );
        }
        if self.is_told {
            return;
        }
        let cycle = cx.state().active_cycle(cx.model).filter(|code| code.is_some());
        let is_peck = cx.has_effect(pecks) || cycle.is_some_and(|code| pecks(cx.model.effect(code)));
        let (from, to) = (travel.from.raw(Axis::Z), travel.to.raw(Axis::Z));
        let is_down = to < from;
        if !is_peck || !is_down {
            return;
        }
        let at = cx.origin().at;
        // Back up at another hole, the bottom is above the last one.
        let (count, bottom) = match self.pecks {
            Some((before, count, bottom)) if before == at && to < bottom => (count + 1, bottom),
            _ => (1, from),
        };
        self.pecks = Some((at, count, to));
        if count != MOST + 1 {
            return;
        }
        self.is_told = true;
        // The stroke begins above the bottom of the one before, by the clearance.
        let way = cx.shown(Mm(bottom - to));
        let mut finding = cx
            .finding(&META, cycle_range(cx), format!("more than {MOST} pecks in one hole"))
            .label(format!("a peck goes {way} down"));
        let unpointed = cx.word('Q').is_some_and(|word| !word.shape.point && !word.is_computed());
        let counts_steps = cx.control().numbers().unpointed != Unpointed::AsWritten;
        if unpointed && counts_steps {
            finding = finding
                .also(cx.letter_range('Q'), "without a point it may count the smallest step of the control");
        }
        report.add(finding.help("check the unit and the decimal point of `Q`"));
    }
}

/// Which way a grooving cycle goes, and the words of its steps: as most controls have them, and as others do.
#[derive(Clone, Copy)]
struct Along {
    deep: Axis,
    side: Axis,
    peck: [char; 2],
    step: [char; 2],
}

impl PeckVeryShort {
    /// A peck of a grooving cycle, which plunges and then goes to the side.
    fn groove(&mut self, cx: &PathCx<'_>, travel: &Travel, along: Along, report: &mut Report<'_>) {
        let (Some(deep), Some(side)) = (travel.to.get(along.deep), travel.to.get(along.side)) else { return };
        let at = cx.origin().at;
        let is_same = |last: f64| side.to_bits() == last.to_bits();
        let (count, step) = match self.plunges {
            Some((before, count, last)) if before == at && is_same(last) => (count, 0.0),
            Some((before, count, last)) if before == at => (count + 1, (side - last).abs()),
            _ => (1, 0.0),
        };
        let is_one_plunge = self.plunges.is_some_and(|(before, _, last)| before == at && is_same(last));
        self.plunges = Some((at, count, side));
        let (pecks, peck) = match self.strokes.filter(|_| is_one_plunge) {
            // One peck after the other: what is left for the last one may be as little.
            Some((pecks, last)) if (deep - last).abs() < TINY => (pecks + 1, (deep - last).abs()),
            Some((_, last)) => (1, (deep - last).abs()),
            None => (1, 0.0),
        };
        self.strokes = Some((pecks, deep));
        let written = |[usual, other]: [char; 2]| if cx.word(usual).is_some() { usual } else { other };
        if count == MOST + 1 && step > 0.0 {
            let letter = written(along.step);
            self.is_told = true;
            report.add(
                cx.finding(&META, word_range(cx, letter), format!("more than {MOST} plunges for one groove"))
                    .label(format!("each is {} beside the one before", cx.shown(Mm(step))))
                    .help(format!(
                        "check the unit and the decimal point of `{letter}`: mostly the step is a little less than the tool is wide")),
            );
        } else if pecks == MANY && peck > 0.0 && peck < TINY {
            let letter = written(along.peck);
            self.is_told = true;
            report.add(
                cx.finding(&META, word_range(cx, letter), "the cycle pecks by next to nothing")
                    .label(format!("a peck goes {peck:.3} mm deeper"))
                    .help(format!("check the unit and the decimal point of `{letter}`")),
            );
        }
    }
}

/// The word of the block, or the block where it has another one in its place.
fn word_range(cx: &PathCx<'_>, letter: char) -> std::ops::Range<u32> {
    if cx.word(letter).is_some() { cx.letter_range(letter) } else { cx.range() }
}

fn pecks(effect: Effect) -> bool {
    matches!(effect, Effect::CyclePeck | Effect::CycleChipBreak | Effect::GrooveFace)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn grooves_side_by_side() {
        let program = |q: &str| {
            format!(
                "G21 G99 T0404\nG97 S700 M3\nG0 X52. Z-15.\nG75 R.5\nG75 X40. Z-45. P2000 {q} F.08\nG0 X60.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("Q15"),
            &expect![[r#"
                5 | G75 X40. Z-45. P2000 Q15 F.08
                  |                      ^^^ warning[peck-very-short] more than 500 plunges for one groove
            "#]],
        );
        for q in ["Q2500", "Q500"] {
            check_rule(&RULE, "fanuc-lathe", &program(q), &expect![[""]]);
        }
    }

    #[test]
    fn pecks_of_a_groove_in_the_smallest_step() {
        let program =
            |cycle: &str| format!("G21 G99 T0404\nG97 S700 M3\nG0 X52. Z3.\n{cycle} F.08\nG0 X60.\nM30\n");
        // The twentieth peck is what is left, not a step of the cycle.
        check_rule(&RULE, "fanuc-lathe", &program("G75 R.5\nG75 X13.98 P1000"), &expect![[""]]);
        for (cycle, place) in [
            ("G75 R.5\nG75 X48. Z-15. P5 Q2500", "P5"),
            ("G75 X40. P10", "P10"),
            ("G74 R.5\nG74 Z-2. Q8", "Q8"),
            ("G74 R.5\nG74 X20. Z-6. P10 Q2000", "P10"),
        ] {
            let text = program(cycle);
            let found = findings(&only(&RULE), "fanuc-lathe", &text, &World::default());
            let [finding] = found.as_slice() else { panic!("{cycle}: {found:#?}") };
            assert_eq!(
                text[finding.range.start as usize..finding.range.end as usize].trim(),
                place,
                "{cycle}"
            );
        }
        for cycle in [
            "G75 R.5\nG75 X48. Z-15. P500 Q2500",
            "G75 X40. P1000",
            "G75 X40. P50",
            "G75 R.2\nG75 X51.8 Z-15. P20 Q2000",
            "G74 R.5\nG74 Z-2. Q50",
            "G74 R.5\nG74 X20. Z-6. P2000 Q2000",
        ] {
            check_rule(&RULE, "fanuc-lathe", &program(cycle), &expect![[""]]);
        }
    }

    #[test]
    fn on_mills_and_in_series() {
        let program = |q: &str| {
            format!(
                "G21 G90 G54 G0 X0. Y0. Z10. S900 M3\nG98 G83 Z-60. R2. {q} F100.\nX10.\nX20.\nG80\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program("Q.1"),
            &expect![[r#"
            2 | G98 G83 Z-60. R2. Q.1 F100.
              |     ^^^ warning[peck-very-short] more than 500 pecks in one hole
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("Q30"),
            &expect![[r#"
            2 | G98 G83 Z-60. R2. Q30 F100.
              |     ^^^ warning[peck-very-short] more than 500 pecks in one hole
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program("Q.2"), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("Q2000"), &expect![[""]]);
    }

    #[test]
    fn how_far_a_peck_goes() {
        let program = "G21 G90 G54 G17\nT1 M6\nS900 M3\nG0 X0 Y0 Z10\nG83 Z-600 R2 Q1 F100\nG80\nM2\n";
        let found = findings(&only(&RULE), "linuxcnc", program, &World::default());
        expect![[r#"
            more than 500 pecks in one hole
              here: a peck goes 1 mm down
              help: check the unit and the decimal point of `Q`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        let program = "G21 G90 G54 G0 X0. Y0. Z10. S900 M3\nG98 G83 Z-60. R2. Q30 F100.\nG80\nM30\n";
        let found = findings(&only(&RULE), "fanuc-mill", program, &World::default());
        expect![[r#"
            more than 500 pecks in one hole
              here: a peck goes 0.03 mm down
              there: without a point it may count the smallest step of the control
              help: check the unit and the decimal point of `Q`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
