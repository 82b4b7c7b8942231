//! A program that always ends with an alarm of its own.

use gcheck_controls::{Effect, MessageComment};
use gcheck_engine::{At, Ending, Fault, FrameKind};

use crate::declare::declare_rule;
use crate::facts::past_alarm::loses_way;
use crate::facts::usage::reads_start_state;
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Every path of the program comes to an assignment that raises an alarm (`#3000`).
    ///
    /// ## Why it matters
    /// The program never runs to its end. The test before the alarm is inverted, or a call does not pass an argument
    /// that the macro needs.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// G65 P9100 X10.
    /// M30
    /// O9100
    /// IF [#26 EQ #0] THEN #3000=1 (Z MISSING)
    /// G0 X#24 Z#26
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// G65 P9100 X10. Z5.
    /// IF [#500 EQ 0] THEN #3000=2 (TOOL WORN)
    /// M30
    /// O9100
    /// IF [#26 EQ #0] THEN #3000=1 (Z MISSING)
    /// G0 X#24 Z#26
    /// M99
    /// ```
    /// A program that is called gets its variables from its caller.
    /// ```nc,quiet,fanuc-mill
    /// O9100
    /// IF [#26 EQ #0] THEN #3000=1 (Z MISSING)
    /// M99
    /// ```
    rule "alarm-reached" in "flow" {
        summary: "program always ends with an alarm of its own",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::ENDS.union(Watch::ENDS_ELSEWHERE).union(Watch::FAULTS).union(Watch::ENDLESS).union(Watch::FOLLOWED),
            make: || Box::new(AlarmReached::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct AlarmReached {
    /// A path came to another end, to none, or to a jump that the control does not follow: corrected, it may lead past the alarm.
    may_end_otherwise: bool,
    /// What is reported if no path does.
    found: Option<Finding>,
}

remembers!(AlarmReached: found);

impl PathRule for AlarmReached {
    /// An alarm after a condition is what alarms are for.
    fn counts_on_some_path(&self) -> bool {
        false
    }

    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn fault(&mut self, _: &PathCx<'_>, fault: &Fault, _: &mut Report<'_>) {
        self.may_end_otherwise |= loses_way(fault);
    }

    /// A path that never ends is wrong in another way.
    fn endless(&mut self, _: &PathCx<'_>, _: At, _: &mut Report<'_>) {
        self.may_end_otherwise = true;
    }

    fn ended_elsewhere(&mut self, cx: &PathCx<'_>, ending: Ending, _: &mut Report<'_>) {
        let Some(number) = self.alarm(cx, ending) else { return };
        // The call in this file that leads there: its words are what the program can change.
        let frames = cx.state().frames();
        let Some(frame) = frames.iter().find(|frame| frame.caller.file == 0 && frame.entry.file != 0) else {
            return;
        };
        let (Some(file), Some(call)) = (cx.program.file(cx.origin().at.file), cx.range_of(frame.caller))
        else {
            return;
        };
        let label = alarm_in_words(number, text_of(cx));
        self.found.get_or_insert(
            Finding::new(&META, call, "the program called here always stops with its own alarm (`#3000`)")
                .label(label)
                .note(format!("the alarm is in `{}`", file.name))
                .help("give the macro the arguments that it needs")
                .assuming("its variables and modes are those that this program gives it")
                .at_most(Severity::Warning),
        );
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, _: &mut Report<'_>) {
        let Some(number) = self.alarm(cx, ending) else { return };
        // A loop before it may be what the other paths never leave, which is not known here.
        let start = cx.range().start;
        if cx.file_index.loops.iter().any(|turn| turn.begins && turn.range.start < start) {
            return;
        }
        // A program that waits for an input in a loop leaves it by the alarm on purpose.
        if cx.file_uses(|effect| effect == Effect::JumpUnlessInput) {
            return;
        }
        let in_macro = cx.state().frames().iter().any(|frame| frame.kind == FrameKind::Macro);
        if cx.file_index.is_called_from_elsewhere() && !in_macro {
            return;
        }
        let text = text_of(cx);
        let abort = text.as_deref().and_then(|text| abort_of(cx, text));
        let (message, label) = match (abort, text) {
            (Some((word, text)), _) => {
                (format!("the program always stops at its own `({word}, …)`"), format!("stops with: {text}"))
            }
            (None, text) => (
                "the program always ends with its own alarm (`#3000`)".to_owned(),
                alarm_in_words(number, text),
            ),
        };
        let mut finding = cx
            .finding(&META, cx.range(), message)
            .label(label)
            .note("with the values that the program sets, every path comes here")
            .help("give the macro the arguments that it needs, or correct the condition of the alarm");
        if reads_start_state(cx.program, cx.model, cx.environment) {
            finding = finding
                .at_most(Severity::Warning)
                .assuming("modes are those that the control has at the start");
        }
        self.found.get_or_insert(finding);
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        if let Some(finding) = self.found.take().filter(|_| !self.may_end_otherwise) {
            report.add(finding);
        }
    }
}

impl AlarmReached {
    /// The number of the alarm of its own with which the program ends, if all paths come here; notes another end.
    fn alarm(&mut self, cx: &PathCx<'_>, ending: Ending) -> Option<i64> {
        match ending {
            Ending::Alarm(number) => cx.is_on_every_path().then_some(number),
            _ => {
                self.may_end_otherwise = true;
                None
            }
        }
    }
}

fn alarm_in_words(number: i64, text: Option<String>) -> String {
    match text {
        Some(text) => format!("its own alarm {number}: {text}"),
        None => format!("its own alarm {number}"),
    }
}

/// The word and the text of a comment that stops the program.
fn abort_of(cx: &PathCx<'_>, comment: &str) -> Option<(String, String)> {
    let (word, text) = comment.split_once(',')?;
    let mut comments = cx.model.semantics().message_comments.iter();
    let (name, _) = comments
        .find(|(name, kind)| **kind == MessageComment::Abort && word.trim().eq_ignore_ascii_case(name))?;
    Some((name.clone(), text.trim().to_owned()))
}

/// The comment of the line, which the control shows with the alarm: the one after the assignment, also of a statement after `THEN`.
fn text_of(cx: &PathCx<'_>) -> Option<String> {
    let file = cx.program.file(cx.origin().at.file)?;
    let line = file.loaded.line_from(cx.range().start);
    let assigned = line.split_once("#3000").map_or(line, |(_, assigned)| assigned);
    let (_, rest) = assigned.split_once('(')?;
    let (text, _) = rest.split_once(')')?;
    let text = text.trim();
    (!text.is_empty()).then(|| text.to_owned())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{Called, World, check_rule, check_rule_in, findings, only, words};

    #[test]
    fn an_argument_that_a_macro_of_another_file_needs() {
        let called = Called(9100, "O9100\nIF [#26 EQ #0] THEN #3000=1 (Z MISSING)\nG0 X#24 Z#26\nM99\n");
        let world = World { programs: &called, ..World::default() };
        let program = |arguments: &str| format!("O1\nG65 P9100 {arguments}\nM30\n");
        check_rule_in(
            &RULE,
            "fanuc-mill",
            &program("X10."),
            &world,
            &expect![[r#"
            2 | G65 P9100 X10.
              | ^^^^^^^^^^^^^^ warning[alarm-reached] the program called here always stops with its own alarm (`#3000`)
        "#]],
        );
        for arguments in ["X10. Z5.", "X10. Z#500"] {
            check_rule_in(&RULE, "fanuc-mill", &program(arguments), &world, &expect![[""]]);
        }
    }

    #[test]
    fn a_loop_without_an_end_comes_to_no_alarm() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nIF [#150 GT 9999] GOTO900\n#1= 0\nWHILE [#1 LE 10] DO1\n#2= .1\nEND1\nM30\nN900 #3000= 9 (TOO HIGH)\n",
            &expect![""],
        );
    }

    #[test]
    fn a_missing_argument_is_shown_at_the_alarm() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nG65 P9100 X1.\nM30\nO9100\nIF [#26 EQ #0] THEN #3000= 1 (Z MISSING)\nM99\n",
            &expect![[r#"
                5 | IF [#26 EQ #0] THEN #3000= 1 (Z MISSING)
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[alarm-reached] the program always ends with its own alarm (`#3000`)
            "#]],
        );
    }

    #[test]
    fn the_text_is_the_comment_after_the_assignment() {
        let found = findings(
            &only(&RULE),
            "haas-mill",
            "O1\nN3000 (CHECK TOOL) #3000=5 (TOOL BROKEN)\nM30\n",
            &World::default(),
        );
        expect![[r#"
            the program always ends with its own alarm (`#3000`)
              here: its own alarm 5: TOOL BROKEN
              note: with the values that the program sets, every path comes here
              help: give the macro the arguments that it needs, or correct the condition of the alarm
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn an_alarm_on_some_path_is_what_alarms_are_for() {
        check_rule(&RULE, "haas-mill", "O1\nIF [#500 EQ 1] GOTO 9\nM30\nN9 #3000= 1 (NO)\n", &expect![[""]]);
    }

    #[test]
    fn a_loop_until_an_input_may_end_in_an_alarm() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nN5 M96 P10 Q18\nM99 P100\nN10 G4 P1.\nM99 P5\nN100 #3000= 10 (PART MISSING)\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_rests_on_the_modes_at_the_start_is_a_warning() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nIF [#4003 EQ 90] THEN #3000=1 (G91 FIRST)\nM30\n",
            &expect![[r#"
            2 | IF [#4003 EQ 90] THEN #3000=1 (G91 FIRST)
              | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[alarm-reached] the program always ends with its own alarm (`#3000`)
        "#]],
        );
    }
}
