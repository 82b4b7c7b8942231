//! Words that stay in effect: the data's rows against what the engine does.
//!
//! Knows: the ways in which a word may come before a block, what the data say of each. Must not know: any rule.

use gcheck_controls::{CodeNumber, Control, LastingEnd, LastingFrom, LastingWords, Letter, Need, WordEntry};
use gcheck_engine::{
    Concrete, Event, Fault, Machine, Model, NoLibrary, Observer, Options, Origin, Program, State, run,
};
use gcheck_program::{Dialect, Loaded};

use crate::block::{Subject, Word};

/// Blocks that a run executes at most.
const FUEL: u64 = 20_000;

/// A block without one of its words, and what comes before it.
pub(crate) struct Lasting {
    /// The control, the code, the word and the way.
    name: String,
    before: Vec<String>,
    block: String,
    /// Do the data say that the word still counts?
    counts: bool,
}

/// The cases of every word of the block that stays in effect.
pub(crate) fn of(control: &Control, subject: &Subject<'_>) -> Vec<Lasting> {
    let mut cases = Vec::new();
    for word in &subject.words {
        if let Some(row) = row(control, subject, word.letter) {
            cases.extend(of_word(control, subject, word, row));
        }
    }
    cases
}

/// How the word stays in effect for the code of the block that reads it.
fn row<'c>(control: &'c Control, subject: &Subject<'_>, letter: Letter) -> Option<&'c LastingWords> {
    let sets_mode = subject.codes.iter().any(|code| code.entry().group == "feed-mode");
    // A feed counts in the mode that it was given under.
    let reads = |code: &&gcheck_controls::Code<'_>| code.reads().contains(letter);
    let reader = subject.codes.iter().find(reads).filter(|_| !sets_mode || letter != Letter::of('F'))?;
    let words = &reader.entry().words;
    let is_modal = words.iter().any(|word| Letter::parse(&word.letter) == Some(letter) && lasts(word));
    control.lasting_in(letter, &reader.entry().group).filter(|_| is_modal)
}

fn of_word(control: &Control, subject: &Subject<'_>, word: &Word, row: &LastingWords) -> Vec<Lasting> {
    let has = |code: &str| CodeNumber::parse(code).is_some_and(|number| control.code(number).is_some());
    let block = subject.replaced(word, "");
    let alone = subject.block[word.range.clone()].trim().to_owned();
    let own = subject.block.clone();
    let any_block = row.from == LastingFrom::AnyBlock;
    let cancelled = !row.until.contains(&LastingEnd::Cancel);
    // A change that gives the word itself tells nothing.
    let change = match (has("M6"), word.letter.ascii()) {
        (false, _) | (true, b'T') => Vec::new(),
        (true, b'S') => vec!["T2 M6".to_owned(), "M3".to_owned()],
        (true, _) => vec!["T2 M6".to_owned(), "S1000 M3".to_owned()],
    };
    let mut ways =
        vec![("alone", vec![alone.clone()], any_block), ("after its own block", vec![own.clone()], true)];
    if has("G90") {
        ways.push(("beside another code", vec![format!("{alone} G90")], any_block));
    }
    if has("G80") {
        ways.push(("after a cancel", vec![own.clone(), "G80".to_owned()], cancelled));
    }
    if !change.is_empty() {
        let mut over_change = vec![if any_block { alone } else { own }];
        over_change.extend(change);
        ways.push(("after a tool change", over_change, true));
    }
    let code = subject.codes.first().map_or_else(String::new, |code| code.entry().code.clone());
    let case = |(way, before, counts): (&str, Vec<String>, bool)| Lasting {
        name: format!("{} {code} {} {way}", control.name(), word.letter),
        before,
        block: block.clone(),
        counts,
    };
    ways.into_iter().map(case).collect()
}

impl Lasting {
    /// What differs between the data and the engine. A block that does the same without the word, whatever came before, tells
    /// nothing: `None`.
    ///
    /// A word counts where the block without it does what the block with it does after the same blocks.
    pub(crate) fn judge(&self, control: &Control, subject: &Subject<'_>) -> Option<Result<(), String>> {
        let bare = doings(control, &subject.with(&[], &self.block));
        if bare == doings(control, &subject.program()) {
            return None;
        }
        let with = doings(control, &subject.with(&self.before, &subject.block));
        let without = doings(control, &subject.with(&self.before, &self.block));
        if (with == without) == self.counts {
            return Some(Ok(()));
        }
        let says = if self.counts { "the word counts" } else { "the word does not count" };
        Some(Err(format!(
            "{}: data: {says}; `{} / {}`\n  with    {with:?}\n  without {without:?}",
            self.name,
            self.before.join(" / "),
            self.block
        )))
    }
}

/// What the block before the end of the program does: its moves, and its faults.
fn doings(control: &Control, text: &str) -> Vec<String> {
    let dialect = Dialect::new(control);
    let model = Model::new(control);
    let loaded = Loaded::new(text, &dialect, |_, _, _| {});
    let start = text.trim_end_matches("%\n").trim_end().rfind('\n').unwrap();
    let start = text[..start].rfind('\n').unwrap() as u32 + 1;
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let options = Options { past_alarms: true, ..Options::NONE };
    let mut moves = Moves { start, list: Vec::new() };
    run(&program, &model, &Machine::default(), options, FUEL, &mut moves);
    moves.list
}

struct Moves {
    start: u32,
    list: Vec<String>,
}

impl Observer<Concrete> for Moves {
    fn event(&mut self, origin: Origin, state: &State<Concrete>, event: &Event) {
        let moves = matches!(
            event,
            Event::Travel(_)
                | Event::Arc(_)
                | Event::Curve(_)
                | Event::Dwell(_)
                | Event::RigidTap { .. }
                | Event::ToolChange(_)
                | Event::LengthOffset(_)
        );
        if moves && origin.start == self.start {
            let speeds = (state.feed(), state.speed());
            self.list.push(format!("{event:?} {speeds:?}"));
        }
    }

    fn fault(&mut self, origin: Origin, _: &State<Concrete>, fault: &Fault) {
        if origin.start == self.start {
            self.list.push(format!("{fault:?}"));
        }
    }
}

/// A word with a value of its own is left out: the cycle before may have left the tool where that value is.
fn lasts(word: &WordEntry) -> bool {
    word.need == Need::Modal && word.default.is_none()
}
