//! Forms of syntax by which controls tell their programs apart.
//!
//! Knows: the forms, their names in data and their words in messages. Must not know: how a form is found in a program, or
//! which control it speaks for.

use std::fmt;

use serde::Deserialize;

/// A form of syntax that speaks for some controls and against others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SyntaxForm {
    /// `o100 sub`.
    OWord,
    /// `#<depth>`.
    NamedParameter,
    /// `IF [#1 EQ 2] GOTO 10`.
    MacroStatement,
    /// `; comment`.
    SemicolonComment,
    /// `O1234`.
    ProgramNumber,
    /// `%` in a line of its own.
    TapeMark,
    /// `%1234`.
    TapeMarkWithNumber,
    /// `T0101` or `T101` without a tool change code.
    PackedTool,
    /// `T101` without a tool change code.
    PackedToolShort,
    /// `T0707 M06`: station and offset alike.
    PackedToolWithChange,
    /// `U` and `W` as targets.
    IncrementalWords,
    /// `G71 P Q D`, `G76 K D`.
    TurningCycleOneBlock,
    /// `G71 U R`, `G76 P Q R`.
    TurningCycleTwoBlocks,
    /// Words in lower case.
    LowerCase,
    /// `O00123`.
    FiveDigitProgram,
    /// `O` and six to eight digits.
    LongProgramNumber,
    /// Several blocks with `X` and with `Z`, none with `Y`, and `G50`, `G96` or `G97`.
    TurningWords,
    /// [`Self::TurningWords`] and `G95`, without codes that only system A of lathes has.
    TurningSystemB,
    /// As [`Self::TurningSystemB`], with the codes of system C.
    TurningSystemC,
    /// `$H`, `$110=500`.
    SystemCommand,
    /// Several blocks with `Y`, at least half as many as with `X`.
    MillingWords,
    /// `T1 D1` without a tool change code.
    ToolWithD,
    /// `G50` and `S` in a block.
    SpeedLimitByG50,
    /// `G92` and `S` in a block without axis words, in a program with `G96` that turns.
    SpeedLimitByG92,
}

impl fmt::Display for SyntaxForm {
    /// What a message calls it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::OWord => "O-words",
            Self::NamedParameter => "named parameters `#<…>`",
            Self::MacroStatement => "macro statements",
            Self::SemicolonComment => "comments after `;`",
            Self::ProgramNumber => "its program number",
            Self::TapeMark => "its `%` lines",
            Self::TapeMarkWithNumber => "`%` with a program number",
            Self::PackedTool | Self::PackedToolShort => "`T` with tool and offset in one number",
            Self::PackedToolWithChange => "`T` with station and offset, and `M6`",
            Self::IncrementalWords => "`U` and `W` as targets",
            Self::TurningCycleOneBlock => "turning cycles in one block",
            Self::TurningCycleTwoBlocks => "turning cycles in two blocks",
            Self::LowerCase => "words in lower case",
            Self::FiveDigitProgram => "a program number of five digits",
            Self::LongProgramNumber => "a program number of more than five digits",
            Self::TurningWords => "blocks with `X` and `Z` alone, and speeds of a lathe",
            Self::TurningSystemB => "turning with the codes of system B",
            Self::TurningSystemC => "turning with the codes of system C",
            Self::SystemCommand => "`$` lines",
            Self::MillingWords => "blocks with `X` and `Y`",
            Self::ToolWithD => "`T` with `D`, without a tool change code",
            Self::SpeedLimitByG50 => "a speed limit by `G50 S`",
            Self::SpeedLimitByG92 => "a speed limit by `G92 S`",
        })
    }
}
