//! The smallest part of a text that still shows something.
//!
//! Knows: lines. Must not know: what is shown.

/// Removes lines as long as `shows` holds for the rest: halves first, then ever smaller parts, to single lines.
pub(crate) fn minimise(text: &str, mut shows: impl FnMut(&str) -> bool) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let mut part = lines.len().div_ceil(2);
    while part > 0 {
        let mut start = 0;
        let mut shrunk = false;
        while start < lines.len() {
            let end = (start + part).min(lines.len());
            let rest: Vec<&str> = lines.iter().take(start).chain(lines.iter().skip(end)).copied().collect();
            if shows(&joined(&rest)) {
                lines = rest;
                shrunk = true;
            } else {
                start = end;
            }
        }
        // A line that was needed by one that is gone may go too.
        part = if shrunk && part == 1 { 1 } else { part / 2 };
    }
    joined(&lines)
}

fn joined(lines: &[&str]) -> String {
    lines.iter().flat_map(|line| [*line, "\n"]).collect()
}

#[test]
fn what_is_needed_stays() {
    let text: String = (0..50).map(|n| format!("{n}\n")).collect();
    let shows = |t: &str| t.contains("17\n") && t.contains("42\n");
    assert_eq!(minimise(&text, shows), "17\n42\n");
    assert_eq!(minimise(&text, |_| false), text);
    assert_eq!(minimise("", |_| true), "");
}
