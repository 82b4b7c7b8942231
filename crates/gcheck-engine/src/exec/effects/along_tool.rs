//! Canned cycles along a tool that is tilted: where they begin, which way they go.
//!
//! Knows: the words of these cycles, the direction of the tool. Must not know: the strokes of one hole ([`crate::cycles`]).
//!
//! Such a cycle begins where the tool is, or at the position of its block, and goes from there by `E` along the tool and
//! back (Haas NGC mill manual 2017, p. 322 to 334). Its strokes are those of the cycle along Z that does the same.

use gcheck_controls::{AlongTool, CodeIx};
use gcheck_geometry::{Mm, Plane};

use crate::assumption::Assumption;
use crate::cycles::{CycleError, Hole, Stroke, hole};
use crate::eval::value::Domain;
use crate::event::{Event, TravelKind};
use crate::exec::context::{Executor, Step};
use crate::fault::{CycleFault, Fault};
use crate::observer::Observer;
use crate::position::Position;
use crate::state::State;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// A block under a cycle along the tool.
    pub(in crate::exec) fn cycle_along_tool(
        &mut self,
        code: CodeIx,
        stroke: AlongTool,
        repeats: u32,
        state: &mut State<D>,
    ) -> Step {
        let mut words = self.lasting_cycle_words(state);
        if !words.has_begun() {
            words.begin(0.0);
        }
        state.cycle = words;
        let has_position = self.words.present().intersects(self.model.axis_letters);
        if !has_position && !self.words.codes().contains(&code) {
            return Ok(());
        }
        if has_position {
            let start = self.target(state)?;
            self.travel(TravelKind::Rapid, start, false, state)?;
        }
        let checked = self.held(self.check_cycle(state))?;
        if self.machine.kinematics.is_none() {
            self.assumptions.insert(Assumption::HeadKinematics);
        }
        self.assumptions.insert(Assumption::UprightTool);
        let start = *state.position();
        // Per millimetre from the tip to the spindle.
        let upward = self.along_tool(1.0, &start);
        let facts = self.hole_along_tool(stroke, state);
        for _ in 0..repeats.min(crate::cycles::MAX_STROKES) {
            if self.gives_too_many() {
                self.leave_strokes_out(start, state);
                break;
            }
            self.stroke_along_tool(stroke, &facts, &start, upward, state)?;
        }
        checked
    }

    /// The hole as along Z, from the start of the cycle at zero.
    fn hole_along_tool(&mut self, stroke: AlongTool, state: &State<D>) -> Hole {
        let facts = self.facts_of_hole(stroke.upright(), state);
        let depth = state.cycle().e;
        Hole {
            plane: Plane::Xy,
            initial: Mm::ZERO,
            r: Mm::ZERO,
            bottom: Mm(-depth),
            return_to_r: true,
            ..facts
        }
    }

    /// One hole. The tool comes back to where it began, whatever is known of the way.
    fn stroke_along_tool(
        &mut self,
        stroke: AlongTool,
        facts: &Hole,
        start: &Position,
        upward: [f64; 3],
        state: &mut State<D>,
    ) -> Step {
        let rules = &self.model.semantics().cycles;
        let mut strokes = std::mem::take(&mut self.stroke_buffer);
        strokes.clear();
        let result = hole(stroke.upright(), facts, [Mm::ZERO; 3], rules, &mut |one| strokes.push(one));
        if matches!(result, Err(CycleError::Unknown)) {
            strokes.clear();
            strokes.extend([Stroke::Feed([Mm::UNKNOWN; 3]), Stroke::Rapid([Mm::ZERO; 3])]);
        }
        for one in &mut strokes {
            if let Stroke::Rapid(to) | Stroke::Feed(to) = one {
                let [_, _, level] = *to;
                *to = place_along(start, upward, level);
            }
        }
        let given_out = self.strokes(&strokes, Plane::Xy, state);
        self.stroke_buffer = strokes;
        given_out?;
        match result {
            Err(CycleError::Fault(fault)) => Err(Fault::Cycle(fault)),
            Err(CycleError::TooManyStrokes) => Err(Fault::Cycle(CycleFault::Geometry)),
            Ok(_) => Ok(()),
            Err(CycleError::Unknown | CycleError::NotThisKind | CycleError::Profile(_)) => {
                self.emit(state, Event::Unfollowed);
                Ok(())
            }
        }
    }
}

/// The point at a level above the start. The start itself is exact, in whatever direction.
fn place_along(start: &Position, upward: [f64; 3], level: Mm) -> [Mm; 3] {
    let [x, y, z] = start.xyz();
    if level == Mm::ZERO {
        return [x, y, z];
    }
    let [by_x, by_y, by_z] = upward.map(|part| Mm(part * level.0));
    [x + by_x, y + by_y, z + by_z]
}
