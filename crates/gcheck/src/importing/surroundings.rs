//! What counts where imported values are put: the file that is written, what it extends, the command line, the control.
//!
//! Knows: layers of a configuration, which keys count in their unit. Must not know: what is imported, how TOML is written.

use std::path::Path;

use gcheck_engine::Model;

use crate::config::{ByAxis, Config, ConfigFile, MachineTable, ToolsTable, Units};
use crate::paths;

/// What counts before the import.
#[derive(Debug, Default)]
pub(crate) struct Surroundings {
    /// What lengths of the file count in: it says so itself, or what it extends does.
    pub(super) units: Option<Units>,
    /// What a tool table on disk counts in, where it has a unit of its own.
    pub(super) table_units: Option<Units>,
    /// The unit that the command line gives the machine.
    pub(super) told: Option<Units>,
    /// The unit that the control has when it is switched on, as far as that is known, with the control's name.
    pub(super) power_on: Option<(Units, String)>,
    /// A key that counts in units.
    pub(super) length: Option<String>,
    /// Axes of the machine.
    pub(super) axes: Option<Vec<String>>,
    /// The rapid rate of all linear axes, where it is in force and another file than the one that is written has it, with that
    /// file.
    pub(super) inherited_rapid: Option<(f64, String)>,
    /// The control is named.
    pub(crate) has_control: bool,
}

impl Surroundings {
    /// Of the configuration at `path`; `control` is that of the command line.
    pub(crate) fn new(path: &Path, config: &Config, control: Option<&str>) -> Self {
        let files =
            || config.layers().iter().rev().filter(|layer| layer.path.is_some()).map(|layer| &layer.file);
        let inline =
            || config.layers().iter().rev().filter(|layer| layer.path.is_none()).map(|layer| &layer.file);
        let axes = files().find_map(|file| file.machine.axes.as_ref());
        Self {
            units: files().find_map(|file| file.machine.units),
            table_units: files().find_map(|file| file.machine.table_units),
            told: inline().find_map(|file| file.machine.units),
            power_on: power_on(path, config, control),
            length: files().find_map(length),
            axes: axes.map(|axes| axes.value.iter().map(|axis| axis.value.to_ascii_uppercase()).collect()),
            inherited_rapid: inherited_rapid(path, config),
            has_control: control.is_some() || config.settings(path).control.is_some(),
        }
    }
}

/// The unit of the control; none where a setting decides that is not configured, or another control runs some of the programs.
fn power_on(path: &Path, config: &Config, control: Option<&str>) -> Option<(Units, String)> {
    let settings = config.settings(path);
    let name = control.map(str::to_owned).or(settings.control)?;
    let mut others = config.layers().iter().flat_map(|layer| &layer.file.overrides);
    if others.any(|table| table.control.is_some()) {
        return None;
    }
    let control = gcheck_controls::load(&name).ok()?;
    let told = &settings.machine.settings;
    if control.semantics().units_setting.as_ref().is_some_and(|setting| !told.contains_key(setting)) {
        return None;
    }
    let units = match Model::new(&control).units_at_power_on(told)? {
        gcheck_engine::Units::Mm => Units::Mm,
        gcheck_engine::Units::Inch => Units::Inch,
    };
    Some((units, name))
}

fn inherited_rapid(path: &Path, config: &Config) -> Option<(f64, String)> {
    let mut layers = config.layers().iter().rev();
    let (own, rapid) =
        layers.find_map(|layer| Some((layer.path.as_deref()?, layer.file.machine.rapid.as_ref()?)))?;
    match rapid.value {
        ByAxis::All(rate) if own != paths::absolute(path) => Some((rate, paths::shown_from_here(own))),
        _ => None,
    }
}

/// A key of a configuration that counts in units.
fn length(file: &ConfigFile) -> Option<String> {
    let overrides = file.overrides.iter().map(|table| {
        let table_units = table.machine.table_units.or(file.machine.table_units);
        let offset = table.offsets.keys().next().map(|name| name.value.as_str());
        (&table.machine, offset, &table.tools, table_units)
    });
    let offset = file.offsets.keys().next().map(|name| name.value.as_str());
    let own = (&file.machine, offset, &file.tools, file.machine.table_units);
    std::iter::once(own).chain(overrides).find_map(|(machine, offset, tools, table_units)| {
        let key = of_machine(machine).map(|key| format!("machine.{key}"));
        let key = key.or_else(|| offset.map(|name| format!("offsets.{name}")));
        key.or_else(|| of_tools(tools, table_units))
    })
}

fn of_machine(machine: &MachineTable) -> Option<&'static str> {
    let keys = [
        (!machine.travel.is_empty(), "travel"),
        (machine.max_feed.is_some(), "max_feed"),
        (machine.rapid.is_some(), "rapid"),
        (machine.acceleration.is_some(), "acceleration"),
        (machine.jerk.is_some(), "jerk"),
        (machine.corner_speed_change.is_some(), "corner_speed_change"),
        (machine.pivot_length.is_some(), "pivot_length"),
        (!machine.rotary_centre.is_empty(), "rotary_centre"),
        (!machine.rotary_offset.is_empty(), "rotary_offset"),
        (machine.bar_length.is_some(), "bar_length"),
    ];
    keys.into_iter().find_map(|(is_there, key)| is_there.then_some(key))
}

fn of_tools(tools: &ToolsTable, table_units: Option<Units>) -> Option<String> {
    if tools.table.is_some() && table_units.is_none() {
        return Some("tools.table".to_owned());
    }
    tools.tools.keys().next().map(|number| format!("tools.{}", number.value))
}
