//! Rules of the path tier: what they may watch, and what they are shown.
//!
//! Knows: how the engine's analysis of all paths becomes calls of rules, how a place in a program becomes a label. Must not
//! know: any rule, how paths are found.

use std::borrow::Cow;
use std::cell::Cell;
use std::collections::HashSet;
use std::ops::Range;
use std::rc::Rc;

use gcheck_controls::{CodeIx, Effect, Letter, LetterSet};
use gcheck_engine::{
    Abstract, Assumption, At, Ending, Event, Fact, Fault, FlowCx, FlowObserver, FlowResult, FrameKind,
    Library, Model, Origin, Program, Role, SourceFile, State, Trace, TravelKind, Units,
};
use gcheck_geometry::Mm;
use gcheck_program::{BlockTable, ExprIx, Place, Survey, Word};

use rustc_hash::FxHashMap;

use crate::incremental::{Kept, Layout, Naming, Refinding};
use crate::memory::Remembers;
use crate::usage::{Uses, expressions};
use crate::{Finding, Report, RuleEntry, RuleMeta, Run, Scene, Severity};

bitflags::bitflags! {
    /// What a rule of the path tier wants to see. A rule that watches little costs little.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct Watch: u16 {
        /// [`PathRule::block`]: blocks with a code that does more than choose a motion (`G0` to `G3`), with `T`, `H` or `D`,
        /// or with `F` or `S` and no code, before they are executed.
        const BLOCKS = 1;
        /// [`PathRule::moved`]: every move.
        const MOVES = 1 << 1;
        /// [`PathRule::cut`]: a cutting move, the first one after something else than a move happened.
        const CUTS = 1 << 2;
        /// [`PathRule::changed`]: everything that is no move, but for the path mode.
        const CHANGES = 1 << 3;
        /// [`PathRule::ended`].
        const ENDS = 1 << 4;
        /// [`PathRule::fault`].
        const FAULTS = 1 << 5;
        /// [`PathRule::vacant_read`].
        const READS = 1 << 6;
        /// [`PathRule::endless`].
        const ENDLESS = 1 << 7;
        /// [`PathRule::finish`].
        const FINISH = 1 << 8;
        /// [`PathRule::rapid`]: rapid moves.
        const RAPIDS = 1 << 9;
        /// [`PathRule::block`]: blocks with a code, a statement, an expression, `F`, `S`, `T`, `H` or `D`, before they are
        /// executed.
        const ALL_BLOCKS = 1 << 10;
        /// [`PathRule::moved`]: arcs alone.
        const ARCS = 1 << 11;
    }
}

/// A rule of the path tier. One is made for every file, so that it may remember what it saw.
pub trait PathRule {
    /// What the rule remembers. A rule that does not say what it has fields for is asked to watch all from the start after
    /// every edit, and so are the others.
    fn memory(&mut self) -> Remembers<'_> {
        if size_of_val(self) == 0 { Remembers::Nothing } else { Remembers::Unknown }
    }

    /// Can the rule have anything to say of a program? Asked once; a rule that says no watches nothing. By what the program
    /// uses, most programs spare most rules.
    fn concerns(&self, program: &Uses<'_>) -> bool {
        let _ = program;
        true
    }

    /// A block is about to be executed.
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let _ = (cx, report);
    }

    /// The axes moved; the state is that after the move.
    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let _ = (cx, event, report);
    }

    /// The axes moved at rapid rate.
    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let _ = (cx, event, report);
    }

    /// A cutting move, the first since something changed.
    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let _ = (cx, event, report);
    }

    /// Something happened that is no move.
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let _ = (cx, event, report);
    }

    /// The program ends.
    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        let _ = (cx, ending, report);
    }

    /// The control would stop with an alarm.
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let _ = (cx, fault, report);
    }

    /// A variable is read that was never set.
    fn vacant_read(&mut self, cx: &PathCx<'_>, variable: u32, report: &mut Report<'_>) {
        let _ = (cx, variable, report);
    }

    /// The block leads back to `head` in the state that was met there before.
    fn endless(&mut self, cx: &PathCx<'_>, head: At, report: &mut Report<'_>) {
        let _ = (cx, head, report);
    }

    /// All paths were seen.
    fn finish(&mut self, cx: &FinishCx<'_>, report: &mut Report<'_>) {
        let _ = (cx, report);
    }
}

