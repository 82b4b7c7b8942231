//! An arc whose end does not lie on its circle.

use gcheck_controls::Effect;
use gcheck_engine::{ArcFault, Event, Fault, Position, Units};
use gcheck_geometry::Mm;
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::arcs::{counts_least_increments, limited_by_arc_facts};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The start and the end of an arc are not equally far from its centre, and the difference is larger than the
    /// control accepts.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or cuts a spiral. The usual causes are a wrong sign of `I` or `J`, a centre
    /// measured from the origin instead of from the start point, and a start point that is not where the programmer
    /// expected it.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 Y0 I4 J0 F100
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 Y0 I5 J0 F100
    /// M2
    /// ```
    /// The start point is unknown.
    /// ```nc,quiet,haas-mill
    /// G2 X10. Y0 I4. J0 F10.
    /// M30
    /// ```
    rule "arc-end-off-circle" in "arcs" {
        summary: "arc whose end is not on its circle",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::FAULTS.union(Watch::MOVES),
            make: || Box::new(ArcEndOffCircle::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ArcEndOffCircle {
    /// The programmed point before the block.
    at: Option<Position>,
    /// An arc was reported whose centre fits when it is measured from the origin: the others have the same cause.
    absolute: bool,
    /// The file has arcs; asked once.
    has_arcs: Option<bool>,
}

remembers!(ArcEndOffCircle);

impl PathRule for ArcEndOffCircle {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if !*self.has_arcs.get_or_insert_with(|| cx.file_may_use(Effect::is_arc)) {
            cx.enough();
            return;
        }
        self.at = match event {
            Event::Travel(travel) => Some(travel.programmed),
            Event::Arc(arc) => Some(arc.programmed),
            _ => None,
        };
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::Arc(ArcFault::OffCircle { start, end }) = *fault else { return };
        let before = self.at.replace(*cx.state().position());
        if counts_least_increments(cx) {
            return;
        }
        let is_absolute = before.is_some_and(|from| fits_from_origin(cx, &from));
        if is_absolute && std::mem::replace(&mut self.absolute, true) {
            return;
        }
        let (from, to) = (cx.shown(Mm(start)), cx.shown(Mm(end)));
        let difference = cx.shown(Mm((end - start).abs()));
        let is_centre = |word: &Word| matches!(word.letter.ascii(), b'I' | b'J' | b'K');
        let mut finding = cx
            .finding(&META, cx.word_range(is_centre), format!("arc ends {difference} off its circle"))
            .label(format!("the centre is {from} from the start and {to} from the end"));
        finding = if is_absolute {
            finding
                .note("measured from the origin instead of from the start of the arc, the centre fits; only the first arc like this is reported")
                .help("write the centre as distances from the start of the arc")
        } else {
            finding
                .help("check the signs of the centre words, the end point, and where the block before ends")
        };
        report.add(limited_by_arc_facts(cx, finding));
    }
}

/// Would the arc be valid if its centre were measured from the origin?
fn fits_from_origin(cx: &PathCx<'_>, from: &Position) -> bool {
    let Some(plane) = cx.state().plane(cx.model) else { return false };
    let unit = cx.state().units(cx.model).map_or(f64::NAN, Units::in_mm);
    let value = |letter: char| match cx.word(letter) {
        Some(_) => cx.known_number(letter).map(|number| number * unit),
        None => Some(0.0),
    };
    let centre = (value('I'), value('J'), value('K'));
    let (Some(along_x), Some(along_y), Some(along_z)) = centre else { return false };
    let [first, second, _] = plane.to_local([along_x, along_y, along_z]);
    let distance = |position: &Position| {
        let [a, b, _] = plane.to_local(position.xyz());
        (a.0 - first).hypot(b.0 - second)
    };
    let (start, end) = (distance(from), distance(cx.state().position()));
    start > 0.01 && (start - end).abs() <= f64::max(0.02, start * 0.002)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_centre_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G17 G21 G90 G0 X0 Y0\nG2 X10 Y0 I5 F100\nG3 X20 Y5 I5 J0\nM2\n",
            &expect![[r#"
                3 | G3 X20 Y5 I5 J0
                  |           ^^ error[arc-end-off-circle] arc ends 2.071 mm off its circle
            "#]],
        );
    }

    #[test]
    fn controls_differ_in_what_they_let_pass() {
        let program = "G17 G21 G90 G0 X0. Y0.\nG2 X10.02 Y0. I5. F100.\nM30\n";
        check_rule(&RULE, "linuxcnc", program, &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &program.replace("10.02", "10.05"),
            &expect![[r#"
            2 | G2 X10.05 Y0. I5. F100.
              |               ^^^ warning[arc-end-off-circle] arc ends 0.05 mm off its circle
        "#]],
        );
    }

    #[test]
    fn centres_from_the_origin_are_told_of_once() {
        let program = "G17 G21 G90 G0 X55. Y-40.\nG1 X55.123 Y-39.556 F100.\n\
            G3 X39.556 Y-55.123 I39.556 J-39.556\nG1 X-39.556\nG2 X-55.123 Y-39.556 I-39.556 J-39.556\nM30\n";
        check_rule(
            &RULE,
            "fanuc-mill",
            program,
            &expect![[r#"
            3 | G3 X39.556 Y-55.123 I39.556 J-39.556
              |                     ^^^^^^^ warning[arc-end-off-circle] arc ends 4.176 mm off its circle
        "#]],
        );
    }

    #[test]
    fn numbers_without_decimal_point_are_judged_elsewhere() {
        let program = "G17 G21 G90 G0 X0. Y0.\nG1 X10 F100.\nG2 X20. Y0. I5.\nM30\n";
        check_rule(&RULE, "haas-mill", program, &expect![[""]]);
    }

    #[test]
    fn arcs_go_on_from_the_programmed_end() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G17 G21 G90 G0 X0 Y0\nG2 X10 Y0 I4 F100\nG2 X20 Y0 I5\nM2\n",
            &expect![[r#"
                2 | G2 X10 Y0 I4 F100
                  |           ^^ error[arc-end-off-circle] arc ends 2 mm off its circle
            "#]],
        );
    }

    #[test]
    fn words_give_both_radii_in_the_units_of_the_program() {
        let program = "G20 G0 X0 Y0\nG2 X1. Y0 I.4 F10.\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            arc ends 0.2 in off its circle
              here: the centre is 0.4 in from the start and 0.6 in from the end
              assuming: the plane (`G17`) is as the control has it at the start
              assuming: absolute or incremental (`G90`) is as the control has it at the start
              help: check the signs of the centre words, the end point, and where the block before ends
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
