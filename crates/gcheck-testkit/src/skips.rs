//! Tests that cannot run because something is missing on this machine.
//!
//! Knows: what CI may do without, and why. Must not know: the tests.

use std::env;

/// What may be missing in CI as well, each with the reason. CI installs everything else (`cargo xtask test`).
const MAY_BE_MISSING: &[(&str, &str)] = &[
    ("corpus", "the real programs belong to others, and their licences do not allow copies here"),
    ("manuals", "the manuals belong to their publishers"),
    (
        "permissions",
        "the superuser of a container reads and writes everything; other systems run these tests",
    ),
    ("extended attributes", "the file system of a container may have none"),
    ("SARIF validator", "Microsoft makes it for Linux on x86-64 alone"),
    ("emacs", "only `cargo xtask test --editors` asks for the editors of the system"),
    ("system's Neovim", "only `cargo xtask test --editors` asks for the editors of the system"),
];

/// Says on standard error that a test is skipped, what is missing, and how to get it.
///
/// # Panics
///
/// On Linux where `CI` is `true` or `GCHECK_REQUIRE_TOOLS` is set, unless `MAY_BE_MISSING` gives a reason. On other systems CI
/// runs the tests without their tools.
#[expect(clippy::print_stderr, reason = "a test that is skipped must say so where people look")]
pub fn skip(test: &str, missing: &str, remedy: &str) {
    let is_set = |name: &str| env::var_os(name).is_some_and(|value| !value.is_empty() && value != "false");
    let demands_tools = cfg!(target_os = "linux") && (is_set("CI") || is_set("GCHECK_REQUIRE_TOOLS"));
    match verdict(missing, demands_tools) {
        Ok(reason) => eprintln!("skipped: {test} (missing: {missing}; {})", reason.unwrap_or(remedy)),
        Err(why) => panic!("{test}: {why}; {remedy}"),
    }
}

/// May a test be skipped for this? The reason where there is a list of them; else what to say.
fn verdict(missing: &str, demands_tools: bool) -> Result<Option<&'static str>, String> {
    let reason = MAY_BE_MISSING.iter().find(|(name, _)| *name == missing).map(|(_, reason)| *reason);
    if demands_tools && reason.is_none() {
        return Err(format!("{missing} is missing, and CI must not skip what it needs"));
    }
    Ok(reason)
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::{Path, PathBuf};

    use super::{MAY_BE_MISSING, skip, verdict};

    #[test]
    fn ci_fails_for_a_missing_tool_that_it_installs() {
        verdict("mdbook", true).unwrap_err();
        assert_eq!(verdict("mdbook", false), Ok(None));
        for (name, reason) in MAY_BE_MISSING {
            assert_eq!(verdict(name, true), Ok(Some(*reason)), "{name}");
        }
        skip("this_test", "corpus", "set GCHECK_CORPUS");
    }

    fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.extension() {
                _ if path.is_dir() => sources(&path, found),
                Some(extension) if extension == "rs" => found.push(path),
                _ => {}
            }
        }
    }

    /// A test that skips itself with words of its own would pass in CI.
    #[test]
    fn every_test_skips_by_this_module() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let mut files = Vec::new();
        for folder in ["crates", "tests"] {
            sources(&root.join(folder), &mut files);
        }
        assert!(files.len() > 500, "{}", files.len());
        let mut reasons_used = Vec::new();
        for file in files.iter().filter(|file| !file.ends_with("gcheck-testkit/src/skips.rs")) {
            let text = fs::read_to_string(file).unwrap();
            for words in ["\"skipped: ", "\"passed over: "] {
                assert!(!text.contains(words), "{} has `{words}`: call skips::skip", file.display());
            }
            let names = MAY_BE_MISSING.iter().map(|(name, _)| *name);
            reasons_used.extend(names.filter(|name| text.contains(&format!("\"{name}\""))));
        }
        for (name, _) in MAY_BE_MISSING {
            assert!(reasons_used.contains(name), "no test misses `{name}`");
        }
    }
}
