//! What a comparison leaves out: codes that leave nothing in the acts of a run, as far as one of two runs has them and the
//! other one has not, and words whose values nobody knows.
//!
//! Knows: which codes leave nothing in the acts of a run, how often and with which values a run executes them, which words a run
//! computes from what is not given. Must not know: how differences are worded.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::Arc;

use gcheck_controls::{CodeIx, CodeNumber, Control, Effect, Letter, LetterSet};
use gcheck_engine::{
    Abstract, AbstractValue, At, Concrete, ConcreteValue, Domain as _, Look, Origin, ProgramFile, State,
};
use gcheck_program::{BlockFlags, Op, Value, Word};
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
pub(super) struct Executions<'s> {
    session: &'s Session<'s>,
    look: Look<'s, 's>,
    /// By file and block.
    blocks: Vec<Vec<Executed>>,
    /// Commands with computed words: the values are those of each execution.
    computed: LeftOut,
    /// Variables that blocks read.
    reads: Vec<u32>,
}

/// Of one block.
#[derive(Debug, Default, Clone, Copy)]
struct Executed {
    count: u32,
    /// Has it a computed word that may belong to a command that is not compared? `None` before somebody has looked.
    is_computed: Option<bool>,
    /// On what the values of its words depend; `None` before somebody has looked.
    source: Option<Reads>,
}

/// On what the values of the computed words of a block depend.
#[derive(Debug, Clone, Copy)]
enum Reads {
    /// It has none.
    Nothing,
    /// On these variables of its program, of all that were noted.
    Variables { first: u32, count: u32 },
    /// On more: variables of the control, names, numbers of variables that are computed.
    More,
}

impl<'s> Executions<'s> {
    pub(super) fn new(session: &'s Session<'s>) -> Self {
        let look = Look::new(session.program, session.model, &session.prepared.equipment.machine);
        Self { session, look, blocks: Vec::new(), computed: LeftOut::default(), reads: Vec::new() }
    }

    /// A block is executed in this state.
    pub(super) fn count(&mut self, origin: Origin, state: &State<Concrete>) {
        let has_code = origin.flags.contains(BlockFlags::CODE);
        let has_expression = origin.flags.contains(BlockFlags::EXPRESSION);
        if !has_code && !has_expression {
            return;
        }
        let (file, block) = (origin.at.file as usize, origin.at.block as usize);
        if self.blocks.len() <= file {
            self.blocks.resize_with(file + 1, Vec::new);
        }
        let Some(blocks) = self.blocks.get_mut(file) else { return };
        if blocks.len() <= block {
            blocks.resize(block + 1, Executed::default());
        }
        let Some(executed) = blocks.get_mut(block) else { return };
        executed.count = executed.count.saturating_add(1);
        if !has_expression {
            return;
        }
        let Executed { is_computed, source, .. } = *executed;
        let source = source.unwrap_or_else(|| self.reads_of(origin.at));
        // Most expressions are of variables that the program has set: then there is nothing to evaluate.
        let may_be_unknown = match source {
            Reads::Nothing => false,
            Reads::Variables { first, count } => {
                let read = self.reads.get(first as usize..(first + count) as usize).unwrap_or_default();
                read.iter().any(|number| {
                    let of_program = || state.variables().get(*number);
                    state.local(*number).copied().unwrap_or_else(of_program) == ConcreteValue::Unknown
                })
            }
            Reads::More => true,
        };
        let may_be_command = has_code && is_computed != Some(false);
        let mut now_computed = is_computed;
        if may_be_unknown || may_be_command {
            let is_command = self.compute(origin.at, state, may_be_unknown);
            if has_code {
                now_computed = Some(is_command);
            }
        }
        // Its list is still there.
        if let Some(executed) = self.blocks.get_mut(file).and_then(|blocks| blocks.get_mut(block)) {
            (executed.is_computed, executed.source) = (now_computed, Some(source));
        }
    }

    /// On what the values of the words of a block depend.
    fn reads_of(&mut self, at: At) -> Reads {
        let session = self.session;
        let dialect = session.program.dialect();
        let file = session.program.file(at.file);
        let Some(block) = file.and_then(|file| file.loaded.place(at.block, dialect)) else {
            return Reads::Nothing;
        };
        let table = &*block.table;
        let semantics = session.model.semantics();
        let is_own = |number: u32| {
            let is_of_control = semantics.system_variables.iter().any(|of| of.cell(number).is_some());
            number != 0 && semantics.kept_as(number) == number && !is_of_control
        };
        let first = self.reads.len();
        let mut is_computed = false;
        for word in table.words(block.block()) {
            let Value::Expr(expr) = word.value else { continue };
            is_computed = true;
            for op in table.ops(table.expr(expr)) {
                match op {
                    Op::Variable(number) if is_own(*number) => self.reads.push(*number),
                    Op::Variable(_) | Op::Named { .. } | Op::Indirect => {
                        self.reads.truncate(first);
                        return Reads::More;
                    }
                    Op::Number(_) | Op::Negate | Op::Binary(_) | Op::Call(..) => {}
                }
            }
        }
        let count = self.reads.len() - first;
        match (is_computed, u32::try_from(first), u32::try_from(count)) {
            (false, ..) => Reads::Nothing,
            (true, Ok(first), Ok(count)) => Reads::Variables { first, count },
            (true, ..) => Reads::More,
        }
    }

