//! Probing and measuring codes: which block has one, and in which modes it runs.
//!
//! Knows: effects of codes that touch with a probe, modes as a block has them while it moves. Must not know: any rule.

use gcheck_controls::{Code, CodeIx, CodeNumber, Effect, Letter, SystemValue};
use gcheck_engine::{Abstract, At, Axis, Domain, Event, Role, TravelKind, Way, Ways};
use gcheck_program::{BlockFlags, Op};

use crate::{Finding, PathCx, Severity, limit};

/// The code of the block that touches or measures, but for the probing modes of motion.
pub(crate) fn probing_code(cx: &PathCx<'_>) -> Option<CodeIx> {
    if !cx.has_effect(is_touch) {
        return None;
    }
    cx.codes().iter().copied().find(|code| is_touch(cx.model.effect(*code)))
}

/// Blocks around a touch that go to it and away from it.
const NEAR: u32 = 12;

/// Does a block near this one have a code that `is` says yes to, with no tool change and no start of the spindle between
/// them? Feed moves around a touch go to it and away from it, and cut nothing.
pub(crate) fn is_near(cx: &PathCx<'_>, is: impl Fn(Effect) -> bool) -> bool {
    let here = cx.origin().at;
    let is_there = |block: u32| {
        let place = cx.place_of(At { block, ..here })?;
        let codes = place.table.words(place.block()).iter().map(|word| cx.model.effect(word.code));
        let mut parts = false;
        for effect in codes {
            if is(effect) {
                return Some(true);
            }
            parts |= parts_sections(effect);
        }
        parts.then_some(false)
    };
    let first = here.block.saturating_sub(NEAR);
    let before = (first..=here.block).rev().find_map(is_there);
    let behind = (here.block + 1..=here.block.saturating_add(NEAR)).find_map(is_there);
    before == Some(true) || behind == Some(true)
}

/// What follows belongs to another operation.
fn parts_sections(effect: Effect) -> bool {
    effect == Effect::ToolChange || effect.starts_spindle()
}

/// Does a code with this effect move until the probe answers?
pub(crate) fn is_touch(effect: Effect) -> bool {
    effect == Effect::Skip || is_measurement(effect)
}

/// Does it write what was touched into a table?
pub(crate) fn is_measurement(effect: Effect) -> bool {
    is_second_touch(effect) || matches!(effect, Effect::ProbeOffset | Effect::ProbeLength)
}

/// Does it measure between a touch kept before and its own?
pub(crate) fn is_second_touch(effect: Effect) -> bool {
    matches!(effect, Effect::ProbeDiameter | Effect::ProbeCentre)
}

/// Axes that a probing move drives, or may drive, with the way along each.
pub(crate) fn driven(ways: Ways) -> impl Iterator<Item = (Axis, Way)> {
    Axis::ALL.into_iter().map(move |axis| (axis, ways.of(axis))).filter(|(_, way)| *way != Way::Still)
}

/// Does it move until something is touched, or until it is let go, and measure nothing by itself?
pub(crate) fn probes(effect: Effect) -> bool {
    effect == Effect::Skip || effect.is_probing_move()
}

/// Does it touch the work with a probe, whatever comes of it?
pub(crate) fn touches_work(effect: Effect) -> bool {
    effect.is_probing_move() || is_touch(effect)
}

/// The variables that the block reads; `None` for one whose number is computed.
pub(crate) fn reads(cx: &PathCx<'_>) -> Vec<Option<u32>> {
    if !cx.origin().flags.intersects(BlockFlags::EXPRESSION | BlockFlags::STATEMENT) {
        return Vec::new();
    }
    let Some((table, expressions)) = cx.expressions() else { return Vec::new() };
    let ops = expressions.iter().flat_map(|expr| table.ops(table.expr(*expr)));
    let read = ops.filter_map(|op| match op {
        Op::Variable(number) => Some(Some(*number)),
        Op::Indirect => Some(None),
        _ => None,
    });
    read.collect()
}

/// Which of the variables that hold this the number is, counted from the first; `None` for a variable that holds something else.
pub(crate) fn column_of(cx: &PathCx<'_>, number: u32, value: SystemValue) -> Option<u32> {
    let variables = &cx.control().semantics().system_variables;
    let mut holding = variables.iter().filter(|variable| variable.holds == value);
    holding.find_map(|variable| Some(variable.cell(number)?.1))
}

