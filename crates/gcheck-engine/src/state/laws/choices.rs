//! Values of every part of the state, made from a row of choices.
//!
//! Knows: few values of each kind, so that two of them are often the same. Must not know: the laws.

use std::rc::Rc;

use gcheck_controls::{CodeIx, Control, LetterSet};
use gcheck_geometry::{CompensationConfig, Compensator, Cutter, CutterSide, LineKind, Mm, PathPoint, Plane};
use gcheck_program::BlockFlags;

use super::*;
use crate::event::Event;
use crate::origin::{At, Origin};

/// A row of choices; when they run out, each is 0.
pub(super) struct Choices<'a>(std::slice::Iter<'a, u8>);

impl<'a> Choices<'a> {
    pub(super) fn of(choices: &'a [u8]) -> Self {
        Self(choices.iter())
    }

    fn below(&mut self, of: u8) -> u8 {
        self.0.next().map_or(0, |choice| choice % of)
    }

    fn one_of<T: Clone>(&mut self, of: &[T]) -> T {
        of[usize::from(self.below(of.len() as u8))].clone()
    }

    fn make<T: Made>(&mut self) -> T {
        T::made(self)
    }

    fn some<T: Made>(&mut self) -> Perhaps<T> {
        match self.below(4) {
            0 => Perhaps::No,
            3 => Perhaps::Unknown,
            _ => Perhaps::Yes(self.make()),
        }
    }
}

/// A value that choices decide.
pub(super) trait Made: Sized {
    /// So many choices decide it.
    const CHOICES: usize;

