//! A tool call that is inside a comment.

use std::ops::Range;

use memchr::{memchr2, memchr3};

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A comment holds a whole tool call (`T3 M06`, on a turret `T0303`), no block calls that tool, and what follows up to
    /// the next tool call is the work of the tool: its length offset (`H03`), on a turret the start of the spindle.
    ///
    /// ## Why it matters
    /// The control ignores the comment, and the tool before it goes on: with the length of another tool, or on a path
    /// that is not its own. Often two lines were joined, or a parenthesis has moved.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T2 M06
    /// G0 G90 G54 X0. Y0. S2800 M03
    /// G43 H02 Z50.
    /// G1 Z-8. F250.
    /// G0 Z50.
    /// (SIX HOLES T3 M06)
    /// G0 G90 G54 X50. Y0. S1500 M03
    /// G43 H03 Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T2 M06
    /// G0 G90 G54 X0. Y0. S2800 M03
    /// G43 H02 Z50.
    /// G1 Z-8. F250.
    /// G0 Z50.
    /// (SIX HOLES)
    /// T3 M06
    /// G0 G90 G54 X50. Y0. S1500 M03
    /// G43 H03 Z50.
    /// M30
    /// ```
    rule "tool-call-in-comment" in "tool" {
        summary: "tool call inside a comment, and the tool's work after it",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let tools = &cx.control().semantics().tools;
    let finds = if tools.change_by_t { turret_call } else { spindle_call };
    // Most programs have no such comment, and need no second look.
    let mut calls = Vec::new();
    for (start, run) in cx.runs() {
        let short = comments(run).filter(|(_, comment)| comment.len() <= LONGEST);
        let found = short.filter_map(|(at, comment)| {
            let (tool, place) = finds(comment)?;
            Some((tool, start + (at + place.start) as u32..start + (at + place.end) as u32))
        });
        calls.extend(found.take(MOST + 1));
        if calls.len() > MOST {
            return;
        }
    }
    for (tool, place) in calls {
        let shows =
            if tools.change_by_t { spindle_after(cx, tool, &place) } else { length_after(cx, tool, &place) };
        if let Some(proof) = shows {
            report.add(finding(cx, place, proof, tools.change_by_t));
        }
    }
}

/// A program with more such comments keeps its tool calls there on purpose.
const MOST: usize = 20;
/// Bytes of a comment that may hold a tool call: what is longer is not a remark, and its words would take several times its size.
const LONGEST: usize = 4_096;

/// `T3 M06` or `M6 T3` in a comment.
fn spindle_call(comment: &str) -> Option<(u32, Range<usize>)> {
    let words = words(comment);
    words.windows(2).find_map(|pair| {
        let [first, second] = pair else { return None };
        let gap = comment.get(first.place.end..second.place.start)?;
        let tool = match (first.letter, second.letter) {
            (b'T', b'M') if second.number == 6 => first.number,
            (b'M', b'T') if first.number == 6 => second.number,
            _ => return None,
        };
        (gap.trim().is_empty() && tool > 0).then_some((tool, first.place.start..second.place.end))
    })
}

/// `T0101` at the beginning of a comment; the tool is the station.
fn turret_call(comment: &str) -> Option<(u32, Range<usize>)> {
    let word = words(comment).into_iter().next()?;
    let leads = comment.get(..word.place.start)?.trim().is_empty();
    let is_call = word.letter == b'T' && word.place.len() == 5 && word.number >= 100;
    (leads && is_call).then_some((word.number / 100, word.place))
}

/// The length offset of the tool, before the next tool call; `None` if a block calls the tool.
fn length_after(cx: &FileCx<'_>, tool: u32, comment: &Range<u32>) -> Option<Range<u32>> {
    let mut proof = None;
    let mut is_open = true;
    let mut calls_others = false;
    for (start, line) in cx.lines() {
        for word in code_words(line) {
            match word.letter {
                b'T' if word.number == tool => return None,
                b'T' => {
                    calls_others |= start < comment.start;
                    is_open &= start < comment.start;
                }
                b'H' if is_open && start > comment.start && word.number == tool && proof.is_none() => {
                    proof = Some(start + word.place.start as u32..start + word.place.end as u32);
                }
                _ => {}
            }
        }
        if has_computed_tool(line) {
            return None;
        }
    }
    proof.filter(|_| calls_others)
}

/// The start of the spindle before the next tool call; `None` if a block calls the tool.
fn spindle_after(cx: &FileCx<'_>, tool: u32, comment: &Range<u32>) -> Option<Range<u32>> {
    let mut proof = None;
    let mut is_open = true;
    let mut calls_others = false;
    for (start, line) in cx.lines() {
        for word in code_words(line) {
            let station = if word.number >= 100 { word.number / 100 } else { word.number };
            match word.letter {
                b'T' if station == tool => return None,
                b'T' => {
                    calls_others = true;
                    is_open &= start < comment.start;
                }
                b'M' if is_open
                    && start > comment.start
                    && matches!(word.number, 3 | 4)
                    && proof.is_none() =>
                {
                    proof = Some(start + word.place.start as u32..start + word.place.end as u32);
                }
                _ => {}
            }
        }
        if has_computed_tool(line) {
            return None;
        }
    }
    proof.filter(|_| calls_others)
}

