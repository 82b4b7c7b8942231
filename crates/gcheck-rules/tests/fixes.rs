//! What every fix makes of the examples of its rule's documentation.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write as _;

use expect_test::expect_file;
use gcheck_diagnostics::{FixKinds, Fixability};
use gcheck_lint::{
    ControlBasis, Environment, Execution, Job, MachineFacts, NoPrograms, RuleEntry, Selection, check, fix_all,
};
use gcheck_program::Dialect;
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;

/// An example with all fixes of one rule in it.
fn fixed(rule: &RuleEntry, program: &str, control: &str, kinds: FixKinds) -> (String, usize) {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let machine = MachineFacts::default();
    // A rule about suppressions needs other rules that are silenced.
    let is_of_suppressions = rule.meta.group == "suppressions";
    let selection =
        if is_of_suppressions { Selection::recommended(RULES) } else { Selection::only(RULES, rule) };
    let mended = fix_all(SourceText::from(program), kinds, |source| {
        let environment = Environment {
            dialect: &dialect,
            machine: &machine,
            programs: &NoPrograms,
            control_basis: ControlBasis::Chosen,
            unsupported: None,
        };
        let execution = Execution::default();
        let mut outcome =
            check(&Job { source, environment, selection: &selection, suppressions: true, execution });
        outcome.findings.retain(|finding| std::ptr::eq(finding.rule, rule.meta));
        outcome
    });
    (mended.source.text().to_owned(), mended.count)
}

/// Signs that nobody sees, as the documentation writes them.
fn visible(program: &str) -> String {
    let text = program.replace('\r', "␍").replace('\t', "␉").replace(" \n", "␠\n");
    if text.ends_with('\n') { text } else { format!("{text}␃\n") }
}

#[test]
fn every_rule_that_fixes_fixes_its_examples() {
    let mut page = String::new();
    for rule in RULES.iter().filter(|rule| rule.meta.fixability != Fixability::Never) {
        let id = rule.meta.id;
        let kinds = if rule.meta.fixability == Fixability::Safely { FixKinds::Safe } else { FixKinds::All };
        let mut is_fixed = false;
        for example in rule.meta.examples().iter().filter(|example| example.reported) {
            let (after, count) = fixed(rule, &example.code, &example.control, kinds);
            if count == 0 {
                continue;
            }
            is_fixed = true;
            let option = rule.meta.fixability.option();
            let _ = writeln!(page, "## {id} ({option}, {})\n", example.control);
            let _ = writeln!(page, "{}--\n{}", visible(&example.code), visible(&after));
            let (again, count) = fixed(rule, &after, &example.control, kinds);
            assert_eq!((again, count), (after, 0), "{id}: a second run changes something");
        }
        assert!(is_fixed, "{id} fixes no example");
    }
    expect_file!["fixes.txt"].assert_eq(&page);
}
