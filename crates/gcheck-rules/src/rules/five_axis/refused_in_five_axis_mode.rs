//! What cannot be done while the axes are shifted along a tilting tool or along vectors.

use std::collections::BTreeSet;

use gcheck_controls::{Code, CodeIx, CodeNumber, Effect};
use gcheck_engine::{At, Fact, Role};

use crate::boundary::LeftOn;
use crate::five_axis::{is_along_tool, is_along_vectors};
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{Finding, PathCx, PathRule, Report, RuleMeta, Run, Severity, Watch, limit};

declare_rule! {
    /// Under 5-axis tool length compensation (`G143`) or 3D cutter compensation (`G141`) a block asks for what they exclude: an
    /// arc, a canned cycle, a pocket, cutter compensation in a plane.
    ///
    /// ## Why it matters
    /// Both work with straight moves (`G0`, `G1`) only. The control stops with an alarm, with the tool at the part.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G2 X1. Y1. R1. F20.
    /// G49
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.
    /// G81 X1. Y1. Z-.5 R.1 F10.
    /// G80
    /// G40
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G1 X1. Y1. Z0. A5. B5. F20.
    /// G49
    /// G2 X2. Y2. R1.
    /// M30
    /// ```
    rule "refused-in-five-axis-mode" in "five_axis" {
        summary: "refused under 5-axis tool length or 3D cutter compensation",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::ALL_BLOCKS,
            make: || Box::new(RefusedInFiveAxisMode { told: BTreeSet::new() }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct RefusedInFiveAxisMode {
    /// What was reported, by the block that switched the mode on.
    told: BTreeSet<(At, CodeIx)>,
}

remembers!(RefusedInFiveAxisMode: told);

impl PathRule for RefusedInFiveAxisMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !uses_modes(cx) {
            cx.enough();
            return;
        }
        for clash in clashes(cx) {
            let Clash { mode: LeftOn::Surely(mode), code, is_certain: true, .. } = clash else { continue };
            if !self.told.insert((set_by(cx, mode), code)) {
                continue;
            }
            let Some(finding) = finding(cx, &META, &clash, "") else { continue };
            let finding = if clash.is_assumed { finding } else { cx.resting_on_mode(finding, clash.role) };
            report.add(finding);
        }
    }
}

/// A mode of five axes and a code that it excludes, in one block.
pub(super) struct Clash {
    /// The mode's role.
    pub(super) role: Role,
    /// The mode's code.
    pub(super) mode: LeftOn,
    /// What it excludes.
    pub(super) code: CodeIx,
    /// The excluded code holds on every path that comes here.
    pub(super) is_certain: bool,
    /// No page says so: general knowledge.
    is_assumed: bool,
}

/// Does the program use such a mode at all?
pub(super) fn uses_modes(cx: &PathCx<'_>) -> bool {
    cx.file_uses(|effect| is_along_tool(effect) || is_along_vectors(effect))
}

/// The block that switched a mode on.
pub(super) fn set_by(cx: &PathCx<'_>, mode: CodeIx) -> At {
    let here = cx.origin().at;
    if cx.codes().contains(&mode) {
        return here;
    }
    let role = cx.model.role(mode);
    role.and_then(|role| cx.trace().set_by(Fact::Mode(role))).unwrap_or(here)
}

/// What the block brings together that does not go together.
pub(super) fn clashes(cx: &PathCx<'_>) -> Vec<Clash> {
    let mut found = Vec::new();
    for role in [Role::Length, Role::Compensation] {
        let Some(mode) = cx.in_effect(role, |effect| is_along_tool(effect) || is_along_vectors(effect))
        else {
            if role == Role::Compensation {
                found.extend(changed_over(cx));
            }
            continue;
        };
        let (LeftOn::Surely(ix) | LeftOn::Maybe(ix)) = mode;
        let Some(entry) = cx.scene.control().code_at(ix) else { continue };
        let mut add = |code: CodeIx, is_certain: bool| {
            let Some(other) = cx.scene.control().code_at(code) else { return };
            let is_assumed = is_along_tool(entry.effect()) && is_along_vectors(other.effect());
            if is_assumed || forbids(entry, other) {
                found.push(Clash { role, mode, code, is_certain, is_assumed });
            }
        };
        for code in cx.codes().iter().copied() {
            add(code, true);
        }
        if cx.codes().contains(&ix) {
            // Switched on while something else is active that the block does not end.
            for (code, is_certain) in still_active(cx, role) {
                add(code, is_certain);
            }
        }
    }
    found
}

/// Motion, cycle and compensation that stay active in the block.
fn still_active(cx: &PathCx<'_>, of: Role) -> Vec<(CodeIx, bool)> {
    let chosen = |role: Role| cx.code_of_role(role).is_some();
    let mut active = Vec::new();
    for role in [Role::Motion, Role::Cycle, Role::Compensation] {
        // A motion ends a cycle.
        if role == of || chosen(role) || role == Role::Cycle && chosen(Role::Motion) {
            continue;
        }
        let mode = cx.state().mode(role);
        match mode.only() {
            Some(code) => active.push((code, true)),
            None => active.extend(mode.alternatives().iter().map(|code| (*code, false))),
        }
    }
    active
}

/// Compensation in a plane takes the place of that along vectors without an end between.
fn changed_over(cx: &PathCx<'_>) -> Option<Clash> {
    let is_planar = |effect| matches!(effect, Effect::CompensationLeft | Effect::CompensationRight);
    let code = cx.codes().iter().copied().find(|code| is_planar(cx.model.effect(*code)))?;
    let mode = cx.state().mode(Role::Compensation).only()?;
    is_along_vectors(cx.model.effect(mode)).then_some(Clash {
        role: Role::Compensation,
        mode: LeftOn::Surely(mode),
        code,
        is_certain: true,
        is_assumed: true,
    })
}

/// Does the data of a mode exclude a code? What ends a cycle is none.
fn forbids(mode: Code<'_>, other: Code<'_>) -> bool {
    other.effect() != Effect::CycleCancel
        && mode.entry().forbids.iter().any(|item| match item.strip_prefix('@') {
            Some(group) => other.group().id == group,
            None => CodeNumber::parse(item) == Some(other.number()),
        })
        // Increments have a rule of their own.
        && other.effect() != Effect::Incremental
}

/// What both rules say of it; `may` stands before "under".
pub(super) fn finding(cx: &PathCx<'_>, rule: &'static RuleMeta, clash: &Clash, may: &str) -> Option<Finding> {
    let control = cx.scene.control();
    let (LeftOn::Surely(mode) | LeftOn::Maybe(mode)) = clash.mode;
    let (mode, code) = (control.code_at(mode)?, control.code_at(clash.code)?);
    let (name, other) = (mode.number(), code.number());
    let range = cx.find_word(cx.origin().at, |word| word.code == clash.code);
    let is_here = range.is_some();
    let range = range.unwrap_or_else(|| cx.word_range(|word| cx.model.role(word.code) == Some(clash.role)));
    let cancel =
        cx.cancel_of(if clash.role == Role::Length { Effect::LengthOff } else { Effect::CompensationOff })?;
    let finding = cx.finding(rule, range, format!("{} (`{other}`) {may}under `{name}`", kind(code))).label(
        if is_here {
            format!("`{name}` works with straight moves only")
        } else {
            format!("`{other}` is still active")
        },
    );
    let finding = if clash.is_assumed {
        finding
            .note(format!("no page says what becomes of `{other}` together with `{name}`"))
            .at_most(Severity::Warning)
    } else {
        finding
            .note(format!(
                "under `{name}` ({}) only `G0` and `G1` can be used  [{}]",
                mode.entry().title,
                mode.entry().source
            ))
            .at_most(limit(mode.entry().confidence))
    };
    let finding = finding.help(format!("end `{name}` with `{cancel}` before `{other}`"));
    Some(if cx.scene.control_is_guessed { finding.at_most(Severity::Warning) } else { finding })
}

/// What a code is, in a machinist's words.
fn kind(code: Code<'_>) -> &'static str {
    match (Role::of(code.effect()), code.effect()) {
        (_, Effect::ArcClockwise | Effect::ArcCounterClockwise) => "arc",
        (Some(Role::Cycle), _) => "canned cycle",
        (_, Effect::CompensationVector) => "3D cutter compensation",
        (Some(Role::Compensation), _) => "cutter compensation",
        (
            _,
            Effect::CircularPocketClockwise | Effect::CircularPocketCounterClockwise | Effect::GeneralPocket,
        ) => "pocket",
        (_, Effect::BoltArc | Effect::BoltCircle | Effect::BoltLine) => "hole pattern",
        _ => "code",
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::Selection;
    use crate::testing::{World, check_rule, findings, words};

    #[test]
    fn everything_that_a_length_along_the_tool_excludes() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nG2 X1. Y1. R1. F20.\nG03 X2. Y2. R1.\nX3. Y3. R1.\nG81 Z-1. R.1\nX4.\nG80\n\
             G13 I1. D1\nG150 P100 X0. Y0. Z-1. R.1 Q.2 I.2 D1\nG0 G41 D1 X1.\nG40 X0.\nG0 X5. Y5. Z5.\nG2 X1. Y1. R1.\nG49\nG3 X2. R1.\nM30\n\
             O100\nM99\n",
            &expect![[r#"
                2 | G2 X1. Y1. R1. F20.
                  | ^^ error[refused-in-five-axis-mode] arc (`G2`) under `G143`
                3 | G03 X2. Y2. R1.
                  | ^^^ error[refused-in-five-axis-mode] arc (`G3`) under `G143`
                5 | G81 Z-1. R.1
                  | ^^^ error[refused-in-five-axis-mode] canned cycle (`G81`) under `G143`
                8 | G13 I1. D1
                  | ^^^ error[refused-in-five-axis-mode] pocket (`G13`) under `G143`
                9 | G150 P100 X0. Y0. Z-1. R.1 Q.2 I.2 D1
                  | ^^^^ error[refused-in-five-axis-mode] pocket (`G150`) under `G143`
                10 | G0 G41 D1 X1.
                   |    ^^^ error[refused-in-five-axis-mode] cutter compensation (`G41`) under `G143`
            "#]],
        );
    }

    #[test]
    fn switched_on_while_something_is_active() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G2 X1. Y1. R1. F20.\nG143 H1 X1. Y1. Z1. A0. B0.\nG49\nG81 X1. Z-1. R.1\nG143 H1 X1. Y1. Z1. A0. B0.\nG49\n\
             G80 G0 X1.\nG81 X1. Z-1. R.1\nG0 G143 H1 X1. Y1. Z1. A0. B0.\nG49\nM30\n",
            &expect![[r#"
                2 | G143 H1 X1. Y1. Z1. A0. B0.
                  | ^^^^ error[refused-in-five-axis-mode] arc (`G2`) under `G143`
                5 | G143 H1 X1. Y1. Z1. A0. B0.
                  | ^^^^ error[refused-in-five-axis-mode] arc (`G2`) under `G143`
                5 | G143 H1 X1. Y1. Z1. A0. B0.
                  | ^^^^ error[refused-in-five-axis-mode] canned cycle (`G81`) under `G143`
            "#]],
        );
    }

    #[test]
    fn along_vectors() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG2 X1. Y1. R1.\nG83 Z-1. R.1 Q.2\nG80\nG1 X2. I0. J0. K1.\nG42 D1 X3.\nG40 X0.\nM30\n",
            &expect![[r#"
                2 | G2 X1. Y1. R1.
                  | ^^ error[refused-in-five-axis-mode] arc (`G2`) under `G141`
                3 | G83 Z-1. R.1 Q.2
                  | ^^^ error[refused-in-five-axis-mode] canned cycle (`G83`) under `G141`
                6 | G42 D1 X3.
                  | ^^^ warning[refused-in-five-axis-mode] cutter compensation (`G42`) under `G141`
            "#]],
        );
    }

    #[test]
    fn both_together_are_a_warning() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nG49\nM30\n",
            &expect![[r#"
                2 | G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.
                  |    ^^^^ warning[refused-in-five-axis-mode] 3D cutter compensation (`G141`) under `G143`
            "#]],
        );
    }

    #[test]
    fn in_a_subprogram_and_behind_a_block_skip() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nM97 P10\n/G81 Z-1. R.1 F10.\nG80\nG49\nM30\nN10 G3 X1. R1. F10.\nM99\n",
            &expect![[r#"
                3 | /G81 Z-1. R.1 F10.
                  |  ^^^ error[refused-in-five-axis-mode] canned cycle (`G81`) under `G143`
                7 | N10 G3 X1. R1. F10.
                  |     ^^ error[refused-in-five-axis-mode] arc (`G3`) under `G143`
            "#]],
        );
    }

    #[test]
    fn what_it_says() {
        let program = "G90 G143 H1 X0. Y0. Z1. A0. B0.\nG2 X1. Y1. R1. F20.\nM30\n";
        let found = findings(&Selection::only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            arc (`G2`) under `G143`
              here: `G143` works with straight moves only
              there: `G143` set here
              note: under `G143` (5-axis tool length compensation) only `G0` and `G1` can be used  [Haas 96-8000 rev AC May 2010 p.184; Haas online manual, g143-5-axis-tool-length-compensation; gcodes.net, G143; HM17 p.313]
              help: end `G143` with `G49` before `G2`
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
