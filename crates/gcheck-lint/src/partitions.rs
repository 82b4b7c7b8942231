//! Paths kept apart by the way that they take at one condition, also after they meet again.
//!
//! Knows: which further analyses a program is worth, how a finding of one of them names its condition. Must not know: any rule,
//! how paths are followed.
//!
//! The analysis of all paths joins states where paths meet, and what only one of them brings is unknown from there on. So each
//! way of the first conditions is followed once more by itself: what is certain there holds on some paths of the program.
//! (Mauborgne and Rival, "Trace Partitioning in Abstract Interpretation Based Static Analyzers", ESOP 2005, partition by control
//! flow in the same way; here a condition is one partition, not each combination of conditions.)

use std::collections::{HashSet, VecDeque};
use std::ops::Range;

use gcheck_diagnostics::{Certainty, Finding, Severity};
use gcheck_engine::{At, Choice, Parting, Program};
use gcheck_program::{BinaryOp, BlockTable, ExprIx, Op, Place, StatementKind};

use crate::{Environment, RuleEntry, RuleTable};

/// Ways of all conditions that are followed by themselves.
const MOST: usize = 64;
/// Ways of one condition that are followed by themselves: a computed jump may have hundreds.
const MOST_WAYS: usize = 8;
/// Work, in blocks, that they may take together beside as much as the analysis of all paths took.
const WORK: u64 = 100_000;

/// The ways that are still to be followed.
#[derive(Debug, Default)]
pub(crate) struct Partitions {
    waiting: VecDeque<Vec<Choice>>,
    seen: HashSet<At>,
    /// How many have been followed.
    followed: usize,
    left_out: bool,
}

impl Partitions {
    /// An analysis that made these choices came by these partings.
    pub(crate) fn add(&mut self, choices: &[Choice], partings: impl IntoIterator<Item = Parting>) {
        for Parting { at, ways } in partings {
            if !self.seen.insert(at) {
                continue;
            }
            self.left_out |= ways > MOST_WAYS;
            self.waiting
                .extend((0..ways.min(MOST_WAYS)).map(|way| [choices, &[Choice { at, way }]].concat()));
        }
    }

    /// The next way, as the choices that lead to it.
    pub(crate) fn next(&mut self) -> Option<Vec<Choice>> {
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
        all_paths.saturating_add(WORK)
    }
}

/// What was reported for all paths: the same is not reported again for some.
#[derive(Debug, Default)]
pub(crate) struct Told(HashSet<(&'static str, u32)>);

impl Told {
    /// Notes a finding.
    pub(crate) fn note(&mut self, finding: &Finding) {
        self.0.insert((stem(finding.rule.id), finding.range.start));
    }

    /// Was the like reported at this place?
    pub(crate) fn has(&self, finding: &Finding) -> bool {
        self.0.contains(&(stem(finding.rule.id), finding.range.start))
    }
}

/// The name that a rule shares with the one for the same on some paths.
fn stem(id: &'static str) -> &'static str {
    id.strip_prefix("maybe-").unwrap_or(id)
}

/// The ways that an analysis took, in words.
#[derive(Debug)]
pub(crate) struct Case {
    /// Where each condition is, if it is in the file; when that way is taken.
    conditions: Vec<(Option<Range<u32>>, String)>,
}

impl Case {
    /// The case of some choices.
    pub(crate) fn new(choices: &[Choice], program: &Program<'_>, environment: Environment<'_>) -> Self {
        Self { conditions: choices.iter().map(|choice| condition(*choice, program, environment)).collect() }
    }

    /// The finding as one that holds in this case only, with the severity that the user gave its rule; `None` when that is not
    /// worth saying, or the rule for it is off.
    pub(crate) fn of(
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
        let cases: Vec<&str> = self.conditions.iter().map(|(_, case)| case.as_str()).collect();
        finding.message = format!("{}, when {}", finding.message, cases.join(" and "));
        for (range, case) in &self.conditions {
            finding = match range {
                Some(range) => finding.also(range.clone(), format!("when {case}")),
                None => finding.note(format!("the condition is in another file: {case}")),
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

fn condition(
    choice: Choice,
    program: &Program<'_>,
    environment: Environment<'_>,
) -> (Option<Range<u32>>, String) {
    let unnamed = || (None, "one of several ways is taken".to_owned());
    let Some(file) = program.file(choice.at.file) else { return unnamed() };
    let Some(place) = file.loaded.place(choice.at.block, environment.dialect) else { return unnamed() };
    let text = |range: &Range<u32>| {
        file.loaded.slice(place.base + range.start..place.base + range.end).trim().to_owned()
    };
    let range = (choice.at.file == 0).then(|| place.range());
    let case = match decided(&place) {
        Some((condition, when_holds)) => {
            let holds = (choice.way == 0) == (when_holds == 0);
            comparison(&place.table, condition, holds, &text).unwrap_or_else(|| {
                let all = text(&place.table.expr(condition).range);
                format!("`{all}` {}", if holds { "holds" } else { "does not hold" })
            })
        }
        None => format!("way {} of `{}` is taken", choice.way + 1, text(&place.block().range)),
    };
    (range, case)
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
