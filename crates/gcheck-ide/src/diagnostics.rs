//! Findings as editors publish them.
//!
//! Knows: how much of a finding an editor shows, how many findings it takes. Must not know: how rules find them.

use std::ops::Range;
use std::sync::Arc;

use gcheck_db::Analysis;
use gcheck_diagnostics::{Finding, Severity, Told, fold_repeats};

/// Most diagnostics of a document; the rest are counted.
pub const MAX_DIAGNOSTICS: usize = 1_000;

/// The rule whose findings lie on text that can never run.
const UNREACHABLE: &str = "unreachable-block";

/// The diagnostics of a document.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Diagnostics {
    /// In text order, at most [`MAX_DIAGNOSTICS`]: of more, the gravest.
    pub list: Vec<Diagnostic>,
    /// What is not listed, by rule, the most frequent first.
    pub omitted: Vec<Omitted>,
}

/// One finding for an editor.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// The rule's id.
    pub rule: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// Bytes of the file.
    pub range: Range<u32>,
    /// The title, and after it what this spot contributes, notes and help, one a line.
    pub message: String,
    /// Other places involved.
    pub related: Vec<Related>,
    /// Address of the rule's page.
    pub docs: String,
    /// The text can never run, so editors fade it.
    pub unnecessary: bool,
    /// The finding has a fix.
    pub fixable: bool,
    /// It is in the place of this many repeats of its rule.
    pub repeats: Option<Repeats>,
}

/// Findings of one rule and severity that are told as one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Repeats {
    /// How many.
    pub count: usize,
    /// Where the last of them begins, in bytes of the file; the first is at the diagnostic itself.
    pub last: u32,
}

/// Are repeats of a rule shown one by one, or as one?
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShownRepeats {
    /// All of them, one by one.
    All,
    /// The first few ([`gcheck_diagnostics::SHOWN_OF_A_RULE`]), and one more that counts the others. Text that can never run is
    /// always shown, because editors fade it.
    Folded,
}

/// Another place involved in a finding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Related {
    /// Name of the file, if it is another one.
    pub file: Option<Arc<str>>,
    /// Bytes of that file.
    pub range: Range<u32>,
    /// What this place contributes.
    pub message: String,
}

/// Findings of one rule that are not listed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Omitted {
    /// The rule's id.
    pub rule: &'static str,
    /// How bad they are.
    pub severity: Severity,
    /// How many.
    pub count: usize,
}

/// What is published of an analysis.
pub fn diagnostics(analysis: &Analysis, shown: ShownRepeats) -> Diagnostics {
    let findings = analysis.findings.iter();
    let mut told = match shown {
        ShownRepeats::All => findings.map(Told::One).collect(),
        ShownRepeats::Folded => fold_repeats(&analysis.findings, |finding| finding.rule.id == UNREACHABLE),
    };
    let mut omitted: Vec<Omitted> = analysis
        .omitted
        .iter()
        .map(|(rule, severity, count)| Omitted { rule: rule.id, severity: *severity, count: *count })
        .collect();
    if told.len() > MAX_DIAGNOSTICS {
        // Stable: of one severity the first in the text stay.
        told.sort_by_key(|told| std::cmp::Reverse(told.first().map(|finding| finding.severity)));
        for told in told.split_off(MAX_DIAGNOSTICS) {
            let (Some(finding), count) = (told.first(), told.count()) else { continue };
            let same = |o: &&mut Omitted| o.rule == finding.rule.id && o.severity == finding.severity;
            match omitted.iter_mut().find(same) {
                Some(known) => known.count += count,
                None => {
                    let (rule, severity) = (finding.rule.id, finding.severity);
                    omitted.push(Omitted { rule, severity, count });
                }
            }
        }
        told.sort_by_key(|told| told.first().map(|finding| (finding.range.start, finding.range.end)));
    }
    omitted.sort_by_key(|o| (std::cmp::Reverse(o.count), o.rule));
    let list = told.into_iter().filter_map(|told| {
        let first = told.first()?;
        // One repeat takes no more room than the line that would count it.
        Some(match told {
            Told::Repeats(all) if all.len() > 1 => {
                let last = all.iter().map(|finding| finding.range.start).max().unwrap_or_default();
                of_repeats(first, Repeats { count: all.len(), last })
            }
            Told::One(_) | Told::Repeats(_) => diagnostic(first),
        })
    });
    Diagnostics { list: list.collect(), omitted }
}

