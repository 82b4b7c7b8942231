//! The knowledge base judged by the rules: every code's example is a block that its own control takes.

use gcheck_controls::Control;
use gcheck_diagnostics::{Severity, Tier};
use gcheck_lint::{ControlBasis, Environment, Execution, Job, MachineFacts, NoPrograms, Selection, check};
use gcheck_program::Dialect;
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;

/// Rules that look at one block. Programs and labels that an example names do not exist, so rules about whole programs
/// have nothing to say here.
fn rules_about_blocks() -> Selection {
    let mut selection = Selection::none(RULES);
    for rule in
        RULES.iter().filter(|r| r.meta.recommended && matches!(r.meta.tier, Tier::Token | Tier::Block))
    {
        let known = selection.enable(rule.meta.id);
        assert!(known.is_ok(), "a rule is known by its id");
    }
    selection
}

/// Findings on a program, as lines.
fn findings(control: &Control, selection: &Selection, program: &str) -> Vec<String> {
    let dialect = Dialect::new(control);
    let machine = MachineFacts::default();
    let environment = Environment {
        dialect: &dialect,
        machine: &machine,
        programs: &NoPrograms,
        control_basis: ControlBasis::Chosen,
        unsupported: None,
    };
    let source = SourceText::from(program);
    let outcome = check(&Job {
        source: &source,
        environment,
        selection,
        suppressions: false,
        execution: Execution::default(),
    });
    let at_least_info = outcome.findings.iter().filter(|f| f.severity >= Severity::Info);
    at_least_info.map(|f| format!("{}[{}] {}", f.severity, f.rule.id, f.message)).collect()
}

#[test]
fn examples_of_codes_give_no_finding() {
    let selection = rules_about_blocks();
    let mut wrong = Vec::new();
    for name in gcheck_controls::names() {
        let control = gcheck_controls::load(name).unwrap();
        for code in control.codes() {
            let entry = code.entry();
            // What such a code does is not defined: no use of it is right.
            if entry.undefined {
                continue;
            }
            let mut program = entry.setup.join("\n");
            program.push('\n');
            program.push_str(&entry.example);
            program.push('\n');
            let found = findings(&control, &selection, &program);
            wrong.extend(
                found.iter().map(|f| {
                    format!("{name} {}: `{}`: {f}", entry.code, program.trim().replace('\n', " | "))
                }),
            );
        }
    }
    assert!(wrong.is_empty(), "{} findings:\n{}", wrong.len(), wrong.join("\n"));
}
