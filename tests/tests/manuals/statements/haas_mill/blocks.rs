//! Blocks of a statement, within a program that is right before and after them.
//!
//! Knows: how a sound program begins and ends. Must not know: any statement.

/// Blocks of a tool that is ready to cut.
macro_rules! cut {
    ($blocks:literal) => {
        $crate::statements::haas_mill::mill::mill(concat!(
            "%\nO1 (PROOF)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0. S1000 M3\nG43 H1 Z.1 M8\n",
            $blocks,
            "G0 G40 G80 G90 Z1. M9\nM5\nG28 G91 Z0.\nG90\nM30\n%\n"
        ))
    };
}

pub(super) use cut;
