//! A section of one tool that goes to another place among those of the other tools.
//!
//! Knows: which sections runs have shown, what of them does not move, which words call a tool early. Must not know: what the
//! sections do; whether each still does the same is for the proof.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use gcheck_controls::{Letter, Machine};
use gcheck_engine::{At, Event, Model, Program};
use gcheck_program::{Loaded, Place, Word};

use crate::change::Destination;
use crate::order::Order;
use crate::refusal::Refusal;
use crate::scope::Scope;
use crate::section_lines::{Lines, Section, number_of};
use crate::sheet::Sheet;

const T: Letter = Letter::of('T');

/// The tool changes of runs. Has to see every block before it is executed, and every event.
pub(crate) struct ToolSections<'c> {
    destination: Destination,
    scope: Scope,
    model: &'c Model<'c>,
    /// The block of the program that is under way, in another file or not.
    block: Option<(u32, Range<u32>)>,
    /// The block of the change before, in this run.
    last_change: Option<u32>,
    /// By number of the block: its bytes and the tool that it changes to.
    changes: BTreeMap<u32, (Range<u32>, u32)>,
    /// The blocks in which the runs before ended.
    ends: BTreeSet<u32>,
}

/// A word that calls a tool while another one works.
struct EarlyCall {
    /// Index of the section that it is in.
    section: usize,
    tool: u32,
    /// Bytes of its number.
    value: Range<u32>,
}

impl<'c> ToolSections<'c> {
    pub(crate) fn new(destination: Destination, scope: &Scope, model: &'c Model<'c>) -> Self {
        Self {
            destination,
            scope: scope.clone(),
            model,
            block: None,
            last_change: None,
            changes: BTreeMap::new(),
            ends: BTreeSet::new(),
        }
    }

    pub(crate) fn begin(&mut self) {
        self.ends.extend(self.block.take().map(|(number, _)| number));
        self.last_change = None;
    }

    pub(crate) fn before(&mut self, at: At, place: &Place) {
        if at.file == 0 {
            self.block = Some((at.block, place.range()));
        }
    }

    pub(crate) fn event(&mut self, event: &Event) -> Result<(), Refusal> {
        let Event::ToolChange(tool) = event else { return Ok(()) };
        let Some((number, range)) = self.block.clone() else { return Ok(()) };
        let refuse = |reason: &str| Err(Refusal::at(range.clone(), reason));
        let Some(tool) = *tool else { return refuse("the number of this tool is not known") };
        if self.last_change.is_some_and(|last| last >= number) {
            return refuse("the tool changes do not run in the order of the text, each of them once");
        }
        self.last_change = Some(number);
        match self.changes.insert(number, (range.clone(), tool)) {
            Some((_, other)) if other != tool => refuse("this block changes to another tool each time"),
            _ => Ok(()),
        }
    }

    /// Writes the sections in their new order. The answer is what the person has to know.
    pub(crate) fn write(
        &self,
        sheet: &mut Sheet<'_, '_>,
        program: &Program<'_>,
        loaded: &Loaded<'_>,
    ) -> Result<Vec<String>, Refusal> {
        let mut ends = self.ends.clone();
        ends.extend(self.block.as_ref().map(|(number, _)| *number));
        let (Some(end), true) = (ends.first().copied(), ends.len() == 1) else {
            return Err(Refusal::whole("the program ends in another block when block delete is on"));
        };
        let lines = Lines::new(end, program, loaded, self.model);
        let (sections, of_last) = self.sections(&lines)?;
        let from = self.chosen(&sections)?;
        let to = self.target(&sections, from)?;
        if from == to {
            return Ok(Vec::new());
        }
        Order { sections: &sections, moved: from.min(to)..from.max(to) + 1, lines: &lines }.check()?;
        let mut order: Vec<usize> = (0..sections.len()).collect();
        let moved = order.remove(from);
        order.insert(to, moved);
        let (calls, stay) = self.early_calls(&sections, program, loaded);
        let rewritten = following(&sections, &order, &calls);
        put(sheet, &sections, from, to, &rewritten);
        let passes_last = from.max(to) + 1 == sections.len();
        let mut notes: Vec<String> = of_last.filter(|_| passes_last).into_iter().chain(stay).collect();
        notes.push(
            "the way to the first point of a section begins where the section above it ends: check that the tool clears the part there"
                .to_owned(),
        );
        Ok(notes)
    }

