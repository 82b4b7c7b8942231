//! A program as its blocks, with the modes that the text alone gives them.
//!
//! Knows: words by address and code, what is on when the text is read from top to bottom. Must not know: mistakes. Jumps and
//! calls are not followed: what is asked here is where a mistake could be typed, not what it does.

use std::ops::Range;
use std::sync::Arc;

use gcheck_controls::{Control, Effect, Motion};
use gcheck_program::{Dialect, Loaded, StatementKind};

/// A program in which mistakes are to be put.
pub(crate) struct Program {
    /// Name for people, and for choosing places: the file's path below its folder.
    pub(crate) name: String,
    /// The control it is checked for.
    pub(crate) control: String,
    pub(crate) text: String,
    pub(crate) blocks: Vec<Block>,
    /// How the control reads numbers, codes and lines.
    pub(crate) facts: Arc<Control>,
}

/// One block.
pub(crate) struct Block {
    /// Place among the blocks.
    pub(crate) ix: usize,
    /// Bytes of the text, without the end of the line.
    pub(crate) range: Range<usize>,
    pub(crate) words: Vec<Word>,
    pub(crate) statements: Vec<(Range<usize>, StatementKind)>,
    /// Begins with `/`.
    pub(crate) is_skippable: bool,
    /// What is on when it begins.
    pub(crate) before: Modes,
    /// What is on when it ends.
    pub(crate) after: Modes,
}

/// One word.
#[derive(Clone)]
pub(crate) struct Word {
    pub(crate) letter: u8,
    pub(crate) number: Option<f64>,
    /// Written with a decimal point.
    pub(crate) has_point: bool,
    /// What its code does, of a `G` or `M` word that the control knows.
    pub(crate) effect: Option<Effect>,
    pub(crate) range: Range<usize>,
}

/// What is on, read from top to bottom.
#[derive(Clone, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a mode of its own")]
pub(crate) struct Modes {
    /// The kind of motion.
    pub(crate) motion: Option<Effect>,
    pub(crate) is_incremental: bool,
    pub(crate) is_compensating: bool,
    pub(crate) has_length: bool,
    pub(crate) spindle_turns: bool,
    pub(crate) feed: bool,
    pub(crate) tool: Option<f64>,
    /// How many tool changes came before.
    pub(crate) section: usize,
    /// After the end of the main program, or inside a subroutine.
    pub(crate) is_subprogram: bool,
}

impl Program {
    pub(crate) fn read(name: &str, control: &str, text: String) -> Self {
        let facts = gcheck_controls::load(control).unwrap();
        let dialect = Dialect::new(&facts);
        let loaded = Loaded::new(text.as_str(), &dialect, |_, _, _| {});
        let mut modes = Modes::default();
        let blocks = (0..loaded.flow_graph().blocks())
            .filter_map(|number| loaded.place(number, &dialect))
            .map(|place| {
                let absolute = |range: Range<u32>| {
                    (place.base + range.start) as usize..(place.base + range.end) as usize
                };
                let block = place.block();
                let words = place.table.words(block).iter().map(|word| Word {
                    letter: word.letter.ascii(),
                    number: word.number(),
                    has_point: word.shape.point,
                    effect: facts.code_at(word.code).map(gcheck_controls::Code::effect),
                    range: absolute(word.range()),
                });
                let words: Vec<Word> = words.collect();
                let statements: Vec<_> = place
                    .table
                    .statements(place.ix)
                    .map(|s| (absolute(s.range.clone()), s.kind.clone()))
                    .collect();
                let before = modes.clone();
                let codes = place.table.words(block).iter().filter_map(|word| facts.code_at(word.code));
                for code in codes {
                    modes.take(code.effect(), code.motion());
                }
                modes.take_words(&words);
                modes.take_statements(&statements);
                let range = place.range();
                Block {
                    ix: place.ix.index(),
                    range: range.start as usize..range.end as usize,
                    words,
                    statements,
                    is_skippable: block.delete > 0,
                    before,
                    after: modes.clone(),
                }
            })
            .enumerate()
            .map(|(ix, block)| Block { ix, ..block })
            .collect();
        Self { name: name.to_owned(), control: control.to_owned(), text, blocks, facts }
    }

    /// A turning centre, or a control for both that is told to work in ZX.
    pub(crate) fn is_lathe(&self) -> bool {
        let plane = self.blocks.iter().find_map(|block| block.code(&[Effect::PlaneXy, Effect::PlaneZx]));
        self.facts.machine() == gcheck_controls::Machine::Lathe
            || plane.is_some_and(|word| word.effect == Some(Effect::PlaneZx))
    }

    /// It cuts, and ends the job itself.
    pub(crate) fn is_whole(&self) -> bool {
        let ends = [Effect::ProgramEnd, Effect::ProgramEndWithPallet];
        let cuts = |block: &Block| block.moves(&[Effect::Linear]) && !block.before.is_subprogram;
        let is_called =
            self.blocks.iter().find(|block| block.is_plain()).is_some_and(|first| first.before.is_subprogram);
        self.blocks.iter().any(|block| block.code(&ends).is_some())
            && self.blocks.iter().any(cuts)
            && !is_called
    }

