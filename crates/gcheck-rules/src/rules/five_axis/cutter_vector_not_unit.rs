//! A vector of 3D cutter compensation whose length is not one.

use gcheck_engine::{Event, Role};
use gcheck_program::{Value, Word};

use crate::Edit;
use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_vectors;
use crate::facts::modes::resting_on_mode;
use crate::{Finding, Fix, PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// A block under 3D cutter compensation (`G141`) gives a direction `I J K` that is not a unit vector: I² + J² + K²
    /// is not 1.
    ///
    /// ## Why it matters
    /// The control shifts the path by the offset times the vector. If the vector is too long or too short, the shift is
    /// not the size of the tool, or the control refuses the block.
    ///
    /// ## How exactly
    /// Posted numbers are rounded, so the written digits decide. With n decimals each component may be off by half a
    /// unit of the last one, e = 0.5 / 10ⁿ. The vector is accepted if some vector of length 1 rounds to it: if the
    /// point of the box I ± e, J ± e, K ± e that is nearest to zero is not beyond 1, and the farthest is not short of
    /// it. So the length may differ from 1 by at most √3 · e, and I² + J² + K² by about twice that: 0.0017 with three
    /// decimals, 0.00017 with four. n is the largest number of decimals among the three, and at least two. A computed
    /// component counts as one with two decimals. A component that is not written is zero.
    ///
    /// The three numbers have the control's meaning: they are not lengths and are not converted between inch and
    /// millimetre, but a number without a decimal point counts least increments (`K1` is 0.0001 in inch).
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G1 G141 D1 X1. Y0. Z0. I0.5 J0.5 K0.5 F20.
    /// G40
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G1 G141 D1 X1. Y0. Z0. I0.577 J0.577 K0.577 F20.
    /// X2. I0. J0.6 K0.8
    /// X3. I#500 J0. K1.
    /// G40
    /// M30
    /// ```
    rule "cutter-vector-not-unit" in "five_axis" {
        summary: "direction of 3D cutter compensation that is not a unit vector",
        severity: Error,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(CutterVectorNotUnit) },
    }
}

struct CutterVectorNotUnit;

/// Letters of the three components.
const IJK: [char; 3] = ['I', 'J', 'K'];

/// Fewer decimals than these count as these: no post-processor rounds a direction to one digit.
const LEAST_DECIMALS: usize = 2;

impl PathRule for CutterVectorNotUnit {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::CutterVector(parts) = event else { return };
        let mode = cx.state().mode(Role::Compensation).only();
        let Some(mode) = mode.filter(|code| is_along_vectors(cx.model.effect(*code))) else { return };
        let words = IJK.map(|letter| cx.word(letter));
        let decimals = words.iter().flatten().map(|word| decimals(cx, word)).max().unwrap_or(0);
        let decimals = decimals.max(LEAST_DECIMALS);
        let errors = words.map(|word| match word.map(|word| word.value) {
            Some(Value::Expr(_)) => half_unit(LEAST_DECIMALS),
            _ => half_unit(decimals),
        });
        let given: Vec<(f64, f64)> =
            parts.iter().zip(errors).filter_map(|(part, error)| Some(((*part)?, error))).collect();
        if given.is_empty() || given.iter().any(|(part, _)| part.is_nan()) {
            return;
        }
        let [least, most] = lengths(&given);
        // A component that is not written is zero.
        if least > 1.0 || most < 1.0 {
            let finding = finding(cx, *parts, &words, decimals, mode);
            report.add(resting_on_mode(cx, finding, Role::Compensation));
        }
    }
}

fn finding(
    cx: &PathCx<'_>,
    parts: [Option<f64>; 3],
    words: &[Option<Word>; 3],
    decimals: usize,
    mode: gcheck_controls::CodeIx,
) -> Finding {
    let sum: f64 = parts.iter().flatten().map(|part| part * part).sum();
    let name = cx.name_of(mode);
    let written = words.iter().flatten();
    let base = cx.place().map_or(0, |place| place.base);
    let start = written.clone().map(|word| word.range().start).min();
    let end = written.clone().map(|word| word.range().end).max();
    let range = match (start, end) {
        // Other words may be between them; then the first component is marked.
        (Some(start), Some(end)) if stand_together(cx, start, end) => base + start..base + end,
        _ => cx.word_range(|word| words.iter().flatten().any(|part| part.range() == word.range())),
    };
    let shown = (sum * 1e4).round() / 1e4;
    let mut finding = cx
        .finding(
            &META,
            range,
            format!("direction is not a unit vector: I² + J² + K² is {shown}, not 1 (`{name}`)"),
        )
        .label(format!("its length is {}", (sum.sqrt() * 1e4).round() / 1e4))
        .help("post the direction as a unit vector, with four decimals or more");
    let is_unpointed =
        written.clone().any(|word| !word.shape.point && word.number().is_some_and(|n| n != 0.0));
    if is_unpointed && sum < 0.01 {
        finding = finding
            .note("a number without a decimal point counts least increments on this control, in `I J K` too")
            .help("write the decimal point: `K1.`");
    }
    if let Some(code) = cx.control().code_at(mode) {
        let entry = code.entry();
        finding = finding
            .note(format!("`I J K` of `{name}` must be a unit vector  [{}]", entry.source))
            .at_most(limit(entry.confidence));
    }
    if let Some(fix) = normalised(parts, words, base, sum.sqrt(), decimals) {
        finding = finding.fix(fix);
    }
    finding.at_most(cx.environment.most_for_this_control())
}

