//! Files that a shop has, which say what its machine is: read, and put into `gcheck.toml`.
//!
//! Knows: which formats there are, how a file shows its own, units of the command line. Must not know: arguments, where text is
//! printed, how files are written.

mod freecad;
mod freecad_machine;
mod fusion;
mod hal;
mod ini;
mod json;
mod merge;
mod mtconnect;
mod offsets;
mod request;
mod settings;
mod sheet;
mod surroundings;
mod table;
mod tools;
mod unread;
mod unused;
mod yaml;

use std::path::{Path, PathBuf};

pub(crate) use merge::{Merged, Target, merge};
pub(crate) use request::Request;
pub(crate) use surroundings::Surroundings;

use crate::args::ImportFormat;
use crate::config::Units;
use crate::{Problem, paths, reading};
use sheet::{Fact, MARK, Sheet, Tells, unit_name};

/// A larger file describes no machine.
const MOST_BYTES: u64 = 8 << 20;

/// What one file says.
#[derive(Debug)]
pub(crate) struct FileFacts {
    shown: String,
    units: Option<Units>,
    /// Where the unit is from, in words that follow "from".
    units_from: String,
    tells: Tells,
    facts: Vec<Fact>,
    /// What was not used, and what else is to be known, in words, a line each.
    pub(crate) unused: Vec<String>,
}

impl FileFacts {
    fn has_lengths(&self) -> bool {
        self.facts.iter().any(|fact| fact.value.is_length())
    }

    /// Does the file say anything that has a key?
    pub(crate) fn is_empty(&self) -> bool {
        self.facts.is_empty()
    }
}

/// Reads a file; the errors are all that is wrong with it.
pub(crate) fn read(path: &Path, request: Request<'_>) -> Result<FileFacts, Vec<Problem>> {
    let refused = |message: &str| vec![Problem::with_file(path, message)];
    let bytes =
        reading::regular(path, MOST_BYTES).map_err(|reason| refused(&format!("cannot read: {reason}")))?;
    read_bytes(path, &bytes, request)
}

/// As [`read`], of bytes that are there already; the path tells the format, and where other files are looked for.
pub(crate) fn read_bytes(path: &Path, bytes: &[u8], request: Request<'_>) -> Result<FileFacts, Vec<Problem>> {
    let refused = |message: &str| vec![Problem::with_file(path, message)];
    if bytes.starts_with(b"PK\x03\x04") {
        return Err(vec![
            Problem::with_file(path, "is an archive").help("unpack it, and import the file that is in it"),
        ]);
    }
    if bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) {
        return Err(vec![Problem::with_file(path, "is UTF-16 text").help("save it as UTF-8 or plain ASCII")]);
    }
    if bytes.contains(&0) {
        return Err(refused("is not text"));
    }
    let text = String::from_utf8_lossy(bytes.strip_prefix(MARK).unwrap_or(bytes));
    if text.trim().is_empty() {
        return Err(refused("is empty"));
    }
    let shown = paths::shown(path);
    let name = path.file_name().map_or_else(|| shown.clone(), |name| name.to_string_lossy().into_owned());
    let mut sheet = Sheet::new(shown, name, &text, request.units);
    sheet.has_mark = bytes.starts_with(MARK);
    read_sheet(&mut sheet, path, request)?;
    finish(sheet, path)
}

/// The format by what is in the file.
fn detected(path: &Path, text: &str) -> Option<ImportFormat> {
    let start = text.trim_start();
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("tbl" | "csv") => return Some(ImportFormat::ToolTable),
        Some("fctb" | "fctl") => return Some(ImportFormat::Freecad),
        Some("fcm") => return Some(ImportFormat::FreecadMachine),
        _ => {}
    }
    if start.starts_with('<') {
        Some(ImportFormat::Mtconnect)
    } else if start.starts_with('{') {
        if text.contains("\"machine\"") && text.contains("\"axes\"") {
            return Some(ImportFormat::FreecadMachine);
        }
        let is_bits = text.contains("\"parameter\"") || text.contains("\"nr\"");
        Some(if is_bits && !text.contains("\"data\"") { ImportFormat::Freecad } else { ImportFormat::Fusion })
    } else if settings::is_one(text) {
        Some(ImportFormat::Settings)
    } else if yaml::is_one(text) {
        Some(ImportFormat::Yaml)
    } else if ini::is_one(text) {
        Some(ImportFormat::Ini)
    } else if table::is_one(text) {
        Some(ImportFormat::ToolTable)
    } else if offsets::is_one(text) {
        Some(ImportFormat::Offsets)
    } else {
        None
    }
}

