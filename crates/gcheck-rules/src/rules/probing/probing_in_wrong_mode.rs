//! A probing code in a mode that it does not work in.

use gcheck_controls::{Code, CodeIx, CodeNumber, Effect};
use gcheck_engine::{Abstract, Domain, Fact, Role};

use crate::meta::declare_rule;
use crate::probing::ModeInBlock;
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Watch, limit};

declare_rule! {
    /// A probing or measuring code runs in a mode that it must not run in: cutter compensation on, tool length compensation on
    /// where a work offset is measured (`G36`, `G136`), or off where a tool length is (`G37`).
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or writes a table with the tool's length or radius in it, by which the next tool
    /// misses.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G43 H1 Z1.
    /// G91 G36 Y-1. F10.
    /// G90
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0.
    /// G49
    /// G37 H1 Z0. F10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G43 H1 Z1.
    /// G49
    /// G91 G36 Y-1. F10.
    /// G90
    /// M30
    /// ```
    rule "probing-in-wrong-mode" in "probing" {
        summary: "probing code in a mode it does not work in",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(ProbingInWrongMode) },
    }
}

struct ProbingInWrongMode;

impl PathRule for ProbingInWrongMode {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        for Demand { role, code, most, is_wrong } in demands(cx) {
            let (mode, is_written) = match cx.mode_in_block(role) {
                ModeInBlock::Written(mode) => (mode, true),
                ModeInBlock::Before(mode) => (mode, false),
                ModeInBlock::Several(_) => continue,
            };
            let is_callers =
                !is_written && cx.is_called_only() && cx.trace().set_by(Fact::Mode(role)).is_none();
            if is_callers || !is_wrong(mode) {
                continue;
            }
            let mode = cx.name_of(mode);
            let finding = worded(cx.finding(&META, cx.range(), String::new()), role, code, &mode, cx);
            let finding = finding.at_most(most);
            report.add(if is_written {
                finding
            } else {
                cx.resting_on(finding, Fact::Mode(role), &format!("`{mode}`"))
            });
        }
    }
}

/// What the probing code of a block asks of a mode.
pub(super) struct Demand<'a> {
    pub(super) role: Role,
    pub(super) code: Code<'a>,
    /// How grave it is at most: what the data only recommends is no error.
    pub(super) most: Severity,
    /// Is this code the wrong one to have in effect?
    pub(super) is_wrong: Box<dyn Fn(CodeIx) -> bool + 'a>,
}

/// The modes that the probing code of the block requires and forbids, as the control's data states them.
pub(super) fn demands<'a>(cx: &'a PathCx<'a>) -> Vec<Demand<'a>> {
    let Some(code) = cx.probing_code().and_then(|ix| cx.code_of(ix)) else { return Vec::new() };
    let of_name = |name: &str| {
        let ix = cx.scene.control().code_ix(CodeNumber::parse(name)?);
        Some((ix, cx.model.role(ix)?))
    };
    let entry = code.entry();
    let demand = |name: &str, most: Severity| {
        let (wanted, role) = of_name(name)?;
        let wanted = cx.model.effect(wanted);
        let is_wrong = move |mode: CodeIx| {
            let effect = cx.model.effect(mode);
            let is_off = role == Role::Length && has_no_length(cx);
            mode.is_some() && effect != wanted && effect != Effect::None && !is_off
        };
        Some(Demand { role, code, most, is_wrong: Box::new(is_wrong) })
    };
    let required = entry.requires.iter().filter_map(|name| demand(name, Severity::Error));
    let recommended = entry.recommends.iter().filter_map(|name| demand(name, Severity::Warning));
    let recommended = recommended.filter(|demand| matches!(demand.role, Role::Compensation | Role::Length));
    let forbidden = entry.forbids.iter().filter_map(|name| of_name(name)).map(|(unwanted, role)| Demand {
        role,
        code,
        most: Severity::Error,
        is_wrong: Box::new(move |mode: CodeIx| mode == unwanted),
    });
    required.chain(recommended).chain(forbidden).collect()
}

