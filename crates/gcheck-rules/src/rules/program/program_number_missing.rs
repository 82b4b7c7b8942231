//! A program without its `O` number.

use std::ops::Range;

use gcheck_controls::Ends;
use gcheck_program::EndMark;

use crate::declare::declare_rule;
use crate::facts::sections::keeps_programs_by_number;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// The file is a whole program, but has no `O` number.
    ///
    /// ## Why it matters
    /// A control that keeps programs by number either refuses such a file when it is loaded or gives it a number
    /// itself, which can overwrite another program.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// %
    /// G90 G54 G0 X0. Y0.
    /// M30
    /// %
    /// ```
    /// ## Not reported
    /// A fragment without tape marks or program end, and controls where `O` does not number programs.
    /// ```nc,quiet,fanuc-mill
    /// G90 G54 G0 X0. Y0.
    /// ```
    /// ```nc,quiet,linuxcnc
    /// %
    /// G90 G54 G0 X0. Y0.
    /// M30
    /// %
    /// ```
    rule "program-number-missing" in "program" {
        summary: "program has no number",
        severity: Info,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    // Numbered subprograms may follow a main program without a number.
    let numbered = cx.file_index.programs.first().map_or(u32::MAX, |number| number.range.start);
    let ends = |end: &EndMark| end.ends == Ends::Program && end.range.end <= numbered;
    let is_whole = cx.file_index.tape_marks.len() == 2 && cx.file_index.ends.iter().any(ends);
    if is_whole
        && keeps_programs_by_number(cx)
        && let Some(first) = &cx.file_index.first_block
    {
        report.add(finding(first.clone()));
    }
}

fn finding(first: Range<u32>) -> Finding {
    Finding::new(&META, first, "program has no number")
        .label("the program begins here without `O` and a number")
        .note("a control that keeps programs by number refuses the file or numbers it itself when it is loaded  [general knowledge]")
        .help("put the program's number in a block of its own at the head, for example `O1234`")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_block_is_shown() {
        check_rule(
            &RULE,
            "haas-lathe",
            "%\n(PART)\nG28 U0.\nM30\n%\n",
            &expect![[r#"
            3 | G28 U0.
              | ^^^^^^^ info[program-number-missing] program has no number
        "#]],
        );
    }

    #[test]
    fn numbered_subprograms_do_not_name_the_main_program() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "%\n(PART)\nM98 P10\nM30\nO10\nG0 X1.\nM99\n%\n",
            &expect![[r#"
                3 | M98 P10
                  | ^^^^^^^ info[program-number-missing] program has no number
            "#]],
        );
        check_rule(&RULE, "fanuc-mill", "%\nG0 X1.\nO10\nM30\n%\n", &expect![[""]]);
    }

    #[test]
    fn a_colon_or_a_sequence_number_in_front_does_not_matter() {
        check_rule(&RULE, "fanuc-mill", "%\n:0012\nM30\n%\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", "%\nN1 O12\nM30\n%\n", &expect![[""]]);
    }
}