    /// Notes the commands of a block that are not compared, with the values that its words have in this state, and its words
    /// whose values are not known, if some may be. Has it such commands?
    fn compute(&mut self, at: At, state: &State<Concrete>, may_be_unknown: bool) -> bool {
        let session = self.session;
        let Some(file) = session.program.file(at.file) else { return false };
        let Some(block) = file.loaded.place(at.block, session.program.dialect()) else { return false };
        let words = block.table.words(block.block());
        let is_code = |word: &Word| CODES.contains(word.letter);
        let has_computed_code = words.iter().any(|word| is_code(word) && word.is_computed());
        let is_command = has_computed_code || !commands(words, &[], session).is_empty();
        if !is_command && !may_be_unknown {
            return false;
        }
        let values = self.look.words(&block, at, &state.as_abstract());
        let place = || place(session, &file, block.range().start);
        let mut told = LetterSet::EMPTY;
        for command in commands(words, &values, session) {
            let Command { name, mut words, reads } = command;
            told = told.or(reads);
            if self.computed.0.len() >= MOST_COMPUTED
                && !self.computed.0.contains_key(&(name.clone(), words.clone()))
            {
                words = None;
            }
            self.computed.add(name, words, 1, place);
        }
        // What is beside the call of a macro is known to who reads the variables there.
        if !may_be_unknown || calls_macro(words, session) {
            return is_command;
        }
        for word in words {
            let Value::Expr(expr) = word.value else { continue };
            if told.contains(word.letter) || UNCOMPARED.contains(word.letter) {
                continue;
            }
            if let Said::Unknown = said(word, &values) {
                let range = block.table.expr(expr).range.clone();
                let bytes = (block.base + range.start) as usize..(block.base + range.end) as usize;
                let text = file.loaded.text();
                let written: String =
                    text.get(bytes).unwrap_or_default().chars().filter(|c| !c.is_whitespace()).collect();
                self.computed.add(format!("{}{written}", word.letter), None, 1, place);
            }
        }
        is_command
    }

    /// What these blocks say that is not compared.
    pub(super) fn left_out(self) -> LeftOut {
        let session = self.session;
        let mut found = self.computed;
        for (file_index, blocks) in (0..).zip(&self.blocks) {
            let Some(file) = session.program.file(file_index) else { continue };
            let said = |executed: &Executed| executed.count > 0 && executed.is_computed != Some(true);
            for (block, executed) in (0..).zip(blocks).filter(|(_, executed)| said(executed)) {
                let Some(block) = file.loaded.place(block, session.program.dialect()) else { continue };
                let place = || place(session, &file, block.range().start);
                let words = block.table.words(block.block());
                for Command { name, words, .. } in commands(words, &[], session) {
                    found.add(name, words, u64::from(executed.count), place);
                }
            }
        }
        found
    }
}

/// Commands with computed words whose values are told apart; the values of further ones count as unknown.
const MOST_COMPUTED: usize = 100_000;

/// Where a block is that begins at this byte of a file.
fn place(session: &Session<'_>, file: &ProgramFile<'_>, start: u32) -> Place {
    let name = if file.name.is_empty() { session.prepared.shown.as_str() } else { &file.name };
    Place { file: Arc::from(name), line: file.loaded.line_number(start) }
}

/// What a word says.
enum Said {
    Number(f64),
    /// A letter alone.
    Letter,
    /// An empty variable is beside the letter: the word is not there.
    Nothing,
    Unknown,
}

fn said(word: &Word, values: &[(Word, AbstractValue)]) -> Said {
    if let Some(number) = word.number() {
        return Said::Number(number);
    }
    if !word.is_computed() {
        return Said::Letter;
    }
    match values.iter().find(|(computed, _)| computed == word) {
        Some((_, AbstractValue::Vacant)) => Said::Nothing,
        // Without the noise of computing.
        Some((_, value)) => Abstract::known(value)
            .map_or(Said::Unknown, |number| Said::Number((number * 1e9).round() / 1e9 + 0.0)),
        None => Said::Unknown,
    }
}

