//! Pages with commands, read as a person does: what they tell to save and to change is done, and each command says what its
//! page shows.
//!
//! Knows: how a page writes files, changes of files, commands and what they print. Must not know: what is found.

use std::fs;
use std::path::{Path, PathBuf};

use crate::shop::Shop;

/// Lines that a page leaves out, or a part of a line.
const LEFT_OUT: &str = "…";

/// What a reader does next.
#[derive(Debug)]
enum Step {
    /// Save a text as a file.
    Save(String, String),
    /// Change lines of a file.
    Change(String, String),
    /// Write lines into the sections of a file.
    Insert(String, String),
    /// Run gcheck, which prints these lines.
    Run(String, Vec<String>),
    /// Read a finding of a file.
    Read(String, Vec<String>),
}

/// What a page tells its reader to do, in order.
fn steps(page: &str) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut told: Tell = Step::Save;
    let mut file: Option<String> = None;
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        let Some(language) = line.strip_prefix("```") else {
            if let Some((tell, name)) = instruction(line) {
                (told, file) = (tell, Some(name));
            }
            continue;
        };
        let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
        if language == "console" {
            steps.extend(commands(&block));
        } else if let Some(file) = file.take() {
            steps.push(told(file, block.join("\n") + "\n"));
        } else if let Some(file) = finding_of(&block) {
            steps.push(Step::Read(file, block.into_iter().map(str::to_owned).collect()));
        }
    }
    steps
}

/// What a reader does with a file and a text.
type Tell = fn(String, String) -> Step;

/// A line of prose that says what to do with the next block: `save this as`, `In … :`, `into the sections of`.
fn instruction(line: &str) -> Option<(Tell, String)> {
    let name = |rest: &str| rest.split('`').next().map(str::to_owned);
    if let Some(rest) = line.strip_prefix("In `") {
        return (rest.ends_with("`:")).then(|| name(rest)).flatten().map(|name| (Step::Change as _, name));
    }
    if let Some((_, rest)) = line.split_once("into the sections of `") {
        return name(rest).map(|name| (Step::Insert as _, name));
    }
    let (_, rest) = line.to_lowercase().find("save ").and_then(|at| line[at..].split_once(" as `"))?;
    name(rest).map(|name| (Step::Save as _, name))
}

/// The file of a finding, if a block is one.
fn finding_of(block: &[&str]) -> Option<String> {
    let is_finding = ["error[", "warning[", "info[", "hint["].iter().any(|level| block[0].starts_with(level));
    let place = block.iter().find_map(|line| line.split_once("┌─ "))?.1;
    is_finding.then(|| place.split(':').next().unwrap().to_owned())
}

/// Every command of a block with the lines below it.
fn commands(block: &[&str]) -> Vec<Step> {
    let mut commands: Vec<Step> = Vec::new();
    for line in block {
        match (line.strip_prefix("$ gcheck "), commands.last_mut()) {
            (Some(command), _) => commands.push(Step::Run(command.to_owned(), Vec::new())),
            (None, Some(Step::Run(_, said))) => said.push((*line).to_owned()),
            _ => panic!("a line without a command: {line}"),
        }
    }
    commands
}

/// The lines as a page shows them, in order, with nothing between them but where it leaves something out.
fn shows(page: &[String], said: &[&str]) -> bool {
    match page.split_first() {
        None => said.is_empty(),
        Some((first, rest)) if first == LEFT_OUT => (0..=said.len()).any(|at| shows(rest, &said[at..])),
        Some((first, rest)) => {
            said.split_first().is_some_and(|(line, more)| is_line(first, line) && shows(rest, more))
        }
    }
}

/// Is it the line that a page shows, parts of which it may leave out?
fn is_line(page: &str, said: &str) -> bool {
    // A line of gcheck that has the sign itself is the line.
    let Some((start, end)) = page.split_once(LEFT_OUT).filter(|_| page != said) else { return page == said };
    said.len() >= start.len() + end.len() && said.starts_with(start) && said.ends_with(end)
}

#[track_caller]
fn assert_shows(command: &str, page: &[String], said: &str) {
    let lines: Vec<&str> = said.lines().collect();
    assert!(shows(page, &lines), "gcheck {command}\n{}\nand the page:\n{}", said, page.join("\n"));
}

/// Changes lines of a text; the change may leave out what is between its lines.
#[track_caller]
fn changed(text: &str, change: &str) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let mut from = 0;
    for part in change.split("…\n") {
        let of = |sign| move |line: &&str| !line.starts_with(sign);
        let before: Vec<&str> = part.lines().filter(of('+')).map(|line| &line[1..]).collect();
        let after: Vec<&str> = part.lines().filter(of('-')).map(|line| &line[1..]).collect();
        let at = (from..lines.len()).find(|at| lines[*at..].starts_with(&before));
        let at = at.unwrap_or_else(|| panic!("not in the file:\n{part}\n{text}"));
        from = at + after.len();
        lines.splice(at..at + before.len(), after);
    }
    lines.join("\n") + "\n"
}

