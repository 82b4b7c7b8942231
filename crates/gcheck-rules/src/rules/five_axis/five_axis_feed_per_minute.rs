//! A cut under 5-axis tool length compensation with feed per minute.

use gcheck_engine::{At, Axis, Event, Fact, FeedMode, Role, Travel, TravelKind};

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_tool;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A cut under 5-axis tool length compensation (`G143`) has its feed per minute (`G94`) or per turn (`G95`), not in inverse
    /// time (`G93`).
    ///
    /// ## Why it matters
    /// Under `G94` the control holds `F` along the path of the linear axes. While the head tilts, the tip moves along
    /// another path and at another speed: a block that mostly turns the head cuts far too fast or crawls. Under `G93`
    /// each block gives its own time (1/`F` minutes), so the tip keeps the feed that the CAM system meant. The
    /// control's page recommends it.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G94 G1 X1. Y1. Z0. A5. B5. F20.
    /// G49
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G93 G1 X1. Y1. Z0. A5. B5. F12.
    /// G94 F20.
    /// G49
    /// M30
    /// ```
    rule "five-axis-feed-per-minute" in "five_axis" {
        summary: "cut under 5-axis tool length compensation with feed per minute",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(FiveAxisFeedPerMinute { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct FiveAxisFeedPerMinute {
    /// The blocks that switched on length and feed mode, as they were reported last.
    told: Option<[Option<At>; 2]>,
}

remembers!(FiveAxisFeedPerMinute: told);

impl PathRule for FiveAxisFeedPerMinute {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        if !state.effect(Role::Length, cx.model).is_some_and(is_along_tool) {
            return;
        }
        let (Event::Travel(travel), Some(mode)) = (event, state.feed_mode(cx.model)) else { return };
        if travel.kind != TravelKind::Feed || mode == FeedMode::InverseTime || !turns(cx, travel) {
            return;
        }
        let fact = Fact::Mode(Role::FeedMode);
        let set_by = [cx.definitions().set_by(Fact::Mode(Role::Length)), cx.definitions().set_by(fact)];
        if self.told.replace(set_by) == Some(set_by) {
            return;
        }
        let (Some(length), Some(feed)) = (state.mode(Role::Length).only(), state.mode(Role::FeedMode).only())
        else {
            return;
        };
        let Some(length) = cx.control().code_at(length) else { return };
        let (name, feed) = (length.number(), cx.name_of(feed));
        let per = if mode == FeedMode::PerRevolution { "per turn" } else { "per minute" };
        let finding = cx
            .finding(&META, cx.range(), format!("feed {per} (`{feed}`) while the tool tilts (`{name}`)"))
            .label("the tip's speed is not the `F` that is written")
            .note(format!(
                "`{feed}` holds the feed along the linear axes; under `G93` a block takes 1/`F` minutes, however far \
                 the head turns"
            ))
            .note(format!("inverse time is recommended under `{name}`  [{}]", length.entry().source))
            .help("post these blocks in inverse time: `G93` once, and in each block `F` = feed / length of its path");
        report.add(match set_by {
            [_, Some(_)] => cx.resting_on(finding, fact, &format!("`{feed}`")),
            _ => finding.assuming(format!("`{feed}` is what the control has at the start")),
        });
    }
}

/// Does the move turn the tool? Where it does not, the tip is as fast as `F` says.
fn turns(cx: &PathCx<'_>, travel: &Travel) -> bool {
    Axis::ALL.into_iter().filter(|axis| axis.is_rotary()).any(|axis| {
        let is_named = cx.origin().letters.contains(axis.letter());
        is_named && travel.from.raw(axis).to_bits() != travel.to.raw(axis).to_bits()
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn once_for_a_stretch_of_cuts() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nG1 X1. Y0. Z0. A1. B5. F20.\nX2. Y0. Z0. A2. B5. F25.\nG93 X3. Y0. Z0. A3. B5. F9.\n\
             G94 X4. Y0. Z0. A4. B5. F9.\nG49\nM30\n",
            &expect![[r#"
                2 | G1 X1. Y0. Z0. A1. B5. F20.
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[five-axis-feed-per-minute] feed per minute (`G94`) while the tool tilts (`G143`)
                5 | G94 X4. Y0. Z0. A4. B5. F9.
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[five-axis-feed-per-minute] feed per minute (`G94`) while the tool tilts (`G143`)
            "#]],
        );
    }

    #[test]
    fn a_tool_that_does_not_turn_is_as_fast_as_its_feed() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G0 X0. Y0. Z1. A0. B0.\nG143 H1 X0. Y0. Z1. A0. B0.\nG1 X1. Y0. Z0. F20.\nX2. Y0. Z0. A0. B0.\nG49\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn rapids_have_no_feed() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nG0 X1. Y0. Z0. A5. B5.\nG49\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_it_says() {
        let program = "G90 G94 G143 H1 X0. Y0. Z1. A0. B0.\nG1 X1. Y0. Z0. A1. B5. F20.\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            feed per minute (`G94`) while the tool tilts (`G143`)
              here: the tip's speed is not the `F` that is written
              there: `G94` set here
              note: `G94` holds the feed along the linear axes; under `G93` a block takes 1/`F` minutes, however far the head turns
              note: inverse time is recommended under `G143`  [Haas 96-8000 rev AC May 2010 p.184; Haas online manual, g143-5-axis-tool-length-compensation; gcodes.net, G143; HM17 p.313]
              help: post these blocks in inverse time: `G93` once, and in each block `F` = feed / length of its path
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
