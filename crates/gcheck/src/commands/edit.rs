//! `gcheck edit`: changes of a program that are written only with their proof.
//!
//! Knows: which runs a change needs, what becomes of the new text. Must not know: how words are rewritten, when moves are
//! the same.

mod proof;
mod refusing;

use std::collections::BTreeSet;

use gcheck_diagnostics::{Edit, apply_to_bytes};
use gcheck_edit::{Amount, Change, Destination, Refusal, Scope, Witness, assume_places, plan, witness};
use gcheck_engine::{Assumption, Axis, Nobody, Options, Units};
use gcheck_program::BlockFlags;

use crate::args::{
    BlockSkip, Conditions, EditCommand, EditTarget, ExecutionOptions, Global, MirrorAxis, QuarterTurns,
};
use crate::console::{finish, say};
use crate::execution::{self, Prepared, Rests, Session, Start};
use crate::{Problem, discovery, output, paths, rewriting};

/// Runs the command; the exit code is its result.
pub(crate) fn run(global: &Global, command: &EditCommand) -> Result<u8, Problem> {
    let target = command.target();
    let change = change(command)?;
    // Nothing may rest on a control that was just switched on.
    let mut prepared = execution::prepare(global, &execution(target), Start::Any)?;
    let is_dry = target.check || target.diff;
    let is_standard_input = paths::is_standard_input(&target.file);
    if !is_dry && !is_standard_input {
        discovery::refuse_to_leave(&prepared.path, std::slice::from_ref(&target.file))?;
    }
    let scope = scope(target, &prepared)?;
    if matches!(change, Change::Convert(_)) && scope != Scope::All {
        return Err(Problem::new("a program is converted as a whole, as the feed and other words stay in effect from block to block")
            .help("leave out --lines and --tool"));
    }
    let runs = prepared.session(|session| runs(session, target));
    let cutters = assume_cutters(&mut prepared, &runs);
    let planned = match prepared.session(|session| planned(session, command, &change, &scope, &runs)) {
        Ok(planned) => planned,
        Err(problem) => return Ok(refused(&prepared, problem)),
    };
    let before = prepared.source.to_bytes();
    let after = apply_to_bytes(&before, &planned.edits);
    let tolerance = target.tolerance.unwrap_or(change.tolerance());
    // Also where no word changes: the moves may not be as the change says for that very reason.
    let mut proving = prepared.with_text(prepared.source.clone(), prepared.shown.clone());
    let assumes_places = assume_places(&mut proving.equipment.machine, &planned.unknown);
    let asked =
        proof::Asked { change: &change, scope: &scope, tolerance, units: planned.units, assumes_places };
    let proof = match proof::prove(&proving, &after, &asked, &runs) {
        Ok(proof) => proof,
        Err(problem) => {
            let leaves_cycles = change == Change::ExpandCycle && !planned.notes.is_empty();
            let problem = if leaves_cycles {
                problem.help("a cycle that stays may take Z, R or its return level from one that becomes moves: give it words of its own, or select lines with --lines")
            } else {
                problem
            };
            return Ok(refused(&prepared, problem));
        }
    };
    if after == before {
        if is_standard_input && !is_dry {
            output::to_stdout(|out| out.write_all(&before))?;
        }
        if !global.quiet {
            say(&format!("{}: there is nothing to change", prepared.shown));
        }
        return Ok(0);
    }
    if target.diff {
        output::print(&rewriting::difference(&prepared.shown, &before, &after))?;
    } else if target.check {
        output::print(&format!("{}\n", prepared.shown))?;
    } else if is_standard_input {
        output::to_stdout(|out| out.write_all(&after))?;
    } else {
        rewriting::write(&prepared.path, "write the change", &before, &after)?;
    }
    if !global.quiet {
        say(&closing(&asked, &prepared, target, &proof, is_dry));
        for note in planned.notes.iter().chain(&cutters) {
            say(&format!("note: {note}"));
        }
        say(&planned.rests);
    }
    Ok(u8::from(is_dry))
}

/// Nothing is written, and a message says why.
fn refused(prepared: &Prepared, problem: Problem) -> u8 {
    let code = finish(&[problem], 0);
    say(&format!("{}: nothing is changed", prepared.shown));
    code
}

