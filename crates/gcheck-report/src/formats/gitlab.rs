//! `gitlab`: a code quality report, which GitLab shows in merge requests.
//!
//! Knows: the members that GitLab reads, and that it drops findings of equal fingerprint. Must not know: source text.

use std::io::{self, Write};

use gcheck_diagnostics::Severity;
use serde::Serialize;

use super::list::List;
use crate::Report;
use crate::shown::one_line;

#[derive(Serialize)]
struct Issue<'r> {
    description: String,
    check_name: &'r str,
    fingerprint: String,
    severity: &'static str,
    location: Location<'r>,
}

#[derive(Serialize)]
struct Location<'r> {
    /// From the root of the repository, without `./`.
    path: &'r str,
    positions: Positions,
}

#[derive(Serialize)]
struct Positions {
    begin: Place,
    end: Place,
}

#[derive(Serialize)]
struct Place {
    line: u32,
    column: u32,
}

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let mut list = List::begin(out)?;
    for file in report.files() {
        for (finding, fingerprint) in file.findings.iter().zip(file.fingerprints()) {
            let span = file.source.span(&finding.range);
            let place = |at: crate::Position| Place { line: at.line, column: at.column };
            list.item(
                out,
                &Issue {
                    description: format!("{}: {}", finding.rule.id, one_line(&finding.message)),
                    check_name: finding.rule.id,
                    fingerprint: fingerprint.to_string(),
                    severity: severity(finding.severity),
                    location: Location {
                        path: file.rooted(),
                        positions: Positions { begin: place(span.start), end: place(span.end) },
                    },
                },
            )?;
        }
    }
    list.end(out)?;
    writeln!(out)
}

/// GitLab's five words; `blocker` is left to people.
fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "critical",
        Severity::Warning => "major",
        Severity::Info => "minor",
        Severity::Hint => "info",
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use expect_test::expect;
    use serde_json::Value;

    use crate::Format;
    use crate::testing::{everything, on, render, report};

    #[test]
    fn an_issue_a_finding() {
        expect![[r#"
            [
              {"description":"feed-missing: no feed rate is in effect","check_name":"feed-missing","fingerprint":"149a7a4dd9ecc09d284ba0866a301a1b","severity":"critical","location":{"path":"part.nc","positions":{"begin":{"line":4,"column":5},"end":{"line":4,"column":7}}}},
              {"description":"arc-end-off-circle: arc may end off the circle","check_name":"arc-end-off-circle","fingerprint":"a447bc762e13c1017d57e064941370ba","severity":"minor","location":{"path":"part.nc","positions":{"begin":{"line":5,"column":5},"end":{"line":5,"column":16}}}}
            ]
        "#]].assert_eq(&render(&everything(), Format::Gitlab));
    }

    #[test]
    fn nothing_found_is_an_empty_list() {
        expect![[r#"
            []
        "#]]
        .assert_eq(&render(&report("G1", vec![]), Format::Gitlab));
    }

    #[test]
    fn fingerprints_differ_on_equal_lines() {
        let text = "G1\nG1\nG1\n";
        let findings = [0, 3, 6].map(|start| {
            let mut finding = on(text, "G1");
            finding.range = start..start + 2;
            finding
        });
        let issues: Vec<Value> =
            serde_json::from_str(&render(&report(text, findings.to_vec()), Format::Gitlab)).unwrap();
        let prints: HashSet<String> = issues.iter().map(|issue| issue["fingerprint"].to_string()).collect();
        assert_eq!(prints.len(), 3);
    }
}
