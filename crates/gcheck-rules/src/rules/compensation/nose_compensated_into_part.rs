//! Compensation of a lathe tool's nose to the side on which the part is.

use gcheck_engine::{At, Event, Fact, Role, TravelKind};

use crate::declare::declare_rule;
use crate::facts::compensation::{is_left, is_on};
use crate::facts::turned::{Side, Turned, end};
use crate::facts::turning::is_turned;
use crate::{MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// On a lathe the outside of the part is turned toward the chuck with the nose compensated to the left (`G41`), or a bore
    /// with the nose compensated to the right (`G42`): to the side on which the part is.
    ///
    /// What is the outside shows by the side from which the tool or its cycle comes.
    ///
    /// ## Why it matters
    /// The nose is shifted into the part by its radius, so tapers, radii and chamfers are cut too deep, by up to twice the
    /// error that compensation is there to remove. Mostly `G41` and `G42` are mixed up.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G18 G99 G40 T0101
    /// G97 S800 M3
    /// G0 X44. Z2.
    /// G41 X38.
    /// G1 Z-30. F.2
    /// X44. Z-36.
    /// G40 G0 X100. Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G18 G99 G40 T0101
    /// G97 S800 M3
    /// G0 X44. Z2.
    /// G42 X38.
    /// G1 Z-30. F.2
    /// X44. Z-36.
    /// G40 G0 X100. Z50.
    /// M30
    /// ```
    rule "nose-compensated-into-part" in "compensation" {
        summary: "nose of a lathe tool compensated to the side of the part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(NoseCompensatedIntoPart::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct NoseCompensatedIntoPart {
    /// The block that switches on what was reported.
    told: Option<At>,
}

remembers!(NoseCompensatedIntoPart: told);

impl PathRule for NoseCompensatedIntoPart {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program) && program.may(is_on)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(turned) = Turned::of(cx) else { return };
        let Event::Travel(travel) = event else { return };
        let Some(is_left) = is_left(cx) else { return };
        let Some(on) = cx.definitions().set_by(Fact::Mode(Role::Compensation)) else { return };
        if travel.kind != TravelKind::Feed || self.told == Some(on) || !turned.knows(cx) {
            return;
        }
        let Some(from) = turned.here() else { return };
        // The side is known of cuts toward the chuck alone.
        let side = turned.side_of(cx, [from, end(cx, travel)], travel.expanded);
        let (what, right) = match side {
            Side::Outside if is_left => ("the outside of the part is", "G42"),
            Side::Inside if !is_left => ("the bore is", "G41"),
            _ => return,
        };
        self.told = Some(on);
        let word = cx.find_word(on, |word| is_on(cx.model.effect(word.code)));
        let Some(range) = word.or_else(|| cx.range_of(on)) else { return };
        let name = cx.code_name(Role::Compensation).unwrap_or_default();
        report.add(
            cx.finding(&META, range, format!("the nose is compensated into the part (`{name}`)"))
                .label(format!("{what} on that side of the path"))
                .also(cx.range(), "turned here, toward the chuck")
                .help(format!("check `G41` and `G42`: turned this way it takes `{right}`")),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn outside(on: &str) -> String {
        format!(
            "G21 G18 G99 G40 T0101\nG97 S800 M3\nG0 X44. Z2.\n{on} X38.\nG1 Z-30. F.2\nX44. Z-36.\nG40 G0 X100. Z50.\nM30\n"
        )
    }

    fn bore(on: &str) -> String {
        format!(
            "G21 G18 G99 G40 T0404 (BORING BAR)\nG97 S800 M3\nG0 X18. Z2.\n{on} X40.\nG1 Z-35. F.1\nX38. Z-36.\nG40 G0 X18.\nZ50.\nM30\n"
        )
    }

    #[test]
    fn mixed_up() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &outside("G41"),
            &expect![[r#"
            4 | G41 X38.
              | ^^^ warning[nose-compensated-into-part] the nose is compensated into the part (`G41`)
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            &bore("G42"),
            &expect![[r#"
            4 | G42 X40.
              | ^^^ warning[nose-compensated-into-part] the nose is compensated into the part (`G42`)
        "#]],
        );
    }

    #[test]
    fn as_it_should_be() {
        for program in [outside("G42"), bore("G41"), outside("G40")] {
            check_rule(&RULE, "fanuc-lathe", &program, &expect![[""]]);
        }
    }
}
