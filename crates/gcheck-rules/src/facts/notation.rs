//! How a file is written: of each thing that can be written in two ways, how often it is written so and where.
//!
//! Knows: the ways, how to count them. Must not know: which way is better, any rule. A file is counted once, when the first
//! rule of style asks; memory is bounded.

use std::ops::Range;

use crate::{BlockCx, FileCx, FileFact, ProgramText};
use crate::{Edit, Finding, Fix, RuleMeta};
use gcheck_controls::Unpointed;
use gcheck_program::{BlockFlags, Word};

/// A thing that programs write in two ways.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Question {
    /// `G1`, `G01`.
    ZeroInG,
    /// `M3`, `M03`.
    ZeroInM,
    /// `.5`, `0.5`.
    ZeroBeforePoint,
    /// `1.`, `1.0`.
    ZeroAfterPoint,
    /// `X1`, `X1.`, on controls that read both as one.
    Point,
    /// `X1`, `X+1`.
    PlusSign,
    /// `G1X1`, `G1 X1`.
    Blank,
    /// `g1`, `G1`, on controls that read both.
    Capital,
    /// Line feed, carriage return and line feed.
    LineEnd,
}

impl Question {
    const COUNT: usize = 9;
}

/// Places of one way that are kept, and that one fix changes; the rest is left to the next run.
pub(crate) const MAX_PLACES: usize = 100_000;

/// How one thing is written throughout a file.
#[derive(Debug, Default)]
pub(crate) struct Habit {
    ways: [Way; 2],
}

#[derive(Debug, Default)]
struct Way {
    count: usize,
    /// The first places, bytes of the file.
    places: Vec<Range<u32>>,
}

/// The way that a file seldom takes.
pub(crate) struct Odd<'h> {
    /// The long way is the odd one: with zero, point, blank, capital.
    pub(crate) is_long: bool,
    /// How often it is taken.
    pub(crate) count: usize,
    /// How often the other one is.
    pub(crate) usual: usize,
    /// Where.
    pub(crate) places: &'h [Range<u32>],
}

impl Habit {
    fn see(&mut self, is_long: bool, place: Range<u32>) {
        let [short, long] = &mut self.ways;
        let way = if is_long { long } else { short };
        way.count += 1;
        if way.places.len() < MAX_PLACES {
            way.places.push(place);
        }
    }

    /// The way that is taken less often; of two that are taken alike, the one that came later. `None` when all are one.
    pub(crate) fn odd(&self) -> Option<Odd<'_>> {
        let [short, long] = &self.ways;
        let start = |way: &Way| way.places.first().map(|place| place.start);
        let is_long = (long.count, start(short)) < (short.count, start(long));
        let (odd, usual) = if is_long { (long, short) } else { (short, long) };
        (odd.count > 0).then_some(Odd { is_long, count: odd.count, usual: usual.count, places: &odd.places })
    }
}

/// What is counted of a file.
#[derive(Debug, Default)]
pub(crate) struct Notation {
    habits: [Habit; Question::COUNT],
}

impl FileFact for Notation {
    fn of(cx: &FileCx<'_>) -> Self {
        let mut this = Self::default();
        let axes = cx.control().axes();
        let points_mean_nothing = cx.control().numbers().unpointed == Unpointed::AsWritten;
        let line_length = cx.control().limits().line_length.map_or(usize::MAX, |length| length as usize);
        let any_case = cx.control().syntax().lower_case;
        cx.each_block(|block| {
            let words = block.words();
            // What is code is uncertain in a block with a mistake in form; a line that is nearly as long as the control reads
            // must not grow.
            let range = &block.block().range;
            let is_long = (range.end - range.start) as usize + 2 * words.len() > line_length;
            if is_long || block.block().flags.contains(BlockFlags::ERROR) {
                return;
            }
            for word in words {
                this.code(block, word);
                this.number(block, word);
                if points_mean_nothing && axes.contains(word.letter) && block.words_are_plain() {
                    this.point(block, word);
                }
                // `:1234` is an `O` without its letter.
                let letter = block.text(word).chars().next().filter(char::is_ascii_alphabetic);
                if let Some(letter) = letter.filter(|_| any_case) {
                    let start = block.range(word).start;
                    this.see(Question::Capital, letter.is_ascii_uppercase(), start..start + 1);
                }
            }
            let simple = BlockFlags::STATEMENT | BlockFlags::EXPRESSION;
            if !block.block().flags.intersects(simple) {
                this.blanks(block, words);
            }
        });
        for (base, run) in cx.runs() {
            this.line_ends(base, run);
        }
        this
    }
}

