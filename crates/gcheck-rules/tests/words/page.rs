//! The page of what became of every case.
//!
//! Knows: how it is written. Must not know: how anything is checked.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use gcheck_controls::{CodeNumber, Control, Effect, Letter, Need};

use crate::case::{Case, Kind, MOTION, all_letters};
use crate::judge::Answer;

/// Is the code one of the founding systems: feed modes, dwell, arcs and helix, bar feed, cylinder, compensation along a vector,
/// tool length over five axes, probing of lengths and centres, general pocket?
fn is_founding(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::ArcClockwise
            | Effect::ArcCounterClockwise
            | Effect::Dwell
            | Effect::FeedInverseTime
            | Effect::FeedPerMinute
            | Effect::FeedPerRevolution
            | Effect::BarFeed
            | Effect::CylinderMapping
            | Effect::CompensationVector
            | Effect::LengthFiveAxis
            | Effect::Skip
            | Effect::ProbeDiameter
            | Effect::ProbeOffset
            | Effect::ProbeLength
            | Effect::ProbeCentre
            | Effect::GeneralPocket
    )
}

/// Counts of one kind.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Count {
    pub(crate) cases: usize,
    pub(crate) reported: usize,
    pub(crate) allowed: usize,
    pub(crate) silent: usize,
    pub(crate) wrong: usize,
}

/// What became of the cases of a control.
pub(crate) struct Table {
    control: String,
    counts: [Count; Kind::ALL.len()],
    /// Cases that are silent, and findings on correct blocks: by what they have in common, with the blocks.
    open: BTreeMap<String, Vec<String>>,
    /// Rows of the founding codes, by letter.
    letters: Vec<(String, String)>,
    /// Open cases without a reason.
    pub(crate) unjustified: usize,
}

/// Why a case may stay open.
struct Reason {
    /// Of the control, the kind, the codes and the letters; `*` is any.
    of: [String; 4],
    text: String,
}

impl Reason {
    fn is_of(&self, control: &Control, case: &Case) -> bool {
        let [name, kind, codes, letters] = &self.of;
        let is = |pattern: &str, value: &str| pattern == "*" || pattern.split(' ').any(|item| item == value);
        is(name, control.name())
            && (kind == "*" || kind == case.kind.name())
            && is(codes, &case.code)
            && is(letters, &case.letter.to_string())
    }
}

fn reasons() -> Vec<Reason> {
    let row = |line: &str| {
        let fields: Vec<String> = line.split('\t').map(str::to_owned).collect();
        let [control, kind, codes, letters, text] = <[String; 5]>::try_from(fields).unwrap();
        Reason { of: [control, kind, codes, letters], text }
    };
    include_str!("reasons.tsv").lines().skip(1).map(row).collect()
}

impl Table {
    pub(crate) fn of(control: &Control, answers: &[(Case, Answer)]) -> Self {
        let mut table = Self {
            control: control.name().to_owned(),
            counts: [Count::default(); Kind::ALL.len()],
            open: BTreeMap::new(),
            letters: rows(control, answers),
            unjustified: 0,
        };
        let reasons = reasons();
        for (case, answer) in answers {
            let count = &mut table.counts[case.kind as usize];
            count.cases += 1;
            let reason = reasons.iter().find(|reason| reason.is_of(control, case));
            let what = match answer {
                Answer::Reported(_) => {
                    count.reported += 1;
                    continue;
                }
                Answer::Allowed(_) => {
                    count.allowed += 1;
                    continue;
                }
                Answer::Silent => {
                    count.silent += 1;
                    "silent".to_owned()
                }
                Answer::False(rules) => {
                    count.wrong += 1;
                    rules.join(", ")
                }
            };
            let shown = format!("{}: `{}`", case.code, case.shown);
            let reason = reason.map(|reason| reason.text.as_str());
            table.unjustified += usize::from(reason.is_none());
            let reason = reason.unwrap_or("**no reason is known**");
            table
                .open
                .entry(format!("{}: {what}", case.kind.name()))
                .or_default()
                .push(format!("{shown}: {reason}"));
        }
        table
    }
}

