//! Law 3: a file that is edited has the findings of a fresh check, however it is cut.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt::Write as _;
use std::sync::Arc;

use gcheck_lint::{
    ChunkFacts, ChunkFindings, ChunkSource, EditedFile, Environment, Execution, Incremental, Job, Omitted,
    Outcome, Selection, Work, check,
};
use gcheck_program::Dialect;
use gcheck_syntax::SourceText;

use crate::Finding;
use crate::testing::World;

/// Makes what is asked for, every time.
struct Fresh<'a> {
    chunks: &'a [Arc<str>],
    environment: Environment<'a>,
    selection: &'a Selection,
}

impl ChunkSource for Fresh<'_> {
    fn facts(&self, chunk: usize, end: u32) -> Arc<ChunkFacts> {
        Arc::new(ChunkFacts::new(&self.chunks[chunk], end, self.environment.dialect))
    }

    fn findings(&self, chunk: usize, end: u32) -> Arc<ChunkFindings> {
        Arc::new(ChunkFindings::new(&self.chunks[chunk], end, self.environment, self.selection))
    }

    fn counts(&self, chunk: usize, end: u32) -> Arc<Omitted> {
        Arc::new(self.findings(chunk, end).counts())
    }
}

/// Numbers that look random and are the same every time.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, below: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % below.max(1) as u64) as usize
    }
}

/// Whole lines together, cut after lines whose bytes add up to something.
fn cut(text: &str, lines: usize) -> Vec<Arc<str>> {
    let mut chunks = Vec::new();
    let mut chunk = String::new();
    let mut rest = text;
    while !rest.is_empty() {
        let (line, behind) = rest.split_at(gcheck_syntax::line_len(rest.as_bytes()));
        chunk.push_str(line);
        rest = behind;
        let sum: usize = line.bytes().map(usize::from).sum();
        if sum.is_multiple_of(lines) {
            chunks.push(Arc::from(std::mem::take(&mut chunk)));
        }
    }
    if !chunk.is_empty() {
        chunks.push(Arc::from(chunk));
    }
    chunks
}

fn shown(outcome: &Outcome) -> String {
    let line = |finding: &Finding| {
        let Finding { rule, severity, certainty, message, range, label, labels, notes, help, alarm, .. } =
            finding;
        // Work is counted, and an edited file needs less or more of it: where it is used up is not where a fresh check stops.
        let range = if rule.id == "analysis-incomplete" { &(0..0) } else { range };
        let place = format!("{} {severity} {} {range:?} {message} | {label}", rule.id, certainty.name());
        let Finding { assumptions, fixes, .. } = finding;
        format!("{place} | {labels:?} {notes:?} {help:?} {alarm:?} {assumptions:?} {fixes:?}")
    };
    let mut findings: Vec<String> = outcome.findings.iter().map(line).collect();
    if outcome.out_of_fuel {
        findings.sort();
    }
    let omitted: Vec<_> = outcome.omitted.iter().map(|(rule, sev, count)| (rule.id, sev, count)).collect();
    format!(
        "{}\n{omitted:?} {} {} {:?} {}",
        findings.join("\n"),
        outcome.suppressed,
        outcome.lines,
        outcome.assumptions,
        outcome.out_of_fuel
    )
}

/// A program under edit, in one world.
struct Bench<'a> {
    environment: Environment<'a>,
    selection: &'a Selection,
    suppressions: bool,
    incremental: Incremental,
    execution: Execution,
    /// Chunks that are checked ahead of the rest; none of them without a word about it.
    ahead: usize,
}

impl<'a> Bench<'a> {
    fn new(environment: Environment<'a>, selection: &'a Selection) -> Self {
        Self {
            environment,
            selection,
            suppressions: true,
            incremental: Incremental::new(),
            execution: Execution::default(),
            ahead: 0,
        }
    }

