//! Whether what a configuration names exists: controls, axes, settings, codes, rules.
//!
//! Knows: where to ask, and how to say what is wrong at its place. Must not know: how TOML is read.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use gcheck_controls::{CodeNumber, Control, Effect, Letter, Machine, UserCode};
use gcheck_geometry::{Direction, MM_PER_INCH, RotaryAxis};
use gcheck_lint::Selection;
use gcheck_rules::RULES;

use super::Placed;
use super::execution_facts::ExecutionFacts;
use super::file::{
    ByAxis, CodeTable, MachineTable, Rotary, RulesTable, Scalar, ToolTable, ToolsTable, Units,
};
use super::text::Text;
use crate::Problem;
use crate::nearest::did_you_mean;

/// Axis addresses of RS-274, which bound what a machine can have when its control is not known.
const AXES: &str = "XYZABCUVW";

/// No linear axis moves faster, in millimetres a minute, nor a rotary one, in degrees a minute.
const FASTEST: f64 = 1e6;
const FASTEST_TURN: f64 = 1e7;
/// No spindle turns faster, 1/min.
const FASTEST_SPINDLE: f64 = 1e6;
/// No axis goes further, in millimetres; a rotary one may count many turns, in degrees.
const FARTHEST: f64 = 1e6;
const FARTHEST_ANGLE: f64 = 1e9;
/// No tool is larger or longer, in millimetres.
const LARGEST_TOOL: f64 = 1e4;
/// Lengths in a configuration that are the same.
const SAME_LENGTH: f64 = 1e-6;
/// No control takes longer for a block, in seconds.
const LONGEST_BLOCK: f64 = 0.2;
/// No tool has more teeth.
const MOST_TEETH: u32 = 200;
/// No control looks further ahead.
const MOST_AHEAD: u32 = 100_000;
/// Between these, in seconds, every machine reaches its rapid rate.
const SHORTEST_START: f64 = 0.001;
const LONGEST_START: f64 = 10.0;
/// Every spindle reaches its highest speed in this time, in seconds.
const LONGEST_SPINDLE_START: f64 = 300.0;

/// Every spindle gains more than the first and less than the second in a second, 1/min.
const SPINDLE_GAIN: [f64; 2] = [5.0, 1e6];
/// No tool change takes longer, nor does an auxiliary function, in seconds.
const LONGEST_CHANGE: f64 = 3600.0;
/// Turning the spindle to an angle takes no longer, nor does a pocket of the magazine, in seconds.
const LONGEST_TURN: f64 = 60.0;
/// No magazine has more pockets.
const MOST_POCKETS: u32 = 1000;
/// No control has a higher feed override, in percent.
const MOST_FEED_OVERRIDE: f64 = 999.0;
/// Lowest and highest acceleration of an axis, millimetres a second squared.
const ACCELERATION: [f64; 2] = [1.0, 1e6];
/// Lowest and highest jerk of an axis, millimetres a second cubed.
const JERK: [f64; 2] = [1.0, 1e9];

/// The rotary axis of a name.
pub(crate) fn rotary_axis(name: &str) -> Option<RotaryAxis> {
    match name.to_ascii_uppercase().as_str() {
        "A" => Some(RotaryAxis::A),
        "B" => Some(RotaryAxis::B),
        "C" => Some(RotaryAxis::C),
        _ => None,
    }
}

/// Values that stand for a kind of value in the list of a setting's values.
const KINDS_OF_VALUES: [&str; 4] = ["length", "number", "on/off", "text"];

/// Checks the parts of one text against the control that it names, if it names one.
pub(super) struct Checked<'t> {
    text: Text<'t>,
    control: Option<Arc<Control>>,
}

impl<'t> Checked<'t> {
    pub(super) fn new(text: Text<'t>, control: Option<&Placed<String>>) -> Result<Self, Problem> {
        let control = control.map(|name| {
            gcheck_controls::load(&name.value)
                .map_err(|error| text.problem(name, unknown_control(&name.value, &error)))
        });
        Ok(Self { text, control: control.transpose()? })
    }

    /// The parts of one text on a control that it does not name.
    pub(super) fn of(text: Text<'t>, control: Arc<Control>) -> Self {
        Self { text, control: Some(control) }
    }

    /// What only the control that runs a program shows to be wrong. A setting, offset or code that it does not have may be meant
    /// for other programs of the folder.
    pub(super) fn on_control(
        &self,
        machine: &MachineTable,
        settings: &BTreeMap<Placed<String>, Placed<Scalar>>,
        codes: &BTreeMap<Placed<String>, CodeTable>,
        offsets: &BTreeMap<Placed<String>, BTreeMap<Placed<String>, f64>>,
    ) -> Result<(), Problem> {
        self.overrides(machine)?;
        for (number, value) in settings {
            self.setting(number, value)?;
        }
        self.codes(codes)?;
        let is_own = |name: &str| {
            let code = name.split_whitespace().next().map(str::to_ascii_uppercase);
            let number = code.and_then(|code| CodeNumber::parse(&code));
            let control = self.control.as_ref();
            number.is_some_and(|number| control.is_some_and(|control| control.code(number).is_some()))
        };
        self.named_offsets(offsets.keys().filter(|name| is_own(&name.value)))
    }

    /// A point has three coordinates.
    fn rotary_centre(&self, table: &MachineTable) -> Result<(), Problem> {
        let centre = &table.rotary_centre;
        for (name, value) in centre {
            if !["X", "Y", "Z"].iter().any(|axis| name.value.eq_ignore_ascii_case(axis)) {
                return Err(self.text.problem(name, "rotary_centre is a point: give X, Y and Z"));
            }
            if !value.value.is_finite() {
                return Err(self.text.problem(value, "a machine coordinate is a number"));
            }
        }
        match centre.keys().next() {
            Some(name) if centre.len() != 3 => {
                Err(self.text.problem(name, "rotary_centre is a point: give X, Y and Z"))
            }
            _ => Ok(()),
        }
    }