fn execution(target: &EditTarget) -> ExecutionOptions {
    ExecutionOptions {
        file: target.file.clone(),
        conditions: Conditions {
            stdin_filename: target.stdin_filename.clone(),
            set: target.set.clone(),
            block_skip: target.block_skip.unwrap_or(BlockSkip(0)),
            optional_stop: target.optional_stop,
            fuel: target.fuel,
        },
    }
}

fn change(command: &EditCommand) -> Result<Change, Problem> {
    let or_zero = |amount: &Option<Amount>| amount.unwrap_or(Amount::ZERO);
    Ok(match command {
        EditCommand::ScaleFeeds { factor, .. } => Change::ScaleFeeds(*factor),
        EditCommand::ScaleSpeeds { factor, .. } => Change::ScaleSpeeds(*factor),
        EditCommand::Translate { x, y, z, .. } => {
            let by = [x, y, z].map(or_zero);
            if by.iter().all(|amount| amount.number == 0.0) {
                return Err(Problem::new("a shift needs a length that is not zero")
                    .help("write, for example, `gcheck edit translate --x 10 part.nc`"));
            }
            Change::Translate(by)
        }
        EditCommand::Mirror { axis, at, .. } => {
            let axis = match axis {
                MirrorAxis::X => Axis::X,
                MirrorAxis::Y => Axis::Y,
                MirrorAxis::Z => Axis::Z,
            };
            Change::Mirror(axis, or_zero(at))
        }
        EditCommand::Rotate { degrees, about, .. } => {
            let quarters = match degrees {
                QuarterTurns::One => 1,
                QuarterTurns::Two => 2,
                QuarterTurns::Three => 3,
            };
            Change::Rotate(quarters, about.map_or([Amount::ZERO; 2], |about| about.0))
        }
        EditCommand::ExpandCycle { .. } => Change::ExpandCycle,
        EditCommand::FoldCycle { .. } => Change::FoldCycle,
        EditCommand::UnrollLoop { .. } => Change::UnrollLoop,
        EditCommand::Absolute { .. } => Change::Absolute,
        EditCommand::Incremental { .. } => Change::Incremental,
        EditCommand::SafeStart { .. } => Change::SafeStart,
        EditCommand::Mm { .. } => Change::Convert(Units::Mm),
        EditCommand::Inch { .. } => Change::Convert(Units::Inch),
        EditCommand::MoveSection { before, after, down, .. } => {
            Change::MoveSection(match (before, after, down) {
                (Some(tool), _, _) => Destination::Before(*tool),
                (_, Some(tool), _) => Destination::After(*tool),
                (_, _, true) => Destination::Down,
                _ => Destination::Up,
            })
        }
        EditCommand::Renumber { .. } => Change::Renumber,
    })
}

fn scope(target: &EditTarget, prepared: &Prepared) -> Result<Scope, Problem> {
    let text = prepared.source.text();
    let Some(lines) = target.lines else { return Ok(target.tool.map_or(Scope::All, Scope::Tool)) };
    let count = text.lines().count();
    if lines.first as usize > count {
        return Err(Problem::with_file(
            &prepared.path,
            format!("has {count} lines; line {} does not exist", lines.first),
        ));
    }
    Ok(Scope::lines(text, lines.first, lines.last))
}

/// A change that is to be proved.
struct Planned {
    edits: Vec<Edit>,
    notes: Vec<String>,
    /// What the runs rest on, as text.
    rests: String,
    /// What the runs rest on.
    unknown: BTreeSet<Assumption>,
    /// The units in which messages show lengths.
    units: Units,
}

