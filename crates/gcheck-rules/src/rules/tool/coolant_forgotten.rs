//! Coolant that is switched off for a tool that never had it on.

use gcheck_controls::Effect;
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::boundary::with_tool_change;
use crate::facts::coolant::CoolantWatch;
use crate::facts::cutting::is_cut;
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// One tool cuts with the coolant off, and its section ends by switching it off (`M9`), while all other tools of
    /// the program cut with coolant.
    ///
    /// For a tool that cuts dry without any coolant code, see `tool-cuts-dry`.
    ///
    /// ## Why it matters
    /// The `M9` shows that the tool should have coolant. A forgotten `M8` burns the tool, or leaves chips in the hole.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// S1000 M3
    /// G1 X1. F10.
    /// M9
    /// T2 M6
    /// S1000 M3
    /// M8
    /// G1 X2. F10.
    /// M9
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// S1000 M3
    /// G1 X1. F10.
    /// T2 M6
    /// S1000 M3
    /// M8
    /// G1 X2. F10.
    /// M9
    /// M30
    /// ```
    rule "coolant-forgotten" in "tool" {
        summary: "coolant switched off for a tool that never had it on",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::CUTS).union(Watch::FOLLOWED),
            make: || Box::new(CoolantForgotten::default()),
        },
    }
}

#[derive(Clone, Default, PartialEq)]
struct CoolantForgotten {
    coolant: CoolantWatch,
    /// The first cut of the present tool, if it was dry and no coolant code followed.
    dry: Option<Finding>,
    /// Tools that cut with coolant.
    wet: usize,
    /// Tools that cut dry without any coolant code.
    silent: usize,
    /// The finding of the first tool that switches off coolant that was not on.
    odd: Option<Finding>,
    /// How many there are.
    odd_ones: usize,
    /// It is the present tool.
    is_last: bool,
}

remembers!(CoolantForgotten: dry, odd);

impl PathRule for CoolantForgotten {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::CoolantOff) && program.may(Effect::starts_coolant)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        let was_on = self.coolant.is_on();
        self.coolant.changed(event);
        match event {
            Event::Coolant { on: true, .. } => self.dry = None,
            Event::Coolant { on: false, .. } => {
                let is_off = |effect| effect == Effect::CoolantOff;
                if !was_on
                    && cx.has_effect(is_off)
                    && let Some(finding) = self.dry.take()
                {
                    self.odd_ones += 1;
                    self.is_last = true;
                    self.odd = self.odd.take().or(Some(
                        finding
                            .also(cx.effect_range(is_off), "the coolant that this switches off was not on"),
                    ));
                }
            }
            Event::ToolChange(_) => {
                self.is_last = false;
                self.silent += usize::from(self.dry.take().is_some());
            }
            _ => {}
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if !self.coolant.is_first_cut(event, is_cut(cx, event)) {
            return;
        }
        if self.coolant.is_on() {
            self.wet += 1;
            return;
        }
        let on = cx
            .name_of_effect(Effect::FloodOn)
            .or_else(|| cx.name_of_effect(Effect::MistOn))
            .unwrap_or_default();
        let off = cx.name_of_effect(Effect::CoolantOff).unwrap_or_default();
        let message = format!("the tool cuts with the coolant off (no `{on}` before its `{off}`)");
        let finding = cx
            .finding(&META, cx.range(), message)
            .label("its first cut")
            .help(format!("switch the coolant on with `{on}`, or remove the `{off}` if the tool cuts dry"));
        self.dry = Some(with_tool_change(cx, finding));
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        // Many programs switch everything off at their end, whatever was on: there one other tool is not evidence.
        let enough = if self.is_last { 2 } else { 1 };
        let is_alone = self.odd_ones == 1 && self.silent == 0 && self.dry.is_none();
        if let Some(finding) = self.odd.take().filter(|_| is_alone && self.wet >= enough) {
            let others = match self.wet {
                1 => "the program's other tool cuts with coolant".to_owned(),
                wet => format!("the {wet} other tools of the program cut with coolant"),
            };
            report.add(finding.note(others));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    /// A program of tools, each with what is before and after its cut.
    fn program(tools: &[(&str, &str)]) -> String {
        let tool = |(number, (before, behind)): (usize, &(&str, &str))| {
            format!("T{} M6\nS1000 M3\n{before}\nG1 X{number}. F100.\n{behind}\n", number + 1)
        };
        tools.iter().enumerate().map(tool).collect::<String>() + "M30\n"
    }

    #[test]
    fn the_first_cut_is_marked() {
        let text = program(&[("M8", "M9"), ("", "M9"), ("M8", "M9")]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &text,
            &expect![[r#"
            9 | G1 X1. F100.
              | ^^^^^^^^^^^^ info[coolant-forgotten] the tool cuts with the coolant off (no `M8` before its `M9`)
        "#]],
        );
    }

    #[test]
    fn everything_is_off_at_the_end() {
        check_rule(&RULE, "fanuc-mill", &program(&[("M8", "M9"), ("", "M9")]), &expect![[""]]);
        let text = program(&[("M8", "M9"), ("M8", "M9"), ("", "M9")]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &text,
            &expect![[r#"
            14 | G1 X2. F100.
               | ^^^^^^^^^^^^ info[coolant-forgotten] the tool cuts with the coolant off (no `M8` before its `M9`)
        "#]],
        );
    }

    #[test]
    fn several_dry_tools_are_meant() {
        let text = program(&[("", "M9"), ("", "M9"), ("M8", "M9"), ("M8", "M9")]);
        check_rule(&RULE, "fanuc-mill", &text, &expect![[""]]);
        let text = program(&[("", "M9"), ("", ""), ("M8", "M9"), ("M8", "M9")]);
        check_rule(&RULE, "fanuc-mill", &text, &expect![[""]]);
    }

    #[test]
    fn a_thread_is_a_cut() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "T0101\nG97 S800 M3\nM8\nG1 X20. Z-5. F.2\nM9\nT0202\nG0 X22. Z5.\nG92 X19. Z-20. F1.5\nM9\nT0303\nM8\nG1 X18. F.1\nM9\nM30\n",
            &expect![[r#"
                8 | G92 X19. Z-20. F1.5
                  | ^^^^^^^^^^^^^^^^^^^ info[coolant-forgotten] the tool cuts with the coolant off (no `M8` before its `M9`)
            "#]],
        );
    }

    #[test]
    fn coolant_that_comes_late_has_come() {
        let text = program(&[("", "M8\nG1 Y1.\nM9"), ("M8", "M9"), ("M8", "M9")]);
        check_rule(&RULE, "fanuc-mill", &text, &expect![[""]]);
    }
}
