//! Rules of the path tier: what they may watch, and what they are shown.
//!
//! Knows: the calls that a rule gets while all paths of a program are executed. Must not know: any rule, how paths are found.

use gcheck_engine::{At, Ending, Event, Fault};

use crate::{FinishCx, FollowedCx, MakeShared, PathCx, Remembers, Report, Uses};

bitflags::bitflags! {
    /// What a rule of the path tier wants to see. A rule that watches little costs little.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct Watch: u32 {
        /// [`PathRule::block`]: blocks with a code that does more than choose a motion (`G0` to `G3`), with `T`, `H` or `D`,
        /// or with `F` or `S` and no code, before they are executed.
        const BLOCKS = 1;
        /// [`PathRule::moved`]: every move.
        const MOVES = Self::FEED_MOVES.bits()
            | Self::RAPID_MOVES.bits()
            | Self::STROKES.bits()
            | Self::ARCS.bits()
            | Self::CURVES.bits();
        /// [`PathRule::moved`]: straight moves that the program itself makes, but for rapid ones. Large programs have millions.
        const FEED_MOVES = 1 << 1;
        /// [`PathRule::moved`]: straight moves of a canned cycle, or of another operation that expands to several moves.
        const STROKES = Self::FEED_STROKES.bits() | Self::RAPID_STROKES.bits();
        /// [`PathRule::cut`]: a cutting move, the first one after something else happened than a move or a dwell.
        const CUTS = 1 << 2;
        /// [`PathRule::changed`]: every event that is not a move, except the path mode and [codes that set a mode](Self::MODES).
        const CHANGES = 1 << 3;
        /// [`PathRule::ended`].
        const ENDS = 1 << 4;
        /// [`PathRule::fault`].
        const FAULTS = 1 << 5;
        /// [`PathRule::vacant_read`].
        const READS = 1 << 6;
        /// [`PathRule::endless`].
        const ENDLESS = 1 << 7;
        /// [`PathRule::finish`].
        const FINISH = 1 << 8;
        /// [`PathRule::rapid`]: rapid moves.
        const RAPIDS = 1 << 9;
        /// [`PathRule::block`]: blocks with a code, a statement, an expression, `F`, `S`, `T`, `H`, `D` or a word that no code of
        /// the block reads, before they are executed.
        const ALL_BLOCKS = 1 << 10;
        /// [`PathRule::moved`]: arcs alone.
        const ARCS = 1 << 11;
        /// [`PathRule::block`]: blocks with a computed word whose value is certain, before they are executed.
        const COMPUTED = 1 << 12;
        /// [`PathRule::block`]: of those the blocks that so have other codes or addresses than as they are written.
        const COMPUTED_CODES = 1 << 13;
        /// [`PathRule::followed`].
        const FOLLOWED = 1 << 14;
        /// [`PathRule::ended_elsewhere`].
        const ENDS_ELSEWHERE = 1 << 15;
        /// [`PathRule::moved`]: rapid moves that the program itself makes.
        const RAPID_MOVES = 1 << 16;
        /// [`PathRule::moved`]: curves that are not arcs.
        const CURVES = 1 << 17;
        /// [`PathRule::moved`]: strokes that are not rapid.
        const FEED_STROKES = 1 << 18;
        /// [`PathRule::moved`]: rapid strokes.
        const RAPID_STROKES = 1 << 19;
        /// [`PathRule::changed`]: codes that set a mode. Some programs have one in every block.
        const MODES = 1 << 20;
    }
}

/// A rule of the path tier. One is made for every file, so that it may remember what it saw.
pub trait PathRule {
    /// What the rule remembers. A rule that does not say what it has fields for is asked to watch all from the start after
    /// every edit, and so are the others.
    fn memory(&mut self) -> Remembers<'_> {
        if size_of_val(self) == 0 { Remembers::Nothing } else { Remembers::Unknown }
    }

    /// What the rule remembers together with others; it asks for that by [`PathCx::shared`].
    fn shares(&self) -> Option<MakeShared> {
        None
    }

    /// Can the rule have anything to say of a program? Asked once; a rule that says no watches nothing. By what the program
    /// uses, most programs spare most rules.
    fn concerns(&self, program: &Uses<'_>) -> bool {
        let _ = program;
        true
    }

    /// Is what the rule finds worth saying when it holds on one way of a condition only? An alarm that a program raises on
    /// some path is what alarms are for.
    fn counts_on_some_path(&self) -> bool {
        true
    }

    /// A block is about to be executed.
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let _ = (cx, report);
    }

    /// The axes moved; the state is that after the move.
    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let _ = (cx, event, report);
    }

    /// The axes moved at rapid rate.
    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let _ = (cx, event, report);
    }

    /// A cutting move, the first since something changed.
    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let _ = (cx, event, report);
    }

    /// An event that is not a move.
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let _ = (cx, event, report);
    }

    /// The program ends.
    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        let _ = (cx, ending, report);
    }

    /// The job ends in a program of another file. What is found belongs to the call in this file.
    fn ended_elsewhere(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        let _ = (cx, ending, report);
    }

    /// The control would stop with an alarm.
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let _ = (cx, fault, report);
    }

    /// A variable is read that was never set.
    fn vacant_read(&mut self, cx: &PathCx<'_>, variable: u32, report: &mut Report<'_>) {
        let _ = (cx, variable, report);
    }

    /// The block leads back to `head` in the state that was met there before.
    fn endless(&mut self, cx: &PathCx<'_>, head: At, report: &mut Report<'_>) {
        let _ = (cx, head, report);
    }

    /// All paths were seen with one position of the block delete switch: what the rule weighed on the way is told now. A finding
    /// that only some positions bring names them.
    fn followed(&mut self, cx: &FollowedCx<'_>, report: &mut Report<'_>) {
        let _ = (cx, report);
    }

    /// All paths were seen with every position of the block delete switch. What the rule remembers is of the last one: this
    /// is for what the results say.
    fn finish(&mut self, cx: &FinishCx<'_>, report: &mut Report<'_>) {
        let _ = (cx, report);
    }
}
