//! Mistakes that somebody wrote who had the manual and the programs, but had not read the rules.
//!
//! Knows: the two tables of a set of mistakes, how an edit changes a program. Must not know: what a rule means.
//!
//! `mistakes-N.toml` is committed before gcheck runs on one of them. `mistakes-N.found.tsv` has every finding that the edit
//! brought, and whether it names the mistake; it is never edited once it is sealed.

use std::fs;
use std::path::Path;

use serde::Deserialize;

use super::{Unreadable, table};

const FOUND: [&str; 8] =
    ["mistake", "line", "severity", "certainty", "rule", "names-it", "reason", "message"];

/// What comes of a mistake that nobody notices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ComesOfIt {
    /// A tool, spindle, head or fixture is hit.
    Crash,
    /// The part is wrong.
    Scrap,
    /// The control stops before anything is harmed.
    Alarm,
    /// Nothing today; harm when the program is changed, restarted or followed by another.
    Trap,
}

/// One mistake: an edit of one of our programs.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// `B1-07`.
    pub id: String,
    /// Below the repository's folder.
    pub program: String,
    /// The folder name of the control in the knowledge base.
    pub control: String,
    /// The first line that the edit touches, from 1.
    pub line: usize,
    /// How many lines go.
    pub delete: usize,
    /// The lines that come in their place.
    pub insert: Vec<String>,
    /// What happens.
    pub comes_of_it: ComesOfIt,
    /// The line of the changed program where it happens.
    pub strikes: u32,
    /// What is wrong, in one sentence.
    pub what: String,
    /// Manual and page, or `experience`.
    pub source: String,
}

impl Mistake {
    /// The program with the mistake, with the line ends that it has. `None` where the edit is outside of it.
    pub fn apply(&self, program: &str) -> Option<String> {
        let end = if program.contains("\r\n") { "\r\n" } else { "\n" };
        let lines: Vec<&str> = program.split_inclusive('\n').collect();
        let from = self.line.checked_sub(1)?;
        let before = lines.get(..from)?;
        let after = lines.get(from.checked_add(self.delete)?..)?;
        let inserted: String = self.insert.iter().map(|line| format!("{line}{end}")).collect();
        Some(before.concat() + &inserted + &after.concat())
    }
}

/// A finding that the edit brought.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewFinding {
    /// [`Mistake::id`].
    pub mistake: String,
    /// Of the changed program, from 1.
    pub line: u32,
    /// `error`, `warning`, `info` or `hint`.
    pub severity: String,
    /// `always` or `maybe`.
    pub certainty: String,
    /// Its id.
    pub rule: String,
    /// Would somebody who reads it find the mistake? `None` until a reader said so.
    pub names_it: Option<bool>,
    /// The reader's.
    pub reason: String,
    /// What gcheck wrote.
    pub message: String,
}

impl NewFinding {
    /// Is it at or above the severity that people see who change nothing?
    pub fn is_a_warning(&self) -> bool {
        matches!(self.severity.as_str(), "warning" | "error")
    }
}

/// A set of mistakes with its first look.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MistakeSet {
    /// From 1.
    pub number: u32,
    /// In the order of the table.
    pub mistakes: Vec<Mistake>,
    /// `None`, when there is no first look yet.
    pub found: Option<Vec<NewFinding>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    mistake: Vec<Mistake>,
}

impl MistakeSet {
    /// The table of mistakes of a set, below the folder of tables.
    pub fn mistakes_name(number: u32) -> String {
        format!("mistakes-{number}.toml")
    }

    /// The table of its first look.
    pub fn found_name(number: u32) -> String {
        format!("mistakes-{number}.found.tsv")
    }

    /// Every set of the folder, by number.
    pub fn all(folder: &Path) -> Result<Vec<Self>, Unreadable> {
        (1..)
            .take_while(|number| folder.join(Self::mistakes_name(*number)).is_file())
            .map(|number| Self::read(folder, number))
            .collect()
    }

    /// One set.
    pub fn read(folder: &Path, number: u32) -> Result<Self, Unreadable> {
        let path = folder.join(Self::mistakes_name(number));
        let unreadable = |error: String| Unreadable(format!("{}: {error}", path.display()));
        let text = fs::read_to_string(&path).map_err(|error| unreadable(error.to_string()))?;
        let File { mistake: mistakes } =
            toml::from_str(&text).map_err(|error| unreadable(error.to_string()))?;
        let path = folder.join(Self::found_name(number));
        let found = if path.is_file() { Some(found(&path)?) } else { None };
        Ok(Self { number, mistakes, found })
    }

