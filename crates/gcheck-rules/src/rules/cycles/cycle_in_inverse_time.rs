//! A canned cycle, a pocket or a pattern of holes under inverse-time feed.

use std::collections::BTreeSet;

use gcheck_controls::Effect;
use gcheck_engine::{At, CycleFault, Fact, Fault, FeedMode, Role};

use crate::declare::declare_rule;
use crate::facts::cycles::{cycle_range, is_cycle, is_round_pocket};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A canned cycle, a pocket or a pattern of holes is called while feeds are inverse times (`G93`).
    ///
    /// ## Why it matters
    /// Under inverse time `F` sets the time of one move, and a cycle makes many. The control stops with an alarm, or
    /// feeds at an unintended rate.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// G93
    /// G81 X10 Z-5 R2 F10
    /// M2
    /// ```
    /// ```nc,reported,haas-mill
    /// G20 G90 G17 G0 X0. Y0. Z.1
    /// G93
    /// G12 Z-.5 I.5 D1 F10.
    /// G94
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// G93 G1 X5 F10
    /// G94
    /// G81 X10 Z-5 R2 F10
    /// M2
    /// ```
    rule "cycle-in-inverse-time" in "cycles" {
        summary: "canned cycle or pocket under inverse-time feed",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::FAULTS.union(Watch::BLOCKS),
            make: || Box::new(CycleInInverseTime::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleInInverseTime {
    /// Blocks that chose inverse time: one finding for each.
    told: BTreeSet<Option<At>>,
}

remembers!(CycleInInverseTime: told);

impl PathRule for CycleInInverseTime {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault == Fault::Cycle(CycleFault::InverseTime) {
            self.tell(cx, Severity::Error, report);
        }
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // Controls that refuse it alarm when the cycle runs.
        if cx.model.semantics().compensation.freezes_modes || !cx.has_effect(makes_moves) {
            return;
        }
        // A feed mode beside the cycle holds for it already.
        let is_inverse_time = match cx.code_of_role(Role::FeedMode) {
            Some(code) => cx.model.effect(code) == Effect::FeedInverseTime,
            None => cx.state().feed_mode(cx.model) == Some(FeedMode::InverseTime),
        };
        if is_inverse_time {
            self.tell(cx, Severity::Warning, report);
        }
    }
}

/// Does one block with the code make several cutting moves?
fn makes_moves(effect: Effect) -> bool {
    let is_pattern = effect.is_hole_pattern();
    is_cycle(effect) || is_round_pocket(effect) || is_pattern || effect == Effect::GeneralPocket
}

impl CycleInInverseTime {
    fn tell(&mut self, cx: &PathCx<'_>, severity: Severity, report: &mut Report<'_>) {
        let fact = Fact::Mode(Role::FeedMode);
        let own = cx.code_of_role(Role::FeedMode);
        let set_by = if own.is_some() { Some(cx.origin().at) } else { cx.definitions().set_by(fact) };
        if !self.told.insert(set_by) {
            return;
        }
        let name = match own {
            Some(code) => cx.name_of(code),
            None => cx.code_name(Role::FeedMode).unwrap_or_default(),
        };
        let (what, short) = if cx.has_effect(|e| is_round_pocket(e) || e == Effect::GeneralPocket) {
            ("pocket", "pocket")
        } else if cx.has_effect(is_cycle) {
            ("canned cycle", "cycle")
        } else {
            ("pattern of holes", "pattern")
        };
        let finding = cx
            .finding(&META, cycle_range(cx), format!("{what} under inverse-time feed (`{name}`)"))
            .label(format!("`F` sets the time of one move, and a {short} makes many"))
            .help(format!("go back to feed per minute (`G94`) before the {short}"))
            .at_most(severity);
        report.add(match own {
            Some(_) => finding,
            None => cx.resting_on(finding, fact, &format!("`{name}`")),
        });
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

    #[test]
    fn the_cycle_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G0 X0 Y0 Z1.\nG93 G1 X1. F10.\nG81 X2. Z-.5 R.1 F5.\nG80\nG94\nG81 X2. Z-.5 R.1\nG80\nM30\n",
            &expect![[r#"
                3 | G81 X2. Z-.5 R.1 F5.
                  | ^^^ warning[cycle-in-inverse-time] canned cycle under inverse-time feed (`G93`)
            "#]],
        );
    }

    #[test]
    fn the_mode_may_be_in_the_block_of_the_cycle() {
        let program = |block: &str| format!("G20 G90 G17 G0 X0. Y0. Z1.\n{block}\nG80 G94 F10.\nM30\n");
        for block in [
            "G93 G81 X1. Z-0.5 R0.1 F10.\nX2.",
            "G81 G93 X1. Z-0.5 R0.1 F10.",
            "G93 G12 I0.5 Z-0.1 D01 F10.",
            "G93 G150 G41 D01 P2000 X0. Y0. Z-0.5 Q0.25 R0.1 J0.3 F15.",
        ] {
            let found = findings(&only(&RULE), "haas-mill", &program(block), &World::default());
            assert_eq!(found.len(), 1, "{block}");
        }
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G0 X0 Y0 Z10\nG93 G81 X10 Z-5 R2 F10\nM2\n",
            &expect![[r#"
            2 | G93 G81 X10 Z-5 R2 F10
              |     ^^^ error[cycle-in-inverse-time] canned cycle under inverse-time feed (`G93`)
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program("G93 G1 X1. F10.\nG94 G81 X1. Z-0.5 R0.1 F10."),
            &expect![[""]],
        );
    }
}
