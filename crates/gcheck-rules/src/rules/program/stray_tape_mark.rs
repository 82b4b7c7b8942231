//! A tape mark that cuts off code.

use std::ops::Range;

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// A `%` is inside the program, shares its line with code, or has code after it.
    ///
    /// ## Why it matters
    /// `%` ends the tape wherever the control finds it: it does not read what follows. A program that was pasted after
    /// another one is silently lost.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// %
    /// O00001
    /// M98 P2
    /// M30
    /// %
    /// O00002
    /// M99
    /// %
    /// ```
    /// ```nc,reported,haas-mill
    /// %
    /// O00001
    /// G0 X1. %
    /// M30
    /// %
    /// ```
    /// ## Not reported
    /// A comment beside the mark, and blank lines or notes after the closing one.
    /// ```nc,quiet,haas-mill
    /// % (PART 12)
    /// O00001
    /// M30
    /// %
    /// SETUP: SEE DRAWING
    /// ```
    rule "stray-tape-mark" in "program" {
        summary: "tape mark cuts off code",
        severity: Info,
        tier: Program,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    for mark in &cx.file_index.tape_marks {
        if !crate::facts::sections::is_tape_mark_line(cx, mark) {
            let at = cx.slice(mark.clone()).find('%').map_or(mark.start, |at| mark.start + at as u32);
            let before = cx.slice(mark.start..at);
            let blanks = before.len() - before.trim_end_matches([' ', '\t']).len();
            report.add(inside(at..at + 1).fix(Fix::risky("remove the `%`", at - blanks as u32..at + 1, "")));
        }
    }
    let Some(closing) = cx.file_index.tape_marks.last() else { return };
    let code = cx
        .text
        .from(cx.region.end)
        .find_map(|(from, piece)| first_code(piece).map(|code| from + code.start..from + code.end));
    if let Some(code) = code {
        report.add(behind(closing.clone(), code));
    }
}

/// The first line of a text that begins like a block; lines that may be notes do not count.
fn first_code(text: &str) -> Option<Range<u32>> {
    for line in text.split(['\n', '\r']) {
        let block = line.trim();
        let mut bytes = block.bytes();
        let letter = bytes.next().is_some_and(|b| {
            matches!(b.to_ascii_uppercase(), b'G' | b'N' | b'O' | b'T' | b'M' | b'X' | b'Z')
        });
        let digits = bytes.take_while(u8::is_ascii_digit).count();
        let behind = block.get(1 + digits..).unwrap_or_default();
        if letter && digits > 0 && !behind.starts_with(|c: char| c.is_alphabetic() && c.is_lowercase()) {
            let start = block.as_ptr() as usize - text.as_ptr() as usize;
            return Some(start as u32..(start + block.len()) as u32);
        }
    }
    None
}

fn inside(at: Range<u32>) -> Finding {
    Finding::new(&META, at, "tape mark `%` inside a block")
        .label("it is a tape mark only on a line of its own")
        .help("remove it, or put it on a line of its own at the end of the program")
}

fn behind(closing: Range<u32>, code: Range<u32>) -> Finding {
    Finding::new(&META, code, "code after the closing tape mark `%` is not read")
        .label("the first block that is not read")
        .also(closing, "the tape ends here")
        .help("remove the tape mark, or what follows it")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_second_program_behind_the_tape_is_shown_by_its_first_block() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "%\nO1\nM30\n%\n\nO2\nM99\n%\n",
            &expect![[r#"
            6 | O2
              | ^^ info[stray-tape-mark] code after the closing tape mark `%` is not read
        "#]],
        );
    }

    #[test]
    fn a_mark_inside_a_block_is_shown_itself() {
        check_rule(
            &RULE,
            "haas-mill",
            "%\nO1\nG0 X1. %\nM30\n%\n",
            &expect![[r#"
            3 | G0 X1. %
              |        ^ info[stray-tape-mark] tape mark `%` inside a block
        "#]],
        );
    }

    #[test]
    fn the_closing_mark_is_shown() {
        let found = findings(&only(&RULE), "fanuc-mill", "%\nO1\nM30\n%\nO2\n", &World::default());
        expect![[r#"
            code after the closing tape mark `%` is not read
              here: the first block that is not read
              there: the tape ends here
              help: remove the tape mark, or what follows it
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
