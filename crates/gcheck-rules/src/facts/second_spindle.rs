//! A second spindle, which takes the part over.
//!
//! Knows: the codes that controls have for it. Must not know: any rule, where the part is.

use gcheck_controls::{Code, Control};
use gcheck_program::FileIndex;

use crate::facts::workholding::Moved;
use crate::{PathCx, Uses};

/// The modal group of the codes that let another spindle be the main one.
const SWAP: &str = "spindle-swap";
/// The modal groups of the codes for a second spindle.
const SECOND: [&str; 5] =
    ["secondary-spindle", "secondary-chuck", "secondary-spindle-brake", SWAP, "spindle-sync"];

/// Does the block make another spindle the main one? Then the part is another one, or the other side of it.
pub(crate) fn swaps(cx: &PathCx<'_>) -> bool {
    cx.has_code(|code| code.entry().group == SWAP)
}

/// Does the file have a code for a second spindle? The code that only gives the work back to the first one is in the safe line of
/// many programs, and does not count.
pub(crate) fn has_second_spindle(program: &Uses<'_>) -> bool {
    names_second(program.file_index, program.environment.control())
}

/// The same, of the program that is executed.
pub(crate) fn works_on_second(cx: &PathCx<'_>) -> bool {
    names_second(cx.file_index, cx.control())
}

fn names_second(file_index: &FileIndex, control: &Control) -> bool {
    let mut codes =
        file_index.codes.iter().filter_map(|(number, _)| control.code_at(control.code_ix(*number)));
    codes.any(|code| is_second(code) && !gives_back(code))
}

fn is_second(code: Code<'_>) -> bool {
    SECOND.contains(&code.entry().group.as_str())
}

/// Nothing ends a code that only ends another one.
fn gives_back(code: Code<'_>) -> bool {
    code.entry().group == SWAP && Moved::by(code) == Moved::Back
}
