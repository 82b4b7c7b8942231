//! A subroutine that is defined inside another one.

use gcheck_program::{OKeyword, OWord};

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A subroutine begins (`sub`) before the one around it has ended (`endsub`).
    ///
    /// ## Why it matters
    /// Definitions of subroutines do not nest: the control stops with an error where the inner one begins. Calls nest.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// o100 sub
    /// o200 sub
    /// G0 X1
    /// o200 endsub
    /// o100 endsub
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// o200 sub
    /// G0 X1
    /// o200 endsub
    /// o100 sub
    /// o200 call
    /// o100 endsub
    /// o100 call
    /// M2
    /// ```
    rule "subroutine-inside-subroutine" in "macros" {
        summary: "subroutine that is defined inside another one",
        severity: Error,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if !cx.control().syntax().o_words {
        return;
    }
    let words = &cx.file_index.o_words;
    let mut around: Option<&OWord> = None;
    for (ix, word) in words.iter().enumerate() {
        match (word.keyword, around) {
            // Another rule reports a subroutine that never ends.
            (OKeyword::Sub, Some(outer)) if ends(outer, words.get(ix..).unwrap_or_default()) => {
                report.add(finding(cx, outer, word));
            }
            (OKeyword::Sub, _) => around = Some(word),
            (OKeyword::EndSub, Some(outer)) if outer.label == word.label => around = None,
            _ => {}
        }
    }
}

/// Is the end of the subroutine among the words?
fn ends(outer: &OWord, rest: &[OWord]) -> bool {
    rest.iter().any(|word| word.keyword == OKeyword::EndSub && word.label == outer.label)
}

fn finding(cx: &FileCx<'_>, outer: &OWord, inner: &OWord) -> Finding {
    let text = cx.slice(inner.range.clone()).trim();
    Finding::new(&META, inner.range.clone(), format!("subroutine inside another subroutine (`{text}`)"))
        .label("begins before the subroutine around it has ended")
        .also(outer.range.clone(), "the subroutine around it begins here")
        .note("definitions of subroutines do not nest; a subroutine may call another one")
        .help("move the inner subroutine, from `sub` to `endsub`, in front of the other one")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_inner_one_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o<a> sub\no1 if [#1 GT 0]\no<b> sub\nG0 X1\no<b> endsub\no1 endif\no<a> endsub\nM2\n",
            &expect![[r#"
                3 | o<b> sub
                  | ^^^^^^^^ error[subroutine-inside-subroutine] subroutine inside another subroutine (`o<b> sub`)
            "#]],
        );
    }

    #[test]
    fn one_without_its_end_is_told_elsewhere() {
        check_rule(&RULE, "linuxcnc", "o<a> sub\nG0 X1\no<b> sub\nG0 X1\no<b> endsub\nM2\n", &expect![[""]]);
    }
}
