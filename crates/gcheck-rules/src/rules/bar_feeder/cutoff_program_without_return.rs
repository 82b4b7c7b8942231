//! A cutoff program in another file that does not return to the bar feed.

use gcheck_controls::Effect;

use crate::declare::declare_rule;
use crate::facts::bar_feed::bar_feeder;
use crate::facts::offset_schemes::whole;
use crate::facts::program_calls::ProgramEnds;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The cutoff program that a bar feed calls (`G105 P…`) is in another file and has no return (`M99`): it ends the
    /// job, or its text just ends.
    ///
    /// For a cutoff program in the same file, see `subprogram-without-return`.
    ///
    /// ## Why it matters
    /// The part is cut off and nothing follows: no push, no clamping, no next part.
    ///
    /// ## Reported
    /// With a program 9099 in another file that ends with `M30`:
    /// ```nc,reported,haas-lathe
    /// O1
    /// M5
    /// G105 J1.75 P9099
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// O1
    /// G105 J1.75 P2
    /// M99
    /// O2
    /// G1 X0. F0.004
    /// G0 X3.
    /// M99
    /// ```
    /// ## How to fix it
    /// * End the cutoff program with `M99` in place of `M30` or of nothing.
    rule "cutoff-program-without-return" in "bar_feeder" {
        summary: "cutoff program in another file without a return",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(CutoffProgramWithoutReturn) },
    }
}

struct CutoffProgramWithoutReturn;

impl PathRule for CutoffProgramWithoutReturn {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if bar_feeder(cx).is_none() || !cx.has_effect(|effect| effect == Effect::BarFeed) {
            return;
        }
        let number = cx.known_number('P').and_then(whole);
        let Some(entry) = number.and_then(|number| cx.program.find_number(number, 0)) else { return };
        if entry.file == 0 {
            return;
        }
        let Some(file) = cx.program.file(entry.file) else { return };
        let Some(ends) = ProgramEnds::of(cx, entry).filter(|ends| !ends.returns) else { return };
        report.add(
            cx.finding(&META, cx.letter_range('P'), "cutoff program has no return (`M99`)")
                .label(if ends.the_job { "ends the whole job" } else { "runs to the end of its text" })
                .note(format!("the program is in `{}`", file.name))
                .help("end the cutoff program with `M99`"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::RULE;
    use crate::testing::{Called, World, check_rule_in};

    fn check(cutoff: &'static str, expected: &Expect) {
        let world = World { programs: &Called(2, cutoff), ..World::default() };
        check_rule_in(&RULE, "haas-lathe", "O1\nM5\nG105 J1.75 P2\nM99\n", &world, expected);
    }

    #[test]
    fn its_end_decides() {
        check(
            "O2\nG1 X0. F0.004\nM30\n",
            &expect![[r#"
            3 | G105 J1.75 P2
              |            ^^ warning[cutoff-program-without-return] cutoff program has no return (`M99`)
        "#]],
        );
        check(
            "O2\nG1 X0. F0.004\n",
            &expect![[r#"
            3 | G105 J1.75 P2
              |            ^^ warning[cutoff-program-without-return] cutoff program has no return (`M99`)
        "#]],
        );
        check("O2\nG1 X0. F0.004\nIF [#500 EQ 1] GOTO 9\nM99\nN9 M30\n", &expect![[""]]);
    }
}
