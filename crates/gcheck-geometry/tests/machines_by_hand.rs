//! Where the linear axes of nine machines are for a point of the part, against formulas worked out by hand.
//!
//! A point `p` of the part, about the centre of the table, is carried to `T p` by the table; the tip is to be there, so that the
//! gauge line lies a tool's length along the tool from it.

#![expect(clippy::expect_used, reason = "a test that meets the unexpected is to fail")]

use gcheck_geometry::{Arrangement, Degrees, Direction, Kinematics, Mm, RotaryAxis};

const LENGTH: f64 = 120.0;
const POINT: [f64; 3] = [30.0, -20.0, 15.0];
/// Axes that meet.
const MEETING: [Mm; 3] = [Mm(0.0); 3];

/// The axes for [`POINT`] of the part, about a table's centre.
fn axes(machine: &Kinematics, centre: [f64; 3], angles: [f64; 3]) -> [f64; 3] {
    let angles = angles.map(Degrees);
    let [x, y, z] = POINT;
    let point = [x + centre[0], y + centre[1], z + centre[2]].map(Mm);
    let tip = machine.part_frame(centre.map(Mm), angles).apply(point);
    machine.axes_for_tip(tip, Mm(LENGTH), angles).expect("the pivot is known").map(|axis| axis.0)
}

fn check(machine: &Kinematics, centre: [f64; 3], angles: [f64; 3], expected: [f64; 3]) {
    let found = axes(machine, centre, angles);
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{found} is not {expected}: {machine:?} at {angles:?}");
    }
}

fn sin_cos(degrees: f64) -> (f64, f64) {
    degrees.to_radians().sin_cos()
}

/// A fork head: C on the machine carries B. The tool leans by B and the lean turns with C:
/// `(sin b cos c, sin b sin c, cos b)`.
#[test]
fn a_head_of_c_and_b_swings_about_its_pivot() {
    let pivot = 250.0;
    let machine = Kinematics {
        arrangement: Arrangement::HeadHead,
        order: [RotaryAxis::C, RotaryAxis::B],
        sign: [1.0, 1.0],
        inclined: [None; 2],
        pivot_length: Some(Mm(pivot)),
        offset: MEETING,
    };
    for (b, c) in [(0.0, 0.0), (30.0, 0.0), (30.0, 90.0), (-75.0, 200.0)] {
        let ((sin_b, cos_b), (sin_c, cos_c)) = (sin_cos(b), sin_cos(c));
        let arm = LENGTH + pivot;
        let [x, y, z] = POINT;
        let expected = [x + arm * sin_b * cos_c, y + arm * sin_b * sin_c, z + arm * cos_b - pivot];
        check(&machine, [0.0; 3], [0.0, b, c], expected);
    }
}

/// A on the machine carries B, and B turns the other way: the tool is `(-sin b, -sin a cos b, cos a cos b)`.
#[test]
fn a_head_of_a_and_b_with_a_turned_direction() {
    let pivot = 100.0;
    let machine = Kinematics {
        arrangement: Arrangement::HeadHead,
        order: [RotaryAxis::A, RotaryAxis::B],
        sign: [1.0, -1.0],
        inclined: [None; 2],
        pivot_length: Some(Mm(pivot)),
        offset: MEETING,
    };
    for (a, b) in [(0.0, 0.0), (20.0, 0.0), (0.0, 20.0), (-40.0, 65.0)] {
        let ((sin_a, cos_a), (sin_b, cos_b)) = (sin_cos(a), sin_cos(b));
        let arm = LENGTH + pivot;
        let [x, y, z] = POINT;
        let expected = [x - arm * sin_b, y - arm * sin_a * cos_b, z + arm * cos_a * cos_b - pivot];
        check(&machine, [0.0; 3], [a, b, 0.0], expected);
    }
}

