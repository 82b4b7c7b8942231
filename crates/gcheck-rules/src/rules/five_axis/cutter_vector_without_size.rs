//! 3D cutter compensation without a cutter offset.

use gcheck_controls::Letter;
use gcheck_engine::{Abstract, Domain};

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_vectors;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch, limit};

declare_rule! {
    /// 3D cutter compensation (`G141`) is switched on without a cutter offset: there is no `D` in its block and no
    /// earlier `D` is in effect, or it is `D0`.
    ///
    /// ## Why it matters
    /// `D` selects the offset by which the path is shifted. Without one the path is cut as it was posted, whatever the
    /// size of the tool.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G1 G141 X1. Y0. Z0. I0. J0. K1. F20.
    /// G40
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G90 G1 G141 D0 X1. Y0. Z0. I0. J0. K1. F20.
    /// G40
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.
    /// G40
    /// G1 G141 X1. Y0. Z0. I0. J0. K1.
    /// G40
    /// M30
    /// ```
    rule "cutter-vector-without-size" in "five_axis" {
        summary: "3D cutter compensation without a cutter offset",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(CutterVectorWithoutSize) },
    }
}

struct CutterVectorWithoutSize;

impl PathRule for CutterVectorWithoutSize {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let codes = cx.codes();
        let Some(code) = codes.iter().copied().find(|code| is_along_vectors(cx.model.effect(*code))) else {
            return;
        };
        let Some(code) = cx.control().code_at(code) else { return };
        let (name, entry) = (code.number(), code.entry());
        let finding = match cx.word('D') {
            Some(_) if cx.known_number('D') == Some(0.0) => cx
                .finding(
                    &META,
                    cx.letter_range('D'),
                    format!("3D cutter compensation with no offset (`{name} D0`)"),
                )
                .label("offset zero has no size")
                .at_most(Severity::Warning),
            Some(_) => return,
            None if cx.is_malformed() => return,
            None if cx.is_called_only() || Abstract::known(cx.state().d()) != Some(0.0) => return,
            None => {
                let finding = cx.finding(
                    &META,
                    cx.effect_range(is_along_vectors),
                    format!("3D cutter compensation without an offset (`{name}` without `D`)"),
                );
                if is_given_elsewhere(cx) {
                    finding
                        .label("no `D` here, and none in effect on the way here")
                        .at_most(Severity::Warning)
                } else {
                    finding.label("no `D` here, and no earlier one in effect")
                }
            }
        };
        let finding = finding
            .note(format!("`D` selects the offset that `{name}` shifts the path by  [{}]", entry.source))
            .help(format!(
                "give the number of the offset with the tool's size, or with its difference: `{name} D1`"
            ))
            .at_most(limit(entry.confidence));
        report.add(finding.at_most(cx.environment.most_for_this_control()));
    }
}

/// Does another block give a `D`?
fn is_given_elsewhere(cx: &PathCx<'_>) -> bool {
    let d = Letter::of('D');
    cx.file_index.letters.contains(d) && !cx.origin().letters.contains(d)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

    #[test]
    fn computed_and_remembered_numbers_are_numbers() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G1 G41 D2 X1. F20.\nG40 X2.\nG141 X1. Y0. Z0. I0. J0. K1.\nG40\nG141 D#500 X1. I0. J0. K1.\nG40\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn an_offset_that_one_way_does_not_give_is_no_zero() {
        let program = "G90 G1 F20.\n/D01\nG141 X1. Y0. Z0. I0. J0. K1.\nG40\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        assert!(found.iter().all(|one| one.label == "no `D` here, and none in effect on the way here"));
        assert_eq!(found.len(), 1);
    }

    #[test]
    fn a_computed_zero_is_zero() {
        check_rule(
            &RULE,
            "haas-mill",
            "#1=0\nG90 G1 G141 D#1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n",
            &expect![[r#"
                2 | G90 G1 G141 D#1 X1. Y0. Z0. I0. J0. K1. F20.
                  |             ^^^ warning[cutter-vector-without-size] 3D cutter compensation with no offset (`G141 D0`)
            "#]],
        );
    }

    #[test]
    fn a_subprogram_takes_its_callers_offset() {
        check_rule(&RULE, "haas-mill", "O100\nG141 X1. Y0. Z0. I0. J0. K1.\nG40\nM99\n", &expect![[""]]);
    }
}
