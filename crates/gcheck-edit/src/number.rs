//! Numbers in the hand of the program's writer.
//!
//! Knows: points, zeros and signs as a program has them. Must not know: what a number counts.

use gcheck_controls::{Control, Letter, Unpointed};
use gcheck_program::{Dialect, Loaded, Value};

/// Decimals beyond which no machine goes.
const FINEST: usize = 6;

/// How a program writes its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent habits of a writer")]
pub(crate) struct Hand {
    /// Zeros fill decimals: `1.500`.
    pads: bool,
    /// No zero in front of the point: `.5`.
    bare: bool,
    /// Feeds have a point: `F200.`
    points_feeds: bool,
    /// There are blanks between words.
    spaced: bool,
    /// Coordinates have a point.
    points: bool,
    /// Codes below 10 have a zero in front: `G01`.
    zeros: bool,
    /// The most decimals of a coordinate.
    decimals: u8,
}

impl Hand {
    /// Looks at all words of a program.
    pub(crate) fn of(loaded: &Loaded<'_>, dialect: &Dialect<'_>) -> Self {
        let mut hand = Self::default();
        for number in 0..loaded.flow_graph().blocks() {
            let Some(place) = loaded.place(number, dialect) else { continue };
            let words = place.table.words(place.block());
            let pairs = words.iter().zip(words.iter().skip(1));
            hand.spaced |= { pairs }.any(|(word, next)| word.range().end < next.range().start);
            for word in words {
                if word.code.is_some() && !word.shape.point {
                    let range = place.base + word.range().start..place.base + word.range().end;
                    hand.zeros |= word.shape.whole_digits == 2 && loaded.slice(range).get(1..2) == Some("0");
                }
                if !matches!(word.value, Value::Number(_)) || !word.shape.point {
                    continue;
                }
                let range = place.base + word.range().start..place.base + word.range().end;
                let text = loaded.slice(range);
                if matches!(word.letter.ascii(), b'X' | b'Y' | b'Z') {
                    hand.decimals = hand.decimals.max(word.shape.decimals);
                }
                hand.pads |= word.shape.decimals > 1 && text.ends_with('0');
                hand.bare |= word.shape.whole_digits == 0 && word.shape.decimals > 0;
                hand.points_feeds |= word.letter == Letter::of('F');
                hand.points |= matches!(word.letter.ascii(), b'X' | b'Y' | b'Z' | b'U' | b'V' | b'W');
            }
        }
        hand
    }

    /// Do codes below 10 have a zero in front?
    pub(crate) const fn zeros(self) -> bool {
        self.zeros
    }

    /// The most decimals of a coordinate, as far as numbers of the machine have a meaning.
    pub(crate) fn decimals(self) -> usize {
        usize::from(self.decimals).min(FINEST)
    }

    /// What is between words.
    pub(crate) const fn gap(self) -> &'static str {
        if self.spaced { " " } else { "" }
    }

    /// The form of a coordinate: with a point where the program's coordinates have one, or the control counts steps without it.
    pub(crate) fn form(self, control: &Control) -> &'static str {
        let as_written = control.numbers().unpointed == Unpointed::AsWritten;
        if self.points || !as_written { "1." } else { "1" }
    }

    /// A number in the form of an old one, with at most `most` decimals, or as many as the old one has.
    pub(crate) fn write(self, old: &str, value: f64, most: usize) -> String {
        let old: String = old.chars().filter(|c| !c.is_whitespace()).collect();
        let old_decimals = old.split_once('.').map(|(_, decimals)| decimals.len());
        let most = most.max(old_decimals.unwrap_or(0));
        let rounded = format!("{value:.most$}");
        let needed = rounded.split_once('.').map_or(0, |(_, decimals)| decimals.trim_end_matches('0').len());
        let decimals = if self.pads { needed.max(old_decimals.unwrap_or(0)) } else { needed };
        let mut text = format!("{value:.decimals$}");
        if text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.')) {
            text = text.trim_start_matches('-').to_owned();
        }
        if old_decimals.is_some() && decimals == 0 {
            text.push('.');
        }
        let unsigned = old.trim_start_matches(['+', '-']);
        let is_bare = unsigned.starts_with('.') || (self.bare && !unsigned.starts_with("0."));
        if is_bare && decimals > 0 {
            text = text.replacen("-0.", "-.", 1);
            if text.starts_with("0.") {
                text.remove(0);
            }
        }
        if old.starts_with('+') && !text.starts_with('-') {
            text.insert(0, '+');
        }
        text
    }

    /// The form of a number with a point and as many decimals, which are filled where the program does that.
    pub(crate) fn padded(self, decimals: usize) -> String {
        format!("1.{}", if self.pads { "0".repeat(decimals) } else { String::new() })
    }

    /// A feed or speed that the program has nowhere in this number.
    pub(crate) fn rate(self, letter: char, value: f64, most: usize) -> String {
        let form = if letter == 'F' && self.points_feeds { "1." } else { "1" };
        format!("{letter}{}", self.write(form, value, most))
    }
}

#[cfg(test)]
mod tests {
    use super::Hand;

    #[test]
    fn a_number_keeps_the_form_of_the_old_one() {
        let hand = Hand::default();
        let write = |old: &str, value: f64| hand.write(old, value, 3);
        assert_eq!(write("10.", 20.0), "20.");
        assert_eq!(write("10.5", 20.0), "20.");
        assert_eq!(write("10", 20.0), "20");
        assert_eq!(write("10", 20.5), "20.5");
        assert_eq!(write("+1.", 2.0), "+2.");
        assert_eq!(write("+1.", -2.0), "-2.");
        assert_eq!(write("- 1.", -0.0001), "0.");
        assert_eq!(write("0.5", 0.25), "0.25");
        assert_eq!(write(".5", -0.25), "-.25");
        assert_eq!(write("1.12345", 2.123_456), "2.12346");
    }

    #[test]
    fn zeros_that_fill_decimals_are_kept_in_a_program_that_has_them() {
        let hand = Hand { pads: true, ..Hand::default() };
        assert_eq!(hand.write("10.500", 20.0, 3), "20.000");
        assert_eq!(hand.write("10.", 20.25, 3), "20.25");
        let bare = Hand { bare: true, ..Hand::default() };
        assert_eq!(bare.write("1.", 0.5, 3), ".5");
        assert_eq!(bare.write("0.1", 0.5, 3), "0.5");
    }
}
