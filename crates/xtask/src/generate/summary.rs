//! The generated lines of `docs/SUMMARY.md`, the book's table of contents: rules by group, controls, decisions.
//!
//! Knows: which lines of the page have generated ones below them. Must not know: any page. The other lines are written by
//! hand and stay as they are.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use gcheck_diagnostics::RuleMeta;

use super::generated::Generated;

const CONTENTS: &str = "docs/SUMMARY.md";
const DECISIONS: &str = "docs/dev/decisions";

/// Folders of pages that are listed below the line that links to the folder's own page, or names it with an empty link.
const FOLDERS: [&str; 3] = ["rules/", "controls/", "dev/decisions/"];

/// The page, given the pages that are generated besides.
pub(super) fn generate(root: &Path, others: &Generated) -> anyhow::Result<Generated> {
    let now = fs::read_to_string(root.join(CONTENTS)).context(CONTENTS)?;
    let mut text = String::new();
    for line in now.lines().filter(|line| !is_generated(line)) {
        text.push_str(line);
        text.push('\n');
        let below = if line.contains("](rules/README.md)") {
            rules()
        } else if line.contains("](controls/README.md)") {
            controls(others)
        } else if line.contains("[Decisions]()") {
            decisions(root)?
        } else {
            continue;
        };
        let indent = line.len() - line.trim_start().len();
        for entry in below.lines() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}{entry}", " ".repeat(indent + 2));
        }
    }
    Ok(vec![(PathBuf::from(CONTENTS), text)])
}

/// A line that leads into one of the folders and not to its own page, or the heading of a group of rules.
fn is_generated(line: &str) -> bool {
    let Some((_, target)) = line.rsplit_once("](") else { return false };
    let is_group =
        target == ")" && gcheck_rules::RULES.iter().any(|rule| line.ends_with(&group_entry(rule.meta.group)));
    is_group || (FOLDERS.iter().any(|folder| target.starts_with(folder)) && !target.ends_with("README.md)"))
}

fn group_entry(group: &str) -> String {
    format!("- [{}]()", group.replace('_', " "))
}

fn rules() -> String {
    let mut rules: Vec<&RuleMeta> = gcheck_rules::RULES.iter().map(|rule| rule.meta).collect();
    rules.sort_by_key(|rule| (rule.group, rule.id));
    let (mut text, mut group) = (String::new(), "");
    for rule in rules {
        if rule.group != group {
            group = rule.group;
            let _ = writeln!(text, "{}", group_entry(group));
        }
        let _ = writeln!(text, "  - [{0}](rules/{0}.md)", rule.id);
    }
    text
}

fn controls(others: &Generated) -> String {
    let mut text = String::new();
    for (path, _) in others.iter().filter(|(path, _)| path.starts_with("docs/controls")) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        if name != "README" {
            let _ = writeln!(text, "- [{name}](controls/{name}.md)");
        }
    }
    text
}

fn decisions(root: &Path) -> anyhow::Result<String> {
    let mut pages: Vec<PathBuf> =
        fs::read_dir(root.join(DECISIONS))?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<_>>()?;
    pages.sort();
    let mut text = String::new();
    for page in pages {
        let content = fs::read_to_string(&page).with_context(|| page.display().to_string())?;
        let title = content.lines().find_map(|line| line.strip_prefix("# ")).unwrap_or_default();
        let name = page.file_name().unwrap_or_default().to_string_lossy();
        let _ = writeln!(text, "- [{title}](dev/decisions/{name})");
    }
    Ok(text)
}
