//! A document after edits is a fresh one.
//!
//! Knows: edits of a text. Must not know: controls.

use gcheck_syntax::{Document, SyntaxProfile, parse};

use crate::choices::Choices;
use crate::programs;

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let edits: Vec<[u8; 4]> = (0..choices.below(8))
        .map(|_| [choices.byte(), choices.byte(), choices.byte(), choices.byte()])
        .collect();
    let repeats = 1 + choices.below(4) * 300;
    let mut text = programs::case(choices.rest()).text;
    // Many lines have many chunks.
    if text.len() < 200 {
        text = text.repeat(repeats);
    }
    let mut document = Document::new(&text);
    for edit in edits {
        let (range, insert) = placed(&text, edit);
        let edited = document.edit(range.clone(), insert);
        assert!(edited.is_ok(), "{range:?} is in the text");
        text.replace_range(range, insert);
        assert_eq!(document, Document::new(&text), "an edited document is a fresh one");
    }
    let parsed = parse(&text, SyntaxProfile::MACRO_B);
    assert_eq!(parsed.syntax().text().to_string(), text, "the tree is the text");
}

/// An edit of a text by four bytes: place, length, and what is put there.
pub(super) fn placed(
    text: &str,
    [at, fine, length, what]: [u8; 4],
) -> (std::ops::Range<usize>, &'static str) {
    let down = |mut at: usize| {
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let start = text.len() * usize::from(at) / 256 + usize::from(fine) % 32;
    let start = down(start.min(text.len()));
    let length = if length < 128 { usize::from(length) % 16 } else { usize::from(length) * 4 };
    let end = down((start + length).min(text.len())).max(start);
    (start..end, INSERTS.get(usize::from(what) % INSERTS.len()).copied().unwrap_or_default())
}

const INSERTS: &[&str] = &[
    "",
    "\n",
    "7",
    "X1.5 Y2.5\n",
    "G91\n",
    "(",
    ")",
    "%",
    "\r",
    "(NOTE)\n",
    "M5\nT2 M6\nG0 Z100.\n",
    "IF [#500 EQ 1.] GOTO 77\nN77 ",
    "G01 ",
    "M30\n",
    "O2\n",
    "M98 P2\n",
    "/",
    "#1=#1+1\n",
    "WHILE [#1 LT 3] DO1\n",
    "END1\n",
    "N10 ",
    "GOTO 10\n",
    ";",
    "[",
    "]",
    "é",
    "o100 sub\n",
    "o100 endsub\n",
    "o100 call\n",
    "(gcheck: ignore all)\n",
    "G41 D1\n",
    "G40\n",
    ".",
    "-",
    " ",
    "\u{1A}",
];
