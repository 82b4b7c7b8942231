//! Law 6 for fixes: all come to an end, and a safe one leaves what a run does as it is.
//!
//! Knows: kinds of fixes. Must not know: any rule.

use gcheck_diagnostics::FixKinds;
use gcheck_lint::fix_all;
use gcheck_program::Dialect;
use gcheck_syntax::SourceText;

use super::moves::Moves;
use crate::choices::Choices;
use crate::programs;

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let kinds = if choices.below(2) == 0 { FixKinds::Safe } else { FixKinds::All };
    let case = programs::case(choices.rest());
    let dialect = Dialect::new(case.control);
    let before = SourceText::from(case.text.as_str());
    let fixed = fix_all(before.clone(), kinds, |source| super::checked(source, &dialect));
    super::assert_places(&fixed.outcome, fixed.source.text());
    let left = fixed
        .outcome
        .findings
        .iter()
        .find(|finding| finding.fixes.iter().any(|fix| kinds.include(fix) && !fix.edits.is_empty()));
    assert!(
        left.is_none() || fixed.count == 0,
        "fixes never end: {:?}\n{}",
        left.map(|finding| finding.rule.id),
        fixed.source.text()
    );
    if fixed.count == 0 || kinds == FixKinds::All {
        return;
    }
    let (old, new) = (Moves::of(before.text(), &dialect), Moves::of(fixed.source.text(), &dialect));
    if old.ended() {
        assert_eq!(
            old.events,
            new.events,
            "a safe fix leaves the moves\n{}\n---\n{}",
            before.text(),
            fixed.source.text()
        );
    } else {
        // Fixed, the program may go on where it stopped before.
        let kept = old.events.iter().zip(&new.events).take_while(|(one, other)| one == other).count();
        assert!(
            old.events.len().saturating_sub(kept) <= 2,
            "a safe fix leaves the moves\n{}\n---\n{}",
            before.text(),
            fixed.source.text()
        );
    }
}
