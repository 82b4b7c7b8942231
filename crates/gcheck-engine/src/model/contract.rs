//! What a control demands of codes and blocks before anything acts, prepared once.
//!
//! Knows: the contracts that data states. Must not know: blocks, states.

use gcheck_controls::{
    BlockRules, Code, CodeIx, CodeNumber, Confidence, Control, Effect, GroupIx, Handling, Letter, LetterSet,
    Need, WordEntry, WordKind,
};
use gcheck_program::BlockFlags;

/// Polar words: distance and angle from the origin.
pub(crate) const POLAR: LetterSet = {
    let mut letters = LetterSet::EMPTY;
    letters.insert(Letter::AT);
    letters.insert(Letter::CARET);
    letters
};

/// Which values one address takes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ValueRange {
    pub(crate) letter: Letter,
    pub(crate) whole: bool,
    pub(crate) min: f64,
    pub(crate) max: f64,
    pub(crate) above: f64,
}

impl ValueRange {
    /// `None` when every value is good.
    fn new(letter: Letter, kind: WordKind, [min, max, above]: [Option<f64>; 3]) -> Option<Self> {
        let range = Self {
            letter,
            whole: matches!(kind, WordKind::Integer | WordKind::LeastIncrements | WordKind::Program),
            min: min.unwrap_or(f64::NEG_INFINITY),
            max: max.unwrap_or(f64::INFINITY),
            above: above.unwrap_or(f64::NEG_INFINITY),
        };
        let limits = range.whole || min.is_some() || max.is_some() || above.is_some();
        limits.then_some(range)
    }

    /// Is the value good? One that is not known is.
    pub(crate) fn takes(&self, value: f64) -> bool {
        value.is_nan()
            || (self.min..=self.max).contains(&value)
                && (value > self.above || self.above.is_infinite())
                && (!self.whole || is_whole(value))
    }
}

/// Whole, as far as the interpreter's own arithmetic lets a number be.
fn is_whole(value: f64) -> bool {
    (value - value.round()).abs() <= 1e-4
}

/// What one code demands of its block, before the block acts.
#[derive(Debug, Clone, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts of a code")]
pub(crate) struct CodeContract {
    /// Addresses that it reads.
    pub(crate) reads: LetterSet,
    /// Addresses that count something or name it by its number.
    pub(crate) counts: LetterSet,
    /// It reads any address.
    pub(crate) reads_all: bool,
    pub(crate) required: LetterSet,
    /// Of each set one address must stand.
    pub(crate) one_of: Vec<LetterSet>,
    /// Of each list only one set may stand.
    pub(crate) apart: Vec<Vec<LetterSet>>,
    pub(crate) forbidden: LetterSet,
    pub(crate) ranges: Vec<ValueRange>,
    /// Codes that must not stand in the block.
    pub(crate) conflicts: Vec<CodeIx>,
    /// Groups, as bits, of which no code may stand in the block.
    pub(crate) conflict_groups: u64,
    /// Another code of the group must not stand in the block.
    pub(crate) exclusive: bool,
    /// Only where it opens the block is the code read, and then nothing else acts.
    pub(crate) first_only: bool,
    pub(crate) is_m: bool,
    /// Cutter compensation must be off when the code acts.
    pub(crate) uncompensated: bool,
    /// The code chooses among spindles.
    pub(crate) of_spindle: bool,
}

/// What holds for every block of a control.
#[derive(Debug, Clone)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts of a control")]
pub(crate) struct BlockContract {
    pub(crate) strict: bool,
    pub(crate) two_of_a_group: bool,
    pub(crate) code_twice: bool,
    pub(crate) word_twice: bool,
    pub(crate) unread_word: bool,
    /// Nothing at all is refused.
    pub(crate) idle: bool,
    /// Addresses that make a block without codes worth a look.
    pub(crate) watched: LetterSet,
    /// Addresses that need somebody to read them.
    pub(crate) bound: LetterSet,
    /// Addresses that need nobody to read them beside one of these.
    pub(crate) beside: Vec<(Letter, LetterSet)>,
    pub(crate) ranges: Vec<ValueRange>,
    /// Flags that make a block without codes worth a look.
    pub(crate) trouble: BlockFlags,
    pub(crate) m_codes: usize,
    /// Axes that only a machine's configuration gives.
    pub(crate) absent_axes: LetterSet,
    pub(crate) block_delete_first: bool,
    pub(crate) block_delete_plain: bool,
}

/// The addresses of a text like `"IJ@"`.
fn letters(text: &str) -> LetterSet {
    let mut buffer = [0; 4];
    text.chars().filter_map(|c| Letter::parse(c.encode_utf8(&mut buffer))).collect()
}

fn listed(list: &std::collections::BTreeMap<String, String>, code: &str) -> LetterSet {
    list.get(code).map_or(LetterSet::EMPTY, |text| letters(text))
}

/// Every address.
fn every_letter() -> impl Iterator<Item = Letter> {
    let corners = [Letter::CORNER_R, Letter::CORNER_C, Letter::CORNER_A];
    (0..=u8::MAX).filter_map(Letter::new).chain((0..=u8::MAX).filter_map(Letter::sign)).chain(corners)
}