    /// A distance between two rotary axes that turn the same side.
    fn rotary_offset(&self, table: &MachineTable) -> Result<(), Problem> {
        for (name, value) in &table.rotary_offset {
            if !["X", "Y", "Z"].iter().any(|axis| name.value.eq_ignore_ascii_case(axis)) {
                return Err(self.text.problem(name, "rotary_offset is a distance in X, Y and Z"));
            }
            if !value.value.is_finite() {
                return Err(self.text.problem(value, "a distance is a number"));
            }
        }
        self.each_axis_once(table.rotary_offset.keys())?;
        let apart = table.rotary.as_ref().is_some_and(|rotary| rotary.value == Rotary::HeadTable);
        match table.rotary_offset.keys().next() {
            Some(name) if apart => {
                let message = "rotary_offset is between two axes of a head or of a table: with `head-table` one axis turns the tool and one the part";
                Err(self.text.problem(name, message).help("rotary_centre says where the table's axis is"))
            }
            _ => Ok(()),
        }
    }

    /// How the rotary axes are built.
    fn rotary(&self, table: &MachineTable) -> Result<(), Problem> {
        if let Some(order) = &table.rotary_order {
            let axes: Vec<Option<RotaryAxis>> = order.iter().map(|name| rotary_axis(&name.value)).collect();
            if let Some((name, _)) = order.iter().zip(&axes).find(|(_, axis)| axis.is_none()) {
                return Err(self.text.problem(name, format!("`{}` is not a rotary axis", name.value)));
            }
            if !matches!(axes.as_slice(), [first, second] if first != second)
                && let Some(name) = order.last()
            {
                return Err(self.text.problem(name, "rotary_order names two different axes"));
            }
        }
        for (axis, sign) in &table.rotary_sign {
            if rotary_axis(&axis.value).is_none() {
                return Err(self.text.problem(axis, format!("`{}` is not a rotary axis", axis.value)));
            }
            if !matches!(sign.value, 1 | -1) {
                return Err(self.text.problem(sign, "a sense of rotation is 1 or -1"));
            }
        }
        for (axis, parts) in &table.rotary_direction {
            if rotary_axis(&axis.value).is_none() {
                return Err(self.text.problem(axis, format!("`{}` is not a rotary axis", axis.value)));
            }
            if Direction::of(parts.value).is_none() {
                let shown = parts.value.map(plain).join(", ");
                let message = format!("[{shown}] is not a direction: an axis turns about a line");
                let help = "write how far the line goes along X, Y and Z: [0.0, 1.0, 1.0] is between Y and Z";
                return Err(self.text.problem(parts, message).help(help));
            }
        }
        self.rotary_lines(table)?;
        for name in table.rotary_shorter_way.iter().flatten() {
            if rotary_axis(&name.value).is_none() {
                return Err(self.text.problem(name, format!("`{}` is not a rotary axis", name.value)));
            }
        }
        Ok(())
    }

    /// Two axes about parallel lines turn nothing that one of them does not.
    fn rotary_lines(&self, table: &MachineTable) -> Result<(), Problem> {
        let line = |axis: RotaryAxis| {
            let given =
                table.rotary_direction.iter().find(|(name, _)| rotary_axis(&name.value) == Some(axis));
            given.map_or(Some(axis.into()), |(_, parts)| Direction::of(parts.value))
        };
        let order = table.rotary_order.iter().flatten().filter_map(|name| rotary_axis(&name.value));
        let [first, second] = order.collect::<Vec<_>>()[..] else { return Ok(()) };
        let is_parallel = line(first).zip(line(second)).is_some_and(|(one, other)| one.is_parallel_to(other));
        match table.rotary_direction.values().max_by_key(|parts| parts.range.start) {
            Some(parts) if is_parallel => {
                Err(self.text.problem(parts, "both axes of rotary_order turn about parallel lines"))
            }
            _ => Ok(()),
        }
    }

    /// `is_whole`: nothing beside the table says anything about these machines.
    pub(super) fn machine(&self, table: &MachineTable, is_whole: bool) -> Result<MachineTable, Problem> {
        let own_axes = || table.axes.iter().flat_map(|axes| &axes.value);
        let lists = [&table.rotary_order, &table.rotary_shorter_way];
        let lists = own_axes().chain(lists.into_iter().flatten().flatten());
        let turning = table.rotary_sign.keys().chain(table.rotary_direction.keys());
        for axis in lists.chain(table.travel.keys()).chain(turning) {
            self.axis(axis)?;
        }
        self.each_axis_once(own_axes())?;
        self.each_axis_once(table.travel.keys())?;
        self.each_axis_once(table.rotary_sign.keys())?;
        self.each_axis_once(table.rotary_direction.keys())?;
        self.each_axis_once(table.rotary_shorter_way.iter().flatten())?;
        self.listed_axes(table)?;
        if let Some(bars) = table.bars.as_ref().filter(|bars| bars.value == 0) {
            return Err(self.text.problem(bars, "at least one bar is in the chuck: write 1 or more"));
        }
        for (axis, travel) in &table.travel {
            let [low, high] = travel.value;
            if !(low.is_finite() && high.is_finite()) {
                let message = format!("travel of {} must have two finite ends", axis.value);
                return Err(self.text.problem(travel, message).help("leave out an axis without an end"));
            }
            let (unit, most) = of_axis(&axis.value, FARTHEST, table.units);
            if let Some(end) = [low, high].into_iter().find(|end| end.abs() > most) {
                let message =
                    format!("no axis goes to {}: an end of travel is at most {most} {unit}", plain(end));
                return Err(self.text.problem(travel, message).help("leave out an axis without an end"));
            }
            if low >= high {
                let message = format!("travel of {} must go from the lower end to the upper", axis.value);
                return Err(self.text.problem(travel, message));
            }
        }
        self.rotary(table)?;
        self.rotary_centre(table)?;
        self.rotary_offset(table)?;
        let positive = [
            &table.max_rpm,
            &table.max_feed,
            &table.rotary_rapid,
            &table.rapid_override,
            &table.corner_speed_change,
            &table.block_time,
            &table.spindle_acceleration,
            &table.bar_length,
        ];
        if let Some(number) = positive.into_iter().flatten().find(|n| n.value.is_nan() || n.value <= 0.0) {
            return Err(self.text.problem(number, "must be greater than zero"));
        }
        let not_negative = [
            &table.tool_change_seconds,
            &table.pocket_seconds,
            &table.spindle_orient_seconds,
            &table.auxiliary_seconds,
            &table.pivot_length,
            &table.feed_override,
        ];
        if let Some(number) = not_negative.into_iter().flatten().find(|n| n.value.is_nan() || n.value < 0.0) {
            return Err(self.text.problem(number, "must not be negative"));
        }
        self.overrides(table)?;
        self.dynamics(table)?;
        if is_whole {
            self.whole(table)?;
        }
        self.bounds(table)?;
        Ok(table.clone())
    }

