//! A tap that runs on past its bottom while the spindle slows down.

use std::collections::BTreeSet;

use gcheck_controls::{Effect, TapRules};
use gcheck_engine::{Abstract, At, Domain, Event, Fact};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::reach;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A rigid tap turns so fast that it makes more than two turns past its bottom before the spindle turns the other way.
    ///
    /// The rule holds for controls that reverse the spindle at the bottom, and it needs the acceleration of the spindle
    /// (`[machine] spindle_acceleration`). Other controls slow the spindle down on the way, so that it rests at the bottom.
    /// Each speed is reported once.
    ///
    /// ## Why it matters
    /// The axis follows the spindle for as long as it turns. In a blind hole the tap runs into the ground and breaks.
    ///
    /// ## Reported
    /// On a machine whose spindle gains 500 rpm in a second; from 1000 rpm it makes 16 turns to a stop:
    /// ```nc,reported,linuxcnc
    /// G21 G90 G17 S1000 M3
    /// G0 X0 Y0 Z5
    /// G33.1 Z-20 K1
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G17 S300 M3
    /// G0 X0 Y0 Z5
    /// G33.1 Z-20 K1
    /// M2
    /// ```
    /// ## How to fix it
    /// * Tap slower: the finding gives the speed from which the spindle stops in time.
    /// * Or end the thread higher, by what the tap goes on.
    /// * If the spindle is faster, correct `spindle_acceleration` under `[machine]`.
    rule "tap-runs-past-bottom" in "machine" {
        summary: "tap runs far past its bottom",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(TapRunsPastBottom::default()) },
    }
}

/// Turns past the bottom for which programmers leave room.
const USUAL: f64 = 2.0;

#[derive(Default, Clone, PartialEq)]
struct TapRunsPastBottom {
    /// Millimetres a turn, of the tap under way.
    lead: Option<f64>,
    /// The blocks whose speed was reported.
    told: BTreeSet<Option<At>>,
}

remembers!(TapRunsPastBottom: told);

impl PathRule for TapRunsPastBottom {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().motion().taps == TapRules::RunOut
            && program.environment.machine.engine.dynamics.spindle_acceleration.is_some()
            && program.may(|effect| effect == Effect::RigidTap)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let (from, to) = match event {
            Event::SpindleSync { lead, .. } => {
                self.lead = lead.map(|lead| lead.0.abs());
                return;
            }
            // Blocks of other files are judged when those files are checked.
            Event::RigidTap { from, to, .. } if cx.origin().at.file == 0 => (from, to),
            _ => return,
        };
        let lead = self.lead.or_else(|| Abstract::bounds(cx.state().feed()).map(|(lowest, _)| lowest));
        let gain = cx.environment.machine.engine.dynamics.spindle_acceleration;
        let (Some(lead), Some(gain), Some(speed)) = (lead, gain, reach::turns(cx, from, to)) else { return };
        // A spindle that loses speed evenly makes half as many turns as it would have at full speed.
        let turns = speed * speed / (2.0 * gain.0 * 60.0);
        if turns <= USUAL || cx.is_called_only() || !self.told.insert(cx.definitions().set_by(Fact::Speed)) {
            return;
        }
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!("the tap runs {} past its bottom", cx.shown(Mm(turns * lead))),
            )
            .label(format!("{turns:.1} turns of {} until the spindle stops", cx.shown(Mm(lead))))
            .note(format!("at {speed:.0} rpm the spindle takes {:.1} s to stop", speed / gain.0))
            .help(format!(
                "tap at no more than {:.0} rpm, or end the thread so much higher",
                (USUAL * 2.0 * gain.0 * 60.0).sqrt().floor()
            ));
        report.add(cx.resting_on(finding, Fact::Speed, "the speed"));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn a_speed_is_told_once() {
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G20 G90 S600 M3\nG0 X0 Y0 Z.2\nG33.1 Z-1 K.05\nG0 X1\nG33.1 Z-1 K.05\nS100\nG33.1 Z-1 K.05\nM2\n",
            &World::of_examples(&META),
            &expect![[r#"
                3 | G33.1 Z-1 K.05
                  | ^^^^^^^^^^^^^^ warning[tap-runs-past-bottom] the tap runs 0.3 in past its bottom
            "#]],
        );
    }

    #[test]
    fn a_control_that_rests_at_the_bottom_has_nothing_to_say() {
        check_rule_in(
            &RULE,
            "haas-mill",
            "G21 G90 S3000 M3\nG0 X0. Y0. Z5.\nG84 X0. Y0. Z-5. R2. F3000.\nG80\nM30\n",
            &World::of_examples(&META),
            &expect![[""]],
        );
    }

    #[test]
    fn nothing_configured_nothing_said() {
        check_rule(&RULE, "linuxcnc", "G21 S3000 M3\nG0 X0 Z5\nG33.1 Z-10 K1\nM2\n", &expect![[""]]);
    }
}
