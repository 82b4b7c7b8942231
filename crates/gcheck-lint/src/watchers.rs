//! Calls the rules of the path tier while all paths of a program are analysed.
//!
//! Knows: how what the engine shows becomes calls of rules. Must not know: any rule, how paths are found, how memories are
//! kept.

use std::cell::Cell;
use std::collections::HashSet;
use std::rc::Rc;

use gcheck_controls::LetterSet;
use gcheck_diagnostics::{Finding, Severity};
use gcheck_engine::{
    At, Ending, Event, Fault, FlowCx, FlowObserver, FlowResult, Model, Origin, Program, TravelKind,
};
use gcheck_program::{BlockFlags, FileIndex};
use rustc_hash::FxHashMap;

use crate::block_delete::{self, Key};
use crate::containment;
use crate::evaluated::Evaluated;
use crate::path_context::ReadBlock;
use crate::shared_memory::{SharedMemories, SharedMemory};
use crate::text_memo::TextMemo;
use crate::{Environment, FinishCx, FollowedCx, PathCx, PathRule, Remembers, Report, RuleEntry, Uses, Watch};

/// A rule that watches.
struct Active {
    entry: &'static RuleEntry,
    severity: Option<Severity>,
    watch: Watch,
    rule: Box<dyn PathRule>,
}

/// What the findings of an analysis hold for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scope {
    /// All paths, or some, as the rule says.
    All,
    /// Runs that skip blocks with `/`; another analysis executes them.
    Skipping,
    /// Runs of one case: they take one way of a condition, or a program that is not here leaves what the file sets.
    OneWay,
}

/// Calls the rules as the analysis goes.
pub(crate) struct Watchers<'a, 'c> {
    environment: Environment<'a>,
    program: &'a Program<'a>,
    model: &'a Model<'a>,
    file_index: &'a FileIndex,
    rules: Vec<Active>,
    shared: SharedMemories,
    memo: Rc<TextMemo>,
    /// By bit of [`Watch`]: indices of the rules that watch it.
    lists: Lists,
    add: &'c mut dyn FnMut(Option<Severity>, Finding),
    /// Findings made already: a loop comes by many times.
    made: HashSet<Key>,
    /// Of those, what this analysis made again.
    again: HashSet<Key>,
    /// Something other than a move happened since the last cut.
    changed: bool,
    /// What findings hold for.
    scope: Scope,
    /// Blocks of the main file that were read, by number.
    read: FxHashMap<u32, Rc<ReadBlock>>,
    /// The block that is being executed, if it was read.
    current: Option<Rc<ReadBlock>>,
    /// The addresses of the block under way where some stand beside empty variables: those that are left.
    letters: Option<(At, LetterSet)>,
    /// The file holds what others call, and no main program.
    is_called_only: bool,
}

/// By bit of [`Watch`]: indices of the rules that watch it.
type Lists = [Vec<usize>; Watch::all().bits().count_ones() as usize];

/// How far the rules have come, beside what each remembers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Progress {
    lists: Lists,
    changed: bool,
}

/// Which rules watch what.
fn lists(rules: &[Active]) -> Lists {
    let mut lists = Lists::default();
    for (index, active) in rules.iter().enumerate() {
        let watch = active.watch;
        for (bit, list) in lists.iter_mut().enumerate() {
            if watch.bits() & (1 << bit) != 0 {
                list.push(index);
            }
        }
    }
    lists
}

/// In the place of a rule that has had enough.
const LEFT: usize = usize::MAX;
/// Blocks whose words are kept.
const MAX_READ: usize = 4096;

