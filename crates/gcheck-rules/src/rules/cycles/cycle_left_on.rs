//! A canned cycle that is still active at a tool change or the end.

use std::collections::BTreeSet;

use gcheck_controls::Effect;
use gcheck_engine::{At, Ending, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::ends_at_tape_mark;
use crate::facts::cycles::{CycleBoundary, cycle_boundary, cycle_ends_with_program, is_cycle};
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A canned cycle is still active at a tool change, at a return to the reference position, or at the end of the program.
    ///
    /// ## Why it matters
    /// Until `G80`, every block with a position drills a hole there. With the next tool that is a crash; some controls
    /// stop with an alarm at the tool change or the reference return.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G90 G54 G0 X0 Y0
    /// G81 Z-1. R.1 F10.
    /// X1.
    /// T2 M6
    /// G0 X0
    /// M30
    /// ```
    /// ```nc,reported,fanuc-mill
    /// G90 G54 G0 X0 Y0
    /// G81 Z-10. R2. F100.
    /// G91 G28 Z0
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G90 G54 G0 X0 Y0
    /// G81 Z-1. R.1 F10.
    /// X1.
    /// G80
    /// T2 M6
    /// G0 X0
    /// M30
    /// ```
    /// The end of the program ends the cycle too.
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0 Y0
    /// G81 Z-1. R.1 F10.
    /// M30
    /// ```
    rule "cycle-left-on" in "cycles" {
        summary: "canned cycle still on at a tool change or the end",
        severity: Warning,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::ENDS),
            make: || Box::new(CycleLeftOn::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleLeftOn {
    /// Blocks whose cycles were reported.
    told: BTreeSet<Option<At>>,
}

remembers!(CycleLeftOn: told);

impl PathRule for CycleLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(end) = cycle_boundary(cx) else { return };
        let Some(ActiveMode::Certain(code)) = left_on(cx, Role::Cycle, is_cycle) else { return };
        self.tell(cx, end, &cx.name_of(code), report);
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending)
            && !cycle_ends_with_program(cx)
            && let Some(ActiveMode::Certain(code)) = left_on(cx, Role::Cycle, is_cycle)
        {
            self.tell(cx, CycleBoundary::ProgramEnd, &cx.name_of(code), report);
        }
    }
}

impl CycleLeftOn {
    fn tell(&mut self, cx: &PathCx<'_>, harm: CycleBoundary, name: &str, report: &mut Report<'_>) {
        let fact = Fact::Mode(Role::Cycle);
        if cx.definitions().set_by(fact).is_none() || !self.told.insert(cx.definitions().set_by(fact)) {
            return;
        }
        let finding = cx
            .finding(&META, harm.range(cx), format!("canned cycle is still on {} (`{name}`)", harm.words()))
            .label("the next block with a position drills a hole")
            .help("end the cycle with `G80` before this")
            .fix_if(cx.block_before(cx.name_of_effect(Effect::CycleCancel).as_deref()))
            .at_most(if harm == CycleBoundary::ProgramEnd { Severity::Info } else { Severity::Warning });
        report.add(cx.resting_on(finding, fact, &format!("`{name}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_word_that_does_harm_is_marked_once() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G54 G0 X0 Y0\nG81 Z-10. R2. F100.\nG91 G28 Z0\nT2 M6\nM30\n",
            &expect![[r#"
                3 | G91 G28 Z0
                  |     ^^^ warning[cycle-left-on] canned cycle is still on at the reference return (`G81`)
            "#]],
        );
    }

    #[test]
    fn a_motion_code_ends_the_cycle() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G54 G0 X0 Y0\nG81 Z-10. R2. F100.\nG0 Z50.\nT2 M6\nG81 X5. Z-10. R2.\nG80 M6\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn at_the_end_it_is_a_hint_for_the_next_program() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G54 G0 X0 Y0\nG81 Z-10. R2. F100.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ info[cycle-left-on] canned cycle is still on at the end of the program (`G81`)
        "#]],
        );
    }

    #[test]
    fn words_say_where_the_cycle_began() {
        let program = "G90 G54 G0 X0 Y0\nG99 G81 Z-10. R2. F100.\nG91 G28 Z0\nM30\n";
        let found = findings(&only(&RULE), "fanuc-mill", program, &World::default());
        expect![[r#"
            canned cycle is still on at the reference return (`G81`)
              here: the next block with a position drills a hole
              there: `G81` set here
              help: end the cycle with `G80` before this
              fix (unsafe): put `G80` in a block before this one
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
