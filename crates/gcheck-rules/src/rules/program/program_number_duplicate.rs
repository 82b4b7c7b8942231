//! Two programs of one file with the same number.

use gcheck_program::ProgramNumber;

use crate::declare::declare_rule;
use crate::facts::sections::keeps_programs_by_number;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// Two programs of the file have the same `O` number.
    ///
    /// ## Why it matters
    /// The control keeps one program for each number: it refuses the second, or the second replaces the first, and a call
    /// runs the wrong one.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// M98 P0002
    /// M30
    /// O0002
    /// M99
    /// O0002
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// M98 P0002
    /// M30
    /// O0002
    /// M99
    /// ```
    /// If `O` labels loops and subroutines, it repeats by nature.
    /// ```nc,quiet,linuxcnc
    /// O100
    /// O100
    /// M2
    /// ```
    rule "program-number-duplicate" in "program" {
        summary: "two programs have the same number",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if cx.file_index.programs.len() < 2 || !keeps_programs_by_number(cx) {
        return;
    }
    let mut programs: Vec<&ProgramNumber> =
        cx.file_index.programs.iter().filter(|p| p.number.is_some()).collect();
    programs.sort_by_key(|p| (p.number, p.range.start));
    for pair in programs.windows(2) {
        if let [first, second] = pair
            && first.number == second.number
        {
            report.add(finding(cx, first, second));
        }
    }
}

fn finding(cx: &FileCx<'_>, first: &ProgramNumber, second: &ProgramNumber) -> Finding {
    let written = cx.slice(second.range.clone());
    Finding::new(&META, second.range.clone(), format!("program number `{written}` is taken by another program"))
        .label("the same number again")
        .also(first.range.clone(), "first used here")
        .note("a control keeps one program for each number; it refuses the second or overwrites the first  [general knowledge]")
        .help("give one of the two programs another number, and correct its calls")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn leading_zeros_do_not_make_another_number() {
        check_rule(
            &RULE,
            "haas-mill",
            "O00010\nM30\nO10\nM99\n",
            &expect![[r#"
            3 | O10
              | ^^^ warning[program-number-duplicate] program number `O10` is taken by another program
        "#]],
        );
    }

    #[test]
    fn a_computed_number_is_not_compared() {
        check_rule(&RULE, "fanuc-mill", "O#1\nM30\nO#1\nM99\n", &expect![[""]]);
    }
}
