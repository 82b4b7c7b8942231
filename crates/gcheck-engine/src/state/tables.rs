//! The control's tables: work offsets, reference positions, tools.
//!
//! Knows: their entries by number, which of them may have been written without anybody knowing which. Must not know: the codes
//! that write them.

use gcheck_geometry::Mm;

use crate::eval::value::Truth;
use crate::lattice::{Flat, Lattice, May, lattice, merged};
use crate::machine::{self, Machine, WorkOffset};
use crate::position::{Axis, Position};

/// Work offsets, reference points, tools.
#[derive(Debug, Clone)]
pub struct Tables {
    /// By number; a number that is not there is `other_offset`.
    offsets: Vec<(u16, WorkOffset)>,
    /// Offsets that are not in the list.
    other_offset: WorkOffset,
    pub(crate) references: [Position; 4],
    /// In the order of their numbers.
    tools: Vec<Row>,
    /// Tools that are not listed may exist all the same.
    partial: May,
}

/// A line of the tool table.
#[derive(Debug, Clone)]
struct Row {
    number: u32,
    tool: ToolData,
    /// It is in the table.
    listed: Truth,
}

lattice! {
    /// What a tool table says of a tool.
    #[derive(Debug, Clone, Copy)]
    pub struct ToolData {
        /// Offsets by axis: the length on Z.
        pub offset: Position,
        /// Diameter; NaN unknown.
        pub diameter: Mm,
        /// Corner or nose radius; NaN unknown.
        pub corner_radius: Mm,
        /// Wear of the length along Z, and of the diameter, millimetres: they count with them. What nobody wrote is taken to be
        /// none.
        pub(crate) wear: [f64; 2],
        /// Lathe tool angles.
        pub(crate) angles: [f64; 2],
        /// Lathe orientation, 0 to 9.
        pub(crate) orientation: Flat<u8>,
    }
}

impl ToolData {
    /// Nothing is known of it.
    pub(crate) const UNKNOWN: Self = Self {
        offset: Position::UNKNOWN,
        diameter: Mm::UNKNOWN,
        corner_radius: Mm::UNKNOWN,
        wear: [0.0; 2],
        angles: [f64::NAN; 2],
        orientation: Flat::Unknown,
    };

    /// It may be anything, and somebody may have written its wear.
    pub(crate) const ANYTHING: Self = Self { wear: [f64::NAN; 2], ..Self::UNKNOWN };

    /// A tool without length and size.
    pub(crate) const NOTHING: Self = Self {
        offset: Position::ZERO,
        diameter: Mm(0.0),
        corner_radius: Mm::UNKNOWN,
        wear: [0.0; 2],
        angles: [0.0; 2],
        orientation: Flat::Known(0),
    };

    /// Offsets by axis as they count: the length with its wear.
    pub fn length(&self) -> Position {
        let [wear, _] = self.wear;
        let mut length = self.offset;
        if wear != 0.0 {
            length.set(Axis::Z, length.raw(Axis::Z) + wear);
        }
        length
    }

    /// The diameter as it counts: with its wear.
    pub fn size(&self) -> Mm {
        let [_, wear] = self.wear;
        self.diameter + Mm(wear)
    }
}

impl From<&machine::Tool> for ToolData {
    fn from(tool: &machine::Tool) -> Self {
        let machine::Tool { pocket: _, offset, diameter, corner_radius, angles, orientation } = *tool;
        let corner_radius = if corner_radius.is_known() { corner_radius } else { Mm::UNKNOWN };
        let wear = [0.0; 2];
        Self { offset, diameter, corner_radius, wear, angles, orientation: Flat::Known(orientation) }
    }
}

impl Tables {
    /// The tables of a machine as a program finds them. The first reference position may be the machine's zero.
    pub(crate) fn of(machine: &Machine, reference_at_zero: bool) -> Self {
        let mut references = [if machine.fresh { Position::ZERO } else { Position::UNKNOWN }; 4];
        if reference_at_zero {
            references[0] = Position::ZERO;
        }
        Self {
            offsets: machine.offsets.iter().map(|(number, offset)| (*number, *offset)).collect(),
            other_offset: if machine.fresh { WorkOffset::ZERO } else { WorkOffset::UNTOLD },
            references,
            tools: machine
                .tools
                .iter()
                .map(|(number, tool)| Row { number: *number, tool: tool.into(), listed: Truth::True })
                .collect(),
            partial: May(!machine.tool_table_is_complete),
        }
    }

