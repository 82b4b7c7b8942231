//! A jump to a sequence number that the program does not have.

use std::cmp::Ordering;

use gcheck_controls::{Code, WordEntry, WordKind};
use gcheck_program::{Jump, Label};

use crate::declare::declare_rule;
use crate::facts::sections::{label_index, program_around, target_word};
use crate::{FileCx, Finding, Fix, Report, Run, Severity, limit};

declare_rule! {
    /// A jump names a sequence number that the program does not have.
    ///
    /// ## Why it matters
    /// The control searches the program for the number and stops with an alarm when the block runs, often in the middle of
    /// a cut.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// IF [#100 GT 5] GOTO 20
    /// N10 M30
    /// ```
    /// The control searches for the blocks of a lathe profile in the same way.
    /// ```nc,reported,haas-lathe
    /// G71 P100 Q200 D0.05 U0.02 W0.005 F0.01
    /// N100 G0 X1.
    /// N210 G1 Z-1.
    /// ```
    /// ## Not reported
    /// A computed target is not known here.
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// IF [#100 GT 5] GOTO 10
    /// GOTO #101
    /// N10 M30
    /// ```
    /// The `P` of `M99` names a block of the calling program on some controls.
    /// ```nc,quiet,fanuc-mill
    /// O0002
    /// M99 P100
    /// ```
    rule "jump-target-missing" in "program" {
        summary: "jump to a sequence number that does not exist",
        severity: Error,
        tier: Program,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if cx.file_index.jumps.is_empty() {
        return;
    }
    let index = label_index(cx);
    let mut numbers = None;
    for jump in &cx.file_index.jumps {
        let Some(target) = jump.target else { continue };
        let word = target_word(cx, jump.code, WordKind::Label, cx.slice(jump.range.clone()));
        let is_elsewhere = word.is_some_and(|(_, word)| word.elsewhere);
        if !is_elsewhere && index.within(target, &program_around(cx, jump.range.start)).is_empty() {
            let numbers = numbers.get_or_insert_with(|| numbers_by_program(cx));
            let finding = finding(jump, target, word, index.all(target).first().copied())
                .fix_if(to_nearest(cx, numbers, jump, target));
            // Whether a row of data is also a block to jump to, no manual says.
            let finding = if cx.file_index.has_data() { finding.at_most(Severity::Warning) } else { finding };
            report.add(cx.if_run(finding, std::slice::from_ref(&jump.range)));
        }
    }
}

/// The numbers of the file's labels with the first byte of their program, in order, each once.
fn numbers_by_program(cx: &FileCx<'_>) -> Vec<(u32, u32)> {
    let labels = cx.file_index.labels.iter();
    let mut numbers: Vec<(u32, u32)> =
        labels.map(|label| (program_around(cx, label.range.start).start, label.number)).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// Jumps to the label of the program whose number is nearest, if one is nearer than all others.
fn to_nearest(cx: &FileCx<'_>, numbers: &[(u32, u32)], jump: &Jump, target: u32) -> Option<Fix> {
    let program = program_around(cx, jump.range.start).start;
    let above = numbers.partition_point(|known| *known < (program, target));
    let of_program = |at: usize| numbers.get(at).filter(|(of, _)| *of == program).map(|(_, number)| *number);
    let nearest = match (above.checked_sub(1).and_then(of_program), of_program(above)) {
        (Some(below), Some(above)) => match (target - below).cmp(&(above - target)) {
            Ordering::Less => below,
            Ordering::Equal => return None,
            Ordering::Greater => above,
        },
        (only, None) | (None, only) => only?,
    };
    // The number is the last thing in the word or statement.
    let text = cx.slice(jump.range.clone());
    let digits = text.len() - text.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let end = jump.range.start + text.len() as u32;
    (digits > 0)
        .then(|| Fix::risky(format!("jump to `N{nearest}`"), end - digits as u32..end, nearest.to_string()))
}

fn finding(
    jump: &Jump,
    target: u32,
    word: Option<(Code<'_>, &WordEntry)>,
    elsewhere: Option<&Label>,
) -> Finding {
    let (by, limit) = match word {
        Some((code, word)) => {
            (code.entry().code.as_str(), limit(word.confidence.unwrap_or(code.entry().confidence)))
        }
        None => ("GOTO", Severity::Error),
    };
    let finding = Finding::new(
        &META,
        jump.range.clone(),
        format!("jump target `N{target}` does not exist in this program"),
    )
    .label(format!("`{by}` searches for `N{target}`"))
    .note(
        "the control searches for the number when the block runs, and stops with an alarm if it is not found",
    )
    .help(format!("add `N{target}` to the target block, or correct the number"))
    .at_most(limit);
    match elsewhere {
        Some(label) => finding.also(label.range.clone(), "this one belongs to another program of the file"),
        None => finding,
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

    #[test]
    fn the_label_with_the_nearest_number_is_offered() {
        let offered = |text: &str| {
            let found = findings(&only(&RULE), "fanuc-mill", text, &World::default());
            let fixes = found.into_iter().flat_map(|finding| finding.fixes);
            fixes
                .map(|fix| (fix.title, fix.edits[0].range.clone(), fix.edits[0].text.clone()))
                .collect::<Vec<_>>()
        };
        assert_eq!(
            offered("O1\nIF [#100 GT 5] GOTO 21\nN20 G0 X1.\nN90 M30\n"),
            [("jump to `N20`".to_owned(), 23..25, "20".to_owned())]
        );
        assert_eq!(offered("O1\nGOTO 20\nN10 G0 X1.\nN30 M30\n"), [], "two are as near");
        assert_eq!(offered("O1\nGOTO 20\nM30\nO2\nN21 M99\n"), [], "of another program");
        let titles = |text: &str| offered(text).into_iter().map(|(title, ..)| title).collect::<Vec<_>>();
        assert_eq!(
            titles("O1\nN5\nM30\nO2\nGOTO 20\nN90\nN90 M99\nO3\nN21 M99\n"),
            ["jump to `N90`"],
            "above"
        );
        assert_eq!(titles("O1\nN19\nM30\nO2\nGOTO 20\nN5\nM99\nO3\nN21 M99\n"), ["jump to `N5`"], "below");
    }

    /// What takes a step for each pair of a jump and a label takes a minute.
    #[test]
    fn every_one_of_very_many_jumps_is_offered_its_nearest_label() {
        let mut text = "O1\n".to_owned();
        for number in 0..9_900 {
            writeln!(text, "IF [#1 EQ {number}] GOTO {}", number * 10 + 1).unwrap();
            for label in 2..10 {
                writeln!(text, "N{}", number * 10 + label).unwrap();
            }
        }
        text.push_str("M30\n");
        let found = findings(&only(&RULE), "fanuc-mill", &text, &World::default());
        assert_eq!(found.iter().flat_map(|finding| &finding.fixes).count(), 9_900);
    }

    #[test]
    fn labels_of_another_program_in_the_file_do_not_count() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nGOTO 10\nM30\nO2\nN10 M99\n",
            &expect![[r#"
                2 | GOTO 10
                  | ^^^^^^^ error[jump-target-missing] jump target `N10` does not exist in this program
            "#]],
        );
    }

    #[test]
    fn a_label_behind_the_closing_tape_mark_is_not_read() {
        check_rule(
            &RULE,
            "haas-mill",
            "%\nO1\nM97 P10\nM99 P20\nM30\n%\nN10 M99\nN20\n",
            &expect![[r#"
            3 | M97 P10
              |     ^^^ error[jump-target-missing] jump target `N10` does not exist in this program
            4 | M99 P20
              |     ^^^ error[jump-target-missing] jump target `N20` does not exist in this program
        "#]],
        );
    }

    #[test]
    fn a_word_that_two_codes_could_read_is_nobodys_target() {
        check_rule(&RULE, "haas-mill", "G4 P5 M99\n", &expect![[""]]);
    }

    #[test]
    fn computed_targets_are_not_judged() {
        check_rule(&RULE, "haas-lathe", "N1 GOTO [#1+10]\nM97 P#5\nM30\n", &expect![[""]]);
    }
}
