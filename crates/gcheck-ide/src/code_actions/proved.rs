//! Changes of the path, the feeds and the form of a program, each made only with its proof.
//!
//! Knows: which of them fit a place, how a change of a document is proved. Must not know: how words are rewritten, when moves are
//! the same.
//!
//! A proof takes runs of the program, so that a list names the changes only, and the one that a person chooses is proved then.

use std::collections::BTreeSet;
use std::convert::Infallible;
use std::ops::Range;

use gcheck_controls::{Effect, Machine as MachineKind};
use gcheck_db::{Cancelled, Snapshot};
use gcheck_diagnostics::{Edit, apply};
use gcheck_edit::{
    Amount, Change, Destination, Holder, Refusal, Scope, Witness, assume_cutters, assume_places, expected,
    gaps, hold, is_as_claimed, is_moves_and_dwells, plainly, plan, witness,
};
use gcheck_engine::{Assumption, Axis, Ending, Machine, Options, Role, RunResult, Stopped, Units};
use gcheck_format::{Numbering, renumber};
use gcheck_toolpath::{Act, Aspect, Differences};

use super::cycles::cycle_at;
use crate::sections::sections;

/// Acts of a run that are kept; of longer programs the command line proves changes.
const MOST_ACTS: usize = 200_000;
/// Bytes of a document whose changes are offered.
const MOST_BYTES: u32 = 4 << 20;

/// The changes that need no figures: their names and titles.
pub const PROVED: [(&str, &str); 19] = [
    ("expand-cycle", "Write canned cycles as plain moves"),
    ("fold-cycle", "Write drilled holes as canned cycles"),
    ("unroll-loop", "Write loops turn by turn"),
    ("absolute", "Write increments as absolute coordinates"),
    ("incremental", "Write absolute coordinates as increments"),
    ("mm", "Write the program in millimetres"),
    ("inch", "Write the program in inches"),
    ("safe-start", "Insert safe start lines in front of tool changes"),
    ("section-up", "Move this tool section up"),
    ("section-down", "Move this tool section down"),
    ("feeds-90", "Scale the feeds to 90 %"),
    ("feeds-110", "Scale the feeds to 110 %"),
    ("speeds-90", "Scale the spindle speeds to 90 %"),
    ("speeds-110", "Scale the spindle speeds to 110 %"),
    ("mirror-x", "Mirror the path at X0 (climb milling becomes conventional)"),
    ("mirror-y", "Mirror the path at Y0 (climb milling becomes conventional)"),
    ("rotate-90", "Rotate the path by 90° about X0 Y0"),
    ("rotate-180", "Rotate the path by 180° about X0 Y0"),
    ("rotate-270", "Rotate the path by 270° about X0 Y0"),
];
/// Changes that ask for figures: their names and titles.
pub const WITH_FIGURES: [(&str, &str); 2] =
    [("translate", "Shift the path"), ("renumber", "Number the blocks again")];

/// A change that is offered, and proved when it is chosen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProvedChange {
    /// What it does, imperative.
    pub title: String,
    /// Its name for [`proved`].
    pub name: &'static str,
    /// Bytes that it changes; the whole document without them.
    pub range: Option<Range<u32>>,
}

/// A change with its proof.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Proved {
    /// Edits of the document; empty where there is nothing to change.
    pub edits: Vec<Edit>,
    /// What is proved, a sentence without a capital and a full stop.
    pub claim: String,
}

/// The change that fits the block at the cursor.
pub fn proved_change_at(snapshot: &Snapshot, cursor: u32) -> Option<ProvedChange> {
    if snapshot.len() > MOST_BYTES {
        return None;
    }
    let range = cycle_at(snapshot, cursor)?;
    let title = "Write this cycle as plain moves, with proof".to_owned();
    Some(ProvedChange { title, name: "expand-cycle", range: Some(range) })
}

