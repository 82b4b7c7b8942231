//! Every rule keeps the standard: documentation that is true, a name, words, a tier.

use std::collections::BTreeSet;
use std::path::Path;

use gcheck_diagnostics::{Fixability, RuleSet, Tier};
use gcheck_lint::{RuleEntry, Run};

use crate::RULES;
use crate::testing::{World, findings, only, recommended};

/// Collects what is wrong with every rule, so that one run shows all of it.
fn for_each_rule(mut judge: impl FnMut(&RuleEntry, &mut dyn FnMut(String))) {
    let mut wrong = Vec::new();
    for rule in RULES.iter() {
        judge(rule, &mut |what| wrong.push(format!("{}: {what}", rule.meta.id)));
    }
    assert!(wrong.is_empty(), "{} problems:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn every_example_of_the_documentation_is_true() {
    for_each_rule(|rule, say| {
        for example in rule.meta.examples() {
            if !gcheck_controls::names().contains(&example.control.as_str()) {
                say(format!("line {}: no control is called `{}`", example.line, example.control));
                continue;
            }
            // A rule about suppressions needs other rules that are silenced.
            let selection = match rule.run {
                Run::Suppressions { .. } => recommended(),
                _ => only(rule),
            };
            let world = World::of_example(rule.meta, &example);
            let found = findings(&selection, &example.control, &example.code, &world);
            let is_reported = found.iter().any(|f| std::ptr::eq(f.rule, rule.meta));
            if is_reported != example.reported {
                let is = if is_reported { "is reported" } else { "is not reported" };
                say(format!(
                    "line {} of the documentation, `{}`: {is}",
                    example.line,
                    example.code.trim_end()
                ));
            }
        }
    });
}

#[test]
fn every_rule_shows_both_sides() {
    for_each_rule(|rule, say| {
        let docs = rule.meta.docs();
        for heading in ["## Why it matters", "## Reported", "## Not reported"] {
            if !docs.contains(heading) {
                say(format!("has no `{heading}`"));
            }
        }
        for reported in [true, false] {
            if !rule.meta.examples().iter().any(|e| e.reported == reported) {
                say(format!("has no example with reported = {reported}"));
            }
        }
    });
}

#[test]
fn rules_say_whether_they_offer_fixes() {
    for_each_rule(|rule, say| {
        let (mut safe, mut risky) = (false, false);
        for example in rule.meta.examples().iter().filter(|e| e.reported) {
            let selection = match rule.run {
                Run::Suppressions { .. } => recommended(),
                _ => only(rule),
            };
            let world = World::of_example(rule.meta, example);
            let found = findings(&selection, &example.control, &example.code, &world);
            let own = found.iter().filter(|finding| std::ptr::eq(finding.rule, rule.meta));
            for fix in own.flat_map(|finding| &finding.fixes) {
                safe |= fix.safe;
                risky |= !fix.safe;
            }
        }
        let fixability = match (safe, risky) {
            (true, _) => Fixability::Safely,
            (false, true) => Fixability::OnRequest,
            (false, false) => Fixability::Never,
        };
        if rule.meta.fixability != fixability {
            say(format!(
                "says that it fixes {:?}, and its examples show {fixability:?}",
                rule.meta.fixability
            ));
        }
    });
    let count = RULES.iter().filter(|rule| rule.meta.fixability != Fixability::Never).count();
    assert!(count >= 30, "{count} rules offer fixes");
}

#[test]
fn every_rule_is_in_a_set_and_the_strict_set_holds_the_recommended_one() {
    for_each_rule(|rule, say| {
        if rule.meta.sets().is_empty() {
            say("is in no set".to_owned());
        }
        if rule.meta.recommended && !rule.meta.is_in(RuleSet::Strict) {
            say("is recommended and not strict".to_owned());
        }
    });
}

#[test]
fn ids_name_the_defect() {
    let mut seen = BTreeSet::new();
    for_each_rule(|rule, say| {
        let id = rule.meta.id;
        if !id.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-') {
            say("is not kebab-case".to_owned());
        }
        if ["check-", "no-", "avoid-", "bad-"].iter().any(|p| id.starts_with(p)) || id.ends_with("-error") {
            say("does not name a defect".to_owned());
        }
        for name in rule.meta.aliases.iter().chain([&id]) {
            let is_set = RuleSet::ALL.iter().any(|set| set.name() == *name);
            if !seen.insert(*name) || is_set || ["all", "recommended"].contains(name) {
                say(format!("the name `{name}` is taken"));
            }
        }
    });
    let groups: BTreeSet<_> = RULES.iter().map(|r| r.meta.group).collect();
    assert!(groups.iter().all(|g| !seen.contains(g)), "a group has the name of a rule");
}