    /// Names of one table: `X` and `x` are one axis.
    fn each_axis_once<'a>(&self, names: impl Iterator<Item = &'a Placed<String>>) -> Result<(), Problem> {
        let mut seen: Vec<&Placed<String>> = names.collect();
        seen.sort_by_key(|name| name.range.start);
        for (ix, name) in seen.iter().enumerate() {
            if seen.iter().take(ix).any(|other| other.value.eq_ignore_ascii_case(&name.value)) {
                let message = format!("the axis {} is listed twice", name.value.to_ascii_uppercase());
                return Err(self.text.problem(name, message));
            }
        }
        Ok(())
    }

    /// Where the table lists the machine's axes, it speaks of no others.
    fn listed_axes(&self, table: &MachineTable) -> Result<(), Problem> {
        let Some(listed) = &table.axes else { return Ok(()) };
        let axes = &listed.value;
        if axes.is_empty() {
            return Err(self.text.problem(listed, "`axes` is empty: a machine has at least one axis"));
        }
        let shown = || axes.iter().map(|axis| axis.value.to_ascii_uppercase()).collect::<Vec<_>>().join(", ");
        // Rates of axes that are not listed stay: an import that narrows `axes` keeps what it does not know.
        let lists = [&table.rotary_order, &table.rotary_shorter_way].into_iter().flatten().flatten();
        let turning = table.rotary_sign.keys().chain(table.rotary_direction.keys());
        let named = table.travel.keys().chain(turning).chain(lists);
        for name in named {
            if !axes.iter().any(|axis| axis.value.eq_ignore_ascii_case(&name.value)) {
                let message = format!("`{}` is not among the machine's `axes`: {}", name.value, shown());
                return Err(self.text.problem(name, message));
            }
        }
        let turning = axes.iter().filter(|axis| rotary_axis(&axis.value).is_some()).count();
        if let Some(rotary) = table.rotary.as_ref().filter(|_| turning < 2) {
            let message =
                format!("`rotary` is for machines with two rotary axes, and `axes` lists {}", shown());
            return Err(self.text.problem(rotary, message));
        }
        Ok(())
    }

    /// Positions that the control's switches have.
    fn overrides(&self, table: &MachineTable) -> Result<(), Problem> {
        let Some(feed) = &table.feed_override else { return Ok(()) };
        let switch = self.control.as_ref().and_then(|control| control.limits().feed_override.as_ref());
        if let (Some(switch), Some(control)) = (switch, &self.control)
            && !switch.takes(feed.value)
        {
            let (name, positions) = (control.name(), switch.positions());
            let message = format!("the feed override of {name} has {positions}  [{}]", switch.source);
            return Err(self.text.problem(feed, message));
        }
        // Where the pages do not give the positions: no feed ends at 0, and no switch goes further than this. A control that is
        // chosen elsewhere may have the position 0.
        let is_possible = feed.value > 0.0 || feed.value == 0.0 && self.control.is_none();
        if !(is_possible && feed.value <= MOST_FEED_OVERRIDE) && switch.is_none() {
            let message = format!("a feed override is above 0 and at most {MOST_FEED_OVERRIDE} percent");
            return Err(self.text.problem(feed, message));
        }
        Ok(())
    }

    /// What needs something else of the same machine.
    fn whole(&self, table: &MachineTable) -> Result<(), Problem> {
        if let (Some(jerk), None) = (&table.jerk, &table.acceleration) {
            return Err(self.text.problem(jerk, JERK_ALONE));
        }
        match &table.acceleration {
            Some(acceleration) if slowest_linear(&acceleration.value).is_none() => {
                Err(self.text.problem(acceleration, NO_LINEAR))
            }
            _ => Ok(()),
        }
    }

    /// Figures that no machine has: a slip of the pen, or another unit.
    fn bounds(&self, table: &MachineTable) -> Result<(), Problem> {
        for (figures, range, what, power) in [
            (&table.acceleration, ACCELERATION, "acceleration", "squared"),
            (&table.jerk, JERK, "jerk", "cubed"),
        ] {
            let Some(figures) = figures else { continue };
            let placed: Vec<(&Placed<String>, &Placed<f64>)> = match &figures.value {
                ByAxis::All(value) => {
                    let (unit, [least, most]) = in_units(range, table.units);
                    if !(least..=most).contains(value) {
                        let message = format!(
                            "the {what} of an axis is {least} to {most} {unit} a second {power}, not {value}"
                        );
                        return Err(self.text.problem(figures, message));
                    }
                    Vec::new()
                }
                ByAxis::Each(each) => each.iter().collect(),
            };
            for (axis, value) in placed {
                let (unit, [least, most]) = match rotary_axis(&axis.value) {
                    Some(_) => ("degrees", range),
                    None => in_units(range, table.units),
                };
                if !(least..=most).contains(&value.value) {
                    let message = format!(
                        "the {what} of {} is {least} to {most} {unit} a second {power}, not {}",
                        axis.value, value.value
                    );
                    return Err(self.text.problem(value, message));
                }
            }
        }
        let [least, most] = SPINDLE_GAIN;
        if let Some(gain) = table.spindle_acceleration.as_ref().filter(|n| !(least..=most).contains(&n.value))
        {
            let message = format!("a spindle gains {least} to {most} 1/min in a second, not {}", gain.value);
            return Err(self.text.problem(gain, message));
        }
        for (seconds, most) in [
            (&table.tool_change_seconds, LONGEST_CHANGE),
            (&table.auxiliary_seconds, LONGEST_CHANGE),
            (&table.spindle_orient_seconds, LONGEST_TURN),
            (&table.pocket_seconds, LONGEST_TURN),
        ] {
            if let Some(seconds) = seconds.as_ref().filter(|seconds| seconds.value > most) {
                let message = format!("must be at most {most}: it counts in seconds");
                return Err(self.text.problem(seconds, message));
            }
        }
        self.speeds(table)?;
        if let Some(pockets) = table.pockets.as_ref().filter(|pockets| pockets.value > MOST_POCKETS) {
            let message = format!("a magazine has at most {MOST_POCKETS} pockets");
            return Err(self.text.problem(pockets, message));
        }
        Ok(())
    }

    /// Speeds and lengths that no machine has.
    fn speeds(&self, table: &MachineTable) -> Result<(), Problem> {
        if let Some(speed) = table.max_rpm.as_ref().filter(|speed| speed.value > FASTEST_SPINDLE) {
            let message = format!("no spindle turns {} times a minute", plain(speed.value));
            return Err(self.text.problem(speed, message).help(format!("it is at most {FASTEST_SPINDLE}")));
        }
        let too_fast = |placed: &Range<usize>, value: f64, unit: &str, most: f64| {
            let message = format!("no axis moves {} {unit} a minute: it is at most {most}", plain(value));
            self.text.at(placed, message)
        };
        let (unit, most) = at_most(FASTEST, table.units);
        for rate in [&table.max_feed, &table.corner_speed_change].into_iter().flatten() {
            if rate.value > most {
                return Err(too_fast(&rate.range, rate.value, unit, most));
            }
        }
        match table.rapid.as_ref().map(|rapid| (&rapid.range, &rapid.value)) {
            Some((range, ByAxis::All(rate))) if *rate > most => {
                return Err(too_fast(range, *rate, unit, most));
            }
            Some((_, ByAxis::Each(each))) => {
                for (axis, rate) in each {
                    let is_rotary = rotary_axis(&axis.value).is_some();
                    let (unit, most) = if is_rotary { ("degrees", FASTEST_TURN) } else { (unit, most) };
                    if rate.value > most {
                        return Err(too_fast(&rate.range, rate.value, unit, most));
                    }
                }
            }
            _ => {}
        }
        if let Some(rate) = table.rotary_rapid.as_ref().filter(|rate| rate.value > FASTEST_TURN) {
            return Err(too_fast(&rate.range, rate.value, "degrees", FASTEST_TURN));
        }
        let (unit, most) = at_most(FARTHEST, table.units);
        let lengths = [&table.pivot_length, &table.bar_length].into_iter().flatten();
        let places = table.rotary_centre.values().chain(table.rotary_offset.values());
        if let Some(length) = lengths.chain(places).find(|length| length.value.abs() > most) {
            let message = format!("a length is at most {most} {unit}, not {}", plain(length.value));
            return Err(self.text.problem(length, message));
        }
        Ok(())
    }

    /// What a table says against the preset that it names.
    pub(super) fn against_preset(&self, own: &MachineTable, preset: &MachineTable) -> Result<(), Problem> {
        let named = own.preset.as_ref().map_or("", |name| name.value.0.as_str());
        // Without a unit the figures count as the control does, and that is known where the layers come together.
        let Some((units, theirs)) = own.units.zip(preset.units) else { return Ok(()) };
        // From the units of the preset to those of the table.
        let scale = mm(theirs) / mm(units);
        let rapid =
            |table: &MachineTable| table.rapid.as_ref().and_then(|rapid| slowest_linear(&rapid.value));
        let inherited = rapid(preset).map(|rapid| rapid * scale);
        if let (Some(feed), None, Some(rapid)) = (&own.max_feed, &own.rapid, inherited)
            && rapid < feed.value
        {
            let message = format!(
                "max_feed is {}, and the preset `{named}` has a rapid rate of {}: no axis cuts faster than it moves at rapid",
                feed.value,
                shown(rapid)
            );
            return Err(self.text.problem(feed, message).help("write `rapid` too, or a lower `max_feed`"));
        }
        if let (Some(written), Some(own_rapid), None, Some(feed)) =
            (&own.rapid, rapid(own), &own.max_feed, &preset.max_feed)
            && own_rapid < feed.value * scale
        {
            let message = format!(
                "the rapid rate is {own_rapid}, and the preset `{named}` has a max_feed of {}: no axis cuts faster than it moves at rapid",
                shown(feed.value * scale)
            );
            return Err(self
                .text
                .problem(written, message)
                .help("write `max_feed` too, or a higher `rapid`"));
        }
        let unit = if units == Units::Inch { "inch" } else { "mm" };
        let gain =
            |table: &MachineTable| table.acceleration.as_ref().and_then(|gain| slowest_linear(&gain.value));
        let rapid_in_force = rapid(own).or(inherited);
        let gain_in_force = gain(own).or_else(|| gain(preset).map(|gain| gain * scale));
        let written = own.acceleration.as_ref().or(own.rapid.as_ref());
        if let (Some(rapid), Some(gain), Some(written)) = (rapid_in_force, gain_in_force, written)
            && let Some(message) = implausible_acceleration(shown(rapid), gain, unit)
        {
            return Err(self
                .text
                .problem(written, message)
                .help(format!("the preset `{named}` gives the other figure")));
        }
        Ok(())
    }

    /// What decides how long a program takes: figures that a machine can have, in the units that are meant.
    fn dynamics(&self, table: &MachineTable) -> Result<(), Problem> {
        for figures in [&table.rapid, &table.acceleration, &table.jerk].into_iter().flatten() {
            self.figures(figures)?;
        }
        let [endless_numbers, whole_numbers] = [
            [
                &table.block_time,
                &table.spindle_acceleration,
                &table.corner_speed_change,
                &table.feed_override,
            ],
            [
                &table.tool_change_seconds,
                &table.pocket_seconds,
                &table.auxiliary_seconds,
                &table.rapid_override,
            ],
        ];
        for number in endless_numbers.into_iter().chain(whole_numbers).flatten() {
            if !number.value.is_finite() {
                return Err(self.text.problem(number, "must be a finite number"));
            }
        }
        if let Some(part) = table.rapid_override.as_ref().filter(|part| part.value > 100.0) {
            return Err(self.text.problem(part, "a rapid override is at most 100 percent"));
        }
        if let Some(time) = table.block_time.as_ref().filter(|time| time.value > LONGEST_BLOCK) {
            let message = format!(
                "{} s for a block: block_time counts in seconds, 0.0005 for 2,000 blocks a second",
                time.value
            );
            return Err(self.text.problem(time, message));
        }
        if let Some(ahead) =
            table.look_ahead.as_ref().filter(|ahead| !(1..=MOST_AHEAD).contains(&ahead.value))
        {
            return Err(self.text.problem(ahead, format!("a control looks 1 to {MOST_AHEAD} blocks ahead")));
        }
        if let Some(pockets) = table.pockets.as_ref().filter(|pockets| pockets.value == 0) {
            return Err(self.text.problem(pockets, "a magazine has at least one pocket"));
        }
        if let (Some(rapid), Some(feed)) = (&table.rapid, &table.max_feed)
            && let Some(slow) = slowest_linear(&rapid.value).filter(|slow| *slow < feed.value)
        {
            let message = format!(
                "the rapid rate {slow} is lower than max_feed ({}): no axis cuts faster than it moves at rapid",
                feed.value
            );
            return Err(self.text.problem(rapid, message));
        }
        if let (Some(rapid), Some(acceleration)) = (&table.rapid, &table.acceleration)
            && let (Some(rapid), Some(gain)) =
                (slowest_linear(&rapid.value), slowest_linear(&acceleration.value))
        {
            let unit = match table.units {
                Some(Units::Mm) => "mm",
                Some(Units::Inch) => "inch",
                None => "units",
            };
            if let Some(message) = implausible_acceleration(rapid, gain, unit) {
                return Err(self.text.problem(acceleration, message));
            }
        }
        if let (Some(top), Some(gain)) = (&table.max_rpm, &table.spindle_acceleration)
            && top.value / gain.value > LONGEST_SPINDLE_START
        {
            let message = format!(
                "the spindle takes {:.0} s to its highest speed: spindle_acceleration counts in 1/min a second",
                top.value / gain.value
            );
            return Err(self.text.problem(gain, message));
        }
        Ok(())
    }

    /// Numbers for all axes or by axis: each greater than zero and finite, each axis one of the control.
    fn figures(&self, figures: &Placed<ByAxis>) -> Result<(), Problem> {
        let is_one = |value: f64| value > 0.0 && value.is_finite();
        match &figures.value {
            ByAxis::All(value) if is_one(*value) => Ok(()),
            ByAxis::All(_) => Err(self.text.problem(figures, "must be greater than zero, and finite")),
            ByAxis::Each(each) if each.is_empty() => Err(self.text.problem(figures, "names no axis")),
            ByAxis::Each(each) => {
                self.each_axis_once(each.keys())?;
                for (axis, value) in each {
                    self.axis(axis)?;
                    if !is_one(value.value) {
                        return Err(self.text.problem(value, "must be greater than zero, and finite"));
                    }
                }
                Ok(())
            }
        }
    }

    fn axis(&self, name: &Placed<String>) -> Result<(), Problem> {
        let letter = Letter::parse(&name.value.to_ascii_uppercase()).filter(|_| name.value.len() == 1);
        let (exists, axes) = match &self.control {
            Some(control) => {
                let axes: Vec<String> = control.axes().iter().map(|a| a.to_string()).collect();
                (letter.is_some_and(|l| control.axes().contains(l)), axes.join(", "))
            }
            None => {
                let axes: Vec<String> = AXES.chars().map(String::from).collect();
                (letter.is_some() && AXES.contains(&name.value.to_ascii_uppercase()), axes.join(", "))
            }
        };
        if exists {
            return Ok(());
        }
        let of = self.control.as_ref().map_or_else(String::new, |control| format!(" of {}", control.name()));
        Err(self.text.problem(name, format!("`{}` is not an axis{of}; the axes are {axes}", name.value)))
    }

    /// Settings in the words of the control. One that the control does not list must be of a control of `others`: what holds
    /// for all programs of a folder may be meant for some of them.
    pub(super) fn settings(
        &self,
        settings: &BTreeMap<Placed<String>, Placed<Scalar>>,
        others: &[&str],
    ) -> Result<Vec<(String, String)>, Problem> {
        for (number, value) in settings {
            if !self.setting(number, value)? {
                self.is_of_another(number, others)?;
            }
        }
        Ok(settings.iter().map(|(number, value)| (number.value.clone(), value.value.0.clone())).collect())
    }

    /// Is it a setting of the control? Then its value is one that it takes.
    fn setting(&self, number: &Placed<String>, value: &Placed<Scalar>) -> Result<bool, Problem> {
        let Some(entry) = self.control.as_ref().and_then(|control| control.setting(&number.value)) else {
            return Ok(false);
        };
        let listed: Vec<&str> = entry.values.iter().map(String::as_str).collect();
        let is_open =
            listed.iter().any(|v| KINDS_OF_VALUES.contains(v)) || listed.iter().any(|v| v.contains(' '));
        if !is_open && !listed.contains(&value.value.0.as_str()) {
            let near = did_you_mean(&value.value.0, listed.iter().copied());
            return Err(self.text.problem(
                value,
                format!("setting {} ({}) is one of {}{near}", number.value, entry.title, quoted(&listed)),
            ));
        }
        Ok(true)
    }

    /// Whether a setting that the control does not list is of one of these; of any control, where none is named.
    fn is_of_another(&self, number: &Placed<String>, others: &[&str]) -> Result<(), Problem> {
        let (controls, of) = match &self.control {
            Some(control) => (others, control.name()),
            None => (gcheck_controls::names(), "any control"),
        };
        let lists = |control: Arc<Control>| control.setting(&number.value).is_some();
        let is_known = controls.iter().any(|name| gcheck_controls::load(name).is_ok_and(lists));
        if is_known {
            return Ok(());
        }
        let message = format!("gcheck reads no setting {} of {of}", number.value);
        Err(self.text.problem(number, message).help("leave it out: it changes nothing here"))
    }

    pub(super) fn codes(
        &self,
        codes: &BTreeMap<Placed<String>, CodeTable>,
    ) -> Result<Vec<UserCode>, Problem> {
        codes
            .iter()
            .map(|(name, table)| {
                let number = CodeNumber::parse(&name.value.to_ascii_uppercase()).ok_or_else(|| {
                    self.text.problem(name, format!("`{}` is not a code; write `M51` or `G150`", name.value))
                })?;
                if let Some(alias) = &table.alias
                    && !is_program(&alias.value)
                {
                    let message = format!("`{}` is not a program; write `O9010`", alias.value);
                    return Err(self.text.problem(alias, message));
                }
                if let Some(alias) = &table.alias
                    && let Some(message) = self.refused_alias(number)
                {
                    return Err(self.text.problem(alias, message));
                }
                let alias = table.alias.as_ref().map(|a| a.value.clone());
                let title =
                    table.title.clone().or_else(|| alias.as_ref().map(|program| format!("calls {program}")));
                Ok(UserCode {
                    number,
                    title: title.unwrap_or_else(|| "a code of this shop".to_owned()),
                    alias,
                })
            })
            .collect()
    }

    /// Why the control cannot make a code the call of a program.
    fn refused_alias(&self, number: CodeNumber) -> Option<String> {
        let control = self.control.as_ref()?;
        let (limits, name) = (control.limits(), control.name());
        if limits.never_aliased.iter().any(|code| CodeNumber::parse(code) == Some(number)) {
            return Some(format!("{name} does not let `{number}` call a program of your own"));
        }
        let most = limits.alias_codes_to?;
        let is_too_high =
            CodeNumber::from_value(number.letter(), f64::from(most) + 0.5).is_some_and(|end| number > end);
        is_too_high.then(|| format!("{name} lets codes up to {most} call programs, not `{number}`"))
    }

    pub(super) fn rules(&self, table: &RulesTable) -> Result<RulesTable, Problem> {
        self.selectors(table.select.iter().flatten())?;
        self.selectors(&table.ignore)?;
        self.selectors(&table.extend_select)?;
        let keys = ["select", "ignore", "extend-select"];
        for name in table.severities.keys() {
            if let Err(problem) = self.selectors([name]) {
                let near = did_you_mean(&name.value, keys);
                let is_key = !near.is_empty();
                let message = format!("`{}` is not a rule, group or key of [rules]{near}", name.value);
                return Err(if is_key { self.text.problem(name, message) } else { problem });
            }
        }
        Ok(table.clone())
    }

    /// Each names a rule, a group or a set.
    pub(super) fn selectors<'s>(
        &self,
        selectors: impl IntoIterator<Item = &'s Placed<String>>,
    ) -> Result<(), Problem> {
        let mut selection = Selection::none(RULES);
        for selector in selectors {
            if let Err(unknown) = selection.enable(&selector.value) {
                return Err(self.text.problem(selector, unknown_rule(&unknown)));
            }
        }
        Ok(())
    }

    /// What only the execution of programs uses.
    pub(super) fn execution(
        &self,
        machine: &MachineTable,
        variables: &BTreeMap<Placed<String>, f64>,
        offsets: &BTreeMap<Placed<String>, BTreeMap<Placed<String>, f64>>,
        tools: &ToolsTable,
        is_whole: bool,
    ) -> Result<ExecutionFacts, Problem> {
        self.variables(variables)?;
        self.work_offsets(offsets, machine.units)?;
        let mut by_number = Vec::with_capacity(tools.tools.len());
        for (number, tool) in &tools.tools {
            let Ok(parsed) = number.value.parse::<u32>() else {
                let message = format!("`{}` is not a tool number, nor `table`", number.value);
                return Err(self.text.problem(number, message));
            };
            self.tool(number, tool, machine.units, is_whole && tools.table.is_none())?;
            by_number.push((parsed, tool.clone()));
        }
        Ok(ExecutionFacts {
            units: machine.units,
            is_preset: false,
            machine: machine.clone(),
            variables: variables.iter().map(|(name, value)| (name.value.clone(), *value)).collect(),
            offsets: offsets
                .iter()
                .map(|(name, axes)| {
                    let axes = axes.iter().map(|(axis, value)| (axis.value.to_ascii_uppercase(), *value));
                    (name.value.clone(), axes.collect())
                })
                .collect(),
            tools: by_number,
            table: tools.table.as_ref().map(|table| self.text.path(&table.value)),
        })
    }

    fn variables(&self, variables: &BTreeMap<Placed<String>, f64>) -> Result<(), Problem> {
        for (name, value) in variables {
            let inner = name.value.strip_prefix('#').unwrap_or_default();
            let is_named = inner.len() > 2 && inner.starts_with('<') && inner.ends_with('>');
            if inner.parse::<u32>() == Ok(0) {
                let message = "`#0` is always empty: it cannot have a value";
                return Err(self.text.problem(name, message));
            }
            if !is_named && inner.parse::<u32>().is_err() {
                let message = format!("`{}` is not a variable; write \"#3100\" or \"#<name>\"", name.value);
                return Err(self.text.problem(name, message));
            }
            self.finite(name, *value)?;
        }
        Ok(())
    }

    fn work_offsets(
        &self,
        offsets: &BTreeMap<Placed<String>, BTreeMap<Placed<String>, f64>>,
        units: Option<Units>,
    ) -> Result<(), Problem> {
        self.named_offsets(offsets.keys())?;
        offsets.values().try_for_each(|axes| self.by_axis(axes, FARTHEST, units))
    }

    /// Each names another work offset of the control, or of any control where none is named.
    fn named_offsets<'a>(&self, names: impl Iterator<Item = &'a Placed<String>>) -> Result<(), Problem> {
        let mut numbers: BTreeMap<u16, &str> = BTreeMap::new();
        for name in names {
            let number = self.control.as_ref().and_then(|control| work_offset(&name.value, control));
            if let Some(other) = number.and_then(|number| numbers.insert(number, &name.value)) {
                let message = format!("`{}` and `{other}` are one work offset", name.value);
                return Err(self.text.problem(name, message));
            }
            let is_of = |control: &Arc<Control>| work_offset(&name.value, control).is_some();
            let is_of_any = || {
                let mut controls = gcheck_controls::names().iter();
                controls.any(|name| gcheck_controls::load(name).is_ok_and(|control| is_of(&control)))
            };
            if !self.control.as_ref().map_or_else(is_of_any, is_of) {
                let of = self.control.as_ref().map_or_else(
                    || " of any control".to_owned(),
                    |control| format!(" of {}", control.name()),
                );
                let message =
                    format!("`{}` is not a work offset{of}; write `G54` or \"G154 P1\"", name.value);
                return Err(self.text.problem(name, message));
            }
        }
        Ok(())
    }

    /// The sizes of a tool; `is_whole` when nothing else can say them.
    fn tool(
        &self,
        number: &Placed<String>,
        tool: &ToolTable,
        units: Option<Units>,
        is_whole: bool,
    ) -> Result<(), Problem> {
        let sizes = [tool.length, tool.posted_length, tool.diameter, tool.corner_radius];
        for size in sizes.into_iter().flatten() {
            self.finite(number, size)?;
            let (unit, most) = at_most(LARGEST_TOOL, units);
            if size.abs() > most {
                let message = format!("a size of a tool is at most {most} {unit}, not {}", plain(size));
                return Err(self.text.problem(number, message));
            }
        }
        // A diameter below zero is an offset to the other side, as controls take it.
        if tool.corner_radius.is_some_and(|radius| radius < 0.0) {
            return Err(self.text.problem(number, "a corner radius is not negative"));
        }
        if let Some(orientation) = tool.orientation.as_ref().filter(|o| o.value > 9) {
            return Err(self.text.problem(orientation, "a tip points in one of the directions 0 to 9"));
        }
        if let (Some(radius), Some(diameter)) = (tool.corner_radius, tool.diameter)
            && diameter != 0.0
            && radius > diameter.abs() / 2.0 + SAME_LENGTH
        {
            let message = format!(
                "the corner radius {radius} is larger than half of the diameter {}: a ball end mill has half of it",
                diameter.abs()
            );
            return Err(self.text.problem(number, message));
        }
        self.by_axis(&tool.offset, LARGEST_TOOL, units)?;
        self.cutting(tool)?;
        if let Some(range) = &tool.surface_speed
            && self.control.as_ref().is_some_and(|control| only_mills(control))
            && tool.diameter.map_or(is_whole, |diameter| diameter <= 0.0)
        {
            let message = "a surface speed needs the tool's `diameter`, above zero";
            return Err(self.text.problem(range, message));
        }
        Ok(())
    }

    /// How a tool cuts: teeth and ranges that a tool can have.
    fn cutting(&self, tool: &ToolTable) -> Result<(), Problem> {
        if let Some(teeth) = tool.teeth.as_ref().filter(|teeth| !(1..=MOST_TEETH).contains(&teeth.value)) {
            return Err(self.text.problem(teeth, format!("a tool has 1 to {MOST_TEETH} teeth")));
        }
        if let (Some(load), None) = (&tool.chip_load, &tool.teeth) {
            return Err(self.text.problem(load, "a chip load counts by tooth: write `teeth` too"));
        }
        for range in [&tool.chip_load, &tool.surface_speed].into_iter().flatten() {
            let [low, high] = range.value;
            if !(low >= 0.0 && high > low && high.is_finite()) {
                let message = "must go from the lowest value, not below zero, to the highest: `[0.02, 0.06]`";
                return Err(self.text.problem(range, message));
            }
        }
        Ok(())
    }

    /// Values by axis, each at most so many millimetres.
    fn by_axis(
        &self,
        axes: &BTreeMap<Placed<String>, f64>,
        most: f64,
        units: Option<Units>,
    ) -> Result<(), Problem> {
        self.each_axis_once(axes.keys())?;
        for (axis, value) in axes {
            self.axis(axis)?;
            self.finite(axis, *value)?;
            let (unit, most) = of_axis(&axis.value, most, units);
            if value.abs() > most {
                let message = format!("{} is at most {most} {unit}, not {}", axis.value, plain(*value));
                return Err(self.text.problem(axis, message));
            }
        }
        Ok(())
    }

    /// TOML has `inf` and `nan`; machines have not.
    fn finite(&self, key: &Placed<String>, value: f64) -> Result<(), Problem> {
        if value.is_finite() {
            return Ok(());
        }
        Err(self.text.problem(key, format!("`{}` must be a finite number", key.value)))
    }
}

