//! A line longer than the control reads.

use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A line has more characters than the control reads.
    ///
    /// ## Why it matters
    /// The control refuses the line or cuts it off, even if it is a comment.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// (0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789)
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// (a comment of one line)
    /// ```
    /// A control without a known limit is not judged.
    /// ```nc,quiet,haas-mill
    /// (0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789)
    /// ```
    rule "line-too-long" in "syntax" {
        summary: "line longer than the control reads",
        severity: Error,
        tier: Block,
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
    let kept = text.char_indices().nth(limit as usize).map_or(text.len(), |(at, _)| at) as u32;
    let source = cx.control().limits().source.as_deref().map(|s| format!("  [{s}]")).unwrap_or_default();
    Finding::new(
        &META,
        cx.in_file(block.start + kept..block.end),
        format!("line has {} characters, the control reads {limit}", text.chars().count()),
    )
    .label("too much")
    .note(format!("a line has at most {limit} characters on this control, comments included{source}"))
    .help("shorten the comment, or write the block in several lines")
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
