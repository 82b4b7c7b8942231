//! What each lexeme of a program is, for colours.
//!
//! Knows: kinds of lexemes. Must not know: colours, delta encodings.

use std::ops::Range;

use gcheck_controls::{CodeNumber, Control, Letter, Motion};
use gcheck_db::Snapshot;
use gcheck_syntax::{SyntaxKind, line_len};

use crate::lexemes::{Lexeme, lexemes};
use crate::symbols::code_end;

/// Names of token types; [`SemanticToken::kind`] is an index.
///
/// `rapid`, `feed`, `arc` and `cycle` are codes that move so; `modal` other codes that stay in effect, `code` those for their
/// own block.
pub const TOKEN_TYPES: &[&str] = &[
    "rapid",
    "feed",
    "arc",
    "cycle",
    "modal",
    "code",
    "coordinate",
    "word",
    "tool",
    "label",
    "program",
    "comment",
    "variable",
    "keyword",
    "function",
    "number",
    "operator",
];

/// Names of modifiers; [`SemanticToken::modifiers`] has a bit for each.
pub const TOKEN_MODIFIERS: &[&str] = &["unreachable", "skippable", "definition", "readonly"];

/// A lexeme of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SemanticToken {
    /// Bytes of the file; never more than one line.
    pub range: Range<u32>,
    /// Index into [`TOKEN_TYPES`].
    pub kind: u32,
    /// Bits of [`TOKEN_MODIFIERS`].
    pub modifiers: u32,
}

/// As [`TOKEN_TYPES`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Rapid,
    Feed,
    Arc,
    Cycle,
    Modal,
    Code,
    Coordinate,
    Word,
    Tool,
    Label,
    Program,
    Comment,
    Variable,
    Keyword,
    Function,
    Number,
    Operator,
}

const UNREACHABLE: u32 = 1;
const SKIPPABLE: u32 = 1 << 1;
const DEFINITION: u32 = 1 << 2;
const READONLY: u32 = 1 << 3;

/// The lexemes of a range, or of the whole document, in text order and without overlap. Those in `unreachable`
/// ([`crate::unreachable_ranges`]), and what is after the end of the tape, are marked so.
pub fn semantic_tokens(
    snapshot: &Snapshot,
    range: Option<Range<u32>>,
    unreachable: &[Range<u32>],
) -> Vec<SemanticToken> {
    let wanted = range.unwrap_or(0..snapshot.len());
    let mut painter = Painter { snapshot, unreachable, end: code_end(snapshot), list: Vec::new() };
    for chunk in snapshot.chunks() {
        let end = chunk.base + chunk.text.len() as u32;
        if end <= wanted.start || wanted.end <= chunk.base {
            continue;
        }
        // Tokens without a tree: an editor asks for all of a file, and what a token is the token alone says.
        let (skip, len) = lines_around(chunk.text, chunk.base, &wanted);
        let lines = chunk.text.get(skip..skip + len).unwrap_or_default();
        painter.lines(&lexemes(snapshot, lines, chunk.base + skip as u32));
    }
    painter.list
}

/// Begin and length of the whole lines of a chunk that a range touches.
fn lines_around(text: &str, base: u32, wanted: &Range<u32>) -> (usize, usize) {
    let bytes = text.as_bytes();
    let from = wanted.start.saturating_sub(base) as usize;
    let to = (wanted.end.saturating_sub(base) as usize).min(bytes.len());
    let before = bytes.get(..from.min(bytes.len())).unwrap_or_default();
    let start = before.iter().rposition(|byte| matches!(byte, b'\n' | b'\r')).map_or(0, |at| at + 1);
    let end = to + line_len(bytes.get(to..).unwrap_or_default());
    (start, end.saturating_sub(start))
}

struct Painter<'s> {
    snapshot: &'s Snapshot,
    unreachable: &'s [Range<u32>],
    end: u32,
    list: Vec<SemanticToken>,
}

