//! A value without a decimal point where the control counts least increments.

use gcheck_controls::{Code, Letter, LetterEntry, Motion, Unpointed, WordKind};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Edit, Environment, FileCx, Finding, Fix, Report, Run, Severity, limit};

declare_rule! {
    /// A length, an angle, a feed or an argument of a macro has no decimal point, and the control counts such numbers in least increments.
    ///
    /// ## Why it matters
    /// `X10` is then a hundredth of a millimetre, or a thousandth of an inch, and not ten. The tool moves to the wrong
    /// place at rapid, or feeds a thousand times too slow. A control can be set to read `X10` as ten; the finding names
    /// the setting that it assumes. One finding names all such words of a block. If much of a program is written like
    /// this, or very many of its blocks, the shop's controls are probably set that way, and there is one finding for the file.
    /// Values that only make sense in least increments, `Z0040000` or `U250` in a roughing cycle, are not reported. In a
    /// program in which no number has a point and some only make sense in least increments, all count least increments; only
    /// values below 100 are reported there.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G1 X10 Y2.5 F100.
    /// ```
    /// An argument of a macro counts in the same way, whatever the macro takes it for:
    /// ```nc,reported,haas-mill
    /// G65 P9100 A1 F10
    /// ```
    /// ## Not reported
    /// Zero is zero, with or without a point.
    /// ```nc,quiet,haas-mill
    /// G0 X0 Y0
    /// G1 X10. Y2.5 F100.
    /// ```
    /// A control that reads numbers without a point as whole units:
    /// ```nc,quiet,linuxcnc
    /// G1 X10 F100
    /// ```
    rule "missing-decimal-point" in "words" {
        summary: "no decimal point where the control counts least increments",
        severity: Warning,
        tier: Program,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

/// With so many blocks without a point, a file may count as written without points throughout; a short one with so few, where
/// fewer have points.
const HABIT: usize = 10;
const HABIT_OF_SHORT: usize = 4;
/// Nobody slips so often in one file, however long it is.
const HABIT_OF_LONG: usize = 50;

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if cx.control().numbers().unpointed == Unpointed::AsWritten {
        return;
    }
    let in_steps = counts_steps(cx);
    let mut count = 0_usize;
    let mut last = 0;
    for place in &cx.file_index.unpointed {
        cx.reread(place.clone(), |block| {
            if !scaled(block, in_steps).is_empty() {
                count += 1;
                last = place.start;
            }
        });
    }
    // Single blocks may be slips; a quarter of all blocks is not a slip.
    let pointed = cx.file_index.pointed;
    let is_habit = count >= HABIT_OF_LONG
        || count >= HABIT && count * 4 > pointed
        || count >= HABIT_OF_SHORT && count > pointed;
    let mut is_told = false;
    for block in &cx.file_index.unpointed {
        cx.reread(block.clone(), |block| {
            let words = scaled(block, in_steps);
            if words.is_empty() {
                return;
            }
            let found = finding(block, &words);
            if is_habit {
                let lines = cx.line_numbers([found.range.start, last]);
                report.add(of_file(found, count, lines));
            } else {
                report.add(found);
            }
            is_told = true;
        });
        if is_habit && is_told {
            return;
        }
    }
}

/// The block's words whose value the missing point changes.
fn scaled<'a>(cx: &BlockCx<'a>, in_steps: bool) -> Vec<&'a Word> {
    if calls_macro(cx) {
        return cx.words().iter().filter(|word| is_scaled_argument(cx, word, in_steps)).collect();
    }
    if !cx.words_are_plain() {
        return Vec::new();
    }
    cx.words().iter().filter(|word| is_scaled(cx, word, in_steps)).collect()
}

/// Does the block hand its words to a macro by a code of the control, as the only code that reads words?
fn calls_macro(cx: &BlockCx<'_>) -> bool {
    let mut codes = cx.code_words().map(|word| cx.control().code_at(word.code));
    !cx.block().flags.contains(BlockFlags::ERROR)
        && codes.next().flatten().is_some_and(|code| code.entry().any_words && !code.is_user())
        && codes.next().is_none()
}

