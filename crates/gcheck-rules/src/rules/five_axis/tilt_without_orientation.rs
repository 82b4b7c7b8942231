//! A tilted working plane that nothing has turned the tool to.

use gcheck_controls::{Code, Effect, LetterSet, Motion};
use gcheck_engine::{At, Axis, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::feed::goes_by_feed;
use crate::facts::live_tool::builders_since;
use crate::facts::offset_schemes::whole;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool cuts in a tilted working plane (`G68.2`), and neither `G53.1` nor a word for a rotary axis has turned anything: the
    /// plane only tilts the coordinates.
    ///
    /// Where a rotary axis or an M code of the machine builder comes anywhere before the cut, nothing is reported, nor for a plane
    /// that is only turned about its normal, or that points or vectors give.
    ///
    /// ## Why it matters
    /// The tool keeps its direction, and its path is tilted: it drives into the part at an angle.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G54 S2000 M3
    /// G68.2 X0. Y0. Z0. I0. J45. K0.
    /// G0 X10. Y10.
    /// G1 Z-2. F100.
    /// G69
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G54 S2000 M3
    /// G68.2 X0. Y0. Z0. I0. J45. K0.
    /// G53.1
    /// G0 X10. Y10.
    /// G1 Z-2. F100.
    /// G69
    /// M30
    /// ```
    rule "tilt-without-orientation" in "five_axis" {
        summary: "cut in a tilted plane to which nothing turned the tool",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CUTS,
            make: || Box::new(TiltWithoutOrientation::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct TiltWithoutOrientation {
    /// The block that tilted the plane that was reported, or that may be right.
    told: Option<At>,
}

remembers!(TiltWithoutOrientation: told);

impl PathRule for TiltWithoutOrientation {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_tilt)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if cx.state().effect(Role::TiltedPlane, cx.model) != Some(Effect::TiltedPlaneOn) {
            return;
        }
        let Some(set) = cx.definitions().set_by(Fact::Mode(Role::TiltedPlane)) else { return };
        if self.told == Some(set) || !goes_by_feed(event) || !tilts(cx, set) {
            return;
        }
        let Some(code) = cx.control().codes().find(|code| orients(cx, *code)) else { return };
        self.told = Some(set);
        let is_known = cx.is_certain();
        if !is_known || cx.depth() > 1 || may_be_turned(cx) {
            return;
        }
        let (name, tilt) = (code.number(), cx.code_name(Role::TiltedPlane).unwrap_or_default());
        let finding = cx
            .finding(&META, cx.range(), format!("cut in a tilted plane without `{name}` (`{tilt}`)"))
            .label("the tool keeps its direction, and its path is tilted")
            .note(format!("`{name}`: {}  [{}]", code.entry().summary, code.entry().source))
            .assuming("the rotary axes are not at the angles of the plane already")
            .help(format!("retract, and write `{name}` in a block after `{tilt}`"));
        report.add(cx.resting_on(finding, Fact::Mode(Role::TiltedPlane), &format!("`{tilt}`")));
    }
}

fn is_tilt(effect: Effect) -> bool {
    effect == Effect::TiltedPlaneOn
}

/// Does the code turn the rotary axes to a tilted plane: a move that goes with the code of the plane?
fn orients(cx: &PathCx<'_>, code: Code<'_>) -> bool {
    let entry = code.entry();
    entry.motion == Motion::Rapid
        && entry.recommends.iter().any(|with| {
            cx.control().codes().any(|other| is_tilt(other.effect()) && other.number().to_string() == *with)
        })
}

/// May something before the cut have turned the tool or the table? Axes that are known to be at zero are not turned.
fn may_be_turned(cx: &PathCx<'_>) -> bool {
    let here = cx.origin().at;
    let moved = Axis::ABC.into_iter().filter(|axis| cx.state().actual().get(*axis) != Some(0.0));
    let letters: LetterSet = moved.map(Axis::letter).collect();
    let letters = letters.or(LetterSet::of("UVW"));
    let turns = |block: u32| {
        cx.place_of(At { block, ..here }).is_none_or(|place| {
            let words = place.table.words(place.block());
            place.block().letters.intersects(letters)
                || words.iter().filter_map(|word| cx.code_of(word.code)).any(|code| orients(cx, code))
        })
    };
    builders_since(cx, 0) || (0..=here.block).any(turns)
}

/// Does the block give angles that tilt the plane? Of three Euler angles the second one does, the others turn it about its normal;
/// of roll, pitch and yaw (`P1`) the first two do. Other ways to give the plane are not read.
fn tilts(cx: &PathCx<'_>, at: At) -> bool {
    let has = |letter: u8, is: &dyn Fn(f64) -> bool| {
        cx.find_word(at, |word| word.letter.ascii() == letter && word.number().is_some_and(is)).is_some()
    };
    let is_given = |letter: u8| cx.find_word(at, |word| word.letter.ascii() == letter).is_some();
    let turns = |letter: u8| has(letter, &|angle| angle != 0.0);
    if has(b'P', &|form| whole(form) == Some(1)) {
        turns(b'I') || turns(b'J')
    } else {
        (!is_given(b'P') || has(b'P', &|form| form == 0.0)) && turns(b'J')
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn what_turns_the_tool() {
        let program = |before: &str, after: &str| {
            format!(
                "G21 G90 G54 S2000 M3\n{before}G68.2 X0. Y0. Z0. I0. J45. K0.\n{after}G0 X10. Y10.\nG81 Z-5. R2. F100.\nG80\nG69\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("", ""),
            &expect![[r#"
            4 | G81 Z-5. R2. F100.
              | ^^^^^^^^^^^^^^^^^^ warning[tilt-without-orientation] cut in a tilted plane without `G53.1` (`G68.2`)
        "#]],
        );
        // Known to be at zero, the axes are not turned.
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G0 A0. C0.\n", ""),
            &expect![[r#"
            5 | G81 Z-5. R2. F100.
              | ^^^^^^^^^^^^^^^^^^ warning[tilt-without-orientation] cut in a tilted plane without `G53.1` (`G68.2`)
        "#]],
        );
        for (before, after) in [
            ("", "G53.1\n"),
            ("G0 B0. C0.\nG91 G28 B0.\nG90\n", ""),
            ("G0 B45.\n", ""),
            ("", "G0 A45.\n"),
            ("M245\n", ""),
            ("G65 P9077\n", ""),
        ] {
            check_rule(&RULE, "fanuc-mill", &program(before, after), &expect![[""]]);
        }
        // Turned about the normal alone, or given by points.
        for angles in ["I0. J0. K0.", "I0. J0. K45.", "I45. J0. K0.", "P1 I0. J0. K45.", "P2 Q0 R0. J45."] {
            let flat = program("", "").replace("I0. J45. K0.", angles);
            check_rule(&RULE, "fanuc-mill", &flat, &expect![[""]]);
        }
    }
}
