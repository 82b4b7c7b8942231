//! `docs/rules/`: a page for each rule and an index, from the documentation that stands in the rule's file.
//!
//! Knows: the shape of the pages. Must not know: any rule.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use gcheck_rules::{RuleMeta, all};

use super::{Generated, markdown, registry};

const FOLDER: &str = "docs/rules";

/// All pages.
pub(super) fn generate() -> Generated {
    let rules: Vec<&RuleMeta> = all().iter().map(|rule| rule.meta).collect();
    let mut files = vec![(Path::new(FOLDER).join("README.md"), index(&rules))];
    files.extend(rules.iter().map(|rule| (path(rule), page(rule))));
    files
}

fn path(rule: &RuleMeta) -> PathBuf {
    Path::new(FOLDER).join(format!("{}.md", rule.id))
}

fn page(rule: &RuleMeta) -> String {
    let source = format!("{}/{}/{}.rs", registry::RULES, rule.group, rule.id.replace('-', "_"));
    let mut text = markdown::header(&source);
    let _ = writeln!(text, "# {}\n\n{}.\n", rule.id, capital(rule.summary));
    let row = vec![
        rule.severity.name().to_owned(),
        yes_no(rule.recommended),
        rule.group.to_owned(),
        rule.tier.name().to_owned(),
        rule.since.to_owned(),
    ];
    text.push_str(&markdown::table(&["severity", "on by default", "group", "sees", "since"], &[row]));
    if !rule.aliases.is_empty() {
        let _ = writeln!(text, "\nFormer names, still accepted: {}.", markdown::codes(rule.aliases));
    }
    text.push('\n');
    text.push_str(&with_plain_fences(&rule.docs()));
    text
}

/// Examples of documentation say in their fence for which control they hold; on a page this is a line of text.
fn with_plain_fences(docs: &str) -> String {
    let mut text = String::with_capacity(docs.len());
    for line in docs.trim().lines() {
        let example = line.strip_prefix("```nc,").and_then(|info| info.split_once(','));
        match example {
            Some((_, control)) => {
                let _ = write!(text, "On `{control}`:\n\n```nc\n");
            }
            None => {
                text.push_str(line.trim_end());
                text.push('\n');
            }
        }
    }
    text
}

fn index(rules: &[&RuleMeta]) -> String {
    let mut text = markdown::header(&format!("the rules under {}", registry::RULES));
    let default = rules.iter().filter(|rule| rule.recommended).count();
    let _ = writeln!(text, "# Rules\n\n{} rules, {default} of them on by default (the set `recommended`).", rules.len());
    text.push_str("`error` means that the control alarms or the move is certainly wrong, `warning` a likely crash, scrap or trap, ");
    text.push_str("`info` worth knowing, `hint` style.\nWhat rests on facts that are only assumed is never more than a warning.\n");
    let mut groups: Vec<&str> = rules.iter().map(|rule| rule.group).collect();
    groups.dedup();
    for group in groups {
        let _ = write!(text, "\n## {group}\n\n");
        let rows: Vec<Vec<String>> = rules
            .iter()
            .filter(|rule| rule.group == group)
            .map(|rule| {
                let link = format!("[{id}]({id}.md)", id = rule.id);
                vec![link, rule.severity.name().to_owned(), yes_no(rule.recommended), rule.summary.to_owned()]
            })
            .collect();
        text.push_str(&markdown::table(&["rule", "severity", "default", "reports"], &rows));
    }
    text
}

fn yes_no(yes: bool) -> String {
    if yes { "yes" } else { "no" }.to_owned()
}

fn capital(sentence: &str) -> String {
    let mut letters = sentence.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::with_plain_fences;

    #[test]
    fn fences_say_the_control_in_words() {
        let docs = "Meaning.\n\n```nc,reported,a-mill\nG4\n```\n```text\nplain\n```\n";
        assert_eq!(with_plain_fences(docs), "Meaning.\n\nOn `a-mill`:\n\n```nc\nG4\n```\n```text\nplain\n```\n");
    }
}
