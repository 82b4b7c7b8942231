//! Applying fixes to a program's bytes, again and again until no fix is left.
//!
//! Knows: which fixes can be applied together. Must not know: rules, files on disk.

use std::collections::BTreeMap;
use std::ops::Range;

use gcheck_diagnostics::{Finding, Fix, FixKinds};
use gcheck_syntax::SourceText;

use crate::Outcome;

/// Rounds of fixing. A fix that makes another possible needs one more each; fixes that undo each other never end.
const MAX_ROUNDS: usize = 40;

/// A program after its fixes.
#[derive(Debug)]
pub struct Fixed {
    /// The program; unchanged if there was nothing to fix.
    pub source: SourceText,
    /// What a check of it finds.
    pub outcome: Outcome,
    /// Findings that were fixed.
    pub count: usize,
}

/// Checks a program, applies its fixes and checks the result, until no fix is left.
pub fn fix_all(source: SourceText, kinds: FixKinds, check: impl Fn(&SourceText) -> Outcome) -> Fixed {
    let outcome = check(&source);
    let mut fixed = Fixed { source, outcome, count: 0 };
    for _ in 0..MAX_ROUNDS {
        let Some((bytes, count)) = apply_fixes(&fixed.source, &fixed.outcome.findings, kinds) else { break };
        // Fixes that make a program longer than any file may be are not applied.
        let Ok(source) = SourceText::from_bytes(bytes) else { break };
        let outcome = check(&source);
        fixed = Fixed { source, outcome, count: fixed.count + count };
    }
    fixed
}

/// Applies one fix of each finding that has one of these kinds; gives the bytes and how many findings were fixed. `None` when
/// there is nothing to apply.
///
/// A fix is applied whole or not at all. One that overlaps or touches another waits: it may no longer be right after the
/// other, so the result is checked and fixed again.
fn apply_fixes(source: &SourceText, findings: &[Finding], kinds: FixKinds) -> Option<(Vec<u8>, usize)> {
    let mut edits: Vec<(Range<usize>, Vec<u8>)> = Vec::new();
    // Ends of the edits by their starts. Those of two fixes never touch, so it is enough to look at the nearest one
    // before.
    let mut taken: BTreeMap<usize, usize> = BTreeMap::new();
    let mut count = 0;
    for finding in findings {
        let Some(fix) = finding.fixes.iter().find(|fix| kinds.include(fix)) else { continue };
        let Some(bytes) = in_bytes(source, fix) else { continue };
        let touches = |(range, _): &(Range<usize>, Vec<u8>)| {
            taken.range(..=range.end).next_back().is_some_and(|(_, end)| range.start <= *end)
        };
        if bytes.is_empty() || bytes.iter().any(touches) {
            continue;
        }
        for (range, _) in &bytes {
            let end = taken.entry(range.start).or_insert(range.end);
            *end = range.end.max(*end);
        }
        edits.extend(bytes);
        count += 1;
    }
    if edits.is_empty() {
        return None;
    }
    edits.sort_by_key(|(range, _)| range.start);
    let before = source.to_bytes();
    let mut bytes = Vec::with_capacity(before.len() + edits.len() * 4);
    let mut at = 0;
    for (range, text) in edits {
        bytes.extend_from_slice(before.get(at..range.start)?);
        bytes.extend_from_slice(&text);
        at = range.end;
    }
    bytes.extend_from_slice(before.get(at..)?);
    (bytes != before).then_some((bytes, count))
}

/// The edits of a fix with the bytes that they write; `None` when the fix does not fit the text.
fn in_bytes(source: &SourceText, fix: &Fix) -> Option<Vec<(Range<usize>, Vec<u8>)>> {
    fix.edits
        .iter()
        .map(|edit| {
            let range = edit.range.start as usize..edit.range.end as usize;
            source.text().get(range.clone())?;
            let bytes = with_own_bytes(source, &edit.range, &edit.text)?;
            Some((range, bytes))
        })
        .collect()
}

/// A new text as bytes. Where the fix copies from the program, bytes that are not UTF-8 are stand-in characters, and become
/// these bytes again. Other characters outside ASCII cannot be written: the encoding of the file is not known.
fn with_own_bytes(source: &SourceText, range: &Range<u32>, text: &str) -> Option<Vec<u8>> {
    if source.replaced().is_empty() || text.is_ascii() && !text.contains(SourceText::STAND_IN) {
        return Some(text.as_bytes().to_vec());
    }
    let mut own = source.replaced().iter().filter(|(at, _)| range.contains(at)).map(|(_, byte)| *byte);
    let bytes = text.chars().map(|c| match c {
        SourceText::STAND_IN => own.next(),
        c => c.is_ascii().then_some(c as u8),
    });
    let bytes: Option<Vec<u8>> = bytes.collect();
    bytes.filter(|_| own.next().is_none())
}

