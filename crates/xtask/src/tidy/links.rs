//! Every link of a page leads somewhere, and every page of the book is in its table of contents.
//!
//! Knows: Markdown, how headings become anchors. Must not know: what the pages are about. Links to other sites are not
//! followed: a test that needs the network fails for reasons of its own.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

use super::problem::Problem;
use crate::workspace::TextFile;

/// The book's table of contents, and the folder of its pages.
const CONTENTS: &str = "docs/SUMMARY.md";
const BOOK: &str = "docs/";

/// Folders of the repository: a page that names a path in one of them names a path that exists.
const FOLDERS: &[&str] = &["crates/", "docs/", "editors/", "fixtures/", "tests/", ".github/"];

/// Where Markdown is input, not documentation.
const NOT_PAGES: &[&str] = &["fixtures/", ".test-tools/"];

/// A page: where it leads, and what can be led to.
struct Page<'f> {
    file: &'f TextFile,
    /// With the lines they are on.
    links: Vec<(usize, String)>,
    /// Paths in the repository that the text names as code, with their lines.
    paths: Vec<(usize, String)>,
    anchors: BTreeSet<String>,
}

/// Dead links, and pages that the book does not list. `exists` tells of files that are not text: pictures, folders.
pub(super) fn problems(files: &[TextFile], exists: impl Fn(&str) -> bool) -> Vec<Problem> {
    let pages: BTreeMap<&str, Page<'_>> = files
        .iter()
        .filter(|file| is_markdown(&file.path) && !NOT_PAGES.iter().any(|not| file.path.starts_with(not)))
        .map(|file| (file.path.as_str(), Page::new(file)))
        .collect();
    let mut problems = Vec::new();
    let mut listed = BTreeSet::new();
    for (path, page) in &pages {
        for (line, named) in page.paths.iter().filter(|(_, named)| !exists(named)) {
            problems.push(Problem::new(*path, *line, format!("`{named}` is not there")));
        }
        for (line, link) in &page.links {
            let (target, anchor) = link.split_once('#').map_or((link.as_str(), None), |(t, a)| (t, Some(a)));
            let target = if target.is_empty() { (*path).to_owned() } else { resolved(path, target) };
            let mut say = |message: String| problems.push(Problem::new(*path, *line, message));
            match pages.get(target.as_str()) {
                Some(to) => {
                    if *path == CONTENTS && !listed.insert(target.clone()) {
                        say(format!("`{target}` is in the contents twice"));
                    }
                    if let Some(anchor) = anchor.filter(|anchor| !to.anchors.contains(*anchor)) {
                        say(format!("`{target}` has no heading `#{anchor}`"));
                    }
                }
                None if exists(&target) => {}
                None => say(format!("the link leads to `{target}`, which is not there")),
            }
        }
    }
    for path in pages.keys().filter(|path| path.starts_with(BOOK) && **path != CONTENTS) {
        // A tree without a book has no contents to be in.
        if pages.contains_key(CONTENTS) && !listed.contains(*path) {
            problems.push(Problem::new(
                *path,
                0,
                format!("the page is in no line of {CONTENTS}: add one, or run `cargo xtask gen` if it is generated"),
            ));
        }
    }
    problems
}

fn is_markdown(path: &str) -> bool {
    Path::new(path).extension().is_some_and(|extension| extension == "md")
}

