//! The state of a machine between two blocks: values only.
//!
//! Knows: everything a block may depend on, how two states join, when one covers the other. Must not know: where a value was
//! set (see [`crate::Provenance`]), what has happened so far (observers keep that), how blocks change it.

use std::rc::Rc;

use gcheck_controls::{CodeIx, Effect, Letter, LetterSet};
use gcheck_geometry::{Mm, Plane};

use crate::cylinder::{Diameters, Wrapped};
use crate::event::{FeedMode, Spindle, Units};
use crate::machine::WorkOffset;
use crate::modal::ModeSet;
use crate::model::{Model, Role};
use crate::number::{either, stands_for};
use crate::position::{Axis, Position};
use crate::step::bar::{Bar, BarCommand};
use crate::step::compensation::Compensation;
use crate::tool_shift::ToolShift;
use crate::touch::Touch;
use crate::value::{Domain, Truth};
use crate::variables::{Locals, Variables};

/// A block of a loaded program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct At {
    /// Index of the file among those loaded.
    pub file: u32,
    /// Number of the block in the file, counted from 0 in text order.
    pub block: u32,
}

impl At {
    /// The next block in text order.
    #[must_use]
    pub const fn next(self) -> Self {
        Self { file: self.file, block: self.block + 1 }
    }
}

/// How a program was entered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FrameKind {
    /// The main program.
    Main,
    /// `M98`.
    Subprogram,
    /// `M97`.
    Local,
    /// `G65`, an alias, a modal macro call.
    Macro,
    /// `O… CALL`.
    OWord,
}

/// A program being executed: the main program, or a call.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame<D: Domain> {
    /// How it was entered.
    pub kind: FrameKind,
    /// Its first block.
    pub entry: At,
    /// The block that called; the caller goes on behind it.
    pub caller: At,
    /// Further turns to come, when a call repeats; `None` unknown.
    pub repeats: Option<u32>,
    pub(crate) locals: Option<Locals<D>>,
    /// Counters of `REPEAT` loops under way, by their block.
    pub(crate) counters: Vec<(At, Option<u32>)>,
    /// Modes to restore on return (`M73`), or saved (`M70`).
    pub(crate) saved: Option<Rc<SavedModes>>,
    pub(crate) restore_on_return: bool,
    /// The branch of an O-word `IF` that is to be decided next, when the one before it failed.
    pub(crate) wanted_branch: Option<At>,
    /// The bar feed that called a cutoff program, and feeds when it comes back.
    pub(crate) bar_feed: Option<Rc<BarCommand>>,
}

/// Modes saved by `M70` or `M73`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SavedModes {
    pub(crate) modes: [ModeSet; Role::COUNT],
    pub(crate) feed: f64,
    pub(crate) speed: f64,
    pub(crate) spindle: Option<Spindle>,
    pub(crate) mist: Truth,
    pub(crate) flood: Truth,
    pub(crate) length: Position,
    pub(crate) feed_override: Truth,
    pub(crate) speed_override: Truth,
    /// In the program's units when it was given; a change of units does not convert it.
    pub(crate) blending: (f64, Option<f64>),
    pub(crate) speed_limit: f64,
    pub(crate) adaptive: Truth,
    pub(crate) feed_hold: Truth,
}

/// Words of a canned cycle that stay in effect, millimetres; NaN not given, or not known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleWords {
    /// Words of the series that were given, or may have been: their own letters, and `START` for its level.
    may_have: LetterSet,
    /// Retract plane.
    pub r: f64,
    /// Bottom.
    pub z: f64,
    /// Peck or shift.
    pub q: f64,
    /// Dwell in seconds.
    pub p: f64,
    /// R and the depth word as they were given, lengths in millimetres: what increments count from may change.
    pub given: [f64; 2],
    /// The last dwell of any series: some controls give it to taps without one of their own.
    pub last_dwell: f64,
    /// A threading cycle turned the feed override on, though the program has it off.
    pub feed_override_on: bool,
    /// I, J, K.
    pub ijk: [f64; 3],
    /// Depth along the tool.
    pub e: f64,
    /// Level of the depth axis before the series began.
    pub initial: f64,
}

impl CycleWords {
    /// Nothing was given.
    pub const NONE: Self = Self {
        may_have: LetterSet::EMPTY,
        r: f64::NAN,
        z: f64::NAN,
        q: f64::NAN,
        p: f64::NAN,
        given: [f64::NAN; 2],
        last_dwell: f64::NAN,
        feed_override_on: false,
        ijk: [f64::NAN; 3],
        e: f64::NAN,
        initial: f64::NAN,
    };

    /// Stands for the level that a series began at among the words that it may have.
    const START: Letter = Letter::of('N');

