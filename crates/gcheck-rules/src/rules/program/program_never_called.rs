//! A subprogram that nothing in its file calls.

use std::collections::BTreeSet;

use gcheck_controls::Ends;
use gcheck_program::{CallKind, OKeyword, OLabel};

use crate::declare::declare_rule;
use crate::facts::sections::{keeps_programs_by_number, sections};
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// The file holds a main program and a subprogram that no call in the file names.
    ///
    /// ## Why it matters
    /// A call may have been lost, or its number changed. A subprogram that nothing calls can be removed.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// M98 P2
    /// M30
    /// O0002
    /// M99
    /// O0003
    /// M99
    /// ```
    /// ```nc,reported,linuxcnc
    /// o100 sub
    /// o100 endsub
    /// o200 sub
    /// o200 endsub
    /// o100 call
    /// M2
    /// ```
    /// ## Not reported
    /// A file with subprograms only, and one whose calls are computed.
    /// ```nc,quiet,fanuc-mill
    /// O0002
    /// M99
    /// O0003
    /// M99
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// M98 P#500
    /// M30
    /// O0003
    /// M99
    /// ```
    rule "program-never-called" in "program" {
        summary: "subprogram that nothing in the file calls",
        severity: Info,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let file_index = cx.file_index;
    // Without any call the programs are only stored in one file.
    if file_index.calls.is_empty() || file_index.has_mistakes {
        return;
    }
    let is_computed =
        |target: &CallKind| matches!(target, CallKind::Unknown | CallKind::OWord(OLabel::Computed));
    if file_index.calls.iter().any(|call| is_computed(&call.target)) {
        return;
    }
    if keeps_programs_by_number(cx) {
        numbered(cx, report);
    }
    // The profile of a turning cycle is a subroutine.
    let reads_profiles = file_index.codes.iter().any(|(number, _)| {
        let code = cx.control().code_at(cx.control().code_ix(*number));
        code.is_some_and(|code| code.effect().cuts_profile())
    });
    if cx.control().syntax().o_words && !reads_profiles {
        o_words(cx, report);
    }
}

fn numbered(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let file_index = cx.file_index;
    let called: BTreeSet<u32> = file_index
        .calls
        .iter()
        .filter_map(|call| match call.target {
            CallKind::Program(number) => Some(number),
            _ => None,
        })
        // The number of repeats may come before the program number.
        .flat_map(|number| [number, number % 10_000])
        .collect();
    let ends_in = |range: &std::ops::Range<u32>, ends: Ends| {
        file_index.ends.iter().any(|end| end.ends == ends && range.contains(&end.range.start))
    };
    let sections = sections(cx);
    // Only calls of a main program in this file matter.
    if !sections.first().is_some_and(|main| ends_in(&main.range, Ends::Program)) {
        return;
    }
    for section in sections.iter().skip(1) {
        let Some(number) = section.number else { continue };
        let Some(value) = number.number else { continue };
        let is_subprogram =
            ends_in(&section.range, Ends::Subprogram) && !ends_in(&section.range, Ends::Program);
        // Programs from 8000 up may be called by a code of the control's parameters.
        if is_subprogram && !called.contains(&value) && value < 8000 {
            let written = cx.slice(number.range.clone());
            report.add(
                Finding::new(&META, number.range.clone(), format!("nothing in this file calls `{written}`"))
                    .label("never called")
                    .help("add the missing call, or remove the subprogram"),
            );
        }
    }
}

fn o_words(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let file_index = cx.file_index;
    let calls = |label: &OLabel| {
        file_index.calls.iter().any(|call| matches!(&call.target, CallKind::OWord(called) if called == label))
            || matches!(label, OLabel::Number(n) if file_index.calls.iter().any(|c| c.target == CallKind::Program(*n)))
    };
    let mut subs = file_index.o_words.iter().filter(|o| o.keyword == OKeyword::Sub);
    // A library may have a main program for tests; one that calls its own subroutines is a program.
    if !subs.any(|sub| calls(&sub.label)) || !file_index.ends.iter().any(|end| end.ends == Ends::Program) {
        return;
    }
    // If a file is one subroutine, its own name calls it.
    let own = file_index.first_block.as_ref().map(|first| first.start);
    for sub in file_index
        .o_words
        .iter()
        .filter(|o| o.keyword == OKeyword::Sub && own.is_none_or(|own| o.range.start > own))
    {
        if sub.label != OLabel::Computed && !calls(&sub.label) {
            let name = match &sub.label {
                OLabel::Number(number) => format!("o{number}"),
                OLabel::Name(name) => format!("o<{name}>"),
                OLabel::Computed => continue,
            };
            report.add(
                Finding::new(&META, sub.range.clone(), format!("nothing in this file calls `{name}`"))
                    .label("never called")
                    .help("add the missing call, or remove the subroutine"),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_head_of_the_program_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nM98 P2\nM30\nO2\nM99\nO3\nM99\n",
            &expect![[r#"
            6 | O3
              | ^^ info[program-never-called] nothing in this file calls `O3`
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "o<a> sub\no<a> endsub\no<b> sub\no<b> endsub\no<a> call\nM2\n",
            &expect![[r#"
                3 | o<b> sub
                  | ^^^^^^^^ info[program-never-called] nothing in this file calls `o<b>`
            "#]],
        );
    }

    #[test]
    fn other_main_programs_are_started_by_hand() {
        check_rule(&RULE, "haas-mill", "O1\nM98 P2\nM30\nO2\nM99\nO3\nM30\n", &expect![[""]]);
    }

    #[test]
    fn packed_repeats_and_macro_calls_count() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nM98 P30002\nG65 P3 A1.\nG66 P4\nM30\nO2\nM99\nO3\nM99\nO4\nM99\n",
            &expect![[""]],
        );
    }
}
