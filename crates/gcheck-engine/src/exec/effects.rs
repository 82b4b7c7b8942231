//! The table that ties effects to their handlers, a function for each group of codes.
//!
//! Knows: which handler an effect has. Must not know: what a handler does.
//!
//! A group answers whether the effect is one of its own; effects of no group are modes that only later blocks read, and
//! interpolation, which happens with the block's axis words.

mod along_tool;
pub(crate) mod bar;
pub(crate) mod compensation;
mod cycle;
mod cylinder;
mod lathe;
mod modes;
mod offsets;
mod operation;
mod probe;
mod program_end;
mod reference;
mod spindle;
mod tool_shift;
mod transform;

use gcheck_controls::{CodeIx, Effect as E, Letter};
use gcheck_geometry::Plane;
use gcheck_program::{Place, Word};

use crate::assumption::Assumption;
use crate::eval::value::{Domain, Truth};
use crate::event::{Coolant, Event, FeedMode, Override, PathMode, Spindle, Stop, Units};
use crate::exec::context::{Count, Ending, Executor, Flow, Step};
use crate::fault::Fault;
use crate::lattice::Perhaps;
use crate::observer::Observer;
use crate::state::{ModalCalls, State};

/// A code, where it is written.
#[derive(Clone, Copy)]
pub(super) struct CodeInBlock<'b> {
    pub(super) effect: E,
    pub(super) ix: CodeIx,
    pub(super) place: &'b Place,
    pub(super) words: &'b [Word],
}

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// What a code does besides switching its mode.
    pub(super) fn effect(&mut self, code: CodeInBlock<'_>, state: &mut State<D>) -> Step {
        let _is_of_a_group = self.plane_or_feed_code(code.effect, state)
            || self.tool_code(code.effect, state)?
            || self.offset_code(code, state)?
            || self.transformation_code(code, state)?
            || self.spindle_code(code.effect, state)?
            || self.coolant_code(code.effect, state)?
            || self.machining_code(code, state)?
            || self.call_or_message_code(code, state)?
            || self.stop_or_end_code(code.effect, state)?
            || self.signal_code(code.effect, state)?;
        Ok(())
    }

    /// Planes, units, feed modes, and how moves meet.
    fn plane_or_feed_code(&mut self, effect: E, state: &mut State<D>) -> bool {
        match effect {
            E::PlaneXy => self.emit(state, Event::Plane(Plane::Xy)),
            E::PlaneZx => self.emit(state, Event::Plane(Plane::Zx)),
            E::PlaneYz => self.emit(state, Event::Plane(Plane::Yz)),
            E::PlaneSecondary => self.emit(state, Event::SecondaryPlane),
            E::Inch => self.emit(state, Event::Units(Units::Inch)),
            E::Millimetre => self.emit(state, Event::Units(Units::Mm)),
            E::FeedInverseTime => self.feed_mode(FeedMode::InverseTime, state),
            E::FeedPerMinute => self.feed_mode(FeedMode::PerMinute, state),
            E::FeedPerRevolution => self.feed_mode(FeedMode::PerRevolution, state),
            E::ExactPath => self.path_mode(PathMode::ExactPath, state),
            E::ExactStop => self.path_mode(PathMode::ExactStop, state),
            E::PathBlending => self.blending(state),
            E::ExactStopOnce => self.emit(state, Event::ExactStop),
            E::Smoothing => self.smoothing(state),
            E::ContourControl => self.contour_control(Letter::of('Q'), Some(Letter::of('R')), state),
            E::LookAheadControl => self.contour_control(Letter::of('P'), None, state),
            E::OverridesOn | E::OverridesOff => {
                let on = effect == E::OverridesOn;
                state.feed.overridable = on.into();
                state.spindle.overridable = on.into();
                state.cycle.feed_override_on = Truth::False;
                self.emit(state, Event::Override { kind: Override::Feed, on });
                self.emit(state, Event::Override { kind: Override::Speed, on });
            }
            E::FeedOverride | E::SpeedOverride | E::AdaptiveFeed | E::FeedStopInput => {
                self.switch_override(effect, state);
            }
            _ => return false,
        }
        true
    }

    /// The tool, its length, and cutter compensation.
    fn tool_code(&mut self, effect: E, state: &mut State<D>) -> Step<bool> {
        match effect {
            E::CompensationOff => self.compensation_off(state)?,
            E::CompensationLeft
            | E::CompensationRight
            | E::CompensationLeftByDiameter
            | E::CompensationRightByDiameter
            | E::CompensationVector => self.compensation_on(effect, state)?,
            E::LengthOff
            | E::LengthPlus
            | E::LengthMinus
            | E::LengthFromBlock
            | E::LengthAdd
            | E::LengthFiveAxis
            | E::ToolCentrePoint => self.length_code(effect, state)?,
            E::ToolChange => self.tool_change(state)?,
            E::SetToolNumber => self.set_tool_number(state)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Where coordinates count from: work offsets, shifts, reference points, and the tables that hold them.
    fn offset_code(&mut self, code: CodeInBlock<'_>, state: &mut State<D>) -> Step<bool> {
        match code.effect {
            E::WorkOffset(number) => self.select_work_offset(Some(number), state),
            E::WorkOffsetByP(first) => {
                let number = match self.count(Letter::of('P'))? {
                    Some(Count::Known(p)) if p > 0 => {
                        u16::try_from(p).ok().and_then(|p| first.checked_add(p - 1))
                    }
                    Some(Count::Known(_)) => return Err(Fault::WordRange(Letter::of('P'))),
                    Some(Count::Unknown) => None,
                    None => return Err(Fault::MissingWord(Letter::of('P'))),
                };
                self.select_work_offset(number, state);
            }
            E::WriteOffsets => self.write_offsets(code.ix, state)?,
            E::LocalShift => self.local_shift(state)?,
            E::SetPosition => self.set_position(state)?,
            E::SpeedLimitOrSetPosition => {
                if self.words.has(Letter::of('S')) {
                    self.limit_speed(state);
                } else {
                    self.set_position(state)?;
                }
            }
            E::ClearShift => self.clear_shift(state, false),
            E::SuspendShift => self.clear_shift(state, true),
            E::RestoreShift => self.restore_shift(state),
            E::ReturnReference(number) => self.return_reference(number, state)?,
            E::ReturnFromReference => self.return_from_reference(state)?,
            E::StoreReference(number) => self.store_reference(number, state),
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Transformations of the coordinates: scaling, rotation, mirror, planes and cylinders that the work is on.
    fn transformation_code(&mut self, code: CodeInBlock<'_>, state: &mut State<D>) -> Step<bool> {
        let CodeInBlock { effect, ix, .. } = code;
        match effect {
            E::ScalingOn | E::ScalingOff | E::RotationOn | E::RotationOff | E::MirrorOn | E::MirrorOff => {
                self.transform_code(effect, state)?;
                if effect == E::RotationOff {
                    self.end_tilted_plane(ix, state);
                }
            }
            E::CylinderMapping => self.cylinder(ix, state)?,
            E::PolarInterpolationOn | E::PolarInterpolationOff => {
                self.polar_interpolation(ix, effect == E::PolarInterpolationOn, state)?;
            }
            E::DynamicOffsetOn => self.assume_code_unless_described(ix),
            E::TiltedPlaneOn | E::TiltedPlaneOff => {
                self.tilted_plane(ix, effect == E::TiltedPlaneOn, state);
            }
            E::SquareToPlane => self.turn_square(ix, state),
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// The spindle and live tools.
    fn spindle_code(&mut self, effect: E, state: &mut State<D>) -> Step<bool> {
        match effect {
            E::SurfaceSpeed | E::ConstantSpeed => self.spindle_mode(effect, state)?,
            E::SpindleClockwise => self.spindle(Spindle::Clockwise, state)?,
            E::SpindleCounterClockwise => self.spindle(Spindle::CounterClockwise, state)?,
            E::SpindleClockwiseWithCoolant => {
                self.spindle(Spindle::Clockwise, state)?;
                self.coolant(Coolant::Flood, true, state);
            }
            E::SpindleCounterClockwiseWithCoolant => {
                self.spindle(Spindle::CounterClockwise, state)?;
                self.coolant(Coolant::Flood, true, state);
            }
            E::SpindleStop => self.spindle(Spindle::Stopped, state)?,
            E::SpindleOrient => self.orient(state)?,
            E::LiveToolOn => state.spindle.live_tool = Truth::True,
            E::LiveToolOff => state.spindle.live_tool = Truth::False,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Coolant.
    fn coolant_code(&mut self, effect: E, state: &mut State<D>) -> Step<bool> {
        match effect {
            E::MistOn => self.coolant(Coolant::Mist, true, state),
            E::FloodOn => self.coolant(Coolant::Flood, true, state),
            E::ThroughCoolantOn => self.coolant(Coolant::Through, true, state),
            E::ThroughCoolantOff => {
                if self.model.semantics().through_off_stops_spindle
                    && state.spindle() != Some(Spindle::Stopped)
                {
                    self.spindle(Spindle::Stopped, state)?;
                }
                self.coolant(Coolant::Through, false, state);
            }
            E::CoolantOff => {
                self.coolant(Coolant::Mist, false, state);
                self.coolant(Coolant::Flood, false, state);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// What a block does with tool, probe or bar by itself: dwells, taps, cycles of one block, measurements.
    fn machining_code(&mut self, code: CodeInBlock<'_>, state: &mut State<D>) -> Step<bool> {
        let CodeInBlock { effect, ix, words, .. } = code;
        match effect {
            E::Dwell => self.dwell(state)?,
            E::TapHere | E::LeftTapHere => self.tap_here(effect == E::TapHere, state)?,
            E::Skip => self.skip_move(state)?,
            E::ProbeDiameter | E::ProbeLength | E::ProbeOffset | E::ProbeCentre => {
                self.measure(effect, state)?;
            }
            E::KeepTouch => state.probe.kept = state.touched(),
            E::FinishProfile | E::RoughAlongZ | E::RoughAlongX | E::RepeatPattern => {
                self.profile_cycle(effect, ix, state)?;
            }
            E::GrooveFace | E::GrooveDiameter => self.groove_cycle(effect, state)?,
            E::ThreadCycle => self.thread_cycle(state)?,
            E::CircularPocketClockwise | E::CircularPocketCounterClockwise => {
                self.circular_pocket(effect, state)?;
            }
            E::GeneralPocket => self.general_pocket(state)?,
            E::BoltCircle | E::BoltArc | E::BoltLine => self.bolt_pattern(effect, state)?,
            E::Engrave => self.engrave(ix, state)?,
            E::BarFeed => self.bar_feed(ix, words, state)?,
            E::NurbsClose => self.nurbs_close(state)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Calls with what they keep, jumps, and words to the operator.
    fn call_or_message_code(&mut self, code: CodeInBlock<'_>, state: &mut State<D>) -> Step<bool> {
        let CodeInBlock { effect, ix, place, words } = code;
        match effect {
            E::MacroCall | E::MacroModal => self.macro_call(effect, ix, place, words, state)?,
            E::MacroModalOff => state.calls.modal = ModalCalls::off(),
            E::CallProgram | E::CallLocal => self.call_code(effect, state)?,
            E::Return => {
                let label = self.words.get(Letter::of('P'));
                self.flow = Some(Flow::Return { label });
            }
            E::JumpUnlessInput => self.jump_unless_input(state)?,
            E::SaveModes | E::SaveModesUntilReturn => {
                self.save_modes(effect == E::SaveModesUntilReturn, state);
            }
            E::ForgetModes => {
                if let Some(kept) = state.calls.kept_mut() {
                    kept.saved = Perhaps::No;
                }
            }
            E::RestoreModes => self.restore_modes(state)?,
            E::UserCommand => self.user_command(ix, state),
            E::AskOperator => self.ask_operator(state)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Stops and ends of the program.
    fn stop_or_end_code(&mut self, effect: E, state: &mut State<D>) -> Step<bool> {
        match effect {
            E::Stop => {
                self.flush_compensation(state)?;
                self.switch_off_at_stop(false, state)?;
                self.emit(state, Event::Stop(Stop::Program));
            }
            E::OptionalStop => {
                if !self.options.optional_stop {
                    self.assumptions.insert(Assumption::OptionalStop);
                }
                self.flush_compensation(state)?;
                self.switch_off_at_stop(true, state)?;
                self.emit(state, Event::Stop(Stop::Optional));
            }
            E::PalletStop => {
                self.flush_compensation(state)?;
                self.emit(state, Event::PalletChange);
                self.emit(state, Event::Stop(Stop::Pallet));
            }
            E::ProgramEnd | E::ProgramEndWithPallet => {
                self.end_program(effect == E::ProgramEndWithPallet, state)?;
                self.flow = Some(Flow::End(Ending::Program));
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Signals to the machine, and the chuck.
    fn signal_code(&mut self, effect: E, state: &mut State<D>) -> Step<bool> {
        match effect {
            E::OutputOnWithMove | E::OutputOffWithMove | E::OutputOn | E::OutputOff => {
                self.digital_output(effect, state)?;
            }
            E::AnalogOutput | E::AnalogOutputWithMove => self.analog_output(effect, state)?,
            E::WaitForInput => self.wait_for_input(state)?,
            E::ChuckClamp => self.chuck(true, state),
            E::ChuckUnclamp => self.chuck(false, state),
            _ => return Ok(false),
        }
        Ok(true)
    }
}
