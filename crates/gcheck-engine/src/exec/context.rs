//! What an execution holds beside the state: the run, and the block under way.
//!
//! Knows: what the parts of a step hand to each other. Must not know: what any of them does.

use std::rc::Rc;

use gcheck_controls::Unpointed;
use gcheck_program::{OKeyword, OLabel, Place};
use rustc_hash::FxHashMap;

use crate::assumption::Assumptions;
use crate::cycles::Stroke;
use crate::eval::value::Domain;
use crate::eval::words::BlockWords;
use crate::event::Event;
use crate::fault::Fault;
use crate::lattice::Perhaps;
use crate::machine::Machine;
use crate::model::Model;
use crate::observer::Observer;
use crate::origin::{At, Origin};
use crate::position::Position;
use crate::program::{Program, ProgramFile};
use crate::state::{BarCommand, FrameKind, NameId, State};

/// Switches of the operator's panel, and how far a run goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(clippy::struct_excessive_bools, reason = "independent switches")]
pub struct Options {
    /// Block delete by level 1 to 9: a bit that is set skips the level's blocks. Bit 0 stands for a plain `/`.
    pub skip: u16,
    /// `M1` stops.
    pub optional_stop: bool,
    /// A run goes on after a fault as the programmer would after correcting it, and where it cannot decide a condition.
    pub past_alarms: bool,
    /// What nobody can know is taken as it most likely is, for people who look at a path: a program that is not here leaves
    /// everything as it was, and a probe touches at its target.
    pub assumes: bool,
    /// A program that is not here leaves what this one has set as it was: modes, the tool with its offsets, the spindle, the
    /// coolant, the feed. Where the axes are, and what variables hold, stays unknown after it.
    pub keeps_what_was_set: bool,
}

impl Options {
    /// Nothing is skipped.
    pub const NONE: Self =
        Self { skip: 0, optional_stop: false, past_alarms: false, assumes: false, keeps_what_was_set: false };
    /// A path to be looked at: past alarms, with assumptions for what nobody can know.
    pub const PICTURE: Self = Self { past_alarms: true, assumes: true, ..Self::NONE };
    /// Every `/` block is skipped.
    pub const SKIP_ALL: Self = Self { skip: u16::MAX, ..Self::NONE };

    pub(crate) fn skips(self, level: u8) -> bool {
        level > 0 && self.skip & (1 << (level - 1).min(15)) != 0
    }
}

/// What comes after a block.
#[derive(Debug)]
pub(crate) enum Outcome<D: Domain> {
    /// The next block in text order.
    Next,
    /// Another block.
    Jump(At),
    /// Any of these: a condition or target is not known.
    Fork(Vec<(At, State<D>)>),
    /// The program is over.
    End(Ending),
    /// The block cannot be executed.
    Fault(Fault),
}

/// How a program came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Ending {
    /// `M2` or `M30`.
    Program,
    /// `M99` in the main program: it would start again.
    Restart,
    /// A closing `%`.
    Tape,
    /// The text ended without an end of the program.
    Text,
    /// `#3000`.
    Alarm(i64),
    /// The bar feeder has no bar left, or has made as many parts as it was told to.
    BarsUsed,
}

pub(crate) type Step<T = ()> = Result<T, Fault>;

