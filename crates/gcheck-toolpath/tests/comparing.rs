//! Two runs compared section by section: what is added, removed, moved and changed is told once, and the rest is the same.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use expect_test::expect;
use gcheck_engine::{
    Concrete, Event, Fault, Machine, Model, NoLibrary, Observer, Options, Origin, Program, State, Units, run,
};
use gcheck_program::{Dialect, Loaded};
use gcheck_toolpath::{
    Act, Aspect, Change, Differences, Marks, Outline, Rest, SectionAt, Sections, Spot, Step, Title, Trail,
    WorkCoordinates, compare,
};
use proptest::prelude::*;

const TOLERANCE: f64 = 0.001;

struct Recorder<'a> {
    model: &'a Model<'a>,
    machine: &'a Machine,
    starts: Vec<usize>,
    trail: Trail,
    acts: Vec<Act>,
    fault: Option<String>,
}

impl Observer<Concrete> for Recorder<'_> {
    fn event(&mut self, origin: Origin, state: &State<Concrete>, event: &Event) {
        let line = self.starts.partition_point(|start| *start <= origin.start as usize);
        let spot = Spot { file: "program", line: u32::try_from(line).unwrap(), n: origin.n };
        let step = Step::seen(event, state, self.model, self.machine, spot, Units::Mm);
        let acts = &mut self.acts;
        self.trail.add(&step, |act| acts.push(act));
    }

    fn fault(&mut self, _: Origin, _: &State<Concrete>, fault: &Fault) {
        self.fault = Some(format!("{fault:?}"));
    }
}

fn acts(text: &str) -> Vec<Act> {
    let control = gcheck_controls::load("fanuc-mill").unwrap();
    let model = Model::new(&control);
    let dialect = Dialect::new(&control);
    let machine = Machine::default();
    let loaded = Loaded::new(text, &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let mut recorder = Recorder {
        model: &model,
        machine: &machine,
        starts: std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect(),
        trail: Trail::new(WorkCoordinates::at_power_on(&model, &machine)),
        acts: Vec::new(),
        fault: None,
    };
    run(&program, &model, &machine, Options::NONE, 1_000_000, &mut recorder);
    assert_eq!(recorder.fault, None, "{text}");
    recorder.acts
}

/// Compares two programs as a whole, and where their paths part section by section.
fn differences(a: &str, b: &str, outlines: [Outline; 2]) -> Differences {
    let (a, b) = (acts(a), acts(b));
    let whole = compare(a.clone(), b.clone(), TOLERANCE, Rest::Read);
    if whole.parting.is_none() {
        return whole;
    }
    let [mut of_a, mut of_b] = outlines;
    for act in &a {
        of_a.add(act);
    }
    for act in &b {
        of_b.add(act);
    }
    let Some(sections) = Sections::new([of_a, of_b], TOLERANCE, Rest::Read) else { return whole };
    let mut found = sections.begun();
    for pass in 0..sections.passes() {
        sections.compare(pass, a.clone(), b.clone(), &mut found);
    }
    found
}

fn by_tools(a: &str, b: &str) -> Differences {
    differences(a, b, [Outline::of_tools(), Outline::of_tools()])
}

/// What a tool does: its number is its place, so that no two are alike.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Job {
    tool: u32,
    depth: u32,
    feed: u32,
}

impl Job {
    const fn new(tool: u32) -> Self {
        Self { tool, depth: 1, feed: 200 }
    }
}

/// A program of these jobs, as a post-processor writes it: a stop between tools, and another way home at the end.
fn program(jobs: &[Job]) -> String {
    let mut text = "%\nO1\nG21 G17 G90 G94 G40\nG91 G28 Z0.\nG90\n".to_owned();
    for (index, Job { tool, depth, feed }) in jobs.iter().enumerate() {
        let y = 7 * tool;
        let job = format!(
            "T{tool} M6\nG54 G90 G0 X0. Y{y}. S1000 M3\nG43 H{tool} Z5. M8\nG1 Z-{depth}. F{feed}.\nX50.\n\
             G3 X60. Y{}. R10.\nG1 Y{}.\nG0 Z50. M9\nM5\n",
            y + 10,
            y + 30
        );
        text += &job;
        if index + 1 < jobs.len() {
            text += "M1\n";
        }
    }
    text + "G91 G28 Z0.\nG28 X0. Y0.\nM30\n%\n"
}

