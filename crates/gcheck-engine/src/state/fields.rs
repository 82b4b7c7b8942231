//! The fields of the state and of its parts, by name.
//!
//! Knows: which structures the state is made of. Must not know: what their fields mean. Only for the feature `forgetful`.

use super::bar::BarCommand;
use super::calls::Kept;
use super::compensation::CompensationState;
use super::cycle::CycleWords;
use super::feed::Feed;
use super::mapping::{Mapping, TiltedPlane};
use super::modes::Modes;
use super::offsets::Offsets;
use super::path_mode::Blending;
use super::points::Points;
use super::probe::Probe;
use super::saved::SavedModes;
use super::spindle::{CoolantState, SpindleState};
use super::tables::ToolData;
use super::tool::{Loaded, ToolState};
use super::tool_shift::ToolShift;
use super::transform::Transform;
use super::turning::TurningWords;
use super::{Bar, State};
use crate::eval::value::Abstract;
use crate::forgetful::Field;
use crate::machine::WorkOffset;

/// Structures whose lattice is written by hand, with the fields that they join.
const BY_HAND: [(&str, &[&str]); 13] = [
    ("Calls", &["frames", "elsewhere", "modal"]),
    ("Cylinder", &["diameter", "stands", "zero"]),
    ("Frame", &["kept", "locals"]),
    ("Locals", &["numbered", "named"]),
    ("ModalCall", &["arguments"]),
    ("ModalCalls", &["off", "calls", "other"]),
    ("Named", &["values", "unsure"]),
    ("PolarPlane", &["zero", "stands"]),
    ("Rotation", &["centre"]),
    ("Row", &["tool", "listed"]),
    ("Scaling", &["centre"]),
    ("Tables", &["offsets", "other_offset", "references", "tools", "partial"]),
    ("Variables", &["common", "named", "unwritten", "unsure"]),
];

/// All fields of the state and of its parts that are joined where two states become one.
pub fn state_fields() -> Vec<Field> {
    let composed = [
        State::<Abstract>::FIELDS,
        Bar::FIELDS,
        BarCommand::FIELDS,
        Blending::FIELDS,
        CompensationState::FIELDS,
        CoolantState::FIELDS,
        CycleWords::FIELDS,
        Feed::<Abstract>::FIELDS,
        Kept::FIELDS,
        Loaded::FIELDS,
        Mapping::FIELDS,
        Modes::FIELDS,
        Offsets::FIELDS,
        Points::FIELDS,
        Probe::FIELDS,
        SavedModes::FIELDS,
        SpindleState::<Abstract>::FIELDS,
        TiltedPlane::FIELDS,
        ToolData::FIELDS,
        ToolShift::FIELDS,
        ToolState::<Abstract>::FIELDS,
        Transform::FIELDS,
        TurningWords::FIELDS,
        WorkOffset::FIELDS,
    ];
    let all = composed.into_iter().chain(BY_HAND);
    all.flat_map(|(owner, fields)| fields.iter().map(move |field| (owner, *field))).collect()
}