    /// The sections in the order of the text, and a note about the last lines of the last one.
    fn sections(&self, lines: &Lines<'_, '_>) -> Result<(Vec<Section>, Option<String>), Refusal> {
        let mut starts: Vec<(usize, u32)> = Vec::new();
        for (number, (range, tool)) in &self.changes {
            let Some(change) = lines.index(*number) else {
                let reason = "this block changes the tool, and it is not in the main program above its end";
                return Err(Refusal::at(range.clone(), reason).help(
                    "only sections of the main program move: leave tool changes out of called programs",
                ));
            };
            // A lathe calls the same tool again with another offset, and `T0` puts a tool away.
            if *tool == 0 || starts.last().is_some_and(|(_, last)| last == tool) {
                continue;
            }
            starts.push((lines.head(change, *tool, range)?, *tool));
        }
        let (last, of_last) = lines.last_section(&starts);
        let ends: Vec<usize> = starts.iter().skip(1).map(|(start, _)| *start).chain([last]).collect();
        let mut sections = Vec::new();
        for ((start, tool), end) in starts.into_iter().zip(ends) {
            sections.push(Section { tool, bytes: lines.start_of_line(start)?..lines.start_of_line(end)? });
        }
        Ok((sections, of_last))
    }

    /// The section that somebody chose, by its tool or one of its lines.
    fn chosen(&self, sections: &[Section]) -> Result<usize, Refusal> {
        let is_chosen = |section: &&Section| match &self.scope {
            Scope::All => false,
            Scope::Bytes(lines) => {
                lines.start < section.bytes.end && section.bytes.start < lines.end.max(lines.start + 1)
            }
            Scope::Tool(tool) => section.tool == *tool,
        };
        let help = "name a tool with --tool, or a line of its section with --lines";
        match sections.iter().filter(is_chosen).count() {
            1 => Ok(sections.iter().position(|section| is_chosen(&section)).unwrap_or(0)),
            0 if self.scope == Scope::All => Err(Refusal::whole("one section moves at a time").help(help)),
            0 => Err(Refusal::whole("these lines are not in the section of a tool").help(help)),
            _ => Err(Refusal::whole("more than one section is chosen")
                .help("choose a line of one of them with --lines")),
        }
    }

    /// The place of the chosen section among all of them when it has moved.
    fn target(&self, sections: &[Section], from: usize) -> Result<usize, Refusal> {
        let missing = |tool: u32| {
            let is_itself = sections.get(from).is_some_and(|section| section.tool == tool);
            let reason = if is_itself {
                format!("T{tool} is the tool of the section that moves, and no other section uses it")
            } else {
                format!("no section of the program uses T{tool}")
            };
            Refusal::whole(reason)
        };
        let is = |tool: u32| move |(at, section): &(usize, &Section)| *at != from && section.tool == tool;
        let mut others = sections.iter().enumerate();
        match self.destination {
            Destination::Up if from == 0 => Err(Refusal::whole("it is the first section already")),
            Destination::Up => Ok(from - 1),
            Destination::Down if from + 1 == sections.len() => {
                Err(Refusal::whole("it is the last section already"))
            }
            Destination::Down => Ok(from + 1),
            Destination::Before(tool) => {
                let (at, _) = others.find(is(tool)).ok_or_else(|| missing(tool))?;
                Ok(if at > from { at - 1 } else { at })
            }
            Destination::After(tool) => {
                let (at, _) = others.rfind(is(tool)).ok_or_else(|| missing(tool))?;
                Ok(if at > from { at } else { at + 1 })
            }
        }
    }

