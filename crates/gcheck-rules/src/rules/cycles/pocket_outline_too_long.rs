//! The outline of a pocket with more moves than the control takes.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::At;

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_code;
use crate::facts::pockets::outline_of;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The outline of a pocket has more moves than the control's manual allows.
    ///
    /// ## Why it matters
    /// Older controls stop with an alarm at the pocket; how many moves a newer one takes depends on its software.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
    /// M30
    /// O100
    /// G1 Y1.
    /// X.1
    /// X.2
    /// X.3
    /// X.4
    /// X.5
    /// X.6
    /// X.7
    /// X.8
    /// X.9
    /// X1.
    /// Y.9
    /// Y.8
    /// Y.7
    /// Y.6
    /// Y.5
    /// Y.4
    /// Y.3
    /// Y.2
    /// Y.1
    /// Y0.
    /// Y-.1
    /// Y-.2
    /// Y-.3
    /// Y-.4
    /// Y-.5
    /// Y-.6
    /// Y-.7
    /// Y-.8
    /// Y-.9
    /// Y-1.
    /// X.9
    /// X.8
    /// X.7
    /// X.6
    /// X.5
    /// X.4
    /// X-1.
    /// Y0.
    /// Y1.
    /// X0.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
    /// M30
    /// O100
    /// G1 Y1.
    /// X1.
    /// Y-1.
    /// X-1.
    /// Y1.
    /// X0.
    /// M99
    /// ```
    rule "pocket-outline-too-long" in "cycles" {
        summary: "outline of a pocket with more moves than the control takes",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(PocketOutlineTooLong) },
    }
}

struct PocketOutlineTooLong;

impl PathRule for PocketOutlineTooLong {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(most) = cx.model.semantics().cycles.pocket_moves else { return };
        if !cx.has_effect(|effect| effect == Effect::GeneralPocket) {
            return;
        }
        let (Some(blocks), Some(code)) = (outline_of(cx), cycle_code(cx)) else { return };
        let mut moves = 0;
        for block in blocks {
            let Some(place) = cx.place_of(At { file: 0, block }) else { return };
            let read = place.block();
            let words = place.table.words(read);
            if words.iter().any(|word| cx.model.effect(word.code) == Effect::Return) {
                break;
            }
            moves += u32::from(read.letters.intersects(const { LetterSet::of("XYIJ") }));
        }
        if moves <= most {
            return;
        }
        let name = code.number();
        report.add(
            cx.finding(
                &META,
                cx.letter_range('P'),
                format!("the pocket's outline has {moves} moves (`{name}`)"),
            )
            .label(format!("the control's manual allows {most}"))
            .note(format!(
                "how many moves an outline may have differs with the control's software; older ones take {most}  [{}]",
                code.entry().source
            ))
            .help("write the outline with fewer moves: arcs instead of chords, one line instead of several"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn forty_are_allowed() {
        let program = |moves: usize| {
            let head = "G20 G90 G54 G0 X0. Y0.\nG150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.\nM30\nO100\nG1 Y1.\n(NOTE)\n";
            format!("{head}{}M99\n", "X1.\n".repeat(moves - 1))
        };
        check_rule(&RULE, "haas-mill", &program(40), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &program(41),
            &expect![[r#"
            2 | G150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
              |      ^^^^ warning[pocket-outline-too-long] the pocket's outline has 41 moves (`G150`)
        "#]],
        );
    }
}
