//! What blocks of `G10` say that cannot be read: words without a known value, kinds of offsets that are not followed.
//!
//! Knows: which words say what is written, and where. Must not know: keys of `gcheck.toml`.

use std::collections::BTreeSet;

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Abstract, AbstractValue, Axis, Concrete, Domain as _, Look, Origin, Position, State};
use gcheck_program::{BlockFlags, Loaded, Place, Value, Word};

use crate::execution::Session;

/// Reasons, as lists of what is not used say them.
const UNKNOWN: &str = "its value is not known when the program starts";
const ADDED: &str = "`G91` adds it to what the control has, which the file does not say";
const NO_MODE: &str = "whether it is absolute is not known";
const NO_KIND: &str = "without a known `L` it is not known what is written";
const NOT_FOLLOWED: &str = "gcheck does not read this kind of `G10`";
const NO_VALUE: &str = "the block names no value that gcheck reads (`R`)";

/// Kinds of offsets (`L`) that are work offsets, and those of tools.
const OF_WORK: [f64; 2] = [2.0, 20.0];
const OF_TOOLS: [f64; 5] = [1.0, 10.0, 11.0, 12.0, 13.0];

/// Something that a block says, and why it is not read.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Unread {
    /// First byte of the block.
    pub(super) at: usize,
    pub(super) what: String,
    pub(super) why: &'static str,
}

/// Looks at blocks of `G10` as they are executed.
pub(super) struct Reader<'s> {
    session: &'s Session<'s>,
    look: Look<'s, 's>,
    /// Of what was looked at; a block that is executed twice says it once.
    pub(super) found: BTreeSet<Unread>,
}

impl<'s> Reader<'s> {
    pub(super) fn new(session: &'s Session<'s>) -> Self {
        let look = Look::new(session.program, session.model, &session.prepared.equipment.machine);
        Self { session, look, found: BTreeSet::new() }
    }

    /// Looks at a block in the state before it.
    pub(super) fn look(&mut self, origin: Origin, state: &State<Concrete>) {
        let session = self.session;
        let Some(file) = session.program.file(origin.at.file) else { return };
        let Some(place) = file.loaded.place(origin.at.block, session.program.dialect()) else { return };
        let values = if origin.flags.contains(BlockFlags::EXPRESSION) {
            self.look.words(&place, origin.at, &state.as_abstract())
        } else {
            Vec::new()
        };
        let block =
            Block { words: place.table.words(place.block()), values, place: &place, loaded: &file.loaded };
        let at = origin.start as usize;
        for (what, why) in block.unread(session, state) {
            self.found.insert(Unread { at, what, why });
        }
    }
}

/// A block with the values of its computed words.
struct Block<'b> {
    words: &'b [Word],
    values: Vec<(Word, AbstractValue)>,
    place: &'b Place,
    loaded: &'b Loaded<'b>,
}

impl Block<'_> {
    /// What of it cannot be read.
    fn unread(&self, session: &Session<'_>, state: &State<Concrete>) -> Vec<(String, &'static str)> {
        let control = session.model.control();
        let effect = |word: &Word| control.code_at(word.code).map(gcheck_controls::Code::effect);
        let Some(code) = self.words.iter().find(|word| effect(word) == Some(Effect::WriteOffsets)) else {
            return Vec::new();
        };
        let code = self.shown(code);
        let unknown = self.words.iter().filter(|word| self.value(word).is_none());
        let unknown: Vec<(String, &'static str)> = unknown.map(|word| (self.shown(word), UNKNOWN)).collect();
        if !unknown.is_empty() {
            return unknown;
        }
        let Some(kind) = self.of('L') else { return vec![(code, NO_KIND)] };
        let axes = || Axis::ALL.into_iter().filter(|axis| self.of_letter(axis.letter()).is_some());
        let names_value = |letter: char| self.of(letter).is_some();
        if OF_WORK.contains(&kind) {
            return self.against_mode(session, state, axes());
        }
        let is_followed = OF_TOOLS.contains(&kind) && (names_value('R') || axes().next().is_some());
        if OF_TOOLS.contains(&kind) && !is_followed {
            return vec![(format!("{code} L{kind}"), NO_VALUE)];
        }
        if !is_followed {
            return vec![(format!("{code} L{kind}"), NOT_FOLLOWED)];
        }
        Vec::new()
    }

    /// Values of work offsets that count from what is not known.
    fn against_mode(
        &self,
        session: &Session<'_>,
        state: &State<Concrete>,
        axes: impl Iterator<Item = Axis>,
    ) -> Vec<(String, &'static str)> {
        let why = match state.is_incremental(session.model) {
            Some(false) => return Vec::new(),
            Some(true) => ADDED,
            None => NO_MODE,
        };
        let origin =
            self.system(session).map_or(Position::UNKNOWN, |number| state.tables().offset(number).origin);
        let unknown = axes.filter(|axis| origin.get(*axis).is_none());
        let words = unknown.filter_map(|axis| self.words.iter().find(|word| word.letter == axis.letter()));
        words.map(|word| (self.shown(word), why)).collect()
    }

    /// The work offset that it writes.
    fn system(&self, session: &Session<'_>) -> Option<u16> {
        let first = || {
            session.model.control().codes().find_map(|code| match code.effect() {
                Effect::WorkOffsetByP(first) => Some(first),
                _ => None,
            })
        };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked to be a small count"
        )]
        let p = self.of('P').filter(|p| (1.0..1000.0).contains(p)).map(|p| p as u16)?;
        if self.of('L') == Some(20.0) { first()?.checked_add(p - 1) } else { Some(p) }
    }

    fn of(&self, letter: char) -> Option<f64> {
        self.of_letter(Letter::of(letter))
    }

    fn of_letter(&self, letter: Letter) -> Option<f64> {
        self.words.iter().find(|word| word.letter == letter).and_then(|word| self.value(word))
    }

    /// The value of a word, as far as it is known; a letter alone counts as zero.
    fn value(&self, word: &Word) -> Option<f64> {
        if let Some(number) = word.number() {
            return Some(number);
        }
        if !word.is_computed() {
            return Some(0.0);
        }
        let (_, value) = self.values.iter().find(|(computed, _)| computed == word)?;
        // An empty variable is not a value either: the control then writes nothing.
        Abstract::known(value)
    }

    /// As it is written, without blanks.
    fn shown(&self, word: &Word) -> String {
        let range = match word.value {
            Value::Expr(expr) => self.place.table.expr(expr).range.clone(),
            _ => word.range(),
        };
        let written = self.loaded.slice(self.place.base + range.start..self.place.base + range.end);
        let written: String = written.chars().filter(|c| !c.is_whitespace()).collect();
        if matches!(word.value, Value::Expr(_)) { format!("{}{written}", word.letter) } else { written }
    }
}
