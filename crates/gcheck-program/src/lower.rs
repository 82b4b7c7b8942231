//! Lowering: from the grammar's events to the block table.
//!
//! Knows: how tokens and nodes become words, codes, expressions and statements, given a control. Must not know: rules. The
//! same sink is fed by the grammar directly (the flat path) and by the tree (law 2): nothing here may depend on *when* a
//! node was opened, only on what it holds when it ends.

use std::ops::Range;

use gcheck_controls::{
    CodeEntry, CodeIx, CodeNumber, Control, Letter, LetterSet, LineCounts, Need, Semicolon, WordEntry,
    WordKind,
};
use gcheck_syntax::{
    MAX_LINE_BYTES, Parse, Sink, SyntaxError, SyntaxErrorKind, SyntaxKind, SyntaxProfile, parse_into, replay,
};

use crate::block::{Block, BlockFlags, BlockIx, BlockTable, Value, Word};
use crate::expression::{BinaryOp, Expr, ExprIx, Function, Op, is_well_formed};
use crate::line_length::counted_characters;
use crate::number::{self, NumberShape};
use crate::plain::{self, PlainWord};
use crate::statement::{OKeyword, OLabel, Statement, StatementKind, Target};

/// A control as the lowering asks it: facts about addresses in arrays, code look-up by number.
///
/// Made once per control and shared by all chunks and threads.
#[derive(Debug, Clone)]
pub struct Dialect<'c> {
    control: &'c Control,
    profile: SyntaxProfile,
    letters: [LetterFacts; Letter::COUNT],
    /// Addresses on which a number with a decimal point and not too many digits, once in a block, is nothing to look at.
    quiet: LetterSet,
    /// Addresses that need a code that reads them.
    bound: LetterSet,
    /// Quiet addresses that say where to, and nothing that the file as a whole is asked about.
    points: LetterSet,
    max_digits: u32,
    /// `P2.` is `P2`, and `G1.00` is `G1`.
    integers_take_point: bool,
    line_length: u32,
    line_counts: LineCounts,
    lower_case: bool,
    block_delete: bool,
    /// By code index: does the code name a label or program?
    refers: Vec<bool>,
    /// Codes that end lines of data which another code opens.
    ends_data: Vec<CodeIx>,
    /// By code index: is an `M` after the code in its block an argument of it?
    takes_m: Vec<bool>,
    /// By code index: words that must have been given by the time the code runs, each with those that do instead.
    lasting: Vec<Vec<Lasting>>,
    /// Addresses of increments, each with the address of its axis.
    increments: Vec<(Letter, Letter)>,
}

/// What [`BlockFlags`] need to know about an address when no code says otherwise.
#[derive(Debug, Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "independent yes/no facts of an address")]
struct LetterFacts {
    known: bool,
    integer: bool,
    /// It counts something, point or not.
    whole: bool,
    count: bool,
    negative: bool,
    repeatable: bool,
    free: bool,
    min: f64,
    max: f64,
}

impl LetterFacts {
    const UNKNOWN: Self = Self {
        known: false,
        integer: false,
        whole: false,
        count: false,
        negative: true,
        repeatable: false,
        free: false,
        min: f64::NEG_INFINITY,
        max: f64::INFINITY,
    };

    /// Does a number with a decimal point make no flag, whatever its value?
    fn is_quiet(&self) -> bool {
        self.known
            && !self.integer
            && !self.whole
            && self.negative
            && self.min == f64::NEG_INFINITY
            && self.max == f64::INFINITY
    }
}

impl<'c> Dialect<'c> {
    /// Prepares a control.
    pub fn new(control: &'c Control) -> Self {
        let mut letters = [LetterFacts::UNKNOWN; Letter::COUNT];
        // What is a length elsewhere may be a count with some code: `Q` of `G74` on a lathe.
        let words = control.codes().flat_map(|code| &code.entry().words).filter(|word| word.kind.is_whole());
        let counts_with_a_code: LetterSet = words.filter_map(|word| Letter::parse(&word.letter)).collect();
        let all = (0..=u8::MAX).filter_map(|b| Letter::new(b).or_else(|| Letter::sign(b)));
        for letter in all.chain([Letter::CORNER_R, Letter::CORNER_C, Letter::CORNER_A]) {
            let Some(entry) = control.letter(letter) else { continue };
            let integer = entry.kind.is_whole();
            // Coordinates and centres are read by the million.
            let is_coordinate = entry.axis || LetterSet::of("IJKR").contains(letter);
            let with_a_code = counts_with_a_code.contains(letter) && !is_coordinate;
            if let Some(facts) = letters.get_mut(letter.index()) {
                *facts = LetterFacts {
                    known: true,
                    integer: (integer || with_a_code) && !control.numbers().integers_take_point,
                    whole: integer,
                    count: integer || !entry.scaled,
                    negative: entry.negative,
                    repeatable: entry.repeatable,
                    free: entry.free || entry.axis,
                    min: entry.min.unwrap_or(f64::NEG_INFINITY),
                    max: entry.max.unwrap_or(f64::INFINITY),
                };
            }
        }
        let is_bound = |letter: &Letter| letters.get(letter.index()).is_some_and(|facts| !facts.free);
        let corners = [Letter::CORNER_R, Letter::CORNER_C, Letter::CORNER_A];
        let is_quiet = |letter: &Letter| {
            letters.get(letter.index()).is_some_and(LetterFacts::is_quiet)
                && !matches!(letter.ascii(), b'G' | b'M' | b'N' | b'O')
        };
        let quiet: LetterSet = (0..=u8::MAX).filter_map(Letter::new).filter(is_quiet).collect();
        let increments = control.semantics().increments.iter();
        let increments: Vec<_> = increments
            .filter_map(|(increment, axis)| Some((Letter::parse(increment)?, Letter::parse(axis)?)))
            .collect();
        // Beside their axes they are to be looked at.
        let quiet = quiet.without(increments.iter().map(|(increment, _)| *increment).collect());
        Self {
            control,
            profile: profile(control),
            quiet,
            bound: (0..=u8::MAX).filter_map(Letter::new).chain(corners).filter(is_bound).collect(),
            points: quiet.and(control.axes().or(LetterSet::of("IJKR"))),
            letters,
            integers_take_point: control.numbers().integers_take_point,
            max_digits: control.numbers().max_digits.map_or(u32::MAX, u32::from),
            line_length: control.limits().line_length.unwrap_or(u32::MAX),
            line_counts: control.limits().line_counts,
            lower_case: control.syntax().lower_case,
            block_delete: control.syntax().block_delete,
            increments,
            lasting: control.codes().map(|code| lasting_words(code.entry())).collect(),
            takes_m: if control.semantics().m_is_argument {
                control.codes().map(|code| code.effect().calls_macro()).collect()
            } else {
                Vec::new()
            },
            ends_data: ends_data(control),
            refers: control
                .codes()
                .map(|code| {
                    code.entry().words.iter().any(|w| matches!(w.kind, WordKind::Label | WordKind::Program))
                })
                .collect(),
        }
    }