/// Runs the program and makes the edits.
fn planned(
    session: &Session<'_>,
    command: &EditCommand,
    change: &Change,
    scope: &Scope,
    runs: &[Options],
) -> Result<Planned, Problem> {
    let prepared = session.prepared;
    let machine = &prepared.equipment.machine;
    let mut seen = Witness::new(change, scope, session.model);
    let mut rests = String::new();
    let mut unknown = BTreeSet::new();
    for options in runs {
        let ran =
            witness(&mut seen, session.program, session.model, machine, *options, prepared.fuel(), scope);
        if let Some(fault) = execution::fault_of(session, &ran) {
            let problem = execution::problem_of(&fault);
            return Err(problem.note(format!(
                "nothing is proved of a run that ends early, so gcheck cannot {}",
                change.verb()
            )));
        }
        if let Some(gap) = gap(session, &ran.assumptions) {
            return Err(Problem::with_file(&prepared.path, format!("cannot {}: {gap}", change.verb())));
        }
        rests = Rests::new(session, &ran).text();
        unknown.extend(ran.assumptions);
    }
    let refusal = |refusal: &Refusal| refusing::problem(prepared, change, refusal);
    let (edits, notes) = if let EditCommand::Renumber { numbering, .. } = command {
        if *scope != Scope::All {
            return Err(Problem::new("blocks are renumbered in the whole file, as jumps lead everywhere")
                .help("leave out --lines and --tool"));
        }
        let edits = gcheck_format::renumber(prepared.source.text(), session.program.dialect(), numbering);
        let edits =
            edits.map_err(|refused| refusal(&Refusal::at(refused.range.clone(), refused.to_string())))?;
        (edits, Vec::new())
    } else {
        let plan = plan(change, scope, &seen, session.program, session.model, machine)
            .map_err(|error| refusal(&error))?;
        (plan.edits, plan.notes)
    };
    let units = seen.units().unwrap_or(prepared.equipment.units);
    Ok(Planned { edits, notes, rests: rests.trim_end().to_owned(), unknown, units })
}

/// The switches that a change is proved for: as told, else block delete off and, where a block has one, also on.
fn runs(session: &Session<'_>, target: &EditTarget) -> Vec<Options> {
    let first = session.prepared.options();
    let dialect = session.program.dialect();
    let has_slash = session
        .program
        .file(0)
        .is_some_and(|file| file.loaded.blocks_with(BlockFlags::BLOCK_DELETE, dialect).next().is_some());
    let mut runs = vec![first];
    if target.block_skip.is_none() && has_slash {
        runs.push(Options { skip: u16::MAX, ..first });
    }
    runs
}

/// Gives cutters of unknown size a small one, so that the path beside the programmed one is compared as well; says so.
fn assume_cutters(prepared: &mut Prepared, runs: &[Options]) -> Option<String> {
    let mut assumed = BTreeSet::new();
    for options in runs {
        let unknown = prepared.session(|session| {
            let machine = &prepared.equipment.machine;
            gcheck_engine::run(session.program, session.model, machine, *options, prepared.fuel(), Nobody)
                .assumptions
        });
        assumed.extend(gcheck_edit::assume_cutters(&mut prepared.equipment.machine, &unknown));
    }
    let names: Vec<String> = assumed.iter().map(ToString::to_string).collect();
    (!names.is_empty()).then(|| {
        format!(
            "the size of cutter {} is not known; the proof takes a radius of {} mm",
            names.join(", "),
            gcheck_edit::ASSUMED_RADIUS.0
        )
    })
}

/// A part of the program's work that a run does not show.
fn gap(session: &Session<'_>, assumptions: &BTreeSet<Assumption>) -> Option<String> {
    let gaps = gcheck_edit::gaps(assumptions);
    let first = gcheck_lint::describe_all(&gaps, session.model).into_iter().next()?;
    Some(format!("the proof would have a gap, as {}", first.text))
}

/// What was done and what is proved, in one line.
fn closing(
    asked: &proof::Asked<'_>,
    prepared: &Prepared,
    target: &EditTarget,
    proof: &proof::Proof,
    is_dry: bool,
) -> String {
    let part = match (target.lines, target.tool) {
        _ if asked.change.keeps_moves() => String::new(),
        (Some(lines), _) if lines.first == lines.last => format!("in line {} ", lines.first),
        (Some(lines), _) => format!("in lines {} to {} ", lines.first, lines.last),
        (None, Some(tool)) => format!("with T{tool} "),
        (None, None) => String::new(),
    };
    let rest = if part.is_empty() { "" } else { ", and every other move is as before" };
    let switches = if proof.runs > 1 { ", with block delete off and on" } else { "" };
    format!(
        "{}: {} for {}: {part}{}{rest}, within {} mm ({} compared{switches})",
        prepared.shown,
        if is_dry { "would change" } else { "changed" },
        prepared.chosen.choice.name,
        asked.change.claim(),
        asked.tolerance,
        if proof.moves == 1 { "1 move".to_owned() } else { format!("{} moves", proof.moves) },
    )
}
