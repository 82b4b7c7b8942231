//! A `gcheck:` comment that cannot be read.

use crate::Suppressions;
use crate::declare::declare_rule;
use crate::{Finding, Report, Run};

declare_rule! {
    /// gcheck cannot read a `gcheck:` comment, so the comment silences nothing.
    ///
    /// ## Why it matters
    /// Its author believes that a finding is silenced.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G999 (gcheck: ignore unknwon-code - option fitted in 2024)
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G999 (gcheck: ignore unknown-code - option fitted in 2024)
    /// ```
    rule "malformed-suppression" in "suppressions" {
        summary: "gcheck comment cannot be read",
        severity: Warning,
        tier: Program,
        fixable: Safely,
        since: "0.1.0",
        run: Run::Suppressions { check },
    }
}

fn check(suppressions: &Suppressions, report: &mut Report<'_>) {
    for malformed in &suppressions.malformed {
        report.add(
            Finding::new(&META, malformed.range.clone(), malformed.message.clone())
                .label("silences nothing")
                .help("write `(gcheck: ignore RULE - reason)`; `gcheck rules` lists the rules")
                .fix_if(malformed.fix.clone()),
        );
    }
}
