//! A threading move that does not say its lead.

use gcheck_controls::{Effect, Letter, Need};
use gcheck_engine::{Fact, Fault, Role};

use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A move is tied to the spindle, and nothing says how far the tool goes in one turn.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or cuts the thread at a lead left from before.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G97 S500 M3
    /// G0 X20. Z5.
    /// G32 Z-20.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G97 S500 M3
    /// G0 X20. Z5.
    /// G32 Z-20. F1.5
    /// M30
    /// ```
    rule "thread-without-lead" in "motion" {
        summary: "threading move without a lead",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ThreadWithoutLead) },
    }
}

struct ThreadWithoutLead;

impl PathRule for ThreadWithoutLead {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::MissingWord(letter) = *fault else { return };
        let mode = cx.state().mode(Role::Motion).only();
        let threads = matches!(mode.map(|ix| cx.model.effect(ix)), Some(Effect::Thread | Effect::RigidTap));
        if !threads || !matches!(letter.ascii(), b'F' | b'K') || asks_for_it(cx, letter) {
            return;
        }
        let Some(code) = cx.code_name(Role::Motion) else { return };
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!("threading move without a lead (`{code}` without `{letter}`)"),
            )
            .label(format!("`{letter}` is missing: how far the tool goes in one turn"))
            .help(format!("give the lead with `{letter}`"));
        report.add(cx.resting_on(finding, Fact::Mode(Role::Motion), &format!("`{code}`")));
    }
}

/// Does a code of the block need the word each time? Then a missing word has been reported already.
fn asks_for_it(cx: &PathCx<'_>, letter: Letter) -> bool {
    cx.codes().iter().copied().filter_map(|ix| cx.scene.control().code_at(ix)).any(|code| {
        let words = &code.entry().words;
        words.iter().any(|word| word.need == Need::Required && Letter::parse(&word.letter) == Some(letter))
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_block_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G18 G90 G0 X10 Z5\nS100 M3\nG33 Z-10 K1\nZ-20\nM2\n",
            &expect![[r#"
                4 | Z-20
                  | ^^^^ error[thread-without-lead] threading move without a lead (`G33` without `K`)
            "#]],
        );
    }

    #[test]
    fn the_feed_is_the_lead_on_lathes() {
        check_rule(&RULE, "haas-lathe", "G97 S500 M3\nF.05\nG0 X1. Z.1\nG32 Z-1.\nM30\n", &expect![""]);
    }
}
