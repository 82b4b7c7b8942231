//! Where the path of a program goes when the points of some blocks are moved.
//!
//! Knows: which coordinates come from moved blocks, at every block of a run. Must not know: text, how acts are compared.
//!
//! A coordinate moves with the block that gave it: after `X10.` of a moved block and `Z5.` of another one X is moved and Z is
//! not. What a mode of the machine gives (`G53`, `G28`) is where it was.

use std::collections::VecDeque;

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{At, Axis, Model, Position, Units};
use gcheck_geometry::{Arc, Plane};
use gcheck_program::Word;
use gcheck_toolpath::{Act, Doing, Move};

use crate::change::Change;
use crate::facts::mapping_name;
use crate::meaning::{Class, Meaning, Read, read};
use crate::refusal::Refusal;
use crate::rigid::{LINEAR, Rigid};
use crate::run::Executed;

/// Blocks that are remembered: under cutter compensation a move comes a few blocks late.
const REMEMBERED: usize = 64;
/// Coordinates that differ by less are the same one, millimetres.
const SAME: f64 = 1e-9;

/// Where a coordinate of the axes comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Owner {
    /// From a block that is not moved, or from the machine.
    Plain,
    /// From a block that is moved.
    Moved,
    /// From a moved block, and the other axis that it is turned with is somewhere else by now.
    Kept,
}

/// A block and its coordinates.
#[derive(Debug, Clone, Copy)]
struct Passed {
    at: At,
    start: u32,
    end: u32,
    class: Class,
    is_selected: bool,
    depth: usize,
    before: [Owner; 3],
    after: [Owner; 3],
    /// The level before it.
    level: f64,
}

/// The path of a run with some of its points moved. Has to see every block and act.
pub(crate) struct Course<'c> {
    change: &'c Change,
    model: &'c Model<'c>,
    /// The whole program is to be moved, so that no move may stay.
    is_whole: bool,
    rigid: Option<(Rigid, Units)>,
    owners: [Owner; 3],
    passed: VecDeque<Passed>,
    /// Of the last move.
    last: [Owner; 3],
    /// The axis that a tool change of the last block has taken to the machine's zero.
    changed_at: Option<Axis>,
    reached: Position,
}

impl<'c> Course<'c> {
    pub(crate) fn new(change: &'c Change, is_whole: bool, model: &'c Model<'c>) -> Self {
        Self {
            change,
            model,
            is_whole,
            rigid: None,
            owners: [Owner::Plain; 3],
            passed: VecDeque::with_capacity(REMEMBERED),
            last: [Owner::Plain; 3],
            changed_at: None,
            reached: Position::UNKNOWN,
        }
    }

    /// The motion, once the units of the program are known.
    pub(crate) fn rigid(&self) -> Option<&Rigid> {
        self.rigid.as_ref().map(|(rigid, _)| rigid)
    }

    /// Begins a further run.
    pub(crate) fn begin(&mut self) {
        self.owners = [Owner::Plain; 3];
        self.last = [Owner::Plain; 3];
        self.changed_at = None;
        self.reached = Position::UNKNOWN;
        self.passed.clear();
    }

    /// # Errors
    /// Why the points of the block cannot be moved.
    pub(crate) fn executed(&mut self, block: &Executed<'_>) -> Result<(), Refusal> {
        let read = read(block.place, &block.facts, self.model);
        if let Some(axis) = self.changed_at.take()
            && let Some(owner) = self.last.get_mut(axis.index())
        {
            *owner = Owner::Plain;
        }
        let before = self.owners;
        if block.is_selected {
            self.selected(block, &read)?;
        } else {
            self.other(block, &read)?;
        }
        if self.passed.len() >= REMEMBERED {
            self.passed.pop_front();
        }
        let level = LINEAR.get(read.depth).map_or(f64::NAN, |axis| block.before.raw(*axis));
        self.passed.push_back(Passed {
            at: block.at,
            start: block.start,
            end: block.end,
            class: read.class,
            is_selected: block.is_selected,
            depth: read.depth,
            before,
            after: self.owners,
            level,
        });
        self.change_tool(block);
        Ok(())
    }

    fn selected(&mut self, block: &Executed<'_>, read: &Read) -> Result<(), Refusal> {
        match read.class {
            Class::Moves | Class::Operation => self.selected_move(block, read)?,
            Class::Machine | Class::Reference => self.machine_point(block, read),
            Class::Origin { by_point } => self.origin(block, by_point)?,
            Class::Mapping(role) => {
                return Err(block.refusal(format!(
                    "{} begins here, and words do not say places under it",
                    mapping_name(role)
                )));
            }
            Class::Computed => {
                return Err(
                    block.refusal("a code of this block is computed, so what its words mean is not certain")
                );
            }
            Class::Call | Class::Other => {}
        }
        Ok(())
    }