    /// A number without a point counts smallest steps.
    pub(crate) fn counts_steps(&self) -> bool {
        self.facts.numbers().unpointed == gcheck_controls::Unpointed::LeastIncrement
    }

    /// The control is one of these, or a mill or lathe of these.
    pub(crate) fn is_for(&self, controls: &[&str]) -> bool {
        controls.iter().any(|name| self.control.starts_with(name))
    }

    pub(crate) fn next(&self, block: &Block) -> Option<&Block> {
        self.blocks.get(block.ix + 1)
    }

    pub(crate) fn previous(&self, block: &Block) -> Option<&Block> {
        self.blocks.get(block.ix.checked_sub(1)?)
    }

    pub(crate) fn behind(&self, block: &Block) -> &[Block] {
        self.blocks.get(block.ix + 1..).unwrap_or_default()
    }

    pub(crate) fn words_of(&self, word: &Word) -> &str {
        &self.text[word.range.clone()]
    }

    pub(crate) fn text_of(&self, block: &Block) -> &str {
        &self.text[block.range.clone()]
    }
}

impl Modes {
    fn take(&mut self, effect: Effect, motion: Motion) {
        if !matches!(motion, Motion::None | Motion::Dwell | Motion::Reference | Motion::Operation) {
            self.motion = Some(effect);
        }
        match effect {
            Effect::CycleCancel => self.motion = None,
            Effect::Absolute => self.is_incremental = false,
            Effect::Incremental => self.is_incremental = true,
            Effect::CompensationOff => self.is_compensating = false,
            Effect::CompensationLeft
            | Effect::CompensationRight
            | Effect::CompensationLeftByDiameter
            | Effect::CompensationRightByDiameter => self.is_compensating = true,
            Effect::LengthOff => self.has_length = false,
            Effect::LengthPlus | Effect::LengthFiveAxis => self.has_length = true,
            Effect::SpindleClockwise | Effect::SpindleCounterClockwise => self.spindle_turns = true,
            Effect::SpindleStop => self.spindle_turns = false,
            Effect::ToolChange => {
                self.section += 1;
                self.spindle_turns = false;
                self.has_length = false;
            }
            Effect::ProgramEnd | Effect::ProgramEndWithPallet | Effect::Return => self.is_subprogram = true,
            _ => {}
        }
    }

    fn take_words(&mut self, words: &[Word]) {
        self.feed |= words.iter().any(|word| word.letter == b'F');
        if let Some(tool) = words.iter().find(|word| word.letter == b'T') {
            self.tool = tool.number;
        }
    }

    fn take_statements(&mut self, statements: &[(Range<usize>, StatementKind)]) {
        for (_, kind) in statements {
            if let StatementKind::OWord { keyword, .. } = kind {
                match keyword {
                    gcheck_program::OKeyword::Sub => self.is_subprogram = true,
                    gcheck_program::OKeyword::EndSub => self.is_subprogram = false,
                    _ => {}
                }
            }
        }
    }
}

impl Block {
    pub(crate) fn word(&self, letter: u8) -> Option<&Word> {
        self.words.iter().find(|word| word.letter == letter)
    }

    pub(crate) fn has(&self, letters: &[u8]) -> bool {
        letters.iter().any(|letter| self.word(*letter).is_some())
    }

    /// The word whose code has one of these effects.
    pub(crate) fn code(&self, effects: &[Effect]) -> Option<&Word> {
        self.words.iter().find(|word| word.effect.is_some_and(|effect| effects.contains(&effect)))
    }

    /// Words and nothing else: no statement.
    pub(crate) fn is_plain(&self) -> bool {
        self.statements.is_empty() && !self.words.is_empty()
    }

    /// Moves on the way that is on after it.
    pub(crate) fn moves(&self, effects: &[Effect]) -> bool {
        self.is_plain()
            && self.has(b"XYZUW")
            && self.after.motion.is_some_and(|motion| effects.contains(&motion))
            && self.code(&NO_MOVES).is_none()
    }

    /// Where the last word or statement ends: a remark may be after.
    pub(crate) fn end_of_words(&self) -> usize {
        let words = self.words.iter().map(|word| word.range.end);
        let statements = self.statements.iter().map(|(range, _)| range.end);
        words.chain(statements).max().unwrap_or(self.range.start)
    }
}

/// Codes with which axis words say something else than where to go on the way that is on.
const NO_MOVES: [Effect; 12] = [
    Effect::ReturnReference(0),
    Effect::ReturnReference(1),
    Effect::ReturnReference(2),
    Effect::ReturnReference(3),
    Effect::MachineCoordinates,
    Effect::WriteOffsets,
    Effect::LocalShift,
    Effect::SetPosition,
    Effect::SpeedLimitOrSetPosition,
    Effect::Dwell,
    Effect::MacroCall,
    Effect::RotationOn,
];