    /// A work offset.
    pub fn offset(&self, number: u16) -> WorkOffset {
        self.offsets.iter().find(|(n, _)| *n == number).map_or(self.other_offset, |(_, offset)| *offset)
    }

    /// Writes a work offset.
    pub(crate) fn set_offset(&mut self, number: u16, offset: WorkOffset) {
        match self.offsets.binary_search_by_key(&number, |(n, _)| *n) {
            Ok(at) => {
                if let Some((_, old)) = self.offsets.get_mut(at) {
                    *old = offset;
                }
            }
            Err(at) => self.offsets.insert(at, (number, offset)),
        }
    }

    /// Any origin may have been written; any rotation, too, where the block names one.
    pub(crate) fn forget_offsets(&mut self, turned: bool) {
        let listed = self.offsets.iter_mut().map(|(_, offset)| offset);
        for offset in listed.chain([&mut self.other_offset]) {
            offset.origin = Position::UNKNOWN;
            if turned {
                offset.rotation = f64::NAN;
            }
        }
    }

    /// A tool that the table lists, or may list: of that nothing is known.
    pub fn tool(&self, number: u32) -> Option<&ToolData> {
        self.row(number).map(|row| &row.tool)
    }

    /// A tool's entry, made when it is not there.
    pub(crate) fn tool_mut(&mut self, number: u32) -> &mut ToolData {
        let at = match self.tools.binary_search_by_key(&number, |row| row.number) {
            Ok(at) => at,
            Err(at) => {
                let tool = self.unlisted();
                self.tools.insert(at, Row { number, tool, listed: Truth::True });
                at
            }
        };
        #[expect(clippy::indexing_slicing, reason = "`at` was found or inserted above")]
        let row = &mut self.tools[at];
        row.listed = Truth::True;
        &mut row.tool
    }

    /// The tools that the table lists, or may list, with their numbers.
    pub(crate) fn tools_mut(&mut self) -> impl Iterator<Item = (u32, &mut ToolData)> {
        self.tools.iter_mut().map(|row| (row.number, &mut row.tool))
    }

    /// A tool of unknown number was written, and may not have been there before.
    pub(crate) fn forget_tools(&mut self) {
        for (_, tool) in self.tools_mut() {
            *tool = ToolData::ANYTHING;
        }
        self.partial = May(true);
    }

    /// The line of a tool, 1 the first; 0 when the table does not list it.
    pub(crate) fn row_of(&self, number: u32) -> u32 {
        self.tools.iter().position(|row| row.number == number).map_or(0, |row| row as u32 + 1)
    }

    /// The number in the first line.
    pub(crate) fn first_tool(&self) -> Option<u32> {
        self.tools.first().map(|row| row.number)
    }

    /// Is it certain that the tool does not exist?
    pub(crate) fn lacks_tool(&self, number: u32) -> bool {
        !self.partial.0 && self.row(number).is_none()
    }

    /// Is this certainly the whole table of tools?
    pub(crate) fn is_complete(&self) -> bool {
        !self.partial.0
    }

    fn row(&self, number: u32) -> Option<&Row> {
        let at = self.tools.binary_search_by_key(&number, |row| row.number).ok()?;
        self.tools.get(at)
    }

    /// What a tool is that the table does not list.
    fn unlisted(&self) -> ToolData {
        if self.partial.0 { ToolData::UNKNOWN } else { ToolData::NOTHING }
    }

    /// A line of the table, whether it is there or not.
    fn line(&self, number: u32) -> Row {
        self.row(number).cloned().unwrap_or_else(|| Row {
            number,
            tool: self.unlisted(),
            listed: if self.partial.0 { Truth::Unknown } else { Truth::False },
        })
    }