/// A trunnion: A on the machine carries the round table C, both turning as tables do, against the convention. C takes
/// `(x, y)` by `-c`, A then takes `(y, z)` by `-a`, about the centre; the tool stays upright.
#[test]
fn a_trunnion_of_a_and_c_carries_the_part() {
    let machine = Kinematics {
        arrangement: Arrangement::TableTable,
        order: [RotaryAxis::A, RotaryAxis::C],
        sign: [-1.0, -1.0],
        inclined: [None; 2],
        pivot_length: None,
        offset: MEETING,
    };
    let centre = [400.0, 250.0, -90.0];
    for (a, c) in [(0.0, 0.0), (90.0, 0.0), (0.0, 90.0), (-35.0, 160.0)] {
        let ((sin_a, cos_a), (sin_c, cos_c)) = (sin_cos(a), sin_cos(c));
        let [x, y, z] = POINT;
        let (turned_x, turned_y) = (x * cos_c + y * sin_c, -x * sin_c + y * cos_c);
        let (tilted_y, tilted_z) = (turned_y * cos_a + z * sin_a, -turned_y * sin_a + z * cos_a);
        let expected = [centre[0] + turned_x, centre[1] + tilted_y, centre[2] + tilted_z + LENGTH];
        check(&machine, centre, [a, 0.0, c], expected);
    }
}

/// A tilting head over a round table: B turns the tool to `(sin b, 0, cos b)`, C the part by `-c` about its centre.
#[test]
fn a_head_of_b_over_a_table_of_c() {
    let pivot = 180.0;
    let machine = Kinematics {
        arrangement: Arrangement::HeadTable,
        order: [RotaryAxis::B, RotaryAxis::C],
        sign: [1.0, -1.0],
        inclined: [None; 2],
        pivot_length: Some(Mm(pivot)),
        offset: MEETING,
    };
    let centre = [-300.0, 120.0, 0.0];
    for (b, c) in [(0.0, 0.0), (45.0, 0.0), (0.0, 45.0), (-60.0, -130.0)] {
        let ((sin_b, cos_b), (sin_c, cos_c)) = (sin_cos(b), sin_cos(c));
        let arm = LENGTH + pivot;
        let [x, y, z] = POINT;
        let (turned_x, turned_y) = (x * cos_c + y * sin_c, -x * sin_c + y * cos_c);
        let expected =
            [centre[0] + turned_x + arm * sin_b, centre[1] + turned_y, centre[2] + z + arm * cos_b - pivot];
        check(&machine, centre, [0.0, b, c], expected);
    }
}

/// A trunnion of B and C whose axes do not meet: C, at `d` from B, takes `(x, y)` by `-c` about itself, then B takes
/// `(z, x)`, counted from B, by `-b`.
#[test]
fn a_trunnion_of_b_and_c_whose_axes_do_not_meet() {
    let apart = [35.0, -8.0, -12.0];
    let machine = Kinematics {
        arrangement: Arrangement::TableTable,
        order: [RotaryAxis::B, RotaryAxis::C],
        sign: [-1.0, -1.0],
        inclined: [None; 2],
        pivot_length: None,
        offset: apart.map(Mm),
    };
    let centre = [200.0, 150.0, -60.0];
    for (b, c) in [(0.0, 0.0), (90.0, 0.0), (0.0, 90.0), (25.0, -140.0)] {
        let ((sin_b, cos_b), (sin_c, cos_c)) = (sin_cos(b), sin_cos(c));
        let [x, y, z] = POINT;
        let [dx, dy, dz] = apart;
        let (from_x, from_y) = (x - dx, y - dy);
        let (turned_x, turned_y) =
            (dx + from_x * cos_c + from_y * sin_c, dy - from_x * sin_c + from_y * cos_c);
        let (tilted_x, tilted_z) = (turned_x * cos_b - z * sin_b, turned_x * sin_b + z * cos_b);
        let expected = [centre[0] + tilted_x, centre[1] + turned_y, centre[2] + tilted_z + LENGTH];
        check(&machine, centre, [0.0, b, c], expected);
        // What is apart along the second axis changes nothing.
        let along = Kinematics { offset: [Mm(dx), Mm(dy), Mm(dz + 50.0)], ..machine };
        check(&along, centre, [0.0, b, c], expected);
    }
}

