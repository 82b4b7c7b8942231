//! Programs from bytes: as they are, from pieces of the grammar, from the codes of the knowledge base, from statements.
//!
//! Knows: how each control writes its words. Must not know: what is asked of the programs.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt::Write as _;

use gcheck_controls::{Control, Letter, Machine};
use gcheck_program::profile;
use gcheck_syntax::SyntaxProfile;

use crate::choices::Choices;
use crate::generator::{Style, Writer};

/// Longer programs say no more, and take longer.
const MOST_BYTES: usize = 16 << 10;
/// Blocks of a program that is made.
const MOST_BLOCKS: usize = 200;

/// A program and the control that reads it.
pub(crate) struct Case {
    pub(crate) control: &'static Control,
    pub(crate) text: String,
}

/// The first byte chooses the control, the second how the others become a program.
pub(crate) fn case(bytes: &[u8]) -> Case {
    let mut choices = Choices::new(bytes);
    let names = gcheck_controls::names();
    let control = control(choices.text(names));
    let text = text(control, &mut choices);
    Case { control, text }
}

/// A program for a control from all bytes that are left.
pub(crate) fn text(control: &Control, choices: &mut Choices<'_>) -> String {
    let mut text = match choices.below(5) {
        0 => String::from_utf8_lossy(choices.rest()).into_owned(),
        1 => pieces(choices),
        2 => coded(control, choices),
        3 => written(control, choices),
        _ => mixed(control, choices),
    };
    let mut end = text.len().min(MOST_BYTES);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    text.truncate(end);
    text
}

/// A control, loaded once on a thread.
fn control(name: &str) -> &'static Control {
    thread_local! {
        static CONTROLS: RefCell<HashMap<String, &'static Control>> = RefCell::default();
    }
    #[expect(
        clippy::expect_used,
        reason = "the knowledge base is part of the program, and its tests load all of it"
    )]
    CONTROLS.with_borrow_mut(|controls| {
        *controls.entry(name.to_owned()).or_insert_with(|| {
            Box::leak(Box::new(gcheck_controls::load(name).expect("every control of the list loads")))
        })
    })
}

/// Statements as the control writes them.
fn written(control: &Control, choices: &mut Choices<'_>) -> String {
    let style = if profile(control) == SyntaxProfile::NGC {
        Style::OWords
    } else if control.machine() == Machine::Lathe {
        Style::Lathe
    } else {
        match choices.below(3) {
            0 => Style::Macro,
            1 => Style::Local,
            _ => Style::FiveAxis,
        }
    };
    Writer::new(choices.rest(), style).program()
}

/// Statements, with blocks of the control's own codes between them, and some lines lost.
fn mixed(control: &Control, choices: &mut Choices<'_>) -> String {
    let length = choices.below(256);
    let mut half = Choices::new(choices.take(length));
    let statements = written(control, &mut half);
    let mut text = String::new();
    for line in statements.lines().take(MOST_BLOCKS) {
        match choices.below(8) {
            1 => block(control, choices, &mut text),
            2 => {
                text.push_str(choices.text(PIECES));
                text.push('\n');
            }
            3 => continue,
            _ => {}
        }
        text.push_str(line);
        text.push('\n');
    }
    text
}

/// Blocks of the control's own codes, with the words that they read.
fn coded(control: &Control, choices: &mut Choices<'_>) -> String {
    let mut text = String::from("%\nO1\n");
    let mut blocks = 0;
    while !choices.is_empty() && blocks < MOST_BLOCKS {
        block(control, choices, &mut text);
        blocks += 1;
    }
    text.push_str(choices.text(&["M30\n%\n", "M2\n", "M99\n", "", "M30"]));
    text
}

fn block(control: &Control, choices: &mut Choices<'_>, text: &mut String) {
    if choices.below(16) == 1 {
        text.push('/');
    }
    let codes: Vec<_> = control.codes().collect();
    for _ in 0..=choices.below(3) {
        let Some(code) = choices.one(&codes) else { continue };
        let _ = write!(text, "{} ", code.number());
        // Bits say which of the words that the code reads are there.
        let mut bits = choices.byte();
        for letter in code.reads().iter().take(24) {
            if bits & 1 == 1 {
                let _ = write!(text, "{}{} ", letter, value(choices));
            }
            bits = bits.rotate_right(1);
        }
    }
    if choices.below(2) == 1 {
        for letter in control.axes().iter() {
            if choices.below(2) == 1 {
                word(letter, choices, text);
            }
        }
    }
    text.push('\n');
}

fn word(letter: Letter, choices: &mut Choices<'_>, text: &mut String) {
    let _ = write!(text, "{letter}{} ", value(choices));
}

