//! What two runs do differently.
//!
//! Knows: aspects, the first places of each, how often. Must not know: words, units of output.

use std::sync::Arc as Shared;

use gcheck_engine::{Position, Spindle};

use super::digest::Digest;
use crate::corner_mode::CornerMode;
use crate::trail::{Driven, Feed, Setting, Stand};

/// What becomes of two runs after the place where their paths part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rest {
    /// They are left there.
    Leave,
    /// They are read to their ends, and the differences have a digest.
    Read,
}

/// Differences of one aspect that are kept with their places; further ones are counted.
const KEPT: usize = 5;

/// In what two runs differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Aspect {
    /// Rapid, at feed, with the spindle, until a signal.
    Drive,
    /// The feed while cutting.
    Feed,
    /// Direction and speed of the spindle while cutting, and its orientation.
    Spindle,
    /// The tool.
    Tool,
    /// The work offset.
    WorkOffset,
    /// The number of the tool length offset.
    Length,
    /// The number of the cutter offset.
    Cutter,
    /// Coolant while cutting.
    Coolant,
    /// How corners are taken while cutting: exact stop, blending, smoothing.
    Corners,
    /// Time of standing still.
    Dwell,
    /// Stops, pallets and the end.
    Stop,
    /// Chuck, bar feeder, outputs, commands of the shop's own.
    Other,
}

impl Aspect {
    /// All, in the order of reports.
    pub const ALL: [Self; 12] = [
        Self::Drive,
        Self::Feed,
        Self::Spindle,
        Self::Tool,
        Self::WorkOffset,
        Self::Length,
        Self::Cutter,
        Self::Coolant,
        Self::Corners,
        Self::Dwell,
        Self::Stop,
        Self::Other,
    ];

    /// Its name for people and other programs.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Drive => "drive",
            Self::Feed => "feed",
            Self::Spindle => "spindle",
            Self::Tool => "tool",
            Self::WorkOffset => "work-offset",
            Self::Length => "length-offset",
            Self::Cutter => "cutter-offset",
            Self::Coolant => "coolant",
            Self::Corners => "corners",
            Self::Dwell => "dwell",
            Self::Stop => "stop",
            Self::Other => "other",
        }
    }
}

/// A block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub file: Shared<str>,
    /// Line, from 1.
    pub line: u32,
}

/// What one side does or has in effect.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// How a move is driven.
    Driven(Driven),
    /// A feed.
    Feed(Option<Feed>),
    /// Direction, speed if it is known, and of a surface speed, in metres a minute, the limit in turns a minute.
    Spindle(Option<Spindle>, Option<f64>, Option<f64>),
    /// A tool.
    Tool(Option<u32>),
    /// Number of a work coordinate system.
    WorkOffset(Option<u16>),
    /// A work coordinate system, and where its zero lies: X, Y and Z of the machine, millimetres; `None` as the control has it.
    Zero(u16, [Option<f64>; 3]),
    /// Number of a tool length offset.
    Length(Option<u32>),
    /// A tool length offset and its length, millimetres; `None` as the control has it.
    LengthBy(u32, Option<f64>),
    /// Number of a cutter offset.
    Cutter(Option<u32>),
    /// Mist, flood, through the spindle.
    Coolant([Option<bool>; 3]),
    /// How corners are taken.
    Corners(CornerMode),
    /// Something that happens while the axes do not move.
    Stand(Stand),
}

impl Value {
    pub(super) fn of_zero(work: u16, setting: &Setting) -> Self {
        Self::Zero(work, setting.zero.map(|at| Some(at).filter(|at| !at.is_nan())))
    }

    pub(super) fn of_length(length: u32, setting: &Setting) -> Self {
        Self::LengthBy(length, Some(setting.length_by).filter(|by| !by.is_nan()))
    }

    pub(super) fn of_spindle(setting: &Setting) -> Self {
        Self::Spindle(setting.spindle, Some(setting.speed).filter(|speed| !speed.is_nan()), setting.surface)
    }
}

/// One difference.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// In what.
    pub aspect: Aspect,
    /// In the first run, where it has something there.
    pub a: Option<Place>,
    /// In the second.
    pub b: Option<Place>,
    /// What each of them does.
    pub values: [Option<Value>; 2],
}

/// Where two paths part. What follows is not compared, up to the end of the section.
#[derive(Debug, Clone, PartialEq)]
pub struct Parting {
    /// The move of the first run, or its last one when it has none left; `None` when it has none at all.
    pub a: Option<Place>,
    /// The move of the second.
    pub b: Option<Place>,
    /// Where both were.
    pub at: Position,
    /// Where each of them goes; `None` where there is no move left.
    pub to: [Option<Position>; 2],
    /// How far they come apart, millimetres or degrees, on the axis where it is most; NaN where one does not go on.
    pub apart: f64,
    /// In which sections that is; `None` where the runs are compared as a whole.
    pub within: Option<Box<[SectionAt; 2]>>,
    /// From where they are compared again; `None` where they are not.
    pub again: Option<Again>,
}