    /// Nothing of a new series yet, but the level that it began at where another cycle goes on from it.
    pub(crate) fn series(&self, goes_on: bool) -> Self {
        let Self { last_dwell, feed_override_on, initial, .. } = *self;
        let new = Self { last_dwell, feed_override_on, ..Self::NONE };
        if goes_on && self.has_begun() {
            let may_have = [Self::START].into_iter().collect();
            Self { may_have, initial, ..new }
        } else {
            new
        }
    }

    /// Whether a series is under way, and with which words, is not known.
    pub(crate) fn unknown(&self) -> Self {
        let Self { last_dwell, feed_override_on, .. } = *self;
        let may_have = LetterSet::of("RZQPIJKEXYN");
        Self { may_have, last_dwell, feed_override_on, ..Self::NONE }
    }

    /// May the word have been given in this series? Then its NaN is a value that nobody knows.
    pub(crate) fn may_have(&self, letter: Letter) -> bool {
        self.may_have.contains(letter)
    }

    /// The block gives the word.
    pub(crate) fn give(&mut self, letter: Letter) {
        self.may_have.insert(letter);
    }

    /// A word's value: `None` not given, NaN unknown.
    pub(crate) fn word(&self, letter: char, value: f64) -> Option<f64> {
        (!value.is_nan() || self.may_have(Letter::of(letter))).then_some(value)
    }

    /// I, J and K are another's, and stay what they were.
    pub(crate) fn take_back_ijk(&mut self, before: &Self) {
        let letters = LetterSet::of("IJK");
        self.ijk = before.ijk;
        self.may_have = self.may_have.without(letters).or(before.may_have.and(letters));
    }

    /// Did a series begin, or may it have begun?
    pub(crate) fn has_begun(&self) -> bool {
        self.may_have(Self::START)
    }

    /// The series begins at a level.
    pub(crate) fn begin(&mut self, level: f64) {
        self.initial = level;
        self.give(Self::START);
    }

    /// The series is over: the next cycle begins at a level of its own.
    pub(crate) fn end(&mut self) {
        self.initial = f64::NAN;
        self.may_have = self.may_have.without([Self::START].into_iter().collect());
    }

    fn bits(&self) -> ([u64; 12], bool, LetterSet) {
        let ([i, j, k], [given_r, given_z]) = (self.ijk, self.given);
        let numbers = [
            self.r,
            self.z,
            given_r,
            given_z,
            self.q,
            self.p,
            self.last_dwell,
            i,
            j,
            k,
            self.e,
            self.initial,
        ];
        (numbers.map(f64::to_bits), self.feed_override_on, self.may_have)
    }

    fn join(&self, other: &Self) -> Self {
        let [i, j, k] = self.ijk;
        let [i2, j2, k2] = other.ijk;
        Self {
            may_have: self.may_have.or(other.may_have),
            r: either(self.r, other.r),
            z: either(self.z, other.z),
            q: either(self.q, other.q),
            p: either(self.p, other.p),
            given: [either(self.given[0], other.given[0]), either(self.given[1], other.given[1])],
            last_dwell: either(self.last_dwell, other.last_dwell),
            feed_override_on: self.feed_override_on && other.feed_override_on,
            ijk: [either(i, i2), either(j, j2), either(k, k2)],
            e: either(self.e, other.e),
            initial: either(self.initial, other.initial),
        }
    }
}

/// Words of turning cycles that stay in effect, millimetres (X as a radius). `None` not given, NaN not known.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct TurningWords {
    /// Cycles of one pass: X and Z of the point that the series begins and ends at.
    pub(crate) start: [Option<f64>; 2],
    /// X and Z of the far corner.
    pub(crate) corner: [Option<f64>; 2],
    /// Start of the cut less its end.
    pub(crate) taper: Option<f64>,
    /// Millimetres a turn.
    pub(crate) lead: Option<f64>,
    /// First block of roughing: depth of a pass, way back from the work.
    pub(crate) roughing: [Option<f64>; 2],
    /// First block of pattern repeating: shift in X and Z, passes.
    pub(crate) pattern: [Option<f64>; 3],
    /// First block of grooving: way back after a peck.
    pub(crate) peck_retract: Option<f64>,
    /// First block of threading: passes at full depth, pull-out in leads, angle in degrees, least depth, left for the end.
    pub(crate) thread: [Option<f64>; 5],
}

impl TurningWords {
    fn all(&self) -> impl Iterator<Item = Option<f64>> {
        let Self { start, corner, taper, lead, roughing, pattern, peck_retract, thread } = *self;
        let ends = [taper, lead, peck_retract];
        start.into_iter().chain(corner).chain(ends).chain(roughing).chain(pattern).chain(thread)
    }

    fn join(&self, other: &Self) -> Self {
        let one = |a: Option<f64>, b: Option<f64>| {
            if a.map(f64::to_bits) == b.map(f64::to_bits) { a } else { Some(f64::NAN) }
        };
        let mut joined = *self;
        let pairs = |a: &mut [Option<f64>], b: &[Option<f64>]| {
            for (a, b) in a.iter_mut().zip(b) {
                *a = one(*a, *b);
            }
        };
        pairs(&mut joined.start, &other.start);
        pairs(&mut joined.corner, &other.corner);
        joined.taper = one(self.taper, other.taper);
        joined.lead = one(self.lead, other.lead);
        pairs(&mut joined.roughing, &other.roughing);
        pairs(&mut joined.pattern, &other.pattern);
        joined.peck_retract = one(self.peck_retract, other.peck_retract);
        pairs(&mut joined.thread, &other.thread);
        joined
    }

