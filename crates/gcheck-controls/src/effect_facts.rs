//! What machining says of effects: their groups, and facts that several crates ask.
//!
//! Knows: which effects belong together. Must not know: codes, states, any rule.

use crate::execution::Effect;

/// Effects of one kind, by the name that machining has for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names are the field's own terms; those that are not carry a comment")]
pub enum EffectGroup {
    /// Nothing that the engine follows.
    None,
    Rapid,
    Linear,
    Arc,
    Curve,
    Dwell,
    /// A thread cut by one code: a move with its lead, or all passes.
    Thread,
    /// A thread cut by one pass of a cycle.
    ThreadingPass,
    /// One pass of a turning cycle that cuts no thread.
    TurningPass,
    RigidTap,
    /// Taps where the tool is.
    TapHere,
    ProbingMove,
    Skip,
    Measurement,
    /// What an earlier touch of the probe was.
    Touch,
    DrillingCycle,
    TappingCycle,
    BoringCycle,
    CycleAlongTool,
    CycleCancel,
    ProfileCycle,
    GroovingCycle,
    Pocket,
    HolePattern,
    Engraving,
    BarFeed,
    /// To a reference position and back from it.
    Reference,
    StoreReference,
    MachineCoordinates,
    WriteOffsets,
    /// Shifts the coordinates of the program.
    Shift,
    /// Ends, suspends or restores such a shift.
    ShiftEnd,
    WorkOffset,
    Plane,
    Distance,
    ArcCentre,
    FeedMode,
    Units,
    DiameterMode,
    CompensationOff,
    /// Cutter compensation, on either side.
    Compensation,
    CompensationVector,
    LengthOff,
    Length,
    ReturnLevel,
    PathMode,
    /// How exactly and how far ahead the control follows a path.
    Contour,
    SpindleMode,
    /// Scaling, rotation, mirror.
    Transformation,
    Polar,
    /// A flat drawing on a cylinder or a face.
    Mapping,
    /// Planes and offsets that follow rotary axes.
    TiltedFrame,
    Call,
    /// Calls that every block makes, until they are off.
    ModalCall,
    Return,
    Jump,
    Stop,
    ProgramEnd,
    /// Modes kept and restored.
    SavedModes,
    /// A program of the builder or of the shop.
    UserCommand,
    AskOperator,
    SpindleStart,
    /// Stops the spindle, at any angle or at one.
    SpindleStop,
    LiveTool,
    ToolChange,
    /// Which tool is meant, without a change.
    ToolNumber,
    CoolantOn,
    CoolantOff,
    Override,
    OutputWithMove,
    /// Sets an output at once, or waits for an input.
    Signal,
    Chuck,
}

