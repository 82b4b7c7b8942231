//! Mistakes with canned cycles.
//!
//! Knows: how each is made. Must not know: the findings about it.

use gcheck_controls::Effect;

use crate::kind::{Fear, Kind};
use crate::program::{Block, Program, Word};

const DRILLING: [Effect; 5] = [
    Effect::CycleDrill,
    Effect::CycleDrillDwell,
    Effect::CyclePeck,
    Effect::CycleChipBreak,
    Effect::CycleTap,
];
const PECKING: [Effect; 2] = [Effect::CyclePeck, Effect::CycleChipBreak];
const MISSING: &[&str] = &[
    "cycle-word-missing",
    "required-word-missing",
    "lasting-word-never-given",
    "cycle-words-lost",
    "cycle-dwell-missing",
];

/// A cycle that begins here, with a word of it.
fn word_of<'b>(block: &'b Block, cycles: &[Effect], letter: u8) -> Option<&'b Word> {
    block.code(cycles).filter(|_| !block.before.is_incremental && block.before.spindle_turns)?;
    block.word(letter)
}

/// No earlier cycle gives the word.
fn first(p: &Program, block: &Block, letter: u8) -> bool {
    !p.blocks[..block.ix]
        .iter()
        .any(|before| before.code(&DRILLING).is_some() && before.word(letter).is_some())
}

pub(super) const KINDS: &[Kind] = &[
    Kind::new("cycle-without-r", Fear::Crash, "a cycle without `R`", MISSING, |p| {
        p.each(|block| {
            word_of(block, &DRILLING, b'R')
                .filter(|_| first(p, block, b'R') && !p.is_lathe())
                .map(|word| p.without(word))
        })
    }),
    Kind::new("cycle-without-z", Fear::Alarm, "a cycle without its depth", MISSING, |p| {
        p.each(|block| {
            word_of(block, &DRILLING, b'Z')
                .filter(|_| first(p, block, b'Z') && !p.is_lathe())
                .map(|word| p.without(word))
        })
    }),
    Kind::new(
        "cycle-sign-of-depth",
        Fear::Crash,
        "the minus sign of a cycle's depth is lost",
        &["cycle-r-below-bottom", "cycle-numbers-contradict"],
        |p| {
            p.each(|block| {
                let word =
                    word_of(block, &DRILLING, b'Z').filter(|word| word.number.is_some_and(|z| z < 0.0))?;
                let r = block.word(b'R')?.number?;
                (word.number? < -r).then(|| p.value(word, &p.words_of(word)[2..]))
            })
        },
    ),
    Kind::new("peck-without-q", Fear::Crash, "a peck cycle without the depth of a peck", MISSING, |p| {
        p.each(|block| {
            word_of(block, &PECKING, b'Q')
                .filter(|_| first(p, block, b'Q') && !p.is_lathe())
                .map(|word| p.without(word))
        })
    }),
    Kind::new(
        "peck-of-zero",
        Fear::Alarm,
        "pecks of zero",
        &["cycle-word-not-positive", "number-out-of-range", "computed-value-out-of-range"],
        |p| p.each(|block| word_of(block, &PECKING, b'Q').map(|word| p.value(word, "0."))),
    ),
    Kind::new(
        "peck-below-zero",
        Fear::Alarm,
        "the depth of a peck has a minus sign",
        &["cycle-word-not-positive", "number-out-of-range", "sign-not-accepted"],
        |p| {
            p.each(|block| {
                let word =
                    word_of(block, &PECKING, b'Q').filter(|word| word.number.is_some_and(|q| q > 0.0))?;
                Some(p.value(word, format!("-{}", &p.words_of(word)[1..])))
            })
        },
    ),
    Kind::new("dwell-cycle-without-p", Fear::Trap, "a cycle with a dwell has no time", MISSING, |p| {
        p.each(|block| {
            word_of(block, &[Effect::CycleDrillDwell], b'P')
                .filter(|_| first(p, block, b'P'))
                .map(|word| p.without(word))
        })
    }),
    Kind::new(
        "cycle-with-rotary-word",
        Fear::Alarm,
        "a rotary axis is in a block of a cycle, on a control that refuses it",
        &["cycle-with-rotary-word"],
        |p| {
            p.each(|block| {
                block
                    .code(&DRILLING)
                    .filter(|_| p.is_for(&["linuxcnc"]))
                    .map(|_| p.behind_words(block, "A90"))
            })
        },
    ),
    Kind::new(
        "cycle-not-cancelled",
        Fear::Crash,
        "`G80` and the `G00` after it are forgotten: the next positions are drilled",
        &["cycle-left-on", "maybe-cycle-left-on", "cycle-r-below-bottom", "cycle-under-compensation"],
        |p| {
            p.each(|block| {
                let in_cycle = block.before.motion.is_some_and(|motion| DRILLING.contains(&motion));
                block
                    .code(&[Effect::CycleCancel])
                    .filter(|_| in_cycle && block.words.len() == 1 && !block.before.is_subprogram)?;
                let next = p.next(block).filter(|next| {
                    next.is_plain() && next.has(b"XYZ") && !next.is_skippable && next.words.len() < 4
                })?;
                next.code(&[Effect::Rapid])?;
                let rapid = next.code(&[Effect::Rapid]).map(|word| p.without(word));
                Some([p.without_line(block)].into_iter().chain(rapid).collect::<Vec<_>>())
            })
        },
    )
    .anywhere(),
    Kind::new(
        "repeats-of-zero",
        Fear::Trap,
        "a cycle is to be done zero times (`L0`, `K0`)",
        &["number-out-of-range", "computed-value-out-of-range", "cycle-word-not-positive"],
        |p| {
            p.each(|block| {
                let repeats = if p.is_for(&["fanuc"]) { "K0" } else { "L0" };
                let fits = block.code(&DRILLING).is_some() && !p.is_lathe() && p.is_for(&["linuxcnc"]);
                fits.then(|| p.behind_words(block, repeats))
            })
        },
    ),
    Kind::new(
        "cycle-under-compensation",
        Fear::Alarm,
        "a hole is drilled while cutter compensation is on",
        &["cycle-under-compensation", "refused-under-compensation"],
        |p| {
            p.each(|block| {
                let fits = block.code(&DRILLING).is_some()
                    && block.has(b"XY")
                    && p.is_for(&["linuxcnc", "fanuc-mill", "haas-mill"])
                    && !block.before.is_subprogram;
                let d = if p.is_for(&["linuxcnc"]) { "G41" } else { "G41 D01" };
                fits.then(|| p.line_above(block, d))
            })
        },
    )
    .anywhere(),
];
