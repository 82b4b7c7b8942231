//! Paths kept apart by the way that they take at one condition, also after they meet again.
//!
//! Knows: which further analyses a program is worth, where each begins, how a finding of one of them names its condition. Must
//! not know: any rule, how paths are followed.
//!
//! The analysis of all paths joins states where paths meet, and what only one of them brings is unknown from there on. So each
//! way of the first conditions is followed once more by itself: what is certain there holds on some paths of the program.
//! (Mauborgne and Rival, "Trace Partitioning in Abstract Interpretation Based Static Analyzers", ESOP 2005, partition by control
//! flow in the same way; here a condition is one partition, not each combination of conditions.)

use std::collections::{HashMap, HashSet, VecDeque};
use std::ops::Range;
use std::rc::Rc;

use gcheck_diagnostics::{Certainty, Finding, Severity};
use gcheck_engine::{Assumption, At, Branch, Choice, FlowObserver, Parting, Program};
use gcheck_program::{BinaryOp, BlockTable, ExprIx, Op, Place, StatementKind};

use crate::collector::Collector;
use crate::memories::Memories;
use crate::watchers::{Watchers, shows_to_watchers};
use crate::{Environment, RuleEntry, RuleTable};

/// Ways of all conditions that are followed by themselves.
const MOST: usize = 64;
/// Ways of one condition that are followed by themselves: a computed jump may have hundreds.
const MOST_WAYS: usize = 8;
/// Work, in blocks, that they may take together after their conditions, beside a share of what the analysis of all paths took.
const WORK: u64 = 20_000;
/// One part of so many is that share.
const SHARE: u64 = 4;

/// A way that is to be followed by itself.
#[derive(Debug)]
pub(crate) struct Partition {
    /// The choices that lead to it.
    pub(crate) choices: Vec<Choice>,
    /// The work that an analysis from the beginning does to come to the last of them.
    pub(crate) begins: u64,
    /// Where it begins, and what the rules remember there; `None`: at the beginning of the program.
    pub(crate) from: Option<(Branch, Rc<Memories>)>,
}

/// The ways that are still to be followed.
#[derive(Debug, Default)]
pub(crate) struct Partitions {
    waiting: VecDeque<Partition>,
    seen: HashSet<At>,
    /// How many have been followed.
    followed: usize,
    left_out: bool,
}

impl Partitions {
    /// An analysis that made these choices came by these partings.
    pub(crate) fn add(&mut self, choices: &[Choice], partings: impl IntoIterator<Item = Parting>) {
        for Parting { at, ways, work } in partings {
            if !self.seen.insert(at) {
                continue;
            }
            self.left_out |= ways > MOST_WAYS;
            let partition = |way| Partition {
                choices: [choices, &[Choice { at, way }]].concat(),
                begins: work,
                from: None,
            };
            self.waiting.extend((0..ways.min(MOST_WAYS)).map(partition));
        }
    }

    /// Ways of the condition at a block that are kept as branches, one more than are followed where there are more.
    fn wanted(&self, at: At) -> usize {
        let is_wanted = !self.seen.contains(&at) && self.followed + self.waiting.len() < MOST;
        if is_wanted { MOST_WAYS + 1 } else { 0 }
    }

    /// An analysis that made these choices came by a condition with these ways.
    fn add_branches(&mut self, choices: &[Choice], branches: Vec<Branch>, memories: Memories) {
        let Some(first) = branches.first() else { return };
        self.seen.insert(first.choice().at);
        self.left_out |= branches.len() > MOST_WAYS;
        let memories = Rc::new(memories);
        self.waiting.extend(branches.into_iter().take(MOST_WAYS).map(|branch| Partition {
            choices: [choices, &[branch.choice()]].concat(),
            begins: branch.work(),
            from: Some((branch, Rc::clone(&memories))),
        }));
    }

    /// The next way.
    pub(crate) fn next(&mut self) -> Option<Partition> {
        if self.followed == MOST {
            self.leave_rest();
        }
        let next = self.waiting.pop_front()?;
        self.followed += 1;
        Some(next)
    }

    /// No more of them are followed.
    pub(crate) fn leave_rest(&mut self) {
        self.left_out |= !self.waiting.is_empty();
        self.waiting.clear();
    }

    /// Were some of them not followed by themselves?
    pub(crate) fn left_some_out(&self) -> bool {
        self.left_out
    }

    /// The work that may be done on all of them, after so much on all paths.
    pub(crate) fn work(all_paths: u64) -> u64 {
        (all_paths / SHARE).saturating_add(WORK)
    }
}

/// Lets the rules watch, and keeps the ways of conditions from where they begin.
pub(crate) struct Follower<'f, 'a, 'c> {
    pub(crate) watchers: &'f mut Watchers<'a, 'c>,
    pub(crate) partitions: &'f mut Partitions,
    /// The choices made so far.
    pub(crate) choices: &'f [Choice],
    /// All rules say what they remember, so that a way can be followed from where it begins.
    pub(crate) keeps: bool,
}