impl Effect {
    /// The group of an effect. A new effect does not compile before it has one.
    // A table, one row for each group.
    #[rustfmt::skip]
    pub const fn group(self) -> EffectGroup {
        use Effect as E;
        use EffectGroup as G;
        match self {
            E::None => G::None,
            E::Rapid => G::Rapid,
            E::Linear => G::Linear,
            E::ArcClockwise | E::ArcCounterClockwise => G::Arc,
            E::SplineCubic | E::SplineQuadratic | E::NurbsOpen | E::NurbsClose => G::Curve,
            E::Dwell => G::Dwell,
            E::Thread | E::ThreadCycle => G::Thread,
            E::ThreadingPass => G::ThreadingPass,
            E::TurningPass | E::FacingPass => G::TurningPass,
            E::RigidTap => G::RigidTap,
            E::TapHere | E::LeftTapHere => G::TapHere,
            E::ProbeToward | E::ProbeTowardOptional | E::ProbeAway | E::ProbeAwayOptional => G::ProbingMove,
            E::Skip => G::Skip,
            E::ProbeDiameter | E::ProbeOffset | E::ProbeLength | E::ProbeCentre => G::Measurement,
            E::KeepTouch | E::AlarmIfTouched | E::AlarmIfNotTouched => G::Touch,
            E::CycleDrill | E::CycleDrillDwell | E::CyclePeck | E::CycleChipBreak => G::DrillingCycle,
            E::CycleTap | E::CycleLeftTap => G::TappingCycle,
            E::CycleBoreFeedOut | E::CycleBoreStop | E::CycleBackBore | E::CycleBoreManual
            | E::CycleBoreDwellManual | E::CycleBoreDwell | E::CycleFineBore => G::BoringCycle,
            E::CycleAlongTool(_) => G::CycleAlongTool,
            E::CycleCancel => G::CycleCancel,
            E::FinishProfile | E::RoughAlongZ | E::RoughAlongX | E::RepeatPattern => G::ProfileCycle,
            E::GrooveFace | E::GrooveDiameter => G::GroovingCycle,
            E::CircularPocketClockwise | E::CircularPocketCounterClockwise | E::GeneralPocket => G::Pocket,
            E::BoltCircle | E::BoltArc | E::BoltLine => G::HolePattern,
            E::Engrave => G::Engraving,
            E::BarFeed => G::BarFeed,
            E::ReturnReference(_) | E::ReturnFromReference => G::Reference,
            E::StoreReference(_) => G::StoreReference,
            E::MachineCoordinates => G::MachineCoordinates,
            E::WriteOffsets => G::WriteOffsets,
            E::LocalShift | E::SetPosition | E::SpeedLimitOrSetPosition => G::Shift,
            E::ClearShift | E::SuspendShift | E::RestoreShift => G::ShiftEnd,
            E::WorkOffset(_) | E::WorkOffsetByP(_) => G::WorkOffset,
            E::PlaneXy | E::PlaneZx | E::PlaneYz | E::PlaneSecondary => G::Plane,
            E::Absolute | E::Incremental => G::Distance,
            E::ArcCentreAbsolute | E::ArcCentreIncremental => G::ArcCentre,
            E::FeedInverseTime | E::FeedPerMinute | E::FeedPerRevolution => G::FeedMode,
            E::Inch | E::Millimetre => G::Units,
            E::DiameterOn | E::DiameterOff => G::DiameterMode,
            E::CompensationOff => G::CompensationOff,
            E::CompensationLeft | E::CompensationRight | E::CompensationLeftByDiameter | E::CompensationRightByDiameter => G::Compensation,
            E::CompensationVector => G::CompensationVector,
            E::LengthOff => G::LengthOff,
            E::LengthPlus | E::LengthMinus | E::LengthFromBlock | E::LengthAdd | E::LengthFiveAxis | E::ToolCentrePoint => G::Length,
            E::ReturnToInitial | E::ReturnToR => G::ReturnLevel,
            E::ExactPath | E::ExactStop | E::PathBlending | E::ExactStopOnce => G::PathMode,
            E::Smoothing | E::ContourControl | E::LookAheadControl => G::Contour,
            E::SurfaceSpeed | E::ConstantSpeed => G::SpindleMode,
            E::ScalingOn | E::ScalingOff | E::RotationOn | E::RotationOff | E::MirrorOn | E::MirrorOff => G::Transformation,
            E::PolarOn | E::PolarOff => G::Polar,
            E::CylinderMapping | E::PolarInterpolationOn | E::PolarInterpolationOff => G::Mapping,
            E::DynamicOffsetOn | E::DynamicOffsetOff | E::TiltedPlaneOn | E::TiltedPlaneOff | E::SquareToPlane => G::TiltedFrame,
            E::MacroCall | E::CallProgram | E::CallLocal => G::Call,
            E::MacroModal | E::MacroModalOff => G::ModalCall,
            E::Return => G::Return,
            E::JumpUnlessInput => G::Jump,
            E::Stop | E::OptionalStop | E::PalletStop => G::Stop,
            E::ProgramEnd | E::ProgramEndWithPallet => G::ProgramEnd,
            E::SaveModes | E::ForgetModes | E::RestoreModes | E::SaveModesUntilReturn => G::SavedModes,
            E::UserCommand => G::UserCommand,
            E::AskOperator => G::AskOperator,
            E::SpindleClockwise | E::SpindleCounterClockwise | E::SpindleClockwiseWithCoolant | E::SpindleCounterClockwiseWithCoolant => G::SpindleStart,
            E::SpindleStop | E::SpindleOrient => G::SpindleStop,
            E::LiveToolOn | E::LiveToolOff => G::LiveTool,
            E::ToolChange => G::ToolChange,
            E::SetToolNumber | E::TurnCarousel => G::ToolNumber,
            E::MistOn | E::FloodOn | E::ThroughCoolantOn => G::CoolantOn,
            E::ThroughCoolantOff | E::CoolantOff => G::CoolantOff,
            E::OverridesOn | E::OverridesOff | E::FeedOverride | E::SpeedOverride | E::AdaptiveFeed | E::FeedStopInput => G::Override,
            E::OutputOnWithMove | E::OutputOffWithMove | E::AnalogOutputWithMove => G::OutputWithMove,
            E::OutputOn | E::OutputOff | E::AnalogOutput | E::WaitForInput => G::Signal,
            E::ChuckClamp | E::ChuckUnclamp | E::SecondChuckClamp | E::SecondChuckUnclamp => G::Chuck,
        }
    }

