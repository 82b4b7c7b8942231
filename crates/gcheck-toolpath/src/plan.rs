//! A machine as the planner takes it, and the items that a run is for it.
//!
//! Knows: which events stop the axes, what a control and a machine say of motion, how events become items. Must not know:
//! how motion is planned (`gcheck-planner`), how times are shown.

use std::collections::BTreeMap;

use gcheck_engine::{
    Axis, CornerRules, Event, Halt, Machine, Model, PathMode, Position, RapidRules, Smoothing, Spindle,
    SpindleWaitRules, TapRules,
};
use gcheck_geometry::{Arc, Mm, Plane, Rpm, Seconds};
use gcheck_planner::{
    Changer, Control, Corners, Drive, Item, Limits, Meeting, Move, Point, Rapids, Rounding, Slowing,
    SpindleLimits, SpindleWait, Taps,
};

use crate::motion::{Motion, Tracker, Way};
use crate::step::Step;
use crate::time::Timing;

/// Angle of a chord, in radians, that takes the place of a piece of an arc in a plane other than the main ones.
const CHORD: f64 = 0.1;

/// A machine and its control, as far as they decide how long a program takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    pub(crate) machine: gcheck_planner::Machine,
    /// How corners are taken while the control looks ahead on command.
    contour: Option<Corners>,
    halts: u16,
    auxiliary: Seconds,
    /// Pocket by tool, where it is not the tool's number.
    pockets: BTreeMap<u32, u32>,
    /// How rotary axes accelerate was derived from the linear ones.
    pub(crate) rotary_derived: bool,
    /// Of how the control moves, something is assumed.
    pub(crate) control_assumed: bool,
}

impl Plan {
    /// Of a control with a machine; `None` where the acceleration of the axes is not known.
    pub fn of_machine(model: &Model<'_>, machine: &Machine, timing: &Timing) -> Option<Self> {
        let rules = model.control().motion();
        let dynamics = &machine.dynamics;
        let given = |figures: &BTreeMap<Axis, f64>| {
            let usual = figures.get(&Axis::X).or_else(|| figures.values().next()).copied()?;
            let x = timing.axis_rapid(Axis::X);
            Some(Axis::ALL.map(|axis| match figures.get(&axis) {
                Some(value) => *value,
                // A rotary axis without a figure of its own reaches its rapid rate when X does.
                None if axis.is_rotary() => usual * timing.axis_rapid(axis) / x,
                None => usual,
            }))
        };
        let acceleration = given(&dynamics.acceleration)?;
        let speed = Axis::ALL.map(|axis| timing.axis_rapid(axis) / 60.0);
        let limits = Limits::new(speed, acceleration, given(&dynamics.jerk)).ok()?;
        let limits = machine.max_feed.map_or(limits, |feed| limits.with_feed(feed));
        let corners = |rules: &CornerRules| corners(rules, machine, model);
        let rotary = [Axis::A, Axis::B, Axis::C];
        Some(Self {
            machine: gcheck_planner::Machine {
                limits,
                control: Control {
                    corners: corners(&rules.corners),
                    rapids: match rules.rapids {
                        RapidRules::Joined => Rapids::Joined,
                        RapidRules::Straight => Rapids::Straight,
                        RapidRules::ByAxis => Rapids::ByAxis,
                    },
                    look_ahead: dynamics.look_ahead.unwrap_or(rules.look_ahead) as usize,
                    block_time: dynamics.block_time.unwrap_or(Seconds::ZERO),
                    even_below: Seconds(rules.even_below),
                    shortest: Seconds(rules.shortest),
                    halt_time: Seconds(rules.halt_time),
                    taps: match rules.taps {
                        TapRules::RestAtBottom => Taps::RestAtBottom,
                        TapRules::RunOut => Taps::RunOut,
                    },
                    spindle_wait: match rules.spindle_wait {
                        SpindleWaitRules::AtOnce => SpindleWait::AtOnce,
                        SpindleWaitRules::AtFeed => SpindleWait::AtFeed,
                    },
                },
                spindle: SpindleLimits {
                    acceleration: dynamics.spindle_acceleration,
                    orientation: dynamics.orientation.unwrap_or(Seconds::ZERO),
                },
                changer: Changer {
                    change: timing.tool_change(),
                    pocket: dynamics.pocket.unwrap_or(Seconds::ZERO),
                    pockets: dynamics.pockets,
                    turns_ahead: dynamics.turns_ahead,
                },
                rapid_part: dynamics.rapid_override.map_or(1.0, |percent| percent / 100.0),
            },
            contour: rules.contour.as_ref().map(corners),
            halts: rules.halts.iter().fold(0, |bits, halt| bits | 1 << (*halt as u16)),
            auxiliary: dynamics.auxiliary.unwrap_or(Seconds::ZERO),
            pockets: machine.tools.iter().map(|(tool, entry)| (*tool, entry.pocket)).collect(),
            rotary_derived: rotary.iter().any(|axis| !dynamics.acceleration.contains_key(axis)),
            control_assumed: rules.is_assumed(),
        })
    }

