//! A pocket that is cut without cutter compensation.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Abstract, Domain as _, Role};

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_code;
use crate::{Finding, PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A pocket is cut along an outline while cutter compensation is off, or on with offset zero.
    ///
    /// ## Why it matters
    /// The tool's centre follows the outline: on every side, the pocket comes out larger than drawn by the tool's
    /// radius. That is right only if the outline was drawn for the centre of one tool.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G43 H1 Z.1
    /// G150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G43 H1 Z.1
    /// G150 P100 G41 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
    /// G40 X0. Y0.
    /// M30
    /// ```
    rule "pocket-without-compensation" in "cycles" {
        summary: "pocket cut without cutter compensation",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(PocketWithoutCompensation) },
    }
}

struct PocketWithoutCompensation;

impl PathRule for PocketWithoutCompensation {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(|effect| effect == Effect::GeneralPocket) {
            return;
        }
        if let Some(finding) = with_offset_zero(cx) {
            report.add(finding);
            return;
        }
        if cx.has_effect(|effect| Role::of(effect) == Some(Role::Compensation))
            || cx.state().effect(Role::Compensation, cx.model) != Some(Effect::CompensationOff)
        {
            return;
        }
        let Some(code) = cycle_code(cx) else { return };
        let name = code.number();
        let on = |effect: Effect| cx.name_of_effect(effect).unwrap_or_default();
        let (left, right) = (on(Effect::CompensationLeft), on(Effect::CompensationRight));
        let mut finding = cx
            .finding(
                &META,
                cx.effect_range(|effect| effect == Effect::GeneralPocket),
                format!("the pocket is cut without cutter compensation (`{name}`)"),
            )
            .label("the tool's centre follows the outline")
            .help(format!(
                "give `{left}` or `{right}` with `D` in this block, unless the outline was drawn for the tool's centre"
            ));
        if cx.letter_range('D') != cx.range() && Abstract::known(cx.state().d()) != Some(0.0) {
            finding = finding.note(format!("`D` alone does not switch it on: `{left}` or `{right}` does"));
        }
        report.add(finding);
    }
}

/// Compensation is on, and the offset in effect is zero, which has no size.
fn with_offset_zero(cx: &PathCx<'_>) -> Option<Finding> {
    let is_on = cx.has_effect(Effect::offsets_path_by_number)
        || cx.state().effect(Role::Compensation, cx.model).is_some_and(Effect::offsets_path_by_number);
    let is_off = cx.has_effect(|effect| effect == Effect::CompensationOff);
    let written = cx.word('D').is_some();
    let d = if written { cx.known_number('D') } else { Abstract::known(cx.state().d()) };
    let is_told = cx.file_index.never_given.iter().any(|missing| missing.letter == Letter::of('D'));
    if !is_on || is_off || d != Some(0.0) || !written && is_told {
        return None;
    }
    let name = cycle_code(cx)?.number();
    let range = if written {
        cx.letter_range('D')
    } else {
        cx.effect_range(|effect| effect == Effect::GeneralPocket)
    };
    Some(
        cx.finding(&META, range, format!("the pocket is cut with offset zero (`{name} D0`)"))
            .label("offset zero has no size: the tool's centre follows the outline")
            .help("give the number of the tool's offset, unless the outline was drawn for the tool's centre"),
    )
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn compensation_from_before_counts() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0.\nG42 D1 X.1\nG150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.\nG40 X0.\nG150 P100 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.\nM30\n",
            &expect![[r#"
                5 | G150 P100 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
                  | ^^^^ info[pocket-without-compensation] the pocket is cut without cutter compensation (`G150`)
            "#]],
        );
    }

    #[test]
    fn offset_zero_has_no_size() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0.\nG150 P100 G41 D0 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.\nG40 X0.\n#1=0\nG150 P100 G41 D#1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.\nG40 X0.\nM30\n",
            &expect![[r#"
                2 | G150 P100 G41 D0 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
                  |               ^^ info[pocket-without-compensation] the pocket is cut with offset zero (`G150 D0`)
                5 | G150 P100 G41 D#1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
                  |               ^^^ info[pocket-without-compensation] the pocket is cut with offset zero (`G150 D0`)
            "#]],
        );
    }

    #[test]
    fn what_some_path_switched_on_is_left_alone() {
        check_rule(
            &RULE,
            "haas-mill",
            "IF [#100 EQ 1] GOTO 5\nG41 D1 X1.\nN5 G150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.\nG40 X0.\nM30\n",
            &expect![[""]],
        );
    }
}
