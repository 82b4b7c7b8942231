//! A rapid move at depth from one cut to the next.

use std::ops::Range;

use gcheck_engine::{ArcMove, At, Event, Fact, Spindle, Travel, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary};
use crate::facts::compensation::is_compensated;
use crate::facts::cuts::{Cuts, LEVEL, SURFACE, cutter_radius, point};
use crate::facts::tool_words::ToolWords;
use crate::{Finding, FollowedCx, MakeShared, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Below the zero of the part, a rapid move is where a cut should be:
    ///
    /// * between two cuts at the same depth, through material that was not cut so deep before: at an angle to both,
    ///   tangent to an arc, or with cutter compensation on;
    /// * after an arc, straight on to where the contour began;
    /// * from a cut to a place where the tool is fed down: the retract is missing;
    /// * from a hole that the tool was fed straight down into, sideways through what was not cut;
    /// * from the end of a straight cut back and across to where a parallel one begins;
    /// * down into the part and then sideways, straight into an arc, or up again without a cut;
    /// * from the last cut back over what the cuts enclose, up from there, or to the end of the program.
    ///
    /// A program that does so more than twice does it on purpose, except out of holes: it steps over beside the part. For the
    /// same reason, a move square to two parallel straight cuts is not reported.
    ///
    /// ## Why it matters
    /// A `G0` was written instead of `G1`, and the tool runs through the part at rapid; or the retract was forgotten,
    /// and the tool is dragged to the next place at depth.
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
    /// The retract from the hole is missing.
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X1. Y1. S2000 M3
    /// G43 H1 Z.1
    /// G1 Z-.5 F8.
    /// G0 X2.
    /// Z1.
    /// M30
    /// ```
    /// The retract between two slots is missing.
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X1. Y1. S2000 M3
    /// G43 H1 Z.1
    /// G1 Z-.2 F8.
    /// X3. F30.
    /// G0 X1. Y2.5
    /// G1 X3.
    /// G0 Z1.
    /// M30
    /// ```
    /// Nothing is cut: the plunge should be at feed.
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
            watch: Watch::MOVES.union(Watch::CHANGES).union(Watch::ALL_BLOCKS).union(Watch::FOLLOWED),
            make: || Box::new(RapidBetweenCuts::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidBetweenCuts {
    /// Where the last move ended, as programmed: the path of a cutter of unknown size is not known.
    at: Option<[f64; 3]>,
    /// Where the tool was fed down last.
    start: Option<[f64; 2]>,
    /// The least and the greatest X and Y of the ends of cuts at depth since the tool came.
    extent: Option<[[f64; 2]; 2]>,
    /// The move before, if it was a cut that ended at depth.
    last: Option<Cut>,
    /// Rapid moves at one depth, with no other move since.
    way: Option<Way>,
    /// Ways that are suspicious, unless they are the program's habit.
    found: Vec<Found>,
    /// Ways out of holes, which are nobody's habit.
    dragged: Vec<Finding>,
}

remembers!(RapidBetweenCuts: way, found, dragged);

/// What the next moves need to know of a cut at depth.
#[derive(Clone, Copy, PartialEq)]
struct Cut {
    z: f64,
    /// Its direction at its end; `None` for one that goes down, and if that is unknown.
    heads: Option<[f64; 2]>,
    is_arc: bool,
    /// It went straight down.
    is_plunge: bool,
    /// Where it began and ended.
    ends: [[f64; 2]; 2],
}

/// Rapid moves that follow each other at one depth.
#[derive(Clone, PartialEq)]
struct Way {
    z: f64,
    /// The cut that they come from; `None` if a rapid move came down.
    behind: Option<Cut>,
    /// The first block.
    bytes: Range<u32>,
    /// Where it begins.
    begins: At,
    /// Where the first one goes, and where the last; none yet for a move straight down.
    heads: Option<[[f64; 2]; 2]>,
    to: [f64; 2],
    /// Moves sideways, and those of them with cutter compensation on.
    pieces: usize,
    compensated: usize,
    /// Goes through material that was not cut so deep before; `None` if that is unknown.
    is_new: Option<bool>,
    /// The tool was lifted straight up at the end.
    is_lifted: bool,
    /// A block that does not move has come since it began: the program does something there.
    is_interrupted: bool,
}

remembers!(Way: bytes, begins);

/// A suspicious way.
#[derive(Clone, PartialEq)]
struct Found {
    bytes: Range<u32>,
    /// Its finding, if it is suspicious by itself.
    finding: Option<Finding>,
}

remembers!(Found: bytes, finding);

/// Programs with more such ways step over beside the part.
const MOST: usize = 2;
/// Ways out of holes that are reported.
const MOST_DRAGGED: usize = 8;
/// Shorter ways say nothing: millimetres.
const SHORT: f64 = 2.0;
/// How far beside its path a cutter of unknown diameter clears: millimetres. For suspicions.
const CLEARS: f64 = 6.35;
/// The same of a face mill: millimetres.
const FACE_CLEARS: f64 = 50.0;
/// Sine of an angle below which two ways go in one direction.
const STRAIGHT: f64 = 0.035;
/// The same, of contours whose numbers are rounded coarsely.
const NEARLY_STRAIGHT: f64 = 0.12;

impl PathRule for RapidBetweenCuts {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Cuts::shared)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if boundary(cx) == Some(Boundary::ProgramEnd)
            && let Some(way) = self.way.take()
        {
            self.judge_leave(cx, &way, "the program ends with the tool down");
        }
        if let Some(way) = self.way.as_mut().filter(|_| !cx.names_axes()) {
            way.is_interrupted = true;
        }
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        // The machine decides where the change leaves the tool.
        if matches!(event, Event::ToolChange(_)) {
            (self.at, self.start, self.last, self.way, self.extent) = (None, None, None, None, None);
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if !cx.is_mill() {
            cx.enough();
            return;
        }
        // Surfaces are such moves by the million, and nothing asks where those go.
        if let Event::Travel(travel) = event
            && self.goes_on_slanting(travel)
        {
            return;
        }
        let (programmed, is_expanded) = match event {
            Event::Travel(travel) => (point(&travel.programmed), travel.expanded),
            Event::Arc(arc) => (point(&arc.programmed), arc.expanded),
            _ => (None, true),
        };
        // A move that compensation inserts at a corner does not count; the strokes of a cycle end the present way.
        if is_expanded {
            if !is_compensated(cx) {
                (self.at, self.last, self.way) = (programmed, None, None);
            }
        } else {
            let (at, last, way) = (self.at.take(), self.last.take(), self.way.take_if(|_| true));
            self.at = programmed;
            if let (Some(from), Some(to)) = (at, programmed) {
                match event {
                    Event::Travel(travel) if travel.kind == TravelKind::Rapid => {
                        let is_known = |cuts: &&Cuts| cuts.knows(cx, event) && cuts.are_all_on_their_path();
                        let cuts = cx.shared::<Cuts>().filter(is_known);
                        self.way = self.rapid(cx, cuts, [from, to], last, way);
                    }
                    Event::Travel(travel) if travel.kind == TravelKind::Feed => {
                        self.last = self.feed(cx, [from, to], way);
                    }
                    Event::Arc(arc) => self.last = self.arc(cx, arc, [from, to], way),
                    _ => {}
                }
                if let Some(cut) = self.last {
                    self.extend(&cut);
                }
            }
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        for finding in std::mem::take(&mut self.dragged) {
            report.add(finding);
        }
        let found = std::mem::take(&mut self.found);
        if found.len() <= MOST {
            for finding in found.into_iter().filter_map(|found| found.finding) {
                report.add(finding);
            }
        }
    }
}

impl RapidBetweenCuts {
    /// Takes in a feed move after another move that does not lead on: neither level nor straight down. `false`: it is another move.
    fn goes_on_slanting(&mut self, travel: &Travel) -> bool {
        if travel.kind != TravelKind::Feed || travel.expanded || self.way.is_some() {
            return false;
        }
        let (Some([x0, y0, z0]), Some([x1, y1, z1])) = (self.at, point(&travel.programmed)) else {
            return false;
        };
        let goes_down = z1 < z0 && (x1 - x0).abs() <= LEVEL && (y1 - y0).abs() <= LEVEL;
        if goes_down || (z1 - z0).abs() < LEVEL {
            return false;
        }
        self.at = Some([x1, y1, z1]);
        self.last = None;
        if z1 < SURFACE && z1 <= z0 {
            let ends = [[x0, y0], [x1, y1]];
            let cut = Cut { z: z1, heads: None, is_arc: false, is_plunge: false, ends };
            self.last = Some(cut);
            self.extend(&cut);
        }
        true
    }

    /// The way that this move begins or goes on with.
    fn rapid(
        &mut self,
        cx: &PathCx<'_>,
        cuts: Option<&Cuts>,
        [[x0, y0, z0], [x1, y1, z1]]: [[f64; 3]; 2],
        last: Option<Cut>,
        way: Option<Way>,
    ) -> Option<Way> {
        let heads = direction([x0, y0], [x1, y1]);
        let begin = |behind: Option<Cut>, is_new: Option<bool>| Way {
            z: z1,
            behind,
            bytes: cx.range(),
            begins: cx.origin().at,
            heads: heads.map(|heads| [heads, heads]),
            to: [x1, y1],
            pieces: usize::from(heads.is_some()),
            compensated: usize::from(heads.is_some() && is_compensated(cx)),
            is_new,
            is_lifted: false,
            is_interrupted: false,
        };
        if (z1 - z0).abs() < LEVEL {
            let heads = heads?;
            let is_new = cuts.map(|cuts| self.is_new(cx, cuts, [x0, y0], [x1, y1], z0));
            let way = match (way, last) {
                (Some(way), _) if !way.is_lifted => Way {
                    heads: Some([way.heads.map_or(heads, |[first, _]| first), heads]),
                    to: [x1, y1],
                    pieces: way.pieces + 1,
                    compensated: way.compensated + usize::from(is_compensated(cx)),
                    is_new: way.is_new.zip(is_new).map(|(before, now)| before || now),
                    ..way
                },
                (None, Some(behind)) if (behind.z - z0).abs() < LEVEL => begin(Some(behind), is_new),
                _ => return None,
            };
            self.judge_compensated(cx, &way);
            return Some(way);
        }
        if heads.is_none() && z0 >= 0.0 && z1 < SURFACE {
            let is_open = |cuts: &Cuts| cuts.reach(cuts.len(), [x1, y1], z1, clears(cx));
            return Some(begin(None, cuts.map(|cuts| !is_open(cuts))));
        }
        if heads.is_none() && z1 > z0 {
            let way = way?;
            self.judge_drag(cx, &way);
            self.judge_closing(cx, &way);
            self.judge_leave(cx, &way, "the tool is lifted only here");
            if way.behind.is_none() && z1 > 0.0 {
                self.judge_dip(cx, &way);
                return None;
            }
            return Some(Way { is_lifted: true, ..way });
        }
        None
    }

    /// Does a move at this depth go where nothing was cut so deep?
    fn is_new(&self, cx: &PathCx<'_>, cuts: &Cuts, from: [f64; 2], to: [f64; 2], z: f64) -> bool {
        let (x, y) = (to[0] - from[0], to[1] - from[1]);
        let is_long = x.hypot(y) >= SHORT;
        if self.found.len() > MOST || !is_long {
            return false;
        }
        let clears = clears(cx);
        let is_cut = |part: f64| {
            let at = [from[0] + part * x, from[1] + part * y];
            cuts.reach(cuts.len(), at, z, clears)
        };
        ![0.25, 0.5, 0.75].into_iter().all(is_cut)
    }

    fn feed(
        &mut self,
        cx: &PathCx<'_>,
        [[x0, y0, z0], [x1, y1, z1]]: [[f64; 3]; 2],
        way: Option<Way>,
    ) -> Option<Cut> {
        let is_level = (z1 - z0).abs() < LEVEL;
        let heads = direction([x0, y0], [x1, y1]);
        if let Some(way) = way {
            match heads {
                Some(heads) if is_level && !way.is_lifted => {
                    let ends = [[x0, y0], [x1, y1]];
                    let next = Cut { z: z1, heads: Some(heads), is_arc: false, is_plunge: false, ends };
                    self.judge(cx, &way, next);
                }
                // Up at feed.
                None if z1 > z0 && !way.is_lifted => self.judge_drag(cx, &way),
                // Down at the place where the rapid move ended.
                None if way.behind.is_some() && way.is_lifted && z1 < SURFACE => {
                    self.judge_plunge(cx, &way);
                }
                _ => {}
            }
        }
        if heads.is_none() && z1 < z0 {
            self.start = Some([x1, y1]);
        }
        (z1 < SURFACE && z1 <= z0 + LEVEL).then_some(Cut {
            z: z1,
            heads: heads.filter(|_| is_level),
            is_arc: false,
            is_plunge: heads.is_none() && z1 < z0 - LEVEL,
            ends: [[x0, y0], [x1, y1]],
        })
    }

    fn arc(
        &mut self,
        cx: &PathCx<'_>,
        arc: &ArcMove,
        [[x0, y0, z0], [x1, y1, z1]]: [[f64; 3]; 2],
        way: Option<Way>,
    ) -> Option<Cut> {
        let is_flat = arc.plane == gcheck_geometry::Plane::Xy && (z1 - z0).abs() < LEVEL;
        let centre = [arc.centre.0.0, arc.centre.1.0];
        let heads = |at: [f64; 2]| {
            let [x, y] = direction(centre, at).filter(|_| arc.sweep.is_finite())?;
            Some(if arc.sweep > 0.0 { [-y, x] } else { [y, -x] })
        };
        let ends = [[x0, y0], [x1, y1]];
        let arc_at = |at: [f64; 2]| Cut { z: z1, heads: heads(at), is_arc: true, is_plunge: false, ends };
        if let Some(way) = way.filter(|way| is_flat && !way.is_lifted) {
            self.judge(cx, &way, arc_at([x0, y0]));
        }
        (z1 < SURFACE && is_flat).then(|| arc_at([x1, y1]))
    }

    /// Rapid moves before a cut at their depth.
    fn judge(&mut self, cx: &PathCx<'_>, way: &Way, next: Cut) {
        let Some([first, last]) = way.heads else { return };
        let from_arc = way.behind.is_some_and(|cut| goes_on(&cut, first));
        let into_arc = goes_on(&next, last);
        // Between two arcs that it goes on with, a line belongs to their contour, however narrow that is.
        let is_within = from_arc && into_arc
            || way.behind.is_some() && way.compensated > 0 && is_compensated(cx) && way.is_new != Some(false);
        let is_tangent = (from_arc || into_arc) && way.is_new == Some(true);
        let is_angled = way.pieces == 1
            && way.is_new == Some(true)
            && matches!(
                (way.behind.and_then(|cut| cut.heads), next.heads),
                (Some(behind), Some(next)) if !is_along(behind, next)
            );
        let is_back = way.pieces == 1
            && way.is_new == Some(true)
            && way.behind.is_some_and(|behind| goes_back_across(&behind, first, &next));
        if is_within || is_tangent || is_angled || is_back {
            let message = match way.behind {
                Some(_) => "rapid move at depth between two cuts",
                None => "rapid moves at depth lead straight into a cut",
            };
            let next =
                if into_arc { "an arc goes on straight" } else { "this goes on cutting at the same depth" };
            let finding = tell(cx, way, message, next)
                .at_most(if is_within || is_tangent || is_back { Severity::Warning } else { Severity::Info })
                .help("write `G1` if this belongs to the contour; else retract the tool before it");
            self.keep(way, Some(finding));
        } else if way.behind.is_some() && way.is_new == Some(true) {
            self.keep(way, None);
        }
    }

    /// Rapid moves after a cut with cutter compensation on: one leads away from the contour, more belong to it.
    fn judge_compensated(&mut self, cx: &PathCx<'_>, way: &Way) {
        if way.behind.is_some() && way.compensated == 2 && way.is_new != Some(false) {
            let message = "rapid moves at depth with cutter compensation on";
            let finding = tell(cx, way, message, "and this, still with compensation");
            self.keep(way, Some(finding.help("write `G1` if they belong to the contour")));
        }
    }

    /// Rapid moves after an arc, straight on to where the contour began.
    fn judge_closing(&mut self, cx: &PathCx<'_>, way: &Way) {
        let (Some(behind), Some([first, _]), Some(start)) = (way.behind, way.heads, self.start) else {
            return;
        };
        let is_onward = behind.is_arc
            && behind
                .heads
                .is_some_and(|own| dot(own, first) > 0.0 && across(own, first).abs() < NEARLY_STRAIGHT);
        if is_onward && direction(way.to, start).is_none() {
            let message = "rapid move at depth closes the contour";
            let finding = tell(cx, way, message, "the tool is lifted where it was fed down");
            self.keep(way, Some(finding.help("write `G1` if this belongs to the contour")));
        }
    }

    /// Rapid moves sideways out of a hole, and up after that.
    fn judge_drag(&mut self, cx: &PathCx<'_>, way: &Way) {
        let is_out_of_hole = way.behind.is_some_and(|cut| cut.is_plunge) && way.is_new == Some(true);
        let turns = cx.state().spindle() != Some(Spindle::Stopped);
        if is_out_of_hole && turns && !self.is_dragged(way) && self.dragged.len() < MOST_DRAGGED {
            let message = "rapid move sideways with the tool down in its hole";
            let finding = tell(cx, way, message, "the tool is lifted only here");
            self.dragged.push(finding.help("retract the tool from the part before the rapid move"));
        }
    }

    /// A rapid move from a cut back over what the cuts enclose, with no cut at its end.
    fn judge_leave(&mut self, cx: &PathCx<'_>, way: &Way, why: &str) {
        let (Some(behind), Some([[low_x, low_y], [high_x, high_y]])) = (way.behind, self.extent) else {
            return;
        };
        let [from, to] = [behind.ends[1], way.to];
        let is_enclosed = |part: f64| {
            let [x, y] = [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])];
            x > low_x + SHORT && x < high_x - SHORT && y > low_y + SHORT && y < high_y - SHORT
        };
        let crosses = [0.25, 0.5, 0.75].into_iter().any(is_enclosed);
        // An arc leads off the wall of a pocket, and a tool may go back to where it went in.
        let is_back = self.start.is_some_and(|start| (start[0] - to[0]).hypot(start[1] - to[1]) < CLEARS);
        let is_led_off = behind.is_plunge || behind.is_arc || is_back;
        if way.is_new == Some(true) && way.pieces == 1 && crosses && !is_led_off {
            let message = "rapid move at depth back over the part";
            let finding = tell(cx, way, message, why);
            self.keep(way, Some(finding.help("retract the tool from the part before the rapid move")));
        }
    }

    fn extend(&mut self, cut: &Cut) {
        let [low, high] = self.extent.get_or_insert([cut.ends[1]; 2]);
        for end in cut.ends {
            for ((low, high), at) in low.iter_mut().zip(high.iter_mut()).zip(end) {
                // Nearly all ends are within.
                if at < *low {
                    *low = at;
                }
                if at > *high {
                    *high = at;
                }
            }
        }
    }

    fn is_dragged(&self, way: &Way) -> bool {
        self.dragged.iter().any(|finding| finding.range == way.bytes)
    }

    /// Rapid moves from a cut to where the tool is fed down.
    fn judge_plunge(&mut self, cx: &PathCx<'_>, way: &Way) {
        if way.is_new == Some(true) && !self.is_dragged(way) {
            let message = "rapid move at depth to where the tool goes down next";
            let finding = tell(cx, way, message, "the tool is fed down here");
            self.keep(way, Some(finding.help("retract the tool from the part before the rapid move")));
        }
    }

    /// Rapid moves down and up again.
    fn judge_dip(&mut self, cx: &PathCx<'_>, way: &Way) {
        // If the program does something else at depth, the move is deliberate.
        let goes_on = !way.is_interrupted && way.begins.file == cx.origin().at.file;
        let stands = cx.state().spindle() == Some(Spindle::Stopped)
            && cx.definitions().set_by(Fact::Spindle).is_some();
        if way.is_new == Some(true) && goes_on && !stands {
            let message = "rapid move down into the part and up again, and nothing is cut";
            let finding = tell(cx, way, message, "the tool goes up again");
            self.keep(way, Some(finding.help("write `G1` if the tool is to cut here")));
        }
    }

    /// Keeps a way once, however often a loop repeats it, and no more ways than can be reported.
    fn keep(&mut self, way: &Way, finding: Option<Finding>) {
        if let Some(known) = self.found.iter_mut().find(|found| found.bytes == way.bytes) {
            known.finding = known.finding.take().or(finding);
        } else if self.found.len() <= MOST {
            self.found.push(Found { bytes: way.bytes.clone(), finding });
        }
    }
}

