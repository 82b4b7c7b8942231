//! `[format]`: how programs are to be written.
//!
//! Knows: keys and types, what they make of a style. Must not know: how programs are formatted.

use gcheck_controls::Control;
use gcheck_format::Style;
use schemars::JsonSchema;
use serde::Deserialize;

/// `[format]`: how `gcheck fmt` writes programs. A key that is left out follows the customs of the control.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
#[schemars(rename = "Format")]
pub struct FormatTable {
    /// Blanks between words; `"one"` without it.
    pub word_spacing: Option<WordSpacing>,
    /// Letters of addresses and keywords; what is customary on the control without it.
    pub letter_case: Option<LetterCase>,
    /// Zeros in front of the numbers of codes, `G1` or `G01`; `"keep"` without it.
    pub leading_zeros: Option<LeadingZeros>,
    /// Zeros after decimal points, `X1.500` or `X1.5`; `"keep"` without it. The point itself always stays.
    pub trailing_zeros: Option<TrailingZeros>,
    /// `N` numbers that nothing names; `"keep"` without it.
    pub sequence_numbers: Option<SequenceNumbers>,
    /// The column, counted from 1, in which the words after an `N` number begin; 0 or left out: where the number ends.
    pub word_column: Option<u8>,
    /// The column, counted from 1, in which a comment after the words of a block begins; 1 puts it one blank after
    /// them, 0 or left out leaves it where it is.
    pub comment_column: Option<u8>,
    /// The most blank lines that may follow each other; 1 without it.
    pub blank_lines: Option<u32>,
    /// Whether blanks at the end of a line stay; they go without it.
    pub trailing_blanks: Option<TrailingBlanks>,
    /// Blanks at the head of a line; `"keep"` without it.
    pub indentation: Option<Indentation>,
    /// Blanks for each loop, branch or subroutine around a block, where `indentation` is `"nested"`; 2 without it.
    pub indent_width: Option<u8>,
}

/// Blanks between words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum WordSpacing {
    /// As they are.
    Keep,
    /// One.
    One,
    /// None, for a control short of memory.
    None,
}

/// Letters of addresses and keywords.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LetterCase {
    /// As they are.
    Keep,
    /// `G1 X1.`
    Upper,
    /// `g1 x1.`, where the control reads small letters.
    Lower,
}

/// Zeros in front of the numbers of codes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LeadingZeros {
    /// As they are.
    Keep,
    /// Two digits: `G01`, `M06`.
    Add,
    /// None: `G1`, `M6`.
    Drop,
}

/// Zeros after decimal points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TrailingZeros {
    /// As they are.
    Keep,
    /// None: `X1.5`, `X1.`
    Drop,
}

/// `N` numbers that nothing names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SequenceNumbers {
    /// They stay.
    Keep,
    /// They go, where it is certain that nothing names them.
    Drop,
}

/// Blanks at the end of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TrailingBlanks {
    /// They stay.
    Keep,
    /// They go.
    Drop,
}

/// Blanks at the head of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Indentation {
    /// As they are.
    Keep,
    /// None.
    None,
    /// By the loops, branches and subroutines around the block.
    Nested,
}

/// Blanks for each loop around a block when nobody says how many.
const INDENT_WIDTH: u8 = 2;

impl FormatTable {
    /// Puts another table over this one.
    pub(super) fn put(&mut self, over: &Self) {
        macro_rules! over {
            ($($key:ident)*) => {
                $(self.$key = over.$key.or(self.$key);)*
            };
        }
        over!(word_spacing letter_case leading_zeros trailing_zeros sequence_numbers word_column);
        over!(comment_column blank_lines trailing_blanks indentation indent_width);
    }

    /// The style for programs of a control.
    pub fn style(&self, control: &Control) -> Style {
        use gcheck_format as f;

        let mut style = Style::of(control);
        if let Some(spacing) = self.word_spacing {
            style.word_spacing = match spacing {
                WordSpacing::Keep => f::WordSpacing::Keep,
                WordSpacing::One => f::WordSpacing::One,
                WordSpacing::None => f::WordSpacing::None,
            };
        }
        if let Some(case) = self.letter_case {
            style.letter_case = match case {
                LetterCase::Keep => f::LetterCase::Keep,
                LetterCase::Upper => f::LetterCase::Upper,
                LetterCase::Lower => f::LetterCase::Lower,
            };
        }
        if let Some(zeros) = self.leading_zeros {
            style.leading_zeros = match zeros {
                LeadingZeros::Keep => f::LeadingZeros::Keep,
                LeadingZeros::Add => f::LeadingZeros::Add,
                LeadingZeros::Drop => f::LeadingZeros::Drop,
            };
        }
        if let Some(zeros) = self.trailing_zeros {
            style.trailing_zeros = match zeros {
                TrailingZeros::Keep => f::TrailingZeros::Keep,
                TrailingZeros::Drop => f::TrailingZeros::Drop,
            };
        }
        if let Some(numbers) = self.sequence_numbers {
            style.sequence_numbers = match numbers {
                SequenceNumbers::Keep => f::SequenceNumbers::Keep,
                SequenceNumbers::Drop => f::SequenceNumbers::Drop,
            };
        }
        if let Some(blanks) = self.trailing_blanks {
            style.drop_trailing_blanks = blanks == TrailingBlanks::Drop;
        }
        if let Some(indentation) = self.indentation {
            style.indentation = match indentation {
                Indentation::Keep => f::Indentation::Keep,
                Indentation::None => f::Indentation::None,
                Indentation::Nested => f::Indentation::Nested(self.indent_width.unwrap_or(INDENT_WIDTH)),
            };
        }
        Style {
            word_column: self.word_column.unwrap_or(style.word_column),
            comment_column: self.comment_column.unwrap_or(style.comment_column),
            blank_lines: self.blank_lines.unwrap_or(style.blank_lines),
            ..style
        }
    }
}
