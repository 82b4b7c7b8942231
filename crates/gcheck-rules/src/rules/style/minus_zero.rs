//! A minus sign before nought.

use gcheck_program::BlockFlags;

use crate::meta::declare_rule;
use crate::writing::MOST_PLACES;
use crate::{Edit, FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// A number is minus nought: `X-0.`. Told once for the file.
    ///
    /// ## Why it matters
    /// It means nought, and comes from a rounded number of a post-processor. It stops the reader, who asks what is negative.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G1 X-0. Y1. F10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G1 X0. Y-0.001 F10.
    /// M30
    /// ```
    rule "minus-zero" in "style" {
        summary: "minus sign before nought",
        severity: Hint,
        tier: Program,
        recommended: false,
        sets: [HouseStyle],
        mends: Safely,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let mut edits = Vec::new();
    let mut first = None;
    cx.each_block(|block| {
        if block.block().flags.contains(BlockFlags::ERROR) || edits.len() >= MOST_PLACES {
            return;
        }
        for word in block.words().iter().filter(|word| word.shape.minus && word.number() == Some(0.0)) {
            let range = block.range(word);
            if let Some(at) = block.text(word).find('-') {
                first.get_or_insert_with(|| (range.clone(), block.text(word).to_owned()));
                let at = range.start + at as u32;
                edits.push(Edit { range: at..at + 1, text: String::new() });
            }
        }
    });
    let Some((place, word)) = first else { return };
    let count = edits.len();
    report.add(
        Finding::new(&META, place, format!("minus nought: `{word}`"))
            .label(if count == 1 { "means nought".to_owned() } else { format!("the first of {count}") })
            .help("write it without the sign")
            .fix(Fix { title: "take the sign away".to_owned(), safe: true, edits }),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, mended};

    #[test]
    fn all_signs_are_taken_away() {
        assert_eq!(
            mended(&RULE, "haas-mill", "G1 X-0. Y-.0\nZ-0.000 F1.\nX-0.001\n"),
            "G1 X0. Y.0\nZ0.000 F1.\nX-0.001\n"
        );
        check_rule(&RULE, "haas-mill", "G1 X0. Y[-0]\n", &expect![[""]]);
    }
}
