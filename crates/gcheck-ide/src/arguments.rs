//! What a macro takes, as its own text tells: the arguments that it reads, and what its comments say of them.
//!
//! Knows: arguments as local variables, comments beside them. Must not know: how calls are written or shown.

use std::ops::Range;

use gcheck_controls::{Code, Control, Effect, Letter};
use gcheck_db::Snapshot;
use gcheck_program::{OLabel, remark};
use gcheck_syntax::SyntaxKind;

use crate::remarks::is_directive;
use crate::symbols::{Occurrence, Symbol, all_variables, program_around, subs};
use crate::typing::Typing;
use crate::{ReferenceKind, Workspace};

/// Bytes of a file that is read for its arguments while somebody types.
const LARGE: u32 = 256 << 10;
/// Arguments that a call of an O-word may have.
const MOST_ARGUMENTS: u8 = 30;

/// An argument of a macro.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Argument {
    /// The address that gives it; none for an argument of an O-word, which its place gives.
    pub(crate) letter: String,
    /// The local variable that it becomes.
    pub(crate) variable: u8,
    /// The macro reads it and does nothing for a call without it.
    pub(crate) is_needed: bool,
    /// What the macro's comments say of it.
    pub(crate) says: Option<String>,
}

/// The arguments of program `number`, in the order of their variables; `None` where no such program is known, or it is too
/// large to be read.
pub(crate) fn arguments(workspace: &Workspace, control: &Control, number: u32) -> Option<Vec<Argument>> {
    let (snapshot, head) = workspace.files.iter().find_map(|file| {
        let programs = &file.snapshot.file_index().programs;
        let program = programs.iter().find(|program| program.number == Some(number))?;
        Some((&file.snapshot, program.range.start))
    })?;
    if snapshot.len() > LARGE {
        return None;
    }
    let program = program_around(snapshot, head);
    let letters = &control.semantics().argument_letters;
    let taken = letters.iter().map(|(letter, variable)| (letter.clone(), *variable));
    Some(taken_by(snapshot, &program, taken))
}

/// The arguments of a subroutine of O-words, up to the last that it reads; they have no letters. `None` where no such subroutine is
/// known, or its file is too large to be read.
pub(crate) fn arguments_of_sub(workspace: &Workspace, label: &OLabel) -> Option<Vec<Argument>> {
    let (snapshot, range) = workspace.files.iter().find_map(|file| {
        let sub = subs(&file.snapshot).into_iter().find(|sub| sub.label == *label)?;
        Some((&file.snapshot, sub.range))
    })?;
    if snapshot.len() > LARGE {
        return None;
    }
    let read = taken_by(snapshot, &range, (1..=MOST_ARGUMENTS).map(|variable| (String::new(), variable)));
    let last = read.last().map_or(0, |argument| argument.variable);
    // The arguments of a call have places: one that is not read has one as well.
    let all = (1..=last).map(|variable| {
        let known = read.iter().find(|argument| argument.variable == variable).cloned();
        known.unwrap_or(Argument { letter: String::new(), variable, is_needed: false, says: None })
    });
    Some(all.collect())
}

/// Does a code call a macro?
pub(crate) fn is_call(code: Code<'_>) -> bool {
    matches!(code.effect(), Effect::MacroCall | Effect::MacroModal)
}

/// The program that a macro call of the block names.
pub(crate) fn called(typing: &Typing<'_>, code: Code<'_>) -> Option<u32> {
    if !is_call(code) {
        return None;
    }
    let names_program = |lexeme: &&crate::lexemes::Lexeme| typing.letter(lexeme) == Some(Letter::of('P'));
    let word = typing.line.iter().filter(|lexeme| lexeme.kind == SyntaxKind::WORD).find(names_program)?;
    typing.snapshot.slice(word.range.clone()).get(1..)?.trim().trim_end_matches('.').parse().ok()
}

/// The arguments that a part of a file reads, of those that it may be given, in the order of their variables.
fn taken_by(
    snapshot: &Snapshot,
    program: &Range<u32>,
    given: impl Iterator<Item = (String, u8)>,
) -> Vec<Argument> {
    let all = all_variables(snapshot);
    let mut found = Vec::new();
    for (letter, variable) in given {
        let of_it = |occurrence: &&Occurrence| {
            program.contains(&occurrence.range.start)
                && matches!(occurrence.symbol, Symbol::Variable { number, .. } if number == u32::from(variable))
        };
        let occurrences: Vec<&Occurrence> = all.iter().filter(of_it).collect();
        let line = |occurrence: &Occurrence| snapshot.line_at(occurrence.range.start);
        let written = occurrences.iter().find(|occurrence| occurrence.kind == ReferenceKind::Write);
        // What the macro sets before it reads it is its own, not an argument.
        let is_read = |occurrence: &&&Occurrence| {
            occurrence.kind == ReferenceKind::Read
                && written.is_none_or(|written| line(occurrence) <= line(written))
        };
        if !occurrences.iter().any(|occurrence| is_read(&occurrence)) {
            continue;
        }
        let lines = Lines { snapshot, program: program.clone() };
        found.push(Argument {
            is_needed: !lines.does_without(&occurrences, variable),
            says: lines.says(&occurrences, &letter, variable),
            letter,
            variable,
        });
    }
    found.sort_by_key(|argument: &Argument| argument.variable);
    found
}

/// The lines of a macro.
struct Lines<'s> {
    snapshot: &'s Snapshot,
    program: Range<u32>,
}

