//! The shape of the data files under `data/<control>/`, exactly as they are written.
//!
//! Knows: field names, defaults, the closed vocabularies. Must not know: inheritance, validation, look-up (see
//! [`crate::loader`] and [`crate::control`]). `data/README.md` explains every field to the authors of data.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::{LetterSet, SyntaxForm};

/// `control.toml`: what kind of control this is, and how it reads text and numbers.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct ControlFile {
    pub(crate) name: String,
    pub(crate) title: String,
    /// A base control that is never chosen by a user (`haas`, `fanuc`).
    #[serde(default, rename = "abstract")]
    pub(crate) is_abstract: bool,
    /// Taken for a program that shows nothing of its control: exactly one control says so.
    #[serde(default)]
    pub(crate) fallback: bool,
    #[serde(default)]
    pub(crate) base: Option<String>,
    #[serde(default)]
    pub(crate) machine: Option<Machine>,
    /// Codes of the base that this control does not have.
    #[serde(default)]
    pub(crate) removed: Vec<String>,
    /// What this control calls codes that the examples of the base have.
    #[serde(default)]
    pub(crate) renamed: BTreeMap<String, String>,
    #[serde(default)]
    pub(crate) syntax: Option<SyntaxRules>,
    #[serde(default)]
    pub(crate) numbers: Option<NumberRules>,
    #[serde(default)]
    pub(crate) limits: Option<Limits>,
    #[serde(default)]
    pub(crate) code_list: Option<CodeList>,
    #[serde(default)]
    pub(crate) block: Option<BlockRules>,
    #[serde(default)]
    pub(crate) format: Option<FormatCustoms>,
    /// Order in which the parts of one block take effect; identifiers used by `phase` of the codes.
    #[serde(default)]
    pub(crate) phases: Vec<String>,
    #[serde(default)]
    pub(crate) axes: Vec<String>,
    #[serde(default, rename = "detect")]
    pub(crate) detect: Vec<Hint>,
    #[serde(default, rename = "reference")]
    pub(crate) references: Vec<Reference>,
}

/// Mill or lathe: decides what `X` measures and what the plane is at power-on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Machine {
    /// Machining centre.
    Mill,
    /// Turning centre: `X` is a diameter.
    Lathe,
}

/// How the control reads a line of text.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[expect(
    clippy::struct_excessive_bools,
    reason = "independent yes/no facts of a control, named one by one in data"
)]
pub struct SyntaxRules {
    /// What `;` means.
    pub semicolon: Semicolon,
    /// Blanks may be inside a number: `X 1. 5` is `X1.5`.
    pub blanks_in_numbers: bool,
    /// `O100 SUB`, `O<name> CALL`: flow control by O-words.
    pub o_words: bool,
    /// `IF … GOTO`, `WHILE … DO … END`, `DPRNT`.
    pub macro_statements: bool,
    /// `#1`, and `[…]` for a value.
    #[serde(default = "yes")]
    pub variables: bool,
    /// `#<name>`.
    pub named_parameters: bool,
    /// An expression after `=` may be without brackets: `#1=#2+3`.
    pub bare_expressions: bool,
    /// More than one assignment in a block.
    pub several_assignments: bool,
    /// `:1234` for a program number.
    pub colon_program: bool,
    /// `O1234` at the head names a program.
    pub program_number: bool,
    /// `/1` to `/9`.
    pub block_delete_levels: bool,
    /// `/` may be after the first word.
    pub block_delete_inside: bool,
    /// How sure the two are; `assumed` when not given.
    #[serde(default)]
    pub block_delete_confidence: Option<Confidence>,
    /// A `(` inside a comment is refused, wherever the comment would end.
    #[serde(default)]
    pub nested_comment_refused: bool,
    /// Lower-case letters are read.
    pub lower_case: bool,
    /// `AND`, `OR`, `XOR` bind weaker than comparisons (LinuxCNC); else `AND` binds as `*`, the others as `+`.
    pub logic_binds_last: bool,
    /// `**` is an operator.
    pub power_operator: bool,
    /// Words may be after a condition without `THEN`: `IF [#1 EQ 2] G65 P3`.
    #[serde(default)]
    pub words_after_if: bool,
    /// `IF […] THEN GOTO 10` is refused; the manual and page that say so.
    #[serde(default)]
    pub jump_after_then_refused: Option<String>,
    /// A pair of `%` lines ends the program where no code does.
    #[serde(default)]
    pub tape_marks_end: bool,
    /// Programs need no code that ends them: they are sent line by line, and the sender stops after the last one.
    #[serde(default)]
    pub program_end_optional: bool,
    /// A `%` is refused wherever it is.
    #[serde(default)]
    pub tape_marks_refused: bool,
    /// `/` lets a switch of the machine skip a block; else the control passes over the sign, and the block always runs.
    #[serde(default = "yes")]
    pub block_delete: bool,
    /// `$H`, `$J=G91 X1`: lines that are commands to the firmware.
    #[serde(default)]
    pub system_commands: bool,
}

