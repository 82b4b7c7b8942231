//! A centre word of an arc that does not belong to the plane.

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_engine::{ArcFault, Event, Fact, Fault, Role};
use gcheck_geometry::Plane;

use crate::declare::declare_rule;
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// An arc has the centre word of the axis that is perpendicular to its plane: `K` in the XY plane (`G17`), beside
    /// the centre words of its plane or in place of them. Or an
    /// arc in the ZX or YZ plane (`G18`, `G19`) has words for X and Y, as end point or centre, and no word for Z: it
    /// looks like an arc in the XY plane.
    ///
    /// ## Why it matters
    /// Either the plane or the word is wrong. Some controls stop with an alarm; others ignore the word and cut an arc
    /// in the wrong plane.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G17 G21 G90 G0 X0 Y0 Z0
    /// G2 X10 Y0 I5 K2 F100
    /// M2
    /// ```
    /// ```nc,reported,haas-mill
    /// G17 G21 G90 G0 X0 Y0 Z0
    /// G2 X10. Y0 I5. K2. F100.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G17 G21 G90 G0 X0 Y0 Z0
    /// G2 X10. Y0 K5. F100.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G18 G21 G90 G0 X0 Y0 Z0
    /// G2 X10. Y10. R10. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G18 G21 G90 G0 X0 Y0 Z0
    /// G2 X10. Z0 I5. K0 F100.
    /// M30
    /// ```
    /// A zero does no harm on a control that accepts it.
    /// ```nc,quiet,haas-mill
    /// G17 G21 G90 G0 X0 Y0 Z0
    /// G2 X10. Y0 I5. J0 K0 F100.
    /// M30
    /// ```
    rule "arc-wrong-plane-word" in "arcs" {
        summary: "centre word of an arc that is not of its plane",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS.union(Watch::ARCS), make: || Box::new(ArcWrongPlaneWord) },
    }
}

struct ArcWrongPlaneWord;

impl PathRule for ArcWrongPlaneWord {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Some(plane) = cx.state().plane(cx.model) else { return };
        match *fault {
            Fault::Arc(ArcFault::WrongPlane(letter)) => {
                report.add(finding(cx, char::from(letter.ascii()), plane));
            }
            Fault::Arc(ArcFault::NoCentre) => {
                let foreign = centre_word_across(plane);
                if cx.origin().letters.contains(Letter::of(foreign)) {
                    report.add(alone(cx, foreign, plane));
                }
            }
            // `J` was meant to be the distance to the centre.
            Fault::Arc(ArcFault::ZeroRadius) => {
                let foreign = centre_word_across(plane);
                if is_nonzero(cx, foreign) {
                    report.add(alone(cx, foreign, plane));
                }
            }
            // The words of a helix in another plane seldom meet on a circle.
            Fault::Arc(ArcFault::OffCircle { .. } | ArcFault::RadiusTooSmall { .. }) => {
                let foreign = centre_word_across(plane);
                if cx.origin().letters.contains(Letter::of(foreign)) {
                    report.add(finding(cx, foreign, plane).at_most(Severity::Warning));
                }
            }
            _ => {}
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Arc(arc) = event else { return };
        if !arc.expanded && is_meant_for_xy(cx, arc.plane) {
            report.add(arc_of_another_plane(cx, arc.plane));
            return;
        }
        let foreign = centre_word_across(arc.plane);
        if arc.expanded || !cx.origin().letters.contains(gcheck_controls::Letter::of(foreign)) {
            return;
        }
        // Under compensation an arc comes when the next move is known: the plane must be this block's.
        if cx.state().plane(cx.model) != Some(arc.plane) || !is_nonzero(cx, foreign) {
            return;
        }
        report.add(
            finding(cx, foreign, arc.plane)
                .note("the control ignores this word in the active plane")
                .at_most(Severity::Warning),
        );
    }
}

