//! Codes that a comparison leaves out, and which of them one of two runs has and the other one has not.
//!
//! Knows: which codes leave nothing in the acts of a run, how often a run executes them. Must not know: how differences are worded.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::Arc;

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_engine::Origin;
use gcheck_program::{BlockFlags, Word};
use gcheck_toolpath::Place;

use crate::execution::Session;

/// Is nothing compared of what a code with this effect does? Offsets that a program writes depend on the kind of offset (`L`):
/// zeros and tool lengths are compared where a move uses them.
fn is_left_out(effect: Effect, kind: Option<f64>) -> bool {
    match effect {
        Effect::None
        | Effect::KeepTouch
        | Effect::AlarmIfTouched
        | Effect::AlarmIfNotTouched
        | Effect::TurnCarousel
        | Effect::OverridesOn
        | Effect::OverridesOff
        | Effect::FeedOverride
        | Effect::SpeedOverride
        | Effect::AdaptiveFeed
        | Effect::FeedStopInput
        | Effect::AskOperator => true,
        Effect::WriteOffsets => !COMPARED_OFFSETS.iter().any(|compared| Some(*compared) == kind),
        _ => false,
    }
}

/// `L` of the offsets that are compared: work zeros, and lengths of tools with their wear.
const COMPARED_OFFSETS: [f64; 4] = [2.0, 20.0, 10.0, 11.0];

/// How often a run executes each of its blocks with codes.
#[derive(Debug, Default)]
pub(super) struct Executions(Vec<Vec<u32>>);

impl Executions {
    /// A block is executed.
    pub(super) fn count(&mut self, origin: Origin) {
        if !origin.flags.contains(BlockFlags::CODE) {
            return;
        }
        let (file, block) = (origin.at.file as usize, origin.at.block as usize);
        if self.0.len() <= file {
            self.0.resize_with(file + 1, Vec::new);
        }
        let Some(blocks) = self.0.get_mut(file) else { return };
        if blocks.len() <= block {
            blocks.resize(block + 1, 0);
        }
        if let Some(count) = blocks.get_mut(block) {
            *count = count.saturating_add(1);
        }
    }

    /// What these blocks say that is not compared.
    pub(super) fn left_out(&self, session: &Session<'_>) -> LeftOut {
        let mut found = LeftOut::default();
        for (file_index, blocks) in (0..).zip(&self.0) {
            let Some(file) = session.program.file(file_index) else { continue };
            let name = if file.name.is_empty() { session.prepared.shown.as_str() } else { &file.name };
            let name: Arc<str> = Arc::from(name);
            for (block, count) in (0..).zip(blocks).filter(|(_, count)| **count > 0) {
                let Some(block) = file.loaded.place(block, session.program.dialect()) else { continue };
                let place =
                    || Place { file: Arc::clone(&name), line: file.loaded.line_number(block.range().start) };
                let words = block.table.words(block.block());
                for (name, words) in commands(words, session) {
                    found.add(name, words, u64::from(*count), place);
                }
            }
        }
        found
    }
}

/// The commands of a block that are not compared: the name of each, and its other words.
fn commands(words: &[Word], session: &Session<'_>) -> Vec<(String, String)> {
    let control = session.model.control();
    let codes = || words.iter().filter(|word| CODES.contains(word.letter));
    let effect = |word: &Word| control.code_at(word.code).map(gcheck_controls::Code::effect);
    // What is beside the call of a macro may be an argument.
    if codes().any(|word| matches!(effect(word), Some(Effect::MacroCall | Effect::MacroModal))) {
        return Vec::new();
    }
    let number = |letter: Letter| words.iter().find(|word| word.letter == letter).and_then(Word::number);
    let mut found = Vec::new();
    for word in codes().filter(|word| !word.is_computed()) {
        let code = control.code_at(word.code);
        if code.is_some_and(|code| code.alias().is_some()) {
            continue;
        }
        let kind = number(Letter::of('L'));
        let effect = code.map_or(Effect::None, gcheck_controls::Code::effect);
        if !is_left_out(effect, kind) {
            continue;
        }
        let mut name = match (code, word.number()) {
            (Some(code), _) => code.number().to_string(),
            (None, Some(number)) => format!("{}{number}", word.letter),
            (None, None) => continue,
        };
        let mut reads = code.map_or(COMMON, gcheck_controls::Code::reads);
        if let Some(kind) = kind.filter(|_| effect == Effect::WriteOffsets) {
            // Writing to a string cannot fail.
            let _ = write!(name, " L{kind}");
            reads = reads.without(LetterSet::of("L"));
        }
        let mut own: Vec<&Word> =
            words.iter().filter(|word| !CODES.contains(word.letter) && reads.contains(word.letter)).collect();
        own.sort_by_key(|word| word.letter.index());
        let mut said = String::new();
        for word in own {
            let _ = match word.number() {
                Some(number) => write!(said, "{}{number} ", word.letter),
                None => write!(said, "{} ", word.letter),
            };
        }
        found.push((name, said));
    }
    found
}

