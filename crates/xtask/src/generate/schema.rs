//! `docs/gcheck.schema.json`: the JSON schema of `gcheck.toml`, for editors that complete and check TOML.
//!
//! Knows: where the schema is. Must not know: any key of the configuration.

use std::path::PathBuf;

use super::generated::Generated;

/// The schema, as `gcheck schema` prints it.
pub(super) fn generate() -> Generated {
    vec![(PathBuf::from("docs/gcheck.schema.json"), gcheck::config::schema())]
}
