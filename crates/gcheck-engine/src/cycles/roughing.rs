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
    let cuts = shape((z0.0, x0.0), cuts((z0, x0), profile)?, along_x);
    let view = View::of(&cuts, along_x)?;
    let cuts: Vec<Cut> = cuts.iter().map(|cut| view.inward(cut)).collect();
    let (u0, v0) = view.point((z0.0, x0.0));
    let (Some(first), Some(last)) = (cuts.first(), cuts.last()) else {
        return Err(ProfileFault::Empty.into());
    };
    check_shape(&cuts, first, (u0, v0), words.pockets)?;

    let shift = view.point((stock_z.0, stock_x.0));
    let shifted: Vec<Cut> = cuts.iter().map(|cut| cut.shifted(shift)).collect();
    let wall: Vec<Cut> = shifted.iter().skip(1).flat_map(Cut::monotonic_pieces).collect();
    let deepest = wall.iter().map(|piece| piece.to().1).fold(first.to().1 + shift.1, f64::max);
    let depth = words.depth.0;
    if (deepest - v0) / depth > f64::from(MAX_STROKES) {
        return Err(CycleError::TooManyStrokes);
    }

    let mut sink = Sink::new(from, out);
    let layers = Layers {
        view: &view,
        y,
        start: (u0, v0),
        end: last.to().0 + shift.0,
        retract: words.retract.0.abs(),
        by_feed: matches!(first, Cut::Line { rapid: false, .. } | Cut::Arc { .. }),
    };
    let mut layer = 1.0;
    while v0 + layer * depth < deepest - SLACK {
        layers.cut(&mut sink, &wall, v0 + layer * depth)?;
        layer += 1.0;
    }
    // Once along the profile, the stock still on it.
    let point = |point: Point| view.back(point, y);
    sink.rapid_if_elsewhere(point((u0 + shift.0, v0)))?;
    for cut in &shifted {
        put_cut(&mut sink, &view.outward(cut), y)?;
    }
    let (u, _) = view.point(zx(sink.at));
    sink.rapid_if_elsewhere(point((u, v0)))?;
    sink.rapid_if_elsewhere(from)?;
    Ok(sink.at)
}

/// A profile without the rapid at its end that goes back over what was cut: it takes the tool away and is not of the shape.
fn shape(start: Point, mut cuts: Vec<Cut>, along_x: bool) -> Vec<Cut> {
    while let [.., before, Cut::Line { from, to, rapid: true }] = cuts.as_slice() {
        let way = |(z, x): Point| if along_x { x } else { z };
        let forth = way(before.to()) - way(start);
        if (way(*to) - way(*from)) * forth >= 0.0 {
            break;
        }
        cuts.pop();
    }
    cuts
}

/// Can a profile be cut in layers from a start point?
fn check_shape(cuts: &[Cut], first: &Cut, (u0, v0): Point, pockets: bool) -> Result<(), CycleError> {
    let both = (first.to().0 - u0).abs() > SLACK;
    if both && !pockets {
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
    Ok(())
}

/// What the layers of a roughing cycle have in common.
struct Layers<'v> {
    view: &'v View,
    y: Mm,
    start: Point,
    end: f64,
    retract: f64,
    by_feed: bool,
}

