//! An axis that few machines have, where nobody said that this one has it.

use gcheck_controls::{Letter, LetterSet};
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A block names an axis that a machine has only when its configuration says so, and no `[machine] axes` does.
    ///
    /// ## Why it matters
    /// On a machine without this axis the control stops at the block. A run without a machine file stops there too.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G94 F100
    /// G1 X5 U5
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G94 F100
    /// G1 X5 A5
    /// M2
    /// ```
    rule "axis-not-stated" in "words" {
        summary: "axis that few machines have, and no machine file lists",
        severity: Info,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::CODE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some(usual) = &cx.control().semantics().refusals.axes else { return };
    if cx.environment.machine.axes.is_some() {
        return;
    }
    let usual: LetterSet = usual.chars().map(Letter::of).collect();
    let rare = cx.control().axes().without(usual);
    if !cx.block().letters.intersects(rare)
        || cx.codes().any(|(_, code)| code.entry().any_words || code.is_user())
    {
        return;
    }
    for word in cx.words() {
        if !rare.contains(word.letter) {
            continue;
        }
        let axis = word.letter;
        report.add(
            Finding::new(&META, cx.range(word), format!("few machines have an axis `{axis}`"))
                .label("not stated for this machine")
                .assuming(format!("the machine has an axis `{axis}`"))
                .help("list the axes of the machine: `[machine] axes` in gcheck.toml"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G94 F100\nG1 X5 U5\nG2 X10 I5 W3\nG1 X1 A1 B1 C1\nM2\n",
            &expect![[r#"
                2 | G1 X5 U5
                  |       ^^ info[axis-not-stated] few machines have an axis `U`
                3 | G2 X10 I5 W3
                  |           ^^ info[axis-not-stated] few machines have an axis `W`
            "#]],
        );
    }
}
