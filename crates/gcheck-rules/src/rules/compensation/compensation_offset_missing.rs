//! Cutter compensation with offset number zero.

use gcheck_controls::{CodeIx, Effect, LastingFrom, Letter, Need, WordEntry};
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::compensation::{begins, ends_by_number, is_on};
use crate::facts::feed::goes_by_feed;
use crate::{Finding, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Cutter compensation is switched on (`G41`, `G42`) with offset number zero (`D0`), or a later block gives it number zero
    /// and the tool goes on cutting.
    ///
    /// If the program never gives a `D`, `lasting-word-never-given` reports that.
    ///
    /// ## Why it matters
    /// Offset zero has no size: the tool's centre follows the contour, and the part is too small by the tool's
    /// diameter.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G41 D0 G1 X10. F100.
    /// G40 X0.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G41 D1 G1 X1. F10.
    /// D0 Y2.
    /// X3.
    /// G40 X4.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G41 D1 G1 X10. F100.
    /// G40 X0.
    /// M30
    /// ```
    /// ```nc,quiet,haas-mill
    /// G41 D1 G1 X1. F10.
    /// D0
    /// G40 X4.
    /// M30
    /// ```
    rule "compensation-offset-missing" in "compensation" {
        summary: "cutter compensation with offset number zero",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS).union(Watch::MOVES),
            make: || Box::new(CompensationOffsetMissing { has_begun: false, zeroed: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct CompensationOffsetMissing {
    /// Compensation was switched on, and no cut seen since.
    has_begun: bool,
    /// A block that gave offset number zero while compensation was on, and no cut seen since.
    zeroed: Option<At>,
}

remembers!(CompensationOffsetMissing: zeroed);

impl PathRule for CompensationOffsetMissing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_on)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        self.has_begun |= begins(cx);
        if cx.has_effect(|effect| Role::of(effect) == Some(Role::Compensation)) {
            self.zeroed = None;
        } else if cx.origin().letters.contains(Letter::of('D')) {
            self.zeroed = takes_size_away(cx).then(|| cx.origin().at);
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if self.zeroed.is_none() || !goes_by_feed(event) {
            return;
        }
        // A path beside the contour is given out late: the cuts of blocks before had their size.
        let origin = cx.origin().at;
        if let Some(at) = self.zeroed.take_if(|at| at.file != origin.file || at.block <= origin.block) {
            report.add(size_taken_away(cx, at));
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let is_loaded = cx.model.semantics().tools.zero_is_loaded;
        if !std::mem::take(&mut self.has_begun) || is_loaded || Abstract::known(cx.state().d()) != Some(0.0) {
            return;
        }
        let Some(code) = cx.state().mode(Role::Compensation).only() else { return };
        let is_by_number =
            matches!(cx.model.effect(code), Effect::CompensationLeft | Effect::CompensationRight);
        let Some(at) = cx.definitions().set_by(Fact::Mode(Role::Compensation)) else { return };
        // Only a zero of a word: `T0100` of a turret cancels all offsets.
        let is_zero = |word: &gcheck_program::Word| {
            word.letter.ascii() == b'D' && (word.is_computed() || word.number() == Some(0.0))
        };
        if !is_by_number {
            return;
        }
        let name = cx.name_of(code);
        let Some(range) = cx.find_word(at, is_zero) else {
            if let Some(finding) = without_word(cx, code, at) {
                report.add(finding);
            }
            return;
        };
        report.add(
            cx.finding(&META, range, format!("cutter compensation with no offset (`{name} D0`)"))
                .label("offset zero has no size")
                .help(format!("give the tool's offset number with `{name}`, or remove the compensation")),
        );
    }
}

/// Does the block give the compensation that is on an offset without a size?
fn takes_size_away(cx: &PathCx<'_>) -> bool {
    let d = Letter::of('D');
    let Some(code) = cx.state().mode(Role::Compensation).only().and_then(|code| cx.code_of(code)) else {
        return false;
    };
    let lasts = cx.control().lasting_in(d, &code.entry().group);
    let lasts = lasts.is_some_and(|row| row.from == LastingFrom::AnyBlock);
    let codes = cx.codes();
    let is_read = codes.iter().filter_map(|code| cx.code_of(*code)).any(|code| code.reads().contains(d));
    is_on(code.effect())
        && lasts
        && !is_read
        && !cx.model.semantics().tools.zero_is_loaded
        && Abstract::known(cx.state().d()) != Some(0.0)
        && cx.known_number('D') == Some(0.0)
}

/// A cut after offset number zero.
fn size_taken_away(cx: &PathCx<'_>, at: At) -> Finding {
    let name = cx.code_name(Role::Compensation).unwrap_or_default();
    let off = cx.name_of_effect(Effect::CompensationOff).unwrap_or_default();
    let word = cx.find_word(at, |word| word.letter == Letter::of('D'));
    let is_vector = cx.state().effect(Role::Compensation, cx.model) == Some(Effect::CompensationVector);
    let finding = cx
        .finding(
            &META,
            word.unwrap_or_else(|| cx.range()),
            format!("cutter compensation goes on with no offset (`{name}`, `D0`)"),
        )
        .label(if is_vector {
            "offset zero has no size: from here the path is cut as it was posted"
        } else {
            "offset zero has no size: from here the tool's centre follows the contour"
        })
        .help(format!(
            "give the tool's offset number, or end the compensation with `{off}` away from the part"
        ));
    let code = cx.state().mode(Role::Compensation).only().and_then(|code| cx.code_of(code));
    match code.filter(|code| ends_by_number(*code)) {
        Some(code) => finding.note(format!("`D0` ends `{name}` as `{off}` does  [{}]", code.entry().source)),
        None => finding,
    }
}

/// A lasting `D` that this way to the block does not give, although the text has one before it. Where it has none, the text
/// alone says so, and another rule reports it.
fn without_word(cx: &PathCx<'_>, code: CodeIx, at: At) -> Option<Finding> {
    let d = Letter::of('D');
    let range = cx.find_word(at, |word| word.code == code)?;
    let is_never_given =
        cx.file_index.never_given.iter().any(|given| given.letter == d && given.range.start == range.start);
    let lasts = |word: &WordEntry| word.need == Need::Modal && Letter::parse(&word.letter) == Some(d);
    let lasts = cx.code_of(code)?.entry().words.iter().any(lasts);
    if is_never_given || !lasts || cx.is_called_only() || cx.find_word(at, |word| word.letter == d).is_some()
    {
        return None;
    }
    let name = cx.name_of(code);
    Some(
        cx.finding(&META, range, format!("cutter compensation with no offset (`{name}` without `D`)"))
            .label("no `D` is in effect on the way here")
            .help(format!("give the tool's offset number with `{name}`")),
    )
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_zero_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G42 D0\nG1 X1. F5.\nG40 X0.\nM30\n",
            &expect![[r#"
            1 | G20 G42 D0
              |         ^^ warning[compensation-offset-missing] cutter compensation with no offset (`G42 D0`)
        "#]],
        );
    }

    #[test]
    fn a_number_from_a_variable_may_be_anything() {
        check_rule(&RULE, "haas-mill", "G20 G42 D#500\nG1 X1. F5.\nG40 X0.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_lasting_number_that_one_way_does_not_give() {
        let program = |given: &str| format!("G20\n{given}D1\nG1 G42 X1. F5.\nG40 X0.\nM30\n");
        check_rule(
            &RULE,
            "haas-mill",
            &program("/"),
            &expect![[r#"
            3 | G1 G42 X1. F5.
              |    ^^^ warning[compensation-offset-missing] cutter compensation with no offset (`G42` without `D`)
        "#]],
        );
        check_rule(&RULE, "haas-mill", &program(""), &expect![[""]]);
        check_rule(&RULE, "haas-mill", "G20\nG1 G42 X1. F5.\nG40 X0.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_later_zero_takes_the_size_away() {
        let beside_path = |block: &str| {
            format!("G20 G17 G90\nG0 X0. Y0.\nG41 D01 G1 X0.5 F10.\n{block}\nX2.\nG40 X3.\nM30\n")
        };
        let along_vector = |block: &str| {
            format!(
                "G20 G17 G90\nG0 X0. Y0. Z1.\nG1 Z0.5 F10.\nG141 D01 X0. Y0. Z0.5\nX1. Y0.2 Z0.5 I0. J0.6 K0.8\n{block}\nG40 Z1.\nM30\n"
            )
        };
        for program in [
            beside_path("D0 X1. Y0.2"),
            beside_path("D00\nX1. Y0.2"),
            beside_path("D00 X1."),
            beside_path("D[1-1] X1. Y0.2"),
            along_vector("D0 X2. Y0.2 Z0.5 I0. J0.6 K0.8"),
            along_vector("X2. Y0.2 Z0.5 I0. J0.6 K0.8 D0"),
        ] {
            let found = findings(&only(&RULE), "haas-mill", &program, &World::default());
            assert_eq!(found.len(), 1, "{program}");
        }
        for program in [
            beside_path("X1. Y0.2"),
            beside_path("D02 X1. Y0.2"),
            beside_path("D#500 X1. Y0.2"),
            along_vector("X2. Y0.2 Z0.5 I0. J0.6 K0.8"),
            along_vector("D0"),
        ] {
            check_rule(&RULE, "haas-mill", &program, &expect![[""]]);
        }
        for control in ["fanuc-mill", "generic-mill"] {
            let found = findings(&only(&RULE), control, &beside_path("D00 X1. Y0.2"), &World::default());
            assert_eq!(found.len(), 1, "{control}");
        }
    }

    #[test]
    fn what_it_says_of_a_later_zero() {
        let program = "G20 G17 G90\nG0 X0. Y0.\nG41 D01 G1 X0.5 F10.\nD0 X1. Y0.2\nX2.\nG40 X3.\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            cutter compensation goes on with no offset (`G41`, `D0`)
              here: offset zero has no size: from here the tool's centre follows the contour
              note: `D0` ends `G41` as `G40` does  [Haas online manual, entry and exit of cutter compensation; Haas 96-8000 rev R June 2007 (easymanua.ls page 91); Renishaw H-1000-5068 p.48; HM17 p.270]
              help: give the tool's offset number, or end the compensation with `G40` away from the part
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
