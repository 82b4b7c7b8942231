//! A label of O-word flow control that is defined twice.

use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};

use gcheck_program::{OKeyword, OLabel, OWord};

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A label opens two structures of one subroutine, or names two subroutines of the file.
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
    for word in &cx.file_index.o_words {
        match word.keyword {
            OKeyword::Sub => {
                define(cx, &mut subs, word, report);
                in_sub = true;
                local.clear();
            }
            OKeyword::EndSub => in_sub = false,
            OKeyword::While if open_dos.remove(&word.label) => {}
            OKeyword::If | OKeyword::While | OKeyword::Do | OKeyword::Repeat => {
                if word.keyword == OKeyword::Do {
                    open_dos.insert(&word.label);
                }
                define(cx, if in_sub { &mut local } else { &mut main }, word, report);
            }
            _ => {}
        }
    }
}

/// Structures by label.
type Known<'s> = HashMap<&'s OLabel, &'s OWord>;

fn define<'s>(cx: &FileCx<'_>, known: &mut Known<'s>, word: &'s OWord, report: &mut Report<'_>) {
    if word.label == OLabel::Computed {
        return;
    }
    match known.entry(&word.label) {
        Entry::Occupied(first) => report.add(finding(cx, first.get(), word)),
        Entry::Vacant(place) => {
            place.insert(word);
        }
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
