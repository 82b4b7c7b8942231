//! What a run amounts to, tool by tool: times, ways, extents, feeds, speeds, offsets.
//!
//! Knows: what is counted, and what cannot be. Must not know: how it is shown ([`crate::Names`] and the summary do that),
//! what the figures are good for.

use std::collections::BTreeMap;

use gcheck_engine::{Axis, Clearing, Cutting, Event, FeedMode, Machine, Position, Spindle, Tool, Units};
use gcheck_geometry::{Bounds, Degrees, Mm, Rpm, Seconds};
use gcheck_planner::Shares;

use crate::bar::BarFigures;
use crate::corner_mode::{CornerMode, is_of_cycle};
use crate::estimate::{Estimate, Kind as TimeOf, Stretch, Tag};
use crate::motion::{Cover, Motion, Way, cover};
use crate::plan::Plan;
use crate::slowest::Place as SlowPlace;
use crate::step::{Beside, Step, View};
use crate::time::{Clock, Timing, Untimed, length};
use crate::values::Values;

/// More tool sections are added to earlier ones of the same tool.
pub const MAX_SECTIONS: usize = 1_000;
/// More work offsets in a section are counted as one.
const MAX_OFFSETS: usize = 512;

/// More ways of taking corners in a section are not listed.
const MAX_CORNER_MODES: usize = 8;

/// Where the time goes. What needs a [`Plan`] is zero without one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Times {
    /// Moves at feed, threads and probing among them, at the feed that the program asks for or the axes allow.
    pub cutting: Seconds,
    /// Rapid moves at the rapid rates.
    pub rapid: Seconds,
    /// What speeding up, slowing down and corners add to both.
    pub acceleration: Seconds,
    /// Waiting for blocks that the control has not prepared yet.
    pub starved: Seconds,
    /// Waiting for the spindle.
    pub spindle: Seconds,
    /// Standing still.
    pub dwell: Seconds,
    /// Auxiliary functions.
    pub auxiliary: Seconds,
    /// Tool changes.
    pub tool_change: Seconds,
}

impl Times {
    /// All of it.
    pub fn total(&self) -> Seconds {
        self.cutting
            + self.rapid
            + self.acceleration
            + self.starved
            + self.spindle
            + self.dwell
            + self.auxiliary
            + self.tool_change
    }

    fn add(&mut self, other: &Self) {
        self.cutting += other.cutting;
        self.rapid += other.rapid;
        self.acceleration += other.acceleration;
        self.starved += other.starved;
        self.spindle += other.spindle;
        self.dwell += other.dwell;
        self.auxiliary += other.auxiliary;
        self.tool_change += other.tool_change;
    }

    /// Adds what the planner found for a stretch.
    fn put(&mut self, kind: TimeOf, shares: &Shares) {
        match kind {
            TimeOf::Rapid => self.rapid += shares.run,
            TimeOf::Cut | TimeOf::Stand => self.cutting += shares.run,
            TimeOf::Pocket => self.cutting += shares.run + shares.dwell,
        }
        if kind != TimeOf::Pocket {
            self.dwell += shares.dwell;
        }
        self.acceleration += shares.acceleration;
        self.starved += shares.starved;
        self.spindle += shares.spindle;
        self.auxiliary += shares.auxiliary;
        self.tool_change += shares.tool_change;
    }
}

/// Feeds of moves that cut, by feed mode.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Feeds {
    /// Millimetres a minute (degrees a minute where only rotary axes moved, as many as millimetres).
    pub per_minute: Values,
    /// Millimetres a turn, leads among them.
    pub per_revolution: Values,
    /// Moves a minute.
    pub inverse_time: Values,
}

/// A work coordinate system that was used.
#[derive(Debug, Clone, PartialEq)]
pub struct OffsetUse {
    /// Its number, 1 the first; `None` when it is unknown or was never said.
    pub number: Option<u16>,
    /// Where moves went in its coordinates.
    pub extents: Bounds,
}

