//! Lathe cycles that cut a profile: finishing, roughing along Z or X, repeating a pattern.
//!
//! Knows: passes and crossings of levels with a profile. Must not know: which blocks hold the profile, diameters.
//!
//! These are the cycles that name their profile by its first and last block. Sources: Haas Lathe Operator's Manual, G70 to
//! G73; Fanuc's manuals by the same words.

use gcheck_controls::Letter;
use gcheck_geometry::Mm;

use super::profile::{Cut, Point, cuts};
use super::{CycleError, MAX_STROKES, ProfileFault, ProfileSegment, Sink, Stroke, known};
use crate::fault::CycleFault;

/// Profiles may turn back by this much before it counts, millimetres.
const SLACK: f64 = 0.001;

/// Which way the passes of a roughing cycle run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RoughingDirection {
    /// Along Z, layer by layer in X (`G71`).
    AlongZ,
    /// Along X, layer by layer in Z (`G72`).
    AlongX,
}

/// A roughing cycle; the one-block form and the two-block form give the same numbers. Lengths in X are radii.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roughing {
    /// Which way.
    pub direction: RoughingDirection,
    /// Depth of a pass: `D`, or `U` (`W` along X) of the first block.
    pub depth: Mm,
    /// Way back from the work after a pass: `R` of the first block, or a setting.
    pub retract: Mm,
    /// Left for finishing in Z (`W`) and X (half of `U`), with their signs.
    pub stock: (Mm, Mm),
    /// Profiles whose first block moves both axes may turn back in the direction of the layers (type II).
    pub pockets: bool,
}

/// The strokes of a roughing cycle from its start point `from`. Ends where it began.
///
/// Each layer is cut up to the profile shifted by the stock; then the tool follows that profile once. The first piece of
/// the profile, whose way the tool takes from layer to layer, decides between rapid and feed.
///
/// # Errors
///
/// A depth of zero or less; a profile that is empty, begins in the wrong direction, turns back, or lies outside the start
/// point.
pub fn roughing(
    from: [Mm; 3],
    profile: &[ProfileSegment],
    words: &Roughing,
    out: &mut dyn FnMut(Stroke),
) -> Result<[Mm; 3], CycleError> {
    let [x0, y, z0] = from;
    let (stock_z, stock_x) = words.stock;
    known(&[x0, z0, words.depth, words.retract, stock_z, stock_x])?;
    let (letter, along_x) = match words.direction {
        RoughingDirection::AlongZ => ('D', false),
        RoughingDirection::AlongX => ('D', true),
    };
    if words.depth <= Mm::ZERO {
        return Err(CycleFault::NotPositive(Letter::of(letter)).into());
    }
    let cuts = cuts((z0, x0), profile)?;
    let view = View::of(&cuts, along_x)?;
    let cuts: Vec<Cut> = cuts.iter().map(|cut| view.inward(cut)).collect();
    let (u0, v0) = view.point((z0.0, x0.0));
    let (Some(first), Some(last)) = (cuts.first(), cuts.last()) else {
        return Err(ProfileFault::Empty.into());
    };

    let both = (first.to().0 - u0).abs() > SLACK;
    if both && !words.pockets {
        return Err(ProfileFault::FirstPiece.into());
    }
    for (index, cut) in cuts.iter().enumerate().skip(1) {
        for piece in cut.monotonic_pieces() {
            let forth = piece.to().0 >= piece.from().0 - SLACK;
            let out = both || piece.to().1 <= piece.from().1 + SLACK;
            if !(forth && out) {
                return Err(ProfileFault::NotMonotonic(index).into());
            }
            if piece.to().1 < v0 - SLACK {
                return Err(ProfileFault::Start.into());
            }
        }
    }

    let shift = view.point((stock_z.0, stock_x.0));
    let shifted: Vec<Cut> = cuts.iter().map(|cut| cut.shifted(shift)).collect();
    let wall: Vec<Cut> = shifted.iter().skip(1).flat_map(Cut::monotonic_pieces).collect();
    let deepest = wall.iter().map(|piece| piece.to().1).fold(first.to().1 + shift.1, f64::max);
    let end = last.to().0 + shift.0;
    let by_feed = matches!(first, Cut::Line { rapid: false, .. } | Cut::Arc { .. });
    let depth = words.depth.0;
    let retract = words.retract.0.abs();
    if (deepest - v0) / depth > f64::from(MAX_STROKES) {
        return Err(CycleError::TooManyStrokes);
    }

    let mut sink = Sink::new(from, out);
    let point = |point: Point| view.back(point, y);
    let mut layer = 1.0;
    while v0 + layer * depth < deepest - SLACK {
        let level = v0 + layer * depth;
        layer += 1.0;
        for (index, (begin, stop)) in below(&wall, level, u0, end).into_iter().enumerate() {
            if index == 0 {
                if by_feed { sink.feed(point((u0, level))) } else { sink.rapid(point((u0, level))) }?;
            } else {
                // Into a pocket: over the work, then down.
                let (u, _) = view.point(zx(sink.at));
                sink.rapid(point((u, v0)))?;
                sink.rapid(point((begin, v0)))?;
                sink.feed(point((begin, level)))?;
            }
            sink.feed(point((stop, level)))?;
            let up = (level - retract).max(v0);
            sink.rapid_if_elsewhere(point(((stop - retract).max(u0), up)))?;
        }
        let (_, up) = view.point(zx(sink.at));
        sink.rapid_if_elsewhere(point((u0, up)))?;
    }
    // Once along the profile, the stock still on it.
    sink.rapid_if_elsewhere(point((u0 + shift.0, v0)))?;
    for cut in &shifted {
        put_cut(&mut sink, &view.outward(cut), y)?;
    }
    let (u, _) = view.point(zx(sink.at));
    sink.rapid_if_elsewhere(point((u, v0)))?;
    sink.rapid_if_elsewhere(from)?;
    Ok(sink.at)
}

