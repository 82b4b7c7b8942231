//! No control and no builder has a name in code: what differs between controls is data.
//!
//! Knows: names of builders; those of controls come from the folders of the knowledge base. Documentation, examples in
//! it, tests and dev crates may name whom they like.

use super::problem::Problem;
use super::tokens::{RustFile, Token};
use crate::workspace::TextFile;

/// Builders and controls, whether the knowledge base has them or not.
const BUILDERS: &[&str] = &[
    "bobscnc",
    "dah lih",
    "fagor",
    "fanuc",
    "fluidnc",
    "grbl",
    "haas",
    "heidenhain",
    "hurco",
    "linuxcnc",
    "marlin",
    "mazak",
    "mazatrol",
    "mitsubishi",
    "okuma",
    "pocketnc",
    "shapeoko",
    "sherline",
    "siemens",
    "sinumerik",
    "tormach",
    "tsnc",
];

/// Words in names of controls that name nobody.
const NOBODY: &[&str] = &["axes", "generic", "lathe", "machines", "mill", "turn"];

/// Crates that never ship.
const FREE: &[&str] = &["gcheck-testkit"];

/// Files that may name somebody, and why. Keep it short: each line is a place where a control is more than data.
const EXCEPTIONS: &[(&str, &str)] = &[
    ("crates/xtask/src/tidy/names.rs", "the list of names itself"),
    ("crates/xtask/src/bench/peer.rs", "the reference interpreter that speed is compared with"),
    ("crates/xtask/src/test.rs", "the package of the reference interpreter"),
];

const DATA: &str = "crates/gcheck-controls/data/";

/// All words that name somebody, lower case: builders, and the words of the knowledge base's folder names.
pub(super) fn banned(files: &[TextFile]) -> Vec<String> {
    let mut words: Vec<String> = BUILDERS.iter().map(ToString::to_string).collect();
    for file in files {
        let Some((folder, _)) = file.path.strip_prefix(DATA).and_then(|rest| rest.split_once('/')) else {
            continue;
        };
        // Shorter words (`yh`) would be found inside ordinary ones.
        words.extend(folder.split('-').filter(|w| w.len() >= 4 && !NOBODY.contains(w)).map(str::to_owned));
    }
    words.sort();
    words.dedup();
    words
}

/// Names and strings of product code that name somebody.
pub(super) fn problems(file: &RustFile<'_>, banned: &[String]) -> Vec<Problem> {
    let free = file.source_of().is_none_or(|name| FREE.contains(&name));
    if free || EXCEPTIONS.iter().any(|(path, _)| *path == file.path) {
        return Vec::new();
    }
    let mut problems = Vec::new();
    for placed in file.product() {
        let text = match &placed.token {
            Token::Word(text) | Token::Text(text) => text,
            Token::Mark(_) => continue,
        };
        // Rules carry their documentation as text; its examples say for which control they hold.
        for (offset, line) in
            text.lines().enumerate().filter(|(_, line)| !line.trim_start().starts_with("```nc,"))
        {
            let line = line.to_lowercase();
            if let Some(name) = banned.iter().find(|name| line.contains(name.as_str())) {
                problems.push(Problem::new(
                    file.path,
                    placed.line + offset,
                    format!(
                        "`{name}` names a control or builder in code; make the difference a fact in {DATA}"
                    ),
                ));
            }
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::{banned, problems};
    use crate::tidy::tokens::RustFile;
    use crate::workspace::TextFile;

    fn file(path: &str, text: &str) -> TextFile {
        TextFile { path: path.to_owned(), text: text.to_owned() }
    }

    fn lines(path: &str, text: &str) -> Vec<usize> {
        let banned = banned(&[file("crates/gcheck-controls/data/acme-mill/control.toml", "")]);
        let file = file(path, text);
        problems(&RustFile::new(&file).unwrap(), &banned).into_iter().map(|p| p.line).collect()
    }

    #[test]
    fn names_in_code_are_found() {
        let text =
            "//! Acme\n/// On Haas.\nfn is_haas() {}\nconst A: &str = \"acme-mill\";\nstruct FanucMill;\n";
        assert_eq!(lines("crates/gcheck-rules/src/a.rs", text), [3, 4, 5]);
    }

    #[test]
    fn examples_and_tests_may_name_controls() {
        let text = "const DOCS: &str = \"\n```nc,reported,acme-mill\nG1\n```\nOn acme.\n\";\n#[cfg(test)]\nmod tests { const A: &str = \"acme\"; }\n";
        assert_eq!(lines("crates/gcheck-rules/src/a.rs", text), [5]);
        assert_eq!(lines("crates/gcheck-testkit/src/a.rs", text), [0_usize; 0]);
        assert_eq!(lines("crates/gcheck-rules/tests/a.rs", text), [0_usize; 0]);
    }
}
