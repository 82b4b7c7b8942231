//! The state of a machine between two blocks: values only.
//!
//! Knows: everything a block may depend on, each part in a file of its own; what follows from several parts together. Must not
//! know: where a value was set (see [`crate::ReachingDefinitions`]), what has happened so far (observers keep that), how blocks change it.
//!
//! Every part is a [`Lattice`]: how two states become one, when one covers another and when they are the same is answered field
//! by field, and a field without an answer does not compile.

mod bar;
mod calls;
mod compensation;
mod coordinates;
mod curve;
mod cycle;
mod feed;
#[cfg(feature = "forgetful")]
mod fields;
#[cfg(test)]
mod laws;
mod mapping;
mod mode_set;
mod modes;
mod offsets;
mod path_mode;
mod points;
mod probe;
mod saved;
mod spindle;
mod tables;
mod tool;
mod tool_shift;
mod transform;
mod turning;
mod variables;

use gcheck_controls::{CodeIx, Effect};
use gcheck_geometry::{Mm, Plane};
use gcheck_program::BlockFlags;

pub use bar::Bar;
pub(crate) use bar::BarCommand;
pub(crate) use calls::{Calls, Kept, ModalCall, ModalCalls};
pub use calls::{Frame, FrameKind};
pub(crate) use compensation::{Compensation, CompensationState, Course, Programmed};
pub(crate) use curve::ControlPoints;
pub use cycle::CycleWords;
pub(crate) use feed::Feed;
#[cfg(feature = "forgetful")]
pub use fields::state_fields;
pub use mapping::Diameters;
pub(crate) use mapping::{Mapping, TiltedPlane};
pub use mode_set::ModeSet;
pub(crate) use modes::Modes;
pub(crate) use offsets::Offsets;
pub(crate) use path_mode::Blending;
pub(crate) use points::Points;
pub(crate) use probe::Probe;
pub use probe::{Touch, Way, Ways};
pub(crate) use saved::SavedModes;
pub(crate) use spindle::{CoolantState, SpindleState};
pub use tables::{Tables, ToolData};
pub(crate) use tool::{Loaded, ToolState};
pub use tool_shift::ToolShift;
pub use transform::Transform;
pub(crate) use turning::{KeptTurningWords, TurningWords};
pub(crate) use variables::{Locals, Variable};
pub use variables::{NameId, Variables};

use crate::cylinder::Cylinder;
use crate::eval::value::{Abstract, AbstractValue, Concrete, ConcreteValue, Domain, Truth};
use crate::event::{FeedMode, PathMode, Spindle, Units};
use crate::lattice::{Lattice, Perhaps, lattice};
use crate::machine::WorkOffset;
use crate::model::{Model, Role};
use crate::polar_plane::PolarPlane;
use crate::position::Position;

lattice! {
    /// Everything that the next block may depend on.
    ///
    /// What turns of a loop differ in comes first, so that two states are soon found to differ.
    #[derive(Debug, Clone)]
    pub struct State<D: Domain> {
        pub(crate) points: Points,
        pub(crate) variables: Variables<D>,
        pub(crate) calls: Calls<D>,
        pub(crate) modes: Modes,
        pub(crate) offsets: Offsets,
        pub(crate) tool: ToolState<D>,
        pub(crate) feed: Feed<D>,
        pub(crate) spindle: SpindleState<D>,
        pub(crate) coolant: CoolantState,
        pub(crate) cycle: CycleWords,
        /// Words of turning cycles.
        pub(crate) turning: KeptTurningWords,
        pub(crate) transform: Transform,
        pub(crate) mapping: Mapping,
        pub(crate) compensation: CompensationState,
        pub(crate) blending: Blending,
        /// Control points of a curve under way.
        pub(crate) curve: Perhaps<ControlPoints>,
        pub(crate) probe: Probe,
        /// Shifts by the tool between the programmed point and the axes.
        pub(crate) tool_shift: ToolShift,
        pub(crate) bar: Bar,
        /// Are blocks rows of data, not commands?
        pub(crate) data_entry: Truth,
    }
}

