//! The variations of a block, and what the knowledge base says of each.
//!
//! Knows: words as data state them. Must not know: what is reported.

use gcheck_controls::{
    Code, CodeNumber, Control, LastingEnd, LastingFrom, LastingWords, Letter, LetterSet, Motion, Need,
    WordEntry, WordKind,
};

use crate::block::{Subject, Word};

/// What is done to a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    Computed,
    ComputedOutOfRange,
    OutOfRange,
    Lasting,
    Missing,
    Extra,
}

impl Kind {
    pub(crate) const ALL: [Self; 6] = [
        Self::Computed,
        Self::ComputedOutOfRange,
        Self::OutOfRange,
        Self::Lasting,
        Self::Missing,
        Self::Extra,
    ];

    /// Does the case need variables?
    pub(crate) fn is_computed(self) -> bool {
        matches!(self, Self::Computed | Self::ComputedOutOfRange)
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Computed => "computed",
            Self::ComputedOutOfRange => "computed, out of range",
            Self::OutOfRange => "out of range",
            Self::Lasting => "in an earlier block",
            Self::Missing => "missing",
            Self::Extra => "extra",
        }
    }
}

/// What the data ask of a variation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Asked {
    /// The program stays correct.
    Same,
    /// Something is to be reported.
    Finding,
    /// The data allow it, for the reason.
    Allowed(&'static str),
}

/// Why the data allow a word that no code of its block reads.
pub(crate) const MOTION: &str = "the motion in effect reads it";

/// One variation of the block of a code.
pub(crate) struct Case {
    /// The code, as data write it.
    pub(crate) code: String,
    pub(crate) kind: Kind,
    pub(crate) letter: Letter,
    pub(crate) asked: Asked,
    /// The block, and what comes before it for this case.
    pub(crate) shown: String,
    pub(crate) program: String,
}

/// All variations of a code's block.
pub(crate) fn of(control: &Control, code: Code<'_>, subject: &Subject<'_>) -> Vec<Case> {
    let maker = Maker { control, code, subject };
    let mut cases = Vec::new();
    for word in &subject.words {
        maker.values(word, &mut cases);
        maker.places(word, &mut cases);
    }
    maker.computed_code(&mut cases);
    maker.extra(&mut cases);
    maker.refused_beside(&mut cases);
    cases
}

struct Maker<'a, 'c> {
    control: &'a Control,
    code: Code<'c>,
    subject: &'a Subject<'c>,
}

impl Maker<'_, '_> {
    fn case(&self, kind: Kind, letter: Letter, asked: Asked, more: &[String], block: &str) -> Case {
        let shown: Vec<&str> = more.iter().map(String::as_str).chain([block]).collect();
        Case {
            code: self.code.entry().code.clone(),
            kind,
            letter,
            asked,
            shown: shown.join(" / "),
            program: self.subject.with(more, block),
        }
    }

    /// The entry of the word in the first code of the block that reads it.
    fn entry(&self, letter: Letter) -> Option<&WordEntry> {
        let codes = self.subject.codes.iter();
        codes.flat_map(|code| &code.entry().words).find(|word| Letter::parse(&word.letter) == Some(letter))
    }

    /// The number of the code itself computed, and one that is not a code.
    fn computed_code(&self, cases: &mut Vec<Case>) {
        let number = self.code.number();
        let Some(letter) = Letter::new(number.letter()) else { return };
        let Some((word, digits)) = self.subject.code_word(number) else { return };
        if !self.has_variables() {
            return;
        }
        for (value, kind) in [(digits.as_str(), Kind::Computed), ("987", Kind::ComputedOutOfRange)] {
            let mut block = self.subject.block.clone();
            block.replace_range(word.clone(), &format!("{letter}#100"));
            let asked = match kind {
                Kind::Computed => Asked::Same,
                _ if self.control.may_be_of_builder(letter, 987.0) => {
                    Asked::Allowed("the machine builder may have such a code")
                }
                _ => Asked::Finding,
            };
            cases.push(self.case(kind, letter, asked, &[format!("#100={value}")], &block));
        }
    }

