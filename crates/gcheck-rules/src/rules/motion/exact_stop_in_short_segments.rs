//! Exact stop on a contour of short segments.

use std::collections::BTreeSet;

use gcheck_controls::Effect;
use gcheck_engine::{At, Event, Fact, PathMode, Role, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::reach;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// More than twenty moves of less than 1 mm follow each other while the axes stop at each corner: under exact stop or
    /// exact path (`G61`).
    ///
    /// ## Why it matters
    /// A surface from a CAM system is thousands of such moves. The axes stop at every point: the program takes several
    /// times as long as its feed says, and the marks of the stops show on the part.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G90 G61
    /// G0 X0. Y0.
    /// G91 G1 F1000.
    /// X.5 Y.1
    /// X.5 Y.2
    /// X.5 Y.1
    /// X.5 Y.2
    /// X.5 Y.1
    /// X.5 Y.2
    /// X.5 Y.1
    /// X.5 Y.2
    /// X.5 Y.1
    /// X.5 Y.2
    /// X.5 Y.1
    /// X.5 Y.2
    /// X.5 Y.1
    /// X.5 Y.2
    /// X.5 Y.1
    /// X.5 Y.2
    /// X.5 Y.1
    /// X.5 Y.2
    /// X.5 Y.1
    /// X.5 Y.2
    /// X.5 Y.1
    /// G90
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G90 G61
    /// G0 X0. Y0.
    /// G1 X20. F1000.
    /// Y20.
    /// X0.
    /// Y0.
    /// M30
    /// ```
    rule "exact-stop-in-short-segments" in "motion" {
        summary: "exact stop on a contour of short segments",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(ExactStopInShortSegments::default()) },
    }
}

/// Moves that are shorter are segments of a contour.
const SHORT: Mm = Mm(1.0);
/// So many that follow each other are a contour.
const MANY: u32 = 20;

#[derive(Default, Clone, PartialEq)]
struct ExactStopInShortSegments {
    moves: u32,
    length: Mm,
    /// The blocks that set the modes that were reported.
    told: BTreeSet<Option<At>>,
}

remembers!(ExactStopInShortSegments: told);

impl PathRule for ExactStopInShortSegments {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| matches!(effect, Effect::ExactStop | Effect::ExactPath))
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(length) = short_move(event) else {
            (self.moves, self.length) = (0, Mm::ZERO);
            return;
        };
        let is_stopped =
            matches!(cx.state().path_mode(cx.model), Some(PathMode::ExactStop | PathMode::ExactPath));
        if !is_stopped {
            (self.moves, self.length) = (0, Mm::ZERO);
            return;
        }
        self.moves += 1;
        self.length += length;
        let fact = Fact::Mode(Role::PathControl);
        let set_by = cx.definitions().set_by(fact);
        if self.moves <= MANY || !self.told.insert(set_by) {
            return;
        }
        let name = cx.code_name(Role::PathControl).unwrap_or_default();
        let blending = cx.name_of_effect(Effect::PathBlending);
        let help = blending.map_or_else(
            || "end the mode before the contour".to_owned(),
            |blending| format!("blend the corners of the contour (`{blending}`), with a tolerance where the control takes one"),
        );
        let finding = cx
            .finding(&META, cx.range(), format!("the axes stop at every corner of short segments (`{name}`)"))
            .label(format!(
                "the last {} moves are {} long on average",
                self.moves,
                cx.shown(Mm(self.length.0 / f64::from(self.moves)))
            ))
            .help(help);
        report.add(cx.resting_on(finding, fact, &format!("`{name}`")));
    }
}

/// The length of a straight cutting move of the program's own that is short.
fn short_move(event: &Event) -> Option<Mm> {
    let Event::Travel(travel) = event else { return None };
    if travel.kind != TravelKind::Feed || travel.expanded {
        return None;
    }
    reach::length(&travel.from, &travel.to).map(Mm).filter(|length| *length < SHORT)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn contour(mode: &str, step: f64) -> String {
        let moves: String = (1..30)
            .map(|ix| format!("G1 X{:.3} Y{:.3} F500\n", f64::from(ix) * step, f64::from(ix % 2) * step))
            .collect();
        format!("G21 G90 {mode}\nG0 X0 Y0\n{moves}M2\n")
    }

    #[test]
    fn exact_path_stops_at_sharp_corners_too() {
        check_rule(
            &RULE,
            "linuxcnc",
            &contour("G61", 0.3),
            &expect![[r#"
            23 | G1 X6.300 Y0.300 F500
               | ^^^^^^^^^^^^^^^^^^^^^ info[exact-stop-in-short-segments] the axes stop at every corner of short segments (`G61`)
        "#]],
        );
    }

    #[test]
    fn blending_and_longer_moves_are_fine() {
        check_rule(&RULE, "linuxcnc", &contour("G64 P0.01", 0.3), &expect![[""]]);
        check_rule(&RULE, "linuxcnc", &contour("G61", 3.0), &expect![[""]]);
    }
}
