//! An output that waits for a move that never comes.

use gcheck_controls::Effect;
use gcheck_engine::{At, Event};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// An output that is switched with the next move (`M62`, `M63`, `M67`) is followed by no move before the program ends.
    ///
    /// ## Why it matters
    /// The control queues the output for the beginning of the next move. Without one it never switches: a clamp stays
    /// open, a laser stays on.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90
    /// G0 X1
    /// M62 P1
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90
    /// M62 P1
    /// G0 X1
    /// M2
    /// ```
    /// At once, without a move:
    /// ```nc,quiet,linuxcnc
    /// G21 G90
    /// G0 X1
    /// M64 P1
    /// M2
    /// ```
    rule "output-without-move" in "motion" {
        summary: "output that waits for a move that never comes",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::MOVES).union(Watch::CHANGES),
            make: || Box::new(OutputWithoutMove { waits: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct OutputWithoutMove {
    /// The block that queued an output last.
    waits: Option<At>,
}

remembers!(OutputWithoutMove: waits);

impl PathRule for OutputWithoutMove {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::is_output_with_move)
    }

    fn moved(&mut self, _: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        self.waits = None;
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if let Event::Output { with_move: true, .. } = event {
            self.waits = Some(cx.origin().at);
        }
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if boundary(cx) != Some(Boundary::ProgramEnd) || cx.is_called_only() {
            return;
        }
        let Some(range) = self.waits.take().and_then(|at| {
            cx.find_word(at, |word| cx.model.effect(word.code).is_output_with_move())
                .or_else(|| cx.range_of(at))
        }) else {
            return;
        };
        report.add(
            cx.finding(&META, range, "the output waits for a move that never comes")
                .label("switches with the next move")
                .also(cx.range(), "the program ends here")
                .help("use the code that switches at once (`M64`, `M65`, `M68`), or put it before the last move"),
        );
    }
}
