//! The analysis of all paths, kept from one edit to the next: in segments, from one checkpoint of the engine to the next.
//!
//! Knows: when a segment still holds, where an analysis must be taken up, when it has come back to what is known. Must not know:
//! any rule.
//!
//! A segment holds while the chunks it read are as they were, and the state, the rules' memories and the facts it asked for are
//! those it began with. Where facts were set is not part of the state: a fact that a segment neither asks for nor sets is
//! handed on.

use std::cell::RefCell;
use std::collections::{BTreeSet, HashSet};
use std::ops::Range;
use std::rc::Rc;

use gcheck_diagnostics::{Finding, Severity};
use gcheck_engine::{
    Assumption, At, Checkpoint, Choice, Event, Facts, Fault, FlowCx, FlowObserver, FlowResult, GivenUp, Leg,
    Machine, Model, Options, Parting, Program, ProgramFile, ReachingDefinitions, Task, flow_from,
};
use gcheck_program::{BlockFlags, FileIndex};
use rustc_hash::FxHashMap;

use super::anchored::AnchoredFinding;
use super::layout::Layout;
use super::rule_state::RuleState;
use crate::Environment;
use crate::block_delete::{self, Positions, found_by_all};
use crate::check::Assumptions;
use crate::collector::Collector;
use crate::partitions::{Case, Partition, Partitions, Rules, Told, is_on_some_path};
use crate::watchers::{Scope, Watchers, shows_to_watchers};

/// What is kept of the analysis, for each position of the block delete switches.
#[derive(Debug, Default)]
pub(crate) struct Paths {
    chains: Vec<Chain>,
    /// Ways of the first conditions, each followed by itself.
    partitions: Vec<Chain>,
    /// Programs that are not here leave what the file sets as it was; `None` where no such program is called.
    as_if_kept: Option<Chain>,
    /// The rules that had something to watch.
    active: Vec<&'static str>,
    /// What was done is no base for going on: all is analysed again at the next change.
    unsure: bool,
}

/// Findings with the severities that the user gave their rules.
type Findings = Vec<(Option<Severity>, Finding)>;

/// The segments of one analysis in order.
#[derive(Debug)]
struct Chain {
    skip: u16,
    /// What its findings hold for.
    scope: Scope,
    /// Blocks have their names in them.
    choices: Vec<Choice>,
    /// It was given up, or cut where it must not be: the next analysis cannot go on from it.
    is_used_up: bool,
    segments: Vec<Segment>,
    /// What the rules remember at the end.
    end: Option<RuleState>,
}

/// Where a segment begins.
#[derive(Debug, Clone)]
struct Entry {
    /// Blocks stand in it by their names.
    checkpoint: Checkpoint,
    /// The block before the one at which it begins; `None` at the beginning of the file.
    before: Option<At>,
    rules: Rc<RuleState>,
}

#[derive(Debug)]
struct Segment {
    /// `None` for the first.
    entry: Option<Entry>,
    work: u64,
    given_up: Vec<GivenUp>,
    assumptions: BTreeSet<Assumption>,
    asked: Facts,
    set: Facts,
    reached: Vec<Run>,
    /// Blocks have their names in them.
    partings: Vec<Parting>,
    /// Slots of the chunks that it read or names in findings.
    reads: Vec<u32>,
    /// It asked for all blocks with these flags.
    flags: BlockFlags,
    findings: Vec<AnchoredFinding>,
    /// It must be executed again, whatever it read.
    is_stale: bool,
    /// It was not executed: it stands for all that comes behind where it begins.
    is_gap: bool,
}

/// Blocks that were reached.
#[derive(Debug)]
struct Run {
    place: RunPlace,
    blocks: Range<u32>,
    always: bool,
}

#[derive(Debug)]
enum RunPlace {
    /// A slot of the main file.
    Slot(u32),
    /// Another file.
    File(u32),
}

/// Why an analysis did not come to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Broken {
    /// Somebody asked for it.
    Stopped,
    /// It has come as far as was wanted; what it found so far is collected.
    Enough,
    /// What was kept is of no use.
    Useless,
}