/// The centre word of the axis that is perpendicular to a plane.
fn centre_word_across(plane: Plane) -> char {
    match plane {
        Plane::Xy => 'K',
        Plane::Zx => 'J',
        Plane::Yz => 'I',
    }
}

/// Has the word a number other than zero?
fn is_nonzero(cx: &PathCx<'_>, letter: char) -> bool {
    cx.known_number(letter).is_some_and(|value| value.abs() > 0.0)
}

/// Has the block words for X and Y and neither Z nor `K`, in a plane of which Z is one axis?
fn is_meant_for_xy(cx: &PathCx<'_>, plane: Plane) -> bool {
    let letters = cx.origin().letters;
    let has = |letter: char| letters.contains(Letter::of(letter));
    plane != Plane::Xy
        && cx.state().plane(cx.model) == Some(plane)
        && (has('X') && has('Y') || has('I') && has('J'))
        && !letters.intersects(LetterSet::of("ZKUVW"))
}

fn arc_of_another_plane(cx: &PathCx<'_>, plane: Plane) -> Finding {
    let name = name_of(plane);
    let code = cx.code_name(Role::Plane).unwrap_or_default();
    let xy = cx.name_of_effect(Effect::PlaneXy).unwrap_or_default();
    let finding = cx
        .finding(
            &META,
            cx.range(),
            format!("arc with words for X and Y, but the {name} plane is active (`{code}`)"),
        )
        .label(format!("no word for Z: this looks like an arc in the XY plane (`{xy}`)"))
        .help(format!("choose the plane of the arc (`{xy}`)"))
        .at_most(Severity::Warning);
    cx.resting_on(finding, Fact::Mode(Role::Plane), &format!("the plane (`{code}`)"))
}

const fn name_of(plane: Plane) -> &'static str {
    match plane {
        Plane::Xy => "XY",
        Plane::Zx => "ZX",
        Plane::Yz => "YZ",
    }
}

/// The word across is the only one: the arc has neither a centre in its plane nor a radius.
fn alone(cx: &PathCx<'_>, letter: char, plane: Plane) -> Finding {
    let finding = finding(cx, letter, plane)
        .note("without a distance in another centre word, or a radius, the arc has no centre in its plane")
        .at_most(Severity::Warning);
    match cx.model.semantics().arcs.straight_setting.as_deref() {
        Some(setting) => finding.note(format!("setting {setting} decides: a straight line, or an alarm")),
        None => finding,
    }
}