/// Moves that are missing in the figures, or partly so.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Unaccounted {
    /// From or to an unknown point: neither in ways nor in times.
    pub points: u64,
    /// Without a feed, or at feed zero: not in times.
    pub feeds: u64,
    /// Tied to a spindle whose speed is unknown or zero: not in times.
    pub speeds: u64,
    /// Beside an axis of which nobody knows anything: counted without it.
    pub partly: u64,
    /// Dwells of unknown time.
    pub dwells: u64,
    /// Arcs of which only the ends are in the extents in machine coordinates.
    pub arcs_by_ends: u64,
    /// Moves of which the place in machine coordinates is unknown on an axis that is shown.
    pub machine: u64,
    /// Pockets that the control clears with a tool or a feed that is unknown: not in ways, times and extents.
    pub pockets: u64,
}

/// From one tool change to the next, or a whole run.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// The tool; `None` unknown.
    pub tool: Option<u32>,
    /// It began with a tool change.
    pub changed: bool,
    /// File in which it began.
    pub file: String,
    /// Line in which it began, counted from 1.
    pub line: u32,
    /// Where the time goes.
    pub times: Times,
    /// Way of rapid moves.
    pub rapid: Mm,
    /// Way of moves at feed.
    pub cutting: Mm,
    /// Angle turned where only rotary axes moved.
    pub turned: Degrees,
    /// Moves of any kind.
    pub moves: u64,
    /// Circular and helical moves among them.
    pub arcs: u64,
    /// Probing moves among them.
    pub probes: u64,
    /// Holes drilled, bored or tapped by canned cycles: strokes in and out along an axis, each place once.
    pub holes: u64,
    /// Tool changes.
    pub tool_changes: u64,
    /// Where moves at feed went, in work coordinates; probing left out.
    pub cut: Bounds,
    /// The same, with the place of the tip where a length is added along a tilting tool: as far as it is known, else where the
    /// program was posted, as pictures show it.
    pub tip: Bounds,
    /// Where all moves went, in machine coordinates.
    pub machine: Bounds,
    /// Feeds of moves that cut.
    pub feeds: Feeds,
    /// Speeds of the spindle while cutting, turns a minute.
    pub speeds: Values,
    /// Surface speeds while cutting, metres a minute.
    pub surface_speeds: Values,
    /// What each tooth cuts, millimetres, where the teeth of the tool are known.
    pub chip_loads: Values,
    /// Speeds of the edge of a milling tool whose diameter is known, metres a minute.
    pub edge_speeds: Values,
    /// How corners were taken while cutting, each once, in order.
    pub corners: Vec<CornerMode>,
    /// Work coordinate systems in which something moved, with the way of all moves.
    pub offsets: Vec<OffsetUse>,
    /// The part of the cutting time that is an estimate: pockets that the control clears by a path of its own.
    pub estimated: Seconds,
    /// What the figures lack.
    pub unaccounted: Unaccounted,
}

impl Section {
    fn new(tool: Option<u32>, changed: bool, step: &Step<'_>) -> Self {
        Self {
            tool,
            changed,
            file: step.file.to_owned(),
            line: step.line,
            times: Times::default(),
            rapid: Mm::ZERO,
            cutting: Mm::ZERO,
            turned: Degrees::ZERO,
            moves: 0,
            arcs: 0,
            probes: 0,
            holes: 0,
            tool_changes: 0,
            cut: Bounds::EMPTY,
            tip: Bounds::EMPTY,
            machine: Bounds::EMPTY,
            feeds: Feeds::default(),
            speeds: Values::default(),
            surface_speeds: Values::default(),
            chip_loads: Values::default(),
            edge_speeds: Values::default(),
            corners: Vec::new(),
            offsets: Vec::new(),
            estimated: Seconds::ZERO,
            unaccounted: Unaccounted::default(),
        }
    }