    /// The control.
    pub fn control(&self) -> &'c Control {
        self.control
    }

    /// How the grammar reads text for it.
    pub fn profile(&self) -> SyntaxProfile {
        self.profile
    }

    /// Has a block without a code a word that needs one? Arcs in effect read a centre or a radius beside axis words.
    fn has_stray(&self, letters: LetterSet) -> bool {
        const CENTRE: LetterSet = LetterSet::of("IJKR");
        let bound = letters.and(self.bound);
        let is_of_arc = bound.without(CENTRE).is_empty() && letters.intersects(self.control.axes());
        !bound.is_empty() && !is_of_arc
    }

    /// Words that must have been given by the time the code runs, each with those that do instead.
    pub(crate) fn lasting(&self, code: CodeIx) -> &[Lasting] {
        self.lasting.get(code.index()).map_or(&[], Vec::as_slice)
    }

    /// Does the code name a label or a program in one of its words?
    pub(crate) fn refers(&self, code: CodeIx) -> bool {
        self.refers.get(code.index()).copied().unwrap_or(false)
    }

    /// Does the control have codes that open lines of data?
    pub(crate) fn has_data_codes(&self) -> bool {
        !self.ends_data.is_empty()
    }

    /// May the code end lines of data?
    pub(crate) fn ends_data(&self, code: CodeIx) -> bool {
        self.ends_data.contains(&code)
    }

    /// Is an `M` after these words of its block an argument of one of their codes?
    pub fn takes_m(&self, words: &[Word]) -> bool {
        !self.takes_m.is_empty()
            && words.iter().any(|word| self.takes_m.get(word.code.index()).copied().unwrap_or(false))
    }

    /// The code that a word after others of its block names; none for a word that is not a `G` or `M`, or is an argument.
    fn code_after(&self, before: &[Word], letter: Letter, number: f64, shape: NumberShape) -> CodeIx {
        if letter == Letter::of('M') && self.takes_m(before) {
            return CodeIx::NONE;
        }
        self.code_of(letter, number, shape)
    }

    /// The code that a word names; none for a word that is not a `G` or `M`.
    fn code_of(&self, letter: Letter, number: f64, shape: NumberShape) -> CodeIx {
        if letter != Letter::of('G') && letter != Letter::of('M') {
            return CodeIx::NONE;
        }
        let is_written = match shape.decimals {
            _ if shape.minus => false,
            0 | 1 => true,
            // `G59.10`: a control that reads counts as numbers reads codes so, too, whatever zeros are at their end.
            #[expect(clippy::float_cmp, reason = "asks whether the number is that of one decimal exactly")]
            _ => self.integers_take_point && (number * 10.0).round() / 10.0 == number,
        };
        let number = is_written.then(|| CodeNumber::from_value(letter.ascii(), number)).flatten();
        number.map_or(CodeIx::NONE, |n| self.control.code_ix(n))
    }

    fn letter(&self, letter: Letter) -> &LetterFacts {
        self.letters.get(letter.index()).unwrap_or(&LetterFacts::UNKNOWN)
    }

    /// The block with other values in its words: its addresses and flags are those of the new words.
    pub fn with_words(&self, block: &Block, words: &[Word]) -> Block {
        let (letters, facts) = self.survey_words(words);
        Block { flags: block.flags.difference(BlockFlags::OF_WORDS) | facts, letters, ..block.clone() }
    }

    /// One pass over the words of a finished block.
    fn survey_words(&self, words: &[Word]) -> (LetterSet, BlockFlags) {
        let mut letters = LetterSet::EMPTY;
        let mut flags = BlockFlags::empty();
        let mut read = LetterSet::EMPTY;
        let mut reads_anything = false;
        let mut bound = LetterSet::EMPTY;
        for (index, word) in words.iter().enumerate() {
            let facts = self.letter(word.letter);
            let is_new = letters.insert(word.letter);
            if !is_new && !facts.repeatable {
                flags |= BlockFlags::REPEATED;
            }
            if !facts.known {
                flags |= BlockFlags::UNKNOWN_ADDRESS;
            }
            match word.letter.ascii() {
                b'M' if self.takes_m(words.get(..index).unwrap_or_default()) => {
                    if matches!(word.value, Value::Expr(_)) {
                        flags |= BlockFlags::EXPRESSION;
                    }
                    continue;
                }
                b'G' | b'M' => {
                    flags |= BlockFlags::CODE;
                    if let Some(code) = self.control.code_at(word.code) {
                        read = read.or(code.reads());
                        reads_anything |= code.entry().any_words;
                    } else if !matches!(word.value, Value::Expr(_)) {
                        flags |= BlockFlags::UNKNOWN_CODE;
                    } else {
                        // `G#1`: which code it is only the engine can say.
                        reads_anything = true;
                    }
                    if matches!(word.value, Value::Expr(_)) {
                        flags |= BlockFlags::EXPRESSION;
                    }
                    continue;
                }
                b'N' => flags |= BlockFlags::LABEL,
                b'O' => flags |= BlockFlags::PROGRAM_NUMBER,
                _ => {}
            }
            if !facts.free {
                bound.insert(word.letter);
            }
            match word.value {
                Value::Number(value) => {
                    let shape = word.shape;
                    if shape.digits() > self.max_digits {
                        flags |= BlockFlags::LONG_NUMBER;
                    }
                    if !shape.point && value != 0.0 && !facts.count {
                        flags |= BlockFlags::UNPOINTED;
                    }
                    if shape.point && facts.integer {
                        flags |= BlockFlags::POINT_ON_INTEGER;
                    }
                    if shape.minus && !facts.negative {
                        flags |= BlockFlags::NEGATIVE;
                    }
                    if !(facts.min..=facts.max).contains(&value) || facts.whole && value.fract() != 0.0 {
                        flags |= BlockFlags::OUT_OF_RANGE;
                    }
                }
                Value::Expr(_) => flags |= BlockFlags::EXPRESSION,
                Value::Missing => {}
            }
        }
        let unread = bound.without(read);
        let has_code = flags.contains(BlockFlags::CODE);
        if !reads_anything && if has_code { !unread.is_empty() } else { self.has_stray(letters) } {
            flags |= BlockFlags::UNREAD_WORD;
        }
        let both =
            |(increment, axis): &(Letter, Letter)| letters.contains(*increment) && letters.contains(*axis);
        flags.set(BlockFlags::AXIS_TWICE, self.increments.iter().any(both));
        (letters, flags)
    }
}