/// The changes that may fit a selection, or the whole document when nothing is selected.
pub fn proved_changes(snapshot: &Snapshot, selected: &Range<u32>) -> Vec<ProvedChange> {
    if snapshot.len() > MOST_BYTES || snapshot.file_index().blocks == 0 {
        return Vec::new();
    }
    let range = (!selected.is_empty()).then(|| whole_lines(snapshot, selected));
    let part = if range.is_some() { " in the selected lines" } else { "" };
    let control = snapshot.control();
    let uses = |wanted: &dyn Fn(Effect) -> bool| {
        snapshot
            .file_index()
            .codes
            .iter()
            .any(|(number, _)| control.code(*number).is_some_and(|code| wanted(code.effect())))
    };
    let is = |effect: Effect| uses(&move |other| other == effect);
    let is_mill = control.machine() != MachineKind::Lathe;
    let has_cycle = uses(&|effect| Role::of(effect) == Some(Role::Cycle) && effect != Effect::CycleCancel);
    let has_drilling = control.codes().any(|code| is_moves_and_dwells(code.effect()));
    let has_loop = !snapshot.file_index().loops.is_empty() || !snapshot.file_index().o_words.is_empty();
    let is_whole = range.is_none();
    let (is_below_another, is_above_another) = neighbours(snapshot, selected.start);
    let fits = |name: &str| match name {
        "expand-cycle" => has_cycle,
        "fold-cycle" => has_drilling && is(Effect::Rapid) && is(Effect::Linear),
        "unroll-loop" => has_loop,
        "absolute" => is(Effect::Incremental),
        "incremental" => is(Effect::Absolute),
        "mm" => is_whole && is(Effect::Inch),
        "inch" => is_whole && is(Effect::Millimetre),
        "safe-start" => is(Effect::ToolChange),
        "section-up" => is_below_another,
        "section-down" => is_above_another,
        "mirror-x" | "mirror-y" | "rotate-90" | "rotate-180" | "rotate-270" => is_mill,
        _ => true,
    };
    let fitting = PROVED.into_iter().filter(|(name, _)| fits(name));
    fitting
        .map(|(name, title)| match name {
            // The section that the selection is in moves as a whole.
            "section-up" | "section-down" => ProvedChange {
                title: format!("{title}, with proof"),
                name,
                range: Some(whole_lines(snapshot, selected)),
            },
            _ => ProvedChange { title: format!("{title}{part}, with proof"), name, range: range.clone() },
        })
        .collect()
}

/// Is there a tool section above the one at a place, and one below it?
fn neighbours(snapshot: &Snapshot, offset: u32) -> (bool, bool) {
    let tools = sections(snapshot).tools;
    let own = tools.iter().position(|section| section.range.contains(&offset));
    (own.is_some_and(|own| own > 0), own.is_some_and(|own| own + 1 < tools.len()))
}

/// The lines that a selection touches.
pub fn whole_lines(snapshot: &Snapshot, selected: &Range<u32>) -> Range<u32> {
    let first = snapshot.line_at(selected.start);
    let last = snapshot.line_at(selected.end);
    // A selection of whole lines ends where the next one begins.
    let ends_before = last > first && snapshot.line_range(last).start == selected.end;
    let last = if ends_before { last - 1 } else { last };
    snapshot.line_range(first).start..snapshot.line_range(last).end
}

/// A change that somebody asks for.
#[derive(Debug, Clone)]
pub struct PathChange {
    change: Change,
    numbering: Option<Numbering>,
}

impl PathChange {
    /// The change of a name, as [`ProvedChange`] has it.
    pub fn named(name: &str) -> Option<Self> {
        let zero = Amount::ZERO;
        let change = match name {
            "expand-cycle" => Change::ExpandCycle,
            "fold-cycle" => Change::FoldCycle,
            "unroll-loop" => Change::UnrollLoop,
            "safe-start" => Change::SafeStart,
            "absolute" => Change::Absolute,
            "incremental" => Change::Incremental,
            "mm" => Change::Convert(Units::Mm),
            "inch" => Change::Convert(Units::Inch),
            "section-up" => Change::MoveSection(Destination::Up),
            "section-down" => Change::MoveSection(Destination::Down),
            "feeds-90" => Change::ScaleFeeds(0.9),
            "feeds-110" => Change::ScaleFeeds(1.1),
            "speeds-90" => Change::ScaleSpeeds(0.9),
            "speeds-110" => Change::ScaleSpeeds(1.1),
            "mirror-x" => Change::Mirror(Axis::X, zero),
            "mirror-y" => Change::Mirror(Axis::Y, zero),
            "rotate-90" => Change::Rotate(1, [zero; 2]),
            "rotate-180" => Change::Rotate(2, [zero; 2]),
            "rotate-270" => Change::Rotate(3, [zero; 2]),
            _ => return None,
        };
        Some(Self { change, numbering: None })
    }

