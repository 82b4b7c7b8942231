//! A sequence number that a program has twice.

use std::collections::BTreeSet;

use gcheck_controls::Ends;
use gcheck_program::Label;

use crate::declare::declare_rule;
use crate::facts::sections::{has_jumps, program_around};
use crate::{Edit, FileCx, Finding, Fix, Report, Run};

declare_rule! {
    /// Two blocks of one program have the same sequence number. Reported once per file.
    ///
    /// ## Why it matters
    /// A search for the number, by hand at a restart or by a jump that is added later, finds the wrong block.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// O00001
    /// N10 T1 M6
    /// N10 T2 M6
    /// ```
    /// ## Not reported
    /// Different programs of a file may use the same numbers, and a number that nothing can jump to does not matter.
    /// ```nc,quiet,haas-mill
    /// O00001
    /// N10 M30
    /// O00002
    /// N10 M99
    /// ```
    /// ```nc,quiet,linuxcnc
    /// N10 T1 M6
    /// N10 T2 M6
    /// ```
    rule "duplicate-sequence-number" in "program" {
        summary: "sequence number twice in a program",
        severity: Hint,
        tier: Program,
        fixable: Safely,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if cx.file_index.labels.len() < 2 || !has_jumps(cx) {
        return;
    }
    let mut labels: Vec<(u32, u32, &Label)> =
        cx.file_index.labels.iter().map(|l| (program_around(cx, l.range.start).start, l.number, l)).collect();
    labels.sort_by_key(|(program, number, label)| (*program, *number, label.range.start));
    let same = |pair: &&[(u32, u32, &Label)]| matches!(pair, [a, b] if (a.0, a.1) == (b.0, b.1));
    let count = labels.windows(2).filter(same).count();
    // The second block of the pair that comes first in the text.
    let first =
        labels.windows(2).filter(same).min_by_key(|pair| pair.last().map(|(_, _, label)| label.range.start));
    let Some([(_, _, first), (_, _, second)]) = first else { return };
    // Another rule reports a number that a jump leads to.
    if !cx.file_index.jumps.iter().any(|j| j.target == Some(second.number)) {
        let again = labels.windows(2).filter(same).filter_map(|pair| pair.last()).map(|(_, _, label)| *label);
        report.add(finding(first, second, count).fix_if(without_numbers(cx, again)));
    }
}

fn finding(first: &Label, second: &Label, count: usize) -> Finding {
    let finding = Finding::new(
        &META,
        second.range.clone(),
        format!("sequence number `N{}` exists twice", second.number),
    )
    .label("the same number again")
    .also(first.range.clone(), "first used here")
    .help("renumber the blocks, or remove numbers that nothing jumps to");
    if count > 1 { finding.note(format!("{count} blocks of the file repeat a number")) } else { finding }
}

/// Numbers that one fix removes; more are left to the next run.
const MOST_NUMBERS: usize = 10_000;

/// Removes the repeated numbers: only if every jump is known, and none leads to one of them.
fn without_numbers<'l>(cx: &FileCx<'_>, again: impl Iterator<Item = &'l Label>) -> Option<Fix> {
    let targets: Option<BTreeSet<u32>> = cx.file_index.jumps.iter().map(|jump| jump.target).collect();
    let targets = targets?;
    // Returns and calls from other programs are not known.
    if !cx.file_index.calls.is_empty() || cx.file_index.ends.iter().any(|end| end.ends == Ends::Subprogram) {
        return None;
    }
    let again = again.filter(|label| !targets.contains(&label.number)).take(MOST_NUMBERS);
    let edits: Vec<Edit> = again
        .map(|label| {
            let (base, text) = cx.text.around(label.range.end);
            let rest = text.get((label.range.end - base) as usize..).unwrap_or_default();
            let blanks = rest.len() - rest.trim_start_matches([' ', '\t']).len();
            Edit { range: label.range.start..label.range.end + blanks as u32, text: String::new() }
        })
        .collect();
    (!edits.is_empty()).then(|| Fix { title: "remove the repeated numbers".to_owned(), safe: true, edits })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn only_the_first_pair_of_a_file_is_told() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "O1\nN1 T0101\nN2 T0202\nN2 M1\nN1 M30\n",
            &expect![[r#"
                4 | N2 M1
                  | ^^ hint[duplicate-sequence-number] sequence number `N2` exists twice
            "#]],
        );
    }

    #[test]
    fn a_number_that_is_jumped_to_is_another_rules_matter() {
        check_rule(&RULE, "fanuc-mill", "GOTO 1\nN1\nN1 M30\n", &expect![[""]]);
    }
}
