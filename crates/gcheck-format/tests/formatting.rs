//! What formatting makes of lines, and what it leaves alone.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use expect_test::{Expect, expect};
use gcheck_diagnostics::{Edit, apply};
use gcheck_format::{
    Indentation, LeadingZeros, LetterCase, SequenceNumbers, Style, TrailingZeros, WordSpacing, format,
    formatted,
};
use gcheck_program::Dialect;
use gcheck_syntax::SourceText;

fn edits(control: &str, style: Option<&Style>, text: &str, lines: Option<std::ops::Range<u32>>) -> Vec<Edit> {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let own = Style::of(&control);
    format(text, &dialect, style.unwrap_or(&own), lines)
}

/// Formats, and makes sure that a second time changes nothing.
fn tidy(control: &str, style: Option<&Style>, text: &str) -> String {
    let once = apply(text, &edits(control, style, text, None));
    assert_eq!(
        apply(&once, &edits(control, style, &once, None)),
        once,
        "formatting twice is formatting once"
    );
    once
}

/// What a control's own style makes of a text.
fn check(control: &str, text: &str, expected: &Expect) {
    expected.assert_eq(&tidy(control, None, text));
}

fn with(style: &Style, text: &str) -> String {
    tidy("haas-mill", Some(style), text)
}

#[test]
fn words_get_one_blank_and_capital_letters() {
    check(
        "haas-mill",
        "%\no1000 (Part)\nN10g21 G90G17\n  t1   m6\t\ng0x1.y-2.5 (move)\n/g1 z-.5f200.;\nM30\n%\n",
        &expect![[r#"
            %
            O1000 (Part)
            N10 G21 G90 G17
              T1 M6
            G0 X1. Y-2.5 (move)
            /G1 Z-.5 F200.;
            M30
            %
        "#]],
    );
}

#[test]
fn where_both_cases_are_customary_they_stay() {
    check(
        "linuxcnc",
        "g0x1 Y2;Comment  stays   \no100 sub\no100 endsub\n",
        &expect![[r#"
            g0 x1 Y2;Comment  stays   
            o100 sub
            o100 endsub
        "#]],
    );
}

#[test]
fn comments_texts_names_and_mistakes_stay_byte_for_byte() {
    check(
        "fanuc-mill",
        "O0001(a  b)\ng1 x1. (c)  (d)\nDPRNT[x  #1[53]  ]\nG1  X1.2.3  y2.\nG1  X  y2.\n(open\ng1  ( a (b) )  x1\n",
        &expect![[r#"
            O0001(a  b)
            G1 X1. (c)  (d)
            DPRNT[x  #1[53]  ]
            G1  X1.2.3  y2.
            G1  X  y2.
            (open
            g1  ( a (b) )  x1
        "#]],
    );
    check(
        "linuxcnc",
        "O<Probe  Me> CALL [1]   [2]\n#<Tool  Nr>=1\n(MSG,  x  )\n",
        &expect![[r#"
            O<Probe  Me> CALL [1]   [2]
            #<Tool  Nr>=1
            (MSG,  x  )
        "#]],
    );
}

#[test]
fn statements_keep_their_inner_blanks_and_get_capital_letters() {
    check(
        "haas-mill",
        "#1 = #2+sin[ 30. ]\nif [#1 eq 2] goto 10\nn10while[#1 lt 3]do1\nend1\nif[#1 GT 1]then g1  x1.\nx #1 y [#2+1.]  z - .5\n",
        &expect![[r#"
            #1 = #2+SIN[ 30. ]
            IF [#1 EQ 2] GOTO 10
            N10 WHILE[#1 LT 3]DO1
            END1
            IF[#1 GT 1]THEN G1  X1.
            X#1 Y[#2+1.] Z-.5
        "#]],
    );
}

#[test]
fn what_stands_behind_the_last_tape_mark_is_left_alone() {
    check(
        "haas-mill",
        "%\ng0x1.\n\n\n\n%  \nnotes:  g0x1.\n\n\n\n",
        &expect![[r#"
            %
            G0 X1.

            %  
            notes:  g0x1.



        "#]],
    );
}

#[test]
fn blank_lines_are_counted_and_stay_behind_a_directive() {
    let style = Style { blank_lines: 0, ..Style::KEEP };
    let text = "\n\nG0 X1.\n\n\n(gcheck: ignore words - as the shop wants it)\n\n\nG0 X2.\n\n";
    expect![[r#"

        G0 X1.
        (gcheck: ignore words - as the shop wants it)

        G0 X2.
    "#]]
    .assert_eq(&with(&style, text));
    assert_eq!(with(&Style { blank_lines: 2, ..style }, "G0\n\n\n\n\nG1\n"), "G0\n\n\nG1\n");
    assert_eq!(with(&Style::KEEP, "G0 \n \n\n\n\n"), "G0 \n \n\n\n\n");
}

#[test]
fn blank_lines_stay_where_a_program_asks_for_the_number_of_its_line() {
    let text = "G0 X1\n\n\n\nG0 X#< _LINE >\n";
    assert_eq!(tidy("linuxcnc", None, text), text);
    assert_eq!(tidy("linuxcnc", None, "G0 X#<_lines>\n\n\n\n"), "G0 X#<_lines>\n\n");
}

#[test]
fn a_byte_order_mark_stays_wherever_it_stands() {
    check(
        "haas-mill",
        "\u{FEFF}g0x1.\n\u{FEFF}  \ng0 \u{FEFF} x2.\n",
        &expect![[r#"
        ﻿G0 X1.
        ﻿
        g0 ﻿ x2.
    "#]],
    );
}

#[test]
fn line_ends_stay() {
    check("haas-mill", "g0x1.\r\n\r\n\r\n\r\nx2. \rx3.", &expect![["G0 X1.\r\n\r\nX2.\rX3."]]);
}

#[test]
fn leading_zeros_of_codes_are_added_or_dropped() {
    let text = "G0 G1 G01 G001 G54.1 G65 P01 M3 M03 T0101 X01. N0010\n";
    let style = |leading_zeros| Style { leading_zeros, ..Style::KEEP };
    assert_eq!(
        with(&style(LeadingZeros::Add), text),
        "G00 G01 G01 G01 G54.1 G65 P01 M03 M03 T0101 X01. N0010\n"
    );
    assert_eq!(with(&style(LeadingZeros::Drop), text), "G0 G1 G1 G1 G54.1 G65 P01 M3 M3 T0101 X01. N0010\n");
    assert_eq!(with(&style(LeadingZeros::Drop), "G00 M00 G04 P1\n"), "G0 M0 G4 P1\n");
    assert_eq!(with(&style(LeadingZeros::Add), "IF [#1 EQ 1] THEN M3\n"), "IF [#1 EQ 1] THEN M03\n");
}

#[test]
fn a_decimal_point_is_neither_added_nor_taken_away() {
    let style = Style { trailing_zeros: TrailingZeros::Drop, ..Style::KEEP };
    assert_eq!(
        with(&style, "X1.500 Y-2.000 Z.0 A0.0 B+.50 I100 J0 K1. F200.00\n"),
        "X1.5 Y-2. Z.0 A0. B+.5 I100 J0 K1. F200.\n"
    );
    assert_eq!(with(&style, "G54.10 T1.0 H1.0 D10.0 M3.0\n"), "G54.10 T1.0 H1.0 D10.0 M3.0\n");
}

#[test]
fn blanks_between_words_are_taken_away_where_nothing_hangs_on_them() {
    let style = Style { word_spacing: WordSpacing::None, ..Style::KEEP };
    expect![[r#"
        N10G1X1.Y2. (A) (B)
        N20 IF [#1 EQ 1] GOTO 10
        /2 G0X1.
        /G0X1.Y[#1]Z#2
        N30 #1=2
        X1. /2 G0
    "#]]
    .assert_eq(&with(
        &style,
        "N10 G1 X1.  Y2. (A) (B)\nN20 IF [#1 EQ 1] GOTO 10\n/2 G0 X1.\n/G0 X1. Y[#1] Z #2\nN30 #1=2\nX1. /2 G0\n",
    ));
}

#[test]
fn a_number_with_blanks_inside_stays_as_it_is() {
    let style =
        Style { trailing_zeros: TrailingZeros::Drop, leading_zeros: LeadingZeros::Add, ..Style::KEEP };
    let style = Style { word_spacing: WordSpacing::One, ..style };
    assert_eq!(with(&style, "X1. 500  Y2.500\nG 1  X 1.500\n"), "X1. 500 Y2.5\nG01 X1.5\n");
}

#[test]
fn comments_and_words_stand_in_columns() {
    let style = Style { comment_column: 20, word_column: 7, word_spacing: WordSpacing::One, ..Style::KEEP };
    expect![[r#"
        O1000  (KEPT)
        N5    G0 X1.       (A)
        N1000 G0 X1.       (B) (C)
        N100000 G1 X1. Y2. Z3. (D)
        N10   (HEADING)
        (ALONE)
        X1.                (E)
    "#]]
    .assert_eq(&with(
        &style,
        "O1000  (KEPT)\nN5 G0 X1.(A)\nN1000 G0 X1.      (B)   (C)\nN100000 G1 X1. Y2. Z3. (D)\nN10 (HEADING)\n(ALONE)\nX1.      (E)\n",
    ));
    let near = Style { comment_column: 1, ..Style::KEEP };
    assert_eq!(with(&near, "X1.    (A)\nX2.(B)\n"), "X1. (A)\nX2. (B)\n");
}

#[test]
fn bodies_are_indented_by_their_depth() {
    let style = Style { indentation: Indentation::Nested(2), ..Style::KEEP };
    expect![[r#"
        O1 (MAIN)
        WHILE [#1 LT 3] DO1
          (body)
          WHILE [#2 LT 3] DO2
            N10 #2=#2+1
        /G1 X1.
          END2
        END1
        M30
        O2
        M99
    "#]]
    .assert_eq(&with(
        &style,
        "O1 (MAIN)\n WHILE [#1 LT 3] DO1\n(body)\nWHILE [#2 LT 3] DO2\nN10 #2=#2+1\n  /G1 X1.\nEND2\n END1\nM30\nO2\nM99\n",
    ));
    let text = "o1 sub\no2 if [#1 gt 1]\ng0 x1\no2 elseif [#1 gt 2]\ng0 x2\no2 else\ng0 x3\no2 endif\no3 do\ng1 x1\no3 while [#1 lt 1]\no4 while [#1 lt 1]\no4 continue\no4 endwhile\no5 repeat [3]\ng1\no5 endrepeat\no1 endsub\nm2\n";
    expect![[r#"
        o1 sub
          o2 if [#1 gt 1]
            g0 x1
          o2 elseif [#1 gt 2]
            g0 x2
          o2 else
            g0 x3
          o2 endif
          o3 do
            g1 x1
          o3 while [#1 lt 1]
          o4 while [#1 lt 1]
            o4 continue
          o4 endwhile
          o5 repeat [3]
            g1
          o5 endrepeat
        o1 endsub
        m2
    "#]]
    .assert_eq(&tidy("linuxcnc", Some(&style), text));
    let none = Style { indentation: Indentation::None, ..Style::KEEP };
    assert_eq!(with(&none, "  G0 X1.\n\t(A)\n /G1\n"), "G0 X1.\n(A)\n/G1\n");
}

#[test]
fn numbers_that_nothing_names_are_dropped() {
    let style = Style { sequence_numbers: SequenceNumbers::Drop, ..Style::KEEP };
    expect![[r#"
        O1
        G0 X1.
        N20 G0 X2.
        / G0 X3.
        /G0 X4.
        N40 (COMMENT)
        N50
        #1=2
        GOTO 20
        M30
    "#]]
    .assert_eq(&with(
        &style,
        "O1\nN10 G0 X1.\nN20 G0 X2.\n/ N30 G0 X3.\n/N35   G0 X4.\nN40 (COMMENT)\nN50\nN60 #1=2\nN70 GOTO 20\nN80 M30\n",
    ));
    for keeps_all in [
        "N0N0M97 P0\n",
        "N1 G0 ; N2 G1\n",
        "N1 #1=#4114\n",
        "N10 GOTO #1\nN20 G0\n",
        "N10 M98 P1234\nN20 G0\n",
        "N10 GOTO N20\nN20 G0\n",
        "N10 G1 X1. GOTO\nN20 G0\n",
    ] {
        assert_eq!(with(&style, keeps_all), keeps_all, "what names a block is not certain");
    }
    assert_eq!(tidy("linuxcnc", Some(&style), "N10 G0 X1\nN20 o<x> call\n"), "G0 X1\no<x> call\n");
}

#[test]
fn parameter_numbers_are_no_sequence_numbers() {
    let style = Style { sequence_numbers: SequenceNumbers::Drop, ..Style::KEEP };
    let text = "N10 G10 L2 P1 X0.\nN20 G10 L50\nN3032 R1\nN3033 R1\nG11\nN40 G0 X1.\nM30\n";
    assert_eq!(
        tidy("fanuc-mill", Some(&style), text),
        "G10 L2 P1 X0.\nG10 L50\nN3032 R1\nN3033 R1\nG11\nG0 X1.\nM30\n"
    );
}

#[test]
fn a_line_never_grows_beyond_what_the_control_takes() {
    let long = |words: usize| (0..words).map(|at| format!("#{}=1", 1000 + at)).collect::<String>();
    // Of 255 characters: 36 assignments of seven make 252, with blanks 287.
    let text = format!("{}\n", long(36));
    assert_eq!(tidy("linuxcnc", None, &text), text);
    assert_ne!(tidy("linuxcnc", None, &format!("{}\n", long(20))), format!("{}\n", long(20)));
}

#[test]
fn small_letters_are_not_written_where_they_are_not_read() {
    let style = Style { letter_case: LetterCase::Lower, ..Style::KEEP };
    assert_eq!(tidy("fanuc-mill", Some(&style), "G1 X1.\n"), "G1 X1.\n");
    assert_eq!(tidy("linuxcnc", Some(&style), "G1 X1. O1 SUB\n"), "g1 x1. o1 sub\n");
}

#[test]
fn edits_are_as_small_as_they_can_be() {
    let edit = |range, text: &str| Edit { range, text: text.to_owned() };
    assert_eq!(edits("haas-mill", None, "G1X1.  y2.\n", None), [edit(2..2, " "), edit(6..8, "Y")]);
    assert_eq!(edits("haas-mill", None, "G1 X1. Y2.\n", None), []);
}

#[test]
fn a_range_of_lines_becomes_what_the_whole_would_make_of_it() {
    let text = "g0  x1.\n\n\n\ng0  x2.\nwhile [#1 lt 3] do1\ng1x3.\nend1\ng0x4.\n";
    let style = Style { indentation: Indentation::Nested(2), blank_lines: 1, ..Style::KEEP };
    for style in [None, Some(&style)] {
        let all = edits("haas-mill", style, text, None);
        let mut start = 0;
        for (number, line) in (0..).zip(text.split_inclusive('\n')) {
            let bytes = start..start + line.len() as u32;
            let of_line: Vec<Edit> =
                all.iter().filter(|edit| bytes.contains(&edit.range.start)).cloned().collect();
            assert_eq!(edits("haas-mill", style, text, Some(number..number + 1)), of_line, "line {number}");
            start = bytes.end;
        }
        assert_eq!(edits("haas-mill", style, text, Some(0..99)), all);
        assert_eq!(edits("haas-mill", style, text, Some(50..99)), []);
    }
}

#[test]
fn bytes_that_are_no_utf_8_stay() {
    let control = gcheck_controls::load("haas-mill").unwrap();
    let dialect = Dialect::new(&control);
    let source =
        SourceText::from_bytes(b"\xEF\xBB\xBFg0x1. (D\xE9P\x1A\xFC)\r\ng1x2. (\xB5)".to_vec()).unwrap();
    let bytes = formatted(&source, &dialect, &Style::of(&control)).unwrap();
    assert_eq!(bytes, b"\xEF\xBB\xBFG0 X1. (D\xE9P\x1A\xFC)\r\nG1 X2. (\xB5)");
    let source = SourceText::from_bytes(bytes).unwrap();
    assert_eq!(formatted(&source, &dialect, &Style::of(&control)), None);
}
