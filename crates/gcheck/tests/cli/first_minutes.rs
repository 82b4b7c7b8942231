//! The page about the first minutes: its commands say what the page shows.
//!
//! Knows: how the page writes commands and what they print. Must not know: what is found.

use std::fs;
use std::path::{Path, PathBuf};

use crate::shop::Shop;

/// A line of the page that stands for any number of lines.
const LEFT_OUT: &str = "…";

/// Every command of a part of the page with the lines below it.
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

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A shop with the files of a folder.
fn with_files(folder: &str) -> Shop {
    let shop = Shop::new();
    for entry in fs::read_dir(root().join(folder)).unwrap() {
        let entry = entry.unwrap();
        shop.file(&entry.file_name().to_string_lossy(), fs::read(entry.path()).unwrap());
    }
    shop
}

/// The folders of the author of a post-processor, as the page describes them, and the list that it shows.
fn posted(section: &str) -> Shop {
    let clean = with_files("fixtures/clean/haas-mill");
    let shop = Shop::with(&[("gcheck.toml", &clean.read("gcheck.toml"))]);
    let accepted = section.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    shop.file("accepted.toml", accepted);
    for name in ["blade.nc", "bracket.nc", "sleeve.nc"] {
        let old = clean.read(name);
        let mut new = old.clone();
        for digit in '0'..='3' {
            new = new.replace(&format!("G0{digit}"), &format!("G{digit}"));
        }
        if name == "bracket.nc" {
            new = new.replace("F45.", "F54.");
        }
        shop.file(&format!("old/{name}"), old);
        shop.file(&format!("next/{name}"), new.replace("Z-0.5 F20.", "Z-0.55 F20."));
        shop.file(&format!("new/{name}"), new);
    }
    shop
}

#[test]
fn the_page_shows_what_the_commands_print() {
    let page = fs::read_to_string(root().join("docs/dev/first-minutes.md")).unwrap();
    let tour = with_files("fixtures/tour");
    let mut count = 0;
    for section in page.split("\n## ").skip(1) {
        let post = section.starts_with("The author of a post-processor").then(|| posted(section));
        let shop = post.as_ref().unwrap_or(&tour);
        for (command, expected) in commands(section) {
            let run = shop.gcheck(&command);
            // As on a terminal: which control reads the programs comes before the findings.
            let said = format!("{}{}", run.stderr, run.stdout);
            assert!(shows(&expected, &said.lines().collect::<Vec<_>>()), "gcheck {command}\n{said}");
            count += 1;
        }
        if let Some(shop) = post {
            // The page that a person looks at has both paths.
            let report = shop.read("diff.html");
            assert!(report.contains("<svg") && report.contains("bracket.nc"), "{} bytes", report.len());
        }
    }
    assert!(count >= 11, "{count}");
}
