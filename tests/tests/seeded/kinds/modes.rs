//! Mistakes with modes: units, positions and increments, planes, shifts and the like.
//!
//! Knows: how each is made. Must not know: the findings about it.

use gcheck_controls::Effect;

use crate::kind::{Edit, Fear, Kind, Seed};
use crate::program::{Block, Program};

const MOVES: [Effect; 2] = [Effect::Rapid, Effect::Linear];
const CUTS: [Effect; 3] = [Effect::Linear, Effect::ArcClockwise, Effect::ArcCounterClockwise];

/// A line in front of the first cut of a tool, and what must be there for it to matter.
fn before_a_cut(p: &Program, line: &str) -> Vec<Seed> {
    p.each(|block| {
        let first =
            block.moves(&[Effect::Linear]) && block.code(&[Effect::Linear]).is_some() && block.after.feed;
        let fits = first
            && !block.before.is_subprogram
            && !block.before.is_compensating
            && !block.before.is_incremental;
        fits.then(|| p.line_above(block, line))
    })
}

/// The blocks after this one, up to the next that chooses what a feed means.
fn under_mode<'p>(p: &'p Program, block: &Block) -> impl Iterator<Item = &'p Block> {
    let modes = [Effect::FeedPerMinute, Effect::FeedPerRevolution, Effect::FeedInverseTime];
    p.behind(block).iter().take_while(move |next| next.code(&modes).is_none())
}

/// As [`before_a_cut`], where another tool comes after.
fn before_a_cut_of_several(p: &Program, line: &str) -> Vec<Seed> {
    let last = p
        .blocks
        .iter()
        .rfind(|block| block.code(&[Effect::ToolChange]).is_some())
        .map_or(0, |block| block.range.start);
    before_a_cut(p, line).into_iter().filter(|seed| seed.edits[0].range.start < last).collect()
}

/// `G91` in a block with a reference return.
fn return_in_increments(block: &Block) -> bool {
    block.code(&[Effect::Incremental]).is_some() && block.code(&[Effect::ReturnReference(1)]).is_some()
}