    fn merge(&mut self, other: &Self) {
        self.times.add(&other.times);
        self.rapid += other.rapid;
        self.cutting += other.cutting;
        self.turned += other.turned;
        self.estimated += other.estimated;
        self.moves += other.moves;
        self.arcs += other.arcs;
        self.probes += other.probes;
        self.holes += other.holes;
        self.tool_changes += other.tool_changes;
        self.cut.include_bounds(&other.cut);
        self.tip.include_bounds(&other.tip);
        self.machine.include_bounds(&other.machine);
        self.feeds.per_minute.merge(&other.feeds.per_minute);
        self.feeds.per_revolution.merge(&other.feeds.per_revolution);
        self.feeds.inverse_time.merge(&other.feeds.inverse_time);
        self.speeds.merge(&other.speeds);
        self.surface_speeds.merge(&other.surface_speeds);
        self.chip_loads.merge(&other.chip_loads);
        self.edge_speeds.merge(&other.edge_speeds);
        for mode in &other.corners {
            self.take_corners(*mode);
        }
        for used in &other.offsets {
            self.offset(used.number).include_bounds(&used.extents);
        }
        let Unaccounted { points, feeds, speeds, partly, dwells, arcs_by_ends, machine, pockets } =
            other.unaccounted;
        self.unaccounted.points += points;
        self.unaccounted.feeds += feeds;
        self.unaccounted.speeds += speeds;
        self.unaccounted.partly += partly;
        self.unaccounted.dwells += dwells;
        self.unaccounted.arcs_by_ends += arcs_by_ends;
        self.unaccounted.machine += machine;
        self.unaccounted.pockets += pockets;
    }

    /// Nothing is known of a tool, none was called, and nothing that the figures count was done.
    fn is_before_any_tool(&self) -> bool {
        let no_tool = !self.changed && self.tool.is_none();
        no_tool && self.times.total() <= Seconds::ZERO && self.cutting <= Mm::ZERO && self.rapid <= Mm::ZERO
    }

    /// Where all moves went, in the work coordinates that were active.
    pub fn work(&self) -> Bounds {
        self.offsets.iter().fold(Bounds::EMPTY, |all, used| all.union(&used.extents))
    }

    /// How a cut is made: feed, speed, and what the edge of the tool does.
    fn add_rates(
        &mut self,
        rpm: f64,
        feed: Option<(f64, FeedMode)>,
        surface: Option<f64>,
        (load, speed): (Option<f64>, Option<f64>),
    ) {
        match feed {
            Some((feed, _)) if feed <= 0.0 => {}
            Some((feed, FeedMode::PerMinute)) => self.feeds.per_minute.add(feed),
            Some((feed, FeedMode::PerRevolution)) => self.feeds.per_revolution.add(feed),
            Some((feed, FeedMode::InverseTime)) => self.feeds.inverse_time.add(feed),
            None => {}
        }
        match surface {
            None => self.speeds.add(rpm),
            Some(speed) => self.surface_speeds.add(speed),
        }
        if let Some(load) = load {
            self.chip_loads.add(load);
        }
        if let Some(speed) = speed {
            self.edge_speeds.add(speed);
        }
    }

    /// Where a move goes, in the work offset of this number and on the machine.
    fn add_extents(&mut self, step: &Step<'_>, motion: &Motion, work: Option<u16>, cuts: bool) {
        let mut extents = Bounds::EMPTY;
        include(&mut extents, &motion.from, false);
        include(&mut extents, &motion.to, true);
        if let Some(arc) = &motion.arc {
            extents.include_bounds(&arc.bounds());
        }
        self.offset(work).include_bounds(&extents);
        if cuts {
            self.cut.include_bounds(&extents);
            self.tip.include_bounds(&tilted_tip(step).unwrap_or(extents));
        }
        include(&mut self.machine, &motion.machine_from, false);
        include(&mut self.machine, &motion.machine, true);
    }

    fn take_corners(&mut self, mode: CornerMode) {
        if self.corners.last() != Some(&mode)
            && self.corners.len() < MAX_CORNER_MODES
            && !self.corners.contains(&mode)
        {
            self.corners.push(mode);
        }
    }

    fn offset(&mut self, number: Option<u16>) -> &mut Bounds {
        let found = self.offsets.iter().position(|used| used.number == number);
        let at = found.unwrap_or_else(|| {
            let number = number.filter(|_| self.offsets.len() < MAX_OFFSETS);
            match self.offsets.iter().position(|used| used.number == number) {
                Some(at) => at,
                None => {
                    self.offsets.push(OffsetUse { number, extents: Bounds::EMPTY });
                    self.offsets.len() - 1
                }
            }
        });
        #[expect(clippy::indexing_slicing, reason = "`at` was found or pushed above")]
        &mut self.offsets[at].extents
    }
}

