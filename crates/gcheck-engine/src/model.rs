//! A control prepared for execution: effects, groups and order of codes in arrays.
//!
//! Knows: what the knowledge base says about executing. Must not know: programs, values, state.

pub(crate) mod contract;
pub(crate) mod corner_words;
mod role;

use std::ops::Deref;

use gcheck_controls::{
    Code, CodeIx, CodeNumber, Control, Effect, GroupIx, Handling, HelixFeed, LastingFrom, Letter, LetterSet,
    Need, Semantics, SystemVariable, Unpointed, WordEntry, WordKind,
};
use rustc_hash::FxHashMap;

use crate::event::Units;
use crate::position::Axis;

use contract::{BlockContract, CodeContract};
use corner_words::CornerWords;
pub use role::Role;

/// When a part of a block acts: codes by their phase, `F`, `S`, `T` and motion by the phases of those names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Rank(pub(crate) u8);

/// What the engine asks about one code.
#[derive(Debug, Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "independent yes/no facts of a code")]
pub(crate) struct CodeModel {
    pub(crate) effect: Effect,
    pub(crate) role: Option<Role>,
    pub(crate) rank: Rank,
    pub(crate) group: GroupIx,
    /// The code's group lasts from block to block.
    pub(crate) modal: bool,
    /// Axis words in its block are the code's own.
    pub(crate) takes_axes: bool,
    /// A canned cycle that drills along X, whatever the plane.
    pub(crate) across: bool,
    /// The words of its block are millimetres and distances, whatever the modes.
    pub(crate) millimetre_distances: bool,
}

/// Value of the setting of helices that measures their feed along the path of the tool.
const HELIX_BY_PATH: &str = "path";

/// A control prepared for execution.
#[derive(Debug, Clone, Copy)]
pub struct Model<'c> {
    control: &'c Control,
    prepared: &'c Prepared,
}

/// What the engine makes of a control, once for all programs.
#[derive(Debug)]
pub struct Prepared {
    codes: Vec<CodeModel>,
    /// By code: what it demands of its block.
    pub(crate) contracts: Vec<CodeContract>,
    pub(crate) contract: BlockContract,
    pub(crate) feed_rank: Rank,
    pub(crate) speed_rank: Rank,
    pub(crate) tool_rank: Rank,
    pub(crate) motion_rank: Rank,
    /// Addresses whose value a missing decimal point scales: length, angle or not.
    scaled: [Option<WordKind>; Letter::COUNT],
    /// By address: the axis that it moves, and whether it is an increment whatever the mode.
    axis_of: [Option<(Axis, bool)>; Letter::COUNT],
    pub(crate) axes: Vec<Axis>,
    /// Addresses that name an axis or its increment.
    pub(crate) axis_letters: LetterSet,
    /// The words of a straight cut that shape its end or give its direction.
    pub(crate) corners: CornerWords,
    /// Addresses of offset numbers that stay for a later code when no code of their block reads them: `D01` before `G41`.
    pub(crate) lasting: LetterSet,
    pub(crate) argument_letters: Vec<(Letter, u32)>,
    numbered: Vec<(u32, usize)>,
    named: FxHashMap<String, usize>,
    /// By role: the code in effect at power-on.
    pub(crate) defaults: [CodeIx; Role::COUNT],
    pub(crate) at_end: Vec<CodeIx>,
    /// Some code has words that are millimetres and distances, whatever the modes.
    pub(crate) has_millimetre_distances: bool,
    /// The code that ends canned cycles.
    pub(crate) cycle_cancel: CodeIx,
    /// Canned cycles and motion are one modal group, so that a cycle replaces the motion mode.
    pub cycles_are_motion: bool,
}

/// By letter: the kind of the addresses whose numbers count least increments without a point.
fn scaled_kinds(control: &Control) -> [Option<WordKind>; Letter::COUNT] {
    let mut scaled = [None; Letter::COUNT];
    for (index, slot) in scaled.iter_mut().enumerate() {
        let letter = (0..=u8::MAX)
            .filter_map(|b| Letter::new(b).or_else(|| Letter::sign(b)))
            .chain([Letter::CORNER_R, Letter::CORNER_C, Letter::CORNER_A])
            .find(|letter| letter.index() == index);
        *slot = letter.and_then(|l| control.letter(l)).filter(|entry| entry.scaled).map(|entry| entry.kind);
    }
    scaled
}

