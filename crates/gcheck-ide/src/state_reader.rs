//! What people read of a state: active codes, feed, speed, tool, positions.
//!
//! Knows: which facts of a state matter, and in which units they are read. Must not know: how states come about.

use gcheck_controls::{CodeIx, Effect};
use gcheck_db::Snapshot;
use gcheck_engine::{
    Abstract, AbstractValue, Axis, Domain as _, FeedMode, Model, PathMode, Position, Role, Spindle, State,
    Truth, Units,
};
use gcheck_geometry::{Degrees, Kinematics, Mm, Rpm};

use crate::number_text::{coordinate, decimals, plain, unit, value};

/// Reads the states of one document.
pub(crate) struct StateReader<'a> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) model: &'a Model<'a>,
}

/// Where the axes are, in three ways.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Places {
    /// Programmed coordinates.
    pub(crate) programmed: Position,
    /// Work coordinates.
    pub(crate) work: Position,
    /// Machine coordinates.
    pub(crate) machine: Position,
    /// The tool's tip in work coordinates, as far as its length is known.
    pub(crate) tip: Position,
}

impl<'a> StateReader<'a> {
    pub(crate) fn new(snapshot: &'a Snapshot, model: &'a Model<'a>) -> Self {
        Self { snapshot, model }
    }

    /// Units in which numbers of the program are read; millimetres when not known.
    pub(crate) fn units(&self, state: &State<Abstract>) -> Units {
        state.units(self.model).unwrap_or(Units::Mm)
    }

    /// Does X count diameters?
    pub(crate) fn diameter(&self, state: &State<Abstract>) -> bool {
        state.words_are_diameters(self.model).unwrap_or(self.model.semantics().diameter)
    }

    /// The codes that may be in effect for a role, by name; empty for none, and when it is not known.
    pub(crate) fn mode(&self, state: &State<Abstract>, role: Role) -> Vec<String> {
        let mode = state.mode(role);
        if mode.is_taken_for_kept() {
            return Vec::new();
        }
        let name = |code: &CodeIx| self.model.control().code_at(*code).map(|code| code.entry().code.clone());
        mode.alternatives().iter().filter_map(name).collect()
    }

    /// What is in effect, one text a role: `G90`, `G17`, `G54`; `G0 or G1` where paths differ. What is switched off is left out.
    pub(crate) fn codes(&self, state: &State<Abstract>) -> Vec<(Role, String)> {
        let mut codes = Vec::new();
        for role in Role::ALL {
            let mode = state.mode(role);
            let only_off = mode.only().is_some_and(|code| self.is_off(code));
            let names = self.mode(state, role);
            if names.is_empty() || only_off {
                continue;
            }
            let tolerance = self.tolerance(state).filter(|_| role == Role::PathControl).unwrap_or_default();
            codes.push((role, names.join(" or ") + &tolerance));
        }
        codes.extend(self.smoothness(state).into_iter().map(|words| (Role::PathControl, words)));
        // A cycle takes the place of the motion where both are one group.
        let has_cycle = codes.iter().any(|(role, _)| *role == Role::Cycle);
        codes.retain(|(role, _)| !(has_cycle && *role == Role::Motion));
        codes
    }

    /// ` within 0.01 mm`: the tolerance that corners are blended with; `None` where there is none, or it is not known.
    fn tolerance(&self, state: &State<Abstract>) -> Option<String> {
        let Some(PathMode::Blending { tolerance, naive }) = state.path_mode(self.model) else { return None };
        let within = (tolerance.0 > 0.0).then(|| format!(" within {}", self.distance(tolerance, state)));
        let joins = naive.filter(|naive| naive.0 > 0.0 && *naive != tolerance);
        let joins = joins.map(|naive| format!(", joins moves within {}", self.distance(naive, state)));
        Some(within.unwrap_or_default() + &joins.unwrap_or_default())
    }

    /// `0.01 mm`, in the program's units.
    fn distance(&self, distance: Mm, state: &State<Abstract>) -> String {
        let units = self.units(state);
        format!("{} {}", plain(distance.0 / units.in_mm(), decimals(units) + 1), unit(units))
    }