/// Only the three components and blanks between two places of the block.
fn stand_together(cx: &PathCx<'_>, start: u32, end: u32) -> bool {
    let Some(place) = cx.place() else { return false };
    let is_part = |word: &Word| IJK.iter().any(|letter| word.letter.ascii() == *letter as u8);
    place
        .table
        .words(place.block())
        .iter()
        .all(|word| is_part(word) || word.range().end <= start || word.range().start >= end)
}

/// The same direction with length 1, if all components are written as numbers.
fn normalised(
    parts: [Option<f64>; 3],
    words: &[Option<Word>; 3],
    base: u32,
    length: f64,
    decimals: usize,
) -> Option<Fix> {
    if length <= 0.0 || !length.is_finite() {
        return None;
    }
    let mut edits = Vec::new();
    for ((part, word), letter) in parts.into_iter().zip(words).zip(IJK) {
        let (part, word) = (part?, word.as_ref()?);
        word.number()?;
        let text = format!("{letter}{:.*}", decimals.max(4), part / length);
        let range = word.range();
        edits.push(Edit { range: base + range.start..base + range.end, text });
    }
    Some(Fix { title: "make it a unit vector of the same direction".to_owned(), safe: false, edits })
}

/// Half a unit of the last decimal.
fn half_unit(decimals: usize) -> f64 {
    0.5 / 10_f64.powi(i32::try_from(decimals).unwrap_or(i32::MAX))
}

/// The least and the greatest length of the vectors that round to these components, each with its rounding error.
fn lengths(parts: &[(f64, f64)]) -> [f64; 2] {
    let norm = |part: fn(f64, f64) -> f64| {
        parts.iter().map(|(value, error)| part(value.abs(), *error).powi(2)).sum::<f64>().sqrt()
    };
    // The last digit of the arithmetic is not a digit of the program.
    [norm(|value, error| (value - error).max(0.0)) - 1e-9, norm(|value, error| value + error) + 1e-9]
}

