//! The few facts about a control that the grammar needs.
//!
//! Knows: forms of text. Must not know: any control's name; the knowledge base maps a control to a profile.

/// How a control reads a line of text.
///
/// Every form is parsed whatever the profile says; a form that the control does not have is reported as
/// [`SyntaxErrorKind::Foreign`](crate::SyntaxErrorKind::Foreign), so a program in the wrong dialect still has a tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(clippy::struct_excessive_bools, reason = "independent yes/no facts, named one by one")]
pub struct SyntaxProfile {
    /// `;` starts a comment; otherwise it ends the block.
    pub semicolon_comment: bool,
    /// `X 1. 5` is `X1.5`.
    pub blanks_in_numbers: bool,
    /// `:1234` is `O1234`.
    pub colon_program: bool,
    /// `O100 SUB`, `O<name> CALL [1]`.
    pub o_words: bool,
    /// `IF […] GOTO`, `WHILE […] DO1`, `DPRNT[…]`.
    pub macro_statements: bool,
    /// `#1`, and `[…]` for a value.
    pub variables: bool,
    /// `#<name>`.
    pub named_parameters: bool,
    /// `#1=#2+3` without brackets.
    pub bare_expressions: bool,
    /// `AND`, `OR`, `XOR` bind weaker than comparisons; otherwise `AND` binds as `*`, `OR` and `XOR` as `+`.
    pub logic_binds_last: bool,
    /// `**`.
    pub power_operator: bool,
    /// `IF [#1 EQ 2] G65 P3`: words may be after a condition without `THEN`.
    pub words_after_if: bool,
    /// `$H`, `$J=G91 X1`: lines that are commands to the firmware.
    pub system_commands: bool,
}

impl SyntaxProfile {
    /// A macro-B style control: `;` ends the block, `IF`/`WHILE`/`GOTO`.
    pub const MACRO_B: Self = Self {
        semicolon_comment: false,
        blanks_in_numbers: false,
        colon_program: true,
        o_words: false,
        macro_statements: true,
        variables: true,
        named_parameters: false,
        bare_expressions: true,
        logic_binds_last: false,
        power_operator: false,
        words_after_if: false,
        system_commands: false,
    };

    /// An RS274/NGC style control: `;` comments, O-words, named parameters.
    pub const NGC: Self = Self {
        semicolon_comment: true,
        blanks_in_numbers: true,
        colon_program: false,
        o_words: true,
        macro_statements: false,
        variables: true,
        named_parameters: true,
        bare_expressions: false,
        logic_binds_last: true,
        power_operator: true,
        words_after_if: false,
        system_commands: false,
    };
}
