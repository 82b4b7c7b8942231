//! Reading the directives that silence findings from the comments of a program.
//!
//! Knows: `(gcheck: ignore RULE - reason)`, `ignore-file`, `off` and `on`. Must not know: any rule, how findings are made.

use std::ops::Range;

use gcheck_diagnostics::Fix;
use gcheck_syntax::ast::comment_text;

use crate::suppression::{MalformedDirective, Suppression, Suppressions};
use crate::{ProgramText, RuleTable};

impl Suppressions {
    /// Reads the directives in the comments at `ranges` of `text`. They name rules of the table.
    pub(crate) fn read(text: &ProgramText<'_>, ranges: &[Range<u32>], table: RuleTable) -> Self {
        let mut this = Self::default();
        for range in ranges {
            let comment = text.slice(range.clone());
            let Some((_, directive)) = comment_text(comment).split_once("gcheck:") else { continue };
            this.directive(text, range, directive.trim(), table);
        }
        this
    }

    fn directive(&mut self, text: &ProgramText<'_>, range: &Range<u32>, directive: &str, table: RuleTable) {
        let (verb, rest) = directive.split_once([' ', '\t']).unwrap_or((directive, ""));
        if verb.starts_with("control=") || (verb == "control" && rest.trim_start().starts_with('=')) {
            return;
        }
        // A reason follows a dash that is alone: rule ids contain dashes.
        let (rules, reason) =
            rest.split_once(" - ").map_or((rest, ""), |(rules, reason)| (rules, reason.trim()));
        let selectors: Vec<String> =
            rules.split([',', ' ', '\t']).filter(|s| !s.is_empty()).map(str::to_owned).collect();
        let unknown = selectors.iter().find(|selector| !table.knows(selector));
        if !matches!(verb, "ignore" | "ignore-file" | "off" | "on") {
            let verbs = "`ignore`, `ignore-file`, `off`, `on` and `control=`";
            return self.refuse(range, format!("`{verb}` is not a gcheck directive; use {verbs}"));
        }
        if let Some(unknown) = unknown {
            let near = table.suggest(unknown);
            let fix = near.and_then(|near| {
                let comment = text.slice(range.clone());
                let start = range.start + comment.find(unknown.as_str())? as u32;
                let place = start..start + unknown.len() as u32;
                Some(Fix::safe(format!("write `{near}`"), place, near))
            });
            let near = near.map(|s| format!(", did you mean `{s}`?")).unwrap_or_default();
            let message = format!("`{unknown}` is not a rule, group or set{near}");
            self.malformed.push(MalformedDirective { range: range.clone(), message, fix });
            return;
        }
        if selectors.is_empty() {
            return self.refuse(range, format!("`{verb}` names no rule"));
        }
        let scope =
            match verb {
                "ignore" => line_scope(text, range),
                "ignore-file" => 0..u32::MAX,
                "off" => range.start..u32::MAX,
                _ => {
                    let open =
                        self.list.iter_mut().rev().find(|s| {
                            s.scope.end == u32::MAX && s.scope.start > 0 && s.selectors == selectors
                        });
                    match open {
                        Some(open) => open.scope.end = range.start,
                        None => self
                            .refuse(range, format!("`on {}` has no `off` before it", selectors.join(", "))),
                    }
                    return;
                }
            };
        let has_reason = !reason.is_empty();
        self.list.push(Suppression { range: range.clone(), selectors, has_reason, scope, used: false });
    }

    fn refuse(&mut self, range: &Range<u32>, message: String) {
        self.malformed.push(MalformedDirective { range: range.clone(), message, fix: None });
    }
}

/// A comment beside code covers its own line, a comment alone in its line the line below.
fn line_scope(text: &ProgramText<'_>, range: &Range<u32>) -> Range<u32> {
    let (base, chunk) = text.around(range.start);
    let bytes = chunk.as_bytes();
    let (start, end) = ((range.start - base) as usize, (range.end - base) as usize);
    let before = bytes.get(..start).unwrap_or_default();
    let line = memchr::memrchr2(b'\n', b'\r', before).map_or(0, |at| at + 1);
    let own_end = end + gcheck_syntax::line_len(bytes.get(end..).unwrap_or_default());
    let blank = |range: Range<usize>| {
        bytes.get(range).unwrap_or_default().iter().all(|b| b.is_ascii_whitespace() || *b == b';')
    };
    let in_file = |at: usize| base + at as u32;
    if blank(line..start) && blank(end..own_end) {
        let below = text.from(in_file(own_end)).next().map_or("", |(_, below)| below);
        in_file(own_end)..in_file(own_end + gcheck_syntax::line_len(below.as_bytes()).max(1))
    } else {
        in_file(line)..in_file(own_end.max(end + 1))
    }
}
