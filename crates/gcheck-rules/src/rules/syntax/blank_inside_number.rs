//! A number with a blank between its digits.

use gcheck_program::{BlockFlags, Value, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// There is a blank between the digits of a number, on a control that ignores blanks.
    ///
    /// ## Why it matters
    /// The control reads one number. `G00 3.0` is `G003.0`, an arc, and `Y0 5.` is `Y05.`: most often the letter of the
    /// second number is missing.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G00 3.0 Z3.0
    /// ```
    /// ```nc,reported,linuxcnc
    /// G0 X0 Y0 0
    /// ```
    /// ## Not reported
    /// A blank after the letter or the sign:
    /// ```nc,quiet,linuxcnc
    /// G 0 X 1.5 Y - 2
    /// ```
    rule "blank-inside-number" in "syntax" {
        summary: "blank between the digits of a number",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::DIVIDED_NUMBER, check },
    }
}

/// Blanks between words.
const BLANKS: [char; 4] = [' ', '\t', '\u{b}', '\u{c}'];

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for word in cx.words().iter().filter(|word| matches!(word.value, Value::Number(_))) {
        let text = cx.text(word);
        let number = text.trim_start_matches(|c: char| !c.is_ascii_digit() && c != '.');
        if let Some((_, second)) = number.rsplit_once(BLANKS) {
            report.add(finding(cx, word, text, second));
        }
    }
}

fn finding(cx: &BlockCx<'_>, word: &Word, text: &str, second: &str) -> Finding {
    let read: String = text.chars().filter(|c| !BLANKS.contains(c)).collect();
    Finding::new(&META, cx.range(word), format!("number with a blank inside (`{text}`)"))
        .label(format!("read as `{read}`"))
        .note("this control ignores blanks: the digits on both sides are one number")
        .help(format!("write the letter before `{second}`, or remove the blank"))
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
            "linuxcnc",
            "G01 12. F6\nX1. 25 Y 3\nG0 X - 1 . 5\nX[1 + 2] Y#1\nG90 G0 X5. Y6.\n",
            &expect![[r#"
                1 | G01 12. F6
                  | ^^^^^^^ warning[blank-inside-number] number with a blank inside (`G01 12.`)
                2 | X1. 25 Y 3
                  | ^^^^^^ warning[blank-inside-number] number with a blank inside (`X1. 25`)
                3 | G0 X - 1 . 5
                  |    ^^^^^^^^^ warning[blank-inside-number] number with a blank inside (`X - 1 . 5`)
            "#]],
        );
    }

    #[test]
    fn elsewhere_the_number_ends_at_the_blank() {
        check_rule(&RULE, "fanuc-mill", "G01 12. F600.\n", &expect![[""]]);
    }

    #[test]
    fn words_say_how_it_is_read() {
        let found = findings(&only(&RULE), "haas-mill", "G00 3.0 Z3.0\n", &World::default());
        expect![[r#"
            number with a blank inside (`G00 3.0`)
              here: read as `G003.0`
              note: this control ignores blanks: the digits on both sides are one number
              help: write the letter before `3.0`, or remove the blank
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