/// Something assumed because the configuration does not say it, and the key that would.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Assumption {
    /// What is assumed.
    pub text: String,
    /// The key in `[machine]`; `None` where there is none.
    pub key: Option<&'static str>,
}

/// Gathers the figures of a run from its events.
#[derive(Debug, Clone)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, each named")]
pub struct Statistics {
    view: View,
    clock: Clock,
    /// The active work coordinate system.
    work: Option<u16>,
    sections: Vec<Section>,
    /// The section being counted.
    current: Option<usize>,
    holes: Holes,
    inch_moves: u64,
    mm_moves: u64,
    rotary_rapids: bool,
    rotary_moves: bool,
    spindle_turns: bool,
    bar: BarFigures,
    helices: bool,
    /// Tools that the machine has, and how they cut.
    tools: BTreeMap<u32, (Option<Tool>, Cutting)>,
    corners: CornerMode,
    /// The run as the machine makes it, where that is known.
    estimate: Option<Estimate>,
    /// Files in the order in which something happened in them.
    files: Vec<String>,
}

impl Statistics {
    /// At the start of a run, with the number of the work coordinate system active there (`None` unknown).
    pub fn new(view: View, timing: Timing, work: Option<u16>) -> Self {
        Self {
            view,
            clock: Clock::new(timing),
            work,
            sections: Vec::new(),
            current: None,
            holes: Holes::default(),
            inch_moves: 0,
            mm_moves: 0,
            rotary_rapids: false,
            rotary_moves: false,
            spindle_turns: false,
            bar: BarFigures::default(),
            helices: false,
            tools: BTreeMap::new(),
            corners: CornerMode::START,
            estimate: None,
            files: Vec::new(),
        }
    }

    /// With the times of a machine that accelerates, where enough is known of it. Without this times are a lower bound:
    /// every move runs at its speed from end to end.
    #[must_use]
    pub fn planned(mut self, plan: Option<&Plan>) -> Self {
        self.estimate = plan.map(|plan| Estimate::new(plan.clone()));
        self
    }

    /// Keeps how fast each stretch of the path is run: memory grows with the run. Nothing without a [`Plan`].
    #[must_use]
    pub fn with_stretches(mut self) -> Self {
        if let Some(estimate) = &mut self.estimate {
            estimate.keep_stretches();
        }
        self
    }

    /// How the machine runs the path, in order; nothing but after [`Self::with_stretches`].
    pub fn stretches(&self) -> &[Stretch] {
        self.estimate.as_ref().map(Estimate::stretches).unwrap_or_default()
    }

    /// With the tools of a machine of which it is known how they cut, so that chip loads and speeds of edges are counted.
    #[must_use]
    pub fn with_tools(mut self, machine: &Machine) -> Self {
        let of = |(number, cutting): (&u32, &Cutting)| {
            (*number, (machine.tools.get(number).copied(), cutting.clone()))
        };
        self.tools = machine.cutting.iter().map(of).collect();
        self
    }

    /// To be called when nothing comes any more, and before any figure is asked for.
    pub fn finish(&mut self) {
        let Self { estimate, sections, .. } = self;
        if let Some(estimate) = estimate {
            estimate.finish(&mut |tag, shares| put(sections, tag, shares));
        }
    }

    /// Are the times those of a machine that accelerates? Else they are a lower bound.
    pub const fn is_planned(&self) -> bool {
        self.estimate.is_some()
    }

    /// Where most time is lost, the worst first; at most [`crate::MAX_PLACES`], none without a [`Plan`].
    pub fn slowest(&self) -> &[SlowPlace] {
        self.estimate.as_ref().map(Estimate::places).unwrap_or_default()
    }

    /// Name of a file of [`Self::slowest`].
    pub fn file(&self, number: u16) -> &str {
        self.files.get(usize::from(number)).map_or("", String::as_str)
    }

