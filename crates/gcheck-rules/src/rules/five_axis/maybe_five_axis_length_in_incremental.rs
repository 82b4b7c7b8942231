//! A length along the tool that some path brings together with incremental words.

use gcheck_controls::CodeIx;
use gcheck_engine::Role;

use super::five_axis_length_in_incremental::{both, finding};
use crate::boundary::LeftOn;
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// On some path, 5-axis length compensation (`G143`) and incremental words (`G91`) are active together.
    ///
    /// ## Why it matters
    /// The control does not accept `G91` under `G143`. The program stops with an alarm when that path is taken.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90
    /// IF [#500 EQ 1] GOTO 10
    /// G91
    /// N10 G143 H1 X1. Y1. Z1. A5. B5.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90
    /// IF [#500 EQ 1] GOTO 10
    /// G91
    /// N10 G90 G143 H1 X1. Y1. Z1. A5. B5.
    /// M30
    /// ```
    rule "maybe-five-axis-length-in-incremental" in "five_axis" {
        summary: "5-axis tool length that some path combines with increments",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(MaybeFiveAxisLengthInIncremental) },
    }
}

struct MaybeFiveAxisLengthInIncremental;

impl PathRule for MaybeFiveAxisLengthInIncremental {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some([length, increments]) = both(cx) else { return };
        let is_certain = matches!([length, increments], [LeftOn::Surely(_), LeftOn::Surely(_)]);
        // Of what a program does that is not here nothing is said.
        if is_certain || cx.is_behind_unknown_program() {
            return;
        }
        let control = cx.scene.control();
        let code = |on: LeftOn| match on {
            LeftOn::Surely(code) | LeftOn::Maybe(code) => control.code_at(code),
        };
        let (Some(length), Some(increments)) = (code(length), code(increments)) else { return };
        let message =
            format!("words may be incremental under 5-axis length compensation (`{}`)", length.number());
        let mut finding = finding(cx, &META, message, length, increments);
        let sets = |at, role| {
            cx.find_word(at, |word| word.code != CodeIx::NONE && cx.model.role(word.code) == Some(role))
        };
        for role in [Role::Length, Role::Distance] {
            let set_by =
                cx.trace().set_by(gcheck_engine::Fact::Mode(role)).filter(|at| *at != cx.origin().at);
            if let Some(range) = set_by.and_then(|at| sets(at, role)) {
                finding = finding.also(range, "on one of the paths set here");
            }
        }
        report.add(cx.with_path(finding));
    }
}
