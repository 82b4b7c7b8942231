//! Digits of a packed number that the control does not accept.

use gcheck_controls::{Code, Letter, PackedPart, WordEntry};

use crate::declare::declare_rule;
use crate::facts::callers::CallerValues;
use crate::{PathCx, PathRule, Remembers, Report, Run, Watch, limit, remembers};

declare_rule! {
    /// A number holds several others in its digits, and one of them is a value that the control does not accept: an angle of
    /// the tip in `P` of a threading cycle that no insert has.
    ///
    /// The number may be written or computed.
    ///
    /// ## Why it matters
    /// The control stops with an alarm. A wrong digit often means that the number is one digit too long or too short, so
    /// passes and pull-out are other ones too.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G40 G97 G99 S500 M3
    /// T0101
    /// G0 X30. Z5.
    /// G76 P010065 Q100 R0.05
    /// G76 X26.97 Z-20. P1534 Q450 F2.5
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G40 G97 G99 S500 M3
    /// T0101
    /// G0 X30. Z5.
    /// G76 P010060 Q100 R0.05
    /// G76 X26.97 Z-20. P1534 Q450 F2.5
    /// M30
    /// ```
    rule "packed-digits-not-allowed" in "words" {
        summary: "digits of a packed number that the control does not accept",
        severity: Error,
        tier: Path,
        control_specific: true,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(PackedDigitsNotAllowed::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct PackedDigitsNotAllowed {
    callers: CallerValues,
}

remembers!(PackedDigitsNotAllowed);

impl PathRule for PackedDigitsNotAllowed {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.callers.see(cx);
        if cx.is_malformed() || self.callers.may_decide(cx) {
            return;
        }
        for ix in cx.codes().iter() {
            let Some(code) = cx.control().code_at(*ix) else { continue };
            for word in code.entry().words.iter().filter(|word| !word.packed.is_empty()) {
                check(cx, code, word, report);
            }
        }
    }
}

fn check(cx: &PathCx<'_>, code: Code<'_>, word: &WordEntry, report: &mut Report<'_>) {
    let Some(letter) = Letter::parse(&word.letter) else { return };
    if !word.is_packed_beside(cx.origin().letters) {
        return;
    }
    let Some(number) = cx.known_number(char::from(letter.ascii())) else { return };
    let digits: u32 = word.packed.iter().map(|part| u32::from(part.digits)).sum();
    // Other rules report a fraction, a sign and a number that is too long.
    if number < 0.0 || number.fract() != 0.0 || number >= 10_f64.powf(f64::from(digits)) {
        return;
    }
    let mut rest = digits;
    for part in &word.packed {
        rest -= u32::from(part.digits);
        let value = (number / 10_f64.powf(f64::from(rest))).trunc() % 10_f64.powf(f64::from(part.digits));
        if !part.values.is_empty() && !part.values.iter().any(|own| (f64::from(*own) - value).abs() < 0.5) {
            tell(cx, code, word, (letter, number), (part, value), report);
        }
    }
}

fn tell(
    cx: &PathCx<'_>,
    code: Code<'_>,
    word: &WordEntry,
    (letter, number): (Letter, f64),
    (part, value): (&PackedPart, f64),
    report: &mut Report<'_>,
) {
    let (entry, width) = (code.entry(), usize::from(part.digits));
    let whole: usize = word.packed.iter().map(|part| usize::from(part.digits)).sum();
    let shown: Vec<String> = part.values.iter().map(|value| format!("{value:0width$}")).collect();
    let digits = format!("{value:0width$.0}");
    report.add(
        cx.finding(
            &META,
            cx.letter_range(char::from(letter.ascii())),
            format!("`{digits}` in `{letter}{number:0whole$.0}` of `{}` is not accepted", entry.code),
        )
        .label(format!("{}: {digits}", part.is))
        .note(format!(
            "`{}` ({}) takes {} for these digits  [{}]",
            entry.code,
            entry.title,
            shown.join(", "),
            entry.source
        ))
        .help("correct the digits, and count them: a digit too many or too few shifts the others")
        .at_most(limit(word.range_confidence.or(word.confidence).unwrap_or(entry.confidence))),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    const HEAD: &str = "G21 G40 G97 G99 S500 M3\nT0101\nG0 X30. Z5.\n";

    #[test]
    fn only_the_first_block_packs_its_number() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &format!(
                "{HEAD}G76 P12361 Q100 R0.05\nG76 P20029 Q100\nG76 X26.97 Z-20. P1561 Q450 F2.5\n#1=61\nG76 P[10000+#1]\nG76 P#100\nG76 P1000060\nM30\n"
            ),
            &expect![[r#"
                4 | G76 P12361 Q100 R0.05
                  |     ^^^^^^ warning[packed-digits-not-allowed] `61` in `P012361` of `G76` is not accepted
                8 | G76 P[10000+#1]
                  |     ^^^^^^^^^^^ warning[packed-digits-not-allowed] `61` in `P010061` of `G76` is not accepted
            "#]],
        );
    }
}
