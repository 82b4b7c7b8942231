//! A code that a mode which is on refuses.

use gcheck_controls::{Code, CodeIx, Effect};
use gcheck_engine::{At, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::compensation::{is_ended_by_number, limits_reading_ahead};
use crate::facts::five_axis::{is_along_tool, is_along_vectors};
use crate::facts::modes::forbids;
use crate::{Finding, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, limit, remembers};

declare_rule! {
    /// A code is in a block while a mode is on that does not allow it: a rapid move under polar coordinate interpolation, a round
    /// pocket under cutter compensation.
    ///
    /// Under polar coordinate interpolation these are also planes and drilling cycles. What is refused under five-axis modes, by probing, by
    /// a plane, and by limits of reading ahead has rules of its own; so has a plane under cutter compensation.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block, with the tool at the part.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G40 G98 T0101
    /// G97 S1000 M3
    /// G0 X60. Z-5. C0.
    /// G12.1
    /// G1 X40. C10. F100.
    /// G0 X60.
    /// G13.1
    /// G0 Z50.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0. S900 M3
    /// G43 H1 Z0.1
    /// G41 D1 G1 X0.5 F20.
    /// X1.
    /// G13 I0.3 Z-0.4 D1 F15.
    /// G40 X0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G40 G98 T0101
    /// G97 S1000 M3
    /// G0 X60. Z-5. C0.
    /// G12.1
    /// G1 X40. C10. F100.
    /// G13.1
    /// G0 X60.
    /// M30
    /// ```
    rule "refused-by-mode" in "modal" {
        summary: "code that is refused while a mode is on",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::RAPIDS),
            make: || Box::new(RefusedByMode::default()),
        },
    }
}

#[derive(Clone, Default, PartialEq)]
struct RefusedByMode {
    /// The block that was reported last.
    told: Option<At>,
    /// The lasting code of motion that was reported for blocks without a code.
    moved_by: Option<CodeIx>,
}

remembers!(RefusedByMode: told);

/// Modes that refuse codes.
const ROLES: [Role; 2] = [Role::PolarInterpolation, Role::Compensation];

impl PathRule for RefusedByMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| Role::of(effect).is_some_and(|role| ROLES.contains(&role)))
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.judge(cx, report);
    }

    /// Blocks that only move are not shown as blocks. They may move by a code of an earlier block.
    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        if !cx.codes().is_empty() {
            self.judge(cx, report);
            return;
        }
        let Some(lasting) = cx.state().mode(Role::Motion).only() else { return };
        if self.moved_by != Some(lasting) {
            self.judge_codes(cx, &[lasting], report);
            self.moved_by = Some(lasting).filter(|_| self.told == Some(cx.origin().at));
            cx.rest();
        }
    }
}

impl RefusedByMode {
    fn judge(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let here = cx.origin().at;
        if self.told == Some(here) {
            return;
        }
        self.moved_by = self.moved_by.filter(|_| cx.codes().is_empty());
        self.judge_codes(cx, &cx.codes(), report);
    }

    fn judge_codes(&mut self, cx: &PathCx<'_>, codes: &[CodeIx], report: &mut Report<'_>) {
        for role in ROLES {
            // Another mode of the block takes its place.
            if cx.code_of_role(role).is_some() {
                continue;
            }
            let Some(mode) = cx.state().mode(role).only() else { continue };
            if role == Role::Compensation && is_ended_by_number(cx, mode) {
                continue;
            }
            for finding in codes.iter().filter_map(|code| refusal(cx, role, mode, *code)) {
                self.told = Some(cx.origin().at);
                report.add(finding);
            }
        }
    }
}

/// The finding for a code under a mode that refuses it.
fn refusal(cx: &PathCx<'_>, role: Role, mode: CodeIx, refused: CodeIx) -> Option<Finding> {
    let (of_mode, code) = (cx.control().code_at(mode)?, cx.control().code_at(refused)?);
    let says_so = if forbids(of_mode, code) {
        of_mode.entry()
    } else if role == Role::Compensation && (forbids(code, of_mode) || begins_without(code, of_mode)) {
        code.entry()
    } else {
        return None;
    };
    if has_own_rule(cx, role, of_mode.effect(), refused) {
        return None;
    }
    let (name, other) = (of_mode.number(), code.number());
    let range =
        if cx.codes().contains(&refused) { cx.word_range(|word| word.code == refused) } else { cx.range() };
    let mut finding = cx
        .finding(&META, range, format!("`{other}` is refused while `{name}` is on"))
        .label(format!("{}, under {}", code.entry().title, of_mode.entry().title))
        .note(format!("the control stops with an alarm  [{}]", says_so.source))
        .at_most(limit(says_so.forbids_confidence.unwrap_or(says_so.confidence)));
    if let Some(end) = of_mode.entry().cancelled_by.iter().find(|item| !item.starts_with('@')) {
        finding = finding.help(format!("end `{name}` before it (`{end}`)"));
    }
    Some(cx.resting_on(finding, Fact::Mode(role), &format!("`{name}`")))
}

