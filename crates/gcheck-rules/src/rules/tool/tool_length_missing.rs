//! A tool that works without its length.

use gcheck_controls::{CodeIx, Confidence, Effect, Letter};
use gcheck_engine::{Abstract, At, Axis, Domain, Event, Fact, Role, Stop};

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_tool;
use crate::facts::offset_schemes::whole;
use crate::facts::probing::is_near;
use crate::facts::tool_comment::{HEAD, comments_in};
use crate::facts::work_offset::{file_writes_zero, writes_zero_at};
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// After a tool change a block moves along Z in work coordinates without tool length compensation, with offset
    /// number zero, or with the length of the tool before.
    ///
    /// A program that never compensates is information: its tool may be zeroed by hand. It is a warning where a changer puts in
    /// several tools that all work from one zero, with no stop between them.
    ///
    /// ## Why it matters
    /// The control takes the spindle nose for the tool tip and drives the tool into the part by its whole length.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G0 G54 X0. Y0.
    /// Z.1
    /// G43 H1 Z1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G0 G54 X0. Y0.
    /// G43 H1 Z.1
    /// M30
    /// ```
    /// Machine coordinates need no length.
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G53 G0 Z0.
    /// G43 H1 Z.1
    /// M30
    /// ```
    /// Lengths that are posted into the path need no compensation:
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G0 G90 G54 X0. Y0. Z1. A0. B0.
    /// G143 H1 X0. Y0. Z.1 A5. B5.
    /// M30
    /// ```
    rule "tool-length-missing" in "tool" {
        summary: "tool works without length compensation",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::MOVES).union(Watch::FOLLOWED),
            make: || Box::new(ToolLengthMissing::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ToolLengthMissing {
    /// The tool change whose tool has not worked yet.
    changed: Option<At>,
    /// A length was given since.
    has_length: bool,
    /// The tool that was in the spindle when a length was given last.
    measured: Option<u32>,
    /// The first tool of a program that never compensates, which is reported once.
    uncompensated: Option<Uncompensated>,
}

remembers!(ToolLengthMissing: changed, uncompensated);

/// Tools of a program that never compensates.
#[derive(Clone, PartialEq)]
struct Uncompensated {
    /// Of the first one.
    finding: Finding,
    /// Its number, and what it counts Z from.
    tool: Option<u32>,
    zero: Option<(u16, u64)>,
    /// The tools work from one zero, for all that is known.
    is_one_zero: bool,
    /// Another tool works from the same zero.
    has_other: bool,
}

remembers!(Uncompensated: finding);

impl PathRule for ToolLengthMissing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        match event {
            Event::ToolChange(number) => {
                self.changed = (*number != Some(0)).then_some(cx.origin().at);
                self.has_length = false;
            }
            Event::LengthOffset(_) => {
                self.has_length = true;
                self.measured = Abstract::known(cx.state().tool()).and_then(whole);
            }
            // The operator may put a tool in by hand and zero it.
            Event::Stop(Stop::Program | Stop::Optional | Stop::Message(_)) => {
                if let Some(first) = &mut self.uncompensated {
                    first.is_one_zero = false;
                }
            }
            _ => {}
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        let Some(first) = self.uncompensated.take() else { return };
        let is_sure = first.has_other;
        report.add(if is_sure {
            first.finding.note(
                "another tool works from the same zero, and the program never compensates for its length",
            )
        } else {
            first.finding.at_most(Severity::Info)
        });
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if self.changed.is_none() {
            cx.rest();
        } else if cx.origin().letters.contains(Letter::of('Z')) {
            self.judge(cx, event, report);
        }
    }
}

