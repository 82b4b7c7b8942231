//! A move under 3D cutter compensation without its direction.

use gcheck_engine::{Event, Role};

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_vectors;
use crate::facts::modes::resting_on_mode;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A move under 3D cutter compensation (`G141`) omits `I`, `J` or `K`, or all of them.
    ///
    /// ## Why it matters
    /// Each point needs a direction: without it the control does not know which way to shift the path there. The manual
    /// does not say that an earlier direction stays in effect, or that a missing component is zero.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.
    /// X2.
    /// G40
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.
    /// X2. I0. J0. K1.
    /// G40
    /// G0 Z2.
    /// M30
    /// ```
    rule "cutter-vector-incomplete" in "five_axis" {
        summary: "move under 3D cutter compensation without its direction",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(CutterVectorIncomplete) },
    }
}

struct CutterVectorIncomplete;

impl PathRule for CutterVectorIncomplete {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::CutterVector(parts) = event else { return };
        if cx.is_malformed() {
            return;
        }
        let mode = cx.state().mode(Role::Compensation).only();
        let Some(code) = mode.filter(|code| is_along_vectors(cx.model.effect(*code))) else { return };
        let missing: Vec<&str> = ["`I`", "`J`", "`K`"]
            .into_iter()
            .zip(parts)
            .filter_map(|(name, part)| part.is_none().then_some(name))
            .collect();
        let name = cx.name_of(code);
        let (message, label) = match missing.as_slice() {
            [] => return,
            [_, _, _] => (
                format!("move without a direction under 3D cutter compensation (`{name}`)"),
                "`I J K` are missing".to_owned(),
            ),
            some => {
                let some = some.join(" and ");
                (
                    format!("direction without {some} under 3D cutter compensation (`{name}`)"),
                    format!("{some} missing"),
                )
            }
        };
        let source = cx.control().code_at(code).map_or("", |code| code.entry().source.as_str());
        let finding = cx
            .finding(&META, cx.range(), message)
            .label(label)
            .note(format!(
                "the control needs `I`, `J` and `K` to shift the path in the right direction  [{source}]"
            ))
            .help(format!(
                "write all three in every block that moves, zeros too, or end `{name}` with `G40` first"
            ));
        report.add(resting_on_mode(cx, finding, Role::Compensation));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn what_is_missing_is_named() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G1 G141 D1 X1. Y0. Z0. F20.\nX2. I0. J0.\nX3. K1.\nX4. I#500 J#501 K#502\nF30.\nG40\nG0 X1.\nM30\n",
            &expect![[r#"
                1 | G90 G1 G141 D1 X1. Y0. Z0. F20.
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[cutter-vector-incomplete] move without a direction under 3D cutter compensation (`G141`)
                2 | X2. I0. J0.
                  | ^^^^^^^^^^^ warning[cutter-vector-incomplete] direction without `K` under 3D cutter compensation (`G141`)
                3 | X3. K1.
                  | ^^^^^^^ warning[cutter-vector-incomplete] direction without `I` and `J` under 3D cutter compensation (`G141`)
            "#]],
        );
    }
}
