//! Running the selected rules over one file.
//!
//! Knows: chunks, tiers, suppressions, the order of findings. Must not know: any rule. Memory stays bounded: a chunk's table
//! is dropped before the next is made, and findings beyond [`MAX_FINDINGS`](crate::MAX_FINDINGS) are counted, not kept.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ops::Range;

use gcheck_controls::Ends;
use gcheck_diagnostics::{Finding, RuleMeta, Severity};
use gcheck_engine::{Assumption, Budget, FlowResult, Model, Options, Program, Task, flow, flow_branch};
use gcheck_program::{BlockFlags, BlockTable, FileIndex, Loaded, code_region};
use gcheck_syntax::SourceText;

use crate::block_delete::{Positions, found_by_all, name_condition};
use crate::collector::Collector;
use crate::containment::{call, without_rules_that_panic};
use crate::environment::ProgramLibrary;
use crate::partitions::{Case, Follower, Partition, Partitions, Rules, Told};
use crate::watchers::{Scope, Watchers};
use crate::{
    BlockCx, Environment, FileCx, ProgramText, Report, RuleEntry, RuleTable, Run, Selection, Suppressions,
    syntax_errors,
};

/// What is to be checked, and how.
pub struct Job<'a> {
    /// The file.
    pub source: &'a SourceText,
    /// Control, machine, other programs.
    pub environment: Environment<'a>,
    /// The rules that run.
    pub selection: &'a Selection,
    /// Whether comments may silence rules.
    pub suppressions: bool,
    /// How paths are analysed.
    pub execution: Execution,
}

/// How the paths of a program are analysed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Execution {
    /// Blocks that may be executed: by a run, and, where it is not [`Execution::FUEL`], by an analysis of all paths.
    pub fuel: u64,
    /// The switch of block delete; `None` analyses every position.
    pub block_skip: Option<bool>,
}

impl Execution {
    /// What a run may execute when nobody says otherwise. An analysis then gets what the text of its program is worth.
    pub const FUEL: u64 = 50_000_000;

    /// The work that an analysis of all paths may do.
    pub(crate) fn work(&self, program: &Program<'_>) -> u64 {
        if self.fuel == Self::FUEL { Budget::DEFAULT.of(program) } else { self.fuel }
    }
}

impl Default for Execution {
    fn default() -> Self {
        Self { fuel: Self::FUEL, block_skip: None }
    }
}

/// What the findings of a file take as given: settings, offsets and modes that were not configured.
pub type Assumptions = BTreeSet<Assumption>;

