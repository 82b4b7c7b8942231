//! A character outside ASCII in code.

use std::ops::Range;

use gcheck_syntax::{SourceText, SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Report, Run};
use gcheck_lint::foreign_characters;

declare_rule! {
    /// The code has a character that no control reads: a typographic minus, a non-breaking blank, an umlaut, a broken
    /// byte.
    ///
    /// ## Why it matters
    /// The control refuses the block, or the transfer drops the character and the control reads something else. Such
    /// characters come from word processors and web pages and often look like the right ones: `−` is not a minus.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G0 X−1.
    /// ```
    /// ```nc,reported,linuxcnc
    /// G0 X1 ½
    /// ```
    /// ## Not reported
    /// In comments they do no harm.
    /// ```nc,quiet,haas-mill
    /// G0 X-1. (Größe µ)
    /// ```
    rule "non-ascii-text" in "syntax" {
        summary: "character outside ASCII in code",
        severity: Error,
        tier: Token,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::Unexpected, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    if let Some(at) = foreign_characters(cx.slice(error.range.clone())) {
        report.add(finding(cx, error, &at));
    }
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError, at: &Range<usize>) -> Finding {
    let start = error.range.start;
    let place = start + at.start as u32..start + at.end as u32;
    let written = cx.slice(place.clone());
    let range = cx.in_file(place);
    let first = written.chars().next().unwrap_or_default();
    let message = if first == SourceText::STAND_IN {
        "byte that is not a character in code".to_owned()
    } else if first.is_whitespace() || first.is_control() || first == '\u{FEFF}' {
        format!("blank that is not an ASCII blank (U+{:04X}) in code", u32::from(first))
    } else {
        format!("character `{first}` (U+{:04X}) in code", u32::from(first))
    };
    let finding = Finding::new(&META, range.clone(), message)
        .label("code has only ASCII characters")
        .note("outside comments a control reads letters, digits and the symbols of its language");
    match ascii(first).filter(|_| written.chars().count() == 1) {
        Some(ascii) => {
            finding.help(format!("write `{ascii}`")).fix(Fix::risky(format!("write `{ascii}`"), range, ascii))
        }
        None => finding.help("remove it, or put it in a comment"),
    }
}

/// What the character looks like.
fn ascii(c: char) -> Option<&'static str> {
    Some(match c {
        '\u{2010}'..='\u{2015}' | '\u{2212}' | '\u{FF0D}' => "-",
        '\u{A0}' | '\u{2000}'..='\u{200A}' | '\u{202F}' | '\u{3000}' => " ",
        '\u{FF08}' => "(",
        '\u{FF09}' => ")",
        '\u{FF0C}' => ",",
        '\u{FF0E}' => ".",
        '\u{FF1B}' => ";",
        '\u{D7}' => "*",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only, words};

    #[test]
    fn a_typographic_minus() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X\u{2212}1.\n",
            &expect![[r#"
                1 | G0 X−1.
                  |     ^ error[non-ascii-text] character `−` (U+2212) in code
            "#]],
        );
    }

    #[test]
    fn comments_may_hold_anything() {
        check_rule(
            &RULE,
            "linuxcnc",
            "(\u{b5}) G0 X1 ; \u{b5}\nG0 X1 \u{bd}\n",
            &expect![[r#"
                2 | G0 X1 ½
                  |       ^ error[non-ascii-text] character `½` (U+00BD) in code
            "#]],
        );
    }

    #[test]
    fn the_look_alike_is_replaced() {
        let program = "G0 X\u{2212}1.\n";
        let found = findings(&only(&RULE), "fanuc-mill", program, &World::default());
        expect![[r#"
            G0 X-1.
        "#]]
        .assert_eq(&found.iter().map(|f| fixed(program, f)).collect::<String>());
    }

    #[test]
    fn a_byte_that_is_no_character() {
        let source = gcheck_syntax::SourceText::from_bytes(b"G0 X1. \xB5\n(\xB5)\n".to_vec()).unwrap();
        let found = findings(&only(&RULE), "haas-mill", source.text(), &World::default());
        expect![[r#"
            byte that is not a character in code
              here: code has only ASCII characters
              note: outside comments a control reads letters, digits and the symbols of its language
              help: remove it, or put it in a comment
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn the_end_mark_of_dos_counts_in_code_only() {
        check_rule(&RULE, "fanuc-mill", "G0 X1.\n\u{1a}", &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            "G0 X1.\u{1a}\n",
            &expect![[r#"
            1 | G0 X1.
              |       ^ error[non-ascii-text] byte that is not a character in code
        "#]],
        );
    }
}