/// The number of a work offset, counted from 1, as configurations write it: `G54`, `G154 P2`.
pub(crate) fn work_offset(name: &str, control: &Control) -> Option<u16> {
    let mut parts = name.split_whitespace();
    let code = control.code(CodeNumber::parse(&parts.next()?.to_ascii_uppercase())?)?;
    let p = match parts.next() {
        Some(part) => Some(part.strip_prefix(['P', 'p'])?),
        None => None,
    };
    if parts.next().is_some() {
        return None;
    }
    match (code.effect(), p) {
        (Effect::WorkOffset(number), None) => Some(number),
        (Effect::WorkOffsetByP(first), Some(p)) => {
            let p = p.parse::<u16>().ok()?;
            let word = code.entry().words.iter().find(|word| word.letter == "P");
            let most = word.and_then(|word| word.max).unwrap_or(f64::INFINITY);
            first.checked_add(p.checked_sub(1)?).filter(|_| f64::from(p) <= most)
        }
        _ => None,
    }
}

/// Do tools of the control's machines turn, and never the part?
fn only_mills(control: &Control) -> bool {
    control.machine() == Machine::Mill && !control.codes().any(|code| code.effect() == Effect::DiameterOn)
}

/// What a jerk without an acceleration is worth.
pub(crate) const JERK_ALONE: &str =
    "`jerk` has no effect without `acceleration`: it is how quickly that changes";
