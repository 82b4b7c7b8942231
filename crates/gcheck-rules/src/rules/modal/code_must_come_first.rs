//! A code that has to open its block.

use gcheck_controls::{Code, Letter};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, Severity};

declare_rule! {
    /// A code that has to be the first word of its block comes after another word, or has words after it that no longer count.
    ///
    /// ## Why it matters
    /// After another word the control does not know the code, and stops with an error. As the first word it acts alone: what
    /// else the block asks for, a move or a mode, is not done.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G0 X1 M98 P100
    /// M2
    /// O100
    /// M99
    /// ```
    /// ```nc,reported,linuxcnc
    /// M98 P100 G0 X1
    /// M2
    /// O100
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G0 X1
    /// N10 M98 P100 L2
    /// M2
    /// O100
    /// M99
    /// ```
    rule "code-must-come-first" in "modal" {
        summary: "code that has to open its block does not",
        severity: Warning,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::CODE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let first_only = &cx.control().semantics().refusals.first_only;
    if first_only.is_empty() || cx.block().flags.contains(BlockFlags::ERROR) {
        return;
    }
    let is_first_only = |code: &Code<'_>| first_only.iter().any(|name| *name == code.entry().code);
    let Some((word, code)) = cx.codes().find(|(_, code)| is_first_only(code)) else { return };
    let is_number = |other: &Word| other.letter == Letter::of('N');
    let before =
        cx.words().iter().find(|other| other.range().start < word.range().start && !is_number(other));
    let reads = code.reads();
    let lost = cx.words().iter().find(|other| {
        other.range().start > word.range().start && !is_number(other) && !reads.contains(other.letter)
    });
    let name = cx.text(word);
    let finding = match (before, lost) {
        (Some(other), _) => {
            Finding::new(&META, cx.range(word), format!("`{name}` is not the first word of its block"))
                .label("the control does not know the code here")
                .also(cx.range(other), "comes first")
        }
        (None, Some(other)) => Finding::new(
            &META,
            cx.range(other),
            format!("`{}` after `{name}` does not count", cx.text(other)),
        )
        .label("the control ignores it")
        .also(cx.range(word), code.entry().title.as_str()),
        (None, None) => return,
    };
    let note = format!(
        "`{name}` ({}) opens its block, and acts alone  [{}]",
        code.entry().title,
        code.entry().source
    );
    report
        .add(finding.note(note).help(format!("give `{name}` a block of its own")).at_most(Severity::Warning));
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn before_and_after() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 X1 M98 P100\nN5 M98 P100 G0 X2\nM98 P100 L2\nM2\nO100\nM99\n",
            &expect![[r#"
                1 | G0 X1 M98 P100
                  |       ^^^ warning[code-must-come-first] `M98` is not the first word of its block
                2 | N5 M98 P100 G0 X2
                  |             ^^ warning[code-must-come-first] `G0` after `M98` does not count
            "#]],
        );
    }

    #[test]
    fn another_control_reads_it_anywhere() {
        check_rule(&RULE, "fanuc-mill", "G0 X1. M98 P100\nM30\nO100\nM99\n", &expect![[""]]);
    }
}
