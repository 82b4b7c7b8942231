//! Lathe cycles whose profile is a subprogram: roughing layer by layer with or without pockets, and finishing passes.
//!
//! Knows: offsets of a profile, layers, the way in and out of pockets. Must not know: which program holds the profile,
//! diameters.
//!
//! Source: LinuxCNC by observation of its interpreter, whose strokes these are, repeated points included. The profile's
//! first piece only says where the contour begins; what is cut begins at its end. Whether a piece was programmed as a
//! rapid does not matter to these cycles.

use gcheck_controls::Letter;
use gcheck_geometry::Mm;

use super::profile::{Cut, Point, cuts, distance};
use super::{CycleError, MAX_STROKES, ProfileFault, ProfileSegment, RoughingDirection, Sink, Stroke, known};
use crate::event::Units;
use crate::fault::CycleFault;

/// Closer than this is the same, millimetres.
const SAME: f64 = 1e-9;
/// An outer corner is rounded when the moved pieces are further apart than this along the passes, in program units.
const CORNER_GAP: f64 = 0.01;

/// What happens where a profile turns back toward the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pockets {
    /// Pockets are cleared (`G71`, `G72`).
    Cleared,
    /// Pockets are passed over (`G71.1`, `G72.1`).
    PassedOver,
    /// Only pockets are cleared (`G71.2`, `G72.2`).
    Only,
}

/// A roughing cycle. Lengths in X are radii.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayeredRoughing {
    /// Which way the passes run.
    pub direction: RoughingDirection,
    /// `I`: distance between layers.
    pub increment: Mm,
    /// `R`: way out of the work after a pass; never more than half the pass, and that much when negative.
    pub retract: Mm,
    /// `D`: left for finishing, all around.
    pub stock: Mm,
    /// What to do with pockets.
    pub pockets: Pockets,
    /// The units of the program.
    pub units: Units,
}

/// Finishing passes. Lengths in X are radii.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayeredFinish {
    /// `D`: distance before the first pass.
    pub first: Mm,
    /// `E`: distance of the last pass.
    pub last: Mm,
    /// `P`: passes.
    pub passes: u32,
    /// The units of the program.
    pub units: Units,
}

/// The strokes of [`LayeredRoughing`] after the move to its start point `from`. Ends at the end of the contour.
///
/// # Errors
///
/// `I` must be positive; the profile must not turn back along the passes; the stock must leave a contour.
pub fn layered_roughing(
    from: [Mm; 3],
    profile: &[ProfileSegment],
    words: &LayeredRoughing,
    out: &mut dyn FnMut(Stroke),
) -> Result<[Mm; 3], CycleError> {
    let [x0, y, z0] = from;
    known(&[x0, z0, words.increment, words.retract, words.stock])?;
    if words.increment <= Mm::ZERO {
        return Err(CycleFault::NotPositive(Letter::of('I')).into());
    }
    let along_x = words.direction == RoughingDirection::AlongX;
    let Some(contour) = Contour::of(from, profile, along_x)? else { return Ok(from) };
    let cuts = contour.offset(words.stock.0, words.units)?;
    let Some(first) = cuts.first() else { return Ok(from) };
    let start = contour.approach();
    let mut path = vec![Cut::Line { from: start, to: first.from(), rapid: true }];
    path.extend(cuts.iter().flat_map(Cut::monotonic_pieces));
    if let Some(end) = cuts.last().map(Cut::to)
        && end.1 < start.1 - SAME
    {
        path.push(Cut::Line { from: end, to: (end.0, start.1), rapid: false });
    }
    let (top, bottom) = path
        .iter()
        .map(|piece| piece.to().1)
        .fold((start.1, start.1), |(top, bottom), w| (top.max(w), bottom.min(w)));
    if (top - bottom) / words.increment.0 > f64::from(MAX_STROKES) {
        return Err(CycleError::TooManyStrokes);
    }

    let mut layers = Layers {
        contour: &contour,
        sink: Sink::new(from, out),
        pending: None,
        y,
        increment: words.increment.0,
        retract: words.retract.0,
    };
    layers.rapid(start)?;
    match words.pockets {
        Pockets::Cleared => layers.clear(&path, start.1, None)?,
        Pockets::Only => layers.clear(&path, start.1, Some(()))?,
        Pockets::PassedOver => layers.pass_over(&path, start.1)?,
    }
    layers.flush()?;
    Ok(layers.sink.at)
}