/// The commands of a block that are not compared, with the values of its computed words: the name of each, and its other words,
/// `None` where the value of one is not known.
fn commands(words: &[Word], values: &[(Word, AbstractValue)], session: &Session<'_>) -> Vec<Command> {
    let control = session.model.control();
    let codes = || words.iter().filter(|word| CODES.contains(word.letter));
    // What is beside the call of a macro may be an argument.
    if calls_macro(words, session) {
        return Vec::new();
    }
    let number = |word: &Word| match said(word, values) {
        Said::Number(number) => Some(number),
        Said::Letter | Said::Nothing | Said::Unknown => None,
    };
    let mut found = Vec::new();
    for word in codes() {
        let Some(value) = number(word) else { continue };
        let ix = if word.is_computed() { computed_code(word.letter, value, control) } else { word.code };
        let code = control.code_at(ix);
        if code.is_some_and(|code| code.alias().is_some()) {
            continue;
        }
        let kind = words.iter().find(|word| word.letter == Letter::of('L')).and_then(number);
        let effect = code.map_or(Effect::None, gcheck_controls::Code::effect);
        if !is_left_out(effect, kind) {
            continue;
        }
        let mut name = match code {
            Some(code) => code.number().to_string(),
            None => format!("{}{value}", word.letter),
        };
        let mut reads = code.map_or(COMMON, gcheck_controls::Code::reads);
        if let Some(kind) = kind.filter(|_| effect == Effect::WriteOffsets) {
            // Writing to a string cannot fail.
            let _ = write!(name, " L{kind}");
            reads = reads.without(LetterSet::of("L"));
        }
        // `N` of a code that has it for its rows of data is the number of its block.
        let other = reads.without(CODES).without(UNCOMPARED);
        let mut own: Vec<&Word> = words.iter().filter(|word| other.contains(word.letter)).collect();
        own.sort_by_key(|word| word.letter.index());
        let text = own.into_iter().map(|word| match said(word, values) {
            Said::Number(number) => Some(format!("{}{number} ", word.letter)),
            Said::Letter => Some(format!("{} ", word.letter)),
            Said::Nothing => Some(String::new()),
            Said::Unknown => None,
        });
        found.push(Command { name, words: text.collect(), reads });
    }
    found
}

/// A command that is not compared.
struct Command {
    name: String,
    /// Its other words, `None` where the value of one is not known.
    words: Option<String>,
    /// The letters of these.
    reads: LetterSet,
}

/// Does a block call a macro? Then its words may be arguments.
fn calls_macro(words: &[Word], session: &Session<'_>) -> bool {
    let control = session.model.control();
    let codes = words.iter().filter(|word| CODES.contains(word.letter));
    let mut effects = codes.filter_map(|word| control.code_at(word.code).map(gcheck_controls::Code::effect));
    effects.any(|effect| matches!(effect, Effect::MacroCall | Effect::MacroModal))
}

/// The code that a computed number is.
fn computed_code(letter: Letter, value: f64, control: &Control) -> CodeIx {
    let number = letter.to_string().bytes().next().and_then(|letter| CodeNumber::from_value(letter, value));
    number.map_or(CodeIx::NONE, |number| control.code_ix(number))
}

/// Addresses of codes.
const CODES: LetterSet = LetterSet::of("GM");
/// Words that name a block or a program, and move nothing.
const UNCOMPARED: LetterSet = LetterSet::of("NO");
/// Words that a code may have of which nothing is known.
const COMMON: LetterSet = LetterSet::of("PQRLE");

/// The commands of a run that are not compared, by their names and their words with their values, and the words whose values are
/// not known.
#[derive(Debug, Default)]
pub(super) struct LeftOut(BTreeMap<(String, Option<String>), Commanded>);

#[derive(Debug)]
struct Commanded {
    count: u64,
    place: Place,
}

impl LeftOut {
    /// A command was executed so many times. `name` is what people call it (`M51`, `G10 L12`), `words` is what else it says.
    fn add(&mut self, name: String, words: Option<String>, count: u64, place: impl FnOnce() -> Place) {
        self.0.entry((name, words)).or_insert_with(|| Commanded { count: 0, place: place() }).count += count;
    }
}

/// A command that is not compared, and that the two runs do not have alike, or a word whose value is not known.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::commands) struct NotCompared {
    /// What people call it: `M51`, `G10 L12`, `F[#500+1.]`.
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
            // What nobody knows may be something else in the other run.
            let known = Some(command).filter(|(_, words)| words.is_some());
            let of_other =
                known.and_then(|command| other.0.get(command)).map_or(0, |executed| executed.count);
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
            let words = (*words != "P?").then(|| (*words).to_owned());
            run.add((*name).to_owned(), words, 1, || Place { file: "a.nc".into(), line: *line });
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
    fn a_command_with_words_that_nobody_knows_is_like_no_other() {
        assert_eq!(found(&[("M170", "P?", 3)], &[("M170", "P?", 3)]), ["M170 1@3 1@3"]);
    }

    #[test]
    fn the_same_command_with_other_words_is_another_command() {
        assert_eq!(found(&[("G10 L12", "P1 R4", 2)], &[("G10 L12", "P1 R5", 2)]), ["G10 L12 1@2 1@2"]);
    }
}
