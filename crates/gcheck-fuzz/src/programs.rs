//! Programs from bytes: as they are, from pieces of the grammar, from the codes of the knowledge base, from statements.
//!
//! Knows: how each control writes its words. Must not know: what is asked of the programs.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt::Write as _;

use gcheck_controls::{Control, Letter, Machine};
use gcheck_program::profile;
use gcheck_syntax::SyntaxProfile;
use gcheck_testkit::pieces::PROGRAM_PIECES;

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
                text.push_str(choices.text(PROGRAM_PIECES));
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
        text.push_str(choices.text(PROGRAM_PIECES));
        if choices.below(3) == 1 {
            text.push('\n');
        }
        count += 1;
    }
    text
}
