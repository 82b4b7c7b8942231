//! A tool length that is subtracted while others are added.

use gcheck_controls::Effect;

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// One tool uses the code that subtracts its length (`G44`), while others of the program add theirs (`G43`).
    ///
    /// ## Why it matters
    /// Offsets are measured for one of the two codes. With the other one the tool goes too deep by twice its offset.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G43 H1 Z1.
    /// G1 Z0. F5.
    /// T2 M6
    /// G44 H2 Z1.
    /// G1 Z0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G44 H1 Z1.
    /// G1 Z0. F5.
    /// T2 M6
    /// G44 H2 Z1.
    /// G1 Z0.
    /// M30
    /// ```
    rule "length-subtracted" in "tool" {
        summary: "tool length subtracted while others are added",
        severity: Warning,
        tier: Program,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let used = |effect: Effect| {
        cx.file_index.codes.iter().find(|(number, _)| {
            let code = cx.control().code_at(cx.control().code_ix(*number));
            code.is_some_and(|code| code.effect() == effect)
        })
    };
    let (Some((minus, range)), Some((plus, added))) = (used(Effect::LengthMinus), used(Effect::LengthPlus))
    else {
        return;
    };
    report.add(
        Finding::new(&META, range.clone(), format!("the tool's length is subtracted (`{minus}`)"))
            .label("the offset counts against the tool")
            .also(added.clone(), format!("here it is added (`{plus}`)"))
            .help(format!(
                "write `{plus}`, or say in a suppression why this offset is measured the other way"
            ))
            .fix_if(Some(Fix::risky(format!("write `{plus}`"), range.clone(), plus.to_string()))),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_code_that_subtracts_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG44 H1 Z1.\nG1 Z0. F5.\nG49\nT2 M6\nG43 H2 Z1.\nG1 Z0.\nM30\n",
            &expect![[r#"
                2 | G44 H1 Z1.
                  | ^^^ warning[length-subtracted] the tool's length is subtracted (`G44`)
            "#]],
        );
    }
}
