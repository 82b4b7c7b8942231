//! What a result rests on beside the program and the configuration.
//!
//! Knows: kinds of assumptions, typed. Must not know: their wording, or the keys of a configuration that would settle them.

use std::collections::BTreeSet;

use gcheck_controls::CodeIx;

use crate::model::Role;
use crate::position::Axis;

/// What paths may differ in when they become one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Unsettled {
    /// Whether a macro is called after every move, and which.
    ModalCall,
    /// Whether cutter compensation is on.
    Compensation,
    /// Which control points a curve has so far.
    Curve,
    /// Which modes were saved, and whether any were.
    SavedModes,
    /// Whether a parameter was ever set.
    Parameter,
    /// Which program called the one under way.
    Caller,
    /// Whether a bar feed follows the program under way.
    BarFeed,
}

/// Something assumed, or left unknown.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Assumption {
    /// A mode at the start is the control's power-on default.
    StartMode(Role, CodeIx),
    /// The position at the start is not known.
    StartPosition,
    /// A work offset's value is not known.
    WorkOffset(u16),
    /// A tool length is not known.
    ToolLength(u32),
    /// A cutter's size is not known.
    ToolRadius(u32),
    /// A reference position is not known.
    ReferencePosition(u8),
    /// A setting has the value that the knowledge base assumes.
    Setting(String),
    /// Numbers without decimal point count as the knowledge base assumes.
    UnpointedNumbers,
    /// A variable's value at the start is not known.
    Variable(u32),
    /// A program that is called was not found.
    MissingProgram(u32),
    /// A subroutine that is called was not found.
    MissingSubroutine(String),
    /// Blocks with a block delete were executed, or not.
    BlockSkip(bool),
    /// An optional stop was passed over.
    OptionalStop,
    /// A probe was taken to have touched, at an unknown point.
    ProbeTouch,
    /// The machine has all axes that the control may have.
    Axis(Axis),
    /// Which way the two axes of a tilting head turn, and which carries the other.
    HeadKinematics,
    /// The tool is parallel to Z where the rotary axes read zero.
    UprightTool,
    /// No earlier program gave cylinders on a rotary axis a diameter that still counts.
    CylinderDiameter(Axis),
    /// A rotary axis carries cylinders that not all manuals of the control list for it.
    CylinderCarrier(Axis),
    /// A drawing is wrapped from the angle at which the rotary axis stands when it begins.
    CylinderStart(Axis),
    /// The tool stands over the start hole of a pocket, at the rapid level, when the control has cleared it.
    PocketEnd,
    /// The bar is long enough for the next part.
    BarLength,
    /// The bar is just as long as a part and its clamping, which no manual decides: a new one is taken.
    BarAtLimit,
    /// A new bar is in the chuck at the start, and the feeder's counters stand at zero.
    NewBar,
    /// Limits of the bar feeder stop it as general knowledge has it.
    BarLimits,
    /// Paths met that differ in something which decides what follows: what depends on it is unknown from there on.
    Unsettled(Unsettled),
    /// More conditions than are followed by themselves: what one of their ways alone sets is unknown where the ways meet.
    PathsJoined,
    /// Nothing is known of a code's effect.
    Code(CodeIx),
    /// The passes of a cycle are not computed: it ends where it should, but what it cuts is in no figure.
    Passes(CodeIx),
}

impl Assumption {
    /// Is something that the machine does in no move of the run: passes of a cycle, a program that is not there, a code?
    pub const fn leaves_moves_out(&self) -> bool {
        matches!(self, Self::Passes(_) | Self::MissingProgram(_) | Self::MissingSubroutine(_) | Self::Code(_))
    }
}

/// What a run rests on so far, and which of it nobody was told of.
#[derive(Debug, Clone, Default)]
pub(crate) struct Assumptions {
    all: BTreeSet<Assumption>,
    /// Those that came since they were told last, each once, in the order in which they came.
    untold: Vec<Assumption>,
    /// A number without decimal point is among them: that is asked for every such number.
    has_unpointed: bool,
}

impl Assumptions {
    pub(crate) fn insert(&mut self, assumption: Assumption) {
        if !self.all.contains(&assumption) {
            self.untold.push(assumption.clone());
            self.all.insert(assumption);
        }
    }

    /// A number without decimal point counts as the knowledge base assumes.
    pub(crate) fn rest_on_unpointed(&mut self) {
        if !self.has_unpointed {
            self.has_unpointed = true;
            self.insert(Assumption::UnpointedNumbers);
        }
    }

    /// Those that came since the last time, in their own order.
    pub(crate) fn take_untold(&mut self) -> Vec<Assumption> {
        // A vector without elements takes no memory: most blocks rest on nothing new.
        let mut untold = std::mem::take(&mut self.untold);
        untold.sort_unstable();
        untold
    }

    pub(crate) fn into_all(self) -> BTreeSet<Assumption> {
        self.all
    }
}

impl Extend<Assumption> for Assumptions {
    fn extend<T: IntoIterator<Item = Assumption>>(&mut self, assumptions: T) {
        for assumption in assumptions {
            self.insert(assumption);
        }
    }
}
