//! Holes made by plain moves, written as canned cycles.
//!
//! Knows: which blocks of a program make nothing but holes, what of them a cycle cannot say, how its blocks are written.
//! Must not know: how cycles move (the engine does), which moves are a hole.

use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

use gcheck_controls::{CodeIx, DwellWord, Effect, Letter, WordKind};
use gcheck_engine::{
    Axis, Concrete, Event, FeedMode, Machine, Model, PathMode, Position, Program, Role, State, TravelKind,
    Units,
};
use gcheck_geometry::Plane;
use gcheck_program::{BlockFlags, Place, StatementKind, Value, Word};

use crate::facts::Facts;
use crate::holes::{Deed, Finder, Found, Kind, Miss, Pecks, Setting};
use crate::refusal::Refusal;
use crate::run::Executed;
use crate::sheet::Sheet;

/// Blocks after a series that are looked at for the motion that goes on.
const LOOK_AHEAD: u32 = 50;
/// Reasons that are told beside a change.
const MOST_REASONS: usize = 3;
/// What a block may not be to be written otherwise.
const UNFIT: BlockFlags = BlockFlags::ERROR
    .union(BlockFlags::STATEMENT)
    .union(BlockFlags::EXPRESSION)
    .union(BlockFlags::BLOCK_DELETE)
    .union(BlockFlags::PROGRAM_NUMBER)
    .union(BlockFlags::TAPE_MARK)
    .union(BlockFlags::REMARK)
    .union(BlockFlags::UNKNOWN_CODE)
    .union(BlockFlags::UNKNOWN_ADDRESS)
    .union(BlockFlags::UNREAD_WORD)
    .union(BlockFlags::AXIS_TWICE);

/// What a block did that a hole may be made of.
#[derive(Debug, Clone, PartialEq)]
struct Part {
    deeds: Vec<Deed>,
    facts: Facts,
    before: Before,
}

/// What was in effect before a block.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Before {
    incremental: Option<bool>,
    returns: Option<Effect>,
    /// Points are passed exactly.
    is_exact: bool,
    /// Cutter compensation is off.
    is_plain: bool,
}

/// The plain moves of a run that may be holes. Has to see every block before it is executed, and every event.
pub(crate) struct Folds<'c> {
    model: &'c Model<'c>,
    before: Option<Before>,
    deeds: Vec<Deed>,
    is_fit: bool,
    /// By number of the block; `None` for one that did more, or something else each time.
    parts: BTreeMap<u32, Option<Part>>,
}

/// Holes one after another in one cycle.
struct Series {
    /// Indexes of its blocks, the first and the one after the last.
    blocks: Range<usize>,
    initial: f64,
    /// Each with the index after its last block.
    holes: Vec<(Found, usize)>,
}

impl<'c> Folds<'c> {
    pub(crate) fn new(model: &'c Model<'c>) -> Self {
        Self { model, before: None, deeds: Vec::new(), is_fit: true, parts: BTreeMap::new() }
    }

    pub(crate) fn before(&mut self, state: &State<Concrete>) {
        self.deeds.clear();
        self.is_fit = true;
        let compensation = state.effect(Role::Compensation, self.model);
        self.before = Some(Before {
            incremental: state.is_incremental(self.model),
            returns: state.effect(Role::ReturnLevel, self.model),
            is_exact: state.path_mode(self.model) == Some(PathMode::ExactPath),
            is_plain: matches!(compensation, Some(Effect::CompensationOff | Effect::None)),
        });
    }

    pub(crate) fn event(&mut self, event: &Event) {
        let deed = |kind: Kind, from: [f64; 3], to: [f64; 3]| Deed { kind, from, to, block: 0 };
        let deed = match event {
            Event::Travel(travel) if !travel.expanded && turns_nothing(&travel.from, &travel.to) => {
                let [from, to] = [&travel.from, &travel.to].map(xyz);
                match travel.kind {
                    TravelKind::Rapid => Some(deed(Kind::Rapid, from, to)),
                    TravelKind::Feed => Some(deed(Kind::Feed, from, to)),
                    TravelKind::Probe { .. } | TravelKind::Thread => None,
                }
            }
            Event::Dwell(seconds) if seconds.0.is_finite() => {
                Some(deed(Kind::Dwell(seconds.0), [f64::NAN; 3], [f64::NAN; 3]))
            }
            // The codes that a block may have are looked at in its words.
            Event::FeedRate(_) | Event::Modal(_) | Event::KnownWay(_) => return,
            _ => None,
        };
        match deed {
            Some(deed) => self.deeds.push(deed),
            None => self.is_fit = false,
        }
    }