/// What the analysis needs to know.
#[derive(Clone, Copy)]
pub(crate) struct Inputs<'g> {
    pub(crate) environment: Environment<'g>,
    pub(crate) program: &'g Program<'g>,
    pub(crate) model: &'g Model<'g>,
    pub(crate) file_index: &'g FileIndex,
    pub(crate) rules: Rules<'g>,
    pub(crate) fuel: u64,
    pub(crate) layout: &'g Layout,
    /// What nobody can know is assumed, or not; of block delete each chain knows more.
    pub(crate) options: Options,
    pub(crate) stop: &'g dyn Fn() -> bool,
    /// A checkpoint at this block of the main file, or behind it, is far enough.
    pub(crate) enough: u32,
}

/// What one round of bringing chains up to date works with.
struct Round<'r, 'w, 'c> {
    watchers: &'r mut Watchers<'w, 'c>,
    /// What the rules have found since it was taken last.
    found: &'r RefCell<Findings>,
    /// All rules say what they remember.
    remembers: bool,
    work: &'r mut Work,
}

/// How much was executed, and how much was not.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Segments executed.
    pub executed: usize,
    /// Segments taken over as they were.
    pub kept: usize,
    /// Analyses that began at the beginning.
    pub from_the_start: usize,
}

impl Paths {
    /// Marks what an edit makes stale beside what it changes itself: chunks with blocks of these flags came.
    pub(crate) fn note_flags(&mut self, flags: BlockFlags) {
        let chains = self.chains.iter_mut().chain(&mut self.partitions).chain(&mut self.as_if_kept);
        for segment in chains.flat_map(|chain| &mut chain.segments) {
            segment.is_stale |= segment.flags.intersects(flags);
        }
    }

    pub(crate) fn is_unsure(&self) -> bool {
        self.unsure
    }

    /// Brings the analysis up to date and adds what it finds.
    pub(crate) fn update(
        &mut self,
        inputs: &Inputs<'_>,
        switches: &[u16],
        collector: &mut Collector<'_>,
        work: &mut Work,
    ) -> Result<(Assumptions, bool), Broken> {
        let found = RefCell::new(Vec::new());
        let mut add =
            |severity: Option<Severity>, finding: Finding| found.borrow_mut().push((severity, finding));
        let Inputs { environment, program, model, file_index, rules, .. } = *inputs;
        let mut watchers = Watchers::new(environment, program, model, file_index, rules.active, &mut add);
        let active = watchers.active();
        let is_known = !self.unsure
            && self.active == active
            && self.chains.iter().map(|chain| chain.skip).eq(switches.iter().copied());
        if !is_known {
            if self.chains.iter().any(|chain| !chain.segments.is_empty()) {
                return Err(Broken::Useless);
            }
            self.active = active;
            let scope = |index| if index == 0 { Scope::All } else { Scope::Skipping };
            let chain = |(index, skip): (usize, &u16)| Chain::new(*skip, scope(index), Vec::new());
            self.chains = switches.iter().enumerate().map(chain).collect();
            self.partitions.clear();
            self.as_if_kept = None;
        }
        let remembers = watchers.remembers_all();
        let mut round = Round { watchers: &mut watchers, found: &found, remembers, work };
        self.follow_chains(inputs, &mut round, collector)?;
        self.unsure |= !remembers && self.chains.iter().any(|chain| chain.segments.len() > 1);
        let left_some_out = self.update_partitions(inputs, &mut round)?;
        let results: Vec<FlowResult> = self.chains.iter().map(|chain| chain.result(inputs.layout)).collect();
        let as_if_kept = self.update_as_if_kept(inputs, results.first(), &mut round)?;
        let at_ends_of_cases = self.follow_ends_of_cases(&mut round, inputs.layout)?;
        found.take();
        watchers.forget_made();
        let at_ends = self.follow_ends(&mut watchers, inputs.layout)?;
        if let Some((first, others)) = results.split_first() {
            watchers.finish(first, others);
        }
        drop(watchers);
        let is_incomplete = results.iter().any(FlowResult::is_incomplete);
        let positions =
            if is_incomplete { Positions::default() } else { self.positions(inputs.layout, at_ends) };
        let mut told = Told::default();
        collect(inputs.layout, &self.chains, found.into_inner(), &mut |severity, mut finding| {
            told.note(&finding);
            positions.name(&mut finding);
            collector.add(severity, finding);
        });
        self.collect_cases(inputs, as_if_kept, at_ends_of_cases, &mut told, collector);
        let mut assumptions = Assumptions::new();
        for result in &results {
            assumptions.extend(result.assumptions.iter().cloned());
        }
        if left_some_out {
            assumptions.insert(Assumption::PathsJoined);
        }
        Ok((assumptions, is_incomplete))
    }

