//! A `T` of a lathe that holds an offset and no station.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, Domain};

use crate::declare::declare_rule;
use crate::facts::offset_schemes::whole;
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A lathe takes the last two digits of `T` as the offset and those before them as the station of the turret. `T1` has no
    /// station, while other blocks of the program name station and offset (`T0101`).
    ///
    /// ## Why it matters
    /// `T1` is station 00 with offset 01: the turret does not index, and the tool that is in place cuts with the offset of
    /// another one.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// T1
    /// G97 S900 M3
    /// G0 X20. Z2.
    /// T0202
    /// G0 X30. Z2.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// T0101
    /// G97 S900 M3
    /// G0 X20. Z2.
    /// T0
    /// T0202
    /// G0 X30. Z2.
    /// M30
    /// ```
    rule "tool-call-without-station" in "tool" {
        summary: "`T` of a lathe that holds an offset and no station",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::FOLLOWED),
            make: || Box::new(ToolCallWithoutStation::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ToolCallWithoutStation {
    found: Vec<Finding>,
    /// The first call that names a station.
    whole: Option<Range<u32>>,
}

remembers!(ToolCallWithoutStation: found, whole);

/// A program with more of them follows another scheme.
const MOST: usize = 8;

impl PathRule for ToolCallWithoutStation {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let tools = &program.environment.control().semantics().tools;
        tools.change_by_t && tools.offset_in_t
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        // `T` may be an argument of a macro.
        if cx.origin().at.file != 0 || cx.is_malformed() || cx.has_effect(Effect::calls_macro) {
            return;
        }
        let Some(word) = cx.word('T').filter(|word| !word.is_computed()) else { return };
        let Some(number) = word.number().and_then(whole) else { return };
        // The station that is in place keeps it, and gets its offset again.
        if Abstract::known(cx.state().tool()) == Some(f64::from(number)) {
            return;
        }
        let range = cx.letter_range('T');
        if number >= 100 {
            self.whole = self.whole.take().or(Some(range));
        } else if number > 0 && range.len() <= "T12".len() && self.found.len() <= MOST {
            let message = format!("`T{number}` names no station of the turret");
            let finding = cx
                .finding(&META, range, message)
                .label(format!("station 00 with offset {number:02}: the turret does not index"))
                .help(format!("write station and offset: `T{number:02}{number:02}`"));
            self.found.push(finding);
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        let Some(range) = self.whole.take().filter(|_| self.found.len() <= MOST) else { return };
        for finding in self.found.drain(..) {
            report.add(finding.also(range.clone(), "this names station and offset"));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_program_that_names_no_station_at_all_has_another_scheme() {
        check_rule(&RULE, "fanuc-lathe", "T1\nG0 X20.\nT2\nG0 X30.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn an_offset_alone_is_written_with_all_its_digits() {
        check_rule(&RULE, "fanuc-lathe", "T0101\nG0 X20.\nT0011\nG0 X30.\nM30\n", &expect![[""]]);
        check_rule(&RULE, "haas-lathe", "T101\nG0 X2.\nT1\nG0 X3.\nM30\n", &expect![""]);
    }

    #[test]
    fn the_station_in_place_gets_its_offset_again() {
        check_rule(&RULE, "fanuc-lathe", "T0404\nG0 X20.\nT04\nG0 X30.\nM30\n", &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            "T0404\nG0 X20.\nT05\nG0 X30.\nM30\n",
            &expect![[r#"
            3 | T05
              | ^^^ warning[tool-call-without-station] `T5` names no station of the turret
        "#]],
        );
    }

    #[test]
    fn other_words_and_mills_have_no_station() {
        check_rule(&RULE, "fanuc-lathe", "T0101\nG0 X20.\nG65 P9001 T1\nM30\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "T1 M6\nG0 X2.\nT101 M6\nG0 X3.\nM30\n", &expect![[""]]);
    }
}