    fn contains(&self, inner: &Self) -> bool {
        self.all()
            .zip(inner.all())
            .all(|(a, b)| a.is_some_and(f64::is_nan) || a.map(f64::to_bits) == b.map(f64::to_bits))
    }
}

impl PartialEq for TurningWords {
    /// Bit by bit, so that unknown equals unknown.
    fn eq(&self, other: &Self) -> bool {
        self.all().map(|word| word.map(f64::to_bits)).eq(other.all().map(|word| word.map(f64::to_bits)))
    }
}

/// Transformations between programmed and work coordinates. Off by default.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    /// Scale by axis X, Y, Z; 1 is off.
    pub scale: [f64; 3],
    /// Centre of scaling, work coordinates.
    pub scale_centre: [f64; 3],
    /// Rotation in degrees; 0 is off.
    pub angle: f64,
    /// Centre of rotation.
    pub centre: [f64; 3],
    /// Plane of the rotation.
    pub plane: Plane,
    /// Mirrored axes X, Y, Z.
    pub mirror: [bool; 3],
    /// Where the mirrors stand.
    pub mirror_at: [f64; 3],
}

impl Transform {
    /// Nothing.
    pub const NONE: Self = Self {
        scale: [1.0; 3],
        scale_centre: [0.0; 3],
        angle: 0.0,
        centre: [0.0; 3],
        plane: Plane::Xy,
        mirror: [false; 3],
        mirror_at: [0.0; 3],
    };

    /// Each part that differs becomes unknown by itself, so that the code that ends it makes the whole known again.
    fn join(&self, other: &Self) -> Self {
        let mut joined = *self;
        let bits = |numbers: &[f64; 3]| numbers.map(f64::to_bits);
        let scales = bits(&self.scale) != bits(&Self::NONE.scale);
        if bits(&self.scale) != bits(&other.scale)
            || scales && bits(&self.scale_centre) != bits(&other.scale_centre)
        {
            joined.scale = [f64::NAN; 3];
        }
        let is_elsewhere = bits(&self.centre) != bits(&other.centre) || self.plane != other.plane;
        if self.angle.to_bits() != other.angle.to_bits() || self.angle != 0.0 && is_elsewhere {
            joined.angle = f64::NAN;
        }
        let sides = self.mirror.iter().zip(&other.mirror).zip(self.mirror_at.iter().zip(&other.mirror_at));
        let slots = joined.mirror.iter_mut().zip(&mut joined.mirror_at);
        for ((slot, at), ((mirrored, with), (here, there))) in slots.zip(sides) {
            if mirrored != with || *mirrored && here.to_bits() != there.to_bits() {
                *slot = true;
                *at = f64::NAN;
            }
        }
        joined
    }

    /// Does nothing, so that programmed and work coordinates are one?
    #[expect(clippy::float_cmp, reason = "off is exactly zero and exactly one")]
    pub(crate) fn is_off(&self) -> bool {
        self.angle == 0.0 && self.mirror == [false; 3] && self.scale == [1.0; 3]
    }
}

