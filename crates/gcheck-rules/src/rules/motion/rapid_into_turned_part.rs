//! A rapid move of a lathe through an outside surface that the program has turned.

use std::ops::Range;

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Event, Role};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::tool_words::ToolWords;
use crate::facts::turned::{Cut, SLACK, Spot, Turned, end, is_level};
use crate::facts::turning::{is_turned, shown_radius};
use crate::{Finding, MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A tool of a lathe moves inwards at rapid, through the outside of the part as the program has turned it, to where
    /// nothing was cut.
    ///
    /// A cut counts as the outside of the part if a roughing cycle or a turning pass begins farther from the centre, or
    /// if the tool comes to it inwards, in a move in X beside the part. Where there is a hole, nothing is taken for the
    /// outside by its approach alone.
    ///
    /// Moves along Z into a shoulder are reported too: from outside of what is turned before it, or so near the outside that no bore
    /// leaves as little.
    ///
    /// So is one that goes on at rapid where a cut along Z has ended, at the same diameter, while the part is wider there; and a turning
    /// cycle whose first pass goes at rapid into a faced part, below its face. A threading pass (`G92`) that begins on a turned
    /// diameter, and not in front of it or in a neck, goes at rapid into the part too.
    ///
    /// A part that was faced to its centre is solid, as far as no hole was made. A retract that goes out of the part and inwards at
    /// once is reported too where it ends under an outside surface that it passes: axes that leave together need not arrive
    /// together.
    ///
    /// ## Why it matters
    /// The tool is driven into the part at rapid. Mostly the sign of a retract (`U`) is wrong, or `G0` was written instead
    /// of `G1`.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0101
    /// G97 S900 M3
    /// G0 X52. Z2.
    /// X48.
    /// G1 Z-30. F0.2
    /// G0 U-4.
    /// Z2.
    /// M30
    /// ```
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0101
    /// G97 S900 M3
    /// G0 X52. Z2.
    /// X48.
    /// G1 Z-30. F0.2
    /// X52.
    /// G0 Z2.
    /// G0 X20. Z-10.
    /// G1 Z-15.
    /// M30
    /// ```
    /// After facing, the sign of Z is wrong.
    /// ```nc,reported,haas-lathe
    /// G20 G99 T101
    /// G97 S1800 M3
    /// G0 X0.85 Z0.
    /// G1 X-0.06 F0.005
    /// G0 X0.5 Z-0.1
    /// G1 Z-1.25
    /// G0 X4.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0101
    /// G97 S900 M3
    /// G0 X52. Z2.
    /// X48.
    /// G1 Z-30. F0.2
    /// G0 U4.
    /// Z2.
    /// M30
    /// ```
    rule "rapid-into-turned-part" in "motion" {
        summary: "rapid move of a lathe through an outside surface that it has turned",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::RAPIDS,
            make: || Box::new(RapidIntoTurnedPart::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidIntoTurnedPart {
    /// The move that was reported.
    told: Option<At>,
    /// The face that the reported move goes through, or begins below.
    face: Option<Range<u32>>,
}

remembers!(RapidIntoTurnedPart: told, face);

impl PathRule for RapidIntoTurnedPart {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program)
    }

    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(turned) = Turned::of(cx) else { return };
        if let (Event::Travel(travel), Some(here)) = (event, turned.here())
            && turned.knows(cx)
            && self.told != Some(cx.origin().at)
            && !cx.origin().letters.intersects(LetterSet::of("CYHV"))
        {
            if travel.expanded {
                self.judge_pass(cx, turned, here, end(cx, travel), report);
            } else {
                self.judge(cx, turned, here, end(cx, travel), report);
            }
        }
    }
}

