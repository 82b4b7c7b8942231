//! An event of a run with what a reader needs to know about it, and which axes the reader wants to see.
//!
//! Knows: the form in which events come here. Must not know: who sends them.

use gcheck_engine::{
    Axis, CallLine, Concrete, ConcreteValue, Domain as _, Event, FeedMode, Machine, Model, Position, Spindle,
    State, Transform, Truth, Units,
};
use gcheck_geometry::{Frame, Mm};

/// One event with its place and the state in which it happens.
#[derive(Debug, Clone, Copy)]
pub struct Step<'a> {
    /// What happens.
    pub event: &'a Event,
    /// The N word of the block; `None` when it has none or the event belongs to no block.
    pub n: Option<u32>,
    /// Line of the block in `file`, counted from 1.
    pub line: u32,
    /// Units in which the block's numbers are read.
    pub units: Units,
    /// The feed mode in effect.
    pub feed_mode: FeedMode,
    /// Feed in effect: millimetres a minute, millimetres a turn or moves a minute, as `feed_mode` says. NaN unknown.
    pub feed: f64,
    /// Turns of the spindle a minute, 0 when it is stopped. NaN unknown. Under constant surface speed it is not looked
    /// at: it follows from the events of the spindle and from X.
    pub rpm: f64,
    /// Machine coordinates after the event; NaN unknown.
    pub machine: Position,
    /// The linear axes follow the rotary ones: the machine coordinates of a move lie elsewhere than its points in the part.
    pub swings: bool,
    /// The machine coordinates of the points of an arc that swings, with the rotary axes where it ends.
    pub swung_arc: Option<Frame>,
    /// The tool in the spindle; `None` unknown.
    pub tool: Option<u32>,
    /// Where a move would end without compensation for the tool's size and length; NaN unknown.
    pub aim: Position,
    /// Number of the tool length offset that was called last, 0 for none; `None` unknown.
    pub h: Option<u32>,
    /// Number of the cutter offset that was called last; `None` unknown.
    pub d: Option<u32>,
    /// Why the axes are beside the programmed point, where a reader is told both.
    pub beside: Option<Beside>,
    /// Name of the file that holds the block.
    pub file: &'a str,
    /// The blocks that called the program under way, the outermost first.
    pub calls: &'a [CallLine],
}

/// Where an event comes from.
#[derive(Debug, Clone, Copy)]
pub struct Spot<'a> {
    /// As [`Step::file`].
    pub file: &'a str,
    /// As [`Step::line`].
    pub line: u32,
    /// As [`Step::n`].
    pub n: Option<u32>,
}

impl<'a> Step<'a> {
    /// An event in the state that an observer is shown with it; `units` are those of a state that does not know them.
    pub fn seen(
        event: &'a Event,
        state: &State<Concrete>,
        model: &Model<'_>,
        machine: &Machine,
        spot: Spot<'a>,
        units: Units,
    ) -> Self {
        let stands = stands(state, model, machine, event);
        let swings = machine.kinematics.is_some() && state.follows_rotary(&stands, model, machine);
        let swung_arc = match event {
            Event::Arc(arc) if swings => state.linear_axes(&arc.to, model, machine),
            _ => None,
        };
        Self {
            event,
            n: spot.n,
            line: spot.line,
            units: state.units(model).unwrap_or(units),
            feed_mode: state.feed_mode(model).unwrap_or(FeedMode::PerMinute),
            feed: number(state.feed()),
            rpm: turns(state),
            machine: stands,
            swings,
            swung_arc,
            tool: tool(state.tool()),
            aim: aim(state, event),
            h: tool(state.h()),
            d: tool(state.d()),
            beside: None,
            file: spot.file,
            calls: &[],
        }
    }
}

/// The programmed point, where the coordinates of the program are those of the axes.
fn aim(state: &State<Concrete>, event: &Event) -> Position {
    let programmed = match event {
        Event::Travel(travel) => travel.programmed,
        Event::Arc(arc) => arc.programmed,
        _ => return Position::UNKNOWN,
    };
    if *state.transform() == Transform::NONE { programmed } else { Position::UNKNOWN }
}

fn number(value: &ConcreteValue) -> f64 {
    Concrete::known(value).unwrap_or(f64::NAN)
}

#[expect(clippy::cast_sign_loss, reason = "tool numbers are not negative")]
fn tool(value: &ConcreteValue) -> Option<u32> {
    Concrete::known(value).filter(|number| *number >= 0.0).map(|number| number.round() as u32)
}