/// The place of a phase in the control's order within a block.
fn rank(control: &Control, phase: &str) -> Rank {
    let phases = control.phases();
    Rank(phases.iter().position(|p| p == phase).unwrap_or(phases.len()) as u8)
}

fn numbers_of(names: &[String]) -> Vec<CodeNumber> {
    names.iter().filter_map(|name| CodeNumber::parse(name)).collect()
}

fn codes_of(control: &Control) -> Vec<CodeModel> {
    let semantics = control.semantics();
    let across = numbers_of(&semantics.cycles.across);
    let millimetre_distances = numbers_of(&semantics.millimetre_distances);
    let model = |code: gcheck_controls::Code<'_>| CodeModel {
        effect: code.effect(),
        role: Role::of(code.effect()),
        rank: rank(control, &code.entry().phase),
        group: code.group_ix(),
        modal: code.group().modal,
        takes_axes: code.entry().takes_axes,
        across: across.contains(&code.number()),
        millimetre_distances: millimetre_distances.contains(&code.number()),
    };
    control.codes().map(model).collect()
}

/// The axes of a control, and the addresses that move them.
struct MachineAxes {
    axes: Vec<Axis>,
    letters: LetterSet,
    by_letter: [Option<(Axis, bool)>; Letter::COUNT],
}

impl MachineAxes {
    fn of(control: &Control) -> Self {
        let increments: Vec<(Letter, Axis)> = control
            .semantics()
            .increments
            .iter()
            .filter_map(|(letter, axis)| Some((Letter::parse(letter)?, Axis::of(Letter::parse(axis)?)?)))
            .collect();
        let is_increment = |axis: &Axis| increments.iter().any(|(letter, _)| *letter == axis.letter());
        let axes: Vec<Axis> = Axis::ALL
            .into_iter()
            .filter(|axis| control.axes().contains(axis.letter()) && !is_increment(axis))
            .collect();
        let letters: LetterSet = axes
            .iter()
            .map(|axis| axis.letter())
            .chain(increments.iter().map(|(letter, _)| *letter))
            .collect();
        let mut by_letter = [None; Letter::COUNT];
        let named = axes.iter().map(|axis| (axis.letter(), (*axis, false)));
        for (letter, entry) in named.chain(increments.iter().map(|(letter, axis)| (*letter, (*axis, true)))) {
            if let Some(slot) = by_letter.get_mut(letter.index()) {
                *slot = Some(entry);
            }
        }
        Self { axes, letters, by_letter }
    }
}

impl Deref for Model<'_> {
    type Target = Prepared;

    #[inline]
    fn deref(&self) -> &Prepared {
        self.prepared
    }
}

impl Prepared {
    fn of(control: &Control) -> Self {
        let semantics = control.semantics();
        let rank = |name: &str| rank(control, name);
        let axes = MachineAxes::of(control);
        let argument_letters = semantics
            .argument_letters
            .iter()
            .filter_map(|(letter, number)| Some((Letter::parse(letter)?, u32::from(*number))))
            .collect();
        let mut prepared = Self {
            contracts: control.codes().map(|code| CodeContract::of(code, control)).collect(),
            contract: BlockContract::of(control),
            feed_rank: rank("feed"),
            speed_rank: rank("spindle-speed"),
            tool_rank: rank("tool-select"),
            motion_rank: rank("motion"),
            scaled: scaled_kinds(control),
            axis_of: axes.by_letter,
            axes: axes.axes,
            axis_letters: axes.letters,
            corners: CornerWords::default(),
            lasting: lasting_letters(control),
            argument_letters,
            numbered: Vec::new(),
            named: FxHashMap::default(),
            defaults: [CodeIx::NONE; Role::COUNT],
            at_end: Vec::new(),
            has_millimetre_distances: !numbers_of(&semantics.millimetre_distances).is_empty(),
            cycle_cancel: CodeIx::NONE,
            cycles_are_motion: false,
            codes: codes_of(control),
        };
        prepared.index_system_variables(&semantics.system_variables);
        prepared.cycle_cancel = code_with(control, Effect::CycleCancel);
        if let Some(cut) = control.code_at(code_with(control, Effect::Linear)) {
            prepared.corners = CornerWords::of(&cut.entry().words, prepared.axis_letters);
        }
        prepared.cycles_are_motion = prepared.has_cycles_as_motion(control);
        let code_of =
            |name: &String| CodeNumber::parse(name).map(|n| control.code_ix(n)).filter(|ix| ix.is_some());
        prepared.at_end = semantics.at_end.iter().filter_map(code_of).collect();
        let starts = control.groups().iter().filter_map(|group| group.default.as_ref());
        for ix in starts.chain(&semantics.at_start).filter_map(code_of) {
            if let Some(role) = prepared.code(ix).and_then(|code| code.role)
                && let Some(slot) = prepared.defaults.get_mut(role.index())
            {
                *slot = ix;
            }
        }
        prepared
    }

