//! A call of an O-word subroutine that is not known.

use std::collections::HashSet;

use gcheck_program::{Call, CallKind, OKeyword, OLabel};

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run, Severity};

declare_rule! {
    /// `CALL` names a subroutine that is neither in the file nor beside it. Reported at the first call.
    ///
    /// ## Why it matters
    /// When the call runs, the control searches the file and its subroutine folders for the subroutine, and stops if it
    /// is missing.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// o100 sub
    /// o100 endsub
    /// o101 call
    /// M2
    /// ```
    /// ## Not reported
    /// Case and blanks do not matter in names, and a computed label is not known here.
    /// ```nc,quiet,linuxcnc
    /// o<Drill Hole> sub
    /// o<Drill Hole> endsub
    /// o<drillhole> call [1]
    /// o[#1] call
    /// M2
    /// ```
    rule "o-word-subroutine-missing" in "program" {
        summary: "called subroutine is not in the file or beside it",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if !cx.control().syntax().o_words || cx.file_index.calls.is_empty() {
        return;
    }
    let subs: HashSet<&OLabel> =
        cx.file_index.o_words.iter().filter(|o| o.keyword == OKeyword::Sub).map(|o| &o.label).collect();
    let programs: HashSet<u32> = cx.file_index.programs.iter().filter_map(|p| p.number).collect();
    let mut told: HashSet<&OLabel> = HashSet::new();
    let places = cx.places(cx.file_index.calls.iter().filter_map(|call| match &call.target {
        CallKind::OWord(label) => Some((label, call.range.clone())),
        _ => None,
    }));
    for call in &cx.file_index.calls {
        let CallKind::OWord(label) = &call.target else { continue };
        if told.contains(&label) {
            continue;
        }
        let here = || subs.contains(label);
        let known = match label {
            OLabel::Computed => true,
            OLabel::Number(number) => {
                here()
                    || programs.contains(number)
                    // In another file its name counts, not the number of a program in it.
                    || cx.environment.programs.has_name(&number.to_string())
            }
            OLabel::Name(name) => here() || cx.environment.programs.has_name(name),
        };
        if !known {
            told.insert(label);
            let same = places.get(label).map_or(&[][..], Vec::as_slice);
            // Thousands of missing names are not slips.
            let is_few = told.len() <= MOST_NAMES;
            let near = subs.iter().filter(|_| is_few).filter_map(|sub| near(label, sub)).min();
            report.add(cx.if_run(finding(call, label, near), same));
        }
    }
}

/// `near` is the name of a subroutine of the file that differs by a letter.
fn finding(call: &Call, label: &OLabel, near: Option<&str>) -> Finding {
    let (name, limit) = match label {
        OLabel::Number(number) => (format!("o{number}"), Severity::Warning),
        // A named subroutine usually is a file of its own in the control's folder.
        OLabel::Name(name) => (format!("o<{name}>"), Severity::Info),
        OLabel::Computed => (String::new(), Severity::Info),
    };
    let finding = Finding::new(&META, call.range.clone(), format!("called subroutine `{name}` is missing"))
        .label("called here")
        .note("gcheck searched this file and the folders that it was given")
        .assuming("the control's subroutine folders may have it as a file of its own");
    match near {
        Some(near) => finding.help(format!("did you mean `o<{near}>`, which this file has?")),
        None => finding
            .help("add the subroutine, correct its name, or name its folder in the configuration")
            .at_most(limit),
    }
}

/// The name of a subroutine that differs from the called one by a letter that is wrong, missing or too many. Names of a few
/// letters may be near by chance.
fn near<'s>(called: &OLabel, sub: &'s OLabel) -> Option<&'s str> {
    const SHORT: usize = 4;
    let (OLabel::Name(called), OLabel::Name(sub)) = (called, sub) else { return None };
    let is_near = called.len().min(sub.len()) >= SHORT
        && called.len().abs_diff(sub.len()) <= 1
        && strsim::levenshtein(called, sub) == 1;
    // `tap1` and `tap2`, `probe_x` and `probe_y` are two subroutines.
    let without_digits = |name: &str| name.replace(|c: char| c.is_ascii_digit(), "");
    let is_counted = without_digits(called) == without_digits(sub);
    let differs = called.chars().zip(sub.chars()).position(|(one, other)| one != other);
    let ends =
        |name: &str| differs.is_some_and(|at| matches!(name.chars().nth(at + 1), None | Some('_' | '-')));
    let is_lettered = called.len() == sub.len() && ends(called);
    (is_near && !is_counted && !is_lettered).then_some(sub)
}

/// Missing names that are compared with those of the file.
const MOST_NAMES: usize = 100;

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_number_is_expected_here_and_a_name_may_be_a_file() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o7 call\no<tool-probe> call [1] [2]\nM2\n",
            &expect![[r#"
                1 | o7 call
                  | ^^^^^^^ warning[o-word-subroutine-missing] called subroutine `o7` is missing
                2 | o<tool-probe> call [1] [2]
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^ info[o-word-subroutine-missing] called subroutine `o<tool-probe>` is missing
            "#]],
        );
    }

    #[test]
    fn a_name_that_is_nearly_one_of_the_file_is_a_slip() {
        let program = |called: &str| format!("o<hole> sub\no<hole> endsub\no<{called}> call\nM2\n");
        check_rule(
            &RULE,
            "linuxcnc",
            &program("holes"),
            &expect![[r#"
                3 | o<holes> call
                  | ^^^^^^^^^^^^^ warning[o-word-subroutine-missing] called subroutine `o<holes>` is missing
            "#]],
        );
        let lettered = "o<probe_x> sub\no<probe_x> endsub\no<probe_y> call\nM2\n";
        check_rule(
            &RULE,
            "linuxcnc",
            lettered,
            &expect![[r#"
                3 | o<probe_y> call
                  | ^^^^^^^^^^^^^^^ info[o-word-subroutine-missing] called subroutine `o<probe_y>` is missing
            "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            &program("hole2"),
            &expect![[r#"
                3 | o<hole2> call
                  | ^^^^^^^^^^^^^ info[o-word-subroutine-missing] called subroutine `o<hole2>` is missing
            "#]],
        );
    }

    #[test]
    fn flow_control_with_the_same_label_is_no_subroutine() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o7 if [1 GT 0]\no7 endif\no7 call\nM2\n",
            &expect![[r#"
                3 | o7 call
                  | ^^^^^^^ warning[o-word-subroutine-missing] called subroutine `o7` is missing
            "#]],
        );
    }
}
