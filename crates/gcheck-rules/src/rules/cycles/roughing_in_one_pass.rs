//! A roughing cycle of a lathe that takes very much in one pass.

use gcheck_controls::Effect;
use gcheck_engine::{At, Axis, Event, Travel, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::turning::{is_turned, turns_the_part};
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A pass of a roughing cycle along Z is more than 8 mm (0.315 inch) deep, measured on the radius. Passes in a bore are not judged.
    ///
    /// ## Why it matters
    /// Such a cut pulls the part out of the chuck or breaks the tool. Mostly the depth of cut has a zero too few or too many, or is given
    /// in least increments where the control takes lengths.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G18 G99 T101
    /// G97 S500 M3
    /// G0 X2.1 Z0.1
    /// G71 P100 Q200 U0.02 W0.005 D0.8 F0.012
    /// N100 G0 X1.3
    /// G1 Z-1.
    /// N200 X2.1
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G18 G99 T101
    /// G97 S500 M3
    /// G0 X2.1 Z0.1
    /// G71 P100 Q200 U0.02 W0.005 D0.08 F0.012
    /// N100 G0 X1.3
    /// G1 Z-1.
    /// N200 X2.1
    /// M30
    /// ```
    rule "roughing-in-one-pass" in "cycles" {
        summary: "pass of a roughing cycle that is very deep",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(RoughingInOnePass::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RoughingInOnePass {
    /// The block of the cycle, and the smallest radius that it has cut to.
    pass: Option<(At, f64)>,
    told: Option<At>,
}

remembers!(RoughingInOnePass: pass, told);

/// Passes that are deeper are reported: millimetres, of the radius.
const DEEP: f64 = 8.0;
/// Radii that differ by less are one: millimetres.
const SLACK: f64 = 0.01;

impl PathRule for RoughingInOnePass {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program) && program.may(roughs_along_z)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        let at = cx.origin().at;
        if !travel.expanded || !cx.has_effect(roughs_along_z) || !turns_the_part(cx) {
            return;
        }
        let [from, to] = [&travel.from, &travel.to].map(|place| place.raw(Axis::X));
        let before = self.pass.filter(|(of, _)| *of == at).map_or(from, |(_, radius)| radius);
        let (is_pass, depth) = (is_pass(travel), before - to);
        self.pass = Some((at, if is_pass { before.min(to) } else { before }));
        if !is_pass || depth.is_nan() || depth <= DEEP || self.told == Some(at) {
            return;
        }
        self.told = Some(at);
        report.add(
            cx.finding(
                &META,
                cx.effect_range(roughs_along_z),
                format!("a pass of the roughing is {} deep", cx.shown(Mm(depth))),
            )
            .label("on the radius, in one pass")
            .help("check the depth of cut: its point, and whether it counts on the radius"),
        );
    }
}

fn roughs_along_z(effect: Effect) -> bool {
    effect == Effect::RoughAlongZ
}

/// Does it cut along Z, at one radius?
fn is_pass(travel: &Travel) -> bool {
    let [from, to] = [&travel.from, &travel.to].map(|place| [place.raw(Axis::X), place.raw(Axis::Z)]);
    travel.kind == TravelKind::Feed && (from[0] - to[0]).abs() < SLACK && (from[1] - to[1]).abs() > SLACK
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn bushing(depth: &str) -> String {
        format!(
            "G20 G18 G40 G80 G99\nT0101\nG97 S1200 M3\nG0 G54 X2.1 Z0.1\nG71 P100 Q200 U0.02 W0.005 {depth} F0.012\nN100 G0 X1.3\nG1 Z0. F0.006\nX1.5 Z-0.1\nZ-1.\nX1.75\nG3 X2. Z-1.125 R0.125\nG1 Z-1.6\nN200 X2.1\nG0 X6. Z6.\nM30\n"
        )
    }

    #[test]
    fn the_cycle_is_marked() {
        check_rule(&RULE, "haas-lathe", &bushing("D0.08"), &expect![""]);
        check_rule(
            &RULE,
            "haas-lathe",
            &bushing("D0.8"),
            &expect![[r#"
            5 | G71 P100 Q200 U0.02 W0.005 D0.8 F0.012
              | ^^^ warning[roughing-in-one-pass] a pass of the roughing is 0.39 in deep
        "#]],
        );
    }
}
