//! A thread that the axis begins before it has the speed of the lead.

use std::collections::BTreeSet;

use gcheck_engine::{Abstract, At, Axis, Domain, Event, Fact, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cutting::is_thread;
use crate::facts::reach;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A thread is cut along Z, and the axis needs more way to reach the speed of the lead than the program gives it: more than
    /// the whole thread is long, or more than there is before the face of the part.
    ///
    /// The rule needs the acceleration of the machine (`[machine] acceleration`). The speed is the lead times the speed of the
    /// spindle, and the way is the square of it by twice the acceleration. A thread that begins in front of `Z0` and ends
    /// in the part is taken to begin in the part at `Z0`. Taps are left out: there the axis follows the spindle as it starts.
    /// Each speed is reported once.
    ///
    /// ## Why it matters
    /// While the axis gathers speed it is late for the spindle: the first turns of the thread are too narrow, and the gauge does
    /// not go on.
    ///
    /// ## Reported
    /// On a machine that accelerates by 100 mm/s²; 2 mm at 1000 rpm need 5.6 mm:
    /// ```nc,reported,linuxcnc
    /// G21 G90 G97 S1000 M3
    /// G0 X20 Z2
    /// G33 Z-20 K2
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G97 S1000 M3
    /// G0 X20 Z6
    /// G33 Z-20 K2
    /// M2
    /// ```
    /// ## How to fix it
    /// * Begin the thread further away from the face.
    /// * Or turn slower: the finding gives the highest speed for this way.
    /// * If the axes are faster, correct `acceleration` under `[machine]`.
    rule "thread-run-in-too-short" in "machine" {
        summary: "thread begins before the axis has its speed",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(ThreadRunInTooShort::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ThreadRunInTooShort {
    /// Millimetres a turn, of the thread under way.
    lead: Option<f64>,
    /// The last move was of a thread: the next one goes on from it.
    goes_on: bool,
    /// The blocks whose speed was reported.
    told: BTreeSet<Option<At>>,
}

remembers!(ThreadRunInTooShort: told);

/// What is missing is reported from here on: millimetres. Books give the way with a margin.
const MISSING: f64 = 0.1;

impl PathRule for ThreadRunInTooShort {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let acceleration = &program.environment.machine.engine.dynamics.acceleration;
        acceleration.contains_key(&Axis::Z) && program.may(is_thread)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if let Event::SpindleSync { lead, .. } = event {
            self.lead = lead.map(|lead| lead.0.abs());
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let thread = match event {
            Event::Travel(travel) if travel.kind == TravelKind::Thread => Some(travel),
            _ => None,
        };
        let goes_on = std::mem::replace(&mut self.goes_on, thread.is_some());
        let Some(travel) = thread.filter(|_| !goes_on && !cx.is_called_only()) else { return };
        let gains = &cx.environment.machine.engine.dynamics.acceleration;
        let (Some(from), Some(to), Some(gain)) =
            (travel.from.get(Axis::Z), travel.to.get(Axis::Z), gains.get(&Axis::Z))
        else {
            return;
        };
        // Without a lead of its own a thread is cut at the feed, which is then a lead.
        let lead = self.lead.or_else(|| Abstract::bounds(cx.state().feed()).map(|(lowest, _)| lowest));
        let turns = reach::turns(cx, &travel.from, &travel.to);
        let (Some(lead), Some(turns)) = (lead.filter(|lead| *lead > 0.0), turns) else { return };
        let speed = lead * turns / 60.0;
        let needed = speed * speed / (2.0 * gain);
        let is_into_face = from > 0.0 && to < 0.0;
        let (way, what) =
            if is_into_face { (from, "before the face") } else { ((to - from).abs(), "in all") };
        if way <= 0.0 || needed <= way + MISSING || !self.told.insert(cx.definitions().set_by(Fact::Speed)) {
            return;
        }
        let (needed, given) = (cx.shown(Mm(needed)), cx.shown(Mm(way)));
        let most = (way * 2.0 * gain).sqrt() * 60.0 / lead;
        let finding = cx
            .finding(&META, cx.range(), format!("Z needs {needed} to its speed, and has {given} {what}"))
            .label(format!("{turns:.0} rpm times {} a turn", cx.shown(Mm(lead))))
            .help(format!("begin the thread further away, or turn at no more than {:.0} rpm", most.floor()));
        let finding = if is_into_face { finding.assuming("the face of the part is at Z0") } else { finding };
        report.add(cx.resting_on(finding, Fact::Speed, "the speed"));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn shorter_than_the_way_it_needs() {
        check_rule_in(
            &RULE,
            "fanuc-lathe",
            "G21 G97 S2000 M3\nG0 X20. Z-10.\nG32 Z-15. F2.\nG0 X30.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                3 | G32 Z-15. F2.
                  | ^^^^^^^^^^^^^ warning[thread-run-in-too-short] Z needs 22.222 mm to its speed, and has 5 mm in all
            "#]],
        );
    }

    #[test]
    fn passes_of_a_cycle_are_one_finding() {
        check_rule_in(
            &RULE,
            "fanuc-lathe",
            "G21 G97 S1500 M3\nG0 X22. Z3.\nG92 X19.5 Z-15. F2.\nX19.\nX18.5\nG0 X50.\nS200 M3\nG0 X22. Z3.\nG92 X19.5 Z-15. F2.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                3 | G92 X19.5 Z-15. F2.
                  | ^^^^^^^^^^^^^^^^^^^ warning[thread-run-in-too-short] Z needs 12.5 mm to its speed, and has 3 mm before the face
            "#]],
        );
    }

    #[test]
    fn a_thread_of_several_blocks_runs_in_once() {
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G21 G90 G97 S1000 M3\nG0 X20 Z6\nG33 Z1 K2\nG33 Z-20 K2\nM2\n",
            &World::of_examples(&META),
            &expect![[r#"
                3 | G33 Z1 K2
                  | ^^^^^^^^^ warning[thread-run-in-too-short] Z needs 5.556 mm to its speed, and has 5 mm in all
            "#]],
        );
    }

    #[test]
    fn nothing_configured_nothing_said() {
        check_rule(&RULE, "linuxcnc", "G21 S3000 M3\nG0 X0 Z1\nG33 Z-30 K6\nM2\n", &expect![[""]]);
    }
}
