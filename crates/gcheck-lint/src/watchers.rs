//! Calls the rules of the path tier while all paths of a program are analysed.
//!
//! Knows: how what the engine shows becomes calls of rules. Must not know: any rule, how paths are found, how memories are
//! kept.

use std::cell::{Cell, RefCell};
use std::collections::HashSet;
use std::rc::Rc;

use gcheck_controls::LetterSet;
use gcheck_diagnostics::{Finding, Severity};
use gcheck_engine::{
    At, Ending, Event, Fault, FlowCx, FlowObserver, FlowResult, Look, Model, Program, TravelKind,
};
use gcheck_program::{BlockFlags, FileIndex};
use rustc_hash::FxHashMap;

use crate::block_delete::{self, Key};
use crate::containment;
use crate::evaluated::Evaluated;
use crate::path_context::{ReadBlock, Wish, Wishes, is_read};
use crate::shared_memory::{SharedMemories, SharedMemory};
use crate::text_memo::TextMemo;
use crate::{Environment, FinishCx, FollowedCx, PathCx, PathRule, Remembers, Report, RuleEntry, Uses, Watch};

/// A rule that watches.
struct Active {
    entry: &'static RuleEntry,
    severity: Option<Severity>,
    watch: Watch,
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
    callees: Callees<'c>,
    shared: SharedMemories,
    memo: TextMemo,
    look: RefCell<Look<'a, 'a>>,
    /// Something other than a move happened since the last cut.
    changed: bool,
    /// Blocks of the main file that were read, by number.
    read: FxHashMap<u32, Rc<ReadBlock>>,
    /// The block that is being executed, if it was read.
    current: Option<Rc<ReadBlock>>,
    /// The addresses of the block under way where some stand beside empty variables: those that are left.
    letters: Option<(At, LetterSet)>,
    /// The file holds what others call, and no main program.
    is_called_only: bool,
}

/// The rules that watch, and what becomes of their findings.
struct Callees<'c> {
    active: Vec<Active>,
    /// The rules themselves, in the same order.
    rules: Vec<Box<dyn PathRule>>,
    lists: Lists,
    /// The streak of like moves under way: which moves; empty when none is.
    streak: Watch,
    /// What rules were shown of it so far.
    shown: Watch,
    /// Of each kind in `shown`: the rules that do not rest.
    awake: Lists,
    add: &'c mut dyn FnMut(Option<Severity>, Finding),
    /// Findings made already: a loop comes by many times.
    made: HashSet<Key>,
    /// Of those, what this analysis made again.
    again: HashSet<Key>,
    /// What findings hold for.
    scope: Scope,
}

/// How many kinds of calls there are.
const LISTS: usize = Watch::all().bits().count_ones() as usize;
/// By bit of [`Watch`]: indices of the rules that watch it.
type Lists = [Vec<usize>; LISTS];

/// How far the rules have come, beside what each remembers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Progress {
    lists: Lists,
    changed: bool,
}

/// Which rules watch what.
fn lists(active: &[Active]) -> Lists {
    let mut lists = Lists::default();
    for (index, active) in active.iter().enumerate() {
        let watch = active.watch;
        for (bit, list) in lists.iter_mut().enumerate() {
            if watch.bits() & (1 << bit) != 0 {
                list.push(index);
            }
        }
    }
    lists
}

/// What a rule is shown of the block under way. A macro, so that the rules can be called while it borrows the rest.
macro_rules! context {
    ($watchers:ident, $flow:expr, $wishes:expr, $shared:expr, $evaluated:expr) => {
        PathCx {
            environment: $watchers.environment,
            program: $watchers.program,
            model: $watchers.model,
            file_index: $watchers.file_index,
            flow: $flow,
            read: $watchers.current.as_deref(),
            wishes: $wishes,
            shared: $shared,
            memo: &$watchers.memo,
            evaluate: &$watchers.look,
            evaluated: $evaluated,
            is_called_only: $watchers.is_called_only,
            // The addresses that the block has left, if that is the block under way.
            letters: $watchers.letters.filter(|(at, _)| *at == $flow.origin.at).map(|(_, letters)| letters),
        }
    };
}

