//! A hole ten times as deep as the others of its tool.

use std::ops::Range;

use gcheck_controls::{CodeIx, Letter};
use gcheck_engine::{At, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::boundary;
use crate::facts::cycles::{is_drilling, is_tapping};
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The depths (`Z`) that a tool gives in one canned cycle from one level `R` are the same or nearly the same at two blocks or
    /// more, and exactly ten times as much at one.
    ///
    /// ## Why it matters
    /// The decimal point slipped: the drill goes through the part into the vise or the table.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 T1 M6
    /// G0 X0. Y0. S2000 M3
    /// G43 H1 Z10.
    /// G99 G81 Z-.75 R2. F100.
    /// X10. Z-.75
    /// X20. Z-7.5
    /// X30. Z-.75
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 T1 M6
    /// G0 X0. Y0. S2000 M3
    /// G43 H1 Z10.
    /// G99 G81 Z-.75 R2. F100.
    /// X10. Z-.75
    /// X20. Z-.85
    /// X30. Z-.75
    /// G80
    /// M30
    /// ```
    rule "hole-ten-times-as-deep" in "cycles" {
        summary: "hole ten times as deep as the others of its tool",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::STROKES).union(Watch::FOLLOWED),
            make: || Box::new(HoleTenTimesAsDeep::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct HoleTenTimesAsDeep {
    holes: Vec<Hole>,
}

remembers!(HoleTenTimesAsDeep: holes);

/// A depth as a block of the cycle gives it.
#[derive(Clone, PartialEq)]
struct Hole {
    at: At,
    cycle: CodeIx,
    tool: Option<At>,
    /// The level that it begins at; `None` as the control has it.
    r: Option<f64>,
    z: f64,
    bytes: Range<u32>,
    finding: Finding,
}

remembers!(Hole: at, tool, bytes, finding);

/// Longer series come from a system.
const MOST: usize = 500;

impl PathRule for HoleTenTimesAsDeep {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| is_drilling(effect) || is_tapping(effect))
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if boundary(cx).is_some() {
            self.judge(report);
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        // The strokes of a block are one hole.
        let is_new = self.holes.last().is_none_or(|hole| hole.at != cx.origin().at);
        if !travel.expanded || !is_new {
            return;
        }
        if !cx.origin().letters.contains(Letter::of('Z')) || self.holes.len() >= MOST || cx.is_malformed() {
            return;
        }
        let is_hole = |ix: &CodeIx| {
            let effect = cx.model.effect(*ix);
            is_drilling(effect) || is_tapping(effect)
        };
        let own = cx.codes().iter().copied().find(is_hole);
        let goes_on = || cx.state().active_cycle(cx.model).filter(|ix| ix.is_some() && is_hole(ix));
        let others = cx.codes().iter().any(|ix| !is_hole(ix) && cx.model.role(*ix).is_some_and(ends));
        let Some(cycle) = own.or_else(goes_on).filter(|_| own.is_some() || !others) else { return };
        // A level of its own for the start is another surface.
        let is_plain = own.is_some() || !cx.origin().letters.contains(Letter::of('R'));
        let Some(z) = cx.known_number('Z').filter(|z| *z < 0.0 && is_plain) else { return };
        let before = self.holes.last().filter(|hole| hole.cycle == cycle);
        let r = cx.known_number('R').or_else(|| before.and_then(|hole| hole.r));
        let bytes = cx.letter_range('Z');
        let finding = cx.finding(&META, bytes.clone(), "hole ten times as deep as the others of its tool");
        let tool = cx.definitions().set_by(Fact::Tool);
        self.holes.push(Hole { at: cx.origin().at, cycle, tool, r, z, bytes, finding });
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        self.judge(report);
    }
}

impl HoleTenTimesAsDeep {
    /// The work of a tool has ended.
    fn judge(&mut self, report: &mut Report<'_>) {
        let mut holes = std::mem::take(&mut self.holes);
        // Loops give one block several times.
        let mut seen: Vec<At> = Vec::new();
        holes.retain(|hole| {
            let is_new = !seen.contains(&hole.at);
            seen.push(hole.at);
            is_new
        });
        for hole in &holes {
            // From another level it is the hole of another surface.
            let same = |other: &&Hole| {
                (other.cycle, other.tool, other.r) == (hole.cycle, hole.tool, hole.r) && other.at != hole.at
            };
            let others: Vec<&Hole> = holes.iter().filter(same).collect();
            let is_tenth = |other: &&Hole| (other.z * 10.0 - hole.z).abs() < 1e-6;
            let is_near = |other: &&Hole| other.z > hole.z / 5.0;
            let tenths: Vec<&&Hole> = others.iter().filter(|other| is_tenth(other)).collect();
            let [first, _, ..] = tenths.as_slice() else { continue };
            if !others.iter().all(is_near) {
                continue;
            }
            report.add(
                hole.finding
                    .clone()
                    .label("ten times the depth of the others")
                    .also(first.bytes.clone(), "the same digits, with the point elsewhere")
                    .help("check the decimal point of `Z`"),
            );
        }
    }
}

/// Is it a role whose codes end the cycle, or move otherwise?
fn ends(role: Role) -> bool {
    matches!(role, Role::Motion | Role::Cycle)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(holes: &str) -> String {
        format!("G21 G90 G54 T1 M6\nG0 X0. Y0. S2000 M3\nG43 H1 Z10.\n{holes}\nG80\nG0 Z50.\nT2 M6\nM30\n")
    }

    #[test]
    fn two_others_give_the_depth() {
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G99 G83 Z-12. R2. Q2. F100.\nX10. Z-120.\nX20. Z-12."),
            &expect![[r#"
                5 | X10. Z-120.
                  |      ^^^^^^ warning[hole-ten-times-as-deep] hole ten times as deep as the others of its tool
            "#]],
        );
        for holes in [
            // One other only, other depths too, and a depth of the program's own.
            "G99 G81 Z-12. R2. F100.\nX10. Z-120.",
            "G99 G81 Z-12. R2. F100.\nX10. Z-120.\nX20. Z-12.\nX30. Z-120.",
            "G99 G81 Z-12. R2. F100.\nX10. Z-60.\nX20. Z-12.\nX30. Z-120.",
            "G99 G81 Z-1. R2. F100.\nX10. Z-1.\nG80\nG83 Z-10. R2. Q2. F100.",
            "G99 G81 Z-1. R2. F100.\nX10. Z-1.\nG80\nG0 Z5.\nZ-10.",
            // A surface further down.
            "G98 G81 Z-12. R2. F100.\nX10. Z-12.\nG98 G81 X20. Z-120. R-105. F100.",
        ] {
            check_rule(&RULE, "fanuc-mill", &program(holes), &expect![[""]]);
        }
    }
}