/// The strokes of [`LayeredFinish`] after the move to its start point `from`. Ends at the end of the contour.
///
/// # Errors
///
/// No pass; a profile that turns back; a distance that leaves no contour.
pub fn layered_finish(
    from: [Mm; 3],
    profile: &[ProfileSegment],
    words: &LayeredFinish,
    out: &mut dyn FnMut(Stroke),
) -> Result<[Mm; 3], CycleError> {
    let [x0, y, z0] = from;
    known(&[x0, z0, words.first, words.last])?;
    if words.passes == 0 {
        return Err(CycleFault::NotPositive(Letter::of('P')).into());
    }
    // A profile that goes on along X only, or turns back along Z, is seen from X.
    let upward = only_begins_upward(profile);
    let contour = match Contour::of(from, profile, false) {
        Ok(Some(contour)) if upward => Contour::of(from, profile, true).or(Ok(Some(contour))),
        Err(CycleError::Profile(ProfileFault::NotMonotonic(_))) if !upward => {
            Contour::of(from, profile, true)
        }
        contour => contour,
    };
    let Some(contour) = contour? else { return Ok(from) };
    let mut layers = Layers {
        contour: &contour,
        sink: Sink::new(from, out),
        pending: None,
        y,
        increment: 1.0,
        retract: 0.0,
    };
    for pass in 1..=words.passes {
        let part = f64::from(pass) / f64::from(words.passes);
        let cuts = contour.offset((words.first + (words.last - words.first) * part).0, words.units)?;
        let Some(first) = cuts.first() else { return Ok(from) };
        layers.rapid(contour.approach())?;
        layers.rapid(first.from())?;
        for cut in &cuts {
            layers.follow(cut, cut.to())?;
        }
        layers.flush()?;
    }
    Ok(layers.sink.at)
}

/// Does a profile go toward +Z, and that in its first piece only?
fn only_begins_upward(profile: &[ProfileSegment]) -> bool {
    let mut levels = profile.iter().map(|segment| match segment {
        ProfileSegment::Line { to, .. } | ProfileSegment::Arc { to, .. } => to.0.0,
    });
    let (Some(begin), Some(top)) = (levels.next(), levels.next()) else { return false };
    top > begin + SAME && levels.all(|level| (level - top).abs() <= SAME)
}

/// A profile in coordinates `(u, w)`: it runs toward larger u, and its end lies at a larger w than its start.
struct Contour {
    transposed: bool,
    signs: Point,
    /// The start point of the cycle.
    start: Point,
    /// The start point lies deeper than the profile's begin, so that stock is left on the other side.
    inside_out: bool,
    cuts: Vec<Cut>,
}

impl Contour {
    /// `None` when the profile has no piece beyond its start: there is nothing to cut then.
    fn of(from: [Mm; 3], profile: &[ProfileSegment], transposed: bool) -> Result<Option<Self>, CycleError> {
        let [x0, _, z0] = from;
        if profile.len() < 2 {
            return Ok(None);
        }
        let cuts = cuts((z0, x0), profile)?;
        let cuts: Vec<Cut> =
            cuts.iter().skip(1).map(|cut| if transposed { cut.transposed() } else { *cut }).collect();
        let (Some(first), Some(last)) = (cuts.first(), cuts.last()) else { return Ok(None) };
        // What does not move at all counts as falling, but X across passes along Z as rising.
        let sign =
            |from: f64, to: f64, rises: bool| if to > from || rises && to >= from { 1.0 } else { -1.0 };
        let (begin, end) = (first.from(), last.to());
        let signs = (sign(begin.0, end.0, false), sign(begin.1, end.1, !transposed));
        let cuts: Vec<Cut> = cuts.iter().map(|cut| cut.mirrored(signs)).collect();
        for (index, cut) in cuts.iter().enumerate() {
            if cut.monotonic_pieces().iter().any(|piece| piece.to().0 < piece.from().0 - SAME) {
                return Err(ProfileFault::NotMonotonic(index + 1).into());
            }
        }
        let (u, w) = if transposed { (x0.0, z0.0) } else { (z0.0, x0.0) };
        let start = (u * signs.0, w * signs.1);
        let begin_w = begin.1 * signs.1;
        let rises = end.1 * signs.1 > begin_w;
        // A profile that begins with a climb hides a start point below it; one of a single piece has but one side.
        let mut ways = cuts.iter().map(direction);
        let hidden = match (ways.next(), ways.next()) {
            (Some(first), Some(second)) => first.0.abs() <= SAME && first.1 > 0.0 && second.1 > SAME,
            _ => true,
        };
        let inside_out = start.1 < begin_w - SAME && rises && !hidden;
        Ok(Some(Self { transposed, signs, start, inside_out, cuts }))
    }