/// Everything that the next block may depend on.
#[derive(Debug, Clone)]
pub struct State<D: Domain> {
    pub(crate) modes: [ModeSet; Role::COUNT],
    /// The programmed point, programmed coordinates.
    pub(crate) position: Position,
    /// Where the axes stand, work coordinates: differs from `position` under compensation and transformations.
    pub(crate) actual: Position,
    /// Work offsets, reference points and tools: shared until written.
    pub(crate) tables: Rc<Tables>,
    /// Number of the active work coordinate system, 1 the first; `None` unknown.
    pub(crate) work: Option<u16>,
    /// The active work coordinate system as it came into effect: a table written later counts when it is chosen again.
    pub(crate) in_effect: WorkOffset,
    /// `G92`; also `G52` where they are one.
    pub(crate) shift: Position,
    /// The shift counts (`G92.2` suspends it).
    pub(crate) shift_on: bool,
    /// `G52` where it is apart.
    pub(crate) local: Position,
    /// Tool offsets in effect.
    pub(crate) length: Position,
    /// Shifts by the tool between the programmed point and the axes.
    pub(crate) tool_shift: ToolShift,
    pub(crate) h: D::Value,
    pub(crate) d: D::Value,
    /// In millimetres a minute or turn, or moves a minute; 0 none given.
    pub(crate) feed: D::Value,
    /// The feed as the program wrote it.
    pub(crate) feed_word: D::Value,
    /// The feed mode under which it was given.
    pub(crate) feed_given_under: ModeSet,
    /// Turns a minute or metres a minute; 0 none given.
    pub(crate) speed: D::Value,
    /// Limit of constant surface speed, turns a minute; NaN unknown, infinite none.
    pub(crate) speed_limit: f64,
    pub(crate) spindle: Option<Spindle>,
    pub(crate) live_tool: Truth,
    pub(crate) mist: Truth,
    pub(crate) flood: Truth,
    pub(crate) feed_override: Truth,
    pub(crate) speed_override: Truth,
    pub(crate) adaptive: Truth,
    pub(crate) feed_hold: Truth,
    /// The tool in the spindle: vacant none known to be, 0 none.
    pub(crate) tool: D::Value,
    /// The tool called for.
    pub(crate) selected: D::Value,
    /// Data of the tool as it was loaded: what compensation by "the tool in the spindle" reads, and its row in the table
    /// (1 for the first).
    pub(crate) loaded: crate::machine::Tool,
    pub(crate) loaded_row: u32,
    pub(crate) cycle: CycleWords,
    /// Words of turning cycles; none before the first one.
    pub(crate) turning: Option<Rc<TurningWords>>,
    pub(crate) transform: Transform,
    /// A linear axis wrapped around a cylinder.
    pub(crate) wrapped: Wrapped,
    /// Diameters of cylinders as the program gave them.
    pub(crate) diameters: Diameters,
    /// In the program's units when it was given; a change of units does not convert it.
    pub(crate) blending: (f64, Option<f64>),
    /// The point that the last return to a reference position passed, programmed coordinates.
    pub(crate) passed: Position,
    /// Point and result of the last probing move.
    pub(crate) probed: Position,
    pub(crate) probe_result: Truth,
    /// The last probing move, and the one kept for a measurement between two touches.
    pub(crate) touched: Touch,
    pub(crate) kept_touch: Touch,
    /// Polar origin under `G16`.
    pub(crate) polar: [f64; 2],
    pub(crate) variables: Variables<D>,
    pub(crate) frames: Vec<Frame<D>>,
    /// The modal macro call (`G66`).
    pub(crate) macro_modal: Option<Rc<ModalCall<D>>>,
    pub(crate) compensation: Option<Box<Compensation>>,
    /// Compensation switched off, until the move that leaves its path.
    pub(crate) left_compensation: Option<Box<Compensation>>,
    /// Control points of a NURBS block under way.
    pub(crate) nurbs: Option<Rc<Vec<[f64; 3]>>>,
    pub(crate) bar: Bar,
}

/// What `G66` will call.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ModalCall<D: Domain> {
    pub(crate) target: At,
    pub(crate) arguments: Vec<(u32, D::Value)>,
    pub(crate) repeats: u32,
}

/// Work offsets, reference points, tools.
#[derive(Debug, Clone, PartialEq)]
pub struct Tables {
    /// By number; a number that is not there is [`Tables::other_offset`].
    pub(crate) offsets: Vec<(u16, WorkOffset)>,
    /// Offsets that nobody told us.
    pub(crate) other_offset: WorkOffset,
    pub(crate) references: [Position; 4],
    pub(crate) tools: Vec<(u32, crate::machine::Tool)>,
    /// Tools not listed do not exist.
    pub(crate) complete: bool,
    /// Every offset may have changed (an unknown number was written).
    pub(crate) unsure: bool,
}

impl Tables {
    /// A work offset.
    pub fn offset(&self, number: u16) -> WorkOffset {
        if self.unsure {
            return WorkOffset::UNKNOWN;
        }
        self.offsets.iter().find(|(n, _)| *n == number).map_or(self.other_offset, |(_, offset)| *offset)
    }

    /// Writes a work offset.
    pub fn set_offset(&mut self, number: u16, offset: WorkOffset) {
        match self.offsets.iter_mut().find(|(n, _)| *n == number) {
            Some((_, old)) => *old = offset,
            None => self.offsets.push((number, offset)),
        }
    }

    /// A tool.
    pub fn tool(&self, number: u32) -> Option<&crate::machine::Tool> {
        self.tools.iter().find(|(n, _)| *n == number).map(|(_, tool)| tool)
    }

    /// A tool's entry, made when it is not there.
    pub fn tool_mut(&mut self, number: u32) -> &mut crate::machine::Tool {
        let at = match self.tools.iter().position(|(n, _)| *n == number) {
            Some(at) => at,
            None => {
                self.tools.push((
                    number,
                    crate::machine::Tool {
                        pocket: number,
                        offset: if self.complete { Position::ZERO } else { Position::UNKNOWN },
                        diameter: if self.complete { Mm(0.0) } else { Mm::UNKNOWN },
                        corner_radius: Mm::UNKNOWN,
                        angles: [0.0; 2],
                        orientation: 0,
                    },
                ));
                self.tools.len() - 1
            }
        };
        #[expect(clippy::indexing_slicing, reason = "`at` was found or pushed above")]
        &mut self.tools[at].1
    }
}

