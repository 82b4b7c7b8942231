//! A dwell that does not say how long.

use gcheck_controls::{Effect, Letter, LetterSet, Need};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, Severity, limit};

declare_rule! {
    /// A dwell has none of the words that hold its time. `required-word-missing` reports it where the control has one word
    /// for the time and needs it.
    ///
    /// ## Why it matters
    /// The control does not wait: on some it makes an exact stop, on others nothing. A word such as `F` or `S` beside the
    /// dwell sets the feed or the speed, not the time.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G4 F1.5
    /// ```
    /// ```nc,reported,generic-mill
    /// G4
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G4 X1.5
    /// ```
    rule "dwell-without-time" in "motion" {
        summary: "dwell that does not say how long",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some((word, code)) = cx.codes().find(|(_, code)| code.effect() == Effect::Dwell) else { return };
    let entry = code.entry();
    let any = cx.codes().any(|(_, code)| code.entry().any_words || code.is_user());
    if any || !cx.words_are_plain() || entry.words.iter().any(|word| word.need == Need::Required) {
        return;
    }
    let times: LetterSet =
        cx.control().semantics().dwell.keys().filter_map(|letter| Letter::parse(letter)).collect();
    if times.is_empty() || cx.words().iter().any(|word| times.contains(word.letter)) {
        return;
    }
    let is_other = |word: &&Word| !word.code.is_some() && word.letter != Letter::of('N');
    let stray = cx.words().iter().find(is_other);
    let names: Vec<String> = times.iter().map(|letter| format!("`{letter}`")).collect();
    let names = names.join(", ");
    let name = cx.written(code);
    let label = match stray {
        Some(stray) => format!("`{}` is not its time", cx.text(stray)),
        None => "no time".to_owned(),
    };
    let finding = Finding::new(&META, cx.range(word), format!("`{name}` without a time"))
        .label(label)
        .note(format!("`{name}` reads the time from one of {names}  [{}]", entry.source))
        .help("give the time; for an exact stop write the code of the exact stop")
        .at_most(limit(entry.confidence));
    // Alone it may be meant as an exact stop.
    report.add(if stray.is_none() { finding.at_most(Severity::Info) } else { finding });
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn alone_and_with_a_word_that_is_not_a_time() {
        check_rule(
            &RULE,
            "generic-mill",
            "G04\nN5 G04\nG04 F100.\nG04 S100\nG04 P100\nG04 X1.\nG04 U1.\n",
            &expect![[r#"
                1 | G04
                  | ^^^ info[dwell-without-time] `G04` without a time
                2 | N5 G04
                  |    ^^^ info[dwell-without-time] `G04` without a time
                3 | G04 F100.
                  | ^^^ warning[dwell-without-time] `G04` without a time
                4 | G04 S100
                  | ^^^ warning[dwell-without-time] `G04` without a time
            "#]],
        );
    }

    #[test]
    fn a_time_that_is_required_is_for_another_rule() {
        check_rule(&RULE, "haas-mill", "G04\nG04 F1.\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", "G4\n", &expect![[""]]);
    }
}
