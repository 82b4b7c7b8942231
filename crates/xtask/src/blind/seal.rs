//! What must not change any more, and a check that it did not.
//!
//! Knows: `tests/blind/sealed.tsv`: date, commit, SHA-256 and name of a file. Must not know: what is in the files.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, bail, ensure};
use sha2::{Digest as _, Sha256};

use crate::workspace::{self, TextFile};

const FOLDER: &str = "tests/blind/";
const SEALS: &str = "tests/blind/sealed.tsv";
const HEAD: &str = "date\tcommit\tsha256\tfile\n";

/// The SHA-256 of bytes, in hexadecimal digits.
pub(super) fn digest(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// Seals files of `tests/blind` as they are, with the commit that is checked out.
pub(super) fn seal(names: &[&str]) -> anyhow::Result<()> {
    let root = workspace::root();
    let seals = root.join(SEALS);
    let mut text = fs::read_to_string(&seals).unwrap_or_else(|_| HEAD.to_owned());
    let commit = said_by("git", &["rev-parse", "--short=12", "HEAD"])?;
    let date = said_by("git", &["log", "-1", "--format=%cs", "HEAD"])?;
    for name in names {
        if read(&text).any(|(_, _, of)| of == *name) {
            bail!("{name} is sealed already; what is sealed never changes");
        }
        let bytes = fs::read(root.join(FOLDER).join(name)).with_context(|| format!("{FOLDER}{name}"))?;
        let _ = writeln!(text, "{date}\t{commit}\t{}\t{name}", digest(&bytes));
        println!("sealed {FOLDER}{name}");
    }
    fs::write(&seals, text)?;
    Ok(())
}

/// Is a file sealed?
#[cfg(feature = "product")]
pub(super) fn is_sealed(name: &str) -> bool {
    let text = fs::read_to_string(workspace::root().join(SEALS)).unwrap_or_default();
    read(&text).any(|(_, _, of)| of == name)
}

/// Sealed files that are not as they were: the line of the seal, and what is wrong.
pub(crate) fn problems(files: &[TextFile]) -> Vec<(usize, String)> {
    let find = |path: &str| files.iter().find(|file| file.path == path);
    let Some(seals) = find(SEALS) else { return Vec::new() };
    let problem = |(line, sha256, name): (usize, &str, &str)| match find(&format!("{FOLDER}{name}")) {
        None => Some((line, format!("{name} is sealed, and is not there"))),
        Some(file) if digest(file.text.as_bytes()) != sha256 => {
            Some((line, format!("{name} is sealed, and was changed: a first look is never edited")))
        }
        Some(_) => None,
    };
    read(&seals.text).filter_map(problem).collect()
}

/// Where the seals are.
pub(crate) fn path() -> &'static Path {
    Path::new(SEALS)
}

/// Line number, digest and name of every seal.
fn read(text: &str) -> impl Iterator<Item = (usize, &str, &str)> {
    text.lines().enumerate().skip(1).filter_map(|(at, line)| {
        let mut cells = line.split('\t').skip(2);
        Some((at + 1, cells.next()?, cells.next()?))
    })
}

fn said_by(program: &str, arguments: &[&str]) -> anyhow::Result<String> {
    let output = Command::new(program).current_dir(workspace::root()).args(arguments).output()?;
    ensure!(output.status.success(), "{program} {arguments:?} fails");
    Ok(String::from_utf8(output.stdout)?.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::{HEAD, SEALS, digest, problems};
    use crate::workspace::TextFile;

    fn file(path: &str, text: &str) -> TextFile {
        TextFile { path: path.to_owned(), text: text.to_owned() }
    }

    #[test]
    fn a_sealed_file_that_changed_or_is_gone_is_a_problem() {
        // The digest of nothing, as every description of SHA-256 prints it.
        assert_eq!(digest(b""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
        let seal = format!("{HEAD}2026-11-22\tc0ffee\t{}\tdraw-1.tsv\n", digest(b"a\n"));
        let check =
            |files: &[TextFile]| problems(files).into_iter().map(|(line, _)| line).collect::<Vec<_>>();
        let seals = || file(SEALS, &seal);
        assert!(check(&[seals(), file("tests/blind/draw-1.tsv", "a\n")]).is_empty());
        assert_eq!(check(&[seals(), file("tests/blind/draw-1.tsv", "b\n")]), [2]);
        assert_eq!(check(&[seals()]), [2]);
        assert!(check(&[]).is_empty());
    }
}
