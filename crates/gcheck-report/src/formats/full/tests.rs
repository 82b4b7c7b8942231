//! `full`, as a person at a terminal sees it.
//!
//! Knows: the texts that are hard to draw. Must not know: how codespan draws.

use std::ops::Range;
use std::sync::Arc;

use expect_test::{Expect, expect};
use gcheck_diagnostics::{Finding, Severity};
use gcheck_syntax::SourceText;

use crate::testing::{FEED_MISSING, at, everything, file, on, render, rendered, report};
use crate::{Colour, Format, Report};

fn check(text: &str, finding: Finding, expected: &Expect) {
    expected.assert_eq(&render(&report(text, vec![finding]), Format::Full));
}

#[test]
fn everything_a_finding_can_say() {
    expect![[r#"
        error[feed-missing]: no feed rate is in effect
          ┌─ part.nc:4:5
          │
        3 │ G90
          │ --- `G90` set here
        4 │ N10 G1 X10.
          │     ^^ here
          │
          ┌─ sub/O9 1.nc:1:1
          │
        1 │ O9(é)
          │ -- called from here
          │
          = note: the control stops without a feed rate
          = note: from the manual:
              "feed is modal"
          = note: the control raises alarm 312 FEED
          = note: assuming setting 162 is off
          = help: write a feed rate, e.g. `F200.`

        info[arc-end-off-circle]: arc may end off the circle
          ┌─ part.nc:5:5
          │
        5 │ N20 G2 X20. I5.
          │     ^^^^^^^^^^^

    "#]]
    .assert_eq(&render(&everything(), Format::Full));
}

#[test]
fn a_range_over_lines() {
    let text = "O1\nG1 X1.\nG1 X2.\nG1 X3.\nM30\n";
    check(
        text,
        on(text, "X1.\nG1 X2.\nG1"),
        &expect![[r#"
            error[feed-missing]: no feed rate is in effect
              ┌─ part.nc:2:4
              │
            2 │   G1 X1.
              │ ╭────^
            3 │ │ G1 X2.
            4 │ │ G1 X3.
              │ ╰──^ here

        "#]],
    );
}

#[test]
fn a_whole_line_is_underlined_as_one() {
    let text = "O1\nG1 X1.\nM30\n";
    check(
        text,
        on(text, "G1 X1.\n"),
        &expect![[r#"
            error[feed-missing]: no feed rate is in effect
              ┌─ part.nc:2:1
              │
            2 │ G1 X1.
              │ ^^^^^^ here

        "#]],
    );
}

#[test]
fn a_range_over_many_lines_shows_its_ends() {
    let text = "G1 X1.\n".repeat(100_000);
    check(
        &text,
        Finding::new(&FEED_MISSING, 7..690_000, "too long").label("all this"),
        &expect![[r#"
            error[feed-missing]: too long
                  ┌─ part.nc:2:1
                  │
                2 │ ╭ G1 X1.
                3 │ │ G1 X1.
                4 │ │ G1 X1.
                5 │ │ G1 X1.
                  · │
            98571 │ │ G1 X1.
            98572 │ │ G1 X1.
                  │ ╰───^ all this

        "#]],
    );
}

#[test]
fn lines_far_apart() {
    let text = "G90\n\n\n\nG91\n\nG1 X1.\n";
    let finding = on(text, "X1.").also(at(text, "G90"), "first").also(at(text, "G91"), "then");
    check(
        text,
        finding,
        &expect![[r#"
            error[feed-missing]: no feed rate is in effect
              ┌─ part.nc:7:4
              │
            1 │ G90
              │ --- first
              ·
            5 │ G91
              │ --- then
            6 │
            7 │ G1 X1.
              │    ^^^ here

        "#]],
    );
}

#[test]
fn the_end_of_the_file() {
    check(
        "G1\n",
        Finding::new(&FEED_MISSING, 3..3, "no program end").label("ends here"),
        &expect![[r#"
            error[feed-missing]: no program end
              ┌─ part.nc:2:1
              │
            2 │
              │ ^ ends here

        "#]],
    );
    check(
        "G1",
        Finding::new(&FEED_MISSING, 2..2, "no program end"),
        &expect![[r#"
            error[feed-missing]: no program end
              ┌─ part.nc:1:3
              │
            1 │ G1
              │   ^

        "#]],
    );
}

#[test]
fn an_empty_file() {
    check(
        "",
        Finding::new(&FEED_MISSING, 0..0, "nothing to do"),
        &expect![[r#"
            error[feed-missing]: nothing to do
              ┌─ part.nc:1:1
              │
            1 │
              │ ^

        "#]],
    );
}

#[test]
fn every_line_end() {
    let drawn = ["\n", "\r\n", "\r"].map(|end| {
        let text = ["O1", "G1 X1.", "M30", ""].join(end);
        render(&report(&text, vec![on(&text, "X1.")]), Format::Full)
    });
    expect![[r#"
        error[feed-missing]: no feed rate is in effect
          ┌─ part.nc:2:4
          │
        2 │ G1 X1.
          │    ^^^ here

    "#]]
    .assert_eq(&drawn[0]);
    assert_eq!(drawn[0], drawn[1]);
    assert_eq!(drawn[0], drawn[2]);
}

#[test]
fn columns_are_characters_and_carets_are_columns_of_the_screen() {
    let text = "(µ)(日本)(😀) X1.";
    check(
        text,
        on(text, "X1."),
        &expect![[r#"
            error[feed-missing]: no feed rate is in effect
              ┌─ part.nc:1:12
              │
            1 │ (µ)(日本)(😀) X1.
              │               ^^^ here

        "#]],
    );
}

#[test]
fn a_tab_is_one_column() {
    let text = "N1\tG1\tX1.";
    check(
        text,
        on(text, "G1"),
        &expect![[r#"
            error[feed-missing]: no feed rate is in effect
              ┌─ part.nc:1:4
              │
            1 │ N1  G1  X1.
              │     ^^ here

        "#]],
    );
}

#[test]
fn a_long_line_is_cut_around_the_labels() {
    let middle = format!("{}G1 X1.{}", "(µ) ".repeat(125_000), " X2.".repeat(125_000));
    check(
        &middle,
        on(&middle, "G1").also(at(&middle, "X1."), "and here"),
        &expect![[r#"
            error[feed-missing]: no feed rate is in effect
              ┌─ part.nc:1:500001
              │
            1 │ …(µ) (µ) (µ) (µ) (µ) (µ) (µ) (µ) (µ) (µ) G1 X1. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X…
              │                                          ^^ --- and here
              │                                          │
              │                                          here

        "#]],
    );

    let start = format!("G1 X1.{}", " X2.".repeat(250_000));
    check(
        &start,
        on(&start, "G1"),
        &expect![[r#"
            error[feed-missing]: no feed rate is in effect
              ┌─ part.nc:1:1
              │
            1 │ G1 X1. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X…
              │ ^^ here

        "#]],
    );

    let end = format!("{}G1", "X2. ".repeat(250_000));
    check(
        &end,
        on(&end, "G1"),
        &expect![[r#"
            error[feed-missing]: no feed rate is in effect
              ┌─ part.nc:1:1000001
              │
            1 │ …. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. G1
              │                                                                                                                        ^^ here

        "#]],
    );

    let far = format!("G90 {}G1 X1.{} M5", "X2. ".repeat(100), " Y2.".repeat(100));
    let finding =
        on(&far, "G1").also(at(&far, "G90"), "far to the left").also(at(&far, "M5"), "far to the right");
    check(
        &far,
        finding,
        &expect![[r#"
            error[feed-missing]: no feed rate is in effect
              ┌─ part.nc:1:405
              │
            1 │ …X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. G1 X1. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y2. Y…
              │ -                                        ^^                                                                              - far to the right
              │ │                                        │
              │ │                                        here
              │ far to the left

        "#]],
    );

    check(
        &end,
        Finding::new(&FEED_MISSING, 0..1_000_002, "all of it").label("long"),
        &expect![[r#"
            error[feed-missing]: all of it
              ┌─ part.nc:1:1
              │
            1 │ X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. …
              │ ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ long

        "#]],
    );
}

#[test]
fn a_long_line_in_a_range_over_lines() {
    let long = "X2. ".repeat(100);
    let text = format!("{long}G1\n{long}\nM5 {long}");
    check(
        &text,
        on(&text, &format!("G1\n{long}\nM5")),
        &expect![[r#"
            error[feed-missing]: no feed rate is in effect
              ┌─ part.nc:1:401
              │
            1 │   …. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. G1
              │ ╭────────────────────────────────────────────────────────────────────────────────────────────────────────────────────────^
            2 │ │ X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. …
            3 │ │ M5 X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X2. X…
              │ ╰──^ here

        "#]],
    );
}

#[test]
fn bytes_that_are_no_text() {
    let mut file = file("part.nc", "", vec![]);
    let text = SourceText::from_bytes(b"(\xB5\x80) \x1B[2J\0 G1\x1A".to_vec()).unwrap();
    let mut finding = on(text.text(), "G1");
    finding.message = "odd: \x1B[2J\u{202E}\nx".to_owned();
    file.text = Arc::new(text);
    file.findings = vec![finding];
    expect![[r#"
        error[feed-missing]: odd: ␛[2J� x
          ┌─ part.nc:1:12
          │
        1 │ (��) ␛[2J␀ G1␚
          │            ^^ here

    "#]]
    .assert_eq(&render(&Report::new(vec![file]), Format::Full));
}

#[test]
fn a_label_in_a_file_that_is_not_at_hand() {
    let mut finding = on("G1", "G1");
    let label = gcheck_diagnostics::Label {
        file: Some("O9.nc".into()),
        range: 5..7,
        message: "called here".to_owned(),
    };
    finding.labels.push(label);
    check(
        "G1",
        finding,
        &expect![[r#"
            error[feed-missing]: no feed rate is in effect
              ┌─ part.nc:1:1
              │
            1 │ G1
              │ ^^ here
              │
              = note: in O9.nc: called here

        "#]],
    );
}

#[test]
fn every_severity_has_its_name() {
    let findings = Severity::ALL.map(|severity| Finding { severity, ..on("G1", "G1").help("none") });
    expect![[r#"
        hint[feed-missing]: no feed rate is in effect
          ┌─ part.nc:1:1
          │
        1 │ G1
          │ ^^ here
          │
          = help: none

        info[feed-missing]: no feed rate is in effect
          ┌─ part.nc:1:1
          │
        1 │ G1
          │ ^^ here
          │
          = help: none

        warning[feed-missing]: no feed rate is in effect
          ┌─ part.nc:1:1
          │
        1 │ G1
          │ ^^ here
          │
          = help: none

        error[feed-missing]: no feed rate is in effect
          ┌─ part.nc:1:1
          │
        1 │ G1
          │ ^^ here
          │
          = help: none

    "#]]
    .assert_eq(&render(&report("G1", findings.to_vec()), Format::Full));
}

#[test]
fn colours() {
    let finding = Finding { severity: Severity::Info, ..on("G1 X1.", "G1") };
    let text = rendered(
        &report("G1 X1.", vec![finding.also(3..6, "to here").help("none")]),
        Format::Full,
        Colour::Ansi,
    );
    assert!(text.ends_with('\n'));
    expect![[r#"
        ␛[0m␛[1;36minfo[feed-missing]␛[0m␛[1m: no feed rate is in effect␛[0m
          ␛[0m␛[34m┌─␛[0m part.nc:1:1
          ␛[0m␛[34m│␛[0m
        ␛[0m␛[34m1␛[0m ␛[0m␛[34m│␛[0m ␛[0m␛[1;36mG1␛[0m X1.
          ␛[0m␛[34m│␛[0m ␛[0m␛[1;36m^^␛[0m ␛[0m␛[34m---␛[0m ␛[0m␛[34mto here␛[0m
          ␛[0m␛[34m│␛[0m ␛[0m␛[1;36m│␛[0m
          ␛[0m␛[34m│␛[0m ␛[0m␛[1;36mhere␛[0m
          ␛[0m␛[34m│␛[0m
          ␛[0m␛[34m=␛[0m help: none

    "#]]
    .assert_eq(&text.replace('\x1b', "␛"));
}

#[test]
fn ranges_outside_the_text_are_drawn_at_its_end() {
    check(
        "G1\n",
        Finding::new(&FEED_MISSING, 7..9, "outside").also(Range { start: 2, end: 1 }, "wrong way round"),
        &expect![[r#"
            error[feed-missing]: outside
              ┌─ part.nc:2:1
              │
            1 │ G1
              │   - wrong way round
            2 │
              │ ^

        "#]],
    );
    check(
        "µ",
        Finding::new(&FEED_MISSING, 1..1, "inside a character"),
        &expect![[r#"
            error[feed-missing]: inside a character
              ┌─ part.nc:1:1
              │
            1 │ µ
              │ ^

        "#]],
    );
}