impl<'a, 'c> Watchers<'a, 'c> {
    pub(crate) fn new(
        environment: Environment<'a>,
        program: &'a Program<'a>,
        model: &'a Model<'a>,
        file_index: &'a FileIndex,
        rules: &[(&'static RuleEntry, Option<Severity>)],
        add: &'c mut dyn FnMut(Option<Severity>, Finding),
    ) -> Self {
        let uses = Uses::new(environment, file_index);
        let mut active = Vec::new();
        let mut shared = SharedMemories::default();
        for (entry, severity) in rules {
            let Some((watch, rule)) = entry.run.watcher() else { continue };
            if containment::call(entry.meta, || rule.concerns(&uses)) {
                if let Some(make) = rule.shares() {
                    shared.add(make);
                }
                active.push(Active { entry, severity: *severity, watch, rule });
            }
        }
        let lists = lists(&active);
        Self {
            environment,
            program,
            model,
            file_index,
            rules: active,
            shared,
            memo: Rc::default(),
            lists,
            add,
            made: HashSet::new(),
            again: HashSet::new(),
            changed: true,
            scope: Scope::All,
            read: FxHashMap::default(),
            current: None,
            letters: None,
            is_called_only: uses.is_called_only(),
        }
    }

    /// Makes the rules forget what they saw, for another analysis of the same program.
    pub(crate) fn restart(&mut self, scope: Scope) {
        self.scope = scope;
        for active in &mut self.rules {
            if let Some((_, rule)) = active.entry.run.watcher() {
                active.rule = rule;
            }
        }
        self.shared.restart();
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

    /// What was found so far.
    pub(crate) fn made(&self) -> impl Iterator<Item = Key> {
        self.made.iter().cloned()
    }

    /// What an analysis that skips blocks found of what was found before.
    pub(crate) fn take_again(&mut self) -> HashSet<Key> {
        std::mem::take(&mut self.again)
    }

    /// These were made before.
    pub(crate) fn note_made(&mut self, keys: HashSet<Key>) {
        self.made.extend(keys);
    }

    /// From here on findings are added that were made before.
    pub(crate) fn forget_made(&mut self) {
        self.made.clear();
    }

    /// What each rule remembers, then what they remember together.
    pub(crate) fn memories(&mut self) -> impl Iterator<Item = Remembers<'_>> {
        let own = self.rules.iter_mut().map(|active| active.rule.memory());
        own.chain(self.shared.iter_mut().map(|shared| Remembers::All(shared)))
    }

    /// What beside the memories of rules decides what they are shown next.
    pub(crate) fn progress(&self) -> Progress {
        Progress { lists: self.lists.clone(), changed: self.changed }
    }

    /// Goes on as from there.
    pub(crate) fn set_progress(&mut self, progress: &Progress) {
        self.lists.clone_from(&progress.lists);
        self.changed = progress.changed;
    }

    /// All paths were seen with one position of the block delete switch.
    pub(crate) fn followed(&mut self) {
        let cx = FollowedCx { environment: self.environment, model: self.model, file_index: self.file_index };
        let nothing = BlockFlags::empty();
        self.each(Watch::FOLLOWED, nothing, &Cell::new(false), |rule, report| rule.followed(&cx, report));
    }

    /// All paths were seen.
    pub(crate) fn finish(&mut self, result: &FlowResult, others: &[FlowResult]) {
        let cx = FinishCx {
            environment: self.environment,
            program: self.program,
            model: self.model,
            file_index: self.file_index,
            result,
            others,
        };
        let nothing = BlockFlags::empty();
        self.scope = Scope::All;
        self.each(Watch::FINISH, nothing, &Cell::new(false), |rule, report| rule.finish(&cx, report));
    }

    fn each(
        &mut self,
        watch: Watch,
        block: BlockFlags,
        had_enough: &Cell<bool>,
        mut call: impl FnMut(&mut dyn PathRule, &mut Report<'_>),
    ) {
        let bit = watch.bits().trailing_zeros() as usize;
        let Some(list) = self.lists.get_mut(bit) else { return };
        let (is_one_way, skips) = (self.scope == Scope::OneWay, self.scope == Scope::Skipping);
        let (made, again, add) = (&mut self.made, &mut self.again, &mut self.add);
        let severity = Cell::new(None);
        let mut once = |finding: Finding| {
            let key = block_delete::key(&finding);
            if skips && made.contains(&key) {
                again.insert(key);
            } else if made.insert(key) {
                add(severity.get(), block_delete::name_condition(finding, block, skips));
            }
        };
        let mut report = Report::new(&mut once);
        let mut calls = containment::Calls::default();
        let mut any_left = false;
        // Moves come by the million: this loop does nothing for a rule that it could do for all of them.
        for index in list.iter_mut() {
            let Some(active) = self.rules.get_mut(*index) else { continue };
            if is_one_way && !active.rule.counts_on_some_path() {
                continue;
            }
            severity.set(active.severity);
            calls.begin(active.entry.meta);
            call(&mut *active.rule, &mut report);
            if had_enough.take() {
                *index = LEFT;
                any_left = true;
            }
        }
        if any_left {
            list.retain(|index| *index != LEFT);
        }
    }

    fn read_block(&mut self, at: At) -> Option<Rc<ReadBlock>> {
        if let Some(read) = self.read.get(&at.block) {
            return Some(Rc::clone(read));
        }
        let read = Rc::new(ReadBlock::new(at, self.program, self.model, self.environment)?);
        if self.read.len() >= MAX_READ {
            self.read.clear();
        }
        self.read.insert(at.block, Rc::clone(&read));
        Some(read)
    }

    /// The addresses that a block has left, if that is the block under way.
    fn letters_of(&self, flow: &FlowCx<'_>) -> Option<LetterSet> {
        self.letters.filter(|(at, _)| *at == flow.origin.at).map(|(_, letters)| letters)
    }

    /// What a rule is shown of the block under way.
    fn context<'x>(
        &self,
        flow: &'x FlowCx<'x>,
        read: Option<&'x ReadBlock>,
        had_enough: &'x Cell<bool>,
        shared: &'x SharedMemories,
        memo: &'x TextMemo,
        evaluated: &'x Evaluated,
    ) -> PathCx<'x>
    where
        'a: 'x,
    {
        PathCx {
            environment: self.environment,
            program: self.program,
            model: self.model,
            file_index: self.file_index,
            flow,
            read,
            had_enough,
            shared,
            memo,
            evaluated,
            is_called_only: self.is_called_only,
            letters: self.letters_of(flow),
        }
    }

    /// Asks something about the block under way before a rule does.
    fn look<T>(&self, flow: &FlowCx<'_>, evaluated: &Evaluated, ask: impl FnOnce(&PathCx<'_>) -> T) -> T {
        let (had_enough, shared) = (Cell::new(false), SharedMemories::default());
        ask(&self.context(flow, self.current.as_deref(), &had_enough, &shared, &self.memo, evaluated))
    }

    /// Reads which codes the computed words of the block under way name: `G#1`.
    fn read_computed_codes(&mut self, flow: &FlowCx<'_>, evaluated: &Evaluated) {
        let Some(read) = self.current.as_ref().filter(|read| read.has_computed_code) else { return };
        let known = self.look(flow, evaluated, |cx| read.with_codes(cx.computed_words(), self.model));
        self.current = Some(Rc::new(known));
    }

    fn watches(&self, watch: Watch) -> bool {
        let bit = watch.bits().trailing_zeros() as usize;
        self.lists.get(bit).is_some_and(|list| !list.is_empty())
    }

    fn show(
        &mut self,
        watch: Watch,
        flow: &FlowCx<'_>,
        call: impl FnMut(&mut dyn PathRule, &PathCx<'_>, &mut Report<'_>),
    ) {
        self.show_evaluated(watch, flow, &Evaluated::default(), call);
    }

    fn show_evaluated(
        &mut self,
        watch: Watch,
        flow: &FlowCx<'_>,
        evaluated: &Evaluated,
        call: impl FnMut(&mut dyn PathRule, &PathCx<'_>, &mut Report<'_>),
    ) {
        // Blocks of other files are judged when those files are checked.
        if flow.origin.at.file == 0 {
            self.show_of_any_file(watch, flow, evaluated, call);
        }
    }

    fn show_of_any_file(
        &mut self,
        watch: Watch,
        flow: &FlowCx<'_>,
        evaluated: &Evaluated,
        mut call: impl FnMut(&mut dyn PathRule, &PathCx<'_>, &mut Report<'_>),
    ) {
        if !self.watches(watch) {
            return;
        }
        let read = self.current.take();
        // Rules ask the shared memories while they are called.
        let shared = std::mem::take(&mut self.shared);
        let (had_enough, memo) = (Cell::new(false), Rc::clone(&self.memo));
        let cx = self.context(flow, read.as_deref(), &had_enough, &shared, &memo, evaluated);
        self.each(watch, flow.origin.flags, &had_enough, |rule, report| call(rule, &cx, report));
        self.current = read;
        self.shared = shared;
    }

    /// Shows that the job ends in a program of another file.
    fn show_end_elsewhere(&mut self, flow: &FlowCx<'_>, ending: Ending) {
        if flow.origin.at.file != 0 {
            self.show_of_any_file(Watch::ENDS_ELSEWHERE, flow, &Evaluated::default(), |rule, cx, report| {
                rule.ended_elsewhere(cx, ending, report);
            });
        }
    }

    /// Shows a move to those that watch one of these kinds; then what rules remember together goes on.
    fn show_move(&mut self, kinds: &[Watch], flow: &FlowCx<'_>, event: &Event) {
        let read = self.current.take();
        let mut shared = std::mem::take(&mut self.shared);
        let (had_enough, memo) = (Cell::new(false), Rc::clone(&self.memo));
        let (none, evaluated) = (SharedMemories::default(), Evaluated::default());
        let alone = self.context(flow, read.as_deref(), &had_enough, &none, &memo, &evaluated);
        let cx = PathCx { shared: &shared, ..alone };
        let flags = flow.origin.flags;
        for kind in kinds {
            match *kind {
                Watch::RAPIDS => {
                    self.each(*kind, flags, &had_enough, |rule, report| rule.rapid(&cx, event, report));
                }
                Watch::CUTS => {
                    self.each(*kind, flags, &had_enough, |rule, report| rule.cut(&cx, event, report));
                }
                _ => self.each(*kind, flags, &had_enough, |rule, report| rule.moved(&cx, event, report)),
            }
        }
        for shared in shared.iter_mut() {
            shared.moved(&alone, event);
        }
        self.current = read;
        self.shared = shared;
    }

    /// What rules remember together goes on with what they were shown.
    fn remember(&mut self, flow: &FlowCx<'_>, mut call: impl FnMut(&mut dyn SharedMemory, &PathCx<'_>)) {
        if self.shared.is_empty() {
            return;
        }
        let mut shared = std::mem::take(&mut self.shared);
        let (none, had_enough, evaluated) =
            (SharedMemories::default(), Cell::new(false), Evaluated::default());
        let cx = self.context(flow, self.current.as_deref(), &had_enough, &none, &self.memo, &evaluated);
        for memory in shared.iter_mut() {
            call(memory, &cx);
        }
        self.shared = shared;
    }
}

