//! All about a rule, or about a code as a control reads it, as a page.
//!
//! Knows: what a page has beside the entry's own text. Must not know: any rule or code, how a page is shown.

use std::fmt::Write as _;

use gcheck_controls::{CodeNumber, Control};
use gcheck_diagnostics::RuleMeta;
use gcheck_lint::RuleTable;

use crate::describe;

/// A page in Markdown; `None` for what is neither a rule nor a code of the control.
pub fn explain(rules: RuleTable, control: &Control, subject: &str) -> Option<String> {
    if let Some(rule) = rules.by_id(subject) {
        return Some(of_rule(rule.meta));
    }
    let code = control.code(CodeNumber::parse(subject)?)?;
    let entry = code.entry();
    Some(format!("# {} {}\n\n{}", entry.code, entry.title, describe::details(control, code)))
}

fn of_rule(meta: &RuleMeta) -> String {
    let on = if meta.recommended { "on by default" } else { "off by default" };
    let mut text = format!("# {}\n\n{}\n\n*{}, {on}*\n\n", meta.id, meta.summary, meta.severity);
    for line in meta.docs().lines() {
        // An example says after its language for which control it holds.
        match line.strip_prefix("```nc,").and_then(|info| info.split_once(',')) {
            Some((_, control)) => {
                let _ = write!(text, "\nOn `{}`:\n\n```gcode\n", control.trim_end_matches(",guessed"));
            }
            None => {
                let _ = writeln!(text, "{}", line.trim_end());
            }
        }
    }
    let _ = write!(text, "\n[{}]({})\n", meta.id, meta.page());
    text
}

#[cfg(test)]
mod tests {
    use super::explain;

    fn page(subject: &str) -> Option<String> {
        explain(gcheck_rules::RULES, &gcheck_controls::load("haas-mill").unwrap(), subject)
    }

    #[test]
    fn a_code_with_its_words_and_its_source() {
        let text = page("g083").unwrap();
        assert!(text.starts_with("# G83 peck drilling\n"), "{text}");
        for part in ["| `Q` |", "```gcode", "HM17"] {
            assert!(text.contains(part), "{part} in {text}");
        }
    }

    #[test]
    fn a_rule_with_its_examples() {
        let text = page("unknown-code").unwrap();
        assert!(text.starts_with("# unknown-code\n\ncode that"), "{text}");
        assert!(text.contains("On `haas-mill`:\n\n```gcode\n") && !text.contains("```nc"), "{text}");
    }

    #[test]
    fn what_nobody_knows_has_no_page() {
        assert_eq!((page("G9999"), page("no-such-rule"), page("")), (None, None, None));
    }
}
