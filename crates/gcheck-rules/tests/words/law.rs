//! A law: where a run stops, a check has a finding.
//!
//! Knows: how a program is run past its alarms, which faults do not concern the program. Must not know: any rule.

use std::collections::BTreeMap;

use gcheck_controls::Control;
use gcheck_engine::{Fault, Machine, Model, NoLibrary, Nobody, Options, Program, run};
use gcheck_program::{Dialect, Loaded};

use crate::judge::Judge;

/// Blocks that a run executes at most.
const FUEL: u64 = 20_000;

/// Faults that a check does not report on their line: the control, how the fault begins, what its place contains, and why.
///
/// "Open" is a gap of the check that nobody has closed.
const EXCEPTIONS: &str = include_str!("exceptions.tsv");

/// Faults without a finding: the fault, the block, and a program that has it, with how often each was met.
pub(crate) type Misses = BTreeMap<String, (usize, String)>;

/// Adds the faults of one program that a check does not report.
pub(crate) fn add(misses: &mut Misses, control: &Control, judge: &Judge<'_>, name: &str, text: &str) {
    let faults = faults_of(control, text);
    if faults.is_empty() {
        return;
    }
    // What is left out of a long list may be at any line.
    let Some(lines) = judge.lines(text) else { return };
    for (line, fault) in faults {
        let is_known = is_exception(control.name(), &format!("{fault:?}"), name);
        if !lines.contains(&line) && !is_known {
            let block = text.lines().nth(line).unwrap_or_default().trim();
            let entry = misses.entry(format!("{} {fault:?}", control.name()));
            let (count, _) = entry.or_insert_with(|| (0, format!("{name}:{}: {block}", line + 1)));
            *count += 1;
        }
    }
}

fn is_exception(control: &str, fault: &str, place: &str) -> bool {
    EXCEPTIONS.lines().skip(1).any(|line| {
        let fields: Vec<&str> = line.split('\t').collect();
        fields[0] == control && fault.starts_with(fields[1]) && place.contains(fields[2])
    })
}

/// The faults of a run that goes past them, each with its line from 0.
fn faults_of(control: &Control, text: &str) -> Vec<(usize, Fault)> {
    let dialect = Dialect::new(control);
    let model = Model::new(control);
    let loaded = Loaded::new(text, &dialect, |_, _, _| {});
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let options = Options { past_alarms: true, ..Options::NONE };
    let result = run(&program, &model, &Machine::default(), options, FUEL, Nobody);
    let here = result.alarms.into_iter().filter(|alarm| alarm.origin.at.file == 0 && !is_open(&alarm.fault));
    here.map(|alarm| (text[..alarm.origin.start as usize].matches('\n').count(), alarm.fault)).collect()
}

/// What depends on something that is not configured is a question to the user, and an alarm of the program's own is what it
/// means to do: neither is a mistake of the program.
fn is_open(fault: &Fault) -> bool {
    matches!(fault, Fault::Undecidable | Fault::Alarm(_))
}
