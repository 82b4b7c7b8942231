//! Cutter compensation whose size is half of the tool's, or twice.

use gcheck_controls::Effect;
use gcheck_engine::Units;
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::tool_comment::{ToolComment, comment_at_work};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A code of cutter compensation takes the diameter of the cutter (`G41.1 D`), and the number is half of the diameter that the tool's
    /// comment names, or twice.
    ///
    /// ## Why it matters
    /// With half of the diameter each side is off by a quarter of the cutter, with twice the diameter by half of it. Other codes take the number
    /// of an offset or of a tool, and some controls count offsets as radii.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// (T1 8 mm END MILL)
    /// G21 G90 G54 T1 M6
    /// G43 H1 S3000 M3
    /// G0 X-20 Y-20 Z-2
    /// G41.1 D4 G1 X0 Y-10 F300
    /// Y40
    /// G40 X-20
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// (T1 8 mm END MILL)
    /// G21 G90 G54 T1 M6
    /// G43 H1 S3000 M3
    /// G0 X-20 Y-20 Z-2
    /// G41.1 D8 G1 X0 Y-10 F300
    /// Y40
    /// G40 X-20
    /// M2
    /// ```
    rule "radius-given-for-diameter" in "compensation" {
        summary: "cutter compensation by half of the tool's diameter, or twice",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(RadiusGivenForDiameter) },
    }
}

struct RadiusGivenForDiameter;

/// What a size that was rounded may be off, as a part of it.
const ROUNDED: f64 = 0.01;
/// Tools that do not cut with the diameter that names them.
const OTHER_SHAPES: [&str; 14] = [
    "CHAMFER",
    "CHAMFERING",
    "V",
    "VBIT",
    "SPOT",
    "SPOTTING",
    "BALL",
    "BALLNOSE",
    "T",
    "TSLOT",
    "NECK",
    "DOVETAIL",
    "TAPER",
    "TAPERED",
];

impl PathRule for RadiusGivenForDiameter {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(takes_diameter)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(takes_diameter) || cx.is_malformed() {
            return;
        }
        let units = cx.state().units(cx.model);
        let Some(given) = cx.known_number('D').zip(units).map(|(d, units): (f64, Units)| d * units.in_mm())
        else {
            return;
        };
        let Some(comment) = comment_at_work(cx).filter(|comment| !has_other_size(comment)) else { return };
        let Some(Mm(named)) = comment.size(units) else { return };
        let is = |part: f64| (given / named - part).abs() < part * ROUNDED;
        let other = match (is(0.5), is(2.0)) {
            (true, _) => "half of",
            (_, true) => "twice",
            _ => return,
        };
        report.add(
            cx.finding(
                &META,
                cx.letter_range('D'),
                format!("the compensation is for {other} the tool's diameter"),
            )
            .label(format!("{}; the tool's comment names {}", cx.shown(Mm(given)), cx.shown(Mm(named))))
            .help("`D` takes the diameter of the cutter here: check it, or correct the comment"),
        );
    }
}

/// Is the size of the comment not the diameter that cuts?
fn has_other_size(comment: &ToolComment) -> bool {
    // `3 mm FLUTE` is a length, `4 FLUTE` counts.
    let is_length = |pair: &[String]| match pair {
        [unit, flute] => matches!(unit.as_str(), "MM" | "IN" | "INCH") && flute == "FLUTE",
        _ => false,
    };
    comment.has(&OTHER_SHAPES) || comment.words.windows(2).any(is_length)
}

fn takes_diameter(effect: Effect) -> bool {
    matches!(effect, Effect::CompensationLeftByDiameter | Effect::CompensationRightByDiameter)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn plate(d: &str) -> String {
        format!(
            "; T1 8 mm end mill, T2 spot drill\nG21 G90 G54 T1 M6\nG43 H1 S3000 M3\nG0 X-20 Y-20 Z-2\nG42.1 D{d} G1 X0 Y-10 F300\nY40\nG40 X-20\nM2\n"
        )
    }

    #[test]
    fn another_size_may_be_wear() {
        check_rule(
            &RULE,
            "linuxcnc",
            &plate("4"),
            &expect![[r#"
            5 | G42.1 D4 G1 X0 Y-10 F300
              |       ^^ warning[radius-given-for-diameter] the compensation is for half of the tool's diameter
        "#]],
        );
        check_rule(&RULE, "linuxcnc", &plate("7.9"), &expect![[""]]);
    }

    #[test]
    fn sizes_that_are_not_what_cuts() {
        for comment in ["10 mm CHAMFER MILL", "10 mm V-BIT", "10 mm SPOT DRILL", "BALL END MILL 10 mm"] {
            let program = format!(
                "(T1 {comment})\nG21 G90 G54 T1 M6\nG43 H1 S3000 M3\nG0 X-20 Y-20 Z-2\nG41.1 D5 G1 X0 Y-10 F300\nY40\nG40 X-20\nM2\n"
            );
            check_rule(&RULE, "linuxcnc", &program, &expect![[""]]);
        }
    }
}
