//! The verdict on each pair of programs, and the line that tells it.
//!
//! Knows: verdicts, counts. Must not know: formats, how programs are paired or run.

use std::fmt::Write as _;
use std::path::PathBuf;

use gcheck_report::ControlChoice;
use gcheck_syntax::SourceText;
use serde_json::Value as Json;

use super::accepted::Answer;
use super::pairs::Pair;
use crate::Problem;

/// Exit code: something differs.
pub(super) const DIFFERENT: u8 = 1;

/// What a pair comes to.
pub(super) struct Outcome {
    pub(super) pair: Pair,
    pub(super) verdict: Verdict,
    /// Names of the differences.
    pub(super) differences: Vec<String>,
    pub(super) answer: Answer,
    /// Of these very differences.
    pub(super) digest: String,
    /// What was not compared although it may differ, in words.
    pub(super) limits: Vec<String>,
    /// The control of each program, as messages call it.
    pub(super) controls: Vec<(String, ControlChoice)>,
    /// The differences in words.
    pub(super) text: String,
    pub(super) detail: Json,
    /// Where the first difference is in the second program.
    pub(super) first: Option<Spot>,
    /// Both paths, as an SVG element.
    pub(super) picture: Option<String>,
}

/// The verdict on a pair of which something was not compared.
const AS_FAR_AS_KNOWN: &str = "the same as far as known";

/// What is to be said of a pair.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Verdict {
    Same,
    /// Nothing of what was compared differs, and something was not compared.
    AsFarAsKnown,
    Different,
    /// All differences are accepted.
    Accepted,
    /// A program cannot be read or does not come to its end.
    None(Problem),
}

impl Verdict {
    pub(super) const fn name(&self) -> &'static str {
        match self {
            Self::Same => "same",
            Self::AsFarAsKnown => "same-as-far-as-known",
            Self::Different => "different",
            Self::Accepted => "accepted",
            Self::None(_) => "no-verdict",
        }
    }
}

/// Programs of one folder alone.
pub(super) struct Alone {
    pub(super) name: String,
    /// 0 of the first folder, 1 of the second.
    pub(super) side: usize,
    pub(super) file: PathBuf,
    pub(super) answer: Answer,
}

impl Alone {
    pub(super) fn is_open(&self) -> bool {
        !self.answer.open.is_empty()
    }
}

/// All that was compared.
pub(super) struct Outcomes {
    pub(super) titles: [String; 2],
    pub(super) tolerance: f64,
    /// A pair that is the same as far as known counts as one that differs.
    pub(super) is_strict: bool,
    pub(super) pairs: Vec<Outcome>,
    pub(super) alone: Vec<Alone>,
}

/// Where the first difference is in the second program.
pub(super) struct Spot {
    pub(super) line: u32,
    pub(super) control: ControlChoice,
    /// As messages call the program.
    pub(super) path: String,
    pub(super) text: SourceText,
}

impl Outcome {
    /// The digest, where there are differences for it to name.
    pub(super) fn name_of_differences(&self) -> Option<&str> {
        (!self.digest.is_empty() && !self.differences.is_empty()).then_some(&self.digest)
    }

    /// What the pair comes to, in a line.
    pub(super) fn words(&self) -> String {
        let mut words = match &self.verdict {
            Verdict::Same => "the same".to_owned(),
            Verdict::AsFarAsKnown => format!("{}: {}", AS_FAR_AS_KNOWN, self.limits.join("; ")),
            Verdict::Different => format!("differs: {}", self.answer.open.join(", ")),
            Verdict::Accepted => format!("accepted: {}", self.differences.join(", ")),
            Verdict::None(problem) => format!("no verdict: {}", problem.message()),
        };
        if !self.answer.reasons.is_empty() {
            let accepts = if self.verdict == Verdict::Accepted { "" } else { "the rest is accepted: " };
            // Writing to a string cannot fail.
            let _ = write!(words, " ({accepts}{})", self.answer.reasons.join("; "));
        }
        if let Some(date) = self.answer.expired.first() {
            let _ = write!(words, " (was accepted until {date})");
        }
        // Of other pairs the text below the line says it.
        if self.verdict == Verdict::Accepted {
            for limit in &self.limits {
                let _ = write!(words, "; {limit}");
            }
        }
        words
    }
}

impl Outcomes {
    /// How many pairs come to this.
    pub(super) fn count(&self, is: impl Fn(&Verdict) -> bool) -> usize {
        self.pairs.iter().filter(|outcome| is(&outcome.verdict)).count()
    }

    /// The figures in a line.
    pub(super) fn summary(&self) -> String {
        let count = self.pairs.len();
        let mut parts = vec![format!("{} the same", self.count(|verdict| *verdict == Verdict::Same))];
        let mut part = |count: usize, words: &str| {
            if count > 0 {
                parts.push(format!("{count} {words}"));
            }
        };
        part(self.count(|verdict| *verdict == Verdict::AsFarAsKnown), AS_FAR_AS_KNOWN);
        part(self.count(|verdict| *verdict == Verdict::Different), "different");
        let accepted = self.pairs.iter().filter(|outcome| outcome.verdict == Verdict::Accepted);
        let (whole, partly): (Vec<_>, Vec<_>) = accepted.partition(|outcome| outcome.limits.is_empty());
        part(whole.len(), "accepted");
        part(partly.len(), "accepted, of which a part was not compared");
        part(self.count(|verdict| matches!(verdict, Verdict::None(_))), "without a verdict");
        for (side, title) in self.titles.iter().enumerate() {
            for (is_open, accepted) in [(true, ""), (false, ", accepted")] {
                let alone =
                    self.alone.iter().filter(|alone| alone.side == side && alone.is_open() == is_open);
                part(alone.count(), &format!("only in {title}{accepted}"));
            }
        }
        let pairs = if count == 1 { "1 pair".to_owned() } else { format!("{count} pairs") };
        format!("{pairs} of programs compared, within {} mm: {}", self.tolerance, parts.join(", "))
    }
}
