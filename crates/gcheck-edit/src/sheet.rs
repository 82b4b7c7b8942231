//! The edits of a program while they are made, and the text and numbers of its words.
//!
//! Knows: text, how a control counts numbers without a point. Must not know: why words change.

use std::ops::Range;

use gcheck_controls::{Effect, Letter, Unpointed};
use gcheck_diagnostics::Edit;
use gcheck_engine::{Look, Machine, Model, Program, Units};
use gcheck_program::{Loaded, Place, Value, Word};

use crate::number::Hand;
use crate::refusal::Refusal;

/// Relative change of a number by rounding that nobody notices.
const ROUNDING: f64 = 5e-4;

/// The edits of a program.
pub(crate) struct Sheet<'a, 'p> {
    pub(crate) loaded: &'a Loaded<'p>,
    pub(crate) model: &'a Model<'a>,
    pub(crate) hand: Hand,
    look: Look<'a, 'p>,
    edits: Vec<Edit>,
}

impl<'a, 'p> Sheet<'a, 'p> {
    pub(crate) fn new(
        program: &'a Program<'p>,
        loaded: &'a Loaded<'p>,
        model: &'a Model<'a>,
        machine: &'a Machine,
    ) -> Self {
        let hand = Hand::of(loaded, program.dialect());
        Self { loaded, model, hand, look: Look::new(program, model, machine), edits: Vec::new() }
    }

    /// The edits in the order of the text.
    pub(crate) fn into_edits(mut self) -> Vec<Edit> {
        self.edits.sort_by_key(|edit| (edit.range.start, edit.range.end));
        self.edits
    }

    pub(crate) fn replace(&mut self, range: Range<u32>, text: String) {
        if self.loaded.slice(range.clone()) != text {
            self.edits.push(Edit { range, text });
        }
    }

    /// Takes out bytes that may be of many blocks.
    pub(crate) fn remove(&mut self, range: Range<u32>) {
        self.edits.push(Edit { range, text: String::new() });
    }