/// What a semicolon does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Semicolon {
    /// A comment to the end of the line.
    Comment,
    /// The end-of-block character: what follows is a block of its own.
    EndOfBlock,
}

/// How the control reads numbers.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct NumberRules {
    /// What a length without a decimal point counts.
    pub unpointed: Unpointed,
    /// The setting or parameter that changes this, as the control calls it.
    #[serde(default)]
    pub unpointed_setting: Option<String>,
    /// Least input increment of a length under G20, in inches.
    pub least_inch: f64,
    /// Least input increment of a length under G21, in millimetres.
    pub least_mm: f64,
    /// Least input increment of an angle, in degrees.
    pub least_angle: f64,
    /// Whole numbers may carry a decimal point (`T1.`, `M3.0`).
    #[serde(default)]
    pub integers_take_point: bool,
    /// Digits that a number may have, both sides of the point together.
    #[serde(default)]
    pub max_digits: Option<u8>,
    /// Source and confidence of `max_digits`.
    #[serde(default)]
    pub max_digits_confidence: Option<Confidence>,
    /// The source of these rules.
    pub source: String,
    /// How sure they are.
    pub confidence: Confidence,
}

impl NumberRules {
    /// What one counts on a word in least increments: inches or millimetres.
    pub fn least(&self, in_inches: bool) -> f64 {
        match (self.unpointed, in_inches) {
            (Unpointed::AsWritten, _) => 1.0,
            (_, true) => self.least_inch,
            (_, false) => self.least_mm,
        }
    }
}

/// What `X1` means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Unpointed {
    /// One least increment: `X1` is 0.001 mm or 0.0001 inch.
    LeastIncrement,
    /// Whole units: `X1` is 1 mm or 1 inch.
    AsWritten,
    /// Either, by a parameter we do not know.
    ByParameter,
}

/// Limits of the control, `None` where unknown.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Limits {
    /// Characters in one line.
    #[serde(default)]
    pub line_length: Option<u32>,
    /// Which characters of a line count.
    #[serde(default)]
    pub line_counts: LineCounts,
    /// M codes in one block.
    #[serde(default)]
    pub m_codes_per_block: Option<u8>,
    /// Confidence of `m-codes-per-block`.
    #[serde(default)]
    pub m_codes_confidence: Option<Confidence>,
    /// Nesting of `[`.
    #[serde(default)]
    pub bracket_depth: Option<u8>,
    /// The source of `bracket-depth`.
    #[serde(default)]
    pub bracket_depth_source: Option<String>,
    /// Nesting of subprogram calls.
    #[serde(default)]
    pub call_depth: Option<u8>,
    /// Highest `N`.
    #[serde(default)]
    pub max_sequence_number: Option<u32>,
    /// Codes that cannot be made calls of programs.
    #[serde(default)]
    pub never_aliased: Vec<String>,
    /// Highest number of a code that can be made a call of a program.
    #[serde(default)]
    pub alias_codes_to: Option<u16>,
    /// Lowest and highest program number.
    #[serde(default)]
    pub program_numbers: Option<[u32; 2]>,
    /// Numbers allowed after `DO` and `END`.
    #[serde(default)]
    pub do_numbers: Option<[u8; 2]>,
    /// The switch that changes feeds while a program runs.
    #[serde(default)]
    pub feed_override: Option<OverrideSwitch>,
    /// The switch that slows down rapid moves.
    #[serde(default)]
    pub rapid_override: Option<RapidSwitch>,
    /// The source of the limits.
    #[serde(default)]
    pub source: Option<String>,
}

/// Which characters of a line count where its length has a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LineCounts {
    /// All of them.
    #[default]
    Everything,
    /// Those of words: neither blanks nor comments nor `/`.
    Code,
}

