//! The page about the first minutes: its commands say what the page shows.
//!
//! Knows: how the page writes commands and what they print. Must not know: what is found.

use std::fs;
use std::path::Path;

use crate::shop::Shop;

/// A line of the page that stands for any number of lines.
const LEFT_OUT: &str = "…";

/// Every command of the page with the lines below it.
fn commands(page: &str) -> Vec<(String, Vec<String>)> {
    let mut commands: Vec<(String, Vec<String>)> = Vec::new();
    for block in page.split("```console\n").skip(1) {
        for line in block.split("\n```").next().unwrap_or_default().lines() {
            match (line.strip_prefix("$ gcheck "), commands.last_mut()) {
                (Some(command), _) => commands.push((command.to_owned(), Vec::new())),
                (None, Some((_, said))) => said.push(line.to_owned()),
                (None, None) => panic!("a line without a command: {line}"),
            }
        }
    }
    commands
}

/// The lines as the page shows them, in order, with nothing between them but where it leaves something out.
fn shows(page: &[String], said: &[&str]) -> bool {
    match page.split_first() {
        None => said.is_empty(),
        Some((first, rest)) if first == LEFT_OUT => (0..=said.len()).any(|at| shows(rest, &said[at..])),
        Some((first, rest)) => {
            said.split_first().is_some_and(|(line, more)| line == first && shows(rest, more))
        }
    }
}

#[test]
fn the_page_shows_what_the_commands_print() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let page = fs::read_to_string(root.join("docs/dev/first-minutes.md")).unwrap();
    let shop = Shop::new();
    for entry in fs::read_dir(root.join("fixtures/tour")).unwrap() {
        let entry = entry.unwrap();
        shop.file(&entry.file_name().to_string_lossy(), fs::read(entry.path()).unwrap());
    }
    let commands = commands(&page);
    assert!(commands.len() >= 7, "{commands:?}");
    for (command, expected) in commands {
        let run = shop.gcheck(&command);
        // As on a terminal: which control reads the programs comes before the findings.
        let said = format!("{}{}", run.stderr, run.stdout);
        assert!(shows(&expected, &said.lines().collect::<Vec<_>>()), "gcheck {command}\n{said}");
    }
}
