//! Tools of a library on their way to `[tools]`: each number once.
//!
//! Knows: which numbers and sizes a tool can have. Must not know: any format of libraries.

use std::collections::BTreeMap;
use std::ops::Range;

use super::sheet::{Sheet, Value};

/// More tools than this are a mistake.
pub(super) const MOST_TOOLS: usize = 10_000;
/// A tool with more is a mistake.
const MOST_TEETH: f64 = 100.0;
/// The highest number that a program can call.
const HIGHEST_NUMBER: f64 = 99_999_999.0;

/// What a library says of a tool, in the library's unit.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct LibraryTool {
    pub(super) diameter: Option<f64>,
    pub(super) length: Option<f64>,
    pub(super) corner_radius: Option<f64>,
    /// How many cutting edges it has; no length.
    pub(super) teeth: Option<f64>,
    /// Its place in the file, and what it is called.
    pub(super) range: Range<usize>,
    pub(super) title: String,
}

impl LibraryTool {
    fn is_as(&self, other: &Self) -> bool {
        let sizes = |tool: &Self| [tool.diameter, tool.length, tool.corner_radius, tool.teeth];
        sizes(self) == sizes(other)
    }
}

/// The tools of a file.
#[derive(Debug, Default)]
pub(super) struct Library {
    tools: BTreeMap<u32, Vec<LibraryTool>>,
    count: usize,
}

impl Library {
    /// Adds a tool, if its number and its sizes can be; else the sheet says why not.
    pub(super) fn add(&mut self, sheet: &mut Sheet<'_>, number: Option<f64>, tool: LibraryTool) {
        let named = |tool: &LibraryTool| {
            if tool.title.is_empty() { "a tool".to_owned() } else { format!("`{}`", tool.title) }
        };
        let Some(number) = number else {
            return sheet.leave(&tool.range, named(&tool), "the tool has no number");
        };
        if number == 0.0 {
            return sheet.leave(
                &tool.range,
                named(&tool),
                "the tool has the number 0, which means an empty spindle",
            );
        }
        if number.fract() != 0.0 || !(1.0..=HIGHEST_NUMBER).contains(&number) {
            return sheet.refuse(&tool.range, format!("{number} is not the number of a tool"));
        }
        for (name, size) in [("diameter", tool.diameter), ("length", tool.length)] {
            if let Some(size) = size.filter(|size| *size <= 0.0) {
                return sheet.refuse(
                    &tool.range,
                    format!("the {name} of tool {number} is {size}: it must be greater than zero"),
                );
            }
        }
        if let Some(radius) = tool.corner_radius.filter(|radius| *radius < 0.0) {
            let message = format!("the corner radius of tool {number} is {radius}: it must not be negative");
            return sheet.refuse(&tool.range, message);
        }
        if let (Some(radius), Some(diameter)) = (tool.corner_radius, tool.diameter)
            && radius > diameter / 2.0 + 1e-6
        {
            let message =
                format!("the corner radius of tool {number} is {radius}, and its diameter {diameter}");
            return sheet.refuse(&tool.range, message);
        }
        self.count += 1;
        if self.count > MOST_TOOLS {
            if self.count == MOST_TOOLS + 1 {
                sheet.refuse(&tool.range, format!("more than {MOST_TOOLS} tools"));
            }
            return;
        }
        #[expect(clippy::cast_sign_loss, reason = "whole, and in the range of u32")]
        self.tools.entry(number as u32).or_default().push(tool);
    }

    /// Writes the tools that are clear.
    pub(super) fn put(self, sheet: &mut Sheet<'_>) {
        for (number, tools) in self.tools {
            let Some((tool, others)) = tools.split_first() else { continue };
            if let Some(other) = others.iter().find(|other| !other.is_as(tool)) {
                let [first, second] = [tool, other].map(|tool| sheet.line(tool.range.start));
                let why = if first == second {
                    format!("line {first} has it twice, with other sizes, so neither is written")
                } else {
                    format!("lines {first} and {second} have it with other sizes, so neither is written")
                };
                sheet.leave(&other.range, format!("tool {number}"), why);
                continue;
            }
            if let Some(other) = others.first() {
                let why = format!("line {} has the same tool already", sheet.line(tool.range.start));
                sheet.leave(&other.range, format!("tool {number}"), why);
            }
            let place = if tool.title.is_empty() { format!("tool {number}") } else { tool.title.clone() };
            let mut sizes = 0;
            let values =
                [("length", tool.length), ("diameter", tool.diameter), ("corner_radius", tool.corner_radius)];
            for (key, value) in values {
                if let Some(value) = value {
                    sheet.put(
                        &["tools", &number.to_string(), key],
                        Value::Length(value),
                        &tool.range,
                        &place,
                    );
                    sizes += 1;
                }
            }
            if let Some(teeth) = tool.teeth {
                if teeth.fract() == 0.0 && (1.0..=MOST_TEETH).contains(&teeth) {
                    #[expect(clippy::cast_sign_loss, reason = "whole, and in the range of u32")]
                    let teeth = teeth as u32;
                    let path = ["tools", &number.to_string(), "teeth"];
                    sheet.put(&path, Value::Count(teeth), &tool.range, &place);
                } else {
                    sheet.leave(
                        &tool.range,
                        format!("the teeth of tool {number}"),
                        format!("{teeth} is not a number of teeth"),
                    );
                }
            }
            if sizes == 0 {
                sheet.leave(&tool.range, format!("tool {number}"), "the file has no size of it");
            }
        }
    }
}

/// What a library says of its tools besides, which is not used.
#[derive(Debug, Default)]
pub(super) struct Besides {
    count: usize,
    first: Range<usize>,
}

impl Besides {
    /// One more tool has it.
    pub(super) fn add(&mut self, range: &Range<usize>) {
        if self.count == 0 {
            self.first = range.clone();
        }
        self.count += 1;
    }

    /// Lists it once for the file, at the first tool that has it.
    pub(super) fn leave(&self, sheet: &mut Sheet<'_>, what: &str, why: &str) {
        if self.count > 0 {
            let tools = if self.count == 1 { "1 tool".to_owned() } else { format!("{} tools", self.count) };
            sheet.leave(&self.first, format!("{what} of {tools}"), why);
        }
    }
}
