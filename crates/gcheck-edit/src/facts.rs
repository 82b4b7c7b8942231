//! The modes that decide what the words of a block mean.
//!
//! Knows: which modes those are. Must not know: words.

use gcheck_controls::{CodeIx, Effect};
use gcheck_engine::{Concrete, ConcreteValue, FeedMode, Model, Role, State, Transform, Units};
use gcheck_geometry::Plane;
use gcheck_program::Block;

/// The modes in effect for the words of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Facts {
    /// Words are increments; `None` unknown.
    pub(crate) incremental: Option<bool>,
    /// Centres of arcs are points, else they count from the start of the arc.
    pub(crate) centre_absolute: bool,
    pub(crate) plane: Option<Plane>,
    pub(crate) units: Option<Units>,
    /// Words of X count diameters.
    pub(crate) diameter: Option<bool>,
    /// What the motion mode does.
    pub(crate) motion: Effect,
    /// The canned cycle in effect; [`CodeIx::NONE`] for none.
    pub(crate) cycle: CodeIx,
    /// A code of this role makes other places of the words than they say.
    pub(crate) mapped: Option<Role>,
    pub(crate) feed_mode: Option<FeedMode>,
    /// Speeds are those of the surface.
    pub(crate) surface: bool,
    /// The tool in the spindle.
    pub(crate) tool: Option<u32>,
    /// The block is a row of data, and none of its words is what it is in a command.
    pub(crate) is_row: bool,
}

impl Facts {
    /// The modes of a state after a block, which are those that its words were read in.
    pub(crate) fn of(block: &Block, state: &State<Concrete>, model: &Model<'_>) -> Self {
        Self {
            incremental: state.is_incremental(model),
            centre_absolute: state.effect(Role::ArcCentre, model) == Some(Effect::ArcCentreAbsolute),
            plane: state.plane(model),
            units: state.units(model),
            diameter: state.words_are_diameters(model),
            motion: state.effect(Role::Motion, model).unwrap_or(Effect::None),
            cycle: state.active_cycle(model).unwrap_or(CodeIx::NONE),
            mapped: mapped(state, model),
            feed_mode: state.feed_mode(model),
            surface: state.effect(Role::SpindleMode, model) == Some(Effect::SurfaceSpeed),
            tool: tool(state),
            is_row: state.reads_as_row(block.flags),
        }
    }

    /// Do words mean the same places under both?
    pub(crate) fn places_alike(&self, other: &Self) -> bool {
        let of_places = |facts: &Self| {
            let turns = facts.motion.is_arc();
            Self {
                motion: if turns { Effect::ArcClockwise } else { Effect::Linear },
                cycle: CodeIx::NONE,
                feed_mode: None,
                surface: false,
                tool: None,
                ..*facts
            }
        };
        let is_cycle = |facts: &Self| facts.cycle.is_some();
        of_places(self) == of_places(other) && is_cycle(self) == is_cycle(other)
    }

    /// Is a cut made by a straight line or an arc, and not by a cycle?
    pub(crate) fn is_arc(&self) -> bool {
        !self.cycle.is_some() && self.motion.is_arc()
    }
}

/// The tool in the spindle.
#[expect(clippy::cast_sign_loss, reason = "tool numbers are not negative")]
pub(crate) fn tool(state: &State<Concrete>) -> Option<u32> {
    match state.tool() {
        ConcreteValue::Number(number) if *number >= 0.0 => Some(number.round() as u32),
        _ => None,
    }
}

/// The first mode in effect under which the axes go elsewhere than the words say.
fn mapped(state: &State<Concrete>, model: &Model<'_>) -> Option<Role> {
    let is = |role: Role, effect: Effect| state.effect(role, model) == Some(effect);
    let mappings = [
        (Role::Scaling, Effect::ScalingOn),
        (Role::Rotation, Effect::RotationOn),
        (Role::Mirror, Effect::MirrorOn),
        (Role::Polar, Effect::PolarOn),
        (Role::Cylinder, Effect::CylinderMapping),
        (Role::PolarInterpolation, Effect::PolarInterpolationOn),
        (Role::DynamicOffset, Effect::DynamicOffsetOn),
        (Role::TiltedPlane, Effect::TiltedPlaneOn),
        (Role::Length, Effect::LengthFiveAxis),
        (Role::Length, Effect::ToolCentrePoint),
        (Role::Compensation, Effect::CompensationVector),
    ];
    if let Some((role, _)) = mappings.into_iter().find(|(role, effect)| is(*role, *effect)) {
        return Some(role);
    }
    if *state.transform() != Transform::NONE {
        return Some(Role::Rotation);
    }
    state.may_be_wrapped().then_some(Role::Cylinder)
}

/// What a mode that moves the axes elsewhere is called.
pub(crate) const fn mapping_name(role: Role) -> &'static str {
    match role {
        Role::Scaling => "a scaling",
        Role::Rotation => "a rotation or mirror of the coordinates",
        Role::Mirror => "a mirror of the coordinates",
        Role::Polar => "a mode of polar coordinates",
        Role::Cylinder => "a mapping onto a cylinder",
        Role::PolarInterpolation => "polar interpolation",
        Role::DynamicOffset => "a work offset that turns with the table",
        Role::TiltedPlane => "a tilted work plane",
        Role::Compensation => "a compensation along a vector",
        _ => "a tool length along a tilted tool",
    }
}
