//! Increments that were left on, or that were written instead of positions.

use std::ops::Range;

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_engine::{At, Ending, Event, Fact, Role};
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range, ends_at_tape_mark};
use crate::facts::cutting::starts_spindle;
use crate::facts::modes::{ActiveMode, ignores_distance_mode, left_on};
use crate::facts::probing::probes;
use crate::{Finding, Fix, PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Increments (`G91`) were left on: the first move of the next tool, after a subprogram, after a pocket whose outline
    /// switched them on, after a reference return whose block did, or after a probing move whose block did and the start of the
    /// spindle, is in increments although the work before it was in positions; or the program ends in increments and begins
    /// without stating positions.
    ///
    /// `G91` is also reported where a tool begins: in the block of its first rapid move in X and Y, if that block also
    /// chooses a work offset or has only zeros, or if another tool of the program begins in positions. Increments from
    /// the tool change position make no sense.
    ///
    /// ## Why it matters
    /// The tool moves by the coordinates of its target instead of to them: through the part, or to the end of travel.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0.
    /// G1 X10. F100.
    /// G91 G28 Z0.
    /// T2 M6
    /// G0 X50. Y50.
    /// M30
    /// ```
    /// ```nc,reported,fanuc-mill
    /// G54 G0 X0. Y0.
    /// G91 G28 Z0.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0.
    /// G1 X10. F100.
    /// G91 G28 Z0.
    /// G0 X5. Y5.
    /// G90
    /// M30
    /// ```
    /// ```nc,reported,grbl
    /// G21 G90 G94
    /// G91 G38.2 Z-40 F120
    /// G10 L20 P1 Z15.2
    /// G0 Z30
    /// S10000 M3
    /// G0 X-5 Y-5
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G91 G54 G0 X0.5 Y0.5 S900 M3
    /// G43 H1 Z1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0.
    /// G1 X10. F100.
    /// G91 G28 Z0.
    /// T2 M6
    /// G90 G0 X50. Y50.
    /// G91 G28 Z0.
    /// M30
    /// ```
    rule "incremental-left-on" in "modal" {
        summary: "increments left on",
        severity: Warning,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::RAPIDS).union(Watch::CUTS).union(Watch::ENDS),
            make: || Box::new(IncrementalLeftOn::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a separate fact")]
struct IncrementalLeftOn {
    /// The work before was in positions.
    was_absolute: bool,
    /// A block that chooses a work offset in increments that an earlier block set, with no move in X or Y since.
    at_work_offset: Option<At>,
    /// A tool change with no move since, and what had set the mode then.
    change: Option<(Range<u32>, Option<At>)>,
    /// A reference return that switched from positions to increments, with no move since.
    at_return: Option<At>,
    /// A probing move that switched from positions to increments.
    at_probe: Option<At>,
    /// The same, and the spindle started since, with no move after it.
    at_probe_before_start: Option<At>,
    /// A block of a subprogram that switched from positions to increments, and its call depth.
    in_subprogram: Option<(At, usize)>,
    /// A block in positions that runs another program, and its call depth. In that program or a deeper one, no move and no
    /// switch came since.
    at_other_program: Option<(At, usize)>,
    /// The program moved before it stated the mode.
    relies_on_start: bool,
    has_moved: bool,
    /// A tool of the program began in positions.
    begins_in_positions: bool,
    /// A block stated positions.
    states_positions: bool,
}

remembers!(IncrementalLeftOn: at_work_offset, change, at_return, at_probe, at_probe_before_start, in_subprogram, at_other_program);

impl PathRule for IncrementalLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::Incremental)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let switches_on = cx.has_effect(|effect| effect == Effect::Incremental);
        let was_absolute = cx.state().is_incremental(cx.model) == Some(false);
        // `G91 G28 Z0.`: the increments were for the return alone.
        if switches_on && was_absolute && cx.has_effect(|effect| matches!(effect, Effect::ReturnReference(_)))
        {
            self.at_return = Some(cx.origin().at);
        }
        if switches_on && was_absolute && cx.has_effect(probes) {
            self.at_probe = Some(cx.origin().at);
        }
        if cx.has_effect(starts_spindle) {
            self.at_probe_before_start = self.at_probe.take();
        }
        if switches_on && cx.depth() > 1 && cx.state().is_incremental(cx.model) == Some(false) {
            self.in_subprogram = Some((cx.origin().at, cx.depth()));
        }
        if switches_on {
            self.at_other_program.take_if(|(_, depth)| cx.depth() <= *depth);
        } else if was_absolute && cx.has_effect(runs_program) {
            self.at_other_program = Some((cx.origin().at, cx.depth()));
        }
        if cx.code_of_role(Role::WorkOffset).is_some() {
            let is_incremental = cx.state().is_incremental(cx.model) == Some(true);
            let is_odd = is_incremental && self.states_positions && cx.depth() == 1;
            self.at_work_offset = is_odd.then(|| cx.origin().at);
        }
        self.states_positions |= cx.has_effect(|effect| effect == Effect::Absolute);
        match boundary(cx) {
            Some(Boundary::ToolChange) => {
                let set_by = cx.definitions().set_by(Fact::Mode(Role::Distance));
                self.change = Some((boundary_range(cx, Boundary::ToolChange), set_by));
            }
            Some(Boundary::ProgramEnd) => self.end(cx, report),
            None => {}
        }
    }

    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.begins(cx, report);
        self.moves(cx, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.moves(cx, report);
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            self.end(cx, report);
        }
    }
}

