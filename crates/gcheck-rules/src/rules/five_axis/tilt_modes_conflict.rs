//! Two modes that both follow the tilt of table or head.

use gcheck_controls::Effect;
use gcheck_engine::{At, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::modes::forbids;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// Tool centre point control (`G234`) is switched on while the dynamic work offset (`G254`) is on, or the other way round.
    ///
    /// ## Why it matters
    /// Both turn the programmed point by the angles of the rotary axes. The control refuses the two together.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 B47. C116.
    /// G254
    /// X1. Y0.
    /// G234 H1 Z1.
    /// G49
    /// G255
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 B47. C116.
    /// G254
    /// X1. Y0.
    /// G255
    /// G234 H1 Z1.
    /// G49
    /// M30
    /// ```
    rule "tilt-modes-conflict" in "five_axis" {
        summary: "two modes together that both follow the tilt",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(TiltModesConflict { told: Vec::new() }) },
    }
}

#[derive(Clone, PartialEq)]
struct TiltModesConflict {
    /// Blocks that were reported.
    told: Vec<At>,
}

remembers!(TiltModesConflict: told);

/// The modes, with the codes that end them.
const TILTS: [(Role, Effect, Effect); 2] = [
    (Role::DynamicOffset, Effect::DynamicOffsetOn, Effect::DynamicOffsetOff),
    (Role::Length, Effect::ToolCentrePoint, Effect::LengthOff),
];

impl PathRule for TiltModesConflict {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        TILTS.iter().all(|(_, on, _)| program.may(|effect| effect == *on))
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        for (role, on, off) in TILTS {
            let stays_on =
                cx.state().effect(role, cx.model) == Some(on) && !cx.has_effect(|effect| effect == off);
            let is_other =
                |effect: Effect| effect != on && TILTS.iter().any(|(_, other, _)| *other == effect);
            let own = cx.codes().iter().copied().find(|ix| is_other(cx.model.effect(*ix)));
            let (Some(mode), Some(code)) = (
                cx.state().mode(role).only().and_then(|ix| cx.code_of(ix)).filter(|_| stays_on),
                own.and_then(|ix| cx.code_of(ix)),
            ) else {
                continue;
            };
            let at = cx.origin().at;
            if !(forbids(code, mode) || forbids(mode, code)) || self.told.contains(&at) {
                continue;
            }
            self.told.push(at);
            let (name, other) = (code.number(), mode.number());
            let off = cx.name_of_effect(off).unwrap_or_default();
            let finding = cx
                .finding(&META, cx.effect_range(is_other), format!("`{name}` while `{other}` is on"))
                .label(format!("refused beside `{other}`"))
                .note(format!(
                    "`{name}` ({}) does not go with `{other}`  [{}]",
                    code.entry().title,
                    code.entry().source
                ))
                .help(format!("end `{other}` with `{off}` before `{name}`"))
                .at_most(limit(code.entry().confidence));
            let finding = finding.at_most(cx.environment.most_for_this_control());
            report.add(cx.resting_on(finding, Fact::Mode(role), &format!("`{other}`")));
        }
    }
}
