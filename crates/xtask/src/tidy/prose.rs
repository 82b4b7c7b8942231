//! Prose is plain: no word of a list in pages, comments and texts.
//!
//! Knows: where prose is in a file, and the list (`prose.toml`). Must not know: what a sentence says.

use anyhow::Context as _;
use serde::Deserialize;

use super::problem::Problem;
use super::tokens::{RustFile, Token};
use crate::workspace::TextFile;

const LIST: &str = include_str!("prose.toml");

/// Why a crate is not judged: some of its comments still have words of the list.
const NOT_YET: &str = "comments still have words of the list";

/// Files that are not judged, and why.
const EXEMPT: &[(&str, &str)] = &[
    ("crates/xtask/src/tidy/prose", "the list itself, and tests of it"),
    ("docs/SUMMARY.md", "titles of the pages"),
    ("docs/controls/", "generated from the data of the controls"),
    ("docs/dev/corpus.md", "written by a command"),
    ("docs/dev/statements/", "generated from the tests"),
    ("docs/dev/style.md", "quotes the words"),
    ("docs/precision.md", "written by a command"),
    ("docs/recall.md", "generated from the tests"),
    ("docs/rules/", "generated from the rules, which are judged"),
    ("docs/seeds.md", "generated from the tests"),
    ("crates/gcheck/", NOT_YET),
    ("crates/gcheck-controls/", NOT_YET),
    ("crates/gcheck-db/", NOT_YET),
    ("crates/gcheck-diagnostics/", NOT_YET),
    ("crates/gcheck-engine/", "state, step and flow are being rewritten"),
    ("crates/gcheck-format/", NOT_YET),
    ("crates/gcheck-geometry/", NOT_YET),
    ("crates/gcheck-ide/", NOT_YET),
    ("crates/gcheck-planner/", NOT_YET),
    ("crates/gcheck-program/", NOT_YET),
    ("crates/gcheck-server/", NOT_YET),
    ("crates/gcheck-syntax/", NOT_YET),
    ("crates/gcheck-testkit/", NOT_YET),
    ("crates/gcheck-toolpath/", NOT_YET),
    ("crates/xtask/", NOT_YET),
    ("tests/", NOT_YET),
    ("crates/gcheck-lint/src/incremental", "the runner of path rules is being rewritten"),
    ("crates/gcheck-lint/src/path_context.rs", "the runner of path rules is being rewritten"),
    ("crates/gcheck-lint/src/watchers.rs", "the runner of path rules is being rewritten"),
];

/// The list of phrases.
#[derive(Debug, Deserialize)]
struct Phrases {
    phrase: Vec<Phrase>,
    /// Phrases that are unwanted at the beginning of a sentence only.
    opening: Vec<Phrase>,
}

/// Phrases with one replacement.
#[derive(Debug, Deserialize)]
struct Phrase {
    words: Vec<String>,
    /// What to write instead.
    write: String,
    /// Longer phrases in which these are right.
    #[serde(default)]
    unless: Vec<String>,
}

