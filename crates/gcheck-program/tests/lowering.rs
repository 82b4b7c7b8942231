//! What the lowering makes of blocks, and law 2: the tree and the tokens give the same blocks.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write as _;

use expect_test::{Expect, expect};
use gcheck_program::{BlockTable, Dialect, ExprIx, Op, StatementKind, Target, Value, lower, lower_tree};
use gcheck_syntax::parse;
use proptest::prelude::*;

/// The one boundary helper: a program on a control, its blocks as text.
fn check(control: &str, program: &str, expected: &Expect) {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let table = lower(program, &dialect);
    expected.assert_eq(&dump(&table, program, &dialect));
}

fn dump(table: &BlockTable, text: &str, dialect: &Dialect<'_>) -> String {
    let mut out = String::new();
    for (ix, block) in table.blocks() {
        let _ = write!(out, "{:?}", &text[block.range.start as usize..block.range.end as usize]);
        if block.delete > 0 {
            let _ = write!(out, " delete {}", block.delete);
        }
        let _ = writeln!(out, " {:?}", block.flags);
        for word in table.words(block) {
            let _ = write!(out, "  {} = ", word.letter);
            let _ = match word.value {
                Value::Number(number) => {
                    let decimals = if word.shape.point {
                        format!(" ({} decimals)", word.shape.decimals)
                    } else {
                        String::new()
                    };
                    write!(out, "{number}{decimals}")
                }
                Value::Expr(expr) => write!(out, "{}", ops(table, expr, text)),
                Value::Missing => write!(out, "nothing"),
            };
            let code = dialect.control().code_at(word.code).map(|code| format!("  {}", code.number()));
            let _ = writeln!(out, "{}", code.unwrap_or_default());
        }
        for statement in table.statements(ix) {
            let show = |expr: &Option<ExprIx>| expr.map_or("nothing".to_owned(), |e| ops(table, e, text));
            let kind = match &statement.kind {
                StatementKind::Assign { target, value } => {
                    let target = match target {
                        Target::Variable(number) => format!("#{number}"),
                        Target::Named(range) => {
                            format!("#<{}>", &text[range.start as usize..range.end as usize])
                        }
                        Target::Computed(expr) => format!("#[{}]", ops(table, *expr, text)),
                        Target::Invalid => "nothing".to_owned(),
                    };
                    format!("{target} := {}", show(value))
                }
                StatementKind::If { condition } => format!("if {}", show(condition)),
                StatementKind::Guard { condition } => format!("guard {}", show(condition)),
                StatementKind::Goto { target } => format!("goto {}", show(target)),
                StatementKind::Do { condition, number } => {
                    format!("do {} while {}", show(number), show(condition))
                }
                StatementKind::End { number } => format!("end {}", show(number)),
                StatementKind::OWord { label, keyword, arguments } => {
                    let arguments: Vec<_> =
                        StatementKind::arguments(arguments).map(|e| ops(table, e, text)).collect();
                    format!("{label:?} {} {arguments:?}", keyword.name())
                }
                StatementKind::Print => "print".to_owned(),
                StatementKind::Command => "command".to_owned(),
            };
            let _ = writeln!(
                out,
                "  {:?}: {kind}",
                &text[statement.range.start as usize..statement.range.end as usize]
            );
        }
        for error in table.errors(ix) {
            let _ = writeln!(
                out,
                "  ! {:?} {:?}",
                error.kind,
                &text[error.range.start as usize..error.range.end as usize]
            );
        }
    }
    out
}

fn ops(table: &BlockTable, expr: ExprIx, text: &str) -> String {
    let expr = table.expr(expr);
    let mut out: Vec<String> = table
        .ops(expr)
        .iter()
        .map(|op| match op {
            Op::Number(number) => number.to_string(),
            Op::Variable(number) => format!("#{number}"),
            Op::Named { start, end } => format!("#<{}>", &text[*start as usize..*end as usize]),
            Op::Indirect => "read".to_owned(),
            Op::Negate => "neg".to_owned(),
            Op::Binary(op) => format!("{op:?}").to_lowercase(),
            Op::Call(function, arguments) => format!("{}/{arguments}", function.name()),
        })
        .collect();
    if !expr.well_formed {
        out.push("(ill-formed)".to_owned());
    }
    out.join(" ")
}

