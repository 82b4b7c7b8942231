//! What a program sets before it calls one that is not here still counts after the call, and the finding names the assumption.
//!
//! Knows: programs that call another one which nobody has. Must not know: how the state after the call comes about.

use expect_test::{Expect, expect};

use crate::testing::{World, findings, recommended, words};

/// What is found in a milling program of two parts with a call between them, one line a finding: where, how severe, the message.
fn check_call(before: &str, call: &str, after: &str, expected: &Expect) {
    let text = format!(
        "%\nO1\nG21 G17 G40 G49 G80 G90 G54 G94\nT1 M6\n{before}\n{call}\n{after}\nG0 Z50.\nM30\n%\n"
    );
    let found = findings(&recommended(), "fanuc-mill", &text, &World::default());
    let lines = found.iter().map(|finding| {
        let number = text[..finding.range.start as usize].matches('\n').count() + 1;
        format!("{number}: {}[{}] {}\n", finding.severity, finding.rule.id, finding.message)
    });
    expected.assert_eq(&lines.collect::<String>());
}

const START: &str = "S1000 M3\nG0 X0. Y0.\nG43 H1 Z5.\nG1 Z-1. F100.\nG0 Z50.";
const CUT: &str = "G90 G54 G0 X10. Y10.\nG43 H1 Z5.\nG1 Z-1. F100.";

#[test]
fn what_was_right_before_is_quiet_after() {
    for call in ["M98 P9000", "G65 P9832", "G65 P9811 Z-5. F500."] {
        check_call(START, call, CUT, &expect![[""]]);
    }
}

#[test]
fn the_length_of_the_tool_before_it_still_counts() {
    let after = "T2 M6\nS1000 M3\nG90 G54 G0 X10. Y10.\nZ5.\nG1 Z-1. F100.";
    check_call(
        START,
        "G65 P9832",
        after,
        &expect![[r#"
        15: info[length-offset-of-another-tool] tool 2 works with length offset 1 (`H1`, `T2`), when program 9832 leaves it so
    "#]],
    );
}

#[test]
fn modes_that_were_left_on_are_on() {
    let check_mode = |mode: &str, expected: &Expect| {
        check_call(&format!("{START}\n{mode}"), "G65 P9832", CUT, expected);
    };
    check_mode(
        "G41 D1 G1 X10. F100.",
        &expect![[r#"
        16: info[maybe-compensation-left-on] cutter compensation is still on at the end of the program (`G41`), when program 9832 leaves it so
    "#]],
    );
    check_mode(
        "G68 X0. Y0. R45.",
        &expect![[r#"
        16: info[rotation-left-on] the rotation is still on at the end of the program (`G68`), when program 9832 leaves it so
    "#]],
    );
    // The next part states positions.
    check_mode("G91", &expect![[""]]);
}

#[test]
fn what_was_never_set_may_be_what_the_program_is_for() {
    let cut = "G0 X10. Y10. Z5.\nG1 Z-1. F100.";
    // It may start the spindle and give the tool its length.
    check_call("", "M98 P9000", cut, &expect![[""]]);
    // A stop is not known to last either.
    check_call(&format!("{START}\nM5"), "M98 P9000", CUT, &expect![[""]]);
}

#[test]
fn what_it_says() {
    let text = format!(
        "%\nO1\nG21 G90 G54\nT1 M6\n{START}\nG65 P9832\nM98 P8000\nT2 M6\nS1000 M3\nG90 G54 G0 X10. Y10.\nZ5.\nG1 Z-1. F100.\nG0 Z50.\nM30\n%\n"
    );
    let found = findings(&recommended(), "fanuc-mill", &text, &World::default());
    expect![[r#"
        tool 2 works with length offset 1 (`H1`, `T2`), when the programs that are not here leave it so
          here: the length offset of tool 1
          there: the offset comes from here
          there: tool 2 comes into the spindle here
          note: the program's other tool has the length offset of the tool's own number (H = T)
          note: program 8000 and 1 more were not found: what they change is not known
          help: use offset 2, or say why not in a suppression
    "#]]
    .assert_eq(&found.iter().map(words).collect::<String>());
}

/// `T` before a call is an argument of many programs that change the tool.
#[test]
fn a_tool_that_is_called_before_it_may_be_put_in() {
    check_call(
        START,
        "T2\nM98 P9001",
        "S1000 M3\nG90 G54 G0 X10. Y10.\nG43 H2 Z5.\nG1 Z-1. F100.",
        &expect![[""]],
    );
}
