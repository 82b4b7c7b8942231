//! Computed words: which of the values that they may have their code takes.
//!
//! Knows: the same ranges, signs and whole numbers that written words are judged by. Must not know: any rule.

use gcheck_controls::{Code, Confidence, Control, Letter, WordKind, one_of, spans};
use gcheck_engine::AbstractValue;
use gcheck_program::{BlockFlags, Word};

use crate::facts::callers::CallerValues;
use crate::{Finding, PathCx, RuleMeta, Severity, WordFacts, limit};

/// So far from a whole number a count may be: what arithmetic leaves over.
const WHOLE_WITHIN: f64 = 1e-4;

/// A computed word with a value that its code does not take.
pub(crate) struct Refused<'a> {
    /// The word.
    pub(crate) word: Word,
    facts: WordFacts<'a>,
    value: f64,
    why: Why,
    /// Every value that the word may have is refused, and it has one.
    pub(crate) is_certain: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Why {
    Small,
    Large,
    Fraction,
    Unlisted,
    Gap,
}

/// The computed words of the block that have, or may have, a value that their code does not take.
///
/// Nothing is known of a value in an interval unless the whole interval is refused.
pub(crate) fn refused<'a>(cx: &PathCx<'a>, callers: &CallerValues) -> Vec<Refused<'a>> {
    let flags = cx.origin().flags;
    if !flags.contains(BlockFlags::EXPRESSION)
        || flags.intersects(BlockFlags::UNKNOWN_CODE | BlockFlags::ERROR)
    {
        return Vec::new();
    }
    if callers.may_decide(cx) {
        return Vec::new();
    }
    let mut found = Vec::new();
    for (word, value) in cx.computed_words() {
        if matches!(word.letter.ascii(), b'N' | b'O' | b'G' | b'M') && !word.letter.is_corner() {
            continue;
        }
        let Some(facts) = cx.facts(word.letter).filter(|facts| facts.kind != WordKind::Flag) else {
            continue;
        };
        if let Some((value, why, is_certain)) = judged(value, &facts) {
            found.push(Refused { word: *word, facts, value, why, is_certain });
        }
    }
    found
}

/// A value that is refused, why, and whether every value is.
fn judged(value: &AbstractValue, facts: &WordFacts<'_>) -> Option<(f64, Why, bool)> {
    match value {
        AbstractValue::Vacant | AbstractValue::Unknown => None,
        AbstractValue::Number(x) => why(*x, facts).map(|why| (*x, why, true)),
        AbstractValue::Set(set) => {
            let (value, first) = set.numbers().iter().find_map(|x| Some((*x, why(*x, facts)?)))?;
            let all = set.numbers().iter().all(|x| why(*x, facts).is_some());
            Some((value, first, all && !set.vacant()))
        }
        AbstractValue::Interval { lo, hi, vacant } => {
            let nearest = [(*hi, Why::Small), (*lo, Why::Large)];
            let (value, why) =
                nearest.into_iter().find(|(x, side)| x.is_finite() && why(*x, facts) == Some(*side))?;
            (!vacant).then_some((value, why, true))
        }
    }
}

fn why(value: f64, facts: &WordFacts<'_>) -> Option<Why> {
    let low = facts.min.is_some_and(|min| value < min) || facts.above.is_some_and(|above| value <= above);
    let is_count = facts.kind.is_whole();
    if low || value < 0.0 && !facts.negative {
        Some(Why::Small)
    } else if facts.max.is_some_and(|max| value > max) {
        Some(Why::Large)
    } else {
        let is_fraction = is_count && (value - value.round()).abs() > WHOLE_WITHIN;
        let is_listed = facts.values.is_empty() || is_among(value, facts);
        if is_fraction {
            Some(Why::Fraction)
        } else if is_in_gap(value, facts) {
            Some(Why::Gap)
        } else {
            (!is_listed).then_some(Why::Unlisted)
        }
    }
}

/// Is the value one of those that are listed for the word?
pub(crate) fn is_among(value: f64, facts: &WordFacts<'_>) -> bool {
    facts.values.iter().any(|listed| (listed - value).abs() <= WHOLE_WITHIN)
}

