//! Blocks of which nobody can say before the run what they do.

use gcheck_engine::Fault;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Remembers, Report, Run, Watch, remembers};

declare_rule! {
    /// What a block does can depend on a value that only the machine has: which program it calls, how often a hole repeats,
    /// where it jumps, which code it is. The check follows what it can: any number of turns of a call, all labels of the
    /// program. What it cannot follow, it passes over, and says so here, at the first such block of a file.
    ///
    /// ## Why it matters
    /// Mistakes in what was passed over are not reported, and after a program that is unknown hardly anything is known of
    /// positions and modes.
    ///
    /// ## What to do
    /// If the value is the same on every run, write it into gcheck.toml: `[variables]` gives values that are there when the
    /// program starts. Else try the program with the values that matter: `gcheck run --set '#501=9001'`.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001 G90 G21
    /// M98 P#501
    /// G0 X1.
    /// M30
    /// ```
    /// ## Not reported
    /// A call whose count of turns is not known is followed for any count.
    /// ```nc,quiet,fanuc-mill
    /// O0001 G90 G21
    /// M98 P2 L#500
    /// M30
    /// O0002
    /// G0 X1.
    /// M99
    /// ```
    rule "block-not-decided" in "flow" {
        summary: "block whose work is known in the run alone",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::<BlockNotDecided>::default() },
    }
}

#[derive(Default, Clone, PartialEq)]
struct BlockNotDecided {
    /// It was reported.
    told: bool,
}

remembers!(BlockNotDecided);

impl PathRule for BlockNotDecided {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    /// The analysis of all paths came by this block too.
    fn counts_on_some_path(&self) -> bool {
        false
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if self.told || !matches!(fault, Fault::Undecidable) {
            return;
        }
        self.told = true;
        let finding = crate::Finding::new(
            &META,
            cx.range(),
            "what this block does depends on a value that is not known",
        )
        .label("a call, a jump, a count or a code is computed from it")
        .note("what it may do is not checked, and less is known of positions and modes after it")
        .help("a value that is the same on every run can be given in `[variables]` of gcheck.toml");
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_block_of_a_file_is_named() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG81 X1. Z-5. R2. F100. L#500\nG80\nM98 P#501\nM30\n",
            &expect![[r#"
                4 | M98 P#501
                  | ^^^^^^^^^ info[block-not-decided] what this block does depends on a value that is not known
            "#]],
        );
    }

    #[test]
    fn a_label_whose_number_is_read_from_a_probe() {
        check_rule(
            &RULE,
            "linuxcnc",
            "#1=#5061\no#1 if [#5062 GT 1]\nG0 X1\no#1 endif\nM2\n",
            &expect![[r#"
                2 | o#1 if [#5062 GT 1]
                  | ^^^^^^^^^^^^^^^^^^^ info[block-not-decided] what this block does depends on a value that is not known
            "#]],
        );
    }

    #[test]
    fn a_count_of_turns_is_any() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nM98 P2 L#500\nG65 P2 L#501\nM30\nO2\nG0 X1.\nM99\n",
            &expect![[""]],
        );
    }
}