    fn check(&mut self, text: &str, lines: usize) -> (Outcome, Work) {
        let chunks = cut(text, lines);
        let source = Fresh { chunks: &chunks, environment: self.environment, selection: self.selection };
        let edited = EditedFile {
            chunks: &chunks,
            source: &source,
            environment: self.environment,
            selection: self.selection,
            suppressions: self.suppressions,
            execution: self.execution,
            stop: &|| false,
        };
        let first = (self.ahead > 0).then(|| self.incremental.check_first(&edited, self.ahead).unwrap());
        let outcome = self.incremental.check(&edited).unwrap();
        for finding in first.iter().flat_map(|first| &first.findings) {
            assert!(outcome.findings.contains(finding), "taken back: {finding:#?}\nin {chunks:#?}");
        }
        (outcome, self.incremental.work())
    }

    fn assert_fresh(&mut self, text: &str, lines: usize, what: &dyn Fn() -> String) -> Work {
        let (outcome, work) = self.check(text, lines);
        let source = SourceText::from(text);
        let fresh = check(&Job {
            source: &source,
            environment: self.environment,
            selection: self.selection,
            suppressions: self.suppressions,
            execution: self.execution,
        });
        let (own, fresh) = (shown(&outcome), shown(&fresh));
        if own != fresh {
            let only = |a: &str, b: &str| {
                a.lines().filter(|line| !b.lines().any(|other| other == *line)).collect::<Vec<_>>().join("\n")
            };
            let (more, less) = (only(&own, &fresh), only(&fresh, &own));
            panic!("{}\n{work:?}\n{text}\n--- incremental only\n{more}\n--- fresh only\n{less}", what());
        }
        work
    }
}

/// Changes a program somehow: characters, words, lines, parts of other programs.
fn edit(text: &mut String, dice: &mut Dice, others: &[&str]) -> String {
    let mut lines: Vec<String> = text.split_inclusive('\n').map(str::to_owned).collect();
    let at = dice.roll(lines.len() + 1).min(lines.len().saturating_sub(1));
    let told;
    match dice.roll(10) {
        0 if !lines.is_empty() => told = format!("delete {:?}", lines.remove(at)),
        1 => {
            let other = others[dice.roll(others.len())];
            let all: Vec<&str> = other.lines().collect();
            let line = format!("{}\n", all.get(dice.roll(all.len())).unwrap_or(&""));
            told = format!("insert {line:?} at {at}");
            lines.insert(at, line);
        }
        2 => {
            let other = others[dice.roll(others.len())];
            told = format!("paste {other:?} at {at}");
            let other = if other.ends_with('\n') { other.to_owned() } else { format!("{other}\n") };
            lines.insert(at, other);
        }
        3 if !lines.is_empty() => {
            let words = [
                "G01 ", "G0 ", "G91 ", "G90 ", "X1. ", "Z-1. ", "F100. ", "(A) ", "M3 S500 ", "T1 M6 ",
                "G41 D1 ",
            ];
            let word = words[dice.roll(words.len())];
            let line = &mut lines[at];
            let places: Vec<usize> =
                (0..=line.trim_end().len()).filter(|i| line.is_char_boundary(*i)).collect();
            let place = places[dice.roll(places.len())];
            line.insert_str(place, word);
            told = format!("put {word:?} in line {at} at {place}");
        }
        4 if !lines.is_empty() => {
            let line = lines[at].clone();
            told = format!("double line {at}");
            lines.insert(at, line);
        }
        5 | 6 if !lines.is_empty() => {
            // A digit becomes another.
            let line = &mut lines[at];
            let digits: Vec<usize> =
                line.match_indices(|c: char| c.is_ascii_digit()).map(|(i, _)| i).collect();
            if let Some(place) = digits.get(dice.roll(digits.len())) {
                let digit = dice.roll(10).to_string();
                line.replace_range(*place..=*place, &digit);
            }
            told = format!("another digit in line {at}");
        }
        7 => {
            lines.insert(at, "X2. Y3.\n".to_owned());
            told = format!("move at {at}");
        }
        8 if !lines.is_empty() => {
            let line = &mut lines[at];
            let chars: Vec<usize> = line.char_indices().map(|(i, _)| i).collect();
            let place = chars[dice.roll(chars.len())];
            line.remove(place);
            told = format!("delete a character of line {at}");
        }
        _ => {
            let line = ["(COMMENT)\n", "\n", "G0 Z5.\n", "G1 X5. F50.\n"][dice.roll(4)];
            lines.insert(at, line.to_owned());
            told = format!("insert {line:?} at {at}");
        }
    }
    *text = lines.concat();
    told
}

