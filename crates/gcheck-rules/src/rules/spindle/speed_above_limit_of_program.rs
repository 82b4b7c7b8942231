//! A speed above the limit that the program itself gives.

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Role, Spindle};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The program limits the speed for constant surface speed (`G50 S2500`, `G92 S2500`), and then runs the spindle faster at
    /// a constant speed (`G97`).
    ///
    /// ## Why it matters
    /// The limit is what chuck and part bear. On most controls it holds under constant surface speed (`G96`) only, so nothing
    /// stops the spindle here: the chuck loses its grip and throws the part.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0101
    /// G50 S3000
    /// G96 S180 M3
    /// G0 X60. Z2.
    /// G1 Z-20. F.2
    /// G97 S9000
    /// G1 X62.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0101
    /// G50 S3000
    /// G96 S180 M3
    /// G0 X60. Z2.
    /// G1 Z-20. F.2
    /// G97 S900
    /// G1 X62.
    /// M30
    /// ```
    rule "speed-above-limit-of-program" in "spindle" {
        summary: "speed above the limit that the program gives the spindle",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(SpeedAboveLimitOfProgram::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct SpeedAboveLimitOfProgram {
    /// The block whose speed was reported.
    told: Option<At>,
}

remembers!(SpeedAboveLimitOfProgram: told);

impl PathRule for SpeedAboveLimitOfProgram {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::SpeedLimitOrSetPosition)
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        let limit = state.speed_limit();
        let is_constant = state.effect(Role::SpindleMode, cx.model) != Some(Effect::SurfaceSpeed);
        let turns = state.spindle().is_some_and(Spindle::turns);
        let Some(speed) = Abstract::known(state.speed()).filter(|_| is_constant && turns) else { return };
        if !(limit.is_finite() && limit > 0.0 && speed > limit) || cx.is_called_only() {
            return;
        }
        let set_by = cx.definitions().set_by(Fact::Speed);
        if set_by.is_none() || self.told == set_by {
            return;
        }
        self.told = set_by;
        let word = set_by.and_then(|at| cx.find_word(at, |word| word.letter.ascii() == b'S'));
        let limiter = cx.name_of_effect(Effect::SpeedLimitOrSetPosition).unwrap_or_default();
        report.add(
            cx.finding(
                &META,
                word.unwrap_or_else(|| cx.range()),
                format!("{speed} rpm, and the program limits the spindle to {limit} (`{limiter}`)"),
            )
            .label(format!("the limit holds under constant surface speed; {speed} rpm is run as it is"))
            .help("check `S`, or give the limit that this cut may have"),
        );
    }
}
