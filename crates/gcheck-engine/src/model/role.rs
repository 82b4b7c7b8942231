//! The modal groups that the engine follows.
//!
//! Knows: which effect switches which of them. Must not know: codes of a control.

use gcheck_controls::Effect;

/// What a code's modal group decides, where the engine follows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the names are those of the modal groups")]
pub enum Role {
    Motion,
    Cycle,
    Plane,
    Distance,
    ArcCentre,
    FeedMode,
    Units,
    Compensation,
    Length,
    ReturnLevel,
    WorkOffset,
    PathControl,
    SpindleMode,
    Diameter,
    Scaling,
    Rotation,
    Mirror,
    Polar,
    Cylinder,
    PolarInterpolation,
    DynamicOffset,
    TiltedPlane,
    MacroModal,
}

impl Role {
    /// How many roles there are.
    pub const COUNT: usize = 23;

    /// All roles.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Motion,
        Self::Cycle,
        Self::Plane,
        Self::Distance,
        Self::ArcCentre,
        Self::FeedMode,
        Self::Units,
        Self::Compensation,
        Self::Length,
        Self::ReturnLevel,
        Self::WorkOffset,
        Self::PathControl,
        Self::SpindleMode,
        Self::Diameter,
        Self::Scaling,
        Self::Rotation,
        Self::Mirror,
        Self::Polar,
        Self::Cylinder,
        Self::PolarInterpolation,
        Self::DynamicOffset,
        Self::TiltedPlane,
        Self::MacroModal,
    ];

    /// The role that an effect belongs to: which mode it switches.
    pub const fn of(effect: Effect) -> Option<Self> {
        use Effect as E;
        Some(match effect {
            E::Rapid
            | E::Linear
            | E::ArcClockwise
            | E::ArcCounterClockwise
            | E::SplineCubic
            | E::SplineQuadratic
            | E::NurbsOpen
            | E::Thread
            | E::RigidTap
            | E::ProbeToward
            | E::ProbeTowardOptional
            | E::ProbeAway
            | E::ProbeAwayOptional
            | E::TurningPass
            | E::ThreadingPass
            | E::FacingPass => Self::Motion,
            E::CycleDrill
            | E::CycleDrillDwell
            | E::CyclePeck
            | E::CycleChipBreak
            | E::CycleTap
            | E::CycleLeftTap
            | E::CycleBoreFeedOut
            | E::CycleBoreStop
            | E::CycleBackBore
            | E::CycleBoreManual
            | E::CycleBoreDwellManual
            | E::CycleBoreDwell
            | E::CycleFineBore
            | E::CycleAlongTool(_)
            | E::CycleCancel => Self::Cycle,
            E::PlaneXy | E::PlaneZx | E::PlaneYz | E::PlaneSecondary => Self::Plane,
            E::Absolute | E::Incremental => Self::Distance,
            E::ArcCentreAbsolute | E::ArcCentreIncremental => Self::ArcCentre,
            E::FeedInverseTime | E::FeedPerMinute | E::FeedPerRevolution => Self::FeedMode,
            E::Inch | E::Millimetre => Self::Units,
            E::CompensationOff
            | E::CompensationLeft
            | E::CompensationRight
            | E::CompensationLeftByDiameter
            | E::CompensationRightByDiameter
            | E::CompensationVector => Self::Compensation,
            E::LengthOff
            | E::LengthPlus
            | E::LengthMinus
            | E::LengthFromBlock
            | E::LengthAdd
            | E::LengthFiveAxis
            | E::ToolCentrePoint => Self::Length,
            E::ReturnToInitial | E::ReturnToR => Self::ReturnLevel,
            E::WorkOffset(_) | E::WorkOffsetByP(_) => Self::WorkOffset,
            E::ExactPath | E::ExactStop | E::PathBlending => Self::PathControl,
            E::SurfaceSpeed | E::ConstantSpeed => Self::SpindleMode,
            E::DiameterOn | E::DiameterOff => Self::Diameter,
            E::ScalingOn | E::ScalingOff => Self::Scaling,
            E::RotationOn | E::RotationOff => Self::Rotation,
            E::MirrorOn | E::MirrorOff => Self::Mirror,
            E::PolarOn | E::PolarOff => Self::Polar,
            E::CylinderMapping => Self::Cylinder,
            E::PolarInterpolationOn | E::PolarInterpolationOff => Self::PolarInterpolation,
            E::DynamicOffsetOn | E::DynamicOffsetOff => Self::DynamicOffset,
            E::TiltedPlaneOn | E::TiltedPlaneOff => Self::TiltedPlane,
            E::MacroModal | E::MacroModalOff => Self::MacroModal,
            _ => return None,
        })
    }

    /// A small number usable as an index.
    pub const fn index(self) -> usize {
        self as usize
    }
}