/// Turns of the spindle, or of the live tool that replaces it.
fn turns(state: &State<Concrete>) -> f64 {
    match (state.spindle(), state.live_tool()) {
        (Some(Spindle::Stopped), Truth::False) => 0.0,
        (Some(Spindle::Clockwise | Spindle::CounterClockwise), _) | (_, Truth::True) => number(state.speed()),
        _ => f64::NAN,
    }
}

/// Where a move ends. The state may be ahead of the move, so that its own end counts where there is one.
fn stands(state: &State<Concrete>, model: &Model<'_>, machine: &Machine, event: &Event) -> Position {
    match event {
        Event::Travel(travel) => state.to_machine(&travel.to, model, machine),
        Event::Arc(arc) => state.to_machine(&arc.to, model, machine),
        Event::Curve(curve) => state.to_machine(&curve.to, model, machine),
        _ => state.machine(model, machine),
    }
}

/// Why the axes are elsewhere than the programmed point says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Beside {
    /// A length is added along a tilting tool: the programmed point is the one that was posted.
    AlongTool {
        /// Where the tip is, in the coordinates of the programmed point; `None` when that is unknown.
        tip: Option<[Mm; 3]>,
    },
    /// The path is shifted along a vector by the size of the cutter.
    AlongVector,
    /// Cutter compensation is on, and the size of the cutter or the point where it began is not known.
    UnknownCutter,
}

impl Beside {
    /// Why a move of this event ends beside its programmed point, where a reader is told both.
    pub fn of(state: &State<Concrete>, machine: &Machine, event: &Event) -> Option<Self> {
        if matches!(event, Event::Travel(_) | Event::Arc(_)) && state.is_beside_by_unknown() {
            return Some(Self::UnknownCutter);
        }
        let Event::Travel(travel) = event else { return None };
        let shift = state.tool_shift();
        if shift.along_tool().is_some() {
            let tip = tool(state.h()).and_then(|h| tip_of_posted(machine, h, &travel.programmed));
            return Some(Self::AlongTool { tip });
        }
        shift.along_vectors().map(|_| Self::AlongVector)
    }
}

/// Where the tip of the posted tool is for a posted point, in the coordinates of that point: at zero angles the two are one, and
/// tilting turns the tool about the head's pivot. `h` is the number of the length offset; `None` unless the posted length and
/// the machine's kinematics were told.
pub fn tip_of_posted(machine: &Machine, h: u32, posted: &Position) -> Option<[Mm; 3]> {
    let length = *machine.posted_lengths.get(&h)?;
    let [x, y, z] = machine.kinematics?.tip_for_axes(posted.xyz(), length, posted.abc())?;
    Some([x, y, z + length]).filter(|tip| tip.iter().all(|part| part.is_known()))
}

/// Which axes are shown, and whether X is shown as a diameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct View {
    axes: u16,
    diameter: bool,
}

impl View {
    /// Shows these axes, always in the order of [`Axis::ALL`].
    pub fn new(axes: &[Axis]) -> Self {
        Self { axes: axes.iter().fold(0, |bits, axis| bits | 1 << axis.index()), diameter: false }
    }

    /// Shows coordinates of X doubled: events hold radii. Lengths stay lengths.
    #[must_use]
    pub const fn with_diameters(mut self) -> Self {
        self.diameter = true;
        self
    }

    /// The axes shown.
    pub fn axes(self) -> impl Iterator<Item = Axis> + Clone {
        Axis::ALL.into_iter().filter(move |axis| self.shows(*axis))
    }

    /// Is the axis shown?
    pub const fn shows(self, axis: Axis) -> bool {
        self.axes & (1 << axis.index()) != 0
    }

    /// Is X shown as a diameter?
    pub const fn has_diameters(self) -> bool {
        self.diameter
    }

    /// A coordinate as shown in `units`.
    pub(crate) fn coordinate(self, axis: Axis, value: f64, units: Units) -> f64 {
        let value = in_units(axis, value, units);
        if self.diameter && axis == Axis::X { 2.0 * value } else { value }
    }
}

/// A coordinate in the units of the program; angles stay degrees.
pub(crate) fn in_units(axis: Axis, value: f64, units: Units) -> f64 {
    if axis.is_rotary() { value } else { value / units.in_mm() }
}
