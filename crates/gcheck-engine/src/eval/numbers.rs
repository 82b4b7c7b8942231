//! The numbers of a block, as the control counts them.
//!
//! Knows: units, decimal points that are missing, counts and how they are rounded. Must not know: what a code does with a number.

use gcheck_controls::{CodeIx, Effect, Letter, Unpointed, WordKind};
use gcheck_program::{BinaryOp, BlockTable, Function, Place, Value, Word};

use crate::assumption::{Assumption, Assumptions};
use crate::eval::value::{Domain, Truth};
use crate::event::Units;
use crate::exec::context::{Count, Executor, Step};
use crate::fault::Fault;
use crate::lattice::Lattice;
use crate::machine::Machine;
use crate::model::Model;
use crate::observer::Observer;
use crate::state::State;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    pub(crate) fn read_words(
        &mut self,
        place: &Place,
        table: &BlockTable,
        words: &[Word],
        state: &mut State<D>,
    ) -> Step {
        self.words.clear();
        // Looked for once, however long the block is.
        let mut units = None;
        let m_is_argument = self.model.semantics().m_is_argument;
        let mut takes_m = false;
        for word in words {
            if word.code.is_some() {
                self.words.put_code(word.code);
                takes_m |= m_is_argument && self.is_macro_call(word.code);
                continue;
            }
            let code_letter = match word.letter.ascii() {
                b'G' => !word.letter.is_corner(),
                b'M' => !takes_m,
                _ => false,
            };
            match word.value {
                Value::Number(number) if code_letter => {
                    if !self.model.control().may_be_of_builder(word.letter, number) {
                        self.refuse(Fault::UnknownCode)?;
                    }
                }
                Value::Number(number) => {
                    let pointed = word.shape.point;
                    let number = if pointed || number == 0.0 || self.is_count(word.letter, words) {
                        number
                    } else {
                        let units = match self.unpointed_of(word.letter) {
                            Unpointed::LeastIncrement => {
                                *units.get_or_insert_with(|| self.units_of_block(words, state))
                            }
                            _ => None,
                        };
                        self.scale(word.letter, number, units)
                    };
                    self.words.put_number(word.letter, number, pointed);
                }
                Value::Expr(expr) => {
                    let value = self.evaluate(place, table, table.expr(expr), state)?;
                    if code_letter {
                        // An empty variable takes the word out.
                        if D::is_vacant(&value) != Truth::True {
                            self.computed_code(word.letter, &value)?;
                        }
                        continue;
                    }
                    match D::is_vacant(&value) {
                        Truth::True => {}
                        Truth::False | Truth::Unknown => {
                            let value = self.as_resolved(word.letter, value, words, state);
                            let pointed = self.model.semantics().computed_words_are_pointed;
                            self.words.put(word.letter, value, pointed);
                        }
                    }
                }
                Value::Missing => {
                    self.refuse(Fault::MissingValue(word.letter))?;
                    self.words.put(word.letter, D::unknown(), true);
                }
            }
        }
        Ok(())
    }

    pub(crate) fn is_macro_call(&self, code: CodeIx) -> bool {
        self.model.effect(code).calls_macro()
    }

    /// A computed value as the control reads it: rounded to a whole number, or to the last digit of its lengths and angles, on
    /// controls that do so.
    pub(crate) fn as_resolved(
        &self,
        letter: Letter,
        value: D::Value,
        words: &[Word],
        state: &State<D>,
    ) -> D::Value {
        let semantics = self.model.semantics();
        if !(semantics.computed_counts_round || semantics.computed_lengths_round)
            || D::is_vacant(&value) != Truth::False
        {
            return value;
        }
        let numbers = self.model.control().numbers();
        match self.kind_read(letter, words) {
            Some(WordKind::Integer | WordKind::LeastIncrements) if semantics.computed_counts_round => {
                self.to_multiple(value, 1.0)
            }
            Some(WordKind::Angle) if semantics.computed_lengths_round => {
                self.to_multiple(value, numbers.least_angle)
            }
            Some(WordKind::Length) if semantics.computed_lengths_round => {
                match self.units_of_block(words, state) {
                    Some(Units::Inch) => self.to_multiple(value, numbers.least_inch),
                    Some(Units::Mm) => self.to_multiple(value, numbers.least_mm),
                    // A run goes on with the value; an analysis has every way that the control may read it.
                    None if self.lenient => {
                        let inch = self.to_multiple(value.clone(), numbers.least_inch);
                        let mm = self.to_multiple(value.clone(), numbers.least_mm);
                        value.join(&inch).join(&mm)
                    }
                    None => value,
                }
            }
            _ => value,
        }
    }

    /// What a word means beside the codes of its block; `None` where it is an argument of a macro, which is any number.
    pub(crate) fn kind_read(&self, letter: Letter, words: &[Word]) -> Option<WordKind> {
        let control = self.model.control();
        let mut kind = None;
        for code in words.iter().filter_map(|word| control.code_at(word.code)) {
            if code.entry().any_words {
                return None;
            }
            let mut entries = code.entry().words.iter();
            let entry = entries.find(|entry| Letter::parse(&entry.letter) == Some(letter));
            kind = kind.or(entry.map(|entry| entry.kind));
        }
        kind.or_else(|| control.letter(letter).map(|entry| entry.kind))
    }

    /// The multiple of a step that is nearest to a value.
    pub(crate) fn to_multiple(&self, value: D::Value, step: f64) -> D::Value {
        let semantics = self.model.semantics();
        // Divided by a power of ten rather than multiplied: .1235, not .12350000000000001.
        let steps = D::number((1.0 / step).round());
        let rounded = D::binary(BinaryOp::Multiply, &value, &steps, semantics)
            .and_then(|value| D::call(Function::Round, std::slice::from_ref(&value), semantics))
            .and_then(|value| D::binary(BinaryOp::Divide, &value, &steps, semantics));
        rounded.unwrap_or(value)
    }

    /// `G#700`: the code that a value names.
    pub(crate) fn computed_code(&mut self, letter: Letter, value: &D::Value) -> Step {
        let Some(number) = D::known(value) else { return Err(Fault::Undecidable) };
        match self.model.code_of_value(letter, number) {
            Some(ix) => self.words.put_code(ix),
            None if self.model.control().may_be_of_builder(letter, number) => {}
            None => return Err(Fault::UnknownCode),
        }
        Ok(())
    }

    /// A number without decimal point, as the control counts it.
    pub(crate) fn scale(&mut self, letter: Letter, number: f64, units: Option<Units>) -> f64 {
        let Some(kind) = self.model.scaled(letter) else { return number };
        if let Some(factor) = self.factor_of_setting(letter) {
            return number * factor;
        }
        if self.unpointed_is_open && self.model.scale_setting(letter).is_none() {
            self.assumptions.rest_on_unpointed();
        }
        match self.unpointed_of(letter) {
            Unpointed::AsWritten => number,
            Unpointed::LeastIncrement => {
                let least = match kind {
                    WordKind::Angle => self.model.control().numbers().least_angle,
                    _ => self.least_increment(units),
                };
                in_steps(number, least)
            }
            Unpointed::ByParameter => {
                self.assumptions.insert(Assumption::UnpointedNumbers);
                number
            }
        }
    }

    /// The least increment of lengths; NaN where the units are not known.
    pub(crate) fn least_increment(&self, units: Option<Units>) -> f64 {
        let numbers = self.model.control().numbers();
        match units {
            Some(Units::Inch) => numbers.least_inch,
            Some(Units::Mm) => numbers.least_mm,
            None => f64::NAN,
        }
    }

    /// How a number of an address without decimal point counts: some addresses follow another setting, or none.
    pub(crate) fn unpointed_of(&self, letter: Letter) -> Unpointed {
        match self.model.scale_setting(letter) {
            None => self.unpointed,
            Some(_) => self.model.unpointed(),
        }
    }

    /// What a setting of the address's own makes of a number without decimal point: `.01` of it, or the number itself.
    pub(crate) fn factor_of_setting(&self, letter: Letter) -> Option<f64> {
        let setting = self.model.scale_setting(letter)?;
        let value = self.machine.settings.get(setting.rsplit(' ').next()?)?;
        if value == "integer" { Some(1.0) } else { value.parse().ok() }
    }

    /// An argument of a macro call that is written without a decimal point, as the macro gets it.
    pub(crate) fn unpointed_argument(
        &mut self,
        letter: Letter,
        number: f64,
        whole: &str,
        units: Option<Units>,
    ) -> f64 {
        if number == 0.0 || whole.contains(char::from(letter.ascii())) {
            return number;
        }
        if self.unpointed_is_open {
            self.assumptions.rest_on_unpointed();
        }
        match self.unpointed {
            Unpointed::AsWritten => number,
            Unpointed::LeastIncrement => in_steps(number, self.least_increment(units)),
            Unpointed::ByParameter => {
                self.assumptions.insert(Assumption::UnpointedNumbers);
                number
            }
        }
    }

    /// The units in which a block's numbers count: those that it names itself, wherever they stand in it.
    pub(crate) fn units_of_block(&self, words: &[Word], state: &State<D>) -> Option<Units> {
        let named = words.iter().rev().find_map(|word| match self.model.effect(word.code) {
            Effect::Inch => Some(Units::Inch),
            Effect::Millimetre => Some(Units::Mm),
            _ => None,
        });
        named.or_else(|| state.units(self.model))
    }

    /// The length of a word in millimetres, or the angle of a rotary axis in degrees.
    pub(crate) fn length(&self, letter: Letter, state: &State<D>) -> Option<f64> {
        let number = self.words.number(letter)?;
        // Zero is zero in any unit.
        Some(if number == 0.0 { 0.0 } else { number * self.unit(state) })
    }

    /// Millimetres in a unit of the block; NaN when not known.
    pub(crate) fn unit(&self, state: &State<D>) -> f64 {
        if self.has_millimetre_distances() {
            return 1.0;
        }
        state.units(self.model).map_or(f64::NAN, Units::in_mm)
    }

    /// Are the axis words of the block distances from the present point? `None` when not known.
    pub(crate) fn is_incremental(&self, state: &State<D>) -> Option<bool> {
        // `G53` makes coordinates of them.
        if self.has_millimetre_distances() && !self.machine_coordinates {
            Some(true)
        } else {
            state.is_incremental(self.model)
        }
    }

    /// Does the block name a code whose words are millimetres and distances, whatever the modes?
    pub(crate) fn has_millimetre_distances(&self) -> bool {
        let is_it = |code: &CodeIx| self.model.code(*code).is_some_and(|code| code.millimetre_distances);
        self.model.has_millimetre_distances && self.words.codes().iter().any(is_it)
    }

    /// Is the address, elsewhere an angle that counts smallest steps, a count to a code of the block (`G43 H1` on a lathe)?
    pub(crate) fn is_count(&self, letter: Letter, words: &[Word]) -> bool {
        // Codes that the block computes are among those that it has so far.
        let mut codes = words.iter().map(|word| word.code).chain(self.words.codes().iter().copied());
        self.model.scaled(letter) == Some(WordKind::Angle)
            && codes.any(|ix| {
                self.model.contracts.get(ix.index()).is_some_and(|contract| contract.counts.contains(letter))
            })
    }

    /// A whole number not below zero; `None` when it does not stand, a fault when it is none.
    pub(crate) fn count(&self, letter: Letter) -> Step<Option<Count>> {
        self.words.number(letter).map(|number| Self::whole(letter, number)).transpose()
    }

    /// A number as a count.
    pub(crate) fn whole(letter: Letter, number: f64) -> Step<Count> {
        if number.is_nan() {
            return Ok(Count::Unknown);
        }
        let whole = number.round();
        if (whole - number).abs() > 1e-4 || whole < 0.0 || whole > f64::from(u32::MAX) {
            return Err(Fault::WordRange(letter));
        }
        #[expect(clippy::cast_sign_loss, reason = "range checked above")]
        Ok(Count::Known(whole as u32))
    }

    /// As [`Self::count`]; on strict controls, which do not mind decimals in some counts, rounded.
    pub(crate) fn rounded(&self, letter: Letter) -> Step<Option<Count>> {
        self.near_count(letter, f64::round)
    }

    /// As [`Self::rounded`], without its decimals.
    pub(crate) fn truncated(&self, letter: Letter) -> Step<Option<Count>> {
        self.near_count(letter, f64::trunc)
    }

    pub(crate) fn near_count(&self, letter: Letter, nearest: impl Fn(f64) -> f64) -> Step<Option<Count>> {
        match self.words.number(letter).map(nearest) {
            #[expect(clippy::cast_sign_loss, reason = "range checked in the pattern's guard")]
            Some(number) if self.refuses_incomplete() && (0.0..=f64::from(u32::MAX)).contains(&number) => {
                Ok(Some(Count::Known(number as u32)))
            }
            _ => self.count(letter),
        }
    }
}

