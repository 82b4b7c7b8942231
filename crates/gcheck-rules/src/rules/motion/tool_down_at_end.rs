//! A program that ends with the tool below the zero of the part.

use gcheck_controls::Letter;
use gcheck_engine::{At, Axis, Event, Fact, Spindle};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range};
use crate::facts::cuts::SURFACE;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The program ends while the tool that cut last is still below the zero of the part, and below the heights of its
    /// rapid moves. It is a warning where the tool went down there at rapid with the spindle stopped.
    ///
    /// ## Why it matters
    /// The spindle stops in the part, and the first move of the next run drags the tool through it. The last retract is
    /// missing, its height has a wrong minus sign, or a code for machine coordinates (`G53`) is missing.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G21 G90 G54 G0 X0. Y0. S900 M3
    /// G43 H1 Z5.
    /// G1 Z-2. F100.
    /// X40.
    /// G0 X60.
    /// M5
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G21 G90 G54 G0 X0. Y0. S900 M3
    /// G43 H1 Z5.
    /// G1 Z-2. F100.
    /// X40.
    /// G53 G0 Z0.
    /// M5
    /// M30
    /// ```
    rule "tool-down-at-end" in "motion" {
        summary: "program ends with the tool below the zero of the part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS).union(Watch::RAPIDS),
            make: || Box::new(ToolDownAtEnd::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ToolDownAtEnd {
    /// The tool in the spindle has cut.
    has_cut: bool,
    /// The highest level of its rapid moves: if the zero is far above the part, all moves are below it.
    highest: Option<f64>,
    /// The block that brought it down at rapid while the spindle was stopped.
    lowered: Option<At>,
}

remembers!(ToolDownAtEnd: lowered);

/// The tool counts as down if it is deeper than the highest rapid move by more than this: millimetres.
const LIFT: f64 = 0.5;

impl PathRule for ToolDownAtEnd {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, _: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        (self.has_cut, self.lowered) = (true, None);
    }

    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if let Event::Travel(travel) = event
            && let Some(z) = travel.to.get(Axis::Z)
        {
            self.highest = Some(self.highest.map_or(z, |highest| highest.max(z)));
            let goes_down = travel.from.get(Axis::Z).is_some_and(|from| from > SURFACE && z < -LIFT);
            let is_stopped = cx.state().spindle() == Some(Spindle::Stopped) && self.has_cut;
            if goes_down && is_stopped && cx.is_on_every_path() {
                self.lowered = Some(cx.origin().at);
            } else if z > SURFACE {
                self.lowered = None;
            }
        }
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        match boundary(cx) {
            // The machine decides where the change leaves the tool.
            Some(Boundary::ToolChange) => *self = Self::default(),
            Some(Boundary::ProgramEnd) => self.end(cx, report),
            None => {}
        }
    }
}

impl ToolDownAtEnd {
    fn end(&self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // A program without Y, or in the ZX plane, may be for turning.
        let is_mill = cx.is_mill()
            && cx.file_index.letters.contains(Letter::of('Y'))
            && cx.state().plane(cx.model) != Some(Plane::Zx);
        // A probe and a pen work without the spindle, and may end anywhere.
        let works = self.has_cut && cx.definitions().set_by(Fact::Spindle).is_some();
        let (Some(z), Some(highest)) = (cx.state().actual().get(Axis::Z), self.highest) else { return };
        let is_down = z < SURFACE && z < highest - LIFT;
        if is_mill && works && is_down && !cx.origin().letters.contains(Letter::of('Z')) {
            let depth = cx.shown(Mm(-z));
            let finding = cx
                .finding(
                    &META,
                    boundary_range(cx, Boundary::ProgramEnd),
                    "the program ends with the tool below the zero of the part",
                )
                .label(format!("the tool is still {depth} below it"))
                .help("retract the tool from the part before the end");
            report.add(match self.lowered.and_then(|at| cx.range_of(at)) {
                Some(range) => {
                    finding.also(range, "the tool goes down here at rapid, with the spindle stopped")
                }
                None => finding.at_most(Severity::Info),
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_end_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G54 S900 M3\nG0 X0 Y0 Z5\nG1 Z-2 F90\nX9\nG0 X20\nM5\nM2\n",
            &expect![[r#"
                7 | M2
                  | ^^ info[tool-down-at-end] the program ends with the tool below the zero of the part
            "#]],
        );
    }

    #[test]
    fn down_at_rapid_with_the_spindle_stopped() {
        let program = |way: &str| {
            format!("G21 G90 G54 S900 M3\nG0 X0 Y0 Z5\nG1 Z-2 F90\nX9\nG0 Z5\nM5\n{way}\nG0 X0 Y0\nM2\n")
        };
        check_rule(
            &RULE,
            "linuxcnc",
            &program("G0 Z-5"),
            &expect![[r#"
                9 | M2
                  | ^^ warning[tool-down-at-end] the program ends with the tool below the zero of the part
            "#]],
        );
        check_rule(&RULE, "linuxcnc", &program("G53 G0 Z-5"), &expect![[""]]);
    }

    #[test]
    fn a_height_that_nobody_knows_is_not_judged() {
        let program = |up: &str| format!("G21 G90 G54 S900 M3\nG0 X0. Y0. Z5.\nG1 Z-2. F90.\n{up}\nM30\n");
        for up in ["G91 G28 Z0.", "G53 G0 Z0.", "G0 Z#100", "M98 P7000"] {
            check_rule(&RULE, "fanuc-mill", &program(up), &expect![[""]]);
        }
    }

    #[test]
    fn a_zero_far_above_the_part_is_no_surface() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G54 S900 M3\nG0 X0 Y0\nG0 Z-80\nG1 Z-90 F90\nX9\nG0 Z-80\nM5\nM2\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_pen_may_end_anywhere() {
        check_rule(&RULE, "linuxcnc", "G21 G90 G54\nG0 X0 Y0 Z5\nG1 Z-2 F90\nX9\nM2\n", &expect![[""]]);
    }

    #[test]
    fn turning_has_no_surface_above() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G18 G21 G90 G54 G97 S900 M3\nG0 X50 Z5\nG1 Z-20 F90\nM2\n",
            &expect![[""]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            "T101\nG21 G97 S900 M3\nG0 X50. Z5.\nG1 Z-20. F0.2\nM30\n",
            &expect![[""]],
        );
    }
}