impl IncrementalLeftOn {
    /// Is this the first move of a tool, in increments that its own block states?
    fn begins(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_first = self.change.is_some() || !self.has_moved;
        if !is_first || !cx.origin().letters.intersects(LetterSet::of("XY")) || ignores_distance_mode(cx) {
            return;
        }
        let has_others = self.begins_in_positions;
        self.begins_in_positions |= cx.state().is_incremental(cx.model) == Some(false);
        let states = cx.state().is_incremental(cx.model) == Some(true)
            && cx.definitions().set_by(Fact::Mode(Role::Distance)) == Some(cx.origin().at);
        let is_meant = cx.depth() > 1 || cx.origin().flags.contains(BlockFlags::EXPRESSION);
        let chooses_offset = cx.code_of_role(Role::WorkOffset).is_some();
        let moves_nothing = moves_nothing(cx);
        if states && !is_meant && (chooses_offset || moves_nothing || has_others) {
            let range = cx.effect_range(|effect| effect == Effect::Incremental);
            let incremental = cx.code_name(Role::Distance).unwrap_or_default();
            let absolute = cx.name_of_effect(Effect::Absolute).unwrap_or_default();
            let message = format!("the first move of the tool is in increments (`{incremental}`)");
            let fix = Fix::risky(format!("write `{absolute}`"), range.clone(), absolute.clone());
            let finding =
                cx.finding(&META, range, message).help(format!("write `{absolute}` here")).fix_if(Some(fix));
            let why = if moves_nothing {
                "an increment of zero moves nothing"
            } else if chooses_offset {
                "the work offset of this block needs positions"
            } else {
                "the other tools of the program begin in positions"
            };
            report.add(finding.label("by this much from the present position, not to this point").note(why));
        }
    }

