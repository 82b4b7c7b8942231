//! A facing cut that goes far beyond the centre of the part.

use gcheck_engine::{Abstract, Axis, Domain, Event, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::offset_schemes::whole;
use crate::facts::tool_comment::comment_at_work;
use crate::facts::tool_words::ToolWords;
use crate::facts::turning::{is_turned, turns_the_part};
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};

declare_rule! {
    /// A turning tool is fed across the face and more than 3 mm (0.12 inch) beyond the centre of the part. A nose that is larger, as
    /// the tool table or the comment of the tool has it (`R6`, `RCMT 12`), may go as far as its radius.
    ///
    /// ## Why it matters
    /// Beyond the centre the part turns the other way, against the back of the insert, and breaks it. A tool goes past the
    /// centre by its nose radius at most. Mostly the decimal point is at the wrong place.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 G40 T0101
    /// G97 S900 M3
    /// G0 X64. Z0.
    /// G1 X-16. F.2
    /// G0 X150. Z100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 G40 T0101
    /// G97 S900 M3
    /// G0 X64. Z0.
    /// G1 X-1.6 F.2
    /// G0 X150. Z100.
    /// M30
    /// ```
    /// Under polar interpolation X is a coordinate of the face, with two sides.
    /// ```nc,quiet,fanuc-lathe
    /// G21 G98 G40 T0101
    /// G97 S900 M3
    /// G0 X64. Z0. C0.
    /// G12.1
    /// G1 X-16. F200.
    /// G13.1
    /// G0 X150. Z100.
    /// M30
    /// ```
    rule "faced-past-the-centre" in "motion" {
        summary: "facing cut far beyond the centre of the part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(FacedPastTheCentre) },
    }
}

struct FacedPastTheCentre;

/// As a radius, millimetres: more than any nose radius and any parting tool needs.
const BEYOND: f64 = 3.0;
/// The largest round insert, where its size is not known: millimetres, of its radius.
const LARGEST: f64 = 16.0;
/// A cut along X alone: millimetres.
const LEVEL: f64 = 0.01;

impl PathRule for FacedPastTheCentre {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        let is_own = travel.kind == TravelKind::Feed && !travel.expanded;
        if !is_own || !turns_the_part(cx) || cx.is_called_only() {
            return;
        }
        let at = |axis| Some((travel.from.get(axis)?, travel.to.get(axis)?));
        let (Some((from, to)), Some((start, end))) = (at(Axis::X), at(Axis::Z)) else { return };
        if from <= 0.0 || to >= -BEYOND || (start - end).abs() > LEVEL || from.min(-to) < BEYOND {
            return;
        }
        let words = ToolWords::of(cx);
        if words.may_bore() || words.drills() || words.needs_no_spindle() {
            return;
        }
        if to >= -nose(cx) - LEVEL {
            return;
        }
        let is_diameter = cx.state().is_diameter(cx.model) == Some(true);
        let finding = cx
            .finding(&META, cx.letter_range('X'), "the cut across the face goes far beyond the centre")
            .label(format!("{} beyond the centre, measured as a radius", cx.shown(Mm(-to))))
            .help("check the decimal point of `X`: a tool goes past the centre by its nose radius");
        report.add(if is_diameter { finding } else { finding.at_most(Severity::Info) });
    }
}

/// The nose radius of the tool, as the tables or its comment have it; zero where nobody tells: millimetres.
fn nose(cx: &PathCx<'_>) -> f64 {
    let number = Abstract::known(cx.state().tool()).and_then(whole);
    let row = number.and_then(|number| cx.state().tables().tool(number));
    let listed = row.map(|tool| tool.corner_radius).filter(|radius| radius.is_known());
    let comment = comment_at_work(cx);
    let units = cx.state().units(cx.model);
    let named = comment.as_ref().and_then(|comment| comment.nose_radius(units));
    let is_round = comment.as_ref().is_some_and(|comment| comment.names_round_insert());
    let unknown = if is_round { LARGEST } else { 0.0 };
    listed.or(named).map_or(unknown, |radius| radius.0)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(comment: &str, x: &str) -> String {
        format!("G21 G99 G40\nT0101 ({comment})\nG97 S700 M3\nG0 X64. Z0.\nG1 {x} F.3\nG0 X150. Z100.\nM30\n")
    }

    #[test]
    fn a_round_insert_goes_as_far_as_its_radius() {
        for comment in ["RCMT 12 BUTTON", "RCMT1204", "GROOVE R6", "ROUND INSERT", "RNMG 120400"] {
            check_rule(&RULE, "fanuc-lathe", &program(comment, "X-12."), &expect![[""]]);
        }
        for (comment, x) in [
            ("RCMT 12 BUTTON", "X-16."),
            ("CNMG 120408 R0.8", "X-12."),
            ("ROUGH R25 SHOULDER", "X-40."),
            ("ROUGH 80 DEG", "X-12."),
        ] {
            let found = crate::testing::findings(
                &crate::testing::only(&RULE),
                "fanuc-lathe",
                &program(comment, x),
                &crate::testing::World::default(),
            );
            assert_eq!(found.len(), 1, "{comment}");
        }
    }
}
