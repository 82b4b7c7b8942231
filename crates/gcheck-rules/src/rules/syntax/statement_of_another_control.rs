//! A statement of another control.

use gcheck_syntax::{ForeignForm, SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A statement, parameter or operator belongs to the language of another control.
    ///
    /// ## Why it matters
    /// The control refuses the block. Usually the program was posted for another machine.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// o100 call [1]
    /// #<depth>= 2.
    /// ```
    /// ```nc,reported,linuxcnc
    /// $H
    /// ```
    /// ```nc,reported,linuxcnc
    /// IF [#1 GT 5] GOTO 20
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// o100 if [#<depth> GT 5]
    /// o100 endif
    /// ```
    /// ```nc,quiet,haas-mill
    /// IF [#1 GT 5.] GOTO 20
    /// N20 M30
    /// ```
    rule "statement-of-another-control" in "syntax" {
        summary: "statement of another control",
        severity: Error,
        tier: Token,
        control_specific: true,
        since: "0.1.0",
        run: Run::Token { on: |kind| matches!(kind, SyntaxErrorKind::Foreign(_)), check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    if let SyntaxErrorKind::Foreign(form) = error.kind {
        report.add(finding(cx, error, form));
    }
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError, form: ForeignForm) -> Finding {
    let written = cx.slice(error.range.clone());
    let o_words = cx.control().syntax().o_words;
    let (message, help) = match form {
        ForeignForm::OWord => (
            format!("O-word `{written}` is not a statement of this control"),
            "call a program with `M98` or `G65`",
        ),
        ForeignForm::MacroStatement if o_words => (
            format!("`{written}` without an O number is not a statement of this control"),
            "use O-words: `o100 if [...]`, `o100 while [...]`",
        ),
        ForeignForm::MacroStatement => {
            (format!("`{written}` is not a statement of this control"), "write it without macro statements")
        }
        ForeignForm::Variable => {
            (format!("variable `{written}` on a control without variables"), "write the number itself")
        }
        ForeignForm::Expression => {
            ("expression on a control that does not compute".to_owned(), "write the number itself")
        }
        ForeignForm::NamedParameter => {
            (format!("named parameter `{written}` on a control without names"), "use a numbered variable")
        }
        ForeignForm::PowerOperator => (
            format!("operator `{written}` does not exist on this control"),
            "multiply, or use `POW` if the control has it",
        ),
        ForeignForm::SystemCommand => (
            format!("`{}` is a command to the firmware of another control", written.trim_end()),
            "remove the line, or choose the control that the program is written for",
        ),
    };
    Finding::new(&META, cx.in_file(error.range.clone()), message)
        .label("language of another control")
        .note(format!("the program is checked for {}", cx.control().title()))
        .help(help)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn each_form_is_named() {
        check_rule(
            &RULE,
            "haas-mill",
            "o100 call [1]\n#<depth>=2.\n#1=#2**2\n",
            &expect![[r#"
                1 | o100 call [1]
                  | ^^^^^^^^^ error[statement-of-another-control] O-word `o100 call` is not a statement of this control
                2 | #<depth>=2.
                  | ^^^^^^^^ error[statement-of-another-control] named parameter `#<depth>` on a control without names
                3 | #1=#2**2
                  |      ^^ error[statement-of-another-control] operator `**` does not exist on this control
            "#]],
        );
    }

    #[test]
    fn a_control_may_read_plain_numbers_alone() {
        check_rule(
            &RULE,
            "grbl",
            "#1=3\nG1 Z[0-#1] F100\n",
            &expect![[r#"
            1 | #1=3
              | ^^ error[statement-of-another-control] variable `#1` on a control without variables
            2 | G1 Z[0-#1] F100
              |     ^ error[statement-of-another-control] expression on a control that does not compute
        "#]],
        );
    }

    #[test]
    fn jumps_by_number() {
        check_rule(
            &RULE,
            "linuxcnc",
            "IF [#1 GT 5] GOTO 20\n",
            &expect![[r#"
                1 | IF [#1 GT 5] GOTO 20
                  | ^^ error[statement-of-another-control] `IF` without an O number is not a statement of this control
            "#]],
        );
    }

    #[test]
    fn words_name_the_control() {
        let program = "GOTO 20\n";
        let found = findings(&only(&RULE), "linuxcnc", program, &World::default());
        expect![[r#"
            `GOTO` without an O number is not a statement of this control
              here: language of another control
              note: the program is checked for LinuxCNC
              help: use O-words: `o100 if [...]`, `o100 while [...]`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
