//! Two touches between which there is nothing to measure.

use gcheck_controls::Effect;
use gcheck_engine::{At, Event, Role, Touch, TravelKind, Way};

use super::first_touch_missing::keeping_code;
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::probing::{driven, is_second_touch};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The second touch of a measurement between two (`G136`, `G35`) goes along another axis than the first, or the same way.
    ///
    /// ## Why it matters
    /// Two sides of a part, a bore or a tool are touched from opposite ways along one axis. A first touch along Y says
    /// nothing of the middle in X, and two touches in the same way hit the same side: the control computes a middle all
    /// the same.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G31 Y-1. F10. M75
    /// G0 Y-8.
    /// G136 Y-1. F10.
    /// G90 G0 Y0.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G31 Y-1. F10. M75
    /// G0 Y-8.
    /// G136 X1. F10.
    /// G90 G0 Y0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G31 Y-1. F10. M75
    /// G0 Y-8.
    /// G136 Y1. F10.
    /// G90 G0 Y0.
    /// M30
    /// ```
    rule "touches-do-not-meet" in "probing" {
        summary: "second touch that does not face the first",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS),
            make: || Box::new(TouchesDoNotMeet { kept: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct TouchesDoNotMeet {
    /// The block that kept a touch last.
    kept: Option<At>,
}

remembers!(TouchesDoNotMeet: kept);

impl PathRule for TouchesDoNotMeet {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if cx.has_effect(keeps) {
            self.kept = Some(cx.origin().at);
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        // What is called may drive axes by arguments that only its caller knows.
        let is_open = is_compensated(cx) || cx.is_called_only();
        if is_open || !is_probing(event) || !cx.has_effect(is_second_touch) {
            return;
        }
        let (Touch::Made(first), Touch::Made(second)) = (cx.state().kept_touch(), cx.state().touched())
        else {
            return;
        };
        for (axis, way) in driven(second) {
            let letter = axis.name();
            let keep = keeping_code(cx);
            let (message, label, help) = match (first.of(axis), way) {
                (Way::Still, _) => (
                    format!("the first touch did not go along {letter}"),
                    format!("measures along {letter}, where nothing was touched before"),
                    format!("keep a first touch along {letter}: `{keep}` on its probing move"),
                ),
                (Way::Up, Way::Up) | (Way::Down, Way::Down) => (
                    format!("both touches go the same way along {letter}"),
                    "hits the side that the first touch hit, or one that looks the same way".to_owned(),
                    format!("touch along {letter} from the other side, the opposite way"),
                ),
                _ => continue,
            };
            let finding = cx.finding(&META, cx.letter_range(letter), message).label(label).help(help);
            let kept = self.kept.and_then(|at| cx.find_word(at, |word| keeps(cx.model.effect(word.code))));
            report.add(match kept {
                Some(range) => finding.also(range, "the first touch is kept here"),
                None => finding,
            });
        }
    }
}

fn keeps(effect: Effect) -> bool {
    effect == Effect::KeepTouch
}

/// Is the move one that the probe ends?
pub(super) fn is_probing(event: &Event) -> bool {
    matches!(event, Event::Travel(travel) if matches!(travel.kind, TravelKind::Probe { .. }))
}

/// May cutter compensation be on, so that events come a block late? Probing under it is another rule's.
pub(super) fn is_compensated(cx: &PathCx<'_>) -> bool {
    !matches!(cx.state().effect(Role::Compensation, cx.model), Some(Effect::CompensationOff | Effect::None))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn positions_tell_the_way_as_increments_do() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y5.\nG31 Y4. F10. M75\nG0 Y-5.\nG136 Y-8. F10.\nG136 Y-4. F10.\nM30\n",
            &expect![[r#"
                4 | G136 Y-8. F10.
                  |      ^^^^ warning[touches-do-not-meet] both touches go the same way along Y
            "#]],
        );
    }

    #[test]
    fn an_axis_that_the_first_touch_left_alone() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 X-1. F10. M75\nG0 X-8.\nG136 X1. Y1. F10.\nG90\nM30\n",
            &expect![[r#"
                3 | G136 X1. Y1. F10.
                  |          ^^^ warning[touches-do-not-meet] the first touch did not go along Y
            "#]],
        );
    }

    #[test]
    fn a_tool_is_touched_from_two_sides() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 X-1. F10. M75\nG0 X-8.\nG35 X-1. D1 F10.\nG90\nM30\n",
            &expect![[r#"
                3 | G35 X-1. D1 F10.
                  |     ^^^^ warning[touches-do-not-meet] both touches go the same way along X
            "#]],
        );
    }

    #[test]
    fn a_way_that_nobody_knows_is_no_mistake() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 X#100 F10. M75\nG0 X-8.\nG136 X-1. F10.\nG90 G136 X1. F10.\nM30\n",
            &expect![[""]],
        );
    }
}