#[cfg(test)]
mod tests {
    use super::*;
    use gcheck_diagnostics::{Edit, Fixability, RuleMeta, Severity, Tier};

    static RULE: RuleMeta = RuleMeta {
        id: "made-up",
        group: "words",
        summary: "",
        severity: Severity::Error,
        tier: Tier::Block,
        recommended: true,
        other_sets: &[],
        control_specific: false,
        fixability: Fixability::Never,
        since: "0.1.0",
        aliases: &[],
        raw_docs: "",
    };

    fn finding(fix: Fix) -> Finding {
        Finding::new(&RULE, 0..0, "m").fix(fix)
    }

    fn applied(text: &[u8], fixes: Vec<Fix>, kinds: FixKinds) -> Option<(String, usize)> {
        let source = SourceText::from_bytes(text.to_vec()).unwrap();
        let findings: Vec<Finding> = fixes.into_iter().map(finding).collect();
        apply_fixes(&source, &findings, kinds)
            .map(|(bytes, count)| (bytes.iter().map(|byte| *byte as char).collect(), count))
    }

    #[test]
    fn fixes_apart_are_applied_together() {
        let fixes = vec![Fix::safe("", 6..6, "."), Fix::safe("", 1..2, "01")];
        assert_eq!(applied(b"G1 X10\n", fixes, FixKinds::Safe), Some(("G01 X10.\n".to_owned(), 2)));
    }

    #[test]
    fn of_fixes_that_touch_one_is_applied() {
        let fixes = vec![Fix::safe("", 0..2, "G01"), Fix::safe("", 2..3, ""), Fix::safe("", 1..2, "02")];
        assert_eq!(applied(b"G1 X1.", fixes, FixKinds::Safe), Some(("G01 X1.".to_owned(), 1)));
    }

    #[test]
    fn a_fix_is_applied_whole_or_not_at_all() {
        let two = Fix {
            title: String::new(),
            safe: true,
            edits: vec![
                Edit { range: 3..4, text: "Y".to_owned() },
                Edit { range: 0..2, text: "G2".to_owned() },
            ],
        };
        let fixes = vec![Fix::safe("", 0..2, "G01"), two];
        assert_eq!(applied(b"G1 X1.", fixes, FixKinds::Safe), Some(("G01 X1.".to_owned(), 1)));
    }

    #[test]
    fn what_may_change_moves_is_applied_on_request_only() {
        let fixes = || vec![Fix::risky("", 1..2, "2")];
        assert_eq!(applied(b"G1 X1.", fixes(), FixKinds::Safe), None);
        assert_eq!(applied(b"G1 X1.", fixes(), FixKinds::All), Some(("G2 X1.".to_owned(), 1)));
    }

    #[test]
    fn one_fix_of_a_finding() {
        let source = SourceText::from("G1");
        let both = finding(Fix::risky("", 0..2, "G2")).fix(Fix::safe("", 1..2, "01"));
        let bytes = |kinds| apply_fixes(&source, std::slice::from_ref(&both), kinds).unwrap().0;
        assert_eq!(bytes(FixKinds::Safe), b"G01");
        assert_eq!(bytes(FixKinds::All), b"G2");
    }

    #[test]
    fn bytes_of_other_encodings_stay_what_they_are() {
        // A Latin-1 remark after the end of a block, put into parentheses.
        let fix = |text: &str| vec![Fix::safe("", 3..6, text)];
        let fixed = |text| applied(b"G1;d\xE9p X\xB5\r\n", fix(text), FixKinds::Safe);
        assert_eq!(fixed("(d\x1Ap)").map(|(text, _)| text), Some("G1;(dép) Xµ\r\n".to_owned()));
        assert_eq!(fixed("(dép)"), None, "in which encoding?");
        assert_eq!(fixed("(dp)").map(|(text, _)| text), Some("G1;(dp) Xµ\r\n".to_owned()));
        assert_eq!(fixed("(\x1A\x1A)"), None);
    }

    #[test]
    fn a_fix_that_does_not_fit_or_changes_nothing_is_none() {
        assert_eq!(applied(b"G1", vec![Fix::safe("", 1..9, "")], FixKinds::Safe), None);
        assert_eq!(applied("µ".as_bytes(), vec![Fix::safe("", 1..2, "")], FixKinds::Safe), None);
        assert_eq!(applied(b"G1", vec![Fix::safe("", 0..2, "G1")], FixKinds::Safe), None);
    }
}