    fn selected_move(&mut self, block: &Executed<'_>, read: &Read) -> Result<(), Refusal> {
        if !read.has_places() {
            return Ok(());
        }
        let facts = &block.facts;
        if let Some(role) = facts.mapped {
            let reason = format!(
                "{} is in effect here, so the words do not say where the axes go",
                mapping_name(role)
            );
            return Err(block.refusal(reason).help("select lines outside of it"));
        }
        let rotation = block.state.work_offset().rotation;
        if rotation.is_nan() || rotation.abs() > 0.0 {
            let reason =
                "the work coordinate system is turned about Z here, so X and Y are not those of the machine";
            return Err(block.refusal(reason).help("select lines in a system that is not turned"));
        }
        let (rigid, units) = self.settled(block)?;
        if facts.units != Some(units) {
            let reason = "this block is in another unit than the ones before it";
            let help = "give the amounts with their unit, such as 10mm, or select lines of one unit";
            return Err(block.refusal(reason).help(help));
        }
        if read.class == Class::Operation && !rigid.is_shift() {
            let reason = "the code of this block makes moves of its own, which do not turn with its words";
            return Err(block.refusal(reason));
        }
        for (_, meaning) in &read.words {
            match meaning {
                Meaning::Place { axis, incremental: false }
                | Meaning::Height { axis, incremental: false } => {
                    if let Some(owner) = self.owners.get_mut(*axis) {
                        *owner = Owner::Moved;
                    }
                }
                Meaning::Place { axis, incremental: true }
                    if !rigid.is_shift() && !rigid.keeps(*axis) && self.owner(*axis) != Owner::Moved =>
                {
                    let reason = format!(
                        "this block moves {} by an increment from a point that is not in the selection",
                        name(*axis)
                    );
                    let help = "begin the selection at a block that gives absolute coordinates";
                    return Err(block.refusal(reason).help(help));
                }
                Meaning::Polar => {
                    let reason = "this block gives a distance and an angle as seen from the zero of the program, which stays where it is";
                    return Err(block.refusal(reason));
                }
                Meaning::Direction if !rigid.is_shift() => {
                    return Err(block.refusal("this block gives a direction, which is not turned"));
                }
                _ => {}
            }
        }
        self.whole(block, read, &rigid)
    }

    /// Are all coordinates given that the block needs to have moved?
    fn whole(&self, block: &Executed<'_>, read: &Read, rigid: &Rigid) -> Result<(), Refusal> {
        let begin = "begin the selection at the block that gives it, or before";
        if rigid.swaps() && (self.owner(0) == Owner::Moved) != (self.owner(1) == Owner::Moved) {
            let missing = if self.owner(0) == Owner::Moved { 'Y' } else { 'X' };
            let reason = format!(
                "this block needs X and Y to be rotated, and no block of the selection has given {missing}"
            );
            return Err(block.refusal(reason).help(begin));
        }
        if !read.cuts {
            return Ok(());
        }
        for (axis, letter) in LINEAR.iter().enumerate() {
            if !rigid.keeps(axis) && self.owner(axis) != Owner::Moved {
                let reason =
                    format!("this block cuts, and no block of the selection has given {}", letter.name());
                return Err(block.refusal(reason).help(begin));
            }
        }
        Ok(())
    }

    /// The motion in the units of the first block that it is asked for.
    fn settled(&mut self, block: &Executed<'_>) -> Result<(Rigid, Units), Refusal> {
        if let Some(settled) = self.rigid {
            return Ok(settled);
        }
        let diameter = block.facts.diameter.unwrap_or(false);
        let rigid = |units| Some((Rigid::of(self.change, units, diameter)?, units));
        let settled = block.facts.units.and_then(rigid);
        self.rigid = settled;
        settled.ok_or_else(|| block.refusal("the unit of this block is not known"))
    }

    fn other(&mut self, block: &Executed<'_>, read: &Read) -> Result<(), Refusal> {
        let Some((rigid, _)) = self.rigid else { return Ok(()) };
        match read.class {
            Class::Moves | Class::Operation if read.has_places() => {
                if self.is_whole {
                    return goes_along_with(block, read, &rigid);
                }
                let mut moves = read.class == Class::Operation || read.cuts;
                for (_, meaning) in &read.words {
                    if let Meaning::Place { axis, incremental } | Meaning::Height { axis, incremental } =
                        meaning
                        && let Some(owner) = self.owners.get_mut(*axis)
                    {
                        moves = true;
                        if !incremental {
                            *owner = Owner::Plain;
                        }
                    }
                }
                let left = (0..3).find(|axis| !rigid.keeps(*axis) && self.owner(*axis) != Owner::Plain);
                if let Some(axis) = left.filter(|_| moves) {
                    let reason = format!(
                        "this block is not in the selection and goes on from a moved point: it does not give {} as a coordinate",
                        name(axis)
                    );
                    let help = "end the selection where the next block gives all moved axes, or extend it";
                    return Err(block.refusal(reason).help(help));
                }
            }
            Class::Machine | Class::Reference => self.machine_point(block, read),
            Class::Origin { by_point } if self.owners.iter().any(|owner| *owner != Owner::Plain) => {
                self.origin(block, by_point)?;
            }
            _ => {}
        }
        Ok(())
    }

