//! A comment in which a program names its control: `(gcheck: control=NAME)`.
//!
//! Knows: where such a comment may be, and its form. Must not know: which controls there are.

use std::ops::Range;

/// Lines in which a comment may name the control.
const HEAD_LINES: usize = 50;

/// A comment that names a control, in bytes of the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ControlComment {
    /// The name; empty where there is none after the sign.
    pub name: Range<usize>,
    /// The comment, or what of it is in its line.
    pub comment: Range<usize>,
}

/// The first comment of the first lines that names a control.
pub fn control_comment(text: &str) -> Option<ControlComment> {
    let mut start = 0;
    let mut lines = 0;
    for line in text.split_inclusive(['\n', '\r']) {
        // `\r\n` ends one line.
        lines +=
            usize::from(!(line == "\n" && text.get(..start).is_some_and(|before| before.ends_with('\r'))));
        if lines > HEAD_LINES {
            break;
        }
        for (at, sign) in line.match_indices("gcheck:") {
            let (before, directive) = (&line[..at], &line[at + sign.len()..]);
            let name = directive.trim_start().strip_prefix("control").map(str::trim_start);
            if let Some(rest) = name.and_then(|rest| rest.strip_prefix('=')).map(str::trim_start) {
                let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '-')).unwrap_or(rest.len());
                let at = start + line.len() - rest.len();
                let open = before.rfind(['(', ';']).unwrap_or(before.len());
                let comment = line.get(open..).unwrap_or_default();
                let comment = comment.split_inclusive(')').next().unwrap_or(comment).trim_end();
                let open = start + open;
                return Some(ControlComment { name: at..at + end, comment: open..open + comment.len() });
            }
        }
        start += line.len();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::control_comment;

    #[test]
    fn a_comment_of_the_first_lines_names_the_control() {
        let named = |text: &str| {
            control_comment(text).map(|found| (text[found.name].to_owned(), text[found.comment].to_owned()))
        };
        let pair = |name: &str, comment: &str| Some((name.to_owned(), comment.to_owned()));
        assert_eq!(named("%\nO1 (A)\n(gcheck: control=a-b) X1.\n"), pair("a-b", "(gcheck: control=a-b)"));
        assert_eq!(named("; gcheck: control = b\n"), pair("b", "; gcheck: control = b"));
        assert_eq!(named("(gcheck: control=)\n"), pair("", "(gcheck: control=)"));
        assert_eq!(named("(gcheck: off)\n(control=a)\n"), None);
        assert_eq!(named("(gcheck: off) (gcheck: control=a)\n"), pair("a", "(gcheck: control=a)"));
        for end in ["\n", "\r\n", "\r"] {
            let after = |lines: usize| named(&format!("{}(gcheck: control=a){end}", end.repeat(lines)));
            assert_eq!(after(49), pair("a", "(gcheck: control=a)"), "{end:?}");
            assert_eq!(after(50), None, "{end:?}");
        }
    }
}
