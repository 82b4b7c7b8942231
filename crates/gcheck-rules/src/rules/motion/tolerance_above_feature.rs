//! A tolerance of blending that is larger than a feature cut under it.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_3;

use gcheck_controls::{Control, CornerRules, Effect};
use gcheck_engine::{At, Event, Fact, PathMode, Position, Role, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::smoothing::SmoothingTolerance;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Corners are blended with a tolerance that is larger than the radius of an arc, or than a step between two sharp corners.
    ///
    /// The tolerance is that of `G64 P`, or of `G187 E`, or without both that of the control's setting, where `[settings]`
    /// gives it. Arcs count from a sixth of a turn on, with `G64 P`; steps between corners of 60 degrees and more, where
    /// the moves beside them are much longer. Each tolerance is reported once.
    ///
    /// ## Why it matters
    /// The control may leave the path by the tolerance at each corner, so that a feature of that size may be missing from the
    /// part.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G17 G64 P0.5
    /// G0 X0 Y0
    /// G1 X10 F500
    /// G3 X10.2 Y0.2 J0.2
    /// G1 Y10
    /// M2
    /// ```
    /// ```nc,reported,haas-mill
    /// G21 G90 G17 G187 P1 E2.
    /// G0 X0. Y0.
    /// G1 X10. F500.
    /// Y0.3
    /// X20.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G17 G64 P0.05
    /// G0 X0 Y0
    /// G1 X10 F500
    /// G3 X10.2 Y0.2 J0.2
    /// G1 Y10
    /// M2
    /// ```
    rule "tolerance-above-feature" in "motion" {
        summary: "blending tolerance larger than a feature",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(ToleranceAboveFeature::default()),
        },
    }
}

/// So many times as long as a step are the moves beside it; between shorter ones it belongs to a curve.
const STEP: f64 = 5.0;
/// A step that is a smaller part of the tolerance is the rounding of a CAM system.
const NOISE: f64 = 0.1;

#[derive(Default, Clone, PartialEq)]
struct ToleranceAboveFeature {
    /// The straight moves before this one, the last one last.
    before: [Option<Way>; 2],
    smoothing: SmoothingTolerance,
    /// The blocks that gave the tolerances that were reported; none for that of the control's setting.
    told: BTreeSet<Option<At>>,
}

remembers!(ToleranceAboveFeature: smoothing, told);

/// A tolerance in effect.
struct Tolerance {
    mm: f64,
    /// The block that gave it.
    set: Option<At>,
    /// As messages name it.
    name: String,
    is_blending: bool,
}

/// Direction and length of a straight move in X, Y and Z.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Way {
    direction: [f64; 3],
    length: f64,
}

impl Way {
    fn new(from: &Position, to: &Position) -> Option<Self> {
        let ([from_x, from_y, from_z], [x, y, z]) = (from.xyz(), to.xyz());
        // An axis of which nothing is known does not move here.
        let part = |from: Mm, to: Mm| if from.0.is_nan() && to.0.is_nan() { 0.0 } else { to.0 - from.0 };
        let way = [part(from_x, x), part(from_y, y), part(from_z, z)];
        let [dx, dy, dz] = way;
        let length = dx.hypot(dy).hypot(dz);
        let direction = way.map(|part| part / length);
        (length.is_finite() && length > 0.0).then_some(Self { direction, length })
    }

    /// Does the path turn by 60 degrees or more into the next move?
    fn turns_into(&self, next: &Self) -> bool {
        let dot: f64 = self.direction.iter().zip(next.direction).map(|(a, b)| a * b).sum();
        dot <= 0.5 + 1e-9
    }
}

impl PathRule for ToleranceAboveFeature {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::sets_path_tolerance)
            || setting(program.environment.control())
                .is_some_and(|number| program.environment.machine.engine.settings.contains_key(number))
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.smoothing.changed(cx, event);
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let way = match event {
            Event::Travel(travel) if travel.kind == TravelKind::Feed && !travel.expanded => {
                Way::new(&travel.from, &travel.to)
            }
            _ => None,
        };
        let [first, step] = self.before;
        self.before = [step, way];
        let Some(tolerance) = self.tolerance(cx) else { return };
        let (size, what) = match (event, first, step, way) {
            (Event::Arc(arc), ..)
                if tolerance.is_blending && !arc.expanded && arc.sweep.abs() >= FRAC_PI_3 - 1e-9 =>
            {
                let (from, (one, other, _)) = (arc.from.values(), arc.plane.axes());
                let ends = from.get(one).zip(from.get(other));
                let Some((x, y)) = ends else { return };
                ((x - arc.centre.0.0).hypot(y - arc.centre.1.0), "the radius of this arc")
            }
            (_, Some(first), Some(step), Some(next))
                if first.turns_into(&step)
                    && step.turns_into(&next)
                    && first.length.min(next.length) > STEP * step.length
                    && step.length > NOISE * tolerance.mm =>
            {
                (step.length, "the step before this")
            }
            _ => return,
        };
        if size.is_nan() || size >= tolerance.mm * (1.0 - 1e-9) || !self.told.insert(tolerance.set) {
            return;
        }
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!(
                    "the tolerance of {} is larger than {} of {} ({})",
                    cx.shown(Mm(tolerance.mm)),
                    what,
                    cx.shown(Mm(size)),
                    tolerance.name
                ),
            )
            .label("the control may cut across it")
            .help("give a tolerance below the smallest feature");
        let here = cx.origin().at;
        report.add(match tolerance.set.filter(|set| *set != here).and_then(|set| cx.range_of(set)) {
            Some(range) => finding.also(range, format!("{} set here", tolerance.name)),
            None => finding,
        });
    }
}

