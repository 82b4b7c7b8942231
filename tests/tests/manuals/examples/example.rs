//! An example program of a manual, with what is expected of it.
//!
//! Knows: verdicts, numbers. Must not know: where a program is taken from.

use crate::product;
use crate::proof::{Program, Proof, holds};

/// What a reader of manual and program says of a finding.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    True,
    /// A gap: the finding goes, and with it this entry.
    False,
    Unsure,
}

/// A finding of today: `warning[feed-missing] 5`, and why the reader says what.
pub(super) struct Finding(pub(super) &'static str, pub(super) Verdict, pub(super) &'static str);

/// What text or figure of the manual state about a program, as numbers.
#[derive(Clone, Copy)]
pub(super) enum Shows {
    /// As [`Proof::Run`].
    Run(&'static [&'static str]),
    /// As [`Proof::Moves`].
    Moves(&'static [&'static str]),
    /// As [`Proof::Stops`].
    Stops(&'static str),
    /// This finding, with its line: the manual says that the control alarms or does not do what is meant.
    Finds(&'static str),
}

/// What is expected of a program.
pub(super) struct Expected {
    /// Every finding of today, in order.
    pub(super) findings: &'static [Finding],
    pub(super) shows: &'static [Shows],
    /// What the manual says and gcheck does not do yet: turns the test red when it does.
    pub(super) not_yet: &'static [Shows],
}

/// Counts over many examples.
#[derive(Default)]
pub(super) struct Tally {
    programs: usize,
    r#true: usize,
    r#false: usize,
    unsure: usize,
    shown: usize,
    not_yet: usize,
    failures: Vec<String>,
}

impl Tally {
    /// Checks and runs a program, and counts what comes of it.
    pub(super) fn add(&mut self, name: &str, program: &Program, expected: &Expected) {
        self.programs += 1;
        let found: Vec<String> = product::findings(program)
            .iter()
            .map(|one| format!("{} {}", product::severity_and_rule(one), one["range"]["start"]["line"]))
            .collect();
        let known: Vec<&str> = expected.findings.iter().map(|Finding(what, _, _)| *what).collect();
        if found != known {
            self.failures.push(format!("{name}: {found:?}, not {known:?}"));
        }
        for Finding(_, verdict, why) in expected.findings {
            assert!(!why.is_empty(), "{name}: a verdict has a reason");
            match verdict {
                Verdict::True => self.r#true += 1,
                Verdict::False => self.r#false += 1,
                Verdict::Unsure => self.unsure += 1,
            }
        }
        for one in expected.shows {
            self.shown += 1;
            if let Err(why) = is_shown(*one, program, &found) {
                self.failures.push(format!("{name}: {why}"));
            }
        }
        for one in expected.not_yet {
            self.not_yet += 1;
            if is_shown(*one, program, &found).is_ok() {
                self.failures.push(format!("{name}: holds now, so it moves to `shows`"));
            }
        }
    }

    /// Shows the counts, by `-- --nocapture`, and fails if anything did.
    #[expect(
        clippy::print_stdout,
        reason = "seen when asked for: what a test captures is shown by `--nocapture` only"
    )]
    pub(super) fn close(self, title: &str) {
        let counts = format!(
            "{title}: {} programs; findings {} true, {} false, {} unsure; {} statements shown, {} not yet",
            self.programs, self.r#true, self.r#false, self.unsure, self.shown, self.not_yet
        );
        println!("{counts}");
        assert!(self.failures.is_empty(), "{counts}\n{}", self.failures.join("\n"));
    }
}

fn is_shown(one: Shows, program: &Program, found: &[String]) -> Result<(), String> {
    let program = *program;
    match one {
        Shows::Run(prints) => holds(&Proof::Run { program, prints }),
        Shows::Moves(are) => holds(&Proof::Moves { program, are }),
        Shows::Stops(says) => holds(&Proof::Stops { program, says }),
        Shows::Finds(what) if found.iter().any(|one| one == what) => Ok(()),
        Shows::Finds(what) => Err(format!("{what} is not reported")),
    }
}
