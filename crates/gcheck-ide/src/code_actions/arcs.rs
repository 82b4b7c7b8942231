//! Arcs by radius and by centre, one written as the other.
//!
//! Knows: which words say an arc's shape. Must not know: how arcs are computed (the engine does).

use gcheck_controls::{Effect, LetterSet};
use gcheck_db::{BlockPlace, Cancelled, Database, DocumentId, Snapshot, StateAt};
use gcheck_diagnostics::Edit;
use gcheck_engine::{ArcMove, At, Event, Look, Model, Role, Transform};
use gcheck_program::{BlockFlags, Word};

use super::action::{CodeAction, Offer};
use super::points::pointed;
use crate::lexemes::touches;
use crate::state_at::look_at;
use crate::state_reader::StateReader;

/// Offers to write the arc at a place the other way.
pub(super) fn offer(
    database: &mut Database,
    document: DocumentId,
    snapshot: &Snapshot,
    offset: u32,
    stop: &dyn Fn() -> bool,
    actions: &mut Vec<CodeAction>,
) -> Result<(), Cancelled> {
    let Some(place) = snapshot.block_at(offset).filter(|place| touches(&place.range(), offset)) else {
        return Ok(());
    };
    let block = place.block();
    let shaped = LetterSet::of("IJKR");
    if !block.letters.intersects(shaped)
        || block.flags.intersects(BlockFlags::ERROR | BlockFlags::STATEMENT | BlockFlags::EXPRESSION)
    {
        return Ok(());
    }
    look_at(database, document, place.number, stop, &mut |state, look| {
        actions.extend(rewritten(snapshot, &place, state, look));
    })
}

fn rewritten(
    snapshot: &Snapshot,
    place: &BlockPlace,
    state: &StateAt,
    look: &mut Look<'_, '_>,
) -> Option<CodeAction> {
    let model = look.model();
    let before = &state.before;
    let trial = look.execute(At { file: 0, block: place.number }, before);
    let mut moves = trial.events.iter().filter(|event| {
        matches!(event, Event::Arc(_) | Event::Travel(_) | Event::Curve(_) | Event::RigidTap { .. })
    });
    let Some(Event::Arc(arc)) = moves.next().filter(|_| trial.fault.is_none()) else { return None };
    let after = trial.after.as_ref()?;
    // Where programmed and work coordinates are not one, the words of the arc are not those of its event.
    let is_plain = *after.transform() == Transform::NONE
        && [(Role::Compensation, Effect::CompensationOff), (Role::Polar, Effect::PolarOff)].into_iter().all(
            |(role, off)| {
                let mode = after.mode(role).only();
                mode.is_some_and(|code| !code.is_some() || model.effect(code) == off)
            },
        );
    if moves.next().is_some() || arc.expanded || !is_plain || arc.turns.abs() > 1 {
        return None;
    }
    let reader = StateReader::new(snapshot, model);
    let words = place.table.words(place.block());
    let written = |letters: LetterSet| -> Vec<&Word> {
        words.iter().filter(|word| letters.contains(word.letter) && !word.letter.is_corner()).collect()
    };
    let (first, second, _) = arc.plane.axes();
    let centre_letters: Option<[char; 2]> =
        ['I', 'J', 'K'].get(first).zip(['I', 'J', 'K'].get(second)).map(|(a, b)| [*a, *b]);
    let centre_letters = centre_letters?;
    let in_program = 1.0 / reader.units(after).in_mm();
    let shape = Shape::of(arc)?;
    let radius_words = written(LetterSet::of("R"));
    let centre_words = written(LetterSet::of("IJK"));
    let decimals = least_decimals(snapshot, &reader, after);
    match (radius_words.as_slice(), centre_words.as_slice()) {
        ([radius], []) => {
            let is_absolute = after.effect(Role::ArcCentre, model) == Some(Effect::ArcCentreAbsolute);
            let texts = shape.centre_words(centre_letters, is_absolute, (in_program, decimals), model)?;
            let edit = Edit { range: place.in_file(radius.range()), text: texts.join(" ") };
            Some(CodeAction::change("Write this arc with its centre", Offer::ArcByCentre, vec![edit]))
        }
        ([], [first, rest @ ..]) => {
            let radius = shape.radius_word(arc.sweep.abs(), (in_program, decimals))?;
            let mut edits =
                vec![Edit { range: place.in_file(first.range()), text: format!("R{}", pointed(radius)) }];
            for word in rest {
                let mut range = place.in_file(word.range());
                // The blank in front goes with its word.
                if snapshot.slice(range.start.saturating_sub(1)..range.start) == " " {
                    range.start -= 1;
                }
                edits.push(Edit { range, text: String::new() });
            }
            Some(CodeAction::change("Write this arc with its radius", Offer::ArcByRadius, edits))
        }
        _ => None,
    }
}

