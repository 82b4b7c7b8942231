//! What nobody told, drawn at random for one run.
//!
//! Knows: which inputs a program has. Must not know: what a run makes of them.

use std::collections::BTreeSet;

use gcheck_engine::{Axis, Machine, Position, Tool, WorkOffset};
use gcheck_geometry::Mm;

/// Numbers that are the same in every test run.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// A number below `of`.
    pub(crate) fn below(&mut self, of: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as usize % of
    }

    pub(crate) fn one_of(&mut self, of: &[f64]) -> f64 {
        of[self.below(of.len())]
    }

    pub(crate) fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }
}

const VALUES: [f64; 8] = [0.0, 1.0, 2.0, 3.0, -1.0, 2.5, 10.0, 0.0];
const COORDINATES: [f64; 6] = [0.0, 10.0, -25.5, 3.0, 100.0, 0.0];

/// The machine as one run finds it: what is told, and the rest drawn.
pub(crate) fn draw(told: &Machine, text: &str, random: &mut Random) -> Machine {
    let mut machine = told.clone();
    if told.fresh {
        // Common variables hold nothing; the control's own may hold anything.
        for number in numbers(text).0.into_iter().filter(|number| *number >= 1_000) {
            machine.guesses.variables.insert(number, random.one_of(&VALUES));
        }
    } else {
        machine.fresh = random.once_in(3);
        // A word with nothing for its value is taken as given, so what is written as a word has a value.
        let (numbers, in_words) = numbers(text);
        for number in numbers {
            if !machine.fresh || in_words || !random.once_in(4) {
                machine.guesses.variables.insert(number, random.one_of(&VALUES));
            }
        }
        machine.guesses.touch = Some(random.one_of(&[0.0, 0.25, 0.5, 1.0]));
    }
    if told.start.is_none() {
        machine.start = Some(point(random));
    }
    if told.offsets.is_empty() {
        for number in 1..=6 {
            machine.offsets.insert(number, WorkOffset { origin: point(random), rotation: 0.0 });
        }
    }
    if told.tools.is_empty() && !told.tool_table_is_complete && !random.once_in(4) {
        for number in 1..=6 {
            machine.tools.insert(number, tool(number, random));
        }
        machine.tool_table_is_complete = random.once_in(2);
    }
    machine
}

/// Numbers of variables that the text names, and whether a word has a variable for its value.
fn numbers(text: &str) -> (BTreeSet<u32>, bool) {
    let mut in_words = false;
    let mut numbers = BTreeSet::new();
    for (at, _) in text.match_indices('#') {
        let before = text[..at].trim_end_matches(['[', '-', ' ', '+']);
        in_words |= before.ends_with(|c: char| c.is_ascii_alphabetic());
        let digits: String =
            text[at + 1..].chars().skip_while(|c| *c == '[').take_while(char::is_ascii_digit).collect();
        numbers.extend(digits.parse::<u32>().ok().filter(|number| *number >= 100));
    }
    (numbers, in_words)
}

fn point(random: &mut Random) -> Position {
    let mut point = Position::ZERO;
    for axis in [Axis::X, Axis::Y, Axis::Z, Axis::A] {
        point.set(axis, random.one_of(&COORDINATES));
    }
    point
}

pub(crate) fn tool(number: u32, random: &mut Random) -> Tool {
    let mut offset = Position::ZERO;
    offset.set(Axis::Z, random.one_of(&[100.0, 50.0, 0.0]));
    Tool {
        pocket: number,
        offset,
        diameter: Mm(random.one_of(&[4.0, 6.0, 0.5])),
        corner_radius: Mm(0.0),
        angles: [0.0; 2],
        orientation: 0,
    }
}