    fn made(choices: &mut Choices<'_>) -> Self;
}

macro_rules! made {
    ($($kind:ty, $count:expr, $choices:ident => $value:expr;)*) => { $(
        impl Made for $kind {
            const CHOICES: usize = $count;

            fn made($choices: &mut Choices<'_>) -> Self {
                $value
            }
        }
    )* };
}

made! {
    f64, 1, c => c.one_of(&[0.0, 1.0, -2.5, f64::NAN, -0.0, f64::INFINITY]);
    Option<f64>, 1, c => c.one_of(&[None, Some(0.0), Some(3.0), Some(f64::NAN)]);
    bool, 1, c => c.below(2) == 1;
    Truth, 1, c => c.one_of(&[Truth::True, Truth::False, Truth::Unknown]);
    May, 1, c => May(c.make());
    u16, 1, c => u16::from(c.below(3));
    u32, 1, c => u32::from(c.below(3));
    At, 1, c => At { file: 0, block: c.make() };
    Flat<u16>, 1, c => c.one_of(&[Flat::Known(1), Flat::Known(2), Flat::Unknown]);
    Flat<u32>, 1, c => c.one_of(&[Flat::Known(1), Flat::Known(2), Flat::Unknown]);
    Flat<Spindle>, 1, c => {
        c.one_of(&[Flat::Known(Spindle::Stopped), Flat::Known(Spindle::Clockwise), Flat::Unknown])
    };
    Flat<u8>, 1, c => c.one_of(&[Flat::Known(0), Flat::Known(3), Flat::Unknown]);
    Perhaps<u32>, 2, c => c.some();
    LetterSet, 3, c => ["R", "ZQ", "PI"].into_iter().filter(|_| c.below(2) == 1).map(LetterSet::of)
        .fold(LetterSet::EMPTY, LetterSet::or);
    Position, 9, c => Position::new(std::array::from_fn(|_| c.make()));
    AbstractValue, 4, c => {
        let (low, high): (f64, f64) = (f64::from(c.below(5)), f64::from(c.below(5)));
        match c.below(6) {
            0 => AbstractValue::Vacant,
            1 => AbstractValue::Number(low),
            2 => AbstractValue::numbers([low, high, -3.0], c.make()),
            3 => AbstractValue::interval(low, low + high + 1.0, c.make()),
            4 => AbstractValue::any_number(),
            _ => AbstractValue::Unknown,
        }
    };
    WorkOffset, 10, c => WorkOffset { origin: c.make(), rotation: c.make() };
    Points, 27, c => {
        let mut points = Points::at(c.make());
        points.actual = c.make();
        points.passed = c.make();
        points
    };
    ToolData, 16, c => ToolData {
        offset: c.make(),
        diameter: Mm(c.make()),
        corner_radius: Mm(c.make()),
        wear: [c.make(), c.make()],
        angles: [c.make(), c.make()],
        orientation: c.make(),
    };
    Blending, 9, c => Blending {
        tolerance: c.make(),
        naive: c.make(),
        unit: c.make(),
        smoothing_level: c.make(),
        smoothing_tolerance: c.make(),
        contour: c.make(),
    };
    CoolantState, 2, c => {
        let mut coolant = CoolantState::all(c.make());
        coolant.mist = c.make();
        coolant
    };
    SpindleState<Abstract>, 10, c => {
        let mut spindle = SpindleState::<Abstract>::stopped();
        spindle.speed = c.make();
        spindle.limit = c.make();
        spindle.way = c.make();
        spindle.live_tool = c.make();
        spindle.overridable = c.make();
        spindle
    };
    Feed<Abstract>, 24, c => {
        let mut feed = Feed::<Abstract>::none(c.make());
        feed.rate = c.make();
        feed.word = c.make();
        feed.overridable = c.make();
        feed.adaptive = c.make();
        feed.hold = c.make();
        feed
    };
    Loaded, 16, c => Loaded { data: c.make(), entry: c.some() };
    Tables, 90, c => {
        let machine = Machine {
            fresh: c.make(),
            tool_table_is_complete: c.make(),
            ..Machine::default()
        };
        let mut tables = Tables::of(&machine, false);
        if c.below(4) == 3 {
            tables.forget_offsets(c.make());
        }
        for number in 1..=2 {
            if c.make::<bool>() {
                tables.set_offset(number, c.make());
            }
            if c.make::<bool>() {
                *tables.tool_mut(u32::from(number)) = c.make();
            }
        }
        if c.below(4) == 3 {
            tables.forget_offsets(c.make());
        }
        if c.below(4) == 3 {
            tables.forget_tools();
        }
        tables.references[1] = c.make();
        tables
    };
    Offsets, 130, c => {
        let mut offsets = Offsets::unshifted(c.make(), Some(1));
        offsets.work = c.make();
        offsets.in_effect = c.make();
        offsets.shift = c.make();
        offsets.shift_on = c.make();
        offsets.local = c.make();
        offsets
    };
    ToolState<Abstract>, 45, c => {
        let mut tool = ToolState::<Abstract>::at_start(c.make(), &Tables::of(&Machine::default(), false));
        tool.number = c.make();
        tool.selected = c.make();
        tool.loaded = c.make();
        tool.length = c.make();
        tool.h = c.make();
        tool.d = c.make();
        tool
    };
    CycleWords, 20, c => {
        let mut words = CycleWords::NONE;
        let given: LetterSet = c.make();
        given.iter().for_each(|letter| words.give(letter));
        [words.r, words.z, words.q] = [c.make(), c.make(), c.make()];
        [words.p, words.e, words.initial] = [c.make(), c.make(), c.make()];
        words.given = [c.make(), c.make()];
        words.last_dwell = c.make();
        words.pocket_r = c.make();
        words.feed_override_on = c.make();
        words.ijk = [c.make(), c.make(), c.make()];
        words
    };
    KeptTurningWords, 20, c => if c.below(4) == 0 {
        KeptTurningWords::default()
    } else {
        KeptTurningWords::of(&TurningWords {
            start: [c.make(), c.make()],
            corner: [c.make(), c.make()],
            taper: c.make(),
            lead: c.make(),
            roughing: [c.make(), c.make()],
            pattern: [c.make(), c.make(), c.make()],
            peck_retract: c.make(),
            thread: [c.make(), c.make(), c.make(), c.make(), c.make()],
        })
    };
    Transform, 20, c => {
        let centre = [c.make(), c.make(), c.make()];
        let mut transform = Transform::NONE
            .scaled([c.one_of(&[1.0, 2.0, f64::NAN]), 1.0, 1.0], centre)
            .rotated(c.one_of(&[0.0, 30.0, f64::NAN]), centre, c.one_of(&[Plane::Xy, Plane::Yz]));
        for mirror in transform.mirrors_mut() {
            *mirror = c.some();
        }
        transform
    };
    Cylinder, 4, c => Cylinder {
        linear: c.one_of(&[Axis::X, Axis::Y]),
        rotary: Axis::A,
        diameter: c.make(),
        stands: c.make(),
        zero: c.make(),
    };
    PolarPlane, 4, c => PolarPlane {
        rotary: c.one_of(&[Axis::B, Axis::C]),
        zero: c.make(),
        stands: c.make(),
        far: c.make(),
    };
    TiltedPlane, 6, c => TiltedPlane {
        origin: [c.make(), c.make(), c.make()],
        turns: [c.make(), c.make(), c.make()],
    };
    Mapping, 18, c => {
        let mut mapping =
            Mapping { wrapped: c.some(), face: c.some(), tilted: c.some(), ..Mapping::default() };
        for axis in [Axis::A, Axis::B] {
            if c.make::<bool>() {
                mapping.diameters.set(axis, c.make());
            }
        }
        mapping
    };
    ToolShift, 5, c => {
        ToolShift { along: c.make(), cutter: c.make(), beside: [c.make(), c.make(), c.make()] }
    };
    Touch, 3, c => match c.below(4) {
        0 => Touch::None,
        3 => Touch::Unknown,
        _ => {
            let mut ways = Ways::STILL;
            ways.set(c.one_of(&[Axis::X, Axis::Y]), c.one_of(&[Way::Up, Way::Down, Way::Unknown]));
            Touch::Made(ways)
        }
    };
    Probe, 17, c => {
        let mut probe = Probe::at_start(c.make());
        probe.point = c.make();
        probe.result = c.make();
        probe.touched = c.make();
        probe.kept = c.make();
        probe
    };
    Bar, 4, c => {
        let mut bar = if c.make::<bool>() {
            let new_bar = Some(Mm(c.one_of(&[1000.0, 500.0])));
            let bar = BarFeeder { new_bar, bars: Some(3), starts_new: true };
            Bar::at_start(&Machine { bar, ..Machine::default() })
        } else {
            Bar::UNKNOWN
        };
        bar.clamped = c.make();
        if c.make::<bool>() {
            bar.set_length(c.make());
        }
        bar
    };
    Course, 3, c => if c.below(4) == 0 { Course::Unknown } else { Course::Followed(Rc::new(compensation(c))) };
    CompensationState, 8, c => CompensationState { on: c.some(), left: c.some() };
    ControlPoints, 8, c => {
        let count = c.below(3);
        ControlPoints(Rc::new((0..count).map(|_| [c.make(), c.make(), 1.0]).collect()))
    };
    Perhaps<ControlPoints>, 8, c => c.some();
    BarCommand, 4, c => {
        BarCommand { part: c.make(), initial: c.make(), clamping: 5.0, orient: c.make() }
    };
    Rc<BarCommand>, 4, c => Rc::new(c.make());
    SavedModes, 260, c => SavedModes {
        modes: std::array::from_fn(|_| c.make()),
        feed: c.make(),
        speed: c.make(),
        spindle: c.make(),
        mist: c.make(),
        flood: c.make(),
        length: c.make(),
        feed_override: c.make(),
        speed_override: c.make(),
        blending: c.make(),
        speed_limit: c.make(),
        adaptive: c.make(),
        feed_hold: c.make(),
    };
    Rc<SavedModes>, 260, c => Rc::new(c.make());
    Kept, 290, c => {
        let mut kept = Kept::new(None);
        kept.repeats = c.make();
        for block in 5..7 {
            if c.make::<bool>() {
                kept.counters.set(At { file: 0, block }, c.make());
            }
        }
        kept.wanted_branch = c.some();
        kept.bar_feed = c.some();
        kept.restore_on_return = c.make();
        kept.saved = c.some();
        kept
    };
    Locals<Abstract>, 24, c => {
        let mut locals = Locals::new(3, &AbstractValue::Vacant);
        for number in 1..=3 {
            locals.set(number, c.make());
        }
        if c.make::<bool>() {
            locals.set_named(NameId(7), c.make());
        }
        locals
    };
    Variables<Abstract>, 40, c => {
        let unwritten = c.one_of(&[AbstractValue::Vacant, AbstractValue::Unknown]);
        let mut variables = Variables::new(unwritten, std::iter::once((500, 1.0)));
        if c.below(4) == 3 {
            variables.forget();
        }
        if c.below(8) == 7 {
            variables.forget_all();
        }
        for number in [100, 101] {
            if c.make::<bool>() {
                variables.set(number, c.make());
            }
        }
        for name in [NameId(1), NameId(2)] {
            if c.make::<bool>() {
                variables.set_named(name, c.make());
            }
        }
        variables
    };
    ModalCall<Abstract>, 8, c => ModalCall {
        target: c.make(),
        arguments: (1..=u32::from(c.below(3))).map(|number| (number, c.make())).collect(),
        repeats: c.make(),
    };
    ModalCalls<Abstract>, 30, c => {
        let mut calls = match c.below(4) {
            0 => ModalCalls::off(),
            3 => ModalCalls::unknown(),
            _ => ModalCalls::on(c.make()),
        };
        for _ in 0..c.below(3) {
            calls = calls.join(&ModalCalls::on(c.make()));
        }
        if c.make::<bool>() { calls.or_off() } else { calls }
    };
    Calls<Abstract>, 400, c => {
        let mut calls = Calls::main(c.make());
        for _ in 0..c.below(3) {
            let kind = c.one_of(&[FrameKind::Subprogram, FrameKind::Macro]);
            let mut frame = Frame::new(kind, c.make(), c.make(), Some(0));
            frame.locals = c.some();
            calls.push(frame);
        }
        if let Some(kept) = calls.kept_mut() {
            kept.repeats = c.make();
            kept.wanted_branch = c.some();
            kept.restore_on_return = c.make();
        }
        calls.modal = c.make();
        calls
    };
    Modes, 160, c => Modes::new(&std::array::from_fn(|_| c.make()));
    ModeSet, 6, c => {
        let codes = codes();
        let mut set = match c.below(8) {
            6 => ModeSet::ANY,
            7 => ModeSet::UNKNOWN,
            _ => ModeSet::one(c.one_of(&codes)),
        };
        for _ in 0..c.below(4) {
            set = set.join(&ModeSet::one(c.one_of(&codes)));
        }
        set
    };
    State<Abstract>, 1_400, c => {
        let mut state = known_state();
        state.points = c.make();
        state.variables = c.make();
        state.calls = c.make();
        state.modes = c.make();
        state.offsets = c.make();
        state.tool = c.make();
        state.feed = c.make();
        state.spindle = c.make();
        state.coolant = c.make();
        state.cycle = c.make();
        state.turning = c.make();
        state.transform = c.make();
        state.mapping = c.make();
        state.compensation = c.make();
        state.blending = c.make();
        state.curve = c.some();
        state.probe = c.make();
        state.tool_shift = c.make();
        state.bar = c.make();
        state.data_entry = c.make();
        state
    };
}

/// More codes than a set names.
fn codes() -> Vec<CodeIx> {
    thread_local! {
        static CODES: Vec<CodeIx> = {
            let control = gcheck_controls::load("fanuc-mill").unwrap();
            codes_of(&control)
        };
    }
    CODES.with(Clone::clone)
}

fn codes_of(control: &Control) -> Vec<CodeIx> {
    let codes = control.codes().take(12).map(|code| control.code_ix(code.number()));
    codes.chain([CodeIx::NONE]).collect()
}

/// Compensation with a move that it holds back.
fn compensation(c: &mut Choices<'_>) -> Compensation {
    let origin = Origin {
        at: At { file: 0, block: 1 },
        start: 0,
        end: 4,
        flags: BlockFlags::empty(),
        letters: LetterSet::EMPTY,
        n: None,
    };
    let mut compensator = Compensator::new(CompensationConfig::intersection());
    let side = c.one_of(&[CutterSide::Left, CutterSide::Right]);
    let radius = c.one_of(&[2.0, 3.0]);
    let started = compensator.start(Cutter::new(side, radius), PathPoint::new(0.0, 0.0, 0.0));
    assert!(started.is_ok());
    let to = c.one_of(&[10.0, 20.0]);
    let target = Position::ZERO;
    let payload = Programmed { origin, target, end: target };
    let moved = compensator.line(PathPoint::new(to, 0.0, 0.0), LineKind::Feed, payload, |_| {});
    assert!(moved.is_ok());
    compensator.pass((origin, Event::FeedReference), |_| {});
    Compensation { compensator, plane: Plane::Xy, at: Position::ZERO }
}
