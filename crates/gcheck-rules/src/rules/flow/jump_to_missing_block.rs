//! A computed jump to a block that does not exist.

use gcheck_controls::Effect;
use gcheck_engine::Fault;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A jump with a computed target, or a return to a block of the caller (`M99 P…`), leads to a sequence number that
    /// the program does not have.
    ///
    /// ## Why it matters
    /// The control searches the program for the number and stops with an alarm. No block has a number below zero.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// #1=2
    /// GOTO [#1*10]
    /// N10 G0 X1.
    /// M30
    /// ```
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// #1=2
    /// GOTO [#1-5]
    /// M30
    /// ```
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// M98 P2
    /// M30
    /// O0002
    /// M99 P50
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// #1=1
    /// GOTO [#1*10]
    /// N10 GOTO #500
    /// N20 M30
    /// ```
    rule "jump-to-missing-block" in "flow" {
        summary: "computed jump to a block that does not exist",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(JumpToMissingBlock) },
    }
}

struct JumpToMissingBlock;

impl PathRule for JumpToMissingBlock {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let number = match fault {
            Fault::NoSuchLabel(number) => number,
            Fault::JumpTarget(number) => return impossible(cx, *number, report),
            _ => return,
        };
        let block = cx.range();
        // Other rules report a written number without executing the program.
        let literal = cx.file_index.jumps.iter().any(|jump| {
            jump.target == Some(*number)
                && block.contains(&jump.range.start)
                && !cx
                    .environment
                    .control()
                    .code_at(jump.code)
                    .is_some_and(|code| code.entry().words.iter().any(|word| word.elsewhere))
        });
        // `M99 P…` of a program that is called from another file names a block there.
        let is_elsewhere = cx.file_index.is_called_from_elsewhere()
            && cx.state().frames().len() <= 1
            && cx.has_effect(|effect| effect == Effect::Return);
        if literal || is_elsewhere {
            return;
        }
        let is_return = cx.has_effect(|effect| effect == Effect::Return);
        let message = format!("jump to `N{number}`, which does not exist");
        let finding = cx
            .finding(&META, block, message)
            .label(if is_return {
                format!("looks for `N{number}` in the program that made the call")
            } else {
                format!("looks for `N{number}` here")
            })
            .note("the control searches for the number when the block runs, and stops with an alarm if it is not found")
            .help(if is_return {
                format!("add `N{number}` to a block of the calling program, or correct the number")
            } else {
                format!("add `N{number}` to the target block, or correct the number")
            });
        report.add(finding);
    }
}

/// A number that no block can have. That of a word (`M99 P-3`) is outside of its range, which other rules report.
fn impossible(cx: &PathCx<'_>, number: f64, report: &mut Report<'_>) {
    if cx.has_effect(|effect| effect == Effect::Return) {
        return;
    }
    report.add(
        cx.finding(&META, cx.range(), format!("jump to block {number}, which cannot exist"))
            .label(format!("the target is {number}"))
            .note("sequence numbers are whole numbers from 0 on; the control stops with an alarm when it takes the jump")
            .help("correct the target, or the variables that it reads"),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_block_that_jumps_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\n#1= 3\nGOTO #1\nN1 M30\n",
            &expect![[r#"
            3 | GOTO #1
              | ^^^^^^^ error[jump-to-missing-block] jump to `N3`, which does not exist
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "O1\n#1= 3\nM97 P#1\nN1 M30\n",
            &expect![[r#"
            3 | M97 P#1
              | ^^^^^^^ error[jump-to-missing-block] jump to `N3`, which does not exist
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nM98 P2\nM30\nO2\nM99 P50\n",
            &expect![[r#"
            5 | M99 P50
              | ^^^^^^^ error[jump-to-missing-block] jump to `N50`, which does not exist
        "#]],
        );
    }

    #[test]
    fn no_block_has_a_number_below_zero() {
        for jump in ["GOTO-3", "GOTO[0-3]", "#100=-3\nGOTO#100", "#100=-3\nIF[#100LT0]GOTO#100"] {
            for control in ["haas-mill", "haas-lathe", "fanuc-mill", "fanuc-lathe"] {
                let found =
                    findings(&only(&RULE), control, &format!("O1\n{jump}\nN3 M30\n"), &World::default());
                expect![[r#"
                    jump to block -3, which cannot exist
                      here: the target is -3
                      note: sequence numbers are whole numbers from 0 on; the control stops with an alarm when it takes the jump
                      help: correct the target, or the variables that it reads
                "#]]
                .assert_eq(&found.iter().map(words).collect::<String>());
            }
        }
        check_rule(&RULE, "fanuc-mill", "O1\n#100=3\nGOTO#100\nN3 M30\n", &expect![[""]]);
    }

    #[test]
    fn a_literal_target_is_told_by_another_rule() {
        check_rule(&RULE, "fanuc-mill", "O1\nGOTO 20\nM30\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "O1\nM97 P20\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_block_of_a_caller_in_another_file_is_not_known() {
        check_rule(&RULE, "fanuc-mill", "O2\nG0 X1.\nM99 P50\n", &expect![[""]]);
    }
}
