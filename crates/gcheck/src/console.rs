//! What goes to standard error beside a command's output, and the exit code of a command that failed.
//!
//! Knows: how problems and remarks are printed. Must not know: any command.

use std::io::Write as _;

use crate::Problem;

/// Exit code of a command that could not do its work.
pub(crate) const FAILED: u8 = 2;

/// Prints a remark, if there is one.
pub(crate) fn say(text: &str) {
    let text = text.trim_end();
    if !text.is_empty() {
        // Names of files and lines of programs are others' text, which could steer a terminal. Without a standard error there
        // is no place for it.
        let _ = writeln!(std::io::stderr(), "{}", gcheck_report::harmless(text));
    }
}

/// Prints a problem.
pub(crate) fn report(problem: &Problem) {
    say(&format!("error: {problem}"));
}

/// Prints the problems, each once, and gives the exit code: `code` if there are none.
pub(crate) fn finish(problems: &[Problem], code: u8) -> u8 {
    let mut problems: Vec<&Problem> = problems.iter().collect();
    problems.sort();
    problems.dedup();
    for problem in &problems {
        report(problem);
    }
    if problems.is_empty() { code } else { FAILED }
}