    /// The line end of the program.
    pub(crate) fn line_end(&self) -> &'static str {
        if self.loaded.chunk_text(0).contains("\r\n") { "\r\n" } else { "\n" }
    }

    pub(crate) fn insert(&mut self, at: u32, text: String) {
        self.edits.push(Edit { range: at..at, text });
    }

    /// Bytes of the file of a word.
    pub(crate) fn range(place: &Place, word: &Word) -> Range<u32> {
        place.base + word.range().start..place.base + word.range().end
    }

    /// The text of a word's value, and its bytes of the file.
    pub(crate) fn value(&self, place: &Place, word: &Word) -> (Range<u32>, &str) {
        let range = Self::range(place, word);
        let text = self.loaded.slice(range.clone());
        // One letter is the address: a function may come after it.
        let after = text.trim_start_matches(|c: char| c == ',' || c.is_whitespace());
        let value = after.get(1..).unwrap_or_default().trim_start();
        let start = range.end - value.len() as u32;
        (start..range.end, self.loaded.slice(start..range.end))
    }

    /// How much one counts that is written on an address without a point.
    pub(crate) fn count(&mut self, letter: Letter, units: Option<Units>) -> f64 {
        self.look.counted(letter, 1.0, units)
    }

    /// Decimals that the control resolves in lengths. One that reads all digits gets as many as the program has, and those that
    /// make an inch as fine as a millimetre.
    pub(crate) fn decimals(&self, units: Option<Units>) -> usize {
        let least = self.least(units);
        if !self.reads_all_digits() {
            return least;
        }
        let fine = if units == Some(Units::Inch) { least + 1 } else { least };
        fine.max(self.hand.decimals())
    }

    /// Decimals of a length that was in other units.
    fn decimals_from(&self, from: Option<Units>, to: Units) -> usize {
        let own = self.hand.decimals().saturating_sub(self.least(from));
        let fine = usize::from(to == Units::Inch);
        self.least(Some(to)) + if self.reads_all_digits() { own.max(fine) } else { 0 }
    }

    fn reads_all_digits(&self) -> bool {
        self.model.control().numbers().unpointed == Unpointed::AsWritten
    }

    /// Decimals of the least increment.
    fn least(&self, units: Option<Units>) -> usize {
        let numbers = self.model.control().numbers();
        let least = if units == Some(Units::Inch) { numbers.least_inch } else { numbers.least_mm };
        #[expect(clippy::cast_sign_loss, reason = "clamped")]
        let decimals = (-least.log10()).round().clamp(0.0, 6.0) as usize;
        decimals
    }

    /// A code with an effect, in the form of an old one: `G02` becomes `G03`.
    pub(crate) fn code(&self, place: &Place, word: &Word, effect: Effect) -> Option<String> {
        let name = self.name_of(effect)?;
        let (letter, digits) = name.split_at_checked(1)?;
        let old = self.loaded.slice(Self::range(place, word));
        let (_, old_digits) = self.value(place, word);
        let is_small = old.starts_with(|c: char| c.is_ascii_lowercase());
        let letter = if is_small { letter.to_ascii_lowercase() } else { letter.to_owned() };
        let has_zero = old_digits.len() > 1 && old_digits.starts_with('0') && digits.len() == 1;
        Some(format!("{letter}{}{digits}", if has_zero { "0" } else { "" }))
    }

    /// The first code with an effect, written with a zero in front where the program does that.
    pub(crate) fn spelled(&self, effect: Effect) -> Option<String> {
        let name = self.name_of(effect)?;
        let is_short = name.len() == 2 && self.hand.zeros();
        Some(if is_short { name.replacen('G', "G0", 1) } else { name })
    }

    /// The name of the first code with an effect.
    pub(crate) fn name_of(&self, effect: Effect) -> Option<String> {
        let code = self.model.control().codes().find(|code| code.effect() == effect)?;
        Some(code.number().to_string())
    }

    /// The value of a word times `factor` in other units, with as many decimals as these have on the control.
    ///
    /// # Errors
    /// The reason why it cannot be written so.
    pub(crate) fn converted(
        &mut self,
        place: &Place,
        word: &Word,
        from: Option<Units>,
        to: Units,
        factor: f64,
    ) -> Result<String, Refusal> {
        let decimals = self.decimals_from(from, to);
        let count = if word.shape.point { 1.0 } else { self.count(word.letter, from) };
        match word.value {
            Value::Number(number) => {
                let is_counted = (count - 1.0).abs() > 1e-12;
                let is_rate = matches!(word.letter.ascii(), b'F' | b'S');
                let has_point = word.shape.point || is_counted;
                let value = number * count * factor;
                let form = if has_point && !is_rate {
                    self.hand.padded(decimals)
                } else if has_point {
                    "1.".to_owned()
                } else {
                    "1".to_owned()
                };
                let decimals = match word.letter.ascii() {
                    b'S' if !word.shape.point => 0,
                    b'F' if value.abs() < 1.0 => decimals + 2,
                    _ => decimals,
                };
                Ok(self.hand.write(&form, value, decimals))
            }
            Value::Expr(_) => {
                let (_, text) = self.value(place, word);
                let is_division = factor < 1.0 && (factor * 25.4 - 1.0).abs() < 1e-9;
                let text = if is_one_group(text) || is_variable(text) {
                    text.to_owned()
                } else {
                    format!("[{text}]")
                };
                Ok(if is_division {
                    format!("[{text}/25.4]")
                } else {
                    format!("[{text}*{}]", self.hand.write("1.", factor, 6))
                })
            }
            Value::Missing => Err(Refusal::at(Self::range(place, word), "this word has no value")),
        }
    }

    /// A length that counts least increments, times `factor` in other units: the nearest whole number of those; `None` where
    /// that is none.
    pub(crate) fn increments(
        &self,
        number: f64,
        from: Option<Units>,
        to: Units,
        factor: f64,
    ) -> Option<String> {
        let least = |units: Units| self.model.control().numbers().least(units == Units::Inch);
        let count = (number * factor * from.map_or(1.0, least) / least(to)).round();
        (count != 0.0).then(|| self.hand.write("1", count, 0))
    }

    /// The value of a word times `factor` and more by `offset`, both in units of the program, in the form that it has.
    ///
    /// # Errors
    /// The reason why it cannot be written so.
    pub(crate) fn rewritten(
        &mut self,
        place: &Place,
        word: &Word,
        units: Option<Units>,
        factor: f64,
        offset: f64,
        decimals: usize,
    ) -> Result<String, Refusal> {
        let count = if word.shape.point { 1.0 } else { self.count(word.letter, units) };
        let (range, text) = self.value(place, word);
        match word.value {
            Value::Number(number) => {
                let value = number * count * factor + offset;
                let counts = (count - 1.0).abs() > 1e-12;
                if counts && number == 0.0 {
                    // Zero is zero whatever it counts; the new number says itself what it counts.
                    let form = self.hand.padded(decimals);
                    return Ok(if value == 0.0 {
                        text.to_owned()
                    } else {
                        self.hand.write(&form, value, decimals)
                    });
                }
                if counts {
                    // It counts least increments, and has no point.
                    let counts = value / count;
                    if (counts - counts.round()).abs() > 1e-3 {
                        let reason = "the new value is not a whole number of the least increments that this word counts";
                        return Err(Refusal::at(range, reason).help("write the number with a decimal point"));
                    }
                    return Ok(self.hand.write(text, counts.round(), 0));
                }
                Ok(self.hand.write(text, value, decimals))
            }
            Value::Expr(_) => Ok(self.computed(text, factor, offset, decimals)),
            Value::Missing => Err(Refusal::at(range, "this word has no value")),
        }
    }

    /// An expression times a factor and more by an offset.
    fn computed(&self, text: &str, factor: f64, offset: f64, decimals: usize) -> String {
        let plain = |value: f64| self.hand.write("1.", value, decimals.max(4));
        let is_grouped = is_one_group(text) || is_variable(text);
        let inner = if is_grouped { text.to_owned() } else { format!("[{text}]") };
        let is = |value: f64, other: f64| (value - other).abs() < 1e-12;
        match (is(factor, 1.0), is(factor, -1.0), is(offset, 0.0)) {
            (true, _, true) => text.to_owned(),
            (true, _, false) => {
                let sign = if offset < 0.0 { '-' } else { '+' };
                format!("[{inner}{sign}{}]", plain(offset.abs()))
            }
            // Some controls take no sign in front of a bracket.
            (_, true, _) => format!("[{}-{inner}]", plain(offset)),
            (_, _, true) => format!("[{inner}*{}]", plain(factor)),
            _ => format!("[{inner}*{}+{}]", plain(factor), plain(offset)),
        }
    }

    /// A rate times a factor, in the form that it has.
    ///
    /// # Errors
    /// The number cannot be written as exactly as it is proved.
    pub(crate) fn rate(
        &mut self,
        place: &Place,
        word: &Word,
        units: Option<Units>,
        factor: f64,
        decimals: usize,
    ) -> Result<String, Refusal> {
        let text = self.rewritten(place, word, units, factor, 0.0, decimals)?;
        if let Value::Number(number) = word.value {
            let wanted = number * factor;
            let written: f64 = text.parse().unwrap_or(f64::NAN);
            if wanted != 0.0 && ((written - wanted) / wanted).abs() > ROUNDING {
                let (range, _) = self.value(place, word);
                let reason = format!(
                    "the new value is {wanted:.4}, and rounded to the digits that can be written it is {written}"
                );
                return Err(Refusal::at(range, reason).help("choose another factor"));
            }
        }
        Ok(text)
    }

    /// Writes a code in front of the words of a block, after its number.
    pub(crate) fn prepend(&mut self, place: &Place, text: &str) {
        let words = place.table.words(place.block());
        let Some(first) = words.iter().find(|word| !matches!(word.letter.ascii(), b'N' | b'O')) else {
            return;
        };
        let at = place.base + first.range().start;
        self.edits.push(Edit { range: at..at, text: format!("{text}{}", self.hand.gap()) });
    }

    /// Writes words after the last word of a block.
    pub(crate) fn append(&mut self, place: &Place, text: &str) {
        let words = place.table.words(place.block());
        let Some(last) = words.iter().map(|word| word.range().end).max() else { return };
        let at = place.base + last;
        self.edits.push(Edit { range: at..at, text: format!("{}{text}", self.hand.gap()) });
    }
}

/// `#12`, `#<name>`: one operand.
fn is_variable(text: &str) -> bool {
    let Some(rest) = text.strip_prefix('#') else { return false };
    rest.bytes().all(|byte| byte.is_ascii_digit())
        || rest.starts_with('<') && rest.find('>') == Some(rest.len() - 1)
}

/// `[…]` whose first bracket closes at its end.
fn is_one_group(text: &str) -> bool {
    let mut depth = 0_u32;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'[' => depth += 1,
            b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return at + 1 == text.len() && text.starts_with('[');
        }
    }
    false
}
