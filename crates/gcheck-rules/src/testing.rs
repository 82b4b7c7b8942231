//! The check helpers of this crate's tests: one rule on a small program, shown with carets.
//!
//! Knows: how a test states what it expects. Must not know: any rule.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::Range;

use expect_test::Expect;
use gcheck_controls::{LetterSet, UnsupportedDialect, unsupported_dialect};
use gcheck_diagnostics::{DocExample, Finding, RuleMeta, apply};
use gcheck_engine::{Axis, Cutting, Dynamics, Machine, Position, SourceFile, Tool, WorkOffset};
use gcheck_geometry::{Mm, MmPerMin, Rpm, Seconds};
use gcheck_lint::{
    ControlBasis, Environment, Execution, Job, MachineFacts, NoPrograms, Programs, RuleEntry, Selection,
    check,
};
use gcheck_program::Dialect;
use gcheck_syntax::SourceText;

use crate::RULES;

/// What a test says about the world around the program.
pub(crate) struct World<'w> {
    pub(crate) machine: MachineFacts,
    pub(crate) programs: &'w dyn Programs,
    pub(crate) control_is_guessed: bool,
    pub(crate) unsupported: Option<&'static UnsupportedDialect>,
    pub(crate) suppressions: bool,
}

impl Default for World<'_> {
    fn default() -> Self {
        Self {
            machine: MachineFacts::default(),
            programs: &NoPrograms,
            control_is_guessed: false,
            unsupported: None,
            suppressions: true,
        }
    }
}

impl World<'_> {
    /// What the examples of a rule's documentation hold in. Rules of the group `machine` speak only of what is configured:
    /// axes X, Y, Z and A, 8000 turns and 10 m a minute, 500 mm of travel each way, `G54` at the machine's zero, tools 1 to 3,
    /// rotary axes of diameter 0, Haas controls set to inches, 0.01 s for a block and two blocks ahead,
    /// 100 mm/s² on X, Y and Z, 500 rpm a second of the spindle; tool 1 has four teeth that cut 0.02 to 0.06 mm at 60 to 160 m a minute. Those of the group `bar_feeder` have new bars of 1000 mm, and in another file a program
    /// 9099 that ends the job.
    pub(crate) fn of_examples(rule: &RuleMeta) -> Self {
        Self::of_group(rule.group)
    }

    /// What the examples of a group's rules hold in.
    pub(crate) fn of_group(group: &str) -> Self {
        let mut world = Self::default();
        if group == "machine" {
            let tool = |number: u32| Tool {
                pocket: number,
                offset: Position::ZERO,
                diameter: Mm(10.0),
                corner_radius: Mm(0.0),
                angles: [0.0; 2],
                orientation: 0,
            };
            let cutting = || Cutting {
                teeth: Some(4),
                material: None,
                chip_load: Some((0.02, 0.06)),
                surface_speed: Some((60.0, 160.0)),
            };
            world.machine.axes = Some(LetterSet::of("XYZA"));
            let settings = || {
                BTreeMap::from(
                    [("9", "inch"), ("32", "off"), ("34", "0"), ("73", "on")]
                        .map(|(number, value)| (number.to_owned(), value.to_owned())),
                )
            };
            world.machine.settings = settings();
            world.machine.engine = Machine {
                axes: Some(vec![Axis::X, Axis::Y, Axis::Z, Axis::A]),
                settings: settings(),
                max_rpm: Some(Rpm(8000.0)),
                max_feed: Some(MmPerMin(10_000.0)),
                travel: [Axis::X, Axis::Y, Axis::Z].into_iter().map(|axis| (axis, (-500.0, 500.0))).collect(),
                offsets: [(1, WorkOffset::ZERO)].into_iter().collect(),
                tools: (1..=3).map(|number| (number, tool(number))).collect(),
                cutting: [(1, cutting())].into_iter().collect(),
                tool_table_is_complete: true,
                dynamics: Dynamics {
                    block_time: Some(Seconds(0.01)),
                    look_ahead: Some(2),
                    acceleration: [Axis::X, Axis::Y, Axis::Z].into_iter().map(|axis| (axis, 100.0)).collect(),
                    spindle_acceleration: Some(Rpm(500.0)),
                    ..Dynamics::default()
                },
                ..Machine::default()
            };
        }
        if group == "bar_feeder" {
            world.machine.engine.bar.new_bar = Some(Mm(1000.0));
            world.programs = &CUTOFF;
        }
        world
    }

    /// The same as rules see it.
    pub(crate) fn environment<'a>(&'a self, dialect: &'a Dialect<'a>) -> Environment<'a> {
        Environment {
            dialect,
            machine: &self.machine,
            programs: self.programs,
            control_basis: if self.control_is_guessed { ControlBasis::Shown } else { ControlBasis::Chosen },
            unsupported: self.unsupported,
        }
    }

    /// What one example holds in.
    pub(crate) fn of_example(rule: &RuleMeta, example: &DocExample) -> Self {
        let unsupported = example.guessed.then(|| unsupported_dialect(&example.code, None)).flatten();
        Self { control_is_guessed: example.guessed, unsupported, ..Self::of_examples(rule) }
    }
}