fn value(choices: &mut Choices<'_>) -> &'static str {
    choices.text(VALUES)
}

const VALUES: &[&str] = &[
    "1.",
    "0",
    "1",
    "2",
    "10.",
    "-1.",
    "-5.",
    "100",
    "0.5",
    "-0.001",
    "2.5",
    "3",
    "4",
    "5",
    "8",
    "90.",
    "180.",
    "-90.",
    "360.",
    "500",
    "1000",
    "99999",
    "99999999.",
    "0.00000001",
    "#1",
    "#100",
    "#101",
    "[#100+1.]",
    "[#5001]",
    "-#110",
    "[1./0]",
    "#0",
    "[#100*#101]",
    "#[#100]",
    "1000000000000000000000",
    "",
];

fn pieces(choices: &mut Choices<'_>) -> String {
    let mut text = String::new();
    let mut count = 0;
    while !choices.is_empty() && count < 4 * MOST_BLOCKS {
        text.push_str(choices.text(PIECES));
        if choices.below(3) == 1 {
            text.push('\n');
        }
        count += 1;
    }
    text
}

/// Pieces of programs, whole and broken, of all controls.
const PIECES: &[&str] = &[
    "\n",
    "%",
    "O1",
    "O0002 (PART)",
    "O",
    "N10",
    "N",
    "N10 ",
    "/",
    "/2 ",
    "G0 ",
    "G01",
    "G1 X1. ",
    "X1",
    "Y-2.5 ",
    "Z[#1+2]",
    "X#100 ",
    "G2 I1. J0. ",
    "G3 X1. Y1. R-2. ",
    "G83 Z-1. R1. Q.5 F10. ",
    "G80 ",
    "G81X1.Z-1.R1.F1.",
    "G41 D1 ",
    "G43 H1 ",
    "G91 ",
    "G90 ",
    "G20 ",
    "G21 ",
    "G18 ",
    "G68 R45. ",
    "G51 P2. ",
    "T1 M6 ",
    "T0101 ",
    "T",
    "M6",
    "M3 S1000 ",
    "F100. ",
    "S",
    "G96 S200 ",
    "G71 P10 Q20 U.1 W.1 D1. F.2 ",
    "U1. ",
    "W-1. ",
    "M97 P10 ",
    "M98 P2 ",
    "M98 P1",
    "M98 P#1",
    "G65 P9010 A1. B#2 ",
    "G65 P2 A1. ",
    "M99 ",
    "M99 P10",
    "M30",
    "M2",
    "#1=1",
    "#100=#1+[2*3.]",
    "#[#1+1]=",
    "##1=2",
    "#<d>=3",
    "#<_x>",
    "#<",
    "#",
    "IF [#1 EQ 1] GOTO 10",
    "IF [",
    "WHILE [#1 LT 5] DO1",
    "WHILE [1] DO2",
    "END1",
    "END2",
    "GOTO 10",
    "GOTO #1",
    "GOTO",
    "o100 sub",
    "o100 endsub",
    "o<probe> sub",
    "o<probe> endsub",
    "o<probe> call [1] [#2]",
    "o100 call",
    "o110 if [#1]",
    "o110 elseif [2]",
    "o110 else",
    "o110 endif",
    "o120 while [0]",
    "o120 endwhile",
    "o[#1] call",
    "o130 do",
    "o130 while [1]",
    "o140 repeat [3]",
    "o140 endrepeat",
    "o120 break",
    "o120 continue",
    "o100 return [1]",
    "DPRNT[A#1]",
    "POPEN",
    "PCLOS",
    "(NOTE)",
    "(",
    "(a (b) c)",
    "; rest",
    ";",
    "(gcheck: ignore all)",
    "(gcheck: off words)",
    "(gcheck: on all)",
    "(gcheck: ignore ",
    "(gcheck: control=",
    "(MSG, µ)",
    "(DEBUG, #1)",
    "(日本🙂)",
    "SIN[",
    "ATAN[1]/[2]",
    "[",
    "]",
    ")",
    "=",
    ",R1.",
    ",C1.",
    ",A30.",
    "\u{1A}",
    "\u{FEFF}",
    "é",
    "\t",
    "\r",
    "\0",
    "1.2.3",
    "G1.25 ",
    "G999 ",
    "M123 ",
    "@1^2",
    "X 1 . 5",
    ":1234",
    "G66 P2 A1.",
    "G67",
    "G28 U0",
    "G53 X0 ",
    "G92 X0 ",
    "G10 L2 P1 X1. ",
    "G52 X1. ",
    "M1",
    "M0",
    "XO.5",
    "G01.5.5",
    "EQ",
    "NE",
    "AND",
    "MOD",
    "**",
    "FUP[1.5]",
    "ROUND[#1]",
    "BCD[1]",
    "EXISTS[#<a>]",
    "ACOS[2]",
    "SQRT[-1]",
    "LN[0]",
    "G12.1",
    "G13.1",
    "G112",
    "G107 C10.",
    "G31 Z-1. F10. ",
    "G38.2 Z-1. F10. ",
    "G5.2 X1. Y1. P1 ",
    "G5.3 ",
    "G7 ",
    "G8 ",
    "G17 ",
    "G19 ",
    "G40 ",
    "G42 ",
    "G49 ",
    "G50 ",
    "G69 ",
    "G93 ",
    "G94 ",
    "G95 ",
    "G98 ",
    "G99 ",
    "Q1. ",
    "P500 ",
    "L3 ",
    "K0",
];
