//! What a run printed, and when two runs are equal.
//!
//! Knows: the form of a line of canonical functions, what is compared and how exactly. Must not know: who printed it.

use std::fmt::{self, Write as _};

/// Numbers closer than this are equal. The last digit printed is 1e-4, so that neighbours after rounding still are.
const CLOSE: f64 = 1e-4 + 1e-9;

/// Lines of agreement shown before a difference, and lines of both sides after it.
const BEFORE: usize = 4;
const BEHIND: usize = 6;

/// How a run came to its end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum End {
    /// The program ended.
    Ended,
    /// A block was refused; the words of the refusal.
    Refused(String),
    /// Time or output ran out before the program ended.
    Endless,
    /// The run itself failed (usage, crash): never equal to anything.
    Broken(String),
}

/// One canonical function as printed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Call {
    /// The column with the block's number: `N10`, or `N.....` for none.
    block: String,
    /// The function's name.
    name: String,
    /// Its arguments, as written.
    arguments: Vec<String>,
}

/// What a run printed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outcome {
    /// The functions in their order, without comments, messages and logs.
    pub calls: Vec<Call>,
    /// How it ended.
    pub end: End,
}

/// The first place where two outcomes are not equal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// Which functions differ and how both ended, without numbers: a smaller program shows the same when this is the same.
    pub kind: String,
    /// What it is, in one line.
    pub title: String,
    /// The title with the lines around it.
    pub text: String,
}

impl Call {
    /// Reads a printed line. Comments, messages, lines of a log and anything that is not a canonical function give
    /// `None`.
    fn read(line: &str) -> Option<Self> {
        let (counter, rest) = line.trim_start().split_once(' ')?;
        counter.parse::<u64>().ok()?;
        let (block, rest) = rest.split_once(' ')?;
        block.strip_prefix('N')?;
        let (name, arguments) = rest.trim_start().split_once('(')?;
        if name == "COMMENT" || name == "MESSAGE" || name.starts_with("LOG") {
            return None;
        }
        let arguments = arguments.trim_end().strip_suffix(')').unwrap_or(arguments);
        let separators = [',', ' '];
        let arguments = arguments.split(separators).filter(|a| !a.is_empty()).map(str::to_owned).collect();
        Some(Self { block: block.to_owned(), name: name.to_owned(), arguments })
    }

    fn equals(&self, other: &Self) -> bool {
        self.block == other.block
            && self.name == other.name
            && self.arguments.len() == other.arguments.len()
            && self.arguments.iter().zip(&other.arguments).all(|(a, b)| equal_arguments(a, b))
    }

    /// The function's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its arguments that are numbers.
    pub fn numbers(&self) -> Vec<f64> {
        self.arguments.iter().filter_map(|argument| argument.parse().ok()).collect()
    }

    /// Whether it stops at the end of every block.
    pub fn is_exact_stop(&self) -> bool {
        self.arguments.first().is_some_and(|argument| argument == "CANON_EXACT_STOP")
    }
}

impl fmt::Display for Call {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:<6} {}({})", self.block, self.name, self.arguments.join(", "))
    }
}

fn equal_arguments(a: &str, b: &str) -> bool {
    a == b || matches!((a.parse::<f64>(), b.parse::<f64>()), (Ok(a), Ok(b)) if (a - b).abs() <= CLOSE)
}

/// Whether the calls hold these texts (`STRAIGHT_FEED(1.0000, 2.0000`), one call each, in this order, with others between them.
/// Minus nought is nought.
pub fn hold_in_order(calls: &[Call], texts: &[&str]) -> bool {
    let mut lines = calls.iter().map(|call| call.to_string().replace("-0.0000", "0.0000"));
    texts.iter().all(|text| lines.any(|line| line.contains(text)))
}

/// Reads what a run printed on standard output.
pub fn read(printed: &str) -> Vec<Call> {
    printed.lines().filter_map(Call::read).collect()
}

/// The first difference between the reference and us, `None` when they agree.
///
/// When both refuse, what the refused block itself printed before its mistake was found does not count.
pub fn compare(reference: &Outcome, ours: &Outcome) -> Option<Difference> {
    let both_refuse = matches!((&reference.end, &ours.end), (End::Refused(_), End::Refused(_)));
    let (left, right) = (&reference.calls, &ours.calls);
    let same = left.iter().zip(right).take_while(|(a, b)| a.equals(b)).count();
    if same < left.len() || same < right.len() {
        let (left_rest, right_rest) = (left.get(same..).unwrap_or(&[]), right.get(same..).unwrap_or(&[]));
        if !(both_refuse && is_one_block(left_rest) && is_one_block(right_rest)) {
            return Some(difference(left, right, same, reference, ours));
        }
    }
    let same_end = both_refuse || reference.end == ours.end && ours.end == End::Ended;
    (!same_end).then(|| difference(left, right, same, reference, ours))
}

