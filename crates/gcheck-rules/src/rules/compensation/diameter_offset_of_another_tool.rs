//! A cutter compensation offset that does not follow the scheme of the program's other tools.

use gcheck_engine::{Abstract, At, Domain, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::is_before;
use crate::facts::compensation::is_on;
use crate::facts::cycles::is_pocket;
use crate::facts::offset_schemes::{Pairs, whole};
use crate::{FollowedCx, PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool cuts with a cutter compensation offset that, by the scheme of the program's other tools, belongs to
    /// another tool: the others use `D` equal to `T`, or `T` plus a fixed number, and this one does not. Or every tool
    /// has the length offset of its own number, and the `D` of this one is the number of another tool.
    ///
    /// ## Why it matters
    /// The contour comes out too large or too small by the difference between the two tools.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G41 D1 G1 X1. F5.
    /// G40 X0.
    /// T2 M6
    /// G41 D1 G1 X1.
    /// G40 X0.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G43 H1 Z1.
    /// G1 Z0. F5.
    /// T2 M6
    /// G43 H2 Z1.
    /// G41 D1 G1 X1.
    /// G40 X0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G41 D31 G1 X1. F5.
    /// G40 X0.
    /// T2 M6
    /// G41 D32 G1 X1.
    /// G40 X0.
    /// M30
    /// ```
    rule "diameter-offset-of-another-tool" in "compensation" {
        summary: "cutter compensation offset of another tool",
        severity: Warning,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS).union(Watch::FOLLOWED),
            make: || Box::new(DiameterOffsetOfAnotherTool { pairs: Pairs::new(), lengths: Vec::new() }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct DiameterOffsetOfAnotherTool {
    pairs: Pairs,
    /// Tools with the length offsets that they cut with.
    lengths: Vec<(u32, u32)>,
}

/// More lengths than this show no clear scheme.
const MOST_LENGTHS: usize = 1000;

remembers!(DiameterOffsetOfAnotherTool: pairs);

impl PathRule for DiameterOffsetOfAnotherTool {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| is_on(effect) || is_pocket(effect))
    }

    /// A pocket compensates for its cutter by itself, also where its size is not known and no cut is shown.
    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if cx.has_effect(is_pocket)
            && let Some(tool) = self.tool_at_work(cx)
            && let Some(offset) = cx.known_number('D').and_then(whole)
        {
            self.note(cx, tool, offset, Some(cx.origin().at));
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        let Some(tool) = self.tool_at_work(cx) else { return };
        if cx.has_effect(is_pocket) || !cx.state().effect(Role::Compensation, cx.model).is_some_and(is_on) {
            return;
        }
        // Compensation that the tool before left on is that tool's, and another rule reports that.
        let on = cx.definitions().set_by(Fact::Mode(Role::Compensation));
        if on.zip(cx.definitions().set_by(Fact::Tool)).is_some_and(|(on, changed)| is_before(on, changed)) {
            return;
        }
        if let Some(offset) = Abstract::known(cx.state().d()).and_then(whole) {
            self.note(cx, tool, offset, on);
        }
    }

    fn followed(&mut self, cx: &FollowedCx<'_>, report: &mut Report<'_>) {
        for (finding, scheme) in self.pairs.take_odd('D', false) {
            let finding = if scheme.is_unsure { finding.at_most(Severity::Info) } else { finding };
            report.add(
                finding
                    .label(scheme.label("diameter offset"))
                    .note(scheme.note("diameter offset", 'D'))
                    .help(format!("use `D{}`, or say why not in a suppression", scheme.expected)),
            );
        }
        if cx.model.semantics().tools.offsets_of_tools && cx.model.semantics().tools.radius_from_tool {
            for (finding, tool) in self.pairs.take_strangers(Some('D')) {
                report.add(
                    finding
                        .label("that is the number of another tool")
                        .help(format!("use `D{tool}`, or leave `D` out for the tool in the spindle")),
                );
            }
        }
        // If lengths follow the tools' numbers, sizes are assumed to do so too.
        if self.lengths.len() < 2 || self.lengths.iter().any(|(tool, length)| tool != length) {
            return;
        }
        let tools: Vec<u32> = self.lengths.iter().map(|(tool, _)| *tool).collect();
        for (finding, tool, owner) in self.pairs.take_named_after('D', &tools) {
            report.add(
                finding
                    .label(format!("that is the number of tool {owner}"))
                    .note("the tools of the program have the length offset of their own number (H = T)")
                    .help(format!("use `D{tool}`, or say why not in a suppression")),
            );
        }
    }
}

impl DiameterOffsetOfAnotherTool {
    /// The tool in the spindle; notes the length offset that it works with.
    fn tool_at_work(&mut self, cx: &PathCx<'_>) -> Option<u32> {
        let tool = Abstract::known(cx.state().tool()).and_then(whole)?;
        if let Some(length) = length_of(cx)
            && !self.lengths.contains(&(tool, length))
            && self.lengths.len() < MOST_LENGTHS
        {
            self.lengths.push((tool, length));
        }
        Some(tool)
    }

    /// The tool works with an offset, which a block names.
    fn note(&mut self, cx: &PathCx<'_>, tool: u32, offset: u32, named_by: Option<At>) {
        self.pairs.add(tool, offset, cx.definitions().set_by(Fact::Tool), || {
            let range = named_by.and_then(|at| cx.find_word(at, |word| word.letter.ascii() == b'D'));
            let message = format!("tool {tool} cuts with diameter offset {offset} (`D{offset}`, `T{tool}`)");
            let finding = cx.finding(&META, range.clone().unwrap_or_else(|| cx.range()), message);
            let finding = match cx.definitions().set_by(Fact::Tool).and_then(|at| cx.range_of(at)) {
                Some(range) => finding.also(range, format!("tool {tool} comes into the spindle here")),
                None => finding,
            };
            (finding, range)
        });
    }
}

/// The number of the length offset that the tool cuts with.
fn length_of(cx: &PathCx<'_>) -> Option<u32> {
    cx.state().effect(Role::Length, cx.model).filter(|effect| effect.is_length_compensation())?;
    Abstract::known(cx.state().h()).and_then(whole).filter(|length| *length > 0)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_pocket_has_its_offset_in_its_block() {
        let pocket = |tool: u8, offset: u8| {
            format!(
                "T{tool} M6\nG54 G0 X0 Y0 S900 M3\nG43 H{tool} Z.1\nG13 Z-.25 I.35 D{offset} F18.\nG0 Z1.\n"
            )
        };
        let program = |offset: u8| format!("G20 G90\n{}{}M30\n", pocket(3, offset), pocket(7, 7));
        check_rule(
            &RULE,
            "haas-mill",
            &program(7),
            &expect![[r#"
            5 | G13 Z-.25 I.35 D7 F18.
              |                ^^ warning[diameter-offset-of-another-tool] tool 3 cuts with diameter offset 7 (`D7`, `T3`)
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program(3), &expect![[""]]);
    }

    #[test]
    fn the_offset_that_breaks_the_scheme_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG41 D1 G1 X1. F5.\nG40 X0.\nT2 M6\nG41 D2 G1 X1.\nG40 X0.\nT3 M6\nG42 D2 G1 X1.\nG40 X0.\nM30\n",
            &expect![[r#"
                8 | G42 D2 G1 X1.
                  |     ^^ warning[diameter-offset-of-another-tool] tool 3 cuts with diameter offset 2 (`D2`, `T3`)
            "#]],
        );
    }

    #[test]
    fn sizes_that_no_length_explains_may_be_numbered_otherwise() {
        let program = |d: &str, h: &str| {
            format!("T1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nT2 M6\nG43 {h} Z1.\nG41 {d} G1 X1.\nG40 X0.\nM30\n")
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("D1", "H2"),
            &expect![[r#"
            6 | G41 D1 G1 X1.
              |     ^^ warning[diameter-offset-of-another-tool] tool 2 cuts with diameter offset 1 (`D1`, `T2`)
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("D32", "H2"), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("D1", "H22"), &expect![[""]]);
    }

    #[test]
    fn a_second_size_for_finishing_is_meant() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG41 D1 G1 X1. F5.\nG40 X0.\nT2 M6\nG41 D32 G1 X1.\nG40 X0.\nG41 D2 G1 X1.\nG40 X0.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn compensation_that_was_left_on_is_not_this_tools() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG43 H1 Z1.\nG41 D1 G1 X1. F5.\nX2.\nT2 M6\nG43 H2 Z1.\nG1 X1.\nG40 X0.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn the_tool_in_the_spindle_has_its_own_size() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 T1 M6\nG41 G1 X10 F50\nG40 X0\nT2 M6\nG41 G1 X10\nG40 X0\nM2\n",
            &expect![[""]],
        );
    }
}
