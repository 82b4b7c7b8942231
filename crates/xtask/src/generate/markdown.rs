//! Small pieces of Markdown.
//!
//! Knows: Markdown's syntax. Must not know: what the pages are about.

use std::fmt::Write as _;

/// The first line of a generated page.
pub(super) fn header(source: &str) -> String {
    format!("<!-- Written by `cargo xtask gen` from {source}; edit that. -->\n\n")
}

/// A table; nothing at all without rows.
pub(super) fn table(columns: &[&str], rows: &[Vec<String>]) -> String {
    let mut text = String::new();
    if rows.is_empty() {
        return text;
    }
    let _ = writeln!(text, "| {} |", columns.join(" | "));
    let _ = writeln!(text, "|{}", "---|".repeat(columns.len()));
    for row in rows {
        let cells: Vec<String> = row.iter().map(|text| cell(text)).collect();
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
    text
}

/// A text as a cell: on one line, with nothing in it that ends the cell or begins a tag of HTML.
fn cell(text: &str) -> String {
    let text = text.trim().replace('|', "\\|").replace('\n', " ");
    // Every second piece is code, where `<` stands for itself.
    let pieces = text.split('`').enumerate();
    let pieces: Vec<String> = pieces
        .map(|(ix, piece)| if ix % 2 == 0 { piece.replace('<', "&lt;") } else { piece.to_owned() })
        .collect();
    pieces.join("`")
}

/// Items as code, with commas between them.
pub(super) fn codes<I: AsRef<str>>(items: impl IntoIterator<Item = I>) -> String {
    let items: Vec<String> = items.into_iter().map(|item| format!("`{}`", item.as_ref())).collect();
    items.join(", ")
}

#[cfg(test)]
mod tests {
    use super::table;

    #[test]
    fn cells_cannot_break_the_table() {
        assert_eq!(
            table(&["a", "b"], &[vec!["x|y".into(), "1\n2".into()]]),
            "| a | b |\n|---|---|\n| x\\|y | 1 2 |\n"
        );
        assert_eq!(
            table(&["a"], &[vec!["O<name> and `#<name>`, <".into()]]),
            "| a |\n|---|\n| O&lt;name> and `#<name>`, &lt; |\n"
        );
    }
}