    pub(crate) fn executed(&mut self, block: &Executed<'_>) {
        // Without what came before, nothing is collected: the run is that of a proof.
        let Some(before) = self.before.take() else { return };
        if block.at.file != 0 || !block.is_selected {
            return;
        }
        let part = self.part(block, before);
        match self.parts.get_mut(&block.at.block) {
            None => {
                self.parts.insert(block.at.block, part);
            }
            Some(old) if *old != part => *old = None,
            Some(_) => {}
        }
    }

    fn part(&self, block: &Executed<'_>, before: Before) -> Option<Part> {
        let facts = block.facts;
        let at = xyz(&block.before);
        let plane = self.plane(&facts)?;
        let (_, _, depth) = plane.axes();
        let known = facts.units.is_some() && facts.incremental.is_some() && before.incremental.is_some();
        let fits = self.is_fit
            && before.is_plain
            && known
            && facts.mapped.is_none()
            && !facts.cycle.is_some()
            && facts.feed_mode != Some(FeedMode::InverseTime)
            && self.has_own_words_alone(block.place);
        if !fits {
            return None;
        }
        let mut deeds = self.deeds.clone();
        let mut at = at;
        for deed in &mut deeds {
            if matches!(deed.kind, Kind::Dwell(_)) {
                (deed.from, deed.to) = (at, at);
            }
            at = deed.to;
            let [x, y, _] = plane.to_local(deed.from);
            let [to_x, to_y, _] = plane.to_local(deed.to);
            let is_across = x.to_bits() != to_x.to_bits() || y.to_bits() != to_y.to_bits();
            if deed.kind == Kind::Feed && is_across {
                return None;
            }
        }
        // Along X a level may count a diameter, and `R` a radius.
        (depth != Axis::X.index() || facts.diameter != Some(true)).then_some(Part { deeds, facts, before })
    }

    /// The plane that cycles drill on.
    fn plane(&self, facts: &Facts) -> Option<Plane> {
        if self.model.semantics().cycles.all_planes { facts.plane } else { Some(Plane::Xy) }
    }

    /// Has a block words of moves, dwells and feeds alone?
    fn has_own_words_alone(&self, place: &Place) -> bool {
        let words = place.table.words(place.block());
        if place.block().flags.intersects(UNFIT) {
            return false;
        }
        let increments = &self.model.semantics().increments;
        let dwells = words.iter().any(|word| self.model.effect(word.code) == Effect::Dwell);
        let times = &self.model.semantics().dwell;
        words.iter().all(|word| {
            let letter = word.letter;
            let name = char::from(letter.ascii()).to_string();
            if word.code.is_some() {
                return matches!(
                    self.model.effect(word.code),
                    Effect::Rapid | Effect::Linear | Effect::Dwell | Effect::Absolute | Effect::Incremental
                );
            }
            if letter.is_corner() || !matches!(word.value, Value::Number(_)) {
                return false;
            }
            let is_axis =
                Axis::of(letter).is_some_and(|axis| axis.index() < 3) || increments.contains_key(&name);
            is_axis || matches!(letter.ascii(), b'N' | b'F') || dwells && times.contains_key(&name)
        })
    }