/// The numbered setting that holds the tolerance while the program gives none.
fn setting(control: &Control) -> Option<&str> {
    match &control.motion().corners {
        CornerRules::Rounded { tolerance_setting, .. } => tolerance_setting.as_deref(),
        _ => None,
    }
}

impl ToleranceAboveFeature {
    fn tolerance(&self, cx: &PathCx<'_>) -> Option<Tolerance> {
        let Some(PathMode::Blending { tolerance, .. }) = cx.state().path_mode(cx.model) else { return None };
        if tolerance.0.is_nan() {
            return None;
        }
        if tolerance.0 > 0.0 {
            let set = cx.definitions().set_by(Fact::Mode(Role::PathControl));
            let name = format!("`{}`", cx.code_name(Role::PathControl).unwrap_or_default());
            return Some(Tolerance { mm: tolerance.0, set, name, is_blending: true });
        }
        if let Some((set, mm)) = self.smoothing.in_effect(cx) {
            let name = format!("`{} E`", cx.name_of_effect(Effect::Smoothing).unwrap_or_default());
            return (!mm.is_nan()).then_some(Tolerance { mm, set: Some(set), name, is_blending: false });
        }
        let number = setting(cx.control())?;
        let machine = &cx.environment.machine.engine;
        let value: f64 = machine.settings.get(number)?.parse().ok()?;
        // Whatever units the control is switched on with, a setting counts in those of the machine.
        let units = machine.units.or_else(|| cx.model.units_at_power_on(&machine.settings))?;
        let mm = value * units.in_mm();
        (mm > 0.0).then(|| Tolerance { mm, set: None, name: format!("setting {number}"), is_blending: false })
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn the_setting_counts_where_the_program_gives_nothing() {
        let mut world = World::default();
        world.machine.engine.settings.insert("85".to_owned(), "0.5".to_owned());
        world.machine.engine.units = Some(gcheck_engine::Units::Mm);
        check_rule_in(
            &RULE,
            "haas-mill",
            "G21 G90 G0 X0. Y0.\nG1 X10. F500.\nY0.3\nX20.\nG187 E0.01\nY.6\nX30.\nG187\nG3 X30.2 Y.8 J.2\nM30\n",
            &world,
            &expect![[r#"
                4 | X20.
                  | ^^^^ info[tolerance-above-feature] the tolerance of 0.5 mm is larger than the step before this of 0.3 mm (setting 85)
            "#]],
        );
    }

    #[test]
    fn a_level_keeps_the_tolerance_and_exact_stop_needs_none() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G187 E0.5\nG187 P3\nG0 X0. Y0.\nG61 G1 X10. F500.\nY0.3\nX20.\nG64 Y.6\nX30.\nM30\n",
            &expect![[r#"
                8 | X30.
                  | ^^^^ info[tolerance-above-feature] the tolerance of 0.5 mm is larger than the step before this of 0.3 mm (`G187 E`)
            "#]],
        );
    }

    #[test]
    fn a_step_between_two_corners() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G64 P0.5\nG0 X0 Y0\nG1 X10 F500\nY0.3\nX20\nY0.6\nX30\nM2\n",
            &expect![[r#"
                5 | X20
                  | ^^^ info[tolerance-above-feature] the tolerance of 0.5 mm is larger than the step before this of 0.3 mm (`G64`)
            "#]],
        );
    }

    #[test]
    fn segments_of_a_curve_are_no_steps() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G64 P0.5\nG0 X0 Y0\nG1 X0.3 F500\nX0.6 Y0.1\nX0.9 Y0.3\nX1.1 Y0.6\nM2\n",
            &expect![[""]],
        );
    }
}
