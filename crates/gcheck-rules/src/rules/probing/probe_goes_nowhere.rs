//! A probing move that goes nowhere.

use gcheck_engine::{Event, Touch};

use crate::declare::declare_rule;
use crate::facts::compensation::may_be_on;
use crate::facts::probing::{driven, is_probing_move, is_touch, probing_code};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A probing move ends where the probe already is.
    ///
    /// ## Why it matters
    /// The probe touches nothing, and the control takes its position as the surface: in `#5061` and up, and in the
    /// table that the code writes.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G31 Y5. F10. M75
    /// G91 G0 Y-8.
    /// G136 Y1. F10.
    /// G90
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G31 Y4. F10. M75
    /// G91 G0 Y-8.
    /// G136 Y1. F10.
    /// G90
    /// M30
    /// ```
    rule "probe-goes-nowhere" in "probing" {
        summary: "probing move that ends where it begins",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(ProbeGoesNowhere) },
    }
}

struct ProbeGoesNowhere;

impl PathRule for ProbeGoesNowhere {
    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if !is_probing_move(event) || !cx.has_effect(is_touch) || may_be_on(cx) {
            return;
        }
        let Touch::Made(ways) = cx.state().touched() else { return };
        if needs_axis(cx) || driven(ways).next().is_some() || !has_known_axes(cx) {
            return;
        }
        let name = probing_code(cx).map(|code| cx.name_of(code)).unwrap_or_default();
        report.add(
            cx.finding(&META, cx.range(), format!("probing move that goes nowhere (`{name}`)"))
                .label("the target is the probe's present position")
                .help("give a target beyond the surface to be touched"),
        );
    }
}

/// Does the block lack an axis that another rule asks for?
fn needs_axis(cx: &PathCx<'_>) -> bool {
    let code = probing_code(cx).and_then(|code| cx.code_of(code));
    !cx.names_axes() && code.is_none_or(|code| !code.entry().one_of.is_empty())
}

/// Do all axis words of the block have a value that is known? A variable without a value makes the control ignore its word.
fn has_known_axes(cx: &PathCx<'_>) -> bool {
    let control = cx.control();
    let Some(place) = cx.place() else { return false };
    let words = place.table.words(place.block());
    let mut axes = words.iter().filter(|word| control.letter(word.letter).is_some_and(|entry| entry.axis));
    axes.all(|word| word.number().is_some() || cx.known_number(word.letter.ascii().into()).is_some())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn an_increment_of_nothing_goes_nowhere_from_anywhere() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 Y0. F10.\nG36 Y0. X1. F10.\nG90\nM30\n",
            &expect![[r#"
            1 | G91 G31 Y0. F10.
              | ^^^^^^^^^^^^^^^^ warning[probe-goes-nowhere] probing move that goes nowhere (`G31`)
        "#]],
        );
    }

    #[test]
    fn a_computed_target_is_one() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y5.\n#1=5.\nG31 Y#1 F10. M79\n#1=4.\nG31 Y#1 F10. M79\nM30\n",
            &expect![[r#"
                3 | G31 Y#1 F10. M79
                  | ^^^^^^^^^^^^^^^^ warning[probe-goes-nowhere] probing move that goes nowhere (`G31`)
            "#]],
        );
    }

    #[test]
    fn a_tool_length_is_measured_as_far_as_it_takes() {
        check_rule(&RULE, "haas-mill", "G90 G43 H1 Z0.\nG37 H1 Z0. F10.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn no_axis_at_all_is_no_way_either() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 Y1. F5. M75\nG0 Y4.\nG35 D1 F5.\nG36 F5.\nG90\nM30\n",
            &expect![[r#"
                3 | G35 D1 F5.
                  | ^^^^^^^^^^ warning[probe-goes-nowhere] probing move that goes nowhere (`G35`)
            "#]],
        );
    }

    #[test]
    fn an_argument_that_only_the_caller_knows_may_be_a_way() {
        check_rule(&RULE, "fanuc-mill", "O9103\nG91 G31 Y#25 F10.\nM99\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "G91 G31 Y[#100*2.] F10.\nG90\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_start_that_nobody_knows_is_no_mistake() {
        check_rule(&RULE, "fanuc-mill", "G31 Y5. F10.\nM30\n", &expect![[""]]);
    }
}
