//! A call whose computed number names a program that is not known.

use gcheck_controls::{Letter, WordKind};
use gcheck_engine::{Abstract, Domain};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::facts::offset_schemes::whole;
use crate::facts::program_calls::Programs;
use crate::{Finding, PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A call computes the number of its program, and the program is neither in the file nor beside it. For numbers as
    /// they are written see `subprogram-missing`.
    ///
    /// ## Why it matters
    /// If the program is not in the control's memory either, the control stops with an alarm at the call.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// O0001
    /// #100=2000
    /// M98 P#100
    /// M30
    /// O0100
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// O0001
    /// #100=99
    /// M98 P[#100+1]
    /// M98 P#500
    /// M30
    /// O0100
    /// M99
    /// ```
    rule "computed-subprogram-missing" in "program" {
        summary: "computed number of a program that is not in the file or beside it",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::COMPUTED, make: || Box::new(ComputedSubprogramMissing) },
    }
}

struct ComputedSubprogramMissing;

impl PathRule for ComputedSubprogramMissing {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // The caller may give another number.
        let is_called = cx.depth() == 1 && cx.file_index.is_called_from_elsewhere();
        if is_called || cx.origin().flags.contains(BlockFlags::ERROR) {
            return;
        }
        for (word, value) in cx.computed_words() {
            let Some(number) = Abstract::known(value).and_then(whole) else { continue };
            let facts = cx.facts(word.letter).filter(|facts| facts.kind == WordKind::Program);
            let Some(code) = facts.and_then(|facts| facts.code) else { continue };
            let mut entries = code.entry().words.iter();
            let Some(entry) = entries.find(|entry| Letter::parse(&entry.letter) == Some(word.letter)) else {
                continue;
            };
            if let Some(missing) = Programs::new(cx.environment, cx.file_index).missing(number, entry) {
                report.add(finding(cx, word, &code.entry().code, missing));
            }
        }
    }
}

fn finding(cx: &PathCx<'_>, word: &Word, code: &str, number: u32) -> Finding {
    let range = cx.find_word(cx.origin().at, |other| other.range() == word.range());
    cx.finding(
        &META,
        range.unwrap_or_else(|| cx.range()),
        format!("called program `O{number}` is missing (computed)"),
    )
    .label(format!("`{code}` calls `O{number}` here"))
    .note("gcheck searched this file and the folders that it was given")
    .assuming(format!("`O{number}` may be in the memory of the control"))
    .help(format!("correct the expression, add the program `O{number}`, or name its folder under `[search]`"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn whatever_code_calls() {
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\n#100=7\nG105 I30. J25. K60. P#100\nG65 P#100\nM98 P[#100-5]\nM30\nO2\nM99\n",
            &expect![[r#"
                3 | G105 I30. J25. K60. P#100
                  |                     ^^^^^ warning[computed-subprogram-missing] called program `O7` is missing (computed)
            "#]],
        );
    }

    #[test]
    fn an_outline_may_be_a_block_of_the_program() {
        let pocket = "O1\n#1=9\nG150 P#1 X0. Y0. Z-0.5 Q0.25 R0.1 I0.2 K0.01 G41 D1 F10.\nG40 X0. Y0.\nM30\n";
        check_rule(&RULE, "haas-mill", &format!("{pocket}N9 G1 Y1.\nX1.\nM99\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &format!("{pocket}N8 G1 Y1.\nX1.\nM99\n"),
            &expect![[r#"
            3 | G150 P#1 X0. Y0. Z-0.5 Q0.25 R0.1 I0.2 K0.01 G41 D1 F10.
              |      ^^^ warning[computed-subprogram-missing] called program `O9` is missing (computed)
        "#]],
        );
    }

    #[test]
    fn a_number_that_the_caller_gives_may_be_any() {
        check_rule(&RULE, "fanuc-mill", "O9000\n#100=#1+7\nM98 P#100\nM99\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", "O1\nM98 P#500\nM98 P#1\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_macro_calls_by_its_argument() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG65 P2 A3.\nG65 P2 A4.\nM30\nO2\nM98 P#1\nM99\nO3\nM99\n",
            &expect![[r#"
                6 | M98 P#1
                  |     ^^^ warning[computed-subprogram-missing] called program `O4` is missing (computed)
            "#]],
        );
    }
}
