//! Draws: programs that nobody had read, what gcheck reported at first sight, and what a reader says of it.
//!
//! Knows: the two tables of a draw. Must not know: where the programs' text is, what a rule means.
//!
//! `draw-N.tsv` lists the programs and is committed before gcheck sees one. `draw-N.findings.tsv` has every error and warning
//! of the first look with its verdict; it is never edited once it is sealed.

use std::path::Path;

use super::{Unreadable, table};

const PROGRAMS: [&str; 7] = ["sha256", "repo", "commit", "path", "lines", "machine", "why"];
const FINDINGS: [&str; 9] =
    ["program", "line", "severity", "certainty", "rule", "control", "verdict", "reason", "message"];

/// One program of a draw.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DrawnProgram {
    /// Of its bytes, in hexadecimal digits.
    pub sha256: String,
    /// The public repository: owner and name.
    pub repository: String,
    /// The commit that was read.
    pub commit: String,
    /// Inside the repository.
    pub path: String,
    /// The control that the reader who drew it takes it for, by its folder name in the knowledge base.
    pub machine: String,
}

impl DrawnProgram {
    /// The folder of its text below the folder of the draw, and the name that findings use.
    pub fn short(&self) -> &str {
        self.sha256.get(..12).unwrap_or(&self.sha256)
    }

    /// The file's own name, which the choice of a control may look at.
    pub fn file_name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or(&self.path)
    }
}

/// What a reader says of a finding, seeing the program and the manual only.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The control refuses it, does something else than is meant, or somebody about to run it would want to know.
    True,
    /// The program is right there, or what the finding says is not so.
    False,
    /// It depends on a setting, a macro or an intention that the program does not show.
    Unsure,
}

impl Verdict {
    fn parse(word: &str) -> Option<Self> {
        match word {
            "true" => Some(Self::True),
            "false" => Some(Self::False),
            "unsure" => Some(Self::Unsure),
            _ => None,
        }
    }
}

/// One finding of the first look.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Judged {
    /// [`DrawnProgram::short`].
    pub program: String,
    /// From 1.
    pub line: u32,
    /// `error` or `warning`.
    pub severity: String,
    /// `always` or `maybe`.
    pub certainty: String,
    /// Its id.
    pub rule: String,
    /// The control that gcheck chose.
    pub control: String,
    /// `None` until a reader gave it.
    pub verdict: Option<Verdict>,
    /// The reader's.
    pub reason: String,
    /// What gcheck wrote.
    pub message: String,
}

/// A draw with its first look.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Draw {
    /// From 1.
    pub number: u32,
    /// In the order of the table.
    pub programs: Vec<DrawnProgram>,
    /// Empty, when there is no first look yet.
    pub findings: Vec<Judged>,
}

impl Draw {
    /// The table of programs of a draw, below the folder of tables.
    pub fn programs_name(number: u32) -> String {
        format!("draw-{number}.tsv")
    }

    /// The table of its first look.
    pub fn findings_name(number: u32) -> String {
        format!("draw-{number}.findings.tsv")
    }

    /// Every draw of the folder, by number.
    pub fn all(folder: &Path) -> Result<Vec<Self>, Unreadable> {
        (1..)
            .take_while(|number| folder.join(Self::programs_name(*number)).is_file())
            .map(|number| Self::read(folder, number))
            .collect()
    }

    /// One draw.
    pub fn read(folder: &Path, number: u32) -> Result<Self, Unreadable> {
        let path = folder.join(Self::programs_name(number));
        let programs = table::rows(&path, &PROGRAMS)?.into_iter().map(|(at, cells)| {
            let [sha256, repository, commit, path_inside, _, machine, _] =
                cells.try_into().map_err(|_| wrong(&path, at, "columns"))?;
            Ok(DrawnProgram { sha256, repository, commit, path: path_inside, machine })
        });
        let programs = programs.collect::<Result<Vec<_>, _>>()?;
        let path = folder.join(Self::findings_name(number));
        let findings = if path.is_file() { findings(&path)? } else { Vec::new() };
        Ok(Self { number, programs, findings })
    }

