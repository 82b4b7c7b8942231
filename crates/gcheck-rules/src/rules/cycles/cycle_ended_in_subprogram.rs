//! A cycle of the caller that a subprogram ends before it makes its holes.

use gcheck_controls::{CodeIx, Effect, Letter, LetterSet};
use gcheck_engine::{At, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::cycles::is_cycle;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A subprogram that is called while a cycle is on goes to a place with `G0` or `G1`, and to the next ones without a code.
    /// The code of the motion ends the cycle of the caller.
    ///
    /// ## Why it matters
    /// The caller gives the cycle, and the subprogram the places of the holes. From the code on the tool only goes over them,
    /// and the holes are missing.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O1
    /// G21 G17 G90 G54 S2000 M3
    /// G0 X0. Y0. Z50.
    /// G99 G81 X10. Y10. Z-20. R5. F200.
    /// M98 P2
    /// G80 G0 Z50.
    /// M30
    /// O2
    /// G0 X85. Y10.
    /// X95.
    /// Y50.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O1
    /// G21 G17 G90 G54 S2000 M3
    /// G0 X0. Y0. Z50.
    /// G99 G81 X10. Y10. Z-20. R5. F200.
    /// M98 P2
    /// G80 G0 Z50.
    /// M30
    /// O2
    /// X85. Y10.
    /// X95.
    /// Y50.
    /// M99
    /// ```
    rule "cycle-ended-in-subprogram" in "cycles" {
        summary: "subprogram that ends the cycle of its caller before the last hole",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(CycleEndedInSubprogram::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleEndedInSubprogram {
    /// The cycle that made the last move.
    cycle: Option<CodeIx>,
    /// Where it was given.
    given: Option<At>,
}

remembers!(CycleEndedInSubprogram: given);

const ACROSS: LetterSet = LetterSet::of("XY");

impl PathRule for CycleEndedInSubprogram {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_cycle) && program.environment.control().semantics().cycles.motion_ends_cycle
    }

    fn moved(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let active = cx.state().active_cycle(cx.model).filter(|code| code.is_some());
        let given = cx.definitions().set_by(Fact::Mode(Role::Cycle)).filter(|_| active.is_some());
        let ended = std::mem::replace(&mut self.cycle, active).zip(std::mem::replace(&mut self.given, given));
        let Some((cycle, given)) = ended.filter(|_| active.is_none()) else {
            cx.rest();
            return;
        };
        let letters = cx.origin().letters;
        if !cx.has_effect(Effect::is_straight_move)
            || !letters.intersects(ACROSS)
            || letters.contains(Letter::of('Z'))
        {
            return;
        }
        // The cycle is the caller's, and the next block is a place without a code.
        let is_callers = cx.depth() > 1
            && cx
                .state()
                .frames()
                .last()
                .is_some_and(|frame| given.file == frame.caller.file && given <= frame.caller);
        if !is_callers || !is_place(cx, cx.origin().at.next()) {
            return;
        }
        let message = format!("the subprogram ends the cycle of its caller (`{}`)", cx.name_of(cycle));
        let finding = cx
            .finding(&META, cx.effect_range(Effect::is_straight_move), message)
            .label("from here on no hole is made")
            .help("remove the code: the cycle goes from hole to hole by itself");
        let given = cx.find_word(given, |word| is_cycle(cx.model.effect(word.code)));
        report.add(match given {
            Some(range) => finding.also(range, "the cycle is given here"),
            None => finding,
        });
    }
}

/// Does the block name a place, and nothing else?
fn is_place(cx: &PathCx<'_>, at: At) -> bool {
    cx.place_of(at).is_some_and(|place| {
        let letters = place.block().letters;
        letters.intersects(ACROSS) && !letters.intersects(LetterSet::of("ZRGM"))
    })
}