/// A word of a code whose earlier value stays in effect.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lasting {
    pub(crate) letter: Letter,
    /// Words that do instead, from any block.
    pub(crate) instead: LetterSet,
    /// Words that do instead in a block of the code.
    pub(crate) here: LetterSet,
}

/// Codes that end lines of data which another code of the control opens.
fn ends_data(control: &Control) -> Vec<CodeIx> {
    let openers: Vec<_> = control.codes().filter(|code| code.entry().opens_data.is_some()).collect();
    let ends = control.codes().filter(|code| openers.iter().any(|opener| code.ends_data_of(*opener)));
    ends.map(|code| control.code_ix(code.number())).collect()
}

/// Words of a code whose earlier value stays in effect. Feed and speed are left out: they are set by themselves, and whether
/// they are is a question of the whole path.
fn lasting_words(entry: &CodeEntry) -> Vec<Lasting> {
    let lasts = |word: &&WordEntry| {
        let is_set_by_itself = matches!(word.kind, WordKind::Feed | WordKind::Speed);
        word.need == Need::Modal && word.default.is_none() && !is_set_by_itself
    };
    let letters = |word: &WordEntry| {
        let set = |letters: &[String]| letters.iter().filter_map(|letter| Letter::parse(letter)).collect();
        let (instead, here) = (set(&word.instead), set(&word.instead_here));
        Some(Lasting { letter: Letter::parse(&word.letter)?, instead, here })
    };
    entry.words.iter().filter(lasts).filter_map(letters).collect()
}

/// The syntax profile of a control.
pub fn profile(control: &Control) -> SyntaxProfile {
    let syntax = control.syntax();
    SyntaxProfile {
        semicolon_comment: syntax.semicolon == Semicolon::Comment,
        blanks_in_numbers: syntax.blanks_in_numbers,
        colon_program: syntax.colon_program,
        o_words: syntax.o_words,
        macro_statements: syntax.macro_statements,
        variables: syntax.variables,
        named_parameters: syntax.named_parameters,
        bare_expressions: syntax.bare_expressions,
        logic_binds_last: syntax.logic_binds_last,
        power_operator: syntax.power_operator,
        words_after_if: syntax.words_after_if,
        system_commands: syntax.system_commands,
    }
}

/// Lowers a chunk from its text: the fast path, without a tree.
pub fn lower(text: &str, dialect: &Dialect<'_>) -> BlockTable {
    let mut sink = LowerSink::new(text, dialect);
    parse_into(text, dialect.profile, &mut sink);
    sink.table
}

/// The blocks of a chunk without their words, when every one of them only says where to: what a first look at a large file
/// needs. `None` for any other chunk; [`lower`] reads it.
pub(crate) fn skim(text: &str, dialect: &Dialect<'_>) -> Option<BlockTable> {
    let mut blocks = Vec::with_capacity(lines(text));
    let mut start = 0;
    while start < text.len() {
        let mut quiet = Quiet::new(start);
        start = plain::line(text.as_bytes(), start, |word| quiet.see(&word, dialect))?;
        if quiet.letters.is_empty() {
            continue;
        }
        if !quiet.is_quiet(dialect) || !quiet.letters.without(dialect.points).is_empty() {
            return None;
        }
        blocks.push(quiet.block(0..0));
    }
    Some(BlockTable { blocks, ..BlockTable::default() })
}

/// At most so many lines has a text.
fn lines(text: &str) -> usize {
    memchr::memchr_iter(b'\n', text.as_bytes()).count() + 1
}

/// A plain line of which nothing has been seen yet that makes a flag.
struct Quiet {
    /// Of the line in the chunk, up to the last word seen.
    range: Range<u32>,
    letters: LetterSet,
    /// No address is given twice, each is quiet, each number has a point and not too many digits.
    words: bool,
    has_lower: bool,
}

impl Quiet {
    fn new(start: usize) -> Self {
        Self { range: start as u32..start as u32, letters: LetterSet::EMPTY, words: true, has_lower: false }
    }

    #[inline]
    fn see(&mut self, word: &PlainWord, dialect: &Dialect<'_>) {
        self.range.end = word.end;
        self.has_lower |= word.is_lower;
        self.words &= self.letters.insert(word.letter)
            && dialect.quiet.contains(word.letter)
            && word.shape.point
            && word.shape.digits() <= dialect.max_digits;
    }

    /// Has the block no flag?
    fn is_quiet(&self, dialect: &Dialect<'_>) -> bool {
        self.words
            && !self.has_lower
            && !dialect.has_stray(self.letters)
            && self.range.end - self.range.start <= dialect.line_length
    }

    fn block(&self, words: Range<u32>) -> Block {
        let Self { range, letters, .. } = self;
        Block { range: range.clone(), flags: BlockFlags::empty(), letters: *letters, delete: 0, words }
    }
}

/// Lowers a chunk from its tree and the text that the tree was made from. Equal to [`lower`] on the same text (law 2).
pub fn lower_tree(parse: &Parse, text: &str, dialect: &Dialect<'_>) -> BlockTable {
    let mut sink = LowerSink::new(text, dialect);
    replay(parse, &mut sink);
    sink.place_late_errors();
    sink.table
}

