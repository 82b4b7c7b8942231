//! A cylinder on an axis that the machine does not have.

use gcheck_controls::{Code, Effect, Letter, LetterSet};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// Cylindrical mapping names an axis that the machine file does not list.
    ///
    /// ## Why it matters
    /// Without the axis the control cannot wrap a path, and stops with an alarm. The program may be for another
    /// machine, or for one whose rotary axis has another letter.
    ///
    /// ## Reported
    /// With `axes = ["X", "Y", "Z", "A"]` in the machine file:
    /// ```nc,reported,haas-mill
    /// G107 Y0. B0. Q2.5
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G107 Y0. A0. Q2.5
    /// ```
    /// ## How to fix it
    /// * Name the rotary axis that the machine has.
    /// * If the machine has the axis, add it to `[machine] axes` in `gcheck.toml`.
    rule "cylinder-axis-not-on-machine" in "machine" {
        summary: "cylinder on an axis that the machine does not have",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Numbers, check },
    }
}

const AXES: LetterSet = LetterSet::of("XYZABC");

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some(axes) = cx.environment.machine.axes else { return };
    let Some((_, code)) = cx.codes().find(|(_, code)| code.effect() == Effect::CylinderMapping) else {
        return;
    };
    // A word with a variable may count as missing.
    let missing =
        |word: &&Word| AXES.contains(word.letter) && !axes.contains(word.letter) && word.number().is_some();
    if cx.words_are_plain() {
        for word in cx.words().iter().filter(missing) {
            report.add(finding(cx, code, word, axes));
        }
    }
}

fn finding(cx: &BlockCx<'_>, code: Code<'_>, word: &Word, axes: LetterSet) -> Finding {
    let entry = code.entry();
    let letter = word.letter;
    let listed = "XYZABCUVW".chars().filter(|axis| axes.contains(Letter::of(*axis)));
    let names: Vec<String> = listed.map(String::from).collect();
    Finding::new(
        &META,
        cx.range(word),
        format!("the machine has no axis `{letter}` for the cylinder (`{}`)", cx.written(code)),
    )
    .label("not among the axes of the machine file")
    .note(format!("the machine file lists {}", names.join(" ")))
    .help("name an axis that the machine has, or correct `axes` in the machine file")
    .at_most(limit(entry.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_controls::LetterSet;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in, findings, only, words};

    fn world() -> World<'static> {
        let mut world = World::default();
        world.machine.axes = Some(LetterSet::of("XYZA"));
        world
    }

    #[test]
    fn only_axes_that_are_not_listed() {
        let program = "G107 Y0. B0. Q2.5\nG107 Y0. A0. Q2.5\nG107 B#1 Q2.\nG107\n";
        check_rule_in(
            &RULE,
            "haas-mill",
            program,
            &world(),
            &expect![[r#"
            1 | G107 Y0. B0. Q2.5
              |          ^^^ error[cylinder-axis-not-on-machine] the machine has no axis `B` for the cylinder (`G107`)
        "#]],
        );
    }

    #[test]
    fn a_machine_that_nobody_described_may_have_any() {
        check_rule(&RULE, "haas-mill", "G107 Y0. B0. Q2.5\n", &expect![[""]]);
    }

    #[test]
    fn what_it_says() {
        let found = findings(&only(&RULE), "haas-mill", "G107 Y0. B0. Q2.5\n", &world());
        expect![[r#"
            the machine has no axis `B` for the cylinder (`G107`)
              here: not among the axes of the machine file
              note: the machine file lists X Y Z A
              help: name an axis that the machine has, or correct `axes` in the machine file
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