    /// Writes the cycles in the place of the moves. The answer is what is left as it is though it looks like holes.
    pub(crate) fn write(
        &self,
        sheet: &mut Sheet<'_, '_>,
        program: &Program<'_>,
        machine: &Machine,
    ) -> Result<Vec<String>, Refusal> {
        let mut misses: Vec<Refusal> = Vec::new();
        let count = sheet.loaded.flow_graph().blocks();
        let has_jumps = self.has_jumps(sheet, program);
        let mut writer = Writer { folds: self, program, has_cycles: false, has_jumps, cycles: Vec::new() };
        writer.look_for_cycles(sheet);
        let mut number = 0;
        while number < count {
            let region = self.region(sheet, program, number..count, has_jumps);
            let Some(region) = region else {
                misses.extend(self.tap(sheet, program, number));
                number += 1;
                continue;
            };
            number = region.blocks.last().map_or(number, |(number, _, _)| *number) + 1;
            let region = Rc::new(region);
            let (series, left) = region.series(self.model, machine);
            misses.extend(left.into_iter().filter_map(|miss| region.refusal(&miss)));
            for series in series {
                if let Some(reason) = region.unfit(&series, self.model) {
                    misses.push(reason);
                } else {
                    writer.cycles.push((Rc::clone(&region), series));
                }
            }
        }
        if writer.cycles.is_empty() {
            return misses.into_iter().next().map_or(Ok(Vec::new()), Err);
        }
        writer.write(sheet);
        let told = misses.iter().take(MOST_REASONS).map(|miss| {
            let line = sheet.loaded.line_number(miss.range.start);
            format!("line {line} stays as it is: {}", miss.reason)
        });
        Ok(told.chain(writer.note_on_pecks(machine)).collect())
    }

    /// The blocks from a number on that make nothing but moves, one after another in one setting.
    fn region(
        &self,
        sheet: &Sheet<'_, '_>,
        program: &Program<'_>,
        numbers: Range<u32>,
        has_jumps: bool,
    ) -> Option<Region> {
        let graph = sheet.loaded.flow_graph();
        let mut region = Region { blocks: Vec::new(), setting: None, plane: Plane::Xy };
        for number in numbers {
            let Some(place) = sheet.loaded.place(number, program.dialect()) else { break };
            let is_target = has_jumps && graph.may_be_target(number);
            if graph.is_flow(number) || !region.blocks.is_empty() && is_target {
                break;
            }
            let part = match self.parts.get(&number) {
                Some(Some(part)) => part.clone(),
                Some(None) => break,
                None => {
                    // A comment in between is not executed.
                    let Some((_, _, last)) = region.blocks.last() else { break };
                    let is_silent = place.table.words(place.block()).is_empty();
                    if !is_silent || place.block().flags.intersects(UNFIT) {
                        break;
                    }
                    Part { deeds: Vec::new(), ..last.clone() }
                }
            };
            let facts = Facts { motion: Effect::Rapid, incremental: None, ..part.facts };
            if region.setting.is_some_and(|setting| setting != facts) {
                break;
            }
            region.setting = Some(facts);
            region.plane = self.plane(&facts)?;
            region.blocks.push((number, place, part));
        }
        // Comments at the end belong to what comes after them.
        while region.blocks.last().is_some_and(|(_, _, part)| part.deeds.is_empty()) {
            region.blocks.pop();
        }
        (!region.blocks.is_empty()).then_some(region)
    }

    /// Does a block of the program name another one by its number?
    fn has_jumps(&self, sheet: &Sheet<'_, '_>, program: &Program<'_>) -> bool {
        let dialect = program.dialect();
        let names = |place: &Place| {
            let words = place.table.words(place.block());
            let mut statements = place.table.statements(place.ix);
            let goes = statements.any(|statement| matches!(statement.kind, StatementKind::Goto { .. }));
            goes || words.iter().filter_map(|word| self.model.control().code_at(word.code)).any(|code| {
                let labels =
                    code.entry().words.iter().filter(|word| word.kind == WordKind::Label || word.or_label);
                let letters: Vec<Option<Letter>> = labels.map(|word| Letter::parse(&word.letter)).collect();
                words.iter().any(|word| letters.contains(&Some(word.letter)))
            })
        };
        sheet
            .loaded
            .blocks_with(BlockFlags::STATEMENT | BlockFlags::CODE, dialect)
            .any(|(_, place)| names(&place))
    }

