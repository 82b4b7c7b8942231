//! The few lines of a program that a finding shows.
//!
//! Knows: which lines are needed, which part of a long line, how they may be shown. Must not know: findings, codespan.
//!
//! An excerpt is a small text of its own, so that what draws it never sees the program: a file of 56 MB costs what three
//! lines cost. Places are kept: every spot of the program has its place in the excerpt and its true line and column.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::shown;
use crate::source::Source;

/// A line of more characters is cut to a window.
const LONGEST: usize = 200;
/// Characters of the window.
const WINDOW: usize = 120;
/// Characters that the window shows before the first spot, and more where the line ends soon.
const LEAD: usize = 40;
/// Shown where a line is cut.
const CUT: char = '…';
/// A spot over more lines shows its first lines and its last two, so that nothing is drawn per line of a long spot.
const FIRST_LINES: u32 = 4;
const LAST_LINES: u32 = 2;
/// So many empty lines replace omitted ones, enough that they are drawn as a break.
const BREAK_LINES: usize = 2;

/// Some lines of a program.
#[derive(Debug)]
pub(crate) struct Excerpt {
    text: String,
    lines: Vec<Line>,
    /// The spots in the order they were asked for, as bytes of `text`.
    spots: Vec<Range<usize>>,
    /// Column of each spot's start in the program.
    columns: Vec<usize>,
}

#[derive(Debug)]
struct Line {
    number: usize,
    range: Range<usize>,
}