impl<D: Domain> State<D> {
    /// The codes that may be in effect for a role.
    #[expect(clippy::indexing_slicing, reason = "a role's index is below COUNT")]
    pub fn mode(&self, role: Role) -> &ModeSet {
        &self.modes[role.index()]
    }

    #[expect(clippy::indexing_slicing, reason = "a role's index is below COUNT")]
    pub(crate) fn set_mode(&mut self, role: Role, code: CodeIx) {
        self.modes[role.index()] = ModeSet::one(code);
    }

    /// The role's code may also be one of these.
    #[expect(clippy::indexing_slicing, reason = "a role's index is below COUNT")]
    pub(crate) fn join_mode(&mut self, role: Role, other: &ModeSet) {
        self.modes[role.index()] = self.modes[role.index()].join(other);
    }

    /// The effect in force for a role, if it is the only one it may be.
    pub fn effect(&self, role: Role, model: &Model<'_>) -> Option<Effect> {
        self.mode(role).only().map(|code| model.effect(code))
    }

    /// The programmed point in programmed coordinates.
    pub fn position(&self) -> &Position {
        &self.position
    }

    /// Where the axes stand in work coordinates.
    pub fn actual(&self) -> &Position {
        &self.actual
    }

    /// Where the axes stand in machine coordinates.
    pub fn machine(&self, model: &Model<'_>) -> Position {
        self.to_machine(&self.actual, model)
    }

    /// The feed as it was given: 0 for none.
    pub fn feed(&self) -> &D::Value {
        &self.feed
    }

    /// The feed mode under which the feed was given: a change of the mode may leave a number that means something else.
    pub fn feed_given_under(&self) -> &ModeSet {
        &self.feed_given_under
    }

    /// The feed as the program wrote it: its number without a unit, 0 for none.
    pub fn feed_word(&self) -> &D::Value {
        &self.feed_word
    }

    /// The speed as it was given: 0 for none.
    pub fn speed(&self) -> &D::Value {
        &self.speed
    }

    /// The spindle; `None` when it may be turning or not.
    pub fn spindle(&self) -> Option<Spindle> {
        self.spindle
    }

    /// Does a live tool turn?
    pub fn live_tool(&self) -> Truth {
        self.live_tool
    }

    /// Limit of constant surface speed in turns a minute; infinite without a limit, NaN unknown.
    pub fn speed_limit(&self) -> f64 {
        self.speed_limit
    }

    /// Tool in the spindle.
    pub fn tool(&self) -> &D::Value {
        &self.tool
    }

    /// Tool called for.
    pub fn selected(&self) -> &D::Value {
        &self.selected
    }

    /// Number of the tool length offset in effect; 0 for none.
    pub fn h(&self) -> &D::Value {
        &self.h
    }

    /// Number of the cutter compensation offset in effect; 0 for none.
    pub fn d(&self) -> &D::Value {
        &self.d
    }

    /// Tool offsets in effect by axis.
    pub fn length(&self) -> &Position {
        &self.length
    }

    /// Shifts by the tool between the programmed point and the axes.
    pub fn tool_shift(&self) -> &ToolShift {
        &self.tool_shift
    }

    /// Number of the active work coordinate system, 1 the first.
    pub fn work(&self) -> Option<u16> {
        self.work
    }

    /// The shift of `G92` (and `G52`) in effect.
    pub fn shift(&self) -> Position {
        let shift = if self.shift_on { self.shift } else { Position::ZERO };
        shift + self.local
    }

    /// Transformations in effect.
    pub fn transform(&self) -> &Transform {
        &self.transform
    }

    /// Whether a linear axis is wrapped around a cylinder.
    pub fn wrapped(&self) -> &Wrapped {
        &self.wrapped
    }

    /// Diameters of cylinders as the program gave them.
    pub fn diameters(&self) -> &Diameters {
        &self.diameters
    }

    /// Words of the canned cycle in effect.
    pub fn cycle(&self) -> &CycleWords {
        &self.cycle
    }

    /// Words of turning cycles.
    pub(crate) fn turning(&self) -> TurningWords {
        self.turning.as_deref().copied().unwrap_or_default()
    }

    /// Programs under way, the main program first.
    pub fn frames(&self) -> &[Frame<D>] {
        &self.frames
    }

    /// A local variable as the program under way sees it; `None` for a number that is no local.
    pub fn local(&self, number: u32) -> Option<&D::Value> {
        let locals = self.frames.iter().rev().find_map(|frame| frame.locals.as_ref())?;
        if number == 0 { None } else { locals.get(number) }
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
        &self.tables
    }

    /// The last probing move.
    pub fn touched(&self) -> Touch {
        self.touched
    }

    /// The probing move whose touch is kept for a measurement between two.
    pub fn kept_touch(&self) -> Touch {
        self.kept_touch
    }