    /// Numbers of work offsets, and of tools, that this or the other lists.
    fn numbers(&self, other: &Self) -> (Vec<u16>, Vec<u32>) {
        let mut offsets: Vec<u16> = self.offsets.iter().chain(&other.offsets).map(|(n, _)| *n).collect();
        offsets.sort_unstable();
        offsets.dedup();
        let mut tools: Vec<u32> = self.tools.iter().chain(&other.tools).map(|row| row.number).collect();
        tools.sort_unstable();
        tools.dedup();
        (offsets, tools)
    }
}

impl Lattice for Tables {
    fn join(&self, other: &Self) -> Self {
        let Self { offsets: _, other_offset, references, tools: _, partial } = self;
        let (offsets, tools) = self.numbers(other);
        let row = |number: u32| {
            let (a, b) = (self.line(number), other.line(number));
            let either = a.listed.join(&b.listed);
            // A tool that is there on one path only may be anything.
            let joined = if either == Truth::Unknown { ToolData::ANYTHING } else { a.tool.join(&b.tool) };
            Row {
                number,
                tool: merged!(Row.tool, a.tool, joined),
                listed: merged!(Row.listed, a.listed, either),
            }
        };
        let all_offsets: Vec<(u16, WorkOffset)> =
            offsets.into_iter().map(|n| (n, self.offset(n).join(&other.offset(n)))).collect();
        let all_tools: Vec<Row> = tools.into_iter().map(row).collect();
        Self {
            offsets: merged!(Tables.offsets, self.offsets, all_offsets),
            other_offset: merged!(
                Tables.other_offset,
                self.other_offset,
                other_offset.join(&other.other_offset)
            ),
            references: merged!(Tables.references, self.references, references.join(&other.references)),
            tools: merged!(Tables.tools, self.tools, all_tools),
            partial: merged!(Tables.partial, self.partial, partial.join(&other.partial)),
        }
    }

    fn widen(&self, newer: &Self) -> Self {
        self.join(newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        let Self { offsets: _, other_offset, references, tools: _, partial } = self;
        let (offsets, tools) = self.numbers(inner);
        offsets.into_iter().all(|number| self.offset(number).covers(&inner.offset(number)))
            && other_offset.covers(&inner.other_offset)
            && references.covers(&inner.references)
            && tools.into_iter().all(|number| {
                let (outer, inner) = (self.line(number), inner.line(number));
                outer.listed.covers(&inner.listed) && outer.tool.covers(&inner.tool)
            })
            && partial.covers(&inner.partial)
    }

    fn same(&self, other: &Self) -> bool {
        let Self { offsets, other_offset, references, tools, partial } = self;
        let same_offset = |(a, b): (&(u16, WorkOffset), &(u16, WorkOffset))| a.0 == b.0 && a.1.same(&b.1);
        let same_tool =
            |(a, b): (&Row, &Row)| (a.number, a.listed) == (b.number, b.listed) && a.tool.same(&b.tool);
        offsets.len() == other.offsets.len()
            && offsets.iter().zip(&other.offsets).all(same_offset)
            && other_offset.same(&other.other_offset)
            && references.same(&other.references)
            && tools.len() == other.tools.len()
            && tools.iter().zip(&other.tools).all(same_tool)
            && partial.same(&other.partial)
    }

    fn uncovered(&self, inner: &Self) -> String {
        let (offsets, tools) = self.numbers(inner);
        let offset = offsets.into_iter().find(|number| !self.offset(*number).covers(&inner.offset(*number)));
        if let Some(number) = offset {
            return format!(".offset {number}{}", self.offset(number).uncovered(&inner.offset(number)));
        }
        let lines = tools.into_iter().map(|number| (self.line(number), inner.line(number)));
        let mut gaps = lines.filter(|(a, b)| !a.listed.covers(&b.listed) || !a.tool.covers(&b.tool));
        match gaps.next() {
            Some((a, b)) => {
                let (outer, inner) = (a.listed, b.listed);
                format!(".tool {}: listed {outer:?} / {inner:?} {}", a.number, a.tool.uncovered(&b.tool))
            }
            None => String::new(),
        }
    }
}

impl PartialEq for Tables {
    fn eq(&self, other: &Self) -> bool {
        self.same(other)
    }
}
