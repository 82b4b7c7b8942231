//! Law 3: after any edits a document has the findings of a fresh check, and what was told ahead of them is among them.
//!
//! Knows: documents and edits. Must not know: rules.

use std::sync::Arc;

use gcheck_db::{Database, Settings};
use gcheck_lint::{Environment, Job, NoPrograms, check};
use gcheck_program::Dialect;
use gcheck_syntax::SourceText;

use super::tree::placed;
use crate::choices::Choices;
use crate::programs;

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let edits: Vec<[u8; 4]> = (0..=choices.below(6))
        .map(|_| [choices.byte(), choices.byte(), choices.byte(), choices.byte()])
        .collect();
    let case = programs::case(choices.rest());
    let mut settings = Settings::new(Arc::new(case.control.clone()), gcheck_rules::RULES);
    settings.selection = Arc::new(super::all_rules());
    settings.execution.fuel = super::WORK;
    let mut database = Database::new();
    let mut text = case.text;
    let id = database.open(&text, settings.clone());
    for (round, edit) in edits.into_iter().enumerate() {
        if round.is_multiple_of(2) {
            let first = database.first_findings(id, text.len() / 2, &|| false).ok().flatten();
            assert_fresh(&mut database, id, &settings, &text, first.map(|first| first.findings.clone()));
        }
        let (range, insert) = placed(&text, edit);
        let edited = database.edit(id, range.start as u32..range.end as u32, insert);
        assert!(edited.is_ok(), "{range:?} is in the text");
        text.replace_range(range, insert);
    }
    assert_fresh(&mut database, id, &settings, &text, None);
}

fn assert_fresh(
    database: &mut Database,
    id: gcheck_db::DocumentId,
    settings: &Settings,
    text: &str,
    first: Option<Vec<gcheck_diagnostics::Finding>>,
) {
    let Ok(known) = database.analysis(id, &|| false) else { panic!("nobody cancelled the analysis") };
    let source = SourceText::from(text);
    let dialect = Dialect::new(&settings.control);
    let fresh = check(&Job {
        source: &source,
        environment: Environment {
            dialect: &dialect,
            machine: &settings.machine,
            programs: &NoPrograms,
            control_basis: settings.control_basis,
            unsupported: settings.unsupported,
        },
        selection: &settings.selection,
        suppressions: settings.suppressions,
        execution: settings.execution,
    });
    super::assert_places(&fresh, text);
    for (own, other) in known.findings.iter().zip(&fresh.findings) {
        assert_eq!(own, other, "edited is fresh");
    }
    assert_eq!(known.findings.len(), fresh.findings.len(), "edited is fresh");
    assert_eq!(
        (known.suppressed, &known.assumptions, known.out_of_fuel),
        (fresh.suppressed, &fresh.assumptions, fresh.out_of_fuel),
        "edited is fresh"
    );
    for finding in first.into_iter().flatten() {
        assert!(known.findings.contains(&finding), "taken back: {finding:#?}");
    }
}
