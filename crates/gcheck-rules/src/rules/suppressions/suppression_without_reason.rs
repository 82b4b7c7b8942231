//! A suppression without a reason.

use crate::Suppressions;
use crate::declare::declare_rule;
use crate::{Finding, Report, Run};

declare_rule! {
    /// A suppression comment gives no reason.
    ///
    /// ## Why it matters
    /// The next person at the machine cannot tell whether the reason still holds.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G999 (gcheck: ignore unknown-code)
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G999 (gcheck: ignore unknown-code - option fitted in 2024)
    /// ```
    rule "suppression-without-reason" in "suppressions" {
        summary: "suppression gives no reason",
        severity: Info,
        tier: Program,
        since: "0.1.0",
        run: Run::Suppressions { check },
    }
}

fn check(suppressions: &Suppressions, report: &mut Report<'_>) {
    for suppression in suppressions.list.iter().filter(|s| !s.has_reason) {
        report.add(
            Finding::new(&META, suppression.range.clone(), "suppression gives no reason")
                .help("add one after a dash: `(gcheck: ignore RULE - reason)`"),
        );
    }
}
