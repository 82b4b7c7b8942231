//! The touch of a probing move that need not touch, used without a look at whether it did.

use std::ops::Range;

use gcheck_controls::{Effect, LetterSet, SystemValue};
use gcheck_engine::Ending;

use crate::declare::declare_rule;
use crate::facts::probing::{column_of, reads, touches_work};
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A probing move that goes on without a touch (`G38.3`) is followed by a use of the touch (`#5063`), and nothing reads whether there was
    /// one (`#5070`).
    ///
    /// ## Why it matters
    /// If the probe touches nothing, the program goes on with the end of the move, as if the part were there. The move that stops
    /// with an alarm (`G38.2`) does not.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G17 G90 G94 G54
    /// G0 X20 Y20 Z10
    /// G38.3 Z-5 F60
    /// #<top> = #5063
    /// G0 Z10
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G17 G90 G94 G54
    /// G0 X20 Y20 Z10
    /// G38.3 Z-5 F60
    /// o1 if [#5070 EQ 0]
    /// (abort, nothing touched)
    /// o1 endif
    /// #<top> = #5063
    /// G0 Z10
    /// M2
    /// ```
    rule "touch-never-checked" in "probing" {
        summary: "touch used without a look at whether there was one",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::ALL_BLOCKS.union(Watch::ENDS),
            make: || Box::new(TouchNeverChecked::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct TouchNeverChecked {
    /// The code of the last probing move, if that goes on without a touch.
    probed: Option<Range<u32>>,
    /// The first use of its touch.
    used: Option<Range<u32>>,
    /// It goes away from the part.
    is_away: bool,
    /// The axes that its block names.
    axes: LetterSet,
}

remembers!(TouchNeverChecked: probed, used);

/// Words of axes.
const AXES: LetterSet = LetterSet::of("XYZABCUVW");

impl PathRule for TouchNeverChecked {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    /// Another way may look.
    fn counts_on_some_path(&self) -> bool {
        false
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(need_not_touch)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.look(cx);
        if cx.has_effect(touches_work) {
            let axes = cx.origin().letters.and(AXES);
            // A second touch along the same axes that alarms makes up for a coarse one that was not looked at.
            if cx.has_effect(need_not_touch) || axes != self.axes {
                self.tell(cx, report);
            }
            (self.used, self.axes) = (None, axes);
            self.probed = cx.has_effect(need_not_touch).then(|| cx.effect_range(need_not_touch));
            self.is_away = cx.has_effect(|effect| effect == Effect::ProbeAwayOptional);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, _: Ending, report: &mut Report<'_>) {
        if !cx.is_called_only() {
            self.tell(cx, report);
        }
    }
}

impl TouchNeverChecked {
    /// What the block reads.
    fn look(&mut self, cx: &PathCx<'_>) {
        if self.probed.is_none() {
            return;
        }
        for number in reads(cx) {
            let holds = |value| number.is_some_and(|number| column_of(cx, number, value).is_some());
            if holds(SystemValue::ProbePosition) {
                self.used.get_or_insert_with(|| cx.range());
            } else if number.is_none() || holds(SystemValue::ProbeResult) {
                // A computed number may be that of the result.
                self.probed = None;
            }
        }
    }

    fn tell(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Self { probed, used, is_away, axes: _ } = std::mem::take(self);
        let (Some(probed), Some(used)) = (probed, used) else { return };
        if !cx.is_on_every_path() {
            return;
        }
        let alarms = if is_away { Effect::ProbeAway } else { Effect::ProbeToward };
        let alarms = cx.name_of_effect(alarms).unwrap_or_default();
        report.add(
            cx.finding(&META, probed, "nothing looks whether this probing move has touched")
                .label("the program goes on without a touch")
                .also(used, "its touch is used here")
                .help(format!("probe with `{alarms}`, which stops without a touch, or test the result before the touch is used")),
        );
    }
}

/// Does the move go on where nothing is touched, on a control that also has one that stops?
fn need_not_touch(effect: Effect) -> bool {
    matches!(effect, Effect::ProbeTowardOptional | Effect::ProbeAwayOptional)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_code_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G0 Z10\nG38.3 Z-5 F60\n#<top> = #5063\nM2\n",
            &expect![[r#"
            2 | G38.3 Z-5 F60
              | ^^^^^ warning[touch-never-checked] nothing looks whether this probing move has touched
        "#]],
        );
        check_rule(&RULE, "linuxcnc", "G21 G90 G0 Z10\nG38.2 Z-5 F60\n#<top> = #5063\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_touch_that_is_not_used_needs_no_look() {
        check_rule(&RULE, "linuxcnc", "G21 G90 G0 Z10\nG38.3 Z-5 F60\nG0 Z10\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_second_touch_that_alarms() {
        let program = |second: &str| {
            format!(
                "G21 G17 G90 G94 G54\nG0 X20 Y20 Z10\nG38.3 Z-5 F60\nG0 Z[#5063+1]\n{second} Z-5 F10\n#<top>=#5063\nM2\n"
            )
        };
        check_rule(&RULE, "linuxcnc", &program("G38.2"), &expect![[""]]);
        check_rule(
            &RULE,
            "linuxcnc",
            &program("G38.3"),
            &expect![[r#"
                3 | G38.3 Z-5 F60
                  | ^^^^^ warning[touch-never-checked] nothing looks whether this probing move has touched
                5 | G38.3 Z-5 F10
                  | ^^^^^ warning[touch-never-checked] nothing looks whether this probing move has touched
            "#]],
        );
    }
}