    /// Brings the analyses of all paths up to date, one for each position of the switches.
    fn follow_chains(
        &mut self,
        inputs: &Inputs<'_>,
        round: &mut Round<'_, '_, '_>,
        collector: &mut Collector<'_>,
    ) -> Result<(), Broken> {
        for index in 0..self.chains.len() {
            let Some(chain) = self.chains.get_mut(index) else { break };
            loop {
                let offers = round.remembers && !self.unsure;
                let went_back = match advance(chain, inputs, round, offers) {
                    Err(Broken::Enough) => {
                        // What holds with one position of block delete only, shows when all were looked at.
                        if let [only] = self.chains.as_slice() {
                            // What may get a better name later is not told now.
                            collect(inputs.layout, [only], Vec::new(), &mut |severity, finding| {
                                if !is_on_some_path(&finding) {
                                    collector.add(severity, finding);
                                }
                            });
                        }
                        return Err(Broken::Enough);
                    }
                    done => done?,
                };
                self.unsure |= chain.is_given_up();
                if !went_back {
                    break;
                }
                // What was taken for a checkpoint was none: once more, in one piece.
                self.unsure = true;
                chain.segments.clear();
            }
            if chain.work() >= inputs.fuel && round.work.kept > 0 {
                return Err(Broken::Useless);
            }
        }
        Ok(())
    }

    /// Shows the rules the end of each analysis, with what they remember there. What each of them found then, of what the
    /// first found.
    fn follow_ends(
        &self,
        watchers: &mut Watchers<'_, '_>,
        layout: &Layout,
    ) -> Result<Vec<HashSet<block_delete::Key>>, Broken> {
        let mut found = Vec::with_capacity(self.chains.len());
        for (index, chain) in self.chains.iter().enumerate() {
            watchers.restart(if index == 0 { Scope::All } else { Scope::Skipping });
            if index == 1
                && let Some(first) = self.chains.first()
            {
                watchers.note_made(keys_of(first, layout));
            }
            if let Some(end) = &chain.end
                && !end.restore(watchers, layout)
            {
                return Err(Broken::Useless);
            }
            watchers.followed();
            found.push(if index == 0 { watchers.made().collect() } else { watchers.take_again() });
        }
        Ok(found)
    }

    /// What the rules find at the ends of the analyses of single cases, in their order.
    fn follow_ends_of_cases(
        &self,
        round: &mut Round<'_, '_, '_>,
        layout: &Layout,
    ) -> Result<Vec<Findings>, Broken> {
        let follow = |chain: &Chain| {
            round.watchers.restart(Scope::OneWay);
            round.watchers.forget_made();
            round.found.take();
            if let Some(end) = chain.end.as_ref().filter(|_| !chain.is_given_up()) {
                if !end.restore(round.watchers, layout) {
                    return Err(Broken::Useless);
                }
                round.watchers.followed();
            }
            Ok(round.found.take())
        };
        self.partitions.iter().chain(&self.as_if_kept).map(follow).collect()
    }

    /// What holds with one position of block delete only; with what was found at the end of each analysis.
    fn positions(&self, layout: &Layout, at_ends: Vec<HashSet<block_delete::Key>>) -> Positions {
        let Some((first, others)) = self.chains.split_first().filter(|(_, others)| !others.is_empty()) else {
            return Positions::default();
        };
        let mut at_ends = at_ends.into_iter();
        let off = keys_of(first, layout).into_iter().chain(at_ends.next().unwrap_or_default());
        let mut positions = Positions::new(off);
        positions.found_again(found_by_all(others.iter().zip(at_ends).map(|(chain, at_end)| {
            let mut all = keys_of(chain, layout);
            all.extend(at_end);
            all
        })));
        positions
    }

