//! `docs/rules/`: a page for each rule and an index, from the documentation that is in the rule's file.
//!
//! Knows: the shape of the pages. Must not know: any rule.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use gcheck_diagnostics::{RuleMeta, RuleSet};
use gcheck_lint::RuleEntry;
use gcheck_rules::RULES;

use super::generated::Generated;
use super::{markdown, registry, rendered};

const FOLDER: &str = "docs/rules";

/// All pages.
pub(super) fn generate() -> Generated {
    let rules: Vec<&RuleMeta> = RULES.iter().map(|rule| rule.meta).collect();
    let mut files = vec![(Path::new(FOLDER).join("README.md"), index(&rules))];
    files.extend(RULES.iter().map(|rule| (path(rule.meta), page(rule))));
    files
}

fn path(rule: &RuleMeta) -> PathBuf {
    Path::new(FOLDER).join(format!("{}.md", rule.id))
}

fn page(entry: &RuleEntry) -> String {
    let rule = entry.meta;
    let source = format!("{}/{}/{}.rs", registry::RULES, rule.group, rule.id.replace('-', "_"));
    let mut text = markdown::header(&source);
    let _ = writeln!(text, "# {}\n", rule.id);
    let row = vec![
        rule.severity.name().to_owned(),
        sets(rule),
        fixed_by(rule),
        rule.group.to_owned(),
        rule.tier.name().to_owned(),
        rule.since.to_owned(),
    ];
    text.push_str(&markdown::table(
        &["severity", "in the sets", "fixed by", "group", "sees", "since"],
        &[row],
    ));
    if !rule.aliases.is_empty() {
        let _ = writeln!(text, "\nFormer names, still accepted: {}.", markdown::codes(rule.aliases));
    }
    if rule.control_specific {
        text.push_str(
            "\nAn info at most where the control is only [the fallback](../guide.md#which-control).\n",
        );
    }
    text.push('\n');
    let examples = rule.examples();
    let mut examples = examples.iter();
    let mut remedies: Vec<String> = Vec::new();
    let rendered = || {
        let example = examples.next().filter(|example| example.reported)?;
        let finding = rendered::finding(entry, example)?;
        remedies.extend(finding.remedies);
        Some(finding.text)
    };
    text.push_str(&with_plainsides(&rule.docs(), rendered));
    text.push_str(&fixed(rule, &remedies));
    text.push_str(&switched_off(rule));
    text
}

