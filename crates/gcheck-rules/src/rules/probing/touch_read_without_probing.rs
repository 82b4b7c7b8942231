//! The position of a touch, read where nothing has probed.

use gcheck_controls::{SystemValue, SystemVariable};
use gcheck_engine::Touch;

use crate::declare::declare_rule;
use crate::facts::probing::{column_of, reads};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A block reads where the probe has touched (`#5061` and the variables after it), and no block before it probes, on every
    /// path that comes here.
    ///
    /// ## Why it matters
    /// The variable holds the touch of an earlier program, perhaps on another part. A probing code is missing, or `G1` is
    /// written for `G31` or `G38.2`: then the stylus is pushed into the part as well.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G17 G90 G94 G54
    /// G0 X20 Y20 Z10
    /// G1 Z-5 F60
    /// #<top> = #5063
    /// G0 Z10
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G17 G90 G94 G54
    /// G0 X20 Y20 Z10
    /// G38.2 Z-5 F60
    /// #<top> = #5063
    /// G0 Z10
    /// M2
    /// ```
    rule "touch-read-without-probing" in "probing" {
        summary: "position of a touch that is read before anything probes",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ALL_BLOCKS, make: || Box::new(TouchReadWithoutProbing) },
    }
}

struct TouchReadWithoutProbing;

/// The first variable of a touch that a block reads.
#[derive(Clone, Copy)]
struct OfTouch(Option<u32>);

impl PathRule for TouchReadWithoutProbing {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().semantics().system_variables.iter().any(is_touch)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.state().touched() != Touch::None || cx.is_called_only() {
            return;
        }
        let is_of_touch = |number: &u32| column_of(cx, *number, SystemValue::ProbePosition).is_some();
        let first = || OfTouch(reads(cx).into_iter().flatten().find(is_of_touch));
        let OfTouch(Some(number)) = cx.from_text(cx.origin().at, 0, first) else { return };
        report.add(
            cx.finding(&META, cx.range(), format!("`#{number}` is read, and nothing has probed before"))
                .label("holds a touch of an earlier program, or nothing")
                .assuming("the program does not rely on what another program has probed")
                .help(
                    "probe before this block; check whether another code is in the place of the probing code",
                ),
        );
    }
}

fn is_touch(variable: &SystemVariable) -> bool {
    variable.holds == SystemValue::ProbePosition
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn what_a_called_program_may_have_probed_is_not_judged() {
        check_rule(&RULE, "haas-mill", "G91 G31 Z-1. F10.\nG90\n#101=#5063\nM30\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "G65 P9811 Z-1.\n#101=#5063\nM30\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "O9100\n#101=#5063\nM99\n", &expect![[""]]);
    }

    #[test]
    fn a_way_past_the_probing_move_is_told() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X#5061\nG91 G31 X1. F10.\nG90 G0 X#5061\nM30\n",
            &expect![[r#"
                1 | G0 X#5061
                  | ^^^^^^^^^ warning[touch-read-without-probing] `#5061` is read, and nothing has probed before
            "#]],
        );
    }
}