    /// Is it known how quickly the spindle changes its speed?
    pub(crate) const fn knows_spindle(&self) -> bool {
        self.machine.spindle.acceleration.is_some()
    }

    /// What the control takes to prepare a block.
    pub(crate) const fn block_time(&self) -> Seconds {
        self.machine.control.block_time
    }

    fn halts_for(&self, halt: Halt) -> bool {
        self.halts & (1 << (halt as u16)) != 0
    }
}

fn corners(rules: &CornerRules, machine: &Machine, model: &Model<'_>) -> Corners {
    match rules {
        CornerRules::Rounded {
            tolerance_setting,
            tolerance,
            part_of_length,
            stretched,
            curve_shares,
            sharpest_between_arcs,
            across,
            along,
            divides,
            unrounded,
            cycle,
            least_cycles,
            overlaps,
        } => {
            let units = model.units_at_power_on(&machine.settings).map_or(1.0, gcheck_engine::Units::in_mm);
            let set = tolerance_setting.as_ref().and_then(|number| machine.settings.get(number));
            let set = set.and_then(|value| value.parse::<f64>().ok()).map(|value| value * units);
            Corners::Rounded(Rounding {
                default_tolerance: set.or(*tolerance).map(Mm),
                part_of_length: *part_of_length,
                stretched: *stretched,
                curve_shares: *curve_shares,
                sharpest_between_arcs: sharpest_between_arcs.unwrap_or(180.0).to_radians(),
                across: *across,
                along: *along,
                divides: *divides,
                unrounded: *unrounded,
                cycle: Seconds(*cycle),
                least_cycles: *least_cycles,
                overlaps: *overlaps,
            })
        }
        CornerRules::Slowed { change } => {
            let change = machine.dynamics.corner_change.map_or(*change, |change| change.0);
            Corners::Slowed(Slowing { change: Point::from_element(change / 60.0) })
        }
        CornerRules::Filtered {} => Corners::Filtered,
    }
}

/// How moves meet by a mode of the program.
fn meeting_of(mode: PathMode) -> Meeting {
    match mode {
        PathMode::ExactStop => Meeting::Stop,
        PathMode::ExactPath => Meeting::Exact,
        PathMode::Blending { tolerance, naive } => Meeting::Rounded {
            tolerance: Some(tolerance).filter(|tolerance| tolerance.0 > 0.0),
            merge: naive.unwrap_or(tolerance),
        },
    }
}

/// Makes items of the events of a run. Has to see every event, in order.
#[derive(Debug, Clone)]
pub(crate) struct Items {
    plan: Plan,
    /// How moves meet by the program's mode, and as a smoothing of its own changes that.
    meeting: Meeting,
    smoothing: Option<Mm>,
    /// The axes stop at the end of the block that comes.
    stops_once: bool,
    turns: Spindle,
}

impl Items {
    pub(crate) fn new(plan: &Plan) -> Self {
        Self {
            plan: plan.clone(),
            meeting: Meeting::Rounded { tolerance: None, merge: Mm::ZERO },
            smoothing: None,
            stops_once: false,
            turns: Spindle::Stopped,
        }
    }

    /// How moves meet at the start of a run.
    pub(crate) const fn meeting<T>(&self) -> Item<T> {
        Item::Meeting(self.meeting)
    }

