//! Where the linear axes of four machines are for a tip, against the kinematics of a control.
//!
//! `fixtures/kinematics/measured.tsv` holds what LinuxCNC's own modules answered (`cargo xtask kinematics`): `xyzac-trt-kins` and
//! `xyzbc-trt-kins` with axes that do not meet, `5axiskins`, `maxkins`.

use gcheck_geometry::{Arrangement, Degrees, Kinematics, Mm, RotaryAxis};

const TABLE: &str = include_str!("../../../fixtures/kinematics/measured.tsv");

/// A machine as the module has it, and a point on the first axis of its table.
fn machine(name: &str) -> (Kinematics, [Mm; 3]) {
    let table = |order, offset| Kinematics {
        arrangement: Arrangement::TableTable,
        order,
        sign: [1.0, 1.0],
        inclined: [None; 2],
        pivot_length: None,
        offset,
    };
    match name {
        // The second axis passes through 40, 25, -90; it lies 20 and 10 before the first one.
        "table-table" => (
            table([RotaryAxis::A, RotaryAxis::C], [Mm(0.0), Mm(-20.0), Mm(-10.0)]),
            [Mm(40.0), Mm(45.0), Mm(-80.0)],
        ),
        "table-table-b" => (
            table([RotaryAxis::B, RotaryAxis::C], [Mm(15.0), Mm(0.0), Mm(-35.0)]),
            [Mm(25.0), Mm(25.0), Mm(-55.0)],
        ),
        "head-head" => (
            Kinematics {
                arrangement: Arrangement::HeadHead,
                order: [RotaryAxis::C, RotaryAxis::B],
                sign: [1.0, -1.0],
                inclined: [None; 2],
                pivot_length: Some(Mm(250.0)),
                offset: [Mm::ZERO; 3],
            },
            [Mm::ZERO; 3],
        ),
        "head-table" => (
            Kinematics {
                arrangement: Arrangement::HeadTable,
                order: [RotaryAxis::B, RotaryAxis::C],
                sign: [-1.0, -1.0],
                inclined: [None; 2],
                pivot_length: Some(Mm(180.0)),
                offset: [Mm::ZERO; 3],
            },
            [Mm::ZERO; 3],
        ),
        other => panic!("{other}"),
    }
}

#[test]
fn linear_axes_are_where_the_control_puts_them() {
    let mut names: Vec<&str> = Vec::new();
    for line in TABLE.lines().skip(1) {
        let mut cells = line.split('\t');
        let name = cells.next().unwrap();
        let values: Vec<f64> = cells.map(|cell| cell.parse().unwrap()).collect();
        let (Ok(point), Ok(turns), Ok(axes)) = (
            <[f64; 3]>::try_from(&values[..3]),
            <[f64; 3]>::try_from(&values[3..6]),
            <[f64; 3]>::try_from(&values[6..]),
        ) else {
            panic!("{line}")
        };
        let (machine, centre) = machine(name);
        let angles = turns.map(Degrees);
        let tip = machine.part_frame(centre, angles).apply(point.map(Mm));
        let found = machine.axes_for_tip(tip, Mm::ZERO, angles).unwrap();
        for (found, expected) in found.iter().zip(axes) {
            assert!((found.0 - expected).abs() < 1e-5, "{found:?} is not {expected}: {line}");
        }
        names.push(name);
    }
    names.dedup();
    assert_eq!(names, ["table-table", "table-table-b", "head-head", "head-table"]);
}
