//! What a run shows of the blocks of a program, so that their words can be rewritten as they were read.
//!
//! Knows: the modes in which each block ran. Must not know: how words are rewritten.

use std::collections::BTreeSet;

use gcheck_engine::{
    Assumption, At, Concrete, Event, Machine, Model, Options, Program, RunResult, State, Units,
};
use gcheck_program::Place;
use gcheck_toolpath::Act;

use crate::change::Change;
use crate::course::Course;
use crate::distance::Distance;
use crate::expand::Cycles;
use crate::facts::Facts;
use crate::fold::Folds;
use crate::rates::Rates;
use crate::refusal::Refusal;
use crate::run::{Executed, Visitor, run};
use crate::safe_start::Starts;
use crate::scope::Scope;
use crate::tool_sections::ToolSections;
use crate::units::Conversion;
use crate::unroll::Loops;

/// What runs of a program have shown.
pub struct Witness<'c> {
    /// By number of the block.
    pub(crate) blocks: Vec<Option<Seen>>,
    pub(crate) following: Following<'c>,
    unfollowed: Option<Refusal>,
    /// What the runs rest on.
    assumptions: BTreeSet<Assumption>,
}

/// A block that ran.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seen {
    pub(crate) facts: Facts,
    pub(crate) is_selected: bool,
    /// The modes were the same each time.
    pub(crate) is_certain: bool,
    /// The plane was the same each time.
    pub(crate) keeps_plane: bool,
}