/// A node that has begun and not ended.
#[derive(Debug, Clone)]
struct Open {
    kind: SyntaxKind,
    start: u32,
    /// Where its operations begin.
    ops: usize,
    /// The operator of a BINARY or sign of a UNARY node.
    operator: Option<BinaryOp>,
    function: Option<Function>,
    /// Arguments of a function: groups, and commas in them.
    arguments: u8,
    /// Pieces found on the way, by statement.
    first: Option<ExprIx>,
    target: Option<Target>,
    keyword: Option<(OLabel, OKeyword)>,
    first_argument: u32,
    /// Where the value of an assignment starts: after its `=`.
    value_start: u32,
}

struct LowerSink<'t, 'd> {
    text: &'t str,
    dialect: &'d Dialect<'d>,
    table: BlockTable,
    open: Vec<Open>,
    /// Depth of nodes whose content is not lowered: `ERROR` and `PRINT_STATEMENT`.
    skip: u32,
    /// End of the last token that counts: expressions and statements end there, not after blanks.
    end: u32,
    /// Where the next token starts, and so where the next block does.
    next_token: u32,
    block_words: u32,
    block_flags: BlockFlags,
    block_delete: u8,
    has_content: bool,
    /// Errors of this block: their number in the table when it began.
    block_errors: usize,
    /// The tree reports its errors after its nodes.
    late_errors: Vec<SyntaxError>,
}

impl<'t, 'd> LowerSink<'t, 'd> {
    fn new(text: &'t str, dialect: &'d Dialect<'d>) -> Self {
        let table = BlockTable {
            blocks: Vec::with_capacity(lines(text)),
            // Seldom is a word shorter than eight characters with the blank after it.
            words: Vec::with_capacity(text.len().min(4 * MAX_LINE_BYTES as usize) / 8 + 1),
            ..BlockTable::default()
        };
        Self {
            text,
            dialect,
            table,
            open: Vec::with_capacity(8),
            skip: 0,
            end: 0,
            next_token: 0,
            block_words: 0,
            block_flags: BlockFlags::empty(),
            block_delete: 0,
            has_content: false,
            block_errors: 0,
            late_errors: Vec::new(),
        }
    }