/// The positions of an override switch, percent.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct OverrideSwitch {
    /// Its lowest position.
    #[serde(default)]
    pub min: f64,
    /// Its highest position.
    pub max: f64,
    /// From one position to the next.
    pub step: f64,
    /// Its source.
    pub source: String,
}

impl OverrideSwitch {
    /// Has the switch this position?
    pub fn takes(&self, percent: f64) -> bool {
        let steps = (percent - self.min) / self.step;
        (self.min..=self.max).contains(&percent) && (steps - steps.round()).abs() < 1e-9
    }

    /// Its positions: `0 to 150 percent in steps of 10`.
    pub fn positions(&self) -> String {
        format!("{} to {} percent in steps of {}", self.min, self.max, self.step)
    }
}

/// The positions of the switch for rapid moves, percent.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct RapidSwitch {
    /// Its positions, rising.
    pub positions: Vec<f64>,
    /// Its source.
    pub source: String,
}

impl RapidSwitch {
    /// Has the switch this position?
    pub fn takes(&self, percent: f64) -> bool {
        self.positions.iter().any(|position| (position - percent).abs() < 1e-9)
    }

    /// Its positions: `5, 25, 50 and 100 percent`.
    pub fn positions(&self) -> String {
        let shown: Vec<String> = self.positions.iter().map(f64::to_string).collect();
        match shown.split_last() {
            Some((last, rest)) if !rest.is_empty() => format!("{} and {last} percent", rest.join(", ")),
            _ => format!("{} percent", shown.concat()),
        }
    }
}

/// How complete the list of codes is: how certain a finding about a code outside it may be.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CodeList {
    /// How sure it is that the control has no other G codes.
    pub g_codes: Confidence,
    /// How sure it is that the control has no other M codes.
    pub m_codes: Confidence,
    /// The machine builder adds M codes of his own.
    pub builder_m_codes: bool,
    /// M codes from this number on mean what the configuration of the machine gives them.
    #[serde(default)]
    pub configured_m_codes: Option<u32>,
    /// Codes that the control has, or that mean something else, only under a setting that chooses another set of G codes.
    #[serde(default)]
    pub by_setting: Vec<String>,
    /// Its source.
    pub source: String,
}

impl CodeList {
    /// Does another setting of the control give the code a meaning, or another one?
    pub fn depends_on_setting(&self, code: crate::CodeNumber) -> bool {
        self.by_setting.iter().any(|c| crate::CodeNumber::parse(c) == Some(code))
    }
}

impl Default for CodeList {
    /// Nothing is known.
    fn default() -> Self {
        Self {
            g_codes: Confidence::Assumed,
            m_codes: Confidence::Assumed,
            builder_m_codes: true,
            configured_m_codes: None,
            by_setting: Vec::new(),
            source: "general knowledge".to_owned(),
        }
    }
}

/// What the control does with a block that gives a thing twice, or gives a word that no code reads.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct BlockRules {
    /// Two codes of one modal group.
    pub two_of_a_group: Handling,
    /// One code written twice.
    pub code_twice: Handling,
    /// An address that is given twice.
    pub word_twice: Handling,
    /// A word that neither a code of the block nor the active motion reads.
    pub unread_word: Handling,
    /// A block number that comes after other words.
    #[serde(default = "accepted")]
    pub late_number: Handling,
    /// Its source.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

impl Default for BlockRules {
    /// Nothing is known: the mildest reading.
    fn default() -> Self {
        Self {
            two_of_a_group: Handling::LastWins,
            code_twice: Handling::Accepted,
            word_twice: Handling::LastWins,
            unread_word: Handling::Ignored,
            late_number: Handling::Accepted,
            source: "general knowledge".to_owned(),
            confidence: Confidence::Assumed,
        }
    }
}

fn accepted() -> Handling {
    Handling::Accepted
}

/// What becomes of a contradiction or repetition in a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Handling {
    /// The control stops with an alarm.
    Refused,
    /// The last one counts.
    LastWins,
    /// It has no effect.
    Ignored,
    /// It means what it says.
    Accepted,
}

/// How programs of the control are written by default; for the formatter.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct FormatCustoms {
    /// Which letters addresses and keywords have.
    pub letter_case: LetterCase,
    /// Its source.
    pub source: String,
}

impl Default for FormatCustoms {
    /// Nothing is known: what is written stays.
    fn default() -> Self {
        Self { letter_case: LetterCase::Keep, source: "general knowledge".to_owned() }
    }
}

