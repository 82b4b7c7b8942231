//! A local shift that the program leaves on.

use gcheck_controls::{CodeIx, Effect, Letter, LetterSet};
use gcheck_engine::{At, Axis, Ending, Event};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range, ends_at_tape_mark};
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The shift of the work coordinates (`G52`, `G92`; `G50` of lathes) is still on when the program ends.
    ///
    /// ## Why it matters
    /// A parameter or setting decides whether the end of the program clears it. If it remains, every work offset is
    /// shifted in the next program.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G54 G52 X10.
    /// G1 X0. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G54 G52 X10.
    /// G1 X0. F100.
    /// G52 X0.
    /// M30
    /// ```
    /// A shift by increments adds up from part to part.
    /// ```nc,reported,fanuc-lathe
    /// G21 T0101
    /// G50 W-5.
    /// G1 Z-2. F.2
    /// M30
    /// ```
    /// A program that uses `G92` instead of work offsets sets it again each time.
    /// ```nc,quiet,fanuc-mill
    /// G92 X0. Y0. Z100.
    /// G1 X10. F100.
    /// M30
    /// ```
    rule "shift-left-on" in "offsets" {
        summary: "shift of the work coordinates left on",
        severity: Warning,
        tier: Path,
        control_specific: true,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CHANGES).union(Watch::ENDS),
            make: || Box::new(ShiftLeftOn { set: None, steps: Some([0.0; 2]) }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct ShiftLeftOn {
    /// The block that shifted last, and its code. Choosing a work offset applies the shift too.
    set: Option<(At, CodeIx)>,
    /// The sums of the increments `U` and `W` of a lathe, as the program writes them, as long as the shift has only such ones.
    steps: Option<[f64; 2]>,
}

/// Sums that are less are zero.
const SAME: f64 = 1e-6;

remembers!(ShiftLeftOn: set);

/// Does the end of a program clear the shift, as a configured setting says? `None` where none is configured.
fn is_cleared(cx: &PathCx<'_>) -> Option<bool> {
    let decides = cx.model.semantics().shift_cleared_at_end.as_ref()?;
    let (value, assumed) = cx.environment.setting(&decides.setting)?;
    assumed.is_none().then(|| decides.values.iter().any(|own| own == value))
}

impl PathRule for ShiftLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::shifts_coordinates)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if boundary(cx) == Some(Boundary::ProgramEnd) {
            self.judge(cx, report);
        }
        let code = cx.codes().iter().copied().find(|code| cx.model.effect(*code).shifts_coordinates());
        if let Some(code) = code.filter(|_| is_step(cx)) {
            self.set = Some((cx.origin().at, code));
            let sums = self.steps.zip(steps(cx));
            self.steps = sums.map(|(sums, [u, w])| [sums[0] + u, sums[1] + w]);
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if let Event::Shift(_) = event
            && let Some(code) =
                cx.codes().iter().copied().find(|code| cx.model.effect(*code).shifts_coordinates())
        {
            self.set = Some((cx.origin().at, code));
            self.steps = self.steps.filter(|_| is_step(cx));
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            self.judge(cx, report);
        }
    }
}

impl ShiftLeftOn {
    fn judge(&self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some((at, code)) = self.set else { return };
        let shift = cx.state().shift();
        let axes: Vec<char> = Axis::ALL
            .into_iter()
            .filter(|axis| shift.get(*axis).is_some_and(|v| v != 0.0))
            .map(Axis::name)
            .collect();
        let is_set_position = cx.model.effect(code) != Effect::LocalShift;
        let by_steps =
            is_set_position && self.steps.is_some_and(|sums| sums.iter().any(|sum| sum.abs() > SAME));
        // The positions of the axes are seldom known, so the shift that gives them the block's values is seldom known
        // too.
        let is_left = if by_steps {
            true
        } else if is_set_position {
            Axis::ALL.into_iter().any(|axis| shift.get(axis) != Some(0.0))
        } else {
            !axes.is_empty()
        };
        let uses_work_offsets =
            cx.file_uses(|effect| matches!(effect, Effect::WorkOffset(_) | Effect::WorkOffsetByP(_)));
        let is_back = self.steps.is_some() && !by_steps;
        if !is_left || is_set_position && (is_back || !by_steps && !uses_work_offsets) {
            return;
        }
        let name = cx.name_of(code);
        let of = if axes.is_empty() || is_set_position {
            String::new()
        } else {
            format!(" of {}", axes.iter().map(|axis| format!("`{axis}`")).collect::<Vec<_>>().join(", "))
        };
        let help = if is_set_position {
            match cx.name_of_effect(Effect::ClearShift) {
                Some(clear) => format!("clear it with `{clear}` before the program ends"),
                None if by_steps => {
                    format!("shift it back with `{name}` by the same way before the program ends")
                }
                None => format!(
                    "go back to where `{name}` set the position and set the earlier one there, or use work offsets instead"
                ),
            }
        } else {
            format!("end the program with `{name} X0. Y0. Z0.`")
        };
        let cleared = is_cleared(cx).filter(|_| cx.model.effect(code) == Effect::LocalShift);
        if cleared == Some(true) {
            return;
        }
        let finding = cx
            .finding(
                &META,
                boundary_range(cx, Boundary::ProgramEnd),
                format!("the shift{of} is still on at the end of the program (`{name}`)"),
            )
            .label("what runs next may begin with it")
            .help(help)
            .at_most(if is_set_position && !by_steps && axes.is_empty() {
                Severity::Info
            } else {
                Severity::Warning
            });
        let finding = match cleared {
            Some(_) => finding,
            None => {
                finding.assuming("the end of the program keeps the shift, as a parameter or setting decides")
            }
        };
        let set_here = cx.find_word(at, |word| word.code == code);
        report.add(match set_here {
            Some(range) => finding.also(range, format!("`{name}` set here")),
            None => finding,
        });
    }
}