/// Unwanted phrases in pages and Rust files.
#[expect(
    clippy::case_sensitive_file_extension_comparisons,
    reason = "files of the repository have small letters"
)]
pub(super) fn problems(files: &[TextFile], rust: &[RustFile<'_>]) -> anyhow::Result<Vec<Problem>> {
    let phrases: Phrases = toml::from_str(LIST).context("crates/xtask/src/tidy/prose.toml")?;
    let is_judged = |path: &str| !EXEMPT.iter().any(|(exempt, _)| path.starts_with(exempt));
    let mut problems = Vec::new();
    for file in files.iter().filter(|file| file.path.ends_with(".md") && is_judged(&file.path)) {
        for (line, text) in outside_fences(file.text.lines().enumerate().map(|(line, text)| (line + 1, text)))
        {
            judge(&phrases, &file.path, line, text, &mut problems);
        }
    }
    for file in rust.iter().filter(|file| is_judged(file.path)) {
        let comments = file.text.lines().enumerate().filter_map(|(line, text)| {
            let comment = text.trim_start().strip_prefix("//")?;
            Some((line + 1, comment.trim_start_matches(['/', '!'])))
        });
        for (line, text) in outside_fences(comments) {
            judge(&phrases, file.path, line, text, &mut problems);
        }
        for placed in file.product() {
            if let Token::Text(text) = &placed.token
                && text.contains(' ')
            {
                judge(&phrases, file.path, placed.line, text, &mut problems);
            }
        }
    }
    Ok(problems)
}

/// Lines that are not inside a fenced block of code.
fn outside_fences<'t>(
    lines: impl Iterator<Item = (usize, &'t str)>,
) -> impl Iterator<Item = (usize, &'t str)> {
    let mut is_code = false;
    lines.filter(move |(_, text)| {
        let is_fence = text.trim_start().starts_with("```");
        is_code ^= is_fence;
        !is_code && !is_fence
    })
}

fn judge(phrases: &Phrases, path: &str, line: usize, text: &str, problems: &mut Vec<Problem>) {
    let text = without_code(text);
    let words = Words::of(&text);
    let mut say = |phrase: &str, write: &str| {
        problems.push(Problem::new(path, line, format!("`{phrase}`: write {write} (style.md, Text)")));
    };
    for phrase in &phrases.phrase {
        let right: usize = phrase.unless.iter().map(|right| words.count(right)).sum();
        let found: usize = phrase.words.iter().map(|word| words.count(word)).sum();
        if found > right
            && let Some(word) = phrase.words.iter().find(|word| words.count(word) > 0)
        {
            say(word, &phrase.write);
        }
    }
    for phrase in &phrases.opening {
        if let Some(word) = phrase.words.iter().find(|word| words.opens_with(word)) {
            say(word, &phrase.write);
        }
    }
}

/// The text without what is in backticks.
fn without_code(text: &str) -> String {
    text.split('`').step_by(2).collect::<Vec<_>>().join(" ")
}

/// A line as words in lower case, with the words that begin a sentence which is not a question.
struct Words {
    words: Vec<String>,
    opening: Vec<usize>,
}

impl Words {
    fn of(text: &str) -> Self {
        let mut words = Vec::new();
        let mut opening = Vec::new();
        for sentence in text.split_inclusive(['.', ';', ':', '?', '!']) {
            if !sentence.ends_with('?') {
                opening.push(words.len());
            }
            let parts = sentence.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
            words.extend(parts.map(str::to_lowercase));
        }
        Self { words, opening }
    }

    /// How often a phrase occurs.
    fn count(&self, phrase: &str) -> usize {
        let phrase: Vec<&str> = phrase.split(' ').collect();
        self.words.windows(phrase.len()).filter(|words| words.iter().eq(&phrase)).count()
    }

    /// Does a sentence begin with this word, and does it go on?
    fn opens_with(&self, word: &str) -> bool {
        let is_it = |at: &usize| self.words.get(*at).is_some_and(|own| own == word);
        self.opening.iter().any(|at| is_it(at) && self.words.len() > at + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::problems;
    use crate::tidy::tokens::RustFile;
    use crate::workspace::TextFile;

    #[expect(
        clippy::case_sensitive_file_extension_comparisons,
        reason = "files of the repository have small letters"
    )]
    fn found(path: &str, text: &str) -> Vec<usize> {
        let files = [TextFile { path: path.to_owned(), text: text.to_owned() }];
        let rust: Vec<RustFile<'_>> = if path.ends_with(".rs") {
            files.iter().map(|file| RustFile::new(file).unwrap()).collect()
        } else {
            Vec::new()
        };
        problems(&files, &rust).unwrap().into_iter().map(|problem| problem.line).collect()
    }

    #[test]
    fn unwanted_words_of_pages_are_found_outside_code() {
        let page = "It is mended.\n`mend` is a name.\n```\nmend\n```\nG40 is no code.\nThere is no code.\n";
        assert_eq!(found("docs/a.md", page), [1, 6]);
    }

    #[test]
    fn a_word_may_be_right_in_a_phrase() {
        let page = "The tool is behind the axis.\nIt goes on behind the block.\nX stands for a word.\nX stands here.\n";
        assert_eq!(found("docs/a.md", page), [2, 4]);
        // Once right and once not.
        assert_eq!(found("docs/a.md", "There is no code that is no code.\n"), [1]);
    }

    #[test]
    fn a_sentence_does_not_begin_with_who_unless_it_asks() {
        assert_eq!(
            found("docs/a.md", "Who writes a feed means a cut.\nWho reads it?\nA person who reads.\n"),
            [1]
        );
    }

    #[test]
    fn comments_and_texts_of_rust_files_are_looked_at() {
        let text = "//! Begins anew.\n/// ```\n/// anew\n/// ```\nfn anew() { let a = \"begin anew\"; } // fine\n#[test]\nfn b() { let a = \"begin anew\"; }\n";
        assert_eq!(found("crates/a/src/lib.rs", text), [1, 5]);
    }
}