impl FlowObserver for Follower<'_, '_, '_> {
    shows_to_watchers!();

    fn wanted_branches(&self, at: At) -> usize {
        if self.keeps { self.partitions.wanted(at) } else { 0 }
    }

    fn branches(&mut self, branches: Vec<Branch>) {
        self.partitions.add_branches(self.choices, branches, Memories::of(self.watchers));
    }
}

/// What was reported for all paths: the same is not reported again for some.
#[derive(Debug, Default)]
pub(crate) struct Told(HashMap<(&'static str, u32), Known>);

/// How much is known of a finding that was reported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Known {
    /// When it holds, or that it does on all paths.
    Case,
    /// That it holds on some path.
    SomePath,
}

impl Told {
    /// Notes a finding of the analysis of all paths.
    pub(crate) fn note(&mut self, finding: &Finding) {
        let known = if is_on_some_path(finding) { Known::SomePath } else { Known::Case };
        self.0.insert((stem(finding.rule.id), finding.range.start), known);
    }

    /// Adds what is found in one case: a new finding, or the case to one that holds on some path.
    pub(crate) fn add(
        &mut self,
        case: &Case,
        (severity, finding): (Option<Severity>, Finding),
        rules: Rules<'_>,
        collector: &mut Collector<'_>,
    ) {
        let place = (stem(finding.rule.id), finding.range.start);
        match self.0.get(&place) {
            None => {
                if let Some((severity, finding)) = case.of(severity, finding, rules) {
                    self.0.insert(place, Known::Case);
                    collector.add(severity, finding);
                }
            }
            // Here it is certain: this is the case.
            Some(Known::SomePath) if !is_on_some_path(&finding) => {
                if let Some((_, named)) = case.of(severity, finding, rules) {
                    self.0.insert(place, Known::Case);
                    let is_it = |other: &Finding| (stem(other.rule.id), other.range.start) == place;
                    collector.change(is_it, |known| Finding { severity: known.severity, ..named });
                }
            }
            Some(_) => {}
        }
    }
}

/// Is the finding one of a rule for what holds on some paths only? An analysis of one case may say more of it.
pub(crate) fn is_on_some_path(finding: &Finding) -> bool {
    stem(finding.rule.id) != finding.rule.id
}

/// The name that a rule shares with the one for the same on some paths.
fn stem(id: &'static str) -> &'static str {
    id.strip_prefix("maybe-").unwrap_or(id)
}

/// What an analysis took for granted that another may not, in words.
#[derive(Debug)]
pub(crate) struct Case {
    conditions: Vec<Condition>,
}

/// Something on which a case rests.
#[derive(Debug)]
struct Condition {
    /// In words that follow "when".
    when: String,
    shown: Shown,
}

/// How a finding shows a condition beside naming it.
#[derive(Debug)]
enum Shown {
    /// It marks the bytes of the file that decide.
    Marked(Range<u32>),
    /// It says in a note what no place of the file shows.
    Noted(String),
}

impl Case {
    /// The case of some choices.
    pub(crate) fn new(choices: &[Choice], program: &Program<'_>, environment: Environment<'_>) -> Self {
        Self { conditions: choices.iter().map(|choice| condition(*choice, program, environment)).collect() }
    }

    /// The case that programs which are not here leave what the file sets as it was; `None` if it calls no such program.
    pub(crate) fn of_missing_programs<'p>(
        assumptions: impl IntoIterator<Item = &'p Assumption>,
    ) -> Option<Self> {
        let name = |assumption: &'p Assumption| match assumption {
            Assumption::MissingProgram(number) => Some(format!("program {number}")),
            Assumption::MissingSubroutine(name) => Some(format!("the subroutine `{name}`")),
            _ => None,
        };
        let missing: Vec<String> = assumptions.into_iter().filter_map(name).collect();
        let (when, note) = match missing.as_slice() {
            [] => return None,
            [only] => (
                format!("{only} leaves it so"),
                format!("{only} was not found: what it changes is not known"),
            ),
            [first, others @ ..] => (
                "the programs that are not here leave it so".to_owned(),
                format!("{first} and {} more were not found: what they change is not known", others.len()),
            ),
        };
        Some(Self { conditions: vec![Condition { when, shown: Shown::Noted(note) }] })
    }

    /// The finding as one that holds in this case only, with the severity that the user gave its rule; `None` when that is not
    /// worth saying, or the rule for it is off.
    fn of(
        &self,
        severity: Option<Severity>,
        mut finding: Finding,
        rules: Rules<'_>,
    ) -> Option<(Option<Severity>, Finding)> {
        let milder = match finding.severity {
            Severity::Error => Severity::Warning,
            Severity::Warning => Severity::Info,
            Severity::Info | Severity::Hint => return None,
        };
        finding.severity = milder;
        let mut overridden = severity;
        if let Some(entry) = rules.table.by_id(&format!("maybe-{}", finding.rule.id)) {
            let (_, severity) = rules.active.iter().find(|(rule, _)| rule.meta.id == entry.meta.id)?;
            finding.rule = entry.meta;
            finding.severity = milder.at_most(entry.meta.severity);
            overridden = *severity;
        }
        finding.certainty = Certainty::Maybe;
        // What helps on one path may harm on another.
        finding.fixes.clear();
        let cases: Vec<&str> = self.conditions.iter().map(|condition| condition.when.as_str()).collect();
        finding.message = format!("{}, when {}", finding.message, cases.join(" and "));
        for Condition { when, shown } in &self.conditions {
            finding = match shown {
                Shown::Marked(range) => finding.also(range.clone(), format!("when {when}")),
                Shown::Noted(note) => finding.note(note.clone()),
            };
        }
        Some((overridden, finding))
    }
}