    fn index_system_variables(&mut self, variables: &[SystemVariable]) {
        for (index, variable) in variables.iter().enumerate() {
            if let Some(first) = variable.first {
                self.numbered.push((first, index));
            }
            if let Some(name) = &variable.name {
                self.named.insert(name.to_ascii_lowercase(), index);
            }
        }
        self.numbered.sort_unstable();
    }

    /// Are canned cycles and motion one modal group?
    fn has_cycles_as_motion(&self, control: &Control) -> bool {
        let group = |effect| self.code(code_with(control, effect)).map(|code| code.group);
        match group(Effect::CycleDrill) {
            Some(drilling) => Some(drilling) == group(Effect::Linear),
            // A control without cycles says by its cancelling code alone that no motion mode is left.
            None => {
                let cancel = control.code_at(self.cycle_cancel);
                cancel.is_some_and(|code| code.entry().cancels.iter().any(|item| item == "@motion"))
            }
        }
    }

    #[inline]
    pub(crate) fn code(&self, code: CodeIx) -> Option<&CodeModel> {
        self.codes.get(code.index())
    }
}

/// The first code that has an effect.
fn code_with(control: &Control, effect: Effect) -> CodeIx {
    let found = control.codes().find(|code| code.effect() == effect);
    found.map_or(CodeIx::NONE, |code| control.code_ix(code.number()))
}

impl<'c> Model<'c> {
    /// Prepares a control.
    pub fn new(control: &'c Control) -> Self {
        Self { control, prepared: control.prepared(Prepared::of) }
    }