impl<D: Domain> State<D> {
    // ---- how states become one ----

    /// What holds in this state or in the other.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        self.join(other)
    }

    /// Is nothing under way but the main program: no call, no counted loop, no branch to be found, no move held back?
    pub(crate) fn is_in_main_program_alone(&self) -> bool {
        let idle = |kept: &Kept| {
            let Kept { repeats: _, counters, saved: _, restore_on_return: _, wanted_branch, bar_feed } = kept;
            counters.is_empty() && wanted_branch.is_no() && bar_feed.is_no()
        };
        self.calls.is_main()
            && self.calls.kept().is_some_and(idle)
            && self.calls.modal.is_off()
            && self.compensation.is_off()
    }

    /// A program was executed that is not here: hardly anything is known. What was off is taken to be left off, and what it is
    /// a mistake to change in a subprogram (units, diameters, the control's own frames, the tool table) as it was.
    pub(crate) fn forget(&mut self) {
        let Self {
            points,
            variables,
            calls,
            modes,
            offsets,
            tool,
            feed,
            spindle,
            coolant,
            cycle,
            turning,
            transform,
            mapping,
            compensation,
            blending,
            curve,
            probe,
            tool_shift,
            bar,
            data_entry,
        } = self;
        points.lose();
        points.passed = Position::UNKNOWN;
        variables.forget_all();
        calls.forget_locals();
        let modal = calls.modal.or_off();
        calls.modal = modal;
        modes.forget();
        offsets.forget();
        tool.forget();
        feed.forget();
        spindle.forget();
        coolant.forget();
        let words = cycle.forgotten();
        *cycle = words;
        *turning = KeptTurningWords::of(&TurningWords::UNKNOWN);
        let after = transform.or_other();
        *transform = after;
        mapping.forget();
        compensation.forget();
        *blending = Blending::UNKNOWN;
        let points_left = curve.or_other();
        *curve = points_left;
        probe.forget();
        let shift = tool_shift.or_none();
        *tool_shift = shift;
        *bar = Bar::UNKNOWN;
        if *data_entry != Truth::False {
            *data_entry = Truth::Unknown;
        }
    }

    /// Are blocks lines of data here, not commands?
    pub fn reads_data(&self) -> bool {
        self.data_entry == Truth::True
    }

    /// Is a block with these flags a row of data? A code ends the data, and a macro statement is executed.
    pub fn reads_as_row(&self, flags: BlockFlags) -> bool {
        self.reads_data() && !flags.intersects(BlockFlags::CODE | BlockFlags::STATEMENT)
    }

    /// Takes back what [`Self::forget`] took away, as far as the program had set it: what still is as at the start may be what
    /// the program that is not here is called for. Motion and positions stay unknown, since it may move.
    pub(crate) fn keep_what_was_set(&mut self, before: &Self, start: &Self) {
        self.modes.keep_what_was_set(&before.modes, &start.modes);
        self.tool.keep_what_was_set(&before.tool, &start.tool);
        if !before.spindle.same(&start.spindle) {
            self.spindle = before.spindle.clone();
        }
        if !before.feed.word.same(&start.feed.word) {
            self.feed = before.feed.clone();
        }
        if !before.coolant.same(&start.coolant) {
            self.coolant = before.coolant.clone();
        }
        if !before.offsets.work.same(&start.offsets.work) {
            self.offsets.work = before.offsets.work;
        }
    }

    /// How many values of programs and variables it holds: what a copy or a comparison costs.
    pub(crate) fn values_held(&self) -> usize {
        self.calls.values_held() + self.variables.values_held()
    }

    // ---- parts ----

    /// The codes that may be in effect for a role.
    pub fn mode(&self, role: Role) -> &ModeSet {
        self.modes.of(role)
    }

    pub(crate) fn set_mode(&mut self, role: Role, code: CodeIx) {
        self.modes.set(role, code);
    }

    /// The effect in force for a role, if it is the only one it may be.
    pub fn effect(&self, role: Role, model: &Model<'_>) -> Option<Effect> {
        self.mode(role).only().map(|code| model.effect(code))
    }

    /// The programmed point in programmed coordinates.
    pub fn position(&self) -> &Position {
        &self.points.position
    }

    /// Where the axes stand in work coordinates.
    pub fn actual(&self) -> &Position {
        &self.points.actual
    }

    /// The feed as it was given: 0 for none.
    pub fn feed(&self) -> &D::Value {
        &self.feed.rate
    }

    /// The feed mode under which the feed was given: a change of the mode may leave a number that means something else.
    pub fn feed_given_under(&self) -> &ModeSet {
        &self.feed.given_under
    }

    /// The feed as the program wrote it: its number without a unit, 0 for none. It counts in the units of its time, which a
    /// later `G20` or `G21` may have changed; [`Self::feed`] is in millimetres.
    pub fn feed_word(&self) -> &D::Value {
        &self.feed.word
    }

    /// The speed as it was given: 0 for none.
    pub fn speed(&self) -> &D::Value {
        &self.spindle.speed
    }

    /// The spindle; `None` when it may be turning or not.
    pub fn spindle(&self) -> Option<Spindle> {
        self.spindle.way.known()
    }

    /// Does a live tool turn?
    pub fn live_tool(&self) -> Truth {
        self.spindle.live_tool
    }

    /// Limit of constant surface speed in turns a minute; infinite without a limit, NaN unknown.
    pub fn speed_limit(&self) -> f64 {
        self.spindle.limit
    }

    /// Is flood coolant on, is mist?
    pub fn coolant(&self) -> (Truth, Truth) {
        (self.coolant.flood, self.coolant.mist)
    }

    /// Tool in the spindle.
    pub fn tool(&self) -> &D::Value {
        &self.tool.number
    }

    /// Tool called for.
    pub fn selected(&self) -> &D::Value {
        &self.tool.selected
    }

    /// Number of the tool length offset in effect; 0 for none.
    pub fn h(&self) -> &D::Value {
        &self.tool.h
    }

    /// Number of the cutter compensation offset in effect; 0 for none.
    pub fn d(&self) -> &D::Value {
        &self.tool.d
    }

    /// Tool offsets in effect by axis.
    pub fn length(&self) -> &Position {
        &self.tool.length
    }

    /// Is cutter compensation on along a path that nobody knows: the cutter's size or where it began is not known?
    pub fn is_beside_by_unknown(&self) -> bool {
        self.compensation.is_unknown_path()
    }

    /// Shifts by the tool between the programmed point and the axes.
    pub fn tool_shift(&self) -> &ToolShift {
        &self.tool_shift
    }

    /// Number of the active work coordinate system, 1 the first.
    pub fn work(&self) -> Option<u16> {
        self.offsets.work.known()
    }

    /// The active offset, rotation included.
    pub fn work_offset(&self) -> WorkOffset {
        self.offsets.in_effect
    }

    /// The shift of `G92` (and `G52`) in effect.
    pub fn shift(&self) -> Position {
        self.offsets.shift_in_effect() + self.offsets.local
    }

    /// Transformations in effect.
    pub fn transform(&self) -> &Transform {
        &self.transform
    }

    /// Level and tolerance (millimetres) of smoothing, as a program gave them; NaN unknown.
    pub const fn smoothing(&self) -> (Option<f64>, Option<f64>) {
        (self.blending.smoothing_level, self.blending.smoothing_tolerance)
    }

    /// The level of contour control, 0 for one without a number, while it is on; NaN unknown.
    pub const fn contour_control(&self) -> Option<f64> {
        self.blending.contour
    }

    /// Whether X and a rotary axis make the moves of a flat plane.
    pub(crate) fn face(&self) -> &Perhaps<PolarPlane> {
        &self.mapping.face
    }

    /// Whether a linear axis is wrapped around a cylinder.
    pub(crate) fn wrapped(&self) -> &Perhaps<Cylinder> {
        &self.mapping.wrapped
    }

    /// The cylinder around which a linear axis is wrapped for certain.
    pub fn cylinder(&self) -> Option<&Cylinder> {
        self.wrapped().yes()
    }

    /// May a linear axis be wrapped around a cylinder?
    pub fn may_be_wrapped(&self) -> bool {
        !self.wrapped().is_no()
    }

    /// Diameters of cylinders as the program gave them.
    pub fn diameters(&self) -> &Diameters {
        &self.mapping.diameters
    }

    /// Words of the canned cycle in effect.
    pub fn cycle(&self) -> &CycleWords {
        &self.cycle
    }

    /// Words of turning cycles.
    pub(crate) fn turning(&self) -> TurningWords {
        self.turning.get()
    }

    /// Programs under way, the main program first; of a state that stands for calls from several places, the last alone.
    pub fn frames(&self) -> &[Frame<D>] {
        self.calls.frames()
    }

    /// The program under way.
    pub fn program(&self) -> Option<&Frame<D>> {
        self.calls.last()
    }

    /// How many programs are under way: 1 in the main program.
    pub fn call_depth(&self) -> usize {
        self.calls.depth()
    }

    /// Is the main program under way, and no call?
    pub fn in_main_program(&self) -> bool {
        self.calls.is_main()
    }

    /// Is a program under way that was entered so, be it the last one or one that called it?
    pub fn is_inside(&self, kind: FrameKind) -> bool {
        self.calls.has(kind)
    }

    /// A local variable as the program under way sees it; `None` for a number that is no local.
    pub fn local(&self, number: u32) -> Option<&D::Value> {
        if number == 0 { None } else { self.calls.locals()?.get(number) }
    }

    /// The bar in the chuck and in the feeder.
    pub fn bar(&self) -> &Bar {
        &self.bar
    }

    /// The variables.
    pub fn variables(&self) -> &Variables<D> {
        &self.variables
    }

    /// Work offsets, reference points, tools.
    pub fn tables(&self) -> &Tables {
        &self.offsets.tables
    }

    /// The last probing move.
    pub fn touched(&self) -> Touch {
        self.probe.touched
    }

    /// The probing move whose touch is kept for a measurement between two.
    pub fn kept_touch(&self) -> Touch {
        self.probe.kept
    }

    // ---- what modes mean ----

    /// The active plane.
    pub fn plane(&self, model: &Model<'_>) -> Option<Plane> {
        if model.semantics().polar_interpolation.is_some_and(|rules| rules.own_plane) {
            match self.face() {
                Perhaps::No => {}
                Perhaps::Yes(_) => return Some(Plane::Xy),
                Perhaps::Unknown => return None,
            }
        }
        match self.effect(Role::Plane, model)? {
            Effect::PlaneXy => Some(Plane::Xy),
            Effect::PlaneZx => Some(Plane::Zx),
            Effect::PlaneYz => Some(Plane::Yz),
            _ => None,
        }
    }

    /// The units of the program.
    pub fn units(&self, model: &Model<'_>) -> Option<Units> {
        match self.effect(Role::Units, model)? {
            Effect::Inch => Some(Units::Inch),
            Effect::Millimetre => Some(Units::Mm),
            _ => None,
        }
    }

    /// What `F` means.
    pub fn feed_mode(&self, model: &Model<'_>) -> Option<FeedMode> {
        match self.effect(Role::FeedMode, model)? {
            Effect::FeedInverseTime => Some(FeedMode::InverseTime),
            Effect::FeedPerMinute => Some(FeedMode::PerMinute),
            Effect::FeedPerRevolution => Some(FeedMode::PerRevolution),
            _ => None,
        }
    }

    /// How corners are taken. Tolerances are in millimetres; NaN where they are not known.
    pub fn path_mode(&self, model: &Model<'_>) -> Option<PathMode> {
        let mode = self.mode(Role::PathControl).only()?;
        Some(match model.effect(mode) {
            Effect::ExactPath => PathMode::ExactPath,
            Effect::ExactStop => PathMode::ExactStop,
            _ => self.blending_mode(),
        })
    }

    /// Blending in effect.
    pub(crate) fn blending_mode(&self) -> PathMode {
        let Blending { tolerance, naive, unit, .. } = self.blending;
        let length = |number: f64| Mm(if number == 0.0 { 0.0 } else { number * unit });
        PathMode::Blending { tolerance: length(tolerance), naive: naive.map(length) }
    }

    /// Are words increments (`G91`)?
    pub fn is_incremental(&self, model: &Model<'_>) -> Option<bool> {
        match self.mode(Role::Distance).only()? {
            // Controls without the codes measure from the origin.
            CodeIx::NONE => Some(false),
            code => match model.effect(code) {
                Effect::Absolute => Some(false),
                Effect::Incremental => Some(true),
                _ => None,
            },
        }
    }

    /// Does X count diameters?
    pub fn is_diameter(&self, model: &Model<'_>) -> Option<bool> {
        match self.mode(Role::Diameter).only()? {
            CodeIx::NONE => Some(model.semantics().diameter),
            code => match model.effect(code) {
                Effect::DiameterOn => Some(true),
                Effect::DiameterOff => Some(false),
                _ => None,
            },
        }
    }

    /// Do words of X count diameters? On some controls they count radii while X and a rotary axis share the moves of X and Y.
    pub fn words_are_diameters(&self, model: &Model<'_>) -> Option<bool> {
        if model.semantics().polar_interpolation.is_some_and(|rules| rules.by_radius) {
            match self.effect(Role::PolarInterpolation, model)? {
                Effect::PolarInterpolationOn => return Some(false),
                _ => return self.is_diameter(model),
            }
        }
        self.is_diameter(model)
    }

    /// The active canned cycle's code; `Some(CodeIx::NONE)` when none is.
    pub fn active_cycle(&self, model: &Model<'_>) -> Option<CodeIx> {
        let code = self.mode(Role::Cycle).only()?;
        Some(if model.effect(code) == Effect::CycleCancel { CodeIx::NONE } else { code })
    }
}

