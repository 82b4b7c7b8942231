//! A pocket whose strokes are further apart than its tool is wide.

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, Domain as _, Units};
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::cycles::is_round_pocket;
use crate::facts::offset_schemes::whole;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The strokes that clear a pocket are further apart than the diameter of the tool.
    ///
    /// ## Why it matters
    /// A ridge remains between the strokes, as high as the layer is deep.
    ///
    /// ## Reported
    /// Tool 1 has a diameter of 10 mm:
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G150 P100 G41 D1 X0. Y0. Z-5. Q2. R2. I12. F200.
    /// G40 X0. Y0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G150 P100 G41 D1 X0. Y0. Z-5. Q2. R2. I7. F200.
    /// G40 X0. Y0.
    /// M30
    /// ```
    /// ## How to fix it
    /// * Step by less than the diameter of the tool (`I`, `J`), usually by half to three quarters of it.
    /// * If the diameter of the tool is wrong, correct it under `[tools]`.
    rule "pocket-step-above-tool" in "machine" {
        summary: "pocket with strokes further apart than its tool is wide",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(PocketStepAboveTool) },
    }
}

struct PocketStepAboveTool;

impl PathRule for PocketStepAboveTool {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // A round pocket grows by `Q`, any other by `I` or `J`.
        let steps: &[char] = if cx.has_effect(|effect| effect == Effect::GeneralPocket) {
            &['I', 'J']
        } else if cx.has_effect(is_round_pocket) {
            &['Q']
        } else {
            return;
        };
        let number = match cx.word('D') {
            Some(_) => cx.known_number('D'),
            None => Abstract::known(cx.state().d()),
        };
        let number = number.and_then(whole);
        let Some(unit) = cx.state().units(cx.model).map(Units::in_mm) else { return };
        let tool = number.filter(|number| *number > 0).and_then(|number| cx.state().tables().tool(number));
        let Some(diameter) = tool.map(|tool| tool.size().0).filter(|diameter| *diameter > 0.0) else {
            return;
        };
        for &letter in steps {
            // Without a point, a setting decides the number's unit.
            let pointed = cx.model.semantics().computed_words_are_pointed;
            let is_length = |word: &Word| word.shape.point || word.is_computed() && pointed;
            let Some(step) = cx.word(letter).filter(is_length).and_then(|_| cx.known_number(letter)) else {
                continue;
            };
            if step * unit <= diameter * 1.000_001 {
                continue;
            }
            let shown =
                |mm: f64| if unit > 1.0 { format!("{:.4} inch", mm / unit) } else { format!("{mm:.3} mm") };
            report.add(
                cx.finding(
                    &META,
                    cx.letter_range(letter),
                    "the pocket's strokes are further apart than the tool is wide",
                )
                .label(format!("strokes {} apart", shown(step * unit)))
                .note(format!("tool {} has a diameter of {}", number.unwrap_or_default(), shown(diameter)))
                .help("step by less than the diameter, usually by half to three quarters of it"),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn inches_and_tools_of_unknown_size() {
        let program = "G20 G90 G54 G0 X0. Y0.\nG41 D1\nG150 P100 X0. Y0. Z-.5 Q.2 R.1 J.4 F20.\nG150 P100 D9 X0. Y0. Z-.5 Q.2 R.1 J.4 F20.\nG150 P100 D#1 X0. Y0. Z-.5 Q.2 R.1 J#2 F20.\nM30\n";
        check_rule_in(
            &RULE,
            "haas-mill",
            program,
            &World::of_examples(&META),
            &expect![[r#"
            3 | G150 P100 X0. Y0. Z-.5 Q.2 R.1 J.4 F20.
              |                                ^^^ warning[pocket-step-above-tool] the pocket's strokes are further apart than the tool is wide
        "#]],
        );
        check_rule(&RULE, "haas-mill", program, &expect![[""]]);
    }
}
