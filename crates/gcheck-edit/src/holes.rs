//! Holes that plain moves make, as the cycle of a control that would make them.
//!
//! Knows: which strokes a cycle makes (the engine does), how words of a cycle follow from strokes. Must not know: text, how
//! blocks are collected, how a cycle is written.
//!
//! A hole is not recognized by its looks: words are guessed from its moves, and the cycle that the engine makes of them must
//! make these moves.

use gcheck_controls::{Code, CodeIx, CycleRules, Effect};
use gcheck_engine::cycles::{Hole, Overrides, Stroke, hole};
use gcheck_engine::{Machine, Model, Units};
use gcheck_geometry::{Mm, Plane, Seconds};

/// Moves and dwells of one hole that are read, with its approach: a hole with more strokes stays as it is written.
const MOST_DEEDS: usize = 1024;
/// Millimetres within which points are the same.
const SAME: f64 = 1e-3;
/// Seconds within which dwells are the same.
const SAME_TIME: f64 = 1e-4;
/// Rapid moves from one hole to the next: one over the plane, one down, and those that go nowhere.
const MOST_APPROACHES: usize = 6;
/// The cycles that are moves and dwells, the plainest first.
const CYCLES: [Effect; 6] = [
    Effect::CycleDrill,
    Effect::CycleDrillDwell,
    Effect::CyclePeck,
    Effect::CycleChipBreak,
    Effect::CycleBoreFeedOut,
    Effect::CycleBoreDwell,
];

/// What a block did, in X, Y and Z of the program: millimetres, NaN unknown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Deed {
    pub(crate) kind: Kind,
    pub(crate) from: [f64; 3],
    pub(crate) to: [f64; 3],
    /// Index of its block among those that are looked at together.
    pub(crate) block: usize,
}

/// How it was done.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    Rapid,
    Feed,
    /// Seconds.
    Dwell(f64),
}

impl Deed {
    fn goes_nowhere(&self) -> bool {
        !matches!(self.kind, Kind::Dwell(_)) && is_near(self.from, self.to)
    }
}

/// The depths of pecks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Pecks {
    None,
    /// `Q`.
    Equal(f64),
    /// `I`, `J` and `K`: the first, how much less each time, the least.
    Falling([f64; 3]),
}

/// A hole, in the axes of its plane: millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Found {
    pub(crate) cycle: CodeIx,
    /// Where the tool is before it.
    pub(crate) from: [f64; 3],
    pub(crate) at: [f64; 2],
    pub(crate) r: f64,
    pub(crate) bottom: f64,
    pub(crate) pecks: Pecks,
    pub(crate) dwell: Option<f64>,
    /// It leaves the tool at `R`, else at the level that the series began at.
    pub(crate) to_r: bool,
    /// The block with the first cut.
    pub(crate) cut: usize,
    /// How many cuts it is made in.
    pub(crate) cuts: usize,
    /// Deeds that it is made of.
    pub(crate) deeds: usize,
}

/// Why moves that look like a hole are not one of the control's cycles.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Miss {
    /// Index of the block of the first cut.
    pub(crate) block: usize,
    /// A sentence without a capital and a full stop.
    pub(crate) reason: String,
    /// Imperative.
    pub(crate) help: Option<String>,
}

/// What is in effect for a series of holes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Setting {
    pub(crate) plane: Plane,
    pub(crate) units: Units,
    /// The return level in effect is `R`.
    pub(crate) to_r: bool,
}

/// Looks for holes on a control.
pub(crate) struct Finder<'a> {
    pub(crate) model: &'a Model<'a>,
    pub(crate) machine: &'a Machine,
    pub(crate) setting: Setting,
}

/// What follows a way: the same kind of move, or a dwell.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Leg {
    kind: Kind,
    to: [f64; 3],
}

