//! A value with two signs.

use std::ops::Range;

use gcheck_program::{BlockFlags, StatementKind, Value};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A value has two signs before it: `Z--1.`.
    ///
    /// ## Why it matters
    /// On a control that accepts it, two minus signs are a plus, and the tool moves the other way. Others stop with an
    /// alarm.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G1 Z--5 F100
    /// ```
    /// ```nc,reported,fanuc-mill
    /// #100=--5.
    /// ```
    /// ## Not reported
    /// A sign before a bracket or variable, and one after an operator:
    /// ```nc,quiet,linuxcnc
    /// G1 Z-[-5] X-#1 Y[3--2] F100
    /// ```
    rule "sign-given-twice" in "syntax" {
        summary: "two signs before a value",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::EXPRESSION.union(BlockFlags::STATEMENT), check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for word in cx.words().iter().filter(|word| matches!(word.value, Value::Expr(_))) {
        let letter = if word.letter.is_corner() { 2 } else { 1 };
        let value = cx.text(word).get(letter..).unwrap_or_default();
        if signs(value) > 1 {
            report.add(finding(cx, word.range(), value));
        }
    }
    for statement in cx.statements().filter(|s| matches!(s.kind, StatementKind::Assign { .. })) {
        let value = cx.slice(statement.range.clone()).split_once('=').map_or("", |(_, value)| value);
        if signs(value) > 1 {
            report.add(finding(cx, statement.range.clone(), value));
        }
    }
}

/// Signs before a value, with or without blanks between them.
fn signs(value: &str) -> usize {
    let is_front = |c: &char| matches!(c, '+' | '-' | ' ' | '\t');
    value.chars().take_while(is_front).filter(|c| matches!(c, '+' | '-')).count()
}

fn finding(cx: &BlockCx<'_>, range: Range<u32>, value: &str) -> Finding {
    let value = value.trim();
    let minus = value.chars().take_while(|c| !c.is_ascii_digit()).filter(|c| *c == '-').count();
    let read = if minus % 2 == 0 { "plus" } else { "minus" };
    Finding::new(&META, cx.in_file(range), format!("two signs before a value (`{value}`)"))
        .label(format!("{read}, if the control accepts it"))
        .note("two minus signs make a plus; some controls stop with an alarm")
        .help("keep the right sign")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G1 X--1. Y+-2. Z- -#1 F10.\n#1= - -3.\nX-[-1.]\n",
            &expect![[r#"
            1 | G1 X--1. Y+-2. Z- -#1 F10.
              |    ^^^^^ warning[sign-given-twice] two signs before a value (`--1.`)
            1 | G1 X--1. Y+-2. Z- -#1 F10.
              |          ^^^^^ warning[sign-given-twice] two signs before a value (`+-2.`)
            1 | G1 X--1. Y+-2. Z- -#1 F10.
              |                ^^^^^^ warning[sign-given-twice] two signs before a value (`- -#1`)
            2 | #1= - -3.
              | ^^^^^^^^^ warning[sign-given-twice] two signs before a value (`- -3.`)
        "#]],
        );
    }

    #[test]
    fn words_say_which_way_it_goes() {
        let found = findings(&only(&RULE), "linuxcnc", "G1 Z--5 F100\n", &World::default());
        expect![[r#"
            two signs before a value (`--5`)
              here: plus, if the control accepts it
              note: two minus signs make a plus; some controls stop with an alarm
              help: keep the right sign
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
