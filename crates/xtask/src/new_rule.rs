//! `cargo xtask new-rule ID --tier TIER --group GROUP`: a rule's file, ready to be filled in.
//!
//! Knows: how a rule's file looks (`templates/rule.rs.in`) and how rules are named. Must not know: what rules check.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context as _, bail, ensure};

use crate::generate::{self, registry};
use crate::workspace;

const USAGE: &str = "usage: cargo xtask new-rule ID --tier token|block|program|path --group GROUP";

const TEMPLATE: &str = include_str!("../templates/rule.rs.in");

/// What differs between rules of different tiers.
struct Tier {
    name: &'static str,
    variant: &'static str,
    uses: &'static str,
    run: &'static str,
    check: &'static str,
    parameters: &'static str,
    range: &'static str,
}

const TIERS: &[Tier] = &[
    Tier {
        name: "token",
        variant: "Token",
        uses: "\
use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};",
        run: "Run::Token { on: |kind| kind == SyntaxErrorKind::StrayParenthesis, check }",
        check: "\
fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}",
        parameters: "cx: &BlockCx<'_>, error: &SyntaxError",
        range: "cx.in_file(error.range.clone())",
    },
    Tier {
        name: "block",
        variant: "Block",
        uses: "\
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};",
        run: "Run::Block { trigger: BlockFlags::CODE, check }",
        check: "\
fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (word, code) in cx.codes() {
        // Ask the knowledge base what the code needs; no control has a name here.
        if code.entry().alone && cx.words().len() > 1 {
            report.add(finding(cx, word));
        }
    }
}",
        parameters: "cx: &BlockCx<'_>, word: &Word",
        range: "cx.range(word)",
    },
    Tier {
        name: "program",
        variant: "Program",
        uses: "\
use gcheck_program::Label;

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};",
        run: "Run::Program { check }",
        check: "\
fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    for label in &cx.file_index.labels {
        if label.number == 0 {
            report.add(finding(label));
        }
    }
}",
        parameters: "label: &Label",
        range: "label.range.clone()",
    },
    Tier {
        name: "path",
        variant: "Path",
        uses: "\
use gcheck_engine::{Event, Spindle};

use crate::declare::declare_rule;
use crate::{Finding, PathCx, PathRule, Report, Run, Watch};",
        run: "Run::Path { watch: Watch::CUTS, make: || Box::new(Watcher) }",
        check: "\
struct Watcher;

impl PathRule for Watcher {
    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        // `None` says that it may turn or not: only what is certain is reported.
        if cx.state().spindle() == Some(Spindle::Stopped) {
            report.add(finding(cx));
        }
    }
}",
        parameters: "cx: &PathCx<'_>",
        range: "cx.range()",
    },
];

/// A rule to be made.
struct Request<'a> {
    id: &'a str,
    tier: &'a Tier,
    group: &'a str,
}

/// Writes the file and the registry, and says what comes next.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let request = parse(arguments)?;
    let root = workspace::root();
    let path = scaffold(root, &request)?;
    println!("wrote  {}", path.display());
    generate::write(root, &registry::generate()?)?;
    let module = request.id.replace('-', "_");
    println!(
        "
next   fill in every TODO of the file, the examples first
       cargo test -p gcheck-rules {module}     (UPDATE_EXPECT=1 writes the expected findings)
       cargo xtask gen                         (the rule's page)
       cargo xtask test"
    );
    Ok(ExitCode::SUCCESS)
}

fn parse(arguments: &[String]) -> anyhow::Result<Request<'_>> {
    let mut id = None;
    let mut tier = None;
    let mut group = None;
    let mut rest = arguments.iter().map(String::as_str);
    while let Some(argument) = rest.next() {
        match argument {
            "--tier" => tier = rest.next(),
            "--group" => group = rest.next(),
            _ if argument.starts_with('-') || id.is_some() => bail!("`{argument}` is unexpected\n{USAGE}"),
            _ => id = Some(argument),
        }
    }
    let id = id.context(USAGE)?;
    let group = group.context(USAGE)?;
    let tier = tier.context(USAGE)?;
    let tier = TIERS
        .iter()
        .find(|t| t.name == tier)
        .with_context(|| format!("there is no tier `{tier}`\n{USAGE}"))?;
    ensure!(is_name(id, '-'), "`{id}` is not a rule id: lower-case words with dashes between them");
    ensure!(is_name(group, '_'), "`{group}` is not a group: a lower-case word");
    let tells =
        ["check-", "no-", "avoid-", "bad-"].iter().any(|p| id.starts_with(p)) || id.ends_with("-error");
    ensure!(!tells, "`{id}` does not name the defect; say what is wrong, as in `dwell-without-time`");
    Ok(Request { id, tier, group })
}