/// Does the macro get another value than the argument shows?
fn is_scaled_argument(cx: &BlockCx<'_>, word: &Word, in_steps: bool) -> bool {
    let Some(value) = word.number().filter(|value| *value != 0.0) else { return false };
    let letter = word.letter.to_string();
    let semantics = cx.control().semantics();
    let entry = cx.control().letter(word.letter);
    let is_scaled = match &semantics.whole_arguments {
        Some(whole) => !whole.contains(&letter),
        None => entry.is_some_and(|entry| entry.scaled && entry.kind != WordKind::Feed),
    };
    let is_as_written =
        entry.is_some_and(|entry| matches!(setting(&cx.environment, entry), Setting::AsWritten));
    value.is_finite()
        && !word.shape.point
        && is_scaled
        && !is_as_written
        && semantics.argument_letters.contains_key(&letter)
        && !is_large(word, value, if in_steps { 100.0 } else { 10_000.0 })
}

/// Is the program one of least increments throughout: no number with a point, and some that make sense in no other way?
fn counts_steps(cx: &FileCx<'_>) -> bool {
    // Most programs have points, and need not be read again.
    if cx.file_index.unpointed.len() <= cx.file_index.pointed {
        return false;
    }
    let (mut has_points, mut has_steps) = (false, false);
    cx.each_block(|block| {
        for word in block.words() {
            let Some(value) = word.number() else { continue };
            let Some(entry) = block.control().letter(word.letter).filter(|entry| entry.scaled) else {
                continue;
            };
            has_points |= word.shape.point;
            has_steps |= entry.axis && !word.shape.point && is_large(word, value, 10_000.0);
        }
    });
    has_steps && !has_points
}

fn is_scaled(cx: &BlockCx<'_>, word: &Word, in_steps: bool) -> bool {
    let Some(value) = word.number().filter(|value| *value != 0.0) else { return false };
    let Some(entry) = cx.control().letter(word.letter).filter(|entry| entry.scaled) else { return false };
    let Some(facts) = cx.facts(word) else { return false };
    value.is_finite()
        && !word.shape.point
        && matches!(facts.kind, WordKind::Length | WordKind::Angle | WordKind::Feed)
        && (facts.code.is_some() || means_one_thing(cx, word.letter, entry))
        && !is_deliberate(word, facts.code, entry, in_steps)
        && !matches!(setting(&cx.environment, entry), Setting::AsWritten)
}

/// Is the value implausible in whole units? `Z+0040000`, and `U250` for a quarter of a millimetre in a roughing cycle,
/// are in least increments.
fn is_deliberate(word: &Word, code: Option<Code<'_>>, entry: &LetterEntry, in_steps: bool) -> bool {
    let from = match code.map(Code::motion) {
        Some(Motion::Operation) => 10.0,
        Some(Motion::Cycle) if !entry.axis && entry.kind != WordKind::Feed => 100.0,
        _ if in_steps => 100.0,
        _ => 10_000.0,
    };
    is_large(word, word.number().unwrap_or_default(), from)
}

/// Is the value that large, or padded with zeros?
fn is_large(word: &Word, value: f64, from: f64) -> bool {
    let (digits, value) = (word.shape.whole_digits, value.abs());
    let is_padded = digits >= 4 && value < 10_f64.powi(i32::from(digits) - 1);
    is_padded || value >= from
}

/// Without a code in the block, a word belongs to the motion or cycle in effect: do all of them read it as a length?
fn means_one_thing(cx: &BlockCx<'_>, letter: Letter, entry: &LetterEntry) -> bool {
    let lasting = cx.control().codes().filter(|code| code.group().modal && code.motion() != Motion::None);
    let mut words =
        lasting.flat_map(|code| &code.entry().words).filter(|w| Letter::parse(&w.letter) == Some(letter));
    entry.axis || words.all(|w| matches!(w.kind, WordKind::Length | WordKind::Angle | WordKind::Feed))
}

/// What a setting says about numbers without a point.
enum Setting {
    /// They count whole units.
    AsWritten,
    /// They count least increments; the assumption that this rests on.
    Assumed(String),
    /// They count least increments.
    Certain,
}

fn setting(environment: &Environment<'_>, entry: &LetterEntry) -> Setting {
    let numbers = environment.control().numbers();
    let name = entry.scale_setting.as_deref().or(numbers.unpointed_setting.as_deref());
    // The data writes the name as people say it: "Setting 162".
    let number = name.and_then(|name| name.rsplit(' ').next()).unwrap_or_default();
    let as_written = environment.control().setting(number).and_then(|s| s.as_written.as_deref());
    match environment.setting(number) {
        Some((value, _)) if as_written.is_some_and(|w| w.eq_ignore_ascii_case(value)) => Setting::AsWritten,
        Some((_, Some(assumption))) => Setting::Assumed(assumption),
        None if numbers.unpointed == Unpointed::ByParameter => Setting::Assumed(
            "numbers without a decimal point count least increments; a parameter may say otherwise"
                .to_owned(),
        ),
        Some((_, None)) | None => Setting::Certain,
    }
}