    /// `G187 P1 E2`, `G5.1 Q1 R5`: how smooth corners are cut beside the mode of the path, where a program told.
    fn smoothness(&self, state: &State<Abstract>) -> Vec<String> {
        let name = |effect: Effect| {
            self.model
                .control()
                .codes()
                .find(|code| code.effect() == effect)
                .map(|code| code.entry().code.clone())
        };
        let (level, tolerance) = state.smoothing();
        let mut all = Vec::new();
        if (level.is_some() || tolerance.is_some())
            && let Some(name) = name(Effect::Smoothing)
        {
            let level = level.map(|level| format!(" level {}", known(level, |level| plain(level, 0))));
            let within =
                tolerance.map(|off| format!(" within {}", known(off, |off| self.distance(Mm(off), state))));
            all.push(name + &level.unwrap_or_default() + &within.unwrap_or_default());
        }
        if let Some(level) = state.contour_control()
            && let Some(name) = name(Effect::ContourControl)
        {
            all.push(if level == 0.0 {
                name
            } else {
                format!("{name} level {}", known(level, |level| plain(level, 0)))
            });
        }
        all
    }

    /// Does a code only say that nothing of its kind is in effect?
    fn is_off(&self, code: CodeIx) -> bool {
        matches!(
            self.model.effect(code),
            Effect::CompensationOff
                | Effect::LengthOff
                | Effect::CycleCancel
                | Effect::ScalingOff
                | Effect::RotationOff
                | Effect::MirrorOff
                | Effect::PolarOff
                | Effect::PolarInterpolationOff
                | Effect::DynamicOffsetOff
                | Effect::TiltedPlaneOff
                | Effect::MacroModalOff
        )
    }

    /// `F200 mm/min`; `None` when none was given.
    pub(crate) fn feed(&self, state: &State<Abstract>) -> Option<String> {
        let word = state.feed_word();
        if *word == AbstractValue::Number(0.0) {
            return None;
        }
        let unit = match (self.units(state), state.feed_mode(self.model)) {
            (Units::Mm, Some(FeedMode::PerMinute)) => " mm/min",
            (Units::Inch, Some(FeedMode::PerMinute)) => " inch/min",
            (Units::Mm, Some(FeedMode::PerRevolution)) => " mm/rev",
            (Units::Inch, Some(FeedMode::PerRevolution)) => " inch/rev",
            (_, Some(FeedMode::InverseTime)) => " moves/min",
            (_, None) => "",
        };
        Some(format!("F{}{unit}", number(word)?))
    }

    /// `0.025 mm a tooth`: what each tooth of a tool with known teeth cuts.
    pub(crate) fn chip_load(&self, state: &State<Abstract>) -> Option<String> {
        let feed = Abstract::known(state.feed())?;
        let per_turn = match state.feed_mode(self.model)? {
            FeedMode::PerMinute => feed / self.turns(state)?,
            FeedMode::PerRevolution => feed,
            FeedMode::InverseTime => return None,
        };
        let machine = &self.snapshot.settings().machine.engine;
        let load = machine.cutting.get(&tool_of(state)?)?.load(per_turn)?;
        let units = self.units(state);
        Some(format!("{} {} a tooth", plain(load.0 / units.in_mm(), decimals(units) + 1), unit(units)))
    }

    /// The speed of the spindle, where it is one number and greater than zero.
    fn turns(&self, state: &State<Abstract>) -> Option<f64> {
        let is_surface = state.effect(Role::SpindleMode, self.model) == Some(Effect::SurfaceSpeed);
        Abstract::known(state.speed()).filter(|turns| *turns > 0.0 && !is_surface)
    }

    /// `94 m/min`: how fast the edge of a milling tool with a known diameter runs.
    pub(crate) fn edge_speed(&self, state: &State<Abstract>) -> Option<String> {
        if self.model.control().machine() != gcheck_controls::Machine::Mill {
            return None;
        }
        let turns = self.turns(state)?;
        let machine = &self.snapshot.settings().machine.engine;
        let speed = machine.tools.get(&tool_of(state)?)?.surface_speed(Rpm(turns));
        let (speed, unit) = match self.units(state) {
            Units::Inch => (speed / 0.3048, "ft/min"),
            Units::Mm => (speed, "m/min"),
        };
        (speed.is_finite() && speed > 0.0).then(|| format!("{} {unit}", plain(speed, 0)))
    }

    /// `S1200 rpm`; `None` when none was given.
    pub(crate) fn speed(&self, state: &State<Abstract>) -> Option<String> {
        let word = state.speed();
        if *word == AbstractValue::Number(0.0) {
            return None;
        }
        let surface = state.effect(Role::SpindleMode, self.model) == Some(Effect::SurfaceSpeed);
        let unit = match (surface, self.units(state)) {
            (false, _) => "rpm",
            (true, Units::Mm) => "m/min",
            (true, Units::Inch) => "ft/min",
        };
        Some(format!("S{} {unit}", number(word)?))
    }