/// Addresses of codes.
const CODES: LetterSet = LetterSet::of("GM");
/// Words that a code may have of which nothing is known.
const COMMON: LetterSet = LetterSet::of("PQRLE");

/// The commands of a run that are not compared.
#[derive(Debug, Default)]
pub(super) struct LeftOut(BTreeMap<Command, Executed>);

/// A command: its name, and its words with their values.
type Command = (String, String);

#[derive(Debug)]
struct Executed {
    count: u64,
    place: Place,
}

impl LeftOut {
    /// A command was executed so many times. `name` is what people call it (`M51`, `G10 L12`), `words` is what else it says.
    fn add(&mut self, name: String, words: String, count: u64, place: impl FnOnce() -> Place) {
        self.0.entry((name, words)).or_insert_with(|| Executed { count: 0, place: place() }).count += count;
    }
}

/// A command that is not compared, and that the two runs do not have alike.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::commands) struct NotCompared {
    /// What people call it: `M51`, `G10 L12`.
    pub(in crate::commands) name: String,
    /// By run: how often it has the command more than the other one, and the first place of it.
    pub(in crate::commands) sides: [Option<(u64, Place)>; 2],
}

/// What each of two runs has more of than the other one, by number of the code.
pub(super) fn not_compared(runs: &[LeftOut; 2]) -> Vec<NotCompared> {
    let [a, b] = runs;
    let mut found: BTreeMap<&str, NotCompared> = BTreeMap::new();
    for (side, of, other) in [(0, a, b), (1, b, a)] {
        for (command, executed) in &of.0 {
            let of_other = other.0.get(command).map_or(0, |executed| executed.count);
            let more = executed.count.saturating_sub(of_other);
            if more == 0 {
                continue;
            }
            let name = command.0.as_str();
            let entry = found
                .entry(name)
                .or_insert_with(|| NotCompared { name: name.to_owned(), sides: [None, None] });
            let Some(slot) = entry.sides.get_mut(side) else { continue };
            match slot {
                Some((count, place)) => {
                    *count += more;
                    if executed.place.line < place.line {
                        *place = executed.place.clone();
                    }
                }
                None => *slot = Some((more, executed.place.clone())),
            }
        }
    }
    let mut found: Vec<NotCompared> = found.into_values().collect();
    found.sort_by(|a, b| by_number(&a.name).total_cmp(&by_number(&b.name)).then_with(|| a.name.cmp(&b.name)));
    found
}

/// The number of a code, so that `M10` comes before `M131`; all G codes come before all M codes.
fn by_number(name: &str) -> f64 {
    const MORE_THAN_ANY: f64 = 1e9;
    let (letter, rest) = name.split_at_checked(1).unwrap_or((name, ""));
    let number: f64 = rest.split(' ').next().and_then(|digits| digits.parse().ok()).unwrap_or_default();
    if letter == "M" { MORE_THAN_ANY + number } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(commands: &[(&str, &str, u32)]) -> LeftOut {
        let mut run = LeftOut::default();
        for (name, words, line) in commands {
            run.add((*name).to_owned(), (*words).to_owned(), 1, || Place {
                file: "a.nc".into(),
                line: *line,
            });
        }
        run
    }

    fn found(a: &[(&str, &str, u32)], b: &[(&str, &str, u32)]) -> Vec<String> {
        let side = |side: &Option<(u64, Place)>| {
            side.as_ref().map_or_else(|| "-".to_owned(), |(count, place)| format!("{count}@{}", place.line))
        };
        let all = not_compared(&[run(a), run(b)]);
        all.iter().map(|of| format!("{} {} {}", of.name, side(&of.sides[0]), side(&of.sides[1]))).collect()
    }

    #[test]
    fn what_both_runs_have_alike_is_not_named() {
        assert!(found(&[("M51", "", 3), ("M10", "", 5)], &[("M10", "", 9), ("M51", "", 2)]).is_empty());
    }

    #[test]
    fn what_one_run_has_more_of_is_named_with_its_first_place_by_number() {
        assert_eq!(
            found(
                &[("M131", "", 7), ("M51", "", 3), ("G10 L12", "P1 R4", 2)],
                &[("M51", "", 3), ("M51", "", 4)]
            ),
            ["G10 L12 1@2 -", "M51 - 1@3", "M131 1@7 -"]
        );
    }

    #[test]
    fn the_same_command_with_other_words_is_another_command() {
        assert_eq!(found(&[("G10 L12", "P1 R4", 2)], &[("G10 L12", "P1 R5", 2)]), ["G10 L12 1@2 1@2"]);
    }
}