    fn takes_any(&self) -> bool {
        self.subject.codes.iter().any(|code| code.entry().any_words)
    }

    fn has_variables(&self) -> bool {
        !self.control.variables().is_empty()
    }

    /// The word computed, and with values that it may not have.
    fn values(&self, word: &Word, cases: &mut Vec<Case>) {
        let letter = word.letter;
        let written = format!("{letter}#100");
        if self.has_variables() {
            let more = [format!("#100={}", word.digits)];
            let block = self.subject.replaced(word, &written);
            let asked = match self.kind(letter) {
                Some(WordKind::SecondsOrMilliseconds | WordKind::Milliseconds) => {
                    Asked::Allowed("without a point a written number counts another unit")
                }
                Some(WordKind::Label | WordKind::Program) => {
                    Asked::Allowed("its target is not in the program")
                }
                _ => Asked::Same,
            };
            cases.push(self.case(Kind::Computed, letter, asked, &more, &block));
        }
        for value in self.bad_values(word) {
            let block = self.subject.replaced(word, &format!("{letter}{value}"));
            cases.push(self.case(Kind::OutOfRange, letter, Asked::Finding, &[], &block));
            if self.has_variables() {
                let more = [format!("#100={value}")];
                let block = self.subject.replaced(word, &written);
                cases.push(self.case(Kind::ComputedOutOfRange, letter, Asked::Finding, &more, &block));
            }
        }
    }

    /// The kind of the word's value.
    fn kind(&self, letter: Letter) -> Option<WordKind> {
        self.entry(letter).map(|word| word.kind)
    }

    /// Values that the data do not allow.
    fn bad_values(&self, word: &Word) -> Vec<String> {
        if self.takes_any() {
            return Vec::new();
        }
        let general = self.control.letter(word.letter);
        let entry = self.entry(word.letter);
        let (kind, min, max, above) = match (entry, general) {
            (Some(e), _) => self.bounds(e),
            (None, Some(g)) => (g.kind, g.min, g.max, None),
            (None, None) => return Vec::new(),
        };
        let is_count = kind.is_whole();
        let show = |value: f64| {
            if is_count {
                format!("{value}")
            } else if value.fract() == 0.0 {
                format!("{value}.")
            } else {
                format!("{value}")
            }
        };
        let mut values = Vec::new();
        if kind == WordKind::Flag {
            return values;
        }
        if let Some(low) = min.map(|min| min - 1.0).or(above) {
            values.push(show(low));
        } else if general.is_some_and(|g| !g.negative) {
            values.push(show(-word.number.abs().max(1.0)));
        }
        if let Some(max) = max {
            values.push(show(max + 1.0));
        }
        if is_count {
            values.push(format!("{}", word.number.trunc() + 0.5));
        }
        let listed = entry.map_or(&[][..], |entry| &entry.values);
        if let Some(highest) = listed.iter().copied().reduce(f64::max) {
            values.push(show(highest + 1.0));
        }
        values
    }

    /// Kind and bounds of a word, as it is beside the other words of the block.
    fn bounds(&self, entry: &WordEntry) -> (WordKind, Option<f64>, Option<f64>, Option<f64>) {
        let stands = |item: &String| {
            self.subject.words.iter().any(|word| format!("{}{}", word.letter, word.number) == *item)
        };
        let beside = entry.beside.iter().find(|beside| beside.with.iter().any(stands));
        let beside = beside.map(|beside| (beside.min, beside.max, beside.above)).unwrap_or_default();
        (entry.kind, entry.min.or(beside.0), entry.max.or(beside.1), entry.above.or(beside.2))
    }

