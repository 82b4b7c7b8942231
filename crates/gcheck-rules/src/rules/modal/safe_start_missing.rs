//! A program without a safe start line.

use gcheck_controls::{CodeNumber, Effect, LetterSet, Machine};
use gcheck_engine::{Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::modes::ignores_distance_mode;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A program moves before it states the modes that an interrupted program may leave on: plane, positions or
    /// increments, cutter compensation, canned cycle, tool length.
    ///
    /// ## Why it matters
    /// After a stop in the middle, the control begins in whatever was on: the first move is offset from its path,
    /// drills a hole, or is in increments. A line such as `G17 G40 G49 G80 G90` at the head makes every start the same.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G0 G90 G54 X0. Y0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 G17 G20 G40 G49 G80 G90
    /// T1 M6
    /// G54 X0. Y0.
    /// M30
    /// ```
    rule "safe-start-missing" in "modal" {
        summary: "program without a safe start line",
        severity: Hint,
        tier: Path,
        recommended: false,
        sets: [RestartSafe],
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::RAPIDS.union(Watch::CUTS),
            make: || Box::new(SafeStartMissing { is_done: false }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct SafeStartMissing {
    is_done: bool,
}

remembers!(SafeStartMissing);

impl PathRule for SafeStartMissing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.first_move(cx, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.first_move(cx, report);
    }
}

/// Modes of a safe start line, each with the code that is safe.
const OF_MILLS: [(Role, Effect); 5] = [
    (Role::Plane, Effect::PlaneXy),
    (Role::Compensation, Effect::CompensationOff),
    (Role::Length, Effect::LengthOff),
    (Role::Cycle, Effect::CycleCancel),
    (Role::Distance, Effect::Absolute),
];
const OF_LATHES: [(Role, Effect); 3] = [
    (Role::Compensation, Effect::CompensationOff),
    (Role::Cycle, Effect::CycleCancel),
    (Role::FeedMode, Effect::FeedPerRevolution),
];

impl SafeStartMissing {
    fn first_move(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if self.is_done {
            cx.enough();
            return;
        }
        if ignores_distance_mode(cx) || !cx.origin().letters.intersects(LetterSet::of("XYZABCUVW")) {
            return;
        }
        self.is_done = true;
        if cx.is_called_only() || cx.is_after_unknown_program() {
            return;
        }
        let modes: &[(Role, Effect)] = match cx.control().machine() {
            Machine::Mill => &OF_MILLS,
            Machine::Lathe => &OF_LATHES,
        };
        let is_stated = |role: Role| cx.definitions().set_by(Fact::Mode(role)).is_some();
        // Increments with their own letters need no mode.
        let has_own_letters = !cx.model.semantics().increments.is_empty();
        let mut missing: Vec<CodeNumber> = Vec::new();
        for (role, effect) in modes {
            let code = cx.control().codes().find(|code| code.effect() == *effect);
            if let Some(code) = code
                && !is_stated(*role)
                && !(*role == Role::Distance && has_own_letters)
            {
                missing.push(code.number());
            }
        }
        if missing.is_empty() {
            return;
        }
        missing.sort();
        let names: Vec<String> = missing.iter().map(ToString::to_string).collect();
        let listed = names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        report.add(
            cx.finding(&META, cx.range(), format!("moves before a safe start is stated ({listed})"))
                .label("begins in the modes that an interrupted program left on")
                .help(format!("begin the program with {listed}"))
                .fix_if(cx.block_before(Some(&names.join(" ")))),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only};

    #[test]
    fn what_is_stated_is_not_asked_for() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G17 G90\nG0 X1\nM2\n",
            &expect![[r#"
                2 | G0 X1
                  | ^^^^^ hint[safe-start-missing] moves before a safe start is stated (`G40`, `G49`, `G80`)
            "#]],
        );
    }

    #[test]
    fn the_fix_states_it() {
        let program = "O1\nG90 G17\nG28 G91 Z0.\nN10 G0 G90 X1.\nM30\n";
        let found = findings(&only(&RULE), "fanuc-mill", program, &World::default());
        expect![[r#"
            O1
            G90 G17
            G28 G91 Z0.
            G40 G49 G80
            N10 G0 G90 X1.
            M30
        "#]]
        .assert_eq(&found.iter().map(|f| fixed(program, f)).collect::<String>());
    }

    #[test]
    fn a_subprogram_starts_as_its_caller_left_it() {
        check_rule(&RULE, "haas-mill", "O10\nG0 X1.\nM99\n", &expect![[""]]);
    }
}