impl RapidIntoTurnedPart {
    fn judge(&mut self, cx: &PathCx<'_>, turned: &Turned, from: Spot, to: Spot, report: &mut Report<'_>) {
        if ToolWords::of(cx).bores() {
            return;
        }
        if let Some(cut) = turned.outside_crossed(from, to) {
            self.told = Some(cx.origin().at);
            report.add(through_outside(cx, cut, from, to));
        } else if let Some(face) = turned.face_crossed(from, to) {
            self.told = Some(cx.origin().at);
            self.face = Some(face.bytes.clone());
            report.add(
                cx.finding(&META, cx.range(), "rapid move into the part, through its face")
                    .label(format!(
                        "{} below the face, where nothing was cut",
                        cx.shown(Mm(face.ends[0][1] - to[1]))
                    ))
                    .also(face.bytes.clone(), "the part is faced to its centre here")
                    .assuming("the part is not hollow there before the program starts")
                    .help("check the sign of Z, or make the move at feed (`G1`)"),
            );
        } else if let Some(cut) = turned.shoulder_crossed(from, to) {
            self.told = Some(cx.origin().at);
            let message = "rapid move along Z into the part, through a shoulder";
            let help = "check X and Z of the move, or make it at feed (`G1`)";
            report.add(along_z(cx, cut, to, message, help));
        } else if let Some(cut) = turned.outside_ahead(from, to).filter(|_| !ToolWords::of(cx).may_bore()) {
            self.told = Some(cx.origin().at);
            let message = "rapid move along Z goes on into the part, where the cut ended";
            let help = "draw the tool out in X before this move, or make it at feed (`G1`)";
            report.add(along_z(cx, cut, to, message, help));
        } else if let Some(cut) = turned.outside_beside(from, to) {
            self.told = Some(cx.origin().at);
            let radius = cut.radius();
            report.add(
                cx.finding(&META, cx.range(), "rapid retract that goes inwards past a turned surface")
                    .label(format!("ends at X {}, nearer to the centre", shown_radius(cx, to[0])))
                    .also(cut.bytes.clone(), format!("the outside is turned to X {} here", shown_radius(cx, radius)))
                    .note("axes that leave together need not arrive together: X may be there while the tool is still in the part")
                    .help("check X, or retract Z first"),
            );
        }
    }

    /// Was a way into this face reported before? The next passes begin at the same place.
    fn is_told_of(&self, face: &Cut) -> bool {
        self.face.as_ref() == Some(&face.bytes)
    }

    /// A rapid move of a cycle: to the diameter of its first pass.
    fn judge_pass(
        &mut self,
        cx: &PathCx<'_>,
        turned: &Turned,
        from: Spot,
        to: Spot,
        report: &mut Report<'_>,
    ) {
        if cx.state().effect(Role::Motion, cx.model) == Some(Effect::ThreadingPass) {
            self.judge_thread(cx, turned, from, to, report);
            return;
        }
        let is_turning = cx.state().effect(Role::Motion, cx.model) == Some(Effect::TurningPass);
        if !is_turning && !cx.has_effect(|effect| effect == Effect::RoughAlongZ) {
            return;
        }
        // A pass in a bore, and its way back, are not nearer to the centre than its start.
        let comes_in = turned.block_begins(cx).is_some_and(|begins| to[0] < begins - SLACK);
        let Some(face) = turned.face_passed(from, to).filter(|_| comes_in) else { return };
        if self.is_told_of(face) {
            return;
        }
        self.told = Some(cx.origin().at);
        self.face = Some(face.bytes.clone());
        report.add(
            cx.finding(&META, cx.range(), "the turning cycle begins below the face of the part")
                .label(format!(
                    "goes at rapid to X {} at Z {}, where nothing was cut",
                    shown_radius(cx, to[0]),
                    cx.shown(Mm(to[1]))
                ))
                .also(face.bytes.clone(), "the part is faced here")
                .assuming("the part is as wide below its face as it was faced")
                .help("start the cycle in front of the face: check the sign of Z"),
        );
    }
}

impl RapidIntoTurnedPart {
    /// The rapid way of a threading pass to its depth.
    fn judge_thread(
        &mut self,
        cx: &PathCx<'_>,
        turned: &Turned,
        from: Spot,
        to: Spot,
        report: &mut Report<'_>,
    ) {
        let Some(cut) = turned.outside_entered(from, to).filter(|_| !ToolWords::of(cx).may_bore()) else {
            return;
        };
        if self.is_told_of(cut) {
            return;
        }
        self.told = Some(cx.origin().at);
        self.face = Some(cut.bytes.clone());
        report.add(
            cx.finding(&META, cx.range(), "the threading pass begins in the part")
                .label(format!(
                    "goes at rapid to X {} at Z {}, where nothing was cut as deep",
                    shown_radius(cx, to[0]),
                    cx.shown(Mm(to[1]))
                ))
                .also(
                    cut.bytes.clone(),
                    format!("the outside is turned to X {} here", shown_radius(cx, cut.radius())),
                )
                .assuming("there was no neck before the program started")
                .help("start the pass in front of the thread, or in its neck: check the sign of Z"),
        );
    }
}