impl CodeContract {
    /// What data says of a code, on a control that refuses; nothing on others.
    pub(crate) fn of(code: Code<'_>, control: &Control) -> Self {
        let entry = code.entry();
        let semantics = control.semantics();
        let rules = &semantics.refusals;
        let reads_all = entry.any_words || code.is_user();
        let mut contract = Self {
            reads: code.reads().without(listed(&rules.newer_words, &entry.code)),
            counts: entry
                .words
                .iter()
                .filter(|word| word.kind.is_whole())
                .filter_map(|word| Letter::parse(&word.letter))
                .collect(),
            reads_all,
            exclusive: code.group().exclusive,
            is_m: code.number().letter() == b'M',
            ..Self::default()
        };
        if !semantics.strict {
            return contract;
        }
        let late = listed(&rules.late_words, &entry.code);
        let late_values = listed(&rules.late_values, &entry.code).or(late);
        let sure =
            |word: &&WordEntry| word.confidence.is_none_or(|confidence| confidence != Confidence::Assumed);
        for word in entry.words.iter().filter(sure) {
            let Some(letter) = Letter::parse(&word.letter) else { continue };
            if word.need == Need::Required && !late.contains(letter) {
                contract.required.insert(letter);
            }
            let is_range_sure = word.range_confidence != Some(Confidence::Assumed);
            if is_range_sure && !late_values.contains(letter) {
                contract.ranges.extend(ValueRange::new(letter, word.kind, [word.min, word.max, word.above]));
            }
        }
        let is_early = |set: &LetterSet| !set.intersects(late);
        let set =
            |items: &[String]| -> LetterSet { items.iter().filter_map(|item| Letter::parse(item)).collect() };
        contract.one_of = entry.one_of.iter().map(|items| set(items)).filter(is_early).collect();
        for items in &entry.not_together {
            let sets: Vec<LetterSet> = items.iter().map(|item| letters(item)).collect();
            if sets.iter().all(is_early) {
                contract.apart.push(sets);
            }
        }
        contract.forbidden = set(&entry.forbidden).without(late);
        for item in &entry.conflicts {
            match item.strip_prefix('@') {
                Some(group) => {
                    let group = control.group_by_id(group).map_or(u32::MAX, |ix| ix.index() as u32);
                    contract.conflict_groups |= 1_u64.checked_shl(group).unwrap_or(0);
                }
                None => {
                    let ix = CodeNumber::parse(item).map(|number| control.code_ix(number));
                    contract.conflicts.extend(ix.filter(|ix| ix.is_some()));
                }
            }
        }
        contract.of_spindle = contract.reads.contains(Letter::DOLLAR);
        contract.first_only = rules.first_only.contains(&entry.code);
        contract.uncompensated = entry.requires.iter().any(|item| {
            let code = CodeNumber::parse(item).and_then(|number| control.code(number));
            code.is_some_and(|code| code.effect() == Effect::CompensationOff)
        });
        contract
    }
}

impl BlockContract {
    /// What data says of a control's blocks. Only what a manual says is refused.
    pub(crate) fn of(control: &Control) -> Self {
        let BlockRules { two_of_a_group, code_twice, word_twice, unread_word, confidence, .. } =
            control.block_rules();
        let is_refused =
            |handling: &Handling| *handling == Handling::Refused && *confidence == Confidence::Manual;
        let semantics = control.semantics();
        let rules = &semantics.refusals;
        let strict = semantics.strict;
        let beside: Vec<(Letter, LetterSet)> = rules
            .beside
            .iter()
            .filter_map(|(letter, with)| Some((Letter::parse(letter)?, letters(with))))
            .collect();
        let mut bound = LetterSet::EMPTY;
        let mut ranges = Vec::new();
        for letter in every_letter() {
            let Some(entry) = control.letter(letter) else { continue };
            if !entry.free && !entry.axis || beside.iter().any(|(other, _)| *other == letter) {
                bound.insert(letter);
            }
            // Codes are judged as codes, and spindles below.
            let is_code = matches!(letter.ascii(), b'G' | b'M' | b'N' | b'O') && !letter.is_corner();
            if strict && !is_code && letter != Letter::DOLLAR {
                ranges.extend(ValueRange::new(letter, entry.kind, [entry.min, entry.max, None]));
            }
        }
        if !is_refused(unread_word) {
            bound = LetterSet::EMPTY;
        }
        let absent_axes = match &rules.axes {
            Some(axes) if strict => control.axes().without(letters(axes)),
            _ => LetterSet::EMPTY,
        };
        let bounded: LetterSet = ranges.iter().map(|range: &ValueRange| range.letter).collect();
        let syntax = control.syntax();
        let sure_of_delete = strict && syntax.block_delete_confidence == Some(Confidence::Manual);
        let mut trouble = BlockFlags::empty();
        trouble.set(BlockFlags::REPEATED, is_refused(word_twice));
        trouble.set(BlockFlags::UNKNOWN_ADDRESS, strict);
        let refuses = [two_of_a_group, code_twice, word_twice, unread_word].into_iter().any(is_refused);
        Self {
            strict,
            two_of_a_group: is_refused(two_of_a_group),
            code_twice: is_refused(code_twice),
            word_twice: is_refused(word_twice),
            unread_word: is_refused(unread_word),
            idle: !strict && !refuses,
            watched: bound.or(bounded).or(absent_axes).or(POLAR),
            bound,
            beside,
            ranges,
            trouble,
            m_codes: control.limits().m_codes_per_block.map_or(usize::MAX, usize::from),
            absent_axes,
            block_delete_first: sure_of_delete && !syntax.block_delete_inside,
            block_delete_plain: sure_of_delete && !syntax.block_delete_levels,
        }
    }
}

impl CodeContract {
    pub(crate) fn excludes(&self, other: CodeIx, group: GroupIx) -> bool {
        let bit = 1_u64.checked_shl(group.index() as u32).unwrap_or(0);
        self.conflict_groups & bit != 0 || self.conflicts.contains(&other)
    }
}