fn finding(cx: &BlockCx<'_>, words: &[&Word]) -> Finding {
    let numbers = cx.control().numbers();
    let texts: Vec<String> = words.iter().map(|word| format!("`{}`", cx.text(word))).collect();
    let (Some(word), [first, ..]) = (words.first(), texts.as_slice()) else {
        return Finding::new(&META, cx.block_range(), "decimal point missing");
    };
    let named =
        if texts.len() <= 4 { texts.join(" ") } else { format!("{first} and {} more", texts.len() - 1) };
    let mut finding = Finding::new(&META, cx.range(word), format!("decimal point missing: {named}"))
        .label(format!("counts {}", value(cx, word)))
        .note(format!(
            "a number without a decimal point counts least increments on this control  [{}]",
            numbers.source
        ))
        .help("write the decimal point")
        .at_most(limit(numbers.confidence))
        .at_most(if numbers.unpointed == Unpointed::ByParameter { Severity::Info } else { Severity::Error });
    for word in words.iter().skip(1) {
        finding = finding.also(cx.range(word), format!("counts {}", value(cx, word)));
    }
    for word in words {
        if let Some(entry) = cx.control().letter(word.letter)
            && let Setting::Assumed(assumption) = setting(&cx.environment, entry)
            && !finding.assumptions.contains(&assumption)
        {
            finding = finding.assuming(assumption);
        }
    }
    let insert = |word: &&Word| {
        let end = cx.range(word).end;
        Edit { range: end..end, text: ".".to_owned() }
    };
    let title = format!("write a decimal point after {named}");
    finding.fix(Fix { title, safe: false, edits: words.iter().map(insert).collect() })
}

/// The finding of a block, reworded for the whole file.
fn of_file(mut finding: Finding, count: usize, [first, last]: [u32; 2]) -> Finding {
    finding.message = format!("decimal points missing in {count} blocks of the program");
    finding.notes.insert(0, format!("the blocks are in lines {first} to {last}"));
    finding.label = format!("the first of them; here a number {}", finding.label);
    finding.labels.clear();
    finding.fixes.clear();
    finding.help =
        Some("configure that the control reads such numbers as whole units, or write the points".to_owned());
    finding
}