    /// The control.
    pub fn control(&self) -> &'c Control {
        self.control
    }

    /// The code that a computed `G` or `M` word names, rounded to tenths as controls read it; `None` when there is none.
    pub fn code_of_value(&self, letter: Letter, value: f64) -> Option<CodeIx> {
        let nearest = (value * 10.0).round() / 10.0;
        // The strict control reads M codes as whole numbers, and G codes as tenths (observed: M2.00009 is M2, M2.0001 is refused;
        // G1.0001 is G1, G1.0002 is refused).
        let slack = if letter == Letter::of('M') { 9.9e-5 } else { 1.2e-4 };
        if self.semantics().strict && (value - nearest).abs() > slack {
            return None;
        }
        let number = CodeNumber::from_value(letter.ascii(), nearest)?;
        Some(self.control.code_ix(number)).filter(|code| code.is_some())
    }

    /// Where controls read one thing two ways.
    pub fn semantics(&self) -> &'c Semantics {
        self.control.semantics()
    }

    /// The work coordinate system before a program chooses one, 1 the first.
    pub fn work_at_power_on(&self) -> Option<u16> {
        match self.defaults.get(Role::WorkOffset.index()).map(|code| self.effect(*code)) {
            Some(Effect::WorkOffset(number)) => Some(number),
            _ => None,
        }
    }

    /// Is the feed of a helix measured along its circle? Otherwise it is along the path of the tool. As the setting that
    /// decides is told to be, else as the control usually does.
    pub fn feeds_helix_by_circle(&self, settings: &std::collections::BTreeMap<String, String>) -> bool {
        let helix = &self.semantics().helix;
        let told = helix.setting.as_deref().and_then(|number| settings.get(number));
        told.map_or(helix.feed == HelixFeed::Circle, |value| value != HELIX_BY_PATH)
    }

    /// Units before a program says any: the power-on code's, or those of the setting that decides, told or assumed.
    pub fn units_at_power_on(&self, settings: &std::collections::BTreeMap<String, String>) -> Option<Units> {
        match self.defaults.get(Role::Units.index()).map(|code| self.effect(*code)) {
            Some(Effect::Inch) => return Some(Units::Inch),
            Some(Effect::Millimetre) => return Some(Units::Mm),
            _ => {}
        }
        let decides =
            |values: &[String]| ["inch", "mm"].iter().all(|unit| values.iter().any(|value| value == unit));
        let setting = self.control.settings().iter().find(|setting| decides(&setting.values))?;
        let value = settings.get(&setting.number).or(setting.default.as_ref()).or(setting.values.first())?;
        match value.as_str() {
            "inch" => Some(Units::Inch),
            "mm" => Some(Units::Mm),
            _ => None,
        }
    }

    /// A code's effect; [`Effect::None`] for codes that the control does not have.
    #[inline]
    pub fn effect(&self, code: CodeIx) -> Effect {
        self.code(code).map_or(Effect::None, |c| c.effect)
    }

    /// Is a code a canned cycle that drills along X, whatever the plane?
    pub fn drills_across(&self, code: CodeIx) -> bool {
        self.code(code).is_some_and(|c| c.across)
    }

    /// The mode a code switches.
    pub fn role(&self, code: CodeIx) -> Option<Role> {
        self.code(code)?.role
    }

    /// The first code that has an effect.
    pub(crate) fn code_with(&self, effect: Effect) -> CodeIx {
        code_with(self.control, effect)
    }

    /// The setting that decides how numbers of an address without decimal point count, where it is one of its own.
    pub(crate) fn scale_setting(&self, letter: Letter) -> Option<&'c str> {
        self.control.letter(letter)?.scale_setting.as_deref()
    }

    /// What a number without a decimal point on this address counts, if scaling applies to it.
    pub(crate) fn scaled(&self, letter: Letter) -> Option<WordKind> {
        self.scaled.get(letter.index()).copied().flatten()
    }

    /// The axis that an address moves, and whether the word is an increment whatever the mode.
    pub(crate) fn axis_of(&self, letter: Letter) -> Option<(Axis, bool)> {
        self.axis_of.get(letter.index()).copied().flatten()
    }

    /// The addresses that move an axis: its own, and that of its increments.
    pub(crate) fn letters_of(&self, axis: Axis) -> impl Iterator<Item = Letter> + '_ {
        let is_of = move |letter: &Letter| self.axis_of(*letter).is_some_and(|(moved, _)| moved == axis);
        self.axis_letters.iter().filter(is_of)
    }

    /// Does the control read numbers without decimal point as least increments, as far as data alone says?
    pub(crate) fn unpointed(&self) -> Unpointed {
        self.control.numbers().unpointed
    }

    /// The system variable of a number: its entry, row and column.
    pub(crate) fn system_variable(&self, number: u32) -> Option<(&'c SystemVariable, u32, u32)> {
        let upto = self.numbered.partition_point(|(first, _)| *first <= number);
        // Rows of different variables may interlock (offsets and their rotations), so the nearest start may not be it.
        self.numbered.get(..upto)?.iter().rev().find_map(|(_, index)| {
            let variable = self.semantics().system_variables.get(*index)?;
            let (row, column) = variable.cell(number)?;
            Some((variable, row, column))
        })
    }

    /// The system variable of a named parameter, lower case.
    pub(crate) fn named_variable(&self, name: &str) -> Option<&'c SystemVariable> {
        self.named.get(name).and_then(|index| self.semantics().system_variables.get(*index))
    }
}

/// Words that a block without a code that reads them keeps for a later one: those that the data give from any block, of the
/// ones that the state has a place for. Nothing on a control that refuses a block with such a word.
fn lasting_letters(control: &Control) -> LetterSet {
    const KEPT: LetterSet = LetterSet::of("DH");
    if control.block_rules().unread_word == Handling::Refused {
        return LetterSet::EMPTY;
    }
    let is_kept = |letter: &Letter| {
        let uses = |code: Code<'_>| {
            let is_modal =
                |word: &WordEntry| word.need == Need::Modal && Letter::parse(&word.letter) == Some(*letter);
            let row = control.lasting_in(*letter, &code.entry().group);
            code.entry().words.iter().any(is_modal)
                && row.is_some_and(|row| row.from == LastingFrom::AnyBlock)
        };
        control.codes().any(uses)
    };
    KEPT.iter().filter(is_kept).collect()
}