/// An arc in its plane, millimetres.
struct Shape {
    start: [f64; 2],
    end: [f64; 2],
    centre: [f64; 2],
    radius: f64,
}

impl Shape {
    /// The words of its centre, in program units and to so many decimals; `None` when the control would not accept the arc with
    /// the rounded words.
    fn centre_words(
        &self,
        letters: [char; 2],
        is_absolute: bool,
        (in_program, decimals): (f64, i32),
        model: &Model<'_>,
    ) -> Option<Vec<String>> {
        let values = if is_absolute {
            self.centre
        } else {
            [self.centre[0] - self.start[0], self.centre[1] - self.start[1]]
        };
        let values = values.map(|value| rounded(value * in_program, decimals));
        // Rounded words must still be the arc that the control accepts.
        let exact = if is_absolute { [0.0; 2] } else { self.start };
        let centre = [exact[0] + values[0] / in_program, exact[1] + values[1] / in_program];
        let reach = |point: [f64; 2]| (point[0] - centre[0]).hypot(point[1] - centre[1]);
        let rules = &model.semantics().arcs;
        let difference = (reach(self.start) - reach(self.end)).abs();
        if difference > rules.radius_difference.max(rules.relative * self.radius) {
            return None;
        }
        let mut texts: Vec<String> =
            letters.iter().zip(values).map(|(letter, value)| format!("{letter}{}", pointed(value))).collect();
        texts.sort();
        Some(texts)
    }

    /// The word of its radius, negative beyond a half circle; `None` when a radius does not hold the centre.
    fn radius_word(&self, sweep: f64, (in_program, decimals): (f64, i32)) -> Option<f64> {
        // A full circle has no radius form, and near a half circle a radius does not hold the centre.
        let half = (sweep - std::f64::consts::PI).abs();
        if sweep > 2.0 * std::f64::consts::PI - 0.01 || half < 0.01 || sweep < 0.01 {
            return None;
        }
        let radius = rounded(self.radius * in_program, decimals);
        Some(if sweep > std::f64::consts::PI { -radius } else { radius })
    }

    /// `None` when anything of it is unknown.
    fn of(arc: &ArcMove) -> Option<Self> {
        let local = |position: &gcheck_engine::Position| {
            let [first, second, _] = arc.plane.to_local(position.xyz());
            [first.0, second.0]
        };
        let (start, end, centre) = (local(&arc.from), local(&arc.to), [arc.centre.0.0, arc.centre.1.0]);
        let radius = (start[0] - centre[0]).hypot(start[1] - centre[1]);
        let is_known = start.iter().chain(&end).chain(&centre).all(|value| value.is_finite());
        is_known.then_some(Self { start, end, centre, radius })
    }
}

/// Decimals that the control resolves.
fn least_decimals(
    snapshot: &Snapshot,
    reader: &StateReader<'_>,
    state: &gcheck_engine::State<gcheck_engine::Abstract>,
) -> i32 {
    let numbers = snapshot.control().numbers();
    let least = match reader.units(state) {
        gcheck_engine::Units::Inch => numbers.least_inch,
        gcheck_engine::Units::Mm => numbers.least_mm,
    };
    (-least.log10()).round().clamp(0.0, 6.0) as i32
}

fn rounded(value: f64, decimals: i32) -> f64 {
    let scale = 10_f64.powi(decimals);
    (value * scale).round() / scale + 0.0
}