impl Notation {
    /// How a file does one thing.
    pub(crate) fn habit(&self, question: Question) -> &Habit {
        static NONE: Habit = Habit { ways: [const { Way { count: 0, places: Vec::new() } }; 2] };
        self.habits.get(question as usize).unwrap_or(&NONE)
    }

    fn see(&mut self, question: Question, is_long: bool, place: Range<u32>) {
        if let Some(habit) = self.habits.get_mut(question as usize) {
            habit.see(is_long, place);
        }
    }

    /// `G1` or `G01`: the place is that of the zero.
    fn code(&mut self, block: &BlockCx<'_>, word: &Word) {
        let question = match word.letter.ascii() {
            b'G' => Question::ZeroInG,
            b'M' => Question::ZeroInM,
            _ => return,
        };
        let start = block.range(word).start + 1;
        match block.text(word).as_bytes() {
            [_, b'0'..=b'9'] => self.see(question, false, start..start),
            [_, b'0', b'0'..=b'9'] => self.see(question, true, start..start + 1),
            _ => {}
        }
    }

    fn number(&mut self, block: &BlockCx<'_>, word: &Word) {
        let Some(value) = word.number() else { return };
        let text = block.text(word);
        if matches!(word.letter.ascii(), b'G' | b'M' | b'N' | b'O') || text.contains([' ', '\t']) {
            return;
        }
        let start = block.range(word).start;
        let at = |offset: usize| start + offset as u32;
        let digits = text.find(|c: char| c.is_ascii_digit() || c == '.').unwrap_or(text.len());
        let signs = text.get(..digits).unwrap_or_default();
        if let Some(plus) = signs.find('+') {
            self.see(Question::PlusSign, true, at(plus)..at(plus + 1));
        } else if value > 0.0 && !signs.contains('-') {
            self.see(Question::PlusSign, false, at(digits)..at(digits));
        }
        let Some(point) = text.find('.') else { return };
        let (whole, decimals) =
            (text.get(digits..point).unwrap_or_default(), text.get(point + 1..).unwrap_or_default());
        if value != 0.0 {
            match whole {
                "" => self.see(Question::ZeroBeforePoint, false, at(point)..at(point)),
                "0" => self.see(Question::ZeroBeforePoint, true, at(digits)..at(point)),
                _ => {}
            }
        }
        if whole.is_empty() {
            return;
        }
        let max_digits = block.control().numbers().max_digits.map_or(u32::MAX, u32::from);
        if decimals.is_empty() && word.shape.digits() < max_digits {
            self.see(Question::ZeroAfterPoint, false, at(text.len())..at(text.len()));
        } else if !decimals.is_empty() && decimals.bytes().all(|digit| digit == b'0') {
            self.see(Question::ZeroAfterPoint, true, at(point + 1)..at(text.len()));
        }
    }

    /// `X1` or `X1.`: the place is that of the point.
    fn point(&mut self, block: &BlockCx<'_>, word: &Word) {
        let text = block.text(word);
        let end = block.range(word).end;
        if word.number().is_none() || text.contains([' ', '\t']) {
            return;
        }
        if text.ends_with('.') {
            self.see(Question::Point, true, end - 1..end);
        } else if !word.shape.point {
            self.see(Question::Point, false, end..end);
        }
    }

