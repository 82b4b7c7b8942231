//! Rows and proofs of the Haas mill in one call each.
//!
//! Knows: the control that the manual is about. Must not know: any statement.

use crate::proof::{Program, Proof, on};
use crate::statements::statement::{Held, Statement};

/// A statement that something holds.
pub(super) const fn held(
    at: &'static str,
    says: &'static str,
    what: &'static str,
    proofs: &'static [Proof],
) -> Statement {
    Statement { at, says, held: Held::By { what, proofs } }
}

/// A statement that is wrong or missing so far, and what should happen.
pub(super) const fn gap(
    at: &'static str,
    says: &'static str,
    wants: &'static str,
    proofs: &'static [Proof],
) -> Statement {
    Statement { at, says, held: Held::Gap { wants, proofs } }
}

/// A statement that is not modelled, and why.
pub(super) const fn not_modelled(at: &'static str, says: &'static str, reason: &'static str) -> Statement {
    Statement { at, says, held: Held::NotModelled(reason) }
}

pub(super) const fn mill(text: &'static str) -> Program {
    on("haas-mill", text)
}

pub(super) const fn legal(text: &'static str) -> Proof {
    Proof::Legal { program: mill(text) }
}

/// A program on a machine with offsets and tools that are told.
pub(super) const fn told(text: &'static str) -> Program {
    mill(text).with(&[
        "machine.units=\"inch\"",
        "offsets.G54={X=-10,Y=-5,Z=-8}",
        "offsets.G55={X=-20,Y=-5,Z=-8}",
        "tools.1.length=3",
        "tools.1.diameter=0.5",
        "tools.2.length=4",
        "tools.2.diameter=1",
    ])
}

/// The moves of a program on that machine.
pub(super) const fn moves_told(text: &'static str, are: &'static [&'static str]) -> Proof {
    Proof::Moves { program: told(text), are }
}

/// The rule speaks of the first program, not of the second.
pub(super) const fn rule(finding: &'static str, violates: &'static str, conforms: &'static str) -> Proof {
    Proof::Rule { finding, violates: mill(violates), conforms: mill(conforms) }
}

pub(super) const fn reports(text: &'static str, findings: &'static [&'static str]) -> Proof {
    Proof::Reports { program: mill(text), findings }
}

pub(super) const fn says(text: &'static str, finding: &'static str, words: &'static str) -> Proof {
    Proof::Says { program: mill(text), finding, words }
}

pub(super) const fn moves(text: &'static str, are: &'static [&'static str]) -> Proof {
    Proof::Moves { program: mill(text), are }
}

pub(super) const fn run(text: &'static str, prints: &'static [&'static str]) -> Proof {
    Proof::Run { program: mill(text), prints }
}

pub(super) const fn stops(text: &'static str, says: &'static str) -> Proof {
    Proof::Stops { program: mill(text), says }
}

pub(super) const fn assumes(text: &'static str, says: &'static str) -> Proof {
    Proof::Assumes { program: mill(text), says }
}

/// The table lists these variables so.
pub(super) const fn variables(numbers: [u32; 2], title: &'static str, access: &'static str) -> Proof {
    Proof::Variables { control: "haas-mill", numbers, title, access }
}

pub(super) const fn explains(code: &'static str, says: &'static str) -> Proof {
    Proof::Explains { control: "haas-mill", code, says }
}