    /// Where the tool goes before the contour: beside the profile's begin, at the level of the start point.
    fn approach(&self) -> Point {
        (self.start.0.min(self.begin().0), self.start.1)
    }

    fn begin(&self) -> Point {
        self.cuts.first().map_or(self.start, Cut::from)
    }

    fn back(&self, (u, w): Point) -> Point {
        let (u, w) = (u * self.signs.0, w * self.signs.1);
        if self.transposed { (w, u) } else { (u, w) }
    }

    /// The pieces moved by `distance` to the side of the start point: corners that stick out are rounded, others cut where
    /// the pieces meet.
    fn offset(&self, way: f64, units: Units) -> Result<Vec<Cut>, CycleError> {
        if way.abs() <= SAME {
            return Ok(self.cuts.clone());
        }
        let way = if self.inside_out { -way } else { way };
        let gap = CORNER_GAP * units.in_mm();
        let mut moved: Vec<Cut> = Vec::with_capacity(self.cuts.len() * 2);
        for cut in &self.cuts {
            // The interpreter goes on in a way that is not computed here.
            let Some(mut next) = beside(cut, way) else { return Err(CycleError::Unknown) };
            if let Some(last) = moved.last_mut() {
                let (end, begin) = (last.to(), next.from());
                let lines = matches!((&last, cut), (Cut::Line { .. }, Cut::Line { .. }));
                if begin.0 - end.0 > gap {
                    moved.push(Cut::Arc { from: end, to: begin, centre: cut.from(), ccw: way < 0.0 });
                } else if lines || distance(end, begin) > 1e-4 {
                    // Two lines in one direction have no corner that the control could find.
                    let Some(corner) = meeting(last, &next, cut.from()) else {
                        return Err(CycleError::Unknown);
                    };
                    set_to(last, corner);
                    set_from(&mut next, corner);
                }
            }
            moved.push(next);
        }
        Ok(moved)
    }
}

/// The piece moved to its left; `None` where an arc vanishes.
fn beside(cut: &Cut, way: f64) -> Option<Cut> {
    match *cut {
        Cut::Line { from, to, rapid } => {
            let (du, dw) = direction(cut);
            let shift = |(u, w): Point| (u - dw * way, w + du * way);
            Some(Cut::Line { from: shift(from), to: shift(to), rapid })
        }
        Cut::Arc { from, to, centre, ccw } => {
            let radius = distance(from, centre);
            let new = if ccw { radius - way } else { radius + way };
            let scale = new / radius;
            let shift =
                |(u, w): Point| (centre.0 + (u - centre.0) * scale, centre.1 + (w - centre.1) * scale);
            (scale.is_finite() && new > SAME).then(|| Cut::Arc {
                from: shift(from),
                to: shift(to),
                centre,
                ccw,
            })
        }
    }
}

/// Unit tangent at the begin.
fn direction(cut: &Cut) -> Point {
    let (du, dw) = match *cut {
        Cut::Line { from, to, .. } => (to.0 - from.0, to.1 - from.1),
        Cut::Arc { from, centre, ccw, .. } => {
            let (u, w) = (from.0 - centre.0, from.1 - centre.1);
            if ccw { (-w, u) } else { (w, -u) }
        }
    };
    let length = du.hypot(dw);
    if length > 0.0 { (du / length, dw / length) } else { (0.0, 0.0) }
}

fn set_to(cut: &mut Cut, point: Point) {
    match cut {
        Cut::Line { to, .. } | Cut::Arc { to, .. } => *to = point,
    }
}

fn set_from(cut: &mut Cut, point: Point) {
    match cut {
        Cut::Line { from, .. } | Cut::Arc { from, .. } => *from = point,
    }
}

