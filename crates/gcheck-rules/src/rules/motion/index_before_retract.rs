//! A rotary axis that is indexed while the tool is in its cut.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Axis, Event, Position, Role, Travel};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::depth::Depth;
use crate::facts::tool_comment::{HEAD, comments_in};
use crate::{Finding, MakeShared, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A rapid move turns a rotary axis of a mill, and nothing else, while the tool is still where its last cut ended. So does one with the
    /// tool 5 mm or less above the face that it cut, if the next cut counts from another work offset: then each side of the part has its
    /// own zero. A block that chooses that offset and turns the axis at once (`G0 G55 X0 B90.`) is judged in the same way.
    ///
    /// Where comments tell that the part is round (`SHAFT`, `BAR`), its edges are not nearer than its faces: only a tool in its cut on
    /// the centre line is reported.
    ///
    /// Moves at feed are not looked at, nor those that take the tool sideways too, nor those while the control follows the
    /// tool's tip or a drawing is wrapped around the axis.
    ///
    /// ## Why it matters
    /// The part turns with its edges past the tool, or into it: the tool breaks, or leaves a mark. A retract is missing
    /// before the axis is indexed.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T2 M6
    /// G20 G90 G54 G0 X0. Y0. A0. S600 M3
    /// G43 H2 Z1.1
    /// G1 Z.8 F20.
    /// X2.
    /// G0 A90.
    /// G1 X0.
    /// G0 Z2.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T2 M6
    /// G20 G90 G54 G0 X0. Y0. A0. S600 M3
    /// G43 H2 Z1.1
    /// G1 Z.8 F20.
    /// X2.
    /// G0 Z1.1
    /// A90.
    /// G1 Z.8
    /// X0.
    /// G0 Z2.
    /// M30
    /// ```
    rule "index-before-retract" in "motion" {
        summary: "rotary axis indexed while the tool is in its cut",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::RAPIDS.union(Watch::CHANGES).union(Watch::CUTS).union(Watch::BLOCKS),
            make: || Box::new(IndexBeforeRetract::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct IndexBeforeRetract {
    /// The block that was reported: a loop repeats it.
    told: Option<At>,
    /// The work offset in which the tool has cut below the zero since it came.
    cut_in: Option<u16>,
    /// An axis was turned with the tool close above the face.
    close: Option<Close>,
}

remembers!(IndexBeforeRetract: told, close);

/// A turn of the part with the tool close above the face that it cut.
#[derive(Clone, PartialEq)]
struct Close {
    work: u16,
    at: At,
    finding: Finding,
}

remembers!(Close: at, finding);

/// So close above a face its edges meet the tool when the part turns: millimetres.
const CLOSE: f64 = 5.0;
/// Work offsets with a code of their own.
const COUNTED: u16 = 6;
/// Places that are nearer than this are one: millimetres.
const NEAR: f64 = 0.01;
/// An axis that turns by less than this corrects a part, or follows a contour: degrees.
const TURN: f64 = 20.0;

const ROTARY: LetterSet = LetterSet::of("ABC");

impl PathRule for IndexBeforeRetract {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Depth::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().machine() == gcheck_controls::Machine::Mill
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if let Some(finding) = self.with_offset(cx) {
            self.told = Some(cx.origin().at);
            report.add(finding);
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        let end = match event {
            Event::Travel(travel) => travel.to.get(Axis::Z),
            Event::Arc(arc) => arc.to.get(Axis::Z),
            _ => None,
        };
        self.close = None;
        self.cut_in = cx.state().work().filter(|_| end.is_some_and(|z| z < 0.0));
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        match event {
            Event::ToolChange(_) | Event::Shift(_) => (self.close, self.cut_in) = (None, None),
            Event::WorkOffset { .. } => {
                let close = self.close.take();
                if let Some(Close { work, at, finding }) = close
                    && cx.state().work().is_some_and(|other| other != work)
                {
                    self.told = Some(at);
                    report.add(finding.also(cx.range(), "the next side of the part has a zero of its own"));
                }
            }
            _ => {}
        }
    }

    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        // Beside the place of its last cut the tool is out of the way.
        let goes = |axis: &Axis| (travel.to.raw(*axis) - travel.from.raw(*axis)).abs() > NEAR;
        if !travel.expanded && [Axis::X, Axis::Y].iter().any(goes) {
            self.cut_in = None;
        }
        if !cx.origin().letters.intersects(ROTARY) || !turns_in_place(cx, travel) || !cx.is_on_every_path() {
            return;
        }
        let is_plain = cx.state().cylinder().is_none() && !follows_the_tool(cx);
        let Some(z) = travel.from.get(Axis::Z).filter(|_| is_plain) else { return };
        let Some(cut) = cx.shared::<Depth>().and_then(|depth| depth.last_cut(z)) else {
            self.close_above(cx, travel, z);
            return;
        };
        if self.told.replace(cx.origin().at) == Some(cx.origin().at) {
            return;
        }
        if is_round(cx) && !is_central(cx, &travel.from) {
            return;
        }
        report.add(in_cut(cx, z, cut));
    }
}

/// The part turns with the tool where its last cut ended.
fn in_cut(cx: &PathCx<'_>, z: f64, cut: At) -> Finding {
    let finding = cx
        .finding(&META, rotary_range(cx), "the part is turned at rapid while the tool is in its cut")
        .label(format!("the tool stays at Z {}, the level of its last cut", cx.shown(Mm(z))));
    let finding = match cx.range_of(cut) {
        Some(range) => finding.also(range, "the tool's last cut"),
        None => finding,
    };
    finding
        .assuming("the tool has not left the part sideways")
        .help("retract the tool before the axis turns, and feed it down again after that")
}

/// The part turns with the tool close above what it cut.
fn close(cx: &PathCx<'_>, z: f64) -> Finding {
    cx.finding(&META, rotary_range(cx), "the part is turned at rapid with the tool close above its face")
        .label(format!("the tool stays {} above the face that it cut", cx.shown(Mm(z))))
        .assuming("the part is not round")
        .help("retract the tool before the axis turns: the edges of the part come nearer than its faces")
}

fn rotary_range(cx: &PathCx<'_>) -> std::ops::Range<u32> {
    cx.word_range(|word| !word.letter.is_corner() && ROTARY.contains(word.letter))
}

/// Is the tool on the centre line of the axis that the block turns? There every side of a bar is as near.
fn is_central(cx: &PathCx<'_>, at: &Position) -> bool {
    let across = [(Axis::A, Axis::Y), (Axis::B, Axis::X)];
    across
        .into_iter()
        .any(|(rotary, axis)| cx.origin().letters.contains(rotary.letter()) && at.raw(axis).abs() < NEAR)
}

/// Does a comment at the head of the program tell that the part is round?
fn is_round(cx: &PathCx<'_>) -> bool {
    const ROUND: [&str; 14] = [
        "AXLE", "BAR", "CYLINDER", "PIPE", "ROD", "ROLLER", "ROUND", "RUND", "SHAFT", "SHAFTS", "SLEEVE",
        "TUBE", "TUBING", "WELLE",
    ];
    // What a tool is called says nothing of the part: `BORING BAR`, `ROUND INSERT`.
    const TOOLS: [&str; 9] =
        ["BORE", "BORING", "BULL", "CORNER", "INSERT", "NOSE", "PULLER", "SHANK", "SQUARE"];
    let is = |comment: String| {
        let comment = comment.to_ascii_uppercase();
        let has = |names: &[&str]| {
            comment.split(|c: char| !c.is_ascii_alphanumeric()).any(|word| names.contains(&word))
        };
        let is_mill = has(&["END", "BALL", "FACE"]) && has(&["MILL"]);
        has(&ROUND) && !has(&TOOLS) && !is_mill
    };
    (0..HEAD).filter_map(|block| comments_in(cx, At { file: 0, block })).any(is)
}

impl IndexBeforeRetract {
    /// The part turns with the tool above its last cut.
    fn close_above(&mut self, cx: &PathCx<'_>, travel: &Travel, z: f64) {
        let by_much = [Axis::A, Axis::B, Axis::C].into_iter().any(|axis| {
            let way = (travel.from.raw(axis) - travel.to.raw(axis)).abs();
            cx.origin().letters.contains(axis.letter()) && (way.is_nan() || way > TURN)
        });
        if is_central(cx, &travel.from) || is_round(cx) {
            return;
        }
        let Some(work) = cx.state().work().filter(|work| self.cut_in == Some(*work)) else { return };
        let at = cx.origin().at;
        if !(0.0..=CLOSE).contains(&z) || !by_much || self.told == Some(at) {
            return;
        }
        let finding = close(cx, z);
        self.close = Some(Close { work, at, finding });
    }
}

impl IndexBeforeRetract {
    /// A block that turns the part and chooses the work offset of its next side, with the tool where it has cut. The state is that before
    /// the block: after it, the place of the tool counts from another zero.
    fn with_offset(&self, cx: &PathCx<'_>) -> Option<Finding> {
        let letters = cx.origin().letters;
        let chooses = |effect| matches!(effect, Effect::WorkOffset(_) | Effect::WorkOffsetByP(_));
        let work = cx.state().work()?;
        // Of the many that `P` counts, the one in effect may be named again.
        let is_other = |effect: Effect| match effect {
            Effect::WorkOffset(number) => number != work,
            _ => chooses(effect) && work <= COUNTED,
        };
        // What else the block does may lift the tool.
        let only_moves = |effect: Effect| {
            chooses(effect)
                || effect.starts_spindle()
                || effect.switches_coolant()
                || matches!(effect, Effect::None | Effect::Rapid | Effect::Absolute | Effect::CycleCancel)
        };
        if !letters.intersects(ROTARY)
            || letters.intersects(LetterSet::of("ZUVW"))
            || !cx.has_effect(is_other)
            || cx.codes().iter().any(|code| !only_moves(cx.model.effect(*code)))
            || !cx.is_on_every_path()
        {
            return None;
        }
        let state = cx.state();
        let is_rapid = cx.has_effect(|effect| effect == Effect::Rapid)
            || state.effect(Role::Motion, cx.model) == Some(Effect::Rapid);
        let is_plain = state.cylinder().is_none()
            && !follows_the_tool(cx)
            && (state.is_incremental(cx.model) == Some(false)
                || cx.has_effect(|effect| effect == Effect::Absolute));
        let at = state.position();
        let turns = [Axis::A, Axis::B, Axis::C].into_iter().any(|axis| {
            let to = letters.contains(axis.letter()).then(|| cx.known_number(axis.name())).flatten();
            to.zip(at.get(axis)).is_some_and(|(to, from)| (to - from).abs() > TURN)
        });
        let is_central = is_central(cx, at);
        if !is_rapid || !is_plain || !turns || !is_central && is_round(cx) {
            return None;
        }
        let z = at.get(Axis::Z)?;
        let next = cx.effect_range(chooses);
        if let Some(cut) = cx.shared::<Depth>().and_then(|depth| depth.last_cut(z)) {
            return Some(in_cut(cx, z, cut));
        }
        let has_cut = self.cut_in == Some(work);
        (has_cut && !is_central && (0.0..=CLOSE).contains(&z))
            .then(|| close(cx, z).also(next, "the next side of the part has a zero of its own"))
    }
}

/// Does a rotary axis that the block names turn while the tool stays?
fn turns_in_place(cx: &PathCx<'_>, travel: &Travel) -> bool {
    let differs = |axis: Axis| {
        let (from, to) = (travel.from.raw(axis), travel.to.raw(axis));
        to.is_nan() || from.is_nan() || (from - to).abs() > 0.001
    };
    let stays = ![Axis::X, Axis::Y, Axis::Z].into_iter().any(differs);
    let named = |axis: &Axis| cx.origin().letters.contains(axis.letter());
    stays && [Axis::A, Axis::B, Axis::C].into_iter().filter(named).any(differs)
}

/// Does the control move the linear axes with the rotary ones?
fn follows_the_tool(cx: &PathCx<'_>) -> bool {
    let state = cx.state();
    let length = state.effect(Role::Length, cx.model);
    length.is_none_or(|effect| matches!(effect, Effect::LengthFiveAxis | Effect::ToolCentrePoint))
        || state.effect(Role::DynamicOffset, cx.model) == Some(Effect::DynamicOffsetOn)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(after: &str) -> String {
        format!(
            "T1 M6\nG21 G90 G54 G0 X0. Y0. A0. S4000 M3\nG43 H1 Z50.\nZ22.\nG1 Z18. F200.\nX50.\n{after}\nG0 Z50.\nM30\n"
        )
    }

    #[test]
    fn close_above_a_face_with_a_zero_of_its_own() {
        let tombstone = |between: &str| {
            format!(
                "T3 M6\nG20 G90 G54 G0 X0. Y0. B0. S4000 M3\nG43 H3 Z5.\nG99 G81 X1. Y1. Z-.5 R.1 F12.\nX2.\nG80\n{between}Z5.\nG99 G81 X1. Y1. Z-.5 R.1 F12.\nG80\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &tombstone("B90.\nG55 X0. Y0.\n"),
            &expect![[r#"
                7 | B90.
                  | ^^^^ warning[index-before-retract] the part is turned at rapid with the tool close above its face
            "#]],
        );
        for between in [
            "G0 Z5.\nB90.\nG55 X0. Y0.\n",
            "G53 Z0.\nB90.\nG55 X0. Y0.\n",
            // One zero for all sides: that of the axis, around which a bar may turn.
            "B90.\nG54 X0. Y0.\n",
            "B2.\nG55 X0. Y0.\n",
            "G0 Z5.\nG0 G55 X0. B90.\n",
            "G53 Z0.\nG0 G55 B90.\n",
            "G28 G91 Z0.\nG90 G0 G55 B90.\n",
            "G0 G55 B90. Z5.\n",
            "G0 G55 B2.\n",
            "G0 G54 B90.\nG54 X0.\n",
            "G0 X12.\nG0 G55 B90.\n",
            // Beside the part.
            "G0 X12.\nB90.\nG55 X0. Y0.\n",
        ] {
            check_rule(&RULE, "haas-mill", &tombstone(between), &expect![[""]]);
        }
    }

    #[test]
    fn the_next_offset_in_the_block_of_the_turn() {
        let tombstone = |head: &str, x: &str, turn: &str| {
            format!(
                "O1\n{head}T3 M6\nG20 G90 G54 G0 X0. Y0. B0. S4000 M3\nG43 H3 Z5.\nG99 G81 X{x} Y1. Z-.5 R.1 F12.\nG80\n{turn}\nG43 H3 Z5.\nG99 G81 X1. Y1. Z-.5 R.1 F12.\nG80\nM30\n"
            )
        };
        for turn in [
            "G0 G55 B90.",
            "G0 G90 G55 X0. B90. S900 M3",
            "G0 G90 G55 X0. B90.",
            "G55 B90. X0. Y0.",
            "G0 G154 P3 B180.",
        ] {
            let found = crate::testing::findings(
                &crate::testing::only(&RULE),
                "haas-mill",
                &tombstone("", "1.", turn),
                &crate::testing::World::default(),
            );
            assert_eq!(found.len(), 1, "{turn}: {found:#?}");
        }
        check_rule(
            &RULE,
            "fanuc-mill",
            &tombstone("", "1.", "G0 G55 B90."),
            &expect![[r#"
                7 | G0 G55 B90.
                  |        ^^^^ warning[index-before-retract] the part is turned at rapid with the tool close above its face
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G0 G55 A90."),
            &expect![[r#"
            7 | G0 G55 A90.
              |        ^^^^ warning[index-before-retract] the part is turned at rapid while the tool is in its cut
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G0 G55 A90.").replace("Y0. A0.", "Y9. A0."),
            &expect![[r#"
                7 | G0 G55 A90.
                  |        ^^^^ warning[index-before-retract] the part is turned at rapid while the tool is in its cut
            "#]],
        );
        // On the centre of the table, and a shaft.
        check_rule(&RULE, "haas-mill", &tombstone("", "0.", "G0 G55 B90."), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &tombstone("(KEYED SHAFT)\n", "1.", "G0 G55 B90."), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &tombstone("(2.0 ROUND BAR)\n", "1.", "B90.\nG55 X0."),
            &expect![[""]],
        );
    }

    #[test]
    fn a_round_part_beside_the_tool() {
        let shaft = |comment: &str, y: &str| {
            format!("O1 ({comment})\n{}", program("G0 A90.").replace("Y0. A0.", &format!("Y{y} A0.")))
        };
        check_rule(&RULE, "fanuc-mill", &shaft("FLATS ON SHAFT", "30."), &expect![[""]]);
        for (comment, y) in [("FLATS ON SHAFT", "0."), ("BLOCK", "30."), ("BORING BAR 12", "30.")] {
            let found = crate::testing::findings(
                &crate::testing::only(&RULE),
                "fanuc-mill",
                &shaft(comment, y),
                &crate::testing::World::default(),
            );
            assert_eq!(found.len(), 1, "{comment} {y}");
        }
    }

    #[test]
    fn the_rotary_word_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G0 A90."),
            &expect![[r#"
            7 | G0 A90.
              |    ^^^^ warning[index-before-retract] the part is turned at rapid while the tool is in its cut
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G91 G0 A90."),
            &expect![[r#"
            7 | G91 G0 A90.
              |        ^^^^ warning[index-before-retract] the part is turned at rapid while the tool is in its cut
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("#1=90.\nG0 A#1"),
            &expect![[r#"
            8 | G0 A#1
              |    ^^^ warning[index-before-retract] the part is turned at rapid while the tool is in its cut
        "#]],
        );
    }

    #[test]
    fn lifted_or_moved_away_it_is_fine() {
        check_rule(&RULE, "fanuc-mill", &program("G0 Z22.\nA90."), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("G0 Z30. A90."), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("G0 X80.\nA90."), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("G91 G28 Z0\nG90 G0 A90."), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("G0 X80. A90."), &expect![[""]]);
        // The same angle again.
        check_rule(&RULE, "fanuc-mill", &program("G0 A0."), &expect![[""]]);
    }

    #[test]
    fn turned_at_feed_it_is_a_cut() {
        check_rule(&RULE, "fanuc-mill", &program("G1 A90."), &expect![[""]]);
    }

    #[test]
    fn each_side_of_a_loop_is_told_once() {
        let hex = "#1=0\nWHILE [#1 LT 6] DO1\nG0 A[#1*60]\nG1 Z18. F200.\nX0.\nX50.\n#1=#1+1\nEND1";
        check_rule(
            &RULE,
            "fanuc-mill",
            &program(hex),
            &expect![[r#"
            9 | G0 A[#1*60]
              |    ^^^^^^^^ warning[index-before-retract] the part is turned at rapid while the tool is in its cut
        "#]],
        );
    }
}
