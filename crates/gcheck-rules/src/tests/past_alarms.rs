//! The check goes on past an alarm, and what it finds there is no consequence of the alarm.

use std::fmt::Write as _;

use expect_test::{Expect, expect};
use gcheck_diagnostics::Severity;

use crate::testing::{World, findings, recommended};

/// Findings above a hint, one a line.
fn shown(control: &str, program: &str, world: &World<'_>) -> String {
    let mut out = String::new();
    for finding in findings(&recommended(), control, program, world) {
        if finding.severity != Severity::Hint {
            let line = program[..finding.range.start as usize].matches('\n').count() + 1;
            writeln!(out, "{line} {} {}", finding.severity, finding.rule.id).unwrap();
        }
    }
    out
}

fn check(control: &str, program: &str, expected: &Expect) {
    expected.assert_eq(&shown(control, program, &World::default()));
}

const MISTAKES: &str = "G2 X50. Y0. I5. J0.
G1 X60. Y[1/0]
G1 X70. F0
G83 X10. Y10. Z-5. R2.
G80
";

fn with_mistakes(first: &str) -> String {
    format!(
        "%
O1
G21 G90 G17 G40 G49 G80 G94
T1 M6
G54
G43 H1
S1000 M3
G0 X0. Y0.
Z5.
{first}G1 Z-1. F100.
{MISTAKES}G0 Z50.
M5
M30
%
"
    )
}

#[test]
fn a_jump_to_nowhere_hides_none_of_four_other_mistakes() {
    check(
        "fanuc-mill",
        &with_mistakes(""),
        &expect![[r#"
            11 warning arc-end-off-circle
            12 error expression-without-value
            13 error feed-zero
            14 warning cycle-begins-below-r
            14 warning lasting-word-never-given
        "#]],
    );
    check(
        "fanuc-mill",
        &with_mistakes("GOTO 999\n"),
        &expect![[r#"
            10 info checked-past-alarm
            10 error jump-target-missing
            12 warning arc-end-off-circle
            13 error expression-without-value
            14 error feed-zero
            15 warning cycle-begins-below-r
            15 warning lasting-word-never-given
        "#]],
    );
    check(
        "haas-mill",
        &with_mistakes("M97 P999\n"),
        &expect![[r#"
            10 info checked-past-alarm
            10 error jump-target-missing
            13 error expression-without-value
            14 error feed-zero
            15 warning cycle-word-missing
        "#]],
    );
    check(
        "fanuc-mill",
        &with_mistakes("#1=1\nWHILE [#1 LT 3] DO1\n"),
        &expect![[r#"
            11 info checked-past-alarm
            11 error loop-end-missing
            13 warning arc-end-off-circle
            14 error expression-without-value
            15 error feed-zero
            16 warning cycle-begins-below-r
            16 warning lasting-word-never-given
        "#]],
    );
    check(
        "fanuc-mill",
        &with_mistakes("IF [#500 EQ 1] GOTO 999\n"),
        &expect![[r#"
            10 info checked-past-alarm
            10 error jump-target-missing
            12 warning arc-end-off-circle
            13 error expression-without-value
            14 error feed-zero
            15 warning cycle-begins-below-r
            15 warning lasting-word-never-given
        "#]],
    );
}

#[test]
fn an_alarm_in_a_subprogram_that_is_called_twice_hides_nothing() {
    check(
        "fanuc-mill",
        "%\nO1\nG21 G90 G17 G40 G49 G80 G94\nT1 M6\nG54\nG43 H1 Z50.\nS1000 M3\nG0 X0. Y0.\nM98 P2\nM98 P2\nG2 X50. Y0. I5. J0. F100.\nM5\nM30\nO2\nGOTO 999\nG1 X10. F0\nM99\n%\n",
        &expect![[r#"
            11 warning arc-end-off-circle
            15 info checked-past-alarm
            15 error jump-target-missing
            16 error feed-zero
        "#]],
    );
}

#[test]
fn a_missing_subroutine_leaves_open_what_it_switches() {
    check(
        "linuxcnc",
        "G21 G90\no1 call\nG1 X5\nG1 X6 F0\nM2\n",
        &expect![[r#"
        2 info checked-past-alarm
        2 warning o-word-subroutine-missing
        4 error feed-zero
    "#]],
    );
}

#[test]
fn what_a_refused_code_was_to_change_is_no_mistake_afterwards() {
    let world = World::of_group("machine");
    let program =
        "G21 G90 G17 G40 G49 G94\nG54\nT7 M6\nG43 H7 Z5\nS1000 M3\nG0 X5 Y5\nG1 Z-1 F100\nG0 Z50\nM5\nM2\n";
    expect![[r#"
        3 error tool-not-in-table
        4 error tool-not-in-table
    "#]]
    .assert_eq(&shown("linuxcnc", program, &world));
}

#[test]
fn a_cycle_that_lacks_a_word_lacks_it_once() {
    check(
        "fanuc-mill",
        "%\nO1\nG21 G90 G17 G40 G49 G80 G94\nT1 M6\nG54\nG43 H1 Z50.\nS1000 M3\nG0 X0. Y0.\nG81 X1. Y1. Z-5. F100.\nX2.\nX3.\nG80\nM5\nM30\n%\n",
        &expect![[r#"
            9 warning lasting-word-never-given
        "#]],
    );
}

#[test]
fn an_alarm_that_a_jump_was_to_pass_is_not_reached() {
    check(
        "fanuc-mill",
        "%\nO1\n#1=1\nIF [#1 EQ 1] GOTO 90\n#3000=1 (NO PART)\nM30\n%\n",
        &expect![[r#"
        4 info checked-past-alarm
        4 error jump-target-missing
    "#]],
    );
}

#[test]
fn a_remark_without_its_parentheses_does_nothing() {
    let program = "%\nO1\n(\nИзмерение длины G37 G91\n)\nG21 G17 G40 G49 G80\nT1 M6\nM30\n%\n";
    check(
        "fanuc-mill",
        program,
        &expect![[r#"
        3 error unclosed-comment
        4 error non-ascii-text
        5 error stray-parenthesis
    "#]],
    );
}

#[test]
fn what_is_after_the_end_breaks_nothing() {
    check(
        "fanuc-mill",
        "%\nO1\nM30\nG1 X[#1+2\nG999 X1.\n%\n",
        &expect![[r#"
        4 info unclosed-bracket
        5 info unknown-code
        5 warning unreachable-block
    "#]],
    );
    // A label may be jumped to by the operator.
    check(
        "fanuc-mill",
        "%\nO1\nM30\nN5 G1 X[#1+2\nM30\n%\n",
        &expect![[r#"
        4 error unclosed-bracket
    "#]],
    );
}
