//! The machine of a run, from the configuration and what is usual for the control.
//!
//! Knows: units of configuration files, which codes are work offsets. Must not know: programs, how anything is executed.

use std::collections::BTreeMap;
use std::io;

use gcheck_controls::{Control, Effect, Letter, LetterSet, Unset};
use gcheck_engine::{Axis, BarFeeder, Dynamics, Event, Machine, Model, Position, Tool, Units, WorkOffset};
use gcheck_geometry::{Mm, MmPerMin, Rpm, Seconds};
use gcheck_program::{BlockTable, OKeyword, StatementKind};
use gcheck_toolpath::{Plan, Step, Timing};

use super::rotary::RotaryAxes;
use super::steps::Steps;
use super::tool_table;
use crate::Problem;
use crate::args::{Assignment, VariableName};
use crate::config::{self, ByAxis, ExecutionFacts, FileSettings, MachineTable, ToolTable};

/// The machine, and what output needs to know of it besides.
#[derive(Debug, Clone)]
pub(crate) struct Equipment {
    pub(crate) machine: Machine,
    /// Units at power-on.
    pub(crate) units: Units,
    /// Nobody said them.
    pub(crate) units_assumed: bool,
    pub(crate) timing: Timing,
    /// How long the machine takes, where its acceleration is known.
    pub(crate) plan: Option<Plan>,
    /// The setting that decides how helices are fed, when nobody told its value.
    pub(crate) helix_setting: Option<String>,
    /// Tools of the table on disk, in its order.
    pub(crate) table: Vec<u32>,
    /// Remarks of the table on disk.
    pub(crate) remarks: BTreeMap<u32, String>,
}

/// From where programs are executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Start {
    /// Once, from a control that was just switched on, where that leaves everything at zero.
    Fresh,
    /// From whatever the last program left.
    Any,
}

impl Equipment {
    /// Puts the layers of a configuration together.
    pub(crate) fn new(settings: &FileSettings, model: &Model<'_>, start: Start) -> Result<Self, Problem> {
        let control = model.control();
        let layers = &settings.execution;
        let told = layers.iter().rev().filter(|layer| !layer.is_preset);
        let configured = told.clone().find_map(|layer| layer.units).map(units);
        let default = model.units_at_power_on(&settings.machine.settings);
        let in_force = configured.or(default).unwrap_or(Units::Mm);
        // Where variables that nobody set are zero, so is everything else after a fresh start.
        let fresh = start == Start::Fresh && control.semantics().unset == Unset::Zero;
        let table_units = layers.iter().rev().find_map(|layer| layer.machine.table_units).map(units);
        let mut equipment = Self {
            machine: Machine {
                units: Some(in_force),
                settings: settings.machine.settings.clone(),
                start: fresh.then_some(Position::ZERO),
                table_units,
                fresh,
                bar: BarFeeder { starts_new: start == Start::Fresh, ..BarFeeder::default() },
                ..Machine::default()
            },
            units: in_force,
            units_assumed: configured.is_none(),
            timing: Timing::new(None, None),
            plan: None,
            helix_setting: None,
            table: Vec::new(),
            remarks: BTreeMap::new(),
        };
        let mut rotary = RotaryAxes::default();
        for layer in layers {
            let in_layer = layer.units.map_or(in_force, units);
            equipment.put(layer, in_layer, control)?;
            rotary.put(&layer.machine, in_layer);
        }
        equipment.machine.kinematics = rotary.kinematics();
        equipment.machine.rotary_centre = rotary.centre();
        equipment.machine.shorter_way = rotary.shorter_way().to_vec();
        equipment.timing = Timing::of_machine(model, &equipment.machine);
        equipment.contradictions(in_force)?;
        equipment.switch_positions(control)?;
        equipment.plan = Plan::of_machine(model, &equipment.machine, &equipment.timing);
        let helix = control.semantics().helix.setting.as_ref();
        equipment.helix_setting =
            helix.filter(|number| !equipment.machine.settings.contains_key(*number)).cloned();
        Ok(equipment)
    }

