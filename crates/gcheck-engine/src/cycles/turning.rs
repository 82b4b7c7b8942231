//! Cycles of one block on a lathe: one pass around a box, grooves, threads.
//!
//! Knows: their strokes. Must not know: diameters (every X here is a radius), which words gave the numbers, profiles.
//!
//! Points are X, Y, Z; Y stays where it is. Sources: LinuxCNC by observation of its interpreter; Haas Lathe Operator's
//! Manual and Fanuc's manuals for the rest. Where a setting of the machine shapes a detail (pull-out at the end of a
//! thread, retract of a peck) it is a field here.

use gcheck_controls::{Effect, Letter};
use gcheck_geometry::{Degrees, Mm};

use super::{CycleError, Sink, Stroke, from_program_units, in_program_units, known};
use crate::event::Units;
use crate::fault::CycleFault;

/// One pass around a box, back to where it began: turning, threading or facing.
///
/// `x` and `z` are the far corner, `taper` the difference of the cut's start from its end (`R` or `I`): in X for turning
/// and threading, in Z for facing. `lead` is millimetres a turn, for threading; `pull_out` the length of the thread's end
/// that leaves the work at 45 degrees, 0 for none.
///
/// # Errors
///
/// [`CycleError::Unknown`] for unknown numbers, [`CycleError::NotThisKind`] for other effects.
pub fn box_pass(
    effect: Effect,
    from: [Mm; 3],
    (x, z): (Mm, Mm),
    taper: Mm,
    lead: Mm,
    pull_out: Mm,
    out: &mut dyn FnMut(Stroke),
) -> Result<[Mm; 3], CycleError> {
    let [x0, y, z0] = from;
    known(&[x0, z0, x, z, taper])?;
    let mut sink = Sink::new(from, out);
    match effect {
        Effect::TurningPass => {
            sink.rapid([x + taper, y, z0])?;
            sink.feed([x, y, z])?;
            sink.feed([x0, y, z])?;
            sink.rapid([x0, y, z0])?;
        }
        Effect::ThreadingPass => {
            known(&[lead, pull_out])?;
            sink.rapid([x + taper, y, z0])?;
            thread_to(&mut sink, (x, z), x0, lead, pull_out)?;
            sink.rapid([x0, y, z])?;
            sink.rapid([x0, y, z0])?;
        }
        Effect::FacingPass => {
            sink.rapid([x0, y, z + taper])?;
            sink.feed([x, y, z])?;
            sink.feed([x, y, z0])?;
            sink.rapid([x0, y, z0])?;
        }
        _ => return Err(CycleError::NotThisKind),
    }
    Ok(sink.at)
}

/// The thread itself, from where the tool stands; its last part may leave the work toward `clear` at 45 degrees.
fn thread_to(
    sink: &mut Sink<'_>,
    (x, z): (Mm, Mm),
    clear: Mm,
    lead: Mm,
    pull_out: Mm,
) -> Result<(), CycleError> {
    let [x0, y, z0] = sink.at;
    let way = (z - z0).abs();
    if !(pull_out > Mm::ZERO && pull_out < way) {
        return sink.put(Stroke::Thread { to: [x, y, z], lead });
    }
    let turn = z - (z - z0) * (pull_out / way);
    let at_turn = x0 + (x - x0) * (1.0 - pull_out / way);
    let out = pull_out.min((clear - at_turn).abs());
    sink.put(Stroke::Thread { to: [at_turn, y, turn], lead })?;
    sink.put(Stroke::Thread { to: [at_turn + out * (clear - at_turn).0.signum(), y, z], lead })
}

/// Grooves or holes cut peck by peck, one beside the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grooving {
    /// The far corner, X as a radius; the start's X where no X is given, likewise Z.
    pub to: (Mm, Mm),
    /// Depth of a peck along the cut; `None` cuts in one go.
    pub peck: Option<Mm>,
    /// Distance between grooves, to the side; `None` cuts one at the start and, if the corner is elsewhere, one there.
    pub step: Option<Mm>,
    /// Way back after a peck.
    pub retract: Mm,
    /// Way to the side at the bottom, before the tool is drawn out.
    pub relief: Mm,
}

/// A rest of the depth or the width that is smaller comes from adding the steps up.
const NEAR: Mm = Mm(1e-6);

