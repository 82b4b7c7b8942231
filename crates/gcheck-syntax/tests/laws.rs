//! The laws of the syntax crate, on generated text: nothing is lost, nothing panics, edits give what a fresh start gives.

use gcheck_syntax::{
    Document, MAX_EXPRESSION_DEPTH, MAX_LINE_BYTES, MAX_LINES, MAX_OPERATORS, SourceText, SyntaxErrorKind,
    SyntaxProfile, cut, parse,
};
use proptest::prelude::*;

/// Pieces of programs, good and broken, that a generator joins in any order.
fn piece() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => "[GMXYZIJKFSTHD][-+]?[0-9]{1,4}\\.?[0-9]{0,3}",
        2 => prop::sample::select(vec!["\n", "\r\n", "\r", " ", ";", "%", "/", "/1", "(", ")", "(a)", "[", "]", "#", "=", ",", "-"])
            .prop_map(str::to_owned),
        2 => prop::sample::select(vec![
            "#100", "#<_x>", "O100", "O<sub>", ":123", "IF", "THEN", "GOTO", "WHILE", "DO", "END", "CALL", "SUB", "ENDSUB", "SIN",
            "ATAN", "EQ", "AND", "MOD", "**", "DPRNT", "X", "G", ",R", "@", "\u{FEFF}", "µ", "日本", "N10", "1.", "#1=2", "[1+2]",
        ])
        .prop_map(str::to_owned),
        1 => any::<char>().prop_map(String::from),
    ]
}

fn program() -> impl Strategy<Value = String> {
    prop::collection::vec(piece(), 0..200).prop_map(|pieces| pieces.concat())
}

fn profiles() -> [SyntaxProfile; 2] {
    [SyntaxProfile::MACRO_B, SyntaxProfile::NGC]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn the_tree_is_lossless(text in program()) {
        for profile in profiles() {
            let parsed = parse(&text, profile);
            prop_assert_eq!(parsed.syntax().text().to_string(), text.as_str());
            for error in parsed.errors() {
                prop_assert!(error.range.start <= error.range.end && error.range.end as usize <= text.len());
                prop_assert!(text.is_char_boundary(error.range.start as usize));
                prop_assert!(text.is_char_boundary(error.range.end as usize));
            }
        }
    }

    #[test]
    fn bytes_survive_decoding(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let source = SourceText::from_bytes(bytes.clone()).map_err(|_| TestCaseError::fail("too large"))?;
        prop_assert_eq!(source.text().len(), bytes.len());
        prop_assert_eq!(source.to_bytes(), bytes);
    }
}

proptest! {
    // Long programs: fewer of them.
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn cutting_does_not_change_what_is_found(text in prop::collection::vec(piece(), 0..4000).prop_map(|p| p.concat())) {
        for profile in profiles() {
            let whole = parse(&text, profile);
            let mut errors = Vec::new();
            for range in cut(&text) {
                let offset = range.start as u32;
                for mut error in parse(&text[range], profile).errors().iter().cloned() {
                    error.range = error.range.start + offset..error.range.end + offset;
                    errors.push(error);
                }
            }
            prop_assert_eq!(whole.errors(), errors.as_slice());
        }
    }
}

/// Lines short enough that a document of a few thousand has several chunks.
fn lines() -> impl Strategy<Value = String> {
    let line = prop_oneof![
        8 => (0..5_000_u32).prop_map(|n| format!("N{n}X{}.Y{}.\n", n % 97, n % 31)),
        1 => (0..9_u32).prop_map(|n| format!("X{n}.\r")),
        1 => Just("G1\r\n".to_owned()),
        1 => Just("\n".to_owned()),
    ];
    prop::collection::vec(line, 0..3_000).prop_map(|lines| lines.concat())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn an_edited_document_is_a_fresh_one(
        text in lines(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0..200_usize, "[ -~\\r\\n]{0,40}"), 1..8),
    ) {
        let mut document = Document::new(&text);
        let mut expected = text;
        for (at, len, insert) in edits {
            let start = at.index(expected.len() + 1);
            let end = (start + len).min(expected.len());
            let before = document.clone();
            let changed = document.edit(start..end, &insert).map_err(|_| TestCaseError::fail("in range"))?;
            expected.replace_range(start..end, &insert);
            prop_assert_eq!(&document, &Document::new(&expected));
            // What the edit says is unchanged is the same text, shared.
            let kept_before = &before.chunks()[changed.old.end..];
            let kept_after = &document.chunks()[changed.new.end..];
            prop_assert_eq!(kept_before, kept_after);
            prop_assert_eq!(&before.chunks()[..changed.old.start], &document.chunks()[..changed.new.start]);
        }
    }
}

