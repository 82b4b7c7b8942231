//! Comments.
//!
//! Knows: what encloses a comment. Must not know: what comments say.

use std::ops::Range;

use crate::{SyntaxElement, SyntaxKind, SyntaxToken, byte_range};

/// `(…)` or `; …`.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Comment(SyntaxToken);

impl Comment {
    /// Views a token, if it is a comment.
    pub fn cast(token: SyntaxToken) -> Option<Self> {
        token.kind().is_comment().then_some(Self(token))
    }

    pub(super) fn of_element(element: SyntaxElement) -> Option<Self> {
        element.into_token().and_then(Self::cast)
    }

    /// The token.
    pub fn syntax(&self) -> &SyntaxToken {
        &self.0
    }

    /// Bytes of the parsed text, with the signs that enclose the comment.
    pub fn range(&self) -> Range<u32> {
        byte_range(self.0.text_range())
    }

    /// What the comment says: its text without the signs that enclose it, blanks kept.
    pub fn text(&self) -> &str {
        comment_text(self.0.text())
    }

    /// Does it end where the control closes it, so that more text may follow in its line? False for `; …`, and for a
    /// parenthesis that is open or has another one inside.
    pub fn is_closed(&self) -> bool {
        self.0.kind() == SyntaxKind::COMMENT
    }
}

/// What a comment says: its text without the signs that enclose it, blanks kept.
pub fn comment_text(comment: &str) -> &str {
    match comment.strip_prefix('(') {
        Some(inside) => inside.strip_suffix(')').unwrap_or(inside),
        None => comment.strip_prefix(';').unwrap_or(comment),
    }
}
