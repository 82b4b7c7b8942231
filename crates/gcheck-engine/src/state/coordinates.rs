//! Work coordinates and machine coordinates: where the axes stand for a point of the program, and back.
//!
//! Knows: offsets, lengths, mapped drawings, the rotary axes that tilt the tool or turn the part. Must not know: words, codes
//! beyond the modes that they leave.

use gcheck_controls::Effect;
use gcheck_geometry::{Arrangement, Degrees, Frame, Kinematics, Mm, Plane};
use nalgebra::{Matrix3, Vector3};

use super::State;
use crate::eval::value::Domain;
use crate::lattice::Perhaps;
use crate::machine::{Machine, WorkOffset};
use crate::model::{Model, Role};
use crate::position::{Axis, Position};

/// How the linear axes follow the points of the program.
#[derive(Debug, Clone, Copy)]
enum Following {
    /// By offsets and the tool's length along Z.
    Offsets,
    /// The tip of the tool stays on the part: the part's points turn with its table, and the head leans back.
    Tip(Frame, Kinematics),
    /// The origin turns with the table, the axes of the program do not.
    Origin(Frame),
    /// Nobody knows.
    Unknown,
}

impl<D: Domain> State<D> {
    /// Where the axes stand in machine coordinates.
    pub fn machine(&self, model: &Model<'_>, machine: &Machine) -> Position {
        self.to_machine(&self.points.actual, model, machine)
    }

    /// From work coordinates to machine coordinates. An axis that is wrapped around a cylinder stands still; on the face of a
    /// part X stands at the point's radius. What a mode turns is unknown where the machine's rotary axes are not described.
    pub fn to_machine(&self, work: &Position, model: &Model<'_>, machine: &Machine) -> Position {
        let WorkOffset { origin, rotation } = self.work_offset();
        let drawn = self.off_plane(self.mapping.standing(*work));
        let placed = (drawn + self.shift()).turned(rotation) + origin;
        let stands = placed + *self.length();
        let position = match self.following(&placed, model, machine) {
            Following::Offsets => stands,
            Following::Unknown => stands.with_xyz([Mm::UNKNOWN; 3]),
            Following::Origin(part) => stands + origin_moved(&origin, &part),
            Following::Tip(part, kinematics) => {
                let axes = self.length_along_z().and_then(|length| {
                    kinematics.axes_for_tip(part.apply(placed.xyz()), length, placed.abc())
                });
                stands.with_xyz(axes.unwrap_or([Mm::UNKNOWN; 3]))
            }
        };
        self.without_unknown_face(position, model)
    }

    /// From machine coordinates to work coordinates, as [`Self::to_machine`]. On the face of a part it is not known which of
    /// two points the axes stand for.
    pub fn from_machine(&self, machine: &Position, model: &Model<'_>, at: &Machine) -> Position {
        let WorkOffset { origin, rotation } = self.work_offset();
        let untooled = *machine - *self.length();
        let placed = match self.following(&untooled, model, at) {
            Following::Offsets => untooled,
            Following::Unknown => untooled.with_xyz([Mm::UNKNOWN; 3]),
            Following::Origin(part) => untooled - origin_moved(&origin, &part),
            Following::Tip(part, kinematics) => {
                let tip = self
                    .length_along_z()
                    .and_then(|length| kinematics.tip_for_axes(machine.xyz(), length, untooled.abc()));
                let on_part = tip.and_then(|tip| Some(part.inverse()?.apply(tip)));
                untooled.with_xyz(on_part.unwrap_or([Mm::UNKNOWN; 3]))
            }
        };
        let mut work = self.on_plane((placed - origin).turned(-rotation) - self.shift());
        if !self.face().is_no() {
            work.set(Axis::X, f64::NAN);
            work.set(Axis::Y, f64::NAN);
        }
        self.without_unknown_face(work, model)
    }