    /// Words that the data refuse beside the values of the block's words.
    fn refused_beside(&self, cases: &mut Vec<Case>) {
        let stands = |item: &String| {
            self.subject.words.iter().any(|word| format!("{}{}", word.letter, word.number) == *item)
        };
        for entry in self.subject.codes.iter().flat_map(|code| &code.entry().words) {
            let is_refused =
                entry.beside.iter().any(|beside| beside.refused && beside.with.iter().any(stands));
            let Some(letter) = Letter::parse(&entry.letter).filter(|_| is_refused) else { continue };
            let block = self.subject.with_word(&format!("{letter}1"));
            cases.push(self.case(Kind::Extra, letter, Asked::Finding, &[], &block));
        }
    }

    /// The word in an earlier block, and nowhere.
    fn places(&self, word: &Word, cases: &mut Vec<Case>) {
        let letter = word.letter;
        let block = self.subject.replaced(word, "");
        let alone = self.subject.block[word.range.clone()].trim().to_owned();
        cases.push(self.case(Kind::Missing, letter, self.without(letter), &[], &block));
        let asked = self.lasting(letter);
        cases.push(self.case(Kind::Lasting, letter, asked, std::slice::from_ref(&alone), &block));
        let Some(row) = self.row(letter) else { return };
        if row.from == LastingFrom::AnyBlock && matches!(letter.ascii(), b'D' | b'H') {
            let cancels: Vec<_> = ["G40", "G49"].into_iter().filter(|code| self.has(code)).collect();
            for after in [format!("{alone} G90"), format!("{alone} {}", cancels.join(" "))] {
                cases.push(self.case(Kind::Lasting, letter, asked, &[after], &block));
            }
            let changed = [alone, "T2 M6".to_owned(), "S1000 M3".to_owned()];
            cases.push(self.case(Kind::Lasting, letter, asked, &changed, &block));
        }
        if row.until.contains(&LastingEnd::Cancel) && self.has("G80") {
            let cancelled = [self.subject.block.clone(), "G80".to_owned()];
            cases.push(self.case(Kind::Lasting, letter, Asked::Finding, &cancelled, &block));
        }
    }

    /// How the word stays in effect for its code.
    fn row(&self, letter: Letter) -> Option<&LastingWords> {
        let reads = |code: &&Code<'_>| code.reads().contains(letter);
        let is_modal = self.entry(letter).is_some_and(|word| word.need == Need::Modal);
        let reader = self.subject.codes.iter().find(reads)?;
        self.control.lasting_in(letter, &reader.entry().group).filter(|_| is_modal)
    }

    fn has(&self, code: &str) -> bool {
        CodeNumber::parse(code).is_some_and(|number| self.control.code(number).is_some())
    }

    /// What the data say of the block without the word.
    fn without(&self, letter: Letter) -> Asked {
        let is_only = |items: &Vec<String>| {
            let here = |item: &&String| LetterSet::of_item(item).intersects(self.subject.letters);
            let standing: Vec<_> = items.iter().filter(here).collect();
            standing.len() == 1
                && LetterSet::of_item(standing[0]).contains(letter)
                && LetterSet::of_item(standing[0]).and(self.subject.letters).iter().count() == 1
        };
        if self.subject.codes.iter().any(|code| code.entry().one_of.iter().any(is_only)) {
            return Asked::Finding;
        }
        let before = self.is_given_before(letter);
        match self.entry(letter) {
            Some(word) if word.need == Need::Required => Asked::Finding,
            Some(word) if word.need == Need::Modal && before => Asked::Allowed("an earlier block gives it"),
            Some(word) if word.need == Need::Modal => Asked::Finding,
            Some(word) if word.need == Need::Conditional => Asked::Allowed("needed in other cases only"),
            Some(_) => Asked::Allowed("optional"),
            None => Asked::Allowed("not a word of the code"),
        }
    }

    fn is_given_before(&self, letter: Letter) -> bool {
        let text = self.subject.before.join(" ");
        text.split_whitespace().any(|word| word.starts_with(&letter.to_string()))
    }