    /// The words that call the tool of the next section early, where all of them do; else a note that they stay.
    fn early_calls(
        &self,
        sections: &[Section],
        program: &Program<'_>,
        loaded: &Loaded<'_>,
    ) -> (Vec<EarlyCall>, Option<String>) {
        if self.model.control().machine() == Machine::Lathe {
            return (Vec::new(), None);
        }
        let mut calls: Vec<EarlyCall> = Vec::new();
        let (first, last) = (self.changes.keys().next(), loaded.flow_graph().blocks());
        for number in first.copied().unwrap_or(last)..last {
            let Some(place) = loaded.place(number, program.dialect()) else { continue };
            let start = place.range().start;
            let words = place.table.words(place.block());
            let (Some(section), Some(word)) = (
                sections.iter().position(|section| section.bytes.contains(&start)),
                words.iter().find(|word| word.letter == T),
            ) else {
                continue;
            };
            let own = sections.get(section).map(|section| section.tool);
            let tool = number_of(word);
            if self.changes.contains_key(&number) || tool == own {
                continue;
            }
            let Some(tool) = tool else { return (Vec::new(), Some(stays(loaded, start))) };
            calls.push(EarlyCall { section, tool, value: digits(&place, word, loaded) });
        }
        let next = |section: usize| sections.get(section + 1).or(sections.first());
        let calls_next = |call: &EarlyCall| next(call.section).is_some_and(|next| next.tool == call.tool);
        // After the last section a tool may be called that no section uses.
        calls.retain(|call| call.section + 1 < sections.len() || calls_next(call));
        match calls.iter().find(|call| !calls_next(call)) {
            Some(other) => (Vec::new(), Some(stays(loaded, other.value.start))),
            None => (calls, None),
        }
    }
}

fn stays(loaded: &Loaded<'_>, at: u32) -> String {
    format!(
        "`T` words that call a tool early stay as they are: the one in line {} does not name the tool of the next section",
        loaded.line_number(at)
    )
}

/// Bytes of the digits of a word.
fn digits(place: &Place, word: &Word, loaded: &Loaded<'_>) -> Range<u32> {
    let range = Sheet::range(place, word);
    let digits = loaded.slice(range.clone()).trim_start_matches(|c: char| !c.is_ascii_digit());
    range.end - digits.len() as u32..range.end
}

/// Moves the text of a section, with the words that are to be written otherwise.
fn put(
    sheet: &mut Sheet<'_, '_>,
    sections: &[Section],
    from: usize,
    to: usize,
    words: &[(Range<u32>, String)],
) {
    let (Some(moved), Some(target)) = (sections.get(from), sections.get(to)) else { return };
    let range = moved.bytes.start as usize..moved.bytes.end as usize;
    let mut text = sheet.loaded.text().get(range).unwrap_or_default().to_owned();
    for (range, word) in words.iter().rev() {
        if moved.bytes.contains(&range.start) {
            let at = (range.start - moved.bytes.start) as usize;
            text.replace_range(at..at + range.len(), word);
        } else {
            sheet.replace(range.clone(), word.clone());
        }
    }
    sheet.remove(moved.bytes.clone());
    sheet.insert(if to > from { target.bytes.end } else { target.bytes.start }, text);
}

/// What the early calls become in another order: each names the tool of the section that follows its own.
fn following(sections: &[Section], order: &[usize], calls: &[EarlyCall]) -> Vec<(Range<u32>, String)> {
    let next = |section: usize| {
        let place = order.iter().position(|at| *at == section)?;
        let next = order.get(place + 1).or(order.first())?;
        sections.get(*next)
    };
    let word = |call: &EarlyCall| {
        let digits = call.value.len();
        Some((call.value.clone(), format!("{:0digits$}", next(call.section)?.tool)))
    };
    calls.iter().filter_map(word).collect()
}