    fn put(&mut self, layer: &ExecutionFacts, units: Units, control: &Control) -> Result<(), Problem> {
        let mm = units.in_mm();
        let table = &layer.machine;
        let machine = &mut self.machine;
        if let Some(axes) = &table.axes {
            machine.axes = Some(axes.value.iter().filter_map(|axis| axis_of(&axis.value)).collect());
        }
        for (axis, travel) in &table.travel {
            if let Some(axis) = axis_of(&axis.value) {
                let [low, high] = travel.value.map(|end| in_mm(axis, end, mm));
                machine.travel.insert(axis, (low, high));
            }
        }
        let value = |placed: &Option<config::Placed<f64>>| placed.as_ref().map(|placed| placed.value);
        machine.max_rpm = value(&table.max_rpm).map(Rpm).or(machine.max_rpm);
        machine.max_feed = value(&table.max_feed).map(|feed| MmPerMin(feed * mm)).or(machine.max_feed);
        put_dynamics(&mut machine.dynamics, table, mm);
        match table.rapid.as_ref().map(|rapid| &rapid.value) {
            Some(ByAxis::All(rate)) => {
                machine.rapid = Some(MmPerMin(rate * mm));
                machine.dynamics.rapid.retain(|axis, _| axis.is_rotary());
            }
            Some(ByAxis::Each(each)) => {
                machine.dynamics.rapid.extend(by_axis(each, mm));
                // What is not named is as fast as the fastest that is.
                let linear = machine.dynamics.rapid.iter().filter(|(axis, _)| !axis.is_rotary());
                machine.rapid = linear.map(|(_, rate)| *rate).reduce(f64::max).map(MmPerMin);
            }
            None => {}
        }
        machine.bar.new_bar = value(&table.bar_length).map(|bar| Mm(bar * mm)).or(machine.bar.new_bar);
        machine.bar.bars = table.bars.as_ref().map(|bars| bars.value).or(machine.bar.bars);
        machine.tool_change = value(&table.tool_change_seconds).map(Seconds).or(machine.tool_change);
        for (name, value) in &layer.variables {
            if let Some(variable) = VariableName::parse(name) {
                self.set_variable(variable, *value);
            }
        }
        for (name, axes) in &layer.offsets {
            // An offset that the control does not have is for other programs of the folder.
            if let Some(number) = config::work_offset(name, control) {
                self.put_offset(number, axes, mm);
            }
        }
        if let Some(path) = &layer.table {
            let units = self.machine.table_units.unwrap_or(units);
            let read = tool_table::read(path, units)?;
            self.machine.tools = read.tools.iter().map(|(number, tool)| (*number, *tool)).collect();
            self.table = read.tools.iter().map(|(number, _)| *number).collect();
            self.remarks = read.remarks;
            self.machine.tool_table_is_complete = true;
        }
        for (number, tool) in &layer.tools {
            self.put_tool(*number, tool, mm);
        }
        Ok(())
    }

    /// What layers say together, and a single one did not show.
    fn contradictions(&self, units: Units) -> Result<(), Problem> {
        let dynamics = &self.machine.dynamics;
        if !dynamics.jerk.is_empty() && dynamics.acceleration.is_empty() {
            return Err(Problem::new(format!("[machine] {}", config::JERK_ALONE)));
        }
        if !dynamics.acceleration.is_empty() && dynamics.acceleration.keys().all(|axis| axis.is_rotary()) {
            return Err(Problem::new(format!("[machine] {}", config::NO_LINEAR)));
        }
        let Some(rapid) = self.machine.rapid else { return Ok(()) };
        let shown = |mm: f64| mm / units.in_mm();
        if let Some(feed) = self.machine.max_feed.filter(|feed| rapid < *feed) {
            return Err(Problem::new(format!(
                "[machine] rapid is {} and max_feed {}: no axis cuts faster than it moves at rapid",
                shown(rapid.0),
                shown(feed.0)
            )));
        }
        let linear = self.machine.dynamics.acceleration.iter().filter(|(axis, _)| !axis.is_rotary());
        let unit = if units == Units::Inch { "inch" } else { "mm" };
        match linear.map(|(_, value)| *value).reduce(f64::min) {
            Some(least) => match config::implausible_acceleration(shown(rapid.0), shown(least), unit) {
                Some(message) => Err(Problem::new(format!("[machine] {message}"))),
                None => Ok(()),
            },
            None => Ok(()),
        }
    }

