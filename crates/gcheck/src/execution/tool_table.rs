//! Tool tables on disk: lines of words (`T1 P1 Z0.511 D0.125 ;end mill`), or columns with a heading (CSV).
//!
//! Knows: both forms, and how a mistake in them reads. Must not know: which machine the tools are for.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use gcheck_controls::Letter;
use gcheck_engine::{Axis, Position, Tool, Units};
use gcheck_geometry::Mm;
use gcheck_syntax::SourceText;

use crate::quoting::Workspace;
use crate::{Problem, paths, reading};

/// A larger file is not a tool table.
const MAX_BYTES: u64 = 64 << 20;
/// More tools than this are a mistake.
const MAX_TOOLS: usize = 100_000;

/// Tools in the order of the file.
#[derive(Debug, Default)]
pub(super) struct ToolTableFile {
    pub(super) tools: Vec<(u32, Tool)>,
    /// What the file says of a tool in words.
    pub(super) remarks: BTreeMap<u32, String>,
}

/// Reads a table; its lengths are in `units`.
pub(super) fn read(path: &Path, units: Units) -> Result<ToolTableFile, Problem> {
    let source = source(path)?;
    parsed(&paths::shown_from_here(path), source.text(), is_csv(path), units)
        .map_err(|problem| if Workspace::here().may_quote(path) { problem } else { problem.without_text() })
}

/// The text of a table.
pub(super) fn source(path: &Path) -> Result<SourceText, Problem> {
    let name = paths::shown_from_here(path);
    let bytes = reading::regular(path, MAX_BYTES).map_err(|reason| {
        Problem::with_file(Path::new(&name), format!("cannot read: {reason}"))
            .help("`tools.table` names this file")
    })?;
    reading::text(Path::new(&name), &bytes).map_err(|problem| problem.help("`tools.table` names this file"))
}

/// Has a table columns, by its name?
pub(super) fn is_csv(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
}

/// Reads the text of a table; `name` is what messages call it.
pub(super) fn parsed(name: &str, text: &str, is_csv: bool, units: Units) -> Result<ToolTableFile, Problem> {
    let read = if is_csv { columns } else { words };
    read(text, units.in_mm()).map_err(|Mistake { range, message }| Problem::at(name, text, &range, message))
}

/// The line of a tool, without its end: the one that counts, where several have its number. Lines with mistakes are passed over.
pub(super) fn line_of(text: &str, is_csv: bool, tool: u32) -> Option<Range<usize>> {
    let mut heading: Option<&str> = None;
    let mut found = None;
    for (start, line) in lines(text).filter(|(_, line)| !line.trim().is_empty()) {
        let read = match heading {
            None if is_csv => {
                heading = Some(line);
                continue;
            }
            Some(heading) => columns(&format!("{heading}\n{line}"), 1.0),
            None => words(line, 1.0),
        };
        if read.is_ok_and(|read| read.tools.iter().any(|(number, _)| *number == tool)) {
            found = Some(start..start + line.trim_end().len());
        }
    }
    found
}

/// What is wrong, and where.
#[derive(Debug)]
struct Mistake {
    range: Range<usize>,
    message: String,
}

impl Mistake {
    fn new(range: Range<usize>, message: impl Into<String>) -> Self {
        Self { range, message: message.into() }
    }
}

/// Lines without their ends, with their first byte.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut start = 0;
    text.split_inclusive(['\n', '\r']).map(move |line| {
        let at = start;
        start += line.len();
        (at, line.trim_end_matches(['\n', '\r']))
    })
}

const NO_TOOL: Tool = Tool {
    pocket: 0,
    offset: Position::ZERO,
    diameter: Mm(0.0),
    corner_radius: Mm::UNKNOWN,
    angles: [0.0; 2],
    orientation: 0,
};

impl ToolTableFile {
    fn add(&mut self, number: u32, tool: Tool, remark: &str, range: Range<usize>) -> Result<(), Mistake> {
        if self.tools.len() >= MAX_TOOLS {
            return Err(Mistake::new(range, format!("more than {MAX_TOOLS} tools")));
        }
        self.tools.push((number, tool));
        let remark = remark.trim().trim_start_matches(';').trim();
        if !remark.is_empty() {
            self.remarks.insert(number, remark.to_owned());
        }
        Ok(())
    }
}

