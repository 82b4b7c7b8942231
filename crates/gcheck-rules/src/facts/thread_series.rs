//! Standard threads: the pitch that a size has in the coarse and the fine series.
//!
//! Knows: ISO 261 and ASME B1.1. Must not know: any rule, comments, how a thread is cut.

/// The coarse pitch of each diameter in ISO 261, millimetres.
const COARSE: [(f64, f64); 39] = [
    (1.0, 0.25),
    (1.2, 0.25),
    (1.4, 0.3),
    (1.6, 0.35),
    (1.8, 0.35),
    (2.0, 0.4),
    (2.2, 0.45),
    (2.5, 0.45),
    (3.0, 0.5),
    (3.5, 0.6),
    (4.0, 0.7),
    (4.5, 0.75),
    (5.0, 0.8),
    (6.0, 1.0),
    (7.0, 1.0),
    (8.0, 1.25),
    (9.0, 1.25),
    (10.0, 1.5),
    (11.0, 1.5),
    (12.0, 1.75),
    (14.0, 2.0),
    (16.0, 2.0),
    (18.0, 2.5),
    (20.0, 2.5),
    (22.0, 2.5),
    (24.0, 3.0),
    (27.0, 3.0),
    (30.0, 3.5),
    (33.0, 3.5),
    (36.0, 4.0),
    (39.0, 4.0),
    (42.0, 4.5),
    (45.0, 4.5),
    (48.0, 5.0),
    (52.0, 5.0),
    (56.0, 5.5),
    (60.0, 5.5),
    (64.0, 6.0),
    (68.0, 6.0),
];

/// Threads per inch of sizes in inches, ASME B1.1: the coarse series (UNC) and the fine one (UNF).
const FRACTIONS: [(&str, [u32; 2]); 14] = [
    ("1/4", [20, 28]),
    ("5/16", [18, 24]),
    ("3/8", [16, 24]),
    ("7/16", [14, 20]),
    ("1/2", [13, 20]),
    ("9/16", [12, 18]),
    ("5/8", [11, 18]),
    ("3/4", [10, 16]),
    ("7/8", [9, 14]),
    ("1", [8, 12]),
    ("1-1/8", [7, 12]),
    ("1-1/4", [7, 12]),
    ("1-3/8", [6, 12]),
    ("1-1/2", [6, 12]),
];

/// The same of sizes by number; no thread in a series is 0.
const NUMBERED: [(u32, [u32; 2]); 10] = [
    (0, [0, 80]),
    (1, [64, 72]),
    (2, [56, 64]),
    (3, [48, 56]),
    (4, [40, 48]),
    (5, [40, 44]),
    (6, [32, 40]),
    (8, [32, 36]),
    (10, [24, 32]),
    (12, [24, 28]),
];

/// A series of inch threads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Series {
    /// UNC.
    Coarse,
    /// UNF.
    Fine,
}

impl Series {
    /// As comments write it: `UNC`, `UNC-2B`.
    pub(crate) fn named(word: &str) -> Option<Self> {
        match word.split('-').next()? {
            "UNC" => Some(Self::Coarse),
            "UNF" => Some(Self::Fine),
            _ => None,
        }
    }
}

/// The coarse pitch of a metric diameter, both in millimetres.
pub(crate) fn coarse_pitch(size: f64) -> Option<f64> {
    COARSE.iter().find(|(known, _)| known.to_bits() == size.to_bits()).map(|(_, pitch)| *pitch)
}

/// Threads per inch of a size (`1/4`, `#10`, `10`) in both series.
fn threads(size: &str) -> Option<[u32; 2]> {
    if let Some((_, both)) = FRACTIONS.iter().find(|(known, _)| *known == size) {
        return Some(*both);
    }
    let number: u32 = size.trim_start_matches('#').parse().ok()?;
    NUMBERED.iter().find(|(known, _)| *known == number).map(|(_, both)| *both)
}

/// Threads per inch of a size in a series. A small whole number alone may be of inches or a size by number.
pub(crate) fn threads_in(size: &str, series: Series) -> Option<u32> {
    let is_unclear = !size.starts_with('#') && matches!(size, "0" | "1" | "2" | "3" | "4");
    let [coarse, fine] = threads(size).filter(|_| !is_unclear)?;
    let threads = if series == Series::Coarse { coarse } else { fine };
    (threads > 0).then_some(threads)
}

/// Is there a thread of this size with so many threads per inch?
pub(crate) fn is_made(size: &str, count: u32) -> bool {
    count > 0 && threads(size).is_some_and(|both| both.contains(&count))
}

#[cfg(test)]
mod tests {
    use super::{Series, coarse_pitch, is_made, threads_in};

    #[test]
    fn sizes_and_their_series() {
        assert_eq!(coarse_pitch(30.0), Some(3.5));
        assert_eq!(coarse_pitch(13.0), None);
        assert_eq!(threads_in("1/4", Series::Coarse), Some(20));
        assert_eq!(threads_in("#10", Series::Fine), Some(32));
        assert_eq!(threads_in("10", Series::Coarse), Some(24));
        assert_eq!(threads_in("#0", Series::Coarse), None);
        assert_eq!(threads_in("1", Series::Coarse), None);
        assert!(is_made("1", 8) && is_made("1-1/8", 7) && is_made("#4", 40));
        assert!(!is_made("1/4", 18) && !is_made("#0", 0));
        assert_eq!(Series::named("UNF-2B"), Some(Series::Fine));
    }
}
