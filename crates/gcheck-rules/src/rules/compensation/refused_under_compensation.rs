//! An operation that the control refuses while cutter compensation is on.

use gcheck_controls::{CompensationRefusals, Effect};
use gcheck_engine::{Abstract, At, CompensationFault, Domain, Fact, Fault, Role};

use crate::declare::declare_rule;
use crate::facts::compensation::limits_reading_ahead;
use crate::{PathCx, PathRule, Remembers, Report, Run, Watch, limit, remembers};

declare_rule! {
    /// A block asks for something that the control refuses while cutter compensation is on, or switches compensation on
    /// twice, or in a plane in which it does not work.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, with the tool at the part.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G17 F100
    /// G41.1 D6 G1 X10
    /// G1 Y10
    /// G28
    /// M2
    /// ```
    /// ```nc,reported,linuxcnc
    /// G21 G90 G17 F100
    /// G41.1 D6 G1 X10
    /// G41.1 D6 Y10
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G17 F100
    /// G41.1 D6 G1 X10
    /// G1 Y10
    /// G40 X20
    /// G28
    /// M2
    /// ```
    rule "refused-under-compensation" in "compensation" {
        summary: "refused while cutter compensation is on",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::FAULTS.union(Watch::BLOCKS),
            make: || Box::new(RefusedUnderCompensation { limited: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct RefusedUnderCompensation {
    /// The block that limited how far the control reads ahead.
    limited: Option<At>,
}

remembers!(RefusedUnderCompensation: limited);

impl PathRule for RefusedUnderCompensation {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(refusals) = &cx.model.semantics().compensation.refuses else { return };
        let was_on =
            cx.state().effect(Role::Compensation, cx.model).is_some_and(Effect::offsets_path_by_number);
        let begins = cx.has_effect(Effect::offsets_path_by_number);
        let ends = cx.has_effect(|effect| effect == Effect::CompensationOff);
        let limits = cx.codes().iter().any(|code| limits_reading_ahead(cx, *code));
        let refused = if limits && was_on && !ends {
            Some(READ_AHEAD)
        } else if begins && self.limited.is_some() {
            Some(READ_AHEAD_LIMITED)
        } else if begins || was_on && !ends {
            refused_in_block(cx, refusals, begins)
        } else {
            None
        };
        if limits {
            self.limited = cx.known_number('P').filter(|blocks| *blocks != 0.0).map(|_| cx.origin().at);
        }
        let Some((message, label, help)) = refused else { return };
        let finding = cx
            .finding(&META, cx.range(), message)
            .label(label)
            .note(format!("the control stops with an alarm  [{}]", refusals.source))
            .help(help)
            .at_most(limit(refusals.confidence));
        let finding = match self.limited.filter(|_| begins && !limits).and_then(|at| cx.range_of(at)) {
            Some(range) => finding.also(range, "limits how far the control reads ahead"),
            None => finding,
        };
        report.add(if begins {
            finding
        } else {
            let code = cx.code_name(Role::Compensation).unwrap_or_else(|| "compensation".to_owned());
            cx.resting_on(finding, Fact::Mode(Role::Compensation), &format!("`{code}`"))
        });
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::Compensation(fault) = fault else { return };
        let semantics = cx.model.semantics();
        let is_of_plane = semantics.compensation.freezes_plane && cx.code_of_role(Role::Plane).is_some();
        let (message, label, help) = match fault {
            CompensationFault::NotWhileOn if is_of_plane => (
                "the plane changes while cutter compensation is on",
                "the contour is offset in the plane that was active before",
                "switch compensation off (`G40`) with a move away from the part before the plane changes",
            ),
            CompensationFault::NotWhileOn => (
                "the control refuses this while cutter compensation is on",
                "refused with compensation on",
                "switch compensation off (`G40`) with a move away from the part before this block",
            ),
            CompensationFault::AlreadyOn => (
                "cutter compensation is on already",
                "switched on a second time",
                "switch compensation off (`G40`) before it is switched on again",
            ),
            CompensationFault::Plane => (
                "cutter compensation does not work in this plane",
                "switched on in a plane in which it does not work",
                "select `G17` (`G18` on a lathe) before compensation is switched on",
            ),
            // Other rules report these.
            CompensationFault::EntryTooShort { .. }
            | CompensationFault::EntryIsArc
            | CompensationFault::ExitIsArc
            | CompensationFault::Gouge => return,
        };
        let finding = cx.finding(&META, cx.range(), message).label(label).help(help);
        let code =
            cx.code_name(Role::Compensation).map_or_else(|| "compensation".to_owned(), |c| format!("`{c}`"));
        let finding = if is_of_plane { finding.at_most(limit(semantics.confidence)) } else { finding };
        report.add(match fault {
            CompensationFault::Plane => finding,
            _ => cx.resting_on(finding, Fact::Mode(Role::Compensation), &code),
        });
    }
}

/// What is wrong, why it is refused, what to do.
type Words = (&'static str, &'static str, &'static str);

const READ_AHEAD: Words = (
    "the control refuses a limit of reading ahead under cutter compensation",
    "compensation needs the blocks that follow",
    "limit reading ahead before compensation is switched on, and end the limit (`P0`) before it, too",
);

const READ_AHEAD_LIMITED: Words = (
    "cutter compensation begins while reading ahead is limited",
    "compensation needs the blocks that follow",
    "end the limit (`P0`) before compensation is switched on",
);

/// A plane, or an offset, that the control refuses in a block under compensation.
fn refused_in_block(cx: &PathCx<'_>, refusals: &CompensationRefusals, begins: bool) -> Option<Words> {
    let plane = match cx.code_of_role(Role::Plane) {
        Some(code) => Some(cx.model.effect(code)),
        None => cx.state().effect(Role::Plane, cx.model),
    };
    let motion = match cx.code_of_role(Role::Motion) {
        Some(code) => Some(cx.model.effect(code)),
        None => cx.state().effect(Role::Motion, cx.model),
    };
    let is_arc = motion.is_some_and(Effect::is_arc) && cx.names_axes();
    let elsewhere = matches!(plane, Some(Effect::PlaneZx | Effect::PlaneYz | Effect::PlaneSecondary));
    if refusals.other_planes && elsewhere && is_arc && !begins {
        return Some((
            "an arc outside the XY plane under cutter compensation",
            "compensation works in the XY plane only",
            "switch compensation off (`G40`) before the arc, or cut it in the XY plane (`G17`)",
        ));
    }
    if refusals.other_planes && elsewhere && begins {
        return Some((
            "cutter compensation does not work in this plane",
            "switched on in a plane in which it does not work",
            "select `G17` before compensation is switched on",
        ));
    }
    let changes = cx
        .known_number('D')
        .is_some_and(|d| Abstract::known(cx.state().d()).is_some_and(|old| (old - d).abs() > 1e-9));
    (refusals.offset_on_arc && is_arc && !begins && changes).then_some((
        "another offset on an arc under cutter compensation",
        "the offset cannot change on an arc",
        "change the offset on a straight move",
    ))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_block_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 F100\nG41.1 D6 G1 X10\nG1 Y10\nG28\nM2\n",
            &expect![[r#"
            4 | G28
              | ^^^ error[refused-under-compensation] the control refuses this while cutter compensation is on
        "#]],
        );
    }

    #[test]
    fn what_a_manual_refuses() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G17\nG41 D1 G1 X1. F10.\nG18 G2 X2. Z-1. R1.\nG17 G1 X3.\nG2 X4. Y-1. R1. D2\nG103 P1\nG40 G1 X5.\nG41 D1 X6.\nG40 X7.\nG103\nG19\nG41 D1 Y1.\nG40 Y2.\nM30\n",
            &expect![[r#"
                3 | G18 G2 X2. Z-1. R1.
                  | ^^^^^^^^^^^^^^^^^^^ error[refused-under-compensation] an arc outside the XY plane under cutter compensation
                5 | G2 X4. Y-1. R1. D2
                  | ^^^^^^^^^^^^^^^^^^ error[refused-under-compensation] another offset on an arc under cutter compensation
                6 | G103 P1
                  | ^^^^^^^ error[refused-under-compensation] the control refuses a limit of reading ahead under cutter compensation
                8 | G41 D1 X6.
                  | ^^^^^^^^^^ error[refused-under-compensation] cutter compensation begins while reading ahead is limited
                12 | G41 D1 Y1.
                   | ^^^^^^^^^^ error[refused-under-compensation] cutter compensation does not work in this plane
            "#]],
        );
    }

    #[test]
    fn the_plane_stays_as_it_is() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G17\nG41 D6 G1 X10. F100.\nG17 Y10.\nG18 Y20.\nG40 X20.\nG18\nM30\n",
            &expect![[r#"
                4 | G18 Y20.
                  | ^^^^^^^^ warning[refused-under-compensation] the plane changes while cutter compensation is on
            "#]],
        );
    }

    #[test]
    fn other_planes() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G19 F100\nG41.1 D6 G1 Y10\nM2\n",
            &expect![[r#"
            2 | G41.1 D6 G1 Y10
              | ^^^^^^^^^^^^^^^ error[refused-under-compensation] cutter compensation does not work in this plane
        "#]],
        );
    }
}