/// A line a tool, each value after its letter.
fn words(text: &str, mm: f64) -> Result<ToolTableFile, Mistake> {
    let mut table = ToolTableFile::default();
    for (start, line) in lines(text) {
        let (told, remark) = line.split_once(';').unwrap_or((line, ""));
        if told.trim().is_empty() {
            continue;
        }
        let mut number = None;
        let mut pocket = None;
        let mut tool = NO_TOOL;
        let mut at = 0;
        for word in told.split_inclusive(char::is_whitespace) {
            let range = start + at..start + at + word.trim_end().len();
            at += word.len();
            let word = word.trim();
            let Some(letter) = word.chars().next() else { continue };
            let value = word.get(letter.len_utf8()..).unwrap_or_default();
            let no_number = || Mistake::new(range.clone(), format!("`{word}` is not a letter with a number"));
            let parsed: f64 = value.parse().map_err(|_| no_number())?;
            if !parsed.is_finite() {
                return Err(no_number());
            }
            let whole = || {
                whole(parsed)
                    .ok_or_else(|| Mistake::new(range.clone(), format!("`{word}` must be a whole number")))
            };
            match letter.to_ascii_uppercase() {
                'T' => number = Some(whole()?),
                'P' => pocket = Some(whole()?),
                'D' => tool.diameter = Mm(parsed * mm),
                'I' => tool.angles[0] = parsed,
                'J' => tool.angles[1] = parsed,
                'Q' => {
                    tool.orientation = u8::try_from(whole()?)
                        .ok()
                        .filter(|orientation| *orientation <= 9)
                        .ok_or_else(|| Mistake::new(range.clone(), "`Q`, where the tip points, is 0 to 9"))?;
                }
                other => match Axis::ALL.into_iter().find(|axis| axis.name() == other) {
                    Some(axis) => tool.offset.set(axis, if axis.is_rotary() { parsed } else { parsed * mm }),
                    None => {
                        let known = "T, P, X, Y, Z, A, B, C, U, V, W, D, I, J and Q";
                        return Err(Mistake::new(
                            range,
                            format!("`{letter}` says nothing of a tool; known are {known}"),
                        ));
                    }
                },
            }
        }
        let range = start..start + told.trim_end().len();
        let Some(number) = number else {
            return Err(Mistake::new(range, "a tool's line has its number: `T1`"));
        };
        // A line's place is its own when it names none.
        tool.pocket = pocket.unwrap_or(number);
        table.add(number, tool, remark, range)?;
    }
    Ok(table)
}

#[expect(clippy::cast_sign_loss, reason = "in the range of u32")]
fn whole(value: f64) -> Option<u32> {
    (value >= 0.0 && value <= f64::from(u32::MAX) && value.fract() == 0.0).then_some(value as u32)
}

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Column {
    Number,
    Pocket,
    Offset(Axis),
    Diameter,
    /// Of the cutter.
    Radius,
    CornerRadius,
    Orientation,
    Remark,
    Other,
}

impl Column {
    fn of(heading: &str) -> Self {
        let heading: String =
            heading.to_lowercase().chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        match heading.trim_matches('_') {
            "t" | "tool" | "number" | "no" | "nr" | "tool_number" | "toolnumber" => Self::Number,
            "p" | "pocket" => Self::Pocket,
            "length" | "h" | "length_offset" | "offset" => Self::Offset(Axis::Z),
            "d" | "diameter" | "dia" => Self::Diameter,
            "radius" => Self::Radius,
            "corner_radius" | "nose_radius" | "tip_radius" => Self::CornerRadius,
            "q" | "orientation" | "tip" | "tip_direction" => Self::Orientation,
            "comment" | "remark" | "description" | "name" | "title" => Self::Remark,
            one if one.len() == 1 => {
                Letter::parse(&one.to_uppercase()).and_then(Axis::of).map_or(Self::Other, Self::Offset)
            }
            _ => Self::Other,
        }
    }
}

