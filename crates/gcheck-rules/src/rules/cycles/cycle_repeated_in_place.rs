//! A canned cycle that is repeated at one place.

use gcheck_controls::{CodeIx, Effect, Letter};
use gcheck_engine::{Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::cycles::{is_cycle, is_round_pocket};
use crate::facts::offset_schemes::whole;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};

declare_rule! {
    /// A canned cycle repeats (`L`, `K`) while positions are absolute (`G90`).
    ///
    /// ## Why it matters
    /// The same hole is drilled again and again: a tap cuts its thread away, a drill rubs. A row of holes by a repeat
    /// count needs increments (`G91`).
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G54 G0 X0. Y0. Z10.
    /// G81 X10. Z-5. R2. K5 F100.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G54 G0 X0. Y0. Z10.
    /// G91 G81 X10. Z-7. R-8. K5 F100.
    /// G90 G80
    /// M30
    /// ```
    rule "cycle-repeated-in-place" in "cycles" {
        summary: "canned cycle repeated at one place",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS.union(Watch::RAPIDS), make: || Box::new(CycleRepeatedInPlace) },
    }
}

struct CycleRepeatedInPlace;

impl PathRule for CycleRepeatedInPlace {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| is_cycle(effect) || is_round_pocket(effect))
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        judge(cx, report);
    }

    /// A block without a code: its first move goes to the hole.
    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        if cx.codes().is_empty() {
            judge(cx, report);
        }
    }
}

fn judge(cx: &PathCx<'_>, report: &mut Report<'_>) {
    let letter = cx.model.semantics().cycles.repeat;
    if !cx.origin().letters.contains(Letter::of(letter)) {
        return;
    }
    let Some(cycle) = repeated(cx) else { return };
    let is_absolute = match cx.code_of_role(Role::Distance) {
        Some(code) => cx.model.effect(code) == Effect::Absolute,
        None => cx.state().is_incremental(cx.model) == Some(false),
    };
    let reads = cx.control().code_at(cycle).is_some_and(|code| code.reads().contains(Letter::of(letter)));
    // A cycle that gives the letter another meaning has no repeats.
    if !is_absolute || !reads {
        return;
    }
    let Some(times) = cx.known_number(letter).and_then(whole).filter(|times| *times > 1) else { return };
    // Words that are always increments move each repeat on.
    let own = cx.model.semantics().increments.keys().filter_map(|key| Letter::parse(key));
    if own.into_iter().any(|letter| cx.origin().letters.contains(letter)) {
        return;
    }
    let name = cx.name_of(cycle);
    let absolute = cx.name_of_effect(Effect::Absolute).unwrap_or_default();
    let incremental = cx.name_of_effect(Effect::Incremental).unwrap_or_default();
    let finding = cx
        .finding(
            &META,
            cx.letter_range(letter),
            format!("the cycle runs {times} times at one place (`{name}` under `{absolute}`)"),
        )
        .label("every repeat goes to the same position")
        .help(format!(
            "give the distance from hole to hole in increments (`{incremental}`), or remove `{letter}`"
        ))
        .at_most(Severity::Warning);
    report.add(match cx.code_of_role(Role::Distance) {
        Some(_) => finding,
        None => cx.resting_on(finding, Fact::Mode(Role::Distance), &format!("`{absolute}`")),
    });
}

/// The cycle that the block runs: its own, or the one in effect in a block that only goes to a position.
fn repeated(cx: &PathCx<'_>) -> Option<CodeIx> {
    let pocket = cx.codes().iter().copied().find(|code| is_round_pocket(cx.model.effect(*code)));
    let own = pocket.or_else(|| cx.code_of_role(Role::Cycle));
    let cycle = match own {
        Some(own) => own,
        None if cx.names_axes()
            && cx.codes().iter().all(|code| cx.model.role(*code) == Some(Role::Distance)) =>
        {
            cx.state().active_cycle(cx.model)?
        }
        None => return None,
    };
    let effect = cx.model.effect(cycle);
    (is_cycle(effect) || is_round_pocket(effect)).then_some(cycle)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn once_is_no_repeat_and_nought_drills_nothing() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0. Z1.\nG81 X1. Z-1. R.1 L1 F10.\nG83 X2. Z-1. R.1 Q.1 L0\nG80\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_mode_of_the_block_itself_counts() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G91 G0 X0 Y0\nG90 G81 X10 Z-5 R2 L3 F100\nG80\nM2\n",
            &expect![[r#"
                2 | G90 G81 X10 Z-5 R2 L3 F100
                  |                    ^^ warning[cycle-repeated-in-place] the cycle runs 3 times at one place (`G81` under `G90`)
            "#]],
        );
    }
}