/// Blocks that [`PathRule::block`] may be called for.
fn is_read(origin: Origin) -> bool {
    use gcheck_program::BlockFlags as F;
    const LETTERS: LetterSet = LetterSet::of("FSTHD");
    origin.flags.intersects(F::CODE | F::STATEMENT | F::EXPRESSION | F::UNREAD_WORD)
        || origin.letters.intersects(LETTERS)
}

/// The methods of an observer of all paths that shows its `watchers` what it is shown.
macro_rules! shows_to_watchers {
    () => {
        fn before(&mut self, cx: &::gcheck_engine::FlowCx<'_>) {
            self.watchers.before(cx);
        }

        fn event(&mut self, cx: &::gcheck_engine::FlowCx<'_>, event: &::gcheck_engine::Event) {
            self.watchers.event(cx, event);
        }

        fn vacant_read(&mut self, cx: &::gcheck_engine::FlowCx<'_>, variable: u32) {
            self.watchers.vacant_read(cx, variable);
        }

        fn after(&mut self, cx: &::gcheck_engine::FlowCx<'_>) {
            self.watchers.after(cx);
        }

        fn fault(&mut self, cx: &::gcheck_engine::FlowCx<'_>, fault: &::gcheck_engine::Fault) {
            self.watchers.fault(cx, fault);
        }

        fn ended(&mut self, cx: &::gcheck_engine::FlowCx<'_>, ending: ::gcheck_engine::Ending) {
            self.watchers.ended(cx, ending);
        }

        fn endless(&mut self, cx: &::gcheck_engine::FlowCx<'_>, head: ::gcheck_engine::At) {
            self.watchers.endless(cx, head);
        }
    };
}
pub(crate) use shows_to_watchers;