/// The index of no rule.
const NONE: usize = usize::MAX;
/// Blocks whose words are kept.
const MAX_READ: usize = 4096;

impl Callees<'_> {
    /// Makes the rules forget what they saw.
    fn restart(&mut self, scope: Scope) {
        self.scope = scope;
        for (active, own) in self.active.iter().zip(&mut self.rules) {
            if let Some((_, rule)) = active.entry.run.watcher() {
                *own = rule;
            }
        }
        self.lists = lists(&self.active);
        self.end_streak();
    }

    /// A move like these comes: the streak goes on if its moves are like it.
    fn go_on(&mut self, like: Watch) {
        if self.streak != like {
            (self.streak, self.shown) = (like, Watch::empty());
        }
    }

    /// The streak of like moves ends: no rule rests any more.
    fn end_streak(&mut self) {
        (self.streak, self.shown) = (Watch::empty(), Watch::empty());
    }

    /// Does any rule watch this?
    fn any(&self, watch: Watch) -> bool {
        self.lists.get(bit(watch)).is_some_and(|list| !list.is_empty())
    }

    /// Calls each rule that watches this.
    fn each(
        &mut self,
        watch: Watch,
        block: BlockFlags,
        wishes: &Wishes,
        call: impl FnMut(&mut dyn PathRule, &mut Report<'_>),
    ) {
        let Some(list) = self.lists.get_mut(bit(watch)).filter(|list| !list.is_empty()) else { return };
        let mut list = std::mem::take(list);
        let left = self.call_all(&mut list, false, block, wishes, call);
        if let Some(own) = self.lists.get_mut(bit(watch)) {
            *own = list;
        }
        self.leave(watch, &left);
    }

    /// The same for a move of the streak under way: rules that rest are not called.
    fn each_in_streak(
        &mut self,
        watch: Watch,
        block: BlockFlags,
        wishes: &Wishes,
        call: impl FnMut(&mut dyn PathRule, &mut Report<'_>),
    ) {
        let (Some(all), Some(awake)) = (self.lists.get(bit(watch)), self.awake.get_mut(bit(watch))) else {
            return;
        };
        if !self.shown.contains(watch) {
            self.shown.insert(watch);
            awake.clone_from(all);
        }
        if awake.is_empty() {
            return;
        }
        let mut list = std::mem::take(awake);
        let left = self.call_all(&mut list, true, block, wishes, call);
        if let Some(awake) = self.awake.get_mut(bit(watch)) {
            *awake = list;
        }
        self.leave(watch, &left);
    }

    /// Calls the rules of a list, and removes those that wish for no more calls. In a streak that are those that rest, too. Gives
    /// those that have had enough for good.
    fn call_all(
        &mut self,
        list: &mut Vec<usize>,
        is_streak: bool,
        block: BlockFlags,
        wishes: &Wishes,
        mut call: impl FnMut(&mut dyn PathRule, &mut Report<'_>),
    ) -> Vec<usize> {
        let (is_one_way, skips) = (self.scope == Scope::OneWay, self.scope == Scope::Skipping);
        let (active, made, again, add) = (&self.active, &mut self.made, &mut self.again, &mut self.add);
        let called = Cell::new(NONE);
        let mut once = |finding: Finding| {
            let key = block_delete::key(&finding);
            if skips && made.contains(&key) {
                again.insert(key);
            } else if made.insert(key) {
                let severity = active.get(called.get()).and_then(|active| active.severity);
                add(severity, block_delete::name_condition(finding, block, skips));
            }
        };
        let mut report = Report::new(&mut once);
        let _blame = containment::Calls::new(|| active.get(called.get()).map(|active| active.entry.meta));
        let (mut left, mut any_left) = (Vec::new(), false);
        // Moves come by the million: this does nothing for a rule that it could do for all of them, or when it is needed.
        for index in list.iter_mut() {
            let Some(rule) = self.rules.get_mut(*index) else { continue };
            called.set(*index);
            if is_one_way && !rule.counts_on_some_path() {
                continue;
            }
            call(&mut **rule, &mut report);
            let wish = wishes.get();
            if wish != Wish::None {
                wishes.set(Wish::None);
                match wish {
                    Wish::Enough => left.push(*index),
                    _ if !is_streak => continue,
                    _ => {}
                }
                (*index, any_left) = (NONE, true);
            }
        }
        if any_left {
            list.retain(|index| *index != NONE);
        }
        left
    }

    /// These rules have had enough of this; of moves, of all kinds.
    fn leave(&mut self, watch: Watch, left: &[usize]) {
        if left.is_empty() {
            return;
        }
        let all = if Watch::MOVES.contains(watch) { Watch::MOVES } else { watch };
        for (bit, list) in self.lists.iter_mut().chain(&mut self.awake).enumerate() {
            if all.bits() & (1 << (bit % LISTS)) != 0 {
                list.retain(|index| !left.contains(index));
            }
        }
    }
}

/// The place of a kind of call among [`Lists`].
const fn bit(watch: Watch) -> usize {
    watch.bits().trailing_zeros() as usize
}

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
        let (mut active, mut watching) = (Vec::new(), Vec::new());
        let mut shared = SharedMemories::default();
        for (entry, severity) in rules {
            let Some((watch, rule)) = entry.run.watcher() else { continue };
            if containment::call(entry.meta, || rule.concerns(&uses)) {
                if let Some(make) = rule.shares() {
                    shared.add(make);
                }
                active.push(Active { entry, severity: *severity, watch });
                watching.push(rule);
            }
        }
        let callees = Callees {
            lists: lists(&active),
            active,
            rules: watching,
            streak: Watch::empty(),
            shown: Watch::empty(),
            awake: Lists::default(),
            add,
            made: HashSet::new(),
            again: HashSet::new(),
            scope: Scope::All,
        };
        Self {
            environment,
            program,
            model,
            file_index,
            callees,
            shared,
            memo: TextMemo::default(),
            look: RefCell::new(Look::new(program, model, &environment.machine.engine)),
            changed: true,
            read: FxHashMap::default(),
            current: None,
            letters: None,
            is_called_only: uses.is_called_only(),
        }
    }

    /// Makes the rules forget what they saw, for another analysis of the same program.
    pub(crate) fn restart(&mut self, scope: Scope) {
        self.callees.restart(scope);
        self.shared.restart();
        self.changed = true;
    }

    /// Ids of the rules that have something to watch.
    pub(crate) fn active(&self) -> Vec<&'static str> {
        self.callees.active.iter().map(|active| active.entry.meta.id).collect()
    }

    /// Do all rules say what they remember?
    pub(crate) fn remembers_all(&mut self) -> bool {
        let knows = |rule: &mut Box<dyn PathRule>| !matches!(rule.memory(), Remembers::Unknown);
        self.callees.rules.iter_mut().all(knows)
    }

    /// What was found so far.
    pub(crate) fn made(&self) -> impl Iterator<Item = Key> {
        self.callees.made.iter().cloned()
    }

    /// What an analysis that skips blocks found of what was found before.
    pub(crate) fn take_again(&mut self) -> HashSet<Key> {
        std::mem::take(&mut self.callees.again)
    }

    /// These were made before.
    pub(crate) fn note_made(&mut self, keys: HashSet<Key>) {
        self.callees.made.extend(keys);
    }

    /// From here on findings are added that were made before.
    pub(crate) fn forget_made(&mut self) {
        self.callees.made.clear();
    }

    /// What each rule remembers, then what they remember together.
    pub(crate) fn memories(&mut self) -> impl Iterator<Item = Remembers<'_>> {
        let own = self.callees.rules.iter_mut().map(|rule| rule.memory());
        own.chain(self.shared.iter_mut().map(|shared| Remembers::All(shared)))
    }

    /// What beside the memories of rules decides what they are shown next.
    pub(crate) fn progress(&mut self) -> Progress {
        // A streak begins where an analysis may go on.
        self.callees.end_streak();
        Progress { lists: self.callees.lists.clone(), changed: self.changed }
    }

    /// Goes on as from there.
    pub(crate) fn set_progress(&mut self, progress: &Progress) {
        self.callees.lists.clone_from(&progress.lists);
        self.callees.end_streak();
        self.changed = progress.changed;
    }

    /// All paths were seen with one position of the block delete switch.
    pub(crate) fn followed(&mut self) {
        let cx = FollowedCx { environment: self.environment, model: self.model, file_index: self.file_index };
        let nothing = BlockFlags::empty();
        let followed = |rule: &mut dyn PathRule, report: &mut Report<'_>| rule.followed(&cx, report);
        self.callees.each(Watch::FOLLOWED, nothing, &Wishes::default(), followed);
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
        self.callees.scope = Scope::All;
        let finish = |rule: &mut dyn PathRule, report: &mut Report<'_>| rule.finish(&cx, report);
        self.callees.each(Watch::FINISH, nothing, &Wishes::default(), finish);
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

    /// Asks something about the block under way before a rule does.
    fn look<T>(&self, flow: &FlowCx<'_>, evaluated: &Evaluated, ask: impl FnOnce(&PathCx<'_>) -> T) -> T {
        let (wishes, shared) = (Wishes::default(), SharedMemories::default());
        ask(&context!(self, flow, &wishes, &shared, evaluated))
    }

    /// Reads which codes the computed words of the block under way name: `G#1`.
    fn read_computed_codes(&mut self, flow: &FlowCx<'_>, evaluated: &Evaluated) {
        let Some(read) = self.current.as_ref().filter(|read| read.has_computed_code) else { return };
        let known = self.look(flow, evaluated, |cx| read.with_codes(cx.computed_words(), self.model));
        self.current = Some(Rc::new(known));
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
        if !self.callees.any(watch) {
            return;
        }
        let wishes = Wishes::default();
        let cx = context!(self, flow, &wishes, &self.shared, evaluated);
        self.callees.each(watch, flow.origin.flags, &wishes, |rule, report| call(rule, &cx, report));
    }

    /// Shows that the job ends in a program of another file.
    fn show_end_elsewhere(&mut self, flow: &FlowCx<'_>, ending: Ending) {
        if flow.origin.at.file != 0 {
            self.show_of_any_file(Watch::ENDS_ELSEWHERE, flow, &Evaluated::default(), |rule, cx, report| {
                rule.ended_elsewhere(cx, ending, report);
            });
        }
    }

    /// Shows a move of a kind to those that watch it; then what rules remember together goes on.
    fn show_move(&mut self, kind: Watch, is_first_cut: bool, flow: &FlowCx<'_>, event: &Event) {
        let (wishes, evaluated) = (Wishes::default(), Evaluated::default());
        // What rules remember together sees the move after them, and asks no other memory.
        let none = SharedMemories::default();
        let alone = context!(self, flow, &wishes, &none, &evaluated);
        let cx = PathCx { shared: &self.shared, ..alone };
        let (flags, callees) = (flow.origin.flags, &mut self.callees);
        callees.go_on(if Watch::STROKES.contains(kind) { Watch::STROKES } else { kind });
        callees.each_in_streak(kind, flags, &wishes, |rule, report| rule.moved(&cx, event, report));
        if is_rapid(kind) {
            callees
                .each_in_streak(Watch::RAPIDS, flags, &wishes, |rule, report| rule.rapid(&cx, event, report));
        }
        if is_first_cut {
            callees.each(Watch::CUTS, flags, &wishes, |rule, report| rule.cut(&cx, event, report));
        }
        for memory in self.shared.iter_mut() {
            memory.moved(&alone, event);
        }
    }

    /// What rules remember together goes on with what they were shown.
    fn remember(
        &mut self,
        flow: &FlowCx<'_>,
        evaluated: &Evaluated,
        mut call: impl FnMut(&mut dyn SharedMemory, &PathCx<'_>),
    ) {
        if self.shared.is_empty() {
            return;
        }
        let (none, wishes) = (SharedMemories::default(), Wishes::default());
        let cx = context!(self, flow, &wishes, &none, evaluated);
        for memory in self.shared.iter_mut() {
            call(memory, &cx);
        }
    }
}