#[test]
fn files_and_folders_are_named_as_the_rules() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/rules");
    for_each_rule(|rule, say| {
        let file = folder.join(rule.meta.group).join(format!("{}.rs", rule.meta.id.replace('-', "_")));
        if !file.is_file() {
            say(format!("does not stand in `{}`", file.display()));
        }
    });
}

#[test]
fn summaries_are_one_lower_case_line() {
    for_each_rule(|rule, say| {
        let summary = rule.meta.summary;
        let starts_low = summary.starts_with(|c: char| !c.is_uppercase()) || is_name(summary);
        if summary.is_empty()
            || summary.len() > 70
            || summary.ends_with('.')
            || summary.contains('\n')
            || !starts_low
        {
            say(format!("summary is no short lower-case line: `{summary}`"));
        }
        if rule.meta.since.is_empty() {
            say("does not say since when it is".to_owned());
        }
    });
}

/// `O-word`, `DO`: names that are written in capitals.
fn is_name(text: &str) -> bool {
    let word = text.split([' ', '-']).next().unwrap_or_default();
    !word.is_empty() && word.bytes().all(|b| b.is_ascii_uppercase())
}

#[test]
fn messages_keep_the_wording_standard() {
    for_each_rule(|rule, say| {
        for example in rule.meta.examples().iter().filter(|e| e.reported) {
            let selection = only(rule);
            let world = World::of_example(rule.meta, example);
            for finding in findings(&selection, &example.control, &example.code, &world) {
                let message = finding.message.as_str();
                let lower = message.to_lowercase();
                if message.ends_with('.') || message.contains('\n') || message.chars().count() > 90 {
                    say(format!("message is not one short line: `{message}`"));
                }
                if message.starts_with(char::is_uppercase) && !is_name(message) {
                    say(format!("message does not begin in lower case: `{message}`"));
                }
                let banned = ["illegal", "bad", "error", "invalid"];
                if lower.split(|c: char| !c.is_alphabetic()).any(|w| banned.contains(&w)) {
                    say(format!("message scolds: `{message}`"));
                }
                if finding.severity > rule.meta.severity {
                    say(format!("`{message}` is more severe than the rule says"));
                }
                let end = example.code.len() as u32;
                if finding.range.start > finding.range.end || finding.range.end > end {
                    say(format!("`{message}` stands outside the text"));
                }
            }
        }
    });
}

#[test]
fn the_tier_is_that_of_the_way_it_runs() {
    for_each_rule(|rule, say| {
        let tier = match rule.run {
            Run::Token { .. } => Tier::Token,
            Run::Block { .. } | Run::BlockAndValues { .. } => Tier::Block,
            Run::Program { .. } | Run::Suppressions { .. } => Tier::Program,
            Run::Path { .. } => Tier::Path,
        };
        // Suppressions are read with the tokens and judged with the file.
        if rule.meta.tier != tier && !matches!(rule.run, Run::Suppressions { .. }) {
            say(format!("says {:?} and runs as {tier:?}", rule.meta.tier));
        }
    });
}

#[test]
fn alarms_of_the_controls_name_rules() {
    let mut wrong = Vec::new();
    for name in gcheck_controls::names() {
        let control = gcheck_controls::load(name).unwrap();
        let unknown = control.rules_with_alarms().filter(|rule| RULES.by_id(rule).is_none());
        wrong.extend(unknown.map(|rule| format!("{name}: {rule}")));
    }
    assert!(wrong.is_empty(), "alarms of rules that do not exist: {wrong:?}");
}