    /// Positions that the control's switches do not have.
    fn switch_positions(&self, control: &Control) -> Result<(), Problem> {
        let dynamics = &self.machine.dynamics;
        let (limits, name) = (control.limits(), control.name());
        let refused = |key: &str, percent: f64, positions: String, source: &str| {
            let message =
                format!("[machine] {key} is {percent}: the switch of {name} has {positions}  [{source}]");
            Err(Problem::new(message))
        };
        if let (Some(percent), Some(switch)) = (dynamics.feed_override, &limits.feed_override)
            && !switch.takes(percent)
        {
            return refused("feed_override", percent, switch.positions(), &switch.source);
        }
        if let (Some(percent), Some(switch)) = (dynamics.rapid_override, &limits.rapid_override)
            && !switch.takes(percent)
        {
            return refused("rapid_override", percent, switch.positions(), &switch.source);
        }
        Ok(())
    }

    fn put_offset(&mut self, number: u16, axes: &[(String, f64)], mm: f64) {
        // An axis that is left out has no offset.
        let offset = self.machine.offsets.entry(number).or_insert(WorkOffset::ZERO);
        for (name, value) in axes {
            if let Some(axis) = axis_of(name) {
                offset.origin.set(axis, in_mm(axis, *value, mm));
            }
        }
    }

    fn put_tool(&mut self, number: u32, told: &ToolTable, mm: f64) {
        let mut offset = Position::ZERO;
        offset.set(Axis::Z, if self.machine.fresh { 0.0 } else { f64::NAN });
        let tool = self.machine.tools.entry(number).or_insert(Tool {
            pocket: number,
            offset,
            diameter: Mm::UNKNOWN,
            corner_radius: Mm::UNKNOWN,
            angles: [0.0; 2],
            orientation: 0,
        });
        if let Some(length) = told.length {
            tool.offset.set(Axis::Z, length * mm);
        }
        for (name, value) in &told.offset {
            if let Some(axis) = axis_of(&name.value) {
                tool.offset.set(axis, in_mm(axis, *value, mm));
            }
        }
        if let Some(length) = told.posted_length {
            self.machine.posted_lengths.insert(number, Mm(length * mm));
        }
        tool.diameter = told.diameter.map_or(tool.diameter, |diameter| Mm(diameter * mm));
        tool.corner_radius = told.corner_radius.map_or(tool.corner_radius, |radius| Mm(radius * mm));
        tool.orientation =
            told.orientation.as_ref().map_or(tool.orientation, |orientation| orientation.value);
        tool.pocket = told.pocket.unwrap_or(tool.pocket);
        self.put_cutting(number, told, mm);
    }

    fn put_cutting(&mut self, number: u32, told: &ToolTable, mm: f64) {
        let is_told = told.teeth.is_some() || told.surface_speed.is_some() || told.material.is_some();
        if !is_told {
            return;
        }
        let cutting = self.machine.cutting.entry(number).or_default();
        cutting.teeth = told.teeth.as_ref().map(|teeth| teeth.value).or(cutting.teeth);
        cutting.material = told.material.clone().or_else(|| cutting.material.take());
        let scaled = |range: &config::Placed<[f64; 2]>, by: f64| {
            let [low, high] = range.value.map(|value| value * by);
            (low, high)
        };
        cutting.chip_load = told.chip_load.as_ref().map(|range| scaled(range, mm)).or(cutting.chip_load);
        // Of inches, surface speeds count in feet.
        let metres = if mm > 1.0 { 0.3048 } else { 1.0 };
        let speed = told.surface_speed.as_ref().map(|range| scaled(range, metres));
        cutting.surface_speed = speed.or(cutting.surface_speed);
    }

