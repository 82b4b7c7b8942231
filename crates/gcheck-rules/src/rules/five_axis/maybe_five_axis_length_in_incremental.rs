//! 5-axis tool length compensation with incremental words, on some paths.

use gcheck_controls::CodeIx;
use gcheck_engine::Role;

use crate::declare::declare_rule;
use crate::facts::five_axis::{increments_finding, length_and_increments};
use crate::facts::modes::ActiveMode;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// On some paths, 5-axis length compensation (`G143`) and incremental words (`G91`) are active together.
    ///
    /// ## Why it matters
    /// The control does not accept `G91` under `G143`. The program stops with an alarm when such a path is taken.
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
        summary: "5-axis tool length that some paths combine with increments",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(MaybeFiveAxisLengthInIncremental) },
    }
}

struct MaybeFiveAxisLengthInIncremental;

impl PathRule for MaybeFiveAxisLengthInIncremental {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some([length, increments]) = length_and_increments(cx) else { return };
        let is_certain = matches!([length, increments], [ActiveMode::Certain(_), ActiveMode::Certain(_)]);
        // Other programs are not judged here.
        if is_certain || cx.is_after_unknown_program() {
            return;
        }
        let control = cx.control();
        let code = |on: ActiveMode| match on {
            ActiveMode::Certain(code) | ActiveMode::Possible(code) => control.code_at(code),
        };
        let (Some(length), Some(increments)) = (code(length), code(increments)) else { return };
        let message =
            format!("words may be incremental under 5-axis length compensation (`{}`)", length.number());
        let mut finding = increments_finding(cx, &META, message, length, increments);
        let sets = |at, role| {
            cx.find_word(at, |word| word.code != CodeIx::NONE && cx.model.role(word.code) == Some(role))
        };
        for role in [Role::Length, Role::Distance] {
            let set_by =
                cx.definitions().set_by(gcheck_engine::Fact::Mode(role)).filter(|at| *at != cx.origin().at);
            if let Some(range) = set_by.and_then(|at| sets(at, role)) {
                finding = finding.also(range, "on one of the paths set here");
            }
        }
        report.add(cx.with_path(finding));
    }
}
