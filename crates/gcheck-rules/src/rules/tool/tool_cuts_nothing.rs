//! A tool that is put in and started, and cuts nothing before the next one.

use gcheck_controls::{Code, Effect, Letter};
use gcheck_engine::{Abstract, At, Domain, Event, Spindle, Stop};
use gcheck_program::{BlockFlags, StatementKind};

use crate::declare::declare_rule;
use crate::facts::cycles::{is_cycle, is_operation};
use crate::facts::offset_schemes::whole;
use crate::facts::probing::touches_work;
use crate::facts::tool_comment::comment_of_number;
use crate::{Finding, FollowedCx, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A tool is changed in, the spindle turns, the axes go somewhere at rapid, and the next tool comes without a single move at feed. The other
    /// tools of the program cut.
    ///
    /// A stop of the program, a probing move, a dwell between moves, a chuck that opens, a code of the builder and a program that is not found may
    /// be the tool's work, and a condition or a block that may be skipped may hide it: then nothing is reported.
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
            watch: Watch::ALL_BLOCKS
                .union(Watch::RAPIDS)
                .union(Watch::CUTS)
                .union(Watch::CHANGES)
                .union(Watch::FOLLOWED),
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
    /// The block that started the spindle.
    turns: Option<At>,
    moves: usize,
    /// It has come to a stop that the operator may choose.
    is_stopped: bool,
    /// It has cut, or may have done other work.
    works: bool,
}

remembers!(Section: at, finding, turns);

impl Section {
    /// At a place a tool dwells for what it does there; right after the start of the spindle, for the spindle.
    fn waits_for_work(&self, cx: &PathCx<'_>) -> bool {
        self.moves > 0
            && self.turns.is_some_and(|turns| cx.origin().at != turns && cx.origin().at != turns.next())
    }
}

/// A tool that only goes to one place and back is not used by mistake alone: rapid moves.
const FEWEST: usize = 2;
/// A section of more blocks that cuts nothing is not one that was left empty.
const LONG: usize = 500;
/// Findings that are kept.
const MOST: usize = 64;
/// Words of comments of tools that cut.
const CUTTERS: [&str; 16] = [
    "MILL", "ENDMILL", "DRILL", "TAP", "REAM", "REAMER", "BORE", "BORING", "TURN", "TURNING", "FACE",
    "FACING", "GROOVE", "THREAD", "CUTTER", "CHAMFER",
];
/// Words of comments of tools that work without a cut.
const OTHER_WORK: [&str; 14] = [
    "FAN",
    "BLOW",
    "BLOWER",
    "AIR",
    "WASH",
    "WASHER",
    "CLEAN",
    "CLEANER",
    "BRUSH",
    "STOP",
    "STOPPER",
    "PROBE",
    "FINDER",
    "INDICATOR",
];

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
                || is_operation(effect)
        };
        let is_own = cx.codes().iter().any(|code| cx.code_of(*code).is_none_or(Code::is_user));
        let is_unknown = cx.origin().flags.contains(BlockFlags::UNKNOWN_CODE);
        // A cycle that is repeated zero times makes its holes where later blocks name them, if any does.
        let makes_holes = cx.has_effect(is_cycle)
            && !['K', 'L'].into_iter().any(|letter| cx.known_number(letter) == Some(0.0));
        if let Some(section) = &mut self.tool
            && (cx.has_effect(may_work)
                || is_own
                || is_unknown
                || makes_holes
                || chooses_way(cx)
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
                    section.turns = Some(cx.origin().at);
                }
            }
            Event::RigidTap { .. }
            | Event::Chuck(_)
            | Event::BarPush(_)
            | Event::Stop(Stop::Program | Stop::Message(_)) => self.works(),
            Event::Dwell(_) if self.tool.as_ref().is_some_and(|section| section.waits_for_work(cx)) => {
                self.works();
            }
            Event::Stop(_) => {
                if let Some(section) = &mut self.tool {
                    section.is_stopped = section.moves > 0;
                }
            }
            _ => {}
        }
    }

    fn rapid(&mut self, _: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        if let Some(section) = &mut self.tool {
            section.moves += 1;
            // The operator had something to do in the middle of it.
            section.works |= section.is_stopped;
        }
    }

    fn cut(&mut self, _: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        self.works();
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
            } else if section.turns.is_some()
                && section.moves >= FEWEST
                && cx.is_certain()
                && self.found.len() < MOST
                && !may_hide(cx, section.at)
                && !is_for_other_work(cx, &section)
            {
                self.found.push(section.finding);
            }
        }
        let name = f64::from_bits(number);
        let finding = cx
            .finding(&META, cx.letter_range('T'), format!("tool {name} is put in and cuts nothing"))
            .label("up to the next tool it moves at rapid only")
            .help("put its operation in again, or take the tool out of the program");
        self.tool = Some(Section {
            at: cx.origin().at,
            number,
            finding,
            turns: None,
            moves: 0,
            is_stopped: false,
            works: false,
        });
    }
}