/// A file with one program that others call: its number and its text.
pub(crate) struct Called(pub(crate) u32, pub(crate) &'static str);

impl Programs for Called {
    fn has_number(&self, number: u32) -> bool {
        number == self.0
    }

    fn has_name(&self, _: &str) -> bool {
        false
    }

    fn source_of_number(&self, number: u32) -> Option<SourceFile> {
        let source = || SourceFile { name: format!("O{number}.nc").into(), text: self.1.to_owned() };
        (number == self.0).then(source)
    }
}

/// The cutoff program of the examples, in a file of its own.
const CUTOFF: Called = Called(9099, "O9099\nG1 X0. F0.004\nM30\n");

/// One rule alone.
pub(crate) fn only(rule: &RuleEntry) -> Selection {
    Selection::only(RULES, rule)
}

/// The recommended rules.
pub(crate) fn recommended() -> Selection {
    Selection::recommended(RULES)
}

/// Findings of a selection of rules on a program.
pub(crate) fn findings(
    selection: &Selection,
    control: &str,
    program: &str,
    world: &World<'_>,
) -> Vec<Finding> {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let environment = world.environment(&dialect);
    let source = SourceText::from(program);
    check(&Job {
        source: &source,
        environment,
        selection,
        suppressions: world.suppressions,
        execution: Execution::default(),
    })
    .findings
}

/// One rule on a program, with nothing configured.
pub(crate) fn check_rule(rule: &RuleEntry, control: &str, program: &str, expected: &Expect) {
    check_rule_in(rule, control, program, &World::default(), expected);
}

/// One rule on a program in a given world.
pub(crate) fn check_rule_in(
    rule: &RuleEntry,
    control: &str,
    program: &str,
    world: &World<'_>,
    expected: &Expect,
) {
    let found = findings(&only(rule), control, program, world);
    expected.assert_eq(&found.iter().map(|f| picture(program, f)).collect::<String>());
}

/// The line of a finding with carets under its place.
fn picture(program: &str, finding: &Finding) -> String {
    let Range { start, end } = finding.range.start as usize..finding.range.end as usize;
    let line_start = program[..start].rfind(['\n', '\r']).map_or(0, |at| at + 1);
    let line_end = program[start..].find(['\n', '\r']).map_or(program.len(), |at| start + at);
    let number = program[..start].matches('\n').count() + 1;
    let carets = "^".repeat(program[start..end.min(line_end).max(start)].chars().count().max(1));
    let indent = " ".repeat(program[line_start..start].chars().count());
    let margin = " ".repeat(number.to_string().len());
    let mut out = String::new();
    let _ = writeln!(out, "{number} | {}", &program[line_start..line_end]);
    let _ = writeln!(
        out,
        "{margin} | {indent}{carets} {}[{}] {}",
        finding.severity, finding.rule.id, finding.message
    );
    out
}

/// A finding's words that carets do not show: labels, notes, help, assumptions, fixes.
pub(crate) fn words(finding: &Finding) -> String {
    let mut out = format!("{}\n", finding.message);
    if !finding.label.is_empty() {
        let _ = writeln!(out, "  here: {}", finding.label);
    }
    for label in &finding.labels {
        let _ = writeln!(out, "  there: {}", label.message);
    }
    for note in &finding.notes {
        let _ = writeln!(out, "  note: {note}");
    }
    for assumption in &finding.assumptions {
        let _ = writeln!(out, "  assuming: {assumption}");
    }
    if let Some(help) = &finding.help {
        let _ = writeln!(out, "  help: {help}");
    }
    for fix in &finding.fixes {
        let _ = writeln!(out, "  fix ({}): {}", if fix.safe { "safe" } else { "unsafe" }, fix.title);
    }
    out
}

/// The program with a finding's first fix applied.
pub(crate) fn fixed(program: &str, finding: &Finding) -> String {
    let mut edits = finding.fixes.first().map(|fix| fix.edits.clone()).unwrap_or_default();
    edits.sort_by_key(|edit| edit.range.start);
    apply(program, &edits)
}

/// The program with the first fix of a rule's finding applied; of several findings, a program each. Empty without one.
pub(crate) fn fixes_of(rule: &RuleEntry, control: &str, program: &str) -> String {
    let found = findings(&only(rule), control, program, &World::default());
    found.iter().map(|finding| fixed(program, finding)).collect()
}
