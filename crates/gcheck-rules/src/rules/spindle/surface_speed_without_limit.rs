//! Constant surface speed without a limit.

use gcheck_controls::{Effect, Machine};
use gcheck_engine::{At, Event, Fact, Role, Spindle};

use crate::declare::declare_rule;
use crate::facts::cutting::is_cut;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block cuts at constant surface speed (`G96`) without a limit of the spindle speed (`G50 S`, `G92 S`, `D`), or a lathe
    /// does so with a limit above 10,000 rpm, which no chuck reaches.
    ///
    /// ## Why it matters
    /// Toward the centre the spindle speed rises to the machine's highest. A chuck that loses its grip throws the part.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// T0101
    /// G96 S200 M3
    /// G0 X50. Z2.
    /// G1 X0. F.2
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// T0101
    /// G50 S2000
    /// G96 S200 M3
    /// G1 X0. F.2
    /// M30
    /// ```
    /// ```nc,quiet,linuxcnc
    /// G21 G96 D2000 S200 M3
    /// G1 X10 F100
    /// M2
    /// ```
    rule "surface-speed-without-limit" in "spindle" {
        summary: "constant surface speed without a limit",
        severity: Warning,
        tier: Path,
        control_specific: true,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(SurfaceSpeedWithoutLimit { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct SurfaceSpeedWithoutLimit {
    /// The block that set the mode where it was reported last.
    told: Option<At>,
}

remembers!(SurfaceSpeedWithoutLimit: told);

/// No lathe turns a chuck faster: 1/min.
const MOST: f64 = 10_000.0;

impl PathRule for SurfaceSpeedWithoutLimit {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::SurfaceSpeed)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        let Some(Effect::SurfaceSpeed) = state.effect(Role::SpindleMode, cx.model) else { return };
        let set_by = cx.definitions().set_by(Fact::Mode(Role::SpindleMode));
        let limit = state.speed_limit();
        let is_lathe = cx.control().machine() == Machine::Lathe;
        // An unknown limit is a limit.
        let is_limited = limit != f64::INFINITY && !(is_lathe && limit > MOST);
        if set_by.is_none() || set_by == self.told || is_limited || state.spindle() == Some(Spindle::Stopped)
        {
            return;
        }
        if !is_cut(cx, event) || cx.is_called_only() {
            return;
        }
        let Some(code) = state.mode(Role::SpindleMode).only() else { return };
        self.told = set_by;
        let name = cx.name_of(code);
        if limit.is_finite() {
            let message = format!("the limit of the spindle speed is {limit} rpm (`{name}`)");
            let finding = cx
                .finding(&META, cx.range(), message)
                .label("no chuck turns so fast: this limits nothing")
                .help("check the limit for a zero too many");
            report.add(finding);
            return;
        }
        let limiter = cx.name_of_effect(Effect::SpeedLimitOrSetPosition);
        let help = match &limiter {
            Some(limiter) => format!("give the limit before this: `{limiter} S2000`"),
            None => format!("give the limit in the same block: `{name} D2000`"),
        };
        let finding = cx
            .finding(&META, cx.range(), format!("constant surface speed has no limit (`{name}`)"))
            .label("the spindle may reach its highest speed")
            .assuming("no earlier program left a limit")
            .help(help);
        report.add(cx.resting_on(finding, Fact::Mode(Role::SpindleMode), &format!("`{name}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_start_of_the_mode_is_told_once() {
        check_rule(
            &RULE,
            "haas-lathe",
            "T101\nG96 S200 M3\nG1 X1. F.01\nM8\nX.5\nG97 S500\nG1 X1.\nG96 S300\nG1 X0.\nM30\n",
            &expect![[r#"
                3 | G1 X1. F.01
                  | ^^^^^^^^^^^ warning[surface-speed-without-limit] constant surface speed has no limit (`G96`)
                9 | G1 X0.
                  | ^^^^^^ warning[surface-speed-without-limit] constant surface speed has no limit (`G96`)
            "#]],
        );
    }

    #[test]
    fn a_limit_with_a_zero_too_many_is_none() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "T0101\nG50 S25000\nG96 S200 M3\nG1 X0. F.2\nM30\n",
            &expect![[r#"
            4 | G1 X0. F.2
              | ^^^^^^^^^^ warning[surface-speed-without-limit] the limit of the spindle speed is 25000 rpm (`G96`)
        "#]],
        );
    }

    #[test]
    fn a_limit_after_the_mode_will_do() {
        check_rule(&RULE, "haas-lathe", "T101\nG96 S200 M3\nG50 S2000\nG1 X0. F.01\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_limit_of_unknown_value_is_a_limit() {
        check_rule(&RULE, "fanuc-lathe", "T0101\nG50 S#500\nG96 S200 M3\nG1 X0. F.2\nM30\n", &expect![[""]]);
    }
}