impl ToolLengthMissing {
    fn judge(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let rules = cx.model.semantics().tools;
        let Some(at) = self.changed else { return };
        // Lengths that are posted into the path need no compensation: the control adds only a difference.
        if cx.file_uses(is_along_tool) {
            return;
        }
        if rules.change_by_t || rules.offset_in_t || needs_no_length(cx) {
            return;
        }
        // The tool's first work: reported here, or not at all.
        self.changed = None;
        let is_off = |code| matches!(cx.model.effect(code), Effect::LengthOff | Effect::None);
        let Some(code) = cx.state().mode(Role::Length).only() else { return };
        if !is_off(code) {
            let is_same = self
                .measured
                .is_some_and(|tool| Abstract::known(cx.state().tool()).and_then(whole) == Some(tool));
            judge_what_is_on(cx, at, code, self.has_length || is_same, report);
            return;
        }
        if cx.definitions().set_by(Fact::Tool) != Some(at) {
            return;
        }
        let Some(on) = code_that_compensates(cx) else { return };
        let Some(is_touching) = is_touching_off(cx) else { return };
        let is_ever_used = cx.file_uses(Effect::takes_tool_length);
        if !is_ever_used && self.uncompensated.is_some() {
            self.another_uncompensated(cx);
            return;
        }
        let what = if matches!(event, Event::Travel(t) if t.kind == gcheck_engine::TravelKind::Rapid) {
            "moves"
        } else {
            "cuts"
        };
        let mut finding = cx
            .finding(
                &META,
                cx.letter_range('Z'),
                format!("the tool {what} without its length (no `{on}` since the tool change)"),
            )
            .label("the control takes the spindle nose for the tool tip");
        if let Some(range) = cx.find_word(at, |word| cx.model.effect(word.code) == Effect::ToolChange) {
            finding = finding.also(range, "tool changed here");
        }
        if code.is_some() && cx.definitions().set_by(Fact::Mode(Role::Length)).is_some() {
            finding = cx.resting_on(finding, Fact::Mode(Role::Length), &format!("`{}`", cx.name_of(code)));
        }
        let finding = finding.help(format!("give the length with the first move along Z: `{on} H1 Z…`"));
        if is_ever_used {
            let may_be_meant = is_touching || has_own_zero(cx, at);
            report.add(if may_be_meant { finding.at_most(Severity::Info) } else { finding });
        } else {
            self.uncompensated = Some(Uncompensated {
                finding: finding.note(format!(
                    "the program never uses `{on}`: its tools may be set to one length, or zeroed by hand"
                )),
                tool: Abstract::known(cx.state().tool()).and_then(whole),
                zero: zero(cx),
                is_one_zero: has_changer(cx)
                    && !cx.file_uses(writes_zero)
                    && !file_writes_zero(cx)
                    && !are_set_to_one_length(cx),
                has_other: false,
            });
        }
    }

    /// Another tool works without a length, in a program that never compensates.
    fn another_uncompensated(&mut self, cx: &PathCx<'_>) {
        let Some(first) = &mut self.uncompensated else { return };
        let tool = Abstract::known(cx.state().tool()).and_then(whole);
        let is_other = first.tool.zip(tool).is_some_and(|(first, tool)| first != tool);
        let is_same_zero = first.zero.is_some() && first.zero == zero(cx);
        first.has_other |= first.is_one_zero && is_other && is_same_zero && cx.is_certain();
    }
}

/// What Z counts from: the work offset, and the shift as bits.
fn zero(cx: &PathCx<'_>) -> Option<(u16, u64)> {
    Some((cx.state().work()?, cx.state().shift().raw(Axis::Z).to_bits()))
}

/// May the program give each tool a zero of its own?
fn writes_zero(effect: Effect) -> bool {
    matches!(effect, Effect::WriteOffsets | Effect::SetPosition | Effect::SpeedLimitOrSetPosition)
}

/// Was a zero written since the tool came: its own, with its length in it?
fn has_own_zero(cx: &PathCx<'_>, changed: At) -> bool {
    let here = cx.origin().at;
    let writes = |at: At| {
        let is_code = |word: &gcheck_program::Word| writes_zero(cx.model.effect(word.code));
        writes_zero_at(cx, at) || cx.find_word(at, is_code).is_some()
    };
    changed.file == here.file && (changed.block..=here.block).any(|block| writes(At { block, ..here }))
}

/// Does a comment at the head of the program say that the tools are set to one length?
fn are_set_to_one_length(cx: &PathCx<'_>) -> bool {
    let is = |comment: String| {
        let comment = comment.to_ascii_uppercase();
        let words: Vec<&str> = comment.split(|c: char| !c.is_ascii_alphanumeric()).collect();
        let has = |names: &[&str]| words.iter().any(|word| names.contains(word));
        let is_beside = |first: &[&str], second: &[&str]| {
            words.windows(2).any(|pair| matches!(pair, [a, b] if first.contains(a) && second.contains(b)))
        };
        let lengths = ["LENGTH", "LENGTHS", "HEIGHT", "HEIGHTS"];
        let is_one = is_beside(&["SAME", "EQUAL", "IDENTICAL", "ONE"], &lengths);
        // A comment that asks for offsets says the opposite.
        (is_one || is_beside(&["NO"], &["G43"])) && !has(&["OFFSET", "OFFSETS", "H"])
    };
    (0..HEAD).filter_map(|block| comments_in(cx, At { file: 0, block })).any(is)
}

