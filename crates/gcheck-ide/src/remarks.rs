//! The name that a comment gives to what begins in its line. The line may be in a program on disk, which has no tree.
//!
//! Knows: comments, and which of them are directives of ours. Must not know: what is named.

/// What begins a directive in a comment.
const DIRECTIVE: &str = "gcheck:";

/// The first comment of a line that says something to people, without what it says to us.
pub(crate) fn title(line: &str) -> Option<&str> {
    let mut rest = line;
    loop {
        let at = rest.find(['(', ';'])?;
        let inside = rest.get(at + 1..)?;
        let comment = if rest.get(at..)?.starts_with('(') { inside.split(')').next()? } else { inside };
        let said = comment.split(DIRECTIVE).next().unwrap_or_default().trim();
        if !said.is_empty() {
            return Some(said);
        }
        rest = inside.get(comment.len()..)?;
    }
}

/// Does a comment speak to us and not to people?
pub(crate) fn is_directive(comment: &str) -> bool {
    comment.trim_start().starts_with(DIRECTIVE)
}

#[cfg(test)]
mod tests {
    use super::title;

    #[test]
    fn a_directive_is_no_title() {
        assert_eq!(title("O1 (SLOT)"), Some("SLOT"));
        assert_eq!(title("O1 (gcheck: control=haas-mill)"), None);
        assert_eq!(title("O1 (gcheck: control=haas-mill) (SLOT)"), Some("SLOT"));
        assert_eq!(title("O1 () ( SLOT gcheck: off)"), Some("SLOT"));
        assert_eq!(title("o1 sub ; gcheck: off"), None);
        assert_eq!(title("o1 sub ; probing"), Some("probing"));
        assert_eq!(title("O1"), None);
        assert_eq!(title("O1 (SLOT"), Some("SLOT"));
    }
}
