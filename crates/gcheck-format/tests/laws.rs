//! What holds for every text, on every control, in several styles: blocks are read as before, comments stay, twice is once,
//! a part is formatted as the whole; renumbered jumps lead where they led.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write as _;

use gcheck_controls::Letter;
use gcheck_diagnostics::{Edit, apply};
use gcheck_format::{
    Indentation, LeadingZeros, LetterCase, Numbering, SequenceNumbers, Style, TrailingZeros, WordSpacing,
    format, formatted, renumber,
};
use gcheck_program::{BlockTable, Dialect, ExprIx, Loaded, OLabel, Op, StatementKind, Target, Value, lower};
use gcheck_syntax::{SourceText, SyntaxKind, parse};
use proptest::prelude::*;

/// The control's own, one that packs, one that spreads out, one with small letters.
fn styles(dialect: &Dialect<'_>) -> [Style; 4] {
    let own = Style::of(dialect.control());
    let packed = Style {
        word_spacing: WordSpacing::None,
        letter_case: LetterCase::Upper,
        leading_zeros: LeadingZeros::Drop,
        trailing_zeros: TrailingZeros::Drop,
        comment_column: 1,
        blank_lines: 0,
        indentation: Indentation::None,
        ..own.clone()
    };
    let wide = Style {
        leading_zeros: LeadingZeros::Add,
        word_column: 7,
        comment_column: 30,
        blank_lines: 2,
        indentation: Indentation::Nested(3),
        ..own.clone()
    };
    let small = Style { letter_case: LetterCase::Lower, word_spacing: WordSpacing::Keep, ..own.clone() };
    [own, packed, wide, small]
}

/// Everything that a text says to the control, block by block.
fn blocks(text: &str, dialect: &Dialect<'_>) -> Vec<String> {
    let table = lower(text, dialect);
    let block = |(ix, block): (_, &gcheck_program::Block)| {
        let mut out = String::new();
        let _ = write!(out, "/{} ", block.delete);
        for word in table.words(block) {
            let value = match word.value {
                Value::Number(number) => format!("{:?}{}", number, if word.shape.point { "." } else { "" }),
                Value::Expr(expr) => expression(&table, expr, text),
                Value::Missing => "nothing".to_owned(),
            };
            let _ = write!(out, "{}={value} ", word.letter);
        }
        for statement in table.statements(ix) {
            let _ = write!(out, "{} ", self::statement(&table, &statement.kind, text));
        }
        for error in table.errors(ix) {
            let _ = write!(out, "{:?} ", error.kind);
        }
        out
    };
    table.blocks().map(block).collect()
}

fn statement(table: &BlockTable, kind: &StatementKind, text: &str) -> String {
    let name = match kind {
        StatementKind::Assign { target: Target::Named(range), .. } => {
            format!("assign {:?}", &text[range.start as usize..range.end as usize])
        }
        StatementKind::Assign { target: Target::Variable(number), .. } => format!("assign {number}"),
        StatementKind::Assign { .. } => "assign".to_owned(),
        StatementKind::If { .. } => "if".to_owned(),
        StatementKind::Guard { .. } => "guard".to_owned(),
        StatementKind::Goto { .. } => "goto".to_owned(),
        StatementKind::Do { .. } => "do".to_owned(),
        StatementKind::End { .. } => "end".to_owned(),
        StatementKind::OWord { label, keyword, .. } => {
            let label = match label {
                OLabel::Number(number) => number.to_string(),
                OLabel::Name(name) => name.clone(),
                OLabel::Computed => "computed".to_owned(),
            };
            format!("o {label} {keyword:?}")
        }
        StatementKind::Print => "print".to_owned(),
        StatementKind::Command => "command".to_owned(),
    };
    let expressions: Vec<String> = kind.expressions().map(|expr| expression(table, expr, text)).collect();
    format!("{name} {}", expressions.join(","))
}

fn expression(table: &BlockTable, expr: ExprIx, text: &str) -> String {
    let op = |op: &Op| match op {
        Op::Named { start, end } => format!("<{}>", &text[*start as usize..*end as usize]),
        op => format!("{op:?}"),
    };
    table.ops(table.expr(expr)).iter().map(op).collect::<Vec<_>>().join(" ")
}

/// The comments of a text, what it prints, and its commands to the firmware.
fn remarks(text: &str, dialect: &Dialect<'_>) -> Vec<String> {
    let tree = parse(text, dialect.profile()).syntax();
    tree.descendants_with_tokens()
        .filter(|element| {
            let is_kept = matches!(element.kind(), SyntaxKind::PRINT_STATEMENT | SyntaxKind::COMMAND);
            element.kind().is_comment() || is_kept
        })
        .map(|element| match element {
            gcheck_syntax::SyntaxElement::Node(node) => {
                let text = node.text().to_string();
                // The keyword in front of the text may become a capital one.
                text.split_once('[').map_or(String::new(), |(_, text)| text.to_owned())
            }
            gcheck_syntax::SyntaxElement::Token(token) => token.text().to_owned(),
        })
        .collect()
}

