//! A rotary axis that turns while the work offset follows the table.

use gcheck_controls::Effect;
use gcheck_engine::{At, Axis, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A rotary axis turns while the dynamic work offset is on (`G254`).
    ///
    /// ## Why it matters
    /// The control computes the place of the part once, for the angles at which `G254` was switched on. When the table
    /// turns on, the offset stays where the part was, and the tool goes there.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0. B90. C0.
    /// G43 H1 Z5.
    /// G254
    /// X1. Y0.
    /// Z2.
    /// B0. C0.
    /// G255
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y0. B90. C0.
    /// G43 H1 Z5.
    /// G254
    /// X1. Y0.
    /// Z2.
    /// G255
    /// G53 Z0.
    /// B0. C0.
    /// M30
    /// ```
    rule "rotary-motion-under-dynamic-offset" in "five_axis" {
        summary: "rotary axis turned while the dynamic work offset is on",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(RotaryMotionUnderDynamicOffset { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct RotaryMotionUnderDynamicOffset {
    /// The block that switched the offset on, when it was reported last.
    told: Option<At>,
}

remembers!(RotaryMotionUnderDynamicOffset: told);

impl PathRule for RotaryMotionUnderDynamicOffset {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::DynamicOffsetOn)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let role = Role::DynamicOffset;
        if cx.state().effect(role, cx.model) != Some(Effect::DynamicOffsetOn) {
            return;
        }
        let Event::Travel(travel) = event else { return };
        let turns = |axis: &Axis| {
            axis.is_rotary()
                && cx.origin().letters.contains(axis.letter())
                && travel.from.raw(*axis).to_bits() != travel.to.raw(*axis).to_bits()
        };
        let Some(axis) = Axis::ALL.into_iter().find(turns) else { return };
        let set_by = cx.definitions().set_by(Fact::Mode(role));
        if set_by.is_none() || self.told == set_by {
            return;
        }
        self.told = set_by;
        let Some(code) = cx.state().mode(role).only().and_then(|ix| cx.code_of(ix)) else { return };

        let off = cx.name_of_effect(Effect::DynamicOffsetOff).unwrap_or_default();
        let (name, letter) = (code.number(), axis.name());
        let range = cx.letter_range(letter);
        let finding = cx
            .finding(&META, range, format!("`{letter}` turns while the dynamic work offset is on (`{name}`)"))
            .label("the offset stays where the part was before the turn")
            .note(format!(
                "`{name}` ({}) is not for cutting with rotary axes, and ends before any rotary motion  [{}]",
                code.entry().title,
                code.entry().source
            ))
            .help(format!("end it with `{off}`, turn the axis, then switch it on again"));
        report.add(cx.resting_on(finding, Fact::Mode(role), &format!("`{name}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn once_for_each_time_that_it_is_on() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0. B90. C0.\nG43 H1 Z5.\nG254\nX1. Y0.\nZ2.\nG1 Z0. B85. F20.\nZ1. B80.\nG255\nG254\nX1. Y0.\nZ2.\n\
             G0 C5.\nG255\nM30\n",
            &expect![[r#"
                6 | G1 Z0. B85. F20.
                  |        ^^^^ warning[rotary-motion-under-dynamic-offset] `B` turns while the dynamic work offset is on (`G254`)
                12 | G0 C5.
                   |    ^^^ warning[rotary-motion-under-dynamic-offset] `C` turns while the dynamic work offset is on (`G254`)
            "#]],
        );
    }

    #[test]
    fn a_word_that_turns_nothing() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0. B90. C0.\nG43 H1 Z5.\nG254\nX1. Y0. B90.\nG255\nM30\n",
            &expect![[""]],
        );
    }
}