    /// Counts an event.
    pub fn add(&mut self, step: &Step<'_>) {
        self.corners.set(step.event);
        match step.event {
            Event::ToolChange(tool) => self.tool_change(step, *tool),
            Event::SetToolNumber(tool) => self.begin(*tool, false, step),
            Event::Dwell(seconds) => {
                let time = self.clock.still(step);
                let section = self.section(step);
                section.unaccounted.dwells += u64::from(!seconds.is_finite());
                self.pause(step, TimeOf::Stand, time);
            }
            Event::Cleared(clearing) => self.cleared(step, clearing),
            Event::WorkOffset { number, .. } => self.work = Some(*number),
            Event::Spindle(turns) => self.spindle_turns |= *turns != Spindle::Stopped,
            Event::Travel(_) | Event::Arc(_) | Event::Curve(_) | Event::RigidTap { .. } => {
                let tracker = self.clock.tracker;
                tracker.motions(step, |motion| self.motion(step, motion));
            }
            event => self.bar.add(event),
        }
        if self.estimate.is_some() {
            let tag = self.tag(step, TimeOf::Stand);
            let surface = self.clock.surface_speed().is_some();
            let Self { estimate, sections, .. } = self;
            if let Some(estimate) = estimate {
                estimate.event(step, surface, tag, &mut |tag, shares| put(sections, tag, shares));
            }
        }
        self.clock.after(step);
    }

    /// Where the time of a step belongs.
    fn tag(&mut self, step: &Step<'_>, kind: TimeOf) -> Tag {
        self.section(step);
        let file = self.files.iter().rposition(|known| known == step.file).unwrap_or_else(|| {
            self.files.push(step.file.to_owned());
            self.files.len() - 1
        });
        let section = self.current.unwrap_or(0) as u32;
        Tag { section, file: u16::try_from(file).unwrap_or(u16::MAX), line: step.line, kind }
    }

    /// The axes do not move for a time.
    fn pause(&mut self, step: &Step<'_>, kind: TimeOf, time: Seconds) {
        let tag = self.tag(step, kind);
        let Self { estimate, sections, .. } = self;
        match estimate {
            Some(estimate) => estimate.pause(time, tag, &mut |tag, shares| put(sections, tag, shares)),
            None => put(sections, tag, &Shares { dwell: time, ..Shares::default() }),
        }
    }

    /// What the bar feeder did.
    pub const fn bar(&self) -> &BarFigures {
        &self.bar
    }

    /// The sections in the order in which they began.
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// The sections in which a tool worked, or moved for a time that counts: not the blocks before the first tool change that
    /// only go home.
    pub fn tools(&self) -> impl Iterator<Item = &Section> {
        // Of a program that does nothing else, they are all that there is to show.
        let all_idle = self.sections.iter().all(Section::is_before_any_tool);
        self.sections.iter().filter(move |section| all_idle || !section.is_before_any_tool())
    }

    /// The whole run; its tool, file and line mean nothing.
    pub fn total(&self) -> Section {
        let mut sections = self.sections.iter();
        let Some(first) = sections.next() else {
            let event = Event::End;
            let nowhere = Step {
                swings: false,
                swung_arc: None,
                event: &event,
                n: None,
                line: 0,
                units: Units::Mm,
                feed_mode: FeedMode::PerMinute,
                feed: 0.0,
                rpm: 0.0,
                machine: Position::UNKNOWN,
                tool: None,
                aim: Position::UNKNOWN,
                h: None,
                d: None,
                beside: None,
                file: "",
                calls: &[],
            };
            return Section::new(None, false, &nowhere);
        };
        sections.fold(first.clone(), |mut total, section| {
            total.merge(section);
            total
        })
    }

    /// The units in which most moves were written.
    pub const fn units(&self) -> Units {
        if self.inch_moves > self.mm_moves { Units::Inch } else { Units::Mm }
    }

    /// Position of the feed override switch in percent, where it is another than 100.
    pub fn feed_override(&self) -> Option<f64> {
        let percent = self.clock.timing.feed_override() * 100.0;
        ((percent - 100.0).abs() > 1e-9).then_some(percent)
    }

    /// Was there an arc that leaves its plane?
    pub const fn has_helices(&self) -> bool {
        self.helices
    }

    /// The axes shown.
    pub const fn view(&self) -> View {
        self.view
    }

