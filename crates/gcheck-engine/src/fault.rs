//! What stops a run: typed, without words for people.
//!
//! Knows: every way in which a block cannot be executed. Must not know: messages, severities, which rule reports what.

use gcheck_controls::{CodeIx, Letter};

/// Why an expression has no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ValueFault {
    /// Division by zero.
    DivisionByZero,
    /// `SQRT` of a negative number.
    NegativeRoot,
    /// `LN` of zero or a negative number.
    LogarithmOfNonPositive,
    /// `ASIN` or `ACOS` outside −1 to 1.
    ArcFunctionRange,
    /// A negative number to a power that is not whole.
    NegativePower,
    /// The result is no number or too large.
    NotFinite,
    /// The expression is not well formed.
    Malformed,
    /// The function does not exist on this control, or not with so many arguments.
    NoSuchFunction,
}

/// Why a block cannot be executed.
#[derive(Debug, Clone, PartialEq)]
pub enum Fault {
    /// An expression has no value.
    Value(ValueFault),
    /// A condition, repeat count or jump target depends on something that is not known.
    Undecidable,
    /// A named parameter that was never set is read.
    UnsetParameter,
    /// A variable that programs may not write is written.
    ReadOnlyVariable(u32),
    /// A variable's number is no whole number in the control's range.
    VariableNumber,
    /// A word has no value.
    MissingValue(Letter),
    /// A word that must stand does not.
    MissingWord(Letter),
    /// A word's value is outside what the code takes.
    WordRange(Letter),
    /// A code that the control does not have.
    UnknownCode,
    /// A code cannot be carried out in the present state; the second is the mode in the way.
    NotNow(CodeIx, Option<CodeIx>),
    /// A form of text that the control does not read.
    Malformed,
    /// Two codes of a group in one block, or two that use the same words.
    Conflict,
    /// An address stands twice.
    WordTwice(Letter),
    /// A word that no code of the block reads.
    UnreadWord(Letter),
    /// A word where it cannot stand.
    Misplaced(Letter),
    /// More M codes than a block may have.
    TooManyCodes,
    /// More characters than a line may have.
    LineTooLong,
    /// A curve with fewer control points than its order needs.
    TooFewPoints,

    /// A cut without feed.
    NoFeed,
    /// Inverse-time feed without `F` in the block.
    NoInverseTimeFeed,
    /// A cut or cycle that needs a turning spindle.
    SpindleStopped,
    /// The spindle turns the wrong way.
    SpindleDirection,
    /// An axis word for an axis that the machine does not have.
    NoSuchAxis(Letter),
    /// Axis words without a motion mode, or with `G80`.
    NoMotionMode,
    /// A motion code without the axis words it needs.
    NoAxisWords,
    /// An arc: see [`ArcFault`].
    Arc(ArcFault),
    /// A chamfer or rounding of a corner: see [`CornerFault`].
    Corner(CornerFault),
    /// A canned cycle: see [`CycleFault`].
    Cycle(CycleFault),
    /// Cutter compensation: see [`CompensationFault`].
    Compensation(CompensationFault),
    /// A tool that is not in the tool table.
    NoSuchTool(u32),
    /// A tool change without a selected tool.
    NoToolSelected,
    /// A probing move that cannot start.
    Probe,
    /// A dwell without time.
    NoDwellTime,
    /// A lathe profile cycle: its profile is not found or not usable.
    Profile,
    /// A value outside the machine's travel.
    OverTravel(Letter),
    /// Restores modes that were never saved.
    NoSavedModes,

    /// A jump to a sequence number that the program does not have.
    NoSuchLabel(u32),
    /// A jump to a number that no block can have: below zero, or too large.
    JumpTarget(f64),
    /// A call of a program that is not found.
    NoSuchProgram,
    /// Calls nest too deep.
    TooDeep,
    /// A loop's other end is missing, or a jump leads into one.
    LoopMismatch,
    /// `M99` where it cannot stand.
    StrayReturn,
    /// The program's text ends without an end of the program.
    NoProgramEnd,
    /// `#3000`: the program raises an alarm itself.
    Alarm(i64),
}

/// Why a corner cannot be chamfered or rounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CornerFault {
    /// No cut in the plane comes after it, or none that can end it.
    NoCutAfter,
    /// A rapid move comes after it.
    RapidAfter,
    /// The cut after it goes on in the same direction.
    NoTurn,
    /// It takes more of one of the two cuts than there is.
    TooLong {
        /// Millimetres from the corner to where it begins; infinite where the second cut goes straight back.
        needed: f64,
        /// Millimetres of the shorter of the two cuts.
        available: f64,
    },
}

/// Why an arc cannot be cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ArcFault {
    /// Neither centre nor radius.
    NoCentre,
    /// Centre and radius.
    CentreAndRadius,
    /// A word of another plane.
    WrongPlane(Letter),
    /// The radius is zero.
    ZeroRadius,
    /// Half the chord (mm) is longer than the radius (mm).
    RadiusTooSmall {
        /// Millimetres.
        half_chord: f64,
        /// Millimetres.
        radius: f64,
    },
    /// Start and end are not on one circle (radii in mm).
    OffCircle {
        /// Millimetres.
        start: f64,
        /// Millimetres.
        end: f64,
    },
    /// A full circle by radius.
    FullCircleByRadius,
    /// `P` is no whole number of turns.
    Turns,
}

/// Why a canned cycle cannot run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CycleFault {
    /// A word that the cycle needs.
    Missing(Letter),
    /// `R` below `Z`.
    RBelowBottom,
    /// A word that must be positive.
    NotPositive(Letter),
    /// A distance or an angle of a pattern that is zero, so that all its holes would lie on each other.
    Zero(Letter),
    /// `L0`.
    ZeroRepeats,
    /// Rotary words.
    Rotary,
    /// Inverse-time feed.
    InverseTime,
    /// Cutter compensation is on.
    Compensated,
    /// A plane in which the cycle does not work.
    Plane,
    /// Words that contradict each other.
    Geometry,
    /// A pocket whose outline does not end where its first move leads, by this much (mm).
    OutlineOpen(f64),
    /// A pocket whose outline has no piece behind the move that leads to it.
    OutlineEmpty,
    /// A pocket whose start hole lies outside its outline.
    StartOutside,
    /// A pocket whose tool is larger than an arc that it must cut from inside.
    ArcBelowTool {
        /// Radius of the smallest such arc, mm.
        arc: f64,
        /// Radius of the tool, mm.
        tool: f64,
    },
}

/// Why compensation cannot go on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CompensationFault {
    /// The entry move is shorter than the tool's radius (mm).
    EntryTooShort {
        /// Millimetres.
        needed: f64,
        /// Millimetres.
        got: f64,
    },
    /// Begins on an arc.
    EntryIsArc,
    /// Ends on an arc.
    ExitIsArc,
    /// The tool does not fit.
    Gouge,
    /// A plane in which it does not work.
    Plane,
    /// Something that cannot be done while it is on.
    NotWhileOn,
    /// It is on already.
    AlreadyOn,
}