/// Edits of a program, each checked against a fresh one.
fn soak(seed: u64, control: &str, world: &World<'_>, start: &str, others: &[&str], edits: usize) -> Work {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let environment = world.environment(&dialect);
    let selection = everything();
    let mut dice = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let lines = 1 + dice.roll(3);
    let execution = Execution { fuel: 20_000, block_skip: None };
    let mut bench =
        Bench { suppressions: world.suppressions, execution, ..Bench::new(environment, &selection) };
    let mut text = start.to_owned();
    let mut told = Vec::new();
    let mut all = Work::default();
    for round in 0..=edits {
        // Every second time, more chunks each time.
        bench.ahead = if round % 2 == 0 { (seed as usize + round / 2) % 5 } else { 0 };
        let work = bench.assert_fresh(&text, lines, &|| format!("seed {seed}: {told:#?}"));
        all.executed += work.executed;
        all.kept += work.kept;
        all.from_the_start += work.from_the_start;
        told.push(edit(&mut text, &mut dice, others));
    }
    all
}

#[test]
fn edited_examples_of_every_rule_are_checked_as_fresh_ones() {
    let mut by_control: HashMap<String, Vec<String>> = HashMap::new();
    let rules = crate::RULES;
    for example in rules.iter().flat_map(|rule| rule.meta.examples()) {
        by_control.entry(example.control).or_default().push(example.code);
    }
    let mut work = Work::default();
    let mut seed = 0;
    for rule in rules.iter() {
        for example in rule.meta.examples() {
            seed += 1;
            let others: Vec<&str> = by_control[&example.control].iter().map(String::as_str).collect();
            let world = World::of_example(rule.meta, &example);
            // Longer programs keep more: three examples one after the other.
            let mut start = example.code.clone();
            if seed % 3 == 0 {
                start =
                    format!("{}{}{start}", others[seed * 7 % others.len()], others[seed * 13 % others.len()]);
            }
            let done = soak(seed as u64, &example.control, &world, &start, &others, 8);
            work.kept += done.kept;
            work.executed += done.executed;
        }
    }
    // Some of it was not done again.
    assert!(work.kept * 5 > work.executed, "{work:?}");
}

#[test]
fn a_line_put_in_behind_a_subroutine_is_on_the_way_past_it() {
    let control = gcheck_controls::load("linuxcnc").unwrap();
    let dialect = Dialect::new(&control);
    let world = World::default();
    let environment = world.environment(&dialect);
    let selection = everything();
    let execution = Execution { fuel: 20_000, block_skip: None };
    let mut bench = Bench { execution, ..Bench::new(environment, &selection) };
    let text = |line: &str| {
        format!("G21 G90 G17\no100 sub\no100 endsub\n{line}o200 sub\no200 endsub\no100 call\nM2\n")
    };
    bench.assert_fresh(&text(""), 1, &String::new);
    bench.assert_fresh(&text("#1=-100\n"), 1, &String::new);
    bench.assert_fresh(&text(""), 1, &String::new);
}

#[test]
fn every_rule_says_what_it_remembers() {
    let mut silent = Vec::new();
    for rule in crate::RULES.iter() {
        if let gcheck_lint::Run::Path { make, .. } = rule.run
            && matches!(make().memory(), gcheck_lint::Remembers::Unknown)
        {
            silent.push(rule.meta.id);
        }
    }
    assert!(silent.is_empty(), "these say nothing of their memory: {silent:?}");
}