/// What an acceleration of rotary axes alone is worth.
pub(crate) const NO_LINEAR: &str =
    "`acceleration` names no linear axis: times come from it only where X, Y and Z have one";

fn mm(units: Units) -> f64 {
    match units {
        Units::Mm => 1.0,
        Units::Inch => MM_PER_INCH,
    }
}

/// A range of millimetres in the units of a table; where it names none, one that both fit in.
fn in_units([least, most]: [f64; 2], units: Option<Units>) -> (&'static str, [f64; 2]) {
    // To what people write.
    let rounded = |value: f64| (value * 100.0).round() / 100.0;
    let inch = [rounded(least / MM_PER_INCH), (most / MM_PER_INCH).round()];
    match units {
        Some(Units::Mm) => ("mm", [least, most]),
        Some(Units::Inch) => ("inch", inch),
        None => ("units", [rounded(least / MM_PER_INCH), most]),
    }
}

/// A limit of millimetres in the units of a table; where it names none, the larger number.
fn at_most(most: f64, units: Option<Units>) -> (&'static str, f64) {
    let (unit, [_, most]) = in_units([0.0, most], units);
    (unit, most)
}

/// The limit of a figure of an axis: so many millimetres, or what a rotary axis may count.
fn of_axis(axis: &str, most: f64, units: Option<Units>) -> (&'static str, f64) {
    if rotary_axis(axis).is_some() { ("degrees", FARTHEST_ANGLE) } else { at_most(most, units) }
}

