//! The lines that say which control was used.
//!
//! Knows: how files with the same choice share a line. Must not know: any control, how a choice is made.

use std::collections::BTreeMap;

use crate::shown::{number, one_line};
use crate::{ControlSource, Report};

/// Reasons that are listed in one line.
const REASONS: usize = 3;

/// What the files of one line share: the control, the source of the choice, and the reason where it is of one file alone.
type Shared<'a> = (&'a str, ControlSource, &'a str);

/// Says which control was used: one line for all files that share a control and the source of the choice.
pub fn control_lines(report: &Report) -> Vec<String> {
    let mut groups: BTreeMap<Shared<'_>, Vec<(&str, &str)>> = BTreeMap::new();
    for file in report.files() {
        let reason = file.control.because.as_deref().unwrap_or_default();
        // What a file is for does not hold for another one that nothing decided.
        let own = if file.control.source == ControlSource::Default { reason } else { "" };
        let key = (file.control.name.as_str(), file.control.source, own);
        groups.entry(key).or_default().push((&file.path, reason));
    }
    // The first file leads, so that the lines are in the order in which findings will be.
    let mut groups: Vec<_> = groups.into_iter().collect();
    groups.sort_by_key(|(_, files)| files.first().map(|(path, _)| *path));
    groups.into_iter().map(|((name, source, _), files)| line(name, source, &files)).collect()
}

fn line(name: &str, source: ControlSource, files: &[(&str, &str)]) -> String {
    let mut reasons: Vec<&str> = files.iter().map(|(_, reason)| *reason).filter(|r| !r.is_empty()).collect();
    if files.len() > 1 {
        // What a reason adds after `;` holds for its file, not for all of the line.
        for reason in &mut reasons {
            *reason = reason.split(';').next().unwrap_or_default();
        }
    }
    reasons.sort_unstable();
    reasons.dedup();
    // How many show it is another number for each file.
    let is_counted = source == ControlSource::Neighbours && files.len() > 1;
    let reasons = if is_counted || reasons.len() > REASONS { String::new() } else { reasons.join(", ") };
    let path = files.first().map_or("", |(path, _)| path);
    let more = match files.len() {
        0 | 1 => String::new(),
        2 => " and 1 more file".to_owned(),
        n => format!(" and {} more files", number(n - 1)),
    };
    one_line(&format!("{path}{more}: control {name}, {}", source.phrase(&reasons, files.len()))).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ControlChoice;
    use crate::testing::file;

    fn lines(choices: &[(&str, &str, ControlSource, Option<&str>)]) -> Vec<String> {
        let files = choices.iter().map(|(path, name, source, because)| {
            let because = because.map(str::to_owned);
            crate::FileReport {
                control: ControlChoice { name: (*name).to_owned(), source: *source, because },
                ..file(path, "", vec![])
            }
        });
        control_lines(&Report::new(files.collect()))
    }

    #[test]
    fn the_reason_of_one_file_is_not_that_of_another() {
        let by_default = |path, because| (path, "generic-mill", ControlSource::Default, because);
        assert_eq!(
            lines(&[
                by_default("a.mpf", Some("the file is for a SINUMERIK control")),
                by_default("b.nc", None)
            ]),
            [
                "a.mpf: control generic-mill, by default: the file is for a SINUMERIK control",
                "b.nc: control generic-mill, by default",
            ]
        );
    }

    #[test]
    fn one_file_says_why() {
        use ControlSource::{Comment, Configuration, Default, Detected, Option};
        let line = |source, because| lines(&[("part.nc", "haas-mill", source, because)]).remove(0);
        assert_eq!(line(Detected, Some("(VF-2)")), "part.nc: control haas-mill, detected from (VF-2)");
        assert_eq!(
            line(Configuration, Some("gcheck.toml")),
            "part.nc: control haas-mill, set in gcheck.toml"
        );
        assert_eq!(line(Option, None), "part.nc: control haas-mill, set by `--control`");
        assert_eq!(
            line(Comment, Some("(gcheck: control=haas-mill)")),
            "part.nc: control haas-mill, set by the comment (gcheck: control=haas-mill)"
        );
        assert_eq!(line(Default, None), "part.nc: control haas-mill, by default");
    }

    #[test]
    fn files_that_agree_share_a_line() {
        use ControlSource::{Configuration, Detected};
        let detected = lines(&[
            ("c.nc", "haas-mill", Detected, Some("(VF-2)")),
            ("b.nc", "fanuc-mill", Configuration, Some("gcheck.toml")),
            ("a.nc", "haas-mill", Detected, Some("(VF-3)")),
            ("d.nc", "haas-mill", Detected, Some("(VF-2)")),
        ]);
        assert_eq!(
            detected,
            [
                "a.nc and 2 more files: control haas-mill, detected from (VF-2), (VF-3)",
                "b.nc: control fanuc-mill, set in gcheck.toml",
            ]
        );
    }

    #[test]
    fn what_a_reason_adds_for_one_file_is_not_told_of_all() {
        let detected = |path, because| (path, "haas-lathe", ControlSource::Detected, Some(because));
        assert_eq!(
            lines(&[
                detected("a.nc", "`$` lines; fanuc-lathe fits nearly as well"),
                detected("b.nc", "`$` lines")
            ]),
            ["a.nc and 1 more file: control haas-lathe, detected from `$` lines"]
        );
    }

    #[test]
    fn a_guess_is_called_one() {
        let by = |path, source, because| (path, "haas-mill", source, Some(because));
        assert_eq!(
            lines(&[
                by("a.nc", ControlSource::Guessed, "`G154`; fanuc-mill fits nearly as well"),
                by("b.nc", ControlSource::Detected, "(VF-2)"),
                by("c.nc", ControlSource::Neighbours, "5 of 6 show it"),
                by("d.nc", ControlSource::Neighbours, "7 of 9 show it"),
            ]),
            [
                "a.nc: control haas-mill, guessed from `G154`; fanuc-mill fits nearly as well: no finding is above a warning",
                "b.nc: control haas-mill, detected from (VF-2)",
                "c.nc and 1 more file: control haas-mill, guessed from their neighbours: no finding is above a warning",
            ]
        );
    }

    #[test]
    fn many_reasons_are_not_listed() {
        let names: Vec<String> = (0..5).map(|n| format!("{n}.nc")).collect();
        let choices: Vec<_> = names
            .iter()
            .map(|n| (n.as_str(), "haas-mill", ControlSource::Detected, Some(n.as_str())))
            .collect();
        assert_eq!(lines(&choices), ["0.nc and 4 more files: control haas-mill, detected from the programs"]);
    }
}
