//! An axis that few machines have, where nobody said that this one has it.

use std::ops::Range;

use gcheck_controls::{Letter, LetterSet};
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A block names an axis that a machine has only when its configuration says so, and no `[machine] axes` does.
    ///
    /// ## Why it matters
    /// On a machine without this axis the control stops at the block. A run without a machine file stops there too. There is one
    /// finding for each axis of a file, at the first block that names it.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G94 F100
    /// G1 X5 U5
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G94 F100
    /// G1 X5 A5
    /// M2
    /// ```
    rule "axis-not-stated" in "words" {
        summary: "axis that few machines have, and no machine file lists",
        severity: Info,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

/// The words of an axis.
struct Named {
    axis: Letter,
    first: Range<u32>,
    last: u32,
    count: usize,
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let Some(usual) = &cx.control().semantics().refusals.axes else { return };
    if cx.environment.machine.axes.is_some() {
        return;
    }
    let usual: LetterSet = usual.chars().map(Letter::of).collect();
    let rare = cx.control().axes().without(usual);
    if !cx.file_index.letters.intersects(rare) {
        return;
    }
    let mut all: Vec<Named> = Vec::new();
    cx.each_block(|block| {
        let is_asked = block.block().flags.contains(BlockFlags::CODE)
            && block.block().letters.intersects(rare)
            && !block.codes().any(|(_, code)| code.entry().any_words || code.is_user());
        if !is_asked {
            return;
        }
        for word in block.words().iter().filter(|word| rare.contains(word.letter)) {
            let range = block.range(word);
            match all.iter_mut().find(|named| named.axis == word.letter) {
                Some(named) => (named.last, named.count) = (range.start, named.count + 1),
                None => all.push(Named { axis: word.letter, last: range.start, first: range, count: 1 }),
            }
        }
    });
    for Named { axis, first, last, count } in all {
        let [from, to] = cx.line_numbers([first.start, last]);
        let finding = Finding::new(&META, first, format!("few machines have an axis `{axis}`"))
            .label("not stated for this machine")
            .assuming(format!("the machine has an axis `{axis}`"))
            .help("list the axes of the machine: `[machine] axes` in gcheck.toml");
        report.add(if count > 1 {
            finding.note(format!("{count} words name it, in lines {from} to {to}"))
        } else {
            finding
        });
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

    #[test]
    fn a_file_has_one_finding_for_each_axis() {
        let program = format!("G21 G90 G94 F100\n{}M2\n", "G1 X5 U5\nG1 W1\n".repeat(1_700));
        let found = findings(&only(&RULE), "linuxcnc", &program, &World::default());
        let told: Vec<String> =
            found.iter().map(|found| format!("{}: {}", found.message, found.notes.join("; "))).collect();
        assert_eq!(
            told,
            [
                "few machines have an axis `U`: 1700 words name it, in lines 2 to 3400",
                "few machines have an axis `W`: 1700 words name it, in lines 3 to 3401"
            ]
        );
    }

    #[test]
    fn the_first_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G94 F100\nG1 X5 U5\nG2 X10 I5 W3\nG1 X1 A1 B1 C1\nM2\n",
            &expect![[r#"
                2 | G1 X5 U5
                  |       ^^ info[axis-not-stated] few machines have an axis `U`
                3 | G2 X10 I5 W3
                  |           ^^ info[axis-not-stated] few machines have an axis `W`
            "#]],
        );
    }
}