/// `G43 H0` is no length.
fn has_no_length(cx: &PathCx<'_>) -> bool {
    !cx.origin().letters.contains(gcheck_controls::Letter::of('H'))
        && Abstract::known(cx.state().h()).is_some_and(|h| h.abs() < 0.5)
}

/// The words of a finding about a mode.
pub(super) fn worded(
    mut finding: Finding,
    role: Role,
    code: Code<'_>,
    mode: &str,
    cx: &PathCx<'_>,
) -> Finding {
    let (name, entry) = (code.number().to_string(), code.entry());
    let range = cx.word_range(|word| cx.code_of(word.code).is_some_and(|of| of.number() == code.number()));
    let (what, label, help) = match (role, code.effect()) {
        (Role::Compensation, _) => (
            "probing with cutter compensation on",
            "the path of a probe cannot be offset",
            "switch compensation off (`G40`) with a move away from the part before it",
        ),
        (Role::Length, Effect::ProbeLength) => (
            "tool length measured with no length in effect",
            "measures the length in effect, and none is",
            "switch the length on before it: `G43 H…` with the offset that is measured",
        ),
        (Role::Length, _) => (
            "work offset measured with a tool length on",
            "the tool's length would go into the work offset",
            "switch the length off (`G49`) before it",
        ),
        _ => {
            ("probing in a mode it does not work in", "refused in this mode", "switch the mode off before it")
        }
    };
    finding.range = range;
    finding.message = format!("{what} (`{mode}`)");
    finding
        .label(label)
        .note(format!("`{name}` ({}) must not run in this mode  [{}]", entry.title, entry.source))
        .help(help)
        .at_most(limit(entry.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn cutter_compensation() {
        check_rule(
            &RULE,
            "haas-mill",
            "G41 D1 G1 X1. F10.\nG91 G31 Y-1. F10.\nG40 X1.\nG90\nM30\n",
            &expect![[r#"
                2 | G91 G31 Y-1. F10.
                  |     ^^^ error[probing-in-wrong-mode] probing with cutter compensation on (`G41`)
            "#]],
        );
    }

    #[test]
    fn modes_of_the_block_itself_act_before_its_move() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G43 H1 Z1.\nG91 G49 G36 Y-1. F10.\nG43 G136 Y1. F10. H1\nG90\nM30\n",
            &expect![[r#"
                3 | G43 G136 Y1. F10. H1
                  |     ^^^^ error[probing-in-wrong-mode] work offset measured with a tool length on (`G43`)
            "#]],
        );
    }

    #[test]
    fn a_length_of_nothing_is_off() {
        check_rule(&RULE, "haas-mill", "G90 G43 H0 Z1.\nG91 G36 Y-1. F10.\nG90\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_mode_as_at_power_on_is_a_warning() {
        check_rule(
            &RULE,
            "haas-mill",
            "G37 H1 Z0. F10.\nM30\n",
            &expect![[r#"
                1 | G37 H1 Z0. F10.
                  | ^^^ warning[probing-in-wrong-mode] tool length measured with no length in effect (`G49`)
            "#]],
        );
    }

    #[test]
    fn a_caller_may_have_set_the_mode() {
        check_rule(&RULE, "haas-mill", "O9100\nG37 H1 Z0. F10.\nM99\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "G65 P9100\nG37 H1 Z0. F10.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn what_the_data_recommends_is_a_warning() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G41 D1 G1 X10. F100.\nG31 Y-1. F10.\nG40 X20.\nM30\n",
            &expect![[r#"
                2 | G31 Y-1. F10.
                  | ^^^ warning[probing-in-wrong-mode] probing with cutter compensation on (`G41`)
            "#]],
        );
    }

    #[test]
    fn a_lathe_has_nose_compensation() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G18 T101\nG42 G1 X1. F.01\nG31 Z-1. F5.\nG40 X2.\nM30\n",
            &expect![[r#"
                3 | G31 Z-1. F5.
                  | ^^^ error[probing-in-wrong-mode] probing with cutter compensation on (`G42`)
            "#]],
        );
    }
}