impl FlowObserver for Watchers<'_, '_> {
    fn before(&mut self, cx: &FlowCx<'_>) {
        self.current = None;
        self.letters = None;
        let is_row = cx.state.reads_as_row(cx.origin.flags);
        if cx.origin.at.file == 0 && is_read(cx.origin) && !is_row {
            let evaluated = Evaluated::default();
            self.current = self.read_block(cx.origin.at);
            self.read_computed_codes(cx, &evaluated);
            let is_eventful = self.current.as_ref().is_some_and(|read| read.is_eventful);
            let has_expression = cx.origin.flags.contains(BlockFlags::EXPRESSION);
            let of_values = if has_expression {
                self.look(cx, &evaluated, |cx| {
                    cx.block_of_values().map(|known| (known.has_others, known.block.letters))
                })
            } else {
                None
            };
            self.letters =
                of_values.filter(|(has_others, _)| *has_others).map(|(_, letters)| (cx.origin.at, letters));
            if is_eventful {
                self.show_evaluated(Watch::BLOCKS, cx, &evaluated, |rule, cx, report| rule.block(cx, report));
                self.remember(cx, |memory, cx| memory.block(cx));
            }
            let mut show =
                |watch| self.show_evaluated(watch, cx, &evaluated, |rule, cx, report| rule.block(cx, report));
            show(Watch::ALL_BLOCKS);
            if let Some((has_others, _)) = of_values {
                show(Watch::COMPUTED);
                if has_others {
                    show(Watch::COMPUTED_CODES);
                }
            }
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
            // A cut after a dwell is made as the one before it.
            self.changed |= !matches!(event, Event::Dwell(_));
            self.show(Watch::CHANGES, cx, |rule, cx, report| rule.changed(cx, event, report));
            self.remember(cx, |memory, cx| memory.changed(cx, event));
            return;
        }
        // Blocks of other files are judged when those files are checked; what they did counts for what comes after them.
        if cx.origin.at.file != 0 {
            for memory in self.shared.iter_mut() {
                memory.moved_elsewhere(event);
            }
            return;
        }
        let is_arc = matches!(event, Event::Arc(_));
        let is_first = self.changed;
        self.changed &= !cuts;
        let kinds: &[Watch] = match (cuts, is_first) {
            (false, _) => &[Watch::MOVES, Watch::RAPIDS],
            (true, false) if is_arc => &[Watch::MOVES, Watch::ARCS],
            (true, true) if is_arc => &[Watch::MOVES, Watch::ARCS, Watch::CUTS],
            (true, false) => &[Watch::MOVES],
            (true, true) => &[Watch::MOVES, Watch::CUTS],
        };
        self.show_move(kinds, cx, event);
    }

    fn vacant_read(&mut self, cx: &FlowCx<'_>, variable: u32) {
        self.show(Watch::READS, cx, |rule, cx, report| rule.vacant_read(cx, variable, report));
    }

    fn fault(&mut self, cx: &FlowCx<'_>, fault: &Fault) {
        self.show(Watch::FAULTS, cx, |rule, cx, report| rule.fault(cx, fault, report));
        if *fault == Fault::NoProgramEnd {
            self.show_end_elsewhere(cx, Ending::Text);
        }
    }

    fn ended(&mut self, cx: &FlowCx<'_>, ending: Ending) {
        self.changed = true;
        self.show(Watch::ENDS, cx, |rule, cx, report| rule.ended(cx, ending, report));
        self.show_end_elsewhere(cx, ending);
    }

    fn endless(&mut self, cx: &FlowCx<'_>, head: At) {
        self.show(Watch::ENDLESS, cx, |rule, cx, report| rule.endless(cx, head, report));
    }
}