    /// Variables of the command line.
    pub(crate) fn set(&mut self, assignments: &[Assignment]) {
        for assignment in assignments {
            self.set_variable(assignment.variable.clone(), assignment.value);
        }
    }

    fn set_variable(&mut self, variable: VariableName, value: f64) {
        match variable {
            VariableName::Number(number) => {
                self.machine.variables.insert(number, value);
            }
            VariableName::Name(name) => {
                self.machine.parameters.insert(name, value);
            }
        }
    }
}

/// What a layer says of how quickly the machine moves, over what earlier ones said.
fn put_dynamics(dynamics: &mut Dynamics, table: &MachineTable, mm: f64) {
    let number = |placed: &Option<config::Placed<f64>>| placed.as_ref().map(|placed| placed.value);
    let seconds = |placed: &Option<config::Placed<f64>>| number(placed).map(Seconds);
    for (told, known) in
        [(&table.acceleration, &mut dynamics.acceleration), (&table.jerk, &mut dynamics.jerk)]
    {
        match told.as_ref().map(|told| &told.value) {
            Some(ByAxis::All(value)) => {
                let linear = Axis::ALL.into_iter().filter(|axis| !axis.is_rotary());
                known.extend(linear.map(|axis| (axis, value * mm)));
            }
            Some(ByAxis::Each(each)) => known.extend(by_axis(each, mm)),
            None => {}
        }
    }
    dynamics.block_time = seconds(&table.block_time).or(dynamics.block_time);
    dynamics.look_ahead = table.look_ahead.as_ref().map(|ahead| ahead.value).or(dynamics.look_ahead);
    let change = number(&table.corner_speed_change).map(|change| MmPerMin(change * mm));
    dynamics.corner_change = change.or(dynamics.corner_change);
    let spindle = number(&table.spindle_acceleration).map(Rpm);
    dynamics.spindle_acceleration = spindle.or(dynamics.spindle_acceleration);
    dynamics.orientation = seconds(&table.spindle_orient_seconds).or(dynamics.orientation);
    dynamics.auxiliary = seconds(&table.auxiliary_seconds).or(dynamics.auxiliary);
    dynamics.pocket = seconds(&table.pocket_seconds).or(dynamics.pocket);
    dynamics.pockets = table.pockets.as_ref().map(|pockets| pockets.value).or(dynamics.pockets);
    if let Some(changer) = table.tool_changer {
        dynamics.turns_ahead = changer == config::ToolChanger::Arm;
    }
    dynamics.feed_override = number(&table.feed_override).or(dynamics.feed_override);
    dynamics.rapid_override = number(&table.rapid_override).or(dynamics.rapid_override);
    dynamics.rotary_rapid = number(&table.rotary_rapid).or(dynamics.rotary_rapid);
}

fn by_axis(
    each: &BTreeMap<config::Placed<String>, config::Placed<f64>>,
    mm: f64,
) -> impl Iterator<Item = (Axis, f64)> + '_ {
    each.iter().filter_map(move |(name, value)| {
        let axis = axis_of(&name.value)?;
        Some((axis, in_mm(axis, value.value, mm)))
    })
}

pub(super) fn units(units: config::Units) -> Units {
    match units {
        config::Units::Mm => Units::Mm,
        config::Units::Inch => Units::Inch,
    }
}

fn axis_of(name: &str) -> Option<Axis> {
    Axis::of(Letter::parse(&name.to_ascii_uppercase())?)
}

fn in_mm(axis: Axis, value: f64, mm: f64) -> f64 {
    if axis.is_rotary() { value } else { value * mm }
}

