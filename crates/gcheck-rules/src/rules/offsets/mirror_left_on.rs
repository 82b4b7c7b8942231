//! A mirror that the program leaves on.

use gcheck_controls::Effect;
use gcheck_engine::{Ending, Event, Role};

use crate::boundary::Boundary;
use crate::carried::Carried;
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A mirror image is still on where the program ends, or the next tool cuts with it and nothing in the program switches it
    /// off.
    ///
    /// ## Why it matters
    /// The next program, the next part or the next tool is cut left for right, and conventional milling becomes climb milling.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G51.1 X0.
    /// G1 X10. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G51.1 X0.
    /// G1 X10. F100.
    /// G50.1 X0.
    /// M30
    /// ```
    rule "mirror-left-on" in "offsets" {
        summary: "mirror image left on",
        severity: Warning,
        tier: Path,
        mends: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS).union(Watch::ENDS),
            make: || Box::new(MirrorLeftOn::default()),
        },
    }
}

#[derive(Clone, Default, PartialEq)]
struct MirrorLeftOn {
    carried: Carried,
}

remembers!(MirrorLeftOn: carried);

impl PathRule for MirrorLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::MirrorOn)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.carried.block(cx);
        if cx.boundary() == Some(Boundary::ProgramEnd) && !self.carried.is_told {
            judge(cx, report);
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let mode = (Role::Mirror, Effect::MirrorOn, Effect::MirrorOff);
        if let Some(finding) = self.carried.cut(cx, &META, mode, "the mirror image") {
            report.add(finding);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if cx.ends_at_tape_mark(ending) && !self.carried.is_told {
            judge(cx, report);
        }
    }
}

fn judge(cx: &PathCx<'_>, report: &mut Report<'_>) {
    let is_on = |effect| effect == Effect::MirrorOn;
    let Some(finding) = cx.left_at_end(&META, Role::Mirror, is_on, "the mirror image") else { return };
    let cancel = cx.cancel_of(Effect::MirrorOff).unwrap_or_default();
    report.add(
        finding
            .assuming("the end of the program keeps it, as the control's book leaves to a parameter")
            .help(format!("switch the mirror off with `{cancel}` before the program ends"))
            .fix_if(cx.block_before(Some(&cancel))),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_end_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G51.1 X0.\nG1 X10. F100.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ warning[mirror-left-on] the mirror image is still on at the end of the program (`G51.1`)
        "#]],
        );
    }

    #[test]
    fn a_mirror_of_another_control() {
        check_rule(
            &RULE,
            "haas-mill",
            "G101 X0.\nG1 X1. F10.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ warning[mirror-left-on] the mirror image is still on at the end of the program (`G101`)
        "#]],
        );
    }
}
