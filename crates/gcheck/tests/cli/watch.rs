//! `--watch`: each change gives a fresh report, and Ctrl-C ends it.

#![cfg(unix)]

use std::fs;
use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::Duration;

use crate::shop::{BAD, GOOD, Shop, WARNED};

/// Longer than any machine should need.
const PATIENCE: Duration = Duration::from_secs(30);

/// A process that watches, and the lines that it says.
struct Watching {
    child: Child,
    lines: Receiver<String>,
}

impl Watching {
    fn start(shop: &Shop, arguments: &str) -> Self {
        let mut command = shop.command();
        command.args(["check", "--control", "haas-mill", "--output-format", "concise", "--watch"]);
        command.args(arguments.split_whitespace());
        // One pipe for both, so that lines come in the order in which they were said.
        let (reader, writer) = std::io::pipe().unwrap();
        command.stdin(Stdio::null()).stdout(writer.try_clone().unwrap()).stderr(writer);
        let child = command.spawn().unwrap();
        // It holds the ends for writing.
        drop(command);
        let (sender, lines) = mpsc::channel();
        thread::spawn(move || {
            for line in BufReader::new(reader).lines() {
                let _ = sender.send(line.unwrap());
            }
        });
        Self { child, lines }
    }

    /// The lines up to one that holds `end`.
    fn until(&self, end: &str) -> Vec<String> {
        let mut said = Vec::new();
        loop {
            let Ok(line) = self.lines.recv_timeout(PATIENCE) else {
                panic!("`{end}` was not said; but {said:#?}");
            };
            let is_end = line.contains(end);
            said.push(line);
            if is_end {
                return said;
            }
        }
    }

    /// Waits for the end of a round.
    fn round(&self) {
        self.until("watching ");
    }

    fn interrupt(mut self) -> Option<i32> {
        let id = self.child.id().to_string();
        assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
        self.child.wait().unwrap().code()
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        // After a test that failed; else it has ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn a_change_gives_a_fresh_report_and_ctrl_c_ends_with_130() {
    let shop = Shop::with(&[("a.nc", GOOD), ("jobs/b.nc", GOOD)]);
    let watching = Watching::start(&shop, ".");
    watching.until("no findings in 2 files");
    watching.round();
    shop.file("jobs/b.nc", BAD);
    watching.until("b.nc changed");
    watching.until("1 error in 2 files");
    watching.round();
    assert_eq!(watching.interrupt(), Some(130));
}

#[test]
fn programs_and_folders_come_and_go() {
    let shop = Shop::with(&[("a.nc", GOOD)]);
    let watching = Watching::start(&shop, ".");
    watching.until("no findings in 1 file");
    watching.round();
    shop.file("new/deeper/b.nc", BAD);
    watching.until("1 error in 2 files");
    watching.round();
    fs::rename(shop.path("new"), shop.path("renamed")).unwrap();
    watching.until("renamed/deeper/b.nc:3:1: error");
    watching.round();
    fs::remove_dir_all(shop.path("renamed")).unwrap();
    watching.until("no findings in 1 file");
    watching.round();
    fs::remove_file(shop.path("a.nc")).unwrap();
    watching.until("no programs found");
    assert_eq!(watching.interrupt(), Some(130));
}

#[test]
fn a_named_file_may_vanish_and_come_back_by_another_name() {
    let shop = Shop::with(&[("a.nc", GOOD)]);
    let watching = Watching::start(&shop, "a.nc");
    watching.round();
    fs::remove_file(shop.path("a.nc")).unwrap();
    watching.until("a.nc: no such file or folder");
    watching.round();
    // As editors save.
    shop.file(".a.nc.swp", BAD);
    fs::rename(shop.path(".a.nc.swp"), shop.path("a.nc")).unwrap();
    watching.until("1 error in 1 file");
    watching.round();
    assert_eq!(watching.interrupt(), Some(130));
}

#[test]
fn the_folder_itself_may_vanish_and_come_back() {
    let shop = Shop::with(&[("jobs/a.nc", GOOD)]);
    let watching = Watching::start(&shop, "jobs");
    watching.until("no findings in 1 file");
    watching.round();
    fs::remove_dir_all(shop.path("jobs")).unwrap();
    watching.until("no such file or folder");
    watching.round();
    shop.file("jobs/b.nc", BAD);
    watching.until("1 error in 1 file");
    watching.round();
    shop.file("jobs/b.nc", GOOD);
    watching.until("no findings in 1 file");
    assert_eq!(watching.interrupt(), Some(130));
}

#[test]
fn configurations_tables_and_called_programs_count() {
    let shop = Shop::with(&[("jobs/a.nc", "%\nO0001 G21 G90 G17\nM98 P100\nT1 M6\nG0 X1\nM30\n%\n")]);
    let watching = Watching::start(&shop, "jobs --select missing-decimal-point,subprogram-missing");
    watching.until("2 warnings in 1 file");
    watching.round();
    fs::create_dir(shop.path("macros")).unwrap();
    shop.file("gcheck.toml", "[rules]\nmissing-decimal-point = \"error\"\n[search]\npaths = [\"macros\"]\n");
    watching.until("1 error, 1 warning in 1 file");
    watching.round();
    shop.file("gcheck.toml", "[rules]\n[search]\npaths = [\"macros\"]\n");
    watching.until("2 warnings in 1 file");
    watching.round();
    shop.file("macros/O0100.nc", "%\nO0100\nM99\n%\n");
    watching.until("1 warning in 1 file");
    watching.round();
    assert_eq!(watching.interrupt(), Some(130));
}

#[test]
fn a_broken_configuration_is_said_and_waited_for() {
    let shop = Shop::with(&[("a.nc", WARNED)]);
    let watching = Watching::start(&shop, ".");
    watching.until("1 warning in 1 file");
    watching.round();
    shop.file("gcheck.toml", "control = 'nobody'\n");
    watching.until("no control is called `nobody`");
    watching.round();
    shop.file("gcheck.toml", "");
    watching.until("1 warning in 1 file");
    assert_eq!(watching.interrupt(), Some(130));
}

#[test]
fn its_own_output_and_its_own_reading_are_no_change() {
    let shop = Shop::with(&[("a.nc", BAD)]);
    let watching = Watching::start(&shop, ". -o concise=out.txt");
    watching.round();
    let more = watching.lines.recv_timeout(Duration::from_secs(2));
    assert!(more.is_err(), "a round of its own making: {more:?}");
    shop.file("notes.txt", "nothing to do with it");
    let more = watching.lines.recv_timeout(Duration::from_secs(2));
    assert!(more.is_err(), "a file that is no program: {more:?}");
    assert_eq!(watching.interrupt(), Some(130));
}

#[test]
fn what_cannot_be_watched_is_refused() {
    let shop = Shop::new();
    for arguments in
        ["check --watch -", "check --watch --fix", "check --watch --baseline b.json --update-baseline"]
    {
        assert_eq!(shop.gcheck(arguments).code, 2, "{arguments}");
    }
}
