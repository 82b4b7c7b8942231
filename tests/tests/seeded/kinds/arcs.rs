//! Mistakes in arcs.
//!
//! Knows: how each is made. Must not know: the findings about it.

use gcheck_controls::Effect;

use crate::kind::{Fear, Kind};
use crate::program::{Block, Program, Word};

const ARCS: [Effect; 2] = [Effect::ArcClockwise, Effect::ArcCounterClockwise];
const OFF: &[&str] = &["arc-end-off-circle", "arc-radius-too-small", "compensation-gouge"];

/// An arc with literal words, with its code.
fn arc<'b>(p: &Program, block: &'b Block) -> Option<&'b Word> {
    let literal = block.words.iter().all(|word| word.number.is_some());
    let repeats = block.has(b"LK") && !p.is_lathe();
    block.code(&ARCS).filter(|_| block.moves(&ARCS) && literal && !repeats && !block.has(b"P"))
}

/// Written with a centre.
fn by_centre(block: &Block) -> bool {
    block.has(b"IJK") && !block.has(b"R")
}

/// The value, moved by a tenth of an inch or two millimetres: a slip that one sees on the part.
fn moved(p: &Program, word: &Word) -> String {
    let inch = p.blocks.iter().any(|block| block.code(&[Effect::Inch]).is_some());
    let value = word.number.unwrap() + if inch { 0.1 } else { 2.0 };
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').to_owned();
    if text.ends_with('.') && !p.counts_steps() { text.trim_end_matches('.').to_owned() } else { text }
}

pub(super) const KINDS: &[Kind] = &[
    Kind::new("arc-end-mistyped", Fear::Alarm, "the end of an arc is mistyped", OFF, |p| {
        p.each(|block| {
            arc(p, block).filter(|_| by_centre(block))?;
            let word = block.words.iter().find(|word| matches!(word.letter, b'X' | b'Y'))?;
            Some(p.value(word, moved(p, word)))
        })
    }),
    Kind::new("arc-centre-mistyped", Fear::Alarm, "the centre of an arc is mistyped", OFF, |p| {
        p.each(|block| {
            arc(p, block).filter(|_| by_centre(block))?;
            // A full circle closes about any centre.
            let full = !block.has(b"XYZ")
                || p.previous(block).is_some_and(|above| {
                    let same = |letter| {
                        block
                            .word(letter)
                            .is_none_or(|w| above.word(letter).is_none_or(|a| a.number == w.number))
                    };
                    same(b'X') && same(b'Y')
                });
            let word = block
                .words
                .iter()
                .find(|word| matches!(word.letter, b'I' | b'J') && word.number != Some(0.0))?;
            (!full).then(|| p.value(word, moved(p, word)))
        })
    }),
    Kind::new("arc-sign-of-centre", Fear::Scrap, "the sign of `I` or `J` is lost", OFF, |p| {
        p.each(|block| {
            arc(p, block).filter(|_| by_centre(block) && block.has(b"X") && block.has(b"Y"))?;
            let above = p.previous(block)?;
            let full = block.word(b'X')?.number == above.word(b'X').and_then(|word| word.number)
                && block.word(b'Y')?.number == above.word(b'Y').and_then(|word| word.number);
            let word = block
                .words
                .iter()
                .find(|word| matches!(word.letter, b'I' | b'J') && word.number.is_some_and(|v| v < 0.0))?;
            (!full).then(|| p.value(word, &p.words_of(word)[2..]))
        })
    }),
    Kind::new(
        "arc-radius-slip",
        Fear::Scrap,
        "the decimal point of an arc's radius slips (`R1.` for `R10.`)",
        OFF,
        |p| {
            p.each(|block| {
                arc(p, block)?;
                let word = block.word(b'R').filter(|word| {
                    word.number.is_some_and(|r| r > 0.0) && (word.has_point || !p.counts_steps())
                })?;
                Some(p.value(word, format!("{:.5}", word.number.unwrap() / 10.0).trim_end_matches('0')))
            })
        },
    ),
    Kind::new(
        "full-circle-by-radius",
        Fear::Scrap,
        "a full circle is written with `R`",
        &["full-circle-by-radius", "motion-without-axis-words", "arc-radius-too-small"],
        |p| {
            p.each(|block| {
                arc(p, block).filter(|_| by_centre(block) && !p.is_lathe() && !block.has(b"Z"))?;
                let above = p.previous(block)?;
                let same = |letter| matches!((block.word(letter), above.word(letter)), (Some(a), Some(b)) if a.number == b.number);
                let closed = !block.has(b"XYZ") || same(b'X') && same(b'Y');
                let radius = block.words.iter().filter(|word| matches!(word.letter, b'I' | b'J')).filter_map(|word| word.number).map(f64::abs).fold(0.0, f64::max);
                if !closed {
                    return None;
                }
                let mut edits: Vec<_> = block.words.iter().filter(|word| matches!(word.letter, b'I' | b'J' | b'K')).map(|word| p.without(word)).collect();
                edits.push(p.behind_words(block, format!("R{radius:.3}")));
                Some(edits)
            })
        },
    ),
    Kind::new(
        "arc-without-centre",
        Fear::Alarm,
        "an arc has neither centre nor radius",
        &["arc-without-centre", "required-word-missing", "word-choice-missing", "arc-mode-left-on"],
        |p| {
            p.each(|block| {
                arc(p, block).filter(|_| block.has(b"XYZ"))?;
                let words =
                    block.words.iter().filter(|word| matches!(word.letter, b'I' | b'J' | b'K' | b'R'));
                let edits: Vec<_> = words.map(|word| p.without(word)).collect();
                (!edits.is_empty()).then_some(edits)
            })
        },
    ),
    Kind::new(
        "arc-centre-and-radius",
        Fear::Alarm,
        "an arc has both a centre and a radius",
        &[
            "arc-centre-and-radius",
            "words-exclude-each-other",
            "arc-radius-too-small",
            "full-circle-by-radius",
            "arc-end-off-circle",
        ],
        |p| p.each(|block| arc(p, block).filter(|_| by_centre(block)).map(|_| p.behind_words(block, "R5."))),
    ),
    Kind::new(
        "arc-word-of-another-plane",
        Fear::Scrap,
        "`K` is typed for `J` in an XY arc",
        &[
            "arc-wrong-plane-word",
            "arc-end-off-circle",
            "arc-without-centre",
            "zero-radius-arc",
            "word-not-read",
        ],
        |p| {
            p.each(|block| {
                arc(p, block).filter(|_| by_centre(block) && !p.is_lathe())?;
                let word = block.word(b'J').filter(|word| word.number != Some(0.0))?;
                Some(p.instead(word, format!("K{}", &p.words_of(word)[1..])))
            })
        },
    ),
    Kind::new(
        "arc-code-left-on",
        Fear::Scrap,
        "the `G01` after an arc is forgotten",
        &["arc-mode-left-on", "arc-without-centre", "motion-without-axis-words"],
        |p| {
            p.each(|block| {
                let word = block.code(&[Effect::Linear]).filter(|_| block.moves(&[Effect::Linear]))?;
                p.previous(block).filter(|above| above.moves(&ARCS) && above.is_plain())?;
                (!block.has(b"IJKR")).then(|| p.without(word))
            })
        },
    ),
];
