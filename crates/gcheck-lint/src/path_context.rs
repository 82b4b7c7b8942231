//! What a rule of the path tier may ask while a program is executed, and when all paths were seen.
//!
//! Knows: the block that is being executed, its state, where facts were set, and how a place becomes a label. Must not know:
//! any rule, how paths are found.

use std::borrow::Cow;
use std::cell::Cell;
use std::ops::Range;
use std::rc::Rc;

use gcheck_controls::{Code, CodeIx, CodeNumber, Control, Effect, Letter, LetterSet, Machine};
use gcheck_diagnostics::{Certainty, Finding, RuleMeta, Severity};
use gcheck_engine::{
    Abstract, AbstractValue, At, Domain, Fact, FlowCx, FlowResult, FrameKind, Model, Origin, Program,
    ReachingDefinitions, Role, State, Units,
};
use gcheck_geometry::Mm;
use gcheck_program::{BlockFlags, BlockTable, ExprIx, FileIndex, Place, Word};

use crate::block_context::facts_of;
use crate::evaluated::{BlockOfValues, Evaluate, Evaluated, with_codes};
use crate::shared_memory::SharedMemories;
use crate::text_memo::TextMemo;
use crate::{Environment, SharedMemory, WordFacts};

/// What a rule of the path tier may ask while a program is executed.
#[derive(Clone, Copy)]
pub struct PathCx<'a> {
    /// Control, machine, other programs.
    pub environment: Environment<'a>,
    /// The programs in execution.
    pub program: &'a Program<'a>,
    /// The control, prepared for execution.
    pub model: &'a Model<'a>,
    /// What the main file holds, without regard to paths.
    pub file_index: &'a FileIndex,
    pub(crate) flow: &'a FlowCx<'a>,
    /// The block's words, when a rule was shown the block.
    pub(crate) read: Option<&'a ReadBlock>,
    /// What the rule that is being called wishes.
    pub(crate) wishes: &'a Wishes,
    pub(crate) shared: &'a SharedMemories,
    pub(crate) memo: &'a TextMemo,
    pub(crate) evaluate: &'a dyn Evaluate,
    /// Evaluated when the first rule asks.
    pub(crate) evaluated: &'a Evaluated,
    /// See [`PathCx::is_called_only`].
    pub(crate) is_called_only: bool,
    /// The addresses of the block without those beside empty variables, where there are such.
    pub(crate) letters: Option<LetterSet>,
}

/// What a rule that was called wishes of further calls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Wish {
    #[default]
    None,
    /// No more calls of this kind.
    Enough,
    /// No more calls of this kind in this streak of moves.
    Rest,
}

/// The wish of the rule that is being called.
pub(crate) type Wishes = Cell<Wish>;

/// Blocks that [`PathRule::block`](crate::PathRule::block) may be called for.
pub(crate) fn is_read(origin: Origin) -> bool {
    use BlockFlags as F;
    const LETTERS: LetterSet = LetterSet::of("FSTHD");
    origin.flags.intersects(F::CODE | F::STATEMENT | F::EXPRESSION | F::UNREAD_WORD)
        || origin.letters.intersects(LETTERS)
}

/// A block as rules read it, kept because loops come by again.
#[derive(Clone)]
pub(crate) struct ReadBlock {
    at: At,
    pub(crate) place: Place,
    codes: Vec<CodeIx>,
    effects: Vec<Effect>,
    /// Of its words, then of its statements.
    expressions: Vec<ExprIx>,
    /// Its words, where a computed code among them is known.
    words: Option<Vec<Word>>,
    /// Does more than choose a motion: [`Watch::BLOCKS`](crate::Watch::BLOCKS).
    pub(crate) is_eventful: bool,
    /// Has a word like `G#1`.
    pub(crate) has_computed_code: bool,
}

impl ReadBlock {
    /// Reads a block; `None` if the program has no such block.
    pub(crate) fn new(
        at: At,
        program: &Program<'_>,
        model: &Model<'_>,
        environment: Environment<'_>,
    ) -> Option<Self> {
        let place = program.file(at.file)?.loaded.place(at.block, environment.dialect)?;
        let expressions = place.expressions().collect();
        let has_computed_code = place.table.words(place.block()).iter().any(is_computed_code);
        let mut read = Self {
            at,
            place,
            codes: Vec::new(),
            effects: Vec::new(),
            expressions,
            words: None,
            is_eventful: true,
            has_computed_code,
        };
        read.read_codes(model);
        Some(read)
    }

