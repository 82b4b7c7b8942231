//! Which control a file was checked for, and where that choice came from.
//!
//! Knows: the ways to choose a control. Must not know: any control, how a choice is made.

use serde::Serialize;

/// The control a file was checked for.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, schemars::JsonSchema)]
pub struct ControlChoice {
    /// Its name, e.g. `haas-mill`.
    pub name: String,
    /// Where the choice came from.
    pub source: ControlSource,
    /// What decided: the configuration file, the comment, the words it was detected from.
    pub because: Option<String>,
}

/// Where the choice of a control came from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ControlSource {
    /// `control = …` of a configuration file.
    Configuration,
    /// `--control`.
    Option,
    /// `(gcheck: control=…)` in the program.
    Comment,
    /// The program shows it clearly.
    Detected,
    /// The program shows it weakly, or nearly as much of another one.
    Guessed,
    /// The program shows none, and those beside it show this one.
    Neighbours,
    /// Nothing said otherwise.
    Default,
}

/// What follows from a guess.
const NO_ERRORS: &str = "no finding is above a warning";

impl ControlSource {
    /// The choice and its reasons in words, for one file or for several.
    pub(crate) fn phrase(self, reasons: &str, files: usize) -> String {
        let told = !reasons.is_empty();
        let programs = if files > 1 { "the programs" } else { "the program" };
        let neighbours = if files > 1 { "their neighbours" } else { "its neighbours" };
        match self {
            Self::Configuration if told => format!("set in {reasons}"),
            Self::Configuration => "set by the configuration".to_owned(),
            Self::Option if told => format!("set by {reasons}"),
            Self::Option => "set by `--control`".to_owned(),
            Self::Comment if told => format!("set by the comment {reasons}"),
            Self::Comment => "set by a comment".to_owned(),
            Self::Detected if told => format!("detected from {reasons}"),
            Self::Detected => format!("detected from {programs}"),
            Self::Guessed if told => format!("guessed from {reasons}: {NO_ERRORS}"),
            Self::Guessed => format!("guessed from {programs}: {NO_ERRORS}"),
            Self::Neighbours if told => format!("guessed from {neighbours} ({reasons}): {NO_ERRORS}"),
            Self::Neighbours => format!("guessed from {neighbours}: {NO_ERRORS}"),
            Self::Default if told => format!("by default: {reasons}"),
            Self::Default => "by default".to_owned(),
        }
    }
}
