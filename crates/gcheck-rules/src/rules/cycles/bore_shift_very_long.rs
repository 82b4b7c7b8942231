//! A fine or back bore that brings the tool far off the wall.

use gcheck_controls::{Effect, Unpointed};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cuts::cutter_radius;
use crate::facts::units;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// The shift of a fine bore (`Q` of `G76`) is more than 8 mm (0.31 inch), or that of a back bore more than 25 mm (1 inch). Of a
    /// tool whose size the machine file gives, its radius counts instead. Where the program does not state its units, a shift is
    /// reported that is too long in both.
    ///
    /// ## Why it matters
    /// At the bottom the control moves the bar by the shift, whatever the bore is: the back of the bar may run into the other
    /// side. Some tenths of a millimetre bring the edge off the wall.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0. Z10. S900 M3
    /// G76 Z-20. R2. Q30. F60.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X0. Y0. Z10. S900 M3
    /// G76 Z-20. R2. Q.3 F60.
    /// G80
    /// M30
    /// ```
    rule "bore-shift-very-long" in "cycles" {
        summary: "fine bore that shifts the tool far off the wall",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(BoreShiftVeryLong) },
    }
}

struct BoreShiftVeryLong;

/// Millimetres: more than an edge needs to come off the wall.
const MOST: f64 = 8.0;
/// Millimetres: a back bore goes through a hole that is smaller than its own.
const MOST_OF_BACK_BORE: f64 = 25.0;

impl PathRule for BoreShiftVeryLong {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().machine() == gcheck_controls::Machine::Mill
            && program.may(|effect| most(effect).is_some())
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let codes = cx.codes();
        let Some((code, most)) = codes.iter().find_map(|ix| Some((*ix, most(cx.model.effect(*ix))?))) else {
            return;
        };
        let (Some(q), Some(of_program), Some(word)) =
            (cx.known_number('Q'), cx.state().units(cx.model), cx.word('Q'))
        else {
            return;
        };
        // What a number without a point counts, settings decide.
        let is_clear = word.shape.point
            || word.is_computed()
            || cx.control().numbers().unpointed == Unpointed::AsWritten;
        let shift = q.abs() * of_program.in_mm();
        // A bar has less room behind it than its own radius.
        let own = cutter_radius(cx);
        let most = own.unwrap_or(most);
        let [least, _] = units::range(cx, shift);
        // False for a length that is not known.
        let is_long = least > most;
        if !is_clear || cx.is_malformed() || !is_long {
            return;
        }
        let room = match own {
            Some(radius) => {
                format!("the tool has the radius of {} of the machine file", cx.shown(Mm(radius)))
            }
            None => format!("the bar has no more than {} of room behind it", cx.shown(Mm(most))),
        };
        report.add(
            cx.finding(
                &META,
                cx.letter_range('Q'),
                format!("the bar shifts by {} off the wall (`{}`)", cx.shown(Mm(shift)), cx.name_of(code)),
            )
            .label("its back may run into the other side of the bore")
            .assuming(room)
            .help("check the decimal point of `Q`"),
        );
    }
}

fn most(effect: Effect) -> Option<f64> {
    match effect {
        Effect::CycleFineBore => Some(MOST),
        Effect::CycleBackBore => Some(MOST_OF_BACK_BORE),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn in_both_units_and_for_a_back_bore() {
        let program = |cycle: &str| format!("G20 G90 G54 G0 X0. Y0. Z1. S900 M3\n{cycle} F5.\nG80\nM30\n");
        check_rule(
            &RULE,
            "haas-mill",
            &program("G76 Z-.6 R.1 Q.5"),
            &expect![[r#"
                2 | G76 Z-.6 R.1 Q.5 F5.
                  |              ^^^ warning[bore-shift-very-long] the bar shifts by 0.5 in off the wall (`G76`)
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program("G77 Z-.5 R-1.6 Q1.2"),
            &expect![[r#"
                2 | G77 Z-.5 R-1.6 Q1.2 F5.
                  |                ^^^^ warning[bore-shift-very-long] the bar shifts by 1.2 in off the wall (`G77`)
            "#]],
        );
        for cycle in ["G76 Z-.6 R.1 Q.2", "G77 Z-.5 R-1.6 Q.7", "G83 Z-.6 R.1 Q.5"] {
            check_rule(&RULE, "haas-mill", &program(cycle), &expect![[""]]);
        }
        // As millimetres it is right.
        let unstated = program("G76 Z-.6 R.1 Q.5").replace("G20 ", "");
        check_rule(&RULE, "haas-mill", &unstated, &expect![[""]]);
        // Steps of the control, or inches: a parameter decides.
        check_rule(&RULE, "fanuc-mill", &program("G76 Z-.6 R.1 Q100"), &expect![[""]]);
    }
}
