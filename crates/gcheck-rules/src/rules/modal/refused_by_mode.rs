//! A code that a mode which is on refuses.

use gcheck_controls::{CodeIx, Effect};
use gcheck_engine::{Fact, Role};

use crate::declare::declare_rule;
use crate::facts::five_axis::{is_along_tool, is_along_vectors};
use crate::facts::modes::forbids;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch, limit};

declare_rule! {
    /// A code is in a block while a mode is on that does not allow it: a check of the reference position in a canned cycle, a rapid
    /// move under polar coordinate interpolation, a round pocket under cutter compensation.
    ///
    /// What is refused under five-axis modes, by probing, in a plane and by limits of reading ahead has rules of its own, and
    /// `cycle-left-on` reports reference returns in a cycle.
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
    /// ```nc,reported,fanuc-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0. S900 M3
    /// G43 H1 Z50.
    /// G81 Z-5. R2. F100.
    /// G27 Z0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0. S900 M3
    /// G43 H1 Z50.
    /// G81 Z-5. R2. F100.
    /// G80
    /// G27 Z0.
    /// M30
    /// ```
    rule "refused-by-mode" in "modal" {
        summary: "code that is refused while a mode is on",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(RefusedByMode) },
    }
}

struct RefusedByMode;

/// Modes that refuse codes.
const ROLES: [Role; 3] = [Role::Cycle, Role::PolarInterpolation, Role::Compensation];

impl PathRule for RefusedByMode {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| Role::of(effect).is_some_and(|role| ROLES.contains(&role)))
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        for role in ROLES {
            // Another mode of the block takes its place; a motion ends a cycle.
            if cx.code_of_role(role).is_some()
                || role == Role::Cycle && cx.code_of_role(Role::Motion).is_some()
            {
                continue;
            }
            let Some(mode) = cx.state().mode(role).only() else { continue };
            for code in cx.codes().iter().copied() {
                judge(cx, role, mode, code, report);
            }
        }
    }
}

fn judge(cx: &PathCx<'_>, role: Role, mode: CodeIx, refused: CodeIx, report: &mut Report<'_>) {
    let (Some(of_mode), Some(code)) = (cx.control().code_at(mode), cx.control().code_at(refused)) else {
        return;
    };
    let says_so = if forbids(of_mode, code) {
        of_mode.entry()
    } else if role == Role::Compensation && forbids(code, of_mode) {
        code.entry()
    } else {
        return;
    };
    if has_own_rule(cx, role, of_mode.effect(), refused) {
        return;
    }
    let (name, other) = (of_mode.number(), code.number());
    let range = cx.word_range(|word| word.code == refused);
    let mut finding = cx
        .finding(&META, range, format!("`{other}` is refused while `{name}` is on"))
        .label(format!("{}, under {}", code.entry().title, of_mode.entry().title))
        .note(format!("the control stops with an alarm  [{}]", says_so.source))
        .at_most(limit(says_so.confidence));
    if let Some(end) = of_mode.entry().cancelled_by.iter().find(|item| !item.starts_with('@')) {
        finding = finding.help(format!("end `{name}` before it (`{end}`)"));
    }
    report.add(cx.resting_on(finding, Fact::Mode(role), &format!("`{name}`")));
}

fn has_own_rule(cx: &PathCx<'_>, role: Role, mode: Effect, refused: CodeIx) -> bool {
    let effect = cx.model.effect(refused);
    let limits_reading = cx
        .model
        .semantics()
        .compensation
        .refuses
        .as_ref()
        .is_some_and(|refusals| refusals.read_ahead_limits.contains(&cx.name_of(refused)));
    is_along_tool(mode)
        || is_along_vectors(mode)
        || effect.is_probing_move()
        || effect == Effect::ProbeLength
        || role == Role::Cycle && matches!(effect, Effect::ReturnReference(_))
        || Role::of(effect) == Some(Role::Plane)
        || limits_reading
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
        check_rule(&RULE, "fanuc-lathe", &on_the_face("G28 U0."), &expect![[r#""#]]);
        check_rule(&RULE, "fanuc-lathe", &on_the_face("G1 C20."), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &on_the_face("G13.1 G0 X60."), &expect![[""]]);
    }

    #[test]
    fn a_check_of_the_reference_position_in_a_cycle() {
        let program = |end: &str| format!("G90 G54 G0 X0. Y0.\nG81 Z-5. R2. F100.\n{end}\nM30\n");
        check_rule(&RULE, "fanuc-mill", &program("G27 Z10."), &expect![[""]]);
        // Of a return another rule tells.
        for end in ["G80\nG27 Z10.", "G80 G27 Z10.", "G0 Z50.\nG27 Z10.", "G28 Z10."] {
            check_rule(&RULE, "fanuc-mill", &program(end), &expect![[""]]);
        }
    }

    #[test]
    fn a_round_pocket_under_compensation() {
        let program = |end: &str| {
            format!(
                "G20 G90 G54 G0 X0. Y0. S900 M3\nG43 H1 Z0.1\nG41 D1 G1 X0.5 F20.\nX1.\n{end}G13 I0.3 Z-0.4 D1 F15.\nG40 X0.\nM30\n"
            )
        };
        check_rule(&RULE, "haas-mill", &program(""), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("G40 X0.\n"), &expect![[""]]);
    }

    #[test]
    fn a_move_stretched_by_an_offset() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G54 G0 X0. Y0. S900 M3\nG41 D1 G1 X10. F200.\nY10.\nG45 X20. D2\nG40 X0.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_is_said() {
        let found = findings(&only(&RULE), "fanuc-lathe", &on_the_face("G0 X60."), &World::default());
        expect![[""]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