    fn slice(&self, range: &Range<u32>) -> &'t [u8] {
        self.text.as_bytes().get(range.start as usize..range.end as usize).unwrap_or_default()
    }

    fn innermost(&self) -> SyntaxKind {
        self.open.last().map_or(SyntaxKind::CHUNK, |o| o.kind)
    }

    /// Takes the operations since `from` as an expression that ends at the last token.
    fn take_expr(&mut self, from: usize, start: u32) -> Option<ExprIx> {
        let to = self.table.ops.len();
        if from == to {
            return None;
        }
        let ops = self.table.ops.get(from..to).unwrap_or_default();
        let expr =
            Expr { range: start..self.end, well_formed: is_well_formed(ops), ops: from as u32..to as u32 };
        self.table.exprs.push(expr);
        Some(ExprIx(self.table.exprs.len() as u32 - 1))
    }

    fn push_word(&mut self, range: Range<u32>, letter: Letter, value: Value, shape: NumberShape) {
        let code = match value {
            Value::Number(number) => {
                let before = self.table.words.get(self.block_words as usize..).unwrap_or_default();
                self.dialect.code_after(before, letter, number, shape)
            }
            _ => CodeIx::NONE,
        };
        self.table.words.push(Word { letter, value, shape, code, start: range.start, end: range.end });
    }

    /// A fused word: `X-1.5`, `,R.5`, `:1234`.
    fn fused(&mut self, range: Range<u32>) {
        let text = self.slice(&range);
        let (letter, number) = match text {
            [b',', letter, number @ ..] => (Letter::corner(*letter).or(Letter::new(*letter)), number),
            [b':', number @ ..] => (Letter::new(b'O'), number),
            [letter, number @ ..] => (Letter::new(*letter).or_else(|| Letter::sign(*letter)), number),
            [] => return,
        };
        let Some(letter) = letter else { return };
        let (value, shape) = number::parse(number);
        self.push_word(range, letter, Value::Number(value), shape);
    }

    /// An ADDRESS node ended: a word whose value is not fused to it.
    fn address(&mut self, open: &Open) {
        let range = open.start..self.end;
        let text = self.slice(&range);
        let (letter, rest) = match text {
            // `, R5.`: blanks may be between the comma and its letter.
            [b',', parted @ ..] => match parted.trim_ascii_start() {
                [letter, rest @ ..] => (Letter::corner(*letter).or(Letter::new(*letter)), rest),
                [] => return,
            },
            [letter, rest @ ..] => (Letter::new(*letter).or_else(|| Letter::sign(*letter)), rest),
            [] => return,
        };
        let Some(letter) = letter else { return };
        let value_start = range.end - rest.len() as u32;
        // `X 1.`, `X 1. 5`, `X - 1.`: a number after all, spread over tokens.
        // `X--1.` is an expression: its signs are taken one after the other.
        let literal = !rest.is_empty()
            && rest.iter().all(|b| matches!(b, b'0'..=b'9' | b'.' | b'-' | b'+') || is_blank(*b))
            && rest.iter().filter(|b| matches!(b, b'-' | b'+')).count() < 2;
        let (value, shape) = if literal {
            let is_digit = |b: &u8| !matches!(b, b'-' | b'+') && !is_blank(*b);
            let digits =
                rest.iter().position(is_digit).and_then(|first| rest.get(first..)).unwrap_or_default();
            if digits.iter().any(|b| !is_digit(b)) {
                self.block_flags |= BlockFlags::DIVIDED_NUMBER;
            }
            let (value, shape) = number::parse(rest);
            (Value::Number(value), shape)
        } else if let Some(expr) = self.take_expr(open.ops, value_start) {
            (Value::Expr(expr), NumberShape::default())
        } else {
            (Value::Missing, NumberShape::default())
        };
        self.push_word(range, letter, value, shape);
    }

    fn statement(&mut self, open: &Open, kind: StatementKind) {
        let block = BlockIx(self.table.blocks.len() as u32);
        self.table.statements.push((block, Statement { range: open.start..self.end, kind }));
        self.block_flags |= BlockFlags::STATEMENT;
    }

    /// Closes the condition of the innermost IF when its consequence begins.
    fn close_condition(&mut self) {
        if let Some(open) = self.open.last()
            && matches!(open.kind, SyntaxKind::IF_STATEMENT | SyntaxKind::WHILE_STATEMENT)
            && open.target.is_none()
        {
            let (from, start) = (open.ops, open.start);
            let is_if = open.kind == SyntaxKind::IF_STATEMENT;
            let condition = self.take_expr(from, start);
            let ops = self.table.ops.len();
            let end = self.end;
            if let Some(open) = self.open.last_mut() {
                open.first = condition;
                open.ops = ops;
                // Marks the condition as taken.
                open.target = Some(Target::Invalid);
            }
            if is_if {
                let block = BlockIx(self.table.blocks.len() as u32);
                let kind = StatementKind::If { condition };
                self.table.statements.push((block, Statement { range: start..end, kind }));
                self.block_flags |= BlockFlags::STATEMENT;
            }
        }
    }

    /// The keyword of an O-word: the word before it is the label, not a word of the block.
    fn o_keyword(&mut self, keyword: OKeyword) {
        let Some(open) = self.open.last() else { return };
        if open.keyword.is_some() {
            return;
        }
        let named = open.target.clone();
        // The expression of a computed label is in front of the arguments.
        let mut first_argument = self.table.exprs.len() as u32;
        let label = match named {
            Some(Target::Named(range)) => OLabel::of_name(name_key(self.slice(&range))),
            _ => match self.table.words.pop() {
                Some(Word { value: Value::Expr(ix), .. }) => {
                    // `O[100*2]` is `O200`; its expression is not an argument then.
                    let number = constant_label(self.table.ops(self.table.expr(ix)));
                    if number.is_none() {
                        first_argument = ix.0;
                    }
                    number.map_or(OLabel::Computed, OLabel::Number)
                }
                Some(word) => word.integer().map_or_else(
                    || {
                        // `O-1` is computed as `O[-1]` is.
                        let ops = self.table.ops.len();
                        self.table.ops.push(Op::Number(word.number().unwrap_or(f64::NAN)));
                        if let Some(ix) = self.take_expr(ops, word.start) {
                            first_argument = ix.0;
                        }
                        OLabel::Computed
                    },
                    OLabel::Number,
                ),
                None => OLabel::Computed,
            },
        };
        let ops = self.table.ops.len();
        if let Some(open) = self.open.last_mut() {
            open.keyword = Some((label, keyword));
            open.ops = ops;
            open.first_argument = first_argument;
        }
    }

    fn operator(&mut self, kind: SyntaxKind, range: &Range<u32>) {
        let operator = BinaryOp::parse(self.slice(range));
        if let Some(open) = self.open.last_mut()
            && matches!(open.kind, SyntaxKind::BINARY | SyntaxKind::UNARY)
        {
            if open.operator.is_none() {
                open.operator = operator;
            } else if kind == SyntaxKind::STAR && open.operator == Some(BinaryOp::Multiply) {
                // `* *`
                open.operator = Some(BinaryOp::Power);
            }
        }
        debug_assert!(operator.is_some() || kind == SyntaxKind::SLASH, "{kind:?} is an operator");
    }

    fn finish_block(&mut self, open: &Open) {
        let ix = BlockIx(self.table.blocks.len() as u32);
        let words = self.block_words..self.table.words.len() as u32;
        let errors = self.table.errors.len() > self.block_errors;
        if words.is_empty() && !errors && !self.has_content && self.block_flags.is_empty() {
            return;
        }
        let range = open.start..self.end.max(open.start);
        let mut flags = self.block_flags;
        flags.set(BlockFlags::ERROR, errors);
        let own = self.table.errors.get(self.block_errors..).unwrap_or_default();
        flags.set(BlockFlags::REMARK, reads_like_a_remark(self.text, own.iter().map(|(_, error)| error)));
        self.push_block(range, flags, words);
        debug_assert_eq!(ix.index() + 1, self.table.blocks.len(), "one block a BLOCK node");
    }

    fn push_block(&mut self, range: Range<u32>, mut flags: BlockFlags, words: Range<u32>) {
        // Bytes are at least as many as characters: only a line that may be too long is counted.
        if range.end - range.start > self.dialect.line_length {
            let text = self.text.get(range.start as usize..range.end as usize).unwrap_or_default();
            let counted = counted_characters(text, self.dialect.line_counts);
            flags.set(BlockFlags::LONG_LINE, counted > self.dialect.line_length as usize);
        }
        let words_of_block =
            self.table.words.get(words.start as usize..words.end as usize).unwrap_or_default();
        let (letters, facts) = self.dialect.survey_words(words_of_block);
        flags |= facts;
        self.table.flags |= flags;
        self.table.blocks.push(Block { range, flags, letters, delete: self.block_delete, words });
    }

    /// The line that begins at `start`, if it is plain: where the next one begins.
    fn plain_line(&mut self, start: usize) -> Option<usize> {
        let first = self.table.words.len();
        let (dialect, words) = (self.dialect, &mut self.table.words);
        let mut quiet = Quiet::new(start);
        let next = plain::line(self.text.as_bytes(), start, |word| {
            quiet.see(&word, dialect);
            let PlainWord { letter, value, shape, start, end, .. } = word;
            let code = dialect.code_after(words.get(first..).unwrap_or_default(), letter, value, shape);
            words.push(Word { letter, value: Value::Number(value), shape, code, start, end });
        });
        let Some(next) = next else {
            words.truncate(first);
            return None;
        };
        let words = first as u32..words.len() as u32;
        if words.is_empty() {
            // A blank line makes no block.
        } else if quiet.is_quiet(dialect) {
            self.table.blocks.push(quiet.block(words));
        } else {
            self.block_delete = 0;
            let mut flags = BlockFlags::empty();
            flags.set(BlockFlags::LOWER_CASE, quiet.has_lower && !dialect.lower_case);
            self.push_block(quiet.range, flags, words);
        }
        Some(next)
    }

    /// The tree gives its errors at the end: put each to the block whose text holds it, in the order in which the grammar met
    /// them.
    fn place_late_errors(&mut self) {
        for error in std::mem::take(&mut self.late_errors) {
            let at =
                self.table.blocks.partition_point(|b| b.range.start <= error.range.start).saturating_sub(1);
            if let Some(block) = self.table.blocks.get_mut(at) {
                block.flags |= BlockFlags::ERROR;
                self.table.flags |= BlockFlags::ERROR;
                self.table.errors.push((BlockIx(at as u32), error));
            }
        }
        self.table.errors.sort_by_key(|(ix, _)| *ix);
        for ix in 0..self.table.blocks.len() as u32 {
            if reads_like_a_remark(self.text, self.table.errors(BlockIx(ix)))
                && let Some(block) = self.table.blocks.get_mut(ix as usize)
            {
                block.flags |= BlockFlags::REMARK;
                self.table.flags |= BlockFlags::REMARK;
            }
        }
    }
}

