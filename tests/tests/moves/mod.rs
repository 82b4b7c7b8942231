//! The moves of a program, for laws that say that an edit leaves them as they are.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

/// The moves of a program, and whether it came to its end.
pub(crate) fn moves(program: &[u8], control: &str, folder: &Path) -> (Vec<String>, bool) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gcheck-under-test"));
    command.current_dir(folder).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.args(["run", "--isolated", "--control", control, "--output-format", "canonical"]);
    command.args(["--fuel", "200000", "-"]);
    let mut child = command.spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let bytes = program.to_vec();
    let writer = std::thread::spawn(move || {
        // A run that fails early reads no more.
        let _ = stdin.write_all(&bytes);
    });
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    // The number before a call counts blocks, the one with N is the block's own, and a long one touches the call.
    let calls = text.lines().map(|line| {
        let call = line.trim_start_matches(|c: char| c.is_ascii_digit() || c == ' ').trim_start_matches('N');
        call.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.').trim().to_owned()
    });
    let said = |call: &String| !call.starts_with("COMMENT") && !call.starts_with("MESSAGE");
    (calls.filter(said).collect(), output.status.code() == Some(0))
}

/// Our own programs under `fixtures`, with the folder of each.
pub(crate) fn own_programs() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut files: Vec<PathBuf> = Vec::new();
    let mut folders = vec![root.join("fixtures")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "ngc" || extension == "nc") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