/// Where two pieces, taken as whole lines and circles, meet nearest to `near`.
fn meeting(first: &Cut, second: &Cut, near: Point) -> Option<Point> {
    let candidates = match (*first, *second) {
        (Cut::Line { from, .. }, Cut::Line { from: on, .. }) => {
            let (way, other) = (direction(first), direction(second));
            let cross = way.0 * other.1 - way.1 * other.0;
            if cross.abs() < 1e-9 {
                return None;
            }
            let along = ((on.0 - from.0) * other.1 - (on.1 - from.1) * other.0) / cross;
            [Some((from.0 + way.0 * along, from.1 + way.1 * along)), None]
        }
        (Cut::Line { from, .. }, Cut::Arc { from: on, centre, .. }) => {
            line_and_circle(from, direction(first), centre, distance(on, centre))
        }
        (Cut::Arc { from: on, centre, .. }, Cut::Line { from, .. }) => {
            line_and_circle(from, direction(second), centre, distance(on, centre))
        }
        (Cut::Arc { from, centre, .. }, Cut::Arc { from: on, centre: other, .. }) => {
            let (radius, other_radius) = (distance(from, centre), distance(on, other));
            let apart = distance(centre, other);
            let to_chord = (apart * apart + radius * radius - other_radius * other_radius) / (2.0 * apart);
            let unit = ((other.0 - centre.0) / apart, (other.1 - centre.1) / apart);
            // The common chord as a line, cut by the first circle.
            let foot = (centre.0 + unit.0 * to_chord, centre.1 + unit.1 * to_chord);
            line_and_circle(foot, (-unit.1, unit.0), centre, radius)
        }
    };
    candidates
        .into_iter()
        .flatten()
        .filter(|point| point.0.is_finite() && point.1.is_finite())
        .min_by(|p, q| distance(*p, near).total_cmp(&distance(*q, near)))
}

fn line_and_circle(on: Point, (du, dw): Point, centre: Point, radius: f64) -> [Option<Point>; 2] {
    let along = (centre.0 - on.0) * du + (centre.1 - on.1) * dw;
    let foot = (on.0 + du * along, on.1 + dw * along);
    let off = distance(foot, centre);
    let half = radius * radius - off * off;
    // A tangent may miss by a rounding.
    if half.is_nan() || half < -1e-9 * radius.max(1.0) {
        return [None, None];
    }
    let half = half.max(0.0).sqrt();
    [Some((foot.0 - du * half, foot.1 - dw * half)), Some((foot.0 + du * half, foot.1 + dw * half))]
}

struct Layers<'a, 'b> {
    contour: &'a Contour,
    sink: Sink<'b>,
    /// An arc not handed out yet: its rest may go on with it.
    pending: Option<Cut>,
    y: Mm,
    increment: f64,
    retract: f64,
}

impl Layers<'_, '_> {
    fn point(&self, point: Point) -> [Mm; 3] {
        let (z, x) = self.contour.back(point);
        [Mm(x), self.y, Mm(z)]
    }

    fn rapid(&mut self, to: Point) -> Result<(), CycleError> {
        self.flush()?;
        self.sink.rapid(self.point(to))
    }

    fn feed(&mut self, to: Point) -> Result<(), CycleError> {
        self.flush()?;
        self.sink.feed(self.point(to))
    }

    /// Along a piece from where the tool stands to `to`. Pieces of one arc become one stroke again, except at its top.
    fn follow(&mut self, cut: &Cut, to: Point) -> Result<(), CycleError> {
        let Cut::Arc { from, centre, ccw, .. } = *cut else { return self.feed(to) };
        if distance(from, to) <= SAME && distance(from, cut.to()) > SAME {
            // Nothing of the arc is cut yet.
            return Ok(());
        }
        if let Some(Cut::Arc { to: end, centre: same, ccw: sense, .. }) = &mut self.pending
            && *same == centre
            && *sense == ccw
            && !(end.1 > centre.1 && (end.0 - centre.0).abs() <= 1e-6)
        {
            *end = to;
            return Ok(());
        }
        self.flush()?;
        self.pending = Some(Cut::Arc { from, to, centre, ccw });
        Ok(())
    }

    fn flush(&mut self) -> Result<(), CycleError> {
        let Some(Cut::Arc { to, centre, ccw, .. }) = self.pending.take() else { return Ok(()) };
        let (z, x) = self.contour.back(centre);
        let signs = self.contour.signs;
        let ccw = ccw == ((signs.0 * signs.1 > 0.0) != self.contour.transposed);
        let stroke =
            Stroke::Arc { to: self.point(to), centre: (Mm(z), Mm(x)), turns: if ccw { 1 } else { -1 } };
        self.sink.put(stroke)
    }

