//! Differences that somebody has looked at and accepts: a file of them, each with its reason.
//!
//! Knows: the file's format, dates. Must not know: how differences are found or shown.

use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use serde::Deserialize;
use toml::value::Date;

use crate::config::{PathPattern, Placed, in_words};
use crate::{Problem, paths, reading};

/// A larger file is not a list of accepted differences.
const MAX_BYTES: u64 = 1 << 20;

/// Digits of a digest.
pub(super) const DIGEST: usize = 8;

/// The file as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    #[serde(default)]
    accepted: Vec<EntryText>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct EntryText {
    file: Placed<String>,
    differences: Option<Placed<Vec<Placed<String>>>>,
    digest: Option<Placed<String>>,
    reason: Placed<String>,
    until: Option<Placed<toml::value::Datetime>>,
}

/// The accepted differences of a run.
#[derive(Debug, Default)]
pub(super) struct Accepted {
    /// The file as messages call it.
    name: String,
    entries: Vec<Entry>,
}

#[derive(Debug)]
struct Entry {
    pattern: PathPattern,
    shown: String,
    line: usize,
    /// `None` accepts all.
    differences: Option<Vec<String>>,
    digest: Option<String>,
    reason: String,
    /// The last day, and how the file writes it.
    until: Option<(i64, String)>,
}

/// What a list says of the differences of a pair.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Answer {
    /// Differences that nothing accepts.
    pub(super) open: Vec<String>,
    /// Why the others are accepted, each reason once.
    pub(super) reasons: Vec<String>,
    /// The entries that were of use.
    pub(super) used: Vec<usize>,
    /// Dates of entries that would accept more, and have passed.
    pub(super) expired: Vec<String>,
}

impl Accepted {
    /// Reads a list; `kinds` are the differences that there are.
    pub(super) fn read(path: &Path, kinds: &[&str]) -> Result<Self, Problem> {
        let name = paths::shown_from_here(path);
        let bytes = reading::regular(path, MAX_BYTES).map_err(|reason| {
            Problem::with_file(path, format!("cannot read accepted differences: {reason}"))
        })?;
        let text = String::from_utf8(bytes).map_err(|_| {
            Problem::with_file(path, "is not a list of accepted differences: it is not UTF-8")
        })?;
        let read: Text = toml::from_str(&text).map_err(|error| {
            let range = error.span().unwrap_or(0..0);
            if error.message().contains("datetime") {
                return Problem::at(&name, &text, &range, "`until` is a date".to_owned())
                    .help("write it without quotes: `until = 2027-06-30`");
            }
            Problem::at(&name, &text, &range, in_words(error.message()))
        })?;
        let entries = read.accepted.into_iter().map(|entry| Entry::new(entry, &name, &text, kinds));
        Ok(Self { entries: entries.collect::<Result<_, _>>()?, name })
    }

    /// Which of the differences of a program are accepted today.
    pub(super) fn of(&self, program: &str, differences: &[&str], digest: &str, today: i64) -> Answer {
        let mut answer = Answer::default();
        for difference in differences {
            let fits = |entry: &Entry| {
                let is_named =
                    entry.differences.as_ref().is_none_or(|all| all.iter().any(|one| one == difference));
                let is_same = entry.digest.as_ref().is_none_or(|of| digest == of);
                is_named && is_same && entry.pattern.fits(&Path::new("/").join(program))
            };
            let fitting = || self.entries.iter().enumerate().filter(|(_, entry)| fits(entry));
            let is_valid = |entry: &Entry| entry.until.as_ref().is_none_or(|(last, _)| today <= *last);
            if let Some((index, entry)) = fitting().find(|(_, entry)| is_valid(entry)) {
                answer.used.push(index);
                if !answer.reasons.contains(&entry.reason) {
                    answer.reasons.push(entry.reason.clone());
                }
            } else {
                answer.open.push((*difference).to_owned());
                let dates = fitting().filter_map(|(index, entry)| {
                    answer.used.push(index);
                    Some(entry.until.as_ref()?.1.clone())
                });
                let dates: Vec<String> = dates.collect();
                answer.expired.extend(dates);
            }
        }
        answer.expired.dedup();
        answer
    }

