//! A value outside the range of its word.

use gcheck_controls::{Code, Letter, Unpointed, WordEntry, WordKind, spans};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::facts::computed_words::{is_among, is_in_gap, range_of};
use crate::{BlockCx, Finding, Reads, Report, Run, Severity, WordFacts, limit};

declare_rule! {
    /// A value is outside the range that its word has in this block, or is a fraction where the word counts something.
    ///
    /// ## Why it matters
    /// The control stops with an alarm when it reaches the block: an offset that does not exist, a peck of zero, a mode
    /// number that no manual lists.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G83 X1. Y1. Z-5. R1. Q0. F100.
    /// ```
    /// ```nc,reported,haas-mill
    /// G154 P120
    /// ```
    /// ```nc,reported,tsnc-yh-a1m
    /// G1 X100. F20000
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G154 P99
    /// G154 P#100
    /// ```
    rule "number-out-of-range" in "words" {
        summary: "value outside the range of its word",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE.union(BlockFlags::OUT_OF_RANGE), reads: Reads::Numbers, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let is_bound = |w: &WordEntry| {
        w.min.is_some() || w.max.is_some() || w.above.is_some() || !w.gaps.is_empty() || w.kind.is_whole()
    };
    let has_bounds = |code: Code<'_>| code.entry().words.iter().any(is_bound);
    let has_gap = |word: &Word| cx.control().letter(word.letter).is_some_and(|entry| !entry.gaps.is_empty());
    let may_be_in_gap = cx.words().iter().any(|word| has_gap(word) || word.letter == Letter::DOLLAR);
    if !cx.block().flags.contains(BlockFlags::OUT_OF_RANGE)
        && !may_be_in_gap
        && !cx.codes().any(|(_, code)| has_bounds(code))
    {
        return;
    }
    // Where a block has a point on a whole number, another rule reports every such word.
    let told = cx.block().flags.contains(BlockFlags::POINT_ON_INTEGER);
    for word in cx.words() {
        let Some(value) = word.number() else { continue };
        // Other rules judge sequence numbers and computed values.
        if word.letter.ascii() == b'N' || word.is_computed() {
            continue;
        }
        let Some(facts) = cx.facts(word) else { continue };
        let value = counted(cx, word, &facts, value);
        let nearest = nearest_reading(cx, word, &facts, value);
        let low =
            facts.min.is_some_and(|min| nearest < min) || facts.above.is_some_and(|above| value <= above);
        let high = facts.max.is_some_and(|max| nearest > max);
        // Another rule reports a minus sign that is not accepted.
        let is_sign = word.shape.minus && !facts.negative;
        if (low || high) && !is_sign && facts.kind != WordKind::Flag && cx.is_plain(&facts) {
            report.add(finding(cx, word, &facts, high));
        } else if let Some(assumed) = is_no_spindle(cx, word.letter, value).filter(|_| cx.is_plain(&facts)) {
            report.add(no_spindle(cx, word, &facts, assumed));
        } else if is_in_gap(value, &facts) && !is_sign && cx.is_plain(&facts) {
            report.add(in_gap(cx, word, &facts));
        } else if facts.kind.is_whole() && value.fract() != 0.0 {
            if !told && cx.is_plain(&facts) && has_meaning(cx, word, &facts) {
                report.add(fraction(cx, word, &facts, value));
            }
        } else if !facts.values.is_empty() && !is_among(value, &facts) && !is_sign && cx.is_plain(&facts) {
            report.add(unlisted(cx, word, &facts));
        }
    }
}

/// The value that the control takes: a factor without a point counts thousandths where other numbers count steps.
fn counted(cx: &BlockCx<'_>, word: &Word, facts: &WordFacts<'_>, value: f64) -> f64 {
    let in_thousandths = facts.kind == WordKind::Ratio
        && !word.shape.point
        && cx.control().numbers().unpointed != Unpointed::AsWritten;
    if in_thousandths { value / 1000.0 } else { value }
}

/// The smallest length that a control may read: a number without a point may count its least increments.
fn nearest_reading(cx: &BlockCx<'_>, word: &Word, facts: &WordFacts<'_>, value: f64) -> f64 {
    let numbers = cx.control().numbers();
    let may_be_steps = facts.kind == WordKind::Length
        && !word.shape.point
        && numbers.unpointed != Unpointed::AsWritten
        && cx.control().letter(word.letter).is_some_and(|letter| letter.scaled);
    if may_be_steps { value * numbers.least_mm.min(numbers.least_inch) } else { value }
}

/// Is it known what the word is? In a block without its code, the mode in effect may read it.
fn has_meaning(cx: &BlockCx<'_>, word: &Word, facts: &WordFacts<'_>) -> bool {
    facts.code.is_some() || cx.control().letter(word.letter).is_some_and(|entry| entry.free)
}

/// Decimals that controls leave away where a number counts.
const NEARLY_WHOLE: f64 = 1e-4;

fn fraction(cx: &BlockCx<'_>, word: &Word, facts: &WordFacts<'_>, value: f64) -> Finding {
    let text = cx.text(word);
    let of = facts.code.map(|code| format!(" for `{}`", cx.written(code))).unwrap_or_default();
    let finding = Finding::new(&META, cx.range(word), format!("value is not a whole number{of}: `{text}`"))
        .label(facts.is)
        .note(format!("`{}`{of} takes whole numbers  [{}]", word.letter, facts.source))
        .help("correct the value")
        .at_most(limit(facts.confidence));
    // A control may round a count; the number of a program it cannot.
    let is_refused = facts.whole && (value - value.round()).abs() > NEARLY_WHOLE;
    if facts.kind == WordKind::Program || is_refused { finding } else { finding.at_most(Severity::Warning) }
}

/// A number of spindles that is told or assumed.
struct Spindles {
    setting: String,
    /// The assumption to state.
    assumed: Option<String>,
}

/// Does the word name a spindle that the machine does not have?
fn is_no_spindle(cx: &BlockCx<'_>, letter: Letter, value: f64) -> Option<Spindles> {
    let setting = cx.control().semantics().refusals.spindles.as_ref().filter(|_| letter == Letter::DOLLAR)?;
    let (told, assumed) = cx.environment.setting(setting)?;
    let spindles: f64 = told.parse().ok()?;
    (value >= spindles).then(|| Spindles { setting: setting.clone(), assumed })
}

fn no_spindle(cx: &BlockCx<'_>, word: &Word, facts: &WordFacts<'_>, spindles: Spindles) -> Finding {
    let text = cx.text(word);
    let finding = Finding::new(&META, cx.range(word), format!("the machine has no such spindle: `{text}`"))
        .label(facts.is)
        .note(format!("spindles are numbered from 0  [{}]", facts.source));
    match spindles.assumed {
        None => finding.help("give the number of a spindle that the machine has").at_most(Severity::Warning),
        Some(assumed) => finding
            .assuming(assumed)
            .help(format!("if it has more spindles, say so: `[settings] {} = 3`", spindles.setting))
            .at_most(Severity::Info),
    }
}

fn in_gap(cx: &BlockCx<'_>, word: &Word, facts: &WordFacts<'_>) -> Finding {
    let of = facts.code.map(|code| format!(" for `{}`", cx.written(code))).unwrap_or_default();
    Finding::new(&META, cx.range(word), format!("value names nothing{of}: `{}`", cx.text(word)))
        .label(facts.is)
        .note(format!("`{}`{of} cannot be {}  [{}]", word.letter, spans(facts.gaps), facts.source))
        .help("correct the value")
        .at_most(limit(facts.range_confidence))
}

fn unlisted(cx: &BlockCx<'_>, word: &Word, facts: &WordFacts<'_>) -> Finding {
    let of = facts.code.map(|code| format!(" for `{}`", cx.written(code))).unwrap_or_default();
    Finding::new(&META, cx.range(word), format!("value is not among those{of}: `{}`", cx.text(word)))
        .label(facts.is)
        .note(format!("`{}`{of} takes {}  [{}]", word.letter, range_of(facts), facts.source))
        .help("correct the value")
        .at_most(limit(facts.range_confidence))
}

fn finding(cx: &BlockCx<'_>, word: &Word, facts: &WordFacts<'_>, high: bool) -> Finding {
    let text = cx.text(word);
    let side = if high { "large" } else { "small" };
    let of = facts.code.map(|code| format!(" for `{}`", cx.written(code))).unwrap_or_default();
    let thing = facts
        .code
        .map_or_else(|| word.letter.to_string(), |code| format!("{} {}", code.entry().code, word.letter));
    Finding::new(&META, cx.range(word), format!("value too {side}{of}: `{text}`"))
        .alarm(cx.alarm_of(META.id, &thing))
        .label(facts.is)
        .note(format!("`{}`{of} takes {}  [{}]", word.letter, range_of(facts), facts.source))
        .help("correct the value")
        .at_most(limit(facts.range_confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_code_of_the_block_gives_the_range() {
        check_rule(
            &RULE,
            "haas-mill",
            "G154 P120\nG154 P#1\nG154 P20\n",
            &expect![[r#"
                1 | G154 P120
                  |      ^^^^ error[number-out-of-range] value too large for `G154`: `P120`
            "#]],
        );
    }

    #[test]
    fn a_second_spindle_is_the_machines_own() {
        let program = "M3 S100 $1\nM2\n";
        check_rule(
            &RULE,
            "linuxcnc",
            program,
            &expect![[r#"
            1 | M3 S100 $1
              |         ^^ info[number-out-of-range] the machine has no such spindle: `$1`
        "#]],
        );
        let mut world = World::default();
        world.machine.settings.insert("SPINDLES".to_owned(), "2".to_owned());
        assert!(findings(&only(&RULE), "linuxcnc", program, &world).is_empty());
    }

    #[test]
    fn a_peck_of_nothing() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G83 X1. Z-5. R1. Q0. F100.\nG2 X1. I1. P2 F100.\n",
            &expect![[r#"
                1 | G83 X1. Z-5. R1. Q0. F100.
                  |                  ^^^ error[number-out-of-range] value too small for `G83`: `Q0.`
            "#]],
        );
    }

    #[test]
    fn a_count_is_whole_also_where_a_point_is_accepted() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G43 H7.5\nG43 H7.0\nG10 L2 P#1 X1.\n",
            &expect![[r#"
                1 | G43 H7.5
                  |     ^^^^ error[number-out-of-range] value is not a whole number for `G43`: `H7.5`
            "#]],
        );
        check_rule(&RULE, "haas-lathe", "G70 P100 Q200.5\n", &expect![""]);
    }

    #[test]
    fn words_name_the_range() {
        let found = findings(&only(&RULE), "haas-mill", "G154 P120\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("`P` for `G154` takes 1 to 99"), "{text}");
    }
}
