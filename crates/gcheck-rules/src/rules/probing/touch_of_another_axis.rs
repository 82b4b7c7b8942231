//! The touch of an axis along which the probe did not move.

use std::ops::Range;

use gcheck_controls::SystemValue;
use gcheck_engine::{Axis, Ending, Event, Touch};

use crate::declare::declare_rule;
use crate::facts::boundary::boundary;
use crate::facts::probing::{column_of, driven, reads, touches_work};
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// The program reads where the probe was along one axis (`#5061` for X, `#5062` for Y, `#5063` for Z), the probe has moved along another one,
    /// and the touch along that axis is never read.
    ///
    /// ## Why it matters
    /// The number is where the probe was, not where the part is: depths and offsets that are computed from it have nothing to do with
    /// the part. Mostly the last digit of the variable is wrong.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G17 G90 G94 G54
    /// G0 X20 Y20 Z10
    /// G38.2 Z-5 F60
    /// #<top> = #5061
    /// G0 Z10
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G17 G90 G94 G54
    /// G0 X20 Y20 Z10
    /// G38.2 Z-5 F60
    /// #<x> = #5061
    /// #<top> = #5063
    /// G0 Z10
    /// M2
    /// ```
    rule "touch-of-another-axis" in "probing" {
        summary: "touch read along an axis that the probe did not move",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::ALL_BLOCKS.union(Watch::CHANGES).union(Watch::ENDS),
            make: || Box::new(TouchOfAnotherAxis::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct TouchOfAnotherAxis {
    /// A read of another axis since the last touch.
    read: Option<Read>,
    /// The touch along an axis that was probed has been used since, as far as is known: it was read, or an offset was set there.
    is_used: bool,
}

remembers!(TouchOfAnotherAxis: read);

#[derive(Clone, PartialEq)]
struct Read {
    bytes: Range<u32>,
    number: u32,
    axis: Axis,
    /// The axis along which the probe moved, and its variable.
    probed: (Axis, u32),
}

remembers!(Read: bytes);

impl PathRule for TouchOfAnotherAxis {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    /// Another way may read the right one.
    fn counts_on_some_path(&self) -> bool {
        false
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(touches_work)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.look(cx);
        if cx.has_effect(touches_work) {
            self.tell(cx, report);
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        // Where the probe has stopped, a zero or a length is set without a read.
        let sets = |event: &Event| {
            matches!(
                event,
                Event::WorkOffset { .. }
                    | Event::Shift(_)
                    | Event::LengthOffset(_)
                    | Event::ToolTableEntry(_)
            )
        };
        // The end of the program sets offsets back.
        self.is_used |= sets(event) && boundary(cx).is_none() && reads(cx).is_empty();
    }

    fn ended(&mut self, cx: &PathCx<'_>, _: Ending, report: &mut Report<'_>) {
        if !cx.is_called_only() {
            self.tell(cx, report);
        }
    }
}

/// What holds where the axes are.
const PLACES: [SystemValue; 3] =
    [SystemValue::WorkPosition, SystemValue::EndPosition, SystemValue::MachinePosition];

impl TouchOfAnotherAxis {
    /// The variables that the block reads.
    fn look(&mut self, cx: &PathCx<'_>) {
        let Touch::Made(ways) = cx.state().touched() else { return };
        for number in reads(cx) {
            // One whose number is computed may be the right one, and names hold where the axes are.
            let Some(number) = number else {
                self.is_used = true;
                continue;
            };
            let axis_of = |value| {
                let column = column_of(cx, number, value)?;
                Axis::ALL.get(column as usize).copied()
            };
            let driven: Vec<Axis> = driven(ways).map(|(axis, _)| axis).collect();
            let Some(first) = driven.first().copied() else { continue };
            // After the touch the axes are where it was.
            let is_driven = |value| axis_of(value).is_some_and(|axis| driven.contains(&axis));
            if PLACES.into_iter().any(is_driven) {
                self.is_used = true;
                continue;
            }
            let Some(axis) = axis_of(SystemValue::ProbePosition) else { continue };
            if driven.contains(&axis) {
                self.is_used = true;
            } else if self.read.is_none() && cx.depth() == 1 {
                let step = |axis: Axis| Axis::ALL.iter().position(|other| *other == axis).unwrap_or(0);
                let right = (number + step(first) as u32).saturating_sub(step(axis) as u32);
                // Some controls hold the touch along the tool in another form.
                if column_of(cx, right, SystemValue::ProbePosition).is_some() {
                    self.read = Some(Read { bytes: cx.range(), number, axis, probed: (first, right) });
                }
            }
        }
    }

    /// Nothing more can read the last touch.
    fn tell(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Self { read, is_used } = std::mem::take(self);
        let Some(read) = read.filter(|_| !is_used && cx.is_on_every_path()) else { return };
        let Read { bytes, number, axis, probed: (probed, right) } = read;
        let (axis, probed) = (axis.name(), probed.name());
        let message = format!("`#{number}` is `{axis}` of the touch, and the probe moved along `{probed}`");
        report.add(
            cx.finding(&META, bytes, message)
                .label(format!(
                    "where the probe was in `{axis}`; nothing reads `#{right}`, the touch along `{probed}`"
                ))
                .help(format!("read `#{right}`, or probe along `{axis}`")),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_read_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0. Z1.\nG31 Z-1. F10.\n#101=#5061\nG0 Z1.\nM30\n",
            &expect![[r#"
                3 | #101=#5061
                  | ^^^^^^^^^^ warning[touch-of-another-axis] `#5061` is `X` of the touch, and the probe moved along `Z`
            "#]],
        );
    }

    #[test]
    fn the_next_touch_is_another_one() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0. Z1.\nG31 X-1. F10.\n#101=#5062\nG0 X1.\nG31 Y-1. F10.\n#102=#5062\nM30\n",
            &expect![[r#"
                3 | #101=#5062
                  | ^^^^^^^^^^ warning[touch-of-another-axis] `#5062` is `Y` of the touch, and the probe moved along `X`
            "#]],
        );
    }

    #[test]
    fn a_touch_that_is_used_may_have_its_place_noted() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0. Z1.\nG31 Z-1. F10.\n#101=#5061\nG0 Z[#5063+1.]\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn uses_without_a_read_of_the_touch() {
        let program = |then: &str| format!("G21 G90 G54\nG0 X20 Y20 Z10\nG38.2 Z-5 F60\n{then}G0 Z10\nM2\n");
        for then in [
            "G10 L20 P1 Z0\n#<x>=#5061\n",
            "#<x>=#5061\nG92 Z0\n",
            "#<x>=#5061\n#<z>=#5422\n",
            "#<i>=3\n#<x>=#5061\n#<z>=#[5060+#<i>]\n",
        ] {
            check_rule(&RULE, "linuxcnc", &program(then), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "linuxcnc",
            &program("G10 L2 P1 Z[#5061]\n"),
            &expect![[r#"
            4 | G10 L2 P1 Z[#5061]
              | ^^^^^^^^^^^^^^^^^^ warning[touch-of-another-axis] `#5061` is `X` of the touch, and the probe moved along `Z`
        "#]],
        );
        // The touch along Z is in a variable that counts the tool length too: the data leave it out.
        let fanuc = "G90 G54 G0 X0. Y0. Z1.\nG31 Z-1. F10.\n#101=#5061\n#103=#5063\nG0 Z1.\nM30\n";
        check_rule(&RULE, "fanuc-mill", fanuc, &expect![[""]]);
    }
}