/// Does the block shift by increments of a lathe alone, if it shifts?
fn is_step(cx: &PathCx<'_>) -> bool {
    let letters = cx.origin().letters;
    let has_own = !cx.model.semantics().increments.is_empty();
    has_own && letters.intersects(LetterSet::of("UW")) && !letters.intersects(LetterSet::of("SXYZ"))
}

/// By how much the block shifts; `None` where that is not known.
fn steps(cx: &PathCx<'_>) -> Option<[f64; 2]> {
    let by = |letter: char| {
        let is_given = cx.origin().letters.contains(Letter::of(letter));
        if is_given { cx.known_number(letter) } else { Some(0.0) }
    };
    Some([by('U')?, by('W')?])
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_axes_are_named() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G54\nG52 X1. Y2.\nG1 X0. F10.\nG52 X0.\nM30\n",
            &expect![[r#"
            5 | M30
              | ^^^ warning[shift-left-on] the shift of `Y` is still on at the end of the program (`G52`)
        "#]],
        );
    }

    #[test]
    fn a_position_that_was_set_stays_set() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G54 G0 X0\nG92 X5\nG1 X0 F100\nM2\n",
            &expect![[r#"
                4 | M2
                  | ^^ warning[shift-left-on] the shift is still on at the end of the program (`G92`)
            "#]],
        );
        check_rule(&RULE, "linuxcnc", "G21 G54 G0 X0\nG92 X5\nG1 X0 F100\nG92.1\nM2\n", &expect![[""]]);
        // Where the tool was is not known, so the shift is not.
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G54\nG92 X5\nG1 X0 F100\nM2\n",
            &expect![[r#"
            4 | M2
              | ^^ info[shift-left-on] the shift is still on at the end of the program (`G92`)
        "#]],
        );
    }

    #[test]
    fn steps_of_a_lathe_add_up() {
        let program = |after: &str| format!("G21 T0101\nG50 W-5.\nG1 Z-2. F.2\n{after}\nM30\n");
        let found = findings(&only(&RULE), "fanuc-lathe", &program("G50 U1."), &World::default());
        expect![[r#"
            the shift is still on at the end of the program (`G50`)
              here: what runs next may begin with it
              there: `G50` set here
              assuming: the end of the program keeps the shift, as a parameter or setting decides
              help: clear it with `G50.3` before the program ends
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        check_rule(&RULE, "fanuc-lathe", &program("G50 W5."), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &program("G50 W#500"), &expect![[""]]);
        // The old form, without work offsets, sets the position again each time; with them it is worth knowing.
        check_rule(&RULE, "fanuc-lathe", "G21 G50 X200. Z150.\nT0101\nG1 Z-2. F.2\nM30\n", &expect![[""]]);
        let found = findings(
            &only(&RULE),
            "fanuc-lathe",
            "G21 G54 G50 X200. Z150.\nT0101\nG1 Z-2. F.2\nM30\n",
            &World::default(),
        );
        expect![[r#"
            the shift is still on at the end of the program (`G50`)
              here: what runs next may begin with it
              there: `G50` set here
              assuming: the end of the program keeps the shift, as a parameter or setting decides
              help: clear it with `G50.3` before the program ends
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn work_offsets_chosen_later_do_not_hide_it() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G52 Z5.\nG55 G1 X0. F100.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ warning[shift-left-on] the shift of `Z` is still on at the end of the program (`G52`)
        "#]],
        );
    }
}