/// Does the machine change tools by itself? A strict control is one of machines that people build themselves, whose tools are mostly
/// changed and zeroed by hand; a program of which nothing tells the control may be for one.
fn has_changer(cx: &PathCx<'_>) -> bool {
    let rules = cx.model.semantics();
    let change = cx.control().codes().find(|code| code.effect() == Effect::ToolChange);
    let is_known = change.is_some_and(|code| code.entry().confidence != Confidence::Assumed);
    is_known && !rules.strict && !rules.tools.length_from_tool
}

/// The code that gives a tool its length, unless it is an option of the control.
fn code_that_compensates(cx: &PathCx<'_>) -> Option<String> {
    // A control that only takes lengths from the program, without a table, has the tool measured when it is changed.
    let on = cx.control().codes().find(|code| code.effect().takes_tool_length())?;
    // Where the code is an option, machines without it measure the tool when it is changed.
    on.entry().option.is_none().then(|| on.number().to_string())
}

/// Is the tool about to touch off? `None` when it needs no length for what it does.
fn is_touching_off(cx: &PathCx<'_>) -> Option<bool> {
    // A work offset is measured with the length off, and the probe moves to its place without it.
    if cx.file_uses(|effect| matches!(effect, Effect::ProbeOffset | Effect::ProbeCentre)) {
        return None;
    }
    // A tool that is about to touch off finds its own zero. If no offset is written, the result is the position of
    // the spindle nose, and the other tools move there with their tips.
    let keeps = |effect| {
        matches!(
            effect,
            Effect::WriteOffsets | Effect::SetPosition | Effect::LocalShift | Effect::LengthFromBlock
        )
    };
    let is_touching = is_near(cx, Effect::probes_toward);
    let goes_without = is_touching && (!cx.file_uses(Effect::takes_tool_length) || cx.file_uses(keeps));
    (!goes_without).then_some(is_touching)
}

/// Length compensation is on: with no length at all, or with the one that the tool before had.
fn judge_what_is_on(cx: &PathCx<'_>, at: At, code: CodeIx, has_length: bool, report: &mut Report<'_>) {
    if cx.model.effect(code) != Effect::LengthPlus || cx.definitions().set_by(Fact::Tool) != Some(at) {
        return;
    }
    let Some(set) = cx.definitions().set_by(Fact::Length) else { return };
    // In the block of the change the length may come first; what other files do is not shown.
    let is_own = has_length || set == at || set.file != 0;
    let name = cx.name_of(code);
    let is_h = |word: &gcheck_program::Word| word.letter == Letter::of('H');
    let given = cx.find_word(set, is_h);
    let number = Abstract::known(cx.state().h());
    let is_zero = number == Some(0.0);
    // If it never comes, the tool works with the offset of the other one: the rules on offset numbers report that.
    // A length that was taken from the tool in the spindle then has no number.
    let is_of_tool = cx.model.semantics().tools.length_from_tool;
    let is_followed_by_its_own = is_near(cx, |effect| effect == Effect::LengthPlus);
    // In a block that also moves Z, another rule reports it for any tool.
    let is_alone = cx.find_word(set, |word| word.letter == Letter::of('Z')).is_none();
    if is_zero && is_alone && !cx.model.semantics().tools.length_from_tool && is_own {
        let finding = cx
            .finding(
                &META,
                given.unwrap_or_else(|| cx.letter_range('Z')),
                "the tool has no length (offset number zero, `H0`)",
            )
            .label("the control takes the spindle nose for the tool tip");
        report.add(finding.help(format!("give the offset of the tool: `{name} H1 Z…`")));
    } else if !is_own && !is_zero && (is_followed_by_its_own || is_of_tool && given.is_none()) {
        let mut finding = cx
            .finding(
                &META,
                cx.letter_range('Z'),
                format!(
                    "the tool moves with the length of the tool before (no `{name}` since the tool change)"
                ),
            )
            .label("the tip is off by the difference between the two lengths");
        if let Some(given) = given {
            finding = finding.also(given, "the length comes from here");
        }
        report.add(finding.help(format!("give the length with the first move along Z: `{name} H1 Z…`")));
    }
}

