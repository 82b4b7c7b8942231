//! A canned cycle that is still on where it does harm.

use std::collections::BTreeSet;

use gcheck_controls::Effect;
use gcheck_engine::{At, Ending, Fact, Role};

use super::cycle_words_lost::is_cycle;
use crate::boundary::{Boundary, LeftOn};
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// A canned cycle is still active at a tool change, at a return to the reference position, or at the end of the program.
    ///
    /// ## Why it matters
    /// Every block with a position drills a hole there until `G80`. With the next tool that is a crash; some controls stop
    /// with an alarm at the tool change or the reference return.
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
        mends: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::ENDS),
            make: || Box::new(CycleLeftOn::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleLeftOn {
    /// Blocks whose cycles were told of.
    told: BTreeSet<Option<At>>,
}

remembers!(CycleLeftOn: told);

impl PathRule for CycleLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(end) = place(cx) else { return };
        let Some(LeftOn::Surely(code)) = cx.left_on(Role::Cycle, is_cycle) else { return };
        self.tell(cx, end, &cx.name_of(code), report);
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if cx.ends_at_tape_mark(ending)
            && !end_of_cycle_at_end(cx)
            && let Some(LeftOn::Surely(code)) = cx.left_on(Role::Cycle, is_cycle)
        {
            self.tell(cx, Harm::End, &cx.name_of(code), report);
        }
    }
}

impl CycleLeftOn {
    fn tell(&mut self, cx: &PathCx<'_>, harm: Harm, name: &str, report: &mut Report<'_>) {
        let fact = Fact::Mode(Role::Cycle);
        if cx.trace().set_by(fact).is_none() || !self.told.insert(cx.trace().set_by(fact)) {
            return;
        }
        let finding = cx
            .finding(&META, harm.range(cx), format!("canned cycle is still on {} (`{name}`)", harm.words()))
            .label("the next block with a position drills a hole")
            .help("end the cycle with `G80` before")
            .fix_if(cx.block_before(cx.cancel_of(Effect::CycleCancel).as_deref()))
            .at_most(if harm == Harm::End { Severity::Info } else { Severity::Warning });
        report.add(cx.resting_on(finding, fact, &format!("`{name}`")));
    }
}

/// Where a cycle left on does harm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Harm {
    /// The tool is changed.
    ToolChange,
    /// The axes return to the reference position.
    Return,
    /// The program ends.
    End,
}

impl Harm {
    /// As findings name it.
    pub(crate) const fn words(self) -> &'static str {
        match self {
            Self::ToolChange => Boundary::ToolChange.words(),
            Self::Return => "at the reference return",
            Self::End => Boundary::ProgramEnd.words(),
        }
    }

    /// The word that does it.
    pub(crate) fn range(self, cx: &PathCx<'_>) -> std::ops::Range<u32> {
        match self {
            Self::ToolChange => cx.boundary_range(Boundary::ToolChange),
            Self::Return => cx.effect_range(|effect| matches!(effect, Effect::ReturnReference(_))),
            Self::End => cx.boundary_range(Boundary::ProgramEnd),
        }
    }
}

/// Does this block do harm to a cycle that is left on, and not end it itself?
pub(crate) fn place(cx: &PathCx<'_>) -> Option<Harm> {
    let moves =
        |effect| Role::of(effect) == Some(Role::Motion) && cx.model.semantics().cycles.motion_ends_cycle;
    if cx.has_effect(moves) {
        return None;
    }
    match cx.boundary() {
        Some(Boundary::ToolChange) => Some(Harm::ToolChange),
        Some(Boundary::ProgramEnd) => (!end_of_cycle_at_end(cx)).then_some(Harm::End),
        None => cx.has_effect(|effect| matches!(effect, Effect::ReturnReference(_))).then_some(Harm::Return),
    }
}

/// Does the end of the program end cycles, by a code of theirs or of motion?
fn end_of_cycle_at_end(cx: &PathCx<'_>) -> bool {
    cx.end_resets(Role::Cycle) || cx.model.semantics().cycles.motion_ends_cycle && cx.end_resets(Role::Motion)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::Selection;
    use crate::testing::{World, check_rule, findings, words};

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
        let found = findings(&Selection::only(&RULE), "fanuc-mill", program, &World::default());
        expect![[r#"
            canned cycle is still on at the reference return (`G81`)
              here: the next block with a position drills a hole
              there: `G81` set here
              help: end the cycle with `G80` before
              fix (unsafe): put `G80` in a block before this one
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