impl Painter<'_> {
    fn lines(&mut self, lexemes: &[Lexeme]) {
        for line in lexemes.split_inclusive(|lexeme| lexeme.kind == SyntaxKind::NEWLINE) {
            self.line(line);
        }
    }

    fn line(&mut self, line: &[Lexeme]) {
        let Some(first) = line.first() else { return };
        if first.range.start >= self.end {
            // Nobody reads what is after the tape but people.
            let last = line
                .iter()
                .rfind(|lexeme| !matches!(lexeme.kind, SyntaxKind::NEWLINE | SyntaxKind::WHITESPACE));
            self.list.extend(last.map(|last| SemanticToken {
                range: first.range.start..last.range.end,
                kind: Kind::Comment as u32,
                modifiers: UNREACHABLE,
            }));
            return;
        }
        let mut modifiers = 0;
        let index = self.unreachable.partition_point(|range| range.end <= first.range.start);
        let end = line.last().map_or(first.range.end, |last| last.range.end);
        if first.range.start >= self.end || self.unreachable.get(index).is_some_and(|range| range.start < end)
        {
            modifiers |= UNREACHABLE;
        }
        let mut solid = line.iter().filter(|lexeme| !lexeme.kind.is_trivia()).peekable();
        if solid.peek().is_some_and(|lexeme| lexeme.kind == SyntaxKind::SLASH) {
            modifiers |= SKIPPABLE;
        }
        let head = line.iter().find(|lexeme| !lexeme.kind.is_trivia() && lexeme.kind != SyntaxKind::SLASH);
        let head = head.map(|lexeme| lexeme.range.start);
        let mut letter = None;
        for lexeme in line {
            let text = self.snapshot.slice(lexeme.range.clone());
            let is_head = Some(lexeme.range.start) == head;
            if let Some((kind, more)) =
                kind(self.snapshot.control(), lexeme.kind, &text, is_head, letter.as_deref())
            {
                let modifiers = modifiers | more;
                self.list.push(SemanticToken { range: lexeme.range.clone(), kind: kind as u32, modifiers });
            }
            if !lexeme.kind.is_trivia() {
                // The number of `G 1` belongs to its address.
                letter = (lexeme.kind == SyntaxKind::LETTER).then(|| text.into_owned());
            }
        }
    }
}

/// What a token is, and modifiers of its own.
fn kind(
    control: &Control,
    token: SyntaxKind,
    text: &str,
    is_head: bool,
    letter: Option<&str>,
) -> Option<(Kind, u32)> {
    use SyntaxKind as K;
    let plain = |kind| Some((kind, 0));
    match token {
        K::COMMENT | K::BROKEN_COMMENT | K::LINE_COMMENT => plain(Kind::Comment),
        K::WORD | K::LETTER => Some(word(control, text, is_head)),
        K::NUMBER => match letter {
            Some(letter) => Some(word(control, &format!("{letter}{text}"), false)),
            None => plain(Kind::Number),
        },
        K::COLON_NUMBER => Some((Kind::Program, if is_head { DEFINITION } else { 0 })),
        K::O_NAME | K::PERCENT => plain(Kind::Program),
        K::VARIABLE => {
            let number: Option<u32> = text.trim_start_matches('#').trim_end_matches('.').parse().ok();
            let is_fixed = number.is_some_and(|number| !control.is_writable(number));
            Some((Kind::Variable, if is_fixed { READONLY } else { 0 }))
        }
        K::NAMED_VARIABLE | K::HASH => plain(Kind::Variable),
        K::FUNCTION => plain(Kind::Function),
        K::PLUS
        | K::MINUS
        | K::STAR
        | K::POWER
        | K::SLASH
        | K::EQUALS
        | K::COMPARISON
        | K::AND_KW
        | K::OR_KW
        | K::MOD_KW => plain(Kind::Operator),
        kind if kind.is_keyword() => plain(Kind::Keyword),
        _ => None,
    }
}

fn word(control: &Control, text: &str, is_head: bool) -> (Kind, u32) {
    let first = text.bytes().next().unwrap_or_default().to_ascii_uppercase();
    match first {
        b'G' | b'M' => (CodeNumber::parse(text).map_or(Kind::Code, |number| code(control, number)), 0),
        b'N' => (Kind::Label, if is_head { DEFINITION } else { 0 }),
        b'O' => (Kind::Program, if is_head { DEFINITION } else { 0 }),
        b'T' => (Kind::Tool, 0),
        // Corner words say where to, as the words of arcs do.
        b'I' | b'J' | b'K' | b'R' | b',' => (Kind::Coordinate, 0),
        _ if Letter::new(first).is_some_and(|letter| control.axes().contains(letter)) => {
            (Kind::Coordinate, 0)
        }
        _ => (Kind::Word, 0),
    }
}