    /// The table of a first look, to be read by somebody.
    pub fn findings_text(findings: &[Judged]) -> String {
        table::text(
            &FINDINGS,
            findings.iter().map(|one| {
                let verdict = match one.verdict {
                    Some(Verdict::True) => "true",
                    Some(Verdict::False) => "false",
                    Some(Verdict::Unsure) => "unsure",
                    None => "",
                };
                [
                    &one.program,
                    &one.line.to_string(),
                    &one.severity,
                    &one.certainty,
                    &one.rule,
                    &one.control,
                    verdict,
                    &one.reason,
                    &one.message,
                ]
                .map(ToString::to_string)
                .to_vec()
            }),
        )
    }
}

fn findings(path: &Path) -> Result<Vec<Judged>, Unreadable> {
    let rows = table::rows(path, &FINDINGS)?.into_iter().map(|(at, cells)| {
        let [program, line, severity, certainty, rule, control, verdict, reason, message] =
            cells.try_into().map_err(|_| wrong(path, at, "columns"))?;
        let line = line.parse().map_err(|_| wrong(path, at, "the line's number"))?;
        let verdict = match verdict.as_str() {
            "" => None,
            word => Some(Verdict::parse(word).ok_or_else(|| wrong(path, at, "the verdict"))?),
        };
        if verdict.is_some() && reason.is_empty() {
            return Err(wrong(path, at, "the reason of the verdict"));
        }
        Ok(Judged { program, line, severity, certainty, rule, control, verdict, reason, message })
    });
    rows.collect()
}

fn wrong(path: &Path, line: usize, what: &str) -> Unreadable {
    Unreadable(format!("{}:{line}: {what} cannot be read", path.display()))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::{Draw, Judged, Verdict};

    fn finding(verdict: Option<Verdict>, reason: &str) -> Judged {
        Judged {
            program: "0123456789ab".to_owned(),
            line: 7,
            severity: "error".to_owned(),
            certainty: "always".to_owned(),
            rule: "feed-missing".to_owned(),
            control: "acme-mill".to_owned(),
            verdict,
            reason: reason.to_owned(),
            message: "a cut without a feed".to_owned(),
        }
    }

    #[test]
    fn a_first_look_reads_as_it_was_written() {
        let folder = tempfile::tempdir().unwrap();
        let head = "sha256\trepo\tcommit\tpath\tlines\tmachine\twhy\n";
        let program = "0123456789abcdef\ta/b\tc0ffee\tparts/1.nc\t9\tacme-mill\ttools by Txx M06\n";
        fs::write(folder.path().join("draw-1.tsv"), format!("{head}{program}")).unwrap();
        let findings = [finding(None, ""), finding(Some(Verdict::False), "the feed is given\tabove")];
        fs::write(folder.path().join("draw-1.findings.tsv"), Draw::findings_text(&findings)).unwrap();

        let draws = Draw::all(folder.path()).unwrap();
        let [draw] = draws.as_slice() else { panic!("{draws:?}") };
        assert_eq!(draw.programs[0].short(), "0123456789ab");
        assert_eq!(draw.programs[0].file_name(), "1.nc");
        assert_eq!(draw.findings[0], findings[0]);
        assert_eq!(draw.findings[1].reason, "the feed is given above");
    }

    #[test]
    fn a_verdict_needs_a_reason_and_a_known_word() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("draw-1.findings.tsv");
        let text = Draw::findings_text(&[finding(Some(Verdict::True), "")]);
        fs::write(&path, &text).unwrap();
        assert!(super::findings(&path).unwrap_err().0.contains(":2: the reason"));
        fs::write(&path, text.replace("\ttrue\t", "\tperhaps\t")).unwrap();
        assert!(super::findings(&path).unwrap_err().0.contains(":2: the verdict"));
    }
}
