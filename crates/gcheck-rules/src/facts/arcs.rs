//! Arcs: what a verdict about their geometry rests on, and the arc that a block's words give.
//!
//! Knows: numbers without a decimal point, the control's tolerance, modes at the start. Must not know: any rule.

use gcheck_controls::Unpointed;
use gcheck_engine::{Fact, Role};
use gcheck_geometry::{Arc, ArcDirection, ArcTolerance, Mm, Plane};
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

/// The arc in XY that the block's words give from one point to another, whatever the path beside it: the offset of a cutter of
/// unknown size hides it in the event. `None` where a word is not known, or its centre words do not lead from the start to a centre.
pub(crate) fn by_its_words(
    cx: &PathCx<'_>,
    [start, end]: [[f64; 2]; 2],
    direction: ArcDirection,
) -> Option<Arc> {
    /// Controls pass centres that are off by so much, and more.
    const SLACK: f64 = 0.05;
    let unit = cx.state().units(cx.model)?.in_mm();
    let in_space = |[x, y]: [f64; 2]| [Mm(x), Mm(y), Mm::ZERO];
    let (start_at, end_at) = (in_space(start), in_space(end));
    if cx.word('R').is_some() {
        let radius = Mm(cx.known_number('R')? * unit);
        return Arc::by_radius(Plane::Xy, start_at, end_at, radius, direction, 1, &ArcTolerance::ANY).ok();
    }
    let part = |letter: char| match cx.word(letter) {
        Some(_) => cx.known_number(letter).map(|number| number * unit),
        None => Some(0.0),
    };
    let centre = (Mm(start[0] + part('I')?), Mm(start[1] + part('J')?));
    let arc = Arc::by_centre(Plane::Xy, start_at, end_at, centre, direction, 1, &ArcTolerance::ANY).ok()?;
    ((arc.radius() - arc.end_radius()).abs() < Mm(SLACK)).then_some(arc)
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
