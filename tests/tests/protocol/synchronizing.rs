//! Texts at the server are texts at the client.
//!
//! Knows: how a client changes its own text. Must not know: what a text means.

use serde_json::json;

use crate::session::{Session, in_bytes, range_of, usual};

/// Bytes of a position, as a client with UTF-16 columns finds them.
fn offset(text: &str, line: usize, column: usize, in_bytes: bool) -> usize {
    let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    let mut left = column;
    let behind = text[start..].char_indices().find(|(_, c)| {
        if left == 0 {
            return true;
        }
        left -= if in_bytes { c.len_utf8() } else { c.len_utf16() };
        false
    });
    behind.map_or(text.len(), |(at, _)| start + at)
}

/// A small generator of numbers: the same for each seed.
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    pub(crate) fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % n.max(1)
    }

    pub(crate) fn pick<'a>(&mut self, from: &[&'a str]) -> &'a str {
        from[self.below(from.len())]
    }
}

/// A document as the client has it.
pub(crate) struct Mirror {
    pub(crate) text: String,
    in_bytes: bool,
}

impl Mirror {
    pub(crate) fn new(text: &str, in_bytes: bool) -> Self {
        Self { text: text.to_owned(), in_bytes }
    }

    /// Line and column of a byte on the border of a character.
    pub(crate) fn position(&self, at: usize) -> [u32; 2] {
        let before = &self.text[..at];
        let line = before.matches('\n').count();
        let column = &before[before.rfind('\n').map_or(0, |end| end + 1)..];
        let column = if self.in_bytes { column.len() } else { column.encode_utf16().count() };
        [u32::try_from(line).unwrap(), u32::try_from(column).unwrap()]
    }

    /// A random place between two characters, and not inside the end of a line.
    fn place(&self, dice: &mut Dice) -> usize {
        let mut at = dice.below(self.text.len() + 1);
        while !self.text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }

    /// Replaces a random range by a text; gives the change as the protocol has it.
    pub(crate) fn random_edit(&mut self, dice: &mut Dice, pieces: &[&str]) -> serde_json::Value {
        let start = self.place(dice);
        let mut end = (start + dice.below(6)).min(self.text.len());
        while !self.text.is_char_boundary(end) {
            end += 1;
        }
        let insert = dice.pick(pieces);
        let ([line, column], [end_line, end_column]) = (self.position(start), self.position(end));
        let range = range_of([line, column, end_line, end_column]);
        assert_eq!(offset(&self.text, line as usize, column as usize, self.in_bytes), start);
        self.text.replace_range(start..end, insert);
        json!({ "range": range, "text": insert })
    }
}

const PIECES: [&str; 14] =
    ["", "", "G1 ", "X1.5", "\n", "N10 ", "(µm)", "日本", "😀", "G91\n", ".", "M30\n", "#100=2.\n", " "];

/// 200 changes without waiting for anything, questions among them.
fn rapid_edits(capabilities: &serde_json::Value, in_bytes: bool, seed: u64) {
    let start = "%\nO1 (µ 日本 😀)\nG21 G90 G94 G54\nG0 X1. (é)\nG1 X2. F100.\nM30\n%\n".repeat(40);
    let mut session = Session::with(capabilities, &[]);
    session.open("a.nc", &start);
    // The server has something to do meanwhile.
    session.open("b.nc", &gcheck_testkit::inputs::macros(5_000));
    let mut mirror = Mirror::new(&start, in_bytes);
    let mut dice = Dice(seed);
    for version in 2..202 {
        let changes: Vec<_> = (0..=dice.below(3)).map(|_| mirror.random_edit(&mut dice, &PIECES)).collect();
        session.change("a.nc", version, &json!(changes));
        if version % 10 == 0 {
            let at = session.at("a.nc", 3, 1);
            session.client.send_request("textDocument/hover", at);
        }
    }
    assert_eq!(session.text("a.nc"), mirror.text);
    let last = session.published("a.nc", 201);
    let mut fresh = Session::with(capabilities, &[]);
    fresh.open("a.nc", &mirror.text);
    assert_eq!(fresh.published("a.nc", 1), last, "as if it were opened so");
}

#[test]
fn two_hundred_edits_in_a_hurry_with_utf_16() {
    rapid_edits(&usual(), false, 1);
}

#[test]
fn two_hundred_edits_in_a_hurry_with_utf_8() {
    rapid_edits(&in_bytes(), true, 2);
}

#[test]
fn the_whole_text_may_be_sent_anew() {
    let mut session = Session::new(&[]);
    session.open("a.nc", "G0 X1.\n");
    session.change(
        "a.nc",
        2,
        &json!([{ "text": "G1\n" }, { "range": range_of([0, 2, 0, 2]), "text": " Y1." }]),
    );
    assert_eq!(session.text("a.nc"), "G1 Y1.\n");
}

#[test]
fn ends_of_lines_of_all_kinds_are_counted() {
    let mut session = Session::new(&[]);
    session.open("a.nc", "G0\rG1\r\nG2\n");
    session.edit("a.nc", 2, [1, 2, 1, 2], " X1.");
    session.edit("a.nc", 3, [2, 0, 2, 2], "G3");
    session.edit("a.nc", 4, [0, 2, 1, 0], "\n");
    assert_eq!(session.text("a.nc"), "G0\nG1 X1.\r\nG3\n");
}

#[test]
fn a_line_of_five_megabytes_is_a_line() {
    let mut session = Session::new(&[]);
    let line = "X1.µ".repeat(1 << 20);
    session.open("a.nc", &format!("G0\n{line}\nM30\n"));
    session.edit("a.nc", 2, [1, 4 << 20, 1, 4 << 20], " Y1.\nG1 ");
    session.edit("a.nc", 3, [1, 4, 1, 4 << 20], "");
    let at = session.at("a.nc", 1, 3);
    session.client.request("textDocument/hover", at);
    assert_eq!(session.text("a.nc"), "G0\nX1.µ Y1.\nG1 \nM30\n");
    session.published("a.nc", 3);
}
