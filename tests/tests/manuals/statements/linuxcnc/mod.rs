//! The statements of the LinuxCNC manual, one file a chapter.
//!
//! Knows: the chapters in the order of the page. Must not know: how anything is checked.

mod arcs;
mod canned_cycles;
mod compensation;
mod coordinates;
mod expressions;
mod flow;
mod lines;
mod machine;
mod modal_groups;
mod moves;
mod parameters;
mod path_control;
mod probing;
mod row;
mod saved_modes;
mod setting;
mod spindle;
mod splines;
mod stops;
mod subroutines;
mod threads;
mod tool_length;
mod tools;
mod turning_cycles;

use super::page::{self, Manual};

const MANUAL: Manual = Manual {
    title: "LinuxCNC",
    source: "LinuxCNC documentation, AsciiDoc sources; places are anchors. \
             Where the installed interpreter (`rs274` 2.9) does otherwise, the interpreter decides, and the statement says so.",
    chapters: &[
        &moves::CHAPTER,
        &arcs::CHAPTER,
        &splines::CHAPTER,
        &setting::CHAPTER,
        &threads::CHAPTER,
        &probing::CHAPTER,
        &compensation::CHAPTER,
        &tool_length::CHAPTER,
        &coordinates::CHAPTER,
        &path_control::CHAPTER,
        &canned_cycles::CHAPTER,
        &turning_cycles::CHAPTER,
        &stops::CHAPTER,
        &spindle::CHAPTER,
        &tools::CHAPTER,
        &saved_modes::CHAPTER,
        &subroutines::CHAPTER,
        &flow::CHAPTER,
        &lines::CHAPTER,
        &parameters::CHAPTER,
        &expressions::CHAPTER,
        &modal_groups::CHAPTER,
        &machine::CHAPTER,
    ],
};

#[test]
fn the_page_is_fresh() {
    expect_test::expect_file!["../../../../../docs/dev/statements/linuxcnc.md"]
        .assert_eq(&page::write(&MANUAL));
}