impl Excerpt {
    /// The lines that show `spots`, of which the first matters most.
    pub(crate) fn new(source: &Source, spots: &[Range<u32>]) -> Self {
        let wanted: Vec<Spot> = spots.iter().map(|range| Spot::new(source, range)).collect();
        let mut excerpt = Self {
            text: String::new(),
            lines: Vec::new(),
            spots: vec![0..0; wanted.len()],
            columns: Vec::new(),
        };
        let mut previous = 0;
        for number in lines_of(&wanted) {
            if previous > 0 && number > previous + 1 {
                for _ in 0..BREAK_LINES {
                    excerpt.end_line(excerpt.text.len(), previous);
                }
            }
            excerpt.show(source, number, &wanted);
            previous = number;
        }
        excerpt.columns = wanted.iter().map(|spot| source.position(spot.start).column as usize).collect();
        excerpt
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    pub(crate) fn spots(&self) -> &[Range<usize>] {
        &self.spots
    }

    /// Index of the line that holds a byte.
    pub(crate) fn line_at(&self, byte: usize) -> usize {
        self.lines.partition_point(|line| line.range.start <= byte).saturating_sub(1)
    }

    /// Bytes of a line.
    pub(crate) fn line_range(&self, line: usize) -> Option<Range<usize>> {
        self.lines.get(line).map(|line| line.range.clone())
    }

    /// Its number in the program, from 1.
    pub(crate) fn line_number(&self, line: usize) -> Option<usize> {
        self.lines.get(line).map(|line| line.number)
    }

    /// Column in the program of a byte at which a spot starts. Of spots outside the window, which share a place, the
    /// first one's.
    pub(crate) fn column_at(&self, byte: usize) -> Option<usize> {
        let at = self.spots.iter().position(|spot| spot.start == byte)?;
        self.columns.get(at).copied()
    }

    /// Adds a line, or the window of it that shows its spots.
    fn show(&mut self, source: &Source, number: u32, spots: &[Spot]) {
        let line = source.index().line_range(source.text(), number);
        let start_of_line = self.text.len();
        let window = window(source, &line, number, spots);
        if window.start > line.start {
            self.text.push(CUT);
        }
        let shown = self.text.len();
        // Where each character of the window went.
        let mut places = Vec::with_capacity((window.end - window.start) as usize + 1);
        let slice = source.text().get(window.start as usize..window.end as usize).unwrap_or_default();
        for (at, c) in slice.char_indices() {
            let offset = window.start + at as u32;
            places.push((offset, self.text.len()));
            self.text.push(if source.is_stand_in(offset) {
                shown::REPLACEMENT
            } else {
                shown::program_char(c)
            });
        }
        let end_of_window = self.text.len();
        if window.end < line.end {
            self.text.push(CUT);
        }
        let place = |offset: u32| {
            let at = places.partition_point(|(o, _)| *o < offset);
            places.get(at).map_or(end_of_window, |(_, place)| *place)
        };
        for (spot, out) in spots.iter().zip(&mut self.spots) {
            if spot.first_line == number {
                // A spot outside the window starts at the cut after which it is.
                out.start = if spot.start < window.start { start_of_line } else { place(spot.start) };
            }
            if spot.last_line == number {
                out.end = match spot.end {
                    end if end < window.start => shown,
                    end if end > window.end => self.text.len(),
                    end => place(end),
                };
            }
        }
        self.end_line(start_of_line, number);
    }

    fn end_line(&mut self, start: usize, number: u32) {
        self.lines.push(Line { number: number as usize, range: start..self.text.len() });
        self.text.push('\n');
    }
}

/// A range of the program without the line ends at its own ends, so that a whole line is underlined as one.
#[derive(Debug)]
struct Spot {
    start: u32,
    end: u32,
    first_line: u32,
    last_line: u32,
}

impl Spot {
    fn new(source: &Source, range: &Range<u32>) -> Self {
        let span = source.span(range);
        let line_end = |line| source.index().line_range(source.text(), line).end;
        let first_line = span.start.line;
        let start = span.start.offset.min(line_end(first_line));
        let at_line_start = span.end.column == 1 && span.end.line > first_line;
        let last_line = if at_line_start { span.end.line - 1 } else { span.end.line };
        let end = span.end.offset.min(line_end(last_line));
        Self { start, end, first_line, last_line }
    }
}

/// Numbers of the lines to show, ascending.
fn lines_of(spots: &[Spot]) -> BTreeSet<u32> {
    let mut lines = BTreeSet::new();
    for spot in spots {
        if spot.last_line - spot.first_line < FIRST_LINES + LAST_LINES {
            lines.extend(spot.first_line..=spot.last_line);
        } else {
            lines.extend(spot.first_line..spot.first_line + FIRST_LINES);
            lines.extend(spot.last_line + 1 - LAST_LINES..=spot.last_line);
        }
    }
    // A single line between two shown ones says more than a break.
    let between = |(a, b): (&u32, &u32)| (*b == a + 2).then_some(a + 1);
    let gaps: Vec<u32> = lines.iter().zip(lines.iter().skip(1)).filter_map(between).collect();
    lines.extend(gaps);
    lines
}

/// The part of a line to show, on character boundaries. Looks at no more of the line than it shows.
fn window(source: &Source, line: &Range<u32>, number: u32, spots: &[Spot]) -> Range<u32> {
    let text = source.text().get(line.start as usize..line.end as usize).unwrap_or_default();
    if text.len() <= LONGEST || is_at_most(text, LONGEST) {
        return line.clone();
    }
    let starts = spots.iter().filter(|spot| spot.first_line == number).map(|spot| spot.start);
    let ends = spots.iter().filter(|spot| spot.last_line == number).map(|spot| spot.end);
    // Without an end here the line lies inside a longer spot, and its beginning is as good as any part.
    let anchor = starts.clone().chain(ends.clone()).next().unwrap_or(line.start);
    let (first, last) = starts.chain(ends).fold((anchor, anchor), |(a, b), at| (a.min(at), b.max(at)));
    let place = |offset: u32| (offset - line.start) as usize;
    let all_fit = text.get(place(first)..place(last)).is_some_and(|part| is_at_most(part, WINDOW - LEAD));
    let (before, after) =
        text.split_at_checked(place(if all_fit { first } else { anchor })).unwrap_or(("", text));
    // What one side does not need, the other gets.
    let lead = before.chars().rev().take(LEAD).count();
    let rest = after.chars().take(WINDOW - lead).count();
    let start = before.char_indices().rev().take(WINDOW - rest).last().map_or(before.len(), |(at, _)| at);
    let behind = after.char_indices().nth(rest).map_or(after.len(), |(at, _)| at);
    line.start + start as u32..line.start + (before.len() + behind) as u32
}

/// Without counting the rest of a long text.
fn is_at_most(text: &str, characters: usize) -> bool {
    text.chars().nth(characters).is_none()
}