fn has_computed_tool(line: &str) -> bool {
    let code = line.split(['(', ';']).next().unwrap_or_default().as_bytes();
    code.windows(2).any(|pair| matches!(pair, [b'T' | b't', b'#' | b'[']))
}

/// A letter with a whole number.
struct Found {
    /// Upper case.
    letter: u8,
    number: u32,
    place: Range<usize>,
}

/// The words of a text, with their places in it. A word begins after something else than a letter or digit.
fn words(text: &str) -> Vec<Found> {
    let bytes = text.as_bytes();
    let mut found = Vec::new();
    for (at, letter) in bytes.iter().enumerate().filter(|(_, byte)| byte.is_ascii_alphabetic()) {
        let before = at.checked_sub(1).and_then(|before| bytes.get(before));
        let rest = text.get(at + 1..).unwrap_or_default();
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        let behind = rest.as_bytes().get(digits);
        let begins = before.is_none_or(|byte| !byte.is_ascii_alphabetic());
        let ends = behind.is_none_or(|byte| *byte != b'.' && *byte != b'/');
        let number = rest.get(..digits).and_then(|digits| digits.parse().ok());
        if let Some(number) = number.filter(|_| begins && ends) {
            found.push(Found { letter: letter.to_ascii_uppercase(), number, place: at..at + 1 + digits });
        }
    }
    found
}

/// The words of a line outside of comments.
fn code_words(line: &str) -> Vec<Found> {
    let comments: Vec<Range<usize>> = comments(line).map(|(at, text)| at..at + text.len()).collect();
    let is_code = |word: &Found| !comments.iter().any(|comment| comment.contains(&word.place.start));
    words(line).into_iter().filter(is_code).collect()
}

/// The comments of one or more lines, without their marks, each with its place. A comment ends with its line.
fn comments(lines: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let rest = lines.as_bytes().get(at..)?;
        let open = memchr2(b'(', b';', rest)?;
        let start = at + open + 1;
        let inside = lines.get(start..)?;
        let end = match rest.get(open) {
            Some(b';') => memchr2(b'\n', b'\r', inside.as_bytes()),
            _ => memchr3(b')', b'\n', b'\r', inside.as_bytes()),
        };
        let length = end.unwrap_or(inside.len());
        at = start + length;
        Some((start, inside.get(..length)?))
    })
}

fn finding(cx: &FileCx<'_>, place: Range<u32>, proof: Range<u32>, is_turret: bool) -> Finding {
    let call = cx.slice(place.clone());
    let word = cx.slice(proof.clone());
    let proves = if is_turret {
        format!("the work of a tool begins here (`{word}`)")
    } else {
        format!("the length of this tool is used here (`{word}`)")
    };
    Finding::new(&META, place, format!("tool call inside a comment (`{call}`)"))
        .label("the control ignores it, and no block calls this tool")
        .also(proof, proves)
        .help("put the tool call in a block of its own, outside of the comment")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn lathe(call: &str) -> String {
        format!(
            "O1\n{call}\nG50 S2500\nG97 S500 M03\nG0 X50. Z2.\nG1 Z-20. F0.2\nG0 X100. Z100.\nT0404 (PART OFF)\nG97 S400 M03\nG0 X60. Z-30.\nM30\n"
        )
    }

    #[test]
    fn a_turret_call_in_a_comment() {
        check_rule(
            &RULE,
            "haas-lathe",
            &lathe("(T0101 ROUGH TURN)"),
            &expect![[r#"
            2 | (T0101 ROUGH TURN)
              |  ^^^^^ warning[tool-call-in-comment] tool call inside a comment (`T0101`)
        "#]],
        );
    }

    #[test]
    fn a_turret_call_with_a_comment() {
        check_rule(&RULE, "haas-lathe", &lathe("T0101 (T0101 ROUGH TURN)"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-lathe",
            &lathe("(T0101 ROUGH TURN)\n(T0404 PART OFF)\nT0101"),
            &expect![[""]],
        );
    }

    #[test]
    fn a_list_of_tools_is_not_a_call() {
        check_rule(&RULE, "haas-lathe", &lathe("(T0303 SPARE)\n(T0404 PART OFF)\nT0101"), &expect![[""]]);
        check_rule(&RULE, "haas-lathe", &lathe("(T1 ROUGH TURN)"), &expect![[""]]);
    }

    #[test]
    fn a_tool_left_out_with_its_work() {
        let program =
            "T2 M6\nG0 G90 G54 X0. Y0.\nG43 H2 Z5.\n(T3 M6)\n(G43 H3 Z5.)\nT4 M6\nG43 H4 Z5.\nM30\n";
        check_rule(&RULE, "fanuc-mill", program, &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &program.replace("(G43 H3 Z5.)", "G43 H3 Z5."),
            &expect![[r#"
            4 | (T3 M6)
              |  ^^^^^ warning[tool-call-in-comment] tool call inside a comment (`T3 M6`)
        "#]],
        );
    }
}
