//! Operations of one block on mills: pockets and hole patterns.
//!
//! Knows: their words, which tool size they count with, which cycle a pattern runs. Must not know: the strokes
//! ([`crate::cycles`]).

use gcheck_controls::{CodeIx, Effect, Letter};
use gcheck_geometry::{Degrees, Mm, MmPerMin, Plane};

use super::lathe::profile::ProfileBlocks;
use crate::assumption::Assumption;
use crate::cycles::{
    CircularPocket, CycleError, GeneralPocket, PocketPlan, ProfileSegment, Stroke, bolt_arc, bolt_circle,
    bolt_line, circular_pocket, general_pocket,
};
use crate::eval::value::Domain;
use crate::event::{Clearing, Event, TravelKind};
use crate::exec::arc::plane_axes;
use crate::exec::context::{Count, Executor, Step};
use crate::fault::{CycleFault, Fault};
use crate::model::Role;
use crate::observer::Observer;
use crate::origin::At;
use crate::position::{Axis, Position};
use crate::state::{Frame, FrameKind, ModeSet, State};

/// An outline as its program was read.
struct ControlFlowGraph {
    /// Its pieces from the start hole on; `None` when they are not all known.
    segments: Option<Vec<ProfileSegment>>,
    /// Increments or positions, as the program leaves them to the blocks after the pocket (Haas NGC mill manual 2017, p. 318).
    distance: ModeSet,
}

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    // ---- pockets ----

    /// `G12`, `G13`: a round pocket from its centre outward.
    pub(in crate::exec) fn circular_pocket(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        let letter = Letter::of('I');
        let first = self.length(letter, state).ok_or(Fault::Cycle(CycleFault::Missing(letter)))?;
        let incremental = state.is_incremental(self.model);
        let rounds = match self.count(Letter::of('L'))? {
            None => 1,
            Some(Count::Known(rounds)) => rounds,
            Some(Count::Unknown) => {
                self.lose_operation(&target, state);
                return Ok(());
            }
        };
        let deeper = match incremental {
            Some(true) => target.raw(Axis::Z) - state.position().raw(Axis::Z),
            Some(false) => 0.0,
            None => f64::NAN,
        };
        let words = CircularPocket {
            centre: (Mm(target.raw(Axis::X)), Mm(target.raw(Axis::Y))),
            first: Mm(first),
            finished: self.length(Letter::of('K'), state).map(Mm),
            step: self.length(Letter::of('Q'), state).map(Mm),
            depth: Mm(target.raw(Axis::Z)),
            deeper: Mm(deeper),
            rounds,
            tool_radius: Mm(self.pocket_tool_radius(state)?),
            clockwise: effect == Effect::CircularPocketClockwise,
        };
        let checked = self.check_feed(state);
        let held = self.hold_compensation(state)?;
        let mut strokes = Vec::new();
        let result = circular_pocket(state.position().xyz(), &words, &mut |stroke| strokes.push(stroke));
        // The tool is left in the centre of the floor, whatever the way there was.
        let mut end = target;
        end.set(Axis::Z, target.raw(Axis::Z) + deeper * f64::from(rounds.saturating_sub(1)));
        let outcome = self.carry_out(&strokes, result, Plane::Xy, end, state);
        Self::release_compensation(held, state);
        outcome?;
        checked
    }

    /// `G150`: a pocket whose outline is a subprogram.
    ///
    /// The way that clears it is the machine's own, so only what is certain is given out: the way to the start hole, the
    /// levels in it, the way back to the rapid level.
    pub(in crate::exec) fn general_pocket(&mut self, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        let letter = Letter::of('P');
        let Some(program) = self.count(letter)? else { return Err(Fault::MissingWord(letter)) };
        let words = self.pocket_words(&target, state)?;
        let checked = self.check_feed(state);
        if state.is_incremental(self.model) != Some(false) {
            return self.pockets_by_increments(&target, state).and(checked);
        }
        let mut start = target;
        start.set(Axis::Z, state.position().raw(Axis::Z));
        let outline = self.outline(program, &start, state)?;
        let plan = outline
            .as_ref()
            .and_then(|outline| outline.segments.as_ref())
            .map_or(Err(CycleError::Unknown), |segments| general_pocket(segments, &words));
        let compensation = state.mode(Role::Compensation).only().unwrap_or(CodeIx::NONE);
        let mut strokes = Vec::new();
        let mut cleared = None;
        if let Ok(plan) = &plan {
            let (x, y) = words.start;
            cleared = Some(clearing(plan, &words, compensation));
            strokes.push(Stroke::Rapid(start.xyz()));
            strokes.push(Stroke::Rapid([x, y, words.r]));
            strokes.extend(plan.levels.iter().map(|level| Stroke::Feed([x, y, *level])));
        }
        let mut end = start;
        end.set(Axis::Z, words.r.0);
        // Compensation belongs to the walls, and is ended by a move afterwards.
        let held = self.hold_compensation(state)?;
        let over_hole = plan.as_ref().ok().map(|plan| plan.end);
        let mut outcome = self.carry_out(&strokes, plan.map(|plan| plan.end), Plane::Xy, end, state);
        if outcome.is_ok()
            && let Some((cleared, over_hole)) = cleared.zip(over_hole)
        {
            self.emit(state, Event::Cleared(Clearing { at: *state.actual(), ..cleared }));
            self.assumptions.insert(Assumption::PocketEnd);
            outcome = self.carry_out(&[Stroke::Rapid(over_hole)], Ok(over_hole), Plane::Xy, end, state);
        }
        Self::release_compensation(held.without_path(), state);
        if let Some(outline) = outline {
            state.modes.put(Role::Distance, outline.distance);
        }
        outcome?;
        checked
    }

    /// The words of `G150`, with the radius of the tool where the pocket is compensated for it.
    fn pocket_words(&mut self, target: &Position, state: &mut State<D>) -> Step<GeneralPocket> {
        let needed = |letter: char| Fault::Cycle(CycleFault::Missing(Letter::of(letter)));
        if !self.words.has(Letter::of('Z')) {
            return Err(needed('Z'));
        }
        let layer = self.length(Letter::of('Q'), state).ok_or(needed('Q'))?;
        let r = match self.length(Letter::of('R'), state) {
            Some(r) => r,
            None => {
                let of_cycle = state.cycle.word('R', state.cycle.r);
                of_cycle.or(state.cycle.pocket_r).ok_or(needed('R'))?
            }
        };
        state.cycle.pocket_r = Some(r);
        let length = |letter: char| self.length(Letter::of(letter), state).map(Mm);
        let mut words = GeneralPocket {
            start: (Mm(target.raw(Axis::X)), Mm(target.raw(Axis::Y))),
            r: Mm(r),
            bottom: Mm(target.raw(Axis::Z)),
            layer: Mm(layer),
            step_x: length('I'),
            step_y: length('J'),
            finish: length('K').unwrap_or(Mm::ZERO),
            tool_radius: Mm::ZERO,
            feed: MmPerMin(D::known(state.feed()).unwrap_or(f64::NAN)),
        };
        match (words.step_x, words.step_y) {
            (Some(_), Some(_)) => return Err(Fault::Conflict),
            (None, None) => return Err(Fault::MissingWord(Letter::of('I'))),
            _ => {}
        }
        if self.compensates(state) {
            words.tool_radius = Mm(self.pocket_tool_radius(state)?);
        }
        Ok(words)
    }

    /// `G91` with `L`: pockets side by side. What their levels count from is not known, where the last one stands is.
    fn pockets_by_increments(&mut self, target: &Position, state: &mut State<D>) -> Step {
        let repeats = match self.count(Letter::of('L'))? {
            None => 1.0,
            Some(Count::Known(repeats)) => f64::from(repeats.max(1)),
            Some(Count::Unknown) => f64::NAN,
        };
        let mut end = *state.position();
        for axis in [Axis::X, Axis::Y] {
            let step = target.raw(axis) - state.position().raw(axis);
            end.set(axis, state.position().raw(axis) + step * if step == 0.0 { 1.0 } else { repeats });
        }
        end.set(Axis::Z, f64::NAN);
        let held = self.hold_compensation(state)?;
        state.points.position = end;
        state.points.actual = self.axes_of(&end, state);
        self.emit(state, Event::Unfollowed);
        Self::release_compensation(held.without_path(), state);
        Ok(())
    }

    /// The outline that a program draws from the start hole on; `None` when the program is not known.
    fn outline(
        &mut self,
        program: Count,
        start: &Position,
        state: &State<D>,
    ) -> Step<Option<ControlFlowGraph>> {
        let Count::Known(number) = program else { return Ok(None) };
        let at = self.origin.at;
        let label =
            self.file(at.file).and_then(|file| file.loaded.flow_graph().label(number, at.block, true));
        let found = label.map(|block| At { file: at.file, block });
        let Some(first) = found.or_else(|| self.program.find_number(number, at.file)) else {
            self.assumptions.insert(Assumption::MissingProgram(number));
            return Ok(None);
        };
        let last =
            self.program.file(first.file).map_or(0, |file| file.loaded.flow_graph().part_of(first.block).end);
        let blocks = ProfileBlocks { file: first.file, first: first.block, last: last.saturating_sub(1) };
        let mut drawn = state.clone();
        drawn.points.position = *start;
        drawn.points.actual = *start;
        // It is read as a called program is.
        let kind = if found.is_some() { FrameKind::Local } else { FrameKind::Subprogram };
        drawn.calls.push(Frame::new(kind, first, at, Some(0)));
        let profile = self.read_profile(blocks, Plane::Xy, &mut drawn)?;
        let mut distance = *drawn.mode(Role::Distance);
        if !profile.complete {
            distance = distance.join(state.mode(Role::Distance));
        }
        Ok(Some(ControlFlowGraph { segments: Some(profile.segments).filter(|_| profile.complete), distance }))
    }

    /// Radius of the tool that `D` names, now or before; 0 for `D0`, NaN unknown.
    fn pocket_tool_radius(&mut self, state: &mut State<D>) -> Step<f64> {
        if let Some(d) = self.words.get(Letter::of('D')) {
            self.count(Letter::of('D'))?;
            state.tool.d = d;
        }
        let Some(number) = D::known(state.d()) else { return Ok(f64::NAN) };
        if number == 0.0 {
            return Ok(0.0);
        }
        #[expect(clippy::cast_sign_loss, reason = "an offset number is a count")]
        let number = number as u32;
        let radius = state.tables().tool(number).map_or(f64::NAN, |tool| tool.size().0 / 2.0);
        if radius.is_nan() {
            self.assumptions.insert(Assumption::ToolRadius(number));
        }
        Ok(radius)
    }

    /// Repeats that nobody knows: the tool ends over the point, at a depth nobody knows.
    fn lose_operation(&mut self, target: &Position, state: &mut State<D>) {
        state.points.position = *target;
        state.points.position.set(Axis::Z, f64::NAN);
        state.points.actual = self.axes_of(state.position(), state);
        self.emit(state, Event::Unfollowed);
    }

    // ---- engraving ----

    /// `G47`: at rapid to the text, down to `Z` at feed `E`, along letters whose shape is the control's own, up to `R`.
    pub(in crate::exec) fn engrave(&mut self, ix: CodeIx, state: &mut State<D>) -> Step {
        self.assumptions.insert(Assumption::Code(ix));
        let target = self.target(state)?;
        let checked = self.held(self.check_feed(state))?;
        let mut at = target;
        at.set(Axis::Z, state.position().raw(Axis::Z));
        self.travel(TravelKind::Rapid, at, true, state)?;
        let cutting = state.feed().clone();
        if let Some(plunge) = self.length(Letter::of('E'), state) {
            state.feed.rate = D::number(plunge);
        }
        let depth = if self.words.has(Letter::of('Z')) { target.raw(Axis::Z) } else { f64::NAN };
        at.set(Axis::Z, depth);
        self.travel(TravelKind::Feed, at, true, state)?;
        state.feed.rate = cutting;
        // Under increments what `R` counts from is in no page.
        let absolute = state.is_incremental(self.model) == Some(false);
        let level = self.length(Letter::of('R'), state).filter(|_| absolute).unwrap_or(f64::NAN);
        let mut end = Position::UNKNOWN;
        for axis in Axis::ALL.into_iter().filter(|axis| !matches!(axis, Axis::X | Axis::Y)) {
            end.set(axis, state.position().raw(axis));
        }
        // Along the text nobody knows where.
        self.travel(TravelKind::Feed, end, true, state)?;
        end.set(Axis::Z, level);
        self.travel(TravelKind::Rapid, end, true, state)?;
        checked
    }

    // ---- patterns ----

    /// `G70`, `G71`, `G72` of mills: the canned cycle at every point of a pattern.
    pub(in crate::exec) fn bolt_pattern(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let plane = Plane::Xy;
        let ([first, second, depth], _) = plane_axes(plane);
        let target = self.target(state)?;
        let centre = (Mm(target.raw(first)), Mm(target.raw(second)));
        let needed = |letter: char| Fault::Cycle(CycleFault::Missing(Letter::of(letter)));
        let size = Mm(self.length(Letter::of('I'), state).ok_or(needed('I'))?);
        let angle = Degrees(self.words.number(Letter::of('J')).unwrap_or(0.0));
        let holes = self.count(Letter::of('L'))?.ok_or(needed('L'))?;
        let between = match effect {
            Effect::BoltArc => Degrees(self.words.number(Letter::of('K')).ok_or(needed('K'))?),
            _ => Degrees(0.0),
        };
        let points: Result<Vec<(Mm, Mm)>, CycleError> = match (holes, effect) {
            (Count::Unknown, _) => Err(CycleError::Unknown),
            (Count::Known(holes), Effect::BoltCircle) => {
                bolt_circle(centre, size, angle, holes).map(Iterator::collect)
            }
            (Count::Known(holes), Effect::BoltArc) => {
                bolt_arc(centre, size, angle, between, holes).map(Iterator::collect)
            }
            (Count::Known(holes), _) => bolt_line(centre, size, angle, holes).map(Iterator::collect),
        };
        let points = match points {
            Ok(points) => points,
            Err(CycleError::Fault(fault)) => return Err(Fault::Cycle(fault)),
            Err(CycleError::TooManyStrokes) => return Err(Fault::Cycle(CycleFault::Geometry)),
            Err(_) => {
                state.points.position.set(first, f64::NAN);
                state.points.position.set(second, f64::NAN);
                state.points.actual = self.axes_of(state.position(), state);
                self.emit(state, Event::Unfollowed);
                return Ok(());
            }
        };
        let Some(cycle) = self.cycle_of_pattern(depth, state)? else {
            // Without a cycle the tool only goes from point to point.
            for (a, b) in points {
                let mut to = *state.position();
                to.set(first, a.0);
                to.set(second, b.0);
                self.travel(TravelKind::Rapid, to, true, state)?;
            }
            return Ok(());
        };
        self.check_cycle(state)?;
        let points = points.into_iter().map(|(a, b)| (a.0, b.0));
        self.drill(cycle, plane, points, state)
    }

    /// The cycle in effect, or the one that the block names itself: `I`, `J`, `K` and `L` are the pattern's.
    fn cycle_of_pattern(&mut self, depth: Axis, state: &mut State<D>) -> Step<Option<Effect>> {
        let is_cycle = |ix: &CodeIx| self.model.role(*ix) == Some(Role::Cycle);
        let named = self.words.codes().iter().copied().find(is_cycle);
        if let Some(ix) = named.filter(|ix| self.model.effect(*ix) != Effect::CycleCancel) {
            let effect = self.model.effect(ix);
            let kept = *state.cycle();
            self.cycle_words(effect, depth, state)?;
            state.cycle.take_back_ijk(&kept);
            return Ok(Some(effect));
        }
        let cycle = state.active_cycle(self.model);
        if cycle.is_none() {
            // Whether there is one, and which, is not known.
            state.points.lose();
            self.emit(state, Event::Unfollowed);
        }
        Ok(cycle.filter(|ix| ix.is_some()).map(|ix| self.model.effect(ix)))
    }
}

/// A pocket that the control clears by a plan, wherever the tool is left.
fn clearing(plan: &PocketPlan, words: &GeneralPocket, compensation: CodeIx) -> Clearing {
    let depth = words.r - words.bottom;
    let length = plan.cut_length - depth;
    Clearing {
        from: plan.low,
        to: plan.high,
        levels: plan.levels.len() as u32,
        length,
        seconds: length / words.feed,
        counter_clockwise: plan.counter_clockwise,
        compensation,
        at: Position::UNKNOWN,
    }
}
