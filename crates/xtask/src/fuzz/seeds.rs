//! Seeds of the fuzz targets: inputs from which a fuzzer starts, and which a test replays.
//!
//! Knows: their form, a file for each target with a line of hexadecimal digits for each input. Must not know: fuzzers.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context as _;

use crate::workspace;

/// Digits of a target's seeds: a test replays them in a moment, and a reader can look at them.
const MOST_DIGITS: usize = 24 << 10;
/// Inputs of a target's seeds.
const MOST_SEEDS: usize = 60;

fn folder() -> PathBuf {
    workspace::root().join("crates/gcheck-fuzz/seeds")
}

fn file(target: &str) -> PathBuf {
    folder().join(target).with_extension("hex")
}

/// Names of the targets: each has a file of seeds.
pub(super) fn targets() -> anyhow::Result<Vec<String>> {
    let files = workspace::files_with_extension(&folder(), "hex")?;
    Ok(files.iter().filter_map(|file| Some(file.file_stem()?.to_string_lossy().into_owned())).collect())
}

/// Puts the seeds of a target into a folder, a file each, beside what is there.
pub(super) fn unpack(target: &str, into: &Path) -> anyhow::Result<()> {
    fs::create_dir_all(into)?;
    let text = fs::read_to_string(file(target)).with_context(|| file(target).display().to_string())?;
    for (number, line) in text.lines().enumerate() {
        fs::write(into.join(format!("seed-{number:04}")), bytes(line))?;
    }
    Ok(())
}

/// Makes seeds of some files of a folder, short ones and long ones, beside the seeds that there are.
pub(super) fn pack(target: &str, from: &Path) -> anyhow::Result<()> {
    let mut lines: Vec<String> = fs::read_to_string(file(target))?.lines().map(str::to_owned).collect();
    let mut found = Vec::new();
    for entry in fs::read_dir(from)? {
        found.push(digits(&fs::read(entry?.path())?));
    }
    by_length(&mut found);
    let step = found.len() / MOST_SEEDS + 1;
    for line in found.into_iter().step_by(step) {
        let size: usize = lines.iter().map(String::len).sum();
        if lines.len() < MOST_SEEDS && size + line.len() <= MOST_DIGITS {
            lines.push(line);
        }
    }
    by_length(&mut lines);
    let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
    fs::write(file(target), text)?;
    Ok(())
}

/// The short ones first, each once.
fn by_length(lines: &mut Vec<String>) {
    lines.sort_by(|one, other| (one.len(), one).cmp(&(other.len(), other)));
    lines.dedup();
}

fn digits(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut digits, byte| {
        // Writing to a string cannot fail.
        let _ = write!(digits, "{byte:02x}");
        digits
    })
}

fn bytes(digits: &str) -> Vec<u8> {
    let pairs = (0..digits.len() / 2).filter_map(|at| digits.get(2 * at..2 * at + 2));
    pairs.filter_map(|pair| u8::from_str_radix(pair, 16).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::{bytes, digits};

    #[test]
    fn digits_are_bytes_again() {
        assert_eq!(bytes(&digits(&[0, 9, 255, 16])), [0, 9, 255, 16]);
    }
}
