//! The founding systems, sentence by sentence: every rule of the manual pages that the project comes from, with the programs
//! that prove what gcheck makes of it.
//!
//! Knows: one module for each system, with its sentences. Must not know: how anything is checked or computed; the product is
//! run as its users run it.
//!
//! The page `docs/seeds.md` is written from the same tables (`UPDATE_EXPECT=1 cargo test -p gcheck-tests --test manuals`).

mod bar_feeder;
mod cutter_3d;
mod cylinder;
mod feed;
mod length_5_axis;
mod page;
mod pockets;
mod probing;
mod sentence;

use sentence::System;

/// Every system, in the order of the page.
const SYSTEMS: [&System; 7] = [
    &feed::SYSTEM,
    &bar_feeder::SYSTEM,
    &cylinder::SYSTEM,
    &probing::SYSTEM,
    &cutter_3d::SYSTEM,
    &length_5_axis::SYSTEM,
    &pockets::SYSTEM,
];

#[test]
fn the_page_is_fresh() {
    expect_test::expect_file!["../../../../docs/seeds.md"].assert_eq(&page::write(&SYSTEMS));
}