    /// What the times rest on that is not configured, as far as it mattered.
    pub fn assumptions(&self) -> Vec<Assumption> {
        let timing = &self.clock.timing;
        let total = self.total();
        let mut assumptions = Vec::new();
        if timing.rapid_assumed && total.rapid > Mm::ZERO {
            let rapid = timing.rapid();
            let rate = match self.units() {
                Units::Inch => format!("{} inch/min", rapid.inch()),
                Units::Mm => format!("{} mm/min", rapid.0),
            };
            assumptions.push(Assumption {
                text: format!("rapid moves at {rate} on every axis"),
                key: Some("rapid"),
            });
        }
        if timing.rotary_assumed && self.rotary_rapids {
            let text = format!("rapid moves of rotary axes at {} deg/min", crate::time::DEFAULT_ROTARY_RAPID);
            assumptions.push(Assumption { text, key: Some("rotary_rapid") });
        }
        if timing.tool_change_assumed && total.times.tool_change > Seconds::ZERO {
            let text = format!("{} s for a tool change", timing.tool_change().0);
            assumptions.push(Assumption { text, key: Some("tool_change_seconds") });
        }
        let Some(plan) = self.estimate.as_ref().map(Estimate::plan) else {
            if total.moves > 0 {
                let text = "axes and spindle reach their speed at once: real times are longer";
                assumptions.push(Assumption { text: text.to_owned(), key: Some("acceleration") });
            }
            return assumptions;
        };
        if plan.rotary_derived && self.rotary_moves {
            let text = "rotary axes reach their rapid rate when X does";
            assumptions.push(Assumption { text: text.to_owned(), key: Some("acceleration") });
        }
        if !plan.knows_spindle() && self.spindle_turns {
            let text = "the spindle reaches its speed at once";
            assumptions.push(Assumption { text: text.to_owned(), key: Some("spindle_acceleration") });
        }
        if plan.control_assumed && total.moves > 0 {
            let text = "how the control takes corners and rapid moves: its builder does not publish it";
            assumptions.push(Assumption { text: text.to_owned(), key: None });
        }
        assumptions
    }

    /// What the control takes to prepare a block; zero where it is not known.
    pub fn block_time(&self) -> Seconds {
        self.estimate.as_ref().map_or(Seconds::ZERO, |estimate| estimate.plan().block_time())
    }

    fn tool_change(&mut self, step: &Step<'_>, tool: Option<u32>) {
        let time = self.clock.still(step);
        self.begin(tool, true, step);
        let is_change = self.clock.changes(tool);
        self.section(step).tool_changes += u64::from(is_change);
        let tag = self.tag(step, TimeOf::Stand);
        let Self { estimate, sections, .. } = self;
        match estimate {
            Some(estimate) if is_change => {
                estimate.change(tool, tag, &mut |tag, shares| put(sections, tag, shares));
            }
            Some(_) => {}
            None => put(sections, tag, &Shares { tool_change: time, ..Shares::default() }),
        }
    }

    /// Begins a section, unless the tool is the one of the current section.
    fn begin(&mut self, tool: Option<u32>, changed: bool, step: &Step<'_>) {
        self.holes = Holes::default();
        let same = |section: &Section| section.tool.is_some() && section.tool == tool;
        if self.current.and_then(|at| self.sections.get(at)).is_some_and(same) {
            return;
        }
        // The tools of the next part are those of the first one.
        if self.bar.is_used()
            && let Some(earlier) = self.sections.iter().rposition(same)
        {
            self.current = Some(earlier);
            return;
        }
        if self.sections.len() >= MAX_SECTIONS {
            let earlier = self.sections.iter().rposition(same);
            self.current = Some(earlier.unwrap_or(MAX_SECTIONS - 1));
            return;
        }
        self.sections.push(Section::new(tool, changed, step));
        self.current = Some(self.sections.len() - 1);
    }

    fn section(&mut self, step: &Step<'_>) -> &mut Section {
        let at = self.current.unwrap_or_else(|| {
            self.sections.push(Section::new(step.tool, false, step));
            self.sections.len() - 1
        });
        self.current = Some(at);
        #[expect(clippy::indexing_slicing, reason = "sections are never removed")]
        &mut self.sections[at]
    }

