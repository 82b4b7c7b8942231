//! A parts catcher that stays under the spindle.

use gcheck_controls::Code;
use gcheck_engine::{At, Ending, Event};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range, ends_at_tape_mark};
use crate::facts::workholding::{Moved, code_that, moved};
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// The program brings the parts catcher out (`M36`), and changes the tool or ends without taking it back (`M37`). A stop of the
    /// program between shows that the operator may do it. Controls whose data name no such codes are not judged.
    ///
    /// ## Why it matters
    /// The catcher is in the way of the turret: the next tool, or the next part, runs into it.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G99 T404
    /// G97 S600 M3
    /// G0 X2.1 Z-1.
    /// M36
    /// G1 X-0.04 F.002
    /// G0 X2.1
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G99 T404
    /// G97 S600 M3
    /// G0 X2.1 Z-1.
    /// M36
    /// G1 X-0.04 F.002
    /// M37
    /// G0 X2.1
    /// M30
    /// ```
    rule "parts-catcher-left-out" in "tool" {
        summary: "parts catcher left out at a tool change or at the end",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CHANGES).union(Watch::ENDS),
            make: || Box::new(PartsCatcherLeftOut::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct PartsCatcherLeftOut {
    /// The block that brought the catcher out.
    out: Option<At>,
}

remembers!(PartsCatcherLeftOut: out);

const GROUP: &str = "parts-catcher";

impl PathRule for PartsCatcherLeftOut {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let control = program.environment.control();
        let mut codes = program.file_index.codes.iter();
        codes.any(|(number, _)| {
            control.code_at(control.code_ix(*number)).is_some_and(|code| code.entry().group == GROUP)
        })
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_user = cx.has_code(Code::is_user);
        match moved(cx, GROUP) {
            Some(Moved::Out) => self.out = Some(cx.origin().at),
            Some(Moved::Back) => self.out = None,
            None if is_user || !cx.is_certain() => self.out = None,
            None => {
                if let Some(boundary) = boundary(cx) {
                    self.judge(cx, boundary, report);
                }
            }
        }
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if matches!(event, Event::Stop(_)) {
            self.out = None;
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            self.judge(cx, Boundary::ProgramEnd, report);
        }
    }
}

impl PartsCatcherLeftOut {
    fn judge(&mut self, cx: &PathCx<'_>, boundary: Boundary, report: &mut Report<'_>) {
        let Some(at) = self.out.take() else { return };
        let Some(back) = code_that(cx.control(), GROUP, Moved::Back) else { return };
        let back = back.number();
        let mut finding = cx
            .finding(
                &META,
                boundary_range(cx, boundary),
                format!("the parts catcher is still out {}", boundary.words()),
            )
            .label(format!("no `{back}` before this"))
            .assuming("nothing else takes the catcher away")
            .help(format!("take the catcher away with `{back}` after the part is cut off"));
        if let Some((_, range)) = cx.find_code(at, |code| code.entry().group == GROUP) {
            finding = finding.also(range, "brought out here");
        }
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    fn program(after: &str) -> String {
        format!("G20 G99 T404\nG97 S600 M3\nG0 X2.1 Z-1.\nM36\nG1 X-0.04 F.002\n{after}G0 X2.1\nM30\n")
    }

    #[test]
    fn the_catcher_goes_back_first() {
        let found = findings(&only(&RULE), "haas-lathe", &program(""), &World::default());
        expect![[r#"
            the parts catcher is still out at the end of the program
              here: no `M37` before this
              there: brought out here
              assuming: nothing else takes the catcher away
              help: take the catcher away with `M37` after the part is cut off
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        for after in ["M37\n", "M0\n", "G65 P9077\n"] {
            check_rule(&RULE, "haas-lathe", &program(after), &expect![[""]]);
        }
    }

    #[test]
    fn the_turret_turns_past_it() {
        check_rule(
            &RULE,
            "haas-lathe",
            &program("G28 U0 W0\nT101\nM37\n"),
            &expect![[r#"
                7 | T101
                  | ^^^^ warning[parts-catcher-left-out] the parts catcher is still out at the tool change
            "#]],
        );
    }
}
