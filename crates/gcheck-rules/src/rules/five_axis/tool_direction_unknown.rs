//! A cycle along the tool before the program turned any rotary axis.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A canned cycle along the tool (`G161` and its kin) comes before the program gave a position of both rotary axes.
    ///
    /// ## Why it matters
    /// The cycle works in the direction of the tool. Where the program leaves an angle to what ran before, the tool may
    /// be tilted another way than the hole.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X8. Y-8. S1000 M3
    /// G43 H1 Z15.
    /// G161 E.5 F7.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X8. Y-8. B23. A22. S1000 M3
    /// G43 H1 Z15.
    /// G161 E.5 F7.
    /// G80
    /// M30
    /// ```
    rule "tool-direction-unknown" in "five_axis" {
        summary: "cycle along the tool before the angles are given",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::BLOCKS),
            make: || Box::new(ToolDirectionUnknown::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ToolDirectionUnknown {
    /// Whether A, B and C were given.
    given: [bool; 3],
    is_done: bool,
}

remembers!(ToolDirectionUnknown);

/// A tool tilts about two axes.
const ROTARY_AXES: usize = 2;

impl ToolDirectionUnknown {
    fn note(&mut self, cx: &PathCx<'_>) {
        for (given, letter) in self.given.iter_mut().zip(["A", "B", "C"]) {
            *given |= cx.origin().letters.intersects(LetterSet::of(letter));
        }
    }
}

impl PathRule for ToolDirectionUnknown {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_along_tool)
    }

    fn moved(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        self.note(cx);
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.note(cx);
        if self.is_done || !cx.has_effect(is_along_tool) {
            return;
        }
        self.is_done = true;
        let is_known = self.given.iter().filter(|given| **given).count() >= ROTARY_AXES;
        if is_known || cx.is_called_only() || cx.is_after_unknown_program() {
            return;
        }
        let Some(code) = cx
            .codes()
            .iter()
            .copied()
            .find(|ix| is_along_tool(cx.model.effect(*ix)))
            .and_then(|ix| cx.code_of(ix))
        else {
            return;
        };
        let (name, entry) = (code.number(), code.entry());
        report.add(
            cx.finding(
                &META,
                cx.effect_range(is_along_tool),
                format!("cycle along a tool whose direction the program does not give (`{name}`)"),
            )
            .label("the angles are those of what ran before")
            .note(format!(
                "a position in X, Y, Z and both rotary axes comes before `{name}` ({})  [{}]",
                entry.title, entry.source
            ))
            .help("go to the start position with the words of both rotary axes before the cycle"),
        );
    }
}

/// Does the cycle work along the tool?
fn is_along_tool(effect: Effect) -> bool {
    matches!(effect, Effect::CycleAlongTool(_))
}