    /// What the data say of the word in a block of its own before the code's.
    fn lasting(&self, letter: Letter) -> Asked {
        let general = self.control.letter(letter);
        // A feed counts in the mode that it was given under.
        let sets_mode = self.subject.codes.iter().any(|code| code.entry().group == "feed-mode");
        match self.entry(letter) {
            Some(_) if sets_mode && letter == Letter::of('F') => {
                Asked::Allowed("a feed counts in the mode that it was given under")
            }
            Some(word) if word.need == Need::Modal => match self.row(letter).map(|row| row.from) {
                Some(LastingFrom::OwnCodes) => Asked::Finding,
                Some(LastingFrom::AnyBlock) | None => Asked::Same,
            },
            Some(word) if word.need == Need::Required => Asked::Finding,
            _ if general.is_some_and(|entry| entry.free || entry.axis) => {
                Asked::Allowed("may be in any block")
            }
            _ if self.is_of_motion(letter, LetterSet::EMPTY) => Asked::Allowed(MOTION),
            _ => Asked::Finding,
        }
    }

    /// Each letter that the block does not have and its codes do not read.
    fn extra(&self, cases: &mut Vec<Case>) {
        for letter in all_letters() {
            let skipped = !letter.is_corner() && matches!(letter.ascii(), b'G' | b'M' | b'N' | b'O');
            if skipped || self.subject.letters.contains(letter) || self.reads(letter) {
                continue;
            }
            let general = self.control.letter(letter);
            let is_whole = general.is_some_and(|g| g.kind.is_whole());
            let block = self.subject.with_word(&format!("{letter}{}", if is_whole { "1" } else { "1.5" }));
            cases.push(self.case(Kind::Extra, letter, self.with_extra(letter), &[], &block));
        }
    }

    fn reads(&self, letter: Letter) -> bool {
        self.subject.codes.iter().any(|code| code.reads().contains(letter))
    }

    /// Does the motion in effect before the block read the address, in a block with these others? Only where the block moves.
    fn is_of_motion(&self, letter: Letter, others: LetterSet) -> bool {
        let is_motion = |code: &&Code<'_>| code.entry().group == "motion" && code.motion() != Motion::None;
        let motion = self.subject.earlier.iter().rfind(is_motion);
        let is_axis = |letter: Letter| self.control.letter(letter).is_some_and(|entry| entry.axis);
        let moves = is_axis(letter) || others.iter().any(is_axis);
        moves && motion.is_some_and(|code| code.reads().contains(letter))
    }

    fn with_extra(&self, letter: Letter) -> Asked {
        let subject = self.subject;
        if self.takes_any() {
            return Asked::Allowed("an argument of the macro");
        }
        let Some(general) = self.control.letter(letter) else { return Asked::Finding };
        let forbids =
            |code: &Code<'_>| code.entry().forbidden.iter().any(|item| Letter::parse(item) == Some(letter));
        if subject.codes.iter().any(forbids) {
            return Asked::Finding;
        }
        let is_m = |code: &Code<'_>| code.number().letter() == b'M';
        if self.control.code_list().builder_m_codes && subject.codes.iter().any(is_m) {
            return Asked::Allowed("the machine builder decides about words of M codes");
        }
        let takes = subject.codes.iter().any(|code| code.entry().takes_axes || code.motion() != Motion::None);
        if general.axis && !takes {
            return Asked::Allowed(MOTION);
        }
        if !takes && self.is_of_motion(letter, subject.letters) {
            return Asked::Allowed(MOTION);
        }
        if general.free && !general.axis {
            return Asked::Allowed("may be in any block");
        }
        let lasting = |code: &&Code<'_>| code.group().modal && code.reads().contains(letter);
        let is_cancel = |code: &&Code<'_>| !subject.codes.iter().any(|own| own.group_ix() == code.group_ix());
        if subject.earlier.iter().filter(is_cancel).any(|code| lasting(&code)) {
            return Asked::Allowed("a mode of an earlier block reads it");
        }
        Asked::Finding
    }
}

pub(crate) fn all_letters() -> impl Iterator<Item = Letter> {
    let signs = [Letter::CORNER_R, Letter::CORNER_C, Letter::CORNER_A];
    (b'A'..=b'Z').filter_map(Letter::new).chain(signs)
}