/// A figure as people read it: one with many digits by its power of ten.
fn plain(figure: f64) -> String {
    if figure.abs() >= 1e9 { format!("{figure:e}") } else { figure.to_string() }
}

/// A figure that was converted, as people write it.
fn shown(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

/// The lowest figure of a linear axis.
fn slowest_linear(figures: &ByAxis) -> Option<f64> {
    match figures {
        ByAxis::All(value) => Some(*value),
        ByAxis::Each(each) => each
            .iter()
            .filter(|(axis, _)| rotary_axis(&axis.value).is_none())
            .map(|(_, value)| value.value)
            .reduce(f64::min),
    }
}

/// What is wrong with an acceleration, in units a second squared, beside a rapid rate in units a minute: nearly always it
/// counts in something else.
pub(crate) fn implausible_acceleration(rapid: f64, acceleration: f64, unit: &str) -> Option<String> {
    let seconds = rapid / 60.0 / acceleration;
    if (SHORTEST_START..=LONGEST_START).contains(&seconds) {
        return None;
    }
    let (only, seconds) = if seconds > LONGEST_START {
        ("only after", format!("{seconds:.0} s"))
    } else {
        ("already after", format!("{:.4} ms", seconds * 1000.0))
    };
    Some(format!(
        "the rapid rate {rapid} is reached {only} {seconds}: acceleration counts in {unit} a second squared, not in g or m/s²"
    ))
}

fn is_program(name: &str) -> bool {
    let digits = name.strip_prefix(['O', 'o']).unwrap_or(name);
    !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())
}

