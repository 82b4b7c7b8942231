//! Holes: drilling, pecking, tapping, boring.
//!
//! Knows: the strokes of one hole in any plane, and how controls differ in the way to it. Must not know: which words stay
//! from block to block, how often a hole repeats.
//!
//! Sources: LinuxCNC by observation of its interpreter; Haas Mill Operator's Manual 2017, pages 243 to 298; Fanuc by the
//! same words where its manuals agree. The direction of the shift of a fine or back bore without `I` and `J` is the
//! plane's first axis, positive; a control whose setting gives another brings it as `I` or `J`.
//!
//! A back bore is off its axis on the way through the hole, both ways, and cuts on the axis.

use gcheck_controls::{CycleRules, Effect, Letter};
use gcheck_geometry::{Mm, Plane, Seconds};

use super::{CycleError, Sink, Stroke, from_program_units, in_program_units, known};
use crate::event::Units;
use crate::fault::CycleFault;

/// One hole of a canned cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hole {
    /// The plane that the hole stands on.
    pub plane: Plane,
    /// Where, in the plane's first and second axis.
    pub at: (Mm, Mm),
    /// The level before the first cycle of the series.
    pub initial: Mm,
    /// `R`, as a level.
    pub r: Mm,
    /// `Z` (or the plane's own depth word), as a level.
    pub bottom: Mm,
    /// `P`. `None` when the program gives none, now or before.
    pub dwell: Option<Seconds>,
    /// `Q`: depth of a peck, or length of the shift of a bore.
    pub peck: Option<Mm>,
    /// `I`, `J`, `K` as written, where they are words of the cycle (a `K` that repeats it is none).
    pub ijk: [Option<Mm>; 3],
    /// Levels are increments (`G91`); matters for a level given by `I`, `J` or `K` only.
    pub incremental: bool,
    /// The tool stays at `R` (`G99`), else it goes back to `initial` (`G98`).
    pub return_to_r: bool,
    /// The first hole of the block, which a rise to `R` may come before.
    pub first_of_block: bool,
    /// Which overrides the operator had before.
    pub overrides: Overrides,
    /// How far pecks back off and stay above the last depth, where a setting says; else the control's rules do.
    pub clearance: Option<Mm>,
    /// How far above `R` pecks come out to clear chips.
    pub above_r: Mm,
    /// How many times faster a tap comes out than it goes in; 1 for as fast.
    pub tap_out: f64,
    /// The units of the program; they decide how pecks are counted.
    pub units: Units,
}

/// Overrides in effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Overrides {
    /// Of the feed.
    pub feed: bool,
    /// Of the spindle speed.
    pub speed: bool,
}

/// The strokes of one hole, beginning at `from`.
///
/// The answer is the point after the hole. `from` and `initial` may be unknown; what follows from them is then unknown
/// too.
///
/// # Errors
///
/// [`CycleError::Fault`] for missing words, words that must be positive, and `R` below the bottom where the control
/// refuses it; [`CycleError::Unknown`] when `R`, the bottom or a peck is not known; [`CycleError::NotThisKind`] when
/// `effect` is no hole.
pub fn hole(
    effect: Effect,
    hole: &Hole,
    from: [Mm; 3],
    rules: &CycleRules,
    out: &mut dyn FnMut(Stroke),
) -> Result<[Mm; 3], CycleError> {
    known(&[hole.r, hole.bottom])?;
    let mut hole = Tool { hole, rules, sink: Sink::new(from, out) };
    hole.check_levels()?;
    if rules.rise_to_r {
        // The control that asks for every word asks on the way to the hole.
        hole.rise()?;
        hole.check_given(effect)?;
        hole.approach(effect)?;
        hole.check_pecks(effect)?;
    } else {
        hole.check_pecks(effect)?;
        hole.approach(effect)?;
    }
    match effect {
        Effect::CycleDrill => {
            hole.feed_to(hole.bottom())?;
            hole.rapid_to(hole.clear())?;
        }
        Effect::CycleDrillDwell => {
            hole.feed_to(hole.bottom())?;
            hole.dwell()?;
            hole.rapid_to(hole.clear())?;
        }
        Effect::CyclePeck => hole.pecks(false)?,
        Effect::CycleChipBreak => hole.pecks(true)?,
        Effect::CycleTap => hole.tap(true)?,
        Effect::CycleLeftTap => hole.tap(false)?,
        Effect::CycleBoreFeedOut => {
            hole.feed_to(hole.bottom())?;
            hole.feed_to(hole.r())?;
            if rules.rise_to_r {
                hole.rapid_to(hole.clear())?;
            } else {
                hole.rapid_if_elsewhere(hole.clear())?;
            }
        }
        Effect::CycleBoreStop => {
            hole.feed_to(hole.bottom())?;
            hole.dwell()?;
            hole.sink.put(Stroke::SpindleStop)?;
            hole.rapid_to(hole.clear())?;
            hole.sink.put(Stroke::SpindleRestart)?;
        }
        Effect::CycleBackBore => hole.back_bore()?,
        Effect::CycleBoreManual | Effect::CycleBoreDwellManual => hole.manual_bore()?,
        Effect::CycleBoreDwell => {
            hole.feed_to(hole.bottom())?;
            hole.dwell()?;
            if rules.rise_to_r {
                hole.feed_to(hole.clear())?;
            } else {
                hole.feed_to(hole.r())?;
                hole.rapid_if_elsewhere(hole.clear())?;
            }
        }
        Effect::CycleFineBore => hole.fine_bore()?,
        _ => return Err(CycleError::NotThisKind),
    }
    Ok(hole.sink.at)
}

