//! Codes that the user declares mean what the user's machine makes of them: no rule judges their blocks by what the control
//! would do without the declaration.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use gcheck_controls::{CodeNumber, Control, Machine, UserCode};
use gcheck_diagnostics::Finding;
use gcheck_lint::{ControlBasis, Environment, Execution, Job, MachineFacts, Programs, Selection, check};
use gcheck_program::Dialect;
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;

/// A folder with the program 9010 in it, which changes nothing.
struct Folder;

impl Programs for Folder {
    fn has_number(&self, number: u32) -> bool {
        number == 9010
    }

    fn has_name(&self, _: &str) -> bool {
        false
    }

    fn source_of_number(&self, number: u32) -> Option<gcheck_engine::SourceFile> {
        let text = "O9010\n#33=0\nM99\n".to_owned();
        (number == 9010).then(|| gcheck_engine::SourceFile { name: "O9010.nc".into(), text })
    }
}

/// A code of the shop, an alias of a macro, and an alias in the place of a code that the control has.
fn declared(control: &Control) -> Control {
    let code = |number: &str, alias: Option<&str>| UserCode {
        number: CodeNumber::parse(number).unwrap(),
        title: "the shop's own".to_owned(),
        alias: alias.map(str::to_owned),
    };
    let codes = [
        code("M731", None),
        code("G231", Some("O9010")),
        code("G81", Some("O9010")),
        code("M8", None),
        code("G4", None),
    ];
    control.with_user_codes(&codes)
}

fn findings(control: &Control, program: &str) -> Vec<Finding> {
    let dialect = Dialect::new(control);
    let machine = MachineFacts::default();
    let mut selection = Selection::recommended(RULES);
    selection.enable("all").unwrap();
    let environment = Environment {
        dialect: &dialect,
        machine: &machine,
        programs: &Folder,
        control_basis: ControlBasis::Chosen,
        unsupported: None,
    };
    let source = SourceText::from(program);
    let execution = Execution::default();
    check(&Job { source: &source, environment, selection: &selection, suppressions: true, execution })
        .findings
}

/// A program in two parts, between which a block is put.
fn parts(control: &Control) -> (&'static str, &'static str) {
    match control.machine() {
        Machine::Mill => (
            "O1234 (PLATE)\nG17 G21 G40 G49 G80 G90\n(DRILL)\nT1 M6\nG54 G0 X0. Y0.\nS1000 M3\nG43 H1 Z10.\nG1 Z1. F100.\n",
            "X10.\nG0 Z10.\nM30\n",
        ),
        Machine::Lathe => (
            "O1234 (SHAFT)\nG21 G40 G80 G99\n(TURN)\nT0101\nG97 S500 M3\nG0 X20. Z2.\nG1 Z1. F0.2\n",
            "X10.\nG0 Z10.\nM30\n",
        ),
    }
}

/// Blocks that many rules would report, were these codes the control's own or unknown.
const BLOCKS: [&str; 10] = [
    "M731",
    "M731 P1.5 Q-2.",
    "G231 A1. B2. H7 D9 R-5.",
    "G231 X5. Y5. Z-5. K0",
    "G231 I1. J2. I3. J4.",
    "G81 A1. X5. F0",
    "G81",
    "M8 P99",
    "G4",
    "G4 X-1. P0.5",
];

#[test]
fn no_rule_speaks_of_a_declared_code() {
    let mut wrong = Vec::new();
    for name in gcheck_controls::names() {
        let control = gcheck_controls::load(name).unwrap();
        let (before, behind) = parts(&control);
        let control = declared(&control);
        let plain: Vec<String> = told(&findings(&control, &format!("{before}{behind}")));
        for block in BLOCKS {
            let found = findings(&control, &format!("{before}{block}\n{behind}"));
            let line = before.len() as u32..(before.len() + block.len()) as u32;
            let of_block = found.iter().filter(|f| f.range.start < line.end && f.range.end > line.start);
            wrong.extend(of_block.map(|f| format!("{name} `{block}`: [{}] {}", f.rule.id, f.message)));
            let new = told(&found).into_iter().filter(|text| !plain.contains(text));
            wrong.extend(new.map(|text| format!("{name} `{block}` brings: {text}")));
        }
    }
    wrong.dedup();
    assert!(wrong.is_empty(), "{} findings:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn the_same_blocks_are_judged_where_nobody_declares_their_codes() {
    let control = gcheck_controls::load("linuxcnc").unwrap();
    let (before, behind) = parts(&control);
    for block in ["M731", "G231 A1. B2. H7 D9 R-5.", "G81", "G4"] {
        let found = findings(&control, &format!("{before}{block}\n{behind}"));
        let line = before.len() as u32..(before.len() + block.len()) as u32;
        assert!(found.iter().any(|f| line.contains(&f.range.start)), "`{block}`");
    }
}

fn told(findings: &[Finding]) -> Vec<String> {
    findings.iter().map(|finding| format!("[{}] {}", finding.rule.id, finding.message)).collect()
}
