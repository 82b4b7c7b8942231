//! Suppressions: comments of the program that silence rules, with a reason.
//!
//! Knows: `(gcheck: ignore RULE - reason)` and its kin. Must not know: how findings are made.

use std::ops::Range;

use crate::selection::matches;
use crate::{Finding, Fix, ProgramText, all};

/// One directive of a comment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Suppression {
    /// The comment's bytes of the file.
    pub(crate) range: Range<u32>,
    /// What it silences, as written: rules, groups or `all`.
    pub(crate) selectors: Vec<String>,
    pub(crate) has_reason: bool,
    /// Bytes of the file in which findings must start to be silenced; empty until a region is closed.
    scope: Range<u32>,
    pub(crate) used: bool,
}

/// A directive that cannot be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Malformed {
    pub(crate) range: Range<u32>,
    pub(crate) message: String,
    /// What was meant, where it is near enough to a name.
    pub(crate) meant: Option<Fix>,
}

/// The directives of a file.
#[derive(Debug, Clone, Default)]
pub struct Suppressions {
    pub(crate) list: Vec<Suppression>,
    pub(crate) malformed: Vec<Malformed>,
}

impl Suppressions {
    /// Reads the directives that stand in the comments at `ranges` of `text`.
    pub(crate) fn read(text: &ProgramText<'_>, ranges: &[Range<u32>]) -> Self {
        let mut this = Self::default();
        for range in ranges {
            let comment = text.slice(range.clone());
            let Some((_, directive)) = comment.split_once("gcheck:") else { continue };
            let directive = directive.trim_end_matches(')').trim();
            this.directive(text, range, directive);
        }
        this
    }

    fn directive(&mut self, text: &ProgramText<'_>, range: &Range<u32>, directive: &str) {
        let (verb, rest) = directive.split_once([' ', '\t']).unwrap_or((directive, ""));
        if verb.starts_with("control=") || (verb == "control" && rest.trim_start().starts_with('=')) {
            return;
        }
        // A reason follows a dash that stands alone: rule ids contain dashes.
        let (rules, reason) =
            rest.split_once(" - ").map_or((rest, ""), |(rules, reason)| (rules, reason.trim()));
        let selectors: Vec<String> =
            rules.split([',', ' ', '\t']).filter(|s| !s.is_empty()).map(str::to_owned).collect();
        let unknown = selectors.iter().find(|s| !all().iter().any(|rule| matches(rule, s)));
        if !matches!(verb, "ignore" | "ignore-file" | "off" | "on") {
            let verbs = "`ignore`, `ignore-file`, `off`, `on` and `control=`";
            return self.refuse(range, format!("`{verb}` is no gcheck directive; there are {verbs}"));
        }
        if let Some(unknown) = unknown {
            let near = crate::selection::suggest(unknown);
            let meant = near.and_then(|near| {
                let comment = text.slice(range.clone());
                let start = range.start + comment.find(unknown.as_str())? as u32;
                let place = start..start + unknown.len() as u32;
                Some(Fix::safe(format!("write `{near}`"), place, near))
            });
            let near = near.map(|s| format!(", did you mean `{s}`?")).unwrap_or_default();
            let message = format!("`{unknown}` is no rule, group or set{near}");
            self.malformed.push(Malformed { range: range.clone(), message, meant });
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
        self.malformed.push(Malformed { range: range.clone(), message, meant: None });
    }

    /// Is the finding silenced? Marks the suppression that does it as used.
    pub(crate) fn silences(&mut self, finding: &Finding) -> bool {
        let Some(rule) = all().iter().find(|rule| std::ptr::eq(rule.meta, finding.rule)) else {
            return false;
        };
        let mut silenced = false;
        for suppression in &mut self.list {
            if suppression.scope.contains(&finding.range.start)
                && suppression.selectors.iter().any(|s| matches(rule, s))
            {
                suppression.used = true;
                silenced = true;
            }
        }
        silenced
    }
}

/// A comment beside code speaks for its own line, a comment that stands alone for the line below.
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
