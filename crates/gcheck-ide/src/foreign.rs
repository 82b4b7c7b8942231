//! Text that somebody else wrote (a program, a name in it, a title of a configuration) in Markdown.
//!
//! Knows: what Markdown makes of characters. Must not know: where a text is shown.
//!
//! Some editors trust what a language server shows, and follow its links and pictures. So no text of others goes into
//! Markdown but through here: as code, or with everything escaped that could be more than text.

use std::fmt;

/// Text that somebody else wrote, as Markdown.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Foreign<'t> {
    /// In a span of code.
    Code(&'t str),
    /// Among other words.
    Prose(&'t str),
}

impl fmt::Display for Foreign<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Code(text) => code(f, text),
            Self::Prose(text) => prose(f, text),
        }
    }
}

/// A span of code ends at as many backticks as it began with: it begins with one more than the text has in a row.
fn code(f: &mut fmt::Formatter<'_>, text: &str) -> fmt::Result {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    // One blank on each side is not part of the code.
    let blank = if longest > 0 { " " } else { "" };
    write!(f, "{fence}{blank}")?;
    text.chars().try_for_each(|c| fmt::Write::write_char(f, visible(c)))?;
    write!(f, "{blank}{fence}")
}

/// A backslash makes any mark of ASCII mean itself. Addresses (`https://…`, `www.…`, `a@b.c`) are links without any mark
/// around them, and end at the marks in them that mean themselves.
fn prose(f: &mut fmt::Formatter<'_>, text: &str) -> fmt::Result {
    for c in text.chars() {
        if c.is_ascii_punctuation() && !matches!(c, '\'' | ',' | '#') {
            f.write_str("\\")?;
        }
        fmt::Write::write_char(f, visible(c))?;
    }
    Ok(())
}

/// One line, and nothing that is not seen.
fn visible(c: char) -> char {
    if c.is_control() { ' ' } else { c }
}

#[cfg(test)]
mod tests {
    use super::Foreign;

    #[test]
    fn a_span_of_code_cannot_be_left() {
        let code = |text| Foreign::Code(text).to_string();
        assert_eq!(code("G0 X1."), "`G0 X1.`");
        assert_eq!(code("(a`b)"), "`` (a`b) ``");
        assert_eq!(code("`` [link](http://x)"), "``` `` [link](http://x) ```");
        assert_eq!(code("a\n\n# b"), "`a  # b`");
    }

    #[test]
    fn prose_is_text_and_nothing_else() {
        let prose = |text| Foreign::Prose(text).to_string();
        assert_eq!(prose("FACE, 2 PASSES"), "FACE, 2 PASSES");
        assert_eq!(prose("[a](http://b.c)"), r"\[a\]\(http\:\/\/b\.c\)");
        assert_eq!(prose("<img src=x> ![p](q) a@b.c"), r"\<img src\=x\> \!\[p\]\(q\) a\@b\.c");
        assert_eq!(prose("one\r\ntwo\x1b"), r"one  two ");
    }
}
