//! Where we differ from the reference on purpose.
//!
//! Knows: the programs that show it, each with the reason.
//! Must not know: how either side executes.
//!
//! `fixtures/oracle/deliberate` holds one program for each difference; its first comment says what we do, the next ones what
//! the reference does and why we do not. What we print is beside it, as `.canonical`: `UPDATE_EXPECT=1` rewrites it.
//! The list stays true: a program on which the reference no longer differs fails.

use std::env;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::canonical::{End, Outcome, compare};
use crate::own::{Program, programs};
use crate::product;
use crate::reference::{self, Reference};
use crate::report::{Failure, assert_none, on_each, wanted};
use crate::setup::Setup;

/// The area of these programs.
pub(crate) const AREA: &str = "deliberate";

/// What we print, as it is kept.
fn shown(outcome: &Outcome) -> String {
    let mut text = String::new();
    for call in &outcome.calls {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", call.to_string().trim_end());
    }
    text.push_str(match outcome.end {
        End::Ended => "ended\n",
        End::Refused(_) => "refused\n",
        End::Endless => "did not end\n",
        End::Broken(_) => "could not run\n",
    });
    text
}

fn mistake(reference: &Reference, program: &Program) -> Option<Failure> {
    let setup = Setup::own();
    let failure =
        |title: &str, text: String| Failure { name: program.name.clone(), title: title.to_owned(), text };
    let ours = product::execute(&program.path, &setup);
    let expected = reference.run_whole(&program.path, &setup);
    if compare(&expected, &ours).is_none() {
        return Some(failure("the reference does not differ any more", String::new()));
    }
    let kept: &Path = &program.path.with_extension("canonical");
    let got = shown(&ours);
    if env::var_os("UPDATE_EXPECT").is_some() {
        fs::write(kept, got).unwrap();
        return None;
    }
    let wanted = fs::read_to_string(kept).unwrap_or_default();
    (got != wanted).then(|| failure("we print something else", format!("expected:\n{wanted}\ngot:\n{got}")))
}

#[test]
fn differences_on_purpose_are_those_listed() {
    let Some(reference) = reference::find() else { return };
    let programs: Vec<Program> =
        programs().into_iter().filter(|p| p.area == AREA && wanted(&p.name)).collect();
    let failures: Vec<Failure> =
        on_each(&programs, |program| mistake(&reference, program)).into_iter().flatten().collect();
    assert_none(&failures, programs.len());
}

#[test]
fn differences_on_purpose_say_why() {
    for Program { name, area, path } in programs() {
        if area == AREA {
            let text = fs::read_to_string(path).unwrap();
            let comments = text.lines().take_while(|line| line.starts_with('(')).count();
            assert!(comments >= 2, "{name} says what the reference does");
        }
    }
}
