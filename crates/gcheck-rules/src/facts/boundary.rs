//! Where the work of a tool or of the program ends: places at which a mode that was left on does harm.
//!
//! Knows: which blocks are such places. Must not know: any rule, which modes matter.

use std::ops::Range;

use crate::Finding;
use crate::PathCx;
use crate::facts::offset_schemes::whole;
use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Abstract, At, Domain, Ending, Fact};

/// A place at which the work of a tool, or of the program, ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Boundary {
    /// The tool is changed.
    ToolChange,
    /// The program ends.
    ProgramEnd,
}

impl Boundary {
    /// As findings name it: "at the tool change".
    pub(crate) const fn words(self) -> &'static str {
        match self {
            Self::ToolChange => "at the tool change",
            Self::ProgramEnd => "at the end of the program",
        }
    }
}

/// What ends with this block.
pub(crate) fn boundary(cx: &PathCx<'_>) -> Option<Boundary> {
    if cx.has_effect(Effect::ends_program) {
        return Some(Boundary::ProgramEnd);
    }
    changes_tool(cx).then_some(Boundary::ToolChange)
}

/// Does the block put another tool in the spindle or in working position?
fn changes_tool(cx: &PathCx<'_>) -> bool {
    let rules = cx.model.semantics().tools;
    if !rules.change_by_t {
        return cx.has_effect(|effect| effect == Effect::ToolChange);
    }
    // A computed tool that is not known may be the same one.
    let Some(number) = cx.known_number('T').and_then(whole) else { return false };
    let tool = if rules.offset_in_t && number >= 100 { number / 100 } else { number };
    // `T0` cancels offsets; calling the current tool again only changes its offsets.
    tool != 0 && Abstract::known(cx.state().tool()) != Some(f64::from(tool))
}

/// Bytes of the word that ends it.
pub(crate) fn boundary_range(cx: &PathCx<'_>, place: Boundary) -> Range<u32> {
    let by_t = cx.model.semantics().tools.change_by_t;
    cx.word_range(|word| {
        let effect = cx.model.effect(word.code);
        match place {
            Boundary::ToolChange => effect == Effect::ToolChange || by_t && word.letter == Letter::of('T'),
            Boundary::ProgramEnd => effect.ends_program(),
        }
    })
}

/// Is this a tape mark that ends the program as `M2` does?
pub(crate) fn ends_at_tape_mark(cx: &PathCx<'_>, ending: Ending) -> bool {
    ending == Ending::Tape && cx.control().syntax().tape_marks_end
}

/// Marks where the current tool was put in.
pub(crate) fn with_tool_change(cx: &PathCx<'_>, finding: Finding) -> Finding {
    match cx.definitions().set_by(Fact::Tool).and_then(|at| cx.range_of(at)) {
        Some(range) => finding.also(range, "the tool comes here"),
        None => finding,
    }
}

/// Does the first block come before the second in one file?
pub(crate) fn is_before(first: At, second: At) -> bool {
    first.file == second.file && first.block < second.block
}