    /// The same block with the codes that its computed words name in a state.
    pub(crate) fn with_codes(&self, values: &[(Word, AbstractValue)], model: &Model<'_>) -> Self {
        let words = with_codes(self.place.table.words(self.place.block()), values, model);
        let mut read = Self { words: Some(words), ..self.clone() };
        read.read_codes(model);
        read
    }

    fn words(&self) -> &[Word] {
        match &self.words {
            Some(words) => words,
            None => self.place.table.words(self.place.block()),
        }
    }

    fn read_codes(&mut self, model: &Model<'_>) {
        let words = self.words().iter();
        let codes: Vec<CodeIx> = words.map(|word| word.code).filter(|code| code.is_some()).collect();
        let effects: Vec<Effect> = codes.iter().map(|code| model.effect(*code)).collect();
        let is_motion = |effect: &Effect| {
            matches!(
                effect,
                Effect::Rapid | Effect::Linear | Effect::ArcClockwise | Effect::ArcCounterClockwise
            )
        };
        let letters = self.place.block().letters;
        self.is_eventful = letters.intersects(LetterSet::of("THD"))
            || !effects.iter().all(is_motion)
            || effects.is_empty() && letters.intersects(LetterSet::of("FS"));
        (self.codes, self.effects) = (codes, effects);
    }
}

/// Is the word a code that an expression names: `G#1`?
fn is_computed_code(word: &Word) -> bool {
    matches!(word.letter.ascii(), b'G' | b'M') && !word.letter.is_corner() && word.is_computed()
}

impl<'a> PathCx<'a> {
    /// The rule has seen enough: of all that it watches, what it is shown now is not shown to it any more in this analysis.
    pub fn enough(&self) {
        self.wishes.set(Wish::Enough);
    }

    /// The rule has seen enough of this streak: like moves (all at feed, all rapid, or all strokes) of blocks that have nothing but
    /// axes, one after the other on every path, with no event between them but moves and dwells. The rest of it is not shown to the
    /// rule where it is shown this move. In a block that has more, it is shown the next one all the same.
    pub fn rest(&self) {
        if self.wishes.get() == Wish::None && self.flow.solo && !is_read(self.flow.origin) {
            self.wishes.set(Wish::Rest);
        }
    }

    /// What rules remember together, of a type that the asking rule [shares](crate::PathRule::shares).
    pub fn shared<T: SharedMemory + 'static>(&self) -> Option<&'a T> {
        self.shared.get()
    }

