//! Where a canned cycle begins and ends, so that it can be written as the moves that it is made of.
//!
//! Knows: which blocks a cycle runs through, what comes after it. Must not know: how cycles move, how the moves are written.

use std::ops::Range;

use gcheck_controls::{CodeIx, Effect, LetterSet};
use gcheck_db::{BlockPlace, Snapshot};
use gcheck_edit::is_moves_and_dwells;
use gcheck_engine::Role;
use gcheck_program::BlockFlags;

use crate::lexemes::touches;

/// Blocks of one series.
const MOST_BLOCKS: u32 = 200;
/// Blocks after the series that are looked at for the motion that goes on.
const LOOK_AHEAD: u32 = 20;

/// The blocks of the cycle that begins at a place, with those that go on with it, when plain moves can take their place: it is
/// certain where it ends and what goes on then.
pub(super) fn cycle_at(snapshot: &Snapshot, offset: u32) -> Option<Range<u32>> {
    let first = snapshot.block_at(offset).filter(|place| touches(&place.range(), offset))?;
    let control = snapshot.control();
    let begins_cycle = first
        .table
        .words(first.block())
        .iter()
        .any(|word| control.code_at(word.code).is_some_and(|code| is_moves_and_dwells(code.effect())));
    if !begins_cycle || !fits(snapshot, &first, true) {
        return None;
    }
    let graph = snapshot.flow_graph();
    let mut end = first.range().end;
    let mut next = first.number + 1;
    loop {
        let place = snapshot.place(next)?;
        if !fits(snapshot, &place, false) {
            break;
        }
        let is_target = graph.may_be_target(next);
        if is_target && !place.block().letters.intersects(LetterSet::of("XYZ")) {
            break;
        }
        // A jump into the series would find other moves there.
        if is_target || next - first.number >= MOST_BLOCKS {
            return None;
        }
        end = place.range().end;
        next += 1;
    }
    goes_on_plainly(snapshot, next).then(|| first.range().start..end)
}

/// Has a block the cycle's own words alone beside its code, the level that it returns to and a sequence number?
fn fits(snapshot: &Snapshot, place: &BlockPlace, is_first: bool) -> bool {
    let role = |code: CodeIx| snapshot.control().code_at(code).and_then(|code| Role::of(code.effect()));
    let unfit = BlockFlags::ERROR
        | BlockFlags::STATEMENT
        | BlockFlags::EXPRESSION
        | BlockFlags::BLOCK_DELETE
        | BlockFlags::COMMENT
        | BlockFlags::PROGRAM_NUMBER
        | BlockFlags::TAPE_MARK;
    let own = LetterSet::of("XYZRQPFLKIJN");
    !place.block().flags.intersects(unfit)
        && place.table.words(place.block()).iter().all(|word| match role(word.code) {
            Some(Role::Cycle | Role::ReturnLevel) => is_first,
            Some(_) => false,
            None => word.code == CodeIx::NONE && own.contains(word.letter),
        })
}

/// Is the cycle ended after its series, and does the next move say how it moves?
fn goes_on_plainly(snapshot: &Snapshot, from: u32) -> bool {
    let control = snapshot.control();
    let mut is_ended = false;
    for number in from..from + LOOK_AHEAD {
        let Some(place) = snapshot.place(number) else { return false };
        let block = place.block();
        if block.flags.intersects(BlockFlags::STATEMENT | BlockFlags::BLOCK_DELETE) {
            return false;
        }
        let mut names_motion = false;
        for word in place.table.words(block) {
            let Some(code) = control.code_at(word.code) else { continue };
            match Role::of(code.effect()) {
                Some(Role::Motion) => {
                    names_motion = true;
                    is_ended = true;
                }
                Some(Role::Cycle) if code.effect() == Effect::CycleCancel => is_ended = true,
                Some(Role::Cycle) => return false,
                _ if code.entry().ends.is_some() => return is_ended,
                _ => {}
            }
        }
        if names_motion {
            return true;
        }
        if block.letters.intersects(control.axes()) {
            return false;
        }
    }
    false
}