    /// Down every pocket layer by layer, up along the contour. With `only_pockets` the first way down is not cleared, and
    /// the layers of every pocket count from its rim.
    fn clear(&mut self, path: &[Cut], top: f64, only_pockets: Option<()>) -> Result<(), CycleError> {
        let mut skipping = only_pockets.is_some();
        let mut rim = top;
        let mut layer = 0.0;
        let mut starts_again = false;
        for (index, piece) in path.iter().enumerate() {
            let (from, to) = (piece.from(), piece.to());
            if to.1 >= from.1 - SAME {
                self.follow(piece, to)?;
                starts_again |= to.1 > from.1 + SAME || skipping;
                skipping = false;
                continue;
            }
            if starts_again {
                starts_again = false;
                if only_pockets.is_some() {
                    (rim, layer) = (from.1, 0.0);
                } else {
                    // The highest layer of all that is not above the rim.
                    layer = ((rim - from.1 - SAME) / self.increment).ceil().max(0.0);
                }
            }
            let rest = path.get(index + 1..).unwrap_or_default();
            if !skipping {
                layer = self.passes(piece, index == 0, rest, rim, layer)?;
            }
            if index == 0 { self.rapid(to)? } else { self.follow(piece, to)? }
        }
        Ok(())
    }

    /// The passes that begin on a piece that leads down; the answer is the next layer.
    fn passes(
        &mut self,
        piece: &Cut,
        by_rapid: bool,
        rest: &[Cut],
        rim: f64,
        mut layer: f64,
    ) -> Result<f64, CycleError> {
        loop {
            let level = rim - layer * self.increment;
            if level > piece.from().1 + SAME || level <= piece.to().1 + SAME {
                return Ok(layer);
            }
            layer += 1.0;
            let begin = (piece.crossing(level), level);
            let stop = rest
                .iter()
                .find(|piece| piece.to().1 >= level - SAME)
                .map_or(piece.to().0, |piece| piece.crossing(level));
            let half = (stop - begin.0) / 2.0;
            let away = if self.retract < 0.0 { half } else { self.retract.min(half) };
            if by_rapid {
                self.rapid(begin)?;
            } else {
                self.follow(piece, begin)?;
            }
            self.feed((stop, level))?;
            self.rapid((stop - away, level + away))?;
            self.rapid((begin.0 + away, level + away))?;
            if by_rapid { self.rapid(begin)? } else { self.feed(begin)? }
        }
    }

