//! What CNC controls know: codes, modal groups, addresses, variables, settings and limits, as data with sources.
//!
//! Knows: the data files under `data/<control>/`, inheritance between controls, and how to look facts up.
//! Must not know: syntax trees, programs, or the name of any control: a control is a folder, and nothing here or above
//! asks which one it is.
//!
//! ```
//! let control = gcheck_controls::load("linuxcnc").unwrap();
//! let g43 = control.code(gcheck_controls::CodeNumber::g(43)).unwrap();
//! assert_eq!(g43.group().id, "tool-length");
//! ```

mod bar_feeder;
mod code_number;
mod control;
mod detect;
mod effect_facts;
mod execution;
mod letter_set;
mod loader;
mod machines;
mod motion;
mod schema;
mod syntax_form;
mod unsupported;
mod validate;
mod whole_word;
mod wording;

pub use bar_feeder::BarFeederRules;
pub use code_number::CodeNumber;
pub use control::{AnyPrepared, Code, CodeIx, Control, DataOpening, GroupIx, UserCode, Variable};
pub use detect::{Evidence, Foreign, Guess, Score, Weighed, guess, scores};
pub use effect_facts::EffectGroup;
pub use execution::{
    AlongTool, ArcRules, CompensationRefusals, CompensationRules, CompensationStyle, CycleRules,
    CylinderRules, DwellWord, Effect, FeedWithRotary, Fix, HelixFeed, HelixRules, LastingEnd, LastingFrom,
    LastingWords, LengthAgreement, LocalShift, MessageComment, MirroredVariables, OffsetValue,
    PolarInterpolationRules, ProbeFeed, Refusals, ReturnTo, Semantics, SystemValue, SystemVariable,
    ToolRules, TransformSettings, Unset,
};
pub use letter_set::{Letter, LetterSet};
pub use loader::{LoadError, fallback, load, names};
pub use machines::{MachineModel, machine_models};
pub use motion::{CornerRules, Halt, MotionRules, RapidRules, SpindleWaitRules, TapRules};
pub use schema::{
    Access, AlarmEntry, Beside, BlockRules, CodeEntry, CodeList, CommentForm, CommentRead, Confidence,
    DisputedWord, Ends, FormatCustoms, FunctionEntry, Handling, Hint, LetterCase, LetterEntry, Limits,
    LineCounts, Machine, ModalGroup, Motion, Need, NumberRules, OpensData, OverrideSwitch, PackedPart,
    RapidSwitch, Reference, Semicolon, SettingEntry, SettingValues, SyntaxRules, SystemCommands, Unpointed,
    VariableEntry, VariableKind, WordEntry, WordKind,
};
pub use syntax_form::SyntaxForm;
pub use unsupported::{UnsupportedDialect, unsupported_dialect};
pub use validate::problems;
pub use wording::{one_of, spans};
