//! What two runs do between moves: dwells, stops, tool changes.
//!
//! Knows: which of them belong together. Must not know: moves.

use std::sync::Arc as Shared;

use super::difference::{Aspect, Differences, Place, Value};
use super::same::{known_differ, rate_differs};
use crate::trail::{Act, Doing, Stand};

/// Matches what both sides do between the same two moves, in order, and adds what has no counterpart or another value.
///
/// Where both sides go on before the next move, what comes after the last pair is left, because its counterpart may follow: the
/// answer is how much that is.
pub(super) fn compare(found: &mut Differences, a: &[&Act], b: &[&Act], both_go_on: bool) -> [usize; 2] {
    let counts = [a.len(), b.len()];
    let (a, b) = (&without_shuttle(a), &without_shuttle(b));
    let pairs = pairs(a, b);
    let is_whole = counts == [a.len(), b.len()];
    let ends = match pairs.last() {
        Some((last_a, last_b)) if both_go_on && is_whole => (last_a + 1, last_b + 1),
        _ => (a.len(), b.len()),
    };
    let (mut next_a, mut next_b) = (0, 0);
    for (at_a, at_b) in pairs.into_iter().chain([ends]) {
        for act in a.get(next_a..at_a).unwrap_or_default() {
            one_sided(found, act, true);
        }
        for act in b.get(next_b..at_b).unwrap_or_default() {
            one_sided(found, act, false);
        }
        if (at_a, at_b) == ends {
            break;
        }
        if let (Some(of_a), Some(of_b)) = (a.get(at_a), b.get(at_b)) {
            matched(found, of_a, of_b);
        }
        (next_a, next_b) = (at_a + 1, at_b + 1);
    }
    [a.len() - ends.0, b.len() - ends.1]
}

impl Act {
    /// Does the tool wait here in any case: for a time, or for the operator?
    pub(super) const fn waits(&self) -> bool {
        matches!(self.doing, Doing::Stand(Stand::Dwell(_) | Stand::Stop { optional: false }))
    }
}

/// Where the end of a program moves pallets, it is an end all the same.
fn without_shuttle<'a>(acts: &[&'a Act]) -> Vec<&'a Act> {
    let is_end = |act: Option<&&Act>| act.and_then(|act| stand(act)) == Some(&Stand::End);
    let next = (1..).map(|next| is_end(acts.get(next)));
    let is_kept = |act: &Act, ends: bool| !(ends && stand(act) == Some(&Stand::Pallet));
    acts.iter().copied().zip(next).filter(|(act, ends)| is_kept(act, *ends)).map(|(act, _)| act).collect()
}

/// The longest sequence of pairs of one kind.
fn pairs(a: &[&Act], b: &[&Act]) -> Vec<(usize, usize)> {
    let width = b.len() + 1;
    // How many pairs there can be from here on.
    let mut most = vec![0_u32; (a.len() + 1) * width];
    let at = |most: &[u32], i: usize, j: usize| most.get(i * width + j).copied().unwrap_or(0);
    for (i, of_a) in a.iter().enumerate().rev() {
        for (j, of_b) in b.iter().enumerate().rev() {
            let best = if is_alike(of_a, of_b) {
                at(&most, i + 1, j + 1) + 1
            } else {
                at(&most, i + 1, j).max(at(&most, i, j + 1))
            };
            if let Some(slot) = most.get_mut(i * width + j) {
                *slot = best;
            }
        }
    }
    let mut pairs = Vec::new();
    let (mut i, mut j) = (0, 0);
    while let (Some(of_a), Some(of_b)) = (a.get(i), b.get(j)) {
        if is_alike(of_a, of_b) {
            pairs.push((i, j));
            (i, j) = (i + 1, j + 1);
        } else if at(&most, i + 1, j) >= at(&most, i, j + 1) {
            i += 1;
        } else {
            j += 1;
        }
    }
    pairs
}

fn stand(act: &Act) -> Option<&Stand> {
    match &act.doing {
        Doing::Stand(stand) => Some(stand),
        Doing::Move(_) => None,
    }
}