/// What both rules of computed words report: `sure` says "is" or "may be".
pub(crate) fn finding(cx: &PathCx<'_>, rule: &'static RuleMeta, refused: &Refused<'_>) -> Finding {
    let Refused { word, facts, value, why, is_certain } = refused;
    let letter = word.letter;
    let range = cx.find_word(cx.origin().at, |other| other.range() == word.range());
    let of = facts.code.map(|code| format!(" for `{}`", written(cx, code))).unwrap_or_default();
    let sure = if *is_certain { "is" } else { "may be" };
    let (what, takes, confidence) = match why {
        Why::Small => ("too small", range_of(facts), range_confidence(cx, refused)),
        Why::Large => ("too large", range_of(facts), range_confidence(cx, refused)),
        Why::Unlisted => ("not among those", range_of(facts), facts.range_confidence),
        Why::Gap => {
            let takes = format!("{}, but not {}", range_of(facts), spans(facts.gaps));
            ("not among those", takes, facts.range_confidence)
        }
        Why::Fraction => ("not a whole number", "whole numbers".to_owned(), facts.confidence),
    };
    let finding = cx
        .finding(
            rule,
            range.unwrap_or_else(|| cx.range()),
            format!("computed value {sure} {what}{of}: `{letter}{value}`"),
        )
        .label(facts.is)
        .note(format!("`{letter}`{of} takes {takes}  [{}]", facts.source))
        .help("correct the expression, or the variables that it reads")
        .at_most(limit(confidence));
    // A control may round a fraction, but not the number of a program, nor where the data say that it refuses one.
    let rounds = *why == Why::Fraction && facts.kind != WordKind::Program && !facts.whole;
    let finding = if rounds { finding.at_most(Severity::Warning) } else { finding };
    let finding = if rounds && cx.model.semantics().computed_counts_round {
        // The manual allows it.
        let note = format!("this control rounds it to `{letter}{}`", value.round());
        finding.note(note).at_most(Severity::Info)
    } else {
        finding
    };
    finding.at_most(cx.environment.most_for_this_control())
}

/// A code as the block writes it, `G04` where it says so.
fn written(cx: &PathCx<'_>, code: Code<'_>) -> String {
    let is_code =
        |word: &Word| cx.control().code_at(word.code).is_some_and(|own| own.number() == code.number());
    let at = cx.origin().at;
    let range = cx.find_word(at, is_code);
    let file = cx.program.file(at.file);
    let text = range.zip(file.as_ref()).map(|(range, file)| file.loaded.slice(range).to_owned());
    text.unwrap_or_else(|| code.number().to_string())
}

/// How sure a bound is: the code's own, or that of the address about its sign.
fn range_confidence(cx: &PathCx<'_>, refused: &Refused<'_>) -> Confidence {
    let facts = &refused.facts;
    if refused.value < 0.0 && !facts.negative {
        return sign_confidence(cx.control(), refused.word.letter, facts);
    }
    facts.range_confidence
}

/// How sure it is that the word takes no value below zero: the address may say so, or the range that the code gives it.
pub(crate) fn sign_confidence(control: &Control, letter: Letter, facts: &WordFacts<'_>) -> Confidence {
    let of_address = control.letter(letter).map_or(facts.confidence, |entry| entry.confidence);
    let is_bound = facts.min.or(facts.above).is_some_and(|least| least >= 0.0);
    if is_bound { of_address.max(facts.range_confidence) } else { of_address }
}

/// "0 to 99", "1 or more", "more than 0".
pub(crate) fn range_of(facts: &WordFacts<'_>) -> String {
    if !facts.values.is_empty() {
        return one_of(facts.values);
    }
    bounds_of(facts.min, facts.above, facts.max).unwrap_or_else(|| {
        if facts.negative { "any number".to_owned() } else { "no negative number".to_owned() }
    })
}

/// Is the value between the bounds, where the word has no meaning?
pub(crate) fn is_in_gap(value: f64, facts: &WordFacts<'_>) -> bool {
    facts.gaps.iter().any(|[first, last]| (*first..=*last).contains(&value))
}

/// Bounds in words; `None` where there are none.
pub(crate) fn bounds_of(min: Option<f64>, above: Option<f64>, max: Option<f64>) -> Option<String> {
    Some(match (min, above, max) {
        (Some(min), _, Some(max)) => format!("{min} to {max}"),
        (Some(min), _, None) => format!("{min} or more"),
        (None, Some(above), Some(max)) => format!("more than {above}, up to {max}"),
        (None, Some(above), None) => format!("more than {above}"),
        (None, None, Some(max)) => format!("{max} or less"),
        (None, None, None) => return None,
    })
}