/// Columns under a heading, parted by commas, semicolons or tabs.
fn columns(text: &str, mm: f64) -> Result<ToolTableFile, Mistake> {
    let mut table = ToolTableFile::default();
    let mut lines = lines(text).filter(|(_, line)| !line.trim().is_empty());
    let Some((start, heading)) = lines.next() else { return Ok(table) };
    // A mark of the byte order is not part of the first heading.
    let cut = heading.len() - heading.trim_start_matches('\u{FEFF}').len();
    let (start, heading) = (start + cut, heading.get(cut..).unwrap_or_default());
    let separator = [';', '\t', ','].into_iter().find(|c| heading.contains(*c)).unwrap_or(',');
    let columns: Vec<Column> = cells(heading, separator).map(|(_, cell)| Column::of(&cell)).collect();
    if !columns.contains(&Column::Number) {
        let message = "the first line has no column called `tool`, `number` or `T`";
        return Err(Mistake::new(start..start + heading.len(), message));
    }
    for (start, line) in lines {
        let mut number = None;
        let mut remark = String::new();
        // What a table does not list is not known, unlike in the other form, where every value has a default.
        let mut tool = NO_TOOL;
        tool.offset.set(Axis::Z, f64::NAN);
        tool.diameter = Mm::UNKNOWN;
        let mut pocket = None;
        for ((range, cell), column) in cells(line, separator).zip(&columns) {
            let range = start + range.start..start + range.end;
            if cell.is_empty() || *column == Column::Other {
                continue;
            }
            if *column == Column::Remark {
                remark = cell;
                continue;
            }
            // A decimal comma can only be meant where commas part nothing.
            let text = if separator == ',' { cell.clone() } else { cell.replace(',', ".") };
            let text = if *column == Column::Number { text.trim_start_matches(['T', 't']) } else { &text };
            let value: f64 = text
                .parse()
                .ok()
                .filter(|value: &f64| value.is_finite())
                .ok_or_else(|| Mistake::new(range.clone(), format!("`{cell}` is not a number")))?;
            let whole = || {
                whole(value)
                    .ok_or_else(|| Mistake::new(range.clone(), format!("`{cell}` must be a whole number")))
            };
            match column {
                Column::Number => number = Some(whole()?),
                Column::Pocket => pocket = Some(whole()?),
                Column::Offset(axis) => {
                    tool.offset.set(*axis, if axis.is_rotary() { value } else { value * mm });
                }
                Column::Diameter => tool.diameter = Mm(value * mm),
                Column::Radius => tool.diameter = Mm(2.0 * value * mm),
                Column::CornerRadius => tool.corner_radius = Mm(value * mm),
                Column::Orientation => {
                    tool.orientation =
                        u8::try_from(whole()?).ok().filter(|orientation| *orientation <= 9).ok_or_else(
                            || Mistake::new(range.clone(), "a tip points in one of the directions 0 to 9"),
                        )?;
                }
                Column::Remark | Column::Other => {}
            }
        }
        let range = start..start + line.len();
        let Some(number) = number else { return Err(Mistake::new(range, "this line has no tool number")) };
        tool.pocket = pocket.unwrap_or(number);
        table.add(number, tool, &remark, range)?;
    }
    Ok(table)
}

/// Cells of a line with their bytes; quotes may hold separators.
fn cells(line: &str, separator: char) -> impl Iterator<Item = (Range<usize>, String)> {
    let mut rest = Some(0);
    std::iter::from_fn(move || {
        let start = rest?;
        let tail = line.get(start..)?;
        let mut quoted = false;
        let end = tail.char_indices().find_map(|(at, c)| {
            quoted ^= c == '"';
            (c == separator && !quoted).then_some(at)
        });
        rest = end.map(|end| start + end + separator.len_utf8());
        let cell = tail.get(..end.unwrap_or(tail.len()))?;
        let plain = cell.trim();
        let plain = match plain.strip_prefix('"').and_then(|inner| inner.strip_suffix('"')) {
            Some(inner) => inner.replace("\"\"", "\""),
            None => plain.to_owned(),
        };
        Some((start..start + cell.len(), plain.trim().to_owned()))
    })
}

