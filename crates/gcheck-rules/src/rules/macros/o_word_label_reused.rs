//! A label of O-word flow control that is defined twice.

use std::collections::{HashMap, HashSet};

use gcheck_program::{OKeyword, OLabel, OWord};

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A label opens two structures of one subroutine, or names two subroutines of the file. Structures in different branches of
    /// one `if` may share a label, because only one of them runs.
    ///
    /// ## Why it matters
    /// The control keeps one place for each label and stops when the second definition runs.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// o100 if [#1 GT 0]
    /// o100 endif
    /// o100 if [#1 GT 5]
    /// o100 endif
    /// M2
    /// ```
    /// ## Not reported
    /// Each subroutine has its own labels.
    /// ```nc,quiet,linuxcnc
    /// o1 sub
    /// o100 if [#1 GT 0]
    /// o100 endif
    /// o1 endsub
    /// o100 if [#1 GT 5]
    /// o100 endif
    /// M2
    /// ```
    rule "o-word-label-reused" in "macros" {
        summary: "label of an O-word is defined twice",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if !cx.control().syntax().o_words {
        return;
    }
    // Definitions of the subroutines of the file, of the main program, and of the present subroutine.
    let mut subs: Known<'_> = Known::new();
    let mut main: Known<'_> = Known::new();
    let mut local: Known<'_> = Known::new();
    let mut in_sub = false;
    let mut open_dos: HashSet<&OLabel> = HashSet::new();
    // The open `if`s around a word, from the outside.
    let mut branches: Vec<Branch<'_>> = Vec::new();
    for word in &cx.file_index.o_words {
        match word.keyword {
            OKeyword::Sub => {
                define(cx, &mut subs, word, &[], report);
                in_sub = true;
                local.clear();
                branches.clear();
            }
            OKeyword::EndSub => {
                in_sub = false;
                branches.clear();
            }
            OKeyword::ElseIf | OKeyword::Else => {
                close(&mut branches, &word.label, |branch| branch.number += 1);
            }
            OKeyword::EndIf => {
                close(&mut branches, &word.label, |_| {});
                branches.pop_if(|branch| branch.opened.label == word.label);
            }
            OKeyword::While if open_dos.remove(&word.label) => {}
            OKeyword::If | OKeyword::While | OKeyword::Do | OKeyword::Repeat => {
                if word.keyword == OKeyword::Do {
                    open_dos.insert(&word.label);
                }
                define(cx, if in_sub { &mut local } else { &mut main }, word, &branches, report);
                if word.keyword == OKeyword::If {
                    branches.push(Branch { opened: word, number: 0 });
                }
            }
            _ => {}
        }
    }
}

/// Structures by label, each with the branches that it is in.
type Known<'s> = HashMap<&'s OLabel, Vec<(&'s OWord, Vec<Branch<'s>>)>>;

/// A branch of an `if`.
#[derive(Clone, Copy)]
struct Branch<'s> {
    /// The word that opens the `if`.
    opened: &'s OWord,
    /// The first is 0, and each `elseif` and `else` begins another.
    number: u32,
}

/// A word of the `if` with this label: those inside of it that have no end are over.
fn close<'s>(branches: &mut Vec<Branch<'s>>, label: &OLabel, then: impl FnOnce(&mut Branch<'s>)) {
    if let Some(at) = branches.iter().rposition(|branch| branch.opened.label == *label) {
        branches.truncate(at + 1);
        branches.last_mut().map(then);
    }
}

/// Are they in different branches of one `if`?
fn exclude(one: &[Branch<'_>], other: &[Branch<'_>]) -> bool {
    one.iter()
        .zip(other)
        .any(|(one, other)| one.opened.range == other.opened.range && one.number != other.number)
}

fn define<'s>(
    cx: &FileCx<'_>,
    known: &mut Known<'s>,
    word: &'s OWord,
    branches: &[Branch<'s>],
    report: &mut Report<'_>,
) {
    if word.label == OLabel::Computed {
        return;
    }
    let before = known.entry(&word.label).or_default();
    match before.iter().find(|(_, others)| !exclude(others, branches)) {
        Some((first, _)) => report.add(finding(cx, first, word)),
        None => before.push((word, branches.to_vec())),
    }
}

fn finding(cx: &FileCx<'_>, first: &OWord, second: &OWord) -> Finding {
    let label = match &second.label {
        OLabel::Number(number) => format!("o{number}"),
        OLabel::Name(name) => format!("o<{name}>"),
        OLabel::Computed => cx.slice(second.range.clone()).to_owned(),
    };
    Finding::new(&META, second.range.clone(), format!("label `{label}` is defined twice"))
        .label("defined again")
        .also(first.range.clone(), "first defined here")
        .note("a label opens one structure in a subroutine or main program; the second stops the program when it runs")
        .help("give the second structure, and its end, another label")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_do_loop_uses_its_label_twice_by_form() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 do\n#1=[#1+1]\no1 while [#1 LT 3]\no1 while [#1 LT 9]\no1 endwhile\n",
            &expect![[r#"
            4 | o1 while [#1 LT 9]
              | ^^^^^^^^^^^^^^^^^^ warning[o-word-label-reused] label `o1` is defined twice
        "#]],
        );
    }

    #[test]
    fn of_two_branches_only_one_runs() {
        let program = |middle: &str, end: &str| {
            format!(
                "o150 if [#1]\no175 if [#2]\no175 endif\n{middle}o175 if [#3]\no175 endif\no150 endif\n{end}M2\n"
            )
        };
        check_rule(&RULE, "linuxcnc", &program("o150 else\n", ""), &expect![[""]]);
        check_rule(&RULE, "linuxcnc", &program("o150 elseif [#4]\n", ""), &expect![[""]]);
        check_rule(
            &RULE,
            "linuxcnc",
            &program("", ""),
            &expect![[r#"
            4 | o175 if [#3]
              | ^^^^^^^^^^^^ warning[o-word-label-reused] label `o175` is defined twice
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            &program("o150 else\n", "o175 if [#5]\no175 endif\n"),
            &expect![[r#"
            8 | o175 if [#5]
              | ^^^^^^^^^^^^ warning[o-word-label-reused] label `o175` is defined twice
        "#]],
        );
    }

    #[test]
    fn subroutines_are_known_in_the_whole_file() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 sub\no1 endsub\no1 sub\no1 endsub\n",
            &expect![[r#"
            3 | o1 sub
              | ^^^^^^ warning[o-word-label-reused] label `o1` is defined twice
        "#]],
        );
    }

    #[test]
    fn the_first_definition_is_shown() {
        let found =
            findings(&only(&RULE), "linuxcnc", "o<A> sub\no<A> endsub\no<a> sub\n", &World::default());
        expect![[r#"
            label `o<a>` is defined twice
              here: defined again
              there: first defined here
              note: a label opens one structure in a subroutine or main program; the second stops the program when it runs
              help: give the second structure, and its end, another label
        "#]].assert_eq(&words(&found[0]));
    }
}