/// The first of several repeats, in the place of all of them. What it says of its own spot is left out; how many they are is
/// for those who know lines.
fn of_repeats(finding: &Finding, repeats: Repeats) -> Diagnostic {
    Diagnostic {
        message: finding.rule.summary.to_owned(),
        related: Vec::new(),
        repeats: Some(repeats),
        ..diagnostic(finding)
    }
}

fn diagnostic(finding: &Finding) -> Diagnostic {
    Diagnostic {
        rule: finding.rule.id,
        severity: finding.severity,
        range: finding.range.clone(),
        message: message(finding),
        related: finding
            .labels
            .iter()
            .map(|label| Related {
                file: label.file.clone(),
                range: label.range.clone(),
                message: label.message.clone(),
            })
            .collect(),
        docs: finding.rule.page(),
        unnecessary: finding.rule.id == UNREACHABLE,
        fixable: !finding.fixes.is_empty(),
        repeats: None,
    }
}

fn message(finding: &Finding) -> String {
    let mut message = finding.message.clone();
    let mut line = |text: &str| {
        message.push('\n');
        message.push_str(text);
    };
    if !finding.label.is_empty() {
        line(&finding.label);
    }
    for remark in remarks(finding) {
        line(&remark);
    }
    message
}

/// The notes of a finding, below its places.
pub(crate) fn remarks(finding: &Finding) -> Vec<String> {
    let notes = finding.notes.iter().map(|note| format!("note: {note}"));
    let alarm = finding.alarm_note().map(|alarm| format!("note: {alarm}"));
    let assumptions = finding.assumptions.iter().map(|fact| format!("note: assuming {fact}"));
    let help = finding.help.iter().map(|help| format!("help: {help}"));
    notes.chain(alarm).chain(assumptions).chain(help).collect()
}

