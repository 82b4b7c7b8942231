//! Mistakes with moves, feed and spindle.
//!
//! Knows: how each is made. Must not know: the findings about it.

use gcheck_controls::Effect;

use crate::kind::{Edit, Fear, Kind};
use crate::program::{Block, Program};

const SPINDLE: [Effect; 2] = [Effect::SpindleClockwise, Effect::SpindleCounterClockwise];
const CUTS: [Effect; 3] = [Effect::Linear, Effect::ArcClockwise, Effect::ArcCounterClockwise];

/// A cut straight down: `G01 Z-…` and no other axis.
fn plunge(p: &Program, block: &Block) -> bool {
    !p.is_lathe()
        && block.moves(&[Effect::Linear])
        && block.code(&[Effect::Linear]).is_some()
        && !block.before.is_incremental
        && !block.before.is_subprogram
        && !block.has(b"XY")
        && block.word(b'Z').and_then(|word| word.number).is_some_and(|z| z < 0.0)
}

/// A cut in the main program.
fn cut(block: &Block) -> bool {
    block.moves(&CUTS) && !block.before.is_subprogram && block.before.spindle_turns
}

pub(super) const KINDS: &[Kind] = &[
    Kind::new(
        "rapid-plunge",
        Fear::Crash,
        "the plunge into the part is a rapid move (`G00` for `G01`)",
        &["rapid-plunge", "rapid-in-material", "rapid-with-feed", "rapid-between-cuts"],
        |p| {
            p.each(|block| {
                block.code(&[Effect::Linear]).filter(|_| plunge(p, block)).map(|word| p.instead(word, "G00"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "sign-of-clearance",
        Fear::Crash,
        "the clearance height has a minus sign (`G00 Z-1.` for `G00 Z1.`)",
        &["rapid-plunge", "rapid-in-material", "move-outside-travel", "plunge-goes-nowhere"],
        |p| {
            p.each(|block| {
                let word = block.word(b'Z').filter(|word| word.number.is_some_and(|z| z > 0.0))?;
                let next = p.next(block)?;
                let fits = block.moves(&[Effect::Rapid])
                    && block.is_plain()
                    && !block.before.is_incremental
                    && !p.is_lathe()
                    && plunge(p, next);
                fits.then(|| p.value(word, format!("-{}", &p.words_of(word)[1..])))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "rapid-in-cut",
        Fear::Crash,
        "a cut in the middle of a contour is a rapid move (`G00` for `G01`)",
        &["rapid-in-material", "rapid-between-cuts", "rapid-plunge", "refused-under-compensation"],
        |p| {
            p.each(|block| {
                let word = block
                    .code(&[Effect::Linear])
                    .filter(|_| cut(block) && block.has(b"XY") && !block.has(b"ZFD") && !p.is_lathe())?;
                let above = p.previous(block).filter(|above| above.moves(&CUTS))?;
                (p.next(block)?.moves(&CUTS) && !above.before.is_incremental).then(|| p.instead(word, "G00"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "retract-forgotten",
        Fear::Crash,
        "the retract is forgotten and the tool goes on at depth at rapid",
        &[
            "rapid-in-material",
            "rapid-between-cuts",
            "plunge-goes-nowhere",
            "tool-down-at-end",
            "rapid-plunge",
        ],
        |p| {
            p.each(|block| {
                let up = block.moves(&[Effect::Rapid])
                    && block.code(&[Effect::Rapid]).is_some()
                    && block.has(b"Z")
                    && !block.has(b"XY")
                    && !p.is_lathe();
                let above = p
                    .previous(block)
                    .filter(|above| up && above.moves(&CUTS) && !above.before.is_incremental)?;
                let rapid = p.behind(block).iter().find(|next| next.moves(&[Effect::Rapid]))?;
                let fits =
                    rapid.has(b"XY") && !rapid.has(b"Z") && rapid.before.section == block.before.section;
                let below = p.blocks[..=above.ix].iter().rev().find_map(|b| b.word(b'Z'))?.number? < 0.0;
                let z = block.word(b'Z')?;
                (fits && below).then(|| p.without(z))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "feed-never-given",
        Fear::Alarm,
        "no feed in the whole program",
        &[
            "feed-missing",
            "maybe-feed-missing",
            "cycle-word-missing",
            "thread-without-lead",
            "required-word-missing",
            "inverse-time-feed-missing",
        ],
        |p| {
            let cuts =
                p.blocks.iter().any(|block| block.moves(&[Effect::Linear]) && !block.before.is_subprogram);
            let words = p
                .blocks
                .iter()
                .filter(|block| block.code(&[Effect::MacroCall]).is_none())
                .filter_map(|block| block.word(b'F'));
            let all: Vec<Edit> = words.map(|word| p.without(word)).collect();
            if all.is_empty() || !cuts { Vec::new() } else { vec![all.into()] }
        },
    )
    .anywhere(),
    Kind::new(
        "feed-zero",
        Fear::Alarm,
        "the feed is zero",
        &["feed-zero", "feed-missing", "number-out-of-range"],
        |p| {
            p.each(|block| {
                block
                    .word(b'F')
                    .filter(|_| block.moves(&[Effect::Linear]) && block.code(&[Effect::Linear]).is_some())
                    .map(|word| p.value(word, "0."))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "spindle-never-started",
        Fear::Crash,
        "the spindle is not started for a tool (no `M03`)",
        &["spindle-stopped-while-cutting", "maybe-spindle-stopped-while-cutting"],
        |p| {
            p.each(|block| {
                let word = block
                    .code(&SPINDLE)
                    .filter(|_| !block.before.spindle_turns && !block.before.is_subprogram)?;
                let mut section =
                    p.behind(block).iter().take_while(|next| next.before.section == block.after.section);
                // A lathe's spindle goes on turning at a tool change.
                let stands = !p.is_lathe()
                    || block.before.section == 0
                        && !p.blocks[..block.ix].iter().any(|b| b.code(&SPINDLE).is_some());
                let cuts = section.any(|next| next.moves(&[Effect::Linear]));
                (cuts && stands).then(|| p.without(word))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "stop-for-start",
        Fear::Crash,
        "`M00` is typed for `M03`",
        &["spindle-stopped-while-cutting", "maybe-spindle-stopped-while-cutting"],
        |p| {
            p.each(|block| {
                let word = block
                    .code(&[Effect::SpindleClockwise])
                    .filter(|_| block.before.section > 0 && !block.before.spindle_turns)?;
                let mut section =
                    p.behind(block).iter().take_while(|next| next.before.section == block.after.section);
                (!p.is_lathe() && section.any(|next| next.moves(&[Effect::Linear])))
                    .then(|| p.instead(word, "M00"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "spindle-stopped-early",
        Fear::Crash,
        "the spindle is stopped before the last cut",
        &["spindle-stopped-while-cutting"],
        |p| p.each(|block| (cut(block) && block.after.feed).then(|| p.line_above(block, "M05"))),
    ),
    Kind::new(
        "speed-left-out",
        Fear::Alarm,
        "the spindle is started without a speed",
        &["speed-missing"],
        |p| {
            p.each(|block| {
                let word = block.word(b'S').filter(|_| block.code(&SPINDLE).is_some())?;
                let given = p.blocks[..block.ix].iter().any(|before| before.has(b"S"));
                let mut section =
                    p.behind(block).iter().take_while(|next| next.before.section == block.after.section);
                (!given && section.any(|next| next.moves(&[Effect::Linear]))).then(|| p.without(word))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "speed-zero",
        Fear::Crash,
        "the spindle is started with speed zero",
        &["speed-missing", "spindle-stopped-while-cutting", "number-out-of-range"],
        |p| {
            p.each(|block| {
                let word = block.word(b'S').filter(|_| {
                    block.code(&SPINDLE).is_some() && !block.before.is_subprogram && !p.is_lathe()
                })?;
                let mut section =
                    p.behind(block).iter().take_while(|next| next.before.section == block.after.section);
                section.any(|next| next.moves(&[Effect::Linear])).then(|| p.value(word, "0"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "speed-above-machine",
        Fear::Alarm,
        "the speed has a digit too many for the machine",
        &["speed-above-machine-limit"],
        |p| {
            p.each(|block| {
                block
                    .word(b'S')
                    .filter(|word| !p.is_lathe() && word.number.is_some_and(|s| s > 1000.0))
                    .map(|word| p.value(word, format!("{}0", &p.words_of(word)[1..])))
            })
        },
    )
    .with_machine(),
    Kind::new(
        "feed-above-machine",
        Fear::Alarm,
        "the feed has digits too many for the machine",
        &["feed-above-machine-limit"],
        |p| {
            p.each(|block| {
                let word = block.word(b'F').filter(|word| {
                    !p.is_lathe() && block.moves(&[Effect::Linear]) && word.number.is_some_and(|f| f > 9.0)
                })?;
                let plain = p.blocks.iter().all(|b| b.code(&[Effect::FeedInverseTime]).is_none());
                plain.then(|| p.value(word, format!("{:.0}00.", word.number.unwrap())))
            })
        },
    )
    .with_machine(),
    Kind::new(
        "outside-travel",
        Fear::Alarm,
        "a digit too many drives an axis out of its travel",
        &["move-outside-travel"],
        |p| {
            p.each(|block| {
                let word = block
                    .word(b'X')
                    .filter(|word| word.number.is_some_and(|x| x.abs() >= 2.0 && word.has_point))?;
                let text = p.words_of(word)[1..].replacen('.', "00.", 1);
                (block.moves(&[Effect::Rapid]) && !block.before.is_incremental && !p.is_lathe())
                    .then(|| p.value(word, text))
            })
        },
    )
    .with_machine()
    .anywhere(),
    Kind::new(
        "coolant-forgotten",
        Fear::Trap,
        "coolant is not switched on for a tool",
        &["coolant-forgotten", "tool-cuts-dry"],
        |p| p.each(|block| block.code(&[Effect::FloodOn]).map(|word| p.without(word))),
    )
    .anywhere(),
    Kind::new(
        "spindle-left-for-tapping",
        Fear::Crash,
        "the spindle turns left for right-hand tapping (`M04` with `G84`), on a control that refuses it",
        &["cycle-numbers-contradict", "tap-in-wrong-direction"],
        |p| {
            p.each(|block| {
                block.code(&[Effect::CycleTap]).filter(|_| p.is_for(&["linuxcnc"]))?;
                let start = p.blocks[..block.ix]
                    .iter()
                    .rev()
                    .find_map(|before| before.code(&[Effect::SpindleClockwise]))?;
                Some(p.instead(start, "M04"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "tap-feed",
        Fear::Scrap,
        "the feed of a tapping cycle is not speed times pitch",
        &["cycle-numbers-contradict", "tapping-feed-off-pitch"],
        |p| {
            p.each(|block| {
                let word = block
                    .word(b'F')
                    .filter(|word| block.code(&[Effect::CycleTap]).is_some() && word.number.is_some())?;
                Some(p.value(word, format!("{}.", word.number.unwrap() + 7.0)))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "dwell-without-time",
        Fear::Alarm,
        "`G04` without a time",
        &["required-word-missing", "word-choice-missing", "lasting-word-never-given"],
        |p| {
            p.each(|block| {
                block.code(&[Effect::Dwell]).filter(|_| p.is_for(&["haas", "linuxcnc"]))?;
                let word = block.words.iter().find(|word| matches!(word.letter, b'P' | b'X' | b'U'))?;
                (block.words.len() == 2).then(|| p.without(word))
            })
        },
    ),
    Kind::new(
        "dwell-in-milliseconds",
        Fear::Trap,
        "milliseconds are written where the control counts seconds (`G4 P500` on LinuxCNC)",
        &["dwell-very-long"],
        |p| {
            p.each(|block| {
                block.code(&[Effect::Dwell]).filter(|_| p.is_for(&["linuxcnc"]))?;
                let word =
                    block.word(b'P').filter(|word| word.number.is_some_and(|s| (0.3..60.0).contains(&s)))?;
                Some(p.value(word, format!("{:.0}", word.number.unwrap() * 1000.0)))
            })
        },
    ),
    Kind::new(
        "seconds-for-milliseconds",
        Fear::Trap,
        "seconds are written where the control counts milliseconds (`G04 P2` on Haas and Fanuc)",
        &["dwell-very-short", "dwell-unit-unsure"],
        |p| {
            p.each(|block| {
                block.code(&[Effect::Dwell]).filter(|_| p.is_for(&["haas", "fanuc"]))?;
                let word = block
                    .word(b'P')
                    .filter(|word| !word.has_point && word.number.is_some_and(|ms| ms >= 300.0))?;
                Some(p.value(word, "2"))
            })
        },
    ),
    Kind::new(
        "corner-before-rapid",
        Fear::Alarm,
        "a rounding to the next move (`,R`) is before a rapid move",
        &["corner-before-rapid"],
        |p| {
            p.each(|block| {
                let next = p.next(block)?;
                let fits = block.moves(&[Effect::Linear])
                    && next.moves(&[Effect::Rapid])
                    && p.is_for(&["fanuc", "haas"])
                    && !block.before.is_subprogram
                    && block.has(b"XY");
                fits.then(|| p.behind_words(block, ",R1."))
            })
        },
    ),
];