    /// A spindle that turns the other way between two cuts: a tap made by plain moves.
    fn tap(&self, sheet: &Sheet<'_, '_>, program: &Program<'_>, number: u32) -> Option<Refusal> {
        let place = sheet.loaded.place(number, program.dialect())?;
        let turns = |word: &Word| {
            matches!(self.model.effect(word.code), Effect::SpindleClockwise | Effect::SpindleCounterClockwise)
        };
        if !place.table.words(place.block()).iter().any(turns) {
            return None;
        }
        let part = |number: u32| self.parts.get(&number).and_then(Option::as_ref);
        let cut = |deed: &&Deed| deed.kind == Kind::Feed;
        let down = part(number.checked_sub(1)?)?.deeds.last().filter(cut)?;
        let up = part(number + 1)?.deeds.first().filter(cut)?;
        let way = |deed: &Deed| {
            [0, 1, 2]
                .map(|axis: usize| deed.to.get(axis).zip(deed.from.get(axis)).map_or(0.0, |(a, b)| a - b))
        };
        let goes_back = way(down).iter().zip(way(up)).any(|(a, b)| a * b < 0.0);
        let code = self.model.control().codes().find(|code| {
            matches!(code.effect(), Effect::CycleTap)
                && !self.model.drills_across(self.model.control().code_ix(code.number()))
        })?;
        goes_back.then(|| {
            Refusal::at(
                place.range(),
                format!(
                    "these moves tap at the feed of the program, and {} of this control ties the feed to the spindle and ignores the overrides",
                    code.number()
                ),
            )
            .help("write the tap by hand, and compare with `gcheck diff`")
        })
    }
}

/// Blocks one after another that make nothing but moves.
#[derive(Clone)]
struct Region {
    blocks: Vec<(u32, Place, Part)>,
    setting: Option<Facts>,
    plane: Plane,
}

impl Region {
    fn setting(&self, from: usize) -> Option<Setting> {
        let (_, _, part) = self.blocks.get(from)?;
        let to_r = part.before.returns == Some(Effect::ReturnToR);
        Some(Setting { plane: self.plane, units: part.facts.units?, to_r })
    }

    /// The series of holes, and moves that look like holes and are none.
    fn series(&self, model: &Model<'_>, machine: &Machine) -> (Vec<Series>, Vec<Miss>) {
        let deeds: Vec<Deed> = self
            .blocks
            .iter()
            .enumerate()
            .flat_map(|(block, (_, _, part))| part.deeds.iter().map(move |deed| Deed { block, ..*deed }))
            .collect();
        let (mut found, mut misses) = (Vec::new(), Vec::<Miss>::new());
        let mut at = 0;
        while let Some(deed) = deeds.get(at) {
            let rest = |at: usize| deeds.get(at..).unwrap_or_default();
            let Some(setting) = self.setting(deed.block) else { break };
            let finder = Finder { model, machine, setting };
            let mut series = Series { blocks: deed.block..deed.block, initial: f64::NAN, holes: Vec::new() };
            let begin = at;
            let mut next = at;
            let [_, _, level] = self.plane.to_local(deed.from);
            let mut cycle = None;
            loop {
                let initial = cycle.map(|_| level);
                match finder.hole(rest(next), initial, cycle) {
                    Ok(Some(hole)) => {
                        next += hole.deeds;
                        let end = deeds.get(next - 1).map_or(0, |deed| deed.block + 1);
                        if !self.keeps_feed(&series, &hole, end) {
                            misses.push(Miss {
                                block: hole.cut,
                                reason: "the feed changes within this hole, and a cycle has one".to_owned(),
                                help: None,
                            });
                            next -= hole.deeds;
                            break;
                        }
                        cycle = Some(hole.cycle);
                        series.initial = level;
                        series.blocks.end = end;
                        series.holes.push((hole, end));
                    }
                    Ok(None) => break,
                    Err(miss) => {
                        if misses.last().is_none_or(|last| last.block != miss.block) {
                            misses.push(miss);
                        }
                        break;
                    }
                }
            }
            let cuts: usize = series.holes.iter().map(|(hole, _)| hole.cuts).sum();
            if cuts > 1 {
                at = next;
                found.push(series);
            } else {
                // The next block may begin one.
                let long = finder.too_long(rest(begin)).unwrap_or(1);
                let block = rest(begin).get(long - 1).map_or(deed.block, |deed| deed.block);
                at = begin + rest(begin).iter().take_while(|deed| deed.block <= block).count();
            }
        }
        (found, misses)
    }

