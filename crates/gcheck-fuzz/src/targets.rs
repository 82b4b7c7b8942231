//! The targets, a module each.
//!
//! Knows: which there are, and what several of them ask of a program. Must not know: how programs are made.

pub(crate) mod configuration;
pub(crate) mod editor;
pub(crate) mod edits;
pub(crate) mod fixes;
pub(crate) mod flow;
pub(crate) mod formatting;
pub(crate) mod imports;
pub(crate) mod lowering;
pub(crate) mod messages;
mod moves;
pub(crate) mod running;
pub(crate) mod stored;
pub(crate) mod tokens;
pub(crate) mod tree;

use gcheck_lint::{
    ControlBasis, Environment, Execution, Job, MachineFacts, NoPrograms, Outcome, Selection, check,
};
use gcheck_program::Dialect;
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;

thread_local! {
    static MACHINE: MachineFacts = MachineFacts::default();
    static ALL: Selection = all_rules();
}

/// Work that an analysis may do, in blocks: enough for programs of this size, and little enough for many of them.
const WORK: u64 = 60_000;

fn all_rules() -> Selection {
    let mut selection = Selection::recommended(RULES);
    #[expect(clippy::expect_used, reason = "`all` is a selector of every table")]
    selection.enable("all").expect("every table knows `all`");
    selection
}

/// Checks a program with every rule.
fn checked(source: &SourceText, dialect: &Dialect<'_>) -> Outcome {
    MACHINE.with(|machine| {
        ALL.with(|selection| {
            check(&Job {
                source,
                environment: Environment {
                    dialect,
                    machine,
                    programs: &NoPrograms,
                    control_basis: ControlBasis::Chosen,
                    unsupported: None,
                },
                selection,
                suppressions: true,
                execution: Execution { fuel: WORK, block_skip: None },
            })
        })
    })
}

/// Every place of every finding is in the text.
fn assert_places(outcome: &Outcome, text: &str) {
    for finding in &outcome.findings {
        let own = finding.labels.iter().filter(|label| label.file.is_none()).map(|label| &label.range);
        let edits = finding.fixes.iter().flat_map(|fix| &fix.edits).map(|edit| &edit.range);
        for range in own.chain([&finding.range]).chain(edits) {
            assert!(
                text.get(range.start as usize..range.end as usize).is_some(),
                "{}: {range:?} is not in a text of {} bytes",
                finding.rule.id,
                text.len()
            );
        }
    }
}