    /// What follows from the text of the main file alone for a block and a number, worked out once and then kept.
    pub fn from_text<T: Clone + 'static>(&self, at: At, number: u32, work_out: impl FnOnce() -> T) -> T {
        match self.program.file(0) {
            Some(file) => self.memo.get(&file.loaded, (at, number), work_out),
            None => work_out(),
        }
    }

    /// What may be the state.
    pub fn state(&self) -> &'a State<Abstract> {
        self.flow.state
    }

    /// Where facts were set.
    pub fn definitions(&self) -> &'a ReachingDefinitions {
        self.flow.definitions
    }

    /// The block.
    pub fn origin(&self) -> Origin {
        let origin = self.flow.origin;
        Origin { letters: self.letters.unwrap_or(origin.letters), ..origin }
    }

    /// Every path comes here in this state. Otherwise a fact of the state holds on every path that comes here.
    pub fn is_on_every_path(&self) -> bool {
        self.flow.solo
    }

    /// The block's bytes.
    pub fn range(&self) -> Range<u32> {
        self.flow.origin.start..self.flow.origin.end
    }

    /// The block with its words.
    pub fn place(&self) -> Option<Place> {
        if let Some(read) = self.read_block() {
            return Some(read.place.clone());
        }
        self.place_of(self.flow.origin.at)
    }

    /// The block, if it was read.
    pub(crate) fn read_block(&self) -> Option<&'a ReadBlock> {
        // Under cutter compensation an event may belong to a block before the one under way.
        self.read.filter(|read| read.at == self.flow.origin.at)
    }

    /// A block of the main file.
    pub fn place_of(&self, at: At) -> Option<Place> {
        let file = self.program.file(at.file)?;
        file.loaded.place(at.block, self.environment.dialect)
    }

    /// Bytes of a block of the main file; `None` for blocks of other files.
    pub fn range_of(&self, at: At) -> Option<Range<u32>> {
        (at.file == 0).then(|| self.place_of(at)).flatten().map(|place| place.range())
    }

    /// Bytes of the first word of the block that `is` accepts; the whole block when there is none.
    pub fn word_range(&self, is: impl Fn(&Word) -> bool) -> Range<u32> {
        self.find_word(self.flow.origin.at, is).unwrap_or_else(|| self.range())
    }

    /// Bytes of the word with an address; the whole block when it has none.
    pub fn letter_range(&self, letter: char) -> Range<u32> {
        self.word_range(|word| word.letter == Letter::of(letter))
    }

    /// Bytes of the first code with an effect that `is` accepts; the whole block when there is none.
    pub fn effect_range(&self, is: impl Fn(Effect) -> bool) -> Range<u32> {
        self.word_range(|word| word.code.is_some() && is(self.model.effect(word.code)))
    }

    /// Bytes of the first word of a block of the main file that `is` accepts.
    pub fn find_word(&self, at: At, is: impl Fn(&Word) -> bool) -> Option<Range<u32>> {
        self.search(at, |word| is(word).then_some(())).map(|((), range)| range)
    }

    /// The first code of a block of the main file that `is` accepts, with its bytes.
    pub fn find_code(&self, at: At, is: impl Fn(Code<'a>) -> bool) -> Option<(Code<'a>, Range<u32>)> {
        self.search(at, |word| self.code_of(word.code).filter(|code| is(*code)))
    }

    fn search<T>(&self, at: At, found: impl Fn(&Word) -> Option<T>) -> Option<(T, Range<u32>)> {
        let place = self.place_of(at).filter(|_| at.file == 0)?;
        let known = self.read_block().filter(|_| at == self.flow.origin.at);
        let words = known.map_or_else(|| place.table.words(place.block()), ReadBlock::words);
        let (found, word) = words.iter().find_map(|word| Some((found(word)?, word)))?;
        Some((found, place.base + word.range().start..place.base + word.range().end))
    }

    /// The codes of the block.
    pub fn codes(&self) -> Cow<'a, [CodeIx]> {
        if let Some(read) = self.read_block() {
            return Cow::Borrowed(&read.codes);
        }
        if !self.origin().flags.contains(BlockFlags::CODE) {
            return Cow::Borrowed(&[]);
        }
        let codes = |place: Place| {
            let words = place.table.words(place.block()).iter();
            words.map(|word| word.code).filter(|code| code.is_some()).collect()
        };
        Cow::Owned(self.place().map_or_else(Vec::new, codes))
    }

    /// The expressions of the block, and the table that holds them.
    pub fn expressions(&self) -> Option<(Rc<BlockTable>, Cow<'a, [ExprIx]>)> {
        if let Some(read) = self.read_block() {
            return Some((Rc::clone(&read.place.table), Cow::Borrowed(&read.expressions)));
        }
        let place = self.place()?;
        let found = place.expressions().collect();
        Some((place.table, Cow::Owned(found)))
    }

    /// Does the block have a code with an effect that `is` accepts?
    pub fn has_effect(&self, is: impl Fn(Effect) -> bool) -> bool {
        if !self.origin().flags.contains(BlockFlags::CODE) {
            return false;
        }
        match self.read_block() {
            Some(read) => read.effects.iter().any(|effect| is(*effect)),
            None => self.codes().iter().any(|code| is(self.model.effect(*code))),
        }
    }

    /// Does the block have a code that `is` accepts?
    pub fn has_code(&self, is: impl Fn(Code<'a>) -> bool) -> bool {
        self.codes().iter().filter_map(|ix| self.code_of(*ix)).any(is)
    }

    /// The code in effect for a role as programs write it; `None` when it may be several.
    pub fn code_name(&self, role: Role) -> Option<String> {
        let code = self.state().mode(role).only()?;
        self.environment.control().code_at(code).map(|code| code.number().to_string())
    }

    /// The control.
    pub fn control(&self) -> &'a Control {
        self.environment.control()
    }

    /// A code of the control.
    pub fn code_of(&self, code: CodeIx) -> Option<Code<'a>> {
        self.control().code_at(code)
    }

    /// The code as programs write it.
    pub fn name_of(&self, code: CodeIx) -> String {
        self.code_of(code).map(|code| code.number().to_string()).unwrap_or_default()
    }

    /// The code of the control with an effect, as programs write it: of several the one in effect at power-on, else the first.
    pub fn name_of_effect(&self, effect: Effect) -> Option<String> {
        let codes = || self.control().codes().filter(|code| code.effect() == effect);
        let is_usual = |code: &Code<'_>| {
            let usual = code.group().default.as_deref().and_then(CodeNumber::parse);
            usual == Some(code.number())
        };
        let code = codes().find(is_usual).or_else(|| codes().next())?;
        Some(code.number().to_string())
    }

    /// Does the control have a code with an effect that `is` accepts?
    pub fn control_has(&self, is: impl Fn(Effect) -> bool) -> bool {
        self.control().codes().any(|code| is(code.effect()))
    }

    /// Is the machine a mill, not a lathe?
    pub fn is_mill(&self) -> bool {
        self.control().machine() == Machine::Mill
    }

    /// The code of the block that sets the mode of a role; the last one, as controls take it.
    pub fn code_of_role(&self, role: Role) -> Option<CodeIx> {
        self.codes().iter().copied().rfind(|code| self.model.role(*code) == Some(role))
    }

    /// Does the block name an axis?
    pub fn names_axes(&self) -> bool {
        self.has_axis_among(self.origin().letters)
    }

    /// Is an axis among the addresses?
    pub fn has_axis_among(&self, letters: LetterSet) -> bool {
        let control = self.control();
        letters.iter().any(|letter| control.letter(letter).is_some_and(|entry| entry.axis))
    }

    /// The first word of the block with an address; none if it is beside an empty variable.
    pub fn word(&self, letter: char) -> Option<Word> {
        let letter = Letter::of(letter);
        if !self.gives(letter) {
            return None;
        }
        let place = self.place()?;
        place.table.words(place.block()).iter().find(|word| word.letter == letter).copied()
    }

    /// Has the block a word that `is` accepts, not beside an empty variable?
    pub fn has_word(&self, is: impl Fn(&Word) -> bool) -> bool {
        self.find_word(self.origin().at, |word| self.gives(word.letter) && is(word)).is_some()
    }

    /// Does the block give the address a value? The control ignores a word whose variable is empty.
    fn gives(&self, letter: Letter) -> bool {
        self.letters.is_none_or(|letters| letters.contains(letter))
    }

    /// Has the block a syntax error, so that words of it may be lost? Other rules report it.
    pub fn is_malformed(&self) -> bool {
        self.origin().flags.contains(BlockFlags::ERROR)
    }

    /// A variable's value, if it is exactly known.
    pub fn known_variable(&self, number: u32) -> Option<f64> {
        Abstract::known(&self.state().variables().get(number))
    }

    /// How deep in calls the block is: 1 in the main program.
    pub fn depth(&self) -> usize {
        self.state().frames().len()
    }

    /// Does the file use a code with an effect that `is` accepts, on some path or none?
    pub fn file_uses(&self, is: impl Fn(Effect) -> bool) -> bool {
        let control = self.control();
        let mut codes =
            self.file_index.codes.iter().filter_map(|(number, _)| control.code_at(control.code_ix(*number)));
        codes.any(|code| is(code.effect()))
    }

    /// May the file use such a code? As [`Self::file_uses`], but a computed code may be any.
    pub fn file_may_use(&self, is: impl Fn(Effect) -> bool) -> bool {
        self.file_index.has_computed_codes || self.file_uses(is)
    }

    /// The file holds what others call, and no main program: what its caller set is not known.
    pub fn is_called_only(&self) -> bool {
        self.is_called_only
    }

    /// Does what the state holds come from this program alone, on every path to here? Then what it has done so far is known.
    pub fn is_certain(&self) -> bool {
        self.is_on_every_path() && !self.is_called_only() && !self.is_after_unknown_program()
    }

    /// A program was called that is not available: it may have changed anything.
    pub fn is_after_unknown_program(&self) -> bool {
        // Modes that hardly any program switches are known to be what the control starts with, unless a program was called
        // of which nothing is known.
        let is_any = |role: Role| {
            let mode = self.state().mode(role);
            mode.only().is_none() && mode.alternatives().is_empty()
        };
        is_any(Role::Polar) && is_any(Role::Cylinder)
    }

    /// Does the end of the program bring a mode back to the control's start?
    pub fn end_resets(&self, role: Role) -> bool {
        let setting = self.model.semantics().at_end_setting.as_ref();
        let told = setting.and_then(|number| self.environment.machine.settings.get(number));
        let keeps = told.is_some_and(|value| value == "off" || value == "false");
        !keeps && self.at_end().any(|code| Role::of(code.effect()) == Some(role))
    }

    /// Codes that the end of the program brings into effect.
    pub fn at_end(&self) -> impl Iterator<Item = Code<'a>> + use<'a> {
        let control = self.control();
        let names = &self.model.semantics().at_end;
        names.iter().filter_map(move |name| control.code_at(control.code_ix(CodeNumber::parse(name)?)))
    }

    /// What a word of an address means in the block; see [`BlockCx::facts`](crate::BlockCx::facts).
    pub fn facts(&self, letter: Letter) -> Option<WordFacts<'a>> {
        let codes = self.codes();
        let control = self.control();
        facts_of(control, codes.iter().filter_map(|ix| control.code_at(*ix)), letter)
    }

    /// The computed words of the block before it is executed, each with the values that it may have on the paths that come
    /// here; those that have no value are left out.
    pub fn computed_words(&self) -> &'a [(Word, AbstractValue)] {
        self.evaluated.words(|| {
            let Some(place) = self.place() else { return Vec::new() };
            self.evaluate.words(&place, self.origin().at, self.state())
        })
    }

    /// The block with a number in each computed word that has the same value on every path that comes here; `None` when
    /// there is no such word.
    pub(crate) fn block_of_values(&self) -> Option<&'a BlockOfValues> {
        let values = self.computed_words();
        self.evaluated.block(|| {
            let place = self.place()?;
            BlockOfValues::new(&place, values, self.model, self.environment.dialect)
        })
    }

    /// The value of a word of the block, written or computed, where it has the same on every path that comes here.
    pub fn known_number(&self, letter: char) -> Option<f64> {
        let written = self.word(letter)?.number();
        written.or_else(|| {
            let words = self.computed_words();
            let (_, value) = words.iter().find(|(word, _)| word.letter == Letter::of(letter))?;
            Abstract::known(value)
        })
    }

    /// A length as the program counts, rounded to what controls resolve: `1.75 in`.
    pub fn shown(&self, length: Mm) -> String {
        let (value, digits, unit) = match self.state().units(self.model) {
            Some(Units::Inch) => (length.inch(), 4, "in"),
            _ => (length.0, 3, "mm"),
        };
        let text = format!("{value:.digits$}");
        format!("{} {unit}", text.trim_end_matches('0').trim_end_matches('.'))
    }

    /// A finding at bytes of this block, with the calls that led here.
    pub fn finding(&self, rule: &'static RuleMeta, range: Range<u32>, message: impl Into<String>) -> Finding {
        self.with_calls(Finding::new(rule, range, message))
    }

    /// Adds the calls that led here.
    pub(crate) fn with_calls(&self, mut finding: Finding) -> Finding {
        for frame in self.state().frames().iter().skip(1).rev() {
            let how = match frame.kind {
                FrameKind::Main => continue,
                FrameKind::Macro => "macro called here",
                FrameKind::Subprogram | FrameKind::Local | FrameKind::OWord => "called here",
            };
            if let Some(range) = self.range_of(frame.caller) {
                finding = finding.also(range, how);
            }
        }
        finding
    }

    /// Adds where a fact was set: `G41` set here. A fact that still is as at power-on is an assumption, and nothing that
    /// rests on one is more than a warning.
    pub fn resting_on(&self, finding: Finding, fact: Fact, what: &str) -> Finding {
        match self.definitions().set_by(fact) {
            Some(at) if at == self.origin().at => finding,
            Some(at) => {
                let word = self.find_word(at, |word| sets(self.model, word, fact));
                match word.or_else(|| self.range_of(at)) {
                    Some(range) => finding.also(range, format!("{what} set here")),
                    None => finding,
                }
            }
            None => finding
                .at_most(Severity::Warning)
                .assuming(format!("{what} is as the control has it at the start")),
        }
    }

    /// Adds the decisions that led here, for findings that hold on some path only.
    pub fn with_path(&self, mut finding: Finding) -> Finding {
        finding.certainty = Certainty::Maybe;
        for decision in self.definitions().decisions().iter().rev().take(3) {
            if let Some(range) = self.range_of(decision.at) {
                let goes_on =
                    decision.to.block == decision.at.block + 1 && decision.to.file == decision.at.file;
                let how = if goes_on { "when this goes on to the next block" } else { "when this is taken" };
                finding = finding.also(range, how);
            }
        }
        finding
    }
}