/// Is text of a block in a script that no code is in, or at least three words long?
fn reads_like_a_remark<'e>(text: &str, errors: impl Iterator<Item = &'e SyntaxError>) -> bool {
    let mut foreign_letters = 0;
    for error in errors.filter(|error| error.kind == SyntaxErrorKind::Unexpected) {
        let text = text.get(error.range.start as usize..error.range.end as usize).unwrap_or_default();
        let is_word = |word: &&str| word.len() > 1 && word.chars().all(char::is_alphabetic);
        if text.split_ascii_whitespace().filter(is_word).nth(2).is_some() {
            return true;
        }
        foreign_letters += text.chars().filter(|c| !c.is_ascii() && c.is_alphabetic()).count();
    }
    foreign_letters > 2
}

/// Signs of the serial line and of old file systems, which controls pass over: NUL, XON and XOFF, DEL, and the end mark of DOS in
/// a line of its own at the end.
fn is_transmission(text: &str, error: &SyntaxError) -> bool {
    let range = error.range.start as usize..error.range.end as usize;
    if error.kind != SyntaxErrorKind::Unexpected {
        return false;
    }
    let signs = text.get(range.clone()).unwrap_or_default();
    let is_alone = || {
        let before = text.get(..range.start).unwrap_or_default();
        let after = text.get(range.end..).unwrap_or_default();
        (before.is_empty() || before.ends_with(['\n', '\r'])) && after.trim().is_empty()
    };
    signs.chars().all(|c| matches!(c, '\0' | '\x11'..='\x14' | '\x7F')) || (signs == "\x1A" && is_alone())
}

/// The bytes of blanks between words.
const fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\x0B' | b'\x0C')
}

/// A name as it is compared: lower case, without blanks and brackets.
pub(crate) fn name_key(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    text.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_lowercase).collect()
}

/// The number of a label that is computed from numbers alone.
fn constant_label(ops: &[Op]) -> Option<u32> {
    // Labels are short; what is longer is left to the run.
    let mut stack = [0.0; 8];
    let mut depth = 0_usize;
    for op in ops {
        let value = match op {
            Op::Number(number) => *number,
            Op::Negate => {
                depth = depth.checked_sub(1)?;
                -stack.get(depth)?
            }
            Op::Binary(operator) => {
                depth = depth.checked_sub(2)?;
                let (left, right) = (stack.get(depth)?, stack.get(depth + 1)?);
                match operator {
                    BinaryOp::Add => left + right,
                    BinaryOp::Subtract => left - right,
                    BinaryOp::Multiply => left * right,
                    _ => return None,
                }
            }
            _ => return None,
        };
        *stack.get_mut(depth)? = value;
        depth += 1;
    }
    let [value, ..] = stack;
    let is_label = depth == 1 && value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value);
    #[expect(clippy::cast_sign_loss, reason = "the range is checked")]
    is_label.then_some(value as u32)
}

/// The bytes between `<` and `>` of a fused named token.
fn between_brackets(text: &[u8], range: &Range<u32>) -> Range<u32> {
    let open = memchr::memchr(b'<', text).map_or(0, |at| at as u32 + 1);
    range.start + open..range.end.saturating_sub(1)
}

impl Sink for LowerSink<'_, '_> {
    type Checkpoint = u32;

    fn start_node(&mut self, kind: SyntaxKind) {
        self.start_node_at(u32::MAX, kind);
    }

    /// Where the next token starts.
    fn checkpoint(&self) -> u32 {
        self.next_token
    }

    fn start_node_at(&mut self, checkpoint: u32, kind: SyntaxKind) {
        match kind {
            SyntaxKind::BLOCK => {
                self.block_words = self.table.words.len() as u32;
                self.block_flags = BlockFlags::empty();
                self.block_delete = 0;
                self.has_content = false;
                self.block_errors = self.table.errors.len();
                self.end = self.next_token;
            }
            SyntaxKind::ERROR | SyntaxKind::PRINT_STATEMENT => self.skip += 1,
            SyntaxKind::BLOCK_DELETE => {
                self.block_flags |= BlockFlags::BLOCK_DELETE;
                self.block_delete = u8::from(self.dialect.block_delete);
            }
            SyntaxKind::GOTO_STATEMENT | SyntaxKind::ASSIGNMENT => self.close_condition(),
            _ => {}
        }
        self.open.push(Open {
            kind,
            // Unknown until its first token comes, unless the node is opened after it.
            start: checkpoint,
            ops: self.table.ops.len(),
            operator: None,
            function: None,
            arguments: 0,
            first: None,
            target: None,
            keyword: None,
            first_argument: self.table.exprs.len() as u32,
            value_start: 0,
        });
        if kind == SyntaxKind::BLOCK
            && let Some(open) = self.open.last_mut()
        {
            open.start = self.next_token;
        }
    }

    fn finish_node(&mut self) {
        let Some(mut open) = self.open.pop() else { return };
        if open.start == u32::MAX {
            open.start = self.end;
        }
        match open.kind {
            SyntaxKind::ERROR => {
                self.skip -= 1;
                return;
            }
            SyntaxKind::PRINT_STATEMENT => {
                self.skip -= 1;
                if self.skip == 0 {
                    self.statement(&open, StatementKind::Print);
                }
                return;
            }
            SyntaxKind::BLOCK => {
                self.finish_block(&open);
                return;
            }
            _ if self.skip > 0 => return,
            _ => {}
        }
        match open.kind {
            SyntaxKind::ADDRESS => self.address(&open),
            SyntaxKind::BINARY
            | SyntaxKind::UNARY
            | SyntaxKind::INDIRECT
            | SyntaxKind::FUNCTION_CALL
            | SyntaxKind::GROUP
            | SyntaxKind::DIVIDED_NUMBER => self.finish_operation(&open),
            _ => self.finish_statement(open),
        }
    }