/// Where two runs whose paths parted are compared again: at the next section that both have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Again {
    /// What the section is.
    pub title: Title,
    /// Where it begins in the first run.
    pub a: Place,
    /// In the second.
    pub b: Place,
}

/// At what runs are cut into sections.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum By {
    /// At tool changes.
    Tools,
    /// At comments that name operations.
    Operations,
}

/// What a section is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Title {
    /// What comes before the first of the others.
    Start,
    /// From the change of a tool to the next change.
    Tool(Option<u32>),
    /// From a comment that names what follows to the next one.
    Operation(Shared<str>),
}

/// A section of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SectionAt {
    /// What it is.
    pub title: Title,
    /// What the program calls it; may be empty.
    pub name: Shared<str>,
    /// Its place among the sections of its run, 1 the first.
    pub place: u32,
    /// Its first block.
    pub first: Place,
    /// Its last line in the file of the first.
    pub last: u32,
}

/// What became of a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// The first run has it alone.
    Removed,
    /// The second run has it alone.
    Added,
    /// Both have it, at different places among the others.
    Moved {
        /// It was compared with its partner.
        is_compared: bool,
    },
}

impl Change {
    /// All kinds, in the order of reports.
    pub const NAMES: [&str; 3] = ["section-removed", "section-added", "section-moved"];

    /// Its name for people and other programs.
    pub const fn name(self) -> &'static str {
        let [removed, added, moved] = Self::NAMES;
        match self {
            Self::Removed => removed,
            Self::Added => added,
            Self::Moved { .. } => moved,
        }
    }
}

/// A section that one of the runs has alone, or has at another place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SectionChange {
    /// What became of it.
    pub change: Change,
    /// In the first run.
    pub a: Option<SectionAt>,
    /// In the second.
    pub b: Option<SectionAt>,
}

/// The corner at which two paths may differ most, because the runs take corners differently.
#[derive(Debug, Clone, PartialEq)]
pub struct Corner {
    /// The move of the first run that begins there.
    pub a: Place,
    /// Where it is.
    pub at: Position,
    /// By how much the paths may differ, millimetres: no more than the tolerances allow, nor than the moves leave room for.
    /// `None` where one of the programs gives no tolerance, so that its control decides.
    pub off: Option<f64>,
    /// How many corners there are of that kind.
    pub count: u64,
}

/// All differences of two runs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Differences {
    /// Where the paths part first, if they do.
    pub parting: Option<Parting>,
    /// Where they part after they were compared again: the first of these places.
    later: Vec<Parting>,
    /// How often the paths part.
    partings: u64,
    /// Set when nothing after the parting is compared: which runs go on there.
    left_alone: Option<[bool; 2]>,
    /// Pieces of path that were compared and are the same.
    pub moves: u64,
    /// A coordinate was unknown and not compared.
    pub unknown: bool,
    /// The first moves of which one ends at a coordinate that is known, and the other one at one that is not.
    pub half_known: Option<[Place; 2]>,
    /// The corner at which the paths may differ most.
    pub corner: Option<Corner>,
    /// At what the runs were cut into sections; `None` where they were compared as a whole.
    by: Option<By>,
    sections: Vec<SectionChange>,
    kept: Vec<Difference>,
    counts: [u64; Aspect::ALL.len()],
    /// The values that differ at the moment: that they differ still is not a further difference.
    current: [Option<[Option<Value>; 2]>; Aspect::ALL.len()],
    digest: Digest,
}

impl Differences {
    /// Do both move the machine the same way?
    pub fn is_same(&self) -> bool {
        self.parting.is_none() && self.sections.is_empty() && self.counts.iter().all(|count| *count == 0)
    }

    /// Do both move the machine the same way in each section, whatever the order of the sections?
    pub fn is_same_but_for_order(&self) -> bool {
        let is_moved = |section: &SectionChange| section.change == Change::Moved { is_compared: true };
        self.parting.is_none()
            && self.sections.iter().all(is_moved)
            && self.counts.iter().all(|count| *count == 0)
    }

    /// The first places at which the paths part.
    pub fn partings(&self) -> impl Iterator<Item = &Parting> {
        self.parting.iter().chain(&self.later)
    }

    /// How often the paths part.
    pub const fn partings_count(&self) -> u64 {
        self.partings
    }

    /// Is nothing compared after the place at which the paths part?
    pub const fn is_cut_short(&self) -> bool {
        self.left_alone.is_some()
    }

