//! Random choices that are the same on every machine.
//!
//! Knows: one stream of numbers from a seed. Must not know: what is chosen.

/// The golden ratio in 64 bits.
const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

/// A stream of numbers (`SplitMix64`).
#[derive(Debug, Clone)]
pub(crate) struct Random(u64);

impl Random {
    /// The stream of a seed. Seeds are mixed first: neighbours would otherwise be one stream, a step apart.
    pub(crate) fn new(seed: u64) -> Self {
        Self(mixed(seed.wrapping_add(STEP)))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(STEP);
        mixed(self.0)
    }

    /// A whole number from `least` to `most`, both included.
    pub(crate) fn whole(&mut self, least: i64, most: i64) -> i64 {
        let count = u64::try_from(most - least + 1).unwrap();
        least + i64::try_from(self.next() % count).unwrap()
    }

    /// True in one of `many` cases.
    pub(crate) fn one_in(&mut self, many: i64) -> bool {
        self.whole(1, many) == 1
    }

    /// One of the choices.
    pub(crate) fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        let ix = self.whole(0, i64::try_from(choices.len()).unwrap() - 1);
        *choices.get(usize::try_from(ix).unwrap()).unwrap()
    }

    /// A number from `least` to `most` with up to three decimals.
    pub(crate) fn number(&mut self, least: i64, most: i64) -> f64 {
        let steps: i64 = self.pick(&[1, 1, 2, 4, 10, 1000]);
        #[expect(clippy::cast_precision_loss, reason = "small numbers")]
        let number = self.whole(least * steps, most * steps) as f64 / steps as f64;
        number
    }
}

const fn mixed(bits: u64) -> u64 {
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^ (bits >> 31)
}

#[test]
fn a_seed_gives_the_same_choices_each_time() {
    let mut random = Random::new(7);
    let first: Vec<i64> = (0..5).map(|_| random.whole(0, 99)).collect();
    let mut random = Random::new(7);
    let again: Vec<i64> = (0..5).map(|_| random.whole(0, 99)).collect();
    assert_eq!(first, again);
    assert_eq!(first, [21, 74, 27, 45, 90]);
}