    /// Follows the ways of the first conditions, each by itself. True when some were left out.
    fn update_partitions(
        &mut self,
        inputs: &Inputs<'_>,
        round: &mut Round<'_, '_, '_>,
    ) -> Result<bool, Broken> {
        let Some(first) = self.chains.first() else { return Ok(false) };
        let mut partitions = Partitions::default();
        partitions.add(&[], first.partings(inputs.layout));
        let mut left = Partitions::work(first.work());
        let mut known = std::mem::take(&mut self.partitions);
        // Its own segments are what it goes on from.
        while let Some(Partition { choices, begins, from: _ }) = partitions.next() {
            let same = known.iter().position(|chain| chain.choices(inputs.layout).as_ref() == Some(&choices));
            let kept = same.map(|index| known.swap_remove(index));
            let chain = || Chain::new(first.skip, Scope::OneWay, named(&choices, inputs.layout));
            let fuel = inputs.fuel.min(begins.saturating_add(left));
            let inputs = Inputs { fuel, enough: u32::MAX, ..*inputs };
            let chain = follow_apart(kept, chain, &inputs, round)?;
            left = left.saturating_sub(chain.work().saturating_sub(begins));
            if left == 0 {
                partitions.leave_rest();
            }
            partitions.add(&choices, chain.partings(inputs.layout));
            self.partitions.push(chain);
        }
        Ok(partitions.left_some_out())
    }

    /// Follows all paths as if programs that are not here left what the file sets as it was. The case, if `first`, the result
    /// for all paths, says that such a program was called.
    fn update_as_if_kept(
        &mut self,
        inputs: &Inputs<'_>,
        first: Option<&FlowResult>,
        round: &mut Round<'_, '_, '_>,
    ) -> Result<Option<Case>, Broken> {
        let kept = self.as_if_kept.take();
        let first = first.filter(|_| !inputs.options.assumes);
        let case = first.and_then(|first| Case::of_missing_programs(&first.assumptions));
        let (Some(case), Some(all_paths)) = (case, self.chains.first()) else { return Ok(None) };
        let chain = || Chain::new(all_paths.skip, Scope::OneWay, Vec::new());
        let options = Options { keeps_what_was_set: true, ..inputs.options };
        let inputs = Inputs { options, enough: u32::MAX, ..*inputs };
        self.as_if_kept = Some(follow_apart(kept, chain, &inputs, round)?);
        Ok(Some(case))
    }

    /// Adds what holds in one case only; with what was found at the ends.
    fn collect_cases(
        &self,
        inputs: &Inputs<'_>,
        as_if_kept: Option<Case>,
        at_ends: Vec<Findings>,
        told: &mut Told,
        collector: &mut Collector<'_>,
    ) {
        let case = |chain: &Chain| {
            Some(Case::new(&chain.choices(inputs.layout)?, inputs.program, inputs.environment))
        };
        let cases = self.partitions.iter().map(case).chain([as_if_kept]);
        let chains = self.partitions.iter().chain(&self.as_if_kept).zip(at_ends);
        for ((chain, at_end), case) in chains.zip(cases) {
            let Some(case) = case else { continue };
            collect(inputs.layout, [chain], at_end, &mut |severity, finding| {
                told.add(&case, (severity, finding), inputs.rules, collector);
            });
        }
    }

    /// Executes again what came by any of the blocks, with every switch of block delete off, and shows it to an observer.
    /// `false`: nothing is kept that would help.
    pub(crate) fn show_again<O: FlowObserver>(
        &self,
        inputs: &Inputs<'_>,
        machine: &Machine,
        blocks: &Range<u32>,
        observer: &mut O,
    ) -> bool {
        let Some(chain) = self.chains.iter().find(|chain| chain.skip == 0) else { return false };
        if !chain.covers(blocks, inputs.layout) {
            return false;
        }
        let mut spent = 0;
        for segment in &chain.segments {
            let comes_by = segment.reached.iter().any(|run| match run.place {
                RunPlace::Slot(slot) => inputs
                    .layout
                    .run_outside(slot, &run.blocks)
                    .is_some_and(|run| run.start < blocks.end && blocks.start < run.end),
                RunPlace::File(_) => false,
            });
            if comes_by {
                let mut checkpoint = segment.entry.as_ref().map(|entry| entry.checkpoint.clone());
                if checkpoint.as_mut().is_some_and(|checkpoint| !number_again(checkpoint, inputs.layout)) {
                    return false;
                }
                let mut once = Once { observer, stop: inputs.stop };
                let fuel = inputs.fuel.saturating_sub(spent);
                let task = Task { options: inputs.options, ..Task::all_paths(fuel) };
                flow_from(inputs.program, inputs.model, machine, task, checkpoint, &mut once);
            }
            spent += segment.work;
        }
        true
    }
}

