//! A line longer than the control reads.

use gcheck_controls::LineCounts;
use gcheck_program::{BlockFlags, counted_characters, places_that_count};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A line has more characters than the control reads.
    ///
    /// ## Why it matters
    /// The control refuses the line or cuts it off; on most controls even if it is a comment.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// (0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789)
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// (a comment of one line)
    /// ```
    /// Some controls take blanks and comments out before they count.
    /// ```nc,quiet,grbl
    /// G1 X10.000 Y20.000 F500 (a comment that is longer than everything else in this line and means nothing to the control)
    /// ```
    /// A control without a known limit is not judged.
    /// ```nc,quiet,haas-mill
    /// (0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789)
    /// ```
    rule "line-too-long" in "syntax" {
        summary: "line longer than the control reads",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::LONG_LINE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if let Some(limit) = cx.control().limits().line_length {
        report.add(finding(cx, limit));
    }
}

fn finding(cx: &BlockCx<'_>, limit: u32) -> Finding {
    let block = cx.block().range.clone();
    let text = cx.block_text();
    let counts = cx.control().limits().line_counts;
    let kept = places_that_count(text, counts).nth(limit as usize).unwrap_or(text.len()) as u32;
    let (of_which, help) = match counts {
        LineCounts::Everything => {
            ("comments included", "shorten the comment, or write the block in several lines")
        }
        LineCounts::Code => (
            "blanks and comments not counted",
            "write the block in several lines, or with fewer decimals than the machine resolves",
        ),
    };
    let source = cx.control().limits().source.as_deref().map(|s| format!("  [{s}]")).unwrap_or_default();
    Finding::new(
        &META,
        cx.in_file(block.start + kept..block.end),
        format!("line has {} characters, the control reads {limit}", counted_characters(text, counts)),
    )
    .label("too much")
    .note(format!("a line has at most {limit} characters on this control, {of_which}{source}"))
    .help(help)
}

#[cfg(test)]
mod tests {
    use super::RULE;
    use crate::testing::{World, findings, only};

    #[test]
    fn characters_count_and_not_bytes() {
        for (letter, count, reported) in [("a", 253, 0), ("a", 254, 1), ("ä", 253, 0), ("ä", 254, 1)] {
            let program = format!("({})\n", letter.repeat(count));
            let found = findings(&only(&RULE), "linuxcnc", &program, &World::default());
            assert_eq!(found.len(), reported, "{count} of {letter}");
        }
    }

    #[test]
    fn the_rest_of_the_line_is_marked() {
        let program = format!("({})\n", "a".repeat(300));
        let found = findings(&only(&RULE), "linuxcnc", &program, &World::default());
        let places: Vec<_> = found.iter().map(|f| (f.range.start, f.range.end)).collect();
        assert_eq!(places, [(255, 302)]);
        assert!(findings(&only(&RULE), "fanuc-mill", &program, &World::default()).is_empty());
    }
}