fn is_name(text: &str, separator: char) -> bool {
    text.starts_with(|c: char| c.is_ascii_lowercase())
        && text
            .split(separator)
            .all(|w| !w.is_empty() && w.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit()))
}

/// Writes the rule's file under `root` and returns its path from there.
fn scaffold(root: &Path, request: &Request<'_>) -> anyhow::Result<PathBuf> {
    let module = request.id.replace('-', "_");
    let rules = root.join(registry::RULES);
    for (group, modules) in registry::groups(&rules)? {
        ensure!(!modules.contains(&module), "`{}` exists already, in the group `{group}`", request.id);
    }
    let path = Path::new(registry::RULES).join(request.group).join(format!("{module}.rs"));
    fs::create_dir_all(rules.join(request.group))?;
    fs::write(root.join(&path), fill(request)).with_context(|| path.display().to_string())?;
    Ok(path)
}

fn fill(request: &Request<'_>) -> String {
    let tier = request.tier;
    let values = [
        ("@ID@", request.id),
        ("@GROUP@", request.group),
        ("@SINCE@", env!("CARGO_PKG_VERSION")),
        ("@TIER@", tier.variant),
        ("@USES@", tier.uses),
        ("@RUN@", tier.run),
        ("@CHECK@", tier.check),
        ("@PARAMETERS@", tier.parameters),
        ("@RANGE@", tier.range),
    ];
    values.iter().fold(TEMPLATE.to_owned(), |text, (key, value)| text.replace(key, value))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use proc_macro2::TokenStream;

    use super::{TIERS, parse, scaffold};
    use crate::generate::registry::{RULES, groups};

    fn arguments(line: &str) -> Vec<String> {
        line.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn a_rule_of_each_tier_is_rust_and_gets_into_the_registry() {
        let root = tempfile::tempdir().unwrap();
        fs::create_dir_all(root.path().join(RULES)).unwrap();
        for tier in TIERS {
            let line = format!("spindle-{}-stopped --tier {} --group spindle", tier.name, tier.name);
            let arguments = arguments(&line);
            let path = scaffold(root.path(), &parse(&arguments).unwrap()).unwrap();
            let text = fs::read_to_string(root.path().join(path)).unwrap();
            assert!(text.parse::<TokenStream>().is_ok(), "{text}");
            assert!(!text.contains('@'), "{text}");
            assert!(
                text.contains(&format!("rule \"spindle-{}-stopped\" in \"spindle\"", tier.name)),
                "{text}"
            );
        }
        let modules = [
            "spindle_block_stopped",
            "spindle_path_stopped",
            "spindle_program_stopped",
            "spindle_token_stopped",
        ];
        assert_eq!(
            groups(&root.path().join(RULES)).unwrap(),
            [("spindle".to_owned(), modules.map(str::to_owned).to_vec())]
        );
    }

    #[test]
    fn a_rule_is_never_overwritten() {
        let root = tempfile::tempdir().unwrap();
        fs::create_dir_all(root.path().join(RULES)).unwrap();
        let arguments = arguments("feed-missing --tier block --group motion");
        let request = parse(&arguments).unwrap();
        scaffold(root.path(), &request).unwrap();
        assert!(scaffold(root.path(), &request).is_err());
    }

    #[test]
    fn names_that_do_not_name_a_defect_are_refused() {
        for id in ["no-feed", "check-feed", "feed-error", "Feed", "feed--missing", "feed_missing", "-x"] {
            assert!(parse(&arguments(&format!("{id} --tier block --group motion"))).is_err(), "{id}");
        }
        assert!(parse(&arguments("feed-missing --tier flow --group motion")).is_err());
    }
}
