//! What is known about a rule without running it: identity, defaults, documentation.
//!
//! Knows: metadata. Must not know: programs, how rules run, which rules exist.

use crate::Severity;

/// Which facts a rule may see, and so when it runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Tier {
    /// Mistakes in form.
    Token,
    /// One block at a time, resolved against the control.
    Block,
    /// The whole file: labels, calls, program structure.
    Program,
    /// Every path of the program, executed: what is active, where the tool goes.
    Path,
}

impl Tier {
    /// The name used in documentation.
    pub fn name(self) -> &'static str {
        match self {
            Self::Token => "token",
            Self::Block => "block",
            Self::Program => "program",
            Self::Path => "path",
        }
    }
}

/// Rules that a shop chooses together, besides the set `recommended`, which is on by default.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RuleSet {
    /// What is worth a look in a careful shop, though good programs do it too; `recommended` is part of it.
    Strict,
    /// Every tool's part of a program can be started by itself.
    RestartSafe,
    /// A file is written in one style: one form of numbers, blanks and line ends.
    HouseStyle,
}

impl RuleSet {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Strict, Self::RestartSafe, Self::HouseStyle];

    /// The name used in selections.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Strict => "strict",
            Self::RestartSafe => "restart-safe",
            Self::HouseStyle => "house-style",
        }
    }

    /// What it is for, in one line.
    pub const fn summary(self) -> &'static str {
        match self {
            Self::Strict => {
                "everything in `recommended`, and what is worth a look in a careful shop though good programs do it too"
            }
            Self::RestartSafe => "every tool's part of a program can be started by itself",
            Self::HouseStyle => "a file is written in one style: one form of numbers, blanks and line ends",
        }
    }
}

/// Whether a rule offers fixes for what it finds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fixability {
    /// Never.
    Never,
    /// For some findings, fixes that change no move.
    Safely,
    /// For some findings, but only fixes that may change moves or that only the programmer can decide.
    OnRequest,
}

impl Fixability {
    /// As lists of rules show it: the option that applies the fix; empty for rules without fixes.
    pub const fn option(self) -> &'static str {
        match self {
            Self::Never => "",
            Self::Safely => "--fix",
            Self::OnRequest => "--unsafe-fixes",
        }
    }
}

/// A rule's identity, defaults and documentation.
#[derive(Debug)]
pub struct RuleMeta {
    /// Kebab-case; names the defect.
    pub id: &'static str,
    /// The folder of its file: `syntax`, `words`, `modal`, ….
    pub group: &'static str,
    /// Names the defect in one line, lower case.
    pub summary: &'static str,
    /// Severity when nothing weakens it.
    pub severity: Severity,
    /// It judges by what this control has and reads, and another control may accept the same text. So a finding is an info at
    /// most where the control is only the fallback.
    pub control_specific: bool,
    /// On by default.
    pub recommended: bool,
    /// The sets that it is in besides `recommended`; see [`RuleMeta::sets`].
    pub other_sets: &'static [RuleSet],
    /// Whether it offers fixes.
    pub fixability: Fixability,
    /// Version that brought it.
    pub since: &'static str,
    /// Former ids, still accepted in configuration, suppressions and baselines.
    pub aliases: &'static [&'static str],
    /// Which facts it sees.
    pub tier: Tier,
    /// The doc comment as written: one line a `///`, each with its leading blank. See [`RuleMeta::docs`].
    pub raw_docs: &'static str,
}

/// Rules are told apart by their ids.
impl PartialEq for RuleMeta {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl RuleMeta {
    /// Address of the rule's page.
    pub fn page(&self) -> String {
        format!("{}/blob/main/docs/rules/{}.md", env!("CARGO_PKG_REPOSITORY"), self.id)
    }

    /// Is this the rule's id or a former id?
    pub fn is_called(&self, name: &str) -> bool {
        self.id == name || self.aliases.contains(&name)
    }

    /// Does a selector of a configuration or a suppression name the rule: its id, its group, one of its sets, or `all`?
    pub fn is_selected_by(&self, selector: &str) -> bool {
        match selector {
            "all" => true,
            "recommended" => self.recommended,
            _ => {
                self.is_called(selector)
                    || self.group == selector
                    || RuleSet::ALL.into_iter().any(|set| set.name() == selector && self.is_in(set))
            }
        }
    }

    /// Is the rule in a set?
    pub fn is_in(&self, set: RuleSet) -> bool {
        self.other_sets.contains(&set) || set == RuleSet::Strict && self.recommended
    }

    /// The sets that the rule is in, as selections name them.
    pub fn sets(&self) -> Vec<&'static str> {
        let others = RuleSet::ALL.into_iter().filter(|set| self.is_in(*set)).map(RuleSet::name);
        self.recommended.then_some("recommended").into_iter().chain(others).collect()
    }

    /// Markdown: meaning, why it matters, examples.
    pub fn docs(&self) -> String {
        let mut docs = String::with_capacity(self.raw_docs.len());
        for line in self.raw_docs.lines() {
            docs.push_str(line.strip_prefix(' ').unwrap_or(line));
            docs.push('\n');
        }
        docs
    }
}