    /// A point of a tilted plane in the coordinates before.
    fn off_plane(&self, point: Position) -> Position {
        match &self.mapping.tilted {
            Perhaps::No => point,
            Perhaps::Yes(plane) => point.with_xyz(plane.frame().apply(point.xyz())),
            Perhaps::Unknown => point.with_xyz([Mm::UNKNOWN; 3]),
        }
    }

    /// A point in the coordinates of the tilted plane.
    fn on_plane(&self, point: Position) -> Position {
        match &self.mapping.tilted {
            Perhaps::No => point,
            Perhaps::Yes(plane) => {
                let inverse = plane.frame().inverse();
                point.with_xyz(inverse.map_or([Mm::UNKNOWN; 3], |inverse| inverse.apply(point.xyz())))
            }
            Perhaps::Unknown => point.with_xyz([Mm::UNKNOWN; 3]),
        }
    }

    /// The direction of the part along which Z of the program lies, of length 1; `None` where nobody knows it.
    pub(crate) fn upward(&self) -> Option<Vector3<f64>> {
        let plane = match &self.mapping.tilted {
            Perhaps::No => Vector3::z(),
            Perhaps::Yes(plane) => plane.frame().linear() * Vector3::z(),
            Perhaps::Unknown => return None,
        };
        let turned = Frame::rotation(Plane::Xy, (Mm::ZERO, Mm::ZERO), Degrees(self.work_offset().rotation));
        Some(turned.linear() * plane).filter(|upward| upward.iter().all(|part| part.is_finite()))
    }

    /// The tool's length, if that is all that the tool has.
    fn length_along_z(&self) -> Option<Mm> {
        let length = self.length();
        let sideways = [Axis::X, Axis::Y].into_iter().any(|axis| length.raw(axis) != 0.0);
        (!sideways).then(|| Mm(length.raw(Axis::Z)))
    }

    /// How the linear axes follow; `placed` tells where the rotary axes stand.
    fn following(&self, placed: &Position, model: &Model<'_>, machine: &Machine) -> Following {
        let may_tilt = self.may_be(Role::TiltedPlane, Effect::TiltedPlaneOn, model);
        let is_tilted = matches!(self.mapping.tilted, Perhaps::Yes(_));
        if may_tilt && !is_tilted {
            return Following::Unknown;
        }
        // Under a tilted plane the tool is where it belongs on the part, as under tool centre point control.
        let tip = is_tilted || self.may_be(Role::Length, Effect::ToolCentrePoint, model);
        let origin = self.may_be(Role::DynamicOffset, Effect::DynamicOffsetOn, model);
        if !tip && !origin || is_upright(placed, model, machine) {
            return Following::Offsets;
        }
        let Some(kinematics) = machine.kinematics else { return Following::Unknown };
        let centre = match kinematics.arrangement {
            Arrangement::HeadHead => Some([Mm::ZERO; 3]),
            Arrangement::HeadTable | Arrangement::TableTable => machine.rotary_centre(model),
        };
        let Some(centre) = centre else { return Following::Unknown };
        let part = kinematics.part_frame(centre, placed.abc());
        let is_on = |role: Role, effect: Effect| self.effect(role, model) == Some(effect);
        match (tip, origin) {
            (true, false) if is_tilted || is_on(Role::Length, Effect::ToolCentrePoint) => {
                Following::Tip(part, kinematics)
            }
            (false, true)
                if is_on(Role::DynamicOffset, Effect::DynamicOffsetOn)
                    && kinematics.arrangement == Arrangement::TableTable =>
            {
                Following::Origin(part)
            }
            _ => Following::Unknown,
        }
    }

