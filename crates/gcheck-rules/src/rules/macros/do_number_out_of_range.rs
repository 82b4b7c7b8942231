//! A loop number that the control does not have.

use std::ops::Range;

use gcheck_program::{BlockFlags, ExprIx, StatementKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// `DO` or `END` has a number outside the control's range.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// WHILE [#1 LT 10] DO4
    /// #1=#1+1
    /// END4
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// WHILE [#1 LT 10] DO3
    /// #1= #1 + 1
    /// END3
    /// ```
    rule "do-number-out-of-range" in "macros" {
        summary: "loop number is out of range",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some([lowest, highest]) = cx.control().limits().do_numbers else { return };
    for statement in cx.statements() {
        // The END of such a loop has the same number; only the DO is reported.
        let StatementKind::Do { number: Some(number), .. } = statement.kind else { continue };
        let Some(value) = cx.table().constant(number) else { continue };
        if value.fract() != 0.0 || !(f64::from(lowest)..=f64::from(highest)).contains(&value) {
            report.add(finding(cx, place(cx, number, &statement.range), value, [lowest, highest]));
        }
    }
}

/// The number itself, or the statement if the place of the number is not kept.
fn place(cx: &BlockCx<'_>, number: ExprIx, statement: &Range<u32>) -> Range<u32> {
    let text = cx.slice(statement.clone());
    let digits = text.len() - text.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.').len();
    if digits == 0 {
        return cx.in_file(cx.table().expr(number).range.clone());
    }
    cx.in_file(statement.end - digits as u32..statement.end)
}

fn finding(cx: &BlockCx<'_>, place: Range<u32>, value: f64, [lowest, highest]: [u8; 2]) -> Finding {
    let source = cx.control().limits().source.as_deref().unwrap_or("general knowledge");
    Finding::new(&META, place, format!("loop number `DO{value}` is outside {lowest} to {highest}"))
        .label("no such loop")
        .note(format!("this control numbers its loops {lowest} to {highest}  [{source}]"))
        .help(format!("number the loop, and its `END`, from {lowest} to {highest}"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_number_is_marked_once() {
        check_rule(
            &RULE,
            "haas-mill",
            "WHILE [#1 EQ 1] DO10\nEND10\nDO1.5\nEND1.5\n",
            &expect![[r#"
            1 | WHILE [#1 EQ 1] DO10
              |                   ^^ error[do-number-out-of-range] loop number `DO10` is outside 1 to 3
            3 | DO1.5
              |   ^^^ error[do-number-out-of-range] loop number `DO1.5` is outside 1 to 3
        "#]],
        );
    }

    #[test]
    fn a_computed_number_is_not_known() {
        check_rule(&RULE, "fanuc-mill", "DO#1\nEND#1\n", &expect![[""]]);
    }

    #[test]
    fn the_range_is_said() {
        let found = findings(&only(&RULE), "haas-mill", "DO0\n", &World::default());
        expect![[r#"
            loop number `DO0` is outside 1 to 3
              here: no such loop
              note: this control numbers its loops 1 to 3  [HM17 p.125, p.133 (one M code), 6.14.10 (DO numbers), 6.14.12 (nine nested G65 calls), p.234 (aliases); the rest general knowledge]
              help: number the loop, and its `END`, from 1 to 3
        "#]].assert_eq(&words(&found[0]));
    }
}
