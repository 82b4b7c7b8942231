//! What some path does while the axes are shifted along a tilting tool or along vectors.

use std::collections::BTreeSet;

use gcheck_controls::CodeIx;
use gcheck_engine::At;

use super::refused_in_five_axis_mode::{Clash, clashes, finding, set_by, uses_modes};
use crate::boundary::LeftOn;
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// On some path, a block asks for what 5-axis tool length compensation (`G143`) or 3D cutter compensation (`G141`) exclude: an
    /// arc, a canned cycle, a pocket, cutter compensation in a plane.
    ///
    /// ## Why it matters
    /// Both work with straight moves (`G0`, `G1`) only. The control stops with an alarm when that path is taken.
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
        summary: "refused on some path under 5-axis modes",
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
    /// What was reported, by the block that switched the mode on.
    told: BTreeSet<(At, CodeIx)>,
}

remembers!(MaybeRefusedInFiveAxisMode: told);

impl PathRule for MaybeRefusedInFiveAxisMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !uses_modes(cx) {
            cx.enough();
            return;
        }
        if cx.is_behind_unknown_program() {
            return;
        }
        for clash in clashes(cx) {
            let Clash { mode: LeftOn::Surely(mode) | LeftOn::Maybe(mode), code, is_certain, .. } = clash;
            let is_sure = is_certain && matches!(clash.mode, LeftOn::Surely(_));
            if is_sure || !self.told.insert((set_by(cx, mode), code)) {
                continue;
            }
            if let Some(finding) = finding(cx, &META, &clash, "may be ") {
                report.add(cx.with_path(finding));
            }
        }
    }
}