/// What is followed along a run for a change.
pub(crate) enum Tracker<'c> {
    Course(Box<Course<'c>>),
    Rates(Box<Rates<'c>>),
    Cycles(Box<Cycles<'c>>),
    Folds(Box<Folds<'c>>),
    Loops(Box<Loops<'c>>),
    Distance(Box<Distance<'c>>),
    Starts(Box<Starts<'c>>),
    Sections(Box<ToolSections<'c>>),
    Units(Box<Conversion<'c>>),
    /// Every act is as before.
    Same,
}

impl<'c> Tracker<'c> {
    pub(crate) fn new(change: &'c Change, scope: &Scope, model: &'c Model<'c>) -> Self {
        let is_whole = *scope == Scope::All;
        match change {
            Change::ScaleFeeds(_) | Change::ScaleSpeeds(_) => {
                Self::Rates(Box::new(Rates::new(change, model)))
            }
            Change::Translate(_) | Change::Mirror(..) | Change::Rotate(..) => {
                Self::Course(Box::new(Course::new(change, is_whole, model)))
            }
            Change::ExpandCycle => Self::Cycles(Box::new(Cycles::new(model))),
            Change::FoldCycle => Self::Folds(Box::new(Folds::new(model))),
            Change::UnrollLoop => Self::Loops(Box::new(Loops::new(scope, model))),
            Change::SafeStart => Self::Starts(Box::new(Starts::new(scope, model))),
            Change::MoveSection(destination) => {
                Self::Sections(Box::new(ToolSections::new(*destination, scope, model)))
            }
            Change::Absolute => Self::Distance(Box::new(Distance::new(false, model))),
            Change::Incremental => Self::Distance(Box::new(Distance::new(true, model))),
            Change::Convert(to) => Self::Units(Box::new(Conversion::new(*to, model))),
            Change::Renumber => Self::Same,
        }
    }

    pub(crate) fn begin(&mut self) {
        match self {
            Self::Course(course) => course.begin(),
            Self::Rates(rates) => rates.begin(),
            Self::Distance(distance) => distance.begin(),
            Self::Units(units) => units.begin(),
            Self::Sections(sections) => sections.begin(),
            Self::Cycles(_) | Self::Folds(_) | Self::Loops(_) | Self::Starts(_) | Self::Same => {}
        }
    }

    fn executed(&mut self, block: &Executed<'_>) -> Result<(), Refusal> {
        match self {
            Self::Course(course) => course.executed(block),
            Self::Rates(rates) => rates.executed(block),
            Self::Cycles(cycles) => cycles.executed(block),
            Self::Folds(folds) => {
                folds.executed(block);
                Ok(())
            }
            Self::Distance(distance) => distance.executed(block),
            Self::Units(units) => units.executed(block),
            Self::Loops(_) | Self::Starts(_) | Self::Sections(_) | Self::Same => Ok(()),
        }
    }

    fn act(&mut self, at: At, is_expanded: bool, act: Act) -> Result<Act, Refusal> {
        match self {
            Self::Course(course) => course.act(at, is_expanded, act),
            Self::Rates(rates) => Ok(rates.act(act)),
            Self::Cycles(_)
            | Self::Folds(_)
            | Self::Loops(_)
            | Self::Distance(_)
            | Self::Starts(_)
            | Self::Sections(_)
            | Self::Units(_)
            | Self::Same => Ok(act),
        }
    }
}

/// A tracker, until there is a reason not to make the change: nothing is followed after it.
pub(crate) struct Following<'c> {
    pub(crate) tracker: Tracker<'c>,
    /// Why the change cannot be made, as far as the runs have shown.
    pub(crate) refusal: Option<Refusal>,
}

impl<'c> Following<'c> {
    pub(crate) fn new(change: &'c Change, scope: &Scope, model: &'c Model<'c>) -> Self {
        Self { tracker: Tracker::new(change, scope, model), refusal: None }
    }

    fn follow<T>(&mut self, step: impl FnOnce(&mut Tracker<'c>) -> Result<T, Refusal>) -> Option<T> {
        if self.refusal.is_some() {
            return None;
        }
        match step(&mut self.tracker) {
            Ok(done) => Some(done),
            Err(refusal) => {
                self.refusal = Some(refusal);
                None
            }
        }
    }

    pub(crate) fn executed(&mut self, block: &Executed<'_>) {
        self.follow(|tracker| tracker.executed(block));
    }

    /// The act as it is after the change; `None` once the change is refused.
    pub(crate) fn act(&mut self, at: At, is_expanded: bool, act: Act) -> Option<Act> {
        self.follow(|tracker| tracker.act(at, is_expanded, act))
    }
}

impl std::fmt::Debug for Witness<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Witness").field("blocks", &self.blocks.len()).finish_non_exhaustive()
    }
}

impl<'c> Witness<'c> {
    /// Nothing seen yet.
    pub fn new(change: &'c Change, scope: &Scope, model: &'c Model<'c>) -> Self {
        Self {
            blocks: Vec::new(),
            following: Following::new(change, scope, model),
            unfollowed: None,
            assumptions: BTreeSet::new(),
        }
    }

    /// What the runs rest on that is not configured.
    pub fn assumptions(&self) -> &BTreeSet<Assumption> {
        &self.assumptions
    }

    /// The units of the last block that ran.
    pub fn units(&self) -> Option<Units> {
        self.blocks.iter().rev().flatten().find_map(|seen| seen.facts.units)
    }

    /// Has a run come to a block that is to be changed?
    pub(crate) fn selects_any(&self) -> bool {
        self.blocks.iter().flatten().any(|seen| seen.is_selected)
    }

    /// Why the change cannot be proved, as far as the runs have shown.
    pub(crate) fn refusal(&self) -> Option<Refusal> {
        self.unfollowed.as_ref().or(self.following.refusal.as_ref()).cloned()
    }
}

/// Executes a program once more for a witness. The result tells whether it came to its end; where it did not, nothing that
/// the witness has seen counts.
pub fn witness(
    witness: &mut Witness<'_>,
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
    options: Options,
    fuel: u64,
    scope: &Scope,
) -> RunResult {
    witness.following.tracker.begin();
    let mut watching = Watching { witness, program, machine };
    let result = run(program, model, machine, options, fuel, scope, &mut watching);
    witness.assumptions.extend(result.assumptions.iter().cloned());
    result
}

/// A witness at work.
struct Watching<'w, 'c, 'p> {
    witness: &'w mut Witness<'c>,
    program: &'w Program<'p>,
    machine: &'w Machine,
}

impl Visitor for Watching<'_, '_, '_> {
    const LOOKS_BEFORE: bool = true;

    fn before(&mut self, at: At, place: &Place, state: &State<Concrete>) {
        let (program, machine) = (self.program, self.machine);
        self.witness.following.follow(|tracker| match tracker {
            Tracker::Cycles(cycles) => {
                cycles.before();
                Ok(())
            }
            Tracker::Folds(folds) => {
                folds.before(state);
                Ok(())
            }
            Tracker::Loops(loops) => loops.before(program, machine, at, place, state),
            Tracker::Starts(starts) => {
                starts.before(at, place, state);
                Ok(())
            }
            Tracker::Sections(sections) => {
                sections.before(at, place);
                Ok(())
            }
            _ => Ok(()),
        });
    }

    fn event(&mut self, event: &Event) {
        self.witness.following.follow(|tracker| match tracker {
            Tracker::Cycles(cycles) => {
                cycles.event(event);
                Ok(())
            }
            Tracker::Folds(folds) => {
                folds.event(event);
                Ok(())
            }
            Tracker::Starts(starts) => starts.event(event),
            Tracker::Sections(sections) => sections.event(event),
            _ => Ok(()),
        });
    }

    fn executed(&mut self, block: &Executed<'_>) {
        self.witness.executed(block);
    }

    fn act(&mut self, at: At, is_expanded: bool, act: Act) {
        self.witness.following.act(at, is_expanded, act);
    }

    fn unfollowed(&mut self, start: u32, end: u32, file: Option<&str>) {
        if self.witness.unfollowed.is_none() {
            let reason =
                "this block moves the axes in a way that is not followed, so nothing is proved of it";
            self.witness.unfollowed = Some(Refusal::at(start..end, reason).in_file(file));
        }
    }
}

impl Witness<'_> {
    fn executed(&mut self, block: &Executed<'_>) {
        self.following.executed(block);
        if block.at.file != 0 {
            return;
        }
        let index = block.at.block as usize;
        if self.blocks.len() <= index {
            self.blocks.resize(index + 1, None);
        }
        let Some(slot) = self.blocks.get_mut(index) else { return };
        let new =
            Seen { facts: block.facts, is_selected: block.is_selected, is_certain: true, keeps_plane: true };
        *slot = Some(match slot {
            None => new,
            Some(old) => {
                let is_same = new.facts.places_alike(&old.facts) && old.is_selected == new.is_selected;
                Seen {
                    is_certain: old.is_certain && is_same,
                    keeps_plane: old.keeps_plane && new.facts.plane == old.facts.plane,
                    is_selected: old.is_selected || new.is_selected,
                    ..*old
                }
            }
        });
    }
}
