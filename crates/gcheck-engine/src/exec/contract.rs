//! What a control refuses of a block before anything of it acts: words and codes that do not fit together.
//!
//! Knows: which words a code reads and needs, which codes exclude each other, from data prepared once for a control. Must not
//! know: what codes do, beyond the modes that decide which motion reads the block's words.
//!
//! Only a run refuses. An analysis of all paths goes on behind a mistake, and what a block says by itself is judged by the rules
//! of its text; so it takes every block as it stands.

use gcheck_controls::{CodeIx, Effect, Letter, LetterSet};
use gcheck_geometry::Plane;
use gcheck_program::{Block, BlockFlags, Place, Value, Word};

use crate::eval::value::Domain;
use crate::exec::context::{Executor, Step};
use crate::fault::{CycleFault, Fault};
use crate::model::Role;
use crate::model::contract::{CodeContract, POLAR, ValueRange};
use crate::observer::Observer;
use crate::state::State;

/// Which motion the words of a block belong to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Acting {
    /// None.
    Nothing,
    /// One that the block names.
    Named(CodeIx),
    /// The one in effect.
    InEffect(CodeIx),
}

impl Acting {
    fn code(self) -> Option<CodeIx> {
        match self {
            Self::Nothing => None,
            Self::Named(ix) | Self::InEffect(ix) => Some(ix),
        }
    }
}

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// Refuses a block for how it is written: where its number and its `/` stand, how long it is.
    pub(super) fn check_form(&self, place: &Place, words: &[Word], block: &Block) -> Step {
        let rules = &self.model.contract;
        if self.leaves_to_rules() || !rules.strict {
            return Ok(());
        }
        if block.flags.contains(BlockFlags::LONG_LINE) {
            return Err(Fault::LineTooLong);
        }
        if block.flags.contains(BlockFlags::BLOCK_DELETE) {
            let text = self.block_text(place, block).trim_ascii_start();
            let behind = text.strip_prefix(b"/").map(<[u8]>::trim_ascii_start);
            let is_first = behind.is_some();
            let has_level = behind.is_some_and(|rest| rest.first().is_some_and(u8::is_ascii_digit));
            let is_second = behind.is_some_and(|rest| rest.first() == Some(&b'/'));
            if rules.block_delete_first && (!is_first || is_second) || rules.block_delete_plain && has_level {
                return Err(Fault::Malformed);
            }
        }
        if block.flags.contains(BlockFlags::LABEL) {
            self.check_label(place, words, block)?;
        }
        if block.flags.contains(BlockFlags::PROGRAM_NUMBER) {
            self.check_o_word(place, words, block)?;
        }
        Ok(())
    }

    /// An O-word, or the `O` that begins a program, stands alone in its block, a number in front of it set aside.
    pub(super) fn check_o_word(&self, place: &Place, words: &[Word], block: &Block) -> Step {
        if self.leaves_to_rules() || !self.model.contract.strict || !self.model.control().syntax().o_words {
            return Ok(());
        }
        let (n, o) = (Letter::of('N'), Letter::of('O'));
        let others = words.iter().filter(|word| word.letter != n && word.letter != o).count();
        let programs = words.iter().filter(|word| word.letter == o).count();
        let has_statements = block.flags.contains(BlockFlags::STATEMENT);
        let statements = if has_statements { place.table.statements(place.ix).count() } else { 0 };
        if others > 0 || programs + statements > 1 { Err(Fault::Malformed) } else { Ok(()) }
    }

    /// The number of a block stands in front of everything but `/`, as digits without a sign.
    fn check_label(&self, place: &Place, words: &[Word], block: &Block) -> Step {
        let letter = Letter::of('N');
        let Some(word) = words.iter().find(|word| word.letter == letter) else { return Ok(()) };
        let start = word.range().start;
        if start != block.range.start {
            let length = start.saturating_sub(block.range.start) as usize;
            let before = self.block_text(place, block).get(..length).unwrap_or_default().trim_ascii();
            if !before.is_empty() && before != b"/" {
                return Err(Fault::Misplaced(letter));
            }
        }
        match word.value {
            Value::Number(_) if !word.shape.minus => Ok(()),
            _ => Err(Fault::WordRange(letter)),
        }
    }

    fn block_text(&self, place: &Place, block: &Block) -> &[u8] {
        let text = match &self.cursor {
            Some(cursor) => cursor.file.loaded.chunk_text(place.chunk).as_bytes(),
            None => &[],
        };
        text.get(block.range.start as usize..block.range.end as usize).unwrap_or_default()
    }

    /// Refuses a block whose words and codes do not fit together, before anything of it acts.
    pub(super) fn check_block(&self, place: &Place, words: &[Word], state: &State<D>) -> Step {
        let rules = &self.model.contract;
        if rules.idle {
            return Ok(());
        }
        if self.leaves_to_rules() {
            return if rules.strict { self.check_polar(state) } else { Ok(()) };
        }
        let codes = self.words.codes();
        let present = self.words.present();
        let flags = self.origin.flags;
        // A block that only moves pays for this one test: what the motion refuses, it refuses before it does anything.
        if codes.is_empty() && !present.intersects(rules.watched) && !flags.intersects(rules.trouble) {
            return Ok(());
        }
        if rules.word_twice && flags.contains(BlockFlags::REPEATED) && !self.any_reads_all() {
            self.check_repeated(words)?;
        }
        if flags.intersects(rules.trouble.intersection(BlockFlags::UNKNOWN_ADDRESS)) {
            return Err(Fault::Malformed);
        }
        self.check_codes(place, words)?;
        if rules.strict {
            self.check_axes()?;
            for range in &rules.ranges {
                self.check_range(range)?;
            }
        }
        let acting = self.acting_motion(state);
        if rules.strict {
            self.check_motion(acting, state)?;
        }
        if rules.unread_word {
            self.check_all_read(acting)?;
        }
        if rules.strict {
            self.check_words(acting)?;
        }
        Ok(())
    }

    /// Addresses of which one in a block without codes and flags makes [`Self::check_block`] look at it.
    pub(super) fn watched_letters(&self) -> LetterSet {
        let rules = &self.model.contract;
        if self.leaves_to_rules() || rules.idle { LetterSet::EMPTY } else { rules.watched }
    }

    /// Does the code stand once, and in front of all else but the number?
    fn opens_block(&self, place: &Place, words: &[Word], ix: CodeIx) -> bool {
        let Some(at) = words.iter().position(|word| word.code == ix) else { return true };
        let before = words.get(..at).unwrap_or_default();
        let behind = words.get(at + 1..).unwrap_or_default();
        let start = place.block().range.start;
        let from = before.last().map_or(start, |word| word.range().end) - start;
        let to = words.get(at).map_or(start, |word| word.range().start) - start;
        let text = self.block_text(place, place.block()).get(from as usize..to as usize).unwrap_or_default();
        let text = text.trim_ascii();
        before.iter().all(|word| word.letter == Letter::of('N'))
            && behind.iter().all(|word| word.code != ix)
            && (text.is_empty() || text == b"/")
    }

    fn contract_of(&self, ix: CodeIx) -> Option<&CodeContract> {
        self.model.contracts.get(ix.index())
    }

    fn any_reads_all(&self) -> bool {
        self.words.codes().iter().any(|ix| self.contract_of(*ix).is_some_and(|contract| contract.reads_all))
    }

    fn check_repeated(&self, words: &[Word]) -> Step {
        let mut seen = LetterSet::EMPTY;
        let control = self.model.control();
        for word in words {
            let repeats = !seen.insert(word.letter);
            if repeats && !control.letter(word.letter).is_some_and(|entry| entry.repeatable) {
                return Err(Fault::WordTwice(word.letter));
            }
        }
        Ok(())
    }

    /// Codes against each other.
    fn check_codes(&self, place: &Place, words: &[Word]) -> Step {
        let rules = &self.model.contract;
        let codes = self.words.codes();
        let mut m_codes = 0;
        for (index, ix) in codes.iter().enumerate() {
            let (Some(code), Some(contract)) = (self.model.code(*ix), self.contract_of(*ix)) else {
                continue;
            };
            m_codes += usize::from(contract.is_m);
            if contract.first_only && !self.opens_block(place, words, *ix) {
                return Err(Fault::UnknownCode);
            }
            if code.effect == Effect::UserCommand && self.machine.fresh && rules.strict {
                // A program in the machine's folder, and nobody said that it is there.
                return Err(Fault::UnknownCode);
            }
            for (other_index, other) in codes.iter().enumerate() {
                if other_index == index {
                    continue;
                }
                let Some(other_code) = self.model.code(*other) else { continue };
                let same_group = contract.exclusive && other_code.group == code.group;
                let cancels = code.effect == Effect::CycleCancel;
                let refused = if other == ix { rules.code_twice && !cancels } else { rules.two_of_a_group };
                if same_group && refused || contract.excludes(*other, other_code.group) {
                    return Err(Fault::Conflict);
                }
            }
        }
        if rules.strict && m_codes > rules.m_codes {
            return Err(Fault::TooManyCodes);
        }
        Ok(())
    }

    /// Axes that a machine has only when somebody says so.
    fn check_axes(&self) -> Step {
        let rules = &self.model.contract;
        let absent = self.words.present().and(rules.absent_axes);
        match absent.iter().next() {
            Some(letter) if self.machine.fresh && self.machine.axes.is_none() => {
                Err(Fault::NoSuchAxis(letter))
            }
            _ => Ok(()),
        }
    }

    /// A spindle that the machine has, where the word that chooses one is read; -1 means all of them.
    pub(super) fn check_spindle(&self) -> Step {
        let Some(number) = self.words.number(Letter::DOLLAR) else { return Ok(()) };
        if !self.refuses_incomplete() || self.leaves_to_rules() || !self.machine.fresh {
            return Ok(());
        }
        let setting = self.model.semantics().refusals.spindles.as_ref();
        let told = setting.and_then(|setting| self.machine.setting(self.model.control(), setting));
        let is_had = |spindles: f64| number > -2.0 && number < spindles;
        match told.and_then(|told| told.parse().ok()) {
            Some(spindles) if !is_had(spindles) => Err(Fault::WordRange(Letter::DOLLAR)),
            _ => Ok(()),
        }
    }

    fn check_range(&self, range: &ValueRange) -> Step {
        match self.words.number(range.letter) {
            Some(value) if !range.takes(value) => Err(Fault::WordRange(range.letter)),
            _ => Ok(()),
        }
    }

    /// The motion that the block's words belong to.
    fn acting_motion(&self, state: &State<D>) -> Acting {
        let mut cancels = false;
        let mut takes_axes = false;
        for ix in self.words.codes() {
            let Some(code) = self.model.code(*ix) else { continue };
            match code.role {
                Some(Role::Cycle) if code.effect == Effect::CycleCancel => cancels = true,
                Some(Role::Motion | Role::Cycle) => return Acting::Named(*ix),
                _ => {}
            }
            let reads_all = self.contract_of(*ix).is_some_and(|contract| contract.reads_all);
            takes_axes |= code.takes_axes || code.effect.owns_axes() || reads_all;
        }
        let present = self.words.present();
        if takes_axes || cancels {
            return Acting::Nothing;
        }
        let named = present.intersects(self.model.axis_letters) || present.intersects(POLAR);
        if !named && !self.turns_about_centre(state) {
            return Acting::Nothing;
        }
        match state.active_cycle(self.model) {
            Some(cycle) if cycle.is_some() => return Acting::InEffect(cycle),
            _ => {}
        }
        state.mode(Role::Motion).only().filter(|ix| ix.is_some()).map_or(Acting::Nothing, Acting::InEffect)
    }

    /// A centre without an end, while arcs are the mode: a full circle (Haas NGC mill manual 2017, p. 251; observed on
    /// LinuxCNC). On controls that are not strict, a code of the block may read the words for itself.
    pub(super) fn turns_about_centre(&self, state: &State<D>) -> bool {
        (self.model.contract.strict || self.words.codes().is_empty())
            && self.words.present().intersects(const { LetterSet::of("IJK") })
            && state.active_cycle(self.model).is_some_and(|cycle| !cycle.is_some())
            && state.mode(Role::Motion).only().is_some_and(|ix| self.model.effect(ix).is_arc())
    }

    /// Every word is read by a code of the block, or by the motion.
    fn check_all_read(&self, acting: Acting) -> Step {
        let rules = &self.model.contract;
        let present = self.words.present();
        let mut unread = present.and(rules.bound);
        for ix in self.words.codes().iter().copied().chain(acting.code()) {
            let Some(contract) = self.contract_of(ix) else { continue };
            if contract.reads_all {
                return Ok(());
            }
            unread = unread.without(contract.reads);
        }
        let is_beside = |letter: &Letter| {
            rules.beside.iter().any(|(other, with)| other == letter && present.intersects(*with))
        };
        match unread.iter().find(|letter| !is_beside(letter)) {
            Some(letter) => Err(Fault::UnreadWord(letter)),
            None => Ok(()),
        }
    }

    /// Axis words need a motion, and some motions cannot have some words.
    fn check_motion(&self, acting: Acting, state: &State<D>) -> Step {
        let present = self.words.present();
        let codes = self.words.codes();
        let has = |effect: Effect| codes.iter().any(|ix| self.model.effect(*ix) == effect);
        let polar = present.intersects(POLAR);
        let mut taken = false;
        for ix in codes {
            let Some(code) = self.model.code(*ix) else { continue };
            let reads_all = self.contract_of(*ix).is_some_and(|contract| contract.reads_all);
            taken |= code.takes_axes || code.effect.owns_axes() || reads_all;
        }
        if acting == Acting::Nothing {
            if (polar || present.intersects(self.model.axis_letters)) && !taken {
                return Err(Fault::NoMotionMode);
            }
            if polar {
                return Err(Fault::Conflict);
            }
        }
        self.check_polar(state)?;
        if has(Effect::MachineCoordinates) {
            if !acting.code().is_some_and(|motion| self.moves_to_machine_point(motion)) {
                return Err(Fault::NoMotionMode);
            }
            let incremental = if has(Effect::Absolute) {
                false
            } else {
                has(Effect::Incremental) || state.is_incremental(self.model) == Some(true)
            };
            if incremental {
                return Err(Fault::Conflict);
            }
        }
        let role = acting.code().and_then(|ix| self.model.role(ix));
        if role == Some(Role::Cycle) && present.intersects(LetterSet::of("ABC")) {
            return Err(Fault::Cycle(CycleFault::Rotary));
        }
        Ok(())
    }

    /// Words of a radius and an angle are in the place of X and Y, and in their plane; the plane that the block itself chooses is
    /// not in effect yet.
    fn check_polar(&self, state: &State<D>) -> Step {
        let present = self.words.present();
        if !present.intersects(POLAR) {
            return Ok(());
        }
        let is_elsewhere = || state.plane(self.model).is_some_and(|plane| plane != Plane::Xy);
        if present.intersects(LetterSet::of("XY")) || is_elsewhere() { Err(Fault::Conflict) } else { Ok(()) }
    }

    /// What each code, and the motion, says of its words.
    fn check_words(&self, acting: Acting) -> Step {
        let in_effect = match acting {
            Acting::InEffect(ix) => Some(ix),
            _ => None,
        };
        for ix in self.words.codes().iter().copied().chain(in_effect) {
            let Some(contract) = self.contract_of(ix) else { continue };
            self.check_words_of(ix, contract)?;
            if self.model.effect(ix) == Effect::WriteOffsets {
                self.check_write_offsets()?;
            }
        }
        Ok(())
    }

    fn check_words_of(&self, ix: CodeIx, contract: &CodeContract) -> Step {
        let present = self.words.present();
        // An alternative of axis words is what people miss first.
        for set in &contract.one_of {
            if !present.intersects(*set) {
                let missing = set.iter().next().unwrap_or(Letter::of('X'));
                let moves = set.intersects(self.model.axis_letters);
                return Err(if moves { Fault::NoAxisWords } else { Fault::MissingWord(missing) });
            }
        }
        if let Some(missing) = contract.required.without(present).iter().next() {
            let dwells = self.model.effect(ix) == Effect::Dwell;
            return Err(if dwells { Fault::NoDwellTime } else { Fault::MissingWord(missing) });
        }
        for sets in &contract.apart {
            if sets.iter().filter(|set| present.intersects(**set)).count() > 1 {
                return Err(Fault::Conflict);
            }
        }
        if let Some(letter) = present.and(contract.forbidden).iter().next() {
            return Err(Fault::UnreadWord(letter));
        }
        contract.ranges.iter().try_for_each(|range| self.check_range(range))
    }
}
