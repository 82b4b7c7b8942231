//! How deep in loops, branches and subroutines a line is.
//!
//! Knows: which statements open a body and which close one, as far as one line tells. Must not know: blanks. Bodies that are
//! not closed end with their program.

use std::hash::{DefaultHasher, Hash as _, Hasher as _};

use gcheck_syntax::SyntaxKind as K;

use crate::line::Part;

/// Deeper bodies are indented no further.
const MOST: usize = 16;

/// The bodies around a line.
#[derive(Debug, Default)]
pub(crate) struct Nesting {
    open: Vec<Body>,
}

/// What opened a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Body {
    /// `O100 DO`, which `O100 WHILE` ends: a hash of the label.
    Do(u64),
    /// Anything else.
    Other,
}

impl Nesting {
    /// How deep the next line is, were it a plain one.
    pub(crate) fn depth(&self) -> usize {
        self.open.len().min(MOST)
    }

    /// How deep a line is; what it opens and closes counts for the lines after it.
    pub(crate) fn pass(&mut self, parts: &[Part], text: &str) -> usize {
        let first = parts.iter().find(|part| part.kind != K::WHITESPACE);
        if first.is_some_and(|part| is_program_head(part, text)) {
            self.open.clear();
        }
        let mut depth = self.depth();
        for (at, part) in parts.iter().enumerate() {
            match (part.outer, part.kind) {
                (K::O_STATEMENT, keyword) => {
                    let label = || label(parts.get(..at).unwrap_or_default(), part.item, text);
                    match keyword {
                        K::DO_KW => self.open.push(Body::Do(label())),
                        K::WHILE_KW if self.open.last() == Some(&Body::Do(label())) => {
                            self.open.pop();
                            depth = self.depth();
                        }
                        K::SUB_KW | K::REPEAT_KW | K::IF_KW | K::WHILE_KW => self.open.push(Body::Other),
                        K::ENDSUB_KW | K::ENDREPEAT_KW | K::ENDIF_KW | K::ENDWHILE_KW => {
                            self.open.pop();
                            depth = self.depth();
                        }
                        K::ELSE_KW | K::ELSEIF_KW => depth = self.open.len().saturating_sub(1).min(MOST),
                        _ => {}
                    }
                }
                (K::WHILE_STATEMENT, K::DO_KW) => self.open.push(Body::Other),
                (K::END_STATEMENT, K::END_KW) => {
                    self.open.pop();
                    depth = self.depth();
                }
                _ => {}
            }
        }
        depth
    }
}

/// `O1234` or `:1234` by itself: a program begins.
fn is_program_head(part: &Part, text: &str) -> bool {
    let is_o = |part: &Part| {
        let letter = text.as_bytes().get(part.range.start as usize);
        matches!(letter, Some(b'O' | b'o'))
    };
    part.kind == K::COLON_NUMBER || part.kind == K::WORD && part.outer == K::WORD && is_o(part)
}

/// The text of an O-word in front of its keyword, without regard to case and blanks; `parts` end there.
fn label(parts: &[Part], item: u32, text: &str) -> u64 {
    let mut hasher = DefaultHasher::new();
    let of_item = parts.iter().rev().take_while(|part| part.item == item);
    for part in of_item.filter(|part| part.kind != K::WHITESPACE) {
        let text = text.get(part.range.start as usize..part.range.end as usize).unwrap_or_default();
        for byte in text.bytes().filter(|byte| !byte.is_ascii_whitespace()) {
            byte.to_ascii_lowercase().hash(&mut hasher);
        }
    }
    hasher.finish()
}