/// Is it a mode of its own that requires another code of the mode's group: `G12.1` after `G40`?
fn begins_without(code: Code<'_>, mode: Code<'_>) -> bool {
    let is_own = Role::of(code.effect()).is_some_and(|role| ROLES.contains(&role))
        && code.group_ix() != mode.group_ix();
    let needs = |item: &String| mode.entry().cancelled_by.contains(item) && *item != code.entry().code;
    is_own && code.entry().requires.iter().any(needs)
}

fn has_own_rule(cx: &PathCx<'_>, role: Role, mode: Effect, refused: CodeIx) -> bool {
    let effect = cx.model.effect(refused);
    is_along_tool(mode)
        || is_along_vectors(mode)
        || effect.is_probing_move()
        || effect == Effect::ProbeLength
        || role == Role::Compensation && Role::of(effect) == Some(Role::Plane)
        || effect == Effect::CycleCancel
        || limits_reading_ahead(cx, refused)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    fn on_the_face(block: &str) -> String {
        format!(
            "G21 G40 G98 T0101\nG97 S1000 M3\nG0 X60. Z-5. C0.\nG12.1\nG1 X40. C10. F100.\n{block}\nG13.1\nG0 Z50.\nM30\n"
        )
    }

    #[test]
    fn codes_under_polar_coordinate_interpolation() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &on_the_face("G28 U0."),
            &expect![[r#"
            6 | G28 U0.
              | ^^^ error[refused-by-mode] `G28` is refused while `G12.1` is on
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &on_the_face("G1 C20."), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &on_the_face("G83 Z-10. R2. F100."),
            &expect![[r#"
            6 | G83 Z-10. R2. F100.
              | ^^^ error[refused-by-mode] `G83` is refused while `G12.1` is on
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            &on_the_face("G19"),
            &expect![[r#"
            6 | G19
              | ^^^ error[refused-by-mode] `G19` is refused while `G12.1` is on
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G98 T0101\nG97 S1000 M3\nG0 X60. Z-5. C0.\nG42 G1 X50. F100.\nG12.1\nG13.1\nG40 G1 X60.\nM30\n",
            &expect![[r#"
                5 | G12.1
                  | ^^^^^ error[refused-by-mode] `G12.1` is refused while `G42` is on
            "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &on_the_face("G13.1 G0 X60."), &expect![[""]]);
    }

    #[test]
    fn a_rapid_move_by_an_earlier_code_is_marked_once() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G40 G98 T0101\nG97 S1000 M3\nG0 X60. Z-5. C0.\nG12.1\nX40. C10.\nX38.\nG13.1\nG0 Z50.\nM30\n",
            &expect![[r#"
                5 | X40. C10.
                  | ^^^^^^^^^ error[refused-by-mode] `G0` is refused while `G12.1` is on
            "#]],
        );
    }

    #[test]
    fn a_round_pocket_under_compensation() {
        let program = |end: &str| {
            format!(
                "G20 G90 G54 G0 X0. Y0. S900 M3\nG43 H1 Z0.1\nG41 D1 G1 X0.5 F20.\nX1.\n{end}G13 I0.3 Z-0.4 D1 F15.\nG40 X0.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program(""),
            &expect![[r#"
            5 | G13 I0.3 Z-0.4 D1 F15.
              | ^^^ warning[refused-by-mode] `G13` is refused while `G41` is on
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program("G40 X0.\n"), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("D0\n"), &expect![[""]]);
    }

    #[test]
    fn a_move_stretched_by_an_offset() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G54 G0 X0. Y0. S900 M3\nG41 D1 G1 X10. F200.\nY10.\nG45 X20. D2\nG40 X0.\nM30\n",
            &expect![[r#"
                4 | G45 X20. D2
                  | ^^^ error[refused-by-mode] `G45` is refused while `G41` is on
            "#]],
        );
    }

    #[test]
    fn what_is_said() {
        let found = findings(&only(&RULE), "fanuc-lathe", &on_the_face("G0 X60."), &World::default());
        expect![[r#"
            `G0` is refused while `G12.1` is on
              here: rapid positioning, under polar coordinate interpolation
              there: `G12.1` set here
              note: the control stops with an alarm  [T-FORMATS; 30I-T-LIST; PS-LIST 0146]
              help: end `G12.1` before it (`G13.1`)
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
