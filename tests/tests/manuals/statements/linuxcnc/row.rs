//! Statements and proofs of this manual in short form.
//!
//! Knows: that its programs run on LinuxCNC. Must not know: statements.

use super::super::statement::{Held, Statement};
use crate::proof::{Program, Proof, on};

/// A program for LinuxCNC.
pub(super) const fn ngc(text: &'static str) -> Program {
    on("linuxcnc", text)
}

/// A statement that is held.
pub(super) const fn held(
    at: &'static str,
    says: &'static str,
    what: &'static str,
    proofs: &'static [Proof],
) -> Statement {
    Statement { at, says, held: Held::By { what, proofs } }
}

/// A statement that is not held so far.
pub(super) const fn gap(
    at: &'static str,
    says: &'static str,
    wants: &'static str,
    proofs: &'static [Proof],
) -> Statement {
    Statement { at, says, held: Held::Gap { wants, proofs } }
}

/// A statement that is not modelled.
pub(super) const fn unmodelled(at: &'static str, says: &'static str, reason: &'static str) -> Statement {
    Statement { at, says, held: Held::NotModelled(reason) }
}

/// The interpreter and the product run the text alike; these functions are among those that they print.
pub(super) const fn runs(text: &'static str, prints: &'static [&'static str]) -> Proof {
    Proof::AsInterpreter { program: ngc(text), prints }
}

/// The same, with files beside the program and keys of a configuration.
pub(super) const fn runs_with(program: Program, prints: &'static [&'static str]) -> Proof {
    Proof::AsInterpreter { program, prints }
}

/// The interpreter, the product and a rule refuse the first text, not the second.
pub(super) const fn refused(finding: &'static str, violates: &'static str, conforms: &'static str) -> Proof {
    Proof::Refused { finding, violates: ngc(violates), conforms: ngc(conforms) }
}

/// A rule speaks of the first text and not of the second.
pub(super) const fn rule(finding: &'static str, violates: &'static str, conforms: &'static str) -> Proof {
    Proof::Rule { finding, violates: ngc(violates), conforms: ngc(conforms) }
}

/// No error and no warning.
pub(super) const fn legal(text: &'static str) -> Proof {
    Proof::Legal { program: ngc(text) }
}

/// The explanation of a code has these words.
pub(super) const fn explains(code: &'static str, says: &'static str) -> Proof {
    Proof::Explains { control: "linuxcnc", code, says }
}

/// The interpreter and `gcheck run` refuse the text.
pub(super) const fn stops(text: &'static str) -> Proof {
    Proof::RunRefused { program: ngc(text) }
}

/// With a tool table on disk that has tool 1 alone; lengths in inches, as the interpreter reads them.
pub(super) const fn with_table(text: &'static str) -> Program {
    ngc(text)
        .with(&["tools.table=\"tool.tbl\"", "machine.table_units=\"inch\""])
        .beside(&[("tool.tbl", "T1 P1 D0.125 Z0.5\n")])
}