/// A plain program of many tools and moves, a hundred lines a tool.
fn long_program(tools: usize) -> String {
    let mut text = "%\nO1\nG90 G54 G17 G40 G49 G80\n".to_owned();
    for tool in 1..=tools {
        let _ = write!(text, "T{tool} M6\nG43 H{tool} Z50.\nM3 S1000\nG0 X0. Y0.\nG1 Z-1. F100.\n");
        for step in 0..90 {
            let _ = writeln!(text, "X{step}.5 Y{}.25", step % 7);
        }
        text += "G0 Z50.\nM5\n";
    }
    text + "M30\n%\n"
}

/// What a change of a long program costs.
fn cost(change: impl Fn(&mut String)) -> Work {
    let control = gcheck_controls::load("haas-mill").unwrap();
    let dialect = Dialect::new(&control);
    let world = World::default();
    let environment = world.environment(&dialect);
    let mut selection = everything();
    // These remember every cut.
    selection.disable("rapid-in-material").unwrap();
    selection.disable("rapid-plunge").unwrap();
    selection.disable("rapid-between-cuts").unwrap();
    selection.disable("rapid-below-zero-on-approach").unwrap();
    selection.disable("plunge-at-cutting-feed").unwrap();
    let mut bench = Bench::new(environment, &selection);
    let mut text = long_program(20);
    let first = bench.assert_fresh(&text, 7, &|| "at first".to_owned());
    assert!(first.from_the_start == 1 && first.executed > 100, "{first:?}");
    change(&mut text);
    bench.assert_fresh(&text, 7, &|| "after the change".to_owned())
}

fn replace_in(text: &mut String, from: usize, what: &str, with: &str) {
    let at = from + text[from..].find(what).unwrap();
    text.replace_range(at..at + what.len(), with);
}

#[test]
fn a_coordinate_costs_its_neighbourhood() {
    let work = cost(|text| {
        let middle = text.len() / 2;
        replace_in(text, middle, "X40.5", "X41.5");
    });
    assert!(work.executed <= 3 && work.from_the_start == 0, "{work:?}");
}

#[test]
fn a_comment_costs_its_neighbourhood() {
    let work = cost(|text| {
        let middle = text.len() / 2;
        replace_in(text, middle, "X40.5", "(HERE) X40.5");
    });
    assert!(work.executed <= 3 && work.from_the_start == 0, "{work:?}");
}

#[test]
fn a_modal_word_costs_its_neighbourhood() {
    let work = cost(|text| {
        let middle = text.len() / 2;
        replace_in(text, middle, "X40.5", "G01 X40.5");
    });
    assert!(work.executed <= 4 && work.from_the_start == 0, "{work:?}");
}

#[test]
fn a_line_at_the_top_costs_its_neighbourhood() {
    let work = cost(|text| replace_in(text, 0, "G90 ", "(PART 7)\nG90 "));
    // Findings of each tool that name the head of the program are made again: one segment of the tool's fourteen.
    assert!(work.executed <= 20 && work.kept > 250 && work.from_the_start == 1, "{work:?}");
}

#[test]
fn lines_that_come_and_go_cost_their_neighbourhood() {
    let put_in = cost(|text| {
        let middle = text.len() / 2;
        replace_in(text, middle, "X40.5", "X39. Y1.\nX40.5");
    });
    assert!(put_in.executed <= 3 && put_in.from_the_start == 0, "{put_in:?}");
    let taken_out = cost(|text| {
        let middle = text.len() / 2;
        replace_in(text, middle, "X40.5 Y5.25\n", "");
    });
    assert!(taken_out.executed <= 3 && taken_out.from_the_start == 0, "{taken_out:?}");
}

#[test]
fn a_label_that_is_jumped_to_costs_the_control_flow() {
    let work = cost(|text| replace_in(text, 0, "M30", "IF [#500 EQ 1] GOTO 7\nN7 M30"));
    // All paths, then each of the two ways.
    assert!(work.from_the_start == 3 && work.kept == 0, "{work:?}");
}