fn is_in_order(edits: &[Edit], text: &str) -> bool {
    let mut at = 0;
    edits.iter().all(|edit| {
        let fits = edit.range.start >= at
            && edit.range.start <= edit.range.end
            && text.get(edit.range.start as usize..edit.range.end as usize).is_some();
        at = edit.range.end;
        fits
    })
}

fn holds(text: &str, control: &str) {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    for style in styles(&dialect) {
        let edits = format(text, &dialect, &style, None);
        assert!(is_in_order(&edits, text), "{edits:?}\n{text:?}");
        let once = apply(text, &edits);
        let bytes = formatted(&SourceText::from(text), &dialect, &style);
        assert_eq!(bytes.unwrap_or_else(|| text.as_bytes().to_vec()), once.as_bytes(), "{text:?}");
        let twice = apply(&once, &format(&once, &dialect, &style, None));
        assert_eq!(twice, once, "twice is once: {text:?}, {style:?}");
        assert_eq!(blocks(&once, &dialect), blocks(text, &dialect), "{text:?} is {once:?}, {style:?}");
        assert_eq!(remarks(&once, &dialect), remarks(text, &dialect), "{text:?} is {once:?}");
        let mut start = 0;
        for (line, number) in lines(text).into_iter().zip(0..) {
            let end = start + line.len() as u32;
            let of_line = format(text, &dialect, &style, Some(number..number + 1));
            let expected = edits.iter().filter(|edit| (start..end).contains(&edit.range.start));
            // An edit at the end of the text belongs to its last line.
            let at_end = edits.iter().filter(|edit| edit.range.start == end && end == text.len() as u32);
            let expected: Vec<Edit> = expected.chain(at_end).cloned().collect();
            assert_eq!(of_line, expected, "line {number} of {text:?}, {style:?}");
            start = end;
        }
    }
    drops_only_numbers(text, &dialect);
    keeps_jumps(text, &dialect);
}

fn lines(text: &str) -> Vec<&str> {
    let mut lines = Vec::new();
    let mut rest = text;
    while !rest.is_empty() {
        let (line, behind) = rest.split_at(gcheck_syntax::line_len(rest.as_bytes()));
        lines.push(line);
        rest = behind;
    }
    lines
}

fn drops_only_numbers(text: &str, dialect: &Dialect<'_>) {
    let style = Style { sequence_numbers: SequenceNumbers::Drop, ..Style::of(dialect.control()) };
    let once = apply(text, &format(text, dialect, &style, None));
    assert_eq!(apply(&once, &format(&once, dialect, &style, None)), once, "twice is once: {text:?}");
    let without = |text: &str| -> Vec<String> {
        let is_number = |word: &&str| word.starts_with("N=");
        let block =
            |block: String| block.split(' ').filter(|word| !is_number(word)).collect::<Vec<_>>().join(" ");
        blocks(text, dialect).into_iter().map(block).collect()
    };
    assert_eq!(without(&once), without(text), "{text:?} is {once:?}");
}

/// The blocks that jumps name, by their places among all blocks.
fn targets(text: &str, dialect: &Dialect<'_>) -> Vec<Option<u32>> {
    let mut file_index = gcheck_program::FileIndex::default();
    let end = gcheck_program::code_region(text).end as u32;
    let mut starts = Vec::new();
    let loaded = Loaded::new(text, dialect, |base, table, _| {
        file_index.add(table, base, end, dialect);
        starts.extend(table.blocks().map(|(_, block)| base + block.range.start));
    });
    let graph = loaded.flow_graph();
    let from = |at: u32| starts.partition_point(|start| *start <= at).saturating_sub(1) as u32;
    file_index.jumps.iter().map(|jump| graph.label(jump.target?, from(jump.range.start), true)).collect()
}

fn keeps_jumps(text: &str, dialect: &Dialect<'_>) {
    let numbering = Numbering { start: 5, step: 5 };
    let Ok(edits) = renumber(text, dialect, &numbering) else { return };
    assert!(is_in_order(&edits, text), "{edits:?}\n{text:?}");
    let once = apply(text, &edits);
    assert_eq!(renumber(&once, dialect, &numbering), Ok(Vec::new()), "twice is once: {text:?}");
    // A jump back to the program that calls leads to another program, which is not looked at here.
    if !text.to_ascii_uppercase().contains("M99") {
        assert_eq!(targets(&once, dialect), targets(text, dialect), "{text:?} is {once:?}");
    }
    let style = Style::KEEP;
    assert_eq!(format(&once, dialect, &style, None), [], "keeping everything changes nothing");
}

const CONTROLS: [&str; 7] =
    ["haas-mill", "haas-lathe", "fanuc-mill", "fanuc-lathe", "linuxcnc", "generic-mill", "tsnc-yh-a1m"];

