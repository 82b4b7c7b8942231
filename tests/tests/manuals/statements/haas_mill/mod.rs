//! The statements of the Haas mill manual, one file a chapter.
//!
//! Knows: the chapters in the order of the page. Must not know: how anything is checked.

mod basics;
mod blocks;
mod canned_cycles_overview;
mod cutter_compensation;
mod five_axis;
mod g_codes_and_cycles;
mod g_compensation;
mod g_cycles_drilling;
mod g_cycles_tapping_boring;
mod g_engraving;
mod g_feed_and_accuracy;
mod g_five_axis;
mod g_moves;
mod g_offsets;
mod g_patterns;
mod g_planes_units_reference;
mod g_pockets;
mod g_probing;
mod g_scaling_rotation_mirror;
mod m_codes;
mod macro_arguments;
mod macro_calls;
mod macro_output;
mod macro_statements;
mod macro_variables;
mod macros_reading_ahead;
mod mill;
mod probing;
mod settings;
mod subprograms;
mod tool_management;

use super::page::{self, Manual};

const MANUAL: Manual = Manual {
    title: "Haas mill",
    source: "Haas Mill NGC Operator's Manual, 2017; places are pages of the manual.",
    chapters: &[
        // Chapters 4 to 6: tools, programming, options, macros.
        &tool_management::CHAPTER,
        &basics::CHAPTER,
        &cutter_compensation::CHAPTER,
        &canned_cycles_overview::CHAPTER,
        &subprograms::CHAPTER,
        &probing::CHAPTER,
        &five_axis::CHAPTER,
        &macros_reading_ahead::CHAPTER,
        &macro_arguments::CHAPTER,
        &macro_variables::CHAPTER,
        &macro_statements::CHAPTER,
        &macro_output::CHAPTER,
        &macro_calls::CHAPTER,
        // Chapters 7 to 9: G codes, M codes, settings.
        &g_codes_and_cycles::CHAPTER,
        &g_moves::CHAPTER,
        &g_planes_units_reference::CHAPTER,
        &g_offsets::CHAPTER,
        &g_probing::CHAPTER,
        &g_compensation::CHAPTER,
        &g_engraving::CHAPTER,
        &g_scaling_rotation_mirror::CHAPTER,
        &g_patterns::CHAPTER,
        &g_cycles_drilling::CHAPTER,
        &g_cycles_tapping_boring::CHAPTER,
        &g_pockets::CHAPTER,
        &g_five_axis::CHAPTER,
        &g_feed_and_accuracy::CHAPTER,
        &m_codes::CHAPTER,
        &settings::CHAPTER,
    ],
};

#[test]
fn the_page_is_fresh() {
    expect_test::expect_file!["../../../../../docs/dev/statements/haas-mill.md"]
        .assert_eq(&page::write(&MANUAL));
}