#[test]
fn plain_motion_asks_for_no_attention() {
    check(
        "haas-mill",
        "X1.5 Y-.25\n\n  Z0\n",
        &expect![[r#"
            "X1.5 Y-.25" BlockFlags(0x0)
              X = 1.5 (1 decimals)
              Y = -0.25 (2 decimals)
            "  Z0" BlockFlags(0x0)
              Z = 0
        "#]],
    );
}

#[test]
fn blanks_may_part_the_comma_of_a_corner_word_from_it() {
    check(
        "fanuc-mill",
        "G1 X50. , R 15.\nX0. ,  C[#1]\nY5., RADIUS\n",
        &expect![[r#"
        "G1 X50. , R 15." BlockFlags(CODE)
          G = 1  G1
          X = 50 (0 decimals)
          ,R = 15 (0 decimals)
        "X0. ,  C[#1]" BlockFlags(EXPRESSION)
          X = 0 (0 decimals)
          ,C = #1
        "Y5., RADIUS" BlockFlags(ERROR)
          Y = 5 (0 decimals)
          ! Unexpected ","
          ! Unexpected "RADIUS"
    "#]],
    );
}

#[test]
fn text_that_no_code_is_in_reads_like_a_remark() {
    check(
        "fanuc-mill",
        "G37 Länge messen über Maß\nMOVE TO THE START X1.\nX1. Y\nX1. FOO\n",
        &expect![[r#"
        "G37 Länge messen über Maß" BlockFlags(CODE | ERROR | UNREAD_WORD | REMARK)
          G = 37  G37
          L = nothing
          ! AddressWithoutValue "L"
          ! Unexpected "ä"
          ! Unexpected "nge messen über Maß"
        "MOVE TO THE START X1." BlockFlags(ERROR | REMARK)
          X = 1 (0 decimals)
          ! Unexpected "MOVE TO THE START"
        "X1. Y" BlockFlags(ERROR)
          X = 1 (0 decimals)
          Y = nothing
          ! AddressWithoutValue "Y"
        "X1. FOO" BlockFlags(ERROR)
          X = 1 (0 decimals)
          ! Unexpected "FOO"
    "#]],
    );
}

#[test]
fn codes_are_resolved_and_numbers_keep_their_shape() {
    check(
        "haas-mill",
        "N10 G01 x1 F100 G999 M6.5\n",
        &expect![[r#"
        "N10 G01 x1 F100 G999 M6.5" BlockFlags(CODE | UNKNOWN_CODE | UNPOINTED | LABEL)
          N = 10
          G = 1  G1
          X = 1
          F = 100
          G = 999
          M = 6.5 (1 decimals)
    "#]],
    );
    check(
        "linuxcnc",
        "g38.2 z-1. 5 f 100\n",
        &expect![[r#"
            "g38.2 z-1. 5 f 100" BlockFlags(CODE | DIVIDED_NUMBER)
              G = 38.2 (1 decimals)  G38.2
              Z = -1.5 (1 decimals)
              F = 100
        "#]],
    );
}

#[test]
fn addresses_take_expressions_in_every_form() {
    check(
        "fanuc-mill",
        "X#1 Y-#2 Z[#1+2.*3] A##5 B#[#1+1] C[-ATAN[#1]/[2.]]\n",
        &expect![[r#"
        "X#1 Y-#2 Z[#1+2.*3] A##5 B#[#1+1] C[-ATAN[#1]/[2.]]" BlockFlags(EXPRESSION)
          X = #1
          Y = #2 neg
          Z = #1 2 3 multiply add
          A = #5 read
          B = #1 1 add read
          C = #1 2 ATAN/2 neg
    "#]],
    );
}

#[test]
fn logic_binds_as_the_control_says() {
    check(
        "fanuc-mill",
        "IF [#1 EQ 1 OR #2 EQ 2] GOTO 10\n",
        &expect![[r#"
        "IF [#1 EQ 1 OR #2 EQ 2] GOTO 10" BlockFlags(STATEMENT)
          "IF [#1 EQ 1 OR #2 EQ 2]": if #1 1 #2 or equal 2 equal
          "GOTO 10": goto 10
    "#]],
    );
    check(
        "linuxcnc",
        "o1 if [#1 EQ 1 OR #2 EQ 2]\n",
        &expect![[r##"
        "o1 if [#1 EQ 1 OR #2 EQ 2]" BlockFlags(STATEMENT)
          "o1 if [#1 EQ 1 OR #2 EQ 2]": Number(1) IF ["#1 1 equal #2 2 equal or"]
    "##]],
    );
}

#[test]
fn macro_statements() {
    check(
        "haas-mill",
        "#100=#101+1.\nIF [#1 LT 2] THEN #3=4.\nIF [#9 EQ #0] #9=#4109\nWHILE [#1 GT 0] DO1\nEND1\nGOTO#5\n[#1 LT 10] M99 P10\nDPRNT[X#100[53]]\n#[#2+1]=5.\n#3000=1 (STOP)\n",
        &expect![[r##"
            "#100=#101+1." BlockFlags(STATEMENT)
              "#100=#101+1.": #100 := #101 1 add
            "IF [#1 LT 2] THEN #3=4." BlockFlags(STATEMENT)
              "IF [#1 LT 2] THEN": if #1 2 less
              "#3=4.": #3 := 4
            "IF [#9 EQ #0] #9=#4109" BlockFlags(STATEMENT)
              "IF [#9 EQ #0]": if #9 #0 equal
              "#9=#4109": #9 := #4109
            "WHILE [#1 GT 0] DO1" BlockFlags(STATEMENT)
              "WHILE [#1 GT 0] DO1": do 1 while #1 0 greater
            "END1" BlockFlags(STATEMENT)
              "END1": end 1
            "GOTO#5" BlockFlags(STATEMENT)
              "GOTO#5": goto #5
            "[#1 LT 10] M99 P10" BlockFlags(CODE | STATEMENT)
              M = 99  M99
              P = 10
              "[#1 LT 10]": guard #1 10 less
            "DPRNT[X#100[53]]" BlockFlags(STATEMENT)
              "DPRNT[X#100[53]]": print
            "#[#2+1]=5." BlockFlags(STATEMENT)
              "#[#2+1]=5.": #[#2 1 add] := 5
            "#3000=1 (STOP)" BlockFlags(STATEMENT | COMMENT)
              "#3000=1": #3000 := 1
        "##]],
    );
}

#[test]
fn o_words() {
    check(
        "linuxcnc",
        "o<My Sub> sub\no100 call [1] [#<_x>+2]\no[#1] call\no<my sub> endsub [5]\no2 repeat [3]\n#<a b> = [#5 ** 2]\n",
        &expect![[r##"
            "o<My Sub> sub" BlockFlags(STATEMENT)
              "o<My Sub> sub": Name("mysub") SUB []
            "o100 call [1] [#<_x>+2]" BlockFlags(STATEMENT)
              "o100 call [1] [#<_x>+2]": Number(100) CALL ["1", "#<_x> 2 add"]
            "o[#1] call" BlockFlags(STATEMENT)
              "o[#1] call": Computed CALL ["#1"]
            "o<my sub> endsub [5]" BlockFlags(STATEMENT)
              "o<my sub> endsub [5]": Name("mysub") ENDSUB ["5"]
            "o2 repeat [3]" BlockFlags(STATEMENT)
              "o2 repeat [3]": Number(2) REPEAT ["3"]
            "#<a b> = [#5 ** 2]" BlockFlags(STATEMENT)
              "#<a b> = [#5 ** 2]": #<a b> := #5 2 power
        "##]],
    );
}

#[test]
fn blanks_do_not_count_in_numbers_and_arguments() {
    check(
        "linuxcnc",
        "g 0 x 1 . 5 y - 2 z . 5\nX1 . 5 Y[1 0 + . 5] Z[2 * * 3]\no1 call [1] (between) [2 .] (behind)\nX1 . 5 . 5\n",
        &expect![[r#"
            "g 0 x 1 . 5 y - 2 z . 5" BlockFlags(CODE | DIVIDED_NUMBER)
              G = 0  G0
              X = 1.5 (1 decimals)
              Y = -2
              Z = 0.5 (1 decimals)
            "X1 . 5 Y[1 0 + . 5] Z[2 * * 3]" BlockFlags(EXPRESSION | DIVIDED_NUMBER)
              X = 1.5 (1 decimals)
              Y = 10 0.5 add
              Z = 2 3 power
            "o1 call [1] (between) [2 .] (behind)" BlockFlags(STATEMENT | COMMENT)
              "o1 call [1] (between) [2 .]": Number(1) CALL ["1", "2"]
            "X1 . 5 . 5" BlockFlags(ERROR | DIVIDED_NUMBER)
              X = 15.5 (1 decimals)
              ! MalformedNumber "X1 . 5 . 5"
        "#]],
    );
    check(
        "haas-mill",
        "X1 . 5\nX\u{b}8 Y\u{c}8\n",
        &expect![[r#"
            "X1 . 5" BlockFlags(DIVIDED_NUMBER)
              X = 1.5 (1 decimals)
            "X\u{b}8 Y\u{c}8" BlockFlags(UNPOINTED)
              X = 8
              Y = 8
        "#]],
    );
}

#[test]
fn mistakes_leave_the_rest_of_the_block_readable() {
    check(
        "haas-mill",
        "G1 X Y2. (open\nX1.2.3 Z#1+2 [1 Y5.\n#1 2\n",
        &expect![[r##"
            "G1 X Y2. (open" BlockFlags(CODE | ERROR | COMMENT)
              G = 1  G1
              X = nothing
              Y = 2 (0 decimals)
              ! AddressWithoutValue "X"
              ! UnclosedComment "(open"
            "X1.2.3 Z#1+2 [1 Y5." BlockFlags(ERROR | STATEMENT | EXPRESSION)
              X = 1.2 (1 decimals)
              Z = #1
              Y = 5 (0 decimals)
              "[1": guard 1
              ! MalformedNumber ".3"
              ! NeedsBrackets "+2"
              ! UnclosedBracket "["
            "#1 2" BlockFlags(ERROR | STATEMENT)
              "#1": nothing := nothing
              ! MissingEquals "#1"
              ! ValueWithoutAddress "2"
        "##]],
    );
}

#[test]
fn a_semicolon_ends_the_block_or_starts_a_comment() {
    check(
        "fanuc-mill",
        "G0 X1.;G1 Y2.;\nM30;(end)\nT1 ; tool one\n",
        &expect![[r#"
            "G0 X1." BlockFlags(CODE)
              G = 0  G0
              X = 1 (0 decimals)
            "G1 Y2." BlockFlags(CODE)
              G = 1  G1
              Y = 2 (0 decimals)
            "M30;(end)" BlockFlags(CODE | COMMENT)
              M = 30  M30
            "T1 ; tool one" BlockFlags(ERROR)
              T = 1
              ! TextAfterEndOfBlock "tool one"
        "#]],
    );
    check(
        "linuxcnc",
        "G0 X1 ; G1 Y2\n",
        &expect![[r#"
        "G0 X1 ; G1 Y2" BlockFlags(CODE | COMMENT)
          G = 0  G0
          X = 1
    "#]],
    );
}

#[test]
fn block_delete_levels() {
    check(
        "fanuc-mill",
        "/G0\n/3 X1.\nN5 /2 Y1.\nX1. /Y2.\n",
        &expect![[r#"
            "/G0" delete 1 BlockFlags(CODE | BLOCK_DELETE)
              G = 0  G0
            "/3 X1." delete 3 BlockFlags(BLOCK_DELETE)
              X = 1 (0 decimals)
            "N5 /2 Y1." delete 2 BlockFlags(LABEL | BLOCK_DELETE)
              N = 5
              Y = 1 (0 decimals)
            "X1. /Y2." delete 1 BlockFlags(BLOCK_DELETE)
              X = 1 (0 decimals)
              Y = 2 (0 decimals)
        "#]],
    );
}

/// Pieces that statements and expressions are made of, so that random programs reach deep into the grammar.
fn piece() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "G1",
        "X1.",
        "Y-.5",
        "X 1. 5",
        "N10",
        "O100",
        "o100",
        "T#1",
        "Z[#1+2]",
        "#1=",
        "#<a>",
        "=",
        "#100",
        "##2",
        "#[",
        "[",
        "]",
        "1.",
        "+",
        "-",
        "*",
        "/",
        "**",
        " EQ ",
        " AND ",
        " OR ",
        " MOD ",
        "SIN",
        "ATAN",
        "IF",
        "THEN",
        "GOTO",
        "WHILE",
        "DO1",
        "END1",
        " sub",
        " endsub",
        " call",
        " if",
        " while",
        " return",
        "DPRNT[A#1[53]]",
        "POPEN",
        "(note)",
        "(open",
        ")",
        ";",
        "%",
        "\n",
        "\n",
        "\r\n",
        " ",
        "/1",
        ",R1.",
        ", R1.",
        " , C ",
        "@1",
        "$0",
        "O<a b>",
        "O[#1]",
        ":12",
        "µ",
        "X",
        "gcheck:",
    ])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3_000))]

    /// Law 2 of the architecture.
    #[test]
    fn the_tree_and_the_tokens_give_the_same_blocks(pieces in prop::collection::vec(piece(), 0..60)) {
        let text = pieces.concat();
        for name in ["fanuc-mill", "linuxcnc"] {
            let control = gcheck_controls::load(name).unwrap();
            let dialect = Dialect::new(&control);
            let flat = lower(&text, &dialect);
            let tree = lower_tree(&parse(&text, dialect.profile()), &text, &dialect);
            prop_assert_eq!(&flat, &tree, "{} on {:?}", name, text);
        }
    }

    /// Law 2 where lines of words alone are read without tokens, and where they just fail to be such lines.
    #[test]
    fn lines_read_without_tokens_are_what_tokens_give(
        text in "([GXNmo@,][-+]?[0-9]{0,2}[.]?[0-9]{0,18}[ \\t]?|[-+. 0-9G]|\r?\n|\r|[(;%é]){0,40}",
    ) {
        let control = gcheck_controls::load("fanuc-mill").unwrap();
        let dialect = Dialect::new(&control);
        let flat = lower(&text, &dialect);
        let tree = lower_tree(&parse(&text, dialect.profile()), &text, &dialect);
        prop_assert_eq!(&flat, &tree, "{:?}", text);
    }
}

#[test]
fn signs_of_the_serial_line_are_passed_over() {
    let control = gcheck_controls::load("fanuc-mill").unwrap();
    let dialect = Dialect::new(&control);
    for (text, mistakes) in
        [("\0\0\0", 0), ("G0 X1.\u{11}\n\u{13}\nM30\n\u{1A}\n", 0), ("\u{1A}G0\n", 1), ("G0 X1.~\n", 1)]
    {
        for table in [lower(text, &dialect), lower_tree(&parse(text, dialect.profile()), text, &dialect)] {
            let found: usize = table.blocks().map(|(ix, _)| table.errors(ix).count()).sum();
            assert_eq!(found, mistakes, "{text:?}");
        }
    }
}

#[test]
fn labels_of_numbers_alone_are_no_arguments() {
    check(
        "linuxcnc",
        "o[100*2] call [1]\no[200] if [#1]\no[#1] if [#2]\n",
        &expect![[r##"
            "o[100*2] call [1]" BlockFlags(STATEMENT)
              "o[100*2] call [1]": Number(200) CALL ["1"]
            "o[200] if [#1]" BlockFlags(STATEMENT)
              "o[200] if [#1]": Number(200) IF ["#1"]
            "o[#1] if [#2]" BlockFlags(STATEMENT)
              "o[#1] if [#2]": Computed IF ["#1", "#2"]
        "##]],
    );
}