    /// Is a hole cut at the feed that it begins with?
    fn keeps_feed(&self, series: &Series, hole: &Found, end: usize) -> bool {
        let begin = series.holes.last().map_or(series.blocks.start, |(_, end)| *end);
        let before = self.blocks.get(series.blocks.start..=hole.cut).unwrap_or_default();
        let feed = before.iter().rev().find_map(|(_, place, _)| feed_word(place));
        let after = self.blocks.get(hole.cut.max(begin) + 1..end).unwrap_or_default();
        let number = |word: Word| word.number().map(f64::to_bits);
        after
            .iter()
            .filter_map(|(_, place, _)| feed_word(place))
            .all(|word| feed.and_then(number) == number(word))
    }

    /// Why a series stays as it is though its moves are those of a cycle.
    fn unfit(&self, series: &Series, model: &Model<'_>) -> Option<Refusal> {
        let blocks = self.blocks.get(series.blocks.clone())?;
        let passes_exactly = model.semantics().cycles.rise_to_r;
        let (hole, _) = series.holes.first()?;
        let code = model.control().code_at(hole.cycle)?;
        let blends = blocks.iter().find(|(_, _, part)| passes_exactly && !part.before.is_exact);
        blends.map(|(_, place, _)| {
            let exact = model.control().codes().find(|code| code.effect() == Effect::ExactPath);
            let exact = exact.map_or_else(String::new, |code| format!(" ({})", code.number()));
            let reason = format!(
                "{} of this control passes its points exactly{exact}, and these moves may round their corners",
                code.number()
            );
            Refusal::at(place.range(), reason).help(format!("switch exact path{exact} on before these moves"))
        })
    }

    fn refusal(&self, miss: &Miss) -> Option<Refusal> {
        let (_, place, _) = self.blocks.get(miss.block)?;
        let refusal = Refusal::at(place.range(), miss.reason.clone());
        Some(match &miss.help {
            Some(help) => refusal.help(help.clone()),
            None => refusal,
        })
    }
}

/// Writes series of holes.
struct Writer<'a, 'c, 'p> {
    folds: &'a Folds<'c>,
    program: &'a Program<'p>,
    /// The program has cycles already, which may rest on modes that a series changes.
    has_cycles: bool,
    /// A block names another one by its number.
    has_jumps: bool,
    cycles: Vec<(Rc<Region>, Series)>,
}

