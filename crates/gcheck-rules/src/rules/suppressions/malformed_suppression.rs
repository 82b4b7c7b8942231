//! A `gcheck:` comment that cannot be read.

use crate::meta::declare_rule;
use crate::suppression::Suppressions;
use crate::{Finding, Report, Run};

declare_rule! {
    /// A `gcheck:` comment is not understood, so it silences nothing.
    ///
    /// ## Why it matters
    /// Whoever wrote it believes that a finding is silenced.
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
        summary: "gcheck comment is not understood",
        severity: Warning,
        tier: Program,
        mends: Safely,
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
                .fix_if(malformed.meant.clone()),
        );
    }
}