/// What to do, as the findings of the examples say it; each once.
fn fixed(rule: &RuleMeta, remedies: &[String]) -> String {
    let mut lines: Vec<String> = Vec::new();
    for remedy in remedies {
        let mut letters = remedy.chars();
        let first = letters.next().map(|letter| letter.to_ascii_uppercase());
        let line: String = first.into_iter().chain(letters).collect();
        let line = format!("* {}.", line.trim_end_matches('.'));
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    if lines.is_empty() {
        return String::new();
    }
    let mut text = String::from("\n## How to fix it\n\nThe findings above say:\n\n");
    text.push_str(&lines.join("\n"));
    text.push('\n');
    match rule.fixability.option() {
        "" => {}
        option => {
            let _ = writeln!(text, "\n`{option}` writes the fix into the program.");
        }
    }
    text
}

/// How the rule is silenced, or how it comes to run.
fn switched_off(rule: &RuleMeta) -> String {
    let id = rule.id;
    let mut text = String::from("\n## Switching it off\n\n");
    if !rule.recommended {
        let _ = writeln!(text, "The rule runs only where it is selected: `--extend-select {id}`.");
    }
    let _ = writeln!(
        text,
        "For all programs, in `gcheck.toml`: `ignore = [\"{id}\"]` under `[rules]`; for some of them: \
         `\"old/**\" = [\"{id}\"]` under `[per-file-ignores]`."
    );
    let _ = writeln!(
        text,
        "At one place, in a comment on the line or the line above, with the reason: `(gcheck: ignore {id} - reason)`; \
         in a whole program: `(gcheck: ignore-file {id} - reason)`."
    );
    text
}

/// Examples of documentation say in their fence for which control they hold; on a page this is a line of text. After each
/// example comes what `rendered` gives for it.
fn with_plainsides(docs: &str, mut rendered: impl FnMut() -> Option<String>) -> String {
    let mut lines: Vec<String> = Vec::new();
    let mut inside = false;
    let mut is_example = false;
    // Markdown readers differ on what may touch a heading or a fence; a blank line is right for all.
    let apart = |lines: &mut Vec<String>| {
        if lines.last().is_some_and(|line| !line.is_empty()) {
            lines.push(String::new());
        }
    };
    for line in docs.trim().lines() {
        let line = line.trim_end();
        let fence = line.starts_with("```");
        if !inside && (fence || line.starts_with('#')) {
            apart(&mut lines);
        }
        if let Some((_, control)) = line.strip_prefix("```nc,").and_then(|info| info.split_once(',')) {
            let heading = match control.strip_suffix(",guessed") {
                Some(control) => format!("On `{control}`, when nobody chose it:"),
                None => format!("On `{control}`:"),
            };
            lines.extend([heading, String::new(), "```nc".to_owned()]);
            is_example = true;
        } else if !(line.is_empty() && lines.last().is_some_and(String::is_empty)) || inside {
            lines.push(line.to_owned());
        }
        if fence && inside || line.starts_with('#') && !inside {
            apart(&mut lines);
        }
        if fence
            && inside
            && std::mem::take(&mut is_example)
            && let Some(finding) = rendered()
        {
            lines.push("```text".to_owned());
            lines.extend(finding.lines().map(str::to_owned));
            lines.extend(["```".to_owned(), String::new()]);
        }
        inside ^= fence;
    }
    while lines.last().is_some_and(String::is_empty) {
        lines.pop();
    }
    lines.join("\n") + "\n"
}

fn index(rules: &[&RuleMeta]) -> String {
    let mut text = markdown::header(&format!("the rules under {}", registry::RULES));
    let default = rules.iter().filter(|rule| rule.recommended).count();
    let mending = rules.iter().filter(|rule| !rule.fixability.option().is_empty()).count();
    let _ = writeln!(
        text,
        "# Rules\n\n{} rules, {default} of them on by default (the set `recommended`); {mending} can fix what they find.",
        rules.len()
    );
    text.push_str("`error` means that the control alarms or the move is certainly wrong, `warning` a likely crash, scrap or trap, ");
    text.push_str("`info` worth knowing, `hint` style.\nWhat rests on facts that are only assumed is never more than a warning.\n");
    text.push_str(SETS);
    for set in RuleSet::ALL {
        let count = rules.iter().filter(|rule| rule.is_in(set)).count();
        let _ = writeln!(text, "* `{}` ({count} rules): {}.", set.name(), set.summary());
    }
    text.push_str(MENDING);
    let mut groups: Vec<&str> = rules.iter().map(|rule| rule.group).collect();
    groups.dedup();
    for group in groups {
        let _ = write!(text, "\n## {group}\n\n");
        let rows: Vec<Vec<String>> = rules
            .iter()
            .filter(|rule| rule.group == group)
            .map(|rule| {
                let link = format!("[{id}]({id}.md)", id = rule.id);
                let severity = rule.severity.name().to_owned();
                vec![link, severity, sets(rule), fixed_by(rule), rule.summary.to_owned()]
            })
            .collect();
        text.push_str(&markdown::table(&["rule", "severity", "in the sets", "fixed by", "reports"], &rows));
    }
    text
}

const SETS: &str = "
Further sets are chosen on the command line (`--select strict`, `--extend-select restart-safe`) or in `gcheck.toml` (`[rules]`, `select = [\"recommended\", \"restart-safe\"]`):

";

const MENDING: &str = "
`--fix` applies fixes that change no move; `--unsafe-fixes` also applies those that may change one, or that need the programmer's decision.
";

/// The sets as a page shows them: `strict` holds all that is recommended, and is not repeated there.
fn sets(rule: &RuleMeta) -> String {
    let sets = rule.sets();
    let is_told = |set: &&&str| !(rule.recommended && **set == RuleSet::Strict.name());
    sets.iter().filter(is_told).copied().collect::<Vec<_>>().join(", ")
}

fn fixed_by(rule: &RuleMeta) -> String {
    match rule.fixability.option() {
        "" => String::new(),
        option => format!("`{option}`"),
    }
}

#[cfg(test)]
mod tests {
    use super::with_plainsides;

    #[test]
    fn an_example_is_followed_by_its_finding() {
        let docs =
            "## Reported\n```nc,reported,a-mill\nG4\n```\n## Not reported\n```nc,quiet,a-mill\nG4 P1.\n```\n";
        let mut findings = [Some("error[a]: b\n  1 | G4".to_owned()), None].into_iter();
        assert_eq!(
            with_plainsides(docs, || findings.next().flatten()),
            "## Reported\n\nOn `a-mill`:\n\n```nc\nG4\n```\n\n```text\nerror[a]: b\n  1 | G4\n```\n\n## Not reported\n\nOn `a-mill`:\n\n\
             ```nc\nG4 P1.\n```\n"
        );
    }

    #[test]
    fn remedies_are_said_once_as_sentences() {
        let rule = gcheck_rules::RULES.iter().find(|rule| rule.meta.fixability.option().is_empty()).unwrap();
        let remedies = ["`M5` first".to_owned(), "write `F`".to_owned(), "write `F`".to_owned()];
        assert_eq!(
            super::fixed(rule.meta, &remedies),
            "\n## How to fix it\n\nThe findings above say:\n\n* `M5` first.\n* Write `F`.\n"
        );
        assert_eq!(super::fixed(rule.meta, &[]), "");
    }

    /// Findings that need a machine or other files have no example that is rendered here: their rules say it themselves.
    #[test]
    fn every_page_says_once_how_to_fix_it() {
        let count = |rule| super::page(rule).matches("\n## How to fix it\n").count();
        let others = gcheck_rules::RULES.iter().filter(|rule| count(rule) != 1).map(|rule| rule.meta.id);
        let others: Vec<&str> = others.collect();
        assert!(others.is_empty(), "write `## How to fix it` into the documentation of {others:?}");
    }

    #[test]
    fn fences_say_the_control_in_words() {
        let docs =
            "Meaning.\n## Reported\nSo.\n```nc,reported,a-mill\nG4\n\n\nM2\n```\n```text\nplain\n```\n";
        assert_eq!(
            with_plainsides(docs, || None),
            "Meaning.\n\n## Reported\n\nSo.\n\nOn `a-mill`:\n\n```nc\nG4\n\n\nM2\n```\n\n```text\nplain\n```\n"
        );
    }
}