    /// The active plane.
    pub fn plane(&self, model: &Model<'_>) -> Option<Plane> {
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

    /// The active canned cycle's code; `Some(CodeIx::NONE)` when none is.
    pub fn active_cycle(&self, model: &Model<'_>) -> Option<CodeIx> {
        let code = self.mode(Role::Cycle).only()?;
        Some(if model.effect(code) == Effect::CycleCancel { CodeIx::NONE } else { code })
    }

    /// The active offset, rotation included.
    pub fn work_offset(&self) -> WorkOffset {
        self.in_effect
    }

    /// From work coordinates to machine coordinates; an axis that is wrapped around a cylinder stands still. What a mode
    /// turns or maps by the machine's own geometry is unknown.
    pub fn to_machine(&self, work: &Position, model: &Model<'_>) -> Position {
        let offset = self.work_offset();
        let work = self.wrapped.standing(*work);
        let machine = rotate(work + self.shift(), offset.rotation) + offset.origin + self.length;
        self.without_mapped(machine, &machine, model)
    }

    /// From machine coordinates to work coordinates, as [`Self::to_machine`].
    pub fn from_machine(&self, machine: &Position, model: &Model<'_>) -> Position {
        let offset = self.work_offset();
        let work = rotate(*machine - self.length - offset.origin, -offset.rotation) - self.shift();
        self.without_mapped(work, machine, model)
    }

    /// Does the tool's length lie along Z? Under tool centre point control it does so only while no axis is turned; `machine`
    /// tells where the rotary axes stand.
    pub(crate) fn tool_is_upright(&self, machine: &Position, model: &Model<'_>) -> bool {
        let mode = self.mode(Role::Length);
        !mode.alternatives().iter().any(|code| model.effect(*code) == Effect::ToolCentrePoint)
            || model.axes.iter().all(|axis| !axis.is_rotary() || machine.raw(*axis) == 0.0)
    }

    /// A position without the coordinates in which modes part the machine's axes from the work's. `machine` tells where the
    /// rotary axes stand.
    fn without_mapped(&self, mut position: Position, machine: &Position, model: &Model<'_>) -> Position {
        let may_be = |role: Role, on: Effect| {
            self.mode(role).alternatives().iter().any(|code| model.effect(*code) == on)
        };
        if may_be(Role::TiltedPlane, Effect::TiltedPlaneOn)
            || may_be(Role::DynamicOffset, Effect::DynamicOffsetOn)
            || !self.tool_is_upright(machine, model)
        {
            position = position.with_xyz([Mm::UNKNOWN; 3]);
        }
        if may_be(Role::PolarInterpolation, Effect::PolarInterpolationOn) {
            // X and a rotary axis make the moves of the plane; Z stays its own.
            for axis in model.axes.iter().filter(|axis| axis.is_rotary()).chain(&[Axis::X, Axis::Y]) {
                position.set(*axis, f64::NAN);
            }
        }
        position
    }

    /// What holds in this state or in the other.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        self.join(other, false)
    }

    /// Is nothing under way but the main program: no call, no counted loop, no branch to be found, no move held back?
    pub(crate) fn is_in_main_program_alone(&self) -> bool {
        let [main] = self.frames.as_slice() else { return false };
        main.counters.is_empty()
            && main.wanted_branch.is_none()
            && main.bar_feed.is_none()
            && self.macro_modal.is_none()
            && self.compensation.is_none()
            && self.left_compensation.is_none()
    }