/// Brings a chain up to date that is followed beside those of all paths: the one that is kept, if it is of use, or a new one.
fn follow_apart(
    kept: Option<Chain>,
    new: impl FnOnce() -> Chain,
    inputs: &Inputs<'_>,
    round: &mut Round<'_, '_, '_>,
) -> Result<Chain, Broken> {
    let kept = kept.filter(|chain| !chain.is_used_up);
    let is_kept = kept.is_some();
    let mut chain = kept.unwrap_or_else(new);
    let went_back = advance(&mut chain, inputs, round, round.remembers)?;
    if is_kept && (went_back || chain.is_given_up()) {
        return Err(Broken::Useless);
    }
    if went_back {
        chain.segments.clear();
        advance(&mut chain, inputs, round, false)?;
    }
    chain.is_used_up = went_back || chain.is_given_up();
    Ok(chain)
}

/// Adds each finding once: a loop comes by many times, and so do calls from several segments.
fn collect<'c>(
    layout: &'c Layout,
    chains: impl IntoIterator<Item = &'c Chain>,
    last: Findings,
    add: &mut dyn FnMut(Option<Severity>, Finding),
) {
    let mut made: HashSet<(&'static str, u32, &str)> = HashSet::new();
    let known = |chain: &'c Chain| chain.segments.iter().take_while(|segment| !segment.is_gap);
    for segment in chains.into_iter().flat_map(known) {
        for kept in &segment.findings {
            if made.insert(kept.key(layout)) {
                add(kept.severity, kept.found(layout));
            }
        }
    }
    for (severity, finding) in last {
        if !made.contains(&(finding.rule.id, finding.range.start, finding.message.as_str())) {
            add(severity, finding);
        }
    }
}

/// What an analysis found on the way.
fn keys_of(chain: &Chain, layout: &Layout) -> HashSet<block_delete::Key> {
    let segments = chain.segments.iter().take_while(|segment| !segment.is_gap);
    let keys = segments.flat_map(|segment| &segment.findings).map(|kept| kept.key(layout));
    keys.map(|(rule, start, text)| (rule, start, text.to_owned())).collect()
}

fn named(choices: &[Choice], layout: &Layout) -> Vec<Choice> {
    let mut named = choices.to_vec();
    for choice in &mut named {
        layout.name(&mut choice.at);
    }
    named
}

impl Chain {
    fn new(skip: u16, scope: Scope, choices: Vec<Choice>) -> Self {
        Self { skip, scope, choices, is_used_up: false, segments: Vec::new(), end: None }
    }

    fn work(&self) -> u64 {
        self.segments.iter().map(|segment| segment.work).sum()
    }

    fn is_given_up(&self) -> bool {
        self.segments.iter().any(|segment| !segment.given_up.is_empty())
    }

    /// Its choices by the numbers of blocks; `None` when one of the blocks is not there any more.
    fn choices(&self, layout: &Layout) -> Option<Vec<Choice>> {
        let mut choices = self.choices.clone();
        choices.iter_mut().all(|choice| layout.number_again(&mut choice.at)).then_some(choices)
    }

    /// Where its paths part.
    fn partings(&self, layout: &Layout) -> Vec<Parting> {
        let mut before = 0;
        let mut partings = Vec::new();
        for segment in &self.segments {
            for parting in &segment.partings {
                let mut parting = Parting { work: before + parting.work, ..*parting };
                if layout.number_again(&mut parting.at) {
                    partings.push(parting);
                }
            }
            before += segment.work;
        }
        partings
    }

    /// Is all known of the paths that come by some blocks? An analysis that was given up, or has come far enough, knows what is
    /// in front of the block where it is to be taken up: nothing leads back over that.
    fn covers(&self, blocks: &Range<u32>, layout: &Layout) -> bool {
        let Some(gap) = self.segments.iter().find(|segment| segment.is_gap) else {
            return !self.segments.is_empty();
        };
        gap.entry.as_ref().is_some_and(|entry| {
            let mut at = entry.checkpoint.at;
            layout.number_again(&mut at) && at.file == 0 && blocks.end <= at.block
        })
    }

    fn result(&self, layout: &Layout) -> FlowResult {
        let mut result = FlowResult::default();
        for segment in &self.segments {
            result.add_leg(segment.work, &segment.given_up, &segment.assumptions);
            for run in &segment.reached {
                let (file, blocks) = match run.place {
                    RunPlace::Slot(slot) => (0, layout.run_outside(slot, &run.blocks)),
                    RunPlace::File(file) => (file, Some(run.blocks.clone())),
                };
                if let Some(blocks) = blocks {
                    result.reach_all(At { file, block: blocks.start }, blocks.end, run.always);
                }
            }
        }
        result
    }
}

impl Segment {
    /// Does it still hold, when these facts were set by other blocks than at its beginning?
    fn holds(&self, layout: &Layout, differing: Facts) -> bool {
        !self.is_stale
            && !self.asked.intersects(differing)
            && self.reads.iter().all(|slot| layout.is_there(*slot))
    }
}

fn number_again(checkpoint: &mut Checkpoint, layout: &Layout) -> bool {
    layout.number_again(&mut checkpoint.at)
        && checkpoint.definitions.places(&mut |at| layout.number_again(at))
}

/// Facts that were set by other blocks than the segments in hand say, and the definitions that have them right.
type Carried = Option<(Facts, ReachingDefinitions)>;

impl Entry {
    /// Was nothing put in between the block at which it begins and the one in front? What was put in there may have to be
    /// executed first.
    fn is_whole(&self, layout: &Layout) -> bool {
        let number = |mut at: At| layout.number_again(&mut at).then_some(at);
        match self.before {
            Some(before) => number(before).map(At::next) == number(self.checkpoint.at),
            None => number(self.checkpoint.at).is_some_and(|at| at.block == 0),
        }
    }

    fn carry(&mut self, carried: &Carried) {
        if let Some((facts, definitions)) = carried {
            self.checkpoint.definitions.take(*facts, definitions);
        }
    }
}

/// Takes over the old segments from `at` on that hold: the first that does not.
fn take_over(
    chain: &mut Chain,
    old: &mut [Option<Segment>],
    mut at: usize,
    layout: &Layout,
    carried: &mut Carried,
    work: &mut Work,
) -> usize {
    while let Some(Some(segment)) = old.get(at) {
        let differing = carried.as_ref().map_or(Facts::default(), |(facts, _)| *facts);
        if !segment.holds(layout, differing) {
            break;
        }
        let Some(mut segment) = old.get_mut(at).and_then(Option::take) else { break };
        if let Some(entry) = &mut segment.entry {
            entry.carry(carried);
        }
        if let Some((facts, _)) = carried {
            *facts = facts.without(segment.set);
        }
        *carried = carried.take().filter(|(facts, _)| !facts.is_empty());
        chain.segments.push(segment);
        work.kept += 1;
        at += 1;
    }
    at
}

/// Where execution begins again: at an old entry, or at an earlier one if something was put in before it.
fn whole_entry(
    mut entry: Option<Entry>,
    chain: &mut Chain,
    layout: &Layout,
    carried: &Carried,
    work: &mut Work,
) -> Option<Entry> {
    if let Some(entry) = &mut entry {
        entry.carry(carried);
    }
    while entry.as_ref().is_some_and(|entry| !entry.is_whole(layout)) {
        entry = chain.segments.pop().and_then(|segment| segment.entry);
        work.kept = work.kept.saturating_sub(1);
    }
    entry
}

/// Gives the rules back what they remembered at an entry: the checkpoint there, `None` at the start of the program.
fn begin_at(
    entry: Option<&Entry>,
    watchers: &mut Watchers<'_, '_>,
    layout: &Layout,
    work: &mut Work,
) -> Result<Option<Checkpoint>, Broken> {
    let Some(entry) = entry else {
        work.from_the_start += 1;
        return Ok(None);
    };
    let mut from = entry.checkpoint.clone();
    if !number_again(&mut from, layout) || !entry.rules.restore(watchers, layout) {
        return Err(Broken::Useless);
    }
    Ok(Some(from))
}

/// Brings a chain up to date, cut into segments if it `offers` checkpoints. True when execution came back over one.
fn advance(
    chain: &mut Chain,
    inputs: &Inputs<'_>,
    round: &mut Round<'_, '_, '_>,
    offers: bool,
) -> Result<bool, Broken> {
    let Round { watchers, found, work, .. } = round;
    let layout = inputs.layout;
    let file = inputs.program.file(0).ok_or(Broken::Useless)?;
    let mut old: Vec<Option<Segment>> = std::mem::take(&mut chain.segments).into_iter().map(Some).collect();
    let mut at = 0;
    let mut carried: Carried = None;
    let mut entries: Option<FxHashMap<At, usize>> = None;
    loop {
        at = take_over(chain, &mut old, at, layout, &mut carried, work);
        if at == old.len() && at > 0 {
            return Ok(false);
        }
        let entries = entries.get_or_insert_with(|| {
            let entry = |(index, segment): (usize, &Option<Segment>)| {
                Some((segment.as_ref()?.entry.as_ref()?.checkpoint.at, index))
            };
            old.iter().enumerate().filter_map(entry).collect()
        });
        let entry = old.get_mut(at).and_then(Option::take).and_then(|segment| segment.entry);
        let entry = whole_entry(entry, chain, layout, &carried, work);
        // From here on it is executed.
        watchers.restart(chain.scope);
        watchers.forget_made();
        found.take();
        let checkpoint = begin_at(entry.as_ref(), watchers, layout, work)?;
        file.loaded.note_touched();
        let fuel = inputs.fuel.saturating_sub(chain.work());
        let choices = chain.choices(layout).ok_or(Broken::Useless)?;
        let mut recorder = Recorder {
            watchers,
            file: &file,
            layout,
            found,
            offers,
            stop: inputs.stop,
            enough: Some(inputs.enough),
            entry,
            segments: &mut chain.segments,
            old: &old,
            behind: at,
            entries,
            joined: None,
            went_back: false,
            executed: 0,
        };
        let options = Options { skip: chain.skip, ..inputs.options };
        let task = Task { options, choices: &choices, work: fuel };
        let machine = &inputs.environment.machine.engine;
        let leg = flow_from(inputs.program, inputs.model, machine, task, checkpoint, &mut recorder);
        let (joined, stopped) = (recorder.joined.take(), leg.stopped);
        if joined.is_none() && !stopped {
            recorder.close(leg);
        }
        let (entry, went_back) = (recorder.entry.take(), recorder.went_back);
        let is_far = recorder.enough.is_none();
        work.executed += recorder.executed;
        if let Some(Joined { index, before, differing, definitions }) = joined {
            at = index;
            if let Some(Some(Segment { entry: Some(entry), .. })) = old.get_mut(index) {
                entry.before = before;
            }
            carried = Some((differing, definitions)).filter(|(facts, _)| !facts.is_empty());
            continue;
        }
        if stopped {
            // Given up on the way: what follows here is to be executed, and what was known may be met behind it.
            chain.segments.push(Segment::gap(entry));
            chain.segments.extend(old.into_iter().skip(at).flatten());
            return Err(if is_far { Broken::Enough } else { Broken::Stopped });
        }
        chain.end = Some(RuleState::of(watchers, layout));
        return Ok(went_back);
    }
}

impl Segment {
    /// Stands for what was not executed.
    fn gap(entry: Option<Entry>) -> Self {
        Self {
            entry,
            work: 0,
            given_up: Vec::new(),
            assumptions: BTreeSet::new(),
            asked: Facts::default(),
            set: Facts::default(),
            reached: Vec::new(),
            partings: Vec::new(),
            reads: Vec::new(),
            flags: BlockFlags::empty(),
            findings: Vec::new(),
            is_stale: true,
            is_gap: true,
        }
    }
}

/// Execution has come to where an old segment begins.
struct Joined {
    /// Which one.
    index: usize,
    /// The block in front of it now.
    before: Option<At>,
    /// The facts that were set elsewhere than it says.
    differing: Facts,
    /// Where they were set.
    definitions: ReachingDefinitions,
}

/// Lets the rules watch, and cuts what they are shown into segments.
struct Recorder<'r, 'w, 'c> {
    watchers: &'r mut Watchers<'w, 'c>,
    file: &'r ProgramFile<'r>,
    layout: &'r Layout,
    found: &'r RefCell<Findings>,
    offers: bool,
    stop: &'r dyn Fn() -> bool,
    /// The block that is far enough; `None` when it was reached.
    enough: Option<u32>,
    /// Where the segment under way began.
    entry: Option<Entry>,
    segments: &'r mut Vec<Segment>,
    old: &'r [Option<Segment>],
    /// Old segments up to this one are behind.
    behind: usize,
    /// By the block at which it begins: which old segment.
    entries: &'r FxHashMap<At, usize>,
    joined: Option<Joined>,
    went_back: bool,
    executed: usize,
}

