//! `deny.toml` holds without cargo-deny: its licences cover the dependency graph, its bans say what the layer law says.
//!
//! Knows: the parts of `deny.toml` that state our own law, licence expressions. Must not know: advisories, which only
//! cargo-deny can look up.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::Context as _;
use cargo_metadata::Metadata;
use toml::Value;

use super::layers;
use super::problem::Problem;

const FILE: &str = "deny.toml";

/// What is read of `deny.toml`.
pub(super) struct Deny {
    licences: Vec<String>,
    /// Foreign crate, and who may use it directly.
    wrappers: BTreeMap<String, Vec<String>>,
}

impl Deny {
    pub(super) fn read(root: &Path) -> anyhow::Result<Self> {
        Self::parse(&fs::read_to_string(root.join(FILE)).context(FILE)?)
    }

    fn parse(text: &str) -> anyhow::Result<Self> {
        let table: toml::Table = text.parse().context(FILE)?;
        let list = |value: Option<&Value>| -> Vec<String> {
            let items = value.and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
            items.iter().filter_map(Value::as_str).map(str::to_owned).collect()
        };
        let licences = list(table.get("licenses").and_then(|t| t.get("allow")));
        let bans = table.get("bans").and_then(|t| t.get("deny")).and_then(Value::as_array);
        let wrappers = bans
            .into_iter()
            .flatten()
            .filter_map(|ban| Some((ban.get("crate")?.as_str()?.to_owned(), list(ban.get("wrappers")))))
            .collect();
        Ok(Self { licences, wrappers })
    }
}

/// Differences between the bans and the layer law.
pub(super) fn bans(deny: &Deny) -> Vec<Problem> {
    let mut problems = Vec::new();
    for (name, users) in layers::ONLY {
        // Foreign crates among the wrappers (the server framework uses tokio itself) do not matter here.
        let ours = |w: &&String| w.starts_with("gcheck") || *w == "xtask";
        let mut listed: Vec<&str> =
            deny.wrappers.get(*name).into_iter().flatten().filter(ours).map(String::as_str).collect();
        listed.sort_unstable();
        if listed != *users {
            let message = format!(
                "[bans] lets {listed:?} use `{name}`, crates/xtask/src/tidy/layers.rs lets {users:?}"
            );
            problems.push(Problem::new(FILE, 0, message));
        }
    }
    problems
}

/// Packages and their licences, for every package that is built for this machine.
pub(super) fn licences_in_use(graph: &Metadata) -> Vec<(String, String)> {
    graph.packages.iter().map(|p| (p.name.to_string(), p.license.clone().unwrap_or_default())).collect()
}

/// Packages whose licence the list does not allow.
pub(super) fn licences(deny: &Deny, packages: &[(String, String)]) -> Vec<Problem> {
    packages
        .iter()
        .filter(|(_, licence)| !is_allowed(licence, &deny.licences))
        .map(|(name, licence)| {
            Problem::new(FILE, 0, format!("the licence `{licence}` of `{name}` is not in [licenses] allow"))
        })
        .collect()
}

/// Evaluates a licence expression: `OR` (or the old `/`) needs one side, `AND` both.
fn is_allowed(expression: &str, allowed: &[String]) -> bool {
    let spaced = expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let mut rest = words.as_slice();
    let verdict = any_of(&mut rest, allowed);
    verdict && rest.is_empty()
}

fn any_of(words: &mut &[&str], allowed: &[String]) -> bool {
    let mut verdict = all_of(words, allowed);
    while let [w, rest @ ..] = words
        && *w == "OR"
    {
        *words = rest;
        verdict |= all_of(words, allowed);
    }
    verdict
}

fn all_of(words: &mut &[&str], allowed: &[String]) -> bool {
    let mut verdict = one(words, allowed);
    while let [w, rest @ ..] = words
        && *w == "AND"
    {
        *words = rest;
        verdict &= one(words, allowed);
    }
    verdict
}

fn one(words: &mut &[&str], allowed: &[String]) -> bool {
    let (name, rest) = match *words {
        ["(", rest @ ..] => {
            *words = rest;
            let verdict = any_of(words, allowed);
            if let [")", rest @ ..] = *words {
                *words = rest;
            }
            return verdict;
        }
        [name, "WITH", exception, rest @ ..] => (format!("{name} WITH {exception}"), rest),
        [name, rest @ ..] => ((*name).to_owned(), rest),
        [] => return false,
    };
    *words = rest;
    allowed.contains(&name)
}

#[cfg(test)]
mod tests {
    use super::{Deny, bans, is_allowed};

    #[test]
    fn licence_expressions() {
        let allowed = ["MIT", "Unicode-3.0", "Apache-2.0 WITH LLVM-exception"].map(str::to_owned);
        for good in [
            "MIT",
            "MIT/Apache-2.0",
            "GPL-3.0 OR MIT",
            "(MIT OR BSL-1.0) AND Unicode-3.0",
            "Apache-2.0 WITH LLVM-exception",
        ] {
            assert!(is_allowed(good, &allowed), "{good}");
        }
        for bad in ["", "GPL-3.0", "MIT AND GPL-3.0", "Apache-2.0 AND (MIT OR GPL-3.0)", "MIT MIT"] {
            assert!(!is_allowed(bad, &allowed), "{bad}");
        }
    }

    #[test]
    fn a_ban_that_differs_from_the_law_is_found() {
        let deny =
            Deny::parse("[bans]\ndeny = [{ crate = \"rowan\", wrappers = [\"gcheck-rules\"] }]\n").unwrap();
        let found = bans(&deny);
        assert!(found.iter().any(|p| p.message.contains("`rowan`")), "{found:?}");
    }
}