/// What came out of a file.
#[derive(Debug, Default)]
pub struct Outcome {
    /// Findings in text order.
    pub findings: Vec<Finding>,
    /// Findings beyond the limit, by rule and severity.
    pub omitted: Vec<(&'static RuleMeta, Severity, usize)>,
    /// Findings silenced by comments.
    pub suppressed: usize,
    /// Lines of the file.
    pub lines: usize,
    /// What the analysis of paths took as given.
    pub assumptions: Assumptions,
    /// The analysis of paths ended before it had seen all.
    pub out_of_fuel: bool,
    /// Rules that panicked, by id: whatever they found is left out.
    pub failed: Vec<&'static RuleMeta>,
}

impl Outcome {
    /// Adds rules that panicked, and leaves out what they found in parts of the file that were checked before.
    pub(crate) fn note_failed(&mut self, failed: Vec<&'static RuleMeta>) {
        self.findings.retain(|finding| !failed.contains(&finding.rule));
        self.omitted.retain(|(rule, ..)| !failed.contains(rule));
        self.failed.extend(failed);
        self.failed.sort_by_key(|rule| rule.id);
        self.failed.dedup_by_key(|rule| rule.id);
    }
}

/// The selected rules, arranged by when they run.
pub(crate) struct Plan {
    pub(crate) table: RuleTable,
    token: Vec<(&'static RuleEntry, Option<Severity>)>,
    block: Vec<(&'static RuleEntry, Option<Severity>, BlockFlags)>,
    program: Vec<(&'static RuleEntry, Option<Severity>)>,
    pub(crate) path: Vec<(&'static RuleEntry, Option<Severity>)>,
    suppressions: Vec<(&'static RuleEntry, Option<Severity>)>,
    /// Blocks without any of these flags need no rule.
    trigger: BlockFlags,
}

impl Plan {
    pub(crate) fn new(selection: &Selection) -> Self {
        let mut plan = Self {
            table: selection.table(),
            token: Vec::new(),
            block: Vec::new(),
            program: Vec::new(),
            path: Vec::new(),
            suppressions: Vec::new(),
            trigger: BlockFlags::ERROR,
        };
        for (rule, severity) in selection.rules() {
            match rule.run {
                Run::Token { .. } => plan.token.push((rule, severity)),
                Run::Block { trigger, .. } => {
                    plan.trigger |= trigger;
                    plan.block.push((rule, severity, trigger));
                }
                Run::BlockAndValues { trigger, .. } => {
                    plan.trigger |= trigger;
                    plan.block.push((rule, severity, trigger));
                    plan.path.push((rule, severity));
                }
                Run::Program { .. } => plan.program.push((rule, severity)),
                Run::Path { .. } => plan.path.push((rule, severity)),
                Run::Suppressions { .. } => plan.suppressions.push((rule, severity)),
            }
        }
        plan
    }

    /// The same without rules about suppressions.
    pub(crate) fn without_suppressions(self) -> Self {
        Self { suppressions: Vec::new(), ..self }
    }

    /// The user chose the severity of the rule's findings.
    fn is_overridden(&self, rule: &'static RuleMeta) -> bool {
        let pairs = self.token.iter().chain(&self.program).chain(&self.path).map(|(r, s)| (r, s));
        let mut pairs = pairs.chain(self.block.iter().map(|(r, s, _)| (r, s)));
        pairs.any(|(r, severity)| std::ptr::eq(r.meta, rule) && severity.is_some())
    }
}

/// Checks one file. A rule that panics takes only its own findings with it, and is named in [`Outcome::failed`].
pub fn check(job: &Job<'_>) -> Outcome {
    let (mut outcome, failed) = without_rules_that_panic(job.selection, |rules| check_with(job, rules));
    outcome.note_failed(failed);
    outcome
}

fn check_with(job: &Job<'_>, rules: &Selection) -> Outcome {
    let plan = Plan::new(rules);
    let text = job.source.text();
    let region = code_region(text);
    let region = region.start as u32..region.end as u32;
    let mut collector = Collector::new(job.environment);
    let mut file_index = FileIndex::default();
    let mut directives = Vec::new();
    let (mut lines, mut seen) = (0, 0);
    let loaded = Loaded::new(text, job.environment.dialect, |base, table, chunk| {
        // Here its text is in the processor's cache.
        lines += count_lines(chunk.as_bytes());
        seen += chunk.len();
        file_index.add(table, base, region.end, job.environment.dialect);
        // Comments after the part that the control reads silence nothing, wherever the chunk ends.
        let read = table.directives().iter().filter(|r| r.start + base < region.end);
        directives.extend(read.map(|r| r.start + base..r.end + base));
        check_blocks(job.environment, &plan, region.end, base, table, chunk, &mut collector);
    });
    lines += count_lines(text.as_bytes().get(seen..).unwrap_or_default());
    let text = ProgramText::whole(text);
    check_file(job.environment, &plan, &text, region, &file_index, &mut collector);
    let (assumptions, out_of_fuel) = check_paths(job, &plan, loaded, &file_index, &mut collector);
    let ends = FileNotes { suppressions: job.suppressions, directives: &directives, lines };
    let mut outcome = conclude(&plan, &text, &file_index, collector, &ends);
    outcome.assumptions = assumptions;
    outcome.out_of_fuel = out_of_fuel;
    outcome
}

/// The rules of the program tier.
pub(crate) fn check_file(
    environment: Environment<'_>,
    plan: &Plan,
    text: &ProgramText<'_>,
    region: Range<u32>,
    file_index: &FileIndex,
    collector: &mut Collector<'_>,
) {
    let cx = FileCx::new(environment, text, region, file_index);
    for (rule, severity) in &plan.program {
        if let Run::Program { check } = rule.run {
            let mut add = |finding| collector.add(*severity, finding);
            call(rule.meta, || check(&cx, &mut Report::new(&mut add)));
        }
    }
}

/// What is known of a file besides its findings.
pub(crate) struct FileNotes<'r> {
    /// Whether comments may silence rules.
    pub(crate) suppressions: bool,
    /// Comments with directives.
    pub(crate) directives: &'r [Range<u32>],
    pub(crate) lines: usize,
}

/// When all rules have run: softens findings that no run reaches, silences, and sorts.
pub(crate) fn conclude(
    plan: &Plan,
    text: &ProgramText<'_>,
    file_index: &FileIndex,
    mut collector: Collector<'_>,
    notes: &FileNotes<'_>,
) -> Outcome {
    collector.leave_data(file_index);
    if let Some(end) = unread_from(file_index) {
        // The rest of the block that ends the program is read with it.
        let (base, chunk) = text.around(end);
        let rest = chunk.as_bytes().get((end - base) as usize..).unwrap_or_default();
        let line = rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len());
        collector.soften(|rule| plan.is_overridden(rule), end + line as u32);
    }
    finish(plan, text, collector, notes)
}

/// Executes all paths of the program and lets the rules of the path tier watch.
fn check_paths(
    job: &Job<'_>,
    plan: &Plan,
    loaded: Loaded<'_>,
    file_index: &FileIndex,
    collector: &mut Collector<'_>,
) -> (Assumptions, bool) {
    if plan.path.is_empty() {
        return (Assumptions::new(), false);
    }
    let library = ProgramLibrary(job.environment.programs);
    let model = Model::new(job.environment.control());
    let program = Program::new(loaded, job.environment.dialect, &library);
    let rules = Rules { table: plan.table, active: &plan.path };
    let out = RefCell::new(Out { collector, rules, told: Told::default(), case: None });
    let mut add = |severity: Option<Severity>, finding: Finding| out.borrow_mut().add(severity, finding);
    let mut watchers = Watchers::new(job.environment, &program, &model, file_index, &plan.path, &mut add);
    let keeps = watchers.remembers_all();
    let mut following = Following {
        environment: job.environment,
        program: &program,
        model: &model,
        work: job.execution.work(&program),
        keeps,
        watchers: &mut watchers,
        partitions: Partitions::default(),
        out: &out,
    };
    let switches = switch_positions(job.execution.block_skip, file_index.block_deletes);
    let results = following.all_paths(&switches);
    let out_of_fuel = results.iter().any(FlowResult::is_incomplete);
    let mut assumptions = Assumptions::new();
    for result in &results {
        assumptions.extend(result.assumptions.iter().cloned());
    }
    let (Some((first, others)), Some(skip)) = (results.split_first(), switches.first()) else {
        return (assumptions, out_of_fuel);
    };
    following.watchers.finish(first, others);
    if following.each_way(first, *skip) {
        assumptions.insert(Assumption::PathsJoined);
    }
    following.as_if_all_were_here(first, *skip);
    (assumptions, out_of_fuel)
}

/// The analyses of one file, one after the other, with the rules that watch them.
struct Following<'f, 'w, 'c, 'o, 'k> {
    environment: Environment<'f>,
    program: &'f Program<'f>,
    model: &'f Model<'f>,
    /// Work, in blocks, that each analysis may do.
    work: u64,
    /// All rules say what they remember, so that a way can be followed from where it begins.
    keeps: bool,
    watchers: &'f mut Watchers<'w, 'c>,
    partitions: Partitions,
    out: &'f RefCell<Out<'o, 'k>>,
}

impl Following<'_, '_, '_, '_, '_> {
    /// All paths, for each position of the switches of block delete.
    fn all_paths(&mut self, switches: &[u16]) -> Vec<FlowResult> {
        let machine = &self.environment.machine.engine;
        let mut results = Vec::new();
        let (mut positions, mut again) = (Positions::default(), Vec::new());
        for skip in switches {
            let options = Options { skip: *skip, ..Options::NONE };
            let task = Task { options, ..Task::all_paths(self.work) };
            if results.is_empty() {
                let mut follower = Follower {
                    watchers: self.watchers,
                    partitions: &mut self.partitions,
                    choices: &[],
                    keeps: self.keeps,
                };
                results.push(flow(self.program, self.model, machine, task, &mut follower));
                self.watchers.followed();
                if switches.len() > 1 {
                    positions = Positions::new(self.watchers.made());
                }
            } else {
                self.watchers.restart(Scope::Skipping);
                results.push(flow(self.program, self.model, machine, task, self.watchers));
                self.watchers.followed();
                again.push(self.watchers.take_again());
            }
        }
        // An analysis that gave up may not have come to where it would find the same.
        if !results.iter().any(FlowResult::is_incomplete) && switches.len() > 1 {
            positions.found_again(found_by_all(again.into_iter()));
            self.out.borrow_mut().collector.name_positions(&positions);
        }
        results
    }

    /// The ways of the first conditions, each by itself. True when there are more than are followed.
    fn each_way(&mut self, first: &FlowResult, skip: u16) -> bool {
        let machine = &self.environment.machine.engine;
        self.partitions.add(&[], first.partings.iter().copied());
        let mut left = Partitions::work(first.work);
        while let Some(Partition { choices, begins, from }) = self.partitions.next() {
            self.watchers.restart(Scope::OneWay);
            self.out.borrow_mut().case = Some(Case::new(&choices, self.program, self.environment));
            let options = Options { skip, ..Options::NONE };
            let work = self.work.min(begins.saturating_add(left));
            let task = Task { options, choices: &choices, work };
            if let Some((_, memories)) = &from {
                memories.restore(self.watchers, |_| ());
            }
            let mut follower = Follower {
                watchers: self.watchers,
                partitions: &mut self.partitions,
                choices: &choices,
                keeps: self.keeps,
            };
            let result = match from {
                Some((branch, _)) => {
                    flow_branch(self.program, self.model, machine, task, branch, &mut follower)
                }
                None => flow(self.program, self.model, machine, task, &mut follower),
            };
            // An analysis that gave up has not seen all that there is.
            if !result.is_incomplete() {
                self.watchers.followed();
            }
            left = left.saturating_sub(result.work.saturating_sub(begins));
            if left == 0 {
                self.partitions.leave_rest();
            }
            self.partitions.add(&choices, result.partings);
        }
        self.partitions.left_some_out()
    }

    /// All paths once more, as if programs that are not here left what the file set.
    fn as_if_all_were_here(&mut self, first: &FlowResult, skip: u16) {
        let Some(case) = Case::of_missing_programs(&first.assumptions) else { return };
        self.watchers.restart(Scope::OneWay);
        self.out.borrow_mut().case = Some(case);
        let options = Options { skip, keeps_what_was_set: true, ..Options::NONE };
        let task = Task { options, ..Task::all_paths(self.work) };
        let machine = &self.environment.machine.engine;
        let result = flow(self.program, self.model, machine, task, self.watchers);
        if !result.is_incomplete() {
            self.watchers.followed();
        }
    }
}

/// Passes on what the rules of the path tier find.
struct Out<'o, 'c> {
    collector: &'o mut Collector<'c>,
    rules: Rules<'o>,
    told: Told,
    /// The case that is analysed; `None` for all paths.
    case: Option<Case>,
}

impl Out<'_, '_> {
    fn add(&mut self, severity: Option<Severity>, finding: Finding) {
        match &self.case {
            None => {
                self.told.note(&finding);
                self.collector.add(severity, finding);
            }
            Some(case) => self.told.add(case, (severity, finding), self.rules, self.collector),
        }
    }
}

/// Positions of the block delete switches worth an analysis: all off, all on, and each level alone where there are several.
pub(crate) fn switch_positions(wanted: Option<bool>, levels: u16) -> Vec<u16> {
    match (wanted, levels.count_ones()) {
        (Some(false), _) | (None, 0) => vec![0],
        (Some(true), _) => vec![u16::MAX],
        (None, 1) => vec![0, u16::MAX],
        (None, _) => {
            let each = (0..16).map(|level| 1 << level).filter(|level| levels & level != 0);
            [0, u16::MAX].into_iter().chain(each).collect()
        }
    }
}

/// Where the text begins that no run reads: after an end of the program that nothing goes past.
fn unread_from(file_index: &FileIndex) -> Option<u32> {
    let starts = [
        file_index.programs.last().map(|p| p.range.start),
        file_index.labels.last().map(|l| l.range.start),
        file_index.loops.last().map(|l| l.range.start),
        file_index.o_words.last().map(|o| o.range.start),
    ];
    let reached = starts.into_iter().flatten().max().unwrap_or(0);
    let mut ends = file_index.ends.iter().filter(|e| e.ends == Ends::Program && !e.conditional);
    ends.find(|e| e.range.start >= reached).map(|e| e.range.end)
}

/// Lines as people count them: a line end (`\n`, `\r\n` or `\r`) closes one, and text after the last is one more.
pub(crate) fn count_lines(text: &[u8]) -> usize {
    let feeds = memchr::memchr_iter(b'\n', text).count();
    let lone_returns = memchr::memchr_iter(b'\r', text).filter(|at| text.get(at + 1) != Some(&b'\n')).count();
    feeds + lone_returns + usize::from(text.last().is_some_and(|last| !matches!(last, b'\n' | b'\r')))
}

/// The rules of the block and token tiers over a chunk at offset `base`; blocks that begin at `end` or after it are not read.
pub(crate) fn check_blocks(
    environment: Environment<'_>,
    plan: &Plan,
    end: u32,
    base: u32,
    table: &BlockTable,
    text: &str,
    collector: &mut Collector<'_>,
) {
    if !table.flags().intersects(plan.trigger) {
        return;
    }
    for (ix, block) in table.blocks() {
        if !block.flags.intersects(plan.trigger) {
            continue;
        }
        if base + block.range.start >= end {
            break;
        }
        let cx = BlockCx::new(environment, table, ix, text, base);
        for (rule, severity, trigger) in &plan.block {
            if let Run::Block { check, .. } | Run::BlockAndValues { check, .. } = rule.run
                && block.flags.intersects(*trigger)
            {
                let mut add = |finding| collector.add(*severity, name_condition(finding, block.flags, false));
                call(rule.meta, || check(&cx, &mut Report::new(&mut add)));
            }
        }
        if block.flags.contains(BlockFlags::ERROR) {
            for error in syntax_errors::shown(&cx) {
                for (rule, severity) in &plan.token {
                    if let Run::Token { on, check } = rule.run
                        && on(error.kind)
                    {
                        let mut add =
                            |finding| collector.add(*severity, name_condition(finding, block.flags, false));
                        call(rule.meta, || check(&cx, error, &mut Report::new(&mut add)));
                    }
                }
            }
        }
    }
}

/// Silences, reports suppressions that silence nothing, and sorts.
fn finish(
    plan: &Plan,
    text: &ProgramText<'_>,
    mut collector: Collector<'_>,
    notes: &FileNotes<'_>,
) -> Outcome {
    let mut suppressed = 0;
    // A rule that panicked in one part of the file says nothing of the others, as if it had panicked in all.
    let failed = collector.leave_out_failed();
    if notes.suppressions && !notes.directives.is_empty() {
        let mut suppressions = Suppressions::read(text, notes.directives, plan.table);
        suppressed = collector.leave_out(|finding| suppressions.silences(finding));
        for (rule, severity) in &plan.suppressions {
            if let Run::Suppressions { check } = rule.run {
                let mut add = |finding| collector.add(*severity, finding);
                call(rule.meta, || check(&suppressions, &mut Report::new(&mut add)));
            }
        }
    }
    let (mut findings, omitted) = collector.into_parts();
    findings.sort_by(|a, b| {
        (a.range.start, a.range.end, a.rule.id, &a.message).cmp(&(
            b.range.start,
            b.range.end,
            b.rule.id,
            &b.message,
        ))
    });
    Outcome {
        findings,
        omitted: omitted.iter().collect(),
        suppressed,
        lines: notes.lines,
        assumptions: Assumptions::new(),
        out_of_fuel: false,
        failed,
    }
}

#[cfg(test)]
mod tests {
    use super::count_lines;

    #[test]
    fn every_kind_of_line_end_closes_a_line() {
        for (text, lines) in
            [("", 0), ("G0", 1), ("G0\n", 1), ("G0\r\nG1", 2), ("G0\rG1\r", 2), ("\n\r\n\r", 3)]
        {
            assert_eq!(count_lines(text.as_bytes()), lines, "{text:?}");
        }
    }
}
