//! The rules, one file each, in folders by group.
//!
//! `generated.rs` lists them from the folders (`cargo xtask gen`); nothing else names a rule.

#[path = "rules/generated.rs"]
mod generated;

use crate::RuleEntry;

/// Every rule, sorted by group and id.
pub fn all() -> &'static [&'static RuleEntry] {
    generated::ALL
}

/// The rule of an id or alias.
pub fn by_id(id: &str) -> Option<&'static RuleEntry> {
    all().iter().copied().find(|rule| rule.meta.id == id || rule.meta.aliases.contains(&id))
}
