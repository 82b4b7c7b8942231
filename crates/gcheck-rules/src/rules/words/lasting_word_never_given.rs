//! A code that relies on a word that no earlier block gives.

use gcheck_controls::{Code, Letter};
use gcheck_program::NeverGiven;

use crate::declare::declare_rule;
use crate::facts::lasting::{first_call_elsewhere, goes_by_way, is_refused_without};
use crate::facts::usage::may_be_called;
use crate::{FileCx, Finding, Report, Run, Severity, limit};

declare_rule! {
    /// A code needs a word that may be in an earlier block, and no earlier block has the word.
    ///
    /// ## Why it matters
    /// The control uses whatever the last program left: another tool's length, another hole's peck. After power-on it
    /// stops with an alarm. A control that forgets the word at the end of a program always stops (error).
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G43 Z1.
    /// M30
    /// ```
    /// ```nc,reported,fanuc-mill
    /// G99 G83 Z-20. R2. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// H1
    /// G43 Z1.
    /// M30
    /// ```
    /// The caller gives the words that a subprogram relies on.
    /// ```nc,quiet,fanuc-mill
    /// O100
    /// G83 Z-20. R2. F100.
    /// M99
    /// ```
    rule "lasting-word-never-given" in "words" {
        summary: "code relies on a word that no earlier block gives",
        severity: Error,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let file_index = cx.file_index;
    if may_be_called(file_index) || file_index.has_mistakes {
        return;
    }
    let elsewhere = first_call_elsewhere(file_index);
    for missing in &file_index.never_given {
        if let Some(code) = cx.control().code_at(missing.code)
            && is_first(cx, missing)
            && !goes_by_way(file_index, cx.control(), code, missing.letter)
            && elsewhere.is_none_or(|call| missing.range.start <= call)
        {
            let same: Vec<_> =
                file_index.never_given.iter().filter(|other| is_same(other, missing)).collect();
            let same: Vec<_> = same.into_iter().map(|other| other.range.clone()).collect();
            report.add(cx.if_run(finding(cx, missing, code), &same));
        }
    }
}

/// Reported where it is first missing; later blocks miss the same word.
fn is_first(cx: &FileCx<'_>, missing: &NeverGiven) -> bool {
    cx.file_index.never_given.iter().find(|other| is_same(other, missing)) == Some(missing)
}

fn is_same(one: &NeverGiven, other: &NeverGiven) -> bool {
    one.code == other.code && one.letter == other.letter
}

fn finding(cx: &FileCx<'_>, missing: &NeverGiven, code: Code<'_>) -> Finding {
    let (entry, letter) = (code.entry(), missing.letter);
    let word = entry.words.iter().find(|word| Letter::parse(&word.letter) == Some(letter));
    let is = word.map_or("", |word| word.is.as_str());
    let written = cx.slice(missing.range.clone());
    let is_refused = is_refused_without(cx.control(), code, letter);
    let finding = Finding::new(
        &META,
        missing.range.clone(),
        format!("`{written}` without `{letter}`, which no earlier block gives"),
    )
    .label(if is_refused {
        format!("needs {is}")
    } else {
        format!("uses whatever `{letter}` the last program left")
    })
    .note(format!("`{}` ({}) uses the last `{letter}`  [{}]", entry.code, entry.title, entry.source))
    .help(format!("add `{letter}` to the block"));
    if is_refused {
        let confidence = word.and_then(|word| word.confidence).unwrap_or(entry.confidence);
        finding.at_most(limit(confidence))
    } else {
        finding.at_most(Severity::Warning)
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_block_that_misses_the_word_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG43 Z1.\nG83 Z-1. R.1 F5.\nG43 Z2.\nM30\n",
            &expect![[r#"
            2 | G43 Z1.
              | ^^^ warning[lasting-word-never-given] `G43` without `H`, which no earlier block gives
            3 | G83 Z-1. R.1 F5.
              | ^^^ warning[lasting-word-never-given] `G83` without `Q`, which no earlier block gives
        "#]],
        );
    }

    #[test]
    fn other_words_may_do_instead() {
        check_rule(&RULE, "haas-mill", "G83 Z-1. R.1 I.2 J.05 K.1 F5.\nM30\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "G83 Z-1. R.1 Q#5 F5.\nG80\nG83 Z-1. R.1\nM30\n", &expect![[""]]);
    }

    #[test]
    fn the_offset_of_a_length_is_no_size() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG43 H1 Z1.\nG41 G1 X1. F10.\nG40 X0.\nM30\n",
            &expect![[r#"
            3 | G41 G1 X1. F10.
              | ^^^ warning[lasting-word-never-given] `G41` without `D`, which no earlier block gives
        "#]],
        );
        // Older controls have one table for both.
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG43 H1 Z1.\nG41 H31 G1 X1. F10.\nG40 X0.\nG41 X1.\nG40 X0.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_main_program_gives_its_subprograms_what_it_gives() {
        let program =
            |d: &str| format!("O1\n{d}G43 H1 Z1.\nM98 P2\nM30\nO2\nG41 G1 X1. F10.\nG40 X0.\nM99\n");
        check_rule(
            &RULE,
            "fanuc-mill",
            &program(""),
            &expect![[r#"
            6 | G41 G1 X1. F10.
              | ^^^ warning[lasting-word-never-given] `G41` without `D`, which no earlier block gives
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("D1\n"), &expect![[""]]);
    }

    #[test]
    fn a_call_hides_no_word() {
        let calls = [
            ("G0 X0.\nM97 P9\n", "N9 G0 X1.\nM99\n"),
            ("G0 X0.\nM98 P9\n", "O9\nG0 X1.\nM99\n"),
            (
                "G150 P9 X0. Y0. Z-0.5 Q0.25 R0.1 I0.2 K0.01 G41 D1 F10.\nG40 X0. Y0.\n",
                "N9 G1 Y1.\nX1.\nY0.\nM99\n",
            ),
        ];
        for (call, program) in calls {
            let text = format!("T1 M6\n{call}G161 X1. F5.\nM30\n{program}");
            check_rule(
                &RULE,
                "haas-mill",
                &text,
                &expect![[r#"
                    4 | G161 X1. F5.
                      | ^^^^ warning[lasting-word-never-given] `G161` without `E`, which no earlier block gives
                "#]],
            );
        }
        // A program of another file may give the word.
        check_rule(&RULE, "haas-mill", "T1 M6\nM98 P9\nG83 Z-1. R.1 F5.\nM30\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG83 Z-1. R.1 F5.\nM98 P9\nM30\n",
            &expect![[r#"
            2 | G83 Z-1. R.1 F5.
              | ^^^ warning[lasting-word-never-given] `G83` without `Q`, which no earlier block gives
        "#]],
        );
    }

    #[test]
    fn the_radius_of_an_arc_does_not_last() {
        check_rule(&RULE, "haas-mill", "G2 X1. F10.\nG3 X2. F10.\nM30\n", &expect![[""]]);
    }
}