    /// `spindle clockwise`, `spindle stopped`.
    pub(crate) fn spindle(state: &State<Abstract>) -> &'static str {
        match state.spindle() {
            Some(Spindle::Clockwise) => "spindle clockwise",
            Some(Spindle::CounterClockwise) => "spindle counter-clockwise",
            Some(Spindle::Stopped) => "spindle stopped",
            None => "spindle turning or not",
        }
    }

    /// `T1`, `H1`, `D1`, as far as they are known and not zero.
    fn numbers(state: &State<Abstract>) -> Vec<(Item, String)> {
        let mut texts = Vec::new();
        for (letter, value) in [('T', state.tool()), ('H', state.h()), ('D', state.d())] {
            if let Some(number) = Abstract::known(value).filter(|number| *number != 0.0) {
                texts.push((Item::Number(letter), format!("{letter}{}", plain(number, 0))));
            }
        }
        texts
    }

    /// The axes that the program names, or the machine has.
    pub(crate) fn axes(&self) -> Vec<Axis> {
        let machine = &self.snapshot.settings().machine.engine;
        if let Some(axes) = &machine.axes {
            return axes.clone();
        }
        let control = self.model.control();
        let increments = &self.model.semantics().increments;
        let used = self.snapshot.file_index().letters;
        let is_used = |axis: &Axis| {
            let of_axis = |(letter, moved): (&String, &String)| {
                *moved == axis.name().to_string()
                    && gcheck_controls::Letter::parse(letter).is_some_and(|letter| used.contains(letter))
            };
            let is_increment = increments.contains_key(&axis.name().to_string());
            !is_increment
                && (matches!(axis, Axis::X | Axis::Z)
                    || used.contains(axis.letter())
                    || increments.iter().any(of_axis))
        };
        Axis::ALL.into_iter().filter(|axis| control.axes().contains(axis.letter())).filter(is_used).collect()
    }

    /// Where the axes are.
    pub(crate) fn places(&self, state: &State<Abstract>) -> Places {
        let work = *state.actual();
        let machine = state.machine(self.model, &self.snapshot.settings().machine.engine);
        Places { programmed: *state.position(), work, machine, tip: self.tip(state, work, machine) }
    }

    /// The tip lies where the work position says while the tool's own length is in effect; else the difference away.
    fn tip(&self, state: &State<Abstract>, work: Position, stands: Position) -> Position {
        if state.tool_shift().along_tool().is_some() {
            let h = Abstract::known(state.h()).filter(|h| *h >= 0.0);
            let machine = &self.snapshot.settings().machine.engine;
            #[expect(clippy::cast_sign_loss, reason = "not negative")]
            let tip = h.and_then(|h| gcheck_toolpath::tip_of_posted(machine, h as u32, state.position()));
            return tip.map_or(Position::UNKNOWN, |tip| state.position().with_xyz(tip));
        }
        let effect = state.effect(Role::Length, self.model);
        let keeps_tip = effect == Some(Effect::ToolCentrePoint);
        // A tool that is shifted along a vector has its tip elsewhere, and so has one that is tilted, unless the control keeps the tip
        // in its place.
        let shifted = state.tool_shift().along_vectors().is_some();
        let is_turned = self.axes().iter().any(|axis| axis.is_rotary() && state.actual().raw(*axis) != 0.0);
        let kinematics = self.snapshot.settings().machine.engine.kinematics;
        if shifted || is_turned && kinematics.is_some() && !keeps_tip {
            return Position::UNKNOWN;
        }
        #[expect(clippy::cast_sign_loss, reason = "tool numbers are not negative")]
        let tool = Abstract::known(state.tool()).filter(|tool| *tool > 0.0).map(|tool| tool as u32);
        let entry = tool.and_then(|tool| state.tables().tool(tool));
        let beside = entry.map_or(Position::UNKNOWN, |entry| *state.length() - entry.offset);
        let tip = if keeps_tip && is_turned {
            leaning(kinematics, work, beside, stands.abc())
        } else {
            work + beside
        };
        if tip.xyz().iter().all(|value| value.is_known()) {
            return tip;
        }
        // However long the tool is: with its own length in effect the program says where the tip goes. Another tool's number is
        // nearly always another tool's length.
        let is_own = tool.is_some_and(|tool| Abstract::known(state.h()) == Some(f64::from(tool)));
        let adds = keeps_tip || effect == Some(Effect::LengthPlus);
        if adds && is_own { work } else { tip }
    }

    /// `X1.5 Y2 Z-3`, unknown coordinates left out.
    pub(crate) fn point(&self, state: &State<Abstract>, point: &Position) -> String {
        let (units, diameter) = (self.units(state), self.diameter(state));
        let known = self.axes().into_iter().filter_map(|axis| Some((axis, point.get(axis)?)));
        let texts: Vec<String> = known
            .map(|(axis, value)| format!("{}{}", axis.name(), coordinate(axis, value, units, diameter)))
            .collect();
        texts.join(" ")
    }

    /// May the state have anything for the item, since something ran that is not known?
    pub(crate) fn is_unknown(state: &State<Abstract>, item: Item) -> bool {
        let is_open = |value: &AbstractValue| *value == AbstractValue::Unknown;
        match item {
            Item::Mode(role) => {
                let mode = state.mode(role);
                mode.is_taken_for_kept() || mode.only().is_none() && mode.alternatives().is_empty()
            }
            Item::Feed => is_open(state.feed_word()),
            Item::Speed => is_open(state.speed()),
            Item::Spindle => state.spindle().is_none(),
            Item::Number('T') => Abstract::known(state.tool()).is_none(),
            Item::Number('H') => Abstract::known(state.h()).is_none(),
            Item::Number(_) => Abstract::known(state.d()).is_none(),
            Item::Coolant => state.coolant() != (Truth::False, Truth::False),
        }
    }

    /// What is in effect, in the order in which people look at it.
    pub(crate) fn items(&self, state: &State<Abstract>) -> Vec<(Item, String)> {
        let mut items: Vec<(Item, String)> =
            self.codes(state).into_iter().map(|(role, code)| (Item::Mode(role), code)).collect();
        let with = |text: String, more: Option<String>| match more {
            Some(more) => format!("{text}, {more}"),
            None => text,
        };
        items.extend(self.feed(state).map(|feed| (Item::Feed, with(feed, self.chip_load(state)))));
        items.extend(self.speed(state).map(|speed| (Item::Speed, with(speed, self.edge_speed(state)))));
        items.push((Item::Spindle, Self::spindle(state).to_owned()));
        items.extend(Self::numbers(state));
        match state.coolant() {
            (Truth::True, _) => items.push((Item::Coolant, "coolant on".to_owned())),
            (_, Truth::True) => items.push((Item::Coolant, "mist on".to_owned())),
            _ => {}
        }
        items
    }
}