fn jobs(tools: &[u32]) -> Vec<Job> {
    tools.iter().copied().map(Job::new).collect()
}

/// What was found, a line each.
fn told(found: &Differences) -> String {
    let name = |at: &SectionAt| match &at.title {
        Title::Start => format!("start@{}", at.place),
        Title::Tool(tool) => {
            format!("T{}@{} lines {}-{}", tool.unwrap_or(0), at.place, at.first.line, at.last)
        }
        Title::Operation(name) => format!("({name})@{} lines {}-{}", at.place, at.first.line, at.last),
    };
    let side = |at: &Option<SectionAt>| at.as_ref().map_or_else(|| "-".to_owned(), name);
    let mut lines: Vec<String> = found
        .sections()
        .iter()
        .map(|of| format!("{} {} {}", of.change.name(), side(&of.a), side(&of.b)))
        .collect();
    lines.extend(found.partings().map(|parting| {
        let within = parting
            .within
            .as_deref()
            .map_or_else(String::new, |[a, b]| format!(" in {} {}", name(a), name(b)));
        let again = parting
            .again
            .as_ref()
            .map_or_else(String::new, |again| format!(" again {}:{}", again.a.line, again.b.line));
        format!("path{within}{again}")
    }));
    for aspect in Aspect::ALL {
        if found.count(aspect) > 0 {
            lines.push(format!("{} {}", aspect.name(), found.count(aspect)));
        }
    }
    lines.join("\n")
}

/// How many things are told.
fn count(found: &Differences) -> u64 {
    let aspects: u64 = Aspect::ALL.into_iter().map(|aspect| found.count(aspect)).sum();
    found.sections().len() as u64 + found.partings_count() + aspects
}

#[test]
fn an_added_a_removed_and_a_moved_section_are_one_difference_each() {
    let old = program(&jobs(&[1, 2, 3, 4]));
    for (tools, expected) in [
        (&[1, 9, 2, 3, 4][..], expect!["section-added - T9@2 lines 16-25"]),
        (&[9, 1, 2, 3, 4], expect!["section-added - T9@1 lines 6-15"]),
        (&[1, 2, 3, 4, 9], expect!["section-added - T9@5 lines 46-56"]),
        (&[1, 2, 4], expect!["section-removed T3@3 lines 26-35 -"]),
        (&[1, 2, 3], expect!["section-removed T4@4 lines 36-46 -"]),
        (&[2, 3, 4, 1], expect!["section-moved T1@1 lines 6-15 T1@4 lines 36-46"]),
        (&[4, 1, 2, 3], expect!["section-moved T4@4 lines 36-46 T4@1 lines 6-15"]),
    ] {
        expected.assert_eq(&told(&by_tools(&old, &program(&jobs(tools)))));
    }
}

