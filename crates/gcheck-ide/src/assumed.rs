//! What the states of a program rest on that nobody can know from its text.
//!
//! Knows: calls of programs that are not here, and probing codes, before a place. Must not know: states, how they are shown.

use gcheck_controls::Effect;
use gcheck_db::Snapshot;
use gcheck_program::CallKind;

/// Programs that are named.
const MOST_NAMED: usize = 3;

/// What is assumed on the way to a byte, in a few words: programs that are not here change nothing, a probe touches at its
/// target. `None` where the text before has neither.
pub(crate) fn assumed(snapshot: &Snapshot, before: u32) -> Option<String> {
    let parts: Vec<String> = missing(snapshot, before).into_iter().chain(probe(snapshot, before)).collect();
    (!parts.is_empty()).then(|| format!("assumed: {}", parts.join("; ")))
}

fn missing(snapshot: &Snapshot, before: u32) -> Option<String> {
    let file_index = snapshot.file_index();
    let programs = &snapshot.settings().programs;
    let is_here = |number: u32| {
        let is = |known: u32| known == number || known == number % 10_000;
        file_index.programs.iter().filter_map(|program| program.number).any(is)
            || file_index.labels.iter().any(|label| is(label.number))
            || programs.has_number(number)
    };
    let mut names: Vec<String> = Vec::new();
    for call in file_index.calls.iter().take_while(|call| call.range.start < before) {
        if let CallKind::Program(number) = call.target
            && !names.iter().any(|name| *name == format!("O{number}"))
            && !is_here(number)
        {
            names.push(format!("O{number}"));
        }
    }
    let more = names.len().saturating_sub(MOST_NAMED);
    names.truncate(MOST_NAMED);
    if more > 0 {
        names.push(format!("{more} more"));
    }
    let (last, others) = names.split_last()?;
    Some(match others {
        [] => format!("{last}, which was not found, changes nothing"),
        _ => format!("{} and {last}, which were not found, change nothing", others.join(", ")),
    })
}

fn probe(snapshot: &Snapshot, before: u32) -> Option<String> {
    let control = snapshot.control();
    let is_probe = |effect: Effect| effect.is_probing_move() || effect == Effect::Skip;
    let mut codes = snapshot.file_index().codes.iter().take_while(|(_, range)| range.start < before);
    let found = codes.any(|(number, _)| control.code(*number).is_some_and(|code| is_probe(code.effect())));
    found.then(|| "the probe touches at its target".to_owned())
}