    /// A tool change takes an axis to the machine's zero, after the move of its block.
    fn change_tool(&mut self, block: &Executed<'_>) {
        let mut codes = block.place.table.words(block.place.block()).iter();
        if !codes.any(|word| self.model.effect(word.code) == Effect::ToolChange) {
            return;
        }
        let letter = self.model.semantics().tools.change_at_zero;
        let axis = letter.and_then(|letter| Axis::of(Letter::of(letter))).filter(|axis| goes(block, *axis));
        let Some(axis) = axis else { return };
        if let Some(owner) = self.owners.get_mut(axis.index()) {
            *owner = Owner::Plain;
            self.changed_at = Some(axis);
        }
    }

    fn machine_point(&mut self, block: &Executed<'_>, read: &Read) {
        for (_, meaning) in &read.words {
            if let Meaning::Place { axis, .. } = meaning
                && let Some(owner) = self.owners.get_mut(*axis)
            {
                *owner = Owner::Plain;
            }
        }
        // A return without words is one of all axes.
        let words = block.place.table.words(block.place.block());
        let returns =
            words.iter().any(|word| matches!(self.model.effect(word.code), Effect::ReturnReference(_)));
        let axes = self.model.control().axes();
        let increments = &self.model.semantics().increments;
        let names_axis = |word: &Word| {
            axes.contains(word.letter)
                || increments.keys().any(|name| Letter::parse(name) == Some(word.letter))
        };
        if returns && !words.iter().any(names_axis) {
            for (owner, axis) in self.owners.iter_mut().zip(LINEAR) {
                if goes(block, axis) {
                    *owner = Owner::Plain;
                }
            }
        }
        self.keep_turned();
    }

    /// An axis that is turned with one that the machine has placed stays where it is.
    fn keep_turned(&mut self) {
        if self.rigid.is_some_and(|(rigid, _)| rigid.swaps()) && self.owner(0) != self.owner(1) {
            for owner in self.owners.iter_mut().take(2).filter(|owner| **owner == Owner::Moved) {
                *owner = Owner::Kept;
            }
        }
    }

    fn origin(&self, block: &Executed<'_>, by_point: bool) -> Result<(), Refusal> {
        let is_shift = matches!(self.change, Change::Translate(_));
        if by_point {
            let reason = "this block moves the zero of the program to or from where the tool is, and the tool is somewhere else then";
            return Err(block.refusal(reason));
        }
        if !is_shift {
            let reason = "this block shifts the zero of the program, and the shift is not turned with it";
            return Err(block.refusal(reason));
        }
        Ok(())
    }

    fn owner(&self, axis: usize) -> Owner {
        self.owners.get(axis).copied().unwrap_or(Owner::Plain)
    }

    /// An act as it is with the points moved.
    ///
    /// # Errors
    /// When only a part of an arc moves.
    pub(crate) fn act(&mut self, at: At, is_expanded: bool, act: Act) -> Result<Act, Refusal> {
        let Doing::Move(made) = &act.doing else { return Ok(act) };
        let Some((rigid, _)) = self.rigid else { return Ok(act) };
        let passed = self.passed.iter().rev().find(|passed| passed.at == at).copied();
        let mut owners = passed.map_or(self.last, |passed| passed.after);
        if let Some(passed) = &passed {
            for (axis, owner) in owners.iter_mut().enumerate() {
                let Some(letter) = LINEAR.get(axis) else { continue };
                let (from, to) = (made.from().raw(*letter), made.to.raw(*letter));
                let last = self.last.get(axis).copied().unwrap_or(Owner::Plain);
                match passed.class {
                    // A move of the machine leaves the axes where they are that it does not move.
                    Class::Machine | Class::Reference => {
                        let stays = (to - from).abs() <= SAME && *owner != Owner::Kept;
                        *owner = if stays { last } else { *owner };
                    }
                    // A cycle goes to its place and back to the level where it began.
                    _ if is_expanded && axis == passed.depth && (to - passed.level).abs() <= SAME => {
                        *owner = passed.before.get(axis).copied().unwrap_or(*owner);
                    }
                    _ => {}
                }
            }
        }
        // What the words of such a block are is not known here, and they move something all the same.
        if let Some(passed) = passed.filter(|passed| passed.class == Class::Other && passed.is_selected) {
            let moves = |(axis, letter): (usize, &Axis)| {
                !rigid.keeps(axis) && (made.to.raw(*letter) - made.from().raw(*letter)).abs() > SAME
            };
            if LINEAR.iter().enumerate().any(moves) {
                let reason =
                    "a code of this block takes its words for something else than places, and it moves";
                return Err(Refusal::at(passed.start..passed.end, reason));
            }
        }
        let from = place(&rigid, made.from(), self.last, &self.reached);
        let to = place(&rigid, &made.to, owners, &self.reached);
        let along = made.arc().filter(|arc| self.goes_along(&rigid, arc.plane(), owners));
        let arc = along.and_then(|arc| turned(&rigid, arc, &from, &to, owners));
        if made.arc().is_some() && arc.is_none() {
            let range = passed.map_or(0..0, |passed| passed.start..passed.end);
            let reason = "the arc of this block does not move as a whole: its start and its end are not both in the selection, or its plane becomes another one";
            return Err(Refusal::at(range, reason));
        }
        self.last = owners;
        self.reached = to;
        let doing = Doing::Move(Move::new(made.driven, from, to, arc));
        Ok(Act { doing, ..act })
    }

