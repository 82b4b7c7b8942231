//! Threads that comments name, with their pitch.
//!
//! Knows: how shops write threads (`M6X1`, `1/4-20`), and which comments belong to a tool or a block. Must not know: any rule,
//! how a thread is cut.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Abstract, At, Domain};
use gcheck_program::BlockFlags;

use crate::PathCx;
use crate::facts::offset_schemes::whole;
use crate::facts::thread_series::{Series, coarse_pitch, is_made, threads_in};
use crate::facts::tool_comment::{HEAD, comments_in, entries};

/// The rounding error of a number with these digits.
pub(crate) fn rounding(number: f64) -> f64 {
    let text = trimmed(number);
    let digits = text.split_once('.').map_or(0, |(_, behind)| behind.len());
    // A little more, for the numbers of the machine.
    0.501 / 10_f64.powi(i32::try_from(digits).unwrap_or(0))
}

pub(crate) fn trimmed(number: f64) -> String {
    let text = format!("{number:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A thread that a comment names.
pub(crate) struct Thread {
    /// As the comment writes it.
    pub(crate) name: String,
    /// Millimetres.
    pub(crate) pitch: f64,
    /// The block of the comment.
    pub(crate) at: At,
}

/// What a comment must show for its thread to count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// That the tool is a tap; a size alone stands for its coarse pitch.
    Tap,
    /// The pitch itself (`M20X1.5`, `1/4-20`): the comment belongs to an operation that cuts a thread.
    Written,
}

impl Thread {
    /// The diameter of an outside thread at its crest, as its name gives it (`M20X1.5`, `3/8-16`): millimetres.
    pub(crate) fn crest(&self) -> Option<f64> {
        let name = self.name.to_ascii_uppercase();
        let size = name.split(['X', '*', ' ']).next()?;
        let (whole, size) = whole_and_part(size);
        if let Some(size) = size.strip_prefix('M') {
            return size.parse().ok().filter(|size: &f64| *size > 0.0);
        }
        let (above, below) = size.split_once('/')?;
        let inches = whole + above.parse::<f64>().ok()? / below.parse::<f64>().ok()?;
        Some(inches * 25.4).filter(|size| *size > 0.0 && size.is_finite())
    }
}

/// `1-1/4-7` is one and a quarter, `3/8-16` a part of one: the whole inches, and the rest of the size.
fn whole_and_part(size: &str) -> (f64, &str) {
    let mut parts = size.split('-');
    let (first, second) = (parts.next().unwrap_or_default(), parts.next().unwrap_or_default());
    match first.parse::<f64>() {
        Ok(whole) if second.contains('/') => (whole, second),
        _ => (0.0, first),
    }
}

/// The thread that the comment at a tool change names: in its block, in the one before it or in the one after it.
pub(crate) fn thread_of_tool(cx: &PathCx<'_>, changed: At, wanted: Wanted) -> Option<Thread> {
    let before = changed.block.checked_sub(1).map(|block| At { block, ..changed });
    let own = thread_in_block(cx, changed, wanted);
    // Only a comment alone in its block belongs to the tool beside it.
    let is_alone = |at: &At| {
        at.file == 0 && cx.place_of(*at).is_some_and(|place| place.table.words(place.block()).is_empty())
    };
    let mut beside = [before, Some(changed.next())].into_iter().flatten().filter(is_alone);
    own.or_else(|| beside.find_map(|at| thread_in_block(cx, at, wanted)))
}

/// The thread that the comment of a block of the main file names.
pub(crate) fn thread_in_block(cx: &PathCx<'_>, at: At, wanted: Wanted) -> Option<Thread> {
    let place = cx.place_of(at).filter(|_| at.file == 0)?;
    let block = place.block();
    if !block.flags.contains(BlockFlags::COMMENT) {
        return None;
    }
    let file = cx.program.file(0)?;
    let text = file.loaded.chunk_text(place.chunk);
    let text = text.get(block.range.start as usize..block.range.end as usize)?;
    let comment = text.get(text.find(['(', ';'])?..)?;
    let (name, pitch) = thread_in(comment, wanted)?;
    Some(Thread { name, pitch, at })
}

/// The thread that the entry of the tool in a list at the head of the program names.
pub(crate) fn thread_in_list(cx: &PathCx<'_>, wanted: Wanted) -> Option<Thread> {
    let tool = Abstract::known(cx.state().tool()).and_then(whole)?;
    let file = cx.program.file(0)?;
    let mut found: Option<Thread> = None;
    for block in 0..HEAD {
        let at = At { file: 0, block };
        let Some(place) = cx.place_of(at) else { break };
        let block = place.block();
        if !block.flags.contains(BlockFlags::COMMENT) || !place.table.words(block).is_empty() {
            continue;
        }
        let text = file.loaded.chunk_text(place.chunk);
        let text = text.get(block.range.start as usize..block.range.end as usize).unwrap_or_default();
        for entry in entries(text).filter(|(number, _)| *number == tool) {
            let Some((name, pitch)) = thread_in(entry.1, wanted) else { continue };
            // Two entries of one tool: a list for another machine, or of two set-ups.
            if found.as_ref().is_some_and(|thread| thread.pitch.to_bits() != pitch.to_bits()) {
                return None;
            }
            found = Some(Thread { name, pitch, at });
        }
    }
    found
}

/// Do the comments of a block name threads of which none can be read: `G3/4`, `NPT`, `TR30X6`, or several?
pub(crate) fn names_unread_thread(cx: &PathCx<'_>, at: At) -> bool {
    comments_in(cx, at)
        .is_some_and(|text| is_thread_of_another_form(&text) && thread_in(&text, Wanted::Written).is_none())
}

/// Comments above an operation are not further away than this: blocks.
const ABOVE: u32 = 6;
/// So many blocks after a tool change, at most, the list at the head of the program tells which thread is cut.
const LIST_COUNTS: usize = 40;
/// The title of a program is in its first blocks.
const TITLE: u32 = 3;

/// The thread that a comment names, and whether only the title does: the nearest comment counts.
pub(crate) fn named_thread(cx: &PathCx<'_>, changed: Option<At>) -> Option<(Thread, bool)> {
    let here = cx.origin().at;
    let begin = changed.filter(|at| at.file == here.file).map_or(0, |at| at.block);
    let is_alone =
        |at: &At| cx.place_of(*at).is_some_and(|place| place.table.words(place.block()).is_empty());
    let above = (begin..here.block).rev().take(ABOVE as usize).map(|block| At { block, ..here });
    // The nearest comment that names a thread counts, whether it can be read or not.
    let named = |at: At| {
        let thread = thread_in_block(cx, at, Wanted::Written);
        (thread.is_some() || names_unread_thread(cx, at)).then_some(thread)
    };
    let of_operation = above.filter(is_alone).find_map(named);
    let is_beside_tool = |at: &At| Some(*at) == changed || is_alone(at);
    let of_tool = || {
        let changed = changed.filter(|at| at.file == 0)?;
        let before = changed.block.checked_sub(1).map(|block| At { block, ..changed });
        if let Some(thread) = thread_of_tool(cx, changed, Wanted::Written) {
            return Some(Some(thread));
        }
        [Some(changed), before, Some(changed.next())]
            .into_iter()
            .flatten()
            .filter(is_beside_tool)
            .find_map(named)
            .or_else(|| {
                // A comment further up may name another thread of the same tool.
                let since = changed.block..here.block;
                let is_near = changed.file == here.file && since.len() <= LIST_COUNTS;
                let mut comments = since.map(|block| At { block, ..here });
                let names_another = is_near && comments.any(|at| named(at).is_some());
                (is_near && !names_another).then(|| thread_in_list(cx, Wanted::Written)).flatten().map(Some)
            })
    };
    let is_title = |at: &At| {
        let letters = cx.place_of(*at).map(|place| place.block().letters);
        letters.is_some_and(|letters| letters.contains(Letter::of('O')))
    };
    let title = || {
        let blocks = (0..TITLE).map(|block| At { block, ..here });
        let mut named = blocks.filter(|at| is_title(at) || is_alone(at)).filter_map(named);
        // A title with two threads does not tell which one is cut.
        named.next().filter(|_| named.next().is_none())
    };
    // The size of a tap alone stands for its coarse pitch.
    let of_tap = || {
        let changed = changed.filter(|_| cx.has_effect(|effect| effect == Effect::RigidTap))?;
        Some(Some(thread_of_tool(cx, changed, Wanted::Tap)?))
    };
    match named(here).or(of_operation).or_else(of_tap).or_else(of_tool) {
        Some(thread) => thread.map(|thread| (thread, false)),
        None => title()?.map(|thread| (thread, true)),
    }
}

/// Is there a word that looks like a thread?
fn is_thread_of_another_form(comment: &str) -> bool {
    let upper = comment.to_ascii_uppercase();
    let is_size = |piece: &str| {
        piece.strip_prefix('M').is_some_and(|size| size.starts_with(|c: char| c.is_ascii_digit()))
    };
    let is_fraction = |piece: &str| piece.contains('/') && piece.bytes().any(|byte| byte.is_ascii_digit());
    pieces(&upper).any(|piece| is_size(piece) || is_fraction(piece) || is_unread(piece))
}

/// Does the word name a thread in a form that is not read: `G3/4`, `TR30X6`, `NPT`, `1/2-14`?
fn is_unread(piece: &str) -> bool {
    const NAMES: [&str; 11] =
        ["NPT", "NPTF", "NPS", "BSP", "BSPT", "BSPP", "TR", "ACME", "RD", "PG", "BUTTRESS"];
    const LETTERS: [&str; 8] = ["G", "R", "RC", "RP", "TR", "W", "RD", "PG"];
    let letters = piece.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(piece.len());
    let (name, rest) = piece.split_at_checked(letters).unwrap_or((piece, ""));
    let is_number = rest.starts_with(|c: char| c.is_ascii_digit());
    let of_inches = is_number && name.is_empty() && rest.contains('/') && rest.contains('-');
    // Pipe threads are of six inches at most: `G76` is a code.
    let is_size =
        is_number && (!matches!(name, "G" | "R" | "W") || number(rest).is_none_or(|size| size <= 6.0));
    NAMES.contains(&name) || LETTERS.contains(&name) && is_size || of_inches && inch(piece).is_none()
}

/// The words of a comment that may be threads.
fn pieces(upper: &str) -> impl Iterator<Item = &str> {
    let parts =
        upper.split(|c: char| !(c.is_ascii_alphanumeric() || matches!(c, '.' | '/' | '-' | '#' | '*')));
    parts.filter(|piece| !piece.is_empty())
}

/// `M30 X 1.5` as one word.
fn joined(upper: &str) -> String {
    let words: Vec<&str> = upper.split(' ').collect();
    let is_size = |word: &str| word.strip_prefix('M').is_some_and(|size| number(size).is_some());
    let mut text = String::with_capacity(upper.len());
    for (ix, word) in words.iter().enumerate() {
        let beside = |ix: usize| words.get(ix).copied().unwrap_or_default();
        let is_before = *word == "X" && ix > 0 && is_size(beside(ix - 1));
        let is_after = ix > 1 && beside(ix - 1) == "X" && is_size(beside(ix - 2));
        let is_pitch = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
        if !(is_before && is_pitch(beside(ix + 1)) || is_after && is_pitch(word)) && ix > 0 {
            text.push(' ');
        }
        text.push_str(word);
    }
    text
}

/// A drill for a tap, and a thread that is milled, are not taps. Several starts have a lead of several pitches.
const OTHERS: [&str; 20] = [
    "DRILL",
    "MILL",
    "PREDRILL",
    "CHAMFER",
    "SPOT",
    "START",
    "STARTS",
    "LEAD",
    "LEADS",
    "TWIN",
    "DOUBLE",
    "TRIPLE",
    "QUAD",
    "QUADRUPLE",
    "MULTI",
    "MULTISTART",
    "MULTIPLE",
    "TWOSTART",
    "DUAL",
    "2START",
];

/// Words beside which two numbers are a thread.
const THREADS: [&str; 10] =
    ["THREAD", "THREADS", "THREADING", "THD", "TAP", "TAPS", "TAPPING", "UNC", "UNF", "UNEF"];

/// The one thread that a comment names, and its pitch in millimetres.
fn thread_in(comment: &str, wanted: Wanted) -> Option<(String, f64)> {
    let upper = joined(&comment.to_ascii_uppercase());
    let is_letter = |c: char| c.is_ascii_alphanumeric();
    let has = |names: &[&str]| upper.split(|c: char| !is_letter(c)).any(|word| names.contains(&word));
    // A holder or an insert may be named after the thread that it was bought for.
    let is_holder = wanted == Wanted::Written && has(&["HOLDER", "INSERT"]);
    if has(&OTHERS) || is_holder || wanted == Wanted::Tap && !has(&["TAP", "TAPS", "TAPPING"]) {
        return None;
    }
    let is_thread = has(&THREADS);
    let mut found: Vec<(String, f64)> = Vec::new();
    // Beside a thread that is not read, nothing tells which one is cut.
    if wanted == Wanted::Written && pieces(&upper).any(is_unread) {
        return None;
    }
    let all: Vec<&str> = pieces(&upper).collect();
    // A size alone stands for its coarse pitch, unless the comment gives the pitch in a word of its own: `M10 TAP P1.25`.
    let has_own_pitch = all.iter().any(|piece| may_be_pitch(piece));
    for (ix, piece) in all.iter().copied().enumerate() {
        // A size alone names a hole or a bolt as well, and two numbers name holes, drawings and dates: `10-24` is a thread only
        // right beside the word.
        let is_marked = piece.contains(['#', '/', 'M']) || piece.contains("UN") || piece.contains("NP");
        let is_word =
            |ix: Option<usize>| ix.and_then(|ix| all.get(ix)).is_some_and(|word| THREADS.contains(word));
        let is_beside = is_word(ix.checked_sub(1)) || is_word(ix.checked_add(1));
        let is_pitch = piece.contains(['X', '-', '*']) && (is_marked || is_thread);
        let is_written = (is_marked || is_beside) && (wanted == Wanted::Tap || is_pitch);
        let is_alone = !piece.contains(['X', '-', '*']);
        if is_alone && has_own_pitch {
            continue;
        }
        let of_turns = || turns_to_the_inch(&all, ix);
        // `M30` alone ends a program.
        let is_code = matches!(piece, "M1" | "M7" | "M9" | "M11" | "M30") && !is_beside;
        let thread = || metric(piece).or_else(|| inch(piece));
        if let Some(pitch) = thread().filter(|_| is_written && !is_code) {
            found.push((piece.to_owned(), pitch));
        } else if let Some(turns) = of_turns() {
            found.push((format!("{turns} TPI"), 25.4 / turns));
        } else if let Some(thread) = of_series(&all, ix) {
            found.push(thread);
        }
    }
    match found.as_slice() {
        [one] => Some(one.clone()),
        // `M6 (M6X1.0)` names one thread twice; anything else is not clear.
        [first, others @ ..] if others.iter().all(|other| other.1.to_bits() == first.1.to_bits()) => {
            Some(first.clone())
        }
        _ => None,
    }
}

/// `12 TPI`, `12TPI`. What an insert can cut (`8 - 16 TPI`, `24 TPI MAX`) is not a thread.
fn turns_to_the_inch(pieces: &[&str], ix: usize) -> Option<f64> {
    let at = |ix: Option<usize>| ix.and_then(|ix| pieces.get(ix)).copied().unwrap_or_default();
    let piece = at(Some(ix));
    let (turns, next) = match piece.strip_suffix("TPI") {
        Some(turns) => (turns, ix + 1),
        None => (Some(piece).filter(|_| at(Some(ix + 1)) == "TPI")?, ix + 2),
    };
    let before = at(ix.checked_sub(1));
    let is_range = |word: &str| matches!(word, "-" | "TO" | "THRU" | "MAX" | "MIN") || number(word).is_some();
    if is_range(before) || is_range(at(Some(next))) {
        return None;
    }
    number(turns).filter(|turns| (1.0..=120.0).contains(turns))
}

/// A word that may give the pitch of a thread whose size is another word: `P1.25`, `X1`, `1MM`, `FINE`, any number from the finest pitch to the
/// coarsest.
fn may_be_pitch(piece: &str) -> bool {
    const PITCHES: std::ops::RangeInclusive<f64> = 0.2..=6.0;
    let number = piece.trim_start_matches(|c: char| c.is_ascii_alphabetic() || matches!(c, '-' | '/' | '*'));
    let name = piece.strip_suffix(number).unwrap_or_default();
    let number = number.strip_suffix("MM").or_else(|| number.strip_suffix('P')).unwrap_or(number);
    let is_named = matches!(name, "" | "P" | "X" | "PITCH" | "-" | "/" | "*");
    matches!(piece, "X" | "FINE" | "MF" | "PITCH" | "EXTRAFINE")
        || is_named && self::number(number).is_some_and(|pitch| PITCHES.contains(&pitch))
}

/// `M6X1`, `M10-1.25`, `M8` with its coarse pitch.
fn metric(piece: &str) -> Option<f64> {
    let size = piece.strip_prefix('M')?;
    match size.split_once(['X', '-', '*']) {
        Some((size, pitch)) => {
            // `M20X1.5-6H` names its tolerance too.
            let pitch = pitch.split_once('-').map_or(pitch, |(pitch, _)| pitch);
            let (size, pitch) = (number(size)?, number(pitch)?);
            ((0.2..=6.0).contains(&pitch) && pitch < size).then_some(pitch)
        }
        None => coarse_pitch(number(size)?),
    }
}

/// `1/4-20`, `#10-32`, `10-24`: threads per inch after the dash, and only if such a thread exists.
fn inch(piece: &str) -> Option<f64> {
    piece.match_indices('-').find_map(|(at, _)| {
        let threads = threads_after(piece.get(at + 1..)?)?;
        is_made(piece.get(..at)?, threads).then(|| 25.4 / f64::from(threads))
    })
}

/// `13`, `13UNC`, `13UNC-2A`, `13-2A`; a date has more digits.
fn threads_after(text: &str) -> Option<u32> {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let (threads, series) = text.split_at_checked(digits)?;
    let is_class = |class: &str| class.len() == 3 && class.ends_with(['A', 'B']);
    let is_series = series.is_empty() || series.starts_with(|c: char| c.is_ascii_alphabetic());
    threads.parse().ok().filter(|_| is_series || is_class(series))
}

/// `1/4 UNC`, `#10 UNF`, `UNC 1/4`, `1/4UNC`: a size with its series stands for the threads per inch.
fn of_series(pieces: &[&str], ix: usize) -> Option<(String, f64)> {
    let at = |ix: Option<usize>| ix.and_then(|ix| pieces.get(ix)).copied().unwrap_or_default();
    let piece = at(Some(ix));
    let letters = piece.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(piece.len());
    let (size, own) = piece.split_at_checked(letters)?;
    let (before, after) = (at(ix.checked_sub(1)), at(ix.checked_add(1)));
    // `3/4 10 UNC`: the number is that of the threads.
    let is_count = |word: &str| word.starts_with(|c: char| c.is_ascii_digit()) || word == "-";
    let series = match own {
        "" => Series::named(after).or_else(|| Series::named(before)),
        own => Series::named(own),
    };
    let series = series.filter(|_| !(is_count(before) || own.is_empty() && is_count(after)))?;
    // `TOOL 10 UNC`: the number is that of the tool.
    if ["TOOL", "T", "STATION", "POS", "POCKET", "STA", "TURRET"].contains(&before) {
        return None;
    }
    let threads = threads_in(size, series)?;
    let name = if series == Series::Coarse { "UNC" } else { "UNF" };
    Some((format!("{size} {name}"), 25.4 / f64::from(threads)))
}

fn number(text: &str) -> Option<f64> {
    let is_number = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    text.parse().ok().filter(|_| is_number)
}

#[cfg(test)]
mod tests {
    use super::{Wanted, is_thread_of_another_form, thread_in};

    #[test]
    fn threads_that_are_not_read() {
        for comment in ["EXT THREAD G3/4", "1/2-14 NPT", "TR30X6", "M20X1.5 AND M30X2", "THREAD 3/4"] {
            assert!(is_thread_of_another_form(comment), "{comment}");
        }
        for comment in ["THREAD TOOL", "OD THREADING 60 DEG", "16ER AG60", "T4 THREAD"] {
            assert!(!is_thread_of_another_form(comment), "{comment}");
        }
    }

    #[test]
    fn threads_as_shops_write_them() {
        for (comment, expected) in [
            ("(M6X1 TAP)", Some(1.0)),
            ("(TAP M8)", Some(1.25)),
            ("(T5 - M10-1.25 SPIRAL TAP)", Some(1.25)),
            ("(1/4-20 TAP)", Some(25.4 / 20.0)),
            ("(#10-32UNF TAP)", Some(25.4 / 32.0)),
            ("(TAPER PIN M6)", None),
            ("(DRILL 5.0 FOR M6 TAP)", None),
            ("(TAP 1-1/4 DEEP)", None),
            ("(TAP M6 OR M8)", None),
            ("(M6 THREAD MILL TAP)", None),
            ("(10-24 TAP)", Some(25.4 / 24.0)),
            ("(TAP M6 CHANGED 10-24)", Some(1.0)),
            ("(TAP CHANGED 10-24)", None),
            ("(T5 - M8 TAP)", Some(1.25)),
            ("(M10 SPIRAL POINT TAP P1.25)", None),
            ("(M10 TAP 1.25MM)", None),
            ("(M10 TAP 1.25P)", None),
            ("(TAP M10 X 1)", Some(1.0)),
            ("(M6 FINE TAP)", None),
            ("(TAP M8 1MM)", None),
            ("(TAP M8 - 1)", None),
            ("(M8 X1 TAP)", None),
            ("(TAP M8 P 1)", None),
            ("(TAP M8 P=1)", None),
            ("(TAP M8 PITCH1)", None),
            ("(TAP M8 /1)", None),
            ("(TAP M10 1,25)", None),
            ("(M10 TAP 6H)", Some(1.5)),
            ("(M30 TAP)", Some(3.5)),
            ("(M7 TAP)", Some(1.0)),
            ("(M8 TAP, THEN M30)", Some(1.25)),
            ("(1-8 UNC TAP)", Some(25.4 / 8.0)),
            ("(TAP 1/4 UNC)", Some(25.4 / 20.0)),
            ("(#10 UNF TAP)", Some(25.4 / 32.0)),
            ("(10 UNC-2B TAP)", Some(25.4 / 24.0)),
            ("(TAP UNF 5/16)", Some(25.4 / 24.0)),
            ("(3/8UNC TAP)", Some(25.4 / 16.0)),
            ("(1-1/8-7 UNC TAP)", Some(25.4 / 7.0)),
            ("(3/4 10 UNC TAP)", None),
            ("(1 UNC TAP)", None),
            ("(1/4 - 20 UNC TAP)", None),
            ("(13/64 DRILL, UNC)", None),
        ] {
            assert_eq!(thread_in(comment, Wanted::Tap).map(|(_, pitch)| pitch), expected, "{comment}");
        }
    }

    #[test]
    fn a_pitch_that_is_written_needs_no_tap() {
        for (comment, expected) in [
            ("(M20X1.5)", Some(1.5)),
            ("(M20X1.5 - G76)", Some(1.5)),
            ("(M20X1.5 - G1)", None),
            ("(1/2-13 THREAD)", Some(25.4 / 13.0)),
            ("(M24X2 THREAD)", Some(2.0)),
            ("(M20X1.5-6H)", Some(1.5)),
            ("(1/2-13UNC-2A)", Some(25.4 / 13.0)),
            ("(1/4-20-2B)", Some(25.4 / 20.0)),
            ("(REV 10-24-2020)", None),
            ("(M20 NUT)", None),
            ("(M20X2 DRILL)", None),
            ("(1/4 UNC)", Some(25.4 / 20.0)),
            ("(UNC THREADS 1/4 DEEP)", None),
            ("(1/4-28 UNF)", Some(25.4 / 28.0)),
            ("(M30X3 2 START)", None),
            ("(M20X1.5 OR M20X2)", None),
            ("(ADAPTER M20X1.5 - G3/4)", None),
            ("(1/2-14 NPT AND 3/4-16 UNF)", None),
            ("(THREAD TOOL CHANGED 10-24)", None),
            ("(THREAD 10-24)", Some(25.4 / 24.0)),
            ("(10-24 UNC)", Some(25.4 / 24.0)),
            ("(THREAD M30 X 1.5)", Some(1.5)),
            ("(T2 THREAD M26 X 1.5, T3 GROOVE)", Some(1.5)),
            ("(THREAD 12 TPI)", Some(25.4 / 12.0)),
            ("(1/2-13 THREAD 13TPI)", Some(25.4 / 13.0)),
            ("(M30X2 TWIN)", None),
            ("(M30X2 2-START)", None),
            ("(M30X2 DOUBLE LEAD)", None),
            ("(INSERT 3/8-16 THREAD HOLDER)", None),
        ] {
            assert_eq!(thread_in(comment, Wanted::Written).map(|(_, pitch)| pitch), expected, "{comment}");
        }
    }
}