    /// The table of a first look, to be read by somebody.
    pub fn found_text(found: &[NewFinding]) -> String {
        table::text(
            &FOUND,
            found.iter().map(|one| {
                let names_it = one.names_it.map_or("", |yes| if yes { "yes" } else { "no" });
                [
                    &one.mistake,
                    &one.line.to_string(),
                    &one.severity,
                    &one.certainty,
                    &one.rule,
                    names_it,
                    &one.reason,
                    &one.message,
                ]
                .map(ToString::to_string)
                .to_vec()
            }),
        )
    }

    /// Has a reader judged every row of the first look? Before that nothing can be counted.
    pub fn is_judged(&self) -> bool {
        self.found.as_ref().is_some_and(|found| found.iter().all(|one| one.names_it.is_some()))
    }

    /// The findings that name a mistake.
    pub fn naming(&self, mistake: &Mistake) -> impl Iterator<Item = &NewFinding> {
        let found = self.found.iter().flatten();
        found.filter(move |one| one.mistake == mistake.id && one.names_it == Some(true))
    }
}

fn found(path: &Path) -> Result<Vec<NewFinding>, Unreadable> {
    let wrong =
        |line: usize, what: &str| Unreadable(format!("{}:{line}: {what} cannot be read", path.display()));
    let rows = table::rows(path, &FOUND)?.into_iter().map(|(at, cells)| {
        let [mistake, line, severity, certainty, rule, names_it, reason, message] =
            cells.try_into().map_err(|_| wrong(at, "columns"))?;
        let names_it = match names_it.as_str() {
            "" => None,
            "yes" => Some(true),
            "no" => Some(false),
            _ => return Err(wrong(at, "names-it")),
        };
        let line = line.parse().map_err(|_| wrong(at, "the line's number"))?;
        Ok(NewFinding { mistake, line, severity, certainty, rule, names_it, reason, message })
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::{ComesOfIt, Mistake, MistakeSet, NewFinding};

    fn edit(line: usize, delete: usize, insert: &[&str]) -> Mistake {
        Mistake {
            id: "B1-01".to_owned(),
            program: "fixtures/clean/acme-mill/1.nc".to_owned(),
            control: "acme-mill".to_owned(),
            line,
            delete,
            insert: insert.iter().map(ToString::to_string).collect(),
            comes_of_it: ComesOfIt::Crash,
            strikes: 2,
            what: "Rapid to the depth.".to_owned(),
            source: "experience".to_owned(),
        }
    }

    #[test]
    fn an_edit_keeps_the_line_ends_of_the_program() {
        assert_eq!(edit(2, 1, &["G00 Z-5."]).apply("A\r\nB\r\nC\r\n").unwrap(), "A\r\nG00 Z-5.\r\nC\r\n");
        assert_eq!(edit(2, 0, &["X1.", "X2."]).apply("A\nB\n").unwrap(), "A\nX1.\nX2.\nB\n");
        assert_eq!(edit(1, 2, &[]).apply("A\nB\nC").unwrap(), "C");
    }

    #[test]
    fn a_first_look_counts_when_every_row_is_judged() {
        let finding = |names_it| NewFinding {
            mistake: "B1-01".to_owned(),
            line: 2,
            severity: "warning".to_owned(),
            certainty: "always".to_owned(),
            rule: "rapid-plunge".to_owned(),
            names_it,
            reason: String::new(),
            message: String::new(),
        };
        let set = |found| MistakeSet { number: 1, mistakes: vec![edit(2, 1, &[])], found };
        assert!(!set(None).is_judged());
        assert!(!set(Some(vec![finding(Some(true)), finding(None)])).is_judged());
        assert!(set(Some(vec![finding(Some(true)), finding(Some(false))])).is_judged());
    }

    #[test]
    fn an_edit_outside_of_the_program_is_none() {
        assert_eq!(edit(4, 1, &[]).apply("A\nB\n"), None);
        assert_eq!(edit(0, 1, &[]).apply("A\nB\n"), None);
    }
}