/// Moves in machine coordinates, to a reference point or to a probe's touch.
fn needs_no_length(cx: &PathCx<'_>) -> bool {
    cx.has_effect(|effect| {
        matches!(
            effect,
            Effect::MachineCoordinates
                | Effect::ReturnReference(_)
                | Effect::ReturnFromReference
                | Effect::ToolChange
                | Effect::ProbeDiameter
                | Effect::ProbeOffset
                | Effect::ProbeLength
                | Effect::ProbeCentre
                | Effect::Skip
                | Effect::ProbeToward
                | Effect::ProbeTowardOptional
        )
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::Severity;
    use crate::testing::{World, check_rule, findings, only};

    #[test]
    fn a_length_without_a_number_is_of_the_tool_before() {
        let program = |length: &str| {
            format!(
                "G21 G90\nT2 M6\nG43\nG0 X10 Y10\nZ5\nG1 Z-3 F100\nG53 G0 Z0\nT4 M6\n{length}G0 X10 Y10\nZ5\nM2\n"
            )
        };
        check_rule(
            &RULE,
            "linuxcnc",
            &program(""),
            &expect![[r#"
            10 | Z5
               | ^^ warning[tool-length-missing] the tool moves with the length of the tool before (no `G43` since the tool change)
        "#]],
        );
        check_rule(&RULE, "linuxcnc", &program("G43\n"), &expect![[""]]);
    }

    #[test]
    fn several_tools_without_any_length() {
        let program = |second: &str| {
            format!(
                "T1 M6\nG90 G54 G0 X0. Y0. S3000 M3\nZ1.\nG81 Z-.5 R.1 F9.\nG80 G0 Z1.\n{second}G54 G0 X0. Y0.\nZ1.\nG81 Z-.5 R.1 F9.\nG80\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program("T2 M6\n"),
            &expect![[r#"
                3 | Z1.
                  | ^^^ warning[tool-length-missing] the tool moves without its length (no `G43` since the tool change)
            "#]],
        );
        // One tool, tools that an operator may zero, and tools that get a zero of their own.
        for second in ["", "T1 M6\n", "M0\nT2 M6\n", "T2 M6\nM1\n", "T2 M6\nG10 L2 P1 Z-287.1\n"] {
            check_rule(
                &RULE,
                "fanuc-mill",
                &program(second),
                &expect![[r#"
                    3 | Z1.
                      | ^^^ info[tool-length-missing] the tool moves without its length (no `G43` since the tool change)
                "#]],
            );
        }
    }

    /// The zero of each tool has its length in it, or a comment tells that all have one.
    #[test]
    fn tools_with_a_zero_of_their_own() {
        let program = |head: &str, first: &str, second: &str| {
            format!(
                "O1\n{head}T1 M6\n{first}G90 G54 G0 X0. Y0. S3000 M3\nZ1.\nG81 Z-.5 R.1 F9.\nG80 G0 Z1.\nT2 M6\n{second}G0 X0. Y0.\nZ1.\nG81 Z-.5 R.1 F9.\nG80\nM30\n"
            )
        };
        let severity = |control: &str, text: &str| {
            let found = findings(&only(&RULE), control, text, &World::default());
            found.iter().map(|finding| finding.severity).collect::<Vec<_>>()
        };
        assert_eq!(severity("haas-mill", &program("", "", "")), [Severity::Warning]);
        for control in ["haas-mill", "fanuc-mill"] {
            for (head, first, second) in [
                ("", "#5223=-287.1\n", "#5223=-301.4\n"),
                ("", "", "#5223=#5223-14.3\n"),
                ("", "G55\n", "G55\n#5243=-12.\n"),
                ("", "G10 L2 P1 Z-287.1\n", "G10 L2 P1 Z-301.4\n"),
                ("(ALL TOOLS SET TO ONE LENGTH)\n", "", ""),
                ("(PRESET HOLDERS, NO G43)\n", "", ""),
            ] {
                let found = severity(control, &program(head, first, second));
                assert!(
                    found.iter().all(|severity| *severity <= Severity::Info),
                    "{control} {first}{second}: {found:?}"
                );
            }
        }
        for head in
            ["(SET LENGTH OFFSETS FOR ALL TOOLS)\n", "(PRESET TOOLS IN H OFFSETS)\n", "(STOCK LENGTH 100)\n"]
        {
            let found = severity("haas-mill", &program(head, "", ""));
            assert!(found.contains(&Severity::Warning), "{head}: {found:?}");
        }
        // One tool with its length, and another with a zero of its own.
        let mixed = |own: &str| {
            format!("O1\nT1 M6\nG90 G54 G0 G43 H1 Z1.\nG49 G28 Z0\nT2 M6\n{own}G0 X0. Y0.\nZ1.\nM30\n")
        };
        assert_eq!(severity("fanuc-mill", &mixed("")), [Severity::Warning]);
        assert_eq!(severity("fanuc-mill", &mixed("#5223=-301.4\n")), [Severity::Info]);
        assert_eq!(severity("fanuc-mill", &mixed("#500=-301.4\n")), [Severity::Warning]);
    }

    #[test]
    fn the_move_along_z_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nG49 G28 Z0.\nT2 M6\nG0 X0.\nZ.1\nG1 Z0.\nM30\n",
            &expect![[r#"
                7 | Z.1
                  | ^^^ warning[tool-length-missing] the tool moves without its length (no `G43` since the tool change)
            "#]],
        );
    }

    #[test]
    fn an_approach_with_the_length_of_the_tool_before() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nT1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nT2 M6\nG0 X0. Z2.\nG43 H2 Z1.\nG1 Z0.\nM30\n",
            &expect![[r#"
                6 | G0 X0. Z2.
                  |        ^^^ warning[tool-length-missing] the tool moves with the length of the tool before (no `G43` since the tool change)
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nT1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nT2 M6\nG0 X0. Y2.\nG43 H2 Z1.\nG1 Z0.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn the_length_in_the_block_of_the_change() {
        for control in ["haas-mill", "fanuc-mill"] {
            let program =
                "O1\nM6 T1 G43 H1 M3 S500\nG0 Z1.\nG1 Z0. F5.\nM6 T3 G43 H3 M3 S500\nG0 Z1.\nG1 Z0.\nM30\n";
            check_rule(&RULE, control, program, &expect![[""]]);
        }
    }

    #[test]
    fn a_tool_change_in_a_subprogram() {
        let program = |sub: &str, length: &str| {
            format!(
                "O1\nT1 M98 P100\nG43 H1 Z1.\nG1 Z0. F5.\nT2 M98 P100\n{length}G0 X0. Z2.\nG43 H2 Z1.\nG1 Z0.\nM30\nO100\n{sub}M6\nM99\n"
            )
        };
        check_rule(&RULE, "fanuc-mill", &program("", "G43 H2 "), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("", ""),
            &expect![[r#"
            6 | G0 X0. Z2.
              |        ^^^ warning[tool-length-missing] the tool moves with the length of the tool before (no `G43` since the tool change)
        "#]],
        );
    }

    #[test]
    fn an_offset_of_zero_is_no_length() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nT1 M6\nG43 H0\nG1 Z0. F5.\nM30\n",
            &expect![[r#"
                3 | G43 H0
                  |     ^^ warning[tool-length-missing] the tool has no length (offset number zero, `H0`)
            "#]],
        );
        check_rule(&RULE, "fanuc-mill", "O1\nT1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_cut_along_z_counts_and_a_way_beside_the_part_does_not() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G43 H2\nG49\nT1 M6\nG1 X5 F100\nZ-1\nM2\n",
            &expect![[r#"
            5 | Z-1
              | ^^^ warning[tool-length-missing] the tool cuts without its length (no `G43` since the tool change)
        "#]],
        );
    }

    #[test]
    fn a_program_that_never_compensates_is_told_once() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 T1 M6\nG0 Z5\nT2 M6\nG0 Z5\nM2\n",
            &expect![[r#"
            2 | G0 Z5
              |    ^^ info[tool-length-missing] the tool moves without its length (no `G43` since the tool change)
        "#]],
        );
    }

    #[test]
    fn a_turret_knows_its_tools() {
        check_rule(&RULE, "fanuc-lathe", "T0101\nG1 X5. Z0. F.1\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_probe_that_measures_a_work_offset_works_without_its_length() {
        check_rule(
            &RULE,
            "haas-mill",
            "T20 M6\nG90 G54 G0 X0. Y0.\nZ1.\nG91 G36 Z-1. F5.\nT1 M6\nG90 G43 H1 Z1.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_tool_that_touches_off_finds_its_own_zero() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 T1 M6\nG0 X0 Y0\nG0 Z10\nG38.2 Z-20 F100\nG10 L20 P1 Z0\nT2 M6\nG43 Z10\nM2\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_surface_that_is_touched_for_other_tools_is_touched_with_the_tip() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 T10 M6\nG0 X0 Y0\nG0 Z10\nG38.2 Z-20 F100\nT4 M6\nG43 H4\nG0 Z[#5063+5]\nM2\n",
            &expect![[r#"
                3 | G0 Z10
                  |    ^^^ info[tool-length-missing] the tool moves without its length (no `G43` since the tool change)
            "#]],
        );
    }

    #[test]
    fn an_empty_spindle_has_no_length() {
        check_rule(&RULE, "linuxcnc", "G21 G43 H1\nG49\nT0 M6\nG0 Z5\nM2\n", &expect![[""]]);
    }
}
