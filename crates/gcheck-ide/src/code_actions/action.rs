//! A change that an editor can offer.
//!
//! Knows: its parts. Must not know: which changes there are, how editors ask.

use std::ops::Range;

use gcheck_diagnostics::Edit;

/// Something that can be done at a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CodeAction {
    /// What it does, imperative.
    pub title: String,
    /// Which of the changes it is.
    pub offer: Offer,
    /// What kind of change it is.
    pub kind: ActionKind,
    /// Edits of the document, which do not overlap; empty for [`ActionKind::Explain`].
    pub edits: Vec<Edit>,
    /// The rule whose finding it answers.
    pub rule: Option<&'static str>,
    /// Bytes of the finding that it answers.
    pub finding: Option<Range<u32>>,
    /// The first choice for its finding.
    pub is_preferred: bool,
    /// An address to open, of [`ActionKind::Explain`].
    pub link: Option<String>,
}

/// Kinds of actions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ActionKind {
    /// Fixes a finding, or all findings of its rule.
    Fix,
    /// Applies every fix in the file that changes no move.
    FixAll,
    /// Silences a finding by a comment.
    Suppress,
    /// Opens a page.
    Explain,
    /// Changes how something is written at the place.
    Rewrite,
    /// Changes the whole file.
    Source,
}

/// Declares the changes with their kinds, names and titles, so that no list of them lacks one.
macro_rules! offers {
    ($($(#[$meta:meta])* $variant:ident: $kind:ident, $name:literal, $title:literal;)*) => {
        /// The changes that need no proof.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Offer {
            $($(#[$meta])* $variant,)*
        }

        impl Offer {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$variant),*];

            /// Its kind.
            pub const fn kind(self) -> ActionKind {
                match self {
                    $(Self::$variant => ActionKind::$kind,)*
                }
            }

            /// Its name, for lists of them.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            /// Its title, with `…` for what depends on the place.
            pub const fn title(self) -> &'static str {
                match self {
                    $(Self::$variant => $title,)*
                }
            }
        }
    };
}

offers! {
    /// A fix of a finding, titled by its rule.
    Fix: Fix, "fix", "…";
    /// All findings of the rule.
    FixRule: Fix, "fix-rule", "Fix all … findings in this file…";
    /// All findings whose fix changes no move.
    FixAll: FixAll, "fix-all", "Fix all … findings whose fixes change no move";
    /// A comment for the line.
    IgnoreLine: Suppress, "ignore-line", "Ignore … on this line";
    /// A comment for the file.
    IgnoreFile: Suppress, "ignore-file", "Ignore … in this file";
    /// The page of the rule.
    Explain: Explain, "explain", "Explain …";
    /// I, J, K for R.
    ArcByCentre: Rewrite, "arc-by-centre", "Write this arc with its centre";
    /// R for I, J, K.
    ArcByRadius: Rewrite, "arc-by-radius", "Write this arc with its radius";
    /// Slashes in front of blocks.
    AddBlockDelete: Rewrite, "add-block-delete", "Add block delete to …";
    /// The slashes away.
    RemoveBlockDelete: Rewrite, "remove-block-delete", "Remove block delete from …";
    /// Numbers as the control counts them.
    WriteCounted: Source, "write-counted", "Write … with decimal points, as the control counts them";
    /// Points after numbers.
    AddPoints: Source, "add-points", "Write decimal points after … without one (changes what they count)";
    /// N words in tens.
    Renumber: Source, "renumber-in-tens", "Renumber blocks in tens, with the jumps to them";
}

impl CodeAction {
    /// A change that answers no finding.
    pub(super) fn change(title: impl Into<String>, offer: Offer, edits: Vec<Edit>) -> Self {
        Self {
            title: title.into(),
            offer,
            kind: offer.kind(),
            edits,
            rule: None,
            finding: None,
            is_preferred: false,
            link: None,
        }
    }
}
