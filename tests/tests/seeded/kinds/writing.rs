//! Mistakes in writing: characters, numbers, words.
//!
//! Knows: how each looks. Must not know: the findings about it.

use gcheck_controls::Effect;

use crate::kind::{Fear, Kind, Seed};
use crate::program::{Block, Program, Word};

const CUTS: [Effect; 3] = [Effect::Linear, Effect::ArcClockwise, Effect::ArcCounterClockwise];

/// A word with a literal value in a block without statements, of one of these addresses.
fn literals(p: &Program, letters: &[u8], seed: impl Fn(&Block, &Word) -> Option<Seed>) -> Vec<Seed> {
    let plain = p.blocks.iter().filter(|block| block.is_plain());
    let words = plain.flat_map(|block| block.words.iter().map(move |word| (block, word)));
    words
        .filter(|(_, word)| letters.contains(&word.letter) && word.number.is_some())
        .filter_map(|(block, word)| seed(block, word))
        .collect()
}

/// The value as it is written.
fn digits<'p>(p: &'p Program, word: &Word) -> &'p str {
    p.words_of(word)[1..].trim_start()
}

pub(super) const KINDS: &[Kind] = &[
    Kind::new(
        "point-lost",
        Fear::Crash,
        "the decimal point of a position is left out where the control then counts smallest steps (`X2.` → `X2`)",
        &["missing-decimal-point"],
        |p| {
            literals(p, b"XYZ", |block, word| {
                let whole = digits(p, word).strip_suffix('.')?;
                let fits = p.counts_steps()
                    && block.moves(&[Effect::Rapid, Effect::Linear])
                    && word.number != Some(0.0);
                fits.then(|| p.value(word, whole).into())
            })
        },
    ),
    Kind::new(
        "feed-point-lost",
        Fear::Scrap,
        "the decimal point of the feed is left out where the control counts it in smallest steps",
        &["missing-decimal-point"],
        |p| {
            literals(p, b"F", |_, word| {
                let whole = digits(p, word).strip_suffix('.')?;
                p.is_for(&["haas"]).then(|| p.value(word, whole).into())
            })
        },
    ),
    Kind::new(
        "radius-point-lost",
        Fear::Crash,
        "the decimal point of `I`, `J` or the `R` plane is left out",
        &["missing-decimal-point", "arc-end-off-circle"],
        |p| {
            literals(p, b"IJR", |block, word| {
                let whole = digits(p, word).strip_suffix('.')?;
                let fits = p.counts_steps()
                    && block.has(b"XYZ")
                    && word.number != Some(0.0)
                    && block.code(&[Effect::MacroCall]).is_none();
                fits.then(|| p.value(word, whole).into())
            })
        },
    ),
    Kind::new(
        "two-points",
        Fear::Alarm,
        "a number has two decimal points (`X1.2.5`)",
        &["malformed-number"],
        |p| {
            literals(p, b"XYZ", |_, word| {
                let (whole, part) = digits(p, word).split_once('.').filter(|(_, part)| part.len() > 1)?;
                let (first, rest) = part.split_at(1);
                Some(p.value(word, format!("{whole}.{first}.{rest}")).into())
            })
        },
    ),
    Kind::new(
        "two-signs",
        Fear::Alarm,
        "a number has two minus signs (`Z--1.`)",
        &["malformed-number", "unexpected-text", "missing-operand", "sign-given-twice"],
        |p| {
            literals(p, b"XYZ", |_, word| {
                let text = digits(p, word);
                (text.starts_with('-')).then(|| p.value(word, format!("-{text}")).into())
            })
        },
    ),
    Kind::new(
        "blocks-run-together",
        Fear::Crash,
        "the end of a line is lost and two blocks become one",
        &["word-given-twice", "two-codes-of-one-group"],
        |p| {
            p.each(|block| {
                let next = p.next(block)?;
                let fits = block.moves(&[Effect::Rapid, Effect::Linear])
                    && next.moves(&[Effect::Rapid, Effect::Linear])
                    && block
                        .words
                        .iter()
                        .any(|word| b"XYZ".contains(&word.letter) && next.has(&[word.letter]));
                let between = block.range.end..next.range.start;
                let plain =
                    block.end_of_words() == block.range.end && p.text[between.clone()].trim().is_empty();
                (fits && plain).then(|| crate::kind::Edit { range: between, text: " ".to_owned() })
            })
        },
    ),
    Kind::new(
        "tape-mark-in-the-middle",
        Fear::Alarm,
        "a `%` of a pasted program is in the middle",
        &["stray-tape-mark", "program-end-missing"],
        |p| {
            p.each(|block| {
                let fits = block.code(&[Effect::ToolChange]).is_some()
                    && p.text.starts_with('%')
                    && !block.before.is_subprogram;
                fits.then(|| p.line_above(block, "%"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "units-of-the-remark",
        Fear::Crash,
        "the remark at the head says that the program is in the other units",
        &["units-comment-contradicts"],
        |p| {
            let units = p.blocks.iter().find_map(|block| block.code(&[Effect::Inch, Effect::Millimetre]));
            let Some(other) = units.map(|word| match word.effect {
                Some(Effect::Inch) => "(UNITS: MM)",
                _ => "(UNITS: INCH)",
            }) else {
                return Vec::new();
            };
            let first = p.blocks.iter().find(|block| block.is_plain() && block.word(b'O').is_none());
            first.map(|block| p.line_above(block, other).into()).into_iter().collect()
        },
    )
    .anywhere(),
    Kind::new(
        "comma-for-point",
        Fear::Alarm,
        "a comma is written instead of the decimal point (`X1,25`)",
        &[
            "unexpected-text",
            "malformed-number",
            "value-without-address",
            "unknown-address",
            "address-without-value",
        ],
        |p| {
            literals(p, b"XYZ", |_, word| {
                let (whole, part) = digits(p, word).split_once('.').filter(|(_, part)| !part.is_empty())?;
                Some(p.value(word, format!("{whole},{part}")).into())
            })
        },
    ),
    Kind::new(
        "letter-o",
        Fear::Alarm,
        "the letter O is typed for a zero (`X1O.`)",
        &["letter-o-for-zero"],
        |p| {
            literals(p, b"XYZ", |block, word| {
                let text = digits(p, word);
                let fits = text.contains('0') && block.moves(&[Effect::Rapid, Effect::Linear]);
                fits.then(|| p.value(word, text.replacen('0', "O", 1)).into())
            })
        },
    ),
    Kind::new(
        "zero-for-o",
        Fear::Alarm,
        "the program number begins with a zero, not with the letter O",
        &["zero-for-letter-o"],
        |p| {
            p.each(|block| {
                // `O0` is not a number of a program.
                let is_number = |word: &&Word| block.words.len() == 1 && word.number != Some(0.0);
                let word = block.word(b'O').filter(is_number)?;
                Some(p.instead(word, format!("0{}", digits(p, word))))
            })
        },
    ),
    Kind::new(
        "letter-lost",
        Fear::Alarm,
        "the letter in front of a value is lost (`5.25` for `X5.25`)",
        &[
            "value-without-address",
            "blank-inside-number",
            "malformed-number",
            "decimal-point-on-integer",
            "unexpected-text",
            "unknown-code",
            "too-many-digits",
            "expression-needs-brackets",
            "units-changed",
        ],
        |p| literals(p, b"XYZF", |_, word| Some(p.instead(word, digits(p, word)).into())),
    ),
    Kind::new(
        "value-lost",
        Fear::Alarm,
        "the value after a letter is lost (`X Y2.`)",
        &["address-without-value"],
        |p| literals(p, b"XYZFST", |_, word| Some(p.value(word, "").into())),
    ),
    Kind::new(
        "point-on-whole-number",
        Fear::Alarm,
        "a decimal point follows a tool or offset number (`H1.`)",
        &["decimal-point-on-integer"],
        |p| {
            literals(p, b"THD", |block, word| {
                let text = digits(p, word);
                // Elsewhere D is a diameter or a depth, and LinuxCNC takes `T1.` for the whole number that it is.
                let is_number = word.letter == b'T'
                    || block
                        .code(&[Effect::LengthPlus, Effect::CompensationLeft, Effect::CompensationRight])
                        .is_some();
                let fits = !word.has_point && is_number && !p.is_for(&["linuxcnc"]);
                fits.then(|| p.value(word, format!("{text}.")).into())
            })
        },
    ),
    Kind::new(
        "too-many-digits",
        Fear::Alarm,
        "a number has more digits than the control accepts",
        &["too-many-digits"],
        |p| {
            literals(p, b"XYZ", |_, word| {
                let fits = word.has_point && p.facts.numbers().max_digits.is_some();
                fits.then(|| p.value(word, format!("{}00000000", digits(p, word))).into())
            })
        },
    ),
    Kind::new(
        "minus-on-feed",
        Fear::Alarm,
        "the feed or the speed has a minus sign",
        &["sign-not-accepted", "number-out-of-range"],
        |p| {
            literals(p, b"FS", |_, word| {
                let text = digits(p, word);
                let fits = word.number.is_some_and(|number| number > 0.0);
                fits.then(|| p.value(word, format!("-{text}")).into())
            })
        },
    ),
    Kind::new(
        "minus-on-offset",
        Fear::Alarm,
        "a tool or offset number has a minus sign",
        &["sign-not-accepted", "number-out-of-range"],
        |p| {
            literals(p, b"TH", |block, word| {
                let is_number = word.letter == b'T' || block.code(&[Effect::LengthPlus]).is_some();
                let fits = is_number && word.number.is_some_and(|number| number > 0.0);
                fits.then(|| p.value(word, format!("-{}", digits(p, word))).into())
            })
        },
    ),
    Kind::new(
        "word-twice",
        Fear::Alarm,
        "an address twice in a block (`X1. Y2. X3.`)",
        &["word-given-twice"],
        |p| {
            p.each(|block| {
                let word = block.word(b'X').filter(|_| block.moves(&[Effect::Rapid, Effect::Linear]))?;
                word.number?;
                Some(p.behind_words(block, format!("X{}", digits(p, word))))
            })
        },
    ),
    Kind::new(
        "stray-word",
        Fear::Trap,
        "a word that nothing in the block reads is left from another block",
        &["word-not-read", "word-passed-over"],
        |p| {
            p.each(|block| {
                let fits = block.code(&[Effect::Linear]).is_some()
                    && block.moves(&[Effect::Linear])
                    && !block.has(b"QPL");
                fits.then(|| p.behind_words(block, "Q5."))
            })
        },
    ),
    Kind::new("comment-not-closed", Fear::Alarm, "a comment is not closed", &["unclosed-comment"], |p| {
        comments(p)
            .into_iter()
            .map(|(_, close)| crate::kind::Edit { range: close..close + 1, text: String::new() }.into())
            .collect()
    }),
    Kind::new(
        "comment-in-comment",
        Fear::Alarm,
        "a comment is inside a comment",
        &["nested-comment", "stray-parenthesis"],
        |p| {
            comments(p)
                .into_iter()
                .map(|(_, close)| crate::kind::Edit { range: close..close, text: " (NEW)".to_owned() }.into())
                .collect()
        },
    ),
    Kind::new(
        "remark-without-parentheses",
        Fear::Alarm,
        "a remark is in the program without parentheses",
        &[
            "unexpected-text",
            "address-without-value",
            "unknown-address",
            "stray-keyword",
            "letter-o-for-zero",
            "malformed-number",
            "value-without-address",
        ],
        |p| {
            comments(p)
                .into_iter()
                .filter(|(open, close)| {
                    p.text[open + 1..*close].split(' ').filter(|word| word.len() > 2).count() >= 2
                })
                .filter(|(open, close)| {
                    p.text[open + 1..*close].bytes().all(|b| b.is_ascii_alphanumeric() || b == b' ')
                })
                .map(|(open, close)| {
                    let bare = |at: usize| crate::kind::Edit { range: at..at + 1, text: " ".to_owned() };
                    vec![bare(open), bare(close)].into()
                })
                .collect()
        },
    ),
    Kind::new(
        "dash-for-minus",
        Fear::Alarm,
        "a long dash from a word processor replaces the minus sign",
        &["non-ascii-text", "unexpected-text"],
        |p| {
            literals(p, b"XYZ", |_, word| {
                let rest = digits(p, word).strip_prefix('-')?;
                Some(p.value(word, format!("\u{2013}{rest}")).into())
            })
        },
    ),
    Kind::new(
        "unknown-g-code",
        Fear::Alarm,
        "a G code is mistyped (`G143` and the like apart: `G343` for `G43`)",
        &["unknown-code"],
        |p| {
            p.each(|block| {
                let word = block.code(&[
                    Effect::LengthPlus,
                    Effect::CompensationLeft,
                    Effect::CycleDrill,
                    Effect::CyclePeck,
                ])?;
                Some(p.instead(word, format!("G3{}", digits(p, word))))
            })
        },
    ),
    Kind::new(
        "unknown-m-code",
        Fear::Alarm,
        "an M code is mistyped (`M808` for `M08`)",
        &["unknown-code", "undeclared-m-code"],
        |p| {
            p.each(|block| {
                let word = block
                    .code(&[Effect::FloodOn, Effect::CoolantOff])
                    .filter(|_| p.is_for(&["haas", "linuxcnc"]))?;
                Some(p.instead(word, format!("M8{}", digits(p, word))))
            })
        },
    ),
    Kind::new(
        "code-of-another-control",
        Fear::Alarm,
        "the program was posted for another control (`G54.1 P1` on Haas, `G154 P1` on Fanuc, `GOTO` on LinuxCNC)",
        &["unknown-code", "statement-of-another-control", "stray-keyword", "wrong-control-suspicion"],
        |p| {
            if p.is_for(&["linuxcnc"]) {
                return p.each(|block| {
                    let fits = block.moves(&[Effect::Rapid]) && !block.before.is_subprogram;
                    fits.then(|| p.line_above(block, "GOTO 100"))
                });
            }
            let foreign = if p.is_for(&["haas"]) { "G54.1 P1" } else { "G154 P1" };
            p.each(|block| Some(p.instead(block.code(&[Effect::WorkOffset(1)])?, foreign)))
        },
    ),
    Kind::new(
        "two-codes-of-a-group",
        Fear::Crash,
        "two codes that exclude each other are in a block (`G00 G01`)",
        &["two-codes-of-one-group"],
        |p| {
            p.each(|block| {
                let fits = block.moves(&[Effect::Rapid]) && block.code(&[Effect::Rapid]).is_some();
                fits.then(|| p.behind_words(block, "G01"))
            })
        },
    ),
    Kind::new(
        "two-m-codes",
        Fear::Alarm,
        "two M codes are in a block of a control that accepts one",
        &["too-many-m-codes", "two-codes-of-one-group", "code-must-stand-alone", "codes-conflict"],
        |p| {
            p.each(|block| {
                let fits = block.code(&[Effect::FloodOn]).is_some() && p.is_for(&["haas"]);
                fits.then(|| p.behind_words(block, "M03"))
            })
        },
    ),
    Kind::new(
        "spindle-both-ways",
        Fear::Alarm,
        "the spindle is started both ways in a block (`M03 M04`)",
        &["too-many-m-codes", "two-codes-of-one-group", "codes-conflict"],
        |p| p.each(|block| block.code(&[Effect::SpindleClockwise]).map(|_| p.behind_words(block, "M04"))),
    ),
    Kind::new(
        "lower-case",
        Fear::Alarm,
        "a word is typed in lower case where the control reads capitals",
        &["lower-case-letter"],
        |p| {
            literals(p, b"XYZ", |_, word| {
                let fits = p.is_for(&["fanuc"]);
                fits.then(|| p.instead(word, p.words_of(word).to_lowercase()).into())
            })
        },
    ),
    Kind::new(
        "tape-mark-lost",
        Fear::Alarm,
        "the `%` at the end is lost in copying",
        &["tape-mark-missing"],
        |p| {
            let text = p.text.trim_end();
            let marks = text.ends_with("\n%") && text.starts_with('%');
            marks
                .then(|| crate::kind::Edit { range: text.len() - 1..text.len(), text: String::new() }.into())
                .into_iter()
                .collect()
        },
    )
    .anywhere(),
    Kind::new(
        "line-too-long",
        Fear::Alarm,
        "a line is longer than the control reads",
        &["line-too-long"],
        |p| {
            let Some(limit) = p.facts.limits().line_length else { return Vec::new() };
            p.each(|block| {
                let fits =
                    block.moves(&CUTS) && p.text_of(block).len() == block.end_of_words() - block.range.start;
                fits.then(|| p.behind_words(block, format!("({})", "X".repeat(limit as usize))))
            })
        },
    ),
];

/// Comments in parentheses: where they open and close.
fn comments(p: &Program) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut at = 0;
    for line in p.text.split_inclusive('\n') {
        let (open, close) = (line.find('('), line.find(')'));
        let plain = line.matches(['(', ')', ';']).count() == 2 && !line.contains("gcheck:");
        if let (Some(open), Some(close), true) = (open, close, plain)
            && open < close
        {
            found.push((at + open, at + close));
        }
        at += line.len();
    }
    found
}