pub(super) const KINDS: &[Kind] = &[
    Kind::new(
        "units-never-said",
        Fear::Crash,
        "neither `G20` nor `G21` in the program",
        &["units-not-stated", "safe-start-missing"],
        |p| {
            let words = p.blocks.iter().filter_map(|block| block.code(&[Effect::Inch, Effect::Millimetre]));
            let all: Vec<Edit> = words.map(|word| p.without(word)).collect();
            if all.is_empty() { Vec::new() } else { vec![all.into()] }
        },
    )
    .without_machine()
    .anywhere(),
    Kind::new(
        "units-of-another-program",
        Fear::Crash,
        "a tool was pasted from a program in the other units (`G21` among inches)",
        &["units-changed"],
        |p| {
            let inch =
                p.blocks.iter().find_map(|block| block.code(&[Effect::Inch, Effect::Millimetre])?.effect);
            let other = if inch == Some(Effect::Inch) { "G21" } else { "G20" };
            p.each(|block| {
                let fits =
                    block.code(&[Effect::ToolChange]).is_some() && block.before.section > 0 && inch.is_some();
                fits.then(|| p.behind_words(block, other))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "increments-left-on",
        Fear::Crash,
        "`G90` is forgotten after `G91 G28`: the next moves are increments",
        &[
            "incremental-left-on",
            "maybe-incremental-left-on",
            "move-outside-travel",
            "rapid-plunge",
            "incremental-into-subprogram",
        ],
        |p| {
            p.each(|block| {
                let above = p.previous(block).filter(|_| block.code(&[Effect::Absolute]).is_some())?;
                let fits = return_in_increments(above)
                    || above.before.is_incremental && above.code(&[Effect::ReturnReference(1)]).is_some();
                fits.then_some(())?;
                // A program that says G90 again at the next tool fixes it: every G90 after is forgotten.
                let all = p.blocks[block.ix..].iter().filter_map(|block| block.code(&[Effect::Absolute]));
                Some(all.map(|word| p.without(word)).collect::<Vec<_>>())
            })
        },
    )
    .anywhere(),
    Kind::new(
        "increments-for-positions",
        Fear::Crash,
        "`G91` is typed for `G90` in front of a tool's first move",
        &[
            "incremental-left-on",
            "maybe-incremental-left-on",
            "move-outside-travel",
            "incremental-into-subprogram",
            "compensation-gouge",
            "arc-end-off-circle",
            "rapid-plunge",
            "refused-under-compensation",
            "reference-return-through-point",
            "cycle-r-below-bottom",
            "cycle-numbers-contradict",
            "machine-coordinates-in-increments",
        ],
        |p| {
            p.each(|block| {
                let word = block.code(&[Effect::Absolute]).filter(|_| block.moves(&[Effect::Rapid]))?;
                // After other moves of the tool it is another slip: some programs go by both all the time.
                let mut before = p.blocks[..block.ix].iter();
                let is_first = !before.any(|b| b.before.section == block.before.section && b.moves(&MOVES));
                is_first.then(|| p.instead(word, "G91"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "increments-into-subprogram",
        Fear::Crash,
        "`G91` is still on when a subprogram is called that is written in positions",
        &["incremental-into-subprogram", "incremental-left-on", "maybe-incremental-left-on"],
        |p| {
            p.each(|block| {
                let fits = block.code(&[Effect::CallProgram, Effect::CallLocal]).is_some()
                    && !block.before.is_incremental;
                fits.then(|| p.line_above(block, "G91"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "reference-in-positions",
        Fear::Crash,
        "`G28 Z0.` without `G91`: the tool goes to the part's zero first",
        &["reference-return-through-point"],
        |p| {
            p.each(|block| {
                let word = block
                    .code(&[Effect::Incremental])
                    .filter(|_| return_in_increments(block) && block.has(b"Z"))?;
                Some(p.without(word))
            })
        },
    ),
    Kind::new(
        "machine-move-in-increments",
        Fear::Alarm,
        "`G53` while `G91` is on, on a control that refuses it",
        &[
            "codes-conflict",
            "incremental-left-on",
            "axis-words-without-motion-mode",
            "machine-coordinates-in-increments",
        ],
        |p| {
            p.each(|block| {
                let fits = block.code(&[Effect::MachineCoordinates]).is_some() && p.is_for(&["linuxcnc"]);
                fits.then(|| p.line_above(block, "G91"))
            })
        },
    ),
    Kind::new(
        "wrong-plane",
        Fear::Scrap,
        "`G18` is active where arcs are meant in XY",
        &[
            "arc-wrong-plane-word",
            "arc-without-centre",
            "arc-end-off-circle",
            "arc-radius-too-small",
            "cycle-r-below-bottom",
            "zero-radius-arc",
            "full-circle-by-radius",
            "refused-under-compensation",
            "compensation-gouge",
        ],
        |p| {
            // A plane that is stated again before the next arc harms nobody, nor does one of an arc that is none of XY.
            let planes = [Effect::PlaneXy, Effect::PlaneZx, Effect::PlaneYz];
            let arcs = [Effect::ArcClockwise, Effect::ArcCounterClockwise];
            let first_arc = |block: &Block| {
                let mut behind = p.behind(block).iter().take_while(|next| next.code(&planes).is_none());
                behind.find(|next| next.moves(&arcs) || next.has(b"IJ") && next.code(&arcs).is_some())
            };
            p.each(|block| {
                let word = block.code(&[Effect::PlaneXy]).filter(|_| !p.is_lathe())?;
                let arc = first_arc(block)?;
                arc.has(b"YJ").then(|| p.instead(word, "G18"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "feed-per-turn-for-per-minute",
        Fear::Crash,
        "feed a turn (`G95`) is on while the numbers are feed a minute",
        &[
            "feed-of-another-mode",
            "feed-above-machine-limit",
            "maybe-feed-of-another-mode",
            "feed-missing",
            "feed-implausible",
        ],
        |p| {
            p.each(|block| {
                let word = block.code(&[Effect::FeedPerMinute]).filter(|_| !p.is_lathe())?;
                under_mode(p, block).any(|next| next.moves(&CUTS)).then(|| p.instead(word, "G95"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "inverse-time-without-feed",
        Fear::Alarm,
        "inverse time (`G93`) is on and blocks have no `F` of their own",
        &["inverse-time-feed-missing", "feed-of-another-mode"],
        |p| {
            if p.is_lathe() || p.text.contains("G93") {
                return Vec::new();
            }
            // With a feed in every block after it the control has what it asks for.
            let place = |seed: &Seed| seed.edits[0].range.start;
            let is_felt = |seed: &Seed| {
                let block = p.blocks.iter().find(|block| block.range.start >= place(seed));
                block.is_some_and(|block| {
                    under_mode(p, block).any(|next| next.moves(&CUTS) && !next.has(b"F"))
                })
            };
            before_a_cut(p, "G93").into_iter().filter(is_felt).collect()
        },
    )
    .anywhere(),
    Kind::new(
        "feed-mode-changed",
        Fear::Scrap,
        "the feed mode changes and the old `F` stays",
        &["feed-of-another-mode", "feed-missing", "maybe-feed-of-another-mode"],
        |p| {
            p.each(|block| {
                let fits = block.moves(&[Effect::Linear])
                    && !block.has(b"F")
                    && block.before.feed
                    && !p.is_lathe()
                    && !block.before.is_subprogram;
                fits.then(|| p.line_above(block, "G95"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "rotation-left-on",
        Fear::Crash,
        "coordinate rotation is never cancelled",
        &["rotation-left-on"],
        |p| {
            if p.is_lathe() || p.is_for(&["linuxcnc"]) {
                Vec::new()
            } else {
                before_a_cut_of_several(p, "G68 X0. Y0. R30.")
            }
        },
    )
    .anywhere(),
    Kind::new(
        "plane-under-rotation",
        Fear::Scrap,
        "another plane is chosen while a rotation is on",
        &["plane-changed-under-rotation"],
        |p| {
            if p.is_lathe() || p.is_for(&["linuxcnc"]) {
                Vec::new()
            } else {
                before_a_cut(p, "G68 X0. Y0. R30.\nG18")
            }
        },
    ),
    Kind::new("scaling-left-on", Fear::Crash, "scaling is never cancelled", &["scaling-left-on"], |p| {
        if p.is_lathe() || p.is_for(&["linuxcnc", "generic"]) {
            Vec::new()
        } else {
            before_a_cut_of_several(p, "G51 X0. Y0. P2000")
        }
    })
    .anywhere(),
    Kind::new("mirror-left-on", Fear::Crash, "mirror image is never cancelled", &["mirror-left-on"], |p| {
        if p.is_lathe() || p.is_for(&["linuxcnc", "generic"]) {
            return Vec::new();
        }
        before_a_cut_of_several(p, if p.is_for(&["haas"]) { "G101 X0." } else { "G51.1 X0." })
    })
    .anywhere(),
    Kind::new(
        "shift-left-on",
        Fear::Crash,
        "a shift (`G52`, `G92`) is never taken back",
        &["shift-left-on"],
        |p| {
            if p.is_lathe() {
                return Vec::new();
            }
            before_a_cut_of_several(p, if p.is_for(&["linuxcnc"]) { "G92 X10." } else { "G52 X10. Y0." })
        },
    )
    .anywhere(),
    Kind::new(
        "polar-left-on",
        Fear::Scrap,
        "polar coordinates are never cancelled",
        &["polar-coordinates-left-on"],
        |p| if p.is_for(&["fanuc-mill"]) { before_a_cut_of_several(p, "G16") } else { Vec::new() },
    )
    .anywhere(),
    Kind::new(
        "mode-in-skipped-block",
        Fear::Crash,
        "a mode is set in a block that `/` skips",
        &[
            "modal-change-in-skipped-block",
            "incremental-left-on",
            "maybe-incremental-left-on",
            "tool-length-missing",
            "maybe-spindle-stopped-while-cutting",
            "maybe-compensation-left-on",
            "spindle-stopped-while-cutting",
            "length-offset-of-another-tool",
        ],
        |p| {
            p.each(|block| {
                let modes =
                    [Effect::Absolute, Effect::LengthPlus, Effect::CompensationOff, Effect::SpindleClockwise];
                let fits = block.code(&modes).is_some()
                    && block.before.section > 0
                    && !block.is_skippable
                    && !p.is_for(&["linuxcnc"]);
                fits.then(|| Edit { range: block.range.start..block.range.start, text: "/".to_owned() })
            })
        },
    )
    .anywhere(),
    Kind::new(
        "offsets-written-without-number",
        Fear::Crash,
        "`G10 L2` without the offset's number",
        &["required-word-missing", "lasting-word-never-given"],
        |p| {
            p.each(|block| {
                let fits =
                    block.code(&[Effect::ToolChange]).is_some() && p.is_for(&["haas-mill", "linuxcnc"]);
                fits.then(|| p.line_above(block, "G10 L2 X0. Y0."))
            })
        },
    ),
    Kind::new(
        "motion-after-cancel",
        Fear::Alarm,
        "a position after `G80` without a motion mode, on a control that refuses it",
        &["axis-words-without-motion-mode"],
        |p| {
            p.each(|block| {
                let above = p.previous(block).filter(|above| above.code(&[Effect::CycleCancel]).is_some())?;
                // `G80 G00` in one block leaves the rapid on.
                above.after.motion.is_none().then_some(())?;
                let word = block.code(&[Effect::Rapid]).filter(|_| p.is_for(&["linuxcnc"]))?;
                (above.is_plain() && block.moves(&MOVES)).then(|| p.without(word))
            })
        },
    ),
];
