//! Points of hole patterns: circle, arc, line.
//!
//! Knows: where the holes are. Must not know: what is done there.
//!
//! Angles are degrees, counter-clockwise from the plane's first axis. Source: Haas Mill Operator's Manual, G70 to G72.

use gcheck_controls::Letter;
use gcheck_geometry::{Degrees, Mm};

use super::{CycleError, MAX_STROKES, known};
use crate::fault::CycleFault;

/// A point of the plane.
pub(super) type PlanePoint = (Mm, Mm);

/// Holes evenly spaced on a whole circle about `centre`, the first at the angle `first`. A negative `radius` goes
/// clockwise.
///
/// # Errors
///
/// `L` must be 1 or more and the radius not zero.
pub fn bolt_circle(
    centre: PlanePoint,
    radius: Mm,
    first: Degrees,
    holes: u32,
) -> Result<impl ExactSizeIterator<Item = PlanePoint>, CycleError> {
    let step = 360.0 / f64::from(holes.max(1));
    on_circle(centre, Mm(radius.0.abs()), radius, first, if radius < Mm::ZERO { -step } else { step }, holes)
}

/// Holes on an arc about `centre`, the first at the angle `first`, `between` degrees apart; negative goes clockwise.
///
/// # Errors
///
/// `L` must be 1 or more, radius and angle not zero.
pub fn bolt_arc(
    centre: PlanePoint,
    radius: Mm,
    first: Degrees,
    between: Degrees,
    holes: u32,
) -> Result<impl ExactSizeIterator<Item = PlanePoint>, CycleError> {
    if !between.is_finite() {
        return Err(CycleError::Unknown);
    }
    if between.abs() <= Degrees::ZERO {
        return Err(CycleFault::Zero(Letter::of('K')).into());
    }
    on_circle(centre, radius, radius, first, between.0, holes)
}

/// Holes on a line from `start`, the first there, `between` apart in the direction `angle`.
///
/// # Errors
///
/// `L` must be 1 or more and the distance not zero.
pub fn bolt_line(
    start: PlanePoint,
    between: Mm,
    angle: Degrees,
    holes: u32,
) -> Result<impl ExactSizeIterator<Item = PlanePoint>, CycleError> {
    check(between, angle, holes)?;
    let (sin, cos) = angle.sin_cos();
    Ok((0..holes).map(move |hole| {
        let way = between * f64::from(hole);
        (start.0 + way * cos, start.1 + way * sin)
    }))
}

fn on_circle(
    (a, b): PlanePoint,
    radius: Mm,
    word: Mm,
    first: Degrees,
    step: f64,
    holes: u32,
) -> Result<impl ExactSizeIterator<Item = PlanePoint>, CycleError> {
    check(word, first, holes)?;
    Ok((0..holes).map(move |hole| {
        let (sin, cos) = Degrees(first.0 + step * f64::from(hole)).sin_cos();
        (a + radius * cos, b + radius * sin)
    }))
}

fn check(length: Mm, angle: Degrees, holes: u32) -> Result<(), CycleError> {
    known(&[length, Mm(angle.0)])?;
    if holes == 0 {
        return Err(CycleFault::ZeroRepeats.into());
    }
    if holes > MAX_STROKES {
        return Err(CycleError::TooManyStrokes);
    }
    if length.abs() <= Mm::ZERO {
        return Err(CycleFault::Zero(Letter::of('I')).into());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(points: Result<impl Iterator<Item = PlanePoint>, CycleError>) -> String {
        match points {
            Ok(points) => points
                .map(|(a, b)| format!("{:.3} {:.3}", a.0, b.0).replace("-0.000", "0.000"))
                .collect::<Vec<_>>()
                .join(", "),
            Err(error) => format!("{error:?}"),
        }
    }

    #[test]
    fn a_circle_is_divided_evenly() {
        assert_eq!(
            shown(bolt_circle((Mm(10.0), Mm(20.0)), Mm(5.0), Degrees(0.0), 4)),
            "15.000 20.000, 10.000 25.000, 5.000 20.000, 10.000 15.000"
        );
    }

    #[test]
    fn a_negative_radius_goes_clockwise_from_the_same_hole() {
        assert_eq!(
            shown(bolt_circle((Mm(0.0), Mm(0.0)), Mm(-5.0), Degrees(90.0), 4)),
            "0.000 5.000, 5.000 0.000, 0.000 -5.000, -5.000 0.000"
        );
    }

    #[test]
    fn an_arc_has_its_own_step_and_direction() {
        assert_eq!(
            shown(bolt_arc((Mm(0.0), Mm(0.0)), Mm(10.0), Degrees(30.0), Degrees(30.0), 3)),
            "8.660 5.000, 5.000 8.660, 0.000 10.000"
        );
        assert_eq!(
            shown(bolt_arc((Mm(0.0), Mm(0.0)), Mm(10.0), Degrees(0.0), Degrees(-90.0), 2)),
            "10.000 0.000, 0.000 -10.000"
        );
    }

    #[test]
    fn a_line_begins_at_its_start() {
        assert_eq!(
            shown(bolt_line((Mm(1.0), Mm(2.0)), Mm(10.0), Degrees(90.0), 3)),
            "1.000 2.000, 1.000 12.000, 1.000 22.000"
        );
    }

    #[test]
    fn nothing_to_drill_is_refused() {
        let origin = (Mm(0.0), Mm(0.0));
        assert_eq!(shown(bolt_circle(origin, Mm(5.0), Degrees(0.0), 0)), "Fault(ZeroRepeats)");
        assert_eq!(shown(bolt_line(origin, Mm(0.0), Degrees(0.0), 2)), "Fault(Zero(I))");
        assert_eq!(shown(bolt_arc(origin, Mm(1.0), Degrees(0.0), Degrees(0.0), 2)), "Fault(Zero(K))");
        assert_eq!(shown(bolt_line(origin, Mm(f64::NAN), Degrees(0.0), 2)), "Unknown");
        assert_eq!(shown(bolt_line(origin, Mm(1.0), Degrees(0.0), u32::MAX)), "TooManyStrokes");
    }
}