    /// Shifts the path by lengths along X, Y and Z, as people write them: `10`, `-2.5mm`; not at all where one is left out.
    ///
    /// # Errors
    /// What is wrong with the lengths, for people.
    pub fn shift(by: [Option<&str>; 3]) -> Result<Self, String> {
        let mut amounts = [Amount::ZERO; 3];
        for (amount, written) in amounts.iter_mut().zip(by) {
            if let Some(written) = written {
                *amount = Amount::parse(written)?;
            }
        }
        if amounts.iter().all(|amount| amount.number == 0.0) {
            return Err("a shift needs a length that is not zero".to_owned());
        }
        Ok(Self { change: Change::Translate(amounts), numbering: None })
    }

    /// Numbers the blocks again.
    ///
    /// # Errors
    /// What is wrong with the numbers, for people.
    pub fn renumber(start: u32, step: u32) -> Result<Self, String> {
        if start == 0 || step == 0 {
            return Err("the first number and the step are whole numbers from 1".to_owned());
        }
        Ok(Self { change: Change::Renumber, numbering: Some(Numbering { start, step }) })
    }
}

/// Makes a change of a document and proves it. The inner error is the reason why it is not made, for people.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn proved(
    snapshot: &Snapshot,
    asked: &PathChange,
    range: Option<Range<u32>>,
    fuel: u64,
    stop: &dyn Fn() -> bool,
) -> Result<Result<Proved, String>, Cancelled> {
    let change = &asked.change;
    let scope = range.map_or(Scope::All, Scope::Bytes);
    if asked.numbering.is_some() && scope != Scope::All {
        return Ok(Err("blocks are renumbered in the whole file, as jumps lead everywhere".to_owned()));
    }
    let mut machine = snapshot.settings().machine.engine.clone();
    let runs = runs(snapshot);
    let proving = Proving { snapshot, change, numbering: asked.numbering, scope: &scope, fuel, stop };
    let unknown = proving.assume(&mut machine, &runs)?;
    let text = snapshot.text();
    let edits = match proving.plan(&machine, &runs)? {
        Ok(edits) => edits,
        Err(reason) => return Ok(Err(format!("cannot {}: {reason}", change.verb()))),
    };
    if edits.is_empty() {
        return Ok(Ok(Proved { edits, claim: "there is nothing to change".to_owned() }));
    }
    let after = apply(&text, &edits);
    assume_places(&mut machine, &unknown);
    let mut moves = 0;
    for options in &runs {
        match proving.compare(&machine, *options, &after)? {
            Ok(compared) => moves = compared.max(moves),
            Err(reason) => return Ok(Err(format!("cannot {}: {reason}", change.verb()))),
        }
    }
    let claim = format!("{}, within {} mm ({moves} moves compared)", change.claim(), change.tolerance());
    Ok(Ok(Proved { edits, claim }))
}

/// The switches that a change is proved for: block delete off and, where a block has one, also on.
fn runs(snapshot: &Snapshot) -> Vec<Options> {
    let has_slash = snapshot.file_index().block_deletes > 0;
    if has_slash { vec![Options::NONE, Options::SKIP_ALL] } else { vec![Options::NONE] }
}

struct Proving<'a> {
    snapshot: &'a Snapshot,
    change: &'a Change,
    numbering: Option<Numbering>,
    scope: &'a Scope,
    fuel: u64,
    stop: &'a dyn Fn() -> bool,
}

