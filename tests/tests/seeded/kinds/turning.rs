//! Mistakes in turning and bar work.
//!
//! Knows: how each is made. Must not know: the findings about it.

use gcheck_controls::Effect;

use crate::kind::{Fear, Kind};
use crate::program::{Block, Program, Word};

const ROUGHING: [Effect; 3] = [Effect::RoughAlongZ, Effect::RoughAlongX, Effect::RepeatPattern];
const PROFILE: &[&str] = &[
    "turning-profile-not-usable",
    "turning-profile-first-block",
    "turning-profile-turns-back",
    "jump-target-missing",
];

/// The block that begins the profile of a roughing cycle.
fn profile<'p>(p: &'p Program, cycle: &Block) -> Option<&'p Block> {
    let first = cycle.code(&ROUGHING).and(cycle.word(b'P'))?.number?;
    p.blocks.iter().find(|block| block.word(b'N').is_some_and(|label| label.number == Some(first)))
}

/// A threading cycle's word: of its last line where it has two.
fn thread(block: &Block, letter: u8) -> Option<&Word> {
    block.code(&[Effect::ThreadCycle]).filter(|_| block.has(b"XZU"))?;
    block.word(letter)
}

pub(super) const KINDS: &[Kind] = &[
    Kind::new(
        "speed-limit-forgotten",
        Fear::Crash,
        "constant surface speed without a limit (no `G50 S`, no `D`)",
        &["surface-speed-without-limit"],
        |p| {
            let on = p.blocks.iter().any(|block| block.code(&[Effect::SurfaceSpeed]).is_some());
            let limits = p.blocks.iter().filter_map(|block| {
                if let Some(word) = block.word(b'D').filter(|_| block.code(&[Effect::SurfaceSpeed]).is_some())
                {
                    return Some(p.without(word));
                }
                block.code(&[Effect::SpeedLimitOrSetPosition]).filter(|_| block.has(b"S"))?;
                Some(p.without_line(block))
            });
            let all: Vec<_> = limits.collect();
            if on && !all.is_empty() { vec![all.into()] } else { Vec::new() }
        },
    )
    .anywhere(),
    Kind::new(
        "surface-speed-for-thread",
        Fear::Scrap,
        "constant surface speed stays on for a thread",
        &["thread-at-surface-speed"],
        |p| {
            p.each(|block| {
                let code = block.code(&[Effect::ConstantSpeed]).filter(|_| block.has(b"S"))?;
                let thread =
                    p.behind(block).iter().take(5).any(|next| next.code(&[Effect::ThreadCycle]).is_some());
                let limit = if p.is_for(&["linuxcnc"]) { " D2000" } else { "" };
                thread.then(|| p.instead(code, format!("G96{limit}")))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "profile-end-mistyped",
        Fear::Alarm,
        "the last block of a turning profile is mistyped (`Q`)",
        PROFILE,
        |p| {
            p.each(|block| {
                block.code(&ROUGHING)?;
                let word = block.word(b'Q').filter(|_| block.has(b"P"))?;
                Some(p.value(word, format!("{}7", &p.words_of(word)[1..])))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "profile-begin-mistyped",
        Fear::Alarm,
        "the first block of a turning profile is mistyped (`P`)",
        PROFILE,
        |p| {
            p.each(|block| {
                block.code(&ROUGHING)?;
                let word = block.word(b'P').filter(|_| block.has(b"Q"))?;
                Some(p.value(word, format!("{}7", &p.words_of(word)[1..])))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "profile-begins-without-motion",
        Fear::Alarm,
        "the first block of a turning profile has neither `G00` nor `G01`",
        PROFILE,
        |p| {
            p.each(|block| {
                let first = profile(p, block)?;
                let word = first.code(&[Effect::Rapid, Effect::Linear])?;
                Some(p.without(word))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "profile-turns-back",
        Fear::Scrap,
        "a diameter in the middle of a turning profile is mistyped and the profile turns back",
        &[
            "turning-profile-not-usable",
            "arc-radius-too-small",
            "arc-end-off-circle",
            "turning-profile-turns-back",
            // Names the diameter that lies beyond where the tool starts.
            "turning-start-inside-profile",
        ],
        |p| {
            p.each(|block| {
                let first = profile(p, block)?;
                let inner = p
                    .behind(first)
                    .iter()
                    .filter(|b| b.moves(&[Effect::Linear]) && b.has(b"X") && !b.has(b"N"))
                    .nth(1)?;
                let word = inner.word(b'X')?;
                (word.number? > 1.0).then(|| p.value(word, "0.5"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "roughing-without-depth",
        Fear::Alarm,
        "a roughing cycle's depth of cut is zero",
        &[
            "turning-profile-not-usable",
            "cycle-word-not-positive",
            "number-out-of-range",
            "cycle-numbers-contradict",
            "computed-value-out-of-range",
        ],
        |p| {
            p.each(|block| {
                block.code(&[Effect::RoughAlongZ])?;
                let two = !block.has(b"PQ");
                let word = block.word(if two { b'U' } else { b'D' })?;
                Some(p.value(word, "0."))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "finish-of-another-profile",
        Fear::Alarm,
        "the finishing cycle names another profile than the roughing cycle",
        &["turning-profile-not-usable", "jump-target-missing"],
        |p| {
            p.each(|block| {
                block.code(&[Effect::FinishProfile])?;
                let word = block.word(b'Q')?;
                Some(p.value(word, format!("{}7", &p.words_of(word)[1..])))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "nose-compensation-left-on",
        Fear::Crash,
        "nose compensation is never cancelled (no `G40`)",
        &["compensation-left-on", "maybe-compensation-left-on"],
        |p| {
            p.each(|block| {
                block
                    .code(&[Effect::CompensationOff])
                    .filter(|_| block.before.is_compensating && p.is_lathe())?;
                let all =
                    p.blocks[block.ix..].iter().filter_map(|block| block.code(&[Effect::CompensationOff]));
                Some(all.map(|word| p.without(word)).collect::<Vec<_>>())
            })
        },
    )
    .anywhere(),
    Kind::new(
        "offset-of-another-turning-tool",
        Fear::Crash,
        "the offset of another tool is called (`T0102`)",
        &["length-offset-of-another-tool", "diameter-offset-of-another-tool"],
        |p| {
            p.each(|block| {
                let word =
                    block.word(b'T').filter(|word| p.is_lathe() && word.number.is_some_and(|t| t > 100.0))?;
                let text = &p.words_of(word)[1..];
                let (tool, offset) = text.split_at_checked(text.len().checked_sub(2)?)?;
                let offset: u32 = offset.parse().ok().filter(|offset| *offset > 0)?;
                Some(p.value(word, format!("{tool}{:02}", offset + 1)))
            })
        },
    ),
    Kind::new(
        "diameter-and-increment",
        Fear::Alarm,
        "`X` and `U` are in one block",
        &["axis-given-twice"],
        |p| {
            p.each(|block| {
                let fits = p.is_lathe()
                    && p.is_for(&["haas", "fanuc"])
                    && block.moves(&[Effect::Linear])
                    && block.has(b"X")
                    && !block.has(b"U");
                (fits && block.code(&[Effect::Linear]).is_some()).then(|| p.behind_words(block, "U0.5"))
            })
        },
    ),
    Kind::new(
        "thread-without-lead",
        Fear::Alarm,
        "a threading cycle without its lead",
        &[
            "cycle-word-missing",
            "required-word-missing",
            "thread-without-lead",
            "lasting-word-never-given",
            "word-choice-missing",
        ],
        |p| {
            p.each(|block| {
                let word = thread(block, if p.is_for(&["linuxcnc"]) { b'P' } else { b'F' })?;
                // A feed from an earlier block would be taken as the lead.
                Some(p.without(word))
            })
        },
    ),
    Kind::new(
        "thread-without-depth",
        Fear::Alarm,
        "the depth of a thread is zero",
        &[
            "cycle-word-not-positive",
            "number-out-of-range",
            "cycle-numbers-contradict",
            "computed-value-out-of-range",
        ],
        |p| {
            p.each(|block| {
                let letter = if p.is_for(&["fanuc"]) { b'P' } else { b'K' };
                Some(p.value(thread(block, letter)?, "0"))
            })
        },
    ),
    Kind::new(
        "feed-per-minute-on-a-lathe",
        Fear::Scrap,
        "feed a minute (`G98`, `G94`) is on while the numbers are feed a turn",
        &["feed-of-another-mode", "feed-implausible"],
        |p| {
            p.each(|block| {
                block
                    .code(&[Effect::FeedPerRevolution])
                    .filter(|_| p.is_lathe())
                    // Where `G98` is something else, `G94` says it.
                    .map(|word| p.instead(word, if p.is_for(&["linuxcnc"]) { "G94" } else { "G98" }))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "bar-not-freed",
        Fear::Crash,
        "the parting tool is still in the bar when the bar is fed",
        &["turret-in-the-way-of-bar"],
        |p| {
            p.each(|block| {
                let feed = p.behind(block).iter().take(4).any(|next| next.code(&[Effect::BarFeed]).is_some());
                let next = p
                    .next(block)
                    .filter(|next| next.moves(&[Effect::Rapid]) && block.moves(&[Effect::Rapid]) && feed)?;
                Some(vec![p.without_line(block), p.without_line(next)])
            })
        },
    )
    .anywhere(),
    Kind::new(
        "bar-pushed-too-little",
        Fear::Scrap,
        "the bar is pushed by less than the part is long",
        &["bar-push-shorter-than-part"],
        |p| {
            p.each(|block| {
                let word = block.word(b'J').filter(|_| block.code(&[Effect::BarFeed]).is_some())?;
                Some(p.value(word, "0.75"))
            })
        },
    ),
    Kind::new(
        "bar-job-without-end",
        Fear::Trap,
        "a bar job has no way to end but an empty feeder",
        &["bar-job-without-end"],
        |p| {
            p.each(|block| {
                let fits = block.is_skippable
                    && block.code(&[Effect::ProgramEnd, Effect::ProgramEndWithPallet]).is_some();
                (fits && p.blocks.iter().any(|b| b.code(&[Effect::BarFeed]).is_some()))
                    .then(|| p.without_line(block))
            })
        },
    )
    .anywhere(),
    // A spindle that still turns is none: the bar feed stops it before the chuck opens (96-8913A, p. 21).
    Kind::new(
        "bar-with-compensation-on",
        Fear::Scrap,
        "nose compensation is still on when the bar is fed",
        &["mode-on-at-bar-feed", "compensation-left-on"],
        |p| {
            p.each(|block| {
                let cuts = block.code(&[Effect::Linear]).is_some() && block.has(b"Z") && p.is_lathe();
                let rest = p.behind(block);
                let fed = rest.iter().position(|next| next.code(&[Effect::BarFeed]).is_some())?;
                let ends = rest[..fed].iter().any(|next| next.code(&[Effect::CompensationOff]).is_some());
                (cuts && !block.before.is_compensating && !ends).then(|| p.behind_words(block, "G42"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "parting-program-missing",
        Fear::Alarm,
        "the bar feed calls a parting program that is not there",
        &["subprogram-missing"],
        |p| {
            p.each(|block| {
                block
                    .code(&[Effect::BarFeed])
                    .filter(|_| !block.has(b"P"))
                    .map(|_| p.behind_words(block, "P3999"))
            })
        },
    ),
];