impl<'f> Page<'f> {
    fn new(file: &'f TextFile) -> Self {
        let (mut links, mut paths, mut anchors) = (Vec::new(), Vec::new(), BTreeSet::new());
        let mut heading: Option<String> = None;
        let options = Options::ENABLE_TABLES | Options::ENABLE_FOOTNOTES;
        let line_of = |start: usize| file.text.get(..start).unwrap_or_default().matches('\n').count() + 1;
        for (event, range) in Parser::new_ext(&file.text, options).into_offset_iter() {
            if let Event::Code(code) = &event
                && is_path(code)
            {
                paths.push((line_of(range.start), code.to_string()));
            }
            match event {
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    if is_own(&dest_url) {
                        links.push((line_of(range.start), dest_url.into_string()));
                    }
                }
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::End(TagEnd::Heading(_)) => {
                    let anchor = slug(&heading.take().unwrap_or_default());
                    // A second heading of the same words is counted.
                    let again = (1..).map(|n| format!("{anchor}-{n}"));
                    let free = std::iter::once(anchor.clone()).chain(again).find(|a| !anchors.contains(a));
                    anchors.extend(free);
                }
                Event::Text(text) | Event::Code(text) => {
                    if let Some(heading) = &mut heading {
                        heading.push_str(&text);
                    }
                }
                _ => {}
            }
        }
        Self { file, links, paths, anchors }
    }
}

impl std::fmt::Debug for Page<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.file.path)
    }
}

/// Does a link lead into the repository? An empty one is in the contents for a chapter without a page.
fn is_own(link: &str) -> bool {
    !link.is_empty() && !link.starts_with('/') && !link.contains("://") && !link.starts_with("mailto:")
}

/// Is it a path in one of the folders, without a place to fill in?
fn is_path(code: &str) -> bool {
    let is_whole = !code.contains([' ', '<', '*', '…', '{', ':']);
    is_whole && FOLDERS.iter().any(|folder| code.starts_with(folder))
}

/// The anchor of a heading, as code hosts and the book make it.
fn slug(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).flat_map(char::to_lowercase).collect()
}

/// A link from the root of the repository.
fn resolved(from: &str, link: &str) -> String {
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in link.split('/') {
        match part {
            "." | "" => {}
            ".." => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::problems;
    use crate::workspace::TextFile;

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let files: Vec<TextFile> = files
            .iter()
            .map(|(path, text)| TextFile { path: (*path).into(), text: (*text).into() })
            .collect();
        problems(&files, |path| path == "docs/picture.png").iter().map(ToString::to_string).collect()
    }

    #[test]
    fn links_lead_to_pages_headings_and_files() {
        let page = "# Words of `findings`, twice\n\n[a](b.md) [b](../README.md#gcheck) ![c](picture.png) [d](#words-of-findings-twice)\n\n\
                    `[x](none.md)` [web](https://example.com/none.md)\n\n```text\n[y](none.md)\n```\n";
        assert_eq!(found(&[("docs/a.md", page), ("docs/b.md", ""), ("README.md", "# gcheck\n")]), [""; 0]);
    }

    #[test]
    fn dead_links_are_found() {
        let page = "# A\n\n[a](none.md)\n[b](#b)\n[c](../a.md#b)\n";
        assert_eq!(
            found(&[("docs/a.md", page)]),
            [
                "docs/a.md:3: the link leads to `docs/none.md`, which is not there",
                "docs/a.md:4: `docs/a.md` has no heading `#b`",
                "docs/a.md:5: the link leads to `a.md`, which is not there",
            ]
        );
    }

    #[test]
    fn a_path_that_a_page_names_exists() {
        let page = "`docs/picture.png`, `docs/none.rs`, `crates/<name>/src`, `docs/*.md`.\n";
        assert_eq!(found(&[("docs/a.md", page)]), ["docs/a.md:1: `docs/none.rs` is not there"]);
    }

    #[test]
    fn a_page_is_in_the_contents_once() {
        let contents = "# Contents\n\n- [A](a.md)\n- [Group]()\n- [A again](a.md)\n";
        let said = found(&[
            ("docs/SUMMARY.md", contents),
            ("docs/a.md", ""),
            ("docs/b.md", ""),
            ("CHANGELOG.md", ""),
        ]);
        assert_eq!(said.len(), 2, "{said:?}");
        assert_eq!(said[0], "docs/SUMMARY.md:5: `docs/a.md` is in the contents twice");
        assert!(said[1].starts_with("docs/b.md: the page is in no line"), "{said:?}");
    }
}