/// Does an arc go on straight in this direction, or come from it?
fn goes_on(cut: &Cut, heads: [f64; 2]) -> bool {
    cut.is_arc && cut.heads.is_some_and(|own| is_along(own, heads) && dot(own, heads) > 0.0)
}

/// Does a way lead from the end of a straight cut back along it, and across to where a parallel cut begins beside it? Then it
/// crosses what lies between the two.
fn goes_back_across(behind: &Cut, heads: [f64; 2], next: &Cut) -> bool {
    let (Some(own), Some(other)) = (behind.heads, next.heads) else { return false };
    if behind.is_arc || next.is_arc || !is_along(own, other) || is_along(own, heads) {
        return false;
    }
    let span = |[from, to]: [[f64; 2]; 2]| {
        let (from, to) = (dot(from, own), dot(to, own));
        (from.min(to), from.max(to))
    };
    let ((low, high), (next_low, next_high)) = (span(behind.ends), span(next.ends));
    let shared = high.min(next_high) - low.max(next_low);
    let half = (high - low).min(next_high - next_low) / 2.0;
    let back = dot(behind.ends[1], own) - dot(next.ends[0], own);
    shared > half && back > half.max(SHORT)
}

fn tell(cx: &PathCx<'_>, way: &Way, message: &str, why: &str) -> Finding {
    let depth = cx.shown(Mm(-way.z));
    let finding = cx.finding(&META, way.bytes.clone(), message).also(cx.range(), why);
    if way.is_new == Some(true) {
        finding
            .label(format!("{depth} below the zero of the part, where no earlier cut is so deep"))
            .assuming("the part is solid where the program has not cut")
    } else {
        finding.label(format!("{depth} below the zero of the part"))
    }
}