#[test]
fn a_changed_section_does_not_end_the_comparison() {
    let old = jobs(&[1, 2, 3, 4]);
    let mut new = old.clone();
    new[1].depth = 2;
    new[3].feed = 300;
    expect![[r#"
        path in T2@2 lines 16-25 T2@2 lines 16-25 again 26:26
        feed 1"#]]
    .assert_eq(&told(&by_tools(&program(&old), &program(&new))));
    // The last one, too, and one that is moved.
    let mut new = jobs(&[3, 1, 2, 4]);
    new[0].depth = 2;
    new[3].depth = 2;
    expect![[r#"
        section-moved T3@3 lines 26-35 T3@1 lines 6-15
        path in T4@4 lines 36-46 T4@4 lines 36-46
        path in T3@3 lines 26-35 T3@1 lines 6-15"#]]
    .assert_eq(&told(&by_tools(&program(&old), &program(&new))));
}

#[test]
fn a_wait_after_the_last_cut_counts_where_one_program_ends_there() {
    let old = program(&jobs(&[1, 2, 3, 4]));
    let new = program(&jobs(&[1, 2, 3]));
    let after_cut = |text: &str, block: &str| text.replace("G1 Y51.\n", &format!("G1 Y51.\n{block}\n"));
    for (block, expected) in [
        (
            "G4 P500",
            expect![[r#"
            section-removed T4@4 lines 37-47 -
            dwell 1"#]],
        ),
        (
            "M0",
            expect![[r#"
            section-removed T4@4 lines 37-47 -
            stop 1"#]],
        ),
        // Posts write optional stops between tools only.
        (
            "M1",
            expect![[r#"
            section-removed T4@4 lines 37-47 -
            stop 1"#]],
        ),
    ] {
        let old = after_cut(&old, block);
        expected.assert_eq(&told(&by_tools(&old, &new)));
        assert_eq!(count(&by_tools(&old, &after_cut(&new, block))), 1, "{block}");
    }
}

#[test]
fn what_a_moved_section_inherits_is_told_as_its_difference() {
    let with = |tools: &[u32]| {
        program(&jobs(tools)).replacen(" S1000 M3", "", 3).replacen("M6\n", "M6\nS800 M3\n", 1)
    };
    expect![[r#"
        section-moved T3@3 lines 27-37 T3@1 lines 6-16
        spindle 2"#]]
    .assert_eq(&told(&by_tools(&with(&[1, 2, 3]), &with(&[3, 1, 2]))));
}

#[test]
fn sections_are_paired_by_what_they_cut_and_not_by_numbers_alone() {
    let old = program(&jobs(&[1, 2, 3]));
    let new = program(&jobs(&[1, 9, 2, 3])).replace("T3 M6", "T5 M6").replace("H3", "H5");
    expect![[r#"
        section-added - T9@2 lines 16-25
        tool 2
        length-offset 1"#]]
    .assert_eq(&told(&by_tools(&old, &new)));
}

#[test]
fn a_path_on_both_sides_of_a_step_of_rounding_is_the_same_path() {
    let old = jobs(&[1, 2, 3]);
    // Half a tolerance off in all that it cuts, in pieces and with the arc by its centre.
    let new = program(&jobs(&[3, 1, 2]))
        .replace("Z-1. F200.\nX50.", "Z-1.0005 F200.\nX20.0004\nX50.0005")
        .replace("R10.", "J10.");
    let found = by_tools(&program(&old), &new);
    expect!["section-moved T3@3 lines 26-36 T3@1 lines 6-16"].assert_eq(&told(&found));
}

#[test]
fn operations_cut_a_program_without_tool_changes() {
    let operation = |name: &str, x: u32| format!("({name})\nG0 X{x}. Y0.\nG1 Z-1. F100.\nY20.\nG0 Z5.\n");
    let program = |operations: &[(&str, u32)]| {
        let operations: String = operations.iter().map(|(name, x)| operation(name, *x)).collect();
        format!("G21 G90 G54\nT1 M6\nG0 X0. Y0. Z5.\n{operations}M30\n")
    };
    let marks = |text: &str| {
        let lines = (1..).zip(text.lines()).filter(|(_, line)| line.starts_with('('));
        Outline::of_operations(Marks::new(
            "program",
            lines.map(|(line, name)| (line + 1, name.trim_matches(['(', ')']).to_owned())),
        ))
    };
    let old = program(&[("ROUGH", 10), ("FINISH", 20), ("CHAMFER", 30)]);
    for (operations, expected) in [
        (
            &[("ROUGH", 10), ("ENGRAVE", 50), ("FINISH", 20), ("CHAMFER", 30)][..],
            expect!["section-added - (ENGRAVE)@2 lines 10-13"],
        ),
        (
            &[("FINISH", 20), ("ROUGH", 10), ("CHAMFER", 30)],
            expect!["section-moved (FINISH)@2 lines 10-13 (FINISH)@1 lines 5-8"],
        ),
        (
            &[("ROUGH", 10), ("FINISH", 22), ("CHAMFER", 30)],
            expect!["path in (FINISH)@2 lines 10-13 (FINISH)@2 lines 10-13 again 15:15"],
        ),
    ] {
        let new = program(operations);
        expected.assert_eq(&told(&differences(&old, &new, [marks(&old), marks(&new)])));
    }
}

#[test]
fn more_changes_of_the_order_than_passes_are_told_and_not_compared() {
    let tools: Vec<u32> = (1..=40).collect();
    let reversed: Vec<u32> = tools.iter().rev().copied().collect();
    let found = by_tools(&program(&jobs(&tools)), &program(&jobs(&reversed)));
    let moved =
        |is_compared| found.sections().iter().filter(|of| of.change == Change::Moved { is_compared }).count();
    assert_eq!((count(&found), moved(true), moved(false)), (39, 31, 8));
}

#[test]
fn a_digest_names_what_is_in_added_and_removed_sections() {
    let old = program(&jobs(&[1, 2, 3]));
    let with = |depth| {
        let mut new = jobs(&[1, 2, 9, 3]);
        new[2].depth = depth;
        by_tools(&old, &program(&new)).digest()
    };
    assert_eq!(with(1), with(1));
    assert_ne!(with(1), with(2));
    assert_ne!(with(1), by_tools(&old, &program(&jobs(&[1, 9, 2, 3]))).digest());
}

/// The longest sequence that rises.
fn longest_rising(numbers: &[u32]) -> usize {
    let mut best: Vec<usize> = Vec::new();
    for (index, number) in numbers.iter().enumerate() {
        let before = numbers.iter().take(index).zip(&best).filter(|(other, _)| *other < number);
        let before = before.map(|(_, best)| *best);
        let longest = before.max().unwrap_or(0) + 1;
        best.push(longest);
    }
    best.into_iter().max().unwrap_or(0)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever is shuffled, added and removed: each edit is told once, and nothing else is.
    #[test]
    fn as_many_differences_as_edits(
        order in Just((1..=7_u32).collect::<Vec<u32>>()).prop_shuffle(),
        is_shuffled in any::<bool>(),
        removed in proptest::collection::btree_set(1..=7_u32, 0..4),
        added in proptest::collection::vec(0..8_usize, 0..4),
    ) {
        let old: Vec<u32> = (1..=7).collect();
        let order = if is_shuffled { order } else { old.clone() };
        let left: Vec<u32> = order.into_iter().filter(|tool| !removed.contains(tool)).collect();
        let moved = left.len() - longest_rising(&left);
        let mut new = left;
        for (tool, at) in (20..).zip(&added) {
            new.insert((*at).min(new.len()), tool);
        }
        let found = by_tools(&program(&jobs(&old)), &program(&jobs(&new)));
        let counts = [Change::Removed, Change::Added, Change::Moved { is_compared: true }]
            .map(|change| found.sections().iter().filter(|of| of.change == change).count());
        prop_assert_eq!(counts, [removed.len(), added.len(), moved], "{:?}\n{}", new, told(&found));
        prop_assert_eq!(count(&found), counts.iter().sum::<usize>() as u64, "{:?}\n{}", new, told(&found));
    }

    /// Sections that change while others are added and removed are told once each.
    #[test]
    fn changed_sections_are_told_beside_added_and_removed_ones(
        removed in proptest::collection::btree_set(1..=7_u32, 0..3),
        deeper in proptest::collection::btree_set(1..=7_u32, 0..4),
        added in proptest::collection::vec(0..8_usize, 0..3),
    ) {
        let old = jobs(&(1..=7).collect::<Vec<u32>>());
        let mut new: Vec<Job> = old.iter().copied().filter(|job| !removed.contains(&job.tool)).collect();
        for job in new.iter_mut().filter(|job| deeper.contains(&job.tool)) {
            job.depth = 3;
        }
        let changed = new.iter().filter(|job| job.depth == 3).count();
        for (tool, at) in (20..).zip(&added) {
            new.insert((*at).min(new.len()), Job::new(tool));
        }
        let found = by_tools(&program(&old), &program(&new));
        prop_assert_eq!(found.partings_count(), changed as u64, "{:?}\n{}", new, told(&found));
        prop_assert_eq!(count(&found), (changed + removed.len() + added.len()) as u64, "{:?}\n{}", new, told(&found));
    }
}