/// What a rule of the path tier may ask while a program is executed.
#[derive(Clone, Copy)]
pub struct PathCx<'a> {
    /// Control, machine, other programs.
    pub scene: Scene<'a>,
    /// The programs in execution.
    pub program: &'a Program<'a>,
    /// The control, prepared for execution.
    pub model: &'a Model<'a>,
    /// What the main file holds, without regard to paths.
    pub survey: &'a Survey,
    flow: &'a FlowCx<'a>,
    /// The block's words, when a rule was shown the block.
    read: Option<&'a ReadBlock>,
    /// The rule under way wants no more calls of this kind.
    had_enough: &'a Cell<bool>,
}

/// A block as rules read it, kept because loops come by again.
struct ReadBlock {
    at: At,
    place: Place,
    codes: Vec<CodeIx>,
    effects: Vec<Effect>,
    /// Of its words, then of its statements.
    expressions: Vec<ExprIx>,
    /// Does more than choose a motion: [`Watch::BLOCKS`].
    is_eventful: bool,
}

impl<'a> PathCx<'a> {
    /// The rule has seen enough: of all that it watches, what it is shown now is not shown to it any more in this analysis.
    pub fn enough(&self) {
        self.had_enough.set(true);
    }

    /// What may be the state.
    pub fn state(&self) -> &'a State<Abstract> {
        self.flow.state
    }

    /// Where facts were set.
    pub fn trace(&self) -> &'a Trace {
        self.flow.trace
    }

    /// The block.
    pub fn origin(&self) -> Origin {
        self.flow.origin
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

    fn read_block(&self) -> Option<&'a ReadBlock> {
        // Under cutter compensation an event may belong to a block before the one under way.
        self.read.filter(|read| read.at == self.flow.origin.at)
    }

    /// A block of the main file.
    pub fn place_of(&self, at: At) -> Option<Place> {
        let file = self.program.file(at.file)?;
        file.loaded.place(at.block, self.scene.dialect)
    }

    /// Bytes of a block of the main file; `None` for blocks of other files.
    pub fn range_of(&self, at: At) -> Option<Range<u32>> {
        (at.file == 0).then(|| self.place_of(at)).flatten().map(|place| place.range())
    }

    /// Bytes of the first word of the block that `is` says yes to; the whole block when there is none.
    pub fn word_range(&self, is: impl Fn(&Word) -> bool) -> Range<u32> {
        self.find_word(self.flow.origin.at, is).unwrap_or_else(|| self.range())
    }

    /// Bytes of the word with an address; the whole block when it has none.
    pub fn letter_range(&self, letter: char) -> Range<u32> {
        self.word_range(|word| word.letter == Letter::of(letter) && !word.letter.is_corner())
    }

    /// Bytes of the first code with an effect that `is` says yes to; the whole block when there is none.
    pub fn effect_range(&self, is: impl Fn(Effect) -> bool) -> Range<u32> {
        self.word_range(|word| word.code.is_some() && is(self.model.effect(word.code)))
    }

    /// Bytes of the first word of a block of the main file that `is` says yes to.
    pub fn find_word(&self, at: At, is: impl Fn(&Word) -> bool) -> Option<Range<u32>> {
        let place = self.place_of(at).filter(|_| at.file == 0)?;
        let word = place.table.words(place.block()).iter().find(|word| is(word))?;
        Some(place.base + word.range().start..place.base + word.range().end)
    }

    /// The codes of the block.
    pub fn codes(&self) -> Cow<'a, [CodeIx]> {
        if let Some(read) = self.read_block() {
            return Cow::Borrowed(&read.codes);
        }
        let codes = |place: Place| {
            let words = place.table.words(place.block()).iter();
            words.map(|word| word.code).filter(|code| code.is_some()).collect()
        };
        Cow::Owned(self.place().map_or_else(Vec::new, codes))
    }

    /// The expressions of the block, and the table that they stand in.
    pub(crate) fn expressions(&self) -> Option<(Rc<BlockTable>, Cow<'a, [ExprIx]>)> {
        if let Some(read) = self.read_block() {
            return Some((Rc::clone(&read.place.table), Cow::Borrowed(&read.expressions)));
        }
        let place = self.place()?;
        let found = expressions(&place);
        Some((place.table, Cow::Owned(found)))
    }

    /// Does the block have a code with an effect that `is` says yes to?
    pub fn has_effect(&self, is: impl Fn(Effect) -> bool) -> bool {
        if !self.origin().flags.contains(gcheck_program::BlockFlags::CODE) {
            return false;
        }
        match self.read_block() {
            Some(read) => read.effects.iter().any(|effect| is(*effect)),
            None => self.codes().iter().any(|code| is(self.model.effect(*code))),
        }
    }

    /// The code in effect for a role as programs write it; `None` when it may be several.
    pub fn code_name(&self, role: Role) -> Option<String> {
        let code = self.state().mode(role).only()?;
        self.scene.control().code_at(code).map(|code| code.number().to_string())
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
        let mut finding = Finding::new(rule, range, message);
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
        match self.trace().set_by(fact) {
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
        finding.certainty = crate::Certainty::Maybe;
        for decision in self.trace().decisions().iter().rev().take(3) {
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
    let letter = |l: char| word.letter == Letter::of(l) && !word.letter.is_corner();
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

/// What a rule of the path tier may ask when all paths were seen.
pub struct FinishCx<'a> {
    /// Control, machine, other programs.
    pub scene: Scene<'a>,
    /// The programs that were executed.
    pub program: &'a Program<'a>,
    /// The control, prepared for execution.
    pub model: &'a Model<'a>,
    /// What the main file holds, without regard to paths.
    pub survey: &'a Survey,
    /// Reachability and assumptions.
    pub result: &'a FlowResult,
    /// Analyses with other positions of the block delete switch.
    pub others: &'a [FlowResult],
}

impl FinishCx<'_> {
    /// Is the block reached with no position of the block delete switch, and is that certain?
    pub fn is_never_reached(&self, at: At) -> bool {
        let all = std::iter::once(self.result).chain(self.others);
        all.into_iter().all(|result| result.reach(at) == gcheck_engine::Reach::Never)
    }

    /// Bytes of a block of the main file.
    pub fn range_of(&self, at: At) -> Option<Range<u32>> {
        let file = self.program.file(at.file).filter(|_| at.file == 0)?;
        file.loaded.place(at.block, self.scene.dialect).map(|place| place.range())
    }
}

/// A rule at work.
struct Active {
    entry: &'static RuleEntry,
    severity: Option<Severity>,
    rule: Box<dyn PathRule>,
}

/// Calls the rules as the analysis goes.
pub(crate) struct Watchers<'a, 'c> {
    scene: Scene<'a>,
    program: &'a Program<'a>,
    model: &'a Model<'a>,
    survey: &'a Survey,
    rules: Vec<Active>,
    /// By bit of [`Watch`]: indices of the rules that watch it.
    lists: Lists,
    add: &'c mut dyn FnMut(Option<Severity>, Finding),
    /// Findings made already: a loop comes by many times.
    made: HashSet<(&'static str, u32, String)>,
    /// Something else than a move happened since the last cut.
    changed: bool,
    /// Blocks of the main file that were read, by number.
    read: FxHashMap<u32, Rc<ReadBlock>>,
    /// The block under way, when it was read.
    current: Option<Rc<ReadBlock>>,
}

/// By bit of [`Watch`]: indices of the rules that watch it.
pub(crate) type Lists = [Vec<usize>; 12];

/// Which rules watch what.
fn lists(rules: &[Active]) -> Lists {
    let mut lists = Lists::default();
    for (index, active) in rules.iter().enumerate() {
        let Run::Path { watch, .. } = active.entry.run else { continue };
        for (bit, list) in lists.iter_mut().enumerate() {
            if watch.bits() & (1 << bit) != 0 {
                list.push(index);
            }
        }
    }
    lists
}

/// Blocks that are kept read.
const MOST_READ: usize = 4096;

impl<'a, 'c> Watchers<'a, 'c> {
    pub(crate) fn new(
        scene: Scene<'a>,
        program: &'a Program<'a>,
        model: &'a Model<'a>,
        survey: &'a Survey,
        rules: &[(&'static RuleEntry, Option<Severity>)],
        add: &'c mut dyn FnMut(Option<Severity>, Finding),
    ) -> Self {
        let uses = Uses::new(scene, survey);
        let mut active = Vec::new();
        for (entry, severity) in rules {
            let Run::Path { make, .. } = entry.run else { continue };
            let rule = make();
            if rule.concerns(&uses) {
                active.push(Active { entry, severity: *severity, rule });
            }
        }
        let lists = lists(&active);
        Self {
            scene,
            program,
            model,
            survey,
            rules: active,
            lists,
            add,
            made: HashSet::new(),
            changed: true,
            read: FxHashMap::default(),
            current: None,
        }
    }

    /// Makes the rules forget what they saw, for another analysis of the same program.
    pub(crate) fn restart(&mut self) {
        for active in &mut self.rules {
            if let Run::Path { make, .. } = active.entry.run {
                active.rule = make();
            }
        }
        self.lists = lists(&self.rules);
        self.changed = true;
    }

    /// Ids of the rules that have something to watch.
    pub(crate) fn active(&self) -> Vec<&'static str> {
        self.rules.iter().map(|active| active.entry.meta.id).collect()
    }

    /// Do all rules say what they remember?
    pub(crate) fn remembers_all(&mut self) -> bool {
        let knows = |active: &mut Active| !matches!(active.rule.memory(), Remembers::Unknown);
        self.rules.iter_mut().all(knows)
    }

    /// From here on findings are told that were made before.
    pub(crate) fn forget_made(&mut self) {
        self.made.clear();
    }

    /// What the rules remember.
    pub(crate) fn remember(&mut self, layout: &Layout) -> Kept {
        let mut naming = Naming { layout, bytes: Vec::new() };
        let memories = self.rules.iter_mut().map(|active| match active.rule.memory() {
            Remembers::All(memory) => {
                let mut memory = memory.copy();
                memory.visit(&mut naming);
                Some(memory)
            }
            Remembers::Nothing | Remembers::Unknown => None,
        });
        let memories = memories.collect();
        Kept { memories, bytes: naming.bytes, lists: self.lists.clone(), changed: self.changed }
    }

    /// Makes the rules remember what they did there. `false` when it speaks of text that is not there any more.
    pub(crate) fn recall(&mut self, kept: &Kept, layout: &Layout) -> bool {
        let mut finding = Refinding { layout, bytes: kept.bytes.iter(), all: true };
        for (active, memory) in self.rules.iter_mut().zip(&kept.memories) {
            if let (Some(memory), Remembers::All(own)) = (memory, active.rule.memory()) {
                let mut memory = memory.copy();
                memory.visit(&mut finding);
                own.recall(&*memory);
            }
        }
        self.lists.clone_from(&kept.lists);
        self.changed = kept.changed;
        finding.all
    }

    /// All paths were seen.
    pub(crate) fn finish(&mut self, result: &FlowResult, others: &[FlowResult]) {
        let cx = FinishCx {
            scene: self.scene,
            program: self.program,
            model: self.model,
            survey: self.survey,
            result,
            others,
        };
        self.each(Watch::FINISH, &Cell::new(false), |rule, report| rule.finish(&cx, report));
    }

    fn each(
        &mut self,
        watch: Watch,
        had_enough: &Cell<bool>,
        mut call: impl FnMut(&mut dyn PathRule, &mut Report<'_>),
    ) {
        let bit = watch.bits().trailing_zeros() as usize;
        let Some(list) = self.lists.get_mut(bit) else { return };
        let mut next = 0;
        while let Some(index) = list.get(next) {
            let Some(active) = self.rules.get_mut(*index) else { return };
            let (made, add, severity) = (&mut self.made, &mut self.add, active.severity);
            let mut once = |finding: Finding| {
                if made.insert((finding.rule.id, finding.range.start, finding.message.clone())) {
                    add(severity, finding);
                }
            };
            call(&mut *active.rule, &mut Report { add: &mut once });
            if had_enough.take() {
                list.remove(next);
            } else {
                next += 1;
            }
        }
    }

    fn read_block(&mut self, at: At) -> Option<Rc<ReadBlock>> {
        if let Some(read) = self.read.get(&at.block) {
            return Some(Rc::clone(read));
        }
        let file = self.program.file(at.file)?;
        let place = file.loaded.place(at.block, self.scene.dialect)?;
        let words = place.table.words(place.block()).iter();
        let codes: Vec<CodeIx> = words.map(|word| word.code).filter(|code| code.is_some()).collect();
        let effects: Vec<Effect> = codes.iter().map(|code| self.model.effect(*code)).collect();
        let is_motion = |effect: &Effect| {
            matches!(
                effect,
                Effect::Rapid | Effect::Linear | Effect::ArcClockwise | Effect::ArcCounterClockwise
            )
        };
        let letters = place.block().letters;
        let is_eventful = letters.intersects(LetterSet::of("THD"))
            || !effects.iter().all(is_motion)
            || effects.is_empty() && letters.intersects(LetterSet::of("FS"));
        let expressions = expressions(&place);
        let read = Rc::new(ReadBlock { at, place, codes, effects, expressions, is_eventful });
        if self.read.len() >= MOST_READ {
            self.read.clear();
        }
        self.read.insert(at.block, Rc::clone(&read));
        Some(read)
    }

    fn watches(&self, watch: Watch) -> bool {
        let bit = watch.bits().trailing_zeros() as usize;
        self.lists.get(bit).is_some_and(|list| !list.is_empty())
    }

    fn show(
        &mut self,
        watch: Watch,
        flow: &FlowCx<'_>,
        mut call: impl FnMut(&mut dyn PathRule, &PathCx<'_>, &mut Report<'_>),
    ) {
        // Blocks of other files are judged when those files are checked.
        if flow.origin.at.file != 0 || !self.watches(watch) {
            return;
        }
        let (scene, program, model, survey) = (self.scene, self.program, self.model, self.survey);
        let read = self.current.take();
        let had_enough = Cell::new(false);
        let cx =
            PathCx { scene, program, model, survey, flow, read: read.as_deref(), had_enough: &had_enough };
        self.each(watch, &had_enough, |rule, report| call(rule, &cx, report));
        self.current = read;
    }
}

/// Blocks that [`PathRule::block`] may be called for.
fn is_read(origin: Origin) -> bool {
    use gcheck_program::BlockFlags as F;
    const LETTERS: LetterSet = LetterSet::of("FSTHD");
    origin.flags.intersects(F::CODE | F::STATEMENT | F::EXPRESSION) || origin.letters.intersects(LETTERS)
}

impl FlowObserver for Watchers<'_, '_> {
    fn before(&mut self, cx: &FlowCx<'_>) {
        self.current = None;
        if cx.origin.at.file == 0 && is_read(cx.origin) {
            self.current = self.read_block(cx.origin.at);
            if self.current.as_ref().is_some_and(|read| read.is_eventful) {
                self.show(Watch::BLOCKS, cx, |rule, cx, report| rule.block(cx, report));
            }
            self.show(Watch::ALL_BLOCKS, cx, |rule, cx, report| rule.block(cx, report));
        }
    }

    fn event(&mut self, cx: &FlowCx<'_>, event: &Event) {
        let (moves, cuts) = match event {
            Event::Travel(travel) => (true, travel.kind != TravelKind::Rapid),
            Event::Arc(_) | Event::Curve(_) => (true, true),
            _ => (false, false),
        };
        // Operations that pass their points exactly say so at each of them; no rule asks for it.
        if matches!(event, Event::PathMode(_)) {
            return;
        }
        if !moves {
            self.changed = true;
            self.show(Watch::CHANGES, cx, |rule, cx, report| rule.changed(cx, event, report));
            return;
        }
        self.show(Watch::MOVES, cx, |rule, cx, report| rule.moved(cx, event, report));
        if matches!(event, Event::Arc(_)) {
            self.show(Watch::ARCS, cx, |rule, cx, report| rule.moved(cx, event, report));
        }
        if !cuts {
            self.show(Watch::RAPIDS, cx, |rule, cx, report| rule.rapid(cx, event, report));
        } else if self.changed && cx.origin.at.file == 0 {
            self.changed = false;
            self.show(Watch::CUTS, cx, |rule, cx, report| rule.cut(cx, event, report));
        }
    }

    fn vacant_read(&mut self, cx: &FlowCx<'_>, variable: u32) {
        self.show(Watch::READS, cx, |rule, cx, report| rule.vacant_read(cx, variable, report));
    }

    fn fault(&mut self, cx: &FlowCx<'_>, fault: &Fault) {
        self.show(Watch::FAULTS, cx, |rule, cx, report| rule.fault(cx, fault, report));
    }

    fn ended(&mut self, cx: &FlowCx<'_>, ending: Ending) {
        self.changed = true;
        self.show(Watch::ENDS, cx, |rule, cx, report| rule.ended(cx, ending, report));
    }

    fn endless(&mut self, cx: &FlowCx<'_>, head: At) {
        self.show(Watch::ENDLESS, cx, |rule, cx, report| rule.endless(cx, head, report));
    }
}

/// The engine's view of the programs that the scene knows.
pub(crate) struct SceneLibrary<'a>(pub(crate) &'a dyn crate::Programs);

impl Library for SceneLibrary<'_> {
    fn by_number(&self, number: u32) -> Option<SourceFile> {
        self.0.source_of_number(number)
    }

    fn by_name(&self, name: &str) -> Option<SourceFile> {
        self.0.source_of_name(name)
    }
}

/// What the verdicts of a file rest on.
pub type Ledger = std::collections::BTreeSet<Assumption>;

#[cfg(test)]
mod tests {
    use gcheck_engine::{ArcFault, CompensationFault, CycleFault, Fault, ValueFault};

    use crate::testing::{World, findings};
    use crate::{Selection, by_id};

    /// The rules that speak of a fault, or why none does.
    enum Said {
        By(&'static [&'static str]),
        Nobody(&'static str),
    }

    /// Without a wildcard, so that a new fault needs a line here.
    fn said(fault: &Fault) -> Said {
        use Said::{By, Nobody};
        match fault {
            Fault::Value(fault) => match fault {
                ValueFault::DivisionByZero
                | ValueFault::NegativeRoot
                | ValueFault::LogarithmOfNonPositive
                | ValueFault::ArcFunctionRange
                | ValueFault::NegativePower
                | ValueFault::NotFinite => By(&["expression-without-value"]),
                ValueFault::Malformed => By(&["missing-operand", "expression-too-deep", "stray-bracket"]),
                ValueFault::NoSuchFunction => By(&["function-unknown"]),
            },
            Fault::Undecidable => Nobody("what nobody told us is no mistake of the program"),
            Fault::UnsetParameter => By(&["named-parameter-unset"]),
            Fault::ReadOnlyVariable(_) => {
                By(&["assignment-to-read-only-variable", "computed-variable-read-only"])
            }
            Fault::VariableNumber => By(&["variable-number-not-whole"]),
            Fault::MissingValue(_) => By(&["address-without-value"]),
            Fault::MissingWord(_) => {
                By(&["required-word-missing", "word-choice-missing", "thread-without-lead"])
            }
            Fault::WordRange(_) => By(&[
                "number-out-of-range",
                "sign-not-accepted",
                "decimal-point-on-integer",
                "computed-value-out-of-range",
            ]),
            Fault::UnknownCode => By(&["unknown-code"]),
            Fault::NotNow(..) => By(&["cycle-in-inverse-time", "codes-conflict"]),
            Fault::Malformed => By(&["unexpected-text", "unclosed-bracket", "malformed-number"]),
            Fault::Conflict => By(&[
                "codes-conflict",
                "two-codes-of-one-group",
                "words-exclude-each-other",
                "machine-coordinates-in-increments",
            ]),
            Fault::WordTwice(_) => By(&["word-given-twice", "code-given-twice"]),
            Fault::UnreadWord(_) => By(&["word-not-read", "word-forbidden"]),
            Fault::Misplaced(_) => Nobody("the order of numbers in a block matters to one interpreter only"),
            Fault::TooManyCodes => By(&["too-many-m-codes"]),
            Fault::LineTooLong => By(&["line-too-long"]),
            Fault::TooFewPoints => Nobody("splines are one interpreter's own"),
            Fault::NoFeed => By(&["feed-missing", "feed-zero", "probe-without-feed"]),
            Fault::NoInverseTimeFeed => By(&["inverse-time-feed-missing"]),
            Fault::SpindleStopped => By(&["spindle-stopped-while-cutting"]),
            Fault::SpindleDirection => By(&["tap-in-wrong-direction"]),
            Fault::NoSuchAxis(_) => By(&["unknown-address"]),
            Fault::NoMotionMode => By(&["axis-words-without-motion-mode"]),
            Fault::NoAxisWords => By(&["motion-without-axis-words"]),
            Fault::Arc(fault) => match fault {
                ArcFault::NoCentre => By(&["arc-without-centre", "arc-mode-left-on"]),
                ArcFault::CentreAndRadius => By(&["arc-centre-and-radius"]),
                ArcFault::WrongPlane(_) => By(&["arc-wrong-plane-word"]),
                ArcFault::ZeroRadius => By(&["zero-radius-arc"]),
                ArcFault::RadiusTooSmall { .. } => By(&["arc-radius-too-small"]),
                ArcFault::OffCircle { .. } => By(&["arc-end-off-circle"]),
                ArcFault::FullCircleByRadius => By(&["full-circle-by-radius"]),
                ArcFault::Turns => By(&["arc-turns-not-whole"]),
            },
            Fault::Cycle(fault) => match fault {
                CycleFault::Missing(_) => {
                    By(&["cycle-word-missing", "cycle-words-lost", "cycle-dwell-missing"])
                }
                CycleFault::RBelowBottom => By(&["cycle-r-below-bottom"]),
                CycleFault::NotPositive(_) | CycleFault::ZeroRepeats => By(&["cycle-word-not-positive"]),
                CycleFault::Rotary => By(&["cycle-with-rotary-word"]),
                CycleFault::InverseTime => By(&["cycle-in-inverse-time"]),
                CycleFault::Compensated => By(&["cycle-under-compensation"]),
                CycleFault::Plane | CycleFault::Geometry => By(&["cycle-numbers-contradict"]),
                CycleFault::OutlineOpen(_) | CycleFault::OutlineEmpty => By(&["pocket-outline-open"]),
                CycleFault::StartOutside => By(&["pocket-start-outside"]),
            },
            Fault::Compensation(fault) => match fault {
                CompensationFault::EntryTooShort { .. } => By(&["lead-in-too-short"]),
                CompensationFault::EntryIsArc => By(&["compensation-on-in-arc"]),
                CompensationFault::ExitIsArc => By(&["compensation-off-in-arc"]),
                CompensationFault::Gouge => By(&["compensation-gouge"]),
                CompensationFault::Plane | CompensationFault::NotWhileOn | CompensationFault::AlreadyOn => {
                    By(&["refused-under-compensation"])
                }
            },
            Fault::NoSuchTool(_) => By(&["tool-not-in-table"]),
            Fault::NoToolSelected => By(&["tool-change-without-t"]),
            Fault::Probe => By(&["probe-move-refused"]),
            Fault::NoDwellTime => By(&["required-word-missing", "word-choice-missing"]),
            Fault::Profile => By(&["turning-profile-not-usable"]),
            Fault::OverTravel(_) => By(&["move-outside-travel"]),
            Fault::NoSavedModes => By(&["saved-modes-missing"]),
            Fault::NoSuchLabel(_) => By(&["jump-target-missing", "jump-to-missing-block"]),
            Fault::NoSuchProgram => By(&["subprogram-missing", "o-word-subroutine-missing"]),
            Fault::TooDeep => By(&["calls-nested-too-deep"]),
            Fault::LoopMismatch => {
                By(&["loop-end-missing", "loop-begin-missing", "crossed-loops", "o-word-unmatched"])
            }
            Fault::StrayReturn => By(&["return-outside-subroutine", "o-word-unmatched"]),
            Fault::NoProgramEnd => By(&["subprogram-without-return", "program-end-missing"]),
            Fault::Alarm(_) => By(&["alarm-reached"]),
        }
    }

    /// One of each, those with details apart.
    fn plain_faults() -> Vec<Fault> {
        let letter = gcheck_controls::Letter::of('X');
        let code = gcheck_controls::CodeIx::NONE;
        vec![
            Fault::Undecidable,
            Fault::UnsetParameter,
            Fault::ReadOnlyVariable(0),
            Fault::VariableNumber,
            Fault::MissingValue(letter),
            Fault::MissingWord(letter),
            Fault::WordRange(letter),
            Fault::UnknownCode,
            Fault::NotNow(code, None),
            Fault::Malformed,
            Fault::Conflict,
            Fault::WordTwice(letter),
            Fault::UnreadWord(letter),
            Fault::Misplaced(letter),
            Fault::TooManyCodes,
            Fault::LineTooLong,
            Fault::TooFewPoints,
            Fault::NoFeed,
            Fault::NoInverseTimeFeed,
            Fault::SpindleStopped,
            Fault::SpindleDirection,
            Fault::NoSuchAxis(letter),
            Fault::NoMotionMode,
            Fault::NoAxisWords,
            Fault::NoSuchTool(1),
            Fault::NoToolSelected,
            Fault::Probe,
            Fault::NoDwellTime,
            Fault::Profile,
            Fault::OverTravel(letter),
            Fault::NoSavedModes,
            Fault::NoSuchLabel(1),
            Fault::NoSuchProgram,
            Fault::TooDeep,
            Fault::LoopMismatch,
            Fault::StrayReturn,
            Fault::NoProgramEnd,
            Fault::Alarm(1),
        ]
    }

    fn detailed_faults() -> Vec<Fault> {
        let letter = gcheck_controls::Letter::of('X');
        let mut faults = Vec::new();
        faults.extend(
            [
                ValueFault::DivisionByZero,
                ValueFault::NegativeRoot,
                ValueFault::LogarithmOfNonPositive,
                ValueFault::ArcFunctionRange,
                ValueFault::NegativePower,
                ValueFault::NotFinite,
                ValueFault::Malformed,
                ValueFault::NoSuchFunction,
            ]
            .map(Fault::Value),
        );
        faults.extend(
            [
                ArcFault::NoCentre,
                ArcFault::CentreAndRadius,
                ArcFault::WrongPlane(letter),
                ArcFault::ZeroRadius,
                ArcFault::RadiusTooSmall { half_chord: 2.0, radius: 1.0 },
                ArcFault::OffCircle { start: 1.0, end: 2.0 },
                ArcFault::FullCircleByRadius,
                ArcFault::Turns,
            ]
            .map(Fault::Arc),
        );
        faults.extend(
            [
                CycleFault::Missing(letter),
                CycleFault::RBelowBottom,
                CycleFault::NotPositive(letter),
                CycleFault::ZeroRepeats,
                CycleFault::Rotary,
                CycleFault::InverseTime,
                CycleFault::Compensated,
                CycleFault::Plane,
                CycleFault::Geometry,
                CycleFault::OutlineOpen(1.0),
                CycleFault::OutlineEmpty,
                CycleFault::StartOutside,
            ]
            .map(Fault::Cycle),
        );
        faults.extend(
            [
                CompensationFault::EntryTooShort { needed: 2.0, got: 1.0 },
                CompensationFault::EntryIsArc,
                CompensationFault::ExitIsArc,
                CompensationFault::Gouge,
                CompensationFault::Plane,
                CompensationFault::NotWhileOn,
                CompensationFault::AlreadyOn,
            ]
            .map(Fault::Compensation),
        );
        faults
    }

    #[test]
    fn every_fault_is_spoken_for_by_rules_that_exist() {
        let faults: Vec<Fault> = plain_faults().into_iter().chain(detailed_faults()).collect();
        let mut wrong = Vec::new();
        for fault in &faults {
            match said(fault) {
                Said::By(rules) => {
                    wrong.extend(
                        rules.iter().filter(|id| by_id(id).is_none()).map(|id| format!("{fault:?}: {id}")),
                    );
                    assert!(!rules.is_empty(), "{fault:?}");
                }
                Said::Nobody(why) => assert!(!why.is_empty(), "{fault:?}"),
            }
        }
        assert!(wrong.is_empty(), "rules that do not exist: {wrong:#?}");
    }

    /// Programs that raise a fault, each with the words that the table above promises.
    #[test]
    fn a_program_that_cannot_be_executed_has_a_finding() {
        let programs: &[(&str, &str, Fault)] = &[
            ("fanuc-mill", "O1\n#2=1/0\nM30\n", Fault::Value(ValueFault::DivisionByZero)),
            ("linuxcnc", "G21\nG0 X#<width>\nM2\n", Fault::UnsetParameter),
            ("fanuc-mill", "O1\n#0=1\nM30\n", Fault::ReadOnlyVariable(0)),
            ("fanuc-mill", "O1\n#1=#[1.5]\nM30\n", Fault::VariableNumber),
            ("fanuc-mill", "O1\nG0 X\nM30\n", Fault::MissingValue(gcheck_controls::Letter::of('X'))),
            ("fanuc-mill", "O1\nM98\nM30\n", Fault::MissingWord(gcheck_controls::Letter::of('P'))),
            ("linuxcnc", "G21\nM3 S-5\nM2\n", Fault::WordRange(gcheck_controls::Letter::of('S'))),
            ("fanuc-mill", "O1\nG999\nM30\n", Fault::UnknownCode),
            ("linuxcnc", "G0 G1 X1 F10\nM2\n", Fault::Conflict),
            ("linuxcnc", "G21 G91\nG53 G0 X1\nM2\n", Fault::Conflict),
            ("linuxcnc", "G21\nG1 X1\nM2\n", Fault::NoFeed),
            ("linuxcnc", "G21 G90 F9 G0 X0 Y0 Z9\nM4 S9\nG84 Z1 R5\nM2\n", Fault::SpindleDirection),
            ("linuxcnc", "G21 G93\nG1 X1\nM2\n", Fault::NoInverseTimeFeed),
            ("linuxcnc", "G21\nX1\nM2\n", Fault::NoMotionMode),
            (
                "linuxcnc",
                "G21 F100 G90 G0 X0 Y0\nG2 X10 Y0 R1\nM2\n",
                Fault::Arc(ArcFault::RadiusTooSmall { half_chord: 5.0, radius: 1.0 }),
            ),
            (
                "linuxcnc",
                "G21 F100 G90 G0 X0 Y0 Z5\nG81 X1 Y1 Z2 R1\nM2\n",
                Fault::Cycle(CycleFault::RBelowBottom),
            ),
            (
                "linuxcnc",
                "G21 G90 F100\nG41.1 D6 G1 X10\nG1 Y10\nG28\nM2\n",
                Fault::Compensation(CompensationFault::NotWhileOn),
            ),
            ("linuxcnc", "M72\nM2\n", Fault::NoSavedModes),
            ("fanuc-mill", "O1\nGOTO 50\nM30\n", Fault::NoSuchLabel(50)),
            ("linuxcnc", "o7 call\nM2\n", Fault::NoSuchProgram),
            ("fanuc-mill", "O1\nM98 P2\nM30\nO2\nM98 P2\nM99\n", Fault::TooDeep),
            ("fanuc-mill", "O1\nEND1\nM30\n", Fault::LoopMismatch),
            ("linuxcnc", "o1 return\nM2\n", Fault::StrayReturn),
            ("haas-mill", "M97 P10\nM30\nN10 G0 X1.\n", Fault::NoProgramEnd),
        ];
        let mut silent = Vec::new();
        for (control, program, fault) in programs {
            let Said::By(rules) = said(fault) else { continue };
            let found = findings(&Selection::default(), control, program, &World::default());
            if !found.iter().any(|finding| rules.contains(&finding.rule.id)) {
                let ids: Vec<_> = found.iter().map(|finding| finding.rule.id).collect();
                silent.push(format!("{control} {program:?}: {fault:?} is told by {ids:?}, not by {rules:?}"));
            }
        }
        assert!(silent.is_empty(), "{silent:#?}");
    }
}
