//! A sequence or program number that is computed.

use gcheck_controls::{Letter, WordKind};
use gcheck_program::{BlockFlags, Value, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// `N` or `O` has a variable or an expression instead of a number.
    ///
    /// ## Why it matters
    /// The control finds blocks and programs by their written numbers. No control computes them; most stop with an
    /// alarm at the block.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// N#1 G0 X1.
    /// ```
    /// ```nc,reported,linuxcnc
    /// N[#1+10] G0 X1
    /// ```
    /// ## Not reported
    /// A jump may compute its target, and if `O` labels subroutines, a call may compute which one it calls.
    /// ```nc,quiet,fanuc-mill
    /// N10 GOTO #1
    /// ```
    /// ```nc,quiet,linuxcnc
    /// o[#1] call
    /// ```
    rule "expression-in-label" in "macros" {
        summary: "sequence or program number is computed",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::LABEL.union(BlockFlags::PROGRAM_NUMBER), check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if !cx.block().flags.contains(BlockFlags::EXPRESSION) {
        return;
    }
    let is_number = |letter: Letter| {
        letter == Letter::of('N') || letter == Letter::of('O') && !cx.control().syntax().o_words
    };
    for word in cx.words().iter().filter(|w| is_number(w.letter) && matches!(w.value, Value::Expr(_))) {
        // A macro call may take the address as an argument.
        let is_label = cx
            .control()
            .letter(word.letter)
            .is_some_and(|l| matches!(l.kind, WordKind::Label | WordKind::Program));
        if is_label && !cx.codes().any(|(_, code)| code.entry().any_words) {
            report.add(finding(cx, word));
        }
    }
}

fn finding(cx: &BlockCx<'_>, word: &Word) -> Finding {
    let what = if word.letter == Letter::of('N') { "sequence number" } else { "program number" };
    Finding::new(&META, cx.range(word), format!("{what} `{}` is computed", cx.text(word)))
        .label("must be a written number")
        .note("controls do not read variables in `N`, in `O` and after `/`; all RS-274 controls share this")
        .help("write the number")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn other_words_may_be_computed() {
        check_rule(
            &RULE,
            "haas-mill",
            "N10 G0 X#1\nN#2 X#3\nO[#1]\n",
            &expect![[r#"
            2 | N#2 X#3
              | ^^^ error[expression-in-label] sequence number `N#2` is computed
            3 | O[#1]
              | ^^^^^ error[expression-in-label] program number `O[#1]` is computed
        "#]],
        );
    }

    #[test]
    fn what_is_said() {
        let found = findings(&only(&RULE), "fanuc-lathe", "O#100\n", &World::default());
        expect![[r#"
            program number `O#100` is computed
              here: must be a written number
              note: controls do not read variables in `N`, in `O` and after `/`; all RS-274 controls share this
              help: write the number
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