    /// The first way down layer by layer, then only upward: over pockets at the level of their rim.
    fn pass_over(&mut self, path: &[Cut], top: f64) -> Result<(), CycleError> {
        let down = path.iter().take_while(|piece| piece.to().1 < piece.from().1 - SAME).count();
        let (first, rest) = path.split_at(down);
        let mut layer = 0.0;
        let mut level = top;
        for (index, piece) in first.iter().enumerate() {
            let beyond = path.get(index + 1..).unwrap_or_default();
            layer = self.passes(piece, index == 0, beyond, top, layer)?;
            if index == 0 {
                self.rapid(piece.to())?;
            } else {
                self.follow(piece, piece.to())?;
            }
            level = piece.to().1;
        }
        let mut over = false;
        let mut around = None;
        for piece in rest {
            let (from, to) = (piece.from(), piece.to());
            if to.1 < level - SAME || to.1 < from.1 - SAME {
                // An arc that begins at its top still names that point.
                if !over
                    && matches!(piece, Cut::Arc { centre, .. }
                        if (from.0 - centre.0).abs() <= 1e-6 && around != Some(*centre))
                {
                    self.feed(from)?;
                }
                over = true;
                continue;
            }
            over = false;
            around = if let Cut::Arc { centre, .. } = piece { Some(*centre) } else { None };
            let begin = if from.1 < level - SAME { (piece.crossing(level), level) } else { from };
            self.feed(begin)?;
            if distance(begin, to) > SAME {
                self.follow(piece, to)?;
            }
            self.flush()?;
            level = to.1;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use expect_test::{Expect, expect};

    use super::*;

    /// `Z X` with a leading `!` for a rapid's end, `@` and the centre for an arc.
    fn strokes(run: impl FnOnce(&mut dyn FnMut(Stroke)) -> Result<[Mm; 3], CycleError>) -> String {
        let mut text = String::new();
        let n = |value: Mm| {
            format!("{:.4}", value.0 + 0.0).trim_end_matches('0').trim_end_matches('.').to_owned()
        };
        let mut width = 0;
        let outcome = run(&mut |stroke| {
            let [x, _, z] = stroke.end().unwrap();
            let mut item = match stroke {
                Stroke::Rapid(_) => format!("rapid {} {}", n(x), n(z)),
                Stroke::Feed(_) => format!("{} {}", n(x), n(z)),
                Stroke::Arc { centre, turns, .. } => {
                    format!("arc {} {} about {} {} turns {turns}", n(x), n(z), n(centre.1), n(centre.0))
                }
                other => format!("{other:?}"),
            };
            item.push_str(", ");
            if width + item.len() > 90 {
                text.push('\n');
                width = 0;
            }
            width += item.len();
            text.push_str(&item);
        });
        if let Err(error) = outcome {
            write!(text, "{error:?}").unwrap();
        }
        text
    }

    /// `X Z` ends of lines; `X Z ccw|cw X Z` arcs with their centre.
    fn profile(text: &str) -> Vec<ProfileSegment> {
        text.split(',')
            .map(|piece| {
                let words: Vec<&str> = piece.split_whitespace().collect();
                let number = |index: usize| Mm(words[index].parse().unwrap());
                let to = (number(1), number(0));
                match words.get(2) {
                    Some(sense) => {
                        ProfileSegment::Arc { to, centre: (number(4), number(3)), ccw: *sense == "ccw" }
                    }
                    None => ProfileSegment::Line { to, rapid: false },
                }
            })
            .collect()
    }

    fn rough(start: (f64, f64), text: &str, words: LayeredRoughing) -> String {
        let from = [Mm(start.0), Mm(0.0), Mm(start.1)];
        strokes(|out| layered_roughing(from, &profile(text), &words, out))
    }

    fn words(increment: f64, retract: f64) -> LayeredRoughing {
        LayeredRoughing {
            direction: RoughingDirection::AlongZ,
            increment: Mm(increment),
            retract: Mm(retract),
            stock: Mm(0.0),
            pockets: Pockets::Cleared,
            units: Units::Mm,
        }
    }

    fn check(shown: &str, expected: &Expect) {
        expected.assert_eq(shown);
    }

    const POCKET: &str = "10 1, 10 -10, 18 -12, 18 -15, 12 -18, 12 -20, 20 -22";

    #[test]
    fn layers_end_at_the_profile_and_the_last_follows_it() {
        check(
            &rough(
                (22.0, 2.0),
                "10 1, 10 -10, 15 -15, 20 -15",
                LayeredRoughing { stock: Mm(0.5), ..words(5.0, 1.0) },
            ),
            &expect![[r#"
            rapid 22 2, rapid 22 2, 22 -14.5, rapid 23 -13.5, rapid 23 1, rapid 22 2, 
            rapid 17 1.5652, 17 -14.5, rapid 18 -13.5, rapid 18 0.5652, rapid 17 1.5652, 
            rapid 12 1.1304, 12 -11.2929, rapid 13 -10.2929, rapid 13 0.1304, rapid 12 1.1304, 
            rapid 10.5 1, 10.5 -9.7929, 15.2071 -14.5, 20 -14.5, 22 -14.5, "#]],
        );
    }

    #[test]
    fn pockets_are_cleared_from_their_rim() {
        check(
            &rough((22.0, 2.0), POCKET, words(2.0, 1.0)),
            &expect![[r#"
            rapid 22 2, rapid 22 2, 22 -22, rapid 23 -21, rapid 23 1, rapid 22 2, rapid 20 1.8333, 
            20 -22, rapid 21 -21, rapid 21 0.8333, rapid 20 1.8333, rapid 18 1.6667, 18 -12, 
            rapid 19 -11, rapid 19 0.6667, rapid 18 1.6667, rapid 16 1.5, 16 -11.5, rapid 17 -10.5, 
            rapid 17 0.5, rapid 16 1.5, rapid 14 1.3333, 14 -11, rapid 15 -10, rapid 15 0.3333, 
            rapid 14 1.3333, rapid 12 1.1667, 12 -10.5, rapid 13 -9.5, rapid 13 0.1667, 
            rapid 12 1.1667, rapid 10 1, 10 -10, 18 -12, 18 -15, 18 -15, 18 -21.5, rapid 19 -20.5, 
            rapid 19 -16, 18 -15, 16 -16, 16 -21, rapid 17 -20, rapid 17 -17, 16 -16, 14 -17, 
            14 -20.5, rapid 15 -19.5, rapid 15 -18, 14 -17, 12 -18, 12 -20, 20 -22, 22 -22, "#]],
        );
    }

    #[test]
    fn pockets_may_be_passed_over() {
        check(
            &rough((22.0, 2.0), POCKET, LayeredRoughing { pockets: Pockets::PassedOver, ..words(6.0, 1.0) }),
            &expect![[r#"
            rapid 22 2, rapid 22 2, 22 -22, rapid 23 -21, rapid 23 1, rapid 22 2, rapid 16 1.5, 
            16 -11.5, rapid 17 -10.5, rapid 17 0.5, rapid 16 1.5, rapid 10 1, 10 1, 10 -10, 10 -10, 
            18 -12, 18 -12, 18 -15, 18 -21.5, 20 -22, 20 -22, 22 -22, "#]],
        );
    }

    #[test]
    fn pockets_may_be_all_that_is_cleared() {
        check(
            &rough((22.0, 2.0), POCKET, LayeredRoughing { pockets: Pockets::Only, ..words(2.0, 1.0) }),
            &expect![[r#"
            rapid 22 2, rapid 10 1, 10 -10, 18 -12, 18 -15, 18 -15, 18 -21.5, rapid 19 -20.5, 
            rapid 19 -16, 18 -15, 16 -16, 16 -21, rapid 17 -20, rapid 17 -17, 16 -16, 14 -17, 
            14 -20.5, rapid 15 -19.5, rapid 15 -18, 14 -17, 12 -18, 12 -20, 20 -22, 22 -22, "#]],
        );
    }

    #[test]
    fn stock_rounds_outer_corners() {
        check(
            &rough((22.0, 2.0), POCKET, LayeredRoughing { stock: Mm(0.5), ..words(6.0, 1.0) }),
            &expect![[r#"
            rapid 22 2, rapid 22 2, 22 -21.5149, rapid 23 -20.5149, rapid 23 1, rapid 22 2, 
            rapid 16 1.4783, 16 -10.9846, rapid 17 -9.9846, rapid 17 0.4783, rapid 16 1.4783, 
            rapid 10.5 1, 10.5 -9.6096, 18.1213 -11.5149, arc 18.5 -12 about 18 -12 turns 1, 
            18.5 -15, arc 18.2236 -15.4472 about 18 -15 turns 1, 16 -16.559, 16 -20.4846, 
            rapid 17 -19.4846, rapid 17 -17.559, 16 -16.559, 12.5 -18.309, 12.5 -19.6096, 
            20.1213 -21.5149, 22 -21.5149, "#]],
        );
    }

    #[test]
    fn arcs_are_followed_in_parts_where_layers_begin_on_them() {
        check(
            &rough((22.0, 2.0), "10 1, 10 -4, 20 -4, 20 -14 cw 20 -9, 21 -20", words(3.0, 0.5)),
            &expect![[r#"
            rapid 22 2, rapid 22 2, 22 -20, rapid 22.5 -19.5, rapid 22.5 1.5, rapid 22 2, 
            rapid 19 1.75, 19 -4, rapid 19.5 -3.5, rapid 19.5 1.25, rapid 19 1.75, rapid 16 1.5, 
            16 -4, rapid 16.5 -3.5, rapid 16.5 1, rapid 16 1.5, rapid 13 1.25, 13 -4, 
            rapid 13.5 -3.5, rapid 13.5 0.75, rapid 13 1.25, rapid 10 1, 10 -4, 20 -4, 
            arc 19 -4.101 about 20 -9 turns -1, 19 -13.899, rapid 19.5 -13.399, rapid 19.5 -4.601, 
            19 -4.101, arc 16 -6 about 20 -9 turns -1, 16 -12, rapid 16.5 -11.5, rapid 16.5 -6.5, 
            16 -6, arc 20 -14 about 20 -9 turns -1, 21 -20, 22 -20, "#]],
        );
        check(
            &rough((22.0, 2.0), "10 1, 10 -4, 20 -4, 20 -14 ccw 20 -9, 21 -20", words(6.0, 0.5)),
            &expect![[r#"
            rapid 22 2, rapid 22 2, 22 -4.4174, rapid 22.5 -3.9174, rapid 22.5 1.5, rapid 22 2, 
            rapid 16 1.5, 16 -4, rapid 16.5 -3.5, rapid 16.5 1, rapid 16 1.5, rapid 10 1, 10 -4, 
            20 -4, arc 25 -9 about 20 -9 turns 1, arc 22 -13.5826 about 20 -9 turns 1, 22 -20, 
            rapid 22.5 -19.5, rapid 22.5 -14.0826, 22 -13.5826, arc 20 -14 about 20 -9 turns 1, 
            21 -20, 22 -20, "#]],
        );
    }

    #[test]
    fn short_passes_leave_by_half_their_length() {
        check(
            &rough((20.0, 2.0), "16 1, 12 -4, 14 -5, 10 -8, 15 -9, 9 -10, 20 -15", words(3.0, 2.0)),
            &expect![[r#"
            rapid 20 2, rapid 20 2, 20 -15, rapid 22 -13, rapid 22 0, rapid 20 2, rapid 17 1.25, 
            17 -13.6364, rapid 19 -11.6364, rapid 19 -0.75, rapid 17 1.25, rapid 16 1, 14 -1.5, 
            14 -5, rapid 15.75 -3.25, rapid 15.75 -3.25, 14 -1.5, 12 -4, 14 -5, 14 -5, 14 -8.8, 
            rapid 15.9 -6.9, rapid 15.9 -6.9, 14 -5, 11 -7.25, 11 -8.2, rapid 11.475 -7.725, 
            rapid 11.475 -7.725, 11 -7.25, 10 -8, 15 -9, 14 -9.1667, 14 -12.2727, 
            rapid 15.553 -10.7197, rapid 15.553 -10.7197, 14 -9.1667, 11 -9.6667, 11 -10.9091, 
            rapid 11.6212 -10.2879, rapid 11.6212 -10.2879, 11 -9.6667, 9 -10, 20 -15, "#]],
        );
    }

    #[test]
    fn holes_are_bored_from_the_inside() {
        check(
            &rough((2.0, 2.0), "10 1, 10 -10, 5 -15, 2 -15", words(4.0, 1.0)),
            &expect![[r#"
            rapid 2 2, rapid 2 2, 2 -15, rapid 1 -14, rapid 1 1, rapid 2 2, rapid 6 1.5, 6 -14, 
            rapid 5 -13, rapid 5 0.5, rapid 6 1.5, rapid 10 1, 10 -10, 5 -15, 2 -15, "#]],
        );
    }

    #[test]
    fn faces_are_cut_along_x() {
        check(
            &rough(
                (22.0, 2.0),
                "10 1, 10 -10, 15 -15, 20 -15",
                LayeredRoughing { direction: RoughingDirection::AlongX, ..words(3.0, 1.0) },
            ),
            &expect!["rapid 10 2, 10 1, 10 -10, 15 -15, 20 -15, "],
        );
    }

    #[test]
    fn finishing_comes_nearer_pass_by_pass() {
        let shown = strokes(|out| {
            layered_finish(
                [Mm(22.0), Mm(0.0), Mm(2.0)],
                &profile("10 1, 10 -10, 15 -15, 20 -15"),
                &LayeredFinish { first: Mm(1.0), last: Mm(0.2), passes: 3, units: Units::Mm },
                out,
            )
        });
        check(
            &shown,
            &expect![[r#"
            rapid 22 2, rapid 10.7333 1, 10.7333 -9.6962, 15.3038 -14.2667, 20 -14.2667, rapid 22 2, 
            rapid 10.4667 1, 10.4667 -9.8067, 15.1933 -14.5333, 20 -14.5333, rapid 22 2, 
            rapid 10.2 1, 10.2 -9.9172, 15.0828 -14.8, 20 -14.8, "#]],
        );
    }

    #[test]
    fn unusable_profiles_are_refused() {
        check(
            &rough((22.0, 2.0), "10 1, 10 -10, 18 -12, 18 -11, 20 -22", words(2.0, 1.0)),
            &expect!["Profile(NotMonotonic(3))"],
        );
        check(&rough((22.0, 2.0), "10 1, 10 -10", words(0.0, 1.0)), &expect!["Fault(NotPositive(I))"]);
        check(&rough((22.0, 2.0), "10 1", words(1.0, 1.0)), &expect![[r#""#]]);
        check(&rough((22.0, 2.0), "10 1, 10 -10, 18 -12", words(1e-9, 1.0)), &expect!["TooManyStrokes"]);
        let collinear = LayeredRoughing { stock: Mm(0.5), ..words(2.0, 1.0) };
        check(&rough((22.0, 2.0), "10 1, 10 0, 10 -10, 20 -12", collinear), &expect!["Unknown"]);
    }
}