#[cfg(test)]
mod tests {
    use gcheck_engine::Axis;

    use super::{Mistake, ToolTableFile, columns, line_of, words};

    /// Number, pocket, length, diameter and remark of each tool.
    fn told(read: Result<ToolTableFile, Mistake>) -> Vec<String> {
        let table = read.unwrap();
        let one = |(number, tool): &(u32, gcheck_engine::Tool)| {
            let remark = table.remarks.get(number).map_or("", String::as_str);
            format!("T{number} P{} Z{} D{} {remark}", tool.pocket, tool.offset.raw(Axis::Z), tool.diameter.0)
        };
        table.tools.iter().map(one).collect()
    }

    #[test]
    fn words_stand_in_any_order_and_case() {
        assert_eq!(
            told(words("T1 P2 Z0.5 D1 ;mill\r\n;nothing\n\n  d+.5 z-1e0 t2\n", 25.4)),
            ["T1 P2 Z12.7 D25.4 mill", "T2 P2 Z-25.4 D12.7 ",]
        );
        let table = words("T3 X1 A90 I5 J10 Q9\n", 25.4).unwrap();
        let tool = table.tools[0].1;
        // Angles are degrees in any unit.
        assert_eq!((tool.offset.raw(Axis::X), tool.offset.raw(Axis::A)), (25.4, 90.0));
        assert_eq!((tool.angles, tool.orientation), ([5.0, 10.0], 9));
    }

    #[test]
    fn the_line_of_a_tool_is_found_beside_lines_with_mistakes() {
        let line =
            |text: &str, is_csv: bool, tool: u32| line_of(text, is_csv, tool).map(|at| text[at].to_owned());
        let text = "; T3 old\r\nT1 P1 Z1\r\nZ2 T3 D1 ;drill \r\nT3 oops\r\nT13\r\n";
        assert_eq!(line(text, false, 3).as_deref(), Some("Z2 T3 D1 ;drill"));
        assert_eq!(line(text, false, 13).as_deref(), Some("T13"));
        assert_eq!(line(text, false, 2), None);
        assert_eq!(line("T3 Z1\nT3 Z2\n", false, 3).as_deref(), Some("T3 Z2"), "the last one counts");
        let text = "\ntool;length\nT3;1,5\n4;x\n5;2\n";
        assert_eq!(line(text, true, 3).as_deref(), Some("T3;1,5"));
        assert_eq!(line(text, true, 5).as_deref(), Some("5;2"));
        assert_eq!(line(text, true, 4), None);
        assert_eq!(line("length\n3\n", true, 3), None, "no column has numbers of tools");
    }

    #[test]
    fn columns_are_found_by_their_headings() {
        assert_eq!(
            told(columns("Tool,Length,Radius,Comment\n1,2,3,\"a, b\"\"c\"\"\"\n", 1.0)),
            ["T1 P1 Z2 D6 a, b\"c\""]
        );
        assert_eq!(told(columns("\u{FEFF}T;Z;D\nT5;1,5;0,25\n", 1.0)), ["T5 P5 Z1.5 D0.25 "]);
        assert_eq!(told(columns("number\tpocket\tcolour\n7\t3\tred\n", 1.0)), ["T7 P3 ZNaN DNaN "]);
        assert_eq!(told(columns("", 1.0)), Vec::<String>::new());
    }

    #[test]
    fn a_mistake_knows_its_place() {
        let place = |read: Result<ToolTableFile, Mistake>| read.unwrap_err().range;
        assert_eq!(place(words("T1 Z1\nT2 Zµ\n", 1.0)), 9..12);
        assert_eq!(place(words("T1 Q10\n", 1.0)), 3..6);
        assert_eq!(place(columns("tool;length\n1;\n2;x\n", 1.0)), 17..18);
        assert_eq!(place(columns("tool\n-1\n", 1.0)), 5..7);
        assert_eq!(place(columns("tool\n4294967296\n", 1.0)), 5..15);
    }
}