impl Proving<'_> {
    /// Gives cutters of unknown size a small one, so that their paths can be compared. The answer is what runs rest on.
    fn assume(&self, machine: &mut Machine, runs: &[Options]) -> Result<BTreeSet<Assumption>, Cancelled> {
        let mut all = BTreeSet::new();
        for options in runs {
            let unknown = self.snapshot.with_program(|program, model| {
                let mut none = |_: Act| !(self.stop)();
                plainly(program, model, machine, *options, self.fuel, &mut none).assumptions
            });
            assume_cutters(machine, &unknown);
            all.extend(unknown);
            if (self.stop)() {
                return Err(Cancelled);
            }
        }
        Ok(all)
    }

    fn plan(&self, machine: &Machine, runs: &[Options]) -> Result<Result<Vec<Edit>, String>, Cancelled> {
        self.snapshot.with_program(|program, model| {
            let mut seen = Witness::new(self.change, self.scope, model);
            for options in runs {
                let ran = witness(&mut seen, program, model, machine, *options, self.fuel, self.scope);
                if (self.stop)() {
                    return Err(Cancelled);
                }
                if let Some(reason) = self.end(&ran) {
                    return Ok(Err(reason));
                }
                let gaps: BTreeSet<_> = gaps(&ran.assumptions);
                if let Some(gap) = gcheck_lint::describe_all(&gaps, model).into_iter().next() {
                    return Ok(Err(format!("the proof would have a gap, as {}", gap.text)));
                }
            }
            if let Some(numbering) = &self.numbering {
                let edits = renumber(&self.snapshot.text(), &self.snapshot.dialect(), numbering);
                return Ok(
                    edits.map_err(|refused| format!("line {}: {refused}", self.line(refused.range.start)))
                );
            }
            let planned = plan(self.change, self.scope, &seen, program, model, machine);
            Ok(planned.map(|plan| plan.edits).map_err(|refusal| self.reason(&refusal)))
        })
    }

    /// Compares both runs; the answer is how many moves are the same.
    fn compare(
        &self,
        machine: &Machine,
        options: Options,
        after: &str,
    ) -> Result<Result<u64, String>, Cancelled> {
        let mut promised = Kept::default();
        let ran = self.snapshot.with_program(|program, model| {
            let mut keep = |act: Act| promised.keep(act) && !(self.stop)();
            expected(self.change, self.scope, program, model, machine, options, self.fuel, &mut keep)
        });
        let mut made = Kept::default();
        let ended = self.snapshot.with_program_of(after, |program, model| {
            let mut keep = |act: Act| made.keep(act) && !(self.stop)();
            plainly(program, model, machine, options, self.fuel, &mut keep)
        });
        if (self.stop)() {
            return Err(Cancelled);
        }
        if let Some(refusal) = &ran.refusal {
            return Ok(Err(self.reason(refusal)));
        }
        if promised.is_full || made.is_full {
            return Ok(Err(format!(
                "the program makes more than {MOST_ACTS} moves; `gcheck edit` proves such a change"
            )));
        }
        if let Some(reason) = self.end(&ran.result) {
            return Ok(Err(reason));
        }
        let mut both = |with: Holder<'_>| {
            with(&mut promised.acts.iter().cloned(), &mut made.acts.iter().cloned());
            Ok::<_, Infallible>(())
        };
        let Ok(differences) = hold(self.change, self.change.tolerance(), &mut both);
        if !is_as_claimed(self.change, &differences) {
            return Ok(Err(different(&differences)));
        }
        if !ended.stopped.is_program_end() {
            return Ok(Err("the changed program does not run to its end".to_owned()));
        }
        if differences.unknown || differences.half_known.is_some() {
            return Ok(Err(
                "a move starts or ends at a coordinate that is not known, so nothing is proved of it"
                    .to_owned(),
            ));
        }
        Ok(Ok(differences.moves))
    }

    /// Why a run did not come to its end.
    fn end(&self, ran: &RunResult) -> Option<String> {
        if ran.stopped.is_program_end() {
            return None;
        }
        let place = if ran.origin.at.file == 0 {
            format!("in line {}", self.line(ran.origin.start))
        } else {
            "in a program that it calls".to_owned()
        };
        Some(match &ran.stopped {
            Stopped::Ended(Ending::Text) => "the program has no end, so its run is not complete".to_owned(),
            Stopped::OutOfFuel => format!("the run had not ended after {} blocks", ran.blocks),
            _ => format!("the run stops {place} before the end of the program, so nothing is proved of it"),
        })
    }

    fn reason(&self, refusal: &Refusal) -> String {
        match &refusal.file {
            Some(file) => format!("{file}: {refusal}"),
            None if refusal.range.is_empty() => refusal.to_string(),
            None => format!("line {}: {refusal}", self.line(refusal.range.start)),
        }
    }

    fn line(&self, offset: u32) -> u32 {
        self.snapshot.line_at(offset) + 1
    }
}

