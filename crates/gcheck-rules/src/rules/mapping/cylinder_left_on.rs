//! Cylindrical mapping that is not switched off.

use std::ops::Range;

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Axis, Cylinder, Ending, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range, ends_at_tape_mark};
use crate::facts::modes::{ActiveMode, left_on};
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A linear axis is still wrapped around a cylinder when the tool is changed, an axis of the cylinder returns to
    /// its reference position, or the program ends.
    ///
    /// ## Why it matters
    /// Every move of the linear axis turns the part instead. The next tool, or the next program, cuts around the part
    /// instead of its face; a program that is started at the tool change cuts flat instead of wrapped.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G107 Y0. A0. Q2.5
    /// G1 Y1. F10.
    /// T2 M6
    /// G107
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G107 Y0. A0. Q2.5
    /// G1 Y1. F10.
    /// G91 G28 A0.
    /// G90 G107
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G107 Y0. A0. Q2.5
    /// G1 Y1. F10.
    /// G107
    /// T2 M6
    /// M30
    /// ```
    /// An axis that does not belong to the cylinder may return; so may the wrapped axis from its present position.
    /// ```nc,quiet,haas-mill
    /// G107 Y0. A0. Q2.5
    /// G1 Y1. F10.
    /// G91 G28 Z0.
    /// G28 Y0.
    /// G90 G107
    /// M30
    /// ```
    rule "cylinder-left-on" in "mapping" {
        summary: "cylindrical mapping left on",
        severity: Warning,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::ENDS),
            make: || Box::new(CylinderLeftOn { told: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct CylinderLeftOn {
    /// The block that began what was reported last.
    told: Option<At>,
}

remembers!(CylinderLeftOn: told);

impl PathRule for CylinderLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if let Some(boundary) = boundary(cx) {
            self.judge(cx, Place::Boundary(boundary), report);
        } else if cx.has_effect(|effect| matches!(effect, Effect::ReturnReference(_))) {
            self.judge(cx, Place::Reference, report);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            self.judge(cx, Place::Boundary(Boundary::ProgramEnd), report);
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Boundary(Boundary),
    Reference,
}

impl Place {
    const fn words(self) -> &'static str {
        match self {
            Self::Boundary(boundary) => boundary.words(),
            Self::Reference => "at the return to the reference position",
        }
    }
}

impl CylinderLeftOn {
    fn judge(&mut self, cx: &PathCx<'_>, place: Place, report: &mut Report<'_>) {
        let is_on = |effect| effect == Effect::CylinderMapping;
        let Some(ActiveMode::Certain(code)) = left_on(cx, Role::Cylinder, is_on) else { return };
        let Some(cylinder) = cx.state().cylinder() else { return };
        if place == Place::Reference && !takes_away(cx, cylinder) {
            return;
        }
        let set_by = cx.definitions().set_by(Fact::Mode(Role::Cylinder));
        if set_by.is_none() || set_by == self.told {
            return;
        }
        let name = cx.name_of(code);
        let (linear, rotary) = (cylinder.linear.name(), cylinder.rotary.name());
        let finding = cx
            .finding(
                &META,
                range(cx, place),
                format!("{linear} is still wrapped {} (`{name}`)", place.words()),
            )
            .label(match place {
                Place::Boundary(_) => format!("a word for {linear} still turns {rotary}"),
                Place::Reference => format!("{rotary} leaves the wrapped contour"),
            })
            .help(format!("end mapping before this, with `{name}` alone in its block"))
            .fix_if(cx.block_before(Some(&name)));
        let finding = cx.resting_on(finding, Fact::Mode(Role::Cylinder), &format!("`{name}`"));
        let Some(finding) = limited(cx, place, &name, finding) else { return };
        self.told = set_by;
        report.add(finding);
    }
}

/// The end of the program may end mapping itself: `None` if the configuration says that it does.
fn limited(cx: &PathCx<'_>, place: Place, name: &str, finding: Finding) -> Option<Finding> {
    if place != Place::Boundary(Boundary::ProgramEnd) {
        return Some(finding);
    }
    let rules = cx.model.semantics().cylinder.as_ref()?;
    let number = rules.ended_by_setting.as_deref()?;
    match cx.environment.setting(number)? {
        ("on", None) => None,
        ("on", Some(assumed)) => Some(
            finding
                .at_most(Severity::Info)
                .note(format!("setting {number} decides whether the end of the program ends `{name}`"))
                .assuming(assumed),
        ),
        _ => Some(
            finding.note(format!("with setting {number} off the end of the program does not end `{name}`")),
        ),
    }
}

/// Does the return move an axis away from the contour? The wrapped axis returns by itself from its present position.
fn takes_away(cx: &PathCx<'_>, cylinder: &Cylinder) -> bool {
    let letters = cx.origin().letters;
    let names = |axis: Axis| letters.contains(axis.letter());
    let axes = LetterSet::of("XYZABC");
    let all = !letters.intersects(axes) && cx.model.semantics().reference_without_axes;
    all || names(cylinder.rotary)
        || names(cylinder.linear) && cx.state().is_incremental(cx.model) == Some(false)
}

fn range(cx: &PathCx<'_>, place: Place) -> Range<u32> {
    match place {
        Place::Boundary(boundary) => boundary_range(cx, boundary),
        Place::Reference => cx.effect_range(|effect| matches!(effect, Effect::ReturnReference(_))),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in, findings, only, words};

    #[test]
    fn one_cause_is_told_once() {
        check_rule(
            &RULE,
            "haas-mill",
            "G107 Y0. A0. Q2.5\nG1 Y1. F10.\nT2 M6\nT3 M6\nG28\nM30\n",
            &expect![[r#"
                3 | T2 M6
                  |    ^^ warning[cylinder-left-on] Y is still wrapped at the tool change (`G107`)
            "#]],
        );
    }

    #[test]
    fn the_way_through_a_point_of_the_drawing_turns_the_part() {
        check_rule(
            &RULE,
            "haas-mill",
            "G107 Y0. A0. Q2.5\nG28 Y0.\nG107\nM30\n",
            &expect![[r#"
            2 | G28 Y0.
              | ^^^ warning[cylinder-left-on] Y is still wrapped at the return to the reference position (`G107`)
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "G107 Y0. A0. Q2.5\nG28\nG107\nM30\n",
            &expect![[r#"
            2 | G28
              | ^^^ warning[cylinder-left-on] Y is still wrapped at the return to the reference position (`G107`)
        "#]],
        );
    }

    #[test]
    fn a_default_diameter_maps_nothing() {
        check_rule(&RULE, "haas-mill", "G107 A0. Q2.5\nT2 M6\nM30\n", &expect![[""]]);
    }

    #[test]
    fn in_a_called_program_and_in_a_loop() {
        check_rule(
            &RULE,
            "haas-mill",
            "M97 P10\nT2 M6\nG107\nWHILE [#1 LT 3] DO1\nG107 Y0. A0. Q2.\nT3 M6\nG107\n#1=#1+1\nEND1\nM30\nN10 G107 Y0. A0. Q2.\nM99\n",
            &expect![[r#"
                2 | T2 M6
                  |    ^^ warning[cylinder-left-on] Y is still wrapped at the tool change (`G107`)
                6 | T3 M6
                  |    ^^ warning[cylinder-left-on] Y is still wrapped at the tool change (`G107`)
            "#]],
        );
    }

    #[test]
    fn what_some_path_switched_off_is_not_surely_on() {
        check_rule(
            &RULE,
            "haas-mill",
            "G107 Y0. A0. Q2.5\nIF [#100 EQ 1] GOTO 5\nG107\nN5 T2 M6\nM30\n",
            &expect![[""]],
        );
    }

    fn check_with(setting: &str, expected: &Expect) {
        let mut world = World::default();
        world.machine.settings.insert("56".to_owned(), setting.to_owned());
        check_rule_in(&RULE, "haas-mill", "G107 Y0. A0. Q2.5\nG1 Y1. F10.\nM30\n", &world, expected);
    }

    #[test]
    fn a_setting_decides_at_the_end() {
        check_with("on", &expect![[""]]);
        check_with(
            "off",
            &expect![[r#"
            3 | M30
              | ^^^ warning[cylinder-left-on] Y is still wrapped at the end of the program (`G107`)
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "G107 Y0. A0. Q2.5\nG1 Y1. F10.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ info[cylinder-left-on] Y is still wrapped at the end of the program (`G107`)
        "#]],
        );
    }

    #[test]
    fn what_it_says() {
        let say = |program: &str| {
            let found = findings(&only(&RULE), "haas-mill", program, &World::default());
            found.iter().map(words).collect::<String>()
        };
        expect![[r#"
            Y is still wrapped at the tool change (`G107`)
              here: a word for Y still turns A
              there: `G107` set here
              help: end mapping before this, with `G107` alone in its block
              fix (unsafe): put `G107` in a block before this one
        "#]]
        .assert_eq(&say("G107 Y0. A0. Q2.5\nT2 M6\nG107\nM30\n"));
        expect![[r#"
            Y is still wrapped at the return to the reference position (`G107`)
              here: A leaves the wrapped contour
              there: `G107` set here
              help: end mapping before this, with `G107` alone in its block
              fix (unsafe): put `G107` in a block before this one
        "#]]
        .assert_eq(&say("G107 Y0. A0. Q2.5\nG91 G28 A0.\nG107\nM30\n"));
        expect![[r#"
            Y is still wrapped at the end of the program (`G107`)
              here: a word for Y still turns A
              there: `G107` set here
              note: setting 56 decides whether the end of the program ends `G107`
              assuming: setting 56 (M30 restores default G codes) is on
              help: end mapping before this, with `G107` alone in its block
              fix (unsafe): put `G107` in a block before this one
        "#]]
        .assert_eq(&say("G107 Y0. A0. Q2.5\nM30\n"));
    }
}
