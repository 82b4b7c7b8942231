//! What of a file is not used, in words: a line for each reason.
//!
//! Knows: how reasons are put together. Must not know: any format, why something is not used.

use std::collections::BTreeMap;

use super::sheet::Sheet;

/// Things that are not used for one reason, by name.
const NAMED: usize = 4;
/// Reasons for which something is not used that are shown of one file.
const MOST_REASONS: usize = 50;

/// Things that are not used for one reason.
struct Alike<'s> {
    line: usize,
    why: &'s str,
    /// The first few.
    named: Vec<String>,
    count: usize,
}

/// What was not used: one line for a reason, with the first few that it is about.
pub(super) fn unused(sheet: &Sheet<'_>) -> Vec<String> {
    let mut groups: Vec<Alike<'_>> = Vec::new();
    let mut by_reason: BTreeMap<&str, usize> = BTreeMap::new();
    for one in &sheet.unused {
        let ix = *by_reason.entry(&one.why).or_insert(groups.len());
        if ix == groups.len() {
            groups.push(Alike { line: one.line, why: &one.why, named: Vec::new(), count: 0 });
        }
        let Some(group) = groups.get_mut(ix) else { continue };
        group.count += 1;
        if group.named.len() < NAMED {
            let is_there = one.line == group.line;
            group.named.push(if is_there {
                one.what.clone()
            } else {
                format!("{} (line {})", one.what, one.line)
            });
        }
    }
    groups.sort_by_key(|group| group.line);
    let hidden: usize = groups.iter().skip(MOST_REASONS).map(|group| group.count).sum();
    let words = |group: &Alike<'_>| {
        let more = group.count - group.named.len();
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        format!("{}:{}: not used: {}{more}: {}", sheet.shown, group.line, group.named.join(", "), group.why)
    };
    let mut lines: Vec<String> = groups.iter().take(MOST_REASONS).map(words).collect();
    if hidden + sheet.more_unused > 0 {
        lines.push(format!("{}: not used: … and {} more", sheet.shown, hidden + sheet.more_unused));
    }
    lines
}
