//! `docs/gcheck.schema.json`: the JSON schema of `gcheck.toml`, for editors that complete and check TOML.
//!
//! Knows: where the schema stands. Must not know: any key of the configuration.

use super::Generated;

/// The schema, as soon as the binary crate offers `gcheck::config::schema()` in its library.
#[expect(clippy::unnecessary_wraps, reason = "the signature of generators that can fail")]
pub(super) fn generate() -> anyhow::Result<Generated> {
    Ok(Vec::new())
}
