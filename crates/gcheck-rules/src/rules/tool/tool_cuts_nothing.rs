//! A tool that is put in and started, and cuts nothing before the next one.

use gcheck_controls::{Code, Effect, Letter};
use gcheck_engine::{Abstract, At, Domain, Event, Spindle, Stop, TravelKind};

use crate::declare::declare_rule;
use crate::facts::cycles::{is_cycle, is_operation};
use crate::facts::probing::touches_work;
use crate::{Finding, FollowedCx, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A tool is changed in, the spindle turns, the axes go somewhere at rapid, and the next tool comes without a single move at feed. The other
    /// tools of the program cut.
    ///
    /// A stop of the program, a probing move and a program that is not found may be the tool's work: then nothing is reported.
    ///
    /// ## Why it matters
    /// The operation of this tool is missing: a cycle was deleted (`G70` of a finishing tool), or the positions of its holes.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54
    /// T1 M6
    /// S3000 M3
    /// G0 X0. Y0.
    /// G43 H1 Z5.
    /// G1 Z-5. F100.
    /// G0 Z50.
    /// T2 M6
    /// S4000 M3
    /// G0 X0. Y0.
    /// G43 H2 Z5.
    /// G0 Z50.
    /// T3 M6
    /// S2000 M3
    /// G0 X0. Y0.
    /// G43 H3 Z5.
    /// G1 Z-5. F100.
    /// G0 Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54
    /// T1 M6
    /// S3000 M3
    /// G0 X0. Y0.
    /// G43 H1 Z5.
    /// G1 Z-5. F100.
    /// G0 Z50.
    /// T2 M6
    /// M30
    /// ```
    rule "tool-cuts-nothing" in "tool" {
        summary: "tool that is put in and cuts nothing",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::ALL_BLOCKS.union(Watch::MOVES).union(Watch::CHANGES).union(Watch::FOLLOWED),
            make: || Box::new(ToolCutsNothing::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ToolCutsNothing {
    tool: Option<Section>,
    /// Tools that cut.
    working: usize,
    found: Vec<Finding>,
}

remembers!(ToolCutsNothing: tool, found);

/// What a tool has done since it came.
#[derive(Clone, PartialEq)]
struct Section {
    at: At,
    number: u64,
    finding: Finding,
    turns: bool,
    moves: usize,
    /// It has cut, or may have done other work.
    works: bool,
}

remembers!(Section: at, finding);

/// A tool that only goes to one place and back is not used by mistake alone: rapid moves.
const FEWEST: usize = 2;

impl PathRule for ToolCutsNothing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.file_index.letters.contains(Letter::of('T'))
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        let may_work = |effect: Effect| {
            matches!(effect, Effect::BarFeed | Effect::MacroModal | Effect::AskOperator)
                || touches_work(effect)
                || is_cycle(effect)
                || is_operation(effect)
        };
        let is_own = cx.codes().iter().any(|code| cx.code_of(*code).is_none_or(Code::is_user));
        if let Some(section) = &mut self.tool
            && (cx.has_effect(may_work)
                || is_own
                || cx.is_malformed()
                || cx.is_after_unknown_program()
                || !cx.is_on_every_path())
        {
            section.works = true;
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        match event {
            Event::ToolChange(_) => self.comes(cx),
            Event::Spindle(Spindle::Clockwise | Spindle::CounterClockwise) => {
                if let Some(section) = &mut self.tool {
                    section.turns = true;
                }
            }
            Event::RigidTap { .. } | Event::Stop(Stop::Program | Stop::Message(_)) => self.works(),
            _ => {}
        }
    }

    fn moved(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        match event {
            Event::Travel(travel) if travel.kind == TravelKind::Rapid => {
                if let Some(section) = &mut self.tool {
                    section.moves += 1;
                }
            }
            _ => self.works(),
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        let last = usize::from(self.tool.as_ref().is_some_and(|section| section.works));
        if self.working + last >= 2 {
            for finding in self.found.drain(..) {
                report.add(finding);
            }
        }
    }
}

impl ToolCutsNothing {
    fn works(&mut self) {
        if let Some(section) = &mut self.tool {
            section.works = true;
        }
    }

    /// Another tool comes.
    fn comes(&mut self, cx: &PathCx<'_>) {
        let Some(number) = Abstract::known(cx.state().tool()).map(f64::to_bits) else {
            self.tool = None;
            return;
        };
        // A tool that is called again goes on with its work.
        if self.tool.as_ref().is_some_and(|section| section.number == number) {
            return;
        }
        if let Some(section) = self.tool.take() {
            if section.works {
                self.working += 1;
            } else if section.turns && section.moves >= FEWEST && cx.is_certain() {
                self.found.push(section.finding);
            }
        }
        let name = f64::from_bits(number);
        let finding = cx
            .finding(&META, cx.letter_range('T'), format!("tool {name} is put in and cuts nothing"))
            .label("up to the next tool it moves at rapid only")
            .help("put its operation in again, or take the tool out of the program");
        self.tool =
            Some(Section { at: cx.origin().at, number, finding, turns: false, moves: 0, works: false });
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn shaft(finishing: &str) -> String {
        format!(
            "G21 G18 G40 G99\nT0101\nG97 S900 M3\nG0 X64. Z0.\nG1 X-1.6 F0.2\nG0 X150. Z100.\nT0202\nG97 S900 M3\nG0 X62. Z2.\n{finishing}G0 X150. Z100.\nT0303\nG97 S800 M3\nG0 X44. Z-30.\nG1 X26. F0.08\nG0 X44.\nX150. Z100.\nM30\n"
        )
    }

    #[test]
    fn the_finishing_cycle_is_missing() {
        check_rule(&RULE, "fanuc-lathe", &shaft("G1 Z-20. F0.1\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &shaft(""),
            &expect![[r#"
            7 | T0202
              | ^^^^^ warning[tool-cuts-nothing] tool 2 is put in and cuts nothing
        "#]],
        );
    }

    #[test]
    fn a_stop_is_for_work_by_hand() {
        check_rule(&RULE, "fanuc-lathe", &shaft("M0\n"), &expect![[""]]);
    }
}
