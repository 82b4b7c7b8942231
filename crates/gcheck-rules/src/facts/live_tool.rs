//! Whether a block of a lathe works with a live tool, and whether that may turn.
//!
//! Knows: the C axis, the cycles of live tools, functions of machine builders with a speed. Must not know: any rule.

use gcheck_controls::{CodeIx, Effect, LetterSet};
use gcheck_engine::{At, Event, Fact, Role};
use gcheck_geometry::Plane;
use gcheck_program::{Place, Word};

use crate::facts::cutting::starts_spindle;
use crate::facts::program_calls::calls_other_files;
use crate::facts::tool_words::ToolWords;
use crate::{PathCx, remembers};

/// What blocks have shown of a live tool, in the order in which they are executed: a called program works between two blocks that
/// are next to each other in the text, or far from them.
///
/// A rule keeps one, and shows it every block, every rapid move and every event that is not a move.
#[derive(Debug, Default, Clone, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts of what was executed")]
pub(crate) struct Executed {
    /// Since the tool came, the C axis was moved or engaged, or the machine builder's codes were executed.
    may_be_live: bool,
    /// Since the spindle started, the part may have come to rest.
    may_hold_part: bool,
    /// Since the tool came and anything started, a block worked with the C axis.
    is_live: bool,
    /// In the same time, a code of the machine builder with a speed was executed.
    may_turn: bool,
    /// The file calls programs of other files; none before a block asked.
    calls_elsewhere: Option<bool>,
}

remembers!(Executed);

impl Executed {
    /// A block begins.
    pub(crate) fn block(&mut self, cx: &PathCx<'_>) {
        if cx.is_mill() {
            return;
        }
        if cx.has_effect(starts_spindle) {
            (self.is_live, self.may_turn) = (false, false);
        }
        if cx.has_effect(Effect::starts_spindle) {
            self.may_hold_part = false;
        }
        let Some(place) = cx.place() else { return };
        let words = place.table.words(place.block());
        // What a program of another file does is not shown.
        let is_elsewhere = cx.has_effect(Effect::calls)
            && *self.calls_elsewhere.get_or_insert_with(|| calls_other_files(cx.file_index));
        let turns_c = place.block().letters.intersects(LetterSet::of("CH")) && cx.has_effect(is_rapid);
        let has_speed = place.block().letters.intersects(LetterSet::of("SP"));
        let has_c_axis = words.iter().any(|word| is_of(cx, word.code, &[C_AXIS]));
        self.may_be_live |= is_elsewhere || has_c_axis || turns_c || has_builders(cx, words);
        self.may_hold_part |= is_elsewhere || turns_c || words.iter().any(|word| holds(cx, word));
        self.may_hold_part |= has_builders(cx, words);
        self.is_live |= turns_c || words.iter().any(|word| is_of(cx, word.code, &GROUPS));
        self.may_turn |= is_elsewhere || has_speed && has_builders(cx, words);
    }

    /// The axes move at rapid.
    pub(crate) fn rapid(&mut self, cx: &PathCx<'_>) {
        if !cx.is_mill() && cx.origin().letters.intersects(LetterSet::of("CH")) {
            (self.may_be_live, self.may_hold_part) = (true, true);
        }
    }

    /// An event that is not a move.
    pub(crate) fn changed(&mut self, cx: &PathCx<'_>, event: &Event) {
        if matches!(event, Event::ToolChange(_)) {
            let Self { may_hold_part, calls_elsewhere, .. } = *self;
            *self = Self { may_hold_part, calls_elsewhere, ..Self::default() };
            self.block(cx);
        }
    }

    /// May a live tool work that the state does not know of?
    pub(crate) fn may_be_live(&self, cx: &PathCx<'_>) -> bool {
        self.may_be_live || may_be_live(cx) || ToolWords::of(cx).is_powered()
    }

    /// May the part be at rest although the spindle was started in this block?
    pub(crate) fn may_hold_part(&self, cx: &PathCx<'_>, started: At) -> bool {
        self.may_hold_part || may_hold_part_since(cx, started.block)
    }

    /// What shows of a live tool in the block and before it.
    pub(crate) fn live_tool(&self, cx: &PathCx<'_>) -> LiveTool {
        match live_tool(cx) {
            LiveTool::MayTurn => LiveTool::MayTurn,
            _ if self.may_turn => LiveTool::MayTurn,
            LiveTool::No if self.is_live => LiveTool::Stands,
            shown => shown,
        }
    }
}

fn is_rapid(effect: Effect) -> bool {
    effect == Effect::Rapid
}

/// Is it a code of one of these modal groups?
fn is_of(cx: &PathCx<'_>, code: CodeIx, groups: &[&str]) -> bool {
    cx.code_of(code).is_some_and(|code| groups.contains(&code.entry().group.as_str()))
}

/// Does the code engage the C axis, hold the spindle at an angle, or stop the program?
fn holds(cx: &PathCx<'_>, word: &Word) -> bool {
    is_of(cx, word.code, &[C_AXIS])
        || matches!(cx.model.effect(word.code), Effect::SpindleOrient | Effect::Stop)
}

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
fn live_tool(cx: &PathCx<'_>) -> LiveTool {
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
        is_live |= turns || words.iter().any(|word| is_of(cx, word.code, &GROUPS));
    }
    if is_live { LiveTool::Stands } else { LiveTool::No }
}

/// May a live tool work that the state does not know of? The block, or one before it since the tool came, moves the C axis, or has
/// an M code whose meaning is the machine builder's.
fn may_be_live(cx: &PathCx<'_>) -> bool {
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
fn may_hold_part_since(cx: &PathCx<'_>, first: u32) -> bool {
    first > cx.origin().at.block
        || some_block_since(cx, first, |place| {
            let words = place.table.words(place.block());
            place.block().letters.intersects(LetterSet::of("CHY"))
                || words.iter().any(|word| holds(cx, word))
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
