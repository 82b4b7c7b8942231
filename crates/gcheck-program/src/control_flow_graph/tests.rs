//! What the flow graph makes of programs: small ones as tables, large and broken ones by their laws.
//!
//! Knows: programs as text. Must not know: how the flow graph is stored.

use std::fmt::Write as _;
use std::ops::Range;

use expect_test::{Expect, expect};
use gcheck_controls::{CodeNumber, UserCode};
use gcheck_syntax::cut;
use gcheck_testkit::inputs;
use proptest::prelude::*;

use super::{ControlFlowGraph, ControlFlowGraphBuilder, Program};
use crate::{BlockTable, Dialect, OLabel, code_region, lower};

/// A program in chunks of whole lines, with its flow graph.
struct World {
    text: String,
    graph: ControlFlowGraph,
    bases: Vec<usize>,
    tables: Vec<BlockTable>,
}

impl World {
    /// `cuts` are the ranges of the chunks.
    fn cut(control_name: &str, text: &str, cuts: &[Range<usize>]) -> Self {
        let control = gcheck_controls::load(control_name).unwrap();
        let dialect = Dialect::new(&control);
        let end = code_region(text).end as u32;
        let mut builder = ControlFlowGraphBuilder::default();
        let mut tables = Vec::new();
        for range in cuts {
            let chunk = &text[range.clone()];
            let table = lower(chunk, &dialect);
            builder.add(&table, range.start as u32, end, chunk, &dialect);
            tables.push(table);
        }
        let bases = cuts.iter().map(|r| r.start).collect();
        Self { text: text.to_owned(), graph: builder.finish(), bases, tables }
    }

    fn new(control_name: &str, text: &str) -> Self {
        Self::cut(control_name, text, &cut(text))
    }

    /// A chunk every `lines` lines.
    fn in_lines(control_name: &str, text: &str, lines: usize) -> Self {
        let mut cuts: Vec<Range<usize>> = Vec::new();
        let mut start = 0;
        for (ix, line) in text.split_inclusive('\n').enumerate() {
            let end = start + line.len();
            match cuts.last_mut() {
                Some(last) if ix % lines != 0 => last.end = end,
                _ => cuts.push(start..end),
            }
            start = end;
        }
        Self::cut(control_name, text, &cuts)
    }

    fn block(&self, block: u32) -> &str {
        let (chunk, ix) = self.graph.chunk_of(block).unwrap();
        let (_, found) = self.tables[chunk].blocks().nth(ix as usize).unwrap();
        let base = self.bases[chunk];
        self.text[base + found.range.start as usize..base + found.range.end as usize].trim()
    }

    /// Every block with what the flow graph says of it.
    fn dump(&self) -> String {
        let graph = &self.graph;
        let mut out = String::new();
        for block in 0..graph.blocks() {
            let mut line = format!("{block:<2} {:22}", self.block(block));
            let mut say = |what: &str, other: Option<u32>| {
                if let Some(other) = other {
                    let _ = write!(line, " {what} {other}");
                }
            };
            say("END", graph.end_of(block));
            say("DO", graph.do_of(block));
            if let Some(word) = graph.o_word(block) {
                say("head", word.head);
                say("next", word.next);
                say("end", word.end);
                say("calls", word.callee);
                say("in", word.inside);
                say("to", word.leads_to);
            }
            for (is, what) in [
                (graph.may_be_target(block), "target"),
                (graph.is_flow(block), "flow"),
                (graph.unmatched_loops().contains(&block), "unmatched"),
                (graph.unmatched_o_words().contains(&block), "unmatched"),
                (graph.crossed_loops().contains(&block), "crosses"),
                (graph.reused_o_labels().contains(&block), "reused"),
            ] {
                if is {
                    let _ = write!(line, " {what}");
                }
            }
            let _ = writeln!(out, "{}", line.trim_end());
        }
        out
    }
}

fn check(control: &str, text: &str, expected: &Expect) {
    expected.assert_eq(&World::new(control, text).dump());
}

