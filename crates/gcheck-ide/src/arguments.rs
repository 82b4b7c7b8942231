//! What a macro takes, as its own text tells: the arguments that it reads, and what its comments say of them.
//!
//! Knows: arguments as local variables, comments beside them. Must not know: how calls are written or shown.

use std::ops::Range;

use gcheck_controls::{Code, Control};
use gcheck_db::Snapshot;
use gcheck_program::OLabel;
use gcheck_syntax::ast::{Block, Expr, Statement};

use crate::remarks::is_directive;
use crate::symbols::{Occurrence, Symbol, all_variables, program_around, subs};
use crate::typing::Typing;
use crate::{ReferenceKind, Workspace};

/// Bytes of a file that is read for its arguments while somebody types.
const LARGE: u32 = 256 << 10;
/// The variable that raises an alarm of the macro's own when it is set.
const ALARM: u32 = 3_000;
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
    code.effect().calls_macro()
}

/// The program that a macro call of the block names.
pub(crate) fn called(typing: &Typing<'_>, code: Code<'_>) -> Option<u32> {
    if !is_call(code) {
        return None;
    }
    typing.words().find(|word| word.letter() == Some('P'))?.integer()
}

/// The arguments that a part of a file reads, of those that it may be given, in the order of their variables.
fn taken_by(
    snapshot: &Snapshot,
    program: &Range<u32>,
    given: impl Iterator<Item = (String, u8)>,
) -> Vec<Argument> {
    let all = all_variables(snapshot);
    let mut text = None;
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
        let text = text.get_or_insert_with(|| MacroText::of(snapshot, program));
        found.push(Argument {
            is_needed: !text.does_without(variable),
            says: text.says(&occurrences, &letter, variable),
            letter,
            variable,
        });
    }
    found.sort_by_key(|argument: &Argument| argument.variable);
    found
}

/// What the text of a macro tells of its arguments.
#[derive(Default)]
struct MacroText {
    /// Comments for people, the first of each block, with the block's bytes of the file.
    comments: Vec<(Range<u32>, String)>,
    /// Blocks that ask whether a variable was given.
    tests: Vec<Test>,
    /// Sequence numbers of blocks that raise an alarm of the macro's own.
    alarms: Vec<u32>,
}

/// `IF [#7 EQ #0] …`
struct Test {
    variable: u32,
    /// The block raises an alarm of the macro's own.
    is_alarm: bool,
    /// The sequence number that the block jumps to.
    target: Option<u32>,
}

impl MacroText {
    fn of(snapshot: &Snapshot, program: &Range<u32>) -> Self {
        let mut this = Self::default();
        for chunk in snapshot.chunks() {
            let end = program.end.min(chunk.base + chunk.text.len() as u32);
            let start = program.start.max(chunk.base);
            let Some(tree) = (start < end).then(|| snapshot.tree_at(start)).flatten() else { continue };
            for block in tree.blocks(start..end) {
                this.block(&block, tree.in_file(block.range()));
            }
        }
        this
    }

    fn block(&mut self, block: &Block, range: Range<u32>) {
        let comment = block.comments().next().map(|comment| comment.text().trim().to_owned());
        let says_something = |comment: &String| !comment.is_empty() && !is_directive(comment);
        self.comments.extend(comment.filter(says_something).map(|comment| (range, comment)));
        let is_alarm = block.all_statements().any(|statement| {
            let Statement::Assignment(assignment) = statement else { return false };
            assignment.target().and_then(|target| target.number()) == Some(ALARM)
        });
        if is_alarm {
            let number = block.words().find(|word| word.letter() == Some('N'));
            self.alarms.extend(number.and_then(|number| number.integer()));
        }
        let target = block.all_statements().find_map(|statement| match statement {
            Statement::Goto(goto) => match goto.target()? {
                Expr::Number(number) => number.integer(),
                _ => None,
            },
            _ => None,
        });
        let tested = block.expressions().filter_map(|expression| tested(&expression));
        self.tests.extend(tested.map(|variable| Test { variable, is_alarm, target }));
    }

    /// Does the macro ask whether the argument was given (`IF [#7 EQ #0] …`), and go on without it?
    fn does_without(&self, variable: u8) -> bool {
        let raises_alarm =
            |test: &Test| test.is_alarm || test.target.is_some_and(|target| self.alarms.contains(&target));
        self.tests.iter().any(|test| test.variable == u32::from(variable) && !raises_alarm(test))
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
        let named = || self.comments.iter().find_map(|(_, comment)| of_variable(comment));
        let lettered = || self.comments.iter().find_map(|(_, comment)| of_letter(comment));
        let beside = || {
            occurrences.iter().find_map(|occurrence| {
                let of_block = |(block, _): &&(Range<u32>, String)| block.contains(&occurrence.range.start);
                self.comments.iter().find(of_block).map(|(_, comment)| comment.clone())
            })
        };
        named().or_else(lettered).or_else(beside)
    }
}

/// The variable that an expression compares with the one that is always empty.
fn tested(expression: &Expr) -> Option<u32> {
    let Expr::Binary(test) = expression else { return None };
    let operator = test.operator()?;
    let is_equality = ["EQ", "NE"].iter().any(|name| operator.text().eq_ignore_ascii_case(name));
    let empty = test.right()?.as_variable()?.number()?;
    test.left()?.as_variable()?.number().filter(|_| is_equality && empty == 0)
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
