//! A single pass of a lathe without an end point.

use gcheck_controls::{Code, Effect, LetterSet, load, names};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run};

declare_rule! {
    /// A code that turns, faces or threads in one pass (`G90`, `G92`, `G94` of system A; `G77`, `G78`, `G79` of system B; `G20`,
    /// `G21`, `G24` of system C) is in a block that gives the pass no end point.
    ///
    /// ## Why it matters
    /// The same number means something else in another G-code system: the limit of the spindle speed, feed per minute,
    /// millimetres. That is what is missing then: a lathe of system A has no limit after `G92 S2500`.
    ///
    /// `G90` of system A is not reported: where it is meant for absolute coordinates nothing is missing, because `X` and `Z` are
    /// absolute.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G40 G99 T0101
    /// G92 S2500
    /// G96 S180 M3
    /// G0 X64. Z0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G40 G90 G99 T0101
    /// G50 S2500
    /// G96 S180 M3
    /// G0 X64. Z2.
    /// G90 X60. Z-20. F.2
    /// M30
    /// ```
    rule "pass-without-end-point" in "cycles" {
        summary: "single turning pass without an end point",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

/// Words of an end point.
const END_POINT: LetterSet = LetterSet::of("XZUW");

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let is_odd = cx.block().flags.contains(BlockFlags::ERROR) || cx.words_may_be_arguments();
    if is_odd || cx.block().letters.intersects(END_POINT) {
        return;
    }
    let Some((word, code)) = cx.codes().find(|(_, code)| code.effect().is_turning_pass()) else { return };
    let meant = meant(cx, code);
    if meant.is_none_or(|(effect, _)| effect != Effect::Absolute) {
        report.add(finding(cx, word, code, meant));
    }
}

/// A mode, in words.
type Mode = (Effect, &'static str);

fn finding(cx: &BlockCx<'_>, word: &Word, code: Code<'_>, meant: Option<Mode>) -> Finding {
    let (name, title) = (cx.written(code), &code.entry().title);
    let finding = Finding::new(&META, cx.range(word), format!("`{name}` has no end point"))
        .label(format!("{title}: cuts nothing without `X` or `Z`"));
    let Some((meant, what)) = meant else {
        return finding.help("give the end point, or remove the code");
    };
    let finding = finding.note(format!("in another G-code system `{name}` means {what}"));
    match cx.control().codes().find(|own| own.effect() == meant) {
        Some(own) => finding.help(format!("for {what} write `{}`", own.entry().code)),
        None => finding.help("remove it, or choose the control that the program is written for"),
    }
}

/// What the number means on another control for lathes, if that is a mode that the programmer may have meant.
fn meant(cx: &BlockCx<'_>, code: Code<'_>) -> Option<Mode> {
    let others = names().iter().filter_map(|name| load(name).ok());
    let of_lathes = others.filter(|control| control.machine() == cx.control().machine());
    of_lathes.filter_map(|control| Some(control.code(code.number())?.effect())).find_map(|effect| {
        let what = match effect {
            Effect::Absolute => "absolute coordinates",
            Effect::Inch => "inches",
            Effect::Millimetre => "millimetres",
            Effect::FeedPerMinute => "feed per minute",
            Effect::SpeedLimitOrSetPosition => "the limit of the spindle speed",
            _ => return None,
        };
        Some((effect, what))
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_help_is_what_the_number_means_in_another_system() {
        let told = |control, text| {
            let found = findings(&only(&RULE), control, text, &World::default());
            found.iter().map(words).collect::<String>()
        };
        let found = [
            told("fanuc-lathe", "G21 G90 G40\nM30\n"),
            told("fanuc-lathe", "G92 S2500\nM30\n"),
            told("fanuc-lathe-c", "G21 G40 G90 G95\nM30\n"),
            told("fanuc-lathe", "G94 F200\nM30\n"),
        ];
        expect![[r#"
            `G92` has no end point
              here: threading cycle: cuts nothing without `X` or `Z`
              note: in another G-code system `G92` means the limit of the spindle speed
              help: for the limit of the spindle speed write `G50`
            `G21` has no end point
              here: threading cycle: cuts nothing without `X` or `Z`
              note: in another G-code system `G21` means millimetres
              help: for millimetres write `G71`
            `G94` has no end point
              here: facing cycle: cuts nothing without `X` or `Z`
              note: in another G-code system `G94` means feed per minute
              help: for feed per minute write `G98`
        "#]]
        .assert_eq(&found.concat());
    }

    #[test]
    fn a_thread_with_increments_has_an_end_point() {
        check_rule(&RULE, "fanuc-lathe", "G92 U-1. W-20. F1.5\nX29.\nM30\n", &expect![[""]]);
    }
}