/// How many decimals a number is written with; `None` when it is computed.
fn decimals(cx: &PathCx<'_>, word: &Word) -> usize {
    let Some(place) = cx.place() else { return 0 };
    let file = cx.program.file(cx.origin().at.file);
    let range = place.base + word.range().start..place.base + word.range().end;
    let text = file.as_ref().map_or("", |file| file.loaded.slice(range));
    if word.number().is_none() {
        return 0;
    }
    let behind = text.split_once('.').map_or("", |(_, behind)| behind);
    behind.bytes().filter(u8::is_ascii_digit).count()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{RULE, half_unit, lengths};
    use crate::testing::{World, check_rule, findings, fixed, only, words};

    /// Directions of one block each.
    fn check(directions: &[&str], expected: &expect_test::Expect) {
        let mut program = "G90 G1 G141 D1 X0. Y0. Z0. I0. J0. K1. F20.\n".to_owned();
        for direction in directions {
            program.extend(["X1. ", direction, "\n"]);
        }
        check_rule(&RULE, "haas-mill", &(program + "G40\nM30\n"), expected);
    }

    #[test]
    fn the_digits_decide() {
        check(
            &[
                "I0.58 J0.58 K0.58",
                "I0.580 J0.580 K0.580",
                "I0.577 J0.577 K0.577",
                "I0.5770 J0.5770 K0.5770",
                "I0.7071 J0. K0.7071",
                "I0.707 J0. K0.708",
                "I.6 J.8 K0.",
                "I-1. J0. K0.",
            ],
            &expect![[r#"
                3 | X1. I0.580 J0.580 K0.580
                  |     ^^^^^^^^^^^^^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 1.0092, not 1 (`G141`)
                5 | X1. I0.5770 J0.5770 K0.5770
                  |     ^^^^^^^^^^^^^^^^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 0.9988, not 1 (`G141`)
            "#]],
        );
    }

    #[test]
    fn far_off() {
        check(
            &["I1. J1. K0.", "I0. J0. K0.", "I100. J-100. K0.", "I0.6 J0.6 K0.6", "I0. J0. K2."],
            &expect![[r#"
                2 | X1. I1. J1. K0.
                  |     ^^^^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 2, not 1 (`G141`)
                3 | X1. I0. J0. K0.
                  |     ^^^^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 0, not 1 (`G141`)
                4 | X1. I100. J-100. K0.
                  |     ^^^^^^^^^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 20000, not 1 (`G141`)
                5 | X1. I0.6 J0.6 K0.6
                  |     ^^^^^^^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 1.08, not 1 (`G141`)
                6 | X1. I0. J0. K2.
                  |     ^^^^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 4, not 1 (`G141`)
            "#]],
        );
    }

    #[test]
    fn a_part_that_is_left_out_is_zero() {
        check(
            &["I0.6 J0.7", "I1.5", "K1.", "I0.8 K0.7"],
            &expect![[r#"
                2 | X1. I0.6 J0.7
                  |     ^^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 0.85, not 1 (`G141`)
                3 | X1. I1.5
                  |     ^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 2.25, not 1 (`G141`)
                5 | X1. I0.8 K0.7
                  |     ^^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 1.13, not 1 (`G141`)
            "#]],
        );
    }

    #[test]
    fn without_a_decimal_point_it_counts_increments() {
        check(
            &["I0 J0 K1", "I10000 J0 K0"],
            &expect![[r#"
                2 | X1. I0 J0 K1
                  |     ^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 0, not 1 (`G141`)
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G1 G141 D1 X0. I0 J0 K1 F20.\nX1. I0 J0 K1000\nG40\nM30\n",
            &expect![[r#"
                1 | G21 G90 G1 G141 D1 X0. I0 J0 K1 F20.
                  |                        ^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 0, not 1 (`G141`)
            "#]],
        );
    }

    #[test]
    fn computed_parts_count_when_they_are_known() {
        check_rule(
            &RULE,
            "haas-mill",
            "#1=0.6\n#2=[SQRT[1-#1*#1]]\nG90 G1 G141 D1 X0. Y0. I#1 J#2 K0. F20.\nX1. I#1 J#1 K#1\nX2. I#500 J#1 K9.\nX3. I[#1+.4] J0. K[#2-.8]\nG40\nM30\n",
            &expect![[r#"
                4 | X1. I#1 J#1 K#1
                  |     ^^^^^^^^^^^ error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 1.08, not 1 (`G141`)
            "#]],
        );
    }

    #[test]
    fn arcs_elsewhere_are_no_directions() {
        check_rule(&RULE, "haas-mill", "G90 G1 X1. Y1. F20.\nG2 X2. Y2. I1. J0.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn the_fix_keeps_the_direction() {
        let program = "G90 G1 G141 D1 X1. I0.5 J-0.5 K.5 F20.\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            direction is not a unit vector: I² + J² + K² is 0.75, not 1 (`G141`)
              here: its length is 0.866
              note: `I J K` of `G141` must be a unit vector  [Haas 96-8000 rev R June 2007 p.153; Haas online manual, g141-3d-cutter-compensation; gcodes.net, G141; HM17 p.310]
              help: post the direction as a unit vector, with four decimals or more
              fix (unsafe): make it a unit vector of the same direction
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
        assert_eq!(fixed(program, &found[0]), "G90 G1 G141 D1 X1. I0.5774 J-0.5774 K0.5774 F20.\nM30\n");
    }

    #[test]
    fn every_unit_vector_is_accepted_as_it_is_rounded() {
        for (turn, tilt) in (0..90).flat_map(|turn| (0..45).map(move |tilt| (turn, tilt))) {
            let (turn, tilt) = (f64::from(turn) * 4.07, f64::from(tilt) * 4.03);
            let ((sin, cos), (up, down)) = (turn.to_radians().sin_cos(), tilt.to_radians().sin_cos());
            for decimals in 2..6 {
                let scale = 10_f64.powi(i32::try_from(decimals).unwrap());
                let round = |part: f64| ((part * scale).round() / scale, half_unit(decimals));
                let rounded = [up * cos, up * sin, down].map(round);
                let [least, most] = lengths(&rounded);
                assert!(least <= 1.0 && most >= 1.0, "{rounded:?}");
                // And what is accepted is off by no more than the page says.
                let written = rounded.iter().map(|(part, _)| part * part).sum::<f64>().sqrt();
                assert!((written - 1.0).abs() <= 3_f64.sqrt() * half_unit(decimals) + 1e-9, "{rounded:?}");
            }
        }
    }
}
