//! Mistakes with cutter compensation.
//!
//! Knows: how each is made. Must not know: the findings about it.

use gcheck_controls::Effect;

use crate::kind::{Fear, Kind};
use crate::program::{Block, Program, Word};

const ON: [Effect; 4] = [
    Effect::CompensationLeft,
    Effect::CompensationRight,
    Effect::CompensationLeftByDiameter,
    Effect::CompensationRightByDiameter,
];
const ARCS: [Effect; 2] = [Effect::ArcClockwise, Effect::ArcCounterClockwise];

/// `G40` that really ends compensation.
fn off(block: &Block) -> Option<&Word> {
    block.code(&[Effect::CompensationOff]).filter(|_| block.before.is_compensating)
}

/// The block before which compensation was switched on is in the profile of a roughing cycle that no finishing cycle
/// follows: the profile tells the cycle a shape, and its blocks are never carried out.
fn is_only_described(p: &Program, off: &Block) -> bool {
    let Some(on) = p.blocks[..off.ix].iter().rposition(|block| block.code(&ON).is_some()) else {
        return false;
    };
    let label = |number| p.blocks.iter().position(|b| b.word(b'N').is_some_and(|n| n.number == number));
    let describes = |cycle: &&Block| {
        let [first, last] = [b'P', b'Q'].map(|letter| cycle.word(letter).and_then(|word| label(word.number)));
        cycle.code(&[Effect::RoughAlongZ, Effect::RoughAlongX]).is_some()
            && first.zip(last).is_some_and(|(first, last)| (first..=last).contains(&on))
    };
    p.blocks.iter().any(|block| describes(&block))
        && p.blocks.iter().all(|block| block.code(&[Effect::FinishProfile]).is_none())
}

/// A straight cut on a compensated contour.
fn on_the_contour(p: &Program, block: &Block) -> bool {
    let above = p.previous(block);
    block.before.is_compensating
        && block.after.is_compensating
        && block.moves(&[Effect::Linear])
        && above.is_some_and(|above| {
            above.moves(&[Effect::Linear, Effect::ArcClockwise, Effect::ArcCounterClockwise])
        })
}

