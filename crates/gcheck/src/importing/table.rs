//! Tool tables on disk: `[tools]` names the file, so that it is read as it is when programs are executed.
//!
//! Knows: what is checked before a table is named. Must not know: the forms of tables.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use super::sheet::{Sheet, Value, lines};
use crate::config::Units;
use crate::execution::tool_table_of;
use crate::quoting::Workspace;
use crate::{paths, reading};

/// A larger file is not a tool table.
const MOST_BYTES: u64 = 8 << 20;

/// Does a text look like a line a tool: `T1 P1 Z0.511`?
pub(super) fn is_one(text: &str) -> bool {
    let mut tools = 0;
    for (_, line) in lines(text) {
        let line = line.split(';').next().unwrap_or_default().trim();
        let is_tool = line
            .split_whitespace()
            .any(|word| word.strip_prefix(['T', 't']).is_some_and(|number| number.parse::<f64>().is_ok()));
        let is_words = line.split_whitespace().all(|word| {
            let mut letters = word.chars();
            letters.next().is_some_and(|c| c.is_ascii_alphabetic()) && letters.as_str().parse::<f64>().is_ok()
        });
        // A program calls a tool with `M6`, and moves.
        let is_code =
            line.split_whitespace().any(|word| word.starts_with(['G', 'M', 'N', 'O', 'g', 'm', 'n', 'o']));
        match (line.is_empty(), is_tool && is_words && !is_code) {
            (true, _) => {}
            (false, true) => tools += 1,
            (false, false) => return false,
        }
    }
    tools > 0
}

/// Takes the file itself as a tool table.
pub(super) fn read(sheet: &mut Sheet<'_>, path: &Path) {
    let is_csv = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
    if sheet.has_mark && !is_csv {
        // The table is read as it is when programs are executed.
        let message = "a mark of the byte order is before the first tool; save the table without it (as UTF-8, not UTF-8 with BOM)";
        return sheet.refuse(&(0..1), message);
    }
    match tool_table_of(&sheet.shown, sheet.text, is_csv, sheet.units.unwrap_or(Units::Mm)) {
        Ok(table) => {
            again(sheet, is_csv, &table);
            put(sheet, path, table.len(), &(0..0), None);
        }
        Err(problem) => sheet.problems.push(problem),
    }
}

/// Takes the tool table that a file names.
pub(super) fn read_named(sheet: &mut Sheet<'_>, path: &Path, range: &Range<usize>, place: &str) {
    let shown = paths::shown_from_here(path);
    let is_csv = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
    if !path.exists() {
        return sheet.leave(range, place, format!("the file {shown} does not exist"));
    }
    let bytes = match reading::regular(path, MOST_BYTES) {
        Ok(bytes) => bytes,
        Err(reason) => return sheet.leave(range, place, format!("cannot read {shown}: {reason}")),
    };
    let text = String::from_utf8_lossy(&bytes);
    match tool_table_of(&shown, &text, is_csv, sheet.units.unwrap_or(Units::Mm)) {
        Ok(table) => put(sheet, path, table.len(), range, Some(place)),
        Err(problem) => {
            // Others' files are not quoted; what the rest of this file says is as good without the table.
            let line = problem.place().map_or(1, |(_, line, _, _)| line);
            let may_quote = Workspace::here().may_quote(path);
            let message = if may_quote { problem.message() } else { "not the line of a tool" };
            sheet.leave(range, place, format!("cannot read {shown}, line {line}: {message}"));
        }
    }
}

fn put(sheet: &mut Sheet<'_>, path: &Path, count: usize, range: &Range<usize>, place: Option<&str>) {
    let tools = if count == 1 { "1 tool".to_owned() } else { format!("{count} tools") };
    let place = place.map_or_else(|| tools.clone(), |place| format!("{place}: {tools}"));
    sheet.put(&["tools", "table"], Value::Table(paths::absolute(path)), range, &place);
}

/// Lists tools that a table has twice.
fn again(sheet: &mut Sheet<'_>, is_csv: bool, numbers: &[u32]) {
    let is_tool = |line: &str| {
        if is_csv {
            !line.trim().is_empty()
        } else {
            !line.split(';').next().unwrap_or_default().trim().is_empty()
        }
    };
    let starts = lines(sheet.text).filter(|(_, line)| is_tool(line)).map(|(start, _)| start);
    let starts: Vec<usize> = starts.skip(usize::from(is_csv)).collect();
    let mut seen: BTreeMap<u32, usize> = BTreeMap::new();
    for (number, start) in numbers.iter().zip(starts) {
        if let Some(before) = seen.insert(*number, start) {
            let why = format!("line {} has the tool again, and the later line counts", sheet.line(start));
            sheet.leave(&(before..before), format!("tool {number}"), why);
        }
    }
}