/// Pieces of blocks, sensible ones more often than others.
fn piece() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => "[GgMm](0{0,2}[0-9]|[0-9]{2}|54\\.1)",
        6 => "[XYZIJKRFABCxyz][-+]?[0-9]{0,3}\\.?0{0,2}[0-9]{0,2}0{0,2}",
        2 => "[XYZPQD] ?[-+]? ?(#1|\\[#2\\*2\\.0\\]|1\\.50|\\.50)",
        5 => "[ \t]{1,3}",
        4 => Just("\n".to_owned()),
        1 => "(\r\n|\r|\n\n\n|\n \n\t\n)",
        2 => "[Nn]0?[0-9]{1,2}",
        1 => "(T0101|H01|D1|S1000|L2|,R2\\.0|@1\\.50|O100|:0200|O<a  B>)",
        1 => "(/|/2|/ |;|%)",
        2 => "\\((a  B|gcheck: ignore all - x|MSG, x )\\)",
        1 => "(\\(\\(|\\)|\\(a|;  rest  |é|\u{1A}|\u{FEFF})",
        1 => "(#1=#2\\+1\\.0|#<x y>=\\[1\\]|#\\[1\\+1\\]=2|#1 = sin\\[ 30\\.0 \\])",
        1 => "(IF\\[#1EQ1\\]GOTO 10|if \\[#1 gt 2\\] then g1x1|GOTO#1|GOTO 1|WHILE\\[#1LT2\\]DO1|END 1|DPRNT\\[x  y#1\\[53\\]\\])",
        1 => "(o1 sub|O1 ENDSUB|o2 if \\[1\\]|o2 else if \\[2\\]|o2 endif|o3 do|o3 while \\[1\\]|o4 while\\[1\\]|o4 endwhile|o<x> call \\[1\\]  \\[2\\])",
        1 => "(M97 P1|M98 P2|M99 P1|M99|M30|G71 P1 Q2|G10 L50|G11|G65 P9010 A1\\. B01)",
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_500))]

    #[test]
    fn for_pieces_of_programs(pieces in prop::collection::vec(piece(), 0..50), control in 0..CONTROLS.len()) {
        holds(&pieces.concat(), CONTROLS[control]);
    }

    #[test]
    fn for_any_text(text in "([ -~]|[GXN0-9. ]|\r?\n|\\PC){0,60}", control in 0..CONTROLS.len()) {
        holds(&text, CONTROLS[control]);
    }

    #[test]
    fn for_any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..80)) {
        let source = SourceText::from_bytes(bytes.clone()).unwrap();
        for control in ["haas-mill", "linuxcnc"] {
            holds(source.text(), control);
            let control = gcheck_controls::load(control).unwrap();
            let dialect = Dialect::new(&control);
            for style in styles(&dialect) {
                let after = formatted(&source, &dialect, &style).unwrap_or_else(|| bytes.clone());
                let strange = |bytes: &[u8]| -> Vec<u8> { bytes.iter().copied().filter(|b| *b >= 0x80).collect() };
                prop_assert_eq!(strange(&after), strange(&bytes));
            }
        }
    }
}

#[test]
fn for_every_word_that_names_a_block() {
    // A control without jumps has no word that names a block, and no control has `N` itself among them.
    for name in CONTROLS {
        let control = gcheck_controls::load(name).unwrap();
        for code in control.codes() {
            for word in &code.entry().words {
                assert!(
                    word.kind != gcheck_controls::WordKind::Label
                        || Letter::parse(&word.letter) != Some(Letter::of('N')),
                    "{name}: {}",
                    code.number()
                );
            }
        }
    }
}

/// A line may be as long as a file, and whatever is in it is laid out in a moment.
#[test]
fn for_lines_as_long_as_a_file() {
    for piece in [
        "N1 ",
        "M97P1",
        "(A)",
        "O1 SUB ",
        "o1 while[1]",
        "G10 G11 ",
        "#1=1",
        "X[1]",
        "X 1 2",
        "/",
        ";",
        "GOTO#1 ",
        "[[",
        "<",
    ] {
        for name in ["haas-mill", "fanuc-mill", "linuxcnc"] {
            let text = format!("{}\nN1 G0\n", piece.repeat(40_000));
            let control = gcheck_controls::load(name).unwrap();
            let dialect = Dialect::new(&control);
            let start = std::time::Instant::now();
            for style in styles(&dialect) {
                format(&text, &dialect, &style, None);
            }
            let dropping = Style { sequence_numbers: SequenceNumbers::Drop, ..Style::KEEP };
            format(&text, &dialect, &dropping, None);
            let _ = renumber(&text, &dialect, &Numbering { start: 1, step: 1 });
            // A minute is far from what it takes, and near to what a square would.
            assert!(start.elapsed().as_secs() < 60, "{name}: {piece} takes {:?}", start.elapsed());
        }
    }
}