/// The finishing pass: once along the profile, then back to where it began.
///
/// # Errors
///
/// An empty profile or unknown numbers.
pub fn finish_profile(
    from: [Mm; 3],
    profile: &[ProfileSegment],
    out: &mut dyn FnMut(Stroke),
) -> Result<[Mm; 3], CycleError> {
    let [x0, y, z0] = from;
    known(&[x0, z0])?;
    let mut sink = Sink::new(from, out);
    for cut in cuts((z0, x0), profile)? {
        put_cut(&mut sink, &cut, y)?;
    }
    sink.rapid_if_elsewhere(from)?;
    Ok(sink.at)
}

/// A profile cut several times, each time nearer to its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatternRepeat {
    /// How often (`D`, or `R` of the first block).
    pub passes: u32,
    /// Distance of the first pass from the last, in Z (`K`, or `W` of the first block) and X as a radius (`I`, `U`).
    pub total: (Mm, Mm),
    /// Left for finishing in Z (`W`) and X (half of `U`), with their signs.
    pub stock: (Mm, Mm),
}

/// The strokes of [`PatternRepeat`]. Ends where it began.
///
/// # Errors
///
/// No pass, an empty profile, unknown numbers.
pub fn pattern_repeat(
    from: [Mm; 3],
    profile: &[ProfileSegment],
    words: &PatternRepeat,
    out: &mut dyn FnMut(Stroke),
) -> Result<[Mm; 3], CycleError> {
    let [x0, y, z0] = from;
    known(&[x0, z0, words.total.0, words.total.1, words.stock.0, words.stock.1])?;
    if words.passes == 0 {
        return Err(CycleFault::NotPositive(Letter::of('D')).into());
    }
    let cuts = cuts((z0, x0), profile)?;
    let mut sink = Sink::new(from, out);
    for pass in 0..words.passes {
        let left = if words.passes == 1 { 1.0 } else { 1.0 - f64::from(pass) / f64::from(words.passes - 1) };
        let shift = (words.stock.0.0 + words.total.0.0 * left, words.stock.1.0 + words.total.1.0 * left);
        sink.rapid_if_elsewhere([x0 + Mm(shift.1), y, z0 + Mm(shift.0)])?;
        for cut in &cuts {
            put_cut(&mut sink, &cut.shifted(shift), y)?;
        }
    }
    sink.rapid_if_elsewhere(from)?;
    Ok(sink.at)
}

/// The intervals of the first coordinate in which the profile lies deeper than `level`.
fn below(wall: &[Cut], level: f64, begin: f64, end: f64) -> Vec<(f64, f64)> {
    let mut intervals = Vec::new();
    let mut open = Some(begin);
    for piece in wall {
        let (was, is) = (piece.from().1 > level, piece.to().1 > level);
        if was == is {
            continue;
        }
        let at = piece.crossing(level);
        match open.take() {
            Some(begin) => intervals.push((begin, at)),
            None => open = Some(at),
        }
    }
    if let Some(begin) = open {
        intervals.push((begin, end));
    }
    intervals
}

fn zx([x, _, z]: [Mm; 3]) -> Point {
    (z.0, x.0)
}

fn put_cut(sink: &mut Sink<'_>, cut: &Cut, y: Mm) -> Result<(), CycleError> {
    let (z, x) = cut.to();
    let to = [Mm(x), y, Mm(z)];
    match *cut {
        Cut::Line { rapid: true, .. } => sink.rapid(to),
        Cut::Line { .. } => sink.feed(to),
        Cut::Arc { centre, ccw, .. } => sink.put(Stroke::Arc {
            to,
            centre: (Mm(centre.0), Mm(centre.1)),
            turns: if ccw { 1 } else { -1 },
        }),
    }
}

/// Coordinates `(u, v)` in which every roughing cycle looks the same: passes run toward larger u, layers go toward larger v.
struct View {
    transposed: bool,
    signs: Point,
}

impl View {
    fn of(cuts: &[Cut], transposed: bool) -> Result<Self, CycleError> {
        let (Some(first), Some(last)) = (cuts.first(), cuts.last()) else {
            return Err(ProfileFault::Empty.into());
        };
        let swap = |(z, x): Point| if transposed { (x, z) } else { (z, x) };
        let (start, corner, end) = (swap(first.from()), swap(first.to()), swap(last.to()));
        if (corner.1 - start.1).abs() <= SLACK {
            return Err(ProfileFault::FirstPiece.into());
        }
        let sign = |way: f64| if way < 0.0 { -1.0 } else { 1.0 };
        Ok(Self { transposed, signs: (sign(end.0 - start.0), sign(corner.1 - start.1)) })
    }

    fn point(&self, (z, x): Point) -> Point {
        let (u, v) = if self.transposed { (x, z) } else { (z, x) };
        (u * self.signs.0, v * self.signs.1)
    }

    fn back(&self, (u, v): Point, y: Mm) -> [Mm; 3] {
        let (u, v) = (u * self.signs.0, v * self.signs.1);
        let (z, x) = if self.transposed { (v, u) } else { (u, v) };
        [Mm(x), y, Mm(z)]
    }

    fn inward(&self, cut: &Cut) -> Cut {
        let cut = if self.transposed { cut.transposed() } else { *cut };
        cut.mirrored(self.signs)
    }

    fn outward(&self, cut: &Cut) -> Cut {
        let cut = cut.mirrored(self.signs);
        if self.transposed { cut.transposed() } else { cut }
    }
}
