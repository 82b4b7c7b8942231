//! A tool section that cannot be restarted from its tool change.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{At, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range};
use crate::{Finding, PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool section relies on modes that were set before its tool change: plane, positions or increments, units, work
    /// offset, tool length, feed, speed, spindle, coolant.
    ///
    /// ## Why it matters
    /// After a broken tool the operator restarts at the tool change. Modes from an earlier part of the program are not
    /// set then. The rule is for shops that restart like this; it is off by default.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G90 G54
    /// T1 M6
    /// S1000 M3
    /// G1 X10. F100.
    /// T2 M6
    /// S2000 M3
    /// G1 X20.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G90 G54
    /// T1 M6
    /// S1000 M3
    /// G1 X10. F100.
    /// T2 M6
    /// G17 G21 G90 G54 S2000 M3
    /// G1 X20. F150.
    /// M30
    /// ```
    rule "tool-section-not-restart-safe" in "modal" {
        summary: "tool section relies on modes set before its tool change",
        severity: Hint,
        tier: Path,
        recommended: false,
        sets: [RestartSafe],
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CHANGES).union(Watch::CUTS),
            make: || Box::new(ToolSectionNotRestartSafe { section: None, sections: 0, has_coolant: false }),
        },
    }
}

/// A tool section, before its first cut.
#[derive(Clone, PartialEq)]
struct Section {
    finding: Finding,
    /// What was stated since the tool change.
    stated: Vec<Needed>,
}

remembers!(Section: finding);

/// What a section must state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Needed {
    Plane,
    Distance,
    Units,
    WorkOffset,
    Length,
    Feed,
    Speed,
    Spindle,
    Coolant,
}

#[derive(Clone, PartialEq)]
struct ToolSectionNotRestartSafe {
    section: Option<Section>,
    sections: usize,
    /// Coolant is on.
    has_coolant: bool,
}

remembers!(ToolSectionNotRestartSafe: section);

impl PathRule for ToolSectionNotRestartSafe {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if boundary(cx) != Some(Boundary::ToolChange) {
            return;
        }
        self.sections += 1;
        self.section = None;
        // The first tool section begins with the program.
        if self.sections > 1 {
            let range = boundary_range(cx, Boundary::ToolChange);
            let mut stated = Vec::new();
            // `G90 G54 T2 M6`: stated in the block that the operator starts from.
            for code in cx.codes().iter().copied() {
                stated.extend(cx.model.role(code).and_then(of_role));
            }
            let letters = cx.origin().letters;
            stated.extend(letters.contains(Letter::of('S')).then_some(Needed::Speed));
            stated.extend(letters.contains(Letter::of('F')).then_some(Needed::Feed));
            self.section = Some(Section { finding: cx.finding(&META, range, String::new()), stated });
        }
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if let Event::Coolant { on, .. } = event {
            self.has_coolant = *on;
        }
        let Some(section) = &mut self.section else { return };
        let stated = match event {
            Event::FeedRate(_) => Some(Needed::Feed),
            Event::SpindleSpeed(_) => Some(Needed::Speed),
            Event::Spindle(spindle) => {
                (*spindle != gcheck_engine::Spindle::Stopped).then_some(Needed::Spindle)
            }
            Event::WorkOffset { .. } => Some(Needed::WorkOffset),
            Event::Coolant { on: true, .. } => Some(Needed::Coolant),
            _ => None,
        };
        section.stated.extend(stated);
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let Some(section) = self.section.take() else { return };
        let start = section.finding.range.start;
        let in_section = |at: At| cx.range_of(at).is_some_and(|range| range.start >= start);
        let set_now = |role: Role| cx.definitions().set_by(Fact::Mode(role)).is_some_and(in_section);
        let mut missing = Vec::new();
        let by_turret = cx.model.semantics().tools.change_by_t;
        for (needed, role, word) in [
            (Needed::Plane, Some(Role::Plane), cx.code_name(Role::Plane)),
            (Needed::Units, Some(Role::Units), cx.code_name(Role::Units)),
            (Needed::Length, Some(Role::Length), cx.code_name(Role::Length)),
            (Needed::Distance, Some(Role::Distance), cx.name_of_effect(Effect::Absolute)),
            (Needed::WorkOffset, Some(Role::WorkOffset), cx.name_of_effect(Effect::WorkOffset(1))),
            (Needed::Feed, None, Some("F".to_owned())),
            (Needed::Speed, None, Some("S".to_owned())),
            (Needed::Spindle, None, cx.name_of_effect(Effect::SpindleClockwise)),
            (Needed::Coolant, None, cx.name_of_effect(Effect::FloodOn)),
        ] {
            let Some(word) = word else { continue };
            let is_stated = section.stated.contains(&needed) || role.is_some_and(set_now);
            let is_needed = match needed {
                // Turrets find the part by the tool's own offset.
                Needed::WorkOffset => !by_turret,
                // Other rules report what the program never states.
                Needed::Plane | Needed::Units => {
                    // Turning has one plane.
                    let is_known = match needed {
                        Needed::Plane => by_turret,
                        _ => cx.environment.machine.units_are_told,
                    };
                    !is_known && role.is_some_and(|role| cx.definitions().set_by(Fact::Mode(role)).is_some())
                }
                // A length from the tool before; another rule reports a missing length.
                Needed::Length => {
                    let is_off = |effect| matches!(effect, Effect::LengthOff | Effect::None);
                    !by_turret
                        && cx.state().effect(Role::Length, cx.model).is_some_and(|effect| !is_off(effect))
                        && cx.definitions().set_by(Fact::Length).is_some_and(|at| !in_section(at))
                }
                // On since an earlier part of the program, or off as far as is known.
                Needed::Coolant => self.has_coolant,
                // Increments with their own letters need no mode.
                Needed::Distance => cx.model.semantics().increments.is_empty(),
                Needed::Feed | Needed::Speed | Needed::Spindle => true,
            };
            if is_needed && !is_stated {
                missing.push(format!("`{word}`"));
            }
        }
        if missing.is_empty() || cx.is_after_unknown_program() {
            return;
        }
        let mut finding = section.finding;
        finding.message =
            format!("the tool section relies on modes that were set before it ({})", missing.join(", "));
        report.add(
            finding
                .label("a restart from here does not set it")
                .also(cx.range(), "its first cut")
                .help(format!("state {} again after the tool change", missing.join(", "))),
        );
    }
}

fn of_role(role: Role) -> Option<Needed> {
    match role {
        Role::Plane => Some(Needed::Plane),
        Role::Distance => Some(Needed::Distance),
        Role::Units => Some(Needed::Units),
        Role::WorkOffset => Some(Needed::WorkOffset),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn what_is_missing_is_listed() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54\nT1 M6\nS500 M3\nG1 X1. F5.\nT2 M6\nG1 X2.\nM30\n",
            &expect![[r#"
                5 | T2 M6
                  |    ^^ hint[tool-section-not-restart-safe] the tool section relies on modes that were set before it (`G20`, `G90`, `G54`, `F`, `S`, `M3`)
            "#]],
        );
    }

    #[test]
    fn the_first_tool_begins_with_the_program() {
        check_rule(&RULE, "haas-mill", "G20 G90 G54 S500 M3\nT1 M6\nG1 X1. F5.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_turret_states_speed_and_feed() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21\nT0101\nG97 S500 M3\nG1 X1. F.1\nT0202\nG1 X2.\nM30\n",
            &expect![[r#"
                5 | T0202
                  | ^^^^^ hint[tool-section-not-restart-safe] the tool section relies on modes that were set before it (`G21`, `F`, `S`, `M3`)
            "#]],
        );
    }
}
