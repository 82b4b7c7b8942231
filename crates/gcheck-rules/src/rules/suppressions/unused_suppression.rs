//! A suppression that silences nothing.

use crate::declare::declare_rule;
use crate::{Finding, Fix, Report, Run};
use crate::{Suppression, Suppressions};

declare_rule! {
    /// A suppression comment silences nothing.
    ///
    /// ## Why it matters
    /// The mistake that it was written for is gone, or the comment is on the wrong line. A suppression that remains
    /// hides the next mistake of its kind.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// (gcheck: ignore unknown-code - option fitted in 2024)
    /// G0 X1.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// (gcheck: ignore unknown-code - option fitted in 2024)
    /// G999
    /// ```
    rule "unused-suppression" in "suppressions" {
        summary: "suppression silences nothing",
        severity: Warning,
        tier: Program,
        fixable: Safely,
        since: "0.1.0",
        run: Run::Suppressions { check },
    }
}

fn check(suppressions: &Suppressions, report: &mut Report<'_>) {
    for suppression in suppressions.list.iter().filter(|s| !s.used) {
        report.add(finding(suppression));
    }
}

fn finding(suppression: &Suppression) -> Finding {
    let rules = suppression.selectors.iter().map(|s| format!("`{s}`")).collect::<Vec<_>>().join(", ");
    Finding::new(&META, suppression.range.clone(), format!("no finding of {rules} is silenced here"))
        .label("silences nothing")
        .note("a comment beside code counts for its own line, a comment alone on its line for the line below")
        .help("remove the comment")
        .fix(Fix::safe("remove the comment", suppression.range.clone(), ""))
}