impl Finder<'_> {
    fn rules(&self) -> &CycleRules {
        &self.model.semantics().cycles
    }

    /// A code of the control that makes holes along the normal of the plane in this way, and takes these words.
    fn code(&self, effect: Effect, letters: &[&str]) -> Option<Code<'_>> {
        let control = self.model.control();
        let is_along = |code: &Code<'_>| !self.model.drills_across(control.code_ix(code.number()));
        let takes =
            |code: &Code<'_>, letter: &str| code.entry().words.iter().any(|word| word.letter == letter);
        control
            .codes()
            .filter(|code| code.effect() == effect && is_along(code))
            .find(|code| takes(code, "R") && letters.iter().all(|letter| takes(code, letter)))
    }

    /// Has the control codes for the level that holes are left at?
    fn has_return_levels(&self) -> bool {
        let has = |effect: Effect| self.model.control().codes().any(|code| code.effect() == effect);
        has(Effect::ReturnToR) && has(Effect::ReturnToInitial)
    }

    /// How many deeds the hole has that begins with the first of them, if it has more than are read. What is left of it is not
    /// a hole either.
    pub(crate) fn too_long(&self, deeds: &[Deed]) -> Option<usize> {
        let first: Vec<Deed> = deeds.iter().take(MOST_APPROACHES).map(|deed| self.local(deed)).collect();
        let start = approach(&first);
        let rest = deeds.get(start..)?.iter();
        let count = start + rest.take_while(|deed| is_along_depth(&self.local(deed))).count();
        (count > MOST_DEEDS).then_some(count)
    }

    /// The hole that begins with the first deed. `initial` is the level that its series began at, `cycle` its cycle.
    pub(crate) fn hole(
        &self,
        deeds: &[Deed],
        initial: Option<f64>,
        cycle: Option<CodeIx>,
    ) -> Result<Option<Found>, Miss> {
        let deeds: Vec<Deed> = deeds.iter().take(MOST_DEEDS + 1).map(|deed| self.local(deed)).collect();
        let start = approach(&deeds);
        let (Some(begin), Some(first)) = (deeds.first(), deeds.get(start)) else { return Ok(None) };
        if first.kind != Kind::Feed || !is_along_depth(first) {
            return Ok(None);
        }
        let [x, y, r] = first.from;
        let initial = initial.unwrap_or(begin.from[2]);
        if !r.is_finite() || !initial.is_finite() {
            return Ok(None);
        }
        let rest = deeds.get(start..).unwrap_or_default();
        let down: Vec<Deed> = rest.iter().take_while(|deed| is_along_depth(deed)).copied().collect();
        if start + down.len() > MOST_DEEDS {
            return Ok(None);
        }
        let cuts = cuts(&down);
        let guess = Found {
            cycle: CodeIx::NONE,
            from: begin.from,
            at: [x, y],
            r,
            bottom: f64::NAN,
            pecks: Pecks::None,
            dwell: None,
            to_r: self.setting.to_r,
            cut: first.block,
            cuts: 1,
            deeds: 0,
        };
        let mut best: Option<Found> = None;
        for found in self.guesses(&guess, &cuts, initial) {
            if cycle.is_some_and(|cycle| cycle != found.cycle) {
                continue;
            }
            let Some(legs) = self.legs(&found, initial) else { continue };
            let Some(count) = follow(&legs, begin.from, &deeds) else { continue };
            // A block is taken as a whole.
            let is_cut_in_two =
                deeds.get(count).zip(deeds.get(count - 1)).is_some_and(|(a, b)| a.block == b.block);
            if !is_cut_in_two && best.is_none_or(|best| best.deeds < count) {
                best = Some(Found { deeds: count, ..found });
            }
        }
        let pecks = cuts.iter().take_while(|cut| cut.is_deeper).count();
        match best {
            Some(best) if pecks < 2 || best.cuts > 1 => Ok(Some(best)),
            // With a cycle of its own each peck would be a hole.
            _ if pecks > 1 && cycle.is_none() => self.miss(&guess, &cuts, pecks).map_or(Ok(None), Err),
            _ => Ok(None),
        }
    }

    /// A deed in the axes of the plane.
    fn local(&self, deed: &Deed) -> Deed {
        let plane = self.setting.plane;
        Deed { from: plane.to_local(deed.from), to: plane.to_local(deed.to), ..*deed }
    }

    /// The cycles that may make the moves, with their words.
    fn guesses(&self, guess: &Found, cuts: &[Cut], initial: f64) -> Vec<Found> {
        let control = self.model.control();
        let Some(first) = cuts.first() else { return Vec::new() };
        let deepest = cuts.iter().take_while(|cut| cut.is_deeper).last().unwrap_or(first);
        let mut guesses = Vec::new();
        for effect in CYCLES {
            let pecks = effect.pecks();
            let last = if pecks { deepest } else { first };
            let dwells = matches!(effect, Effect::CycleDrillDwell | Effect::CycleBoreDwell);
            if dwells && last.dwell.is_none() || pecks && is_same(first.end, last.end) {
                continue;
            }
            let ways = if pecks { self.pecks(cuts, guess.r) } else { vec![(Pecks::None, Vec::new())] };
            for (way, mut letters) in ways {
                if last.dwell.is_some() {
                    letters.push("P");
                }
                let Some(code) = self.code(effect, &letters) else { continue };
                let one = Found {
                    cycle: control.code_ix(code.number()),
                    bottom: last.end,
                    pecks: way,
                    dwell: last.dwell,
                    cuts: if pecks { cuts.iter().take_while(|cut| cut.is_deeper).count() } else { 1 },
                    ..*guess
                };
                let both = self.has_return_levels() && (guess.r - initial).abs() > SAME;
                guesses.push(one);
                if both {
                    guesses.push(Found { to_r: !one.to_r, ..one });
                }
            }
        }
        guesses
    }

    /// How pecks of these depths are told, with the words that it takes.
    fn pecks(&self, cuts: &[Cut], r: f64) -> Vec<(Pecks, Vec<&'static str>)> {
        let steps = steps(cuts, r);
        let [first, rest @ ..] = steps.as_slice() else { return Vec::new() };
        let mut ways = vec![(Pecks::Equal(*first), vec!["Q"])];
        let repeats = self.rules().repeat;
        if let [second, ..] = rest
            && second < first
            && !['I', 'J', 'K'].contains(&repeats)
        {
            // The last one is what is left.
            let least = steps.iter().rev().skip(1).fold(*first, |least, step| least.min(*step));
            ways.push((Pecks::Falling([*first, first - second, least]), vec!["I", "J", "K"]));
        }
        ways
    }

    /// What the control does for a hole.
    fn legs(&self, found: &Found, initial: f64) -> Option<Vec<Leg>> {
        let Setting { plane, units, .. } = self.setting;
        let (clearance, above_r) = self.machine.settings_of_pecks(self.rules(), units.in_mm());
        let effect = self.model.effect(found.cycle);
        let pecks = found.pecks != Pecks::None;
        let (peck, ijk) = match found.pecks {
            Pecks::None => (None, [None; 3]),
            Pecks::Equal(depth) => (Some(Mm(depth)), [None; 3]),
            Pecks::Falling(ijk) => (None, ijk.map(|word| Some(Mm(word)))),
        };
        let [x, y] = found.at;
        let words = Hole {
            plane,
            at: (Mm(x), Mm(y)),
            initial: Mm(initial),
            r: Mm(found.r),
            bottom: Mm(found.bottom),
            dwell: found.dwell.map(Seconds),
            peck,
            ijk,
            incremental: false,
            return_to_r: found.to_r,
            first_of_block: true,
            overrides: Overrides { feed: true, speed: true },
            clearance: clearance.filter(|_| pecks),
            above_r: if pecks { above_r } else { Mm::ZERO },
            tap_out: 1.0,
            units,
        };
        let mut legs = Vec::new();
        let mut at = found.from;
        let mut is_plain = true;
        let mut take = |stroke: Stroke| {
            let kind = match stroke {
                Stroke::Rapid(_) => Kind::Rapid,
                Stroke::Feed(_) => Kind::Feed,
                Stroke::Dwell(seconds) => Kind::Dwell(seconds.0),
                // The program has to be in this mode: the collector of the moves looks at it.
                Stroke::ExactPath => return,
                _ => {
                    is_plain = false;
                    return;
                }
            };
            let to = stroke.end().map_or(at, |to| plane.to_local(to.map(|length| length.0)));
            if matches!(kind, Kind::Dwell(_)) || !is_near(at, to) {
                put(&mut legs, at, Leg { kind, to });
            }
            at = to;
        };
        let from = plane.to_xyz(found.from.map(Mm));
        hole(effect, &words, from, self.rules(), &mut take).ok()?;
        is_plain.then_some(legs)
    }

    /// Why pecks are not those of a cycle.
    fn miss(&self, guess: &Found, cuts: &[Cut], pecks: usize) -> Option<Miss> {
        let (first, second) = (cuts.first()?, cuts.get(1)?);
        let miss = |reason: String, help: Option<String>| Some(Miss { block: guess.cut, reason, help });
        let unit = self.setting.units.in_mm();
        let length = |mm: f64| {
            let text = format!("{:.4}", mm / unit);
            let text = text.trim_end_matches('0').trim_end_matches('.').to_owned();
            format!("{text} {}", if self.setting.units == Units::Inch { "inch" } else { "mm" })
        };
        let top = first.top?;
        let comes_out = (top - guess.r).abs() < SAME || (top - guess.r) * (guess.r - first.end) > 0.0;
        let effect = if comes_out { Effect::CyclePeck } else { Effect::CycleChipBreak };
        let Some(code) = self.code(effect, &["Q"]) else {
            return miss(format!("this control has no cycle for these {pecks} pecks"), None);
        };
        let name = code.number();
        let (told, above) = self.machine.settings_of_pecks(self.rules(), unit);
        let rules = self.rules();
        let fixed = if comes_out { rules.peck_clearance } else { rules.chip_break_retract };
        let clearance = told.map_or(fixed, |told| told.0);
        let here = if comes_out { (second.begin - first.end).abs() } else { (top - first.end).abs() };
        let help = rules.clearance_setting.as_ref().map(|number| {
            format!(
                "give setting {number} of the machine in `[settings]` of `gcheck.toml`, if it is {}",
                length(here)
            )
        });
        let by = match &rules.clearance_setting {
            Some(number) if told.is_some() => format!(", as setting {number} says"),
            Some(number) => format!(", as long as setting {number} is not given"),
            None => String::new(),
        };
        if !comes_out && (here - clearance).abs() > SAME {
            let (here, clearance) = (length(here), length(clearance));
            let reason = format!(
                "after a peck the tool backs off by {here} here, and by {clearance} in {name} of this control{by}"
            );
            return miss(reason, help);
        }
        let out = (top - guess.r).abs();
        if comes_out && (out - above.0).abs() > SAME {
            let (out, above) = (length(out), length(above.0));
            return miss(
                format!(
                    "after a peck the tool comes out to {out} above R here, and to {above} in {name} of this control"
                ),
                None,
            );
        }
        if comes_out && (here - clearance).abs() > SAME {
            let clearance = length(clearance);
            let reason = if (second.begin - guess.r).abs() < SAME {
                format!(
                    "each peck is fed from R on here, and {name} of this control goes in at rapid to {clearance} above the last depth{by}"
                )
            } else {
                let here = length(here);
                format!(
                    "after a peck the tool goes in at rapid to {here} above the last depth here, and to {clearance} in {name} of this control{by}"
                )
            };
            return miss(reason, help);
        }
        miss(format!("the depths of the {pecks} pecks are not those that {name} of this control makes"), None)
    }
}