    /// The items of an event that moves no axis.
    pub(crate) fn event<T>(&mut self, step: &Step<'_>, surface: bool, tag: T, mut each: impl FnMut(Item<T>))
    where
        T: Copy,
    {
        let halts = |halt| self.plan.halts_for(halt);
        match step.event {
            Event::PathMode(mode) => {
                self.meeting = meeting_of(*mode);
                each(Item::Meeting(self.effective()));
            }
            Event::ExactStop => self.stops_once = true,
            Event::Smoothing(smoothing) => {
                if let Smoothing { level: None, tolerance: None } = smoothing {
                    self.smoothing = None;
                }
                self.smoothing = smoothing.tolerance.or(self.smoothing);
                each(Item::Meeting(self.effective()));
            }
            Event::ContourControl { on, .. } => {
                if let Some(contour) = self.plan.contour {
                    each(Item::Corners(if *on { contour } else { self.plan.machine.control.corners }));
                }
            }
            Event::Spindle(_) | Event::SpindleSpeed(_) => self.spindle(step, surface, tag, each),
            Event::OrientSpindle { .. } => each(Item::Orient { tag }),
            Event::Coolant { .. } | Event::Chuck(_) | Event::UserCommand { .. } => {
                if halts(Halt::Auxiliary) {
                    each(Item::Halt);
                }
                if self.plan.auxiliary > Seconds::ZERO {
                    each(Item::Pause { seconds: self.plan.auxiliary, auxiliary: true, tag });
                }
            }
            Event::WorkOffset { .. } | Event::Rotation(_) if halts(Halt::WorkOffset) => each(Item::Halt),
            Event::Shift(_) if halts(Halt::Shift) => each(Item::Halt),
            Event::LengthOffset(_) if halts(Halt::ToolOffset) => each(Item::Halt),
            Event::Output { with_move: false, .. } if halts(Halt::Output) => each(Item::Halt),
            Event::Message(_) if halts(Halt::Message) => each(Item::Halt),
            Event::SelectTool(tool) => {
                if halts(Halt::ToolCall) {
                    each(Item::Halt);
                }
                if let Some(tool) = tool {
                    each(Item::Call { pocket: self.pocket(*tool) });
                }
            }
            Event::WaitInput { .. }
            | Event::WaitOrient(_)
            | Event::Stop(_)
            | Event::PalletChange
            | Event::StartChange
            | Event::SetToolNumber(_)
            | Event::BarFeed(_)
            | Event::BarPush(_)
            | Event::BarUnload(_)
            | Event::BarLoad => each(Item::Halt),
            Event::End => {
                each(Item::Halt);
                self.smoothing = None;
                each(Item::Meeting(self.effective()));
            }
            _ => {}
        }
    }

    /// The items of a change of the spindle.
    fn spindle<T>(&mut self, step: &Step<'_>, surface: bool, tag: T, mut each: impl FnMut(Item<T>)) {
        let halt = match step.event {
            Event::Spindle(turns) => {
                self.turns = *turns;
                Halt::Spindle
            }
            _ => Halt::SpindleSpeed,
        };
        if self.plan.halts_for(halt) {
            each(Item::Halt);
        }
        // Under constant surface speed the spindle follows the tool.
        if !surface && step.rpm.is_finite() {
            let speed = match self.turns {
                Spindle::Clockwise => step.rpm,
                Spindle::CounterClockwise => -step.rpm,
                Spindle::Stopped => 0.0,
            };
            each(Item::Spindle { speed: Rpm(speed), tag });
        }
    }

    /// How moves meet by mode and smoothing.
    const fn effective(&self) -> Meeting {
        match (self.meeting, self.smoothing) {
            (Meeting::Rounded { tolerance: None, merge }, Some(smoothing)) => {
                Meeting::Rounded { tolerance: Some(smoothing), merge }
            }
            (meeting, _) => meeting,
        }
    }

    /// A tool change.
    pub(crate) fn change<T>(&self, tool: Option<u32>, tag: T) -> Item<T> {
        Item::Change { pocket: tool.map(|tool| self.pocket(tool)), tag }
    }

    fn pocket(&self, tool: u32) -> u32 {
        self.plan.pockets.get(&tool).copied().unwrap_or(tool)
    }

    /// The items of a movement that takes `asked` at the speed that was asked for.
    pub(crate) fn motion<T: Copy>(
        &mut self,
        step: &Step<'_>,
        tracker: &Tracker,
        motion: &Motion,
        asked: Seconds,
        tag: T,
        mut each: impl FnMut(Item<T>),
    ) {
        if self.stops_once {
            // With the stop the mode ends that it came with.
            self.stops_once = false;
            let mode = self.effective();
            each(Item::Meeting(Meeting::Stop));
            moved(step, tracker, motion, asked, tag, &mut each);
            each(Item::Meeting(mode));
        } else {
            moved(step, tracker, motion, asked, tag, &mut each);
        }
    }
}

/// A movement as the planner takes it: one move, or the chords of an arc in a tilted plane that has no name.
fn moved<T: Copy>(
    step: &Step<'_>,
    tracker: &Tracker,
    motion: &Motion,
    asked: Seconds,
    tag: T,
    each: &mut impl FnMut(Item<T>),
) {
    let rpm = Rpm(if step.rpm.is_finite() { step.rpm } else { 0.0 });
    let drive = match motion.way {
        Way::Rapid => Drive::Rapid,
        Way::Feed => Drive::Feed,
        Way::Probe => Drive::Probe,
        Way::Thread => Drive::Thread(rpm),
        Way::Tap(scale) => Drive::Tap(Rpm(rpm.0 * scale)),
    };
    if step.swings && [&motion.machine_from, &motion.machine].into_iter().all(is_known) {
        let [from, to] = [&motion.machine_from, &motion.machine].map(point);
        let whole = Move { drive, from, to, arc: None, asked, tag };
        let arc = motion.arc.filter(|arc| arc.is_known() && arc.rise().is_known());
        let Some((arc, frame)) = arc.zip(step.swung_arc) else { return each(Item::Move(whole)) };
        // Where the rotary axes turn on the way, the frame of its end is right there alone.
        let off = (motion.machine_from - motion.from.with_xyz(frame.apply(motion.from.xyz()))).xyz();
        let place = |point: [Mm; 3], done: f64| {
            let mut stands = frame.apply(point);
            for (axis, off) in stands.iter_mut().zip(off) {
                axis.0 += off.0 * (1.0 - done);
            }
            stands
        };
        return by_chords(&arc, whole, place, each);
    }
    let upright = tracker.is_upright();
    let turned = |position: &Position| if upright { *position } else { tracker.turned(position) };
    let [from, mut to] = [turned(&motion.from), turned(&motion.to)].map(|position| point(&position));
    for (slot, (before, way)) in to.iter_mut().zip(motion.from.values().iter().zip(motion.way_known.values()))
    {
        // From a place that is not known, which is at zero here.
        if before.is_nan() && !way.is_nan() {
            *slot = *way;
        }
    }
    let arc = motion.arc.filter(|arc| arc.is_known() && arc.rise().is_known() && tracker.still().is_none());
    let whole = Move { drive, from, to, arc: None, asked, tag };
    let Some(arc) = arc else { return each(Item::Move(whole)) };
    if upright {
        return each(Item::Move(Move { arc: Some(arc), ..whole }));
    }
    if arc.plane() == Plane::Xy {
        let [first, second, _] = [arc.centre().0, arc.centre().1, Mm::ZERO];
        let centre = tracker.turned(&motion.to.with_xyz([first, second, Mm::ZERO])).xyz();
        let [x, y, _] = centre;
        let [start, end] = [turned(&motion.from), turned(&motion.to)].map(|position| position.xyz());
        let arc = Arc::from_parts(Plane::Xy, start, end, (x, y), arc.sweep());
        return each(Item::Move(Move { arc: Some(arc), ..whole }));
    }
    // An arc in a plane other than the main ones.
    let place = |point: [Mm; 3], _: f64| turned(&motion.to.with_xyz(point)).xyz();
    by_chords(&arc, whole, place, each);
}

/// Straight moves in place of an arc; `place` says where the axes are for a point of it and the share of its way.
fn by_chords<T: Copy>(
    arc: &Arc,
    whole: Move<T>,
    place: impl Fn([Mm; 3], f64) -> [Mm; 3],
    each: &mut impl FnMut(Item<T>),
) {
    let Move { from, to, asked, .. } = whole;
    #[expect(clippy::cast_sign_loss, reason = "the angle is not negative and the count small")]
    let count = (arc.sweep().abs() / CHORD).ceil().clamp(1.0, 10_000.0) as u32;
    let mut begin = from;
    for (index, end) in (1..=count).zip(arc.chords(count)) {
        let done = f64::from(index) / f64::from(count);
        let mut next = from + (to - from) * done;
        for (slot, value) in next.iter_mut().zip(place(end, done)) {
            *slot = value.0;
        }
        each(Item::Move(Move { from: begin, to: next, asked: asked / f64::from(count), ..whole }));
        begin = next;
    }
}

/// Are X, Y and Z known?
fn is_known(position: &Position) -> bool {
    position.xyz().iter().all(|coordinate| coordinate.is_known())
}

/// A position as a point; an unknown coordinate stays at zero.
fn point(position: &Position) -> Point {
    Point::from(position.values().map(|value| if value.is_nan() { 0.0 } else { value }))
}
