//! A canned cycle as the plain moves that it is made of.
//!
//! Knows: which blocks a cycle runs through, which cycles are moves and dwells alone. Must not know: how cycles move (the
//! engine does).

use gcheck_controls::{CodeIx, DwellWord, Effect, Letter, LetterSet};
use gcheck_db::{BlockPlace, Cancelled, Database, DocumentId, Snapshot, StateAt};
use gcheck_diagnostics::Edit;
use gcheck_engine::{At, Axis, Event, Look, PathMode, Position, Role, Transform, TravelKind, Units};
use gcheck_geometry::Seconds;
use gcheck_program::BlockFlags;

use super::action::{ActionKind, CodeAction};
use super::points::pointed;
use super::suppress::line_end;
use crate::figures::{decimals, in_units};
use crate::pieces::touches;
use crate::reading::Reading;

/// Blocks of one series, and moves that they may become.
const MOST_BLOCKS: usize = 200;
const MOST_LINES: usize = 2_000;
/// Blocks after the series that are looked at for the motion that goes on.
const LOOK_AHEAD: u32 = 20;

/// Offers to expand the cycle that begins in the block at a place, with the blocks that go on with it.
pub(super) fn offer(
    database: &mut Database,
    document: DocumentId,
    snapshot: &Snapshot,
    offset: u32,
    stop: &dyn Fn() -> bool,
    actions: &mut Vec<CodeAction>,
) -> Result<(), Cancelled> {
    let Some(first) = snapshot.block_at(offset).filter(|place| touches(&place.range(), offset)) else {
        return Ok(());
    };
    let Some(series) = series(snapshot, &first) else { return Ok(()) };
    let numbers = first.number..first.number + series.len() as u32;
    let mut texts: Vec<Vec<Line>> = Vec::new();
    let mut is_done = true;
    database.look(document, numbers, stop, &mut |state, look| {
        let place = series.iter().find(|place| place.number == state.block);
        let lines = place.and_then(|place| expanded(snapshot, place, state, look, texts.is_empty()));
        match lines {
            Some(lines) => join(&mut texts, lines),
            None => is_done = false,
        }
    })?;
    let count: usize = texts.iter().map(Vec::len).sum();
    if !is_done || texts.len() != series.len() || count > MOST_LINES {
        return Ok(());
    }
    let text = |lines: Vec<Line>| {
        lines.into_iter().map(|line| line.text).collect::<Vec<_>>().join(line_end(snapshot))
    };
    let edits =
        series.iter().zip(texts).map(|(place, lines)| Edit { range: place.range(), text: text(lines) });
    let edits = edits.collect();
    let title = format!("Write this cycle as {count} plain moves");
    actions.push(CodeAction::change(title, ActionKind::Rewrite, edits));
    Ok(())
}

/// A line of an expanded cycle.
struct Line {
    text: String,
    /// It says how corners are taken.
    is_of_corners: bool,
}

/// Adds the lines of the next block. What the one before says of corners at its end, and this one takes back, is left out.
fn join(texts: &mut Vec<Vec<Line>>, mut lines: Vec<Line>) {
    if let Some(before) = texts.last_mut()
        && before.len() > 1
        && before.last().is_some_and(|line| line.is_of_corners)
        && lines.first().is_some_and(|line| line.is_of_corners)
    {
        before.pop();
        lines.remove(0);
    }
    texts.push(lines);
}