impl Layers<'_> {
    /// One layer at its level, up to the wall, and back to its begin.
    fn cut(&self, sink: &mut Sink<'_>, wall: &[Cut], level: f64) -> Result<(), CycleError> {
        let (u0, v0) = self.start;
        let point = |point: Point| self.view.back(point, self.y);
        for (index, (begin, stop)) in below(wall, level, u0, self.end).into_iter().enumerate() {
            if index == 0 {
                if self.by_feed { sink.feed(point((u0, level))) } else { sink.rapid(point((u0, level))) }?;
            } else {
                // Into a pocket: over the work, then down.
                let (u, _) = self.view.point(zx(sink.at));
                sink.rapid(point((u, v0)))?;
                sink.rapid(point((begin, v0)))?;
                sink.feed(point((begin, level)))?;
            }
            sink.feed(point((stop, level)))?;
            let up = (level - self.retract).max(v0);
            sink.rapid_if_elsewhere(point(((stop - self.retract).max(u0), up)))?;
        }
        let (_, up) = self.view.point(zx(sink.at));
        sink.rapid_if_elsewhere(point((u0, up)))
    }
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

    fn back(&self, point: Point, y: Mm) -> [Mm; 3] {
        let (along, across) = (point.0 * self.signs.0, point.1 * self.signs.1);
        let (z, x) = if self.transposed { (across, along) } else { (along, across) };
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

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::cycles::test_support::shown_zx;

    /// A line to X (radius) and Z.
    fn line(x: f64, z: f64) -> ProfileSegment {
        ProfileSegment::Line { to: (Mm(z), Mm(x)), rapid: false }
    }

    fn rapid(x: f64, z: f64) -> ProfileSegment {
        ProfileSegment::Line { to: (Mm(z), Mm(x)), rapid: true }
    }

    fn at(x: f64, z: f64) -> [Mm; 3] {
        [Mm(x), Mm(0.0), Mm(z)]
    }

    fn along_z() -> Roughing {
        Roughing {
            direction: RoughingDirection::AlongZ,
            depth: Mm(4.0),
            retract: Mm(1.0),
            stock: (Mm(0.0), Mm(0.0)),
            pockets: false,
        }
    }

    fn check(from: [Mm; 3], profile: &[ProfileSegment], words: &Roughing, expected: &Expect) {
        expected.assert_eq(&shown_zx(|out| roughing(from, profile, words, out).map(drop)));
    }

    #[test]
    fn layers_are_cut_up_to_the_profile_which_is_followed_last() {
        let profile = [rapid(10.0, 2.0), line(10.0, -10.0), line(15.0, -15.0), line(20.0, -15.0)];
        check(
            at(20.0, 2.0),
            &profile,
            &along_z(),
            &expect![[r#"
            rapid z2 x16
            feed z-15 x16
            rapid z-14 x17
            rapid z2 x17
            rapid z2 x12
            feed z-12 x12
            rapid z-11 x13
            rapid z2 x13
            rapid z2 x20
            rapid z2 x10
            feed z-10 x10
            feed z-15 x15
            feed z-15 x20
            rapid z2 x20
        "#]],
        );
    }

    #[test]
    fn stock_is_left_where_its_signs_say() {
        let profile = [rapid(10.0, 2.0), line(10.0, -10.0), line(20.0, -10.0)];
        let words = Roughing { stock: (Mm(0.1), Mm(0.5)), depth: Mm(6.0), ..along_z() };
        check(
            at(20.0, 2.0),
            &profile,
            &words,
            &expect![[r#"
            rapid z2 x14
            feed z-9.9 x14
            rapid z-8.9 x15
            rapid z2 x15
            rapid z2.1 x20
            rapid z2.1 x10.5
            feed z-9.9 x10.5
            feed z-9.9 x20.5
            rapid z-9.9 x20
            rapid z2 x20
        "#]],
        );
    }

    #[test]
    fn a_bore_is_cut_outward() {
        let profile = [rapid(20.0, 2.0), line(20.0, -10.0), line(10.0, -10.0)];
        let words = Roughing { depth: Mm(6.0), ..along_z() };
        check(
            at(10.0, 2.0),
            &profile,
            &words,
            &expect![[r#"
            rapid z2 x16
            feed z-10 x16
            rapid z-9 x15
            rapid z2 x15
            rapid z2 x10
            rapid z2 x20
            feed z-10 x20
            feed z-10 x10
            rapid z2 x10
        "#]],
        );
    }

    #[test]
    fn faces_are_cut_layer_by_layer_in_z() {
        let profile = [rapid(20.0, -6.0), line(10.0, -6.0), line(10.0, 0.0)];
        let words = Roughing { direction: RoughingDirection::AlongX, ..along_z() };
        check(
            at(20.0, 0.0),
            &profile,
            &words,
            &expect![[r#"
            rapid z-4 x20
            feed z-4 x10
            rapid z-3 x11
            rapid z-3 x20
            rapid z0 x20
            rapid z-6 x20
            feed z-6 x10
            feed z0 x10
            rapid z0 x20
        "#]],
        );
    }

    #[test]
    fn an_arc_ends_layers_where_they_meet_it() {
        // A quarter circle of radius 10 about X20 Z-10, from X10 to X20.
        let arc =
            ProfileSegment::Arc { to: (Mm(-20.0), Mm(20.0)), centre: (Mm(-10.0), Mm(20.0)), ccw: false };
        let profile = [rapid(10.0, 2.0), line(10.0, -10.0), arc];
        check(
            at(20.0, 2.0),
            &profile,
            &along_z(),
            &expect![[r#"
            rapid z2 x16
            feed z-19.1652 x16
            rapid z-18.1652 x17
            rapid z2 x17
            rapid z2 x12
            feed z-16 x12
            rapid z-15 x13
            rapid z2 x13
            rapid z2 x20
            rapid z2 x10
            feed z-10 x10
            arc z-20 x20 about z-10 x20 turns -1
            rapid z2 x20
        "#]],
        );
    }

    #[test]
    fn pockets_need_a_first_block_with_both_axes() {
        let profile =
            [rapid(10.0, 1.0), line(10.0, -5.0), line(16.0, -6.0), line(12.0, -10.0), line(20.0, -12.0)];
        check(at(20.0, 2.0), &profile, &along_z(), &expect!["Profile(FirstPiece)\n"]);
        let words = Roughing { pockets: true, ..along_z() };
        check(
            at(20.0, 2.0),
            &profile,
            &words,
            &expect![[r#"
            rapid z2 x16
            feed z-6 x16
            rapid z-5 x17
            rapid z-5 x20
            rapid z-6 x20
            feed z-6 x16
            feed z-11 x16
            rapid z-10 x17
            rapid z2 x17
            rapid z2 x12
            feed z-5.3333 x12
            rapid z-4.3333 x13
            rapid z2 x13
            rapid z2 x20
            rapid z1 x10
            feed z-5 x10
            feed z-6 x16
            feed z-10 x12
            feed z-12 x20
            rapid z2 x20
        "#]],
        );
        let type_one =
            [rapid(10.0, 2.0), line(10.0, -5.0), line(16.0, -6.0), line(12.0, -10.0), line(20.0, -12.0)];
        check(at(20.0, 2.0), &type_one, &words, &expect!["Profile(NotMonotonic(3))\n"]);
    }

    #[test]
    fn unusable_profiles_are_refused() {
        check(at(20.0, 2.0), &[], &along_z(), &expect!["Profile(Empty)\n"]);
        check(
            at(20.0, 2.0),
            &[line(20.0, -5.0), line(10.0, -5.0)],
            &along_z(),
            &expect!["Profile(FirstPiece)\n"],
        );
        let back = [line(10.0, 2.0), line(10.0, -5.0), line(12.0, -4.0), line(20.0, -8.0)];
        check(at(20.0, 2.0), &back, &along_z(), &expect!["Profile(NotMonotonic(2))\n"]);
        let beyond = [line(10.0, 2.0), line(10.0, -5.0), line(21.0, -5.0)];
        check(at(20.0, 2.0), &beyond, &along_z(), &expect!["Profile(Start)\n"]);
        let good = [line(10.0, 2.0), line(10.0, -5.0), line(20.0, -5.0)];
        check(
            at(20.0, 2.0),
            &good,
            &Roughing { depth: Mm(0.0), ..along_z() },
            &expect!["Fault(NotPositive(D))\n"],
        );
        check(at(20.0, 2.0), &good, &Roughing { depth: Mm(1e-9), ..along_z() }, &expect!["TooManyStrokes\n"]);
        check(at(f64::NAN, 2.0), &good, &along_z(), &expect!["Unknown\n"]);
        let off = ProfileSegment::Arc { to: (Mm(-9.0), Mm(20.0)), centre: (Mm(0.0), Mm(0.0)), ccw: true };
        check(at(20.0, 2.0), &[line(10.0, 2.0), off], &along_z(), &expect!["Profile(Arc(1))\n"]);
    }

    #[test]
    fn finishing_follows_the_profile_and_returns() {
        let profile = [rapid(10.0, 2.0), line(10.0, -10.0), line(15.0, -15.0)];
        expect![[r#"
            rapid z2 x10
            feed z-10 x10
            feed z-15 x15
            rapid z2 x20
        "#]]
        .assert_eq(&shown_zx(|out| finish_profile(at(20.0, 2.0), &profile, out).map(drop)));
    }

    #[test]
    fn a_pattern_comes_nearer_pass_by_pass() {
        let profile = [rapid(10.0, 0.0), line(10.0, -10.0), line(15.0, -10.0)];
        let words = PatternRepeat { passes: 3, total: (Mm(2.0), Mm(4.0)), stock: (Mm(0.1), Mm(0.5)) };
        expect![[r#"
            rapid z7.1 x34.5
            rapid z2.1 x14.5
            feed z-7.9 x14.5
            feed z-7.9 x19.5
            rapid z6.1 x32.5
            rapid z1.1 x12.5
            feed z-8.9 x12.5
            feed z-8.9 x17.5
            rapid z5.1 x30.5
            rapid z0.1 x10.5
            feed z-9.9 x10.5
            feed z-9.9 x15.5
            rapid z5 x30
        "#]]
        .assert_eq(&shown_zx(|out| pattern_repeat(at(30.0, 5.0), &profile, &words, out).map(drop)));
    }
}