/// How numbers without decimal point count on this machine.
pub(crate) fn settle_unpointed(
    model: &Model<'_>,
    machine: &Machine,
    assumptions: &mut Assumptions,
) -> Unpointed {
    let number = setting_of_unpointed(model);
    let setting = number.and_then(|number| Some((number, model.control().setting(number)?)));
    let Some((number, entry)) = setting else { return model.unpointed() };
    match machine.settings.get(number) {
        None => {
            if model.unpointed() == Unpointed::ByParameter {
                assumptions.insert(Assumption::Setting(number.to_owned()));
            }
            model.unpointed()
        }
        Some(value) if Some(value) == entry.as_written.as_ref() => Unpointed::AsWritten,
        Some(_) => Unpointed::LeastIncrement,
    }
}

/// Does a setting decide how numbers without decimal point count, and its value is not given?
pub(crate) fn is_unpointed_open(model: &Model<'_>, machine: &Machine) -> bool {
    setting_of_unpointed(model).is_some_and(|number| !machine.settings.contains_key(number))
}

/// The number of the setting that decides how numbers without decimal point count: `162` of "Setting 162".
fn setting_of_unpointed<'m>(model: &'m Model<'_>) -> Option<&'m str> {
    model.control().numbers().unpointed_setting.as_deref()?.rsplit(' ').next()
}

/// So many steps, as a number. Divided by a power of ten rather than multiplied: `X1500` is 1.5, not 1.5000000000000002.
pub(crate) fn in_steps(number: f64, least: f64) -> f64 {
    number / (1.0 / least).round()
}