    fn token(&mut self, kind: SyntaxKind, range: Range<u32>) {
        if kind == SyntaxKind::WORD && self.skip == 0 && self.innermost() == SyntaxKind::BLOCK {
            // The short path: nearly every token of a large program.
            self.end = range.end;
            self.next_token = range.end;
            if self.slice(&range).iter().any(u8::is_ascii_lowercase) {
                self.lower_case();
            }
            self.fused(range);
            return;
        }
        // The next block starts after this token, whatever it is.
        self.next_token = range.end;
        match kind {
            SyntaxKind::WHITESPACE | SyntaxKind::NEWLINE | SyntaxKind::BOM | SyntaxKind::SEMICOLON => return,
            SyntaxKind::COMMENT | SyntaxKind::BROKEN_COMMENT | SyntaxKind::LINE_COMMENT => {
                self.block_flags |= BlockFlags::COMMENT;
                if memchr::memmem::find(self.slice(&range), b"gcheck:").is_some() {
                    self.table.directives.push(range.clone());
                }
                // A comment belongs to its block but not to the statement in front of it.
                let end = self.end;
                self.end = range.end;
                if self.innermost() != SyntaxKind::BLOCK && self.skip == 0 {
                    self.end = end;
                }
                return;
            }
            _ => {}
        }
        self.end = range.end;
        self.has_content = true;
        for open in self.open.iter_mut().rev().take_while(|o| o.start == u32::MAX) {
            open.start = range.start;
        }
        if self.skip > 0 {
            return;
        }
        self.meaningful_token(kind, range);
    }

    fn lines_without_tokens(&mut self, from: u32) -> u32 {
        let mut start = from as usize;
        while let Some(next) = self.plain_line(start) {
            start = next;
        }
        self.next_token = start as u32;
        self.next_token
    }

    fn error(&mut self, error: SyntaxError) {
        if is_transmission(self.text, &error) {
            return;
        }
        if self.open.is_empty() {
            self.late_errors.push(error);
        } else {
            self.table.errors.push((BlockIx(self.table.blocks.len() as u32), error));
        }
    }
}

impl LowerSink<'_, '_> {
    /// An operator, function or bracket has all its operands.
    fn finish_operation(&mut self, open: &Open) {
        match open.kind {
            SyntaxKind::BINARY => {
                if let Some(operator) = open.operator {
                    self.table.ops.push(Op::Binary(operator));
                }
            }
            SyntaxKind::UNARY => {
                if open.operator == Some(BinaryOp::Subtract) {
                    self.table.ops.push(Op::Negate);
                }
            }
            SyntaxKind::INDIRECT => self.table.ops.push(Op::Indirect),
            SyntaxKind::DIVIDED_NUMBER => {
                // Its pieces were taken for numbers of their own.
                self.table.ops.truncate(open.ops);
                let (value, _) = number::parse(self.slice(&(open.start..self.end)));
                self.table.ops.push(Op::Number(value));
            }
            SyntaxKind::FUNCTION_CALL => {
                if let Some(function) = open.function {
                    self.table.ops.push(Op::Call(function, open.arguments));
                }
            }
            SyntaxKind::GROUP => {
                if let Some(parent) = self.open.last_mut() {
                    match parent.kind {
                        SyntaxKind::FUNCTION_CALL => {
                            parent.arguments = parent.arguments.saturating_add(1 + open.arguments);
                        }
                        SyntaxKind::O_STATEMENT
                            if matches!(
                                parent.keyword,
                                Some((_, OKeyword::Call | OKeyword::Return | OKeyword::EndSub))
                            ) =>
                        {
                            let from = parent.ops;
                            self.take_expr(from, open.start);
                            let ops = self.table.ops.len();
                            if let Some(parent) = self.open.last_mut() {
                                parent.ops = ops;
                            }
                        }
                        _ => {}
                    }
                }
            }
            _ => {}
        }
    }

    /// A statement has all its parts.
    fn finish_statement(&mut self, mut open: Open) {
        match open.kind {
            SyntaxKind::ASSIGNMENT => {
                // Without `=` there is neither target nor value.
                let value = open.target.as_ref().and_then(|_| self.take_expr(open.ops, open.value_start));
                let target = open.target.clone().unwrap_or(Target::Invalid);
                self.statement(&open, StatementKind::Assign { target, value });
            }
            SyntaxKind::CONDITION => {
                let condition = self.take_expr(open.ops, open.start);
                self.statement(&open, StatementKind::Guard { condition });
            }
            SyntaxKind::IF_STATEMENT => {
                if open.target.is_none() {
                    let condition = self.take_expr(open.ops, open.start);
                    self.statement(&open, StatementKind::If { condition });
                }
            }
            SyntaxKind::GOTO_STATEMENT => {
                let target = self.take_expr(open.ops, open.start);
                self.statement(&open, StatementKind::Goto { target });
            }
            SyntaxKind::WHILE_STATEMENT => {
                let number = self.take_expr(open.ops, open.start);
                // Without DO the only expression is the condition.
                let (condition, number) =
                    if open.target.is_some() { (open.first, number) } else { (number, None) };
                self.statement(&open, StatementKind::Do { condition, number });
            }
            SyntaxKind::END_STATEMENT => {
                let number = self.take_expr(open.ops, open.start);
                self.statement(&open, StatementKind::End { number });
            }
            SyntaxKind::O_STATEMENT => {
                if let Some((label, keyword)) = open.keyword.take() {
                    if !matches!(keyword, OKeyword::Call | OKeyword::Return | OKeyword::EndSub) {
                        self.take_expr(open.ops, open.start);
                    }
                    let arguments = open.first_argument..self.table.exprs.len() as u32;
                    self.statement(&open, StatementKind::OWord { label, keyword, arguments });
                }
            }
            SyntaxKind::PORT_STATEMENT => self.statement(&open, StatementKind::Print),
            SyntaxKind::COMMAND_STATEMENT => self.statement(&open, StatementKind::Command),
            _ => {}
        }
    }

