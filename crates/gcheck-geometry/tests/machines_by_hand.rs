//! Where the linear axes of six machines are for a point of the part, against formulas worked out by hand.
//!
//! A point `p` of the part, about the centre of the table, is carried to `T p` by the table; the tip is to be there, so that the
//! gauge line lies a tool's length along the tool from it.

#![expect(clippy::expect_used, reason = "a test that meets the unexpected is to fail")]

use gcheck_geometry::{Arrangement, Degrees, Kinematics, Mm, RotaryAxis};

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