/// Which letters addresses and keywords have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LetterCase {
    /// Those that are written.
    Keep,
    /// `G1 X1.`
    Upper,
    /// `g1 x1.`
    Lower,
}

/// One hint that a program is written for this control.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Hint {
    /// A text in a comment (case does not matter, whole words), e.g. `VF-2`.
    #[serde(default)]
    pub comment: Option<String>,
    /// A code that only this control (of those known) uses in this way, e.g. `G154`.
    #[serde(default)]
    pub code: Option<String>,
    /// A form of syntax, e.g. `packed-tool`.
    #[serde(default)]
    pub form: Option<SyntaxForm>,
    /// How the name of the file ends, without the dot, in lower case: `ngc`.
    #[serde(default)]
    pub extension: Option<String>,
    /// Points for this control.
    pub weight: i32,
}

/// A manual or page that `source` of an entry refers to by `id`.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Reference {
    /// Short name used in `source`.
    pub id: String,
    /// Title for people.
    pub title: String,
}

/// How well a fact is founded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Confidence {
    /// General knowledge, not checked against a page: never the ground of an error.
    Assumed,
    /// Seen on real programs or posts.
    Observed,
    /// A manual or the control's own source says so.
    Manual,
}

/// `groups.toml`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GroupsFile {
    #[serde(default, rename = "group")]
    pub(crate) groups: Vec<ModalGroup>,
}

/// A modal group: of its codes at most one is active, and at most one may be in a block.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct ModalGroup {
    /// Identifier shared by all controls, e.g. `motion`.
    pub id: String,
    /// The control's own number, e.g. `01`.
    #[serde(default)]
    pub number: Option<String>,
    /// What the group decides, e.g. "motion".
    pub title: String,
    /// False for the group of one-shot codes.
    #[serde(default = "yes")]
    pub modal: bool,
    /// Two codes of the group in one block are a mistake.
    #[serde(default = "yes")]
    pub exclusive: bool,
    /// Code active at power-on; `None` where it depends on a setting or nothing is.
    #[serde(default)]
    pub default: Option<String>,
    /// The source of the group.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

/// `codes-*.toml`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CodesFile {
    #[serde(default, rename = "code")]
    pub(crate) codes: Vec<CodeEntry>,
}

/// When a code opens lines of data; see [`CodeEntry::opens_data`].
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct OpensData {
    /// Address of the word that decides: `"L"`.
    pub letter: String,
    /// Its values that open them.
    pub values: Vec<f64>,
    /// Its values that say everything in their own block (`L2`). With any other value the code may open lines of data.
    pub in_one_block: Vec<f64>,
}