/// What the number means: "0.0100 inch or 0.100 mm".
fn value(cx: &BlockCx<'_>, word: &Word) -> String {
    let numbers = cx.control().numbers();
    let number = word.number().unwrap_or_default();
    if calls_macro(cx) {
        let (inch, mm) = (number * numbers.least_inch, number * numbers.least_mm);
        return format!("{inch:.4} (inch) or {mm:.3} (mm) in the macro");
    }
    match cx.facts(word).map(|facts| facts.kind) {
        Some(WordKind::Angle) => format!("{:.3} degrees", number * numbers.least_angle),
        Some(WordKind::Feed) => {
            format!(
                "{:.4} inch or {:.3} mm per minute",
                number * numbers.least_inch,
                number * numbers.least_mm
            )
        }
        _ => format!("{:.4} inch or {:.3} mm", number * numbers.least_inch, number * numbers.least_mm),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::MachineFacts;
    use crate::testing::{World, check_rule, check_rule_in, findings, fixed, only, words};

    #[test]
    fn one_finding_a_block_names_all_words() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X0 Y10 Z-2\nG4 P2\nG65 P9010 A1\nX#1 Y1.\nG43 H1\nG10 L2 P1 X-100\n",
            &expect![[r#"
                1 | G0 X0 Y10 Z-2
                  |       ^^^ warning[missing-decimal-point] decimal point missing: `Y10` `Z-2`
                3 | G65 P9010 A1
                  |           ^^ warning[missing-decimal-point] decimal point missing: `A1`
                6 | G10 L2 P1 X-100
                  |           ^^^^^ warning[missing-decimal-point] decimal point missing: `X-100`
            "#]],
        );
    }

    #[test]
    fn an_argument_of_a_macro_counts_steps_too() {
        // `F`, `D` and others count as they are written; so do the number of the program and the repeats.
        check_rule(
            &RULE,
            "haas-mill",
            "G65 P9010 L2 A1 B2. C0 F10\nG65 P9010 A#1\nG66 P9010 Z-2\n",
            &expect![[r#"
                1 | G65 P9010 L2 A1 B2. C0 F10
                  |              ^^ warning[missing-decimal-point] decimal point missing: `A1`
            "#]],
        );
    }

    #[test]
    fn a_setting_reads_numbers_as_written() {
        let machine = MachineFacts {
            settings: [("162".to_owned(), "on".to_owned())].into(),
            ..MachineFacts::default()
        };
        let world = World { machine, ..World::default() };
        // Setting 162 does not apply to R.
        check_rule_in(
            &RULE,
            "haas-mill",
            "G81 X1 Y1 Z-5 R2 F10.\n",
            &world,
            &expect![[r#"
                1 | G81 X1 Y1 Z-5 R2 F10.
                  |               ^^ warning[missing-decimal-point] decimal point missing: `R2`
            "#]],
        );
    }

    #[test]
    fn values_that_only_make_sense_in_steps_are_left_alone() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G71 U250 R500\nG71 P100 Q101 U2 W50 F0.2\nG0 Z+0040000\n",
            &expect![[r#"
                2 | G71 P100 Q101 U2 W50 F0.2
                  |               ^^ warning[missing-decimal-point] decimal point missing: `U2`
            "#]],
        );
    }

    #[test]
    fn a_program_of_least_increments_throughout() {
        let program = |last: &str| {
            format!(
                "G21G17G40G90\nG54G0X-50000Y-30000S1200M3\nG43Z5000H1\nG1Z-4000F120\nX40000\nY30000\nX-40000\n{last}\nG0Z50000\nM30\n"
            )
        };
        check_rule(&RULE, "fanuc-mill", &program("Y-10000"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("Y10"),
            &expect![[r#"
            8 | Y10
              | ^^^ warning[missing-decimal-point] decimal point missing: `Y10`
        "#]],
        );
        // A point somewhere else shows that the shop writes them.
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("Y-10."),
            &expect![[r#"
            3 | G43Z5000H1
              |    ^^^^^ warning[missing-decimal-point] decimal point missing: `Z5000`
            4 | G1Z-4000F120
              |   ^^^^^^ warning[missing-decimal-point] decimal point missing: `Z-4000`
        "#]],
        );
    }

    #[test]
    fn a_word_of_the_cycle_in_effect_may_be_a_count() {
        check_rule(&RULE, "fanuc-mill", "X10. Y10. K5\n", &expect![[""]]);
    }

    #[test]
    fn a_program_without_points_gets_one_finding() {
        let program = "G1 X1\n".repeat(12);
        let found = findings(&only(&RULE), "fanuc-mill", &program, &World::default());
        assert_eq!(found.len(), 1);
        expect![[r#"
            decimal points missing in 12 blocks of the program
              here: the first of them; here a number counts 0.0001 inch or 0.001 mm
              note: the blocks are in lines 1 to 12
              note: a number without a decimal point counts least increments on this control  [general knowledge; increment system IS-B with parameter 3401#0 = 0]
              assuming: setting 3401#0 (numbers without decimal point) is least increment
              help: configure that the control reads such numbers as whole units, or write the points
        "#]]
        .assert_eq(&words(&found[0]));
    }

    #[test]
    fn a_long_program_with_many_such_blocks_gets_one_finding() {
        let program = format!("{}{}", "G1 X1.\n".repeat(1_000), "X2\nX3.\n".repeat(60));
        let found = findings(&only(&RULE), "haas-mill", &program, &World::default());
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].message, "decimal points missing in 60 blocks of the program");
        assert_eq!(found[0].notes[0], "the blocks are in lines 1001 to 1119");
        let few = format!("{}{}", "G1 X1.\n".repeat(1_000), "X2\nX3.\n".repeat(40));
        assert_eq!(findings(&only(&RULE), "haas-mill", &few, &World::default()).len(), 40);
    }

    #[test]
    fn the_fix_writes_all_points() {
        let program = "N10 G1 X10 Y-2 F100\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            N10 G1 X10. Y-2. F100.
        "#]]
        .assert_eq(&fixed(program, &found[0]));
        assert!(!found[0].fixes[0].safe);
    }
}
