//! A return outside a subroutine.

use gcheck_engine::Fault;
use gcheck_program::OKeyword;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// `RETURN` or `ENDSUB` is executed outside a subroutine.
    ///
    /// ## Why it matters
    /// The control refuses the program at this block. The `SUB` before it is missing, or has another label.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G0 X1
    /// o1 return
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// o1 sub
    /// o2 if [#1 GT 5]
    /// o1 return
    /// o2 endif
    /// o1 endsub
    /// o1 call [6]
    /// M2
    /// ```
    rule "return-outside-subroutine" in "flow" {
        summary: "return outside a subroutine",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ReturnOutsideSubroutine) },
    }
}

struct ReturnOutsideSubroutine;

impl PathRule for ReturnOutsideSubroutine {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::StrayReturn || is_in_refused_subroutine(cx) {
            return;
        }
        let finding = cx
            .finding(&META, cx.range(), "return outside a subroutine")
            .label("no subroutine is open here")
            .help("put a `SUB` with this label before the body, or end the program with `M2`");
        report.add(finding);
    }
}

/// Does a `SUB` before the block have its label? Then the control refuses the `SUB`, which another rule reports.
fn is_in_refused_subroutine(cx: &PathCx<'_>) -> bool {
    let here = cx.range().start;
    let words = &cx.file_index.o_words;
    let own = words.iter().find(|word| word.range.start >= here);
    let before = words.iter().take_while(|word| word.range.start < here);
    own.is_some_and(|own| {
        before.into_iter().any(|word| word.keyword == OKeyword::Sub && word.label == own.label)
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_block_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 if [#100 GT 1]\no1 return\no1 endif\nM2\n",
            &expect![[r#"
            2 | o1 return
              | ^^^^^^^^^ error[return-outside-subroutine] return outside a subroutine
        "#]],
        );
    }

    #[test]
    fn the_end_of_a_subroutine_that_the_control_refuses_is_not_stray() {
        check_rule(&RULE, "linuxcnc", "o1 sub\no2 sub\no2 endsub\no1 endsub\nM2\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", "o1 sub\nG0 X1\no1 return\nM2\n", &expect![[""]]);
    }
}