/// One G or M code.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[expect(clippy::struct_excessive_bools, reason = "independent yes/no facts, named one by one in data")]
pub struct CodeEntry {
    /// Canonical spelling without leading zeros: `G1`, `G54.1`, `M6`.
    pub code: String,
    /// Names the function in a few words, lower case: "tool length compensation, positive".
    pub title: String,
    /// Modal group, an `id` of `groups.toml`.
    pub group: String,
    /// Place in the block's order of execution, one of the control's `phases`.
    pub phase: String,
    /// One true sentence.
    pub summary: String,
    /// Words the code reads.
    #[serde(default)]
    pub words: Vec<WordEntry>,
    /// The control accepts the code, and no page says what it does.
    #[serde(default)]
    pub undefined: bool,
    /// True when the code may be followed by words not listed (macro calls, aliases, printing).
    #[serde(default)]
    pub any_words: bool,
    /// Of each list at least one word must be in the block.
    #[serde(default)]
    pub one_of: Vec<Vec<String>>,
    /// Of each list the items exclude each other; an item may be several letters: `["R", "IJK"]`.
    #[serde(default)]
    pub not_together: Vec<Vec<String>>,
    /// Confidence of `one-of` and `not-together` where it differs from the entry's.
    #[serde(default)]
    pub choice_confidence: Option<Confidence>,
    /// Comments that must be in the block, because the control reads them.
    #[serde(default)]
    pub reads_comment: Vec<CommentRead>,
    /// Settings with which the code cannot be used.
    #[serde(default)]
    pub refused_with: Vec<SettingValues>,
    /// Words that some pages of the code list, and others do not.
    #[serde(default)]
    pub disputed: Vec<DisputedWord>,
    /// Letters that must not be in the block with this code, though another code could use them.
    #[serde(default)]
    pub forbidden: Vec<String>,
    /// Codes that must be active (`G90`), or in the block.
    #[serde(default)]
    pub requires: Vec<String>,
    /// Codes that the manual recommends to be active.
    #[serde(default)]
    pub recommends: Vec<String>,
    /// Codes, or groups as `@canned-cycle`, that must not be commanded or active while this code is active.
    #[serde(default)]
    pub forbids: Vec<String>,
    /// How sure that is; `None`: as sure as the rest of the entry.
    #[serde(default)]
    pub forbids_confidence: Option<Confidence>,
    /// Codes, or groups as `@motion`, that must not be in the same block.
    #[serde(default)]
    pub conflicts: Vec<String>,
    /// The control refuses those only where they come before this code in the block; after it they are read, and one of the
    /// two is lost.
    #[serde(default)]
    pub conflicts_when_later: bool,
    /// Codes that the control refuses after this one in a block. Before it they are read, and their motion is lost. The loader
    /// writes it into `conflicts` of these codes.
    #[serde(default)]
    pub refused_after: Vec<String>,
    /// Codes that this one ends.
    #[serde(default)]
    pub cancels: Vec<String>,
    /// Codes or words (`H0`) that end this one.
    #[serde(default)]
    pub cancelled_by: Vec<String>,
    /// Values of a word with which the code opens lines of data: `G10 L50`, `G10 L3`. Up to a code that ends it the blocks are
    /// rows of a table, not commands.
    #[serde(default)]
    pub opens_data: Option<OpensData>,
    /// What moves.
    #[serde(default)]
    pub motion: Motion,
    /// Axis words in the block belong to this code, not to the active motion mode (`G10`, `G28`, `G52`, `G92`).
    #[serde(default)]
    pub takes_axes: bool,
    /// No other code may be in the block.
    #[serde(default)]
    pub alone: bool,
    /// What comes to its end here.
    #[serde(default)]
    pub ends: Option<Ends>,
    /// The machine needs this option, in words.
    #[serde(default)]
    pub option: Option<String>,
    /// Alarms that misuse raises.
    #[serde(default)]
    pub alarms: Vec<AlarmEntry>,
    /// Hover prose in Markdown: purpose, rules, common mistakes.
    #[serde(default)]
    pub hover: Option<String>,
    /// Blocks that make `example` meaningful, e.g. `["T1 M6"]`.
    #[serde(default)]
    pub setup: Vec<String>,
    /// One block that uses the code well; it is the entry's fixture.
    pub example: String,
    /// The source of the entry.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

/// A word as one code reads it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[expect(
    clippy::struct_excessive_bools,
    reason = "independent yes/no facts of a word, named one by one in data"
)]
pub struct WordEntry {
    /// The address, upper case; `,R` and `,C` for corner words.
    pub letter: String,
    /// Meaning in a few words.
    pub is: String,
    /// Kind of value.
    #[serde(rename = "type")]
    pub kind: WordKind,
    /// Must it be given?
    #[serde(default)]
    pub need: Need,
    /// For `need = "conditional"`: when, in words.
    #[serde(default)]
    pub when: Option<String>,
    /// For `need = "conditional"`: it must be in the block unless a comment is, which may name a file.
    #[serde(default)]
    pub unless_comment: bool,
    /// For `need = "conditional"`: words beside which it must be in the block, with their values (`["L2", "L20"]`), or letters
    /// beside which it must be whatever their value (`["J"]`).
    #[serde(default)]
    pub required_with: Vec<String>,
    /// Letters beside one of which the code reads the word: `["P"]`. A code with a form of one block and one of two reads some
    /// words in one form alone.
    #[serde(default)]
    pub only_with: Vec<String>,
    /// Words of which any makes this one unnecessary: a peck cycle takes `Q`, or `I`, `J` and `K`.
    #[serde(default)]
    pub instead: Vec<String>,
    /// As `instead`, but only in a block of the code: elsewhere they mean something else (`H` of `G43` and of `G41`).
    #[serde(default)]
    pub instead_here: Vec<String>,
    /// Smallest value.
    #[serde(default)]
    pub min: Option<f64>,
    /// Largest value.
    #[serde(default)]
    pub max: Option<f64>,
    /// The value must be greater than this.
    #[serde(default)]
    pub above: Option<f64>,
    /// The values that it may have, where the control takes single ones: `[0, 1, 2, 10, 11, 20]`.
    #[serde(default)]
    pub values: Vec<f64>,
    /// The control accepts the word, and it should not be given.
    #[serde(default)]
    pub unwanted: bool,
    /// Numbers between the bounds that name nothing: first and last of each row.
    #[serde(default)]
    pub gaps: Vec<[f64; 2]>,
    /// For integers: the control refuses a number that is not whole, instead of rounding it.
    #[serde(default)]
    pub whole: bool,
    /// What groups of its digits hold, from the first digit of a full number to the last.
    #[serde(default)]
    pub packed: Vec<PackedPart>,
    /// Letters beside which the number is not packed, though the word is given: `XZUW`.
    #[serde(default)]
    pub packed_without: String,
    /// What holds of it beside other words of the block, by their values.
    #[serde(default)]
    pub beside: Vec<Beside>,
    /// Confidence of `values`, `min`, `max` and `above` where it differs from the word's.
    #[serde(default)]
    pub range_confidence: Option<Confidence>,
    /// Value when left out, in words.
    #[serde(default)]
    pub default: Option<String>,
    /// For labels and programs: what the word names is in another program or memory, so it need not be in this file.
    #[serde(default)]
    pub elsewhere: bool,
    /// For programs: a block of this program, by its sequence number, where it has one of that number.
    #[serde(default)]
    pub or_label: bool,
    /// For programs: digits before the last four are a repeat count.
    #[serde(default)]
    pub packed_repeats: bool,
    /// Confidence of this word's facts where it differs from the entry's.
    #[serde(default)]
    pub confidence: Option<Confidence>,
}

