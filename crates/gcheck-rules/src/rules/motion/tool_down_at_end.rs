//! A program that ends with the tool in the part.

use gcheck_engine::{At, Axis, Event, Fact};
use gcheck_geometry::Mm;

use crate::boundary::Boundary;
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The program ends while the tool that cut last still stands below the zero of the part.
    ///
    /// ## Why it matters
    /// The spindle stops in the part, and the first move of the next run drags the tool through it. The last retract is
    /// missing, or its height has a minus sign too many.
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
            watch: Watch::BLOCKS.union(Watch::CUTS),
            make: || Box::new(ToolDownAtEnd { cut: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct ToolDownAtEnd {
    /// A cut of the tool in the spindle.
    cut: Option<At>,
}

remembers!(ToolDownAtEnd: cut);

/// Millimetres: depths above this are the surface of the part.
const SURFACE: f64 = -0.01;

impl PathRule for ToolDownAtEnd {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        self.cut = Some(cx.origin().at);
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        match cx.boundary() {
            // Where the change leaves the tool is the machine's business.
            Some(Boundary::ToolChange) => self.cut = None,
            Some(Boundary::ProgramEnd) => self.end(cx, report),
            None => {}
        }
    }
}

impl ToolDownAtEnd {
    fn end(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_mill = cx.scene.control().machine() == gcheck_controls::Machine::Mill;
        // A probe and a pen go without the spindle, and may end anywhere.
        let works = self.cut.take().is_some() && cx.trace().set_by(Fact::Spindle).is_some();
        let Some(z) = cx.state().actual().get(Axis::Z).filter(|z| *z < SURFACE) else { return };
        if is_mill && works && !cx.origin().letters.contains(gcheck_controls::Letter::of('Z')) {
            let depth = cx.shown(Mm(-z));
            report.add(
                cx.finding(
                    &META,
                    cx.boundary_range(Boundary::ProgramEnd),
                    "the program ends with the tool below the zero of the part",
                )
                .label(format!("the tool still stands {depth} below it"))
                .help("lift the tool out of the part before the end"),
            );
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
            &expect![[""]],
        );
    }

    #[test]
    fn a_height_that_nobody_knows_is_not_judged() {
        let program = |up: &str| format!("G21 G90 G54 S900 M3\nG0 X0. Y0. Z5.\nG1 Z-2. F90.\n{up}\nM30\n");
        for up in ["G91 G28 Z0.", "G53 G0 Z0.", "G0 Z#100", "M98 P7000"] {
            check_rule(&RULE, "fanuc-mill", &program(up), &expect![[""]]);
        }
    }

    #[test]
    fn a_pen_may_end_anywhere() {
        check_rule(&RULE, "linuxcnc", "G21 G90 G54\nG0 X0 Y0 Z5\nG1 Z-2 F90\nX9\nM2\n", &expect![[""]]);
    }

    #[test]
    fn turning_has_no_surface_above() {
        check_rule(
            &RULE,
            "haas-lathe",
            "T101\nG21 G97 S900 M3\nG0 X50. Z5.\nG1 Z-20. F0.2\nM30\n",
            &expect![[""]],
        );
    }
}
