//! A called program that does not return.

use gcheck_controls::{Effect, Ends};
use gcheck_engine::{At, Ending, Fault, FrameKind};

use crate::declare::declare_rule;
use crate::facts::program_calls::ProgramEnds;
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// A program that is called has no return (`M99`): it ends with `M30`, or runs to the end of the text. Where it is in another
    /// file, the call is marked.
    ///
    /// ## Why it matters
    /// The calling program never finishes: `M30` in the subprogram ends the whole job, and at the end of the text the
    /// control stops with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// M98 P2
    /// G0 X0.
    /// M30
    /// O0002
    /// G0 X10.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// M97 P100
    /// M30
    /// N100 G0 X1.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// M98 P2
    /// M30
    /// O0002
    /// IF [#500 GT 10] GOTO 90
    /// M99
    /// N90 M30
    /// ```
    rule "subprogram-without-return" in "flow" {
        summary: "called program that does not return",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::ENDS.union(Watch::FAULTS).union(Watch::ENDS_ELSEWHERE),
            make: || Box::new(SubprogramWithoutReturn),
        },
    }
}

struct SubprogramWithoutReturn;

impl PathRule for SubprogramWithoutReturn {
    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        match ending {
            Ending::Program => check(cx, false, report),
            // A `%` after the last line ends the text as well.
            Ending::Tape => check(cx, true, report),
            _ => {}
        }
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault == Fault::NoProgramEnd {
            check(cx, true, report);
        }
    }

    fn ended_elsewhere(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        let at_end_of_text = match ending {
            Ending::Program => false,
            Ending::Text | Ending::Tape => true,
            _ => return,
        };
        let Some(frame) = cx.state().frames().last() else { return };
        let is_program = matches!(frame.kind, FrameKind::Subprogram | FrameKind::Macro);
        let (Some(file), Some(call)) = (cx.program.file(frame.entry.file), cx.range_of(frame.caller)) else {
            return;
        };
        // A bar feed has a rule of its own for its cutoff program.
        let is_bar_feed = cx.find_word(frame.caller, |word| cx.model.effect(word.code) == Effect::BarFeed);
        // A control without a return ends the programs that it calls in other ways.
        let has_return = cx.name_of_effect(Effect::Return).is_some();
        // If the called program has a return anywhere, this end is one of several.
        if !is_program
            || !has_return
            || is_bar_feed.is_some()
            || ProgramEnds::of(cx, frame.entry).is_none_or(|ends| ends.returns)
        {
            return;
        }
        let (message, label) = if at_end_of_text {
            ("the program called here has no return (`M99`)", "runs to the end of its text")
        } else {
            (
                "the program called here ends the whole job: no return (`M99`)",
                "does not come back to this program",
            )
        };
        report.add(
            Finding::new(&META, call, message)
                .label(label)
                .note(format!("the program is in `{}`", file.name))
                .help("end the called program with `M99`")
                .at_most(Severity::Warning),
        );
    }
}