fn finding(cx: &PathCx<'_>, letter: char, plane: Plane) -> Finding {
    let name = name_of(plane);
    let code = cx.code_name(Role::Plane).unwrap_or_default();
    let finding = cx
        .finding(
            &META,
            cx.letter_range(letter),
            format!("`{letter}` does not belong to an arc in the {name} plane"),
        )
        .label(format!("the active plane is `{code}`"))
        .help("choose the plane of the arc, or remove the word");
    cx.resting_on(finding, Fact::Mode(Role::Plane), &format!("the plane (`{code}`)"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in, findings, only};

    #[test]
    fn a_control_that_passes_it_over_is_not_stopped() {
        check_rule(&RULE, "grbl", "G17 G21 G90 G94\nG1 X20 F800\nG2 X30 Y0 I5 J0 K0\nM2\n", &expect![[""]]);
    }

    #[test]
    fn arcs_of_the_xy_plane_in_another_one() {
        check_rule(
            &RULE,
            "haas-mill",
            "G18 G21 G90 G0 X0 Y0 Z0\nG2 X10. Y5. R20. F100.\nG3 X0. I-5. J0.\nG3 X10. Z0. I5. J0.\nG2 X0. R5.\nM30\n",
            &expect![[r#"
                2 | G2 X10. Y5. R20. F100.
                  | ^^^^^^^^^^^^^^^^^^^^^^ warning[arc-wrong-plane-word] arc with words for X and Y, but the ZX plane is active (`G18`)
                3 | G3 X0. I-5. J0.
                  | ^^^^^^^^^^^^^^^ warning[arc-wrong-plane-word] arc with words for X and Y, but the ZX plane is active (`G18`)
            "#]],
        );
    }

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G18 G21 G90 G0 X0 Y0 Z0\nG2 X10 Z0 I5 J1 F100\nG17 G2 X0 Y0 K1\nM2\n",
            &expect![[r#"
                2 | G2 X10 Z0 I5 J1 F100
                  |              ^^ error[arc-wrong-plane-word] `J` does not belong to an arc in the ZX plane
                3 | G17 G2 X0 Y0 K1
                  |              ^^ error[arc-wrong-plane-word] `K` does not belong to an arc in the XY plane
            "#]],
        );
    }

    #[test]
    fn a_zero_beside_it_is_no_centre() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X3. Y1. Z.05\nG18\nG2 I0 J.25 Z-.1 F12.\nM30\n",
            &expect![[r#"
                3 | G2 I0 J.25 Z-.1 F12.
                  |       ^^^^ warning[arc-wrong-plane-word] `J` does not belong to an arc in the ZX plane
            "#]],
        );
    }

    /// In each plane, on each control, with the twin whose word is of the plane.
    #[test]
    fn the_word_across_alone() {
        let planes = [
            ("G17", "X10. Y0.", "K5.", "I5."),
            ("G18", "X10. Z0.", "J5.", "I5."),
            ("G19", "Y10. Z0.", "I5.", "J5."),
        ];
        for control in [
            "generic-mill",
            "haas-mill",
            "haas-lathe",
            "fanuc-mill",
            "fanuc-lathe",
            "tsnc-yh-a1m",
            "linuxcnc",
        ] {
            for (plane, end, across, inside) in planes {
                let program = |centre: &str| {
                    format!("G21 {plane}\nS500 M3\nG0 X0. Y0. Z0.\nG2 {end} {centre} F0.1\nM30\n")
                };
                let found =
                    |centre: &str| findings(&only(&RULE), control, &program(centre), &World::default()).len();
                assert_eq!((found(across), found(inside)), (1, 0), "{control} {plane}");
            }
        }
    }

    #[test]
    fn a_helix_whose_words_are_of_another_plane() {
        check_rule(
            &RULE,
            "generic-mill",
            "G21 G18 G90 G0 X10. Y0. Z0.\nG2 X-10. Y0. Z-2. I-10. J0. F100.\nG17 G2 X-10. Y0. Z-4. I10. J0.\nM30\n",
            &expect![[r#"
                2 | G2 X-10. Y0. Z-2. I-10. J0. F100.
                  |                         ^^^ warning[arc-wrong-plane-word] `J` does not belong to an arc in the ZX plane
            "#]],
        );
    }

    #[test]
    fn a_setting_that_makes_it_a_straight_move_changes_nothing() {
        let mut straight = World::default();
        straight.machine.settings.insert("3403#5".to_owned(), "straight line".to_owned());
        straight.machine.engine.settings.insert("3403#5".to_owned(), "straight line".to_owned());
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "G17 G21 G90 G0 X0 Y0 Z0\nG2 X10. Y0. K5. F100.\nM30\n",
            &straight,
            &expect![[r#"
                2 | G2 X10. Y0. K5. F100.
                  |             ^^^ warning[arc-wrong-plane-word] `K` does not belong to an arc in the XY plane
            "#]],
        );
    }

    #[test]
    fn where_the_word_is_not_read_it_is_a_warning() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G17 G21 G90 G0 X0 Y0 Z0\nG2 X10. I5. K1. F100.\nG3 X0. I-5. K#1\nM30\n",
            &expect![[r#"
                2 | G2 X10. I5. K1. F100.
                  |             ^^^ warning[arc-wrong-plane-word] `K` does not belong to an arc in the XY plane
            "#]],
        );
    }
}
