//! A head comment that names other units than the code.

use std::ops::Range;

use gcheck_controls::Effect;

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A comment at the head of the program names millimetres or inches, and the code chooses the other unit.
    ///
    /// ## Why it matters
    /// One of the two was changed and the other forgotten. If the code is wrong, every distance is 25.4 times too long
    /// or too short.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// O00010 (PLATE)
    /// (UNITS: MM)
    /// G20 G90 G54
    /// G0 X1. Y1.
    /// M30
    /// ```
    /// ## Not reported
    /// Sizes of tools may be in any unit.
    /// ```nc,quiet,haas-mill
    /// O00010 (PLATE)
    /// (UNITS: INCH)
    /// (T1 6MM END MILL)
    /// G20 G90 G54
    /// M30
    /// ```
    rule "units-comment-contradicts" in "program" {
        summary: "comment names other units than the code",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

/// Lines that count as the head.
const HEAD_LINES: usize = 50;

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let control = cx.control();
    let chosen = |wanted: Effect| {
        let mut codes = cx.file_index.codes.iter();
        codes.find(|(number, _)| control.code(*number).is_some_and(|code| code.effect() == wanted))
    };
    // A program that uses both units does not contradict the comment.
    let (code, is_inch) = match (chosen(Effect::Inch), chosen(Effect::Millimetre)) {
        (Some(code), None) => (code, true),
        (None, Some(code)) => (code, false),
        _ => return,
    };
    for (start, line) in cx.lines().take(HEAD_LINES) {
        let Some(open) = line.find(['(', ';']) else { continue };
        let Some((says_inch, place)) = units_of(line.get(open..).unwrap_or_default()) else { continue };
        if says_inch == is_inch {
            return;
        }
        let start = start + open as u32;
        let place = start + place.start as u32..start + place.end as u32;
        report.add(finding(cx, place, code.1.clone(), is_inch));
        return;
    }
}

/// The units that a comment names for the program: it must be about units.
fn units_of(comment: &str) -> Option<(bool, Range<usize>)> {
    let upper = comment.to_ascii_uppercase();
    let units = upper.find("UNIT")?;
    let mut words = upper.split(|c: char| !c.is_ascii_alphabetic()).filter(|word| !word.is_empty());
    let of = |word: &str| match word {
        "INCH" | "INCHES" | "IMPERIAL" => Some(true),
        "MM" | "MILLIMETER" | "MILLIMETERS" | "MILLIMETRE" | "MILLIMETRES" | "METRIC" => Some(false),
        _ => None,
    };
    let is_inch = words.clone().find_map(of)?;
    // `UNITS MM OR INCH` says neither.
    if words.any(|word| of(word) == Some(!is_inch)) {
        return None;
    }
    let end = upper.get(units..)?.find(')').map_or(upper.len(), |at| units + at);
    Some((is_inch, units..end.max(units + 4)))
}

fn finding(cx: &FileCx<'_>, comment: Range<u32>, code: Range<u32>, is_inch: bool) -> Finding {
    let (says, does) = if is_inch { ("millimetres", "inches") } else { ("inches", "millimetres") };
    let name = cx.slice(code.clone());
    Finding::new(&META, comment, format!("the comment names {says}, the code chooses {does} (`{name}`)"))
        .label(format!("says that the program is in {says}"))
        .also(code, format!("chooses {does}"))
        .help("find out which one is right, and correct the other")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_comment_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "; units are inches\nG21\nG0 X1\nM2\n",
            &expect![[r#"
                1 | ; units are inches
                  |   ^^^^^^^^^^^^^^^^ warning[units-comment-contradicts] the comment names inches, the code chooses millimetres (`G21`)
            "#]],
        );
    }

    #[test]
    fn what_does_not_decide_is_left_alone() {
        check_rule(&RULE, "linuxcnc", "(UNITS MM OR INCH)\nG21\nG0 X1\nM2\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", "(UNITS MM)\nG20\nG0 X1\nG21\nM2\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", "(1 INCH END MILL)\nG21\nG0 X1\nM2\n", &expect![[""]]);
    }
}
