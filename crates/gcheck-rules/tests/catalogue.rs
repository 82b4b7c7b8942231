//! The catalogue of checks (`docs/dev/catalogue.md`) names rules that exist, and has a rule or a reason on every line.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::collections::BTreeSet;
use std::path::Path;

use gcheck_diagnostics::RuleSet;
use gcheck_rules::RULES;

/// Marks of sets after a rule: it is not on by default.
const MARKS: [(char, RuleSet); 3] =
    [('ˢ', RuleSet::Strict), ('ʳ', RuleSet::RestartSafe), ('ʰ', RuleSet::HouseStyle)];

/// The lines of the tables: number, what is to be checked, what covers it, what is left out.
fn lines() -> Vec<(u32, Vec<String>)> {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/dev/catalogue.md");
    let text = std::fs::read_to_string(page).unwrap();
    let rows = text.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix('|'));
    rows.filter_map(|row| {
        let mut cells = row.split(" |").map(|cell| cell.trim().trim_start_matches('|').trim().to_owned());
        let number = cells.next()?.parse().ok()?;
        Some((number, cells.collect()))
    })
    .collect()
}

#[test]
fn every_line_of_the_catalogue_has_a_rule_or_a_reason() {
    let lines = lines();
    let numbers: BTreeSet<u32> = lines.iter().map(|(number, _)| *number).collect();
    assert_eq!(numbers, (1..=95).collect(), "each line once");
    assert_eq!(lines.len(), 95, "no line twice");
    let mut wrong = Vec::new();
    for (number, cells) in &lines {
        let [_, covered, left_out, ..] = cells.as_slice() else {
            wrong.push(format!("{number}: {cells:?}"));
            continue;
        };
        if !covered.contains('`') && (covered != "none" || left_out.is_empty()) {
            wrong.push(format!("{number}: neither a rule nor a reason"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn rules_of_the_catalogue_exist_and_stand_in_the_sets_that_it_says() {
    let mut wrong = Vec::new();
    for (number, cells) in lines() {
        let covered = cells.get(1).map(String::as_str).unwrap_or_default();
        let mut pieces = covered.split('`');
        // Text, rule, text, rule, …
        while let (Some(_), Some(id)) = (pieces.next(), pieces.clone().next()) {
            pieces.next();
            let Some(rule) = RULES.by_id(id) else {
                wrong.push(format!("{number}: no rule is called `{id}`"));
                continue;
            };
            let mark = pieces.clone().next().and_then(|text| text.chars().next());
            let set = MARKS.iter().find(|(sign, _)| Some(*sign) == mark).map(|(_, set)| *set);
            let is_right = match set {
                Some(set) => !rule.meta.recommended && rule.meta.is_in(set),
                None => rule.meta.recommended,
            };
            if !is_right {
                wrong.push(format!("{number}: `{id}` is in {:?}", rule.meta.sets()));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