    /// The places between words that follow each other.
    fn blanks(&mut self, block: &BlockCx<'_>, words: &[Word]) {
        for pair in words.windows(2) {
            let [before, behind] = pair else { continue };
            let between = block.range(before).end..block.range(behind).start;
            if between.start > between.end {
                continue;
            }
            let text = block.slice(before.range().end..behind.range().start);
            if text.bytes().all(|byte| matches!(byte, b' ' | b'\t')) {
                self.see(Question::Blank, !text.is_empty(), between);
            }
        }
    }

    fn line_ends(&mut self, base: u32, text: &str) {
        for at in memchr::memchr_iter(b'\n', text.as_bytes()) {
            let has_return = at > 0 && text.as_bytes().get(at - 1) == Some(&b'\r');
            let at = base + at as u32;
            self.see(Question::LineEnd, has_return, if has_return { at - 1..at } else { at..at });
        }
    }
}

/// A count with its noun.
fn count(number: usize, one: &str, many: &str) -> String {
    if number == 1 { format!("{number} {one}") } else { format!("{number} {many}") }
}

impl Odd<'_> {
    /// One finding for the file, at the first odd place, with the fix that makes all of them like the others.
    pub(crate) fn finding(
        &self,
        rule: &'static RuleMeta,
        place: Range<u32>,
        message: String,
        written: impl Fn(&Range<u32>) -> String,
    ) -> Finding {
        let edits = self.places.iter().map(|range| Edit { range: range.clone(), text: written(range) });
        let title = match self.count {
            1 => "write it as the others".to_owned(),
            count => format!("write all {count} as the others"),
        };
        Finding::new(rule, place, message)
            .label(format!(
                "the first of {}; the other way {}",
                self.count,
                count(self.usual, "time", "times")
            ))
            .fix(Fix { title, safe: true, edits: edits.collect() })
    }
}

/// The word around a place, with its bytes, for messages.
pub(crate) fn word_around<'t>(text: &ProgramText<'t>, place: &Range<u32>) -> (Range<u32>, &'t str) {
    let (base, text) = text.around(place.start);
    let place = place.start - base..place.end - base;
    let is_word = |c: &char| c.is_ascii_alphanumeric() || matches!(c, '.' | '+' | '-');
    let before = text.get(..place.start as usize).unwrap_or_default();
    let mut start = place.start as usize;
    // Where the place begins with an address, the word does.
    let is_head =
        text.get(start..place.end as usize).is_some_and(|t| t.starts_with(|c: char| c.is_ascii_alphabetic()));
    let before = if is_head { "" } else { before };
    for c in before.chars().rev().take(32).take_while(is_word) {
        start -= c.len_utf8();
        if c.is_ascii_alphabetic() {
            break;
        }
    }
    let behind = text.get(place.end as usize..).unwrap_or_default();
    let number = |c: &char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-');
    let end = place.end as usize + behind.chars().take(32).take_while(number).count();
    (base + start as u32..base + end as u32, text.get(start..end).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::{Habit, word_around};
    use crate::ProgramText;

    #[test]
    fn the_rarer_way_is_odd_and_the_later_one_of_two_alike() {
        let mut habit = Habit::default();
        assert!(habit.odd().is_none());
        habit.see(true, 0..1);
        assert!(habit.odd().is_none(), "all are one");
        habit.see(false, 5..5);
        assert!(!habit.odd().unwrap().is_long, "the first way was the long one");
        habit.see(false, 9..9);
        let odd = habit.odd().unwrap();
        assert_eq!((odd.is_long, odd.count, odd.usual), (true, 1, 2));
        assert_eq!(odd.places.first(), Some(&(0..1)));
    }

    #[test]
    fn a_word_is_found_around_a_place_in_it() {
        assert_eq!(word_around(&ProgramText::whole("N10 G01X-.5"), &(5..6)), (4..7, "G01"));
        assert_eq!(word_around(&ProgramText::whole("N10 G01X-.5"), &(9..9)), (7..11, "X-.5"));
        assert_eq!(word_around(&ProgramText::whole("S100M3"), &(4..5)), (4..6, "M3"));
        assert_eq!(word_around(&ProgramText::whole(""), &(0..0)), (0..0, ""));
    }
}
