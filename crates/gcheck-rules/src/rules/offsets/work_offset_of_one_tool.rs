//! One tool in another work offset than all other tools.

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Role};
use gcheck_lint::work_offset_name;

use crate::declare::declare_rule;
use crate::facts::offset_schemes::whole;
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// All tools but one work in the same work offset, or all tool sections but one.
    ///
    /// ## Why it matters
    /// An offset that was changed in every section but one sends the tool to the wrong place. A tool may deliberately
    /// work in another offset: the rule is for shops that say so in a comment.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54
    /// T1 M6
    /// G1 X1. F10.
    /// T2 M6
    /// G54 G1 X1.
    /// T3 M6
    /// G55 G1 X1.
    /// T4 M6
    /// G54 G1 X1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54
    /// T1 M6
    /// G1 X1. F10.
    /// G55 X1.
    /// T2 M6
    /// G54 G1 X1.
    /// G55 X1.
    /// T3 M6
    /// G55 G1 X1.
    /// T4 M6
    /// G54 G1 X1.
    /// M30
    /// ```
    rule "work-offset-of-one-tool" in "offsets" {
        summary: "one tool works in another work offset than all others",
        severity: Info,
        tier: Path,
        recommended: false,
        sets: [Strict],
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CUTS.union(Watch::FOLLOWED),
            make: || Box::new(WorkOffsetOfOneTool::default()),
        },
    }
}

#[derive(Clone, Default, PartialEq)]
struct WorkOffsetOfOneTool {
    /// Tool changes, with the offsets in which the tools then cut.
    works: Vec<Work>,
}

remembers!(WorkOffsetOfOneTool: works);

#[derive(Clone, PartialEq)]
struct Work {
    /// The tool change.
    section: At,
    tool: u32,
    offset: u16,
    /// Its finding, if it is the exception.
    finding: Finding,
}

remembers!(Work: section, finding);

/// More show no clear scheme.
const MOST_WORKS: usize = 500;

/// So many tools must work in the usual offset.
const FOLLOWERS: usize = 2;

impl PathRule for WorkOffsetOfOneTool {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| matches!(effect, Effect::WorkOffset(_) | Effect::WorkOffsetByP(_)))
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        let tool = Abstract::known(cx.state().tool()).and_then(whole);
        let (Some(tool), Some(offset)) = (tool.filter(|tool| *tool > 0), cx.state().work()) else { return };
        let Some(section) = cx.definitions().set_by(Fact::Tool) else { return };
        let is_known = self.works.iter().any(|work| (work.section, work.offset) == (section, offset));
        if is_known || self.works.len() >= MOST_WORKS || cx.is_called_only() {
            return;
        }
        let name = work_offset_name(offset, cx.model);
        let message = format!("tool {tool} alone works in `{name}`");
        let mut finding = cx
            .finding(&META, cx.range(), message)
            .label("its first cut")
            .help("check the offset; if it is right, say so in a suppression");
        if let Some(at) = cx.definitions().set_by(Fact::Mode(Role::WorkOffset))
            && let Some(range) = cx.range_of(at)
        {
            finding = finding.also(range, format!("`{name}` chosen here"));
        }
        self.works.push(Work { section, tool, offset, finding });
    }

    fn followed(&mut self, cx: &FollowedCx<'_>, report: &mut Report<'_>) {
        let Some(first) = self.works.first().map(|work| work.offset) else { return };
        let in_offset = |offset: u16| self.works.iter().filter(move |work| work.offset == offset);
        let usual = self.works.iter().map(|work| work.offset);
        let usual = usual.max_by_key(|offset| (in_offset(*offset).count(), *offset == first));
        let Some(usual) = usual else { return };
        let followers = in_offset(usual).count();
        let mut others = self.works.iter().filter(|work| work.offset != usual);
        let (Some(odd), None) = (others.next(), others.next()) else { return };
        let works_in_both = in_offset(usual).any(|work| work.section == odd.section);
        if followers < FOLLOWERS || works_in_both {
            return;
        }
        let usual = work_offset_name(usual, cx.model);
        let note = format!("all other cuts, in {followers} tool sections, are in `{usual}`");
        report.add(odd.finding.clone().note(note));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_work_counts_not_the_number_of_the_tool() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G54 F100.\nT1 M6\nG1 X1.\nT2 M6\nG1 X1.\nT1 M6\nG56 G1 X1.\nT2 M6\nG54 G1 X2.\nM30\n",
            &expect![[r#"
                7 | G56 G1 X1.
                  | ^^^^^^^^^^ info[work-offset-of-one-tool] tool 1 alone works in `G56`
            "#]],
        );
        check_rule(&RULE, "fanuc-mill", "G54 F100.\nT1 M6\nG1 X1.\nT2 M6\nG56 G1 X1.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn two_tools_of_another_place_are_meant() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G54 F100.\nT1 M6\nG1 X1.\nT2 M6\nG1 X1.\nT3 M6\nG1 X1.\nG55\nT4 M6\nG1 X1.\nT5 M6\nG1 X2.\nM30\n",
            &expect![[""]],
        );
    }
}