    /// Circular interpolation, either way round.
    pub const fn is_arc(self) -> bool {
        matches!(self.group(), EffectGroup::Arc)
    }

    /// A move of the motion mode whose only word for its shape is its end or its centre: rapid, straight, circular.
    pub const fn is_plain_move(self) -> bool {
        matches!(self.group(), EffectGroup::Rapid | EffectGroup::Linear | EffectGroup::Arc)
    }

    /// Measures by a touch: a probing move, a skip, a measurement of its own.
    pub const fn measures(self) -> bool {
        matches!(self.group(), EffectGroup::ProbingMove | EffectGroup::Skip | EffectGroup::Measurement)
    }

    /// A move toward or away from the work until the probe changes, which stays the motion mode (`G38`).
    pub const fn is_probing_move(self) -> bool {
        matches!(self.group(), EffectGroup::ProbingMove)
    }

    /// A move of the motion mode along a straight line: rapid or at the feed (`G0`, `G1`).
    pub const fn is_straight_move(self) -> bool {
        matches!(self.group(), EffectGroup::Rapid | EffectGroup::Linear)
    }

    /// Moves toward the work until the probe touches; with an alarm without a touch or not (`G38.2`, `G38.3`).
    pub const fn probes_toward(self) -> bool {
        matches!(self, Self::ProbeToward | Self::ProbeTowardOptional)
    }

    /// A canned cycle that taps, either hand (`G84`, `G74`).
    pub const fn is_tapping_cycle(self) -> bool {
        matches!(self.group(), EffectGroup::TappingCycle)
    }

    /// Drills in pecks of the depth of `Q`, out of the hole or up to break the chip (`G83`, `G73`).
    pub const fn pecks(self) -> bool {
        matches!(self, Self::CyclePeck | Self::CycleChipBreak)
    }

    /// Bores with a bar that a stopped spindle shifts off the wall (`G76`, `G87`).
    pub const fn shifts_boring_bar(self) -> bool {
        matches!(self, Self::CycleFineBore | Self::CycleBackBore)
    }

    /// Cuts a thread with a point: a move with its lead, one pass, or all of them.
    pub const fn cuts_thread(self) -> bool {
        matches!(self.group(), EffectGroup::Thread | EffectGroup::ThreadingPass)
    }

    /// One pass of a turning cycle that stays on (`G90`, `G92`, `G94` of lathes).
    pub const fn is_turning_pass(self) -> bool {
        matches!(self.group(), EffectGroup::TurningPass | EffectGroup::ThreadingPass)
    }

    /// A canned cycle at each point of a pattern (`G70` to `G72` of mills).
    pub const fn is_hole_pattern(self) -> bool {
        matches!(self.group(), EffectGroup::HolePattern)
    }

    /// Cuts a profile that is written elsewhere in the program (`G70` to `G73` of lathes).
    pub const fn cuts_profile(self) -> bool {
        matches!(self.group(), EffectGroup::ProfileCycle)
    }

    /// Goes to a place of the machine, whatever the coordinates of the part are: `G53`, `G28`, `G30`.
    pub const fn goes_to_machine_place(self) -> bool {
        matches!(self, Self::MachineCoordinates | Self::ReturnReference(_))
    }

    /// Goes to a place of the machine, or back from a reference position.
    pub const fn moves_by_machine_places(self) -> bool {
        matches!(self.group(), EffectGroup::MachineCoordinates | EffectGroup::Reference)
    }

    /// Shifts the coordinates of the program (`G52`, `G92`).
    pub const fn shifts_coordinates(self) -> bool {
        matches!(self.group(), EffectGroup::Shift)
    }

