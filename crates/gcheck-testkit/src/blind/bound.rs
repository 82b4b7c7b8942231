//! How sure a share is: exact one-sided bounds of a binomial share.
//!
//! Knows: the binomial distribution. Must not know: what is counted.
//!
//! Source: C. J. Clopper, E. S. Pearson, "The use of confidence or fiducial limits illustrated in the case of the binomial",
//! Biometrika 26 (1934), pages 404 to 413, for one side and 95 %.

/// What a bound may miss by chance.
const MISSED: f64 = 0.05;

/// The largest share that still lets `count` of `of` be drawn once in twenty times. One, where nothing was drawn.
pub fn at_most(count: u32, of: u32) -> f64 {
    if count >= of {
        return 1.0;
    }
    // The chance of so few falls with the share.
    share_where(|share| up_to(count, of, share) > MISSED)
}

/// The smallest share that still lets `count` of `of` be drawn once in twenty times. Zero, where nothing was drawn.
pub fn at_least(count: u32, of: u32) -> f64 {
    if count == 0 || of == 0 {
        return 0.0;
    }
    share_where(|share| 1.0 - up_to(count - 1, of, share) < MISSED)
}

/// Where a property that holds for small shares stops to hold.
fn share_where(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

/// The chance of `count` or fewer of `of` at a share.
fn up_to(count: u32, of: u32, share: f64) -> f64 {
    // In logarithms, as powers of small shares leave the range of numbers.
    let (yes, no) = (share.ln(), (1.0 - share).ln());
    let mut ways = 0.0;
    let mut sum = 0.0;
    for k in 0..=count {
        if k > 0 {
            ways += f64::from(of - k + 1).ln() - f64::from(k).ln();
        }
        sum += (ways + f64::from(k) * yes + f64::from(of - k) * no).exp();
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::{at_least, at_most};

    #[test]
    fn bounds_are_those_of_printed_tables() {
        // Clopper and Pearson: none of 10 at 90 % two-sided goes up to 0.2589, 5 of 10 from 0.2224 to 0.7776.
        for (found, expected) in [
            (at_most(0, 10), 0.2589),
            (at_most(5, 10), 0.7776),
            (at_least(5, 10), 0.2224),
            (at_least(10, 10), 0.7411),
            (at_most(0, 65), 0.0450),
        ] {
            assert!((found - expected).abs() < 5e-5, "{found} / {expected}");
        }
    }

    #[test]
    fn without_a_draw_nothing_is_known() {
        assert!(at_most(0, 0) >= 1.0);
        assert!(at_least(0, 0) <= 0.0);
        assert!(at_most(7, 7) >= 1.0);
    }
}