    /// Says which entries accept nothing any more.
    pub(super) fn unused(&self, used: &[usize]) -> Vec<String> {
        let unused = self.entries.iter().enumerate().filter(|(index, _)| !used.contains(index));
        let words = unused.map(|(_, entry)| {
            format!("{}:{}: accepts nothing: `{}` has no such difference", self.name, entry.line, entry.shown)
        });
        words.collect()
    }
}

impl Entry {
    fn new(entry: EntryText, name: &str, text: &str, kinds: &[&str]) -> Result<Self, Problem> {
        let problem = |range, message: String| Problem::at(name, text, range, message);
        let EntryText { file, differences, digest, reason, until } = entry;
        let pattern = PathPattern::new(Path::new("/"), &file.value)
            .map_err(|why| problem(&file.range, format!("`{}` is not a pattern: {why}", file.value)))?;
        if reason.value.trim().is_empty() {
            return Err(problem(&reason.range, "an accepted difference needs a reason".to_owned()));
        }
        if let Some(empty) = differences.as_ref().filter(|all| all.value.is_empty()) {
            let message = "`differences` is empty, so that nothing is accepted".to_owned();
            return Err(problem(&empty.range, message).help("leave it out to accept all"));
        }
        let is_digest = |of: &str| {
            of.len() == DIGEST && of.bytes().all(|b| b.is_ascii_digit() || (b'a'..=b'f').contains(&b))
        };
        if let Some(of) = digest.as_ref().filter(|of| !is_digest(&of.value)) {
            let message = format!("`{}` is not a digest: it has {DIGEST} digits, `0` to `f`", of.value);
            return Err(problem(&of.range, message).help("take it from what `gcheck diff` prints"));
        }
        for difference in differences.iter().flat_map(|all| &all.value) {
            if !kinds.contains(&difference.value.as_str()) {
                let message = format!("unknown difference `{}`", difference.value);
                return Err(problem(&difference.range, message).help(format!("one of {}", kinds.join(", "))));
            }
        }
        let until = match &until {
            Some(until) => match until.value.date {
                Some(date) => Some((days(date), date.to_string())),
                None => {
                    return Err(problem(&until.range, "`until` is a date: `until = 2027-06-30`".to_owned()));
                }
            },
            None => None,
        };
        let line = text.get(..file.range.start).map_or(1, |before| before.matches('\n').count() + 1);
        Ok(Self {
            pattern,
            shown: file.value,
            line,
            differences: differences.map(|all| all.value.into_iter().map(|one| one.value).collect()),
            digest: digest.map(|of| of.value),
            reason: reason.value,
            until,
        })
    }
}

/// The day, counted from 1970-01-01, in UTC.
pub(super) fn today() -> i64 {
    const SECONDS: u64 = 24 * 60 * 60;
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_secs() / SECONDS).unwrap_or(i64::MAX)
}

/// Days of a year before each month, without a leap day.
const BEFORE: [i64; 12] = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334];
/// Days from the first day of the calendar to 1970-01-01.
const TO_1970: i64 = 719_162;

/// A date of the Gregorian calendar as days from 1970-01-01, by the rule of leap years alone.
fn days(date: Date) -> i64 {
    let (year, month) = (i64::from(date.year), usize::from(date.month));
    // Leap days of the years before this one.
    let leaps = |years: i64| years / 4 - years / 100 + years / 400;
    let before = BEFORE.get(month.saturating_sub(1)).copied().unwrap_or_default();
    let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let leap_day = i64::from(is_leap && month > 2);
    (year - 1) * 365 + leaps(year - 1) + before + leap_day + i64::from(date.day) - 1 - TO_1970
}

#[cfg(test)]
mod tests {
    use toml::value::Date;

    use super::days;

    #[test]
    fn dates_are_days_since_1970() {
        for ((year, month, day), expected) in [
            ((1970, 1, 1), 0),
            ((1970, 12, 31), 364),
            ((1972, 3, 1), 790),
            ((2000, 2, 29), 11_016),
            ((2026, 11, 27), 20_784),
            ((2100, 3, 1), 47_541),
        ] {
            assert_eq!(days(Date { year, month, day }), expected, "{year}-{month}-{day}");
        }
    }
}