/// Writes the lines of each section below its heading.
#[track_caller]
fn inserted(text: &str, sections: &str) -> String {
    sections.split("\n\n").fold(text.to_owned(), |text, section| {
        let (heading, lines) = section.split_once('\n').unwrap();
        let heading = format!("\n{heading}\n");
        assert!(text.contains(&heading), "no {heading} in {text}");
        text.replacen(&heading, &format!("{heading}{}\n", lines.trim_end()), 1)
    })
}

/// Follows the steps of a page in a folder; how many commands it ran.
fn follow(page: &str, shop: &Shop) -> usize {
    let mut count = 0;
    let mut digest = String::new();
    for step in steps(page) {
        match step {
            Step::Save(file, text) => {
                shop.file(&file, text.replace("digest = \"…\"", &format!("digest = \"{digest}\"")));
            }
            Step::Change(file, change) => shop.file(&file, changed(&shop.read(&file), &change)),
            Step::Insert(file, lines) => shop.file(&file, inserted(&shop.read(&file), &lines)),
            Step::Read(file, mut finding) => {
                finding.insert(0, LEFT_OUT.to_owned());
                finding.push(LEFT_OUT.to_owned());
                let command = format!("check {file}");
                assert_shows(&command, &finding, &shop.gcheck(&command).stdout);
            }
            Step::Run(command, expected) => {
                let (arguments, filter) = match command.split_once(" | grep ") {
                    Some((arguments, filter)) => (arguments, filter.trim_matches('\'')),
                    None => (command.as_str(), ""),
                };
                let run = shop.gcheck(arguments);
                // As on a terminal: which control reads the programs comes before the findings.
                let lines = run.stdout.lines().filter(|line| line.contains(filter));
                let said: String = run.stderr.lines().chain(lines).map(|line| format!("{line}\n")).collect();
                assert_shows(&command, &expected, &said);
                if let Some((_, rest)) = said.rsplit_once("[digest ") {
                    rest.split(']').next().unwrap().clone_into(&mut digest);
                }
                count += 1;
            }
        }
    }
    count
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn page(name: &str) -> String {
    fs::read_to_string(root().join("docs").join(name)).unwrap()
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

/// The folders of the author of a post-processor, as the page describes them.
fn posted() -> Shop {
    let clean = with_files("fixtures/clean/haas-mill");
    let shop = Shop::with(&[("gcheck.toml", &clean.read("gcheck.toml"))]);
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
fn the_first_minutes_go_as_their_page_shows_them() {
    let page = page("dev/first-minutes.md");
    let mut count = 0;
    for section in page.split("\n## ").skip(1) {
        let post = section.starts_with("The author of a post-processor").then(posted);
        count += follow(section, post.as_ref().unwrap_or(&with_files("fixtures/tour")));
        if let Some(shop) = post {
            // The page that a person looks at has both paths.
            let report = shop.read("diff.html");
            assert!(report.contains("<svg") && report.contains("bracket.nc"), "{} bytes", report.len());
        }
    }
    assert!(count >= 20, "{count}");
}

#[test]
fn the_tutorial_for_machinists_goes_as_it_shows() {
    let count = follow(&page("tutorial-machinist.md"), &Shop::new());
    assert!(count >= 16, "{count}");
}

#[test]
fn the_tutorial_for_a_team_goes_as_it_shows() {
    let count = follow(&page("tutorial-ci.md"), &Shop::new());
    assert!(count >= 11, "{count}");
}

#[test]
fn the_tutorial_for_authors_of_posts_goes_as_it_shows() {
    let count = follow(&page("tutorial-post.md"), &Shop::new());
    assert!(count >= 14, "{count}");
}

#[test]
fn a_page_may_leave_out_lines_and_parts_of_them() {
    let page = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    assert!(shows(&page("a\n…\nd"), &["a", "b", "c", "d"]));
    assert!(shows(&page("a [digest …]"), &["a [digest 1234]"]));
    assert!(!shows(&page("a\nd"), &["a", "b", "d"]));
    assert!(!shows(&page("a [digest …]"), &["a [digest 1234"]));
}

#[test]
fn a_change_is_made_where_its_lines_are() {
    assert_eq!(changed("G1\nX1\nG1\nX1\n", " G1\n-X1\n+X2\n…\n X1\n+M30\n"), "G1\nX2\nG1\nX1\nM30\n");
}
