//! Lower-case letters on a control that may read only capitals.

use std::ops::Range;

use gcheck_program::{BlockFlags, StatementKind};

use crate::declare::declare_rule;
use crate::{Edit, FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// Code is written in lower-case letters, which not every control of this kind reads.
    ///
    /// ## Why it matters
    /// An older control refuses the block or does not load the program.
    ///
    /// ## Reported
    /// Reported once per file.
    /// ```nc,reported,fanuc-mill
    /// g0 x1. y2.
    /// g1 z-1. f100.
    /// ```
    /// ## Not reported
    /// Comments may hold anything.
    /// ```nc,quiet,fanuc-mill
    /// G0 X1. (start)
    /// ```
    /// ```nc,quiet,linuxcnc
    /// g0 x1 y2
    /// ```
    rule "lower-case-letter" in "syntax" {
        summary: "lower-case letters in code",
        severity: Info,
        tier: Program,
        fixable: Safely,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let Some(block) = &cx.file_index.lower_case else { return };
    if let Some(at) = first_letter(cx.slice(block.clone())) {
        let start = block.start + at as u32;
        report.add(finding(start..start + 1).fix_if(capitals(cx)));
    }
}

/// Letters that one fix writes as capitals; more are left to the next run.
const MOST_LETTERS: usize = 10_000;

/// All code in capitals. Blocks with a syntax error do not change: it is not certain what is code in them.
fn capitals(cx: &FileCx<'_>) -> Option<Fix> {
    let mut edits = Vec::new();
    cx.each_block(|block| {
        let flags = block.block().flags;
        // Printed text is not code.
        let prints = block
            .statements()
            .any(|statement| matches!(statement.kind, StatementKind::Print | StatementKind::Command));
        if edits.len() >= MOST_LETTERS
            || !flags.contains(BlockFlags::LOWER_CASE)
            || flags.contains(BlockFlags::ERROR)
            || prints
        {
            return;
        }
        let start = block.block_range().start;
        let mut in_comment = false;
        for (at, byte) in block.block_text().bytes().enumerate() {
            in_comment = byte == b'(' || in_comment && byte != b')';
            if !in_comment && byte.is_ascii_lowercase() {
                let at = start + at as u32;
                let text = char::from(byte.to_ascii_uppercase()).to_string();
                edits.push(Edit { range: at..at + 1, text });
            }
        }
    });
    let title = "write code in capitals".to_owned();
    (!edits.is_empty()).then_some(Fix { title, safe: true, edits })
}

/// The first lower-case letter outside comments.
fn first_letter(block: &str) -> Option<usize> {
    let mut in_comment = false;
    block.bytes().position(|byte| {
        match byte {
            b'(' => in_comment = true,
            b')' => in_comment = false,
            _ => {}
        }
        !in_comment && byte.is_ascii_lowercase()
    })
}

fn finding(range: Range<u32>) -> Finding {
    Finding::new(&META, range, "code in lower-case letters")
        .label("the first one in this file")
        .note("not every control of this kind reads lower-case letters outside comments")
        .help("write code in capitals")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only};

    #[test]
    fn once_a_file_and_not_in_comments() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G0 X1. (start)\n(a) G1 x#1 y2. f100.\ng0 x1.\n",
            &expect![[r#"
            2 | (a) G1 x#1 y2. f100.
              |        ^ info[lower-case-letter] code in lower-case letters
        "#]],
        );
    }

    #[test]
    fn the_fix_leaves_comments_and_printed_text() {
        let program = "g0 x1. (start)\nDPRNT[abc#1[53]]\ng1 x#1 y[sin[#2]]\n";
        let found = findings(&only(&RULE), "fanuc-mill", program, &World::default());
        expect![[r#"
            G0 X1. (start)
            DPRNT[abc#1[53]]
            G1 X#1 Y[SIN[#2]]
        "#]]
        .assert_eq(&found.iter().map(|f| fixed(program, f)).collect::<String>());
    }

    #[test]
    fn controls_that_read_them() {
        check_rule(&RULE, "linuxcnc", "g0 x1\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "g0 x1.\n", &expect![[""]]);
    }
}
