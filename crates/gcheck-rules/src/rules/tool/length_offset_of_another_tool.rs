//! A tool length offset that does not follow the scheme of the program's other tools.

use std::collections::BTreeSet;

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::is_before;
use crate::facts::five_axis::is_along_tool;
use crate::facts::offset_schemes::{Pairs, whole};
use crate::facts::tool_comment::listed;
use crate::{FollowedCx, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool works with a length offset that, by the scheme of the program's other tools, belongs to another tool: the
    /// others use `H` equal to `T`, or `T` plus a fixed number, and this one does not.
    ///
    /// ## Why it matters
    /// A tool with the length of another one cuts air, or cuts into the part or the fixture by the difference.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G43 H1 Z1.
    /// G1 Z0. F5.
    /// T2 M6
    /// G43 H1 Z1.
    /// G1 Z0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G43 H21 Z1.
    /// G1 Z0. F5.
    /// T2 M6
    /// G43 H22 Z1.
    /// G1 Z0.
    /// M30
    /// ```
    /// A second offset of the same tool is deliberate.
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G43 H1 Z1.
    /// G1 Z0. F5.
    /// T2 M6
    /// G43 H2 Z1.
    /// G1 Z0.
    /// G43 H42
    /// G1 Z-1.
    /// M30
    /// ```
    /// A tool that the list at the head has, and that never comes: a tool change is missing.
    /// ```nc,reported,haas-mill
    /// (T1 20 MM END MILL)
    /// (T2 10 MM DRILL)
    /// G21 G90 G94 G54 T1 M6
    /// G43 H1 Z10. S2000 M3
    /// G1 Z-1. F200.
    /// G0 Z50.
    /// G43 H2 Z50. S900 M3
    /// G98 G81 X5. Y5. Z-25. R3. F120.
    /// G80
    /// M30
    /// ```
    /// With one tool, the number of another one is reported where the control's manual asks for the tool's own.
    /// ```nc,reported,linuxcnc
    /// T1 M6
    /// G43 H2
    /// G1 Z0 F50
    /// M2
    /// ```
    rule "length-offset-of-another-tool" in "tool" {
        summary: "length offset of another tool",
        severity: Error,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CUTS.union(Watch::CHANGES).union(Watch::FOLLOWED),
            make: || Box::new(LengthOffsetOfAnotherTool {
                pairs: Pairs::new(),
                listed: BTreeSet::new(),
                called: Some(BTreeSet::new()),
                own: None,
            }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct LengthOffsetOfAnotherTool {
    pairs: Pairs,
    /// Offsets of the pairs that are the numbers of tools which comments at the head of the program list.
    listed: BTreeSet<u32>,
    /// Tools that the program calls; `None` when it calls one whose number is not known.
    called: Option<BTreeSet<u32>>,
    /// Where the tool came that last worked with the offset of its own number, and where its speed was given.
    own: Option<(Option<At>, Option<At>)>,
}

remembers!(LengthOffsetOfAnotherTool: pairs, own);

impl PathRule for LengthOffsetOfAnotherTool {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        let state = cx.state();
        let is_on = |effect: Effect| effect.takes_tool_length() || is_along_tool(effect);
        let by_t = cx.model.semantics().tools.offset_in_t;
        if !by_t && !state.effect(Role::Length, cx.model).is_some_and(is_on) {
            return;
        }
        let (tool, offset) = (Abstract::known(state.tool()), Abstract::known(state.h()));
        let (Some(tool), Some(offset)) = (tool.and_then(whole), offset.and_then(whole)) else { return };
        let now = (cx.definitions().set_by(Fact::Tool), cx.definitions().set_by(Fact::Speed));
        // The same tool goes on at the same speed with a second offset. With a new speed it is meant to be another tool.
        let is_second = self.own == Some(now);
        if tool == offset {
            self.own = Some(now);
        }
        let letter = if by_t { 'T' } else { 'H' };
        let of_list = &mut self.listed;
        self.pairs.add(tool, offset, cx.definitions().set_by(Fact::Tool), || {
            if tool != offset && !is_second && listed(cx, offset).is_some() {
                of_list.insert(offset);
            }
            let (given, changed) =
                (cx.definitions().set_by(Fact::Length), cx.definitions().set_by(Fact::Tool));
            let given = given
                .and_then(|at| Some((at, cx.find_word(at, |word| word.letter.ascii() == letter as u8)?)));
            let word = if by_t { String::new() } else { format!(" (`H{offset}`, `T{tool}`)") };
            let message = format!("tool {tool} works with length offset {offset}{word}");
            let change = changed.filter(|_| !by_t).and_then(|at| Some((at, cx.range_of(at)?)));
            match (given, change) {
                // Given for the tool before, and not given again.
                (Some((at, given)), Some((change, range))) if is_before(at, change) => {
                    let finding = cx
                        .finding(&META, cx.range(), message)
                        .also(given, "the offset comes from here")
                        .also(range, format!("tool {tool} comes into the spindle here"));
                    (finding, None)
                }
                (Some((_, given)), Some((_, range))) => {
                    let finding = cx
                        .finding(&META, given.clone(), message)
                        .also(range, format!("tool {tool} comes into the spindle here"));
                    (finding, Some(given))
                }
                (given, _) => {
                    let place = given.map_or_else(|| cx.range(), |(_, range)| range);
                    (cx.finding(&META, place, message), None)
                }
            }
        });
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        match event {
            Event::LengthOffset(_) => tell_disagreement(cx, report),
            Event::SelectTool(tool) | Event::ToolChange(tool) => {
                self.called = self.called.take().zip(*tool).map(|(mut called, tool)| {
                    called.insert(tool);
                    called
                });
            }
            _ => {}
        }
    }

    fn followed(&mut self, cx: &FollowedCx<'_>, report: &mut Report<'_>) {
        let by_t = cx.model.semantics().tools.offset_in_t;
        let absent = self.called.as_ref().map(|called| &self.listed - called).unwrap_or_default();
        for (finding, offset) in self.pairs.take_of_absent(&absent) {
            report.add(
                finding
                    .label(format!("the list of tools has tool {offset}, which the program never calls"))
                    .help(format!("check whether the change to tool {offset} is missing"))
                    .at_most(Severity::Warning),
            );
        }
        for (finding, scheme) in self.pairs.take_odd('H', !by_t) {
            // A tool may have a second offset, but for one that a list at the head gives to another tool. Tens more than its own
            // is how second offsets are numbered.
            let is_listed = u32::try_from(scheme.owner).is_ok_and(|owner| self.listed.contains(&owner))
                && (scheme.owner - scheme.expected) % 10 != 0;
            let is_unsure = scheme.is_unsure && !is_listed;
            let finding = finding.at_most(if is_unsure { Severity::Info } else { Severity::Warning });
            report.add(
                finding
                    .label(scheme.label("length offset"))
                    .note(scheme.note("length offset", 'H'))
                    .help(format!("use offset {}, or say why not in a suppression", scheme.expected)),
            );
        }
        let of_tools = cx.model.semantics().tools.offsets_of_tools;
        // Of a turret's `T0102` the offset is a part of the word.
        let letter = (!by_t).then_some('H');
        let strangers = if by_t || of_tools { self.pairs.take_strangers(letter) } else { Vec::new() };
        for (finding, tool) in strangers {
            let (owner, most) = if by_t { ("station", Severity::Info) } else { ("tool", Severity::Warning) };
            report.add(
                finding
                    .label(format!("that is the number of another {owner}"))
                    .help(format!("use offset {tool}, or say why not in a suppression"))
                    .at_most(most),
            );
        }
    }
}

/// A setting may demand that the length is that of the tool in the spindle.
fn tell_disagreement(cx: &PathCx<'_>, report: &mut Report<'_>) {
    let Some(agreement) = &cx.model.semantics().length_agreement else { return };
    let is_on = cx.environment.setting(&agreement.setting).is_some_and(|(value, _)| is_on(value));
    let (tool, offset) = (Abstract::known(cx.state().tool()), Abstract::known(cx.state().h()));
    let (Some(tool), Some(offset)) = (tool.and_then(whole), offset.and_then(whole)) else { return };
    if !is_on || offset == 0 || offset == tool || !cx.is_on_every_path() {
        return;
    }
    let message = format!("tool {tool} takes length offset {offset} (`H{offset}`, `T{tool}`)");
    let range = cx.word_range(|word| word.letter.ascii() == b'H');
    let most = cx.environment.most_for_this_control();
    report.add(
        cx.finding(&META, range, message)
            .alarm(Some(agreement.alarm.clone()))
            .label("the control stops here")
            .note(format!(
                "with setting {} on, `H` must be the number of the tool in the spindle, or 0  [{}]",
                agreement.setting,
                cx.model.semantics().source
            ))
            .help(format!("use `H{tool}`"))
            .at_most(most),
    );
}

/// Is the value of a switch the one that turns it on?
fn is_on(value: &str) -> bool {
    matches!(value, "on" | "true")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_number_of_a_tool_that_the_head_lists() {
        let program = |head: &str| {
            format!(
                "{head}T1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nT3 M6\nG43 H3 Z1.\nG1 Z0.\nG0 Z1.\nT1 M6\nG43 H1 Z1.\nG1 Z0.\nT3 M6\nG43 H4 Z1.\nG1 Z0.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program("(T3 DRILL)\n(T4 TAP)\n"),
            &expect![[r#"
            14 | G43 H4 Z1.
               |     ^^ warning[length-offset-of-another-tool] tool 3 works with length offset 4 (`H4`, `T3`)
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program(""),
            &expect![[r#"
            12 | G43 H4 Z1.
               |     ^^ info[length-offset-of-another-tool] tool 3 works with length offset 4 (`H4`, `T3`)
        "#]],
        );
    }

    #[test]
    fn a_second_offset_has_the_number_of_a_tool_of_the_list() {
        let mill = |second: &str| {
            format!(
                "(T1 KEYSEAT CUTTER)\n(T2 DRILL)\n(T5 REAM)\n(T21 TAP M8)\nT1 M6\nG43 H1 Z1.\nG1 Z0. F5.\n{second}G1 Z-5.\nG0 Z50.\nT2 M6\nG43 H2 Z1.\nG1 Z0.\nM30\n"
            )
        };
        // With its own number before it, or tens more.
        for second in ["G43 H21 Z1.\n", "G43 H5 Z1.\n"] {
            check_rule(&RULE, "haas-mill", &mill(second), &expect![[""]]);
        }
        let lathe = "(T1 GROOVE LEFT EDGE)\n(T2 TURN)\n(T11 DRILL)\nG21 G99\nT0202\nG1 Z-20. F.2\nT0101\nG1 X30. F.1\nT0111\nG1 X30. F.1\nM30\n";
        check_rule(&RULE, "fanuc-lathe", lathe, &expect![[""]]);
    }

    #[test]
    fn the_offset_that_breaks_the_scheme_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG43 H21 Z1.\nG1 Z0. F5.\nT2 M6\nG43 H22 Z1.\nG1 Z0.\nT3 M6\nG43 H22 Z1.\nG1 Z0.\nM30\n",
            &expect![[r#"
                8 | G43 H22 Z1.
                  |     ^^^ warning[length-offset-of-another-tool] tool 3 works with length offset 22 (`H22`, `T3`)
            "#]],
        );
    }

    #[test]
    fn along_a_tilted_tool_the_offset_is_the_tools_own_too() {
        let program = |offset: &str| {
            format!(
                "T1 M6\nG0 G54 X0. Y0. A0. B0. S900 M3\nG143 {offset} X0. Y0. Z3. A0. B0.\nG1 G93 X1. Y0. Z2. A1. B0. F9.\nG49\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program("H10"),
            &expect![[r#"
                3 | G143 H10 X0. Y0. Z3. A0. B0.
                  |      ^^^ warning[length-offset-of-another-tool] tool 1 works with length offset 10 (`H10`, `T1`)
            "#]],
        );
        check_rule(&RULE, "haas-mill", &program("H1"), &expect![[""]]);
    }

    #[test]
    fn an_offset_left_on_from_the_last_tool() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nT2 M6\nG0 Z1.\nG1 Z0.\nM30\n",
            &expect![[r#"
                6 | G1 Z0.
                  | ^^^^^^ warning[length-offset-of-another-tool] tool 2 works with length offset 1 (`H1`, `T2`)
            "#]],
        );
    }

    #[test]
    fn two_tools_fix_no_scheme_but_the_plain_one() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG43 H21 Z1.\nG1 Z0. F5.\nT2 M6\nG43 H21 Z1.\nG1 Z0.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn an_offset_of_no_tool_of_the_program_may_be_meant() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nT2 M6\nG43 H52 Z1.\nG1 Z0.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_turret_names_its_offset_in_t() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "T0101\nG1 X1. F.1\nT0202\nG1 X2.\nT0301\nG1 X3.\nM30\n",
            &expect![[r#"
                5 | T0301
                  | ^^^^^ warning[length-offset-of-another-tool] tool 3 works with length offset 1
            "#]],
        );
    }

    #[test]
    fn a_second_offset_of_a_turning_tool_is_numbered_past_the_stations() {
        let program = |t: &str| format!("T0101\nG1 X1. F.1\n{t}\nG1 X2.\nM30\n");
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("T0405"),
            &expect![[r#"
                3 | T0405
                  | ^^^^^ info[length-offset-of-another-tool] tool 4 works with length offset 5
            "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("T0414"), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &program("T0432"), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &program("T0102"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            "T1213\nG1 X1. F.1\nM30\n",
            &expect![[r#"
            1 | T1213
              | ^^^^^ info[length-offset-of-another-tool] tool 12 works with length offset 13
        "#]],
        );
    }

    #[test]
    fn the_offset_of_another_tool_is_no_second_offset() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nT2 M6\nG43 H2 Z1.\nG1 Z0.\nT1 M6\nG43 H2 Z1.\nG1 Z-1.\nM30\n",
            &expect![[r#"
                8 | G43 H2 Z1.
                  |     ^^ info[length-offset-of-another-tool] tool 1 works with length offset 2 (`H2`, `T1`)
            "#]],
        );
    }

    #[test]
    fn an_approach_before_the_length_comes_is_made_with_the_one_before() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nT2 M6\nG1 X1.\nG43 H2 Z1.\nG1 Z0.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_second_offset_stands_beside_the_first() {
        let tools = "T1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nT2 M6\nG43 H2 Z1.\nG1 Z0.\nT3 M6\nG43 H3 Z1.\nG1 Z0.\n";
        let alone = format!("{tools}T1 M6\nG43 H41 Z1.\nG1 Z-1.\nM30\n");
        check_rule(
            &RULE,
            "haas-mill",
            &alone,
            &expect![[r#"
            11 | G43 H41 Z1.
               |     ^^^ info[length-offset-of-another-tool] tool 1 works with length offset 41 (`H41`, `T1`)
        "#]],
        );
        let beside = format!("{tools}T1 M6\nG43 H1 Z1.\nG1 Z-1.\nG43 H41\nG1 Z-2.\nM30\n");
        check_rule(&RULE, "haas-mill", &beside, &expect![[""]]);
    }

    #[test]
    fn what_it_says() {
        let found = findings(
            &only(&RULE),
            "haas-mill",
            "T1 M6\nG43 H1 Z1.\nG1 Z0. F5.\nT2 M6\nG43 H1 Z1.\nG1 Z0.\nM30\n",
            &World::default(),
        );
        expect![[r#"
            tool 2 works with length offset 1 (`H1`, `T2`)
              here: the length offset of tool 1
              there: tool 2 comes into the spindle here
              note: the program's other tool has the length offset of the tool's own number (H = T)
              help: use offset 2, or say why not in a suppression
              fix (unsafe): write `H2`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