    /// At what the runs were cut into sections; `None` where they were compared as a whole.
    pub const fn by(&self) -> Option<By> {
        self.by
    }

    /// The sections that one of the runs has alone, or has at another place: in the order of the second run, and those that
    /// it has not after them.
    pub fn sections(&self) -> &[SectionChange] {
        &self.sections
    }

    /// What was found of sections, before any of them is compared.
    pub(super) fn of_sections(by: By, sections: Vec<SectionChange>, rest: Rest) -> Self {
        let mut found = if rest == Rest::Read { Self::with_digest() } else { Self::default() };
        for SectionChange { change, a, b } in &sections {
            let at = |at: &Option<SectionAt>| at.as_ref().map(|at| (at.title.clone(), at.place));
            found.digest.add(&(change, at(a), at(b)));
        }
        Self { by: Some(by), sections, ..found }
    }

    /// Sections follow that were not compared after those before: what differed there is told again.
    pub(super) fn begin_afresh(&mut self) {
        self.current = [const { None }; Aspect::ALL.len()];
    }

    /// Nothing yet; with a digest to ask for.
    pub(super) fn with_digest() -> Self {
        Self { digest: Digest::begun(), ..Self::default() }
    }

    /// A digest for what is passed over.
    pub(super) fn another_digest(&self) -> Digest {
        self.digest.another()
    }

    /// A name for these very differences, all of them: it stays as long as they do, whatever else changes in the texts. Zero where
    /// the runs are not [read](Rest::Read) to their ends.
    pub fn digest(&self) -> u64 {
        let mut digest = self.digest.clone();
        if let Some(Corner { a: _, at, off, count }) = &self.corner {
            digest.add(&(at, off, count));
        }
        digest.value()
    }

    /// Of which run was the rest left alone, because the paths had parted? How it ends says nothing.
    pub fn left_alone(&self) -> [bool; 2] {
        self.left_alone.unwrap_or_default()
    }

    /// The paths part, and are compared again from there if they are.
    pub(super) fn part(&mut self, parting: Parting) {
        self.partings += 1;
        let Parting { a: _, b: _, at, to, apart, within, again } = &parting;
        self.digest.add(&(at, to, apart, again.as_ref().map(|again| &again.title)));
        // Sections are compared in runs that go to their ends.
        self.left_alone = within.is_none().then(|| parting.to.map(|to| to.is_some()));
        if self.parting.is_none() {
            self.parting = Some(parting);
        } else if self.later.len() + 1 < KEPT {
            self.later.push(parting);
        }
    }

    /// The first differences of each aspect, in the order of the run.
    pub fn kept(&self) -> &[Difference] {
        &self.kept
    }

    /// How often something of an aspect becomes different.
    pub fn count(&self, aspect: Aspect) -> u64 {
        self.counts.get(aspect as usize).copied().unwrap_or(0)
    }

    pub(super) fn add(
        &mut self,
        aspect: Aspect,
        places: (Option<Place>, Option<Place>),
        values: [Option<Value>; 2],
    ) {
        let Some(current) = self.current.get_mut(aspect as usize) else { return };
        if current.as_ref() != Some(&values) {
            *current = Some(values.clone());
            self.add_once(aspect, places, values);
        }
    }

    /// A corner that the runs take differently.
    pub(super) fn add_corner(&mut self, a: Place, at: Position, off: Option<f64>) {
        // What no tolerance bounds is the most.
        let most = |off: Option<f64>| off.unwrap_or(f64::INFINITY);
        match &mut self.corner {
            Some(corner) if most(corner.off) >= most(off) => corner.count += 1,
            corner => {
                let count = corner.as_ref().map_or(0, |corner| corner.count) + 1;
                *corner = Some(Corner { a, at, off, count });
            }
        }
    }

    /// The aspect is the same again.
    pub(super) fn same(&mut self, aspect: Aspect) {
        if let Some(current) = self.current.get_mut(aspect as usize)
            && current.take().is_some()
        {
            self.digest.add(&(aspect, self.moves));
        }
    }

    /// What is passed over and not compared belongs to how the paths part.
    pub(super) fn pass_over(&mut self, over: &Digest) {
        self.digest.add(over);
    }

    pub(super) fn add_once(
        &mut self,
        aspect: Aspect,
        (a, b): (Option<Place>, Option<Place>),
        values: [Option<Value>; 2],
    ) {
        let Some(count) = self.counts.get_mut(aspect as usize) else { return };
        *count += 1;
        self.digest.add(&(aspect, self.moves, &values));
        if *count <= KEPT as u64 {
            self.kept.push(Difference { aspect, a, b, values });
        }
    }
}
