//! A finishing pass under a rough level of smoothing.

use gcheck_controls::Effect;
use gcheck_engine::{At, Event, Fact};

use crate::declare::declare_rule;
use crate::facts::cutting::is_cut;
use crate::facts::tool_comment::comments_in;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A cut that a comment calls finishing runs under the level of smoothing for roughing (`G187 P1`).
    ///
    /// The comment is the last one before the cut, up to thirty blocks back.
    ///
    /// ## Why it matters
    /// Under the rough level the control rounds corners more: edges and small radii come out too large, and the part is out
    /// of tolerance where it is finished.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G187 P1
    /// (ROUGH POCKET)
    /// G1 X1. F50.
    /// (FINISH WALLS)
    /// G1 X2. F20.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G187 P1
    /// (ROUGH POCKET)
    /// G1 X1. F50.
    /// (FINISH WALLS)
    /// G187 P3
    /// G1 X2. F20.
    /// M30
    /// ```
    rule "finish-under-rough-level" in "motion" {
        summary: "finishing pass under rough smoothing",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(FinishUnderRoughLevel::default()),
        },
    }
}

/// The level for roughing.
const ROUGH: u8 = 1;
/// Blocks before a cut that are searched for a comment.
const BACK: u32 = 30;

#[derive(Default, Clone, PartialEq)]
struct FinishUnderRoughLevel {
    /// The block that set the level for roughing, while it is in effect.
    rough: Option<At>,
    /// The block that set it where it was reported last.
    told: Option<At>,
    /// The tool that was in the spindle when the level was set.
    tool: Option<At>,
}

remembers!(FinishUnderRoughLevel: rough, told, tool);

impl PathRule for FinishUnderRoughLevel {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::Smoothing)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        match event {
            Event::Smoothing(smoothing) => match (smoothing.level, smoothing.tolerance) {
                (Some(ROUGH), _) => {
                    self.rough = Some(cx.origin().at);
                    self.tool = cx.definitions().set_by(Fact::Tool);
                }
                // A tolerance alone keeps the level.
                (None, Some(_)) => {}
                _ => self.rough = None,
            },
            Event::End => self.rough = None,
            _ => {}
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(rough) = self.rough.filter(|rough| self.told != Some(*rough)) else { return };
        if !is_cut(cx, event) {
            return;
        }
        let Some(comment) = finishing(cx, cx.origin().at) else { return };
        self.told = Some(rough);
        let name = cx.name_of_effect(Effect::Smoothing).unwrap_or_default();
        let is_of_another = self.tool != cx.definitions().set_by(Fact::Tool);
        let label = if is_of_another {
            "the level of the tool before is still on"
        } else {
            "corners are rounded as for roughing"
        };
        let mut finding = cx
            .finding(&META, cx.range(), format!("a finishing cut under the level for roughing (`{name} P1`)"))
            .label(label)
            .help(format!("give the level for finishing before this: `{name} P3`"));
        if let Some(range) = cx.range_of(comment) {
            finding = finding.also(range, "the comment says that this finishes");
        }
        if let Some(range) = cx.range_of(rough) {
            finding = finding.also(range, "the level is set here");
        }
        report.add(finding);
    }
}

/// The last comment before a block, if it says that what follows finishes.
fn finishing(cx: &PathCx<'_>, at: At) -> Option<At> {
    for back in 0..=BACK.min(at.block) {
        let before = At { block: at.block - back, ..at };
        let Some(comments) = comments_in(cx, before) else { continue };
        let is_finish = comments
            .split(|c: char| !c.is_ascii_alphanumeric())
            .any(|word| ["FINISH", "FINISHING"].contains(&word.to_ascii_uppercase().as_str()));
        return is_finish.then_some(before);
    }
    None
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_level_of_the_tool_before() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6 (ROUGHER)\nG187 P1\nG1 X1. F50.\nT2 M6 (FINISH END MILL)\nG1 X2. F20.\nX3.\nM30\n",
            &expect![[r#"
                5 | G1 X2. F20.
                  | ^^^^^^^^^^^ info[finish-under-rough-level] a finishing cut under the level for roughing (`G187 P1`)
            "#]],
        );
    }

    #[test]
    fn the_control_s_settings_again() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG187 P1\nG1 X1. F50.\nG187\n(FINISH)\nG1 X2. F20.\nM30\n",
            &expect![[""]],
        );
    }
}
