//! Fixes that many rules propose leave the text around them well-formed.

use crate::RULES;
use crate::testing::fixes_of;

/// A program with the first fix of a rule applied.
fn fixed(rule: &str, control: &str, program: &str) -> String {
    fixes_of(RULES.by_id(rule).unwrap(), control, program)
}

#[test]
fn a_block_before_has_the_line_end_of_the_file() {
    assert_eq!(
        fixed(
            "cycle-left-on",
            "haas-mill",
            "G90 G54 G0 X0. Y0.\r\nG81 Z-1. R.1 F1.\r\n  N9 T2 M6\r\nM30\r\n"
        ),
        "G90 G54 G0 X0. Y0.\r\nG81 Z-1. R.1 F1.\r\nG80\r\n  N9 T2 M6\r\nM30\r\n",
    );
}

#[test]
fn no_block_is_put_between_two_of_one_line() {
    let program = "G90 G54 G0 X0. Y0.;G81 Z-1. R.1 F1.;T2 M6\nM30\n";
    assert_eq!(fixed("cycle-left-on", "haas-mill", program), program, "reported, and not fixed");
}

#[test]
fn a_word_goes_with_the_blanks_before_it() {
    assert_eq!(fixed("word-not-read", "linuxcnc", "G0 X1\t H3 Y2\n"), "G0 X1 Y2\n",);
}