    fn moves(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if ignores_distance_mode(cx) || !cx.origin().letters.intersects(LetterSet::of("XYZ")) {
            return;
        }
        let set_by = cx.definitions().set_by(Fact::Mode(Role::Distance));
        self.relies_on_start |= !self.has_moved && set_by.is_none();
        self.has_moved = true;
        let is_incremental = cx.state().is_incremental(cx.model) == Some(true);
        let (change, was_absolute) = (self.change.take(), self.was_absolute);
        let at_return = self.at_return.take();
        let at_probe = self.at_probe_before_start.take();
        let crosses = cx.origin().letters.intersects(LetterSet::of("XY"));
        let at_work_offset = self.at_work_offset.take_if(|_| crosses);
        self.was_absolute = cx.state().is_incremental(cx.model) == Some(false);
        // The pocket itself moves, too.
        let is_after = |(at, depth): &mut (At, usize)| *at != cx.origin().at && cx.depth() <= *depth;
        let other = self.at_other_program.take_if(is_after);
        if !is_incremental {
            return;
        }
        if set_by.is_none() {
            // Programs that only draw an outline leave no trace of what they set.
            if let Some((at, _)) = other {
                report.add(after_other_program(cx, at));
            }
            return;
        }
        if let Some((range, at_change)) = change
            && at_change == set_by
            && (was_absolute || self.begins_in_positions && cx.depth() == 1 && !works_in_increments(cx))
        {
            let finding = tell(cx, cx.range(), "the first move after the tool change is in increments");
            let finding = finding.label("by this much, not to this point").also(range, "tool changed here");
            report.add(cx.resting_on(finding, Fact::Mode(Role::Distance), "increments"));
        } else if at_return == set_by && !cx.origin().flags.contains(BlockFlags::EXPRESSION) {
            // A distance that is computed from the present position is a deliberate increment.
            let finding = tell(cx, cx.range(), "the first move after the reference return is in increments");
            let finding = finding.label("by this much, not to this point");
            report.add(cx.resting_on(finding, Fact::Mode(Role::Distance), "increments"));
        } else if at_probe == set_by {
            let finding = tell(
                cx,
                cx.range(),
                "the first move after probing and the start of the spindle is in increments",
            );
            let finding = finding.label("by this much, not to this point");
            report.add(cx.resting_on(finding, Fact::Mode(Role::Distance), "increments"));
        } else if let Some(at) =
            at_work_offset.filter(|_| set_by != Some(cx.origin().at) && !works_in_increments(cx))
        {
            let finding =
                tell(cx, cx.range(), "the first move after the choice of the work offset is in increments");
            let mut finding = finding.label("by this much, not to this point");
            if let Some(range) = cx.range_of(at) {
                finding = finding.also(range, "the work offset, which is for positions, is chosen here");
            }
            report.add(cx.resting_on(finding, Fact::Mode(Role::Distance), "increments"));
        } else if let Some((at, depth)) = self.in_subprogram
            && set_by == Some(at)
            && cx.depth() < depth
        {
            self.in_subprogram = None;
            let finding = tell(cx, cx.range(), "the first move after the subprogram is in increments");
            let finding = finding.label("by this much, not to this point");
            report.add(cx.resting_on(finding, Fact::Mode(Role::Distance), "increments"));
        } else if let Some((at, _)) = other {
            report.add(after_other_program(cx, at));
        }
    }

    fn end(&self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !self.relies_on_start || cx.end_resets(Role::Distance) || cx.is_called_only() {
            return;
        }
        let Some(ActiveMode::Certain(_)) =
            left_on(cx, Role::Distance, |effect| effect == Effect::Incremental)
        else {
            return;
        };
        let range = boundary_range(cx, Boundary::ProgramEnd);
        let finding = tell(cx, range, "the program ends in increments and begins without stating positions");
        let finding = finding
            .label("the next part begins by increments")
            .assuming("the end of the program keeps the mode")
            .at_most(Severity::Warning);
        report.add(cx.resting_on(finding, Fact::Mode(Role::Distance), "increments"));
    }
}

/// Does the program move by increments between the block that set them and this one? Then that is how it is written.
///
/// A block that says where to go, by a work offset or by X and Y together, is taken for one in positions until an earlier one has
/// moved X and Y together by increments.
fn works_in_increments(cx: &PathCx<'_>) -> bool {
    const MOST: u32 = 500;
    let here = cx.origin().at;
    let Some(set) = cx.definitions().set_by(Fact::Mode(Role::Distance)).filter(|at| at.file == here.file)
    else {
        return false;
    };
    let has_both = |letters: LetterSet| ['X', 'Y'].into_iter().all(|axis| letters.contains(Letter::of(axis)));
    let says_where = cx.code_of_role(Role::WorkOffset).is_some() || has_both(cx.origin().letters);
    let last = here.block.min(set.block.saturating_add(MOST));
    (set.block..last).any(|block| {
        let at = At { block, ..here };
        let is_elsewhere = |word: &gcheck_program::Word| cx.model.effect(word.code).goes_to_machine_place();
        let moves = cx.place_of(at).is_some_and(|place| {
            let letters = place.block().letters;
            if says_where { has_both(letters) } else { letters.intersects(LetterSet::of("XY")) }
        });
        moves && cx.find_word(at, is_elsewhere).is_none()
    })
}

