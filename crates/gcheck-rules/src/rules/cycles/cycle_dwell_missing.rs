//! A drilling cycle with dwell that gives no dwell time.

use gcheck_controls::{Effect, Letter, Need};

use crate::declare::declare_rule;
use crate::facts::cycles::{Series, cycle_range};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A canned cycle that differs from the plain one by its dwell begins without `P`.
    ///
    /// ## Why it matters
    /// The tool does not dwell: `G82` drills like `G81`, and the floor of the spot face keeps its feed marks.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G0 X0 Y0 Z10.
    /// G82 Z-5. R2. F100.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G0 X0 Y0 Z10.
    /// G82 Z-5. R2. P500 F100.
    /// X10.
    /// G80
    /// M30
    /// ```
    rule "cycle-dwell-missing" in "cycles" {
        summary: "canned cycle with dwell, without a dwell time",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(CycleDwellMissing::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleDwellMissing {
    series: Series,
    told: bool,
}

remembers!(CycleDwellMissing: series);

impl PathRule for CycleDwellMissing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(code) = self.series.block(cx).and_then(|ix| cx.control().code_at(ix)) else { return };
        let p = Letter::of('P');
        let dwells = matches!(code.effect(), Effect::CycleDrillDwell | Effect::CycleBoreDwell);
        let entry = code.entry().words.iter().find(|word| Letter::parse(&word.letter) == Some(p));
        // If the word is required, another rule asks for it.
        let optional = entry.is_some_and(|word| matches!(word.need, Need::Optional | Need::Conditional));
        if !dwells || !optional || cx.origin().letters.contains(p) || self.told {
            return;
        }
        self.told = true;
        let name = code.number();
        report.add(
            cx.finding(
                &META,
                cycle_range(cx),
                format!("canned cycle with dwell without a time (`{name}` without `P`)"),
            )
            .label("the tool does not dwell at the bottom")
            .help("give the time with `P`, or use the cycle without dwell"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_code_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G0 X0 Y0 Z1.\nG82 Z-.5 R.1 P#100 F10.\nG80\nG89 Z-.5 R.1\nG80\nM30\n",
            &expect![[r#"
                4 | G89 Z-.5 R.1
                  | ^^^ info[cycle-dwell-missing] canned cycle with dwell without a time (`G89` without `P`)
            "#]],
        );
    }
}