/// What holds of a word beside another one of its block: `P` of `G10` is 0 to 9 beside `L2`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Beside {
    /// The other words with their values, of which any is enough: `["L2", "L20"]`.
    pub with: Vec<String>,
    /// The word must not be in the block.
    #[serde(default)]
    pub refused: bool,
    /// Smallest value.
    #[serde(default)]
    pub min: Option<f64>,
    /// Largest value.
    #[serde(default)]
    pub max: Option<f64>,
    /// The value must be greater than this.
    #[serde(default)]
    pub above: Option<f64>,
}

/// A group of digits in a number that holds several: the angle in `P` of a threading cycle.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct PackedPart {
    /// What the digits are.
    pub is: String,
    /// How many digits.
    pub digits: u8,
    /// The values that the control takes; any when empty.
    #[serde(default)]
    pub values: Vec<u32>,
}

/// Values of a setting that decide something.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SettingValues {
    /// As the control calls it.
    pub setting: String,
    /// The values of which any decides.
    pub values: Vec<String>,
}

/// A word that some pages of a code list, and others do not: the code is judged without it, and nothing that rests on it is
/// certain.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct DisputedWord {
    /// The address.
    pub letter: String,
    /// Which pages list it, and which do not.
    pub why: String,
}

/// A comment that the control reads as part of a code: the text to engrave.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CommentRead {
    /// What it holds: "the text to engrave".
    pub is: String,
    /// The words beside which it is read, with their values (`["P0"]`); every time when empty.
    #[serde(default)]
    pub with: Vec<String>,
    /// How it is written.
    pub form: CommentForm,
}

/// How a comment that the control reads is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CommentForm {
    /// Any text that is not blank.
    Text,
    /// `08:30`.
    HoursAndMinutes,
    /// The name of a picture or film: `PART.PNG`.
    MediaFile,
}

/// Must a word be in the block?
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Need {
    /// In every block with the code.
    Required,
    /// In the block, or given earlier and still in effect.
    Modal,
    /// May be left out.
    #[default]
    Optional,
    /// Depends on what `when` says.
    Conditional,
}

/// Kind of the value of an address.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WordKind {
    /// A length; scaled when the decimal point is missing.
    Length,
    /// An angle in degrees; scaled when the decimal point is missing.
    Angle,
    /// A direction number, never converted between inch and millimetre.
    Direction,
    /// A whole number; a decimal point is refused.
    Integer,
    /// A length as a whole number of least increments, whatever numbers without a point count elsewhere.
    LeastIncrements,
    /// A plain number.
    Real,
    /// A feed rate.
    Feed,
    /// A spindle speed.
    Speed,
    /// Seconds with a decimal point, milliseconds without.
    SecondsOrMilliseconds,
    /// Seconds.
    Seconds,
    /// Milliseconds, a whole number.
    Milliseconds,
    /// A sequence number `N` in this program.
    Label,
    /// A program number.
    Program,
    /// A factor.
    Ratio,
    /// Only its presence counts.
    Flag,
}

