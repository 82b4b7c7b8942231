//! A rapid move below the zero of the part that has a feed.

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_engine::{Abstract, Axis, Domain, Event, FeedMode, Role, Travel, TravelKind};
use gcheck_geometry::Mm;
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A block with a feed (`F`) moves at rapid down to below the zero of the part, or sideways there.
    ///
    /// A feed in the block shows that the tool should cut. Above the part there is no finding: some programs give the
    /// feed of the next cut early. A block whose end is where the tool already is moves nothing, and is not reported.
    ///
    /// ## Why it matters
    /// At rapid the feed has no effect, and the tool runs into the part at full speed. `G0` was written instead of
    /// `G1`, or the `G0` of an earlier block is still active.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X10. Y10.
    /// G43 H1 Z2.
    /// Z-5. F100.
    /// G1 X40.
    /// G0 Z5.
    /// M30
    /// ```
    /// Under inverse time a feed is for its own block, at every height.
    /// ```nc,reported,linuxcnc
    /// G21 G90 G94 G0 X0 Y0 Z50
    /// G93 X10 Z45 F30
    /// G1 X20 Z44 F30
    /// G94
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X10. Y10.
    /// G43 H1 Z2. F100.
    /// G1 Z-5.
    /// X40.
    /// G0 Z5. F900.
    /// M30
    /// ```
    rule "rapid-with-feed" in "motion" {
        summary: "rapid move in the part, or under inverse time, has a feed",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::RAPIDS, make: || Box::new(RapidWithFeed) },
    }
}

struct RapidWithFeed;

/// Millimetres: heights that differ by less are one, and the surface is this thick.
const LEVEL: f64 = 0.01;
/// Millimetres per minute: with this and more, a CAM system means "as fast as possible": `F9991300.`.
const NO_CUT: f64 = 100_000.0;

impl PathRule for RapidWithFeed {
    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let letters = cx.origin().letters;
        if !letters.contains(Letter::of('F')) {
            cx.rest();
            return;
        }
        if !letters.intersects(LetterSet::of("XYZ")) {
            return;
        }
        let Event::Travel(travel) = event else { return };
        let is_plain = travel.kind == TravelKind::Rapid
            && !travel.expanded
            && cx.state().effect(Role::Motion, cx.model) == Some(Effect::Rapid);
        let (from, to) = (travel.from.raw(Axis::Z), travel.to.raw(Axis::Z));
        // An unknown height is NaN, and not below anything. A move up and out of the part is not a cut.
        let is_below = to < -LEVEL && to < from + LEVEL;
        // There each cut has a feed of its own, and nothing that follows takes it over.
        // A block that says `G0` means it.
        let is_inverse = cx.state().feed_mode(cx.model) == Some(FeedMode::InverseTime)
            && !cx.has_effect(|effect| effect == Effect::Rapid);
        let is_still = [Axis::X, Axis::Y, Axis::Z].iter().all(|axis| stays(travel, *axis));
        if !cx.is_mill()
            || !is_plain
            || !is_below && !is_inverse
            || is_still
            || cx.has_effect(Effect::goes_to_machine_place)
            || has_unknown_code(cx)
        {
            return;
        }
        if Abstract::known(cx.state().feed()).is_some_and(|feed| feed >= NO_CUT) {
            return;
        }
        let (message, label) = if is_inverse {
            let name = cx.code_name(Role::FeedMode).unwrap_or_default();
            (
                format!("rapid move has an inverse time feed (`F` under `{name}`)"),
                "has no effect at rapid, and the control does not keep it for the next block".to_owned(),
            )
        } else {
            let depth = cx.shown(Mm(-to));
            (
                "rapid move below the zero of the part has a feed (`F`)".to_owned(),
                format!("has no effect at rapid, {depth} below the zero of the part"),
            )
        };
        report.add(cx.finding(&META, cx.letter_range('F'), message).label(label).help(if is_inverse {
            "write `G1` if the block should cut; else leave the feed out"
        } else {
            "write `G1` if the block should cut; else give the feed with the first cut"
        }));
    }
}

/// Is the end of the move where the axis already is? An axis of unknown position stays where the block has no word of it.
fn stays(travel: &Travel, axis: Axis) -> bool {
    let (from, to) = (travel.from.raw(axis), travel.to.raw(axis));
    (to - from).abs() <= LEVEL || to.to_bits() == from.to_bits()
}

/// A code that the control does not have may be a move on the control that the program is for.
fn has_unknown_code(cx: &PathCx<'_>) -> bool {
    let is_unknown = |word: &Word| matches!(word.letter.ascii(), b'G' | b'M') && !word.code.is_some();
    cx.find_word(cx.origin().at, is_unknown).is_some()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn down_and_along() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G54 G0 X0 Y0 Z5 F90\nZ-2 F80\nX10 F300\nG1 X20\nG0 Z5 F900\nM2\n",
            &expect![[r#"
                2 | Z-2 F80
                  |     ^^^ warning[rapid-with-feed] rapid move below the zero of the part has a feed (`F`)
                3 | X10 F300
                  |     ^^^^ warning[rapid-with-feed] rapid move below the zero of the part has a feed (`F`)
            "#]],
        );
    }

    #[test]
    fn a_block_that_moves_nothing_gives_the_feed_of_the_next_cut() {
        let program = |again: &str| {
            format!(
                "G21 G90 G54 G0 X0. Y0. Z5.\nG1 Z-2. F90.\nX20.\nG0 X30. Y-5.\n{again} F60.\nG1 Y5.\nG0 Z5.\nM30\n"
            )
        };
        check_rule(&RULE, "fanuc-mill", &program("Z-2."), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("X30. Z-2."), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("Z-3."),
            &expect![[r#"
                5 | Z-3. F60.
                  |      ^^^^ warning[rapid-with-feed] rapid move below the zero of the part has a feed (`F`)
            "#]],
        );
    }

    #[test]
    fn the_rapid_moves_of_a_cycle_have_its_feed_by_right() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G54 G0 X0. Y0. Z5.\nG83 X5. Z-20. R-2. Q5. F90.\nG80\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn inverse_time_is_for_the_block_that_has_it() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G54 G94 G0 X0 Y0 Z50\nG93 X10 Z45 F30\nG1 X20 Z44 F30\nG94 G0 Z50\nM2\n",
            &expect![[r#"
                2 | G93 X10 Z45 F30
                  |             ^^^ warning[rapid-with-feed] rapid move has an inverse time feed (`F` under `G93`)
            "#]],
        );
    }

    #[test]
    fn a_feed_without_measure_is_none() {
        check_rule(&RULE, "linuxcnc", "G21 G90 G54 G0 X0 Y0 Z5\nZ-12 F9991300\nM2\n", &expect![[""]]);
    }

    #[test]
    fn ways_of_the_machine_are_not_judged() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G54 G0 X0. Y0. Z5.\nG53 Z-20. F90.\nG91 G28 Z-1. F90.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_code_of_another_control_may_be_the_move() {
        check_rule(&RULE, "linuxcnc", "G21 G90 G54 G0 X0 Y0 Z5\nG31 Z-20 F90\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_depth_that_nobody_knows_is_not_judged() {
        check_rule(&RULE, "fanuc-mill", "G21 G90 G54 G0 X0. Y0. Z5.\nZ#100 F90.\nM30\n", &expect![[""]]);
    }
}
