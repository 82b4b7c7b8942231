//! A word whose variable is empty.

use std::collections::HashSet;

use gcheck_controls::LetterSet;

use crate::declare::declare_rule;
use crate::facts::empty_variables::{Use, argument_of, is_assigned_before, is_in_macro, usage};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A variable that the program emptied (`#101=#0`) gives the value of a word or counts in arithmetic. In a macro, the
    /// variable of an argument that the call does not give is the value of a word that moves no axis.
    ///
    /// ## Why it matters
    /// The control ignores a word without a value: `G1 Z#101` does not move Z, `G41 D#101` takes the `D` of an earlier block,
    /// `G105 P#5` parts nothing off. In arithmetic an empty variable counts as zero.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// O1
    /// #101=#0
    /// G20 G90 G54 G1 Z#101 F10.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// O1
    /// G65 P9100 X1.
    /// M30
    /// O9100
    /// G20 G90 G54 G1 X#24 F#9
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// O1
    /// #101=#0
    /// IF [#101 EQ #0] GOTO 10
    /// G20 G90 G54 G1 Z#101 F10.
    /// N10 M30
    /// ```
    /// Macros move the axes that they get.
    /// ```nc,quiet,haas-mill
    /// O1
    /// G65 P9100 X1.
    /// M30
    /// O9100
    /// G20 G90 G54 G0 X#24 Y#25
    /// M99
    /// ```
    rule "empty-variable" in "macros" {
        summary: "word whose variable is empty",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::READS, make: || Box::new(EmptyVariable::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct EmptyVariable {
    told: HashSet<u32>,
}

remembers!(EmptyVariable);

/// Words of axes and of distances, which macros pass on where they get them.
const OF_AXES: LetterSet = LetterSet::of("XYZABCUVWIJKR");

impl PathRule for EmptyVariable {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn vacant_read(&mut self, cx: &PathCx<'_>, variable: u32, report: &mut Report<'_>) {
        // `#0` is nothing by its name.
        if variable == 0 || self.told.contains(&variable) {
            return;
        }
        let [first, last] = cx.model.semantics().locals;
        let is_local = (first..=last).contains(&variable);
        let is_emptied = is_assigned_before(cx, variable);
        let in_macro = is_in_macro(cx);
        // Local variables of a program that others call are arguments that it may get.
        if is_local && !in_macro && cx.file_index.is_called_from_elsewhere() {
            return;
        }
        let argument = argument_of(cx, variable).filter(|_| in_macro && is_local && !is_emptied);
        if !is_emptied && argument.is_none() {
            return;
        }
        let Some((usage, range)) = cx.place().and_then(|place| usage(cx, &place, variable)) else { return };
        let (message, label) = match (usage, argument) {
            (Use::Tested | Use::HandedOn | Use::Counted, _) | (Use::Computed, Some(_)) => return,
            (Use::Word(letter), _) if in_macro && is_local && OF_AXES.contains(letter) => return,
            (Use::Word(letter), Some(argument)) => (
                format!("the call does not give `{argument}`: `{letter}` has no value (`#{variable}`)"),
                format!("the control ignores `{letter}`"),
            ),
            (Use::Word(letter), None) => (
                format!("`#{variable}` is empty: `{letter}` has no value"),
                format!("the control ignores `{letter}`"),
            ),
            (Use::Computed, None) => {
                (format!("`#{variable}` is empty, and is computed with"), "it counts as zero".to_owned())
            }
        };
        let help = match argument {
            Some(argument) => {
                format!("give `{argument}` in the call, or test `#{variable}` for `#0` first")
            }
            None => format!("set `#{variable}` to a number, or test it for `#0` first"),
        };
        self.told.insert(variable);
        report.add(cx.finding(&META, range, message).label(label).help(help));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn an_emptied_variable_is_told_once() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nG20 G90 G54 S900 M3\n#101=#0\nG1 Z#101 F10.\nX[#101+1.]\nD1\n#1=#101\nG41 D#1 X1. Y1.\nG40 X0.\nM30\n",
            &expect![[r#"
                4 | G1 Z#101 F10.
                  |    ^^^^^ info[empty-variable] `#101` is empty: `Z` has no value
                8 | G41 D#1 X1. Y1.
                  |     ^^^ info[empty-variable] `#1` is empty: `D` has no value
            "#]],
        );
    }

    #[test]
    fn an_argument_of_a_word_that_moves_nothing() {
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\nG65 P9100 I1.\nM30\nO9100\nG105 P#5 J1. K1. I4.\nM99\n",
            &expect![[r#"
                5 | G105 P#5 J1. K1. I4.
                  |      ^^^ info[empty-variable] the call does not give `J`: `P` has no value (`#5`)
            "#]],
        );
    }

    #[test]
    fn a_program_that_others_call_gets_its_local_variables() {
        let program = "O9300\nIF [#4003 EQ 90] GOTO 1\n#24=#5041+#24\nN1 G90 G0 X#24\nM99\n";
        check_rule(&RULE, "haas-mill", program, &expect![[""]]);
        let called =
            "O1\nG65 P9100 Y1.\nM30\nO9100\nIF [#4003 EQ 90] GOTO 1\n#24=#5041\nN1 G90 G0 X#24\nM99\n";
        check_rule(&RULE, "haas-mill", called, &expect![[""]]);
    }

    #[test]
    fn tests_copies_and_controls_without_empty_variables_are_not_reported() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\n#101=#0\n#102=#101\nIF [#102 EQ #0] GOTO 5\nN5 M30\n",
            &expect![[""]],
        );
        check_rule(&RULE, "linuxcnc", "#101=#0\nG1 X#101 F10\nM2\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", "O1\nG0 X#100\nM30\n", &expect![[""]]);
    }
}