impl WordEntry {
    /// Is its number made of packed digits in a block that has these letters, and no value of its own?
    pub fn is_packed_beside(&self, letters: LetterSet) -> bool {
        !self.packed.is_empty() && !letters.intersects(LetterSet::of(&self.packed_without))
    }
}

impl WordKind {
    /// Is it a whole number: a count, a length in least increments, or the name of a block or program?
    pub const fn is_whole(self) -> bool {
        matches!(self, Self::Integer | Self::LeastIncrements | Self::Label | Self::Program)
    }
}

/// What a code makes move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Motion {
    /// Nothing.
    #[default]
    None,
    /// Rapid traverse.
    Rapid,
    /// Straight cutting feed.
    Feed,
    /// Circular or helical cutting feed.
    Arc,
    /// Feed synchronised with the spindle.
    Thread,
    /// Canned cycle, stays on for the following blocks.
    Cycle,
    /// A whole operation of one block (`G12`, `G150`, `G71`).
    Operation,
    /// Move until a probe or skip signal.
    Probe,
    /// Return to a reference position.
    Reference,
    /// Standing still for a time.
    Dwell,
    /// Spline or other curve.
    Curve,
}

/// What a code brings to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ends {
    /// The program (`M2`, `M30`).
    Program,
    /// A subprogram; a main program starts again (`M99`).
    Subprogram,
}

/// An alarm that misuse of a code raises.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct AlarmEntry {
    /// The control's number, where one is known: `PS0011`, `339`.
    #[serde(default)]
    pub number: Option<String>,
    /// What happened, in our words.
    pub text: String,
    /// How sure it is.
    pub confidence: Confidence,
}

/// `alarms.toml`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AlarmsFile {
    #[serde(default, rename = "alarm")]
    pub(crate) alarms: Vec<RuleAlarm>,
}

/// The alarm that a control raises for what a rule finds, whatever the code.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct RuleAlarm {
    /// The rule's id.
    pub(crate) rule: String,
    /// The codes and addresses that it holds for: `G43.1`, `T`, `G10 P` for a word of a code; `G54.*` is every number with
    /// a decimal after `G54`. For the others, the row of the rule without this field.
    #[serde(default)]
    pub(crate) of: Vec<String>,
    /// As in [`AlarmEntry`].
    #[serde(default)]
    pub(crate) number: Option<String>,
    /// As in [`AlarmEntry`].
    pub(crate) text: String,
    /// As in [`AlarmEntry`].
    pub(crate) confidence: Confidence,
}

/// `letters.toml`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LettersFile {
    #[serde(default, rename = "letter")]
    pub(crate) letters: Vec<LetterEntry>,
}

/// An address as the control reads it when no code of the block says otherwise.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[expect(
    clippy::struct_excessive_bools,
    reason = "independent yes/no facts of an address, named one by one in data"
)]
pub struct LetterEntry {
    /// The address, upper case; `,R` and `,C` for corner words.
    pub letter: String,
    /// Meaning in a few words.
    pub is: String,
    /// Kind of value.
    #[serde(rename = "type")]
    pub kind: WordKind,
    /// An axis or its increment: belongs to the active motion mode.
    #[serde(default)]
    pub axis: bool,
    /// May be in any block, whatever its codes (`F`, `S`, `T`, `N`, axes).
    #[serde(default)]
    pub free: bool,
    /// A minus sign is accepted.
    #[serde(default)]
    pub negative: bool,
    /// Smallest value.
    #[serde(default)]
    pub min: Option<f64>,
    /// Largest value.
    #[serde(default)]
    pub max: Option<f64>,
    /// Numbers between the bounds that name nothing: first and last of each row.
    #[serde(default)]
    pub gaps: Vec<[f64; 2]>,
    /// For integers: the control refuses a number that is not whole, instead of rounding it.
    #[serde(default)]
    pub whole: bool,
    /// May be more than once in a block (`G`, `M`, arguments).
    #[serde(default)]
    pub repeatable: bool,
    /// A missing decimal point changes the value.
    #[serde(default)]
    pub scaled: bool,
    /// The setting that changes how a missing decimal point is read, where it differs from the general one; `none` where no
    /// setting does.
    #[serde(default)]
    pub scale_setting: Option<String>,
    /// The source of the entry.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

/// `variables.toml`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct VariablesFile {
    #[serde(default, rename = "variable")]
    pub(crate) variables: Vec<VariableEntry>,
    #[serde(default, rename = "function")]
    pub(crate) functions: Vec<FunctionEntry>,
}