fn read_sheet(sheet: &mut Sheet<'_>, path: &Path, request: Request<'_>) -> Result<(), Vec<Problem>> {
    let folder: PathBuf = paths::absolute(path).parent().map(Path::to_owned).unwrap_or_default();
    let Some(format) = request.format.or_else(|| detected(path, sheet.text)) else {
        let problem = Problem::with_file(path, "does not show in which format it describes a machine")
            .help("name it: `--format ini`, `tool-table`, `settings`, `yaml`, `fusion`, `freecad`, `freecad-machine`, `mtconnect` or `offsets`");
        return Err(vec![problem]);
    };
    match format {
        ImportFormat::Ini => {
            if let Some((table, range)) = ini::read(sheet, &folder) {
                table::read_named(sheet, &table, &range, "[EMCIO] TOOL_TABLE");
            }
        }
        ImportFormat::ToolTable => table::read(sheet, path),
        ImportFormat::Settings => settings::read(sheet),
        ImportFormat::Mtconnect => mtconnect::read(sheet),
        ImportFormat::Offsets => offsets::read(sheet, path, request),
        ImportFormat::Fusion => {
            if let Some(document) = json::parse(sheet) {
                fusion::read(sheet, &document);
            }
        }
        ImportFormat::Yaml => yaml::read(sheet),
        ImportFormat::FreecadMachine => {
            if let Some(document) = json::parse(sheet) {
                if freecad_machine::is_one(&document) {
                    freecad_machine::read(sheet, &document);
                } else {
                    sheet.refuse(&(0..1), "the file has no `machine` with `axes`, so it is not a machine");
                }
            }
        }
        ImportFormat::Freecad => {
            if let Some(document) = json::parse(sheet) {
                if document.get("tools").is_some_and(serde_json::Value::is_array) {
                    freecad::read_library(sheet, &document, &folder);
                } else if document.get("parameter").is_some() {
                    freecad::read_bit(sheet, &document);
                } else {
                    sheet.refuse(
                        &(0..1),
                        "the file has neither `tools` nor `parameter`, so it is neither a library nor a bit",
                    );
                }
            }
        }
    }
    Ok(())
}

/// Units, and words for what was not used.
fn finish(sheet: Sheet<'_>, path: &Path) -> Result<FileFacts, Vec<Problem>> {
    let mut unused = unused::unused(&sheet);
    unused.extend(sheet.remarks.iter().map(|remark| format!("{}: {remark}", sheet.shown)));
    let mut problems = sheet.problems;
    if let (Some(asked), Some(own), Some(range)) = (sheet.asked, sheet.units, &sheet.units_at)
        && asked != own
        && !sheet.converted
        && problems.is_empty()
    {
        let message = format!(
            "the lengths of the file count in {}, and `--units` says {}",
            unit_name(own),
            unit_name(asked)
        );
        problems.push(Problem::at(&sheet.shown, sheet.text, range, message));
    }
    let needs_units = sheet.facts.iter().any(|fact| fact.value.counts_in_units());
    if sheet.units.is_none() && needs_units && problems.is_empty() {
        problems.push(
            Problem::with_file(path, "does not say in which unit its lengths are")
                .help("name the unit: `--units mm` or `--units inch`"),
        );
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    let units_from = if sheet.units_at.is_some() { sheet.name } else { "--units".to_owned() };
    Ok(FileFacts {
        shown: sheet.shown,
        units: sheet.units,
        units_from,
        tells: sheet.tells,
        facts: sheet.facts,
        unused,
    })
}