impl Recorder<'_, '_, '_> {
    /// A segment comes to its end.
    fn close(&mut self, leg: Leg) {
        let touched = self.file.loaded.note_touched();
        let mut reads: Vec<u32> =
            touched.chunks.iter().filter_map(|chunk| self.layout.slot(*chunk as usize)).collect();
        let mut is_stale = touched.all;
        let mut findings = Vec::new();
        for (severity, finding) in self.found.take() {
            match AnchoredFinding::new(severity, finding, self.layout) {
                Some(kept) => {
                    reads.extend(kept.slots());
                    findings.push(kept);
                }
                None => is_stale = true,
            }
        }
        reads.sort_unstable();
        reads.dedup();
        let mut reached = Vec::new();
        for (runs, always) in [(leg.reached(), false), (leg.always_reached(), true)] {
            for (from, end) in runs {
                if from.file == 0 {
                    self.layout.runs_inside(from.block..end, |slot, blocks| {
                        reached.push(Run { place: RunPlace::Slot(slot), blocks, always });
                    });
                } else {
                    let place = RunPlace::File(from.file);
                    reached.push(Run { place, blocks: from.block..end, always });
                }
            }
        }
        let mut partings = leg.partings;
        for parting in &mut partings {
            self.layout.name(&mut parting.at);
        }
        self.went_back |= leg.went_back;
        self.executed += 1;
        self.segments.push(Segment {
            entry: self.entry.take(),
            work: leg.work,
            given_up: leg.given_up,
            asked: leg.asked,
            set: leg.set,
            assumptions: leg.assumptions,
            reached,
            partings,
            reads,
            flags: touched.flags,
            findings,
            is_stale,
            is_gap: false,
        });
    }
}

