//! A rigid tap whose end is not above its start.

use gcheck_engine::{Axis, Event};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A rigid tap goes to another X or Y than the one where the tool is.
    ///
    /// ## Why it matters
    /// The tap moves sideways while it cuts its thread, and breaks.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 S100 M3
    /// G0 X0 Y0 Z5
    /// G33.1 X10 Z-10 K1
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 S100 M3
    /// G0 X10 Y0 Z5
    /// G33.1 X10 Z-10 K1
    /// M2
    /// ```
    rule "tap-moves-sideways" in "cycles" {
        summary: "rigid tap that moves sideways",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(TapMovesSideways) },
    }
}

struct TapMovesSideways;

/// Millimetres: a shorter way counts as none.
const NOTHING: f64 = 1e-6;

impl PathRule for TapMovesSideways {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::RigidTap { from, to, .. } = event else { return };
        let moves = |axis: &Axis| (to.raw(*axis) - from.raw(*axis)).abs() > NOTHING;
        let Some(axis) = [Axis::X, Axis::Y].into_iter().find(moves) else { return };
        let name = axis.name();
        report.add(
            cx.finding(
                &META,
                cx.letter_range(name),
                format!("the tap moves along `{name}` while it cuts its thread"),
            )
            .label("another place than that of the tool")
            .help(format!("go to this `{name}` at rapid first, then tap straight down")),
        );
    }
}