/// The first difference in a few words.
fn different(differences: &Differences) -> String {
    if let Some(parting) = &differences.parting {
        let line = parting.a.as_ref().or(parting.b.as_ref()).map_or(0, |place| place.line);
        return format!("the proof failed, as the path would be another one from line {line} on");
    }
    let Some(first) = differences.kept().first() else {
        return "the proof failed, as a tool would do its work another number of times".to_owned();
    };
    let line = first.a.as_ref().or(first.b.as_ref()).map_or(0, |place| place.line);
    let what = match first.aspect {
        Aspect::Feed => "the feed",
        Aspect::Spindle => "the spindle",
        Aspect::Drive => "how the axes are driven",
        Aspect::Dwell => "a dwell",
        _ => "what the machine does",
    };
    format!("the proof failed, as {what} would be another one in line {line}")
}

/// Acts of a run.
#[derive(Default)]
struct Kept {
    acts: Vec<Act>,
    is_full: bool,
}

impl Kept {
    fn keep(&mut self, act: Act) -> bool {
        self.is_full = self.acts.len() >= MOST_ACTS;
        if !self.is_full {
            self.acts.push(act);
        }
        !self.is_full
    }
}

#[cfg(test)]
mod tests {
    use std::ops::Range;

    use expect_test::{Expect, expect};
    use gcheck_edit::{Change, Scope};
    use gcheck_engine::Options;
    use proptest::prelude::*;

    use super::{PathChange, Proving, proved, proved_change_at, proved_changes};
    use crate::fixture::{Fixture, applied};

    const PROGRAM: &str = "O1\nG21 G17 G90 G94 G54 G40 G80\nS1000 M3\nG0 X1. Y2. Z5.\nG1 Z-1. F100.\nG2 X3. Y2. I1.\nG0 Z5.\nG81 X5. Z-3. R2. F80.\nG80\nM30\n";

