//! An M code of the machine builder that is not declared.

use gcheck_controls::{CodeNumber, Effect};

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// An M code is not in the control's list, and machine builders add their own M codes to this control.
    ///
    /// A code that runs a program of the machine's folder is reported as well: the configuration does not say that the
    /// machine has that program.
    ///
    /// ## Why it matters
    /// gcheck cannot check a code of unknown meaning: it may stop the spindle, open a door or wait. If the
    /// configuration declares it, it has a name in hovers and listings, and this rule does not report it. Each code is
    /// reported once per file.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// M244
    /// ```
    /// ```nc,reported,linuxcnc
    /// M101 P1
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// M8
    /// G65 P9010 M244.
    /// ```
    /// On a control whose M codes are all known, `unknown-code` reports them.
    /// ```nc,quiet,linuxcnc
    /// M244
    /// ```
    rule "undeclared-m-code" in "words" {
        summary: "M code of the machine builder that the configuration does not declare",
        severity: Info,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let adds_codes = cx.control().code_list().builder_m_codes;
    for (number, range) in &cx.file_index.codes {
        let is_undeclared = match cx.control().code(*number) {
            Some(code) => code.effect() == Effect::UserCommand && !code.is_user(),
            None => adds_codes,
        };
        if number.letter() != b'M' || !is_undeclared {
            continue;
        }
        let mut is_argument = false;
        cx.reread(cx.line_around(range.clone()), |block| {
            is_argument |= block.block_range().contains(&range.start) && block.words_may_be_arguments();
        });
        if !is_argument {
            report.add(finding(cx, *number, range.clone()));
        }
    }
}

fn finding(cx: &FileCx<'_>, number: CodeNumber, range: std::ops::Range<u32>) -> Finding {
    let (label, note) = match cx.control().code(number) {
        Some(code) => (
            format!("runs the machine's own program `{number}`, if the machine has it"),
            format!(
                "without that program the control stops here, and so does `gcheck run`  [{}]",
                code.entry().source
            ),
        ),
        None => (
            "a code of the machine builder, if the machine has it".to_owned(),
            "machine builders add their own M codes to this control; the machine's manual lists them"
                .to_owned(),
        ),
    };
    Finding::new(&META, range, format!("M code `{number}` is not declared"))
        .label(label)
        .note(note)
        .help(format!("declare `{number}` under `[codes]` in the configuration"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn each_code_is_reported_once() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "M244\nM8\nM244\nM245\n",
            &expect![[r#"
                1 | M244
                  | ^^^^ info[undeclared-m-code] M code `M244` is not declared
                4 | M245
                  | ^^^^ info[undeclared-m-code] M code `M245` is not declared
            "#]],
        );
    }

    #[test]
    fn arguments_of_a_macro_are_no_codes() {
        check_rule(&RULE, "fanuc-mill", "G65 P9010 M244. A#1\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "M244\n", &expect![[""]]);
    }

    #[test]
    fn words_are_for_the_machinist() {
        let found = findings(&only(&RULE), "fanuc-mill", "M244\n", &World::default());
        expect![[r#"
            M code `M244` is not declared
              here: a code of the machine builder, if the machine has it
              note: machine builders add their own M codes to this control; the machine's manual lists them
              help: declare `M244` under `[codes]` in the configuration
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
