//! `docs/gcheck.schema.json`: the JSON schema of `gcheck.toml`, for editors that complete and check TOML.
//!
//! Knows: where the schema stands. Must not know: any key of the configuration.

use std::path::PathBuf;

use super::Generated;

/// The schema, as `gcheck schema` prints it.
pub(super) fn generate() -> Generated {
    vec![(PathBuf::from("docs/gcheck.schema.json"), gcheck::config::schema())]
}
