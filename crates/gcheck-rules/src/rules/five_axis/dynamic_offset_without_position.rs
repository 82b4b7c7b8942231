//! A cut under the dynamic work offset before X, Y and Z were given in it.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Event, Fact, Role, TravelKind};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// After the dynamic work offset is switched on (`G254`), a tool cuts before the program gave X, Y and Z.
    ///
    /// ## Why it matters
    /// The offset moves where the axes have to be for a programmed point. An axis that is not programmed stays where it
    /// is, so the tool cuts beside the place that the program means, or in one move from the old place to the new one.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0. B90. C0. S1000 M3
    /// G43 H1 Z5.
    /// G254
    /// G1 Z0. F20.
    /// G255
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y0. B90. C0. S1000 M3
    /// G43 H1 Z5.
    /// G254
    /// X0. Y0.
    /// Z5.
    /// G1 Z0. F20.
    /// G255
    /// M30
    /// ```
    rule "dynamic-offset-without-position" in "five_axis" {
        summary: "cut under the dynamic work offset without a position in it",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(DynamicOffsetWithoutPosition::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct DynamicOffsetWithoutPosition {
    /// The block that switched the offset on.
    on: Option<At>,
    /// Axes that were given since.
    given: Given,
    /// It went to the first place at feed.
    has_fed: bool,
    /// It cut already, or was reported.
    is_done: bool,
}

remembers!(DynamicOffsetWithoutPosition: on);

/// Which of X, Y and Z.
type Given = [bool; 3];

impl PathRule for DynamicOffsetWithoutPosition {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::DynamicOffsetOn)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let role = Role::DynamicOffset;
        let set_by = cx.definitions().set_by(Fact::Mode(role));
        if set_by.is_none() || cx.state().effect(role, cx.model) != Some(Effect::DynamicOffsetOn) {
            return;
        }
        if self.on != set_by {
            *self = Self { on: set_by, ..Self::default() };
        }
        let in_machine = cx.has_effect(|effect| effect == Effect::MachineCoordinates);
        if self.is_done || in_machine {
            return;
        }
        for (given, letter) in self.given.iter_mut().zip(["X", "Y", "Z"]) {
            *given |= cx.origin().letters.intersects(LetterSet::of(letter));
        }
        let is_feed = match event {
            Event::Travel(travel) => travel.kind == TravelKind::Feed,
            _ => true,
        };
        // The way to the first place, and down there, may be at feed as well.
        let own = cx.origin().letters;
        let is_way_there = LetterSet::of("XY").without(own).is_empty()
            && !own.intersects(LetterSet::of("Z"))
            && !self.has_fed;
        self.has_fed |= is_feed;
        if is_feed && !is_way_there {
            self.is_done = true;
            self.tell(cx, report);
        }
    }
}

impl DynamicOffsetWithoutPosition {
    fn tell(&self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let missing: Vec<&str> = self
            .given
            .iter()
            .zip(["`X`", "`Y`", "`Z`"])
            .filter(|(given, _)| !**given)
            .map(|(_, name)| name)
            .collect();
        let role = Role::DynamicOffset;
        let Some(code) =
            cx.state().mode(role).only().and_then(|ix| cx.code_of(ix)).filter(|_| !missing.is_empty())
        else {
            return;
        };
        let (name, missing) = (code.number(), missing.join(", "));
        let finding = cx
            .finding(&META, cx.range(), format!("cut under the dynamic work offset without {missing} (`{name}`)"))
            .label(format!("{missing} not given since `{name}`"))
            .note(format!(
                "after `{name}` ({}) X, Y and Z are programmed before a cut, even where the tool is there already  [{}]",
                code.entry().title,
                code.entry().source
            ))
            .help("go to X and Y in one block and to Z in the next, then cut");
        report.add(cx.resting_on(finding, Fact::Mode(role), &format!("`{name}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_axis_counts() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0. B90. C0. S900 M3\nG43 H1 Z5.\nG254\nX1.\nZ2.\nG1 Z0. F20.\nX2.\nG255\nG254\nX1. Y1.\nZ2.\nG1 Z0.\nG255\nG254\nG1 X1.\nG255\nG254\nG1 X1. Y1.\nZ1.\nX2.\nG255\nM30\n",
            &expect![[r#"
                6 | G1 Z0. F20.
                  | ^^^^^^^^^^^ warning[dynamic-offset-without-position] cut under the dynamic work offset without `Y` (`G254`)
                15 | G1 X1.
                   | ^^^^^^ warning[dynamic-offset-without-position] cut under the dynamic work offset without `Y`, `Z` (`G254`)
            "#]],
        );
    }
}
