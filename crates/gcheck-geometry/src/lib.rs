//! Geometry of tool paths: units, planes, arcs, frames, kinematics, compensation and boxes.
//!
//! Knows lengths, angles and times with their units, and what can be computed from points alone.
//! Must not know G-code: no code, no word, no modal state, no control.
//!
//! A number nobody knows is NaN throughout; it spreads to what depends on it and to nothing else, and it is never
//! a fault. No function here panics or loops without bound, whatever the numbers.

pub mod arc;
pub mod bounds;
pub mod compensation;
pub mod cylinder;
pub mod frame;
pub mod kinematics;
pub mod nurbs;
pub mod plane;
pub mod segment;
pub mod tilted_plane;
pub mod units;

pub use arc::{Arc, ArcDirection, ArcError, ArcTolerance, sweep_about};
pub use bounds::{Bounds, MAX_AXES};
pub use compensation::*;
pub use frame::Frame;
pub use kinematics::{Arrangement, Direction, Kinematics, RotaryAxis};
pub use nurbs::{Bezier, ControlPoint, CurveArc, Nurbs, NurbsError};
pub use plane::Plane;
pub use units::{Degrees, MM_PER_INCH, Mm, MmPerMin, MmPerRev, Rpm, Seconds};
