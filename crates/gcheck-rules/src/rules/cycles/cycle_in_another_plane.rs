//! A cycle in another plane than the one that it is for.

use gcheck_controls::CodeNumber;
use gcheck_engine::{Fact, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// A cycle is called while another plane is in effect than the one that the page of the cycle asks for.
    ///
    /// ## Why it matters
    /// The manual calls this a mistake. Some versions of the control stop with an alarm; others cut along other axes than
    /// the program means.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G17 G90 G94 F100
    /// G97 S300 M3
    /// G0 X10 Z5
    /// G76 P1 Z-20 I-1 J0.2 K0.6
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G18 G90 G94 F100
    /// G97 S300 M3
    /// G0 X10 Z5
    /// G76 P1 Z-20 I-1 J0.2 K0.6
    /// M2
    /// ```
    rule "cycle-in-another-plane" in "cycles" {
        summary: "cycle in another plane than the one that it is for",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(CycleInAnotherPlane) },
    }
}

struct CycleInAnotherPlane;

impl PathRule for CycleInAnotherPlane {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // What a program does not choose, the start-up codes of a lathe may.
        let is_chosen = cx.code_of_role(Role::Plane).is_some()
            || cx.definitions().set_by(Fact::Mode(Role::Plane)).is_some();
        if !is_chosen {
            return;
        }
        for ix in cx.codes().iter() {
            let Some(code) = cx.code_of(*ix).filter(|code| !code.entry().recommends.is_empty()) else {
                continue;
            };
            let planes = code.entry().recommends.iter().filter_map(|name| CodeNumber::parse(name));
            let mut planes = planes.map(|number| cx.control().code_ix(number));
            let Some(wanted) = planes.find(|wanted| cx.model.role(*wanted) == Some(Role::Plane)) else {
                continue;
            };
            let active = cx.code_of_role(Role::Plane).or_else(|| cx.state().mode(Role::Plane).only());
            let Some(active) = active.filter(|active| cx.model.effect(*active) != cx.model.effect(wanted))
            else {
                continue;
            };
            let (name, active, wanted) = (code.number(), cx.name_of(active), cx.name_of(wanted));
            let finding = cx
                .finding(
                    &META,
                    cx.word_range(|word| word.code == *ix),
                    format!("`{name}` in another plane than its own (`{active}`)"),
                )
                .label(format!("for the plane of `{wanted}`"))
                .note(format!(
                    "`{name}` ({}) works in the plane of `{wanted}`  [{}]",
                    code.entry().title,
                    code.entry().source
                ))
                .help(format!("choose the plane with `{wanted}` before the cycle"))
                .at_most(limit(code.entry().confidence));
            report.add(cx.resting_on(finding, Fact::Mode(Role::Plane), &format!("`{active}`")));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_start_up_codes_may_choose_the_plane() {
        let program = "G21 G90 G94 F100\nG97 S300 M3\nG0 X10 Z5\nG76 P1 Z-20 I-1 J0.2 K0.6\nM2\n";
        check_rule(&RULE, "linuxcnc", program, &expect![[""]]);
    }

    #[test]
    fn a_plane_of_the_same_block_counts() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G17 G90 G94 F100\nG97 S300 M3\nG0 X10 Z5\nG18 G76 P1 Z-20 I-1 J0.2 K0.6\nG17 G76 P1 Z-20 I-1 J0.2 K0.6\nM2\n",
            &expect![[r#"
                5 | G17 G76 P1 Z-20 I-1 J0.2 K0.6
                  |     ^^^ warning[cycle-in-another-plane] `G76` in another plane than its own (`G17`)
            "#]],
        );
    }
}
