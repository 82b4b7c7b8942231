//! A code whose comment the control reads, without that comment.

use gcheck_controls::{Code, CommentForm, CommentRead};
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::beside::given;
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Watch, limit};

declare_rule! {
    /// The control reads the comment of this block: a text to engrave, a time to sleep, a picture to show. The block has no
    /// comment after the code, or the comment is written in another way.
    ///
    /// ## Why it matters
    /// Nothing is engraved, the machine does not wait, or the operator does not see the picture.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G47 P0 X0. Y0. Z-0.01 R0.1 J0.5 F10.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// M95 (TOMORROW)
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G47 P0 (LOT 7) X0. Y0. Z-0.01 R0.1 J0.5 F10.
    /// M30
    /// ```
    /// ```nc,quiet,haas-mill
    /// M95 (08:30)
    /// M30
    /// ```
    rule "comment-missing" in "words" {
        summary: "code without the comment that it reads",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(CommentMissing) },
    }
}

struct CommentMissing;

impl PathRule for CommentMissing {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.is_malformed() {
            return;
        }
        for ix in cx.codes().iter() {
            let Some(code) = cx.control().code_at(*ix) else { continue };
            let is_read = |row: &&CommentRead| {
                row.with.is_empty() || row.with.iter().any(|item| given(cx, item).is_some())
            };
            let Some(row) = code.entry().reads_comment.iter().find(is_read) else { continue };
            let comment = comment_after(cx, code);
            if !comment.as_deref().is_some_and(|comment| has_form(comment, row.form)) {
                report.add(finding(cx, code, row, comment.as_deref()));
            }
        }
    }
}

/// What is in the first parentheses after the code.
fn comment_after(cx: &PathCx<'_>, code: Code<'_>) -> Option<String> {
    let (file, place) = cx.program.file(cx.origin().at.file).zip(cx.place())?;
    let words = place.table.words(place.block()).iter();
    let is_code =
        |word: &&Word| cx.control().code_at(word.code).is_some_and(|own| own.number() == code.number());
    let begins = words.into_iter().find(is_code)?.range().start + place.base;
    let text = file.loaded.slice(begins..place.range().end);
    let comment = text.split_once('(')?.1;
    Some(comment.split(')').next().unwrap_or_default().to_owned())
}

fn has_form(comment: &str, form: CommentForm) -> bool {
    match form {
        CommentForm::Text => !comment.trim().is_empty(),
        CommentForm::HoursAndMinutes => is_hours_and_minutes(comment.trim()),
        CommentForm::MediaFile => is_media_file(comment.trim()),
    }
}

/// `PART.PNG`: pictures and films that controls show.
fn is_media_file(text: &str) -> bool {
    let ending = text.rsplit_once('.').map_or("", |(_, ending)| ending);
    ["png", "jpeg", "jpg", "mp4", "mov"].iter().any(|known| ending.eq_ignore_ascii_case(known))
}

/// `08:30`: digits on both sides, and no hour with more than 59 minutes.
fn is_hours_and_minutes(text: &str) -> bool {
    let is_number = |part: &str| part.bytes().all(|b| b.is_ascii_digit());
    text.split_once(':').is_some_and(|(hours, minutes)| {
        (1..=3).contains(&hours.len())
            && is_number(hours)
            && minutes.len() == 2
            && is_number(minutes)
            && minutes < "60"
    })
}

fn finding(cx: &PathCx<'_>, code: Code<'_>, row: &CommentRead, comment: Option<&str>) -> Finding {
    let (name, entry) = (code.number(), code.entry());
    let range = cx.word_range(|word| cx.control().code_at(word.code).is_some_and(|own| own.number() == name));
    let example = match row.form {
        CommentForm::Text => "(TEXT)",
        CommentForm::HoursAndMinutes => "(08:30)",
        CommentForm::MediaFile => "(PART.PNG)",
    };
    let what = match comment {
        Some(comment) if !comment.trim().is_empty() => {
            format!("`{name}` cannot read its comment `({comment})`")
        }
        _ => format!("`{name}` without the comment that it reads"),
    };
    cx.finding(&META, range, what)
        .label(format!("needs {}", row.is))
        .note(format!(
            "`{name}` ({}) reads the comment of its block: {}  [{}]",
            entry.title, row.is, entry.source
        ))
        .help(format!("write it as `{example}` in the block"))
        // A picture that is not shown breaks nothing.
        .at_most(if row.form == CommentForm::MediaFile { Severity::Info } else { Severity::Warning })
        .at_most(limit(entry.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_text_is_needed_for_a_text_only() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0.\n#1=0\nG47 P#1 X0. Z-0.1 R1. J5. F100.\nG47 P0 ( ) X0. Z-0.1 R1. J5. F100.\nG47 P65 X0. Z-0.1 R1. J5. F100.\nG47 P1 (####) X0. Z-0.1 R1. J5. F100.\nG47 P1 X0. Z-0.1 R1. J5. F100.\nG47 P#100 X0. Z-0.1 R1. J5. F100.\nM30\n",
            &expect![[r#"
                3 | G47 P#1 X0. Z-0.1 R1. J5. F100.
                  | ^^^ warning[comment-missing] `G47` without the comment that it reads
                4 | G47 P0 ( ) X0. Z-0.1 R1. J5. F100.
                  | ^^^ warning[comment-missing] `G47` without the comment that it reads
                7 | G47 P1 X0. Z-0.1 R1. J5. F100.
                  | ^^^ warning[comment-missing] `G47` without the comment that it reads
            "#]],
        );
    }

    #[test]
    fn a_time_has_hours_and_minutes() {
        for control in ["haas-mill", "haas-lathe"] {
            check_rule(
                &RULE,
                control,
                "M95\nM95 (00:30)\nM95 ( 8:05 )\nM95 (12:60)\nM95 (10 MIN)\nM95 (WARM UP) (00:30)\n(WARM UP) M95 (00:30)\nM95 (8:5)\nM30\n",
                &expect![[r#"
                    1 | M95
                      | ^^^ warning[comment-missing] `M95` without the comment that it reads
                    4 | M95 (12:60)
                      | ^^^ warning[comment-missing] `M95` cannot read its comment `(12:60)`
                    5 | M95 (10 MIN)
                      | ^^^ warning[comment-missing] `M95` cannot read its comment `(10 MIN)`
                    6 | M95 (WARM UP) (00:30)
                      | ^^^ warning[comment-missing] `M95` cannot read its comment `(WARM UP)`
                    8 | M95 (8:5)
                      | ^^^ warning[comment-missing] `M95` cannot read its comment `(8:5)`
                "#]],
            );
        }
    }
}
