//! Blocks that no path reaches.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{Assumption, At, Fault, FlowResult, Reach};
use gcheck_program::{BlockFlags, CallKind, OKeyword, Place, StatementKind};

use crate::declare::declare_rule;
use crate::facts::past_alarm::loses_way;
use crate::facts::usage::{has_conditions, leads_away, reads_start_state};
use crate::{Finding, FinishCx, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// No path of the program reaches these blocks: they follow an end, a return or a jump, and no jump, call or loop
    /// leads to them; or the condition before them never holds.
    ///
    /// ## Why it matters
    /// Blocks that should run do not: after a forgotten `GOTO` for a restart in the middle, or after `M30`.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// G0 X0. Y0.
    /// GOTO 20
    /// G81 Z-5. R2. F100.
    /// X10.
    /// N20 G80
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G0 X1.
    /// M30
    /// N100 G1 X2. F10.
    /// M99
    /// ```
    /// ## Not reported
    /// Blocks that a jump or call reaches, and other programs of the file.
    /// ```nc,quiet,haas-mill
    /// M97 P100
    /// M30
    /// N100 G1 X2. F10.
    /// M99
    /// ```
    /// A section after the end of the program that begins with a sequence number or a title, and has its own end, is *info*
    /// at most: the operator may start there.
    ///
    /// Blocks that a condition skips because of values that the program itself sets are a *hint* at most: such a
    /// program has its settings at its top. A block that does nothing but assign is not reported there: it keeps a value within its
    /// limits (`IF [#1 GT 5] THEN #1=5`). If the program does not set the variable that decides, both ways are taken.
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// IF [#500 EQ 1] GOTO 20
    /// G0 X10.
    /// N20 M30
    /// ```
    rule "unreachable-block" in "flow" {
        summary: "blocks that no path reaches",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS.union(Watch::FINISH), make: || Box::new(UnreachableBlock::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct UnreachableBlock {
    /// Where a path goes on depends on a value that is unknown.
    is_unsure: bool,
    /// The control does not find where the program goes on: corrected, the block may lead to any label.
    lost_way: bool,
}

remembers!(UnreachableBlock);

impl PathRule for UnreachableBlock {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, _: &mut Report<'_>) {
        self.is_unsure |= matches!(fault, Fault::Undecidable | Fault::Alarm(_));
        // A block with a mistake does not reach the program that it names.
        let names_program = || cx.file_index.calls.iter().any(|call| cx.range().contains(&call.range.start));
        self.lost_way |= loses_way(fault) || names_program();
    }

    fn finish(&mut self, cx: &FinishCx<'_>, report: &mut Report<'_>) {
        if self.is_unsure || cx.result.is_incomplete() || cx.others.iter().any(FlowResult::is_incomplete) {
            return;
        }
        // With only one position of the switch, the other paths are not known.
        let one_position = cx.others.is_empty()
            && cx.result.assumptions.iter().any(|a| matches!(a, Assumption::BlockSkip(_)));
        if one_position || goes_anywhere(cx) {
            return;
        }
        let groups = groups(cx, self.lost_way);
        if groups.is_empty() {
            return;
        }
        // A condition may depend on arguments and modes that a caller or the operator gives.
        let decided_elsewhere = has_conditions(cx.program, cx.environment)
            && (cx.file_index.is_called_from_elsewhere()
                || reads_start_state(cx.program, cx.model, cx.environment));
        if decided_elsewhere {
            return;
        }
        for group in groups.into_iter().filter(|group| !group.is_guard()) {
            report.add(finding(group));
        }
    }
}

/// Jumps or calls whose target is computed may lead to any block.
fn goes_anywhere(cx: &FinishCx<'_>) -> bool {
    cx.file_index.jumps.iter().any(|jump| jump.target.is_none())
        || cx.file_index.calls.iter().any(|call| call.target == CallKind::Unknown)
}

struct Group {
    range: Range<u32>,
    blocks: usize,
    cause: Cause,
    /// Its blocks do nothing but assign.
    assigns: bool,
}

impl Group {
    /// Does it keep a value within its limits, where the values of the program are within them?
    fn is_guard(&self) -> bool {
        self.assigns && self.blocks == 1 && matches!(self.cause, Cause::Decided(_))
    }
}

/// Why no path comes here.
enum Cause {
    /// The block before always leads elsewhere.
    LedAway(Range<u32>),
    /// The block before ends the program or begins it again, and what follows looks like a separate program.
    Section(Range<u32>, Start),
    /// The block before has a condition, and with the values that the program sets it goes one way.
    Decided(Range<u32>),
}

/// Where an operator may start a section.
enum Start {
    /// At this sequence number.
    Number(u32),
    /// Below a comment that is alone in its block.
    Title,
}

/// Runs of blocks that no path reaches. Past an alarm, those that follow an end of the program and have no label.
fn groups(cx: &FinishCx<'_>, past_alarm: bool) -> Vec<Group> {
    let Some(file) = cx.program.file(0) else { return Vec::new() };
    let graph = file.loaded.flow_graph();
    let profiles = profiles(cx);
    let mut groups = Vec::new();
    for part in graph.programs() {
        let is_reached = |block: u32| {
            cx.result.reach(At { file: 0, block }) != Reach::Never
                || !cx.is_never_reached(At { file: 0, block })
        };
        // This rule does not judge a separate program that nothing here calls.
        if !part.blocks.clone().any(is_reached) {
            continue;
        }
        let mut open: Option<Group> = None;
        let mut last_reached = None;
        let mut blocks = part.blocks.clone();
        while let Some(block) = blocks.next() {
            // Nearly all blocks of nearly all programs are reached: not looked at one by one.
            let missing = cx.result.first_unreached(At { file: 0, block }).block.min(part.blocks.end);
            if missing > block {
                groups.extend(open.take());
                last_reached = Some(missing - 1);
                blocks.start = missing;
                continue;
            }
            if is_reached(block) || profiles.iter().any(|profile| profile.contains(&block)) {
                groups.extend(open.take());
                last_reached = Some(block);
                continue;
            }
            let Some(place) = file.loaded.place(block, cx.environment.dialect) else { continue };
            if past_alarm && place.block().flags.intersects(BlockFlags::LABEL | BlockFlags::STATEMENT) {
                groups.extend(open.take());
                last_reached = None;
                continue;
            }
            // The body of a subroutine runs when it is called; an uncalled one is whole.
            let uncalled = graph.sub_around(block).is_some_and(|sub| !is_reached(sub + 1));
            // The `while` at the end of a `do`, after a `break`.
            let ends_loop = graph.o_word(block).is_some_and(|links| links.head.is_some());
            if uncalled || !does_something(&place, ends_loop) {
                continue;
            }
            match &mut open {
                Some(group) => {
                    group.range.end = place.range().end;
                    group.blocks += 1;
                    group.assigns &= only_assigns(&place);
                }
                None => {
                    let above =
                        last_reached.and_then(|block| file.loaded.place(block, cx.environment.dialect));
                    let range = place.range();
                    // After a call: the called program may not return, and its caller does not show that.
                    let above = above.filter(|above| !past_alarm || ends_program(above, cx));
                    open = cause(cx, above.as_ref(), last_reached.unwrap_or(block), block)
                        .map(|cause| Group { range, blocks: 1, cause, assigns: only_assigns(&place) });
                    if open.is_none() {
                        last_reached = None;
                    }
                }
            }
        }
        groups.extend(open);
    }
    groups
}

fn cause(cx: &FinishCx<'_>, above: Option<&Place>, last: u32, block: u32) -> Option<Cause> {
    let above = above?;
    // With a branch or a target in between, the condition is elsewhere.
    if leads_away(above, cx.model) && !(last + 1..=block).any(|between| is_led_to(cx, between)) {
        return Some(match section(cx, above, last, block) {
            Some(start) => Cause::Section(above.range(), start),
            None => Cause::LedAway(above.range()),
        });
    }
    // A subprogram may run with other arguments elsewhere.
    let graph = cx.program.file(0)?;
    let graph = graph.loaded.flow_graph();
    let is_called = graph.sub_around(block).is_some() || !graph.main().contains(&block);
    let decides = above.block().flags.contains(BlockFlags::STATEMENT)
        && !above
            .table
            .statements(above.ix)
            .any(|statement| matches!(statement.kind, StatementKind::OWord { keyword: OKeyword::Call, .. }));
    (decides && !is_called).then(|| Cause::Decided(above.range()))
}

/// Where an operator may start a section that follows the end of the program and has its own end.
fn section(cx: &FinishCx<'_>, above: &Place, last: u32, block: u32) -> Option<Start> {
    let file = cx.program.file(0)?;
    let number = |place: &Place| {
        let label = place.table.words(place.block()).iter().find(|word| word.letter.ascii() == b'N')?;
        label.integer()
    };
    let part_end = file.loaded.flow_graph().part_of(block).end;
    let place = |block: u32| file.loaded.place(block, cx.environment.dialect);
    // If every block has a number, no number marks a section.
    let all_have_numbers = place(block + 1).is_some_and(|place| number(&place).is_some());
    let has_own_end = || (block..part_end).filter_map(place).any(|place| ends_program(&place, cx));
    if all_have_numbers || !has_own_end() {
        return None;
    }
    if ends_program(above, cx)
        && let Some(number) = (last + 1..=block).filter_map(place).find_map(|place| number(&place))
    {
        return Some(Start::Number(number));
    }
    let is_title = |place: Place| {
        let block = place.block();
        block.flags.contains(BlockFlags::COMMENT) && place.table.words(block).is_empty()
    };
    let is_over = ends_program(above, cx) || is_return(above, cx);
    (is_over && (last + 1..block).filter_map(place).any(is_title)).then_some(Start::Title)
}

/// Does the block end a subprogram, or begin a main program again?
fn is_return(place: &Place, cx: &FinishCx<'_>) -> bool {
    let mut words = place.table.words(place.block()).iter();
    words.any(|word| cx.model.effect(word.code) == Effect::Return)
}

/// Does the block end the program?
fn ends_program(place: &Place, cx: &FinishCx<'_>) -> bool {
    let mut words = place.table.words(place.block()).iter();
    words.any(|word| cx.model.effect(word.code).ends_program())
}

/// Does a statement or jump of the text lead to the block?
fn is_led_to(cx: &FinishCx<'_>, block: u32) -> bool {
    let Some(file) = cx.program.file(0) else { return false };
    if !file.loaded.flow_graph().may_be_target(block) {
        return false;
    }
    let Some(place) = file.loaded.place(block, cx.environment.dialect) else { return false };
    let label = place.table.words(place.block()).iter().find(|word| word.letter.ascii() == b'N');
    match label.and_then(gcheck_program::Word::integer) {
        Some(number) => cx.file_index.jumps.iter().any(|jump| jump.target == Some(number)),
        None => place.table.statements(place.ix).next().is_some(),
    }
}

/// Blocks that a code reads as a profile or calls by their sequence numbers (`G70 P10 Q20`), wherever they are.
fn profiles(cx: &FinishCx<'_>) -> Vec<Range<u32>> {
    let Some(file) = cx.program.file(0) else { return Vec::new() };
    let graph = file.loaded.flow_graph();
    let is_flow = |code| {
        matches!(
            cx.model.effect(code),
            Effect::CallLocal
                | Effect::Return
                | Effect::JumpUnlessInput
                | Effect::CallProgram
                | Effect::MacroCall
        )
    };
    let named: Vec<_> =
        cx.file_index.jumps.iter().filter(|jump| jump.code.is_some() && !is_flow(jump.code)).collect();
    let blocks = |number: Option<u32>| number.into_iter().flat_map(|number| graph.labels(number));
    let mut profiles = Vec::new();
    for (ix, jump) in named.iter().enumerate() {
        for from in blocks(jump.target) {
            let end = graph.part_of(from).end;
            let next = named.get(ix + 1).filter(|next| next.code == jump.code);
            let to = blocks(next.and_then(|next| next.target)).find(|to| (from..end).contains(to));
            let returns = |block: u32| {
                file.loaded
                    .place(block, cx.environment.dialect)
                    .is_some_and(|place| leads_away(&place, cx.model))
            };
            let to = to.or_else(|| (from..end).find(|block| returns(*block)));
            profiles.push(from..to.map_or(end, |to| to + 1));
        }
    }
    profiles
}

/// Does the block assign to variables, and do nothing else?
fn only_assigns(place: &Place) -> bool {
    let mut statements = place.table.statements(place.ix).peekable();
    statements.peek().is_some()
        && statements.all(|statement| matches!(statement.kind, StatementKind::Assign { .. }))
        && place.table.words(place.block()).iter().all(|word| word.letter.ascii() == b'N')
}

/// More than a comment, a label, an end, or the frame of a loop or branch.
fn does_something(place: &Place, ends_loop: bool) -> bool {
    let block = place.block();
    // Notes for people after the end of a program.
    if block.flags.intersects(BlockFlags::ERROR | BlockFlags::TAPE_MARK) {
        return false;
    }
    let frame = |kind: &StatementKind| {
        matches!(kind, StatementKind::End { .. } | StatementKind::Goto { .. })
            || matches!(
                kind,
                StatementKind::OWord {
                    keyword: OKeyword::Else
                        | OKeyword::EndIf
                        | OKeyword::EndWhile
                        | OKeyword::EndRepeat
                        | OKeyword::EndSub
                        | OKeyword::Return
                        | OKeyword::Sub,
                    ..
                }
            )
    };
    if place.table.statements(place.ix).any(|statement| !frame(&statement.kind)) && !ends_loop {
        return true;
    }
    place.table.words(block).iter().any(|word| match word.letter.ascii() {
        b'N' | b'O' => false,
        // Programmers add `M30`, `M99` and `M1` anywhere for safety.
        b'M' => !matches!(word.integer(), Some(0 | 1 | 2 | 30 | 99)),
        b'P' => !block.letters.intersects(gcheck_controls::LetterSet::of("M")),
        _ => true,
    })
}

fn finding(group: Group) -> Finding {
    let (message, help) = if group.blocks == 1 {
        ("no path reaches this block".to_owned(), "remove the block, or let a jump or call lead to it")
    } else {
        (
            format!("no path reaches these {} blocks", group.blocks),
            "remove the blocks, or let a jump or call lead to them",
        )
    };
    let finding = Finding::new(&META, group.range, message).label("never executed").help(help);
    match group.cause {
        Cause::LedAway(range) => finding.also(range, "execution goes elsewhere here"),
        Cause::Section(range, start) => finding
            .also(range, "execution does not go on here")
            .note(match start {
                Start::Number(number) => format!("an operator may start the program at `N{number}`"),
                Start::Title => "an operator may start the program below the comment".to_owned(),
            })
            .at_most(Severity::Info),
        // A program with settings at its top skips what they do not select.
        Cause::Decided(range) => finding
            .also(range, "with the values that the program sets, this always goes one way")
            .at_most(Severity::Hint),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn blocks_behind_the_end_are_one_finding() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG0 X1.\nM30\nG0 X2.\n(NOTE)\nX3.\nM30\n",
            &expect![[r#"
                4 | G0 X2.
                  | ^^^^^^ warning[unreachable-block] no path reaches these 2 blocks
            "#]],
        );
    }

    #[test]
    fn a_section_with_a_number_and_an_end_of_its_own_may_be_started_by_the_operator() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nN2 G0 X1.\nM2\n\nN6 (T06)\nG0 X2.\nX3.\nM2\n",
            &expect![[r#"
            6 | G0 X2.
              | ^^^^^^ info[unreachable-block] no path reaches these 2 blocks
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nN2 G0 X1.\nN3 M2\nN6 G0 X2.\nN7 X3.\nN8 M2\n",
            &expect![[r#"
            4 | N6 G0 X2.
              | ^^^^^^^^^ warning[unreachable-block] no path reaches these 2 blocks
        "#]],
        );
    }

    #[test]
    fn a_section_with_a_title_and_an_end_of_its_own_may_be_started_by_the_operator() {
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\nG0 X1.\nM99\n(SET WORK OFFSETS)\nG10 L2 P1 Z8.5\nG10 L2 P2 Z2.5\nM30\n",
            &expect![[r#"
                5 | G10 L2 P1 Z8.5
                  | ^^^^^^^^^^^^^^ info[unreachable-block] no path reaches these 2 blocks
            "#]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\nG0 X1.\nM99\nG10 L2 P1 Z8.5\nG10 L2 P2 Z2.5\nM30\n",
            &expect![[r#"
                4 | G10 L2 P1 Z8.5
                  | ^^^^^^^^^^^^^^ warning[unreachable-block] no path reaches these 2 blocks
            "#]],
        );
    }

    #[test]
    fn the_end_behind_a_jump_is_nothing() {
        check_rule(&RULE, "fanuc-mill", "O1\nN1 G0 X1.\nGOTO 1\nM30\n%\n", &expect![[""]]);
    }

    #[test]
    fn a_condition_that_never_holds_hides_its_branch() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\n#1=3\nIF [#1 LT 5] GOTO 10\nG0 X1.\nN10 M30\n",
            &expect![[r#"
                4 | G0 X1.
                  | ^^^^^^ hint[unreachable-block] no path reaches this block
            "#]],
        );
    }

    #[test]
    fn arguments_of_a_subprogram_decide_in_its_caller() {
        check_rule(&RULE, "fanuc-mill", "O9000\nIF [#1 EQ #0] GOTO 10\nG0 X#1\nN10 M99\n", &expect![[""]]);
    }

    #[test]
    fn modes_at_the_start_decide_on_the_machine() {
        check_rule(&RULE, "fanuc-mill", "O1\nIF [#4006 EQ 21] GOTO 10\nG0 X1.\nN10 M30\n", &expect![[""]]);
    }

    #[test]
    fn both_positions_of_the_block_delete_switch_count() {
        check_rule(&RULE, "fanuc-mill", "O1\n/GOTO 10\nG0 X1.\nN10 M30\n", &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nGOTO 10\n/G0 X1.\nN10 M30\n",
            &expect![[r#"
            3 | /G0 X1.
              | ^^^^^^^ warning[unreachable-block] no path reaches this block
        "#]],
        );
    }

    #[test]
    fn the_profile_of_a_turning_cycle_is_reached() {
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\nG54 T0101\nG0 X2. Z.1\nG71 P10 Q20 D.05 U.02 W.005 F.01\nN10 G0 X1.\nG1 Z-1. F.005\nN20 X2.\nG70 P10 Q20\nM30\n",
            &expect![[""]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            "O1\nT0101\nG0 X50. Z2.\nG71 U1. R.5\nG71 P10 Q20 U.2 W.1 F.2\nG70 P10 Q20\nM30\nN10 G0 X20.\nG1 Z-10. F.1\nN20 X50.\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_subroutine_may_have_branches_that_no_call_asks_for() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 sub\no2 if [#1 GT 1]\nG0 X1\no2 endif\no1 endsub\no1 call [1]\nM2\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_branch_that_returns_leaves_the_rest_to_a_condition() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 sub\no2 if [#1 GT 0]\no1 return\no2 endif\nG0 X1\no1 endsub\no1 call [1]\nM2\n",
            &expect![[""]],
        );
    }

    #[test]
    fn the_end_of_a_loop_behind_a_break_is_nothing() {
        check_rule(&RULE, "linuxcnc", "o1 do\nG0 X1\no1 break\no1 while [1]\nM2\n", &expect![[""]]);
    }

    #[test]
    fn an_uncalled_subroutine_is_not_judged_here() {
        check_rule(&RULE, "linuxcnc", "o1 sub\nG0 X1\no1 endsub\nG0 X2\nM2\n", &expect![[""]]);
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 sub\nG0 X1\no1 return\nG0 X3\no1 endsub\no1 call\nM2\n",
            &expect![[r#"
                4 | G0 X3
                  | ^^^^^ warning[unreachable-block] no path reaches this block
            "#]],
        );
    }

    #[test]
    fn other_programs_of_the_file_are_not_judged_here() {
        check_rule(&RULE, "haas-mill", "O1\nG0 X1.\nM30\nO2\nG0 X2.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_jump_to_nowhere_hides_nothing() {
        check_rule(&RULE, "fanuc-mill", "O1\nGOTO 10\nG0 X1.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_jump_to_nowhere_may_mean_a_label_after_the_end() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nGOTO 10\nG0 X1.\nM30\nG0 X2.\nN11 G0 X3.\nX4.\nM30\n",
            &expect![[r#"
            5 | G0 X2.
              | ^^^^^^ warning[unreachable-block] no path reaches this block
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", "O1\nN5 G0 X1.\nGOTO 10\nGOTO 5\nG0 X2.\nM30\n", &expect![[""]]);
    }
}
