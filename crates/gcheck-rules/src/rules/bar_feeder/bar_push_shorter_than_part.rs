//! A part that is longer than the push of the bar.

use gcheck_engine::Event;
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::bar_feed::{Length, bar_feeder, is_bar_feed, length_range, lengths};
use crate::facts::parting::Parting;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The push of the bar (`J` of `G105`, `#3100`) is shorter than the part: the parting cut is farther from the face. Or the
    /// push of a new bar (`I`, `#3101`) is shorter than the part with its cutoff (`J`).
    ///
    /// The part is assumed to reach from `Z0` to the deepest cut across the centre. The width of the parting tool comes
    /// on top; it is not counted here.
    ///
    /// ## Why it matters
    /// The end of the bar does not reach `Z0`. The next part comes out too short, or its face is not cut.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20
    /// T404
    /// G97 S900 M3
    /// G0 X2.1 Z-1.625
    /// G1 X-0.04 F0.004
    /// G0 X6. Z6.
    /// M5
    /// G105 J1.5
    /// M99
    /// ```
    /// ```nc,reported,haas-lathe
    /// G20
    /// M5
    /// G105 J1. I0.5 K1.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20
    /// T404
    /// G97 S900 M3
    /// G0 X2.1 Z-1.625
    /// G1 X-0.04 F0.004
    /// G0 X6. Z6.
    /// M5
    /// G105 J1.75
    /// M99
    /// ```
    rule "bar-push-shorter-than-part" in "bar_feeder" {
        summary: "bar pushed by less than the part is long",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::MOVES),
            make: || Box::new(BarPushShorterThanPart { deepest: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct BarPushShorterThanPart {
    /// The deepest parting cut since the bar was fed last.
    deepest: Option<Parting>,
}

remembers!(BarPushShorterThanPart: deepest);

impl PathRule for BarPushShorterThanPart {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_bar_feed)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if bar_feeder(cx).is_none() {
            return;
        }
        if let Some(parting) = Parting::of(cx, event)
            && self.deepest.is_none_or(|deepest| parting.z < deepest.z)
        {
            self.deepest = Some(parting);
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(told) = lengths(event) else { return };
        // Zero is the reference position, whose length is on the control's page.
        let fits = cx.environment.machine.engine.bar.new_bar.is_none_or(|bar| told.part < bar);
        if told.initial > Mm::ZERO && told.part.0 - told.initial.0 > 1e-3 && fits && !cx.is_malformed() {
            report.add(new_bar_pushed_short(cx, told.initial, told.part));
        }
        let Some(parting) = self.deepest.take() else { return };
        let length = Mm(-parting.z.0);
        // Another rule reports a push of zero.
        if !(told.part > Mm::ZERO && length.0 - told.part.0 > 1e-3) {
            return;
        }
        let mut finding = cx
            .finding(&META, length_range(cx, Length::Part), "bar is pushed by less than the part is long")
            .label(format!(
                "pushes {}; the part is cut off {} from `Z0`",
                cx.shown(told.part),
                cx.shown(length)
            ))
            .assuming("`Z0` is at the face of the part")
            .help(
                "push by the part, the width of the parting tool and the facing allowance (`J` or its variable)",
            );
        if let Some(range) = cx.range_of(parting.at) {
            finding = finding.also(range, "cut off here");
        }
        report.add(finding);
    }
}

fn new_bar_pushed_short(cx: &PathCx<'_>, initial: Mm, part: Mm) -> crate::Finding {
    cx.finding(&META, length_range(cx, Length::Initial), "new bar is pushed by less than a part is long")
        .label(format!("pushes {}; a part with its cutoff takes {}", cx.shown(initial), cx.shown(part)))
        .note("the first part of each new bar comes out too short, or its face is not cut")
        .help("push a new bar by a part with its cutoff at least (`I` or its variable)")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

    #[test]
    fn in_the_cutoff_program_and_by_a_variable() {
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\nG20\n#3100=1.5\nG105 P2\nM99\nO2\nG0 X2.1 Z-1.625\nG1 X-0.04 F0.004\nG0 X6.\nM99\n",
            &expect![[r#"
                4 | G105 P2
                  | ^^^^ warning[bar-push-shorter-than-part] bar is pushed by less than the part is long
            "#]],
        );
    }

    #[test]
    fn holes_and_faces_are_no_partings() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G20\nG0 X2.1 Z0.\nG1 X-0.04 F0.004\nG0 X0. Z0.1\nG1 Z-3. F0.004\nG0 Z0.1\nM5\nG105 J1.5\nM99\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_is_not_known_is_not_compared() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G20\nG0 X2.1 Z#500\nG1 X-0.04 F0.004\nG0 X6.\nM5\nG105 J1.5\nM99\n",
            &expect![[""]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            "G20\nG0 X2.1 Z-2.\nG1 X-0.04 F0.004\nG0 X6.\nM5\nG105 J#500\nM99\n",
            &expect![[""]],
        );
    }

    /// Each part has its own cut.
    #[test]
    fn two_parts_of_two_lengths() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G20\nG0 X2.1 Z-2.\nG1 X0. F0.004\nG0 X6.\nM5\nG105 J2.1\nS900 M3\nG0 X2.1 Z-1.\nG1 X0.\nG0 X6.\nM5\nG105 J1.1\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_new_bar_is_pushed_by_a_part_at_least() {
        let found = |feed: &str| {
            let program = format!("O1\nG20\n{feed}\nM99\n");
            findings(&only(&RULE), "haas-lathe", &program, &World::default()).len()
        };
        let short = ["G105 J1. K1. I0.5", "G105 J1. K1. I[0.25*2]", "#3101=0.5\nG105 J1. K1."];
        assert_eq!(short.map(found), [1, 1, 1]);
        let right = [
            "G105 J1. K1. I1.2",
            "G105 J1. K1. I1.",
            "G105 J1. K1. I0.",
            "G105 J1. K1.",
            "G105 J1. K1. I#500",
        ];
        assert_eq!(right.map(found), [0; 5]);
    }
}
