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
    /// The program looks like it.
    Detected,
    /// Nothing said otherwise.
    Default,
}

impl ControlSource {
    pub(crate) fn phrase(self, reasons: &str) -> String {
        let told = !reasons.is_empty();
        match self {
            Self::Configuration if told => format!("set in {reasons}"),
            Self::Configuration => "set by the configuration".to_owned(),
            Self::Option if told => format!("set by {reasons}"),
            Self::Option => "set by `--control`".to_owned(),
            Self::Comment if told => format!("set by the comment {reasons}"),
            Self::Comment => "set by a comment".to_owned(),
            Self::Detected if told => format!("detected from {reasons}"),
            Self::Detected => "detected from the program".to_owned(),
            Self::Default if told => format!("by default: {reasons}"),
            Self::Default => "by default".to_owned(),
        }
    }
}