fn numbers(programs: impl Iterator<Item = Program>) -> Vec<(Option<u32>, Option<u32>, Range<u32>)> {
    programs.map(|p| (p.number, p.head, p.blocks)).collect()
}

#[test]
fn blocks_are_numbered_through_the_file_and_end_with_the_tape() {
    let text = "%\nO1\n\nG0 X1.\n(note)\nM30\n%\nG0 X9.\n";
    check(
        "fanuc-mill",
        text,
        &expect![[r#"
            0  %
            1  O1                     target
            2  G0 X1.
            3  (note)
            4  M30                    flow
            5  %
        "#]],
    );
    let world = World::in_lines("fanuc-mill", text, 2);
    let places: Vec<_> = (0..7).map(|block| world.graph.chunk_of(block)).collect();
    assert_eq!(
        places,
        [Some((0, 0)), Some((0, 1)), Some((1, 0)), Some((2, 0)), Some((2, 1)), Some((3, 0)), None]
    );
    assert_eq!(
        (0..5).map(|chunk| world.graph.blocks_of(chunk)).collect::<Vec<_>>(),
        [0..2, 2..3, 3..5, 5..6, 6..6]
    );
    assert_eq!(world.graph.base_of(1), Some(5));
    assert_eq!(world.graph.base_of(4), None);
}

#[test]
fn a_byte_belongs_to_the_last_block_that_begins_before_it() {
    let text = "\n G0 X1.\n\nX2.\n\n\nX3.\n%\nbehind\n";
    for lines in 1..9 {
        let world = World::in_lines("haas-mill", text, lines);
        let at = |byte: usize| world.graph.block_at_offset(byte as u32, |chunk| Some(&world.tables[chunk]));
        assert_eq!(at(0), None);
        assert_eq!(at(text.find("X1").unwrap()), Some(0));
        assert_eq!(at(text.find("X2").unwrap() - 1), Some(0));
        assert_eq!(at(text.find("X2").unwrap()), Some(1));
        assert_eq!(at(text.find("X3").unwrap() - 1), Some(1));
        assert_eq!(at(text.find("behind").unwrap() + 2), Some(3));
        assert_eq!(at(4_000_000_000), Some(3));
    }
}

#[test]
fn a_jump_finds_labels_of_its_own_program() {
    let text = "O1\nN10 X1.\nN20\nN10 X2.\nM30\nO2\nN10 X3.\nM99\n";
    let graph = World::new("fanuc-mill", text).graph;
    assert_eq!(graph.label(10, 2, true), Some(3), "the next one ahead");
    assert_eq!(graph.label(10, 3, true), Some(3), "the block itself");
    assert_eq!(graph.label(10, 4, true), Some(1), "none ahead: from the program's head");
    assert_eq!(graph.label(10, 4, false), Some(1));
    assert_eq!(graph.label(10, 7, true), Some(6), "the second program's own");
    assert_eq!(graph.label(20, 7, true), None, "not the other program's");
    assert_eq!(graph.label(10, 99, true), None);
    assert_eq!(graph.labels(10).collect::<Vec<_>>(), [1, 3, 6]);
    assert_eq!(graph.labels(11).count(), 0);
}

#[test]
fn a_label_is_a_whole_number_at_the_head_of_a_block() {
    let graph = World::new("haas-mill", "N1 G0\n/N2 X1.\nO7 N3\nG0 N4\nN5.5\nN-6\nN\nN7 N8 X1.\n").graph;
    let found: Vec<_> = (1..9).map(|number| graph.labels(number).next()).collect();
    assert_eq!(found, [Some(0), Some(1), Some(2), None, None, None, Some(7), Some(7)]);
}

#[test]
fn program_numbers_part_the_file() {
    let graph = World::new("haas-mill", "%\n(posted)\nO1\nM98 P2\nM30\nN1 O2\nM99\n:3\nM99\n%\n").graph;
    assert_eq!(
        numbers(graph.programs()),
        [(Some(1), Some(2), 0..5), (Some(2), Some(5), 5..7), (Some(3), Some(7), 7..10)]
    );
    assert_eq!(graph.main(), 0..5);
    assert_eq!(graph.program(3).map(|p| p.blocks), Some(7..10));
    assert_eq!(graph.program(4), None);
    assert_eq!(graph.part_of(6), 5..7);
    assert_eq!(graph.part_of(10), 10..10);
}

#[test]
fn what_stands_before_the_first_number_is_a_program_when_it_ends() {
    let main = |text| numbers(World::new("haas-mill", text).graph.programs());
    assert_eq!(main("G0 X1.\nM30\nO2\nM99\n"), [(None, None, 0..2), (Some(2), Some(2), 2..4)]);
    assert_eq!(main("G21\nO2\nM30\n"), [(Some(2), Some(1), 0..3)]);
    assert_eq!(main("G0\n"), [(None, None, 0..1)]);
    assert_eq!(main(""), [(None, None, 0..0)]);
}

#[test]
fn the_first_of_two_programs_with_one_number_is_found() {
    let graph = World::new("fanuc-mill", "O5\nM30\nO5\nM99\nO1.5\nM99\n").graph;
    assert_eq!(graph.program(5).map(|p| p.blocks), Some(0..2));
    assert_eq!(graph.programs().map(|p| p.number).collect::<Vec<_>>(), [Some(5), Some(5), None]);
}

#[test]
fn a_name_in_angle_brackets_begins_a_program_where_there_are_no_o_words() {
    let text = "O<MAIN>\nGOTO 1\nN1 M30\nO<SUB 1>\nN1 M99\n";
    let graph = World::in_lines("fanuc-mill", text, 2).graph;
    assert_eq!(graph.main(), 0..3);
    assert_eq!(graph.program_named("sub1").map(|p| (p.head, p.blocks)), Some((Some(3), 3..5)));
    assert_eq!(graph.program_named("other"), None);
    assert_eq!(World::new("linuxcnc", text).graph.programs().len(), 1);
}

#[test]
fn loops_are_paired_by_number_and_nest() {
    check(
        "fanuc-mill",
        "WHILE [#1 LT 5] DO1\nDO2\nDO3\nEND3\nEND2\nX1.\nEND1\nDO1\nEND1\n",
        &expect![[r#"
            0  WHILE [#1 LT 5] DO1    END 6 target flow
            1  DO2                    END 4 target flow
            2  DO3                    END 3 target flow
            3  END3                   DO 2 target flow
            4  END2                   DO 1 target flow
            5  X1.
            6  END1                   DO 0 target flow
            7  DO1                    END 8 target flow
            8  END1                   DO 7 target flow
        "#]],
    );
}

#[test]
fn loops_without_partner_are_listed() {
    check(
        "fanuc-mill",
        "O1\nDO1\nDO#2\nEND2\nDO3 DO3\nEND3\nM30\nO2\nEND1\nM99\n",
        &expect![[r#"
            0  O1                     target
            1  DO1                    target flow unmatched
            2  DO#2                   target flow unmatched
            3  END2                   target flow unmatched
            4  DO3 DO3                END 5 target flow unmatched
            5  END3                   DO 4 target flow
            6  M30                    flow
            7  O2                     target
            8  END1                   target flow unmatched
            9  M99                    flow
        "#]],
    );
}

#[test]
fn loops_that_overlap_are_paired_and_listed() {
    check(
        "fanuc-mill",
        "DO1\nDO2\nDO3\nEND1\nEND3\nEND2\n",
        &expect![[r#"
            0  DO1                    END 3 target flow
            1  DO2                    END 5 target flow
            2  DO3                    END 4 target flow
            3  END1                   DO 0 target flow crosses
            4  END3                   DO 2 target flow
            5  END2                   DO 1 target flow
        "#]],
    );
    check(
        "fanuc-mill",
        "DO1\nDO2\nEND1\nDO2\nEND2\n",
        &expect![[r#"
            0  DO1                    END 2 target flow
            1  DO2                    target flow unmatched
            2  END1                   DO 0 target flow
            3  DO2                    END 4 target flow
            4  END2                   DO 3 target flow
        "#]],
    );
}

#[test]
fn branches_of_an_if_follow_each_other() {
    let text = "o1 if [#1 GT 5]\nX1\no1 elseif [#1 GT 3]\no2 if [1]\no2 endif\no1 elseif [#1 GT 2]\no1 else\no1 endif\n";
    check(
        "linuxcnc",
        text,
        &expect![[r#"
            0  o1 if [#1 GT 5]        next 2 end 7 target flow
            1  X1
            2  o1 elseif [#1 GT 3]    head 0 next 5 end 7 target flow
            3  o2 if [1]              next 4 end 4 target flow
            4  o2 endif               head 3 target flow
            5  o1 elseif [#1 GT 2]    head 0 next 6 end 7 target flow
            6  o1 else                head 0 next 7 end 7 target flow
            7  o1 endif               head 0 target flow
        "#]],
    );
    let graph = World::new("linuxcnc", text).graph;
    assert_eq!(graph.branches(0).collect::<Vec<_>>(), [2, 5, 6, 7]);
    assert_eq!(graph.branches(5).collect::<Vec<_>>(), [6, 7]);
    assert_eq!(graph.branches(1).count(), 0);
}

#[test]
fn loops_of_o_words() {
    check(
        "linuxcnc",
        "o1 while [#1 LT 3]\no9 if [#1 EQ 2]\no1 break\no9 else\no1 continue\no9 endif\no1 endwhile\n\
         o2 do\no2 break\no2 continue\no2 while [#1 GT 0]\no3 repeat [5]\no3 continue\no3 endrepeat\n",
        &expect![[r#"
            0  o1 while [#1 LT 3]     end 6 target flow
            1  o9 if [#1 EQ 2]        next 3 end 5 target flow
            2  o1 break               head 0 end 6 to 6 target flow
            3  o9 else                head 1 next 5 end 5 target flow
            4  o1 continue            head 0 end 6 to 0 target flow
            5  o9 endif               head 1 target flow
            6  o1 endwhile            head 0 target flow
            7  o2 do                  end 10 target flow
            8  o2 break               head 7 end 10 to 10 target flow
            9  o2 continue            head 7 end 10 to 10 target flow
            10 o2 while [#1 GT 0]     head 7 target flow
            11 o3 repeat [5]          end 13 target flow
            12 o3 continue            target flow unmatched
            13 o3 endrepeat           head 11 target flow
        "#]],
    );
}

#[test]
fn labels_of_o_words_belong_to_their_subroutine() {
    let text = "o<Side Cut> sub\no1 if [#1]\no5 return [1]\no1 endif\no<sidecut> endsub\no1 while [0]\no<SIDE cut> call\no1 endwhile\no9 call\no[#1] call\nM2\n";
    check(
        "linuxcnc",
        text,
        &expect![[r#"
            0  o<Side Cut> sub        end 4 target flow
            1  o1 if [#1]             next 3 end 3 in 0 target flow
            2  o5 return [1]          head 0 end 4 in 0 to 4 target flow
            3  o1 endif               head 1 in 0 target flow
            4  o<sidecut> endsub      head 0 target flow
            5  o1 while [0]           end 7 target flow
            6  o<SIDE cut> call       calls 0 target flow
            7  o1 endwhile            head 5 target flow
            8  o9 call                target flow
            9  o[#1] call             target flow
            10 M2                     flow
        "#]],
    );
    let graph = World::new("linuxcnc", text).graph;
    assert_eq!(graph.sub(&OLabel::Name("sidecut".to_owned())), Some(0));
    assert_eq!(graph.sub(&OLabel::Number(9)), None);
    assert_eq!(
        (0..7).map(|b| graph.sub_around(b)).collect::<Vec<_>>(),
        [Some(0), Some(0), Some(0), Some(0), Some(0), None, None]
    );
}

#[test]
fn o_words_without_partner_are_listed() {
    check(
        "linuxcnc",
        "o1 if [1]\no2 else\no3 endwhile\no4 break\no5 return\no6 while [1]\no7 endsub\no[#1] if [1]\no8 do\no9 repeat [1]\no9 endif\no10 sub\no11 endsub\no10 return\n",
        &expect![[r#"
            0  o1 if [1]              target flow unmatched
            1  o2 else                target flow unmatched
            2  o3 endwhile            target flow unmatched
            3  o4 break               target flow unmatched
            4  o5 return              target flow unmatched
            5  o6 while [1]           target flow unmatched
            6  o7 endsub              target flow unmatched
            7  o[#1] if [1]           target flow unmatched
            8  o8 do                  target flow unmatched
            9  o9 repeat [1]          target flow unmatched
            10 o9 endif               target flow unmatched
            11 o10 sub                target flow unmatched
            12 o11 endsub             in 11 target flow unmatched
            13 o10 return             head 11 in 11 target flow
        "#]],
    );
}

#[test]
fn o_words_that_overlap_are_joined_by_label() {
    check(
        "linuxcnc",
        "o1 if [0]\no2 if [1]\no1 endif\no2 endif\n",
        &expect![[r#"
            0  o1 if [0]              next 2 end 2 target flow
            1  o2 if [1]              next 3 end 3 target flow
            2  o1 endif               head 0 target flow
            3  o2 endif               head 1 target flow
        "#]],
    );
}

#[test]
fn a_label_used_again_means_the_innermost_and_is_listed() {
    check(
        "linuxcnc",
        "o1 if [1]\no1 if [0]\no1 endif\no1 endif\no1 while [0]\no1 endwhile\no2 sub\no2 endsub\no2 sub\no2 endsub\no2 call\n",
        &expect![[r#"
            0  o1 if [1]              next 3 end 3 target flow
            1  o1 if [0]              next 2 end 2 target flow reused
            2  o1 endif               head 1 target flow
            3  o1 endif               head 0 target flow
            4  o1 while [0]           end 5 target flow reused
            5  o1 endwhile            head 4 target flow
            6  o2 sub                 end 7 target flow
            7  o2 endsub              head 6 target flow
            8  o2 sub                 end 9 target flow reused
            9  o2 endsub              head 8 target flow
            10 o2 call                calls 6 target flow
        "#]],
    );
}

#[test]
fn another_program_has_labels_of_its_own() {
    check(
        "linuxcnc",
        "O5\no1 if [1]\no1 endif\nM98 P6\nM2\nO6\no1 if [1]\no1 endif\nM99\nO7\no3 sub\nO8\no3 endsub\n",
        &expect![[r#"
            0  O5                     target
            1  o1 if [1]              next 2 end 2 target flow
            2  o1 endif               head 1 target flow
            3  M98 P6                 flow
            4  M2                     flow
            5  O6                     target
            6  o1 if [1]              next 7 end 7 target flow
            7  o1 endif               head 6 target flow
            8  M99                    flow
            9  O7                     target
            10 o3 sub                 target flow unmatched
            11 O8                     target
            12 o3 endsub              target flow unmatched
        "#]],
    );
}

#[test]
fn runs_end_at_flow_and_at_labels_that_are_jumped_to() {
    let text = "O1\nN1 G1 X1.\nN2 X2.\nN3 X3.\nIF [#1 EQ 0] GOTO 2\nN5 X5.\nG65 P9010 A1.\nX7.\nG#1 X8.\n#3=1\nM30\nO2\nX12.\nM99\n";
    let world = World::new("fanuc-mill", text);
    let runs: String = (0..world.graph.blocks())
        .map(|b| format!("{b:<2} {:20} {:?}\n", world.block(b), world.graph.straight_from(b)))
        .collect();
    expect![[r#"
        0  O1                   0..2
        1  N1 G1 X1.            1..2
        2  N2 X2.               2..4
        3  N3 X3.               3..4
        4  IF [#1 EQ 0] GOTO 2  4..4
        5  N5 X5.               5..6
        6  G65 P9010 A1.        6..6
        7  X7.                  7..8
        8  G#1 X8.              8..8
        9  #3=1                 9..10
        10 M30                  10..10
        11 O2                   11..13
        12 X12.                 12..13
        13 M99                  13..13
    "#]]
    .assert_eq(&runs);
}

#[test]
fn flow_is_what_may_decide_the_next_block() {
    let flow = |text: &str| {
        let graph = World::new("fanuc-mill", text).graph;
        (0..graph.blocks()).map(|block| graph.is_flow(block)).collect::<Vec<_>>()
    };
    assert_eq!(flow("G1 X1.\nX#1\n#1=2\nM0\nDPRNT[A]\nG4 P1\n"), [false; 6]);
    assert_eq!(flow("M98 P1\nG66 P1\n/M30\nM99\nM#1\nIF [#1 EQ 1] #2=3\n"), [true; 6]);
    assert_eq!(
        flow("#3000=1 (no tool)\n#[#1]=1\n#100=1\n"),
        [true, true, false],
        "an alarm ends the program"
    );
}

#[test]
fn codes_that_the_user_makes_call_a_macro_are_flow() {
    let alias = |program: Option<&str>| UserCode {
        number: CodeNumber::from_value(b'M', 60.0).unwrap(),
        title: "pallet".to_owned(),
        alias: program.map(str::to_owned),
    };
    for (alias, is_flow) in [(alias(Some("O9001")), true), (alias(None), false)] {
        let control = gcheck_controls::load("haas-mill").unwrap().with_user_codes(&[alias]);
        let dialect = Dialect::new(&control);
        let text = "G0 X1.\nM60\n";
        let mut builder = ControlFlowGraph::builder();
        builder.add(&lower(text, &dialect), 0, text.len() as u32, text, &dialect);
        assert_eq!(builder.finish().is_flow(1), is_flow);
    }
}

#[test]
fn a_chunk_is_straight_without_flow_and_without_labels_in_use() {
    let straight = |control: &str, text: &str| {
        let graph = World::in_lines(control, text, 2).graph;
        (0..graph.chunks()).map(|chunk| graph.is_straight(chunk)).collect::<Vec<_>>()
    };
    let plain = "O1\nN1 X1.\nN2 X2.\nN3 X3.\nN4 X4.\nM30\n";
    assert_eq!(straight("fanuc-mill", plain), [true, true, false]);
    let jumps = "N1 X1.\nN2 X2.\nN3 X3.\nN4 X4.\nGOTO 3\nM30\n";
    assert_eq!(straight("fanuc-mill", jumps), [true, false, false]);
    let computed = "N1 X1.\nX2.\nX3.\nX4.\nGOTO #1\nM30\n";
    assert_eq!(straight("fanuc-mill", computed), [false, true, false]);
    let other = "O1\nN1 X1.\nM30\n(end)\nO2\nX1.\nGOTO #1\nM99\nX1.\nN1 X2.\n";
    assert_eq!(
        straight("fanuc-mill", other),
        [true, false, false, false, false],
        "a computed GOTO stays in O2"
    );
    let returns = "O1\nN1 X1.\nM30\n(end)\nO2\nM99 P#1\n";
    assert_eq!(straight("fanuc-mill", returns), [false, false, false], "a computed return may leave O2");
    let local = "N1 X1.\nX2.\nM97 P1\nM30\n";
    assert_eq!(straight("haas-mill", local), [false, false]);
    let recursion = "O1\nX1.\nX2.\nM98 P1\n";
    assert_eq!(straight("fanuc-mill", recursion), [false, false]);
    assert!(!World::new("haas-mill", "X1.\n").graph.is_straight(1));
    assert!(
        World::new("haas-mill", "\n\n").graph.is_straight(0),
        "nothing happens in a chunk without blocks"
    );
}

#[test]
fn profile_cycles_use_the_labels_of_their_profile() {
    let text = "N1 X1.\nX2.\nN2 X3.\nX4.\nG70 P1 Q2\nM30\n";
    let graph = World::in_lines("haas-lathe", text, 2).graph;
    assert!(!graph.is_straight(0) && !graph.is_straight(1) && graph.is_flow(4));
}

#[test]
fn a_jump_of_another_file_can_be_made_known() {
    let mut graph = World::in_lines("fanuc-mill", "N1 X1.\nX2.\nN3 X3.\nX4.\n", 2).graph;
    assert!(graph.is_straight(1));
    graph.enter_at_label(3);
    graph.enter_at_label(99);
    assert!(graph.is_straight(0) && !graph.is_straight(1));
    assert_eq!(graph.straight_from(0), 0..2);
}

#[test]
fn memory_without_labels_grows_with_chunks_only() {
    let text = inputs::surfacing(200_000);
    let graph = World::new("haas-mill", &text).graph;
    assert!(graph.blocks() > 199_000);
    assert!(graph.heap_bytes() < 8 * graph.chunks() + 1_000, "{} bytes", graph.heap_bytes());
    let straight = (0..graph.chunks()).filter(|c| graph.is_straight(*c)).count();
    assert!(straight + 1 >= graph.chunks(), "all chunks but the last are straight: {straight}");
}

#[test]
fn a_label_takes_twelve_bytes_at_most() {
    let text: String = (0..200_000).map(|n| format!("N{} X{n}. Y1.\n", n % 99_999)).collect();
    let graph = World::new("haas-mill", &format!("{text}GOTO #1\n")).graph;
    assert!(graph.heap_bytes() <= 12 * 200_000, "{} bytes", graph.heap_bytes());
}

/// Statements by the hundred thousand: quadratic behaviour would take minutes.
#[test]
fn many_statements_take_no_longer_each_than_few() {
    const MANY: usize = 100_000;
    let lines = |line: &dyn Fn(usize) -> String| (0..MANY).map(line).collect::<String>();
    let programs = [
        ("fanuc-mill", lines(&|n| format!("N{n} IF [#1 EQ {n}] GOTO {}\n", MANY - n))),
        ("fanuc-mill", lines(&|_| "N10 GOTO 10\n".to_owned())),
        ("fanuc-mill", lines(&|n| format!("DO{n}\n"))),
        ("fanuc-mill", lines(&|_| "DO1\n".to_owned()) + &lines(&|_| "END2\n".to_owned())),
        ("fanuc-mill", lines(&|n| format!("DO{n}\n")) + &lines(&|n| format!("END{n}\n"))),
        ("fanuc-mill", lines(&|n| format!("O{n}\nDO1\nM98 P{n}\nM99\n"))),
        ("linuxcnc", lines(&|n| format!("o{n} if [1]\n")) + &lines(&|n| format!("o{n} endif\n"))),
        ("linuxcnc", lines(&|_| "o1 if [1]\n".to_owned()) + &lines(&|_| "o1 else\n".to_owned())),
        ("linuxcnc", lines(&|n| format!("o{n} sub\no1 while [0]\n")) + &lines(&|n| format!("o{n} endsub\n"))),
        ("linuxcnc", lines(&|_| "o1 sub\n".to_owned()) + &lines(&|_| "o2 endsub\n".to_owned())),
        ("linuxcnc", "o1 while [1]\n".to_owned() + &lines(&|_| "o1 break\n".to_owned())),
        ("linuxcnc", lines(&|n| format!("o<a{n}> call\nO{n}\n"))),
        ("fanuc-mill", format!("{}\n", lines(&|_| "M98 P1 ".to_owned()))),
        ("fanuc-mill", format!("{}\n", lines(&|_| "DO1 END1 ".to_owned()))),
    ];
    for (control, text) in programs {
        let graph = World::new(control, &text).graph;
        let mut found = 0;
        for block in 0..graph.blocks() {
            found += usize::from(graph.end_of(block).is_some());
            found += usize::from(graph.do_of(block).is_some());
            found += usize::from(graph.o_word(block).is_some_and(|w| w.end.is_some()));
            found += usize::from(graph.label(block, block, true).is_some());
            found += usize::from(graph.program(block).is_some());
            found += graph.part_of(block).len().min(1) + graph.straight_from(block).len().min(1);
            found += usize::from(graph.sub_around(block).is_some());
        }
        assert!(found > 0);
    }
}

/// What programs of control flow are made of.
fn piece() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "O1\n",
        "O2\n",
        ":3\n",
        "N10 O4\n",
        "O<A B>\n",
        "N10",
        "N20",
        "N10.5",
        "N",
        " G1",
        " X1.",
        " M30",
        " M99",
        " M99 P10",
        " M98 P1",
        " M97 P#1",
        " G65 P2",
        " M#1",
        "GOTO 10",
        "GOTO#1",
        "IF [#1 EQ 0]",
        "WHILE [#1] ",
        "DO1",
        "DO2",
        "END1",
        "END2",
        "DO#1",
        "END",
        "o1 sub",
        "o2 sub",
        "o1 endsub",
        "o2 endsub",
        "o1 call",
        "o<a> sub",
        "o<a> endsub",
        "o1 if [1]",
        "o1 elseif [1]",
        "o1 else",
        "o1 endif",
        "o3 while [1]",
        "o3 endwhile",
        "o3 do",
        "o3 break",
        "o3 continue",
        "o1 return",
        "o4 repeat [3]",
        "o4 endrepeat",
        "o[#1] if [1]",
        "#1=",
        "#[#1]=1",
        "1.",
        "[",
        "(x",
        ";",
        "%\n",
        "/",
        "µ",
        "\u{FEFF}",
        "\n",
        "\n",
        "\n",
        "\n",
        "\n",
        "\r\n",
    ])
}

fn check_laws(world: &World) -> Result<(), TestCaseError> {
    let graph = &world.graph;
    let programs: Vec<_> = graph.programs().collect();
    let mut end = 0;
    for program in &programs {
        prop_assert_eq!(program.blocks.start, end);
        end = program.blocks.end;
    }
    prop_assert_eq!(end, graph.blocks());
    for block in 0..graph.blocks().saturating_add(2) {
        let part = graph.part_of(block);
        let (chunk, run) = (graph.chunk_of(block), graph.straight_from(block));
        prop_assert_eq!(chunk.is_some(), block < graph.blocks());
        prop_assert_eq!(part.contains(&block), block < graph.blocks());
        prop_assert!(run.start == block && (run.end == block || run.end <= part.end));
        prop_assert_eq!(run.is_empty(), graph.is_flow(block) || !part.contains(&block));
        if let Some((chunk, ix)) = chunk {
            let blocks = graph.blocks_of(chunk);
            prop_assert_eq!(blocks.start + ix, block);
            prop_assert!(blocks.contains(&block));
            prop_assert!(!graph.is_straight(chunk) || !graph.is_flow(block));
        }
        if let Some(end) = graph.end_of(block) {
            prop_assert!(end > block && part.contains(&end));
            prop_assert_eq!(graph.do_of(end), Some(block));
        }
        if let Some(found) = graph.label(10, block, true) {
            prop_assert!(part.contains(&found) && graph.may_be_target(found));
        }
        if let Some(word) = graph.o_word(block) {
            prop_assert!(graph.may_be_target(block) && graph.is_flow(block));
            prop_assert!(word.head.is_none_or(|head| head < block && part.contains(&head)));
            prop_assert!(word.end.is_none_or(|end| end > block && part.contains(&end)));
            prop_assert!(word.next.is_none_or(|next| next > block && part.contains(&next)));
            let of_head = word.head.and_then(|head| graph.o_word(head));
            prop_assert!(of_head.is_none_or(|head| head.end.is_none_or(|end| end >= block)));
            let branches: Vec<_> = graph.branches(block).collect();
            prop_assert!(branches.is_sorted());
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_500))]

    #[test]
    fn garbage_has_an_outline_and_chunks_do_not_change_it(
        pieces in prop::collection::vec(piece(), 0..80),
        lines in 1_usize..6,
    ) {
        let text = pieces.concat();
        for control in ["fanuc-mill", "linuxcnc"] {
            let whole = World::new(control, &text);
            check_laws(&whole)?;
            let parted = World::in_lines(control, &text, lines);
            check_laws(&parted)?;
            let mut graph = parted.graph;
            graph.chunks.clone_from(&whole.graph.chunks);
            prop_assert_eq!(&graph, &whole.graph, "{} on {:?}", control, text);
        }
    }

    #[test]
    fn any_text_has_an_outline(text in "(?s).{0,200}") {
        check_laws(&World::in_lines("linuxcnc", &text, 3))?;
    }
}