/// How many deeds may be the approach to a hole.
fn approach(deeds: &[Deed]) -> usize {
    let is_approach = |deed: &&Deed| deed.kind == Kind::Rapid || deed.goes_nowhere();
    deeds.iter().take(MOST_APPROACHES).take_while(is_approach).count()
}

/// A cut down or up, with what comes after it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cut {
    begin: f64,
    end: f64,
    /// Deeper than all cuts before it.
    is_deeper: bool,
    /// Seconds after it.
    dwell: Option<f64>,
    /// The level that the tool goes to at rapid after it.
    top: Option<f64>,
}

/// The cuts along the axis of depth, those that go on as one.
fn cuts(deeds: &[Deed]) -> Vec<Cut> {
    let mut cuts: Vec<Cut> = Vec::new();
    let mut is_open = false;
    for deed in deeds.iter().filter(|deed| !deed.goes_nowhere()) {
        let ([_, _, begin], [_, _, end]) = (deed.from, deed.to);
        match deed.kind {
            Kind::Feed => {
                let goes_on = |cut: &&mut Cut| (cut.end - cut.begin) * (end - begin) > 0.0;
                if is_open && let Some(cut) = cuts.last_mut().filter(goes_on) {
                    cut.end = end;
                } else {
                    cuts.push(Cut { begin, end, is_deeper: true, dwell: None, top: None });
                }
                is_open = true;
            }
            Kind::Dwell(seconds) => {
                is_open = false;
                if let Some(cut) = cuts.last_mut().filter(|cut| cut.top.is_none()) {
                    cut.dwell = Some(cut.dwell.unwrap_or(0.0) + seconds);
                }
            }
            Kind::Rapid => {
                is_open = false;
                if let Some(cut) = cuts.last_mut().filter(|cut| cut.top.is_none()) {
                    cut.top = Some(end);
                }
            }
        }
    }
    let Some(first) = cuts.first().copied() else { return cuts };
    let direction = (first.end - first.begin).signum();
    let mut deepest = first.begin;
    for cut in &mut cuts {
        cut.is_deeper = (cut.end - deepest) * direction > SAME;
        if cut.is_deeper {
            deepest = cut.end;
        }
    }
    cuts
}

