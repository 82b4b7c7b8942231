//! The machine at hand, as far as somebody told us: axes, offsets, tools, settings, variables.
//!
//! Knows: the values of configuration in millimetres and degrees. Must not know: files, keys, programs. Everything may be
//! unknown; what the engine then assumes goes into the list of assumptions.

use std::collections::BTreeMap;

use gcheck_controls::{Control, CycleRules, CylinderRules, Unset};
use gcheck_geometry::{Kinematics, Mm, MmPerMin, Rpm, Seconds};

use crate::event::Units;
use crate::lattice::lattice;
use crate::model::Model;
use crate::position::{Axis, Position};

/// What is known of the machine.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Machine {
    /// Axes; all that the control may have when not given.
    pub axes: Option<Vec<Axis>>,
    /// Units at power-on.
    pub units: Option<Units>,
    /// Lowest and highest machine coordinate by axis.
    pub travel: BTreeMap<Axis, (f64, f64)>,
    /// Fastest spindle speed.
    pub max_rpm: Option<Rpm>,
    /// Fastest cutting feed.
    pub max_feed: Option<MmPerMin>,
    /// Rapid rate.
    pub rapid: Option<MmPerMin>,
    /// Time of a tool change.
    pub tool_change: Option<Seconds>,
    /// The control's settings by number, values as its page words them.
    pub settings: BTreeMap<String, String>,
    /// Variables set before the program starts.
    pub variables: BTreeMap<u32, f64>,
    /// Named parameters set before the program starts, lower case.
    pub parameters: BTreeMap<String, f64>,
    /// Work offsets by number (1 = the first).
    pub offsets: BTreeMap<u16, WorkOffset>,
    /// Tools by number.
    pub tools: BTreeMap<u32, Tool>,
    /// Machine coordinates at the start; `None` unknown.
    pub start: Option<Position>,
    /// Tools not in `tools` do not exist (a whole tool table was given).
    pub tool_table_is_complete: bool,
    /// Units of the control's tables of offsets and tools; those of the program when not given.
    pub table_units: Option<Units>,
    /// The rotary axes that tilt the tool or the part.
    pub kinematics: Option<Kinematics>,
    /// Machine coordinates of the point in which the rotary axes of the table meet, or of one on the first.
    pub rotary_centre: Option<[Mm; 3]>,
    /// Rotary axes whose positions are reached the shorter way, as angles within a turn.
    pub shorter_way: Vec<Axis>,
    /// By number of the tool: the length that programs were posted for.
    pub posted_lengths: BTreeMap<u32, Mm>,
    /// Numbered variables that nobody set hold zero (the state after a fresh start).
    pub fresh: bool,
    /// The bar feeder of a lathe.
    pub bar: BarFeeder,
    /// By number of the tool: how it cuts.
    pub cutting: BTreeMap<u32, Cutting>,
    /// How quickly axes and spindle change their speed, and what else takes time.
    pub dynamics: Dynamics,
    /// What a run takes for what nobody told.
    pub guesses: Guesses,
    /// The program is one that others call: feed, speed and tool are what they give, whatever that is.
    pub is_called: bool,
}

/// What nobody told of a machine and its work, as one run may find it. An analysis of all paths takes none of it: there
/// anything may be.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Guesses {
    /// What numbered variables hold that no program wrote: common ones, and those of the control whose value is not followed.
    pub variables: BTreeMap<u32, f64>,
    /// The share of their way, 0 to 1, after which probing moves touch; 1 touches nothing.
    pub touch: Option<f64>,
}

/// What of a machine decides how long a program takes. What is not given is not known.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Dynamics {
    /// Acceleration by axis, millimetres or degrees a second squared.
    pub acceleration: BTreeMap<Axis, f64>,
    /// Jerk by axis, millimetres or degrees a second cubed.
    pub jerk: BTreeMap<Axis, f64>,
    /// Rapid rate of axes that differ from the others, millimetres or degrees a minute.
    pub rapid: BTreeMap<Axis, f64>,
    /// What the control takes to prepare a block.
    pub block_time: Option<Seconds>,
    /// How many blocks the control looks ahead.
    pub look_ahead: Option<u32>,
    /// By how much the speed of an axis may change at a corner.
    pub corner_change: Option<MmPerMin>,
    /// What the spindle gains in a second.
    pub spindle_acceleration: Option<Rpm>,
    /// What turning the spindle to an angle takes.
    pub orientation: Option<Seconds>,
    /// What an auxiliary function takes: coolant, chuck, the shop's own codes.
    pub auxiliary: Option<Seconds>,
    /// What the magazine takes to pass one pocket.
    pub pocket: Option<Seconds>,
    /// Pockets around the magazine.
    pub pockets: Option<u32>,
    /// The magazine turns to the next tool while the machine cuts.
    pub turns_ahead: bool,
    /// Position of the feed override switch, percent.
    pub feed_override: Option<f64>,
    /// Position of the rapid override switch, percent.
    pub rapid_override: Option<f64>,
    /// Rapid rate of the rotary axes, degrees a minute.
    pub rotary_rapid: Option<f64>,
}

/// A bar feeder.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BarFeeder {
    /// Length of a new bar.
    pub new_bar: Option<Mm>,
    /// Bars to be used up: the one in the chuck at the start, and those in the magazine.
    pub bars: Option<u32>,
    /// A new bar is in the chuck at the start, pushed out as a new bar is; else whatever the last program left.
    pub starts_new: bool,
}