pub(super) const KINDS: &[Kind] = &[
    Kind::new(
        "compensation-left-on",
        Fear::Crash,
        "`G40` is forgotten",
        &[
            "compensation-left-on",
            "maybe-compensation-left-on",
            "refused-under-compensation",
            "compensation-gouge",
            "cycle-under-compensation",
        ],
        |p| {
            p.each(|block| {
                off(block).filter(|_| !is_only_described(p, block))?;
                // A tool change or the next tool's first line would fix it: every G40 after is forgotten.
                let all =
                    p.blocks[block.ix..].iter().filter_map(|block| block.code(&[Effect::CompensationOff]));
                Some(all.map(|word| p.without(word)).collect::<Vec<_>>())
            })
        },
    )
    .anywhere(),
    Kind::new(
        "compensation-on-in-arc",
        Fear::Alarm,
        "compensation begins in an arc",
        &["compensation-on-in-arc"],
        |p| {
            p.each(|block| {
                let code = block
                    .code(&ON)
                    .filter(|_| !block.before.is_compensating && !p.is_lathe() && !p.is_for(&["linuxcnc"]))?;
                let arc = p
                    .behind(block)
                    .iter()
                    .take(6)
                    .find(|next| next.moves(&ARCS) && next.code(&ARCS).is_some())?;
                let size = block.word(b'D');
                let both = format!(
                    "{}{}",
                    p.words_of(code),
                    size.map(|d| format!(" {}", p.words_of(d))).unwrap_or_default()
                );
                let edits = [p.without(code)].into_iter().chain(size.map(|word| p.without(word)));
                Some(edits.chain([p.behind_words(arc, both)]).collect::<Vec<_>>())
            })
        },
    )
    .anywhere(),
    Kind::new(
        "compensation-off-in-arc",
        Fear::Alarm,
        "compensation ends in an arc",
        &["compensation-off-in-arc"],
        |p| {
            p.each(|block| {
                let code = off(block).filter(|_| !p.is_lathe())?;
                let arc = p.blocks[..block.ix]
                    .iter()
                    .rev()
                    .take(6)
                    .find(|b| b.moves(&ARCS) && b.code(&ARCS).is_some() && b.before.is_compensating)?;
                Some(vec![p.without(code), p.behind_words(arc, p.words_of(code))])
            })
        },
    )
    .anywhere(),
    Kind::new(
        "plane-under-compensation",
        Fear::Alarm,
        "the plane is changed while compensation is on, on a control that refuses it",
        &["refused-under-compensation"],
        |p| {
            p.each(|block| {
                let planes = [Effect::PlaneXy, Effect::PlaneZx, Effect::PlaneYz];
                let plane = p.blocks[..block.ix].iter().rev().find_map(|before| before.code(&planes)?.effect);
                // In the plane that is active anyway the code changes nothing.
                let changes = plane != Some(Effect::PlaneZx) && !p.is_lathe();
                (on_the_contour(p, block) && changes && p.is_for(&["linuxcnc", "fanuc"]))
                    .then(|| p.line_above(block, "G18"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "reference-under-compensation",
        Fear::Crash,
        "`G28` while compensation is on, on a control that refuses it",
        &["refused-under-compensation", "compensation-left-on", "reference-return-through-point"],
        |p| {
            p.each(|block| {
                (on_the_contour(p, block) && !p.is_lathe() && p.is_for(&["linuxcnc"]))
                    .then(|| p.line_above(block, "G28 Z5"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "tool-change-under-compensation",
        Fear::Crash,
        "a tool change while compensation is on",
        &["compensation-left-on", "refused-under-compensation"],
        |p| {
            p.each(|block| (on_the_contour(p, block) && !p.is_lathe()).then(|| p.line_above(block, "T1 M06")))
        },
    )
    .anywhere(),
    Kind::new(
        "lead-in-too-short",
        Fear::Scrap,
        "the lead-in is shorter than the tool's radius",
        &["lead-in-too-short", "compensation-gouge"],
        |p| {
            p.each(|block| {
                block.code(&ON).filter(|_| {
                    !p.is_lathe()
                        && !block.before.is_subprogram
                        && block.moves(&[Effect::Linear])
                        && block.has(b"X")
                        && block.has(b"Y")
                })?;
                let above = p.blocks[..block.ix].iter().rev().find(|b| b.has(b"X") && b.has(b"Y"))?;
                let (x, y) = (block.word(b'X')?, block.word(b'Y')?);
                let (from_x, from_y) = (above.word(b'X')?.number?, above.word(b'Y')?.number?);
                // Begin a hair away from where the contour is to begin.
                let (to_x, to_y) = (x.number?, y.number?);
                let near = |from: f64, to: f64| {
                    format!(
                        "{:.3}",
                        from + (to - from).signum() * 0.05 * f64::from(u8::from((to - from).abs() > 1e-9))
                    )
                };
                Some(vec![p.value(x, near(from_x, to_x)), p.value(y, near(from_y, to_y))])
            })
        },
    )
    .with_machine(),
    Kind::new(
        "bore-smaller-than-tool",
        Fear::Scrap,
        "a bore is smaller than the tool that goes round in it",
        &["compensation-gouge", "lead-in-too-short"],
        |p| {
            p.each(|block| {
                let circle = block.before.is_compensating && block.moves(&ARCS) && !p.is_lathe();
                let (x, i) = (block.word(b'X').filter(|_| circle)?, block.word(b'I')?);
                let above = p.previous(block).filter(|above| above.code(&ON).is_some())?;
                let start = above
                    .word(b'X')
                    .filter(|word| word.number == x.number && i.number == x.number.map(|x| -x))?;
                let small = |word: &Word| p.value(word, format!("{:.3}", word.number.unwrap() / 5.0));
                Some(vec![small(start), small(x), small(i)])
            })
        },
    )
    .with_machine()
    .anywhere(),
];
