//! Whether a block of a lathe works with a live tool, and whether that may turn.
//!
//! Knows: the C axis, the cycles of live tools, functions of machine builders with a speed. Must not know: any rule.

use gcheck_controls::{CodeIx, Effect, LetterSet};
use gcheck_engine::{At, Fact, Role};
use gcheck_geometry::Plane;
use gcheck_program::{Place, Word};

use crate::PathCx;
use crate::facts::cutting::starts_spindle;

/// What shows of a live tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LiveTool {
    /// Nothing: the part turns, or should.
    No,
    /// The block works with one, and nothing starts it.
    Stands,
    /// A code whose meaning is the machine builder's may have started it.
    MayTurn,
}

/// The modal groups of codes that a lathe has for live tools.
const GROUPS: [&str; 2] = [C_AXIS, "live-tool"];
/// The modal group of the codes that make the spindle an axis.
const C_AXIS: &str = "c-axis";
/// Blocks before this one that are searched, as far as they belong to the same tool.
const BEFORE: u32 = 60;

/// Of the block, with what comes before it since the tool came.
pub(crate) fn live_tool(cx: &PathCx<'_>) -> LiveTool {
    if cx.is_mill() {
        return LiveTool::No;
    }
    let here = cx.origin().at;
    let changed =
        cx.definitions().set_by(Fact::Tool).filter(|at| at.file == here.file && at.block <= here.block);
    let first = changed.map_or(0, |at| at.block).max(here.block.saturating_sub(BEFORE));
    let is_polar =
        cx.state().effect(Role::PolarInterpolation, cx.model) == Some(Effect::PolarInterpolationOn);
    let is_other_plane = cx.state().plane(cx.model).is_some_and(|plane| plane != Plane::Zx);
    let mut is_live = is_polar || is_other_plane;
    for block in (first..=here.block).rev() {
        let Some(place) = cx.place_of(At { block, ..here }) else { continue };
        let words = place.table.words(place.block());
        if words.iter().any(|word| starts_spindle(cx.model.effect(word.code))) {
            break;
        }
        let has_speed = place.block().letters.intersects(LetterSet::of("SP"));
        if has_speed && words.iter().any(|word| is_function(cx, word.letter.ascii(), word.code)) {
            return LiveTool::MayTurn;
        }
        // In a feed move with X or Z the letter may be a chamfer.
        let letters = place.block().letters;
        let is_rapid = words.iter().any(|word| cx.model.effect(word.code) == Effect::Rapid);
        let turns = letters.intersects(LetterSet::of("C"))
            && (is_rapid || !letters.intersects(LetterSet::of("XZUW")));
        let is_of_live_tools =
            |code: CodeIx| cx.code_of(code).is_some_and(|code| GROUPS.contains(&code.entry().group.as_str()));
        is_live |= turns || words.iter().any(|word| is_of_live_tools(word.code));
    }
    if is_live { LiveTool::Stands } else { LiveTool::No }
}

/// May a live tool work that the state does not know of? The block, or one before it since the tool came, moves the C axis, or has
/// an M code whose meaning is the machine builder's.
pub(crate) fn may_be_live(cx: &PathCx<'_>) -> bool {
    let here = cx.origin().at;
    let changed =
        cx.definitions().set_by(Fact::Tool).filter(|at| at.file == here.file && at.block <= here.block);
    // On lathes `M13` may be the start of a live tool as well.
    let starts_with_coolant = |effect| {
        matches!(effect, Effect::SpindleClockwiseWithCoolant | Effect::SpindleCounterClockwiseWithCoolant)
    };
    some_block_since(cx, changed.map_or(0, |at| at.block), |place| {
        let words = place.table.words(place.block());
        place.block().letters.intersects(LetterSet::of("CHY"))
            || words.iter().any(|word| starts_with_coolant(cx.model.effect(word.code)))
            || has_builders(cx, words)
    })
}

/// May the part be at rest although the spindle was started: does a block from this one of the main file on engage the C axis or move
/// it, hold the spindle at an angle, stop the program, or have an M code of the machine builder?
pub(crate) fn may_hold_part_since(cx: &PathCx<'_>, first: u32) -> bool {
    first > cx.origin().at.block
        || some_block_since(cx, first, |place| {
            let words = place.table.words(place.block());
            let holds = |word: &Word| {
                let is_c_axis = cx.code_of(word.code).is_some_and(|code| code.entry().group == C_AXIS);
                is_c_axis || matches!(cx.model.effect(word.code), Effect::SpindleOrient | Effect::Stop)
            };
            place.block().letters.intersects(LetterSet::of("CHY"))
                || words.iter().any(holds)
                || has_builders(cx, words)
        })
}

/// Is there an M code whose meaning is the machine builder's in the blocks from this one of the main file up to the one that is
/// shown? Also where they do not follow each other.
pub(crate) fn builders_since(cx: &PathCx<'_>, first: u32) -> bool {
    first > cx.origin().at.block
        || some_block_since(cx, first, |place| has_builders(cx, place.table.words(place.block())))
}

/// Does this hold for a block from there up to the one that is shown? Also where a block is not known.
fn some_block_since(cx: &PathCx<'_>, first: u32, is: impl Fn(&Place) -> bool) -> bool {
    let here = cx.origin().at;
    (first..=here.block).any(|block| cx.place_of(At { block, ..here }).is_none_or(|place| is(&place)))
}

fn has_builders(cx: &PathCx<'_>, words: &[Word]) -> bool {
    words.iter().any(|word| is_function(cx, word.letter.ascii(), word.code))
}

/// Is it an M code that does what the machine builder made of it?
fn is_function(cx: &PathCx<'_>, letter: u8, code: CodeIx) -> bool {
    letter == b'M' && cx.code_of(code).is_none_or(|code| code.is_user() || code.entry().group == "m-user")
}
