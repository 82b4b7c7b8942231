//! A word that is computed from an empty variable is missing, a computed code that the control does not have is unknown, and a
//! computed value in a gap of its range is refused, as if they were written.
//!
//! Knows: programs of five controls, what each finding of theirs says. Must not know: how values are known.

use std::fmt::Write as _;

use expect_test::{Expect, expect};

use crate::testing::{World, findings, recommended};

/// The errors and warnings of a program, each as its line and its title.
#[expect(clippy::needless_pass_by_value, reason = "written in the call")]
fn check_told(control: &str, program: &str, expected: Expect) {
    let mut shown = String::new();
    for finding in findings(&recommended(), control, program, &World::default()) {
        if finding.severity < crate::Severity::Warning {
            continue;
        }
        let line = program[..finding.range.start as usize].lines().count().max(1);
        writeln!(shown, "{line} {} {}: {}", finding.severity, finding.rule.id, finding.message).unwrap();
    }
    expected.assert_eq(&shown);
}

const HEAD: &str = "O1 (A)\nG20 G90 G17 G40 G49 G80 G54 G94\nT1 M6\nS1000 M3\nG0 X0. Y0.\nG43 H1 Z1.\n";

#[test]
fn a_dwell_without_its_time() {
    check_told(
        "haas-mill",
        &format!("{HEAD}G4 P#0\nM30\n"),
        expect![[r#"
        6 warning required-word-missing: `G4` without `P`
    "#]],
    );
    check_told("fanuc-mill", &format!("{HEAD}G4 X#0\nM30\n"), expect![[""]]);
}

#[test]
fn a_mapping_without_its_axes() {
    check_told(
        "haas-mill",
        &format!("{HEAD}G107 Y0 A#0 Q4.\nM30\n"),
        expect![[r#"
        7 error cylinder-without-rotary-axis: the cylinder has no rotary axis (`G107`)
    "#]],
    );
    check_told(
        "haas-mill",
        &format!("{HEAD}G65 P2 Q4.\nM30\nO2 (B)\nG107 Y0 A#1 Q#17\nM99\n"),
        expect![[r#"
            10 error cylinder-without-rotary-axis: the cylinder has no rotary axis (`G107`)
        "#]],
    );
}

#[test]
fn a_cycle_without_its_depth() {
    check_told(
        "haas-mill",
        &format!("{HEAD}G81 X0. Y0. Z#0 R.1 F10.\nG80\nM30\n"),
        expect![[r#"
            7 error cycle-word-missing: canned cycle without `Z` (`G81`)
        "#]],
    );
    check_told(
        "fanuc-mill",
        &format!("{HEAD}G81 X1. Y1. Z#0 R.1 F10.\nG80\nM30\n"),
        expect![[r#"
            7 warning cycle-word-missing: canned cycle without `Z` (`G81`)
        "#]],
    );
}

#[test]
fn a_call_without_its_program() {
    check_told(
        "haas-mill",
        &format!("{HEAD}M98 P#0\nM30\n"),
        expect![[r#"
            6 error required-word-missing: `M98` without `P`
        "#]],
    );
    check_told(
        "fanuc-mill",
        &format!("{HEAD}G54.1 P#0\nM30\n"),
        expect![[r#"
        6 warning needed-word-missing: `G54.1` without `P`
    "#]],
    );
}

#[test]
fn an_address_that_may_be_left_out_is_not_missed() {
    check_told(
        "haas-mill",
        &format!("{HEAD}G65 P2 X1. Z-1.\nM30\nO2 (B)\nG1 X#24 Y#25 F10.\nG1 Z#26\nG1 Z1.\nM99\n"),
        expect![[""]],
    );
}

#[test]
fn a_computed_code_that_the_control_does_not_have() {
    check_told(
        "haas-mill",
        &format!("{HEAD}#1=41.5\nG#1 X1.\nM30\n"),
        expect![[r#"
        7 error unknown-code: unknown code `G#1`
    "#]],
    );
    check_told(
        "haas-mill",
        &format!("{HEAD}#1=500\nM#1\nM30\n"),
        expect![[r#"
        7 warning unknown-code: unknown code `M#1`
    "#]],
    );
    check_told(
        "fanuc-mill",
        &format!("{HEAD}#1=6\nG#1\nM30\n"),
        expect![[r#"
        7 warning unknown-code: unknown code `G#1`
    "#]],
    );
}

#[test]
fn a_computed_number_in_a_gap() {
    check_told(
        "haas-mill",
        &format!("{HEAD}#1=250\nT#1 M6\nM30\n"),
        expect![[r#"
        7 error computed-value-out-of-range: computed value is not among those for `M6`: `T250`
    "#]],
    );
    check_told(
        "haas-mill",
        &format!("{HEAD}#1=250\nG1 G41 D#1 X1. F10.\nG40 X0.\nM30\n"),
        expect![[r#"
        8 error computed-value-out-of-range: computed value is not among those for `G41`: `D250`
    "#]],
    );
    check_told(
        "haas-mill",
        &format!("{HEAD}G1 G41 D250 X1. F10.\nG40 X0.\nM30\n"),
        expect![[r#"
        7 error number-out-of-range: value names nothing for `G41`: `D250`
    "#]],
    );
}

#[test]
fn a_number_of_a_program_or_a_block_is_whole_and_not_negative() {
    check_told(
        "haas-mill",
        &format!("{HEAD}G65 P2.5\nM97 P-1\nM30\n"),
        expect![[r#"
        7 error decimal-point-on-integer: decimal point on a whole number: `P2.5`
        8 error number-out-of-range: value too small for `M97`: `P-1`
    "#]],
    );
    check_told(
        "fanuc-mill",
        &format!("{HEAD}G65 P-2\nM30\n"),
        expect![[r#"
        7 error number-out-of-range: value too small for `G65`: `P-2`
    "#]],
    );
}

#[test]
fn an_argument_may_be_any_number() {
    check_told(
        "fanuc-mill",
        "O1 (A)\nG65 P2 A2.5 D[0-1] H-1.5\nM30\nO2 (B)\n#100=#7+#11\nM99\n",
        expect![[""]],
    );
}
