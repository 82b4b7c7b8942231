//! A turning cycle whose profile begins without `G0` or `G1`.

use crate::declare::declare_rule;
use crate::facts::turning::{is_roughing, profile_blocks};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// The block that `P` of a roughing cycle names has neither `G0` nor `G1`.
    ///
    /// ## Why it matters
    /// The first block says how the tool moves in for each pass, at rapid or at feed. Without `G0` or `G1` in it the
    /// control stops with an alarm, or uses whichever mode is active.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 T0101
    /// G97 S500 M3
    /// G0 X60. Z5.
    /// G71 U2. R1.
    /// G71 P10 Q20 U0.5 W0.1 F0.25
    /// N10 X30.
    /// G1 Z-20.
    /// N20 X50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 T0101
    /// G97 S500 M3
    /// G0 X60. Z5.
    /// G71 U2. R1.
    /// G71 P10 Q20 U0.5 W0.1 F0.25
    /// N10 G0 X30.
    /// G1 Z-20.
    /// N20 X50.
    /// G70 P10 Q20
    /// M30
    /// ```
    rule "turning-profile-first-block" in "cycles" {
        summary: "turning cycle whose profile begins without `G0` or `G1`",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(TurningProfileFirstBlock) },
    }
}

struct TurningProfileFirstBlock;

impl PathRule for TurningProfileFirstBlock {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_roughing)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(is_roughing) {
            return;
        }
        let Some((first, _)) = profile_blocks(cx) else { return };
        let Some(place) = cx.place_of(first) else { return };
        let words = place.table.words(place.block());
        if words.iter().any(|word| cx.model.effect(word.code).is_straight_move()) {
            return;
        }
        let name = words
            .first()
            .and_then(gcheck_program::Word::integer)
            .map(|number| format!("`N{number}` "))
            .unwrap_or_default();
        report.add(
            cx.finding(
                &META,
                place.range(),
                format!("the profile begins with a block {name}without `G0` or `G1`"),
            )
            .label("does not say how the tool moves in")
            .also(cx.range(), "the cycle that names it")
            .help("write `G0` or `G1` in the first block of the profile"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_block_itself_is_marked() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G20 G54 T0101\nG97 S500 M3\nG0 X3. Z.1\nG71 P10 Q20 D.05 U.02 W.005 F.01\nN10 X1.\nG1 Z-1. F.005\nN20 X2.\nM30\n",
            &expect![[r#"
                5 | N10 X1.
                  | ^^^^^^^ warning[turning-profile-first-block] the profile begins with a block `N10` without `G0` or `G1`
            "#]],
        );
    }
}