/// Bytes that no path comes to, as findings say it, in text order.
pub fn unreachable_ranges(analysis: &Analysis) -> Vec<Range<u32>> {
    let found = analysis.findings.iter().filter(|finding| finding.rule.id == UNREACHABLE);
    found.map(|finding| finding.range.clone()).collect()
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use expect_test::{Expect, expect};

    use gcheck_diagnostics::SHOWN_OF_A_RULE;

    use super::{MAX_DIAGNOSTICS, ShownRepeats, diagnostics, unreachable_ranges};
    use crate::fixture::{Fixture, shown};

    fn check(control: &str, text: &str, expected: &Expect) {
        let mut fixture = Fixture::new(control, text);
        let analysis = fixture.analysis();
        let snapshot = fixture.snapshot();
        let mut lines = String::new();
        for found in diagnostics(&analysis, ShownRepeats::Folded).list {
            let faded = if found.unnecessary { " (faded)" } else { "" };
            let _ = writeln!(
                lines,
                "{}[{}]{faded} {}",
                found.severity,
                found.rule,
                shown(&snapshot, &found.range)
            );
            let _ = writeln!(lines, "{}", found.message);
            for related in found.related {
                let _ = writeln!(lines, "- {} {}", shown(&snapshot, &related.range), related.message);
            }
        }
        expected.assert_eq(&lines);
    }

    #[test]
    fn places_notes_and_help() {
        check(
            "haas-mill",
            "%\nO1\nG20 G90 G54 G0 X1.\nG1 X2.\nM30\n%\n",
            &expect![[r#"
            error[feed-missing] 4: G1 X2.
            cut without a feed (`F`)
            no feed is in effect here
            note: a cutting move needs a feed; every control of this family stops with an alarm without one
            help: give `F` in this block or before it
        "#]],
        );
    }

    #[test]
    fn what_never_runs_is_faded() {
        let text = "%\nO1\nG20 G90 G54 G0 X1.\nGOTO 10\nX2.\nX3.\nN10 M30\n%\n";
        check(
            "haas-mill",
            text,
            &expect![[r#"
            warning[unreachable-block] (faded) 5: X2.⏎X3.
            no path reaches these 2 blocks
            never executed
            help: remove the blocks, or let a jump or call lead to them
            - 4: GOTO 10 execution goes elsewhere here
        "#]],
        );
        let mut fixture = Fixture::new("haas-mill", text);
        let analysis = fixture.analysis();
        let ranges = unreachable_ranges(&analysis);
        assert_eq!(
            ranges.iter().map(|range| &text[range.start as usize..range.end as usize]).collect::<Vec<_>>(),
            ["X2.\nX3."]
        );
    }

    #[test]
    fn repeats_of_a_rule_are_one_after_the_first_five() {
        let program = |count| format!("%\nO1\nG20 G90 G54\n{}G0 X\nM30\n%\n", "X1. ]\n".repeat(count));
        for (count, listed, hidden) in [(5, 5, None), (6, 6, None), (7, 6, Some(2)), (500, 6, Some(495))] {
            let text = program(count);
            let mut fixture = Fixture::new("haas-mill", &text);
            let analysis = fixture.analysis();
            let published = diagnostics(&analysis, ShownRepeats::Folded);
            let repeated: Vec<_> =
                published.list.iter().filter(|found| found.rule == "stray-bracket").collect();
            assert_eq!(repeated.len(), listed, "{count}");
            let fold = repeated.get(SHOWN_OF_A_RULE).and_then(|found| found.repeats.as_ref());
            assert_eq!(fold.map(|fold| fold.count), hidden, "{count}");
            if let Some(fold) = fold {
                assert_eq!(fold.last as usize, text.rfind(']').unwrap(), "{count}");
            }
            // Another rule's finding after them is not hidden.
            assert!(published.list.iter().any(|found| found.rule == "address-without-value"), "{count}");
            assert!(published.omitted.is_empty(), "{:?}", published.omitted);
            let all = diagnostics(&analysis, ShownRepeats::All);
            assert_eq!(all.list.iter().filter(|found| found.rule == "stray-bracket").count(), count);
        }
    }

    #[test]
    fn text_that_never_runs_stays_faded_however_much_it_is() {
        let blocks: String = (1..=9).fold(String::new(), |mut blocks, n| {
            let _ = writeln!(blocks, "GOTO {n}\nX2.\nN{n} X3.");
            blocks
        });
        let text = format!("%\nO1\nG20 G90 G54 G0 X1.\n{blocks}M30\n%\n");
        let mut fixture = Fixture::new("haas-mill", &text);
        let analysis = fixture.analysis();
        let faded =
            diagnostics(&analysis, ShownRepeats::Folded).list.into_iter().filter(|found| found.unnecessary);
        assert_eq!(faded.count(), 9);
    }

    #[test]
    fn more_than_an_editor_takes_are_counted() {
        let text = format!("%\nO1\nG20 G90 G54\n{}M30\n%\n", "X1. ]\n".repeat(MAX_DIAGNOSTICS + 20));
        let mut fixture = Fixture::new("haas-mill", &text);
        let published = diagnostics(&fixture.analysis(), ShownRepeats::All);
        assert_eq!(published.list.len(), MAX_DIAGNOSTICS);
        assert!(published.list.is_sorted_by_key(|found| found.range.start));
        assert!(published.omitted.iter().map(|o| o.count).sum::<usize>() >= 20, "{:?}", published.omitted);
    }
}
