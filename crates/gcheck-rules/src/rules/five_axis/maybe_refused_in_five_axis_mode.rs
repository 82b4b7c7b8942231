//! What a 5-axis mode refuses, on some paths.

use std::collections::BTreeSet;

use gcheck_controls::CodeIx;
use gcheck_engine::At;

use crate::declare::declare_rule;
use crate::facts::five_axis::{Clash, clash_finding, clashes, switched_on_by, uses_five_axis_modes};
use crate::facts::modes::ActiveMode;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// On some paths, a block asks for what 5-axis tool length compensation (`G143`) or 3D cutter compensation (`G141`)
    /// exclude: an arc, a canned cycle, a pocket, cutter compensation in a plane.
    ///
    /// ## Why it matters
    /// Both work with straight moves (`G0`, `G1`) only. The control stops with an alarm when such a path is taken.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G0 X0. Y0. Z1. A0. B0.
    /// IF [#500 EQ 1] GOTO 10
    /// G143 H1 X0. Y0. Z1. A0. B0.
    /// N10 G2 X1. Y1. R1. F20.
    /// G49
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G0 X0. Y0. Z1. A0. B0.
    /// IF [#500 EQ 1] GOTO 10
    /// G143 H1 X0. Y0. Z1. A0. B0.
    /// N10 G49
    /// G2 X1. Y1. R1. F20.
    /// M30
    /// ```
    rule "maybe-refused-in-five-axis-mode" in "five_axis" {
        summary: "refused on some paths under 5-axis modes",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::ALL_BLOCKS,
            make: || Box::new(MaybeRefusedInFiveAxisMode { told: BTreeSet::new() }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct MaybeRefusedInFiveAxisMode {
    /// Findings that were reported, by the block that switched the mode on.
    told: BTreeSet<(At, CodeIx)>,
}

remembers!(MaybeRefusedInFiveAxisMode: told);

impl PathRule for MaybeRefusedInFiveAxisMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !uses_five_axis_modes(cx) {
            cx.enough();
            return;
        }
        if cx.is_after_unknown_program() {
            return;
        }
        for clash in clashes(cx) {
            let Clash {
                mode: ActiveMode::Certain(mode) | ActiveMode::Possible(mode), code, is_certain, ..
            } = clash;
            let is_sure = is_certain && matches!(clash.mode, ActiveMode::Certain(_));
            if is_sure || !self.told.insert((switched_on_by(cx, mode), code)) {
                continue;
            }
            if let Some(finding) = clash_finding(cx, &META, &clash, "may be ") {
                report.add(cx.with_path(finding));
            }
        }
    }
}