impl Writer<'_, '_, '_> {
    fn look_for_cycles(&mut self, sheet: &Sheet<'_, '_>) {
        let model = self.folds.model;
        let is_cycle = |word: &Word| {
            model.role(word.code) == Some(Role::Cycle) && model.effect(word.code) != Effect::CycleCancel
        };
        let mut places = sheet.loaded.blocks_with(BlockFlags::CODE, self.program.dialect());
        self.has_cycles = places.any(|(_, place)| place.table.words(place.block()).iter().any(is_cycle));
    }

    /// What the proof takes for how far pecks back off, where it is not given.
    fn note_on_pecks(&self, machine: &Machine) -> Option<String> {
        let model = self.folds.model;
        let rules = &model.semantics().cycles;
        let holes = || self.cycles.iter().flat_map(|(_, series)| &series.holes);
        let (hole, _) = holes().find(|(hole, _)| hole.pecks != Pecks::None)?;
        // A control that computes its cycles in the open has no such setting.
        if rules.rise_to_r || machine.settings_of_pecks(rules, 1.0).0.is_some() {
            return None;
        }
        let breaks_chips = model.effect(hole.cycle) == Effect::CycleChipBreak;
        let taken = if breaks_chips { rules.chip_break_retract } else { rules.peck_clearance };
        let name = model.control().code_at(hole.cycle)?.number();
        let decides = match &rules.clearance_setting {
            Some(number) => format!("setting {number}"),
            None => "a parameter of the control".to_owned(),
        };
        Some(format!("{decides} decides how far {name} backs off between pecks; the proof takes {taken} mm"))
    }

    fn write(&self, sheet: &mut Sheet<'_, '_>) {
        let begins: Vec<u32> = self
            .cycles
            .iter()
            .filter_map(|(region, series)| region.blocks.get(series.blocks.start))
            .map(|(number, _, _)| *number)
            .collect();
        for (region, series) in &self.cycles {
            let blocks = region.blocks.get(series.blocks.clone()).unwrap_or_default();
            let ([(_, first, _), ..], [.., (_, last, _)]) = (blocks, blocks) else { continue };
            let Some(lines) = self.lines(sheet, region, series, blocks, &begins) else { continue };
            let range = first.range().start..last.range().end;
            let text = lines.join(sheet.line_end());
            sheet.replace(range, text);
        }
    }

    /// The lines of a series.
    fn lines(
        &self,
        sheet: &mut Sheet<'_, '_>,
        region: &Region,
        series: &Series,
        blocks: &[(u32, Place, Part)],
        begins: &[u32],
    ) -> Option<Vec<String>> {
        let ((_, _, first), (last_number, last_place, last)) = (blocks.first()?, blocks.last()?);
        let switches = blocks.iter().any(|(_, place, _)| self.distance_code(place));
        let incremental = !switches && first.facts.incremental == Some(true);
        let mut lines = Vec::new();
        let mut written = Written { incremental, ..Written::default() };
        let mut begin = series.blocks.start;
        let mut to_r = first.before.returns == Some(Effect::ReturnToR);
        let has_levels =
            sheet.spelled(Effect::ReturnToR).is_some() && sheet.spelled(Effect::ReturnToInitial).is_some();
        for (index, (hole, end)) in series.holes.iter().enumerate() {
            let own = region.blocks.get(begin..*end).unwrap_or_default();
            begin = *end;
            let (number, remark) = Self::beside(sheet, own, &mut lines);
            let mut words: Vec<String> = number.into_iter().collect();
            if index == 0 && !incremental && first.before.incremental == Some(true) {
                words.push(sheet.spelled(Effect::Absolute)?);
            }
            if has_levels && (index == 0 || hole.to_r != to_r) {
                let effect = if hole.to_r { Effect::ReturnToR } else { Effect::ReturnToInitial };
                words.push(sheet.spelled(effect)?);
            }
            to_r = hole.to_r;
            words.extend(self.words(sheet, region, series.initial, hole, &mut written)?);
            words.extend(Self::feed(sheet, own, &mut written));
            let gap = sheet.hand.gap();
            let remark = remark.map_or_else(String::new, |remark| format!(" {remark}"));
            lines.push(format!("{}{remark}", words.join(gap)));
        }
        let mut closing = Vec::new();
        // The number of the last block, whose hole has that of its first one.
        let (last_hole, _) = series.holes.last()?;
        let is_own_number = blocks.len() > series.holes.len();
        closing.extend(
            number_word(last_place)
                .filter(|_| is_own_number)
                .map(|word| Self::text(sheet, last_place, &word)),
        );
        let next = sheet.loaded.place(last_number + 1, self.program.dialect());
        let cancels = |place: &Place| {
            let is_cancel = |word: &Word| self.folds.model.effect(word.code) == Effect::CycleCancel;
            place.table.words(place.block()).iter().any(is_cancel)
        };
        let begins_next = begins.binary_search(&(last_number + 1)).is_ok();
        let before = closing.len();
        if begins_next || !next.as_ref().is_some_and(cancels) {
            closing.push(sheet.spelled(Effect::CycleCancel)?);
        }
        let was_to_r = first.before.returns == Some(Effect::ReturnToR);
        if self.has_cycles && has_levels && last_hole.to_r != was_to_r {
            let effect = if was_to_r { Effect::ReturnToR } else { Effect::ReturnToInitial };
            closing.push(sheet.spelled(effect)?);
        }
        if !incremental && last.facts.incremental == Some(true) {
            closing.push(sheet.spelled(Effect::Incremental)?);
        }
        if closing.len() > before {
            lines.push(closing.join(sheet.hand.gap()));
        }
        if let Some(motion) = self.motion_after(sheet, *last_number, last, begins) {
            lines.push(motion);
        }
        Some(lines)
    }

    /// Does a block say whether words are increments?
    fn distance_code(&self, place: &Place) -> bool {
        let is = |word: &Word| self.folds.model.role(word.code) == Some(Role::Distance);
        place.table.words(place.block()).iter().any(is)
    }

    fn text(sheet: &Sheet<'_, '_>, place: &Place, word: &Word) -> String {
        sheet.loaded.slice(Sheet::range(place, word)).to_owned()
    }

    /// The number of a hole's block, and the comment at its end; other comments get lines of their own.
    fn beside(
        sheet: &Sheet<'_, '_>,
        blocks: &[(u32, Place, Part)],
        lines: &mut Vec<String>,
    ) -> (Option<String>, Option<String>) {
        let mut beside = None;
        let mut number = None;
        for (_, place, part) in blocks {
            let words = place.table.words(place.block());
            let remark = remark(sheet, place);
            if number.is_none() && !part.deeds.is_empty() {
                number = Some(number_word(place).map(|word| Self::text(sheet, place, &word)));
            }
            if remark.is_empty() {
                continue;
            }
            if words.is_empty() || beside.is_some() {
                lines.push(remark);
            } else {
                beside = Some(remark);
            }
        }
        (number.flatten(), beside)
    }

    /// The words of a hole that differ from those of the hole before it.
    fn words(
        &self,
        sheet: &Sheet<'_, '_>,
        region: &Region,
        initial: f64,
        hole: &Found,
        written: &mut Written,
    ) -> Option<Vec<String>> {
        let model = self.folds.model;
        let rules = &model.semantics().cycles;
        let facts = region.setting?;
        let unit = facts.units.map(Units::in_mm)?;
        let (decimals, form) = (sheet.decimals(facts.units), sheet.hand.form(model.control()));
        let length = |letter: char, mm: f64| {
            let doubled = if letter == 'X' && facts.diameter == Some(true) { 2.0 } else { 1.0 };
            format!("{letter}{}", sheet.hand.write(form, mm * doubled / unit, decimals))
        };
        let (x, y, depth) = region.plane.axes();
        let [x, y, depth] = [x, y, depth].map(|index| ['X', 'Y', 'Z'].get(index).copied().unwrap_or('Z'));
        let mut words = Vec::new();
        let is_first = written.cycle.is_none();
        if is_first {
            let code = model.control().code_at(hole.cycle)?;
            words.push(code.number().to_string());
            written.cycle = Some(hole.cycle);
        }
        let mut points: Vec<String> = Vec::new();
        for (letter, (to, from)) in [x, y].into_iter().zip(hole.at.iter().zip(&hole.from)) {
            let moves = (to - from).abs() > 1e-9 || (is_first && !to.is_nan() && !written.incremental);
            if moves {
                points.push(length(letter, if written.incremental { to - from } else { *to }));
            }
        }
        if points.is_empty() {
            let to = *hole.at.first()?;
            let is_known = !to.is_nan();
            points.push(length(x, if written.incremental || !is_known { 0.0 } else { to }));
        }
        words.extend(points);
        let relative = written.incremental && rules.incremental_r;
        let r = if relative || rules.r_is_distance { hole.r - initial } else { hole.r };
        let bottom = if relative { hole.bottom - hole.r } else { hole.bottom };
        let levels = [depth, 'R'].into_iter().zip([bottom, r]);
        let levels: Vec<String> = levels.map(|(letter, level)| length(letter, level)).collect();
        let mut depths = Vec::new();
        match hole.pecks {
            Pecks::None => {}
            Pecks::Equal(peck) => depths.push(length('Q', peck)),
            Pecks::Falling(ijk) => {
                depths.extend(
                    ['I', 'J', 'K'].into_iter().zip(ijk).map(|(letter, depth)| length(letter, depth)),
                );
            }
        }
        depths.extend(hole.dwell.map(|seconds| self.dwell(sheet, seconds)));
        for (new, old) in [(levels, &mut written.levels), (depths, &mut written.depths)] {
            if *old != new {
                words.extend(new.iter().cloned());
                *old = new;
            }
        }
        Some(words)
    }

    /// `P` of a cycle.
    fn dwell(&self, sheet: &Sheet<'_, '_>, seconds: f64) -> String {
        let whole = (seconds * 1000.0).round();
        match self.folds.model.semantics().dwell.get("P") {
            Some(DwellWord::Milliseconds | DwellWord::SecondsOrMilliseconds) => format!("P{whole}"),
            _ => format!("P{}", sheet.hand.write("1.", seconds, 3)),
        }
    }

    /// The feed of a hole, where its blocks give another one.
    fn feed(sheet: &Sheet<'_, '_>, blocks: &[(u32, Place, Part)], written: &mut Written) -> Option<String> {
        let (place, word) = blocks.iter().rev().find_map(|(_, place, _)| Some((place, feed_word(place)?)))?;
        let feed = word.number().map(f64::to_bits);
        let is_new = written.feed != feed;
        written.feed = feed;
        is_new.then(|| Self::text(sheet, place, &word))
    }

    /// The motion code that goes on after a series and that no block there gives.
    fn motion_after(
        &self,
        sheet: &mut Sheet<'_, '_>,
        last_number: u32,
        last: &Part,
        begins: &[u32],
    ) -> Option<String> {
        let model = self.folds.model;
        let graph = sheet.loaded.flow_graph();
        let code = sheet.spelled(last.facts.motion)?;
        for number in last_number + 1..=last_number + LOOK_AHEAD {
            let place = sheet.loaded.place(number, self.program.dialect())?;
            if begins.binary_search(&number).is_ok() {
                return None;
            }
            let words = place.table.words(place.block());
            let is_motion = |word: &Word| {
                let is_cancel = model.effect(word.code) == Effect::CycleCancel;
                matches!(model.role(word.code), Some(Role::Motion | Role::Cycle)) && !is_cancel
            };
            let ends = |word: &Word| model.effect(word.code) == Effect::ProgramEnd;
            if words.iter().any(|word| is_motion(word) || ends(word)) {
                return None;
            }
            if graph.is_flow(number) || self.has_jumps && graph.may_be_target(number) {
                break;
            }
            let increments = &model.semantics().increments;
            let names_axis = words.iter().any(|word| {
                let name = char::from(word.letter.ascii()).to_string();
                let is_axis = Axis::of(word.letter).is_some() && !word.code.is_some();
                !word.letter.is_corner() && (is_axis || increments.contains_key(&name))
            });
            if names_axis {
                sheet.prepend(&place, &code);
                return None;
            }
        }
        Some(code)
    }
}

