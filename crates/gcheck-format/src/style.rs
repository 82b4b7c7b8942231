//! What a formatted program looks like, as plain options.
//!
//! Knows: the options, and what a control's customs make of them. Must not know: configuration files, how text is changed.

use gcheck_controls::Control;
pub use gcheck_controls::LetterCase;

/// How programs are to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Style {
    /// Blanks between the words of a block.
    pub word_spacing: WordSpacing,
    /// Letters of addresses and keywords. Small letters are not written for a control that does not read them.
    pub letter_case: LetterCase,
    /// `G1` or `G01`.
    pub leading_zeros: LeadingZeros,
    /// `X1.500` or `X1.5`. A decimal point is neither added nor taken away: `X1.000` becomes `X1.`.
    pub trailing_zeros: TrailingZeros,
    /// `N` numbers that nothing names.
    pub sequence_numbers: SequenceNumbers,
    /// The column, counted from 1, in which the words after an `N` number begin, where the number leaves room. 0 keeps the
    /// word spacing there.
    pub word_column: u8,
    /// The column, counted from 1, in which a comment after the words of a block begins, at least one blank after them;
    /// 1 puts one blank in front of it. 0 keeps the blanks that are there.
    pub comment_column: u8,
    /// The most blank lines that may follow each other.
    pub blank_lines: u32,
    /// Blanks at the end of a line go; those inside a comment are part of it.
    pub drop_trailing_blanks: bool,
    /// Blanks at the head of a line.
    pub indentation: Indentation,
}

/// Blanks between the words of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum WordSpacing {
    /// As they are.
    Keep,
    /// One blank.
    One,
    /// None: `G1X1.Y2.`, for a control short of memory.
    None,
}

/// Zeros in front of the number of a `G` or `M` code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LeadingZeros {
    /// As they are.
    Keep,
    /// Two digits at least: `G01`, `M06`.
    Add,
    /// None: `G1`, `M6`.
    Drop,
}

/// Zeros at the end of a number with a decimal point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TrailingZeros {
    /// As they are.
    Keep,
    /// None: `X1.5`, `X1.`.
    Drop,
}

/// `N` numbers that nothing names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SequenceNumbers {
    /// As they are.
    Keep,
    /// None, as far as it is certain that nothing names them.
    Drop,
}

/// Blanks at the head of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Indentation {
    /// As they are.
    Keep,
    /// None.
    None,
    /// So many for each loop, branch or subroutine around the block. A block that begins with `/` stays at the line's head.
    Nested(u8),
}

impl Style {
    /// Everything as it is.
    pub const KEEP: Self = Self {
        word_spacing: WordSpacing::Keep,
        letter_case: LetterCase::Keep,
        leading_zeros: LeadingZeros::Keep,
        trailing_zeros: TrailingZeros::Keep,
        sequence_numbers: SequenceNumbers::Keep,
        word_column: 0,
        comment_column: 0,
        blank_lines: u32::MAX,
        drop_trailing_blanks: false,
        indentation: Indentation::Keep,
    };

    /// What holds for a control where nobody wishes otherwise: one blank between words, the control's customary letters, one
    /// blank line at most, no blanks at the end of a line; all else as it is.
    pub fn of(control: &Control) -> Self {
        Self {
            word_spacing: WordSpacing::One,
            letter_case: control.format_customs().letter_case,
            blank_lines: 1,
            drop_trailing_blanks: true,
            ..Self::KEEP
        }
    }
}