/// Whether these calls come from one block, the resets after the program set aside.
fn is_one_block(calls: &[Call]) -> bool {
    let mut of_program = calls.iter().filter(|c| c.name != "ON_RESET");
    let Some(first) = of_program.next() else { return true };
    of_program.all(|c| c.block == first.block)
}

fn difference(left: &[Call], right: &[Call], at: usize, reference: &Outcome, ours: &Outcome) -> Difference {
    let show = |calls: &[Call]| calls.get(at).map_or_else(|| "nothing more".to_owned(), Call::to_string);
    let (expected, got) = (show(left), show(right));
    let title = if expected == got {
        format!("reference {}, we {}", end(&reference.end), end(&ours.end))
    } else {
        format!("call {}: reference `{expected}`, we `{got}`", at + 1)
    };
    let name = |calls: &[Call]| calls.get(at).map_or("-", Call::name).to_owned();
    let kind =
        [name(left), name(right), word(&reference.end).to_owned(), word(&ours.end).to_owned()].join(" ");
    let mut text = format!("{title}\n");
    // Writing to a string cannot fail.
    let shared = left.get(at.saturating_sub(BEFORE)..at).unwrap_or(&[]);
    for call in shared {
        let _ = writeln!(text, "    {call}");
    }
    for (sign, calls) in [('-', left), ('+', right)] {
        for call in calls.iter().skip(at).take(BEHIND) {
            let _ = writeln!(text, "  {sign} {call}");
        }
    }
    let _ = writeln!(text, "  - {}", end(&reference.end));
    let _ = writeln!(text, "  + {}", end(&ours.end));
    Difference { kind, title, text }
}

fn word(end: &End) -> &'static str {
    match end {
        End::Ended => "ended",
        End::Refused(_) => "refused",
        End::Endless => "did not end",
        End::Broken(_) => "could not run",
    }
}

fn end(end: &End) -> String {
    match end {
        End::Ended | End::Endless => word(end).to_owned(),
        End::Refused(message) | End::Broken(message) => format!("{} ({message})", word(end)),
    }
}

#[test]
fn the_counter_comments_and_the_last_digit_do_not_count() {
    let left = Outcome {
        calls: read(
            "    7 N10    STRAIGHT_FEED(1.0000, -0.0000)\n    8 N10    COMMENT(\"a\")\n    9 N..... ON_RESET()\n",
        ),
        end: End::Ended,
    };
    let right = Outcome {
        calls: read("executing\n   12 N10    STRAIGHT_FEED(1.0001 0.0000)\n   13 N..... ON_RESET()\n"),
        end: End::Ended,
    };
    assert_eq!(compare(&left, &right), None);
}

#[test]
fn names_blocks_numbers_and_ends_count() {
    let outcome = |printed: &str, end: End| Outcome { calls: read(printed), end };
    let base = outcome("1 N10 STRAIGHT_FEED(1.0000)\n", End::Ended);
    for other in [
        outcome("1 N10 STRAIGHT_TRAVERSE(1.0000)\n", End::Ended),
        outcome("1 N20 STRAIGHT_FEED(1.0000)\n", End::Ended),
        outcome("1 N10 STRAIGHT_FEED(1.0002)\n", End::Ended),
        outcome("1 N10 STRAIGHT_FEED(1.0000, 0.0000)\n", End::Ended),
        outcome("", End::Ended),
        outcome("1 N10 STRAIGHT_FEED(1.0000)\n", End::Refused("no".to_owned())),
        outcome("1 N10 STRAIGHT_FEED(1.0000)\n", End::Endless),
        outcome("1 N10 STRAIGHT_FEED(1.0000)\n", End::Broken("no".to_owned())),
    ] {
        assert!(compare(&base, &other).is_some(), "{other:?}");
    }
}

#[test]
fn of_a_refused_block_only_the_refusal_counts() {
    let refused = |printed: &str| Outcome { calls: read(printed), end: End::Refused(String::new()) };
    let reset = "3 N..... ON_RESET()\n";
    let early = refused(&format!("1 N10 DWELL(1.0000)\n{reset}"));
    let late = refused(&format!("1 N10 DWELL(1.0000)\n2 N20 SET_FEED_RATE(1.0000)\n{reset}"));
    let later = refused(&format!("1 N10 DWELL(1.0000)\n2 N20 FLOOD_ON()\n3 N30 FLOOD_OFF()\n{reset}"));
    assert_eq!(compare(&early, &late), None);
    assert!(compare(&early, &later).is_some());
}