    /// A pocket that the control clears: its time is an estimate, and reported as one.
    fn cleared(&mut self, step: &Step<'_>, clearing: &Clearing) {
        let work = self.work;
        // The way down into a pocket is not a hole.
        self.holes = Holes::default();
        let section = self.section(step);
        if clearing.length.is_known() && clearing.seconds.is_finite() {
            section.cutting += clearing.length;
            section.estimated += clearing.seconds;
        } else {
            section.unaccounted.pockets += 1;
        }
        let mut extents = Bounds::EMPTY;
        for corner in [clearing.from, clearing.to] {
            let corner = clearing.at.with_xyz(corner);
            include(&mut extents, &corner, true);
            include(&mut section.machine, &(step.machine + (corner - clearing.at)), true);
        }
        section.offset(work).include_bounds(&extents);
        section.cut.include_bounds(&extents);
        section.tip.include_bounds(&extents);
        let time = self.clock.still(step);
        self.pause(step, TimeOf::Pocket, time);
    }

    fn motion(&mut self, step: &Step<'_>, motion: &Motion) {
        match step.units {
            Units::Inch => self.inch_moves += 1,
            Units::Mm => self.mm_moves += 1,
        }
        let (covered, partial) = cover(motion);
        let time = self.clock.motion(step, motion);
        let feed = self.clock.feed_of(step, motion);
        let surface = self.clock.surface_speed();
        let edge = self.edge(step, feed, surface);
        let corners = self.corners;
        let hole = self.holes.after(motion);
        let machine_arc = motion.arc.map(|arc| (arc, self.clock.tracker.machine_arc(motion, &arc)));
        let (view, work) = (self.view, self.work);
        let rapid = motion.way == Way::Rapid;
        let turned = turns(motion);
        self.rotary_rapids |= rapid && turned;
        self.rotary_moves |= turned;
        if !rapid {
            self.bar.cut();
        }
        self.helices |= motion.arc.is_some_and(|arc| arc.rise().0.abs() > 0.0);

        let section = self.section(step);
        section.moves += 1;
        section.arcs += u64::from(motion.arc.is_some());
        section.probes += u64::from(motion.way == Way::Probe);
        section.holes += u64::from(hole);
        section.unaccounted.partly += u64::from(
            partial && covered != Cover::Unknown && view.axes().any(|axis| never_known(motion, axis)),
        );
        match time {
            Ok(_) => {}
            Err(Untimed::Point) => section.unaccounted.points += 1,
            Err(Untimed::Feed) => section.unaccounted.feeds += 1,
            Err(Untimed::Speed) => section.unaccounted.speeds += 1,
        }
        if rapid {
            section.rapid += length(covered);
        } else {
            section.cutting += length(covered);
        }
        if let Cover::Turn(angle) = covered {
            section.turned += Degrees(angle);
        }
        let cuts = !rapid && motion.way != Way::Probe;
        if cuts && covered != Cover::Nothing {
            if !is_of_cycle(step.event) {
                section.take_corners(corners);
            }
            section.add_rates(step.rpm, feed, surface, edge);
        }
        section.add_extents(step, motion, work, cuts);
        section.unaccounted.machine += u64::from(view.axes().any(|axis| motion.machine.raw(axis).is_nan()));
        match machine_arc {
            Some((arc, Some(machine))) => section.machine.include_bounds(&machine.bounds(motion, &arc)),
            Some((_, None)) => section.unaccounted.arcs_by_ends += 1,
            None => {}
        }
        self.time(step, motion, time);
    }

    /// Chip load and speed of the edge of the tool in the spindle, as far as they are known.
    fn edge(
        &self,
        step: &Step<'_>,
        feed: Option<(f64, FeedMode)>,
        surface: Option<f64>,
    ) -> (Option<f64>, Option<f64>) {
        let known = step.tool.and_then(|tool| self.tools.get(&tool));
        let Some((tool, cutting)) = known.filter(|_| surface.is_none() && step.rpm > 0.0) else {
            return (None, None);
        };
        let per_turn = match feed {
            Some((feed, FeedMode::PerMinute)) => Some(feed / step.rpm),
            Some((feed, FeedMode::PerRevolution)) => Some(feed),
            _ => None,
        };
        let load = per_turn.and_then(|per_turn| cutting.load(per_turn)).map(|load| load.0);
        // Of a turning tool the diameter is not what turns.
        let speed = tool.filter(|_| !self.view.has_diameters()).map(|tool| tool.surface_speed(Rpm(step.rpm)));
        let usable = |figure: &f64| figure.is_finite() && *figure > 0.0;
        (load.filter(usable), speed.filter(usable))
    }

