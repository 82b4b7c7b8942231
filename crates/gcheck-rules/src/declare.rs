//! How a rule is declared: its documentation, its metadata and how it runs, in one place.
//!
//! Knows: the shape of a declaration. Must not know: any rule.

/// Declares a rule: its documentation, its metadata and how it runs.
///
/// Expands to two statics, `META` and `RULE`.
macro_rules! declare_rule {
    (
        $(#[doc = $doc:literal])*
        rule $id:literal in $group:literal {
            summary: $summary:literal,
            severity: $severity:ident,
            tier: $tier:ident,
            $(control_specific: $control_specific:literal,)?
            $(recommended: $recommended:literal,)?
            $(sets: [$($set:ident),+],)?
            $(fixable: $fixable:ident,)?
            $(aliases: $aliases:expr,)?
            since: $since:literal,
            run: $run:expr,
        }
    ) => {
        pub(crate) static META: ::gcheck_diagnostics::RuleMeta = ::gcheck_diagnostics::RuleMeta {
            id: $id,
            group: $group,
            summary: $summary,
            severity: ::gcheck_diagnostics::Severity::$severity,
            control_specific: false $(|| $control_specific)?,
            recommended: true $(&& $recommended)?,
            other_sets: &[$($(::gcheck_diagnostics::RuleSet::$set),+)?],
            fixability: declare_rule!(@fixable $($fixable)?),
            since: $since,
            aliases: declare_rule!(@aliases $($aliases)?),
            tier: ::gcheck_diagnostics::Tier::$tier,
            raw_docs: concat!($($doc, "\n",)*),
        };

        pub(crate) static RULE: ::gcheck_lint::RuleEntry = ::gcheck_lint::RuleEntry { meta: &META, run: $run };
    };
    (@fixable $fixable:ident) => { ::gcheck_diagnostics::Fixability::$fixable };
    (@fixable) => { ::gcheck_diagnostics::Fixability::Never };
    (@aliases $aliases:expr) => { $aliases };
    (@aliases) => { &[] };
}
pub(crate) use declare_rule;