/// The same thing, whatever its value?
fn is_alike(a: &Act, b: &Act) -> bool {
    match (stand(a), stand(b)) {
        (Some(Stand::Bar(a, _)), Some(Stand::Bar(b, _))) => a == b,
        (Some(Stand::Output { index: a, .. }), Some(Stand::Output { index: b, .. })) => a == b,
        (Some(Stand::UserCommand(a, ..)), Some(Stand::UserCommand(b, ..))) => a == b,
        (Some(Stand::Chuck(a)), Some(Stand::Chuck(b))) => a == b,
        (Some(Stand::Row(a)), Some(Stand::Row(b))) => is_alike_word(row_name(a), row_name(b)),
        (Some(a), Some(b)) => std::mem::discriminant(a) == std::mem::discriminant(b),
        _ => false,
    }
}

/// The word that says which row it is: `N1320` of a parameter, `P` of a group or an offset, `T` of a tool.
fn row_name(words: &[(char, f64)]) -> Option<&(char, f64)> {
    let named = ['N', 'P', 'T'].into_iter().find_map(|name| words.iter().find(|(letter, _)| *letter == name));
    named.or_else(|| words.iter().min_by_key(|(letter, _)| *letter))
}

/// The same word, for all that is known?
fn is_alike_word(a: Option<&(char, f64)>, b: Option<&(char, f64)>) -> bool {
    match (a, b) {
        (Some((letter, a)), Some((other, b))) => {
            letter == other && (a.total_cmp(b).is_eq() || a.is_nan() && b.is_nan())
        }
        _ => a.is_none() && b.is_none(),
    }
}

fn matched(found: &mut Differences, a: &Act, b: &Act) {
    let (Some(of_a), Some(of_b)) = (stand(a), stand(b)) else { return };
    let differs = match (of_a, of_b) {
        (Stand::Dwell(a), Stand::Dwell(b))
        | (Stand::Orient(a), Stand::Orient(b))
        | (Stand::Pocket(a), Stand::Pocket(b))
        | (Stand::Output { value: a, .. }, Stand::Output { value: b, .. }) => rate_differs(*a, *b),
        (Stand::Bar(_, a), Stand::Bar(_, b)) | (Stand::Wrap(a), Stand::Wrap(b)) => {
            a.is_some() != b.is_some() || rate_differs(a.unwrap_or(0.0), b.unwrap_or(0.0))
        }
        (Stand::ToolChange(a), Stand::ToolChange(b)) => known_differ(*a, *b),
        (Stand::UserCommand(_, words_a), Stand::UserCommand(_, words_b)) => {
            words_a.iter().zip(words_b).any(|(a, b)| rate_differs(*a, *b))
        }
        (Stand::Row(a), Stand::Row(b)) => {
            let differ = |((letter, a), (other, b)): (&(char, f64), &(char, f64))| {
                // Exactly: one more or less is another parameter.
                letter != other || !(a.is_nan() || b.is_nan()) && (a - b).abs() > 1e-9
            };
            a.len() != b.len() || in_order(a).iter().zip(&in_order(b)).any(|(a, b)| differ((a, b)))
        }
        _ => of_a != of_b,
    };
    if differs {
        let values = [of_a, of_b].map(|stand| Some(Value::Stand(stand.clone())));
        found.add_once(aspect(of_a), (Some(place(a)), Some(place(b))), values);
    }
}

/// The words of a row, by their letters.
fn in_order(words: &[(char, f64)]) -> Vec<(char, f64)> {
    let mut words = words.to_vec();
    words.sort_by_key(|(letter, _)| *letter);
    words
}

fn one_sided(found: &mut Differences, act: &Act, is_first: bool) {
    let Some(stand) = stand(act) else { return };
    let (value, place) = (Some(Value::Stand(stand.clone())), Some(place(act)));
    let aspect = aspect(stand);
    if is_first {
        found.add_once(aspect, (place, None), [value, None]);
    } else {
        found.add_once(aspect, (None, place), [None, value]);
    }
}

fn place(act: &Act) -> Place {
    Place { file: Shared::clone(&act.file), line: act.line }
}

fn aspect(stand: &Stand) -> Aspect {
    match stand {
        Stand::Dwell(_) => Aspect::Dwell,
        Stand::ToolChange(_) => Aspect::Tool,
        Stand::Stop { .. } | Stand::Pallet | Stand::End => Aspect::Stop,
        Stand::Orient(_) => Aspect::Spindle,
        Stand::Chuck(_)
        | Stand::Bar(..)
        | Stand::Pocket(_)
        | Stand::Wrap(_)
        | Stand::Output { .. }
        | Stand::WaitInput(_)
        | Stand::UserCommand(..)
        | Stand::Row(_) => Aspect::Other,
    }
}
