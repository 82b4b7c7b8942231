//! One part in the three sets of G codes that lathes of one builder have: the same motion, whichever it is written in.

mod cycle_harness;

use cycle_harness::{machine, shown_on};

/// A part in system A, with words of systems B and C in place of its codes: `a|b|c`.
const PART: &str = "O1
{G21|G21|G71} {G99|G95|G95} G97 S800 M3
T0101
G0 X60. Z5.
{G50|G92|G92} S2500
{G90|G77|G20} X56. Z-40. F0.3
X52.
G0 X62. Z5.
{G94|G79|G24} X20. Z2. F0.2
Z0.
G0 X62. Z5.
{G71|G71|G73} U2. R1.
{G71|G71|G73} P100 Q200 U0.4 W0.1 F0.3
N100 G0 X26.
G1 Z0. F0.15
X30. Z-2.
Z-30.
N200 X56.
{G70|G70|G72} P100 Q200
G0 X62. Z-20.
{G75|G75|G77} R0.5
{G75|G75|G77} X50. Z-24. P1500 Q2000 F0.08
G0 X34. Z5.
{G76|G76|G78} P020060 Q100 R0.05
{G76|G76|G78} X28.16 Z-27. P920 Q300 F1.5
G0 X34. Z5.
{G92|G78|G21} X29. Z-20. F1.5
X28.6
G0 X34. Z5.
{G32|G33|G33} X34. Z-10. F2.
{G98|G94|G94} G1 X40. F100.
{G0 U10. W-2.|G91 G0 X10. Z-2.|G91 G0 X10. Z-2.}
{G0 U1.|G90 G0 X51.|G90 G0 X51.}
{G99|G95|G95} G1 Z-20. F0.1
M30
";

/// The part in one of the systems: 0 for A.
fn part(system: usize) -> String {
    let mut text = String::new();
    for piece in PART.split_inclusive('}') {
        match piece.split_once('{') {
            Some((before, choice)) => {
                text.push_str(before);
                text.push_str(choice.trim_end_matches('}').split('|').nth(system).unwrap_or_default());
            }
            None => text.push_str(piece),
        }
    }
    text
}

fn motion(control: &str, program: &str) -> String {
    shown_on(control, "XZ", &machine(0.0), program)
}

#[test]
fn the_same_part_moves_alike_in_every_system() {
    let a = motion("fanuc-lathe", &part(0));
    assert!(a.lines().count() > 100 && a.contains("sync 1.5"), "{a}");
    assert!(!a.lines().any(|line| line.starts_with(|c: char| c.is_ascii_uppercase())), "no fault: {a}");
    assert_eq!(motion("fanuc-lathe-b", &part(1)), a);
    assert_eq!(motion("fanuc-lathe-c", &part(2)), a);
}

#[test]
fn the_part_of_one_system_moves_otherwise_in_another() {
    for (control, system) in
        [("fanuc-lathe", 1), ("fanuc-lathe-b", 0), ("fanuc-lathe-b", 2), ("fanuc-lathe-c", 1)]
    {
        let own = ["fanuc-lathe", "fanuc-lathe-b", "fanuc-lathe-c"][system];
        assert_ne!(motion(control, &part(system)), motion(own, &part(system)), "{control} {system}");
    }
}