/// Does the word set the fact?
fn sets(model: &Model<'_>, word: &Word, fact: Fact) -> bool {
    let letter = |l: char| word.letter == Letter::of(l);
    match fact {
        Fact::Mode(role) => word.code.is_some() && model.role(word.code) == Some(role),
        Fact::Feed => letter('F'),
        Fact::Speed => letter('S'),
        Fact::Selected => letter('T'),
        Fact::Tool => letter('T') || model.effect(word.code) == Effect::ToolChange,
        Fact::Length => letter('H') || model.role(word.code) == Some(Role::Length),
        Fact::Spindle => matches!(
            model.effect(word.code),
            Effect::SpindleClockwise
                | Effect::SpindleCounterClockwise
                | Effect::SpindleStop
                | Effect::SpindleOrient
                | Effect::BarFeed
        ),
        Fact::Chuck => {
            matches!(model.effect(word.code), Effect::ChuckClamp | Effect::ChuckUnclamp | Effect::BarFeed)
        }
        Fact::Shift => matches!(model.effect(word.code), Effect::SetPosition | Effect::LocalShift),
        Fact::Coolant => matches!(
            model.effect(word.code),
            Effect::MistOn | Effect::FloodOn | Effect::ThroughCoolantOn | Effect::CoolantOff
        ),
    }
}