/// The axes that a control may have.
pub(super) fn axes_of(model: &Model<'_>) -> Vec<Axis> {
    let control = model.control();
    let increments: Vec<Letter> =
        model.semantics().increments.keys().filter_map(|letter| Letter::parse(letter)).collect();
    let is_axis =
        |axis: &Axis| control.axes().contains(axis.letter()) && !increments.contains(&axis.letter());
    Axis::ALL.into_iter().filter(is_axis).collect()
}

/// Which axes the blocks of a file name.
pub(super) struct AxesSeen<'m> {
    model: &'m Model<'m>,
    letters: LetterSet,
    /// A block says in which units it is written.
    pub(super) says_units: bool,
    /// Something is called, which may be in another file and move what it likes.
    pub(super) calls: bool,
}

impl<'m> AxesSeen<'m> {
    pub(super) fn new(model: &'m Model<'m>) -> Self {
        Self { model, letters: LetterSet::EMPTY, says_units: false, calls: false }
    }

    pub(super) fn look(&mut self, table: &BlockTable) {
        let is_call =
            |kind: &StatementKind| matches!(kind, StatementKind::OWord { keyword: OKeyword::Call, .. });
        self.calls |= table.all_statements().iter().any(|(_, statement)| is_call(&statement.kind));
        for (_, block) in table.blocks() {
            let mut has_arguments = false;
            if block.letters.intersects(LetterSet::of("GM")) {
                for word in table.words(block) {
                    let effect = self.model.effect(word.code);
                    let is_macro = matches!(effect, Effect::MacroCall | Effect::MacroModal)
                        || self.model.control().code_at(word.code).is_some_and(|code| code.alias().is_some());
                    // A word for the time of a dwell moves no axis.
                    has_arguments |= is_macro || effect == Effect::Dwell;
                    self.says_units |= matches!(effect, Effect::Inch | Effect::Millimetre);
                    self.calls |= is_macro || effect == Effect::CallProgram;
                }
            }
            if !has_arguments {
                self.letters = self.letters.or(block.letters);
            }
        }
    }

    /// Those of the machine that are named, by themselves or by their increments, and the ones that every mill or lathe has.
    pub(super) fn axes(&self, machine: Option<&[Axis]>) -> Vec<Axis> {
        let control = self.model.control();
        let usual = match control.machine() {
            gcheck_controls::Machine::Mill => LetterSet::of("XYZ"),
            gcheck_controls::Machine::Lathe => LetterSet::of("XZ"),
        };
        let increments = &self.model.semantics().increments;
        let increased = increments.iter().filter_map(|(letter, axis)| {
            let named = Letter::parse(letter).is_some_and(|letter| self.letters.contains(letter));
            if named { Letter::parse(axis) } else { None }
        });
        let shown = self.letters.or(usual).or(increased.collect());
        let all = machine.map_or_else(|| axes_of(self.model), <[Axis]>::to_vec);
        all.into_iter().filter(|axis| shown.contains(axis.letter())).collect()
    }
}

/// Finds the axes that move.
#[derive(Debug, Default)]
pub(super) struct AxesMoved(Vec<Axis>);

impl Steps for AxesMoved {
    fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        let (from, to) = match step.event {
            Event::Travel(travel) => (&travel.from, &travel.to),
            Event::Arc(arc) => (&arc.from, &arc.to),
            Event::Curve(curve) => (&curve.from, &curve.to),
            Event::RigidTap { from, to, .. } => (from, to),
            _ => return Ok(()),
        };
        for axis in Axis::ALL {
            if from.raw(axis).to_bits() != to.raw(axis).to_bits() && !self.0.contains(&axis) {
                self.0.push(axis);
            }
        }
        Ok(())
    }
}

impl AxesMoved {
    /// Together with others, in the usual order.
    pub(super) fn and(self, others: &[Axis]) -> Vec<Axis> {
        Axis::ALL.into_iter().filter(|axis| self.0.contains(axis) || others.contains(axis)).collect()
    }
}