/// The rules of the path tier.
#[derive(Clone, Copy)]
pub(crate) struct Rules<'r> {
    /// All rules that there are.
    pub(crate) table: RuleTable,
    /// Those that are on, with the severity that the user gave them.
    pub(crate) active: &'r [(&'static RuleEntry, Option<Severity>)],
}

fn condition(choice: Choice, program: &Program<'_>, environment: Environment<'_>) -> Condition {
    let elsewhere = |when: String| {
        let note = format!("the condition is in another file: {when}");
        Condition { when, shown: Shown::Noted(note) }
    };
    let unnamed = || elsewhere("one of several ways is taken".to_owned());
    let Some(file) = program.file(choice.at.file) else { return unnamed() };
    let Some(place) = file.loaded.place(choice.at.block, environment.dialect) else { return unnamed() };
    let text = |range: &Range<u32>| {
        file.loaded.slice(place.base + range.start..place.base + range.end).trim().to_owned()
    };
    let when = match decided(&place) {
        Some((condition, when_holds)) => {
            let holds = (choice.way == 0) == (when_holds == 0);
            comparison(&place.table, condition, holds, &text).unwrap_or_else(|| {
                let all = text(&place.table.expr(condition).range);
                format!("`{all}` {}", if holds { "holds" } else { "does not hold" })
            })
        }
        None => format!("way {} of `{}` is taken", choice.way + 1, text(&place.block().range)),
    };
    if choice.at.file == 0 {
        Condition { when, shown: Shown::Marked(place.range()) }
    } else {
        elsewhere(when)
    }
}

/// The condition that a block decides by, and which way it leads when it holds.
fn decided(place: &Place) -> Option<(ExprIx, usize)> {
    place.table.statements(place.ix).find_map(|statement| match &statement.kind {
        StatementKind::If { condition } | StatementKind::Guard { condition } => Some(((*condition)?, 1)),
        StatementKind::Do { condition, .. } => Some(((*condition)?, 0)),
        StatementKind::OWord { arguments, .. } => {
            let first = StatementKind::arguments(arguments).next()?;
            Some((first, 0))
        }
        _ => None,
    })
}

/// "`#500` is not 1": a comparison of two sides that have no operator of their own.
fn comparison(
    table: &BlockTable,
    condition: ExprIx,
    holds: bool,
    text: &impl Fn(&Range<u32>) -> String,
) -> Option<String> {
    let expr = table.expr(condition);
    let [left @ (Op::Variable(_) | Op::Named { .. }), right @ .., Op::Binary(op)] = table.ops(expr) else {
        return None;
    };
    let left = match left {
        Op::Named { start, end } => format!("#<{}>", text(&(*start..*end))),
        Op::Variable(number) => format!("#{number}"),
        _ => return None,
    };
    let right = match right {
        [Op::Number(number)] => number.to_string(),
        [Op::Number(number), Op::Negate] => format!("-{number}"),
        [Op::Variable(0)] => "empty".to_owned(),
        [Op::Variable(number)] => format!("`#{number}`"),
        _ => return None,
    };
    let relation = match (op, holds) {
        (BinaryOp::Equal, true) | (BinaryOp::NotEqual, false) => "is",
        (BinaryOp::Equal, false) | (BinaryOp::NotEqual, true) => "is not",
        (BinaryOp::Greater, true) | (BinaryOp::LessEqual, false) => "is greater than",
        (BinaryOp::GreaterEqual, true) | (BinaryOp::Less, false) => "is not less than",
        (BinaryOp::Less, true) | (BinaryOp::GreaterEqual, false) => "is less than",
        (BinaryOp::LessEqual, true) | (BinaryOp::Greater, false) => "is not greater than",
        _ => return None,
    };
    Some(format!("`{left}` {relation} {right}"))
}