/// The strokes of [`Grooving`]: along Z for [`Effect::GrooveFace`], along X for [`Effect::GrooveDiameter`]. Ends where it
/// began.
///
/// # Errors
///
/// A peck or step of zero or less, unknown numbers, other effects.
pub fn grooving(
    effect: Effect,
    from: [Mm; 3],
    words: &Grooving,
    out: &mut dyn FnMut(Stroke),
) -> Result<[Mm; 3], CycleError> {
    let along_z = match effect {
        Effect::GrooveFace => true,
        Effect::GrooveDiameter => false,
        _ => return Err(CycleError::NotThisKind),
    };
    let (peck_letter, step_letter) = if along_z { ('K', 'I') } else { ('I', 'K') };
    for (word, letter) in [(words.peck, peck_letter), (words.step, step_letter)] {
        if let Some(word) = word {
            known(&[word])?;
            if word <= Mm::ZERO {
                return Err(CycleFault::NotPositive(Letter::of(letter)).into());
            }
        }
    }
    let [x0, y, z0] = from;
    let (x1, z1) = words.to;
    known(&[x0, z0, x1, z1, words.retract, words.relief])?;
    let (deep0, deep1, side0, side1) = if along_z { (z0, z1, x0, x1) } else { (x0, x1, z0, z1) };
    let point = |deep: Mm, side: Mm| if along_z { [side, y, deep] } else { [deep, y, side] };
    let deeper = if deep1 < deep0 { -1.0 } else { 1.0 };
    let onward = if side1 < side0 { -1.0 } else { 1.0 };
    let width = (side1 - side0).abs();
    let step = words.step.map_or(width, |step| step.min(width));

    let mut sink = Sink::new(from, out);
    let mut way = Mm::ZERO;
    loop {
        let side = side0 + way * onward;
        sink.rapid_if_elsewhere(point(deep0, side))?;
        let total = (deep1 - deep0).abs();
        let peck = words.peck.unwrap_or(total);
        let mut depth = peck;
        while depth < total - NEAR {
            let level = deep0 + depth * deeper;
            sink.feed(point(level, side))?;
            sink.rapid(point(level - words.retract.min(depth) * deeper, side))?;
            depth += peck;
        }
        sink.feed(point(deep1, side))?;
        if words.relief.abs() > Mm::ZERO {
            sink.rapid(point(deep1, side - words.relief * onward))?;
            sink.rapid(point(deep0, side - words.relief * onward))?;
        } else {
            sink.rapid(point(deep0, side))?;
        }
        if way >= width {
            break;
        }
        way += step;
        if way > width - NEAR {
            way = width;
        }
    }
    sink.rapid_if_elsewhere(from)?;
    Ok(sink.at)
}

/// How the depth of a multi-pass thread grows, and on which flank.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InFeed {
    /// One edge cuts, every pass the same area.
    #[default]
    OneEdgeConstantLoad,
    /// Both edges in turn, every pass the same area.
    BothEdgesConstantLoad,
    /// One edge, every pass the same depth.
    OneEdgeConstantDepth,
    /// Both edges in turn, every pass the same depth.
    BothEdgesConstantDepth,
}

/// A thread in many passes by its height and first depth, as one block or two blocks give it. Lengths in X are radii.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThreadHeights {
    /// Root at the thread's end: X, Z.
    pub to: (Mm, Mm),
    /// Start less end of a tapered thread, in X.
    pub taper: Mm,
    /// From crest to root.
    pub height: Mm,
    /// Depth of the first pass.
    pub first: Mm,
    /// Passes are at least this deep.
    pub least: Mm,
    /// Left for the last pass.
    pub finish: Mm,
    /// Passes at full depth, at least 1.
    pub finish_passes: u32,
    /// Between the flanks.
    pub angle: Degrees,
    /// Length of the thread's end that leaves the work at 45 degrees.
    pub pull_out: Mm,
    /// Millimetres a turn.
    pub lead: Mm,
    /// Depths and flanks.
    pub in_feed: InFeed,
}

