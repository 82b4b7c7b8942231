//! A block that tilts the tool and omits a linear axis.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Axis, Event, Role, Travel};

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_tool;
use crate::facts::modes::resting_on_mode;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// Under 5-axis tool length compensation (`G143`) a block turns `A` or `B` and omits `X`, `Y` or `Z`.
    ///
    /// ## Why it matters
    /// When the tool tilts, its length points in another direction, and all three linear axes have to follow. The
    /// control moves only the axes that the block names: an axis that is omitted does not move, and the tip leaves its
    /// path.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G93 G1 X1. A5. B5. F12.
    /// G49
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G93 G1 X1. Y0. Z1. A5. B5. F12.
    /// X2. F12.
    /// G49
    /// M30
    /// ```
    rule "five-axis-axis-left-out" in "five_axis" {
        summary: "linear axis omitted while the tool tilts",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(FiveAxisAxisLeftOut) },
    }
}

struct FiveAxisAxisLeftOut;

impl PathRule for FiveAxisAxisLeftOut {
    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if !cx.state().effect(Role::Length, cx.model).is_some_and(is_along_tool) {
            if !cx.file_may_use(is_along_tool) {
                cx.enough();
            }
            return;
        }
        let Event::Travel(travel) = event else { return };
        let turning = turning(cx, travel);
        let letters = cx.origin().letters;
        let left_out: Vec<char> =
            ['X', 'Y', 'Z'].into_iter().filter(|axis| !letters.contains(Letter::of(*axis))).collect();
        let is_no_length = cx.state().tool_shift().along_tool() == Some(0.0);
        if cx.is_malformed()
            || turning.is_empty()
            || left_out.is_empty()
            || is_no_length
            || cx.has_effect(Effect::goes_to_machine_place)
        {
            return;
        }
        let Some(code) = cx.state().mode(Role::Length).only() else { return };
        let Some(code) = cx.control().code_at(code) else { return };
        let (name, does) = (code.number(), if left_out.len() == 1 { "does" } else { "do" });
        let (axes, turning_axes) = (list(&left_out), list(&turning));
        let tilts = if turning.len() == 1 { "tilts" } else { "tilt" };
        let range = cx.letter_range(turning.first().copied().unwrap_or('A'));
        let finding = cx
            .finding(&META, range, format!("{axes} {does} not move while {turning_axes} {tilts} the tool (`{name}`)"))
            .label(format!("the block omits {axes}"))
            .note(format!(
                "under `{name}` an axis that the block does not name does not move, even if the tilt asks for it  [{}]",
                code.entry().source
            ))
            .help(format!("write X, Y and Z in every block that turns the head, {axes} with its last value too"));
        report.add(resting_on_mode(cx, finding, Role::Length));
    }
}

/// Axes of the head that the block turns, as far as is known: a word for the present position does not turn.
fn turning(cx: &PathCx<'_>, travel: &Travel) -> Vec<char> {
    if travel.expanded {
        return Vec::new();
    }
    let turns = |axis: &Axis| {
        cx.origin().letters.contains(axis.letter())
            && travel.from.raw(*axis).to_bits() != travel.to.raw(*axis).to_bits()
    };
    [Axis::A, Axis::B].into_iter().filter(turns).map(Axis::name).collect()
}

/// `X`, `X and Y`, `X, Y and Z`.
fn list(axes: &[char]) -> String {
    let names: Vec<String> = axes.iter().map(|axis| format!("`{axis}`")).collect();
    match names.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        _ => names.concat(),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_block_says_what_stands_still() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nG0 X1. Y1. A5.\nB5.\nA5. B5. X2.\nG49\nA0. B0.\nM30\n",
            &expect![[r#"
                2 | G0 X1. Y1. A5.
                  |            ^^^ warning[five-axis-axis-left-out] `Z` does not move while `A` tilts the tool (`G143`)
                3 | B5.
                  | ^^^ warning[five-axis-axis-left-out] `X`, `Y` and `Z` do not move while `B` tilts the tool (`G143`)
            "#]],
        );
    }

    #[test]
    fn behind_a_block_skip_it_is_seen_too() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\n/G0 X1. B5.\nG49\nM30\n",
            &expect![[r#"
                2 | /G0 X1. B5.
                  |         ^^^ warning[five-axis-axis-left-out] `Y` and `Z` do not move while `B` tilts the tool (`G143`)
            "#]],
        );
    }
}