struct Tool<'a, 'b> {
    hole: &'a Hole,
    rules: &'a CycleRules,
    sink: Sink<'b>,
}

impl Tool<'_, '_> {
    fn r(&self) -> Mm {
        self.hole.r
    }

    fn bottom(&self) -> Mm {
        self.hole.bottom
    }

    /// The level that the tool is left at.
    fn clear(&self) -> Mm {
        let Hole { r, initial, return_to_r, .. } = *self.hole;
        if return_to_r || (self.rules.rise_to_r && initial < r) { r } else { initial }
    }

    /// The hole's axis at a level.
    fn point(&self, level: Mm) -> [Mm; 3] {
        let (first, second) = self.hole.at;
        self.hole.plane.to_xyz([first, second, level])
    }

    fn feed_to(&mut self, level: Mm) -> Result<(), CycleError> {
        self.sink.feed(self.point(level))
    }

    fn rapid_to(&mut self, level: Mm) -> Result<(), CycleError> {
        self.sink.rapid(self.point(level))
    }

    fn rapid_if_elsewhere(&mut self, level: Mm) -> Result<(), CycleError> {
        self.sink.rapid_if_elsewhere(self.point(level))
    }

    fn dwell(&mut self) -> Result<(), CycleError> {
        self.hole.dwell.map_or(Ok(()), |time| self.sink.put(Stroke::Dwell(time)))
    }

    /// Pecks go somewhere.
    fn check_pecks(&self, effect: Effect) -> Result<(), CycleError> {
        if let Some(peck) = self.hole.peck {
            known(&[peck])?;
        }
        let pecks = effect.pecks();
        if pecks && self.hole.peck.is_some_and(|peck| peck <= Mm::ZERO) {
            return Err(CycleFault::NotPositive(Letter::of('Q')).into());
        }
        Ok(())
    }

