//! Arcs: what a verdict about their geometry rests on.
//!
//! Knows: numbers without a decimal point, the control's tolerance, modes at the start. Must not know: any rule.

use gcheck_controls::Unpointed;
use gcheck_engine::{Fact, Role};
use gcheck_program::Word;

use crate::{Finding, PathCx, Severity, limit};

/// Were numbers of this block or of those before it written without decimal point, on a control that counts them in
/// least increments? Another rule judges which of the two was meant, and the tool's position depends on it.
pub(crate) fn counts_least_increments(cx: &PathCx<'_>) -> bool {
    if cx.control().numbers().unpointed == Unpointed::AsWritten {
        return false;
    }
    let at = cx.origin().at;
    let is_unpointed = |word: &Word| {
        matches!(word.letter.ascii(), b'X' | b'Y' | b'Z' | b'U' | b'V' | b'W' | b'I' | b'J' | b'K' | b'R')
            && !word.shape.point
            && word.number().is_some_and(|number| number.abs() > 0.0)
    };
    (at.block.saturating_sub(8)..=at.block).any(|block| {
        let place = cx.place_of(gcheck_engine::At { block, ..at });
        place.is_some_and(|place| place.table.words(place.block()).iter().any(is_unpointed))
    })
}

/// The finding, no more severe than the facts of the arc's geometry allow: the control's tolerance, and modes that the
/// program does not set.
pub(crate) fn limited_by_arc_facts(cx: &PathCx<'_>, finding: Finding) -> Finding {
    limited_by_modes(cx, finding.at_most(limit(cx.model.semantics().arcs.confidence)))
}

/// The finding, no more severe than modes of the arc allow that the program does not set.
pub(crate) fn limited_by_modes(cx: &PathCx<'_>, finding: Finding) -> Finding {
    [(Role::Plane, "the plane"), (Role::Distance, "absolute or incremental")].into_iter().fold(
        finding,
        |finding, (role, what)| {
            if cx.definitions().set_by(Fact::Mode(role)).is_some() {
                return finding;
            }
            let code = cx.code_name(role).map_or_else(String::new, |code| format!(" (`{code}`)"));
            finding
                .at_most(Severity::Warning)
                .assuming(format!("{what}{code} is as the control has it at the start"))
        },
    )
}
