//! The real-program corpus: programs that nobody of the project wrote, for measuring only.
//!
//! Knows: where to find it and how its index reads. Must not know: what is measured. Nothing of it is ever copied into the
//! project.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

use crate::skips::skip;

/// One program of the corpus.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CorpusProgram {
    /// Path inside the corpus, with forward slashes.
    pub name: String,
    /// Path on disk.
    pub path: PathBuf,
    /// The control that the index guesses, by our names where we have it.
    pub control: String,
    /// The public repository.
    pub repository: String,
    /// The repository's commit.
    pub commit: String,
    /// The repository's licence.
    pub licence: String,
}

/// The folder of the corpus.
///
/// `GCHECK_CORPUS` names it. Without that, a `corpus` folder with an `index.tsv` that is next to the checkout, directly
/// or one folder down, is taken.
pub fn folder() -> Option<PathBuf> {
    if let Some(named) = env::var_os("GCHECK_CORPUS") {
        return Some(PathBuf::from(named)).filter(|f| f.join("index.tsv").is_file());
    }
    let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2)?;
    let mut beside: Vec<PathBuf> =
        fs::read_dir(checkout.parent()?).ok()?.flatten().map(|entry| entry.path()).collect();
    beside.sort();
    let candidates = beside.into_iter().flat_map(|folder| [folder.clone(), folder.join("corpus")]);
    candidates.into_iter().find(|f| f.ends_with("corpus") && f.join("index.tsv").is_file())
}

/// The programs of the corpus (not its expected outputs and tool tables), in the order of the index.
///
/// `None`, with a line on standard error that says so, where there is no corpus.
pub fn programs() -> Option<Vec<CorpusProgram>> {
    let Some(folder) = folder() else {
        skip("a test of real programs", "corpus", "GCHECK_CORPUS names its folder");
        return None;
    };
    let index = fs::read_to_string(folder.join("index.tsv")).ok()?;
    Some(read(&index, &folder))
}

/// The text of a program of the corpus, or of its first lines with an end of their own: `folder/program.ngc:120`.
///
/// # Errors
/// The program cannot be read, or what is behind the last `:` is not a number.
pub fn part(folder: &Path, part: &str) -> io::Result<Vec<u8>> {
    let Some((name, lines)) = part.rsplit_once(':') else { return fs::read(folder.join(part)) };
    let lines: usize = lines.parse().map_err(|error| io::Error::new(io::ErrorKind::InvalidInput, error))?;
    let text = fs::read(folder.join(name))?;
    let some: Vec<&[u8]> = text.split(|byte| *byte == b'\n').take(lines).collect();
    Ok([&some.join(&b'\n')[..], b"\nM2\n"].concat())
}

/// The programs that an index lists: tab-separated, the first line names the columns.
fn read(index: &str, folder: &Path) -> Vec<CorpusProgram> {
    let mut lines = index.lines();
    let head: Vec<&str> = lines.next().unwrap_or_default().split('\t').collect();
    let program = |line: &str| {
        let fields: Vec<&str> = line.split('\t').collect();
        let field = |name: &str| {
            let column = head.iter().position(|h| *h == name)?;
            fields.get(column).map(|text| (*text).to_owned())
        };
        let name = field("path")?;
        (field("kind")? == "program").then_some(())?;
        Some(CorpusProgram {
            path: folder.join(&name),
            name,
            control: field("dialect")?,
            repository: field("repo")?,
            commit: field("commit")?,
            licence: field("licence")?,
        })
    };
    lines.filter_map(program).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::{part, read};

    #[test]
    fn a_part_of_the_corpus_ends_after_its_lines() {
        let corpus = tempfile::tempdir().unwrap();
        fs::write(corpus.path().join("a.ngc"), "G21\nG1 X1 F100\nX2\nM2\n").unwrap();
        let text = |name| String::from_utf8(part(corpus.path(), name).unwrap()).unwrap();
        assert_eq!(text("a.ngc:2"), "G21\nG1 X1 F100\nM2\n");
        assert_eq!(text("a.ngc"), "G21\nG1 X1 F100\nX2\nM2\n");
        assert!(part(corpus.path(), "b.ngc").is_err());
        assert!(part(corpus.path(), "a.ngc:two").is_err());
    }

    #[test]
    fn the_index_names_its_columns() {
        let index = "path\tkind\tdialect\trepo\tcommit\tlicence\n\
            b/1.nc\tprogram\tacme-mill\ta/b\t0123\tMIT\n\
            b/tool.tbl\taux\t-\ta/b\t0123\tMIT\n";
        let programs = read(index, Path::new("c"));
        let [program] = programs.as_slice() else { panic!("one program: {programs:?}") };
        assert_eq!((program.name.as_str(), program.control.as_str()), ("b/1.nc", "acme-mill"));
        assert_eq!((program.repository.as_str(), program.licence.as_str()), ("a/b", "MIT"));
        assert_eq!(program.path, Path::new("c").join("b/1.nc"));
    }
}