impl State<Concrete> {
    /// The state of a run as one of the analysis: what the run does not know may be anything.
    #[must_use]
    pub fn as_abstract(&self) -> State<Abstract> {
        self.lift(&AbstractValue::Unknown)
    }

    /// What the analysis must cover of a state of a run: a variable that the run does not know contradicts nothing.
    #[must_use]
    pub fn as_covered(&self) -> State<Abstract> {
        self.lift(&AbstractValue::none())
    }

    /// The state of a run as one of the analysis, with `unknown` for every variable that the run does not know. Nothing differs
    /// between the two but their values: a field that is not named here does not compile.
    fn lift(&self, unknown: &AbstractValue) -> State<Abstract> {
        let change = &|value: &ConcreteValue| match value {
            ConcreteValue::Vacant => AbstractValue::Vacant,
            ConcreteValue::Number(number) => AbstractValue::Number(*number),
            ConcreteValue::Unknown => unknown.clone(),
        };
        let Self {
            points,
            variables,
            calls,
            modes,
            offsets,
            tool,
            feed,
            spindle,
            coolant,
            cycle,
            turning,
            transform,
            mapping,
            compensation,
            blending,
            curve,
            probe,
            tool_shift,
            bar,
            data_entry,
        } = self.clone();
        State {
            points,
            variables: variables.map(change),
            calls: calls.map(change),
            modes,
            offsets,
            tool: tool.map(change),
            feed: feed.map(change),
            spindle: spindle.map(change),
            coolant,
            cycle,
            turning,
            transform,
            mapping,
            compensation,
            blending,
            curve,
            probe,
            tool_shift,
            bar,
            data_entry,
        }
    }
}