/// Is the move one that the probe ends?
pub(crate) fn is_probing_move(event: &Event) -> bool {
    matches!(event, Event::Travel(travel) if matches!(travel.kind, TravelKind::Probe { .. }))
}

/// The code that keeps a touch, as programs write it.
pub(crate) fn keeping_code(cx: &PathCx<'_>) -> String {
    cx.name_of_effect(Effect::KeepTouch).unwrap_or_default()
}

/// What the probing code of a block asks of a mode.
pub(crate) struct ModeDemand<'a> {
    pub(crate) role: Role,
    pub(crate) code: Code<'a>,
    /// The highest severity: what the data only recommends is not an error.
    pub(crate) most: Severity,
    /// Is this code the wrong one to have in effect?
    pub(crate) is_wrong: Box<dyn Fn(CodeIx) -> bool + 'a>,
}

/// The modes that the probing code of the block requires and forbids, as the control's data states them.
pub(crate) fn mode_demands<'a>(cx: &'a PathCx<'a>) -> Vec<ModeDemand<'a>> {
    let Some(code) = probing_code(cx).and_then(|ix| cx.code_of(ix)) else { return Vec::new() };
    let of_name = |name: &str| {
        let ix = cx.control().code_ix(CodeNumber::parse(name)?);
        Some((ix, cx.model.role(ix)?))
    };
    let entry = code.entry();
    let demand = |name: &str, most: Severity| {
        let (wanted, role) = of_name(name)?;
        let wanted = cx.model.effect(wanted);
        let is_wrong = move |mode: CodeIx| {
            let effect = cx.model.effect(mode);
            let is_off = role == Role::Length && has_no_length(cx);
            mode.is_some() && effect != wanted && effect != Effect::None && !is_off
        };
        Some(ModeDemand { role, code, most, is_wrong: Box::new(is_wrong) })
    };
    let required = entry.requires.iter().filter_map(|name| demand(name, Severity::Error));
    let recommended = entry.recommends.iter().filter_map(|name| demand(name, Severity::Warning));
    let recommended = recommended.filter(|demand| matches!(demand.role, Role::Compensation | Role::Length));
    let forbidden =
        entry.forbids.iter().filter_map(|name| of_name(name)).map(|(unwanted, role)| ModeDemand {
            role,
            code,
            most: Severity::Error,
            is_wrong: Box::new(move |mode: CodeIx| mode == unwanted),
        });
    required.chain(recommended).chain(forbidden).collect()
}

/// `G43 H0` is not a length; `G43` without any `H` takes one that the last program left.
fn has_no_length(cx: &PathCx<'_>) -> bool {
    !cx.origin().letters.contains(Letter::of('H'))
        && Abstract::known(cx.state().h()).is_some_and(|h| h.abs() < 0.5)
        && cx.state().length().get(Axis::Z) == Some(0.0)
}

/// The words of a finding about a mode.
pub(crate) fn mode_finding(
    mut finding: Finding,
    role: Role,
    code: Code<'_>,
    mode: &str,
    cx: &PathCx<'_>,
) -> Finding {
    let (name, entry) = (code.number().to_string(), code.entry());
    let range = cx.word_range(|word| cx.code_of(word.code).is_some_and(|of| of.number() == code.number()));
    let (what, label, help) = match (role, code.effect()) {
        (Role::Compensation, _) => (
            "probing with cutter compensation on",
            "the path of a probe cannot be offset",
            "switch compensation off (`G40`) with a move away from the part before it",
        ),
        (Role::Length, Effect::ProbeLength) => (
            "tool length measured with no length in effect",
            "measures the length in effect, and none is",
            "switch the length on before it: `G43 H…` with the offset that is measured",
        ),
        (Role::Length, _) => (
            "work offset measured with a tool length on",
            if cx.origin().letters.contains(Letter::of('Z')) {
                "the tool's length would go into the work offset"
            } else {
                "the control refuses it with a length in effect"
            },
            "switch the length off (`G49`) before it",
        ),
        _ => {
            ("probing in a mode it does not work in", "refused in this mode", "switch the mode off before it")
        }
    };
    finding.range = range;
    finding.message = format!("{what} (`{mode}`)");
    finding
        .label(label)
        .note(format!("`{name}` ({}) must not run in this mode  [{}]", entry.title, entry.source))
        .help(help)
        .at_most(limit(entry.confidence))
}