#[test]
fn an_edit_in_a_long_program_touches_few_chunks() {
    let text: String =
        (0..100_000).map(|n| format!("X{}.{} Y{}.\n", n % 713, n % 10, n * 7 % 1_001)).collect();
    let mut document = Document::new(&text);
    let chunks = document.chunks().len();
    assert!((100..400).contains(&chunks), "mean chunk of about 512 lines, not {chunks} chunks");
    let changed = document.edit(700_000..700_000, "G1 X1.\n").expect("in range");
    assert!(changed.old.len() <= 4, "{changed:?}");
}

#[test]
fn repeated_lines_are_cut_at_the_maximum() {
    let text = "X1.\n".repeat(10_000);
    let document = Document::new(&text);
    assert!(document.chunks().iter().all(|c| c.lines().count() <= MAX_LINES));
}

#[test]
fn edits_out_of_range_are_refused_and_change_nothing() {
    let mut document = Document::new("X1.\n(µ)\n");
    let before = document.clone();
    assert!(document.edit(0..100, "").is_err());
    assert!(document.edit(6..7, "").is_err(), "inside a character");
    assert_eq!(document, before);
}

#[test]
fn ten_thousand_brackets_are_one_mistake() {
    for profile in profiles() {
        for text in
            ["[".repeat(10_000), format!("#1={}1", "-".repeat(10_000)), format!("#1={}1", "#".repeat(10_000))]
        {
            let parsed = parse(&text, profile);
            assert_eq!(parsed.syntax().text().to_string(), text);
            let deep = parsed.errors().iter().filter(|e| e.kind == SyntaxErrorKind::TooDeep).count();
            assert_eq!((deep, parsed.errors().len()), (1, 1), "depth limit {MAX_EXPRESSION_DEPTH}");
        }
    }
}

#[test]
fn statements_and_operators_that_go_too_deep_are_one_mistake() {
    for text in [
        "IF[#1EQ1]THEN ".repeat(100_000),
        "IF[#1EQ1]#2=".repeat(100_000),
        format!("#1=[1{}]", "+1".repeat(100_000)),
        format!("#1={}1", "[1+2*".repeat(100_000)),
        format!("#1=[{}", "1+1**1*[".repeat(100_000)),
    ] {
        // The stack of a thread that others start.
        let read = std::thread::Builder::new().stack_size(1 << 20).spawn(move || {
            let parsed = parse(&text, SyntaxProfile::MACRO_B);
            let deep = parsed.errors().iter().filter(|e| e.kind == SyntaxErrorKind::TooDeep).count();
            assert_eq!((deep, parsed.syntax().text().to_string()), (1, text));
        });
        read.unwrap().join().unwrap();
    }
}

#[test]
fn as_many_operators_as_the_limit_are_read() {
    let line = |operators: u32| format!("#1=[1{}]\n", "+1".repeat(operators as usize));
    assert_eq!(parse(&line(MAX_OPERATORS), SyntaxProfile::MACRO_B).errors(), []);
    assert_eq!(parse(&line(MAX_OPERATORS + 1), SyntaxProfile::MACRO_B).errors().len(), 1);
    assert_eq!(
        parse(&line(600).repeat(2), SyntaxProfile::MACRO_B).errors(),
        [],
        "each line has its own count"
    );
}

#[test]
fn a_line_of_a_million_characters_is_read_once() {
    let blocks = "G0;".repeat(300_000);
    for profile in profiles() {
        assert_eq!(parse(&blocks, profile).syntax().text().to_string(), blocks);
    }
    let text = "X1.5".repeat(250_000);
    assert_eq!(parse(&text, SyntaxProfile::MACRO_B).errors(), []);
    let comments = "(a".repeat(500_000);
    assert_eq!(parse(&comments, SyntaxProfile::MACRO_B).errors().len(), 1);
}

#[test]
fn of_a_longer_line_the_rest_is_one_mistake() {
    for (line, profile) in [
        ("X1.5".repeat(300_000), SyntaxProfile::MACRO_B),
        ("G0;".repeat(500_000), SyntaxProfile::MACRO_B),
        ("#1=[1+".repeat(300_000), SyntaxProfile::NGC),
        ("text and more ".repeat(200_000), SyntaxProfile::NGC),
    ] {
        let text = format!("{line}\nG1 X1\n");
        let parsed = parse(&text, profile);
        assert_eq!(parsed.syntax().text().to_string(), text);
        let too_long: Vec<_> =
            parsed.errors().iter().filter(|error| error.kind == SyntaxErrorKind::LineTooLong).collect();
        let [error] = too_long.as_slice() else { panic!("{} mistakes", too_long.len()) };
        assert!(error.range.start.abs_diff(MAX_LINE_BYTES) < 16, "{error:?}");
        assert_eq!(error.range.end as usize, line.len());
    }
}
