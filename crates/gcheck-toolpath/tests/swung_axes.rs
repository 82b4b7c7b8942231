//! Times while the linear axes follow the rotary ones.

mod runner;

use gcheck_engine::{Axis, Dynamics, Machine, Position, Units, WorkOffset};
use gcheck_geometry::{Arrangement, Kinematics, Mm, MmPerMin, RotaryAxis};
use runner::figures;

/// A table that tilts and turns, far from its centre, with the same acceleration along all axes.
fn trunnion() -> Machine {
    let kinematics = Kinematics {
        arrangement: Arrangement::TableTable,
        order: [RotaryAxis::A, RotaryAxis::C],
        sign: [1.0; 2],
        inclined: [None; 2],
        pivot_length: None,
        offset: [Mm(0.0); 3],
    };
    Machine {
        units: Some(Units::Mm),
        kinematics: Some(kinematics),
        rotary_centre: Some([Mm(0.0), Mm(-500.0), Mm(-800.0)]),
        rapid: Some(MmPerMin(5000.0)),
        offsets: [(1, WorkOffset { origin: Position::ZERO, rotation: 0.0 })].into(),
        start: Some(Position::ZERO),
        dynamics: Dynamics {
            acceleration: Axis::ALL.into_iter().map(|axis| (axis, 1000.0)).collect(),
            ..Dynamics::default()
        },
        ..Machine::default()
    }
}

/// Seconds of two rounds and a half of 50 mm at 500 mm/min, in what comes before.
fn seconds(before: &str) -> f64 {
    let text = format!(
        "G21 G90 G94 G17 G54\nG0 X0. Y0. Z0. A0. C0.\n{before}G0 X50. Y0. Z0.\nG2 I-50. F500.\nG2 I-50.\nX-50. I-50.\nM30"
    );
    let alone = format!("G21 G90 G94 G17 G54\nG0 X0. Y0. Z0. A0. C0.\n{before}G0 X50. Y0. Z0.\nM30");
    let time = |text: &str| figures("fanuc-mill", &trunnion(), text).total().times.total().0;
    time(&text) - time(&alone)
}

#[test]
fn arcs_in_a_tilted_plane_take_as_long_as_others() {
    let flat = seconds("");
    let length = 5.0 * std::f64::consts::PI * 50.0;
    assert!((flat - length / (500.0 / 60.0)).abs() < 0.1, "{flat}");
    for tilted in [
        "G68.2 X0. Y0. Z0. I0. J30. K0.\nG53.1\n",
        "G68.2 X5. Y0. Z0. I20. J30. K0.\nG53.1\n",
        "G43.4 H1 Z0.\nG0 A30. C20.\n",
    ] {
        let found = seconds(tilted);
        assert!((found / flat - 1.0).abs() < 0.01, "{tilted}: {found}, flat {flat}");
    }
}