/// Does the code run a program whose blocks this rule may not be shown?
fn runs_program(effect: Effect) -> bool {
    matches!(effect, Effect::GeneralPocket | Effect::CallProgram | Effect::MacroCall)
}

/// The first move after a program that left increments on.
fn after_other_program(cx: &PathCx<'_>, runs: At) -> Finding {
    let is_outline = cx.find_word(runs, |word| cx.model.effect(word.code) == Effect::GeneralPocket).is_some();
    let (what, caller) = if is_outline {
        ("the first move after the pocket is in increments", "its outline leaves increments on")
    } else {
        ("the first move after the called program is in increments", "this program leaves increments on")
    };
    let finding = tell(cx, cx.range(), what).label("by this much, not to this point");
    match cx.range_of(runs) {
        Some(range) => finding.also(range, caller),
        None => finding,
    }
}

/// Are the coordinates of the block zero?
fn moves_nothing(cx: &PathCx<'_>) -> bool {
    let Some(place) = cx.place() else { return false };
    let words = place.table.words(place.block());
    let mut coordinates = words.iter().filter(|word| matches!(word.letter.ascii(), b'X' | b'Y' | b'Z'));
    coordinates
        .all(|word| cx.known_number(word.letter.ascii().into()).is_some_and(|number| number.abs() < 1e-9))
}