/// The strokes of [`ThreadHeights`]. Ends where it began.
///
/// The depth after n passes of constant load is the first times √n; a pass is never shallower than the least. Every pass
/// begins further along the thread by its depth times the tangent of half the angle, when one edge cuts.
///
/// # Errors
///
/// Height and first depth must be positive, the start must not stand on the thread's root.
pub fn multi_pass_thread(
    from: [Mm; 3],
    words: &ThreadHeights,
    out: &mut dyn FnMut(Stroke),
) -> Result<[Mm; 3], CycleError> {
    let [x0, y, z0] = from;
    let ThreadHeights { to: (x, z), taper, height, first, least, finish, angle, pull_out, lead, .. } = *words;
    known(&[x0, z0, x, z, taper, height, first, least, finish, Mm(angle.0), pull_out, lead])?;
    for (word, letter) in [(height, 'K'), (first, 'D')] {
        if word <= Mm::ZERO {
            return Err(CycleFault::NotPositive(Letter::of(letter)).into());
        }
    }
    // Outside the root the thread is external: crests lie toward the start.
    let outward = if x0 > x { 1.0 } else { -1.0 };
    if (x0 - x).abs() <= Mm::ZERO || (z0 - z).abs() <= Mm::ZERO {
        return Err(CycleFault::Geometry.into());
    }
    let along = if z < z0 { -1.0 } else { 1.0 };
    let slope = (angle / 2.0).radians().tan();
    let both = matches!(words.in_feed, InFeed::BothEdgesConstantLoad | InFeed::BothEdgesConstantDepth);
    let constant_depth =
        matches!(words.in_feed, InFeed::OneEdgeConstantDepth | InFeed::BothEdgesConstantDepth);

    let mut sink = Sink::new(from, out);
    let pass = |depth: Mm, count: u32, sink: &mut Sink<'_>| -> Result<(), CycleError> {
        let flank = if both && count % 2 == 1 { -1.0 } else { 1.0 };
        let start = z0 + depth * slope * along * flank;
        let up = (height - depth) * outward;
        sink.rapid_if_elsewhere([x0, y, start])?;
        sink.rapid([x + taper + up, y, start])?;
        thread_to(sink, (x + up, z), x0, lead, pull_out)?;
        sink.rapid([x0, y, z])?;
        sink.rapid([x0, y, start])
    };
    let rough = (height - finish).max(Mm::ZERO);
    let mut depth = first.min(rough);
    let mut count: u32 = 1;
    while depth < rough {
        pass(depth, count - 1, &mut sink)?;
        count += 1;
        let n = f64::from(count);
        let by_rule = if constant_depth { first * n } else { first * n.sqrt() };
        depth = by_rule.max(depth + least);
        if count >= super::MAX_STROKES {
            return Err(CycleError::TooManyStrokes);
        }
    }
    if rough > Mm::ZERO && finish > Mm::ZERO {
        pass(rough, count - 1, &mut sink)?;
    }
    for _ in 0..words.finish_passes.max(1) {
        pass(height, 0, &mut sink)?;
    }
    sink.rapid_if_elsewhere(from)?;
    Ok(sink.at)
}

/// Which ends of a thread taper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TaperEnds {
    /// At the entry.
    pub entry: bool,
    /// At the exit.
    pub exit: bool,
}

impl TaperEnds {
    /// From `L`: 0 none, 1 entry, 2 exit, 3 both; other numbers count as none.
    pub const fn of(word: i64) -> Self {
        Self { entry: matches!(word, 1 | 3), exit: matches!(word, 2 | 3) }
    }
}

/// A thread in many passes whose depth follows a power of the pass's number, with tapers in and out, the form that names
/// the thread by `P I J K R Q H E L`. Lengths in X are radii.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaperedThread {
    /// The block's point: Z is the thread's end; X and Y are gone to after the last pass.
    pub to: [Mm; 3],
    /// `P`: millimetres a turn.
    pub pitch: Mm,
    /// `I`: from the drive line to the crest; negative toward smaller X.
    pub peak: Mm,
    /// `J`: depth of the first pass, beyond the crest.
    pub first: Mm,
    /// `K`: full depth, beyond the crest.
    pub depth: Mm,
    /// `R`: the depth after n passes is the first times n to the power 1/R. Below 1 counts as 1.
    pub degression: f64,
    /// `Q`: angle of the compound slide.
    pub slide: Degrees,
    /// `H`: passes at full depth after the first at full depth; −1 leaves that one out.
    pub springs: i64,
    /// `E`: length of the tapers.
    pub taper: Mm,
    /// `L`: which ends taper.
    pub ends: TaperEnds,
    /// The units of the program; they decide how passes are counted.
    pub units: Units,
}