/// A fork head whose B is carried round by C at a distance: the pivot moves by what `d` turns, `(dx cos c - dy sin c - dx,
/// dx sin c + dy cos c - dy)`, and the axes make up for it.
#[test]
fn a_head_of_c_and_b_whose_axes_do_not_meet() {
    let pivot = 250.0;
    let apart = [18.0, -6.0, 40.0];
    let machine = Kinematics {
        arrangement: Arrangement::HeadHead,
        order: [RotaryAxis::C, RotaryAxis::B],
        sign: [1.0, 1.0],
        inclined: [None; 2],
        pivot_length: Some(Mm(pivot)),
        offset: apart.map(Mm),
    };
    for (b, c) in [(0.0, 0.0), (30.0, 0.0), (0.0, 90.0), (-75.0, 200.0)] {
        let ((sin_b, cos_b), (sin_c, cos_c)) = (sin_cos(b), sin_cos(c));
        let arm = LENGTH + pivot;
        let ([x, y, z], [dx, dy, _]) = (POINT, apart);
        let (moved_x, moved_y) = (dx * cos_c - dy * sin_c - dx, dx * sin_c + dy * cos_c - dy);
        let expected =
            [x + arm * sin_b * cos_c - moved_x, y + arm * sin_b * sin_c - moved_y, z + arm * cos_b - pivot];
        check(&machine, [0.0; 3], [0.0, b, c], expected);
    }
}

/// A nutating head: C on the machine carries B, which turns about the line between Y and Z. B takes the tool, Z, round the line
/// `(0, 1, 1) / sqrt 2` to `(sin b / sqrt 2, (1 - cos b) / 2, (1 + cos b) / 2)`: upright at 0, lying along Y at 180 degrees.
/// C turns that in X and Y.
#[test]
fn a_nutating_head_at_45_degrees() {
    let pivot = 210.0;
    let machine = Kinematics {
        arrangement: Arrangement::HeadHead,
        order: [RotaryAxis::C, RotaryAxis::B],
        sign: [1.0, 1.0],
        inclined: [None, Direction::of([0.0, 3.0, 3.0])],
        pivot_length: Some(Mm(pivot)),
        offset: MEETING,
    };
    for (b, c) in [(0.0, 0.0), (180.0, 0.0), (90.0, 0.0), (180.0, 90.0), (-55.0, 130.0)] {
        let ((sin_b, cos_b), (sin_c, cos_c)) = (sin_cos(b), sin_cos(c));
        let tool = [sin_b / f64::sqrt(2.0), (1.0 - cos_b) / 2.0, f64::midpoint(1.0, cos_b)];
        let arm = LENGTH + pivot;
        let [x, y, z] = POINT;
        let expected = [
            x + arm * (tool[0] * cos_c - tool[1] * sin_c),
            y + arm * (tool[0] * sin_c + tool[1] * cos_c),
            z + arm * tool[2] - pivot,
        ];
        check(&machine, [0.0; 3], [0.0, b, c], expected);
    }
}