/// Where the tip is when a length that is not the tool's own is in effect along a tool that leans: `beside` is what the length has
/// too much, and the part turns with the coordinates of the program.
fn leaning(
    kinematics: Option<Kinematics>,
    work: Position,
    beside: Position,
    angles: [Degrees; 3],
) -> Position {
    let [sideways, across, along] = beside.xyz();
    let is_along = sideways.0 == 0.0 && across.0 == 0.0;
    if is_along && along.0 == 0.0 {
        return work;
    }
    match kinematics {
        Some(kinematics) if is_along => {
            let axis: [f64; 3] = kinematics.tool_axis_in_part(angles).into();
            let [x, y, z] = work.xyz();
            let [by_x, by_y, by_z] = axis.map(|part| along * part);
            work.with_xyz([x + by_x, y + by_y, z + by_z])
        }
        _ => work.with_xyz([Mm::UNKNOWN; 3]),
    }
}

/// A part of the state that people read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Item {
    Mode(Role),
    Feed,
    Speed,
    Spindle,
    /// `T`, `H` or `D`.
    Number(char),
    Coolant,
}

/// The number of the tool in the spindle, where it is known.
pub(crate) fn tool_of(state: &State<Abstract>) -> Option<u32> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "tool numbers are small and not negative"
    )]
    Abstract::known(state.tool()).filter(|tool| *tool > 0.0).map(|tool| tool as u32)
}

/// A number that is known, or the range that it lies in.
fn number(word: &AbstractValue) -> Option<String> {
    match word {
        AbstractValue::Number(x) => Some(plain(*x, 4)),
        AbstractValue::Unknown | AbstractValue::Vacant => None,
        other => Some(value(other)),
    }
}

/// A number, or that it is not known.
fn known(number: f64, shown: impl FnOnce(f64) -> String) -> String {
    if number.is_nan() { "not known".to_owned() } else { shown(number) }
}