fn quoted(values: &[&str]) -> String {
    values.iter().map(|v| format!("`{v}`")).collect::<Vec<_>>().join(", ")
}

/// Whether there is a control of this name; the error is in words.
pub(crate) fn validate_control(name: &str) -> Result<(), String> {
    gcheck_controls::load(name).map(|_| ()).map_err(|error| unknown_control(name, &error))
}

/// Words for a control that cannot be loaded.
fn unknown_control(name: &str, error: &gcheck_controls::LoadError) -> String {
    match error {
        gcheck_controls::LoadError::Unknown { .. } => {
            let names = gcheck_controls::names();
            let near = did_you_mean(name, names.iter().copied());
            let list = if near.is_empty() { format!("; there are {}", names.join(", ")) } else { near };
            format!("no control is called `{name}`{list}")
        }
        data @ gcheck_controls::LoadError::Data { .. } => data.to_string(),
    }
}

/// Words for a selector that names nothing.
pub(crate) fn unknown_rule(unknown: &gcheck_lint::UnknownRule) -> String {
    let near = unknown.suggestion.map_or_else(
        || "; `gcheck rules` lists them".to_owned(),
        |suggestion| format!("; did you mean `{suggestion}`?"),
    );
    format!("`{}` is not a rule, group or set of rules{near}", unknown.name)
}