    /// Shifts the coordinates of the program, or ends such a shift.
    pub const fn is_about_shifts(self) -> bool {
        matches!(self.group(), EffectGroup::Shift | EffectGroup::ShiftEnd)
    }

    /// Offsets the path to the left or right by the size of the cutter (`G41`, `G42`).
    pub const fn offsets_path(self) -> bool {
        matches!(self.group(), EffectGroup::Compensation)
    }

    /// Cutter compensation whose size is that of a numbered offset, not a diameter of the block (`G41`, `G42`).
    pub const fn offsets_path_by_number(self) -> bool {
        matches!(self, Self::CompensationLeft | Self::CompensationRight)
    }

    /// Says how far the path may leave the corners of the program (`G64`, `G187`).
    pub const fn sets_path_tolerance(self) -> bool {
        matches!(self, Self::PathBlending | Self::Smoothing)
    }

    /// Takes the length of the tool from its offset, along Z or about the tip (`G43`, `G44`, `G43.4`).
    pub const fn takes_tool_length(self) -> bool {
        matches!(self, Self::LengthPlus | Self::LengthMinus | Self::ToolCentrePoint)
    }

    /// Tool length compensation along the tool axis (`G43`, `G44`).
    pub const fn is_length_compensation(self) -> bool {
        matches!(self, Self::LengthPlus | Self::LengthMinus)
    }

    /// Stops the program until the operator starts it again (`M0`, `M1`).
    pub const fn stops_program(self) -> bool {
        matches!(self.group(), EffectGroup::Stop)
    }

    /// Calls another program or subprogram where it is written.
    pub const fn calls(self) -> bool {
        matches!(self.group(), EffectGroup::Call)
    }

    /// Calls a macro, once or after every move: the words of its block are arguments (`G65`, `G66`).
    pub const fn calls_macro(self) -> bool {
        matches!(self, Self::MacroCall | Self::MacroModal)
    }

    /// Ends the program (`M30`, `M2`).
    pub const fn ends_program(self) -> bool {
        matches!(self.group(), EffectGroup::ProgramEnd)
    }

    /// Goes back to the caller, or ends the program.
    pub const fn leaves_program(self) -> bool {
        matches!(self.group(), EffectGroup::Return | EffectGroup::ProgramEnd)
    }

    /// Starts the spindle, either way round; with coolant too.
    pub const fn starts_spindle(self) -> bool {
        matches!(self.group(), EffectGroup::SpindleStart)
    }

    /// Stops the spindle, at any angle or at one (`M5`, `M19`).
    pub const fn stops_spindle(self) -> bool {
        matches!(self.group(), EffectGroup::SpindleStop)
    }

    /// Switches coolant on, whichever; a start of the spindle with coolant is not one of these.
    pub const fn starts_coolant(self) -> bool {
        matches!(self.group(), EffectGroup::CoolantOn)
    }

    /// Switches coolant on or off.
    pub const fn switches_coolant(self) -> bool {
        matches!(self.group(), EffectGroup::CoolantOn | EffectGroup::CoolantOff)
    }

    /// Switches an output on, at once or with the next move (`M64`, `M62`).
    pub const fn switches_output_on(self) -> bool {
        matches!(self, Self::OutputOn | Self::OutputOnWithMove)
    }

    /// Sets an output together with the next move.
    pub const fn is_output_with_move(self) -> bool {
        matches!(self.group(), EffectGroup::OutputWithMove)
    }

    /// An operation of its own, to which the axis words of its block belong, and not to the motion mode.
    pub const fn owns_axes(self) -> bool {
        use EffectGroup as G;
        match self.group() {
            G::ProfileCycle
            | G::GroovingCycle
            | G::Pocket
            | G::HolePattern
            | G::Engraving
            | G::BarFeed
            | G::Skip
            | G::Measurement
            | G::TapHere
            | G::Reference
            | G::WriteOffsets => true,
            _ => matches!(
                self,
                Self::ThreadCycle
                    | Self::LocalShift
                    | Self::SetPosition
                    | Self::ScalingOn
                    | Self::RotationOn
                    | Self::MirrorOn
                    | Self::MirrorOff
                    | Self::CylinderMapping
                    | Self::MacroCall
                    | Self::MacroModal
            ),
        }
    }
}
