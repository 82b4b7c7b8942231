//! A work offset with an angle under 5-axis tool length compensation.

use gcheck_controls::Effect;
use gcheck_engine::{Axis, Role};

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_tool;
use crate::facts::modes::resting_on_mode;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// 5-axis tool length compensation (`G143`) is switched on under a work offset whose `A` or `B` is not zero.
    ///
    /// ## Why it matters
    /// The control turns the length by the work positions of `A` and `B`: where both are zero the tool must be parallel
    /// to Z. A work offset with an angle is right only on a head that is upright at that angle; on a head that is
    /// upright at its machine zero, the length points the wrong way.
    ///
    /// Offsets that are not configured are not judged.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G10 L2 P1 A5. B0.
    /// G90 G54
    /// G143 H1 X0. Y0. Z1. A0. B0.
    /// G49
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G10 L2 P1 A0. B0.
    /// G90 G54
    /// G143 H1 X0. Y0. Z1. A0. B0.
    /// G49
    /// M30
    /// ```
    rule "five-axis-zero-not-upright" in "five_axis" {
        summary: "work offset with an angle under 5-axis tool length compensation",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(FiveAxisZeroNotUpright) },
    }
}

struct FiveAxisZeroNotUpright;

impl PathRule for FiveAxisZeroNotUpright {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let codes = cx.codes();
        let Some(code) = codes.iter().copied().find(|code| is_along_tool(cx.model.effect(*code))) else {
            return;
        };
        let state = cx.state();
        // An offset that this block chooses is in effect before the block moves.
        let chosen = codes.iter().find_map(|code| match cx.model.effect(*code) {
            Effect::WorkOffset(number) => Some(number),
            _ => None,
        });
        let offset = match chosen {
            Some(number) => state.tables().offset(number),
            None => state.work_offset(),
        };
        let tilted: Vec<String> = [Axis::A, Axis::B]
            .into_iter()
            .filter_map(|axis| Some((axis, offset.origin.get(axis)?)))
            .filter(|(_, angle)| (angle % 360.0).abs() > 1e-9)
            .map(|(axis, angle)| format!("{} {}°", axis.name(), (angle * 1000.0).round() / 1000.0))
            .collect();
        if tilted.is_empty() {
            return;
        }
        let Some(code) = cx.control().code_at(code) else { return };
        let (name, entry) = (code.number(), code.entry());
        let number = chosen.or(state.work());
        let work = number.map_or_else(
            || "the work offset".to_owned(),
            |number| gcheck_lint::work_offset_name(number, cx.model),
        );
        let finding = cx
            .finding(
                &META,
                cx.effect_range(is_along_tool),
                format!("the zero of `{work}` tilts the tool: {} (`{name}`)", tilted.join(", ")),
            )
            .label("the length is turned by the work positions of `A` and `B`")
            .note(format!(
                "at work position A0 B0 the tool must be parallel to the motion of Z  [{}]",
                entry.source
            ))
            .help(format!("remove the angles from `{work}`, or make sure that the head is upright at them"))
            .assuming("the head is upright at machine position A0 B0");
        report.add(resting_on_mode(cx, finding, Role::WorkOffset));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_engine::WorkOffset;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in};

    const PROGRAM: &str = "G90 G55\nG143 H1 X1. Y1. Z1. A5. B5.\nG49\nM30\n";

    #[test]
    fn an_offset_that_nobody_told_says_nothing() {
        check_rule(&RULE, "haas-mill", PROGRAM, &expect![[""]]);
    }

    #[test]
    fn the_configured_offset_is_looked_at() {
        let mut tilted = WorkOffset::ZERO;
        tilted.origin.set(gcheck_engine::Axis::B, -12.5);
        let mut world = World::default();
        world.machine.engine.offsets = [(1, WorkOffset::ZERO), (2, tilted)].into_iter().collect();
        check_rule_in(
            &RULE,
            "haas-mill",
            PROGRAM,
            &world,
            &expect![[r#"
            2 | G143 H1 X1. Y1. Z1. A5. B5.
              | ^^^^ warning[five-axis-zero-not-upright] the zero of `G55` tilts the tool: B -12.5° (`G143`)
        "#]],
        );
        check_rule_in(&RULE, "haas-mill", &PROGRAM.replace("G55", "G54"), &world, &expect![[""]]);
        check_rule_in(
            &RULE,
            "haas-mill",
            "G90 G55 G143 H1 X1. Y1. Z1. A5. B5.\nM30\n",
            &world,
            &expect![[r#"
            1 | G90 G55 G143 H1 X1. Y1. Z1. A5. B5.
              |         ^^^^ warning[five-axis-zero-not-upright] the zero of `G55` tilts the tool: B -12.5° (`G143`)
        "#]],
        );
    }
}
