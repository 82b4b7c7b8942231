//! The rules, one file each, in folders by group.
//!
//! `generated.rs` lists them from the folders (`cargo xtask gen`); nothing else names a rule.

#[path = "rules/generated.rs"]
mod generated;

use gcheck_lint::RuleTable;

/// Every rule, sorted by group and id.
pub static RULES: RuleTable = RuleTable::new(generated::ALL);
