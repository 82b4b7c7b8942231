//! A second chuck that closes on a part that turns without it.

use gcheck_controls::{Code, Effect};
use gcheck_engine::{Event, Fact, Spindle};

use crate::declare::declare_rule;
use crate::facts::workholding::{MayRest, Moved, code_that, moved};
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// The secondary chuck closes (`M110`) while the main spindle turns, and the program has neither tied the two spindles together
    /// (`G199`) nor started the second one.
    ///
    /// ## Why it matters
    /// The part turns in the main chuck and is gripped by one that is at rest: it is twisted out of a chuck, or the jaws break.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G99 T101
    /// G97 S500 M3
    /// M111
    /// G98 G1 B-10. F50.
    /// M110
    /// M11
    /// M5
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G99 T101
    /// G97 S500 M3
    /// M111
    /// G199
    /// G98 G1 B-10. F50.
    /// M110
    /// M11
    /// M5
    /// M30
    /// ```
    rule "second-chuck-out-of-step" in "spindle" {
        summary: "secondary chuck closes on a part that turns without it",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CHANGES),
            make: || Box::new(SecondChuckOutOfStep::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct SecondChuckOutOfStep {
    /// The spindles are tied together, or the second one turns too.
    turns_too: bool,
    spindle: MayRest,
    /// The part may be in the second chuck alone.
    is_handed_over: bool,
}

remembers!(SecondChuckOutOfStep);

/// The modal group of the codes that tie the second spindle to the main one.
const SYNC: &str = "spindle-sync";
/// The modal groups of the codes that turn the second spindle, tie it to the main one, or make it the main one.
const TURNING: [&str; 3] = ["secondary-spindle", SYNC, "spindle-swap"];

fn closes(effect: Effect) -> bool {
    effect == Effect::SecondChuckClamp
}

impl PathRule for SecondChuckOutOfStep {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(closes)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.spindle.see(event);
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // Any code for the second spindle shows that the program has it in mind; what it then does is not followed.
        let has_it_in_mind = TURNING.iter().any(|group| moved(cx, group) == Some(Moved::Out));
        let is_user = cx.has_code(Code::is_user);
        self.turns_too |= has_it_in_mind || is_user || !cx.is_certain();
        self.is_handed_over |= cx.has_effect(|effect| effect == Effect::ChuckUnclamp);
        let turns = cx.state().spindle().is_some_and(Spindle::turns);
        let is_at_rest = !turns || self.spindle.is_so() || cx.has_effect(Effect::stops_spindle);
        if !cx.has_effect(closes) || is_at_rest || self.turns_too || self.is_handed_over {
            return;
        }
        let stop = cx.name_of_effect(Effect::SpindleStop).unwrap_or_default();
        let help = match code_that(cx.control(), SYNC, Moved::Out) {
            Some(tie) => format!(
                "tie the spindles together with `{}` before this block, or stop the main one with `{stop}`",
                tie.number()
            ),
            None => format!("stop the main spindle with `{stop}` before this block"),
        };
        let finding = cx
            .finding(
                &META,
                cx.effect_range(closes),
                "the secondary chuck closes while only the main spindle turns",
            )
            .label("grips a part that turns")
            .help(help);
        report.add(cx.resting_on(finding, Fact::Spindle, "the spindle"));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    fn program(before: &str) -> String {
        format!("G20 G99 T101\nG97 S500 M3\nM111\n{before}G98 G1 B-10. F50.\nM110\nM11\nM5\nM30\n")
    }

    #[test]
    fn both_spindles_turn_or_none() {
        let found = findings(&only(&RULE), "haas-lathe", &program(""), &World::default());
        expect![[r#"
            the secondary chuck closes while only the main spindle turns
              here: grips a part that turns
              there: the spindle set here
              help: tie the spindles together with `G199` before this block, or stop the main one with `M5`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        for before in ["G199\n", "M143 P500\n", "M5\n", "M19\n", "M0\n", "G65 P9077\n", "M11\n"] {
            check_rule(&RULE, "haas-lathe", &program(before), &expect![[""]]);
        }
    }
}