    fn lower_case(&mut self) {
        if !self.dialect.lower_case {
            self.block_flags |= BlockFlags::LOWER_CASE;
        }
    }

    /// A token that is neither a blank nor a comment, outside errors.
    fn meaningful_token(&mut self, kind: SyntaxKind, range: Range<u32>) {
        let inner = self.innermost();
        match kind {
            SyntaxKind::WORD if inner == SyntaxKind::ADDRESS => {
                // `X1. 5`: the node reads its whole text when it ends.
            }
            SyntaxKind::WORD | SyntaxKind::COLON_NUMBER => self.fused(range),
            SyntaxKind::LETTER => {
                if self.slice(&range).iter().any(u8::is_ascii_lowercase) {
                    self.lower_case();
                }
            }
            SyntaxKind::NUMBER => match inner {
                SyntaxKind::BLOCK_DELETE if !self.dialect.block_delete => {}
                SyntaxKind::BLOCK_DELETE => {
                    self.block_delete =
                        self.slice(&range).first().map_or(1, |digit| digit.saturating_sub(b'0').max(1));
                }
                _ => {
                    let (value, _) = number::parse(self.slice(&range));
                    self.table.ops.push(Op::Number(value));
                }
            },
            SyntaxKind::VARIABLE => {
                let digits = self.slice(&range).get(1..).unwrap_or_default();
                let number = std::str::from_utf8(digits)
                    .ok()
                    .and_then(|d| d.trim_end_matches('.').parse().ok())
                    .unwrap_or(u32::MAX);
                self.table.ops.push(Op::Variable(number));
            }
            SyntaxKind::NAMED_VARIABLE => {
                let name = between_brackets(self.slice(&range), &range);
                self.table.ops.push(Op::Named { start: name.start, end: name.end });
            }
            SyntaxKind::O_NAME => {
                let name = between_brackets(self.slice(&range), &range);
                if let Some(open) = self.open.last_mut() {
                    open.target = Some(Target::Named(name));
                }
            }
            SyntaxKind::EQUALS if inner == SyntaxKind::ASSIGNMENT => self.assignment_target(),
            SyntaxKind::COMMA if inner == SyntaxKind::GROUP => {
                if let Some(open) = self.open.last_mut() {
                    open.arguments = open.arguments.saturating_add(1);
                }
            }
            SyntaxKind::FUNCTION if inner == SyntaxKind::FUNCTION_CALL => {
                let function = Function::parse(self.slice(&range));
                if let Some(open) = self.open.last_mut() {
                    open.function = function;
                }
            }
            SyntaxKind::THEN_KW | SyntaxKind::DO_KW
                if matches!(inner, SyntaxKind::IF_STATEMENT | SyntaxKind::WHILE_STATEMENT) =>
            {
                self.close_condition();
            }
            SyntaxKind::PLUS
            | SyntaxKind::MINUS
            | SyntaxKind::STAR
            | SyntaxKind::POWER
            | SyntaxKind::SLASH
            | SyntaxKind::COMPARISON
            | SyntaxKind::AND_KW
            | SyntaxKind::OR_KW
            | SyntaxKind::MOD_KW => self.operator(kind, &range),
            SyntaxKind::PERCENT => self.block_flags |= BlockFlags::TAPE_MARK,
            _ if inner == SyntaxKind::O_STATEMENT => {
                if let Some(keyword) = OKeyword::of(kind) {
                    self.o_keyword(keyword);
                }
            }
            _ => {}
        }
    }

    /// `=`: what came before it is the target.
    fn assignment_target(&mut self) {
        let Some(open) = self.open.last() else { return };
        if open.target.is_some() {
            return;
        }
        let (from, start) = (open.ops, open.start);
        let target = match self.table.ops.get(from..).unwrap_or_default() {
            [Op::Variable(number)] => Target::Variable(*number),
            [Op::Named { start, end }] => Target::Named(*start..*end),
            [.., Op::Indirect] => {
                // The expression gives the number of the variable: without the final read.
                self.table.ops.pop();
                self.take_expr(from, start).map_or(Target::Invalid, Target::Computed)
            }
            _ => Target::Invalid,
        };
        let ops = self.table.ops.len();
        let end = self.end;
        if let Some(open) = self.open.last_mut() {
            open.target = Some(target);
            open.ops = ops;
            open.value_start = end;
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::{BlockTable, Dialect, lower, skim};

    /// The blocks alone, as [`skim`] gives them.
    fn without_words(mut table: BlockTable) -> BlockTable {
        table.words.clear();
        for block in &mut table.blocks {
            block.words = 0..0;
        }
        table
    }

    #[test]
    fn a_chunk_is_skimmed_when_its_blocks_only_say_where_to() {
        let control = gcheck_controls::load("haas-mill").unwrap();
        let dialect = Dialect::new(&control);
        for (text, is_skimmed) in [
            ("", true),
            ("X1. Y-2.5\n\n Z.5\tA10.\r\nX1. I2. J0.\n", true),
            ("X1. Y-2.5\nZ.5", false),
            ("X1. Y2\n", false),
            ("X1. X2.\n", false),
            ("G1 X1.\n", false),
            ("X1. F100.\n", false),
            ("X1.\n(A)\n", false),
            ("x1.\n", false),
        ] {
            assert_eq!(skim(text, &dialect).is_some(), is_skimmed, "{text:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3_000))]

        #[test]
        fn a_skimmed_chunk_has_the_blocks_of_a_lowered_one(
            text in "(([XYZAIJR][-+]?[0-9]{1,3}[.][0-9]{0,12}[ \\t]?|[GFxT]?[-+. 0-9]?){0,4}\r?\n){0,8}",
        ) {
            for name in ["fanuc-mill", "linuxcnc"] {
                let control = gcheck_controls::load(name).unwrap();
                let dialect = Dialect::new(&control);
                if let Some(skimmed) = skim(&text, &dialect) {
                    let lowered = without_words(lower(&text, &dialect));
                    prop_assert_eq!(skimmed, lowered, "{} on {:?}", name, text);
                }
            }
        }
    }
}
