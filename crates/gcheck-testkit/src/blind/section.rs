//! The first-look figures as sections of `docs/precision.md` and `docs/recall.md`.
//!
//! Knows: Markdown, how draws and sets are counted. Must not know: how a figure after tuning is made.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::{ComesOfIt, Draw, MistakeSet, Verdict, at_least, at_most};

const TITLE: &str = "## At first sight\n";

/// A page with the section in the place of the one it has, or before its first other section. What is not in it stays.
pub fn with_section(page: &str, section: &str) -> String {
    let next = |from: usize| {
        page.get(from..).and_then(|rest| rest.find("\n## ")).map_or(page.len(), |at| from + at + 1)
    };
    let start = page.find(TITLE).unwrap_or_else(|| next(0));
    let end = if page.get(start..).is_some_and(|rest| rest.starts_with(TITLE)) { next(start) } else { start };
    let (before, after) = (page.get(..start).unwrap_or(page), page.get(end..).unwrap_or_default());
    let gap = if section.is_empty() || after.is_empty() { "" } else { "\n" };
    [before, section, gap, after].concat()
}

/// The section about findings that are wrong. Empty, while there is no judged draw.
pub fn precision(draws: &[Draw]) -> String {
    let looked: Vec<&Draw> =
        draws.iter().filter(|draw| draw.findings.iter().any(|one| one.verdict.is_some())).collect();
    if looked.is_empty() {
        return String::new();
    }
    let mut text = String::from(
        "## At first sight\n\n\
        Programs that nobody of the project had read were drawn from public repositories, and listed before gcheck ran on them; it chose the control itself, without a machine file.\n\
        A reader who saw only program and manual judged every error and warning.\n\
        These figures are those of the first look and never change; rules were changed afterwards only ([how](dev/blind.md)).\n\
        A bound holds with 95 % confidence.\n\n\
        | draw | programs | severity | findings | true | unsure | false | false share |\n|---|---|---|---|---|---|---|---|\n",
    );
    for draw in &looked {
        for severity in ["error", "warning"] {
            let of: Vec<_> = draw.findings.iter().filter(|one| one.severity == severity).collect();
            let count = |verdict| of.iter().filter(|one| one.verdict == Some(verdict)).count() as u32;
            let [right, unsure, wrong] = [Verdict::True, Verdict::Unsure, Verdict::False].map(count);
            let judged = right + unsure + wrong;
            let _ = writeln!(
                text,
                "| {} | {} | {severity} | {} | {right} | {unsure} | {wrong} | {} |",
                draw.number,
                draw.programs.len(),
                of.len(),
                share_at_most(wrong, judged)
            );
        }
    }
    text.push_str("\n| draw | rule | false findings |\n|---|---|---|\n");
    for draw in looked {
        let mut by_rule: BTreeMap<&str, u32> = BTreeMap::new();
        for one in draw.findings.iter().filter(|one| one.verdict == Some(Verdict::False)) {
            *by_rule.entry(&one.rule).or_default() += 1;
        }
        for (rule, count) in by_rule {
            let _ = writeln!(text, "| {} | [{rule}](rules/{rule}.md) | {count} |", draw.number);
        }
    }
    text
}

/// The section about mistakes that are found. Empty, while no set has a judged first look.
pub fn recall(sets: &[MistakeSet]) -> String {
    let looked: Vec<&MistakeSet> = sets.iter().filter(|set| set.is_judged()).collect();
    if looked.is_empty() {
        return String::new();
    }
    let mut text = String::from(
        "## At first sight\n\n\
        Mistakes were written by readers who had the manuals and our programs and had not read the rules, and were committed before gcheck ran on them.\n\
        A mistake counts as found when a warning or an error that the edit brings names it, as a second reader judges; each program is checked beside its machine file.\n\
        These figures are those of the first look and never change; rules were changed afterwards only ([how](dev/blind.md)).\n\
        A bound holds with 95 % confidence.\n\n\
        | set | what comes of it | mistakes | found as a warning or an error | at any severity |\n|---|---|---|---|---|\n",
    );
    let classes = [
        ("all", None),
        ("crash", Some(ComesOfIt::Crash)),
        ("scrap", Some(ComesOfIt::Scrap)),
        ("alarm", Some(ComesOfIt::Alarm)),
        ("trap", Some(ComesOfIt::Trap)),
    ];
    for set in &looked {
        for (name, class) in classes {
            let of: Vec<_> = set
                .mistakes
                .iter()
                .filter(|one| class.is_none_or(|class| one.comes_of_it == class))
                .collect();
            let warned =
                of.iter().filter(|one| set.naming(one).any(super::NewFinding::is_a_warning)).count() as u32;
            let named = of.iter().filter(|one| set.naming(one).next().is_some()).count() as u32;
            let made = of.len() as u32;
            let _ = writeln!(
                text,
                "| {} | {name} | {made} | {} | {named} |",
                set.number,
                share_at_least(warned, made)
            );
        }
    }
    text.push_str("\n| set | mistake that no warning named | comes of it |\n|---|---|---|\n");
    for set in looked {
        for one in set.mistakes.iter().filter(|one| !set.naming(one).any(super::NewFinding::is_a_warning)) {
            let class = match one.comes_of_it {
                ComesOfIt::Crash => "crash",
                ComesOfIt::Scrap => "scrap",
                ComesOfIt::Alarm => "alarm",
                ComesOfIt::Trap => "trap",
            };
            let _ = writeln!(
                text,
                "| {} | {} (`{}`, {}) | {class} |",
                set.number,
                one.what.replace('|', "\\|"),
                one.control,
                one.id
            );
        }
    }
    text
}

fn share_at_most(count: u32, of: u32) -> String {
    if of == 0 {
        return "none judged".to_owned();
    }
    format!("{:.1} %, at most {:.1} %", percent(count, of), at_most(count, of) * 100.0)
}

fn share_at_least(count: u32, of: u32) -> String {
    if of == 0 {
        return "none".to_owned();
    }
    format!("{count} ({:.1} %, at least {:.1} %)", percent(count, of), at_least(count, of) * 100.0)
}

fn percent(count: u32, of: u32) -> f64 {
    f64::from(count) * 100.0 / f64::from(of)
}

#[cfg(test)]
mod tests {
    use super::with_section;

    #[test]
    fn a_section_takes_the_place_of_the_one_before() {
        let page = "# Title\n\nWords.\n\n## Verdicts\n\nTable.\n";
        let once = with_section(page, "## At first sight\n\nOne.\n");
        assert_eq!(once, "# Title\n\nWords.\n\n## At first sight\n\nOne.\n\n## Verdicts\n\nTable.\n");
        let twice = with_section(&once, "## At first sight\n\nTwo.\n");
        assert_eq!(twice, once.replace("One", "Two"));
        assert_eq!(with_section(&once, ""), page);
    }
}