    /// Do modes leave it to the rotary axes where the linear axes are? `stands` tells where the rotary axes stand.
    pub fn follows_rotary(&self, stands: &Position, model: &Model<'_>, machine: &Machine) -> bool {
        let may_be = |role: Role, effect: Effect| self.may_be(role, effect, model);
        may_be(Role::TiltedPlane, Effect::TiltedPlaneOn)
            || (may_be(Role::Length, Effect::ToolCentrePoint)
                || may_be(Role::DynamicOffset, Effect::DynamicOffsetOn))
                && !is_upright(stands, model, machine)
    }

    /// X, Y and Z of the machine for those of the program, with the rotary axes where `work` has them; `None` where a part of
    /// that is not known, or X, Y and Z of the machine do not depend on those of the program alone.
    pub fn linear_axes(&self, work: &Position, model: &Model<'_>, machine: &Machine) -> Option<Frame> {
        let at = |xyz: [f64; 3]| {
            let stands = self.to_machine(&work.with_xyz(xyz.map(Mm)), model, machine).xyz();
            stands.iter().all(|axis| axis.is_known()).then(|| Vector3::from(stands.map(|axis| axis.0)))
        };
        let origin = at([0.0; 3])?;
        let [x, y, z] = [at([1.0, 0.0, 0.0])?, at([0.0, 1.0, 0.0])?, at([0.0, 0.0, 1.0])?];
        let linear = Matrix3::from_columns(&[x - origin, y - origin, z - origin]);
        Some(Frame::from_parts(linear, [Mm(origin.x), Mm(origin.y), Mm(origin.z)]))
    }

    /// In work coordinates: where the axes are after a block takes those that `moves` accepts to `machine`. The others stay as in
    /// `from`, known or not, unless the linear axes follow rotary ones, so that one axis of the machine moves several of the program.
    pub(crate) fn at_machine(
        &self,
        machine: &Position,
        from: &Position,
        moves: impl Fn(Axis) -> bool,
        model: &Model<'_>,
        at: &Machine,
    ) -> Position {
        let target = self.from_machine(machine, model, at);
        let follows = self.follows_rotary(machine, model, at)
            || self.follows_rotary(&self.machine(model, at), model, at);
        let mut to = *from;
        for axis in Axis::ALL {
            if moves(axis) || follows && matches!(axis, Axis::X | Axis::Y | Axis::Z) {
                to.set(axis, target.raw(axis));
            }
        }
        to
    }

    /// May a code with the effect be in force? Of programs that are not here we take it that they leave it off.
    pub(crate) fn may_be(&self, role: Role, effect: Effect, model: &Model<'_>) -> bool {
        self.mode(role).may(|code| model.effect(code) == effect)
    }

    /// A position without the axes of a face that may be on, nobody knows where.
    fn without_unknown_face(&self, mut position: Position, model: &Model<'_>) -> Position {
        let may_be = self.may_be(Role::PolarInterpolation, Effect::PolarInterpolationOn, model);
        if self.face().is_unknown() || may_be && self.face().is_no() {
            // Z stays its own.
            for axis in model.axes.iter().filter(|axis| axis.is_rotary()).chain(&[Axis::X, Axis::Y]) {
                position.set(*axis, f64::NAN);
            }
        }
        position
    }
}

/// Are the rotary axes that the machine has all at zero?
fn is_upright(placed: &Position, model: &Model<'_>, machine: &Machine) -> bool {
    let is_there = |axis: &Axis| match (&machine.axes, &machine.kinematics) {
        (Some(axes), _) => axes.contains(axis),
        (None, Some(kinematics)) => {
            kinematics.order.iter().any(|own| Axis::ABC.get(own.index()) == Some(axis))
        }
        (None, None) => true,
    };
    model.axes.iter().filter(|axis| axis.is_rotary() && is_there(axis)).all(|axis| placed.raw(*axis) == 0.0)
}

/// The way of an origin that the table took along, in X, Y and Z.
fn origin_moved(origin: &Position, part: &Frame) -> Position {
    Position::ZERO.with_xyz(part.apply(origin.xyz())) - Position::ZERO.with_xyz(origin.xyz())
}