/// Does the block choose what comes next? The way that is not taken here may cut.
fn chooses_way(cx: &PathCx<'_>) -> bool {
    let chooses = |kind: &StatementKind| {
        use StatementKind as K;
        matches!(kind, K::If { .. } | K::Guard { .. } | K::Goto { .. } | K::Do { .. } | K::OWord { .. })
    };
    cx.origin().flags.contains(BlockFlags::STATEMENT)
        && cx
            .place()
            .is_some_and(|place| place.table.statements(place.ix).any(|statement| chooses(&statement.kind)))
}

/// May a block since that one cut with another position of the block delete switch, or was it jumped over?
fn may_hide(cx: &PathCx<'_>, since: At) -> bool {
    let here = cx.origin().at;
    // Where a subprogram changes the tools, both blocks are one.
    let between = since.block..here.block.max(since.block.saturating_add(1));
    let is_optional = |block: u32| {
        let place = cx.place_of(At { block, ..since });
        place.is_some_and(|place| place.block().flags.contains(BlockFlags::BLOCK_DELETE))
    };
    since.file != here.file
        || here.block < since.block
        || between.len() > LONG
        || between.into_iter().any(is_optional)
}

/// Does the comment of the tool name work without a cut?
fn is_for_other_work(cx: &PathCx<'_>, section: &Section) -> bool {
    let comment = comment_of_number(cx, section.at, whole(f64::from_bits(section.number)));
    // `END MILL, CLEAN UP CORNERS` cuts.
    comment.is_some_and(|comment| comment.has(&OTHER_WORK) && !comment.has(&CUTTERS))
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
    fn work_without_a_cut() {
        for work in
            ["M0\n", "M11\nG4 U2.\nM10\n", "Z-5.\nG4 U2.\n", "M1\nZ1.\n", "M777\n", "/ G1 Z-20. F0.1\n"]
        {
            check_rule(&RULE, "fanuc-lathe", &shaft(work), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "fanuc-lathe",
            &shaft("IF [#600 EQ 1] GOTO 20\nG1 Z-20. F0.1\nN20\n"),
            &expect![[""]],
        );
        check_rule(&RULE, "fanuc-lathe", &shaft("").replace("T0202\n", "T0202 (CHIP FAN)\n"), &expect![[""]]);
    }

    #[test]
    fn a_cycle_without_its_places() {
        let holes = |places: &str| {
            format!(
                "G21 G90 G54\nT1 M6\nS3000 M3\nG0 X0. Y0.\nG43 H1 Z5.\nG1 Z-1. F100.\nG0 Z5.\nT2 M6\nS3000 M3\nG0 X5. Y0.\nG43 H2 Z5.\nG81 Z-5. R2. F100. K0\n{places}G80\nG0 Z50.\nT3 M6\nS3000 M3\nG0 X0. Y0.\nG43 H3 Z5.\nG1 Z-1. F100.\nG0 Z50.\nM30\n"
            )
        };
        check_rule(&RULE, "fanuc-mill", &holes("X10.\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &holes(""),
            &expect![[r#"
            8 | T2 M6
              | ^^ warning[tool-cuts-nothing] tool 2 is put in and cuts nothing
        "#]],
        );
    }
}
