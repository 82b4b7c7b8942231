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
fn thread_to(sink: &mut Sink<'_>, (x, z): (Mm, Mm), clear: Mm, lead: Mm, pull_out: Mm) -> Result<(), CycleError> {
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
        while depth < total {
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
        way = (way + step).min(width);
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
    let constant_depth = matches!(words.in_feed, InFeed::OneEdgeConstantDepth | InFeed::BothEdgesConstantDepth);

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
    let along = if z1 < z0 { -1.0 } else { 1.0 };
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
    let power = words.degression.max(1.0).recip();
    let mut depth = first_depth;
    let mut count: u32 = 1;
    while depth < full_depth {
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
