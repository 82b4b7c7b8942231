//! A folder with programs, and gcheck run in it with nothing of the outside: no environment, no configuration above it.
//!
//! Knows: processes and temporary folders. Must not know: what gcheck is expected to do.

use std::fmt;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// A program without findings on any mill.
pub(crate) const GOOD: &str = "%\nO0001 (GOOD)\nG21 G90 G17 G40 G80\nG0 X1. Y2.\nM30\n%\n";
/// A program with one finding, an error: no control has `G999`.
pub(crate) const BAD: &str = "%\nO0001 (BAD)\nG999\nM30\n%\n";
/// A program with one finding on a Haas mill, a warning: `X1` is a ten-thousandth.
pub(crate) const WARNED: &str = "%\nO0001 G90 (WARNED)\nG0 X1\nM30\n%\n";
/// A program with one finding, an info: it has no number.
pub(crate) const INFORMED: &str = "%\nG0 X1.\nM30\n%\n";

/// A temporary folder.
pub(crate) struct Shop {
    folder: TempDir,
}

impl Shop {
    /// An empty folder.
    pub(crate) fn new() -> Self {
        Self { folder: TempDir::new().unwrap() }
    }

    /// A folder with these files.
    pub(crate) fn with(files: &[(&str, &str)]) -> Self {
        let shop = Self::new();
        for (name, text) in files {
            shop.file(name, text);
        }
        shop
    }

    /// Writes a file, and the folders that it needs.
    pub(crate) fn file(&self, name: &str, content: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    /// Names in the folder, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// The command with nothing of the outside, for tests that need more than [`Shop::gcheck`].
    pub(crate) fn command(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_gcheck"));
        command.current_dir(self.folder.path()).env_clear();
        if let Some(path) = std::env::var_os("PATH") {
            command.env("PATH", path);
        }
        command
    }

    /// Runs gcheck with arguments that hold no blanks.
    pub(crate) fn gcheck(&self, arguments: &str) -> Run {
        self.gcheck_reading(arguments, b"")
    }

    /// Runs gcheck with arguments that may hold blanks.
    pub(crate) fn gcheck_words(&self, arguments: &[&str]) -> Run {
        let mut command = self.command();
        command.args(arguments);
        self.finish(&mut command, b"")
    }

    /// The same with something on standard input.
    pub(crate) fn gcheck_reading(&self, arguments: &str, input: &[u8]) -> Run {
        let mut command = self.command();
        command.args(arguments.split_whitespace());
        self.finish(&mut command, input)
    }

    /// The same with variables of the environment.
    pub(crate) fn gcheck_with(&self, variables: &[(&str, &str)], arguments: &str) -> Run {
        let mut command = self.command();
        command.args(arguments.split_whitespace()).envs(variables.iter().copied());
        self.finish(&mut command, b"")
    }

    /// Runs a command to its end.
    pub(crate) fn finish(&self, command: &mut Command, input: &[u8]) -> Run {
        let mut child =
            command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // A program that reads nothing closes its end early.
        let _ = child.stdin.take().unwrap().write_all(input);
        let output = child.wait_with_output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap().replace(&self.here(), "[SHOP]");
        Run {
            code: output.status.code().expect("ended by a signal"),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }

    fn here(&self) -> String {
        self.folder.path().to_string_lossy().into_owned()
    }
}

/// What a run said, and how it ended.
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Run {
    /// Standard output as JSON.
    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error} in {self}"))
    }

    /// Findings of the concise format without their messages, which may be reworded.
    pub(crate) fn findings(&self) -> Vec<String> {
        let cut = |line: &str| line.split_inclusive(']').next().unwrap_or_default().to_owned();
        self.stdout.lines().map(cut).collect()
    }

    /// Rules found, in the concise format.
    pub(crate) fn rules(&self) -> Vec<String> {
        let rule = |line: &String| line.split(['[', ']']).nth(1).unwrap_or_default().to_owned();
        self.findings().iter().map(rule).collect()
    }
}

/// Everything that a user sees, for snapshots.
impl fmt::Display for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.stdout)?;
        for line in self.stderr.lines() {
            writeln!(f, "! {line}")?;
        }
        writeln!(f, "exit {}", self.code)
    }
}

/// Is this the superuser, whom no permission stops?
pub(crate) fn is_superuser(folder: &Path) -> bool {
    let probe = folder.join("probe");
    fs::write(&probe, "x").unwrap();
    let mut permissions = probe.metadata().unwrap().permissions();
    std::os::unix::fs::PermissionsExt::set_mode(&mut permissions, 0);
    fs::set_permissions(&probe, permissions).unwrap();
    let reads = fs::read(&probe).is_ok();
    fs::remove_file(&probe).unwrap();
    reads
}

impl Shop {
    /// Whether a test about permissions means anything here; says so when it does not.
    pub(crate) fn permissions_count(&self, test: &str) -> bool {
        let counts = !is_superuser(self.folder.path());
        if !counts {
            gcheck_testkit::skips::skip(test, "permissions", "run it as another user");
        }
        counts
    }

    /// Sets the permissions of a file or folder.
    pub(crate) fn chmod(&self, name: &str, mode: u32) {
        let permissions = std::os::unix::fs::PermissionsExt::from_mode(mode);
        fs::set_permissions(self.path(name), permissions).unwrap();
    }
}
