//! A rapid move at depth from one cut to the next.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{ArcMove, At, Event, Fact, Role, Spindle, Travel, TravelKind};
use gcheck_geometry::Mm;

use super::rapid_in_material::{Cuts, cutter_radius, point};
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{Finding, FinishCx, PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// Below the zero of the part a cut ends, a rapid move goes sideways at the same depth, where nothing was cut so deep
    /// before, and behind it the tool goes on as if it were in one contour: it cuts on at that depth, at an angle to the cut
    /// before, along an arc or with cutter compensation on. Or it is fed down at the place where the rapid move ends.
    ///
    /// The same is said of rapid moves that lead down into the part and along, straight on into an arc or up again without
    /// a cut: nobody drives there for nothing.
    ///
    /// A program that does so more than twice has its reasons: it steps over beside the part. From one straight cut to one
    /// beside it nothing is said, for the same reason.
    ///
    /// ## Why it matters
    /// A `G0` stands where `G1` was meant, and the tool runs through the part at rapid; or the retract was forgotten, and the
    /// tool is dragged to the next place at depth.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X-50. Y0.
    /// G43 H1 Z5.
    /// G1 Z-2. F100.
    /// Y90.
    /// G2 X-40. Y100. R10.
    /// G0 X40.
    /// G2 X50. Y90. R10.
    /// G1 Y0.
    /// G0 Z5.
    /// M30
    /// ```
    /// The retract is missing.
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G43 H1 Z5.
    /// G1 Z-2. F100.
    /// X20.
    /// G0 X80. Y60.
    /// Z2.
    /// G1 Z-2.
    /// Y90.
    /// G0 Z5.
    /// M30
    /// ```
    /// Nothing is cut: the plunge was meant to be fed.
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G43 H1 Z5.
    /// Z-2.
    /// X20.
    /// G0 Z5.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X-50. Y0.
    /// G43 H1 Z5.
    /// G1 Z-2. F100.
    /// X100.
    /// G0 Y30.
    /// G1 X-50.
    /// G0 Z5.
    /// M30
    /// ```
    rule "rapid-between-cuts" in "motion" {
        summary: "rapid move at depth between two cuts",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::FINISH),
            make: || Box::new(RapidBetweenCuts::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidBetweenCuts {
    cuts: Cuts,
    /// The move before, when it was a cut that ended at depth.
    last: Option<Cut>,
    /// Rapid moves at the depth of the cut before them, with no other move since.
    way: Option<Way>,
    /// Ways through what was not cut, in text order of their findings.
    found: Vec<Found>,
}

remembers!(RapidBetweenCuts: way, found);

/// A cut at depth, as far as its neighbours ask.
#[derive(Clone, Copy, PartialEq)]
struct Cut {
    z: f64,
    /// Where it goes at its end; `None` for one that goes down.
    heads: Option<[f64; 2]>,
    is_arc: bool,
}

/// Rapid moves that follow each other at one depth.
#[derive(Clone, PartialEq)]
struct Way {
    z: f64,
    /// The cut that they come from; `None` where a rapid move came down.
    behind: Option<Cut>,
    /// The first block.
    bytes: Range<u32>,
    /// The first block, and the one under way.
    blocks: [At; 2],
    /// Where the first one goes, and where the last; none yet for a move straight down.
    heads: Option<[[f64; 2]; 2]>,
    /// Moves sideways.
    pieces: usize,
    /// They go through what was not cut so deep before.
    is_new: bool,
    is_compensated: bool,
    /// The tool was lifted straight up at the end.
    is_lifted: bool,
}

remembers!(Way: bytes, blocks);

/// A way through what was not cut before.
#[derive(Clone, PartialEq)]
struct Found {
    bytes: Range<u32>,
    /// What is to be said of it, if that alone is odd.
    finding: Option<Finding>,
}

remembers!(Found: bytes, finding);

/// Programs with more such ways step over beside the part.
const MOST: usize = 2;
/// Shorter ways say nothing: millimetres.
const SHORT: f64 = 2.0;
/// Levels that differ by less are one: millimetres.
const LEVEL: f64 = 1e-4;
/// Depths above this are the surface of the part: millimetres.
const SURFACE: f64 = -0.01;
/// How far beside its path a cutter clears of which nobody knows how wide it is: millimetres. For suspicions.
const CLEARS: f64 = 6.35;
/// Sine of an angle below which two ways go in one direction.
const STRAIGHT: f64 = 0.035;

impl PathRule for RapidBetweenCuts {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        let (last, way) = (self.last.take(), self.way.take());
        if !self.cuts.follows(cx, event) {
            return;
        }
        match event {
            Event::Travel(travel) if travel.expanded => {}
            Event::Travel(travel) if travel.kind == TravelKind::Rapid => {
                self.way = self.rapid(cx, travel, last, way);
            }
            Event::Travel(travel) if travel.kind == TravelKind::Feed => {
                self.last = self.feed(cx, travel, way);
            }
            Event::Arc(arc) if !arc.expanded => self.last = self.arc(cx, arc, way),
            _ => {}
        }
        self.cuts.add(event);
    }

    fn finish(&mut self, _: &FinishCx<'_>, report: &mut Report<'_>) {
        let found = std::mem::take(&mut self.found);
        if found.len() <= MOST {
            for finding in found.into_iter().filter_map(|found| found.finding) {
                report.add(finding);
            }
        }
    }
}

impl RapidBetweenCuts {
    /// The way that this move begins or goes on with.
    fn rapid(
        &mut self,
        cx: &PathCx<'_>,
        travel: &Travel,
        last: Option<Cut>,
        way: Option<Way>,
    ) -> Option<Way> {
        let ([x0, y0, z0], [x1, y1, z1]) = (point(&travel.from)?, point(&travel.to)?);
        let heads = direction([x0, y0], [x1, y1]);
        let at = cx.origin().at;
        let begin = |behind: Option<Cut>, is_new: bool| Way {
            z: z1,
            behind,
            bytes: cx.range(),
            blocks: [at, at],
            heads: heads.map(|heads| [heads, heads]),
            pieces: usize::from(heads.is_some()),
            is_new,
            is_compensated: is_compensated(cx),
            is_lifted: false,
        };
        if (z1 - z0).abs() < LEVEL {
            let heads = heads?;
            let is_new = self.is_new(cx, [x0, y0], [x1, y1], z0);
            return match (way, last) {
                (Some(way), _) => (!way.is_lifted).then(|| Way {
                    blocks: [way.blocks[0], at],
                    heads: Some([way.heads.map_or(heads, |[first, _]| first), heads]),
                    pieces: way.pieces + 1,
                    is_new: way.is_new || is_new,
                    is_compensated: way.is_compensated || is_compensated(cx),
                    ..way
                }),
                (None, Some(behind)) if (behind.z - z0).abs() < LEVEL => Some(begin(Some(behind), is_new)),
                _ => None,
            };
        }
        if heads.is_none() && z0 >= 0.0 && z1 < SURFACE {
            return Some(begin(None, !self.cuts.reach(self.cuts.len(), [x1, y1], z1, clears(cx))));
        }
        if heads.is_none() && z1 > z0 {
            let way = way?;
            if way.behind.is_none() && z1 > 0.0 {
                self.judge_dip(cx, &way);
                return None;
            }
            return Some(Way { is_lifted: true, ..way });
        }
        None
    }

    /// Does a move at this depth go where nothing was cut so deep?
    fn is_new(&self, cx: &PathCx<'_>, from: [f64; 2], to: [f64; 2], z: f64) -> bool {
        let (x, y) = (to[0] - from[0], to[1] - from[1]);
        let is_cut = |part: f64| {
            let at = [from[0] + part * x, from[1] + part * y];
            self.cuts.reach(self.cuts.len(), at, z, clears(cx))
        };
        self.found.len() <= MOST && x.hypot(y) >= SHORT && ![0.25, 0.5, 0.75].into_iter().all(is_cut)
    }

    fn feed(&mut self, cx: &PathCx<'_>, travel: &Travel, way: Option<Way>) -> Option<Cut> {
        let ([x0, y0, z0], [x1, y1, z1]) = (point(&travel.from)?, point(&travel.to)?);
        let heads = direction([x0, y0], [x1, y1]);
        let is_level = (z1 - z0).abs() < LEVEL;
        if let Some(way) = way {
            match heads {
                Some(heads) if is_level && !way.is_lifted => {
                    self.judge(cx, &way, Cut { z: z1, heads: Some(heads), is_arc: false });
                }
                // Down at the place where the rapid move ended, or to where the tool stands already.
                None if way.behind.is_some()
                    && (way.is_lifted && z1 < SURFACE || is_level && !way.is_lifted) =>
                {
                    self.judge_plunge(cx, &way);
                }
                _ => {}
            }
        }
        (z1 < SURFACE && z1 <= z0 + LEVEL).then_some(Cut {
            z: z1,
            heads: heads.filter(|_| is_level),
            is_arc: false,
        })
    }

    fn arc(&mut self, cx: &PathCx<'_>, arc: &ArcMove, way: Option<Way>) -> Option<Cut> {
        let ([x0, y0, z0], [x1, y1, z1]) = (point(&arc.from)?, point(&arc.to)?);
        let is_flat = arc.plane == gcheck_geometry::Plane::Xy && (z1 - z0).abs() < LEVEL;
        let centre = [arc.centre.0.0, arc.centre.1.0];
        let heads = |at: [f64; 2]| {
            let [x, y] = direction(centre, at)?;
            Some(if arc.sweep > 0.0 { [-y, x] } else { [y, -x] })
        };
        if let Some(way) = way.filter(|way| is_flat && !way.is_lifted) {
            self.judge(cx, &way, Cut { z: z1, heads: heads([x0, y0]), is_arc: true });
        }
        (z1 < SURFACE && is_flat).then_some(Cut { z: z1, heads: heads([x1, y1]), is_arc: true })
    }

    /// Rapid moves that a cut at their depth follows.
    fn judge(&mut self, cx: &PathCx<'_>, way: &Way, next: Cut) {
        let Some([first, last]) = way.heads.filter(|_| way.is_new) else { return };
        let goes_on = |cut: &Cut, heads: [f64; 2]| {
            cut.is_arc && cut.heads.is_some_and(|own| is_along(own, heads) && dot(own, heads) > 0.0)
        };
        let is_tangent = way.behind.is_some_and(|cut| goes_on(&cut, first)) || goes_on(&next, last);
        let is_within = way.is_compensated && is_compensated(cx) && (way.behind.is_some() || way.pieces > 1);
        let is_angled = way.pieces == 1
            && matches!(
                (way.behind.and_then(|cut| cut.heads), next.heads),
                (Some(behind), Some(next)) if !is_along(behind, next)
            );
        // Down beside the part and on to the cut is how many begin.
        if way.behind.is_none() && !is_tangent && !is_within {
            return;
        }
        let finding = (is_tangent || is_within || is_angled).then(|| {
            let why = if is_tangent { "and an arc goes on straight" } else { "this cuts on at the same depth" };
            let message = match way.behind {
                Some(_) => "rapid move at depth between two cuts",
                None => "rapid moves at depth lead straight into a cut",
            };
            tell(cx, way, message, why)
                .at_most(if is_tangent || is_within { Severity::Warning } else { Severity::Info })
                .help("write `G1` if this belongs to the contour; else lift the tool before it")
        });
        self.keep(way, finding);
    }

    /// Rapid moves from a cut to where the tool is fed down.
    fn judge_plunge(&mut self, cx: &PathCx<'_>, way: &Way) {
        if way.is_new {
            let message = "rapid move at depth to where the tool goes down next";
            let finding = tell(cx, way, message, "the tool is fed down here");
            self.keep(way, Some(finding.help("lift the tool out of the part before the rapid move")));
        }
    }

    /// Rapid moves down and up again.
    fn judge_dip(&mut self, cx: &PathCx<'_>, way: &Way) {
        let [first, last] = way.blocks;
        let at = cx.origin().at;
        // Whoever does something else down there has come for that.
        let goes_on = first.file == at.file
            && at.block == last.block + 1
            && (last.block - first.block) as usize == way.pieces;
        let stands = cx.state().spindle() == Some(Spindle::Stopped) && cx.trace().set_by(Fact::Spindle).is_some();
        if way.is_new && goes_on && !stands {
            let message = "rapid move down into the part and up again, and nothing is cut";
            let finding = tell(cx, way, message, "the tool goes up again");
            self.keep(way, Some(finding.help("write `G1` if the tool is to cut here")));
        }
    }

    /// Notes a way once, however often a loop comes by. More than say something are not kept.
    fn keep(&mut self, way: &Way, finding: Option<Finding>) {
        let is_known = self.found.iter().any(|found| found.bytes == way.bytes);
        if !is_known && self.found.len() <= MOST {
            self.found.push(Found { bytes: way.bytes.clone(), finding });
        }
    }
}

fn tell(cx: &PathCx<'_>, way: &Way, message: &str, why: &str) -> Finding {
    let depth = cx.shown(Mm(-way.z));
    cx.finding(&META, way.bytes.clone(), message)
        .label(format!("{depth} below the zero of the part, where nothing was cut so deep before"))
        .also(cx.range(), why)
        .assuming("the part is solid where the program has not cut")
}

/// How far beside its path the tool in the spindle clears, millimetres.
fn clears(cx: &PathCx<'_>) -> f64 {
    cutter_radius(cx).unwrap_or(CLEARS)
}

fn is_compensated(cx: &PathCx<'_>) -> bool {
    let on = cx.state().effect(Role::Compensation, cx.model);
    on.is_some_and(|effect| effect != Effect::CompensationOff)
}

/// Length one; `None` for a way that goes nowhere.
fn direction(from: [f64; 2], to: [f64; 2]) -> Option<[f64; 2]> {
    let (x, y) = (to[0] - from[0], to[1] - from[1]);
    let length = x.hypot(y);
    (length > LEVEL).then(|| [x / length, y / length])
}

/// Do two directions lie on one line?
fn is_along(a: [f64; 2], b: [f64; 2]) -> bool {
    (a[0] * b[1] - a[1] * b[0]).abs() < STRAIGHT
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
