//! Canned cycles: which words count, where the holes are, how the strokes go out.
//!
//! Knows: words that stay from block to block, repeats, incremental levels. Must not know: the strokes of one hole ([`crate::cycles`]).

use gcheck_controls::{CodeIx, DwellWord, Effect, Letter, LetterSet, Need};
use gcheck_geometry::{Mm, Plane, Seconds, sweep_about};

use crate::assumption::Assumption;
use crate::cycles::{CycleError, Hole, Overrides, Stroke, hole};
use crate::eval::value::{Domain, Truth};
use crate::event::{ArcMove, Event, FeedMode, Override, PathMode, Spindle, Stop, TravelKind, Units};
use crate::exec::arc::plane_axes;
use crate::exec::context::{Count, Executor, Step};
use crate::fault::{CycleFault, Fault};
use crate::lattice::{Flat, Lattice, Perhaps};
use crate::model::Role;
use crate::model::contract::POLAR;
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::{CycleWords, State};

#[expect(clippy::unnecessary_wraps, reason = "handlers of effects share one signature")]
#[expect(clippy::unused_self, reason = "the parts of a step read as its methods")]
impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// A block under a canned cycle.
    pub(in crate::exec) fn cycle(&mut self, code: CodeIx, state: &mut State<D>) -> Step {
        let effect = self.model.effect(code);
        let rules = &self.model.semantics().cycles;
        let names_code = self.words.codes().contains(&code);
        self.check_primary_plane(code, state)?;
        let plane = if self.model.drills_across(code) {
            Some(Plane::Yz)
        } else if rules.all_planes {
            state.plane(self.model)
        } else {
            Some(Plane::Xy)
        };
        let Some(plane) = plane else { return self.lose_cycle(state) };
        let ([first, second, depth], _) = plane_axes(plane);
        let has_point = self.words.has(first.letter()) || self.words.has(second.letter());
        let has_point = has_point || self.words.present().intersects(POLAR);
        // A turn of the work brings another hole, and so do increments that have their own addresses.
        let has_point = has_point || !self.refuses_incomplete() && self.names_other_axis(depth);
        let has_words = has_point || self.names_axis(depth) || self.words.present().intersects(POLAR);
        if !matches!(effect, Effect::CycleAlongTool(_))
            && let Err(fault) = self.cycle_words(effect, depth, state)
        {
            self.skip_to_hole([first, second], state)?;
            return Err(fault);
        }
        // The letter may be one of a length elsewhere; here it counts as it is written.
        let repeat = self.raw(Letter::of(rules.repeat), state);
        let repeats = match repeat.map(|n| Self::whole(Letter::of(rules.repeat), n)).transpose()? {
            None => Some(1),
            Some(Count::Known(n)) => Some(n),
            Some(Count::Unknown) => {
                self.refuse(Fault::Undecidable)?;
                None
            }
        };
        if repeats == Some(0) && self.refuses_incomplete() {
            return Err(Fault::Cycle(CycleFault::ZeroRepeats));
        }
        if let Effect::CycleAlongTool(stroke) = effect {
            return self.cycle_along_tool(code, stroke, repeats.unwrap_or(1), state);
        }
        if rules.needs_axis && !has_words && !names_code {
            return if self.refuses_incomplete() { Err(Fault::NoAxisWords) } else { Ok(()) };
        }
        if names_code && !has_point && rules.needs_axis && self.waits_for_point() {
            return Ok(());
        }
        let runs_here = names_code && self.runs_without_point();
        if !(rules.needs_axis || has_point || runs_here) {
            return Ok(());
        }
        self.check_cycle(state)?;
        let drilled = self.holes(effect, plane, repeats.unwrap_or(1), state);
        if repeats.is_none() {
            self.lose_end_of_row(plane, state);
        }
        drilled
    }

    /// Nobody knows how many holes a row has: its first one is drilled, and where its increments lead is not known.
    fn lose_end_of_row(&mut self, plane: Plane, state: &mut State<D>) {
        let ([first, second, depth], _) = plane_axes(plane);
        let is_absolute = state.is_incremental(self.model) == Some(false);
        let present = self.words.present();
        let named = present.iter().filter_map(|letter| self.model.axis_of(letter));
        let mut moved: Vec<Axis> = named
            .filter(|(axis, is_increment)| *axis != depth && (*is_increment || !is_absolute))
            .map(|(axis, _)| axis)
            .collect();
        if present.intersects(POLAR) {
            moved.extend([first, second]);
        }
        if moved.is_empty() {
            return;
        }
        let mut end = *state.position();
        for axis in moved {
            end.set(axis, f64::NAN);
        }
        self.end_unfollowed(end, state);
    }

    /// A first block without a point may drill where the tool stands: a setting decides where there is one.
    fn runs_without_point(&mut self) -> bool {
        match self.model.control().setting("28") {
            Some(_) => self.setting("28").is_none_or(|value| value == "on" || value == "true"),
            None => true,
        }
    }

    /// Is the setting told that a first block without a point makes no hole?
    fn waits_for_point(&self) -> bool {
        let told = self.machine.settings.get("28").filter(|_| self.model.control().setting("28").is_some());
        told.is_some_and(|value| value == "off" || value == "false")
    }

    /// What cycles need of the state, on controls that refuse them without.
    pub(in crate::exec) fn check_cycle(&self, state: &State<D>) -> Step {
        if self.refuses_incomplete() {
            if self.compensates(state) {
                return Err(Fault::Cycle(CycleFault::Compensated));
            }
            if state.feed_mode(self.model) == Some(FeedMode::InverseTime) {
                return Err(Fault::Cycle(CycleFault::InverseTime));
            }
            if ['A', 'B', 'C'].into_iter().any(|l| self.words.has(Letter::of(l))) {
                return Err(Fault::Cycle(CycleFault::Rotary));
            }
        }
        if D::known(state.feed()) == Some(0.0) {
            return Err(Fault::NoFeed);
        }
        Ok(())
    }

    /// Cycles that stop the spindle or turn it round need one that turns, and taps one that turns the right way, where the
    /// control looks at it.
    fn check_cycle_spindle(
        &self,
        effect: Effect,
        rules: &gcheck_controls::CycleRules,
        state: &State<D>,
    ) -> Step {
        let wanted = match effect {
            Effect::CycleTap => Some(Spindle::Clockwise),
            Effect::CycleLeftTap => Some(Spindle::CounterClockwise),
            Effect::CycleBoreStop
            | Effect::CycleBackBore
            | Effect::CycleBoreManual
            | Effect::CycleBoreDwellManual => None,
            _ => return Ok(()),
        };
        let Some(spindle) = state.spindle() else { return Ok(()) };
        if self.leaves_to_rules() || !self.refuses_incomplete() || !rules.tap_needs_spindle {
            return Ok(());
        }
        match wanted {
            _ if spindle == Spindle::Stopped => Err(Fault::SpindleStopped),
            Some(wanted) if wanted != spindle => Err(Fault::SpindleDirection),
            _ => Ok(()),
        }
    }

    /// The words of the series, with those of the block that stay in effect and are no levels.
    pub(in crate::exec) fn lasting_cycle_words(&mut self, state: &State<D>) -> CycleWords {
        let unit = self.unit(state);
        let rules = &self.model.semantics().cycles;
        let mut words = *state.cycle();
        // On strict controls -1 stands for no number.
        let none = |value: f64| self.refuses_incomplete() && (value + 1.0).abs() < f64::EPSILON;
        for letter in self.words.present().and(LetterSet::of("RZQPIJKEXY")).iter() {
            let is_none =
                matches!(letter.ascii(), b'P' | b'Q') && self.words.number(letter).is_some_and(none);
            if letter != Letter::of(rules.repeat) && !is_none {
                words.give(letter);
            }
        }
        let put = |letter: char, slot: &mut f64, scale: f64| {
            if let Some(value) =
                self.words.number(Letter::of(letter)).filter(|value| letter != 'Q' || !none(*value))
            {
                *slot = value * scale;
            }
        };
        put('Q', &mut words.q, unit);
        let repeat = rules.repeat;
        let [i, j, k] = &mut words.ijk;
        for (letter, slot) in [('I', i), ('J', j), ('K', k)] {
            if letter != repeat {
                put(letter, slot, unit);
            }
        }
        put('E', &mut words.e, unit);
        if let Some(p) = self.words.number(Letter::of('P')).filter(|p| !none(*p)) {
            let milliseconds = match self.model.semantics().dwell.get("P") {
                Some(DwellWord::Milliseconds) => true,
                Some(DwellWord::SecondsOrMilliseconds) => !self.words.is_pointed(Letter::of('P')),
                _ => false,
            };
            words.p = if milliseconds { p / 1000.0 } else { p };
            words.last_dwell = Some(words.p);
        }
        words
    }

    /// Keeps the words of the block that stay in effect.
    pub(in crate::exec) fn cycle_words(&mut self, effect: Effect, depth: Axis, state: &mut State<D>) -> Step {
        let rules = &self.model.semantics().cycles;
        // Of a tap `J` is a number, not a length: how many times faster it comes out.
        let taps = effect.is_tapping_cycle();
        let times_out =
            rules.tap_out_setting.as_ref().filter(|_| taps).and_then(|_| self.raw(Letter::of('J'), state));
        let mut words = self.lasting_cycle_words(state);
        if let Some(times) = times_out {
            let [_, j, _] = &mut words.ijk;
            *j = times;
        }
        if !words.has_begun() {
            words.begin(state.position().raw(depth));
        }
        let relative = match state.is_incremental(self.model) {
            Some(incremental) => incremental && rules.incremental_r,
            None => return self.unknown_levels(words, state),
        };
        // Levels along X are diameters where X is; `R` is a radius as a distance, and where cycles drill in any plane.
        let half = match state.is_diameter(self.model) {
            _ if depth != Axis::X => 1.0,
            Some(true) => 0.5,
            Some(false) => 1.0,
            None => f64::NAN,
        };
        let level = |letter: Letter| self.length(letter, state).map(|value| value * half);
        let r = Letter::of('R');
        let retract = if rules.r_is_distance || rules.all_planes { self.length(r, state) } else { level(r) };
        let bottom = level(depth.letter());
        let [given_r, given_z] = &mut words.given;
        *given_r = retract.unwrap_or(*given_r);
        *given_z = bottom.unwrap_or(*given_z);
        // Words that stay are counted again in every block by some controls, as they are. For others levels stay: an
        // increment counts in the block that gives it, and the level stays where it led.
        let counted = if rules.rise_to_r { (Some(*given_r), Some(*given_z)) } else { (retract, bottom) };
        if let Some(level) = counted.0 {
            words.r = if relative || rules.r_is_distance { words.initial + level } else { level };
        } else if words.word('R', words.r).is_none() && self.starts_without_r(state) {
            words.r = words.initial;
        }
        if let Some(level) = counted.1 {
            words.z = if relative { words.r + level } else { level };
        }
        let increment =
            self.words.present().iter().find(|letter| self.model.axis_of(*letter) == Some((depth, true)));
        if let Some(way) = increment.and_then(level) {
            words.z = way + if rules.r_is_distance { words.r } else { words.initial };
            words.give(depth.letter());
        }
        state.cycle = words;
        if words.word('R', words.r).is_none() && !self.starts_without_r(state) {
            return Err(Fault::Cycle(CycleFault::Missing(Letter::of('R'))));
        }
        if words.word(depth.name(), words.z).is_none() && effect != Effect::CycleCancel {
            return Err(Fault::Cycle(CycleFault::Missing(depth.letter())));
        }
        Ok(())
    }

    /// Without `R` the cycle in effect begins at the level of the tool, as in examples of the Haas NGC mill manual of 2017
    /// (p. 128, 130 and 233), though p. 245 asks for the word.
    fn starts_without_r(&self, state: &State<D>) -> bool {
        let cycle = state.active_cycle(self.model).and_then(|ix| self.model.control().code_at(ix));
        let word = cycle.and_then(|code| code.entry().words.iter().find(|word| word.letter == "R"));
        word.is_some_and(|word| word.need == Need::Optional || word.default.is_some())
    }

    /// Does the block name an axis beside the one of depth, in whatever way?
    fn names_other_axis(&self, depth: Axis) -> bool {
        let axes = self.words.present().iter().filter_map(|letter| self.model.axis_of(letter));
        axes.into_iter().any(|(axis, _)| axis != depth)
    }

    /// Absolute or incremental is not known, and so are the levels.
    fn unknown_levels(&mut self, mut words: CycleWords, state: &mut State<D>) -> Step {
        (words.r, words.z) = (f64::NAN, f64::NAN);
        state.cycle = words;
        Ok(())
    }

    /// The tool goes to the hole's place though the cycle is refused, so that what follows is judged from there.
    fn skip_to_hole(&mut self, plane: [Axis; 2], state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        for axis in plane {
            state.points.position.set(axis, target.raw(axis));
        }
        state.points.actual = self.axes_of(state.position(), state);
        Ok(())
    }

    /// A cycle whose geometry is not followed: the axes it names end at its point, the depth nobody knows where.
    fn lose_cycle(&mut self, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        state.points.position = target;
        state.points.position.set(Axis::Z, f64::NAN);
        if state.plane(self.model).is_none() {
            // Any of the three may be the axis of depth.
            state.points.position.set(Axis::X, f64::NAN);
            state.points.position.set(Axis::Y, f64::NAN);
        }
        state.points.actual = self.axes_of(state.position(), state);
        self.emit(state, Event::Unfollowed);
        Ok(())
    }

    fn holes(&mut self, effect: Effect, plane: Plane, repeats: u32, state: &mut State<D>) -> Step {
        let ([first, second, depth], _) = plane_axes(plane);
        let incremental = state.is_incremental(self.model);
        let target = self.target(state)?;
        let present = self.words.present();
        // Where the repeats of an axis count from, and how far each goes on.
        let way = |axis: Axis| {
            let here = state.position().raw(axis);
            let has_own = present.iter().any(|letter| self.model.axis_of(letter) == Some((axis, true)));
            match incremental {
                Some(false) if !has_own => (target.raw(axis), 0.0),
                _ if has_own || self.words.has(axis.letter()) => (here, target.raw(axis) - here),
                _ => (here, 0.0),
            }
        };
        if repeats == 0 && self.model.semantics().cycles.zero_repeats_move {
            return self.pass_hole(target, depth, state);
        }
        let ((first_start, along), (second_start, across)) = (way(first), way(second));
        let start = (first_start, second_start);
        let most = repeats.min(crate::cycles::MAX_STROKES);
        if state.effect(Role::Polar, self.model) == Some(Effect::PolarOn) && incremental != Some(false) {
            let here = (state.position().raw(first), state.position().raw(second));
            let to = (target.raw(first), target.raw(second));
            return self.holes_around(effect, plane, here, to, most, state);
        }
        if present.intersects(POLAR) {
            let points = self.polar_holes(&target, most, state);
            return self.drill(effect, plane, points.into_iter(), state);
        }
        let turned = [Axis::A, Axis::B, Axis::C].map(|axis| (axis, way(axis)));
        let turned = turned.into_iter().filter(|(axis, (from, step))| {
            *step != 0.0 || from.to_bits() != state.position().raw(*axis).to_bits()
        });
        let turned: Vec<_> = turned.collect();
        // Step by step: a product would differ in the last bit.
        let mut at = start;
        let points = (0..most).map(move |_| {
            at = (at.0 + along, at.1 + across);
            at
        });
        if turned.is_empty() {
            return self.drill(effect, plane, points, state);
        }
        for (index, at) in points.enumerate() {
            if self.gives_too_many() {
                let mut end = *state.position();
                for axis in turned.iter().map(|(axis, _)| *axis).chain([first, second, depth]) {
                    end.set(axis, f64::NAN);
                }
                self.leave_strokes_out(end, state);
                break;
            }
            let mut to = *state.position();
            to.set(first, at.0);
            to.set(second, at.1);
            for (axis, (from, step)) in &turned {
                let turn = if index == 0 { *from } else { to.raw(*axis) };
                to.set(*axis, turn + step);
            }
            self.travel(TravelKind::Rapid, to, true, state)?;
            self.drill(effect, plane, std::iter::once(at), state)?;
        }
        Ok(())
    }

    /// Holes by `@` and `^`: at one place, or each so much farther from the origin and around it than the one before.
    fn polar_holes(&self, target: &Position, count: u32, state: &State<D>) -> Vec<(f64, f64)> {
        let to = (target.raw(Axis::X), target.raw(Axis::Y));
        if state.is_incremental(self.model) == Some(false) {
            return (0..count).map(|_| to).collect();
        }
        let here = state.position();
        let (mut radius, mut angle) = (
            here.raw(Axis::X).hypot(here.raw(Axis::Y)),
            here.raw(Axis::Y).atan2(here.raw(Axis::X)).to_degrees(),
        );
        let farther = self.words.number(Letter::AT).map_or(0.0, |by| by * self.unit(state));
        let around = self.words.number(Letter::CARET).unwrap_or(0.0);
        let mut holes = Vec::new();
        for _ in 0..count {
            (radius, angle) = (radius + farther, angle + around);
            let (sin, cos) = angle.to_radians().sin_cos();
            holes.push((radius * cos, radius * sin));
        }
        holes
    }

    /// `L0`: to the place of a hole that is not made.
    fn pass_hole(&mut self, target: Position, depth: Axis, state: &mut State<D>) -> Step {
        let mut to = target;
        to.set(depth, state.position().raw(depth));
        let moves =
            Axis::ALL.into_iter().any(|axis| to.raw(axis).to_bits() != state.position().raw(axis).to_bits());
        if moves { self.travel(TravelKind::Rapid, to, true, state) } else { Ok(()) }
    }

    /// Holes at increments of a polar angle: each is turned about the origin as the first one is from where the tool stands.
    fn holes_around(
        &mut self,
        effect: Effect,
        plane: Plane,
        start: (f64, f64),
        first: (f64, f64),
        count: u32,
        state: &mut State<D>,
    ) -> Step {
        let by = first.1.atan2(first.0) - start.1.atan2(start.0);
        let points = (0..count).map(move |turn| {
            let (sin, cos) = (by * f64::from(turn)).sin_cos();
            (first.0 * cos - first.1 * sin, first.0 * sin + first.1 * cos)
        });
        self.drill(effect, plane, points, state)
    }

    /// The active cycle at every point, in the plane's first and second axis. Without points only its rise to `R` is made.
    pub(in crate::exec) fn drill(
        &mut self,
        effect: Effect,
        plane: Plane,
        points: impl ExactSizeIterator<Item = (f64, f64)>,
        state: &mut State<D>,
    ) -> Step {
        let rules = &self.model.semantics().cycles;
        let facts = self.facts_of_hole(effect, state);
        // Without a point the cycle is kept for a pattern that follows; the tool goes nowhere.
        let mut result = Ok(());
        let mut points = points.enumerate();
        while let Some((turn, at)) = points.next() {
            if self.gives_too_many() {
                let (_, last) = points.last().unwrap_or((turn, at));
                let ([first, second, depth], _) = plane_axes(plane);
                let mut end = *state.position();
                for (axis, number) in [(first, last.0), (second, last.1), (depth, f64::NAN)] {
                    end.set(axis, number);
                }
                self.leave_strokes_out(end, state);
                break;
            }
            let facts = Hole { plane, at: (Mm(at.0), Mm(at.1)), first_of_block: turn == 0, ..facts };
            result = self.hole(effect, &facts, plane, rules, state);
            if result.is_err() {
                break;
            }
        }
        if result.is_ok() || self.lenient {
            self.end_exact_path(state);
        }
        result
    }

    /// What the words of the series and the modes say of each hole, which is at zero here.
    pub(in crate::exec) fn facts_of_hole(&mut self, effect: Effect, state: &State<D>) -> Hole {
        let incremental = state.is_incremental(self.model);
        let rules = &self.model.semantics().cycles;
        let words = *state.cycle();
        let [i, j, k] = words.ijk;
        let (r, bottom) = if incremental.is_none() { (f64::NAN, f64::NAN) } else { (words.r, words.z) };
        let taps = effect.is_tapping_cycle();
        let dwell = if taps && rules.rise_to_r { words.last_dwell } else { words.word('P', words.p) };
        let (clearance, above_r) = self.settings_of_pecks(effect, state);
        let shift = [words.word('I', i), words.word('J', j), words.word('K', k)].map(|word| word.map(Mm));
        let (peck, ijk) = self.shift_of_bore(effect, words.word('Q', words.q).map(Mm), shift);
        // Pecks and shifts keep their size under scaling, which comes over the strokes.
        let unscaled = |length: Mm| Mm(length.0 / state.transform.common_factor());
        let (peck, ijk) = if state.transform.is_off() {
            (peck, ijk)
        } else {
            (peck.map(unscaled), ijk.map(|word| word.map(unscaled)))
        };
        Hole {
            plane: Plane::Xy,
            at: (Mm::ZERO, Mm::ZERO),
            initial: Mm(words.initial),
            r: Mm(r),
            bottom: Mm(bottom),
            dwell: dwell.map(Seconds),
            peck,
            ijk,
            incremental: incremental == Some(true),
            return_to_r: state.effect(Role::ReturnLevel, self.model) == Some(Effect::ReturnToR),
            first_of_block: true,
            overrides: Overrides {
                feed: state.feed.overridable != Truth::False || words.feed_override_on != Truth::False,
                speed: state.spindle.overridable != Truth::False,
            },
            clearance,
            above_r,
            tap_out: if taps { self.tap_out(words.word('J', j)) } else { 1.0 },
            units: state.units(self.model).unwrap_or(Units::Mm),
        }
    }

    /// What settings say of pecks: how far they back off, where that is told, and how far above `R` they come out.
    fn settings_of_pecks(&mut self, effect: Effect, state: &State<D>) -> (Option<Mm>, Mm) {
        if !effect.pecks() {
            return (None, Mm::ZERO);
        }
        if let Some(number) = &self.model.semantics().cycles.clearance_setting {
            // Nobody told it where it is assumed: then it is how far pecks back off.
            self.setting(number);
        }
        self.machine.settings_of_pecks(&self.model.semantics().cycles, self.unit(state))
    }

    /// How many times faster a tap comes out: its `J`, else the setting; a number of one or less changes nothing.
    fn tap_out(&self, times: Option<f64>) -> f64 {
        let Some(number) = &self.model.semantics().cycles.tap_out_setting else { return 1.0 };
        let set = || self.machine.setting(self.model.control(), number)?.parse::<f64>().ok();
        match times.or_else(set) {
            // An unknown number makes the speed unknown.
            Some(times) if times > 1.0 || times.is_nan() => times,
            _ => 1.0,
        }
    }

    /// `Q` and `I J K` as a bore shifts by them: where a setting gives the direction of `Q`, it is told as `I` or `J`, and
    /// these count only without `Q`.
    fn shift_of_bore(
        &mut self,
        effect: Effect,
        q: Option<Mm>,
        ijk: [Option<Mm>; 3],
    ) -> (Option<Mm>, [Option<Mm>; 3]) {
        let bores = effect.shifts_boring_bar();
        let Some(number) = self.model.semantics().cycles.shift_setting.as_deref().filter(|_| bores) else {
            return (q, ijk);
        };
        match q {
            None => (None, ijk),
            Some(length) if length < Mm::ZERO => (q, [None; 3]),
            Some(length) => {
                let way = self.setting(number).unwrap_or("x+").to_ascii_lowercase();
                let length = if way.contains('-') { -length } else { length };
                let along = |axis: char| way.contains(axis).then_some(length);
                (None, [along('x'), along('y'), along('z')])
            }
        }
    }

    fn hole(
        &mut self,
        effect: Effect,
        facts: &Hole,
        plane: Plane,
        rules: &gcheck_controls::CycleRules,
        state: &mut State<D>,
    ) -> Step {
        let from = state.position().xyz();
        let mut strokes = std::mem::take(&mut self.stroke_buffer);
        strokes.clear();
        let mut result = hole(effect, facts, from, rules, &mut |stroke| strokes.push(stroke));
        let is_known =
            from.iter().chain([&facts.initial, &facts.at.0, &facts.at.1]).all(|length| length.is_known());
        if !is_known {
            // Where it begins decides whether it rises first.
            self.emit(state, Event::Unfollowed);
        }
        if result.is_ok() && state.mode(Role::ReturnLevel).only().is_none() && facts.initial != facts.r {
            strokes.clear();
            result = Err(CycleError::Unknown);
        }
        if result.is_ok()
            && let Err(fault) = self.check_cycle_spindle(effect, rules, state)
        {
            strokes.clear();
            // The way to the hole is that of any cycle.
            let _ = hole(Effect::CycleDrill, facts, from, rules, &mut |stroke| strokes.push(stroke));
            let is_way = |stroke: &Stroke| matches!(stroke, Stroke::Rapid(_) | Stroke::ExactPath);
            strokes.truncate(strokes.iter().take_while(|stroke| is_way(stroke)).count());
            self.strokes(&strokes, plane, state)?;
            return Err(fault);
        }
        if self.options.past_alarms && matches!(result, Err(CycleError::Fault(_))) {
            // A cycle that lacks a word is drawn as the plainest one.
            strokes.clear();
            if let Ok(end) = hole(Effect::CycleDrill, facts, from, rules, &mut |stroke| strokes.push(stroke))
            {
                state.points.position = state.position().with_xyz(end);
            }
        }
        let given_out = self.strokes(&strokes, plane, state);
        self.stroke_buffer = strokes;
        given_out?;
        match result {
            Ok(end) => {
                state.points.position = state.position().with_xyz(end);
                state.points.actual = self.axes_of(state.position(), state);
                Ok(())
            }
            Err(CycleError::Fault(fault)) => Err(Fault::Cycle(fault)),
            Err(CycleError::Profile(_)) => Err(Fault::Profile),
            Err(CycleError::TooManyStrokes) => Err(Fault::Cycle(CycleFault::Geometry)),
            Err(CycleError::Unknown | CycleError::NotThisKind) => {
                let mut end = *state.position();
                let ([first, second, depth], _) = plane_axes(plane);
                end.set(first, facts.at.0.0);
                end.set(second, facts.at.1.0);
                end.set(depth, f64::NAN);
                self.end_unfollowed(end, state);
                Self::lose_switches(effect, state);
                Ok(())
            }
        }
    }

    /// Has the block given out as many strokes as one may?
    pub(in crate::exec) fn gives_too_many(&self) -> bool {
        self.strokes_given - self.strokes_before >= u64::from(crate::cycles::MAX_STROKES)
    }

    /// The other strokes of the cycle are not computed: it ends at a point.
    pub(in crate::exec) fn leave_strokes_out(&mut self, end: Position, state: &mut State<D>) {
        if let Some(cycle) = state.mode(Role::Cycle).only().filter(|code| code.is_some()) {
            self.assumptions.insert(Assumption::Passes(cycle));
        }
        self.end_unfollowed(end, state);
    }

    /// What a block does on the way is not followed: it ends at a point.
    pub(in crate::exec) fn end_unfollowed(&mut self, end: Position, state: &mut State<D>) {
        if !state.compensation.left.is_no() {
            // Whether a move leaves the path that was compensated is not known either.
            state.compensation.left = Perhaps::Unknown;
        }
        state.points.position = end;
        state.points.actual = self.axes_of(&end, state);
        if self.may_run_beside(state) || !state.compensation.left.is_no() {
            state.points.actual = state.actual().with_xyz([Mm::UNKNOWN; 3]);
        }
        self.emit(state, Event::Unfollowed);
    }

    /// What strokes that are not followed may have switched.
    fn lose_switches(effect: Effect, state: &mut State<D>) {
        if effect.is_tapping_cycle() {
            let either = state.cycle.feed_override_on.join(&Truth::True);
            state.cycle.feed_override_on = either;
            state.spindle.way = Flat::Unknown;
            state.spindle.speed = D::unknown();
            state.feed.rate = D::unknown();
        }
        if matches!(
            effect,
            Effect::CycleBoreStop
                | Effect::CycleBackBore
                | Effect::CycleBoreManual
                | Effect::CycleBoreDwellManual
        ) {
            state.spindle.way = Flat::Unknown;
        }
    }

    /// The path mode that an operation changed is brought back.
    pub(in crate::exec) fn end_exact_path(&mut self, state: &mut State<D>) {
        if std::mem::take(&mut self.passes_exactly) {
            self.announce_path_mode(state);
        }
    }

    /// Gives out the strokes of an operation.
    pub(in crate::exec) fn strokes(
        &mut self,
        strokes: &[Stroke],
        plane: Plane,
        state: &mut State<D>,
    ) -> Step {
        let spindle = state.spindle();
        let is_direct = Self::goes_direct(state);
        let programmed = (state.feed().clone(), state.speed().clone());
        self.strokes_given += strokes.len() as u64;
        for stroke in strokes {
            match *stroke {
                Stroke::Rapid(to) | Stroke::Feed(to) => {
                    let rapid = matches!(stroke, Stroke::Rapid(_));
                    let kind = if rapid { TravelKind::Rapid } else { TravelKind::Feed };
                    let to = state.position().with_xyz(to);
                    if is_direct {
                        self.travel_direct(kind, &to, true, state);
                    } else {
                        self.travel(kind, to, true, state)?;
                    }
                }
                Stroke::Thread { to, lead } => {
                    let to = state.position().with_xyz(to);
                    self.emit(state, Event::SpindleSync { lead: Some(lead), velocity: false });
                    self.travel(TravelKind::Thread, to, true, state)?;
                    self.emit(state, Event::SpindleSync { lead: None, velocity: false });
                }
                Stroke::Arc { to, centre, turns } => self.stroke_arc(to, centre, turns, plane, state),
                Stroke::Dwell(seconds) => self.emit(state, Event::Dwell(seconds)),
                Stroke::SpindleStop => self.spindle(Spindle::Stopped, state)?,
                Stroke::SpindleRestart => self.turn_spindle(spindle, state)?,
                Stroke::SpindleReverse => {
                    let other = spindle.map(|spindle| match spindle {
                        Spindle::CounterClockwise => Spindle::Clockwise,
                        Spindle::Clockwise | Spindle::Stopped => Spindle::CounterClockwise,
                    });
                    self.turn_spindle(other, state)?;
                }
                Stroke::SpindleTurn { clockwise } => {
                    let way = if clockwise { Spindle::Clockwise } else { Spindle::CounterClockwise };
                    self.spindle(way, state)?;
                }
                Stroke::Pace(times) => self.pace(times, &programmed, state),
                Stroke::Orient => {
                    let way = if spindle == Some(Spindle::CounterClockwise) { 3 } else { 2 };
                    self.emit(state, Event::OrientSpindle { angle: 0.0, way });
                }
                Stroke::ExactPath => {
                    if !self.passes_exactly && state.path_mode(self.model) != Some(PathMode::ExactPath) {
                        self.passes_exactly = true;
                        self.path_mode(PathMode::ExactPath, state);
                    }
                }
                Stroke::Sync(lead) => self.emit(state, Event::SpindleSync { lead, velocity: false }),
                Stroke::FeedOverride(on) => {
                    state.cycle.feed_override_on = on.into();
                    self.emit(state, Event::Override { kind: Override::Feed, on });
                }
                Stroke::SpeedOverride(on) => self.emit(state, Event::Override { kind: Override::Speed, on }),
                Stroke::OperatorStop => self.emit(state, Event::Stop(Stop::Program)),
            }
        }
        Ok(())
    }

    /// Feed and speed are so many times what they were before the cycle. A feed by turns follows the spindle by itself.
    fn pace(&mut self, times: f64, (feed, speed): &(D::Value, D::Value), state: &mut State<D>) {
        let faster = |value: &D::Value| match D::known(value) {
            _ if times.to_bits() == 1.0_f64.to_bits() => value.clone(),
            Some(number) if !times.is_nan() => D::number(number * times),
            _ => D::unknown(),
        };
        if state.feed_mode(self.model) != Some(FeedMode::PerRevolution) {
            state.feed.rate = faster(feed);
        }
        let speed = faster(speed);
        let rate = D::known(&speed).unwrap_or(f64::NAN);
        state.spindle.speed = speed;
        self.emit(state, Event::SpindleSpeed(rate));
    }

    fn stroke_arc(&mut self, to: [Mm; 3], centre: (Mm, Mm), turns: i32, plane: Plane, state: &mut State<D>) {
        let programmed = state.position().with_xyz(to);
        let end: Position = self.axes_of(&programmed, state);
        let (moved, turns) = self.arc_of_axes(plane, centre, turns, state);
        let [f0, s0, _] = plane.to_local(state.actual().xyz());
        let [f1, s1, _] = plane.to_local(end.xyz());
        let sweep = sweep_about(moved, (f0, s0), (f1, s1), turns);
        let event = ArcMove {
            plane,
            from: *state.actual(),
            programmed,
            to: end,
            centre: moved,
            turns,
            sweep,
            expanded: true,
        };
        state.points.actual = end;
        state.points.position = programmed;
        self.emit(state, Event::Arc(event));
    }
}