/// A nutating table: B on the machine, about the line between Y and Z against its direction, carries the round table C. What
/// B takes round the line: with `p = (y + z) / 2` along it and `q = (y - z) / 2` across, `(x, y, z)` becomes
/// `(x cos b - sqrt 2 q sin b, p + q cos b + x sin b / sqrt 2, p - q cos b - x sin b / sqrt 2)`, at `-b`.
#[test]
fn a_nutating_table_carries_a_round_one() {
    let machine = Kinematics {
        arrangement: Arrangement::TableTable,
        order: [RotaryAxis::B, RotaryAxis::C],
        sign: [1.0, -1.0],
        inclined: [Direction::of([0.0, -1.0, -1.0]), None],
        pivot_length: None,
        offset: MEETING,
    };
    let centre = [150.0, -40.0, -220.0];
    for (b, c) in [(0.0, 0.0), (180.0, 0.0), (90.0, 0.0), (0.0, 45.0), (-70.0, 200.0)] {
        let ((sin_b, cos_b), (sin_c, cos_c)) = (sin_cos(-b), sin_cos(c));
        let [x, y, z] = POINT;
        let (turned_x, turned_y) = (x * cos_c + y * sin_c, -x * sin_c + y * cos_c);
        let (along, across) = (turned_y.midpoint(z), (turned_y - z) / 2.0);
        let root = f64::sqrt(2.0);
        // The line's direction times the point: (z - y, x, -x) / sqrt 2.
        let expected = [
            centre[0] + turned_x * cos_b - root * across * sin_b,
            centre[1] + along + across * cos_b + turned_x * sin_b / root,
            centre[2] + along - across * cos_b - turned_x * sin_b / root + LENGTH,
        ];
        check(&machine, centre, [0.0, b, c], expected);
    }
}

/// A head that swings about a line at 30 degrees to Z over a round table: A takes Z round `(sin 30, 0, cos 30)`. With
/// `t = 1 - cos a`, the tool is `(sin 30 cos 30 t, -sin 30 sin a, cos a + cos² 30 t)`.
#[test]
fn a_head_at_30_degrees_over_a_round_table() {
    let pivot = 90.0;
    let (sin_tilt, cos_tilt) = sin_cos(30.0);
    let machine = Kinematics {
        arrangement: Arrangement::HeadTable,
        order: [RotaryAxis::A, RotaryAxis::C],
        sign: [1.0, -1.0],
        inclined: [Direction::of([sin_tilt, 0.0, cos_tilt]), None],
        pivot_length: Some(Mm(pivot)),
        offset: MEETING,
    };
    let centre = [-10.0, 25.0, 0.0];
    for (a, c) in [(0.0, 0.0), (90.0, 0.0), (180.0, 0.0), (-35.0, 75.0)] {
        let ((sin_a, cos_a), (sin_c, cos_c)) = (sin_cos(a), sin_cos(c));
        let turn = 1.0 - cos_a;
        let tool = [sin_tilt * cos_tilt * turn, -sin_tilt * sin_a, cos_a + cos_tilt * cos_tilt * turn];
        let arm = LENGTH + pivot;
        let [x, y, z] = POINT;
        let (turned_x, turned_y) = (x * cos_c + y * sin_c, -x * sin_c + y * cos_c);
        let expected = [
            centre[0] + turned_x + arm * tool[0],
            centre[1] + turned_y + arm * tool[1],
            z + arm * tool[2] - pivot,
        ];
        check(&machine, centre, [a, 0.0, c], expected);
    }
}

#[test]
fn an_axis_along_its_linear_axis_may_be_described_as_inclined() {
    let named = Kinematics {
        arrangement: Arrangement::TableTable,
        order: [RotaryAxis::A, RotaryAxis::C],
        sign: [-1.0, 1.0],
        inclined: [None; 2],
        pivot_length: None,
        offset: [Mm(3.0), Mm(-2.0), Mm(7.0)],
    };
    let described =
        Kinematics { inclined: [Direction::of([2.0, 0.0, 0.0]), Direction::of([0.0, 0.0, 0.1])], ..named };
    for angles in [[0.0; 3], [90.0, 0.0, 180.0], [33.0, 0.0, -71.0]] {
        check(&described, [5.0, 6.0, 7.0], angles, axes(&named, [5.0, 6.0, 7.0], angles));
    }
}

#[test]
fn what_has_no_direction_is_refused() {
    for parts in [[0.0; 3], [0.0, 1e-9, 0.0], [f64::NAN, 0.0, 1.0], [0.0, f64::INFINITY, 0.0]] {
        assert_eq!(Direction::of(parts), None, "{parts:?}");
    }
    assert_eq!(Direction::of([0.0, 1e300, 1e300]), Direction::of([0.0, 1.0, 1.0]));
}
