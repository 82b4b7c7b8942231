//! Turning while the C axis is engaged.

use gcheck_controls::{LetterSet, Machine};
use gcheck_engine::At;

use crate::declare::declare_rule;
use crate::facts::cutting::starts_spindle;
use crate::facts::second_spindle::swaps;
use crate::facts::workholding::{Moved, code_that};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The program starts the spindle for turning, and the C axis is still engaged: `M154` without `M155`. Controls whose data name
    /// no such codes are not judged. On many machines the start of the spindle releases the axis by itself, so this is an information.
    ///
    /// ## Why it matters
    /// The spindle is an axis: it keeps its angle or stops with an alarm. What a machine does depends on its make and
    /// its version.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G98 T808
    /// M154
    /// M133 P2000
    /// G0 X2. Z.2 C0.
    /// G1 Z-.5 F8.
    /// M135
    /// T101
    /// G99 G97 S500 M3
    /// G1 Z-1. F.01
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G98 T808
    /// M154
    /// M133 P2000
    /// G0 X2. Z.2 C0.
    /// G1 Z-.5 F8.
    /// M135
    /// M155
    /// T101
    /// G99 G97 S500 M3
    /// G1 Z-1. F.01
    /// M30
    /// ```
    rule "c-axis-left-engaged" in "spindle" {
        summary: "spindle started for turning with the C axis engaged",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(CAxisLeftEngaged { engaged: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct CAxisLeftEngaged {
    /// The block that engaged the axis.
    engaged: Option<At>,
}

remembers!(CAxisLeftEngaged: engaged);

/// The modal group of the codes that engage the axis and release it.
const GROUP: &str = "c-axis";

impl PathRule for CAxisLeftEngaged {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let control = program.environment.control();
        control.machine() == Machine::Lathe && control.codes().any(|code| code.entry().group == GROUP)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_known = cx.is_certain();
        let mut is_released = !is_known;
        for code in cx.codes().iter().filter_map(|ix| cx.code_of(*ix)) {
            let is_own = code.entry().group == GROUP;
            if is_own && !code.entry().cancelled_by.is_empty() {
                self.engaged = Some(cx.origin().at);
            }
            // What the machine builder made of a code may release it. Another spindle has an axis of its own.
            is_released |= is_own && code.entry().cancelled_by.is_empty() || code.is_user();
        }
        if is_released || swaps(cx) {
            self.engaged = None;
        }
        let starts = |effect| starts_spindle(effect) && effect != gcheck_controls::Effect::LiveToolOn;
        if !cx.has_effect(starts) || cx.origin().letters.intersects(LetterSet::of("C")) {
            return;
        }
        let Some(engaged) = self.engaged.take() else { return };
        let code = |moved| code_that(cx.control(), GROUP, moved);
        let (Some(on), Some(off)) = (code(Moved::Out), code(Moved::Back)) else { return };
        let (name, end) = (on.number(), off.number());
        let mut finding = cx
            .finding(
                &META,
                cx.effect_range(starts),
                format!("the spindle starts with the C axis engaged (`{name}`)"),
            )
            .label(format!("no `{end}` before this"))
            .note(format!("`{end}`: {}  [{}]", off.entry().summary, off.entry().source))
            .assuming("the start of the spindle does not release the axis by itself")
            .help(format!("release the C axis with `{end}` before this block"));
        if let Some((_, range)) = cx.find_code(engaged, |code| code.entry().group == GROUP) {
            finding = finding.also(range, "engaged here");
        }
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn once_for_each_time_that_it_is_engaged() {
        let program = |between: &str| {
            format!(
                "G20 G98 T808\nM154\nM133 P2000\nG0 X2. Z.2 C0.\nM135\n{between}T101\nG99 G97 S500 M3\nG1 Z-1. F.01\nM5\nM3\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-lathe",
            &program(""),
            &expect![[r#"
                7 | G99 G97 S500 M3
                  |              ^^ info[c-axis-left-engaged] the spindle starts with the C axis engaged (`M154`)
            "#]],
        );
        for between in ["M155\n", "M98 P77\n", "G14\n"] {
            check_rule(&RULE, "haas-lathe", &program(between), &expect![[""]]);
        }
    }
}