impl FlowObserver for Recorder<'_, '_, '_> {
    shows_to_watchers!();

    fn wants_checkpoints(&self) -> bool {
        self.offers
    }

    fn checkpoint(&mut self, leg: Leg, mut checkpoint: Checkpoint) -> bool {
        self.close(leg);
        self.watchers.forget_made();
        self.enough = self.enough.filter(|enough| checkpoint.at.block < *enough);
        checkpoint.definitions = checkpoint.definitions.apart();
        let before = checkpoint.at.block.checked_sub(1).map(|block| {
            let mut before = At { block, ..checkpoint.at };
            self.layout.name(&mut before);
            before
        });
        self.layout.name(&mut checkpoint.at);
        checkpoint.definitions.places(&mut |at| {
            self.layout.name(at);
            true
        });
        let rules = RuleState::of(self.watchers, self.layout);
        let index = self.entries.get(&checkpoint.at).copied().filter(|index| *index > self.behind);
        let known = index.and_then(|index| self.old.get(index)?.as_ref());
        if let (Some(index), Some(known)) = (index, known)
            && let Some(entry) = &known.entry
            && entry.checkpoint.leads_on_as(&checkpoint)
            && *entry.rules == rules
        {
            let differing = checkpoint.definitions.differing(&entry.checkpoint.definitions);
            if known.holds(self.layout, differing) {
                self.joined = Some(Joined { index, before, differing, definitions: checkpoint.definitions });
                return false;
            }
        }
        // Most of the time nothing of what rules remember changes from one checkpoint to the next.
        let last = self.segments.last().and_then(|segment| segment.entry.as_ref());
        let rules = match last {
            Some(last) if *last.rules == rules => Rc::clone(&last.rules),
            _ => Rc::new(rules),
        };
        self.entry = Some(Entry { checkpoint, before, rules });
        self.enough.is_some()
    }

    fn stops(&mut self) -> bool {
        (self.stop)()
    }
}

/// Shows one segment and no more.
struct Once<'o, O> {
    observer: &'o mut O,
    stop: &'o dyn Fn() -> bool,
}

impl<O: FlowObserver> FlowObserver for Once<'_, O> {
    fn before(&mut self, cx: &FlowCx<'_>) {
        self.observer.before(cx);
    }

    fn event(&mut self, cx: &FlowCx<'_>, event: &Event) {
        self.observer.event(cx, event);
    }

    fn after(&mut self, cx: &FlowCx<'_>) {
        self.observer.after(cx);
    }

    fn fault(&mut self, cx: &FlowCx<'_>, fault: &Fault) {
        self.observer.fault(cx, fault);
    }

    fn wants_checkpoints(&self) -> bool {
        true
    }

    fn checkpoint(&mut self, _: Leg, _: Checkpoint) -> bool {
        false
    }

    fn stops(&mut self) -> bool {
        (self.stop)()
    }
}