fn tell(cx: &PathCx<'_>, range: Range<u32>, what: &str) -> Finding {
    let incremental = cx.name_of_effect(Effect::Incremental).unwrap_or_default();
    let absolute = cx.name_of_effect(Effect::Absolute).unwrap_or_default();
    cx.finding(&META, range, format!("{what} (`{incremental}`)"))
        .help(format!("state `{absolute}` before this move"))
        .fix_if(cx.block_before(Some(&absolute)))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn increments_of_a_probing_move() {
        let program =
            |back: &str| format!("G21 G90 G94\nG91 G38.2 Z-40 F120\nG0 Z5\n{back}S900 M3\nG0 X5 Y5\nM2\n");
        check_rule(
            &RULE,
            "grbl",
            &program(""),
            &expect![[r#"
                5 | G0 X5 Y5
                  | ^^^^^^^^ warning[incremental-left-on] the first move after probing and the start of the spindle is in increments (`G91`)
            "#]],
        );
        check_rule(&RULE, "grbl", &program("G90\n"), &expect![[""]]);
    }

    #[test]
    fn the_first_move_of_the_next_tool_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G0 X0.\nG1 X1. F5.\nG91 G28 Z0.\nT2 M6\nG0 X3.\nX4.\nM30\n",
            &expect![[r#"
                5 | G0 X3.
                  | ^^^^^^ warning[incremental-left-on] the first move after the tool change is in increments (`G91`)
            "#]],
        );
    }

    #[test]
    fn a_work_offset_is_for_positions() {
        let program =
            |back: &str| format!("G21 G90 G94\nG91\nG0 Z5\nG54\nS900 M3\nG0 Z30\n{back}G0 X20 Y20\nM2\n");
        check_rule(
            &RULE,
            "grbl",
            &program(""),
            &expect![[r#"
            7 | G0 X20 Y20
              | ^^^^^^^^^^ warning[incremental-left-on] the first move after the choice of the work offset is in increments (`G91`)
        "#]],
        );
        check_rule(&RULE, "grbl", &program("G90 "), &expect![[""]]);
        // Which subprogram moves in increments is its own matter.
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0 Y0\nM97 P10\nM30\nN10 G91\nG55\nG0 X1.\nG90\nM99\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_tool_that_began_in_positions_shows_what_is_meant() {
        let program = |at: &str| {
            format!(
                "T3 M6\nG20 G90 G54 G0 X0 Y0\nS900 M3\nG43 H3 Z.5\nG1 G91 Z-.25 F5.\nG0 Z.5\nG53 Z0\nT7 M6\n{at}G54 G0 X1. Y1.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program(""),
            &expect![[r#"
            9 | G54 G0 X1. Y1.
              | ^^^^^^^^^^^^^^ warning[incremental-left-on] the first move after the tool change is in increments (`G91`)
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program("G90 "), &expect![[""]]);
        // One tool after the other goes on by increments, but where a block says where to go.
        let by_increments = program("")
            .replace("G1 G91 Z-.25 F5.\n", "G91 G1 Z-.25 F5.\nX1.\nX-1.\n")
            .replace("G54 G0 X1. Y1.", "G0 X1.");
        check_rule(&RULE, "haas-mill", &by_increments, &expect![[""]]);
    }

    #[test]
    fn a_program_in_increments_stays_in_them() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G91 G0 X1.\nG1 X1. F50.\nT2 M6\nG0 X-1.\nG90\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_tool_that_begins_in_increments() {
        let program = |first: &str, second: &str| {
            format!("G21\nT1 M6\n{first} G0 X0. Y0.\nG90 G0 Z5.\nT2 M6\n{second} G0 X3. Y3.\nG90\nM30\n")
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G90", "G91"),
            &expect![[r#"
                6 | G91 G0 X3. Y3.
                  | ^^^ warning[incremental-left-on] the first move of the tool is in increments (`G91`)
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G91", "G91"),
            &expect![[r#"
                3 | G91 G0 X0. Y0.
                  | ^^^ warning[incremental-left-on] the first move of the tool is in increments (`G91`)
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G91 G54", "G90"),
            &expect![[r#"
                3 | G91 G54 G0 X0. Y0.
                  | ^^^ warning[incremental-left-on] the first move of the tool is in increments (`G91`)
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G91", "G90"),
            &expect![[r#"
                3 | G91 G0 X0. Y0.
                  | ^^^ warning[incremental-left-on] the first move of the tool is in increments (`G91`)
            "#]],
        );
        check_rule(&RULE, "fanuc-mill", "G91 G0 X5. Y5.\nG1 X5. F90.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_subprogram_that_leaves_them_on() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G0 X0.\nM97 P10\nG0 X3.\nM30\nN10 G91 G1 X1. F5.\nM99\n",
            &expect![[r#"
                3 | G0 X3.
                  | ^^^^^^ warning[incremental-left-on] the first move after the subprogram is in increments (`G91`)
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G91 G0 X0.\nM97 P10\nG0 X3.\nM30\nN10 G91 G1 X1. F5.\nM99\n",
            &expect![[r#"
                1 | G20 G91 G0 X0.
                  |     ^^^ warning[incremental-left-on] the first move of the tool is in increments (`G91`)
            "#]],
        );
    }

    #[test]
    fn a_pocket_whose_outline_leaves_them_on() {
        let pocket = |ends: &str| {
            format!(
                "G20 G90 G54 G0 X0. Y0.\nG43 H1 Z.1\nG150 P10 X0. Y0. Z-.4 Q.1 R.05 J.3 K0. F15.\nG1 X0. Y1. F20.\nG0 Z1.\nM30\nO10\nG91 G1 Y.5\nX-1.\nY-1.\nX2.\nY1.\nX-1.\n{ends}M99\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &pocket(""),
            &expect![[r#"
            4 | G1 X0. Y1. F20.
              | ^^^^^^^^^^^^^^^ warning[incremental-left-on] the first move after the pocket is in increments (`G91`)
        "#]],
        );
        check_rule(&RULE, "haas-mill", &pocket("G90\n"), &expect![[""]]);
    }

    #[test]
    fn an_end_in_increments_hurts_who_begins_without_positions() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G0 X0.\nG91 G28 Z0.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ warning[incremental-left-on] the program ends in increments and begins without stating positions (`G91`)
        "#]],
        );
        check_rule(&RULE, "haas-mill", "G20 G0 X0.\nG91 G28 Z0.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn what_it_says() {
        let found = findings(
            &only(&RULE),
            "haas-mill",
            "G20 G90 G0 X0.\nG1 X1. F5.\nG91 G28 Z0.\nT2 M6\nG0 X3.\nM30\n",
            &World::default(),
        );
        expect![[r#"
            the first move after the tool change is in increments (`G91`)
              here: by this much, not to this point
              there: tool changed here
              there: increments set here
              help: state `G90` before this move
              fix (unsafe): put `G90` in a block before this one
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