    fn names(control: &str, text: &str, range: Range<u32>) -> Vec<&'static str> {
        let snapshot = Fixture::new(control, text).snapshot();
        proved_changes(&snapshot, &range).into_iter().map(|change| change.name).collect()
    }

    fn answer(text: &str, name: &str, range: Option<Range<u32>>) -> Result<(String, String), String> {
        asked(text, &PathChange::named(name).unwrap(), range)
    }

    fn asked(text: &str, change: &PathChange, range: Option<Range<u32>>) -> Result<(String, String), String> {
        let snapshot = Fixture::new("haas-mill", text).snapshot();
        let proved = proved(&snapshot, change, range, 100_000, &|| false).unwrap()?;
        Ok((applied(text, &proved.edits), proved.claim))
    }

    #[test]
    fn a_shift_by_lengths_as_people_write_them() {
        let by = PathChange::shift([Some("10"), Some("-0.1in"), None]).unwrap();
        let (text, claim) = asked(PROGRAM, &by, None).unwrap();
        assert!(text.contains("G0 X11. Y-0.54 Z5.") && text.contains("G2 X13. Y-0.54 I1."), "{text}");
        assert_eq!(claim, "every move is shifted by X10 Y-0.1 inch, within 0.001 mm (8 moves compared)");
        let start = PROGRAM.find("G81").unwrap() as u32;
        let down = PathChange::shift([None, None, Some("-1")]).unwrap();
        let (text, _) = asked(PROGRAM, &down, Some(start..start + 3)).unwrap();
        assert!(text.contains("G0 Z5.\nG81 X5. Z-4. R1. F80."), "the lines of the selection change: {text}");
        for wrong in [[Some("ten"), None, None], [None, None, None], [Some("0"), None, Some("0mm")]] {
            PathChange::shift(wrong).unwrap_err();
        }
    }

    #[test]
    fn blocks_are_numbered_again_with_their_jumps() {
        let text = "O1\nN5 G0 X0.\n#1=#1+1\nIF [#1 LT 3] GOTO 5\nM30\n".replace("#1=#1+1", "#1=3");
        let numbers = PathChange::renumber(100, 5).unwrap();
        let (after, claim) = asked(&text, &numbers, None).unwrap();
        assert!(after.contains("N100 G0 X0.") && after.contains("GOTO 100"), "{after}");
        assert!(claim.starts_with("every move is as before"), "{claim}");
        assert!(asked(&text, &numbers, Some(3..5)).unwrap_err().contains("whole file"));
        PathChange::renumber(0, 5).unwrap_err();
        PathChange::renumber(5, 0).unwrap_err();
    }

    #[test]
    fn what_fits_a_program_is_offered() {
        let mill = names("haas-mill", PROGRAM, 0..0);
        assert!(mill.contains(&"expand-cycle") && mill.contains(&"inch") && mill.contains(&"mirror-x"));
        assert!(!mill.contains(&"mm") && !mill.contains(&"unroll-loop") && !mill.contains(&"absolute"));
        let part = names("haas-mill", PROGRAM, 40..60);
        assert!(!part.contains(&"inch"), "units are those of the whole program");
        let lathe = names("haas-lathe", "O1\nG20 G18\nG0 X1. Z1.\nM30\n", 0..0);
        assert!(lathe.contains(&"mm") && !lathe.contains(&"mirror-x"));
        assert!(names("haas-mill", "", 0..0).is_empty());
    }

    #[test]
    fn a_change_comes_with_its_proof() {
        let (text, claim) = answer(PROGRAM, "mirror-x", None).unwrap();
        assert!(text.contains("G0 X-1. Y2. Z5.") && text.contains("G3 X-3. Y2. I-1."), "{text}");
        assert_eq!(claim, "every move is mirrored at X0, within 0.001 mm (8 moves compared)");
        let (text, _) = answer(PROGRAM, "expand-cycle", None).unwrap();
        assert!(text.contains("G0 X5.\nG0 Z2.\nG1 Z-3. F80.\nG0 Z5.\nG80"), "{text}");
        assert_eq!(answer(PROGRAM, "unroll-loop", None).unwrap().1, "there is nothing to change");
    }

    #[test]
    fn a_tool_section_moves_as_a_whole() {
        let section = |tool: u32| {
            format!(
                "(TOOL {tool})\nT{tool} M6\nS1000 M3\nG90 G0 X{tool}. Y0.\nG43 H{tool} Z5.\nG1 Z-1. F100.\nG0 Z5.\nG91 G28 Z0. M5\n"
            )
        };
        let program = |first, second| {
            format!("O1\nG21 G17 G90 G54 G40 G80\n{}{}M30\n", section(first), section(second))
        };
        let text = program(1, 2);
        let at = |word: &str| text.find(word).map(|at| at as u32..at as u32).unwrap();
        let moves = |range| -> Vec<_> {
            let is_move = |name: &&str| name.starts_with("section-");
            names("haas-mill", &text, range).into_iter().filter(is_move).collect()
        };
        assert_eq!(moves(at("X2.")), ["section-up"]);
        assert_eq!(moves(at("(TOOL 1)")), ["section-down"]);
        assert!(moves(at("G21")).is_empty(), "no section is there");
        let (after, claim) = answer(&text, "section-up", Some(at("X2."))).unwrap();
        assert_eq!(after, program(2, 1));
        assert!(
            claim.starts_with("the tools come in another order, and every move of each section"),
            "{claim}"
        );
        let reason = answer(&text, "section-down", Some(at("X2."))).unwrap_err();
        assert_eq!(reason, "cannot move the section of a tool: it is the last section already");
    }

    /// The title of the change at the cursor, and what it makes of the program.
    fn check_at_cursor(control: &str, text: &str, expected: &Expect) {
        let fixture = Fixture::new(control, text);
        let snapshot = fixture.snapshot();
        let Some(change) = proved_change_at(&snapshot, fixture.offset) else {
            return expected.assert_eq("nothing is offered\n");
        };
        let asked = PathChange::named(change.name).unwrap();
        let answer = proved(&snapshot, &asked, change.range, 100_000, &|| false).unwrap();
        let shown = match answer {
            Ok(proved) => {
                format!("{}: {}\n", applied(&snapshot.text(), &proved.edits).trim_end(), proved.claim)
            }
            Err(reason) => format!("{reason}\n"),
        };
        expected.assert_eq(&format!("{}\n{shown}", change.title));
    }

    #[test]
    fn a_cycle_becomes_plain_moves() {
        check_at_cursor(
            "haas-mill",
            "O1\nG21 G90 G54 G0 X0. Y0. Z10.\nN5 G99 G83$0 X1. Y2. Z-6. R2. Q3. F100.\nX5.\nG80\nG0 Z50.\nM30\n",
            &expect![[r#"
                Write this cycle as plain moves, with proof
                O1
                G21 G90 G54 G0 X0. Y0. Z10.
                N5 G99
                G0 X1. Y2.
                G0 Z2.
                G1 Z-1. F100.
                G0 Z2.
                G0 Z1.54
                G1 Z-4.
                G0 Z2.
                G0 Z-1.46
                G1 Z-6.
                G0 Z2.
                G0 X5.
                G1 Z-1.
                G0 Z2.
                G0 Z1.54
                G1 Z-4.
                G0 Z2.
                G0 Z-1.46
                G1 Z-6.
                G0 Z2.
                G80
                G0 Z50.
                M30: every move is as before, within 0.001 mm (21 moves compared)
            "#]],
        );
        check_at_cursor(
            "linuxcnc",
            "G21 G90 G0 X0 Y0 Z10\nG98 G82 X1 Y2 Z-6 R2 P0.5 F100$0\nG80\nG0 Z50\nM2\n",
            &expect![[r#"
                Write this cycle as plain moves, with proof
                G21 G90 G0 X0 Y0 Z10
                G98
                G61
                G0 X1 Y2
                G0 Z2
                G1 Z-6 F100
                G4 P0.5
                G0 Z10
                G64
                G80
                G0 Z50
                M2: every move is as before, within 0.001 mm (6 moves compared)
            "#]],
        );
    }

    #[test]
    fn a_cycle_stays_where_other_cycles_go_on_or_it_is_more_than_moves() {
        let text =
            "O1\nG21 G90 G54 S500 M3 G0 X0. Y0. Z10.\nG84$0 X1. Y2. Z-6. R2. F500.\nG80\nG0 Z50.\nM30\n";
        check_at_cursor(
            "haas-mill",
            text,
            &expect![[r#"
                nothing is offered
            "#]],
        );
        let text = "O1\nG21 G90 G54 G0 X0. Y0. Z10.\nG81$0 X1. Y2. Z-6. R2. F100.\nG82 X5. P500\nG80\nG0 Z50.\nM30\n";
        check_at_cursor(
            "haas-mill",
            text,
            &expect![[r#"
            nothing is offered
        "#]],
        );
        check_at_cursor(
            "haas-mill",
            "O1\nG21 G90 G54\nG0$0 X0. Y0. Z10.\nM30\n",
            &expect![[r#"
            nothing is offered
        "#]],
        );
    }

    #[test]
    fn a_selection_changes_alone() {
        let start = PROGRAM.find("G1 Z-1.").unwrap() as u32;
        let (text, _) = answer(PROGRAM, "feeds-90", Some(start..start + 5)).unwrap();
        assert!(text.contains("G1 Z-1. F90.\nG2 X3. Y2. I1. F100."), "{text}");
    }

    #[test]
    fn what_is_refused_says_where_and_why() {
        let reason = answer(&PROGRAM.replace("F100.", ""), "mirror-x", None).unwrap_err();
        assert_eq!(
            reason,
            "cannot mirror the path: the run stops in line 5 before the end of the program, so nothing is proved of it"
        );
        let start = PROGRAM.find("G2 X3.").unwrap() as u32;
        let reason = answer(PROGRAM, "mirror-x", Some(start..start + 5)).unwrap_err();
        assert!(
            reason.starts_with(
                "cannot mirror the path: line 6: the arc of this block does not move as a whole"
            ),
            "{reason}"
        );
    }

    /// A program that drills holes by cycles, and the control that it is for.
    fn cycles() -> impl Strategy<Value = (&'static str, String)> {
        let controls = prop_oneof![Just("haas-mill"), Just("fanuc-mill"), Just("linuxcnc"), Just("grblhal")];
        let codes = prop_oneof![Just("G81"), Just("G82"), Just("G83"), Just("G73"), Just("G85"), Just("G89")];
        let holes = prop::collection::vec((-40_i32..40, -40_i32..40, 0_u8..4), 2..6);
        let levels = (1_i32..5, 0_i32..30, 1_i32..20, 1_i32..9);
        (controls, codes, any::<bool>(), any::<bool>(), levels, holes).prop_map(
            |(control, code, to_r, is_incremental, (r, above, deep, peck), holes)| {
                let (initial, dwell) = (r + above, if control == "linuxcnc" { "P0.5" } else { "P500" });
                let own = match code {
                    "G82" | "G89" => format!(" {dwell}"),
                    "G83" | "G73" => format!(" Q{peck}.25"),
                    _ => String::new(),
                };
                let level = if to_r { "G99" } else { "G98" };
                let [distance, z, of_r] = if is_incremental {
                    ["G91".to_owned(), format!("{}.", -deep - r), format!("{}.", -above)]
                } else {
                    ["G90".to_owned(), format!("{}.", -deep), format!("{r}.")]
                };
                let mut text = format!(
                    "%\nO1\nG21 G17 G90 G94 G54 G40 G80 G61\nT1 M6\nS900 M3\nG0 X0. Y0. Z{initial}.\n{distance}\n"
                );
                for (index, (x, y, kind)) in holes.iter().enumerate() {
                    let point = match kind {
                        0 => format!("X{x}."),
                        1 => format!("Y{y}."),
                        _ => format!("X{x}. Y{y}."),
                    };
                    let block = match index {
                        0 => format!("{level} {code} {point} Z{z} R{of_r}{own} F120."),
                        _ if *kind == 3 => format!("{point} F{}.", 100 + y),
                        _ => point,
                    };
                    text += &block;
                    text.push('\n');
                }
                text += "G80\nG90\nG0 Z50.\nM5\nM30\n%\n";
                // One of these has neither a program number nor its exact stop as a mode.
                let text = match control {
                    "linuxcnc" | "grblhal" => text.replace("O1\n", ""),
                    _ => text.replace(" G61", ""),
                };
                (control, text)
            },
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

        /// A cycle that is written as moves and then as a cycle again makes the moves that it made.
        #[test]
        fn a_cycle_expanded_and_folded_makes_the_same_moves((control, text) in cycles()) {
            let change = |text: &str, name: &str| {
                let snapshot = Fixture::new(control, text).snapshot();
                let asked = PathChange::named(name).unwrap();
                let proved = proved(&snapshot, &asked, None, 100_000, &|| false).unwrap();
                proved.map(|proved| applied(text, &proved.edits))
            };
            let moves = change(&text, "expand-cycle").map_err(TestCaseError::fail)?;
            let has_cycle = |text: &str| {
                text.lines().any(|line| ["G81", "G82", "G83", "G73", "G85", "G89"].iter().any(|code| line.contains(code)))
            };
            prop_assert!(!has_cycle(&moves), "{moves}");
            let folded = change(&moves, "fold-cycle").map_err(|reason| TestCaseError::fail(format!("{reason}\n{moves}")))?;
            prop_assert!(has_cycle(&folded), "{moves}");
            prop_assert!(folded.lines().count() < moves.lines().count(), "{folded}");
            let snapshot = Fixture::new(control, &text).snapshot();
            let machine = snapshot.settings().machine.engine.clone();
            let proving = Proving {
                snapshot: &snapshot,
                change: &Change::FoldCycle,
                numbering: None,
                scope: &Scope::All,
                fuel: 100_000,
                stop: &|| false,
            };
            let compared = proving.compare(&machine, Options::NONE, &folded).unwrap();
            prop_assert!(compared.clone().is_ok_and(|moves| moves > 4), "{compared:?}\n{text}\n{folded}");
        }
    }
}