    /// Words without which the cycle cannot begin.
    fn check_given(&self, effect: Effect) -> Result<(), CycleError> {
        let missing = |letter| Err(CycleFault::Missing(Letter::of(letter)).into());
        match effect {
            Effect::CyclePeck | Effect::CycleChipBreak if self.hole.peck.is_none() => return missing('Q'),
            Effect::CycleDrillDwell
            | Effect::CycleBoreStop
            | Effect::CycleBoreManual
            | Effect::CycleBoreDwellManual
            | Effect::CycleBoreDwell
                if self.hole.dwell.is_none() =>
            {
                return missing('P');
            }
            Effect::CycleBackBore => {
                for (word, letter) in self.hole.ijk.iter().zip(['I', 'J', 'K']) {
                    if word.is_none() {
                        return missing(letter);
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn check_levels(&self) -> Result<(), CycleError> {
        let below = self.rules.rise_to_r && self.r() < self.bottom();
        if below { Err(CycleFault::RBelowBottom.into()) } else { Ok(()) }
    }

    /// Up to `R` where the tool stands, if it is below.
    fn rise(&mut self) -> Result<(), CycleError> {
        if self.hole.first_of_block {
            if self.hole.initial < self.r() {
                let [first, second, _] = self.hole.plane.to_local(self.sink.at);
                self.sink.rapid(self.hole.plane.to_xyz([first, second, self.r()]))?;
            }
            self.sink.put(Stroke::ExactPath)?;
        }
        Ok(())
    }

    /// To the hole's axis, then to `R`.
    fn approach(&mut self, effect: Effect) -> Result<(), CycleError> {
        let [_, _, mut level] = self.hole.plane.to_local(self.sink.at);
        if self.rules.rise_to_r {
            // The way over the plane climbs to the level that the hole will be left at, unless the tool is above `R`.
            let clear = self.clear();
            let is_above = level > self.r();
            if level < clear && !is_above {
                level = clear;
            }
            self.rapid_to(level)?;
            return self.rapid_if_elsewhere(self.r());
        }
        self.rapid_if_elsewhere(level)?;
        if effect == Effect::CycleBackBore {
            // Its R is the far end of the hole, which it enters off the axis.
            return Ok(());
        }
        self.rapid_if_elsewhere(self.r())
    }

    /// Peck by peck. Breaking chips backs off a little; else every peck ends at `R`.
    fn pecks(&mut self, break_chips: bool) -> Result<(), CycleError> {
        let units = self.hole.units;
        let (r, bottom) = (in_program_units(self.r(), units), in_program_units(self.bottom(), units));
        let direction = if bottom > r { 1.0 } else { -1.0 };
        let mut peck = Peck::of(self.hole)?;
        let (retract, back_to_r) = if break_chips {
            (self.rules.chip_break_retract, peck.return_after)
        } else {
            (self.rules.peck_clearance, None)
        };
        let retract = self.hole.clearance.map_or(retract, |clearance| clearance.0);
        let out = r_and_above(self.r(), self.hole.above_r, direction);
        // Pecks that come out even end at the bottom. The control that computes exactly so does as its numbers say.
        let slack = if self.rules.rise_to_r { 0.0 } else { 1e-7 };
        let mut since_r = 0.0;
        let mut depth = r;
        while let Some(step) = peck.next() {
            depth += direction * step;
            since_r += step;
            let left = (bottom - depth) * direction;
            if left.is_nan() || left <= slack {
                break;
            }
            let level = from_program_units(depth, units);
            let near = level - Mm(direction * retract);
            self.feed_to(level)?;
            if !break_chips || back_to_r.is_some_and(|total| since_r >= total) {
                since_r = 0.0;
                self.rapid_to(if break_chips { self.r() } else { out })?;
                // Above `R` there is nothing to be fast for; the control that computes it so goes there all the same.
                if self.rules.rise_to_r || (near - self.r()).0 * direction > 0.0 {
                    self.rapid_to(near)?;
                }
            } else {
                self.rapid_to(near)?;
            }
        }
        self.feed_to(self.bottom())?;
        self.dwell_after_pecks()?;
        self.rapid_to(self.clear())
    }

    /// Only controls that read `P` with pecks give one.
    fn dwell_after_pecks(&mut self) -> Result<(), CycleError> {
        if self.rules.rise_to_r { Ok(()) } else { self.dwell() }
    }

    /// Where the control that taps with a turning spindle really feeds to: outside of XY it takes the axes of the one
    /// other plane for those of the active one. A mistake of its interpreter, but what the machine does.
    fn tapped(&self, level: Mm) -> [Mm; 3] {
        let (first, second) = self.hole.at;
        let plane = match self.hole.plane {
            Plane::Xy => Plane::Xy,
            Plane::Zx => Plane::Yz,
            Plane::Yz => Plane::Zx,
        };
        plane.to_xyz([first, second, level])
    }

    fn tap(&mut self, clockwise: bool) -> Result<(), CycleError> {
        let Overrides { feed, speed } = self.hole.overrides;
        if self.rules.tap_needs_spindle {
            self.sink.put(Stroke::FeedOverride(false))?;
            self.sink.put(Stroke::SpeedOverride(false))?;
            self.sink.feed(self.tapped(self.bottom()))?;
            self.sink.put(Stroke::SpindleStop)?;
            self.sink.put(Stroke::SpindleReverse)?;
            self.sink.put(Stroke::Dwell(self.hole.dwell.unwrap_or(Seconds::ZERO)))?;
            self.sink.feed(self.tapped(self.clear()))?;
            self.sink.put(Stroke::SpindleStop)?;
            self.sink.put(Stroke::SpindleRestart)?;
            if feed {
                self.sink.put(Stroke::FeedOverride(true))?;
            }
            if speed {
                self.sink.put(Stroke::SpeedOverride(true))?;
            }
            // It believes all the same to stand over the hole.
            self.sink.at = self.point(self.clear());
            return Ok(());
        }
        // The pitch ties the feed to the spindle: the override switches have no say.
        self.sink.put(Stroke::FeedOverride(false))?;
        self.sink.put(Stroke::SpindleTurn { clockwise })?;
        self.feed_to(self.bottom())?;
        self.dwell()?;
        let is_faster = self.hole.tap_out.to_bits() != 1.0_f64.to_bits();
        if is_faster {
            self.sink.put(Stroke::Pace(self.hole.tap_out))?;
        }
        self.sink.put(Stroke::SpindleTurn { clockwise: !clockwise })?;
        self.feed_to(self.r())?;
        if is_faster {
            self.sink.put(Stroke::Pace(1.0))?;
        }
        self.sink.put(Stroke::SpindleRestart)?;
        if feed {
            self.sink.put(Stroke::FeedOverride(true))?;
        }
        self.rapid_if_elsewhere(self.clear())
    }

    fn manual_bore(&mut self) -> Result<(), CycleError> {
        self.feed_to(self.bottom())?;
        self.dwell()?;
        self.sink.put(Stroke::SpindleStop)?;
        self.sink.put(Stroke::OperatorStop)?;
        if !self.rules.rise_to_r {
            // The operator has drawn the tool out; the cycle takes it to its level.
            self.rapid_to(self.clear())?;
        }
        self.sink.put(Stroke::SpindleRestart)
    }

    /// Down the hole with the tool pulled off the wall, up with a cut, out again off the wall.
    fn back_bore(&mut self) -> Result<(), CycleError> {
        if !self.rules.rise_to_r {
            return self.back_bore_between();
        }
        let [first, second, top] = self.hole.plane.to_local(self.hole.ijk.map(Option::unwrap_or_default));
        let top = if self.hole.incremental { self.bottom() + top } else { top };
        let (bottom, r, clear) = (self.bottom(), self.r(), self.clear());
        let shift = (first, second);
        self.sink.rapid(self.shifted(shift, r))?;
        self.orient()?;
        self.sink.rapid(self.shifted(shift, bottom))?;
        self.rapid_to(bottom)?;
        self.sink.put(Stroke::SpindleRestart)?;
        self.feed_to(top)?;
        self.feed_to(bottom)?;
        self.orient()?;
        self.sink.rapid(self.shifted(shift, bottom))?;
        self.sink.rapid(self.shifted(shift, clear))?;
        self.rapid_to(clear)?;
        self.sink.put(Stroke::SpindleRestart)
    }

    /// The form with `R` at the far end and the cut from there up to the bottom word; ends at the initial level.
    fn back_bore_between(&mut self) -> Result<(), CycleError> {
        let shift = self.wall_shift()?;
        let initial = self.hole.initial;
        self.orient()?;
        self.sink.rapid(self.shifted(shift, initial))?;
        self.sink.rapid(self.shifted(shift, self.r()))?;
        self.rapid_to(self.r())?;
        self.sink.put(Stroke::SpindleRestart)?;
        self.feed_to(self.bottom())?;
        self.dwell()?;
        self.orient()?;
        self.sink.rapid(self.shifted(shift, self.bottom()))?;
        self.sink.rapid(self.shifted(shift, initial))?;
        self.rapid_to(initial)?;
        self.sink.put(Stroke::SpindleRestart)
    }

    fn fine_bore(&mut self) -> Result<(), CycleError> {
        let shift = self.wall_shift()?;
        let clear = self.clear();
        self.feed_to(self.bottom())?;
        self.dwell()?;
        self.orient()?;
        self.sink.rapid(self.shifted(shift, self.bottom()))?;
        self.sink.rapid(self.shifted(shift, clear))?;
        self.rapid_to(clear)?;
        self.sink.put(Stroke::SpindleRestart)
    }

    fn orient(&mut self) -> Result<(), CycleError> {
        self.sink.put(Stroke::SpindleStop)?;
        self.sink.put(Stroke::Orient)
    }

    fn shifted(&self, (first, second): (Mm, Mm), level: Mm) -> [Mm; 3] {
        let (a, b) = self.hole.at;
        self.hole.plane.to_xyz([a + first, b + second, level])
    }

    /// How far the tool is pulled off the wall: `I` and `J`, else `Q` along the first axis.
    fn wall_shift(&self) -> Result<(Mm, Mm), CycleError> {
        let [first, second, _] = self.hole.plane.to_local(self.hole.ijk);
        match (first, second, self.hole.peck) {
            (None, None, Some(length)) if length < Mm::ZERO => {
                Err(CycleFault::NotPositive(Letter::of('Q')).into())
            }
            (None, None, Some(length)) => Ok((length, Mm::ZERO)),
            (None, None, None) if self.rules.shift_optional => Ok((Mm::ZERO, Mm::ZERO)),
            (None, None, None) => Err(CycleFault::Missing(Letter::of('Q')).into()),
            (first, second, _) => Ok((first.unwrap_or_default(), second.unwrap_or_default())),
        }
    }
}

/// So far above `R`, seen from a hole in this direction.
fn r_and_above(r: Mm, above: Mm, direction: f64) -> Mm {
    r - Mm(direction * above.0)
}

/// The depths of pecks one after another, in program units.
struct Peck {
    step: Option<f64>,
    decrease: f64,
    least: f64,
    /// Breaking chips goes back to `R` after this much.
    return_after: Option<f64>,
}

impl Peck {
    /// `Q` gives equal pecks; `I` the first, `J` less each time, `K` the least. `K` beside `Q` is the depth between
    /// returns to `R`.
    fn of(hole: &Hole) -> Result<Self, CycleError> {
        let words = hole.ijk.map(|word| word.map(|word| in_program_units(word, hole.units)));
        let q = hole.peck.map(|peck| in_program_units(peck, hole.units));
        for (word, letter) in words.iter().zip(['I', 'J', 'K']) {
            match *word {
                Some(word) if !word.is_finite() => return Err(CycleError::Unknown),
                Some(word) if word < 0.0 => return Err(CycleFault::NotPositive(Letter::of(letter)).into()),
                _ => {}
            }
        }
        Ok(match (q, words) {
            (Some(q), [_, _, k]) => Self { step: Some(q), decrease: 0.0, least: q, return_after: k },
            (None, [Some(first), decrease, least]) if first > 0.0 => Self {
                step: Some(first),
                decrease: decrease.unwrap_or(0.0),
                // Without `K` a peck never grows smaller than the decrease, so that the cycle goes on.
                least: least.or(decrease).unwrap_or(first).min(first),
                return_after: None,
            },
            (None, [Some(_), ..]) => return Err(CycleFault::NotPositive(Letter::of('I')).into()),
            (None, _) => Self { step: None, decrease: 0.0, least: 0.0, return_after: None },
        })
    }

    fn next(&mut self) -> Option<f64> {
        let step = self.step?;
        self.step = Some((step - self.decrease).max(self.least));
        // A peck of nothing never arrives.
        (step > 0.0).then_some(step)
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::cycles::test_support::shown;

    /// As the installed interpreter of LinuxCNC moves.
    fn exact() -> CycleRules {
        CycleRules {
            repeat: 'L',
            zero_repeats_move: false,
            peck_clearance: 0.254,
            chip_break_retract: 0.254,
            motion_ends_cycle: true,
            needs_axis: true,
            all_planes: true,
            incremental_r: true,
            rise_to_r: true,
            tap_needs_spindle: true,
            across: Vec::new(),
            r_is_distance: false,
            pocket_moves: None,
            clearance_setting: None,
            above_r_setting: None,
            shift_setting: None,
            shift_optional: false,
            tap_out_setting: None,
        }
    }

    /// As other mills move.
    fn plain() -> CycleRules {
        CycleRules {
            peck_clearance: 1.0,
            chip_break_retract: 0.5,
            rise_to_r: false,
            tap_needs_spindle: false,
            ..exact()
        }
    }

    fn at(x: f64, y: f64, levels: [f64; 3]) -> Hole {
        let [initial, r, bottom] = levels.map(Mm);
        Hole {
            plane: Plane::Xy,
            at: (Mm(x), Mm(y)),
            initial,
            r,
            bottom,
            dwell: None,
            peck: None,
            ijk: [None; 3],
            incremental: false,
            return_to_r: false,
            first_of_block: true,
            overrides: Overrides { feed: true, speed: true },
            clearance: None,
            above_r: Mm::ZERO,
            tap_out: 1.0,
            units: Units::Mm,
        }
    }

    fn check(rules: &CycleRules, effect: Effect, words: &Hole, from: [f64; 3], expected: &Expect) {
        expected.assert_eq(&shown(|out| hole(effect, words, from.map(Mm), rules, out).map(drop)));
    }

    // What the interpreter prints for `G0 Z3`, `G98 G81 X0 Y0 Z-2.5 R1`.
    #[test]
    fn drilling_goes_over_the_hole_down_to_r_down_and_back() {
        check(
            &exact(),
            Effect::CycleDrill,
            &at(0.0, 0.0, [3.0, 1.0, -2.5]),
            [1.0, 2.0, 3.0],
            &expect![[r#"
            exact path
            rapid 0 0 3
            rapid 0 0 1
            feed 0 0 -2.5
            rapid 0 0 3
        "#]],
        );
    }

    // `G0 X5 Y5 Z-3`, `G98 G81 X6 Y5 Z-5 R-2 L2`: the rise comes before everything, and once a block.
    #[test]
    fn below_r_the_tool_first_rises_where_it_stands() {
        let words = at(6.0, 5.0, [-3.0, -2.0, -5.0]);
        check(
            &exact(),
            Effect::CycleDrill,
            &words,
            [5.0, 5.0, -3.0],
            &expect![[r#"
            rapid 5 5 -2
            exact path
            rapid 6 5 -2
            feed 6 5 -5
            rapid 6 5 -2
        "#]],
        );
        let again = Hole { first_of_block: false, ..words };
        check(
            &exact(),
            Effect::CycleDrill,
            &again,
            [6.0, 5.0, -2.0],
            &expect![[r#"
            rapid 6 5 -2
            feed 6 5 -5
            rapid 6 5 -2
        "#]],
        );
    }

    // `G99 G81 … R1` from Z5, then `X5 R2`: the way over the plane climbs; then `G98 X8 R3` climbs to Z5.
    #[test]
    fn the_way_to_the_next_hole_climbs_to_the_level_that_it_will_be_left_at() {
        let words = Hole { return_to_r: true, ..at(5.0, 0.0, [5.0, 2.0, 0.0]) };
        check(
            &exact(),
            Effect::CycleDrill,
            &words,
            [0.0, 0.0, 1.0],
            &expect![[r#"
            exact path
            rapid 5 0 2
            feed 5 0 0
            rapid 5 0 2
        "#]],
        );
        check(
            &exact(),
            Effect::CycleDrill,
            &at(8.0, 0.0, [5.0, 3.0, 0.0]),
            [7.0, 0.0, 2.0],
            &expect![[r#"
            exact path
            rapid 8 0 5
            rapid 8 0 3
            feed 8 0 0
            rapid 8 0 5
        "#]],
        );
    }

    // `G91 X6 R2` with the tool above R: the rise goes down.
    #[test]
    fn the_first_move_goes_to_r_from_above_too_when_r_lies_above_the_initial_level() {
        let words = Hole { return_to_r: true, ..at(18.0, 7.0, [5.0, 7.0, 6.0]) };
        check(
            &exact(),
            Effect::CycleDrill,
            &words,
            [11.0, 7.0, 11.0],
            &expect![[r#"
            rapid 11 7 7
            exact path
            rapid 18 7 7
            feed 18 7 6
            rapid 18 7 7
        "#]],
        );
    }

    #[test]
    fn without_the_rise_the_tool_goes_over_the_hole_first_and_back_to_where_it_was() {
        check(
            &plain(),
            Effect::CycleDrill,
            &at(6.0, 5.0, [-3.0, -2.0, -5.0]),
            [5.0, 5.0, -3.0],
            &expect![[r#"
            rapid 6 5 -3
            rapid 6 5 -2
            feed 6 5 -5
            rapid 6 5 -3
        "#]],
        );
    }

    // `G18`, `G0 X1 Y5 Z3`, `G98 G81 X0 Y-1 Z1 R1`; `G19 … G83 X-2 Y5 Z5 R2 Q3` from X-1.
    #[test]
    fn holes_stand_on_any_plane() {
        let words = Hole { plane: Plane::Zx, ..at(1.0, 0.0, [5.0, 1.0, -1.0]) };
        check(
            &exact(),
            Effect::CycleDrill,
            &words,
            [1.0, 5.0, 3.0],
            &expect![[r#"
            exact path
            rapid 0 5 1
            rapid 0 1 1
            feed 0 -1 1
            rapid 0 5 1
        "#]],
        );
        let words = Hole { plane: Plane::Yz, peck: Some(Mm(3.0)), ..at(5.0, 5.0, [-1.0, 2.0, -2.0]) };
        check(
            &exact(),
            Effect::CyclePeck,
            &words,
            [-1.0, 0.0, 3.0],
            &expect![[r#"
            rapid 2 0 3
            exact path
            rapid 2 5 5
            feed -1 5 5
            rapid 2 5 5
            rapid -0.746 5 5
            feed -2 5 5
            rapid 2 5 5
        "#]],
        );
    }

    // `G83 X2 Z0.7 R1 Q0.1`: three tenths do not sum to 0.7, and the clearance reaches above R.
    #[test]
    fn pecks_are_counted_with_the_sums_of_the_interpreter() {
        let words = Hole { peck: Some(Mm(0.1)), ..at(2.0, 0.0, [3.0, 1.0, 0.7]) };
        check(
            &exact(),
            Effect::CyclePeck,
            &words,
            [2.0, 0.0, 3.0],
            &expect![[r#"
            exact path
            rapid 2 0 3
            rapid 2 0 1
            feed 2 0 0.9
            rapid 2 0 1
            rapid 2 0 1.154
            feed 2 0 0.8
            rapid 2 0 1
            rapid 2 0 1.054
            feed 2 0 0.7
            rapid 2 0 1
            rapid 2 0 0.954
            feed 2 0 0.7
            rapid 2 0 3
        "#]],
        );
    }

    // `G20 G73 X2 R1 Q0.7 Z-1.1`: in inches, feeds at 0.3, -0.4, -1.1 and once more -1.1.
    #[test]
    fn pecks_of_an_inch_program_are_counted_in_inches() {
        let inch = |value: f64| value * 25.4;
        let words = Hole {
            peck: Some(Mm(inch(0.7))),
            units: Units::Inch,
            ..at(0.0, 0.0, [inch(3.0), inch(1.0), inch(-1.1)])
        };
        check(
            &exact(),
            Effect::CycleChipBreak,
            &words,
            [0.0, 0.0, inch(3.0)],
            &expect![[r#"
            exact path
            rapid 0 0 76.2
            rapid 0 0 25.4
            feed 0 0 7.62
            rapid 0 0 7.874
            feed 0 0 -10.16
            rapid 0 0 -9.906
            feed 0 0 -27.94
            rapid 0 0 -27.686
            feed 0 0 -27.94
            rapid 0 0 76.2
        "#]],
        );
    }

    #[test]
    fn pecks_of_other_controls_stay_below_r_and_may_dwell() {
        let words = Hole { peck: Some(Mm(2.0)), dwell: Some(Seconds(0.3)), ..at(0.0, 0.0, [5.0, 1.0, -4.0]) };
        check(
            &plain(),
            Effect::CyclePeck,
            &words,
            [0.0, 0.0, 5.0],
            &expect![[r#"
            rapid 0 0 1
            feed 0 0 -1
            rapid 0 0 1
            rapid 0 0 0
            feed 0 0 -3
            rapid 0 0 1
            rapid 0 0 -2
            feed 0 0 -4
            dwell 0.3
            rapid 0 0 5
        "#]],
        );
    }

    #[test]
    fn pecks_may_shrink_from_i_by_j_down_to_k() {
        let words =
            Hole { ijk: [Some(Mm(3.0)), Some(Mm(1.0)), Some(Mm(1.5))], ..at(0.0, 0.0, [5.0, 0.0, -8.0]) };
        check(
            &plain(),
            Effect::CycleChipBreak,
            &words,
            [0.0, 0.0, 5.0],
            &expect![[r#"
            rapid 0 0 0
            feed 0 0 -3
            rapid 0 0 -2.5
            feed 0 0 -5
            rapid 0 0 -4.5
            feed 0 0 -6.5
            rapid 0 0 -6
            feed 0 0 -8
            rapid 0 0 5
        "#]],
        );
    }

    #[test]
    fn breaking_chips_goes_back_to_r_when_k_is_drilled() {
        let words = Hole {
            peck: Some(Mm(1.0)),
            ijk: [None, None, Some(Mm(2.0))],
            return_to_r: true,
            ..at(0.0, 0.0, [5.0, 0.0, -3.5])
        };
        check(
            &plain(),
            Effect::CycleChipBreak,
            &words,
            [0.0, 0.0, 5.0],
            &expect![[r#"
            rapid 0 0 0
            feed 0 0 -1
            rapid 0 0 -0.5
            feed 0 0 -2
            rapid 0 0 0
            rapid 0 0 -1.5
            feed 0 0 -3
            rapid 0 0 -2.5
            feed 0 0 -3.5
            rapid 0 0 0
        "#]],
        );
    }

    // `M3`, `G98 G84 X1 Y1 Z-1 R2 P1`.
    #[test]
    fn tapping_reverses_the_spindle_at_the_bottom() {
        let words = Hole { dwell: Some(Seconds(1.0)), ..at(1.0, 1.0, [5.0, 2.0, -1.0]) };
        check(
            &exact(),
            Effect::CycleTap,
            &words,
            [1.0, 5.0, 5.0],
            &expect![[r#"
            exact path
            rapid 1 1 5
            rapid 1 1 2
            feed override false
            speed override false
            feed 1 1 -1
            spindle stops
            spindle reversed
            dwell 1
            feed 1 1 5
            spindle stops
            spindle as before
            feed override true
            speed override true
        "#]],
        );
        let off = Hole { overrides: Overrides { feed: false, speed: false }, dwell: None, ..words };
        check(
            &exact(),
            Effect::CycleTap,
            &off,
            [1.0, 5.0, 5.0],
            &expect![[r#"
            exact path
            rapid 1 1 5
            rapid 1 1 2
            feed override false
            speed override false
            feed 1 1 -1
            spindle stops
            spindle reversed
            dwell 0
            feed 1 1 5
            spindle stops
            spindle as before
        "#]],
        );
        check(
            &plain(),
            Effect::CycleLeftTap,
            &words,
            [1.0, 5.0, 5.0],
            &expect![[r#"
                rapid 1 1 5
                rapid 1 1 2
                feed override false
                spindle counter-clockwise
                feed 1 1 -1
                dwell 1
                spindle clockwise
                feed 1 1 2
                spindle as before
                feed override true
                rapid 1 1 5
            "#]],
        );
    }

    // `G18`, `G98 G84 X10 Y-20 Z30 R2` from X1 Y5 Z3.
    #[test]
    fn tapping_outside_of_xy_feeds_where_the_interpreter_feeds() {
        let words = Hole { plane: Plane::Zx, ..at(30.0, 10.0, [5.0, 2.0, -20.0]) };
        let mut ends = Vec::new();
        let end = hole(Effect::CycleTap, &words, [1.0, 5.0, 3.0].map(Mm), &exact(), &mut |stroke| {
            if let Stroke::Feed(to) = stroke {
                ends.push(to.map(Mm::get));
            }
        });
        assert_eq!(ends, [[-20.0, 30.0, 10.0], [5.0, 30.0, 10.0]]);
        assert_eq!(end, Ok([10.0, 5.0, 30.0].map(Mm)));
    }

    #[test]
    fn boring_differs_in_the_way_out() {
        let words = Hole { dwell: Some(Seconds(0.5)), ..at(2.0, 1.0, [5.0, 1.0, -2.0]) };
        let from = [0.0, 1.0, 5.0];
        check(
            &exact(),
            Effect::CycleBoreFeedOut,
            &words,
            from,
            &expect![[r#"
            exact path
            rapid 2 1 5
            rapid 2 1 1
            feed 2 1 -2
            feed 2 1 1
            rapid 2 1 5
        "#]],
        );
        check(
            &exact(),
            Effect::CycleBoreStop,
            &words,
            from,
            &expect![[r#"
            exact path
            rapid 2 1 5
            rapid 2 1 1
            feed 2 1 -2
            dwell 0.5
            spindle stops
            rapid 2 1 5
            spindle as before
        "#]],
        );
        check(
            &exact(),
            Effect::CycleBoreDwellManual,
            &words,
            from,
            &expect![[r#"
            exact path
            rapid 2 1 5
            rapid 2 1 1
            feed 2 1 -2
            dwell 0.5
            spindle stops
            operator stop
            spindle as before
        "#]],
        );
        check(
            &exact(),
            Effect::CycleBoreDwell,
            &words,
            from,
            &expect![[r#"
            exact path
            rapid 2 1 5
            rapid 2 1 1
            feed 2 1 -2
            dwell 0.5
            feed 2 1 5
        "#]],
        );
        check(
            &plain(),
            Effect::CycleBoreDwell,
            &words,
            from,
            &expect![[r#"
            rapid 2 1 5
            rapid 2 1 1
            feed 2 1 -2
            dwell 0.5
            feed 2 1 1
            rapid 2 1 5
        "#]],
        );
    }

    // `G98 G87 X1 Y1 Z-2.5 R1 I0.2 J0.3 K-1`.
    #[test]
    fn back_boring_enters_beside_the_axis_and_cuts_up_to_k() {
        let words =
            Hole { ijk: [Some(Mm(0.2)), Some(Mm(0.3)), Some(Mm(-1.0))], ..at(1.0, 1.0, [3.0, 1.0, -2.5]) };
        check(
            &exact(),
            Effect::CycleBackBore,
            &words,
            [0.0, 0.0, 3.0],
            &expect![[r#"
            exact path
            rapid 1 1 3
            rapid 1 1 1
            rapid 1.2 1.3 1
            spindle stops
            orient
            rapid 1.2 1.3 -2.5
            rapid 1 1 -2.5
            spindle as before
            feed 1 1 -1
            feed 1 1 -2.5
            spindle stops
            orient
            rapid 1.2 1.3 -2.5
            rapid 1.2 1.3 3
            rapid 1 1 3
            spindle as before
        "#]],
        );
    }

    // `G19 G99 G87 X0 Z7 Y0 R6 I0.1 J0.2 K0.3`: I is the level, J and K shift.
    #[test]
    fn in_other_planes_the_words_follow_their_axes() {
        let words = Hole {
            plane: Plane::Yz,
            ijk: [Some(Mm(0.1)), Some(Mm(0.2)), Some(Mm(0.3))],
            return_to_r: true,
            ..at(0.0, 7.0, [1.0, 6.0, 0.0])
        };
        check(
            &exact(),
            Effect::CycleBackBore,
            &words,
            [1.0, 5.0, 3.0],
            &expect![[r#"
            rapid 6 5 3
            exact path
            rapid 6 0 7
            rapid 6 0.2 7.3
            spindle stops
            orient
            rapid 0 0.2 7.3
            rapid 0 0 7
            spindle as before
            feed 0.1 0 7
            feed 0 0 7
            spindle stops
            orient
            rapid 0 0.2 7.3
            rapid 6 0.2 7.3
            rapid 6 0 7
            spindle as before
        "#]],
        );
    }

    #[test]
    fn back_boring_by_q_passes_through_the_hole_to_r_below() {
        let words = Hole { peck: Some(Mm(0.5)), ..at(1.0, 1.0, [5.0, -20.0, -15.0]) };
        check(
            &plain(),
            Effect::CycleBackBore,
            &words,
            [0.0, 0.0, 5.0],
            &expect![[r#"
            rapid 1 1 5
            spindle stops
            orient
            rapid 1.5 1 5
            rapid 1.5 1 -20
            rapid 1 1 -20
            spindle as before
            feed 1 1 -15
            spindle stops
            orient
            rapid 1.5 1 -15
            rapid 1.5 1 5
            rapid 1 1 5
            spindle as before
        "#]],
        );
    }

    #[test]
    fn fine_boring_leaves_off_the_wall() {
        let words =
            Hole { ijk: [Some(Mm(-0.2)), None, None], return_to_r: true, ..at(1.0, 1.0, [5.0, 1.0, -3.0]) };
        check(
            &plain(),
            Effect::CycleFineBore,
            &words,
            [1.0, 1.0, 5.0],
            &expect![[r#"
            rapid 1 1 1
            feed 1 1 -3
            spindle stops
            orient
            rapid 0.8 1 -3
            rapid 0.8 1 1
            rapid 1 1 1
            spindle as before
        "#]],
        );
    }

    #[test]
    fn a_bore_without_a_shift_comes_out_along_the_wall_where_the_control_takes_it() {
        let words = Hole { return_to_r: true, ..at(1.0, 1.0, [5.0, 1.0, -3.0]) };
        check(
            &CycleRules { shift_optional: true, ..plain() },
            Effect::CycleFineBore,
            &words,
            [1.0, 1.0, 1.0],
            &expect![[r#"
                feed 1 1 -3
                spindle stops
                orient
                rapid 1 1 -3
                rapid 1 1 1
                rapid 1 1 1
                spindle as before
            "#]],
        );
    }

    #[test]
    fn settings_change_how_pecks_come_out() {
        let words = Hole {
            return_to_r: true,
            peck: Some(Mm(2.0)),
            clearance: Some(Mm(0.25)),
            above_r: Mm(3.0),
            ..at(1.0, 1.0, [5.0, 1.0, -3.0])
        };
        check(
            &plain(),
            Effect::CyclePeck,
            &words,
            [1.0, 1.0, 1.0],
            &expect![[r#"
                feed 1 1 -1
                rapid 1 1 4
                rapid 1 1 -0.75
                feed 1 1 -3
                rapid 1 1 1
            "#]],
        );
    }

    #[test]
    fn pecks_that_come_out_even_end_at_the_bottom() {
        let words = Hole { return_to_r: true, peck: Some(Mm(0.3)), ..at(1.0, 1.0, [5.0, 0.0, -0.9]) };
        check(
            &plain(),
            Effect::CycleChipBreak,
            &words,
            [1.0, 1.0, 0.0],
            &expect![[r#"
                feed 1 1 -0.3
                rapid 1 1 0.2
                feed 1 1 -0.6
                rapid 1 1 -0.1
                feed 1 1 -0.9
                rapid 1 1 0
            "#]],
        );
    }

    #[test]
    fn a_tap_may_come_out_faster_than_it_goes_in() {
        let words = Hole { return_to_r: true, tap_out: 2.0, ..at(1.0, 1.0, [5.0, 1.0, -3.0]) };
        check(
            &plain(),
            Effect::CycleTap,
            &words,
            [1.0, 1.0, 1.0],
            &expect![[r#"
                feed override false
                spindle clockwise
                feed 1 1 -3
                pace 2
                spindle counter-clockwise
                feed 1 1 1
                pace 1
                spindle as before
                feed override true
            "#]],
        );
    }

    #[test]
    fn what_cannot_be_drilled_is_refused() {
        let from = [0.0, 0.0, 5.0];
        let words = at(0.0, 0.0, [5.0, 1.0, -1.0]);
        check(
            &exact(),
            Effect::CyclePeck,
            &words,
            from,
            &expect![[r#"
            exact path
            Fault(Missing(Q))
        "#]],
        );
        check(
            &exact(),
            Effect::CycleDrillDwell,
            &words,
            from,
            &expect![[r#"
            exact path
            Fault(Missing(P))
        "#]],
        );
        check(
            &exact(),
            Effect::CycleBackBore,
            &words,
            from,
            &expect![[r#"
            exact path
            Fault(Missing(I))
        "#]],
        );
        check(
            &plain(),
            Effect::CycleFineBore,
            &words,
            from,
            &expect![[r#"
            rapid 0 0 1
            Fault(Missing(Q))
        "#]],
        );
        let zero = Hole { peck: Some(Mm(0.0)), ..words };
        check(&plain(), Effect::CyclePeck, &zero, from, &expect!["Fault(NotPositive(Q))\n"]);
        let upside_down = at(0.0, 0.0, [5.0, 1.0, 2.0]);
        check(&exact(), Effect::CycleDrill, &upside_down, from, &expect!["Fault(RBelowBottom)\n"]);
        let unknown = at(0.0, 0.0, [5.0, f64::NAN, 2.0]);
        check(&exact(), Effect::CycleDrill, &unknown, from, &expect!["Unknown\n"]);
        check(
            &exact(),
            Effect::Rapid,
            &words,
            from,
            &expect![[r#"
            exact path
            rapid 0 0 5
            rapid 0 0 1
            NotThisKind
        "#]],
        );
    }

    #[test]
    fn a_tiny_peck_ends() {
        let words = Hole { peck: Some(Mm(1e-300)), ..at(0.0, 0.0, [5.0, 1.0, -1.0]) };
        let mut strokes = 0_u32;
        let outcome = hole(Effect::CyclePeck, &words, [Mm(0.0); 3], &exact(), &mut |_| strokes += 1);
        assert_eq!(outcome, Err(CycleError::TooManyStrokes));
        assert_eq!(strokes, crate::cycles::MAX_STROKES);
    }

    #[test]
    fn an_unknown_start_leaves_only_the_way_there_unknown() {
        check(
            &exact(),
            Effect::CycleDrill,
            &at(1.0, 2.0, [f64::NAN, 1.0, -1.0]),
            [f64::NAN; 3],
            &expect![[r#"
            exact path
            rapid 1 2 NaN
            rapid 1 2 1
            feed 1 2 -1
            rapid 1 2 NaN
        "#]],
        );
    }
}