impl Lines<'_> {
    fn all(&self) -> impl Iterator<Item = String> {
        let first = self.snapshot.line_at(self.program.start);
        let last = self.snapshot.line_at(self.program.end.saturating_sub(1).max(self.program.start));
        (first..=last).map(|line| self.snapshot.line_text(line).into_owned())
    }

    /// Does the macro ask whether the argument was given (`IF [#7 EQ #0] …`), and go on without it?
    fn does_without(&self, occurrences: &[&Occurrence], variable: u8) -> bool {
        occurrences.iter().any(|occurrence| {
            let line = self.snapshot.line_text(self.snapshot.line_at(occurrence.range.start));
            let plain = squeezed(&line);
            let asks = ["EQ#0]", "NE#0]"].iter().any(|test| plain.contains(&format!("#{variable}{test}")));
            asks && !self.ends_in_an_alarm(&plain)
        })
    }

    /// Does a statement, or the block that it jumps to, raise an alarm of the macro's own?
    fn ends_in_an_alarm(&self, statement: &str) -> bool {
        let alarm = |text: &str| text.contains("#3000=");
        let label = statement.split_once("GOTO").map(|(_, label)| {
            let end = label.find(|c: char| !c.is_ascii_digit()).unwrap_or(label.len());
            format!("N{}", label.get(..end).unwrap_or_default())
        });
        let jumps_to_alarm = |label: String| {
            self.all().any(|line| {
                let plain = squeezed(&line);
                let rest = plain.strip_prefix(&label);
                rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()) && alarm(rest))
            })
        };
        alarm(statement) || label.is_some_and(jumps_to_alarm)
    }

    /// A comment that names the variable or begins with the letter; else one beside the first use.
    fn says(&self, occurrences: &[&Occurrence], letter: &str, variable: u8) -> Option<String> {
        let name = format!("#{variable}");
        let of_variable = |comment: &str| {
            let (before, after) = comment.split_once(&name)?;
            let is_it = !after.starts_with(|c: char| c.is_ascii_digit());
            // `A=#1 DIAMETER`, `DIAMETER (#1)`, `#1 - DIAMETER`.
            let before = trimmed(before);
            let before = before.strip_suffix(letter).map_or(before, trimmed);
            let (before, after) = (trimmed(before), trimmed(after));
            let text = if after.is_empty() { before } else { after };
            (is_it && !text.is_empty()).then(|| text.to_owned())
        };
        let of_letter = |comment: &str| {
            let rest = comment.strip_prefix(letter).filter(|_| !letter.is_empty())?.trim_start();
            let rest = rest.strip_prefix(['=', ':', '-'])?;
            Some(trimmed(rest).to_owned()).filter(|text| !text.is_empty())
        };
        let said = |line: &str| remark(line).filter(|comment| !is_directive(comment)).map(str::to_owned);
        let comments: Vec<String> = self.all().filter_map(|line| said(&line)).collect();
        let named = || comments.iter().find_map(|comment| of_variable(comment));
        let lettered = || comments.iter().find_map(|comment| of_letter(comment));
        let beside = || {
            occurrences.iter().find_map(|occurrence| {
                let line = self.snapshot.line_text(self.snapshot.line_at(occurrence.range.start));
                said(&line)
            })
        };
        named().or_else(lettered).or_else(beside)
    }
}

/// A line without blanks and comments, in capitals.
fn squeezed(line: &str) -> String {
    let code = line.find(['(', ';']).map_or(line, |at| line.get(..at).unwrap_or(line));
    code.chars().filter(|c| !c.is_whitespace()).map(|c| c.to_ascii_uppercase()).collect()
}

/// Without blanks and the signs that join a name and its meaning.
fn trimmed(text: &str) -> &str {
    text.trim_matches(|c: char| c.is_whitespace() || matches!(c, '=' | ':' | '-' | ',' | '(' | ')'))
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::arguments;
    use crate::fixture::Fixture;

    fn check(text: &str, expected: &Expect) {
        let fixture = Fixture::new("fanuc-mill", text);
        let control = fixture.snapshot().control().clone();
        let shown = match arguments(&fixture.workspace, &control, 9010) {
            None => "not known\n".to_owned(),
            Some(list) => list
                .into_iter()
                .map(|argument| {
                    let needed = if argument.is_needed { "" } else { ", may be left out" };
                    let says = argument.says.map(|text| format!(": {text}")).unwrap_or_default();
                    format!("{} #{}{needed}{says}\n", argument.letter, argument.variable)
                })
                .collect(),
        };
        expected.assert_eq(&shown);
    }

    #[test]
    fn what_a_macro_reads_is_an_argument() {
        check(
            "O9010 (BOLT CIRCLE)\n#100=#1*2.\n#3=5.\nG0 X#3 Y[#4+#24]\nM99\nO9011\nG0 Z#26\nM99\n",
            &expect![[r#"
                A #1
                I #4
                X #24
            "#]],
        );
        check("O9011\nG0 X#1\nM99\n", &expect![["not known\n"]]);
    }

    #[test]
    fn comments_say_what_it_is() {
        check(
            "O9010\n(A=#1 DIAMETER)\n(DEPTH #26)\n(S - SPEED)\nG0 X#1 Z#26 (DOWN)\nS#19\nF#9 (FEED OF THE CUT)\nM99\n",
            &expect![[r#"
                A #1: DIAMETER
                F #9: FEED OF THE CUT
                S #19: SPEED
                Z #26: DEPTH
            "#]],
        );
    }

    #[test]
    fn what_has_a_default_may_be_left_out() {
        check(
            "O9010\nIF [#1 EQ #0] GOTO 900\nIF [#2 EQ #0] THEN #2=1.\nIF[#7EQ#0]GOTO5\nG0 X#1 Y#2\nN5 Z#7\nM99\nN900 #3000=1 (A MISSING)\n",
            &expect![[r#"
                A #1
                B #2, may be left out
                D #7, may be left out
            "#]],
        );
    }
}
