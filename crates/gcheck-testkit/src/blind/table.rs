//! Tables of tab-separated columns, the first line naming them.
//!
//! Knows: lines and columns. Must not know: what they hold.

use std::fs;
use std::path::Path;

use super::Unreadable;

/// The rows of a file, each with its line number, held against the head that it must have.
pub(super) fn rows(path: &Path, head: &[&str]) -> Result<Vec<(usize, Vec<String>)>, Unreadable> {
    let text =
        fs::read_to_string(path).map_err(|error| Unreadable(format!("{}: {error}", path.display())))?;
    let mut lines = text.lines().enumerate();
    let found: Vec<&str> = lines.next().map(|(_, line)| line.split('\t').collect()).unwrap_or_default();
    if found != head {
        return Err(Unreadable(format!("{}: the columns are {found:?}, not {head:?}", path.display())));
    }
    lines
        .map(|(at, line)| {
            let cells: Vec<String> = line.split('\t').map(str::to_owned).collect();
            if cells.len() == head.len() {
                Ok((at + 1, cells))
            } else {
                Err(Unreadable(format!("{}:{}: {} columns are needed", path.display(), at + 1, head.len())))
            }
        })
        .collect()
}

/// A table as text. Tabs and line ends inside a cell become blanks.
pub(super) fn text(head: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut text = head.join("\t") + "\n";
    for row in rows {
        let cells: Vec<String> = row.into_iter().map(|cell| cell.replace(['\t', '\n', '\r'], " ")).collect();
        text += &cells.join("\t");
        text.push('\n');
    }
    text
}