/// Which moves a move is one of; empty for what is not a move.
fn kind_of(event: &Event) -> Watch {
    match event {
        Event::Travel(travel) => match (travel.kind == TravelKind::Rapid, travel.expanded) {
            (false, false) => Watch::FEED_MOVES,
            (true, false) => Watch::RAPID_MOVES,
            (false, true) => Watch::FEED_STROKES,
            (true, true) => Watch::RAPID_STROKES,
        },
        Event::Arc(_) => Watch::ARCS,
        Event::Curve(_) => Watch::CURVES,
        _ => Watch::empty(),
    }
}

/// Is it a kind of rapid moves?
const fn is_rapid(kind: Watch) -> bool {
    kind.intersects(Watch::RAPID_MOVES.union(Watch::RAPID_STROKES))
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
        // Where paths part, the next move may be one of another path.
        if !cx.solo || is_read(cx.origin) {
            self.callees.end_streak();
        }
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
                self.remember(cx, &evaluated, |memory, cx| memory.block(cx));
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
        let kind = kind_of(event);
        // Operations that pass their points exactly say so at each of them, and increments from an unknown place how long they
        // are; no rule asks for it.
        if matches!(event, Event::PathMode(_) | Event::KnownWay(_)) {
            return;
        }
        if kind.is_empty() {
            // A cut after a dwell is made as the one before it.
            if !matches!(event, Event::Dwell(_)) {
                self.changed = true;
                self.callees.end_streak();
            }
            let watch = if matches!(event, Event::Modal(_)) { Watch::MODES } else { Watch::CHANGES };
            self.show(watch, cx, |rule, cx, report| rule.changed(cx, event, report));
            self.remember(cx, &Evaluated::default(), |memory, cx| memory.changed(cx, event));
            return;
        }
        // Blocks of other files are judged when those files are checked; what they did counts for what comes after them.
        if cx.origin.at.file != 0 {
            self.callees.end_streak();
            for memory in self.shared.iter_mut() {
                memory.moved_elsewhere(event);
            }
            return;
        }
        let is_cut = !is_rapid(kind);
        let is_first_cut = is_cut && self.changed;
        self.changed &= !is_cut;
        self.show_move(kind, is_first_cut, cx, event);
    }

    fn vacant_read(&mut self, cx: &FlowCx<'_>, variable: u32) {
        self.show(Watch::READS, cx, |rule, cx, report| rule.vacant_read(cx, variable, report));
    }

    fn fault(&mut self, cx: &FlowCx<'_>, fault: &Fault) {
        self.callees.end_streak();
        self.show(Watch::FAULTS, cx, |rule, cx, report| rule.fault(cx, fault, report));
        if *fault == Fault::NoProgramEnd {
            self.show_end_elsewhere(cx, Ending::Text);
        }
    }

    fn ended(&mut self, cx: &FlowCx<'_>, ending: Ending) {
        self.changed = true;
        self.callees.end_streak();
        self.show(Watch::ENDS, cx, |rule, cx, report| rule.ended(cx, ending, report));
        self.show_end_elsewhere(cx, ending);
    }

    fn endless(&mut self, cx: &FlowCx<'_>, head: At) {
        self.show(Watch::ENDLESS, cx, |rule, cx, report| rule.endless(cx, head, report));
    }
}
