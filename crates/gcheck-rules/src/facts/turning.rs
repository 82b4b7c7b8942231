//! The profile that a roughing cycle of a lathe names, as its blocks write it.
//!
//! Knows: first and last block, the points that numbers give. Must not know: any rule, arcs, the passes of a cycle. A profile
//! with anything computed in it is not read.

use std::ops::Range;

use crate::facts::offset_schemes::whole;
use crate::facts::reach::is_on_the_face;
use crate::{PathCx, Uses};
use gcheck_controls::{Effect, LetterSet, Machine};
use gcheck_engine::{At, Axis, Fact, Role, Truth};
use gcheck_geometry::{Mm, Plane};
use gcheck_program::{BlockFlags, Place};

/// A profile that can be read.
#[derive(Debug)]
pub(crate) struct Profile {
    /// Where the tool is when the cycle begins.
    pub(crate) start: Point,
    /// The ends of its blocks that move, in order.
    pub(crate) points: Vec<Point>,
    /// Axes that the first block names.
    pub(crate) first_axes: LetterSet,
}

/// A point, in the units of the program; X as it is programmed.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    /// Across.
    pub(crate) x: f64,
    /// Along the spindle.
    pub(crate) z: f64,
    /// Reached in rapid: the way out of a profile is not part of it.
    pub(crate) is_rapid: bool,
    /// The block that leads there.
    pub(crate) range: Range<u32>,
}

impl Profile {
    /// Does its X grow along its way, and its way go toward the chuck? Then it is the outside of a part. `None` where it does
    /// neither, or both.
    pub(crate) fn grows_to_chuck(&self) -> Option<bool> {
        let feeds: Vec<&Point> = self.points.iter().skip(1).filter(|point| !point.is_rapid).collect();
        let first = self.points.first()?;
        let all = || std::iter::once(first).chain(feeds.iter().copied());
        let pairs = || all().zip(all().skip(1));
        let goes_back = pairs().any(|(from, to)| to.z > from.z + SLACK);
        let grows = pairs().any(|(from, to)| to.x > from.x + SLACK);
        let shrinks = pairs().any(|(from, to)| to.x < from.x - SLACK);
        (!goes_back && grows != shrinks).then_some(grows)
    }
}

/// In units of the program.
const SLACK: f64 = 0.01;

/// Blocks that are read; a longer profile is not judged.
const MAX_BLOCKS: u32 = 500;

/// May the program turn: the control is a lathe's, or the program says what X counts (`G7`, `G8` of a control for both)?
pub(crate) fn is_turned(program: &Uses<'_>) -> bool {
    program.environment.control().machine() == Machine::Lathe
        || program.may(|effect| matches!(effect, Effect::DiameterOn | Effect::DiameterOff))
}

/// Does the program turn: the control is a lathe's, or the program has said what X counts?
pub(crate) fn turns(cx: &PathCx<'_>) -> bool {
    cx.control().machine() == Machine::Lathe || cx.definitions().set_by(Fact::Mode(Role::Diameter)).is_some()
}

/// Does the part turn under a tool that does not, in the plane of X and Z?
pub(crate) fn turns_the_part(cx: &PathCx<'_>) -> bool {
    let state = cx.state();
    // While X and the C axis are the coordinates of the face, the C axis holds the part.
    turns(cx)
        && !is_on_the_face(cx)
        && state.plane(cx.model) == Some(Plane::Zx)
        && state.live_tool() == Truth::False
}

/// A radius as programs write it in X, and as findings name it.
pub(crate) fn shown_radius(cx: &PathCx<'_>, radius: f64) -> String {
    let is_diameter = cx.state().is_diameter(cx.model) == Some(true);
    cx.shown(Mm(if is_diameter { radius * 2.0 } else { radius }))
}

/// Does the code remove material layer by layer down to a profile?
pub(crate) fn is_roughing(effect: Effect) -> bool {
    matches!(effect, Effect::RoughAlongZ | Effect::RoughAlongX)
}

/// Does the code cut a profile in several passes, layers or copies, with an allowance, and go back to its start after each?
pub(crate) fn cuts_in_passes(effect: Effect) -> bool {
    is_roughing(effect) || effect == Effect::RepeatPattern
}

