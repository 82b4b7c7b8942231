//! A minus sign before zero.

use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::facts::notation::MAX_PLACES;
use crate::{Edit, FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// A number is minus zero: `X-0.`. Reported once per file.
    ///
    /// ## Why it matters
    /// It means zero, and comes from a rounded number of a post-processor. It makes the reader ask what is negative.
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
        summary: "minus sign before zero",
        severity: Hint,
        tier: Program,
        recommended: false,
        sets: [HouseStyle],
        fixable: Safely,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let mut edits = Vec::new();
    let mut first = None;
    cx.each_block(|block| {
        if block.block().flags.contains(BlockFlags::ERROR) || edits.len() >= MAX_PLACES {
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
        Finding::new(&META, place, format!("minus zero: `{word}`"))
            .label(if count == 1 { "means zero".to_owned() } else { format!("the first of {count}") })
            .help("write it without the sign")
            .fix(Fix { title: "remove the sign".to_owned(), safe: true, edits }),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn all_signs_are_taken_away() {
        assert_eq!(
            fixes_of(&RULE, "haas-mill", "G1 X-0. Y-.0\nZ-0.000 F1.\nX-0.001\n"),
            "G1 X0. Y.0\nZ0.000 F1.\nX-0.001\n"
        );
        check_rule(&RULE, "haas-mill", "G1 X0. Y[-0]\n", &expect![[""]]);
    }
}