/// How far beside its path the tool in the spindle clears, millimetres.
fn clears(cx: &PathCx<'_>) -> f64 {
    cutter_radius(cx).unwrap_or_else(|| if ToolWords::of(cx).faces() { FACE_CLEARS } else { CLEARS })
}

/// Length one; `None` for a way that goes nowhere.
fn direction(from: [f64; 2], to: [f64; 2]) -> Option<[f64; 2]> {
    let (x, y) = (to[0] - from[0], to[1] - from[1]);
    // Not `hypot`, which guards against overflow far beyond any machine and takes ten times as long.
    let length = (x * x + y * y).sqrt();
    (length > LEVEL).then(|| [x / length, y / length])
}

/// Do two directions lie on one line?
fn is_along(a: [f64; 2], b: [f64; 2]) -> bool {
    across(a, b).abs() < STRAIGHT
}

/// The sine of the angle between two directions.
fn across(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    /// Around a part, its corners rounded.
    const ROUND: &str = "G21 G90 G54 G0 X-50. Y0. Z5.\nG1 Z-2. F100.\nY90.\nG2 X-40. Y100. R10.\nG1 X40.\nG2 X50. Y90. R10.\nG1 Y0.\nX-50.\nG0 Z5.\nM30\n";

    #[test]
    fn a_side_of_the_contour() {
        check_rule(&RULE, "haas-mill", ROUND, &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &ROUND.replace("G1 X40.", "G0 X40."),
            &expect![[r#"
            5 | G0 X40.
              | ^^^^^^^ warning[rapid-between-cuts] rapid move at depth between two cuts
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &ROUND.replace("R10.\nG1 Y0.\nX", "R10.\nG0 Y0.\nG1 X"),
            &expect![[r#"
                7 | G0 Y0.
                  | ^^^^^^ warning[rapid-between-cuts] rapid move at depth between two cuts
            "#]],
        );
    }

    #[test]
    fn who_steps_over_beside_the_part_at_rapid() {
        let pass = |y: u8| format!("G0 Y{y}.\nG1 X100.\nG0 Y{}.\nG1 X0.\n", y + 30);
        let program = format!(
            "G21 G90 G54 G0 X0. Y0. Z5.\nG1 Z-2. F100.\nX100.\n{}{}G0 Z5.\nM30\n",
            pass(30),
            pass(90)
        );
        check_rule(&RULE, "haas-mill", &program, &expect![[""]]);
    }

    #[test]
    fn a_corner_of_straight_cuts_is_a_suspicion() {
        let program =
            "G21 G90 G54 G0 X0. Y0. Z5.\nG1 Z-2. F100.\nX50.\nY50.\nG0 X0.\nG1 X-30. Y20.\nG0 Z5.\nM30\n";
        check_rule(
            &RULE,
            "haas-mill",
            program,
            &expect![[r#"
            5 | G0 X0.
              | ^^^^^^ info[rapid-between-cuts] rapid move at depth between two cuts
        "#]],
        );
    }

    #[test]
    fn back_to_zero_with_the_tool_down() {
        let slot = |after: &str| {
            format!("G21 G90 G54 G0 X12. Y10. Z5. S900 M3\nG1 Z-2. F100.\nX80.\nY60.\nX12.\n{after}")
        };
        check_rule(
            &RULE,
            "haas-mill",
            &slot("G0 X60. Y20.\nZ5.\nM30\n"),
            &expect![[r#"
            6 | G0 X60. Y20.
              | ^^^^^^^^^^^^ warning[rapid-between-cuts] rapid move at depth back over the part
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &slot("M5\nG0 X100. Y0.\nM30\n"),
            &expect![[r#"
            7 | G0 X100. Y0.
              | ^^^^^^^^^^^^ warning[rapid-between-cuts] rapid move at depth back over the part
        "#]],
        );
        let pocket = "G21 G90 G54 G0 X40. Y40. Z5. S900 M3\nG1 Z-2. F100.\nX70.\nG3 X70. Y40. I-30. J0.\nG3 X60. Y50. R10.\nG0 X40. Y40.\nZ5.\nM30\n";
        check_rule(&RULE, "haas-mill", pocket, &expect![[""]]);
        for after in ["G0 Z5.\nX60. Y20.\nM30\n", "G0 X0. Y70.\nZ5.\nM30\n", "G0 X12. Y10.\nM30\n"] {
            check_rule(&RULE, "haas-mill", &slot(after), &expect![[""]]);
        }
    }

    #[test]
    fn sideways_out_of_a_hole() {
        let holes = |speed: &str, lift: &str| {
            let hole = |x: u8| format!("G0 X{x}0.\nZ2.\nG1 Z-9. F90.\n{lift}");
            let holes: String = (1..=4).map(hole).collect();
            format!("G21 G90 G54 G0 X0. Y0. Z5. {speed}\n{holes}G0 Z5.\nM30\n")
        };
        check_rule(&RULE, "haas-mill", &holes("S900 M3", "G0 Z2.\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &holes("S900 M3", ""),
            &expect![[r#"
            5 | G0 X20.
              | ^^^^^^^ warning[rapid-between-cuts] rapid move sideways with the tool down in its hole
            8 | G0 X30.
              | ^^^^^^^ warning[rapid-between-cuts] rapid move sideways with the tool down in its hole
            11 | G0 X40.
               | ^^^^^^^ warning[rapid-between-cuts] rapid move sideways with the tool down in its hole
        "#]],
        );
        // A tool that does not turn drills nothing.
        check_rule(&RULE, "haas-mill", &holes("", "").replace("X20.", "X20. Y40."), &expect![[""]]);
        // Along a slot that was cut before.
        let slot = "G21 G90 G54 G0 X0. Y0. Z5. S900 M3\nG1 Z-9. F90.\nX40.\nG0 Z5.\nX0.\nG1 Z-9.\nG0 X40.\nZ5.\nM30\n";
        check_rule(&RULE, "haas-mill", slot, &expect![[""]]);
    }

    #[test]
    fn back_and_across_to_the_next_slot() {
        let slots = |to: &str| {
            format!("G20 G90 G54 G0 X1. Y1.\nG43 H1 Z.1\nG1 Z-.2 F8.\nX3. F30.\n{to}\nG0 Z1.\nM30\n")
        };
        check_rule(
            &RULE,
            "haas-mill",
            &slots("G0 X1. Y2.5\nG1 X3."),
            &expect![[r#"
            5 | G0 X1. Y2.5
              | ^^^^^^^^^^^ warning[rapid-between-cuts] rapid move at depth between two cuts
        "#]],
        );
        // Square to the next pass, so near that the way is open, and around the outside.
        check_rule(&RULE, "haas-mill", &slots("G0 Y2.5\nG1 X1."), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &slots("G0 X1. Y1.2\nG1 X3."), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &slots("G0 X4. Y2.5\nG1 X6."), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &slots("G0 Z.1\nX1. Y2.5\nG1 Z-.2\nX3."), &expect![[""]]);
    }

    #[test]
    fn a_cutter_of_unknown_size_with_compensation_on() {
        let program = "G21 G90 G54 T1 M6\nG0 X-50. Y-50. Z5.\nG1 Z-2. F100.\nG41 D1 X0. Y-20.\nY90.\nG0 X90.\nG1 Y0.\nX-20.\nG40 X-50. Y-50.\nG0 Z5.\nM30\n";
        check_rule(
            &RULE,
            "haas-mill",
            program,
            &expect![[r#"
            6 | G0 X90.
              | ^^^^^^^ warning[rapid-between-cuts] rapid move at depth between two cuts
        "#]],
        );
        let away =
            program.replace("G0 X90.\nG1", "G1 X90.\n").replace("X-20.\nG40 X", "X-20.\nG0 Y-50.\nG40 X");
        check_rule(&RULE, "haas-mill", &away, &expect![[""]]);
    }

    #[test]
    fn back_to_the_middle_of_a_pocket() {
        let program = "G21 G90 G54 G0 X0. Y0. Z5.\nG1 Z-2. F100.\nX30.\nG3 I-30.\nG0 X0.\nZ5.\nM30\n";
        check_rule(&RULE, "haas-mill", program, &expect![[""]]);
    }

    #[test]
    fn beside_the_part_down_and_along_to_the_cut() {
        let program = "G21 G90 G54 G0 X-50. Y0. Z5.\nZ-2.\nX-20.\nG1 X50. F100.\nG0 Z5.\nM30\n";
        check_rule(&RULE, "haas-mill", program, &expect![[""]]);
    }

    #[test]
    fn down_for_something_else_than_a_cut() {
        let program = "G21 G90 G54 G0 X-50. Y0. Z5.\nZ-2.\nX-20.\nM0\nG0 Z5.\nM30\n";
        check_rule(&RULE, "haas-mill", program, &expect![[""]]);
    }

    #[test]
    fn the_contour_is_closed_at_rapid() {
        let program = ROUND
            .replace("G1 Y0.\nX-50.", "G1 Y0.\nX-40.\nG2 X-50. Y10. R10.\nG0 Y90.")
            .replace("Z5.\nG1 Z-2. F100.\nY90.", "Y90.\nZ5.\nG1 Z-2. F100.");
        check_rule(
            &RULE,
            "haas-mill",
            &program,
            &expect![[r#"
            10 | G0 Y90.
               | ^^^^^^^ warning[rapid-between-cuts] rapid move at depth closes the contour
        "#]],
        );
    }
}