/// The block that begins a cycle and those that go on with it, when it is certain where it ends and what goes on then.
fn series(snapshot: &Snapshot, first: &BlockPlace) -> Option<Vec<BlockPlace>> {
    let control = snapshot.control();
    let role = |code: CodeIx| control.code_at(code).and_then(|code| Role::of(code.effect()));
    let is_cycle = |place: &BlockPlace| {
        place.table.words(place.block()).iter().any(|word| {
            role(word.code) == Some(Role::Cycle)
                && control.code_at(word.code).is_some_and(|code| code.effect() != Effect::CycleCancel)
        })
    };
    if !is_cycle(first) {
        return None;
    }
    let unfit = BlockFlags::ERROR
        | BlockFlags::STATEMENT
        | BlockFlags::EXPRESSION
        | BlockFlags::BLOCK_DELETE
        | BlockFlags::COMMENT
        | BlockFlags::PROGRAM_NUMBER
        | BlockFlags::TAPE_MARK;
    // Beside the cycle only its own words, the level it returns to and a sequence number may be.
    let fits = |place: &BlockPlace, is_first: bool| {
        let words = place.table.words(place.block());
        let own = LetterSet::of("XYZRQPFLKIJN");
        !place.block().flags.intersects(unfit)
            && words.iter().all(|word| match role(word.code) {
                Some(Role::Cycle | Role::ReturnLevel) => is_first,
                Some(_) => false,
                None => word.code == CodeIx::NONE && own.contains(word.letter),
            })
    };
    if !fits(first, true) {
        return None;
    }
    let mut series = vec![first.clone()];
    let outline = snapshot.outline();
    let mut next = first.number + 1;
    let end = loop {
        let place = snapshot.place(next)?;
        let is_only_words = fits(&place, false);
        if !is_only_words
            || outline.may_be_target(next) && !place.block().letters.intersects(LetterSet::of("XYZ"))
        {
            break next;
        }
        if series.len() >= MOST_BLOCKS {
            return None;
        }
        series.push(place);
        next += 1;
    };
    // Jumps into the series would find other moves there.
    let is_jumped_to = series.iter().skip(1).any(|place| outline.may_be_target(place.number));
    (!is_jumped_to && goes_on_plainly(snapshot, end)).then_some(series)
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

/// The moves of one block, one a line; `None` when there is more to it than moves and dwells.
fn expanded(
    snapshot: &Snapshot,
    place: &BlockPlace,
    state: &StateAt,
    look: &mut Look<'_, '_>,
    is_first: bool,
) -> Option<Vec<Line>> {
    let model = look.model();
    let reading = Reading::new(snapshot, model);
    let before = &state.before;
    let is_off = |role: Role, off: Effect| {
        let mode = before.mode(role).only();
        mode.is_some_and(|code| !code.is_some() || model.effect(code) == off)
    };
    let is_plain = *before.transform() == Transform::NONE
        && before.is_incremental(model) == Some(false)
        && is_off(Role::Compensation, Effect::CompensationOff)
        && is_off(Role::Polar, Effect::PolarOff);
    if !is_plain {
        return None;
    }
    let trial = look.execute(At { file: 0, block: place.number }, before);
    let after = trial.after.as_ref().filter(|_| trial.fault.is_none() && !trial.is_cut_short)?;
    let (units, diameter) = (reading.units(after), reading.diameter(after));
    let (rapid, feed) = (code(snapshot, Effect::Rapid)?, code(snapshot, Effect::Linear)?);
    let words = place.table.words(place.block());
    let mut head = String::new();
    for word in words {
        let is_level = snapshot
            .control()
            .code_at(word.code)
            .is_some_and(|code| Role::of(code.effect()) == Some(Role::ReturnLevel));
        if is_level || word.letter == Letter::of('N') {
            head.push_str(snapshot.slice(place.in_file(word.range())).trim());
            head.push(' ');
        }
    }
    let mut feed_word = is_first.then(|| reading.feed(after)).flatten();
    let mut lines: Vec<Line> = Vec::new();
    for event in &trial.events {
        let text = match event {
            Event::Travel(travel) => {
                let words = point(&travel.from, &travel.to, units, diameter)?;
                if words.is_empty() {
                    continue;
                }
                match travel.kind {
                    TravelKind::Rapid => format!("{rapid} {words}"),
                    TravelKind::Feed => {
                        let feed_word = feed_word.take();
                        let number = feed_word.as_deref().and_then(|word| word.split(' ').next());
                        let number = number.and_then(|word| word.strip_prefix('F')?.parse().ok());
                        let with = number.map(|number| format!(" F{}", pointed(number)));
                        format!("{feed} {words}{}", with.unwrap_or_default())
                    }
                    TravelKind::Probe { .. } | TravelKind::Thread => return None,
                }
            }
            Event::Dwell(seconds) => dwell(snapshot, *seconds)?,
            // The cycle takes corners otherwise than the program says, or does so no more.
            Event::PathMode(mode) => corners(snapshot, *mode, units)?,
            Event::Modal(_) | Event::FeedRate(_) | Event::FeedMode(_) => continue,
            _ => return None,
        };
        let is_of_corners = matches!(event, Event::PathMode(_));
        lines.push(Line { text: format!("{}{text}", std::mem::take(&mut head)), is_of_corners });
        if lines.len() > MOST_LINES {
            return None;
        }
    }
    (!lines.is_empty()).then_some(lines)
}

/// The coordinates that a move changes; `None` when one is unknown.
fn point(from: &Position, to: &Position, units: Units, diameter: bool) -> Option<String> {
    let mut words = Vec::new();
    for axis in Axis::ALL {
        let (old, new) = (from.raw(axis), to.raw(axis));
        if old.to_bits() == new.to_bits() {
            continue;
        }
        let new = Some(new).filter(|new| !new.is_nan())?;
        let value = in_units(axis, new, units, diameter);
        let scale: f64 = (0..decimals(units)).map(|_| 10.0).product();
        words.push(format!("{}{}", axis.name(), pointed((value * scale).round() / scale + 0.0)));
    }
    Some(words.join(" "))
}

/// A dwell as the control reads it.
fn dwell(snapshot: &Snapshot, seconds: Seconds) -> Option<String> {
    let code = code(snapshot, Effect::Dwell)?;
    let rules = &snapshot.control().semantics().dwell;
    let (letter, kind) = rules.get_key_value("P").or_else(|| rules.iter().next())?;
    if !seconds.is_finite() {
        return None;
    }
    Some(match kind {
        DwellWord::Seconds | DwellWord::SecondsOrMilliseconds => {
            format!("{code} {letter}{}", pointed(seconds.0))
        }
        DwellWord::Milliseconds => format!("{code} {letter}{}", (seconds.0 * 1000.0).round()),
    })
}

/// The code for a way to take corners.
fn corners(snapshot: &Snapshot, mode: PathMode, units: Units) -> Option<String> {
    let (effect, lengths) = mode.written();
    let mut text = code(snapshot, effect)?.to_owned();
    for (letter, length) in lengths {
        // Finer than any tolerance is given.
        text = format!("{text} {letter}{}", pointed((length.0 / units.in_mm() * 1e5).round() / 1e5));
    }
    Some(text)
}

/// The first code with an effect.
fn code(snapshot: &Snapshot, effect: Effect) -> Option<&str> {
    let found = snapshot.control().codes().find(|code| code.effect() == effect)?;
    Some(&found.entry().code)
}
