//! Two touches that do not face each other.

use gcheck_controls::Effect;
use gcheck_engine::{At, Event, Touch, Way};

use crate::declare::declare_rule;
use crate::facts::compensation::may_be_on;
use crate::facts::probing::{driven, is_probing_move, is_second_touch, keeping_code};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The second touch of a measurement between two touches (`G136`, `G35`) is along another axis than the first, or
    /// in the same direction.
    ///
    /// ## Why it matters
    /// Two sides of a part, a bore or a tool are touched in opposite directions along one axis. A first touch along Y
    /// does not help to find the middle in X, and two touches in the same direction hit the same side: the control
    /// still computes a middle.
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
        // A called program may move axes by arguments that only its caller knows.
        let is_open = may_be_on(cx) || cx.is_called_only();
        if is_open || !is_probing_move(event) || !cx.has_effect(is_second_touch) {
            return;
        }
        let (Touch::Made(first), Touch::Made(second)) = (cx.state().kept_touch(), cx.state().touched())
        else {
            return;
        };
        // A word that the code does not read moves no axis; another rule reports it.
        let codes = cx.codes();
        let mut codes = codes.iter().filter(|code| is_second_touch(cx.model.effect(**code)));
        let Some(code) = codes.find_map(|code| cx.code_of(*code)) else { return };
        for (axis, way) in driven(second) {
            let letter = axis.name();
            if !code.reads().contains(axis.letter()) {
                continue;
            }
            let keep = keeping_code(cx);
            let (message, label, help) = match (first.of(axis), way) {
                (Way::Still, _) => (
                    format!("the first touch was not along {letter}"),
                    format!("measures along {letter}, where nothing was touched before"),
                    format!("keep a first touch along {letter}: `{keep}` on its probing move"),
                ),
                (Way::Up, Way::Up) | (Way::Down, Way::Down) => (
                    format!("both touches are in the same direction along {letter}"),
                    "hits the same side as the first touch, or one that faces the same way".to_owned(),
                    format!("touch along {letter} from the other side, in the opposite direction"),
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
                  |      ^^^^ warning[touches-do-not-meet] both touches are in the same direction along Y
            "#]],
        );
    }

    #[test]
    fn a_word_that_the_code_does_not_read_is_another_matter() {
        for word in ["C1.", "B1."] {
            let program = format!("G91 G31 X-1. F10. M75\nG0 X-8.\nG136 X1. F10. {word}\nG90\nM30\n");
            check_rule(&RULE, "haas-mill", &program, &expect![[""]]);
        }
    }

    #[test]
    fn an_axis_that_the_first_touch_left_alone() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 X-1. F10. M75\nG0 X-8.\nG136 X1. Y1. F10.\nG90\nM30\n",
            &expect![[r#"
                3 | G136 X1. Y1. F10.
                  |          ^^^ warning[touches-do-not-meet] the first touch was not along Y
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
                  |     ^^^^ warning[touches-do-not-meet] both touches are in the same direction along X
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