    /// Either state.
    #[must_use]
    pub(crate) fn join(&self, other: &Self, widen: bool) -> Self {
        let value = |a: &D::Value, b: &D::Value| if widen { D::widen(a, b) } else { D::join(a, b) };
        let truth = |a: Truth, b: Truth| if a == b { a } else { Truth::Unknown };
        let mut joined = self.clone();
        for (mode, with) in joined.modes.iter_mut().zip(&other.modes) {
            *mode = mode.join(with);
        }
        joined.position = self.position.join(&other.position);
        joined.actual = self.actual.join(&other.actual);
        joined.tables = join_tables(&self.tables, &other.tables);
        joined.work = if self.work == other.work { self.work } else { None };
        joined.in_effect.origin = self.in_effect.origin.join(&other.in_effect.origin);
        joined.in_effect.rotation = either(self.in_effect.rotation, other.in_effect.rotation);
        joined.shift = self.shift.join(&other.shift);
        if self.shift_on != other.shift_on {
            joined.shift_on = true;
            joined.shift = Position::UNKNOWN;
        }
        joined.local = self.local.join(&other.local);
        joined.length = self.length.join(&other.length);
        joined.tool_shift = self.tool_shift.join(&other.tool_shift);
        joined.h = value(&self.h, &other.h);
        joined.d = value(&self.d, &other.d);
        joined.feed = value(&self.feed, &other.feed);
        joined.feed_word = value(&self.feed_word, &other.feed_word);
        joined.feed_given_under = self.feed_given_under.join(&other.feed_given_under);
        joined.speed = value(&self.speed, &other.speed);
        joined.speed_limit = either(self.speed_limit, other.speed_limit);
        joined.spindle = if self.spindle == other.spindle { self.spindle } else { None };
        joined.live_tool = truth(self.live_tool, other.live_tool);
        joined.mist = truth(self.mist, other.mist);
        joined.flood = truth(self.flood, other.flood);
        joined.feed_override = truth(self.feed_override, other.feed_override);
        joined.speed_override = truth(self.speed_override, other.speed_override);
        joined.adaptive = truth(self.adaptive, other.adaptive);
        joined.feed_hold = truth(self.feed_hold, other.feed_hold);
        joined.tool = value(&self.tool, &other.tool);
        joined.selected = value(&self.selected, &other.selected);
        if self.loaded != other.loaded {
            joined.loaded.offset = self.loaded.offset.join(&other.loaded.offset);
            joined.loaded.diameter = Mm::UNKNOWN;
        }
        joined.cycle = self.cycle.join(&other.cycle);
        if self.turning != other.turning {
            joined.turning = Some(Rc::new(self.turning().join(&other.turning())));
        }
        joined.transform = self.transform.join(&other.transform);
        joined.wrapped = self.wrapped.join(&other.wrapped);
        joined.diameters = self.diameters.join(&other.diameters);
        if self.blending != other.blending {
            joined.blending = (0.0, None);
        }
        joined.passed = self.passed.join(&other.passed);
        joined.probed = self.probed.join(&other.probed);
        joined.probe_result = truth(self.probe_result, other.probe_result);
        joined.touched = self.touched.join(other.touched);
        joined.kept_touch = self.kept_touch.join(other.kept_touch);
        joined.polar = [either(self.polar[0], other.polar[0]), either(self.polar[1], other.polar[1])];
        joined.variables = self.variables.join(&other.variables, widen);
        for (frame, with) in joined.frames.iter_mut().zip(&other.frames) {
            frame.join(with, widen);
        }
        if self.macro_modal != other.macro_modal {
            joined.macro_modal = None;
        }
        if self.compensation != other.compensation {
            joined.compensation = None;
            joined.left_compensation = None;
            joined.actual = Position::UNKNOWN;
        }
        if self.nurbs != other.nurbs {
            joined.nurbs = None;
        }
        joined.bar = self.bar.join(&other.bar);
        joined
    }

    /// Is every state that `inner` stands for one that this stands for?
    pub fn contains(&self, inner: &Self) -> bool {
        let truth = |a: Truth, b: Truth| a == Truth::Unknown || a == b;
        self.modes.iter().zip(&inner.modes).all(|(a, b)| a.contains(b))
            && Axis::ALL.into_iter().all(|axis| {
                stands_for(self.position.raw(axis), inner.position.raw(axis))
                    && stands_for(self.actual.raw(axis), inner.actual.raw(axis))
                    && stands_for(self.length.raw(axis), inner.length.raw(axis))
            })
            && self.tool_shift.contains(&inner.tool_shift)
            && (self.work.is_none() || self.work == inner.work)
            && D::contains(&self.h, &inner.h)
            && D::contains(&self.d, &inner.d)
            && D::contains(&self.feed, &inner.feed)
            && self.feed_given_under.contains(&inner.feed_given_under)
            && D::contains(&self.speed, &inner.speed)
            && D::contains(&self.tool, &inner.tool)
            && D::contains(&self.selected, &inner.selected)
            && (self.spindle.is_none() || self.spindle == inner.spindle)
            && truth(self.live_tool, inner.live_tool)
            && truth(self.mist, inner.mist)
            && truth(self.flood, inner.flood)
            && self.touched.contains(inner.touched)
            && self.kept_touch.contains(inner.kept_touch)
            && (self.turning == inner.turning || self.turning().contains(&inner.turning()))
            && self.wrapped.contains(&inner.wrapped)
            && self.diameters.contains(&inner.diameters)
            && self.bar.contains(&inner.bar)
            && self.variables.contains(&inner.variables)
    }
}

