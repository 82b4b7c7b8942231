//! The Haas mill manual as text: how programs are cut out of it.
//!
//! Knows: what the conversion from pages to text left between the lines of a program, and in them. Must not know: any program.

use std::fmt::Write as _;
use std::path::PathBuf;

use gcheck_testkit::skips::skip;

use super::example::{Expected, Tally};
use crate::proof::on;

/// The text in the folder that `GCHECK_MANUALS` names.
const FILE: &str = "haas-mill-ngc-operator-2017.md";
/// Of the whole file. Every place below was found in a file with this hash.
const HASH: u64 = 0xfff4_7e95_c5fa_fd45;
/// Pages of the file before page 1 of the manual.
const PAGES_IN_FRONT: i32 = 18;

/// Where a stretch of a program is.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// The page on which it begins.
    pub(super) page: i32,
    /// Hash of its first line.
    pub(super) first: u64,
    /// How many lines it has, without what is not of the program.
    pub(super) lines: usize,
    /// Hash of all its lines.
    pub(super) all: u64,
}

/// A program of the manual.
pub(super) struct Example {
    /// Pages of the manual.
    pub(super) at: &'static str,
    /// In our words.
    pub(super) what: &'static str,
    pub(super) text: &'static [Part],
    /// Programs in files beside it.
    pub(super) files: &'static [(&'static str, &'static [Part])],
    /// Keys of a configuration, as the comments of the program have it.
    pub(super) config: &'static [&'static str],
    pub(super) expected: Expected,
}

/// A stretch of a program.
pub(super) enum Part {
    /// Ours: what makes a snippet a program, or shows what it computed.
    Ours(&'static str),
    /// The manual's.
    Theirs(Place),
}

/// Checks and runs every example; without the manual it says so and skips.
pub(super) fn every_example(examples: &[Example], title: &str) {
    let manual = match Manual::read() {
        Ok(manual) => manual,
        Err(why) => return skip(title, "manuals", &why),
    };
    let mut tally = Tally::default();
    for example in examples {
        let files = example.files.iter().map(|(name, parts)| (*name, leaked(joined(&manual, parts))));
        let files: &'static [_] = Box::leak(files.collect::<Vec<_>>().into_boxed_slice());
        let text = leaked(joined(&manual, example.text));
        let program = on("haas-mill", text).with(example.config).beside(files);
        tally.add(&format!("{}, {}", example.at, example.what), &program, &example.expected);
    }
    tally.close(title);
}

fn joined(manual: &Manual, parts: &[Part]) -> String {
    parts.iter().fold(String::new(), |mut text, part| {
        let _ = match part {
            Part::Ours(ours) => write!(text, "{ours}"),
            Part::Theirs(place) => write!(text, "{}", manual.cut(place)),
        };
        text
    })
}

/// A program lasts as long as the tests.
fn leaked(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}

/// The manual, page by page.
struct Manual {
    lines: Vec<(i32, String)>,
}

impl Manual {
    /// The manual, or why there is none: its tests are skipped then.
    fn read() -> Result<Self, String> {
        let folder = std::env::var_os("GCHECK_MANUALS").ok_or("GCHECK_MANUALS names no folder")?;
        let path = PathBuf::from(folder).join(FILE);
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        if hash(&text) != HASH {
            return Err(format!("{} is not the text whose programs are known", path.display()));
        }
        let mut page = -PAGES_IN_FRONT;
        let mut lines = Vec::new();
        for line in text.lines() {
            if line.trim() == "---" {
                page += 1;
            }
            let line = cleaned(line);
            if is_of_a_program(&line) {
                lines.push((page, line));
            }
        }
        Ok(Self { lines })
    }

    /// The lines at a place, each with its line end.
    fn cut(&self, place: &Place) -> String {
        let found =
            self.lines.iter().position(|(page, line)| *page == place.page && hash(line) == place.first);
        let found =
            found.unwrap_or_else(|| panic!("page {}: no line has the hash {:#x}", place.page, place.first));
        let lines = self.lines.iter().skip(found).take(place.lines);
        let text: String = lines.map(|(_, line)| format!("{line}\n")).collect();
        assert_eq!(hash(&text), place.all, "page {}: other lines than those that were read", place.page);
        as_blocks(&text)
    }
}

/// One block a line: the conversion joined some, with the end of block between them, and a page is too narrow for some
/// comments.
fn as_blocks(lines: &str) -> String {
    let mut text = String::new();
    for line in lines.lines().flat_map(|line| line.split("; ")) {
        let line = line.trim_end_matches(';').trim_end();
        if line == "..." {
            continue;
        }
        let line = match line.strip_prefix("% ") {
            Some(rest) => format!("%\n{rest}"),
            None => line.to_owned(),
        };
        // A comment that its line does not close goes on in the next one.
        let open = line.rfind('(').is_some_and(|at| !line[at..].contains(')'));
        let _ = write!(text, "{line}{}", if open { ' ' } else { '\n' });
    }
    text
}

/// A line without the blanks of the page's layout, the end of block, and dots that stand for blocks left out.
fn cleaned(line: &str) -> String {
    let text = line.split_whitespace().collect::<Vec<_>>().join(" ");
    let text = text.strip_suffix(';').unwrap_or(&text).trim_end();
    match text.strip_prefix("...") {
        Some(rest) if !rest.is_empty() => rest.to_owned(),
        _ => text.to_owned(),
    }
}

/// Not a break or heading of a page (comments that was alone became headings as well), nor its number.
fn is_of_a_program(line: &str) -> bool {
    let number = !line.is_empty() && line.bytes().all(|at| at.is_ascii_digit());
    !(line.is_empty() || line == "---" || line.starts_with("# ") || number)
}

/// FNV-1a, 64 bits.
pub(super) fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, at| (hash ^ u64::from(at)).wrapping_mul(0x0100_0000_01b3))
}
