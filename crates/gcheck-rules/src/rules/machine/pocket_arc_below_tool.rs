//! A pocket whose tool is larger than an arc of its outline.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{At, CycleFault, Fault, Units};

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_code;
use crate::facts::pockets::outline_of;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// The outline of a pocket has an inside arc with a radius smaller than that of the tool.
    ///
    /// ## Why it matters
    /// The centre of the tool keeps its radius from the wall. It cannot do that inside a smaller arc, so the control
    /// stops with an alarm. Where the outline gives a sharp corner, the tool leaves its own radius there and no alarm
    /// comes.
    ///
    /// ## Reported
    /// Tool 1 has a diameter of 10 mm:
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G150 P100 G41 D1 X0. Y0. Z-5. Q2. R2. I7. F200.
    /// G40 X0. Y0.
    /// M30
    /// O100
    /// G1 Y20.
    /// X-18.
    /// G3 X-20. Y18. R2.
    /// G1 Y-20.
    /// X20.
    /// Y20.
    /// X0.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G150 P100 G41 D1 X0. Y0. Z-5. Q2. R2. I7. F200.
    /// G40 X0. Y0.
    /// M30
    /// O100
    /// G1 Y20.
    /// X-14.
    /// G3 X-20. Y14. R6.
    /// G1 Y-20.
    /// X20.
    /// Y20.
    /// X0.
    /// M99
    /// ```
    /// ## How to fix it
    /// * Take a smaller tool.
    /// * Or give the inside arc a radius that is larger than that of the tool.
    /// * If the diameter of the tool is wrong, correct it under `[tools]`.
    rule "pocket-arc-below-tool" in "machine" {
        summary: "pocket with an inside arc smaller than its tool",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(PocketArcBelowTool) },
    }
}

struct PocketArcBelowTool;

impl PathRule for PocketArcBelowTool {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::Cycle(CycleFault::ArcBelowTool { arc, tool }) = *fault else { return };
        let Some(code) = cycle_code(cx) else { return };
        let (name, entry) = (code.number(), code.entry());
        let inch = cx.state().units(cx.model) == Some(Units::Inch);
        let shown = |mm: f64| if inch { format!("{:.4} in", mm / 25.4) } else { format!("{mm:.3} mm") };
        let there = arc_of(cx, if inch { arc / 25.4 } else { arc });
        let finding = cx
            .finding(
                &META,
                cx.letter_range('D'),
                format!("the tool is larger than an inside arc of the pocket (`{name}`)"),
            )
            .label(format!("radius {}; the smallest inside arc has {}", shown(tool), shown(arc)))
            .note(format!(
                "under cutter compensation an inside arc below the tool's radius is an alarm  [HM17 p.141; {}]",
                entry.source
            ))
            .help("take a smaller tool, or a larger radius in the outline")
            .at_most(limit(entry.confidence));
        report.add(match there {
            Some(there) => finding.also(there, "the arc"),
            None => finding,
        });
    }
}

/// Numbers of a program may differ by this much from the radius that they come to.
const ROUNDED: f64 = 2e-3;

/// Bytes of the first block of the outline whose words give an arc of a radius in units of the program; `None` when they are
/// computed.
fn arc_of(cx: &PathCx<'_>, radius: f64) -> Option<Range<u32>> {
    let blocks = outline_of(cx)?;
    let is_arc = |block: &u32| {
        let place = cx.place_of(At { file: 0, block: *block })?;
        let words = place.table.words(place.block());
        let number = |letter: u8| words.iter().find(|word| word.letter.ascii() == letter)?.number();
        let (i, j) = (number(b'I'), number(b'J'));
        let centre = (i.is_some() || j.is_some()).then(|| i.unwrap_or(0.0).hypot(j.unwrap_or(0.0)));
        let is_motion =
            !words.iter().any(|word| matches!(cx.model.effect(word.code), Effect::Rapid | Effect::Linear));
        let found = number(b'R').map(f64::abs).or(centre).filter(|_| is_motion)?;
        Some((found - radius).abs() <= ROUNDED)
    };
    let block = blocks.into_iter().find(|block| is_arc(block) == Some(true))?;
    cx.range_of(At { file: 0, block })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in, findings, only};

    /// A pocket whose upper left corner is rounded.
    fn pocket(side: &str, corner: &str) -> String {
        format!(
            "G21 G90 G54 G0 X0. Y0.\nG150 P100 {side} D1 X0. Y0. Z-5. Q2. R2. I7. F200.\nG40 X0. Y0.\nM30\nO100\nG1 Y20.\n{corner}G1 Y-20.\nX20.\nY20.\nX0.\nM99\n"
        )
    }

    #[test]
    fn an_arc_around_the_inside_counts_and_one_around_the_outside_does_not() {
        let world = || World::of_examples(&META);
        check_rule_in(
            &RULE,
            "haas-mill",
            &pocket("G41", "X-18.\nG3 X-20. Y18. R2.\n"),
            &world(),
            &expect![[r#"
                2 | G150 P100 G41 D1 X0. Y0. Z-5. Q2. R2. I7. F200.
                  |               ^^ error[pocket-arc-below-tool] the tool is larger than an inside arc of the pocket (`G150`)
            "#]],
        );
        check_rule_in(
            &RULE,
            "haas-mill",
            &pocket("G41", "X-18.\nG2 X-20. Y18. R2.\n"),
            &world(),
            &expect![[""]],
        );
        check_rule_in(&RULE, "haas-mill", &pocket("G41", "X-20.\n"), &world(), &expect![[""]]);
    }

    #[test]
    fn the_arc_is_shown() {
        let program = pocket("G41", "X-18.\nG3 X-20. Y18. R2.\n");
        let found = findings(&only(&RULE), "haas-mill", &program, &World::of_examples(&META));
        let arc = &program[found[0].labels[0].range.start as usize..found[0].labels[0].range.end as usize];
        assert_eq!(arc, "G3 X-20. Y18. R2.");
    }

    #[test]
    fn without_compensation_or_a_known_tool_nothing_is_known() {
        let corner = "X-18.\nG3 X-20. Y18. R2.\n";
        check_rule_in(&RULE, "haas-mill", &pocket("", corner), &World::of_examples(&META), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &pocket("G41", corner), &expect![[""]]);
    }
}
