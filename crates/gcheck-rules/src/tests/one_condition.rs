//! What one way of a condition sets counts after the ways meet again, and the finding names the condition.
//!
//! Knows: programs in which one block may be jumped over. Must not know: how paths are kept apart.

use expect_test::{Expect, expect};
use gcheck_diagnostics::{Certainty, Finding, Severity};

use crate::testing::{World, findings, recommended, words};

/// A milling program in which a condition may jump over one part; what follows it is the same on both ways.
fn program(before: &str, skipped: &str, after: &str) -> String {
    format!(
        "%\nO1\nG21 G17 G40 G49 G80 G90 G54 G94\nT1 M6\nS1000 M3\nG0 X0. Y0.\nG43 H1 Z5.\n{before}\
         IF [#500 EQ 1.] GOTO 10\n{skipped}\nN10 {after}\nG0 Z50.\nM30\n%\n"
    )
}

/// What is found, one line a finding: where, how severe, the message.
fn found(text: &str) -> Vec<Finding> {
    findings(&recommended(), "fanuc-mill", text, &World::default())
}

fn line(text: &str, finding: &Finding) -> String {
    let number = text[..finding.range.start as usize].matches('\n').count() + 1;
    format!("{number}: {}[{}] {}\n", finding.severity, finding.rule.id, finding.message)
}

fn check_skipped(before: &str, skipped: &str, after: &str, expected: &Expect) {
    let text = program(before, skipped, after);
    expected.assert_eq(&found(&text).iter().map(|finding| line(&text, finding)).collect::<String>());
}

#[test]
fn a_transformation_of_one_way_is_left_on() {
    check_skipped(
        "",
        "G68 X0. Y0. R45.",
        "G1 Z-1. F100.",
        &expect![[r#"
        12: info[rotation-left-on] the rotation is still on at the end of the program (`G68`), when `#500` is not 1
    "#]],
    );
    check_skipped(
        "",
        "G51 X0. Y0. P2.",
        "G1 Z-1. F100.",
        &expect![[r#"
        12: info[scaling-left-on] scaling is still on at the end of the program (`G51`), when `#500` is not 1
    "#]],
    );
    check_skipped(
        "",
        "G52 X10.",
        "G1 Z-1. F100.",
        &expect![[r#"
        12: info[shift-left-on] the shift of `X` is still on at the end of the program (`G52`), when `#500` is not 1
    "#]],
    );
    check_skipped(
        "",
        "G16",
        "G1 Z-1. F100.",
        &expect![[r#"
        12: info[polar-coordinates-left-on] programming in polar coordinates is still on at the end of the program (`G16`), when `#500` is not 1
    "#]],
    );
    check_skipped(
        "",
        "G66 P9001 Z-1.",
        "X1.",
        &expect![[r#"
        12: info[modal-call-left-on] the modal macro call is still on at the end of the program (`G66`), when `#500` is not 1
    "#]],
    );
}

#[test]
fn a_mode_of_one_way_changes_what_words_mean() {
    check_skipped(
        "",
        "G18",
        "G1 Z-1. F100.\nG2 X10. Y0. I5. J0.",
        &expect![[r#"
        11: info[arc-wrong-plane-word] arc with words for X and Y, but the ZX plane is active (`G18`), when `#500` is not 1
    "#]],
    );
    check_skipped(
        "F100.\n",
        "G93",
        "G1 Z-1.\nX10.",
        &expect![[r#"
        11: info[inverse-time-feed-missing] cut without a feed of its own under inverse time (`G93`), when `#500` is not 1
    "#]],
    );
    check_skipped(
        "F100.\n",
        "G95",
        "G1 Z-1.\nX10.",
        &expect![[r#"
            11: warning[maybe-feed-of-another-mode] the feed was given under another feed mode (`G94`), when `#500` is not 1
        "#]],
    );
    check_skipped(
        "",
        "M5",
        "G1 Z-1. F100.",
        &expect![[r#"
            10: info[maybe-spindle-stopped-while-cutting] cut after the spindle was stopped (`M5`), when `#500` is not 1
        "#]],
    );
    check_skipped(
        "",
        "G91",
        "G1 Z-1. F100.\nG0 Z-50.",
        &expect![[r#"
            10: warning[maybe-incremental-left-on] the move may be in increments (`G91`)
            11: info[rapid-between-cuts] rapid move down into the part and up again, and nothing is cut, when `#500` is not 1
        "#]],
    );
}

#[test]
fn a_variable_of_one_way_counts() {
    check_skipped(
        "",
        "#101=[0-5.]",
        "G1 Z-1. F100.\nG2 X10. I#101",
        &expect![[r#"
            11: info[arc-end-off-circle] arc ends 10 mm off its circle, when `#500` is not 1
        "#]],
    );
}

#[test]
fn what_is_right_on_both_ways_is_quiet() {
    check_skipped("", "G68 X0. Y0. R45.\nG1 Z-1. F100.\nG69", "G1 Z-1. F100.", &expect![[""]]);
    check_skipped("#101=5.\n", "#101=6.", "G1 Z-1. F100.\nG2 X[2*#101] I#101", &expect![[""]]);
}

#[test]
fn what_is_wrong_on_all_paths_is_said_once_and_for_certain() {
    check_skipped(
        "",
        "#1=1",
        "G1 Z-1. F100.\nG2 X10. I4.",
        &expect![[r#"
        11: warning[arc-end-off-circle] arc ends 2 mm off its circle
    "#]],
    );
}

#[test]
fn the_words_name_the_condition_and_its_place() {
    let text = program("", "#101=[0-5.]", "G1 Z-1. F100.\nG2 X10. I#101");
    let all = found(&text);
    assert!(all.iter().all(|finding| finding.certainty == Certainty::Maybe));
    assert!(all.iter().all(|finding| finding.severity < Severity::Error && finding.fixes.is_empty()));
    expect![[r#"
        arc ends 10 mm off its circle, when `#500` is not 1
          here: the centre is 5 mm from the start and 15 mm from the end
          there: when `#500` is not 1
          help: check the signs of the centre words, the end point, and where the block before ends
    "#]]
    .assert_eq(&all.iter().map(words).collect::<String>());
}

#[test]
fn a_condition_in_a_called_program_is_one_too() {
    let text = "O1\nG21 G17 G90 G54 G94\nT1 M6\nS1000 M3\nG0 X0. Y0.\nG43 H1 Z5.\nM98 P2\nG1 Z-1. F100.\nG0 Z50.\nM30\n\
                O2\nIF [#500 GT 3.] GOTO 10\nM5\nN10 M99\n";
    expect![[r#"
        8: info[maybe-spindle-stopped-while-cutting] cut after the spindle was stopped (`M5`), when `#500` is not greater than 3
    "#]]
    .assert_eq(&found(text).iter().map(|finding| line(text, finding)).collect::<String>());
}

#[test]
fn ways_within_a_way_are_followed() {
    let text = "O1\nG21 G17 G90 G54 G94\nT1 M6\nS1000 M3\nG0 X0. Y0.\nG43 H1 Z5.\nIF [#500 EQ 1.] GOTO 10\n\
                IF [#501 LT 2.] GOTO 10\nM5\nN10 G1 Z-1. F100.\nG0 Z50.\nM30\n";
    expect![[r#"
        10: info[maybe-spindle-stopped-while-cutting] cut after the spindle was stopped (`M5`), when `#500` is not 1 and `#501` is not less than 2
    "#]]
    .assert_eq(&found(text).iter().map(|finding| line(text, finding)).collect::<String>());
}
