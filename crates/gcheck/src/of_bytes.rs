//! What is read of files, as functions of their bytes: for tests that make up any bytes, such as the fuzz targets.
//!
//! Knows: which forms there are. Must not know: who makes up the bytes. Nothing here writes a file.

use std::path::Path;
use std::sync::Arc;

use gcheck_engine::Model;

use crate::config::{self, Config, Configs, Units};
use crate::execution::{Equipment, Start, tool_table_of};
use crate::importing::{self, Request, Surroundings, Target};

/// Reads a text as `gcheck.toml`, and asks it for the settings and the machine of a program; false if it is refused.
pub fn configuration(text: &str) -> bool {
    let Ok(layer) = config::layer_of_text(Path::new("gcheck.toml"), text) else { return false };
    let config = Config::of_layer(Arc::new(layer));
    let program = Path::new("legacy/part.nc");
    let settings = config.settings(program);
    let _ = config.wants(program, true);
    let name = settings.control.as_deref().unwrap_or(gcheck_controls::fallback());
    if let Ok(control) = gcheck_controls::load(name) {
        let control = control.with_user_codes(&settings.codes);
        // A tool table that cannot be read is refused here, not in the configuration.
        let _ = Equipment::new(&settings, &Model::new(&control), Start::Fresh);
    }
    true
}

/// Reads a text as a tool table, with columns or with words; false if it is refused.
pub fn tool_table(text: &str, is_csv: bool) -> bool {
    tool_table_of("tools", text, is_csv, Units::Mm).is_ok()
}

/// Imports the bytes of a file of this name into the text of a configuration; `None` if either is refused.
pub fn import(name: &str, bytes: &[u8], before: &str) -> Option<String> {
    let request =
        Request { format: None, units: Some(Units::Mm), control: None, config: &[], has_file: false };
    let facts = importing::read_bytes(Path::new(name), bytes, request).ok()?;
    let path = Path::new("gcheck.toml");
    let config = Configs::new(&[], true).ok()?.of_file(path).ok()?;
    let surroundings = Surroundings::new(path, &config, None);
    let target =
        Target { path, before, overwrite: bytes.len().is_multiple_of(2), surroundings: &surroundings };
    importing::merge(&target, &[facts], None).ok().map(|merged| merged.text)
}

/// Reads bytes as a stored result of a check; false if they are not one.
pub fn stored_result(bytes: &[u8]) -> bool {
    crate::check::is_stored_result(bytes)
}