    /// The time of a movement, which takes `asked` at the speed that the program asks for.
    fn time(&mut self, step: &Step<'_>, motion: &Motion, asked: Result<Seconds, Untimed>) {
        let kind = if motion.way == Way::Rapid { TimeOf::Rapid } else { TimeOf::Cut };
        let tag = self.tag(step, kind);
        let tracker = self.clock.tracker;
        let Self { estimate, sections, .. } = self;
        match estimate {
            Some(estimate) => {
                let asked = asked.ok();
                estimate.motion(step, &tracker, motion, asked, tag, &mut |tag, shares| {
                    put(sections, tag, shares);
                });
            }
            None => {
                if let Ok(run) = asked {
                    put(sections, tag, &Shares { run, ..Shares::default() });
                }
            }
        }
    }
}

fn put(sections: &mut [Section], tag: Tag, shares: &Shares) {
    if let Some(section) = sections.get_mut(tag.section as usize) {
        section.times.put(tag.kind, shares);
    }
}

/// Widens a box by the known coordinates of a point, and by the unknown ones where that is asked for.
fn include(bounds: &mut Bounds, position: &Position, unknown: bool) {
    for (axis, value) in position.values().iter().enumerate() {
        if unknown || !value.is_nan() {
            bounds.include_on(axis, *value);
        }
    }
}

/// Where a move leads the tip of a tool that tilts: where nobody knows the tip, the posted point. `None` for any other tool.
fn tilted_tip(step: &Step<'_>) -> Option<Bounds> {
    let Some(Beside::AlongTool { tip }) = step.beside else { return None };
    let mut bounds = Bounds::EMPTY;
    for (axis, value) in tip.unwrap_or_else(|| step.aim.xyz()).into_iter().enumerate() {
        if value.is_known() {
            bounds.include_on(axis, value.0);
        }
    }
    Some(bounds)
}

fn turns(motion: &Motion) -> bool {
    [Axis::A, Axis::B, Axis::C]
        .into_iter()
        .any(|axis| (motion.to.raw(axis) - motion.from.raw(axis)).abs() > 0.0)
}

fn never_known(motion: &Motion, axis: Axis) -> bool {
    motion.from.raw(axis).is_nan() && motion.to.raw(axis).is_nan()
}

/// Finds holes among the moves of canned cycles: a stroke at feed along one axis, and later one back along it, with at
/// most rapid moves beside it between. Strokes at one place in a row are one hole.
#[derive(Debug, Clone, Copy, Default)]
struct Holes {
    stroke: Option<(Axis, bool)>,
    /// The last hole was here: nothing has moved away since.
    counted: bool,
}

impl Holes {
    /// Does this move complete a hole?
    fn after(&mut self, motion: &Motion) -> bool {
        if motion.arc.is_some() || !motion.expanded {
            *self = Self::default();
            return false;
        }
        let mut moved = [Axis::X, Axis::Y, Axis::Z].into_iter().filter_map(|axis| {
            let way = motion.to.raw(axis) - motion.from.raw(axis);
            (way.abs() > 0.0).then_some((axis, way > 0.0))
        });
        let along = match (moved.next(), moved.next()) {
            (None, _) => return false,
            (Some(along), None) => Some(along),
            (Some(_), Some(_)) => None,
        };
        let rapid = motion.way == Way::Rapid;
        let back = matches!((self.stroke, along), (Some((axis, up)), Some((other, other_up)))
            if axis == other && up != other_up);
        if back {
            let first = !self.counted;
            *self = Self { stroke: None, counted: true };
            return first;
        }
        if rapid {
            // A move beside the stroke: the shift of a boring bar, or the way to the next hole.
            if self.stroke.is_none() && along.is_none_or(|(axis, _)| axis != Axis::Z) {
                self.counted = false;
            }
            return false;
        }
        self.stroke = along;
        self.counted &= along.is_some();
        false
    }
}
