//! A program that does not end.

use std::ops::Range;

use gcheck_controls::{CodeNumber, Effect, Ends};
use gcheck_program::OKeyword;

use crate::declare::declare_rule;
use crate::facts::sections::{Section, keeps_programs_by_number, sections};
use crate::{FileCx, Finding, Fix, Report, Run, Severity};
use gcheck_lint::line_end;

declare_rule! {
    /// A program has no block that ends it: no `M30` or `M2`, and no `M99` for a subprogram.
    ///
    /// ## Why it matters
    /// The control reaches the end of the text with the spindle and coolant on, stops with an alarm, or runs on into
    /// the next program of the tape. A missing end often means that the file was cut off.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// G0 X10. Y10.
    /// G0 Z100.
    /// ```
    /// ```nc,reported,linuxcnc
    /// G0 X10 Y10
    /// G0 Z100
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// G0 X10. Y10.
    /// M30
    /// ```
    /// On some controls a pair of `%` lines ends the program too, and a file may consist of subroutines only.
    /// ```nc,quiet,linuxcnc
    /// %
    /// G0 X10 Y10
    /// %
    /// ```
    /// ```nc,quiet,linuxcnc
    /// o<drill> sub
    /// G0 X#1 Y#2
    /// o<drill> endsub
    /// ```
    rule "program-end-missing" in "program" {
        summary: "program does not end",
        severity: Warning,
        tier: Program,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let file_index = cx.file_index;
    let Some(last) = &file_index.last_block else { return };
    let syntax = cx.control().syntax();
    if syntax.tape_marks_end && file_index.tape_marks.len() >= 2 {
        return;
    }
    // A library of subroutines: what a caller runs ends with ENDSUB.
    if syntax.o_words && file_index.o_words.first().is_some_and(|o| o.keyword == OKeyword::Sub) {
        let is_behind = |range: &Range<u32>| range.start > last.start || range.contains(&last.start);
        if file_index.o_words.last().is_some_and(|o| o.keyword == OKeyword::EndSub && is_behind(&o.range)) {
            return;
        }
    }
    let sections = sections(cx);
    // If `O` does not number programs, the file is one program.
    let whole = [Section { number: None, range: 0..cx.region.end }];
    let sections = if keeps_programs_by_number(cx) { sections.as_slice() } else { whole.as_slice() };
    for section in sections {
        // In text order, as the sections are.
        let next = file_index.ends.partition_point(|e| e.range.start < section.range.start);
        let ends = file_index.ends.get(next).is_some_and(|e| e.range.start < section.range.end);
        if ends || !has_code(cx, section) {
            continue;
        }
        let is_last = section.range.contains(&last.start);
        // A loop by GOTO has its end elsewhere or needs none.
        let jumps_at_end = is_last && file_index.jumps.iter().any(|j| last.contains(&j.range.start));
        if !jumps_at_end {
            let fix = if is_last { end(cx, last) } else { None };
            let found = finding(cx, section, is_last.then(|| last.clone())).fix_if(fix);
            // Where nothing tells the control, a sender may send the program line by line.
            let has_form = section.number.is_some() || !file_index.tape_marks.is_empty();
            let is_optional = syntax.program_end_optional || cx.environment.control_is_unknown() && !has_form;
            report.add(if is_optional { as_streamed(found) } else { found });
        }
    }
}

/// More than the program's number: a block with a `G` or `M` code.
fn has_code(cx: &FileCx<'_>, section: &Section<'_>) -> bool {
    let (start, end) = (section.number.map_or(section.range.start, |n| n.range.end), section.range.end);
    let pieces = cx.text.from(start).take_while(|(from, _)| *from < end);
    let lines = pieces.flat_map(|(from, piece)| {
        let inside = ((end - from) as usize).min(piece.len());
        piece.get(..inside).unwrap_or_default().lines()
    });
    // Comments may hold anything; it is enough that some line is more than a comment.
    lines.skip(usize::from(section.number.is_some())).any(|line| {
        let line = line.trim_start();
        line.starts_with(|c: char| c.is_ascii_alphabetic() || c == '#' || c == '/')
    })
}

fn finding(cx: &FileCx<'_>, section: &Section<'_>, last: Option<Range<u32>>) -> Finding {
    let name = section.number.map(|n| format!(" `{}`", cx.slice(n.range.clone()))).unwrap_or_default();
    let is_at_block = last.is_some();
    let place = last.or_else(|| section.number.map(|n| n.range.clone())).unwrap_or_default();
    Finding::new(&META, place, format!("program{name} has no end"))
        .label(if is_at_block { "the last block" } else { "no `M30`, `M2` or `M99` before the next program" })
        .note("at the end of the text the control stops with an alarm or with everything still on  [general knowledge]")
        .help("end the program with `M30`, a subprogram with `M99`; check that the file is complete")
}

/// On a control that is sent one line after the other.
fn as_streamed(mut finding: Finding) -> Finding {
    finding.notes.clear();
    finding
        .note(
            "the control stops after the last line that is sent; spindle, coolant and modes stay as they are",
        )
        .at_most(Severity::Info)
}

/// An end of the program on the line below the last block.
fn end(cx: &FileCx<'_>, last: &Range<u32>) -> Option<Fix> {
    let ends = cx
        .control()
        .codes()
        .filter(|code| code.effect() == Effect::ProgramEnd && code.entry().ends == Some(Ends::Program));
    // `M30` if it only ends the program and returns to its head.
    let codes: Vec<CodeNumber> = ends.map(gcheck_controls::Code::number).collect();
    let code = codes.iter().find(|code| **code == CodeNumber::m(30)).or(codes.first())?;
    let (base, text) = cx.text.around(last.end);
    let rest = text.get((last.end - base) as usize..)?;
    let line_end = line_end(rest);
    let behind = last.end + gcheck_syntax::line_len(rest.as_bytes()) as u32;
    // After a tape mark the control may read nothing more: an end there would be missing again.
    if behind > cx.region.end || cx.slice(last.clone()).trim_start().starts_with('%') {
        return None;
    }
    let is_open = !text.get(..(behind - base) as usize)?.ends_with(['\n', '\r']);
    let before = if is_open { line_end } else { "" };
    let title = format!("end the program with `{code}`");
    Some(Fix::risky(title, behind..behind, format!("{before}{code}{line_end}")))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only};

    #[test]
    fn the_fix_ends_the_program_below_its_last_block() {
        let mended = |control: &str, program: &str| {
            let found = findings(&only(&RULE), control, program, &World::default());
            found.iter().map(|finding| fixed(program, finding)).collect::<String>()
        };
        assert_eq!(mended("haas-lathe", "%\r\nO1\r\nG0 X1.\r\n%\r\n"), "%\r\nO1\r\nG0 X1.\r\nM30\r\n%\r\n");
        assert_eq!(mended("haas-mill", "O1\nG0 X1. (END)"), "O1\nG0 X1. (END)\nM30\n");
        for control in gcheck_controls::names() {
            let after_mark = findings(&only(&RULE), control, "N10\n%#1\n", &World::default());
            assert!(
                after_mark.iter().all(|finding| finding.fixes.is_empty()),
                "{control}: the end is not read there"
            );
        }
    }

    #[test]
    fn each_program_of_a_file_needs_its_end() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nM98 P2\nM30\nO2\nG0 X1.\nO3\nM99\n",
            &expect![[r#"
            4 | O2
              | ^^ warning[program-end-missing] program `O2` has no end
        "#]],
        );
    }

    #[test]
    fn the_last_block_is_shown() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "%\nO1\nT0101\nG0 X1.\n(THE END)\n%\n",
            &expect![[r#"
            4 | G0 X1.
              | ^^^^^^ warning[program-end-missing] program `O1` has no end
        "#]],
        );
    }

    #[test]
    fn jumps_and_ends_under_conditions_are_enough() {
        check_rule(&RULE, "fanuc-mill", "O1\nN1 G0 X1.\nGOTO 1\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", "O1\nN1 G0 X1.\n/M30\nM0\n", &expect![[""]]);
    }

    #[test]
    fn a_subroutine_before_the_main_part_does_not_end_it() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 sub\no1 endsub\nG0 X1\n",
            &expect![[r#"
            3 | G0 X1
              | ^^^^^ warning[program-end-missing] program has no end
        "#]],
        );
    }
}