/// The depths of the cuts that go deeper, one after another.
fn steps(cuts: &[Cut], r: f64) -> Vec<f64> {
    let mut from = r;
    let deeper = cuts.iter().take_while(|cut| cut.is_deeper);
    deeper
        .map(|cut| {
            let step = (cut.end - from).abs();
            from = cut.end;
            // A program gives pecks with the digits of its coordinates.
            (step * 1e6).round() / 1e6
        })
        .collect()
}

/// Takes a leg, as one with the leg before where it goes on in the same way.
fn put(legs: &mut Vec<Leg>, from: [f64; 3], leg: Leg) {
    let count = legs.len();
    let before = count.checked_sub(2).and_then(|index| legs.get(index)).map(|leg| leg.to);
    if let Some(last) = legs.last_mut()
        && last.kind == leg.kind
        && !matches!(leg.kind, Kind::Dwell(_))
        && let Some([x, y, z]) = before
        && is_same(x, from[0])
        && is_same(y, from[1])
        && is_same(x, leg.to[0])
        && is_same(y, leg.to[1])
        && (from[2] - z) * (leg.to[2] - from[2]) > 0.0
    {
        last.to = leg.to;
        return;
    }
    legs.push(leg);
}

/// How many deeds go all legs; `None` when they go elsewhere.
fn follow(legs: &[Leg], from: [f64; 3], deeds: &[Deed]) -> Option<usize> {
    let mut count = 0;
    let mut at = from;
    for leg in legs {
        loop {
            let deed = deeds.get(count)?;
            count += 1;
            if deed.goes_nowhere() {
                continue;
            }
            match (leg.kind, deed.kind) {
                (Kind::Dwell(a), Kind::Dwell(b)) if (a - b).abs() < SAME_TIME => break,
                (Kind::Rapid, Kind::Rapid) | (Kind::Feed, Kind::Feed) => {}
                _ => return None,
            }
            if is_near(deed.to, leg.to) {
                at = leg.to;
                break;
            }
            let [[x, y, z], [to_x, to_y, to_z]] = [deed.to, leg.to];
            let is_on_way = is_same(x, to_x) && is_same(y, to_y) && is_same(x, at[0]) && is_same(y, at[1]);
            let goes_on = (z - at[2]) * (to_z - z) > 0.0;
            if !is_on_way || !goes_on {
                return None;
            }
            at = deed.to;
        }
    }
    (count > 0).then_some(count)
}

/// A dwell, or a move along the axis of depth.
fn is_along_depth(deed: &Deed) -> bool {
    let ([x, y, z], [to_x, to_y, to_z]) = (deed.from, deed.to);
    is_same(x, to_x) && is_same(y, to_y) && z.is_finite() && to_z.is_finite()
}

fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() < SAME || a.is_nan() && b.is_nan()
}

fn is_near(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter().zip(&b).all(|(a, b)| is_same(*a, *b))
}
