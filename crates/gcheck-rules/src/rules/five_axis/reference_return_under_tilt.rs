//! A reference return while the control places the tool by the angles of table or head.

use gcheck_controls::Effect;
use gcheck_engine::{At, Fact, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A reference return (`G28`, `G29`) while tool centre point control (`G234`) or the dynamic work offset (`G254`) is on.
    ///
    /// ## Why it matters
    /// Both move where the axes go for a programmed point, the point in between as well. The manual asks to end them
    /// before a return; `G53` ignores them and retracts for certain.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 B90. C0.
    /// G43 H1 Z5.
    /// G254
    /// X1. Y0.
    /// Z2.
    /// G28 G91 Z0.
    /// G90 G255
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 B90. C0.
    /// G43 H1 Z5.
    /// G254
    /// X1. Y0.
    /// Z2.
    /// G255
    /// G28 G91 Z0.
    /// M30
    /// ```
    rule "reference-return-under-tilt" in "five_axis" {
        summary: "reference return while the control follows the tilt",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(ReferenceReturnUnderTilt { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct ReferenceReturnUnderTilt {
    /// The block that switched the mode on, when it was reported last.
    told: Option<At>,
}

remembers!(ReferenceReturnUnderTilt: told);

/// Modes that follow the tilt, with the codes that end them.
const TILTS: [(Role, Effect, Effect); 2] = [
    (Role::DynamicOffset, Effect::DynamicOffsetOn, Effect::DynamicOffsetOff),
    (Role::Length, Effect::ToolCentrePoint, Effect::LengthOff),
];

impl PathRule for ReferenceReturnUnderTilt {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| TILTS.iter().any(|(_, on, _)| *on == effect)) && program.may(returns)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(returns) {
            return;
        }
        for (role, on, off) in TILTS {
            let ends_here = cx.has_effect(|effect| effect == off);
            let set_by = cx.definitions().set_by(Fact::Mode(role));
            if ends_here
                || cx.state().effect(role, cx.model) != Some(on)
                || set_by.is_none()
                || self.told == set_by
            {
                continue;
            }
            self.told = set_by;
            let Some(code) = cx.state().mode(role).only().and_then(|ix| cx.code_of(ix)) else { continue };
            let name = code.number();
            let off = cx.name_of_effect(off).unwrap_or_default();
            let finding = cx
                .finding(&META, cx.effect_range(returns), format!("reference return while `{name}` is on"))
                .label("not to be used together")
                .note(format!(
                    "`{name}` ({}) ends before a return  [{}]",
                    code.entry().title,
                    code.entry().source
                ))
                .help(format!("end it with `{off}` first, or retract with `G53`"));
            report.add(cx.resting_on(finding, Fact::Mode(role), &format!("`{name}`")));
        }
    }
}

/// Does the code go to a reference position, or back from it?
fn returns(effect: Effect) -> bool {
    matches!(effect, Effect::ReturnReference(_) | Effect::ReturnFromReference)
}
