//! `jsonl`: one JSON object a finding and line, for programs that read as it comes.
//!
//! Knows: that each line is a finding of `json` with the control of its file. Must not know: the members of a finding.

use std::io::{self, Write};

use schemars::JsonSchema;
use serde::Serialize;

use super::json::{JsonFinding, json_finding};
use crate::{ControlChoice, Report};

/// A line of `jsonl`: a finding, and the control of its file.
#[derive(Serialize, JsonSchema)]
pub(super) struct Line<'r> {
    #[serde(flatten)]
    finding: JsonFinding<'r>,
    /// The control that the file was read for.
    control: &'r ControlChoice,
}

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    for file in report.files() {
        for (finding, fingerprint) in file.findings.iter().zip(file.fingerprints()) {
            let finding = json_finding(report, file, finding, fingerprint);
            serde_json::to_writer(&mut *out, &Line { finding, control: &file.control })?;
            writeln!(out)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use crate::Format;
    use crate::testing::{everything, render};

    #[test]
    fn every_line_is_a_finding_of_json_and_its_control() {
        let whole: Value = serde_json::from_str(&render(&everything(), Format::Json)).unwrap();
        let lines = render(&everything(), Format::Jsonl);
        let lines: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        let findings = whole["findings"].as_array().unwrap();
        assert_eq!(lines.len(), findings.len());
        for (line, finding) in lines.iter().zip(findings) {
            let mut line = line.as_object().unwrap().clone();
            let control = line.remove("control");
            assert_eq!(
                control,
                Some(json!({ "name": "acme-mill", "source": "detected", "because": "(ACME)" }))
            );
            assert_eq!(Value::Object(line), *finding);
        }
    }
}
