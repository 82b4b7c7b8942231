//! A subprogram that is called in positions and in increments.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Event, Fact, FrameKind, Role};

use crate::declare::declare_rule;
use crate::facts::modes::ignores_distance_mode;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A subprogram takes positions or increments (`G90`, `G91`) from its caller, and its callers differ: the same
    /// moves go to points in one call and by distances in another.
    ///
    /// ## Why it matters
    /// One of the two is wrong. The tool moves by the coordinates of its target instead of to them.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// M97 P10
    /// G91
    /// M97 P10
    /// G90
    /// M30
    /// N10 G1 X1. F5.
    /// X2.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// M97 P10
    /// G91
    /// M97 P10
    /// G90
    /// M30
    /// N10 G90 G1 X1. F5.
    /// M99
    /// ```
    rule "incremental-into-subprogram" in "modal" {
        summary: "subprogram called in positions and in increments",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::RAPIDS).union(Watch::CUTS),
            make: || Box::new(IncrementalIntoSubprogram { depth_set: None, calls: Vec::new() }),
        },
    }
}

/// The first move of a subprogram that takes the mode from its caller.
#[derive(Clone, PartialEq)]
struct Call {
    /// The subprogram.
    entry: At,
    /// The block that calls it.
    caller: At,
    is_incremental: bool,
}

remembers!(Call: entry, caller);

#[derive(Clone, PartialEq)]
struct IncrementalIntoSubprogram {
    /// The block that set the mode last, and how deep in calls.
    depth_set: Option<(At, usize)>,
    calls: Vec<Call>,
}

remembers!(IncrementalIntoSubprogram: depth_set, calls);

/// More subprograms than this are not compared.
const MOST_CALLS: usize = 200;

impl PathRule for IncrementalIntoSubprogram {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::calls)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if cx.has_effect(|effect| matches!(effect, Effect::Absolute | Effect::Incremental)) {
            self.depth_set = Some((cx.origin().at, cx.depth()));
        }
    }

    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.moves(cx, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.moves(cx, report);
    }
}

impl IncrementalIntoSubprogram {
    fn moves(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let depth = cx.depth();
        if depth < 2 || ignores_distance_mode(cx) || !cx.origin().letters.intersects(LetterSet::of("XYZ")) {
            return;
        }
        let set_by = cx.definitions().set_by(Fact::Mode(Role::Distance));
        // The caller set it: the last block that did is outside the call.
        let is_callers = matches!((set_by, self.depth_set), (Some(at), Some((set, set_depth))) if at == set && set_depth < depth);
        let (Some(frame), Some(is_incremental)) =
            (cx.state().frames().last(), cx.state().is_incremental(cx.model))
        else {
            return;
        };
        if !is_callers || frame.kind == FrameKind::Main {
            return;
        }
        if self.calls.iter().any(|call| call.caller == frame.caller && call.is_incremental == is_incremental)
        {
            return;
        }
        let other =
            self.calls.iter().find(|call| call.entry == frame.entry && call.is_incremental != is_incremental);
        if let Some(other) = other {
            let incremental = cx.name_of_effect(Effect::Incremental).unwrap_or_default();
            let absolute = cx.name_of_effect(Effect::Absolute).unwrap_or_default();
            let how = |is_incremental: bool| {
                if is_incremental { "called in increments here" } else { "called in positions here" }
            };
            let mut finding = cx
                .finding(
                    &META,
                    cx.range(),
                    format!("the subprogram moves to positions in one call and by increments in another (`{incremental}`)"),
                )
                .label("takes the mode from its caller")
                .help(format!("state `{absolute}` or `{incremental}` in the subprogram before its first move"));
            finding.labels.clear();
            for (caller, is_incremental) in
                [(other.caller, other.is_incremental), (frame.caller, is_incremental)]
            {
                if let Some(range) = cx.range_of(caller) {
                    finding = finding.also(range, how(is_incremental));
                }
            }
            report.add(finding);
        }
        if self.calls.len() < MOST_CALLS {
            self.calls.push(Call { entry: frame.entry, caller: frame.caller, is_incremental });
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn both_calls_are_shown() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG21 G90 G54 G0 X0. Y0.\nM98 P2\nG91\nM98 P2\nG90\nM30\nO2\nG1 X1. F50.\nM99\n",
            &expect![[r#"
                9 | G1 X1. F50.
                  | ^^^^^^^^^^^ warning[incremental-into-subprogram] the subprogram moves to positions in one call and by increments in another (`G91`)
            "#]],
        );
    }

    #[test]
    fn increments_that_every_caller_means() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG21 G91 G54 G0 X0. Y0.\nM98 P2 L5\nX10.\nM98 P2\nG90\nM30\nO2\nG1 X1. F50.\nM99\n",
            &expect![[""]],
        );
    }
}
