//! A work offset that the configuration does not list.

use gcheck_controls::{CodeIx, Effect};
use gcheck_engine::{Event, Fact, Role};
use gcheck_lint::work_offset_name;

use crate::declare::declare_rule;
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A program cuts in a work offset that `[offsets]` of the configuration lists, and in another one that it does not
    /// list.
    ///
    /// The rule needs work offsets in the configuration.
    ///
    /// ## Why it matters
    /// A mistyped work offset sends the tool to a place without a part. If the offset is right, its travel and
    /// positions remain unchecked until it is listed.
    ///
    /// ## Reported
    /// With `G54` in `[offsets]`:
    /// ```nc,reported,haas-mill
    /// G54 G1 X1. F10.
    /// G56 X2.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G54 G1 X1. F10.
    /// G0 X2.
    /// M30
    /// ```
    /// ## How to fix it
    /// * Correct the work offset.
    /// * If the program means it, list it in `[offsets]` of `gcheck.toml`: then its travel is checked too.
    rule "work-offset-not-listed" in "machine" {
        summary: "cut in a work offset that the configuration does not list",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CUTS.union(Watch::FOLLOWED),
            make: || Box::new(WorkOffsetNotListed::default()),
        },
    }
}

#[derive(Clone, Default, PartialEq)]
struct WorkOffsetNotListed {
    /// A cut in an offset that is listed was seen.
    has_listed: bool,
    /// By offset that is not listed: the finding of its first cut.
    found: Vec<(u16, Finding)>,
}

remembers!(WorkOffsetNotListed: found);

/// More of them are not a slip.
const MOST: usize = 20;

impl PathRule for WorkOffsetNotListed {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        !program.environment.machine.engine.offsets.is_empty()
            && program.may(|effect| matches!(effect, Effect::WorkOffset(_) | Effect::WorkOffsetByP(_)))
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        let Some(number) = cx.state().work() else { return };
        if cx.environment.machine.engine.offsets.contains_key(&number) {
            self.has_listed = true;
            return;
        }
        if self.found.len() >= MOST || self.found.iter().any(|(known, _)| *known == number) {
            return;
        }
        // The program did not choose the offset of the start.
        let Some(chosen) = cx.definitions().set_by(Fact::Mode(Role::WorkOffset)) else { return };
        let is_offset = |word: &gcheck_program::Word| {
            matches!(cx.model.effect(word.code), Effect::WorkOffset(_) | Effect::WorkOffsetByP(_))
        };
        let place = cx.find_word(chosen, is_offset).unwrap_or_else(|| cx.range());
        // The name in the program: some offsets have two names.
        let code = cx.state().mode(Role::WorkOffset).only().unwrap_or(CodeIx::NONE);
        let name = match cx.model.effect(code) {
            Effect::WorkOffsetByP(first) if first <= number => {
                format!("{} P{}", cx.name_of(code), number - first + 1)
            }
            _ => work_offset_name(number, cx.model),
        };
        let finding = cx
            .finding(&META, place, format!("`{name}` is not among the work offsets of the configuration"))
            .label("the program cuts in it")
            .help(format!("correct the work offset, or list `{name}` in `[offsets]` of gcheck.toml"));
        self.found.push((number, finding));
    }

    fn followed(&mut self, cx: &FollowedCx<'_>, report: &mut Report<'_>) {
        if !self.has_listed {
            return;
        }
        let offsets = cx.environment.machine.engine.offsets.keys();
        let names: Vec<String> =
            offsets.take(6).map(|n| format!("`{}`", work_offset_name(*n, cx.model))).collect();
        for (_, finding) in self.found.drain(..) {
            report.add(finding.note(format!("listed are {}", names.join(", "))));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn the_code_is_marked_once() {
        check_rule_in(
            &RULE,
            "haas-mill",
            "T1 M6\nG54 G1 X1. F10.\nT2 M6\nG0 G154 P3 X2.\nG1 X3.\nM8\nX2.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                4 | G0 G154 P3 X2.
                  |    ^^^^ info[work-offset-not-listed] `G154 P3` is not among the work offsets of the configuration
            "#]],
        );
    }

    #[test]
    fn a_list_of_other_offsets_says_nothing_of_this_program() {
        let world = World::of_examples(&META);
        check_rule_in(&RULE, "haas-mill", "G57 G1 X1. F10.\nM30\n", &world, &expect![[""]]);
        check_rule(&RULE, "haas-mill", "G57 G1 X1. F10.\nG54 X2.\nM30\n", &expect![[""]]);
    }
}
