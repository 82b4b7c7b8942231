//! Mistakes with probes, tilting heads and cylinders.
//!
//! Knows: how each is made. Must not know: the findings about it.

use gcheck_controls::Effect;

use crate::kind::{Edit, Fear, Kind};
use crate::program::Block;

const PROBES: [Effect; 2] = [Effect::ProbeToward, Effect::Skip];

fn tilts(block: &Block) -> bool {
    block.code(&[Effect::LengthFiveAxis]).is_some()
}

/// Mapping that begins here.
fn mapping(block: &Block) -> bool {
    block.code(&[Effect::CylinderMapping]).is_some() && block.has(b"AQR")
}

pub(super) const KINDS: &[Kind] = &[
    Kind::new(
        "probe-without-feed",
        Fear::Alarm,
        "a probing move without a feed",
        &["probe-without-feed", "feed-missing", "required-word-missing"],
        |p| {
            p.each(|block| {
                let word = block.word(b'F').filter(|_| block.code(&PROBES).is_some())?;
                let given = p.blocks[..block.ix].iter().any(|before| before.has(b"F"));
                (!given).then(|| p.without(word))
            })
        },
    ),
    Kind::new(
        "probe-goes-nowhere",
        Fear::Alarm,
        "a probing move ends where it begins",
        &["probe-goes-nowhere", "probe-move-refused"],
        |p| {
            p.each(|block| {
                let word = block.word(b'Z').filter(|_| block.code(&PROBES).is_some())?;
                let away = [Effect::ReturnReference(1), Effect::ReturnReference(2), Effect::Incremental];
                // Where the probe is must be known: it did not go to a reference point since.
                let since = p.blocks[..block.ix].iter().rev().take_while(|b| b.code(&away).is_none());
                let above = since.into_iter().find_map(|before| before.word(b'Z'))?;
                above.number?;
                Some(p.value(word, &p.words_of(above)[1..]))
            })
        },
    ),
    Kind::new(
        "spindle-on-while-probing",
        Fear::Crash,
        "the spindle turns while the probe touches",
        &["spindle-turns-while-probing"],
        |p| {
            p.each(|block| {
                block
                    .code(&PROBES)
                    .filter(|_| !block.before.spindle_turns)
                    .map(|_| p.line_above(block, "S500 M3"))
            })
        },
    ),
    Kind::new(
        "probe-under-compensation",
        Fear::Alarm,
        "a probing move while cutter compensation is on",
        &[
            "probing-in-wrong-mode",
            "probe-move-refused",
            "refused-under-compensation",
            "maybe-probing-in-wrong-mode",
        ],
        |p| {
            p.each(|block| {
                block
                    .code(&PROBES)
                    .filter(|_| !block.before.is_compensating)
                    .map(|_| p.line_above(block, "G41 D1"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "tilt-without-length",
        Fear::Crash,
        "5-axis length compensation without its offset number",
        &["five-axis-length-without-offset"],
        |p| p.each(|block| block.word(b'H').filter(|_| tilts(block)).map(|word| p.without(word))),
    ),
    Kind::new(
        "tilt-left-on",
        Fear::Crash,
        "5-axis length compensation is never cancelled",
        &["five-axis-length-left-on", "refused-in-five-axis-mode"],
        |p| {
            p.each(|block| {
                let on = p.blocks[..block.ix].iter().any(tilts);
                block.code(&[Effect::LengthOff]).filter(|_| on).map(|word| p.without(word))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "tilt-in-increments",
        Fear::Crash,
        "increments under 5-axis length compensation",
        &["five-axis-length-in-incremental", "maybe-five-axis-length-in-incremental"],
        |p| {
            p.each(|block| {
                let on = p.blocks[..block.ix].iter().any(tilts)
                    && p.behind(block).iter().any(|b| b.code(&[Effect::LengthOff]).is_some());
                (on && block.moves(&[Effect::Rapid])).then(|| p.line_above(block, "G91"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "tilt-axis-left-out",
        Fear::Crash,
        "a block that tilts the head leaves a linear axis out",
        &["five-axis-axis-left-out"],
        |p| {
            p.each(|block| {
                let on = p.blocks[..block.ix].iter().any(tilts);
                let word =
                    block.word(b'Y').filter(|_| on && block.has(b"A") && block.moves(&[Effect::Linear]))?;
                Some(p.without(word))
            })
        },
    ),
    Kind::new(
        "tilt-feed-per-minute",
        Fear::Scrap,
        "feed a minute while the head tilts",
        &["five-axis-feed-per-minute"],
        |p| {
            p.each(|block| {
                let on = p.blocks[..block.ix].iter().any(tilts);
                block.code(&[Effect::FeedInverseTime]).filter(|_| on).map(|word| p.without(word))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "cylinder-left-on",
        Fear::Crash,
        "cylindrical mapping is never switched off",
        &["cylinder-left-on", "maybe-cylinder-left-on"],
        |p| {
            p.each(|block| {
                let off = block.code(&[Effect::CylinderMapping]).is_some() && block.words.len() == 1;
                off.then(|| p.without_line(block))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "cylinder-without-axis",
        Fear::Alarm,
        "cylindrical mapping without its rotary axis",
        &["cylinder-without-rotary-axis"],
        |p| p.each(|block| block.word(b'A').filter(|_| mapping(block)).map(|word| p.without(word))),
    ),
    Kind::new(
        "cylinder-without-diameter",
        Fear::Scrap,
        "cylindrical mapping without its radius",
        &["cylinder-without-diameter", "cylinder-diameter-from-setting"],
        |p| p.each(|block| block.word(b'R').filter(|_| mapping(block)).map(|word| p.without(word))),
    ),
    Kind::new(
        "reference-in-cycle",
        Fear::Crash,
        "`G28` in the middle of a canned cycle",
        &["codes-conflict", "cycle-left-on", "machine-coordinates-in-increments"],
        |p| {
            p.each(|block| {
                let cycles =
                    [Effect::CycleDrill, Effect::CyclePeck, Effect::CycleTap, Effect::CycleDrillDwell];
                let in_cycle = block.before.motion.is_some_and(|motion| cycles.contains(&motion))
                    && block.has(b"XY")
                    && block.code(&cycles).is_none();
                let fits =
                    in_cycle && block.is_plain() && p.is_for(&["fanuc"]) && !block.before.is_subprogram;
                fits.then(|| Edit {
                    range: block.range.start..block.range.start,
                    text: "G91 G28 Z0.\nG90\n".to_owned(),
                })
            })
        },
    )
    .anywhere(),
];