fn check(cx: &PathCx<'_>, at_end_of_text: bool, report: &mut Report<'_>) {
    let Some(frame) = cx.state().frames().last() else { return };
    if frame.entry.file != 0
        || !matches!(
            frame.kind,
            FrameKind::Subprogram | FrameKind::Local | FrameKind::Macro | FrameKind::OWord
        )
    {
        return;
    }
    if frame.kind == FrameKind::OWord {
        // Its text has an end of its own, which a condition may leave to another way.
        if !at_end_of_text && cx.is_on_every_path() {
            let finding = cx
                .finding(&META, cx.range(), "called subroutine ends the whole job")
                .label("ends here, and does not return to its caller")
                .help("end the program after the call, or return before this block")
                .at_most(Severity::Warning);
            report.add(finding);
        }
        return;
    }
    let Some(entry) = cx.range_of(frame.entry) else { return };
    let Some(file) = cx.program.file(0) else { return };
    let part = file.loaded.flow_graph().part_of(frame.entry.block);
    let end = cx.range_of(At { file: 0, block: part.end }).map_or(u32::MAX, |next| next.start);
    // If the called program has a return anywhere, this end is one of several.
    let returns = |range: std::ops::Range<u32>| {
        cx.file_index
            .ends
            .iter()
            .any(|mark| mark.ends == Ends::Subprogram && range.contains(&mark.range.start))
    };
    let own = match frame.kind {
        FrameKind::Local => entry.start..cx.range().end.min(end),
        _ => entry.start..end,
    };
    if returns(own) {
        return;
    }
    let (message, label) = if at_end_of_text {
        ("called program has no return (`M99`)", "runs to the end of the text")
    } else {
        (
            "called program ends the whole job: no return (`M99`)",
            "ends here, and does not return to its caller",
        )
    };
    let finding = cx
        .finding(&META, cx.range(), message)
        .label(label)
        .also(entry, "the called program begins here")
        .help("end the called program with `M99`");
    // Where the manual names the alarm, the end of the text is one.
    let number = cx.model.semantics().missing_return_alarm.clone().filter(|_| at_end_of_text);
    report.add(if number.is_some() { finding.alarm(number) } else { finding.at_most(Severity::Warning) });
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::RULE;
    use crate::testing::{Called, World, check_rule, check_rule_in};

    fn check_beside(program: &str, beside: &'static str, expected: &Expect) {
        let world = World { programs: &Called(2, beside), ..World::default() };
        check_rule_in(&RULE, "fanuc-mill", program, &world, expected);
    }

    #[test]
    fn in_another_file_the_call_is_marked() {
        let main = "O1\nM98 P2\nG0 X0.\nM30\n";
        check_beside(
            main,
            "O2\nG0 X1.\nM30\n",
            &expect![[r#"
                2 | M98 P2
                  | ^^^^^^ warning[subprogram-without-return] the program called here ends the whole job: no return (`M99`)
            "#]],
        );
        check_beside(
            "O1\nG65 P2 A1.\nM30\n",
            "O2\nG0 X#1\n",
            &expect![[r#"
                2 | G65 P2 A1.
                  | ^^^^^^^^^^ warning[subprogram-without-return] the program called here has no return (`M99`)
            "#]],
        );
        check_beside(
            "O1\nIF [#500 EQ 1] GOTO 10\nM98 P2\nN10 M30\n",
            "O2\nG0 X1.\nM30\n",
            &expect![[r#"
                3 | M98 P2
                  | ^^^^^^ warning[subprogram-without-return] the program called here ends the whole job: no return (`M99`)
            "#]],
        );
        check_beside(main, "O2\nIF [#500 GT 10] GOTO 90\nM99\nN90 M30\n", &expect![[""]]);
        check_beside(main, "O2\nG0 X1.\nM99\n", &expect![[""]]);
    }

    #[test]
    fn the_end_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nM98 P2\nM30\nO2\nG0 X1.\nM30\n",
            &expect![[r#"
            6 | M30
              | ^^^ warning[subprogram-without-return] called program ends the whole job: no return (`M99`)
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG65 P2 A1.\nM30\nO2\nG0 X#1\n",
            &expect![[r#"
            5 | G0 X#1
              | ^^^^^^ warning[subprogram-without-return] called program has no return (`M99`)
        "#]],
        );
    }

    #[test]
    fn behind_a_condition_the_end_of_the_text_is_marked_too() {
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\nG21 G90\nM98 P1001\nM30\nO1001\nIF [#110 EQ 1.] GOM98 P2\n",
            &expect![[r#"
            6 | IF [#110 EQ 1.] GOM98 P2
              | ^^^^^^^^^^^^^^^^^^^^^^^^ warning[subprogram-without-return] called program has no return (`M99`)
        "#]],
        );
    }

    #[test]
    fn the_end_of_a_job_on_purpose_stands_beside_a_return() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nM97 P10\nM30\nN10 IF [#500 EQ 1] GOTO 20\nM99\nN20 M30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_main_program_may_end_as_it_likes() {
        check_rule(&RULE, "haas-mill", "O1\nG0 X1.\n", &expect![[""]]);
    }
}