/// A row of the founding codes, each letter as one sign.
fn rows(control: &Control, answers: &[(Case, Answer)]) -> Vec<(String, String)> {
    let mut rows = Vec::new();
    for code in control.codes().filter(|code| is_founding(code.effect())) {
        let name = code.entry().code.as_str();
        let forbids =
            |letter: Letter| code.entry().forbidden.iter().any(|item| Letter::parse(item) == Some(letter));
        let mut signs = String::from("|");
        for letter in all_letters().filter(|letter| is_value(*letter)) {
            let of_word = code.entry().words.iter().find(|word| Letter::parse(&word.letter) == Some(letter));
            let is_extra =
                |case: &Case| case.kind == Kind::Extra && case.letter == letter && case.code == name;
            let answer = answers.iter().find(|(case, _)| is_extra(case)).map(|(_, answer)| answer);
            let sign = match (of_word.map(|word| word.need), answer) {
                (Some(Need::Required), _) => "R",
                (Some(Need::Modal), _) => "L",
                (Some(Need::Conditional), _) => "c",
                (Some(Need::Optional), _) => "o",
                (None, Some(Answer::Reported(_))) if forbids(letter) => "x",
                (None, Some(Answer::Reported(_))) => "!",
                (None, Some(Answer::Silent | Answer::False(_))) => "?",
                (None, Some(Answer::Allowed(MOTION))) => "m",
                (None, Some(Answer::Allowed(_)) | None) => "·",
            };
            let _ = write!(signs, " {sign} |");
        }
        rows.push((name.to_owned(), signs));
    }
    rows.sort_by_cached_key(|(name, _)| CodeNumber::parse(name));
    rows
}

fn is_value(letter: Letter) -> bool {
    letter.is_corner() || !matches!(letter.ascii(), b'G' | b'M' | b'N' | b'O')
}

const HEAD: &str = "# Every word of every code

The knowledge base says for each code which words it needs, takes and refuses.
For each code of these controls a generator takes the correct block of the knowledge base and changes one word at a time:

* *computed*: the word gets its value from a variable, and must mean the same as the number;
* *computed, out of range* and *out of range*: a value that the data do not allow, from a variable and as a number;
* *in an earlier block*: the word is alone in the block before;
* *missing*: the word is nowhere;
* *extra*: a letter that no code of the block reads.

The data say whether the changed block is allowed.
Where they do not allow it, some finding must say so; where they do, none may.
A case without such a finding is silent, and is listed below with the reason.

This page is written by a test (`UPDATE_EXPECT=1 cargo test -p gcheck-rules --test words`).

";

pub(crate) fn write(tables: &[Table]) -> String {
    let before = before();
    let mut page = String::from(HEAD);
    for table in tables {
        let _ = writeln!(page, "## {}\n", table.control);
        page.push_str("| change | cases | reported | allowed | silent | false findings | silent before | false before |\n");
        page.push_str("|---|---|---|---|---|---|---|---|\n");
        for kind in Kind::ALL {
            let count = table.counts[kind as usize];
            let Count { cases, reported, allowed, silent, wrong } = count;
            // A control that is newer than the test has no figures of the time before.
            let known = before.get(&(table.control.clone(), kind.name().to_owned()));
            let (silent_before, wrong_before) = known
                .map_or(("–".into(), "–".into()), |(silent, wrong)| {
                    (silent.to_string(), wrong.to_string())
                });
            let name = kind.name();
            let _ = writeln!(
                page,
                "| {name} | {cases} | {reported} | {allowed} | {silent} | {wrong} | {silent_before} | {wrong_before} |"
            );
        }
        page.push('\n');
        write_open(&mut page, table);
    }
    write_letters(&mut page, tables);
    page
}

fn write_open(page: &mut String, table: &Table) {
    for (what, blocks) in &table.open {
        let _ = writeln!(page, "### {}: {what}\n", table.control);
        for block in blocks {
            let _ = writeln!(page, "* {block}");
        }
        page.push('\n');
    }
}

fn write_letters(page: &mut String, tables: &[Table]) {
    page.push_str("## Letters of the founding codes\n\n");
    page.push_str("`R` required, `L` here or earlier, `c` depends on other words, `o` optional; `x` forbidden and reported, `!` passed over\n");
    page.push_str("or refused by the control and reported; `m` read by the motion in effect, `·` by any block; `?`: nothing is known.\n\n");
    let letters: Vec<String> =
        all_letters().filter(|letter| is_value(*letter)).map(|letter| letter.to_string()).collect();
    for table in tables {
        let _ = writeln!(page, "### {}: letters\n", table.control);
        let _ = writeln!(page, "| code | {} |", letters.join(" | "));
        let _ = writeln!(page, "|---|{}", "---|".repeat(letters.len()));
        for (code, signs) in &table.letters {
            let _ = writeln!(page, "| {code} {signs}");
        }
        page.push('\n');
    }
}

/// Silent cases and false findings before there was this test, by control and kind.
fn before() -> BTreeMap<(String, String), (usize, usize)> {
    let rows = include_str!("before.tsv").lines().skip(1);
    let row = |line: &str| {
        let fields: Vec<&str> = line.split('\t').collect();
        let number = |at: usize| fields[at].parse().unwrap();
        ((fields[0].to_owned(), fields[1].to_owned()), (number(2), number(3)))
    };
    rows.map(row).collect()
}