/// What the blocks of a series have given so far.
#[derive(Default)]
struct Written {
    incremental: bool,
    cycle: Option<CodeIx>,
    levels: Vec<String>,
    depths: Vec<String>,
    feed: Option<u64>,
}

fn feed_word(place: &Place) -> Option<Word> {
    word_of(place, Letter::of('F'))
}

fn number_word(place: &Place) -> Option<Word> {
    word_of(place, Letter::of('N'))
}

fn word_of(place: &Place, letter: Letter) -> Option<Word> {
    place.table.words(place.block()).iter().find(|word| word.letter == letter).copied()
}

/// What is in a block beside its words: its comments.
fn remark(sheet: &Sheet<'_, '_>, place: &Place) -> String {
    let block = place.range();
    let mut out = String::new();
    let mut at = block.start;
    for word in place.table.words(place.block()) {
        let range = Sheet::range(place, word);
        out.push_str(sheet.loaded.slice(at..range.start.max(at)).trim());
        at = range.end;
    }
    out.push_str(sheet.loaded.slice(at..block.end).trim());
    out
}

fn xyz(position: &Position) -> [f64; 3] {
    [Axis::X, Axis::Y, Axis::Z].map(|axis| position.raw(axis))
}

/// Do all axes but X, Y and Z stay where they are?
fn turns_nothing(from: &Position, to: &Position) -> bool {
    Axis::ALL
        .into_iter()
        .filter(|axis| axis.index() > 2)
        .all(|axis| from.raw(axis).to_bits() == to.raw(axis).to_bits())
}
