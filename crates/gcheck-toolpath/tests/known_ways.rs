//! Moves whose way is known and whose places are not.

mod runner;

use gcheck_engine::{Axis, Dynamics, Machine, Units};

/// On a mill that does not know where its axes are.
fn seconds(text: &str, acceleration: Option<f64>) -> [f64; 3] {
    let machine = Machine {
        units: Some(Units::Mm),
        dynamics: Dynamics {
            acceleration: acceleration
                .map(|acceleration| Axis::ALL.map(|axis| (axis, acceleration)).into())
                .unwrap_or_default(),
            ..Dynamics::default()
        },
        ..Machine::default()
    };
    let statistics = runner::figures("haas-mill", &machine, text);
    let times = statistics.total().times;
    [times.cutting.0, times.rapid.0, times.total().0]
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-6, "{found}, not {expected}");
}

#[test]
fn an_increment_takes_its_time_wherever_it_begins() {
    let [cutting, rapid, _] = seconds("%\nO1\nG91 G94\nG1 A90. F360.\nG0 A-180.\nX-50.\nM30\n%\n", None);
    near(cutting, 15.0);
    // 180 degrees at 3,600 a minute, 50 mm at 25,400.
    near(rapid, 3.0 + 50.0 / 25_400.0 * 60.0);
}

#[test]
fn linear_axes_count_as_much_as_they_go() {
    let [cutting, ..] = seconds("%\nO1\nG91 G94\nG1 X30. Y40. F600.\nA90.\nM30\n%\n", None);
    near(cutting, 5.0 + 90.0 / 600.0 * 60.0);
}

#[test]
fn a_place_that_is_not_known_has_no_way() {
    let [cutting, ..] = seconds("%\nO1\nG90 G94\nG1 A90. F360.\nG91 A10.\nM30\n%\n", None);
    near(cutting, 10.0 / 360.0 * 60.0);
}

#[test]
fn the_planner_runs_the_same_way() {
    let [cutting, _, total] = seconds("%\nO1\nG91 G94\nG1 A90. F360.\nM30\n%\n", Some(500.0));
    near(cutting, 15.0);
    assert!(total > 15.0 && total < 15.1, "{total}");
}
