//! A file of a dialect that no control here reads.

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// The file is written in a dialect that gcheck does not read: for a 3-D printer, or in the language of a builder whose
    /// manual is not in gcheck's data.
    ///
    /// ## Why it matters
    /// Judged by the rules of another control nearly every line would be an error. So this is the only finding, unless the
    /// control is chosen: with `--control`, by a comment, or in `gcheck.toml`.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc,guessed
    /// G92 E0
    /// G1 X10 Y5 E1.1
    /// G1 X12 Y5 E1.2
    /// G1 X12 Y9 E1.4
    /// ```
    /// ## Not reported
    /// With the control chosen:
    /// ```nc,quiet,linuxcnc
    /// G92 E0
    /// G1 X10 Y5 E1.1
    /// G1 X12 Y5 E1.2
    /// G1 X12 Y9 E1.4
    /// ```
    rule "unsupported-dialect" in "program" {
        summary: "dialect that gcheck does not read",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if cx.environment.control_is_chosen() {
        return;
    }
    let Some(dialect) = cx.environment.unsupported else { return };
    let first = cx.file_index.first_block.clone().unwrap_or_default();
    report.add(
        Finding::new(&META, first, dialect.sentence())
            .note(format!("it looks like {}  [{}]", dialect.reads, dialect.source))
            .note("no other rule is run on it")
            .help("leave such files out (`exclude` under `[files]` in `gcheck.toml`), or name a control (`control = …`) to check it all the same"),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in};

    const PRINTED: &str = "G21\nG92 E0\nG1 X10 Y5 E1.1\nG1 X12 Y5 E1.2\nG1 X12 Y9 E1.4\n";

    #[test]
    fn the_first_block_is_marked() {
        let guessed = World {
            control_is_guessed: true,
            unsupported: gcheck_controls::unsupported_dialect(PRINTED, None),
            ..World::default()
        };
        check_rule_in(
            &RULE,
            "generic-mill",
            PRINTED,
            &guessed,
            &expect![[r#"
                1 | G21
                  | ^^^ warning[unsupported-dialect] the file is for a 3-D printer, which gcheck does not read
            "#]],
        );
    }

    #[test]
    fn a_control_that_was_chosen_is_taken_at_its_word() {
        check_rule(&RULE, "generic-mill", PRINTED, &expect![[""]]);
    }
}