impl<D: Domain> PartialEq for State<D> {
    /// Equal in every value, floats by bits: equal states have equal futures.
    fn eq(&self, other: &Self) -> bool {
        // What turns of a loop differ in comes first.
        self.position == other.position
            && self.variables == other.variables
            && self.frames == other.frames
            && self.modes == other.modes
            && self.actual == other.actual
            && (Rc::ptr_eq(&self.tables, &other.tables) || self.tables == other.tables)
            && self.work == other.work
            && self.in_effect.origin == other.in_effect.origin
            && self.in_effect.rotation.to_bits() == other.in_effect.rotation.to_bits()
            && self.shift == other.shift
            && self.shift_on == other.shift_on
            && self.local == other.local
            && self.length == other.length
            && self.tool_shift == other.tool_shift
            && self.h == other.h
            && self.d == other.d
            && self.feed == other.feed
            && self.feed_word == other.feed_word
            && self.feed_given_under == other.feed_given_under
            && self.speed == other.speed
            && self.speed_limit.to_bits() == other.speed_limit.to_bits()
            && self.spindle == other.spindle
            && (self.live_tool, self.mist, self.flood) == (other.live_tool, other.mist, other.flood)
            && (self.feed_override, self.speed_override, self.adaptive, self.feed_hold)
                == (other.feed_override, other.speed_override, other.adaptive, other.feed_hold)
            && self.tool == other.tool
            && self.selected == other.selected
            && self.loaded.offset == other.loaded.offset
            && self.loaded.diameter.0.to_bits() == other.loaded.diameter.0.to_bits()
            && self.loaded_row == other.loaded_row
            && self.cycle.bits() == other.cycle.bits()
            && self.turning == other.turning
            && format_bits(&self.transform) == format_bits(&other.transform)
            && self.wrapped == other.wrapped
            && self.diameters == other.diameters
            && self.blending == other.blending
            && self.passed == other.passed
            && self.probed == other.probed
            && self.probe_result == other.probe_result
            && (self.touched, self.kept_touch) == (other.touched, other.kept_touch)
            && self.polar.map(f64::to_bits) == other.polar.map(f64::to_bits)
            && self.macro_modal == other.macro_modal
            && self.compensation == other.compensation
            && self.left_compensation.is_none() == other.left_compensation.is_none()
            && self.nurbs == other.nurbs
            && self.bar == other.bar
    }
}

fn format_bits(transform: &Transform) -> ([u64; 13], Plane, [bool; 3]) {
    let Transform { scale, scale_centre, angle, centre, plane, mirror, mirror_at } = transform;
    let mut bits = [0; 13];
    let all = scale.iter().chain(scale_centre).chain(centre).chain(mirror_at).chain([angle]);
    for (slot, value) in bits.iter_mut().zip(all) {
        *slot = value.to_bits();
    }
    (bits, *plane, *mirror)
}

fn join_tables(a: &Rc<Tables>, b: &Rc<Tables>) -> Rc<Tables> {
    if Rc::ptr_eq(a, b) || a == b {
        return Rc::clone(a);
    }
    let mut joined = (**a).clone();
    let numbers: Vec<u16> = a.offsets.iter().chain(&b.offsets).map(|(n, _)| *n).collect();
    for number in numbers {
        let (left, right) = (a.offset(number), b.offset(number));
        let rotation = either(left.rotation, right.rotation);
        joined.set_offset(number, WorkOffset { origin: left.origin.join(&right.origin), rotation });
    }
    for (slot, with) in joined.references.iter_mut().zip(&b.references) {
        *slot = slot.join(with);
    }
    let tools: Vec<u32> = a.tools.iter().chain(&b.tools).map(|(n, _)| *n).collect();
    for number in tools {
        if a.tool(number) == b.tool(number) {
            continue;
        }
        let offset = match (a.tool(number), b.tool(number)) {
            (Some(x), Some(y)) => x.offset.join(&y.offset),
            _ => Position::UNKNOWN,
        };
        let tool = joined.tool_mut(number);
        tool.offset = offset;
        tool.diameter = Mm::UNKNOWN;
    }
    joined.unsure |= b.unsure;
    Rc::new(joined)
}

impl<D: Domain> Frame<D> {
    /// Is it the cutoff program of a bar feed?
    pub fn is_cutoff(&self) -> bool {
        self.bar_feed.is_some()
    }

    /// Is the block the branch that a failed condition chose?
    pub(crate) fn wants(&self, at: At) -> bool {
        self.wanted_branch == Some(at)
    }

    fn join(&mut self, other: &Self, widen: bool) {
        if self.repeats != other.repeats {
            self.repeats = None;
        }
        match (&mut self.locals, &other.locals) {
            (Some(locals), Some(with)) => *locals = locals.join(with, widen),
            (locals, None) | (locals @ None, _) => *locals = None,
        }
        for (at, count) in &mut self.counters {
            let with = other.counters.iter().find(|(a, _)| a == at).map(|(_, c)| *c);
            if with != Some(*count) {
                *count = None;
            }
        }
        if self.saved != other.saved {
            self.saved = None;
        }
        self.restore_on_return |= other.restore_on_return;
        if let (Some(feed), Some(with)) = (&self.bar_feed, &other.bar_feed)
            && feed != with
        {
            self.bar_feed = Some(Rc::new(feed.join(with)));
        }
    }
}

/// Turns a point about Z by degrees; nothing is touched at zero, so that unknown coordinates stay apart.
pub(crate) fn rotate(point: Position, degrees: f64) -> Position {
    if degrees == 0.0 {
        return point;
    }
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (x, y) = (point.raw(Axis::X), point.raw(Axis::Y));
    let mut turned = point;
    turned.set(Axis::X, x * cos - y * sin);
    turned.set(Axis::Y, x * sin + y * cos);
    turned
}