fn through_outside(cx: &PathCx<'_>, cut: &Cut, from: Spot, to: Spot) -> Finding {
    let radius = cut.radius();
    let is_retract = is_level(from, to) && (from[0] - radius).abs() < SLACK;
    let (message, help) = if is_retract {
        (
            "rapid retract into the part after an outside cut",
            "retract outwards: check the sign of `U`, or the number of `X`",
        )
    } else {
        (
            "rapid move into the part, through a surface that was turned",
            "check X and Z of the move, or make it at feed (`G1`)",
        )
    };
    let label =
        format!("to X {} at Z {}, where nothing was cut", shown_radius(cx, to[0]), cx.shown(Mm(to[1])));
    into_part(cx, cut, message, label, help)
}

/// A move along Z through what a cut has turned.
fn along_z(cx: &PathCx<'_>, cut: &Cut, to: Spot, message: &str, help: &str) -> Finding {
    let label =
        format!("at X {} to Z {}, where nothing was cut", shown_radius(cx, to[0]), cx.shown(Mm(to[1])));
    into_part(cx, cut, message, label, help)
}

/// A move through what a cut has turned.
fn into_part(cx: &PathCx<'_>, cut: &Cut, message: &str, label: String, help: &str) -> Finding {
    cx.finding(&META, cx.range(), message)
        .label(label)
        .also(
            cut.bytes.clone(),
            format!("the outside is turned to X {} here", shown_radius(cx, cut.radius())),
        )
        .assuming("the part is not hollow there before the program starts")
        .help(help)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{Called, World, check_rule, check_rule_in, findings, only};

    fn program(comment: &str, moves: &str) -> String {
        format!("G21 G99 G40\nT0101 {comment}\nG97 S900 M3\n{moves}\nG0 X150. Z100.\nM30\n")
    }

    const TURNED: &str = "G0 X52. Z2.\nX48.\nG1 Z-30. F.2\nX52.\nG0 Z2.\n";

    #[test]
    fn a_control_for_mills_and_lathes() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G18 G90 G95 G7\nT1 M6\nG97 S600 M3\nG0 X32 Z2\nG1 X30 F0.2\nZ-40\nX32\nG0 Z-2\nX26\nG0 X60 Z50\nM2\n",
            &expect![[r#"
                9 | X26
                  | ^^^ warning[rapid-into-turned-part] rapid move into the part, through a surface that was turned
            "#]],
        );
    }

    /// A stepped shaft that is turned in one way out; what the second tool does runs into the shoulder.
    fn shaft(after: &str) -> String {
        format!(
            "G20 G18 G99\nT101\nG97 S1000 M3\nG54 G0 X2.1 Z.1\nX1.\nG1 Z-1. F.01\nX1.5\nZ-2.\nX2.1\n{after}G53 G0 X0\nG53 Z0\nM30\n"
        )
    }

    #[test]
    fn shoulders() {
        // Beside the first step and into the second one; into the face so near the outside that no bore is there.
        for (after, line) in [
            ("G0 X3.\nG53 X0\nG53 Z0\nT303\nG97 S800 M3\nG54 G0 X1.2 Z.1\nZ-1.5\nG1 X.9 F.004\n", "Z-1.5"),
            ("G0 Z.1\nX.8\nZ-.5\n", "Z-.5"),
            ("G0 X.5 Z-.5\n", "G0 X.5 Z-.5"),
            ("G0 X1.02 Z-1.5\n", "G0 X1.02 Z-1.5"),
        ] {
            for control in ["haas-lathe", "fanuc-lathe"] {
                let program = shaft(after);
                let found = findings(&only(&RULE), control, &program, &World::default());
                let [finding] = found.as_slice() else { panic!("{control} {after}: {found:?}") };
                let place = finding.range.start as usize..finding.range.end as usize;
                assert_eq!(program[place].trim_end(), line, "{control} {after}");
            }
        }
        for after in [
            "G0 X3.\nG53 X0\nG53 Z0\nT303\nG97 S800 M3\nG54 G0 X1.2 Z.1\nZ-.9\nG1 X.9 F.004\n",
            "G0 Z.1\nX.6\nZ-.5\n",
            "G0 X3.\nG55 X1.2 Z.1\nZ-1.5\n",
            "G0 X3. Z.1\nT303 (DRILL)\nG0 X0\nG1 Z-2.5 F.005\nG0 Z.1\nX1.2\nZ-1.5\n",
        ] {
            check_rule(&RULE, "haas-lathe", &shaft(after), &expect![[""]]);
        }
    }

    /// The recess of a bore that was there before, which the tool leaves inwards; a part that is turned round, or goes to another
    /// spindle; a tube that is faced no farther than its hole.
    #[test]
    fn parts_that_are_hollow_where_the_program_goes() {
        let bore = "G0 X100. Z5.\nZ2.\nX40.\nG1 Z-30. F.15\nX46.\n";
        let recess =
            "Z2.\nX100. Z100.\nT0505\nG54\nG97 S1000 M3\nG0 X36. Z2.\nZ-20.\nG1 X44. F.05\nX36.\nG0 Z2.\n";
        let solid = "G0 X62. Z2.\nZ0.\nG1 X-1.6 F.2\nG0 Z2.\nX50.\nG1 Z-60. F.25\nX62.\nG0 Z2.\nG28 U0 W0\n";
        let cored = "T0404\nG54\nG97 S1000 M3\nG0 X22. Z2.\nZ-9.\nG1 X24. Z-10. F.1\nZ-20.\nX20.\nG0 Z2.\n";
        let tube = "G0 X64. Z2.\nZ0.\nG1 X50. F.2\nG0 X64. Z2.\nX60.\nG1 Z-40. F.2\nX66.\nG0 X150. Z100.\n";
        let inside = "T0202\nG54\nG97 S1200 M3\nG0 X56.5 Z2.\nZ-20.\nG1 X57.5 F.1\nZ-30.\nX55.\nG0 Z2.\n";
        for moves in [
            format!("{bore}G1 X38.\nG0 {recess}"),
            format!("{bore}G0 X38.\n{recess}"),
            format!("{solid}M0\n{cored}"),
            format!("{solid}M70\n{cored}"),
            format!("{tube}{inside}"),
        ] {
            check_rule(&RULE, "haas-lathe", &program("", &format!("G54\n{moves}")), &expect![[""]]);
        }
        let found = findings(
            &only(&RULE),
            "haas-lathe",
            &program("", &format!("G54\n{solid}{cored}")),
            &World::default(),
        );
        assert_eq!(found.len(), 1, "without the stop between: {found:#?}");
    }

    /// A second part comes from the same bar; what holds or moves the bar is the machine builder's, or the bar is pulled out by a tool.
    #[test]
    fn the_next_part_of_a_bar() {
        let part = |between: &str| {
            format!(
                "G54\nG0 X52. Z2.\nX48.\nG1 Z-30. F.2\nX52.\nG0 X100. Z50.\n{between}T0202\nG54\nG97 S900 M3\nG0 X52. Z-20.\nG0 X30.\nG1 Z-25. F.1\nG0 X52.\n"
            )
        };
        let count = |control: &str, between: &str| {
            findings(&only(&RULE), control, &program("", &part(between)), &World::default()).len()
        };
        for control in ["fanuc-lathe", "haas-lathe"] {
            assert_eq!(count(control, ""), 1, "{control}");
            assert_eq!(count(control, "M5\nM3\n"), 1, "{control}");
            for between in [
                "M5\nM57 (BAR FEED)\n",
                "M5\nT0909 (BAR PULLER)\nG0 X0. Z-28.\nG98 G1 Z-40. F3000.\nG99\n",
                "M5\nT0909\nG0 X0. Z1.\nG98 G1 Z40. F3000.\nG99\n",
                "G10 L2 P1 Z-40.\n",
                "#5222=#5222-40.\n",
                "M5\nM11\nM10\n",
            ] {
                assert_eq!(count(control, between), 0, "{control} {between}");
            }
        }
        assert_eq!(count("haas-lathe", "M36\nG4 P1.\nM37\n"), 0);
        assert_eq!(count("haas-lathe", "G105 J40.\n"), 0);
    }

    #[test]
    fn a_bore_is_left_inwards() {
        let bored = "G0 X52. Z2.\nX48.\nG1 Z-30. F.2\nG0 U-1.\nG0 Z2.";
        check_rule(&RULE, "fanuc-lathe", &program("", bored), &expect![[""]]);
        let bored = bored.replace("U-1.", "U-4.");
        for comment in ["(BORING BAR)", "(ID FINISH)"] {
            check_rule(&RULE, "fanuc-lathe", &program(comment, &bored), &expect![[""]]);
        }
        // With a hole in the part, the cut may be a bore.
        let drilled = "G0 X0 Z2.\nG1 Z-40. F.1\nG0 Z2.\n";
        check_rule(&RULE, "fanuc-lathe", &program("", &format!("{drilled}{bored}")), &expect![[""]]);
        // From far away it comes from its change.
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", "G0 X100. Z2.\nX48.\nG1 Z-30. F.2\nG0 U-4.\nG0 Z2."),
            &expect![[""]],
        );
    }

    #[test]
    fn into_the_part_behind_its_face() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", &format!("{TURNED}X60.\nZ-10.\nX40.")),
            &expect![[r#"
            11 | X40.
               | ^^^^ warning[rapid-into-turned-part] rapid move into the part, through a surface that was turned
        "#]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            &program("", &format!("{TURNED}X52.\nG0 X20. Z-10.")),
            &expect![[r#"
                10 | G0 X20. Z-10.
                   | ^^^^^^^^^^^^^ warning[rapid-into-turned-part] rapid move into the part, through a surface that was turned
            "#]],
        );
        // To the face of a bore, for all that is known.
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", &format!("{TURNED}X150. Z100.\nG0 X20. Z-10.")),
            &expect![[""]],
        );
    }

    #[test]
    fn a_bore_within_does_not_open_the_outside() {
        let bored = "G0 X15.5 Z3.\nG71 U1. R.3\nG71 P30 Q40 U-.3 W.05 F.15\nN30 G0 X26.\nG1 Z-20.\nX20.\nZ-40.\nN40 X15.5\nG70 P30 Q40\nG0 X52. Z5.\nG0 X45. Z-15.";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", &format!("{TURNED}{bored}")),
            &expect![[r#"
                19 | G0 X45. Z-15.
                   | ^^^^^^^^^^^^^ warning[rapid-into-turned-part] rapid move into the part, through a surface that was turned
            "#]],
        );
    }

    #[test]
    fn where_a_groove_was_cut_the_way_is_free() {
        let groove = "G0 X52.\nZ-12.\nG1 X38. F.1\nG0 X52.\nZ-10.\nX40.";
        check_rule(&RULE, "fanuc-lathe", &program("", &format!("{TURNED}{groove}")), &expect![[""]]);
        let step = "G0 X30.\nG1 Z-20.\nX52.\nG0 Z-10.\nX32.";
        check_rule(&RULE, "fanuc-lathe", &program("", &format!("{TURNED}{step}")), &expect![[""]]);
    }

    #[test]
    fn on_at_rapid_where_the_cut_ended() {
        let stepped =
            |way: &str| format!("G0 X40. Z2.\nG1 Z-50. F.2\nX52.\nG0 Z2.\nX30.\nG1 Z-20.\n{way}\nG0 X60.");
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", &stepped("G0 Z-40.")),
            &expect![[r#"
            10 | G0 Z-40.
               | ^^^^^^^^ warning[rapid-into-turned-part] rapid move along Z goes on into the part, where the cut ended
        "#]],
        );
        for way in
            ["G1 Z-40.", "X41.\nG0 Z-40.", "G0 Z2.", "G1 Z-45.\nX41.\nG0 Z2.\nX30.\nG1 Z-20.\nG0 Z-40."]
        {
            check_rule(&RULE, "fanuc-lathe", &program("", &stepped(way)), &expect![[""]]);
        }
        // In a bore it may be wider there.
        check_rule(&RULE, "fanuc-lathe", &program("(ID BAR)", &stepped("G0 Z-40.")), &expect![[""]]);
        let drilled = format!("G0 X0 Z2.\nG1 Z-60. F.1\nG0 Z2.\n{}", stepped("G0 Z-40."));
        check_rule(&RULE, "fanuc-lathe", &program("", &drilled), &expect![[""]]);
        // Beyond a neck that was cut before, the way is free.
        let neck = stepped("G0 Z-40.")
            .replace("X30.\nG1 Z-20.", "Z-45.\nG1 X30.\nZ-18.\nX52.\nG0 Z2.\nX30.\nG1 Z-20.");
        check_rule(&RULE, "fanuc-lathe", &program("", &neck), &expect![[""]]);
    }

    #[test]
    fn a_cycle_that_begins_behind_the_face() {
        let passes =
            |before: &str, start: &str| format!("{before}{start}\nG90 X46. Z-40. F.25\nX42.\nG0 X60. Z5.");
        let faced = "G0 X52. Z0.\nG1 X-1.6 F.2\nG0 X52. Z2.\n";
        let by_cycle = "G0 X55. Z2.\nG94 X-1.6 Z0. F.2\n";
        for faced in [faced, by_cycle] {
            let text = program("", &passes(faced, "G0 X52. Z-2."));
            let found = findings(&only(&RULE), "fanuc-lathe", &text, &World::default());
            assert_eq!(found.len(), 1, "{found:?}");
            check_rule(&RULE, "fanuc-lathe", &program("", &passes(faced, "G0 X52. Z2.")), &expect![[""]]);
        }
        check_rule(&RULE, "fanuc-lathe", &program("", &passes("", "G0 X52. Z-2.")), &expect![[""]]);
        // The passes of a bore, which go back toward the centre.
        let bore = |comment: &str| {
            format!(
                "{faced}X150. Z100.\nT0404 {comment}\nG0 X20. Z2.\nG71 U1.5 R.5\nG71 P10 Q20 U-.4 W.1 F.2\nN10 G0 X40.\nG1 Z-20. F.1\nX30.\nZ-35.\nN20 X20.\nG70 P10 Q20"
            )
        };
        for comment in ["", "(BORING BAR)"] {
            check_rule(&RULE, "fanuc-lathe", &program("", &bore(comment)), &expect![[""]]);
            let drilled =
                bore(comment).replace("T0404", "T0202\nG0 X0 Z2.\nG1 Z-60. F.1\nG0 Z2.\nX150. Z100.\nT0404");
            check_rule(&RULE, "fanuc-lathe", &program("", &drilled), &expect![[""]]);
        }
        // Where a neck was cut, a pass may begin.
        let neck = format!("{faced}G0 X54. Z-2.\nG1 X40. F.1\nX54.\n");
        check_rule(&RULE, "fanuc-lathe", &program("", &passes(&neck, "G0 X52. Z-2.")), &expect![[""]]);
        let profile = |z: &str| {
            format!(
                "{faced}G0 X52. Z{z}\nG71 U2. R.5\nG71 P10 Q20 U.5 W.1 F.3\nN10 G0 X20.\nG1 Z-20. F.15\nX30.\nZ-35.\nN20 X50."
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", &profile("-2.")),
            &expect![[r#"
            9 | G71 P10 Q20 U.5 W.1 F.3
              | ^^^^^^^^^^^^^^^^^^^^^^^ warning[rapid-into-turned-part] the turning cycle begins below the face of the part
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("", &profile("2.")), &expect![[""]]);
    }

    #[test]
    fn a_thread_that_begins_in_the_part() {
        let thread = |neck: &str, z: &str, cycle: &str| {
            program(
                "",
                &format!(
                    "G0 X32. Z2.\nX24.\nG1 Z-30. F.2\nX32.\nG0 Z2.\n{neck}G0 X100. Z50.\nT0303\nG97 S500 M3\nG0 X28. Z{z}\n{cycle}"
                ),
            )
        };
        let cycle = "G92 X23.2 Z-25. F1.5\nX22.8\nX22.4";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &thread("", "-5.", cycle),
            &expect![[r#"
                13 | G92 X23.2 Z-25. F1.5
                   | ^^^^^^^^^^^^^^^^^^^^ warning[rapid-into-turned-part] the threading pass begins in the part
            "#]],
        );
        for (neck, z) in [("", "5."), ("", "0.5"), ("G0 X32.\nZ-5.\nG1 X20. F.1\nX32.\nG0 Z2.\n", "-5.")] {
            check_rule(&RULE, "fanuc-lathe", &thread(neck, z, cycle), &expect![[""]]);
        }
        // Of a cycle of several passes another rule tells it.
        let passes = "G76 P010060 Q80 R.03\nG76 X22.16 Z-25. P920 Q250 F1.5";
        check_rule(&RULE, "fanuc-lathe", &thread("", "-5.", passes), &expect![[""]]);
        let neck = "G0 X32. Z2.\nX24.\nG1 Z-10. F.2\nX20. Z-12.\nZ-16.\nX24.\nZ-30.\nX32.\nG0 Z2.\n";
        let left = program("", &format!("{neck}G0 X28.\nZ-14.\nG92 X23.2 Z5. F1.5"));
        check_rule(&RULE, "fanuc-lathe", &left, &expect![[""]]);
    }

    #[test]
    fn a_faced_part_is_solid() {
        let faced = "G0 X52. Z0.\nG1 X-1. F.2\nG0 Z2.\n";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", &format!("{faced}X30. Z-3.")),
            &expect![[r#"
            7 | X30. Z-3.
              | ^^^^^^^^^ warning[rapid-into-turned-part] rapid move into the part, through its face
        "#]],
        );
        let drilled = format!("{faced}X0.\nG1 Z-40. F.1\nG0 Z2.\n");
        check_rule(&RULE, "fanuc-lathe", &program("", &format!("{drilled}X8. Z-3.")), &expect![[""]]);
        // Beside the part.
        check_rule(&RULE, "fanuc-lathe", &program("", &format!("{faced}X54.\nZ-3.")), &expect![[""]]);
        let turned = format!("{faced}X40.\nG1 Z-30. F.2\nX54.\nG0 Z2.\n");
        check_rule(&RULE, "fanuc-lathe", &program("", &format!("{turned}X42.\nZ-20.")), &expect![[""]]);
    }

    #[test]
    fn out_of_the_part_and_inwards_at_once() {
        let turned = "G0 X52. Z0.\nG1 X-1. F.2\nG0 X30. Z2.\nG1 Z-30. F.1\nX52.\n";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", &format!("{turned}G0 X20. Z100.")),
            &expect![[r#"
            9 | G0 X20. Z100.
              | ^^^^^^^^^^^^^ warning[rapid-into-turned-part] rapid retract that goes inwards past a turned surface
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", &format!("{turned}G0 X52. Z100.\nX20.")),
            &expect![[""]],
        );
    }

    #[test]
    fn a_roughing_cycle_turns_the_outside() {
        let roughed = "G0 X52. Z2.\nG71 U2. R1.\nG71 P10 Q20 U.4 W.1 F.25\nN10 G0 X20.\nG1 Z-20. F.1\nX40.\nZ-40.\nN20 X52.\nG70 P10 Q20\n";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", &format!("{roughed}G0 Z-30.\nX30.")),
            &expect![[r#"
            14 | X30.
               | ^^^^ warning[rapid-into-turned-part] rapid move into the part, through a surface that was turned
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("", &format!("{roughed}G0 Z-10.\nX30.")), &expect![[""]]);
    }

    #[test]
    fn a_program_of_another_file_changes_or_cuts_the_part() {
        let program = "G20 G18 G99 T101\nG97 S800 M3\nG0 X1.7 Z.1\nX1.5\nG1 Z-2.4 F.01\nG0 X1.7\nX4. Z4.\nM98 P9002\nG97 S800 M3\nT202\nG0 X1.6 Z.1\nX1. Z-.5\nG1 Z-.9 F.01\nG0 X4.\nZ4.\nM30\n";
        for (text, expected) in [
            ("O9002\nM5\nM11\nG4 P2.\nM10\nM99\n", expect![[""]]),
            ("O9002\nG0 X1.6 Z-.5\nG1 X.9 F.01\nG0 X4.\nZ4.\nM99\n", expect![[""]]),
            (
                "O9002\nG0 X8. Z8.\nM99\n",
                expect![[r#"
                12 | X1. Z-.5
                   | ^^^^^^^^ warning[rapid-into-turned-part] rapid move into the part, through a surface that was turned
            "#]],
            ),
        ] {
            let called = Called(9002, text);
            let world = World { programs: &called, ..World::default() };
            check_rule_in(&RULE, "haas-lathe", program, &world, &expected);
        }
    }
}