/// Executes blocks. Holds what does not belong to the state: the program, the control, the machine, who watches.
#[expect(clippy::struct_excessive_bools, reason = "independent facts of the block under way and of the run")]
pub(crate) struct Executor<'a, 'p, D: Domain, O: Observer<D>> {
    pub(crate) program: &'a Program<'p>,
    pub(crate) model: &'a Model<'a>,
    pub(crate) machine: &'a Machine,
    pub(crate) options: Options,
    pub(crate) observer: O,
    pub(crate) assumptions: Assumptions,
    /// How a number without decimal point counts: settled once.
    pub(crate) unpointed: Unpointed,
    /// A setting decides that, and its value is not given.
    pub(crate) unpointed_is_open: bool,
    pub(crate) stack: Vec<D::Value>,
    pub(crate) words: BlockWords<D>,
    pub(crate) cursor: Option<Cursor<'p>>,
    /// The block under way.
    pub(crate) origin: Origin,
    /// Where to go when every phase of the block is done.
    pub(crate) flow: Option<Flow<D>>,
    /// `G53`, `G9` and the like: what holds for this block only.
    pub(crate) machine_coordinates: bool,
    /// Goes on after what the control refuses, as an analysis does that looks for more than one mistake.
    pub(crate) lenient: bool,
    /// What was refused in the block under way.
    pub(crate) refused: Option<Fault>,
    /// What went before the block under way, where execution goes on past alarms.
    pub(crate) before: Option<Before>,
    /// Moves given out so far, but those of compensated paths.
    pub(crate) moves: u64,
    /// The line to where a refused move leads, to be given out when the observer has been told of the alarm.
    pub(crate) bridge: Option<Event>,
    /// The state in which a part of the block was refused first, where execution goes on past alarms.
    pub(crate) at_fault: Option<Box<State<D>>>,
    /// What was refused in a block that leads elsewhere all the same, where execution goes on past alarms.
    pub(crate) refused_in_passing: Option<Fault>,
    /// The operation under way passes its points exactly though blending is on.
    pub(crate) passes_exactly: bool,
    /// A code of the block made the control forget the rest of it.
    pub(crate) rest_is_lost: bool,
    /// Subroutines passed over, and whether another is defined inside.
    pub(crate) nested: FxHashMap<At, bool>,
    /// Blocks that may open lines of data, and whether a later one ends them.
    pub(crate) rows_end: FxHashMap<At, bool>,
    /// The state at the start of the main program, once it was asked for.
    pub(crate) start: Option<Box<State<D>>>,
    /// By file, subroutine and label: the O-word block that opened a structure first. Of a subroutine's own label no
    /// subroutine is told.
    #[expect(
        clippy::option_option,
        reason = "no subroutine is one thing, the one without a block of its own another"
    )]
    pub(crate) labels_defined: FxHashMap<(u32, Option<Option<u32>>, OLabel), u32>,
    /// Labels of O-words, by file, where some are computed.
    pub(crate) o_labels: FxHashMap<u32, Rc<OLabels>>,
    /// Names that assignments of the block brought into being, each with where its assignment begins in the chunk.
    pub(crate) created: Vec<(NameId, u32)>,
    /// Room for the strokes of a hole.
    pub(crate) stroke_buffer: Vec<Stroke>,
    /// Assignments that wait for the end of the block.
    pub(crate) pending: Vec<(Assignee, D::Value)>,
    /// Words of the block that begin before this byte of its chunk have acted; `None` until some may have.
    pub(crate) acted_to: Option<u32>,
    /// The words that are read belong to a block after the one under way.
    pub(crate) looks_ahead: bool,
    /// Variables that were written, and whether the control lets programs do that.
    pub(crate) writable: FxHashMap<u32, bool>,
    /// Bar feeds so far.
    pub(crate) bar_feeds: u64,
    /// Events that were given out so far, those that compensation holds back among them.
    pub(crate) events: u64,
    /// Strokes of cycles that were given out so far.
    pub(crate) strokes_given: u64,
    /// Those that were given out before the block under way.
    pub(crate) strokes_before: u64,
}

/// A way on that a code asked for.
#[derive(Debug, Clone)]
pub(crate) enum Flow<D: Domain> {
    Jump(At),
    Call(Callee<D>),
    Return {
        label: Option<D::Value>,
    },
    /// To the macro that is called after every move.
    ModalCall,
    /// Here or on, as an input decides.
    MayJump(At),
    End(Ending),
}

/// The chunk that execution is in, so that the next block costs no look-up.
#[derive(Clone)]
pub(crate) struct Cursor<'a> {
    pub(crate) file_index: u32,
    pub(crate) file: Rc<ProgramFile<'a>>,
    pub(crate) place: Place,
    /// Number of the chunk's first block in the file.
    pub(crate) first: u32,
}

/// A program about to be entered.
#[derive(Debug, Clone)]
pub(crate) struct Callee<D: Domain> {
    pub(crate) kind: FrameKind,
    pub(crate) target: At,
    /// Further turns to come; `None` unknown.
    pub(crate) repeats: Option<u32>,
    /// The unknown number of turns may be none.
    pub(crate) may_be_skipped: bool,
    pub(crate) arguments: Vec<(u32, D::Value)>,
    pub(crate) bar_feed: Perhaps<Rc<BarCommand>>,
}

/// The labels of the O-words of a file that open, go on with or close a structure.
#[derive(Debug, Default)]
pub(crate) struct OLabels {
    /// Blocks by their label, in text order.
    pub(crate) written: FxHashMap<OLabel, Vec<(u32, OKeyword)>>,
    /// Blocks whose label is computed, in text order.
    pub(crate) computed: Vec<(u32, OKeyword)>,
}

/// What went before a block that may be refused.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Before {
    /// Where the axes were.
    pub(crate) actual: Position,
    /// Moves given out until then.
    pub(crate) moves: u64,
}

/// What an assignment writes to.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Assignee {
    Number(u32),
    Name(NameId),
    /// A variable of unknown number.
    Anywhere,
}

/// A whole number, or a word whose value nobody knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Count {
    Known(u32),
    Unknown,
}