/// The first and the last block of the profile that `P` and `Q` of this block name.
pub(crate) fn profile_blocks(cx: &PathCx<'_>) -> Option<(At, At)> {
    let named = |letter: char| cx.known_number(letter).and_then(whole);
    let here = cx.origin().at;
    let file = cx.program.file(here.file).filter(|_| here.file == 0)?;
    let label = |letter: char, from: u32| file.loaded.flow_graph().label(named(letter)?, from, true);
    let first = label('P', here.block)?;
    let last = label('Q', first).filter(|last| *last >= first)?;
    Some((At { block: first, ..here }, At { block: last, ..here }))
}

/// The profile of a roughing cycle in positions. `None` where any number of it is not written as such.
pub(crate) fn profile(cx: &PathCx<'_>) -> Option<Profile> {
    let (first, last) = profile_blocks(cx)?;
    let semantics = cx.model.semantics();
    let has_own_letters = !semantics.increments.is_empty();
    let is_absolute = has_own_letters || cx.state().is_incremental(cx.model) == Some(false);
    if last.block - first.block > MAX_BLOCKS || !is_absolute {
        return None;
    }
    let units = cx.state().units(cx.model)?.in_mm();
    let half = if cx.state().is_diameter(cx.model)? { 2.0 } else { 1.0 };
    let at = cx.state().position();
    let (x, z) = (at.get(Axis::X)? * half / units, at.get(Axis::Z)? / units);
    let start = Point { x, z, is_rapid: true, range: cx.range() };
    let (mut x, mut z) = (x, z);
    let mut points = Vec::new();
    let mut is_rapid = cx.state().effect(Role::Motion, cx.model)? == Effect::Rapid;
    let mut first_axes = LetterSet::EMPTY;
    for block in first.block..=last.block {
        let place = cx.place_of(At { block, ..first })?;
        let letters = place.block().letters;
        let odd =
            BlockFlags::STATEMENT | BlockFlags::EXPRESSION | BlockFlags::ERROR | BlockFlags::BLOCK_DELETE;
        if place.block().flags.intersects(odd) || !is_plain(cx, &place) {
            return None;
        }
        if block == first.block {
            first_axes = letters.and(LetterSet::of("XZUW"));
        }
        for word in place.table.words(place.block()) {
            match cx.model.effect(word.code) {
                Effect::Rapid => is_rapid = true,
                Effect::Linear | Effect::ArcClockwise | Effect::ArcCounterClockwise => is_rapid = false,
                _ => {}
            }
            let Some(number) = word.number() else { continue };
            if word.letter.is_corner() {
                continue;
            }
            match word.letter.ascii() {
                b'X' => x = number,
                b'Z' => z = number,
                b'U' if has_own_letters => x += number,
                b'W' if has_own_letters => z += number,
                _ => {}
            }
        }
        if letters.intersects(LetterSet::of("XZUW")) {
            points.push(Point { x, z, is_rapid, range: place.range() });
        }
    }
    (!points.is_empty()).then_some(Profile { start, points, first_axes })
}

/// Does a block do nothing but move, with numbers that count as written?
fn is_plain(cx: &PathCx<'_>, place: &Place) -> bool {
    // What a number without a point counts, settings decide.
    let counts = |word: &gcheck_program::Word| {
        let is_axis = matches!(word.letter.ascii(), b'X' | b'Z' | b'U' | b'W') && !word.letter.is_corner();
        is_axis && !word.shape.point && word.number() != Some(0.0)
    };
    let as_written = cx.control().numbers().unpointed == gcheck_controls::Unpointed::AsWritten;
    let words = place.table.words(place.block());
    let codes = words.iter().filter(|word| word.code.is_some());
    let moves = |effect| {
        matches!(
            effect,
            Effect::None
                | Effect::Rapid
                | Effect::Linear
                | Effect::ArcClockwise
                | Effect::ArcCounterClockwise
                | Effect::CompensationLeft
                | Effect::CompensationRight
                | Effect::CompensationOff
        )
    };
    (as_written || !words.iter().any(counts))
        && codes.into_iter().all(|word| moves(cx.model.effect(word.code)))
}