    /// Do both ends of an arc move alike?
    fn goes_along(&self, rigid: &Rigid, plane: Plane, owners: [Owner; 3]) -> bool {
        let (first, second, _) = plane.axes();
        let is_same = |axis: usize| rigid.keeps(axis) || self.last.get(axis) == owners.get(axis);
        let is_moved = |axis: usize| rigid.keeps(axis) || owners.get(axis) == Some(&Owner::Moved);
        let is_plain = |axis: usize| rigid.keeps(axis) || owners.get(axis) == Some(&Owner::Plain);
        let both = [first, second];
        both.into_iter().all(is_same) && (both.into_iter().all(is_moved) || both.into_iter().all(is_plain))
    }
}

/// Is an axis elsewhere after a block? One whose condition does not hold goes nowhere.
fn goes(block: &Executed<'_>, axis: Axis) -> bool {
    block.state.position().raw(axis).to_bits() != block.before.raw(axis).to_bits()
}

/// A block of another file moves with the whole program only where it gives increments, and only along a shift.
fn goes_along_with(block: &Executed<'_>, read: &Read, rigid: &Rigid) -> Result<(), Refusal> {
    let stays = read.words.iter().any(|(_, meaning)| match meaning {
        Meaning::Place { axis, incremental }
        | Meaning::Height { axis, incremental }
        | Meaning::Centre { axis, incremental } => !(rigid.keeps(*axis) || *incremental && rigid.is_shift()),
        Meaning::Vector { .. } | Meaning::Direction => !rigid.is_shift(),
        Meaning::Polar => true,
        Meaning::Feed | Meaning::Speed | Meaning::Other => false,
    });
    if !stays {
        return Ok(());
    }
    let reason = "this block gives places, and it is in another file, which stays as it is";
    let help = "change that file as well, or select the lines of this one that go with the change";
    Err(block.refusal(reason).help(help))
}

/// A point whose coordinates are moved or not.
fn place(rigid: &Rigid, point: &Position, owners: [Owner; 3], reached: &Position) -> Position {
    let mut placed = *point;
    for (axis, (letter, owner)) in LINEAR.iter().zip(owners).enumerate() {
        match owner {
            Owner::Plain => {}
            Owner::Moved => placed.set(*letter, rigid.coordinate(point, axis)),
            Owner::Kept => placed.set(*letter, reached.raw(*letter)),
        }
    }
    placed
}

/// An arc between two points that are moved already.
fn turned(rigid: &Rigid, arc: &Arc, from: &Position, to: &Position, owners: [Owner; 3]) -> Option<Arc> {
    let (first, second, _) = arc.plane().axes();
    let is_moved = [first, second].iter().any(|axis| owners.get(*axis) == Some(&Owner::Moved));
    if is_moved {
        rigid.arc(arc, from, to)
    } else {
        Some(Arc::from_parts(arc.plane(), from.xyz(), to.xyz(), arc.centre(), arc.sweep()))
    }
}

fn name(axis: usize) -> char {
    LINEAR.get(axis).map_or('X', |axis| axis.name())
}

/// Does a code turn the other way round when its plane does?
pub(crate) const fn mirrored(effect: Effect) -> Option<Effect> {
    Some(match effect {
        Effect::ArcClockwise => Effect::ArcCounterClockwise,
        Effect::ArcCounterClockwise => Effect::ArcClockwise,
        Effect::CompensationLeft => Effect::CompensationRight,
        Effect::CompensationRight => Effect::CompensationLeft,
        Effect::CompensationLeftByDiameter => Effect::CompensationRightByDiameter,
        Effect::CompensationRightByDiameter => Effect::CompensationLeftByDiameter,
        _ => return None,
    })
}