/// A macro variable, a range of them, or a predefined named parameter.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct VariableEntry {
    /// First and last number; equal for one variable.
    #[serde(default)]
    pub range: Option<[u32; 2]>,
    /// Name without brackets (`_feed`), instead of a range.
    #[serde(default)]
    pub name: Option<String>,
    /// What it holds.
    pub title: String,
    /// Who may do what.
    pub access: Access,
    /// How long it lives.
    pub kind: VariableKind,
    /// Holds the sequence number of a block, so that programs which read it hang on their numbers.
    #[serde(default)]
    pub sequence_number: bool,
    /// It switches something off for every program, so a program sets it back to 0 before it ends.
    #[serde(default)]
    pub zero_at_end: bool,
    /// The manual keeps it for the builder: programs leave it alone.
    #[serde(default)]
    pub reserved: bool,
    /// The source of the entry.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

/// Who may read or write a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Access {
    /// Both.
    ReadWrite,
    /// Programs may only read it.
    Read,
    /// Programs may only write it (`#3000`).
    Write,
}

/// How long a variable keeps its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VariableKind {
    /// One macro level.
    Local,
    /// Until power off.
    Common,
    /// Over power off.
    Retained,
    /// The control's own state.
    System,
}

/// A function of macro expressions.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct FunctionEntry {
    /// Upper case: `ATAN`.
    pub name: String,
    /// What it gives, with units.
    pub title: String,
    /// The source of the entry.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

/// `commands.toml`: lines that begin with `$`, for the control itself, and what the control answers to the others. Names are as
/// the control compares them: capitals, no blanks.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SystemCommands {
    /// Lines without a value: `$H`.
    pub plain: Vec<String>,
    /// How lines begin that go on with a text of their own: `$I=`.
    pub texts: Vec<String>,
    /// Numbers of settings, the first and the last of each range.
    pub settings: Vec<[u16; 2]>,
    /// How a line begins that jogs: `$J=`.
    pub jog: String,
    /// Codes that a jog takes.
    pub jog_codes: Vec<String>,
    /// Letters that a jog takes.
    pub jog_letters: Vec<String>,
    /// The source of all this.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
    /// The answer to a line that is none of these.
    pub unknown: AlarmEntry,
    /// The answer to a name or a value that is not a number.
    pub bad_number: AlarmEntry,
    /// The answer to a value below zero.
    pub negative: AlarmEntry,
    /// The answer to a jog without a feed.
    pub jog_feed: AlarmEntry,
    /// The answer to a jog with another code.
    pub jog_code: AlarmEntry,
    /// The answer to a jog with another word.
    pub jog_word: AlarmEntry,
}

impl SystemCommands {
    /// All answers.
    pub fn alarms(&self) -> [&AlarmEntry; 6] {
        [&self.unknown, &self.bad_number, &self.negative, &self.jog_feed, &self.jog_code, &self.jog_word]
    }

    /// Is it a command or a setting, by its name without a value: `$H`, `$110`?
    pub fn knows(&self, name: &str) -> bool {
        let with_value = format!("{name}=");
        let number = name.strip_prefix('$').and_then(|number| number.parse().ok());
        self.plain.iter().any(|known| known == name)
            || self.texts.iter().chain([&self.jog]).any(|head| *head == with_value)
            || number.is_some_and(|number| self.has_setting(number))
    }

    /// Is there a setting of this number?
    pub fn has_setting(&self, number: u16) -> bool {
        self.settings.iter().any(|[first, last]| (*first..=*last).contains(&number))
    }
}

/// `settings.toml`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SettingsFile {
    #[serde(default, rename = "setting")]
    pub(crate) settings: Vec<SettingEntry>,
}

/// A setting or parameter of the control that changes what a program means.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SettingEntry {
    /// As the control numbers it: `162`, `3401#0`.
    pub number: String,
    /// Its name.
    pub title: String,
    /// Values it takes, as the control words them, lower case; or `length`, `number`, `on/off`.
    pub values: Vec<String>,
    /// Value that gcheck assumes when nothing is configured.
    #[serde(default)]
    pub default: Option<String>,
    /// The value under which a number without decimal point counts as it is written, for settings that decide this.
    #[serde(default)]
    pub as_written: Option<String>,
    /// What it changes for a program.
    pub changes: String,
    /// The source of the entry.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

fn yes() -> bool {
    true
}
