//! Sequence numbers that go back.

use gcheck_program::Label;

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// The sequence numbers of a program rise, and then one is lower than the one before it. Reported once per file.
    ///
    /// ## Why it matters
    /// Blocks were moved or pasted in. A person who scrolls through the program for a number misses it.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// N10 G0 X1.
    /// N20 X2.
    /// N30 X3.
    /// N25 X4.
    /// N40 M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// N10 G0 X1.
    /// N20 X2.
    /// N30 X3.
    /// N40 M30
    /// ```
    rule "sequence-numbers-not-rising" in "style" {
        summary: "sequence number lower than the one before",
        severity: Hint,
        tier: Program,
        recommended: false,
        sets: [HouseStyle],
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let programs = &cx.file_index.programs;
    let program =
        |label: &Label| programs.partition_point(|program| program.range.start <= label.range.start);
    let pairs = cx.file_index.labels.windows(2).filter_map(|pair| match pair {
        [before, label] if program(before) == program(label) => Some((before, label)),
        _ => None,
    });
    let (mut rising, mut falling, mut first) = (0_usize, 0_usize, None);
    for (before, label) in pairs {
        if before.number < label.number {
            rising += 1;
        } else if before.number > label.number {
            falling += 1;
            first.get_or_insert((before, label));
        }
    }
    // Numbers that go up and down all the time are names of places.
    let Some((before, label)) = first.filter(|_| falling * 3 <= rising) else { return };
    let finding = Finding::new(
        &META,
        label.range.clone(),
        format!("sequence number `N{}` after `N{}`", label.number, before.number),
    )
    .label("lower than the one before it")
    .also(before.range.clone(), "the one before it")
    .help("renumber the blocks, or remove numbers that nothing jumps to");
    report.add(if falling > 1 {
        finding.note(format!("{falling} numbers of the file are lower than the one before"))
    } else {
        finding
    });
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_program_begins_anew() {
        check_rule(&RULE, "fanuc-mill", "O1\nN10 G0 X1.\nN20 M30\nO2\nN10 X1.\nN20 M99\n", &expect![[""]]);
    }

    #[test]
    fn names_of_places_need_no_order() {
        check_rule(&RULE, "fanuc-mill", "N100 G0 X1.\nN1 X2.\nN50 X3.\nN2 M30\n", &expect![[""]]);
    }
}
