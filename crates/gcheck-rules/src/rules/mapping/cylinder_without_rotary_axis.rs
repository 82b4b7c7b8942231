//! A cylinder without a rotary axis.

use gcheck_controls::{Code, Effect, Letter, LetterSet};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::facts::word_sets::{NEED_A_ROTARY_AXIS, choice};
use crate::{BlockCx, Finding, Reads, Report, Run, Severity, limit};

declare_rule! {
    /// Cylindrical mapping names a linear axis or a size, but not the rotary axis.
    ///
    /// ## Why it matters
    /// The control does not know which axis turns the part, and stops with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G107 Y0. Q2.5
    /// ```
    /// ```nc,reported,haas-mill
    /// G107 R1.25
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G107 Y0. A0. Q2.5
    /// G107 B0. Q4.
    /// ```
    /// The code alone ends mapping.
    /// ```nc,quiet,haas-mill
    /// G107
    /// ```
    rule "cylinder-without-rotary-axis" in "mapping" {
        summary: "cylinder without a rotary axis",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Numbers, check },
    }
}

const ROTARY: LetterSet = LetterSet::of("ABC");

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if cx.control().semantics().cylinder.is_none() {
        return;
    }
    let Some((_, code)) = cx.codes().find(|(_, code)| code.effect() == Effect::CylinderMapping) else {
        return;
    };
    if cx.block().letters.intersects(code.reads().and(ROTARY)) {
        return;
    }
    // A word with a variable may count as missing.
    let is_given = |word: &&Word| NEED_A_ROTARY_AXIS.contains(word.letter) && word.number().is_some();
    if let Some(word) = cx.words().iter().find(is_given)
        && cx.words_are_plain()
    {
        report.add(finding(cx, code, word));
    }
}

fn finding(cx: &BlockCx<'_>, code: Code<'_>, word: &Word) -> Finding {
    let entry = code.entry();
    let name = cx.written(code);
    let reads = code.reads().and(ROTARY);
    let what = if matches!(word.letter.ascii(), b'Q' | b'R') { "a size" } else { "an axis to wrap" };
    let alarm = entry.alarms.iter().find(|alarm| alarm.number.is_some());
    let disputed = entry.disputed.iter().find_map(|row| {
        let letter = Letter::parse(&row.letter).filter(|letter| ROTARY.contains(*letter))?;
        Some((cx.words().iter().find(|word| word.letter == letter)?, row.why.as_str()))
    });
    if let Some((word, why)) = disputed {
        return of_other_pages(cx, code, word, why);
    }
    Finding::new(&META, cx.range(word), format!("the cylinder has no rotary axis (`{name}`)"))
        .label(format!("{what} needs {} in the block", choice(reads)))
        .note(format!(
            "`{}` ({}) stops with an alarm when a linear axis or a size comes without a rotary axis  [{}]",
            entry.code, entry.title, entry.source
        ))
        .alarm(alarm.map(|alarm| alarm.text.clone()))
        .help(format!(
            "name the axis that turns the part: `{}0.`",
            reads.iter().next().unwrap_or(Letter::of('A'))
        ))
        .at_most(limit(entry.confidence))
}

/// An axis that some pages list and others do not.
fn of_other_pages(cx: &BlockCx<'_>, code: Code<'_>, word: &Word, why: &str) -> Finding {
    let entry = code.entry();
    let (name, letter) = (cx.written(code), word.letter);
    Finding::new(
        &META,
        cx.range(word),
        format!("not every control takes a cylinder on `{letter}` (`{name}`)"),
    )
    .label("an older control finds no rotary axis here, and stops with an alarm")
    .note(format!("the pages of `{}` differ: {why}  [{}]", entry.code, entry.source))
    .help(format!(
        "look up whether the control's own page lists `{letter}`; if not, the part must turn on {}",
        choice(code.reads().and(ROTARY))
    ))
    .at_most(Severity::Warning)
    .at_most(limit(entry.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn every_word_that_needs_one_is_found() {
        check_rule(
            &RULE,
            "haas-mill",
            "G107 X0.\nG107 Z#1 Q[#2*2]\nG107 Q0.\n/G107 Y0.\nG107 R-1.\nG107 Y#1 A#2\nG107 Y0. C0. Q2.\n",
            &expect![[r#"
                1 | G107 X0.
                  |      ^^^ error[cylinder-without-rotary-axis] the cylinder has no rotary axis (`G107`)
                2 | G107 Z#1 Q[#2*2]
                  |          ^^^^^^^ error[cylinder-without-rotary-axis] the cylinder has no rotary axis (`G107`)
                3 | G107 Q0.
                  |      ^^^ error[cylinder-without-rotary-axis] the cylinder has no rotary axis (`G107`)
                4 | /G107 Y0.
                  |       ^^^ error[cylinder-without-rotary-axis] the cylinder has no rotary axis (`G107`)
                5 | G107 R-1.
                  |      ^^^^ error[cylinder-without-rotary-axis] the cylinder has no rotary axis (`G107`)
                7 | G107 Y0. C0. Q2.
                  |          ^^^ warning[cylinder-without-rotary-axis] not every control takes a cylinder on `C` (`G107`)
            "#]],
        );
    }

    #[test]
    fn a_radius_in_the_axis_word_is_another_form() {
        check_rule(&RULE, "fanuc-mill", "G107 C50.\nG107 Z0.\n", &expect![[""]]);
    }

    #[test]
    fn a_lathe_takes_c_too() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G107 Z0. R1.\nG107 Z0. C0. R1.\n",
            &expect![[r#"
            1 | G107 Z0. R1.
              |      ^^^ error[cylinder-without-rotary-axis] the cylinder has no rotary axis (`G107`)
        "#]],
        );
    }

    #[test]
    fn what_it_says() {
        let found = findings(&only(&RULE), "haas-mill", "G107 Y0. Q2.5\n", &World::default());
        expect![[r#"
            the cylinder has no rotary axis (`G107`)
              here: an axis to wrap needs `A` or `B` in the block
              note: `G107` (cylindrical mapping) stops with an alarm when a linear axis or a size comes without a rotary axis  [Haas 96-8000 June 1999 p.203 (printed); gcodes.net, G107; Haas online manual, inverse time and feed per minute modes; HM17 p.307]
              help: name the axis that turns the part: `A0.`
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