/// The strokes of [`TaperedThread`]. The answer is the block's point.
///
/// # Errors
///
/// `I` must not be zero, `J` must be positive, `K` greater than `J`.
pub fn tapered_thread(
    from: [Mm; 3],
    words: &TaperedThread,
    out: &mut dyn FnMut(Stroke),
) -> Result<[Mm; 3], CycleError> {
    let [x0, y, z0] = from;
    let TaperedThread { pitch, peak, first, depth: full, slide, taper, ends, units, .. } = *words;
    let z1 = words.to[2];
    known(&[x0, z0, z1, pitch, peak, first, full, Mm(slide.0), taper, Mm(words.degression)])?;
    if peak.abs() <= Mm::ZERO {
        return Err(CycleFault::Geometry.into());
    }
    if first <= Mm::ZERO {
        return Err(CycleFault::NotPositive(Letter::of('J')).into());
    }
    if full <= first {
        return Err(CycleFault::Geometry.into());
    }
    let inward = if peak > Mm::ZERO { 1.0 } else { -1.0 };
    let along = if z1 > z0 { 1.0 } else { -1.0 };
    let slope = slide.radians().tan();
    let tapered = taper > Mm::ZERO;
    let (entry, exit) = (ends.entry && tapered, ends.exit && tapered);
    let taper_pitch = pitch * (full.0.hypot(taper.0) / taper.0);

    let mut sink = Sink::new(from, out);
    let mut pass = |depth: Mm| -> Result<(), CycleError> {
        // Passes before the last are driven further out, so that every pass leaves the work by the same way.
        let drive = x0 - (full - depth) * inward;
        let crest = drive + peak;
        let root = x0 + peak + depth * inward;
        let start = z0 + depth * slope * along;
        let end = z1 - (full - depth) * slope * along;
        sink.rapid([drive, y, start])?;
        if entry {
            sink.put(Stroke::FeedOverride(false))?;
            sink.put(Stroke::Sync(Some(taper_pitch)))?;
            sink.feed([crest, y, start])?;
            sink.feed([root, y, start + taper * along])?;
        } else {
            sink.rapid([root, y, start])?;
            sink.put(Stroke::FeedOverride(false))?;
        }
        sink.put(Stroke::Sync(Some(pitch)))?;
        if exit {
            sink.feed([root, y, end - taper * along])?;
            sink.put(Stroke::Sync(Some(taper_pitch)))?;
            sink.feed([crest, y, end])?;
        } else {
            sink.feed([root, y, end])?;
        }
        sink.put(Stroke::Sync(None))?;
        sink.rapid([drive, y, end])?;
        sink.put(Stroke::FeedOverride(true))
    };
    let (first_depth, full_depth) = (in_program_units(first, units), in_program_units(full, units));
    // Depths are compared from the drive line, which swallows the last bit of some sums.
    let crest_depth = in_program_units(peak.abs(), units);
    let power = words.degression.max(1.0).recip();
    let mut depth = first_depth;
    let mut count: u32 = 1;
    while crest_depth + depth < crest_depth + full_depth {
        pass(from_program_units(depth, units))?;
        count = count.saturating_add(1);
        depth = first_depth * f64::from(count).powf(power);
    }
    for _ in -1..words.springs {
        pass(full)?;
    }
    sink.rapid(words.to)?;
    Ok(sink.at)
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::cycles::test_support::shown_zx;

    fn at(x: f64, z: f64) -> [Mm; 3] {
        [Mm(x), Mm(0.0), Mm(z)]
    }

    fn check(run: impl FnOnce(&mut dyn FnMut(Stroke)) -> Result<[Mm; 3], CycleError>, expected: &Expect) {
        expected.assert_eq(&shown_zx(|out| run(out).map(drop)));
    }

    fn pass(
        effect: Effect,
        taper: f64,
        pull_out: f64,
    ) -> impl FnOnce(&mut dyn FnMut(Stroke)) -> Result<[Mm; 3], CycleError> {
        move |out| {
            box_pass(effect, at(25.0, 2.0), (Mm(20.0), Mm(-30.0)), Mm(taper), Mm(1.5), Mm(pull_out), out)
        }
    }

    #[test]
    fn a_turning_pass_goes_around_its_box() {
        check(
            pass(Effect::TurningPass, 0.0, 0.0),
            &expect![[r#"
            rapid z2 x20
            feed z-30 x20
            feed z-30 x25
            rapid z2 x25
        "#]],
        );
    }

    #[test]
    fn a_taper_moves_the_start_of_the_cut() {
        check(
            pass(Effect::TurningPass, -3.0, 0.0),
            &expect![[r#"
            rapid z2 x17
            feed z-30 x20
            feed z-30 x25
            rapid z2 x25
        "#]],
        );
        check(
            pass(Effect::FacingPass, -3.0, 0.0),
            &expect![[r#"
            rapid z-33 x25
            feed z-30 x20
            feed z2 x20
            rapid z2 x25
        "#]],
        );
    }

    #[test]
    fn a_threading_pass_is_tied_to_the_spindle_and_may_pull_out() {
        check(
            pass(Effect::ThreadingPass, 0.0, 0.0),
            &expect![[r#"
            rapid z2 x20
            thread z-30 x20 lead 1.5
            rapid z-30 x25
            rapid z2 x25
        "#]],
        );
        check(
            pass(Effect::ThreadingPass, 0.0, 2.0),
            &expect![[r#"
            rapid z2 x20
            thread z-28 x20 lead 1.5
            thread z-30 x22 lead 1.5
            rapid z-30 x25
            rapid z2 x25
        "#]],
        );
    }

    #[test]
    fn face_grooves_peck_along_z_and_step_in_x() {
        let words = Grooving {
            to: (Mm(16.0), Mm(-5.0)),
            peck: Some(Mm(3.0)),
            step: Some(Mm(3.0)),
            retract: Mm(0.5),
            relief: Mm(0.0),
        };
        check(
            |out| grooving(Effect::GrooveFace, at(20.0, 1.0), &words, out),
            &expect![[r#"
            feed z-2 x20
            rapid z-1.5 x20
            feed z-5 x20
            rapid z1 x20
            rapid z1 x17
            feed z-2 x17
            rapid z-1.5 x17
            feed z-5 x17
            rapid z1 x17
            rapid z1 x16
            feed z-2 x16
            rapid z-1.5 x16
            feed z-5 x16
            rapid z1 x16
            rapid z1 x20
        "#]],
        );
    }

    #[test]
    fn diameter_grooves_peck_along_x() {
        let words = Grooving {
            to: (Mm(15.0), Mm(-10.0)),
            peck: Some(Mm(3.0)),
            step: None,
            retract: Mm(0.5),
            relief: Mm(0.1),
        };
        check(
            |out| grooving(Effect::GrooveDiameter, at(20.0, -10.0), &words, out),
            &expect![[r#"
            feed z-10 x17
            rapid z-10 x17.5
            feed z-10 x15
            rapid z-10.1 x15
            rapid z-10.1 x20
            rapid z-10 x20
        "#]],
        );
    }

    /// Ten steps of a tenth are one, though their sum is not: no depth and no side is cut twice.
    #[test]
    fn steps_that_add_up_are_not_cut_twice() {
        let words = Grooving {
            to: (Mm(19.0), Mm(-2.0)),
            peck: Some(Mm(0.1)),
            step: Some(Mm(0.1)),
            retract: Mm(0.0),
            relief: Mm(0.0),
        };
        let mut cuts = Vec::new();
        let mut keep = |stroke: Stroke| {
            if let Stroke::Feed(to) = stroke {
                cuts.push(to);
            }
        };
        grooving(Effect::GrooveDiameter, at(20.0, -1.0), &words, &mut keep).unwrap();
        assert_eq!(cuts.len(), 11 * 10, "eleven plunges of ten pecks");
    }

    #[test]
    fn grooves_without_end_are_refused() {
        let words = Grooving {
            to: (Mm(15.0), Mm(-10.0)),
            peck: Some(Mm(0.0)),
            step: None,
            retract: Mm(0.5),
            relief: Mm(0.0),
        };
        check(
            |out| grooving(Effect::GrooveDiameter, at(20.0, -10.0), &words, out),
            &expect![[r#"
            Fault(NotPositive(I))
        "#]],
        );
        let tiny = Grooving { peck: Some(Mm(1e-9)), ..words };
        let outcome = grooving(Effect::GrooveDiameter, at(20.0, -10.0), &tiny, &mut |_| {});
        assert_eq!(outcome, Err(CycleError::TooManyStrokes));
    }

    fn heights() -> ThreadHeights {
        ThreadHeights {
            to: (Mm(9.0), Mm(-20.0)),
            taper: Mm(0.0),
            height: Mm(1.0),
            first: Mm(0.5),
            least: Mm(0.1),
            finish: Mm(0.1),
            finish_passes: 1,
            angle: Degrees(60.0),
            pull_out: Mm(0.0),
            lead: Mm(1.5),
            in_feed: InFeed::OneEdgeConstantLoad,
        }
    }

    #[test]
    fn thread_passes_grow_by_the_root_of_their_number() {
        check(
            |out| multi_pass_thread(at(12.0, 3.0), &heights(), out),
            &expect![[r#"
            rapid z2.7113 x12
            rapid z2.7113 x9.5
            thread z-20 x9.5 lead 1.5
            rapid z-20 x12
            rapid z2.7113 x12
            rapid z2.5918 x12
            rapid z2.5918 x9.2929
            thread z-20 x9.2929 lead 1.5
            rapid z-20 x12
            rapid z2.5918 x12
            rapid z2.5 x12
            rapid z2.5 x9.134
            thread z-20 x9.134 lead 1.5
            rapid z-20 x12
            rapid z2.5 x12
            rapid z2.4804 x12
            rapid z2.4804 x9.1
            thread z-20 x9.1 lead 1.5
            rapid z-20 x12
            rapid z2.4804 x12
            rapid z2.4226 x12
            rapid z2.4226 x9
            thread z-20 x9 lead 1.5
            rapid z-20 x12
            rapid z2.4226 x12
            rapid z3 x12
        "#]],
        );
    }

    #[test]
    fn an_internal_thread_grows_outward() {
        let words = ThreadHeights {
            to: (Mm(11.0), Mm(-20.0)),
            angle: Degrees(0.0),
            finish: Mm(0.0),
            first: Mm(0.8),
            ..heights()
        };
        check(
            |out| multi_pass_thread(at(9.0, 3.0), &words, out),
            &expect![[r#"
            rapid z3 x10.8
            thread z-20 x10.8 lead 1.5
            rapid z-20 x9
            rapid z3 x9
            rapid z3 x11
            thread z-20 x11 lead 1.5
            rapid z-20 x9
            rapid z3 x9
        "#]],
        );
    }

    #[test]
    fn threads_without_height_are_refused() {
        let words = ThreadHeights { height: Mm(0.0), ..heights() };
        check(
            |out| multi_pass_thread(at(12.0, 3.0), &words, out),
            &expect![[r#"
            Fault(NotPositive(K))
        "#]],
        );
        let words = ThreadHeights { first: Mm(1e-9), least: Mm(0.0), ..heights() };
        let outcome = multi_pass_thread(at(12.0, 3.0), &words, &mut |_| {});
        assert_eq!(outcome, Err(CycleError::TooManyStrokes));
    }

    fn tapered() -> TaperedThread {
        TaperedThread {
            to: at(2.0, -3.0),
            pitch: Mm(1.0),
            peak: Mm(-0.5),
            first: Mm(0.4),
            depth: Mm(0.8),
            degression: 1.0,
            slide: Degrees(0.0),
            springs: 0,
            taper: Mm(0.0),
            ends: TaperEnds::default(),
            units: Units::Mm,
        }
    }

    // `G0 X2 Z5`, `G76 P1 Z-3 I-0.5 J0.4 K0.8 Q29.5 H1 L0`: what the interpreter prints.
    #[test]
    fn a_thread_by_drive_line_and_depth() {
        let words = TaperedThread { slide: Degrees(29.5), springs: 1, ..tapered() };
        check(
            |out| tapered_thread(at(2.0, 5.0), &words, out),
            &expect![[r#"
            rapid z4.7737 x2.4
            rapid z4.7737 x1.1
            feed override false
            sync 1.000000
            feed z-2.7737 x1.1
            sync off
            rapid z-2.7737 x2.4
            feed override true
            rapid z4.5474 x2
            rapid z4.5474 x0.7
            feed override false
            sync 1.000000
            feed z-3 x0.7
            sync off
            rapid z-3 x2
            feed override true
            rapid z4.5474 x2
            rapid z4.5474 x0.7
            feed override false
            sync 1.000000
            feed z-3 x0.7
            sync off
            rapid z-3 x2
            feed override true
            rapid z-3 x2
        "#]],
        );
    }

    // `G76 P1 Z-3 I-0.5 J0.4 K0.8 Q29.5 E0.5 L3 R1.5`.
    #[test]
    fn its_ends_may_taper() {
        let words = TaperedThread {
            slide: Degrees(29.5),
            taper: Mm(0.5),
            ends: TaperEnds::of(3),
            degression: 1.5,
            ..tapered()
        };
        check(
            |out| tapered_thread(at(2.0, 5.0), &words, out),
            &expect![[r#"
            rapid z4.7737 x2.4
            feed override false
            sync 1.886796
            feed z4.7737 x1.9
            feed z4.2737 x1.1
            sync 1.000000
            feed z-2.2737 x1.1
            sync 1.886796
            feed z-2.7737 x1.9
            sync off
            rapid z-2.7737 x2.4
            feed override true
            rapid z4.6408 x2.165
            feed override false
            sync 1.886796
            feed z4.6408 x1.665
            feed z4.1408 x0.865
            sync 1.000000
            feed z-2.4066 x0.865
            sync 1.886796
            feed z-2.9066 x1.665
            sync off
            rapid z-2.9066 x2.165
            feed override true
            rapid z4.5474 x2
            feed override false
            sync 1.886796
            feed z4.5474 x1.5
            feed z4.0474 x0.7
            sync 1.000000
            feed z-2.5 x0.7
            sync 1.886796
            feed z-3 x1.5
            sync off
            rapid z-3 x2
            feed override true
            rapid z-3 x2
        "#]],
        );
    }

    // `G76 P1 Z-3 I0.5 J0.4 K0.8 L2 E0.2 Q30`.
    #[test]
    fn inside_a_bore_it_goes_outward() {
        let words = TaperedThread {
            slide: Degrees(30.0),
            peak: Mm(0.5),
            taper: Mm(0.2),
            ends: TaperEnds::of(2),
            ..tapered()
        };
        check(
            |out| tapered_thread(at(2.0, 5.0), &words, out),
            &expect![[r#"
            rapid z4.7691 x1.6
            rapid z4.7691 x2.9
            feed override false
            sync 1.000000
            feed z-2.5691 x2.9
            sync 4.123106
            feed z-2.7691 x2.1
            sync off
            rapid z-2.7691 x1.6
            feed override true
            rapid z4.5381 x2
            rapid z4.5381 x3.3
            feed override false
            sync 1.000000
            feed z-2.8 x3.3
            sync 4.123106
            feed z-3 x2.5
            sync off
            rapid z-3 x2
            feed override true
            rapid z-3 x2
        "#]],
        );
    }

    // `J.7 K2.1`: three times 0.7 is a little less than 2.1, so that there is a pass more.
    #[test]
    fn its_passes_are_counted_with_the_sums_of_the_interpreter() {
        let count = |first: f64, depth: f64| {
            let words = TaperedThread { first: Mm(first), depth: Mm(depth), ..tapered() };
            let mut passes = 0;
            tapered_thread(at(2.0, 5.0), &words, &mut |stroke| {
                passes += u32::from(stroke == Stroke::Sync(None));
            })
            .map(|_| passes)
        };
        assert_eq!(count(0.7, 2.1), Ok(4));
        assert_eq!(count(0.4, 0.8), Ok(2));
        assert_eq!(count(0.8, 0.8), Err(CycleFault::Geometry.into()));
        assert_eq!(count(0.0, 0.8), Err(CycleFault::NotPositive(Letter::of('J')).into()));
        assert_eq!(count(1e-12, 0.8), Err(CycleError::TooManyStrokes));
        assert_eq!(count(f64::NAN, 0.8), Err(CycleError::Unknown));
    }
}
