//! A cut around a cylinder without feed per minute.

use gcheck_controls::{CodeNumber, Effect};
use gcheck_engine::{At, Event, Fact, FeedMode, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A cut around a cylinder under a feed mode that the control's manual does not recommend for it.
    ///
    /// ## Why it matters
    /// Under feed per minute the control uses `F` as the speed along the surface. In inverse time `F` only gives the
    /// time of a move: the tool is faster along long moves than along short ones, and each block needs its own `F`.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G107 Y0. A0. Q2.5
    /// G93 G1 Y1. F10.
    /// G94
    /// G107
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G107 Y0. A0. Q2.5
    /// G94 G1 Y1. F10.
    /// G107
    /// M30
    /// ```
    rule "cylinder-feed-mode" in "mapping" {
        summary: "cut around a cylinder without feed per minute",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(CylinderFeedMode { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct CylinderFeedMode {
    /// The block that set the mode that was reported last.
    told: Option<At>,
}

remembers!(CylinderFeedMode: told);

impl PathRule for CylinderFeedMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        let fact = Fact::Mode(Role::FeedMode);
        let set_by = cx.definitions().set_by(fact);
        if state.cylinder().is_none() || set_by.is_none() || set_by == self.told {
            return;
        }
        let what = match state.feed_mode(cx.model) {
            Some(FeedMode::InverseTime) => "`F` says how long each move takes, not how fast the surface runs",
            Some(FeedMode::PerRevolution) => "`F` counts turns of the spindle, not time",
            Some(FeedMode::PerMinute) | None => return,
        };
        let control = cx.control();
        let Some(mapping) = state.mode(Role::Cylinder).only().and_then(|code| control.code_at(code)) else {
            return;
        };
        let is_per_minute = |name: &&String| {
            let code = CodeNumber::parse(name).and_then(|number| control.code_at(control.code_ix(number)));
            code.is_some_and(|code| code.effect() == Effect::FeedPerMinute)
        };
        let Some(recommended) = mapping.entry().recommends.iter().find(is_per_minute) else { return };
        let Some(mode) = cx.code_name(Role::FeedMode) else { return };
        self.told = set_by;
        let entry = mapping.entry();
        let finding = cx
            .finding(&META, cx.range(), format!("a cut around the cylinder under `{mode}`"))
            .label(what)
            .note(format!("`{}` ({}) goes with `{recommended}`  [{}]", entry.code, entry.title, entry.source))
            .help(format!("go back to feed per minute (`{recommended}`) before the first wrapped cut"));
        let finding = cx.resting_on(finding, fact, &format!("`{mode}`"));
        report.add(cx.resting_on(finding, Fact::Mode(Role::Cylinder), &format!("`{}`", entry.code)));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn each_mode_is_told_once_and_rapids_are_not() {
        check_rule(
            &RULE,
            "haas-mill",
            "G93\nG107 Y0. A0. Q2.5\nG0 Y0.\nG1 Y1. F10.\nY2. F10.\nG95 G1 Y3. F.1\nG107\nG1 Y0.\nM30\n",
            &expect![[r#"
                4 | G1 Y1. F10.
                  | ^^^^^^^^^^^ info[cylinder-feed-mode] a cut around the cylinder under `G93`
                6 | G95 G1 Y3. F.1
                  | ^^^^^^^^^^^^^^ info[cylinder-feed-mode] a cut around the cylinder under `G95`
            "#]],
        );
    }

    #[test]
    fn a_lathe_has_no_such_advice() {
        check_rule(&RULE, "haas-lathe", "G99\nG107 Z0. C0. R1.\nG1 Z1. F.1\nG107\nM30\n", &expect![[""]]);
    }

    #[test]
    fn what_it_says() {
        let program = "G93\nG107 Y0. A0. Q2.5\nG1 Y1. F10.\nG94\nG107\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            a cut around the cylinder under `G93`
              here: `F` says how long each move takes, not how fast the surface runs
              there: `G93` set here
              there: `G107` set here
              note: `G107` (cylindrical mapping) goes with `G94`  [Haas 96-8000 June 1999 p.203 (printed); gcodes.net, G107; Haas online manual, inverse time and feed per minute modes; HM17 p.307]
              help: go back to feed per minute (`G94`) before the first wrapped cut
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
