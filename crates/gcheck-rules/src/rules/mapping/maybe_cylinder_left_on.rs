//! Cylindrical mapping that may be left on.

use gcheck_controls::Effect;
use gcheck_engine::{At, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range};
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// On some paths a linear axis is still wrapped around a cylinder when the tool is changed.
    ///
    /// ## Why it matters
    /// As for `cylinder-left-on`, on the paths that come here with the mapping on.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G107 Y0. A0. Q2.5
    /// IF [#100 EQ 1] GOTO 5
    /// G107
    /// N5 T2 M6
    /// G107
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G107 Y0. A0. Q2.5
    /// IF [#100 EQ 1] GOTO 5
    /// G1 Y1. F10.
    /// N5 G107
    /// T2 M6
    /// M30
    /// ```
    rule "maybe-cylinder-left-on" in "mapping" {
        summary: "cylindrical mapping left on, on some paths",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(MaybeCylinderLeftOn { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct MaybeCylinderLeftOn {
    /// The block that began what was reported last.
    told: Option<At>,
}

remembers!(MaybeCylinderLeftOn: told);

impl PathRule for MaybeCylinderLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if boundary(cx) != Some(Boundary::ToolChange) || cx.model.semantics().cylinder.is_none() {
            return;
        }
        let is_on = |effect| effect == Effect::CylinderMapping;
        let Some(ActiveMode::Possible(code)) = left_on(cx, Role::Cylinder, is_on) else { return };
        let fact = Fact::Mode(Role::Cylinder);
        let set_by = cx.definitions().set_by(fact);
        if set_by.is_none() || set_by == self.told || cx.is_after_unknown_program() {
            return;
        }
        self.told = set_by;
        let name = cx.name_of(code);
        let place = Boundary::ToolChange;
        let message = format!("an axis may still be wrapped {} (`{name}`)", place.words());
        let finding = cx
            .finding(&META, boundary_range(cx, place), message)
            .label("on some paths the cylinder is still mapped here")
            .help(format!("end mapping on every path, with `{name}` alone in its block"));
        report.add(cx.with_path(cx.resting_on(finding, fact, &format!("`{name}`"))));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_word_that_may_be_nothing_may_begin_it() {
        check_rule(
            &RULE,
            "haas-mill",
            "G107 Y#100 A0. Q2.\nT2 M6\nM30\n",
            &expect![[r#"
            2 | T2 M6
              |    ^^ info[maybe-cylinder-left-on] an axis may still be wrapped at the tool change (`G107`)
        "#]],
        );
    }

    #[test]
    fn what_is_on_for_certain_is_another_rules() {
        check_rule(&RULE, "haas-mill", "G107 Y0. A0. Q2.\nT2 M6\nM98 P77\nT3 M6\nM30\n", &expect![[""]]);
    }

    #[test]
    fn what_it_says() {
        let program = "G107 Y0. A0. Q2.5\nIF [#100 EQ 1] GOTO 5\nG107\nN5 T2 M6\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            an axis may still be wrapped at the tool change (`G107`)
              here: on some paths the cylinder is still mapped here
              there: `G107` set here
              there: when this is taken
              help: end mapping on every path, with `G107` alone in its block
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
