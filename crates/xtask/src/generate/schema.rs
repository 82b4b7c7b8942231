//! `docs/gcheck.schema.json`: the JSON schema of `gcheck.toml`, for editors that complete and check TOML;
//! `docs/findings.schema.json`: that of the findings, for programs that read them.
//!
//! Knows: where the schemas are. Must not know: any key of the configuration, any member of a finding.

use std::path::PathBuf;

use super::generated::Generated;

/// The schemas, as `gcheck schema` prints them.
pub(super) fn generate() -> Generated {
    vec![
        (PathBuf::from("docs/gcheck.schema.json"), gcheck::config::schema()),
        (PathBuf::from("docs/findings.schema.json"), gcheck_report::findings_schema()),
    ]
}