fn code(control: &Control, number: CodeNumber) -> Kind {
    let Some(code) = control.code(number).filter(|code| code.entry().ends.is_none()) else {
        return Kind::Code;
    };
    match code.motion() {
        Motion::Rapid | Motion::Reference => Kind::Rapid,
        Motion::Feed | Motion::Thread | Motion::Probe => Kind::Feed,
        Motion::Arc | Motion::Curve => Kind::Arc,
        Motion::Cycle | Motion::Operation => Kind::Cycle,
        Motion::None | Motion::Dwell if code.group().modal => Kind::Modal,
        Motion::None | Motion::Dwell => Kind::Code,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};
    use std::fmt::Write as _;

    use super::{Kind, TOKEN_MODIFIERS, TOKEN_TYPES, semantic_tokens};
    use crate::fixture::Fixture;

    fn check(control: &str, text: &str, expected: &Expect) {
        let mut fixture = Fixture::new(control, text);
        let unreachable = crate::unreachable_ranges(&fixture.analysis());
        let snapshot = fixture.snapshot();
        let mut out = String::new();
        for token in semantic_tokens(&snapshot, None, &unreachable) {
            let _ = write!(out, "{} {}", snapshot.slice(token.range), TOKEN_TYPES[token.kind as usize]);
            for (bit, name) in TOKEN_MODIFIERS.iter().enumerate() {
                if token.modifiers & (1 << bit) != 0 {
                    let _ = write!(out, " {name}");
                }
            }
            out.push('\n');
        }
        expected.assert_eq(&out);
    }

    #[test]
    fn names_stand_in_the_order_of_their_numbers() {
        let last = Kind::Operator as usize;
        assert_eq!((TOKEN_TYPES[last], TOKEN_TYPES[Kind::Tool as usize]), ("operator", "tool"));
        assert_eq!(last + 1, TOKEN_TYPES.len());
    }

    #[test]
    fn codes_by_what_they_do() {
        check(
            "haas-mill",
            "%\nO1\nN10 G00 G54 X1. F5. (RAPID)\n/ T1 M6\nG2 I1.\nG81 Z-1.\nG4 P1\n%\nnotes\n",
            &expect![[r#"
                % program
                O1 program definition
                N10 label definition
                G00 rapid
                G54 modal
                X1. coordinate
                F5. word
                (RAPID) comment
                / operator skippable
                T1 tool skippable
                M6 code skippable
                G2 arc
                I1. coordinate
                G81 cycle
                Z-1. coordinate
                G4 code
                P1 word
                % program
                notes comment unreachable
            "#]],
        );
    }

    #[test]
    fn macros() {
        check(
            "fanuc-mill",
            "IF [#5021 GT 2] GOTO 10\n#100=SIN[1.]+#0\nX#100\nN10 M30\n",
            &expect![[r#"
                IF keyword
                #5021 variable readonly
                GT operator
                2 number
                GOTO keyword
                10 number
                #100 variable
                = operator
                SIN function
                1. number
                + operator
                #0 variable readonly
                X coordinate
                #100 variable
                N10 label definition
                M30 code
            "#]],
        );
        check(
            "linuxcnc",
            "o<a> call [#<b>]\nG 1 x[1**2] ; c\nM2\n",
            &expect![[r#"
            o<a> program
            call keyword
            #<b> variable
            G code
            1 feed
            x coordinate
            1 number
            ** operator
            2 number
            ; c comment
            M2 code
        "#]],
        );
    }

    #[test]
    fn what_never_runs() {
        check(
            "haas-mill",
            "O1\nGOTO 10\nX2.\nN10 M30\n",
            &expect![[r#"
            O1 program definition
            GOTO keyword
            10 number
            X2. coordinate unreachable
            N10 label definition
            M30 code
        "#]],
        );
    }

    #[test]
    fn a_range_gives_the_lines_that_it_touches() {
        let snapshot = Fixture::new("haas-mill", "G0 X1.\nG1 X2.\nG2 X3.\n").snapshot();
        let tokens = semantic_tokens(&snapshot, Some(9..10), &[]);
        let texts: Vec<_> =
            tokens.into_iter().map(|token| snapshot.slice(token.range).into_owned()).collect();
        assert_eq!(texts, ["G1", "X2."]);
    }
}