/// What a rule of the path tier may ask when all paths with one position of the block delete switch were seen.
pub struct FollowedCx<'a> {
    /// Control, machine, other programs.
    pub environment: Environment<'a>,
    /// The control, prepared for execution.
    pub model: &'a Model<'a>,
    /// What the main file holds, without regard to paths.
    pub file_index: &'a FileIndex,
}

impl<'a> FollowedCx<'a> {
    /// The control.
    pub fn control(&self) -> &'a Control {
        self.environment.control()
    }
}

/// What a rule of the path tier may ask when all paths were seen.
pub struct FinishCx<'a> {
    /// Control, machine, other programs.
    pub environment: Environment<'a>,
    /// The programs that were executed.
    pub program: &'a Program<'a>,
    /// The control, prepared for execution.
    pub model: &'a Model<'a>,
    /// What the main file holds, without regard to paths.
    pub file_index: &'a FileIndex,
    /// Reachability and assumptions.
    pub result: &'a FlowResult,
    /// Analyses with other positions of the block delete switch.
    pub others: &'a [FlowResult],
}

impl<'a> FinishCx<'a> {
    /// The control.
    pub fn control(&self) -> &'a Control {
        self.environment.control()
    }

    /// Is the block reached with no position of the block delete switch, and is that certain?
    pub fn is_never_reached(&self, at: At) -> bool {
        let all = std::iter::once(self.result).chain(self.others);
        all.into_iter().all(|result| result.reach(at) == gcheck_engine::Reach::Never)
    }

    /// Bytes of a block of the main file.
    pub fn range_of(&self, at: At) -> Option<Range<u32>> {
        let file = self.program.file(at.file).filter(|_| at.file == 0)?;
        file.loaded.place(at.block, self.environment.dialect).map(|place| place.range())
    }
}