lattice! {
    /// A work coordinate system.
    #[derive(Debug, Clone, Copy)]
    pub struct WorkOffset {
        /// Its origin in machine coordinates.
        pub origin: Position,
        /// Rotation about Z, degrees.
        pub rotation: f64,
    }
}

impl WorkOffset {
    /// Nothing is known of it.
    pub const UNKNOWN: Self = Self { origin: Position::UNKNOWN, rotation: f64::NAN };
    /// Nobody told its origin; it is taken not to be turned.
    pub const UNTOLD: Self = Self { origin: Position::UNKNOWN, rotation: 0.0 };
    /// At the machine's zero.
    pub const ZERO: Self = Self { origin: Position::ZERO, rotation: 0.0 };
}

/// A tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tool {
    /// Pocket in the changer.
    pub pocket: u32,
    /// Offsets by axis: the length on Z.
    pub offset: Position,
    /// Diameter; NaN unknown.
    pub diameter: Mm,
    /// Corner or nose radius; NaN unknown.
    pub corner_radius: Mm,
    /// Lathe tool angles.
    pub angles: [f64; 2],
    /// Lathe orientation, 0 to 9.
    pub orientation: u8,
}

/// How a tool cuts, as far as somebody told.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cutting {
    /// Its teeth.
    pub teeth: Option<u32>,
    /// The class of material that the limits hold for, for people.
    pub material: Option<String>,
    /// Lowest and highest chip load, millimetres a tooth.
    pub chip_load: Option<(f64, f64)>,
    /// Lowest and highest surface speed, metres a minute.
    pub surface_speed: Option<(f64, f64)>,
}

impl Cutting {
    /// What each tooth cuts at a feed in millimetres a turn.
    pub fn load(&self, feed_per_turn: f64) -> Option<Mm> {
        self.teeth.filter(|teeth| *teeth > 0).map(|teeth| Mm(feed_per_turn / f64::from(teeth)))
    }
}

impl Tool {
    /// Speed of the edge at a speed of the spindle, metres a minute; NaN where the diameter is unknown.
    pub fn surface_speed(&self, turns: Rpm) -> f64 {
        std::f64::consts::PI * self.diameter.0 * turns.0 / 1000.0
    }
}

impl Machine {
    /// The point in which the rotary axes of the table meet: configured, or from the control's settings.
    pub fn rotary_centre(&self, model: &Model<'_>) -> Option<[Mm; 3]> {
        if self.rotary_centre.is_some() {
            return self.rotary_centre;
        }
        let numbers = model.semantics().rotary_centre_settings.as_ref()?;
        let unit = self.units.unwrap_or(Units::Mm).in_mm();
        let mut centre = [Mm::ZERO; 3];
        for (slot, number) in centre.iter_mut().zip(numbers) {
            *slot = Mm(self.settings.get(number)?.parse::<f64>().ok()? * unit);
        }
        Some(centre)
    }

    /// The machine at the one run of a program that somebody looks at: a new bar is in the chuck, and where variables that
    /// nobody set are zero, so is everything else after the control was switched on.
    #[must_use]
    pub fn just_switched_on(&self, control: &Control) -> Self {
        let mut machine = self.clone();
        machine.bar.starts_new = true;
        if control.semantics().unset == Unset::Zero {
            machine.fresh = true;
            machine.start = machine.start.or(Some(Position::ZERO));
            for tool in machine.tools.values_mut().filter(|tool| tool.offset.get(Axis::Z).is_none()) {
                tool.offset.set(Axis::Z, 0.0);
            }
        }
        machine
    }

    /// The setting that gives cylinders on a rotary axis their diameter: the first is that of the machine's first rotary axis.
    pub fn cylinder_setting<'r>(&self, rotary: Axis, rules: &'r CylinderRules) -> Option<&'r str> {
        let rotary_axes: Vec<Axis> = match &self.axes {
            Some(axes) => {
                Axis::ALL.into_iter().filter(|axis| axis.is_rotary() && axes.contains(axis)).collect()
            }
            // Of a machine that nobody described, as most are numbered.
            None => vec![Axis::A, Axis::B],
        };
        let place = rotary_axes.iter().position(|axis| *axis == rotary)?;
        rules.settings.get(place).map(String::as_str)
    }

    /// A setting's value: configured, or the default that the knowledge base assumes.
    pub fn setting<'a>(&'a self, control: &'a Control, number: &str) -> Option<&'a str> {
        match self.settings.get(number) {
            Some(value) => Some(value),
            None => control.setting(number)?.default.as_deref(),
        }
    }

    /// What settings say of pecks: how far they back off, where that is told, and how far above `R` they come out. A setting
    /// counts in the unit of the program, which has so many millimetres.
    pub fn settings_of_pecks(&self, rules: &CycleRules, unit: f64) -> (Option<Mm>, Mm) {
        let told = |number: &Option<String>| {
            let text = self.settings.get(number.as_deref()?)?;
            text.parse::<f64>().ok().map(|length| Mm(length * unit))
        };
        (told(&rules.clearance_setting), told(&rules.above_r_setting).unwrap_or(Mm::ZERO))
    }
}
