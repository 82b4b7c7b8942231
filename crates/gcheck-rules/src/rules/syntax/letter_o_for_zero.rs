//! A letter O instead of a zero.

use std::ops::Range;

use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Report, Run};
use gcheck_lint::letter_o;

declare_rule! {
    /// A number has the letter O instead of a zero: `GO1` for `G01`, `X1O.` for `X10.`.
    ///
    /// ## Why it matters
    /// The control refuses the block, or reads the O as a program number. The two look alike on many screens, so the
    /// mistake is hard to see.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// GO1 X1. F10.
    /// G1 X1O.5
    /// ```
    /// ```nc,reported,linuxcnc
    /// G0 XO.5
    /// ```
    /// ## Not reported
    /// An O at the head of a block names a program.
    /// ```nc,quiet,haas-mill
    /// O1234
    /// N10O1235
    /// ```
    /// ```nc,quiet,linuxcnc
    /// o100 call
    /// ```
    rule "letter-o-for-zero" in "syntax" {
        summary: "letter O instead of a zero",
        severity: Error,
        tier: Block,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::ERROR.union(BlockFlags::PROGRAM_NUMBER), check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if let Some(place) = letter_o(cx) {
        report.add(finding(cx, &place));
    }
}

fn finding(cx: &BlockCx<'_>, place: &Range<u32>) -> Finding {
    let block = cx.block().range.clone();
    let before = cx.slice(block.start..place.start);
    let start = before.rfind(|c: char| !c.is_ascii_digit() && !matches!(c, '.' | '-' | '+')).unwrap_or(0);
    let after = cx.slice(place.start..block.end);
    let end =
        after.find(|c: char| !c.is_ascii_digit() && !matches!(c, 'O' | 'o' | '.')).unwrap_or(after.len());
    let written = cx.slice(block.start + start as u32..place.start + end as u32);
    let range = cx.in_file(place.clone());
    Finding::new(&META, range.clone(), format!("letter `O` instead of a zero in `{written}`"))
        .label("this is the letter")
        .help("write the digit `0`")
        .fix(Fix::risky("write a zero", range, "0"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only, words};

    #[test]
    fn wherever_a_number_has_its_zeros() {
        check_rule(
            &RULE,
            "haas-mill",
            "GO1 X1. F10.\nG1 X1O.5\nG0 XO.5 Y1O. ZO\nGOO X1.\nN1O G0\n",
            &expect![[r#"
                1 | GO1 X1. F10.
                  |  ^ error[letter-o-for-zero] letter `O` instead of a zero in `GO1`
                2 | G1 X1O.5
                  |      ^ error[letter-o-for-zero] letter `O` instead of a zero in `X1O.5`
                3 | G0 XO.5 Y1O. ZO
                  |     ^ error[letter-o-for-zero] letter `O` instead of a zero in `XO.5`
                4 | GOO X1.
                  |  ^ error[letter-o-for-zero] letter `O` instead of a zero in `GOO`
                5 | N1O G0
                  |   ^ error[letter-o-for-zero] letter `O` instead of a zero in `N1O`
            "#]],
        );
    }

    #[test]
    fn o_words_and_prose_have_their_own_rules() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o100 call\no<x> sub\nN10 o100 if [#1]\nGOTO 10\nMOVE TO X1\nG0 X EXISTS[#foo]\nX#1O\n",
            &expect![[r#"
                7 | X#1O
                  |    ^ error[letter-o-for-zero] letter `O` instead of a zero in `#1O`
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1234(A)\nN10O1235\n:1236\nDO 1\nGOTO100\nM99O0810\n",
            &expect![[""]],
        );
    }

    #[test]
    fn words_quote_the_number() {
        let program = "G01 X1O.5 Y1.\n";
        let found = findings(&only(&RULE), "fanuc-lathe", program, &World::default());
        expect![[r#"
            letter `O` instead of a zero in `X1O.5`
              here: this is the letter
              help: write the digit `0`
              fix (unsafe): write a zero
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        expect![[r#"
            G01 X10.5 Y1.
        "#]]
        .assert_eq(&found.iter().map(|f| fixed(program, f)).collect::<String>());
    }
}