#[test]
fn work_that_is_given_up_is_taken_up_again() {
    let control = gcheck_controls::load("haas-mill").unwrap();
    let dialect = Dialect::new(&control);
    let world = World::default();
    let environment = world.environment(&dialect);
    let selection = everything();
    let text = long_program(400);
    let chunks = cut(&text, 7);
    let source = Fresh { chunks: &chunks, environment, selection: &selection };
    let asked = RefCell::new(0);
    let mut incremental = Incremental::new();
    let mut edited = EditedFile {
        chunks: &chunks,
        source: &source,
        environment,
        selection: &selection,
        suppressions: true,
        execution: Execution::default(),
        stop: &|| {
            *asked.borrow_mut() += 1;
            // After the facts of all chunks, in the midst of the paths.
            *asked.borrow() > chunks.len() / 64 + 3
        },
    };
    assert!(incremental.check(&edited).is_err());
    let before = incremental.work();
    edited.stop = &|| false;
    let outcome = incremental.check(&edited).unwrap();
    assert!(incremental.work().kept > 0 && before.from_the_start == 1, "{:?}", incremental.work());
    let source = SourceText::from(&*text);
    let fresh = check(&Job {
        source: &source,
        environment,
        selection: &selection,
        suppressions: true,
        execution: Execution::default(),
    });
    assert_eq!(shown(&outcome), shown(&fresh));
}

#[test]
fn the_first_chunks_are_checked_without_the_rest() {
    let control = gcheck_controls::load("haas-mill").unwrap();
    let dialect = Dialect::new(&control);
    let world = World::default();
    let environment = world.environment(&dialect);
    let selection = everything();
    // Nobody says a feed, at the first tool and at one after it; one is silenced far away.
    let text = long_program(400)
        .replace(" F100.", "")
        .replace("M30", "(gcheck: ignore-file spindle-speed-zero - x)\nM30");
    let chunks = cut(&text, 7);
    let source = Fresh { chunks: &chunks, environment, selection: &selection };
    let edited = EditedFile {
        chunks: &chunks,
        source: &source,
        environment,
        selection: &selection,
        suppressions: true,
        execution: Execution::default(),
        stop: &|| false,
    };
    let mut incremental = Incremental::new();
    let first = incremental.check_first(&edited, 5).unwrap();
    let work = incremental.work();
    assert!(work.executed <= 10, "{work:?}");
    let rules: Vec<&str> = first.findings.iter().map(|finding| finding.rule.id).collect();
    assert!(rules.contains(&"feed-missing"), "{rules:?}");
    let whole = incremental.check(&edited).unwrap();
    assert!(incremental.work().kept >= work.executed && incremental.work().from_the_start == 0);
    assert!(first.findings.len() < whole.findings.len());
    assert!(first.findings.iter().all(|finding| whole.findings.contains(finding)));
}

/// Every rule.
fn everything() -> Selection {
    let mut selection = crate::testing::recommended();
    selection.enable("all").unwrap();
    selection
}

#[test]
fn what_is_put_in_where_a_segment_begins_is_executed() {
    let control = gcheck_controls::load("linuxcnc").unwrap();
    let dialect = Dialect::new(&control);
    let world = World::default();
    let environment = world.environment(&dialect);
    let selection = everything();
    let (head, tail) = ("G17 G21 G90 G0 X10 Y0\nG1 X0 F100\nG1 X10\nG2 X10 Y0 I-10\n", "(END)\nG1 X3\nM2\n");
    for lines in 1..5 {
        let mut bench = Bench::new(environment, &selection);
        bench.assert_fresh(&format!("{head}{tail}"), lines, &|| format!("{lines} lines a chunk"));
        bench.assert_fresh(&format!("{head}X2 Y3\n{tail}"), lines, &|| {
            format!("{lines} lines a chunk, put in")
        });
    }
}

#[test]
fn a_condition_at_the_start_of_a_chunk_is_one_all_the_same() {
    let control = gcheck_controls::load("haas-mill").unwrap();
    let dialect = Dialect::new(&control);
    let world = World::default();
    let environment = world.environment(&dialect);
    let selection = everything();
    // The words after the jump are not read when it is taken.
    let text = "#1=3\nIF [#1 EQ 3] GOTO 4 M60\nM30\n";
    for lines in 1..4 {
        Bench::new(environment, &selection).assert_fresh(text, lines, &|| format!("{lines} lines a chunk"));
    }
}
