//! A lead-in shorter than the tool's radius.

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, At, CompensationFault, Domain, Event, Fault, Role};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::facts::compensation::{begins, is_on, stays_in_plane};
use crate::facts::cycles::is_operation;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The first move under cutter compensation is not longer than the tool's radius.
    ///
    /// The rule needs the tool's size: from a configured tool table, from `G10`, or from the block itself (`G41.1 D6`).
    ///
    /// ## Why it matters
    /// The tool has no room to move to its side of the path: it cuts into the contour that it should only approach.
    /// Some controls stop with an alarm.
    ///
    /// Compensation along a vector (`G141`) needs no lead-in. Neither does a pocket that the control clears (`G150`): it
    /// goes from the start hole to the wall by itself.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G17 G0 X0 Y0 Z5
    /// G41.1 D20 G1 X5 F100
    /// Y50
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G17 G0 X0 Y0 Z5
    /// G41.1 D20 G1 X15 F100
    /// Y50
    /// G40 X0
    /// M2
    /// ```
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G10 L12 P1 R0.25
    /// G1 G141 D1 X0.1 Y0. Z0. I0. J0. K1. F10.
    /// X2. I0. J0. K1.
    /// G40
    /// M30
    /// ```
    rule "lead-in-too-short" in "compensation" {
        summary: "lead-in not longer than the tool's radius",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS).union(Watch::RAPIDS).union(Watch::FAULTS),
            make: || Box::new(LeadInTooShort { begun: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct LeadInTooShort {
    begun: Option<At>,
}

remembers!(LeadInTooShort: begun);

impl PathRule for LeadInTooShort {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_on)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        // The control shifts each point along its vector, or leads in by itself.
        let is_own_lead_in = |effect| effect == Effect::CompensationVector || is_operation(effect);
        if cx.has_effect(is_own_lead_in) {
            self.begun = None;
        } else if begins(cx) {
            self.begun = Some(cx.origin().at);
        }
    }

    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        self.moves(cx, event, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        self.moves(cx, event, report);
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if let Fault::Compensation(CompensationFault::EntryTooShort { needed, got }) = fault {
            let begun = self.begun.take();
            tell(cx, begun, *got, *needed, true, report);
        }
    }
}

impl LeadInTooShort {
    fn moves(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if self.begun.is_none() || stays_in_plane(cx, event) {
            return;
        }
        let begun = self.begun.take();
        let Event::Travel(travel) = event else { return };
        let (Some(radius), Some(plane)) = (radius(cx), cx.state().plane(cx.model)) else { return };
        let point = |plane: Plane, position: &gcheck_engine::Position| {
            let [a, b, _] = plane.to_local(position.xyz());
            (a.0, b.0)
        };
        let ((a, b), (to_a, to_b)) = (point(plane, &travel.from), point(plane, &travel.programmed));
        let length = (to_a - a).hypot(to_b - b);
        if length < radius {
            tell(cx, begun, length, radius, false, report);
        }
    }
}

/// The radius that the offset number holds, millimetres.
fn radius(cx: &PathCx<'_>) -> Option<f64> {
    let number = crate::facts::offset_schemes::whole(Abstract::known(cx.state().d())?)?;
    let tool = cx.state().tables().tool(number)?;
    Some(tool.diameter.0 / 2.0).filter(|radius| radius.is_finite())
}

fn tell(
    cx: &PathCx<'_>,
    begun: Option<At>,
    length: f64,
    radius: f64,
    is_refused: bool,
    report: &mut Report<'_>,
) {
    let switched_on = begun.and_then(|at| {
        let place = cx.place_of(at)?;
        let words = place.table.words(place.block()).iter();
        words.map(|word| word.code).find(|code| is_on(cx.model.effect(*code)))
    });
    let name = switched_on
        .map(|code| cx.name_of(code))
        .or_else(|| cx.code_name(Role::Compensation))
        .unwrap_or_default();
    let mut finding = cx
        .finding(&META, cx.range(), format!("the lead-in is not longer than the tool's radius (`{name}`)"))
        .label(format!("{} long, and the tool's radius is {}", cx.shown(Mm(length)), cx.shown(Mm(radius))))
        .help("begin the lead-in farther from the contour");
    if let Some(range) = begun.and_then(|at| cx.find_word(at, |word| is_on(cx.model.effect(word.code)))) {
        finding = finding.also(range, "compensation is switched on here");
    }
    if is_refused {
        report.add(finding.note("this control refuses such an entry"));
    } else {
        report.add(finding.at_most(Severity::Warning));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in, findings, only, words};

    #[test]
    fn the_size_may_come_from_the_table() {
        // Tools of 10 mm.
        let world = World::of_group("machine");
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "G21 G90 G0 X0. Y0. Z5.\nG41 D1 G1 X3. F100.\nY50.\nG40 X-20.\nM30\n",
            &world,
            &expect![[r#"
            2 | G41 D1 G1 X3. F100.
              | ^^^^^^^^^^^^^^^^^^^ warning[lead-in-too-short] the lead-in is not longer than the tool's radius (`G41`)
        "#]],
        );
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "G21 G90 G0 X0. Y0. Z5.\nG41 D1 G1 X6. F100.\nY50.\nG40 X-20.\nM30\n",
            &world,
            &expect![[""]],
        );
    }

    #[test]
    fn the_control_leads_in_to_its_own_pocket() {
        let pocket = "O1\nG20 G90 G54 G0 X0. Y0.\nG10 L12 P1 R0.5\n";
        let outline = "M30\nO2\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n";
        let quiet = [
            "G150 P2 X0. Y0. Z-0.5 Q0.25 R0.1 I0.2 K0.01 G41 D1 F10.\nG40 X0. Y0.\n",
            "G41 D1\nG150 P2 X0. Y0. Z-0.5 Q0.25 R0.1 I0.2 K0.01 F10.\nG40 X0. Y0.\n",
        ];
        for cut in quiet {
            check_rule(&RULE, "haas-mill", &format!("{pocket}{cut}{outline}"), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "haas-mill",
            &format!("{pocket}G41 D1 G1 X0.1 F10.\nY1.\nG40 X2.\n{outline}"),
            &expect![[r#"
                4 | G41 D1 G1 X0.1 F10.
                  | ^^^^^^^^^^^^^^^^^^^ warning[lead-in-too-short] the lead-in is not longer than the tool's radius (`G41`)
            "#]],
        );
    }

    #[test]
    fn lengths_are_in_the_units_of_the_program() {
        let found = findings(
            &only(&RULE),
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0.\nG10 L12 P1 R0.5\nG41 D1 G1 X0.1 F10.\nY1.\nG40 X2.\nM30\n",
            &World::default(),
        );
        let said: String = found.iter().map(words).collect();
        assert!(said.contains("0.1 in long, and the tool's radius is 0.25 in"), "{said}");
    }

    #[test]
    fn the_size_may_come_from_the_program() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G0 X0. Y0. Z5.\nG10 L12 P1 R8.\nG41 D1 G1 X3. F100.\nY50.\nG40 X-20.\nM30\n",
            &expect![[r#"
                3 | G41 D1 G1 X3. F100.
                  | ^^^^^^^^^^^^^^^^^^^ warning[lead-in-too-short] the lead-in is not longer than the tool's radius (`G41`)
            "#]],
        );
    }
}
