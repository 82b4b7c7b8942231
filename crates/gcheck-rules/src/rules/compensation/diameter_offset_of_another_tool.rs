//! A cutter compensation offset that does not follow the scheme of the program's other tools.

use gcheck_engine::{Abstract, Domain, Event, Fact, Role};

use super::compensation_left_on::is_on;
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::schemes::{Pairs, whole};
use crate::{FinishCx, PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A tool cuts with the cutter compensation offset that, by the scheme of the program's other tools, belongs to another tool:
    /// the others take `D` equal to `T`, or `T` and a fixed number more, and this one does not.
    ///
    /// ## Why it matters
    /// The contour comes out too large or too small by the difference of the two tools.
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
        mends: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CUTS.union(Watch::FINISH),
            make: || Box::new(DiameterOffsetOfAnotherTool { pairs: Pairs::new() }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct DiameterOffsetOfAnotherTool {
    pairs: Pairs,
}

remembers!(DiameterOffsetOfAnotherTool: pairs);

impl PathRule for DiameterOffsetOfAnotherTool {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(super::compensation_left_on::is_on)
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        let state = cx.state();
        if !state.effect(Role::Compensation, cx.model).is_some_and(is_on) {
            return;
        }
        let (tool, offset) = (Abstract::known(state.tool()), Abstract::known(state.d()));
        let (Some(tool), Some(offset)) = (tool.and_then(whole), offset.and_then(whole)) else { return };
        self.pairs.add(tool, offset, || {
            let set_by = cx.trace().set_by(Fact::Mode(Role::Compensation));
            let range = set_by.and_then(|at| cx.find_word(at, |word| word.letter.ascii() == b'D'));
            let message = format!("tool {tool} cuts with diameter offset {offset} (`D{offset}`, `T{tool}`)");
            let finding = cx.finding(&META, range.clone().unwrap_or_else(|| cx.range()), message);
            let finding = match cx.trace().set_by(Fact::Tool).and_then(|at| cx.range_of(at)) {
                Some(range) => finding.also(range, format!("tool {tool} comes into the spindle here")),
                None => finding,
            };
            (finding, range)
        });
    }

    fn finish(&mut self, _: &FinishCx<'_>, report: &mut Report<'_>) {
        for (finding, scheme) in self.pairs.take_odd('D') {
            report.add(
                finding
                    .label(scheme.label("diameter offset"))
                    .note(scheme.note("diameter offset", 'D'))
                    .help(format!("use `D{}`, or tell why not in a suppression", scheme.expected)),
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
    fn a_second_size_for_finishing_is_meant() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG41 D1 G1 X1. F5.\nG40 X0.\nT2 M6\nG41 D32 G1 X1.\nG40 X0.\nG41 D2 G1 X1.\nG40 X0.\nM30\n",
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
